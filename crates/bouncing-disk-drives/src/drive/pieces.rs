//! A period of polynomial pieces of degree at most 3: the first impact is found piece by piece, in closed
//! form if the gap is of degree 2.
//!
//! Gap, velocity and their errors are carried across a joint, so a flight of 1e-12 rad across a joint keeps
//! its digits. After 0.05 rad whole blocks of pieces may be skipped: the disk's parabola is lowest at one end
//! of an interval, and a tree stores the highest points of 1, 2, 4, ... pieces. After a skip the gap is the
//! difference of two heights.

use core::f64::consts::TAU;
use std::sync::Arc;

use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::parts::within;
use bouncing_disk_core::{Error, Vibration};

use super::landing::{Doubt, Found, Start, decided};
use super::{Drive, DriveBounds, DriveState, ROUNDING, Shape, TimeAhead};
use crate::quasi_polynomial::{Jet, QuasiPolynomial, Root};

/// Largest number of pieces of a drive.
pub const MAX_PIECES: usize = 1 << 20;

/// A jump below this share of the largest height or velocity counts as rounding.
const JOINT_ROUNDING: f64 = 1.0e-12;

/// Time (rad) after the start of a search before which no pieces are skipped: skipping computes the gap from
/// the heights of disk and platform, whose rounding would affect a shorter flight.
const FIRST_PASS: f64 = 0.05;

#[derive(Debug, PartialEq)]
pub(crate) struct Pieces {
    /// The start of each piece, and 2 pi.
    pub(super) starts: Vec<f64>,
    pub(super) coefficients: Vec<[f64; 4]>,
    /// The jump of the velocity at the start of each piece.
    pub(super) jumps: Vec<f64>,
    /// The times and sizes of the jumps of the velocity.
    kinks: Vec<(f64, f64)>,
    /// For each piece, the first piece (this or a later one) in which a contact that exists at its start
    /// ends; the number of pieces if it never ends.
    exits: Vec<u32>,
    /// The sum over a period of the jumps of height and velocity that count as rounding. The gap carried from
    /// joint to joint differs by this from the gap computed from the heights.
    pub(super) joint_rounding: [f64; 2],
    /// The highest point of each piece, of each pair, of each four, and so on.
    tops: Vec<Vec<f64>>,
    pub(super) bounds: DriveBounds,
}

impl Drive {
    /// Consecutive pieces (duration, [c0, c1, c2, c3]) from time 0, each c0 + c1 t + c2 t^2 + c3 t^3 in the
    /// time t since its own start. Together they form a period of 2 pi, which repeats. The height must be
    /// continuous; a jump of the velocity is a kink.
    ///
    /// ```
    /// use std::f64::consts::PI;
    ///
    /// use bouncing_disk_core::Error;
    /// use bouncing_disk_drives::Drive;
    ///
    /// let step = Drive::pieces(&[(PI, [0.0, 1.0, 0.0, 0.0]), (PI, [3.0, -3.0 / PI, 0.0, 0.0])]);
    /// assert!(matches!(step, Err(Error::HeightJump { piece: 1, jump }) if (jump - (3.0 - PI)).abs() < 1e-15));
    /// ```
    ///
    /// # Errors
    /// [`Error::NotOfKind`] names a piece whose numbers are not finite or that has no duration;
    /// [`Error::OutOfRange`] if the durations do not add up to 2 pi, or for accelerations beyond
    /// [`Vibration::MAX_PEAK_ACCELERATION`]; [`Error::HeightJump`]; [`Error::TooLarge`] beyond
    /// [`MAX_PIECES`].
    pub fn pieces(pieces: &[(f64, [f64; 4])]) -> Result<Self, Error> {
        let count = pieces.len();
        if count > MAX_PIECES {
            return Err(Error::TooLarge { what: "pieces", count: count as u64, limit: MAX_PIECES as u64 });
        }
        let mut starts = Vec::with_capacity(count + 1);
        let mut time = 0.0;
        for (index, (duration, coefficients)) in pieces.iter().enumerate() {
            if !(duration.is_finite() && *duration > 0.0 && coefficients.iter().all(|c| c.is_finite())) {
                let expected = "finite with a positive duration";
                return Err(Error::NotOfKind { what: "piece", index, count, expected });
            }
            starts.push(time);
            time += duration;
        }
        let rounding = 1.0e-12 * TAU;
        within(
            "sum of the durations of the pieces",
            time,
            TAU - rounding,
            TAU + rounding,
            "2 pi (one period)",
        )?;
        starts.push(TAU);
        Self::joined(starts, pieces.iter().map(|&(_, coefficients)| coefficients).collect())
    }

