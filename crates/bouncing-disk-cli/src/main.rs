//! The program `bouncing-disk`: the computations of the library `bouncing-disk` on the command line.
//!
//! The program is thin. A command reads its parameters (`parameters`), calls the library, and delivers a
//! report: a table on the terminal, or files (`output`). It has no physics and no numerics of its own. Grids
//! go through `grid`, which divides them into chunks and keeps journals; `bouncing-disk-plot` draws the
//! pictures.
//!
//! The chapter on the command line in the book (`docs/command-line.md`) shows what it does.

mod commands;
mod context;
mod failure;
mod grid;
mod interrupt;
mod lines;
mod output;
mod parameters;
mod range;

use std::process::ExitCode;

use clap::Parser as _;

use commands::CommandLine;
use failure::{Failure, Result};

/// The exit status is 0 if all is done, 1 if it failed, 2 for bad usage or input, 130 or 143 if interrupted.
fn main() -> ExitCode {
    let line = match CommandLine::try_parse() {
        Ok(line) => line,
        // Help and version are not errors, nor is a reader that has closed the help.
        Err(error) => {
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    run_line(line).map_or_else(Failure::tell, |()| ExitCode::SUCCESS)
}

fn run_line(line: CommandLine) -> Result<()> {
    interrupt::listen()?;
    if let Some(threads) = line.context.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        pool.map_err(|error| Failure::Failed(format!("{threads} threads cannot be started: {error}")))?;
    }
    commands::run(line.command, line.context)
}
