//! The period-doubling cascade to as many digits as the arithmetic carries: from one doubling to the next by
//! Newton's iteration on the impact times (docs/numerics/dynamics.md, "The doubling cascade").

pub(crate) mod branch;
pub(crate) mod feigenbaum;
mod recurrence;

use self::branch::{FlipPoint, first_flip, next_flip, rounding};
use super::periodic::MAX_PERIOD;
use crate::error::{Error, within};
use crate::numerics::real::Real;
use crate::observer::{Observer, Watch};

/// The largest number of doublings: the last one is that of the orbit of period [`MAX_PERIOD`].
pub const MAX_DOUBLINGS: usize = 13;

/// A period doubling of the cascade that starts from the orbit with one impact per period of the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CascadeDoubling {
    /// Its number n, from 1 on.
    pub number: usize,
    /// Period (in impacts) of the orbit that loses its stability, 2^(n - 1).
    pub period: usize,
    /// The forcing Gamma_n.
    pub axial_forcing: f64,
    /// How far rounding may have moved the forcing.
    pub forcing_error: f64,
    /// The multiplier that the search left, -1 but for rounding: this grows 6.6 times from one doubling to
    /// the next.
    pub multiplier: f64,
    /// The largest distance (rad) of an impact of the orbit from the one half a period later; 0 for n = 1.
    pub width: f64,
    /// How near a flight of the orbit comes to an earlier impact, in units of g/omega^2; infinite where none
    /// dips.
    pub graze_margin: f64,
}

/// `Gamma_3 = 0.5401020860760664, of the orbit of 4 impacts`; a precision given is the number of decimals.
impl core::fmt::Display for CascadeDoubling {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { number, period, axial_forcing, .. } = self;
        let impacts = if *period == 1 { "impact" } else { "impacts" };
        write!(formatter, "Gamma_{number} = ")?;
        core::fmt::Display::fmt(axial_forcing, formatter)?;
        write!(formatter, ", of the orbit of {period} {impacts}")
    }
}

/// The first `count` <= [`MAX_DOUBLINGS`] period doublings of the orbit with one impact per period of the
/// platform, for `restitution` in (0, 1), in doubles.
///
/// Every forcing is the one of a multiplier of -1, within [`CascadeDoubling::forcing_error`]: at most 1.5e-13
/// at the thirteenth. What rounding leaves of the digits grows 6.6 times in the multiplier and 1.4 times in
/// the forcing from one doubling to the next (docs/numerics/dynamics.md); the distances of the doublings
/// shrink 4.67 times, so that ratios of distances have six digits at the twelfth.
/// `extended::doubling_cascade` (feature `extended`) has sixteen more.
///
/// The items of `observer` are the doublings.
///
/// ```
/// use bouncing_disk_core::{ImpactMap, Unobserved, doubling_cascade};
///
/// let cascade = doubling_cascade(0.5, 4, &Unobserved)?;
/// assert!((cascade[0].axial_forcing - ImpactMap::first_doubling_forcing(0.5)).abs() < 1e-15);
/// assert_eq!(cascade[3].period, 8);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for the restitution or the count; [`Error::NotSettled`] if a branch is lost;
/// [`Error::EarlierImpact`] if a branch ends because its orbit meets the platform earlier.
pub fn doubling_cascade(
    restitution: f64,
    count: usize,
    observer: &dyn Observer,
) -> Result<Vec<CascadeDoubling>, Error> {
    let found = flip_points(restitution, count, observer)?;
    let described = found.iter().map(|found| {
        let axial_forcing = found.point.peak / core::f64::consts::PI;
        CascadeDoubling {
            number: found.number,
            period: found.point.times.len(),
            axial_forcing,
            forcing_error: axial_forcing * rounding::<f64>(found.number),
            multiplier: found.point.multiplier,
            width: found.point.width,
            graze_margin: found.graze_margin,
        }
    });
    Ok(described.collect())
}

/// A doubling, its number, and the smallest graze margin of its orbit.
#[derive(Debug)]
pub(crate) struct Found<R> {
    pub(crate) number: usize,
    pub(crate) point: FlipPoint<R>,
    pub(crate) graze_margin: f64,
}

/// The first doublings in any precision.
pub(crate) fn flip_points<R: Real>(
    restitution: R,
    count: usize,
    observer: &dyn Observer,
) -> Result<Vec<Found<R>>, Error> {
    const { assert!(1 << (MAX_DOUBLINGS - 1) == MAX_PERIOD) };
    within("restitution", restitution.value(), f64::MIN_POSITIVE, 1.0 - f64::EPSILON, "(0, 1)")?;
    within("count", count as f64, 0.0, MAX_DOUBLINGS as f64, "[0, 13]")?;
    let watch = Watch::begin(observer, 0, count as u64)?;
    let mut work = watch.work();
    let tick = &mut |impacts| work.spend(impacts);
    let mut found: Vec<Found<R>> = Vec::with_capacity(count);
    for number in 1..=count {
        let point = match found.last() {
            None => first_flip(restitution, tick)?,
            Some(last) => next_flip(&last.point, number, restitution, tick)?,
        };
        let graze_margin = point.graze_margin(restitution)?;
        found.push(Found { number, point, graze_margin });
        watch.finish(1);
    }
    watch.end();
    Ok(found)
}

#[cfg(test)]
mod tests;
