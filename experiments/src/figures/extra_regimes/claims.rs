//! What the map shows, and its check.

use super::data::{ExtraRegimesData, Kind};
use crate::claim::Claim;

const ID: &str = "extra-regimes";
const PLACE: &str = "this work";

/// Cells that may be undecided.
const FEW: f64 = 1e-2;

pub(super) fn claims(data: &ExtraRegimesData) -> Vec<Claim> {
    let count = |kind: Kind| data.counts.get(usize::from(kind.digit())).copied().unwrap_or_default();
    let [weak, rest] = data.weak;
    vec![
        Claim::statement(
            ID,
            PLACE,
            "fewer than one cell in a hundred is undecided",
            data.share(Kind::Undecided) < FEW,
            format!("{} of {}", count(Kind::Undecided), data.cells()),
        ),
        Claim::statement(
            ID,
            PLACE,
            "one impact in each period of the platform: only between the birth and the first doubling of that orbit",
            data.period_one_outside == 0,
            "both in closed form, the verdicts from orbits that are followed",
        ),
        Claim::statement(
            ID,
            PLACE,
            "below Γ = 1/π and below the birth of the period-1 orbit every disk comes to rest",
            (weak > 0).then_some(weak == rest),
            format!("{rest} of {weak} cells"),
        ),
        Claim::statement(
            ID,
            PLACE,
            "more cells end in a cycle of flights and rest than on all attractors that bounce for ever",
            count(Kind::ExactCycle) + count(Kind::LongCycle) > bouncing(data),
            format!(
                "{} cycles that doubles follow exactly, {} chosen by rounding, {} attractors without rest, {} of them after a rest",
                count(Kind::ExactCycle),
                count(Kind::LongCycle),
                bouncing(data),
                data.after_rest
            ),
        ),
    ]
}

/// Cells on a periodic or chaotic attractor.
fn bouncing(data: &ExtraRegimesData) -> usize {
    let kinds = [Kind::PeriodOne, Kind::PeriodTwo, Kind::PeriodThree, Kind::LongerPeriod, Kind::Chaotic];
    kinds.iter().filter_map(|kind| data.counts.get(usize::from(kind.digit()))).sum()
}
