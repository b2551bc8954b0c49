//! Fig. 10(a)-(c): transient speed curves of the motor and their fits, for both readings of Table III.

mod claims;
mod compute;
mod data;
mod draw;
mod measured;

use bouncing_disk::TransientSettings;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

use self::compute::MEMBER_INTERVALS;
pub use self::data::Fig10Data;
use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::motor_case::MotorCase;
use crate::measured::{Layout, Series};
use crate::progress::Progress;

/// Fig. 10.
#[derive(Debug)]
pub struct Fig10;

impl Experiment for Fig10 {
    type Data = Fig10Data;

    const ID: &'static str = "fig10";

    const TITLE: &'static str = "Transient speed curves of the ultrasonic motor";
    const DISCUSSION: &str = include_str!("fig10/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("motors that print alike", compute::SEED), ("ensembles", TransientSettings::default().seed)]
    }

    const MEASUREMENTS: &'static [Layout] = &[measured::LAYOUT];

    fn caption(data: &Fig10Data) -> String {
        let exception = &data.exception;
        let [gravity, printed] = [0, 1]
            .map(|row| data.readings.get(row).map_or(f64::NAN, |row| row.preload_acceleration_m_per_s2));
        format!(
            "Transient speed curves of the motor of Table III from rest, each fitted with α̇_ss(1 − e^(−t/t_c)), for \
             A = 10⁻⁹, 10⁻⁸ and 10⁻⁷ m. (a)–(c) preload acceleration {gravity} m/s² (standard gravity; the 70 of Table III read as \
             ω/2π in kHz); (a′)–(c′) the same with g = {printed} m/s² as printed. Grey line: one member (speeds averaged over \
             1/{MEMBER_INTERVALS} of the time shown); black dashed line: its fit, whose numbers stand in the panel; blue band: mean ± one \
             standard deviation of {} members, which differ in the starting phase and in the seed of a relaunch perturbation below {} g/ω: {}. \
             Dotted in (a): the same motor at exactly g = {} m/s², where Aω²/g is 2π² and a low-period cycle exists in a range of g \
             of {:.1e} m/s² only. The paper's panels (d)–(f) are measured curves, which are not in its text.{}",
            data.members,
            data.relaunch_perturbation,
            ensembles(data),
            exception.preload_acceleration_m_per_s2,
            exception.highest_preload_acceleration_m_per_s2 - exception.lowest_preload_acceleration_m_per_s2,
            measured::caption(&data.measured),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig10Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn overlay(data: &mut Fig10Data, series: &Series) -> Result<(), ExperimentError> {
        data.measured = measured::trials(series)?;
        Ok(())
    }

    fn draw(data: &Fig10Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig10Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Fig10Data) -> Vec<(String, String)> {
        let table = &data.table_iii;
        let value = |name: &str, value: f64, unit: &str| {
            (name.to_owned(), format!("{value} {unit}").trim().to_owned())
        };
        let own = [
            value("a_e", table.contact_radius_mm, "mm"),
            value("a_g", table.gyration_radius_mm, "mm"),
            value("ω/2π", data.section.default_frequency_hz, "Hz"),
            value("members", data.members as f64, ""),
            value("relaunch perturbation", data.relaunch_perturbation, "g/ω"),
            ("inputs that print alike".to_owned(), data.alike.inputs.clone()),
        ];
        let motor = MotorCase::default_of(table, &data.section);
        motor.shared_inputs().into_iter().chain(own).collect()
    }
}

/// The statistics of the panels, in words.
fn ensembles(data: &Fig10Data) -> String {
    let panels = data.readings.iter().flat_map(|reading| &reading.panels);
    let words = panels.map(|panel| {
        let (speed, constant) = (panel.steady_speed_rad_per_s, panel.time_constant_s);
        format!(
            "{:.2} ± {:.2} rad/s, {:.4} ± {:.4} s",
            speed.mean, speed.deviation, constant.mean, constant.deviation
        )
    });
    words.collect::<Vec<_>>().join("; ")
}
