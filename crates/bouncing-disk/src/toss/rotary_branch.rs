//! The spin on a periodic orbit along a parameter that the vertical motion does not depend on: from one place
//! where stick and slip change to the next (docs/numerics/dynamics.md, "The spin on a periodic orbit").

use std::f64::consts::PI;

use bouncing_disk_core::elementary::{acos, atan2, hypot, sin_cos, wrapped_angle};
use bouncing_disk_core::{Observer, PeriodicOrbit, Unobserved, Watch, read_checked};

use crate::error::{Error, all_finite, check};
use crate::motion::state::SlipDirection;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::toss::rotary_response::{RotaryResponse, SpinMap};

/// Changes nearer to each other than this share of the range are one.
const RESOLUTION: f64 = 1.0e-9;

/// A parameter of the rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum RotaryParameter {
    /// The paper's Gamma_T, not negative; friction must not be zero.
    AngularForcing,
    /// The phase lag theta (rad).
    PhaseLag,
    /// The load torque in units of m g a_e, less than friction in size.
    Load,
}

impl RotaryParameter {
    /// The system with another value.
    fn applied(self, system: &DimensionlessSystem, value: f64) -> Result<DimensionlessSystem, Error> {
        let mut parameters = system.parameters();
        match self {
            Self::AngularForcing => parameters.twist_speed = PI * value * parameters.friction,
            Self::PhaseLag => parameters.phase_lag = value,
            Self::Load => parameters.load = value,
        }
        parameters.build()
    }
}

/// A range of the parameter over which the same impacts stick and slide: the spin depends on the parameter
/// linearly there, for the phase lag as a sinusoid.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RotaryPiece {
    /// Where it begins.
    pub low: f64,
    /// Where it ends: an impact begins or ceases to stick, or the range is at its end.
    pub high: f64,
    /// The slip that each impact leaves; `None` where it sticks.
    pub sliding: Vec<Option<SlipDirection>>,
}

/// The spin on a periodic orbit over a range of a parameter.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedBranch"))]
pub struct RotaryBranch {
    /// What is varied.
    pub parameter: RotaryParameter,
    /// The pieces by rising parameter; each begins where the one before ends.
    pub pieces: Vec<RotaryPiece>,
}

read_checked!(RotaryBranch as UncheckedBranch { parameter: RotaryParameter, pieces: Vec<RotaryPiece> });

impl RotaryBranch {
    /// Checks what is read.
    fn check(&self) -> Result<(), Error> {
        for piece in &self.pieces {
            all_finite([("low end of a piece", piece.low), ("high end of a piece", piece.high)])?;
            check(piece.high >= piece.low, "high end of a piece", piece.high, "not below its low end")?;
        }
        for pair in self.pieces.windows(2) {
            let gap = pair[1].low - pair[0].high;
            check(gap == 0.0, "gap between two pieces", gap, "none")?;
        }
        Ok(())
    }

    /// Where stick and slip change.
    pub fn changes(&self) -> impl Iterator<Item = f64> {
        self.pieces.iter().skip(1).map(|piece| piece.low)
    }
}

/// The spin on `orbit` while `parameter` goes from the first to the second end of a range, all else being
/// that of `system`. The vertical motion does not depend on the parameter, so that the orbit is the same
/// throughout, and no step has to be chosen: the next change of stick and slip is in closed form.
///
/// ```
/// use bouncing_disk::core::ImpactState;
/// use bouncing_disk::{ForcingParameters, RotaryParameter, rotary_branch};
///
/// let system = ForcingParameters { axial_forcing: 0.5, angular_forcing: 1.0, phase_lag: 0.0, restitution: 0.5 }.build()?;
/// let start = ImpactState::from_normalised(1.2, 1.3)?;
/// let orbit = system.map().settled_orbit(start, 1_000, 4, 1e-9)?.expect("two impacts");
/// // While the twist is weak both impacts stick, and the disk turns with the platform after each of them.
/// let branch = rotary_branch(&system, &orbit, RotaryParameter::AngularForcing, (0.0, 100.0))?;
/// assert_eq!(branch.pieces[0].sliding, [None, None]);
/// assert_eq!(branch.changes().count(), 1);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for an empty range, one that leaves that of the parameter, or no friction;
/// [`Error::Overpowered`] if the load is as large as friction; those of
/// [`rotary_response`](crate::rotary_response).
pub fn rotary_branch(
    system: &DimensionlessSystem,
    orbit: &PeriodicOrbit,
    parameter: RotaryParameter,
    range: (f64, f64),
) -> Result<RotaryBranch, Error> {
    rotary_branch_observed(system, orbit, parameter, range, &Unobserved)
}

