//! Fig. 11: steady-state speed and stall torque of the motor against preload.

mod claims;
mod compute;
mod data;
mod draw;
mod trends;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::{OperatingSettings, TransientSettings};

pub(crate) use self::data::Fig11Data;
use crate::experiment::{ExperimentError, Paper, named};
use crate::figures::shared::motor::MotorCase;

/// Fig. 11.
pub(crate) fn fig11(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("preloads", compute::PRELOAD_SEED);
    fig.seed("ensembles", TransientSettings::default().seed);
    fig.seed("bouncing motors that print alike", compute::BOUNCING_SEED);
    fig.seed("runs to stall", OperatingSettings::default().seed);
    let data = &compute::compute(fig.quality, fig.progress)?;
    fig.caption(caption(data));
    fig.parameters(parameters(data));
    fig.claims(claims::claims(data));
    fig.draw(draw::draw(data));
    fig.data(data)
}

fn caption(data: &Fig11Data) -> String {
    let [first, last] = data.printed.preload_accelerations_m_per_s2;
    let [from, to] = data.trend_mn();
    let count = data.curves.first().map_or(0, |curve| curve.points.len());
    format!(
        "Effect of preload on steady-state speed and stall torque: (a), (b) ω/2π = {} kHz, where the paper's motor turns clockwise; (c), (d) {} kHz, where it turns \
         anticlockwise: speeds count as positive in that sense, for its phase lag there is not printed. A = 10⁻⁹ (solid), 10⁻⁸ (dashed) and 10⁻⁷ m (dotted), each over all g = \
         {first} to {last} m/s², since which g goes with which A is not printed; preload is m g with the weight of the \
         20 mm steel ball. Dots, joined to guide the eye: means of {}, {} and {} members at the three amplitudes over {} rise times, which differ \
         in the starting phase and in the seed of a relaunch perturbation below {} g/ω. The preloads are drawn at random, one in each of {count} \
         equal parts of the range for each curve (seed {}). Bars, at a few dots of each curve: standard deviation of the members. \
         Open circles: {} motors on a low-period chattering cycle, {} of them of a single flight (see the claims). Squares in (b) and (d): the load torque that \
         really stalls the motor at A = 10⁻⁸ m and the lowest, the middle and the highest preload of the trends, where the dots are the paper's estimate of it. Blue band: 5 to 95 % of the single orbits that nothing perturbs, of all three amplitudes together, by fourteenths of the range of g. Grey: {from} \
         to {to} mN. The paper's measurements (crosses) are not in its text.",
        data.motor.frequency_hz / 1e3,
        data.printed.frequencies_hz[1] / 1e3,
        data.members[0],
        data.members[1],
        data.members[2],
        data.rises,
        data.relaunch_perturbation,
        data.preload_seed,
        data.holes.low_period,
        data.holes.one_flight,
    )
}

fn parameters(data: &Fig11Data) -> Vec<(String, String)> {
    let motor = &data.motor;
    let own = [
        ("a_e", format!("{} m", motor.contact_radius_m)),
        ("a_g", format!("{} m", motor.gyration_radius_m)),
        ("rotor mass", format!("{:.5} kg", data.rotor_mass_kg)),
        ("preloads", data.curves.first().map_or(0, |curve| curve.points.len()).to_string()),
        ("seed of the preloads", data.preload_seed.to_string()),
        ("members by amplitude", data.members.map(|count| count.to_string()).join(", ")),
        ("duration", format!("{} ωΦ a_g²/(μ a_e g)", data.rises)),
        ("relaunch perturbation", format!("{} g/ω", data.relaunch_perturbation)),
    ];
    let motors = data.curves.iter().flat_map(|curve| {
        let (frequency_hz, amplitude_m) = (curve.frequency_hz, curve.amplitude_m);
        data.printed.preload_accelerations_m_per_s2.map(|preload_acceleration_m_per_s2| MotorCase {
            frequency_hz,
            amplitude_m,
            preload_acceleration_m_per_s2,
            ..*motor
        })
    });
    [motor.shared_inputs(), named(own), vec![MotorCase::contact_row(motors)]].concat()
}
