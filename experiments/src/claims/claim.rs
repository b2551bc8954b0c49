//! A number or statement printed in the paper, compared with ours.
//!
//! The verdict is the result of a comparison; nothing in this crate can set it by hand. Printed numbers come
//! from the [catalogue]; a printed number is compared at the precision it is printed with: half a unit of its
//! last digit, read off the printed text. The rule of its [`Kind`] and the [`Cases`] in which it holds decide
//! a statement.
//!
//! Only statements of the paper itself count for or against it: the [`Class`] of a claim separates them from
//! inputs, from what was fitted, from what is true by construction, and from what this work adds.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::panic::Location;

use serde::{Deserialize, Serialize};

use super::catalogue::{self, Class, PrintedEntry};
use super::judging::{Cases, Kind, LARGEST_ACCEPTED, LINE_WIDTH, Verdict};
use super::printed::PrintedNumber;

/// Our value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Computed {
    /// Whether a statement holds.
    Boolean(bool),
    /// A finite number, in the unit of the claim.
    Number(f64),
    /// A label, or the name of a number that is not finite.
    Text(String),
    /// Nothing could be computed.
    Nothing,
}

/// One printed number or statement and its comparison with ours; one object of `claims.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[must_use]
pub struct Claim {
    /// The figure or table.
    pub(crate) id: String,
    /// Where in the paper: "Fig. 6 caption", "Sec. IV B".
    pub(crate) place: String,
    /// The compared quantity.
    pub(crate) quantity: String,
    /// The unit of the printed number; empty for a pure number.
    pub(crate) unit: String,
    /// The text as printed.
    pub(crate) printed: String,
    pub(crate) computed: Computed,
    /// The largest difference that counts as agreement.
    pub(crate) tolerance: Option<f64>,
    pub(crate) verdict: Verdict,
    pub(crate) class: Class,
    /// By which rule it is judged; `None` for what is not the paper's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) kind: Option<Kind>,
    /// Why it differs, in few words: rows with the same cause differ for one reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) cause: Option<Cow<'static, str>>,
    /// The share of the inputs that print alike for which it holds; `None` where it does not depend on
    /// unprinted digits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) share: Option<f64>,
    /// The second verdict on a statement about a motor.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) single_orbits: Option<SingleOrbits>,
    pub(crate) note: String,
    /// The entry of the [catalogue] that it answers; `None` for a check of this work, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) key: Option<String>,
    /// File and line of the code that states it.
    pub(crate) code: String,
}

/// The verdict of single orbits that nothing perturbs, on a statement that is judged by the mean of an
/// ensemble.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SingleOrbits {
    /// The verdict.
    pub verdict: Verdict,
    /// The inputs over which it is taken.
    pub cases: Cases,
}

impl Claim {
    /// The answer to the entry `key` of the [catalogue], a printed number: `computed`, in the unit of the
    /// entry, compared within half a unit of the last printed digit. A computed NaN or infinity differs from
    /// every number.
    ///
    /// An unknown key, or an entry that is no number, gives a claim that differs and says so in its note.
    #[track_caller]
    pub fn printed(key: &str, computed: f64) -> Self {
        Self::of_entry(key, |entry| {
            let printed = entry.printed.as_deref().unwrap_or_default();
            Self::number([&entry.figure, &entry.place, &entry.quantity, &entry.unit], printed, computed)
        })
    }

    /// The answer to the entry `key`, a statement in words: in which cases our data agree, and the numbers
    /// that show it. The rule of its kind decides. The entry may name a number, as in "for Γ < 0.52 ...".
    ///
    /// `None` says that there are no data to judge it by ([`all`], [`any`] of nothing), which is a
    /// [fault](Self::lacks_data).
    #[track_caller]
    pub fn printed_statement(key: &str, cases: impl Into<Cases>, evidence: impl Into<String>) -> Self {
        let cases = cases.into();
        Self::of_entry(key, |entry| {
            // A statement that is true by construction has no exception.
            let kind = entry.kind.unwrap_or(Kind::Always);
            let verdict = kind.verdict(cases);
            let holds = (cases.tried > 0).then_some(verdict == Verdict::Reproduced);
            let claim = Self::statement(&entry.figure, &entry.place, &entry.quantity, holds, evidence);
            let claim = Self { kind: entry.kind, ..claim };
            if kind == Kind::Orbit { claim.judged_over(cases) } else { Self { verdict, ..claim } }
        })
    }

