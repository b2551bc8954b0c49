//! Which transitions occur, and how often, over a range of systems and starts.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::{DimensionlessParameters, DimensionlessSystem, Engine, InitialCondition, Transition};

use super::data::{Census, Counted};
use crate::experiment::{ExperimentError, Quality};
use crate::progress::Progress;

/// From a platform that never throws the disk, through period 1, chattering and chaos, to a motor.
const PEAK_ACCELERATIONS: [f64; 9] = [0.0, 0.6, 1.0, 1.1, 1.26, 1.55, 1.75, 4.9, 20.0];
const TWIST_SPEEDS: [f64; 4] = [0.0, 0.2, 1.0, 6.0];
const PHASE_LAGS: [f64; 3] = [-0.26 * PI, 0.0, FRAC_PI_2];
const FRICTIONS: [f64; 3] = [0.0, 0.1, 0.6];
const RESTITUTIONS: [f64; 3] = [0.0, 0.5, 0.8];
const LOADS: [f64; 2] = [0.0, 0.05];

fn starts(system: &DimensionlessSystem) -> Result<[InitialCondition; 2], ExperimentError> {
    let height = 1.0 + system.peak_acceleration();
    Ok([
        InitialCondition::Contact { phase: Phase::new(1.5 * PI)?, angular_speed: 0.0 },
        InitialCondition::Flight {
            phase: Phase::new(1.0)?,
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
                            systems.push(parameters.build()?);
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
    let (mut motions, mut events) = (0, 0);
    for system in &systems {
        for start in starts(system)? {
            motions += 1;
            for record in Engine::new(*system, start, ChatterPolicy::Complete)?.take(longest_motion) {
                events += 1;
                *counts.entry(record?.transition()).or_default() += 1;
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
        transitions,
    })
}
