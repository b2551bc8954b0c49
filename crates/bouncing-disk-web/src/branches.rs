//! Branches of periodic orbits over the forcing, stable and unstable.
//!
//! The branches and their bifurcations do not depend on the visible window: each is
//! followed from its birth on, and the window gets its own points of it.

use bouncing_disk::core::orbits::{
    BifurcationKind, Branch, BranchEnd, Continuation, ContinuationParameter, PeriodicOrbit,
};
use bouncing_disk::core::{Error as CoreError, ImpactMap, Unobserved};
use serde_json::{Value, json};

use crate::reply::{Refusal, Reply};
use crate::request::map;

/// Pairs with one impact every k periods up to this k, and the branches that double from each.
const MOST_PERIODS: u64 = 3;
const DOUBLINGS: usize = 4;

/// Steps of the arclength, and points of a branch.
const FIRST_STEP: f64 = 0.01;
const LARGEST_STEP: f64 = 0.05;
const MOST_POINTS: usize = 2_000;

/// Points of a branch in the window: enough for a curve on a screen.
const POINTS: usize = 100;

/// How far above its birth a pair is picked up, relative: nearer first, unless an earlier impact forestalls it.
const ABOVE_BIRTH: [f64; 4] = [1e-3, 0.1, 0.5, 2.0];

/// A branch is followed to a multiple of its forcing, then its lengths are counted in the forcing that it has
/// there: those of a nearly elastic disk go over many decades.
const STRIDE: f64 = 2.0;

/// Branches are followed so far beyond the first doubling of their pair: all doublings lie there.
const BEYOND_DOUBLING: f64 = 2.0;

/// How many branches there are in a window, and their bifurcations with the first impact of the orbit there. Numbers: rows
/// of the forcing, the phase (rad) and the normalised speed of one impact of an orbit on a branch, the number of the
/// branch, 1 where the orbit is stable, and the number of the line: one impact along one part of the branch. The rows of
/// a line follow each other.
pub(crate) fn answer(restitution: f64, axial_forcing: [f64; 2]) -> Result<Reply, Refusal> {
    let window = (axial_forcing[0], axial_forcing[1]);
    // Checks the window and the restitution, whatever is born in it.
    settings(window, true)?;
    map(window.1, restitution)?;
    let mut found = Found { window, branches: 0, bifurcations: vec![], numbers: vec![], lines: 0 };
    // Without restitution a disk forgets its past in each impact: the library does not continue such orbits.
    let pairs = if restitution > 0.0 { MOST_PERIODS } else { 0 };
    for periods in 1..=pairs {
        let birth = periods as f64 * (1.0 - restitution) / (1.0 + restitution);
        if birth >= window.1 {
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
    let json = json!({ "branches": found.branches, "bifurcations": found.bifurcations });
    Reply::new(&json, found.numbers, Vec::new())
}

fn settings(range: (f64, f64), rising: bool) -> Result<Continuation, CoreError> {
    Continuation::new(ContinuationParameter::Forcing, range, rising)?.with_steps(
        FIRST_STEP,
        LARGEST_STEP,
        MOST_POINTS,
    )
}

/// A branch that the equations do not give is `None`; any other error is passed on.
fn if_any<T>(found: Result<T, CoreError>) -> Result<Option<T>, CoreError> {
    match found {
        Err(CoreError::NoBranch { .. }) => Ok(None),
        found => found.map(Some),
    }
}

struct Found {
    window: (f64, f64),
    branches: usize,
    bifurcations: Vec<Value>,
    numbers: Vec<f64>,
    lines: usize,
}

impl Found {
    /// The branches through one that has just been born, both ways, and those that double from it in turn.
    fn family(&mut self, map: &ImpactMap, orbit: &PeriodicOrbit, birth: f64) -> Result<(), Refusal> {
        let forcing = map.vibration().axial_forcing();
        let (low, doubling) = (0.5 * birth, ImpactMap::first_doubling_forcing(map.restitution()));
        let enough = self.window.1.max(BEYOND_DOUBLING * (doubling + birth));
        // Back through the fold, on whose other side are the saddles, and on to the doublings.
        for rising in [false, true] {
            let range = (low, STRIDE * forcing);
            let Some(branch) = if_any(map.continued(orbit, &settings(range, rising)?, &Unobserved))? else {
                continue;
            };
            let pieces = self.followed(branch, low, enough)?;
            if rising {
                self.doublings(&pieces, low, enough)?;
            }
        }
        Ok(())
    }

    /// A branch and all that it goes on with up to a forcing, piece by piece.
    fn followed(&mut self, branch: Branch, low: f64, enough: f64) -> Result<Vec<Branch>, Refusal> {
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
            let next = last.map_at(forcing)?.continued(&tip.orbit, &settings(range, true)?, &Unobserved);
            let Some(next) = if_any(next)? else { break };
            pieces.push(next);
        }
        for piece in &pieces {
            self.add(piece)?;
        }
        Ok(pieces)
    }

    fn doublings(&mut self, pieces: &[Branch], low: f64, enough: f64) -> Result<(), Refusal> {
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
            // Its first point lies beyond the doubling: what is between them belongs to it, too.
            if let [first, second, ..] = branch.points.as_slice() {
                let back = second.parameter < first.parameter;
                let map = branch.map_at(first.parameter)?;
                if let Some(stem) = if_any(map.continued(&first.orbit, &settings(range, back)?, &Unobserved))?
                {
                    self.add(&stem)?;
                }
            }
            pieces = self.followed(branch, low, enough)?;
        }
        Ok(())
    }

    fn add(&mut self, branch: &Branch) -> Result<(), Refusal> {
        let (low, high) = self.window;
        let Some(first) = branch.points.first() else { return Ok(()) };
        let impacts = first.orbit.period();
        let here = branch.bifurcations.iter().filter(|one| (low..=high).contains(&one.point.parameter));
        let parts = branch.within(self.window, POINTS)?;
        // The branch that doubles there has already reported this birth.
        let here: Vec<_> = here.filter(|one| one.kind != BifurcationKind::Birth).collect();
        if parts.is_empty() && here.is_empty() {
            return Ok(());
        }
        for part in &parts {
            for impact in 0..impacts {
                for point in part {
                    // An orbit whose vanishing impact has gone has one less.
                    let Some(state) = point.orbit.states.get(impact) else { continue };
                    let stable = f64::from(u8::from(point.is_stable()));
                    let (phase, speed) = (state.phase().angle(), state.normalised_speed());
                    let line = self.lines as f64;
                    self.numbers.extend([point.parameter, phase, speed, self.branches as f64, stable, line]);
                }
                self.lines += 1;
            }
        }
        self.branches += 1;
        self.bifurcations.extend(here.iter().filter_map(|found| {
            let state = found.point.orbit.states.first()?;
            Some(json!({
                "kind": found.kind.name(),
                "axial_forcing": found.point.parameter,
                "impact_phase": state.phase().angle(),
                "normalised_speed": state.normalised_speed(),
            }))
        }));
        Ok(())
    }
}
