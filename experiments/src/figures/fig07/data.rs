//! The numbers of Fig. 7, and how its cells are stored and counted.

use bouncing_disk::core::attractors::{ATTACHED, FIRST_ORBIT, Label, UNDECIDED};
use bouncing_disk::core::numerics::elementary::ln;
use serde::Serialize;

/// Data of Fig. 7.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Fig07Data {
    pub(super) restitution: f64,
    /// Top of the window of |w_A Γ/(ωA)|; it starts at 0, and τ_imp/2π runs from 0 to 1.
    pub(super) window_top: f64,
    pub(super) cells: usize,
    pub(super) panels: Vec<Panel>,
    pub(super) windows: Windows,
    /// At Γ = 0.55: impacts N, and the share of the window that has not come to rest after N of them.
    pub(super) decay: Vec<(u32, f64)>,
    pub(super) along_window: Vec<Easiness>,
    pub(super) beyond: Vec<Beyond>,
    pub(super) rest: Vec<Rest>,
    /// The further attractor of panel (b), followed in Γ; `None` if there is none.
    pub(super) traced: Option<Traced>,
}

/// How large the basins are at one Γ of the period-1 window.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Easiness {
    pub(super) axial_forcing: f64,
    pub(super) shares: Vec<TopShares>,
}

/// Shares of the window [0, top].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct TopShares {
    pub(super) top: f64,
    pub(super) period_one: f64,
    pub(super) chattering: f64,
}

/// The starts at one Γ beyond the merging.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Beyond {
    pub(super) axial_forcing: f64,
    /// Starts, on a square grid over the window.
    pub(super) starts: usize,
    /// Those of them that have not come to rest after `impacts`.
    pub(super) not_at_rest: usize,
    pub(super) impacts: u32,
    /// Impacts in one round of what the first of them has settled on; `None` if there is none or it does not repeat.
    pub(super) period: Option<usize>,
}

/// Disks at rest on the platform, let go at phases where it falls away.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Rest {
    pub(super) axial_forcing: f64,
    pub(super) starts: usize,
    pub(super) come_to_rest: usize,
}

/// An attractor followed in Γ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Traced {
    pub(super) step: f64,
    /// Lowest Γ to which it can be followed.
    pub(super) appears: f64,
    /// Impacts in one round there.
    pub(super) period_where_it_appears: Option<usize>,
    /// Highest Γ with half of the impacts that it has in the panel; it doubles its period within a step above.
    pub(super) doubles: Option<f64>,
    /// Highest Γ to which it can be followed.
    pub(super) lost: f64,
}

/// The basins at one Γ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Panel {
    pub(super) axial_forcing: f64,
    /// Impacts after which a start that has neither come to rest nor reached a known orbit counts as undecided.
    pub(super) max_impacts: u32,
    /// Rows of cells by rising speed, in a row by phase: runs of equal cells, as `512w33b455w` (w chattering, b the
    /// attractor of the period-doubling route, o another attractor, u undecided).
    pub(super) rows: Vec<String>,
    pub(super) shares: Shares,
    /// Share of the cells that have a neighbour of another kind, with the cells grouped 1, 2, 4, 8 a side.
    pub(super) boundary_shares: Vec<(usize, f64)>,
    /// The exponents α of boundary share ~ (cell size)^α from each grouping to the next; 2 − α is the boundary's dimension.
    /// Empty where there is no boundary.
    pub(super) boundary_exponents: Vec<f64>,
    /// The same from the finest grouping to the coarsest.
    pub(super) boundary_exponent: Option<f64>,
    /// Lowest |w_A Γ/(ωA)| of a cell that does not chatter; `None` if all do.
    pub(super) lowest_not_chattering: Option<f64>,
    /// Impacts of the attractor of the period-doubling route.
    pub(super) attractor: Vec<Spot>,
    /// Impacts of the chattering orbit from rest; empty if the disk does not come to rest again.
    pub(super) chattering: Vec<Spot>,
    pub(super) others: Vec<Other>,
}

/// Shares of the cells of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Shares {
    pub(super) chattering: f64,
    /// End on the attractor of the period-doubling route.
    pub(super) attractor: f64,
    pub(super) other: f64,
    pub(super) undecided: f64,
}

/// An impact: τ_imp/2π and |w_A Γ/(ωA)|.
pub(super) type Spot = (f64, f64);

/// A periodic attractor outside the period-doubling route.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Other {
    pub(super) impacts: Vec<Spot>,
    pub(super) platform_periods: u64,
    /// The larger modulus of its Floquet multipliers.
    pub(super) spectral_radius: f64,
}

