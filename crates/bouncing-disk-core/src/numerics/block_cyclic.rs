//! The linear system of a closed sequence of maps, in time and memory proportional to its length.

use glam::{DMat2, DVec2};

use crate::numerics::elementary::hypot;

/// Columns of a row during elimination: its own unknown, the first and the following unknown, and the right
/// side.
pub(crate) const OWN: usize = 0;
pub(crate) const FIRST: usize = 2;
pub(crate) const NEXT: usize = 4;
const RIGHT: usize = 6;

type Row = [f64; 7];

/// Solves `blocks[i] x[i] - x[i + 1] = right[i]`, for x, with the index modulo the number n >= 1 of blocks.
///
/// Rotations of the two rows of blocks that contain an unknown eliminate the unknowns one by one, starting
/// with number 1, until only the first is left: a structured QR factorisation (S. J. Wright, SIAM J. Sci.
/// Stat. Comput. 13, 742 (1992)). With rotations rounding errors do not grow, however unstable the sequence;
/// with the product of the blocks they would. The solution of a singular system is not finite, or as large as
/// rounding makes it.
pub fn solve_block_cyclic(blocks: &[DMat2], right: &[DVec2]) -> Vec<DVec2> {
    let n = blocks.len().min(right.len());
    if n == 0 {
        return Vec::new();
    }
    // The two rows that couple the first unknown with the next one to be eliminated.
    let mut last = [[0.0; 7]; 2];
    put(&mut last, FIRST, blocks[0]);
    put_right(&mut last, right[0]);
    let mut eliminated: Vec<[Row; 2]> = Vec::with_capacity(n - 1);
    if n == 1 {
        put(&mut last, FIRST, blocks[0] - DMat2::IDENTITY);
    } else {
        put(&mut last, OWN, -DMat2::IDENTITY);
    }
    for i in 1..n {
        let mut fresh = [[0.0; 7]; 2];
        put(&mut fresh, OWN, blocks[i]);
        put(&mut fresh, if i + 1 < n { NEXT } else { FIRST }, -DMat2::IDENTITY);
        put_right(&mut fresh, right[i]);
        let (done, left) = eliminate(last, fresh);
        eliminated.push(done);
        last = left;
    }
    let [first, second] = last;
    let mut rows = [first, second];
    rotate(&mut rows, 0, 1, FIRST);
    let start = back_substituted(&rows, FIRST, DVec2::new(rows[0][RIGHT], rows[1][RIGHT]));
    let mut solution = vec![start; n];
    let mut following = DVec2::ZERO;
    for (unknown, rows) in solution[1..].iter_mut().zip(&eliminated).rev() {
        let known = |row: &Row| {
            (row[RIGHT] - (row[FIRST] * start.x + row[FIRST + 1] * start.y))
                - (row[NEXT] * following.x + row[NEXT + 1] * following.y)
        };
        *unknown = back_substituted(rows, OWN, DVec2::new(known(&rows[0]), known(&rows[1])));
        following = *unknown;
    }
    solution
}

/// Eliminates the unknown of the first two columns from four rows. Two rows couple it with the first unknown
/// of the sequence, two with the following unknown (two columns from [`NEXT`]). The results are the two rows
/// that now contain it, and the two remaining rows, in which the following unknown takes its place.
pub(crate) fn eliminate<const WIDTH: usize>(
    last: [[f64; WIDTH]; 2],
    fresh: [[f64; WIDTH]; 2],
) -> ([[f64; WIDTH]; 2], [[f64; WIDTH]; 2]) {
    let [first, second] = last;
    let [third, fourth] = fresh;
    let mut rows = [first, second, third, fourth];
    for column in 0..2 {
        for lower in column + 1..4 {
            rotate(&mut rows, column, lower, column);
        }
    }
    let [first, second, third, fourth] = rows;
    let left = [third, fourth].map(|row| {
        let mut moved = row;
        (moved[OWN], moved[OWN + 1]) = (row[NEXT], row[NEXT + 1]);
        (moved[NEXT], moved[NEXT + 1]) = (0.0, 0.0);
        moved
    });
    ([first, second], left)
}

fn put(rows: &mut [Row; 2], at: usize, block: DMat2) {
    for (k, row) in rows.iter_mut().enumerate() {
        (row[at], row[at + 1]) = (block.x_axis[k], block.y_axis[k]);
    }
}

fn put_right(rows: &mut [Row; 2], right: DVec2) {
    (rows[0][RIGHT], rows[1][RIGHT]) = (right.x, right.y);
}

