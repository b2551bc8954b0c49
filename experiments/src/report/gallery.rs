//! The products of all figures in a folder: `claims.json`, its schema, and the gallery, one HTML page without scripts
//! and without anything from the network.

use minijinja::context;
use serde::Serialize;
use serde_json::Value;

use super::counts::Counts;
use super::schema::schema;
use super::{Section, environment};
use crate::cache_key::Stale;
use crate::claims::Claim;
use crate::experiment::{Made, Quality, RegisteredExperiment, chain};
use crate::measured::Measurements;
use crate::output::{OutputError, OutputFolder};
use crate::provenance::Provenance;
use crate::{json, provenance};

/// The claims of all figures.
pub const CLAIMS_FILE: &str = "claims.json";
/// The form of `claims.json`.
pub const SCHEMA_FILE: &str = "claims.schema.json";
/// The gallery.
pub const PAGE_FILE: &str = "index.html";

/// The texts of the common files, and the figures that are not in them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summary {
    /// The content of `claims.json`.
    pub claims: String,
    /// The content of `claims.schema.json`.
    pub schema: String,
    /// The content of `index.html`.
    pub page: String,
    /// How many claims of all these figures came out how.
    pub counts: Counts,
    /// Identifiers of figures whose stored data could not be used, and why.
    pub left_out: Vec<(String, String)>,
    /// Identifiers of figures without measurements that there are, and what is wrong with those.
    pub warnings: Vec<(String, String)>,
}

/// One figure of the gallery.
#[derive(Serialize)]
struct Page {
    #[serde(flatten)]
    section: Section,
    quality: Quality,
    run_time: String,
    /// Faults of the user's measurements that are therefore not shown.
    warnings: Vec<String>,
    /// Whether the sources, the measurements or the files have changed since.
    outdated: bool,
    /// The width of the picture on the page (pixels).
    width: Option<u32>,
}

impl Summary {
    /// Collects all figures whose results lie in the folder.
    pub fn of(
        entries: &[RegisteredExperiment],
        folder: &OutputFolder,
        measurements: &Measurements,
    ) -> Result<Self, OutputError> {
        let (mut pages, mut origins) = (Vec::new(), Vec::new());
        let (mut all_claims, mut stored_claims) = (Vec::new(), Vec::new());
        let (mut left_out, mut warnings) = (Vec::new(), Vec::new());
        for entry in entries {
            let id = entry.id;
            let Some(bytes) = folder.read(&format!("{id}.json"))? else { continue };
            let (made, quality, origin) = match stored(entry, folder, &bytes) {
                Ok(stored) => stored,
                Err(reason) => {
                    left_out.push((id.to_owned(), reason));
                    continue;
                }
            };
            let state = folder.check(id, quality, &measurements.digest(entry.measurements));
            // Faults of measurements that have been replaced say nothing about the new ones.
            if state != Err(Stale::Measurements) {
                warnings.extend(made.warnings.iter().map(|warning| (id.to_owned(), warning.clone())));
            }
            let section = match Section::of(entry, &made) {
                Ok(section) => section,
                Err(error) => {
                    left_out.push((id.to_owned(), chain(&error)));
                    continue;
                }
            };
            let cache_key = folder.cache_key(id).ok();
            let width = folder.read(&format!("{id}.png"))?.as_deref().and_then(png_width);
            pages.push(Page {
                section,
                quality,
                run_time: duration(cache_key.as_ref().map_or(0.0, |key| key.run_time_s)),
                outdated: state.is_err(),
                // Four pixels are a point; 1.9 pixels per point make a double column fill the page.
                width: width.map(|pixels| pixels * 19 / 40),
                warnings: made.warnings,
            });
            stored_claims.extend(made.claims.iter().map(|claim| claim_of(claim, entry, quality)));
            all_claims.extend(made.claims);
            origins.push(origin);
        }
        let counts = Counts::of(&all_claims);
        let schema = json::to_text(&schema());
        let claims = json::to_text(&Value::Array(stored_claims));
        Ok(Self { claims, schema, page: html(&pages, &origins, &counts), counts, left_out, warnings })
    }

    /// Collects all figures whose results lie in the folder and writes the common files. No other run writes
    /// meanwhile, so that the last of several runs describes what all of them have made.
    pub fn update(
        entries: &[RegisteredExperiment],
        folder: &OutputFolder,
        measurements: &Measurements,
    ) -> Result<Self, OutputError> {
        let locked = folder.lock()?;
        let summary = Self::of(entries, folder, measurements)?;
        locked.write(&summary.files().map(|(name, text)| (name, text.as_bytes())))?;
        Ok(summary)
    }

    fn files(&self) -> [(&'static str, &str); 3] {
        let Self { claims, schema, page, .. } = self;
        [(CLAIMS_FILE, claims), (SCHEMA_FILE, schema), (PAGE_FILE, page)]
    }

    /// The names of common files that are missing or out of date.
    pub fn outdated(&self, folder: &OutputFolder) -> Result<Vec<&'static str>, OutputError> {
        let mut outdated = Vec::new();
        for (name, text) in self.files() {
            if folder.read(name)?.as_deref() != Some(text.as_bytes()) {
                outdated.push(name);
            }
        }
        Ok(outdated)
    }
}

