//! Rotors on a tape, in windows of time.

use std::array;
use std::f64::consts::TAU;
use std::iter::Peekable;
use std::ops::RangeInclusive;

use bouncing_disk_core::run::WorkCount;
use bouncing_disk_core::sweep::{InstructionSet, LaneRunner};
use bouncing_disk_drives::Drive;

use super::Tape;
use super::cycle::Cycle;
use super::recurrence::{Key, Recurrence, Repeats};
use super::replay::{Done, Replay, Rotors};
use super::source::Source;
use super::window::{AxialWindow, RotorWindow, SAMPLES, Speeds, Window};
use crate::driven::DrivenSystem;
use crate::error::Error;
use crate::motion::phase_time::PhaseTime;
use crate::motor::batch::members::golden_share;
use crate::motor::batch::rotor_rows::{RotorRows, WIDTH};
use crate::motor::stator::Stator;
use crate::motor::tape::left::Left;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::stator::{LoadLine, StatorState};

/// Number of knots after which a tape is replayed, small enough for the cache.
const BLOCK: usize = 4096;

/// Steps per period during a contact if the requested relative error of speeds is [`COARSE`] or more; the
/// error due to the steps is of second order in their length.
const RESOLUTION: f64 = 128.0;
const COARSE: f64 = 2.0e-3;

/// Steps per period during a contact for this requested relative error of speeds.
pub(crate) fn resolution(relative_error: f64) -> f64 {
    RESOLUTION * (COARSE / relative_error).max(1.0).sqrt()
}

/// Relative error of a speed that was computed with this number of steps per period: a chord differs from the
/// stator's speed by the square of its length over 8, and by 2/3 of this on average.
pub(crate) fn error_of_steps(resolution: f64) -> f64 {
    let step = TAU / resolution;
    step * step * (1.0 / 12.0)
}

/// The rotary parameters of a rotor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TapedRotor {
    pub(crate) friction: f64,
    /// The constant load; the law of the load, if any, is added to it.
    pub(crate) load: f64,
    pub(crate) law: Vec<LoadLine>,
    pub(crate) twist: Twist,
}

/// The twist of the stator under a rotor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Twist {
    /// A sine: the coefficients of its speed for the cosine and, with opposite sign, the sine of the phase.
    Sine([f64; 2]),
    Waveform(Drive),
}

impl DrivenSystem {
    /// The rotary parameters of the system's rotor.
    pub(crate) fn rotor(&self) -> TapedRotor {
        let (angle, start) = (&self.angle, self.angle.at(0.0));
        let is_sine = angle.next_joint(0.0).is_none() && angle.highest_harmonic() <= 1.0;
        let parts = [start.velocity, -start.acceleration];
        let twist = if is_sine { Twist::Sine(parts) } else { Twist::Waveform(angle.clone()) };
        TapedRotor { friction: self.friction, load: self.load, law: Vec::new(), twist }
    }
}

impl Stator {
    /// The rotary parameters of this system's rotor, whose motion does not act back on the stator.
    pub(crate) fn rotor(&self, system: &DimensionlessSystem) -> TapedRotor {
        let (friction, load) = (system.friction(), system.load());
        let (cosine, sine) = system.twist_components();
        let twist = Twist::Sine([cosine, sine]);
        match self {
            Self::Sine => TapedRotor { friction, load, law: Vec::new(), twist },
            Self::Driven(own) => own.system.rotor(),
            Self::Yielding(own) => {
                let law = if own.constant_law() == Some(0.0) { Vec::new() } else { own.law() };
                TapedRotor { friction, load, law, twist }
            }
        }
    }
}

/// Rotors on a tape.
#[derive(Debug)]
pub(crate) struct Taped {
    source: Source,
    tape: Tape,
    rotors: Vec<Rotors>,
    /// Row and place of each rotor.
    places: Vec<(usize, usize)>,
    runner: LaneRunner,
    recurrence: Recurrence,
    /// The cycle that the motion was found to repeat, after which no window is complete.
    repeats: Option<Repeats>,
    /// The time (rad) for which the motion was followed.
    pub(crate) followed: f64,
    /// Number of windows begun.
    begun: usize,
}

