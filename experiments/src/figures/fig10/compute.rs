//! The computation of Fig. 10.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::chaos::LyapunovEstimate;
use bouncing_disk::core::numerics::elementary::ln;
use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::{ChatterPolicy, ImpactState, Launch, OrbitEvent, Unobserved};
use bouncing_disk::estimate::{RampFit, Spread, TransientEnsemble};
use bouncing_disk::motor::TransientSettings;
use bouncing_disk::{PlatformParameters, System};
use glam::DVec2;

use super::data::{Alike, BetweenRests, Exception, Fig10Data, PerturbationEffect, Reading, Transient};
use crate::claims::Cases;
use crate::claims::paper::{self, STANDARD_GRAVITY};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::alike::{DRAWN, PrintedInputs, alike_with_band, oscillation};
use crate::figures::shared::map_in_parallel;
use crate::figures::shared::motor::MotorCase;
use crate::figures::shared::numbers::median;
use crate::progress::Progress;

/// Relaunch perturbations (units of g/omega) for which the steady speed is compared: from none at all.
const PERTURBATIONS: [f64; 8] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 0.0];
/// Duration of the transients compared, in rise times.
const COMPARED_RISES: [f64; 2] = [6.0, 12.0];
/// Duration of the transients drawn with gravity and with the printed g (s).
const DURATIONS_S: [f64; 2] = [6.0, 0.9];
/// Duration of the transients that verdicts are taken over, in rise times.
const JUDGED_RISES: f64 = 6.0;
/// Seed of the inputs that print alike.
pub(super) const SEED: u64 = 10;

/// Curve points of the member that is drawn, and of the ensemble's band.
pub(super) const MEMBER_INTERVALS: usize = 600;
const BAND_POINTS: usize = 60;

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig10Data, ExperimentError> {
    let table = paper::table_three()?;
    let section = paper::section_five()?;
    let case = MotorCase::table_three()?;
    let members = quality.choose(4, 32);
    let defaults = TransientSettings::default();
    let amplitudes = section.amplitudes_of_fig10_m;
    progress.start((2 * amplitudes.len() + 3) as u64, "parts");

    let mut readings = Vec::new();
    for (preload, duration) in
        [STANDARD_GRAVITY, table.preload_acceleration_m_per_s2].into_iter().zip(DURATIONS_S)
    {
        let mut panels = Vec::new();
        for amplitude_m in amplitudes {
            let motor = MotorCase { amplitude_m, preload_acceleration_m_per_s2: preload, ..case };
            let settings = TransientSettings { duration, intervals: MEMBER_INTERVALS, ..defaults };
            let runs = TransientEnsemble::new(&motor.system()?, &settings, members, &Unobserved)?;
            panels.push(transient(&motor, &runs)?);
            progress.advance(1);
        }
        readings.push(Reading { preload_acceleration_m_per_s2: preload, duration_s: duration, panels });
    }
    let exception = exception(&MotorCase { amplitude_m: amplitudes[0], ..case })?;
    progress.advance(1);
    let inputs = PrintedInputs::table_three()?;
    let count = quality.choose(DRAWN / 10, DRAWN);
    let alike = drawn_alike(inputs, count)?;
    progress.advance(1);
    let rises = quality.choose(COMPARED_RISES[0], COMPARED_RISES[1]);
    let perturbed = |relaunch_perturbation: f64| {
        let statistics = case.statistics(rises, members, relaunch_perturbation)?;
        Ok::<_, ExperimentError>(PerturbationEffect { relaunch_perturbation, statistics })
    };
    let perturbations = PERTURBATIONS.into_iter().map(perturbed).collect::<Result<_, _>>()?;
    progress.advance(1);

    let tsujino_axial_forcing = axial_forcing(
        section.tsujino_amplitude_m,
        section.tsujino_frequency_hz,
        section.tsujino_preload_acceleration_m_per_s2,
    )?;
    Ok(Fig10Data {
        members,
        relaunch_perturbation: defaults.relaunch_perturbation,
        readings,
        exception,
        alike,
        perturbations,
        own_motor_axial_forcing: axial_forcing(
            section.own_motor_amplitude_m,
            section.default_frequency_hz,
            section.gravity_m_per_s2,
        )?,
        tsujino_axial_forcing,
        tsujino_peak_acceleration: PI * tsujino_axial_forcing,
        motor: case,
    })
}

