//! The data of the figure.

use bouncing_disk::core::{AttractorSearch, BasinEntropy, BoundaryFit, BoundaryScaling};
use serde::{Deserialize, Serialize};

/// The data of the attractors over the forcing and at one of them.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraAttractorsData {
    /// How they were looked for.
    pub(super) search: AttractorSearch,
    /// The farthest that an attractor may move from one Γ to the next (rad).
    pub(super) reach: f64,
    /// One restitution each.
    pub(super) sweeps: Vec<Sweep>,
    pub(super) basins: BasinsAt,
    /// Boundaries at three pairs of Γ and restitution, the last one that of the basins.
    pub(super) boundaries: Vec<Boundary>,
}

/// How fractal the boundaries of basins are, up to the bound of the impact speed.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Boundary {
    pub(super) axial_forcing: f64,
    pub(super) restitution: f64,
    pub(super) undecided_cells: u64,
    pub(super) entropy: BasinEntropy,
    pub(super) scaling: BoundaryScaling,
}

impl Boundary {
    /// What the power law is, in words.
    pub(super) fn fit(&self) -> String {
        match self.scaling.fit {
            BoundaryFit::PowerLaw { dimension, standard_error, .. } => {
                format!("dimension {dimension:.2} ± {standard_error:.2}")
            }
            BoundaryFit::NoPowerLaw { slopes } => {
                format!("no power law, with slopes from {:.2} to {:.2}", slopes.0, slopes.1)
            }
            _ => "too few uncertain cells".to_owned(),
        }
    }

    /// Γ, restitution, power law and entropies, in words.
    pub(super) fn words(&self) -> String {
        format!(
            "Γ = {}, restitution {}: {}, S_b = {:.3}, S_bb = {}",
            self.axial_forcing,
            self.restitution,
            self.fit(),
            self.entropy.entropy,
            self.entropy.boundary_entropy.map_or("none".to_owned(), |own| format!("{own:.3}")),
        )
    }
}

/// The attractors over the forcing for one restitution.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Sweep {
    pub(super) restitution: f64,
    pub(super) axial_forcings: Vec<f64>,
    /// The attractors at each Γ.
    pub(super) found: Vec<Vec<Found>>,
    /// The first and last Γ, by their numbers, at which each attractor that is followed was found.
    pub(super) followed: Vec<(usize, usize)>,
    /// The Γ at which a disk that has come to rest never does so again.
    pub(super) rest_is_left: Vec<f64>,
    /// Starts that ended on no attractor, over all Γ.
    pub(super) undecided_starts: u64,
}

/// An attractor.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Found {
    pub(super) kind: Kind,
    /// Impacts and platform periods of a periodic one.
    pub(super) period: Option<(usize, u64)>,
    /// Its number among those that are followed.
    pub(super) followed: usize,
    /// The starts that ended on it, all starts, and the 95 % interval of the share.
    pub(super) starts: (u64, u64),
    pub(super) interval: (f64, f64),
}

/// What is drawn alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Kind {
    Rest,
    /// So many platform periods as impacts, twice, three times, four times or more as many.
    Once,
    Twice,
    Thrice,
    Longer,
    /// Another ratio.
    Mixed,
    Chaotic,
    Unclassified,
}

/// The basins at one forcing.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct BasinsAt {
    pub(super) restitution: f64,
    pub(super) axial_forcing: f64,
    /// Top of |w_A Γ/(ωA)|: the bound of every attractor.
    pub(super) top: f64,
    pub(super) cells: usize,
    pub(super) max_impacts: u32,
    pub(super) found: Vec<Found>,
    /// The labels, row by row: of each column a letter, `a` for an undecided one, `b` for rest, and so on.
    pub(super) rows: Vec<String>,
    pub(super) undecided_cells: u64,
    /// Cells of each attractor inside the trapping region, and all there are.
    pub(super) cells_in_region: Vec<u64>,
    pub(super) region: u64,
}

impl Found {
    pub(super) fn share(&self) -> f64 {
        self.starts.0 as f64 / self.starts.1.max(1) as f64
    }

    pub(super) fn name(&self) -> String {
        match (self.kind, self.period) {
            (Kind::Rest, _) => "rest".to_owned(),
            (_, Some((impacts, periods))) => format!("{impacts}/{periods}"),
            (Kind::Chaotic, None) => "chaotic".to_owned(),
            (_, None) => "unclassified".to_owned(),
        }
    }
}

impl Sweep {
    /// The most attractors beside rest at one Γ, and the first such Γ.
    pub(super) fn most(&self) -> (usize, f64) {
        let counts = self.found.iter().map(|found| found.len() - 1).zip(&self.axial_forcings);
        counts.fold(
            (0, f64::NAN),
            |most, (count, forcing)| if count > most.0 { (count, *forcing) } else { most },
        )
    }

    /// How many Γ have several attractors beside rest.
    pub(super) fn several(&self) -> usize {
        self.found.iter().filter(|found| found.len() > 2).count()
    }
}

impl ExtraAttractorsData {
    pub(super) fn caption(&self) -> String {
        let basins = &self.basins;
        let boundaries: Vec<String> = self.boundaries.iter().map(Boundary::words).collect();
        let (first, second) = (self.sweeps.first(), self.sweeps.get(1));
        let restitution = |sweep: Option<&Sweep>| sweep.map_or(0.0, |sweep| sweep.restitution);
        format!(
            "All attractors of a disk, found without being told, for the restitutions (a) {} and (b) {}: the share of the \
             starts that end on each (95 % intervals are in the data, and drawn where forcings are few), {} starts spread evenly over the region of impacts that no attractor can leave. Colours: \
             platform periods for each impact. (c) Basins at Γ = {} and restitution {}, up to the proven bound of the impact speed; the key \
             gives impacts and platform periods of each attractor. (d) Share of the cells with another label than their own \
             within a distance, lines where it is a power of it: {}. The entropies S_b, and S_bb at the boundaries, are over boxes of {} cells a side.",
            restitution(first),
            restitution(second),
            self.search.starts(),
            basins.axial_forcing,
            basins.restitution,
            boundaries.join("; "),
            self.boundaries.first().map_or(0, |own| own.entropy.box_side),
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        let forcings = |sweep: &Sweep| sweep.axial_forcings.len().to_string();
        [
            ("Γ of (a)", self.sweeps.first().map_or_else(String::new, forcings)),
            ("Γ of (b)", self.sweeps.get(1).map_or_else(String::new, forcings)),
            ("starts", self.search.starts().to_string()),
            ("transient", format!("{} impacts", self.search.transient())),
            ("impacts of an attractor without period", self.search.impacts().to_string()),
            ("cells of (c)", format!("{0} by {0}", self.basins.cells)),
            ("impacts before a cell is undecided", self.basins.max_impacts.to_string()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
