//! What the figures are made from, by the build script.

#[expect(dead_code, clippy::print_stdout, reason = "what only cargo calls, and tells it what to watch")]
#[path = "../build.rs"]
mod build;

use std::collections::BTreeSet;
use std::path::Path;

/// The page, the command line and the Python package write into their folders while they are built.
#[test]
fn figures_depend_on_the_libraries_and_on_no_program_that_uses_them() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = package.with_file_name("crates");
    let mut libraries = BTreeSet::new();
    build::named_libraries(package, &crates, &mut libraries).expect("manifests");
    let names = ["bouncing-disk", "bouncing-disk-core", "bouncing-disk-plot"];
    assert_eq!(libraries, names.map(|name| crates.join(name)).into());
}
