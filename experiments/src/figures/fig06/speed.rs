//! The speed in chaos and beyond the merging: the best phase lag, and cycles in which one impact decides.

use std::f64::consts::PI;

use bouncing_disk::InitialCondition;
use bouncing_disk::core::chaos::lyapunov_exponents;
use bouncing_disk::core::orbits::Followed;
use bouncing_disk::core::{ImpactState, Phase, Unobserved};
use bouncing_disk::motor::{NormalImpulses, PhasedImpulse};
use bouncing_disk::toss::{MultiTossSettings, OrbitClass, multi_toss};
use serde::Serialize;

use super::SAMPLED;
use super::diagram::{Diagram, Twist, sampled, start};
use crate::claims::{Cases, Claim, all};
use crate::experiment::{ExperimentError, Paper, Quality};
use crate::figures::shared::numbers::extent;
use crate::figures::shared::{map, map_in_parallel};

/// Impacts over which a Lyapunov exponent is taken.
const GROWTH_IMPACTS: usize = 4_000;
/// Impacts that a search for the best lag discards: more than the rotation takes to settle at Γ_T = 100.
const LAG_TRANSIENT: usize = 300;
/// The lags tried, in steps: wherever an orbit spends its impacts between phase 0 and a quarter of a period,
/// the best lag is there.
const LAGS_DEG: std::ops::RangeInclusive<i32> = -9..=2;
/// Distance of two lags (degrees).
const LAG_STEP_DEG: i32 = 10;
/// The largest Γ up to which cycles are looked for in which one impact has most of the impulse: where the
/// paper's own motor operates.
const LARGEST_FORCING: f64 = 3.0;
/// Γ_T of the motors simulated there: as in a motor, it leaves the speed to change little in one impact.
const LARGE_ANGULAR_FORCING: f64 = 1.0e4;
/// Impacts of a cycle from rest, at least.
const WEIGHED_IMPACTS: usize = 400;
/// A speed of at least this share of ωΦ is the maximum: it differs by rounding.
const AT_MAXIMUM: f64 = 1.0 - 1.0e-9;

/// The mean speed at the phase lag with the highest one.
#[derive(Clone, Copy, Serialize)]
struct BestLag {
    axial_forcing: f64,
    angular_forcing: f64,
    /// Whether it is the followed attractor, or a disk from rest.
    followed: bool,
    /// Impacts in one round of it, if it is periodic.
    period: Option<usize>,
    /// Mean speed/(ωΦ).
    speed: f64,
}

/// At a Γ, after an impact or from rest.
fn best_lag(
    diagram: &Diagram,
    (axial_forcing, state, angular_forcing): (f64, Option<ImpactState>, f64),
) -> Result<BestLag, ExperimentError> {
    let settings = MultiTossSettings { transient_impacts: LAG_TRANSIENT, ..diagram.settings };
    let followed = state.is_some();
    let mut best =
        BestLag { axial_forcing, angular_forcing, followed, period: None, speed: f64::NEG_INFINITY };
    for step in LAGS_DEG {
        let phase_lag_rad = PI * f64::from(step * LAG_STEP_DEG) / 180.0;
        let system = diagram.inputs.system(axial_forcing, Twist { phase_lag_rad, angular_forcing })?;
        let orbit = multi_toss(system, start(&system, state, true)?, settings, &Unobserved)?;
        let speed = orbit.mean_angular_speed.unwrap_or_default() / system.twist_speed();
        if speed > best.speed {
            let period = match orbit.class {
                OrbitClass::Periodic { period, .. } => Some(period),
                _ => None,
            };
            best = BestLag { speed, period, ..best };
        }
    }
    Ok(best)
}

/// Where one impact of the cycle of a disk from rest has most of the impulse: a motor with the lag that is
/// best for this impact turns at ωΦ.
#[derive(Serialize)]
struct OneImpactDecides {
    /// Smallest and largest Γ, and how many were tried.
    axial_forcing_range: (f64, f64),
    tried: usize,
    /// Γ_T of the motors that are simulated there.
    angular_forcing: f64,
    found: Vec<BestLag>,
}

/// The values of Γ beyond `from` at which more than half of the impulse of a disk from rest comes at one
/// phase, and the mean speed of a motor with the lag that is best for this phase.
fn one_impact_decides(
    diagram: &Diagram,
    from: f64,
    quality: Quality,
) -> Result<OneImpactDecides, ExperimentError> {
    let count = quality.choose(300_u32, 2_400);
    let forcing = |index: u32| from + (LARGEST_FORCING - from) * (f64::from(index) + 0.5) / f64::from(count);
    let settings = MultiTossSettings {
        transient_impacts: WEIGHED_IMPACTS,
        examined_impacts: 10 * WEIGHED_IMPACTS,
        ..MultiTossSettings::default()
    };
    let forcings: Vec<f64> = (0..count).map(forcing).collect();
    let found = map_in_parallel(&forcings, |&axial_forcing| {
        let map = map(axial_forcing, diagram.inputs.restitution)?;
        let impulses = NormalImpulses::of(&map, WEIGHED_IMPACTS, 0.0)?;
        let largest = impulses.impacts.iter().max_by(|one, other| one.impulse.total_cmp(&other.impulse));
        let Some(&PhasedImpulse { phase, .. }) = largest else { return Ok(None) };
        // The median of cos(τ + θ) is 1 where most of the impulse comes at the phase −θ.
        if impulses.balance(-phase).steady_speed() < AT_MAXIMUM {
            return Ok(None);
        }
        let twist = Twist { phase_lag_rad: -phase, angular_forcing: LARGE_ANGULAR_FORCING };
        let system = diagram.inputs.system(axial_forcing, twist)?;
        let angular_speed = system.twist_speed();
        let start = InitialCondition::Contact { phase: Phase::new(1.5 * PI)?, angular_speed };
        let orbit = multi_toss(system, start, settings, &Unobserved)?;
        Ok(Some(BestLag {
            axial_forcing,
            angular_forcing: LARGE_ANGULAR_FORCING,
            followed: false,
            period: None,
            speed: orbit.mean_angular_speed.unwrap_or_default() / angular_speed,
        }))
    })?;
    Ok(OneImpactDecides {
        axial_forcing_range: (from, LARGEST_FORCING),
        tried: count as usize,
        angular_forcing: LARGE_ANGULAR_FORCING,
        found: found.into_iter().flatten().collect(),
    })
}

