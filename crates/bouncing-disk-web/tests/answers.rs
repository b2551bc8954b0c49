//! Answers to requests: what a page relies on, and every seam of what it may ask.

use bouncing_disk::core::flight::Compliance;
use bouncing_disk::core::numerics::elementary::ln;
use bouncing_disk::core::{Phase, Unobserved};
use bouncing_disk::driven::single_toss;
use bouncing_disk::motor::{DrivenMotor, OperatingSettings};
use bouncing_disk::parameters::{ContactLaw, DriveParameters, DrivenPlatform, Stroke};
use bouncing_disk::toss::{InitialSpin, TOSS_START};
use bouncing_disk::{Motor, System};
use bouncing_disk_web::{Explorer, Reply};
use serde_json::{Value, json};

fn pizza() -> Value {
    json!({
        "amplitude": 0.13, "twist_amplitude": 1.0, "angular_frequency": 15.0, "phase_lag": 0.3, "contact_radius": 0.135,
        "gyration_radius": 0.11, "friction": 0.6, "restitution": 0.5, "preload_acceleration": 9.8, "load_acceleration": 0.0
    })
}

fn sheet() -> Value {
    let motor = Motor::paper_70_khz().with(|sheet| sheet.mass = Some(1e-3));
    json!(motor.expect("legal").parameters())
}

fn with(mut value: Value, changes: Value) -> Value {
    for (name, change) in changes.as_object().expect("an object") {
        value[name] = change.clone();
    }
    value
}

fn ask(request: &Value) -> Reply {
    Explorer::new().respond(&request.to_string())
}

fn answered(request: &Value) -> (Value, Reply) {
    let reply = ask(request);
    assert!(!reply.refused, "{request}: {}", reply.json);
    (serde_json::from_str(&reply.json).expect("JSON"), reply)
}

fn refused(request: &Value) -> Value {
    let reply = ask(request);
    assert!(reply.refused, "{request}: {}", reply.json);
    assert!(reply.numbers.is_empty() && reply.bytes.is_empty());
    serde_json::from_str(&reply.json).expect("JSON")
}

/// A number of an answer, by a JSON pointer; it must be there.
fn number(json: &Value, name: &str) -> f64 {
    let found = if name.starts_with('/') { json.pointer(name) } else { json.get(name) };
    found.and_then(Value::as_f64).unwrap_or_else(|| panic!("{name} of {json}"))
}

fn list<'a>(json: &'a Value, name: &str) -> &'a [Value] {
    json[name].as_array().unwrap_or_else(|| panic!("{name} of {json}"))
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

fn check(system: Value) -> Value {
    json!({ "call": "check", "system": system })
}

fn start() -> Value {
    json!({ "impact_phase": 1.2, "normalised_speed": 1.3 })
}

fn motion(start: Value, periods: u64) -> Value {
    json!({ "call": "motion", "system": pizza(), "start": start, "periods": periods, "samples_per_period": 60 })
}

/// The disk lies on the platform.
fn at_rest() -> Value {
    json!({ "kind": "impact", "impact_phase": 0.0, "normalised_speed": 0.0, "angular_speed": 0.0 })
}

fn diagram(columns: [usize; 2], rotation: bool) -> Value {
    json!({
        "call": "diagram", "system": pizza(), "axial_forcing": [0.3, 0.62], "count": 40, "columns": columns,
        "start": start(), "transient": 300, "recorded": 20, "rotation": rotation
    })
}

fn basins(rows: [usize; 2]) -> Value {
    json!({
        "call": "basins", "axial_forcing": 0.486, "restitution": 0.5, "phase_periods": [0.0, 1.0], "phases": 30,
        "normalised_speed": [0.0, 3.0], "speeds": 20, "rows": rows
    })
}

/// The legal ranges of what the form shows in place of a number of the system: the forcing, and the contact time in
/// periods.
fn ranges() -> Value {
    let start = json!({ "impact_phase": 1.0, "normalised_speed": 1.0 });
    let orbit = json!({ "call": "orbit", "axial_forcing": -1.0, "restitution": 0.5, "start": start });
    let forcing = refused(&orbit)["range"].clone();
    let forcing = forcing.as_str().and_then(|range| range.split(" (").next());
    let periods = 10.0 * (Compliance::CONTACT_TIMES[1] / std::f64::consts::TAU / 10.0).floor();
    json!({ "axial_forcing": forcing, "contact_time": format!("[0, {periods}]") })
}

