//! What the paper says about the single toss's inputs, compared with the data.

use super::data::Table1Data;
use crate::claim::{Cases, Claim};
use crate::figures::uncertainty::Propagated;

const ID: &str = "table1";

/// The relations of Eqs. (13) and (15) must hold to this share: they are identities, and the rest is
/// rounding.
const ROUNDING: f64 = 1e-14;
/// A length along a polygon of hundreds of points of a straight line adds as many roundings.
const LENGTH: f64 = 1e-12;

pub(super) fn claims(data: &Table1Data) -> Vec<Claim> {
    let entries = &data.computed_entries;
    let (start, components, fastest) = (&data.start, &data.components, &data.fastest);
    let (arc, restitution) = (&data.arc, &data.restitution);
    let (frequency, angle, friction) =
        ("table1.angular_frequency", "table1.amplitude_angle", "table1.friction");
    let corrected = data.separation.corrected_angular_frequency_rad_per_s;
    vec![
        over_alike(angle, entries.amplitude_angle_rad.value, data.alike.amplitude_angle),
        combined("table1.amplitude_angle_uncertainty", &entries.amplitude_angle_rad)
            .note("the effects of a_e and the launch speeds"),
        over_alike(frequency, entries.angular_frequency_rad_per_s.value, data.alike.angular_frequency),
        combined("table1.angular_frequency_uncertainty", &entries.angular_frequency_rad_per_s)
            .note("the effects of c, a_e and the launch speeds"),
        Claim::reading(ID, frequency, "ω by Eq. (14) with the launch speeds taken at τ_sep", corrected.value),
        over_alike(friction, entries.friction.value, data.alike.friction)
            .note(format!("tan({}°)", data.slip_slope_deg.value)),
        over_alike("table1.friction_uncertainty", entries.friction.sum, data.alike.friction_uncertainty)
            .note(format!("half the difference of the tangents at the ends of {}°", data.slip_slope_deg)),
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
                "at {} angles from 0 to π/2: A² + (a_e Φ)² = c² to {:.1e} and arctan L = φ_L to {:.1e} rad",
                components.angles, components.stroke_deviation, components.angle_deviation_rad
            ),
        ),
        Claim::printed_statement(
            "section3.arc_length",
            (arc.length_m / arc.half_m - 1.0).abs() <= LENGTH,
            format!(
                "the path of Table I's toss, a straight line on the unrolled cylinder, is {:.4} m long from end to end, {:.4} times \
                 sqrt(A² + (a_e Φ)²) = {:.4} m, which is the distance from its middle to an end; in a period the hand moves {:.4} m. \
                 c is half of the arc",
                arc.length_m,
                arc.length_m / arc.half_m,
                arc.half_m,
                arc.per_period_m
            ),
        )
        .cause("half of the arc called the arc"),
        Claim::printed_statement(
            "section3.restitution_is_no_input",
            (!restitution.tried.is_empty()).then_some(
                restitution.speed_deviation_rad_per_s <= 0.0 && restitution.efficiency_deviation <= 0.0,
            ),
            format!(
                "at ε = {:?}, for {} phase lags and both initial states the airborne speed differs by {} rad/s and the efficiency by {}: \
                 there is no impact before the separation. The initial state does matter for θ ≠ 0; the text says \"at rest\" (Sec. III A) and \
                 \"at rest relative to the hand\" (Sec. I), see fig04",
                restitution.tried,
                restitution.phase_lags_rad.len(),
                restitution.speed_deviation_rad_per_s,
                restitution.efficiency_deviation
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

/// A printed uncertainty that several inputs share in: the paper does not say how their effects add up.
fn combined(key: &str, computed: &Propagated) -> Claim {
    let claim = Claim::printed(key, computed.sum);
    let squares = Claim::printed(key, computed.root_sum_of_squares).verdict();
    let note = format!(
        "plain sum of the effects; the root of the sum of their squares is {:.3}",
        computed.root_sum_of_squares
    );
    if squares == claim.verdict() {
        return claim.note(note);
    }
    claim.fitted("how the effects of the inputs add up, as a plain sum").note(note)
}

/// An entry that the paper computes, judged over inputs that all round to the printed ones.
fn over_alike(key: &str, computed: f64, agreement: Cases) -> Claim {
    Claim::printed(key, computed).judged_over(agreement).note(format!(
        "at the printed inputs; of {} inputs that all round to them {} give the printed number",
        agreement.tried, agreement.holding
    ))
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
    .cause("the hand's largest speeds taken for those at separation")
}
