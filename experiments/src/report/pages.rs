//! The committed pages and pictures: `docs/results.md`, `docs/errata.md` and `docs/figures`.
//!
//! They are made in paper quality. Whether they are out of date must be known without the minutes that takes:
//! [`Digests`], written with the pictures, holds for each figure a digest of what it was made from in *both*
//! qualities: data, drawing and section. A draft run sees every change of model, drawing, caption, claims and
//! printed numbers. It does not see one that only the paper grids feel, nor one of the page's head
//! (docs/contributing.md).

use std::collections::BTreeMap;

use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::store::{Provenance, StorageError};
use bouncing_disk_plot::DrawError;
use minijinja::{Value, context};
use serde::{Deserialize, Serialize};

use super::counts::Counts;
use super::{Section, TemplateError, digits, environment};
use crate::claims::{self, Claim};
use crate::experiment::{ExperimentError, Made, Quality, Record};
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

/// The template of the errata. The numbers that it writes out are printed in the paper: a test reads all of them. A number of ours is one of the data of a figure, `{{ fig06.merging.axial_forcing|number(".7") }}`, or
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
    /// A figure cannot be drawn.
    #[error("{id}")]
    Figure {
        /// The figure.
        id: String,
        /// The error.
        source: Box<ExperimentError>,
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

/// A figure with its section of the page.
struct Figure<'a> {
    made: &'a Made,
    section: String,
    /// The drawing as a vector file.
    vector: String,
    digest: String,
}

impl<'a> Figure<'a> {
    fn of(made: &'a Made) -> Result<Self, PagesError> {
        let record = &made.record;
        let drawing = made.figure.to_svg().map_err(|error| failed(made, error))?;
        let vector = provenance::in_svg(&record.provenance, &drawing);
        let values = Value::from_serialize(Section::of(record));
        let section = digits::rounded(&environment().render_named_str("section.md", SECTION, values)?);
        // Another version of the program does not make another figure, and the section has the claims.
        let mut stored = serde_json::to_value(record).unwrap_or_default();
        if let Some(members) = stored.as_object_mut() {
            members.retain(|name, _| !["provenance", "claims", "discussion"].contains(&name.as_str()));
        }
        let digest = digest([json::to_text(&stored), drawing, section.clone()].concat().as_bytes());
        Ok(Self { made, section, vector, digest })
    }

    /// The file of the picture.
    fn picture(&self) -> Result<Vec<u8>, PagesError> {
        let mut picture = Vec::new();
        for width in PICTURE_WIDTHS {
            picture = self.made.figure.to_png_within(width).map_err(|error| failed(self.made, error))?;
            if picture.len() <= LARGEST_PICTURE {
                break;
            }
        }
        Ok(picture)
    }
}

fn failed(made: &Made, error: DrawError) -> PagesError {
    PagesError::Figure { id: made.record.id.clone(), source: Box::new(error.into()) }
}

/// Writes the pages, the pictures and their digests into `docs` from all figures in paper quality and in draft quality:
/// nothing before everything is drawn, and the digests, which all is compared with, last.
pub fn write(paper: &[Made], draft: &[Made], docs: &OutputFolder) -> Result<(), PagesError> {
    write_with(ERRATA, [paper, draft], docs)
}

