//! `cargo xtask figures`.

use std::ffi::OsStr;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context as _;
use bouncing_disk_experiments::cache_key::Stale;
use bouncing_disk_experiments::experiment::RegisteredExperiment;
use bouncing_disk_experiments::output::OutputFolder;
use bouncing_disk_experiments::registry;
use bouncing_disk_experiments::report::gallery::Summary;
use bouncing_disk_experiments::report::pages::{self, Pictures};
use bouncing_disk_experiments::{Measurements, Quality};
use clap::Args;

use crate::output::{complain, say};
use crate::report::Report;
use crate::visible::{visible, visible_path};
use crate::work::{self, Finished};
use crate::workspace::{DOCS_FOLDER, in_workspace};

/// The folder of the figures, relative to the root of the workspace.
const DEFAULT_FOLDER: &str = "target/figures";
/// Where `--docs` makes the drafts whose digests it stores, in the output folder.
const DRAFTS_FOLDER: &str = "draft";
/// The command that repairs the documentation.
const DOCS_COMMANDS: [(Pictures, &str); 2] = [
    (Pictures::Paper, "cargo xtask figures --docs"),
    (Pictures::Extras, "cargo xtask figures --extras --docs"),
];
/// The folder of a user's measurements, relative to the root of the workspace.
const MEASURED_FOLDER: &str = "data/measured";
/// The most computing threads: more than any machine has that this runs on, and few enough to be started at
/// once. Tens of thousands take minutes to start and more to find that there is nothing to do.
const MOST_THREADS: i64 = 1024;
/// The exit status for a wrong command line, the same as that of the argument parser.
const USAGE: u8 = 2;

/// The options of `cargo xtask figures`.
#[derive(Args, Default)]
pub(crate) struct Options {
    /// Figures and tables to make, such as fig06 or table2; those of the paper when none is given
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// Make the figures beyond the paper, such as extra-torque-speed
    #[arg(long, conflicts_with = "ids")]
    extras: bool,
    /// How finely to sample: draft (seconds per figure) or paper
    #[arg(long, default_value = "paper", value_name = "QUALITY")]
    quality: Quality,
    /// The output folder [default: target/figures]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The folder with your own measurements [default: data/measured]
    #[arg(long, value_name = "DIR")]
    measured: Option<PathBuf>,
    /// List the figures and tables and whether they are up to date
    #[arg(long)]
    list: bool,
    /// Write nothing; fail when an output, docs/results.md, docs/errata.md or a picture in docs/figures, with --extras a
    /// picture in docs/extras, is missing or out of date
    #[arg(long, conflicts_with = "force")]
    check: bool,
    /// Make the figures and tables of the paper and write docs/results.md, docs/errata.md and docs/figures from it; with
    /// --extras make those beyond the paper and write docs/extras
    #[arg(long, conflicts_with_all = ["ids", "list", "check", "quality"])]
    docs: bool,
    /// Make figures again even when they are up to date
    #[arg(long)]
    force: bool,
    /// Threads to compute with, 1 to 1024; as many as there are processors unless given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=MOST_THREADS))]
    threads: Option<u16>,
}

impl Options {
    fn folder(&self) -> PathBuf {
        self.out.clone().unwrap_or_else(|| in_workspace(DEFAULT_FOLDER))
    }

    fn measured_folder(&self) -> PathBuf {
        self.measured.clone().unwrap_or_else(|| in_workspace(MEASURED_FOLDER))
    }

    /// The command that makes the given figures with the same options.
    fn command(&self, ids: &[&str]) -> String {
        let mut command = "cargo xtask figures".to_owned();
        for id in ids {
            command.push(' ');
            command.push_str(id);
        }
        if self.extras && ids.is_empty() {
            command.push_str(" --extras");
        }
        if self.quality != Quality::default() {
            command.push_str(&format!(" --quality {}", self.quality));
        }
        for (option, folder) in [("--out", &self.out), ("--measured", &self.measured)] {
            let Some(folder) = folder else { continue };
            let folder = shell_word(folder.as_os_str());
            // With an equals sign, as a name may begin like an option.
            command.push_str(&format!(" {option}={folder}"));
        }
        command
    }
}

