//! The numbers of the program are those of the library, to the last bit.

use std::f64::consts::{PI, TAU};

use crate::common::Folder;
use bouncing_disk::core::attractors::{
    AttractorSearch, Axis, BasinSettings, Grid, VerdictSettings, verdicts,
};
use bouncing_disk::core::orbits::{OrbitSearch, Stability, doubling_cascade};
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Phase, Unobserved, Vibration};
use bouncing_disk::driven::{self, DrivenStart, DrivenSystem};
use bouncing_disk::drives::driven_doubling_cascade;
use bouncing_disk::estimate::TransientEnsemble;
use bouncing_disk::motor::{
    MotorField, MotorSweep, OperatingSettings, SweepAxis, TransientMember, TransientSettings,
};
use bouncing_disk::parameters::{Contact, ContactLaw, DriveParameters, DrivenPlatform, Waveform};
use bouncing_disk::toss::{InitialSpin, MultiTossSettings, TOSS_START, single_toss};
use bouncing_disk::{Motor, System};
use serde::Serialize;
use serde_json::{Value, json};

/// The paper's motor with an amplitude of 1e-7 m on a stator of 50 g that yields, as a file.
const YIELDING: &str = "[stator]\nmass = 0.05\nquality = 300\n";

#[test]
fn stators_that_yield() {
    let folder = Folder::new();
    let written = |line: &str| -> Value {
        folder.done(&format!("{line} --out a.json --force"));
        serde_json::from_slice(&folder.read("a.json")).unwrap()
    };
    let sheet = folder.done("motor report --set amplitude=1e-7 --template");
    folder.write("motor.toml", &(sheet.clone() + YIELDING));
    let motor = Motor::from_toml(&(sheet + YIELDING)).unwrap();
    // Far from settled, for the sake of time.
    let settings = OperatingSettings {
        relative_error: 0.3,
        members: 4,
        most_impacts: 5_000,
        ..OperatingSettings::default()
    };
    let accuracy = "--relative-error 0.3 --members 4 --most-impacts 5000";
    let curve = motor.torque_speed_curve(&[0.0, 1e-5], &settings, &Unobserved).unwrap();
    let line = format!("motor curve motor.toml --loads 0:1e-5:2 {accuracy}");
    assert_eq!(written(&line)["operations"], stored(&curve));
    let axis = SweepAxis::new(MotorField::LoadTorque, vec![0.0, 1e-5]);
    let swept = MotorSweep::new(motor.clone(), vec![axis], settings).unwrap().run(&Unobserved).unwrap();
    let sweep = format!("motor sweep motor.toml --over load_torque=0:1e-5:2 {accuracy}");
    assert_eq!(written(&sweep)["cells"], stored(swept.cells()));
    // Both files have the quantities of the stator in columns of the same names.
    for (line, operation) in [(line, &curve[1]), (sweep, &swept.cells()[1])] {
        let point = operation.point().unwrap().stator.unwrap();
        folder.done(&format!("{line} --out a.csv --force"));
        let text = folder.text("a.csv");
        let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
        for (name, estimate) in [
            ("stator_amplitude_m", point.amplitude),
            ("drive_power_w", point.drive_power),
            ("damping_loss_w", point.damping_loss),
            ("electrical_efficiency", point.efficiency.unwrap()),
        ] {
            let place = rows[0].iter().position(|own| *own == name).expect(name);
            assert_eq!(rows[2][place].parse(), Ok(estimate.value), "{name}");
            assert_eq!(rows[2][place + 1].parse(), Ok(estimate.standard_error), "{name}");
        }
    }
    // A continued sweep says what it holds, which the swept field is not.
    let line = "motor sweep motor.toml --over drive_frequency=69e3:70e3:2 --up-and-down";
    let text = folder.done(&format!("{line} {accuracy}"));
    let held = "held: amplitude = 1e-7 m without a rotor, peak_angular_speed = 30 rad/s, \
                preload_acceleration = 9.8 m/s^2, phase_lag = 0 rad, and";
    assert!(text.lines().next().unwrap().contains(held) && text.lines().count() == 5, "{text}");
    let settings = TransientSettings { duration: 0.02, intervals: 4, ..TransientSettings::default() };
    let members = TransientMember::of_ensemble(motor.system(), &settings, 5).unwrap();
    let curves = motor.transients(&members, &Unobserved).unwrap();
    let line = "motor transient motor.toml --members 5 --duration 0.02 --intervals 4";
    assert_eq!(written(line)["curves"], stored(&curves));
    let report = written("motor report motor.toml");
    let limit = motor.stator_report().unwrap().lift_off_preload.unwrap();
    let quantities = report["quantities"].as_array().unwrap();
    let row = quantities.iter().find(|row| row["quantity"] == "lift_off_preload").unwrap();
    assert_eq!((&row["value"], &row["unit"]), (&json!(limit), &json!("N")));
}

