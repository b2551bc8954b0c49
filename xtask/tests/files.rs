//! What `cargo xtask figures` does with files that others write, remove or malform, run as a program of its
//! own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Two that cost nothing: one with a table, one without.
const CHEAP: [&str; 2] = ["fig01", "table1"];

/// A folder that is removed at the end.
struct Scratch(tempfile::TempDir);

impl Scratch {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("writable"))
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn join(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.join(name);
        fs::create_dir_all(path.parent().expect("in the folder")).expect("writable");
        fs::write(path, bytes).expect("writable");
    }
}

/// A draft run without measurements, whatever those are that the user who runs the tests has.
fn figures(out: &Path) -> Command {
    run(out, Path::new(env!("CARGO_TARGET_TMPDIR")))
}

fn run(out: &Path, measured: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
    command.args(["figures", "--quality", "draft"]).arg("--out").arg(out).arg("--measured").arg(measured);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn output(command: &mut Command) -> Output {
    finished(command.spawn().expect("starts"))
}

/// What a program has printed at its end, which must come: a minute is many times what it needs.
fn finished(mut child: Child) -> Output {
    let start = Instant::now();
    while child.try_wait().expect("its own child").is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            child.kill().expect("its own child");
            panic!("blocked: {:?}", child.wait_with_output());
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().expect("its own child")
}

fn text(output: &Output) -> String {
    String::from_utf8([output.stdout.as_slice(), &output.stderr].concat()).expect("prints text")
}

fn succeed(command: &mut Command) -> String {
    let output = output(command);
    assert!(output.status.success(), "{}", text(&output));
    text(&output)
}

/// The chosen figures and the common files are of one run, and nothing else is left. (The exit status is that
/// of the documentation, too, which a change of the sources may have put out of date.)
fn assert_consistent(out: &Path, ids: &[&str]) {
    let check = text(&output(figures(out).args(ids).arg("--check")));
    let complains = |line: &str| {
        !line.starts_with("docs/")
            && [": missing or", "not made", "made in ", "changed"].iter().any(|word| line.contains(word))
    };
    assert!(!check.lines().any(complains), "{check}");
    let names = fs::read_dir(out).expect("readable").map(|entry| entry.expect("readable").file_name());
    let hidden: Vec<_> = names.filter(|name| name.to_string_lossy().starts_with('.')).collect();
    assert!(hidden.iter().all(|name| name == ".lock"), "{hidden:?}");
}

#[test]
fn runs_at_once_in_one_folder_all_succeed() {
    let out = Scratch::new();
    let runs: Vec<Child> = (0..8)
        .map(|index| {
            // All, and each alone.
            let ids = [&CHEAP[..], &CHEAP[..1], &CHEAP[1..]][index % 3];
            figures(out.path()).args(ids).arg("--force").spawn().expect("starts")
        })
        .collect();
    let failed: Vec<_> = runs.into_iter().map(finished).filter(|output| !output.status.success()).collect();
    assert!(failed.is_empty(), "{} of 8 failed; the first: {}", failed.len(), text(&failed[0]));
    assert_consistent(out.path(), &CHEAP);
}

#[test]
fn a_run_that_is_killed_at_any_time_is_repaired_by_the_next_and_what_others_left_stays() {
    let out = Scratch::new();
    succeed(figures(out.path()).args(CHEAP));
    out.write(".bouncing-disk-partial-4000001", "torn");
    out.write("fig01.csv", "mine");
    for index in 0..12 {
        let mut run = figures(out.path()).args(CHEAP).arg("--force").spawn().expect("starts");
        std::thread::sleep(Duration::from_millis(20 * index));
        run.kill().expect("its own child");
        run.wait().expect("its own child");
    }
    // A cache key of whoever wrote it.
    out.write("victim", "mine");
    out.write(
        "out/table1.cache-key",
        r#"{"provenance":{"program":"bouncing-disk-experiments","version":"0","format":"bouncing-disk cache key",
            "format_version":1,"parameters":{},"seed":null,"chatter_policy":null},"key":"","measured":"",
            "quality":"draft","run_time_s":1,"files":{"../victim":"","table1.old":"","table1./../../victim":""}}"#,
    );
    out.write("out/table1.old", "of an earlier version");
    succeed(figures(&out.join("out")).arg("table1"));
    assert!(out.join("victim").exists() && !out.join("out/table1.old").exists());
    succeed(figures(out.path()).args(CHEAP));
    assert_eq!(fs::read(out.join("fig01.csv")).expect("still there"), b"mine");
    let page = fs::read_to_string(out.join("index.html")).expect("written");
    assert!(!page.contains("fig01.csv"));
    assert_consistent(out.path(), &CHEAP);
}

