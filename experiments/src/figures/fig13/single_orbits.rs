//! Motors that print like Table III's and that nothing perturbs, with other values of each parameter.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::effects::{Effects, Reading, Varied, line_exponent};
use super::{LARGEST_RESTITUTION, RISES};
use crate::claims::Cases;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::alike::{AlikeMotor, DRAWN, PrintedInputs, alike_groups};
use crate::figures::shared::inputs::{Input, motor as inputs};
use crate::figures::shared::motor::MotorCase;
use crate::figures::shared::numbers;

/// Seed of the inputs that print alike.
pub(super) const SEED: u64 = 13;
/// Phase lags that each motor is given.
const LAGS: u32 = 8;
/// Numbers of flights for which the share of cycles is counted.
const FLIGHT_COUNTS: [usize; 5] = [2, 4, 8, 16, 32];
/// A cycle is short if it takes this share of the rise time.
const SHORT_CYCLE: f64 = 0.01;

/// The same draws of what Table III does not print at each value of each parameter.
#[derive(Debug, Serialize)]
pub(super) struct SingleOrbits {
    /// The ranges drawn from.
    pub(super) inputs: String,
    /// Motors drawn.
    pub(super) drawn: usize,
    /// What most of them do with other values of each parameter, in the order of the panels.
    pub(super) ranges: Vec<MiddleRange>,
    /// By rising ε.
    pub(super) prevalence: Vec<Prevalence>,
    /// By draw.
    pub(super) draws: Vec<Effects>,
}

/// The middle nine tenths of these motors with other values of one parameter.
#[derive(Debug, Serialize)]
pub(super) struct MiddleRange {
    parameter: Input<MotorCase>,
    pub(super) values: Vec<f64>,
    /// Steady speed over ωΦ, and α̇_ss/t_c (rad/s²) of those that settle, at each value.
    pub(super) speed_ratio: Vec<[f64; 2]>,
    pub(super) stall_acceleration_rad_per_s2: Vec<[f64; 2]>,
}

/// The cycles of these motors at one ε.
#[derive(Debug, Serialize)]
pub(super) struct Prevalence {
    pub(super) restitution: f64,
    /// Share of motors of low period.
    pub(super) share_of_low_period: f64,
    /// Number of flights, and the share of motors with chattering cycles of no more.
    pub(super) share_up_to: Vec<(usize, f64)>,
    /// Share of motors whose cycle takes at most a hundredth of the rise time, so that the speed rises in
    /// lines.
    pub(super) share_of_short: f64,
    /// Of the motors that settle and whose rise is exponential, how many stay within the limits of ωΦ and μ.
    pub(super) within_limit: Cases,
}

/// All drawn motors with other values of one parameter, by value, then by draw.
struct Drawn {
    parameter: Input<MotorCase>,
    cases: Vec<Vec<MotorCase>>,
    motors: Vec<Vec<AlikeMotor>>,
}

impl Drawn {
    fn reading(&self, case: &MotorCase, motor: &AlikeMotor) -> Reading {
        Reading {
            value: self.parameter.of(case),
            speed_rad_per_s: motor.steady_speed_rad_per_s,
            speed_ratio: motor.steady_speed_rad_per_s / motor.peak_angular_speed_rad_per_s,
            stall_rad_per_s2: motor.stall_over_limit.map(|stall| stall * case.largest_acceleration()),
            stall_over_limit: motor.stall_over_limit,
            is_exponential: motor.is_exponential(),
        }
    }

    /// All draws at each value.
    fn by_value(&self) -> impl Iterator<Item = Vec<Reading>> {
        self.cases.iter().zip(&self.motors).map(|(cases, motors)| {
            cases.iter().zip(motors).map(|(case, motor)| self.reading(case, motor)).collect()
        })
    }

    /// One draw at all values.
    fn draw(&self, index: usize) -> Varied {
        let of_value = |(cases, motors): (&Vec<MotorCase>, &Vec<AlikeMotor>)| {
            self.reading(&cases[index], &motors[index])
        };
        let readings = self.cases.iter().zip(&self.motors).map(of_value).collect();
        Varied { parameter: self.parameter, readings }
    }

    fn range(&self) -> MiddleRange {
        let mut range = MiddleRange {
            parameter: self.parameter,
            values: Vec::new(),
            speed_ratio: Vec::new(),
            stall_acceleration_rad_per_s2: Vec::new(),
        };
        for readings in self.by_value() {
            let speeds = numbers::middle_range(readings.iter().map(|reading| reading.speed_ratio));
            let stalls =
                numbers::middle_range(readings.iter().filter_map(|reading| reading.stall_rad_per_s2));
            let (Some(speeds), Some(stalls)) = (speeds, stalls) else { continue };
            range.values.push(readings[0].value);
            range.speed_ratio.push(speeds);
            range.stall_acceleration_rad_per_s2.push(stalls);
        }
        range
    }
}

