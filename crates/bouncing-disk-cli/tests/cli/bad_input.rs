//! Bad input is refused with status 2 and a text that says what is wrong, where, and what would be right.

use crate::common::{Folder, no_part};

#[test]
fn files_of_parameters_that_cannot_be_read() {
    let folder = Folder::new();
    std::fs::create_dir(folder.join("folder.toml")).unwrap();
    std::fs::write(folder.join("bytes.toml"), b"a = \xff").unwrap();
    let deep = format!("{{\"disk\":{}1{}", "{\"a\":".repeat(100_000), "}".repeat(100_001));
    let keys: Vec<String> = (0..2_000).map(|key| format!("\"{key}\":1")).collect();
    let (toss, motor) = (folder.done("toss --template"), folder.done("motor report --template"));
    for (name, text) in [
        ("empty.json", ""),
        ("a.txt", ""),
        ("deep.json", &deep),
        ("wide.json", &format!("{{{}}}", keys.join(","))),
        ("toss.toml", &toss),
        ("negative.toml", &toss.replace("friction = 0.6", "friction = -1")),
        ("motor.toml", &motor),
        ("motor.json", "{\"mass\": 1e-3,\n\"friction\": 0.1}"),
        ("misspelt.json", "{\"amplitud\": 1e-8}"),
    ] {
        folder.write(name, text);
    }
    let lines = [
        ("toss deep.json", "error: deep.json: line 1"),
        ("toss wide.json", "error: wide.json: line 1: the key \"0\" is unknown"),
        ("toss missing.toml", "missing.toml cannot be read"),
        ("toss folder.toml", "not a regular file"),
        ("toss bytes.toml", "not UTF-8 text"),
        ("toss empty.json", "empty.json: line 1: "),
        ("toss a.txt", "must end in .json or .toml"),
        ("toss a", "must end in .json or .toml"),
        ("motor report missing.json", "missing.json cannot be read"),
        ("motor report empty.json", "empty.json: line 1"),
        ("motor report a.txt", "must end in .json or .toml"),
        // Whichever command it is.
        ("fit missing.csv", "error: missing.csv cannot be read: No such file"),
        (
            "fit missing.csv --preset paper-70-khz --parameter friction=0.1:0.3",
            "error: missing.csv cannot be read: ",
        ),
        ("fit folder.toml", "error: folder.toml cannot be read: it is a folder, not a regular file"),
        ("merge missing.json", "error: missing.json cannot be read: No such file"),
        ("merge folder.toml", "error: folder.toml cannot be read: it is not a regular file"),
        ("merge empty.json", &no_part("empty.json")),
        ("toss negative.toml", "error: negative.toml: friction = -1 is outside its legal range"),
        ("toss toss.toml --set disk.restitution=1", "toss.toml with --set: restitution = 1 is outside"),
        (
            "motor report misspelt.json",
            "misspelt.json: line 1: the key \"amplitud\" is unknown; did you mean \"amplitude\"?",
        ),
        ("motor report motor.toml --set friction=-1", "motor.toml with --set: friction = -1 is outside"),
        // A file of the other kind.
        ("toss motor.toml", "the key \"amplitude\" is unknown; the known ones are platform, disk, drive"),
        ("toss motor.json", "the key \"mass\" is unknown; the known ones are platform, disk, drive"),
        ("motor report toss.toml", "the key \"disk\" is unknown"),
    ];
    folder.all_refused(2, &lines);
}

