//! Files and streams: what is written, what is never overwritten, and what happens when nobody reads.

use std::process::Stdio;

use crate::common::{Folder, errors};
use serde_json::Value;

/// Every command that computes, made quick.
const QUICK: [(&str, bool); 14] = [
    ("toss", true),
    ("toss --many --transient 100 --examined 100 --periods 2", true),
    ("motor report", false),
    ("motor transient --members 5 --duration 4 --intervals 40", true),
    ("motor curve --loads 0:45e-6:3 --relative-error 0.3 --members 4 --no-spread", true),
    ("motor sweep --over load_torque=0:45e-6:3 --relative-error 0.3 --members 4", true),
    (
        "motor sweep --over friction=0.1:0.2:2 --over load_torque=0:45e-6:2 --relative-error 0.3 --members 4",
        true,
    ),
    ("orbits --impacts 1 --starts 4", true),
    ("diagram -G 0.3:0.6:5 --transient 50 --recorded 20", true),
    ("verdicts -G 0.3:0.6:4 --impacts 500 --transient 100", true),
    ("verdicts -G 0:1:4 -r 0:0.9:3 --impacts 500 --transient 100", true),
    ("basins --cells 8 --starts 50", true),
    ("doublings --count 3", true),
    ("curves --max-points 3", false),
];

#[test]
fn every_command_writes_every_kind_of_file() {
    let folder = Folder::new();
    for (index, (line, has_picture)) in QUICK.into_iter().enumerate() {
        let text = folder.done(line);
        assert!(text.lines().count() >= 2 && text.ends_with('\n'), "{line}: {text}");
        let name = |ending: &str| format!("{index}.{ending}");
        let (csv, json) = (name("csv"), name("json"));
        assert_eq!(folder.done(&format!("{line} --out {csv} --out {json}")), "", "{line}");
        let table = folder.text(&csv);
        let mut lines = table.lines();
        let provenance = lines.next().and_then(|first| first.strip_prefix("# provenance: ")).unwrap();
        let provenance: Value = serde_json::from_str(provenance).unwrap();
        assert_eq!(provenance["program"], "bouncing-disk-cli", "{line}");
        let columns = lines.next().unwrap().split(',').count();
        assert!(lines.clone().count() >= 1, "{line}");
        assert!(lines.all(|row| row.contains('"') || row.split(',').count() == columns), "{line}: {table}");
        // The bytes do not depend on the number of threads.
        let one = name("one.json");
        folder.done(&format!("{line} --threads 1 --out {one}"));
        folder.done(&format!("{line} --threads 3 --out {json} --force"));
        assert!(folder.read(&one) == folder.read(&json), "{line}");
        let stored: Value = serde_json::from_slice(&folder.read(&json)).unwrap();
        assert_eq!(stored["provenance"], provenance, "{line}");
        assert!(stored.as_object().unwrap().len() >= 2, "{line}");
        let (svg, png) = (name("svg"), name("PNG"));
        let pictures = format!("{line} --out {svg} --out {png}");
        if has_picture {
            folder.done(&pictures);
            assert!(folder.read(&svg).starts_with(b"<svg"), "{line}");
            assert!(folder.read(&png).starts_with(b"\x89PNG"), "{line}");
        } else {
            assert!(folder.refused(&pictures, 2).contains("has no picture"), "{line}");
        }
    }
    assert!(folder.names().iter().all(|name| !name.starts_with('.')), "{:?}", folder.names());
}

