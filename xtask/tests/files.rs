//! What `cargo xtask figures` does with the files of a folder, run as a program of its own.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A draft run.
fn figures(out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
    command.args(["figures", "--quality", "draft"]).arg("--out").arg(out);
    command
}

fn text(output: &Output) -> String {
    String::from_utf8([output.stdout.as_slice(), &output.stderr].concat()).expect("prints text")
}

fn succeed(command: &mut Command) -> String {
    let output = command.output().expect("starts");
    assert!(output.status.success(), "{}", text(&output));
    text(&output)
}

#[test]
fn figures_are_made_and_what_others_left_stays() {
    let out = tempfile::tempdir().expect("writable");
    let read = |name: &str| fs::read_to_string(out.path().join(name)).expect("written");
    fs::write(out.path().join("fig01.csv"), "mine").expect("writable");
    succeed(figures(out.path()).args(["fig01", "table1"]));
    let (page, claims) = (read("index.html"), read("claims.json"));
    assert!(page.contains("fig01.svg") && page.contains("table1.svg") && !page.contains("fig01.csv"));
    assert!(claims.contains("\"figure\": \"table1\""));
    // What cannot be read is left out, and made again.
    fs::write(out.path().join("table1.json"), "{").expect("writable");
    assert!(succeed(figures(out.path()).arg("fig01")).contains("table1: not in the gallery"));
    succeed(figures(out.path()).arg("table1"));
    assert_eq!(
        (read("index.html"), read("claims.json"), read("fig01.csv")),
        (page, claims, "mine".to_owned())
    );
    let names = fs::read_dir(out.path()).expect("readable").map(|entry| entry.expect("readable").file_name());
    assert!(!names.into_iter().any(|name| name.to_string_lossy().starts_with('.')));
}

#[test]
fn the_documentation_is_that_of_the_figures() {
    let out = tempfile::tempdir().expect("writable");
    let said = succeed(figures(out.path()).args(["fig01", "table1", "--check"]));
    assert!(said.contains("the documentation is up to date"), "{said}");
    assert_eq!(fs::read_dir(out.path()).expect("readable").count(), 0);
}

#[test]
fn a_folder_that_cannot_be_used_and_an_illegal_number_of_threads_are_refused() {
    let out = tempfile::tempdir().expect("writable");
    for threads in ["0", "1025", "-1", "99999999999999999999", "two"] {
        let output = figures(out.path()).args(["table1", &format!("--threads={threads}")]).output();
        let output = output.expect("starts");
        assert_eq!(output.status.code(), Some(2), "{}", text(&output));
        assert!(text(&output).contains(threads) && text(&output).contains("--threads"), "{}", text(&output));
    }
    fs::write(out.path().join("file"), "").expect("writable");
    let output = figures(&out.path().join("file/in")).arg("table1").output().expect("starts");
    let named =
        text(&output).contains(&format!("the output folder {}", out.path().join("file/in").display()));
    assert!(!output.status.success() && named, "{}", text(&output));
}
