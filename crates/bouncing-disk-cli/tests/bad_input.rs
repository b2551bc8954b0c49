//! What cannot be used is refused with status 2 and a text that says what is wrong, where, and what would be
//! right.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod common;

use common::Folder;

/// The template of a toss with one line changed.
fn changed(folder: &Folder, from: &str, to: &str) {
    let text = folder.done("toss --template");
    assert!(text.contains(from), "{from}");
    folder.write("a.toml", &text.replace(from, to));
}

#[test]
fn files_of_parameters_that_cannot_be_read() {
    let folder = Folder::new();
    std::fs::create_dir(folder.join("folder.toml")).unwrap();
    std::fs::write(folder.join("bytes.toml"), b"a = \xff").unwrap();
    folder.write("empty.json", "");
    folder.write("a.txt", "");
    folder.write("deep.json", &format!("{{\"disk\":{}1{}", "{\"a\":".repeat(100_000), "}".repeat(100_001)));
    let keys: Vec<String> = (0..2_000).map(|key| format!("\"{key}\":1")).collect();
    folder.write("wide.json", &format!("{{{}}}", keys.join(",")));
    for (line, told) in [
        ("toss deep.json", "error: deep.json: line 1"),
        ("toss wide.json", "there are more than 1000 keys"),
        ("toss missing.toml", "missing.toml cannot be read"),
        ("toss folder.toml", "legal is a regular file"),
        ("toss bytes.toml", "no text in UTF-8"),
        ("toss empty.json", "empty.json: line 1, column 1: no JSON"),
        ("toss a.txt", "ends in .json or .toml"),
        ("toss a", "ends in .json or .toml"),
        ("motor report missing.json", "missing.json cannot be read"),
        ("motor report empty.json", "empty.json: line 1"),
        ("motor report a.txt", "ends in .json or .toml"),
        ("fit missing.csv", "missing.csv"),
        ("merge missing.json", "missing.json: it cannot be read"),
        ("merge empty.json", "empty.json: it is no whole chunk"),
    ] {
        let text = folder.refused(line, 2);
        assert!(text.contains(told), "{line}: {text}");
    }
}

#[test]
fn values_of_files_that_are_not_legal() {
    let folder = Folder::new();
    for (from, to, told) in [
        ("friction = 0.6", "fricton = 0.6", "the key \"fricton\" is unknown; did you mean \"friction\"?"),
        ("friction = 0.6", "friction = nan", "friction = NaN is outside its legal range"),
        ("friction = 0.6", "friction = inf", "friction = inf is outside its legal range"),
        ("friction = 0.6", "friction = -1", "friction = -1 is outside its legal range"),
        ("friction = 0.6", "friction = \"0.6\"", "must be a number, and is a text"),
        ("restitution = 0.5", "restitution = 1", "restitution = 1 is outside its legal range [0, 1)"),
        ("[disk]", "[disc]", "did you mean \"disk\"?"),
        ("friction = 0.6", "friction = ", "no TOML"),
    ] {
        changed(&folder, from, to);
        let text = folder.refused("toss a.toml", 2);
        assert!(text.starts_with("error: a.toml: line ") && text.contains(told), "{to}: {text}");
    }
    folder.write("motor.json", "{\"amplitud\": 1e-8}");
    let text = folder.refused("motor report motor.json", 2);
    assert!(text.contains("motor.json: line 1") && text.contains("did you mean \"amplitude\"?"), "{text}");
    // A setting that is not legal itself.
    folder.write("motor.toml", &folder.done("motor report --template"));
    let text = folder.refused("motor report motor.toml --set friction=-1", 2);
    assert!(text.contains("motor.toml with --set: friction = -1 is outside"), "{text}");
}

#[test]
fn a_file_of_another_kind_is_told_with_the_commands_that_read_it() {
    let folder = Folder::new();
    folder.write("motor.toml", &folder.done("motor report --template"));
    folder.write("toss.toml", &folder.done("toss --template"));
    folder.write("motor.json", "{\"mass\": 1e-3,\n\"friction\": 0.1}");
    let motor = "this is the data sheet of a motor, which motor and fit --motor read";
    let system = "this is the parameters of a disk and its platform, which toss, orbits, diagram, verdicts, basins, \
                  doublings and design read";
    for (line, place, told) in [
        ("toss motor.toml", "motor.toml: line 3: by its key \"drive_frequency\"", motor),
        ("toss motor.json", "motor.json: line 1: by its key \"mass\"", motor),
        ("basins motor.toml", "motor.toml: line 3: by its key \"drive_frequency\"", motor),
        ("motor report toss.toml", "toss.toml: line 3: by its key \"platform\"", system),
        ("motor curve toss.toml --loads 0:1e-6:2", "toss.toml: line 3: by its key \"platform\"", system),
    ] {
        let text = folder.refused(line, 2);
        assert!(text.starts_with(&format!("error: {place}")) && text.contains(told), "{line}: {text}");
    }
}