    /// Judges a number, or a statement of this work, over inputs that print alike or single orbits
    /// ([`Cases::sampled`]). Of a number the computed value stays that of the printed inputs.
    pub fn judged_over(mut self, cases: Cases) -> Self {
        if cases.tried == 0 {
            return self;
        }
        if !matches!(self.computed, Computed::Number(_)) {
            let what = if self.kind == Some(Kind::Orbit) { "orbits" } else { "inputs" };
            self.computed = Computed::Text(format!("holds for {} of {} {what}", cases.holding, cases.tried));
        }
        self.share = cases.share();
        self.verdict = cases.sampled();
        self.close_to_a_bound(cases)
    }

    fn close_to_a_bound(self, cases: Cases) -> Self {
        if !cases.is_close() {
            return self;
        }
        let Cases { holding, tried } = cases;
        self.note(format!("{holding} of {tried} is within two standard errors of a bound"))
    }

    /// The second verdict on a statement about a motor: that of single orbits.
    pub fn single_orbits(mut self, cases: Cases) -> Self {
        self.share = cases.share();
        self.single_orbits = Some(SingleOrbits { verdict: cases.sampled(), cases });
        self.close_to_a_bound(cases)
    }

    /// Says that the verdict hangs on a word or a range that the paper does not define: `by_definition` are
    /// those under the definitions that were tried. Where some reproduce the claim and others do not, it
    /// cannot be computed; where none does, the kindest counts.
    pub fn by_definition(mut self, by_definition: &[Verdict]) -> Self {
        if by_definition.iter().all(|verdict| *verdict == self.verdict) {
            return self;
        }
        let is_tried = |verdict| self.verdict == verdict || by_definition.contains(&verdict);
        self.verdict = match [Verdict::Reproduced, Verdict::DependsOnUnprintedDigits].map(is_tried) {
            [true, _] => Verdict::NotComputable,
            [false, true] => Verdict::DependsOnUnprintedDigits,
            [false, false] => Verdict::Differs,
        };
        let words = if self.verdict == Verdict::NotComputable {
            "undefined in the paper, and definitions tried differ"
        } else {
            "undefined in the paper; the most favourable definition counts"
        };
        self.note(words)
    }

    /// [`Self::by_definition`] of the shares for low periods of at most so many flights: where the kindest definition counts,
    /// the claim shows it with its share.
    pub fn by_shares(self, by_flights: &[(usize, Cases)]) -> Self {
        let (own, is_decided) = (self.share, matches!(self.computed, Computed::Text(_)));
        let verdicts: Vec<Verdict> = by_flights.iter().map(|(_, cases)| cases.sampled()).collect();
        let claim = self.by_definition(&verdicts);
        let kindest = by_flights.iter().filter(|(_, cases)| cases.share() > own);
        let kindest = kindest
            .max_by(|one, other| one.1.share().partial_cmp(&other.1.share()).unwrap_or(Ordering::Equal));
        match kindest {
            Some((flights, cases)) if is_decided && claim.verdict != Verdict::NotComputable => {
                let Cases { holding, tried } = cases;
                let text = format!("holds for {holding} of {tried} orbits with at most {flights} flights");
                Self { computed: Computed::Text(text), share: cases.share(), ..claim }
            }
            _ => claim,
        }
    }

    /// A place that is read off a drawn curve: `lower` is by how much the curve there is lower than its
    /// maximum, as a share of what it spans, `accepted` the share of the drawn range, by its length, or of the drawn
    /// curves that would agree.
    pub fn at_printed_place(mut self, lower: f64, accepted: f64) -> Self {
        self.tolerance = None;
        self.verdict = match lower <= LINE_WIDTH {
            true if accepted > LARGEST_ACCEPTED => Verdict::NotComputable,
            true => Verdict::Reproduced,
            false => Verdict::Differs,
        };
        self.note(format!("at the printed place {:.2} % of the span below the maximum", 100.0 * lower))
    }

