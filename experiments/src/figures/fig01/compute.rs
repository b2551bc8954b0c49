//! The computation of Fig. 1.

use std::f64::consts::{FRAC_PI_4, SQRT_2};

use bouncing_disk::{Event, InitialSpin, toss_trajectory};

use super::data::Fig01Data;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::hand_path::HandPath;
use crate::figures::toss_case::TossCase;
use crate::claims::paper;
use crate::progress::Progress;

/// Phase lag of the motion shown. Table I has 0, for which the path of a point is a mere arc.
const PHASE_LAG: f64 = -FRAC_PI_4;

/// The instant shown, as a share of the flight.
pub(super) const SHARE_OF_FLIGHT: f64 = 0.18;

pub(super) fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig01Data, ExperimentError> {
    progress.start(1, "toss");
    let table_i = paper::table_one()?;
    let case = TossCase::from(&table_i).at_lag(PHASE_LAG);
    let system = case.system()?;
    let scales = system.scales();
    let trajectory = toss_trajectory(&system, InitialSpin::AbsoluteRest)?;
    let flight = trajectory.records().iter().find(|record| matches!(record.event, Event::Impact { .. }));
    let Some(flight) = flight else {
        let peak_acceleration = system.peak_acceleration();
        return Err(ExperimentError::model(bouncing_disk::Error::NeverLeaves { peak_acceleration }));
    };
    let instant = flight.evaluate(system.dimensionless(), SHARE_OF_FLIGHT);
    let disk = scales.state(&instant.disk);
    let platform = system.platform();
    let path = HandPath::new(platform, quality.choose(120, 720))?;
    progress.advance(1);
    Ok(Fig01Data {
        phase_lag_rad: PHASE_LAG,
        contact_radius_m: case.contact_radius_m,
        disk_radius_m: SQRT_2 * case.gyration_radius_m,
        amplitude_m: platform.amplitude(),
        twist_amplitude_rad: platform.twist_amplitude(),
        phase_rad: instant.time.phase.angle(),
        platform_height_m: platform.height(instant.time.phase),
        platform_angle_rad: platform.angle(instant.time.phase),
        disk_height_m: disk.height,
        disk_angle_rad: disk.angle,
        path,
        table_i,
    })
}
