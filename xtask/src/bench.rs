//! `cargo xtask bench`: runs the criterion benches, compares the speed of two commits, writes `docs/performance.md`.

mod criterion;
mod page;
mod record;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use anyhow::{Context as _, bail};
use bouncing_disk_experiments::output::OutputFolder;
use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};

use crate::dependencies;
use crate::output::{complain, say};
use crate::workspace::{DOCS_FOLDER, in_workspace};
use criterion::{Flags, PROGRAMS, Times, compiled, keep_least};
use record::Record;

/// The folder of the stored measurements, relative to the root of the workspace.
const STORE: &str = "data/performance";
const PAGE_FILE: &str = "performance.md";

/// Arguments of one run of a bench program: less than a second for most benches, so that some runs fall between
/// the bursts of whatever else the machine does.
const SHORT: [&str; 4] = ["--warm-up-time", "0.2", "--measurement-time", "0.4"];

/// The benches of W1, W2 and W3 on one thread.
const WORKLOADS: &str = "^(w1/(scalar|lanes/.*)|w2/(one_motor|ensemble/threads_1)|w3/(scalar|threads_1))$";

/// The programs of the workloads.
const WORKLOAD_PROGRAMS: [&str; 3] = ["impact", "motor", "basin"];

/// What precedes the name of a workload that was compiled with default flags.
const OUTSIDE: &str = "outside";

/// The options of `cargo xtask bench`.
#[derive(Args)]
pub(crate) struct Options {
    #[command(subcommand)]
    what: Bench,
}

#[derive(Subcommand)]
enum Bench {
    /// Run the benches and print the least time of each
    Run {
        /// Bench programs to run; those of docs/performance.md when none is given
        #[arg(value_name = "PROGRAM", value_parser = names(),
              default_values = ["limit", "impact", "growth", "basin", "motor"])]
        programs: Vec<String>,
        /// Go through them so many times
        #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
        passes: u32,
        /// Store the times, with those of a first build and of the workloads in a crate of one's own, in data/performance
        /// and write docs/performance.md
        #[arg(long, conflicts_with = "programs")]
        store: bool,
    },
    /// Compare the speed of two commits, running the programs of both in turn
    Compare {
        /// The commit to compare with, by any name that Git knows
        old: String,
        /// The commit to judge; by default the tracked files as they are
        new: Option<String>,
        /// Run the programs so many times
        #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
        rounds: u32,
        /// The bench programs
        #[arg(long, value_name = "PROGRAM", value_delimiter = ',', value_parser = names(),
              default_values = WORKLOAD_PROGRAMS)]
        programs: Vec<String>,
        /// The benches, a regular expression
        #[arg(long, value_name = "REGEX", default_value = WORKLOADS)]
        filter: String,
    },
    /// Write docs/performance.md from what is stored in data/performance, and from the lock file
    Page {
        /// Say whether it is up to date instead
        #[arg(long)]
        check: bool,
    },
}

fn names() -> PossibleValuesParser {
    PROGRAMS.map(|(_, name)| name).into()
}

