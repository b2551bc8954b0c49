//! The committed pages and pictures: `docs/results.md`, `docs/errata.md` and `docs/figures`.
//!
//! They are made in paper quality. Whether they are out of date must be known without the minutes that takes:
//! [`Digests`], written with the pictures, holds for each figure a digest of what it was made from in *both*
//! qualities: data, drawing and section. A draft run sees every change of model, drawing, caption, claims and
//! printed numbers. It does not see one that only the paper grids feel, nor one of the page's head
//! (docs/architecture.md).

use std::collections::BTreeMap;

use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::store::{Provenance, StorageError};
use minijinja::{Value, context};
use serde::{Deserialize, Serialize};

use super::counts::Counts;
use super::{Section, TemplateError, digits, environment};
use crate::claims::{self, Claim, Source};
use crate::experiment::{ExperimentError, Made, Quality, RegisteredExperiment};
use crate::output::{OutputError, OutputFolder};
use crate::{json, provenance};

/// Figure by figure the picture, what it shows, the parameters, and printed against computed.
pub const RESULTS_FILE: &str = "results.md";
/// Prose by hand, every number in it from the data of a figure.
pub const ERRATA_FILE: &str = "errata.md";
/// The digests, in the folder of the pictures.
pub const DIGESTS_FILE: &str = "digests.json";
/// How large the file of a picture may be (bytes), where a smaller width helps.
pub const LARGEST_PICTURE: usize = 300_000;
/// How large its vector file may be (bytes). Dense points are an image in it, too.
pub const LARGEST_VECTOR: usize = 700_000;
/// Widths of a picture (pixels), from the best on: the first counts whose file is small enough.
const PICTURE_WIDTHS: [u16; 4] = [1100, 950, 800, 650];

/// The template of the errata. The numbers that it writes out are printed in the paper: a test reads all of them. A number of ours is one of the data of a figure, `{{ fig06.merging.survived|number(".7") }}`, or
/// that of the claim that answers an entry of the catalogue, `{{ claims["section4.merging"]|number(".4") }}`:
/// the computed number, or the share of the inputs that print alike for which it holds.
const ERRATA: &str = include_str!("errata.md");
/// The name of that template among those of the pages.
const ERRATA_TEMPLATE: &str = "template of errata.md";
const RESULTS: &str = include_str!("results.md");
const SECTION: &str = include_str!("section.md");

/// The template's name among those of the pages, and its digest.
pub fn template() -> (&'static str, String) {
    (ERRATA_TEMPLATE, digest(ERRATA.as_bytes()))
}

/// The folder of the pictures, in that of the documentation.
pub const PICTURES_FOLDER: &str = "figures";

/// Why the pages could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PagesError {
    /// A figure that the page needs is not there or cannot be drawn.
    #[error("{id}")]
    Figure {
        /// The figure.
        id: &'static str,
        /// The error.
        source: Box<ExperimentError>,
    },
    /// There are no files of a figure in the output folder.
    #[error("{id} has not been made")]
    Missing {
        /// The figure.
        id: &'static str,
    },
    /// A figure was made again in another quality.
    #[error("{id} is of another quality")]
    Quality {
        /// The figure.
        id: &'static str,
    },
    /// A page refers to what is not there.
    #[error("a page refers to what is not there")]
    Template(#[from] TemplateError),
    /// A file cannot be read or written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The origin of a file cannot be stored, or is of a newer format.
    #[error(transparent)]
    Provenance(#[from] Box<StorageError>),
}

/// Digests of everything from which the committed pages and pictures were made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Digests {
    /// Which version of the program wrote them.
    provenance: Provenance,
    /// Of the pages that belong to the pictures, and of the template.
    pub pages: BTreeMap<String, String>,
    /// By identifier of the figure.
    pub figures: BTreeMap<String, FigureDigests>,
}

/// Digests of everything from which the picture of one figure, and its section of the page if it has one,
/// were made.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FigureDigests {
    /// Digest of data, drawing and section in draft quality.
    draft: String,
    /// The same in paper quality, of which the picture is.
    paper: String,
    /// Digest of the picture's file.
    pub picture: String,
    /// Digest of the vector file.
    pub vector: String,
}

/// A digest that does not depend on machine or compiler (FNV-1a, 64 bits).
pub fn digest(bytes: &[u8]) -> String {
    Digest::of(bytes).to_string()
}

/// A figure as it lies in an output folder, with its section of the page.
struct Figure {
    made: Made,
    section: String,
    /// The drawing as a vector file.
    vector: String,
    digest: String,
}

