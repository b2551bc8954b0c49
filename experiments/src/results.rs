//! `docs/results.md`: figure by figure the picture, what it shows, the parameters, and printed against computed.
//!
//! The page and its pictures are committed, made in paper quality. Whether they are out of date must be known without
//! the minutes that takes: [`Digests`], written with them, holds for each figure a digest of what it was made from in
//! *both* qualities, data, drawing and text. A draft run sees every change of model, drawing, caption, claims and printed
//! numbers. It does not see one that only the paper grids feel, nor one of the page's head (docs/architecture.md).

use std::collections::BTreeMap;
use std::fmt::Write as _;

use bouncing_disk::{Provenance, StorageError};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::claim::{Claim, Class, Computed, Source, Verdict};
use crate::committed_picture::{FigureDigests, MadeFiles, digest, picture_name};
use crate::count::Counts;
use crate::digits;
use crate::errata::{self, ERRATA_FILE, ErrataError};
use crate::experiment::{ErasedData, ExperimentError, Quality, RegisteredExperiment, chain};
use crate::output::{OutputError, OutputFolder};
use crate::page::{ClaimTexts, class_words, like, name, verdict_words};
use crate::provenance;

/// The page, in the folder of the documentation.
pub const RESULTS_FILE: &str = "results.md";
/// The folder of its pictures, beside it.
pub const PICTURES_FOLDER: &str = "figures";
/// The digests, in the folder of the pictures.
pub const DIGESTS_FILE: &str = "digests.json";

/// Why the page could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultsError {
    /// A figure that the page needs is not there or cannot be drawn.
    #[error("{id}")]
    Figure {
        /// The figure.
        id: String,
        /// What went wrong.
        source: ExperimentError,
    },
    /// There are no files of a figure in the output folder.
    #[error("{id} has not been made")]
    Missing {
        /// The figure.
        id: String,
    },
    /// The files of a figure are not those that were written for the page.
    #[error(
        "the files of {id} were changed since they were made, or made again in another quality or with measurements"
    )]
    Changed {
        /// The figure.
        id: String,
    },
    /// A discussion names an entry of the catalogue that no claim of the figure compares by a number.
    #[error("the discussion of {id} names {key}, which no claim of it compares by a number")]
    Reading {
        /// The figure.
        id: String,
        /// The entry.
        key: String,
    },
    /// The errata refer to a number that is not there.
    #[error("docs/errata.md")]
    Errata(#[from] ErrataError),
    /// A file cannot be read or written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The digests cannot be written as JSON.
    #[error("cannot write the digests")]
    Digests(#[source] serde_json::Error),
    /// What a file says of its origin cannot be stored, or is of a newer format.
    #[error(transparent)]
    Provenance(Box<StorageError>),
}

impl From<StorageError> for ResultsError {
    fn from(error: StorageError) -> Self {
        Self::Provenance(Box::new(error))
    }
}

/// What the committed page and pictures were made from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Digests {
    /// Which version of the program wrote it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub provenance: Option<Provenance>,
    /// Digest of the page.
    pub results: String,
    /// Digest of the errata page.
    #[serde(default)]
    pub errata: String,
    /// Digest of the template that it was made from.
    #[serde(default)]
    pub errata_template: String,
    /// By identifier of the figure.
    pub figures: BTreeMap<String, FigureDigests>,
}

/// A figure as it lies in an output folder, with its section of the page.
struct Made {
    files: MadeFiles,
    digest: String,
    section: String,
}

fn made(
    entry: &dyn RegisteredExperiment,
    folder: &OutputFolder,
    quality: Quality,
) -> Result<Made, ResultsError> {
    let files = MadeFiles::read(entry, folder, quality)?;
    let section = section(entry, &*files.outcome)?;
    let digest = files.digest_with(&section);
    Ok(Made { files, digest, section })
}