    /// Pieces that begin at these times; the last time is 2 pi.
    pub(super) fn joined(starts: Vec<f64>, coefficients: Vec<[f64; 4]>) -> Result<Self, Error> {
        let mut pieces = Pieces {
            starts,
            coefficients,
            jumps: Vec::new(),
            kinks: Vec::new(),
            exits: Vec::new(),
            joint_rounding: [0.0; 2],
            tops: Vec::new(),
            bounds: NONE,
        };
        pieces.bounds = pieces.measured();
        let bounds = pieces.bounds;
        let most = Vibration::MAX_PEAK_ACCELERATION;
        within("acceleration of a drive", bounds.acceleration, 0.0, most, "[0, 1e8] (units of g)")?;
        pieces.join()?;
        pieces.find_exits();
        Ok(Self { shape: Shape::Pieces(Arc::new(pieces)) })
    }

    /// A triangle that rises from 0 to `amplitude` in the first quarter of the period, like the sine.
    ///
    /// # Errors
    /// Errors of [`Self::sawtooth`].
    pub fn triangle(amplitude: f64) -> Result<Self, Error> {
        Self::sawtooth(amplitude, 0.5)
    }

    /// A sawtooth that rises for the share `rise` of the period, in [1e-9, 1 - 1e-9], and falls for the rest:
    /// from 0 at time 0 to `amplitude`, down to -`amplitude`, and back to 0.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for numbers outside their range.
    pub fn sawtooth(amplitude: f64, rise: f64) -> Result<Self, Error> {
        let a = within("amplitude", amplitude, 0.0, 1.0e8, "[0, 1e8] (units of g/omega^2)")?;
        within("rise", rise, 1.0e-9, 1.0 - 1.0e-9, "[1e-9, 1 - 1e-9], a share of the period")?;
        let (crest, trough) = (0.5 * rise * TAU, (1.0 - 0.5 * rise) * TAU);
        let (up, down) = (a / crest, -2.0 * a / (trough - crest));
        Self::joined(
            vec![0.0, crest, trough, TAU],
            vec![[0.0, up, 0.0, 0.0], [a, down, 0.0, 0.0], [-a, up, 0.0, 0.0]],
        )
    }

    /// The quadratic approximation of `amplitude` sin t: (4/pi^2) t (pi - t) on [0, pi], and the negative of
    /// it on the second half.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an amplitude outside its range.
    pub fn parabolas(amplitude: f64) -> Result<Self, Error> {
        let a = within("amplitude", amplitude, 0.0, 1.0e8, "[0, 1e8] (units of g/omega^2)")?;
        let (half, slope, bend) = (0.5 * TAU, 8.0 * a / TAU, 16.0 * a / (TAU * TAU));
        Self::joined(vec![0.0, half, TAU], vec![[0.0, slope, -bend, 0.0], [0.0, -slope, bend, 0.0]])
    }

    /// The cubic approximation of `amplitude` sin t through its zeros and extremes: (3 x - x^3)/2, x = 2
    /// t/pi, on the first quarter, and its reflections. Its acceleration is continuous.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an amplitude outside its range.
    pub fn cubics(amplitude: f64) -> Result<Self, Error> {
        let a = within("amplitude", amplitude, 0.0, 1.0e8, "[0, 1e8] (units of g/omega^2)")?;
        let q = 0.25 * TAU;
        let (slope, bend, third) = (1.5 * a / q, 1.5 * a / (q * q), 0.5 * a / (q * q * q));
        Self::joined(
            vec![0.0, q, 2.0 * q, 3.0 * q, TAU],
            vec![
                [0.0, slope, 0.0, -third],
                [a, 0.0, -bend, third],
                [0.0, -slope, 0.0, third],
                [-a, 0.0, bend, -third],
            ],
        )
    }
}

