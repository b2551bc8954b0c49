//! Periodic orbits of the impact map: the closed form of period 1, stability (Floquet multipliers), and the
//! orbit on which a start settles.

use core::f64::consts::{PI, TAU};

use glam::DMat2;

use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState, OrbitEvent};
use crate::numerics::elementary::{acos, ln};
use crate::numerics::error::{Error, finite, not_negative, within};
use crate::numerics::stored::read_checked;
use crate::run::{Observer, Tick, Watch};

pub(crate) mod belonging;
pub(crate) mod catalogue;
pub(crate) mod margin;
pub(crate) mod newton;
pub(crate) mod pair;

/// Largest number of Newton steps of [`ImpactMap::refine`].
pub const MAX_NEWTON_STEPS: u32 = 50;

/// The longest period searched for and refined.
pub const MAX_PERIOD: usize = 4_096;

/// The two Floquet multipliers of an orbit of the 2-D impact map: both real, or a conjugate pair.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedMultipliers"))]
pub enum Multipliers {
    /// Two real multipliers, the one of larger modulus first.
    Real(f64, f64),
    /// A conjugate pair with this real part and this positive imaginary part.
    Complex {
        /// Real part.
        real: f64,
        /// Imaginary part, > 0.
        imaginary: f64,
    },
}

/// The largest excess of the second of two equal multipliers over the first due to rounding.
const MULTIPLIER_ROUNDING: f64 = 1.0e-12;

read_checked!(enum Multipliers as UncheckedMultipliers {
    Real(large: f64, small: f64),
    Complex { real: f64, imaginary: f64 },
});

impl Multipliers {
    /// Real and imaginary part of each multiplier.
    #[must_use]
    pub const fn pairs(&self) -> [[f64; 2]; 2] {
        match *self {
            Self::Real(first, second) => [[first, 0.0], [second, 0.0]],
            Self::Complex { real, imaginary } => [[real, imaginary], [real, -imaginary]],
        }
    }

    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        match *self {
            Self::Real(large, small) => {
                finite("multiplier", large)?;
                let most = large.abs() * (1.0 + MULTIPLIER_ROUNDING);
                within("second multiplier", small, -most, most, "not larger in modulus than the first")?;
            }
            Self::Complex { real, imaginary } => {
                finite("real part of a multiplier", real)?;
                let least = f64::from_bits(1);
                within("imaginary part of a multiplier", imaginary, least, f64::MAX, "(0, inf)")?;
            }
        }
        Ok(())
    }

    /// The eigenvalues of a real 2x2 matrix, in closed form without cancellation.
    #[must_use]
    pub fn of(matrix: DMat2) -> Self {
        Self::of_invariants(matrix.x_axis.x + matrix.y_axis.y, matrix.determinant())
    }

    /// The eigenvalues of a real 2x2 matrix with this trace and determinant: [`Self::of`] for a determinant
    /// known better than the entries (for an orbit of n impacts it is r^(2n)).
    #[must_use]
    pub fn of_invariants(trace: f64, determinant: f64) -> Self {
        let half_trace = 0.5 * trace;
        let radicand = half_trace * half_trace - determinant;
        if radicand < 0.0 {
            return Self::Complex { real: half_trace, imaginary: (-radicand).sqrt() };
        }
        let large =
            if half_trace >= 0.0 { half_trace + radicand.sqrt() } else { half_trace - radicand.sqrt() };
        Self::Real(large, if large == 0.0 { 0.0 } else { determinant / large })
    }

    /// The larger modulus: the orbit attracts if it is below one.
    #[must_use]
    pub fn spectral_radius(&self) -> f64 {
        match *self {
            Self::Real(large, _) => large.abs(),
            Self::Complex { real, imaginary } => (real * real + imaginary * imaginary).sqrt(),
        }
    }

    /// The largest Lyapunov exponent per impact of an orbit of `impacts` with these multipliers: the
    /// logarithm of [`Self::spectral_radius`] over the number of impacts; minus infinity if both multipliers
    /// are zero.
    ///
    /// ```
    /// use bouncing_disk_core::orbits::Multipliers;
    ///
    /// // Two impacts that together keep a quarter of a perturbation: each keeps a half.
    /// let multipliers = Multipliers::Real(-0.25, 0.25);
    /// assert_eq!(multipliers.lyapunov_exponent(2), bouncing_disk_core::numerics::elementary::ln(0.5));
    /// ```
    #[must_use]
    pub fn lyapunov_exponent(&self, impacts: u64) -> f64 {
        ln(self.spectral_radius()) / impacts as f64
    }
}

