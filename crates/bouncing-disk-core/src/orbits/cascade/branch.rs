//! From one period doubling to the next, in any precision.
//!
//! The orbit of twice the period is followed in the amplitude s and not in the forcing; s is the distance of
//! an impact from the one half a period later. At its birth s = 0 the forcing is stationary in s, so the
//! equations bordered by the amplitude stay regular. The trace of its derivative falls nearly linearly in
//! s^2, from 1 + r^2n at the birth to -1 - r^2n at its own doubling. Regula falsi finds this doubling between
//! the two known ends.

use super::recurrence::{Equations, ImpactTimes};
use crate::flight::launch::Launch;
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::numerics::elementary::{acos, pow};
use crate::numerics::error::Error;
use crate::numerics::real::Real;
use crate::run::Tick;

/// Newton steps for one orbit.
const MAX_NEWTON_STEPS: u32 = 40;

/// Steps of the regula falsi.
const MAX_STEPS: u32 = 80;

/// How many times an amplitude without a solution is halved.
const MAX_HALVINGS: u32 = 30;

/// Residuals of up to this many roundings may be pure rounding error: a few dozen operations on numbers of
/// the size of the peak acceleration and the flights.
const LEFT_BY_ROUNDING: f64 = 1.0e3;

/// The growth, from one doubling to the next, of the change of the multiplier by a rounding in every impact
/// (J. P. Crutchfield, M. Nauenberg and J. Rudnick, Phys. Rev. Lett. 46, 933 (1981)).
const NOISE_GROWTH: f64 = 6.619;

/// The ratio of successive distances between doublings.
const SHRINKING: f64 = 4.669;

/// Roundings of the forcing at the first doubling, a generous bound: the header of `cascade.rs` states the
/// measured errors.
const FIRST_ROUNDINGS: f64 = 8.0;

/// Largest relative difference between two computed durations of the same flight. A larger one means
/// different flights.
const SAME_FLIGHT: f64 = 1.0e-6;

/// The first amplitude (rad) tried on the orbit of period 2.
const FIRST_AMPLITUDE: f64 = 0.1;

/// The squared amplitude first tried at a doubling, relative to the previous doubling: one over a little more
/// than the square of 2.5029.
const SHARE_OF_LAST: f64 = 1.0 / 6.5;

/// An orbit at the forcing where it doubles its period.
#[derive(Debug, Clone)]
pub(crate) struct FlipPoint<R> {
    pub(crate) times: ImpactTimes<R>,
    pub(crate) peak: R,
    /// The multiplier reached, near -1.
    pub(crate) multiplier: R,
    /// The largest distance (rad) of an impact from the one half a period later; 0 for a single impact.
    pub(crate) width: R,
}

/// A bound on the relative change of a doubling's forcing due to rounding.
pub(crate) fn rounding<R: Real>(number: usize) -> f64 {
    R::EPSILON * FIRST_ROUNDINGS * pow(NOISE_GROWTH / SHRINKING, number as f64 - 1.0)
}

/// Bounds on the relative change of the width of a doubling's orbit, and on the change of the multiplier, due
/// to rounding.
pub(crate) fn width_rounding<R: Real>(number: usize) -> f64 {
    4.0 * R::EPSILON * FIRST_ROUNDINGS * pow(NOISE_GROWTH, number as f64 - 1.0)
}

/// A number to an integer power.
fn power<R: Real>(base: R, exponent: usize) -> R {
    let (mut result, mut factor, mut left) = (R::of(1.0), base, exponent);
    while left > 0 {
        if left % 2 == 1 {
            result = result * factor;
        }
        factor = factor * factor;
        left /= 2;
    }
    result
}

/// The determinant of the derivative around an orbit of `impacts` impacts; zero if it underflows.
fn determinant<R: Real>(restitution: R, impacts: usize) -> R {
    let tiny = pow(restitution.value(), 2.0 * impacts as f64) < 1.0e-60;
    if tiny { R::of(0.0) } else { power(restitution, 2 * impacts) }
}

