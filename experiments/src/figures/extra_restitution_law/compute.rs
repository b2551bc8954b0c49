//! The computation of the figure.

use std::f64::consts::{PI, TAU};

use bouncing_disk::PAPER_CHATTER;
use bouncing_disk::core::elementary::acos;
use bouncing_disk::core::{
    Constant, ImpactMap, ImpactState, KuwabaraKono, OrbitEvent, Phase, RestitutionLaw, Vibration,
};

use super::data::{Column, ExtraRestitutionLawData, Followed};
use crate::experiment::{ExperimentError, Quality};
use crate::figures::motor_case::core_error;
use crate::paper;
use crate::progress::Progress;

/// The last Γ of the diagram: both attractors are lost before it.
const LAST: f64 = 0.62;

/// The first doubling is looked for between these Γ.
const DOUBLING_WITHIN: (f64, f64) = (0.4, 0.6);

/// Halvings of this interval: to the last bits.
const HALVINGS: u32 = 48;

/// Highest |w_A Γ/(ωA)| at which the laws are drawn.
const FASTEST: f64 = 3.0;

/// What an orbit diagram is made with.
struct Sampling {
    forcings: Vec<f64>,
    transient: usize,
    kept: usize,
}

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraRestitutionLawData, ExperimentError> {
    let section = paper::section_four()?;
    let restitution = section.restitution;
    let law = KuwabaraKono::new(restitution, TAU / (1.0 + restitution)).map_err(core_error)?;
    let (from, values) = (section.followed_from, quality.choose(240, 1_600));
    let sampling = Sampling {
        forcings: (0..values).map(|k| from + (LAST - from) * k as f64 / (values - 1) as f64).collect(),
        transient: quality.choose(600, 3_000),
        kept: quality.choose(80, 240),
    };
    progress.start(2, "laws");
    let constant = followed(&Constant::new(restitution).map_err(core_error)?, restitution, &sampling)?;
    progress.advance(1);
    let viscoelastic = followed(&law, restitution, &sampling)?;
    progress.advance(1);
    let restitution_by_normalised_speed = (0..=120)
        .map(|k| FASTEST * f64::from(k * k) / f64::from(120 * 120))
        .map(|normalised| (normalised, law.restitution(PI * normalised)))
        .collect();
    Ok(ExtraRestitutionLawData {
        law,
        axial_forcing_range: (from, LAST),
        axial_forcing_values: values,
        transient_impacts: sampling.transient,
        kept_impacts: sampling.kept,
        constant,
        viscoelastic,
        restitution_by_normalised_speed,
    })
}

fn map<L: RestitutionLaw>(axial_forcing: f64, law: &L) -> Result<ImpactMap<L>, ExperimentError> {
    Ok(ImpactMap::with_law(Vibration::from_axial_forcing(axial_forcing).map_err(core_error)?, law.clone()))
}

/// The impact of the period-1 orbit in closed form: the disk lands with v = 2π/(1 + r) where the platform rises with
/// π (1 - r)/(1 + r) and brakes.
fn period_one(axial_forcing: f64, restitution: f64) -> Result<ImpactState, ExperimentError> {
    let angle = acos((1.0 - restitution) / (1.0 + restitution) / axial_forcing);
    let phase = Phase::new(angle).map_err(core_error)?;
    ImpactState::new(phase, -TAU / (1.0 + restitution)).map_err(core_error)
}

fn followed<L: RestitutionLaw>(
    law: &L,
    restitution: f64,
    sampling: &Sampling,
) -> Result<Followed, ExperimentError> {
    let first = sampling.forcings.first().copied().unwrap_or(DOUBLING_WITHIN.0);
    let mut state = period_one(first, restitution)?;
    let (mut columns, mut lost_at) = (Vec::new(), None);
    for &axial_forcing in &sampling.forcings {
        let mut orbit = map(axial_forcing, law)?.orbit(state, PAPER_CHATTER);
        let mut column =
            Column { axial_forcing, impact_phase_cycles: Vec::new(), normalised_impact_speed: Vec::new() };
        for index in 0..sampling.transient + sampling.kept {
            let Some(OrbitEvent::Impact(impact)) = orbit.advance().map_err(core_error)? else {
                lost_at = Some(axial_forcing);
                break;
            };
            state = ImpactState::from(impact);
            if index >= sampling.transient {
                column.impact_phase_cycles.push(state.phase().angle() / TAU);
                column.normalised_impact_speed.push(state.normalised_speed());
            }
        }
        if lost_at.is_some() {
            break;
        }
        columns.push(column);
    }
    let (mut low, mut high) = DOUBLING_WITHIN;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let (trace, determinant, _) = monodromy(middle, restitution, law)?;
        // The sign of (1 + one multiplier)(1 + the other one).
        if 1.0 + trace + determinant > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let first_doubling = 0.5 * (low + high);
    let (_, determinant, off_period_one) = monodromy(first_doubling, restitution, law)?;
    let speed = TAU / (1.0 + restitution);
    let launch_slope = law.restitution(speed) + speed * law.derivative(speed);
    Ok(Followed { columns, lost_at, first_doubling, determinant, launch_slope, off_period_one })
}

/// Trace and determinant of the derivative of the map at the period-1 impact, and how far its image is off.
fn monodromy<L: RestitutionLaw>(
    axial_forcing: f64,
    restitution: f64,
    law: &L,
) -> Result<(f64, f64, f64), ExperimentError> {
    let start = period_one(axial_forcing, restitution)?;
    let (impact, derivative) = map(axial_forcing, law)?.step_with_derivative(start).map_err(core_error)?;
    let end = ImpactState::from(impact);
    let off =
        (end.phase().angle() - start.phase().angle()).abs().max((end.velocity() - start.velocity()).abs());
    let trace = derivative.x_axis.x + derivative.y_axis.y;
    Ok((trace, derivative.determinant(), off))
}
