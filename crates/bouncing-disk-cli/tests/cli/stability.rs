//! Files of version 0.1: its parameter files are read, and parts of its computations are rejected by name (docs/contributing.md).

use std::fs;
use std::path::Path;

use crate::common::{Folder, no_part};

/// A folder with the files that version 0.1 wrote.
fn of_0_1() -> Folder {
    let folder = Folder::new();
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/0.1");
    for entry in fs::read_dir(data).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), folder.join(&entry.file_name().to_string_lossy())).unwrap();
    }
    folder
}

#[test]
fn data_sheets_and_parameters_are_read() {
    let folder = of_0_1();
    assert_eq!(folder.done("toss toss.toml"), folder.done("toss"));
    let sweep = |sheet: &str| {
        folder.done(&format!(
            "motor sweep {sheet} --over load_torque=0:30e-6:2 --relative-error 0.5 --members 4"
        ))
    };
    assert_eq!(sweep("motor.toml"), sweep(""));
    assert_eq!(sweep("motor.json"), sweep(""));
}

#[test]
fn parts_and_journals_are_refused_by_name() {
    let folder = of_0_1();
    let journal = folder.read("diagram.journal");
    let line = "diagram -G 0.3:0.62:4 --transient 200000 --recorded 4 --journal diagram.journal";
    let message = folder.refused(line, 2);
    assert!(message.contains("0.1.0") && message.contains(env!("CARGO_PKG_VERSION")), "{message}");
    // Parts were another kind of file then.
    folder.all_refused(2, &[("merge chunk.json", &no_part("chunk.json"))]);
    assert!(folder.read("diagram.journal") == journal);
}
