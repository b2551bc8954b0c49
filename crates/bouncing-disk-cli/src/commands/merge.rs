//! `bouncing-disk merge`: the result of all chunks.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::arguments::OutputArgs;
use crate::commands::basins::BasinsJob;
use crate::commands::diagram::DiagramJob;
use crate::commands::motor::sweep::SweepJob;
use crate::commands::motor::transient::TransientJob;
use crate::commands::verdicts::VerdictsJob;
use crate::context::Context;
use crate::failure::Failure;
use crate::grid::GridJob;
use crate::grid::chunk::{Part, merged};

/// What stands at the end of the help.
const AFTER: &str = "\
The result has the very bytes that the command without --chunk gives. Chunks that are missing, there twice, damaged, or of \
another computation or version of the program are refused by name. See docs/command-line.md, \"On a cluster\".

Example:
  bouncing-disk merge part-*.json --out diagram.png";

/// Puts the chunks of a computation together
#[derive(Debug, Args)]
#[command(after_help = AFTER)]
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
    let report = match parts.first().map(|part| part.command.as_str()).unwrap_or_default() {
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
