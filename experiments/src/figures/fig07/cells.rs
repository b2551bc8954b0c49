//! The cells of a basin: their kinds, how a row of them is stored, and how rough their boundary is.

use bouncing_disk::core::attractors::{ATTACHED, FIRST_ORBIT, Label, UNDECIDED};
use bouncing_disk::core::numerics::elementary::ln;

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
