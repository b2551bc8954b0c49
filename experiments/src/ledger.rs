//! Every number and every testable statement that the paper prints, read from `data/paper`.
//!
//! An entry is named `file.name`. It says where it is printed, what it is, and which figure or table answers it. The
//! claim that answers it takes all this from here ([`Claim::printed`], [`Claim::printed_statement`]), and so do the
//! experiments that need a printed number as an input ([`crate::paper`]).

use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Arc, OnceLock};

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::claim::{Claim, Class, Computed, Source, Verdict};
use crate::printed::PrintedNumber;

/// One printed number or statement.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PrintedEntry {
    /// `file.name`.
    pub key: String,
    /// The figure or table whose experiment answers it: `fig01` ... `fig14`, `table1` ... `table3`.
    pub figure: String,
    /// Where it is printed: "Fig. 6 caption", "Sec. IV B".
    pub place: String,
    /// What the number is; the statement itself where there is no number.
    pub quantity: String,
    /// The unit of the number; empty for a pure number.
    pub unit: String,
    /// The number exactly as printed.
    pub printed: Option<String>,
    /// Why nothing can be computed for it.
    pub reason: Option<String>,
    /// What it is: the paper's own, an input, or true by construction.
    pub class: Class,
}

/// Why an entry cannot be used.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LedgerError {
    /// A file does not have the form of this version.
    #[error("data/paper/{file} does not have the form of this version: {cause}")]
    File {
        /// The file.
        file: &'static str,
        /// What the parser reported.
        cause: Arc<serde_json::Error>,
    },
    /// There is no such entry.
    #[error("data/paper has no entry \"{key}\"")]
    Unknown {
        /// What was asked for.
        key: String,
    },
    /// The entry is no number of the kind asked for.
    #[error("the printed text \"{printed}\" of \"{key}\" is no {wanted}")]
    NoNumber {
        /// The entry.
        key: String,
        /// Its printed text; empty for a statement.
        printed: String,
        /// What was asked for.
        wanted: &'static str,
    },
}

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        const FILES: &[(&str, &str, &str)] = &[$((
            $name,
            concat!($name, ".json"),
            include_str!(concat!("../../data/paper/", $name, ".json")),
        )),*];
    };
}

// In the order of the paper.
files!["section1", "section2", "table1", "section3", "table2", "section4", "section5", "table3", "appendix",];

/// What a file of `data/paper` holds.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "place")]
    _place: String,
    #[serde(rename = "title")]
    _title: String,
    values: InOrder,
}

/// The members of an object in the order of the file.
struct InOrder(Vec<(String, Stored)>);

impl<'de> Deserialize<'de> for InOrder {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Members;
        impl<'de> Visitor<'de> for Members {
            type Value = InOrder;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("an object of entries")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<InOrder, A::Error> {
                let mut members: Vec<(String, Stored)> = Vec::new();
                while let Some((name, stored)) = map.next_entry::<String, Stored>()? {
                    if members.iter().any(|(known, _)| *known == name) {
                        return Err(serde::de::Error::custom(format!("\"{name}\" stands twice")));
                    }
                    members.push((name, stored));
                }
                Ok(InOrder(members))
            }
        }
        deserializer.deserialize_map(Members)
    }
}

/// An entry as it is stored.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Stored {
    figure: String,
    place: String,
    quantity: String,
    unit: String,
    printed: Option<String>,
    reason: Option<String>,
    #[serde(default)]
    class: Class,
}

fn read(name: &str, file: &'static str, text: &str) -> Result<Vec<PrintedEntry>, LedgerError> {
    let content: File =
        serde_json::from_str(text).map_err(|cause| LedgerError::File { file, cause: Arc::new(cause) })?;
    let entries = content.values.0.into_iter().map(|(entry, stored)| {
        let Stored { figure, place, quantity, unit, printed, reason, class } = stored;
        PrintedEntry { key: format!("{name}.{entry}"), figure, place, quantity, unit, printed, reason, class }
    });
    Ok(entries.collect())
}

/// All entries, file by file.
///
/// # Errors
///
/// When a file does not have the form of this version.
pub fn entries() -> Result<&'static [PrintedEntry], LedgerError> {
    static ENTRIES: OnceLock<Result<Vec<PrintedEntry>, LedgerError>> = OnceLock::new();
    let read_all = || {
        let files = FILES.iter().map(|(name, file, text)| read(name, file, text));
        Ok(files.collect::<Result<Vec<_>, _>>()?.concat())
    };
    ENTRIES.get_or_init(read_all).as_deref().map_err(Clone::clone)
}

