//! Both Lyapunov exponents of an orbit, by QR, with the standard error of the largest, or the reason why
//! there are none.
//!
//! If the image of the first direction has the length l, the image of the second may be as long, with an
//! orthogonal part det/l. Near a graze l and det grow like 1/v', so det/l stays of the order r^2 |v| with an
//! error 1e-16 l, that is 1e-16/|v'| for each impact. The frequency of such impacts is proportional to their
//! speed, and the mean of ln|v'| is finite, so the sum of the two exponents has an error of about 1e-13.

use core::ops::ControlFlow;

use glam::DMat2;

use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::ImpactState;
use crate::numerics::batch_means::{BatchMeans, FEWEST_NUMBERS};
use crate::numerics::elementary::ln;
use crate::numerics::error::{Error, within};
use crate::run::Observer;
use crate::sweep::bouncing_map::BouncingMap;
use crate::sweep::lyapunov::{LyapunovEstimate, TangentGrowth};
use crate::sweep::{SweepEvent, SweepImpact, sweep_with};

/// Both Lyapunov exponents per impact of the impact map.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LyapunovSpectrum {
    /// The largest exponent: the mean logarithmic growth of a small perturbation per impact.
    pub largest: f64,
    /// Its standard error over the one orbit followed: scatter, drift and rounding ([`BatchMeans`]).
    pub standard_error: f64,
    /// The other exponent. `None` for restitution 0, for which the map loses one of its two dimensions at
    /// every impact and the exponent is minus infinity, and if a compliant contact does the same.
    pub second: Option<f64>,
    /// The exact sum of the two exponents over these impacts: 2 ln(restitution) + ln(v_0/v_n)/n with the
    /// impact velocities before the first and after the last of n flights. It tends to 2 ln(restitution).
    /// `None` for restitution 0 and for compliant contacts.
    pub exact_sum: Option<f64>,
    /// Impacts through which the perturbations were followed.
    pub impacts: u64,
}

/// The exponents of an orbit, or the reason why it has none.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum LyapunovOutcome {
    /// The orbit lasted for the requested number of impacts.
    Exponents(LyapunovSpectrum),
    /// The disk came to rest on the platform. The motion after a rest does not depend on the motion before,
    /// so the orbit of the map has no exponent; [`ImpactMap::verdict`](crate::ImpactMap::verdict) describes
    /// the motion of the disk.
    Rested {
        /// Impacts before the rest, including the transient.
        impacts: u64,
    },
    /// An impact has zero speed, or one so small that the derivative overflows a double: the growth beyond it
    /// is undefined.
    Grazed {
        /// Impacts up to this one, including the transient.
        impacts: u64,
        /// The phase of this impact.
        phase: Phase,
    },
}

impl LyapunovOutcome {
    /// The exponents, if there are any.
    #[must_use]
    pub const fn spectrum(&self) -> Option<&LyapunovSpectrum> {
        match self {
            Self::Exponents(spectrum) => Some(spectrum),
            Self::Rested { .. } | Self::Grazed { .. } => None,
        }
    }
}

/// The QR decomposition along an orbit: the first direction follows [`TangentGrowth`], the second is
/// perpendicular to it.
#[derive(Debug, Clone)]
struct TangentFrame {
    first: TangentGrowth,
    batches: BatchMeans,
    second_sum: f64,
}

impl TangentFrame {
    fn grow(&mut self, derivative: DMat2) {
        let across = self.first.tangent().perp();
        let length = self.first.grow(derivative);
        self.batches.push(length);
        // The component of the second direction perpendicular to the new first one.
        self.second_sum += ln(self.first.tangent().perp().dot(derivative * across).abs());
    }
}

/// The state of the computation of an orbit's exponents.
#[derive(Debug, Clone)]
struct Followed<'m, M> {
    map: &'m M,
    state: ImpactState,
    impacts: u64,
    first_velocity: f64,
    frame: TangentFrame,
    outcome: Option<LyapunovOutcome>,
}

