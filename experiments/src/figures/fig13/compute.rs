//! The computation of Fig. 13.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::Unobserved;
use bouncing_disk::core::numerics::elementary::{ln, pow};
use bouncing_disk::estimate::ExponentialFit;
use bouncing_disk::motor::{NormalImpulses, TransientSettings};

use super::data::{
    AlikeMotors, AlikeRange, Draw, Fig13Data, ImpulsePhases, Parameter, Prevalence, Sensitivity, Sweep,
    SweepPoint, cosine_fit, trend_change,
};
use crate::claims::{Cases, paper};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::alike::{AlikeMotor, DRAWN, PrintedInputs, alike_groups};
use crate::figures::shared::motor::{MotorCase, statistics};
use crate::figures::shared::numbers::{self, StraightLine};
use crate::progress::Progress;

/// Duration of a transient in rise times ωΦ a_g²/(μ a_e g).
const RISES: f64 = 6.0;
/// The perturbation (g/ω) with which each sweep is repeated.
const BREAKING_PERTURBATION: f64 = 0.1;
/// ε of the distributions of impulse.
const RESTITUTIONS: [f64; 3] = [0.2, 0.5, 0.8];
/// Parts of the cycle in these distributions.
const PARTS: usize = 48;
/// Largest ε of a sweep.
const LARGEST_RESTITUTION: f64 = 0.9;
/// Phase lags that each of the motors which print alike is given.
const LAGS: u32 = 8;
/// Seed of the inputs that print alike.
pub(super) const SEED: u64 = 13;
/// Numbers of flights for which the share of cycles is counted.
const FLIGHT_COUNTS: [usize; 5] = [2, 4, 8, 16, 32];
/// A cycle is short if it takes this share of the rise time.
const SHORT_CYCLE: f64 = 0.01;
pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig13Data, ExperimentError> {
    let section = paper::section_five()?;
    let motor = MotorCase::table_three()?;
    let members = quality.choose(3, 12);
    let impacts = quality.choose(4_000, 40_000);
    let relaunch_perturbation = TransientSettings::default().relaunch_perturbation;
    let grids = Parameter::ALL.map(|parameter| values(parameter, &section.amplitudes_of_fig10_m, quality));
    progress.start(grids.iter().map(|grid| grid.len() as u64).sum::<u64>() + 2, "motors");

    let mut sweeps = Vec::new();
    for (parameter, grid) in Parameter::ALL.into_iter().zip(grids) {
        let mut points = Vec::new();
        let cases: Vec<MotorCase> = grid.iter().map(|value| parameter.set(&motor, *value)).collect();
        let ensembles: Vec<_> = cases.iter().map(|case| (*case, members)).collect();
        let statistics = statistics(&ensembles, RISES, relaunch_perturbation)?;
        for ((value, case), statistics) in grid.into_iter().zip(cases).zip(statistics) {
            let system = case.system()?;
            let impulses = NormalImpulses::of(system.dimensionless().map(), impacts, relaunch_perturbation)?;
            let count = impulses.impacts.len() as f64;
            let speeds = impulses.impacts.iter().map(|one| one.impulse / (1.0 + case.restitution));
            let mean_impact_speed_m_per_s = system.scales().velocity * speeds.sum::<f64>() / count;
            let (predicted_speed_ratio, predicted_stall_acceleration_rad_per_s2) = predict(&case, &impulses);
            points.push(SweepPoint {
                value,
                peak_angular_speed_rad_per_s: case.peak_angular_speed_rad_per_s,
                statistics,
                predicted_speed_ratio,
                predicted_stall_acceleration_rad_per_s2,
                mean_impact_speed_m_per_s,
                mean_impact_interval_s: system.scales().time * impulses.duration / count,
            });
            progress.advance(1);
        }
        sweeps.push(Sweep { parameter, points });
    }
    let impulses = RESTITUTIONS
        .iter()
        .map(|&restitution| {
            let case = MotorCase { restitution, ..motor };
            let map = *case.system()?.dimensionless().map();
            let impulses = NormalImpulses::of(&map, 5 * impacts, BREAKING_PERTURBATION)?;
            Ok(ImpulsePhases {
                restitution,
                shares: impulses.histogram(PARTS),
                impulse: impulses.concentration(),
                collisions: impulses.concentration_of_collisions(),
            })
        })
        .collect::<Result<Vec<_>, ExperimentError>>()?;
    progress.advance(1);
    let alike = alike_motors(quality)?;
    progress.advance(1);
    Ok(Fig13Data {
        default: motor.statistics(RISES, 2 * members, relaunch_perturbation)?,
        motor,
        members,
        rises: RISES,
        relaunch_perturbation,
        breaking_perturbation: BREAKING_PERTURBATION,
        sweeps,
        impulses,
        alike,
    })
}

