//! Completions and manual pages for a shell, generated from the command line's description.

use std::io::{self, Write as _};

use clap::{Args, Command};
use clap_complete::Shell;

use crate::failure::{Failure, Result};

/// Completions for a shell, on standard output
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  bouncing-disk completions bash > ~/.local/share/bash-completion/completions/bouncing-disk")]
pub(crate) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

/// A manual page in roff, on standard output
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  bouncing-disk man > bouncing-disk.1
  bouncing-disk man motor sweep | man -l -")]
pub(crate) struct ManArgs {
    /// The command; by default the page of the program
    command: Vec<String>,
}

pub(crate) fn completions(args: &CompletionsArgs, mut command: Command) -> Result<()> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut command, "bouncing-disk", &mut text);
    // For bash, clap_complete writes the hyphen of the program's name in two ways and finds no subcommand.
    let text = String::from_utf8_lossy(&text).replace("bouncing__subcmd__disk", "bouncing__disk");
    Ok(io::stdout().write_all(text.as_bytes())?)
}

pub(crate) fn man(args: &ManArgs, mut command: Command) -> Result<()> {
    command.build();
    let mut name = "bouncing-disk".to_owned();
    for word in &args.command {
        let found = command.find_subcommand(word).cloned();
        command = found.ok_or_else(|| Failure::Usage(format!("{name} has no command {word:?}")))?;
        name = format!("{name}-{word}");
    }
    let mut text = Vec::new();
    clap_mangen::Man::new(command).title(name).render(&mut text)?;
    Ok(io::stdout().write_all(&text)?)
}
