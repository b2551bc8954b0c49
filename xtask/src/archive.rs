//! `cargo xtask archive`: the claims, the data behind them and the report, as a repository of data keeps them.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use anyhow::{Context as _, Result, ensure};
use bouncing_disk_experiments::output::OutputFolder;
use bouncing_disk_experiments::report::gallery::{CLAIMS_FILE, SCHEMA_FILE, Summary, TABLE_FILE};
use bouncing_disk_experiments::report::pages::{self, Pictures, REPORT_FILE};
use bouncing_disk_experiments::{Measurements, Quality, registry};
use clap::Args;
use flate2::{Compression, GzBuilder};

use crate::output::say;
use crate::workspace::{DOCS_FOLDER, in_workspace};
use crate::{figures, typeset};

/// The folder in that of the outputs: `bouncing-disk-VERSION-archive`, and the same as one `.tar.gz`.
const FOLDER: &str = "archive";
const CITATION: &str = "CITATION.cff";
/// All files together may be so large (bytes).
const LARGEST: usize = 20_000_000;
/// Sets the report, and prints all files as one tape archive.
const PROGRAM: &str = include_str!("archive.py");

#[derive(Args)]
pub(crate) struct Options {
    /// Write a folder, and the same as one compressed file, into the folder `archive` of this one
    #[arg(long, value_name = "DIR", default_value = "target/dist")]
    out: PathBuf,
    /// A Python with the package typst of PyPI, 0.15.2
    #[arg(long, value_name = "PATH", default_value = "python3")]
    python: PathBuf,
}

pub(crate) fn run(options: &Options) -> Result<ExitCode> {
    archive(
        &in_workspace("").join(&options.out),
        &options.python,
        &in_workspace("target/dist-build/figures"),
    )?;
    Ok(ExitCode::SUCCESS)
}

/// Makes the archive in `out`, in a folder of their own the figures where they are out of date, and the PDF by the package
/// `typst` of a Python. The same sources make the same bytes.
pub(crate) fn archive(out: &Path, python: &Path, own_figures: &Path) -> Result<()> {
    let made = figures::of_the_paper(own_figures)?;
    let docs = OutputFolder::existing(in_workspace(DOCS_FOLDER));
    let entries = registry::paper();
    let outdated =
        pages::outdated(Pictures::Paper, &entries.iter().collect::<Vec<_>>(), Quality::Paper, &made, &docs)?;
    ensure!(
        outdated.is_empty(),
        "not of these figures: {}; run cargo xtask figures --docs",
        outdated.join(", ")
    );
    let summary = Summary::of(&entries, &made, &Measurements::none())?;
    let report = fs::read_to_string(docs.path().join(REPORT_FILE)).context("the report cannot be read")?;
    let (typst, pictures) = typeset::typst(&report)?;
    let mut files = vec![
        (CLAIMS_FILE.to_owned(), summary.claims.into_bytes()),
        (TABLE_FILE.to_owned(), summary.table.into_bytes()),
        (SCHEMA_FILE.to_owned(), summary.schema.into_bytes()),
        (CITATION.to_owned(), read(&in_workspace(CITATION))?),
        (REPORT_FILE.to_owned(), report.into_bytes()),
    ];
    for entry in &entries {
        files.push((
            format!("data/{}.json", entry.id),
            read(&made.path().join(format!("{}.json", entry.id)))?,
        ));
    }
    for picture in pictures {
        // The figures of the paper are larger where they are made than on the page.
        let own = picture.strip_prefix("figures/").map(|name| made.path().join(name));
        let path = own.unwrap_or_else(|| docs.path().join(&picture));
        files.push((picture, read(&path)?));
    }
    let size: usize = files.iter().map(|(_, bytes)| bytes.len()).sum();
    ensure!(size <= LARGEST, "the archive has {size} bytes; at most {LARGEST} are allowed");

    // The folder, and the same in one file beside its contents.
    let out = OutputFolder::create(out.join(FOLDER))?;
    let name = format!("bouncing-disk-{}-archive", env!("CARGO_PKG_VERSION"));
    let folder = out.path().join(&name);
    fs::remove_dir_all(out.path()).with_context(|| format!("cannot remove {}", out.path().display()))?;
    for inner in ["data", "figures", "extras"] {
        fs::create_dir_all(folder.join(inner))
            .with_context(|| format!("cannot make {}", folder.display()))?;
    }
    let files: Vec<_> = files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
    OutputFolder::existing(&folder).write_all(&files)?;
    let tar = set_and_packed(python, &folder, &name, &typst)?;
    let mut packed = GzBuilder::new().mtime(0).write(Vec::new(), Compression::best());
    packed.write_all(&tar)?;
    let file = format!("{name}.tar.gz");
    out.write(&file, &packed.finish()?)?;
    say!("{}", out.path().join(file).display())?;
    Ok(())
}

fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).with_context(|| format!("cannot read {}", path.display()))
}

/// Sets the report in the folder, and gives all its files as one tape archive with one top folder, sorted and without times.
fn set_and_packed(python: &Path, folder: &Path, name: &str, typst: &str) -> Result<Vec<u8>> {
    let mut child = Command::new(python)
        .args(["-c", PROGRAM])
        .arg(folder)
        .arg(name)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .with_context(|| format!("cannot start {}", python.display()))?;
    // It reads all before it writes.
    if let Some(mut input) = child.stdin.take() {
        // A program that ends early says why itself.
        let _ = input.write_all(typst.as_bytes());
    }
    let output = child.wait_with_output().context("python was lost")?;
    ensure!(output.status.success(), "the report could not be set ({})", output.status);
    Ok(output.stdout)
}
