//! The rotary motion of many rotors from impact to impact, in lockstep, as in
//! [`TransientRun::step`](crate::motor::rotor::transient::TransientRun::step).

use bouncing_disk_core::sweep::{Flights, LaneImpacts, LaneLoop};

use crate::motor::rotor::Bounce;
use crate::motor::rotor::transient::{Interval, TransientRun, seconds};
use crate::parameters::dimensionless::DimensionlessSystem;

const LANES: usize = Flights::LANES;

/// One number per lane.
type Row = [f64; LANES];

/// The state advanced along with the flights of all lanes.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub(crate) struct Rotors {
    /// The systems.
    pub(crate) restitution: Row,
    friction: Row,
    load: Row,
    twist_cosine: Row,
    twist_sine: Row,
    /// Unit of time (s), angle (rad) at the start, and duration (s).
    unit: Row,
    start: Row,
    duration: Row,
    /// Angular speed after the last impact.
    speed: Row,
    /// Whole periods since the start.
    periods: Row,
    /// Angle turned in the last flight.
    turned: Row,
    /// The present interval of the curve: its index, its end (s), the angle turned in it, and its duration
    /// (s).
    index: [u64; LANES],
    end: Row,
    sum: Row,
    width: Row,
    /// Times (s) of the last impact and of the previous one.
    reached: Row,
    before: Row,
    impacts: [u64; LANES],
    /// All bits are set in lanes whose last flight ends beyond the present interval, or beyond the duration.
    passed: [u64; LANES],
}

impl Rotors {
    pub(crate) const fn new() -> Self {
        const ROW: Row = [0.0; LANES];
        Self {
            restitution: ROW,
            friction: ROW,
            load: ROW,
            twist_cosine: ROW,
            twist_sine: ROW,
            unit: ROW,
            start: ROW,
            duration: ROW,
            speed: ROW,
            periods: ROW,
            turned: ROW,
            end: ROW,
            sum: ROW,
            width: ROW,
            index: [0; LANES],
            reached: ROW,
            before: ROW,
            impacts: [0; LANES],
            passed: [0; LANES],
        }
    }

    /// Starts a transient in a lane.
    pub(crate) fn begin(&mut self, lane: usize, run: &mut TransientRun, curve: &mut Vec<f64>) {
        let system: &DimensionlessSystem = run.rotor.system();
        self.restitution[lane] = system.restitution();
        self.friction[lane] = system.friction();
        self.load[lane] = system.load();
        (self.twist_cosine[lane], self.twist_sine[lane]) = system.twist_components();
        self.unit[lane] = run.unit.time;
        self.start[lane] = run.start;
        self.duration[lane] = run.duration;
        self.width[lane] = run.bins.width;
        self.take(lane, run, curve);
    }

    /// Takes over motion and curve from a transient that is about to start a flight.
    pub(crate) fn take(&mut self, lane: usize, run: &mut TransientRun, curve: &mut Vec<f64>) {
        self.speed[lane] = run.rotor.speed();
        self.periods[lane] = run.rotor.time().periods as f64;
        self.impacts[lane] = run.impacts;
        self.set_interval(lane, run.bins.present);
        self.reached[lane] = run.bins.present.reached;
        *curve = std::mem::take(&mut run.bins.turned);
    }

    const fn set_interval(&mut self, lane: usize, interval: Interval) {
        self.index[lane] = interval.index as u64;
        self.end[lane] = interval.end;
        self.sum[lane] = interval.turned;
    }

    /// The present interval, up to a given time.
    const fn interval(&self, lane: usize, reached: f64) -> Interval {
        Interval { index: self.index[lane] as usize, end: self.end[lane], turned: self.sum[lane], reached }
    }

    /// Whether the last impact comes at or after the end of the transient.
    pub(crate) fn is_over(&self, lane: usize) -> bool {
        self.reached[lane] >= self.duration[lane]
    }

    /// Moves a transient into another lane, counted through all batches.
    pub(crate) fn move_lane(batches: &mut [Self], from: usize, to: usize) {
        let (source, own) = (&batches[from / LANES], from % LANES);
        let (impacts, index) = (source.impacts[own], source.index[own]);
        // Copies the lane's own numbers only, as a batch takes 10 kB.
        let moved = source.rows().map(|row| row[own]);
        let (target, to) = (&mut batches[to / LANES], to % LANES);
        for (row, value) in target.rows_mut().into_iter().zip(moved) {
            row[to] = value;
        }
        target.impacts[to] = impacts;
        target.index[to] = index;
    }

