//! What the paper says about the motor's inputs, compared with the data.

use super::data::Table3Data;
use crate::claims::Claim;
use crate::figures::stall::Stall;

const ID: &str = "table3";

/// A difference of more than so many standard errors is one.
const STANDARD_ERRORS: f64 = 3.0;

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
            .judged_over(drop.restitution_agreement)
            .note(format!(
                "square root of rebound height over drop height. Heights that round to the printed ones give {:.3} to {:.3}, {} in {} of them an ε that \
                 rounds to the printed one",
                drop.restitution_range[0],
                drop.restitution_range[1],
                drop.restitution_agreement.holding,
                drop.restitution_agreement.tried,
            )),
        Claim::printed("section5.drop_speed", drop.impact_speed_m_per_s).judged_over(drop.agreement).note(format!(
            "√(2 g h) for h = {:.1} cm and g = {} m/s²; heights that round to it give {slowest:.3} to {fastest:.3} m/s, and the \
             printed speed needs {shortest:.2} to {longest:.2} cm. Of heights and gravitational accelerations ({:.2} to {:.2} m/s²) that round to the \
             printed ones {} in {} give the printed speed",
            100.0 * drop.heights.drop_height_m,
            data.gravity_m_per_s2,
            drop.printed_gravity_range_m_per_s2[0],
            drop.printed_gravity_range_m_per_s2[1],
            drop.agreement.holding,
            drop.agreement.tried
        ))
        .cause("a fall with another gravitational acceleration"),
        drop_gravity(data),
        stall(data),
    ]
}

/// The g that gives the printed speed. An inference from printed numbers; the text does not say which g was used.
fn drop_gravity(data: &Table3Data) -> Claim {
    let drop = &data.drop;
    let [least, most] = drop.gravity_range_of_printed_speed_m_per_s2;
    let holds = |gravity: f64| (least..=most).contains(&gravity);
    Claim::statement(
        ID,
        "Sec. V A",
        "the printed impact speed is consistent with the g of 10 m/s² with which Sec. V B ends its range, and not with the 9.8 m/s² of Table I",
        holds(drop.highest_varied_m_per_s2) && !holds(data.gravity_m_per_s2),
        format!(
            "v²/(2h) is {:.2} m/s², and {least:.3} to {most:.3} for everything that rounds to the printed height and speed; with {} m/s² the speed is {:.4} m/s. This suggests, and \
             does not show, that the authors took {} m/s² for gravity, here and as the full preload of Fig. 10, where at A = 1 nm and {} m/s² the motor repeats a short cycle that it does not have elsewhere",
            drop.gravity_of_printed_speed_m_per_s2,
            drop.highest_varied_m_per_s2,
            drop.impact_speed_at_highest_m_per_s,
            drop.highest_varied_m_per_s2,
            data.gravity_m_per_s2,
        ),
    )
}

/// The stall torque of the default motor.
fn stall(data: &Table3Data) -> Claim {
    let [printed, gravity] = &data.stalls;
    let agrees = |stall: &Stall| stall.estimate_off.abs() <= STANDARD_ERRORS * stall.estimate_off_error;
    Claim::statement(
        ID,
        "Sec. V C",
        "α̇_ss/t_c of the default motor is the acceleration by the torque that stalls it",
        agrees(gravity) && agrees(printed),
        format!(
            "with gravity it {} (over the inputs: {}); with g as printed it {} (over the inputs: {}). The balance of the normal impulse is within {:.1} and {:.1} standard errors of the load found",
            gravity.words(),
            data.speeds[1].stall_over_inputs_rad_per_s2.words(),
            printed.words(),
            data.speeds[0].stall_over_inputs_rad_per_s2.words(),
            gravity.balance_deviation(),
            printed.balance_deviation()
        ),
    )
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
