//! The end of a chatter whose duration is known: the impacts that are left, one by one, each flight by the
//! pull and its derivative at the start.
//!
//! A chatter is completed where the first terms of its sum have an error below 1e-14 rad, which is where it
//! lasts for some 1e-7 rad; what the neglected terms change in a flight is of the same order.

use super::DrivenSystem;
use crate::motion::chatter::{ImpactEnergy, record_impact};
use crate::motion::energy::EnergyLedger;
use crate::motion::impact::{axial_impulse, friction_impact, rebound_velocity};
use crate::motion::rotary_change::change_in_flight;

/// Impacts that are followed; what is left of a chatter then counts as one.
const MOST_IMPACTS: u64 = 100_000;

/// A launch that is slower than this share of the first one belongs to the last impact.
const LEAST_SHARE: f64 = 1.0e-18;

/// The disk at the end of a chatter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rest {
    pub(super) speed: f64,
    pub(super) angle: f64,
    pub(super) capped: bool,
    pub(super) impacts: u64,
    pub(super) axial_impulse: f64,
    pub(super) angular_impulse: f64,
    pub(super) ledger: EnergyLedger,
}

/// What an impact does.
#[derive(Debug, Clone, Copy)]
pub(super) struct Impulses {
    pub(super) axial: f64,
    pub(super) rotary: f64,
    /// Whether friction ends the slip within the impact.
    pub(super) capped: bool,
    /// The slip before, and the angular speed after.
    pub(super) slip: f64,
    pub(super) speed: f64,
}

impl DrivenSystem {
    /// The chatter that starts at `at` with the launch speed `launch` and lasts for `duration`.
    pub(super) fn chatter(&self, at: f64, launch: f64, speed: f64, duration: f64) -> Rest {
        let start = self.height.at(at);
        let mut rest = Rest {
            speed,
            angle: 0.0,
            capped: false,
            impacts: 0,
            axial_impulse: 0.0,
            angular_impulse: 0.0,
            ledger: EnergyLedger::default(),
        };
        let (mut time, mut launch_speed) = (0.0, launch);
        while rest.impacts < MOST_IMPACTS && launch_speed > LEAST_SHARE * launch {
            let pull = 1.0 + start.acceleration + start.jerk * time;
            let share = start.jerk * launch_speed / (pull * pull);
            let flight = 2.0 * launch_speed / pull * (1.0 - (2.0 / 3.0) * share);
            if time + flight > duration {
                break;
            }
            let velocity = launch_speed - flight * (pull + 0.5 * start.jerk * flight);
            time += flight;
            let platform = start.velocity + time * (start.acceleration + 0.5 * time * start.jerk);
            self.strike(&mut rest, at + time, flight, (velocity, platform), self.restitution);
            launch_speed = rebound_velocity(self.restitution, velocity);
        }
        if launch <= 0.0 {
            return rest;
        }
        // All the impacts that are left make one, which ends at rest.
        let end = self.height.at(at + duration);
        let left = duration - time;
        let lifted = (end.velocity - start.velocity) - time * (start.acceleration + 0.5 * time * start.jerk);
        let velocity = (launch_speed - (left + lifted)).min(0.0);
        self.strike(&mut rest, at + duration, left, (velocity, end.velocity), 0.0);
        rest
    }

    /// One impact, after a flight of this duration.
    fn strike(
        &self,
        rest: &mut Rest,
        at: f64,
        flight: f64,
        (velocity, platform): (f64, f64),
        restitution: f64,
    ) {
        let change = change_in_flight(self.load, rest.speed, flight);
        let work = self.load * change.angle;
        rest.ledger.record_rotary_change(rest.speed, change.speed);
        rest.ledger.record_load(work, work.abs());
        let speeds = [change.speed, self.angle.at(at).velocity];
        let impact = self.impact(&mut rest.ledger, restitution, [velocity, platform], speeds);
        rest.ledger.record_rotary_change(change.speed, impact.speed);
        rest.speed = impact.speed;
        rest.angle += change.angle;
        rest.capped = impact.capped;
        rest.impacts += 1;
        rest.axial_impulse += impact.axial;
        rest.angular_impulse += impact.rotary;
    }

    /// An impact with this relative velocity and angular speed, each with that of the platform.
    pub(super) fn impact(
        &self,
        ledger: &mut EnergyLedger,
        restitution: f64,
        [relative_velocity, platform_velocity]: [f64; 2],
        [speed, platform_speed]: [f64; 2],
    ) -> Impulses {
        let slip = speed - platform_speed;
        let axial = axial_impulse(restitution, relative_velocity);
        let friction = friction_impact(self.friction, axial, slip);
        let (rotary, capped) = (friction.impulse, friction.capped);
        record_impact(
            ledger,
            ImpactEnergy {
                axial,
                relative_velocity,
                restitution,
                platform_velocity,
                rotary,
                slip,
                platform_speed,
            },
        );
        Impulses { axial, rotary, capped, slip, speed: friction.speed_after(speed, platform_speed) }
    }
}
