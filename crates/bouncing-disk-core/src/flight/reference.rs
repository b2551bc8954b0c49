//! A second, independent solver of Eq. (11), for cross-checks: slow and simple, it shares only the equation
//! with [`Vibration::first_impact`].
//!
//! It walks from the launch in steps that cannot jump over a zero of the gap (conservative advancement),
//! until a single zero is isolated, and refines it with Brent's method of the `roots` crate.

use roots::{Convergency, find_root_brent};

use crate::flight::first_impact::MAX_FLIGHT_DURATION;
use crate::flight::launch::Launch;
use crate::flight::platform::vibration::Vibration;
use crate::numerics::elementary::{sin, sin_cos, wrapped_angle};
use crate::numerics::error::Error;

/// Steps after which the walk reports [`Error::NoConvergence`].
const MAX_STEPS: u32 = 1_000_000;

/// Conservative steps are shortened by this share, far more than their rounding.
const STEP_SHARE: f64 = 1.0 - 1.0e-9;

/// Relative difference below which two times (rad) are equal: four units in the last place.
const TIME_TOLERANCE: f64 = 4.0 * f64::EPSILON;

/// Iterations after which Brent's method gives up; bisection alone needs about 60.
const MAX_ITERATIONS: usize = 300;

/// The first impact according to the reference solver.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ReferenceImpact {
    /// Duration of the flight in radians. It is rounded to one double, even for a long flight.
    pub duration: f64,
    /// Phase of the impact in radians, in [0, 2 pi).
    pub impact_phase: f64,
    /// Relative axial velocity w_A just before the impact, <= 0, in units of g/omega.
    pub velocity: f64,
    /// Evaluations of the gap.
    pub evaluations: u32,
}

/// The gap and its derivatives at one time.
#[derive(Clone, Copy)]
struct Sample {
    gap: f64,
    velocity: f64,
    /// P sin and P cos of the phase.
    platform: f64,
    third: f64,
}

/// The gap counted from the launch, w h - h^2/2 + P [sin tau (1 - cos h) + cos tau (h - sin h)].
struct Gap {
    peak: f64,
    speed: f64,
    sine: f64,
    cosine: f64,
    evaluations: u32,
}

impl Gap {
    fn at(&mut self, h: f64) -> Sample {
        self.evaluations += 1;
        let (s, c) = sin_cos(h);
        let half = sin(0.5 * h);
        let versine = 2.0 * half * half;
        let sine = self.peak * self.sine;
        let cosine = self.peak * self.cosine;
        Sample {
            gap: h * (self.speed - 0.5 * h) + (sine * versine + cosine * deficit(h, s)),
            velocity: (self.speed - h) + (sine * s + cosine * versine),
            platform: sine * c + cosine * s,
            third: cosine * c - sine * s,
        }
    }
}

/// h - sin h, with relative accuracy.
fn deficit(h: f64, sine: f64) -> f64 {
    if h > 1.0 {
        return h - sine;
    }
    let z = h * h;
    let mut rest = 1.0;
    for k in (2..=10).rev() {
        let k = 2.0 * f64::from(k);
        rest = 1.0 - rest * z / (k * (k + 1.0));
    }
    h * z * rest / 6.0
}

/// The end of the parabola gap + velocity s - bend s^2/2, which lies below the true gap until then.
fn parabola_end(gap: f64, velocity: f64, bend: f64) -> f64 {
    if bend <= 0.0 {
        return if velocity >= 0.0 { f64::INFINITY } else { -gap / velocity };
    }
    let root = (velocity * velocity + 2.0 * bend * gap).sqrt();
    if velocity >= 0.0 { (velocity + root) / bend } else { 2.0 * gap / (root - velocity) }
}

impl Sample {
    /// A step that cannot reach a zero. The curvature of the gap, P sin - 1, is never below -(1 + P), and
    /// over a step s not below P sin - P |cos| s - P s^2/2 - 1. The latter bound is better if the platform
    /// almost falls freely.
    fn safe_step(&self, peak: f64) -> f64 {
        let mut best = parabola_end(self.gap, self.velocity, 1.0 + peak);
        let mut reach = best;
        for _ in 0..8 {
            reach *= 4.0;
            let bend = (1.0 - self.platform) + (self.third.abs() + 0.5 * peak * reach) * reach;
            let step = parabola_end(self.gap, self.velocity, bend).min(reach);
            if step <= best {
                break;
            }
            best = step;
        }
        best * STEP_SHARE
    }

    /// Whether the gap certainly falls during the next `time`: its curvature is at most P - 1.
    fn falls_for(&self, time: f64, peak: f64) -> bool {
        self.velocity + (peak - 1.0).max(0.0) * time < 0.0
    }
}

