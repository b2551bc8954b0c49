//! What the two diagrams have in common and what not, against closed forms.

use std::f64::consts::PI;

use super::data::{ExtraRestitutionLawData, Followed};
use crate::claim::Claim;

const ID: &str = "extra-restitution-law";
const PLACE: &str = "this work";

/// The bisection and the derivative are good to this.
const TOLERANCE: f64 = 1e-10;

/// Γ of the first doubling: with ρ = d(r v)/dv the derivative along the period-1 orbit has the trace 1 + ρ r - (1 + ρ)(1 + r) S
/// and the determinant ρ r, where S = P sin τ, and P cos τ = π (1 - r)/(1 + r). The multiplier is -1 at
/// S = 2 (1 + ρ r)/((1 + ρ)(1 + r)).
fn first_doubling(restitution: f64, launch_slope: f64) -> f64 {
    let braking =
        2.0 * (1.0 + launch_slope * restitution) / ((1.0 + launch_slope) * (1.0 + restitution)) / PI;
    let rising = (1.0 - restitution) / (1.0 + restitution);
    (rising * rising + braking * braking).sqrt()
}

pub(super) fn claims(data: &ExtraRestitutionLawData) -> Vec<Claim> {
    let restitution = data.law.reference_restitution();
    let named = [("constant restitution", &data.constant), ("viscoelastic law", &data.viscoelastic)];
    let mut claims: Vec<Claim> = named
        .iter()
        .map(|(name, followed)| {
            let expected = first_doubling(restitution, followed.launch_slope);
            Claim::expected(
                ID,
                PLACE,
                format!("Γ of the first period doubling, {name}"),
                "",
                (expected, TOLERANCE),
                followed.first_doubling,
            )
            .note("expected: the closed form; computed from the derivative of the map")
        })
        .collect();
    // The slope of r(v) v at r = r0, from the implicit law r + x r^(3/5) = 1: r (1 - 1/(5 r/(1 - r) + 3)).
    let slope = restitution * (1.0 - 1.0 / (5.0 * restitution / (1.0 - restitution) + 3.0));
    claims.push(
        Claim::expected(
            ID,
            PLACE,
            "slope of the launch speed against the impact speed, viscoelastic law",
            "",
            (slope, TOLERANCE),
            data.viscoelastic.launch_slope,
        )
        .note("expected: r (1 - 1/(5 r/(1 - r) + 3)) at the reference speed; for a constant restitution it is r"),
    );
    let off = data.constant.off_period_one.max(data.viscoelastic.off_period_one);
    claims.push(Claim::statement(
        ID,
        PLACE,
        "period-1 orbits are the same under both laws, to 1e-9",
        off < 1e-9,
        format!("phase and speed of the next impact are off by at most {off:.1e}, at the two doublings"),
    ));
    let lost = |followed: &Followed| followed.lost_at;
    let both = lost(&data.constant).zip(lost(&data.viscoelastic));
    claims.push(Claim::statement(
        ID,
        PLACE,
        "under the viscoelastic law the first doubling and the loss of the attractor come at a larger Γ",
        both.map(|(constant, viscoelastic)| {
            viscoelastic > constant && data.viscoelastic.first_doubling > data.constant.first_doubling
        }),
        both.map_or("not lost".to_owned(), |(constant, viscoelastic)| {
            format!(
                "doubling at {:.5} and {:.5}; lost at {constant:.4} and {viscoelastic:.4}, on a grid of {} values",
                data.constant.first_doubling, data.viscoelastic.first_doubling, data.axial_forcing_values
            )
        }),
    ));
    claims
}
