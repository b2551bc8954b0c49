//! The parser accepts every command that the documentation names, even if no test runs it.
//!
//! A command is a line of a shell in a code block, or a piece of code in the text that begins with the name of
//! the program, or with a command and an option (`fit --parameter`). A piece in the text may omit required
//! arguments and the value of its last option. `FILE`, `FIRST:LAST` and `...` stand for values.

use std::fs;
use std::path::{Path, PathBuf};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory as _, Parser as _};

use super::CommandLine;

const PROGRAM: &str = "bouncing-disk";

/// Where a command occurs.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Block,
    Text,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The pages and sources in a folder.
fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap()) {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.file_type().unwrap().is_dir() {
            if !name.starts_with('.') && !["node_modules", "target"].contains(&name.as_str()) {
                collect(&path, found);
            }
        } else if [".md", ".rs", ".py", ".json"].iter().any(|ending| name.ends_with(ending)) {
            found.push(path);
        }
    }
}

/// The shell lines of code blocks, with continued lines joined and without prompts; and the text of the page as one
/// line, without the comment markers of a source.
fn blocks_and_text(page: &str) -> (Vec<String>, String) {
    let (mut blocks, mut text) = (Vec::<String>::new(), String::new());
    let (mut block, mut goes_on) = (None, false);
    for line in page.lines() {
        let line = line.trim_start().trim_start_matches(['/', '!']).trim();
        if let Some(language) = line.strip_prefix("```") {
            (block, goes_on) = (if block.is_none() { Some(language) } else { None }, false);
        } else if let Some(language) = block {
            if !["", "sh", "console"].contains(&language) {
                continue;
            }
            let line = line.strip_prefix("$ ").or_else(|| line.strip_prefix("> ")).unwrap_or(line).trim();
            let piece = line.strip_suffix('\\').unwrap_or(line);
            match blocks.last_mut().filter(|_| goes_on) {
                Some(last) => last.push_str(piece),
                None => blocks.push(piece.to_owned()),
            }
            goes_on = line.ends_with('\\');
        } else {
            text.push_str(line);
            text.push(' ');
        }
    }
    (blocks, text)
}

/// The simple commands of a line of a shell, word by word, without redirections; a variable has the value 1.
fn simple_commands(line: &str) -> Vec<Vec<String>> {
    let mut commands = vec![Vec::new()];
    let (mut word, mut quote, mut redirected) = (String::new(), None, false);
    let mut letters = line.chars().chain([' ']).peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\'' | '"' if quote.is_none() => quote = Some(letter),
            _ if quote == Some(letter) => quote = None,
            '$' if quote != Some('\'') => {
                while letters.next_if(|next| next.is_ascii_alphanumeric() || *next == '_').is_some() {}
                word.push('1');
            }
            _ if quote.is_some() => word.push(letter),
            '#' if word.is_empty() => break,
            ' ' | '|' | ';' | '&' | '(' | ')' | '<' | '>' => {
                let is_number = letter == '>' && word == "2";
                if !word.is_empty() && !is_number && !redirected {
                    commands.last_mut().unwrap().push(std::mem::take(&mut word));
                }
                redirected = redirected && word.is_empty() && letter != '|';
                word.clear();
                match letter {
                    ' ' => {}
                    '<' | '>' => redirected = true,
                    _ => commands.push(Vec::new()),
                }
            }
            _ => word.push(letter),
        }
    }
    commands.retain(|command| !command.is_empty());
    commands
}

/// This program's commands that a page quotes, without the program's name.
fn commands(page: &str) -> Vec<(Place, Vec<String>)> {
    let own = CommandLine::command();
    let is_command = |word: &str| own.get_subcommands().any(|known| known.get_name() == word);
    let (blocks, text) = blocks_and_text(page);
    let mut found = Vec::new();
    for words in blocks.iter().flat_map(|line| simple_commands(line)) {
        let words = &words[words.iter().take_while(|word| *word == "do").count()..];
        let Some((name, rest)) = words.split_first() else { continue };
        if name.rsplit('/').next() == Some(PROGRAM) {
            found.push((Place::Block, rest.to_vec()));
        }
    }
    for piece in text.split('`').skip(1).step_by(2) {
        let Some(mut words) = simple_commands(piece).into_iter().next() else { continue };
        let names_it = words[0] == PROGRAM && words.len() > 1;
        if names_it {
            words.remove(0);
        }
        let names_an_option = words.iter().any(|word| word.starts_with("--"));
        let of_motor = words[0] == "motor" && words.len() > 1;
        if names_it || is_command(&words[0]) && (names_an_option || of_motor) {
            found.push((Place::Text, words));
        }
    }
    found
}

