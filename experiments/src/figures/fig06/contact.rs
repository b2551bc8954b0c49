//! How far a disk goes, and where it gets its angular momentum.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::{ChatterPolicy, ImpactState, Phase};
use bouncing_disk::parameters::{DimensionlessSystem, ForcingParameters};
use bouncing_disk::toss::{CollisionEvent, Collisions};
use bouncing_disk::{Engine, Event, EventRecord, InitialCondition};
use rayon::prelude::*;

use super::data::{Motion, Transfer};
use super::inputs::{Inputs, Systems};
use crate::claims::paper;
use crate::experiment::ExperimentError;
use crate::figures::motor_case::MotorCase;

/// Impacts of a long motion.
const LONG: usize = 4_000;
/// Restitutions other than the paper's: nearly elastic ones.
const NEARLY_ELASTIC: [f64; 2] = [0.9, 0.99];

/// No impact is faster than this, relative to the platform: between two impacts the disk falls by no more
/// than the platform's 2P, and the platform moves with no more than P. In units of g/ω.
fn speed_bound(peak: f64, restitution: f64) -> f64 {
    let mut speed = 0.0_f64;
    // A contraction by the restitution.
    for _ in 0..10_000 {
        let launched = restitution * speed + peak;
        speed = (launched * launched + 4.0 * peak).sqrt() + peak;
    }
    speed
}

fn motion(axial_forcing: f64, system: &DimensionlessSystem) -> Result<Motion, ExperimentError> {
    let peak = system.peak_acceleration();
    let phase = Phase::new(1.5 * PI)?;
    let start = InitialCondition::Contact { phase, angular_speed: system.platform_angular_speed(phase) };
    let mut collisions = Collisions::new(*system, start, ChatterPolicy::Complete)?;
    let (mut impacts, mut highest) = (0, peak);
    let (mut first, mut half, mut last) = (None, 0.0, None);
    while impacts < LONG {
        let Some(event) = collisions.advance()? else { break };
        let CollisionEvent::Collision(collision) = event else { continue };
        impacts += 1;
        let phase = collision.state.phase;
        let launched = -system.restitution() * collision.state.axial_impact_velocity + peak * phase.cos();
        let rise = if launched > 0.0 { 0.5 * launched * launched } else { 0.0 };
        highest = highest.max(peak * phase.sin() + rise);
        if first.is_none() {
            first = Some(collision);
        }
        if impacts <= LONG / 2 {
            half = collision.angle;
        }
        last = Some(collision);
    }
    let (Some(first), Some(last)) = (first, last) else {
        return Err(super::inputs::no_orbit(axial_forcing));
    };
    let span = last.time.since(&first.time).radians();
    let launched = system.restitution() * speed_bound(peak, system.restitution()) + peak;
    Ok(Motion {
        axial_forcing,
        restitution: system.restitution(),
        impacts,
        platform_periods: span / TAU,
        highest: highest / peak,
        height_bound: (peak + 0.5 * launched * launched) / peak,
        turned_in_first_half: (half - first.angle) / system.twist_speed(),
        turned_in_second_half: (last.angle - half) / system.twist_speed(),
    })
}

/// Motions from rest at the Γ of Fig. 7, at the paper's restitution and nearly elastic.
pub(super) fn motions(forcings: &[f64], inputs: Inputs) -> Result<Vec<Motion>, ExperimentError> {
    let restitutions = [inputs.restitution, NEARLY_ELASTIC[0], NEARLY_ELASTIC[1]];
    let cases: Vec<(f64, f64)> =
        forcings.iter().flat_map(|forcing| restitutions.map(|restitution| (*forcing, restitution))).collect();
    cases
        .into_par_iter()
        .map(|(axial_forcing, restitution)| {
            let system = ForcingParameters {
                axial_forcing,
                angular_forcing: inputs.semielliptical.angular_forcing,
                phase_lag: inputs.semielliptical.phase_lag_rad,
                restitution,
            };
            motion(axial_forcing, &system.build()?)
        })
        .collect()
}

