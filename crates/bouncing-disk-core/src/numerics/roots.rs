//! Roots and minima of functions of one variable inside a bracket. The root of Eq. 11 is in `flight/gap.rs`.

/// The point between `low` and `high` at which `is_below` changes from true to false, by `steps` halvings:
/// the middle of the last bracket. `is_below` is not called at the ends, which count as true and false.
///
/// # Errors
/// Errors of `is_below`.
pub fn bisection<E>(
    low: f64,
    high: f64,
    steps: u32,
    is_below: impl FnMut(f64) -> Result<bool, E>,
) -> Result<f64, E> {
    let (low, high) = bisected_bracket(low, high, steps, is_below)?;
    Ok(0.5 * (low + high))
}

/// Like [`bisection`], but returns the last bracket: `is_below` is true at its first end and false at its
/// second, if the same holds at `low` and `high`.
///
/// # Errors
/// Errors of `is_below`.
pub fn bisected_bracket<E>(
    low: f64,
    high: f64,
    steps: u32,
    is_below: impl FnMut(f64) -> Result<bool, E>,
) -> Result<(f64, f64), E> {
    let mut left = steps;
    let is_wide = |_, _| {
        let goes_on = left > 0;
        left = left.saturating_sub(1);
        goes_on
    };
    halved_while(low, high, is_wide, is_below)
}

/// Like [`bisected_bracket`], but halves until the bracket is no wider than `width`, or its ends are
/// neighbouring doubles. An end that is NaN ends the search at once.
///
/// # Errors
/// Errors of `is_below`.
pub fn bracket_of_width<E>(
    low: f64,
    high: f64,
    width: f64,
    is_below: impl FnMut(f64) -> Result<bool, E>,
) -> Result<(f64, f64), E> {
    let is_wide = |low: f64, high: f64| {
        let middle = 0.5 * (low + high);
        high - low > width && low < middle && middle < high
    };
    halved_while(low, high, is_wide, is_below)
}

/// Halves the bracket as long as `is_wide` holds for it.
fn halved_while<E>(
    mut low: f64,
    mut high: f64,
    mut is_wide: impl FnMut(f64, f64) -> bool,
    mut is_below: impl FnMut(f64) -> Result<bool, E>,
) -> Result<(f64, f64), E> {
    while is_wide(low, high) {
        let middle = 0.5 * (low + high);
        if is_below(middle)? {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok((low, high))
}

/// The root between `low` and `high` of a function that is positive below it and negative above it, to the
/// relative `accuracy`: Newton steps, replaced by bisection if they leave the bracket or fail to halve the
/// step before the last.
///
/// `function` returns the value and its derivative; `at_low` is this pair at `low`, which the caller often
/// knows. If the value there is not positive, or the bracket is empty, `low` is the root.
#[inline(always)]
pub fn falling_root(
    mut low: f64,
    mut high: f64,
    at_low: (f64, f64),
    accuracy: f64,
    mut function: impl FnMut(f64) -> (f64, f64),
) -> f64 {
    let (start, rate) = at_low;
    if start <= 0.0 || high <= low {
        return low;
    }
    let newton = low - start / rate;
    let mut place = if rate < 0.0 && newton < high { newton } else { 0.5 * (low + high) };
    let mut last_step = high - low;
    let mut last_but_one = last_step;
    loop {
        let (value, rate) = function(place);
        if value == 0.0 {
            return place;
        }
        if value > 0.0 {
            low = place;
        } else {
            high = place;
        }
        let newton = place - value / rate;
        let step = (newton - place).abs();
        let next = if rate < 0.0 && newton > low && newton < high && 2.0 * step <= last_but_one {
            newton
        } else {
            0.5 * (low + high)
        };
        last_but_one = last_step;
        last_step = (next - place).abs();
        // The bisected bracket cannot shrink below two neighbours.
        if last_step <= accuracy * next.abs() || next <= low || next >= high {
            return next.clamp(low, high);
        }
        place = next;
    }
}

/// The minimum of a function that has one between `low` and `high`, by golden-section search: each of `steps`
/// steps narrows the bracket by the factor 0.618, and its middle is returned. The values of a function
/// determine the location of a smooth minimum to only half of their digits.
///
/// # Errors
/// Errors of `function`.
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

    #[test]
    fn a_bisection_ends_at_the_change() {
        let below = |x: f64| Ok::<_, Infallible>(x < 0.4321);
        let Ok(found) = bisection(0.0, 1.0, 50, below);
        assert!((found - 0.4321).abs() < 1e-15, "{found}");
        assert_eq!(bisection(0.0, 1.0, 3, |_| Err("no answer")), Err("no answer"));
        assert_eq!(bisection(1.0, 3.0, 0, below), Ok(2.0));
    }

    #[test]
    fn a_bracket_holds_the_change() {
        let below = |x: f64| Ok::<_, Infallible>(x < 0.4321);
        assert_eq!(bisected_bracket(0.0, 1.0, 2, below), Ok((0.25, 0.5)));
        let Ok((low, high)) = bisected_bracket(0.0, 1.0, 60, below);
        assert!(low < 0.4321 && high >= 0.4321 && high - low <= f64::EPSILON, "{low} {high}");
        assert_eq!(bracket_of_width(0.0, 1.0, 0.25, below), Ok((0.25, 0.5)));
        assert_eq!(bracket_of_width(0.0, 1.0, 1.0, below), Ok((0.0, 1.0)));
        let Ok((low, high)) = bracket_of_width(0.0, 1.0, 0.0, below);
        assert_eq!((low.next_up(), high), (0.4321, 0.4321));
        assert_eq!(bracket_of_width(0.0, 1.0, 0.1, |_| Err("no answer")), Err("no answer"));
        let Ok((low, high)) = bracket_of_width(f64::NAN, 1.0, 0.1, below);
        assert!(low.is_nan() && high >= 1.0, "{low} {high}");
    }

    /// A simple root, a steep one at the end of a plateau, a triple one, and one at the upper end.
    #[test]
    fn falling_functions_are_followed_to_their_root() {
        let find = |high: f64, function: fn(f64) -> (f64, f64)| {
            falling_root(0.0, high, function(0.0), 2.0 * f64::EPSILON, function)
        };
        assert!((find(3.0, |x| (2.0 - x * x, -2.0 * x)) - 2.0_f64.sqrt()).abs() < 1e-15);
        assert!((find(1e9, |x| (1.0 - 1e-6 * x, -1e-6)) - 1e6).abs() < 1e-9);
        let cube = |x: f64| ((1.0 - x) * (1.0 - x) * (1.0 - x), -3.0 * (1.0 - x) * (1.0 - x));
        assert!((find(4.0, cube) - 1.0).abs() < 1e-5);
        assert!((find(1.0, |x| (1.0 - x, -1.0)) - 1.0).abs() < 1e-15);
        assert!(find(1.0, |x| (-x, -1.0)).abs() <= 0.0, "no value at the start");
        assert!(find(-1.0, |x| (1.0 - x, -1.0)).abs() <= 0.0, "no bracket");
    }
}
