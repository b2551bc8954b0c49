//! What `cargo xtask figures` does with files that others write, remove or malform, run as a program of its
//! own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Two that cost nothing: one with a table, one without.
const CHEAP: [&str; 2] = ["fig01", "table1"];

/// A folder that is removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("bouncing-disk-files-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("writable");
        Self(path)
    }

    fn join(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.join(name);
        fs::create_dir_all(path.parent().expect("in the folder")).expect("writable");
        fs::write(path, bytes).expect("writable");
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A draft run without measurements, whatever those are that the user who runs the tests has.
fn figures(out: &Path) -> Command {
    run("draft", out, Path::new(env!("CARGO_TARGET_TMPDIR")))
}

fn run(quality: &str, out: &Path, measured: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
    command.args(["figures", "--quality", quality]).arg("--out").arg(out).arg("--measured").arg(measured);
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
    let text = [output.stdout.as_slice(), &output.stderr].concat();
    String::from_utf8(text).expect("prints text")
}

fn succeed(command: &mut Command) -> String {
    let output = output(command);
    assert!(output.status.success(), "{}", text(&output));
    text(&output)
}

fn hidden(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("readable");
    let names = entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned());
    names.filter(|name| name.starts_with('.') && name != ".lock").collect()
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
    assert!(hidden(out).is_empty(), "{:?}", hidden(out));
}

#[test]
fn runs_at_once_in_one_folder_all_succeed() {
    let out = Scratch::new("at-once");
    for _ in 0..2 {
        let runs: Vec<Child> = (0..8)
            .map(|index| {
                // All, and each alone.
                let ids = [&CHEAP[..], &CHEAP[..1], &CHEAP[1..]][index % 3];
                figures(&out.0).args(ids).arg("--force").spawn().expect("starts")
            })
            .collect();
        let failed: Vec<_> =
            runs.into_iter().map(finished).filter(|output| !output.status.success()).collect();
        assert!(failed.is_empty(), "{} of 8 failed; the first: {}", failed.len(), text(&failed[0]));
        assert_consistent(&out.0, &CHEAP);
    }
}

#[test]
fn runs_of_two_qualities_at_once_leave_whole_sets() {
    let out = Scratch::new("qualities");
    let measured = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let table = |quality: &str, option: &str| {
        let mut command = run(quality, &out.0, measured);
        command.args(["table1", option]);
        command
    };
    let qualities = ["draft", "paper", "draft", "paper", "draft", "paper"];
    let runs = qualities.map(|quality| table(quality, "--force").spawn().expect("starts"));
    for run in runs {
        let output = finished(run);
        assert!(output.status.success(), "{}", text(&output));
    }
    let last = ["draft", "paper"].map(|quality| succeed(&mut table(quality, "--list")));
    assert_eq!(last.iter().filter(|list| list.contains("up to date")).count(), 1, "{last:?}");
    assert!(hidden(&out.0).is_empty());
}

#[test]
fn what_a_killed_run_left_goes_and_what_others_left_stays() {
    let out = Scratch::new("killed");
    let left = [
        ".claims.json.4000001.partial",
        ".index.html.4000001.0.partial",
        ".table1.svg.4000001.3.partial",
        ".fig06.png.4000001.partial",
        ".probe.4000001",
    ];
    for name in left {
        out.write(name, "torn");
    }
    out.write("table1.notes.txt", "mine");
    out.write(".mine.partial", "mine");
    // A cache key of whoever wrote it.
    out.write("victim", "mine");
    out.write(
        "out/table1.cache-key",
        r#"{"key":"","quality":"draft","run_time_s":1,"files":{"../victim":"","table1.old":"","table1./../../victim":""}}"#,
    );
    out.write("out/table1.old", "of an earlier version");
    succeed(figures(&out.0).arg("table1"));
    assert_eq!(hidden(&out.0), [".mine.partial"]);
    assert!(out.join("table1.notes.txt").exists());
    succeed(figures(&out.join("out")).arg("table1"));
    assert!(out.join("victim").exists() && !out.join("out/table1.old").exists());
    fs::remove_file(out.join(".mine.partial")).expect("removable");
    assert_consistent(&out.0, &["table1"]);
}

