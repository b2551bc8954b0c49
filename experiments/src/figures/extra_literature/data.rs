//! The data of the comparison with the literature.

use serde::{Deserialize, Serialize};

use crate::claim::Cases;
use crate::judging::AGREED_SHARE;

/// The data of the comparison with the literature.
#[derive(Debug, Serialize, Deserialize)]
pub struct ExtraLiteratureData {
    pub(super) sources: Vec<Compared>,
    pub(super) not_read: Vec<Unread>,
}

/// An entry of `data/literature`, and what the exact map says of it.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Compared {
    pub(super) id: String,
    pub(super) source: String,
    pub(super) address: String,
    pub(super) quotation: String,
    pub(super) rows: Vec<Row>,
}

/// One statement beside what the exact map gives.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) name: String,
    pub(super) quantity: String,
    /// As it is printed; none where the source gives no number.
    pub(super) printed: Option<String>,
    pub(super) answer: Answer,
}

/// What could not be read.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Unread {
    pub(super) source: String,
    pub(super) seen: String,
}

/// What the exact map says of one statement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) judgement: Judgement,
    /// The number, where it is one, with all its digits.
    pub(super) value: Option<f64>,
    /// For how many inputs that print alike it holds.
    pub(super) agreement: Option<Cases>,
    /// What comes out, in words.
    pub(super) computed: String,
    /// Why it differs or cannot be compared, and what else is worth knowing; may be empty.
    pub(super) reason: String,
}

/// How a printed statement and the exact map compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Judgement {
    /// It rounds to what is printed, or the statement holds: for all inputs that print alike.
    Agrees,
    /// It does not.
    Differs,
    /// It does for some of the inputs that print alike.
    DependsOnUnprintedDigits,
    /// The text that could be read lacks what would be needed.
    NotComparable,
    /// The source gives no number.
    NothingPrinted,
}

impl Judgement {
    pub(super) const ALL: [Self; 5] = [
        Self::Agrees,
        Self::Differs,
        Self::DependsOnUnprintedDigits,
        Self::NotComparable,
        Self::NothingPrinted,
    ];

    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Differs => "differs",
            Self::DependsOnUnprintedDigits => "depends on unprinted digits",
            Self::NotComparable => "not comparable",
            Self::NothingPrinted => "nothing printed",
        }
    }

    fn of(holds: bool) -> Self {
        if holds { Self::Agrees } else { Self::Differs }
    }
}

impl Answer {
    fn new(judgement: Judgement, computed: impl Into<String>) -> Self {
        let (computed, reason) = (computed.into(), String::new());
        Self { judgement, value: None, agreement: None, computed, reason }
    }

    /// A number that is judged already.
    pub(super) fn number(value: f64, digits: usize, holds: bool) -> Self {
        Self { value: Some(value), ..Self::new(Judgement::of(holds), rounded(value, digits)) }
    }

    /// Whether a statement holds, and what shows it.
    pub(super) fn statement(holds: bool, computed: impl Into<String>) -> Self {
        Self::new(Judgement::of(holds), computed)
    }

    /// For how many inputs that print alike a statement holds, and what comes out for the printed ones.
    pub(super) fn share(agreement: Cases, computed: impl Into<String>) -> Self {
        let judgement = match agreement.share().unwrap_or(0.0) {
            share if share >= AGREED_SHARE => Judgement::Agrees,
            // Of whole numbers, so that one in twenty is no matter of rounding.
            _ if 20 * agreement.holding <= agreement.tried => Judgement::Differs,
            _ => Judgement::DependsOnUnprintedDigits,
        };
        Self { agreement: Some(agreement), ..Self::new(judgement, computed) }
    }

    pub(super) fn not_comparable(computed: impl Into<String>) -> Self {
        Self::new(Judgement::NotComparable, computed)
    }

    pub(super) fn nothing_printed(computed: impl Into<String>) -> Self {
        Self::new(Judgement::NothingPrinted, computed)
    }

    /// The same with a reason or remark.
    pub(super) fn because(self, reason: impl Into<String>) -> Self {
        Self { reason: reason.into(), ..self }
    }

    /// The same with the number behind the words.
    pub(super) fn with_value(self, value: f64) -> Self {
        Self { value: Some(value), ..self }
    }
}

impl ExtraLiteratureData {
    /// All rows with the entry that they belong to.
    pub(super) fn rows(&self) -> impl Iterator<Item = (&Compared, &Row)> {
        self.sources.iter().flat_map(|source| source.rows.iter().map(move |row| (source, row)))
    }

    pub(super) fn count(&self, judgement: Judgement) -> usize {
        self.rows().filter(|(_, row)| row.answer.judgement == judgement).count()
    }
}

/// A number with so many significant digits, without zeros at its end.
pub(super) fn rounded(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits.max(1) - 1);
    scientific.parse::<f64>().map_or(scientific, |short| short.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_written_with_its_significant_digits() {
        assert_eq!(rounded(0.486_003_078, 5), "0.486");
        assert_eq!(rounded(-1234.567, 6), "-1234.57");
        assert_eq!(rounded(0.0, 3), "0");
        assert_eq!(rounded(f64::NAN, 3), "NaN");
        assert_eq!(rounded(2.4e-9, 0), "0.000000002");
    }

    #[test]
    fn a_share_is_judged_as_a_claim_is() {
        let judged = |holding| Answer::share(Cases { holding, tried: 20 }, "").judgement;
        assert_eq!(judged(20), Judgement::Agrees);
        assert_eq!(judged(19), Judgement::Agrees);
        assert_eq!(judged(18), Judgement::DependsOnUnprintedDigits);
        assert_eq!(judged(2), Judgement::DependsOnUnprintedDigits);
        assert_eq!(judged(1), Judgement::Differs);
        assert_eq!(Answer::share(Cases { holding: 0, tried: 0 }, "").judgement, Judgement::Differs);
    }
}
