//! The trait of impact maps of any platform, as needed by the analyses.

use core::ops::ControlFlow;

use glam::DMat2;

use crate::chatter::policy::ChatterPolicy;
use crate::flight::launch::Impact;
use crate::map::impact_map::{ImpactMap, ImpactState, Orbit};
use crate::numerics::elementary::ln;
use crate::numerics::error::Error;
use crate::orbits::periodic::{PeriodicOrbit, check_repeats, repeats};
use crate::run::{Observer, Watch, in_parallel};
use crate::sweep::SweepEvent;

/// The number of factors e by which the area of a set of states must have shrunk before the behaviour of an
/// orbit counts as final.
pub(crate) const DISSIPATION_TIMES: f64 = 10.0;

/// The work of an event on a drive, in units of a flight above a sine.
const WORK_OF_EVENT: u64 = 16;

/// The vertical impact map of a disk on a platform: the sine's [`ImpactMap`](crate::ImpactMap), and the
/// `bouncing_disk_drives::DrivenMap` of other drives and of compliant contacts.
///
/// Verdicts, Lyapunov exponents and orbit diagrams accept any of them. If a map offers more (a closed form, a
/// certificate of rest, many flights at once), its methods replace the general ones.
pub trait BouncingMap: Clone + core::fmt::Debug + Send + Sync {
    /// The type of its orbits.
    type Orbit: BouncingOrbit;

    /// The number of orbits that are followed together if there may be millions.
    const TOGETHER: usize = 256;

    /// Coefficient of restitution, in [0, 1).
    fn restitution(&self) -> f64;

    /// The speed (units of g/omega) that counts as much as a radian in the distance between two impacts: the
    /// largest speed of the platform.
    fn speed_scale(&self) -> f64;

    /// The next impact after `state`, without any chattering policy.
    ///
    /// # Errors
    /// [`Error::NoLiftOff`] if the disk stays on the platform, and errors of a flight.
    fn step(&self, state: ImpactState) -> Result<Impact, Error>;

    /// [`Self::step`] with the derivative of the next (phase, velocity) with respect to the present one.
    ///
    /// # Errors
    /// Errors of [`Self::step`]; [`Error::ImpactOnKink`] if the map has no derivative.
    fn step_with_derivative(&self, state: ImpactState) -> Result<(Impact, DMat2), Error>;

    /// The orbit that starts with the impact in `state`; the first item is the next event.
    fn orbit(&self, state: ImpactState, policy: ChatterPolicy) -> Self::Orbit;

    /// The periodic orbit near `guess` (its impacts in order).
    ///
    /// # Errors
    /// [`Error::NotSettled`] and other errors of [`ImpactMap::refine`](crate::ImpactMap::refine).
    fn refine(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error>;

    /// Whether the disk is certain to chatter to rest after the impact in `state`.
    fn chatters_to_rest_after(&self, state: ImpactState) -> bool;

    /// The derivative at the impact `from`, with the next impact `to` after a flight of `duration` (rad), and
    /// a bound on the change of `to` due to rounding (rad and g/omega). If there is no derivative, its
    /// entries are NaN and the bound is infinite.
    fn derivative(&self, from: ImpactState, to: ImpactState, duration: f64) -> (DMat2, f64);

    /// A bound on the rounding error of the phase (rad) at which a resting disk separates.
    fn separation_error(&self) -> f64;

    /// Whether every impact contracts an area of (phase, velocity) by exactly r^2 v/v', with the velocities v
    /// before and v' after the flight: then the Lyapunov exponents have a known sum.
    fn shrinks_areas_exactly(&self) -> bool;

    /// Impacts after which a transient counts as over: each impact contracts an area of states by
    /// restitution^2, all of them together by e^-10. For a compliant contact this is an estimate, and a
    /// verdict measures the contraction of areas.
    fn transient_impacts(&self) -> f64 {
        DISSIPATION_TIMES / (-2.0 * ln(self.restitution()))
    }

    /// The impact a number of steps after `state`, without an observer.
    ///
    /// # Errors
    /// The error of the first step that fails.
    fn steps(&self, mut state: ImpactState, impacts: u64) -> Result<ImpactState, Error> {
        for _ in 0..impacts {
            state = self.step(state)?.into();
        }
        Ok(state)
    }

    /// [`Self::steps`] with an observer, whose items are the impacts.
    ///
    /// # Errors
    /// The error of the first step that fails.
    fn iterate(
        &self,
        mut state: ImpactState,
        impacts: u64,
        observer: &dyn Observer,
    ) -> Result<ImpactState, Error> {
        let watch = Watch::begin(observer, 0, impacts)?;
        let mut work = watch.work();
        for _ in 0..impacts {
            state = self.step(state)?.into();
            watch.finish(1);
            work.spend(WORK_OF_EVENT)?;
        }
        watch.end();
        Ok(state)
    }

    /// The attracting periodic orbit on which the orbit from `state` settles, like
    /// [`ImpactMap::settled_orbit`](crate::ImpactMap::settled_orbit).
    ///
    /// The items of `observer` are the impacts before the refinement.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for `longest` or `tolerance`; the errors of a flight and of [`Self::refine`].
    fn settled_orbit(
        &self,
        mut state: ImpactState,
        transient: usize,
        longest: usize,
        tolerance: f64,
        observer: &dyn Observer,
    ) -> Result<Option<PeriodicOrbit>, Error> {
        check_repeats(longest, tolerance)?;
        let impacts = transient.saturating_add(2 * longest);
        let watch = Watch::begin(observer, 0, impacts as u64)?;
        let (mut orbit, mut work) = (self.orbit(state, ChatterPolicy::Complete), watch.work());
        let mut states = Vec::new();
        for impact in 0..impacts {
            if impact >= transient {
                states.push(state);
            }
            match orbit.next_event()? {
                Some(SweepEvent::Impact(next)) => state = next.state,
                Some(_) | None => return Ok(None),
            }
            watch.finish(1);
            work.spend(WORK_OF_EVENT)?;
        }
        states.push(state);
        let period = repeats(&states, longest, tolerance);
        let orbit = period.map(|period| self.refine(&states[..period])).transpose()?;
        watch.end();
        Ok(orbit)
    }
}

/// The index of an orbit and its outcome.
pub type OrbitOutcome<S> = (usize, Result<S, Error>);

/// An orbit of a [`BouncingMap`].
pub trait BouncingOrbit: Clone + Send + Sync {
    /// The next event, or `None` after the end of the orbit.
    ///
    /// # Errors
    /// Errors of a flight. An error ends the orbit.
    fn next_event(&mut self) -> Result<Option<SweepEvent>, Error>;

