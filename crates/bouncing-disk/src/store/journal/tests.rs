use std::fs;
use std::process::id;

use super::*;

/// A path without a file, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("bouncing-disk-journal-{name}-{}", id()));
        let _ = fs::remove_file(&path);
        Self(path)
    }

    fn bytes(&self) -> Vec<u8> {
        fs::read(&self.0).expect("readable")
    }

    fn write(&self, bytes: impl AsRef<[u8]>) {
        fs::write(&self.0, bytes).expect("writable");
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

fn key(friction: f64) -> Provenance {
    let values = json!({ "friction": friction, "loads": [0.0, 1e-3] });
    Provenance::new(JOURNAL).with("motor", &values).expect("storable").with_seed(7)
}

type Opened = Result<(Journal<Vec<f64>>, PartialResults<Vec<f64>>), StorageError>;

fn open(scratch: &Scratch) -> Opened {
    Journal::open(&scratch.0, &key(0.1), 100)
}

/// Numbers whose last bits are lost unless floats are written and read with care.
fn result(index: usize) -> Vec<f64> {
    (0..5).map(|k| (index as f64 + 0.1 * f64::from(k)).sqrt() / 3.0e7).chain([-0.0, 5e-324]).collect()
}

fn bits(results: &PartialResults<Vec<f64>>) -> Vec<(usize, Vec<u64>)> {
    results.iter().map(|(index, own)| (index, own.iter().map(|x| x.to_bits()).collect())).collect()
}

/// A journal of the results of these items.
fn of(scratch: &Scratch, indices: impl IntoIterator<Item = usize>) -> Vec<u8> {
    let (mut journal, _) = open(scratch).expect("opens");
    for index in indices {
        journal.append(index, &result(index)).expect("writable");
    }
    scratch.bytes()
}

#[test]
fn what_was_finished_comes_back_bit_for_bit() {
    let scratch = Scratch::new("bits");
    of(&scratch, [3, 99, 0]);
    let (mut journal, finished) = open(&scratch).expect("opens");
    let expected =
        [0, 3, 99].map(|index| (index, result(index).iter().map(|x| x.to_bits()).collect::<Vec<_>>()));
    assert_eq!(bits(&finished), expected);
    assert_eq!((journal.done(), journal.items(), finished.total()), (3, 100, 100));
    // Existing results stay, and are not written again.
    let before = scratch.bytes();
    journal.append(3, &vec![1.0]).expect("ignored");
    journal.record(&finished).expect("ignored");
    assert_eq!(scratch.bytes(), before);
    // The results of a run are recorded together; others may be read meanwhile.
    let mut more = PartialResults::new(100);
    more.extend([(5, result(5)), (3, vec![1.0]), (6, result(6))]);
    journal.record(&more).expect("writable");
    assert_eq!(journal.done(), 5);
    let read = Journal::<Vec<f64>>::read(&scratch.0, &key(0.1), 100).expect("readable");
    assert_eq!(read.get(3), Some(&result(3)));
    assert_eq!(read.done(), 5);
    // Every line is a JSON object; the first names program, versions, parameters, seed and policy.
    let text = String::from_utf8(scratch.bytes()).expect("text");
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.len(), 6);
    let provenance = &lines[0]["provenance"];
    assert_eq!(provenance["program"], "bouncing-disk");
    assert_eq!(provenance["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!((&provenance["format_version"], &provenance["seed"]), (&json!(1), &json!(7)));
    assert_eq!(provenance["parameters"]["motor"]["friction"], 0.1);
    assert!(provenance.as_object().expect("object").contains_key("chatter_policy"));
    assert_eq!(lines[2]["index"], 99);
}

/// A process may be killed after writing any number of bytes.
#[test]
fn a_file_that_ends_anywhere_loses_only_the_line_that_was_not_finished() {
    let scratch = Scratch::new("torn");
    let whole = of(&scratch, 0..4);
    let ends: Vec<usize> = (0..whole.len()).filter(|at| whole[*at] == b'\n').map(|at| at + 1).collect();
    for length in 0..=whole.len() {
        scratch.write(&whole[..length]);
        let lines = ends.iter().filter(|end| **end <= length).count();
        // Reading changes nothing.
        let read = Journal::<Vec<f64>>::read(&scratch.0, &key(0.1), 100).expect("readable");
        assert_eq!((read.done(), scratch.bytes().len()), (lines.saturating_sub(1) as u64, length));
        let (mut journal, finished) = open(&scratch).expect("opens");
        assert_eq!(bits(&finished), bits(&read), "{length}");
        for index in 0..4 {
            journal.append(index, &result(index)).expect("writable");
        }
        assert_eq!(scratch.bytes(), whole, "{length}");
    }
    // A power cut may leave this instead of data that were not yet on the disk.
    scratch.write([&whole[..ends[2]], &[0; 50]].concat());
    assert_eq!(open(&scratch).expect("opens").1.done(), 2);
    assert_eq!(scratch.bytes(), whole[..ends[2]]);
}

#[test]
fn the_journal_of_another_computation_is_refused_by_name() {
    let scratch = Scratch::new("key");
    let whole = of(&scratch, [1]);
    let fault = |key: &Provenance, items: usize| {
        let error = Journal::<Vec<f64>>::open(&scratch.0, key, items).expect_err("another key");
        assert_eq!(scratch.bytes(), whole);
        assert!(matches!(error, StorageError::OtherKey { .. }), "{error:?}");
        error.to_string()
    };
    let text = fault(&key(0.2), 100);
    assert!(text.contains(&format!("{:?}", scratch.0)), "{text}");
    assert!(
        text.ends_with(
            "another computation: its provenance.parameters.motor.friction is 0.1, but 0.2 is requested"
        ),
        "{text}"
    );
    assert!(fault(&key(0.1), 101).ends_with("its items is 100, but 101 is requested"));
    assert!(fault(&key(0.1).with_seed(8), 100).ends_with("its provenance.seed is 7, but 8 is requested"));
    let cut = fault(&key(0.1).with_chatter_policy(crate::motion::PAPER_CHATTER), 100);
    assert!(cut.contains("provenance.chatter_policy is null, but {\"Cut\":"), "{cut}");
    let more = fault(&key(0.1).with("load", &1.0).expect("storable"), 100);
    assert!(more.contains("provenance.parameters.load is absent, but 1.0"), "{more}");
    // Results of two versions of a program are not mixed.
    let other = fault(&key(0.1).written_by("bouncing-disk", "0.0.1"), 100);
    assert!(other.contains("its provenance.version is \"") && other.contains("but \"0.0.1\""), "{other}");
    let long = fault(&key(0.1).with("motor", &"x".repeat(10_000)).expect("storable"), 100);
    assert!(long.len() < 1_000, "{long}");
}

#[test]
fn a_newer_format_is_refused_by_name_whatever_follows() {
    let scratch = Scratch::new("newer");
    let first = r#"{"version":2,"provenance":{"format":"bouncing-disk journal","format_version":2,"program":"bouncing-disk","version":"3.1.4","cluster":{}}}"#;
    let file = format!("{first}\n{{\"other\":1}}\n");
    scratch.write(&file);
    let error = open(&scratch).expect_err("newer");
    assert!(matches!(error, StorageError::NewerFormat { found: 2, newest: 1, .. }), "{error:?}");
    let text = error.to_string();
    for words in ["journal-newer", "version 2", "\"bouncing-disk 3.1.4\"", "newest that bouncing-disk 0."] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert_eq!(scratch.bytes(), file.as_bytes());
    // A key of another format is the caller's error.
    let figure = Provenance::new(Format { name: "figure", version: 1, oldest: 1 });
    assert!(matches!(Journal::<f64>::open(&scratch.0, &figure, 1), Err(StorageError::OtherFormat { .. })));
}

#[test]
fn a_file_that_is_no_journal_is_not_touched() {
    let scratch = Scratch::new("foreign");
    for content in ["notes", "notes\n", "{}\n", "{\"provenance\":3}\n", "[1]\n", "\n", "{\"digest\":\"x"] {
        scratch.write(content);
        let error = open(&scratch).expect_err("no journal");
        assert!(
            matches!(error, StorageError::OtherFormat { .. } | StorageError::Provenance { .. }),
            "{content:?}: {error:?}"
        );
        assert_eq!(scratch.bytes(), content.as_bytes());
    }
    let folder = Journal::<f64>::open(std::env::temp_dir(), &key(0.1), 1).expect_err("a folder");
    assert!(matches!(folder, StorageError::Io { action: "open", .. }), "{folder:?}");
    let nowhere = Journal::<f64>::open(scratch.0.join("in"), &key(0.1), 1).expect_err("in a file");
    assert!(nowhere.to_string().starts_with("cannot open \""), "{nowhere}");
}

#[test]
fn a_changed_line_is_named() {
    let scratch = Scratch::new("changed");
    let whole = of(&scratch, 0..4);
    let text = String::from_utf8(whole).expect("text");
    scratch.write(text.replace("\"index\":2,", "\"index\":7,"));
    let error = open(&scratch).expect_err("changed");
    assert!(matches!(error, StorageError::Damaged { line: 4, .. }), "{error:?}");
    scratch.write(text.replace("\"friction\":0.1", "\"friction\":0.10"));
    assert!(matches!(open(&scratch), Err(StorageError::Damaged { line: 1, .. })));
    // Without the damaged line the others can be read.
    let others: String =
        text.lines().filter(|line| !line.contains("\"index\":2,")).map(|line| format!("{line}\n")).collect();
    scratch.write(others);
    assert_eq!(open(&scratch).expect("opens").1.done(), 3);
    // An item beyond those of the header: the last existing one is 2.
    let fewer = || Journal::<Vec<f64>>::open(&scratch.0, &key(0.1), 3);
    scratch.write("");
    drop(fewer().expect("opens"));
    let header = String::from_utf8(scratch.bytes()).expect("text");
    let (_, lines) = text.split_once('\n').expect("a header");
    scratch.write(header + lines);
    assert_eq!(fewer().expect_err("four items").to_string(), "item 3 does not exist: there are only 3 items");
    scratch.write(&text);
    // Results of another kind.
    let error = Journal::<String>::open(&scratch.0, &key(0.1), 100).expect_err("lists");
    assert!(matches!(error, StorageError::Result { line: 2, .. }), "{error:?}");
}

#[test]
fn two_do_not_write_at_once() {
    let scratch = Scratch::new("lock");
    let (mut journal, _) = open(&scratch).expect("opens");
    let error = open(&scratch).expect_err("locked");
    assert!(matches!(error, StorageError::Busy { .. }), "{error:?}");
    assert!(error.to_string().contains("journal-lock"));
    journal.append(0, &result(0)).expect("still its own");
    drop(journal);
    assert_eq!(open(&scratch).expect("free").1.done(), 1);
}

#[test]
fn what_could_not_be_read_again_is_not_written() {
    let scratch = Scratch::new("unstorable");
    let before = of(&scratch, [0]);
    let (mut journal, _) = open(&scratch).expect("opens");
    let error = journal.append(1, &vec![f64::NAN]).expect_err("no JSON");
    assert!(error.to_string().starts_with("the result of item 1 cannot be stored"), "{error}");
    let error = journal.append(100, &vec![1.0]).expect_err("no such item");
    assert_eq!(error.to_string(), "item 100 does not exist: there are only 100 items");
    assert_eq!((scratch.bytes(), journal.done()), (before, 1));
}

/// The journal of a process that is to be killed.
const TO_BE_KILLED: &str = "BOUNCING_DISK_TEST_JOURNAL";

/// Runs itself as a separate process, and kills it as soon as a few more items are finished.
#[test]
fn a_process_that_is_killed_goes_on_where_it_was() {
    const ITEMS: usize = 1_000_000;
    if let Some(path) = std::env::var_os(TO_BE_KILLED) {
        let (mut journal, finished) = Journal::open(path, &key(0.1), ITEMS).expect("free");
        for index in finished.open(ITEMS).expect("as many") {
            journal.append(index, &result(index)).expect("writable");
        }
        return;
    }
    let scratch = Scratch::new("killed");
    let lines = || fs::read(&scratch.0).map_or(0, |bytes| bytes.split(|byte| *byte == b'\n').count());
    for _ in 0..3 {
        let before = lines();
        let mut command = std::process::Command::new(std::env::current_exe().expect("runs"));
        let name = concat!(module_path!(), "::a_process_that_is_killed_goes_on_where_it_was");
        let name = name.split_once("::").expect("a crate").1;
        command.args(["--exact", name]).env(TO_BE_KILLED, &scratch.0).stdout(std::process::Stdio::null());
        let mut child = command.spawn().expect("starts");
        while lines() < before + 8 && child.try_wait().expect("its own child").is_none() {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        child.kill().expect("its own child");
        assert!(!child.wait().expect("its own child").success(), "it was never killed on the way");
        assert!(lines() >= before + 8, "{} lines after {before}", lines());
    }
    let (_, finished) = Journal::<Vec<f64>>::open(&scratch.0, &key(0.1), ITEMS).expect("free again");
    let expected = (0..finished.done() as usize).map(|index| (index, result(index)));
    assert!(finished.iter().map(|(index, own)| (index, own.clone())).eq(expected));
}

/// 0 and -0 are equal numbers but different parameters, as are `None` and an absent parameter.
#[test]
fn parameters_that_look_alike_are_others() {
    let scratch = Scratch::new("alike");
    let of = |load: Option<f64>| Provenance::new(JOURNAL).with("load", &load).expect("storable");
    drop(Journal::<f64>::open(&scratch.0, &of(Some(0.0)), 3).expect("opens"));
    for other in [of(Some(-0.0)), of(None), Provenance::new(JOURNAL)] {
        let error = Journal::<f64>::open(&scratch.0, &other, 3).expect_err("another key");
        assert!(matches!(error, StorageError::OtherKey { .. }), "{error}");
    }
    let scratch = Scratch::new("absent");
    drop(Journal::<f64>::open(&scratch.0, &of(None), 3).expect("opens"));
    let error = Journal::<f64>::open(&scratch.0, &Provenance::new(JOURNAL), 3).expect_err("another key");
    assert!(error.to_string().ends_with("is null, but absent is requested"), "{error}");
}

/// While a process is being started it holds a copy of every open file: the lock of a closed journal must not
/// survive in it.
#[test]
fn a_journal_can_be_opened_again_while_processes_start() {
    let scratch = Scratch::new("spawning");
    let key = Provenance::new(JOURNAL);
    let going = std::sync::atomic::AtomicBool::new(true);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while going.load(std::sync::atomic::Ordering::Relaxed) {
                let mut command = std::process::Command::new(std::env::current_exe().expect("runs"));
                command.arg("--list").stdout(std::process::Stdio::null());
                command.spawn().expect("starts").wait().expect("its own child");
            }
        });
        let opened: Vec<_> = (0..300).map(|_| Journal::<f64>::open(&scratch.0, &key, 3).map(drop)).collect();
        going.store(false, std::sync::atomic::Ordering::Relaxed);
        for outcome in opened {
            outcome.expect("free again");
        }
    });
}
