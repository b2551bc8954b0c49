//! The computation of the figure.

use bouncing_disk::core::extended::{self, DoubleDouble, ExtendedDoubling, first_doubling_forcing};
use bouncing_disk::core::{CascadeDoubling, FeigenbaumEstimate, doubling_cascade, feigenbaum_estimates};
use rayon::prelude::*;

use super::data::{Cascade, Constants, DoublesEnd, Doubling, Estimate, ExtraCascadeData};
use crate::experiment::{ExperimentError, Quality};
use crate::paper;
use crate::progress::Progress;

/// Feigenbaum's constants (K. Briggs, Math. Comp. 57, 435 (1991)).
const DELTA: f64 = 4.669_201_609_102_99;
const ALPHA: f64 = 2.502_907_875_095_892_7;

/// ε besides that of Fig. 6.
const OTHER_RESTITUTIONS: [&str; 2] = ["0.1", "0.8"];

/// By what the rounding of Γ_n in doubles grows from one doubling to the next (docs/numerics/dynamics.md).
const ERROR_GROWTH: f64 = 1.418;

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraCascadeData, ExperimentError> {
    let count = quality.choose(11, 13);
    let of_fig6 = paper::section_four()?.restitution.to_string();
    let restitutions: Vec<&str> = std::iter::once(of_fig6.as_str()).chain(OTHER_RESTITUTIONS).collect();
    progress.start(restitutions.len() as u64, "cascades");
    let cascades = restitutions
        .par_iter()
        .map(|restitution| {
            let cascade = cascade(restitution, count).map_err(ExperimentError::model);
            progress.advance(1);
            cascade
        })
        .collect::<Result<_, _>>()?;
    Ok(ExtraCascadeData { published_delta: DELTA, published_alpha: ALPHA, cascades })
}

fn cascade(restitution: &str, count: usize) -> Result<Cascade, bouncing_disk::core::Error> {
    let exact: DoubleDouble = restitution.parse()?;
    let found = extended::doubling_cascade(exact, count)?;
    let in_doubles = doubling_cascade(exact.high(), count)?;
    let doublings: Vec<Doubling> = (0..found.len())
        .map(|index| {
            doubling(index.checked_sub(1).map(|before| &found[before]), &found[index], &in_doubles[index])
        })
        .collect();
    let estimates: Vec<Estimate> = extended::feigenbaum_estimates(&found)
        .iter()
        .zip(feigenbaum_estimates(&in_doubles))
        .map(|(extended, own)| Estimate {
            number: extended.number,
            extended: constants(extended),
            in_doubles: constants(&own),
        })
        .collect();
    let closed_form = first_doubling_forcing(exact);
    let last = doublings.last().and_then(|last| last.separation).unwrap_or_default();
    Ok(Cascade {
        restitution: restitution.to_owned(),
        closed_form_deviation: found.first().map_or(0.0, |first| (first.axial_forcing - closed_form).high()),
        beyond_last: last / (DELTA - 1.0),
        doubles_end: doubles_end(count, last, in_doubles.last().map_or(0.0, |last| last.forcing_error)),
        doublings,
        estimates,
    })
}

fn doubling(before: Option<&ExtendedDoubling>, found: &ExtendedDoubling, own: &CascadeDoubling) -> Doubling {
    let error = DoubleDouble::from(own.axial_forcing) - found.axial_forcing;
    Doubling {
        number: found.number,
        period: found.period,
        axial_forcing: format!("{:.25}", found.axial_forcing),
        separation: before.map(|before| (found.axial_forcing - before.axial_forcing).high()),
        width: found.width.high(),
        forcing_error: found.forcing_error,
        axial_forcing_in_doubles: own.axial_forcing,
        forcing_error_in_doubles: own.forcing_error,
        true_error_in_doubles: error.high().abs(),
        multiplier_error_in_doubles: (own.multiplier + 1.0).abs(),
    }
}

fn constants(estimate: &FeigenbaumEstimate) -> Constants {
    Constants {
        forcing_ratio: estimate.forcing_ratio,
        delta: estimate.delta,
        delta_error: estimate.delta_error,
        width_ratio: estimate.width_ratio,
        alpha: estimate.alpha,
        alpha_error: estimate.alpha_error,
    }
}

/// Goes on from the last separation and the last stated error, until the former is not the larger one.
fn doubles_end(mut number: usize, mut separation: f64, mut forcing_error: f64) -> DoublesEnd {
    while separation > forcing_error {
        number += 1;
        separation /= DELTA;
        forcing_error *= ERROR_GROWTH;
    }
    DoublesEnd { number, separation, forcing_error }
}