/// Fractions against the window, at the Γ of (a) and (b).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Windows {
    pub(super) grid: (usize, usize),
    /// The printed shares of the period-1 orbit in (a) and (b).
    pub(super) printed: [f64; 2],
    /// Windows [0, top] of |w_A Γ/(ωA)| over a whole period.
    pub(super) curve: Vec<CurvePoint>,
    /// Lowest top that gives the number printed for (a); `None` up to the end of the curve.
    pub(super) top_for_a: Option<f64>,
    /// The same for (b), the period-1 orbit alone.
    pub(super) top_for_b: Option<f64>,
    /// Ranges of tops that give both printed numbers, the period-1 orbit alone in (b).
    pub(super) tops_for_both: Vec<(f64, f64)>,
    /// The same, everything that does not chatter in (b).
    pub(super) tops_for_both_not_chattering: Vec<(f64, f64)>,
}

/// One window.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct CurvePoint {
    pub(super) top: f64,
    /// Share of the period-1 orbit at the Γ of (a).
    pub(super) a: f64,
    /// The same for (b).
    pub(super) b: f64,
    /// Share of everything that does not chatter at the Γ of (b).
    pub(super) b_not_chattering: f64,
}

/// Kinds of cells in the picture, as indices into its palette.
pub(super) const CHATTERING: u8 = 0;

/// The attractor of the period-doubling route.
pub(super) const ATTRACTOR: u8 = 1;

/// Another attractor.
pub(super) const OTHER: u8 = 2;

/// Undecided.
pub(super) const STILL_OPEN: u8 = 3;

/// The letter of a kind.
pub(super) const LETTERS: [char; 4] = ['w', 'b', 'o', 'u'];

/// The kind of a core label. `open` is what an undecided cell counts as.
pub(super) fn kind(label: Label, open: u8) -> u8 {
    match label {
        ATTACHED => CHATTERING,
        UNDECIDED => open,
        FIRST_ORBIT => ATTRACTOR,
        _ => OTHER,
    }
}

/// A row as runs of equal cells.
pub(super) fn runs(row: &[u8]) -> String {
    row.chunk_by(|a, b| a == b)
        .map(|run| format!("{}{}", run.len(), LETTERS[usize::from(run[0] & 3)]))
        .collect()
}

/// The cells of a row of runs; characters that are no run are skipped.
pub(super) fn cells(runs: &str) -> Vec<u8> {
    let mut row = Vec::new();
    let mut length = 0_usize;
    for character in runs.chars() {
        if let Some(digit) = character.to_digit(10) {
            length = 10 * length + digit as usize;
        } else if let Some(index) = LETTERS.iter().position(|letter| *letter == character) {
            row.resize(row.len() + length, index as u8);
            length = 0;
        }
    }
    row
}

/// Share of groups of `size` by `size` cells (each stood for by its first) with a right or upper neighbour of
/// another kind.
pub(super) fn boundary_share(kinds: &[u8], side: usize, size: usize) -> f64 {
    let groups = side / size;
    let at = |row: usize, column: usize| kinds[row * size * side + column * size];
    let mut count = 0;
    for row in 0..groups {
        for column in 0..groups {
            let right = at(row, (column + 1) % groups) != at(row, column);
            let above = row + 1 < groups && at(row + 1, column) != at(row, column);
            count += usize::from(right || above);
        }
    }
    count as f64 / (groups * groups) as f64
}

/// The exponent α of share ~ size^α between two groupings; `None` where there is no boundary.
pub(super) fn exponent(
    (fine, fine_share): (usize, f64),
    (coarse, coarse_share): (usize, f64),
) -> Option<f64> {
    (fine_share > 0.0 && coarse_share > 0.0)
        .then(|| ln(coarse_share / fine_share) / ln(coarse as f64 / fine as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_read_back() {
        let row = [0, 0, 0, 1, 2, 2, 3, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1];
        assert_eq!(runs(&row), "3w1b2o1u1w10b");
        assert_eq!(cells(&runs(&row)), row);
        assert_eq!(cells(""), [0_u8; 0]);
    }

    #[test]
    fn the_boundary_of_a_half_plane_is_one_row_of_cells() {
        let side = 16;
        let kinds: Vec<u8> = (0..side * side).map(|i| u8::from(i / side >= 8)).collect();
        assert!((boundary_share(&kinds, side, 1) - 1.0 / 16.0).abs() < 1e-15);
        assert!((boundary_share(&kinds, side, 4) - 1.0 / 4.0).abs() < 1e-15);
    }

    #[test]
    fn the_boundary_of_a_half_plane_has_the_exponent_of_a_line() {
        let exponent_of = |coarse_share| exponent((1, 1.0 / 16.0), (4, coarse_share));
        assert!(exponent_of(1.0 / 4.0).is_some_and(|exponent| (exponent - 1.0).abs() < 1e-15));
        assert!(exponent_of(1.0 / 16.0).is_some_and(|exponent| exponent.abs() < 1e-15));
        assert_eq!(exponent_of(0.0), None);
    }
}
