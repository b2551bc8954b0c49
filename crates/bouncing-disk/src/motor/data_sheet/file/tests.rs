//! Texts that people and programs write, right and wrong.

use super::*;

/// Every fault that both formats have, with its line.
fn check_common(read: fn(&str) -> Result<Motor, MotorFileError>, write: fn(&[(&str, &str)]) -> String) {
    let lines = [
        ("drive_frequency", "40e3"),
        ("amplitude", "5e-7"),
        ("peak_angular_speed", "12"),
        ("mass", "0.02"),
        ("contact_radius", "1.25e-3"),
        ("gyration_radius", "6.3e-3"),
        ("preload_force", "5"),
        ("friction", "0.1"),
        ("restitution", "0.5"),
    ];
    let motor = read(&write(&lines)).expect("legal");
    assert!((motor.preload_acceleration() - 250.0).abs() < 1e-12);
    assert_eq!((motor.load_torque(), motor.parameters().phase_lag), (0.0, 0.0));
    for text in [
        format!("\u{feff}{}", write(&lines)),
        write(&lines).replace('\n', "\r\n"),
        format!("\n\n{}\n", write(&lines)),
    ] {
        assert_eq!(read(&text), Ok(motor), "{text:?}");
    }

    let replaced = |key: &str, with: (&'static str, &'static str)| {
        let changed: Vec<_> = lines.iter().map(|line| if line.0 == key { with } else { *line }).collect();
        read(&write(&changed)).expect_err(with.0)
    };
    let first = write(&lines).lines().position(|line| line.contains("drive_frequency")).expect("there") + 1;
    // Its fifth key.
    assert_eq!(
        replaced("contact_radius", ("contact_radus", "1")),
        MotorFileError::UnknownKey {
            key: "contact_radus".to_owned(),
            line: first + 4,
            nearest: Some("contact_radius")
        }
    );
    let text = replaced("friction", ("colour", "1")).to_string();
    assert!(text.contains("\"colour\"") && text.contains("drive_frequency") && text.contains("load_torque"));
    for (value, found) in [("\"0.1\"", "a text"), ("true", "true or false"), ("[0.1]", "a list")] {
        let error = replaced("friction", ("friction", value));
        assert_eq!(error, MotorFileError::NotANumber { key: "friction", line: first + 7, found }, "{value}");
        assert!(error.to_string().contains(&format!("line {}: \"friction\"", first + 7)), "{error}");
    }
    for value in ["-1", "-1e-320"] {
        let error = replaced("mass", ("mass", value));
        assert!(
            matches!(error, MotorFileError::Illegal { line: Some(line), error: Error::OutOfRange { field: "mass", .. } }
                if line == first + 3),
            "{error}"
        );
    }
    assert!(replaced("mass", ("mass", "0")).to_string().contains("mass = 0"));
    // A combination, P, is told at the amplitude; a key in place of another makes two faults, one of which is
    // told.
    let error = replaced("amplitude", ("amplitude", "1e3"));
    assert!(
        matches!(error, MotorFileError::Illegal { line: Some(line), .. } if line == first + 1),
        "{error}"
    );
    let error = replaced("gyration_radius", ("preload_acceleration", "250"));
    let both = Error::BothGiven { one: "preload_force", other: "preload_acceleration" };
    let neither = Error::NeitherGiven { one: "gyration_radius", other: "rotor_radius" };
    assert!(
        matches!(error, MotorFileError::Illegal { error, .. } if error == both || error == neither),
        "{error}"
    );
    for index in 0..lines.len() {
        let mut less = lines.to_vec();
        let (key, _) = less.remove(index);
        let error = read(&write(&less)).expect_err(key);
        assert!(error.to_string().contains(key), "{key}: {error}");
        assert!(matches!(error, MotorFileError::Illegal { line: None, .. }), "{key}: {error}");
    }
    let mut more = lines.to_vec();
    more.push(("preload_acceleration", "250"));
    assert_eq!(
        read(&write(&more)),
        Err(MotorFileError::Illegal { line: Some(first + lines.len()), error: both })
    );
    // A key that is as long as it likes, and would colour a terminal.
    let error = replaced("friction", ("\"\\u001b[31m\"", "1")).to_string();
    assert!(!error.contains('\u{1b}'), "{error:?}");
}