/// The quantity that is kept fixed while an orbit is corrected.
#[derive(Debug, Clone, Copy)]
enum Held<R> {
    /// The peak acceleration.
    Peak,
    /// The distance between an impact and the one half a period later.
    Amplitude(R, usize),
}

/// Newton's iteration for an orbit, to the accuracy that rounding allows.
fn settle<R: Real>(
    (mut times, mut peak): (ImpactTimes<R>, R),
    restitution: R,
    held: Held<R>,
    tick: Tick<'_>,
) -> Result<(ImpactTimes<R>, R, Equations<R>), Error> {
    let n = times.len();
    let mut last = f64::INFINITY;
    for iterations in 1..=MAX_NEWTON_STEPS {
        tick(n as u64)?;
        let equations = times.equations(peak, restitution);
        let residual = equations.worst;
        let lost = Error::NotSettled { what: "orbit of a cascade", iterations, residual };
        if !equations.are_of_flights() {
            return Err(lost);
        }
        let scale = peak.value() * (1.0 + restitution.value())
            + equations.flights.iter().fold(0.0_f64, |most, flight| most.max(flight.1));
        if residual <= LEFT_BY_ROUNDING * R::EPSILON * scale && residual >= 0.5 * last || residual == 0.0 {
            return Ok((times, peak, equations));
        }
        last = residual;
        let correction = equations.corrected();
        let step = match held {
            Held::Peak => R::of(0.0),
            Held::Amplitude(amplitude, at) => {
                let later = (at + n / 2) % n;
                let distance = |values: &[R]| values[later] - values[at];
                let missing = amplitude - distance(&times.phases) - distance(&correction.by_residual);
                missing / distance(&correction.by_peak)
            }
        };
        peak = peak + step;
        let changes = correction.by_residual.iter().zip(&correction.by_peak);
        for (phase, (&own, &by_peak)) in times.phases.iter_mut().zip(changes) {
            *phase = *phase + own + step * by_peak;
        }
        let sound = peak > R::of(0.0) && times.phases.iter().all(|phase| phase.value().abs() < 100.0);
        if !sound {
            return Err(lost);
        }
    }
    Err(Error::NotSettled { what: "orbit of a cascade", iterations: MAX_NEWTON_STEPS, residual: last })
}

/// The root of a function that falls from `above` at 0 through zero, by regula falsi with the weights of
/// Anderson and Bjorck.
struct Bracket<R> {
    low: (R, R),
    high: (R, R),
}

impl<R: Real> Bracket<R> {
    fn next(&self) -> R {
        let ((a, f), (b, g)) = (self.low, self.high);
        a + (b - a) * (f / (f - g))
    }

    /// Narrows the bracket by a value; the value at an end that stays for a second time is reduced.
    fn narrow(&mut self, at: R, value: R) {
        let zero = R::of(0.0);
        let weight = |old: R| {
            let share = R::of(1.0) - value / old;
            if share > zero { share } else { R::of(0.5) }
        };
        if value > zero {
            self.high.1 = self.high.1 * weight(self.low.1);
            self.low = (at, value);
        } else {
            self.low.1 = self.low.1 * weight(self.high.1);
            self.high = (at, value);
        }
    }
}

/// 1 + trace + determinant: (1 + m1)(1 + m2).
fn flip_function<R: Real>(equations: &Equations<R>, determinant: R) -> R {
    equations.trace() + determinant + R::of(1.0)
}

