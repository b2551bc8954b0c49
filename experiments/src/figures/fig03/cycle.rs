//! One cycle of a disk that is thrown, chatters and rests.

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::{EventKind, PhaseTime};
use bouncing_disk::parameters::ForcingParameters;
use bouncing_disk::toss::TOSS_START;
use bouncing_disk::{Engine, EventRecord, InitialCondition, Trajectory};
use serde::Serialize;

use crate::claims::paper;
use crate::experiment::{ExperimentError, Quality};

/// A chattering orbit of the single-toss kind (Sec. IV A).
const AXIAL_FORCING: f64 = 0.45;

/// From one separation to the next; time in periods from the first collision between them, heights in
/// amplitudes of the platform.
#[derive(Debug, Default, Serialize)]
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

impl ChatteringCycle {
    pub(super) fn new(quality: Quality) -> Result<Self, ExperimentError> {
        let restitution = paper::value("section4.restitution")?;
        // The vertical motion does not depend on the rotary one.
        let forcing = ForcingParameters {
            axial_forcing: AXIAL_FORCING,
            angular_forcing: 1.0,
            phase_lag: 0.0,
            restitution,
        };
        let system = forcing.build()?;
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
        let mut cycle = Self { axial_forcing: AXIAL_FORCING, restitution, ..Self::default() };
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
}
