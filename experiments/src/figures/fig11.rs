//! Fig. 11: steady-state speed and stall torque of the motor against preload.

mod claims;
mod compute;
mod data;
mod draw;
mod trends;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::motor::{OperatingSettings, TransientSettings};
use bouncing_disk_plot::Figure;

pub use self::data::Fig11Data;
use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality, named};
use crate::figures::shared::motor::MotorCase;
use crate::progress::Progress;

/// Fig. 11.
#[derive(Debug)]
pub struct Fig11;

impl Experiment for Fig11 {
    type Data = Fig11Data;
    const ID: &'static str = "fig11";
    const TITLE: &'static str = "Effect of preload on steady-state speed and stall torque";
    const DISCUSSION: &str = include_str!("fig11/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![
            ("preloads", compute::PRELOAD_SEED),
            ("ensembles", TransientSettings::default().seed),
            ("bouncing motors that print alike", compute::BOUNCING_SEED),
            ("runs to stall", OperatingSettings::default().seed),
        ]
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

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig11Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &Fig11Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig11Data) -> Vec<Claim> {
        claims::claims(data)
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
}
