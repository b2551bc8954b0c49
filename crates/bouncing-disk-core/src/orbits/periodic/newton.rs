//! Newton's method for periodic orbits by multiple shooting: the refinement of a good guess, and the attempts
//! from rough guesses in the search for periodic orbits, which give up early.

use core::f64::consts::PI;

use glam::{DMat2, DVec2};

use super::margin::{SAME, next_to_margin};
use super::{MAX_NEWTON_STEPS, MAX_PERIOD, PeriodicOrbit, phase_difference};
use crate::flight::launch::Impact;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::block_cyclic::solve_block_cyclic;
use crate::numerics::error::{Error, within};
use crate::orbits::closing::{Closing, ContinuationParameter, Plane};
use crate::run::Tick;

/// A shooting residual (rad, units of g/omega, relative to the orbit's speeds) at which the orbit counts as
/// found.
const SHOOTING_RESIDUAL: f64 = 1.0e-12;

/// Largest number of Newton steps from a rough guess, after which [`ImpactMap::refine`] takes over or the
/// guess is abandoned.
pub(super) const MAX_STEPS: usize = 14;

/// The residual below which the iteration converges quadratically, so that the refinement takes over.
const NEAR: f64 = 1.0e-5;

/// The longest step of a phase (rad) from a rough guess. A longer one is shortened, together with all steps
/// of that iteration.
const LONGEST_STEP: f64 = 0.7;

/// One step of the multiple shooting.
#[derive(Debug)]
pub struct Shooting {
    /// The derivative of the map at each impact.
    pub derivatives: Vec<DMat2>,
    /// The distance by which the successor of each impact misses the next one; the step must cancel it.
    pub right: Vec<DVec2>,
    /// The derivative of the map around the orbit.
    pub monodromy: DMat2,
    /// Turns of the phase around the orbit.
    pub turns: u64,
    /// The largest distance of a successor from its target.
    pub worst: f64,
}

impl Shooting {
    /// The step from these impacts of a map given with its derivative; speeds count in units of `scale`.
    pub fn from(
        states: &[ImpactState],
        scale: f64,
        map: impl Fn(ImpactState) -> Result<(Impact, DMat2), Error>,
    ) -> Result<Self, Error> {
        let n = states.len();
        let mut shooting = Self {
            derivatives: Vec::with_capacity(n),
            right: Vec::with_capacity(n),
            monodromy: DMat2::IDENTITY,
            turns: 0,
            worst: 0.0,
        };
        let mut turns = 0;
        for (i, &state) in states.iter().enumerate() {
            let (impact, derivative) = map(state)?;
            shooting.monodromy = derivative * shooting.monodromy;
            turns += impact.turns as i64;
            let target = states[(i + 1) % n];
            let (landed, aimed) = (impact.phase.angle(), target.phase().angle());
            let phase = phase_difference(landed, aimed);
            // If the two lie on either side of the seam, the turn between them belongs to neither flight.
            if landed - aimed > PI {
                turns += 1;
            } else if aimed - landed > PI {
                turns -= 1;
            }
            let velocity = impact.velocity - target.velocity();
            shooting.worst = shooting.worst.max(phase.abs()).max(velocity.abs() / scale);
            shooting.derivatives.push(derivative);
            shooting.right.push(DVec2::new(-phase, -velocity));
        }
        shooting.turns = turns.max(0) as u64;
        Ok(shooting)
    }
}

const fn not_settled(iterations: u32, residual: f64) -> Error {
    Error::NotSettled { what: "multiple shooting", iterations, residual }
}

