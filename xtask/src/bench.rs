//! `cargo xtask bench`.

mod criterion;
mod page;
mod record;
mod table;
mod workloads;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

use anyhow::{Context as _, bail};
use bouncing_disk_experiments::output::OutputFolder;
use clap::Args;

use crate::output::{complain, say};
use crate::workspace::{DOCS_FOLDER, in_workspace};
use criterion::PROGRAMS;
use record::{FigureTimes, Machine, Record};

/// The folder of the stored baseline, relative to the root of the workspace.
const BASELINE_FOLDER: &str = "data/performance";
const BASELINE_FILE: &str = "baseline.json";
const PAGE_FILE: &str = "performance.md";
/// The folder of criterion's results, in the target folder.
const RESULTS_FOLDER: &str = "performance";

/// How often everything is measured at least.
const REPETITIONS: u32 = 8;

/// The options of `cargo xtask bench`.
#[derive(Args)]
pub(crate) struct Options {
    /// Bench programs to run, such as impact or basin; all when none is given
    #[arg(value_name = "PROGRAM", value_parser = criterion::NAMES, conflicts_with = "reuse")]
    programs: Vec<String>,
    /// Show the ratios of the stored baseline beside this run's and write docs/performance.md
    #[arg(long)]
    compare: bool,
    /// Measure everything only once
    #[arg(long, conflicts_with = "reuse")]
    quick: bool,
    /// Store this run in data/performance/baseline.json
    #[arg(long)]
    save_baseline: bool,
    /// Measure the wall time of `cargo xtask figures` in both qualities as well
    #[arg(long)]
    figures: bool,
    /// Measure the wall time of a release build of xtask in an empty target folder as well
    #[arg(long)]
    build: bool,
    /// Take the results of the last run instead of measuring
    #[arg(long)]
    reuse: bool,
}

/// Does what the options ask for.
pub(crate) fn run(options: &Options) -> anyhow::Result<ExitCode> {
    let baseline_path = in_workspace(BASELINE_FOLDER).join(BASELINE_FILE);
    // Before the run: nobody should wait for minutes to hear that the baseline cannot be read.
    let baseline = options
        .compare
        .then(|| Record::read(&baseline_path, "cargo xtask bench --save-baseline"))
        .transpose()?;
    let run = measured(options)?;
    say!("{}", table::aligned(&table::rows(&run, baseline.as_ref())).trim_end())?;
    say!(
        "\na ratio is a time over that of its reference kernel, measured before and after in the same program"
    )?;
    if run.machine.processors < 2 {
        say!("one processor was available: the times with two threads show no speed-up")?;
    }
    if options.compare {
        let page = page::page(&run, baseline.as_ref())?;
        let docs = OutputFolder::create(in_workspace(DOCS_FOLDER))?;
        docs.write(PAGE_FILE, page.as_bytes())?;
        say!("{} is written", docs.path().join(PAGE_FILE).display())?;
    }
    if options.save_baseline {
        OutputFolder::create(in_workspace(BASELINE_FOLDER))?.write(BASELINE_FILE, &run.to_json()?)?;
        say!("{} is written", baseline_path.display())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The times of all benches, measured now or taken from the last run.
fn measured(options: &Options) -> anyhow::Result<Record> {
    let (root, results) = (in_workspace(""), results_folder()?);
    let stored = results.join("run.json");
    if options.reuse {
        let mut record = Record::read(&stored, "cargo xtask bench")?;
        if (options.build || options.figures) && machine(&root)? != record.machine {
            bail!(
                "the last run was of {}, not of what is there now; run without --reuse",
                record.machine.source
            );
        }
        measure_programs(options, &results, &mut record)?;
        return Ok(record);
    }
    let machine = machine(&root)?;
    let fresh =
        Record { machine, quick: options.quick, benches: Default::default(), figures: None, build_s: None };
    // Single programs add to the last run, if that was one of the same source and kind.
    let mut record = if options.programs.is_empty() || !stored.exists() {
        fresh
    } else {
        match Record::read(&stored, "cargo xtask bench") {
            Ok(last) if last.machine == fresh.machine && last.quick == fresh.quick => last,
            Ok(last) => {
                let (quick, source) = (if last.quick { "short " } else { "" }, last.machine.source);
                complain!(
                    "the last {quick}run, of {source}, was not of this source, machine and kind: a new one begins"
                );
                fresh
            }
            Err(error) => {
                complain!("{error:#}: a new run begins");
                fresh
            }
        }
    };
    let selected = |name: &str| options.programs.is_empty() || options.programs.iter().any(|own| own == name);
    // All programs again and again: a neighbour on the machine mostly stays for some minutes.
    for _ in 0..if options.quick { 1 } else { REPETITIONS } {
        for program in PROGRAMS.into_iter().filter(|program| selected(program.name())) {
            program.run(&root, &results)?;
            record.add(program.read(&results)?);
            // Now, so that a run that is broken off loses no more than one program.
            OutputFolder::create(results.clone())?.write("run.json", &record.to_json()?)?;
        }
    }
    measure_programs(options, &results, &mut record)?;
    Ok(record)
}

/// Measures whole programs, as far as it was asked for, and stores the record with their times.
fn measure_programs(options: &Options, results: &Path, record: &mut Record) -> anyhow::Result<()> {
    // After each, so that a failure of the next one does not lose it.
    let store = |record: &Record| -> anyhow::Result<()> {
        OutputFolder::create(results.to_path_buf())?.write("run.json", &record.to_json()?)?;
        Ok(())
    };
    if options.build {
        record.build_s = Some(build_time(results)?);
        store(record)?;
    }
    if options.figures {
        record.figures = Some(figure_times(results)?);
        store(record)?;
    }
    Ok(())
}

/// In the folder that cargo builds into.
fn results_folder() -> anyhow::Result<PathBuf> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| in_workspace("target"), PathBuf::from);
    let target = std::path::absolute(target).context("cannot tell where the target folder is")?;
    Ok(target.join(RESULTS_FOLDER))
}

