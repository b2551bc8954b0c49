//! The rotary motion and the energy of a complete chatter: infinitely many impacts, summed until they no longer count.

use bouncing_disk_core::{ChatterImpact, Phase};

use crate::dimensionless::Dimensionless;
use crate::impact::{axial_impulse, friction_impact, rebound_velocity};
use crate::ledger::EnergyLedger;
use crate::spell::{book_flight_load, flight_turn};

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
    pub(crate) impacts: u32,
    pub(crate) axial_impulse: f64,
    pub(crate) angular_impulse: f64,
    /// Impacts and the load's work in the flights between them. The change of the axial energy is not in it.
    pub(crate) ledger: EnergyLedger,
}

impl Chatter {
    /// The sequence that starts with a launch at `phase` with `speed`, up to `duration` rad later.
    pub(crate) fn new(
        system: &Dimensionless,
        phase: Phase,
        speed: f64,
        angular_speed: f64,
        duration: f64,
    ) -> Self {
        let mut chatter = Self {
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
        };
        for impact in system.vibration().chatter_impacts(phase, speed, system.restitution()) {
            if impact.time > duration {
                break;
            }
            chatter.advance(system, &impact);
        }
        chatter
    }

    fn advance(&mut self, system: &Dimensionless, impact: &ChatterImpact) {
        let turn = flight_turn(system, self.angular_speed, impact.time - self.time);
        book_flight_load(&mut self.ledger, system, self.angular_speed, &turn);
        let platform_speed = system.angular_speed_at(impact.pair);
        let axial = axial_impulse(system.restitution(), -impact.speed);
        let slip = turn.speed - platform_speed;
        let rotary = friction_impact(system.friction(), axial, slip);
        let after = if rotary.capped { platform_speed } else { turn.speed + rotary.impulse };
        book_impact(
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
        self.ledger.book_rotary_change(turn.speed, after);
        self.time = impact.time;
        self.pair = impact.pair;
        self.launch_speed = rebound_velocity(system.restitution(), -impact.speed);
        self.angular_speed = after;
        self.angle += turn.angle;
        self.capped = rotary.capped;
        self.impacts += 1;
        self.axial_impulse += axial;
        self.angular_impulse += rotary.impulse;
    }

    /// Axial velocity of the disk just after the last impact.
    pub(crate) fn launch_velocity(&self, system: &Dimensionless) -> f64 {
        self.launch_speed + system.peak_acceleration() * self.pair.1
    }
}

/// What the energy of an impact is computed from.
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

/// Books the platform's work and the losses of one impact.
pub(crate) fn book_impact(ledger: &mut EnergyLedger, energy: ImpactEnergy) {
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
    ledger.book_normal(axial * platform_velocity, restitution_loss);
    // The friction impulse acts at the mean of the slip speeds before and after.
    let friction_loss = -rotary * (slip + 0.5 * rotary);
    let work = rotary * platform_speed;
    ledger.book_friction(work, friction_loss, work.abs() + (rotary * slip).abs());
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::Launch;

    use super::*;
    use crate::dimensionless::DimensionlessParameters;

    /// A chatter is its flights and impacts one by one, here from the first impacts of single launches: friction that slides
    /// throughout in the first impacts and stops the slip in later ones, against a load.
    #[test]
    fn a_chatter_is_its_impacts_one_by_one() {
        let system = DimensionlessParameters {
            peak_acceleration: 0.5,
            twist_speed: 0.4,
            phase_lag: 0.3,
            friction: 0.2,
            restitution: 0.5,
            load: 0.05,
        }
        .build()
        .expect("legal");
        let start = Phase::new(1.0).expect("finite");
        let (friction, restitution, load) = (0.2, 0.5, 0.05);
        for (spin, longest) in
            [(0.2, 1.0), (0.2, 2e-3), (-0.3, 1.0), (-0.3, 4.5e-3), (0.135, 1.0), (0.135, 1e-3)]
        {
            let speed = 1e-3;
            let (mut phase, mut launch, mut spin_now) = (start, speed, spin);
            let (mut time, mut angle, mut impacts, mut axial, mut angular) = (0.0, 0.0, 0, 0.0, 0.0);
            let mut friction_loss = 0.0;
            while launch > 1e-14 * speed {
                let impact = system
                    .vibration()
                    .first_impact(Launch::new(phase, launch).expect("legal"))
                    .expect("returns");
                if time + impact.remainder > longest {
                    break;
                }
                time += impact.remainder;
                angle += impact.remainder * (spin_now - 0.5 * load * impact.remainder);
                spin_now -= load * impact.remainder;
                phase = impact.phase;
                let slip = spin_now - system.platform_angular_speed(phase);
                let push = -(1.0 + restitution) * impact.velocity;
                let impulse = -slip.signum() * slip.abs().min(friction * push);
                // The loss is that of the slip's energy, of which the platform takes no part.
                friction_loss += 0.5 * (slip * slip - (slip + impulse) * (slip + impulse));
                spin_now += impulse;
                launch = -restitution * impact.velocity;
                (impacts, axial, angular) = (impacts + 1, axial + push, angular + impulse);
            }
            let own = Chatter::new(&system, start, speed, spin, longest);
            let near = |own: f64, other: f64| (own - other).abs() <= 1e-11 * other.abs();
            // The last impacts of the two are found to another share of the first one.
            assert!(
                longest < 1.0 || own.impacts > impacts && own.impacts < impacts + 12,
                "{own:?} {impacts}"
            );
            assert!(longest >= 1.0 || own.impacts == impacts && near(own.launch_speed, launch), "{own:?}");
            assert!(near(own.time, time) && near(own.angle, angle), "{own:?} {time} {angle}");
            assert!((own.angular_speed - spin_now).abs() < 1e-14, "{own:?} {spin_now}");
            assert!(near(own.axial_impulse, axial) && near(own.angular_impulse, angular), "{own:?}");
            assert!((own.ledger.friction_loss - friction_loss).abs() < 1e-15, "{own:?} {friction_loss}");
            let velocity = launch + system.vibration().velocity(phase);
            assert!((own.launch_velocity(&system) - velocity).abs() < 1e-13, "{own:?} {velocity}");
            assert!((own.pair.0 - phase.sin()).abs() < 1e-14 && (own.pair.1 - phase.cos()).abs() < 1e-14);
        }
    }
}
