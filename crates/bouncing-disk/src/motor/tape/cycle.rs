//! Motions that repeat: when a tape is one cycle, and the rotor that repeats with it.

use std::f64::consts::TAU;

use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::sweep::LaneRunner;
use bouncing_disk_core::{Drive, Phase};

use super::replay::{Done, Replay, Rotors};
use super::source::Source;
use super::window::Window;
use super::{Knot, Tape};
use crate::error::Error;
use crate::motor::batch::rotor_rows::WIDTH;
use crate::stator::{MODES, StatorLedger};

/// A state that differs from an earlier one by less than this share of the largest seen repeats it. Two cycles must.
const SAME: f64 = 1.0e-11;

/// A motion comes nearer to its cycle by at least the rest of this factor.
const SLOWEST: f64 = 1.0 - 1.0e-5;

/// A part of a state counts as at least this share of the largest.
const SMALL: f64 = 1.0e-3;

/// Most touches of a cycle.
const LONGEST: u64 = 128;

/// Where a disk touches the platform, or leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Key([f64; PARTS]);

const PARTS: usize = 9;

/// The place of the rotor's angular speed.
const SPEED: usize = 4;

impl Key {
    /// Of a disk with this velocity and height and, if it acts back, angular speed, and the modes of its stator.
    pub(crate) const fn new(phase: Phase, disk: [f64; 3], modes: [[f64; 2]; MODES]) -> Self {
        let [[a, b], [c, d]] = modes;
        Self([phase.sin(), phase.cos(), disk[0], disk[1], disk[2], a, b, c, d])
    }

    /// How far it is from another one, as the largest share of these sizes; a part that stays small counts as a share of
    /// the others.
    fn distance(&self, other: &Self, sizes: [f64; PARTS]) -> f64 {
        // The angular speed has a unit of its own.
        let others = sizes.into_iter().enumerate().filter(|(part, _)| *part != SPEED);
        let least = SMALL * others.map(|(_, size)| size).fold(1.0, f64::max);
        let parts = self.0.iter().zip(other.0).zip(sizes);
        parts.map(|((one, other), size)| (one - other).abs() / size.max(least)).fold(0.0, f64::max)
    }
}

/// What a recorded step has shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Touch {
    None,
    At(Key),
    /// The disk lies on the platform for ever.
    Lies,
}

/// The search for a cycle among the touches of a motion: each is compared with one that is renewed from time to time.
#[derive(Debug, Clone, Default)]
pub(crate) struct Recurrence {
    reference: Option<Key>,
    largest: [f64; PARTS],
    since: u64,
    renewal: u64,
    /// Touches of the cycle that was seen last, and by how much it missed.
    seen: Option<(u64, f64)>,
}

/// A cycle that was seen twice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Repeats {
    /// Touches of a cycle, or periods of a disk that lies on the platform.
    pub(crate) touches: u64,
    /// How far the motion may still be from the cycle, as a share of the largest state.
    pub(crate) distance: f64,
}

impl Recurrence {
    /// Adds what a step has shown: the cycle, if the motion repeats one.
    pub(crate) fn add(&mut self, touch: Touch) -> Option<Repeats> {
        let key = match touch {
            Touch::None => return None,
            Touch::Lies => return Some(Repeats { touches: 1, distance: 0.0 }),
            Touch::At(key) => key,
        };
        self.largest = most_of(self.largest, key.0);
        self.since += 1;
        let off = self.reference.map_or(f64::INFINITY, |reference| key.distance(&reference, self.largest));
        if off < SAME {
            let seen = self.seen.replace((self.since, off));
            let touches = std::mem::take(&mut self.since);
            self.reference = Some(key);
            // What is left of a geometric series that falls as the last two terms do.
            return seen.filter(|seen| seen.0 == touches).map(|(_, before)| {
                let ratio = if before > 0.0 { (off / before).min(SLOWEST) } else { 0.0 };
                Repeats { touches, distance: off.max(f64::EPSILON) / (1.0 - ratio) }
            });
        }
        if self.since >= self.renewal {
            self.renewal = (2 * self.renewal).clamp(1, LONGEST);
            (self.reference, self.since, self.seen) = (Some(key), 0, None);
        }
        None
    }
}

/// Halvings that find the speed of a rotor that repeats with a cycle, to rounding.
const HALVINGS: u32 = 60;

/// Steps of a contact in a period, in a cycle and in a coarser copy that shows what steps do.
const RESOLUTIONS: [f64; 2] = [2048.0, 1024.0];

/// Touches that differ by less than this share of the largest are one.
const ONE: f64 = 1.0e-7;

/// Most knots of a cycle, of any length.
const MOST_KNOTS: f64 = 65_536.0;

/// Whether two cycles have the same touches, so many touches apart.
fn are_same(one: &[Key], other: &[Key], apart: usize) -> bool {
    let sizes = one.iter().fold([0.0; PARTS], |most, key| most_of(most, key.0));
    let other = other.iter().cycle().skip(apart);
    one.iter().zip(other).all(|(one, other)| one.distance(other, sizes) < ONE)
}

fn most_of(one: [f64; PARTS], other: [f64; PARTS]) -> [f64; PARTS] {
    core::array::from_fn(|part| one[part].max(other[part].abs()))
}