#[test]
fn places_that_cannot_be_written_are_refused_before_anything_is_computed() {
    let folder = Folder::new();
    folder.write("a.csv", "mine");
    std::fs::create_dir(folder.join("taken.csv")).unwrap();
    // It would take hours.
    let long = "verdicts -G 0:3:20000 -r 0:0.9:20000 --out";
    let lines: [(&str, &str); _] = [
        (&format!("{long} a.csv"), "a.csv: it exists already; --force replaces it"),
        (&format!("{long} no/such/a.csv"), "the folder no/such does not exist"),
        (&format!("{long} taken.csv"), "it is a folder"),
    ];
    folder.all_refused(2, &lines);
    if cfg!(target_os = "linux") {
        // A folder in which nobody can write.
        folder.all_refused(1, &[(&format!("{long} /proc/a.csv"), "/proc/a.csv cannot be written")]);
    }
    assert_eq!(folder.read("a.csv"), b"mine");
    folder.done("toss --out a.csv --force");
    assert_ne!(folder.read("a.csv"), b"mine");
    assert_eq!(folder.names(), ["a.csv", "taken.csv"]);
}

#[test]
fn a_reader_that_goes_is_no_error() {
    let folder = Folder::new();
    for line in [
        "verdicts -G 0.3:0.31:2000 --impacts 64 --transient 10",
        "--help",
        "man motor sweep",
        "toss --template",
    ] {
        let mut child = folder.command(line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // Nobody will ever read.
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), errors(&output).as_str()), (Some(0), ""), "{line}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let folder = Folder::new();
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let output = folder.command("toss").stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", errors(&output));
}

#[test]
fn a_template_is_read_to_the_same_result() {
    let folder = Folder::new();
    for preset in ["pizza-toss", "motor"] {
        folder.write("system.toml", &folder.done(&format!("toss --template --preset {preset}")));
        assert_eq!(folder.done("toss system.toml"), folder.done(&format!("toss --preset {preset}")));
        assert_eq!(
            folder.done("verdicts system.toml --impacts 200"),
            folder.done(&format!("verdicts --preset {preset} --impacts 200"))
        );
    }
    folder.write("motor.toml", &folder.done("motor report --template --preset paper-184-khz"));
    assert_eq!(folder.done("motor report motor.toml"), folder.done("motor report --preset paper-184-khz"));
    // What is set is in the template.
    assert!(folder.done("toss --template --set disk.friction=0.25").contains("friction = 0.25"));
}

#[test]
fn a_computed_run_up_is_read_by_fit() {
    let folder = Folder::new();
    folder.done("motor transient --members 6 --duration 5 --intervals 50 --out run.csv --out run.json");
    let fit = folder.done("fit run.csv");
    let run = folder.done("motor transient --members 6 --duration 5 --intervals 50");
    let line = |text: &str| text.lines().find(|line| line.starts_with("time constant ")).unwrap().to_owned();
    let number = |text: &str, word: usize| {
        let line = line(text);
        line.split_whitespace().nth(word).unwrap().trim_end_matches(')').parse::<f64>().unwrap()
    };
    // The run-up from rest has the time constant that the interval of the file's fit, with any start, holds.
    let (low, high, value) = (number(&fit, 6), number(&fit, 8), number(&run, 2));
    assert!(low < value && value < high, "{fit}\n{run}");
}

/// One value, one cell, nothing found, nothing that turns: each has a picture.
/// A file of a table has no place for it.
#[test]
fn a_cascade_that_ends_early_says_why_beside_its_files() {
    let folder = Folder::new();
    let said = |line: &str| crate::common::errors(&folder.command(line).output().unwrap());
    let early = said("doublings -r 0.01 --out early.csv");
    assert!(early.contains("warning: no doubling 3: "), "{early}");
    assert!(!said("doublings -r 0.01 -n 2 --out two.csv").contains("warning"));
    assert!(folder.done("doublings -r 0.01").contains("no doubling 3: "));
}

