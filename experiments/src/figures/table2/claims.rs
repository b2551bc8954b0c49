//! What the paper says in Table II, compared with the data.

use super::data::{Effect, Table2Data};
use crate::claim::{self, Claim, Verdict};

const ID: &str = "table2";

/// The change of the airborne speed that a reading of the table takes for an entry.
type Read = fn(&Effect) -> f64;

/// The ways to read "uncertainty due to an input".
const READINGS: [(&str, Read); 5] = [
    ("half the difference of both ends", |effect| effect.central_rad_per_s),
    ("slope times uncertainty", |effect| effect.linear_rad_per_s),
    ("lower end only", |effect| effect.lower_rad_per_s),
    ("upper end only", |effect| effect.upper_rad_per_s),
    ("larger of both ends", |effect| effect.upper_rad_per_s.abs().max(effect.lower_rad_per_s.abs())),
];

pub(super) fn claims(data: &Table2Data) -> Vec<Claim> {
    let mut claims = Vec::new();
    for effect in &data.effects {
        let claim = Claim::printed(&effect.key, effect.central_rad_per_s.abs());
        claims.push(claim.note(format!(
            "half the difference of the speeds at both ends; changes at the upper end {:+.3}, at the lower end {:+.3}",
            effect.upper_rad_per_s, effect.lower_rad_per_s
        )));
    }
    claims.push(readings(data));
    claims.extend(together(data));
    claims
}

/// Which readings of the table give all its entries.
fn readings(data: &Table2Data) -> Claim {
    let agrees = |effect: &Effect, name: &str, read: Read| {
        Claim::reading(ID, &effect.key, name, read(effect).abs()).verdict() == Verdict::Reproduced
    };
    let parts = READINGS.map(|(name, read)| {
        let missed: Vec<_> = data
            .effects
            .iter()
            .filter(|effect| !agrees(effect, name, read))
            .map(|effect| format!("{} ({:.3})", effect.input, read(effect).abs()))
            .collect();
        match missed.is_empty() {
            true => format!("{name}: all"),
            false => format!("{name}: not {}", missed.join(", ")),
        }
    });
    let complete =
        READINGS.map(|(name, read)| claim::all(&data.effects, |effect| agrees(effect, name, read)));
    Claim::statement(
        ID,
        "Table II",
        "all six entries come out of Table I to the printed digits in one reading",
        (!data.effects.is_empty()).then_some(complete.contains(&Some(true))),
        parts.join("; "),
    )
}

/// The uncertainty of all inputs together, by the usual rule and by the one that Table I follows.
fn together(data: &Table2Data) -> [Claim; 2] {
    const KEY: &str = "section3.predicted_airborne_speed_uncertainty";
    let combined = &data.combined;
    [
        Claim::printed(KEY, combined.root_sum_of_squares_rad_per_s).note(format!(
            "root of the sum of squares; the largest single effect is {:.1} and the root sum of squares of the others {:.1}, both of which print as the \
             paper's number; ω and φ_L are not independent of c and a_e: with both launch speeds, c, a_e, a_g and μ as independent inputs it is {:.1}",
            combined.largest_rad_per_s,
            combined.without_largest_rad_per_s,
            data.uncertainty_from_launch_speeds_rad_per_s
        ))
        .cause("±5 is no sum of the effects"),
        Claim::reading(
            ID,
            KEY,
            "the same as the plain sum of the effects, by which Table I's own uncertainties come out",
            combined.sum_rad_per_s,
        )
        .note("no rule of both gives the printed number"),
    ]
}