fn machine(root: &Path) -> anyhow::Result<Machine> {
    let compiler = said(Command::new("rustc").arg("--version")).context("cannot start rustc")?;
    let git = || {
        let mut git = Command::new("git");
        git.current_dir(root);
        git
    };
    // What this command writes is not what it measures.
    let products = [BASELINE_FOLDER.to_owned(), format!("{DOCS_FOLDER}/{PAGE_FILE}")];
    let products = products.map(|product| format!(":(exclude){product}"));
    let changes =
        said(git().args(["status", "--porcelain", "--untracked-files=no", "--", "."]).args(products));
    let source = said(git().args(["describe", "--always"]))
        .and_then(|source| Ok(if changes?.is_empty() { source } else { format!("{source}-dirty") }));
    let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    Ok(Machine {
        processor: processor.unwrap_or_else(|| format!("unknown ({})", std::env::consts::ARCH)),
        processors: std::thread::available_parallelism().map_or(1, NonZeroUsize::get),
        compiler,
        source: source.unwrap_or_else(|_| "unknown".to_owned()),
    })
}

/// What a program prints.
fn said(command: &mut Command) -> anyhow::Result<String> {
    let output = command.output()?;
    if !output.status.success() {
        bail!("{}", String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Wall time of a release build of xtask into an empty folder, which is removed again.
fn build_time(results: &Path) -> anyhow::Result<f64> {
    let target = results.join("build");
    let remove = || match std::fs::remove_dir_all(&target) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    };
    remove().with_context(|| format!("cannot empty {}", target.display()))?;
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "--release", "--locked", "--package", "xtask", "--target-dir"]).arg(&target);
    // A cache of compiled crates would make it another build.
    cargo.env_remove("RUSTC_WRAPPER").env_remove("CARGO_BUILD_RUSTC_WRAPPER");
    let start = Instant::now();
    let status = cargo.current_dir(in_workspace("")).status().context("cannot start cargo")?;
    let seconds = start.elapsed().as_secs_f64();
    remove().with_context(|| format!("cannot remove {}", target.display()))?;
    if !status.success() {
        bail!("cargo build failed: {status}");
    }
    Ok(seconds.round())
}

/// Wall times of all figures, made anew into a folder that is removed again.
fn figure_times(results: &Path) -> anyhow::Result<FigureTimes> {
    let program = std::env::current_exe().context("cannot tell where this program is")?;
    let out = results.join("figures");
    let time = |quality: &str| -> anyhow::Result<f64> {
        let mut command = Command::new(&program);
        command.args(["figures", "--force", "--quality", quality, "--out"]).arg(&out);
        let start = Instant::now();
        let status = command.status().context("cannot start cargo xtask figures")?;
        let seconds = start.elapsed().as_secs_f64();
        if !status.success() {
            bail!("cargo xtask figures --quality {quality} failed: {status}");
        }
        Ok((seconds * 100.0).round() / 100.0)
    };
    let times = FigureTimes { draft_s: time("draft")?, paper_s: time("paper")? };
    std::fs::remove_dir_all(&out).with_context(|| format!("cannot remove {}", out.display()))?;
    Ok(times)
}
