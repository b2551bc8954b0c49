//! A number or statement printed in the paper, compared with ours.
//!
//! The verdict is the result of a comparison; nothing in this crate can set it by hand. What is printed comes from the
//! [ledger]; a printed number is compared at the precision it is printed with: half a unit of its last digit, read off
//! the printed text.

use serde::{Serialize, Serializer};

use crate::ledger::{self, PrintedEntry};
use crate::printed::PrintedNumber;

/// The outcome of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Our value agrees within the tolerance, or the statement holds.
    Reproduced,
    /// It does not.
    Differs,
    /// The paper's text does not contain what would be needed to compute it.
    NotComputable,
}

impl Verdict {
    /// The name used in `claims.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Differs => "differs",
            Self::NotComputable => "not-computable",
        }
    }
}

/// Our value.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Computed {
    /// A finite number, in the unit of the claim.
    Number(f64),
    /// Whether a statement holds.
    Boolean(bool),
    /// A label, or the name of a number that is not finite.
    Text(String),
    /// Nothing could be computed.
    Nothing,
}

impl Serialize for Computed {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => serializer.serialize_f64(*number),
            Self::Boolean(boolean) => serializer.serialize_bool(*boolean),
            Self::Text(text) => serializer.serialize_str(text),
            Self::Nothing => serializer.serialize_none(),
        }
    }
}

/// One printed number or statement and its comparison with ours; one object of `claims.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[must_use]
pub struct Claim {
    id: String,
    place: String,
    quantity: String,
    unit: String,
    printed: String,
    computed: Computed,
    tolerance: Option<f64>,
    verdict: Verdict,
    note: String,
    /// The number behind the printed text; `None` for statements and labels.
    #[serde(skip)]
    printed_value: Option<f64>,
    #[serde(skip)]
    source: Source,
}

/// Where the printed side of a claim comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Source {
    /// Not printed: a check of this work, in words.
    #[default]
    ThisWork,
    /// The answer to an entry of the [ledger].
    Entry(String),
    /// Another reading of an entry that is answered elsewhere.
    Reading(String),
}

impl Claim {
    /// The answer to the entry `key` of the [ledger], a printed number: `computed`, in the unit of the entry, compared
    /// within half a unit of the last printed digit. A computed NaN or infinity differs from every number.
    ///
    /// An unknown key, or an entry that is no number, gives a claim that differs and says so in its note.
    pub fn printed(key: &str, computed: f64) -> Self {
        Self::of_entry(key, |entry| {
            let printed = entry.printed.as_deref().unwrap_or_default();
            Self::number(&entry.figure, &entry.place, &entry.quantity, &entry.unit, printed, computed)
        })
    }

    /// The answer to the entry `key`, a printed label (a name, an ordering, a region) that must equal ours.
    pub fn printed_label(key: &str, computed: impl Into<String>) -> Self {
        Self::of_entry(key, |entry| {
            let printed = entry.printed.as_deref().unwrap_or_default();
            Self::label(&entry.figure, &entry.place, &entry.quantity, printed, computed)
        })
    }

    /// The answer to the entry `key`, a statement in words: whether our data agree, and the numbers that show it.
    /// The entry may name a number, as in "for Γ < 0.52 ...".
    pub fn printed_statement(key: &str, holds: bool, evidence: impl Into<String>) -> Self {
        Self::of_entry(key, |entry| {
            Self::statement(&entry.figure, &entry.place, &entry.quantity, holds, evidence)
        })
    }

    /// A further comparison with the printed number of the entry `key`, by the figure or table `id`: another way to
    /// compute it or another meaning of it. It does not answer the entry.
    pub fn reading(id: &str, key: &str, quantity: impl Into<String>, computed: f64) -> Self {
        Self::of_entry(key, |entry| {
            let printed = entry.printed.as_deref().unwrap_or_default();
            Self::number(id, &entry.place, quantity, &entry.unit, printed, computed)
        })
        .into_reading()
    }

