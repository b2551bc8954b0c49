//! The committed results page and pictures.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use bouncing_disk_experiments::registry;
use bouncing_disk_experiments::report::pages::{
    DIGESTS_FILE, Digests, LARGEST_PICTURE, LARGEST_VECTOR, Pictures, digest, templates,
};

/// All pictures of a folder together may be so large (bytes).
const ALL_PICTURES: usize = 4_000_000;

fn docs(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs")).join(name)
}

#[test]
fn the_committed_files_are_those_that_were_generated_and_small() {
    for (pictures, entries, command) in [
        (Pictures::Paper, registry::paper(), "cargo xtask figures --docs"),
        (Pictures::Extras, registry::extras(), "cargo xtask figures --extras --docs"),
    ] {
        let folder = docs(pictures.folder());
        let digests = fs::read(folder.join(DIGESTS_FILE)).expect("the digests are committed");
        let digests: Digests = serde_json::from_slice(&digests).expect("written by this version");
        let templates = BTreeMap::from(templates());
        for (name, expected) in &digests.pages {
            let own = templates.get(name).cloned();
            let own = own.unwrap_or_else(|| digest(&fs::read(docs(name)).expect("the page is committed")));
            assert_eq!(own, *expected, "{name} was edited; to repair: {command}");
        }
        let mut ids: Vec<_> = entries.iter().map(|entry| entry.id).collect();
        ids.sort_unstable();
        assert!(digests.figures.keys().eq(&ids), "to repair: {command}");
        let mut together = 0;
        for (id, digests) in &digests.figures {
            let picture = fs::read(folder.join(format!("{id}.png"))).expect("the picture is committed");
            assert_eq!(digest(&picture), digests.picture, "{id}.png was edited");
            assert!(picture.len() <= LARGEST_PICTURE, "{id}.png has {} bytes", picture.len());
            together += picture.len();
            if let Some(expected) = &digests.vector {
                let vector =
                    fs::read(folder.join(format!("{id}.svg"))).expect("the vector file is committed");
                assert_eq!(digest(&vector), *expected, "{id}.svg was edited");
                assert!(vector.len() <= LARGEST_VECTOR, "{id}.svg has {} bytes", vector.len());
            }
        }
        assert!(together <= ALL_PICTURES, "the pictures have {together} bytes");
    }
}

#[test]
fn the_citation_is_of_this_version() {
    let citation = fs::read_to_string(docs("../CITATION.cff")).expect("committed");
    let version = format!("\nversion: {}\n", env!("CARGO_PKG_VERSION"));
    assert!(citation.contains(&version) && citation.contains("\n    doi: 10.1103/PhysRevE.80.046201\n"));
}
