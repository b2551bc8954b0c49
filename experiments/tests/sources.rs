//! What the figures are made from, by the build script.

#[expect(dead_code, clippy::print_stdout, reason = "what only cargo calls, and tells it what to watch")]
#[path = "../build.rs"]
mod build;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// The members of the workspace that a package is built with, and the folder of each, as cargo knows them.
fn built_with(package: &str, metadata: &Value, folders: &mut BTreeSet<PathBuf>) {
    let packages = metadata["packages"].as_array().expect("a list");
    let own = packages.iter().find(|one| one["name"] == package).expect("a member");
    for dependency in own["dependencies"].as_array().expect("a list") {
        let Some(folder) = dependency["path"].as_str() else { continue };
        if folders.insert(folder.into()) {
            built_with(dependency["name"].as_str().expect("a name"), metadata, folders);
        }
    }
}

/// The page, the command line and the Python package write into their folders while they are built.
#[test]
fn figures_depend_on_the_libraries_and_on_no_program_that_uses_them() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut named = BTreeSet::new();
    build::named_libraries(package, &package.with_file_name("crates"), &mut named).expect("manifests");
    let metadata = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--format-version=1", "--offline"])
        .current_dir(package)
        .output()
        .expect("cargo");
    let metadata = serde_json::from_slice(&metadata.stdout).expect("JSON");
    let mut expected = BTreeSet::new();
    built_with(env!("CARGO_PKG_NAME"), &metadata, &mut expected);
    assert!(!expected.is_empty());
    assert_eq!(named, expected);
}
