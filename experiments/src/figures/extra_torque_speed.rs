//! Beyond the paper: speed and mechanical power of its motor against the load.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::TransientSettings;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::ExtraTorqueSpeedData;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::stall;
use crate::progress::Progress;
use crate::table::{Cell, Table};

/// Speed and power against load.
#[derive(Debug)]
pub struct ExtraTorqueSpeed;

impl Experiment for ExtraTorqueSpeed {
    type Data = ExtraTorqueSpeedData;
    const ID: &'static str = "extra-torque-speed";
    const TITLE: &'static str = "Speed and power of the motor against its load";
    const DISCUSSION: &'static str = include_str!("extra_torque_speed/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![
            ("ensembles under load", bouncing_disk::OperatingSettings::default().seed),
            ("transients", TransientSettings::default().seed),
            ("runs to stall", stall::SEED),
        ]
    }

    fn caption(data: &ExtraTorqueSpeedData) -> String {
        let settings = &data.settings;
        let bracket = data.stall.bracket_n_m.map(|torque| 1e6 * torque);
        format!(
            "The motor of Table III at 70 kHz under a load: (a) mean speed, (b) mechanical power. Dots: means over {} perturbed \
             members, whose perturbations all loads share; grey bands: 95 % intervals, of a standard error of at most {} % of the \
             speed without load. Square: the load that stops the motor, bracketed between {:.2} and {:.2} µN m (blue band). \
             Diamond: the paper's estimate from the run-up without load, the moment of inertia times α̇_ss/t_c, with the 95 % \
             interval of {} transients. Beyond μ m g a_e = {:.2} µN m (grey) friction cannot hold the load and there is no steady \
             speed. Dashed: the power if the speed fell along a straight line from no load to stall. Circle: the highest power. The \
             mass, {:.1} g, is that of the steel ball of 20 mm; it scales torques and powers and leaves speeds alone.",
            settings.members,
            100.0 * settings.relative_error,
            bracket[0],
            bracket[1],
            data.transient.members,
            1e6 * data.largest_torque_n_m,
            1e3 * data.motor.mass(),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<ExtraTorqueSpeedData, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &ExtraTorqueSpeedData) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &ExtraTorqueSpeedData) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &ExtraTorqueSpeedData) -> Vec<(String, String)> {
        crate::figures::operating_curve::parameters(&data.motor, &data.settings)
    }

    fn table(data: &ExtraTorqueSpeedData) -> Option<Table> {
        let mut table = Table::new([
            "load torque (N m)",
            "speed (rad/s)",
            "its standard error (rad/s)",
            "mechanical power (W)",
            "its standard error (W)",
            "power put in (W)",
            "efficiency",
        ]);
        for point in &data.curve.points {
            table.push([
                Cell::from(point.load_torque),
                point.speed.value.into(),
                point.speed.standard_error.into(),
                point.mechanical_power.value.into(),
                point.mechanical_power.standard_error.into(),
                point.input_power.value.into(),
                point.efficiency.map(|efficiency| efficiency.value).into(),
            ]);
        }
        Some(table)
    }
}
