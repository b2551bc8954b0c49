//! The linear system of a closed sequence of equations with one or two more parameters and conditions, in time
//! and memory proportional to its length. Newton's method on branches and on curves of bifurcations solves it.

use glam::{DMat2, DVec2};

use crate::numerics::block_cyclic::{FIRST, NEXT, OWN, eliminate, rotate};

/// Columns of a row that is being eliminated, after the unknowns: the parameters. The right side follows
/// them.
const PARAMETER: usize = 6;

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

/// One of two conditions that are added: `first . x[0] + parameters . mu = right`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Condition<const K: usize> {
    pub(crate) first: DVec2,
    pub(crate) parameters: [f64; K],
    pub(crate) right: f64,
}

/// The equations of a closed sequence: `own[i] x[i] + next[i] x[i + 1] + column[i] mu = right[i]`, the index
/// taken modulo their number.
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
    /// As in [`solve_block_cyclic`](super::block_cyclic::solve_block_cyclic), rotations eliminate the
    /// unknowns one by one, starting with number 1, and carry the parameter along like the first unknown. The
    /// condition contains only these two, so it joins the others in three final equations. The whole system
    /// is therefore as well conditioned as the bordered matrix, even at a fold, where the closed sequence
    /// alone is singular. The solution of a singular system is not finite, or as large as rounding makes it.
    pub fn solve(&self, border: Border) -> (Vec<DVec2>, f64) {
        if self.own.is_empty() {
            return (Vec::new(), border.right / border.parameter);
        }
        let Border { first, parameter, right } = border;
        let condition = Condition { first, parameters: [parameter], right };
        let (solution, [parameter]) = self.solved::<1, 8>([&self.column], [condition]);
        (solution, parameter)
    }

    /// The same with a second parameter, whose column is `second`, and two conditions.
    pub(crate) fn solve_two(
        &self,
        second: &[DVec2],
        conditions: [Condition<2>; 2],
    ) -> (Vec<DVec2>, [f64; 2]) {
        self.solved::<2, 9>([&self.column, second], conditions)
    }

    /// The solution with K parameters and rows of WIDTH = 7 + K columns, for at least one equation.
    fn solved<const K: usize, const WIDTH: usize>(
        &self,
        columns: [&[DVec2]; K],
        conditions: [Condition<K>; K],
    ) -> (Vec<DVec2>, [f64; K]) {
        let n = self.own.len();
        let right = PARAMETER + K;
        let rows = |i: usize| {
            let mut rows = [[0.0; WIDTH]; 2];
            for (k, row) in rows.iter_mut().enumerate() {
                for (parameter, column) in columns.iter().enumerate() {
                    row[PARAMETER + parameter] = column[i][k];
                }
                row[right] = self.right[i][k];
            }
            rows
        };
        // The two rows that couple the first unknown with the next one to be eliminated.
        let mut last = rows(0);
        if n == 1 {
            put(&mut last, FIRST, self.own[0] + self.next[0]);
        } else {
            put(&mut last, FIRST, self.own[0]);
            put(&mut last, OWN, self.next[0]);
        }
        let mut eliminated: Vec<[[f64; WIDTH]; 2]> = Vec::with_capacity(n - 1);
        for i in 1..n {
            let mut fresh = rows(i);
            put(&mut fresh, OWN, self.own[i]);
            put(&mut fresh, if i + 1 < n { NEXT } else { FIRST }, self.next[i]);
            let (done, left) = eliminate(last, fresh);
            eliminated.push(done);
            last = left;
        }
        let (start, parameters) = closed(last, conditions);
        let mut solution = vec![start; n];
        let mut following = DVec2::ZERO;
        for (unknown, rows) in solution[1..].iter_mut().zip(&eliminated).rev() {
            let known = |row: &[f64; WIDTH]| {
                let parts = row[PARAMETER..].iter().zip(&parameters);
                parts.fold(row[right], |left, (part, parameter)| left - part * parameter)
                    - (row[FIRST] * start.x + row[FIRST + 1] * start.y)
                    - (row[NEXT] * following.x + row[NEXT + 1] * following.y)
            };
            let y = known(&rows[1]) / rows[1][OWN + 1];
            *unknown = DVec2::new((known(&rows[0]) - rows[0][OWN + 1] * y) / rows[0][OWN], y);
            following = *unknown;
        }
        (solution, parameters)
    }
}

fn put<const WIDTH: usize>(rows: &mut [[f64; WIDTH]; 2], at: usize, block: DMat2) {
    for (k, row) in rows.iter_mut().enumerate() {
        (row[at], row[at + 1]) = (block.x_axis[k], block.y_axis[k]);
    }
}

/// The first unknown and the parameters, from the last two rows and the conditions.
fn closed<const K: usize, const WIDTH: usize>(
    last: [[f64; WIDTH]; 2],
    conditions: [Condition<K>; K],
) -> (DVec2, [f64; K]) {
    let right = PARAMETER + K;
    let mut rows = last.to_vec();
    for condition in conditions {
        let mut row = [0.0; WIDTH];
        (row[FIRST], row[FIRST + 1]) = (condition.first.x, condition.first.y);
        row[PARAMETER..right].copy_from_slice(&condition.parameters);
        row[right] = condition.right;
        rows.push(row);
    }
    let column = |unknown: usize| if unknown < 2 { FIRST + unknown } else { PARAMETER + unknown - 2 };
    for upper in 0..=K {
        for lower in upper + 1..2 + K {
            rotate(&mut rows, upper, lower, column(upper));
        }
    }
    let mut parameters = [0.0; K];
    for at in (0..K).rev() {
        let row = &rows[2 + at];
        let known = (at + 1..K).fold(row[right], |left, k| left - row[PARAMETER + k] * parameters[k]);
        parameters[at] = known / row[PARAMETER + at];
    }
    let known = |row: &[f64; WIDTH]| {
        let parts = row[PARAMETER..].iter().zip(&parameters);
        parts.fold(row[right], |left, (part, parameter)| left - part * parameter)
    };
    let y = known(&rows[1]) / rows[1][FIRST + 1];
    let x = (known(&rows[0]) - rows[0][FIRST + 1] * y) / rows[0][FIRST];
    (DVec2::new(x, y), parameters)
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
    /// are stable in the norm of the whole, because the first unknown and the parameter affect every
    /// equation.
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

    /// With two parameters: the same oracle.
    #[test]
    fn the_equations_and_both_conditions_hold() {
        for n in [1, 2, 3, 40] {
            for seed in 0..20 {
                let (system, one) = random_system(n, 1.0, seed);
                let (other, two) = random_system(n, 1.0, seed + 100);
                let parameters = [[one.parameter, 0.3], [two.parameter, -0.7]];
                let conditions = [(one, parameters[0]), (two, parameters[1])].map(|(border, parameters)| {
                    Condition { first: border.first, parameters, right: border.right }
                });
                let (x, [mu, nu]) = system.solve_two(&other.column, conditions);
                // The second parameter known, the rest are the equations of one.
                let mut left = system.clone();
                for (right, column) in left.right.iter_mut().zip(&other.column) {
                    *right -= *column * nu;
                }
                for (border, [_, second]) in [(one, parameters[0]), (two, parameters[1])] {
                    let border = Border { right: border.right - second * nu, ..border };
                    assert!(residual(&left, border, (&x, mu)) < 1e-14, "n {n}, seed {seed}");
                }
            }
        }
    }

    /// At a fold the closed sequence alone is singular and the whole is not: x - mu (1, 0) = 0 in the second
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
