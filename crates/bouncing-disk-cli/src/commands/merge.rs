//! `bouncing-disk merge`: the result of all chunks.

use std::path::{Path, PathBuf};

use super::basins::BasinsJob;
use super::diagram::DiagramJob;
use super::motor::sweep::SweepJob;
use super::motor::transient::TransientJob;
use super::prelude::*;
use super::verdicts::VerdictsJob;
use crate::grid::{GridJob, Part, merged};

/// Puts the chunks of a computation together
#[derive(Debug, Args)]
#[command(after_help = "\
The result has the very bytes that the command without --chunk gives. Chunks that are missing, there twice, damaged, or of \
another computation or version of the program are refused by name. See docs/command-line.md, \"On a cluster\".

Example:
  bouncing-disk merge part-*.json --out diagram.png")]
pub(crate) struct MergeArgs {
    /// The files of all chunks, in any order
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
pub(crate) fn run(args: &MergeArgs, context: Context) -> Result<(), Failure> {
    let inputs: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    args.output.check(true, &inputs, None)?;
    let parts = args.files.iter().map(|path| Part::read(path)).collect::<Result<Vec<_>, _>>()?;
    let watcher = context.watch("merge");
    let report = match parts.first().map(Part::command).unwrap_or_default().to_owned().as_str() {
        DiagramJob::COMMAND => merged::<DiagramJob>(parts, &watcher),
        VerdictsJob::COMMAND => merged::<VerdictsJob>(parts, &watcher),
        BasinsJob::COMMAND => merged::<BasinsJob>(parts, &watcher),
        SweepJob::COMMAND => merged::<SweepJob>(parts, &watcher),
        TransientJob::COMMAND => merged::<TransientJob>(parts, &watcher),
        other => Err(Failure::usage(format!("chunks of the command {other:?} are not known"))),
    }?;
    drop(watcher);
    report.deliver(&args.output, context.quiet)
}
