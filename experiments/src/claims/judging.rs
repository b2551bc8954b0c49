//! The rules by which a number or a statement of the paper is judged: one for each kind.
//!
//! `docs/reproducing.md` has them for readers; a test compares the two. Every entry of the
//! [catalogue](super::catalogue) that the paper asserts names its kind, and the kind alone turns [`Cases`]
//! into a [`Verdict`].

use std::iter::Sum;

use serde::{Deserialize, Serialize};

/// The outcome of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Our value agrees within the tolerance, or the statement holds.
    Reproduced,
    /// It does not.
    Differs,
    /// It holds for some of the inputs that print like the paper's, and not for others.
    DependsOnUnprintedDigits,
    /// The paper's text does not contain what would be needed to compute it.
    NotComputable,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Reproduced, Self::Differs, Self::DependsOnUnprintedDigits, Self::NotComputable];
}

/// The least share of single orbits, or of inputs that print alike, for which a statement counts as
/// reproduced; one minus it is the largest for which it counts as differing.
pub const AGREED_SHARE: f64 = 0.95;

/// A curve that is lower by no more than this share of what it spans is as high, for a reader of the picture:
/// the width of a line.
pub const LINE_WIDTH: f64 = 0.01;

/// A place that agrees with more than this share of the range of a curve, or of the curves, is no place.
pub const LARGEST_ACCEPTED: f64 = 0.5;

/// So many inputs are a sample, whose share has a standard error.
const SAMPLE: usize = 20;

/// In how many of the cases tried a statement holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cases {
    /// Cases in which it holds.
    pub holding: usize,
    /// Cases tried.
    pub tried: usize,
}

impl Cases {
    /// Counts the cases in which a statement holds.
    pub fn of(holds: impl IntoIterator<Item = bool>) -> Self {
        holds.into_iter().map(Self::from).sum()
    }

    /// A share of a quantity in place of counted cases, in parts of a thousand.
    pub fn of_share(share: f64) -> Self {
        Self { holding: (1e3 * share.clamp(0.0, 1.0)).round() as usize, tried: 1_000 }
    }

    /// The share of the cases in which it holds; `None` where none was tried.
    pub fn share(self) -> Option<f64> {
        (self.tried > 0).then(|| self.holding as f64 / self.tried as f64)
    }

    /// The standard error of the share, as that of a sample; `None` where none was tried.
    pub fn standard_error(self) -> Option<f64> {
        self.share().map(|share| (share * (1.0 - share) / self.tried as f64).sqrt())
    }

    /// In words: how many of how many, the share and its standard error.
    pub fn words(self) -> String {
        let Self { holding, tried } = self;
        match self.share().zip(self.standard_error()) {
            Some((share, error)) => {
                format!("{holding} of {tried}, {:.1} ± {:.1} %", 100.0 * share, 100.0 * error)
            }
            None => "none".to_owned(),
        }
    }

    /// Whether more draws might move the share across one of the bounds: it is nearer to it than two standard
    /// errors. A handful is no sample.
    pub fn is_close(self) -> bool {
        let near = |share: f64, error: f64| {
            [AGREED_SHARE, 1.0 - AGREED_SHARE].iter().any(|bound| (share - bound).abs() < 2.0 * error)
        };
        self.tried >= SAMPLE
            && self.share().zip(self.standard_error()).is_some_and(|(share, error)| near(share, error))
    }

    /// Of draws that print alike, and of single orbits: reproduced from [`AGREED_SHARE`] on, differing where
    /// it fails for as many.
    pub fn sampled(self) -> Verdict {
        match self.share() {
            None => Verdict::NotComputable,
            Some(share) if share >= AGREED_SHARE => Verdict::Reproduced,
            // Of whole numbers, so that one in twenty is no matter of rounding.
            Some(_) if 20 * self.holding <= self.tried => Verdict::Differs,
            Some(_) => Verdict::DependsOnUnprintedDigits,
        }
    }
}

