//! `docs/extras`: the pictures of the figures beyond the paper, which pages of the book show.

use std::collections::BTreeMap;

use bouncing_disk::Provenance;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::committed_picture::{FigureDigests, MadeFiles, picture_name};
use crate::experiment::{Quality, RegisteredExperiment};
use crate::output::OutputFolder;
use crate::provenance;
use crate::results::{DIGESTS_FILE, ResultsError};

/// Their folder, in that of the documentation.
pub const EXTRAS_FOLDER: &str = "extras";

/// What the committed pictures were made from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Digests {
    /// Which version of the program wrote them.
    pub provenance: Option<Provenance>,
    /// By identifier of the figure.
    pub figures: BTreeMap<String, FigureDigests>,
}

/// Writes the pictures and their digests into `docs` from the figures in both output folders.
///
/// # Errors
///
/// When a figure is missing in one of them or cannot be drawn, or the system refuses.
pub fn write(
    entries: &[&dyn RegisteredExperiment],
    paper: &OutputFolder,
    draft: &OutputFolder,
    docs: &OutputFolder,
) -> Result<(), ResultsError> {
    let folder = OutputFolder::create(docs.path().join(EXTRAS_FOLDER))?;
    let provenance = Some(provenance::new(provenance::DIGESTS).with("quality", &Quality::Paper)?);
    let mut digests = Digests { provenance, figures: BTreeMap::new() };
    let mut files = Vec::new();
    // No other run may put figures of its own there meanwhile.
    let _held = (draft.lock()?, paper.lock()?);
    for entry in entries {
        let id = entry.id();
        let draft = MadeFiles::read(*entry, draft, Quality::Draft)?.digest_with("");
        let made = MadeFiles::read(*entry, paper, Quality::Paper)?;
        let (picture, bytes) = made.picture(id)?;
        files.push((picture_name(id), bytes));
        let figure = FigureDigests { draft, paper: made.digest_with(""), picture };
        digests.figures.insert(id.to_owned(), figure);
    }
    let mut text = serde_json::to_vec_pretty(&digests).map_err(ResultsError::Digests)?;
    text.push(b'\n');
    files.push((DIGESTS_FILE.to_owned(), text));
    let files: Vec<_> = files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
    Ok(folder.lock()?.write(&files)?)
}

/// Names of committed pictures that are missing, were edited, or were made from other figures than those of `quality`
/// in `made`. Of figures that have not been made there, the picture's file alone is checked.
///
/// # Errors
///
/// When a file exists and cannot be read.
pub fn outdated(
    entries: &[&dyn RegisteredExperiment],
    quality: Quality,
    made: &OutputFolder,
    docs: &OutputFolder,
) -> Result<Vec<String>, ResultsError> {
    let folder = OutputFolder::existing(docs.path().join(EXTRAS_FOLDER));
    let stored = folder.read(DIGESTS_FILE)?;
    let stored: Value =
        stored.as_deref().and_then(|bytes| serde_json::from_slice(bytes).ok()).unwrap_or_default();
    provenance::refuse_newer(provenance::DIGESTS, stored.get("provenance"), DIGESTS_FILE)?;
    let digests = Digests::deserialize(stored).unwrap_or_default();
    let mut outdated = Vec::new();
    for entry in entries {
        let id = entry.id();
        let known = digests.figures.get(id).cloned().unwrap_or_default();
        let made = MadeFiles::read(*entry, made, quality).map(|made| made.digest_with(""));
        if !known.is_current(made, quality, folder.read(&picture_name(id))?)? {
            outdated.push(format!("{EXTRAS_FOLDER}/{}", picture_name(id)));
        }
    }
    Ok(outdated)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::artifacts;
    use crate::measured::Measurements;
    use crate::progress::Silent;
    use crate::testing::demo_entries;

    #[test]
    fn every_way_to_be_out_of_date_is_seen() {
        let path = std::env::temp_dir().join(format!("bouncing-disk-extras-{}", std::process::id()));
        let create = |name: &str| OutputFolder::create(path.join(name)).expect("writable");
        let (paper, draft, docs) = (create("paper"), create("draft"), create("docs"));
        let nothing = create("nothing");
        let all = demo_entries();
        let entries = [&*all[0]];
        assert!(matches!(write(&entries, &paper, &draft, &docs), Err(ResultsError::Missing { .. })));
        for (folder, quality) in [(&paper, Quality::Paper), (&draft, Quality::Draft)] {
            let files = artifacts::make(entries[0], quality, &Measurements::none(), &Silent).expect("works");
            folder.write_set("demo", quality, "", 0.1, &files).expect("writable");
        }
        let found = |quality, folder| outdated(&entries, quality, folder, &docs).expect("readable");
        let picture = [format!("{EXTRAS_FOLDER}/demo.png")];
        assert_eq!(found(Quality::Draft, &draft), picture);
        write(&entries, &paper, &draft, &docs).expect("writable");
        assert!(found(Quality::Draft, &draft).is_empty() && found(Quality::Paper, &paper).is_empty());
        // What has not been made is not compared.
        assert!(found(Quality::Draft, &nothing).is_empty());
        let pictures = OutputFolder::existing(docs.path().join(EXTRAS_FOLDER));
        pictures.write("demo.png", b"edited").expect("writable");
        assert_eq!(found(Quality::Draft, &draft), picture);
        write(&entries, &paper, &draft, &docs).expect("writable");
        draft.write("demo.svg", b"<svg/>").expect("writable");
        assert_eq!(found(Quality::Draft, &draft), picture);
        assert!(found(Quality::Paper, &paper).is_empty());
        assert!(matches!(write(&entries, &paper, &draft, &docs), Err(ResultsError::Changed { .. })));
        pictures.write(DIGESTS_FILE, b"").expect("writable");
        assert_eq!(found(Quality::Paper, &paper), picture);
        std::fs::remove_dir_all(path).expect("a folder");
    }
}
