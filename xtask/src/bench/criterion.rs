//! Compiles the bench programs, runs them, and reads what criterion has written.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, bail};
use serde::Deserialize;

use crate::workspace::cargo;

/// Package and bench program.
pub(super) const PROGRAMS: [(&str, &str); 8] = [
    ("bouncing-disk-core", "limit"),
    ("bouncing-disk-core", "impact"),
    ("bouncing-disk-core", "growth"),
    ("bouncing-disk-core", "basin"),
    ("bouncing-disk-core", "sweep"),
    ("bouncing-disk", "motor"),
    ("bouncing-disk", "toss"),
    ("bouncing-disk-experiments", "figures"),
];

/// By the name of the bench, the median time (ns) of one element: an impact, a cell, a motor second.
pub(super) type Times = BTreeMap<String, f64>;

/// A program that is ready to run.
#[derive(Debug, PartialEq)]
pub(super) struct Program {
    pub(super) name: String,
    executable: PathBuf,
}

/// A line of what cargo says, as far as it is of interest.
#[derive(Deserialize)]
struct Message {
    target: Option<Target>,
    executable: Option<PathBuf>,
}

#[derive(Deserialize)]
struct Target {
    name: String,
    kind: Vec<String>,
}

/// The flags of the compiler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flags {
    /// Those of the source.
    OfSource,
    /// None, as in a crate that depends on the libraries.
    Default,
}

/// Compiles the programs of the source in `tree`, with the lock file that lies there.
pub(super) fn compiled(
    tree: &Path,
    target: &Path,
    names: &[String],
    flags: Flags,
) -> anyhow::Result<Vec<Program>> {
    let mut cargo = cargo();
    cargo.args(["bench", "--no-run", "--locked", "--message-format", "json-render-diagnostics"]);
    for (package, name) in PROGRAMS.iter().filter(|(_, name)| names.iter().any(|own| own == name)) {
        cargo.args(["--package", package, "--bench", name]);
    }
    if flags == Flags::Default {
        // It takes the place of the flags in .cargo/config.toml.
        cargo.env("CARGO_ENCODED_RUSTFLAGS", "");
    }
    cargo.env("CARGO_TARGET_DIR", target).current_dir(tree).stderr(Stdio::inherit());
    let output = cargo.output().context("cannot start cargo")?;
    if !output.status.success() {
        bail!("cargo bench --no-run in {} failed: {}", tree.display(), output.status);
    }
    let mut programs = programs(&String::from_utf8_lossy(&output.stdout))?;
    // In the order of the list, whatever was compiled first.
    programs.sort_by_key(|program| PROGRAMS.iter().position(|(_, name)| *name == program.name));
    Ok(programs)
}

fn programs(messages: &str) -> anyhow::Result<Vec<Program>> {
    let mut programs = Vec::new();
    for line in messages.lines() {
        let message: Message = serde_json::from_str(line).context("cargo does not speak JSON")?;
        if let (Some(target), Some(executable)) = (message.target, message.executable)
            && target.kind == ["bench"]
        {
            programs.push(Program { name: target.name, executable });
        }
    }
    Ok(programs)
}

impl Program {
    /// Runs the program once; `folder` is for criterion's files and is emptied before.
    pub(super) fn measure(&self, folder: &Path, arguments: &[&str]) -> anyhow::Result<Times> {
        match fs::remove_dir_all(folder) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(error).with_context(|| format!("cannot remove {}", folder.display()));
            }
            _ => fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?,
        }
        let mut program = Command::new(&self.executable);
        program.args(["--bench", "--quiet", "--noplot"]).args(arguments);
        let output = program.env("CRITERION_HOME", folder).output();
        let output = output.with_context(|| format!("cannot start {}", self.executable.display()))?;
        if !output.status.success() {
            bail!("{} failed: {}", self.name, String::from_utf8_lossy(&output.stderr).trim());
        }
        let mut times = Times::new();
        collect(folder, &mut times)?;
        Ok(times)
    }
}

