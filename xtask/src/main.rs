//! The chores of this repository.
//!
//! `cargo xtask figures` computes and draws the figures and tables of the paper, `cargo xtask explorer`
//! builds the page for browsers, and `cargo xtask fmu` packs a motor for other simulators.

mod explorer;
#[cfg(feature = "figures")]
mod figures;
mod fmu;
#[cfg(not(feature = "figures"))]
mod forward;
mod output;
#[cfg(feature = "figures")]
mod report;
#[cfg(feature = "figures")]
mod work;
mod workspace;

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
    /// Build a motor as a functional mock-up unit (FMI 3.0) for this machine.
    Fmu(fmu::Options),
}

fn main() -> ExitCode {
    let Arguments { chore } = Arguments::parse();
    let done = match chore {
        Chore::Figures(options) => figures::run(&options),
        Chore::Explorer(options) => explorer::run(&options),
        Chore::Fmu(options) => fmu::run(&options),
    };
    match done {
        Ok(code) => code,
        Err(error) => {
            output::complain!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(all(test, feature = "figures"))]
mod tests {
    use std::fs;

    use clap::error::ErrorKind;

    use super::*;

    /// The commands on a page that begin with `cargo xtask`: code in a line of text, and lines of blocks.
    fn commands(page: &str) -> Vec<&str> {
        let mut found = Vec::new();
        let mut inside = false;
        for line in page.lines() {
            inside ^= line.starts_with("```");
            if inside || line.starts_with("    ") {
                found.extend(line.split(" #").next());
            } else {
                found.extend(line.split('`').skip(1).step_by(2));
            }
        }
        found.iter().filter_map(|command| command.trim().strip_prefix("cargo xtask ")).collect()
    }

    #[test]
    fn every_chore_that_the_documentation_names_is_legal() {
        let mut pages = vec![workspace::in_workspace("README.md")];
        for folder in ["docs", "crates/bouncing-disk-web"] {
            let entries = fs::read_dir(workspace::in_workspace(folder)).unwrap();
            pages.extend(entries.map(|entry| entry.unwrap().path()));
        }
        pages.retain(|page| page.extension().is_some_and(|ending| ending == "md"));
        let (mut checked, mut faults) = (0, Vec::new());
        for page in pages {
            let text = fs::read_to_string(&page).unwrap();
            for command in commands(&text) {
                checked += 1;
                let words = ["cargo xtask"].into_iter().chain(command.split_whitespace());
                let error = Arguments::try_parse_from(words).err();
                let error = error.filter(|error| error.kind() != ErrorKind::DisplayHelp);
                faults.extend(error.map(|error| format!("{}: {command}\n{error}", page.display())));
            }
        }
        assert!(faults.is_empty(), "{}", faults.join("\n"));
        assert!(checked > 10, "{checked}");
    }

    #[test]
    fn chores_are_found() {
        let page = "Run `cargo xtask figures --check`, or `cargo test`.\n\n    cargo xtask explorer  # the page\n```sh\n\
                    cargo xtask figure # a fault\n```\n";
        let found = commands(page);
        assert_eq!(found, ["figures --check", "explorer", "figure"]);
        let legal = found.iter().map(|line| {
            let words = ["cargo xtask"].into_iter().chain(line.split_whitespace());
            Arguments::try_parse_from(words).is_ok()
        });
        assert_eq!(legal.collect::<Vec<_>>(), [true, true, false]);
    }
}
