//! The command line: its commands, one file each.

pub(crate) mod basins;
mod curves;
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
Exit status: 0 done; 1 a failure of the computation or the system; 2 an illegal command line or input file; 130 \
interrupted by Ctrl-C; 143 terminated. The first signal ends the computation and keeps finished rows; a second one \
ends the program at once. Results are the same to the last bit for any number of threads.

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
    /// A motor from its data sheet: report, run-up, torque-speed curve, stall, best values, traps, sweeps
    #[command(subcommand)]
    Motor(motor::MotorCommand),
    Orbits(orbits::OrbitsArgs),
    Diagram(diagram::DiagramArgs),
    Verdicts(verdicts::VerdictsArgs),
    Basins(basins::BasinsArgs),
    Doublings(doublings::DoublingsArgs),
    Curves(curves::CurvesArgs),
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
        Command::Curves(args) => curves::run(&args, context),
        Command::Fit(args) => fit::run(&args, context),
        Command::Merge(args) => merge::run(&args, context),
        Command::Completions(args) => shell::completions(&args, CommandLine::command()),
        Command::Man(args) => shell::man(&args, CommandLine::command()),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        CommandLine::command().debug_assert();
    }

    /// The options of each command except for files, with default and unit. A test of the Python package compares them with
    /// its arguments. `UPDATE_DOCUMENTATION=1` writes the list.
    #[test]
    fn the_list_of_options_is_that_of_the_parser() {
        fn collect(
            command: &clap::Command,
            name: &str,
            found: &mut BTreeMap<String, BTreeMap<String, String>>,
        ) {
            for own in command.get_subcommands() {
                collect(own, format!("{name} {}", own.get_name()).trim(), found);
            }
            let files = ["Parameters", "Result", "Long computations", "General"];
            let options = command.get_arguments().filter_map(|option| {
                let default = option.get_default_values().iter().map(|own| own.to_string_lossy());
                let help = option.get_help()?.to_string();
                let unit = ["s", "N", "N m"].into_iter().find(|unit| help.contains(&format!("({unit})")));
                let is_file = option.get_help_heading().is_some_and(|own| files.contains(&own));
                let said =
                    default.collect::<String>() + &unit.map_or_else(String::new, |unit| format!(" {unit}"));
                Some((option.get_long().filter(|_| !is_file)?.to_owned(), said))
            });
            if !command.has_subcommands() {
                found.insert(name.to_owned(), options.collect());
            }
        }
        let mut found = BTreeMap::new();
        collect(&CommandLine::command(), "", &mut found);
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/command-line.json");
        let text = serde_json::to_string_pretty(&found).unwrap() + "\n";
        if std::env::var_os("UPDATE_DOCUMENTATION").is_some() {
            std::fs::write(path, &text).unwrap();
        }
        assert!(std::fs::read_to_string(path).unwrap() == text, "UPDATE_DOCUMENTATION=1 writes {path}");
    }

    /// A word that begins with a minus may be the value of an option that takes numbers, and no option.
    #[test]
    fn options_of_numbers_take_negative_ones() {
        fn check(command: &clap::Command) {
            command.get_subcommands().for_each(check);
            for option in command.get_opts().filter(|own| own.get_possible_values().is_empty()) {
                let value = option.get_value_names().unwrap_or_default().join(" ");
                let is_word =
                    ["BOUND", "FILE", "NAME", "UNIT"].contains(&value.as_str()) || value.contains('=');
                let takes = option.is_allow_negative_numbers_set() || option.is_allow_hyphen_values_set();
                assert!(is_word || takes, "{} --{}", command.get_name(), option.get_id());
            }
        }
        check(&CommandLine::command());
    }
}
