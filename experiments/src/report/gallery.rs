//! The products of all figures in a folder: `claims.json`, its schema, and the gallery, one HTML page without scripts
//! and without anything from the network.

use std::path::Path;

use minijinja::context;
use serde::Serialize;
use serde_json::Value;

use super::counts::Counts;
use super::schema::schema;
use super::{Row, Section, environment};
use crate::claims::{Claim, Verdict};
use crate::experiment::{Experiment, Quality, Record, chain};
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
}

/// Rows that differ for one cause.
#[derive(Serialize)]
struct Differences<'a> {
    cause: &'a str,
    rows: Vec<Difference<'a>>,
}

/// A row that differs, and where it stands.
#[derive(Serialize)]
struct Difference<'a> {
    figure: &'a str,
    anchor: String,
    #[serde(flatten)]
    row: &'a Row,
}

/// One figure of the gallery.
#[derive(Serialize)]
struct Page {
    #[serde(flatten)]
    section: Section,
    quality: Quality,
    /// The width of the picture on the page (pixels).
    width: Option<u32>,
}

impl Summary {
    /// Collects all figures whose results lie in the folder.
    pub fn of(experiments: &[Experiment], folder: &OutputFolder) -> Result<Self, OutputError> {
        let (mut pages, mut origins) = (Vec::new(), Vec::new());
        let (mut all_claims, mut stored_claims) = (Vec::new(), Vec::new());
        let mut left_out = Vec::new();
        for Experiment { id, .. } in experiments {
            let Some(bytes) = folder.read(&format!("{id}.json"))? else { continue };
            let record = match Record::read(id, &bytes) {
                Ok(record) => record,
                Err(error) => {
                    left_out.push(((*id).to_owned(), chain(&error)));
                    continue;
                }
            };
            let width = folder.read(&format!("{id}.png"))?.as_deref().and_then(png_width);
            pages.push(Page {
                section: Section::of(&record),
                quality: record.quality,
                // Four pixels are a point; 1.9 pixels per point make a double column fill the page.
                width: width.map(|pixels| pixels * 19 / 40),
            });
            let origin = provenance::of_claim(&record.provenance).ok();
            stored_claims.extend(record.claims.iter().map(|claim| claim_of(claim, origin.as_ref())));
            all_claims.extend(record.claims);
            origins.push(record.provenance);
        }
        let counts = Counts::of(&all_claims);
        let schema = json::to_text(&schema());
        let claims = json::to_text(&Value::Array(stored_claims));
        let root = root_of(folder.path());
        let page = html(&pages, &origins, &counts, root.as_deref());
        Ok(Self { claims, schema, page, counts, left_out })
    }

    /// Collects all figures whose results lie in the folder and writes the common files.
    pub fn update(experiments: &[Experiment], folder: &OutputFolder) -> Result<Self, OutputError> {
        let summary = Self::of(experiments, folder)?;
        let Self { claims, schema, page, .. } = &summary;
        let files = [(CLAIMS_FILE, claims), (SCHEMA_FILE, schema), (PAGE_FILE, page)];
        folder.write_all(&files.map(|(name, text)| (name.to_owned(), text.clone().into_bytes())))?;
        Ok(summary)
    }
}

/// A claim as it is stored, with what it says of its origin: `claims.json` is an array and has no other place
/// for that, and the figures may have been made in different qualities.
fn claim_of(claim: &Claim, origin: Option<&Provenance>) -> Value {
    // Claims hold strings, booleans and finite numbers only, so that this cannot fail.
    let mut stored = serde_json::to_value(claim).unwrap_or_default();
    if let Some(origin) = origin {
        stored["provenance"] = serde_json::to_value(origin).unwrap_or_default();
    }
    stored
}

fn html(pages: &[Page], origins: &[Provenance], counts: &Counts, root: Option<&str>) -> String {
    let gallery = provenance::new(provenance::GALLERY);
    let gallery = gallery.clone().with("figures", origins).unwrap_or(gallery);
    let verdicts = Verdict::ALL.map(|verdict| context! { name => verdict, words => super::words(verdict) });
    let values = context! {
        pages,
        causes => causes(pages),
        verdicts,
        root,
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

/// The rows that count against the paper, by cause.
fn causes(pages: &[Page]) -> Vec<Differences<'_>> {
    let mut causes: Vec<Differences<'_>> = Vec::new();
    for Page { section, .. } in pages {
        let against = section.rows.iter().enumerate().filter(|(_, row)| row.is_against);
        for (index, row) in against {
            let anchor = format!("{}-{}", section.id, index + 1);
            let row = Difference { figure: &section.name, anchor, row };
            match causes.iter_mut().find(|own| own.cause == row.row.cause) {
                Some(own) => own.rows.push(row),
                None => causes.push(Differences { cause: &row.row.cause, rows: vec![row] }),
            }
        }
    }
    causes
}

/// How a page in this folder links files of the workspace, if the folder lies in it.
fn root_of(folder: &Path) -> Option<String> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).parent()?.canonicalize().ok()?;
    let folder = folder.canonicalize().ok()?;
    let below = folder.strip_prefix(workspace).ok()?;
    Some("../".repeat(below.components().count()))
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
        let scratch = tempfile::tempdir().expect("writable");
        let folder = OutputFolder::create(scratch.path()).expect("writable");
        let entries = demo_entries();
        let summary = || Summary::of(&entries, &folder).expect("readable");
        assert_eq!(summary().claims, "[]\n");
        let made = entries[0].compute(Quality::Draft, &Silent).expect("works");
        folder.write_all(&made.files().expect("draws")).expect("writable");
        let first = summary();
        assert!(first.claims.contains("\"verdict\": \"reproduced\""), "{}", first.claims);
        let page = &first.page;
        assert!(page.contains("τ<sub>imp</sub> &amp; Γ &lt; 1") && page.contains("Draft quality."), "{page}");
        assert!(page.contains("<td>restitution ε</td><td>0.5</td>"), "{page}");
        assert!(page.contains("class=\"verdict reproduced\""), "{page}");
        let head =
            "<meta name=\"provenance\" content=\"{&quot;program&quot;:&quot;bouncing-disk-experiments&quot;";
        assert!(page.contains(head) && !page.contains("http") && !page.contains("<script"), "{page}");
        assert!(page.contains("1 figures and tables."), "{page}");
        assert_eq!(Summary::update(&entries, &folder).expect("writable"), first);
        for (name, text) in [(CLAIMS_FILE, &first.claims), (PAGE_FILE, page)] {
            assert_eq!(folder.read(name).expect("readable").as_deref(), Some(text.as_bytes()));
        }
        // A record of another version.
        folder.write("demo.json", b"{}").expect("writable");
        assert_eq!(summary().left_out.len(), 1);
    }
}
