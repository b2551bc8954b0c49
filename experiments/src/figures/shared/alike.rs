//! Motors whose inputs print like the paper's, and their transients.
//!
//! What the authors measured is known to its last printed digit, and a number computed from it is judged over draws of all that rounds to it. What they
//! set in a simulation is exact. For the motor no preload acceleration is printed, and its orbit hangs on it: at A = 1 nm and g = 9.8 m/s² to all digits
//! A ω²/g is 2π², and the motor repeats a cycle that it does not have at 9.81. A statement about such an orbit is judged over many of them
//! (`docs/reproducing.md`). This is the only place where they are drawn.

use std::f64::consts::TAU;

use bouncing_disk::core::run::in_parallel;
use bouncing_disk::core::{ChatterPolicy, Phase, Unobserved};
use bouncing_disk::estimate::{ExponentialFit, RampFit, Spread};
use bouncing_disk::motor::{SpeedCurve, TransientMember, TransientSettings, transients};
use serde::Serialize;

use super::motor::{Cycle, INTERVALS, LARGEST_CONSTANT, LARGEST_RESIDUAL, MotorCase};
use super::numbers::{Noise, StraightLine, middle_range};
use crate::claims::Cases;
use crate::claims::catalogue::{self, CatalogueError};
use crate::experiment::ExperimentError;

/// One motor of those that print alike. Nothing perturbs it, as nothing did in the paper's program: which of
/// them it is, is chance enough.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct AlikeMotor {
    pub(crate) restitution: f64,
    pub(crate) amplitude_m: f64,
    pub(crate) preload_acceleration_m_per_s2: f64,
    pub(crate) frequency_hz: f64,
    pub(crate) peak_angular_speed_rad_per_s: f64,
    pub(crate) axial_forcing: f64,
    /// The motion that it repeats.
    pub(crate) cycle: Cycle,
    /// Mean over the last third.
    pub(crate) steady_speed_rad_per_s: f64,
    /// The initial slope of the form that fits better, α̇_ss/t_c or α̇_ss/t_r, over the limit μ a_e g/a_g².
    /// `None` where the speed does not settle or is not distinguishable from zero.
    pub(crate) stall_over_limit: Option<f64>,
    /// Root mean square of curve minus exponential, as a share of ωΦ.
    pub(crate) exponential_residual: f64,
    /// The same for a linear rise to a constant.
    pub(crate) ramp_residual: f64,
    /// Standard deviation of the speed from its straight line over the second half of the transient, as a
    /// share of ωΦ: the oscillation of the steady speed. A slow rise that continues does not count.
    pub(crate) oscillation: f64,
    pub(crate) impacts_per_s: f64,
    /// The time from nine tenths of the last speed to all but a fiftieth of it, over that to one half: 0.16
    /// for a linear rise to a constant, 2.3 for an exponential. `None` where the speed does not get so far.
    pub(crate) turn: Option<f64>,
}

/// Times from nine tenths to all but a fiftieth of the last speed, over that to one half, of a linear rise to
/// a constant: (0.98 - 0.90)/0.5.
const TURN_OF_RAMP: f64 = 0.16;
/// The same of an exponential: ln 5/ln 2.
const TURN_OF_EXPONENTIAL: f64 = 2.322;

impl AlikeMotor {
    /// Whether the speed stops rising abruptly, more like a linear rise to a constant than like an
    /// exponential (by ratios).
    pub(crate) fn stops_abruptly(&self) -> bool {
        self.turn.is_some_and(|turn| turn * turn < TURN_OF_RAMP * TURN_OF_EXPONENTIAL)
    }

    /// Whether the exponential fits the transient better than the linear rise. One that hardly rises has
    /// neither form.
    pub(crate) fn is_exponential(&self) -> bool {
        self.exponential_residual < self.ramp_residual
    }

