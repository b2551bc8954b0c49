//! Motions that repeat: whether a tape is one cycle, and the rotor that repeats with it.

use std::f64::consts::TAU;

use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::sweep::LaneRunner;
use bouncing_disk_drives::Drive;

use super::recurrence::{Key, ONE, ONE_OF_TWO, Repeats, Touch, are_same, is_near};
use super::replay::{Done, Replay, Rotors};
use super::source::Source;
use super::window::{RotorWindow, Speeds, Window};
use super::{Knot, Tape};
use crate::error::Error;
use crate::motor::batch::rotor_rows::WIDTH;
use crate::stator::StatorLedger;

/// Bisections that find the speed of a rotor that repeats with a cycle, to rounding.
const HALVINGS: u32 = 60;

/// Steps per period during a contact, in a cycle and in a coarser copy that shows the error due to the steps.
const RESOLUTIONS: [f64; 2] = [2048.0, 1024.0];

/// Largest number of knots of a cycle of any length.
const MOST_KNOTS: f64 = 65_536.0;

/// The record of a cycle.
#[derive(Debug, Clone)]
enum Recorded {
    /// The cycle, recorded finely and coarsely.
    Tapes(Box<[Tape; 2]>),
    /// The rotor's motion in the cycle, as it was found.
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
    /// The cycle that a source repeats from its present state.
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
                    Touch::Lies => keys.push(Key::LYING),
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

    /// The least number of touches after which the motion repeats. A motion that approaches its cycle
    /// alternately from both sides is at first seen to repeat after several cycles.
    pub(crate) fn least_touches(keys: &[Key]) -> u64 {
        let count = keys.len();
        let repeats = |period: &usize| count.is_multiple_of(*period) && are_same(keys, keys, *period, ONE);
        (1..count).find(repeats).unwrap_or(count) as u64
    }

    /// Whether two cycles are the same motion, possibly entered at different touches.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        // Each may have been recorded at some distance from its limit.
        let within = ONE_OF_TWO.max(2.0 * (self.repeats.distance + other.repeats.distance));
        let is_same = |apart| are_same(&self.touches, &other.touches, apart, within);
        self.touches.len() == other.touches.len()
            && self.periods == other.periods
            && (0..self.touches.len()).any(is_same)
    }

    /// The touches of the cycle.
    pub(crate) fn touches(&self) -> &[Key] {
        &self.touches
    }

    /// Whether a touch is near one of the cycle's touches.
    pub(crate) fn is_near(&self, key: &Key) -> bool {
        is_near(&self.touches, key)
    }

    /// Whether the disk stays on the platform.
    pub(crate) fn is_contact(&self) -> bool {
        let flies = |knot: &Knot| knot.hit > 0.0 || knot.pressed == 0.0 && knot.duration > 0.0;
        match &self.recorded {
            Recorded::Tapes(tapes) => !tapes[0].knots.iter().any(flies),
            Recorded::Window(_) => false,
        }
    }

    /// The motion of rotors that have their initial speeds again after the cycle, on the fine and on the
    /// coarse tape, in the order of `places`. Their speeds lie within the limits `largest`.
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
            let mut extremes = Vec::new();
            for step in 0..=HALVINGS {
                for (row, rotors) in rotors.iter_mut().enumerate() {
                    for own in 0..WIDTH {
                        // Rotors never overtake each other, and approach each other: one that gains speed is
                        // too slow.
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
                if step == HALVINGS {
                    extremes = along(tape, rotors.clone(), places, runner);
                }
                let steps = 1..tape.knots.len();
                runner.run(Replay { tape, steps, rotors: &mut rotors });
            }
            let axial = tape.axial;
            let stator = (tape.stator != StatorLedger::default()).then_some((tape.stator, axial));
            let done = |(&(row, own), within): (&(usize, usize), [f64; 2])| {
                let done = rotors[row].done(own, middle[row][own], axial.duration, stator);
                RotorWindow { speeds: Speeds::Within(within), ..done }
            };
            Window { axial, rotors: places.iter().zip(extremes).map(done).collect() }
        })
    }
}

/// The least and the largest speed along a tape of the rotors at these places.
fn along(
    tape: &Tape,
    mut rotors: Vec<Rotors>,
    places: &[(usize, usize)],
    runner: &LaneRunner,
) -> Vec<[f64; 2]> {
    let speed = |rotors: &[Rotors], (row, own): (usize, usize)| rotors[row].rows.speed[own];
    let mut all: Vec<[f64; 2]> = places.iter().map(|place| [speed(&rotors, *place); 2]).collect();
    for (index, knot) in tape.knots.iter().enumerate().skip(1) {
        let before: Vec<f64> = places.iter().map(|place| speed(&rotors, *place)).collect();
        runner.run(Replay { tape, steps: index..index + 1, rotors: &mut rotors });
        for (((row, own), before), [least, largest]) in places.iter().zip(before).zip(&mut all) {
            for speed in [rotors[*row].within(*own, knot, 1.0, before), rotors[*row].rows.speed[*own]] {
                (*least, *largest) = (least.min(speed), largest.max(speed));
            }
        }
    }
    all
}
