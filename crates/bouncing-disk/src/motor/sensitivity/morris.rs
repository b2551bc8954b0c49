//! Elementary effects (Morris) of any function: a cheap ranking of its arguments over ranges.

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::{mean, standard_deviation};
use bouncing_disk_core::run::Watch;

use crate::error::Error;
use crate::motor::operation::point::Estimate;
use crate::motor::sensitivity::resamples::standard_errors;
use crate::motor::sensitivity::sobol::{SamplingSettings, check_ranges, evaluated};

/// Levels of the grid on which arguments are varied, and the share of a range that a step crosses: p/(2 (p -
/// 1)).
const LEVELS: u64 = 8;
const STEP: f64 = 4.0 / 7.0;

/// The elementary effects of one argument: by how much the function changes per range of the argument.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ElementaryEffects {
    /// Mean, mu.
    pub mean: Estimate,
    /// Mean without the signs, mu*.
    pub mean_size: Estimate,
    /// Standard deviation, sigma: how much the effect varies, by curvature or by interaction with others.
    pub deviation: Estimate,
}

/// The elementary effects of a function of some arguments over their ranges, in their order.
///
/// `function` gets the points of a trajectory, on each of which one more argument has been changed by 4/7
/// of its range, and returns their values. The starting points and the order are drawn independently for each
/// trajectory, so that resampling trajectories gives the standard errors.
///
/// The items of `observer` are the trajectories.
///
/// # Errors
/// Those of [`sobol_indices`](crate::motor::sobol_indices).
pub fn elementary_effects(
    mut function: impl FnMut(&[Vec<f64>]) -> Result<Vec<f64>, Error>,
    ranges: &[[f64; 2]],
    settings: SamplingSettings,
    observer: &dyn Observer,
) -> Result<Vec<ElementaryEffects>, Error> {
    settings.check()?;
    check_ranges(ranges)?;
    let watch = Watch::begin(observer, 0, settings.rows as u64)?;
    let mut random = SplitMix64::new(settings.seed);
    let mut effects = vec![Vec::with_capacity(settings.rows); ranges.len()];
    for _ in 0..settings.rows {
        // The lower half of the levels steps up, the upper half down.
        let levels: Vec<u64> = ranges.iter().map(|_| below(LEVELS, &mut random)).collect();
        let order = shuffled(ranges.len(), &mut random);
        let place = |argument: usize, share: f64| {
            let [low, high] = ranges[argument];
            low + (high - low) * share
        };
        let share = |argument: usize| levels[argument] as f64 / (LEVELS - 1) as f64;
        let mut point: Vec<f64> =
            (0..ranges.len()).map(|argument| place(argument, share(argument))).collect();
        let mut points = vec![point.clone()];
        for &argument in &order {
            let step = if 2 * levels[argument] < LEVELS { STEP } else { -STEP };
            point[argument] = place(argument, share(argument) + step);
            points.push(point.clone());
        }
        let values = evaluated(&points, &mut function)?;
        for (index, &argument) in order.iter().enumerate() {
            let step = if 2 * levels[argument] < LEVELS { STEP } else { -STEP };
            effects[argument].push((values[index + 1] - values[index]) / step);
        }
        watch.finish(1);
        watch.ask()?;
    }
    let results = effects.iter().map(|effects| {
        let of = |rows: &[usize]| {
            let drawn: Vec<f64> = rows.iter().map(|&row| effects[row]).collect();
            let sizes: Vec<f64> = drawn.iter().map(|effect| effect.abs()).collect();
            [mean(&drawn), mean(&sizes), standard_deviation(&drawn)]
        };
        let all: Vec<usize> = (0..effects.len()).collect();
        let (values, errors) = (of(&all), standard_errors(effects.len(), settings.seed ^ 1, of));
        let estimate = |index: usize| Estimate { value: values[index], standard_error: errors[index] };
        ElementaryEffects { mean: estimate(0), mean_size: estimate(1), deviation: estimate(2) }
    });
    let results = results.collect();
    watch.end();
    Ok(results)
}

/// A whole number below another one.
fn below(limit: u64, random: &mut SplitMix64) -> u64 {
    ((random.unit() * limit as f64) as u64).min(limit - 1)
}

/// The numbers from zero on in random order.
fn shuffled(count: usize, random: &mut SplitMix64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        order.swap(last, below(last as u64 + 1, random) as usize);
    }
    order
}
