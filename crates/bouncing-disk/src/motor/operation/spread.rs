//! The spread of a speed or a stall load over the tolerances of the inputs.
//!
//! Preload and amplitude of a motor are known to about one per cent, and the speed is a rough function of
//! both. A motor may be trapped at one value and free at the next. Random samples show this; derivatives do
//! not (docs/numerics-dynamics.md, "The spread over the tolerances of the inputs").
//!
//! If the motor itself is run with 16 members, the 39 samples together cost as much as six operating points.
//! The stall load of a sample is the zero of a straight line between two of 31 loads from -15/16 to 15/16 of
//! mu m g a_e, because rotors settle slowly closer to the full torque. The error of the line is a thousandth
//! of the load.

use std::f64::consts::LN_10;

use bouncing_disk_core::numerics::elementary::exp;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::{mean, standard_deviation};
use bouncing_disk_core::{Observer, Progress};

use crate::error::{Error, check, finite, within_limit};
use crate::motor::data_sheet::Motor;
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::point::Estimate;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::stall_load::stall_share;
use crate::motor::operation::steady_run::{Operations, operate, operate_for};

/// Members of a sampled motor: the smallest number with a scatter, which is then pooled over all samples.
/// Each member runs as long as a member of the motor itself. No run ends because its own error looks small,
/// so the errors are unbiased.
const MEMBERS_OF_DRAW: usize = 2;

/// Steps of the load from zero to the largest mean torque of friction, for the stall of a sampled motor.
const STALL_STEPS: usize = 16;

/// Loads as shares of the largest mean torque of friction. A run in which the motor itself becomes steady
/// under these loads is long enough to find the stall load of a sampled motor.
const STEADY_UNDER: [f64; 3] = [-0.5, 0.0, 0.5];

/// Index of the first stream of random numbers for the samples, beyond the streams of any members.
const FIRST_STREAM: u64 = 1 << 32;

/// The tolerances of a motor's inputs, and the number of motors that are sampled within them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct InputTolerance {
    /// Relative tolerance of the preload, in [0, 0.5]: the samples are distributed uniformly within this
    /// tolerance on either side. Default 0.01.
    pub preload: f64,
    /// Relative tolerance of the axial amplitude, in [0, 0.5], used in the same way. Default 0.01.
    pub amplitude: f64,
    /// Range, in decades, of the relaunch perturbation, whose true size is unknown; in [0, 6]. The logarithm
    /// of the size is sampled uniformly about that of the settings. Default 1.
    pub perturbation_decades: f64,
    /// Number of sampled motors, in [8, 10000]. Default 39: a further sample then lies within the range of
    /// these with a probability of 38/40.
    pub draws: usize,
}

impl Default for InputTolerance {
    fn default() -> Self {
        Self { preload: 0.01, amplitude: 0.01, perturbation_decades: 1.0, draws: 39 }
    }
}

impl InputTolerance {
    fn check(&self) -> Result<(), Error> {
        let Self { preload, amplitude, perturbation_decades, draws } = *self;
        check((0.0..=0.5).contains(&preload), "tolerance of the preload", preload, "[0, 0.5]")?;
        check((0.0..=0.5).contains(&amplitude), "tolerance of the amplitude", amplitude, "[0, 0.5]")?;
        let decades = perturbation_decades;
        check((0.0..=6.0).contains(&decades), "perturbation_decades", decades, "[0, 6]")?;
        check(draws >= 8, "draws", draws as f64, "[8, 10000]")?;
        within_limit("draws", draws, 10_000)
    }

    /// The motor and the settings of a sample.
    fn drawn(
        &self,
        motor: &Motor,
        settings: &OperatingSettings,
        index: usize,
    ) -> Result<(Motor, OperatingSettings), Error> {
        let seed = SplitMix64::seed_of_stream(settings.seed, FIRST_STREAM + index as u64);
        let mut random = SplitMix64::new(seed);
        let mut factor = |tolerance: f64| 1.0 + tolerance * (2.0 * random.unit() - 1.0);
        let (preload, amplitude) = (factor(self.preload), factor(self.amplitude));
        let motor = motor.with(|sheet| {
            sheet.amplitude = sheet.amplitude.map(|value| value * amplitude);
            for given in [&mut sheet.preload_force, &mut sheet.preload_acceleration] {
                *given = given.map(|value| value * preload);
            }
        })?;
        let decades = self.perturbation_decades * (random.unit() - 0.5);
        let settings = OperatingSettings {
            members: MEMBERS_OF_DRAW,
            most_impacts: settings.most_impacts / (settings.members / MEMBERS_OF_DRAW) as u64,
            relaunch_perturbation: (settings.relaunch_perturbation * exp(LN_10 * decades)).min(1.0),
            seed,
            ..*settings
        };
        Ok((motor, settings))
    }
}