/// [`rotary_branch`] with an observer; there is one item, the branch.
///
/// # Errors
/// Those of [`rotary_branch`]; [`crate::core::Error::Stopped`] if the observer breaks.
pub fn rotary_branch_observed(
    system: &DimensionlessSystem,
    orbit: &PeriodicOrbit,
    parameter: RotaryParameter,
    (low, high): (f64, f64),
    observer: &dyn Observer,
) -> Result<RotaryBranch, Error> {
    all_finite([("low end of a range", low), ("high end of a range", high)])?;
    check(high > low, "high end of a range", high, "above its low end")?;
    let friction = system.friction();
    check(friction > 0.0, "friction", friction, "(0, 1e100]")?;
    match parameter {
        RotaryParameter::AngularForcing => check(low >= 0.0, "angular_forcing", low, "[0, inf)")?,
        RotaryParameter::Load => {
            let (legal, strongest) = ("less than friction in size", if -low > high { low } else { high });
            check(strongest.abs() < friction, "load", strongest, legal)?
        }
        RotaryParameter::PhaseLag => low,
    };
    if parameter != RotaryParameter::Load && system.load().abs() >= friction {
        return Err(Error::Overpowered { load: system.load() });
    }
    let watch = Watch::begin(observer, 0, 1)?;
    let mut work = watch.work();
    parameter.applied(system, high)?;
    let mut map = SpinMap::of(&parameter.applied(system, low)?, orbit)?;
    let shift = RESOLUTION * (high - low);
    let mut pieces: Vec<RotaryPiece> = Vec::new();
    let (mut begin, mut stuck) = (low, None);
    while begin < high {
        work.spend(map.len() as u64)?;
        let inside = (begin + shift).max(begin.next_up()).min(high);
        let changed = parameter.applied(system, inside)?;
        map.turn(&changed);
        let response = map.steady(stuck);
        stuck = response.sliding.iter().position(Option::is_none);
        let end = next_change(&map, &changed, &response, parameter)
            .map_or(high, |distance| (inside + distance).min(high));
        match pieces.last_mut() {
            // A touch without a change.
            Some(last) if last.sliding == response.sliding => last.high = end,
            _ => pieces.push(RotaryPiece { low: begin, high: end, sliding: response.sliding }),
        }
        begin = end;
    }
    watch.end();
    Ok(RotaryBranch { parameter, pieces })
}

/// How far the next value of the parameter is at which an impact ceases or begins to stick.
fn next_change(
    map: &SpinMap,
    system: &DimensionlessSystem,
    response: &RotaryResponse,
    parameter: RotaryParameter,
) -> Option<f64> {
    let count = map.len();
    let start = response.sliding.iter().position(Option::is_none)?;
    // From impact to impact: the last one that stuck, and the time since.
    let (mut stuck, mut since) = (start, 0.0);
    let mut nearest: Option<f64> = None;
    for step in 1..=count {
        let index = (start + step) % count;
        since += map.durations[(start + step - 1) % count];
        let (slip, available) = (response.slips[index], map.available[index]);
        // The slips at which it changes between stick and slip.
        let ends = match response.sliding[index] {
            None => [available, -available],
            Some(direction) => [direction.sign() * available; 2],
        };
        let ((stuck_cosine, stuck_sine), (cosine, sine)) = (map.pairs[stuck], map.pairs[index]);
        // The difference of the platform's speeds at both impacts is Q (apart_cosine cos theta - apart_sine
        // sin theta).
        let (apart_cosine, apart_sine) = (stuck_cosine - cosine, stuck_sine - sine);
        let mut meets = |distance: f64| {
            if distance > 0.0 && nearest.is_none_or(|nearest| distance < nearest) {
                nearest = Some(distance);
            }
        };
        for end in ends {
            match parameter {
                RotaryParameter::AngularForcing => {
                    let (sin_lag, cos_lag) = sin_cos(system.phase_lag());
                    let slope = PI * map.friction * (apart_cosine * cos_lag - apart_sine * sin_lag);
                    meets((end - slip) / slope);
                }
                RotaryParameter::Load => meets((slip - end) / since),
                RotaryParameter::PhaseLag => {
                    let size = system.twist_speed() * hypot(apart_cosine, apart_sine);
                    let lead = atan2(apart_sine, apart_cosine);
                    let now = size * sin_cos(system.phase_lag() + lead).1;
                    let cosine = (end - slip + now) / size;
                    if cosine.abs() <= 1.0 {
                        for angle in [acos(cosine), -acos(cosine)] {
                            meets(wrapped_angle(angle - lead - system.phase_lag()));
                        }
                    }
                }
            }
        }
        if response.sliding[index].is_none() {
            (stuck, since) = (index, 0.0);
        }
    }
    nearest
}

#[cfg(test)]
mod tests;
