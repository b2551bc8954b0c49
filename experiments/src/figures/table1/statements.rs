//! What the paper says about the single toss's inputs, compared with the data.

use super::Table1;
use super::data::Table1Data;
use crate::claim::Claim;
use crate::experiment::Experiment;

/// The relations of Eqs. (13) and (15) must hold to this share: they are identities, and the rest is rounding.
const ROUNDING: f64 = 1e-14;

pub(super) fn claims(data: &Table1Data) -> Vec<Claim> {
    let entries = &data.computed_entries;
    let (start, components, fastest) = (&data.start, &data.components, &data.fastest);
    let (frequency, angle, friction) =
        ("table1.angular_frequency", "table1.amplitude_angle", "table1.friction");
    let corrected = data.separation.corrected_angular_frequency_rad_per_s;
    let uncertainty = |key: &str, symbol: &str, inputs: &str, value: f64| {
        let quantity = format!("uncertainty of {symbol}: sum of the effects of {inputs}");
        Claim::printed_uncertainty(Table1::ID, key, quantity, value)
    };
    let squares = |value: f64| format!("the root sum of squares is {value:.3}");
    vec![
        Claim::printed(angle, entries.amplitude_angle_rad.value),
        uncertainty(angle, "φ_L", "a_e and the launch speeds", entries.amplitude_angle_rad.sum)
            .note(squares(entries.amplitude_angle_rad.root_sum_of_squares)),
        Claim::printed(frequency, entries.angular_frequency_rad_per_s.value),
        uncertainty(frequency, "ω", "c, a_e and the launch speeds", entries.angular_frequency_rad_per_s.sum)
            .note(squares(entries.angular_frequency_rad_per_s.root_sum_of_squares)),
        Claim::reading(
            Table1::ID,
            frequency,
            "ω by Eq. (14) with the launch speeds taken at τ_sep",
            corrected.value,
        ),
        Claim::printed(friction, entries.friction.value).note(format!("tan({}°)", data.slip_slope_deg.value)),
        uncertainty(friction, "μ", "the slope", entries.friction.sum),
        Claim::printed_statement(
            "section3.start_is_lowest",
            (start.height_over_amplitude + 1.0).abs() <= ROUNDING
                && start.velocity_over_largest.abs() <= ROUNDING,
            format!(
                "there s/A = {}, and ṡ/(Aω) = {:.1e}",
                start.height_over_amplitude, start.velocity_over_largest
            ),
        ),
        Claim::printed_statement(
            "section3.stroke_components",
            components.stroke_deviation <= ROUNDING && components.angle_deviation_rad <= ROUNDING,
            format!(
                "at {} angles from 0 to π/2: A² + (a_e Φ)² = c² to {:.1e} and arctan L = φ_L to {:.1e} rad; c is half \
                 the length of the path, from the middle to an end",
                components.angles, components.stroke_deviation, components.angle_deviation_rad
            ),
        ),
        launch_without_slip(data),
        Claim::printed_statement(
            "section3.fastest_hand_phase",
            (fastest.smallest_there - 1.0).abs() <= ROUNDING && fastest.largest_elsewhere < 1.0,
            format!(
                "for {} phase lags from −π to π |β̇| is at least {} ωΦ at τ = −θ and π − θ, and at most {:.3} ωΦ \
                 further than a hundredth of a period from these",
                fastest.lags, fastest.smallest_there, fastest.largest_elsewhere
            ),
        ),
    ]
}

/// Eq. (14) takes the largest speeds of the hand for the speeds at separation.
fn launch_without_slip(data: &Table1Data) -> Claim {
    let separation = &data.separation;
    let same = |one: f64, other: f64| (one / other - 1.0).abs() <= ROUNDING;
    Claim::printed_statement(
        "section3.launch_without_slip",
        same(separation.axial_speed_m_per_s, separation.largest_axial_speed_m_per_s)
            && same(separation.angular_speed_rad_per_s, separation.largest_angular_speed_rad_per_s),
        format!(
            "these are the hand's largest speeds, at τ = 0 ({:.3} m/s and {:.2} rad/s for Table I); the dough leaves \
             at τ_sep with {:.3} of both ({:.3} m/s, {:.2} rad/s). φ_L does not depend on this factor; with it ω is \
             {:.2} instead of {:.2} rad/s, a difference far below its uncertainty",
            separation.largest_axial_speed_m_per_s,
            separation.largest_angular_speed_rad_per_s,
            separation.speed_share,
            separation.axial_speed_m_per_s,
            separation.angular_speed_rad_per_s,
            separation.corrected_angular_frequency_rad_per_s.value,
            data.computed_entries.angular_frequency_rad_per_s.value,
        ),
    )
}
