//! What is made from all figures together: `claims.json` and the gallery.

use serde_json::Value;

use crate::cache_key::Stale;
use crate::claim::Claim;
use crate::count::Counts;
use crate::experiment::{self, Quality, RegisteredExperiment};
use crate::measured::Measurements;
use crate::output::{LockedFolder, OutputError, OutputFolder};
use crate::page::{self, Section};
use crate::{artifacts, json, provenance};

/// The texts of the common files, and the figures that are not in them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summary {
    /// The content of `claims.json`.
    pub claims: String,
    /// The content of `index.html`.
    pub page: String,
    /// How many claims of all these figures came out how.
    pub counts: Counts,
    /// Identifiers of figures whose stored data could not be used, and why.
    pub left_out: Vec<(String, String)>,
    /// Identifiers of figures without measurements that there are, and what is wrong with those.
    pub warnings: Vec<(String, String)>,
}

/// The names of the common files.
pub const CLAIMS_FILE: &str = "claims.json";
/// The gallery.
pub const PAGE_FILE: &str = "index.html";

impl Summary {
    /// Collects all figures whose results lie in the folder.
    ///
    /// # Errors
    ///
    /// When a file exists and cannot be read.
    pub fn of(
        entries: &[Box<dyn RegisteredExperiment>],
        folder: &OutputFolder,
        measurements: &Measurements,
    ) -> Result<Self, OutputError> {
        let mut sections = Vec::new();
        let (mut claims, mut origins) = (Vec::new(), Vec::new());
        let mut counts = Counts::default();
        let mut left_out = Vec::new();
        let mut warnings = Vec::new();
        for entry in entries {
            let id = entry.id();
            let name = format!("{id}.json");
            let Some(bytes) = folder.read(&name)? else { continue };
            let cache_key = match folder.cache_key(id) {
                Ok(cache_key) => cache_key,
                Err(stale) => {
                    let reason = match stale {
                        // Without a cache key the files may be from different runs.
                        Stale::Missing => "the run that made it was interrupted".to_owned(),
                        other => other.to_string(),
                    };
                    left_out.push((id.to_owned(), reason));
                    continue;
                }
            };
            // What the program did not write itself may have any form.
            if !cache_key.holds(&name, &bytes) {
                left_out.push((id.to_owned(), Stale::File { name }.to_string()));
                continue;
            }
            let artifacts::Stored { outcome, provenance: origin, quality, warnings: own } =
                match artifacts::read(&**entry, &bytes) {
                    Ok(read) => read,
                    Err(error) => {
                        left_out.push((id.to_owned(), experiment::chain(&error)));
                        continue;
                    }
                };
            let state = folder.check(id, quality, &measurements.digest(entry.measurements()));
            // What was wrong with measurements that have been replaced says nothing about the new ones.
            if state != Err(Stale::Measurements) {
                warnings.extend(own.iter().map(|warning| (id.to_owned(), warning.clone())));
            }
            let section = Section {
                id: id.to_owned(),
                title: entry.title().to_owned(),
                caption: outcome.caption(),
                parameters: outcome.parameters(),
                claims: outcome.claims(),
                quality,
                run_time_s: cache_key.run_time_s,
                warnings: own,
                outdated: state.is_err(),
                has_table: cache_key.names().any(|name| name == format!("{id}.csv")),
                width: folder.read(&format!("{id}.png"))?.as_deref().and_then(png_width),
            };
            counts = counts.and(&Counts::of(&section.claims));
            claims.extend(section.claims.iter().map(|claim| claim_of(claim, &**entry, quality)));
            sections.push(section);
            origins.push(origin);
        }
        let claims = json::to_text(&Value::Array(claims)).unwrap_or_default();
        let gallery = provenance::new(provenance::GALLERY);
        let gallery = gallery.clone().with("figures", &origins).unwrap_or(gallery);
        Ok(Self { claims, page: page::html(&gallery, &sections), counts, left_out, warnings })
    }

