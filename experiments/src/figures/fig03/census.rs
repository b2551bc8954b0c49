//! Which transitions occur, and how often, over a range of systems and starts.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::{
    DimensionlessParameters, DimensionlessSystem, Engine, Error, EventKind, EventRecord, InitialCondition,
    Transition,
};

use super::data::{Attachments, Census, Counted, Laws};
use crate::experiment::{ExperimentError, Quality};
use crate::progress::Progress;

/// From a platform that never throws the disk, through period 1, chattering and chaos, to a motor.
const PEAK_ACCELERATIONS: [f64; 9] = [0.0, 0.6, 1.0, 1.1, 1.26, 1.55, 1.75, 4.9, 20.0];
const TWIST_SPEEDS: [f64; 4] = [0.0, 0.2, 1.0, 6.0];
const PHASE_LAGS: [f64; 3] = [-0.26 * PI, 0.0, FRAC_PI_2];
const FRICTIONS: [f64; 3] = [0.0, 0.1, 0.6];
const RESTITUTIONS: [f64; 3] = [0.0, 0.5, 0.8];
const LOADS: [f64; 2] = [0.0, 0.05];

impl Attachments {
    fn count(&mut self, impact: &EventRecord, next: &EventRecord, system: &DimensionlessSystem) {
        let pressed = 1.0 - system.peak_acceleration() * impact.time.phase.sin() > 0.0;
        let attached = next.event.kind() == EventKind::Attachment && next.span.radians() <= 0.0;
        *match (pressed, attached) {
            (true, true) => &mut self.pressed_attached,
            (true, false) => &mut self.pressed_launched,
            (false, true) => &mut self.unpressed_attached,
            (false, false) => &mut self.unpressed_launched,
        } += 1;
    }
}

fn starts(system: &DimensionlessSystem) -> Result<[InitialCondition; 2], ExperimentError> {
    let phase = |angle| Phase::new(angle).map_err(|error| ExperimentError::model(Error::from(error)));
    let height = 1.0 + system.peak_acceleration();
    Ok([
        InitialCondition::Contact { phase: phase(1.5 * PI)?, angular_speed: 0.0 },
        InitialCondition::Flight {
            phase: phase(1.0)?,
            gap: height,
            relative_velocity: 0.0,
            angular_speed: 0.3,
        },
    ])
}

fn systems() -> Result<Vec<DimensionlessSystem>, ExperimentError> {
    let mut systems = Vec::new();
    for peak_acceleration in PEAK_ACCELERATIONS {
        for twist_speed in TWIST_SPEEDS {
            for phase_lag in PHASE_LAGS {
                for friction in FRICTIONS {
                    for restitution in RESTITUTIONS {
                        for load in LOADS {
                            let parameters = DimensionlessParameters {
                                peak_acceleration,
                                twist_speed,
                                phase_lag,
                                friction,
                                restitution,
                                load,
                            };
                            systems.push(parameters.build().map_err(ExperimentError::model)?);
                        }
                    }
                }
            }
        }
    }
    Ok(systems)
}

pub(super) fn census(quality: Quality, progress: &dyn Progress) -> Result<Census, ExperimentError> {
    let longest_motion = quality.choose(60, 400);
    let systems = systems()?;
    progress.start(systems.len() as u64, "systems");
    let mut counts: BTreeMap<Transition, u64> = BTreeMap::new();
    let (mut motions, mut events, mut failures) = (0, 0, 0);
    let mut laws = Laws::default();
    let mut attachments = Attachments::default();
    for system in &systems {
        for start in starts(system)? {
            motions += 1;
            let engine =
                Engine::new(*system, start, ChatterPolicy::Complete).map_err(ExperimentError::model)?;
            // The impact before, if it gave no rebound.
            let mut landed: Option<EventRecord> = None;
            for record in engine.take(longest_motion) {
                let Ok(record) = record else {
                    failures += 1;
                    break;
                };
                events += 1;
                *counts.entry(record.transition()).or_default() += 1;
                laws.check(system, &record);
                if let Some(impact) = landed {
                    attachments.count(&impact, &record, system);
                }
                let without_rebound = record.event.kind() == EventKind::Impact && system.restitution() <= 0.0;
                landed = without_rebound.then_some(record);
            }
        }
        progress.advance(1);
    }
    let transitions = counts.into_iter().map(|(transition, number)| Counted { transition, number }).collect();
    Ok(Census {
        peak_accelerations: PEAK_ACCELERATIONS.to_vec(),
        twist_speeds: TWIST_SPEEDS.to_vec(),
        phase_lags_rad: PHASE_LAGS.to_vec(),
        frictions: FRICTIONS.to_vec(),
        restitutions: RESTITUTIONS.to_vec(),
        loads: LOADS.to_vec(),
        longest_motion,
        motions,
        events,
        failures,
        transitions,
        attachments,
        laws,
    })
}