#[test]
fn pictures_of_the_least_are_drawn() {
    let folder = Folder::new();
    for (index, line) in [
        "diagram -G 0.4:0.4:1 --recorded 1 --transient 0",
        "diagram -G 0 --recorded 4 --transient 0",
        "verdicts -G 0 --impacts 64",
        "verdicts -G 0.5 -r 0:0.5:2 --impacts 64 --transient 1",
        "basins --cells 1 --starts 1 --phase -0.5:0.5",
        "orbits -G 0",
        "orbits -G 0.01 --impacts 64 --platform-periods 1 --starts 2",
        "doublings --count 1",
        "doublings -r 0.01",
        "motor sweep --over friction=0.1 --relative-error 0.5 --members 4",
        "motor sweep --over load_torque=1e-3:2e-3:2 --relative-error 0.5 --members 4",
        "motor sweep --over load_torque=1e-3 --over phase_lag=-0.1 --relative-error 0.5 --members 4",
        "motor curve --loads 1e-3 --relative-error 0.5 --members 4 --no-spread",
        "motor curve --loads -1e-6:0:2 --set friction=0 --relative-error 0.5 --members 4 --no-spread",
        "motor curve --loads 0:1e-5:2 --relative-error 0.5 --members 4 --no-spread",
        "motor curve --loads 1e-3:2e-3:3 --relative-error 0.5 --members 4 --no-spread",
        "diagram -G 0.4:0.6:3 --start rest --start rise --start 0.1,1 --start 0.2,1 --start -0.123456,0.1234567",
        "diagram -G 1e6 --recorded 4 --transient 0",
        "verdicts -G 1e6 --impacts 64",
        "verdicts -G 1e6:2e6:2 --impacts 64",
        "orbits -G 1e6 --impacts 1 --starts 2",
        "toss --preset motor --many --transient 1 --examined 2 --periods 400",
        "motor transient --members 1 --intervals 3 --duration 0.01",
        "motor transient --members 5 --intervals 10 --set peak_angular_speed=0",
        "toss --set platform.twist_amplitude=0 --samples 2",
        "toss --many --set platform.amplitude=0 --transient 1 --examined 2",
        "toss --many --periods 0 --transient 1 --examined 2",
        "toss --many --set platform.amplitude=0 --periods 3 --transient 1 --examined 2",
    ]
    .into_iter()
    .enumerate()
    {
        folder.done(&format!("{line} --out {index}.svg --out {index}.json --out {index}.csv --quiet"));
    }
}

/// A file that is wrong, or lacks something, is put right by what is set.
#[test]
fn settings_come_before_the_checks() {
    let folder = Folder::new();
    let motor = folder.done("motor report --template");
    let toss = folder.done("toss --template");
    let (friction, disk) = ("friction = 0.1", "friction = 0.6");
    assert!(motor.contains(friction) && toss.contains(disk));
    for wrong in ["friction = -1", "friction = nan", "# none"] {
        folder.write("motor.toml", &motor.replace(friction, wrong));
        folder.write("toss.toml", &toss.replace(disk, wrong));
        folder.refused("motor report motor.toml", 2);
        folder.refused("toss toss.toml", 2);
        assert_eq!(folder.done("motor report motor.toml --set friction=0.1"), folder.done("motor report"));
        assert_eq!(folder.done("toss toss.toml --set disk.friction=0.6"), folder.done("toss"));
    }
    // Two alternatives, of which one is set again.
    folder.write("motor.toml", &(motor.clone() + "preload_force = 0.3\n"));
    folder.refused("motor report motor.toml", 2);
    assert_eq!(
        folder.done("motor report motor.toml --set preload_acceleration=9.8"),
        folder.done("motor report --set preload_acceleration=9.8")
    );
}

#[test]
fn a_template_goes_into_a_file_by_the_rules_of_results() {
    let folder = Folder::new();
    for (line, name) in [
        ("toss --template", "toss.toml"),
        ("basins --template --preset motor", "basins.toml"),
        ("motor sweep --template --preset paper-184-khz", "motor.toml"),
        ("motor stall --template", "stall.toml"),
    ] {
        let text = folder.done(line);
        assert_eq!(folder.done(&format!("{line} --out {name}")), "");
        assert_eq!(folder.text(name), text, "{line}");
        let refused = folder.refused(&format!("{line} --out {name}"), 2);
        assert!(refused.contains("it exists already; --force replaces it"), "{refused}");
        folder.done(&format!("{line} --out {name} --force"));
    }
}