/// The spread of a speed or a stall load over motors whose inputs differ by no more than their tolerances. A
/// designer can rely on this spread; the standard error of a single motor holds only at exactly the given
/// inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct InputSpread {
    /// The mean over the samples, with its standard error.
    pub mean: Estimate,
    /// The standard deviation over the samples, after subtracting their statistical errors in quadrature,
    /// with its own standard error. The deviation is zero if those errors explain all of the scatter.
    pub standard_deviation: Estimate,
    /// The smallest and the largest value of the samples, moved towards the mean to remove the widening by
    /// statistical errors. With n samples, a further sample lies between these limits with the probability (n -
    /// 1)/(n + 1), 95 % for n = 39.
    pub from_to: [f64; 2],
    /// The same limits without the smallest and the largest sample, so that one locked motor does not widen
    /// the range. A further sample lies between these limits with the probability (n - 3)/(n + 1), 90 % for n
    /// = 39.
    pub most_from_to: [f64; 2],
    /// Number of samples with a value, over which these statistics are computed.
    pub draws: usize,
    /// Number of samples without a value, because the load overpowers the motor.
    pub without: usize,
    /// Number of samples in which the remainder of the start-up may exceed the standard deviation. They are
    /// included unchanged.
    pub unsettled: usize,
    /// Number of samples in a low-period trap, with or without a value
    /// ([`TrapVerdict`](crate::motor::TrapVerdict)).
    pub trapped: usize,
}

/// The speed or stall load of a sampled motor.
#[derive(Debug, Clone, Copy)]
struct Drawn {
    value: f64,
    /// The variance of the statistical error.
    variance: f64,
    /// Bound on the remainder of the start-up.
    start_up: f64,
}

impl Drawn {
    /// The value from the members, with a bound on the start-up from the rotors that started from above.
    fn of(members: &[f64], above: &[f64]) -> Self {
        let (value, deviation) = (mean(members), standard_deviation(members));
        Self {
            value,
            variance: deviation * deviation / members.len() as f64,
            start_up: (mean(above) - value).abs(),
        }
    }
}

impl InputSpread {
    /// The spread of independent samples; `None` for fewer than four.
    fn of(draws: &[Option<Drawn>], trapped: usize) -> Result<Option<Self>, Error> {
        let known: Vec<Drawn> = draws.iter().copied().flatten().collect();
        if known.len() < 4 {
            return Ok(None);
        }
        let values: Vec<f64> = known.iter().map(|draw| draw.value).collect();
        let centre = Estimate::of(&values)?;
        let count = known.len() as f64;
        // The mean of these is an unbiased estimate of the variance over the inputs.
        let excess: Vec<f64> = known
            .iter()
            .map(|draw| {
                let off = draw.value - centre.value;
                off * off * (count / (count - 1.0)) - draw.variance
            })
            .collect();
        let variance = mean(&excess).max(0.0);
        let uncertain = standard_deviation(&excess) / count.sqrt();
        let deviation = variance.sqrt();
        // The variance is known with an error; its root is known less well downwards.
        let most = (variance + uncertain).sqrt();
        let least = (variance - uncertain).max(0.0).sqrt();
        let standard_error = (most - deviation).max(deviation - least);
        let observed = standard_deviation(&values);
        // Use the largest deviation within its error rather than the deviation itself, so that an unresolved
        // spread does not shrink to a point.
        let real = if observed > 0.0 { (most / observed).min(1.0) } else { 0.0 };
        let at = |value: f64| centre.value + real * (value - centre.value);
        let mut values = values;
        values.sort_by(f64::total_cmp);
        let last = values.len() - 1;
        Ok(Some(Self {
            mean: centre,
            standard_deviation: Estimate { value: deviation, standard_error },
            from_to: [at(values[0]), at(values[last])],
            most_from_to: [at(values[1]), at(values[last - 1])],
            draws: known.len(),
            without: draws.len() - known.len(),
            unsettled: known.iter().filter(|draw| draw.start_up > most).count(),
            trapped,
        }))
    }
}

