//! The doubling cascade in double-doubles.

use crate::analysis::cascade::branch::rounding;
use crate::analysis::cascade::feigenbaum::{FeigenbaumEstimate, estimates};
use crate::analysis::cascade::flip_points;
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::observer::Observer;

/// A period doubling of the cascade that starts from the orbit with one impact per period of the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ExtendedDoubling {
    /// Its number n, from 1 on.
    pub number: usize,
    /// Period (in impacts) of the orbit that loses its stability, 2^(n - 1).
    pub period: usize,
    /// The forcing Gamma_n; `{:.25}` writes it with 25 places.
    pub axial_forcing: DoubleDouble,
    /// How far rounding may have moved the forcing.
    pub forcing_error: f64,
    /// The multiplier that the search left, -1 but for rounding.
    pub multiplier: DoubleDouble,
    /// The largest distance (rad) of an impact of the orbit from the one half a period later; 0 for n = 1.
    pub width: DoubleDouble,
    /// How near a flight of the orbit comes to an earlier impact, in units of g/omega^2; infinite where none
    /// dips. A graze within the rounding of a double would need a proof in more digits: a cascade with a
    /// margin below 1e-9 is refused.
    pub graze_margin: f64,
}

/// `Gamma_3 = 0.5401020860760663669196152, of the orbit of 4 impacts`; a precision given is the number of
/// decimals.
impl core::fmt::Display for ExtendedDoubling {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let decimals = formatter.precision().unwrap_or(25);
        let Self { number, period, axial_forcing, .. } = self;
        let impacts = if *period == 1 { "impact" } else { "impacts" };
        write!(formatter, "Gamma_{number} = {axial_forcing:.decimals$}, of the orbit of {period} {impacts}")
    }
}

/// A graze margin that doubles can no longer tell from none (units of g/omega^2): their gap is exact to 1e-14
/// of the peak acceleration and the flight, and the phases here to all their digits.
const UNSURE_MARGIN: f64 = 1.0e-9;

/// [`doubling_cascade`](crate::doubling_cascade) in double-doubles: forcings with an error below 1e-28 for count up to 13.
///
/// The restitution has the digits that it is given: read a decimal one from a text, as `0.1` is none.
///
/// The items of `observer` are the doublings.
///
/// ```
/// # use bouncing_disk_core::Unobserved;
/// use bouncing_disk_core::extended::doubling_cascade;
///
/// let cascade = doubling_cascade("0.5".parse()?, 3, &Unobserved)?;
/// assert_eq!(format!("{:.25}", cascade[2].axial_forcing), "0.5401020860760663669196152");
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// Those of [`doubling_cascade`](crate::doubling_cascade); [`Error::NotSettled`] with the margin where an
/// orbit of the cascade comes so near to an earlier impact that doubles cannot exclude it.
pub fn doubling_cascade(
    restitution: DoubleDouble,
    count: usize,
    observer: &dyn Observer,
) -> Result<Vec<ExtendedDoubling>, Error> {
    let found = flip_points(restitution, count, observer)?;
    let described = found.iter().map(|found| {
        let (number, graze_margin) = (found.number, found.graze_margin);
        if graze_margin < UNSURE_MARGIN {
            return Err(Error::NotSettled {
                what: "graze of a cascade in doubles",
                iterations: number as u32,
                residual: graze_margin,
            });
        }
        let axial_forcing = found.point.peak / DoubleDouble::PI;
        Ok(ExtendedDoubling {
            number,
            period: found.point.times.len(),
            axial_forcing,
            forcing_error: axial_forcing.high() * rounding::<DoubleDouble>(number),
            multiplier: found.point.multiplier,
            width: found.point.width,
            graze_margin,
        })
    });
    described.collect()
}

/// The forcing Gamma_1 in closed form, as
/// [`ImpactMap::first_doubling_forcing`](crate::ImpactMap::first_doubling_forcing): sqrt(((1-r)/(1+r))^2 + (2
/// (1+r^2)/(pi (1+r)^2))^2).
#[must_use]
pub fn first_doubling_forcing(restitution: DoubleDouble) -> DoubleDouble {
    let (r, one) = (restitution, DoubleDouble::ONE);
    let sum = one + r;
    let threshold = (one - r) / sum;
    let height = DoubleDouble::from(2.0) * (one + r * r) / (DoubleDouble::PI * sum * sum);
    (threshold * threshold + height * height).sqrt()
}

/// Feigenbaum's constants from a cascade in double-doubles, one estimate for each doubling from the seventh
/// on.
///
/// ```
/// # use bouncing_disk_core::Unobserved;
/// use bouncing_disk_core::extended::{doubling_cascade, feigenbaum_estimates};
///
/// let estimates = feigenbaum_estimates(&doubling_cascade("0.5".parse()?, 8, &Unobserved)?);
/// assert_eq!(estimates.len(), 2);
/// assert!((estimates[1].alpha - 2.502_907_875).abs() <= estimates[1].alpha_error);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[must_use]
pub fn feigenbaum_estimates(cascade: &[ExtendedDoubling]) -> Vec<FeigenbaumEstimate> {
    let points: Vec<_> = cascade.iter().map(|doubling| (doubling.axial_forcing, doubling.width)).collect();
    estimates(&points)
}

#[cfg(test)]
mod tests;