/// The motion of many tosses ends after as many periods as are asked for, and not with the next impact.
#[test]
fn a_motion_has_the_periods_that_are_asked_for() {
    let folder = Folder::new();
    for (periods, samples) in [(1, 2), (3, 50), (10, 400)] {
        let line = format!("toss --many --periods {periods} --samples {samples} --transient 1 --examined 2");
        folder.done(&format!("{line} --out a.json --force"));
        let stored: Value = serde_json::from_slice(&folder.read("a.json")).unwrap();
        let motion = stored["motion"].as_array().unwrap();
        assert_eq!(motion.len(), samples);
        let end = f64::from(periods) * std::f64::consts::TAU / 15.0;
        for (index, sample) in motion.iter().enumerate() {
            let time = sample["time_s"].as_f64().unwrap();
            assert!((time - end * index as f64 / (samples - 1) as f64).abs() < 1e-12, "{periods}: {time}");
        }
    }
}

/// Every number of a fit of parameters stands beside its unit.
#[test]
fn fitted_parameters_have_units() {
    let folder = Folder::new();
    folder.done("motor transient --members 2 --duration 1 --intervals 20 --out run.csv");
    folder.done(
        "fit run.csv --preset paper-70-khz --parameter friction=0.09:0.11 --parameter phase_lag=-0.1:0.1 --evaluations 20 \
         --out fit.csv",
    );
    let table = folder.text("fit.csv");
    let lines: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(lines[0], "parameter,unit,nominal,value,accepted");
    assert!(lines[1].starts_with("friction,1,0.1,"), "{table}");
    assert!(lines[2].starts_with("phase_lag,rad,0.0,"), "{table}");
    // All these are short: none can be told from another.
    let text = folder.done("fit run.csv --preset paper-70-khz --parameter contact.time=1e-8:1e-6");
    assert!(text.contains("contact.time: anywhere in the range"), "{text}");
}

#[test]
fn an_input_is_no_result() {
    let folder = Folder::new();
    folder.done("motor transient --members 6 --duration 2 --intervals 20 --out run.csv");
    folder.done("verdicts -G 0.3:0.4:2 --impacts 64 --chunk 1/1 --out part.json");
    folder.write("toss.json", "{}");
    let told = "it cannot be both an input and the result";
    let lines: [(&str, &str); _] = [
        ("fit run.csv --out ./run.csv --force", told),
        ("merge part.json --out part.json --force", told),
        ("toss toss.json --out toss.json --force", told),
    ];
    folder.all_refused(2, &lines);
    assert_eq!(folder.read("toss.json"), b"{}");
}

#[cfg(unix)]
#[test]
fn one_file_by_two_names_is_seen_before_anything_is_computed() {
    use std::os::unix::fs::symlink;

    let folder = Folder::new();
    std::fs::create_dir(folder.join("inner")).unwrap();
    let links = [("inner", "other"), ("inner/a.json", "link"), ("link", "far"), ("round.json", "round.json")];
    for (to, name) in links {
        symlink(to, folder.join(name)).unwrap();
    }
    folder.write("inner/a.json", "");
    // It would take hours.
    let long = "verdicts -G 0:3:20000 -r 0:0.9:20000 --force --out";
    for (options, told) in [
        ("inner/a.json --out other/a.json", "it is requested twice, first as inner/a.json"),
        ("inner/a.json --out inner/../inner/a.json", "it is requested twice"),
        ("inner/a.json --out ./inner//a.json", "it is requested twice"),
        // The journal would be opened through the links, however many.
        ("other/a.json --journal link", "it cannot be both the journal and the result"),
        ("inner/a.json --journal far", "it cannot be both the journal and the result"),
        ("round.json --journal round.json", "it cannot be both the journal and the result"),
    ] {
        folder.all_refused(2, &[(&format!("{long} {options}"), told)]);
    }
    assert_eq!(folder.names(), ["far", "inner", "link", "other", "round.json"]);
    // A link is replaced, and not the file to which it leads.
    symlink("inner/a.csv", folder.join("link.csv")).unwrap();
    folder.write("inner/a.csv", "mine");
    folder.done("toss --out link.csv --out inner/b.csv --force");
    assert_eq!(folder.text("inner/a.csv"), "mine");
    assert!(folder.read("link.csv") == folder.read("inner/b.csv"));
}