/// The times, after its start, at which speeds are sampled in the window with this number: one in each part
/// of the window, at positions that fill the part evenly over many windows.
pub(crate) fn sampled_at(window: usize, duration: f64) -> [f64; SAMPLES] {
    let share = golden_share(window);
    array::from_fn(|part| duration * ((part as f64 + share) / SAMPLES as f64))
}

/// The speeds of rotors at these places.
fn speeds_of(rotors: &[Rotors], places: &[(usize, usize)]) -> Vec<f64> {
    places.iter().map(|&(row, own)| rotors[row].rows.speed[own]).collect()
}

impl Taped {
    /// Rotors with these angular speeds, each with `quicker` times less inertia than the motor's, on a tape
    /// with this number of steps per period during a contact.
    pub(crate) fn new(
        source: Source,
        resolution: f64,
        starts: impl Iterator<Item = (TapedRotor, f64, f64)>,
    ) -> Self {
        let mut twists: Vec<Drive> = Vec::new();
        let (mut rotors, mut places): (Vec<Rotors>, Vec<_>) = Default::default();
        for (rotor, speed, quicker) in starts {
            let (parts, column) = match rotor.twist {
                Twist::Sine(parts) => (parts, None),
                Twist::Waveform(drive) => {
                    let known = twists.iter().position(|twist| *twist == drive);
                    let column = known.unwrap_or(twists.len());
                    if known.is_none() {
                        twists.push(drive);
                    }
                    ([0.0; 2], Some(column))
                }
            };
            let times = |line: &LoadLine| LoadLine {
                torque: quicker * line.torque,
                slope: quicker * line.slope,
                ..*line
            };
            let law: Vec<LoadLine> = rotor.law.iter().map(times).collect();
            let fits = |rows: &Rotors| rows.column == column && rows.law == law && rows.count < WIDTH;
            let row = rotors.iter().position(fits).unwrap_or_else(|| {
                let (rows, quicker, law) = (RotorRows::default(), [1.0; WIDTH], law.clone());
                rotors.push(Rotors { rows, count: 0, quicker, column, law });
                rotors.len() - 1
            });
            let own = rotors[row].count;
            rotors[row].rows.put(own, [quicker * rotor.friction, quicker * rotor.load], parts);
            rotors[row].quicker[own] = quicker;
            rotors[row].rows.speed[own] = speed;
            rotors[row].count += 1;
            places.push((row, own));
        }
        let tape = Tape::new(source.phase(), resolution, twists);
        let runner = LaneRunner::new(InstructionSet::best());
        let recurrence = Recurrence::default();
        Self { source, tape, rotors, places, runner, recurrence, repeats: None, followed: 0.0, begun: 0 }
    }

    /// The same rotors, on a motion that is known to repeat.
    pub(crate) fn on(self, repeats: Repeats) -> Self {
        Self { repeats: Some(repeats), ..self }
    }

    pub(crate) fn speeds(&self) -> Vec<f64> {
        speeds_of(&self.rotors, &self.places)
    }

    /// The end of the last window.
    #[cfg(test)]
    pub(crate) fn time(&self) -> crate::motion::phase_time::PhaseTime {
        self.source.time()
    }

    /// The state of the disk and the compliant stator.
    pub(crate) fn left(&self) -> Option<Left> {
        let Source::Yielding(source) = &self.source else { return None };
        Some(Left::of(&source.engine, source.engine.time()))
    }

    /// Continues from the final state of another motor, with the rotors unchanged.
    pub(crate) fn go_on_from(&mut self, time: PhaseTime, state: StatorState) -> Result<(), Error> {
        self.source.go_on_from(time, state)?;
        self.tape.begin(self.source.phase());
        Ok(())
    }

    /// The cycle that the motion repeats, if one was found.
    pub(crate) fn cycle(&mut self, work: &mut WorkCount<'_>) -> Result<Option<Cycle>, Error> {
        let Some(repeats) = self.repeats else { return Ok(None) };
        Cycle::record(&mut self.source, repeats, self.tape.twists(), work).map(Some)
    }