/// Keeps the less of both times: whatever else runs on a machine only adds time.
pub(super) fn keep_least(kept: &mut Times, times: Times) {
    for (name, time) in times {
        kept.entry(name).and_modify(|least| *least = least.min(time)).or_insert(time);
    }
}

/// What criterion says of a bench.
#[derive(Deserialize)]
struct Benchmark {
    full_id: String,
    throughput: Option<Throughput>,
}

/// How many elements one timed call goes through.
#[derive(Deserialize)]
enum Throughput {
    Elements(u64),
}

#[derive(Deserialize)]
struct Estimates {
    median: Estimate,
}

#[derive(Deserialize)]
struct Estimate {
    point_estimate: f64,
}

/// Reads all results below a folder.
fn collect(folder: &Path, times: &mut Times) -> anyhow::Result<()> {
    let unreadable = || format!("cannot read {}", folder.display());
    for entry in fs::read_dir(folder).with_context(unreadable)? {
        let path = entry.with_context(unreadable)?.path();
        if !path.is_dir() {
            continue;
        }
        if path.file_name().is_none_or(|name| name != "new") {
            collect(&path, times)?;
            continue;
        }
        let Benchmark { full_id, throughput } = parsed(&path.join("benchmark.json"))?;
        let Estimates { median } = parsed(&path.join("estimates.json"))?;
        let elements = throughput.map_or(1.0, |Throughput::Elements(elements)| elements as f64);
        let time = median.point_estimate / elements;
        if !(time.is_finite() && time > 0.0) {
            bail!("{}: a time of {time} ns", path.display());
        }
        times.insert(full_id, time);
    }
    Ok(())
}

/// Reads a JSON file.
pub(super) fn parsed<T: serde::de::DeserializeOwned>(path: &Path) -> anyhow::Result<T> {
    let text = fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
    serde_json::from_slice(&text).with_context(|| format!("{} does not have the right form", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_times_of_one_element() {
        let folder = std::env::temp_dir().join(format!("bouncing-disk-criterion-{}", std::process::id()));
        let result = folder.join("w1/scalar/new");
        fs::create_dir_all(&result).expect("writable");
        let write = |name: &str, text: &str| fs::write(result.join(name), text).expect("writable");
        write(
            "benchmark.json",
            r#"{"full_id": "w1/scalar", "throughput": {"Elements": 1000}, "title": "t"}"#,
        );
        write(
            "estimates.json",
            r#"{"mean": 1, "median": {"point_estimate": 150000.0, "standard_error": 1}}"#,
        );
        let mut times = Times::new();
        collect(&folder, &mut times).expect("readable");
        assert_eq!(times, Times::from([("w1/scalar".to_owned(), 150.0)]));
        keep_least(&mut times, Times::from([("w1/scalar".to_owned(), 140.0), ("w2".to_owned(), 1.0)]));
        keep_least(&mut times, Times::from([("w1/scalar".to_owned(), 145.0)]));
        assert_eq!(times.into_values().collect::<Vec<_>>(), [140.0, 1.0]);
        for malformed in ["{}", r#"{"median": {"point_estimate": 0}}"#] {
            write("estimates.json", malformed);
            let error = collect(&folder, &mut Times::new()).expect_err("malformed");
            assert!(format!("{error:#}").contains("w1/scalar"), "{error:#}");
        }
        fs::remove_dir_all(&folder).expect("removable");
    }

    #[test]
    fn the_programs_are_what_cargo_has_made_of_the_benches() {
        let messages = r#"{"reason":"compiler-artifact","target":{"kind":["lib"],"name":"serde"},"executable":null}
{"reason":"compiler-artifact","target":{"kind":["bench"],"name":"impact"},"executable":"/t/impact-1"}
{"reason":"build-finished","success":true}"#;
        let impact = Program { name: "impact".to_owned(), executable: "/t/impact-1".into() };
        assert_eq!(programs(messages).expect("JSON"), [impact]);
        assert!(programs("error").is_err());
    }
}