#[test]
fn words_of_the_line_that_are_not_legal() {
    let folder = Folder::new();
    for (line, told) in [
        ("", "Usage"),
        ("tos", "tip: a similar subcommand exists: 'toss'"),
        ("toss --many --out a.txt", ".csv, .json, .png or .svg"),
        ("toss --preset pizza", "pizza-toss"),
        ("toss --preset motor a.toml", "cannot be used with"),
        ("toss --set friction=0.2", "did you mean \"disk.friction\"?"),
        ("toss --set disk.friction", "KEY=VALUE"),
        ("toss --set disk.friction=x", "\"x\" is no number"),
        ("toss --set disk.friction=nan", "--set: friction = NaN"),
        ("toss --samples 1", "2..=1000000"),
        ("motor report --set frction=0.2", "did you mean \"friction\"?"),
        ("motor sweep", "--over"),
        ("motor sweep --over load=0:1:3", "load_torque"),
        ("motor sweep --over load_torque", "FIELD=FIRST:LAST:POINTS"),
        ("motor sweep --over friction=0:1:2 --over friction=0:1:2", "friction"),
        ("motor curve --relative-error 2", "relative_error = 2 is"),
        ("motor transient --duration nan", "duration = NaN"),
        ("motor transient --members 0", "members"),
        ("diagram -G 0.6:0.5:3", "reversed"),
        ("diagram -G 0.5:0.6:0", "no values"),
        ("diagram -G 0.5:0.6:1", "one point"),
        ("diagram -G nan", "not finite"),
        ("diagram -G inf", "not finite"),
        ("diagram -G -1", "axial_forcing = -1 is"),
        ("diagram -G x", "\"x\" is no number"),
        ("diagram -r 1", "restitution = 1 is"),
        ("diagram -r 0.1:0.2:3", "takes a single number"),
        ("diagram --start up", "rest, rise, period-1 and PHASE,SPEED"),
        ("diagram --chunk 0/3 --out a.json", "I/N"),
        ("diagram --chunk 4/3 --out a.json", "I/N"),
        ("diagram --chunk 1/3", "--chunk needs one --out FILE.json"),
        ("diagram --chunk 1/3 --out a.csv", "--chunk needs one --out FILE.json"),
        ("diagram --journal a.json --out a.json", "a.json: it cannot be the journal and the result"),
        ("diagram --journal ./a.json --out a.json", "a.json: it cannot be the journal and the result"),
        ("diagram --journal rows/", "--journal: rows/: this is the name of a folder"),
        ("diagram --journal no/rows", "--journal: no/rows: there is no folder no"),
        ("diagram --journal .", "--journal: .: this is the name of a folder"),
        ("toss --out a.csv --out b.csv --out a.csv", "a.csv: it is asked for twice"),
        ("toss --out a.csv --out ./a.csv", "./a.csv: it is asked for twice, as a.csv before"),
        ("toss --out a.csv/", "a.csv/: this is the name of a folder"),
        ("toss --out a.csv/.", "a.csv/.: this is the name of a folder"),
        (
            "toss --out a.toml",
            "a.toml: a result is .csv, .json, .png or .svg; .toml is the file of --template",
        ),
        ("toss --template --out a.csv", "--template writes TOML"),
        ("motor sweep --template --out a.json", "--template writes TOML"),
        ("verdicts --template --out a.toml --out b.toml", "with one --out FILE.toml"),
        ("orbits --template --out no/a.toml", "there is no folder no"),
        ("doublings -G 0.5", "unexpected argument '-G'"),
        ("doublings --axial-forcing 0.5", "unexpected argument '--axial-forcing'"),
        (
            "toss --many --periods 1073741825 --transient 1",
            "periods = 1073741825 is outside its legal range [0, 1073741824]",
        ),
        ("toss --many --periods 18446744073709551615", "periods"),
        ("toss --many --periods 18446744073709551616", "--periods"),
        ("diagram -G 0.3:0.30000000000000004:1000", "nearer than numbers can be"),
        ("verdicts -r 0.5:0.5000000000000002:9", "nearer than numbers can be"),
        ("motor curve --loads 0:1e-320:100000", "nearer than numbers can be"),
        (
            "verdicts -G 0:3:1000000 -r 0:0.9:1000000",
            "no room for 1000000000000 cells of a map of verdicts: at most 2147483648",
        ),
        (
            "verdicts -G 0:3:10000 -r 0:0.9:10000 --details --chunk 1/100 --out a.json",
            "no room for 100000000 verdicts with their evidence: at most 16777216",
        ),
        (
            "diagram -G 0:3:1000000 --recorded 1000000",
            "no room for 2000000000000 impacts of a diagram: at most 2147483648",
        ),
        ("verdicts --impacts 1", "impacts"),
        ("basins --cells 0", "cells"),
        ("basins -G 0.1:0.2:3", "takes a single number"),
        ("basins --phase 1:0", "reversed"),
        ("basins --phase 0.5:0.5", "axis"),
        ("basins --phase 0.5:0.5000000000000002", "--phase: 300 cells from 0.5 to 0.5000000000000002"),
        ("basins --speed 1:1.0000000000000002 --cells 9", "are nearer than numbers can be"),
        ("orbits --impacts 0", "impacts"),
        ("doublings --count 99", "count"),
        ("doublings -r 0", "restitution"),
        ("design --friction 0.7:0.5", "reversed"),
        ("design --stroke -1", "stroke = -1 is"),
        ("design --highest-flight -1", "highest_flight = -1 is"),
        ("basins --phase -1:x", "\"x\" is no number"),
        ("fit a.csv --parameter mass=0:1", "cannot be fitted"),
        ("fit a.csv --parameter friction=0.1:0.4", "--motor FILE"),
        ("merge", "FILE"),
        ("man toss many", "no command"),
        ("toss --threads 0", "--threads"),
    ] {
        let text = folder.refused(line, 2);
        assert!(text.contains(told), "{line}: {text}");
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

/// A value that begins with a minus is a value and no option: what is said is about the number.
#[test]
fn negative_values_are_values() {
    let folder = Folder::new();
    folder.write("a.csv", "time_s,speed_rad_s\n0.1,1\n0.2,2\n0.3,3\n0.4,4\n");
    for line in [
        "toss --many --transient -1",
        "toss --many --examined -1",
        "toss --many --periods -1",
        "toss --samples -1",
        "toss --threads -1",
        "toss --set disk.friction=-1",
        "motor report --set friction=-1",
        "motor transient --members -1",
        "motor transient --duration -1",
        "motor transient --duration -1e-3",
        "motor transient --intervals -1",
        "motor transient --perturbation -1",
        "motor transient --seed -1",
        "motor curve --relative-error -1",
        "motor curve --relative-error -1e-3",
        "motor curve --perturbation -1e-3",
        "verdicts --tolerance -1e-9",
        "design --highest-flight -1e-1",
        "motor curve --members -1",
        "motor curve --most-impacts -1",
        "motor curve --perturbation -1",
        "motor curve --seed -1",
        "motor stall --relative-error -1",
        "motor phase-lag --relative-error -1",
        "motor sweep --over friction=-1:1:3",
        "orbits -G -1",
        "orbits -r -1",
        "orbits --impacts -1",
        "orbits --platform-periods -1",
        "orbits --starts -1",
        "diagram -G -1:1:3",
        "diagram --axial-forcing -1",
        "diagram -r -0.5",
        "diagram --restitution -0.5",
        "diagram --transient -1",
        "diagram --recorded -1",
        "diagram --start 0.1,-1",
        "diagram --start -0.1,-1",
        "diagram --chunk -1/3 --out b.json",
        "verdicts --start -0.1,-1",
        "verdicts --transient -1",
        "verdicts --impacts -1",
        "verdicts --longest-period -1",
        "verdicts --tolerance -1",
        "basins --cells -1",
        "basins --impacts -1",
        "basins --starts -1",
        "basins --speed -1:5 --starts 1",
        "doublings --count -1",
        "doublings -n -1",
        "doublings -r -1",
        "fit a.csv --resamples -1",
        "fit a.csv --preset paper-70-khz --parameter friction=0.1:0.4 --evaluations -1",
        "fit a.csv --seed -1",
        "fit a.csv --preset paper-70-khz --parameter friction=-1:0.4",
        "design --stroke -1",
        "design --friction -1:0.5",
        "design --angular-frequency -1:5",
        "design --highest-flight -1",
        "design --samples -1",
    ] {
        let text = folder.refused(line, 2);
        assert!(text.contains("-1") || text.contains("-0."), "{line}: {text}");
        assert!(
            !text.contains("unexpected argument") && !text.contains("a value is required"),
            "{line}: {text}"
        );
    }
    // These are legal.
    for line in [
        "verdicts -G 0.4 --start -0.1,1 --impacts 64",
        "diagram -G 0.4 --start -0.1,1 --transient 0 --recorded 1",
        "motor curve --loads -1e-6 --relative-error 0.5 --members 4 --no-spread",
        "motor sweep --over phase_lag=-1:-0.5:2 --relative-error 0.5 --members 4",
        "basins --cells 2 --starts 1 --phase -0.5:0.5",
        "design --phase-lag -0.5:-0.25",
        "toss --set platform.phase_lag=-1",
    ] {
        folder.done(line);
    }
}

#[test]
fn a_computation_that_fails_is_no_bad_input() {
    let folder = Folder::new();
    let text = folder.refused("toss --set platform.amplitude=0.001", 1);
    assert!(text.contains("never leaves the platform"), "{text}");
    let text = folder.refused("motor stall --set peak_angular_speed=0 --most-impacts 1000", 1);
    assert!(text.contains("does not turn"), "{text}");
    folder.write("short.csv", "time_s,speed_rad_s\n0.1,1\n0.2,2\n0.3,3\n0.4,4\n");
    let text = folder.refused("fit short.csv", 1);
    assert!(text.contains("the curve is not fitted"), "{text}");
}