    fn of(motor: &MotorCase, curve: &SpeedCurve, duration: f64) -> Result<Self, ExperimentError> {
        let exponential = ExponentialFit::new(&curve.times, &curve.speeds, &Unobserved)?;
        let ramp = RampFit::new(&curve.times, &curve.speeds)?;
        let top = motor.peak_angular_speed_rad_per_s;
        let (steady, constant, residual) = if exponential.residual < ramp.residual {
            (exponential.steady_speed, exponential.time_constant, exponential.residual)
        } else {
            (ramp.steady_speed, ramp.rise_time, ramp.residual)
        };
        Ok(Self {
            restitution: motor.restitution,
            amplitude_m: motor.amplitude_m,
            preload_acceleration_m_per_s2: motor.preload_acceleration_m_per_s2,
            frequency_hz: motor.frequency_hz,
            peak_angular_speed_rad_per_s: top,
            axial_forcing: motor.system()?.axial_forcing(),
            cycle: motor.cycle(ChatterPolicy::Complete)?,
            steady_speed_rad_per_s: curve.mean_over_last(1.0 / 3.0)?,
            stall_over_limit: (constant < LARGEST_CONSTANT * duration
                && residual < LARGEST_RESIDUAL * steady.abs())
            .then(|| steady / constant / motor.largest_acceleration()),
            exponential_residual: exponential.residual / top,
            ramp_residual: ramp.residual / top,
            oscillation: oscillation(curve, top)?,
            impacts_per_s: curve.impacts as f64 / duration,
            turn: turn(curve),
        })
    }
}

/// Standard deviation of the speed, averaged over [`INTERVALS`], from its straight line over the second half,
/// as a share of `top`.
pub(crate) fn oscillation(curve: &SpeedCurve, top: f64) -> Result<f64, ExperimentError> {
    let per_point = (curve.speeds.len() / INTERVALS).max(1);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let averaged = curve.times.chunks(per_point).zip(curve.speeds.chunks(per_point));
    let points: Vec<(f64, f64)> = averaged.map(|(times, speeds)| (mean(times), mean(speeds))).collect();
    let second_half = &points[points.len() / 2..];
    let unexplained = StraightLine::through(second_half).map_or(1.0, |line| 1.0 - line.explained);
    let speeds: Vec<f64> = second_half.iter().map(|(_, speed)| *speed).collect();
    Ok(Spread::of(&speeds)?.deviation * unexplained.max(0.0).sqrt() / top)
}

/// How sharply the curve turns to its last speed, the mean over its last fifth.
fn turn(curve: &SpeedCurve) -> Option<f64> {
    let last = curve.mean_over_last(0.2).ok()?;
    let reaches = |share: f64| {
        let points = || curve.times.iter().zip(curve.speeds.iter().map(|speed| speed / last));
        let (before, after) = points().zip(points().skip(1)).find(|(_, (_, speed))| *speed >= share)?;
        // Between the two points: a rise may take few of them.
        let part = ((share - before.1) / (after.1 - before.1)).clamp(0.0, 1.0);
        Some(before.0 + part * (after.0 - before.0))
    };
    Some((reaches(0.98)? - reaches(0.90)?) / reaches(0.50)?)
}

/// The middle nine tenths of the speeds of motors that print alike, against time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct SpeedBand {
    pub(crate) time_s: Vec<f64>,
    pub(crate) low_rad_per_s: Vec<f64>,
    pub(crate) high_rad_per_s: Vec<f64>,
}

impl SpeedBand {
    /// The intervals of the curves are equal parts of durations that differ by what the rise times do: a per
    /// cent.
    fn of(curves: &[SpeedCurve]) -> Self {
        let points = curves.iter().map(|curve| curve.times.len()).min().unwrap_or(0);
        let mut band = Self { time_s: Vec::new(), low_rad_per_s: Vec::new(), high_rad_per_s: Vec::new() };
        for point in 0..points {
            if let Some([low, high]) = middle_range(curves.iter().map(|curve| curve.speeds[point])) {
                band.time_s
                    .push(curves.iter().map(|curve| curve.times[point]).sum::<f64>() / curves.len() as f64);
                band.low_rad_per_s.push(low);
                band.high_rad_per_s.push(high);
            }
        }
        band
    }
}

/// The motors from rest, over `rises` rise times each; their starting phases are spread evenly over the cycle
/// of the platform.
pub(crate) fn alike(motors: &[MotorCase], rises: f64) -> Result<Vec<AlikeMotor>, ExperimentError> {
    Ok(alike_with_band(motors, rises)?.0)
}

