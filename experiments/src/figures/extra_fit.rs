//! Beyond the paper: fits of synthetic transients with their intervals, and durations at which they are
//! refused.

use bouncing_disk::core::Unobserved;
use bouncing_disk::core::numerics::elementary::exp;
use bouncing_disk::estimate::{FitError, FitSettings, TransientFit};
use bouncing_disk_plot::{
    Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Legend, Line, Marker, Panel, Rect, Rule,
    Scatter, Stroke, Ticks,
};
use serde::{Deserialize, Serialize};

use super::shared::numbers::Noise;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::shared::map_in_parallel;
use crate::progress::Progress;

/// Seed of the synthetic transients.
const SEED: u64 = 2_009;

/// The parameters of the synthetic transients: rad/s, s; the scatter of the members' speeds, relative; noise
/// in rad/s, and its correlation from point to point; members, and points in a time constant.
const STEADY_SPEED: f64 = 20.0;
const TIME_CONSTANT: f64 = 0.6;
const SCATTER: f64 = 0.05;
const NOISE: f64 = 1.5;
const MEMORY: f64 = 0.8;
const MEMBERS: usize = 8;
const POINTS: u32 = 20;

/// Durations, in time constants.
const DURATIONS: [f64; 11] = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0];

/// Fits with intervals.
#[derive(Debug)]
pub struct ExtraFit;

/// The data of the fits of synthetic transients.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraFitData {
    times_s: Vec<f64>,
    /// Synthetic members, rows, and the fit to their mean.
    members_rad_per_s: Vec<Vec<f64>>,
    fit: TransientFit,
    durations: Vec<Duration>,
}

/// What a duration, in time constants, allows: of synthetic ensembles those that were tried, those whose fit
/// is accepted, and of these the intervals that cover the truth.
#[derive(Debug, Serialize, Deserialize)]
struct Duration {
    time_constants: f64,
    tried: usize,
    accepted: usize,
    constants_covered: usize,
    speeds_covered: usize,
}

