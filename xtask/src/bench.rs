//! `cargo xtask bench`: compares the speed of two commits by the criterion benches, running both in turn.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use anyhow::{Context as _, bail};
use clap::Args;
use serde_json::Value;

use crate::output::{complain, say};
use crate::workspace::{cargo, in_workspace};

/// The bench programs and their packages.
const PROGRAMS: [(&str, &str); 8] = [
    ("limit", "bouncing-disk-core"),
    ("impact", "bouncing-disk-core"),
    ("growth", "bouncing-disk-core"),
    ("basin", "bouncing-disk-core"),
    ("sweep", "bouncing-disk-core"),
    ("motor", "bouncing-disk"),
    ("toss", "bouncing-disk"),
    ("figures", "bouncing-disk-experiments"),
];

/// The benches of W1, W2 and W3 on one thread.
const WORKLOADS: &str = "^(w1/(scalar|lanes/.*)|w2/(one_motor|ensemble/threads_1)|w3/(scalar|threads_1))$";

/// Arguments of one run of a bench program: less than a second for most benches, so that some runs fall between
/// the bursts of whatever else the machine does.
const SHORT: [&str; 7] =
    ["--bench", "--quiet", "--noplot", "--warm-up-time", "0.2", "--measurement-time", "0.4"];

/// By the name of the bench, the median time (ns).
type Times = BTreeMap<String, f64>;

/// The options of `cargo xtask bench`.
#[derive(Args)]
pub(crate) struct Options {
    /// The commit to compare with, by any name that Git knows
    old: String,
    /// The commit to judge; by default the tracked files as they are
    new: Option<String>,
    /// Run the programs so many times
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// The bench programs
    #[arg(long, value_name = "PROGRAM", value_delimiter = ',', default_values = ["impact", "motor", "basin"],
          value_parser = clap::builder::PossibleValuesParser::from(PROGRAMS.map(|(name, _)| name)))]
    programs: Vec<String>,
    /// The benches, a regular expression
    #[arg(long, value_name = "REGEX", default_value = WORKLOADS)]
    filter: String,
}

/// Builds both commits and runs old, new and old again in each round.
pub(crate) fn run(options: &Options) -> anyhow::Result<ExitCode> {
    // A commit of the tracked files as they are, which no branch has; nothing if they are those of the last commit.
    let present = git(&["stash", "create"])?;
    let new = options.new.as_deref().unwrap_or(if present.is_empty() { "HEAD" } else { &present });
    let trees = [Tree::new(&options.old)?, Tree::new(new)?];
    let [old, new] = [trees[0].compiled(&options.programs)?, trees[1].compiled(&options.programs)?];
    let folder = in_workspace("target/criterion-of-one-run");
    let mut least = [Times::new(), Times::new(), Times::new()];
    for round in 1..=options.rounds {
        complain!("round {round} of {}", options.rounds);
        for (old, new) in old.iter().zip(&new) {
            for (program, least) in [old, new, old].into_iter().zip(&mut least) {
                for (name, time) in measured(program, &folder, &options.filter)? {
                    // Whatever else runs on a machine only adds time.
                    least.entry(name).and_modify(|least| *least = least.min(time)).or_insert(time);
                }
            }
        }
    }
    say!("{}", comparison(&least).trim_end())?;
    Ok(ExitCode::SUCCESS)
}

