//! The end of a chatter of known duration: the remaining impacts one by one, with each flight computed from
//! the pull and its derivative at its start.
//!
//! A chatter is completed once the first terms of its sum have an error below 1e-14 rad, that is, once about
//! 1e-7 rad of it remain; the neglected terms change a flight by the same order.

use bouncing_disk_core::Phase;

use super::DrivenSystem;
use crate::motion::chatter::Chatter;

/// Largest number of impacts that are followed; the rest of a chatter then counts as one impact.
const MOST_IMPACTS: u64 = 100_000;

/// A launch slower than this share of the first one belongs to the last impact.
const LEAST_SHARE: f64 = 1.0e-18;

impl DrivenSystem {
    /// The chatter that starts at `phase` with the launch speed `launch` and lasts for `duration`.
    pub(super) fn chatter(&self, phase: Phase, launch: f64, speed: f64, duration: f64) -> Chatter {
        let at = phase.angle();
        let start = self.height.at(at);
        let law = |restitution| [self.friction, self.load, restitution];
        let turn = |time: f64| self.angle.at(at + time).velocity;
        let mut chatter = Chatter::before(phase, launch, speed);
        while chatter.impacts < MOST_IMPACTS && chatter.launch_speed > LEAST_SHARE * launch {
            let (time, launch_speed) = (chatter.time, chatter.launch_speed);
            let pull = 1.0 + start.acceleration + start.jerk * time;
            let share = start.jerk * launch_speed / (pull * pull);
            let flight = 2.0 * launch_speed / pull * (1.0 - (2.0 / 3.0) * share);
            if time + flight > duration {
                break;
            }
            let velocity = launch_speed - flight * (pull + 0.5 * start.jerk * flight);
            let time = time + flight;
            let platform = start.velocity + time * (start.acceleration + 0.5 * time * start.jerk);
            chatter.strike(law(self.restitution), (time, flight), [velocity, platform], turn(time));
        }
        if launch <= 0.0 {
            return chatter;
        }
        // All remaining impacts are combined into one, which ends at rest.
        let (time, end) = (chatter.time, self.height.at(at + duration));
        let left = duration - time;
        let lifted = (end.velocity - start.velocity) - time * (start.acceleration + 0.5 * time * start.jerk);
        let velocity = (chatter.launch_speed - (left + lifted)).min(0.0);
        chatter.strike(law(0.0), (duration, left), [velocity, end.velocity], turn(duration));
        chatter
    }
}
