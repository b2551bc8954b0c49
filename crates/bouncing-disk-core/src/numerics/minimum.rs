//! Minima of functions of one variable.

/// The minimum of a function that has one between `low` and `high`, by the golden section: each of `steps` narrows the bracket by the
/// factor 0.618, and its middle is returned. The place of a smooth minimum is in the values of a function to half of their
/// digits only.
///
/// # Errors
/// Those of `function`.
pub fn golden_section<E>(
    mut low: f64,
    mut high: f64,
    steps: u32,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
    let mut values = [function(inner[0])?, function(inner[1])?];
    for _ in 0..steps {
        if values[0] <= values[1] {
            high = inner[1];
            (inner[1], values[1]) = (inner[0], values[0]);
            inner[0] = high - ratio * (high - low);
            values[0] = function(inner[0])?;
        } else {
            low = inner[0];
            (inner[0], values[0]) = (inner[1], values[1]);
            inner[1] = low + ratio * (high - low);
            values[1] = function(inner[1])?;
        }
    }
    Ok(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;

    use super::*;

    #[test]
    fn a_minimum_inside_and_one_at_an_end_are_found() {
        let parabola = |x: f64| Ok::<_, Infallible>((x - 0.4321) * (x - 0.4321));
        let found = golden_section(0.0, 1.0, 80, parabola).expect("never fails");
        assert!((found - 0.4321).abs() < 1e-15, "{found}");
        let end = golden_section(-2.0, 3.0, 80, Ok::<_, Infallible>).expect("never fails");
        assert!((end + 2.0).abs() < 1e-15, "{end}");
        assert_eq!(golden_section(0.0, 1.0, 3, |_| Err::<f64, _>("no value")), Err("no value"));
    }
}