fn write_with(errata: &str, [paper, draft]: [&[Made]; 2], docs: &OutputFolder) -> Result<(), PagesError> {
    let folder = OutputFolder::create(docs.path().join(PICTURES_FOLDER))?;
    let origin = provenance::new(provenance::DIGESTS).with("quality", &Quality::Paper).map_err(Box::new)?;
    let mut digests = Digests { provenance: origin, pages: BTreeMap::new(), figures: BTreeMap::new() };
    let (mut figures, mut files) = (Vec::new(), Vec::new());
    for (made, drafted) in paper.iter().zip(draft) {
        let (id, figure) = (&made.record.id, Figure::of(made)?);
        let picture = figure.picture()?;
        let known = FigureDigests {
            draft: Figure::of(drafted)?.digest,
            paper: figure.digest.clone(),
            picture: digest(&picture),
            vector: digest(figure.vector.as_bytes()),
        };
        files.push((format!("{id}.svg"), figure.vector.clone().into_bytes()));
        digests.figures.insert(id.clone(), known);
        files.push((format!("{id}.png"), picture));
        figures.push(figure);
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

/// Names of committed files that are missing, were edited, or were made from other figures than these.
pub fn outdated(figures: &[Made], docs: &OutputFolder) -> Result<Vec<String>, PagesError> {
    outdated_with(ERRATA, figures, docs)
}

fn outdated_with(errata: &str, figures: &[Made], docs: &OutputFolder) -> Result<Vec<String>, PagesError> {
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
    for made in figures {
        let id = &made.record.id;
        let known = digests.as_ref().and_then(|digests| digests.figures.get(id));
        let known = known.cloned().unwrap_or_default();
        let expected = if made.record.quality == Quality::Draft { &known.draft } else { &known.paper };
        let current = Figure::of(made)?.digest == *expected;
        let file = |ending: &str| folder.read(&format!("{id}.{ending}"));
        let whole = |bytes: Option<Vec<u8>>, known: &str| bytes.is_some_and(|bytes| digest(&bytes) == known);
        if !current || !whole(file("png")?, &known.picture) || !whole(file("svg")?, &known.vector) {
            outdated.push(format!("{PICTURES_FOLDER}/{id}.png"));
        }
    }
    Ok(outdated)
}

fn results(figures: &[Figure<'_>]) -> Result<String, TemplateError> {
    let all = Counts::of(figures.iter().flat_map(|figure| &figure.made.record.claims));
    let row = |figure: &Figure<'_>| {
        let Record { id, claims, .. } = &figure.made.record;
        context! { id, name => super::name(id), counts => Counts::of(claims).row() }
    };
    let values = context! {
        headline => all.headline(),
        beside => all.beside(),
        figures => figures.iter().map(row).collect::<Vec<_>>(),
        together => all.row(),
        sections => figures.iter().map(|figure| figure.section.as_str()).collect::<Vec<_>>(),
    };
    environment().render_named_str("results.md", RESULTS, values)
}

/// The errata with the numbers of the figures and claims.
fn filled(template: &str, figures: &[Figure<'_>]) -> Result<String, TemplateError> {
    let cited = environment().template_from_str(template)?.undeclared_variables(false);
    let records = || figures.iter().map(|figure| &figure.made.record);
    let cited = records().filter(|record| cited.contains(&record.id));
    let mut values: BTreeMap<&str, Value> =
        cited.map(|record| (record.id.as_str(), Value::from_serialize(&record.data))).collect();
    let claims = records().flat_map(|record| &record.claims);
    values.insert("claims", Value::from_serialize(claim_numbers(claims)));
    let page = environment().render_named_str(ERRATA_FILE, template, Value::from_serialize(values))?;
    Ok(digits::rounded(&page))
}

/// The numbers of the claims that answer entries of the catalogue, by key: shares where a statement is judged
/// by them.
fn claim_numbers<'a>(claims: impl IntoIterator<Item = &'a Claim>) -> BTreeMap<&'a str, f64> {
    let number = |claim: &'a Claim| {
        let key = claim.key.as_deref()?;
        let number = match claim.computed {
            claims::Computed::Number(number) => Some(number),
            _ => claim.share,
        };
        Some((key, number?))
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

    struct Docs {
        _scratch: tempfile::TempDir,
        paper: [Made; 1],
        draft: [Made; 1],
        docs: OutputFolder,
    }

    fn demo(quality: Quality) -> Made {
        demo_entries()[0].compute(quality, &Silent).expect("works")
    }

    impl Docs {
        fn new() -> Self {
            let scratch = tempfile::tempdir().expect("writable");
            let docs = OutputFolder::create(scratch.path()).expect("writable");
            Self { _scratch: scratch, paper: [demo(Quality::Paper)], draft: [demo(Quality::Draft)], docs }
        }

        fn write(&self) {
            write_with(PROSE, [&self.paper, &self.draft], &self.docs).expect("writable");
        }

        fn outdated(&self, quality: Quality) -> Vec<String> {
            let made = quality.choose(&self.draft, &self.paper);
            outdated_with(PROSE, made, &self.docs).expect("readable")
        }
    }

    #[test]
    fn the_page_holds_picture_discussion_parameters_and_verdicts() {
        let made = demo(Quality::Paper);
        let figure = || [Figure::of(&made).expect("draws")];
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

    /// The README and the book's page on the rules state the numbers of verdicts that the results count.
    #[test]
    fn other_pages_count_like_the_results() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let read = |name: &str| std::fs::read_to_string(root.join(name)).expect("committed");
        let page = read("docs/results.md");
        let (headline, beside) =
            page.lines().find_map(|line| line.strip_prefix("**Of ")?.split_once("**")).expect("a headline");
        let motors = &beside[beside.find("Of ").expect("the motors")..];
        for (name, sentences) in
            [("README.md", vec![headline]), ("docs/reproducing.md", vec![headline, motors])]
        {
            let text = read(name).replace('\n', " ");
            for sentence in sentences {
                assert!(text.contains(sentence), "{name}: {sentence}");
            }
        }
    }

    #[test]
    fn every_way_to_be_out_of_date_is_seen() {
        use Quality::{Draft, Paper};
        const PICTURE: &str = "figures/demo.png";
        let mut docs = Docs::new();
        let folder = OutputFolder::existing(docs.docs.path().join(PICTURES_FOLDER));
        let all = [RESULTS_FILE, ERRATA_FILE, PICTURE];
        assert_eq!(docs.outdated(Draft), all);
        docs.write();
        let current = |docs: &Docs| [Draft, Paper].iter().all(|quality| docs.outdated(*quality).is_empty());
        assert!(current(&docs));
        for page in [RESULTS_FILE, ERRATA_FILE] {
            docs.docs.write(page, b"edited").expect("writable");
            assert_eq!(docs.outdated(Draft), [page]);
            docs.write();
        }
        for file in ["demo.png", "demo.svg"] {
            folder.write(file, b"edited").expect("writable");
            assert_eq!(docs.outdated(Draft), [PICTURE]);
            docs.write();
        }
        // Figures that have not been made are not compared; a changed template and a changed figure of the draft
        // alone are detected.
        let unmade = outdated_with(PROSE, &[], &docs.docs);
        assert!(unmade.expect("readable").is_empty() && current(&docs));
        let other = outdated_with("", &[], &docs.docs);
        assert_eq!(other.expect("readable"), [ERRATA_FILE]);
        docs.draft[0].record.data["axial_forcing"][0] = 0.31.into();
        assert_eq!(docs.outdated(Draft), [PICTURE]);
        assert!(docs.outdated(Paper).is_empty());
        folder.write(DIGESTS_FILE, b"").expect("writable");
        assert_eq!(docs.outdated(Paper), all);
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
