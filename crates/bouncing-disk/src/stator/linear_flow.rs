//! A linear system with constant coefficients, z' = A z, and the guaranteed first root of a linear functional
//! of its state.
//!
//! On a step of at most 1/rate, if no eigenvalue of A exceeds the rate, the Taylor polynomial of degree 18 is
//! exact to rounding. It does not matter whether A has a basis of eigenvectors, so critical damping,
//! resonance and repeated eigenvalues need no special treatment (docs/numerics-dynamics.md).

use core::array;

use bouncing_disk_core::Error;
use bouncing_disk_drives::quasi_polynomial::{FirstRoot, Jet, first_root};

/// Degree of the Taylor polynomials: the next term is below 1/19! = 8e-18 of the state.
const DEGREE: usize = 18;

/// The share of a sum that is below its rounding.
const NEGLIGIBLE: f64 = f64::EPSILON * (1.0 / 256.0);

/// Rounding of a coefficient relative to its terms: one product, and sums over the state and the degrees.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A number for each component of the state: a state, or a linear functional of it.
pub(crate) type Vector<const N: usize> = [f64; N];

/// z' = A z.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LinearFlow<const N: usize> {
    /// Row, column and value of the non-zero entries of A.
    entries: Vec<(usize, usize, f64)>,
    step: f64,
    /// exp(A step).
    whole_step: [Vector<N>; N],
}

/// A functional along a flow: its Taylor coefficients as functionals of the state.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Functional<const N: usize> {
    now: Vector<N>,
    /// The weights of each component of the state in the coefficients, up to the last non-zero one.
    columns: Vec<Vec<f64>>,
    /// The sums of their magnitudes.
    sizes: Vector<N>,
    step: f64,
}

/// The Taylor polynomial of a function on one step, with time in units of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TaylorStep {
    coefficients: [f64; DEGREE + 1],
    /// Sum of the magnitudes of the coefficients' terms.
    size: f64,
    step: f64,
    /// Error of the value at the start, in addition to the coefficients' rounding.
    error: f64,
    fourth: f64,
}

/// The state on a part of a step: its Taylor polynomial, with time in units of the step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StateStep<const N: usize> {
    terms: [Vector<N>; DEGREE + 1],
    /// The degree of the polynomial.
    last: usize,
    length: f64,
}

/// The sum of the magnitudes of a functional's terms.
pub(crate) fn size<const N: usize>(functional: &Vector<N>, state: &Vector<N>) -> f64 {
    functional.iter().zip(state).map(|(a, b)| (a * b).abs()).sum()
}

/// The value of a functional.
#[must_use]
pub(crate) fn dot<const N: usize>(functional: &Vector<N>, state: &Vector<N>) -> f64 {
    let mut sum = 0.0;
    for i in 0..N {
        sum += functional[i] * state[i];
    }
    sum
}

impl<const N: usize> LinearFlow<N> {
    /// The flow of a matrix whose eigenvalues have magnitudes of at most `rate`. The step divides `period`.
    #[must_use]
    pub(crate) fn new(matrix: [Vector<N>; N], rate: f64, period: f64) -> Self {
        let step = period / (period * rate).ceil().max(1.0);
        let all = matrix.iter().enumerate().flat_map(|(row, entries)| {
            entries.iter().enumerate().map(move |(column, &entry)| (row, column, entry))
        });
        let entries = all.filter(|&(.., entry)| entry != 0.0).collect();
        let mut flow = Self { entries, step, whole_step: [[0.0; N]; N] };
        for column in 0..N {
            let mut unit = [0.0; N];
            unit[column] = 1.0;
            for (row, value) in flow.after(&unit, step).into_iter().enumerate() {
                flow.whole_step[row][column] = value;
            }
        }
        flow
    }

    /// The step.
    #[must_use]
    pub(crate) const fn step(&self) -> f64 {
        self.step
    }