impl Motor {
    /// The spread of the mean speed (rad/s) under each of these load torques (N m) over the tolerances of the
    /// inputs, to be stated together with the errors of [`Self::torque_speed_curve`] under the same settings.
    /// `None` if fewer than four samples have a speed. All loads of a sample share one vertical motion. A
    /// sample costs an eighth of a curve with 16 members, and all samples together cost about six curves.
    ///
    /// The observer's items are the samples.
    ///
    /// ```
    /// # use bouncing_disk::core::Unobserved;
    /// use bouncing_disk::Motor;
    /// use bouncing_disk::motor::{InputTolerance, OperatingSettings};
    ///
    /// let (motor, tolerance) = (Motor::paper_70_khz(), InputTolerance { draws: 12, ..InputTolerance::default() });
    /// let settings = OperatingSettings { relative_error: 0.02, ..OperatingSettings::default() };
    /// let spread = motor.speed_spreads(&[0.0], &settings, &tolerance, &Unobserved)?[0].expect("no draw runs away");
    /// let [low, high] = spread.from_to;
    /// assert!(low < spread.mean.value && spread.mean.value < high && high - low > 0.3);
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`Self::torque_speed_curve`]; [`Error::OutOfRange`] for illegal tolerances, and for a
    /// motor whose inputs leave their legal ranges within the tolerances.
    pub fn speed_spreads(
        &self,
        load_torques: &[f64],
        settings: &OperatingSettings,
        tolerance: &InputTolerance,
        observer: &dyn Observer,
    ) -> Result<Vec<Option<InputSpread>>, Error> {
        check(!load_torques.is_empty(), "number of loads", 0.0, "[1, 1000000]")?;
        for &torque in load_torques {
            finite("load_torque", torque)?;
        }
        let loaded = |motor: &Self| {
            let own = LoadedMotor::of_sine(motor)?;
            load_torques.iter().map(|&torque| own.with_load(torque)).collect::<Result<Vec<_>, Error>>()
        };
        let mut draws = vec![Vec::new(); load_torques.len()];
        let trapped = self.draw(settings, tolerance, observer, &loaded(self)?, &loaded, |_, found| {
            for (load, draws) in draws.iter_mut().enumerate() {
                let (members, above) = (&found.speeds[load], &found.speeds_from_above[load]);
                draws.push((!members.is_empty()).then(|| Drawn::of(members, above)));
            }
        })?;
        draws.iter().map(|draws| InputSpread::of(draws, trapped)).collect()
    }

    /// The spread of the stall load (N m) over the tolerances of the inputs, to be stated together with the
    /// error of [`Self::stall_load`] under the same settings. Computing the spread costs up to nine times as
    /// much. The stall load of a sample may be below zero.
    ///
    /// The observer's items are the samples.
    ///
    /// # Errors
    /// The errors of [`Self::speed_spreads`].
    pub fn stall_spread(
        &self,
        settings: &OperatingSettings,
        tolerance: &InputTolerance,
        observer: &dyn Observer,
    ) -> Result<Option<InputSpread>, Error> {
        let shares: Vec<f64> = (1..2 * STALL_STEPS).map(|k| k as f64 / STALL_STEPS as f64 - 1.0).collect();
        let loaded = |motor: &Self, shares: &[f64]| {
            let (own, largest) = (LoadedMotor::of_sine(motor)?, motor.largest_torque());
            shares.iter().map(|share| own.with_load(share * largest)).collect::<Result<Vec<_>, Error>>()
        };
        let (first, each) = (loaded(self, &STEADY_UNDER)?, |motor: &Self| loaded(motor, &shares));
        let mut draws = Vec::new();
        let trapped = self.draw(settings, tolerance, observer, &first, &each, |motor, found| {
            let crossings = |speeds: &[Vec<f64>]| -> Vec<f64> {
                let of_member =
                    |member| motor.largest_torque() * stall_share(&shares, |load| speeds[load][member]).0;
                (0..MEMBERS_OF_DRAW).map(of_member).collect()
            };
            let mut draw = Drawn::of(&crossings(&found.speeds), &crossings(&found.speeds_from_above));
            let means: Vec<f64> = found.speeds.iter().map(|members| mean(members)).collect();
            let unresolved = motor.largest_torque() * stall_share(&shares, |load| means[load]).1;
            draw.variance += unresolved * unresolved;
            draws.push(Some(draw));
        })?;
        InputSpread::of(&draws, trapped)
    }

    /// Operates each sampled motor under the loads `loaded` for as long as this motor needs under the loads
    /// `first`, and counts the sampled motors in a trap.
    fn draw(
        &self,
        settings: &OperatingSettings,
        tolerance: &InputTolerance,
        observer: &dyn Observer,
        first: &[LoadedMotor<'static>],
        loaded: &dyn Fn(&Self) -> Result<Vec<LoadedMotor<'static>>, Error>,
        mut each: impl FnMut(&Self, &Operations),
    ) -> Result<usize, Error> {
        tolerance.check()?;
        let (total, mut trapped) = (tolerance.draws as u64, 0);
        let watch = |done: u64| move |_: Progress| observer.observe(Progress { done, total });
        // At their own inertia, because few members need long runs.
        let length = (operate(first, settings, &watch(0))?.length.0, f64::INFINITY);
        for index in 0..tolerance.draws {
            let (motor, settings) = tolerance.drawn(self, settings, index)?;
            each(&motor, &operate_for(Some(length), &loaded(&motor)?, &settings, &watch(index as u64))?);
            trapped += usize::from(motor.trap_verdict()?.is_trap);
        }
        // The answer does not matter, as nothing is left to stop.
        let _ = observer.observe(Progress { done: total, total });
        Ok(trapped)
    }
}

#[cfg(test)]
mod tests;