impl Experiment for ExtraFit {
    type Data = ExtraFitData;
    const ID: &'static str = "extra-fit";
    const TITLE: &'static str = "What a transient tells of steady speed and time constant";

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("synthetic transients", SEED)]
    }

    fn caption(data: &ExtraFitData) -> String {
        format!(
            "Fits of synthetic transients, made from a steady speed of {STEADY_SPEED} rad/s and a time constant of {TIME_CONSTANT} s \
             with {MEMBERS} members, whose steady speeds scatter by {} %, and correlated noise of {NOISE} rad/s. (a) Members (grey) \
             and the exponential fitted to them. (b) Of {} such ensembles of each duration, the share whose interval covers the time \
             constant (dots) and the steady speed (squares) if the fit is accepted, and the share that is refused (bars). Dashed: 95 %.",
            100.0 * SCATTER,
            data.durations.first().map_or(0, |duration| duration.tried),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraFitData, ExperimentError> {
        let trials = quality.choose(24_u64, 400);
        progress.start(DURATIONS.len() as u64, "durations");
        let times_s = times(DURATIONS[DURATIONS.len() - 1]);
        let members = ensemble(&times_s, SEED);
        let mut durations = Vec::new();
        for time_constants in DURATIONS {
            durations.push(duration(time_constants, trials)?);
            progress.advance(1);
        }
        let fit = fitted(&times_s, &members, FitSettings::default().seed)?;
        Ok(ExtraFitData { fit, times_s, members_rad_per_s: members, durations })
    }

    fn draw(data: &ExtraFitData) -> Result<Figure, ExperimentError> {
        Ok(Figure::new(DOUBLE_COLUMN, 215.0).panels([
            transient(data, Rect::new(40.0, 12.0, 196.0, 165.0)),
            coverage(&data.durations, Rect::new(296.0, 12.0, 202.0, 165.0)),
        ]))
    }
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
    let mut member = || {
        let steady = STEADY_SPEED * (1.0 + SCATTER * noise.bell());
        let mut off = noise.bell();
        let speed = |time: &f64| {
            off = MEMORY * off + fresh * noise.bell();
            steady * (1.0 - exp(-time / TIME_CONSTANT)) + NOISE * off
        };
        times.iter().map(speed).collect()
    };
    (0..MEMBERS).map(|_| member()).collect()
}

fn fitted(times: &[f64], members: &[Vec<f64>], seed: u64) -> Result<TransientFit, FitError> {
    let runs: Vec<(&[f64], &[f64])> = members.iter().map(|member| (times, member.as_slice())).collect();
    TransientFit::of_measured(
        &runs,
        &FitSettings { from_rest: true, seed, ..FitSettings::default() },
        &Unobserved,
    )
}

fn duration(time_constants: f64, trials: u64) -> Result<Duration, ExperimentError> {
    let times = times(time_constants);
    let fit = |trial: &u64| {
        let seed = SEED + trial;
        match fitted(&times, &ensemble(&times, seed), seed) {
            Ok(fit) => Ok(Some(fit)),
            Err(FitError::Refused(_)) => Ok(None),
            Err(error) => Err(error.into()),
        }
    };
    let fits = map_in_parallel(&(1..=trials).collect::<Vec<_>>(), fit)?;
    let accepted: Vec<&TransientFit> = fits.iter().flatten().collect();
    let covered = |holds: fn(&TransientFit) -> bool| accepted.iter().filter(|fit| holds(fit)).count();
    Ok(Duration {
        time_constants,
        tried: fits.len(),
        accepted: accepted.len(),
        constants_covered: covered(|fit| fit.time_constant().contains(TIME_CONSTANT)),
        speeds_covered: covered(|fit| fit.steady_speed().contains(STEADY_SPEED)),
    })
}

fn transient(data: &ExtraFitData, area: Rect) -> Panel {
    let last = data.times_s.last().copied().unwrap_or(1.0);
    let members = data.members_rad_per_s.iter().enumerate().map(|(place, member)| {
        let curve = data.times_s.iter().copied().zip(member.iter().copied());
        let line = Line::new(curve).colour(Colour::LIGHT_GREY).width(0.4);
        if place == 0 { line.name("members") } else { line }
    });
    let exponential = data.fit.exponential;
    let fitted = data.times_s.iter().map(|time| {
        (*time, exponential.steady_speed.value * (1.0 - exp(-time / exponential.constant.value)))
    });
    Panel::new(area)
        .x(Axis::linear(0.0, last).label(r"$t$ (s)").ticks(Ticks::every(1.0).minor(5)))
        .y(Axis::linear(-2.0, 1.35 * STEADY_SPEED)
            .label(r"$\dot{\alpha}$ (rad/s)")
            .ticks(Ticks::every(10.0).minor(5)))
        .letter("a")
        .layers(members)
        .layer(Line::new(fitted).colour(Colour::BLUE).width(1.1).name("exponential"))
        .legend(Legend::at(Corner::BottomRight))
}

fn coverage(durations: &[Duration], area: Rect) -> Panel {
    let share = |of: fn(&Duration) -> usize| -> Vec<(f64, f64)> {
        let judged = durations.iter().filter(|duration| 2 * duration.accepted > duration.tried);
        judged.map(|own| (own.time_constants, of(own) as f64 / own.accepted as f64)).collect()
    };
    let refused = durations.iter().enumerate().map(|(place, duration)| {
        let (at, half) = (duration.time_constants, 0.12);
        let height = 1.0 - duration.accepted as f64 / duration.tried as f64;
        let band = Band::new([(at - half, 0.0, height), (at + half, 0.0, height)]);
        let band = band.colour(Colour::ORANGE).opacity(0.6);
        if place == 0 { band.name("refused") } else { band }
    });
    let speeds = Scatter::new(share(|duration| duration.speeds_covered)).marker(Marker::Square);
    let constants = Scatter::new(share(|duration| duration.constants_covered)).size(3.6);
    Panel::new(area)
        .x(Axis::linear(0.0, 8.4).label(r"duration ($t_c$)").ticks(Ticks::every(2.0).minor(2)))
        .y(Axis::linear(0.0, 1.3).label("share").ticks(Ticks::every(0.5).minor(5)))
        .letter_in("b", Corner::TopRight)
        .layers(refused)
        .layer(Rule::horizontal(0.95).stroke(Stroke::new(Colour::GREY, 0.6).dashed(Dash::Dashed)))
        .layer(speeds.colour(Colour::BLUE).size(5.0).name("speed covered"))
        .layer(constants.name(r"$t_c$ covered"))
        .legend(Legend::at(Corner::BottomRight))
}
