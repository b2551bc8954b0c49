//! Branches of periodic orbits over the forcing, stable and unstable.

use bouncing_disk::core::{
    BifurcationKind, Branch, BranchEnd, Continuation, ContinuationParameter, Error as CoreError,
    PeriodicOrbit,
};
use serde::Serialize;

use crate::refusal::Refusal;
use crate::reply::Reply;
use crate::request::map;

/// Pairs with one impact every k periods up to this k, and the branches that double from each.
const MOST_PERIODS: u64 = 3;
const DOUBLINGS: usize = 3;

/// Steps of the arclength, and points of a branch: enough for a curve on a screen.
const FIRST_STEP: f64 = 0.01;
const LARGEST_STEP: f64 = 0.05;
const MOST_POINTS: usize = 2_000;

/// How far above its birth a pair is picked up, relative.
const ABOVE_BIRTH: f64 = 1e-3;

#[derive(Debug, Serialize)]
struct BranchesJson {
    branches: Vec<BranchJson>,
    bifurcations: Vec<BifurcationJson>,
}

#[derive(Debug, Serialize)]
struct BranchJson {
    impacts: usize,
    platform_periods: u64,
    end: String,
}

#[derive(Debug, Serialize)]
struct BifurcationJson {
    kind: &'static str,
    axial_forcing: f64,
    branch: usize,
}

pub(crate) fn answer(restitution: f64, axial_forcing: [f64; 2]) -> Result<Reply, Refusal> {
    let range = (axial_forcing[0], axial_forcing[1]);
    // Checks the range, whatever is born in it.
    settings(range, true)?;
    let mut found = Found { json: BranchesJson { branches: vec![], bifurcations: vec![] }, numbers: vec![] };
    for periods in 1..=MOST_PERIODS {
        let birth = periods as f64 * (1.0 - restitution) / (1.0 + restitution);
        let begin = range.0.max(birth * (1.0 + ABOVE_BIRTH));
        if begin >= range.1 {
            continue;
        }
        let map = map(begin, restitution)?;
        let Some(pair) = map.period_one_pair(periods) else { continue };
        if let Some(node) = pair.node.orbit(&map)? {
            found.family(&map, &node, range)?;
        }
        // Where the fold is in the range, the branch goes through it and holds the saddles.
        let through = range.0 < birth;
        if let Some(saddle) = pair.saddle.orbit(&map)?.filter(|_| !through) {
            found.add(&map.continued(&saddle, &settings(range, true)?)?);
        }
    }
    Reply::new(&found.json, found.numbers, Vec::new())
}

fn settings(range: (f64, f64), rising: bool) -> Result<Continuation, CoreError> {
    Continuation::new(ContinuationParameter::Forcing, range, rising)?.with_steps(
        FIRST_STEP,
        LARGEST_STEP,
        MOST_POINTS,
    )
}

struct Found {
    json: BranchesJson,
    numbers: Vec<f64>,
}

impl Found {
    /// The branch through an orbit both ways, and those that double from it one after the other.
    fn family(
        &mut self,
        map: &bouncing_disk::core::ImpactMap,
        orbit: &PeriodicOrbit,
        range: (f64, f64),
    ) -> Result<(), Refusal> {
        if range.0 < map.vibration().axial_forcing() {
            self.add(&map.continued(orbit, &settings(range, false)?)?);
        }
        let mut branch = map.continued(orbit, &settings(range, true)?)?;
        self.add(&branch);
        for _ in 0..DOUBLINGS {
            let doubling = |kind: &BifurcationKind| *kind == BifurcationKind::Doubling;
            let Some(index) = branch.bifurcations.iter().position(|found| doubling(&found.kind)) else {
                break;
            };
            branch = branch.switched(index, &settings(range, true)?)?;
            self.add(&branch);
        }
        Ok(())
    }

    fn add(&mut self, branch: &Branch) {
        let Some(first) = branch.points.first() else { return };
        let number = self.json.branches.len();
        for impact in 0..first.orbit.period() {
            for point in &branch.points {
                // An orbit whose vanishing impact has gone has one less.
                let Some(state) = point.orbit.states.get(impact) else { continue };
                let stable = f64::from(u8::from(point.is_stable()));
                let (phase, speed) = (state.phase().angle(), state.normalised_speed());
                self.numbers.extend([point.parameter, phase, speed, number as f64, stable]);
            }
        }
        self.json.branches.push(BranchJson {
            impacts: first.orbit.period(),
            platform_periods: first.orbit.platform_periods,
            end: end(&branch.end),
        });
        self.json.bifurcations.extend(branch.bifurcations.iter().map(|found| BifurcationJson {
            kind: kind(&found.kind),
            axial_forcing: found.point.parameter,
            branch: number,
        }));
    }
}

const fn kind(kind: &BifurcationKind) -> &'static str {
    match kind {
        BifurcationKind::Doubling => "doubling",
        BifurcationKind::Fold => "fold",
        BifurcationKind::Graze { .. } => "graze",
        BifurcationKind::VanishingImpact { .. } => "vanishing impact",
        BifurcationKind::Birth => "birth",
        _ => "unknown",
    }
}

fn end(end: &BranchEnd) -> String {
    match end {
        BranchEnd::RangeLimit(_) => "the end of the range".to_owned(),
        BranchEnd::Bifurcation => "a bifurcation".to_owned(),
        BranchEnd::Closed => "its own start".to_owned(),
        BranchEnd::PointLimit(points) => format!("the limit of {points} points"),
        BranchEnd::StepTooSmall(_) => "no next point".to_owned(),
        _ => "unknown".to_owned(),
    }
}