/// Rotates two rows so that the lower one has a zero in `column`.
pub(super) fn rotate<const COLUMNS: usize>(
    rows: &mut [[f64; COLUMNS]],
    upper: usize,
    lower: usize,
    column: usize,
) {
    let (a, b) = (rows[upper][column], rows[lower][column]);
    if b == 0.0 {
        return;
    }
    let length = hypot(a, b);
    let (cos, sin) = (a / length, b / length);
    let (above, below) = rows.split_at_mut(lower);
    for (a, b) in above[upper].iter_mut().zip(&mut below[0]) {
        (*a, *b) = (cos * *a + sin * *b, cos * *b - sin * *a);
    }
    rows[lower][column] = 0.0;
}

/// Solves the upper triangle of two rows that begins in the column `at`.
fn back_substituted(rows: &[Row; 2], at: usize, right: DVec2) -> DVec2 {
    let y = right.y / rows[1][at + 1];
    DVec2::new((right.x - rows[0][at + 1] * y) / rows[0][at], y)
}

#[cfg(test)]
mod tests {
    use faer::linalg::solvers::Solve;

    use super::*;
    use crate::numerics::random::SplitMix64;

    /// The largest residual, relative to the sum of the magnitudes of its terms.
    fn residual(blocks: &[DMat2], right: &[DVec2], x: &[DVec2]) -> f64 {
        let n = blocks.len();
        (0..n).fold(0.0, |worst: f64, i| {
            let next = x[(i + 1) % n];
            let left = blocks[i] * x[i] - next - right[i];
            let size = blocks[i].x_axis.length() + blocks[i].y_axis.length();
            worst.max(left.length() / (size * x[i].length() + next.length() + right[i].length()))
        })
    }

    fn random_system(n: usize, size: f64, seed: u64) -> (Vec<DMat2>, Vec<DVec2>) {
        let mut random = SplitMix64::new(seed);
        let mut number = || 2.0 * random.unit() - 1.0;
        let blocks = (0..n).map(|_| {
            let (x, y) = (DVec2::new(number(), number()), DVec2::new(number(), number()));
            DMat2::from_cols(size * x, size * y)
        });
        let blocks: Vec<_> = blocks.collect();
        (blocks, (0..n).map(|_| DVec2::new(number(), number())).collect())
    }

    /// The equations themselves are the oracle, independent of the elimination. Products of these blocks
    /// range from 1e-300 to far beyond the largest double.
    #[test]
    fn the_equations_hold_for_stable_and_unstable_sequences() {
        for n in [1, 2, 3, 7, 100, 4_096] {
            for size in [5e-324, 1e-310, 1e-160, 1e-3, 0.5, 1.0, 3.0, 1e4, 1e70] {
                for seed in 0..20 {
                    let (blocks, right) = random_system(n, size, seed);
                    let x = solve_block_cyclic(&blocks, &right);
                    assert_eq!(x.len(), n);
                    let left = residual(&blocks, &right, &x);
                    assert!(left < 1e-13, "n {n}, size {size}, seed {seed}: {left:e}");
                }
            }
        }
    }

    /// The whole system as one dense matrix, by faer's LU factorisation with row exchanges.
    #[test]
    fn a_dense_solve_agrees() {
        for n in [1, 2, 3, 7, 30] {
            for seed in 0..20 {
                let (blocks, right) = random_system(n, 1.5, seed);
                let matrix = faer::Mat::from_fn(2 * n, 2 * n, |row, column| {
                    let (block, unknown) = (row / 2, column / 2);
                    let own = if unknown == block { blocks[block].col(column % 2)[row % 2] } else { 0.0 };
                    own - f64::from(u8::from(unknown == (block + 1) % n && row % 2 == column % 2))
                });
                let dense = matrix
                    .partial_piv_lu()
                    .solve(faer::Mat::from_fn(2 * n, 1, |row, _| right[row / 2][row % 2]));
                let size = dense.norm_max();
                for (i, x) in solve_block_cyclic(&blocks, &right).into_iter().enumerate() {
                    let apart = (x - DVec2::new(dense[(2 * i, 0)], dense[(2 * i + 1, 0)])).length();
                    assert!(apart < 1e-11 * size, "n {n}, seed {seed}: {apart:e} of {size}");
                }
            }
        }
    }

    /// One impact: x = (J - 1)^-1 b in closed form.
    #[test]
    fn one_block_is_the_map_less_the_identity() {
        let block = DMat2::from_cols(DVec2::new(3.0, 1.0), DVec2::new(0.5, -2.0));
        let x = solve_block_cyclic(&[block], &[DVec2::new(1.0, 2.0)]);
        // (2, 0.5; 1, -3) x = (1, 2).
        let expected = DVec2::new(-4.0 / -6.5, 3.0 / -6.5);
        assert!((x[0] - expected).length() < 1e-15, "{x:?}");
    }

    #[test]
    fn a_singular_system_says_so() {
        let x = solve_block_cyclic(&[DMat2::IDENTITY], &[DVec2::new(1.0, 2.0)]);
        assert!(!x[0].is_finite(), "{x:?}");
        assert!(solve_block_cyclic(&[], &[]).is_empty());
    }
}
