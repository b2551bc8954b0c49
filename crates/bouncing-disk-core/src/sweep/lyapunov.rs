//! The largest Lyapunov exponent of an orbit.

pub(crate) mod spectrum;

use core::ops::ControlFlow;

use glam::{DMat2, DVec2};

use crate::chatter::policy::ChatterPolicy;
use crate::map::impact_map::ImpactState;
use crate::numerics::batch_means::BatchMeans;
use crate::numerics::elementary::{hypot, ln};
use crate::numerics::error::{Error, finite, not_negative, within};
use crate::numerics::stored::read_checked;
use crate::run::Observer;
use crate::sweep::bouncing_map::BouncingMap;
use crate::sweep::{SweepEvent, SweepImpact, sweep_with};

/// The growth of a small perturbation along an orbit of the impact map, derivative by derivative.
///
/// ```
/// use bouncing_disk_core::chaos::TangentGrowth;
/// use bouncing_disk_core::{ImpactMap, Vibration};
///
/// // Along a periodic orbit the exponent is the logarithm of the larger Floquet multiplier, here 1/2 in modulus.
/// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
/// let mut state = map.period_one(1).expect("it exists");
/// let mut growth = TangentGrowth::default();
/// for _ in 0..1_000 {
///     let (impact, derivative) = map.step_with_derivative(state)?;
///     growth.grow(derivative);
///     state = impact.into();
/// }
/// assert!((growth.exponent().expect("no graze") - 0.5_f64.ln()).abs() < 1e-2);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct TangentGrowth {
    impacts: usize,
    tangent: (f64, f64),
    sum: f64,
    bounded: bool,
}

impl Default for TangentGrowth {
    fn default() -> Self {
        Self { impacts: 0, tangent: (1.0, 0.0), sum: 0.0, bounded: true }
    }
}

impl TangentGrowth {
    /// Follows the perturbation through one impact with this derivative of the map
    /// ([`BouncingMap::step_with_derivative`]); returns the logarithm of this growth.
    pub fn grow(&mut self, derivative: DMat2) -> f64 {
        let (by_phase, by_velocity) = (derivative.x_axis, derivative.y_axis);
        let x = by_phase.x * self.tangent.0 + by_velocity.x * self.tangent.1;
        let y = by_phase.y * self.tangent.0 + by_velocity.y * self.tangent.1;
        let square = x * x + y * y;
        // Near a graze the derivative is large but bounded; its squares may overflow or vanish.
        let length = if (1.0e-280..1.0e280).contains(&square) { square.sqrt() } else { hypot(x, y) };
        self.bounded &= length > 0.0 && length.is_finite();
        let growth = ln(length);
        self.sum += growth;
        self.tangent = (x / length, y / length);
        self.impacts += 1;
        growth
    }

    /// The direction of the perturbation, of length one.
    pub(crate) const fn tangent(&self) -> DVec2 {
        DVec2::new(self.tangent.0, self.tangent.1)
    }

    /// The number of impacts followed.
    #[must_use]
    pub const fn impacts(&self) -> usize {
        self.impacts
    }

    /// Whether no derivative so far was unbounded (a graze) or zero.
    #[must_use]
    pub const fn is_bounded(&self) -> bool {
        self.bounded
    }

    /// The mean logarithmic growth per impact; `None` before the first impact and after a graze.
    #[must_use]
    pub fn exponent(&self) -> Option<f64> {
        (self.bounded && self.impacts > 0).then(|| self.sum / self.impacts as f64)
    }
}

/// Bound on the change of the logarithm of one growth due to rounding, always to the same side: the rounding
/// of the two phases and the speeds that form its derivative (docs/numerics-dynamics.md, "The standard
/// error").
const GROWTH_RESOLUTION: f64 = 16.0 * f64::EPSILON;

/// The number of standard errors that counts as decisive.
const DECISIVE_ERRORS: f64 = 3.0;

/// The highest power of the number of impacts with which a perturbation may grow without a positive exponent:
/// 2 in the passage by a fold, 1 in a shear.
const NEUTRAL_POWER: f64 = 2.0;

/// -ln(2^-52): the growth along an escape from a periodic orbit that contains the start to the last bit.
const ESCAPE: f64 = 52.0 * core::f64::consts::LN_2;

/// The measured largest Lyapunov exponent of one orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedEstimate"))]
pub struct LyapunovEstimate {
    /// The mean logarithmic growth of a small perturbation per impact.
    pub exponent: f64,
    /// Its standard error, which covers scatter, drift and rounding ([`BatchMeans`]).
    pub standard_error: f64,
    /// Impacts over which it was measured.
    pub impacts: u64,
}

read_checked!(LyapunovEstimate as UncheckedEstimate { exponent: f64, standard_error: f64, impacts: u64 });

