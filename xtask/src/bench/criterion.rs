//! Runs the benches and reads what criterion has written.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, bail};
use serde::Deserialize;

use super::record::{Measured, Reference};

/// One bench program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Program {
    package: &'static str,
    bench: &'static str,
}

const fn program(package: &'static str, bench: &'static str) -> Program {
    Program { package, bench }
}

/// All of them. Each measures the reference kernels before and after its own benches.
pub(super) const PROGRAMS: [Program; 7] = [
    program("bouncing-disk-core", "limit"),
    program("bouncing-disk-core", "impact"),
    program("bouncing-disk-core", "growth"),
    program("bouncing-disk-core", "basin"),
    program("bouncing-disk", "motor"),
    program("bouncing-disk", "toss"),
    program("bouncing-disk-experiments", "figures"),
];

/// The names of all programs.
pub(super) const NAMES: [&str; PROGRAMS.len()] = {
    let mut names = [""; PROGRAMS.len()];
    let mut index = 0;
    while index < names.len() {
        names[index] = PROGRAMS[index].bench;
        index += 1;
    }
    names
};

/// Arguments of one repetition: less than a second for most benches, so that some fall between the bursts of a neighbour on
/// the machine.
const REPETITION: [&str; 4] = ["--warm-up-time", "0.2", "--measurement-time", "0.4"];

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
    confidence_interval: Interval,
    point_estimate: f64,
}

#[derive(Deserialize)]
struct Interval {
    lower_bound: f64,
    upper_bound: f64,
}

/// Time (ns) of one element: low end, median, high end.
type Times = [f64; 3];

impl Program {
    /// What it is called on the command line.
    pub(super) const fn name(self) -> &'static str {
        self.bench
    }

    fn cargo(self, arguments: &[&str]) -> Command {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo")));
        command.args(["bench", "--package", self.package, "--bench", self.bench]).args(arguments);
        command
    }

    /// The folder of this program's results. They are not mixed with those of other programs or of a plain `cargo bench`,
    /// so that old results are never taken for new ones.
    fn folder(self, results: &Path) -> PathBuf {
        results.join(self.bench)
    }

    /// Measures everything in this program anew.
    pub(super) fn run(self, root: &Path, results: &Path) -> anyhow::Result<()> {
        let folder = self.folder(results);
        match fs::remove_dir_all(&folder) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(error).with_context(|| format!("cannot remove {}", folder.display()));
            }
            _ => {}
        }
        let mut command = self.cargo(&["--"]);
        command.args(REPETITION).current_dir(root).env("CRITERION_HOME", &folder);
        let status = command.status().context("cannot start cargo")?;
        if !status.success() {
            bail!("cargo bench --package {} --bench {} failed: {status}", self.package, self.bench);
        }
        Ok(())
    }

    /// The times of this program's benches.
    pub(super) fn read(self, results: &Path) -> anyhow::Result<BTreeMap<String, Measured>> {
        let folder = self.folder(results);
        let mut times = BTreeMap::new();
        collect(&folder, &mut times)
            .with_context(|| format!("--bench {} has left no results that can be read", self.bench))?;
        let mut references = BTreeMap::new();
        for reference in Reference::ALL {
            let mut of = |moment: &str| -> anyhow::Result<f64> {
                let name = format!("reference/{}/{moment}", reference.name());
                let Some([_, median, _]) = times.remove(&name) else {
                    bail!("--bench {} has not measured {name}", self.bench);
                };
                Ok(median)
            };
            let (before, after) = (of("before")?, of("after")?);
            let mean = 0.5 * (before + after);
            references.insert(reference, (mean, (before - after).abs() / mean));
        }
        let measured = |name: &str, [low_ns, median_ns, high_ns]: Times| {
            let reference = Reference::of(name);
            let (reference_ns, reference_drift) = references[&reference];
            Measured {
                low_ns: rounded(low_ns),
                median_ns: rounded(median_ns),
                high_ns: rounded(high_ns),
                medians_ns: vec![rounded(median_ns)],
                reference,
                reference_ns: rounded(reference_ns),
                reference_drift: rounded(reference_drift),
            }
        };
        Ok(times.into_iter().map(|(name, times)| (name.clone(), measured(&name, times))).collect())
    }
}

/// To four decimals: a tenth of a picosecond.
fn rounded(value: f64) -> f64 {
    (value * 1.0e4).round() / 1.0e4
}