#[test]
fn a_run_that_is_killed_at_any_time_is_repaired_by_the_next() {
    let out = Scratch::new("kill");
    succeed(figures(&out.0).args(CHEAP));
    for index in 0..12 {
        let mut run = figures(&out.0).args(CHEAP).arg("--force").spawn().expect("starts");
        std::thread::sleep(Duration::from_millis(20 * index));
        run.kill().expect("its own child");
        run.wait().expect("its own child");
    }
    succeed(figures(&out.0).args(CHEAP));
    assert_consistent(&out.0, &CHEAP);
}

#[test]
fn the_number_of_threads_has_a_limit() {
    let out = Scratch::new("threads");
    for threads in ["0", "1025", "20000", "-1", "99999999999999999999", "two"] {
        let output = output(figures(&out.0).args(["table1", &format!("--threads={threads}")]));
        assert_eq!(output.status.code(), Some(2), "{}", text(&output));
        assert!(text(&output).contains(threads) && text(&output).contains("--threads"), "{}", text(&output));
    }
    let output = output(figures(&out.0).args(["table1", "--threads", "20000"]));
    assert!(text(&output).contains("20000 is not in 1..=1024"), "{}", text(&output));
    succeed(figures(&out.0).args(["table1", "--threads", "1024"]));
}

#[test]
fn a_folder_that_cannot_be_used_is_refused_by_name() {
    let out = Scratch::new("unusable");
    out.write("file", "");
    for (name, shown) in
        [("file", "file"), ("file/in", "file/in"), ("file/a\nb\u{1b}[2J", r"file/a\nb\u{1b}[2J")]
    {
        let output = output(figures(&out.join(name)).arg("table1"));
        let text = text(&output);
        assert!(
            !output.status.success()
                && text.contains(&format!("the output folder {}", out.join(shown).display())),
            "{text}"
        );
        assert!(!text.contains('\u{1b}') && text.lines().count() == 1, "{text}");
    }
    // Tables would be taken for measurements, and were they called alike, lost.
    out.write("measured/fig10.csv", "mine");
    let output = output(run("draft", &out.join("measured/../measured"), &out.join("measured")).arg("table1"));
    assert_eq!(output.status.code(), Some(2), "{}", text(&output));
    assert_eq!(fs::read(out.join("measured/fig10.csv")).expect("still there"), b"mine");
    assert_eq!(fs::read_dir(out.join("measured")).expect("readable").count(), 1);
}

#[test]
fn files_of_the_user_beside_a_figure_stay() {
    let out = Scratch::new("beside");
    out.write("fig01.csv", "mine");
    succeed(figures(&out.0).arg("fig01"));
    succeed(figures(&out.0).args(["fig01", "--force"]));
    assert_eq!(fs::read(out.join("fig01.csv")).expect("still there"), b"mine");
    let page = fs::read_to_string(out.join("index.html")).expect("written");
    assert!(!page.contains("fig01.csv"));
}

#[test]
fn malformed_records_are_made_again() {
    let out = Scratch::new("malformed");
    succeed(figures(&out.0).arg("table1"));
    let data = fs::read_to_string(out.join("table1.json")).expect("written");
    for name in ["table1.cache-key", "table1.json", "claims.json", "index.html"] {
        for content in
            ["", "{", "[]", "\u{0}", &"[".repeat(100_000), &data.replace("[", "[[],"), "\u{feff}{}"]
        {
            out.write(name, content);
            let check = output(figures(&out.0).args(["table1", "--check"]));
            assert_eq!(check.status.code(), Some(1), "{name}: {}", text(&check));
            assert!(!text(&check).contains("panicked"), "{name}: {}", text(&check));
        }
        succeed(figures(&out.0).arg("table1"));
        assert_consistent(&out.0, &["table1"]);
    }
}