/// Tables I and III and the legal ranges, as the page imports them: the library is the one place in which they are typed.
#[test]
fn the_tables_of_the_page_are_those_of_the_library() {
    let (hand, dough, motor) = (Stroke::pizza_toss(), System::pizza_toss(), Motor::paper_70_khz());
    let motion = json!({
        "stroke": hand.stroke, "amplitude_angle": hand.amplitude_angle, "angular_frequency": hand.angular_frequency
    });
    let tables =
        json!({ "table_one": with(json!(dough.disk()), motion), "table_three": motor, "ranges": ranges() });
    let text = serde_json::to_string_pretty(&tables).expect("storable") + "\n";
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/page/src/tables.json");
    if std::env::var_os("UPDATE_DOCUMENTATION").is_some() {
        std::fs::write(file, &text).expect("writable");
    }
    assert_eq!(std::fs::read_to_string(file).expect("there"), text, "UPDATE_DOCUMENTATION=1 writes it");
}

#[test]
fn a_system_is_checked_by_the_ranges_of_the_library() {
    let (summary, _) = answered(&check(pizza()));
    let forcing = 0.13 * 225.0 / (std::f64::consts::PI * 9.8);
    assert!((number(&summary, "axial_forcing") - forcing).abs() < 1e-15);
    assert_eq!(summary["bounces"], true);
    for (name, value) in [("restitution", 1.5), ("amplitude", -1.0), ("angular_frequency", 0.0)] {
        let refusal = refused(&check(with(pizza(), json!({ name: value }))));
        assert_eq!((&refusal["kind"], &refusal["quantity"]), (&json!("out-of-range"), &json!(name)));
        assert!(
            refusal["message"].as_str().is_some_and(|text| text.contains(&value.to_string())),
            "{refusal}"
        );
        assert!(refusal["range"].as_str().is_some_and(|range| !range.is_empty()), "{refusal}");
    }
    let (summary, _) = answered(&check(with(pizza(), json!({ "friction": 0.0, "amplitude": 0.0 }))));
    assert_eq!((&summary["angular_forcing"], &summary["rise_time"]), (&Value::Null, &Value::Null));
    assert_eq!(summary["bounces"], false);
}

