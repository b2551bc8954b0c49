//! How exactly the motions of the census obey the equations of Sec. II.

use bouncing_disk::{
    DimensionlessSystem, Event, EventKind, EventRecord, Mode, PlatformState, SlipDirection, Snapshot,
};

use super::data::Laws;

/// Points of a segment at which the equations are checked, besides its ends.
const CHECKS: u32 = 4;

/// A fault as a share of the sum of sizes; 0 where everything vanishes.
fn share(fault: f64, sizes: &[f64]) -> f64 {
    let sum: f64 = sizes.iter().map(|size| size.abs()).sum();
    if fault.is_nan() || (fault > 0.0 && sum > 0.0) { fault / sum } else { 0.0 }
}

fn raise(largest: &mut f64, fault: f64) {
    // A NaN is a fault, too: it must not be lost.
    if fault.is_nan() || fault > *largest {
        *largest = if fault.is_nan() { f64::MAX } else { fault };
    }
}

/// N in units of m g.
fn force(at: &PlatformState) -> f64 {
    // The platform's acceleration is minus its height in these units.
    1.0 - at.height
}

impl Laws {
    pub(super) fn check(&mut self, system: &DimensionlessSystem, record: &EventRecord) {
        let shots: Vec<_> =
            (0..=CHECKS).map(|step| record.evaluate(system, f64::from(step) / f64::from(CHECKS))).collect();
        match record.before.mode {
            Mode::Flight if record.segment.chatter_speed.is_none() => self.flight(record, &shots),
            Mode::Flight => {}
            Mode::Sticking => {
                self.checked.sticking += 1;
                self.contact(system, &shots);
                self.sticking(system, &shots);
            }
            Mode::Sliding(direction) => {
                self.checked.sliding += 1;
                self.contact(system, &shots);
                self.sliding(system, direction, record, &shots);
            }
        }
        match record.event {
            Event::Impact { axial_impact_velocity, .. } => self.impact(system, record, axial_impact_velocity),
            _ => self.change(system, record),
        }
    }

    fn contact(&mut self, system: &DimensionlessSystem, shots: &[Snapshot]) {
        let peak = system.peak_acceleration();
        for Snapshot { disk, platform, .. } in shots {
            raise(&mut self.contact_motion, share((disk.height - platform.height).abs(), &[1.0, peak]));
            let drift = (disk.axial_velocity - platform.axial_velocity).abs();
            raise(&mut self.contact_motion, share(drift, &[1.0, peak]));
            raise(&mut self.negative_force, share(-force(platform), &[1.0, peak]));
        }
    }

    fn sticking(&mut self, system: &DimensionlessSystem, shots: &[Snapshot]) {
        let (friction, load) = (system.friction(), system.load());
        for Snapshot { platform, .. } in shots {
            // The platform's angular acceleration is minus its angle in these units.
            let needed = (load - platform.angle).abs();
            let limit = friction * force(platform);
            let terms = [load, system.twist_speed(), friction * (1.0 + system.peak_acceleration())];
            raise(&mut self.holding_torque, share(needed - limit, &terms));
        }
    }

    fn sliding(
        &mut self,
        system: &DimensionlessSystem,
        direction: SlipDirection,
        record: &EventRecord,
        shots: &[Snapshot],
    ) {
        let [first, .., last] = shots else { return };
        let span = record.span.radians();
        // The integral of N = 1 - P sin τ, with P cos τ the platform's velocity.
        let pressed = span + last.platform.axial_velocity - first.platform.axial_velocity;
        let push = -direction.sign() * system.friction() * pressed;
        let pull = -system.load() * span;
        let fault = (last.disk.angular_speed - first.disk.angular_speed - push - pull).abs();
        let size = system.friction() * (span + system.peak_acceleration());
        let sizes = [size, pull, first.disk.angular_speed, last.disk.angular_speed];
        raise(&mut self.sliding_speed, share(fault, &sizes));
    }