    /// The derivative of a functional along the flow.
    #[must_use]
    pub(crate) fn derivative(&self, functional: &Vector<N>) -> Vector<N> {
        let mut derivative = [0.0; N];
        for &(row, column, entry) in &self.entries {
            derivative[column] += functional[row] * entry;
        }
        derivative
    }

    /// This functional along the flow.
    #[must_use]
    pub(crate) fn functional(&self, of: Vector<N>) -> Functional<N> {
        let mut rows = [of; DEGREE + 1];
        for k in 1..=DEGREE {
            rows[k] = self.derivative(&rows[k - 1]).map(|entry| entry * (self.step / k as f64));
        }
        let used = |i: usize| rows.iter().rposition(|row| row[i] != 0.0).map_or(0, |last| last + 1);
        let column = |i: usize| rows[..used(i)].iter().map(|row| row[i]).collect();
        let columns: Vec<Vec<f64>> = (0..N).map(column).collect();
        let sizes = array::from_fn(|i| columns[i].iter().map(|weight| weight.abs()).sum());
        Functional { now: of, columns, sizes, step: self.step }
    }

    /// The state over the next step, up to `length` of it.
    #[must_use]
    pub(crate) fn expand(&self, state: &Vector<N>, length: f64) -> StateStep<N> {
        let mut terms = [*state; DEGREE + 1];
        let last = self.degree(length);
        for k in 1..=last {
            terms[k] = self.vector_field(&terms[k - 1]).map(|value| value * (length / k as f64));
        }
        StateStep { terms, last, length }
    }

    /// The degree above which the terms of the solution are negligible after this time.
    fn degree(&self, time: f64) -> usize {
        let (mut last, mut bound) = (0, 1.0);
        // A gap that opens by its third derivative must keep its digits.
        while last < DEGREE && (last < 4 || bound > NEGLIGIBLE) {
            last += 1;
            bound *= if last > 3 { time / (self.step * last as f64) } else { 1.0 };
        }
        last
    }

    fn vector_field(&self, state: &Vector<N>) -> Vector<N> {
        let mut derivative = [0.0; N];
        for &(row, column, entry) in &self.entries {
            derivative[row] += entry * state[column];
        }
        derivative
    }

    /// The state after a time of at most one step.
    #[must_use]
    pub(crate) fn after(&self, state: &Vector<N>, time: f64) -> Vector<N> {
        self.expand(state, time).at_end()
    }

    /// The state a whole step later.
    #[must_use]
    pub(crate) fn advance(&self, state: &Vector<N>) -> Vector<N> {
        array::from_fn(|i| dot(&self.whole_step[i], state))
    }
}

impl<const N: usize> StateStep<N> {
    /// The state after a time within the part.
    #[must_use]
    pub(crate) fn at(&self, time: f64) -> Vector<N> {
        let share = time / self.length;
        let mut state = self.terms[self.last];
        for row in self.terms[..self.last].iter().rev() {
            for (value, term) in state.iter_mut().zip(row) {
                *value = *value * share + term;
            }
        }
        state
    }

    /// The state at the end of the part.
    fn at_end(&self) -> Vector<N> {
        let mut state = self.terms[self.last];
        for row in self.terms[..self.last].iter().rev() {
            state = array::from_fn(|i| state[i] + row[i]);
        }
        state
    }
}

impl<const N: usize> Functional<N> {
    /// The functional itself.
    #[must_use]
    pub(crate) const fn now(&self) -> &Vector<N> {
        &self.now
    }

    /// The function on the step from this state on, exact to rounding of its terms except for an `error` of
    /// the value.
    #[must_use]
    pub(crate) fn along(&self, state: &Vector<N>, error: f64) -> TaylorStep {
        let mut coefficients = [0.0; DEGREE + 1];
        for (value, column) in state.iter().zip(&self.columns) {
            for (sum, weight) in coefficients.iter_mut().zip(column) {
                *sum += weight * value;
            }
        }
        let size = size(&self.sizes, state);
        TaylorStep { coefficients, size, step: self.step, error, fourth: 0.0 }.bounded()
    }
}

