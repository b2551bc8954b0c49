//! The branches: the pairs of one impact, what doubles from them, and what a search finds besides.

use bouncing_disk::core::{
    Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint, Continuation, ContinuationParameter, Error,
    ImpactMap, ImpactState, OrbitSearch, PeriodicOrbit, Phase, Vibration,
};
use rayon::prelude::*;

use super::data::Family;

/// So far above its birth a pair is picked up: below its doubling, which is 0.046 above it for k = 4.
const ABOVE_BIRTH: f64 = 0.02;

/// The first and the largest step of a continuation (arclength).
const STEPS: (f64, f64) = (0.002, 0.02);

/// The most points of a branch.
const MOST_POINTS: usize = 20_000;

/// Orbits nearer than this (rad, and relative speed) are one.
pub(super) const SAME: f64 = 1e-6;

/// Special points with forcings nearer than this are one.
const SAME_BIFURCATION: f64 = 1e-9;

/// How far (rad, and relative speed) an orbit may be from what its neighbours on the branch promise.
const NEAR: f64 = 0.05;

/// A point of a branch; bifurcations between two of them are points, too, and have no stability.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub(super) point: BranchPoint,
    special: bool,
}

/// A branch from one end to the other.
#[derive(Clone, Debug)]
pub(super) struct Walked {
    pub(super) family: Family,
    pub(super) joints: Vec<Joint>,
    pub(super) bifurcations: Vec<Bifurcation>,
    pub(super) ends: [BranchEnd; 2],
}

pub(super) fn map(axial_forcing: f64, restitution: f64) -> Result<ImpactMap, Error> {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing)?, restitution)
}

fn settings((low, high): (f64, f64), rising: bool) -> Result<Continuation, Error> {
    Continuation::new(ContinuationParameter::Forcing, (low, high), rising)?.with_steps(
        STEPS.0,
        STEPS.1,
        MOST_POINTS,
    )
}

/// A point as one of the orbit gone through twice.
fn twice(point: &BranchPoint) -> BranchPoint {
    let mut doubled = point.clone();
    doubled.orbit.states.extend_from_slice(&point.orbit.states);
    doubled.orbit.platform_periods *= 2;
    doubled
}

/// Points and bifurcations of one continuation, in their order.
fn joints(branch: &Branch) -> Vec<Joint> {
    let regular = branch.points.iter().map(|point| Joint { point: point.clone(), special: false });
    let special = branch.bifurcations.iter().map(|found| {
        let point = match found.kind {
            BifurcationKind::Birth => twice(&found.point),
            _ => found.point.clone(),
        };
        Joint { point, special: true }
    });
    let mut all: Vec<_> = regular.chain(special).collect();
    all.sort_by(|a, b| a.point.arclength.total_cmp(&b.point.arclength));
    all
}

impl Walked {
    /// Through an orbit, both ways.
    fn through(
        family: Family,
        map: &ImpactMap,
        orbit: &PeriodicOrbit,
        range: (f64, f64),
    ) -> Result<(Self, Branch), Error> {
        let falling = map.continued(orbit, &settings(range, false)?)?;
        let rising = map.continued(orbit, &settings(range, true)?)?;
        let mut path = joints(&falling);
        path.reverse();
        path.extend(joints(&rising).into_iter().skip(1));
        let bifurcations = falling.bifurcations.iter().chain(&rising.bifurcations).cloned().collect();
        Ok((Self { family, joints: path, bifurcations, ends: [falling.end, rising.end] }, rising))
    }

    /// The branch of twice the period from the first doubling of another one; `None` if it does not double.
    fn doubled(parent: &Branch, range: (f64, f64)) -> Result<Option<(Self, Branch)>, Error> {
        let doubles = |found: &Bifurcation| found.kind == BifurcationKind::Doubling;
        let Some(index) = parent.bifurcations.iter().position(doubles) else { return Ok(None) };
        let branch = parent.switched(index, &settings(range, true)?)?;
        let start = Joint { point: twice(&parent.bifurcations[index].point), special: true };
        let path = std::iter::once(start).chain(joints(&branch)).collect();
        let ends = [BranchEnd::Bifurcation, branch.end];
        let walked =
            Self { family: Family::Doubled, joints: path, bifurcations: branch.bifurcations.clone(), ends };
        Ok(Some((walked, branch)))
    }

    /// Whether both have the same special points, of which there are some.
    fn has_bifurcations_of(&self, other: &Self) -> bool {
        let sorted = |walked: &Self| {
            let mut forcings: Vec<f64> =
                walked.bifurcations.iter().map(|found| found.point.parameter).collect();
            forcings.sort_by(f64::total_cmp);
            forcings
        };
        let (own, others) = (sorted(self), sorted(other));
        (self.impacts(), self.platform_periods()) == (other.impacts(), other.platform_periods())
            && !own.is_empty()
            && own.len() == others.len()
            && own.iter().zip(&others).all(|(a, b)| (a - b).abs() < SAME_BIFURCATION)
    }

    /// Whether the orbits between a point and the next attract.
    pub(super) fn stable_after(&self, index: usize) -> bool {
        match &self.joints[index..] {
            [one, ..] if !one.special => one.point.is_stable(),
            [_, other, ..] if !other.special => other.point.is_stable(),
            _ => false,
        }
    }