/// Impacts over which the angular impulses are added up, from a disk that does not turn: once it turns in
/// step with the platform, nothing is transferred in period 1.
const TRANSFERS: usize = 600;
/// Parts into which a segment on the platform is divided: the impulse of friction may change its sign within
/// a segment.
const PARTS: usize = 16;

/// The share of the angular impulses, by size, that impacts transfer; `None` where there are none.
fn share_in_impacts(
    system: &DimensionlessSystem,
    start: InitialCondition,
) -> Result<Option<f64>, ExperimentError> {
    let mut engine = Engine::new(*system, start, bouncing_disk::motion::PAPER_CHATTER)?;
    let (mut impacts, mut impulsive, mut contact) = (0, 0.0, 0.0);
    while impacts < TRANSFERS {
        let Some(record) = engine.advance()? else { break };
        impacts += usize::from(matches!(record.event, Event::Impact { .. }));
        impulsive += record.angular_impulse.abs();
        contact += turned_in_contact(&record, system);
    }
    let all = impulsive + contact;
    Ok((all > 0.0).then(|| impulsive / all))
}

/// The sum of the sizes of the changes of angular speed on the platform; zero in flight.
fn turned_in_contact(record: &EventRecord, system: &DimensionlessSystem) -> f64 {
    let speed = |part: usize| record.evaluate(system, part as f64 / PARTS as f64).disk.angular_speed;
    if record.segment.state.mode == bouncing_disk::motion::Mode::Flight {
        return 0.0;
    }
    (0..PARTS).map(|part| (speed(part + 1) - speed(part)).abs()).sum()
}

/// The share of the motor of Table III, from rest.
pub(super) fn motor_transfer() -> Result<Option<f64>, ExperimentError> {
    let motor = MotorCase::default_of(&paper::table_three()?, &paper::section_five()?).system()?;
    let phase = Phase::new(1.5 * PI)?;
    share_in_impacts(motor.dimensionless(), InitialCondition::Contact { phase, angular_speed: 0.0 })
}

/// The transfers of both rotary motions, for the followed attractor from its states and for a disk from rest.
pub(super) fn transfers(
    followed: &[(f64, ImpactState)],
    from_rest: &[f64],
    inputs: Inputs,
) -> Result<Vec<Transfer>, ExperimentError> {
    let phase = Phase::new(1.5 * PI)?;
    let starts: Vec<(f64, Option<ImpactState>)> = followed
        .iter()
        .map(|(forcing, state)| (*forcing, Some(*state)))
        .chain(from_rest.iter().map(|forcing| (*forcing, None)))
        .collect();
    let pairs: Vec<[Option<Transfer>; 2]> = starts
        .into_par_iter()
        .map(|(axial_forcing, state)| {
            let systems = Systems::at(axial_forcing, inputs)?;
            let transfer =
                |system: &DimensionlessSystem, angular_forcing: f64| -> Result<_, ExperimentError> {
                    let start = match state {
                        Some(state) => InitialCondition::Launch {
                            phase: state.phase(),
                            relative_speed: -system.restitution() * state.velocity(),
                            angular_speed: 0.0,
                        },
                        None => InitialCondition::Contact { phase, angular_speed: 0.0 },
                    };
                    let share_in_impacts = share_in_impacts(system, start)?;
                    Ok(share_in_impacts.map(|share_in_impacts| Transfer {
                        axial_forcing,
                        angular_forcing,
                        from_rest: state.is_none(),
                        share_in_impacts,
                    }))
                };
            Ok([
                transfer(&systems.linear, inputs.linear.angular_forcing)?,
                transfer(&systems.semielliptical, inputs.semielliptical.angular_forcing)?,
            ])
        })
        .collect::<Result<_, ExperimentError>>()?;
    Ok(pairs.into_iter().flatten().flatten().collect())
}