/// The deviation of the speed and the torque at rest stand in tables and files of curves and sweeps.
#[test]
fn the_tables_of_a_motor_state_deviation_and_torque_at_rest() {
    let folder = Folder::new();
    let motor = Motor::paper_70_khz();
    let settings = OperatingSettings {
        relative_error: 0.3,
        members: 4,
        most_impacts: 20_000,
        ..OperatingSettings::default()
    };
    let accuracy = "--relative-error 0.3 --members 4 --most-impacts 20000";
    let curve = motor.torque_speed_curve(&[0.0, 1e-5], &settings, &Unobserved).unwrap();
    let point = curve[1].point().unwrap();
    let curve = format!("motor curve --loads 0:1e-5:2 --no-spread {accuracy}");
    let sweep = format!("motor sweep --over load_torque=0:1e-5:2 {accuracy}");
    for line in [curve, sweep] {
        let text = folder.done(&line);
        assert!(text.contains("speed deviation (rad/s)") && text.contains("blocked torque (N m)"), "{text}");
        folder.done(&format!("{line} --out a.csv --force"));
        let text = folder.text("a.csv");
        let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
        for (name, estimate) in
            [("speed_deviation_rad_s", point.speed_deviation), ("blocked_torque_n_m", point.blocked_torque)]
        {
            let (estimate, place) =
                (estimate.unwrap(), rows[0].iter().position(|own| *own == name).expect(name));
            assert_eq!(rows[2][place].parse(), Ok(estimate.value), "{name}");
            assert_eq!(rows[2][place + 1].parse(), Ok(estimate.standard_error), "{name}");
        }
    }
    // A map marks what is not settled.
    let map = "motor sweep --over phase_lag=0:1:2 --over load_torque=0:1e-5:2 --out a.svg --force";
    for (most, marked) in [(200_000, false), (1, true)] {
        folder.done(&format!("{map} --relative-error 0.3 --members 4 --most-impacts {most}"));
        assert_eq!(folder.text("a.svg").contains("not settled"), marked, "{most}");
    }
    let stall = folder.done("motor stall --no-spread --relative-error 0.3 --members 4 --most-impacts 200000");
    assert!(stall.contains("irregular") && stall.contains("blocked torque"), "{stall}");
}

/// The JSON that a command writes.
fn written(line: &str) -> Value {
    let folder = Folder::new();
    folder.done(&format!("{line} --out a.json"));
    serde_json::from_slice(&folder.read("a.json")).unwrap()
}

fn stored(of: &(impl Serialize + ?Sized)) -> Value {
    serde_json::to_value(of).unwrap()
}

fn map(forcing: f64, restitution: f64) -> ImpactMap {
    ImpactMap::new(Vibration::from_axial_forcing(forcing).unwrap(), restitution).unwrap()
}

/// Of a range, as the library's own figures divide theirs.
fn value(first: f64, last: f64, count: usize, index: usize) -> f64 {
    if index + 1 == count { last } else { first + (last - first) * index as f64 / (count - 1) as f64 }
}

#[test]
fn tosses() {
    let toss = single_toss(&System::pizza_toss(), InitialSpin::AbsoluteRest).unwrap();
    assert_eq!(written("toss")["performance"], stored(&toss));
}

#[test]
fn diagrams_from_rest() {
    let orbits: Vec<_> = (0..9)
        .map(|index| {
            let start = ImpactState::new(Phase::new(0.0).unwrap(), 0.0).unwrap();
            map(value(0.3, 0.6, 9, index), 0.5).orbit(start, ChatterPolicy::Complete)
        })
        .collect();
    let columns = orbit_diagram(&orbits, 100, 40, &Unobserved).unwrap();
    let found = written("diagram -G 0.3:0.6:9 --start rest --transient 100 --recorded 40");
    for (column, found) in columns.iter().zip(found["columns"].as_array().unwrap()) {
        let phases: Vec<f64> = column.iter().map(|impact| impact.phase().cycles()).collect();
        assert_eq!(found["impacts"]["impact_phase_periods"], stored(&phases));
    }
}

