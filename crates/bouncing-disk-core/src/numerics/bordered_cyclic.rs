//! The linear system of a closed sequence of equations with an additional parameter and condition, solved in
//! time and memory proportional to its length. Newton's method on a branch of periodic orbits uses it.

use glam::{DMat2, DVec2};

use crate::numerics::block_cyclic::{FIRST, NEXT, OWN, eliminate, rotate};

/// Columns of a row during elimination, after the unknowns: the parameter and the right side.
const PARAMETER: usize = 6;
const RIGHT: usize = 7;

type Row = [f64; 8];

/// The additional condition: `first . x[0] + parameter mu = right`.
#[derive(Debug, Clone, Copy)]
pub struct Border {
    /// The coefficients of the first unknown.
    pub first: DVec2,
    /// The coefficient of the parameter.
    pub parameter: f64,
    /// The right side.
    pub right: f64,
}

/// The equations of a closed sequence: `own[i] x[i] + next[i] x[i + 1] + column[i] mu = right[i]`, with the
/// index modulo their number.
#[derive(Debug, Clone, Default)]
pub struct CyclicEquations {
    /// The coefficients of each equation's own unknown.
    pub own: Vec<DMat2>,
    /// The coefficients of the next unknown.
    pub next: Vec<DMat2>,
    /// The coefficients of the parameter.
    pub column: Vec<DVec2>,
    /// The right sides.
    pub right: Vec<DVec2>,
}

impl CyclicEquations {
    /// The unknowns x and mu.
    ///
    /// As in [`solve_block_cyclic`](super::block_cyclic::solve_block_cyclic) rotations eliminate the unknowns
    /// from number 1, and the parameter is carried along like the first unknown. The condition contains only
    /// these two, so it joins the others in three final equations. So the whole is as well conditioned as the
    /// bordered matrix, even at a fold, where the closed sequence alone is singular. The solution of a
    /// singular system is not finite, or as large as rounding makes it.
    pub fn solve(&self, border: Border) -> (Vec<DVec2>, f64) {
        let n = self.own.len();
        if n == 0 {
            return (Vec::new(), border.right / border.parameter);
        }
        // The two rows that couple the first unknown with the next one to be eliminated.
        let mut last = self.rows(0);
        if n == 1 {
            put(&mut last, FIRST, self.own[0] + self.next[0]);
        } else {
            put(&mut last, FIRST, self.own[0]);
            put(&mut last, OWN, self.next[0]);
        }
        let mut eliminated: Vec<[Row; 2]> = Vec::with_capacity(n - 1);
        for i in 1..n {
            let mut fresh = self.rows(i);
            put(&mut fresh, OWN, self.own[i]);
            put(&mut fresh, if i + 1 < n { NEXT } else { FIRST }, self.next[i]);
            let (done, left) = eliminate(last, fresh);
            eliminated.push(done);
            last = left;
        }
        let (start, parameter) = closed(last, border);
        let mut solution = vec![start; n];
        let mut following = DVec2::ZERO;
        for (unknown, rows) in solution[1..].iter_mut().zip(&eliminated).rev() {
            let known = |row: &Row| {
                (row[RIGHT] - row[PARAMETER] * parameter)
                    - (row[FIRST] * start.x + row[FIRST + 1] * start.y)
                    - (row[NEXT] * following.x + row[NEXT + 1] * following.y)
            };
            let y = known(&rows[1]) / rows[1][OWN + 1];
            *unknown = DVec2::new((known(&rows[0]) - rows[0][OWN + 1] * y) / rows[0][OWN], y);
            following = *unknown;
        }
        (solution, parameter)
    }

    /// Two rows with the parameter's column and the right side of an equation.
    fn rows(&self, i: usize) -> [Row; 2] {
        let mut rows = [[0.0; 8]; 2];
        for (k, row) in rows.iter_mut().enumerate() {
            (row[PARAMETER], row[RIGHT]) = (self.column[i][k], self.right[i][k]);
        }
        rows
    }
}

fn put(rows: &mut [Row; 2], at: usize, block: DMat2) {
    for (k, row) in rows.iter_mut().enumerate() {
        (row[at], row[at + 1]) = (block.x_axis[k], block.y_axis[k]);
    }
}