    pub(crate) const fn repeats(&self) -> Option<Repeats> {
        self.repeats
    }

    /// Registers cycles with these touches that other members have reached.
    pub(crate) fn know(&mut self, cycles: &[&[Key]]) {
        self.recurrence.know(cycles);
    }

    /// The motion of this member's rotors, in their order, in a cycle, at the speeds that repeat.
    pub(crate) fn on_cycle(&self, cycle: &Cycle, largest: &[f64]) -> [Window; 2] {
        cycle.windows(&self.rotors, &self.places, largest, &self.runner)
    }

    /// Carries all rotors along the tape, which begins at this time in the window, and samples their speeds
    /// when due.
    fn replay(
        &mut self,
        mut time: f64,
        due: &mut Peekable<impl Iterator<Item = (f64, usize)>>,
        samples: &mut [[f64; SAMPLES]],
    ) {
        let (tape, rotors) = (&self.tape, &mut self.rotors);
        let (mut start, mut index) = (1, 1);
        while due.peek().is_some() && index < tape.knots.len() {
            let knot = &tape.knots[index];
            let mut sampled = None;
            while let Some((at, sample)) = due.next_if(|(at, _)| *at < time + knot.duration) {
                let before = sampled.get_or_insert_with(|| {
                    self.runner.run(Replay { tape, steps: start..index, rotors });
                    let before = speeds_of(rotors, &self.places);
                    self.runner.run(Replay { tape, steps: index..index + 1, rotors });
                    start = index + 1;
                    before
                });
                for ((&(row, own), before), samples) in self.places.iter().zip(before).zip(&mut *samples) {
                    samples[sample] = rotors[row].within(own, knot, (at - time) / knot.duration, *before);
                }
            }
            time += knot.duration;
            index += 1;
        }
        self.runner.run(Replay { tape, steps: start..tape.knots.len(), rotors });
    }

    /// The next window, up to the end of an event. It lasts for at least `duration` rad, but the number of
    /// its impacts stays within `impacts`. The window ends early if the motion is found to repeat.
    pub(crate) fn next_window(
        &mut self,
        duration: f64,
        impacts: &RangeInclusive<u64>,
        work: &mut WorkCount<'_>,
    ) -> Result<Window, Error> {
        let speeds = self.speeds();
        let mut samples = vec![[f64::NAN; SAMPLES]; self.places.len()];
        let mut due = sampled_at(self.begun, duration).into_iter().zip(0..).peekable();
        self.begun += 1;
        let mut axial = AxialWindow::default();
        let mut ledger = self.source.yields().then(Default::default);
        loop {
            let before = self.tape.axial.duration;
            let touch = self.source.record(&mut self.tape, work)?;
            self.repeats = self.recurrence.add(touch, self.tape.axial.duration - before);
            let (now, done) = (&self.tape.axial, axial.impacts + self.tape.axial.impacts);
            let lasts = axial.duration + now.duration >= duration;
            let is_enough =
                self.repeats.is_some() || lasts && done >= *impacts.start() || done >= *impacts.end();
            if is_enough || self.tape.knots.len() > BLOCK {
                work.spend((self.tape.knots.len() * self.rotors.len() / 32) as u64)?;
                self.replay(axial.duration, &mut due, &mut samples);
                axial.add(&self.tape.axial);
                if let Some(ledger) = &mut ledger {
                    *ledger += self.tape.stator;
                }
                self.tape.restart();
            }
            if is_enough {
                break;
            }
        }
        let stator = ledger.map(|ledger| (ledger, axial));
        let rotors = self.places.iter().zip(speeds).zip(samples);
        let rotors = rotors.map(|((&(row, own), before), samples)| RotorWindow {
            speeds: Speeds::Samples(samples),
            ..self.rotors[row].done(own, before, axial.duration, stator)
        });
        let rotors = rotors.collect();
        self.followed += axial.duration;
        self.rotors.iter_mut().for_each(|rotors| rotors.rows.tally = Done::default());
        Ok(Window { axial, rotors })
    }
}
