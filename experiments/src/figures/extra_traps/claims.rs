//! What the maps show, and their check.

use super::data::ExtraTrapsData;
use crate::claim::{Cases, Claim};

const ID: &str = "extra-traps";
const PLACE: &str = "this work";

pub(super) fn claims(data: &ExtraTrapsData) -> Vec<Claim> {
    let mut claims = Vec::new();
    if let Some(single) = &data.single_flight {
        claims.push(
            Claim::expected(
                ID,
                PLACE,
                "middle of the traps of a single flight at the largest integer part of Γ: fraction of Γ",
                "",
                (0.5, single.last_half_width),
                single.last_middle,
            )
            .note(format!(
                "expected: a flight of n + 1/2 periods ends where the stator recedes as fast as the rotor falls; the tolerance is half \
                 of what the traps cover there; single flights trap at fractions from {:.3} to {:.3}, in {} of {} rows",
                single.least_fraction,
                single.most_fraction,
                single.rows,
                data.whole_forcings.len()
            )),
        );
    }
    let checked = &data.checked;
    claims.push(
        Claim::statement(
            ID,
            PLACE,
            "the verdict is that of the regime in the motor's report",
            None,
            "motors with Γ and restitution drawn at random; the report follows 20 000 impacts of one perturbed motion",
        )
        .judged_over(Cases { holding: checked.agreeing, tried: checked.motors })
        .note(format!("{} of {} are traps", checked.trapped, checked.motors)),
    );
    let most = data
        .share_of_fig11
        .iter()
        .map(|share| share.trapped as f64 / share.motors as f64)
        .fold(0.0, f64::max);
    claims.push(Claim::statement(
        ID,
        PLACE,
        "some, and less than a fourth, of the preloads of Fig. 11 are trapped, at each amplitude",
        most < 0.25 && data.share_of_fig11.iter().all(|share| share.trapped > 0),
        data.share_of_fig11
            .iter()
            .map(|share| {
                format!(
                    "A = {:e} m, Γ = {:.1} to {:.1}: {} of {}",
                    share.amplitude_m, share.forcings[0], share.forcings[1], share.trapped, share.motors
                )
            })
            .collect::<Vec<_>>()
            .join("; "),
    ));
    claims.push(Claim::statement(
        ID,
        PLACE,
        "traps are a minority of the motors in both maps",
        data.by_fraction.trapped_share() < 0.5 && data.by_restitution.trapped_share() < 0.5,
        format!(
            "{:.1} % in (a), {:.1} % in (b)",
            100.0 * data.by_fraction.trapped_share(),
            100.0 * data.by_restitution.trapped_share()
        ),
    ));
    claims
}