impl From<bool> for Cases {
    fn from(holds: bool) -> Self {
        Self { holding: usize::from(holds), tried: 1 }
    }
}

/// `None`: there is nothing to judge by.
impl From<Option<bool>> for Cases {
    fn from(holds: Option<bool>) -> Self {
        holds.map_or_else(Self::default, Self::from)
    }
}

/// Several groups of cases together.
impl Sum for Cases {
    fn sum<I: Iterator<Item = Self>>(groups: I) -> Self {
        groups.fold(Self::default(), |sum, more| Self {
            holding: sum.holding + more.holding,
            tried: sum.tried + more.tried,
        })
    }
}

macro_rules! kinds {
    ($($(#[doc = $doc:literal])+ $kind:ident = $name:literal, $rule:literal;)*) => {
        /// The kinds of numbers and statements.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        #[non_exhaustive]
        pub enum Kind { $($(#[doc = $doc])+ $kind,)* }

        impl Kind {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// The name in `data/paper`, `claims.json` and on the pages.
            pub fn name(self) -> &'static str {
                match self { $(Self::$kind => $name,)* }
            }

            /// The rule, in words.
            pub fn rule(self) -> &'static str {
                match self { $(Self::$kind => $rule,)* }
            }
        }
    };
}

kinds! {
    /// A printed number that follows from an equation, or from a simulation whose inputs are printed.
    Number = "number", "Reproduced if our value, at exactly the printed inputs, agrees within half a unit of the last printed digit.";
    /// A printed number that the authors computed from rounded measurements.
    Measured = "measured", "Judged over inputs that all round to the printed ones: reproduced if it agrees for at least 95 % of them, differs if for at most 5 %, otherwise depends on unprinted digits.";
    /// A reading from drawn curves: a maximum, its place, or the coincidence of two maxima.
    Maximum = "maximum", "Read from the drawn curves. A value is judged as a number. A place agrees if the curve there lies below its maximum by at most a line's width, a hundredth of the curve's span. If more than half of the drawn range, by length, or of the drawn curves would agree, the verdict is no data.";
    /// A formula with an equality.
    Equation = "equation", "Reproduced if both sides agree apart from rounding.";
    /// One thing is larger, slower, negligible, significant.
    Comparison = "comparison", "Reproduced if our values stand in the stated relation. A \"negligible\" difference is at most the largest between numbers that round to the paper's own two; a \"significant\" one exceeds the printed uncertainty.";
    /// Said of a whole range of parameters, or without any qualification.
    Always = "always", "Differs if there is one counterexample inside the stated range, provided that it is not a single point: it must persist under a small change of the inputs.";
    /// "Can", "may", "possible", or one named case.
    Exists = "exists", "Reproduced if there is one example.";
    /// "Most", "predominantly", a regime that a range is named after.
    Most = "most", "Reproduced if it holds for more than half of the cases.";
    /// "Grows", "falls", "rises", "approaches".
    Trend = "trend", "Reproduced if, among all pairs of points of the range whose values differ, more change in the stated direction than in the other. A maximum or a turn counts as two trends.";
    /// "Much larger", "sufficiently", "eventually".
    Limit = "limit", "Reproduced if the deviation falls below a hundredth in the stated limit.";
    /// "Appears", "seems", "can be seen".
    Appears = "appears", "Reproduced if the cited picture, at its resolution, shows it over most of the range meant; behaviour between the plotted points does not count.";
    /// A speed, a torque, a form of transient or a trend of the motor.
    Motor = "motor", "Two verdicts. The first, which counts, is on the mean of an ensemble of motors with perturbed relaunch; over many values of a parameter, on the median of the means or of the exponents. The second is on single unperturbed orbits: reproduced if it holds for at least 95 % of them, differs if for at most 5 %.";
    /// Which orbit one motor is on, and what follows from that.
    Orbit = "orbit", "Judged over single orbits, like the second verdict on a motor.";
}

impl Kind {
    /// The verdict on a statement of this kind.
    pub fn verdict(self, cases: Cases) -> Verdict {
        let Cases { holding, tried } = cases;
        let holds = match self {
            Self::Measured | Self::Orbit => return cases.sampled(),
            Self::Exists => holding > 0,
            Self::Most | Self::Trend => 2 * holding > tried,
            _ => holding == tried,
        };
        match (tried, holds) {
            (0, _) => Verdict::NotComputable,
            (_, true) => Verdict::Reproduced,
            (_, false) => Verdict::Differs,
        }
    }
}

/// All pairs of points that differ, by rising abscissa: in how many the ordinate rises (`sign` 1) or falls
/// (−1).
pub fn trend(points: impl IntoIterator<Item = (f64, f64)>, sign: f64) -> Cases {
    let mut points: Vec<(f64, f64)> = points.into_iter().collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    let pairs = points.iter().enumerate().flat_map(|(index, one)| {
        points[index + 1..].iter().filter(move |other| other.0 > one.0).map(move |other| other.1 - one.1)
    });
    Cases::of(pairs.filter(|change| *change != 0.0).map(|change| sign * change > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_rule_for_each_kind() {
        let verdicts = |holding, tried| {
            let of = |kind: Kind| kind.verdict(Cases { holding, tried });
            [Kind::Always, Kind::Exists, Kind::Most, Kind::Orbit].map(of)
        };
        use Verdict::{DependsOnUnprintedDigits as Depends, Differs, NotComputable as Nothing, Reproduced};
        assert_eq!(verdicts(200, 200), [Reproduced; 4]);
        assert_eq!(verdicts(199, 200), [Differs, Reproduced, Reproduced, Reproduced]);
        assert_eq!(verdicts(189, 200), [Differs, Reproduced, Reproduced, Depends]);
        assert_eq!(verdicts(100, 200), [Differs, Reproduced, Differs, Depends]);
        assert_eq!(verdicts(10, 200), [Differs, Reproduced, Differs, Differs]);
        assert_eq!(verdicts(0, 200), [Differs; 4]);
        assert_eq!(verdicts(0, 0), [Nothing; 4]);
    }

    #[test]
    fn shares_of_samples_have_errors_and_may_be_near_a_bound() {
        assert_eq!(Cases::of([true, false, true]), Cases { holding: 2, tried: 3 });
        assert_eq!(Cases { holding: 183, tried: 200 }.words(), "183 of 200, 91.5 ± 2.0 %");
        assert_eq!(Cases::default().words(), "none");
        // 0.95 is 2.7 standard errors above 0.90, and 1.97 above 0.915. Chosen ones are no sample.
        let close = |holding| Cases { holding, tried: 200 }.is_close();
        assert!(close(183) && close(190) && close(10) && !close(180) && !close(100) && !close(200));
        assert!(!Cases { holding: 2, tried: 6 }.is_close());
    }

    #[test]
    fn a_trend_counts_pairs_and_not_neighbours() {
        let sawtooth = [(0.0, 0.0), (1.0, 2.0), (2.0, 1.0), (3.0, 3.0), (3.0, -9.0)];
        let Cases { holding, tried } = trend(sawtooth[..4].iter().copied(), 1.0);
        assert_eq!((holding, tried), (5, 6));
        assert_eq!(trend(sawtooth, 1.0).tried, 9, "two values at one place are no pair");
        assert_eq!(trend([(0.0, 1.0), (1.0, 1.0)], -1.0), Cases::default());
    }

    #[test]
    fn the_page_has_these_rules() {
        const PAGE: &str = include_str!("../../../docs/reproducing.md");
        for kind in Kind::ALL {
            let row = format!("| {} | {} |", kind.name(), kind.rule());
            assert!(PAGE.contains(&row), "{row}");
            assert_eq!(serde_json::to_value(kind).expect("a name"), kind.name());
        }
        assert_eq!(PAGE.lines().filter(|line| line.starts_with("| ")).count(), Kind::ALL.len() + 2);
    }
}