    /// Names the cause for which it differs, if it does.
    pub fn cause(mut self, cause: &'static str) -> Self {
        self.cause = (self.verdict == Verdict::Differs).then_some(Cow::Borrowed(cause));
        self
    }

    /// Says that a parameter of ours was chosen so that this number comes out, and which: it does not count
    /// for the paper.
    pub fn fitted(self, parameter: impl AsRef<str>) -> Self {
        let note = format!("fitted: {}", parameter.as_ref());
        Self { class: Class::Fitted, ..self }.note(note)
    }

    #[track_caller]
    fn of_entry(key: &str, make: impl FnOnce(&PrintedEntry) -> Self) -> Self {
        let claim = match catalogue::find(key) {
            Ok(entry) => Self { class: entry.class, kind: entry.kind, ..make(entry) },
            // The key at least says which file was meant.
            Err(error) => Self::statement("", key, "", false, error.to_string()),
        };
        // A closure has no caller: not where the claim was made, but where it was asked for.
        Self { key: Some(key.to_owned()), code: caller(), ..claim }
    }

    /// The claim of an entry that nothing can be computed for, for the reason given there.
    pub(crate) fn of_reason(entry: &PrintedEntry, reason: &str) -> Self {
        let names = [&entry.figure, &entry.place, &entry.quantity, &entry.unit].map(String::as_str);
        let printed = entry.printed.as_deref().unwrap_or("true");
        Self {
            key: Some(entry.key.clone()),
            class: entry.class,
            note: reason.to_owned(),
            code: String::new(),
            ..Self::without_value(names, printed)
        }
    }

    /// Nothing computed yet; the names are those of figure, place, quantity and unit.
    #[track_caller]
    fn without_value([id, place, quantity, unit]: [&str; 4], printed: &str) -> Self {
        Self {
            id: id.to_owned(),
            place: place.to_owned(),
            quantity: quantity.to_owned(),
            unit: unit.to_owned(),
            printed: printed.to_owned(),
            computed: Computed::Nothing,
            tolerance: None,
            verdict: Verdict::NotComputable,
            class: Class::ThisWork,
            kind: None,
            cause: None,
            share: None,
            single_orbits: None,
            note: String::new(),
            key: None,
            code: caller(),
        }
    }

    /// A printed number, compared within half a unit of its last printed digit. In a figure it comes from the
    /// catalogue: [`printed`](Self::printed).
    ///
    /// `printed` is the text exactly as printed: `"0.486"`, `"14 ± 5"` (compared with 14), `"0.323π"`, `"11.6
    /// %"`, `"10⁻⁹"`, `"1.5 × 10⁻⁶"`, `"1e-6"`, `"≈ 22"`. `computed` is in the unit of the printed number; a
    /// printed multiple of π is compared as the product. A computed NaN or infinity differs from every
    /// number.
    ///
    /// A printed text that is not a number gives a claim that differs and says so in its note.
    #[track_caller]
    pub(crate) fn number(names: [&str; 4], printed: &str, computed: f64) -> Self {
        let claim = Self {
            computed: match computed {
                number if number.is_finite() => Computed::Number(number),
                number => Computed::Text(number.to_string()),
            },
            verdict: Verdict::Differs,
            ..Self::without_value(names, printed)
        };
        let Some(read) = PrintedNumber::read(printed) else {
            return claim.note("the printed text could not be read as a number");
        };
        // A value exactly between two printed ones may round either way; the product of the decimal digits
        // and the unit is itself rounded, hence the small widening.
        let reproduced = (computed - read.value).abs() <= read.half_unit * (1.0 + 1e-9);
        let verdict = if reproduced { Verdict::Reproduced } else { Verdict::Differs };
        Self { verdict, tolerance: Some(read.half_unit), ..claim }
    }

    /// A statement in words that is not printed: a check of this work, or a remark that a reader of the paper
    /// will want. A printed statement comes from the catalogue:
    /// [`printed_statement`](Self::printed_statement).
    ///
    /// `quantity` is the statement, `holds` whether our data agree (`None`: there are none), `evidence` the
    /// numbers that show it.
    #[track_caller]
    pub fn statement(
        id: &str,
        place: &str,
        quantity: &str,
        holds: impl Into<Option<bool>>,
        evidence: impl Into<String>,
    ) -> Self {
        let holds = holds.into();
        Self {
            computed: holds.map_or(Computed::Nothing, Computed::Boolean),
            verdict: match holds {
                Some(true) => Verdict::Reproduced,
                Some(false) => Verdict::Differs,
                None => Verdict::NotComputable,
            },
            note: evidence.into(),
            ..Self::without_value([id, place, quantity, ""], "true")
        }
    }

