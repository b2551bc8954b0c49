//! The command line: its commands, one file each.

pub(crate) mod basins;
mod diagram;
#[cfg(test)]
mod documented;
mod doublings;
mod fit;
mod map;
mod merge;
mod motor;
mod orbits;
mod prelude;
mod shell;
pub(crate) mod toss;
pub(crate) mod verdicts;

use clap::{CommandFactory as _, Parser, Subcommand};

use crate::context::Context;
use crate::failure::Result;

/// A disk that bounces on a platform which vibrates and twists: tosses, orbits, attractors, motors
///
/// The model is that of Liu, Friend and Yeo, Phys. Rev. E 80, 046201 (2009). Results are tables with units on
/// the terminal, or files by the ending of --out: .csv, .json, .png, .svg.
#[derive(Debug, Parser)]
#[command(
    name = "bouncing-disk",
    version,
    after_help = "\
Exit status: 0 done; 1 the computation failed or the system refused; 2 the line or a file that it names is not \
legal; 130 interrupted by Ctrl-C, 143 terminated. A first signal ends the computation and keeps what can be kept, a \
second one ends the program at once. Results are the same bits for any number of threads.

Examples:
  bouncing-disk toss
  bouncing-disk diagram --out diagram.png
  bouncing-disk motor sweep --over load_torque=0:30e-6:7 --out curve.csv",
    max_term_width = 110
)]
pub(crate) struct CommandLine {
    #[command(subcommand)]
    pub(crate) command: Command,
    #[command(flatten)]
    pub(crate) context: Context,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Toss(toss::TossArgs),
    /// A motor from its data sheet: what it does, run-up, torque-speed curve, stall, traps, sweeps
    #[command(subcommand)]
    Motor(motor::MotorCommand),
    Orbits(orbits::OrbitsArgs),
    Diagram(diagram::DiagramArgs),
    Verdicts(verdicts::VerdictsArgs),
    Basins(basins::BasinsArgs),
    Doublings(doublings::DoublingsArgs),
    Fit(fit::FitArgs),
    Merge(merge::MergeArgs),
    Completions(shell::CompletionsArgs),
    Man(shell::ManArgs),
}

pub(crate) fn run(command: Command, context: Context) -> Result<()> {
    match command {
        Command::Toss(args) => toss::run(&args, context),
        Command::Motor(command) => motor::run(command, context),
        Command::Orbits(args) => orbits::run(&args, context),
        Command::Diagram(args) => diagram::run(&args, context),
        Command::Verdicts(args) => verdicts::run(&args, context),
        Command::Basins(args) => basins::run(&args, context),
        Command::Doublings(args) => doublings::run(&args, context),
        Command::Fit(args) => fit::run(&args, context),
        Command::Merge(args) => merge::run(&args, context),
        Command::Completions(args) => shell::completions(&args, CommandLine::command()),
        Command::Man(args) => shell::man(&args, CommandLine::command()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        CommandLine::command().debug_assert();
    }

    /// A word that begins with a minus may be the value of an option that takes numbers, and no option.
    #[test]
    fn options_of_numbers_take_negative_ones() {
        fn check(command: &clap::Command) {
            command.get_subcommands().for_each(check);
            for option in command.get_opts().filter(|own| own.get_possible_values().is_empty()) {
                let value = option.get_value_names().unwrap_or_default().join(" ");
                let is_word = ["FILE", "NAME", "UNIT"].contains(&value.as_str()) || value.contains('=');
                let takes = option.is_allow_negative_numbers_set() || option.is_allow_hyphen_values_set();
                assert!(is_word || takes, "{} --{}", command.get_name(), option.get_id());
            }
        }
        check(&CommandLine::command());
    }
}
