//! What the paper says about the single toss's inputs, compared with the data.

use super::data::Table1Data;
use crate::claims::{Cases, Claim};
use crate::figures::uncertainty::Propagated;

/// Two speeds that are the same differ by no more than this share: rounding.
const ROUNDING: f64 = 1e-14;
/// A length along a polygon of hundreds of points of a straight line adds as many roundings.
const LENGTH: f64 = 1e-12;

pub(super) fn claims(data: &Table1Data) -> Vec<Claim> {
    let entries = &data.computed_entries;
    let arc = &data.arc;
    let (frequency, angle, friction) =
        ("table1.angular_frequency", "table1.amplitude_angle", "table1.friction");
    vec![
        over_alike(angle, entries.amplitude_angle_rad.value, data.alike.amplitude_angle),
        combined("table1.amplitude_angle_uncertainty", &entries.amplitude_angle_rad)
            .note("the effects of a_e and the launch speeds"),
        over_alike(frequency, entries.angular_frequency_rad_per_s.value, data.alike.angular_frequency),
        combined("table1.angular_frequency_uncertainty", &entries.angular_frequency_rad_per_s)
            .note("the effects of c, a_e and the launch speeds"),
        over_alike(friction, entries.friction.value, data.alike.friction)
            .note(format!("tan({}°)", data.slip_slope_deg.value)),
        over_alike("table1.friction_uncertainty", entries.friction.sum, data.alike.friction_uncertainty)
            .note(format!("half the difference of the tangents at the ends of {}°", data.slip_slope_deg)),
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
        launch_without_slip(data),
    ]
}

/// A printed uncertainty that several inputs share in: the paper does not say how their effects add up.
fn combined(key: &str, computed: &Propagated) -> Claim {
    let claim = Claim::printed(key, computed.sum);
    let squares = Claim::printed(key, computed.root_sum_of_squares).verdict;
    let note = format!(
        "plain sum of the effects; the root of the sum of their squares is {:.3}",
        computed.root_sum_of_squares
    );
    if squares == claim.verdict {
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
