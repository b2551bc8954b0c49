//! The rotary motion and the energy of a complete chatter: infinitely many impacts, summed one by one until the
//! rest is negligible, or in closed form if there are too many.

use bouncing_disk_core::chatter::{ChatterImpact, ChatterSeries};
use bouncing_disk_core::{Launch, Phase};

use crate::motion::energy::EnergyLedger;
use crate::motion::impact::rebound_velocity;
use crate::motion::impact_energy::impact;
use crate::motion::rotary_change::{change_in_flight, record_flight_load};
use crate::parameters::dimensionless::DimensionlessSystem;

mod summed;

/// A chattering sequence followed up to some time, with the state just after the last impact before that time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Chatter {
    /// Time of the last impact since the start (rad).
    pub(crate) time: f64,
    /// Phase pair at the last impact, on the sine.
    pub(crate) pair: (f64, f64),
    /// Relative launch speed after it.
    pub(crate) launch_speed: f64,
    pub(crate) angular_speed: f64,
    /// Angle turned since the start.
    pub(crate) angle: f64,
    /// Whether friction ended the slip in the last impact.
    pub(crate) capped: bool,
    pub(crate) impacts: u64,
    pub(crate) axial_impulse: f64,
    pub(crate) angular_impulse: f64,
    /// The balance of the impacts and of the load's work in the flights between them, without the change of
    /// the axial energy.
    pub(crate) ledger: EnergyLedger,
}

impl Chatter {
    /// The sequence that starts with a launch at `phase` with `speed`, up to `duration` rad later.
    pub(crate) fn new(
        system: &DimensionlessSystem,
        phase: Phase,
        speed: f64,
        angular_speed: f64,
        duration: f64,
    ) -> Self {
        let mut alone = [(system, Self::before(phase, speed, angular_speed))];
        Self::follow(&mut alone, phase, duration);
        alone[0].1
    }

    /// The sequences of several rotors, given by their angular speeds, on one vertical motion, each as from
    /// [`Self::new`].
    pub(crate) fn of_rotors<'a>(
        rotors: impl Iterator<Item = (&'a DimensionlessSystem, f64)>,
        phase: Phase,
        speed: f64,
        duration: f64,
    ) -> Vec<Self> {
        let before = |(system, angular_speed)| (system, Self::before(phase, speed, angular_speed));
        let mut rotors: Vec<_> = rotors.map(before).collect();
        Self::follow(&mut rotors, phase, duration);
        rotors.into_iter().map(|(_, chatter)| chatter).collect()
    }

    /// Follows rotors on one vertical motion, which is computed once.
    fn follow(rotors: &mut [(&DimensionlessSystem, Self)], phase: Phase, duration: f64) {
        let Some(&(system, Self { launch_speed, .. })) = rotors.first() else { return };
        if ChatterSeries::is_needed(launch_speed, system.restitution()) {
            for (system, chatter) in rotors {
                chatter.sum(system, phase, duration);
            }
        } else {
            Self::go_through(rotors, phase, duration);
        }
    }

    /// The impacts up to `duration` one by one.
    fn go_through(rotors: &mut [(&DimensionlessSystem, Self)], phase: Phase, duration: f64) {
        let Some(&(system, Self { launch_speed, .. })) = rotors.first() else { return };
        let Ok(launch) = Launch::new(phase, launch_speed) else { return };
        for impact in system.map().chatter_impacts(launch) {
            if impact.time > duration {
                break;
            }
            for (system, chatter) in &mut *rotors {
                chatter.advance(system, &impact);
            }
        }
    }

    /// The launch that starts a sequence.
    pub(crate) fn before(phase: Phase, speed: f64, angular_speed: f64) -> Self {
        Self {
            time: 0.0,
            pair: (phase.sin(), phase.cos()),
            launch_speed: speed,
            angular_speed,
            angle: 0.0,
            capped: false,
            impacts: 0,
            axial_impulse: 0.0,
            angular_impulse: 0.0,
            ledger: EnergyLedger::default(),
        }
    }

    fn advance(&mut self, system: &DimensionlessSystem, next: &ChatterImpact) {
        let law = [system.friction(), system.load(), system.restitution()];
        let velocities = [-next.speed, system.peak_acceleration() * next.pair.1];
        let flight = next.time - self.time;
        self.strike(law, (next.time, flight), velocities, system.angular_speed_at(next.pair));
        self.pair = next.pair;
    }

    /// An impact at this time after the start, which ends a flight of this duration, with this relative
    /// velocity, on a platform with this velocity and angular speed.
    pub(crate) fn strike(
        &mut self,
        [friction, load, restitution]: [f64; 3],
        (time, flight): (f64, f64),
        velocities: [f64; 2],
        platform_speed: f64,
    ) {
        let change = change_in_flight(load, self.angular_speed, flight);
        record_flight_load(&mut self.ledger, load, self.angular_speed, &change);
        let speeds = [change.speed, platform_speed];
        let done = impact(&mut self.ledger, (friction, restitution), velocities, speeds);
        self.ledger.record_rotary_change(change.speed, done.speed);
        self.time = time;
        self.launch_speed = rebound_velocity(restitution, velocities[0]);
        self.angular_speed = done.speed;
        self.angle += change.angle;
        self.capped = done.capped;
        self.impacts += 1;
        self.axial_impulse += done.axial;
        self.angular_impulse += done.rotary;
    }

    /// Axial velocity of the disk just after the last impact.
    pub(crate) fn launch_velocity(&self, system: &DimensionlessSystem) -> f64 {
        self.launch_speed + system.peak_acceleration() * self.pair.1
    }
}

#[cfg(test)]
mod tests;
