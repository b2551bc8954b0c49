//! Branches over a range of the forcing, stable and unstable, as an orbit diagram shows them.
//!
//! The branches and their bifurcations do not depend on the range: each is followed from its birth on, and the
//! range gets its own points of it.

use bouncing_disk::core::orbits::{
    Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint, Continuation, ContinuationParameter,
    ContinuedMap as _, PeriodicOrbit,
};
use bouncing_disk::core::{Error, ImpactMap, Unobserved, Vibration};

use super::within::within;

/// Pairs with one impact every k periods up to this k, and the branches that double from each.
const MOST_PERIODS: u64 = 3;
const DOUBLINGS: usize = 4;

/// Steps of the arclength, and points of a branch.
const FIRST_STEP: f64 = 0.01;
const LARGEST_STEP: f64 = 0.05;
const MOST_POINTS: usize = 2_000;

/// Points of a branch in the range: enough for a curve on a screen.
const POINTS: usize = 100;

/// How far above its birth a pair is picked up, relative: nearer first, unless an earlier impact forestalls it.
const ABOVE_BIRTH: [f64; 4] = [1e-3, 0.1, 0.5, 2.0];

/// A branch is followed to a multiple of its forcing, then its lengths are counted in the forcing that it has
/// there: for a nearly elastic disk they cover many decades.
const STRIDE: f64 = 2.0;

/// Branches are followed so far beyond the first doubling of their pair: all doublings lie there.
const BEYOND_DOUBLING: f64 = 2.0;

/// What a range of the forcing shows of a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchInRange {
    /// Impacts of an orbit on it; one whose vanishing impact has gone has one less.
    pub impacts: usize,
    /// Its parts in the range, each a curve.
    pub parts: Vec<Vec<BranchPoint>>,
    /// Its bifurcations there. A birth by doubling is one of the branch that doubles.
    pub bifurcations: Vec<Bifurcation>,
}

/// The branches with one impact in each period of the platform, in every second and in every third, and those that
/// double from them, up to four times, where they lie in a range of the axial forcing.
///
/// ```
/// use bouncing_disk_web::branches_over_forcing;
///
/// let branches = branches_over_forcing(0.5, (0.4, 0.45))?;
/// let stable: Vec<_> = branches.iter().map(|branch| branch.parts[0][0].is_stable()).collect();
/// assert_eq!(stable, [false, true]); // The saddle and the node of one impact in one period.
/// # Ok::<(), bouncing_disk::core::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for an empty range, and for an illegal forcing or restitution.
pub fn branches_over_forcing(restitution: f64, range: (f64, f64)) -> Result<Vec<BranchInRange>, Error> {
    // Checks the range and the restitution, whatever is born in it.
    settings(range, true)?;
    map(range.1, restitution)?;
    let mut found = Found { range, branches: Vec::new() };
    // Without restitution a disk forgets its past in each impact, and no such orbit can be continued.
    let pairs = if restitution > 0.0 { MOST_PERIODS } else { 0 };
    for periods in 1..=pairs {
        let birth = periods as f64 * (1.0 - restitution) / (1.0 + restitution);
        if birth >= range.1 {
            continue;
        }
        for above in ABOVE_BIRTH {
            let map = map(birth * (1.0 + above), restitution)?;
            let Some(pair) = map.period_one_pair(periods) else { continue };
            if let Some(node) = pair.node.orbit(&map)? {
                found.family(&map, &node, birth)?;
                break;
            }
        }
    }
    Ok(found.branches)
}

fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, Error> {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)
}

fn settings(range: (f64, f64), rising: bool) -> Result<Continuation, Error> {
    Continuation::new(ContinuationParameter::Forcing, range, rising)?.with_steps(
        FIRST_STEP,
        LARGEST_STEP,
        MOST_POINTS,
    )
}

/// A branch that the equations do not give is `None`; any other error is passed on.
fn if_any<T>(found: Result<T, Error>) -> Result<Option<T>, Error> {
    match found {
        Err(Error::NoBranch { .. }) => Ok(None),
        found => found.map(Some),
    }
}