/// Gamma of an amplitude (m), frequency (Hz) and preload acceleration (m/s^2).
fn axial_forcing(amplitude: f64, frequency_hz: f64, preload: f64) -> Result<f64, ExperimentError> {
    let angular_frequency = TAU * frequency_hz;
    let stator = PlatformParameters { amplitude, twist_amplitude: 0.0, angular_frequency, phase_lag: 0.0 };
    Ok(stator.build()?.axial_forcing(preload))
}

/// The motors of Table III at the three amplitudes, with the g drawn that is not printed.
fn drawn_alike(inputs: PrintedInputs, count: usize) -> Result<Alike, ExperimentError> {
    let motors = |key| -> Result<_, ExperimentError> {
        let cases = inputs.amplitude(key)?.drawn(count, SEED);
        let (motors, band) = alike_with_band(&cases, JUDGED_RISES)?;
        Ok((motors, band, between_rests(&cases)?))
    };
    let [small, middle, large] = [
        motors("section5.smallest_amplitude_of_fig10")?,
        motors("section5.middle_amplitude_of_fig10")?,
        motors("section5.largest_amplitude_of_fig10")?,
    ];
    Ok(Alike {
        inputs: inputs.words(),
        motors: [small.0, middle.0, large.0],
        bands: [small.1, middle.1, large.1],
        between_rests: [small.2, middle.2, large.2],
    })
}

/// Impacts after which a motor that has not come to rest is no longer followed.
const LONGEST_FLIGHTS: u64 = 20_000;

/// The growth of a small perturbation from the separation to the next rest, as the mean of its logarithm per
/// impact. A rest ends it: every motor leaves the stator at the same phase again.
fn growth(motor: &MotorCase) -> Result<Option<LyapunovEstimate>, ExperimentError> {
    let map = *motor.system()?.dimensionless().map();
    let Some(leaves) = map.vibration().separation_phase() else { return Ok(None) };
    let mut orbit = map.orbit_from_launch(Launch::new(leaves, 0.0)?, ChatterPolicy::Complete);
    let mut state: Option<ImpactState> = None;
    let (mut perturbation, mut logarithm, mut impacts) = (DVec2::Y, 0.0, 0);
    while impacts < LONGEST_FLIGHTS {
        let Some(OrbitEvent::Impact(impact)) = orbit.advance()? else { break };
        if let Some(state) = state {
            perturbation = map.step_with_derivative(state)?.1 * perturbation;
            let length = perturbation.length();
            logarithm += ln(length);
            perturbation /= length;
            impacts += 1;
        }
        state = Some(impact.into());
    }
    Ok((impacts > 0).then(|| LyapunovEstimate {
        exponent: logarithm / impacts as f64,
        standard_error: 0.0,
        impacts,
    }))
}

fn between_rests(cases: &[MotorCase]) -> Result<BetweenRests, ExperimentError> {
    let growths: Vec<_> = map_in_parallel(cases, growth)?.into_iter().flatten().collect();
    let growing = || growths.iter().filter(|growth| growth.grows());
    Ok(BetweenRests {
        amplitude_m: cases.first().map_or(f64::NAN, |case| case.amplitude_m),
        grows: Cases { holding: growing().count(), tried: cases.len() },
        impacts: median(growing().map(|growth| growth.impacts as f64)),
        growth_per_impact: median(growing().map(|growth| growth.exponent)),
    })
}

