//! Ranges of the preload that trap a motor, and the nearest trap.
//!
//! A scan judges preloads whose logarithms are half of the least width apart, and bisects to the edges of
//! each trap. The scan finds every trap of at least that width, unless the trap has a hole at one of these
//! preloads. The speeds inside a trap come from operating points near both edges and in the middle.
//!
//! From 4 to 6 N the motor of 40 kHz and 0.5 um has 17 traps of at least [`LEAST_TRAP_WIDTH`], each 0.11 to
//! 0.16 % wide. The speed is 8.35 rad/s inside and about 7.5 rad/s outside.

use std::f64::consts::PI;

use bouncing_disk_core::numerics::elementary::{exp, ln_1p};
use bouncing_disk_core::run::{Watch, WorkCount};
use bouncing_disk_core::{ImpactMap, Observer, Unobserved, Vibration};

use crate::error::{Error, check};
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::traps::TrapVerdict;
use crate::motor::operation::of_motor::operations;
use crate::motor::operation::point::OperatingRow;
use crate::motor::operation::settings::OperatingSettings;

/// The least relative width of a trap that is reported by default. A motor whose preload is known to 1 % is
/// in a given narrower trap with a probability below 1 in 40.
pub const LEAST_TRAP_WIDTH: f64 = 5.0e-4;

/// Largest number of steps of a scan.
const MOST_STEPS: f64 = 1.0e7;

/// Bisections of a step that locate the edge of a trap.
const HALVINGS: u32 = 24;

/// Positions in a range of preloads at which the speed is computed, as shares of its width.
const PLACES: [f64; 3] = [0.1, 0.5, 0.9];

/// A range of the preload that traps a motor ([`Motor::trap_ranges`]).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct TrapRange {
    /// The range, as accelerations (m/s^2).
    pub preload_from_to: [f64; 2],
    /// The width w of the range relative to the preload. If the preload of a motor is known to within a
    /// relative tolerance t on either side, and the trap lies inside this interval, the motor is trapped with
    /// a probability of w/(2 t).
    pub relative_width: f64,
    /// The same range in the axial forcing parameter Gamma.
    pub forcing_from_to: [f64; 2],
    /// The motion of the rotor in the middle of the range.
    pub verdict: TrapVerdict,
    /// The operation near the lower edge, in the middle and near the upper edge of the range (a tenth of the
    /// width inside the edges), under the load of the data sheet. Most traps hardly slow a motor; some stop
    /// it.
    pub operations: [OperatingRow; 3],
}

/// The low-period trap nearest to a motor.
///
/// A trap is a range of Gamma at the motor's restitution. A change of preload, amplitude or frequency can
/// move the motor into the trap. For each of the three, a field states the value at the near edge, with the
/// other two unchanged.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NearestTrap {
    /// The relative change of preload or amplitude, whichever is smaller, that moves the motor to the near
    /// edge; zero for a motor in the trap.
    pub relative_distance: f64,
    /// Preload (m/s^2) at the near edge; the motor's own preload if the motor is in the trap.
    pub preload_acceleration: f64,
    /// Amplitude (m) at the near edge.
    pub amplitude: f64,
    /// Drive frequency (Hz) at the near edge.
    pub drive_frequency: f64,
    /// The range of Gamma of the trap, as far as the scan extended.
    pub forcing_from_to: [f64; 2],
    /// The motion of the rotor in the middle of this range.
    pub verdict: TrapVerdict,
    /// Step of the scan in Gamma; traps narrower than two steps may have been missed.
    pub forcing_step: f64,
}

