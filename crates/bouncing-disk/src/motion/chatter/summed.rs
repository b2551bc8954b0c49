//! A chatter in closed form: pieces of many impacts in which the disk slides one way or follows the platform.
//!
//! With y = r^n at impact n, friction's margin for either direction, divided by y, is a polynomial of sixth
//! order (docs/numerics-impacts.md, "The rotary motion of a chatter"). Its first zero is found on the monotonic
//! stretches between the zeros of its derivative; the index of the impact is ln y/ln r, checked against its
//! neighbours. The margin changes its sign at most five times, at least twice between the start and the end of
//! a slip. So there are at most three slips in either direction and one from the start, hence at most 16
//! pieces. If friction only just holds, rounding decides at each impact on about 1e-16 of the impulses. From
//! the sixteenth on, each piece therefore covers at least twice as many impacts as the previous one.
//! sixteenth on, each piece therefore covers at least twice as many impacts as the one before.

use bouncing_disk_core::chatter::{ChatterSeries, ImpactRange, PowerSeries};
use bouncing_disk_core::numerics::elementary::sin_cos;
use bouncing_disk_core::{Launch, Phase};

use crate::motion::chatter::Chatter;
use crate::motion::impact::friction_impact;
use crate::motion::impact_energy::{record_friction_impulse, record_slip_end};
use crate::motion::rotary_change::RotaryChange;
use crate::motion::rotary_change::{change_in_flight, record_flight_load};
use crate::parameters::dimensionless::DimensionlessSystem;

/// Largest number of pieces that a chatter can have according to the signs of friction's margin
/// (docs/numerics-impacts.md, "The rotary motion of a chatter"). More arise only if rounding decides at every
/// impact whether friction holds; each of them is then twice as long as the previous one.
const USUAL_PIECES: u32 = 16;

/// Largest number of pieces with rounding: 64 doublings reach 2^64 impacts, the end. The largest numbers seen
/// are 5 pieces by the signs, and 22 with rounding, at r = 1 - 2^-53.
const MAX_PIECES: u32 = USUAL_PIECES + 64;

impl Chatter {
    /// The whole sequence up to `duration` at once; returns the number of pieces.
    pub(super) fn sum(&mut self, system: &DimensionlessSystem, phase: Phase, duration: f64) -> u32 {
        // A launch speed is never negative, but a segment constructed by hand may contain any number.
        let Ok(launch) = Launch::new(phase, self.launch_speed) else { return 0 };
        let series = system.map().chatter_series(launch);
        let end = series.impacts_by(duration);
        if end == Some(0) {
            return 0;
        }
        let all = series.range(0, end);
        self.sum_axial_motion(system, &series, &all, phase.angle() + duration);
        let pieces = Rotation::new(system, &series, self).run(end);

        self.impacts = end.unwrap_or_else(|| series.impacts());
        self.time = end.map_or(series.duration(), |_| all.change(series.remaining()).min(duration));
        self.launch_speed = (1.0 - system.restitution()) * series.launch_speed().at(series.share(end));
        if end.is_none() {
            self.launch_speed = 0.0;
        }
        self.pair = sin_cos(phase.angle() + self.time);
        pieces
    }

    /// Momentum and energy of the axial motion up to an `angle`.
    fn sum_axial_motion(
        &mut self,
        system: &DimensionlessSystem,
        series: &ChatterSeries,
        all: &ImpactRange<'_>,
        angle: f64,
    ) {
        let (restitution, peak) = (system.restitution(), system.peak_acceleration());
        let impulse = series.impact_speed().scaled(1.0 + restitution);
        self.axial_impulse = all.sum(&impulse);
        // The platform's velocity is its initial value minus its loss since then.
        let lost = peak * all.moment(&impulse, series.pair_changes().1);
        let start = peak * self.pair.1;
        let squares = all.product(series.impact_speed(), series.impact_speed());
        let loss = 0.5 * ((1.0 - restitution) * (1.0 + restitution)) * squares;
        self.ledger.record_normal(start * self.axial_impulse - lost, loss);
        // The phase at the end is rounded like its angle, and with it the platform's height.
        self.ledger.record_rounding(angle, start);
    }
}

