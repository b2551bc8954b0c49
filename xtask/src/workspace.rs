//! Places in the workspace.

use std::path::{Path, PathBuf};

/// The documentation, relative to the root of the workspace.
pub(crate) const DOCS_FOLDER: &str = "docs";

/// A path relative to the root of the workspace, where the package of this program lies.
pub(crate) fn in_workspace(path: &str) -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).join(path)
}