impl TaylorStep {
    fn bounded(mut self) -> Self {
        self.fourth = 0.0;
        for (k, coefficient) in self.coefficients.iter().enumerate().skip(4) {
            let k = k as f64;
            self.fourth += coefficient.abs() * (k * (k - 1.0)) * ((k - 2.0) * (k - 3.0));
        }
        let square = self.step * self.step;
        self.fourth /= square * square;
        self
    }

    /// The function with these exact starting values of itself and its derivatives.
    #[must_use]
    pub(crate) fn starting_with(mut self, values: &[f64]) -> Self {
        let mut factor = 1.0;
        for (k, value) in values.iter().enumerate() {
            self.coefficients[k] = value * factor;
            factor *= self.step / (k + 1) as f64;
        }
        self.error = 0.0;
        self
    }

    /// This function, which starts with the given number of zero derivatives, divided by that power of the
    /// normalised time. The quotient has the same roots and preserves their digits near the start.
    #[must_use]
    pub(crate) fn deflated(mut self, zeros: usize) -> Self {
        self.coefficients[..zeros].fill(0.0);
        self.coefficients.rotate_left(zeros);
        self.bounded()
    }

    /// The function with the opposite sign.
    #[must_use]
    pub(crate) fn negated(mut self) -> Self {
        self.coefficients = self.coefficients.map(|coefficient| -coefficient);
        self
    }

    /// Value and derivatives after a time of at most one step.
    #[must_use]
    pub(crate) fn jet(&self, time: f64) -> Jet {
        let x = time / self.step;
        let c = &self.coefficients;
        let (mut value, mut slope, mut bend, mut third) = (c[DEGREE], 0.0, 0.0, 0.0);
        for coefficient in c[..DEGREE].iter().rev() {
            third = third * x + bend;
            bend = bend * x + slope;
            slope = slope * x + value;
            value = value * x + coefficient;
        }
        let (per, twice) = (1.0 / self.step, 2.0 / (self.step * self.step));
        let rounding = ROUNDING * self.size;
        // A function that starts at exactly zero is as exact near there as its slope.
        let near = if c[0] == 0.0 && self.error == 0.0 { x.min(1.0) } else { 1.0 };
        Jet {
            value,
            slope: slope * per,
            bend: bend * twice,
            third: third * (3.0 * twice * per),
            fourth: self.fourth,
            error: self.error + rounding * near,
            slope_error: rounding * per,
            bend_error: rounding * twice,
        }
    }

    /// The time of the first fall through zero within `to`, at most one step, and the slope there. A touch
    /// hidden by rounding does not count: the function stays above zero except for rounding.
    ///
    /// # Errors
    /// [`Error::NoConvergence`] after 100,000 evaluations.
    pub(crate) fn first_fall(&self, to: f64) -> Result<Option<[f64; 2]>, Error> {
        self.first_fall_from(0.0, to)
    }

    /// [`Self::first_fall`] from a later time on; immediate if the function is already below zero.
    ///
    /// # Errors
    /// The errors of [`Self::first_fall`].
    pub(crate) fn first_fall_from(&self, mut from: f64, to: f64) -> Result<Option<[f64; 2]>, Error> {
        let to = to.min(self.step);
        if from > 0.0 {
            let start = self.jet(from);
            if start.value < 0.0 {
                return Ok((from < to).then_some([from, start.slope]));
            }
        }
        while from < to {
            match first_root(|t| self.jet(t), from, to)? {
                FirstRoot::Root(root) => return Ok(Some([root.at, root.slope])),
                FirstRoot::None { .. } => break,
                FirstRoot::Undecided { until, .. } if until < to => {
                    from = until.max(from + f64::EPSILON * self.step);
                }
                FirstRoot::Undecided { .. } => {
                    let end = self.jet(to);
                    return Ok((end.value < -end.error).then_some([to, end.slope]));
                }
            }
        }
        Ok(None)
    }
}
