//! The data of the figure.

use serde::{Deserialize, Serialize};

/// An impact: phase in periods and normalised speed |w_A Γ/(ωA)|.
pub(super) type Spot = (f64, f64);

/// The data of the manifolds over the basins.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraManifoldsData {
    pub(super) restitution: f64,
    /// Top of the window of speeds, and cells a side.
    pub(super) window_top: f64,
    pub(super) cells: usize,
    pub(super) panels: Vec<Panel>,
    pub(super) third: ThirdAttractor,
}

/// The basins at one forcing, and what is drawn over them.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Panel {
    pub(super) axial_forcing: f64,
    /// What becomes of the cells, row by row: 0 comes to rest, 1 does not or is on the orbit that a saddle is born with,
    /// 2 is on another periodic orbit.
    pub(super) rows: Vec<String>,
    /// The stable manifolds, piece by piece, and the saddles.
    pub(super) manifolds: Vec<Vec<Spot>>,
    pub(super) saddles: Vec<Spot>,
    /// Length of the manifolds (in the units of the core).
    pub(super) arclength: f64,
    /// Pairs of starts on both sides of a manifold: how many there are, and how many become different things.
    pub(super) pairs: usize,
    pub(super) different: usize,
    /// Borders between cells that become different things, and how many of them lie within a cell of a manifold.
    pub(super) borders: usize,
    pub(super) borders_on_manifold: usize,
}

/// Where the third attractor at the second forcing comes from and what it becomes, in Γ.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ThirdAttractor {
    /// Its impacts.
    pub(super) impacts: usize,
    /// The fold in which an orbit of half its impacts is born with a saddle.
    pub(super) fold: f64,
    /// The doubling of that orbit, in which it is born.
    pub(super) birth: f64,
    /// Its own doubling.
    pub(super) doubling: f64,
}

impl Panel {
    /// The share of the borders that lie on a manifold.
    pub(super) fn share_of_borders(&self) -> f64 {
        self.borders_on_manifold as f64 / self.borders.max(1) as f64
    }
}

impl ExtraManifoldsData {
    pub(super) fn caption(&self) -> String {
        let shares: Vec<String> =
            self.panels.iter().map(|panel| format!("{:.1} %", 100.0 * panel.share_of_borders())).collect();
        format!(
            "Stable manifolds (blue) of the saddle of one impact in each period of the platform (red), and at Γ = {} also of the saddle that is \
             born with the third attractor, over the basins of Fig. 7: white, starts that come to rest; gray, those that do not; \
             dark gray, those on another periodic orbit. Within one cell of the manifolds lie {} of the borders between the basins. The \
             third attractor, an orbit of {} impacts, comes from one of {} that is born in a fold at Γ = {:.9}, doubles its period at \
             {:.9}, and doubles again at {:.9}.",
            self.panels.get(1).map_or(0.0, |panel| panel.axial_forcing),
            shares.join(", "),
            self.third.impacts,
            self.third.impacts / 2,
            self.third.fold,
            self.third.birth,
            self.third.doubling,
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        let forcings: Vec<String> = self.panels.iter().map(|panel| panel.axial_forcing.to_string()).collect();
        let lengths: Vec<String> =
            self.panels.iter().map(|panel| format!("{:.0}", panel.arclength)).collect();
        [
            ("restitution", self.restitution.to_string()),
            ("Γ", forcings.join(", ")),
            ("cells a side", self.cells.to_string()),
            ("length of the manifolds", lengths.join(", ")),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