#[test]
fn what_is_no_request_is_told() {
    let deep = "[".repeat(100_000);
    // JavaScript writes a number that is none, or infinite, as null.
    let wrong = [json!({ "colour": 1.0 }), json!({ "friction": null })];
    let [colour, none] = wrong.map(|wrong| check(with(pizza(), wrong)).to_string());
    for text in
        ["", "null", "{}", r#"{"call": "nothing"}"#, r#"{"call": "check"}"#, "\0", &deep, &colour, &none]
    {
        let reply = Explorer::new().respond(text);
        assert!(reply.refused && reply.json.contains("\"kind\":\"request\""), "{}", reply.json);
    }
}

/// What no value of the library would refuse, with the name of what is refused.
#[test]
fn what_is_too_much_or_does_not_belong_together_is_refused() {
    let long = |periods: u64, samples: u64| {
        with(motion(at_rest(), periods), json!({ "samples_per_period": samples }))
    };
    let under = json!({ "kind": "flight", "phase": 0.0, "gap": -0.3, "relative_velocity": 0.0, "angular_speed": 0.0 });
    let columns = |changes| with(diagram([0, 40], true), changes);
    let branches = |restitution: f64, axial_forcing: [f64; 2]| json!({ "call": "branches", "restitution": restitution, "axial_forcing": axial_forcing });
    for (request, quantity) in [
        (long(0, 60), "periods"),
        (long(200_000, 1), "periods"),
        (long(u64::MAX, u64::MAX), "periods"),
        (long(100_000, 100_000), "samples"),
        (long(3, 0), "samples"),
        (motion(under, 3), "gap"),
        (diagram([3, 2], false), "columns"),
        (diagram([0, 41], false), "columns"),
        (columns(json!({ "count": 1 })), "count"),
        (columns(json!({ "recorded": u32::MAX })), "recorded"),
        (columns(json!({ "patience": 10_000_000 })), "patience"),
        (basins([5, 4]), "rows"),
        (basins([0, 21]), "rows"),
        (branches(0.5, [0.6, 0.3]), "high end of a continuation"),
        (branches(1.5, [0.3, 0.6]), "restitution"),
        (with(loads(&sheet(), &[0.0]), json!({ "most_impacts": 30_000_000 })), "most_impacts"),
        (with(run_up(&sheet(), 3.0), json!({ "members": 0 })), "members"),
        (with(run_up(&sheet(), 3.0), json!({ "points": 1 })), "intervals"),
        (run_up(&sheet(), -1.0), "duration"),
        (json!({ "call": "sheet_of_system", "system": pizza(), "mass": 0.0 }), "mass"),
    ] {
        assert_eq!(refused(&request)["quantity"], quantity, "{request}");
    }
    let both = with(sheet(), json!({ "twist_amplitude": 1e-4 }));
    refused(&json!({ "call": "motor_report", "sheet": both }));
    let turning = refused(&columns(json!({ "drive": "triangle" })))["message"].to_string();
    assert!(turning.contains("the sine of Eq. (1)"), "{turning}");
}

#[test]
fn a_longer_motion_begins_like_a_shorter_one() {
    for start in [
        json!({ "kind": "impact", "impact_phase": 1.2, "normalised_speed": 1.3, "angular_speed": 0.0 }),
        json!({ "kind": "flight", "phase": 0.0, "gap": 0.3, "relative_velocity": 1.0, "angular_speed": -2.0 }),
    ] {
        let (short, few) = answered(&motion(start.clone(), 3));
        let (long, many) = answered(&motion(start, 12));
        let events = number(&short, "events") as usize;
        assert_eq!((&short["samples"], &long["samples"]), (&json!(181), &json!(721)));
        assert_eq!((few.numbers.len(), few.bytes.len()), (9 * 181 + 6 * events, 181 + events));
        assert_eq!(few.numbers[..9 * 181], many.numbers[..9 * 181]);
        assert_eq!(few.bytes[..181], many.bytes[..181]);
        let (own, others) = (&few.numbers[9 * 181..], &many.numbers[9 * 721..]);
        assert_eq!(bits(own), bits(&others[..own.len()]));
        // Twelve periods take the time that they take, and the disk is never under the platform.
        let last = many.numbers[9 * 720];
        assert!((last - 12.0 * std::f64::consts::TAU / 15.0).abs() < 1e-12, "{last}");
        assert!(many.numbers[..9 * 721].chunks(9).all(|row| row[1] >= row[5] - 1e-12));
    }
    let (_, still) = answered(&with(
        motion(at_rest(), 2),
        json!({ "system": with(pizza(), json!({ "amplitude": 0.0 })) }),
    ));
    assert!(still.numbers[..9 * 121].chunks(9).all(|row| row[1].to_bits() == row[5].to_bits()));
}

/// What the platform puts in neither goes nor stays, beside what rounding makes of this size.
fn assert_balanced(json: &Value, size: f64) {
    let gone = ["restitution_loss", "friction_loss", "load_work", "stored"];
    let gone: f64 = gone.iter().map(|name| number(&json["energy"], name)).sum();
    assert!((number(&json["energy"], "platform_work") - gone).abs() < 1e-12 * size, "{json}");
}

/// The rotor of Fig. 9 slides through all of it, and its kinetic energy goes where its speed says.
#[test]
fn energy_is_balanced_in_a_contact_that_does_not_end() {
    let rotor = json!({
        "amplitude": 1e-6, "twist_amplitude": 0.0, "angular_frequency": 62.83185307179586, "contact_radius": 1.25e-3,
        "gyration_radius": 6.3e-3, "friction": 0.1, "preload_acceleration": 2.4
    });
    let start = with(at_rest(), json!({ "angular_speed": 30.0 }));
    for (periods, load) in [(20_u64, 0.0), (20, 1.0), (60, 0.0)] {
        let system = with(with(pizza(), rotor.clone()), json!({ "load_acceleration": load }));
        let (json, reply) = answered(&with(motion(start.clone(), periods), json!({ "system": system })));
        let last = reply.numbers[9 * 60 * periods as usize + 4];
        let lost = 0.5 * 6.3e-3 * 6.3e-3 * (900.0 - last * last);
        let [friction, work] = ["/energy/friction_loss", "/energy/load_work"].map(|name| number(&json, name));
        assert!((friction + work - lost).abs() < 1e-9 * lost, "{lost} of {json}");
        assert!((work > 0.0) == (load > 0.0), "{json}");
        assert_balanced(&json, lost);
    }
}

/// However a motion is cut off: the balance is that of the instant.
#[test]
fn energy_is_balanced_at_the_end_of_any_motion() {
    for (periods, contact_time, [impact_phase, speed]) in (1..30).flat_map(|periods| {
        [0.0, 0.03]
            .into_iter()
            .flat_map(move |time| [[0.4, 1.4], [4.7, 0.0]].map(|start| (periods, time, start)))
    }) {
        let changes = json!({ "amplitude": 0.06, "load_acceleration": 0.5, "contact_time": contact_time });
        let start = json!({ "impact_phase": impact_phase, "normalised_speed": speed, "angular_speed": 3.0 });
        let request = motion(with(at_rest(), start), periods);
        let (json, reply) = answered(&with(request, json!({ "system": with(pizza(), changes) })));
        let energy = |name: &str| number(&json["energy"], name);
        let size = 1.0 + energy("platform_work").abs() + energy("restitution_loss") + energy("friction_loss");
        assert_balanced(&json, size);
        // The impact at the start is before it.
        let held = |row: &[f64]| 0.5 * (row[3] * row[3] + 0.11 * 0.11 * row[4] * row[4]) + 9.8 * row[1];
        let mut rows = reply.numbers[..9 * number(&json, "samples") as usize].chunks(9);
        let (first, last) = (rows.next().expect("a sample"), rows.next_back().expect("another"));
        // Only a rigid contact, and one that is open, has no energy in its spring.
        let open = contact_time == 0.0 || speed > 0.0 && last[1] > last[5];
        let stored = held(last) - held(first);
        assert!(!open || (stored - energy("stored")).abs() < 1e-9 * size, "{periods} {json}");
    }
}

#[test]
fn columns_do_not_depend_on_which_are_asked_for_together() {
    for rotation in [false, true] {
        let (_, all) = answered(&diagram([0, 40], rotation));
        let mut parts = Vec::new();
        for columns in [[0, 7], [7, 8], [8, 39], [39, 40]] {
            parts.extend_from_slice(&answered(&diagram(columns, rotation)).1.numbers);
        }
        assert_eq!(bits(&all.numbers), bits(&parts));
        assert_eq!(all.numbers.chunks(4).all(|row| row[3].is_nan()), !rotation);
    }
    // The rotation does not act back on the vertical motion: the same impacts, in the same order.
    let (_, without) = answered(&diagram([0, 40], false));
    let (_, rotating) = answered(&diagram([0, 40], true));
    let vertical =
        |reply: &Reply| reply.numbers.chunks(4).flat_map(|row| bits(&row[..3])).collect::<Vec<_>>();
    assert_eq!(vertical(&without), vertical(&rotating));
    // Another motion of the platform has other impacts, and no rotation.
    let driven = |drive: Value, rotation| with(diagram([0, 40], rotation), json!({ "drive": drive }));
    let (_, triangle) = answered(&driven(json!("triangle"), false));
    let same = answered(&driven(json!("sine"), false)).1.digest == without.digest;
    assert!(same && triangle.numbers.len() > 3000 && vertical(&triangle) != vertical(&without));
}

/// The two spins of an orbit of two impacts that slides in both, at Gamma_T = 100, need some 400 impacts.
#[test]
fn columns_are_followed_until_they_have_settled() {
    let unit = number(&answered(&check(pizza())).0, "angular_forcing");
    let system = with(pizza(), json!({ "phase_lag": 0.0, "twist_amplitude": 100.0 / unit }));
    let patient = json!({ "patience": 3000, "recorded": 200 });
    for (forcing, spins) in [(0.51, [0.9028, 0.9219]), (0.53, [0.9495, 0.9683])] {
        let changes = json!({ "system": system, "axial_forcing": [forcing, forcing + 1e-9], "recorded": 200, "count": 2 });
        let request = with(diagram([0, 1], true), changes);
        let (json, _) = answered(&request);
        assert_eq!((&json["unsettled"], &json["left_out"]), (&json!(1), &json!(300)));
        let (json, reply) = answered(&with(request, patient.clone()));
        assert_eq!(json["unsettled"], 0, "{json}");
        assert!((500.0..2000.0).contains(&number(&json, "left_out")), "{json}");
        let is_one = |row: &[f64]| spins.iter().any(|spin| (row[3] - spin).abs() < 1e-4);
        assert!(reply.numbers.chunks(4).all(is_one), "{forcing}");
    }
    // Near a doubling no patience suffices, and the answer says so.
    let request = with(diagram([0, 40], false), patient);
    assert!(number(&answered(&request).0, "unsettled") <= 1.0);
    let (json, _) = answered(&with(request, json!({ "axial_forcing": [0.486, 0.48601] })));
    assert_eq!((&json["unsettled"], &json["left_out"]), (&json!(40), &json!(3000)));
    // Without friction or twist there is no spin, and no rounding of one.
    for idle in [json!({ "friction": 0.0 }), json!({ "twist_amplitude": 0.0 })] {
        let (_, reply) = answered(&with(diagram([0, 40], true), json!({ "system": with(pizza(), idle) })));
        assert!(!reply.numbers.is_empty() && reply.numbers.chunks(4).all(|row| row[3].is_nan()));
    }
}

#[test]
fn a_single_toss_is_that_of_the_library() {
    let own = System::pizza_toss();
    let toss = |changes| json!({ "call": "toss", "system": with(pizza(), changes) });
    let parameters = with(json!(own.platform()), json!(own.disk()));
    let (json, _) = answered(&toss(parameters));
    let expected = bouncing_disk::toss::single_toss(&own, InitialSpin::AbsoluteRest).expect("thrown");
    assert_eq!(json, json!(expected));
    assert!((number(&json, "airborne_speed") - 14.0).abs() < 0.5, "{json}");
    let gentle = refused(&toss(json!({ "amplitude": 0.03 })))["message"].to_string();
    assert!(gentle.contains("never"), "{gentle}");
    assert_eq!(refused(&toss(json!({ "contact_time": 0.03 })))["kind"], "computation");
}

#[test]
fn shares_of_kinds_are_those_of_the_attractors_that_starts_end_on() {
    // At 0.51 a disk at rest is thrown onto a periodic orbit, whose share has that of the rest.
    let known = [(0.45, "rest periodic"), (0.55, "rest chaotic"), (0.2, "rest"), (0.51, "periodic chaotic")];
    for (forcing, lasting) in known {
        let request = json!({ "call": "attractors", "axial_forcing": forcing, "restitution": 0.5 });
        let (json, _) = answered(&request);
        let all = list(&json, "attractors");
        assert_eq!(all[0]["leads_to"].is_null(), lasting.contains("rest"), "{json}");
        for kind in ["rest", "periodic", "chaotic"] {
            let end =
                |one: &Value| one["leads_to"].as_u64().map_or(one.clone(), |last| all[last as usize].clone());
            let own = all.iter().filter(|one| end(one)["kind"] == kind);
            let sum: f64 = own.map(|one| number(one, "share")).sum();
            let [low, share, high] = ["low", "value", "high"].map(|name| number(&json["kinds"][kind], name));
            assert!((share - sum).abs() < 1e-12, "{kind} at {forcing}: {json}");
            assert_eq!(share > 0.0, lasting.contains(kind), "{kind} at {forcing}: {json}");
            assert!(low <= share && share <= high && high - low < 0.1, "{json}");
        }
    }
}

#[test]
fn rows_of_basins_do_not_depend_on_which_are_asked_for_together() {
    let mut explorer = Explorer::new();
    let whole = ask(&basins([0, 20]));
    let mut labels = Vec::new();
    for rows in [[0, 1], [1, 13], [13, 20]] {
        labels.extend_from_slice(&explorer.respond(&basins(rows).to_string()).bytes);
        // Another map in between: its attractors are not taken for those of this one.
        explorer.respond(r#"{"call": "attractors", "axial_forcing": 0.35, "restitution": 0.5}"#);
    }
    assert_eq!((whole.bytes.len(), &whole.bytes), (600, &labels));
    let (json, _) = answered(&json!({ "call": "attractors", "axial_forcing": 0.486, "restitution": 0.5 }));
    let known: Vec<_> = list(&json, "attractors").iter().map(|one| one["label"].as_u64()).collect();
    assert!(labels.iter().all(|label| *label == 0 || known.contains(&Some(u64::from(*label)))));
    let shares = list(&json, "attractors").iter().map(|one| number(one, "share"));
    let sum = shares.sum::<f64>() + number(&json, "undecided");
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
}

type Lines = Vec<Vec<[f64; 6]>>;

/// The branches in a window: how many, kinds and forcings of their bifurcations, and the rows of each line.
fn branches_in(restitution: f64, window: [f64; 2]) -> (f64, Vec<(String, f64)>, Lines) {
    let request = json!({ "call": "branches", "restitution": restitution, "axial_forcing": window });
    let (json, reply) = answered(&request);
    let bifurcations = list(&json, "bifurcations").iter();
    let bifurcations = bifurcations
        .map(|one| (one["kind"].as_str().expect("a word").to_owned(), number(one, "axial_forcing")))
        .collect();
    let mut lines = Lines::new();
    for row in reply.numbers.chunks(6) {
        if row[5] as usize == lines.len() {
            lines.push(Vec::new());
        }
        let row: [f64; 6] = row.try_into().expect("six columns");
        lines.get_mut(row[5] as usize).expect("the lines follow each other").push(row);
    }
    (number(&json, "branches"), bifurcations, lines)
}

#[test]
fn branches_go_through_the_doublings_of_the_cascade() {
    let (branches, found, lines) = branches_in(0.5, [0.3, 0.62]);
    let is_there = |kind: &str, wanted: f64| {
        found.iter().any(|(known, forcing)| known == kind && (forcing - wanted).abs() < 1e-9)
    };
    // Birth at (1 - r)/(1 + r), and the first doubling in closed form.
    assert!(is_there("fold", 1.0 / 3.0), "{found:?}");
    let first = bouncing_disk::core::ImpactMap::first_doubling_forcing(0.5);
    assert!(is_there("doubling", first), "{found:?}");
    for row in lines.iter().flatten() {
        let stable = [0.0, 1.0].map(f64::to_bits).contains(&row[4].to_bits());
        assert!((0.3..=0.62).contains(&row[0]) && row[3] < branches && stable, "{row:?}");
    }
    assert!(branches_in(0.5, [0.1, 0.2]).0 < 0.5);
    for restitution in [0.0, 0.5, 0.999999] {
        for window in [[60.0, 60.1], [1e-3, 1e-2], [99.0, 100.0], [0.45, 0.45 + 1e-12], [0.7, 0.7 + 1e-12]] {
            let (_, _, lines) = branches_in(restitution, window);
            let is_inside = |row: &[f64; 6]| (window[0]..=window[1]).contains(&row[0]);
            assert!(lines.iter().flatten().all(is_inside), "{restitution} {window:?}");
        }
    }
}

#[test]
fn the_same_branches_are_seen_whichever_window_looks_at_them() {
    let (_, all, _) = branches_in(0.5, [0.3, 0.62]);
    for window in [[0.33, 0.34], [0.485, 0.4861], [0.49, 0.53], [0.54, 0.62], [0.5421, 0.5426]] {
        let (_, here, lines) = branches_in(0.5, window);
        let wanted: Vec<_> =
            all.iter().filter(|(_, forcing)| (window[0]..=window[1]).contains(forcing)).collect();
        assert_eq!(here.len(), wanted.len(), "{window:?}: {here:?}");
        for ((kind, forcing), (known, there)) in here.iter().zip(wanted) {
            assert!(kind == known && (forcing - there).abs() < 1e-12, "{window:?}: {kind} at {forcing}");
        }
        // Each line is a curve: no step of it is wider than a few pixels of a screen.
        let width = window[1] - window[0];
        for line in lines {
            for pair in line.windows(2) {
                assert!((pair[1][0] - pair[0][0]).abs() < 0.05 * width, "{window:?}: {pair:?}");
            }
        }
    }
    // Throughout: two impacts that attract, one orbit of one impact that does not, the saddle of the pair.
    let (_, _, lines) = branches_in(0.5, [0.49, 0.53]);
    let all = |stable: bool| {
        let is_so = |line: &&Vec<[f64; 6]>| line.iter().all(|row| (row[4] > 0.5) == stable);
        let is_through = |line: &&Vec<[f64; 6]>| (line[0][0] - line[line.len() - 1][0]).abs() > 0.04 - 1e-12;
        lines.iter().filter(is_through).filter(is_so).count()
    };
    assert_eq!((all(true), all(false), lines.len()), (2, 2, 4));
    // Right at a doubling, between two points of a branch, and where there is hardly one left.
    for (window, count) in [([0.48600, 0.48601], 4), ([0.45, 0.45 + 1e-12], 2), ([60.0, 60.1], 3)] {
        assert_eq!(branches_in(0.5, window).2.len(), count, "{window:?}");
    }
}

#[test]
fn an_orbit_is_judged_as_by_the_library() {
    let judged = |forcing: f64| {
        answered(&json!({ "call": "orbit", "axial_forcing": forcing, "restitution": 0.5, "start": start() }))
            .0
    };
    let kinds = [0.45, 0.553, 0.62, 0.2].map(|forcing| judged(forcing)["kind"].clone());
    assert_eq!(kinds, ["periodic", "chaotic", "chattering", "at-rest"]);
    // Two impacts: each has half of the logarithm.
    let two = judged(0.5);
    let [real, imaginary] = ["/multipliers/0/0", "/multipliers/0/1"].map(|part| number(&two, part));
    let logarithm = 0.5 * ln(real * real + imaginary * imaginary);
    let exponent = number(&two, "exponent");
    assert!((exponent - logarithm / 2.0).abs() < 1e-12 && exponent < 0.0, "{two}");
    assert_eq!((&two["impacts"], &two["exponent_error"]), (&json!(2), &Value::Null));
}

fn loads(sheet: &Value, load_torques: &[f64]) -> Value {
    json!({ "call": "motor_loads", "sheet": sheet, "load_torques": load_torques, "relative_error": 0.2, "seed": 1 })
}

fn run_up(sheet: &Value, rise_times: f64) -> Value {
    json!({ "call": "motor_transient", "sheet": sheet, "members": 4, "rise_times": rise_times, "points": 20, "seed": 1 })
}

fn stall(sheet: &Value) -> Value {
    json!({ "call": "motor_stall", "sheet": sheet, "relative_error": 0.3, "seed": 1 })
}

fn report(sheet: &Value) -> Value {
    answered(&json!({ "call": "motor_report", "sheet": sheet })).0
}

#[test]
fn a_motor_is_that_of_its_sheet() {
    let report = report(&sheet());
    assert_eq!((&report["mass"], &report["system"]["friction"]), (&json!(1e-3), &json!(0.1)));
    let largest = number(&report, "largest_torque");
    let (json, reply) = answered(&loads(&sheet(), &[0.0, 0.3 * largest, 2.0 * largest]));
    let statuses: Vec<_> = reply.numbers.chunks(10).map(|row| row[9]).collect();
    assert_eq!((statuses.len(), statuses[2]), (3, 2.0));
    let text = json["shortfalls"][2].as_str().expect("a text");
    assert!(text.starts_with("the load drives the rotor: friction holds 1.225e-6 N m at most"), "{text}");
    assert!(reply.numbers[1] > reply.numbers[11]);
    assert_eq!(answered(&run_up(&sheet(), 3.0)).1.numbers.len(), 60);
    let (json, _) = answered(&stall(&sheet()));
    assert!(number(&json, "torque") > 0.0 && number(&json, "no_load_speed") > 0.0);
    // Without any twist of the stator.
    let (none, _) = answered(&stall(&with(sheet(), json!({ "peak_angular_speed": 0.0 }))));
    assert!(none["torque"].is_null() && number(&none, "no_load_speed").abs() < 1e-9, "{none}");
}

#[test]
fn the_form_of_a_run_up_is_said_and_one_without_a_time_constant_is_told_as_such() {
    let run = |changes: Value, rise_times: f64| {
        let longer = json!({ "members": 8, "points": 120 });
        answered(&with(run_up(&with(sheet(), changes), rise_times), longer)).0
    };
    let usual = run(json!({}), 6.0);
    let (rise, constant) = (&usual["rise"], &usual["rise"]["constant"]);
    assert_eq!((&rise["form"], &usual["refusal"]), (&json!("exponential"), &Value::Null));
    let interval = ["low", "value", "high"].map(|name| number(constant, name));
    assert!(interval.is_sorted() && interval[0] < interval[2] && number(rise, "residual") > 0.0, "{rise}");
    // A plastic rotor repeats the same impulses, and speeds up on a straight line.
    assert_eq!(run(json!({ "restitution": 0.0 }), 6.0)["rise"]["form"], "ramp");
    // Under more than friction can hold, and as long as the speed rises, no form is that of the run-up.
    for none in [run(json!({ "load_torque": 2e-6 }), 6.0), run(json!({}), 0.5)] {
        assert!(none["rise"].is_null() && none["refusal"].is_string(), "{none}");
    }
}

#[test]
fn a_trap_is_told_if_a_preload_can_meet_it() {
    let trap = |changes: Value| report(&with(sheet(), changes))["trap"].clone();
    // All traps of this motor are narrower than any amplitude is known.
    assert_eq!(trap(json!({ "amplitude": 1e-9 })), Value::Null);
    let near = trap(json!({ "preload_acceleration": 9.7973 }));
    let [from, to] = ["/forcing_from_to/0", "/forcing_from_to/1"].map(|end| number(&near, end));
    assert!(to - from > 5e-4 * to && near["caught"] == false, "{near}");
    // A little beyond the near edge.
    let inside = trap(json!({ "preload_acceleration": 1.0002 * number(&near, "preload_acceleration") }));
    assert_eq!((&inside["caught"], number(&inside, "relative_distance")), (&json!(true), 0.0), "{inside}");
}

#[test]
fn a_sheet_that_is_written_is_read_again() {
    let soft = with(sheet(), json!({ "contact": { "time": 2e-5 } }));
    let (written, _) = answered(&json!({ "call": "sheet_write", "sheet": soft }));
    let (read, _) = answered(&json!({ "call": "sheet_read", "text": written["text"] }));
    assert_eq!(read["system"]["contact_time"], 2e-5);
    assert_eq!(read["sheet"]["peak_angular_speed"], 30.0);
    let (of_system, _) =
        answered(&json!({ "call": "sheet_of_system", "system": read["system"], "mass": read["mass"] }));
    assert_eq!(of_system["sheet"]["friction"], 0.1);
    assert_eq!(of_system["sheet"]["contact"]["time"], 2e-5);
    let hysteretic = with(soft, json!({ "contact": { "time": 2e-5, "law": "hysteresis" } })).to_string();
    let varies = with(sheet(), json!({ "load": { "speeds": [0.0], "torques": [1e-6] } })).to_string();
    for text in ["", "{}", "[]", "{\"friction\": 1}", &hysteretic, &varies] {
        refused(&json!({ "call": "sheet_read", "text": text }));
    }
}

/// Motors whose stator yields or whose contacts take time, by their sheets: the library's numbers.
#[test]
fn soft_motors_are_those_of_the_library() {
    let stator = json!({ "kind": "axial", "mass": 0.05, "quality": 300.0 });
    let yielding = with(sheet(), json!({ "amplitude": 1e-7, "stator": stator }));
    let soft = with(sheet(), json!({ "contact": { "time": 1e-5 } }));
    for (own, most_impacts) in [(&yielding, 1000), (&soft, 5_000_000)] {
        let (read, _) = answered(&json!({ "call": "sheet_read", "text": own.to_string() }));
        let motor = Motor::from_json(&own.to_string()).expect("legal");
        // The page's few impacts are shared by a quarter of the members.
        let mut settings = OperatingSettings { relative_error: 0.2, seed: 1, ..OperatingSettings::default() };
        (settings.members, settings.most_impacts) = (4, most_impacts / 4);
        let driven =
            DrivenMotor::where_needed(motor, &DriveParameters::default()).expect("legal").expect("soft");
        let known = driven.torque_speed_curve(&[0.0], &settings, &Unobserved).expect("runs");
        let point = known[0].point().expect("no load drives it");
        let (json, reply) =
            answered(&with(loads(&read["sheet"], &[0.0]), json!({ "most_impacts": most_impacts })));
        assert_eq!(bits(&reply.numbers[1..3]), bits(&[point.speed.value, point.speed.standard_error]));
        let amplitude = point.stator.map(|stator| stator.amplitude.value);
        assert_eq!(json["amplitudes"][0].as_f64(), amplitude);
        assert_eq!(amplitude.is_some(), own["stator"].is_object());
        let refusal = refused(&stall(own))["message"].to_string();
        assert!(refusal.contains("bouncing-disk motor stall"), "{refusal}");
        if let Some(text) = motor.stator_report() {
            assert_eq!(
                (&report(own)["yields"], &report(own)["text"]),
                (&json!(true), &json!(text.to_string()))
            );
        }
    }
    let report = report(&soft);
    assert_eq!((&report["contact"][0][1], &report["trap"]), (&json!("0.7 (contacts take it)"), &Value::Null));
    let [hard, slow] = [&sheet(), &soft].map(|own| answered(&run_up(own, 0.2)).1.numbers[58]);
    assert!((slow - hard).abs() > 0.1, "{slow} {hard}");
}

/// Soft hands by the engine against the single toss of Sec. III.
#[test]
fn contacts_that_take_time_are_those_of_the_library() {
    let toss = System::pizza_toss();
    let hands = with(with(json!(toss.platform()), json!(toss.disk())), json!({ "contact_time": 0.03 }));
    let rest = with(at_rest(), json!({ "impact_phase": TOSS_START }));
    let (json, reply) = answered(&with(motion(rest, 2), json!({ "system": hands })));
    let platform = DrivenPlatform::from(*toss.platform()).with_contact(Some((ContactLaw::Damper, 0.03)));
    let start = Phase::new(TOSS_START).expect("finite");
    let known = single_toss(&platform, toss.disk(), start, InitialSpin::AbsoluteRest).expect("leaves");
    let separation = list(&json, "event_kinds").iter().position(|kind| kind == "separation");
    let mut events = reply.numbers[9 * 121..].chunks(6).zip(&reply.bytes[121..]);
    let (row, _) = events.find(|(_, kind)| Some(usize::from(**kind)) == separation).expect("leaves");
    assert_eq!(bits(&[row[1], row[4]]), bits(&[known.separation_phase, known.airborne_speed]));
    assert!(reply.numbers[..9 * 121].chunks(9).any(|row| row[1] < row[5] - 1e-3), "the hand yields");
    for (time, said) in [(-0.1, "contact.time = -0.1"), (1e4, "contact time = 150000")] {
        let refusal =
            refused(&check(with(hands.clone(), json!({ "contact_time": time }))))["message"].to_string();
        assert!(refusal.contains(said), "{refusal}");
    }
    assert_eq!(answered(&check(hands)).0["contact"][0][1], "0.0716 (contacts take it)");
}

#[test]
fn what_is_of_rigid_impacts_refuses_a_contact_time() {
    let map = json!({ "axial_forcing": 0.486, "restitution": 0.5, "contact_periods": 0.1 });
    let system = with(pizza(), json!({ "contact_time": 0.03 }));
    for request in [
        with(diagram([0, 40], true), json!({ "system": system })),
        with(map.clone(), json!({ "call": "orbit", "start": start() })),
        with(map.clone(), json!({ "call": "attractors" })),
        with(basins([0, 20]), map),
    ] {
        assert!(refused(&request)["message"].to_string().contains("rigid impacts"), "{request}");
    }
    let vertical = |time: f64| {
        let system = with(pizza(), json!({ "contact_time": time }));
        answered(&with(diagram([0, 40], false), json!({ "system": system }))).1.numbers
    };
    assert_eq!(bits(&vertical(1e-8)), bits(&vertical(0.0)), "too short to matter");
    assert_ne!(bits(&vertical(0.03)), bits(&vertical(0.0)));
}
