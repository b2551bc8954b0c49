//! `cargo xtask figures`.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context as _;
use bouncing_disk_experiments::Quality;
use bouncing_disk_experiments::experiment::{Experiment, Made};
use bouncing_disk_experiments::output::OutputFolder;
use bouncing_disk_experiments::registry;
use bouncing_disk_experiments::report::gallery::Summary;
use bouncing_disk_experiments::report::pages;
use clap::Args;

use crate::output::{complain, say};
use crate::report::Report;
use crate::work::{self, Finished};
use crate::workspace::{DOCS_FOLDER, in_workspace};

/// The folder of the figures, relative to the root of the workspace.
const DEFAULT_FOLDER: &str = "target/figures";
/// Where `--docs` makes the drafts whose digests it stores, in the output folder.
const DRAFTS_FOLDER: &str = "draft";
/// The command that repairs the documentation.
const DOCS_COMMAND: &str = "cargo xtask figures --docs";
/// The most computing threads: more than any machine has that this runs on, and few enough to be started at
/// once. Tens of thousands take minutes to start and more to find that there is nothing to do.
const MOST_THREADS: i64 = 1024;
/// The exit status for a wrong command line, as in the argument parser.
const USAGE: u8 = 2;

/// The options of `cargo xtask figures`.
#[derive(Args, Default)]
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
    /// List the figures and tables
    #[arg(long)]
    list: bool,
    /// Write nothing; compute, and fail when docs/results.md, docs/errata.md or a picture in docs/figures is
    /// missing, edited, or made from other figures
    #[arg(long)]
    check: bool,
    /// Make all figures and tables in both qualities, and write docs/results.md, docs/errata.md and docs/figures from
    /// them
    #[arg(long, conflicts_with_all = ["ids", "list", "check", "quality"])]
    docs: bool,
    /// Threads to compute with, 1 to 1024; as many as there are processors unless given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=MOST_THREADS))]
    threads: Option<u16>,
}

impl Options {
    fn folder(&self) -> PathBuf {
        self.out.clone().unwrap_or_else(|| in_workspace(DEFAULT_FOLDER))
    }

    fn threads(&self) -> usize {
        let available = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.threads.map_or_else(available, usize::from)
    }
}

/// Does what the options ask for.
pub(crate) fn run(options: &Options) -> anyhow::Result<ExitCode> {
    let entries = registry::all();
    let selected = match registry::select(&entries, &options.ids) {
        Ok(selected) => selected,
        Err(error) => {
            complain!("error: {error}");
            return Ok(ExitCode::from(USAGE));
        }
    };
    if options.list {
        let widest = width_of_ids(selected.iter().map(|entry| entry.id));
        for entry in selected {
            say!("{:<widest$} {}", entry.id, entry.title)?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(options.threads());
    pool.build_global().context("cannot start the computing threads")?;
    let run = Run { options, entries: &entries, selected: &selected };
    if options.check {
        return run.check();
    }
    let folder = OutputFolder::create(options.folder())?;
    if options.docs { run.write_docs(&folder) } else { Ok(run.make(options.quality, &folder)?.0) }
}

/// The width of the column of the identifiers.
fn width_of_ids<'a>(ids: impl Iterator<Item = &'a str>) -> usize {
    ids.map(str::len).fold(8, usize::max)
}

/// What is to be made.
struct Run<'a> {
    options: &'a Options,
    entries: &'a [Experiment],
    selected: &'a [&'a Experiment],
}

