//! Feigenbaum's two constants from the doublings of one cascade.
//!
//! The error of a ratio of distances shrinks as 1/delta, because an analytic family is analytic in the
//! coordinate of the unstable direction; ratios of widths depend on the coordinate and have parts that shrink
//! as -1/alpha and 1/alpha^2. For r = 0.1, 0.5 and 0.8 each interval from n = 7 on contains the next value
//! and the known constant. At n = 13:
//!
//! | r | delta | error | alpha | error |
//! | --- | --- | --- | --- | --- |
//! | 0.1 | 4.669 201 609 10 | 3e-10 | 2.502 907 876 | 3e-8 |
//! | 0.5 | 4.669 201 609 | 3e-8 | 2.502 907 874 | 3e-8 |
//! | 0.8 | 4.669 201 6 | 9e-7 | 2.502 907 8 | 6e-7 |
//!
//! Near r = 1 the first doublings resemble doublings of area-preserving maps (ratios up to 7.9 at r = 0.95).
//!
//! A Richardson extrapolation with the ratio's own value removes the first part of a ratio of distances; the
//! remainder shrinks by a factor of -0.12 each time. Ratios of widths need two extrapolations. The stated error
//! is twice the larger of the last two changes, plus four times the effect of rounding on a ratio.

use super::CascadeDoubling;
use super::branch::width_rounding;
use crate::numerics::real::Real;

/// The first doubling with an estimate and its error. Earlier doublings are needed for ratios of distances
/// and widths, for one and two steps of extrapolation, and for two changes of the extrapolated values.
const FIRST_ESTIMATE: usize = 7;

/// An error is this many times the larger of the last two changes.
const CHANGES: f64 = 2.0;

/// A generous bound on the factor by which extrapolation enlarges the rounding of a ratio.
const ENLARGED_ROUNDING: f64 = 4.0;

/// Estimates of Feigenbaum's constants delta = 4.6692016091... and alpha = 2.5029078750... from the doublings
/// up to the last one used. The known values are not used.
///
/// From doubling to doubling, the ratios' distances from their limits shrink by 1/delta and -1/alpha.
/// Extrapolation with the ratios' own values removes this part, and for alpha also the part that shrinks by
/// 1/alpha^2 (docs/numerics-dynamics.md). The error is twice the larger of the last two changes of the
/// extrapolated value, plus rounding: not a bound, but confirmed by the next doubling.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FeigenbaumEstimate {
    /// The number n of the last doubling used.
    pub number: usize,
    /// (Gamma_(n-1) - Gamma_(n-2)) / (Gamma_n - Gamma_(n-1)).
    pub forcing_ratio: f64,
    /// The ratio of the orbits' widths at doublings n - 1 and n.
    pub width_ratio: f64,
    /// delta, extrapolated.
    pub delta: f64,
    /// The estimated error of delta.
    pub delta_error: f64,
    /// The magnitude of alpha, extrapolated.
    pub alpha: f64,
    /// The estimated error of alpha.
    pub alpha_error: f64,
}

/// `delta = 4.66920160910 +- 3e-10, alpha = 2.50290787600 +- 3e-8, from 13 doublings` in extended precision;
/// a given precision is the number of decimals of the constants.
impl core::fmt::Display for FeigenbaumEstimate {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let decimals = formatter.precision().unwrap_or(11);
        let Self { number, delta, delta_error, alpha, alpha_error, .. } = self;
        write!(formatter, "delta = {delta:.decimals$} +- {delta_error:.0e}, ")?;
        write!(formatter, "alpha = {alpha:.decimals$} +- {alpha_error:.0e}, from {number} doublings")
    }
}

/// Feigenbaum's constants from a cascade, one estimate for each doubling from the seventh. Rounding ends
/// their improvement near the eleventh doubling in doubles, and beyond the last one in double-doubles.
///
/// ```
/// use bouncing_disk_core::orbits::{doubling_cascade, feigenbaum_estimates};
/// use bouncing_disk_core::Unobserved;
///
/// let estimates = feigenbaum_estimates(&doubling_cascade(0.5, 10, &Unobserved)?.doublings);
/// let last = estimates.last().expect("from the seventh doubling on");
/// assert!((last.delta - 4.669_201_609).abs() <= last.delta_error && last.delta_error < 1e-4);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[must_use]
pub fn feigenbaum_estimates<R: Real>(cascade: &[CascadeDoubling<R>]) -> Vec<FeigenbaumEstimate> {
    let point = |own: &CascadeDoubling<R>| (own.axial_forcing, own.width, own.forcing_error);
    estimates(&cascade.iter().map(point).collect::<Vec<_>>())
}

/// The values without the part that shrinks by `ratio` from one to the next; `None` for the first values,
/// which have no predecessor.
fn without<R: Real>(values: &[Option<R>], ratio: impl Fn(usize) -> Option<R>) -> Vec<Option<R>> {
    let at = |i: usize| {
        let (before, now, ratio) = (values[i.checked_sub(1)?]?, values[i]?, ratio(i)?);
        Some((now - ratio * before) / (R::of(1.0) - ratio))
    };
    (0..values.len()).map(at).collect()
}

/// An extrapolated value and its error, without rounding.
fn with_error<R: Real>(values: &[Option<R>], i: usize) -> Option<(f64, f64)> {
    let (now, before, first) = (values[i]?, values[i.checked_sub(1)?]?, values[i.checked_sub(2)?]?);
    let changes = [now - before, before - first].map(|change| change.magnitude().value());
    Some((now.value(), CHANGES * changes[0].max(changes[1])))
}

/// The estimates from (forcing, width, error of the forcing) of all doublings from the first.
fn estimates<R: Real>(points: &[(R, R, f64)]) -> Vec<FeigenbaumEstimate> {
    let one = R::of(1.0);
    let distance = |i: usize| points[i].0 - points[i - 1].0;
    let forcing_ratios: Vec<_> =
        (0..points.len()).map(|i| (i >= 2).then(|| distance(i - 1) / distance(i))).collect();
    let width_ratios: Vec<_> =
        (0..points.len()).map(|i| (i >= 2).then(|| points[i - 1].1 / points[i].1)).collect();
    let delta = without(&forcing_ratios, |i| Some(one / forcing_ratios[i]?));
    let alpha = without(&width_ratios, |i| Some(-one / width_ratios[i]?));
    let alpha = without(&alpha, |i| Some(one / (width_ratios[i]? * width_ratios[i]?)));
    let estimate = |i: usize| {
        let number = i + 1;
        let (forcing_ratio, width_ratio) = (forcing_ratios[i]?.value(), width_ratios[i]?.value());
        let ((delta, delta_error), (alpha, alpha_error)) = (with_error(&delta, i)?, with_error(&alpha, i)?);
        let of_distance = 2.0 * points[i].2 / distance(i).value();
        let of_width = 2.0 * width_rounding::<R>(number);
        Some(FeigenbaumEstimate {
            number,
            forcing_ratio,
            width_ratio,
            delta,
            delta_error: delta_error + ENLARGED_ROUNDING * delta * of_distance + f64::EPSILON * delta,
            alpha,
            alpha_error: alpha_error + ENLARGED_ROUNDING * alpha * of_width + f64::EPSILON * alpha,
        })
    };
    (FIRST_ESTIMATE - 1..points.len()).filter_map(estimate).collect()
}
