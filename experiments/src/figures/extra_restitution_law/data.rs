//! The data of the figure.

use bouncing_disk::core::KuwabaraKono;
use serde::{Deserialize, Serialize};

/// The data of the comparison of two laws.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraRestitutionLawData {
    pub(super) law: KuwabaraKono,
    /// Γ from which the period-1 attractor is followed, and the last Γ of the diagram.
    pub(super) axial_forcing_range: (f64, f64),
    pub(super) axial_forcing_values: usize,
    pub(super) transient_impacts: usize,
    pub(super) kept_impacts: usize,
    pub(super) constant: Followed,
    pub(super) viscoelastic: Followed,
    /// r(v) of the viscoelastic law: |w_A Γ/(ωA)| and r.
    pub(super) restitution_by_normalised_speed: Vec<(f64, f64)>,
}

/// The attractor that is followed from the period-1 orbit.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Followed {
    pub(super) columns: Vec<Column>,
    /// The first Γ at which the disk comes to rest; `None` if it never does.
    pub(super) lost_at: Option<f64>,
    /// Γ of the first period doubling, where the derivative of the map along the period-1 orbit has the multiplier -1.
    pub(super) first_doubling: f64,
    /// The determinant of this derivative there.
    pub(super) determinant: f64,
    /// The slope of the launch speed r(v) v against the impact speed v, on the period-1 orbit.
    pub(super) launch_slope: f64,
    /// The largest distance of a multiplier's orbit from the period-1 orbit of the constant law: phase (rad) and speed (g/ω).
    pub(super) off_period_one: f64,
}

/// The impacts at one Γ.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Column {
    pub(super) axial_forcing: f64,
    pub(super) impact_phase_cycles: Vec<f64>,
    /// |w_A Γ/(ωA)|.
    pub(super) normalised_impact_speed: Vec<f64>,
}

impl ExtraRestitutionLawData {
    pub(super) fn caption(&self) -> String {
        let lost = |followed: &Followed| {
            followed.lost_at.map_or("not at all".to_owned(), |forcing| format!("at Γ = {forcing:.4}"))
        };
        format!(
            "The attractor followed in Γ from the period-1 orbit at Γ = {}, as in Fig. 6(a): (a) constant restitution {}; (b) the \
             law of viscoelastic bodies (Kuwabara and Kono), 1 - r proportional to v^(1/5) at low speed, with the same restitution at the \
             speed 2π g/(ω(1 + r)) of all period-1 impacts. {} impacts at each of {} values of Γ, after {} that are left out. Dashed: the \
             first period doublings, from the derivative of the map. The attractor is lost, as the disk comes to rest: {} in (a), {} in \
             (b). (c) Both laws; dot: where they agree; grey: the impact speeds in (b).",
            self.axial_forcing_range.0,
            self.law.reference_restitution(),
            self.kept_impacts,
            self.axial_forcing_values,
            self.transient_impacts,
            lost(&self.constant),
            lost(&self.viscoelastic),
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        [
            ("ε", self.law.reference_restitution().to_string()),
            ("reference speed", format!("{:.6} g/ω", self.law.reference_speed())),
            ("Γ", format!("{} to {}", self.axial_forcing_range.0, self.axial_forcing_range.1)),
            ("end of a chatter", "the paper's cut".to_owned()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
