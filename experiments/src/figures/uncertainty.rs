//! How uncertainties of inputs act on a result.

use serde::{Deserialize, Serialize};

use crate::claims::paper::Uncertain;

/// A result and its uncertainty. The effect of an input is half the difference of the results at both ends of its
/// range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Propagated {
    pub(crate) value: f64,
    /// Sum of the effects of all inputs: none of them need be independent.
    pub(crate) sum: f64,
    /// Root of the sum of their squares: for independent inputs.
    pub(crate) root_sum_of_squares: f64,
}

impl Propagated {
    /// The result of `formula` for `inputs`, which it gets in the same order.
    pub(crate) fn of<const N: usize, E>(
        inputs: [Uncertain; N],
        formula: impl Fn([f64; N]) -> Result<f64, E>,
    ) -> Result<Self, E> {
        let middle = inputs.map(|input| input.value);
        let (mut sum, mut squares) = (0.0, 0.0);
        for (index, input) in inputs.iter().enumerate() {
            let moved = |share: f64| {
                let mut values = middle;
                values[index] += share * input.uncertainty;
                formula(values)
            };
            let effect = 0.5 * (moved(1.0)? - moved(-1.0)?).abs();
            sum += effect;
            squares += effect * effect;
        }
        Ok(Self { value: formula(middle)?, sum, root_sum_of_squares: squares.sqrt() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_formula_adds_its_coefficients() {
        let inputs = [Uncertain { value: 2.0, uncertainty: 0.3 }, Uncertain { value: 1.0, uncertainty: 0.2 }];
        let result = Propagated::of(inputs, |[x, y]| Ok::<_, ()>(5.0 + x - 2.0 * y)).expect("no failure");
        assert!((result.value - 5.0).abs() < 1e-15);
        assert!((result.sum - 0.7).abs() < 1e-15 && (result.root_sum_of_squares - 0.5).abs() < 1e-15);
    }
}
