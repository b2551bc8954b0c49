//! The computation of the figure.

use std::f64::consts::{FRAC_1_PI, TAU};

use bouncing_disk::core::{
    ImpactMap, ImpactState, Phase, Verdict, VerdictSettings, Vibration, verdicts_observed,
};

use super::data::{ExtraRegimesData, Kind};
use crate::experiment::{ExperimentError, Quality};
use crate::progress::{Progress, advancing};

/// Γ and restitutions of the map.
const FORCINGS: [f64; 2] = [0.0, 3.0];
const RESTITUTIONS: [f64; 2] = [0.0, 0.95];

pub(super) fn compute(
    quality: Quality,
    progress: &dyn Progress,
) -> Result<ExtraRegimesData, ExperimentError> {
    let (columns, rows) = quality.choose((160, 120), (1_000, 1_000));
    let (transient, impacts) = quality.choose((300, 600), (1_000, 2_000));
    let settings = VerdictSettings { transient, impacts, longest_period: 64, tolerance: 1e-6 };
    let (axial_forcings, restitutions) = (middles(FORCINGS, columns), middles(RESTITUTIONS, rows));
    let mut starts = Vec::with_capacity(columns * rows);
    for restitution in &restitutions {
        for forcing in &axial_forcings {
            starts.push(start(*forcing, *restitution).map_err(ExperimentError::model)?);
        }
    }
    progress.start(starts.len() as u64, "cells");
    let verdicts =
        verdicts_observed(&starts, settings, &advancing(progress)).map_err(ExperimentError::model)?;
    let kinds: Vec<Kind> = verdicts.iter().map(kind).collect();
    let counts = Kind::ALL.map(|kind| kinds.iter().filter(|own| **own == kind).count());
    let cells =
        || starts.iter().map(|(map, _)| (map.vibration().axial_forcing(), map.restitution())).zip(&verdicts);
    let period_one_outside = cells()
        .filter(|((forcing, restitution), verdict)| {
            matches!(verdict, Verdict::Periodic { impacts: 1, platform_periods: 1, .. })
                && !(birth(*restitution)..=ImpactMap::first_doubling_forcing(*restitution)).contains(forcing)
        })
        .count();
    let weak = |rests: bool| {
        cells()
            .filter(|((forcing, restitution), verdict)| {
                *forcing < FRAC_1_PI.min(birth(*restitution))
                    && (!rests || matches!(verdict, Verdict::AtRest { .. }))
            })
            .count()
    };
    let after_rest = verdicts.iter().filter(|verdict| {
        matches!(verdict, Verdict::Periodic { rests: 1, .. } | Verdict::Chaotic { rests: 1, .. })
    });
    Ok(ExtraRegimesData {
        settings,
        rows: kinds
            .chunks(columns)
            .map(|row| row.iter().map(|kind| char::from(b'0' + kind.digit())).collect())
            .collect(),
        counts: counts.into(),
        period_one_outside,
        weak: [weak(false), weak(true)],
        after_rest: after_rest.count(),
        axial_forcings,
        restitutions,
    })
}

/// Γ at which the period-1 orbit with an impact in each period of the platform is born.
fn birth(restitution: f64) -> f64 {
    (1.0 - restitution) / (1.0 + restitution)
}

/// The map, and an impact where the platform rises fastest with the speed of the period-1 orbit.
fn start(forcing: f64, restitution: f64) -> Result<(ImpactMap, ImpactState), bouncing_disk::core::Error> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(forcing)?, restitution)?;
    Ok((map, ImpactState::new(Phase::new(0.0)?, -TAU / (1.0 + restitution))?))
}

fn kind(verdict: &Verdict) -> Kind {
    match verdict {
        Verdict::AtRest { .. } => Kind::AtRest,
        Verdict::Chattering { cycle, .. } if cycle.is_exact() => Kind::ExactCycle,
        Verdict::Chattering { .. } => Kind::LongCycle,
        Verdict::Periodic { impacts: 1, .. } => Kind::PeriodOne,
        Verdict::Periodic { impacts: 2, .. } => Kind::PeriodTwo,
        Verdict::Periodic { impacts: 3, .. } => Kind::PeriodThree,
        Verdict::Periodic { .. } => Kind::LongerPeriod,
        Verdict::Chaotic { .. } => Kind::Chaotic,
        _ => Kind::Undecided,
    }
}

/// The middles of equal parts of a range.
fn middles([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|k| from + (to - from) * (k as f64 + 0.5) / count as f64).collect()
}