/// What takes the place of a value is all that is looked at: of one that is illegal, missing, or one of two.
fn check_changes(
    read: impl Fn(&str, &[(MotorField, f64)]) -> Result<Motor, MotorFileError>,
    write: fn(&[(&str, &str)]) -> String,
) {
    let motor = Motor::paper_70_khz();
    let sheet = motor.parameters();
    let values: Vec<(&str, String)> =
        given(&sheet).map(|(name, value, _)| (name, format!("{value:?}"))).collect();
    let lines = |friction: &'static str| -> Vec<(&str, &str)> {
        let own = |(name, value)| if name == "friction" { (name, friction) } else { (name, value) };
        values.iter().map(|(name, value)| own((*name, value.as_str()))).collect()
    };
    let change = [(MotorField::Friction, sheet.friction)];
    assert_eq!(read(&write(&lines("-1")), &change), Ok(motor));
    let missing: Vec<_> = lines("0").into_iter().filter(|(name, _)| *name != "friction").collect();
    assert_eq!(read(&write(&missing), &change), Ok(motor));
    // Of the several changes of a field the last one counts.
    let twice = [(MotorField::Friction, -7.0), change[0]];
    assert_eq!(read(&write(&lines("0.5")), &twice), Ok(motor));
    // Two alternatives, of which one is set again.
    let force = format!("{:?}", motor.preload_force());
    let mut both = lines("0.3");
    both.push(("preload_force", &force));
    assert!(read(&write(&both), &[]).is_err());
    let set = [(MotorField::PreloadForce, 0.4), change[0]];
    let expected = motor.with(|sheet| MotorField::PreloadForce.set(sheet, 0.4));
    assert_eq!(read(&write(&both), &set).ok(), expected.ok());
    // An illegal change has no line, and what else is illegal keeps its own.
    let error = read(&write(&lines("0.3")), &[(MotorField::Friction, -1.0)]).expect_err("negative");
    assert!(
        matches!(
            error,
            MotorFileError::Illegal { line: None, error: Error::OutOfRange { field: "friction", .. } }
        ),
        "{error}"
    );
    let error = read(&write(&lines("-1")), &[(MotorField::Amplitude, 1e-8)]).expect_err("negative");
    assert!(matches!(error, MotorFileError::Illegal { line: Some(_), .. }), "{error}");
    // What is no sheet at all stays none.
    assert!(read("}", &change).is_err());
}

#[cfg(feature = "json")]
mod json {
    use super::*;

    #[test]
    fn changes_come_before_the_checks() {
        check_changes(Motor::from_json_with, write);
    }

    fn write(lines: &[(&str, &str)]) -> String {
        let lines: Vec<_> =
            lines
                .iter()
                .map(|(key, value)| {
                    if key.starts_with('"') {
                        format!("{key}: {value}")
                    } else {
                        format!("\"{key}\": {value}")
                    }
                })
                .collect();
        format!("{{\n{}\n}}", lines.join(",\n"))
    }

    #[test]
    fn faults_are_told_with_key_and_line() {
        check_common(Motor::from_json, write);
    }

    #[test]
    fn what_is_there_twice_is_told_with_both_lines() {
        let text = Motor::paper_70_khz().to_json().replace("\"phase_lag\"", "\"friction\"");
        let error = Motor::from_json(&text).expect_err("twice");
        let MotorFileError::Repeated { key: "friction", line, first_line } = error else { panic!("{error}") };
        let lines: Vec<_> = text.lines().collect();
        assert!(first_line < line && [first_line, line].iter().all(|at| lines[at - 1].contains("friction")));
    }

    #[test]
    fn what_is_no_object_is_refused_with_its_place() {
        for (text, expected) in
            [("", (1, 1)), ("{\n\"mass\": }", (2, 9)), ("[1, 2]", (1, 1)), ("{} x", (1, 4))]
        {
            let error = Motor::from_json(text).expect_err(text);
            let MotorFileError::Syntax { format: "JSON", line, column, ref reason } = error else {
                panic!("{text}: {error}")
            };
            assert_eq!((line, column), expected, "{text}: {error}");
            assert!(!reason.contains("at line"), "{error}");
        }
        let deep = format!("{{\"mass\": {}1{}}}", "[".repeat(100_000), "]".repeat(100_000));
        assert!(Motor::from_json(&deep).is_err());
        for text in
            ["null", "1", "\"mass\"", "{\"mass\": 01}", "{\"mass\": NaN}", "{mass: 1}", "{\"mass\": 1,}"]
        {
            assert!(matches!(Motor::from_json(text), Err(MotorFileError::Syntax { .. })), "{text}");
        }
    }