impl SingleOrbits {
    pub(super) fn of(quality: Quality) -> Result<Self, ExperimentError> {
        let printed = PrintedInputs::table_three()?;
        let count = quality.choose(DRAWN / 10, DRAWN);
        let steps = quality.choose(4, 8);
        let default = printed.drawn(count, SEED);
        let with = |parameter: Input<MotorCase>, values: &[f64]| {
            let at = |&value: &f64| default.iter().map(|motor| parameter.set(motor, value)).collect();
            (parameter, values.iter().map(at).collect::<Vec<Vec<MotorCase>>>())
        };
        let amplitudes = [
            "section5.smallest_amplitude_of_fig10",
            "section5.middle_amplitude_of_fig10",
            "section5.largest_amplitude_of_fig10",
        ];
        let by_amplitude = amplitudes.iter().map(|key| Ok(printed.amplitude(key)?.drawn(count, SEED)));
        let restitutions: Vec<f64> =
            (0..steps).map(|step| LARGEST_RESTITUTION * f64::from(step) / f64::from(steps - 1)).collect();
        let phase_lags: Vec<f64> = (0..LAGS).map(|lag| TAU * f64::from(lag) / f64::from(LAGS) - PI).collect();
        let cases = [
            with(inputs::FRICTION, &[0.05, 0.1, 0.2, 0.4]),
            with(inputs::RESTITUTION, &restitutions),
            with(inputs::PHASE_LAG, &phase_lags),
            (inputs::AMPLITUDE, by_amplitude.collect::<Result<_, ExperimentError>>()?),
            with(inputs::PEAK_ANGULAR_SPEED, &[5.0, 23.0, 41.0, 60.0]),
        ];
        // All at once: many transients advance in lockstep.
        let groups: Vec<Vec<MotorCase>> = cases.iter().flat_map(|(_, cases)| cases.clone()).collect();
        let mut motors = alike_groups(&groups, RISES)?.into_iter().map(|group| group.0);
        let sweeps = cases.map(|(parameter, cases)| {
            let motors = motors.by_ref().take(cases.len()).collect();
            Drawn { parameter, cases, motors }
        });
        let [_, by_restitution, _, by_amplitude, _] = &sweeps;
        let rises: Vec<f64> = default.iter().map(MotorCase::rise_time_s).collect();
        let prevalence =
            |(readings, motors): (Vec<Reading>, &Vec<AlikeMotor>)| prevalence(&readings, motors, &rises);
        let effects = |index: usize| {
            // The middle amplitude is the printed one.
            let default = by_amplitude.draw(index).readings[1];
            Effects::of(&sweeps.each_ref().map(|sweep| sweep.draw(index)), &default, line_exponent)
        };
        Ok(Self {
            inputs: printed.words(),
            drawn: count,
            ranges: sweeps.iter().map(Drawn::range).collect(),
            prevalence: by_restitution.by_value().zip(&by_restitution.motors).map(prevalence).collect(),
            draws: (0..count).map(effects).collect(),
        })
    }
}

fn prevalence(readings: &[Reading], motors: &[AlikeMotor], rises: &[f64]) -> Prevalence {
    let count = motors.len() as f64;
    let mut flights: Vec<usize> =
        motors.iter().map(|motor| motor.cycle.chattering_flights().unwrap_or(usize::MAX)).collect();
    flights.sort_unstable();
    let share_up_to = |most: usize| flights.partition_point(|flights| *flights <= most) as f64 / count;
    let is_short = |motor: &AlikeMotor, rise: f64| {
        let periods = motor.cycle.platform_periods();
        periods.is_some_and(|periods| periods as f64 / motor.frequency_hz <= SHORT_CYCLE * rise)
    };
    let short = motors.iter().zip(rises).filter(|(motor, rise)| is_short(motor, **rise)).count();
    Prevalence {
        restitution: readings[0].value,
        share_of_low_period: motors.iter().filter(|motor| motor.cycle.is_low_period()).count() as f64 / count,
        share_up_to: FLIGHT_COUNTS.iter().map(|&count| (count, share_up_to(count))).collect(),
        share_of_short: short as f64 / count,
        within_limit: Cases::of(readings.iter().filter_map(Reading::is_within_limits)),
    }
}