/// The same for a drive that is not a sine, whose rows may be computed in parts.
#[test]
fn diagrams_orbits_and_basins_of_parabolas() {
    let folder = Folder::new();
    let drive = "[drive]\nheight = 'parabolas'\n";
    folder.write("a.toml", &(folder.done("toss --template --set disk.restitution=0.5") + drive));
    let written = |line: &str| -> Value {
        folder.done(&format!("{line} --out a.json --force"));
        serde_json::from_slice(&folder.read("a.json")).unwrap()
    };
    let map = |forcing| Waveform::Parabolas.map(&map(forcing, 0.5), None).unwrap();
    let start = ImpactState::new(Phase::new(0.0).unwrap(), -TAU / 1.5).unwrap();
    let orbits: Vec<_> =
        (0..5).map(|index| map(value(0.35, 0.5, 5, index)).orbit(start, ChatterPolicy::Complete)).collect();
    let columns = orbit_diagram(&orbits, 100, 40, &Unobserved).unwrap();
    let found = written("diagram a.toml -G 0.35:0.5:5 --transient 100 --recorded 40");
    let of_rise = found["columns"].as_array().unwrap().iter().skip(1).step_by(2);
    for (column, found) in columns.iter().zip(of_rise) {
        let phases: Vec<f64> = column.iter().map(|impact| impact.phase().cycles()).collect();
        assert_eq!(
            (&found["start"], &found["impacts"]["impact_phase_periods"]),
            (&json!("rise"), &stored(&phases))
        );
    }
    let search = OrbitSearch::new(2, 2).unwrap().with_starts(20, 20).unwrap();
    let orbits = map(0.36).periodic_orbits(&search, &Unobserved).unwrap();
    let line = "orbits a.toml -G 0.36 --impacts 2 --platform-periods 2 --starts 20";
    assert_eq!(written(line)["orbits"], stored(&orbits));
    assert!(orbits.iter().any(|orbit| orbit.stability() == Stability::Stable));
    let maps = move |forcing| Some(map(forcing));
    let first = driven_doubling_cascade(maps, 1, &Unobserved).unwrap().doublings[0];
    assert_eq!(
        written("doublings a.toml --count 1")["doublings"][0]["axial_forcing"],
        json!(first.axial_forcing)
    );
    let labels = "hexadecimal_labels_by_speed";
    let basins = "basins a.toml -G 0.36 --cells 12 --speed 0:2";
    let whole = written(basins);
    assert!(whole[labels].to_string().contains("02"), "{whole}");
    for part in ["1", "2"] {
        folder.done(&format!("{basins} --chunk {part}/2 --out {part}.json"));
    }
    assert_eq!(written("merge 1.json 2.json")[labels], whole[labels]);
}