/// A drive is legal or refused by name, and never ignored.
#[test]
fn drives() {
    let folder = Folder::new();
    for command in ["toss", "motor report"] {
        let template = folder.done(&format!("{command} --template"));
        let file = |name: &str, drive: &str| {
            folder.write(&format!("{name}.toml"), &format!("{template}\n[drive]\n{drive}\n"));
        };
        file("triangle", "height = 'triangle'");
        file("key", "hight = 'triangle'");
        file("shape", "height = 'triangel'");
        file("jump", "height = { pieces = [[1, [0, 0.5, 0, 0]]] }");
        file("nan", "height = { fourier = [[1, 0], [nan, 0]] }");
        file("none", "angle = { pieces = [] }");
        file("few", "height = { sampled = [0, 1] }");
        file("segments", "segments = [{ periods = 2.25 }]");
        file("then", "then = 'rest'");
        file("start", "height = 'triangle'\nstart_phase = 1.0");
        file("infinite", "start_phase = inf");
        let sine_only = "this analysis holds only for the sine of Eq. (1)";
        let lines =
            if command == "toss" { &["toss --template"][..] } else { &["motor report", "motor traps", ""] };
        let (template, sine) = lines.split_last().unwrap();
        for line in sine {
            folder.all_refused(2, &[(&format!("{line} triangle.toml"), sine_only)]);
        }
        if command == "toss" {
            let copy = "--template writes no table [drive]";
            folder.all_refused(2, &[(&format!("{template} triangle.toml"), copy)]);
            for command in ["diagram", "verdicts"] {
                let line = format!("{command} triangle.toml --start period-1");
                folder.all_refused(2, &[(&line, "give rest, rise or")]);
            }
            folder
                .all_refused(2, &[("orbits start.toml", "start_phase is the phase at which a toss starts")]);
        }
        for (name, told) in [
            ("key", "\"hight\" is unknown; did you mean \"height\"?"),
            ("shape", "\"triangel\" is not a shape; write \"sine\", \"triangle\""),
            ("jump", "jump.toml: the height jumps by -0.5 amplitudes where piece 0 begins"),
            ("nan", "nan.toml: the height: the harmonic 1 of 2"),
            ("none", "none.toml: sum of the durations of the pieces = 0"),
            (
                "segments",
                "drive.segments is not a key: a drive is one motion that repeats. Give a start-up or a burst",
            ),
            ("then", "drive.then is not a key: "),
            ("infinite", "infinite.toml: start_phase = inf is not legal"),
            ("few", "few.toml: the height: number of samples = 2"),
        ] {
            folder.all_refused(2, &[(&format!("{command} {name}.toml"), told)]);
        }
    }
}

/// A contact is legal or refused by name, and never ignored.
#[test]
fn contacts() {
    let folder = Folder::new();
    for (command, soft, takes_none) in [
        ("toss", "0.02", &["toss --many", "verdicts", "doublings", "diagram", "orbits", "basins"][..]),
        ("motor report", "1e-5", &["motor traps"][..]),
    ] {
        let template = folder.done(&format!("{command} --template"));
        let file = |name: &str, contact: &str| {
            folder.write(&format!("{name}.toml"), &format!("{template}\n[contact]\n{contact}\n"));
        };
        let time = format!("time = {soft}");
        file("soft", &time);
        for line in takes_none {
            let told = "holds only for rigid impacts, but the table [contact] has a time";
            folder.all_refused(2, &[(&format!("{line} soft.toml"), told)]);
        }
        let restitution = if command == "toss" { "disk.restitution=0" } else { "restitution=0" };
        let line = format!("{command} soft.toml --set {restitution}");
        folder.all_refused(2, &[(&line, "soft.toml with --set: restitution of a compliant contact = 0 is")]);
        for (name, contact, told) in [
            ("zero", "time = 0", "zero.toml: contact.time = 0 is outside"),
            ("negative", "time = -1e-5", "negative.toml: contact.time = -1e-5 is outside"),
            ("nan", "time = nan", "nan.toml: contact.time = NaN is outside"),
            ("long", "time = 1e6", "long.toml: contact time = "),
            ("both", &format!("{time}\nmaterials = ['steel', 'steel']"), "both.toml: both contact.time and"),
            ("law", "law = 'damper'", "law.toml: contact.time is not given"),
            ("cheese", "materials = ['cheese', 'steel']", "cheese.toml: "),
            ("laws", &format!("{time}\nlaw = 'dampr'"), "\"dampr\" is unknown; did you mean \"damper\"?"),
            ("empty", "", "empty.toml: neither contact.time nor contact.materials is given"),
        ] {
            file(name, contact);
            folder.all_refused(2, &[(&format!("{command} {name}.toml"), told)]);
        }
        file("triangle", &format!("{time}\n[drive]\nheight = 'triangle'"));
        let line = if command == "toss" { "toss triangle.toml" } else { "motor curve triangle.toml" };
        folder.all_refused(
            2,
            &[(line, "a sine or a sum of harmonics (fourier), which a compliant contact needs")],
        );
    }
    let lines = [
        ("motor curve --set contact.time=0", "--set: contact.time = 0 is outside"),
        ("toss --set contact.time=-1", "--set: contact.time = -1 is outside"),
        ("motor curve --set contact_time=1e-5", "did you mean \"contact.time\"?"),
        ("motor sweep --over contact.time=0:1e-5:2", "contact.time = 0 is outside"),
    ];
    folder.all_refused(2, &lines);
}