impl Motor {
    /// The ranges between two preloads (accelerations in m/s^2, the first one lower) that trap the motor and
    /// are at least `least_relative_width` wide, in (0, 0.1]; [`LEAST_TRAP_WIDTH`] is a good choice. The
    /// ranges are in rising order, each with the speeds inside it, computed to the accuracy of `settings`.
    ///
    /// The observer's items are the steps of the scan, then the ranges.
    ///
    /// ```
    /// # use bouncing_disk::core::Unobserved;
    /// use bouncing_disk::Motor;
    /// use bouncing_disk::motor::{LEAST_TRAP_WIDTH, OperatingSettings};
    ///
    /// let settings = OperatingSettings { relative_error: 0.05, members: 4, ..OperatingSettings::default() };
    /// let traps = Motor::paper_70_khz().trap_ranges([9.8, 9.9], LEAST_TRAP_WIDTH, &settings, &Unobserved)?;
    /// // Outside the traps it turns at 21 rad/s.
    /// assert!(!traps.is_empty());
    /// assert!(traps.iter().all(|trap| trap.operations[1].point().is_some_and(|point| point.speed.value < 30.0)));
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for preloads that do not rise or are not positive, and for a width outside its
    /// range; an error of the core for a scan of more than ten million steps, of half a width each; the
    /// errors of [`Motor::operating_point`]; [`Error::SoftContact`].
    pub fn trap_ranges(
        &self,
        [low, high]: [f64; 2],
        least_relative_width: f64,
        settings: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<TrapRange>, Error> {
        settings.check()?;
        self.rigid_sine()?;
        check(low > 0.0 && low.is_finite(), "lowest preload", low, "(0, highest preload) (m/s^2)")?;
        check(high > low && high.is_finite(), "highest preload", high, "(lowest preload, inf) (m/s^2)")?;
        let legal = least_relative_width > 0.0 && least_relative_width <= 0.1;
        check(legal, "least_relative_width", least_relative_width, "(0, 0.1]")?;
        let own = self.preload_acceleration();
        // In the logarithm of the forcing, which falls as the preload rises.
        let scan = Scan { motor: self, step: 0.5 * least_relative_width };
        let (from, to) = (ln_1p((own - high) / high), ln_1p((own - low) / low));
        let found = scan.ranges(from, to, observer)?;
        let at = |offset: f64| {
            self.with(|sheet| {
                sheet.preload_force = None;
                sheet.preload_acceleration = Some(own / exp(offset));
            })
        };
        if found.is_empty() {
            return Ok(Vec::new());
        }
        let inside = found.iter().flat_map(|[from, to]| PLACES.map(|place| at(to + place * (from - to))));
        let motors = inside.collect::<Result<Vec<_>, _>>()?;
        let operations = operations(&motors, settings, observer)?;
        let mut all = found
            .into_iter()
            .zip(motors.chunks_exact(PLACES.len()).zip(operations.chunks_exact(PLACES.len())))
            .map(|(ends, (motors, operations))| {
                let forcing = self.system().peak_acceleration() / PI;
                let [least, most] = [ends[1], ends[0]].map(|end| own / exp(end));
                Ok(TrapRange {
                    preload_from_to: [least, most],
                    relative_width: exp(ends[1] - ends[0]) - 1.0,
                    forcing_from_to: ends.map(|end| forcing * exp(end)),
                    verdict: motors[1].trap_verdict()?,
                    operations: [0, 1, 2].map(|place| operations[place].clone()),
                })
            })
            .collect::<Result<Vec<_>, Error>>()?;
        all.reverse();
        Ok(all)
    }

    /// The nearest low-period trap that is at least [`LEAST_TRAP_WIDTH`] wide, if one lies within a relative
    /// change of preload or amplitude of `relative_range`, in (0, 1]. Use
    /// [`MotorRegime::is_locked`](crate::motor::MotorRegime::is_locked) to check whether the motor itself is
    /// locked, however narrow its trap.
    ///
    /// The observer's items are the steps of the scan.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a `relative_range` outside (0, 1]; [`Error::SoftContact`] for compliant
    /// contacts; the errors of the flights.
    pub fn nearest_trap(
        &self,
        relative_range: f64,
        observer: &dyn Observer,
    ) -> Result<Option<NearestTrap>, Error> {
        let legal = relative_range > 0.0 && relative_range <= 1.0;
        check(legal, "relative_range", relative_range, "(0, 1]")?;
        self.rigid_sine()?;
        let reach = ln_1p(relative_range);
        let scan = Scan { motor: self, step: 0.5 * LEAST_TRAP_WIDTH };
        let near = |[from, to]: &[f64; 2]| if *from > 0.0 { *from } else { to.min(0.0) };
        let found = scan.ranges(-reach, reach, observer)?;
        let nearest = found.into_iter().min_by(|one, other| near(one).abs().total_cmp(&near(other).abs()));
        let Some(ends) = nearest else { return Ok(None) };
        let (offset, forcing) = (near(&ends), self.system().peak_acceleration() / PI);
        let factor = exp(offset);
        let watch = Watch::begin(&Unobserved, 0, 1)?;
        Ok(Some(NearestTrap {
            relative_distance: 1.0 - 1.0 / exp(offset.abs()),
            preload_acceleration: self.preload_acceleration() / factor,
            amplitude: self.system().platform().amplitude() * factor,
            drive_frequency: self.parameters().drive_frequency * factor.sqrt(),
            forcing_from_to: ends.map(|end| forcing * exp(end)),
            verdict: scan.verdict(0.5 * (ends[0] + ends[1]), &mut watch.work())?,
            forcing_step: forcing * scan.step,
        }))
    }
}

/// A scan over the logarithm of the forcing, relative to the motor's own forcing.
struct Scan<'a> {
    motor: &'a Motor,
    step: f64,
}