/// The impacts to which Newton's method converges, with their shooting. It stops when the residual is at most
/// `residual` and no longer shrinks. `stepped` may shorten a step, and returns `None` if numbers leave their
/// range. The tick counts impacts.
pub fn settled(
    guess: &[ImpactState],
    residual: f64,
    shoot: impl Fn(&[ImpactState]) -> Result<Shooting, Error>,
    stepped: impl Fn(&[ImpactState], &[DVec2]) -> Option<Vec<ImpactState>>,
    tick: Tick<'_>,
) -> Result<(Vec<ImpactState>, Shooting), Error> {
    let n = guess.len();
    within("period", n as f64, 1.0, MAX_PERIOD as f64, "[1, 4096] impacts")?;
    let (mut states, mut last) = (guess.to_vec(), f64::INFINITY);
    // The last result below the residual, in case a later step is worse: at the birth of an orbit the
    // derivative is singular.
    let mut found = None;
    for iterations in 1..=MAX_NEWTON_STEPS {
        tick(n as u64)?;
        let shooting = match shoot(&states) {
            Ok(shooting) => shooting,
            Err(error) => return found.ok_or(error),
        };
        let worst = shooting.worst;
        // Once the residual has stopped shrinking, a further step only changes rounding errors.
        if worst <= residual && worst >= 0.5 * last || worst == 0.0 {
            return Ok((states, shooting));
        }
        if worst > residual
            && let Some(found) = found
        {
            return Ok(found);
        }
        last = worst;
        let next = stepped(&states, &solve_block_cyclic(&shooting.derivatives, &shooting.right));
        found = (worst <= residual).then_some((states, shooting));
        states = match next {
            Some(next) => next,
            None => return found.ok_or(not_settled(iterations, last)),
        };
    }
    found.ok_or(not_settled(MAX_NEWTON_STEPS, last))
}

/// The unit of speeds in the residual of a shooting.
pub fn speed_scale(states: &[ImpactState]) -> f64 {
    1.0 + states.iter().fold(0.0_f64, |most, state| most.max(-state.velocity()))
}

/// The impacts, each after its step; `None` if numbers leave their range.
pub fn moved(states: &[ImpactState], steps: &[DVec2]) -> Option<Vec<ImpactState>> {
    let longest = steps.iter().fold(0.0_f64, |most, step| most.max(step.x.abs()));
    let share = if longest > LONGEST_STEP { LONGEST_STEP / longest } else { 1.0 };
    let moved = states.iter().zip(steps).map(|(state, step)| {
        let velocity = state.velocity() + share * step.y;
        // A step through speed zero is replaced by half of the way to zero.
        let velocity = if velocity < 0.0 { velocity } else { 0.5 * state.velocity() };
        ImpactState::new(Phase::new(state.phase().angle() + share * step.x)?, velocity)
    });
    moved.collect::<Result<_, _>>().ok()
}

/// The outcome of an attempt from a rough guess.
pub(super) enum Attempt {
    /// A periodic orbit within the limits that does not repeat a shorter one, its fastest impact first.
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

/// Whether two orbits count as one, whatever their first impacts: their regions of uncertainty overlap.
pub fn same_orbit(a: &PeriodicOrbit, b: &PeriodicOrbit) -> bool {
    let n = a.period();
    if n != b.period() || a.platform_periods != b.platform_periods {
        return false;
    }
    let room = a.position_error + b.position_error;
    (0..n).any(|shift| (0..n).all(|i| near(a.states[i], b.states[(i + shift) % n], room)))
}

/// The numbers of impacts, below the length, after which a sequence repeats itself within `room`, in
/// increasing order.
pub(crate) fn repetitions(states: &[ImpactState], room: f64) -> impl Iterator<Item = usize> {
    let n = states.len();
    let repeats = move |shift: usize| (0..n).all(|i| near(states[i], states[(i + shift) % n], room));
    (1..n).filter(move |shift| n.is_multiple_of(*shift) && repeats(*shift))
}

/// The number of impacts after which a sequence repeats itself within `room`.
pub fn prime_period(states: &[ImpactState], room: f64) -> usize {
    repetitions(states, room).next().unwrap_or(states.len())
}

/// The periodic orbit near a guess, with its least period. If the guess nearly repeats a shorter orbit, the
/// result is the shorter one, unless the guess leads to the doubled orbit near a doubling.
pub(crate) fn prime_orbit(
    guess: &[ImpactState],
    refine: impl Fn(&[ImpactState]) -> Result<PeriodicOrbit, Error>,
    determinant: impl Fn(&PeriodicOrbit) -> f64,
) -> Result<PeriodicOrbit, Error> {
    let prime = prime_period(guess, SAME);
    let mut orbit = refine(&guess[..prime])?;
    let (_, doubling) = next_to_margin(orbit.monodromy, determinant(&orbit));
    if doubling && guess.len().is_multiple_of(2 * prime) {
        orbit = refine(&guess[..2 * prime]).unwrap_or(orbit);
    }
    let repeated = prime_period(&orbit.states, 2.0 * orbit.position_error);
    if repeated < orbit.period() { refine(&orbit.states[..repeated]) } else { Ok(orbit) }
}

impl ImpactMap {
    /// The periodic orbit near `guess` (its impacts in order), by multiple shooting: every impact is an
    /// unknown, so that even long and unstable orbits converge.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an empty guess or one longer than [`MAX_PERIOD`]; [`Error::NotSettled`] if
    /// Newton's iteration does not converge; [`Error::ImpactWithoutSpeed`] and [`Error::NoPlatformPeriods`]
    /// if it converges to a disk at rest; errors of
    /// [`Vibration::first_impact`](crate::Vibration::first_impact).
    pub fn refine(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        self.refine_ticked(guess, &mut |_| Ok(()))
    }

