//! The data of the figure.

use serde::{Deserialize, Serialize};

use crate::table::{Cell, Table};

/// The data of the doubling cascade.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraCascadeData {
    /// Feigenbaum's constants as they are published.
    pub(super) published_delta: f64,
    pub(super) published_alpha: f64,
    /// The first one is that of Fig. 6.
    pub(super) cascades: Vec<Cascade>,
}

/// The cascade of one restitution.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Cascade {
    /// ε, the decimal number itself.
    pub(super) restitution: String,
    pub(super) doublings: Vec<Doubling>,
    /// From the seventh doubling on.
    pub(super) estimates: Vec<Estimate>,
    /// Γ_∞ − Γ_n at the last doubling, from the last separation and δ.
    pub(super) beyond_last: f64,
    /// Γ_1 in double-doubles, less its closed form.
    pub(super) closed_form_deviation: f64,
    pub(super) doubles_end: DoublesEnd,
}

/// One doubling in double-doubles, and in doubles.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Doubling {
    pub(super) number: usize,
    /// Impacts of the orbit that loses its stability.
    pub(super) period: usize,
    /// Γ_n with 25 decimals.
    pub(super) axial_forcing: String,
    /// Γ_n − Γ_(n−1).
    pub(super) separation: Option<f64>,
    /// The largest distance (rad) of an impact from the one half a period later.
    pub(super) width: f64,
    /// Stated bound on the rounding of Γ_n.
    pub(super) forcing_error: f64,
    pub(super) axial_forcing_in_doubles: f64,
    /// What the doubles state, and what it is.
    pub(super) forcing_error_in_doubles: f64,
    pub(super) true_error_in_doubles: f64,
    /// How far the multiplier that the doubles left is from −1.
    pub(super) multiplier_error_in_doubles: f64,
}

/// Feigenbaum's constants from the doublings up to one of them.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Estimate {
    pub(super) number: usize,
    pub(super) extended: Constants,
    pub(super) in_doubles: Constants,
}

/// δ and α: plain ratios, and extrapolated with their errors.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Constants {
    pub(super) forcing_ratio: f64,
    pub(super) delta: f64,
    pub(super) delta_error: f64,
    pub(super) width_ratio: f64,
    pub(super) alpha: f64,
    pub(super) alpha_error: f64,
}

/// Where doubles can no longer tell two doublings apart.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct DoublesEnd {
    /// The first n whose separation Γ_n − Γ_(n−1) is not larger than the stated error of doubles there.
    pub(super) number: usize,
    pub(super) separation: f64,
    pub(super) forcing_error: f64,
}

impl ExtraCascadeData {
    pub(super) fn caption(&self) -> String {
        let ends: Vec<String> = self
            .cascades
            .iter()
            .map(|cascade| {
                let end = &cascade.doubles_end;
                format!("n = {} (ε = {}, {:.0e})", end.number, cascade.restitution, end.separation)
            })
            .collect();
        format!(
            "The cascade that starts from the period-1 orbit, in numbers of two doubles (31 digits). (a) Distances Γ_∞ − Γ_n of the \
             doublings from their limit, and the true errors of Γ_n in doubles (crosses) with their stated bound (dotted). (b) Distance of the ratios \
             δ_n = (Γ_(n−1) − Γ_(n−2))/(Γ_n − Γ_(n−1)) from Feigenbaum's δ (open), of the extrapolated values (filled), and of those from doubles \
             (crosses); bars reach up to the stated error. (c) The same for α, from the widths of the orbits. (d) The numbers for ε = {}. \
             Extrapolated, the separations fall below the stated error of doubles at {}: there doubles end.",
            self.cascades.first().map_or("", |cascade| cascade.restitution.as_str()),
            ends.join(", ")
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        let restitutions: Vec<&str> =
            self.cascades.iter().map(|cascade| cascade.restitution.as_str()).collect();
        let doublings = self.cascades.first().map_or(0, |cascade| cascade.doublings.len());
        [("ε", restitutions.join(", ")), ("doublings", doublings.to_string())]
            .map(|(name, value)| (name.to_owned(), value))
            .into()
    }

    /// All doublings; the forcings as text, for a double does not hold them.
    pub(super) fn table(&self) -> Table {
        let columns = [
            "restitution",
            "n",
            "period",
            "axial_forcing",
            "axial_forcing_in_doubles",
            "forcing_ratio",
            "delta",
            "delta_error",
            "alpha",
            "alpha_error",
        ];
        let mut table = Table::new(columns);
        for cascade in &self.cascades {
            for doubling in &cascade.doublings {
                let estimate = cascade.estimate(doubling.number);
                let of = |value: fn(&Constants) -> f64| Cell::from(estimate.map(value));
                table = table.row([
                    cascade.restitution.as_str().into(),
                    (doubling.number as i64).into(),
                    (doubling.period as i64).into(),
                    doubling.axial_forcing.as_str().into(),
                    doubling.axial_forcing_in_doubles.into(),
                    of(|constants| constants.forcing_ratio),
                    of(|constants| constants.delta),
                    of(|constants| constants.delta_error),
                    of(|constants| constants.alpha),
                    of(|constants| constants.alpha_error),
                ]);
            }
        }
        table
    }
}

impl Cascade {
    /// The estimate in double-doubles from the doublings up to this one.
    pub(super) fn estimate(&self, number: usize) -> Option<&Constants> {
        self.estimates.iter().find(|estimate| estimate.number == number).map(|estimate| &estimate.extended)
    }

    /// The ratios δ_n and α_n of one doubling and the ones before it; those that there are not.
    pub(super) fn ratios(&self, number: usize) -> (Option<f64>, Option<f64>) {
        let at = |number: usize| self.doublings.iter().find(|doubling| doubling.number == number);
        let (Some(now), Some(before)) = (at(number), number.checked_sub(1).and_then(at)) else {
            return (None, None);
        };
        let of_widths = (before.width > 0.0).then(|| before.width / now.width);
        (before.separation.zip(now.separation).map(|(before, now)| before / now), of_widths)
    }

    /// n and Γ_∞ − Γ_n.
    pub(super) fn distances(&self) -> Vec<(f64, f64)> {
        let mut left = self.beyond_last;
        let mut distances = Vec::new();
        for doubling in self.doublings.iter().rev() {
            distances.push((doubling.number as f64, left));
            left += doubling.separation.unwrap_or(0.0);
        }
        distances.reverse();
        distances
    }
}