/// A word that a shell reads back as this text. The command it is part of is there to be copied.
fn shell_word(text: &OsStr) -> String {
    let bytes = text.as_encoded_bytes();
    let plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"/._-+=:,@%".contains(byte);
    match text.to_str() {
        Some(text) if !bytes.is_empty() && bytes.iter().all(plain) => text.to_owned(),
        Some(text) if visible(text) == text => format!("'{}'", text.replace('\'', r"'\''")),
        _ => {
            let mut word = "$'".to_owned();
            for byte in bytes {
                match byte {
                    b'\'' | b'\\' => word.extend(['\\', char::from(*byte)]),
                    b' '..=b'~' => word.push(char::from(*byte)),
                    _ => word.push_str(&format!("\\x{byte:02x}")),
                }
            }
            word.push('\'');
            word
        }
    }
}

/// Does what the options ask for.
pub(crate) fn run(options: &Options) -> anyhow::Result<ExitCode> {
    let entries = registry::all();
    let mut selected = match registry::select(&entries, &options.ids) {
        Ok(selected) => selected,
        Err(error) => {
            complain!("error: {error}");
            return Ok(ExitCode::from(USAGE));
        }
    };
    if options.ids.is_empty() {
        selected.retain(|entry| entry.is_extra() == options.extras);
    }
    let folder = options.measured_folder();
    // The default folder may be missing; one that was asked for may not.
    if options.measured.is_some() && !folder.is_dir() {
        complain!("error: --measured {}: there is no such folder", visible_path(&folder));
        return Ok(ExitCode::from(USAGE));
    }
    let measurements = Measurements::read(&folder, &registry::measurements(&entries))
        .with_context(|| format!("cannot read the measurements in {}", visible_path(&folder)))?;
    let run = Run { options, entries: &entries, selected: &selected, measurements: &measurements };
    if options.list {
        return run.list();
    }
    if options.check {
        return run.check();
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads(options));
    pool.build_global().context("cannot start the computing threads")?;
    let folder = OutputFolder::create(options.folder())?;
    if options.docs {
        // A user's measurements are not shown in the documentation.
        return Run { measurements: &Measurements::none(), ..run }.write_docs(&folder);
    }
    run.make(options.quality, &folder)
}

fn threads(options: &Options) -> usize {
    let available = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    options.threads.map_or_else(available, usize::from)
}

/// The width of the column of the identifiers.
fn width_of_ids<'a>(ids: impl Iterator<Item = &'a str>) -> usize {
    ids.map(str::len).fold(8, usize::max)
}

/// What is to be made, and the measurements that are shown.
struct Run<'a> {
    options: &'a Options,
    entries: &'a [RegisteredExperiment],
    selected: &'a [&'a RegisteredExperiment],
    measurements: &'a Measurements,
}

