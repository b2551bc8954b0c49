//! The programs that the page is built with.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use super::TARGET;
use crate::workspace::cargo;

/// The oldest Node that the build tools of the page run on.
const OLDEST_NODE: u32 = 20;

/// npm, by the name that it has here.
pub(super) fn npm() -> Command {
    Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" })
}

/// One line on the missing tool, and how to get it.
pub(super) fn complain_of_missing(rustc: Option<&Path>, build_std: bool) -> Result<()> {
    let mut missing = Vec::new();
    if !build_std && !has_target(rustc) {
        missing.push(format!(
            "the target {TARGET} (rustup target add {TARGET}; without rustup, a distribution's compiler, 1.95 or \
             later, by --rustc /usr/bin/rustc --build-std --linker wasm-ld-16, from rustc-web, rust-web-src and \
             lld-16 of an updated Debian 12)"
        ));
    }
    match node_version() {
        None => missing.push(format!("Node {OLDEST_NODE} or later (https://nodejs.org)")),
        Some(version) if version < OLDEST_NODE => {
            missing.push(format!("Node {OLDEST_NODE} or later; this is {version} (https://nodejs.org)"));
        }
        Some(_) if printed(npm().arg("--version")).is_none() => {
            missing.push("npm (it comes with Node, https://nodejs.org)".to_owned())
        }
        Some(_) => {}
    }
    if missing.is_empty() {
        return Ok(());
    }
    bail!(
        "building the explorer needs {}; the ready file (docs/explorer.md) needs nothing",
        missing.join(", and ")
    )
}

/// The first number of Node's version: `v20.20.2`.
fn node_version() -> Option<u32> {
    let version = printed(Command::new("node").arg("--version"))?;
    version.trim().strip_prefix('v')?.split('.').next()?.parse().ok()
}

/// Whether the standard library of the target is installed with the compiler.
fn has_target(rustc: Option<&Path>) -> bool {
    let environment = std::env::var_os("RUSTC");
    let rustc = rustc.map(Path::as_os_str).or(environment.as_deref()).unwrap_or(OsStr::new("rustc"));
    let folder = printed(Command::new(rustc).args(["--print", "target-libdir", "--target", TARGET]));
    let Some(folder) = folder else { return false };
    let Ok(mut files) = std::fs::read_dir(folder.trim()) else { return false };
    files.any(|file| file.is_ok_and(|file| file.file_name().to_string_lossy().starts_with("libstd")))
}

/// The program of the version of the library that the module is built with: they fit together only then. It
/// is compiled once, from crates.io, and without optimisation: it runs for a few seconds, and would be
/// compiled for minutes.
pub(super) fn wasm_bindgen(folder: &Path) -> Result<PathBuf> {
    let version = locked_version("wasm-bindgen")?;
    let root = folder.join(format!("wasm-bindgen-{version}"));
    let program = root.join("bin").join(format!("wasm-bindgen{}", std::env::consts::EXE_SUFFIX));
    if program.is_file() {
        return Ok(program);
    }
    let mut install = cargo();
    install.args(["install", "wasm-bindgen-cli", "--debug", "--version", &version, "--root"]).arg(&root);
    let status = install.status().context("cargo cannot be run")?;
    if !status.success() {
        bail!("wasm-bindgen-cli {version} could not be installed from crates.io ({status})");
    }
    Ok(program)
}

/// The version of a package in Cargo.lock: the last part of `registry+https://...#wasm-bindgen@0.2.100`.
fn locked_version(package: &str) -> Result<String> {
    let id = printed(cargo().args(["pkgid", "--locked", "--package", package]));
    let version = id.as_deref().and_then(|id| id.trim().rsplit_once('@'));
    Ok(version.with_context(|| format!("Cargo.lock does not contain {package}"))?.1.to_owned())
}

/// What a program prints, if it can be run and succeeds.
fn printed(command: &mut Command) -> Option<String> {
    let output = command.stderr(Stdio::null()).output().ok().filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_of_a_package_is_that_of_the_lock_file() {
        assert!(locked_version("wasm-bindgen").expect("in the lock file").starts_with("0.2."));
        assert!(locked_version("wasm").is_err());
    }

    #[test]
    fn a_target_that_there_is_not_is_missing() {
        assert!(!has_target(Some(Path::new("/no/such/rustc"))));
        let missing = complain_of_missing(Some(Path::new("/no/such/rustc")), false).expect_err("no compiler");
        assert!(missing.to_string().contains("rustup target add wasm32-unknown-unknown"), "{missing}");
        assert!(missing.to_string().contains("--build-std"), "{missing}");
        assert_eq!(missing.to_string().lines().count(), 1);
    }
}