    pub(super) fn impacts(&self) -> usize {
        self.joints[0].point.orbit.period()
    }

    pub(super) fn platform_periods(&self) -> u64 {
        self.joints[0].point.orbit.platform_periods
    }

    /// The orbits of this branch at a forcing, and whether each attracts.
    pub(super) fn orbits_at(&self, map: &ImpactMap) -> Vec<(PeriodicOrbit, bool)> {
        let forcing = map.vibration().axial_forcing();
        let mut found = Vec::new();
        for (index, pair) in self.joints.windows(2).enumerate() {
            let (from, to) = (pair[0].point.parameter, pair[1].point.parameter);
            if (from <= forcing) == (to <= forcing) {
                continue;
            }
            let share = (forcing - from) / (to - from);
            let between = pair[0].point.orbit.states.iter().zip(&pair[1].point.orbit.states);
            let guess: Option<Vec<ImpactState>> = between.map(|(a, b)| interpolated(a, b, share)).collect();
            let Some(guess) = guess else { continue };
            let Ok(orbit) = map.refine(&guess) else { continue };
            if orbit.states.iter().zip(&guess).all(|(found, expected)| distance(found, expected) < NEAR) {
                found.push((orbit, self.stable_after(index)));
            }
        }
        found
    }
}

/// A state between two, the shorter way round the circle.
fn interpolated(a: &ImpactState, b: &ImpactState, share: f64) -> Option<ImpactState> {
    let turned = difference(b.phase(), a.phase());
    let phase = Phase::new(a.phase().angle() + share * turned).ok()?;
    ImpactState::new(phase, a.velocity() + share * (b.velocity() - a.velocity())).ok()
}

/// The smaller way from one phase to another, in (-π, π] but for rounding.
fn difference(to: Phase, from: Phase) -> f64 {
    let cycles = to.cycles() - from.cycles();
    std::f64::consts::TAU * (cycles - cycles.round())
}

/// How far two impacts are apart: rad, or relative speed.
pub(super) fn distance(a: &ImpactState, b: &ImpactState) -> f64 {
    let speeds = (a.velocity() - b.velocity()).abs() / (1.0 + b.velocity().abs());
    difference(a.phase(), b.phase()).abs().max(speeds)
}

/// All branches that are drawn.
pub(super) struct Branches {
    pub(super) all: Vec<Walked>,
    /// The continuations of the node k = 1 and of what doubles from it, one from another.
    pub(super) cascade: Vec<Branch>,
    pub(super) search_orbits: usize,
    pub(super) on_known_branches: usize,
}

/// The pairs up to k, `doublings` branches that double from k = 1, and the orbits of two impacts that double
/// from the other pairs, over `wide`.
pub(super) fn pairs(
    restitution: f64,
    wide: (f64, f64),
    most_periods: u64,
    doublings: usize,
) -> Result<Branches, Error> {
    let (mut all, mut cascade) = (Vec::new(), Vec::new());
    for k in 1..=most_periods {
        let birth = k as f64 * (1.0 - restitution) / (1.0 + restitution);
        let map = map(birth + ABOVE_BIRTH, restitution)?;
        let node = match map.period_one_pair(k) {
            Some(pair) => pair.node.orbit(&map)?,
            None => None,
        };
        let Some(node) = node else { continue };
        let (walked, mut last) = Walked::through(Family::PeriodOne(k), &map, &node, wide)?;
        all.push(walked);
        for _ in 0..if k == 1 { doublings } else { 1 } {
            let Some((walked, branch)) = Walked::doubled(&last, wide)? else { break };
            all.push(walked);
            let parent = std::mem::replace(&mut last, branch);
            if k == 1 {
                cascade.push(parent);
            }
        }
        if k == 1 {
            cascade.push(last);
        }
    }
    Ok(Branches { all, cascade, search_orbits: 0, on_known_branches: 0 })
}

/// Adds the branches, over `narrow`, of all orbits that a search at these forcings finds and no branch has.
pub(super) fn add_searched(
    branches: &mut Branches,
    restitution: f64,
    forcings: &[f64],
    search: &OrbitSearch,
    narrow: (f64, f64),
) -> Result<(), Error> {
    let searched = forcings
        .par_iter()
        .map(|forcing| {
            let map = map(*forcing, restitution)?;
            Ok((map, map.periodic_orbits(search)?.orbits))
        })
        .collect::<Result<Vec<_>, Error>>()?;
    for (map, orbits) in searched {
        for orbit in orbits {
            branches.search_orbits += 1;
            let known = branches.all.iter().any(|walked| {
                walked.impacts() == orbit.period()
                    && walked.orbits_at(&map).iter().any(|(own, _)| {
                        own.states.iter().any(|state| distance(state, &orbit.states[0]) < SAME)
                    })
            });
            if known {
                branches.on_known_branches += 1;
                continue;
            }
            let walked = Walked::through(Family::Other, &map, &orbit, narrow)?.0;
            // Next to the end of a branch its orbits are not found again from their neighbours.
            if branches.all.iter().any(|own| own.has_bifurcations_of(&walked)) {
                branches.on_known_branches += 1;
            } else {
                branches.all.push(walked);
            }
        }
    }
    Ok(())
}
