//! The vertical motion of a motor, with its perturbed relaunches, shared by all rotors on it.

use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::{ChatterPolicy, ImpactMap, Launch, Orbit, OrbitEvent, Phase};

use crate::error::Error;
use crate::motion::phase_time::PhaseTime;
use crate::parameters::dimensionless::DimensionlessSystem;

/// The vertical motion of a disk that lies on the platform at the start.
#[derive(Debug, Clone)]
pub(crate) struct VerticalMotion {
    map: ImpactMap,
    orbit: Orbit,
    generator: SplitMix64,
    /// Size of the relaunch perturbation.
    perturbation: f64,
    now: PhaseTime,
    /// Axial energy (per mass) supplied by the perturbations.
    given: f64,
}

impl VerticalMotion {
    /// The motion after the first separation of a disk that lies on the platform at `phase`; it separates at
    /// once if the platform falls away there. `None` if the platform never falls away.
    ///
    /// # Errors
    /// The errors of the core's launches.
    pub(crate) fn from_rest(
        system: &DimensionlessSystem,
        phase: Phase,
        policy: ChatterPolicy,
        (perturbation, seed): (f64, u64),
    ) -> Result<Option<Self>, Error> {
        let vibration = system.vibration();
        let Some(leaves) = vibration.separation_phase() else { return Ok(None) };
        let from = if vibration.falls_away_at(phase.angle()) { phase } else { leaves };
        Ok(Some(Self {
            map: *system.map(),
            orbit: system.map().orbit_from_launch(Launch::new(from, 0.0)?, policy),
            generator: SplitMix64::new(seed),
            perturbation,
            now: PhaseTime::in_first_period(phase),
            given: 0.0,
        }))
    }

    /// The motion of a disk thrown up from the platform at `phase`, with this speed relative to it.
    pub(crate) fn thrown(self, phase: Phase, speed: f64, policy: ChatterPolicy) -> Result<Self, Error> {
        let orbit = self.map.orbit_from_launch(Launch::new(phase, speed)?, policy);
        Ok(Self { orbit, ..self })
    }

    /// The coefficient of restitution.
    pub(crate) const fn restitution(&self) -> f64 {
        self.map.restitution()
    }

    /// The time of the last event.
    pub(crate) const fn now(&self) -> PhaseTime {
        self.now
    }

    /// Axial energy (per mass) that all perturbations together have supplied to the disk.
    pub(crate) const fn given_by_perturbations(&self) -> f64 {
        self.given
    }

    /// The next impact, or attachment; `now` follows impacts only.
    ///
    /// # Errors
    /// The errors of the core's flights.
    #[inline]
    pub(crate) fn advance(&mut self) -> Result<Option<OrbitEvent>, Error> {
        let event = self.orbit.advance()?;
        if let Some(OrbitEvent::Impact(impact)) = &event {
            self.now = PhaseTime { periods: self.now.periods + impact.turns, phase: impact.phase };
        }
        Ok(event)
    }

    /// The flight that starts now, if one does.
    pub(crate) const fn launch(&self) -> Option<Launch> {
        self.orbit.launch()
    }

    /// The end of a rest: the disk leaves the platform at `time`, with a perturbed speed.
    ///
    /// # Errors
    /// An error of the core for a perturbation that is not a legal speed.
    pub(crate) fn separate(&mut self, time: PhaseTime) -> Result<(), Error> {
        self.now = time;
        if self.perturbation > 0.0 {
            let speed = self.perturbation * self.generator.unit();
            self.orbit.perturb_launch(speed)?;
            let platform = self.map.vibration().velocity(time.phase);
            self.given += speed * (platform + 0.5 * speed);
        }
        Ok(())
    }
}