/// The values of a sweep. The paper's ranges are not in its text; A runs over its three amplitudes.
fn values(parameter: Parameter, amplitudes: &[f64; 3], quality: Quality) -> Vec<f64> {
    let even = |first: f64, last: f64, count: u32| -> Vec<f64> {
        (0..count).map(|index| first + (last - first) * f64::from(index) / f64::from(count - 1)).collect()
    };
    match parameter {
        Parameter::Friction => even(0.02, 0.4, quality.choose(5, 20)),
        Parameter::Restitution => even(0.0, LARGEST_RESTITUTION, quality.choose(7, 19)),
        Parameter::PhaseLag => even(-PI, PI, quality.choose(9, 25)),
        Parameter::Amplitude => {
            let ratio = amplitudes[2] / amplitudes[0];
            even(0.0, 1.0, quality.choose(5, 25))
                .iter()
                .map(|share| amplitudes[0] * pow(ratio, *share))
                .collect()
        }
        Parameter::PeakAngularSpeed => even(5.0, 60.0, quality.choose(4, 12)),
    }
}

/// Steady speed over ωΦ and stall acceleration of the transient that the impulses give, fitted as the
/// ensembles are.
fn predict(case: &MotorCase, impulses: &NormalImpulses) -> (f64, Option<f64>) {
    let levels = impulses.balance(case.phase_lag_rad);
    let (times, speeds) = levels.transient(RISES, 240);
    let fit = ExponentialFit::new(&times, &speeds, &Unobserved).ok();
    let stall = fit
        .filter(|fit| fit.time_constant < 0.5 * RISES && fit.residual < 0.25 * fit.steady_speed.abs())
        .map(|fit| case.largest_acceleration() * fit.stall_acceleration());
    (levels.steady_speed(), stall)
}

