//! How a disk turns on a periodic orbit of the vertical motion, stable or unstable: its steady spin and the
//! rotary multiplier (docs/numerics-dynamics.md, "The spin on a periodic orbit").

use bouncing_disk_core::orbits::PeriodicOrbit;
use bouncing_disk_core::{Error as CoreError, Phase};

use crate::error::{Error, all_finite};
use crate::motion::impact::{available_impulse, axial_impulse};
use crate::motion::state::SlipDirection;
use crate::parameters::dimensionless::DimensionlessSystem;

/// The fate of the spin of a disk on a periodic orbit.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum RotaryOutcome {
    /// From any spin the disk reaches this steady one in finitely many impacts: the rotary multiplier is 0.
    Steady(RotaryResponse),
    /// The load exactly balances the largest impulse that friction can exert in a period of the orbit. A disk
    /// that slides through every impact in the direction in which the load drives it keeps its spin: such
    /// spins form a continuum, and the rotary multiplier is 1.
    Kept {
        /// The end of the continuum: the angular speed before the first impact of the orbit, in units of g
        /// a_e/(a_g^2 omega). Under a positive load all slower spins are kept, under a negative one all
        /// faster ones. `None` without friction and load: every spin is kept.
        limit: Option<f64>,
    },
    /// The load exceeds friction: no spin repeats.
    Runaway {
        /// The change of the angular speed in one period of the orbit once every impact slides, in units of
        /// g a_e/(a_g^2 omega).
        change: f64,
    },
}

impl RotaryOutcome {
    /// The rotary multiplier of the orbit, 0 or 1; `None` if no spin repeats.
    #[must_use]
    pub const fn multiplier(&self) -> Option<f64> {
        match self {
            Self::Steady(_) => Some(0.0),
            Self::Kept { .. } => Some(1.0),
            Self::Runaway { .. } => None,
        }
    }

    /// The steady spin, if there is one.
    #[must_use]
    pub const fn steady(&self) -> Option<&RotaryResponse> {
        match self {
            Self::Steady(response) => Some(response),
            Self::Kept { .. } | Self::Runaway { .. } => None,
        }
    }
}

/// The steady spin on a periodic orbit; each list has one entry per impact.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RotaryResponse {
    /// The disk's angular speed just before each impact, in units of g a_e/(a_g^2 omega).
    pub angular_speeds: Vec<f64>,
    /// Disk minus platform just before each impact, the paper's w_T, in the same units.
    pub slips: Vec<f64>,
    /// The direction of the slip after each impact; `None` if the impact ends the slip, as at least one does.
    pub sliding: Vec<Option<SlipDirection>>,
    /// The largest margin with which an impact ends the slip: the available angular impulse minus the needed
    /// one, in the same units. A smaller disturbance of the spin is forgotten within one period of the orbit.
    /// The margin is zero at a parameter where sticking gives way to sliding.
    pub stick_margin: f64,
    /// The mean angular speed, in the same units.
    pub mean_angular_speed: f64,
}

impl RotaryResponse {
    /// The number of impacts that end the slip.
    #[must_use]
    pub fn sticking_impacts(&self) -> usize {
        self.sliding.iter().filter(|slides| slides.is_none()).count()
    }
}

/// One period of a periodic orbit with some spin.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RotaryRound {
    /// The angular speed before the first impact of the next period, in units of g a_e/(a_g^2 omega).
    pub angular_speed: f64,
    /// The number of impacts that end the slip. If there are none, the derivative of this angular speed with
    /// respect to the speed one period earlier is 1, otherwise 0.
    pub sticking_impacts: usize,
}

/// The rotary speed of a period-1 orbit with impacts at `impact_phase`, Eq. 16: the platform's own speed
/// there, Q cos(tau_imp + theta), in units of g a_e/(a_g^2 omega).
///
/// It is largest, Q, for a phase lag theta = -tau_imp.
#[must_use]
pub fn period_one_rotary_speed(system: &DimensionlessSystem, impact_phase: Phase) -> f64 {
    system.platform_angular_speed(impact_phase)
}