/// `m1, m2`, or `re +- im i`.
impl core::fmt::Display for Multipliers {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let (first, between, second, last) = match self {
            Self::Real(large, small) => (large, ", ", small, ""),
            Self::Complex { real, imaginary } => (real, " +- ", imaginary, " i"),
        };
        core::fmt::Display::fmt(first, formatter)?;
        formatter.write_str(between)?;
        core::fmt::Display::fmt(second, formatter)?;
        formatter.write_str(last)
    }
}

/// A periodic orbit of the impact map.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedOrbit"))]
pub struct PeriodicOrbit {
    /// The impacts of one period of the orbit, in order.
    pub states: Vec<ImpactState>,
    /// Periods of the platform in one period of the orbit.
    pub platform_periods: u64,
    /// The derivative of the map around the orbit, from its first impact.
    pub monodromy: DMat2,
    /// The largest change of the impacts (rad, and relative speed) due to rounding of the solution, and of
    /// the map's parameters by one unit in the last place. Near a fold two orbits within this distance count
    /// as one.
    pub position_error: f64,
    /// The largest change of the derivative's trace due to this rounding.
    pub trace_error: f64,
}

read_checked!(PeriodicOrbit as UncheckedOrbit {
    states: Vec<ImpactState>,
    platform_periods: u64,
    monodromy: DMat2,
    position_error: f64,
    trace_error: f64,
});

/// The stability of a periodic orbit, most stable first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stability {
    /// Both multipliers lie inside the unit circle by more than their uncertainty: the orbit attracts.
    Stable,
    /// A multiplier is 1 or -1 within its uncertainty, as at a fold or a doubling: the orbit is semi-stable,
    /// or rounding decides whether it attracts or even exists.
    Marginal,
    /// A multiplier lies outside the unit circle by more than its uncertainty.
    Unstable,
}

/// `attracts`, `marginal` or `unstable`.
impl core::fmt::Display for Stability {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        formatter.pad(match self {
            Self::Stable => "attracts",
            Self::Marginal => "marginal",
            Self::Unstable => "unstable",
        })
    }
}

impl PeriodicOrbit {
    /// Checks that a deserialised orbit could come from [`ImpactMap::refine`].
    pub(crate) fn check(&self) -> Result<(), Error> {
        let most = MAX_PERIOD as f64;
        within("impacts of a periodic orbit", self.states.len() as f64, 1.0, most, "[1, 4096]")?;
        for entry in self.monodromy.to_cols_array() {
            finite("derivative around a periodic orbit", entry)?;
        }
        not_negative("error of a periodic orbit", self.position_error)?;
        not_negative("error of a trace", self.trace_error)?;
        self.check_motion()
    }

    /// Checks that the disk is not at rest.
    ///
    /// # Errors
    /// [`Error::ImpactWithoutSpeed`] and [`Error::NoPlatformPeriods`].
    #[doc(hidden)]
    pub fn check_motion(&self) -> Result<(), Error> {
        if let Some(index) = self.states.iter().position(|state| state.velocity() >= 0.0) {
            return Err(Error::ImpactWithoutSpeed { index, phase: self.states[index].phase().angle() });
        }
        if self.platform_periods == 0 {
            let speed = self.states.iter().fold(0.0_f64, |most, state| most.max(-state.velocity()));
            return Err(Error::NoPlatformPeriods { impacts: self.states.len(), speed });
        }
        Ok(())
    }

    /// An orbit of `map`, with its errors.
    pub(crate) fn of(
        map: &ImpactMap,
        states: Vec<ImpactState>,
        platform_periods: u64,
        monodromy: DMat2,
    ) -> Self {
        let (position_error, trace_error) = margin::errors(map, &states, monodromy);
        Self { states, platform_periods, monodromy, position_error, trace_error }
    }

