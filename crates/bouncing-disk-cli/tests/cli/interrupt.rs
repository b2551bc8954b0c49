//! Signals: nothing is torn, finished rows are kept, and the same command ends in the same bytes.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Folder, errors};

/// Some seconds of chaos in many rows.
const LONG: &str = "verdicts -G 0.55:0.56:300 --impacts 50000 --threads 1";

fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args([&format!("-{name}"), &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

fn start(folder: &Folder, line: &str) -> Child {
    folder.command(line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Waits until so many lines are in a file.
fn wait_for_lines(folder: &Folder, name: &str, lines: usize) {
    let began = Instant::now();
    loop {
        let found = std::fs::read_to_string(folder.join(name)).unwrap_or_default().lines().count();
        if found >= lines {
            return;
        }
        assert!(began.elapsed() < Duration::from_secs(120), "{found} lines");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_bytes() {
    let folder = Folder::new();
    let line = format!("{LONG} --journal rows.journal --out map.json");
    let mut lines = 2;
    for (name, status) in [("INT", 130), ("TERM", 143)] {
        let child = start(&folder, &line);
        wait_for_lines(&folder, "rows.journal", lines);
        signal(&child, name);
        let output = child.wait_with_output().unwrap();
        let text = errors(&output);
        assert_eq!(output.status.code(), Some(status), "{text}");
        assert!(text.contains("of 300 rows are kept in rows.journal; the same command resumes"), "{text}");
        // Nothing else was written, nothing is torn.
        assert_eq!(folder.names(), ["rows.journal"]);
        let kept = std::fs::read_to_string(folder.join("rows.journal")).unwrap().lines().count();
        assert!(kept >= lines && kept < 301, "{kept}");
        lines = kept + 1;
    }
    // Killed without a warning.
    let mut child = start(&folder, &line);
    wait_for_lines(&folder, "rows.journal", lines);
    child.kill().unwrap();
    child.wait().unwrap();
    folder.done(&line);
    folder.done(&format!("{LONG} --out whole.json"));
    assert!(folder.read("map.json") == folder.read("whole.json"));
    // Another computation does not go on from there.
    let text = folder.refused("verdicts -G 0.55:0.56:300 --impacts 50001 --journal rows.journal", 2);
    assert!(text.contains("is the journal of another computation") && text.contains("50000"), "{text}");
}

#[test]
fn without_a_journal_the_text_says_how_to_keep_rows() {
    let folder = Folder::new();
    let child = start(&folder, &format!("{LONG} --out map.json"));
    std::thread::sleep(Duration::from_millis(300));
    signal(&child, "INT");
    let output = child.wait_with_output().unwrap();
    let text = errors(&output);
    assert_eq!(output.status.code(), Some(130), "{text}");
    assert!(text.contains("nothing is kept. With --journal FILE"), "{text}");
    assert!(folder.names().is_empty() && output.stdout.is_empty());
}

#[test]
fn other_long_commands_stop_too() {
    let folder = Folder::new();
    for line in [
        "motor curve --relative-error 1e-5 --most-impacts 1000000000000",
        "orbits --impacts 64 --platform-periods 1000 --starts 4096",
        "motor stall --relative-error 1e-5 --most-impacts 1000000000000",
        "toss --many --periods 1000000000 --out toss.csv",
        "toss --many --transient 1000000000000 --out toss.csv",
    ] {
        let child = start(&folder, line);
        std::thread::sleep(Duration::from_millis(400));
        let sent = Instant::now();
        signal(&child, "INT");
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{line}: {}", errors(&output));
        assert!(errors(&output).contains("interrupted at "), "{line}");
        assert!(sent.elapsed() < Duration::from_secs(5), "{line}: {:?}", sent.elapsed());
        assert!(folder.names().is_empty(), "{line}: {:?}", folder.names());
    }
}

#[test]
fn a_journal_is_of_one_process() {
    let folder = Folder::new();
    let mut child = start(&folder, &format!("{LONG} --journal rows.journal"));
    wait_for_lines(&folder, "rows.journal", 2);
    // The line is right, and may be given again later.
    let text = folder.refused(&format!("{LONG} --journal rows.journal"), 1);
    assert!(text.contains("is locked"), "{text}");
    child.kill().unwrap();
    child.wait().unwrap();
}
