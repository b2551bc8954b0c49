//! The crisis in which an attractor is lost to rest: where the unstable manifold of a saddle inside of it
//! first touches the stable manifold of another one (docs/numerics/dynamics.md, "Crises").

use crate::analysis::manifold::Side;
use crate::analysis::periodic::{Multipliers, PeriodicOrbit};
use crate::error::{Error, finite, not_negative, within};
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::ln;
use crate::numerics::roots::bracket_of_width;
use crate::observer::{Observer, Unobserved, Watch, WorkCount};
use crate::platform::vibration::Vibration;
use crate::read_checked;

mod escape;
pub(crate) mod lifetimes;
mod tangency;

use tangency::{Failure, Tangency};

/// Where a crisis is sought, and how closely.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSearch"))]
pub struct CrisisSearch {
    restitution: f64,
    low: f64,
    high: f64,
    side: Side,
    samples: u32,
    impacts: u32,
}

read_checked!(CrisisSearch as UncheckedSearch {
    restitution: f64,
    low: f64,
    high: f64,
    side: Side,
    samples: u32,
    impacts: u32,
});

impl CrisisSearch {
    /// A search at this restitution in (0, 1) between two values of Gamma, `low` < `high`: below the crisis
    /// and beyond it. The unstable manifold is that on the later side of the saddle's first impact (a
    /// negative multiplier makes both sides one), sampled at 2,048 points that are followed for 200 impacts.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for any of them.
    pub fn new(restitution: f64, (low, high): (f64, f64)) -> Result<Self, Error> {
        let search = Self { restitution, low, high, side: Side::Later, samples: 2_048, impacts: 200 };
        search.check().map(|()| search)
    }

    /// The same on this side of the saddle, with so many samples in [64, 1e6] that are followed for so many
    /// impacts in [10, 1e5].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for either number.
    pub fn with_samples(self, side: Side, samples: u32, impacts: u32) -> Result<Self, Error> {
        let search = Self { side, samples, impacts, ..self };
        search.check().map(|()| search)
    }

    fn check(&self) -> Result<(), Error> {
        let most = Vibration::MAX_PEAK_ACCELERATION / core::f64::consts::PI;
        within(
            "restitution of a crisis",
            self.restitution,
            f64::MIN_POSITIVE,
            1.0 - f64::EPSILON / 2.0,
            "(0, 1)",
        )?;
        within("forcing below a crisis", self.low, 0.0, most, "[0, 3.18e7]")?;
        within("forcing beyond a crisis", self.high, self.low.next_up(), most, "(low end, 3.18e7]")?;
        within("samples of a crisis", f64::from(self.samples), 64.0, 1.0e6, "[64, 1000000]")?;
        within("impacts of a crisis", f64::from(self.impacts), 10.0, 1.0e5, "[10, 100000]")?;
        Ok(())
    }

    /// The map at a forcing.
    fn map(&self, forcing: f64) -> Result<ImpactMap, Error> {
        ImpactMap::new(Vibration::from_axial_forcing(forcing)?, self.restitution)
    }

    /// Coefficient of restitution.
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.restitution
    }

    /// The values of Gamma between which a crisis is sought.
    #[must_use]
    pub const fn range(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}

/// A crisis: the unstable manifold of a saddle on an attractor touches the stable manifold of a saddle beside
/// it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedCrisis"))]
pub struct Crisis {
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Gamma of the tangency.
    pub forcing: f64,
    /// An estimate of its error: what the last flights along the saddle changed, and the rounding.
    pub forcing_error: f64,
    /// The last two values of Gamma of the search by rest: at the first no sample came to rest, at the second
    /// some did, so that the crisis lies below the second.
    pub bracket: (f64, f64),
    /// The saddle on the attractor, at the crisis.
    pub inside: PeriodicOrbit,
    /// The saddle whose stable manifold is touched, at the crisis.
    pub touched: PeriodicOrbit,
    /// The orbit of tangency: from next to the first saddle to next to the second.
    pub orbit: Vec<ImpactState>,
    /// Share of the first piece of the unstable manifold at which the orbit begins, in [0, 1].
    pub share: f64,
    /// The side of the first impact of the saddle on which this piece begins.
    pub side: Side,
    /// Second derivative by the share of the distance from the stable manifold, in the units of manifolds
    /// next to the second saddle, over its rate of change with Gamma: how the escaping share of the first
    /// piece opens, which is sqrt(8 (Gamma - Gamma_c) / |this|). It is not 0 at a quadratic tangency.
    pub curvature: f64,
}

