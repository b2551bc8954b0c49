//! Fig. 10(a)-(c): transient speed curves of the motor and their fits, for both readings of Table III.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::TransientSettings;

use self::compute::MEMBER_INTERVALS;
pub(crate) use self::data::Fig10Data;
use crate::experiment::{ExperimentError, Paper, named};
use crate::figures::shared::motor::MotorCase;

/// Fig. 10.
pub(crate) fn fig10(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("motors that print alike", compute::SEED);
    fig.seed("ensembles", TransientSettings::default().seed);
    let data = &compute::compute(fig.quality, fig.progress)?;
    fig.caption(caption(data));
    fig.parameters(parameters(data));
    fig.claims(claims::claims(data));
    fig.draw(draw::draw(data));
    fig.data(data)
}

fn caption(data: &Fig10Data) -> String {
    let exception = &data.exception;
    let [gravity, printed] =
        [0, 1].map(|row| data.readings.get(row).map_or(f64::NAN, |row| row.preload_acceleration_m_per_s2));
    format!(
        "Transient speed curves of the motor of Table III from rest, each fitted with α̇_ss(1 − e^(−t/t_c)), for \
         A = 10⁻⁹, 10⁻⁸ and 10⁻⁷ m. (a)–(c) preload acceleration {gravity} m/s² (standard gravity; the 70 of Table III read as \
         ω/2π in kHz); (a′)–(c′) the same with g = {printed} m/s² as printed. Grey line: one member (speeds averaged over \
         1/{MEMBER_INTERVALS} of the time shown); black dashed line: its fit, whose numbers stand in the panel; blue band: mean ± one \
         standard deviation of {} members, which differ in the starting phase and in the seed of a relaunch perturbation below {} g/ω: {}. \
         Gray band in (a)–(c): 5 to 95 % of {} single orbits that nothing perturbs and whose inputs print alike ({}). \
         Dotted in (a): the same motor at exactly g = {} m/s², where Aω²/g is 2π² and a low-period cycle exists in a range of g \
         of {:.1e} m/s² only. The paper's panels (d)–(f) are measured curves, which are not in its text.",
        data.members,
        data.relaunch_perturbation,
        ensembles(data),
        data.alike.motors[0].len(),
        data.alike.inputs,
        exception.preload_acceleration_m_per_s2,
        exception.highest_preload_acceleration_m_per_s2 - exception.lowest_preload_acceleration_m_per_s2,
    )
}

fn parameters(data: &Fig10Data) -> Vec<(String, String)> {
    let motor = &data.motor;
    let own = [
        ("a_e", format!("{} m", motor.contact_radius_m)),
        ("a_g", format!("{} m", motor.gyration_radius_m)),
        ("ω/2π", format!("{} Hz", motor.frequency_hz)),
        ("members", data.members.to_string()),
        ("relaunch perturbation", format!("{} g/ω", data.relaunch_perturbation)),
        ("inputs that print alike", data.alike.inputs.clone()),
    ];
    let panels = data.readings.first().map_or(&[][..], |reading| &reading.panels);
    let motors = panels.iter().map(|panel| MotorCase { amplitude_m: panel.amplitude_m, ..*motor });
    [motor.shared_inputs(), named(own), vec![MotorCase::contact_row(motors)]].concat()
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