/// The same on a sine with contacts that take time: the library's numbers, and other ones than those of rigid
/// impacts.
#[test]
fn diagrams_orbits_and_basins_of_contacts_that_take_time() {
    let folder = Folder::new();
    let written = |line: &str| -> Value {
        folder.done(&format!("{line} --out a.json --force"));
        serde_json::from_slice(&folder.read("a.json")).unwrap()
    };
    let map = |forcing| Waveform::Sine.map(&map(forcing, 0.5), Some(0.2)).unwrap();
    let start = ImpactState::from_normalised(TAU * 0.1, 1.3).unwrap();
    let orbits = [0.45, 0.55].map(|forcing| map(forcing).orbit(start, ChatterPolicy::Complete));
    let columns = orbit_diagram(&orbits, 100, 40, &Unobserved).unwrap();
    let line = "diagram -G 0.45:0.55:2 --start 0.1,1.3 --transient 100 --recorded 40";
    let (rigid, soft) = (written(line), written(&format!("{line} --contact-periods 0.2")));
    for (index, column) in columns.iter().enumerate() {
        let phases: Vec<f64> = column.iter().map(|impact| impact.phase().cycles()).collect();
        let of = |found: &Value| found["columns"][index]["impacts"]["impact_phase_periods"].clone();
        assert_eq!(of(&soft), stored(&phases));
        assert_ne!(of(&soft), of(&rigid));
    }
    let settings = VerdictSettings { transient: 200, impacts: 2_000, ..VerdictSettings::default() };
    let starts = [0.45, 0.55].map(|forcing| (map(forcing), start));
    let line = "verdicts -G 0.45:0.55:2 --start 0.1,1.3 --transient 200 --impacts 2000 --contact-periods 0.2";
    let found = written(line);
    let cells: Vec<&Value> = found["cells"].as_array().unwrap().iter().map(|cell| &cell["verdict"]).collect();
    assert_eq!(json!(cells), stored(&verdicts(&starts, settings, &Unobserved).unwrap()));
    let search = OrbitSearch::new(1, 1).unwrap().with_starts(20, 20).unwrap();
    let orbits = map(0.45).periodic_orbits(&search, &Unobserved).unwrap();
    let orbit = "orbits -G 0.45 --impacts 1 --platform-periods 1 --starts 20 --contact-periods 0.2";
    assert_eq!(written(orbit)["orbits"], stored(&orbits));
    assert!(orbits.iter().any(|orbit| orbit.stability() == Stability::Stable));
    let basins = written("basins -G 0.45 --cells 12 --speed 0:2 --starts 400 --contact-periods 0.2");
    // No contact lasts for ever there, and there is one attracting orbit.
    assert!(basins["hexadecimal_labels_by_speed"].to_string().contains("02"), "{basins}");
    let legal = "contact_periods = 0 is outside its legal range [1e-6, 1000] (periods of the platform)";
    let lines = [
        ("orbits --contact-periods 0", legal),
        ("diagram --contact-periods nan", "contact_periods = NaN is outside"),
        ("basins --contact-periods=-1", "contact_periods = -1 is outside"),
        ("orbits --contact-periods 0.2 -r 0", "restitution of a compliant contact = 0 is outside"),
        ("diagram --contact-periods 0.2 --start period-1", "rigid impacts"),
        ("verdicts --contact-periods 0", legal),
    ];
    folder.all_refused(2, &lines);
}

