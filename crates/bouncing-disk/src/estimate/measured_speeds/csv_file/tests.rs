use std::{fs, io};

use super::*;
use crate::estimate::measured_speeds::error::HEADER;

fn read(text: impl AsRef<[u8]>) -> Result<MeasuredSpeeds, MeasuredSpeedsError> {
    MeasuredSpeeds::from_csv_reader("demo.csv", text.as_ref(), &CsvColumns::default())
}

fn fault(text: impl AsRef<[u8]>) -> String {
    read(text).expect_err("malformed").to_string()
}

fn fault_of(line: &str) -> String {
    fault(format!("time_s,speed_rad_s\n0,0\n{line}\n"))
}

const PLAIN: &str = "time_s,speed_rad_s\n0,0\n0.5,3.25\n1e0,-4e-1\n";

#[test]
fn plain_values_are_read_in_any_dress() {
    let expected = read(PLAIN).expect("well formed");
    let run = MeasuredRun { member: 0, times: vec![0.0, 0.5, 1.0], speeds: vec![0.0, 3.25, -0.4] };
    assert_eq!(expected.runs(), [run]);
    for text in [
        format!("\u{feff}{PLAIN}"),
        PLAIN.replace('\n', "\r\n"),
        format!("\u{feff}{}", PLAIN.replace('\n', "\r\n")),
        PLAIN.trim_end().to_owned(),
        format!("# of 3 May\n\n{}\n   \n# the end; really\n", PLAIN.replace('\n', "\n\n# remark\n")),
        "\"time_s\", \"speed_rad_s\" \n 0 ,\"0\"\n\"0.5\", \"3.25\"\n1e0,-0.4\n".to_owned(),
        "speed_rad_s,time_s\n0,0\n3.25,0.5\n-0.4,1\n".to_owned(),
        "time_s,member,speed_rad_s\n0,0,-0\n0.5,0,3.25\n1,0,-0.4\n".to_owned(),
    ] {
        assert_eq!(read(&text).unwrap_or_else(|error| panic!("{text:?}: {error}")), expected, "{text:?}");
    }
}

#[test]
fn runs_follow_each_other_or_alternate() {
    let follow = "member,time_s,speed_rad_s\n7,0,1\n7,1,2\n7,2,3\n2,0,4\n2,1,5\n2,2,6\n";
    let alternate = "member,time_s,speed_rad_s\n2,0,4\n7,0,1\n2,1,5\n7,1,2\n7,2,3\n2,2,6\n";
    let runs = read(follow).expect("well formed");
    assert_eq!(runs, read(alternate).expect("well formed"));
    assert_eq!(runs.runs().iter().map(|run| run.member).collect::<Vec<_>>(), [2, 7]);
    assert_eq!(runs.runs()[0].speeds, [4.0, 5.0, 6.0]);
}

