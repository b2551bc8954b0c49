//! Runs the program in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder that is removed at the end.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(crate) fn join(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.join(name), text).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub(crate) fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).unwrap()
    }

    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The program with these words, in this folder.
    pub(crate) fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_bouncing-disk"));
        command.current_dir(self.path()).args(line.split_whitespace());
        command
    }

    /// What it prints where all goes well.
    pub(crate) fn done(&self, line: &str) -> String {
        let output = self.command(line).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{line}: {}", errors(&output));
        String::from_utf8(output.stdout).unwrap()
    }

    /// What it says where it ends with this status, and prints nothing.
    pub(crate) fn refused(&self, line: &str, status: i32) -> String {
        let output = self.command(line).output().unwrap();
        let text = errors(&output);
        assert_eq!(output.status.code(), Some(status), "{line}: {text}");
        assert!(output.stdout.is_empty(), "{line}");
        assert!(!text.contains("panicked"), "{line}: {text}");
        text
    }

    /// The same of many lines, each with a part of what it says.
    pub(crate) fn all_refused(&self, status: i32, lines: &[(&str, &str)]) {
        for (line, told) in lines {
            let text = self.refused(line, status);
            assert!(text.contains(told), "{line}: {text}");
        }
    }
}

/// What is said of a file of another kind in the place of a part.
pub(crate) fn no_part(name: &str) -> String {
    format!("{name}: it is not a part of a computation written by --chunk of this version")
}

pub(crate) fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