impl Run<'_> {
    /// Whether a figure is up to date with the sources and the measurements.
    fn state(
        &self,
        entry: &RegisteredExperiment,
        quality: Quality,
        folder: &OutputFolder,
    ) -> Result<(), Stale> {
        folder.check(entry.id, quality, &self.measurements.digest(entry.measurements))
    }

    fn list(&self) -> anyhow::Result<ExitCode> {
        let folder = OutputFolder::existing(self.options.folder());
        let widest_id = width_of_ids(self.selected.iter().map(|entry| entry.id));
        let widest = self.selected.iter().map(|entry| entry.title.chars().count()).max().unwrap_or_default();
        for entry in self.selected {
            let state = match self.state(entry, self.options.quality, &folder) {
                Ok(()) => "up to date".to_owned(),
                Err(stale) => stale.to_string(),
            };
            say!("{:<widest_id$} {:<widest$}  {state}", entry.id, entry.title)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Makes the figures of the paper, or those beyond it, in both qualities and the documentation from it.
    fn write_docs(&self, folder: &OutputFolder) -> anyhow::Result<ExitCode> {
        let drafts = OutputFolder::create(folder.path().join(DRAFTS_FOLDER))?;
        for (quality, folder) in [(Quality::Draft, &drafts), (Quality::Paper, folder)] {
            let code = self.make(quality, folder)?;
            if code != ExitCode::SUCCESS {
                say!("the documentation is left as it was")?;
                return Ok(code);
            }
        }
        let docs = OutputFolder::create(in_workspace(DOCS_FOLDER))?;
        let pictures = if self.options.extras { Pictures::Extras } else { Pictures::Paper };
        pages::write(pictures, self.selected, folder, &drafts, &docs)
            .context("the documentation cannot be written")?;
        say!("{} is up to date", visible_path(docs.path()))?;
        Ok(ExitCode::SUCCESS)
    }

    /// What is wrong with the measurements for the selected figures, and with files that no figure reads.
    fn faults(&self, summary: &Summary) -> Vec<String> {
        let of_figures = summary
            .warnings
            .iter()
            .filter(|(id, _)| self.selected.iter().any(|entry| entry.id == id))
            .map(|(id, warning)| format!("{id}: measurements not shown: {warning}"));
        let unknown = self.measurements.unknown();
        let mut faults: Vec<String> = of_figures.chain(unknown.iter().map(ToString::to_string)).collect();
        if !faults.is_empty() {
            let folder = self.options.measured_folder();
            faults.push(format!(
                "measurements are read from {}; its README.md states their form",
                visible_path(&folder)
            ));
        }
        faults
    }

    fn check(&self) -> anyhow::Result<ExitCode> {
        let Self { options, entries, selected, measurements } = *self;
        let folder = OutputFolder::existing(options.folder());
        let mut outdated = Vec::new();
        for entry in selected {
            if let Err(stale) = self.state(entry, options.quality, &folder) {
                say!("{}: {stale}", entry.id)?;
                outdated.push(entry.id);
            }
        }
        let summary = Summary::of(entries, &folder, measurements)?;
        let common = summary.outdated(&folder)?;
        for name in &common {
            say!("{name}: missing or out of date")?;
        }
        let faults = self.faults(&summary);
        for fault in &faults {
            say!("{fault}")?;
        }
        let docs = OutputFolder::existing(in_workspace(DOCS_FOLDER));
        let mut committed = 0;
        for (pictures, command) in DOCS_COMMANDS {
            // A figure with a user's measurements is not the one of the documentation, which has none.
            let comparable: Vec<&RegisteredExperiment> = selected
                .iter()
                .copied()
                .filter(|entry| entry.is_extra() == (pictures == Pictures::Extras))
                .filter(|entry| measurements.digest(entry.measurements).is_empty())
                .collect();
            let names = pages::outdated(pictures, &comparable, options.quality, &folder, &docs)?;
            for name in &names {
                say!("{DOCS_FOLDER}/{name}: missing or out of date")?;
            }
            if !names.is_empty() {
                say!("to repair: {command}")?;
            }
            committed += names.len();
        }
        if outdated.is_empty() && common.is_empty() {
            if committed > 0 || !faults.is_empty() {
                return Ok(ExitCode::FAILURE);
            }
            say!("all outputs in {} and the documentation are up to date", visible_path(folder.path()))?;
            return Ok(ExitCode::SUCCESS);
        }
        // With every figure out of date the list of all is no help.
        let paper: Vec<&str> = registry::paper().iter().map(|entry| entry.id).collect();
        let all = options.ids.is_empty() && outdated.len() == selected.len() || outdated == paper;
        let named = if all { Vec::new() } else { outdated };
        say!("to repair: {}", options.command(&named))?;
        Ok(ExitCode::FAILURE)
    }

    fn make(&self, quality: Quality, folder: &OutputFolder) -> anyhow::Result<ExitCode> {
        let Self { options, entries, selected, measurements } = *self;
        let (current, due): (Vec<_>, Vec<_>) = selected
            .iter()
            .copied()
            .partition(|entry| !options.force && self.state(entry, quality, folder).is_ok());
        let widest = width_of_ids(current.iter().map(|entry| entry.id));
        for entry in &current {
            say!("{:<widest$} up to date", entry.id)?;
        }
        let report = Report::new();
        let finished = work::make_all(&due, quality, measurements, folder, threads(options), &report);
        report.close();
        let summary = match Summary::update(entries, folder, measurements) {
            Ok(summary) => summary,
            Err(error) => {
                // What one full disk has done to the figures, too, is not known otherwise.
                say_failures(options, &finished)?;
                return Err(error.into());
            }
        };
        for (id, reason) in &summary.left_out {
            say!("{id}: not in the gallery and in claims.json: {reason}")?;
            say!("    make it again: {}", options.command(&[id]))?;
        }
        self.conclude(&finished, folder, &summary)
    }

    /// Prints the times, the measurements that were left out and the failures.
    ///
    /// Measurements that cannot be used count as a failure: the figure is there, but not as it was asked for, and
    /// a script must not take it for one that shows them.
    fn conclude(
        &self,
        finished: &[Finished],
        folder: &OutputFolder,
        summary: &Summary,
    ) -> anyhow::Result<ExitCode> {
        let mut made: Vec<_> = finished.iter().filter(|figure| figure.result.is_ok()).collect();
        made.sort_by_key(|figure| std::cmp::Reverse(figure.run_time));
        if !made.is_empty() {
            say!("\nrun times, longest first")?;
            let widest = width_of_ids(made.iter().map(|figure| figure.id));
            for figure in &made {
                say!("{:<widest$} {:>9.2} s", figure.id, figure.run_time.as_secs_f64())?;
            }
        }
        say!("\nfigures, claims.json and index.html are in {}", visible_path(folder.path()))?;
        say!("{}", summary.counts.headline())?;
        say!("{}", summary.counts.beside())?;
        let faults = self.faults(summary);
        if !faults.is_empty() {
            say!("")?;
        }
        for fault in &faults {
            say!("{fault}")?;
        }
        let failures = say_failures(self.options, finished)?;
        Ok(if failures == 0 && faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }
}

/// Prints why figures have failed, and gives their number.
fn say_failures(options: &Options, finished: &[Finished]) -> anyhow::Result<usize> {
    let failed: Vec<_> =
        finished.iter().filter_map(|f| f.result.as_ref().err().map(|error| (f.id, error))).collect();
    if !failed.is_empty() {
        say!("\n{} of {} failed", failed.len(), finished.len())?;
    }
    for (id, error) in &failed {
        say!("{id}: {error:#}")?;
        say!("    run it again: {}", options.command(&[id]))?;
    }
    Ok(failed.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(quality: Quality, out: Option<&str>) -> Options {
        Options { quality, out: out.map(PathBuf::from), ..Options::default() }
    }

    #[test]
    fn the_command_repeats_the_options() {
        assert_eq!(options(Quality::Paper, None).command(&[]), "cargo xtask figures");
        let extras = Options { extras: true, ..options(Quality::Draft, None) };
        assert_eq!(extras.command(&[]), "cargo xtask figures --extras --quality draft");
        assert_eq!(extras.command(&["extra-fit"]), "cargo xtask figures extra-fit --quality draft");
        assert_eq!(
            options(Quality::Draft, Some("my figures")).command(&["fig06"]),
            "cargo xtask figures fig06 --quality draft --out='my figures'"
        );
        for (folder, word) in [
            ("$(reboot)", "'$(reboot)'"),
            ("it's", r"'it'\''s'"),
            ("a\nb\u{1b}'", r"$'a\x0ab\x1b\''"),
            ("", "''"),
            ("/tmp/a_b-1.2", "/tmp/a_b-1.2"),
        ] {
            assert_eq!(
                options(Quality::Paper, Some(folder)).command(&[]),
                format!("cargo xtask figures --out={word}")
            );
        }
    }

    /// The options as a whole command line.
    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        options: Options,
    }

    #[test]
    fn the_documentation_is_written_of_all_or_of_the_extras() {
        use clap::Parser as _;
        let parse = |arguments: &[&str]| Line::try_parse_from([&["figures"], arguments].concat());
        let both = parse(&["--docs", "--extras"]).map(|line| (line.options.docs, line.options.extras));
        assert_eq!(both.ok(), Some((true, true)));
        assert!(parse(&["--docs"]).is_ok() && parse(&["--extras", "--check"]).is_ok());
        assert!(parse(&["--docs", "fig01"]).is_err() && parse(&["--docs", "--check"]).is_err());
    }
}
