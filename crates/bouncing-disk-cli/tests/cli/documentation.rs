//! Every command in the documentation is run by a shell, and its output compared with what stands under it.
//!
//! In a block marked `console` a line that begins with `$ ` is a command, the lines after it are what it
//! prints, on either stream. The blocks of a file are run one after the other in one folder.
//! `UPDATE_DOCUMENTATION=1` writes what is printed into the file in place of comparing it.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::common::Folder;

/// Runs a command of the documentation; what it prints, each line as it stands in a file.
fn printed(folder: &Folder, command: &str) -> Vec<String> {
    let program = Path::new(env!("CARGO_BIN_EXE_bouncing-disk"));
    let path =
        format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap_or_default());
    let output = Command::new("sh")
        .args(["-c", &format!("exec 2>&1\n{command}")])
        .current_dir(folder.path())
        .env("PATH", path)
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(|line| line.trim_end().to_owned()).filter(|line| !is_progress(line)).collect()
}

/// Whether a line says how long a call will take, as after five seconds on a slow machine: "motor stall: 40 %, about 9 s left".
fn is_progress(line: &str) -> bool {
    line.split_once(": ").is_some_and(|(_, rest)| rest.ends_with(" %") || rest.contains(" %, about "))
}

/// The text with what its commands print now.
fn renewed(text: &str) -> String {
    let folder = Folder::new();
    let mut new = Vec::new();
    let mut lines = text.lines().peekable();
    let mut inside = false;
    while let Some(line) = lines.next() {
        new.push(line.to_owned());
        if line.starts_with("```") {
            inside = line == "```console";
        }
        let Some(first) = line.strip_prefix("$ ").filter(|_| inside) else { continue };
        let mut command = first.to_owned();
        // A command may go on in lines that begin with the shell's second prompt.
        while let Some(next) = lines.next_if(|next| next.starts_with("> ")) {
            new.push(next.to_owned());
            command = format!("{command}\n{}", &next[2..]);
        }
        while lines.next_if(|next| !next.starts_with("$ ") && !next.starts_with("```")).is_some() {}
        new.extend(printed(&folder, &command));
    }
    new.join("\n") + "\n"
}

fn check(path: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let text = fs::read_to_string(&path).unwrap();
    let commands = text.lines().filter(|line| line.starts_with("$ ")).count();
    assert!(commands > 0, "{} has no commands", path.display());
    let new = renewed(&text);
    if std::env::var_os("UPDATE_DOCUMENTATION").is_some() {
        fs::write(&path, new).unwrap();
        return;
    }
    for (line, (old, new)) in (1..).zip(text.lines().zip(new.lines())) {
        assert_eq!(
            old,
            new,
            "{}, line {line}; UPDATE_DOCUMENTATION=1 writes what is printed",
            path.display()
        );
    }
    assert_eq!(text.lines().count(), new.lines().count(), "{}", path.display());
}

#[test]
fn the_chapter_prints_what_it_says() {
    check("../../docs/command-line.md");
}

#[test]
fn the_page_of_the_crate_prints_what_it_says() {
    check("README.md");
}

#[test]
fn a_wrong_output_is_seen() {
    let text = "```console\n$ echo one; echo two >&2\none\n```\n```sh\n$ exit 1\n```\n";
    assert_eq!(renewed(text), "```console\n$ echo one; echo two >&2\none\ntwo\n```\n```sh\n$ exit 1\n```\n");
    let slow = "```console\n$ echo 'motor best: 2 %, about 9 s left'; echo 'motor best: 0 %'; echo speed: 2\nspeed: 2\n```\n";
    assert_eq!(renewed(slow), slow);
}

/// The help of each command says what it computes, shows an example, and its examples are legal lines.
#[test]
fn every_command_has_an_example_in_its_help() {
    let folder = Folder::new();
    let motors = ["report", "transient", "curve", "stall", "best", "traps", "sweep"]
        .map(|name| format!("motor {name}"));
    let others = ["toss", "orbits", "diagram", "verdicts", "basins", "doublings", "curves", "fit", "merge"];
    for command in motors.into_iter().chain(others.map(str::to_owned)) {
        let help = folder.done(&format!("{command} --help"));
        let examples: Vec<&str> =
            help.lines().filter_map(|line| line.trim().strip_prefix("bouncing-disk ")).collect();
        assert!(examples.iter().any(|example| example.starts_with(&command)), "{command}: {help}");
        assert!(help.contains("docs/"), "{command}");
        assert!(help.lines().all(|line| line.chars().count() <= 110), "{command}: {help}");
        for example in examples {
            // With a file that is not there nothing is computed; a fault of the line itself is told before.
            let line = example.split(" >").next().unwrap().replace('\'', "");
            let line = format!("{line} --out no/such/folder.json");
            if example.contains('*') || example.contains("--template") {
                continue;
            }
            let text = folder.refused(&line, 2);
            assert!(
                text.contains("the folder no/such does not exist") || text.contains("cannot be read"),
                "{line}: {text}"
            );
        }
    }
}

/// What a command takes where no forcing is given stands in its help, and is what it takes.
#[test]
fn the_help_of_each_command_says_its_own_forcing() {
    let folder = Folder::new();
    for (line, forcing) in [
        ("basins --cells 2 --starts 1", "0.486"),
        ("orbits --impacts 1 --starts 2", "0.535"),
        ("verdicts --impacts 64", "0.30:0.62:33"),
        ("diagram --transient 0 --recorded 1", "0.30:0.62:641"),
    ] {
        let help = folder.done(&format!("{} --help", line.split(' ').next().unwrap()));
        let own: String =
            help.split("--axial-forcing").nth(1).unwrap().split("--restitution").next().unwrap().into();
        let words: Vec<&str> = own.split_whitespace().collect();
        let text = words.join(" ");
        assert!(text.contains(&format!("without these {forcing}")), "{line}: {text}");
        assert!(text.contains("Taken from FILE, --preset or --set unless given"), "{line}: {text}");
        folder.done(&format!("{line} --out a.json --force"));
        let without = folder.read("a.json");
        folder.done(&format!("{line} -G {forcing} --out a.json --force"));
        assert!(folder.read("a.json") == without, "{line}");
        // A system brings its own.
        folder.done(&format!("{line} --set disk.friction=0.1 --out a.json --force"));
        assert!(folder.read("a.json") != without, "{line}");
    }
    let help = folder.done("doublings --help").split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("no --axial-forcing"), "{help}");
}

#[test]
fn completions_and_manual_pages_know_the_commands() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let text = folder.done(&format!("completions {shell}"));
        assert!(text.contains("verdicts") && text.contains("traps"), "{shell}");
    }
    // The cases of the function are those that it looks for.
    let bash = folder.done("completions bash");
    assert!(bash.contains("cmd=\"bouncing__disk__subcmd__motor\""), "{bash}");
    assert!(bash.contains("bouncing__disk__subcmd__motor)") && !bash.contains("bouncing__subcmd__disk"));
    assert!(folder.done("man").contains(".TH bouncing"));
    let page = folder.done("man motor sweep");
    assert!(page.contains("bouncing\\-disk") && page.contains("\\-\\-over"), "{page}");
}