const NONE: DriveBounds = DriveBounds { lowest: 0.0, highest: 0.0, speed: 0.0, acceleration: 0.0, jerk: 0.0 };

/// Value and derivatives of a piece at a time since its start.
fn at([c0, c1, c2, c3]: [f64; 4], x: f64) -> DriveState {
    DriveState {
        height: c0 + x * (c1 + x * (c2 + x * c3)),
        velocity: c1 + x * (2.0 * c2 + x * (3.0 * c3)),
        acceleration: 2.0 * c2 + x * (6.0 * c3),
        jerk: 6.0 * c3,
    }
}

/// The gap between two joints: value, slope and their errors; second and third derivative.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    gap: f64,
    velocity: f64,
    error: [f64; 2],
    bend: f64,
    bend_error: f64,
    third: f64,
}

impl Pieces {
    pub(super) fn count(&self) -> usize {
        self.coefficients.len()
    }

    /// The piece at a time in [0, 2 pi).
    fn index(&self, time: f64) -> usize {
        let after = if self.count() <= 8 {
            self.starts.iter().take_while(|&&start| start <= time).count()
        } else {
            self.starts.partition_point(|&start| start <= time)
        };
        after.saturating_sub(1).min(self.count() - 1)
    }

    pub(super) fn length(&self, piece: usize) -> f64 {
        self.starts[piece + 1] - self.starts[piece]
    }

    pub(super) fn at(&self, time: f64) -> DriveState {
        let piece = self.index(time);
        at(self.coefficients[piece], time - self.starts[piece])
    }

    pub(super) fn velocity_jump(&self, time: f64) -> f64 {
        let piece = self.index(time);
        if self.starts[piece].to_bits() == time.to_bits() { self.jumps[piece] } else { 0.0 }
    }

    pub(super) fn kinks(&self) -> &[(f64, f64)] {
        &self.kinks
    }

    /// The next kink after a time in [0, 2 pi).
    pub(super) fn next_kink(&self, time: f64) -> Option<TimeAhead> {
        let next = self.kinks.partition_point(|&(kink, _)| kink <= time);
        let (ahead, &(kink, velocity_jump)) = match self.kinks.get(next) {
            Some(kink) => (0.0, kink),
            None => (TAU, self.kinks.first()?),
        };
        Some(TimeAhead { after: kink + (ahead - time), time: kink, velocity_jump })
    }

    /// The next joint after a time in [0, 2 pi).
    pub(super) fn next_joint(&self, time: f64) -> TimeAhead {
        let piece = self.index(time);
        let next = (piece + 1) % self.count();
        let after = self.starts[piece + 1] - time;
        TimeAhead { after, time: self.starts[next], velocity_jump: self.jumps[next] }
    }

    /// The same motion, with the period beginning at a phase in (0, 2 pi): the piece at this phase is cut in
    /// two.
    pub(super) fn earlier(&self, phase: f64) -> Result<Drive, Error> {
        let (cut, here) = (self.index(phase), self.at(phase));
        let first = [here.height, here.velocity, 0.5 * here.acceleration, here.jerk / 6.0];
        let others = (cut + 1..self.count()).chain(0..cut);
        let mut pieces = vec![(self.starts[cut + 1] - phase, first)];
        pieces.extend(others.map(|piece| (self.length(piece), self.coefficients[piece])));
        let rest = phase - self.starts[cut];
        if rest > 0.0 {
            pieces.push((rest, self.coefficients[cut]));
        }
        Drive::pieces(&pieces)
    }

