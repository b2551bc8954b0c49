//! Every number and every testable statement that the paper prints, read from `data/paper`.
//!
//! An entry is named `file.name`. It says where it is printed, what it is, and which figure or table answers it. The
//! claim that answers it takes all this from here ([`Claim::printed`], [`Claim::printed_statement`]), and so do the
//! experiments that need a printed number as an input (`paper`).
//!
//! [`Claim::printed`]: super::Claim::printed
//! [`Claim::printed_statement`]: super::Claim::printed_statement

use std::sync::{Arc, OnceLock};

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use super::judging::Kind;
use super::printed::PrintedNumber;

/// The kind of thing that a claim is about. Only [`Paper`](Self::Paper) counts for or against the paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Class {
    /// A number or statement of the paper that a computation can confirm or contradict.
    #[default]
    Paper,
    /// A number of the paper for which a parameter of ours was chosen so that it comes out.
    Fitted,
    /// A parameter, a choice of a picture, a measurement that is put in, a quotation.
    Input,
    /// True by construction: a definition, an equation that the code implements, printed against printed.
    Identity,
    /// A finding that the paper does not have.
    ThisWork,
}

impl Class {
    /// All of them, the paper's first.
    pub const ALL: [Self; 5] = [Self::Paper, Self::Fitted, Self::Input, Self::Identity, Self::ThisWork];

    /// As one reads it.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Fitted => "fitted",
            Self::Input => "input",
            Self::Identity => "identity",
            Self::ThisWork => "this work",
        }
    }
}

/// One printed number or statement.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedEntry {
    /// `file.name`.
    #[serde(skip)]
    pub key: String,
    /// The figure or table whose experiment answers it: `fig01` ... `fig14`, `table1` ... `table3`.
    pub figure: String,
    /// Where it is printed: "Fig. 6 caption", "Sec. IV B".
    pub place: String,
    /// The meaning of the number, or the statement itself if there is no number.
    pub quantity: String,
    /// The unit of the number; empty for a pure number.
    pub unit: String,
    /// The number exactly as printed.
    pub printed: Option<String>,
    /// Why nothing can be computed for it.
    pub reason: Option<String>,
    /// Its class: the paper's own, an input, or true by construction.
    #[serde(default)]
    pub class: Class,
    /// By which rule it is judged, if it is the paper's own and can be computed.
    pub kind: Option<Kind>,
}

/// Why an entry cannot be used.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// A file does not have the form of this version.
    #[error("data/paper/{file} does not have the form of this version: {cause}")]
    File {
        /// The file.
        file: &'static str,
        /// The report of the parser.
        cause: Arc<serde_json::Error>,
    },
    /// There is no such entry.
    #[error("data/paper has no entry \"{key}\"")]
    Unknown {
        /// What was asked for.
        key: String,
    },
    /// The entry is no number of the requested kind.
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
            include_str!(concat!("../../../data/paper/", $name, ".json")),
        )),*];
    };
}

// In the order of the paper.
files!["section1", "section2", "table1", "section3", "table2", "section4", "section5", "table3", "appendix",];

/// The contents of a file of `data/paper`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "place")]
    _place: String,
    #[serde(rename = "title")]
    _title: String,
    /// In the order of the file.
    values: IndexMap<String, PrintedEntry>,
}

fn read(name: &str, file: &'static str, text: &str) -> Result<Vec<PrintedEntry>, CatalogueError> {
    let content: File =
        serde_json::from_str(text).map_err(|cause| CatalogueError::File { file, cause: Arc::new(cause) })?;
    let entries = content.values.into_iter();
    Ok(entries.map(|(entry, own)| PrintedEntry { key: format!("{name}.{entry}"), ..own }).collect())
}

/// All entries, file by file.
pub fn entries() -> Result<&'static [PrintedEntry], CatalogueError> {
    static ENTRIES: OnceLock<Result<Vec<PrintedEntry>, CatalogueError>> = OnceLock::new();
    let read_all = || {
        let files = FILES.iter().map(|(name, file, text)| read(name, file, text));
        Ok(files.collect::<Result<Vec<_>, _>>()?.concat())
    };
    ENTRIES.get_or_init(read_all).as_deref().map_err(Clone::clone)
}

