//! `docs/literature.md`: what others have published on bouncing balls, beside what the exact map gives.
//!
//! The page is committed, and made from the data of `extra-literature`, which are the same in draft and paper quality.

use crate::artifacts::{self, Stored};
use crate::experiment::{ExperimentError, RegisteredExperiment};
use crate::figures::extra_literature::ExtraLiterature;
use crate::output::OutputFolder;
use crate::results::ResultsError;
use crate::{Experiment as _, cache_key::Stale};

/// The page, in the folder of the documentation.
pub const LITERATURE_FILE: &str = "literature.md";

/// Whether the page is made from this figure.
pub fn is_source(id: &str) -> bool {
    id == ExtraLiterature::ID
}

/// The page of the data that lie in the output folder.
///
/// # Errors
///
/// When there are none, or they are not those that were written there.
pub fn page(entry: &dyn RegisteredExperiment, folder: &OutputFolder) -> Result<String, ResultsError> {
    let id = entry.id();
    let name = format!("{id}.json");
    let missing = || ResultsError::Missing { id: id.to_owned() };
    let data = folder.read(&name)?.ok_or_else(missing)?;
    let cache_key = folder.cache_key(id).map_err(|stale| match stale {
        Stale::Missing => missing(),
        _ => ResultsError::Changed { id: id.to_owned() },
    })?;
    // What the program did not write itself may have any form.
    if !cache_key.holds(&name, &data) {
        return Err(ResultsError::Changed { id: id.to_owned() });
    }
    let failed = |source: ExperimentError| ResultsError::Figure { id: id.to_owned(), source };
    let Stored { outcome, .. } = artifacts::read(entry, &data).map_err(failed)?;
    ExtraLiterature::page(outcome.to_json().map_err(failed)?).map_err(failed)
}

/// Writes the page into `docs` from the data in the output folder.
///
/// # Errors
///
/// When there are none, or the system refuses.
pub fn write(
    entry: &dyn RegisteredExperiment,
    folder: &OutputFolder,
    docs: &OutputFolder,
) -> Result<(), ResultsError> {
    let page = page(entry, folder)?;
    Ok(docs.write(LITERATURE_FILE, page.as_bytes())?)
}

/// Whether the committed page is another one than that of the data in the output folder. Where these have not been made,
/// only a page that is missing is out of date.
///
/// # Errors
///
/// When a file exists and cannot be read.
pub fn is_outdated(
    entry: &dyn RegisteredExperiment,
    folder: &OutputFolder,
    docs: &OutputFolder,
) -> Result<bool, ResultsError> {
    let Some(committed) = docs.read(LITERATURE_FILE)? else { return Ok(true) };
    match page(entry, folder) {
        Ok(page) => Ok(page.as_bytes() != committed),
        Err(ResultsError::Missing { .. }) => Ok(false),
        Err(ResultsError::Output(error)) => Err(error.into()),
        Err(_) => Ok(true),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::Quality;
    use crate::measured::Measurements;
    use crate::progress::Silent;
    use crate::registry;

    #[test]
    fn the_page_is_that_of_the_data_and_every_change_is_seen() {
        let path = std::env::temp_dir().join(format!("bouncing-disk-literature-{}", std::process::id()));
        let create = |name: &str| OutputFolder::create(path.join(name)).expect("writable");
        let (folder, docs) = (create("figures"), create("docs"));
        let entries = registry::extras();
        let entry = registry::find(&entries, ExtraLiterature::ID).expect("registered");
        assert!(is_source(entry.id()) && !is_source("fig01"));
        let outdated = || is_outdated(entry, &folder, &docs).expect("readable");
        assert!(outdated());
        assert!(matches!(write(entry, &folder, &docs), Err(ResultsError::Missing { .. })));
        let files = artifacts::make(entry, Quality::Draft, &Measurements::none(), &Silent).expect("works");
        folder.write_set(entry.id(), Quality::Draft, "", 0.1, &files).expect("writable");
        write(entry, &folder, &docs).expect("writable");
        assert!(!outdated());
        let page = docs.read(LITERATURE_FILE).expect("readable").expect("written");
        // The committed page is this one.
        let committed = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/literature.md"));
        assert!(
            committed.is_ok_and(|committed| committed == page),
            "to repair: cargo xtask figures --extras --docs"
        );
        docs.write(LITERATURE_FILE, b"edited").expect("writable");
        assert!(outdated());
        docs.write(LITERATURE_FILE, &page).expect("writable");
        folder.write("extra-literature.json", b"{}").expect("writable");
        assert!(outdated());
        std::fs::remove_dir_all(path).expect("removable");
    }
}