    /// The bounds, and the highest points.
    fn measured(&mut self) -> DriveBounds {
        let mut bounds = DriveBounds { lowest: f64::INFINITY, highest: f64::NEG_INFINITY, ..NONE };
        let mut tops = Vec::with_capacity(self.count());
        for piece in 0..self.count() {
            let (coefficients, length) = (self.coefficients[piece], self.length(piece));
            let [_, c1, c2, c3] = coefficients;
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            // Both ends, and the roots of c1 + 2 c2 x + 3 c3 x^2.
            let root = (c2 * c2 - 3.0 * c1 * c3).max(0.0).sqrt();
            let far = -(c2 + if c2 >= 0.0 { root } else { -root });
            for x in [0.0, length, far / (3.0 * c3), c1 / far] {
                if x >= 0.0 && x <= length {
                    let height = at(coefficients, x).height;
                    (low, high) = (low.min(height), high.max(height));
                }
            }
            tops.push(high);
            let end = at(coefficients, length);
            let middle = if c3 == 0.0 { 0.0 } else { (c1 - c2 * c2 / (3.0 * c3)).abs() };
            let inner = if c3 != 0.0 && (0.0..=length).contains(&(-c2 / (3.0 * c3))) { middle } else { 0.0 };
            bounds.lowest = bounds.lowest.min(low);
            bounds.highest = bounds.highest.max(high);
            bounds.speed = bounds.speed.max(c1.abs()).max(end.velocity.abs()).max(inner);
            bounds.acceleration = bounds.acceleration.max(2.0 * c2.abs()).max(end.acceleration.abs());
            bounds.jerk = bounds.jerk.max(6.0 * c3.abs());
        }
        // Far above rounding, so that a disk above it is above the platform.
        let slack = 1.0e-9 * (bounds.highest - bounds.lowest) + 1.0e-14 * bounds.highest.abs();
        (bounds.lowest, bounds.highest) = (bounds.lowest - slack, bounds.highest + slack);
        self.tops.push(tops);
        while let Some(level) = self.tops.last().filter(|level| level.len() >= 16) {
            let next =
                level.chunks(2).map(|two| two.iter().fold(f64::NEG_INFINITY, |a, &b| a.max(b))).collect();
            self.tops.push(next);
        }
        bounds
    }

    /// Compares the ends of neighbouring pieces.
    fn join(&mut self) -> Result<(), Error> {
        let count = self.count();
        let ends: Vec<_> = (0..count).map(|piece| at(self.coefficients[piece], self.length(piece))).collect();
        let height = self.bounds.highest.abs().max(self.bounds.lowest.abs());
        for piece in 0..count {
            let before = ends[(piece + count - 1) % count];
            let [c0, c1, ..] = self.coefficients[piece];
            let jump = c0 - before.height;
            // The times of the joints are rounded.
            if jump.abs() > JOINT_ROUNDING * height + 4.0 * f64::EPSILON * TAU * self.bounds.speed {
                return Err(Error::HeightJump { piece, jump });
            }
            self.joint_rounding[0] += jump.abs();
            let jump = c1 - before.velocity;
            let is_kink = jump.abs() > JOINT_ROUNDING * self.bounds.speed;
            self.jumps.push(if is_kink { jump } else { 0.0 });
            self.joint_rounding[1] += if is_kink { 0.0 } else { jump.abs() };
        }
        let jumps = self.starts.iter().copied().zip(self.jumps.iter().copied());
        self.kinks = jumps.filter(|&(_, jump)| jump != 0.0).collect();
        Ok(())
    }

    /// The contact force at the start of a piece, and its rate of change.
    fn force(&self, piece: usize) -> (f64, f64) {
        let [_, _, c2, c3] = self.coefficients[piece];
        (1.0 + 2.0 * c2, 6.0 * c3)
    }

    /// Whether the force, with its value `here` given, is below zero by more than rounding here or at the end
    /// of the piece.
    fn falls_below(&self, piece: usize, here: f64) -> bool {
        let (force, change) = self.force(piece);
        here.min(force + change * self.length(piece)) < -self.bounds.doubtful_pull(TAU)
    }

    /// [`Drive::leaves`].
    pub(super) fn leaves(&self, time: f64) -> bool {
        self.falls_below(self.index(time), 1.0 + self.at(time).acceleration)
    }

    fn find_exits(&mut self) {
        let count = self.count();
        let leaves = |piece: usize| self.jumps[piece] != 0.0 || self.falls_below(piece, self.force(piece).0);
        let mut exits = vec![count as u32; count];
        // Two rounds, so that each piece takes the next period into account.
        let mut next = count as u32;
        for piece in (0..count).rev().chain((0..count).rev()) {
            if leaves(piece) {
                next = piece as u32;
            }
            exits[piece] = next;
        }
        self.exits = exits;
    }