/// The same, with the speeds that most of them have.
pub(crate) fn alike_with_band(
    motors: &[MotorCase],
    rises: f64,
) -> Result<(Vec<AlikeMotor>, SpeedBand), ExperimentError> {
    let mut alone = alike_groups(&[motors.to_vec()], rises)?;
    alone.pop().ok_or_else(|| ExperimentError::NoData { quantity: "motors".to_owned() })
}

/// The same of several groups at once: many transients advance in lockstep.
pub(crate) fn alike_groups(
    groups: &[Vec<MotorCase>],
    rises: f64,
) -> Result<Vec<(Vec<AlikeMotor>, SpeedBand)>, ExperimentError> {
    let motors = groups.concat();
    let duration = |motor: &MotorCase| rises * motor.rise_time_s();
    let places = groups.iter().flat_map(|group| (0..group.len()).map(|index| (index, group.len())));
    let members = motors.iter().zip(places).map(|(motor, (index, count))| {
        let share = (index as f64 + 0.5) / count as f64;
        Ok(TransientMember {
            system: motor.system()?,
            phase: Phase::new(TAU * share)?,
            settings: TransientSettings {
                duration: duration(motor),
                intervals: INTERVALS,
                relaunch_perturbation: 0.0,
                ..TransientSettings::default()
            },
        })
    });
    let members = members.collect::<Result<Vec<_>, ExperimentError>>()?;
    let curves = transients(&members, &Unobserved)?.into_iter().collect::<Result<Vec<_>, _>>()?;
    let alike = |k: usize| AlikeMotor::of(&motors[k], &curves[k], duration(&motors[k]));
    let alike = in_parallel(motors.len(), alike).into_iter().collect::<Result<Vec<_>, _>>()?;
    let (mut alike, mut curves) = (alike.as_slice(), curves.as_slice());
    let of_group = |group: &Vec<MotorCase>| {
        let own = alike.split_off(..group.len()).unwrap_or_default().to_vec();
        (own, SpeedBand::of(curves.split_off(..group.len()).unwrap_or_default()))
    };
    Ok(groups.iter().map(of_group).collect())
}

/// How many are drawn for a verdict.
pub(crate) const DRAWN: usize = 200;

/// An input between what still rounds to the printed number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    low: f64,
    high: f64,
}

impl Range {
    /// All that rounds to the entry `key`, times a power of ten. A printed zero is a choice, θ = 0 for a linear motion, and taken as exact: there is no
    /// last digit to round.
    pub(crate) fn printed(key: &str, power: i32) -> Result<Self, CatalogueError> {
        let number = catalogue::number(key, power)?;
        let half = if number.value == 0.0 { 0.0 } else { number.half_unit };
        Ok(Self { low: number.value - half, high: number.value + half })
    }

    pub(crate) const fn exactly(value: f64) -> Self {
        Self { low: value, high: value }
    }

    /// From its lowest value to this one.
    pub(crate) const fn up_to(self, high: f64) -> Self {
        Self { high, ..self }
    }

    pub(crate) const fn ends(self) -> [f64; 2] {
        [self.low, self.high]
    }

    fn at(self, share: f64) -> f64 {
        self.low + share * (self.high - self.low)
    }

    fn holds(self, value: f64) -> bool {
        // A value exactly between two printed ones may round either way.
        let widened = 1e-9 * (self.high - self.low);
        (self.low - widened..=self.high + widened).contains(&value)
    }
}

/// Draws of `N` printed inputs, each evenly from what rounds to it.
pub(crate) fn draws<const N: usize>(
    inputs: [(&str, i32); N],
    count: usize,
    seed: u64,
) -> Result<Vec<[f64; N]>, ExperimentError> {
    let mut ranges = [Range::exactly(0.0); N];
    for (range, (key, power)) in ranges.iter_mut().zip(inputs) {
        *range = Range::printed(key, power)?;
    }
    Ok(draws_of(ranges, count, &mut Noise::new(seed)))
}