/// The files of an experiment in a folder, or why they cannot be used.
fn stored(
    entry: &RegisteredExperiment,
    folder: &OutputFolder,
    bytes: &[u8],
) -> Result<(Made, Quality, Provenance), String> {
    let cache_key = folder.cache_key(entry.id).map_err(|stale| match stale {
        // Without a cache key the files may be from different runs.
        Stale::Missing => "the run that made it was interrupted".to_owned(),
        other => other.to_string(),
    })?;
    let name = format!("{}.json", entry.id);
    // A file that the program did not write itself may have any form.
    if !cache_key.holds(&name, bytes) {
        return Err(Stale::File { name }.to_string());
    }
    entry.read(bytes).map_err(|error| chain(&error))
}

/// A claim as it is stored, with what it says of its origin: `claims.json` is an array and has no other place
/// for that, and the figures may have been made in different qualities.
fn claim_of(claim: &Claim, entry: &RegisteredExperiment, quality: Quality) -> Value {
    // Claims hold strings, booleans and finite numbers only, so that this cannot fail.
    let mut stored = serde_json::to_value(claim).unwrap_or_default();
    if let Ok(origin) = entry.provenance(provenance::CLAIM, quality) {
        stored["provenance"] = serde_json::to_value(origin).unwrap_or_default();
    }
    stored
}

fn html(pages: &[Page], origins: &[Provenance], counts: &Counts) -> String {
    let gallery = provenance::new(provenance::GALLERY);
    let gallery = gallery.clone().with("figures", origins).unwrap_or(gallery);
    let values = context! {
        pages,
        extras => pages.iter().filter(|page| page.section.is_extra).count(),
        headline => counts.headline(),
        beside => counts.beside(),
        style => include_str!("gallery.css"),
        program => format!("{} {}", gallery.program(), gallery.version()),
        provenance => provenance::text(&gallery),
    };
    // A fault of the template is one of this crate: a test renders all of it.
    environment()
        .render_named_str("gallery.html", include_str!("gallery.html"), values)
        .unwrap_or_else(|error| error.to_string())
}

/// The width in pixels that the header of a PNG file states.
fn png_width(bytes: &[u8]) -> Option<u32> {
    let width = bytes.get(16..20)?;
    Some(u32::from_be_bytes(width.try_into().ok()?))
}

fn duration(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 1.0 => "less than a second".to_owned(),
        seconds if seconds < 100.0 => format!("{seconds:.1} s"),
        seconds => format!("{} min {} s", seconds.round() as u64 / 60, seconds.round() as u64 % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::testing::demo_entries;

    #[test]
    fn the_summary_holds_what_lies_in_the_folder() {
        let scratch = tempfile::tempdir().expect("writable");
        let folder = OutputFolder::create(scratch.path()).expect("writable");
        let entries = demo_entries();
        let none = Measurements::none();
        let summary = || Summary::of(&entries, &folder, &none).expect("readable");
        assert_eq!(summary().claims, "[]\n");
        let files = entries[0].files(Quality::Draft, &none, &Silent).expect("works");
        folder.write_set("demo", Quality::Draft, "", 75.2, &files).expect("writable");
        let first = summary();
        assert!(first.claims.contains("\"verdict\": \"reproduced\""), "{}", first.claims);
        let page = &first.page;
        assert!(page.contains("τ_imp &amp; Γ &lt; 1") && page.contains("Draft quality, 75.2 s"), "{page}");
        assert!(page.contains("<td>restitution ε</td><td>0.5</td>"), "{page}");
        assert!(page.contains("class=\"verdict reproduced\""), "{page}");
        let head =
            "<meta name=\"provenance\" content=\"{&quot;program&quot;:&quot;bouncing-disk-experiments&quot;";
        assert!(page.contains(head) && !page.contains("http") && !page.contains("<script"), "{page}");
        assert!(!page.contains("beyond") && page.contains("1 figures and tables."), "{page}");
        let files = [CLAIMS_FILE, SCHEMA_FILE, PAGE_FILE];
        assert_eq!(first.outdated(&folder).expect("readable"), files);
        assert_eq!(Summary::update(&entries, &folder, &none).expect("writable"), first);
        assert!(first.outdated(&folder).expect("readable").is_empty());
        // A record of another version, and a run that was killed before it wrote its cache key.
        folder.write("demo.json", b"{}").expect("writable");
        assert_eq!(summary().left_out.len(), 1);
        std::fs::remove_file(scratch.path().join("demo.cache-key")).expect("removable");
        assert_eq!(summary().left_out.len(), 1);
    }

    #[test]
    fn what_is_beyond_the_paper_stands_behind_it_and_what_is_wrong_is_shown_as_text() {
        let entries = demo_entries();
        let made = entries[0].compute(Quality::Draft, &Measurements::none(), &Silent).expect("works");
        let page = |is_extra: bool| Page {
            section: Section { is_extra, ..Section::of(&entries[0], &made).expect("no references") },
            quality: Quality::Paper,
            run_time: duration(125.0),
            warnings: vec!["fig06.csv, line 2: \"<script>\u{202e}x\" is not a number".to_owned()],
            outdated: true,
            width: Some(2040),
        };
        let counts = Counts::default();
        let both = html(&[page(false), page(true), page(true)], &[], &counts);
        let beyond = both.find("<h2 id=\"beyond\"").expect("a heading");
        assert_eq!(both[..beyond].matches("<section").count(), 1, "{both}");
        assert!(
            both.contains("1 figures and tables, and 2 <a href=\"#beyond\">beyond the paper</a>"),
            "{both}"
        );
        assert!(
            both.contains(r"Measurements not shown: fig06.csv, line 2: &quot;&lt;script&gt;\u{202e}x&quot;")
        );
        assert!(both.contains("Out of date") && both.contains("2 min 5 s") && both.contains("width:2040px"));
    }
}