read_checked!(Crisis as UncheckedCrisis {
    restitution: f64,
    forcing: f64,
    forcing_error: f64,
    bracket: (f64, f64),
    inside: PeriodicOrbit,
    touched: PeriodicOrbit,
    orbit: Vec<ImpactState>,
    share: f64,
    side: Side,
    curvature: f64,
});

impl Crisis {
    fn check(&self) -> Result<(), Error> {
        within("restitution of a crisis", self.restitution, 0.0, 1.0, "(0, 1)")?;
        within("forcing of a crisis", self.forcing, 0.0, f64::MAX, "[0, inf)")?;
        not_negative("error of a forcing", self.forcing_error)?;
        finite("end of a bracket", self.bracket.1)?;
        within("low end of a bracket", self.bracket.0, f64::MIN, self.bracket.1, "at most the high end")?;
        within("share of a first piece", self.share, 0.0, 1.0, "[0, 1]")?;
        finite("curvature of a tangency", self.curvature)?;
        within("impacts of a tangency", self.orbit.len() as f64, 1.0, f64::MAX, "one at least")?;
        Ok(())
    }

    /// The exponent of the mean life beyond the crisis, (Gamma - Gamma_c)^-exponent, after Grebogi, Ott and
    /// Yorke: 1/2 + ln|a|/|ln|b|| with the multipliers a and b (|a| > 1 > |b|) per impact of the saddle on
    /// the attractor where the saddles are two, ln|b|/ln (a b)^2 with those of the saddle where it is one.
    /// `None` where a multiplier does not tell.
    #[must_use]
    pub fn life_exponent(&self) -> Option<f64> {
        let one = self.inside.states == self.touched.states;
        let Multipliers::Real(large, small) = self.inside.multipliers() else { return None };
        let (large, small) = (ln(large.abs()), ln(small.abs()));
        let exponent = if one { small / (2.0 * (large + small)) } else { 0.5 - large / small };
        (exponent.is_finite() && exponent > 0.0).then_some(exponent)
    }
}

/// Why no crisis was found, with what there was instead.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum NoCrisis {
    /// No sample comes to rest at the upper end of the range.
    #[error("none of {samples} samples comes to rest at Gamma = {forcing}")]
    NoneRests {
        /// The upper end.
        forcing: f64,
        /// How many samples there are.
        samples: u32,
    },
    /// Some come to rest at the lower end of the range.
    #[error("a sample comes to rest at Gamma = {forcing} already, after {life} impacts")]
    RestsBefore {
        /// The lower end.
        forcing: f64,
        /// The impacts of the first sample that comes to rest.
        life: u32,
    },
    /// The unstable manifold has no fold next to the stable one: the attractor touches another saddle, or its
    /// edge is no fold.
    #[error(
        "where samples come to rest, Gamma = {forcing}, no fold is next to the saddle: the nearest is {nearest:e} off"
    )]
    NoFold {
        /// Gamma at which samples come to rest.
        forcing: f64,
        /// The smallest distance of a fold from the stable direction of the saddle, in the units of
        /// manifolds; the largest double if there is none.
        nearest: f64,
    },
    /// The tangency was not found to the rounding.
    #[error("the tangency did not settle: Gamma = {forcing} changed by {change:e} last")]
    NotSettled {
        /// The last Gamma.
        forcing: f64,
        /// Its last change.
        change: f64,
    },
}

/// Width of the last bracket of the search by rest, relative to Gamma.
const BRACKET: f64 = 1.0e-7;