/// Draws from `N` ranges, each evenly and independently of the others.
pub(crate) fn draws_of<const N: usize>(ranges: [Range; N], count: usize, noise: &mut Noise) -> Vec<[f64; N]> {
    (0..count).map(|_| ranges.map(|range| range.at(noise.even()))).collect()
}

/// How many of some values round to the printed number `key`.
pub(crate) fn agreement(key: &str, values: impl IntoIterator<Item = f64>) -> Result<Cases, ExperimentError> {
    let printed = Range::printed(key, 0)?;
    Ok(Cases::of(values.into_iter().map(|value| printed.holds(value))))
}

/// A motor as its simulation was printed. What the paper set is exact; what it does not print is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PrintedInputs {
    motor: MotorCase,
    amplitude_m: Range,
    preload_acceleration_m_per_s2: Range,
}

impl PrintedInputs {
    /// The motor of Table III. Its g is printed as "70" alone, which is ω/2π; what is meant is gravity, so that every g counts that rounds to the 9.8 of Table I
    /// or lies between it and the 10 m/s² up to which Sec. V B varies g.
    pub(crate) fn table_three() -> Result<Self, ExperimentError> {
        let motor = MotorCase::table_three()?;
        let high = catalogue::number("section5.highest_preload_acceleration", 0)?.value;
        Ok(Self {
            motor,
            amplitude_m: Range::exactly(motor.amplitude_m),
            preload_acceleration_m_per_s2: Range::printed("table1.preload_acceleration", 0)?.up_to(high),
        })
    }

    /// With the amplitude printed as the entry `key`, in metres.
    pub(crate) fn amplitude(self, key: &str) -> Result<Self, ExperimentError> {
        Ok(Self { amplitude_m: Range::exactly(catalogue::number(key, 0)?.value), ..self })
    }

    /// With any amplitude that rounds to the entry `key`: motors like the printed one, where the statement is not about that one alone.
    pub(crate) fn rounded_amplitude(self, key: &str) -> Result<Self, ExperimentError> {
        Ok(Self { amplitude_m: Range::printed(key, 0)?, ..self })
    }

    /// With the preload acceleration printed as the entry `key`, in m/s². Nothing is left to draw then but the last places of the amplitude, which
    /// decide on a long cycle: all amplitudes that agree to twelve digits.
    pub(crate) fn preload_acceleration(self, key: &str) -> Result<Self, ExperimentError> {
        let ends = [1.0 - LAST_PLACES, 1.0 + LAST_PLACES];
        let [low, high] = ends.map(|share| self.amplitude_m.low * share);
        Ok(Self {
            amplitude_m: Range { low, high },
            preload_acceleration_m_per_s2: Range::exactly(catalogue::number(key, 0)?.value),
            ..self
        })
    }

    /// The first `count` motors of the seeded sequence, what is drawn evenly and independently of the other.
    pub(crate) fn drawn(&self, count: usize, seed: u64) -> Vec<MotorCase> {
        let ranges = [self.amplitude_m, self.preload_acceleration_m_per_s2];
        let drawn = draws_of(ranges, count, &mut Noise::new(seed)).into_iter();
        let motor = |[amplitude_m, preload_acceleration_m_per_s2]: [f64; 2]| MotorCase {
            amplitude_m,
            preload_acceleration_m_per_s2,
            ..self.motor
        };
        drawn.map(motor).collect()
    }

    /// What is drawn, for notes and parameter lists.
    pub(crate) fn words(&self) -> String {
        let [low, high] = self.preload_acceleration_m_per_s2.ends();
        if low < high {
            format!("g {low:.2} to {high:.2} m/s², all else as printed")
        } else {
            format!("the amplitude changed by less than {LAST_PLACES:e} of it, all else as printed")
        }
    }
}

