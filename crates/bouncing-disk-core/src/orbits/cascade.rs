//! The period-doubling cascade to as many digits as the arithmetic carries: from one doubling to the next by
//! Newton's iteration on the impact times (docs/numerics-dynamics.md, "The doubling cascade").
//!
//! No step iterates the map to convergence, so slow attraction does not matter. For r = 0.1, 0.5 and 0.8 no
//! flight's gap has another minimum; for r = 0.01 the orbit of the third doubling would dip through the
//! platform.
//!
//! In doubles the forcings can be computed to n = 13: the stated error is 9e-14 at n = 12 for r = 0.1, and
//! the differences from double-doubles are at most 6e-15 for r = 0.1, 0.5 and 0.8. The multiplier differs
//! from -1 by up to 3e-6 there, and ratios of distances keep six digits at n = 12. In double-doubles these
//! errors are 3e-29 for the forcings and 4e-22 for the multiplier.

pub(crate) mod branch;
pub(crate) mod feigenbaum;
mod recurrence;

use self::branch::{FlipPoint, first_flip, next_flip, rounding};
use crate::numerics::error::{Error, within};
use crate::numerics::real::Real;
use crate::orbits::periodic::MAX_PERIOD;
use crate::run::{Observer, Watch};

/// The largest number of doublings: the last one is the doubling of the orbit of period [`MAX_PERIOD`].
pub const MAX_DOUBLINGS: usize = 13;

/// A graze margin that doubles cannot distinguish from zero (units of g/omega^2): a gap is exact to 1e-14 of
/// the peak acceleration and the flight, and the phases here are exact to all their digits.
const UNSURE_MARGIN: f64 = 1.0e-9;

/// A period doubling of the cascade that starts at the orbit with one impact per period of the platform.
///
/// `R` is the kind of number: `f64`, or [`DoubleDouble`](crate::numerics::double_double::DoubleDouble).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CascadeDoubling<R = f64> {
    /// Its number n, counted from 1.
    pub number: usize,
    /// Period (in impacts) of the orbit that loses its stability, 2^(n - 1).
    pub period: usize,
    /// The forcing Gamma_n.
    pub axial_forcing: R,
    /// A bound on the error of the forcing due to rounding.
    pub forcing_error: f64,
    /// The multiplier that the search reached: -1 up to rounding, which grows 6.6 times from one doubling to
    /// the next.
    pub multiplier: R,
    /// The largest distance (rad) of an impact of the orbit from the one half a period later; 0 for n = 1.
    pub width: R,
    /// The smallest graze margin of the orbit's flights, in units of g/omega^2; infinite if no flight has
    /// one; NaN on a drive.
    pub graze_margin: f64,
}

/// `Gamma_3 = 0.5401020860760664, of the orbit of 4 impacts`; a given precision is the number of decimals.
impl<R: Real> core::fmt::Display for CascadeDoubling<R> {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { number, period, axial_forcing, .. } = self;
        let impacts = if *period == 1 { "impact" } else { "impacts" };
        write!(formatter, "Gamma_{number} = ")?;
        core::fmt::Display::fmt(axial_forcing, formatter)?;
        write!(formatter, ", of the orbit of {period} {impacts}")
    }
}

/// The doublings found, and the reason if there are fewer than requested.
#[derive(Debug, Clone, PartialEq)]
pub struct DoublingCascade<R = f64> {
    /// The doublings in order, at least one.
    pub doublings: Vec<CascadeDoubling<R>>,
    /// The error that ended the cascade before the requested number of doublings.
    pub ended_by: Option<Error>,
}

impl<R> DoublingCascade<R> {
    /// All requested doublings.
    ///
    /// # Errors
    /// The error that ended the cascade early.
    pub fn complete(self) -> Result<Vec<CascadeDoubling<R>>, Error> {
        self.ended_by.map_or(Ok(self.doublings), Err)
    }
}