    /// The stability of the orbit, to within rounding. With the trace T and the determinant D < 1 both
    /// multipliers lie inside the unit circle if |T| < 1 + D.
    ///
    /// ```
    /// # use bouncing_disk_core::orbits::Stability;
    /// # use bouncing_disk_core::{ImpactMap, Vibration};
    /// // The fold in which the orbits of one impact are born.
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(1.0 / 3.0)?, 0.5)?;
    /// let orbit = map.refine(&[map.period_one(1).expect("exists")])?;
    /// assert_eq!(orbit.stability(), Stability::Marginal);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub fn stability(&self) -> Stability {
        let inside = 1.0 + self.determinant() - self.trace().abs();
        if inside > self.trace_error {
            Stability::Stable
        } else if inside < -self.trace_error {
            Stability::Unstable
        } else {
            Stability::Marginal
        }
    }

    /// Number of impacts in one period of the orbit.
    #[must_use]
    pub fn period(&self) -> usize {
        self.states.len()
    }

    /// The Floquet multipliers.
    #[must_use]
    pub fn multipliers(&self) -> Multipliers {
        Multipliers::of_invariants(self.trace(), self.determinant())
    }

    /// The error of the multipliers: the change of the roots of m^2 - T m + D due to [`Self::trace_error`],
    /// which near a double root grows as its square root.
    #[must_use]
    pub fn multiplier_error(&self) -> f64 {
        let (trace, determinant) = (self.trace(), self.determinant());
        let radicand = (0.25 * trace * trace - determinant).abs();
        let change = 0.5 * self.trace_error * (trace.abs() + 0.5 * self.trace_error);
        0.5 * self.trace_error + (change / radicand.sqrt()).min(change.sqrt())
    }

    /// The determinant of the derivative, limited to magnitude 1, since phase space contracts. If
    /// perturbations grow strongly, the determinant of a product of many matrices is pure rounding error of
    /// any size: 1e19 instead of 1e-140 over hundreds of impacts with multipliers up to 1e18. Without the
    /// limit five chaotic orbits among 6,000 forcings near Gamma = 0.54509 (r = 0.5) would count as periodic.
    #[doc(hidden)]
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.monodromy.determinant().clamp(-1.0, 1.0)
    }

    /// The trace of the derivative around the orbit.
    #[doc(hidden)]
    #[must_use]
    pub fn trace(&self) -> f64 {
        self.monodromy.x_axis.x + self.monodromy.y_axis.y
    }

    /// det(1 + monodromy) = (1 + m1)(1 + m2): it falls through zero when the orbit doubles its period.
    #[must_use]
    pub fn flip_function(&self) -> f64 {
        1.0 + self.trace() + self.determinant()
    }
}

/// The shorter way around the circle from `from` to `to`, in (-pi, pi].
pub fn phase_difference(to: f64, from: f64) -> f64 {
    let difference = to - from;
    if difference > PI {
        difference - TAU
    } else if difference <= -PI {
        difference + TAU
    } else {
        difference
    }
}

/// Checks period and tolerance for [`repeats`].
pub(crate) fn check_repeats(longest: usize, tolerance: f64) -> Result<(), Error> {
    within("longest period", longest as f64, 1.0, MAX_PERIOD as f64, "[1, 4096] impacts")?;
    within("tolerance", tolerance, 0.0, f64::MAX, "[0, inf)").map(|_| ())
}

/// The smallest period up to `longest` with which the first of 2 `longest` + 1 impacts repeat, twice in a
/// row.
pub(crate) fn repeats(states: &[ImpactState], longest: usize, tolerance: f64) -> Option<usize> {
    let near = |a: &ImpactState, b: &ImpactState| {
        phase_difference(a.phase().angle(), b.phase().angle()).abs() <= tolerance
            && (a.velocity() - b.velocity()).abs() <= tolerance * (1.0 + a.velocity().abs())
    };
    (1..=longest).find(|&n| {
        states[..n].iter().zip(&states[n..]).all(|(a, b)| near(a, b)) && near(&states[0], &states[n])
    })
}

impl ImpactMap {
    /// The period-1 orbit with one impact every `platform_periods` >= 1 periods, in closed form:
    /// cos tau = k (1 - r)/((1 + r) Gamma), impact speed 2 pi k/(1 + r); `None` below its threshold.
    ///
    /// The result is the solution in [0, pi/2]; the other phase always belongs to a saddle. This function
    /// does not check whether an earlier impact prevents the orbit; [`Self::refine`] does.
    #[must_use]
    pub fn period_one(&self, platform_periods: u64) -> Option<ImpactState> {
        let k = platform_periods as f64;
        let r = self.restitution();
        let cosine = k * (1.0 - r) / ((1.0 + r) * self.vibration().axial_forcing());
        if !(0.0..=1.0).contains(&cosine) {
            return None;
        }
        let phase = Phase::of_angle(acos(cosine));
        ImpactState::new(phase, -self.period_one_impact_speed(platform_periods)).ok()
    }

