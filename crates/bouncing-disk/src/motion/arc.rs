//! The integrals over a segment of contact, in forms that stay accurate for short segments and large
//! accelerations.

use std::iter::Sum;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::elementary::{sin_cos, sine_deficit_ratio};

use crate::motion::phase_time::PhaseSpan;

/// Below this duration (rad) t - sin t is summed as a series.
const SHORT: f64 = 0.5;

/// A stretch of the platform's motion of duration t from a phase tau_0. Every integral is over tau in [tau_0,
/// tau_0 + t], with the normal force N = 1 - P sin tau. All are computed from the start and the duration
/// alone, so that terms that should cancel do so to rounding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Arc {
    peak: f64,
    sine: f64,
    cosine: f64,
    /// t.
    pub(crate) duration: f64,
    /// sin tau and cos tau at the end minus those at the start.
    pub(crate) sine_change: f64,
    pub(crate) cosine_change: f64,
    /// Integral of sin tau cos tau.
    pub(crate) sine_cosine: f64,
    sin: f64,
    /// 1 - cos t, t - sin t and 2 t - sin 2 t.
    versine: f64,
    deficit: f64,
    double_deficit: f64,
}

impl Arc {
    pub(crate) fn new(peak: f64, from: Phase, span: PhaseSpan) -> Self {
        let half = 0.5 * span.remainder;
        let (sine_half, cosine_half) = sin_cos(half);
        let duration = span.radians();
        let versine = 2.0 * sine_half * sine_half;
        let sin = 2.0 * sine_half * cosine_half;
        // Computed from the pair at the start, as a rounded middle phase would be less exact near a whole
        // turn.
        let sine_change = from.cos() * sin - from.sin() * versine;
        let double_sine = 2.0 * sin * (1.0 - versine);
        Self {
            peak,
            sine: from.sin(),
            cosine: from.cos(),
            duration,
            sine_change,
            cosine_change: -(from.sin() * sin + from.cos() * versine),
            sine_cosine: (from.sin() + 0.5 * sine_change) * sine_change,
            sin,
            versine,
            deficit: sine_deficit(duration, sin),
            double_deficit: sine_deficit(2.0 * duration, double_sine),
        }
    }

    /// Integral of N.
    pub(crate) fn force(&self) -> Term {
        Term::of([self.duration, self.peak * self.cosine_change])
    }

    /// The double integral of N: the integral of N up to tau, integrated again.
    pub(crate) fn force_twice(&self) -> Term {
        Term::of([0.5 * (self.duration * self.duration), self.peak * self.cosine_moment()])
    }

    /// Integral of N (tau - tau_0).
    pub(crate) fn force_moment(&self) -> Term {
        let t = self.duration;
        let with_cosine = t * self.sin - self.versine;
        let with_sine = t * self.versine - self.deficit;
        Term::of([0.5 * (t * t), -self.peak * (self.sine * with_cosine + self.cosine * with_sine)])
    }

    /// Integral of cos tau - cos tau_0.
    fn cosine_moment(&self) -> f64 {
        -(self.cosine * self.deficit + self.sine * self.versine)
    }

    /// Integral of sin tau - sin tau_0.
    fn sine_moment(&self) -> f64 {
        self.cosine * self.versine - self.sine * self.deficit
    }

    /// Integral of N (cos tau - cos tau_0).
    pub(crate) fn force_cosine(&self) -> Term {
        Term::of([self.cosine_moment(), 0.5 * self.peak * (self.cosine_change * self.cosine_change)])
    }

    /// Integral of N (sin tau - sin tau_0).
    pub(crate) fn force_sine(&self) -> Term {
        let (s, c) = (self.sine, self.cosine);
        // (sin tau - sin tau_0)^2, by powers of sin t and 1 - cos t.
        let square = c * c * (0.25 * self.double_deficit) - s * c * (self.versine * self.versine)
            + s * s * (2.0 * self.deficit - 0.25 * self.double_deficit);
        Term::of([self.sine_moment(), -self.peak * s * self.sine_moment(), -self.peak * square])
    }
}

/// A sum with the sum of the magnitudes of its terms, to which its rounding error is relative.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Term {
    pub(crate) value: f64,
    pub(crate) size: f64,
}

impl Term {
    fn of<const COUNT: usize>(terms: [f64; COUNT]) -> Self {
        Self { value: terms.iter().sum(), size: terms.iter().map(|term| term.abs()).sum() }
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        Self { value: factor * self.value, size: factor.abs() * self.size }
    }
}

impl Sum for Term {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self { value: 0.0, size: 0.0 }, |sum, term| Self {
            value: sum.value + term.value,
            size: sum.size + term.size,
        })
    }
}

/// t - sin t, accurate for small t; `sine` is sin t.
pub(crate) fn sine_deficit(t: f64, sine: f64) -> f64 {
    if t.abs() > SHORT {
        return t - sine;
    }
    let z = t * t;
    t * z * sine_deficit_ratio(t)
}