/// Writes the page, the errata from their template, the pictures and their digests into `docs` from the figures in both output folders:
/// nothing before everything is drawn, and the digests, which all is compared with, last.
///
/// # Errors
///
/// When a figure is missing in one of them or cannot be drawn, the errata refer to what is not there, or the system refuses.
pub fn write(
    errata: &str,
    entries: &[Box<dyn RegisteredExperiment>],
    paper: &OutputFolder,
    draft: &OutputFolder,
    docs: &OutputFolder,
) -> Result<(), ResultsError> {
    let pictures = OutputFolder::create(docs.path().join(PICTURES_FOLDER))?;
    let provenance = Some(provenance::new(provenance::DIGESTS).with("quality", &Quality::Paper)?);
    let mut digests = Digests { provenance, ..Digests::default() };
    let cited = errata::figures(errata);
    let mut data = BTreeMap::new();
    let (mut sections, mut claims, mut files) = (String::new(), Vec::new(), Vec::new());
    // No other run may put figures of its own there meanwhile.
    let _held = (draft.lock()?, paper.lock()?);
    for entry in entries {
        let id = entry.id();
        let failed = |source: ExperimentError| ResultsError::Figure { id: id.to_owned(), source };
        let made_in_draft = made(&**entry, draft, Quality::Draft)?;
        let made = made(&**entry, paper, Quality::Paper)?;
        let (picture, bytes) = made.files.picture(id)?;
        let figure = FigureDigests { draft: made_in_draft.digest, paper: made.digest, picture };
        files.push((picture_name(id), bytes));
        digests.figures.insert(id.to_owned(), figure);
        sections.push_str(&made.section);
        let outcome = &made.files.outcome;
        if cited.contains(&id) {
            data.insert(id, outcome.to_json().map_err(failed)?);
        }
        claims.push((id, outcome.claims()));
    }
    let page = format!("{}{sections}", head(&claims));
    digests.results = digest(page.as_bytes());
    let numbers = errata::claim_numbers(claims.iter().flat_map(|(_, claims)| claims));
    let errata_page = errata::filled(errata, |id| {
        if id == errata::CLAIMS { Some(numbers.clone()) } else { data.get(id).cloned() }
    })?;
    let errata_page = digits::rounded(&errata_page);
    digests.errata = digest(errata_page.as_bytes());
    digests.errata_template = digest(errata.as_bytes());
    let mut text = serde_json::to_vec_pretty(&digests).map_err(ResultsError::Digests)?;
    text.push(b'\n');
    files.push((DIGESTS_FILE.to_owned(), text));
    let files: Vec<_> = files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
    // Page and pictures of one run.
    let locked = docs.lock()?;
    locked.write(&[(RESULTS_FILE, page.as_bytes()), (ERRATA_FILE, errata_page.as_bytes())])?;
    Ok(pictures.lock()?.write(&files)?)
}

/// Names of committed files that are missing, were edited, or were made from other figures than those of `quality`
/// in `folder`. Of figures that have not been made there, the picture's file alone is checked.
///
/// # Errors
///
/// When a file exists and cannot be read.
pub fn outdated(
    errata: &str,
    entries: &[&dyn RegisteredExperiment],
    quality: Quality,
    folder: &OutputFolder,
    docs: &OutputFolder,
) -> Result<Vec<String>, ResultsError> {
    let pictures = OutputFolder::existing(docs.path().join(PICTURES_FOLDER));
    let stored = pictures.read(DIGESTS_FILE)?;
    let stored: Value =
        stored.as_deref().and_then(|bytes| serde_json::from_slice(bytes).ok()).unwrap_or_default();
    provenance::refuse_newer(provenance::DIGESTS, stored.get("provenance"), DIGESTS_FILE)?;
    let digests = Digests::deserialize(stored).unwrap_or_default();
    let mut outdated = Vec::new();
    let page = docs.read(RESULTS_FILE)?;
    if page.is_none_or(|page| digest(&page) != digests.results) {
        outdated.push(RESULTS_FILE.to_owned());
    }
    let errata_page = docs.read(ERRATA_FILE)?;
    if errata_page.is_none_or(|page| digest(&page) != digests.errata)
        || digest(errata.as_bytes()) != digests.errata_template
    {
        outdated.push(ERRATA_FILE.to_owned());
    }
    for entry in entries {
        let id = entry.id();
        let known = digests.figures.get(id).cloned().unwrap_or_default();
        let made = made(*entry, folder, quality).map(|made| made.digest);
        if !known.is_current(made, quality, pictures.read(&picture_name(id))?)? {
            outdated.push(format!("{PICTURES_FOLDER}/{}", picture_name(id)));
        }
    }
    Ok(outdated)
}

