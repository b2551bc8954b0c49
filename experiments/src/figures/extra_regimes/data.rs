//! The data of the figure.

use bouncing_disk::core::VerdictSettings;
use serde::{Deserialize, Serialize};

/// The data of the map of verdicts.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraRegimesData {
    /// Γ of the columns and restitutions of the rows.
    pub(super) axial_forcings: Vec<f64>,
    pub(super) restitutions: Vec<f64>,
    /// How long each orbit was followed.
    pub(super) settings: VerdictSettings,
    /// The verdicts, row by row: of each column the digit of its [`Kind`].
    pub(super) rows: Vec<String>,
    /// How many cells of each kind there are.
    pub(super) counts: Vec<usize>,
    /// Cells of period 1 in one period of the platform that lie outside of the closed forms of birth and
    /// doubling.
    pub(super) period_one_outside: usize,
    /// Cells with a platform that never falls away, below the birth of the period-1 orbit: all, and those at
    /// rest.
    pub(super) weak: [usize; 2],
    /// Cells where the disk came to rest before it settled on a periodic or chaotic attractor.
    pub(super) after_rest: usize,
}

/// What a disk does for good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    AtRest,
    ExactCycle,
    LongCycle,
    PeriodOne,
    PeriodTwo,
    PeriodThree,
    LongerPeriod,
    Chaotic,
    Undecided,
}

impl Kind {
    pub(super) const ALL: [Self; 9] = [
        Self::AtRest,
        Self::ExactCycle,
        Self::LongCycle,
        Self::PeriodOne,
        Self::PeriodTwo,
        Self::PeriodThree,
        Self::LongerPeriod,
        Self::Chaotic,
        Self::Undecided,
    ];

    pub(super) const fn digit(self) -> u8 {
        self as u8
    }
}

impl ExtraRegimesData {
    pub(super) fn cells(&self) -> usize {
        self.axial_forcings.len() * self.restitutions.len()
    }

    /// The share of the cells that are of a kind.
    pub(super) fn share(&self, kind: Kind) -> f64 {
        let count = self.counts.get(usize::from(kind.digit())).copied().unwrap_or_default();
        count as f64 / self.cells() as f64
    }

    pub(super) fn caption(&self) -> String {
        let percent = |kind: Kind| format!("{:.2} %", 100.0 * self.share(kind));
        format!(
            "What a disk does for good that first hits the platform as it rises fastest, with the speed of the period-1 orbit: at rest on a \
             platform that never falls away; thrown, chattering, and at rest in a cycle that doubles can follow exactly; in one that is \
             so long that its rounding chooses it; on an attracting periodic orbit of 1, 2, 3 or more impacts; chaotic, by an exponent more \
             than three standard errors above zero; undecided ({}). Lines: birth and first doubling of the period-1 orbit, in closed \
             form, and Γ = 1/π, from which on the platform falls away (dotted). Each of {} by {} cells is followed for at most {} impacts, \
             and as many after a rest. Chaotic: {}; cycles chosen by rounding: {}.",
            percent(Kind::Undecided),
            self.axial_forcings.len(),
            self.restitutions.len(),
            self.settings.transient + self.settings.impacts,
            percent(Kind::Chaotic),
            percent(Kind::LongCycle),
        )
    }

    pub(super) fn parameters(&self) -> Vec<(String, String)> {
        let settings = &self.settings;
        [
            ("cells", format!("{} by {}", self.axial_forcings.len(), self.restitutions.len())),
            ("start", "impact at phase 0, |w_A| = 2π/(1 + ε) g/ω".to_owned()),
            ("impacts of the transient", settings.transient.to_string()),
            ("impacts of the exponent", settings.impacts.to_string()),
            ("longest period", format!("{} impacts", settings.longest_period)),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .into()
    }
}