    /// [`Drive::contact_end`].
    pub(super) fn contact_end(&self, time: f64, limit: f64) -> Option<TimeAhead> {
        let ahead =
            |after, time, velocity_jump| (after <= limit).then_some(TimeAhead { after, time, velocity_jump });
        let piece = self.index(time);
        let (force, change) = self.force(piece);
        let here = force + change * (time - self.starts[piece]);
        if self.leaves(time) {
            let after = if here > 0.0 { here / -change } else { 0.0 };
            return ahead(after, time + after, 0.0);
        }
        let joint = self.next_joint(time);
        let left = joint.after;
        let next = (piece + 1) % self.count();
        let exit = self.exits[next] as usize;
        if exit == self.count() {
            return None;
        }
        let (force, change) = self.force(exit);
        let inner = if self.jumps[exit] != 0.0 || force <= 0.0 { 0.0 } else { force / -change };
        let at = self.starts[exit];
        // Counted from the joint, so that rounding does not affect a brief contact.
        let way = if at >= joint.time { at - joint.time } else { at - joint.time + TAU };
        ahead(left + way + inner, at + inner, self.jumps[exit])
    }

    /// The least and the largest contact force from `time` on for a `duration`.
    pub(super) fn pull_within(&self, time: f64, duration: f64) -> Option<(f64, f64)> {
        let mut piece = self.index(time);
        let (mut x, mut left) = (time - self.starts[piece], duration);
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        loop {
            let (force, change) = self.force(piece);
            let end = (x + left).min(self.length(piece));
            for force in [force + change * x, force + change * end] {
                (least, most) = (least.min(force), most.max(force));
            }
            left -= end - x;
            if left <= 0.0 {
                let rounding = ROUNDING * (1.0 + self.bounds.acceleration);
                return Some((least - rounding, most + rounding));
            }
            piece = (piece + 1) % self.count();
            if self.jumps[piece] != 0.0 {
                return None;
            }
            x = 0.0;
        }
    }

    /// The first impact within `to`.
    pub(super) fn window(&self, start: Start, first_error: [f64; 2], to: f64) -> Result<Found, Error> {
        let time = if start.time >= TAU || start.time < 0.0 { wrapped_angle(start.time) } else { start.time };
        let mut piece = self.index(time);
        let mut x = time - self.starts[piece];
        let mut left = self.starts[piece + 1] - time;
        let (mut gap, mut velocity, mut error) = (start.gap, start.velocity, first_error);
        let here = at(self.coefficients[piece], x);
        let (disk_height, disk_speed) = (here.height + gap, here.velocity + velocity);
        let mut elapsed = 0.0;
        let mut found = Found::default();
        let mut at_joint = x == 0.0;
        // The disk hits the highest piece at the latest: within one period, two with partial pieces at both
        // ends.
        let most = 4 * self.count() + 16;
        for entered in 0..most {
            let [_, _, c2, c3] = self.coefficients[piece];
            let mut bend = -1.0 - (2.0 * c2 + x * (6.0 * c3));
            let bend_error = ROUNDING * (1.0 + 2.0 * c2.abs() + 6.0 * (x * c3).abs());
            if entered == 0 {
                bend = start.bend(bend, &self.bounds);
            }
            let stretch = Stretch { gap, velocity, error, bend, bend_error, third: -6.0 * c3 };
            let this = stretch.first_root(left.min(to - elapsed))?;
            found.evaluations += this.evaluations;
            if found.doubt.is_none() {
                found.doubt = this.doubt.map(|doubt| Doubt { at: doubt.at + elapsed, ..doubt });
            }
            let next = (piece + 1) % self.count();
            if let Some(root) = this.root {
                // Also if only the rounding of the phase puts it on the kink.
                let rounding = f64::EPSILON * (time + elapsed);
                let near = |distance: f64| distance.abs() <= root.error + rounding;
                found.on_kink = near(root.at - left) && self.jumps[next] != 0.0
                    || at_joint && near(root.at) && self.jumps[piece] != 0.0;
                let leaves = root.slope - self.jumps[next];
                if (root.at - left).abs() <= root.error && leaves > 0.0 {
                    // A crest or a corner, hit or missed.
                    let bound = root.error * leaves.max(-root.slope);
                    found.doubt = found.doubt.or(Some(Doubt { at: elapsed + root.at, bound }));
                }
                found.piece = Some((self.starts[piece], self.starts[piece + 1]));
                found.root = Some(Root { at: elapsed + root.at, error: root.error, ..root });
                return Ok(found);
            }
            if elapsed + left >= to {
                return Ok(found);
            }
            (gap, velocity, error) = stretch.end(left);
            elapsed += left;
            if self.jumps[next] != 0.0 {
                velocity -= self.jumps[next];
                error[1] += ROUNDING * self.bounds.speed;
            }
            if gap <= error[0] && error[0] > 0.0 && velocity > -error[1] {
                // A crest or a corner, missed or touched.
                found.doubt = found.doubt.or(Some(Doubt { at: elapsed, bound: 2.0 * error[0] }));
            }
            gap = gap.max(0.0);
            (piece, x, at_joint) = (next, 0.0, true);
            left = self.length(piece);
            if (elapsed >= FIRST_PASS || first_error[0] > 0.0)
                && let Some((passed, after)) = self.pass(piece, elapsed, disk_height, disk_speed)
            {
                if after >= to {
                    return Ok(found);
                }
                (piece, elapsed) = (passed, after);
                left = self.length(piece);
                let t = elapsed;
                let platform = at(self.coefficients[piece], 0.0);
                gap = (disk_height - platform.height) + t * (disk_speed - 0.5 * t);
                velocity = (disk_speed - t) - platform.velocity;
                let size = self.bounds.highest.abs() + self.bounds.lowest.abs();
                let speed = disk_speed.abs() + t + self.bounds.speed;
                let [height_rounding, speed_rounding] = self.joint_rounding;
                error = [
                    height_rounding
                        + t * speed_rounding
                        + first_error[0]
                        + t * first_error[1]
                        + ROUNDING * (disk_height.abs() + size + t * speed),
                    speed_rounding + first_error[1] + ROUNDING * speed,
                ];
            }
        }
        Err(Error::NoConvergence { evaluations: found.evaluations, time: elapsed, gap })
    }