    /// [`Self::refine`] as a part of a longer call; the tick counts impacts.
    pub(crate) fn refine_ticked(
        &self,
        guess: &[ImpactState],
        tick: Tick<'_>,
    ) -> Result<PeriodicOrbit, Error> {
        let scale = speed_scale(guess);
        let full_step = |states: &[ImpactState], steps: &[DVec2]| {
            let moved = states.iter().zip(steps).map(|(state, step)| {
                let angle = state.phase().angle() + step.x;
                ImpactState::new(Phase::new(angle)?, (state.velocity() + step.y).min(0.0))
            });
            moved.collect::<Result<_, Error>>().ok()
        };
        let shoot = |states: &[ImpactState]| self.shoot(states, scale);
        let (states, Shooting { monodromy, turns, worst, .. }) =
            settled(guess, SHOOTING_RESIDUAL, shoot, full_step, tick)?;
        let orbit = PeriodicOrbit {
            states,
            platform_periods: turns,
            monodromy,
            position_error: worst,
            trace_error: 0.0,
        };
        orbit.check_motion()?;
        self.exact_orbit(orbit).ok_or(not_settled(MAX_NEWTON_STEPS, worst))
    }

    pub(super) fn shoot(&self, states: &[ImpactState], scale: f64) -> Result<Shooting, Error> {
        Shooting::from(states, scale, |state| self.step_with_derivative(state))
    }

    /// Whether the disk provably comes to rest after this impact.
    pub(crate) fn rests_after(&self, state: ImpactState) -> bool {
        let speed = 0.0 - self.restitution() * state.velocity();
        self.vibration().accumulation(state.phase(), speed, self.restitution()).is_some()
    }

    /// [`prime_orbit`] for this map, which contracts areas by a known ratio.
    pub(crate) fn prime_orbit(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        prime_orbit(guess, |guess| self.refine(guess), |orbit| self.determinant_after(orbit.period()))
    }

    /// The periodic orbit near a rough guess.
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

    /// The impacts of a nearly closed orbit, by Newton steps from a guess; `None` if it does not converge.
    fn approached(&self, guess: &[ImpactState]) -> Option<Vec<ImpactState>> {
        let mut states = guess.to_vec();
        for _ in 0..MAX_STEPS {
            let shooting = self.shoot(&states, speed_scale(&states)).ok()?;
            if shooting.worst <= NEAR {
                return Some(states);
            }
            states = moved(&states, &solve_block_cyclic(&shooting.derivatives, &shooting.right))?;
        }
        None
    }

    /// The same with the smooth equations, which ignore earlier impacts and so do not jump like the map. The
    /// refinement shows whether the solution is an orbit of the map.
    fn approached_smoothly(&self, guess: &[ImpactState]) -> Option<Vec<ImpactState>> {
        let (closing, at) = Closing::of(self, ContinuationParameter::Forcing, guess).ok()?;
        let plane = Plane { normal: [0.0, 0.0, 1.0], base: closing.scaled(&at), distance: 0.0 };
        let (at, _) = closing.corrected(at, &plane)?;
        closing.states(&at)
    }
}