/// Reads all results below a folder.
fn collect(folder: &Path, times: &mut BTreeMap<String, Times>) -> anyhow::Result<()> {
    let unreadable = || format!("cannot read {}", folder.display());
    for entry in fs::read_dir(folder).with_context(unreadable)? {
        let path = entry.with_context(unreadable)?.path();
        if !path.is_dir() {
            continue;
        }
        if path.file_name().is_some_and(|name| name == "new") {
            let (name, measured) = one(&path)?;
            times.insert(name, measured);
        } else {
            collect(&path, times)?;
        }
    }
    Ok(())
}

fn parsed<T: serde::de::DeserializeOwned>(path: &Path) -> anyhow::Result<T> {
    let text = fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
    serde_json::from_slice(&text)
        .with_context(|| format!("{} does not have criterion's form", path.display()))
}

/// Name and times of one bench.
fn one(folder: &Path) -> anyhow::Result<(String, Times)> {
    let benchmark: Benchmark = parsed(&folder.join("benchmark.json"))?;
    let Estimates { median } = parsed(&folder.join("estimates.json"))?;
    let elements = match benchmark.throughput {
        Some(Throughput::Elements(elements)) => elements as f64,
        None => 1.0,
    };
    let Interval { lower_bound, upper_bound } = median.confidence_interval;
    let times = [lower_bound, median.point_estimate, upper_bound].map(|time| time / elements);
    if !times.iter().all(|time| time.is_finite() && *time > 0.0) {
        bail!("{}: a time that is not positive: {times:?}", folder.display());
    }
    Ok((benchmark.full_id, times))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(folder: &Path, id: &str, elements: u64, median: f64) {
        let folder = folder.join(id.replace('/', "_")).join("new");
        fs::create_dir_all(&folder).expect("writable");
        let benchmark = format!(
            r#"{{"group_id": "g", "full_id": "{id}", "throughput": {{"Elements": {elements}}}, "title": "t"}}"#
        );
        fs::write(folder.join("benchmark.json"), benchmark).expect("writable");
        let (low, high) = (0.9 * median, 1.1 * median);
        let estimates = format!(
            r#"{{"mean": 1, "median": {{"confidence_interval": {{"confidence_level": 0.95, "lower_bound": {low},
               "upper_bound": {high}}}, "point_estimate": {median}, "standard_error": 1}}}}"#
        );
        fs::write(folder.join("estimates.json"), estimates).expect("writable");
    }

    #[test]
    fn results_are_times_of_one_element_beside_the_reference() {
        let results = std::env::temp_dir().join(format!("bouncing-disk-criterion-{}", std::process::id()));
        let _ = fs::remove_dir_all(&results);
        let program = program("a-package", "a-bench");
        let error = program.read(&results).expect_err("nothing measured");
        assert!(format!("{error:#}").contains("a-bench"), "{error:#}");
        let folder = program.folder(&results);
        write(&folder, "w1/scalar", 1_000, 150_000.0);
        let error = program.read(&results).expect_err("no reference");
        assert!(format!("{error:#}").contains("reference/chain/before"), "{error:#}");
        write(&folder, "reference/chain/before", 10, 98.0);
        write(&folder, "reference/chain/after", 10, 102.0);
        write(&folder, "reference/lanes/before", 100, 208.0);
        write(&folder, "reference/lanes/after", 100, 192.0);
        write(&folder, "w1/lanes/Avx2", 1_000, 10_000.0);
        let benches = program.read(&results).expect("readable");
        let expected = Measured {
            low_ns: 135.0,
            median_ns: 150.0,
            high_ns: 165.0,
            medians_ns: vec![150.0],
            reference: Reference::Chain,
            reference_ns: 10.0,
            reference_drift: 0.04,
        };
        let in_lanes = Measured {
            low_ns: 9.0,
            median_ns: 10.0,
            high_ns: 11.0,
            medians_ns: vec![10.0],
            reference: Reference::Lanes,
            reference_ns: 2.0,
            reference_drift: 0.08,
        };
        let expected = [("w1/lanes/Avx2".to_owned(), in_lanes), ("w1/scalar".to_owned(), expected)];
        assert_eq!(benches.into_iter().collect::<Vec<_>>(), expected);
        fs::write(folder.join("w1_scalar/new/estimates.json"), b"{}").expect("writable");
        let error = program.read(&results).expect_err("malformed");
        assert!(format!("{error:#}").contains("estimates.json"), "{error:#}");
        fs::remove_dir_all(&results).expect("removable");
    }
}