    /// The piece up to which the disk is certainly above the platform, and the start of this piece: over an
    /// interval a falling disk's parabola is lowest at one end.
    fn pass(&self, from: usize, elapsed: f64, height: f64, speed: f64) -> Option<(usize, f64)> {
        let disk = |t: f64| height + t * (speed - 0.5 * t);
        let slack = 1.0e-9 * (self.bounds.highest - self.bounds.lowest);
        let mut passed = None;
        let (mut piece, mut t) = (from, elapsed);
        loop {
            let low = disk(t);
            let mut step = None;
            for (level, tops) in self.tops.iter().enumerate() {
                let (size, block) = (1_usize << level, piece >> level);
                if block << level != piece {
                    break;
                }
                let end = (piece + size).min(self.count());
                let after = t + (self.starts[end] - self.starts[piece]);
                if low.min(disk(after)) <= tops[block] + slack {
                    break;
                }
                step = Some((end % self.count(), after));
            }
            let Some((next, after)) = step else { return passed };
            if after > elapsed + TAU {
                return passed;
            }
            passed = step;
            (piece, t) = (next, after);
        }
    }
}

impl Stretch {
    /// Gap, velocity and errors at the distance t.
    fn end(&self, t: f64) -> (f64, f64, [f64; 2]) {
        let (a, j) = (self.bend, self.third);
        let change = t * (a + 0.5 * t * j);
        let gap = self.gap + t * (self.velocity + t * (0.5 * a + t * j * (1.0 / 6.0)));
        let pulls = t * (a.abs() + 0.5 * t * j.abs());
        let slope_error = self.error[1] + ROUNDING * (self.velocity.abs() + pulls) + t * self.bend_error;
        let error =
            self.error[0] + t * slope_error + ROUNDING * (self.gap + t * (self.velocity.abs() + pulls));
        (gap, self.velocity + change, [error, slope_error])
    }

    fn starts_on_platform(&self) -> bool {
        self.gap == 0.0 && self.error[0] == 0.0
    }

