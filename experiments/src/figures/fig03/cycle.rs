//! The inset: one cycle of a disk that is thrown, chatters and rests.

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::{EventKind, PhaseTime};
use bouncing_disk::parameters::ForcingParameters;
use bouncing_disk::toss::TOSS_START;
use bouncing_disk::{Engine, EventRecord, InitialCondition, Trajectory};

use super::ChatteringCycle;
use crate::experiment::{ExperimentError, Quality};

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
    let from_start = |time: PhaseTime| time.since(&trajectory.start()).radians() / std::f64::consts::TAU;
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
