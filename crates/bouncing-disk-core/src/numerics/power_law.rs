//! Power laws y = c x^exponent fitted to numbers with known errors, or the reason why there is none.

use crate::numerics::elementary::{exp, ln};
use crate::numerics::error::{Error, finite, not_negative, within};
use crate::numerics::stored::read_checked;

/// A point of a supposed power law.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedPoint"))]
pub struct PowerLawPoint {
    /// The abscissa, above 0.
    pub x: f64,
    /// The value, above 0.
    pub y: f64,
    /// Relative standard error of y, above 0.
    pub relative_error: f64,
}

read_checked!(PowerLawPoint as UncheckedPoint { x: f64, y: f64, relative_error: f64 });

impl PowerLawPoint {
    fn check(&self) -> Result<(), Error> {
        for (field, value) in [
            ("x of a power law", self.x),
            ("y of a power law", self.y),
            ("relative error of a power law", self.relative_error),
        ] {
            within(field, value, f64::MIN_POSITIVE, f64::MAX, "(0, inf)")?;
        }
        Ok(())
    }
}

/// A power law y = c x^exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedLaw"))]
pub struct PowerLaw {
    /// The exponent.
    pub exponent: f64,
    /// Its standard error, from the errors of the points or from their scatter about the law, whichever is
    /// larger.
    pub standard_error: f64,
    /// ln c.
    pub log_factor: f64,
    /// The smallest and the largest x of the fit.
    pub range: (f64, f64),
    /// The number of points.
    pub points: usize,
    /// Root mean square distance of the points from the law in units of their errors (about 1 if the errors
    /// explain the scatter).
    pub scatter: f64,
}

read_checked!(PowerLaw as UncheckedLaw {
    exponent: f64,
    standard_error: f64,
    log_factor: f64,
    range: (f64, f64),
    points: usize,
    scatter: f64,
});

impl PowerLaw {
    fn check(&self) -> Result<(), Error> {
        finite("exponent", self.exponent)?;
        finite("logarithm of a factor", self.log_factor)?;
        not_negative("standard error of an exponent", self.standard_error)?;
        not_negative("scatter", self.scatter)?;
        within("low end of a fit", self.range.0, f64::MIN_POSITIVE, self.range.1, "(0, high end]")?;
        Ok(())
    }

    /// The law at x > 0.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        exp(self.log_factor + self.exponent * ln(x))
    }
}

/// The reason why there is no power law.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum NoPowerLaw {
    /// There are too few points to recognise a power law.
    #[error("a power-law fit needs {needed} points, but there are {found}")]
    TooFewPoints {
        /// The number of points.
        found: usize,
        /// The number needed.
        needed: usize,
    },
    /// The points cover too small a range.
    #[error("the points span a factor of {factor:e}, but a power-law fit needs {needed}")]
    TooNarrow {
        /// The largest x over the smallest.
        factor: f64,
        /// The factor needed.
        needed: f64,
    },
    /// The points lie on a curve: a parabola in the logarithms has a significant quadratic term.
    #[error(
        "no power law: the exponent is {lower:.3} in the lower half and {upper:.3} in the upper half, {sigmas:.1} \
         standard errors apart"
    )]
    Bends {
        /// Exponent of the lower half.
        lower: f64,
        /// Exponent of the upper half.
        upper: f64,
        /// The coefficient of the quadratic term in units of its standard error.
        sigmas: f64,
    },
    /// The points scatter about every line by far more than their errors.
    #[error(
        "no power law: the points scatter by {scatter:.1} times their errors, or by a factor of {factor:.2}"
    )]
    Scatters {
        /// Root mean square distance in units of the errors.
        scatter: f64,
        /// The scatter as a factor of y.
        factor: f64,
    },
}

/// Fewest points of a power law.
pub const FEWEST_POINTS: usize = 6;

/// The least ratio of the largest x to the smallest one.
pub const LEAST_FACTOR: f64 = 10.0;

/// Largest distance of a parabola's quadratic coefficient from 0, in standard errors.
const MOST_SIGMAS: f64 = 3.5;

/// The largest accepted root mean square scatter in units of the errors, unless it is within [`MOST_FACTOR`].
const MOST_SCATTER: f64 = 3.0;

/// The root mean square scatter (of ln y) that is always accepted, a factor of two. Numbers that oscillate
/// about a law, like survival times beyond a crisis, still have an exponent, with a larger error.
const MOST_FACTOR: f64 = core::f64::consts::LN_2;

/// A straight line through (ln x, ln y).
#[derive(Debug, Clone, Copy)]
struct StraightLine {
    slope: f64,
    error: f64,
    at_zero: f64,
    /// Sum of squared distances, in units of the errors and in ln y.
    squares: (f64, f64),
}