/// A stator that yields is computed or refused by name, and never ignored.
#[test]
fn stators() {
    let folder = Folder::new();
    for (lines, computed, mass) in [
        (
            &["toss", "toss --many", "verdicts", "doublings", "diagram", "orbits", "basins"][..],
            &[][..],
            "0.5",
        ),
        (
            &["motor traps"],
            &[
                "motor report",
                "motor curve",
                "motor stall",
                "motor transient",
                "motor sweep --over friction=0.1:0.2:2",
            ],
            "0.01",
        ),
    ] {
        let template = folder.done(&format!("{} --template", lines[0]));
        let file = |name: &str, table: &str| {
            folder.write(&format!("{name}.toml"), &format!("{template}\n[stator]\n{table}\n"));
        };
        file("yielding", &format!("mass = {mass}\nquality = 300"));
        file("driven", &format!("mass = {mass}\nquality = 300\nforce = 1"));
        file("light", "mass = -1\nquality = 300");
        for line in lines.iter().chain(computed) {
            for (name, told) in [
                ("yielding", "the table [stator] makes the stator compliant"),
                ("driven", "both amplitude and stator.force are given"),
                ("light", "stator.mass = -1 is outside"),
            ] {
                if name != "yielding" || lines.contains(line) {
                    folder.all_refused(2, &[(&format!("{line} {name}.toml"), told)]);
                }
            }
        }
    }
    let load = folder.done("motor report --template") + "\n[load]\nspeeds = [0]\ntorques = [1e-6]\n";
    folder.write("load.toml", &load);
    folder.write("times.toml", &format!("{load}times = [1]\nfactors = [0]\n"));
    folder.done("motor transient load.toml --members 1 --duration 0.01 --intervals 3");
    let reports = ["motor report load.toml", "motor report times.toml"].map(|line| folder.done(line));
    assert!(
        reports
            .iter()
            .all(|report| report.ends_with("the table [load] affects only the warning of an overload\n")),
        "{reports:?}"
    );
    for (name, table, told) in [
        ("switched", "speeds = [0]\ntorques = [0]\noff = 1", "need a table [stator]"),
        ("short", "speeds = [0, 1]\ntorques = [1e-6]", "they need the same length"),
    ] {
        let sheet = folder.done("motor report --template") + &format!("\n[load]\n{table}\n");
        folder.write(&format!("{name}.toml"), &sheet);
        folder.all_refused(2, &[(&format!("motor transient {name}.toml"), told)]);
    }
    let stator = "motor report --set stator.mass=0.01 --set stator.quality=300";
    let loose = |command: &str| stator.replace("report", command) + " --relative-error 0.5 --most-impacts 1";
    assert!(folder.done(&loose("curve")).contains("stator amplitude (m)"));
    let warned = |line: &str, told: &str| {
        let text = crate::common::errors(&folder.command(line).output().unwrap());
        assert!(text.contains(told), "{line}: {text}");
    };
    warned(&loose("curve"), "their duration is unknown");
    warned(&loose("curve"), "the stator does not lift a rotor at rest: the preload is 0.322");
    let report = folder.done(&stator.replace("report", "report --set amplitude=1e-7"));
    assert!(report.contains("lift off preload = 0.6448") && !report.contains("does not lift"), "{report}");
    let file = folder.done(&format!("{stator} --template"));
    folder.write("again.toml", &file);
    assert_eq!(folder.done("motor report again.toml --template"), file);
    let twist = format!("{file}\n").replace("kind = \"axial\"", "kind = \"axial_twist\"");
    folder.write("twist.toml", &twist);
    folder.write("drive.toml", &(file + "[drive]\nheight = \"triangle\"\n"));
    let lines = [
        (
            "motor report twist.toml --set friction=30",
            "friction = 30 is not legal: it must be below the friction that jams",
        ),
        (
            "motor curve twist.toml --set friction=30",
            "friction = 30 is not legal: it must be below the friction that jams",
        ),
        (
            "motor best twist.toml --over phase_lag",
            "both a stator of kind axial_twist and a search for phase_lag",
        ),
        ("motor transient drive.toml", "both drive and stator are given"),
        ("motor report --set stator.mass=0.01 --set stator.quality=0.4", "stator.quality = 0.4 is outside"),
        ("motor curve --set stator.mass=0.01", "stator.quality is not given"),
        (
            "motor stall --set friction=0",
            "without friction the largest torque is 0, so there is no stall torque",
        ),
        (
            "motor best times.toml --over phase_lag",
            "a steady operation has no time axis, but load.times, load.on or load.off is given",
        ),
        ("motor curve times.toml", "a steady operation has no time axis"),
        ("motor stall times.toml", "a steady operation has no time axis"),
        ("motor sweep times.toml --over friction=0.1:0.2:2", "a steady operation has no time axis"),
        (
            "motor sweep --over friction=0.1:0.2:2 --up-and-down",
            "the table stator of a continued sweep is not given",
        ),
        ("motor curve load.toml --template", "--template writes no table [load]"),
    ];
    folder.all_refused(2, &lines);
    let none = [("motor best --set friction=0 --over phase_lag", "speed is not certain to be positive")];
    folder.all_refused(1, &none);
}