/// Motors of Table III with the g drawn that is not printed, at several ε; and each of them with other values
/// of one of the others.
fn alike_motors(quality: Quality) -> Result<AlikeMotors, ExperimentError> {
    let inputs = PrintedInputs::table_three()?;
    let count = quality.choose(DRAWN / 10, DRAWN);
    let steps = quality.choose(4, 10);
    let restitutions: Vec<f64> =
        (0..steps).map(|step| LARGEST_RESTITUTION * f64::from(step) / f64::from(steps - 1)).collect();
    let amplitudes = [
        "section5.smallest_amplitude_of_fig10",
        "section5.middle_amplitude_of_fig10",
        "section5.largest_amplitude_of_fig10",
    ];
    let of_amplitude = |key: &&str| Ok::<_, ExperimentError>(inputs.amplitude(key)?.drawn(count, SEED));
    let by_amplitude = amplitudes.iter().map(of_amplitude).collect::<Result<Vec<_>, ExperimentError>>()?;
    let default = inputs.drawn(count, SEED);
    let with = |parameter: Parameter, values: &[f64]| -> Vec<Vec<MotorCase>> {
        values
            .iter()
            .map(|&value| default.iter().map(|motor| parameter.set(motor, value)).collect())
            .collect()
    };
    let frictions = [0.05, 0.1, 0.2, 0.4];
    let phase_lags: Vec<f64> = (0..LAGS).map(|lag| TAU * f64::from(lag) / f64::from(LAGS) - PI).collect();
    let peak_angular_speeds = [5.0, 23.0, 41.0, 60.0];
    let varied = |parameter: Parameter, cases: Vec<Vec<MotorCase>>| -> Result<Varied, ExperimentError> {
        let motors = alike_groups(&cases, RISES)?.into_iter().map(|group| group.0).collect();
        Ok(Varied { parameter, cases, motors })
    };
    let by_restitution = varied(
        Parameter::Restitution,
        restitutions.iter().map(|&restitution| inputs.restitution(restitution).drawn(count, SEED)).collect(),
    )?;
    let sweeps = [
        varied(Parameter::Friction, with(Parameter::Friction, &frictions))?,
        by_restitution,
        varied(Parameter::PhaseLag, with(Parameter::PhaseLag, &phase_lags))?,
        varied(Parameter::Amplitude, by_amplitude)?,
        varied(Parameter::PeakAngularSpeed, with(Parameter::PeakAngularSpeed, &peak_angular_speeds))?,
    ];
    let rises: Vec<f64> = default.iter().map(MotorCase::rise_time_s).collect();
    Ok(AlikeMotors {
        inputs: inputs.words(),
        drawn: count,
        ranges: sweeps.iter().map(Varied::range).collect(),
        prevalence: restitutions
            .iter()
            .zip(&sweeps[1].motors)
            .map(|(&restitution, motors)| prevalence(restitution, motors, &rises))
            .collect(),
        draws: (0..count).map(|index| draw(&restitutions, &sweeps, index)).collect(),
    })
}

/// All drawn motors with other values of one parameter.
struct Varied {
    parameter: Parameter,
    /// By value, then by draw.
    cases: Vec<Vec<MotorCase>>,
    motors: Vec<Vec<AlikeMotor>>,
}

impl Varied {
    /// The values and what is read from one draw.
    fn read(&self, index: usize, of: fn(&MotorCase, &AlikeMotor) -> Option<f64>) -> Vec<(f64, f64)> {
        let pairs = self.cases.iter().zip(&self.motors);
        pairs
            .filter_map(|(cases, motors)| {
                Some((self.parameter.of(&cases[index]), of(&cases[index], &motors[index])?))
            })
            .collect()
    }

    fn range(&self) -> AlikeRange {
        let mut range = AlikeRange {
            parameter: self.parameter,
            values: Vec::new(),
            speed_ratio: Vec::new(),
            stall_acceleration_rad_per_s2: Vec::new(),
        };
        for (cases, motors) in self.cases.iter().zip(&self.motors) {
            let speeds = numbers::middle_range(motors.iter().map(speed_ratio));
            let stalls = cases.iter().zip(motors).filter_map(|(case, motor)| stall(case, motor));
            let (Some(speeds), Some(stalls)) = (speeds, numbers::middle_range(stalls)) else { continue };
            range.values.push(self.parameter.of(&cases[0]));
            range.speed_ratio.push(speeds);
            range.stall_acceleration_rad_per_s2.push(stalls);
        }
        range
    }

    fn sensitivity(&self, index: usize, default: (Option<f64>, Option<f64>)) -> Sensitivity {
        let (speeds, stalls) = (self.read(index, speed), self.read(index, stall));
        let line = |points: &[(f64, f64)]| {
            let coordinate = |x: f64| if self.parameter == Parameter::Amplitude { ln(x) } else { x };
            StraightLine::through(&points.iter().map(|(x, y)| (coordinate(*x), *y)).collect::<Vec<_>>())
        };
        let change = |points: &[(f64, f64)], default: Option<f64>| {
            Some((trend_change(self.parameter, points)? / default?).abs())
        };
        let exponent = |points: &[(f64, f64)]| {
            let positive = points.iter().filter(|(x, y)| *x > 0.0 && *y > 0.0);
            let line = StraightLine::through(&positive.map(|(x, y)| (ln(*x), ln(*y))).collect::<Vec<_>>());
            line.filter(|_| self.parameter != Parameter::PhaseLag).map(|line| line.slope)
        };
        Sensitivity {
            parameter: self.parameter,
            speed_change: change(&speeds, default.0),
            stall_change: change(&stalls, default.1),
            speed_exponent: exponent(&speeds),
            stall_exponent: exponent(&stalls),
            stall_explained: line(&stalls).map(|line| line.explained),
        }
    }
}