/// What Git prints.
fn git(arguments: &[&str]) -> anyhow::Result<String> {
    let output = Command::new("git").args(arguments).current_dir(in_workspace("")).output();
    let output = output.context("cannot start git")?;
    if !output.status.success() {
        bail!("git {}: {}", arguments.join(" "), String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// The source of a commit, which is removed at the end. It lies outside of the workspace, whose `.cargo/config.toml` cargo
/// would add to that of the commit, in a folder called after it: cargo tells the crates of two copies of a workspace apart by
/// nothing but the times of the files, and would take what it built of one commit for the other.
struct Tree(PathBuf);

impl Tree {
    fn new(commit: &str) -> anyhow::Result<Self> {
        let commit = git(&["rev-parse", "--verify", &format!("{commit}^{{commit}}")])?;
        let path = std::env::temp_dir().join(format!("bouncing-disk-{}", &commit[..12]));
        git(&["worktree", "add", "--force", "--detach", &path.to_string_lossy(), &commit])?;
        Ok(Self(path))
    }

    /// The bench programs, in the order of their names.
    fn compiled(&self, names: &[String]) -> anyhow::Result<Vec<PathBuf>> {
        let mut cargo = cargo();
        cargo.args(["bench", "--no-run", "--locked", "--message-format", "json-render-diagnostics"]);
        for (name, package) in PROGRAMS.iter().filter(|(name, _)| names.iter().any(|own| own == name)) {
            cargo.args(["--package", package, "--bench", name]);
        }
        let target = in_workspace("target/compare").join(self.0.file_name().unwrap_or_default());
        cargo.env("CARGO_TARGET_DIR", target).current_dir(&self.0).stderr(Stdio::inherit());
        let output = cargo.output().context("cannot start cargo")?;
        if !output.status.success() {
            bail!("cargo bench --no-run in {} failed: {}", self.0.display(), output.status);
        }
        let mut programs = BTreeMap::new();
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let message: Value = serde_json::from_str(line).context("cargo does not speak JSON")?;
            let target = &message["target"];
            if let (Some(name), Some(program)) = (target["name"].as_str(), message["executable"].as_str())
                && target["kind"][0] == "bench"
            {
                programs.insert(name.to_owned(), PathBuf::from(program));
            }
        }
        Ok(programs.into_values().collect())
    }
}

impl Drop for Tree {
    fn drop(&mut self) {
        let _ = git(&["worktree", "remove", "--force", &self.0.to_string_lossy()]);
    }
}

/// Runs a program once; `folder` is for criterion's files.
fn measured(program: &Path, folder: &Path, filter: &str) -> anyhow::Result<Times> {
    // Of the run before.
    let _ = fs::remove_dir_all(folder);
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    let output = Command::new(program).args(SHORT).arg(filter).env("CRITERION_HOME", folder).output();
    let output = output.with_context(|| format!("cannot start {}", program.display()))?;
    if !output.status.success() {
        bail!("{} failed: {}", program.display(), String::from_utf8_lossy(&output.stderr).trim());
    }
    let mut times = Times::new();
    collect(folder, &mut times)?;
    Ok(times)
}

/// Reads all results below a folder: in a folder `new` each.
fn collect(folder: &Path, times: &mut Times) -> anyhow::Result<()> {
    for entry in fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()))? {
        let path = entry?.path();
        if path.file_name().is_some_and(|name| name == "new") {
            let read = |name: &str| -> anyhow::Result<Value> {
                let file = path.join(name);
                let text = fs::read(&file).with_context(|| format!("cannot read {}", file.display()))?;
                Ok(serde_json::from_slice(&text)?)
            };
            let name = read("benchmark.json")?["full_id"].as_str().map(str::to_owned);
            let median = read("estimates.json")?["median"]["point_estimate"].as_f64();
            let (Some(name), Some(median)) = (name, median) else {
                bail!("{} holds no result of criterion", path.display());
            };
            times.insert(name, median);
        } else if path.is_dir() {
            collect(&path, times)?;
        }
    }
    Ok(())
}

/// The table of the least times of the old programs, the new ones, and the old ones again, for the benches of both.
fn comparison([old, new, again]: &[Times; 3]) -> String {
    let mut text = format!("{:<32}{:>14}{:>14}{:>10}{:>10}\n", "", "old (ns)", "new (ns)", "new/old", "old/old");
    for (name, old) in old {
        let (Some(new), Some(again)) = (new.get(name), again.get(name)) else { continue };
        let least = old.min(*again);
        let (ratio, own) = (new / least, old.max(*again) / least);
        let verdict = match ratio {
            ratio if ratio > own => "slower",
            ratio if ratio * own < 1.0 => "faster",
            _ => "as fast",
        };
        text += &format!("{name:<32}{least:>14.0}{new:>14.0}{ratio:>10.3}{own:>10.3}  {verdict}\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slower_is_what_exceeds_the_old_program_against_itself() {
        let times = |times: [f64; 3]| {
            let names = ["w1/scalar", "w2/one_motor", "w3/scalar"].map(str::to_owned);
            names.into_iter().zip(times).collect::<Times>()
        };
        let mut old = times([100.0, 100.0, 100.0]);
        old.insert("w4".to_owned(), 7.0);
        let text = comparison(&[old, times([104.0, 103.0, 90.0]), times([103.0, 104.0, 105.0])]);
        let lines: Vec<_> = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>()).collect();
        assert_eq!(lines[1], ["w1/scalar", "100", "104", "1.040", "1.030", "slower"]);
        assert_eq!(lines[2][3..], ["1.030", "1.040", "as", "fast"]);
        assert_eq!(lines[3][3..], ["0.900", "1.050", "faster"]);
        assert_eq!(lines.len(), 4);
    }

    #[test]
    fn the_medians_of_criterion_are_read() {
        let folder = tempfile::tempdir().expect("writable");
        let result = folder.path().join("w1/scalar/new");
        fs::create_dir_all(&result).expect("writable");
        let write = |name: &str, text: &str| fs::write(result.join(name), text).expect("writable");
        write("benchmark.json", r#"{"full_id": "w1/scalar", "title": "t"}"#);
        write("estimates.json", r#"{"mean": 1, "median": {"point_estimate": 150.0, "standard_error": 1}}"#);
        let mut times = Times::new();
        collect(folder.path(), &mut times).expect("readable");
        assert_eq!(times, Times::from([("w1/scalar".to_owned(), 150.0)]));
        write("estimates.json", "{}");
        let error = collect(folder.path(), &mut Times::new()).expect_err("malformed");
        assert!(format!("{error:#}").contains("w1/scalar"), "{error:#}");
    }
}
