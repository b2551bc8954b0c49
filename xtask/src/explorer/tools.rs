//! The programs that the page is built with.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use super::TARGET;
use crate::workspace::{cargo, in_workspace};

/// The oldest Node that the build tools of the page run on.
const OLDEST_NODE: u32 = 20;

/// npm, by the name that it has here.
pub(super) fn npm() -> Command {
    Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" })
}

/// One line that says what is missing, and how to get it.
pub(super) fn complain_of_missing(rustc: Option<&Path>, build_std: bool) -> Result<()> {
    let mut missing = Vec::new();
    if !build_std && !has_target(rustc) {
        missing.push(format!("the target {TARGET} (rustup target add {TARGET})"));
    }
    match node_version() {
        None => missing.push(format!("Node {OLDEST_NODE} or later (https://nodejs.org)")),
        Some(version) if version < OLDEST_NODE => {
            missing.push(format!("Node {OLDEST_NODE} or later; this is {version} (https://nodejs.org)"));
        }
        Some(_) if !runs(&mut npm()) => {
            missing.push("npm (it comes with Node, https://nodejs.org)".to_owned())
        }
        Some(_) => {}
    }
    if missing.is_empty() { Ok(()) } else { bail!("the explorer needs {}", missing.join(", and ")) }
}

fn runs(command: &mut Command) -> bool {
    let quiet = command.arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}

/// The first number of Node's version: `v20.20.2`.
fn node_version() -> Option<u32> {
    let printed = Command::new("node").arg("--version").output().ok()?;
    let version = String::from_utf8(printed.stdout).ok()?;
    version.trim().strip_prefix('v')?.split('.').next()?.parse().ok()
}

/// Whether the standard library of the target is installed beside the compiler.
fn has_target(rustc: Option<&Path>) -> bool {
    let environment = std::env::var_os("RUSTC");
    let rustc = rustc.map(Path::as_os_str).or(environment.as_deref()).unwrap_or(OsStr::new("rustc"));
    let printed = Command::new(rustc).args(["--print", "target-libdir", "--target", TARGET]).output();
    let Ok(printed) = printed else { return false };
    let Ok(folder) = String::from_utf8(printed.stdout) else { return false };
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
    install
        .args(["install", "wasm-bindgen-cli", "--debug", "--quiet", "--version", &version, "--root"])
        .arg(&root);
    let status = install.status().context("cargo cannot be run")?;
    if !status.success() {
        bail!("wasm-bindgen-cli {version} could not be installed from crates.io ({status})");
    }
    Ok(program)
}

/// The version of a package in Cargo.lock.
fn locked_version(package: &str) -> Result<String> {
    let lock = in_workspace("Cargo.lock");
    let text =
        std::fs::read_to_string(&lock).with_context(|| format!("{} cannot be read", lock.display()))?;
    version_in(&text, package).with_context(|| format!("Cargo.lock has no {package}"))
}

fn version_in(lock: &str, package: &str) -> Option<String> {
    let name = format!("name = \"{package}\"");
    let mut lines = lock.lines().skip_while(|line| *line != name);
    lines.next()?;
    Some(lines.next()?.strip_prefix("version = \"")?.strip_suffix('"')?.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_of_a_package_is_that_of_the_lock_file() {
        let lock = "[[package]]\nname = \"wasm-bindgen-macro\"\nversion = \"0.1.0\"\n\n[[package]]\nname = \"wasm-bindgen\"\nversion = \"0.2.7\"\n";
        assert_eq!(version_in(lock, "wasm-bindgen").as_deref(), Some("0.2.7"));
        assert_eq!(version_in(lock, "wasm"), None);
        assert!(locked_version("wasm-bindgen").expect("in the lock file").starts_with("0.2."));
    }

    #[test]
    fn a_target_that_there_is_not_is_missing() {
        assert!(!has_target(Some(Path::new("/no/such/rustc"))));
        let missing = complain_of_missing(Some(Path::new("/no/such/rustc")), false).expect_err("no compiler");
        assert!(missing.to_string().contains("rustup target add wasm32-unknown-unknown"), "{missing}");
        assert_eq!(missing.to_string().lines().count(), 1);
    }
}