impl CrisisSearch {
    /// The crisis in which the unstable manifold of `inside`, a saddle on the attractor or at its edge,
    /// touches the stable manifold of `touched`, which may be the same saddle. Both are orbits of maps within
    /// the range; at other values of Gamma they are sought next to these.
    ///
    /// First Gamma is halved on whether any sample of the unstable manifold comes to rest: what does bounds
    /// the crisis from above. There the folds of the unstable manifold next to the second saddle are looked
    /// for, and of those that come first the Gamma at which they lie on the stable manifold, by the secant
    /// method. The smallest of these is the crisis.
    ///
    /// ```
    /// # use bouncing_disk_core::{CrisisSearch, ImpactMap, ImpactState, Vibration};
    /// // The attractor of Fig. 6 is lost where it touches a saddle of three impacts in three periods.
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.56)?, 0.5)?;
    /// let guess = [(0.1207, 1.4986), (0.2527, 1.0979), (0.9548, 1.4032)];
    /// let guess = guess.map(|(cycles, speed)| ImpactState::from_normalised(cycles * 6.2832, speed));
    /// let saddle = map.refine(&guess.into_iter().collect::<Result<Vec<_>, _>>()?)?;
    /// let crisis = CrisisSearch::new(0.5, (0.559, 0.562))?.crisis(&saddle, &saddle)?.expect("a tangency");
    /// assert!((crisis.forcing - 0.56075).abs() < 1e-5 && crisis.forcing_error < 1e-10);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `inside` is no saddle; [`Error::NotSettled`] where one of the orbits is not
    /// found again; those of [`Vibration::first_impact`].
    pub fn crisis(
        &self,
        inside: &PeriodicOrbit,
        touched: &PeriodicOrbit,
    ) -> Result<Result<Crisis, NoCrisis>, Error> {
        self.crisis_observed(inside, touched, &Unobserved)
    }

    /// [`Self::crisis`] with an observer; the items are the samples that are followed, at most.
    ///
    /// # Errors
    /// Those of [`Self::crisis`]; [`Error::Stopped`] if the observer breaks.
    pub fn crisis_observed(
        &self,
        inside: &PeriodicOrbit,
        touched: &PeriodicOrbit,
        observer: &dyn Observer,
    ) -> Result<Result<Crisis, NoCrisis>, Error> {
        self.check()?;
        let watch = Watch::begin(observer, 0, 60 * u64::from(self.samples))?;
        let mut work = watch.work();
        let found = self.sought(inside, touched, &mut work)?;
        watch.end();
        Ok(found)
    }

    fn sought(
        &self,
        inside: &PeriodicOrbit,
        touched: &PeriodicOrbit,
        work: &mut WorkCount<'_>,
    ) -> Result<Result<Crisis, NoCrisis>, Error> {
        let samples = self.samples;
        if let Some(life) = self.first_rest(inside, self.low, work)? {
            return Ok(Err(NoCrisis::RestsBefore { forcing: self.low, life }));
        }
        if self.first_rest(inside, self.high, work)?.is_none() {
            return Ok(Err(NoCrisis::NoneRests { forcing: self.high, samples }));
        }
        let bracket = bracket_of_width(self.low, self.high, BRACKET * self.high, |forcing| {
            Ok::<_, Error>(self.first_rest(inside, forcing, work)?.is_none())
        })?;
        let tangency = Tangency { search: self, inside: &inside.states, touched: &touched.states };
        let solved = tangency.first(bracket.1, work)?;
        Ok(solved
            .map(|solution| Crisis {
                restitution: self.restitution,
                forcing: solution.forcing,
                forcing_error: solution.error,
                bracket,
                inside: solution.inside,
                touched: solution.touched,
                orbit: solution.orbit,
                share: solution.share,
                side: self.side,
                curvature: solution.curvature,
            })
            .map_err(|failure| match failure {
                Failure::NoFold { nearest } => NoCrisis::NoFold { forcing: bracket.1, nearest },
                Failure::NotSettled { forcing, change } => NoCrisis::NotSettled { forcing, change },
            }))
    }
}

#[cfg(test)]
mod tests;