    /// Evidence and remarks: the numbers that decide.
    pub fn evidence(&self) -> &str {
        &self.note
    }

    /// Adds a remark. Several remarks are joined by "; ".
    pub fn note(mut self, note: impl AsRef<str>) -> Self {
        if !self.note.is_empty() {
            self.note.push_str("; ");
        }
        self.note.push_str(note.as_ref());
        self
    }

    /// Whether it should have been judged by data, but no data exist. Such a claim is no finding but a fault
    /// of the experiment.
    pub fn lacks_data(&self) -> bool {
        let entry = self.key.as_deref().and_then(|key| catalogue::find(key).ok());
        let reasoned = entry.is_some_and(|entry| entry.reason.is_some());
        matches!(self.computed, Computed::Nothing) && !reasoned
    }
}

/// File and line of the code that asks for a claim.
#[track_caller]
fn caller() -> String {
    let place = Location::caller();
    format!("{}:{}", place.file(), place.line())
}

/// Whether a test holds for all of the data; `None` if there are none.
pub fn all<T>(data: impl IntoIterator<Item = T>, mut test: impl FnMut(T) -> bool) -> Option<bool> {
    data.into_iter().map(&mut test).fold(None, |so_far, holds| Some(so_far.unwrap_or(true) && holds))
}