/// The stopping criterion of Brent's method: an exact zero, or a bracket as narrow as the resolution of
/// doubles. There is no tolerance on the gap itself: at motor scale any absolute one is wrong.
struct ExactOrNarrow;

impl Convergency<f64> for ExactOrNarrow {
    fn is_root_found(&mut self, gap: f64) -> bool {
        gap == 0.0
    }

    fn is_converged(&mut self, x1: f64, x2: f64) -> bool {
        (x1 - x2).abs() <= TIME_TOLERANCE * x1.abs().max(x2.abs())
    }

    fn is_iteration_limit_reached(&mut self, iteration: usize) -> bool {
        iteration >= MAX_ITERATIONS
    }
}

/// The first impact after `launch`, by conservative advancement and Brent's method.
///
/// For cross-checks of [`Vibration::first_impact`]: it takes tens to thousands of evaluations of the gap, and
/// its phase carries the rounding of the whole duration. The first zero is certain up to this rounding.
///
/// # Errors
/// [`Error::NoLiftOff`] for a launch from rest while the platform does not fall away,
/// [`Error::FlightTooLong`] beyond [`MAX_FLIGHT_DURATION`], [`Error::NoConvergence`] if the steps run out.
pub fn first_impact_by_advancement(vibration: &Vibration, launch: Launch) -> Result<ReferenceImpact, Error> {
    let peak = vibration.peak_acceleration();
    let (phase, speed) = (launch.phase(), launch.relative_speed());
    let climb = speed + 2.0 * peak + 4.0;
    if 2.0 * climb > MAX_FLIGHT_DURATION {
        return Err(Error::FlightTooLong {
            relative_speed: speed,
            duration: 2.0 * climb,
            limit: MAX_FLIGHT_DURATION,
        });
    }
    let mut gap = Gap { peak, speed, sine: phase.sin(), cosine: phase.cos(), evaluations: 0 };
    let mut h = if speed > 0.0 {
        2.0 * speed / (1.0 + peak) * STEP_SHARE
    } else if vibration.falls_away_at(phase.angle()) {
        // From rest the gap is convex, and so positive, until the platform retains the disk again.
        (vibration.retention_angle - phase.angle()) * STEP_SHARE
    } else {
        return Err(Error::NoLiftOff { phase: phase.angle(), peak_acceleration: peak });
    };
    loop {
        let sample = gap.at(h);
        // Twice the Newton step lies past the zero if the gap falls all the way.
        let ahead = -2.0 * sample.gap / sample.velocity;
        if sample.gap > 0.0 && sample.velocity < 0.0 && sample.falls_for(ahead, peak) {
            let end = h + ahead;
            if gap.at(end).gap <= 0.0 {
                return refined(&mut gap, h, end, phase.angle());
            }
        }
        let step = if sample.gap > 0.0 { sample.safe_step(peak) } else { 0.0 };
        if step <= TIME_TOLERANCE * h {
            // A graze: the gap is pure rounding error.
            return Ok(impact(&mut gap, h, phase.angle()));
        }
        if gap.evaluations >= MAX_STEPS {
            return Err(Error::NoConvergence { evaluations: gap.evaluations, time: h, gap: sample.gap });
        }
        h += step;
    }
}

/// The only zero in [`lo`, `hi`].
///
/// `find_root_brent` of `roots` 0.0.8 returns its last iterate but one after convergence, so the narrowest
/// bracket seen is used, not its answer.
fn refined(gap: &mut Gap, lo: f64, hi: f64, angle: f64) -> Result<ReferenceImpact, Error> {
    let (mut above, mut below) = ((lo, f64::INFINITY), (hi, f64::NEG_INFINITY));
    let found = find_root_brent(
        lo,
        hi,
        |h| {
            let value = gap.at(h).gap;
            if value > 0.0 {
                if h >= above.0 {
                    above = (h, value);
                }
            } else if h <= below.0 {
                below = (h, value);
            }
            value
        },
        &mut ExactOrNarrow,
    );
    if found.is_err() {
        return Err(Error::NoConvergence { evaluations: gap.evaluations, time: lo, gap: above.1 });
    }
    let h = if above.1 < -below.1 { above.0 } else { below.0 };
    Ok(impact(gap, h, angle))
}

fn impact(gap: &mut Gap, h: f64, angle: f64) -> ReferenceImpact {
    ReferenceImpact {
        duration: h,
        impact_phase: wrapped_angle(angle + h),
        velocity: gap.at(h).velocity.min(0.0),
        evaluations: gap.evaluations,
    }
}