/// The rotary motion along the sequence.
struct Rotation<'a> {
    system: &'a DimensionlessSystem,
    series: &'a ChatterSeries,
    chatter: &'a mut Chatter,
    /// Axial impulse of an impact divided by 1 - r, and the total impulse still to come.
    impulse: PowerSeries,
    impulses: PowerSeries,
    flight: PowerSeries,
    /// Angular speed of the platform minus a constant.
    platform: PowerSeries,
    /// The increase of the slip by the platform and the load, until the end and during a flight (divided by 1 -
    /// r).
    gain: PowerSeries,
    flight_gain: PowerSeries,
    /// Angular speed of the platform at the start.
    platform_start: f64,
    /// Number of impacts so far.
    impacts: u64,
    /// Angular speed relative to the platform after them.
    slip: f64,
}

impl<'a> Rotation<'a> {
    fn new(system: &'a DimensionlessSystem, series: &'a ChatterSeries, chatter: &'a mut Chatter) -> Self {
        let impulse = series.impact_speed().scaled(1.0 + system.restitution());
        let (sine, cosine) = series.pair_changes();
        let (twist_cosine, twist_sine) = system.twist_components();
        let platform = cosine.scaled(twist_cosine).plus(&sine.scaled(-twist_sine));
        let gain = platform.plus(&series.remaining().scaled(-system.load()));
        let platform_start = system.angular_speed_at(chatter.pair);
        let slip = chatter.angular_speed - platform_start;
        Self {
            system,
            series,
            chatter,
            impulse,
            impulses: series.summed(&impulse),
            flight: series.flight(),
            platform,
            gain,
            flight_gain: series.per_flight(&gain),
            platform_start,
            impacts: 0,
            slip,
        }
    }

    /// Continues to impact `end`, or to the accumulation point; returns the number of pieces.
    fn run(mut self, end: Option<u64>) -> u32 {
        for pieces in 0..MAX_PIECES {
            if end == Some(self.impacts) {
                return pieces;
            }
            // Whether this impact ends the slip decides how the later impacts continue.
            self.strike();
            let held = self.slip == 0.0;
            let until = if held { self.first_slip() } else { self.slip_end() };
            let least = 1_u64 << pieces.saturating_sub(USUAL_PIECES).min(63) >> 1;
            let until = until.map(|until| until.max(self.impacts.saturating_add(least)));
            let until = match (until, end) {
                (Some(until), Some(end)) => Some(until.min(end)),
                (until, end) => until.or(end),
            };
            if until == Some(self.impacts) {
                continue;
            }
            if held {
                self.follow(until);
            } else {
                self.slide(until);
            }
            if until.is_none() {
                return pieces + 1;
            }
        }
        self.stop();
        self.follow(end);
        MAX_PIECES
    }

    /// Removes the remaining slip.
    fn stop(&mut self) {
        let before = self.chatter.angular_speed;
        let platform_speed = before - self.slip;
        record_slip_end(&mut self.chatter.ledger, before, self.slip, platform_speed);
        self.chatter.angular_impulse -= self.slip;
        self.chatter.angular_speed = platform_speed;
        self.slip = 0.0;
    }

    /// The last launch before the first impact in which friction fails to hold a disk that follows the
    /// platform.
    fn first_slip(&self) -> Option<u64> {
        let share = self.series.share(Some(self.impacts));
        [1.0, -1.0]
            .into_iter()
            .filter_map(|sign| {
                let spare = self.spare(sign);
                // The margin in the impulse per r^n, which does not vanish with r^n.
                let spare = self.series.per_flight(&spare).per_share();
                self.series.first_negative(self.impacts, spare.at(share), &spare)
            })
            .min()
    }

    /// The last impact after which a sliding disk is still sliding.
    fn slip_end(&self) -> Option<u64> {
        let sign = self.slip.signum();
        self.series
            .first_negative(self.impacts, sign * self.slip, &self.spare(sign))
            .map(|impact| impact.saturating_sub(1).max(self.impacts))
    }

    /// Friction's margin: the reduction of a slip with this `sign` that friction can achieve, minus the
    /// increase of the slip, until the end.
    fn spare(&self, sign: f64) -> PowerSeries {
        self.impulses.scaled(self.system.friction()).plus(&self.gain.scaled(-sign))
    }

    fn platform_speed(&self, impacts: Option<u64>) -> f64 {
        self.platform_start - self.series.range(0, impacts).change(&self.platform)
    }