/// Names of files are bytes on most systems.
#[cfg(target_os = "linux")]
#[test]
fn names_of_files_need_not_be_texts() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt as _;

    let folder = Folder::new();
    let name = |bytes: &'static [u8]| OsStr::from_bytes(bytes);
    let run = |line: &str, names: &[&OsStr]| {
        let output = folder.command(line).args(names).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{line}: {}", errors(&output));
    };
    run("toss --template", &[name(b"--out=\xff.toml")]);
    run("toss --out a.csv", &[name(b"\xff.toml")]);
    run(
        "verdicts -G 0.3:0.4:2 --impacts 64 --chunk 1/1 --journal",
        &[name(b"\xfe"), name(b"--out=\xff.json")],
    );
    run("merge --out b.csv", &[name(b"\xff.json")]);
    run("toss --template", &[name(b"-o"), name(b"\xfd.toml")]);
    assert!(folder.join("a.csv").exists() && folder.join("b.csv").exists());
    // What is no file is a text, and that is told.
    let output = folder.command("toss --set").arg(name(b"\xff=1")).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(errors(&output).contains("UTF-8"), "{}", errors(&output));
}

/// The words of a picture are about what it shows.
#[test]
fn a_torque_curve_names_what_lies_within_its_loads() {
    let folder = Folder::new();
    let (limit, nothing) = ("largest torque", "no load has a steady speed");
    for (loads, has_limit, has_nothing) in
        [("0:1e-5:2", false, false), ("0:45e-6:2", true, false), ("1e-3:2e-3:2", false, true)]
    {
        let line = format!(
            "motor curve --loads {loads} --relative-error 0.5 --members 4 --no-spread --out a.svg --force"
        );
        folder.done(&line);
        let svg = folder.text("a.svg");
        assert_eq!((svg.contains(limit), svg.contains(nothing)), (has_limit, has_nothing), "{loads}");
        assert_eq!(svg.contains("efficiency</"), !has_nothing, "{loads}");
    }
}

/// With the library of the same build, which lies beside the program's dependencies.
#[test]
fn a_unit_is_packed_whole_or_not_at_all() {
    let folder = Folder::new();
    let text = folder.done("motor fmu --set friction=0.2 --out a.fmu");
    assert_eq!(text, "");
    let unit = folder.read("a.fmu");
    assert!(unit.starts_with(b"PK") && unit.len() > 500_000);
    folder.done("motor fmu --set friction=0.2 --out b.fmu");
    assert!(folder.read("b.fmu") == unit, "the same motor and library give the same bytes");
    folder.write("no.so", "\u{7f}ELF");
    folder.write("drive.toml", &(folder.done("motor report --template") + "[drive]\nheight = 'triangle'\n"));
    folder.write(
        "timed.toml",
        &(folder.done("motor report --template") + "[load]\nspeeds = [0.0]\ntorques = [0.0]\noff = 1.0\n"),
    );
    folder.all_refused(
        2,
        &[
            ("motor fmu", "give --out FILE.fmu"),
            ("motor fmu --out a.csv", "must end in .fmu"),
            ("motor fmu --out a.fmu", "--force replaces it"),
            ("motor fmu --out c.fmu --library no.so", "not the library of a functional mock-up unit"),
            ("motor fmu --out c.fmu --library none.so", "cannot be read"),
            ("motor fmu drive.toml --out c.fmu", "[drive]"),
            ("motor fmu timed.toml --out c.fmu", "need a table [stator]"),
            ("toss --out a.fmu", ".fmu needs motor fmu"),
        ],
    );
    assert!(!folder.names().contains(&"c.fmu".to_owned()));
}