    /// Like [`reading`](Self::reading) for the uncertainty of the entry, the number behind the ±.
    pub fn printed_uncertainty(id: &str, key: &str, quantity: impl Into<String>, computed: f64) -> Self {
        Self::of_entry(key, |entry| {
            let printed = entry.printed.as_deref().and_then(|text| text.split_once('±'));
            let printed = printed.map_or("", |(_, uncertainty)| uncertainty.trim());
            Self::number(id, &entry.place, quantity, &entry.unit, printed, computed)
        })
        .into_reading()
    }

    fn of_entry(key: &str, make: impl FnOnce(&PrintedEntry) -> Self) -> Self {
        let claim = match ledger::find(key) {
            Ok(entry) => make(entry),
            Err(error) => {
                // The first part of the key at least says which file was meant.
                let mut claim = Self::label("", key, "", "", "");
                claim.verdict = Verdict::Differs;
                claim.note(error.to_string())
            }
        };
        Self { source: Source::Entry(key.to_owned()), ..claim }
    }

    fn into_reading(self) -> Self {
        match self.source {
            Source::Entry(key) => Self { source: Source::Reading(key), ..self },
            _ => self,
        }
    }

    /// The claim of an entry that nothing can be computed for, for the reason given there.
    pub(crate) fn of_reason(entry: &PrintedEntry, reason: &str) -> Self {
        let printed = entry.printed.as_deref().unwrap_or("true");
        let claim =
            Self::not_computable(&entry.figure, &entry.place, &entry.quantity, &entry.unit, printed, reason);
        Self { source: Source::Entry(entry.key.clone()), ..claim }
    }

    /// A printed number, compared within half a unit of its last printed digit. In a figure it comes from the ledger:
    /// [`printed`](Self::printed).
    ///
    /// `printed` is the text exactly as printed: `"0.486"`, `"14 ± 5"` (compared with 14), `"0.323π"`,
    /// `"11.6 %"`, `"10⁻⁹"`, `"1.5 × 10⁻⁶"`, `"1e-6"`, `"≈ 22"`. `computed` is in the unit of the printed number;
    /// a printed multiple of π is compared as the product. A computed NaN or infinity differs from every number.
    ///
    /// A printed text that is not a number gives a claim that differs and says so in its note.
    pub(crate) fn number(
        id: impl Into<String>,
        place: impl Into<String>,
        quantity: impl Into<String>,
        unit: impl Into<String>,
        printed: impl Into<String>,
        computed: f64,
    ) -> Self {
        let printed = printed.into();
        let read = PrintedNumber::read(&printed);
        let mut claim = Self {
            id: id.into(),
            place: place.into(),
            quantity: quantity.into(),
            unit: unit.into(),
            computed: if computed.is_finite() {
                Computed::Number(computed)
            } else {
                Computed::Text(computed.to_string())
            },
            tolerance: read.map(|number| number.half_unit),
            verdict: Verdict::Differs,
            note: String::new(),
            printed_value: read.map(|number| number.value),
            source: Source::default(),
            printed,
        };
        if read.is_none() {
            claim.note = "the printed text could not be read as a number".to_owned();
        }
        claim.compare();
        claim
    }

    /// A printed label that must equal the computed one.
    pub(crate) fn label(
        id: impl Into<String>,
        place: impl Into<String>,
        quantity: impl Into<String>,
        printed: impl Into<String>,
        computed: impl Into<String>,
    ) -> Self {
        let (printed, computed) = (printed.into(), computed.into());
        Self {
            id: id.into(),
            place: place.into(),
            quantity: quantity.into(),
            unit: String::new(),
            verdict: if printed == computed { Verdict::Reproduced } else { Verdict::Differs },
            printed,
            computed: Computed::Text(computed),
            tolerance: None,
            note: String::new(),
            printed_value: None,
            source: Source::default(),
        }
    }