#[test]
fn tosses_and_motors_on_drives() {
    let folder = Folder::new();
    let written = |line: &str| -> Value {
        folder.done(&format!("{line} --out a.json --force"));
        serde_json::from_slice(&folder.read("a.json")).unwrap()
    };
    let drive = "[drive]\nheight = 'triangle'\nangle = { fourier = [[1, 0], [0.2, 0.5]] }\n";
    let angle = Waveform::Fourier(vec![(1.0, 0.0), (0.2, 0.5)]);
    folder.write("toss.toml", &(folder.done("toss --template") + drive));
    let toss = System::pizza_toss();
    let hand = DrivenPlatform::new(*toss.platform(), Waveform::Triangle, angle.clone()).unwrap();
    let phase = Phase::new(TOSS_START).unwrap();
    let own = driven::single_toss(&hand, toss.disk(), Some(phase), InitialSpin::AbsoluteRest).unwrap();
    assert_eq!(written("toss toss.toml")["performance"], stored(&own));
    let start = DrivenStart::Contact { phase, angular_speed: 0.0 };
    let settings = MultiTossSettings { transient_impacts: 50, examined_impacts: 64, ..Default::default() };
    let system = DrivenSystem::new(&hand, toss.disk()).unwrap();
    let orbit = driven::multi_toss(system.clone(), start, &settings, &Unobserved).unwrap();
    assert_eq!(written("toss toss.toml --many --transient 50 --examined 64")["orbit"], stored(&orbit));
    // A toss starts at the lowest point, at whichever phase that is.
    let shifted = "[drive]\nheight = { fourier = [[1, 2.0]] }\nangle = { fourier = [[1, 2.0]] }\n";
    folder.write("shifted.toml", &(folder.done("toss --template") + shifted));
    let speed = |found: &Value| found["performance"]["airborne_speed"].as_f64().unwrap();
    assert!((speed(&written("toss shifted.toml")) - speed(&written("toss"))).abs() < 1e-9);
    for line in ["toss shifted.toml", "toss shifted.toml --many --transient 50 --examined 64"] {
        let found = written(line);
        let heights = found["motion"].as_array().unwrap().iter();
        let mut heights = heights.map(|own| own["platform_height_m"].as_f64().unwrap());
        let first = heights.next().unwrap();
        assert!(heights.all(|height| height >= first - 1e-15), "{line}");
    }
    // It starts at another phase, which a drive may give.
    for (of, started) in [(1.5 * PI, TOSS_START), (2.0, 2.0)] {
        let drive = format!("{drive}start_phase = {of}\n");
        folder.write("start.toml", &(folder.done("toss --template") + &drive));
        let phase = Phase::new(started).unwrap();
        let own = driven::single_toss(&hand, toss.disk(), Some(phase), InitialSpin::AbsoluteRest).unwrap();
        assert_eq!(written("toss start.toml")["performance"], stored(&own));
        let line = "--many --transient 50 --examined 64 --periods 9";
        let found = written(&format!("toss start.toml {line}"));
        let start = DrivenStart::Contact { phase, angular_speed: 0.0 };
        let orbit = driven::multi_toss(system.clone(), start, &settings, &Unobserved).unwrap();
        assert_eq!(found["orbit"], stored(&orbit));
        let same = found["motion"] == written(&format!("toss toss.toml {line}"))["motion"];
        assert_eq!(same, started.to_bits() == TOSS_START.to_bits());
    }

    folder.write("motor.toml", &(folder.done("motor report --template") + drive));
    let moved = DriveParameters { height: Waveform::Triangle, angle, start_phase: None };
    let motor = Motor::paper_70_khz().with(|sheet| sheet.drive = moved).unwrap();
    let settings = OperatingSettings { relative_error: 0.3, members: 4, ..OperatingSettings::default() };
    let curve = motor.torque_speed_curve(&[0.0, 1e-5], &settings, &Unobserved).unwrap();
    let found = written("motor curve motor.toml --loads 0:1e-5:2 --relative-error 0.3 --members 4");
    assert_eq!(found["operations"], stored(&curve));
    let line = "motor transient motor.toml --members 5 --duration 0.02 --intervals 4";
    let settings = TransientSettings { duration: 0.02, intervals: 4, ..TransientSettings::default() };
    let members = TransientMember::of_ensemble(motor.system(), &settings, 5).unwrap();
    let curves = motor.transients(&members, &Unobserved).unwrap();
    assert_eq!(written(line)["curves"], stored(&curves));
    for part in ["1", "2"] {
        folder.done(&format!("{line} --chunk {part}/2 --out {part}.json"));
    }
    assert_eq!(written("merge 1.json 2.json")["curves"], stored(&curves));
}