    /// Collects all figures whose results lie in the folder and writes the common files. No other run writes
    /// meanwhile, so that the last of several runs describes what all of them have made.
    ///
    /// # Errors
    ///
    /// When a file exists and cannot be read, or the system refuses.
    pub fn update(
        entries: &[Box<dyn RegisteredExperiment>],
        folder: &OutputFolder,
        measurements: &Measurements,
    ) -> Result<Self, OutputError> {
        let locked = folder.lock()?;
        let summary = Self::of(entries, folder, measurements)?;
        summary.write(&locked)?;
        Ok(summary)
    }

    fn write(&self, folder: &LockedFolder<'_>) -> Result<(), OutputError> {
        folder.write(&[(CLAIMS_FILE, self.claims.as_bytes()), (PAGE_FILE, self.page.as_bytes())])
    }

    /// The names of common files that are missing or out of date.
    ///
    /// # Errors
    ///
    /// When a file exists and cannot be read.
    pub fn outdated(&self, folder: &OutputFolder) -> Result<Vec<&'static str>, OutputError> {
        let mut outdated = Vec::new();
        for (name, text) in [(CLAIMS_FILE, &self.claims), (PAGE_FILE, &self.page)] {
            if folder.read(name)?.as_deref() != Some(text.as_bytes()) {
                outdated.push(name);
            }
        }
        Ok(outdated)
    }
}

/// A claim as it is stored, with what it says of its origin: `claims.json` is an array and has no other place for that,
/// and the figures may have been made in different qualities.
fn claim_of(claim: &Claim, entry: &dyn RegisteredExperiment, quality: Quality) -> Value {
    // Claims hold strings, booleans and finite numbers only, so that this cannot fail.
    let mut stored = serde_json::to_value(claim).unwrap_or_default();
    if let (Some(members), Ok(origin)) =
        (stored.as_object_mut(), provenance::of_claims(entry, quality).map(serde_json::to_value))
    {
        members.insert("provenance".to_owned(), origin.unwrap_or_default());
    }
    stored
}

/// The width in pixels that the header of a PNG file states.
fn png_width(bytes: &[u8]) -> Option<u32> {
    let width = bytes.get(16..20)?;
    Some(u32::from_be_bytes(width.try_into().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::testing::demo_entries;

    #[test]
    fn the_summary_holds_what_lies_in_the_folder() {
        let path = std::env::temp_dir().join(format!("bouncing-disk-summary-{}", std::process::id()));
        let folder = OutputFolder::create(&path).expect("writable");
        let entries = demo_entries();
        let empty = Summary::of(&entries, &folder, &Measurements::none()).expect("readable");
        assert_eq!(empty.claims, "[]\n");
        let files =
            artifacts::make(&*entries[0], Quality::Draft, &Measurements::none(), &Silent).expect("works");
        folder.write_set("demo", Quality::Draft, "", 0.25, &files).expect("writable");
        let summary = Summary::of(&entries, &folder, &Measurements::none()).expect("readable");
        assert!(summary.claims.contains("\"verdict\": \"reproduced\""), "{}", summary.claims);
        assert!(summary.page.contains("τ_imp &amp; Γ &lt; 1"));
        assert_eq!(summary.outdated(&folder).expect("readable"), [CLAIMS_FILE, PAGE_FILE]);
        assert_eq!(Summary::update(&entries, &folder, &Measurements::none()).expect("writable"), summary);
        assert!(summary.outdated(&folder).expect("readable").is_empty());
        // A record of another version.
        folder.write("demo.json", b"{}").expect("writable");
        assert_eq!(
            Summary::of(&entries, &folder, &Measurements::none()).expect("readable").left_out.len(),
            1
        );
        // A run that was killed before it wrote its cache key.
        std::fs::remove_file(path.join("demo.cache-key")).expect("removable");
        let interrupted = Summary::of(&entries, &folder, &Measurements::none()).expect("readable");
        assert_eq!(interrupted.left_out.len(), 1, "{interrupted:?}");
        std::fs::remove_dir_all(path).expect("removable");
    }
}