/// What is known of a cycle.
#[derive(Debug, Clone)]
enum Recorded {
    /// Finely and coarsely recorded.
    Tapes(Box<[Tape; 2]>),
    /// What the rotor does in it that it was found with.
    Window(Window),
}

/// A cycle of a vertical motion.
#[derive(Debug, Clone)]
pub(crate) struct Cycle {
    recorded: Recorded,
    touches: Vec<Key>,
    pub(crate) repeats: Repeats,
    /// Periods of the drive.
    pub(crate) periods: u64,
}

impl Cycle {
    /// The cycle that a source repeats from where it is.
    pub(crate) fn record(
        source: &mut Source,
        repeats: Repeats,
        twists: Vec<Drive>,
        work: &mut WorkCount<'_>,
    ) -> Result<Self, Error> {
        let mut record = |resolution: f64, touches: u64| {
            let mut tape = Tape::new(source.phase(), resolution, twists.clone());
            let mut keys = Vec::new();
            while (keys.len() as u64) < touches {
                match source.record(&mut tape, work)? {
                    Touch::None => {}
                    Touch::At(key) => keys.push(key),
                    Touch::Lies => keys.push(Key([0.0; PARTS])),
                }
            }
            Ok::<_, Error>((tape, keys))
        };
        let (rough, keys) = record(1.0, repeats.touches)?;
        let touches = Self::least_touches(&keys);
        let share = touches as f64 / keys.len() as f64;
        let periods = (rough.axial.duration * share / TAU + 0.5) as u64;
        let most = MOST_KNOTS / periods.max(1) as f64;
        let [fine, coarse] = RESOLUTIONS.map(|resolution| record(resolution.min(most), touches));
        let repeats = Repeats { touches, ..repeats };
        let ((fine, keys), (coarse, _)) = (fine?, coarse?);
        let recorded = Recorded::Tapes(Box::new([fine, coarse]));
        Ok(Self { recorded, touches: keys, repeats, periods })
    }

    /// The cycle of a rotor that acts back on its stator.
    pub(crate) fn of_window(window: Window, touches: Vec<Key>, repeats: Repeats) -> Self {
        let periods = (window.axial.duration / TAU + 0.5) as u64;
        Self { recorded: Recorded::Window(window), touches, repeats, periods }
    }

    /// The least number of touches after which all repeat: a motion that comes near to its cycle from both sides in turn
    /// is first seen to repeat several of them.
    pub(crate) fn least_touches(keys: &[Key]) -> u64 {
        let count = keys.len();
        let repeats = |period: &usize| count.is_multiple_of(*period) && are_same(keys, keys, *period);
        (1..count).find(repeats).unwrap_or(count) as u64
    }

    /// Whether two are the same motion, entered at different touches or not.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        self.touches.len() == other.touches.len()
            && self.periods == other.periods
            && (0..self.touches.len()).any(|apart| are_same(&self.touches, &other.touches, apart))
    }

    /// Whether the disk stays on the platform.
    pub(crate) fn is_contact(&self) -> bool {
        let flies = |knot: &Knot| knot.hit > 0.0 || knot.pressed == 0.0 && knot.duration > 0.0;
        match &self.recorded {
            Recorded::Tapes(tapes) => !tapes[0].knots.iter().any(flies),
            Recorded::Window(_) => false,
        }
    }

    /// What rotors do in a cycle at whose end each is as fast as at its start: on the fine and on the coarse tape, in
    /// the order of these places. Their speeds lie within these sizes.
    pub(crate) fn windows(
        &self,
        rotors: &[Rotors],
        places: &[(usize, usize)],
        largest: &[f64],
        runner: &LaneRunner,
    ) -> [Window; 2] {
        let mut bounds = vec![[0.0; WIDTH]; rotors.len()];
        for (&(row, own), largest) in places.iter().zip(largest) {
            bounds[row][own] = *largest;
        }
        [0, 1].map(|index| {
            let tape = match &self.recorded {
                Recorded::Tapes(tapes) => &tapes[index],
                Recorded::Window(window) => return window.clone(),
            };
            let mut rotors: Vec<Rotors> = rotors.iter().map(Rotors::at_own_inertia).collect();
            let (mut low, mut high) =
                (bounds.iter().map(|row| row.map(|size| -size)).collect::<Vec<_>>(), bounds.clone());
            let mut middle = vec![[0.0; WIDTH]; rotors.len()];
            for step in 0..=HALVINGS {
                for (row, rotors) in rotors.iter_mut().enumerate() {
                    for own in 0..WIDTH {
                        // Rotors never overtake each other, and come nearer: one that gains is too slow.
                        if step > 0 {
                            let gains = rotors.rows.speed[own] > middle[row][own];
                            let end = if gains { &mut low[row][own] } else { &mut high[row][own] };
                            *end = middle[row][own];
                        }
                        middle[row][own] = 0.5 * (low[row][own] + high[row][own]);
                    }
                    rotors.rows.speed = middle[row];
                    rotors.rows.tally = Done::default();
                }
                runner.run(Replay { tape, rotors: &mut rotors });
            }
            let axial = tape.axial;
            let stator = (tape.stator != StatorLedger::default()).then_some((tape.stator, axial));
            let done = |&(row, own): &(usize, usize)| {
                rotors[row].done(own, middle[row][own], axial.duration, stator)
            };
            Window { axial, rotors: places.iter().map(done).collect() }
        })
    }
}
