//! What others have published, read from `data/literature`.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::experiment::ExperimentError;
use crate::json;
use crate::printed::PrintedNumber;

const FILE: &str = "data/literature/bouncing_ball.json";
const NOT_READ_FILE: &str = "data/literature/not_read.json";

/// A published statement, or several of one place.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Entry {
    pub(super) id: String,
    pub(super) source: String,
    pub(super) address: String,
    pub(super) quotation: String,
    #[serde(rename = "quantity")]
    _quantity: String,
    #[serde(rename = "printed")]
    _printed: serde_json::Value,
    #[serde(rename = "parameters")]
    _parameters: String,
    #[serde(rename = "to_be_computed")]
    _to_be_computed: String,
    inputs: BTreeMap<String, String>,
    pub(super) statements: Vec<Statement>,
}

/// One thing that is compared.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Statement {
    pub(super) name: String,
    pub(super) quantity: String,
    pub(super) printed: Option<String>,
    #[serde(default)]
    inputs: BTreeMap<String, String>,
}

/// What could not be read.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NotRead {
    pub(super) source: String,
    /// What of it was seen.
    pub(super) seen: String,
}

impl Entry {
    /// The statement of this name.
    pub(super) fn statement(&self, name: &str) -> Result<&Statement, ExperimentError> {
        let found = self.statements.iter().find(|statement| statement.name == name);
        found.ok_or_else(|| self.missing(name))
    }

    /// The text of a statement's printed number.
    pub(super) fn printed(&self, name: &str) -> Result<PrintedNumber, ExperimentError> {
        let text = self.statement(name)?.printed.as_deref();
        text.and_then(PrintedNumber::read).ok_or_else(|| self.missing(name))
    }

    /// A number that the computation starts from.
    pub(super) fn input(&self, input: &str) -> Result<f64, ExperimentError> {
        self.read(self.inputs.get(input), input).map(|number| number.value)
    }

    /// A number that belongs to one statement.
    pub(super) fn input_of(&self, name: &str, input: &str) -> Result<PrintedNumber, ExperimentError> {
        self.read(self.statement(name)?.inputs.get(input), input)
    }

    fn read(&self, text: Option<&String>, input: &str) -> Result<PrintedNumber, ExperimentError> {
        text.and_then(|text| PrintedNumber::read(text)).ok_or_else(|| self.missing(input))
    }

    fn missing(&self, name: &str) -> ExperimentError {
        ExperimentError::NoData { quantity: format!("{} {name}", self.id) }
    }
}

/// All published statements, in the order of the file.
pub(super) fn entries() -> Result<Vec<Entry>, ExperimentError> {
    read(FILE, include_str!("../../../../data/literature/bouncing_ball.json"))
}

/// All that could not be read, in the order of the file.
pub(super) fn not_read() -> Result<Vec<NotRead>, ExperimentError> {
    read(NOT_READ_FILE, include_str!("../../../../data/literature/not_read.json"))
}

fn read<T: for<'de> Deserialize<'de>>(file: &str, text: &str) -> Result<T, ExperimentError> {
    json::read(text.as_bytes())
        .map_err(|source| ExperimentError::Input { path: file.into(), source: Box::new(source) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All that a source says, as one text.
    fn text(entry: &Entry) -> String {
        let rest =
            [&entry._quantity, &entry.quotation, &entry._parameters, &entry._to_be_computed, &entry.address];
        format!("{}\n{}", rest.map(String::as_str).join("\n"), entry._printed)
    }

    #[test]
    fn every_input_and_every_printed_number_stands_in_the_text() {
        for entry in entries().expect("legal") {
            let text = text(&entry);
            let own = entry.statements.iter().flat_map(|statement| statement.inputs.values());
            for input in entry.inputs.values().chain(own) {
                assert!(text.contains(input.as_str()), "{}: {input}", entry.id);
                assert!(PrintedNumber::read(input).is_some(), "{}: {input}", entry.id);
            }
            for printed in entry.statements.iter().filter_map(|statement| statement.printed.as_ref()) {
                assert!(printed.split(", ").all(|part| text.contains(part)), "{}: {printed}", entry.id);
            }
        }
    }

    #[test]
    fn identifiers_and_names_are_unique_and_nothing_is_empty() {
        let entries = entries().expect("legal");
        for (index, entry) in entries.iter().enumerate() {
            assert!(entries[..index].iter().all(|other| other.id != entry.id), "{}", entry.id);
            assert!(!entry.quotation.is_empty() && !entry.address.is_empty(), "{}", entry.id);
            assert!(!entry.statements.is_empty() && !entry._quantity.is_empty(), "{}", entry.id);
            for (index, statement) in entry.statements.iter().enumerate() {
                let others = &entry.statements[..index];
                assert!(others.iter().all(|other| other.name != statement.name), "{}", statement.name);
                assert!(!statement.quantity.is_empty() && statement.printed.as_deref() != Some(""));
            }
        }
        assert!(!not_read().expect("legal").is_empty());
    }

    #[test]
    fn what_is_not_there_is_named() {
        let entries = entries().expect("legal");
        let error = entries[0].input("nothing").expect_err("there is none");
        assert!(error.to_string().contains("LFY-1 nothing"), "{error}");
        assert!(entries[0].statement("nothing").is_err() && entries[0].printed("nothing").is_err());
    }
}