impl Run<'_> {
    /// Makes all figures in both qualities and the documentation from them.
    fn write_docs(&self, folder: &OutputFolder) -> anyhow::Result<ExitCode> {
        let drafts = OutputFolder::create(folder.path().join(DRAFTS_FOLDER))?;
        let (code, draft) = self.make(Quality::Draft, &drafts)?;
        if code != ExitCode::SUCCESS {
            say!("the documentation is left as it was")?;
            return Ok(code);
        }
        let (code, paper) = self.make(Quality::Paper, folder)?;
        if code != ExitCode::SUCCESS {
            say!("the documentation is left as it was")?;
            return Ok(code);
        }
        let docs = OutputFolder::create(in_workspace(DOCS_FOLDER))?;
        pages::write(&paper, &draft, &docs).context("the documentation cannot be written")?;
        say!("{} is up to date", docs.path().display())?;
        Ok(ExitCode::SUCCESS)
    }

    fn check(&self) -> anyhow::Result<ExitCode> {
        let finished = self.finished(self.options.quality, Ok);
        if say_failures(&finished)? > 0 {
            return Ok(ExitCode::FAILURE);
        }
        let figures: Vec<Made> = finished.into_iter().filter_map(|figure| figure.result.ok()).collect();
        let docs = OutputFolder::existing(in_workspace(DOCS_FOLDER));
        let outdated = pages::outdated(&figures, &docs)?;
        for name in &outdated {
            say!("{DOCS_FOLDER}/{name}: missing or out of date")?;
        }
        if outdated.is_empty() {
            say!("the documentation is up to date")?;
            return Ok(ExitCode::SUCCESS);
        }
        say!("to repair: {DOCS_COMMAND}")?;
        Ok(ExitCode::FAILURE)
    }

    fn finished<T: Send>(
        &self,
        quality: Quality,
        keep: impl Fn(Made) -> anyhow::Result<T> + Sync,
    ) -> Vec<Finished<T>> {
        let report = Report::new();
        let finished = work::make_all(self.selected, quality, self.options.threads(), &report, keep);
        report.close();
        finished
    }

    /// Makes the figures and writes their files and the gallery; gives them in the order of the list.
    fn make(&self, quality: Quality, folder: &OutputFolder) -> anyhow::Result<(ExitCode, Vec<Made>)> {
        let keep = |made: Made| {
            folder.write_all(&made.files()?)?;
            Ok(made)
        };
        let finished = self.finished(quality, keep);
        let summary = match Summary::update(self.entries, folder) {
            Ok(summary) => summary,
            Err(error) => {
                // What one full disk has done to the figures, too, is not known otherwise.
                say_failures(&finished)?;
                return Err(error.into());
            }
        };
        for (id, reason) in &summary.left_out {
            say!("{id}: not in the gallery and in claims.json: {reason}")?;
        }
        let mut made: Vec<_> = finished.iter().filter(|figure| figure.result.is_ok()).collect();
        made.sort_by_key(|figure| std::cmp::Reverse(figure.run_time));
        if !made.is_empty() {
            say!("\nrun times, longest first")?;
            let widest = width_of_ids(made.iter().map(|figure| figure.id));
            for figure in &made {
                say!("{:<widest$} {:>9.2} s", figure.id, figure.run_time.as_secs_f64())?;
            }
        }
        say!("\nfigures, claims.json and index.html are in {}", folder.path().display())?;
        say!("{}", summary.counts.headline())?;
        say!("{}", summary.counts.beside())?;
        let failures = say_failures(&finished)?;
        let code = if failures == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE };
        let mut figures: Vec<Made> = finished.into_iter().filter_map(|figure| figure.result.ok()).collect();
        figures.sort_by_key(|made| self.entries.iter().position(|entry| entry.id == made.record.id));
        Ok((code, figures))
    }
}

/// Prints why figures have failed, and gives their number.
fn say_failures<T>(finished: &[Finished<T>]) -> anyhow::Result<usize> {
    let failed: Vec<_> =
        finished.iter().filter_map(|f| f.result.as_ref().err().map(|error| (f.id, error))).collect();
    if !failed.is_empty() {
        say!("\n{} of {} failed", failed.len(), finished.len())?;
    }
    for (id, error) in &failed {
        say!("{id}: {error:#}")?;
    }
    Ok(failed.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The options as a whole command line.
    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        options: Options,
    }

    #[test]
    fn the_documentation_is_written_of_all() {
        use clap::Parser as _;
        let parse = |arguments: &[&str]| Line::try_parse_from([&["figures"], arguments].concat());
        assert!(parse(&["--docs"]).is_ok_and(|line| line.options.docs));
        assert!(parse(&["--docs", "fig01"]).is_err() && parse(&["--docs", "--check"]).is_err());
    }
}
