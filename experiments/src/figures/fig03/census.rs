//! The data of the picture: the transitions that the engine makes, and one cycle of a disk that is thrown,
//! chatters and rests.

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::{EventKind, PhaseTime, Transition};
use bouncing_disk::parameters::{DimensionlessParameters, DimensionlessSystem, ForcingParameters};
use bouncing_disk::toss::TOSS_START;
use bouncing_disk::{Engine, Event, EventRecord, InitialCondition, Trajectory};
use serde::Serialize;

use crate::experiment::{ExperimentError, Quality};
use crate::progress::Progress;

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
    /// Those that occurred, in the order of the modes and events.
    pub(super) transitions: BTreeSet<Transition>,
}

/// From one separation to the next; time in periods from the first collision between them, heights in
/// amplitudes of the platform.
#[derive(Debug, Serialize)]
pub(super) struct ChatteringCycle {
    pub(super) axial_forcing: f64,
    pub(super) restitution: f64,
    pub(super) time_cycles: Vec<f64>,
    pub(super) disk_height: Vec<f64>,
    pub(super) platform_height: Vec<f64>,
    /// The height of the first impact, which is at time 0.
    pub(super) collision_height: f64,
    pub(super) attachment_cycles: f64,
    pub(super) attachment_height: f64,
    pub(super) separation_cycles: f64,
    pub(super) separation_height: f64,
    /// Impacts before those that the attachment sums.
    pub(super) impacts: usize,
}

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
    let mut transitions = BTreeSet::new();
    let (mut motions, mut events, mut sliding_impacts, mut capped_impacts) = (0, 0, 0, 0);
    for system in &systems {
        for start in starts(system)? {
            motions += 1;
            for record in Engine::new(*system, start, ChatterPolicy::Complete)?.take(longest_motion) {
                events += 1;
                let record = record?;
                if let Event::Impact { tangential_impact_velocity, capped, .. } = record.event
                    && tangential_impact_velocity != 0.0
                {
                    sliding_impacts += 1;
                    capped_impacts += u64::from(capped);
                }
                transitions.insert(record.transition());
            }
        }
        progress.advance(1);
    }
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
        sliding_impacts,
        capped_impacts,
        transitions,
    })
}

/// A chattering orbit of the single-toss kind (Sec. IV A).
const AXIAL_FORCING: f64 = 0.45;

pub(super) fn cycle(quality: Quality) -> Result<ChatteringCycle, ExperimentError> {
    let restitution = crate::claims::paper::value("section4.restitution")?;
    // The vertical motion does not depend on the rotary one.
    let system =
        ForcingParameters { axial_forcing: AXIAL_FORCING, angular_forcing: 1.0, phase_lag: 0.0, restitution };
    let system = system.build()?;
    let start = InitialCondition::Contact { phase: Phase::new(TOSS_START)?, angular_speed: 0.0 };
    let mut engine = Engine::new(system, start, ChatterPolicy::Complete)?;
    let separation = |record: &EventRecord| record.event.kind() == EventKind::Separation;
    Trajectory::record(&mut engine, separation)?;
    let trajectory = Trajectory::record(&mut engine, separation)?;

    let amplitude = system.peak_acceleration();
    let from_start = |time: PhaseTime| time.since(&trajectory.start()).radians() / TAU;
    let first = trajectory.records().iter().find(|record| record.event.kind() == EventKind::Impact);
    let collision = first.map_or(0.0, |record| from_start(record.time));
    let since = |time: PhaseTime| from_start(time) - collision;
    let mut cycle = ChatteringCycle {
        axial_forcing: AXIAL_FORCING,
        restitution,
        time_cycles: Vec::new(),
        disk_height: Vec::new(),
        platform_height: Vec::new(),
        collision_height: 0.0,
        attachment_cycles: 0.0,
        attachment_height: 0.0,
        separation_cycles: 0.0,
        separation_height: 0.0,
        impacts: 0,
    };
    let samples = quality.choose(60, 240);
    for record in trajectory.records() {
        for step in 0..samples {
            let snapshot = record.evaluate(&system, f64::from(step) / f64::from(samples));
            cycle.time_cycles.push(since(snapshot.time));
            cycle.disk_height.push(snapshot.disk.height / amplitude);
            cycle.platform_height.push(snapshot.platform.height / amplitude);
        }
        let (time, height) = (since(record.time), record.after.height / amplitude);
        match record.event.kind() {
            EventKind::Impact => {
                if cycle.impacts == 0 {
                    cycle.collision_height = height;
                }
                cycle.impacts += 1;
            }
            EventKind::Attachment => (cycle.attachment_cycles, cycle.attachment_height) = (time, height),
            EventKind::Separation => (cycle.separation_cycles, cycle.separation_height) = (time, height),
            _ => {}
        }
    }
    cycle.time_cycles.push(cycle.separation_cycles);
    cycle.disk_height.push(cycle.separation_height);
    cycle.platform_height.push(cycle.separation_height);
    Ok(cycle)
}