#[test]
fn contacts_that_take_time() {
    let folder = Folder::new();
    let written = |line: &str| -> Value {
        folder.done(&format!("{line} --out a.json --force"));
        serde_json::from_slice(&folder.read("a.json")).unwrap()
    };
    let toss = System::pizza_toss().with_contact(Some(Contact::lasting(0.05))).unwrap();
    let hand = DrivenPlatform::from(*toss.platform()).with_contact(toss.soft_contact());
    let phase = Phase::new(TOSS_START).unwrap();
    let own = driven::single_toss(&hand, toss.disk(), Some(phase), InitialSpin::AbsoluteRest).unwrap();
    let found = written("toss --set contact.time=0.05");
    assert_eq!(found["performance"], stored(&own));
    assert!(found["performance"] != written("toss")["performance"]);
    // The disk sinks into the hand.
    let below = |own: &Value| own["disk_height_m"].as_f64() < own["platform_height_m"].as_f64();
    assert!(found["motion"].as_array().unwrap().iter().any(below));

    let materials = "[contact]\nmaterials = ['steel', 'aluminium']\ngeometry = 'plane'\nball_radius = 0.01\n";
    folder.write("motor.toml", &(folder.done("motor report --template") + materials));
    let settings = OperatingSettings { relative_error: 0.3, members: 4, ..OperatingSettings::default() };
    let accuracy = "--relative-error 0.3 --members 4";
    let line = format!("motor curve motor.toml --loads 0:1e-5:2 --no-spread {accuracy}");
    let rigid = Motor::paper_70_khz();
    let curve = rigid.torque_speed_curve(&[0.0, 1e-5], &settings, &Unobserved).unwrap();
    assert_eq!(written(&line)["operations"], stored(&curve));
    // Too stiff for the numbers.
    let stiff = folder.command(&format!("{line} --set contact.time=1e-12")).output().unwrap();
    assert_eq!(String::from_utf8(stiff.stdout).unwrap(), folder.done(&line));
    assert!(String::from_utf8(stiff.stderr).unwrap().contains("warning: contact.time is below 1e-6 rad"));
    let motor = rigid.with(|sheet| sheet.contact = Some(Contact::lasting(1e-5))).unwrap();
    // Far from settled, for the sake of time.
    let settings = OperatingSettings { most_impacts: 5_000, ..settings };
    let time = "--most-impacts 5000 --set contact.time=1e-5";
    let curve = motor.torque_speed_curve(&[0.0, 1e-5], &settings, &Unobserved).unwrap();
    assert_eq!(written(&format!("{line} {time}"))["operations"], stored(&curve));
    let swept =
        written(&format!("motor sweep {accuracy} --most-impacts 5000 --over contact.time=1e-5:2e-5:2"));
    let alone = motor.torque_speed_curve(&[0.0], &settings, &Unobserved).unwrap();
    assert_eq!(swept["cells"][0], stored(&alone)[0]);
    let stall = motor.stall_load(&settings, &Unobserved).unwrap();
    assert_eq!(written(&format!("motor stall {accuracy} {time}"))["stall_load"], stored(&stall));
    folder.write(
        "soft.toml",
        &(folder.done("motor report --template") + "[contact]\ntime = 1e-5\nlaw = 'hysteresis'\n"),
    );
    let settings = TransientSettings { duration: 0.02, intervals: 4, ..TransientSettings::default() };
    let members = TransientMember::of_ensemble(motor.system(), &settings, 5).unwrap();
    let law = Some(ContactLaw::Hysteresis);
    let hysteretic = Contact { law, ..Contact::lasting(1e-5) };
    let motor = motor.with(|sheet| sheet.contact = Some(hysteretic)).unwrap();
    let curves = motor.transients(&members, &Unobserved).unwrap();
    let line = "motor transient soft.toml --members 5 --duration 0.02 --intervals 4";
    assert_eq!(written(line)["curves"], stored(&curves));
    for part in ["1", "2"] {
        folder.done(&format!("{line} --chunk {part}/2 --out {part}.json"));
    }
    assert_eq!(written("merge 1.json 2.json")["curves"], stored(&curves));
}

#[test]
fn verdicts_on_a_map() {
    let settings = VerdictSettings { transient: 200, impacts: 2_000, ..VerdictSettings::default() };
    let mut starts = Vec::new();
    for row in 0..4 {
        for column in 0..7 {
            let restitution = value(0.1, 0.9, 4, row);
            let start = ImpactState::new(Phase::new(0.0).unwrap(), -TAU / (1.0 + restitution)).unwrap();
            starts.push((map(value(0.2, 2.0, 7, column), restitution), start));
        }
    }
    let found = written("verdicts -G 0.2:2:7 -r 0.1:0.9:4 --impacts 2000 --transient 200 --details");
    let cells: Vec<&Value> = found["cells"].as_array().unwrap().iter().map(|cell| &cell["verdict"]).collect();
    assert_eq!(json!(cells), stored(&verdicts(&starts, settings, &Unobserved).unwrap()));
    // Without details there is the kind of each.
    let kinds = written("verdicts -G 0.2:2:7 -r 0.1:0.9:4 --impacts 2000 --transient 200");
    let rows = kinds["kinds_by_restitution"].as_array().unwrap();
    assert!(rows.len() == 4 && rows.iter().all(|row| row.as_str().unwrap().len() == 7), "{kinds}");
}

