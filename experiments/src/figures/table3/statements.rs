//! What the paper says about the motor's inputs, compared with the data.

use super::Table3;
use super::data::Table3Data;
use crate::claim::Claim;
use crate::experiment::Experiment;

pub(super) fn claims(data: &Table3Data) -> Vec<Claim> {
    let known = data.inputs.iter().filter(|input| input.known).count();
    let names = |wanted: bool| {
        let inputs = data.inputs.iter().filter(|input| input.known == wanted);
        inputs.map(|input| input.symbol.clone()).collect::<Vec<_>>().join(", ")
    };
    let missing: Vec<_> = data
        .inputs
        .iter()
        .filter(|input| input.printed.is_empty())
        .map(|input| input.symbol.clone())
        .collect();
    let drop = &data.drop;
    let [shortest, longest] = drop.heights_of_printed_speed_m.map(|height| 100.0 * height);
    let [slowest, fastest] = drop.impact_speed_range_m_per_s;
    vec![
        Claim::printed("section5.announced_inputs", data.inputs.len() as f64).note(format!(
            "all are needed to build the model's platform and disk; Table III prints {}: {} is missing",
            data.printed_inputs,
            missing.join(", ")
        )),
        Claim::printed("section5.known_inputs", known as f64).note(names(true)),
        Claim::printed("section5.unknown_inputs", (data.inputs.len() - known) as f64).note(names(false)),
        Claim::printed("table3.gyration_radius", data.ball_gyration_radius_mm)
            .note("a_g of a solid ball is √(2/5) of its radius"),
        preload(data),
        Claim::printed("section5.estimated_restitution", drop.restitution.value)
            .note("square root of rebound height over drop height"),
        Claim::printed_uncertainty(
            Table3::ID,
            "section5.estimated_restitution",
            "uncertainty of ε: half the difference of both ends of the rebound height",
            drop.restitution.sum,
        ),
        Claim::printed("section5.drop_speed", drop.impact_speed_m_per_s).note(format!(
            "√(2 g h) for h = {:.1} cm; heights that round to it give {slowest:.3} to {fastest:.3} m/s, and the \
             printed speed needs {shortest:.2} to {longest:.2} cm",
            100.0 * drop.heights.drop_height_m
        )),
    ]
}

/// The last column of Table III.
fn preload(data: &Table3Data) -> Claim {
    let [printed, gravity] = data.preloads_n.map(|force| 1e3 * force);
    let [low, high] = data.varied_m_per_s2;
    Claim::printed("table3.preload_acceleration", data.gravity_m_per_s2).note(format!(
        "the frequency is the input that Table III does not print; its default is {} kHz and the preload is gravity, \
         so the 70 is ω/2π in kHz. As printed, g would be a preload of {printed:.0} mN on the rotor, which weighs \
         {gravity:.0} mN, and outside the {low} to {high} m/s² of Sec. V B",
        data.frequency_khz
    ))
}