/// The first doubling, of the orbit with one impact per period of the platform.
pub(crate) fn first_flip<R: Real>(restitution: R, tick: Tick<'_>) -> Result<FlipPoint<R>, Error> {
    let one = R::of(1.0);
    let r = restitution.value();
    let determinant = determinant(restitution, 1);
    let threshold = core::f64::consts::PI * (1.0 - r) / (1.0 + r);
    let known = 2.0 * (1.0 + r * r) / ((1.0 + r) * (1.0 + r));
    let expected = (threshold * threshold + known * known).sqrt();
    // The search begins at the closed form in doubles, but its result does not depend on it.
    let at = |peak: R, tick: Tick<'_>| {
        let phase = R::of(acos((threshold / peak.value()).min(1.0)));
        let seed = ImpactTimes { phases: vec![phase], periods: vec![1] };
        let (times, _, equations) = settle((seed, peak), restitution, Held::Peak, tick)?;
        let flip = flip_function(&equations, determinant);
        Ok::<_, Error>((times, flip))
    };
    let low = threshold + 0.97 * (expected - threshold);
    let (low, high) = (R::of(low), R::of(expected + 0.03 * (expected - threshold)));
    let mut bracket = Bracket { low: (low, at(low, tick)?.1), high: (high, at(high, tick)?.1) };
    let mut last = low;
    for _ in 0..MAX_STEPS {
        let peak = bracket.next();
        let (times, flip) = at(peak, tick)?;
        let still = (peak - last).magnitude().value() <= R::EPSILON * peak.value();
        if still || flip.value() == 0.0 {
            // m1 + m2 = trace, m1 m2 = r^2: near the flip 1 + m1 is the flip function over 1 + m2.
            let multiplier = flip / (one - determinant) - one;
            return Ok(FlipPoint { times, peak, multiplier, width: R::of(0.0) });
        }
        last = peak;
        bracket.narrow(peak, flip);
    }
    Err(unsettled(bracket.high.1))
}

fn unsettled<R: Real>(residual: R) -> Error {
    Error::NotSettled {
        what: "search of a period doubling",
        iterations: MAX_STEPS,
        residual: residual.value(),
    }
}

/// The orbits of twice the period, born at a doubling.
struct DoubledBranch<'p, R> {
    at_birth: &'p FlipPoint<R>,
    direction: Vec<R>,
    widest: usize,
    restitution: R,
    determinant: R,
}

/// A doubled orbit at one amplitude.
struct Doubled<R> {
    times: ImpactTimes<R>,
    peak: R,
    flip: R,
}

impl<R: Real> DoubledBranch<'_, R> {
    fn at(&self, amplitude: R, from: Option<&Doubled<R>>, tick: Tick<'_>) -> Result<Doubled<R>, Error> {
        let n = self.at_birth.times.len();
        let seed = match from {
            // The distances from the centre grow with the amplitude.
            Some(known) => {
                let now = known.times.phases[self.widest + n] - known.times.phases[self.widest];
                let share = R::of(0.5) * amplitude / now;
                let mut times = known.times.clone();
                for i in 0..n {
                    let (a, b) = (known.times.phases[i], known.times.phases[i + n]);
                    let (middle, part) = (R::of(0.5) * (a + b), share * (b - a));
                    (times.phases[i], times.phases[i + n]) = (middle - part, middle + part);
                }
                (times, known.peak)
            }
            None => {
                let half = R::of(0.5) * amplitude;
                let phases = |sign: f64| {
                    let moved = self.at_birth.times.phases.iter().zip(&self.direction);
                    moved.map(move |(&phase, &change)| phase + R::of(sign) * half * change)
                };
                let phases = phases(-1.0).chain(phases(1.0)).collect();
                (ImpactTimes { phases, periods: self.at_birth.times.periods.repeat(2) }, self.at_birth.peak)
            }
        };
        let held = Held::Amplitude(amplitude, self.widest);
        let (times, peak, equations) = settle(seed, self.restitution, held, tick)?;
        Ok(Doubled { times, peak, flip: flip_function(&equations, self.determinant) })
    }
}

