//! The computation of the figure.

use bouncing_disk::core::elementary::ln;
use bouncing_disk::core::{
    ChatterPolicy, CycleTrust, ImpactMap, ImpactState, LyapunovOutcome, Orbit, UndecidedReason, Verdict,
    VerdictSettings, Vibration, lyapunov_spectra_observed, orbit_diagram, verdicts_observed,
};

use super::data::{Column, ExtraLyapunovData, Kind};
use crate::experiment::{ExperimentError, Quality};
use crate::progress::{Progress, advancing};

const RESTITUTION: f64 = 0.5;

/// Γ of the columns.
const FORCINGS: [f64; 2] = [0.44, 0.62];

/// Impacts before those that are drawn.
const SKIPPED: usize = 1_000;

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraLyapunovData, ExperimentError> {
    let (columns, drawn) = quality.choose((120, 20), (1_800, 150));
    let (transient, impacts) = quality.choose((1_000, 2_000), (2_000, 50_000));
    let settings = VerdictSettings { transient, impacts, ..VerdictSettings::default() };
    let starts = starts(columns).map_err(ExperimentError::model)?;
    progress.start(2 * starts.len() as u64, "orbits");
    let verdicts =
        verdicts_observed(&starts, settings, &advancing(progress)).map_err(ExperimentError::model)?;
    let spectra = lyapunov_spectra_observed(&starts, transient, impacts, &advancing(progress))
        .map_err(ExperimentError::model)?;
    let orbits: Vec<Orbit> =
        starts.iter().map(|(map, state)| map.orbit(*state, ChatterPolicy::Complete)).collect();
    let diagram = orbit_diagram(&orbits, SKIPPED, drawn).map_err(ExperimentError::model)?;
    let sums: Vec<f64> = spectra.iter().filter_map(sum_deviation).collect();
    let multipliers = verdicts.iter().zip(&spectra).filter_map(multiplier_deviation);
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, f64::max);
    Ok(ExtraLyapunovData {
        restitution: RESTITUTION,
        settings,
        first_doubling_forcing: ImpactMap::first_doubling_forcing(RESTITUTION),
        sum_deviation: most(&mut sums.iter().copied()),
        columns_with_sum: sums.len(),
        multiplier_deviation: most(&mut { multipliers }),
        columns: starts
            .iter()
            .zip(verdicts)
            .zip(diagram)
            .map(|(((map, _), verdict), impacts)| {
                let phases = impacts.iter().map(|impact| impact.phase().cycles()).collect();
                column(map.vibration().axial_forcing(), &verdict, phases)
            })
            .collect(),
    })
}

fn starts(columns: usize) -> Result<Vec<(ImpactMap, ImpactState)>, bouncing_disk::core::Error> {
    let [from, to] = FORCINGS;
    let state = ImpactState::from_normalised(1.2, 1.3)?;
    (0..columns)
        .map(|k| {
            let forcing = from + (to - from) * (k as f64 + 0.5) / columns as f64;
            Ok((ImpactMap::new(Vibration::from_axial_forcing(forcing)?, RESTITUTION)?, state))
        })
        .collect()
}

fn column(axial_forcing: f64, verdict: &Verdict, impact_phase_cycles: Vec<f64>) -> Column {
    let (kind, exponent, standard_error, impacts) = match *verdict {
        Verdict::Periodic { impacts, multipliers, .. } => {
            let exponent = ln(multipliers.spectral_radius()) / impacts as f64;
            (Kind::Periodic, exponent.is_finite().then_some(exponent), None, Some(impacts))
        }
        Verdict::Chaotic { exponent, standard_error, .. } => {
            (Kind::Chaotic, Some(exponent), Some(standard_error), None)
        }
        Verdict::Chattering { cycle, .. } => {
            let (exponent, standard_error) = match cycle.trust {
                CycleTrust::ChosenByRounding { exponent, standard_error } => (exponent, standard_error),
                _ => (None, None),
            };
            (Kind::Rest, exponent, standard_error, Some(cycle.impacts))
        }
        Verdict::AtRest { .. } => (Kind::Rest, None, None, None),
        Verdict::Undecided { reason, .. } => {
            let (exponent, standard_error) = match reason {
                UndecidedReason::ExponentNearZero { exponent, standard_error }
                | UndecidedReason::NoPeriodFound { exponent, standard_error }
                | UndecidedReason::TransientMayLast { exponent, standard_error, .. } => {
                    (Some(exponent), Some(standard_error))
                }
                _ => (None, None),
            };
            (Kind::Undecided, exponent, standard_error, None)
        }
        _ => (Kind::Undecided, None, None, None),
    };
    Column { axial_forcing, kind, exponent, standard_error, impacts, impact_phase_cycles }
}

/// How far the sum of both exponents is from its exact value.
fn sum_deviation(outcome: &LyapunovOutcome) -> Option<f64> {
    let spectrum = outcome.spectrum()?;
    Some((spectrum.largest + spectrum.second? - spectrum.exact_sum?).abs())
}

/// How far the exponent along an orbit is from that of its multipliers, in the larger of its standard error
/// and what the first impacts, which turn the perturbation into its direction, may contribute.
fn multiplier_deviation((verdict, outcome): (&Verdict, &LyapunovOutcome)) -> Option<f64> {
    let (Verdict::Periodic { impacts, multipliers, rests: 0, .. }, Some(spectrum)) =
        (verdict, outcome.spectrum())
    else {
        return None;
    };
    let exponent = ln(multipliers.spectral_radius()) / *impacts as f64;
    let unit = spectrum.standard_error.max(1.0 / spectrum.impacts as f64);
    exponent.is_finite().then(|| (spectrum.largest - exponent).abs() / unit)
}