#[test]
fn basins_with_a_chaotic_attractor() {
    let search = AttractorSearch::default().with_starts(100).unwrap();
    let grid = Grid::new(Axis::new(0.0, 1.0, 21).unwrap(), Axis::new(0.0, 3.0, 21).unwrap()).unwrap();
    let settings = BasinSettings { max_impacts: 400, ..BasinSettings::default() };
    let basins =
        map(0.55, 0.5).attractors(&search, &Unobserved).unwrap().basins(grid, settings, &Unobserved).unwrap();
    let found = written("basins -G 0.55 --cells 21 --starts 100 --impacts 400 --out a.svg --out a.csv");
    let rows: Vec<String> =
        (0..21).map(|row| basins.row(row).iter().map(|label| format!("{label:02x}")).collect()).collect();
    assert_eq!(found["hexadecimal_labels_by_speed"], json!(rows));
    assert!(found["attractors"].to_string().contains("exponent"), "{}", found["attractors"]);
}

#[test]
fn doublings() {
    // What is found before the cascade ends, and why it ends.
    let (found, two) = (written("doublings -r 0.01"), doubling_cascade(0.01, 2, &Unobserved).unwrap());
    assert_eq!(found["doublings"], stored(&two.doublings));
    let ended_by = doubling_cascade(0.01, 8, &Unobserved).unwrap().ended_by.unwrap();
    assert_eq!(found["ended_by"], json!(ended_by.to_string()));
    assert_eq!(written("doublings --count 6")["ended_by"], json!(null));
    assert_eq!(
        written("doublings --count 6")["doublings"],
        stored(&doubling_cascade(0.5, 6, &Unobserved).unwrap().doublings)
    );
}

#[test]
fn curves() {
    let found = written("curves --max-points 5");
    let first = &found["curves"][0];
    assert_eq!((&first["kind"], &first["impacts"]), (&json!("doubling"), &json!(1)));
    for point in first["points"].as_array().unwrap() {
        let [forcing, restitution] = [0, 1].map(|k| point["parameters"][k].as_f64().unwrap());
        assert!((forcing - ImpactMap::first_doubling_forcing(restitution)).abs() < 1e-12);
    }
    // Another drive: of parabolas the doubling is pi (1 + r^2)/(4 (1 + r)^2).
    let folder = Folder::new();
    let system = folder.done("diagram --template");
    folder.write("a.toml", &(system + "\n[drive]\nheight = \"parabolas\"\n"));
    let text = folder.done("curves a.toml -G 0.35 -r 0.5 --max-points 3 --out a.csv --out a.json");
    assert_eq!(text, "");
    let found: Value = serde_json::from_str(&folder.text("a.json")).unwrap();
    let doubling = found["curves"].as_array().unwrap().iter().find(|own| own["kind"] == "doubling").unwrap();
    for point in doubling["points"].as_array().unwrap() {
        let [forcing, restitution] = [0, 1].map(|k| point["parameters"][k].as_f64().unwrap());
        let by_hand = 0.25 * std::f64::consts::PI * (1.0 + restitution * restitution)
            / ((1.0 + restitution) * (1.0 + restitution));
        assert!((forcing - by_hand).abs() < 1e-12, "{forcing} {by_hand}");
    }
}

#[test]
fn motors() {
    let motor = Motor::paper_70_khz();
    let axis = |field, values: [f64; 2]| SweepAxis::new(field, values.to_vec());
    let settings = OperatingSettings { relative_error: 0.3, members: 4, ..OperatingSettings::default() };
    // Two vertical motions.
    let axes = vec![axis(MotorField::Amplitude, [1e-8, 2e-8]), axis(MotorField::LoadTorque, [0.0, 1e-5])];
    let sweep = MotorSweep::new(motor.clone(), axes, settings).unwrap().run(&Unobserved).unwrap();
    let line = "motor sweep --over amplitude=1e-8:2e-8:2 --over load_torque=0:1e-5:2 --relative-error 0.3 --members 4";
    assert_eq!(written(line)["cells"], stored(sweep.cells()));
    let transient = TransientSettings { duration: 3.0, intervals: 30, ..TransientSettings::default() };
    let all = TransientEnsemble::new(motor.system(), &transient, 7, &Unobserved).unwrap();
    let found = written("motor transient --members 7 --duration 3 --intervals 30");
    assert_eq!((&found["curves"], &found["member_fits"]), (&stored(&all.curves), &stored(&all.fits)));
    let curve = motor.torque_speed_curve(&[0.0, 1e-5, 2e-5], &settings, &Unobserved).unwrap();
    let line = "motor curve --loads 0:2e-5:3 --relative-error 0.3 --members 4 --no-spread";
    assert_eq!(written(line)["operations"], stored(&curve));
}
