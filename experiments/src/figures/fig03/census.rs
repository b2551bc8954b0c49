//! The transitions that the engine makes in many motions.

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::Transition;
use bouncing_disk::parameters::{DimensionlessParameters, DimensionlessSystem};
use bouncing_disk::{Engine, Event, InitialCondition};
use serde::Serialize;

use crate::experiment::{ExperimentError, Quality};
use crate::progress::Progress;

/// From a platform that never throws the disk, through period 1, chattering and chaos, to a motor.
const PEAK_ACCELERATIONS: [f64; 9] = [0.0, 0.6, 1.0, 1.1, 1.26, 1.55, 1.75, 4.9, 20.0];
const TWIST_SPEEDS: [f64; 4] = [0.0, 0.2, 1.0, 6.0];
const PHASE_LAGS: [f64; 3] = [-0.26 * PI, 0.0, FRAC_PI_2];
const FRICTIONS: [f64; 3] = [0.0, 0.1, 0.6];
const RESTITUTIONS: [f64; 3] = [0.0, 0.5, 0.8];
const LOADS: [f64; 2] = [0.0, 0.05];

/// The transitions of many motions.
#[derive(Debug, Serialize)]
pub(super) struct Census {
    pub(super) peak_accelerations: Vec<f64>,
    pub(super) twist_speeds: Vec<f64>,
    pub(super) phase_lags_rad: Vec<f64>,
    pub(super) frictions: Vec<f64>,
    pub(super) restitutions: Vec<f64>,
    pub(super) loads: Vec<f64>,
    pub(super) longest_motion: usize,
    pub(super) motions: u64,
    pub(super) events: u64,
    /// Impacts of a disk that slides, and those of them whose impulse is the possible one, so that the slip
    /// ends.
    pub(super) sliding_impacts: u64,
    pub(super) capped_impacts: u64,
    /// The transitions that occurred, in the order of the modes and events.
    pub(super) transitions: BTreeSet<Transition>,
}

impl Census {
    pub(super) fn new(quality: Quality, progress: &dyn Progress) -> Result<Self, ExperimentError> {
        let mut census = Self {
            peak_accelerations: PEAK_ACCELERATIONS.to_vec(),
            twist_speeds: TWIST_SPEEDS.to_vec(),
            phase_lags_rad: PHASE_LAGS.to_vec(),
            frictions: FRICTIONS.to_vec(),
            restitutions: RESTITUTIONS.to_vec(),
            loads: LOADS.to_vec(),
            longest_motion: quality.choose(60, 400),
            motions: 0,
            events: 0,
            sliding_impacts: 0,
            capped_impacts: 0,
            transitions: BTreeSet::new(),
        };
        let systems = systems()?;
        progress.start(systems.len() as u64, "systems");
        for system in &systems {
            census.count(system)?;
            progress.advance(1);
        }
        Ok(census)
    }

    /// The motions of a disk at rest on the platform and of one that falls onto it.
    fn count(&mut self, system: &DimensionlessSystem) -> Result<(), ExperimentError> {
        let resting = InitialCondition::Contact { phase: Phase::new(1.5 * PI)?, angular_speed: 0.0 };
        let falling = InitialCondition::Flight {
            phase: Phase::new(1.0)?,
            gap: 1.0 + system.peak_acceleration(),
            relative_velocity: 0.0,
            angular_speed: 0.3,
        };
        for start in [resting, falling] {
            self.motions += 1;
            for record in Engine::new(*system, start, ChatterPolicy::Complete)?.take(self.longest_motion) {
                let record = record?;
                self.events += 1;
                if let Event::Impact { tangential_impact_velocity, capped, .. } = record.event
                    && tangential_impact_velocity != 0.0
                {
                    self.sliding_impacts += 1;
                    self.capped_impacts += u64::from(capped);
                }
                self.transitions.insert(record.transition());
            }
        }
        Ok(())
    }
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