/// The doubling after `before`, the `number`th of the cascade (the first is 1).
pub(crate) fn next_flip<R: Real>(
    before: &FlipPoint<R>,
    number: usize,
    restitution: R,
    tick: Tick<'_>,
) -> Result<FlipPoint<R>, Error> {
    let (zero, one) = (R::of(0.0), R::of(1.0));
    let n = before.times.len();
    let equations = before.times.equations(before.peak, restitution);
    let (direction, widest) = equations.flipping_direction();
    let determinant = determinant(restitution, 2 * n);
    let branch = DoubledBranch { at_birth: before, direction, widest, restitution, determinant };
    // The squared amplitude at which to evaluate the flip function, from the previous doubling.
    let mut square = if before.width > zero {
        before.width * before.width * R::of(SHARE_OF_LAST)
    } else {
        R::of(FIRST_AMPLITUDE * FIRST_AMPLITUDE)
    };
    let mut halvings = 0;
    let mut known = loop {
        match branch.at(square.sqrt(), None, tick) {
            // An amplitude beyond the next doubling is also fine, as long as the branch reaches it.
            Ok(doubled) => break doubled,
            Err(stopped @ Error::Stopped { .. }) => return Err(stopped),
            Err(error) if halvings == MAX_HALVINGS => return Err(error),
            Err(_) => {
                halvings += 1;
                square = square * R::of(0.25);
            }
        }
    };
    // At the birth the multiplier is 1: the flip function is known there, 2 (1 + r^2n).
    let mut bracket = Bracket { low: (zero, R::of(2.0) * (one + determinant)), high: (square, known.flip) };
    let mut steps = 0;
    while bracket.high.1 > zero {
        // Beyond the end of the straight line through both values.
        let ((a, f), (b, g)) = (bracket.low, bracket.high);
        let reach = if f > g { b + (b - a) * (g / (f - g)) * R::of(1.05) } else { b * R::of(2.0) };
        let reach = if reach > b * R::of(4.0) { b * R::of(4.0) } else { reach };
        steps += 1;
        if steps > MAX_STEPS {
            return Err(unsettled(g));
        }
        match branch.at(reach.sqrt(), Some(&known), tick) {
            Ok(doubled) => {
                bracket = Bracket { low: bracket.high, high: (reach, doubled.flip) };
                known = doubled;
            }
            Err(error) => return Err(error),
        }
    }
    let tolerance = 0.125 * rounding::<R>(number);
    let mut last = zero;
    for _ in 0..MAX_STEPS {
        let square = bracket.next();
        let doubled = branch.at(square.sqrt(), Some(&known), tick)?;
        let still = (doubled.peak - last).magnitude().value() <= tolerance * doubled.peak.value();
        if still || doubled.flip.value() == 0.0 {
            if doubled.peak <= before.peak {
                return Err(unsettled(before.peak - doubled.peak));
            }
            let Doubled { times, peak, flip } = doubled;
            let phases = &times.phases;
            let mut width = zero;
            for i in 0..n {
                let distance = (phases[i + n] - phases[i]).magnitude();
                width = if distance > width { distance } else { width };
            }
            return Ok(FlipPoint { times, peak, multiplier: flip / (one - determinant) - one, width });
        }
        last = doubled.peak;
        bracket.narrow(square, doubled.flip);
        known = doubled;
    }
    Err(unsettled(bracket.high.1))
}

impl<R: Real> FlipPoint<R> {
    /// The smallest graze margin of its flights, in units of g/omega^2, after a check that the certified
    /// solver finds the same flights, so that none hits the platform earlier.
    pub(crate) fn graze_margin(&self, restitution: R) -> Result<f64, Error> {
        let vibration = Vibration::new(self.peak.value())?;
        let equations = self.times.equations(self.peak, restitution);
        let mut smallest = f64::INFINITY;
        for (index, (phase, &(speed, sought))) in self.times.phases.iter().zip(&equations.flights).enumerate()
        {
            let launch = Launch::new(Phase::new(phase.value())?, speed)?;
            let impact = vibration.first_impact(launch)?;
            let found = impact.duration();
            let same = (found - sought).abs() <= SAME_FLIGHT * sought;
            if !same {
                return Err(Error::EarlierImpact { index, sought, found });
            }
            smallest = smallest.min(vibration.graze_margin(launch, &impact));
        }
        Ok(smallest)
    }
}