#[test]
fn a_folder_that_cannot_be_used_and_an_illegal_number_of_threads_are_refused() {
    let out = Scratch::new();
    for threads in ["0", "1025", "-1", "99999999999999999999", "two"] {
        let output = output(figures(out.path()).args(["table1", &format!("--threads={threads}")]));
        assert_eq!(output.status.code(), Some(2), "{}", text(&output));
        assert!(text(&output).contains(threads) && text(&output).contains("--threads"), "{}", text(&output));
    }
    out.write("file", "");
    for (name, shown) in [("file/in", "file/in"), ("file/a\nb\u{1b}[2J", r"file/a\nb\u{1b}[2J")] {
        let output = output(figures(&out.join(name)).arg("table1"));
        let text = text(&output);
        let named = text.contains(&format!("the output folder {}", out.join(shown).display()));
        assert!(!output.status.success() && named, "{text}");
        assert!(!text.contains('\u{1b}') && text.lines().count() == 1, "{text}");
    }
}

#[test]
fn malformed_and_newer_records_are_made_again() {
    let out = Scratch::new();
    succeed(figures(out.path()).arg("table1"));
    let read = |name: &str| fs::read_to_string(out.join(name)).expect("written");
    let (data, stored) = (read("table1.json"), read("table1.cache-key"));
    let refused = |name: &str, content: &str, words: &str| {
        out.write(name, content);
        let check = output(figures(out.path()).args(["table1", "--check"]));
        assert_eq!(check.status.code(), Some(1), "{name}: {}", text(&check));
        assert!(!text(&check).contains("panicked") && text(&check).contains(words), "{}", text(&check));
    };
    for name in ["table1.cache-key", "table1.json", "claims.json", "index.html"] {
        for content in ["", "{", "\u{0}", &"[".repeat(100_000), &data.replace("[", "[[],")] {
            refused(name, content, "");
        }
        succeed(figures(out.path()).arg("table1"));
        assert_consistent(out.path(), &["table1"]);
    }
    let newer = stored.replace("\"format_version\": 1,", "\"format_version\": 2,");
    let words = "table1: \"table1.cache-key\" has version 2 of the format \"bouncing-disk cache key\"";
    refused("table1.cache-key", &newer, words);
    succeed(figures(out.path()).arg("table1"));
    assert_consistent(out.path(), &["table1"]);
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::symlink;

    use super::*;

    fn pipe(path: &Path) {
        assert!(Command::new("mkfifo").arg(path).status().expect("every Unix has it").success());
    }

    #[test]
    fn pipes_and_links_in_the_place_of_files_neither_block_nor_lead_astray() {
        let out = Scratch::new();
        fs::create_dir(out.join("measured")).expect("writable");
        pipe(&out.join("measured/fig14.csv"));
        pipe(&out.join("measured/other.csv"));
        symlink("nowhere", out.join("measured/fig09_friction.csv")).expect("writable");
        fs::create_dir(out.join("measured/fig09_deceleration.csv")).expect("writable");
        let made = output(run(&out.join("out"), &out.join("measured")).args(["fig09", "fig14"]));
        assert_eq!(made.status.code(), Some(1), "{}", text(&made));
        for words in [
            "fig14: measurements not shown: fig14.csv cannot be read: it is a named pipe, not a regular file",
            "fig09: measurements not shown: fig09_deceleration.csv cannot be read: it is a folder",
            "fig09: measurements not shown: fig09_friction.csv cannot be read: No such file",
            "no figure reads a file called other.csv",
        ] {
            assert!(text(&made).contains(words), "{words}: {}", text(&made));
        }
        fs::create_dir(out.join("real")).expect("writable");
        symlink("real", out.join("link")).expect("writable");
        out.write("victim", "mine");
        symlink("../victim", out.join("real/claims.json")).expect("writable");
        pipe(&out.join("real/table1.json"));
        let check = output(figures(&out.join("link")).args(["table1", "--check"]));
        assert_eq!(check.status.code(), Some(1), "{}", text(&check));
        succeed(figures(&out.join("link")).arg("table1"));
        assert_consistent(&out.join("real"), &["table1"]);
        assert_eq!(fs::read(out.join("victim")).expect("still there"), b"mine");
    }

    #[test]
    fn what_a_field_holds_reaches_neither_terminal_nor_page() {
        let out = Scratch::new();
        let long = "\u{1b}]0;title\u{7}\u{202e}<script>alert(1)</script>".repeat(100_000);
        out.write("measured/fig14.csv", format!("time_s,diameter\n0,1\n1,{long}\n"));
        out.write("measured/\u{1b}[2J<b>\n.csv", "");
        let made = output(run(&out.join("out"), &out.join("measured")).arg("fig14"));
        let text = text(&made);
        let data = fs::read_to_string(out.join("out/fig14.json")).expect("written");
        let page = fs::read_to_string(out.join("out/index.html")).expect("written");
        assert_eq!(made.status.code(), Some(1), "{text}");
        let field = r"\u{1b}]0;title\u{7}\u{202e}<script>alert(1)</script>\u{1b}]0";
        assert!(text.contains(&format!("line 3, column 2 (diameter): \"{field}")), "{text}");
        assert!(text.contains("…\" (3600000 characters) is not a number"), "{text}");
        assert!(text.contains(r"no figure reads a file called \u{1b}[2J<b>\n.csv"), "{text}");
        for (name, text) in [("terminal", &text), ("data", &data), ("page", &page)] {
            let illegal = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
            assert!(!text.contains(illegal), "{name}");
        }
        assert!(text.len() < 3000 && !page.contains("<script") && page.contains("&lt;script&gt;"));
    }
}
