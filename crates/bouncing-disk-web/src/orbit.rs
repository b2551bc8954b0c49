//! What one orbit does for good.

use bouncing_disk::core::attractors::{UndecidedReason, Verdict, VerdictSettings};
use bouncing_disk::core::orbits::Multipliers;
use serde::Serialize;

use crate::refusal::Refusal;
use crate::reply::Reply;
use crate::request::{ImpactStart, map};

#[derive(Debug, Default, Serialize)]
struct VerdictJson {
    kind: &'static str,
    impacts: Option<u64>,
    platform_periods: Option<u64>,
    multipliers: Option<[[f64; 2]; 2]>,
    exponent: Option<f64>,
    exponent_error: Option<f64>,
    rounding_dependent: bool,
    text: String,
}

pub(crate) fn answer(axial_forcing: f64, restitution: f64, start: ImpactStart) -> Result<Reply, Refusal> {
    let map = map(axial_forcing, restitution)?;
    let verdict = map.verdict(start.state()?, VerdictSettings::default())?;
    Reply::short(&told(&verdict))
}

fn told(verdict: &Verdict) -> VerdictJson {
    let text = verdict.to_string();
    match verdict {
        Verdict::Periodic { impacts, platform_periods, multipliers, .. } => VerdictJson {
            kind: "periodic",
            impacts: Some(*impacts),
            platform_periods: Some(*platform_periods),
            multipliers: Some(pairs(*multipliers)),
            // JSON has no infinity: that of a superstable orbit is left out.
            exponent: Some(multipliers.lyapunov_exponent(*impacts)).filter(|exponent| exponent.is_finite()),
            text,
            ..VerdictJson::default()
        },
        Verdict::Chaotic { exponent, standard_error, .. } => VerdictJson {
            kind: "chaotic",
            exponent: Some(*exponent),
            exponent_error: Some(*standard_error),
            text,
            ..VerdictJson::default()
        },
        Verdict::Chattering { cycle, .. } => VerdictJson {
            kind: "chattering",
            impacts: Some(cycle.impacts),
            platform_periods: Some(cycle.platform_periods),
            rounding_dependent: !cycle.is_exact(),
            text,
            ..VerdictJson::default()
        },
        Verdict::AtRest { .. } => VerdictJson { kind: "at-rest", text, ..VerdictJson::default() },
        Verdict::Undecided { reason, .. } => {
            let (exponent, exponent_error) = match *reason {
                UndecidedReason::ExponentNearZero { exponent, standard_error }
                | UndecidedReason::NoPeriodFound { exponent, standard_error }
                | UndecidedReason::TransientMayLast { exponent, standard_error, .. } => {
                    (Some(exponent), Some(standard_error))
                }
                _ => (None, None),
            };
            VerdictJson { kind: "undecided", exponent, exponent_error, text, ..VerdictJson::default() }
        }
        _ => VerdictJson { kind: "undecided", text, ..VerdictJson::default() },
    }
}

/// Real and imaginary part of each.
fn pairs(multipliers: Multipliers) -> [[f64; 2]; 2] {
    match multipliers {
        Multipliers::Real(first, second) => [[first, 0.0], [second, 0.0]],
        Multipliers::Complex { real, imaginary } => [[real, imaginary], [real, -imaginary]],
    }
}
