//! The data of the figure.

use bouncing_disk::core::VerdictSettings;
use serde::{Deserialize, Serialize};

/// The data of the exponents over the forcing.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraLyapunovData {
    pub(super) restitution: f64,
    /// How long each orbit was followed.
    pub(super) settings: VerdictSettings,
    pub(super) columns: Vec<Column>,
    /// Γ at which the period-1 orbit doubles, in closed form.
    pub(super) first_doubling_forcing: f64,
    /// The largest deviation of the sum of both exponents from its exact value, over the columns whose orbits
    /// have both.
    pub(super) sum_deviation: f64,
    pub(super) columns_with_sum: usize,
    /// The largest difference of the exponent along an orbit from the logarithm of its multiplier, in
    /// standard errors or, where those are smaller, in units of 1/impacts, over the columns with a period.
    pub(super) multiplier_deviation: f64,
}

/// What a disk does at one forcing.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Column {
    pub(super) axial_forcing: f64,
    pub(super) kind: Kind,
    /// The exponent per impact and its standard error; none for a cycle that doubles follow exactly: no
    /// perturbation survives a rest.
    pub(super) exponent: Option<f64>,
    pub(super) standard_error: Option<f64>,
    /// Impacts of one period of the orbit, or of one cycle with rest.
    pub(super) impacts: Option<u64>,
    pub(super) impact_phase_cycles: Vec<f64>,
}

/// What a disk does for good.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Kind {
    Periodic,
    Chaotic,
    Rest,
    Undecided,
}

impl ExtraLyapunovData {
    pub(super) fn of(&self, kind: Kind) -> impl Iterator<Item = &Column> {
        self.columns.iter().filter(move |column| column.kind == kind)
    }

    pub(super) fn range(&self) -> (f64, f64) {
        let end = |column: Option<&Column>| column.map_or(0.0, |column| column.axial_forcing);
        (end(self.columns.first()), end(self.columns.last()))
    }

    /// Whether the errors are drawn: among more columns than these they are no longer than a point.
    pub(super) fn has_bars(&self) -> bool {
        self.columns.len() < 400
    }

    pub(super) fn caption(&self) -> String {
        let count = |kind: Kind| self.of(kind).count();
        let bars = if self.has_bars() { ", with three standard errors by batch means" } else { "" };
        format!(
            "Orbit diagram (a) and largest Lyapunov exponent per impact (b) for a restitution of {}, from one start at each of {} Γ. Blue: \
             periodic orbits, with the exponent of their multipliers; vermilion: chaos{bars}; grey: \
             the disk comes to rest again and again, where the exponent is that of the flights between two rests, drawn only where the \
             cycle is so long that rounding chooses it; black: undecided ({}). Dashed: the first doubling in closed form. {} columns are periodic, {} \
             chaotic, {} come to rest.",
            self.restitution,
            self.columns.len(),
            count(Kind::Undecided),
            count(Kind::Periodic),
            count(Kind::Chaotic),
            count(Kind::Rest),
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        let settings = &self.settings;
        [
            ("ε", self.restitution.to_string()),
            ("start", "impact at 1.2 rad, |w_A Γ/(ωA)| = 1.3".to_owned()),
            ("impacts of the transient", settings.transient.to_string()),
            ("impacts of the exponent", settings.impacts.to_string()),
            ("longest period", format!("{} impacts", settings.longest_period)),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