/// Does what the options ask for.
pub(crate) fn run(options: &Options) -> anyhow::Result<ExitCode> {
    match &options.what {
        Bench::Run { programs, passes, store } => {
            let mut record = measured(programs, *passes, *store)?;
            for (name, time) in &record.times_ns {
                say!("{name:<40} {:>12}", page::time(*time))?;
            }
            if *store {
                record.first_build_s = Some(dependencies::first_build_time()?);
                record.store(&OutputFolder::create(in_workspace(STORE))?)?;
                write_page()?;
            }
        }
        Bench::Compare { old, new, rounds, programs, filter } => {
            say!("{}", compared(old, new.as_deref(), *rounds, programs, filter)?.trim_end())?;
        }
        Bench::Page { check: false } => write_page()?,
        Bench::Page { check: true } => {
            if fs::read_to_string(in_workspace(DOCS_FOLDER).join(PAGE_FILE)).ok() != Some(page()?) {
                complain!("docs/{PAGE_FILE} is not up to date: `cargo xtask bench page` writes it anew");
                return Ok(ExitCode::FAILURE);
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The times of the programs, and if wanted those of the workloads with default flags, under names of their own.
fn measured(programs: &[String], passes: u32, outside: bool) -> anyhow::Result<Record> {
    let (root, target) = (in_workspace(""), target_folder()?);
    let mut record = Record::here(&root, passes)?;
    let programs = compiled(&root, &target, programs, Flags::OfSource)?;
    let workloads = WORKLOAD_PROGRAMS.map(str::to_owned);
    let outside = match outside {
        true => compiled(&root, &target.join(OUTSIDE), &workloads, Flags::Default)?,
        false => Vec::new(),
    };
    // All programs again and again: a neighbour on the machine mostly stays for some minutes.
    for pass in 1..=passes {
        for program in &programs {
            complain!("pass {pass} of {passes}: {}", program.name);
            keep_least(&mut record.times_ns, program.measure(&target.join("performance"), &SHORT)?);
        }
        for program in &outside {
            complain!("pass {pass} of {passes}: {} with default flags", program.name);
            let arguments = [&SHORT[..], &[WORKLOADS]].concat();
            let times = program.measure(&target.join("performance"), &arguments)?;
            let named = times.into_iter().map(|(name, time)| (format!("{OUTSIDE}/{name}"), time));
            keep_least(&mut record.times_ns, named.collect());
        }
    }
    Ok(record)
}

fn page() -> anyhow::Result<String> {
    Ok(page::page(&Record::all(&in_workspace(STORE))?, &dependencies::table()?))
}

fn write_page() -> anyhow::Result<()> {
    OutputFolder::create(in_workspace(DOCS_FOLDER))?.write(PAGE_FILE, page()?.as_bytes())?;
    say!("docs/{PAGE_FILE} is written")?;
    Ok(())
}

/// The folder that cargo builds into.
fn target_folder() -> anyhow::Result<PathBuf> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| in_workspace("target"), PathBuf::from);
    std::path::absolute(target).context("cannot tell where the target folder is")
}

/// What Git prints.
fn git(root: &Path, arguments: &[&str]) -> anyhow::Result<String> {
    let output =
        Command::new("git").args(arguments).current_dir(root).output().context("cannot start git")?;
    if !output.status.success() {
        bail!("git {}: {}", arguments.join(" "), String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// The source of a commit in a folder called after it, which is removed at the end. It lies outside of the workspace,
/// whose `.cargo/config.toml` cargo would add to that of the commit.
struct Tree(PathBuf);

impl Tree {
    fn new(root: &Path, commit: &str) -> anyhow::Result<Self> {
        let commit = git(root, &["rev-parse", "--verify", &format!("{commit}^{{commit}}")])?;
        let tree = Self(std::env::temp_dir().join(format!("bouncing-disk-{}", &commit[..12])));
        fs::create_dir_all(&tree.0).with_context(|| format!("cannot make {}", tree.0.display()))?;
        let mut archive = Command::new("git");
        archive.args(["archive", "--format=tar", &commit]).current_dir(root).stdout(Stdio::piped());
        let mut archive = archive.spawn().context("cannot start git")?;
        let mut tar = Command::new("tar");
        tar.arg("-x").arg("-C").arg(&tree.0).stdin(archive.stdout.take().context("git gives nothing")?);
        if !(tar.status().context("cannot start tar")?.success() && archive.wait()?.success()) {
            bail!("cannot unpack {commit} into {}", tree.0.display());
        }
        Ok(tree)
    }
}

impl Drop for Tree {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Builds both commits and runs old, new and old again in each round.
fn compared(
    old: &str,
    new: Option<&str>,
    rounds: u32,
    programs: &[String],
    filter: &str,
) -> anyhow::Result<String> {
    let (root, target) = (in_workspace(""), target_folder()?);
    // A commit of the tracked files as they are, which no branch has; nothing if they are those of the last commit.
    let present = git(&root, &["stash", "create"])?;
    let new = new.unwrap_or(if present.is_empty() { "HEAD" } else { &present });
    let trees = [Tree::new(&root, old)?, Tree::new(&root, new)?];
    // Each commit is built in a folder of its own: cargo tells the crates of two copies of a workspace apart by nothing
    // but the times of the files, and would take what it built of one commit for the other.
    let build = |tree: &Tree| {
        let name = tree.0.file_name().context("it has a name")?;
        compiled(&tree.0, &target.join("compare").join(name), programs, Flags::OfSource)
    };
    let [old, new] = [build(&trees[0])?, build(&trees[1])?];
    let arguments = [&SHORT[..], &[filter]].concat();
    let mut least = [Times::new(), Times::new(), Times::new()];
    for round in 1..=rounds {
        complain!("round {round} of {rounds}");
        for (old, new) in old.iter().zip(&new) {
            for (program, least) in [old, new, old].into_iter().zip(&mut least) {
                keep_least(least, program.measure(&target.join("performance"), &arguments)?);
            }
        }
    }
    Ok(comparison(&least))
}

/// The table of the least times of the old programs, the new ones, and the old ones again, for the benches of both.
fn comparison([old, new, again]: &[Times; 3]) -> String {
    let mut text = format!("{:<24}{:>10}{:>10}{:>10}{:>10}\n", "", "old", "new", "new/old", "old/old");
    for (name, old) in old {
        let (Some(new), Some(again)) = (new.get(name), again.get(name)) else { continue };
        let least = old.min(*again);
        let (ratio, own) = (new / least, old.max(*again) / least);
        let verdict = match ratio {
            ratio if ratio > own => "slower",
            ratio if ratio * own < 1.0 => "faster",
            _ => "as fast",
        };
        let [least, new] = [least, *new].map(page::time);
        text += &format!("{name:<24}{least:>10}{new:>10}{ratio:>10.3}{own:>10.3}  {verdict}\n");
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
        assert_eq!(lines[1], ["w1/scalar", "100", "ns", "104", "ns", "1.040", "1.030", "slower"]);
        assert_eq!(lines[2][5..], ["1.030", "1.040", "as", "fast"]);
        assert_eq!(lines[3][5..], ["0.900", "1.050", "faster"]);
        assert_eq!(lines.len(), 4);
    }

    #[test]
    fn a_commit_is_unpacked_and_removed() {
        let root = in_workspace("");
        // Sources without their history can be tested, too.
        if git(&root, &["rev-parse", "HEAD"]).is_err() {
            return;
        }
        let tree = Tree::new(&root, "HEAD").expect("there");
        let path = tree.0.clone();
        assert!(path.join("Cargo.toml").is_file() && path.join(".cargo/config.toml").is_file());
        drop(tree);
        assert!(!path.exists());
        let error = Tree::new(&root, "no-such-commit").err().expect("unknown");
        assert!(format!("{error:#}").contains("no-such-commit"), "{error:#}");
    }
}
