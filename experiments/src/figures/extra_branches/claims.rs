//! What the branches show, and their check.

use super::data::{CascadePoint, ExtraBranchesData, Mark, MarkKind, Pair, Settled};
use crate::claim::Claim;

const ID: &str = "extra-branches";
const PLACE: &str = "this work";

/// Rounding of a fold: the parameter is stationary there.
const FOLD_ROUNDING: f64 = 1e-13;

/// Rounding of a doubling.
const DOUBLING_ROUNDING: f64 = 1e-13;

/// Of the doublings that follow: it grows from one to the next.
const CASCADE_ROUNDING: f64 = 1e-12;

/// Next to a graze the first impact is as uncertain as the gap, 1e-14 or so, by the rate at which the margin
/// changes with Γ.
const GRAZE_ROUNDING: f64 = 1e-11;

/// How near a settled orbit is to its branch (rad): it was followed until the verdict, not to the rounding.
const SETTLED: f64 = 1e-6;

/// The largest difference of two numbers of each pair; not a number where one of them is missing, or where
/// there is no pair.
fn largest<T>(items: &[T], difference: impl Fn(&T) -> Option<f64>) -> f64 {
    let all: Option<Vec<f64>> = items.iter().map(difference).collect();
    all.and_then(|all| all.into_iter().map(f64::abs).max_by(f64::total_cmp)).unwrap_or(f64::NAN)
}

pub(super) fn claims(data: &ExtraBranchesData) -> Vec<Claim> {
    let grazing: Vec<&Pair> = data.pairs.iter().filter(|pair| pair.saddle_graze.is_some()).collect();
    let vanishing: Vec<&Mark> =
        data.marks.iter().filter(|mark| mark.kind == MarkKind::VanishingImpact).collect();
    let lost = data.curves.iter().filter(|curve| curve.lost).count();
    let count = |kind: MarkKind| data.marks.iter().filter(|mark| mark.kind == kind).count();
    vec![
        Claim::expected(
            ID,
            PLACE,
            "folds of the pairs, less k(1 − ε)/(1 + ε): the largest deviation",
            "",
            (0.0, FOLD_ROUNDING),
            largest(&data.pairs, |pair| Some(pair.fold? - pair.fold_in_closed_form)),
        )
        .note(format!("k = 1 to {}; the tolerance is rounding", data.pairs.len())),
        Claim::expected(
            ID,
            PLACE,
            "first doublings of the nodes, less their closed form: the largest deviation",
            "",
            (0.0, DOUBLING_ROUNDING),
            largest(&data.pairs, |pair| Some(pair.doubling? - pair.doubling_in_closed_form)),
        )
        .note("(Γ − birth)(Γ + birth) at the doubling is the same for every k; the tolerance is rounding"),
        Claim::expected(
            ID,
            PLACE,
            "doublings along the branches that double from k = 1, less those of the cascade: the largest deviation",
            "",
            (0.0, CASCADE_ROUNDING),
            largest(&data.doublings, |point: &CascadePoint| Some(point.axial_forcing - point.of_cascade)),
        )
        .note(format!(
            "the orbits of {} impacts; the cascade has other equations and another search",
            data.doublings.iter().map(|point| point.impacts.to_string()).collect::<Vec<_>>().join(", ")
        )),
        Claim::expected(
            ID,
            PLACE,
            "Γ at which the saddles end, less that from which on the exact map has an earlier impact: the largest deviation",
            "",
            (0.0, GRAZE_ROUNDING),
            largest(&grazing, |pair| Some(pair.saddle_graze? - pair.saddle_admissible_up_to?)),
        )
        .note(format!("{} saddles end by a graze below Γ = {}", grazing.len(), data.axial_forcing_ranges[1].1)),
        Claim::expected(
            ID,
            PLACE,
            "Γ at which an orbit loses an impact, less that of the nearest graze of one with an impact fewer: the largest deviation",
            "",
            (0.0, GRAZE_ROUNDING),
            largest(&vanishing, |mark| lost_impact(mark, &data.marks)),
        )
        .note("where an orbit grazes the platform, one with an impact of no speed takes its place"),
        settled_claim(
            &data.settled,
            "attractors followed from one impact every k periods that settle on an orbit of a kind that is drawn lie on a stable branch",
        ),
        settled_claim(
            &data.starts,
            "orbits from starts all over panel (a) that settle on one of the kind that was searched for lie on a stable branch",
        ),
        Claim::statement(
            ID,
            PLACE,
            "every branch ends at the limits of its range or in a bifurcation, or is closed",
            (!data.curves.is_empty()).then_some(lost == 0),
            format!(
                "{} branches, {lost} lost; {} folds, {} doublings, {} grazes, {} vanishing impacts",
                data.curves.len(),
                count(MarkKind::Fold),
                count(MarkKind::Doubling),
                count(MarkKind::Graze),
                count(MarkKind::VanishingImpact)
            ),
        ),
    ]
}

/// How far in Γ the nearest graze of an orbit with one impact fewer, and as many periods, is.
fn lost_impact(mark: &Mark, marks: &[Mark]) -> Option<f64> {
    let grazes = marks.iter().filter(|other| {
        other.kind == MarkKind::Graze
            && other.impacts + 1 == mark.impacts
            && other.platform_periods == mark.platform_periods
    });
    grazes.map(|other| (other.axial_forcing - mark.axial_forcing).abs()).min_by(f64::total_cmp)
}

/// Whether all settled orbits lie on a branch that attracts, and how near.
fn settled_claim(settled: &Settled, quantity: &str) -> Claim {
    let near = settled.distance <= SETTLED;
    let missed: Vec<String> = settled
        .missed
        .iter()
        .map(|(forcing, impacts, periods)| {
            format!("{impacts} impacts in {periods} periods at Γ = {forcing:.4}")
        })
        .collect();
    let claim = Claim::statement(
        ID,
        PLACE,
        quantity,
        (settled.periodic > 0).then_some(settled.on_stable == settled.periodic && near),
        format!(
            "{} of {}, of {} orbits in all; the largest distance is {:.1e}",
            settled.on_stable, settled.periodic, settled.orbits, settled.distance
        ),
    );
    if missed.is_empty() { claim } else { claim.note(format!("on none: {}", missed.join(", "))) }
}