    /// The first root in (0, `to`].
    fn first_root(&self, to: f64) -> Result<Found, Error> {
        if self.gap <= 0.0 && self.velocity < 0.0 {
            return Ok(Found { root: Some(self.root(0.0)), evaluations: 1, ..Found::default() });
        }
        if self.starts_on_platform() {
            // The zero at the start is divided out.
            return Ok(self.quadratic([self.velocity, 0.5 * self.bend, self.third * (1.0 / 6.0)], to, true));
        }
        if self.third == 0.0 {
            return Ok(self.quadratic([self.gap, self.velocity, 0.5 * self.bend], to, false));
        }
        // Positive by its Bernstein coefficients?
        let (g, v) = (self.gap - self.error[0], (self.velocity - self.error[1]) * to);
        let (a, j) = (self.bend * to * to, self.third * to * to * to);
        let rounding = ROUNDING * 4.0 * (g.abs() + v.abs() + a.abs() + j.abs());
        let end = g + v + 0.5 * a + j * (1.0 / 6.0);
        if [g, g + v * (1.0 / 3.0), g + v * (2.0 / 3.0) + a * (1.0 / 6.0), end].iter().all(|&b| b > rounding)
        {
            return Ok(Found { evaluations: 1, ..Found::default() });
        }
        let cubic = QuasiPolynomial::known(
            [self.gap, self.velocity],
            self.error,
            [0.5 * self.bend, self.third * (1.0 / 6.0)],
            Vec::new(),
        );
        decided(&cubic, to)
    }

    fn root(&self, t: f64) -> Root {
        let (value, slope, [error, slope_error]) = self.end(t);
        let bend = self.bend + t * self.third;
        let jet = Jet { value, slope, bend, third: self.third, error, slope_error, ..Jet::default() };
        let (mut error, doubt) = jet.root_error();
        if self.starts_on_platform() && t < 1.0e-140 {
            // The error of the gap underflows.
            error = 4.0 * t * (slope_error / slope.abs());
        }
        Root { at: t, error: error + ROUNDING * t, slope, doubt, evaluations: 1 }
    }

    /// The first root in (0, `to`] of c + b t + a t^2, which leaves zero or is positive at 0; `divided` means
    /// that this is the gap divided by t.
    fn quadratic(&self, [c, b, a]: [f64; 3], to: f64, divided: bool) -> Found {
        let mut found = Found { evaluations: 1, ..Found::default() };
        let radicand = b * b - 4.0 * a * c;
        let root = if radicand > 0.0 { radicand.sqrt() } else { 0.0 };
        if a > 0.0 && b < 0.0 {
            // It falls and rises again: rounding may decide whether it reaches zero.
            let lowest = -0.5 * b / a;
            let value = (c - 0.25 * b * b / a) * if divided { lowest } else { 1.0 };
            let (_, _, [error, _]) = self.end(lowest);
            if lowest <= to && value.abs() <= error {
                found.doubt = Some(Doubt { at: lowest, bound: 2.0 * error });
            }
            if radicand < 0.0 {
                return found;
            }
        }
        let t = if c == 0.0 && divided {
            // From rest.
            if b > 0.0 { -b / a } else { f64::NAN }
        } else if a >= 0.0 {
            if b < 0.0 { 2.0 * c / (root - b) } else { f64::NAN }
        } else if b <= 0.0 {
            2.0 * c / (root - b)
        } else {
            -0.5 * (b + root) / a
        };
        if t >= 0.0 && t <= to {
            found.take(self.root(t));
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_join_is_refused_with_its_place() {
        let line = |c0: f64, c1: f64| [c0, c1, 0.0, 0.0];
        let half = 0.5 * TAU;
        let refusal = |pieces: &[(f64, [f64; 4])]| Drive::pieces(pieces).expect_err("refused");
        assert!(matches!(
            refusal(&[(half, line(0.0, 1.0)), (half, line(half + 1e-9, -1.0 - 1e-9 / half))]),
            Error::HeightJump { piece: 1, jump } if (jump - 1e-9).abs() < 1e-15
        ));
        assert!(matches!(refusal(&[(half, line(0.0, 0.0))]), Error::OutOfRange { .. }));
        assert!(matches!(refusal(&[]), Error::OutOfRange { .. }));
        assert!(matches!(
            refusal(&[(half, line(0.0, 0.0)), (half, line(f64::NAN, 0.0))]),
            Error::NotOfKind { index: 1, .. }
        ));
        assert!(matches!(refusal(&[(TAU, [0.0, 0.0, 1e9, 0.0])]), Error::OutOfRange { .. }));
    }
}