/// The fate of the spin of a disk on `orbit`, a periodic orbit of the vertical motion of `system`, stable or
/// unstable.
///
/// ```
/// use bouncing_disk::parameters::ForcingParameters;
/// use bouncing_disk::toss::{period_one_rotary_speed, rotary_response};
///
/// let system = ForcingParameters { axial_forcing: 0.45, angular_forcing: 1.0, phase_lag: 0.3, restitution: 0.5 }.build()?;
/// let pair = system.map().period_one_pair(1).expect("born at 1/3");
/// // On the saddle, which no motion approaches by itself, the disk also turns according to Eq. (16).
/// let saddle = pair.saddle.orbit(system.map())?.expect("admissible");
/// let outcome = rotary_response(&system, &saddle)?;
/// let spin = outcome.steady().expect("no load");
/// assert_eq!(spin.angular_speeds, [period_one_rotary_speed(&system, pair.saddle.state.phase())]);
/// assert_eq!(outcome.multiplier(), Some(0.0));
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
///
/// # Errors
/// [`Error::NotAnOrbit`] if `orbit` is not an orbit of this system; [`Error::OutOfRange`] if it is empty; the
/// errors of [`ImpactMap::step`](crate::core::ImpactMap::step).
pub fn rotary_response(system: &DimensionlessSystem, orbit: &PeriodicOrbit) -> Result<RotaryOutcome, Error> {
    Ok(SpinMap::of(system, orbit)?.outcome())
}

/// One period of `orbit` for a disk that has this angular speed (in units of g a_e/(a_g^2 omega)) before its
/// first impact.
///
/// # Errors
/// The errors of [`rotary_response`]; [`Error::OutOfRange`] for a speed that is not finite.
pub fn rotary_round(
    system: &DimensionlessSystem,
    orbit: &PeriodicOrbit,
    angular_speed: f64,
) -> Result<RotaryRound, Error> {
    all_finite([("angular_speed", angular_speed)])?;
    let map = SpinMap::of(system, orbit)?;
    let (mut speed, mut sticking_impacts) = (angular_speed, 0);
    for index in 0..map.len() {
        let (after, slides) = map.impact(index, speed);
        sticking_impacts += usize::from(slides.is_none());
        speed = after - map.lost(index);
    }
    Ok(RotaryRound { angular_speed: speed, sticking_impacts })
}

/// The rotary part of the next-collision map around one orbit: everything that does not depend on the spin.
#[derive(Debug, Clone)]
struct SpinMap {
    /// The flight after each impact (rad).
    durations: Vec<f64>,
    /// The largest angular impulse of friction in each impact.
    available: Vec<f64>,
    /// The platform's angular speed at each impact.
    platform_speeds: Vec<f64>,
    friction: f64,
    load: f64,
    /// The impacts by decreasing `available`: the most likely to end the slip come first.
    order: Vec<usize>,
}

impl SpinMap {
    /// The map for an orbit, after a check that it is one of this system.
    fn of(system: &DimensionlessSystem, orbit: &PeriodicOrbit) -> Result<Self, Error> {
        system.map().check_orbit(orbit).map_err(|error| match error {
            CoreError::NotAnOrbit { impact, distance } => Error::NotAnOrbit { impact, distance },
            CoreError::OutOfRange { field, value, legal } => Error::OutOfRange { field, value, legal },
            error => error.into(),
        })?;
        let states = &orbit.states;
        let mut durations = Vec::with_capacity(states.len());
        for state in states {
            durations.push(system.map().step(*state)?.duration());
        }
        let friction = system.friction();
        let available: Vec<f64> = states
            .iter()
            .map(|state| available_impulse(friction, axial_impulse(system.restitution(), state.velocity())))
            .collect();
        let mut order: Vec<usize> = (0..states.len()).collect();
        order.sort_by(|a, b| available[*b].total_cmp(&available[*a]));
        let platform_speeds =
            states.iter().map(|state| system.platform_angular_speed(state.phase())).collect();
        Ok(Self { durations, available, platform_speeds, friction, load: system.load(), order })
    }

    fn len(&self) -> usize {
        self.durations.len()
    }