    /// Numbers that no double holds, from both ends, and nothing in their place.
    #[test]
    fn numbers_beyond_a_double_and_null_are_judged() {
        let text = Motor::paper_70_khz().to_json();
        let with = |value: &str| Motor::from_json(&text.replace("\"load_torque\": 0.0", value));
        assert!(text.contains("\"load_torque\": 0.0"));
        let error = with("\"load_torque\": 1e999").expect_err("infinite").to_string();
        assert!(error.starts_with("line 12: load_torque = inf"), "{error}");
        assert_eq!(with("\"load_torque\": 1e-999"), Ok(Motor::paper_70_khz()));
        assert_eq!(with("\"load_torque\": null"), Ok(Motor::paper_70_khz()));
        assert_eq!(with("\"rotor_radius\": null"), Ok(Motor::paper_70_khz()));
        let error =
            Motor::from_json(&text.replace("\"friction\": 0.1", "\"friction\": null")).expect_err("needed");
        assert_eq!(
            error,
            MotorFileError::Illegal { line: None, error: Error::NotGiven { field: "friction" } }
        );
        // Escapes in a key are letters like others.
        let escaped = text.replace("\"friction\"", "\"\\u0066riction\"");
        assert_eq!(Motor::from_json(&escaped), Ok(Motor::paper_70_khz()));
        let long = text.replace("\"friction\"", &format!("\"{}\"", "friction".repeat(1_000)));
        assert!(Motor::from_json(&long).expect_err("unknown").to_string().len() < 600);
    }
}

#[cfg(feature = "toml")]
mod toml {
    use super::*;

    #[test]
    fn changes_come_before_the_checks() {
        check_changes(Motor::from_toml_with, write);
    }

    fn write(lines: &[(&str, &str)]) -> String {
        lines.iter().fold("# A motor.\n".to_owned(), |text, (key, value)| format!("{text}{key} = {value}\n"))
    }

    #[test]
    fn faults_are_told_with_key_and_line() {
        check_common(Motor::from_toml, write);
    }

    #[test]
    fn faults_of_the_format_have_a_place() {
        let text = Motor::paper_70_khz().to_toml();
        for (from, to, told) in [
            ("phase_lag", "friction", "friction"),
            ("friction = 0.1", "friction = 0,1", ","),
            ("friction = 0.1", "friction", "friction"),
            ("friction = 0.1", "friction = 0.1.2", "0.1.2"),
        ] {
            let changed = text.replace(from, to);
            let error = Motor::from_toml(&changed).expect_err(to);
            let MotorFileError::Syntax { format: "TOML", line, .. } = error else { panic!("{to}: {error}") };
            assert!(changed.lines().nth(line - 1).expect("there").contains("friction"), "{to}: {error}");
            assert!(error.to_string().contains(told), "{to}: {error}");
        }
        let error = Motor::from_toml("").expect_err("nothing");
        let missing = Error::NotGiven { field: "drive_frequency" };
        assert_eq!(error, MotorFileError::Illegal { line: None, error: missing });
    }

    #[test]
    fn numbers_are_read_in_every_form() {
        let text = Motor::paper_70_khz().to_toml();
        assert!(text.contains("drive_frequency = 70000.0 # Hz\n"), "{text}");
        for form in ["70_000", "70_000.0", "7e4", "+70000", "0x11170", "70e3"] {
            let changed = text.replace("70000.0", form);
            assert_eq!(Motor::from_toml(&changed), Ok(Motor::paper_70_khz()), "{form}");
        }
        for form in ["nan", "inf", "-inf", "1e999", "0", "-0x1"] {
            assert!(Motor::from_toml(&text.replace("70000.0", form)).is_err(), "{form}");
        }
        for (form, found) in
            [("2009-11-23", "a date or a time"), ("{ Hz = 7 }", "a table"), ("'70'", "a text")]
        {
            let error = Motor::from_toml(&text.replace("70000.0", form)).expect_err(form);
            assert_eq!(error, MotorFileError::NotANumber { key: "drive_frequency", line: 1, found });
        }
        let error = Motor::from_toml(&format!("{text}[motor]\n")).expect_err("a table").to_string();
        assert!(error.contains("\"motor\""), "{error}");
    }
}
