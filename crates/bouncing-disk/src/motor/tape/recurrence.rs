//! The search for a cycle among the touches of a motion.

use std::f64::consts::PI;

use bouncing_disk_core::Phase;

use crate::stator::MODES;

/// A state repeats an earlier one if they differ by less than this share of the largest state seen. A motion
/// must repeat its states over two cycles.
const SAME: f64 = 1.0e-11;

/// A motion that comes this close to a known stable cycle stays on it.
const JOINS: f64 = 1.0e-5;

/// A motion is assumed to approach its cycle by at least this factor per cycle.
const SLOWEST: f64 = 1.0 - 1.0e-5;

/// The size of a component of a state counts as at least this share of the largest size.
const SMALL: f64 = 1.0e-3;

/// A repetition within this time (rad) is not a cycle, which takes at least a period of the drive.
const LEAST_CYCLE: f64 = PI;

/// Touches separated by less than this time (rad) count as one.
pub(crate) const AT_ONCE: f64 = 1.0e-9;

/// Largest number of touches of a cycle.
const LONGEST: u64 = 128;

/// The state in which a disk touches the platform, or leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Key([f64; PARTS]);

const PARTS: usize = 9;

/// Index of the rotor's angular speed.
const SPEED: usize = 4;

impl Key {
    /// The key of a disk that lies on the platform for ever and repeats its motion in each period.
    pub(crate) const LYING: Self = Self([0.0; PARTS]);

    /// The key of a disk with this velocity and height and, if it acts back, angular speed, and the modes of
    /// its stator.
    pub(crate) const fn new(phase: Phase, disk: [f64; 3], modes: [[f64; 2]; MODES]) -> Self {
        let [[a, b], [c, d]] = modes;
        Self([phase.sin(), phase.cos(), disk[0], disk[1], disk[2], a, b, c, d])
    }

    /// The distance from another key: the largest difference of a component as a share of its size. For a
    /// component that stays small, the share of the other sizes counts.
    fn distance(&self, other: &Self, sizes: [f64; PARTS]) -> f64 {
        // The angular speed has a unit of its own.
        let others = sizes.into_iter().enumerate().filter(|(part, _)| *part != SPEED);
        let least = SMALL * others.map(|(_, size)| size).fold(1.0, f64::max);
        let parts = self.0.iter().zip(other.0).zip(sizes);
        parts.map(|((one, other), size)| (one - other).abs() / size.max(least)).fold(0.0, f64::max)
    }
}

/// The result of a recorded step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Touch {
    None,
    At(Key),
    /// The disk lies on the platform for ever.
    Lies,
}

/// The search for a cycle among the touches of a motion, each of which is compared with a reference that is
/// renewed from time to time.
#[derive(Debug, Clone, Default)]
pub(crate) struct Recurrence {
    reference: Option<Key>,
    largest: [f64; PARTS],
    since: u64,
    /// Time (rad) since the reference.
    elapsed: f64,
    renewal: u64,
    /// Number of touches of the cycle that was seen last, and the distance by which this cycle failed to
    /// close.
    seen: Option<(u64, f64)>,
    /// The touches of cycles that other members have reached.
    known: Vec<Vec<Key>>,
}

/// A cycle that was seen twice, or is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Repeats {
    /// The index of a known cycle.
    pub(crate) known: Option<usize>,
    /// Touches of a cycle, or periods for a disk that lies on the platform.
    pub(crate) touches: u64,
    /// Largest remaining distance of the motion from the cycle, as a share of the largest state.
    pub(crate) distance: f64,
}

impl Recurrence {
    /// Adds the result of a step of this duration (rad); returns the cycle, if the motion repeats one.
    pub(crate) fn add(&mut self, touch: Touch, duration: f64) -> Option<Repeats> {
        self.elapsed += duration;
        let key = match touch {
            Touch::None => return None,
            Touch::Lies => return Some(Repeats { known: None, touches: 1, distance: 0.0 }),
            Touch::At(key) => key,
        };
        self.largest = most_of(self.largest, key.0);
        self.since += 1;
        let off = self.reference.map_or(f64::INFINITY, |reference| key.distance(&reference, self.largest));
        // A motion may touch twice at one instant.
        if off < SAME && self.elapsed > LEAST_CYCLE {
            let seen = self.seen.replace((self.since, off));
            let touches = std::mem::take(&mut self.since);
            self.elapsed = 0.0;
            self.reference = Some(key);
            // The remainder of a geometric series that falls as the last two terms do.
            return seen.filter(|seen| seen.0 == touches).map(|(_, before)| {
                let ratio = if before > 0.0 { (off / before).min(SLOWEST) } else { 0.0 };
                Repeats { known: None, touches, distance: off.max(f64::EPSILON) / (1.0 - ratio) }
            });
        }
        if off < JOINS && self.elapsed > LEAST_CYCLE {
            let joined = self.joined(&key);
            if joined.is_some() {
                return joined;
            }
        }
        if self.since >= self.renewal {
            self.renewal = (2 * self.renewal).clamp(1, LONGEST);
            (self.reference, self.since, self.elapsed, self.seen) = (Some(key), 0, 0.0, None);
        }
        None
    }