impl Scan<'_> {
    fn verdict(&self, offset: f64, work: &mut WorkCount<'_>) -> Result<TrapVerdict, Error> {
        let map = self.motor.system().dimensionless().map();
        let factor = exp(offset);
        let map =
            ImpactMap::new(Vibration::new(map.vibration().peak_acceleration() * factor)?, map.restitution())?;
        TrapVerdict::of(&map, self.motor.preload_acceleration() / factor, work)
    }

    /// The traps between two offsets that are at least two steps wide, cut off at these offsets. The scan
    /// tests equidistant points, one step apart, so it misses only a trap with a hole at one of them.
    fn ranges(&self, from: f64, to: f64, observer: &dyn Observer) -> Result<Vec<[f64; 2]>, Error> {
        // A stator at rest has no trap.
        if self.motor.system().peak_acceleration() <= 0.0 {
            return Ok(Vec::new());
        }
        let steps = ((to - from) / self.step).ceil();
        check(steps <= MOST_STEPS, "steps of the scan for traps", steps, "[0, 1e7]")?;
        let watch = Watch::begin(observer, 0, steps as u64)?;
        let mut work = watch.work();
        let (mut found, mut since) = (Vec::new(), None);
        let place = |index: u64| (from + self.step * index as f64).min(to);
        for index in 0..=steps as u64 {
            let (is_trap, here) = (self.verdict(place(index), &mut work)?.is_trap, place(index));
            match since {
                None if is_trap => {
                    let begin = index.checked_sub(1).map(|last| self.edge(here, place(last), &mut work));
                    since = Some(begin.transpose()?.unwrap_or(from));
                }
                Some(begin) if !is_trap => {
                    found.push([begin, self.edge(place(index - 1), here, &mut work)?]);
                    since = None;
                }
                _ => {}
            }
            watch.set_done(index);
        }
        found.extend(since.map(|begin| [begin, to]));
        watch.end();
        let least = 2.0 * self.step;
        found.retain(|[begin, end]| end - begin >= least.min(to - from));
        Ok(found)
    }

    /// The edge of a trap between an offset inside and one outside: the last offset inside.
    fn edge(&self, mut inside: f64, mut outside: f64, work: &mut WorkCount<'_>) -> Result<f64, Error> {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            if self.verdict(middle, work)?.is_trap {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        Ok(inside)
    }
}