    /// All rows of numbers, in the order of [`Self::rows_mut`].
    const fn rows(&self) -> [&Row; 16] {
        [
            &self.restitution,
            &self.friction,
            &self.load,
            &self.twist_cosine,
            &self.twist_sine,
            &self.unit,
            &self.start,
            &self.duration,
            &self.speed,
            &self.periods,
            &self.turned,
            &self.end,
            &self.sum,
            &self.width,
            &self.reached,
            &self.before,
        ]
    }

    const fn rows_mut(&mut self) -> [&mut Row; 16] {
        [
            &mut self.restitution,
            &mut self.friction,
            &mut self.load,
            &mut self.twist_cosine,
            &mut self.twist_sine,
            &mut self.unit,
            &mut self.start,
            &mut self.duration,
            &mut self.speed,
            &mut self.periods,
            &mut self.turned,
            &mut self.end,
            &mut self.sum,
            &mut self.width,
            &mut self.reached,
            &mut self.before,
        ]
    }

    /// Returns the curve up to the last impact to its transient.
    pub(crate) fn give_back(&self, lane: usize, run: &mut TransientRun, curve: &mut Vec<f64>) {
        run.bins.present = self.interval(lane, self.reached[lane]);
        run.impacts = self.impacts[lane];
        run.bins.turned = std::mem::take(curve);
    }

    /// Adds a flight that ends in another interval.
    #[inline]
    pub(crate) fn pass_interval(&mut self, lane: usize, curve: &mut [f64]) {
        let to = self.reached[lane];
        if to <= self.end[lane] {
            return;
        }
        let mut interval = self.interval(lane, self.before[lane]);
        interval.pass(curve, self.width[lane], to, self.turned[lane]);
        self.set_interval(lane, interval);
    }

    /// Whole periods up to the last impact, and the angular speed after it.
    pub(crate) const fn motion(&self, lane: usize) -> (u64, f64) {
        (self.periods[lane] as u64, self.speed[lane])
    }

    /// The lanes that need individual work after an impact, one bit for each: an interval or the transient
    /// ends, or the disk may come to rest.
    pub(crate) fn attended(&self, may_rest: &[u64; LANES]) -> u64 {
        let lanes = self.passed.iter().zip(may_rest).enumerate();
        lanes.fold(0, |all, (lane, (passed, rests))| all | ((passed | rests) & (1 << lane)))
    }
}

/// Advances all rotors through a flight and the impact that ends it.
pub(crate) struct Carry<'a> {
    pub(crate) impacts: LaneImpacts<'a>,
    pub(crate) rotors: &'a mut Rotors,
}

impl LaneLoop for Carry<'_> {
    #[inline(always)]
    fn run(self) {
        bounce(&self.impacts, self.rotors);
        count(&self.impacts, self.rotors);
    }
}

#[inline(always)]
fn bounce(impacts: &LaneImpacts<'_>, rotors: &mut Rotors) {
    for lane in 0..LANES {
        let bounce = Bounce {
            duration: impacts.duration(lane),
            // As in `DimensionlessSystem::platform_angular_speed`.
            platform_speed: rotors.twist_cosine[lane] * impacts.cos[lane]
                - rotors.twist_sine[lane] * impacts.sin[lane],
            velocity: impacts.velocity[lane],
            restitution: rotors.restitution[lane],
            friction: rotors.friction[lane],
            load: rotors.load[lane],
        };
        (rotors.speed[lane], rotors.turned[lane]) = bounce.after(rotors.speed[lane]);
    }
}

#[inline(always)]
fn count(impacts: &LaneImpacts<'_>, rotors: &mut Rotors) {
    for lane in 0..LANES {
        let turns = impacts.turns[lane];
        let periods = rotors.periods[lane] + if turns > 0.0 { turns } else { 0.0 };
        let to = seconds(periods, impacts.angle[lane] - rotors.start[lane], rotors.unit[lane]);
        let beyond = to > rotors.end[lane];
        let sum = rotors.sum[lane];
        rotors.periods[lane] = periods;
        rotors.sum[lane] = if beyond { sum } else { sum + rotors.turned[lane] };
        rotors.before[lane] = rotors.reached[lane];
        rotors.reached[lane] = to;
        rotors.impacts[lane] += 1;
        rotors.passed[lane] = u64::from(beyond | (to >= rotors.duration[lane])).wrapping_neg();
    }
}