/// The first `count` period doublings of the orbit with one impact per period of the platform, to all digits
/// of the number type of `restitution`. The restitution is in (0, 1) and `count` in [1, [`MAX_DOUBLINGS`]].
///
/// In doubles the multiplier is -1 within [`CascadeDoubling::forcing_error`] of every stated forcing; this
/// error is at most 1.5e-13 at the thirteenth doubling. From one doubling to the next the rounding error
/// grows 6.6 times in the multiplier and 1.4 times in the forcing (docs/numerics-dynamics.md). The distances
/// between doublings shrink 4.67 times, so ratios of distances have six digits at the twelfth.
/// [`DoubleDouble`](crate::numerics::double_double::DoubleDouble) adds sixteen digits; with it, parse a
/// decimal restitution from text, because the double `0.1` is not exactly a tenth.
///
/// The items of `observer` are the doublings.
///
/// ```
/// use bouncing_disk_core::numerics::double_double::DoubleDouble;
/// use bouncing_disk_core::orbits::doubling_cascade;
/// use bouncing_disk_core::{ImpactMap, Unobserved};
///
/// let cascade = doubling_cascade(0.5, 4, &Unobserved)?.doublings;
/// assert!((cascade[0].axial_forcing - ImpactMap::first_doubling_forcing(0.5)).abs() < 1e-15);
/// assert_eq!(cascade[3].period, 8);
///
/// let restitution: DoubleDouble = "0.5".parse()?;
/// let cascade = doubling_cascade(restitution, 3, &Unobserved)?.doublings;
/// assert_eq!(format!("{:.25}", cascade[2].axial_forcing), "0.5401020860760663669196152");
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// A cascade may end early. It ends with [`Error::NotSettled`] if a branch is lost or if an orbit comes so
/// near an earlier impact that doubles cannot decide; in the second case the residual is the margin. It ends
/// with [`Error::EarlierImpact`] if the orbit hits the platform earlier. The result then contains the error
/// and the doublings before it.
///
/// # Errors
/// [`Error::OutOfRange`] for the restitution or the count; [`Error::Stopped`] if the observer breaks; the
/// error that ends the cascade before its first doubling.
pub fn doubling_cascade<R: Real>(
    restitution: R,
    count: usize,
    observer: &dyn Observer,
) -> Result<DoublingCascade<R>, Error> {
    let (found, lost) = flip_points(restitution, count, observer)?;
    let mut described = found.iter().map(|found| {
        let (number, graze_margin) = (found.number, found.graze_margin);
        // The margin is computed in doubles, and proves nothing about further digits.
        if R::EPSILON < f64::EPSILON && graze_margin < UNSURE_MARGIN {
            let (what, iterations) = ("graze of a cascade in doubles", number as u32);
            return Err(Error::NotSettled { what, iterations, residual: graze_margin });
        }
        let axial_forcing = found.point.peak / R::PI;
        Ok(CascadeDoubling {
            number,
            period: found.point.times.len(),
            axial_forcing,
            forcing_error: axial_forcing.value() * rounding::<R>(number),
            multiplier: found.point.multiplier,
            width: found.point.width,
            graze_margin,
        })
    });
    let mut unsure = None;
    let doublings: Vec<_> = described
        .by_ref()
        .map_while(|doubling| doubling.map_err(|error| unsure = Some(error)).ok())
        .collect();
    match unsure.or(lost) {
        Some(error) if doublings.is_empty() => Err(error),
        ended_by => Ok(DoublingCascade { doublings, ended_by }),
    }
}

/// A doubling, its number, and the smallest graze margin of its orbit.
#[derive(Debug)]
pub(crate) struct Found<R> {
    pub(crate) number: usize,
    pub(crate) point: FlipPoint<R>,
    pub(crate) graze_margin: f64,
}

/// The first doublings in any precision, and the reason why there is no further one.
pub(crate) fn flip_points<R: Real>(
    restitution: R,
    count: usize,
    observer: &dyn Observer,
) -> Result<(Vec<Found<R>>, Option<Error>), Error> {
    const { assert!(1 << (MAX_DOUBLINGS - 1) == MAX_PERIOD) };
    within("restitution", restitution.value(), f64::MIN_POSITIVE, 1.0 - f64::EPSILON, "(0, 1)")?;
    within("count", count as f64, 1.0, MAX_DOUBLINGS as f64, "[1, 13]")?;
    let watch = Watch::begin(observer, 0, count as u64)?;
    let mut work = watch.work();
    let tick = &mut |impacts| work.spend(impacts);
    let mut found: Vec<Found<R>> = Vec::with_capacity(count);
    let mut ended_by = None;
    for number in 1..=count {
        let point = match found.last() {
            None => first_flip(restitution, tick),
            Some(last) => next_flip(&last.point, number, restitution, tick),
        };
        match point.and_then(|point| Ok((point.graze_margin(restitution)?, point))) {
            Ok((graze_margin, point)) => found.push(Found { number, point, graze_margin }),
            Err(stopped @ Error::Stopped { .. }) => return Err(stopped),
            Err(error) => {
                ended_by = Some(error);
                break;
            }
        }
        watch.finish(1);
    }
    watch.end();
    Ok((found, ended_by))
}

#[cfg(test)]
mod tests;
