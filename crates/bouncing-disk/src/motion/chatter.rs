//! The rotary motion and the energy of a complete chatter: infinitely many impacts, summed until they no
//! longer count, or in closed form if there are too many.

use bouncing_disk_core::chatter::{ChatterImpact, ChatterSeries};
use bouncing_disk_core::{Launch, Phase};

use crate::motion::energy::EnergyLedger;
use crate::motion::impact::{axial_impulse, friction_impact, rebound_velocity};
use crate::motion::rotary_change::{change_in_flight, record_flight_load};
use crate::parameters::dimensionless::DimensionlessSystem;

mod summed;

/// A chattering sequence followed up to some time: the state just after the last impact by then.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Chatter {
    /// Time of the last impact since the start (rad).
    pub(crate) time: f64,
    /// Phase pair at the last impact.
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
    /// Impacts and the load's work in the flights between them. The change of the axial energy is not in it.
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

    /// The sequences of rotors with their angular speeds on one vertical motion, each as of [`Self::new`].
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

    /// The launch that a sequence starts with.
    fn before(phase: Phase, speed: f64, angular_speed: f64) -> Self {
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

    fn advance(&mut self, system: &DimensionlessSystem, impact: &ChatterImpact) {
        let change = change_in_flight(system.load(), self.angular_speed, impact.time - self.time);
        record_flight_load(&mut self.ledger, system, self.angular_speed, &change);
        let platform_speed = system.angular_speed_at(impact.pair);
        let axial = axial_impulse(system.restitution(), -impact.speed);
        let slip = change.speed - platform_speed;
        let rotary = friction_impact(system.friction(), axial, slip);
        let after = rotary.speed_after(change.speed, platform_speed);
        record_impact(
            &mut self.ledger,
            ImpactEnergy {
                axial,
                relative_velocity: -impact.speed,
                restitution: system.restitution(),
                platform_velocity: system.peak_acceleration() * impact.pair.1,
                rotary: rotary.impulse,
                slip,
                platform_speed,
            },
        );
        self.ledger.record_rotary_change(change.speed, after);
        self.time = impact.time;
        self.pair = impact.pair;
        self.launch_speed = rebound_velocity(system.restitution(), -impact.speed);
        self.angular_speed = after;
        self.angle += change.angle;
        self.capped = rotary.capped;
        self.impacts += 1;
        self.axial_impulse += axial;
        self.angular_impulse += rotary.impulse;
    }

    /// Axial velocity of the disk just after the last impact.
    pub(crate) fn launch_velocity(&self, system: &DimensionlessSystem) -> f64 {
        self.launch_speed + system.peak_acceleration() * self.pair.1
    }
}

/// The numbers from which the energy of an impact is computed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ImpactEnergy {
    /// Axial impulse per mass.
    pub(crate) axial: f64,
    /// Relative axial velocity before.
    pub(crate) relative_velocity: f64,
    pub(crate) restitution: f64,
    /// Axial velocity of the platform.
    pub(crate) platform_velocity: f64,
    /// Angular impulse.
    pub(crate) rotary: f64,
    /// Angular speed relative to the platform before.
    pub(crate) slip: f64,
    /// Angular speed of the platform.
    pub(crate) platform_speed: f64,
}

/// Records the platform's work and the losses of one impact.
pub(crate) fn record_impact(ledger: &mut EnergyLedger, energy: ImpactEnergy) {
    let ImpactEnergy {
        axial,
        relative_velocity,
        restitution,
        platform_velocity,
        rotary,
        slip,
        platform_speed,
    } = energy;
    let restitution_loss =
        0.5 * ((1.0 - restitution) * (1.0 + restitution)) * (relative_velocity * relative_velocity);
    ledger.record_normal(axial * platform_velocity, restitution_loss);
    // The friction impulse acts at the mean of the slip speeds before and after.
    let friction_loss = -rotary * (slip + 0.5 * rotary);
    let work = rotary * platform_speed;
    ledger.record_friction(work, friction_loss, work.abs() + (rotary * slip).abs());
}

#[cfg(test)]
mod tests;