/// The entry called `key`.
pub fn find(key: &str) -> Result<&'static PrintedEntry, CatalogueError> {
    let found = entries()?.iter().find(|entry| entry.key == key);
    found.ok_or_else(|| CatalogueError::Unknown { key: key.to_owned() })
}

/// The printed number called `key`, times a power of ten.
pub fn number(key: &str, power: i32) -> Result<PrintedNumber, CatalogueError> {
    let printed = text(key)?;
    PrintedNumber::read_shifted(printed, power).ok_or_else(|| CatalogueError::NoNumber {
        key: key.to_owned(),
        printed: printed.to_owned(),
        wanted: "number",
    })
}

/// The text of the entry `key` exactly as printed.
pub fn text(key: &str) -> Result<&'static str, CatalogueError> {
    find(key)?.printed.as_deref().ok_or_else(|| CatalogueError::NoNumber {
        key: key.to_owned(),
        printed: String::new(),
        wanted: "printed text",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> &'static [PrintedEntry] {
        entries().expect("all files parse")
    }

    #[test]
    fn every_entry_names_a_figure_a_place_and_a_quantity() {
        let legal: Vec<&str> = crate::registry::all().iter().map(|experiment| experiment.id).collect();
        for entry in all() {
            assert!(legal.contains(&entry.figure.as_str()), "{}: {}", entry.key, entry.figure);
            assert!(!entry.place.is_empty() && !entry.quantity.is_empty(), "{}", entry.key);
            assert!(entry.reason.as_deref() != Some(""), "{}", entry.key);
        }
        let of_paper = (1..=14).map(|n| format!("fig{n:02}")).chain((1..=3).map(|n| format!("table{n}")));
        for figure in of_paper {
            assert!(all().iter().any(|entry| entry.figure == figure), "{figure} has no entry");
        }
    }

    /// Whether a number is fitted or found depends on the claim, not on the printed text.
    #[test]
    fn an_entry_is_of_the_paper_an_input_or_an_identity() {
        for entry in all() {
            let legal = [Class::Paper, Class::Input, Class::Identity].contains(&entry.class);
            assert!(legal, "{}: {:?}", entry.key, entry.class);
            assert!(entry.class != Class::Identity || entry.reason.is_none(), "{}", entry.key);
            let judged = entry.class == Class::Paper && entry.reason.is_none();
            assert_eq!(entry.kind.is_some(), judged, "{}", entry.key);
        }
    }

    /// Of two entries with one name a map keeps the last alone.
    #[test]
    fn no_name_stands_twice_and_the_order_is_that_of_the_files() {
        let quantities = FILES.iter().flat_map(|(_, _, text)| {
            text.lines().filter_map(|line| line.trim().strip_prefix("\"quantity\": "))
        });
        let quantities: Vec<String> = quantities
            .map(|text| serde_json::from_str(text.trim_end_matches(',')).expect("a string"))
            .collect();
        assert!(quantities.iter().eq(all().iter().map(|entry| &entry.quantity)));
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
        use bouncing_disk::motion::PAPER_CUT;
        let value = |key| number(key, 0).expect("a number").value;
        assert_eq!(value("section4.cut_speed").to_bits(), PAPER_CUT.smallest_speed().to_bits());
        assert_eq!(value("section4.cut_duration").to_bits(), PAPER_CUT.short_flight().to_bits());
        assert_eq!(value("section4.cut_flights").to_bits(), f64::from(PAPER_CUT.short_flights()).to_bits());
    }

    #[test]
    fn a_file_of_another_form_is_named() {
        let text = r#"{"place": "", "title": "", "values": {"a": {"figure": "fig01", "plaice": ""}}}"#;
        let error = read("section9", "section9.json", text).expect_err("misspelt");
        assert!(error.to_string().contains("section9.json") && error.to_string().contains("`plaice`"));
    }
}
