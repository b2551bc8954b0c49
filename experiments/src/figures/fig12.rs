//! Fig. 12: transient speed curves of long-period and low-period chattering.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::Fig12Data;
use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::motor_case::RobustCycle;
use crate::progress::Progress;

/// Fig. 12.
#[derive(Debug)]
pub struct Fig12;

impl Experiment for Fig12 {
    type Data = Fig12Data;
    const ID: &'static str = "fig12";
    const TITLE: &'static str = "Speed transients of long-period and low-period chattering";
    const DISCUSSION: &str = include_str!("fig12/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("motors that print alike", compute::SEED)]
    }

    fn caption(data: &Fig12Data) -> String {
        let (long, low) = (&data.long_period, &data.low_period);
        format!(
            "Speed transients of the motor of Table III that nothing perturbs. (a)–(c) A = {:e} m, g = {} m/s²: long-period \
             chattering, one orbit of many between which the last places of the inputs choose; (d)–(f) g = {} m/s² and an amplitude {:.1e} of the printed one \
             away from it, the nearest that was found with a low-period cycle of more than one flight which they do not choose ({}). (a), (d) Speed during each \
             flight; dashed: exponential fit, and what the impulses of one cycle predict. (b) Speed and (c), (f) height of the rotor in the blue windows, (f) over \
             three cycles; (e) speed during each flight of ten cycles, dots of one colour for the same flight of every cycle, which form lines. At the printed \
             amplitude itself the length of the cycle is a matter of rounding.",
            data.cases.amplitudes_m[0],
            long.motor.preload_acceleration_m_per_s2,
            low.motor.preload_acceleration_m_per_s2,
            low.amplitude_offset.abs(),
            low.robust_cycle.map_or_else(String::new, RobustCycle::words),
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig12Data, ExperimentError> {
        compute::compute(quality, progress)
    }

    fn draw(data: &Fig12Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig12Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Fig12Data) -> Vec<(String, String)> {
        let motor = &data.long_period.motor;
        let pair = |name: &str, value: String| (name.to_owned(), value);
        let own = [
            pair("ω/2π", format!("{} Hz", motor.frequency_hz)),
            pair("Γ of (a)–(c)", format!("{:.2}", data.long_period.axial_forcing)),
            pair("Γ of (d)–(f)", format!("{:.2}", data.low_period.axial_forcing)),
            pair("low period", format!("at most {} long flights from rest to rest", data.low_period_flights)),
            pair("relaunch perturbation", "none".to_owned()),
            pair("orbits judged for (a)–(c)", data.alike[0].inputs.clone()),
            pair("orbits judged for (d)–(f)", data.alike[1].inputs.clone()),
        ];
        motor.shared_inputs().into_iter().chain(own).collect()
    }
}
