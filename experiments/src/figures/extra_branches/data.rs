//! The data of the figure.

use serde::{Deserialize, Serialize};

/// The data of the branches of periodic orbits.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraBranchesData {
    pub(super) restitution: f64,
    /// Γ of panel (a), that of Fig. 6, and of panel (b).
    pub(super) axial_forcing_ranges: [(f64, f64); 2],
    /// Impacts before those that are drawn, and impacts that are drawn at each Γ.
    pub(super) transient_impacts: usize,
    pub(super) examined_impacts: usize,
    /// Γ at which other orbits were searched for, and the most impacts and periods of these.
    pub(super) searched_axial_forcings: Vec<f64>,
    pub(super) searched_impacts: usize,
    pub(super) searched_periods: u64,
    /// The attractors that begin with one impact every k periods, followed upwards, k = 1, 2, ...
    pub(super) followed: Vec<Vec<Column>>,
    /// A disk that has been at rest.
    pub(super) from_rest: Vec<Column>,
    pub(super) curves: Vec<Curve>,
    pub(super) marks: Vec<Mark>,
    pub(super) pairs: Vec<Pair>,
    /// The doublings of the branches that double from one to the next, and by the search of the cascade.
    pub(super) doublings: Vec<CascadePoint>,
    pub(super) settled: Settled,
    pub(super) starts: Settled,
    pub(super) search_orbits: usize,
    pub(super) search_orbits_on_branches: usize,
}

/// Impacts at one forcing.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Column {
    pub(super) axial_forcing: f64,
    pub(super) impact_phase_cycles: Vec<f64>,
}

/// Where a branch comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Family {
    /// One impact every so many periods: the saddle, the fold, and the node.
    PeriodOne(u64),
    /// Begins in a doubling of the branch of half its impacts.
    Doubled,
    /// Found by the search.
    Other,
}

/// A branch, from one end to the other.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Curve {
    pub(super) family: Family,
    /// Impacts and periods of the platform in one period of the orbits.
    pub(super) impacts: usize,
    pub(super) platform_periods: u64,
    pub(super) axial_forcings: Vec<f64>,
    /// Whether the orbits between two neighbouring points attract.
    pub(super) stable: Vec<bool>,
    /// The phases of each impact at all points.
    pub(super) impact_phase_cycles: Vec<Vec<f64>>,
    /// Whether it ends within the ranges in a bifurcation (false: at their limits, or closed), at both ends.
    pub(super) ends_in_bifurcation: [bool; 2],
    /// Whether it was lost without a reason.
    pub(super) lost: bool,
}

/// What happens at a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum MarkKind {
    Fold,
    Doubling,
    Graze,
    VanishingImpact,
}

/// A special point of a branch.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Mark {
    pub(super) kind: MarkKind,
    pub(super) family: Family,
    pub(super) impacts: usize,
    pub(super) platform_periods: u64,
    pub(super) axial_forcing: f64,
    pub(super) impact_phase_cycles: Vec<f64>,
}

/// The special points of the pair of one impact every k periods, and by other ways.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Pair {
    pub(super) platform_periods: u64,
    pub(super) fold: Option<f64>,
    pub(super) fold_in_closed_form: f64,
    pub(super) doubling: Option<f64>,
    pub(super) doubling_in_closed_form: f64,
    /// The graze of the saddle, and the Γ above which the exact map has an earlier impact.
    pub(super) saddle_graze: Option<f64>,
    pub(super) saddle_admissible_up_to: Option<f64>,
}

/// A doubling of the cascade.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct CascadePoint {
    pub(super) impacts: usize,
    pub(super) axial_forcing: f64,
    pub(super) of_cascade: f64,
}

/// How orbits that have settled compare with the branches.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Settled {
    /// Orbits that were followed.
    pub(super) orbits: usize,
    /// Those that settled on a periodic orbit of as few impacts as the branches have.
    pub(super) periodic: usize,
    /// Those of them that lie on a stable part of a branch.
    pub(super) on_stable: usize,
    /// Their largest distance from it (rad, and relative speed).
    pub(super) distance: f64,
    /// Γ, impacts and periods of the first ones that lie on none.
    pub(super) missed: Vec<(f64, u64, u64)>,
}

impl ExtraBranchesData {
    pub(super) fn caption(&self) -> String {
        let attracting = |curve: &&Curve| curve.stable.iter().any(|stable| *stable);
        let others = self.curves.iter().filter(|curve| curve.family == Family::Other);
        format!(
            "Branches of periodic orbits over the orbit diagram (grey; light: of a disk that has been at rest) for ε = {}: solid \
             where they attract, dashed where not. Black: one impact every k periods, from the graze of the saddle through the fold to the node; \
             blue: the orbits that double from it; green: the others with at most {} impacts in {} periods that a search at {} values of Γ \
             found, {} branches, of which {} attract somewhere. (a) The range of Fig. 6; (b) beyond, with the pairs up to k = {} alone and the orbits of two \
             impacts that they double to. The phase is drawn from −0.3 on, so that both orbits of a pair meet.",
            self.restitution,
            self.searched_impacts,
            self.searched_periods,
            self.searched_axial_forcings.len(),
            others.clone().count(),
            others.filter(attracting).count(),
            self.pairs.len(),
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        let [narrow, wide] = self.axial_forcing_ranges;
        [
            ("ε", self.restitution.to_string()),
            ("Γ", format!("(a) {} to {}, (b) {} to {}", narrow.0, narrow.1, wide.0, wide.1)),
            ("transient", format!("{} impacts", self.transient_impacts)),
            ("drawn at each Γ", format!("{} impacts", self.examined_impacts)),
            (
                "search",
                format!(
                    "at most {} impacts in {} periods, at Γ = {}",
                    self.searched_impacts,
                    self.searched_periods,
                    self.searched_axial_forcings.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
                ),
            ),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