impl LyapunovEstimate {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        finite("exponent", self.exponent)?;
        not_negative("standard error of an exponent", self.standard_error)?;
        within("impacts of an exponent", self.impacts as f64, 1.0, f64::MAX, "at least 1").map(|_| ())
    }

    /// A mean, still empty, of the logarithms of growth factors.
    #[must_use]
    pub fn growths() -> BatchMeans {
        BatchMeans::with_resolution(GROWTH_RESOLUTION)
    }

    /// The estimate from a mean begun by [`Self::growths`]; `None` for fewer than 16 growths or if one was
    /// unbounded.
    #[must_use]
    pub fn of(growths: &BatchMeans) -> Option<Self> {
        let (exponent, standard_error) = (growths.mean()?, growths.standard_error()?);
        let known = exponent.is_finite() && standard_error.is_finite();
        known.then_some(Self { exponent, standard_error, impacts: growths.count() })
    }

    /// The exponent above which neutral motion, the escape from a periodic orbit and three standard errors
    /// cannot explain the growth: (-ln(2^-52) + 2 ln n)/n + 3 errors over n impacts.
    #[must_use]
    pub fn threshold(&self) -> f64 {
        let impacts = self.impacts as f64;
        (ESCAPE + NEUTRAL_POWER * ln(impacts)) / impacts + DECISIVE_ERRORS * self.standard_error
    }

    /// Whether small perturbations certainly grow: the exponent is above the [threshold](Self::threshold).
    #[must_use]
    pub fn grows(&self) -> bool {
        self.exponent > self.threshold()
    }

    /// Whether small perturbations certainly shrink: the exponent is below minus the
    /// [threshold](Self::threshold).
    #[must_use]
    pub fn shrinks(&self) -> bool {
        self.exponent < -self.threshold()
    }
}

/// The state of the computation of an orbit's exponent.
#[derive(Debug, Clone, Copy)]
struct Followed {
    state: ImpactState,
    skipped: usize,
    growth: TangentGrowth,
    rested: bool,
}

/// The largest Lyapunov exponent per impact of each orbit of `starts`: the mean logarithmic growth of a small
/// perturbation over `impacts` impacts after a transient of `transient` impacts. `None` if the disk comes to
/// rest (the motion after a rest does not depend on the motion before) or grazes the platform (the derivative
/// is unbounded).
///
/// The items of `observer` are the orbits.
///
/// # Errors
/// Errors of [`sweep`](crate::sweep::sweep()).
pub fn lyapunov_exponents<M: BouncingMap>(
    starts: &[(M, ImpactState)],
    transient: usize,
    impacts: usize,
    observer: &dyn Observer,
) -> Result<Vec<Option<f64>>, Error> {
    if impacts == 0 {
        return Ok(vec![None; starts.len()]);
    }
    let orbits: Vec<M::Orbit> =
        starts.iter().map(|(map, state)| map.orbit(*state, ChatterPolicy::Complete)).collect();
    sweep_with(
        &orbits,
        |index| {
            let (map, state) = &starts[index];
            (map, Followed { state: *state, skipped: 0, growth: TangentGrowth::default(), rested: false })
        },
        |(map, followed), event| {
            let SweepEvent::Impact(SweepImpact { state, duration, .. }) = *event else {
                followed.rested = true;
                return ControlFlow::Break(());
            };
            if followed.skipped < transient {
                followed.skipped += 1;
            } else {
                followed.growth.grow(map.derivative(followed.state, state, duration).0);
            }
            followed.state = state;
            if followed.growth.is_bounded() && followed.growth.impacts() < impacts {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        },
        |(_, followed)| Ok(if followed.rested { None } else { followed.growth.exponent() }),
        observer,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The passage by a fold multiplies a perturbation by n^2, a shear by n, an escape from a periodic orbit
    /// by at most 2^52.
    #[test]
    fn neutral_growth_is_no_chaos() {
        for impacts in [100, 10_000, 1_000_000_u64] {
            let n = impacts as f64;
            let grown = |growth: f64| LyapunovEstimate { exponent: growth / n, standard_error: 0.0, impacts };
            for growth in [ln(n), 2.0 * ln(n), 52.0 * ln(2.0)] {
                assert!(!grown(growth).grows() && !grown(-growth).shrinks(), "{growth} over {impacts}");
            }
            let chaos = 52.0 * ln(2.0) + 2.0 * ln(n) + 1.0;
            assert!(grown(chaos).grows() && grown(-chaos).shrinks(), "{impacts}");
        }
    }

    /// The logarithm of a growth of 1e200 or 1e-200 is finite; there is none for an infinite growth, or for
    /// zero.
    #[test]
    fn growth_of_any_size_has_an_exponent() {
        for size in [5.0e-324, 1.0e-310, 1.0e-200, 1.0e-140, 1.0, 1.0e139, 1.0e150, 1.0e200, 1.0e300] {
            let mut growth = TangentGrowth::default();
            growth.grow(DMat2::from_cols_array(&[0.0, size, size, 0.0]));
            growth.grow(DMat2::from_cols_array(&[0.0, 1.0, 1.0, 0.0]));
            let exponent = growth.exponent().expect("bounded");
            assert!((exponent - 0.5 * ln(size)).abs() <= 1e-13 * ln(size).abs(), "{size:e}: {exponent}");
        }
        for size in [0.0, f64::INFINITY, f64::NAN] {
            let mut growth = TangentGrowth::default();
            growth.grow(DMat2::from_cols_array(&[size; 4]));
            growth.grow(DMat2::IDENTITY);
            assert_eq!((growth.exponent(), growth.is_bounded(), growth.impacts()), (None, false, 2));
        }
    }
}
