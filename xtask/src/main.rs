//! The chores of this repository.
//!
//! `cargo xtask figures` computes and draws the figures and tables of the paper, `cargo xtask explorer`
//! builds the page for browsers, `cargo xtask archive` packs the claims with their data and the report,
//! `cargo xtask dist` makes what is published, and `cargo xtask dependencies` counts what it depends on and
//! checks the licences.

#[cfg(feature = "figures")]
mod archive;
mod dependencies;
#[cfg(feature = "figures")]
mod dist;
mod explorer;
#[cfg(feature = "figures")]
mod figures;
#[cfg(not(feature = "figures"))]
mod forward;
mod output;
#[cfg(feature = "figures")]
mod report;
#[cfg(feature = "figures")]
mod typeset;
#[path = "../../experiments/src/visible.rs"]
#[allow(dead_code, unreachable_pub, reason = "it is the experiments', without which this program may be")]
mod visible;
#[cfg(feature = "figures")]
mod work;
mod workspace;

#[cfg(not(feature = "figures"))]
use forward as archive;
#[cfg(not(feature = "figures"))]
use forward as dist;
#[cfg(not(feature = "figures"))]
use forward as figures;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", about = "The chores of this repository")]
struct Arguments {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Compute and draw the figures and tables of the paper.
    Figures(figures::Options),
    /// Build the page that shows the model in a browser.
    Explorer(explorer::Options),
    /// Pack the claims, the data of the figures and the report.
    Archive(archive::Options),
    /// Make the packages, the explorer and the book that are given to others, with checksums.
    Dist(dist::Options),
    /// Count the crates that each dependency brings, and check licences and sources.
    Dependencies,
}

fn main() -> ExitCode {
    let Arguments { chore } = Arguments::parse();
    let done = match chore {
        Chore::Figures(options) => figures::run(&options),
        Chore::Explorer(options) => explorer::run(&options),
        Chore::Archive(options) => archive::run(&options),
        Chore::Dist(options) => dist::run(&options),
        Chore::Dependencies => dependencies::run(),
    };
    match done {
        Ok(code) => code,
        Err(error) => {
            output::complain!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