    /// Registers cycles with these touches that other members have reached.
    pub(crate) fn know(&mut self, cycles: &[&[Key]]) {
        self.known = cycles.iter().map(|touches| touches.to_vec()).collect();
    }

    /// The known cycle that is very close to a touch at which the motion nearly repeats, and closer than one
    /// cycle earlier.
    fn joined(&self, key: &Key) -> Option<Repeats> {
        let reference = self.reference?;
        let distance = |own: &Key| own.distance(key, self.largest);
        let comes =
            |own: &Key| distance(own) < JOINS && distance(own) <= own.distance(&reference, self.largest);
        let is_joined =
            |cycle: &Vec<Key>| self.since.is_multiple_of(cycle.len() as u64) && cycle.iter().any(comes);
        let known = self.known.iter().position(is_joined)?;
        Some(Repeats { known: Some(known), touches: self.known[known].len() as u64, distance: JOINS })
    }
}

/// Touches of one motion that differ by less than this share of the largest are the same.
pub(crate) const ONE: f64 = 1.0e-7;

/// The same for touches of two motions that were found to repeat: if the contact force just touches zero,
/// they differ by about the root of [`SAME`].
pub(crate) const ONE_OF_TWO: f64 = 1.0e-5;

/// Whether two cycles consist of the same touches, shifted by `apart` touches, to within the share `within`
/// of the largest.
pub(crate) fn are_same(one: &[Key], other: &[Key], apart: usize, within: f64) -> bool {
    let sizes = one.iter().fold([0.0; PARTS], |most, key| most_of(most, key.0));
    let other = other.iter().cycle().skip(apart);
    one.iter().zip(other).all(|(one, other)| one.distance(other, sizes) < within)
}

/// A motion whose touch is closer to a cycle than this share of the largest is on its way to the cycle.
const NEAR: f64 = 0.05;

/// Whether a touch is near one of a cycle's touches.
pub(crate) fn is_near(cycle: &[Key], key: &Key) -> bool {
    let sizes = cycle.iter().fold([0.0; PARTS], |most, key| most_of(most, key.0));
    cycle.iter().any(|own| own.distance(key, sizes) < NEAR)
}

fn most_of(one: [f64; PARTS], other: [f64; PARTS]) -> [f64; PARTS] {
    core::array::from_fn(|part| one[part].max(other[part].abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(velocity: f64) -> Key {
        let phase = Phase::new(1.0).expect("legal");
        Key::new(phase, [velocity, 0.0, 0.0], [[0.0; 2]; MODES])
    }

    fn powers(of: f64) -> impl Iterator<Item = f64> {
        std::iter::successors(Some(1.0), move |power| Some(power * of))
    }

    /// The number of touches until a motion with these velocities is found to repeat, and the cycle.
    fn followed(velocities: impl Iterator<Item = f64>, cycle: &[Key]) -> (usize, Option<Repeats>) {
        let mut recurrence = Recurrence::default();
        recurrence.know(&[&[key(7.0)], cycle]);
        let mut touches = 0;
        for velocity in velocities {
            touches += 1;
            if let Some(repeats) = recurrence.add(Touch::At(key(velocity)), 6.0) {
                return (touches, Some(repeats));
            }
        }
        (touches, None)
    }

    #[test]
    fn a_motion_that_comes_to_a_known_cycle_is_followed_until_it_is_near() {
        let comes = |to: f64| powers(0.98).map(move |power| to + power).take(2_000);
        let (touches, repeats) = followed(comes(2.0), &[key(2.0)]);
        let (longer, alone) = followed(comes(3.0), &[key(2.0)]);
        assert_eq!(repeats.and_then(|own| own.known), Some(1));
        assert_eq!(alone.map(|own| own.known), Some(None));
        let left = powers(0.98).nth(touches - 1).expect("endless");
        assert!(left < JOINS * 3.0 && touches < longer, "{touches} {longer}");
    }

    #[test]
    fn a_motion_that_leaves_a_known_cycle_does_not_stay_on_it() {
        let leaves = powers(1.002).map(|power| 2.0 + 1.0e-6 * power).take(400);
        assert_eq!(followed(leaves, &[key(2.0)]), (400, None));
    }
}