fn straight_line(points: &[PowerLawPoint]) -> StraightLine {
    let weight = |point: &PowerLawPoint| 1.0 / (point.relative_error * point.relative_error);
    let total = points.iter().fold(0.0, |sum, point| sum + weight(point));
    let mean = |of: fn(&PowerLawPoint) -> f64| {
        points.iter().fold(0.0, |sum, point| sum + weight(point) * ln(of(point))) / total
    };
    let (x, y) = (mean(|point| point.x), mean(|point| point.y));
    let (mut width, mut product) = (0.0, 0.0);
    for point in points {
        let (dx, dy) = (ln(point.x) - x, ln(point.y) - y);
        width += weight(point) * (dx * dx);
        product += weight(point) * (dx * dy);
    }
    // If all x are equal, there is no slope.
    let slope = if width > 0.0 { product / width } else { 0.0 };
    let squares = points.iter().fold((0.0, 0.0), |(own, all), point| {
        let off = ln(point.y) - y - slope * (ln(point.x) - x);
        (own + weight(point) * (off * off), all + off * off)
    });
    StraightLine { slope, error: (1.0 / width).sqrt(), at_zero: y - slope * x, squares }
}

/// The power law through points with errors, by least squares in the logarithms; or the reason why there is
/// none.
///
/// ```
/// use bouncing_disk_core::numerics::power_law::{NoPowerLaw, PowerLawPoint, fit_power_law};
///
/// let at = |x: f64, y: f64| PowerLawPoint { x, y, relative_error: 0.01 };
/// let points: Vec<_> = [1.0, 3.0, 10.0, 30.0, 100.0, 300.0].iter().map(|&x| at(x, 2.0 / x)).collect();
/// let law = fit_power_law(&points)?.expect("a power law");
/// assert!((law.exponent + 1.0).abs() < 1e-12);
/// let bent: Vec<_> = points.iter().map(|point| at(point.x, 2.0 / (1.0 + point.x))).collect();
/// assert!(matches!(fit_power_law(&bent)?, Err(NoPowerLaw::Bends { .. })));
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for a point with a number that is not above 0 and finite.
pub fn fit_power_law(points: &[PowerLawPoint]) -> Result<Result<PowerLaw, NoPowerLaw>, Error> {
    for point in points {
        point.check()?;
    }
    let mut points = points.to_vec();
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let n = points.len();
    if n < FEWEST_POINTS {
        return Ok(Err(NoPowerLaw::TooFewPoints { found: n, needed: FEWEST_POINTS }));
    }
    let range = (points[0].x, points[n - 1].x);
    // As logarithms, because the quotient may overflow a double.
    if ln(range.1) - ln(range.0) < ln(LEAST_FACTOR) * (1.0 - 1.0e-12) {
        return Ok(Err(NoPowerLaw::TooNarrow { factor: range.1 / range.0, needed: LEAST_FACTOR }));
    }
    let whole = straight_line(&points);
    let degrees = (n - 2) as f64;
    let scatter = (whole.squares.0 / degrees).sqrt();
    let factor = (whole.squares.1 / degrees).sqrt();
    let bend = curvature(&points);
    if bend > MOST_SIGMAS {
        let (lower, upper) = (straight_line(&points[..n.div_ceil(2)]), straight_line(&points[n / 2..]));
        return Ok(Err(NoPowerLaw::Bends { lower: lower.slope, upper: upper.slope, sigmas: bend }));
    }
    if scatter > MOST_SCATTER && factor > MOST_FACTOR {
        return Ok(Err(NoPowerLaw::Scatters { scatter, factor: exp(factor) }));
    }
    Ok(Ok(PowerLaw {
        exponent: whole.slope,
        standard_error: whole.error * scatter.max(1.0),
        log_factor: whole.at_zero,
        range,
        points: n,
        scatter,
    }))
}

