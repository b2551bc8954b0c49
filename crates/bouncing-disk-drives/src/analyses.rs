//! The implementation of the core's analysis traits for the map of a drive.

use bouncing_disk_core::attractors::{AttractingMap, Verdict, VerdictSettings, verdicts};
use bouncing_disk_core::orbits::{OrbitSearch, PeriodicOrbit};
use bouncing_disk_core::parts::check;
use bouncing_disk_core::sweep::{BouncingOrbit, SweepEvent};
use bouncing_disk_core::{BouncingMap, ChatterPolicy, Error, Impact, ImpactState, Observer, Unobserved};
use glam::DMat2;

use crate::driven_map::{DrivenMap, DrivenOrbit};

/// Bound on the rounding error (rad) of the end of a contact on a drive, for a force that falls through zero
/// as slowly as possible.
const SEPARATION_ERROR: f64 = 1.0e-9;

impl BouncingMap for DrivenMap {
    type Orbit = DrivenOrbit;

    fn restitution(&self) -> f64 {
        Self::restitution(self)
    }

    fn speed_scale(&self) -> f64 {
        self.drive().bounds().speed
    }

    fn step(&self, state: ImpactState) -> Result<Impact, Error> {
        self.step(state).map(|landing| landing.impact)
    }

    fn step_with_derivative(&self, state: ImpactState) -> Result<(Impact, DMat2), Error> {
        self.step_with_derivative(state).map(|(landing, derivative)| (landing.impact, derivative))
    }

    fn orbit(&self, state: ImpactState, policy: ChatterPolicy) -> DrivenOrbit {
        self.orbit(state, policy)
    }

    fn refine(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        self.refine(guess)
    }

    fn chatters_to_rest_after(&self, state: ImpactState) -> bool {
        self.chatters_to_rest_after(state)
    }

    /// The flight is computed again, because an event does not store the error of its flight.
    fn derivative(&self, from: ImpactState, to: ImpactState, _duration: f64) -> (DMat2, f64) {
        match self.step_with_derivative(from) {
            // There is no error bound for a compliant contact.
            Ok((landing, derivative)) if landing.doubt.is_none() && landing.error.is_finite() => {
                (derivative, landing.error * (1.0 + to.velocity().abs()))
            }
            Ok((_, derivative)) => (derivative, f64::INFINITY),
            Err(_) => (DMat2::NAN, f64::INFINITY),
        }
    }

    fn separation_error(&self) -> f64 {
        SEPARATION_ERROR
    }

    /// False for a compliant contact.
    fn shrinks_areas_exactly(&self) -> bool {
        self.compliant().is_none()
    }
}

impl BouncingOrbit for DrivenOrbit {
    fn next_event(&mut self) -> Result<Option<SweepEvent>, Error> {
        Ok(self.advance()?.map(|event| SweepEvent::of(None, event)))
    }
}

impl AttractingMap for DrivenMap {
    fn impact_speed_bound(&self) -> f64 {
        self.impact_speed_bound()
    }

    fn orbits_found(
        &self,
        search: &OrbitSearch,
        observer: &dyn Observer,
    ) -> Result<Vec<PeriodicOrbit>, Error> {
        self.periodic_orbits(search, observer)
    }
}

impl DrivenMap {
    /// Checks that `orbit` is an orbit of this map, like
    /// [`ImpactMap::check_orbit`](bouncing_disk_core::ImpactMap::check_orbit). An orbit of the sine is also
    /// an orbit of the sine as a drive.
    ///
    /// # Errors
    /// Errors of [`ImpactMap::check_orbit`](bouncing_disk_core::ImpactMap::check_orbit).
    pub fn check_orbit(&self, orbit: &PeriodicOrbit) -> Result<(), Error> {
        let impact = |state| self.step(state).map(|landing| landing.impact);
        check(orbit, impact, |state| {
            self.step_with_derivative(state).map(|(landing, derivative)| (landing.impact, derivative))
        })
    }
}

impl DrivenMap {
    /// The long-term behaviour of the orbit from `state`.
    ///
    /// # Errors
    /// Errors of [`verdicts`].
    pub fn verdict(&self, state: ImpactState, settings: VerdictSettings) -> Result<Verdict, Error> {
        let mut verdicts = verdicts(&[(self.clone(), state)], settings, &Unobserved)?;
        verdicts.pop().ok_or(Error::Stopped { done: 0, total: 1 })
    }
}
