//! What the figure shows, and its check.

use super::data::ExtraManifoldsData;
use crate::claim::{self, Claim};

const ID: &str = "extra-manifolds";
const PLACE: &str = "this work";

pub(super) fn claims(data: &ExtraManifoldsData) -> Vec<Claim> {
    let periodic = data.panels.get(..3).unwrap_or_default();
    let texts = |of: &dyn Fn(&super::data::Panel) -> String| -> String {
        data.panels.iter().map(of).collect::<Vec<_>>().join("; ")
    };
    vec![
        Claim::statement(
            ID,
            PLACE,
            "at the first three forcings of Fig. 7, where the attractors are periodic, every pair of starts on both sides of a manifold becomes different things",
            claim::all(periodic, |panel| panel.pairs > 100 && panel.different == panel.pairs),
            texts(&|panel| {
                format!("Γ = {}: {} of {} pairs", panel.axial_forcing, panel.different, panel.pairs)
            }),
        ),
        Claim::statement(
            ID,
            PLACE,
            "at these forcings 99 in 100 borders between the basins at least lie on the manifolds, as far as these are grown",
            claim::all(periodic, |panel| panel.share_of_borders() >= 0.99),
            texts(&|panel| {
                format!(
                    "Γ = {}: {} of {} borders, length {:.0}",
                    panel.axial_forcing, panel.borders_on_manifold, panel.borders, panel.arclength
                )
            }),
        ),
        Claim::statement(
            ID,
            PLACE,
            "the third attractor is born in a doubling below its forcing, of an orbit that is born in a fold",
            data.third.fold < data.third.birth
                && data.panels.get(1).is_some_and(|panel| {
                    data.third.birth < panel.axial_forcing && panel.axial_forcing < data.third.doubling
                }),
            format!(
                "fold {:.9}, doublings {:.9} and {:.9}",
                data.third.fold, data.third.birth, data.third.doubling
            ),
        ),
    ]
}