    /// Follows orbits until `visit` breaks, they end, or the observer of `watch` breaks, and returns the
    /// outcomes of the finished orbits in order. Each finished orbit is an item of `watch`.
    #[doc(hidden)]
    fn follow<S: Send>(
        orbits: &[Self],
        start: &(impl Fn(usize) -> S + Sync),
        visit: &(impl Fn(&mut S, &SweepEvent) -> ControlFlow<()> + Sync),
        watch: &Watch<'_>,
    ) -> Vec<OrbitOutcome<S>> {
        let one = |index: usize| {
            // Once the observer has broken, unfinished orbits are dropped.
            watch.ask().ok()?;
            let (mut orbit, mut value, mut work) = (orbits[index].clone(), start(index), watch.work());
            loop {
                work.spend(WORK_OF_EVENT).ok()?;
                match orbit.next_event() {
                    Ok(Some(event)) if visit(&mut value, &event).is_continue() => {}
                    Ok(_) => break,
                    Err(error) => return Some((index, Err(error))),
                }
            }
            watch.finish(1);
            Some((index, Ok(value)))
        };
        in_parallel(orbits.len(), one).into_iter().flatten().collect()
    }
}

impl BouncingMap for ImpactMap {
    type Orbit = Orbit;

    /// Enough orbits that the last ones, which leave lanes empty, do not matter.
    const TOGETHER: usize = 1 << 14;

    fn restitution(&self) -> f64 {
        Self::restitution(self)
    }

    fn speed_scale(&self) -> f64 {
        self.vibration().peak_acceleration()
    }

    #[inline]
    fn step(&self, state: ImpactState) -> Result<Impact, Error> {
        self.step(state)
    }

    fn step_with_derivative(&self, state: ImpactState) -> Result<(Impact, DMat2), Error> {
        self.step_with_derivative(state)
    }

    fn orbit(&self, state: ImpactState, policy: ChatterPolicy) -> Orbit {
        self.orbit(state, policy)
    }

    fn refine(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        self.refine(guess)
    }

    fn chatters_to_rest_after(&self, state: ImpactState) -> bool {
        self.chatters_to_rest(self.rebound(state))
    }

    #[inline]
    fn derivative(&self, from: ImpactState, to: ImpactState, duration: f64) -> (DMat2, f64) {
        (self.derivative(from, to, duration), f64::EPSILON * (1.0 + to.velocity().abs()))
    }

    /// The phase is known in closed form.
    fn separation_error(&self) -> f64 {
        0.0
    }

    fn shrinks_areas_exactly(&self) -> bool {
        true
    }

    #[inline]
    fn steps(&self, state: ImpactState, impacts: u64) -> Result<ImpactState, Error> {
        self.steps(state, impacts)
    }

    fn settled_orbit(
        &self,
        state: ImpactState,
        transient: usize,
        longest: usize,
        tolerance: f64,
        observer: &dyn Observer,
    ) -> Result<Option<PeriodicOrbit>, Error> {
        self.settled_orbit(state, transient, longest, tolerance, observer)
    }
}
