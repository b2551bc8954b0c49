//! Newton's method from a rough guess, as the search for periodic orbits uses it: it gives up early.

use super::margin::{SAME, next_to_margin};
use super::{PeriodicOrbit, phase_difference};
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::block_cyclic::solve_block_cyclic;
use crate::numerics::error::Error;
use crate::orbits::closing::{Closing, ContinuationParameter, Plane};

/// Newton steps from a guess until [`ImpactMap::refine`] takes over or the guess is given up.
pub(super) const MAX_STEPS: usize = 14;

/// The residual from which the iteration converges quadratically: the refinement does the rest.
const NEAR: f64 = 1.0e-5;

/// The longest step of a phase (rad): a longer one is shortened, and all of that iteration with it.
const LONGEST_STEP: f64 = 0.7;

/// What became of a guess.
pub(super) enum Attempt {
    /// A periodic orbit within the limits that repeats no shorter one, its fastest impact first.
    Converged(PeriodicOrbit),
    /// A solution that is not an orbit.
    Refused,
    /// No solution.
    NotSettled,
}

/// Whether two impacts lie within this (rad, and relative speed) of each other.
fn near(a: ImpactState, b: ImpactState, room: f64) -> bool {
    phase_difference(a.phase().angle(), b.phase().angle()).abs() <= room
        && (a.velocity() - b.velocity()).abs() <= room * (1.0 + a.velocity().abs())
}

/// Whether two orbits count as one, wherever they begin: their regions of uncertainty meet.
pub(crate) fn same_orbit(a: &PeriodicOrbit, b: &PeriodicOrbit) -> bool {
    let n = a.period();
    if n != b.period() || a.platform_periods != b.platform_periods {
        return false;
    }
    let room = a.position_error + b.position_error;
    (0..n).any(|shift| (0..n).all(|i| near(a.states[i], b.states[(i + shift) % n], room)))
}

/// The number of impacts after which a sequence repeats itself within `room`.
pub(super) fn prime_period(states: &[ImpactState], room: f64) -> usize {
    let n = states.len();
    let repeats = |shift: usize| (0..n).all(|i| near(states[i], states[(i + shift) % n], room));
    (1..n).filter(|shift| n.is_multiple_of(*shift)).find(|shift| repeats(*shift)).unwrap_or(n)
}

impl ImpactMap {
    /// Whether an impact is proven to be followed by rest.
    pub(crate) fn rests_after(&self, state: ImpactState) -> bool {
        let speed = 0.0 - self.restitution() * state.velocity();
        self.vibration().accumulation(state.phase(), speed, self.restitution()).is_some()
    }

    /// The periodic orbit near a guess, once around: of a guess that nearly repeats itself the shorter orbit,
    /// unless that is next to its doubling and the guess leads to the doubled one.
    pub(crate) fn prime_orbit(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        let prime = prime_period(guess, SAME);
        let mut orbit = self.refine(&guess[..prime])?;
        let (_, doubling) = next_to_margin(orbit.monodromy, self.determinant_after(prime));
        if doubling && guess.len().is_multiple_of(2 * prime) {
            orbit = self.refine(&guess[..2 * prime]).unwrap_or(orbit);
        }
        let repeated = prime_period(&orbit.states, 2.0 * orbit.position_error);
        if repeated < orbit.period() { self.refine(&orbit.states[..repeated]) } else { Ok(orbit) }
    }

    /// The periodic orbit near a guess.
    pub(super) fn attempt(&self, guess: &[ImpactState], max_platform_periods: u64) -> Attempt {
        let Some(states) = self.approached(guess).or_else(|| self.approached_smoothly(guess)) else {
            return Attempt::NotSettled;
        };
        let mut orbit = match self.prime_orbit(&states) {
            Ok(orbit) => orbit,
            Err(Error::ImpactWithoutSpeed { .. } | Error::NoPlatformPeriods { .. }) => {
                return Attempt::Refused;
            }
            Err(_) => return Attempt::NotSettled,
        };
        let too_long = orbit.platform_periods > max_platform_periods;
        if too_long || orbit.states.iter().any(|&at| self.rests_after(at)) {
            return Attempt::Refused;
        }
        let prime = orbit.period();
        let fastest = (1..prime).fold(0, |fastest, i| {
            if orbit.states[i].velocity() < orbit.states[fastest].velocity() { i } else { fastest }
        });
        if fastest > 0 {
            orbit.states.rotate_left(fastest);
            // The derivative around the orbit, from its new first impact.
            match self.shoot(&orbit.states, 1.0) {
                Ok(shooting) => orbit.monodromy = shooting.monodromy,
                Err(_) => return Attempt::NotSettled,
            }
        }
        Attempt::Converged(orbit)
    }

    /// Impacts that nearly close to an orbit, by Newton steps from a guess; `None` if they do not.
    fn approached(&self, guess: &[ImpactState]) -> Option<Vec<ImpactState>> {
        let mut states = guess.to_vec();
        for _ in 0..MAX_STEPS {
            let scale = 1.0 + states.iter().fold(0.0_f64, |most, state| most.max(-state.velocity()));
            let shooting = self.shoot(&states, scale).ok()?;
            if shooting.worst <= NEAR {
                return Some(states);
            }
            let steps = solve_block_cyclic(&shooting.derivatives, &shooting.right);
            let longest = steps.iter().fold(0.0_f64, |most, step| most.max(step.x.abs()));
            let share = if longest > LONGEST_STEP { LONGEST_STEP / longest } else { 1.0 };
            for (state, step) in states.iter_mut().zip(&steps) {
                let phase = Phase::new(state.phase().angle() + share * step.x).ok()?;
                let own = state.velocity();
                // A step through speed zero goes half the way there.
                let velocity = own + share * step.y;
                *state = ImpactState::new(phase, if velocity < 0.0 { velocity } else { 0.5 * own }).ok()?;
            }
        }
        None
    }

    /// The same by the equations that do not ask whether an earlier impact forestalls a flight: where the map
    /// jumps they are smooth, and whether the solution is an orbit of the map is seen when it is refined.
    fn approached_smoothly(&self, guess: &[ImpactState]) -> Option<Vec<ImpactState>> {
        let (closing, at) = Closing::of(self, ContinuationParameter::Forcing, guess).ok()?;
        let plane = Plane { normal: [0.0, 0.0, 1.0], base: closing.scaled(&at), distance: 0.0 };
        let (at, _) = closing.corrected(at, &plane)?;
        closing.states(&at)
    }
}