/// The effect of chaos, and of the regime beyond the merging, on the speed.
pub(super) fn speeds(
    fig: &mut Paper<'_>,
    diagram: &Diagram,
    doublings: &[f64],
    crisis: Option<f64>,
) -> Result<(), ExperimentError> {
    let last = doublings.last().copied().unwrap_or(f64::NAN);
    let beyond = diagram.on_attractor().iter().filter(|at| at.axial_forcing > last);
    let chaotic: Vec<Followed> = beyond.copied().collect();
    let orbits: Vec<_> = chaotic.iter().map(|at| (at.map, at.state)).collect();
    let growths = lyapunov_exponents(&orbits, 0, GROWTH_IMPACTS, &Unobserved)?;
    let exponents: Vec<(f64, f64)> =
        chaotic.iter().zip(growths).filter_map(|(at, growth)| Some((at.axial_forcing, growth?))).collect();
    let chaos = Cases::of(exponents.iter().map(|(_, growth)| *growth > 0.0));
    fig.claim(Claim::printed_statement(
        "section4.route_to_chaos",
        chaos,
        format!("beyond the doublings the Lyapunov exponent is positive at {} values of Γ", chaos.words()),
    ));
    fig.record("lyapunov_exponents", &exponents)?;

    // Evenly over the diagram, over chaos, and over the disk from rest beyond the crisis.
    let resting: Vec<f64> = sampled(SAMPLED, &diagram.resting())
        .into_iter()
        .filter(|forcing| crisis.is_some_and(|crisis| *forcing > crisis))
        .collect();
    let chaotic: Vec<_> = chaotic.iter().map(|at| (at.axial_forcing, at.state)).collect();
    let of_followed = [sampled(SAMPLED / 4, &diagram.states()), sampled(SAMPLED / 4, &chaotic)].concat();
    let states = of_followed.into_iter().map(|(forcing, state)| (forcing, Some(state)));
    let states = states.chain(sampled(SAMPLED / 4, &resting).into_iter().map(|forcing| (forcing, None)));
    let angular = [diagram.inputs.semielliptical, diagram.inputs.linear].map(|twist| twist.angular_forcing);
    let cases: Vec<_> =
        states.flat_map(|(forcing, state)| angular.map(|angular| (forcing, state, angular))).collect();
    let best = map_in_parallel(&cases, |case| best_lag(diagram, *case))?;
    let decides = crisis.map(|crisis| one_impact_decides(diagram, crisis, fig.quality)).transpose()?;

    let chosen = |chosen: &dyn Fn(&&BestLag) -> bool| -> Vec<f64> {
        best.iter().filter(chosen).map(|of| of.speed).collect()
    };
    let ones = chosen(&|of| of.followed && of.period == Some(1));
    let chaotic = chosen(&|of| of.followed && of.period.is_none() && of.axial_forcing > last);
    let merged = chosen(&|of| !of.followed);
    let range = |speeds: &[f64]| extent(speeds.iter().copied());
    let words = |speeds: &[f64]| format!("{:.3} to {:.3} ωΦ", range(speeds).0, range(speeds).1);
    let slower = |speeds: &[f64]| all(speeds, |speed| *speed < range(&ones).0).filter(|_| !ones.is_empty());
    fig.claim(Claim::printed_statement(
        "section4.chaos_reduces_speed",
        slower(&chaotic),
        format!(
            "at the best phase lag, in steps of {LAG_STEP_DEG}°, the mean speed is {} in chaos and {} in period 1",
            words(&chaotic),
            words(&ones),
        ),
    ));
    let found: Vec<f64> = decides.iter().flat_map(|decides| &decides.found).map(|of| of.speed).collect();
    let at_maximum = found.iter().filter(|speed| **speed >= AT_MAXIMUM).count();
    fig.claim(Claim::printed_statement(
        "section4.merged_below_maximum",
        slower(&merged).map(|slower| slower && at_maximum == 0),
        format!(
            "from rest {} at the best lag; if one impact carries most of the impulse {:.5} ωΦ or less at Γ_T = {LARGE_ANGULAR_FORCING:e}, nearer as Γ_T grows, but equal to it at {at_maximum} of {} Γ",
            words(&merged),
            range(&found).1,
            decides.as_ref().map_or(0, |decides| decides.tried),
        ),
    ));
    fig.record("best_lags", &best)?;
    fig.record("one_impact_decides", &decides)
}
