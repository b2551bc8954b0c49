//! `bouncing-disk merge`: the result of all chunks.

use std::path::{Path, PathBuf};

use super::basins::BasinsJob;
use super::diagram::DiagramJob;
use super::motor::sweep::SweepJob;
use super::motor::transient::TransientJob;
use super::prelude::*;
use super::verdicts::VerdictsJob;
use crate::grid::{GridJob, computation_of, merged};

/// Puts the chunks of a computation together
#[derive(Debug, Args)]
#[command(after_help = "\
The result has the very bytes that the command without --chunk gives. A part is a journal with some of the rows, so that \
journals can be merged, too. Rows that are missing, and files that are damaged or of another computation or version of the \
program, are refused by name. See docs/command-line.md, \"On a cluster\".

Example:
  bouncing-disk merge part-*.json --out diagram.png")]
pub(crate) struct MergeArgs {
    /// The files of all chunks, or journals, in any order
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
pub(crate) fn run(args: &MergeArgs, context: Context) -> Result<(), Failure> {
    let inputs: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    args.output.check(true, &inputs, None)?;
    let (command, job) = computation_of(&args.files[0])?;
    let watcher = context.watch("merge");
    let (job, parts) = (&job, &args.files[..]);
    let report = match command.as_str() {
        DiagramJob::COMMAND => merged::<DiagramJob>(job, parts, &watcher),
        VerdictsJob::COMMAND => merged::<VerdictsJob>(job, parts, &watcher),
        BasinsJob::COMMAND => merged::<BasinsJob>(job, parts, &watcher),
        SweepJob::COMMAND => merged::<SweepJob>(job, parts, &watcher),
        TransientJob::COMMAND => merged::<TransientJob>(job, parts, &watcher),
        other => Err(Failure::usage(format!("chunks of the command {other:?} are not known"))),
    }?;
    drop(watcher);
    report.deliver(&args.output, context.quiet)
}