/// The first unknown and the parameter, from the last two rows and the condition.
fn closed([first, second]: [Row; 2], border: Border) -> (DVec2, f64) {
    let mut condition = [0.0; 8];
    (condition[FIRST], condition[FIRST + 1]) = (border.first.x, border.first.y);
    (condition[PARAMETER], condition[RIGHT]) = (border.parameter, border.right);
    let mut rows = [first, second, condition];
    for (upper, column) in [(0, FIRST), (1, FIRST + 1)] {
        for lower in upper + 1..3 {
            rotate(&mut rows, upper, lower, column);
        }
    }
    let [first, second, third] = rows;
    let parameter = third[RIGHT] / third[PARAMETER];
    let y = (second[RIGHT] - second[PARAMETER] * parameter) / second[FIRST + 1];
    let x = ((first[RIGHT] - first[PARAMETER] * parameter) - first[FIRST + 1] * y) / first[FIRST];
    (DVec2::new(x, y), parameter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::SplitMix64;

    fn random_system(n: usize, size: f64, seed: u64) -> (CyclicEquations, Border) {
        let mut random = SplitMix64::new(seed);
        let mut number = || 2.0 * random.unit() - 1.0;
        let mut vector = || DVec2::new(number(), number());
        let mut system = CyclicEquations::default();
        for _ in 0..n {
            system.own.push(DMat2::from_cols(size * vector(), size * vector()));
            system.next.push(DMat2::from_cols(vector(), vector()));
            system.column.push(vector());
            system.right.push(vector());
        }
        let (first, rest) = (vector(), vector());
        (system, Border { first, parameter: rest.x, right: rest.y })
    }

    /// The largest residual, relative to the largest sum of the magnitudes of an equation's terms: rotations
    /// are stable in the norm of the whole, as the first unknown and the parameter affect every equation.
    fn residual(system: &CyclicEquations, border: Border, (x, mu): (&[DVec2], f64)) -> f64 {
        let n = x.len();
        let size = |block: DMat2| block.x_axis.length() + block.y_axis.length();
        let mut worst = (border.first.dot(x[0]) + border.parameter * mu - border.right).abs();
        let mut scale =
            border.first.length() * x[0].length() + (border.parameter * mu).abs() + border.right.abs();
        for i in 0..n {
            let next = x[(i + 1) % n];
            let left = system.own[i] * x[i] + system.next[i] * next + system.column[i] * mu - system.right[i];
            let magnitudes = size(system.own[i]) * x[i].length()
                + size(system.next[i]) * next.length()
                + system.column[i].length() * mu.abs()
                + system.right[i].length();
            (worst, scale) = (worst.max(left.length()), scale.max(magnitudes));
        }
        worst / scale
    }

    /// The equations themselves are the oracle.
    #[test]
    fn the_equations_and_the_condition_hold() {
        for n in [1, 2, 3, 8, 100, 4_096] {
            for size in [1e-3, 0.5, 1.0, 3.0, 1e4] {
                for seed in 0..20 {
                    let (system, border) = random_system(n, size, seed);
                    let (x, mu) = system.solve(border);
                    assert_eq!(x.len(), n);
                    let left = residual(&system, border, (&x, mu));
                    assert!(left < 1e-14, "n {n}, size {size}, seed {seed}: {left:e}");
                }
            }
        }
    }

    /// At a fold the closed sequence alone is singular, but not the whole: x - mu (1, 0) = 0 in the second
    /// row only.
    #[test]
    fn a_fold_is_solved() {
        let system = CyclicEquations {
            own: vec![DMat2::from_cols(DVec2::new(0.0, 0.0), DVec2::new(0.0, 2.0))],
            next: vec![DMat2::ZERO],
            column: vec![DVec2::new(1.0, 0.0)],
            right: vec![DVec2::new(0.0, 4.0)],
        };
        let (x, mu) = system.solve(Border { first: DVec2::new(1.0, 0.0), parameter: 0.0, right: 0.5 });
        assert!(x == [DVec2::new(0.5, 2.0)] && mu.abs() <= 0.0, "{x:?} {mu}");
        let (x, _) = system.solve(Border { first: DVec2::ZERO, parameter: 1.0, right: 0.5 });
        assert!(!x[0].is_finite(), "the condition does not see the first component: {x:?}");
        let nothing = CyclicEquations::default();
        assert!(nothing.solve(Border { first: DVec2::ZERO, parameter: 2.0, right: 1.0 }).0.is_empty());
    }
}
