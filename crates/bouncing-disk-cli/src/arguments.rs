//! The command line.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::{Args, Parser, Subcommand};

use crate::commands;
use crate::context::Context;
use crate::failure::Failure;
use crate::output::files::{Kind, Target, opened_place, place};
use crate::output::lines::say;
use crate::output::report::{no_picture, no_result, wrote};

/// What stands at the end of the help.
const AFTER: &str = "\
Exit status: 0 done; 1 the computation failed or the system refused; 2 the line or a file that it names is not \
legal; 130 interrupted by Ctrl-C, 143 terminated. A first signal ends the computation and keeps what can be kept, a \
second one ends the program at once. Results are the same bits for any number of threads.

Examples:
  bouncing-disk toss
  bouncing-disk diagram --out diagram.png
  bouncing-disk motor sweep --over load_torque=0:30e-6:7 --out curve.csv";

/// A disk that bounces on a platform which vibrates and twists: tosses, orbits, attractors, motors
///
/// The model is that of Liu, Friend and Yeo, Phys. Rev. E 80, 046201 (2009). Results are tables with units on
/// the terminal, or files by the ending of --out: .csv, .json, .png, .svg.
#[derive(Debug, Parser)]
#[command(name = "bouncing-disk", version, after_help = AFTER, max_term_width = 110)]
pub(crate) struct CommandLine {
    #[command(subcommand)]
    pub(crate) command: Command,
    #[command(flatten)]
    pub(crate) common: CommonArgs,
}

/// The heading of what is a command's own.
pub(crate) const OWN: &str = "Computation";

/// What every command has.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "General")]
pub(crate) struct CommonArgs {
    /// No progress, no warnings, nothing but the result and errors
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Threads to compute with; all of the processor's unless given
    #[arg(long, allow_negative_numbers = true, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Toss(commands::toss::TossArgs),
    Motor(commands::motor::MotorCommand),
    Orbits(commands::orbits::OrbitsArgs),
    Diagram(commands::diagram::DiagramArgs),
    Verdicts(commands::verdicts::VerdictsArgs),
    Basins(commands::basins::BasinsArgs),
    Doublings(commands::doublings::DoublingsArgs),
    Fit(commands::fit::FitArgs),
    Design(commands::design::DesignArgs),
    Merge(commands::merge::MergeArgs),
    Completions(commands::shell::CompletionsArgs),
    Man(commands::shell::ManArgs),
}

/// Where the result goes.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Result")]
pub(crate) struct OutputArgs {
    /// Writes the result to a file in place of the terminal; its ending says how: .csv, .json, .png or .svg
    /// (.toml with --template). May be repeated
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Vec<Target>,
    /// Replaces files that are there already
    #[arg(long)]
    pub(crate) force: bool,
}

impl OutputArgs {
    /// Whether the files can be written, as far as that is seen before anything is computed. None of them may
    /// be an input, or the journal.
    ///
    /// # Errors
    /// [`Failure::Usage`] names the file.
    pub(crate) fn check(
        &self,
        has_picture: bool,
        inputs: &[&Path],
        journal: Option<&Path>,
    ) -> Result<(), Failure> {
        let places: Vec<PathBuf> = self.out.iter().map(|target| place(&target.path)).collect();
        for (index, target) in self.out.iter().enumerate() {
            if let Some(first) = places[..index].iter().position(|place| *place == places[index]) {
                let as_well = if self.out[first] == *target {
                    String::new()
                } else {
                    format!(", as {} before", self.out[first])
                };
                return Err(Failure::usage(format!("{target}: it is asked for twice{as_well}")));
            }
        }
        let others = inputs.iter().map(|path| (*path, "an input"));
        for (path, what) in others.chain(journal.map(|path| (path, "the journal"))) {
            let opened = opened_place(path);
            if let Some(index) = places.iter().position(|place| *place == opened) {
                let target = &self.out[index];
                return Err(Failure::usage(format!("{target}: it cannot be {what} and the result")));
            }
        }
        for target in &self.out {
            if target.kind == Kind::Toml {
                return Err(no_result(target));
            }
            if !has_picture && matches!(target.kind, Kind::Png | Kind::Svg) {
                return Err(no_picture().in_context(&target.to_string()));
            }
            target.check(self.force)?;
        }
        Ok(())
    }

    /// Writes a file of parameters, to the terminal or where --out says.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a file of another kind, or for several.
    pub(crate) fn write_template(&self, text: &str, context: Context) -> Result<(), Failure> {
        match &self.out[..] {
            [] => Ok(say!("{}", text.trim_end())?),
            [target] if target.kind == Kind::Toml => {
                target.check(self.force)?;
                target.write(self.force, |to| to.write_all(text.as_bytes()))?;
                wrote(target, context.quiet);
                Ok(())
            }
            _ => Err(Failure::usage(
                "--template writes TOML, to the terminal or with one --out FILE.toml into a file",
            )),
        }
    }
}

/// A part of the rows of a grid, `2/10` on the command line: the second of ten.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Chunk {
    /// From 1.
    pub(crate) index: usize,
    pub(crate) count: usize,
}

impl FromStr for Chunk {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || "a chunk is I/N, from 1/N to N/N".to_owned();
        let (index, count) = text.split_once('/').ok_or_else(form)?;
        let whole = |text: &str| text.trim().parse::<usize>().map_err(|_| form());
        let (index, count) = (whole(index)?, whole(count)?);
        if index == 0 || index > count {
            return Err(form());
        }
        Ok(Self { index, count })
    }
}

impl Chunk {
    /// The rows of this part of so many.
    pub(crate) fn rows(self, rows: usize) -> std::ops::Range<usize> {
        let upto = |parts: usize| (rows as u128 * parts as u128 / self.count as u128) as usize;
        upto(self.index - 1)..upto(self.index)
    }
}

/// How the rows of a grid are computed.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Long computations")]
pub(crate) struct GridArgs {
    /// Computes the I-th of N parts of the rows and writes it to --out FILE.json; `bouncing-disk merge` puts
    /// all parts together
    #[arg(long, value_name = "I/N", allow_hyphen_values = true)]
    pub(crate) chunk: Option<Chunk>,
    /// Keeps finished rows in a file: the same command goes on where it was stopped or killed
    #[arg(long, value_name = "FILE")]
    pub(crate) journal: Option<PathBuf>,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        CommandLine::command().debug_assert();
    }

    #[test]
    fn chunks_cover_all_rows_once() {
        for rows in [0, 1, 2, 7, 100] {
            for count in [1, 2, 3, 7, 13] {
                let all: Vec<usize> =
                    (1..=count).flat_map(|index| Chunk { index, count }.rows(rows)).collect();
                assert_eq!(all, (0..rows).collect::<Vec<_>>(), "{rows} rows in {count}");
            }
        }
    }

    #[test]
    fn what_is_no_chunk_is_refused() {
        assert_eq!("2/10".parse(), Ok(Chunk { index: 2, count: 10 }));
        for text in ["", "1", "0/3", "4/3", "1/0", "-1/3", "a/b", "1/2/3"] {
            assert!(text.parse::<Chunk>().is_err(), "{text}");
        }
    }
}