    /// The impact speed of the orbits with one impact every `platform_periods` periods, 2 pi k/(1 + r) (units
    /// of g/omega), at every forcing at which they exist.
    ///
    /// A flight of k periods ends at its initial phase, and so at the initial height and speed of the
    /// platform. During the flight gravity changes the velocity by 2 pi k: the launch speed u and the impact
    /// speed w, both relative to the platform, satisfy u + w = 2 pi k and, by the impact, u = r w.
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let orbit = map.period_one(1).expect("born at Gamma = 1/3");
    /// assert_eq!(map.period_one_impact_speed(1).to_bits(), (-orbit.velocity()).to_bits());
    /// // The next impact has the same speed.
    /// assert!((map.step(orbit)?.velocity + map.period_one_impact_speed(1)).abs() < 1e-14);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub fn period_one_impact_speed(&self, platform_periods: u64) -> f64 {
        TAU * platform_periods as f64 / (1.0 + self.restitution())
    }

    /// The forcing Gamma_1 at which the period-1 orbit with one impact per period of the platform doubles its
    /// period: sqrt(((1-r)/(1+r))^2 + (2 (1+r^2)/(pi (1+r)^2))^2).
    #[must_use]
    pub fn first_doubling_forcing(restitution: f64) -> f64 {
        let r = restitution;
        let sum = 1.0 + r;
        let threshold = (1.0 - r) / sum;
        let height = 2.0 * (1.0 + r * r) / (PI * sum * sum);
        (threshold * threshold + height * height).sqrt()
    }

    /// The smallest period (in impacts, up to `longest` in [1, [`MAX_PERIOD`]]) with which an orbit from
    /// `state` repeats itself within `tolerance` >= 0 (rad, and relative speed), twice in a row. `None` if no
    /// such period exists or the disk comes to rest (judged by [`ChatterPolicy::Complete`]).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for `longest` or `tolerance`; errors of
    /// [`Vibration::first_impact`](crate::Vibration::first_impact).
    pub fn period_of(
        &self,
        state: ImpactState,
        longest: usize,
        tolerance: f64,
    ) -> Result<Option<usize>, Error> {
        self.period_of_ticked(state, longest, tolerance, &mut |_| Ok(()))
    }

    /// [`Self::period_of`] as a part of a longer call; the tick counts impacts.
    fn period_of_ticked(
        &self,
        state: ImpactState,
        longest: usize,
        tolerance: f64,
        tick: Tick<'_>,
    ) -> Result<Option<usize>, Error> {
        check_repeats(longest, tolerance)?;
        let mut states = vec![state];
        let mut orbit = self.orbit(state, ChatterPolicy::Complete);
        for _ in 0..2 * longest {
            tick(1)?;
            match orbit.advance()? {
                Some(OrbitEvent::Impact(impact)) => states.push(impact.into()),
                Some(_) | None => return Ok(None),
            }
        }
        Ok(repeats(&states, longest, tolerance))
    }

    /// The attracting periodic orbit that the orbit from `state` settles on: `transient` impacts, then the
    /// period (at most `longest`), then [`Self::refine`]. `None` if this orbit comes to rest (judged by
    /// [`ChatterPolicy::Complete`]) or shows no period.
    ///
    /// The items of `observer` are the impacts of the transient, of the search for the period and of the
    /// refinement, each at its maximum.
    ///
    /// # Errors
    /// Errors of [`Self::refine`] and [`Self::period_of`].
    pub fn settled_orbit(
        &self,
        state: ImpactState,
        transient: usize,
        longest: usize,
        tolerance: f64,
        observer: &dyn Observer,
    ) -> Result<Option<PeriodicOrbit>, Error> {
        // Two periods are compared, and a third is the guess.
        let searched = (3 + u64::from(MAX_NEWTON_STEPS)).saturating_mul(longest as u64);
        let watch = Watch::begin(observer, 0, searched.saturating_add(transient as u64))?;
        let mut work = watch.work();
        let orbit = self.settled_orbit_ticked(state, (transient, longest), tolerance, &mut |impacts| {
            work.finish(impacts)
        })?;
        watch.end();
        Ok(orbit)
    }

    /// [`Self::settled_orbit`] as a part of a longer call; the tick counts impacts.
    pub(crate) fn settled_orbit_ticked(
        &self,
        state: ImpactState,
        (transient, longest): (usize, usize),
        tolerance: f64,
        tick: Tick<'_>,
    ) -> Result<Option<PeriodicOrbit>, Error> {
        let Some(state) = self.state_after_ticked(state, transient, ChatterPolicy::Complete, tick)? else {
            return Ok(None);
        };
        let Some(period) = self.period_of_ticked(state, longest, tolerance, tick)? else { return Ok(None) };
        let mut guess = vec![state];
        while guess.len() < period {
            tick(1)?;
            guess.push(self.step(guess[guess.len() - 1])?.into());
        }
        self.refine_ticked(&guess, tick).map(Some)
    }
}

/// The distance between two impacts, in units in which a radian and the speed `speed_scale` count alike.
pub(crate) fn distance(a: ImpactState, b: ImpactState, speed_scale: f64) -> f64 {
    let phase = phase_difference(a.phase().angle(), b.phase().angle());
    let velocity = (a.velocity() - b.velocity()) / speed_scale;
    (phase * phase + velocity * velocity).sqrt()
}

impl PeriodicOrbit {
    /// The distance from `state` to the nearest impact of the orbit (a radian counts as much as the speed P).
    #[must_use]
    pub fn distance(&self, state: ImpactState, peak_acceleration: f64) -> f64 {
        self.states
            .iter()
            .fold(f64::INFINITY, |least, &own| least.min(distance(state, own, peak_acceleration)))
    }
}
