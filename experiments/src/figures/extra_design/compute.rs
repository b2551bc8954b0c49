//! The computation of the figure.

use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::{
    InitialSpin, Platform, Stroke, System, TossConstraints, TossDesign, TossHalfUnits, best_toss, single_toss,
};
use rayon::prelude::*;

use super::data::{Best, Curve, ExtraDesignData, Random};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::synthetic::Noise;
use crate::progress::Progress;

/// Seed of the random hand motions.
pub(super) const SEED: u64 = 5;

/// Friction between hand and dough, with more or less flour.
const FRICTION: [f64; 2] = [0.4, 0.7];

/// Angular frequencies of the hand (rad/s): at 8 rad/s and below the dough hardly leaves the hand, and any error keeps it
/// there.
const FREQUENCIES: [f64; 2] = [9.0, 16.0];

/// Limits of the flight (m): none, and that of a low ceiling.
const LIMITS: [Option<f64>; 3] = [None, Some(0.4), Some(0.2)];

/// Half a unit of the last digit that a hand keeps.
const HALF_UNITS: TossHalfUnits = TossHalfUnits {
    stroke: 0.005,
    angular_frequency: 0.25,
    amplitude_angle: 0.005 * PI,
    phase_lag: 0.005 * PI,
    contact_radius: 0.0,
    gyration_radius: 0.0,
    preload_acceleration: 0.0,
};

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraDesignData, ExperimentError> {
    let table = TossConstraints::pizza_toss();
    let count = quality.choose(8, 36);
    let frequencies: Vec<f64> = (0..count)
        .map(|k| FREQUENCIES[0] + (FREQUENCIES[1] - FREQUENCIES[0]) * f64::from(k) / f64::from(count - 1))
        .collect();
    progress.start(LIMITS.len() as u64 * count as u64, "designs");
    let mut curves = Vec::new();
    for highest_flight_m in LIMITS {
        let points: Vec<Result<Best, ExperimentError>> = frequencies
            .par_iter()
            .map(|&frequency| {
                let constraints = TossConstraints {
                    friction: FRICTION,
                    angular_frequency: [frequency; 2],
                    highest_flight: highest_flight_m,
                    ..table
                };
                let design = best_toss(&constraints)?;
                let robustness = design.robustness(&HALF_UNITS)?;
                progress.advance(1);
                Ok(Best { design, robustness })
            })
            .collect();
        curves.push(Curve { highest_flight_m, points: points.into_iter().collect::<Result<_, _>>()? });
    }
    let hand = Stroke::pizza_toss();
    let speed = |friction: f64| toss(&table, hand, friction).map(|speed| speed.unwrap_or(0.0));
    let at_table_one: TossDesign = best_toss(&table)?;
    // The least over a fine grid: the speed is smooth in the friction but for where sliding begins.
    let steps = 64;
    let mut worst = f64::INFINITY;
    for step in 0..=steps {
        let share = f64::from(step) / f64::from(steps);
        worst = worst.min(speed(FRICTION[0] + (FRICTION[1] - FRICTION[0]) * share)?);
    }
    Ok(ExtraDesignData {
        stroke_m: table.stroke,
        friction: FRICTION,
        curves,
        table_one: hand,
        table_one_speed_rad_per_s: speed(table.friction[0])?,
        table_one_worst_rad_per_s: worst,
        at_table_one,
        random: random(&table, hand, quality.choose(400, 10_000))?,
    })
}

/// The airborne speed (rad/s), in whichever direction, that a hand gives the dough; `None` where it does not leave.
fn toss(constraints: &TossConstraints, hand: Stroke, friction: f64) -> Result<Option<f64>, ExperimentError> {
    let platform = Platform::from_stroke(hand)?;
    let mut dough = constraints.dough;
    dough.friction = friction;
    let system = System::new(platform, dough.build()?)?;
    match single_toss(&system, InitialSpin::AbsoluteRest) {
        Ok(toss) => Ok(Some(toss.airborne_speed.abs())),
        Err(bouncing_disk::Error::NeverLeaves { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// Hand motions with any amplitude angle and any lag, at the frequency and friction of Table I.
fn random(table: &TossConstraints, hand: Stroke, tried: usize) -> Result<Random, ExperimentError> {
    let mut noise = Noise::new(SEED);
    let (mut leaving, mut best_rad_per_s) = (0, 0.0_f64);
    for _ in 0..tried {
        let amplitude_angle = FRAC_PI_2 * noise.even();
        let phase_lag = PI * (noise.even() - 0.5);
        let own = Stroke { amplitude_angle, phase_lag, ..hand };
        if let Some(speed) = toss(table, own, table.friction[0])? {
            leaving += 1;
            best_rad_per_s = best_rad_per_s.max(speed);
        }
    }
    Ok(Random { tried, leaving, best_rad_per_s })
}