    /// The angular speed that the load takes away in the flight after an impact.
    fn lost(&self, index: usize) -> f64 {
        self.load * self.durations[index]
    }

    /// The angular speed after an impact met at this `speed`, and the direction of the remaining slip.
    fn impact(&self, index: usize, speed: f64) -> (f64, Option<SlipDirection>) {
        let slip = speed - self.platform_speeds[index];
        let available = self.available[index];
        if slip.abs() <= available {
            return (self.platform_speeds[index], None);
        }
        // Here the slip exceeds the available impulse, so it is not zero.
        let direction = if slip > 0.0 { SlipDirection::Forward } else { SlipDirection::Backward };
        (speed - direction.sign() * available, Some(direction))
    }

    /// The amount by which the impulse needed to end the slip at the impact `stuck` exceeds the available one,
    /// after the disk has turned with the platform there and gone around the orbit once. For the steady spin it
    /// is zero or negative.
    fn excess(&self, stuck: usize) -> f64 {
        let mut speed = self.platform_speeds[stuck];
        let mut index = stuck;
        loop {
            speed -= self.lost(index);
            index = (index + 1) % self.len();
            if index == stuck {
                return (speed - self.platform_speeds[stuck]).abs() - self.available[stuck];
            }
            speed = self.impact(index, speed).0;
        }
    }

    /// An impact that ends the slip in the steady spin, for a load below friction. At least one does; if
    /// rounding denies this for all of them, the closest one.
    fn sticking(&self) -> usize {
        let mut best = (f64::INFINITY, self.order[0]);
        for index in self.order.iter().copied() {
            let excess = self.excess(index);
            if excess <= 0.0 {
                return index;
            }
            if excess < best.0 {
                best = (excess, index);
            }
        }
        best.1
    }

    /// The steady spin, for a load below friction.
    fn steady(&self) -> RotaryResponse {
        let count = self.len();
        let stuck = self.sticking();
        let mut response = RotaryResponse {
            angular_speeds: vec![0.0; count],
            slips: vec![0.0; count],
            sliding: vec![None; count],
            stick_margin: 0.0,
            mean_angular_speed: 0.0,
        };
        let (mut speed, mut index) = (self.platform_speeds[stuck], stuck);
        let (mut turned, mut time) = (0.0, 0.0);
        for _ in 0..count {
            let duration = self.durations[index];
            turned += (speed - 0.5 * self.lost(index)) * duration;
            time += duration;
            speed -= self.lost(index);
            index = (index + 1) % count;
            response.angular_speeds[index] = speed;
            response.slips[index] = speed - self.platform_speeds[index];
            let (after, slides) =
                if index == stuck { (self.platform_speeds[stuck], None) } else { self.impact(index, speed) };
            if slides.is_none() {
                let margin = self.available[index] - response.slips[index].abs();
                response.stick_margin = response.stick_margin.max(margin);
            }
            response.sliding[index] = slides;
            speed = after;
        }
        response.mean_angular_speed = turned / time;
        response
    }

    fn outcome(&self) -> RotaryOutcome {
        let (load, friction) = (self.load, self.friction);
        if load.abs() > friction {
            let given: f64 = self.available.iter().fold(0.0, |sum, available| sum + available);
            let taken = (0..self.len()).fold(0.0, |sum, index| sum + self.lost(index));
            return RotaryOutcome::Runaway { change: given * load.signum() - taken };
        }
        if load.abs() >= friction {
            return RotaryOutcome::Kept { limit: (friction > 0.0).then(|| self.kept_limit()) };
        }
        RotaryOutcome::Steady(self.steady())
    }

    /// The limit of [`RotaryOutcome::Kept`].
    fn kept_limit(&self) -> f64 {
        let sign = self.load.signum();
        let (mut gained, mut limit) = (0.0, f64::INFINITY);
        for index in 0..self.len() {
            let edge = sign * self.platform_speeds[index] - self.available[index] - gained;
            limit = limit.min(edge);
            gained += self.available[index] - self.lost(index).abs();
        }
        sign * limit
    }
}

#[cfg(test)]
mod tests;
