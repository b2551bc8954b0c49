//! `cargo xtask figures`.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context as _;
use bouncing_disk_experiments::Quality;
use bouncing_disk_experiments::experiment::Entry;
use bouncing_disk_experiments::output::OutputFolder;
use bouncing_disk_experiments::registry;
use bouncing_disk_experiments::results;
use bouncing_disk_experiments::summary::Summary;
use clap::Args;

use crate::report::Report;
use crate::work::{self, Finished};

/// The folder of the figures, relative to the root of the workspace.
const DEFAULT_FOLDER: &str = "target/figures";
/// The documentation, relative to the root of the workspace.
const DOCS_FOLDER: &str = "docs";
/// Where `--docs` makes the drafts whose digests it stores, in the output folder.
const DRAFTS_FOLDER: &str = "draft";
/// What repairs the documentation.
const DOCS_COMMAND: &str = "cargo xtask figures --docs";
/// The exit status for a wrong command line, the same as that of the argument parser.
const USAGE: u8 = 2;

/// The options of `cargo xtask figures`.
#[derive(Args)]
pub(crate) struct Options {
    /// Figures and tables to make, such as fig06 or table2; all when none is given
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// How finely to sample: draft (seconds per figure) or paper
    #[arg(long, default_value = "paper", value_name = "QUALITY")]
    quality: Quality,
    /// The output folder [default: target/figures]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// List the figures and tables and whether they are up to date
    #[arg(long)]
    list: bool,
    /// Write nothing; fail when an output, docs/results.md or a picture in docs/figures is missing or out of date
    #[arg(long, conflicts_with = "force")]
    check: bool,
    /// Make everything and write docs/results.md and docs/figures from it
    #[arg(long, conflicts_with_all = ["ids", "list", "check", "quality"])]
    docs: bool,
    /// Make figures again even when they are up to date
    #[arg(long)]
    force: bool,
    /// Threads to compute with; as many as there are processors unless given
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

impl Options {
    fn folder(&self) -> PathBuf {
        self.out.clone().unwrap_or_else(|| in_workspace(DEFAULT_FOLDER))
    }

    /// The command that makes the given figures with the same options.
    fn command(&self, ids: &[&str]) -> String {
        let mut command = "cargo xtask figures".to_owned();
        for id in ids {
            command.push(' ');
            command.push_str(id);
        }
        if self.quality != Quality::default() {
            command.push_str(&format!(" --quality {}", self.quality));
        }
        if let Some(out) = &self.out {
            let out = out.to_string_lossy();
            let quoted = out.contains(|c: char| c.is_whitespace() || c == '\'');
            let out = if quoted { format!("'{}'", out.replace('\'', r"'\''")) } else { out.into_owned() };
            command.push_str(&format!(" --out {out}"));
        }
        command
    }
}

/// A path relative to the root of the workspace, where the package of this program lies.
fn in_workspace(path: &str) -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).join(path)
}

/// Does what the options ask for.
pub(crate) fn run(options: &Options) -> anyhow::Result<ExitCode> {
    let entries = registry::all();
    let selected = match registry::select(&entries, &options.ids) {
        Ok(selected) => selected,
        Err(error) => {
            eprintln!("error: {error}");
            return Ok(ExitCode::from(USAGE));
        }
    };
    if options.list {
        return Ok(list(options, &selected));
    }
    if options.check {
        return check(options, &entries, &selected);
    }
    start_threads(options)?;
    let folder = OutputFolder::create(options.folder())?;
    if options.docs {
        return write_docs(options, &entries, &selected, &folder);
    }
    make(options, options.quality, &entries, &selected, &folder)
}

/// Makes everything in both qualities and the documentation from it.
fn write_docs(
    options: &Options,
    entries: &[Box<dyn Entry>],
    selected: &[&dyn Entry],
    folder: &OutputFolder,
) -> anyhow::Result<ExitCode> {
    let drafts = OutputFolder::create(folder.path().join(DRAFTS_FOLDER))?;
    for (quality, folder) in [(Quality::Draft, &drafts), (Quality::Paper, folder)] {
        let code = make(options, quality, entries, selected, folder)?;
        if code != ExitCode::SUCCESS {
            println!("the documentation is left as it was");
            return Ok(code);
        }
    }
    let docs = OutputFolder::create(in_workspace(DOCS_FOLDER))?;
    results::write(entries, folder, &drafts, &docs).context("the documentation cannot be written")?;
    println!("{} is up to date", docs.path().join(results::RESULTS_FILE).display());
    Ok(ExitCode::SUCCESS)
}

fn start_threads(options: &Options) -> anyhow::Result<()> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads(options))
        .build_global()
        .context("cannot start the computing threads")
}

fn threads(options: &Options) -> usize {
    options.threads.map_or_else(available_threads, NonZeroUsize::get)
}