/// A part of the amplitude that no printed digit, and no measurement, knows.
const LAST_PLACES: f64 = 1e-12;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_turn_of_both_forms_is_the_one_derived() {
        let curve = |speed: fn(f64) -> f64| {
            let times: Vec<f64> = (0..2_000).map(|i| 0.005 * (f64::from(i) + 0.5)).collect();
            let speeds = times.iter().map(|time| speed(*time)).collect();
            turn(&SpeedCurve { times, speeds, impacts: 0, separations: 0 }).expect("rises")
        };
        assert!((curve(|time| -7.0 * (0.5 * time).min(1.0)) - TURN_OF_RAMP).abs() < 1e-9);
        let exponential = curve(|time| 3.0 * (1.0 - bouncing_disk::core::numerics::elementary::exp(-time)));
        assert!((exponential - TURN_OF_EXPONENTIAL).abs() < 0.01, "{exponential}");
    }

    #[test]
    fn a_slow_rise_is_no_oscillation() {
        let times: Vec<f64> = (0..200).map(f64::from).collect();
        let curve = |speed: fn(f64) -> f64| SpeedCurve {
            speeds: times.iter().map(|time| speed(*time)).collect(),
            times: times.clone(),
            impacts: 0,
            separations: 0,
        };
        assert!(oscillation(&curve(|time| 3.0 + 0.1 * time), 1.0).expect("many") < 1e-9);
        let alternating =
            oscillation(&curve(|time| 0.1 * time + if time % 2.0 < 1.0 { 1.0 } else { -1.0 }), 1.0);
        assert!((alternating.expect("many") - 1.0).abs() < 0.02);
    }

    #[test]
    fn motors_that_print_alike_may_have_either_form() {
        let drawn = PrintedInputs::table_three().expect("reads").drawn(40, 1);
        let drawn: Vec<MotorCase> =
            drawn.into_iter().map(|motor| MotorCase { restitution: 0.1, ..motor }).collect();
        let motors = alike(&drawn, 6.0).expect("run");
        assert_eq!(motors.len(), 40);
        // At so small a restitution most are of low period, and most of these rise linearly.
        let low = motors.iter().filter(|motor| motor.cycle.is_low_period()).count();
        assert!((16..40).contains(&low), "{low}");
        let linear = |low_period: bool| {
            let chosen = motors.iter().filter(|motor| motor.cycle.is_low_period() == low_period);
            let count = chosen.clone().count() as f64;
            chosen.filter(|motor| !motor.is_exponential()).count() as f64 / count
        };
        assert!(linear(true) > linear(false), "{} {}", linear(true), linear(false));
        assert_eq!(motors, alike(&drawn, 6.0).expect("run"));
    }

    #[test]
    fn what_is_printed_is_exact_and_what_is_not_is_drawn() {
        let inputs = PrintedInputs::table_three().expect("reads");
        let motors = inputs.drawn(DRAWN, 7);
        let exact =
            [motors[0].amplitude_m, motors[0].restitution, motors[0].friction, motors[0].frequency_hz];
        assert_eq!(exact.map(f64::to_bits), [1e-8, 0.5, 0.1, 7e4].map(f64::to_bits));
        let preloads = || motors.iter().map(|motor| motor.preload_acceleration_m_per_s2);
        assert!(preloads().all(|preload| (9.75..=10.0).contains(&preload)));
        assert!(preloads().any(|preload| preload < 9.76) && preloads().any(|preload| preload > 9.99));
        assert_ne!(motors, inputs.drawn(DRAWN, 8));
        let [low, high] = ["section5.amplitude_of_low_period", "section5.preload_acceleration_of_low_period"];
        let printed =
            inputs.amplitude(low).and_then(|inputs| inputs.preload_acceleration(high)).expect("reads");
        let motors = printed.drawn(20, 1);
        for motor in &motors {
            assert_eq!(
                [motor.preload_acceleration_m_per_s2, motor.restitution].map(f64::to_bits),
                [1.0, 0.5].map(f64::to_bits)
            );
        }
        assert!(motors.iter().all(|motor| (motor.amplitude_m / 1e-8 - 1.0).abs() <= 1.001 * LAST_PLACES));
        assert!(motors.windows(2).all(|pair| pair[0].amplitude_m.to_bits() != pair[1].amplitude_m.to_bits()));
    }

    #[test]
    fn values_that_print_alike_are_counted() {
        let speeds = agreement("section3.largest_airborne_speed", [21.4, 21.6, 22.5, 22.6]).expect("reads");
        assert_eq!(speeds, Cases { holding: 2, tried: 4 });
    }
}