/// Whether a test holds for any of the data; `None` if there are none.
pub fn any<T>(data: impl IntoIterator<Item = T>, mut test: impl FnMut(T) -> bool) -> Option<bool> {
    all(data, |item| !test(item)).map(|none| !none)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kind_of_an_entry_decides() {
        let claim = |key, holding, tried| Claim::printed_statement(key, Cases { holding, tried }, "");
        let orbit = claim("section5.long_period_case", 189, 200);
        assert_eq!((orbit.verdict, orbit.share), (Verdict::DependsOnUnprintedDigits, Some(0.945)));
        assert!(orbit.note.contains("two standard errors"));
        assert_eq!(claim("section4.coexistence", 199, 200).verdict, Verdict::Differs);
        assert_eq!(claim("section4.route_to_chaos", 101, 200).computed, Computed::Boolean(true));
        let motor =
            claim("section5.oscillation_grows", 1, 1).single_orbits(Cases { holding: 10, tried: 200 });
        assert_eq!(motor.verdict, Verdict::Reproduced);
        assert_eq!(motor.single_orbits.map(|single| single.verdict), Some(Verdict::Differs));
        // A number keeps its value, and is not judged by it alone.
        let number =
            Claim::printed("table1.angular_frequency", 14.5).judged_over(Cases { holding: 1, tried: 2 });
        assert_eq!(number.computed, Computed::Number(14.5));
        assert_eq!((number.verdict, number.share), (Verdict::DependsOnUnprintedDigits, Some(0.5)));
    }

    #[test]
    fn a_definition_that_decides_leaves_nothing_to_judge_by() {
        let claim = |holding| {
            Claim::printed_statement("section5.long_period_case", Cases { holding, tried: 200 }, "")
        };
        assert_eq!(claim(200).by_definition(&[Verdict::Reproduced; 4]).verdict, Verdict::Reproduced);
        let undecided = claim(200).by_definition(&[Verdict::Reproduced, Verdict::Differs]);
        assert_eq!(undecided.verdict, Verdict::NotComputable);
        assert!(!undecided.lacks_data() && undecided.note.contains("undefined"));
        let few = Claim::printed_statement("section5.low_period_case", Cases { holding: 0, tried: 200 }, "");
        let kindest = few
            .by_shares(&[(32, Cases { holding: 112, tried: 200 }), (8, Cases { holding: 12, tried: 200 })]);
        assert_eq!((kindest.share, kindest.verdict), (Some(0.56), Verdict::DependsOnUnprintedDigits));
        assert_eq!(
            kindest.computed,
            Computed::Text("holds for 112 of 200 orbits with at most 32 flights".to_owned())
        );
        let never = claim(100).by_definition(&[Verdict::Differs]);
        assert_eq!(never.verdict, Verdict::DependsOnUnprintedDigits);
    }

    #[test]
    fn nothing_is_no_evidence() {
        assert_eq!((all([1, 2], |n| n > 0), all([1, -2], |n| n > 0)), (Some(true), Some(false)));
        assert_eq!((any([-1, 2], |n| n > 0), any([-1, -2], |n| n > 0)), (Some(true), Some(false)));
        assert_eq!((all([0; 0], |_| true), any([0; 0], |_| true)), (None, None));
        let key = "section5.oscillation_grows";
        assert!(Claim::printed_statement(key, None, "no transients").lacks_data());
        assert!(Claim::printed_statement(key, Cases::of([]), "").lacks_data());
        assert!(!Claim::printed_statement(key, false, "").lacks_data());
        let inputs = super::super::answers::not_computable("fig10");
        assert!(!inputs.is_empty() && inputs.iter().all(|claim| !claim.lacks_data()));
        let is_input = inputs.iter().any(|claim| claim.class == Class::Input);
        assert!(is_input, "an input stays one without a value");
    }

    #[test]
    fn only_the_answer_to_an_entry_of_the_paper_counts_for_it() {
        assert_eq!(Claim::printed("section4.doubling_1", 0.486).class, Class::Paper);
        assert_eq!(Claim::statement("fig06", "", "", true, "").class, Class::ThisWork);
        let fitted = Claim::printed("section4.share_at_fig7a", 11.6).fitted("the window");
        assert_eq!((fitted.class, fitted.note.as_str()), (Class::Fitted, "fitted: the window"));
        assert_eq!(Claim::printed_statement("section3.stroke_components", true, "").class, Class::Identity);
    }

    #[test]
    fn half_a_unit_of_the_last_digit_is_agreement() {
        let claim = |printed: &str, value| Claim::number(["fig06", "text", "Γ", ""], printed, value);
        for sign in [1.0, -1.0] {
            let printed = if sign > 0.0 { "0.7" } else { "-0.7" };
            for (value, verdict) in [
                (0.75, Verdict::Reproduced),
                (0.65, Verdict::Reproduced),
                (0.750_001, Verdict::Differs),
                (0.649_999, Verdict::Differs),
            ] {
                assert_eq!(claim(printed, sign * value).verdict, verdict, "{printed} {value}");
            }
        }
        for value in [f64::NAN, f64::INFINITY] {
            assert_eq!(claim("0.486", value).verdict, Verdict::Differs);
        }
        assert!(claim("0.323", 1.0).tolerance.is_some_and(|half_unit| (half_unit - 5e-4).abs() < 1e-12));
        let unread = claim("about five", 5.0);
        assert_eq!((unread.verdict, unread.tolerance), (Verdict::Differs, None));
        assert!(unread.note.contains("could not be read"));
        assert_eq!(claim("5", 5.0).note("one").note("two").note, "one; two");
        assert_eq!(Claim::statement("fig04", "text", "", false, "3 of 4").verdict, Verdict::Differs);
    }

    #[test]
    fn the_json_has_exactly_the_agreed_keys() {
        let claim = Claim::number(["fig06", "Fig. 6 caption", "ratio", ""], "4.891", f64::NAN);
        let json = serde_json::to_value(&claim).expect("plain data");
        let keys: Vec<_> = json.as_object().expect("an object").keys().map(String::as_str).collect();
        let agreed = "class code computed id note place printed quantity tolerance unit verdict";
        assert_eq!(keys.join(" "), agreed);
        assert_eq!((&json["computed"], &json["verdict"]), (&"NaN".into(), &"differs".into()));
        let shared = Claim::statement("fig10", "", "", None, "").judged_over(Cases { holding: 3, tried: 4 });
        assert_eq!(serde_json::to_value(&shared).expect("plain data")["share"], 0.75);
        let claim = &super::super::answers::not_computable("fig09")[0];
        let json = serde_json::to_value(claim).expect("plain data");
        assert!(json["computed"].is_null() && json["verdict"] == "not-computable");
    }
}
