//! `cargo xtask dependencies`: the crates behind the libraries' dependencies, and whether their licences and
//! sources are legal.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::{Command, ExitCode};

use anyhow::{Context as _, bail};
use serde::Deserialize;

use crate::output::{complain, say};
use crate::workspace::{cargo, in_workspace};

/// The counted and checked dependencies, the same on every machine.
const TARGET: &str = "x86_64-unknown-linux-gnu";
const LIBRARIES: [&str; 3] = ["bouncing-disk-core", "bouncing-disk", "bouncing-disk-plot"];
const CRATES_IO: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Prints the table and what is illegal.
pub(crate) fn run() -> anyhow::Result<ExitCode> {
    say!("{}", table()?.trim_end())?;
    let metadata = output(cargo().args(["metadata", "--format-version", "1", "--locked"]).args([
        "--all-features",
        "--filter-platform",
        TARGET,
    ]))?;
    let metadata: Metadata = serde_json::from_str(&metadata).context("cargo does not speak JSON")?;
    let rules = in_workspace("deny.toml");
    let rules = fs::read_to_string(&rules).with_context(|| format!("cannot read {}", rules.display()))?;
    let (count, illegal) = (metadata.packages.len(), illegal(&metadata.packages, &licences(&rules)));
    if illegal.is_empty() {
        say!("\nlicences and sources of all {count} crates are legal (deny.toml)")?;
        return Ok(ExitCode::SUCCESS);
    }
    illegal.iter().for_each(|what| complain!("{what}"));
    Ok(ExitCode::FAILURE)
}

/// The output of a program.
fn output(command: &mut Command) -> anyhow::Result<String> {
    let output = command.output().context("cannot start cargo")?;
    if !output.status.success() {
        bail!("{}", String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// For each library, how many crates each of its dependencies brings, in Markdown.
fn table() -> anyhow::Result<String> {
    let mut text = "| library | crates | dependency | brings | alone |\n\
                    | --- | ---: | --- | ---: | ---: |\n"
        .to_owned();
    for library in LIBRARIES {
        let mut tree = cargo();
        tree.args(["tree", "--locked", "--package", library, "--edges", "normal,build", "--target", TARGET]);
        let tree = output(tree.args(["--prefix", "depth", "--no-dedupe", "--format", " {p}"]))?;
        let brought = brought(&tree);
        let all: BTreeSet<_> = brought.values().flatten().collect();
        text += &format!("| `{library}` | {} | | | |\n", all.len() + 1);
        for (name, crates) in &brought {
            let others = brought.iter().filter(|(other, _)| *other != name);
            let others: BTreeSet<_> = others.flat_map(|(_, crates)| crates).collect();
            let alone = crates.iter().filter(|own| !others.contains(own)).count();
            text += &format!("| | | `{name}` | {} | {alone} |\n", crates.len());
        }
    }
    Ok(text)
}

/// By the name of a direct dependency, all crates below it, itself included, from a tree with the depths as
/// prefix.
fn brought(tree: &str) -> BTreeMap<&str, BTreeSet<(&str, &str)>> {
    let mut brought: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
    let mut direct = "";
    for line in tree.lines() {
        let [depth, name, version, ..] = line.split_whitespace().collect::<Vec<_>>()[..] else { continue };
        match depth {
            "0" => continue,
            "1" => direct = name,
            _ => {}
        }
        // Two versions of a crate are two crates.
        brought.entry(direct).or_default().insert((name, version));
    }
    brought
}

#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    version: String,
    license: Option<String>,
    /// None for the crates of this workspace.
    source: Option<String>,
}

/// The licences that deny.toml allows, one a line.
fn licences(rules: &str) -> BTreeSet<&str> {
    let lines = rules.lines().map(str::trim).skip_while(|line| *line != "allow = [").skip(1);
    lines.take_while(|line| *line != "]").map(|line| line.trim_matches(['"', ','])).collect()
}

fn illegal(packages: &[Package], licences: &BTreeSet<&str>) -> Vec<String> {
    let mut illegal = Vec::new();
    for Package { name, version, license, source } in packages {
        let license = license.as_deref().unwrap_or_default();
        if !is_allowed(license, licences) {
            illegal
                .push(format!("{name} {version}: the licence {license:?} is not among those of deny.toml"));
        }
        if let Some(source) = source.as_deref().filter(|source| *source != CRATES_IO) {
            illegal.push(format!("{name} {version}: comes from {source}, not from crates.io"));
        }
    }
    illegal
}

/// Whether an SPDX expression can be met by the licences. A slash is an old way to write OR.
fn is_allowed(expression: &str, licences: &BTreeSet<&str>) -> bool {
    let parsed = spdx::Expression::parse_mode(expression, spdx::ParseMode::LAX);
    // A licence with an exception is another licence, as it is written.
    parsed.is_ok_and(|parsed| parsed.evaluate(|asked| licences.contains(asked.to_string().as_str())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_expression_is_allowed_when_what_it_asks_for_is() {
        let rules =
            "[licenses]\nallow = [\n    \"MIT\",\n    \"Zlib\",\n    \"Unicode-3.0\"\n]\nother = [\n\"X\"\n]";
        let licences = licences(rules);
        assert_eq!(licences, BTreeSet::from(["MIT", "Zlib", "Unicode-3.0"]));
        for expression in [
            "MIT",
            "GPL-3.0 OR MIT",
            "GPL-3.0/MIT",
            "(GPL-3.0 OR MIT) AND Unicode-3.0",
            "GPL-3.0 AND BSD-2-Clause OR MIT",
            "Apache-2.0 WITH LLVM-exception OR Apache-2.0 OR MIT",
        ] {
            assert!(is_allowed(expression, &licences), "{expression}");
        }
        for expression in
            ["", "GPL-3.0", "MIT AND GPL-3.0", "MIT WITH LLVM-exception", "(MIT", "MIT)", "MIT MIT", "X"]
        {
            assert!(!is_allowed(expression, &licences), "{expression}");
        }
    }

    #[test]
    fn what_is_illegal_is_named() {
        let package = |name: &str, license: Option<&str>, source: Option<&str>| Package {
            name: name.to_owned(),
            version: "1.0.0".to_owned(),
            license: license.map(str::to_owned),
            source: source.map(str::to_owned),
        };
        let packages = [
            package("ours", Some("MIT"), None),
            package("legal", Some("MIT"), Some(CRATES_IO)),
            package("unlicensed", None, Some(CRATES_IO)),
            package("foreign", Some("MIT"), Some("git+https://example.org")),
        ];
        let illegal = illegal(&packages, &BTreeSet::from(["MIT"]));
        assert_eq!(illegal.len(), 2);
        assert!(illegal[0].starts_with("unlicensed 1.0.0") && illegal[1].contains("git+https://example.org"));
    }

    #[test]
    fn a_dependency_brings_all_below_it() {
        let tree = "0 model v0.1.0 (/here)\n1 glam v1.0.0\n2 libm v0.2.0\n1 libm v0.2.0\n1 macro v1.0.0 (proc-macro)\n\
                    2 libm v0.1.0\n3 autocfg v1.0.0\n";
        let brought = brought(tree);
        assert_eq!(brought["glam"], BTreeSet::from([("glam", "v1.0.0"), ("libm", "v0.2.0")]));
        let below = ["glam", "libm", "macro"].map(|name| brought[name].len());
        assert_eq!(below, [2, 1, 3]);
    }
}