impl Figure {
    /// The figure of this quality in an output folder.
    fn read(
        entry: &RegisteredExperiment,
        folder: &OutputFolder,
        quality: Quality,
    ) -> Result<Self, PagesError> {
        let data = folder.read(&format!("{}.json", entry.id))?;
        Self::of(entry, &data.ok_or(PagesError::Missing { id: entry.id })?, quality)
    }

    /// The figure of this quality from the content of its `ID.json`.
    fn of(entry: &RegisteredExperiment, data: &[u8], quality: Quality) -> Result<Self, PagesError> {
        let id = entry.id;
        let failed = |source| PagesError::Figure { id, source: Box::new(source) };
        let (made, found, origin) = entry.read(data).map_err(failed)?;
        if found != quality {
            return Err(PagesError::Quality { id });
        }
        let drawing = made.figure.to_svg().map_err(|error| failed(error.into()))?;
        let vector = provenance::in_svg(&origin, &drawing);
        let values = Value::from_serialize(Section::of(entry, &made)?);
        let section = digits::rounded(&environment().render_named_str("section.md", SECTION, values)?);
        // Another version of the program does not make another figure.
        let mut record: serde_json::Value = serde_json::from_slice(data).unwrap_or_default();
        record.as_object_mut().map(|members| members.remove("provenance"));
        let digest = digest([json::to_text(&record), drawing, section.clone()].concat().as_bytes());
        Ok(Self { made, section, vector, digest })
    }

    /// The file of the picture.
    fn picture(&self, id: &'static str) -> Result<Vec<u8>, PagesError> {
        let failed = |source: ExperimentError| PagesError::Figure { id, source: Box::new(source) };
        let mut picture = Vec::new();
        for width in PICTURE_WIDTHS {
            picture = self.made.figure.to_png_within(width).map_err(|error| failed(error.into()))?;
            if picture.len() <= LARGEST_PICTURE {
                break;
            }
        }
        Ok(picture)
    }
}

/// Writes the pages, the pictures and their digests into `docs` from the figures in both output folders: nothing
/// before everything is drawn, and the digests, which all is compared with, last.
pub fn write(
    entries: &[&RegisteredExperiment],
    paper: &OutputFolder,
    draft: &OutputFolder,
    docs: &OutputFolder,
) -> Result<(), PagesError> {
    write_with(ERRATA, entries, [paper, draft], docs)
}

fn write_with(
    errata: &str,
    entries: &[&RegisteredExperiment],
    [paper, draft]: [&OutputFolder; 2],
    docs: &OutputFolder,
) -> Result<(), PagesError> {
    let folder = OutputFolder::create(docs.path().join(PICTURES_FOLDER))?;
    let origin = provenance::new(provenance::DIGESTS).with("quality", &Quality::Paper).map_err(Box::new)?;
    let mut digests = Digests { provenance: origin, pages: BTreeMap::new(), figures: BTreeMap::new() };
    let (mut figures, mut files) = (Vec::new(), Vec::new());
    for entry in entries {
        let drafted = Figure::read(entry, draft, Quality::Draft)?.digest;
        let figure = Figure::read(entry, paper, Quality::Paper)?;
        let picture = figure.picture(entry.id)?;
        let known = FigureDigests {
            draft: drafted,
            paper: figure.digest.clone(),
            picture: digest(&picture),
            vector: digest(figure.vector.as_bytes()),
        };
        files.push((format!("{}.svg", entry.id), figure.vector.clone().into_bytes()));
        digests.figures.insert(entry.id.to_owned(), known);
        files.push((format!("{}.png", entry.id), picture));
        figures.push((entry.id, figure));
    }
    let pages = [(RESULTS_FILE, results(&figures)?), (ERRATA_FILE, filled(errata, &figures)?)];
    digests.pages.insert(ERRATA_TEMPLATE.to_owned(), digest(errata.as_bytes()));
    for (name, page) in &pages {
        digests.pages.insert((*name).to_owned(), digest(page.as_bytes()));
    }
    let text = serde_json::to_value(&digests).map(|digests| json::to_text(&digests)).unwrap_or_default();
    files.push((DIGESTS_FILE.to_owned(), text.into_bytes()));
    let pages = pages.map(|(name, page)| (name.to_owned(), page.into_bytes()));
    docs.write_all(&pages)?;
    Ok(folder.write_all(&files)?)
}

/// A figure of which the content of `ID.json` was computed.
pub type Computed<'a> = (&'a RegisteredExperiment, Vec<u8>);

