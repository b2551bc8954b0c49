//! `bouncing-disk merge`: the result of all chunks.

use std::path::{Path, PathBuf};

use super::basins::BasinsJob;
use super::diagram::DiagramJob;
use super::motor::sweep::SweepJob;
use super::motor::transient::TransientJob;
use super::prelude::*;
use super::verdicts::VerdictsJob;
use crate::grid::computation_of;

/// Joins the chunks of a computation
#[derive(Debug, Args)]
#[command(after_help = "\
The result is byte for byte the same as without --chunk. A part is a journal of some rows, so journals can be \
merged, too. An error names missing rows, and files that are damaged or belong to another computation or version of \
the program. See docs/command-line.md, \"On a cluster\".

Example:
  bouncing-disk merge part-*.json --out diagram.png")]
pub(crate) struct MergeArgs {
    /// The files of all chunks, or journals, in any order
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

pub(crate) fn run(args: &MergeArgs, context: Context) -> Result<()> {
    let inputs: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    args.output.check(true, &inputs, None)?;
    let (command, job) = computation_of(&args.files[0])?;
    let merge = match command.as_str() {
        DiagramJob::COMMAND => grid::merge::<DiagramJob>,
        VerdictsJob::COMMAND => grid::merge::<VerdictsJob>,
        BasinsJob::COMMAND => grid::merge::<BasinsJob>,
        SweepJob::COMMAND => grid::merge::<SweepJob>,
        TransientJob::COMMAND => grid::merge::<TransientJob>,
        other => return Err(Failure::Usage(format!("chunks of the command {other:?} cannot be merged"))),
    };
    merge(&job, &args.files, &args.output, context)
}
