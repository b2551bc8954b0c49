//! The committed results page and pictures.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use bouncing_disk_experiments::committed_picture::{FigureDigests, LARGEST_PICTURE, digest, picture_digest};
use bouncing_disk_experiments::errata::{ERRATA_FILE, TEMPLATE};
use bouncing_disk_experiments::extra_pictures::{self, EXTRAS_FOLDER};
use bouncing_disk_experiments::registry;
use bouncing_disk_experiments::results::{DIGESTS_FILE, Digests, PICTURES_FOLDER, RESULTS_FILE};

/// All pictures of a folder together may be so large (bytes).
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
    let ids = registry::paper().iter().map(|entry| entry.id()).collect();
    check_pictures(PICTURES_FOLDER, &digests.figures, ids, "cargo xtask figures --docs");
}

#[test]
fn the_committed_pictures_of_extras_are_those_that_were_generated_and_small() {
    let digests = fs::read(docs(EXTRAS_FOLDER).join(DIGESTS_FILE)).expect("the digests are committed");
    let digests: extra_pictures::Digests = serde_json::from_slice(&digests).expect("written by this version");
    let ids = registry::extras().iter().map(|entry| entry.id()).collect();
    check_pictures(EXTRAS_FOLDER, &digests.figures, ids, "cargo xtask figures --extras --docs");
}

fn check_pictures(
    folder: &str,
    figures: &BTreeMap<String, FigureDigests>,
    mut ids: Vec<&str>,
    command: &str,
) {
    let known: Vec<_> = figures.keys().map(String::as_str).collect();
    ids.sort_unstable();
    assert_eq!(known, ids, "to repair: {command}");
    let mut together = 0;
    for (id, digests) in figures {
        let picture = fs::read(docs(folder).join(format!("{id}.png"))).expect("the picture is committed");
        assert_eq!(picture_digest(&picture), digests.picture, "{id}.png was edited");
        assert!(picture.len() <= LARGEST_PICTURE, "{id}.png has {} bytes", picture.len());
        together += picture.len();
    }
    assert!(together <= ALL_PICTURES, "the pictures of {folder} have {together} bytes");
}