/// Names of committed files that are missing, were edited, or were made from other figures than these of `quality`.
pub fn outdated(
    figures: &[Computed<'_>],
    quality: Quality,
    docs: &OutputFolder,
) -> Result<Vec<String>, PagesError> {
    outdated_with(ERRATA, figures, quality, docs)
}

fn outdated_with(
    errata: &str,
    figures: &[Computed<'_>],
    quality: Quality,
    docs: &OutputFolder,
) -> Result<Vec<String>, PagesError> {
    let folder = OutputFolder::existing(docs.path().join(PICTURES_FOLDER));
    let stored = folder.read(DIGESTS_FILE)?.unwrap_or_default();
    let stored: serde_json::Value = serde_json::from_slice(&stored).unwrap_or_default();
    provenance::refuse_newer(provenance::DIGESTS, stored.get("provenance"), DIGESTS_FILE)
        .map_err(Box::new)?;
    let digests = Digests::deserialize(stored).ok();
    let mut outdated = Vec::new();
    let known = |name: &str| digests.as_ref().and_then(|digests| digests.pages.get(name));
    let other_template = known(ERRATA_TEMPLATE) != Some(&digest(errata.as_bytes()));
    for (name, other_template) in [(RESULTS_FILE, false), (ERRATA_FILE, other_template)] {
        let edited = docs.read(name)?.is_none_or(|page| known(name) != Some(&digest(&page)));
        if edited || other_template {
            outdated.push(name.to_owned());
        }
    }
    for (entry, data) in figures {
        let known = digests.as_ref().and_then(|digests| digests.figures.get(entry.id));
        let known = known.cloned().unwrap_or_default();
        let expected = if quality == Quality::Draft { &known.draft } else { &known.paper };
        let current = Figure::of(entry, data, quality)?.digest == *expected;
        let file = |ending: &str| folder.read(&format!("{}.{ending}", entry.id));
        let whole = |bytes: Option<Vec<u8>>, known: &str| bytes.is_some_and(|bytes| digest(&bytes) == known);
        if !current || !whole(file("png")?, &known.picture) || !whole(file("svg")?, &known.vector) {
            outdated.push(format!("{PICTURES_FOLDER}/{}.png", entry.id));
        }
    }
    Ok(outdated)
}

fn results(figures: &[(&str, Figure)]) -> Result<String, TemplateError> {
    let all = Counts::of(figures.iter().flat_map(|(_, figure)| &figure.made.claims));
    let row = |(id, figure): &(&str, Figure)| {
        context! { id, name => super::name(id), counts => Counts::of(&figure.made.claims).row() }
    };
    let values = context! {
        headline => all.headline(),
        beside => all.beside(),
        figures => figures.iter().map(row).collect::<Vec<_>>(),
        together => all.row(),
        sections => figures.iter().map(|(_, figure)| figure.section.as_str()).collect::<Vec<_>>(),
    };
    environment().render_named_str("results.md", RESULTS, values)
}

/// The errata with the numbers of the figures and claims.
fn filled(template: &str, figures: &[(&str, Figure)]) -> Result<String, TemplateError> {
    let cited = environment().template_from_str(template)?.undeclared_variables(false);
    let cited = figures.iter().filter(|(id, _)| cited.contains(*id));
    let mut values: BTreeMap<&str, Value> =
        cited.map(|(id, figure)| (*id, Value::from_serialize(&figure.made.data))).collect();
    let claims = figures.iter().flat_map(|(_, figure)| &figure.made.claims);
    values.insert("claims", Value::from_serialize(claim_numbers(claims)));
    let page = environment().render_named_str(ERRATA_FILE, template, Value::from_serialize(values))?;
    Ok(digits::rounded(&page))
}

/// The numbers of the claims that answer entries of the catalogue, by key: shares where a statement is judged
/// by them.
fn claim_numbers<'a>(claims: impl IntoIterator<Item = &'a Claim>) -> BTreeMap<&'a str, f64> {
    let number = |claim: &'a Claim| {
        let Source::Entry(key) = &claim.source else { return None };
        let number = match claim.computed {
            claims::Computed::Number(number) => Some(number),
            _ => claim.share,
        };
        Some((key.as_str(), number?))
    };
    claims.into_iter().filter_map(number).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::claims::{Cases, catalogue};
    use crate::progress::Silent;
    use crate::testing::demo_entries;

    const PROSE: &str = "The last phase is {{ demo.impact_phase_rad[0]|number(\".2\") }}.\n";

    struct Folders {
        _scratch: tempfile::TempDir,
        demo: RegisteredExperiment,
        paper: OutputFolder,
        draft: OutputFolder,
        docs: OutputFolder,
    }

    impl Folders {
        fn new() -> Self {
            let scratch = tempfile::tempdir().expect("writable");
            let create = |name: &str| OutputFolder::create(scratch.path().join(name)).expect("writable");
            let (paper, draft, docs) = (create("paper"), create("draft"), create("docs"));
            let folders = Self { _scratch: scratch, demo: demo_entries().remove(0), paper, draft, docs };
            folders.make(&folders.paper, Quality::Paper);
            folders.make(&folders.draft, Quality::Draft);
            folders
        }

        fn make(&self, folder: &OutputFolder, quality: Quality) {
            let files = self.demo.files(quality, &Silent).expect("works");
            folder.write_all(&files).expect("writable");
        }

        fn write(&self) -> Result<(), PagesError> {
            write_with(PROSE, &[&self.demo], [&self.paper, &self.draft], &self.docs)
        }

        fn outdated(&self, quality: Quality) -> Vec<String> {
            let made = if quality == Quality::Draft { &self.draft } else { &self.paper };
            let data = made.read("demo.json").expect("readable").expect("made");
            outdated_with(PROSE, &[(&self.demo, data)], quality, &self.docs).expect("readable")
        }
    }

    #[test]
    fn the_page_holds_picture_discussion_parameters_and_verdicts() {
        let folders = Folders::new();
        let figure =
            || vec![("demo", Figure::read(&folders.demo, &folders.paper, Quality::Paper).expect("made"))];
        let page = results(&figure()).expect("filled in");
        for part in [
            "\n\n<a id=\"demo\"></a>\n\n## demo. A demonstration\n\n![A demonstration](figures/demo.png)\n\n[As a vector file](figures/demo.svg).\n\nIt shows that | is escaped.\n\n*Caption.* 50 phases",
            "\n\n| parameter | value |\n| --- | --- |\n| restitution ε | 0.5 |\n\n| place |",
            "| Sec. 1 | last phase | 0.36\u{a0}rad | 0.36\u{a0}rad | 0.005 | this work | agrees |  |\n",
            "| [demo](#demo) | 0 | 0 | 0 | 0 | 0 | 0 | 0 | 1 |\n| together | 0 | 0 | 0 | 0 | 0 | 0 | 0 | 1 |\n\n<a id",
        ] {
            assert!(page.contains(part), "{part}\n\n{page}");
        }
        assert_eq!(filled(PROSE, &figure()).expect("filled in"), "The last phase is 0.09.\n");
        filled("{{ demo.none|number(\".1\") }}", &figure()).expect_err("no such number");
    }

    /// The numbers of verdicts that the README names are those of the page.
    #[test]
    fn the_readme_counts_like_the_page() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let read = |name: &str| std::fs::read_to_string(root.join(name)).expect("committed");
        let page = read("docs/results.md");
        let headline =
            page.lines().find_map(|line| line.strip_prefix("**Of ")?.split_once("**")).expect("a headline");
        let readme = read("README.md").replace('\n', " ");
        assert!(readme.contains(&format!("Of {}", headline.0)), "{}", headline.0);
    }

    #[test]
    fn every_way_to_be_out_of_date_is_seen() {
        use Quality::{Draft, Paper};
        const PICTURE: &str = "figures/demo.png";
        let folders = Folders::new();
        let folder = OutputFolder::existing(folders.docs.path().join(PICTURES_FOLDER));
        let all = [RESULTS_FILE, ERRATA_FILE, PICTURE];
        assert_eq!(folders.outdated(Draft), all);
        let write = || folders.write().expect("writable");
        write();
        let current = || [Draft, Paper].iter().all(|quality| folders.outdated(*quality).is_empty());
        assert!(current());
        for page in [RESULTS_FILE, ERRATA_FILE] {
            folders.docs.write(page, b"edited").expect("writable");
            assert_eq!(folders.outdated(Draft), [page]);
            write();
        }
        for file in ["demo.png", "demo.svg"] {
            folder.write(file, b"edited").expect("writable");
            assert_eq!(folders.outdated(Draft), [PICTURE]);
            write();
        }
        // Figures that have not been made are not compared; a changed template and a changed figure of the draft
        // alone are detected.
        let unmade = outdated_with(PROSE, &[], Draft, &folders.docs);
        assert!(unmade.expect("readable").is_empty() && current());
        let other = outdated_with("", &[], Draft, &folders.docs);
        assert_eq!(other.expect("readable"), [ERRATA_FILE]);
        let drafted = folders.draft.read("demo.json").expect("readable").expect("made");
        let changed = String::from_utf8(drafted).expect("text").replacen("0.3,", "0.31,", 1);
        folders.draft.write("demo.json", changed.as_bytes()).expect("writable");
        assert_eq!(folders.outdated(Draft), [PICTURE]);
        assert!(folders.outdated(Paper).is_empty());
        folder.write(DIGESTS_FILE, b"").expect("writable");
        assert_eq!(folders.outdated(Paper), all);
    }

    /// Another run may make the figure again between the two steps of `--docs`.
    #[test]
    fn the_page_is_not_made_of_drafts() {
        let folders = Folders::new();
        folders.make(&folders.paper, Quality::Draft);
        assert!(matches!(folders.write(), Err(PagesError::Quality { .. })));
        folders.make(&folders.paper, Quality::Paper);
        folders.write().expect("made for it");
    }

    #[test]
    fn claims_are_referred_to_by_their_keys() {
        let claims = [
            Claim::printed("section4.merging", 0.560_750_7),
            Claim::printed_statement("section5.linear_rise", Cases { holding: 1, tried: 4 }, ""),
            Claim::printed_statement("section4.coexistence", true, ""),
        ];
        let numbers = claim_numbers(&claims);
        assert_eq!(
            numbers,
            BTreeMap::from([("section4.merging", 0.560_750_7), ("section5.linear_rise", 0.25)])
        );
    }

    #[test]
    fn every_reference_is_to_a_figure_or_an_entry() {
        let environment = environment();
        let entries = crate::registry::all();
        let template = environment.template_from_str(ERRATA).expect("well formed");
        for variable in template.undeclared_variables(false) {
            assert!(variable == "claims" || entries.iter().any(|entry| entry.id == variable), "{variable}");
        }
        for reference in ERRATA.split("{{").skip(1).filter_map(|rest| rest.split("}}").next()) {
            // The length of a cycle that rounding chooses is no number: only that of a `robust_cycle` is one.
            assert!(!reference.contains(".cycle."), "{reference}");
            if let Some(key) = reference.split('"').nth(1).filter(|_| reference.contains("claims[")) {
                catalogue::find(key).expect("an entry");
            }
        }
    }

    /// The numbers in a text, with a sign only where it is an exponent's.
    fn numbers(text: &str) -> Vec<String> {
        let mut found = Vec::new();
        let mut current = String::new();
        for c in text.chars().chain([' ']) {
            if c.is_ascii_digit() || (c == '.' && !current.is_empty()) {
                current.push(c);
            } else if !current.is_empty() {
                found.push(std::mem::take(&mut current).trim_end_matches('.').to_owned());
            }
        }
        found
    }

    /// Numbers written out beside the references are printed in the paper, or name a place in it.
    #[test]
    fn every_other_number_of_the_errata_is_printed_in_the_paper() {
        /// Numbers that are neither results nor the paper's: of definitions, years and articles.
        const WRITTEN_OUT: [&str; 4] = ["2", "3", "2009", "046201"];
        let entries = catalogue::entries().expect("reads");
        let printed = entries.iter().flat_map(|entry| {
            let texts = [entry.printed.as_deref().unwrap_or_default(), &entry.quantity, &entry.place];
            texts.into_iter().flat_map(numbers).collect::<Vec<_>>()
        });
        let printed: BTreeSet<String> = printed.chain(WRITTEN_OUT.map(str::to_owned)).collect();
        let text: String = ERRATA.split("{{").map(|piece| piece.split("}}").last().unwrap_or("")).collect();
        // Names in code, and the figures, tables, sections, equations and indices that are referred to.
        let plain: String = text.split('`').step_by(2).collect::<Vec<_>>().join(" ");
        let mut unknown: Vec<String> = Vec::new();
        for line in plain.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            for (index, word) in words.iter().enumerate() {
                let before = index.checked_sub(1).map_or("", |before| words[before]);
                let refers = ["Fig.", "Figs.", "Table", "Tables", "Eq.", "Eqs.", "Sec.", "Secs.", "panel"];
                let is_place = refers.iter().any(|name| before.trim_start_matches(['(', '[']) == *name);
                let word = word.split("](").next().unwrap_or_default();
                if !is_place && !word.contains('_') {
                    unknown.extend(numbers(word).into_iter().filter(|number| !printed.contains(number)));
                }
            }
        }
        assert!(
            unknown.is_empty(),
            "neither printed in the paper nor from the data of a figure: {unknown:?}"
        );
    }
}