/// The entry called `key`.
///
/// # Errors
///
/// When there is none.
pub fn find(key: &str) -> Result<&'static PrintedEntry, LedgerError> {
    let found = entries()?.iter().find(|entry| entry.key == key);
    found.ok_or_else(|| LedgerError::Unknown { key: key.to_owned() })
}

/// The printed number called `key`, times a power of ten.
///
/// # Errors
///
/// When there is none.
pub fn number(key: &str, power: i32) -> Result<PrintedNumber, LedgerError> {
    let printed = text(key)?;
    PrintedNumber::read_shifted(printed, power).ok_or_else(|| LedgerError::NoNumber {
        key: key.to_owned(),
        printed: printed.to_owned(),
        wanted: "number",
    })
}

/// The text of the entry `key` exactly as printed.
///
/// # Errors
///
/// When there is none.
pub fn text(key: &str) -> Result<&'static str, LedgerError> {
    find(key)?.printed.as_deref().ok_or_else(|| LedgerError::NoNumber {
        key: key.to_owned(),
        printed: String::new(),
        wanted: "printed text",
    })
}

/// The claims of a figure or table that nothing can be computed for.
pub fn not_computable(figure: &str) -> Vec<Claim> {
    let of_figure = entries().unwrap_or_default().iter().filter(|entry| entry.figure == figure);
    of_figure
        .filter_map(|entry| entry.reason.as_deref().map(|reason| Claim::of_reason(entry, reason)))
        .collect()
}