/// The cycle of this motor, the range of g in which it exists, and what the motor does elsewhere.
fn exception(motor: &MotorCase) -> Result<Exception, ExperimentError> {
    let printed = motor.preload_acceleration_m_per_s2;
    let at = |preload: f64| MotorCase { preload_acceleration_m_per_s2: preload, ..*motor };
    let no_cycle = || ExperimentError::NoData { quantity: "cycle at 9.8 m/s²".to_owned() };
    let robust_cycle = motor.robust_cycle()?.ok_or_else(no_cycle)?;
    let cycle = robust_cycle.cycle();
    let repeats =
        |preload: f64| Ok::<_, ExperimentError>(at(preload).cycle(ChatterPolicy::Complete)? == cycle);
    // Doubled until the cycle is another one, then bisected; the end inside, so that the cycle is surely
    // there.
    let end = |sign: f64| -> Result<f64, ExperimentError> {
        let mut step = printed * f64::EPSILON;
        while repeats(printed + sign * step)? && step < 0.5 * printed {
            step *= 2.0;
        }
        let (inside, outside) = (printed + sign * 0.5 * step, printed + sign * step);
        // Three units in the last place, within which rounding decides which cycle it is.
        let width = 3.0 * (printed.next_up() - printed);
        if sign < 0.0 {
            bracket_of_width(outside, inside, width, |preload| Ok(!repeats(preload)?)).map(|ends| ends.1)
        } else {
            bracket_of_width(inside, outside, width, repeats).map(|ends| ends.0)
        }
    };
    let settings = TransientSettings {
        duration: DURATIONS_S[0],
        intervals: MEMBER_INTERVALS,
        ..TransientSettings::default()
    };
    let runs = TransientEnsemble::new(&motor.system()?, &settings, 1, &Unobserved)?;
    let curve = &runs.curves[0];
    let (lowest, highest) = (end(-1.0)?, end(1.0)?);
    Ok(Exception {
        amplitude_m: motor.amplitude_m,
        preload_acceleration_m_per_s2: printed,
        peak_acceleration_over_two_pi_squared: motor.system()?.peak_acceleration() / (2.0 * PI * PI),
        robust_cycle,
        lowest_preload_acceleration_m_per_s2: lowest,
        highest_preload_acceleration_m_per_s2: highest,
        relative_width: (highest - lowest) / printed,
        time_s: curve.times.clone(),
        speed_rad_per_s: curve.speeds.clone(),
    })
}

/// Root mean square of member minus exponential fit over the steady speed, mean over the ensemble.
fn relative_exponential_residual(runs: &TransientEnsemble) -> f64 {
    runs.fits.iter().map(|fit| fit.residual / fit.steady_speed).sum::<f64>() / runs.fits.len() as f64
}

/// The oscillation of single orbits, of the members; mean over the ensemble.
fn mean_oscillation(motor: &MotorCase, runs: &TransientEnsemble) -> Result<f64, ExperimentError> {
    let of = |curve| oscillation(curve, motor.peak_angular_speed_rad_per_s);
    let members = runs.curves.iter().map(of).collect::<Result<Vec<f64>, _>>()?;
    Ok(members.iter().sum::<f64>() / members.len() as f64)
}

fn transient(motor: &MotorCase, runs: &TransientEnsemble) -> Result<Transient, ExperimentError> {
    let system: System = motor.system()?;
    let member = &runs.curves[0];
    let per_point = member.times.len() / BAND_POINTS;
    let (mut time, mut low, mut high) = (Vec::new(), Vec::new(), Vec::new());
    for point in 0..BAND_POINTS {
        let range = point * per_point..(point + 1) * per_point;
        let means: Vec<f64> = runs
            .curves
            .iter()
            .map(|curve| curve.speeds[range.clone()].iter().sum::<f64>() / per_point as f64)
            .collect();
        let spread = Spread::of(&means)?;
        time.push(0.5 * (member.times[range.start] + member.times[range.end - 1]));
        low.push(spread.mean - spread.deviation);
        high.push(spread.mean + spread.deviation);
    }
    let mut ramp_residual = 0.0;
    for curve in &runs.curves {
        let ramp = RampFit::new(&curve.times, &curve.speeds)?;
        ramp_residual += ramp.residual / ramp.steady_speed;
    }
    Ok(Transient {
        amplitude_m: motor.amplitude_m,
        axial_forcing: system.axial_forcing(),
        member_time_s: member.times.clone(),
        member_speed_rad_per_s: member.speeds.clone(),
        member_fit: runs.fits[0],
        band_time_s: time,
        band_low_rad_per_s: low,
        band_high_rad_per_s: high,
        steady_speed_rad_per_s: runs.steady_speed,
        time_constant_s: runs.time_constant,
        relative_exponential_residual: relative_exponential_residual(runs),
        relative_ramp_residual: ramp_residual / runs.curves.len() as f64,
        oscillation: mean_oscillation(motor, runs)?,
        cycle: motor.cycle(ChatterPolicy::Complete)?,
        impacts_per_s: member.impacts as f64 / (member.times[0] + member.times[member.times.len() - 1]),
    })
}