/// The coefficient of the quadratic term of a parabola through (ln x, ln y), in units of its standard error.
/// The error comes from the errors of the points or from their scatter about the parabola, whichever is
/// larger. Zero if the points do not determine the coefficient.
fn curvature(points: &[PowerLawPoint]) -> f64 {
    let weight = |point: &PowerLawPoint| 1.0 / (point.relative_error * point.relative_error);
    let sum = |of: &dyn Fn(&PowerLawPoint) -> f64| {
        points.iter().fold(0.0, |sum, point| sum + weight(point) * of(point))
    };
    let total = sum(&|_| 1.0);
    let middle = sum(&|point| ln(point.x)) / total;
    let u = |point: &PowerLawPoint| ln(point.x) - middle;
    // The quadratic term, made orthogonal to the straight line.
    let (second, third) = (sum(&|point| u(point) * u(point)), sum(&|point| u(point) * (u(point) * u(point))));
    let square = |point: &PowerLawPoint| u(point) * u(point) - third / second * u(point) - second / total;
    let (width, product) =
        (sum(&|point| square(point) * square(point)), sum(&|point| square(point) * ln(point.y)));
    let line = straight_line(points);
    let coefficient = product / width;
    let left = (line.squares.0 - coefficient * product).max(0.0) / (points.len() - 3) as f64;
    let sigmas = (coefficient * coefficient * width / left.max(1.0)).sqrt();
    if sigmas.is_finite() { sigmas } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::SplitMix64;

    fn law(exponent: f64, count: usize, error: f64, random: &mut SplitMix64) -> Vec<PowerLawPoint> {
        let gauss = |random: &mut SplitMix64| (0..12).fold(-6.0, |sum, _| sum + random.unit());
        (0..count)
            .map(|i| {
                let x = exp(-(i as f64));
                let y = 3.0 * exp(exponent * ln(x) + error * gauss(random));
                PowerLawPoint { x, y, relative_error: error }
            })
            .collect()
    }

    #[test]
    fn the_error_is_that_of_the_points() {
        let mut random = SplitMix64::new(5);
        let (mut off, mut within, mut refused) = (0.0, 0, 0);
        let rounds = 400;
        for _ in 0..rounds {
            match fit_power_law(&law(-0.8, 10, 0.05, &mut random)).expect("legal") {
                Ok(fit) => {
                    let error = (fit.exponent + 0.8) / fit.standard_error;
                    off += error * error;
                    within += usize::from(error.abs() < 2.0);
                    assert!((fit.log_factor - ln(3.0)).abs() < 0.3 && fit.points == 10);
                    assert!((fit.at(0.1) / (3.0 * exp(-0.8 * ln(0.1))) - 1.0).abs() < 0.2);
                }
                Err(_) => refused += 1,
            }
        }
        let spread = (off / f64::from(rounds)).sqrt();
        assert!((0.8..1.1).contains(&spread) && within > 370 && refused < 4, "{spread} {within} {refused}");
    }

    #[test]
    fn what_is_no_power_law_is_refused_with_the_reason() {
        let mut random = SplitMix64::new(6);
        let exact = law(-1.0, 12, 0.01, &mut random);
        assert!(fit_power_law(&exact).expect("legal").is_ok());
        let found = |points: &[PowerLawPoint]| fit_power_law(points).expect("legal").expect_err("none");
        let mapped = |of: fn(f64) -> f64| -> Vec<_> {
            exact.iter().map(|point| PowerLawPoint { y: of(point.x), ..*point }).collect()
        };
        assert!(matches!(found(&mapped(|x| exp(-3.0 * x))), NoPowerLaw::Bends { .. }));
        assert!(
            matches!(found(&mapped(|x| 1.0 / (0.01 + x))), NoPowerLaw::Bends { sigmas, .. } if sigmas > 10.0)
        );
        let rough: Vec<_> = exact
            .iter()
            .enumerate()
            .map(|(i, point)| PowerLawPoint { y: if i % 2 == 0 { point.y } else { 9.0 * point.y }, ..*point })
            .collect();
        assert!(matches!(found(&rough), NoPowerLaw::Scatters { factor, .. } if factor > 2.0));
        assert_eq!(found(&[]), NoPowerLaw::TooFewPoints { found: 0, needed: FEWEST_POINTS });
        assert_eq!(found(&exact[..5]), NoPowerLaw::TooFewPoints { found: 5, needed: FEWEST_POINTS });
        let same = vec![exact[0]; 9];
        assert!(
            matches!(found(&same), NoPowerLaw::TooNarrow { factor, .. } if factor.to_bits() == 1.0_f64.to_bits())
        );
    }

    #[test]
    fn a_half_without_width_has_no_slope() {
        let mut random = SplitMix64::new(7);
        let mut points = law(-1.0, 8, 0.01, &mut random);
        for point in &mut points[..5] {
            point.x = 1.0;
        }
        let outcome = fit_power_law(&points).expect("legal");
        let finite = match outcome {
            Ok(law) => law.exponent.is_finite() && law.standard_error.is_finite(),
            Err(NoPowerLaw::Bends { lower, upper, .. }) => lower.is_finite() && upper.is_finite(),
            Err(_) => true,
        };
        assert!(finite, "{outcome:?}");
    }

    #[test]
    fn points_may_go_from_one_end_of_the_doubles_to_the_other() {
        let wide: Vec<_> = (0..20)
            .map(|i| {
                let x = exp(-700.0 + 70.0 * f64::from(i));
                PowerLawPoint { x, y: exp(0.5 * (700.0 - 70.0 * f64::from(i))), relative_error: 0.1 }
            })
            .collect();
        let fit = fit_power_law(&wide).expect("legal").expect("a law");
        assert!((fit.exponent + 0.5).abs() < 1e-10 && fit.scatter < 1e-9, "{fit:?}");
    }
}