struct Found {
    range: (f64, f64),
    branches: Vec<BranchInRange>,
}

impl Found {
    /// The branches through one that has just been born, both ways, and those that double from it in turn.
    fn family(&mut self, map: &ImpactMap, orbit: &PeriodicOrbit, birth: f64) -> Result<(), Error> {
        let forcing = map.vibration().axial_forcing();
        let (low, doubling) = (0.5 * birth, ImpactMap::first_doubling_forcing(map.restitution()));
        let enough = self.range.1.max(BEYOND_DOUBLING * (doubling + birth));
        // Back through the fold, on whose other side are the saddles, and on to the doublings.
        for rising in [false, true] {
            let range = (low, STRIDE * forcing);
            let Some(branch) = if_any(map.continued_from(orbit, &settings(range, rising)?, &Unobserved))?
            else {
                continue;
            };
            let pieces = self.followed(branch, low, enough)?;
            if rising {
                self.doublings(&pieces, low, enough)?;
            }
        }
        Ok(())
    }

    /// A branch and its continuations up to a forcing, piece by piece.
    fn followed(&mut self, branch: Branch, low: f64, enough: f64) -> Result<Vec<Branch>, Error> {
        let mut pieces = vec![branch];
        while let Some(last) = pieces.last() {
            let Some(tip) = last.points.last() else { break };
            if !matches!(last.end, BranchEnd::RangeLimit(limit) if limit > low && limit < enough) {
                break;
            }
            let forcing = tip.parameter;
            let range = (forcing, (STRIDE * forcing).min(enough));
            if range.0 >= range.1 {
                break;
            }
            let next = last.map_at(forcing)?.continued_from(&tip.orbit, &settings(range, true)?, &Unobserved);
            let Some(next) = if_any(next)? else { break };
            pieces.push(next);
        }
        for piece in &pieces {
            self.add(piece)?;
        }
        Ok(pieces)
    }

    fn doublings(&mut self, pieces: &[Branch], low: f64, enough: f64) -> Result<(), Error> {
        let mut pieces = pieces.to_vec();
        for _ in 0..DOUBLINGS {
            let doubling = pieces.iter().find_map(|piece| {
                let at = piece.bifurcations.iter().position(|one| one.kind == BifurcationKind::Doubling)?;
                Some((piece, at, piece.bifurcations[at].point.parameter))
            });
            let Some((piece, at, forcing)) = doubling else { break };
            let range = (low, (STRIDE * forcing).min(enough).max(forcing.next_up()));
            let Some(branch) = if_any(piece.switched(at, &settings(range, true)?, &Unobserved))? else {
                break;
            };
            // Its first point lies beyond the doubling: everything between them belongs to it, too.
            if let [first, second, ..] = branch.points.as_slice() {
                let back = second.parameter < first.parameter;
                let map = branch.map_at(first.parameter)?;
                if let Some(stem) =
                    if_any(map.continued_from(&first.orbit, &settings(range, back)?, &Unobserved))?
                {
                    self.add(&stem)?;
                }
            }
            pieces = self.followed(branch, low, enough)?;
        }
        Ok(())
    }

