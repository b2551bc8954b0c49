//! A number or statement printed in the paper, compared with ours.
//!
//! The verdict is the result of a comparison; nothing in this crate can set it by hand. A printed number is
//! compared at the precision it is printed with: half a unit of its last digit, read off the printed text.

use serde::{Serialize, Serializer};

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
}

impl Claim {
    /// A printed number, compared within half a unit of its last printed digit.
    ///
    /// `printed` is the text exactly as printed: `"0.486"`, `"14 ± 5"` (compared with 14), `"0.323π"`,
    /// `"11.6 %"`, `"10⁻⁹"`, `"1.5 × 10⁻⁶"`, `"1e-6"`, `"≈ 22"`. `computed` is in the unit of the printed number;
    /// a printed multiple of π is compared as the product. A computed NaN or infinity differs from every number.
    ///
    /// A printed text that is not a number gives a claim that differs and says so in its note.
    pub fn number(
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
            printed,
        };
        if read.is_none() {
            claim.note = "the printed text could not be read as a number".to_owned();
        }
        claim.compare();
        claim
    }

    /// A printed label (a name, an ordering, a region) that must equal the computed one.
    pub fn label(
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
        }
    }

    /// A statement in words. `quantity` is the statement, `holds` whether our data agree, `evidence` the numbers
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
        }
    }

    /// A printed number or statement that cannot be computed from the paper's text, and why.
    pub fn not_computable(
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
    pub fn printed(&self) -> &str {
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

/// A printed number: its value, and half a unit of its last digit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PrintedNumber {
    pub(crate) value: f64,
    pub(crate) half_unit: f64,
}

impl PrintedNumber {
    /// Reads a number as the paper prints it; `None` when the text is none.
    pub(crate) fn read(text: &str) -> Option<Self> {
        let text = plain_ascii(text);
        let text = text.split("+-").next()?.trim();
        let text = text.trim_start_matches(['~', ' ']).trim_end_matches(['%', ' ']);
        let (text, factor) = match text.strip_suffix("pi") {
            Some(rest) => (rest.trim_end().trim_end_matches('*').trim_end(), std::f64::consts::PI),
            None => (text, 1.0),
        };
        let (mantissa, exponent) = split_exponent(text)?;
        // A comma or a thin space groups digits: "70,000".
        let digits: String = mantissa.chars().filter(|c| !matches!(c, ',' | ' ')).collect();
        let decimals = match digits.split_once('.') {
            Some((_, fraction)) => i32::try_from(fraction.len()).ok()?,
            None => 0,
        };
        if !digits.bytes().any(|b| b.is_ascii_digit()) {
            return None;
        }
        // Parsing the decimal text rounds once; multiplying by a power of ten would round twice.
        let value: f64 = format!("{digits}e{exponent}").parse().ok()?;
        let half_unit: f64 = format!("5e{}", exponent - decimals - 1).parse().ok()?;
        Some(Self { value: value * factor, half_unit: half_unit * factor })
    }
}

/// "2.5*10^-6", "10^-6", "2.5e-6", "2.5" as mantissa and exponent.
fn split_exponent(text: &str) -> Option<(&str, i32)> {
    let (mantissa, exponent) = if let Some((mantissa, exponent)) = text.split_once("10^") {
        let mantissa = mantissa.trim_end().trim_end_matches('*').trim_end();
        let mantissa = match mantissa {
            "" => "1",
            "-" => "-1",
            other => other,
        };
        (mantissa, exponent.trim_start_matches('{').trim_end_matches('}'))
    } else if let Some((mantissa, exponent)) = text.split_once(['e', 'E']) {
        (mantissa, exponent)
    } else {
        (text, "0")
    };
    Some((mantissa, exponent.trim().trim_start_matches('+').parse().ok()?))
}

/// Unicode signs of printed numbers in ASCII: `−` to `-`, `×` to `*`, `±` to `+-`, `π` to `pi`, `10⁻⁹` to `10^-9`.
fn plain_ascii(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut raised = false;
    for c in text.trim().chars() {
        let superscript = match c {
            '⁻' => Some('-'),
            '⁰' => Some('0'),
            '¹' => Some('1'),
            '²' => Some('2'),
            '³' => Some('3'),
            '⁴'..='⁹' => char::from_u32(u32::from('4') + (u32::from(c) - u32::from('⁴'))),
            _ => None,
        };
        if let Some(digit) = superscript {
            if !raised {
                out.push('^');
            }
            raised = true;
            out.push(digit);
            continue;
        }
        raised = false;
        match c {
            '−' | '–' => out.push('-'),
            '×' | '·' => out.push('*'),
            '±' => out.push_str("+-"),
            'π' => out.push_str("pi"),
            '≈' | '∼' => out.push('~'),
            '\u{2009}' | '\u{a0}' | '\u{202f}' => out.push(' '),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn read(text: &str) -> (f64, f64) {
        let number = PrintedNumber::read(text).unwrap_or_else(|| panic!("{text} is a number"));
        (number.value, number.half_unit)
    }

    #[test]
    fn the_tolerance_is_half_a_unit_of_the_last_printed_digit() {
        assert_eq!(read("0.486"), (0.486, 0.0005));
        assert_eq!(read("14"), (14.0, 0.5));
        assert_eq!(read("14 ± 5"), (14.0, 0.5));
        assert_eq!(read("14 ± 1.5"), (14.0, 0.5));
        assert_eq!(read("1e-6"), (1e-6, 0.5e-6));
        assert_eq!(read("10⁻⁹"), (1e-9, 0.5e-9));
        assert_eq!(read("10^{-8}"), (1e-8, 0.5e-8));
        assert_eq!(read("1.5 × 10⁻⁶"), (1.5e-6, 0.05e-6));
        assert_eq!(read("−0.40"), (-0.4, 0.005));
        assert_eq!(read("0.323π"), (0.323 * PI, 0.0005 * PI));
        assert_eq!(read("11.6 %"), (11.6, 0.05));
        assert_eq!(read("≈ 22"), (22.0, 0.5));
        assert_eq!(read("70,000"), (70_000.0, 0.5));
        assert_eq!(read("4.750"), (4.75, 0.0005));
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for text in ["", "π", "about ten", "1.2.3", "10^x", "-", "e5"] {
            assert!(PrintedNumber::read(text).is_none(), "{text}");
        }
        let claim = Claim::number("fig06", "caption", "ratio", "", "about five", 5.0);
        assert_eq!(claim.verdict(), Verdict::Differs);
        assert!(claim.remarks().contains("could not be read"));
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