#[test]
fn words_of_the_line_that_are_not_legal() {
    let folder = Folder::new();
    let lines = [
        ("", "Usage"),
        ("tos", "tip: a similar subcommand exists: 'toss'"),
        ("toss --out a.txt", ".csv, .json, .png or .svg"),
        ("toss --out .csv", ".csv, .json, .png or .svg"),
        ("toss --out a.csv.gz", ".csv, .json, .png or .svg"),
        ("toss --out a.csv/..", ".csv, .json, .png or .svg"),
        ("toss --preset pizza", "pizza-toss"),
        ("toss --preset motor a.toml", "cannot be used with"),
        ("toss --set friction=0.2", "did you mean \"disk.friction\"?"),
        ("toss --set disk.friction", "KEY=VALUE"),
        ("toss --set disk.friction=x", "\"x\" is not a number"),
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
        ("diagram -G nan", "not finite"),
        ("diagram -G -1", "axial_forcing = -1 is"),
        ("diagram -r 1", "restitution = 1 is"),
        ("diagram -r 0.1:0.2:3", "needs a single number"),
        ("diagram --start up", "rest, rise, period-1 or PHASE,SPEED"),
        ("diagram --chunk 0/3 --out a.json", "I/N"),
        ("diagram --chunk 1/3", "--chunk needs exactly one --out FILE.json"),
        ("diagram --chunk 1/3 --out a.csv", "--chunk needs exactly one --out FILE.json"),
        ("diagram --journal a.json --out a.json", "a.json: it cannot be both the journal and the result"),
        ("diagram --journal ./a.json --out a.json", "a.json: it cannot be both the journal and the result"),
        ("diagram --journal rows/", "--journal: rows/: this names a folder"),
        ("diagram --journal no/rows", "--journal: no/rows: the folder no does not exist"),
        ("diagram --journal .", "--journal: .: this names a folder"),
        ("toss --out a.csv --out b.csv --out a.csv", "a.csv: it is requested twice"),
        ("toss --out a.csv --out ./a.csv", "./a.csv: it is requested twice, first as a.csv"),
        ("toss --out a.csv/", "a.csv/: this names a folder"),
        ("toss --out a.csv/.", "a.csv/.: this names a folder"),
        ("toss --out a.toml", "a.toml: a result ends in .csv, .json, .png or .svg; .toml needs --template"),
        ("toss --template --out a.csv", "--template writes TOML"),
        ("motor sweep --template --out a.json", "--template writes TOML"),
        ("verdicts --template --out a.toml --out b.toml", "give one --out FILE.toml"),
        ("orbits --template --out no/a.toml", "the folder no does not exist"),
        ("doublings -G 0.5", "unexpected argument '-G'"),
        ("doublings --axial-forcing 0.5", "unexpected argument '--axial-forcing'"),
        (
            "toss --many --periods 1073741825 --transient 1",
            "periods = 1073741825 is outside its legal range [0, 1073741824]",
        ),
        ("toss --many --periods 18446744073709551615", "periods"),
        ("toss --many --periods 18446744073709551616", "--periods"),
        ("diagram -G 0.3:0.30000000000000004:1000", "not distinct numbers"),
        (
            "verdicts -G 0:3:1000000 -r 0:0.9:1000000",
            "1000000000000 cells of a map of verdicts are too many: at most 2147483648",
        ),
        (
            "verdicts -G 0:3:10000 -r 0:0.9:10000 --details --chunk 1/100 --out a.json",
            "100000000 verdicts with their evidence are too many: at most 16777216",
        ),
        (
            "diagram -G 0:3:1000000 --recorded 1000000",
            "2000000000000 impacts of a diagram are too many: at most 2147483648",
        ),
        ("verdicts --impacts 1", "impacts"),
        ("basins --cells 0", "cells"),
        ("basins -G 0.1:0.2:3", "needs a single number"),
        ("basins --phase 1:0", "reversed"),
        ("basins --phase 0.5:0.5", "axis"),
        ("basins --phase 0.5:0.5000000000000002", "--phase-range: 300 cells from 0.5 to 0.5000000000000002"),
        ("basins --speed 1:1.0000000000000002 --cells 9", "have no distinct centres"),
        ("orbits --impacts 0", "impacts"),
        ("doublings --count 99", "count"),
        ("doublings --count 0", "count"),
        ("doublings -r 0", "restitution"),
        (
            "motor curve --set friction=0",
            "without friction the largest torque is 0, so there is no torque-speed curve",
        ),
        ("basins --phase -1:x", "\"x\" is not a number"),
        ("fit a.csv --parameter mass=0:1", "cannot be fitted"),
        ("fit a.csv --parameter friction=0.1:0.4", "--motor FILE"),
        ("merge", "FILE"),
        ("man toss many", "no command"),
        ("toss --threads 0", "--threads"),
    ];
    folder.all_refused(2, &lines);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

/// A value that begins with a minus is a value and no option: the message is about the number. That every
/// option of a number takes such values is a test of the command line's description.
#[test]
fn negative_values_are_values() {
    let folder = Folder::new();
    for line in [
        "toss --samples -1",
        "toss --set disk.friction=-1",
        "motor transient --duration -1e-3",
        "motor sweep --over friction=-1:1:3",
        "diagram -G -1:1:3",
        "diagram --start -0.1,-1",
        "diagram --chunk -1/3 --out b.json",
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
        "diagram -G 0.4 --start -0.1,1 --transient 0 --recorded 1",
        "motor curve --loads -1e-6 --relative-error 0.5 --members 4 --no-spread",
        "basins --cells 2 --starts 1 --phase -0.5:0.5",
        "toss --set platform.phase_lag=-1",
    ] {
        folder.done(line);
    }
}

#[test]
fn a_computation_that_fails_is_no_bad_input() {
    let folder = Folder::new();
    folder.write("short.csv", "time_s,speed_rad_s\n0.1,1\n0.2,2\n0.3,3\n0.4,4\n");
    let lines = [
        ("toss --set platform.amplitude=0.001", "never leaves the platform"),
        ("motor stall --set peak_angular_speed=0 --most-impacts 1000", "does not turn"),
        ("fit short.csv", "the curve is not fitted"),
    ];
    folder.all_refused(1, &lines);
}