    fn add(&mut self, branch: &Branch) -> Result<(), Error> {
        let (low, high) = self.range;
        let Some(first) = branch.points.first() else { return Ok(()) };
        // The branch that doubles there has already reported this birth.
        let is_own = |one: &&Bifurcation| {
            (low..=high).contains(&one.point.parameter) && one.kind != BifurcationKind::Birth
        };
        let bifurcations: Vec<_> = branch.bifurcations.iter().filter(is_own).cloned().collect();
        let parts = within(branch, self.range, POINTS)?;
        if !parts.is_empty() || !bifurcations.is_empty() {
            self.branches.push(BranchInRange { impacts: first.orbit.period(), parts, bifurcations });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kinds and forcings of all bifurcations, and the curves.
    fn seen(restitution: f64, range: (f64, f64)) -> (Vec<(BifurcationKind, f64)>, Vec<Vec<BranchPoint>>) {
        let branches = branches_over_forcing(restitution, range).expect("legal");
        let bifurcations = branches.iter().flat_map(|branch| &branch.bifurcations);
        let bifurcations = bifurcations.map(|one| (one.kind, one.point.parameter)).collect();
        let parts: Vec<_> = branches.into_iter().flat_map(|branch| branch.parts).collect();
        for point in parts.iter().flatten() {
            assert!((range.0..=range.1).contains(&point.parameter), "{restitution} {range:?}: {point:?}");
        }
        (bifurcations, parts)
    }

    #[test]
    fn branches_go_through_the_doublings_of_the_cascade() {
        let (found, _) = seen(0.5, (0.3, 0.62));
        let is_there = |kind: BifurcationKind, wanted: f64| {
            found.iter().any(|(known, forcing)| *known == kind && (forcing - wanted).abs() < 1e-9)
        };
        // Birth at (1 - r)/(1 + r), and the first doubling in closed form.
        assert!(is_there(BifurcationKind::Fold, 1.0 / 3.0), "{found:?}");
        assert!(is_there(BifurcationKind::Doubling, ImpactMap::first_doubling_forcing(0.5)), "{found:?}");
        assert!(branches_over_forcing(0.5, (0.1, 0.2)).expect("legal").is_empty());
        for restitution in [0.0, 0.5, 0.999999] {
            for range in [(60.0, 60.1), (1e-3, 1e-2), (99.0, 100.0), (0.45, 0.45 + 1e-12), (0.7, 0.7 + 1e-12)]
            {
                seen(restitution, range);
            }
        }
    }

    #[test]
    fn the_same_branches_are_seen_whichever_range_looks_at_them() {
        let (all, _) = seen(0.5, (0.3, 0.62));
        for range in [(0.33, 0.34), (0.485, 0.4861), (0.49, 0.53), (0.54, 0.62), (0.5421, 0.5426)] {
            let (here, parts) = seen(0.5, range);
            let wanted: Vec<_> =
                all.iter().filter(|(_, forcing)| (range.0..=range.1).contains(forcing)).collect();
            assert_eq!(here.len(), wanted.len(), "{range:?}: {here:?}");
            for ((kind, forcing), (known, there)) in here.iter().zip(wanted) {
                assert!(kind == known && (forcing - there).abs() < 1e-12, "{range:?}: {kind:?} at {forcing}");
            }
            // Each is a curve: no step of it is wider than a few pixels of a screen.
            for pair in parts.iter().flat_map(|part| part.windows(2)) {
                let step = pair[1].parameter - pair[0].parameter;
                assert!(step.abs() < 0.05 * (range.1 - range.0), "{range:?}: {pair:?}");
            }
        }
        // Throughout: an orbit of two impacts that attracts, one of one impact that does not, and its saddle.
        let branches = branches_over_forcing(0.5, (0.49, 0.53)).expect("legal");
        let all: Vec<_> = branches
            .iter()
            .flat_map(|branch| &branch.parts)
            .map(|part| {
                let (first, last) = (&part[0], &part[part.len() - 1]);
                assert!((first.parameter - last.parameter).abs() > 0.04 - 1e-12);
                assert!(part.iter().all(|point| point.is_stable() == first.is_stable()));
                (first.orbit.period(), first.is_stable())
            })
            .collect();
        assert_eq!(all, [(1, false), (1, false), (2, true)]);
        // Right at a doubling, between two points of a branch, and where there is hardly one left.
        for (range, count) in [((0.48600, 0.48601), 3), ((0.45, 0.45 + 1e-12), 2), ((60.0, 60.1), 3)] {
            assert_eq!(seen(0.5, range).1.len(), count, "{range:?}");
        }
    }
}
