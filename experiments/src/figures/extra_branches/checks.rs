//! What the branches are compared with: orbits that have settled, closed forms, another search.

use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::{Error, ImpactMap, ImpactState, Verdict, VerdictSettings, verdicts};
use rayon::prelude::*;

use super::branches::{SAME, Walked, distance, map};
use super::data::{Mark, MarkKind, Pair, Settled};

/// How many orbits that lie on no branch are named.
const NAMED: usize = 12;

/// The width of the bracket about the last Γ at which an orbit is admissible.
const BRACKET: f64 = 1e-13;

/// Γ, impacts and periods of a settled orbit, and its distance from the nearest one on a stable branch.
type Judged = (f64, u64, u64, Option<f64>);

/// Where orbits settle that start so, against the branches: all that settle on a periodic orbit for which
/// `counts` (impacts, periods) holds.
pub(super) fn settled(
    branches: &[Walked],
    starts: &[(ImpactMap, ImpactState)],
    settings: VerdictSettings,
    counts: impl Fn(u64, u64) -> bool + Sync,
) -> Result<Settled, Error> {
    let verdicts = verdicts(starts, settings)?;
    let judged: Vec<Option<Judged>> = starts
        .par_iter()
        .zip(verdicts)
        .map(|((map, _), verdict)| match verdict {
            Verdict::Periodic { impacts, platform_periods, state, .. }
                if counts(impacts, platform_periods) =>
            {
                let nearest = nearest_stable(branches, map, impacts, &state);
                Some((map.vibration().axial_forcing(), impacts, platform_periods, nearest))
            }
            _ => None,
        })
        .collect();
    let mut result = Settled { orbits: starts.len(), ..Settled::default() };
    for (forcing, impacts, periods, nearest) in judged.into_iter().flatten() {
        result.periodic += 1;
        match nearest.filter(|nearest| *nearest < SAME) {
            Some(nearest) => {
                result.on_stable += 1;
                result.distance = result.distance.max(nearest);
            }
            None if result.missed.len() < NAMED => result.missed.push((forcing, impacts, periods)),
            None => {}
        }
    }
    Ok(result)
}

/// How far a state is from the nearest impact of an attracting orbit with as many impacts on any branch.
fn nearest_stable(branches: &[Walked], map: &ImpactMap, impacts: u64, state: &ImpactState) -> Option<f64> {
    let of_as_many = branches.iter().filter(|walked| walked.impacts() as u64 == impacts);
    let orbits = of_as_many.flat_map(|walked| walked.orbits_at(map)).filter(|(_, stable)| *stable);
    let distances =
        orbits.flat_map(|(orbit, _)| orbit.states.iter().map(|own| distance(own, state)).collect::<Vec<_>>());
    distances.min_by(f64::total_cmp)
}

/// The special points of the pair of one impact every k periods, beside those found by other ways.
pub(super) fn pair(
    restitution: f64,
    platform_periods: u64,
    marks: &[Mark],
    highest: f64,
) -> Result<Pair, Error> {
    let k = platform_periods;
    let own = |kind: MarkKind, saddle: bool| {
        marks.iter().find(|mark| {
            mark.kind == kind
                && mark.impacts == 1
                && mark.platform_periods == k
                && (mark.kind == MarkKind::Fold || (mark.impact_phase_cycles[0] > 0.5) == saddle)
        })
    };
    let forcing = |mark: Option<&Mark>| mark.map(|mark| mark.axial_forcing);
    let birth = |k: u64| k as f64 * (1.0 - restitution) / (1.0 + restitution);
    // The height of the doubling above the birth, in squares, is the same for every k.
    let first = ImpactMap::first_doubling_forcing(restitution);
    let height = first * first - birth(1) * birth(1);
    let saddle_graze = forcing(own(MarkKind::Graze, true));
    let saddle_admissible_up_to = match saddle_graze {
        Some(_) => {
            let admissible = |forcing: f64| -> Result<bool, Error> {
                let map = map(forcing, restitution)?;
                match map.period_one_pair(k) {
                    Some(pair) => pair.saddle.is_admissible(&map),
                    None => Ok(false),
                }
            };
            Some(bracket_of_width(birth(k) + 0.01, highest, BRACKET, admissible)?.0)
        }
        None => None,
    };
    Ok(Pair {
        platform_periods: k,
        fold: forcing(own(MarkKind::Fold, false)),
        fold_in_closed_form: birth(k),
        doubling: forcing(own(MarkKind::Doubling, false)),
        doubling_in_closed_form: (birth(k) * birth(k) + height).sqrt(),
        saddle_graze,
        saddle_admissible_up_to,
    })
}