impl<M: BouncingMap> Followed<'_, M> {
    fn see(&mut self, event: &SweepEvent, transient: u64, impacts: u64) -> ControlFlow<()> {
        let SweepEvent::Impact(SweepImpact { state, duration, .. }) = *event else {
            self.outcome = Some(LyapunovOutcome::Rested { impacts: self.impacts });
            return ControlFlow::Break(());
        };
        self.impacts += 1;
        if self.impacts > transient {
            if self.frame.batches.count() == 0 {
                self.first_velocity = self.state.velocity();
            }
            self.frame.grow(self.map.derivative(self.state, state, duration).0);
        }
        self.state = state;
        if !self.frame.first.is_bounded() {
            self.outcome = Some(LyapunovOutcome::Grazed { impacts: self.impacts, phase: state.phase() });
        } else if self.frame.batches.count() >= impacts {
            self.outcome = self.spectrum().map(LyapunovOutcome::Exponents);
        } else {
            return ControlFlow::Continue(());
        }
        ControlFlow::Break(())
    }

    fn spectrum(&self) -> Option<LyapunovSpectrum> {
        let impacts = self.frame.batches.count();
        let restitution = self.map.restitution();
        let telescoped = ln(self.first_velocity / self.state.velocity()) / impacts as f64;
        let two = restitution > 0.0;
        let is_known = two && self.map.shrinks_areas_exactly();
        Some(LyapunovSpectrum {
            largest: self.frame.batches.mean()?,
            standard_error: self.frame.batches.standard_error()?,
            second: two.then(|| self.frame.second_sum / impacts as f64).filter(|sum| sum.is_finite()),
            exact_sum: is_known.then(|| 2.0 * ln(restitution) + telescoped),
            impacts,
        })
    }
}

/// Both Lyapunov exponents per impact of each orbit of `starts`, over `impacts` >= 16 impacts after a
/// transient of `transient` impacts, with the standard error of the largest; for an orbit without exponents,
/// the reason. Orbits on a sine advance in lockstep.
///
/// The largest exponent equals the result of [`lyapunov_exponents`](crate::chaos::lyapunov_exponents) up to
/// the rounding of its sum.
///
/// The items of `observer` are the orbits.
///
/// ```
/// use bouncing_disk_core::chaos::{LyapunovOutcome, lyapunov_spectra};
/// use bouncing_disk_core::{ImpactMap, ImpactState, Unobserved, Vibration};
///
/// let map = ImpactMap::new(Vibration::from_axial_forcing(0.55)?, 0.5)?;
/// let start = ImpactState::from_normalised(0.8, 1.3)?;
/// let outcomes = lyapunov_spectra(&[(map, start)], 1_000, 10_000, &Unobserved)?;
/// let spectrum = outcomes[0].spectrum().expect("it bounces on");
/// // Chaos, and the sum of the exponents is that of the map: close to 2 ln(1/2).
/// assert!(spectrum.largest > 10.0 * spectrum.standard_error);
/// let (second, sum) = (spectrum.second.unwrap_or(0.0), spectrum.exact_sum.unwrap_or(0.0));
/// assert!((spectrum.largest + second - sum).abs() < 1e-12 && (sum + 1.386).abs() < 1e-2);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] for fewer than 16 impacts; errors of [`sweep`](crate::sweep::sweep()).
pub fn lyapunov_spectra<M: BouncingMap>(
    starts: &[(M, ImpactState)],
    transient: u64,
    impacts: u64,
    observer: &dyn Observer,
) -> Result<Vec<LyapunovOutcome>, Error> {
    within("impacts", impacts as f64, FEWEST_NUMBERS as f64, f64::MAX, "at least 16")?;
    let orbits: Vec<M::Orbit> =
        starts.iter().map(|(map, state)| map.orbit(*state, ChatterPolicy::Complete)).collect();
    sweep_with(
        &orbits,
        |index| {
            let (map, state) = (&starts[index].0, starts[index].1);
            let batches = LyapunovEstimate::growths();
            let frame = TangentFrame { first: TangentGrowth::default(), batches, second_sum: 0.0 };
            Followed { map, state, impacts: 0, first_velocity: 0.0, frame, outcome: None }
        },
        |followed, event| followed.see(event, transient, impacts),
        // An orbit that ends without an event has been at rest from the start.
        |followed| Ok(followed.outcome.unwrap_or(LyapunovOutcome::Rested { impacts: followed.impacts })),
        observer,
    )
}

#[cfg(test)]
mod tests;