/// What the classes mean.
const CLASSES: &str = "\
    A row of class *paper* is a number or a statement of the paper, and only these count for or against it. *Fitted*: a parameter of ours was\n\
    chosen so that the number comes out. *Input*: a parameter, a choice, a measurement or a quotation, with nothing to compute. *Identity*: true by\n\
    construction, a definition or an equation that the code implements, or one printed number against another. *This work*: a further reading of a\n\
    printed number, or a finding that the paper does not have. Each row of class *paper* is of a kind, and the rule of its kind decides it:\n\
    [judging.md](judging.md). Rows are not causes: several may differ for one reason, which each of them names.\n";

/// Title, explanation and the table of verdicts.
fn head(claims: &[(&str, Vec<Claim>)]) -> String {
    let mut text = "# Results\n\n\
        Every figure and table of K.-C. Liu, J. Friend and L. Yeo, Phys. Rev. E **80**, 046201 (2009), computed anew, and every number\n\
        and testable statement that the paper prints, compared with ours. A number counts as reproduced when ours agrees within half a unit\n\
        of its last printed digit, unless another tolerance is given. Why a number differs stands in its note and in [errata.md](errata.md).\n\
        This page is generated in paper quality by `cargo xtask figures --docs`; `cargo xtask figures --check` says whether it is up to date.\n\n\
"
        .to_owned();
    let rows: Vec<_> = claims.iter().map(|(id, claims)| (*id, Counts::of(claims))).collect();
    let total = rows.iter().fold(Counts::default(), |total, (_, counts)| total.and(counts));
    let _ = writeln!(text, "**{}** {}\n", total.headline(), total.beside());
    text.push_str(CLASSES);
    text.push_str("\n| | ");
    text.push_str("reproduced | differs | depends on unprinted digits | no data | fitted | input | identity | this work |\n");
    text.push_str("| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
    let mut row = |name: &str, counts: &Counts| {
        let of_paper = Verdict::ALL.map(|verdict| counts.count(Class::Paper, verdict));
        let beside = [Class::Fitted, Class::Input, Class::Identity, Class::ThisWork];
        let numbers = of_paper.into_iter().chain(beside.map(|class| counts.of_class(class)));
        let cells = numbers.map(|number| number.to_string()).collect::<Vec<_>>().join(" | ");
        let _ = writeln!(text, "| {name} | {cells} |");
    };
    for (id, counts) in &rows {
        row(&format!("[{}](#{id})", name(id)), counts);
    }
    row("together", &total);
    text
}

/// The section of one figure.
fn section(entry: &dyn RegisteredExperiment, outcome: &dyn ErasedData) -> Result<String, ResultsError> {
    let (id, title, claims) = (entry.id(), entry.title(), outcome.claims());
    let discussion = discussion(id, outcome.discussion(), &claims)?;
    let mut text = format!(
        "\n<a id=\"{id}\"></a>\n\n## {}. {title}\n\n![{title}]({PICTURES_FOLDER}/{})\n\n{discussion}\n\n*Caption.* {}\n",
        name(id),
        picture_name(id),
        outcome.caption()
    );
    let parameters = outcome.parameters();
    if !parameters.is_empty() {
        text.push_str("\n| parameter | value |\n| --- | --- |\n");
        for (name, value) in parameters {
            let _ = writeln!(text, "| {} | {} |", cell(&name), cell(&value));
        }
    }
    if !claims.is_empty() {
        text.push_str(
            "\n| place | quantity | printed | computed | tolerance | class | verdict | note |\n\
             | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        );
    }
    for claim in &claims {
        let ClaimTexts { computed, printed, tolerance } = ClaimTexts::new(claim);
        let words = verdict_words(claim);
        let verdict = match words.strip_prefix("differs") {
            Some(rest) => format!("**differs**{rest}"),
            None => words,
        };
        let class = class_words(claim);
        let left =
            [claim.place(), claim.quantity(), &printed, &computed, &tolerance, &class].map(cell).join(" | ");
        let _ = writeln!(text, "| {left} | {verdict} | {} |", cell(claim.remarks()));
    }
    Ok(digits::rounded(&text))
}

/// The text of a cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ").replace('*', "\\*")
}

/// The paragraph with the computed numbers put in, to four digits.
fn discussion(id: &str, template: &str, claims: &[Claim]) -> Result<String, ResultsError> {
    let mut text = String::new();
    let mut rest = template.trim();
    while let Some((before, after)) = rest.split_once('{') {
        let Some((key, behind)) = after.split_once('}') else { break };
        let answers = |claim: &&Claim| matches!(claim.source(), Source::Entry(own) | Source::Reading(own) if own == key);
        let Some((claim, Computed::Number(number))) =
            claims.iter().find(answers).map(|claim| (claim, claim.computed()))
        else {
            return Err(ResultsError::Reading { id: id.to_owned(), key: key.to_owned() });
        };
        text.push_str(before);
        text.push_str(&like(claim.printed_text(), *number, 4));
        rest = behind;
    }
    text.push_str(rest);
    Ok(text)
}

/// All causes of an error, for a program that prints it.
pub fn explained(error: &ResultsError) -> String {
    chain(error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::artifacts;
    use crate::measured::Measurements;
    use crate::progress::Silent;
    use crate::testing::demo_entries;

    const ERRATA: &str = "The last phase is {demo:/impact_phase_rad/0:.2}.\n";

    struct Folders {
        paper: OutputFolder,
        draft: OutputFolder,
        docs: OutputFolder,
    }

    fn folders(test: &str) -> (Folders, Vec<Box<dyn RegisteredExperiment>>) {
        let path = std::env::temp_dir().join(format!("bouncing-disk-results-{test}-{}", std::process::id()));
        let create = |name: &str| OutputFolder::create(path.join(name)).expect("writable");
        let folders = Folders { paper: create("paper"), draft: create("draft"), docs: create("docs") };
        let mut entries = demo_entries();
        entries.truncate(1);
        for (folder, quality) in [(&folders.paper, Quality::Paper), (&folders.draft, Quality::Draft)] {
            let files =
                artifacts::make(&*entries[0], quality, &Measurements::none(), &Silent).expect("works");
            folder.write_set("demo", quality, "", 0.1, &files).expect("writable");
        }
        write(ERRATA, &entries, &folders.paper, &folders.draft, &folders.docs).expect("writable");
        (folders, entries)
    }

    fn check(folders: &Folders, entries: &[Box<dyn RegisteredExperiment>], quality: Quality) -> Vec<String> {
        let folder = match quality {
            Quality::Draft => &folders.draft,
            Quality::Paper => &folders.paper,
        };
        let entries: Vec<&dyn RegisteredExperiment> = entries.iter().map(|entry| &**entry).collect();
        outdated(ERRATA, &entries, quality, folder, &folders.docs).expect("readable")
    }

    #[test]
    fn the_page_holds_picture_discussion_parameters_and_verdicts() {
        let (folders, entries) = folders("page");
        let page = folders.docs.read(RESULTS_FILE).expect("readable").expect("written");
        let page = String::from_utf8(page).expect("text");
        assert!(page.contains("![A demonstration](figures/demo.png)"), "{page}");
        assert!(page.contains("It shows that | is escaped."), "{page}");
        let errata = folders.docs.read(ERRATA_FILE).expect("readable").expect("written");
        assert_eq!(errata, b"The last phase is 0.09.\n");
        assert!(page.contains("| restitution ε | 0.5 |"), "{page}");
        assert!(page.contains("| Sec. 1 | last phase | 0.36\u{a0}rad |"), "{page}");
        assert!(page.contains("| together | 0 | 0 | 0 | 0 | 0 | 0 | 0 | 1 |"), "{page}");
        assert!(page.contains("| this work | agrees |"), "{page}");
        for quality in [Quality::Draft, Quality::Paper] {
            assert!(check(&folders, &entries, quality).is_empty());
        }
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
        let (folders, entries) = folders("stale");
        let picture = "figures/demo.png".to_owned();
        folders.docs.write(ERRATA_FILE, b"edited").expect("writable");
        assert_eq!(check(&folders, &entries, Quality::Draft), [ERRATA_FILE.to_owned()]);
        let references: Vec<&dyn RegisteredExperiment> = entries.iter().map(|entry| &**entry).collect();
        write(ERRATA, &entries, &folders.paper, &folders.draft, &folders.docs).expect("writable");
        let other = outdated("Another text.", &references, Quality::Draft, &folders.draft, &folders.docs);
        assert_eq!(other.expect("readable"), [ERRATA_FILE.to_owned()]);
        let pictures = OutputFolder::existing(folders.docs.path().join(PICTURES_FOLDER));
        folders.docs.write(RESULTS_FILE, b"edited").expect("writable");
        assert_eq!(check(&folders, &entries, Quality::Draft), [RESULTS_FILE.to_owned()]);
        write(ERRATA, &entries, &folders.paper, &folders.draft, &folders.docs).expect("writable");
        pictures.write("demo.png", b"edited").expect("writable");
        assert_eq!(check(&folders, &entries, Quality::Draft), std::slice::from_ref(&picture));
        write(ERRATA, &entries, &folders.paper, &folders.draft, &folders.docs).expect("writable");
        // Another drawing of the draft alone.
        folders.draft.write("demo.svg", b"<svg/>").expect("writable");
        assert_eq!(check(&folders, &entries, Quality::Draft), std::slice::from_ref(&picture));
        assert!(check(&folders, &entries, Quality::Paper).is_empty());
        pictures.write(DIGESTS_FILE, b"").expect("writable");
        assert_eq!(
            check(&folders, &entries, Quality::Paper),
            [RESULTS_FILE.to_owned(), ERRATA_FILE.to_owned(), picture]
        );
    }

    /// Another run may make the figure again between the two steps of `--docs`.
    #[test]
    fn the_page_is_not_made_of_drafts_or_measurements() {
        let (folders, entries) = folders("other");
        let again = |quality: Quality, measured: &str| {
            let files =
                artifacts::make(&*entries[0], quality, &Measurements::none(), &Silent).expect("works");
            folders.paper.write_set("demo", quality, measured, 0.1, &files).expect("writable");
            write(ERRATA, &entries, &folders.paper, &folders.draft, &folders.docs)
        };
        assert!(matches!(again(Quality::Draft, ""), Err(ResultsError::Changed { .. })));
        assert!(matches!(again(Quality::Paper, "0123"), Err(ResultsError::Changed { .. })));
        assert!(again(Quality::Paper, "").is_ok());
    }

    #[test]
    fn a_discussion_takes_its_numbers_from_the_claims() {
        let claims = [Claim::printed("section4.merging", 0.560_750_7)];
        let text = discussion("fig06", "Lost at {section4.merging}, for good.", &claims).expect("answered");
        assert_eq!(text, "Lost at 0.5608, for good.");
        let error = discussion("fig06", "{section4.doubling_1}", &claims).expect_err("not answered");
        assert!(explained(&error).contains("section4.doubling_1"), "{error}");
    }
}