    /// A statement in words that is not printed: a check of this work, or a remark that a reader of the paper will
    /// want. What is printed comes from the ledger: [`printed_statement`](Self::printed_statement).
    ///
    /// `quantity` is the statement, `holds` whether our data agree, `evidence` the numbers
    /// that show it.
    pub fn statement(
        id: impl Into<String>,
        place: impl Into<String>,
        quantity: impl Into<String>,
        holds: bool,
        evidence: impl Into<String>,
    ) -> Self {
        Self {
            id: id.into(),
            place: place.into(),
            quantity: quantity.into(),
            unit: String::new(),
            printed: "true".to_owned(),
            computed: Computed::Boolean(holds),
            tolerance: None,
            verdict: if holds { Verdict::Reproduced } else { Verdict::Differs },
            note: evidence.into(),
            printed_value: None,
            source: Source::default(),
        }
    }

    /// A printed number or statement that cannot be computed from the paper's text, and why.
    pub(crate) fn not_computable(
        id: impl Into<String>,
        place: impl Into<String>,
        quantity: impl Into<String>,
        unit: impl Into<String>,
        printed: impl Into<String>,
        reason: impl Into<String>,
    ) -> Self {
        let printed = printed.into();
        Self {
            id: id.into(),
            place: place.into(),
            quantity: quantity.into(),
            unit: unit.into(),
            computed: Computed::Nothing,
            tolerance: None,
            verdict: Verdict::NotComputable,
            note: reason.into(),
            printed_value: PrintedNumber::read(&printed).map(|number| number.value),
            source: Source::default(),
            printed,
        }
    }

    /// Compares within `tolerance` instead of half a unit of the last digit. The note should say where it comes
    /// from. Has no effect on claims that compare no numbers.
    pub fn within(mut self, tolerance: f64) -> Self {
        if self.printed_value.is_some() && matches!(self.computed, Computed::Number(_)) {
            self.tolerance = Some(tolerance);
            self.compare();
        }
        self
    }

    /// Adds a remark. Several remarks are joined by "; ".
    pub fn note(mut self, note: impl AsRef<str>) -> Self {
        if !self.note.is_empty() {
            self.note.push_str("; ");
        }
        self.note.push_str(note.as_ref());
        self
    }

    fn compare(&mut self) {
        let (Some(printed), Some(tolerance), Computed::Number(computed)) =
            (self.printed_value, self.tolerance, &self.computed)
        else {
            return;
        };
        // A value exactly between two printed ones may round either way; the product of the decimal digits and
        // the unit is itself rounded, hence the small widening.
        let reproduced = (computed - printed).abs() <= tolerance * (1.0 + 1e-9);
        self.verdict = if reproduced { Verdict::Reproduced } else { Verdict::Differs };
    }

    /// Where the printed side comes from.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The figure or table.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Where in the paper: "Fig. 6 caption", "Sec. IV B".
    pub fn place(&self) -> &str {
        &self.place
    }

    /// What is compared.
    pub fn quantity(&self) -> &str {
        &self.quantity
    }

    /// The unit of the printed number; empty for a pure number.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// The text as printed.
    pub fn printed_text(&self) -> &str {
        &self.printed
    }

    /// Our value.
    pub fn computed(&self) -> &Computed {
        &self.computed
    }

    /// The largest difference that counts as agreement.
    pub fn tolerance(&self) -> Option<f64> {
        self.tolerance
    }

