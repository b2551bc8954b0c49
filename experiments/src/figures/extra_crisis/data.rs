//! The data of the figure.

use bouncing_disk::core::{Crisis, CrisisLives, Tangency};
use serde::{Deserialize, Serialize};

/// An impact: phase in periods, in [-1/2, 1/2), and normalised speed |w_A Γ/(ωA)|.
pub(super) type Spot = (f64, f64);

/// The data of the crisis.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraCrisisData {
    pub(super) crisis: Crisis,
    /// The tangency that is its reason.
    pub(super) contact: Tangency,
    /// Γ at which the unstable manifold of the period-1 orbit, in the midst of the attractor, touches the same
    /// stable manifold.
    pub(super) midst_forcing: f64,
    /// Impacts of an orbit on the attractor at the crisis.
    pub(super) attractor: Vec<Spot>,
    /// The stable and the unstable manifold of the saddle at the crisis, piece by piece.
    pub(super) stable: Vec<Vec<Spot>>,
    pub(super) unstable: Vec<Vec<Spot>>,
    /// The impacts of the saddle, and those of the orbit of tangency.
    pub(super) saddle: Vec<Spot>,
    pub(super) tangency: Vec<Spot>,
    /// Which of the impacts of the tangency is the one that is magnified.
    pub(super) magnified: Spot,
    /// Mean lives beyond the crisis.
    pub(super) lives: CrisisLives,
    /// Orbits at each Γ beyond the crisis, and the impacts that each is followed for at most.
    pub(super) orbits: usize,
    pub(super) most_impacts: usize,
    /// The exponent that the multipliers of the saddle tell.
    pub(super) expected_exponent: Option<f64>,
}

impl ExtraCrisisData {
    pub(super) fn caption(&self) -> String {
        let law = match &self.lives.scaling {
            Ok(law) => format!(
                "the exponent of the fitted line is {:.2} ± {:.2} over {} forcings from {:.0e} to {:.0e}",
                law.exponent, law.standard_error, law.points, law.range.0, law.range.1
            ),
            Err(reason) => format!("no power law: {reason}"),
        };
        let expected =
            self.expected_exponent.map_or_else(String::new, |exponent| format!("; dashed, {:.3}", -exponent));
        format!(
            "The crisis of the attractor of Fig. 6 at restitution {}: at Γ = {:.7} the unstable manifold (red) of a saddle of {} impacts in {} \
             periods of the platform (circles) touches its own stable manifold (blue). (a) The attractor (dots) and the \
             stable manifold; crosses: the orbit of tangency. (b) The same next to one of its impacts, magnified. (c) Mean life in \
             impacts over the distance of Γ from the crisis: {} orbits each that start on the attractor, standard errors; {law}{expected}, what \
             the multipliers of the saddle tell.",
            self.crisis.restitution,
            self.crisis.forcing,
            self.contact.touched.period(),
            self.contact.touched.platform_periods,
            self.orbits,
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        [
            ("restitution", self.crisis.restitution.to_string()),
            ("Γ of the crisis", format!("{:.7} ± {:.0e}", self.crisis.forcing, self.crisis.forcing_error)),
            ("multipliers of the saddle", format!("{:.4}", self.contact.touched.multipliers())),
            ("orbits at each Γ", self.orbits.to_string()),
            ("impacts of an orbit at most", self.most_impacts.to_string()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
