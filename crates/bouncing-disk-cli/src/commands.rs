//! The commands, one file each.

pub(crate) mod basins;
pub(crate) mod design;
pub(crate) mod diagram;
pub(crate) mod doublings;
pub(crate) mod fit;
pub(crate) mod map;
pub(crate) mod merge;
pub(crate) mod motor;
pub(crate) mod orbits;
pub(crate) mod shell;
pub(crate) mod start;
pub(crate) mod toss;
pub(crate) mod verdicts;

use crate::arguments::Command;
use crate::context::Context;
use crate::failure::Failure;

/// Runs a command.
///
/// # Errors
/// What ends it before its result is there.
pub(crate) fn run(command: Command, context: Context) -> Result<(), Failure> {
    match command {
        Command::Toss(args) => toss::run(&args, context),
        Command::Motor(command) => motor::run(command, context),
        Command::Orbits(args) => orbits::run(&args, context),
        Command::Diagram(args) => diagram::run(&args, context),
        Command::Verdicts(args) => verdicts::run(&args, context),
        Command::Basins(args) => basins::run(&args, context),
        Command::Doublings(args) => doublings::run(&args, context),
        Command::Fit(args) => fit::run(&args, context),
        Command::Design(args) => design::run(&args, context),
        Command::Merge(args) => merge::run(&args, context),
        Command::Completions(args) => shell::completions(&args),
        Command::Man(args) => shell::man(&args),
    }
}