    /// The outcome.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Remarks.
    pub fn remarks(&self) -> &str {
        &self.note
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_is_no_number_differs() {
        let claim = Claim::number("fig06", "caption", "ratio", "", "about five", 5.0);
        assert_eq!(claim.verdict(), Verdict::Differs);
        assert!(claim.remarks().contains("could not be read"));
    }

    #[test]
    fn a_claim_says_what_it_was_made_of() {
        let claim =
            Claim::number("fig10", "Sec. V", "speed", "rad/s", "14 ± 5", 14.25).note("one").note("two");
        assert_eq!([claim.id(), claim.place(), claim.quantity()], ["fig10", "Sec. V", "speed"]);
        assert_eq!([claim.unit(), claim.printed_text(), claim.remarks()], ["rad/s", "14 ± 5", "one; two"]);
        assert_eq!((claim.computed(), claim.tolerance()), (&Computed::Number(14.25), Some(0.5)));
        assert_eq!(claim.source(), &Source::ThisWork);
        assert_eq!(
            [Verdict::Reproduced, Verdict::Differs, Verdict::NotComputable].map(Verdict::name),
            ["reproduced", "differs", "not-computable"]
        );
    }

    /// A tolerance belongs to two numbers: what is not compared has none.
    #[test]
    fn what_compares_no_numbers_has_no_tolerance() {
        let label = Claim::label("fig04", "text", "optimum", "θ = 0", "θ = 1").within(2.0);
        assert_eq!((label.tolerance(), label.verdict()), (None, Verdict::Differs));
        let unread = Claim::number("fig06", "caption", "ratio", "", "about five", 5.0).within(2.0);
        assert_eq!((unread.tolerance(), unread.verdict()), (None, Verdict::Differs));
        let infinite = Claim::number("fig06", "caption", "ratio", "", "5", f64::INFINITY).within(2.0);
        assert_eq!((infinite.tolerance(), infinite.verdict()), (Some(0.5), Verdict::Differs));
    }

    /// Half a unit of the last digit, where the product with the unit may be rounded, and no more.
    #[test]
    fn half_a_unit_of_the_last_digit_is_agreement() {
        let verdict =
            |printed: &str, value| Claim::number("fig06", "text", "Γ", "", printed, value).verdict();
        for sign in ["", "-"] {
            let at = |value: f64| if sign.is_empty() { value } else { -value };
            assert_eq!(verdict(&format!("{sign}0.7"), at(0.75)), Verdict::Reproduced);
            assert_eq!(verdict(&format!("{sign}0.7"), at(0.65)), Verdict::Reproduced);
            assert_eq!(verdict(&format!("{sign}0.7"), at(0.750_001)), Verdict::Differs);
            assert_eq!(verdict(&format!("{sign}0.7"), at(0.649_999)), Verdict::Differs);
        }
        let tolerance = |printed: &str| Claim::number("fig06", "text", "Γ", "", printed, 1.0).tolerance();
        assert!(tolerance("0.323").is_some_and(|half_unit| (half_unit - 5e-4).abs() < 1e-12));
    }

    #[test]
    fn the_verdict_is_computed() {
        let claim = |value| {
            Claim::number("fig06", "caption", "Γ at the first doubling", "", "0.486", value).verdict()
        };
        assert_eq!(claim(0.486_003), Verdict::Reproduced);
        assert_eq!(claim(0.4855), Verdict::Reproduced);
        assert_eq!(claim(0.485_49), Verdict::Differs);
        assert_eq!(claim(f64::NAN), Verdict::Differs);
        assert_eq!(claim(f64::INFINITY), Verdict::Differs);
        let wide =
            Claim::number("table2", "text", "speed", "rad/s", "14", 16.0).within(5.0).note("printed ± 5");
        assert_eq!(wide.verdict(), Verdict::Reproduced);
        let not_a_number = Claim::number("table2", "text", "speed", "rad/s", "14", f64::NAN).within(5.0);
        assert_eq!(not_a_number.verdict(), Verdict::Differs);
        assert_eq!(Claim::label("fig04", "text", "optimum", "θ = 0", "θ = 0").verdict(), Verdict::Reproduced);
        assert_eq!(
            Claim::statement("fig04", "text", "even in θ", false, "3 of 4").verdict(),
            Verdict::Differs
        );
    }

    #[test]
    fn the_json_has_exactly_the_agreed_keys() {
        let claim = Claim::number("fig06", "Fig. 6 caption", "ratio", "", "4.891", f64::NAN);
        let json = serde_json::to_value(&claim).expect("plain data");
        let keys: Vec<_> = json.as_object().expect("an object").keys().cloned().collect();
        let mut agreed =
            ["id", "place", "quantity", "unit", "printed", "computed", "tolerance", "verdict", "note"];
        agreed.sort_unstable();
        assert_eq!(keys, agreed);
        assert_eq!(json["computed"], "NaN");
        assert_eq!(json["verdict"], "differs");
        let claim = Claim::not_computable("fig09", "text", "μ", "", "0.1", "no measured points in the text");
        let json = serde_json::to_value(&claim).expect("plain data");
        assert_eq!(json["verdict"], "not-computable");
        assert!(json["computed"].is_null());
    }
}