    /// The next impact as a single one, as in [`Chatter::advance`].
    fn strike(&mut self) {
        let range = self.series.range(self.impacts, Some(self.impacts + 1));
        let duration = range.change(self.series.remaining());
        let slip = self.slip + range.change(&self.gain);
        let axial = range.change(&self.impulses);
        let rotary = friction_impact(self.system.friction(), axial, slip);
        let change = change_in_flight(self.system.load(), self.chatter.angular_speed, duration);
        record_flight_load(&mut self.chatter.ledger, self.system.load(), self.chatter.angular_speed, &change);
        let platform_speed = self.platform_speed(Some(self.impacts + 1));
        let after = rotary.speed_after(change.speed, platform_speed);
        let ledger = &mut self.chatter.ledger;
        record_friction_impulse(ledger, rotary.impulse, slip, platform_speed);
        ledger.record_rotary_change(change.speed, after);
        self.slip = if rotary.capped { 0.0 } else { slip + rotary.impulse };
        self.chatter.angle += change.angle;
        self.chatter.angular_impulse += rotary.impulse;
        self.chatter.capped = rotary.capped;
        self.chatter.angular_speed = after;
        self.impacts += 1;
    }

    /// Continues sliding to impact `until`.
    fn slide(&mut self, until: Option<u64>) {
        let (load, grip) = (self.system.load(), self.slip.signum() * self.system.friction());
        let range = self.series.range(self.impacts, until);
        let speed = self.chatter.angular_speed;
        let platform_speed = speed - self.slip;
        let duration = range.change(self.series.remaining());
        let impulse = range.change(&self.impulses);
        // Sums of the impulses times the time and the platform's loss of speed since the launch.
        let delay = range.moment(&self.impulse, self.series.remaining());
        let slowed = range.moment(&self.impulse, &self.platform);
        let rotary = -grip * impulse;
        let change = RotaryChange {
            speed: speed - load * duration + rotary,
            angle: duration * (speed - 0.5 * load * duration) - grip * (impulse * duration - delay),
        };
        let work = [rotary * platform_speed, grip * slowed];
        let loss = [grip * self.slip * impulse, -grip * load * delay, grip * slowed, -0.5 * rotary * rotary];
        let size = work.iter().chain(&loss).map(|term| term.abs()).sum();
        let ledger = &mut self.chatter.ledger;
        record_flight_load(ledger, load, speed, &change);
        ledger.record_friction(work.iter().sum(), loss.iter().sum(), size);
        self.chatter.angle += change.angle;
        self.chatter.angular_impulse += rotary;
        self.chatter.angular_speed = change.speed;
        let slip = self.slip + (range.change(&self.gain) + rotary);
        // A slip that has not ended before may end at the accumulation point.
        self.chatter.capped = until.is_none() && slip * self.slip <= 0.0;
        self.slip = if self.chatter.capped { 0.0 } else { slip };
        self.impacts = until.unwrap_or(self.impacts);
    }

    /// Follows the platform to impact `until`.
    fn follow(&mut self, until: Option<u64>) {
        let load = self.system.load();
        let range = self.series.range(self.impacts, until);
        let before = self.chatter.angular_speed;
        let after = self.platform_speed(until);
        let duration = range.change(self.series.remaining());
        let rotary = -range.change(&self.gain);
        let slowed = range.moment(&self.flight_gain, &self.platform);
        let work = [rotary * before, slowed];
        let loss = 0.5 * range.product(&self.flight_gain, &self.flight_gain);
        // During a flight the disk keeps the platform's speed at the launch.
        let lag = range.moment(&self.flight, &self.platform)
            - range.product(&self.flight, &self.series.per_flight(&self.platform));
        let change = RotaryChange {
            speed: after,
            angle: (before * duration - lag) - 0.5 * load * range.product(&self.flight, &self.flight),
        };
        let ledger = &mut self.chatter.ledger;
        record_flight_load(ledger, load, before, &change);
        ledger.record_friction(
            work.iter().sum(),
            loss,
            work.iter().map(|term| term.abs()).sum::<f64>() + loss,
        );
        self.chatter.angle += change.angle;
        self.chatter.angular_impulse += rotary;
        self.chatter.angular_speed = after;
        self.chatter.capped = true;
        self.slip = 0.0;
        self.impacts = until.unwrap_or(self.impacts);
    }
}