fn list(options: &Options, selected: &[&dyn Entry]) -> ExitCode {
    let folder = OutputFolder::existing(options.folder());
    let widest = selected.iter().map(|entry| entry.title().chars().count()).max().unwrap_or_default();
    for entry in selected {
        let state = match folder.check(entry.id(), options.quality) {
            Ok(()) => "up to date".to_owned(),
            Err(stale) => stale.to_string(),
        };
        println!("{:<8} {:<widest$}  {state}", entry.id(), entry.title());
    }
    ExitCode::SUCCESS
}

fn check(options: &Options, entries: &[Box<dyn Entry>], selected: &[&dyn Entry]) -> anyhow::Result<ExitCode> {
    let folder = OutputFolder::existing(options.folder());
    let mut outdated = Vec::new();
    for entry in selected {
        if let Err(stale) = folder.check(entry.id(), options.quality) {
            println!("{}: {stale}", entry.id());
            outdated.push(entry.id());
        }
    }
    let common = Summary::of(entries, &folder)?.outdated(&folder)?;
    for name in &common {
        println!("{name}: missing or out of date");
    }
    let docs = OutputFolder::existing(in_workspace(DOCS_FOLDER));
    let committed = results::outdated(selected, options.quality, &folder, &docs)?;
    for name in &committed {
        println!("{DOCS_FOLDER}/{name}: missing or out of date");
    }
    if !committed.is_empty() {
        println!("to repair: {DOCS_COMMAND}");
    }
    if outdated.is_empty() && common.is_empty() {
        if !committed.is_empty() {
            return Ok(ExitCode::FAILURE);
        }
        println!("all outputs in {} and the documentation are up to date", folder.path().display());
        return Ok(ExitCode::SUCCESS);
    }
    // With every figure out of date the list of all is no help.
    let ids = if outdated.len() == entries.len() { &options.ids[..0] } else { &options.ids[..] };
    let named: Vec<&str> = match (ids.is_empty(), outdated.len() == selected.len()) {
        (true, true) => Vec::new(),
        _ => outdated,
    };
    println!("to repair: {}", options.command(&named));
    Ok(ExitCode::FAILURE)
}

fn make(
    options: &Options,
    quality: Quality,
    entries: &[Box<dyn Entry>],
    selected: &[&dyn Entry],
    folder: &OutputFolder,
) -> anyhow::Result<ExitCode> {
    let (current, due): (Vec<_>, Vec<_>) = selected
        .iter()
        .copied()
        .partition(|entry| !options.force && folder.check(entry.id(), quality).is_ok());
    for entry in &current {
        println!("{:<8} up to date", entry.id());
    }
    let report = Report::new();
    let finished = work::make_all(&due, quality, folder, threads(options), &report);
    report.close();
    let summary = Summary::of(entries, folder)?;
    summary.write(folder)?;
    for (id, reason) in &summary.left_out {
        println!("{id}: not in the gallery and in claims.json: {reason}");
        println!("    make it again: {}", options.command(&[id]));
    }
    Ok(conclude(options, &finished, folder))
}

/// Prints the times and the failures.
fn conclude(options: &Options, finished: &[Finished], folder: &OutputFolder) -> ExitCode {
    let mut made: Vec<_> = finished.iter().filter(|figure| figure.result.is_ok()).collect();
    made.sort_by_key(|figure| std::cmp::Reverse(figure.run_time));
    if !made.is_empty() {
        println!("\nrun times, longest first");
        for figure in &made {
            println!("{:<8} {:>9.2} s", figure.id, figure.run_time.as_secs_f64());
        }
    }
    println!("\nfigures, claims.json and index.html are in {}", folder.path().display());
    let failed: Vec<_> =
        finished.iter().filter_map(|f| f.result.as_ref().err().map(|error| (f.id, error))).collect();
    if failed.is_empty() {
        return ExitCode::SUCCESS;
    }
    println!("\n{} of {} failed", failed.len(), finished.len());
    for (id, error) in failed {
        println!("{id}: {error:#}");
        println!("    run it again: {}", options.command(&[id]));
    }
    ExitCode::FAILURE
}

fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, NonZeroUsize::get)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(quality: Quality, out: Option<&str>) -> Options {
        Options {
            ids: Vec::new(),
            quality,
            out: out.map(PathBuf::from),
            list: false,
            check: false,
            docs: false,
            force: false,
            threads: None,
        }
    }

    #[test]
    fn the_command_repeats_the_options() {
        assert_eq!(options(Quality::Paper, None).command(&[]), "cargo xtask figures");
        assert_eq!(
            options(Quality::Draft, Some("my figures")).command(&["fig06"]),
            "cargo xtask figures fig06 --quality draft --out 'my figures'"
        );
    }

    #[test]
    fn the_default_folder_is_that_of_the_workspace() {
        let folder = options(Quality::Paper, None).folder();
        assert!(folder.ends_with(DEFAULT_FOLDER), "{}", folder.display());
        assert!(!folder.to_string_lossy().contains("xtask"), "{}", folder.display());
    }
}
