//! Places in the workspace.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result};

/// The documentation, relative to the root of the workspace.
#[cfg(feature = "figures")]
pub(crate) const DOCS_FOLDER: &str = "docs";

/// A path relative to the root of the workspace, where the package of this program lies.
pub(crate) fn in_workspace(path: &str) -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).join(path)
}

/// The cargo that runs this program, in the root of the workspace.
pub(crate) fn cargo() -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo")));
    cargo.current_dir(in_workspace(""));
    cargo
}

/// The folder that cargo builds in, whoever set it: the environment, a configuration or nobody.
pub(crate) fn target_folder() -> Result<PathBuf> {
    let output = cargo().args(["metadata", "--format-version", "1", "--no-deps", "--locked"]).output();
    let metadata: serde_json::Value =
        serde_json::from_slice(&output.context("cargo cannot be run")?.stdout).unwrap_or_default();
    Ok(PathBuf::from(
        metadata["target_directory"].as_str().context("cargo does not state its target folder")?,
    ))
}