    fn flight(&mut self, record: &EventRecord, shots: &[Snapshot]) {
        self.checked.flights += 1;
        let start = record.segment.state;
        let parabola = |time: f64| {
            let (rise, fall) = (start.axial_velocity * time, 0.5 * time * time);
            (start.height + rise - fall, [start.height, rise, fall])
        };
        let span = record.span.radians();
        for (step, shot) in shots.iter().enumerate() {
            let (height, sizes) = parabola(span * step as f64 / f64::from(CHECKS));
            raise(&mut self.flight, share((shot.disk.height - height).abs(), &sizes));
            raise(&mut self.overlap, share(shot.platform.height - shot.disk.height, &sizes));
        }
        if let (EventKind::Impact, Some(last)) = (record.event.kind(), shots.last()) {
            let (height, sizes) = parabola(span);
            raise(&mut self.impact, share((height - last.platform.height).abs(), &sizes));
        }
    }

    fn impact(&mut self, system: &DimensionlessSystem, record: &EventRecord, velocity: f64) {
        self.checked.impacts += 1;
        let platform = PlatformState::at(system, record.time.phase);
        let (before, after) = (&record.before, &record.after);
        let relative = |speed: f64| speed - platform.axial_velocity;
        let sizes = [before.axial_velocity, after.axial_velocity, platform.axial_velocity];
        let restitution = system.restitution();
        let fault = relative(after.axial_velocity) + restitution * relative(before.axial_velocity);
        raise(&mut self.rebound, share(fault.abs(), &sizes));
        let impulse = after.axial_velocity - before.axial_velocity;
        raise(&mut self.axial_impulse, share((record.axial_impulse - impulse).abs(), &sizes));
        let formula = (1.0 + restitution) * velocity.abs();
        raise(&mut self.axial_impulse, share((record.axial_impulse - formula).abs(), &[formula]));

        let slip = before.angular_speed - platform.angular_speed;
        let available = system.friction() * record.axial_impulse;
        let smaller = available.min(slip.abs());
        let speeds = [before.angular_speed, platform.angular_speed, available];
        let against = if slip > 0.0 { -smaller } else { smaller };
        raise(&mut self.frictional_impulse, share((record.angular_impulse - against).abs(), &speeds));
        let left = after.angular_speed - platform.angular_speed;
        let rounding = 8.0 * f64::EPSILON * speeds.iter().map(|speed| speed.abs()).sum::<f64>();
        self.reversals += u64::from(left * slip < 0.0 && left.abs() > rounding);
    }

    fn change(&mut self, system: &DimensionlessSystem, record: &EventRecord) {
        let platform = PlatformState::at(system, record.time.phase);
        let (friction, load, peak) = (system.friction(), system.load(), system.peak_acceleration());
        match record.event {
            Event::Separation => {
                self.checked.separations += 1;
                raise(&mut self.force_at_separation, share(force(&platform).abs(), &[1.0, peak]));
            }
            Event::StickToSlip(_) => {
                self.checked.slip_onsets += 1;
                let needed = (load - platform.angle).abs();
                let terms = [load, system.twist_speed(), friction * (1.0 + peak)];
                let missing = friction * force(&platform) - needed;
                raise(&mut self.slip_onset, share(missing, &terms));
            }
            Event::SlipToStick | Event::SlipReversal(_) => {
                self.checked.slip_ends += 1;
                // The segment's own end, before the speed is set to the platform's.
                let end = record.evaluate(system, 1.0);
                let slip = (end.disk.angular_speed - end.platform.angular_speed).abs();
                // The terms whose sum vanishes: the speed at the start, what friction and load have changed, and
                // the platform's speed.
                let pushed = friction * (record.span.radians() + peak);
                let pulled = load * record.span.radians();
                let sizes = [record.segment.state.angular_speed, pushed, pulled, system.twist_speed()];
                raise(&mut self.slip_end, share(slip, &sizes));
            }
            _ => {}
        }
    }
}