/// A word that stands for a value: `FILE`, `FIRST:LAST:POINTS`, `contact.time=...`.
fn is_placeholder(word: &str) -> bool {
    let value = word.rsplit('=').next().unwrap_or_default();
    let is_name = |part: &str| part.len() > 1 && part.bytes().all(|byte| byte.is_ascii_uppercase());
    value.contains("...") || value.split([':', '/', '.']).all(is_name)
}

/// What is wrong with a command.
fn fault(place: Place, words: &[String]) -> Option<String> {
    let line = [PROGRAM].into_iter().chain(words.iter().map(String::as_str));
    let error = CommandLine::try_parse_from(line).err()?;
    let is_empty = |value: &ContextValue| matches!(value, ContextValue::String(value) if value.is_empty());
    let is_legal = match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => true,
        ErrorKind::MissingRequiredArgument
        | ErrorKind::MissingSubcommand
        | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => place == Place::Text,
        ErrorKind::InvalidValue if error.get(ContextKind::InvalidValue).is_some_and(is_empty) => {
            place == Place::Text
        }
        ErrorKind::InvalidValue | ErrorKind::ValueValidation => words.iter().any(|word| is_placeholder(word)),
        _ => false,
    };
    (!is_legal).then(|| error.to_string())
}

#[test]
fn every_command_that_the_documentation_names_is_legal() {
    let mut files = vec![root().join("README.md")];
    for folder in ["docs", "crates", "data", "experiments", "xtask"] {
        collect(&root().join(folder), &mut files);
    }
    let (mut checked, mut faults) = ([0, 0], Vec::new());
    for path in files {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        if path.ends_with(file!()) || !text.contains('`') {
            continue;
        }
        for (place, words) in commands(&text) {
            checked[usize::from(place == Place::Text)] += 1;
            let fault = fault(place, &words);
            faults.extend(fault.map(|fault| format!("{}: {}\n{fault}", path.display(), words.join(" "))));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(checked[0] > 40 && checked[1] > 30, "{checked:?}");
}

#[test]
fn commands_are_found_and_faults_are_seen() {
    let page = "A `bouncing-disk motor lag`, `motor traps` and\n`toss\n--many`; `basins` is a word.\n```sh\n\
                $ for i in 1 2; do\n>     bouncing-disk verdicts -G 0:1:3 \\\n>         --chunk \"$i/3\" --out a.json\n> done\n\
                (cat a; bouncing-disk toss --nothing 2>/dev/null > b) | head -3 # bouncing-disk none\n\
                target/release/bouncing-disk fit FILE\ncargo test -p bouncing-disk\n```\n";
    let found: Vec<(String, bool)> = commands(page)
        .iter()
        .map(|(place, words)| (words.join(" "), fault(*place, words).is_none()))
        .collect();
    let expected = [
        ("verdicts -G 0:1:3 --chunk 1/3 --out a.json", true),
        ("toss --nothing", false),
        ("fit FILE", true),
        ("motor lag", false),
        ("motor traps", true),
        ("toss --many", true),
    ];
    assert_eq!(found, expected.map(|(words, legal)| (words.to_owned(), legal)));
    for (text, legal) in [
        ("motor sweep --over contact.time=...", true),
        ("motor sweep --over", true),
        ("verdicts -G FIRST:LAST:POINTS", true),
        ("verdicts -G 1:x:2", false),
        ("diagram --starts 3", false),
    ] {
        let words: Vec<String> = text.split(' ').map(str::to_owned).collect();
        assert_eq!(fault(Place::Text, &words).is_none(), legal, "{text}");
    }
    // A block is what a user copies: nothing may be left out.
    assert!(fault(Place::Block, &["motor".to_owned(), "sweep".to_owned(), "--over".to_owned()]).is_some());
}
