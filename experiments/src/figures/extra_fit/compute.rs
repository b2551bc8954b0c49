//! The computation of the figure.

use bouncing_disk::core::elementary::exp;
use bouncing_disk::{Error, FitSettings, TransientFit};
use rayon::prelude::*;

use super::data::{Duration, ExtraFitData};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::synthetic::Noise;
use crate::progress::Progress;

/// Seed of the synthetic transients.
pub(super) const SEED: u64 = 2_009;

/// What the transients are made from.
const STEADY_SPEED: f64 = 20.0;
const TIME_CONSTANT: f64 = 0.6;
const SCATTER: f64 = 0.05;
const NOISE: f64 = 1.5;
const MEMORY: f64 = 0.8;
const MEMBERS: usize = 8;
const POINTS: u32 = 20;

/// Durations, in time constants.
const DURATIONS: [f64; 11] = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0];

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraFitData, ExperimentError> {
    let settings = FitSettings { from_rest: true, ..FitSettings::default() };
    let trials = quality.choose(24_u64, 400);
    progress.start(DURATIONS.len() as u64, "durations");
    let last = DURATIONS[DURATIONS.len() - 1];
    let times_s = times(last);
    let members = ensemble(&times_s, SEED);
    let fit = fitted(&times_s, &members, &settings)?;
    let count = members.len() as f64;
    let mean = (0..times_s.len()).map(|k| members.iter().map(|member| member[k]).sum::<f64>() / count);
    let exponential = fit.exponential;
    let ramp = fit.ramp.map(|ramp| {
        times_s.iter().map(|time| ramp.steady_speed.value * (time / ramp.constant.value).min(1.0)).collect()
    });
    let durations = DURATIONS
        .into_iter()
        .map(|time_constants| {
            let duration = duration(time_constants, &members, &settings, trials);
            progress.advance(1);
            duration
        })
        .collect::<Result<_, _>>()?;
    Ok(ExtraFitData {
        steady_speed_rad_per_s: STEADY_SPEED,
        time_constant_s: TIME_CONSTANT,
        member_scatter: SCATTER,
        noise_rad_per_s: NOISE,
        noise_memory: MEMORY,
        members: MEMBERS,
        points_per_time_constant: POINTS,
        settings,
        mean_rad_per_s: mean.collect(),
        exponential_rad_per_s: times_s
            .iter()
            .map(|time| exponential.steady_speed.value * (1.0 - exp(-time / exponential.constant.value)))
            .collect(),
        ramp_rad_per_s: ramp,
        times_s,
        members_rad_per_s: members,
        fit,
        durations,
    })
}

/// The middles of equal intervals up to so many time constants.
fn times(time_constants: f64) -> Vec<f64> {
    let count = (time_constants * f64::from(POINTS)) as u32;
    (0..count).map(|k| TIME_CONSTANT * (f64::from(k) + 0.5) / f64::from(POINTS)).collect()
}

/// Synthetic members: each with a steady speed of its own, and noise that remembers itself.
fn ensemble(times: &[f64], seed: u64) -> Vec<Vec<f64>> {
    let mut noise = Noise::new(seed);
    let fresh = (1.0 - MEMORY * MEMORY).sqrt();
    (0..MEMBERS)
        .map(|_| {
            let steady = STEADY_SPEED * (1.0 + SCATTER * noise.bell());
            let mut off = noise.bell();
            times
                .iter()
                .map(|time| {
                    off = MEMORY * off + fresh * noise.bell();
                    steady * (1.0 - exp(-time / TIME_CONSTANT)) + NOISE * off
                })
                .collect()
        })
        .collect()
}

fn fitted(times: &[f64], members: &[Vec<f64>], settings: &FitSettings) -> Result<TransientFit, Error> {
    let runs: Vec<(&[f64], &[f64])> = members.iter().map(|member| (times, &member[..times.len()])).collect();
    TransientFit::of_measured(&runs, settings)
}

/// The fit, or why it is refused.
type Judged = Result<TransientFit, String>;

fn judged(fit: Result<TransientFit, Error>) -> Result<Judged, ExperimentError> {
    match fit {
        Ok(fit) => Ok(Ok(fit)),
        Err(Error::FitRefused { reason }) => Ok(Err(reason.to_string())),
        Err(error) => Err(error.into()),
    }
}

fn duration(
    time_constants: f64,
    members: &[Vec<f64>],
    settings: &FitSettings,
    trials: u64,
) -> Result<Duration, ExperimentError> {
    let times = times(time_constants);
    let own = judged(fitted(&times, members, settings))?;
    let further: Vec<Result<Judged, ExperimentError>> = (1..=trials)
        .into_par_iter()
        .map(|trial| {
            let seed = SEED + trial;
            judged(fitted(&times, &ensemble(&times, seed), &FitSettings { seed, ..*settings }))
        })
        .collect();
    let further = further.into_iter().collect::<Result<Vec<_>, _>>()?;
    let accepted: Vec<&TransientFit> = further.iter().filter_map(|fit| fit.as_ref().ok()).collect();
    let covered = |holds: fn(&TransientFit) -> bool| accepted.iter().filter(|fit| holds(fit)).count();
    Ok(Duration {
        time_constants,
        time_constant_s: own.as_ref().ok().map(TransientFit::time_constant),
        steady_speed_rad_per_s: own.as_ref().ok().map(TransientFit::steady_speed),
        refusal: own.err(),
        tried: further.len(),
        accepted: accepted.len(),
        constants_covered: covered(|fit| fit.time_constant().contains(TIME_CONSTANT)),
        speeds_covered: covered(|fit| fit.steady_speed().contains(STEADY_SPEED)),
    })
}
