//! A least-squares cubic through values along a line, and their scatter about it.

/// A least-squares cubic through values.
///
/// A recurrence makes its terms orthogonal on the points (Forsythe 1957), so that no coefficient depends on
/// the others.
#[derive(Debug)]
pub(super) struct Cubic {
    terms: Vec<Term>,
    /// Standard deviation of the values from the cubic.
    pub(super) scatter: f64,
    /// The largest deviation of a value.
    pub(super) largest: f64,
}

/// The next term is (x - `shift`) times this term, minus `back` times the previous one.
#[derive(Debug)]
struct Term {
    shift: f64,
    back: f64,
    /// Sum of the squares of this term over the points.
    square: f64,
    coefficient: f64,
}

/// Terms of a cubic.
const TERMS: usize = 4;

impl Cubic {
    /// The cubic through one value at each of several points.
    pub(super) fn of<'a, T: 'a>(
        places: impl Iterator<Item = (f64, &'a T)>,
        value: impl Fn(&T) -> f64,
    ) -> Option<Self> {
        Self::through(&places.map(|(x, own)| (x, value(own))).collect::<Vec<_>>())
    }

    /// The cubic through values at distinct points; `None` if they are too few to determine a scatter.
    pub(super) fn through(values: &[(f64, f64)]) -> Option<Self> {
        if values.len() <= TERMS {
            return None;
        }
        let mut terms: Vec<Term> = Vec::with_capacity(TERMS);
        let (mut own, mut before) = (vec![1.0; values.len()], vec![0.0; values.len()]);
        let mut rest: Vec<f64> = values.iter().map(|(_, y)| *y).collect();
        for _ in 0..TERMS {
            let square: f64 = own.iter().map(|own| own * own).sum();
            let along: f64 = own.iter().zip(&rest).map(|(own, y)| own * y).sum();
            let shift = values.iter().zip(&own).map(|((x, _), own)| x * own * own).sum::<f64>() / square;
            let term = Term {
                shift,
                back: terms.last().map_or(0.0, |before| square / before.square),
                square,
                coefficient: along / square,
            };
            rest.iter_mut().zip(&own).for_each(|(y, own)| *y -= term.coefficient * own);
            let next = values.iter().zip(&own).zip(&before);
            let next = next.map(|(((x, _), own), before)| (x - shift) * own - term.back * before).collect();
            before = std::mem::replace(&mut own, next);
            terms.push(term);
        }
        let squares: f64 = rest.iter().map(|y| y * y).sum();
        let scatter = (squares / (values.len() - TERMS) as f64).sqrt();
        let largest = rest.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
        Some(Self { terms, scatter, largest })
    }

    /// Its value at x.
    pub(super) fn at(&self, x: f64) -> f64 {
        let (mut own, mut before, mut value) = (1.0, 0.0, 0.0);
        for term in &self.terms {
            value += term.coefficient * own;
            (own, before) = ((x - term.shift) * own - term.back * before, own);
        }
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_found_whatever_the_places() {
        let cubic = |x: f64| 3.0 - x + 2.0 * x * x - 0.7 * x * x * x;
        for places in [17, 8, 33] {
            let places = (0..places).map(|k| f64::from(k) / 11.0 - 0.4 + 0.01 * f64::from(k % 3));
            let values: Vec<(f64, f64)> = places.map(|x| (x, cubic(x))).collect();
            let found = Cubic::through(&values).expect("enough");
            for x in [-1.0, -0.3, 0.0, 0.77, 1.5] {
                assert!((found.at(x) - cubic(x)).abs() < 1e-11, "{x} {found:?}");
            }
            assert!(found.largest < 1e-12 && found.scatter < 1e-12);
        }
        assert!(Cubic::through(&[(0.0, 1.0); TERMS]).is_none());
    }

    #[test]
    fn its_scatter_is_that_of_the_values() {
        let values: Vec<(f64, f64)> =
            (-20..=20).map(|k| (0.05 * f64::from(k), if k % 2 == 0 { 0.1 } else { -0.1 })).collect();
        let found = Cubic::through(&values).expect("enough");
        assert!((found.scatter - 0.1).abs() < 0.01 && found.largest < 0.12);
    }
}