/// Files as written by an oscilloscope, a tachometer and a spreadsheet with another locale: the units are in
/// the file or given.
#[test]
fn values_are_read_as_instruments_write_them() {
    let expected = read(PLAIN).expect("well formed");
    let (ms, rpm) = (Some(TimeUnit::Millisecond), Some(SpeedUnit::RevolutionPerMinute));
    for text in [
        "Run of 3 May, motor; 2\nOperator:,me\n% gain 3\n// end\nt (ms);speed [rad/s]\n0;0\n500;3,25\n1000;-0,4\n",
        "t\tspeed\tmember\n(ms)\t(rad/s)\t\n0\t0\t0\n500\t3.25\t0\n1000\t-0.4\t0\n",
        "time_ms,omega_rad/s,\n0,0,\n500,3.25,\n1000,-0.4,\n",
        "\u{feff}time_ms;speed_rad_s\r\nms;rad/s\r\n0;0,0\r\n500;3,25;\r\n1000;-0,4\r\n",
    ] {
        let own = read(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        assert_eq!(own.runs(), expected.runs(), "{text:?}");
        assert_eq!(own.file_units(), (TimeUnit::Millisecond, SpeedUnit::RadianPerSecond));
    }
    let of = |text: &str, columns: &CsvColumns| {
        MeasuredSpeeds::from_csv_reader("demo.csv", text.as_bytes(), columns)
            .map(|read| read.runs()[0].clone())
    };
    let named =
        CsvColumns { time: Some("CH1".into()), speed: Some("CH2".into()), time_unit: ms, speed_unit: rpm };
    let text = "CH1,CH2,CH3\n-500,0,on\n0,30,off\n500,60,off\n";
    let run = of(text, &named).expect("well formed");
    assert_eq!(run.times, [-0.5, 0.0, 0.5]);
    assert!((run.speeds[2] - std::f64::consts::TAU).abs() < 1e-15);
    let units = CsvColumns { time_unit: ms, speed_unit: rpm, ..CsvColumns::default() };
    assert_eq!(of(&PLAIN.replace("_s,", ","), &units).expect_err("rad_s is not rpm").to_string(), {
        "\"demo.csv\", line 1, field 2: the unit of the speed is \"rad_s\" here; legal units are rad/s, rpm, \
         rev/s, deg/s. State the same unit in the name of the column, in the row below it, or when you read the \
         file"
    });
    assert!(fault("t,n\n0,0\n1,1\n2,2\n").contains("the unit of the time is \"\" here"));
    assert!(fault("t (h),n (rpm)\n0,0\n1,1\n2,2\n").contains("the unit of the time is \"h\" here"));
    assert!(
        fault("t (s),n (rpm)\nms,rpm\n0,0\n1,1\n2,2\n")
            .contains("line 2, field 1: the unit of the time is \"ms\"")
    );
    // One decimal mark per file, and no thousands separators.
    let marks = |rows: &str| fault(format!("time_s;speed_rad_s\n{rows}"));
    assert!(marks("0,5;1.5\n1;2\n").contains("line 2, field 2: the decimal mark of the file is ambiguous"));
    assert!(marks("0;1.234,5\n").contains("line 2, field 2"));
    assert!(marks("0;1,234\n1;2,345\n2;3,456\n").contains("line 2, field 2: the decimal mark"));
    assert!(read("time_s;speed_rad_s\n0,000;1,234\n0,001;2,345\n0,002;3,456\n").is_ok());
    assert!(marks("0;1,234,567\n").contains("line 2, field 2"));
    assert!(marks("0,5,1\n").contains("the line has 1 fields"));
}

#[test]
fn a_wrong_header_is_named() {
    let legal = HEADER;
    assert_eq!(
        fault(""),
        format!("\"demo.csv\": the file is empty; its first line must name the columns: {legal}")
    );
    assert_eq!(fault("\u{feff}"), fault(""));
    assert_eq!(fault("\n# nothing\r\n\r\n"), fault(""));
    assert_eq!(
        fault("time_s,speeed\n0,0\n"),
        format!(
            "\"demo.csv\", line 1, field 2: the column \"speeed\" is unknown; legal columns are {legal}. Remove \
             the column, begin a remark with #, or name the columns of times and speeds when you read the file"
        )
    );
    assert_eq!(
        fault("# mine\ntime_s,member\n0,0\n"),
        "\"demo.csv\", line 2: the column \"speed_rad_s\" is missing; the header must have times and speeds"
    );
    assert!(fault("speed_rad_s\n0\n").contains("the column \"time_s\" is missing"));
    assert!(fault("time_s,speed_rad_s,time_s\n").contains("field 3: the column \"time_s\" occurs twice"));
    // Numbers without a header, whether or not the caller names the columns.
    let named = CsvColumns { time: Some("CH1".into()), speed: Some("CH2".into()), ..CsvColumns::default() };
    for columns in [CsvColumns::default(), named] {
        for text in ["0,1\n1,2\n", "# mine\n0\n", "0,5;1\n"] {
            let fault = MeasuredSpeeds::from_csv_reader("demo.csv", text.as_bytes(), &columns);
            let fault = fault.expect_err("no header").to_string();
            assert!(
                fault.contains(": the header line is missing: this line already contains numbers"),
                "{fault}"
            );
        }
    }
    // Control characters of a file are shown without effect.
    assert!(fault("time_s,\u{1b}[2J\n").contains("\"\\u{1b}[2J\""));
    assert!(fault(format!("time_s,{}\n", "x".repeat(5_000))).len() < 500);
}

#[test]
fn a_wrong_line_is_named_with_what_to_do() {
    assert_eq!(
        fault_of("0.1,fast"),
        "\"demo.csv\", line 3, field 2: \"fast\" is not legal in the column speed_rad_s; it must be a finite number"
    );
    for text in ["", "NaN", "inf", "-infinity", "1e999", "1e-400", "0x10", "1 2", "1.2.3", "−1"] {
        assert!(fault_of(&format!("0.1,{text}")).contains("line 3, field 2: "), "{text}");
        assert!(fault_of(&format!("{text},1")).contains("line 3, field 1: "), "{text}");
    }
    assert_eq!(
        fault_of("\"0,5\",1"),
        "\"demo.csv\", line 3, field 1: \"0,5\" in the column time_s has a decimal comma; write a decimal point"
    );
    assert_eq!(
        fault_of("0,5,1,25"),
        "\"demo.csv\", line 3: the line has 4 fields, but the header has 2; write numbers with a decimal point, or \
         separate the columns by semicolons"
    );
    assert!(fault_of("0.5").contains("the line has 1 fields, but the header has 2"));
    assert!(fault_of("0,5;1,25").contains("the line has 3 fields"));
    assert!(fault_of("0.5,\"1").contains("line 3, field 2: a quotation mark is not closed"));
    assert!(fault_of("0.5,\"1\n2\"").contains("line 3, field 2: a quotation mark is not closed"));
    for member in ["-1", "1.5", "4294967296", "", "a"] {
        let text = format!("time_s,speed_rad_s,member\n0,0,{member}\n");
        assert!(fault(text).contains("line 2, field 3: "), "{member}");
    }
}

#[test]
fn times_that_do_not_rise_are_named() {
    for (time, told) in [("0.25", "0.25"), ("0.5", "0.5"), ("0", "0.0")] {
        assert_eq!(
            fault(format!("time_s,speed_rad_s\n0,0\n\n0.5,1\n{time},2\n")),
            format!(
                "\"demo.csv\", line 5, field 1: time_s = {told} follows 0.5 in the run of member 0; sort the lines by time, \
                 remove repeated ones, or number the runs in a column member"
            )
        );
    }
    let runs = "member,time_s,speed_rad_s\n1,0,0\n2,5,0\n1,1,0\n2,5,0\n";
    assert!(fault(runs).contains("line 5, field 2: time_s = 5.0 follows 5.0 in the run of member 2"));
}

#[test]
fn too_little_and_other_encodings_are_refused() {
    assert!(
        fault("time_s,speed_rad_s\n")
            .contains("the run of member 0 has 0 lines of numbers, but 3 are needed")
    );
    assert!(fault("time_s,speed_rad_s\n0,0\n1,1\n").contains("has 2 lines"));
    assert!(
        fault("member,time_s,speed_rad_s\n1,0,0\n1,1,0\n1,2,0\n9,0,0\n").contains("member 9 has 1 lines")
    );
    assert!(fault(b"time_s,speed_rad_s\n0,\xb5\n").contains("line 2: byte 3 is not text in UTF-8"));
    assert!(fault(b"\xff\xfet\0i\0").contains("line 1: byte 1 is not text in UTF-8"));
}

#[test]
fn a_million_lines_are_read_and_a_huge_line_is_not() {
    let mut text = String::from("time_s,speed_rad_s\n");
    for i in 0..1_000_000 {
        text.push_str(&format!("{}.{:06},12.5\n", i / 1_000_000, i % 1_000_000));
    }
    let read_back = read(&text).expect("well formed");
    let run = &read_back.runs()[0];
    assert_eq!((run.times.len(), run.times[999_999], run.speeds[500_000]), (1_000_000, 0.999_999, 12.5));
    for sign in [",", "0", "\""] {
        let text = format!("time_s,speed_rad_s\n{}\n", sign.repeat(1 << 22));
        assert!(fault(text).contains("line 2: the line is longer than 65536 bytes"), "{sign}");
    }
    let endless = MeasuredSpeeds::from_csv_reader("endless", io::repeat(b'0'), &CsvColumns::default())
        .expect_err("never ends");
    assert!(matches!(endless, MeasuredSpeedsError::Unreadable { .. }), "{endless}");
    let text = "0,0\n".repeat(20 << 20);
    assert!(matches!(read(text), Err(MeasuredSpeedsError::Unreadable { .. })), "80 MiB");
}

#[test]
fn only_regular_files_are_read() {
    let folder = std::env::temp_dir().join(format!("bouncing-disk-speeds-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("writable");
    let file = folder.join("speeds.csv");
    fs::write(&file, PLAIN).expect("writable");
    assert_eq!(MeasuredSpeeds::from_csv(&file).expect("well formed"), read(PLAIN).expect("well formed"));
    fs::write(&file, "time_s\n").expect("writable");
    let told = MeasuredSpeeds::from_csv(&file).expect_err("malformed").to_string();
    assert!(told.contains("speeds.csv\", line 1"), "{told}");
    let reason = |path: &Path| match MeasuredSpeeds::from_csv(path) {
        Err(MeasuredSpeedsError::Unreadable { source, .. }) => source,
        other => panic!("{other:?}"),
    };
    assert_eq!(reason(&folder.join("none.csv")).kind(), io::ErrorKind::NotFound);
    assert_eq!(reason(&folder).to_string(), "it is a folder, not a regular file");
    #[cfg(unix)]
    {
        let told = reason(Path::new("/dev/zero")).to_string();
        assert_eq!(told, "it is a device, not a regular file");
        let socket = folder.join("socket");
        let _socket = std::os::unix::net::UnixListener::bind(&socket).expect("writable");
        assert_eq!(reason(&socket).to_string(), "it is a socket, not a regular file");
        // A named pipe would wait for a writer for ever; creating one needs an external program.
        let pipe = folder.join("pipe");
        if std::process::Command::new("mkfifo").arg(&pipe).status().is_ok_and(|status| status.success()) {
            assert_eq!(reason(&pipe).to_string(), "it is a named pipe, not a regular file");
        }
    }
    fs::remove_dir_all(folder).expect("removable");
}
