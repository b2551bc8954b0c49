//! What the paper says in Table II, compared with the data.

use super::data::Table2Data;
use crate::claims::Claim;

pub(super) fn claims(data: &Table2Data) -> Vec<Claim> {
    let mut claims = Vec::new();
    for effect in &data.effects {
        let claim = Claim::printed(&effect.key, effect.central_rad_per_s.abs());
        claims.push(claim.note(format!(
            "half the difference of the speeds at both ends; changes at the upper end {:+.3}, at the lower end {:+.3}",
            effect.upper_rad_per_s, effect.lower_rad_per_s
        )));
    }
    claims.push(together(data));
    claims
}

/// The uncertainty of all inputs together, by the usual rule.
fn together(data: &Table2Data) -> Claim {
    const KEY: &str = "section3.predicted_airborne_speed_uncertainty";
    let combined = &data.combined;
    Claim::printed(KEY, combined.root_sum_of_squares_rad_per_s).note(format!(
            "root of the sum of squares; the largest single effect is {:.1} and the root sum of squares of the others {:.1}, both of which print as the \
             paper's number; ω and φ_L are not independent of c and a_e: with both launch speeds, c, a_e, a_g and μ as independent inputs it is {:.1}",
            combined.largest_rad_per_s,
            combined.without_largest_rad_per_s,
            data.uncertainty_from_launch_speeds_rad_per_s
        ))
        .cause("±5 is no sum of the effects")
}
