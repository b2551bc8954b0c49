//! The committed results page and its pictures.

use std::fs;
use std::path::PathBuf;

use bouncing_disk_experiments::errata::{ERRATA_FILE, TEMPLATE};
use bouncing_disk_experiments::registry;
use bouncing_disk_experiments::results::{
    DIGESTS_FILE, Digests, PICTURES_FOLDER, RESULTS_FILE, digest, picture_digest,
};

/// A picture may be this large (bytes), and all together so large.
const LARGEST_PICTURE: usize = 300_000;
const ALL_PICTURES: usize = 4_000_000;

fn docs(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs")).join(name)
}

#[test]
fn the_committed_files_are_those_that_were_generated_and_small() {
    let pictures = docs(PICTURES_FOLDER);
    let digests = fs::read(pictures.join(DIGESTS_FILE)).expect("the digests are committed");
    let digests: Digests = serde_json::from_slice(&digests).expect("written by this version");
    let page = fs::read(docs(RESULTS_FILE)).expect("the page is committed");
    assert_eq!(digest(&page), digests.results, "{RESULTS_FILE} was edited");
    let errata = fs::read(docs(ERRATA_FILE)).expect("the errata are committed");
    assert_eq!(
        digest(&errata),
        digests.errata,
        "{ERRATA_FILE} was edited: it is made from experiments/src/errata.md"
    );
    assert_eq!(digest(TEMPLATE.as_bytes()), digests.errata_template, "to repair: cargo xtask figures --docs");
    let known: Vec<_> = digests.figures.keys().map(String::as_str).collect();
    let mut ids: Vec<_> = registry::paper().iter().map(|entry| entry.id()).collect();
    ids.sort_unstable();
    assert_eq!(known, ids, "to repair: cargo xtask figures --docs");
    let mut together = 0;
    for (id, digests) in &digests.figures {
        let picture = fs::read(pictures.join(format!("{id}.png"))).expect("the picture is committed");
        assert_eq!(picture_digest(&picture), digests.picture, "{id}.png was edited");
        assert!(picture.len() <= LARGEST_PICTURE, "{id}.png has {} bytes", picture.len());
        together += picture.len();
    }
    assert!(together <= ALL_PICTURES, "the pictures have {together} bytes");
}