fn speed(_: &MotorCase, motor: &AlikeMotor) -> Option<f64> {
    Some(motor.steady_speed_rad_per_s)
}

fn stall(case: &MotorCase, motor: &AlikeMotor) -> Option<f64> {
    motor.stall_over_limit.map(|stall| stall * case.largest_acceleration())
}

/// Steady speed over ωΦ. Each of these motors has the ωΦ that was drawn for it.
fn speed_ratio(motor: &AlikeMotor) -> f64 {
    motor.steady_speed_rad_per_s / motor.peak_angular_speed_rad_per_s
}

fn draw(restitutions: &[f64], sweeps: &[Varied; 5], index: usize) -> Draw {
    let [_, by_restitution, by_lag, by_amplitude, _] = sweeps;
    let motors = || by_restitution.motors.iter().map(|motors| &motors[index]);
    let line = |of: fn(&AlikeMotor) -> Option<f64>| {
        let points = restitutions.iter().zip(motors());
        let points: Vec<_> = points.filter_map(|(x, motor)| of(motor).map(|y| (*x, y))).collect();
        StraightLine::through(&points)
    };
    let range = restitutions.last().zip(restitutions.first()).map_or(0.0, |(last, first)| last - first);
    let ratio = |motor: &AlikeMotor| Some(speed_ratio(motor));
    let over_limit = |motor: &AlikeMotor| motor.stall_over_limit;
    // The middle amplitude is the printed one.
    let printed = (&by_amplitude.cases[1][index], &by_amplitude.motors[1][index]);
    let default = (speed(printed.0, printed.1), stall(printed.0, printed.1));
    let sensitivities: Vec<Sensitivity> =
        sweeps.iter().map(|sweep| sweep.sensitivity(index, default)).collect();
    Draw {
        speed_ratio_slope: line(ratio).map(|line| line.slope),
        stall_over_limit_slope: line(over_limit).map(|line| line.slope),
        stall_over_limit_rise: line(over_limit).map(|line| line.slope * range / line.intercept),
        share_of_exponential: motors().filter(|motor| motor.is_exponential()).count() as f64
            / restitutions.len() as f64,
        speed_cosine: cosine_fit(&by_lag.read(index, speed)).map(|fit| fit.1),
        stall_cosine: cosine_fit(&by_lag.read(index, stall)).map(|fit| fit.1),
        sensitivities,
    }
}

fn prevalence(restitution: f64, motors: &[AlikeMotor], rises: &[f64]) -> Prevalence {
    let count = motors.len() as f64;
    let share_where = |holds: &dyn Fn(usize, &AlikeMotor) -> bool| {
        motors.iter().enumerate().filter(|(index, motor)| holds(*index, motor)).count() as f64 / count
    };
    let mut flights: Vec<usize> =
        motors.iter().map(|motor| motor.cycle.chattering_flights().unwrap_or(usize::MAX)).collect();
    flights.sort_unstable();
    let share = |most: usize| flights.partition_point(|flights| *flights <= most) as f64 / count;
    Prevalence {
        restitution,
        share_of_low_period: share_where(&|_, motor| motor.cycle.is_low_period()),
        share_up_to: FLIGHT_COUNTS.iter().map(|&count| (count, share(count))).collect(),
        share_of_short: share_where(&|index, motor| {
            motor
                .cycle
                .platform_periods()
                .is_some_and(|periods| periods as f64 / motor.frequency_hz <= SHORT_CYCLE * rises[index])
        }),
        within_limit: Cases::of(
            motors
                .iter()
                .filter(|motor| motor.is_exponential())
                .filter_map(|motor| motor.stall_over_limit)
                .map(|stall| stall <= 1.0),
        ),
    }
}