/// What is wrong with the claims of a figure or table: entries that are not answered by exactly one claim, claims that
/// answer what is not theirs, numbers that come from no entry, claims without data, and claims that count for the paper though
/// they do not answer an entry of its own.
pub fn faults(figure: &str, claims: &[Claim]) -> Vec<String> {
    let mut faults = Vec::new();
    let entries = match entries() {
        Ok(entries) => entries,
        Err(error) => return vec![error.to_string()],
    };
    let own: BTreeSet<&str> =
        entries.iter().filter(|entry| entry.figure == figure).map(|entry| entry.key.as_str()).collect();
    for key in &own {
        let answers = claims.iter().filter(|claim| matches!(claim.source(), Source::Entry(of) if of == key));
        let count = answers.count();
        if count != 1 {
            faults.push(format!("{key} is answered by {count} claims"));
        }
    }
    for claim in claims {
        if claim.lacks_data() {
            faults.push(format!("\"{}\" has no data to be judged by", claim.quantity()));
        }
        let of_paper = match claim.source() {
            Source::Entry(key) => find(key).is_ok_and(|entry| entry.class == Class::Paper),
            _ => false,
        };
        if claim.class() == Class::Paper && !of_paper {
            faults.push(format!("\"{}\" counts for the paper and is not its own", claim.quantity()));
        }
        if claim.verdict() == Verdict::Differs && claim.remarks().is_empty() {
            faults.push(format!("\"{}\" differs and no reason is given", claim.quantity()));
        }
        match claim.source() {
            Source::Entry(key) if !own.contains(key.as_str()) => {
                faults.push(format!("{key} is no entry of {figure}"));
            }
            Source::Reading(key) if find(key).is_err() => faults.push(format!("{key} is no entry")),
            Source::ThisWork
                if !matches!(claim.computed(), Computed::Boolean(_)) && claim.share().is_none() =>
            {
                faults.push(format!("\"{}\" comes from no entry", claim.quantity()));
            }
            _ => {}
        }
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> &'static [PrintedEntry] {
        entries().expect("all files parse")
    }

    #[test]
    fn every_entry_names_a_figure_a_place_and_a_quantity() {
        let legal: Vec<String> =
            (1..=14).map(|n| format!("fig{n:02}")).chain((1..=3).map(|n| format!("table{n}"))).collect();
        for entry in all() {
            assert!(legal.contains(&entry.figure), "{}: {}", entry.key, entry.figure);
            assert!(!entry.place.is_empty() && !entry.quantity.is_empty(), "{}", entry.key);
            assert!(entry.reason.as_deref() != Some(""), "{}", entry.key);
        }
        for figure in legal {
            assert!(all().iter().any(|entry| entry.figure == figure), "{figure} has no entry");
        }
    }

    /// What is fitted or found is a matter of a claim, not of what is printed.
    #[test]
    fn an_entry_is_of_the_paper_an_input_or_an_identity() {
        for entry in all() {
            let legal = [Class::Paper, Class::Input, Class::Identity].contains(&entry.class);
            assert!(legal, "{}: {:?}", entry.key, entry.class);
            assert!(entry.class != Class::Identity || entry.reason.is_none(), "{}", entry.key);
        }
    }

    #[test]
    fn a_name_that_stands_twice_is_refused_and_the_order_is_that_of_the_file() {
        let entry = r#"{"figure": "fig01", "place": "p", "quantity": "q", "unit": ""}"#;
        let file = |second| {
            format!(r#"{{"place": "", "title": "", "values": {{"b": {entry}, "{second}": {entry}}}}}"#)
        };
        let read = |second| super::read("section9", "section9.json", &file(second));
        let keys: Vec<_> = read("a").expect("two names").into_iter().map(|entry| entry.key).collect();
        assert_eq!(keys, ["section9.b", "section9.a"]);
        assert!(read("b").expect_err("twice").to_string().contains("\"b\" stands twice"));
    }

    #[test]
    fn every_printed_text_is_a_number_and_no_statement_has_a_unit() {
        for entry in all() {
            match &entry.printed {
                Some(text) => assert!(PrintedNumber::read(text).is_some(), "{}: {text}", entry.key),
                None => assert!(entry.unit.is_empty(), "{}", entry.key),
            }
        }
    }

    #[test]
    fn the_core_cuts_chattering_where_the_paper_does() {
        use bouncing_disk::PAPER_CUT;
        let value = |key| number(key, 0).expect("a number").value;
        assert_eq!(value("section4.cut_speed").to_bits(), PAPER_CUT.smallest_speed().to_bits());
        assert_eq!(value("section4.cut_duration").to_bits(), PAPER_CUT.short_flight().to_bits());
        assert_eq!(value("section4.cut_flights").to_bits(), f64::from(PAPER_CUT.short_flights()).to_bits());
    }

    #[test]
    fn claims_take_the_printed_side_from_the_entry() {
        let claim = Claim::printed("section4.doubling_1", 0.486_003);
        assert_eq!((claim.id(), claim.place(), claim.printed_text()), ("fig06", "Fig. 6 caption", "0.486"));
        assert_eq!(claim.verdict(), Verdict::Reproduced);
        let claim = Claim::printed_statement("section4.single_tosses_end", false, "0.36");
        assert_eq!((claim.printed_text(), claim.verdict()), ("true", Verdict::Differs));
        let claim = Claim::printed_uncertainty("table2", "section3.predicted_airborne_speed", "all", 5.2);
        assert_eq!((claim.id(), claim.printed_text(), claim.verdict()), ("table2", "5", Verdict::Reproduced));
        assert!(matches!(claim.source(), Source::Reading(_)));
    }

    #[test]
    fn an_unknown_key_differs_and_says_so() {
        for claim in [
            Claim::printed("section4.no_such_number", 1.0),
            Claim::printed_label("section4.no_such_label", ""),
            Claim::printed_statement("section4.no_such_statement", true, ""),
            Claim::printed("section4.three_branches", 3.0),
        ] {
            assert_eq!(claim.verdict(), Verdict::Differs, "{claim:?}");
            assert!(!claim.remarks().is_empty(), "{claim:?}");
        }
    }

    #[test]
    fn faults_name_what_is_missing_double_foreign_or_from_nowhere() {
        let mut claims = not_computable("table1");
        let missing = faults("table1", &claims).len();
        claims.push(Claim::printed("table1.friction", 0.577));
        assert_eq!(faults("table1", &claims).len(), missing - 1);
        claims.push(Claim::printed("table1.friction", 0.577));
        claims.push(Claim::printed("section4.merging", 0.561));
        claims.push(Claim::number("table1", "", "an own number", "", "1", 1.0));
        let faults = faults("table1", &claims).join("; ");
        for part in ["friction is answered by 2", "merging is no entry of table1", "an own number"] {
            assert!(faults.contains(part), "{faults}");
        }
    }

    #[test]
    fn a_file_of_another_form_is_named() {
        let text = r#"{"place": "", "title": "", "values": {"a": {"figure": "fig01", "plaice": ""}}}"#;
        let error = read("section9", "section9.json", text).expect_err("misspelt");
        assert!(error.to_string().contains("section9.json") && error.to_string().contains("plaice"));
    }
}