#[test]
fn files_of_a_newer_program_are_named_and_made_again() {
    let out = Scratch::new("newer");
    succeed(figures(&out.0).arg("table1"));
    let stored = fs::read_to_string(out.join("table1.cache-key")).expect("written");
    assert!(stored.contains("\"format_version\": 1,"), "{stored}");
    out.write("table1.cache-key", stored.replace("\"format_version\": 1,", "\"format_version\": 2,"));
    let check = output(figures(&out.0).args(["table1", "--check"]));
    assert_eq!(check.status.code(), Some(1), "{}", text(&check));
    let words = "table1: \"table1.cache-key\" has version 2 of the format \"bouncing-disk cache key\"";
    assert!(text(&check).contains(words), "{}", text(&check));
    succeed(figures(&out.0).arg("table1"));
    assert_consistent(&out.0, &["table1"]);
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::symlink;

    use super::*;

    fn pipe(path: &Path) {
        let made = Command::new("mkfifo").arg(path).status().expect("every Unix has it");
        assert!(made.success());
    }

    #[test]
    fn a_pipe_in_the_place_of_a_file_does_not_block() {
        let out = Scratch::new("pipe");
        fs::create_dir(out.join("measured")).expect("writable");
        pipe(&out.join("measured/fig14.csv"));
        pipe(&out.join("measured/other.csv"));
        symlink("fig14.csv", out.join("measured/fig10.csv")).expect("writable");
        symlink("/dev/zero", out.join("measured/fig11.csv")).expect("writable");
        symlink("nowhere", out.join("measured/fig09_friction.csv")).expect("writable");
        fs::create_dir(out.join("measured/fig09_deceleration.csv")).expect("writable");
        let made = output(run("draft", &out.join("out"), &out.join("measured")).args(["fig09", "fig14"]));
        let text = text(&made);
        assert_eq!(made.status.code(), Some(1), "{text}");
        for words in [
            "fig14: measurements not shown: fig14.csv cannot be read: it is a named pipe; legal is a regular file",
            "fig09: measurements not shown: fig09_deceleration.csv cannot be read: it is a folder",
            "fig09: measurements not shown: fig09_friction.csv cannot be read: No such file",
            "no figure reads a file called other.csv",
        ] {
            assert!(text.contains(words), "{words}: {text}");
        }
    }

    #[test]
    fn a_pipe_among_the_outputs_does_not_block() {
        let out = Scratch::new("pipes");
        for name in ["table1.cache-key", "table1.json", "claims.json", "index.html"] {
            succeed(figures(&out.0).arg("table1"));
            fs::remove_file(out.join(name)).expect("removable");
            pipe(&out.join(name));
            let check = output(figures(&out.0).args(["table1", "--check"]));
            assert_eq!(check.status.code(), Some(1), "{name}: {}", text(&check));
            succeed(figures(&out.0).args(["table1", "--force"]));
            assert_consistent(&out.0, &["table1"]);
        }
    }

    #[test]
    fn a_link_to_the_output_folder_is_followed_and_one_in_it_replaced() {
        let out = Scratch::new("links");
        fs::create_dir(out.join("real")).expect("writable");
        symlink("real", out.join("link")).expect("writable");
        out.write("victim", "mine");
        symlink("../victim", out.join("real/claims.json")).expect("writable");
        succeed(figures(&out.join("link")).arg("table1"));
        assert_consistent(&out.join("real"), &["table1"]);
        assert_eq!(fs::read(out.join("victim")).expect("still there"), b"mine");
    }

    #[test]
    fn what_a_field_holds_reaches_neither_terminal_nor_page() {
        let out = Scratch::new("fields");
        let long = "\u{1b}]0;title\u{7}\u{202e}<script>alert(1)</script>".repeat(100_000);
        out.write("measured/fig14.csv", format!("time_s,diameter\n0,1\n1,{long}\n"));
        out.write("measured/\u{1b}[2J<b>\n.csv", "");
        let made = output(run("draft", &out.join("out"), &out.join("measured")).arg("fig14"));
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
