//! Answers to requests: what a page relies on, and every seam of what it may ask.

use std::f64::consts::TAU;

use bouncing_disk::core::numerics::elementary::ln;
use bouncing_disk::core::{Phase, Unobserved};
use bouncing_disk::driven;
use bouncing_disk::motor::OperatingSettings;
use bouncing_disk::parameters::{ContactLaw, DrivenPlatform};
use bouncing_disk::toss::{InitialSpin, TOSS_START, single_toss};
use bouncing_disk::{Motor, System};
use bouncing_disk_web::{Explorer, Reply, branches_over_forcing};
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

/// A change of the system, or of the sheet, of a request.
fn system(changes: Value) -> Value {
    json!({ "system": with(pizza(), changes) })
}

fn motor(changes: Value) -> Value {
    json!({ "sheet": with(sheet(), changes) })
}

/// The map of this forcing.
fn forced(axial_forcing: f64) -> Value {
    json!({ "map": { "axial_forcing": axial_forcing, "restitution": 0.5 } })
}

/// The disk lies on the platform.
fn at_rest() -> Value {
    json!({ "kind": "impact", "impact_phase": 0.0, "normalised_speed": 0.0, "angular_speed": 0.0 })
}

/// A legal request, with changes.
fn request(call: &str, changes: Value) -> Value {
    let map = forced(0.486);
    let start = json!({ "impact_phase": 1.2, "normalised_speed": 1.3 });
    let usual = match call {
        "check" => with(system(json!({})), json!({ "mass": 0.4 })),
        "toss" => system(json!({})),
        "motion" => json!({ "system": pizza(), "start": at_rest(), "periods": 3, "samples_per_period": 60 }),
        "diagram" => json!({
            "system": pizza(), "axial_forcing": [0.3, 0.62], "count": 40, "columns": [0, 40], "start": start,
            "transient": 300, "recorded": 20
        }),
        "orbit" => with(map, json!({ "start": start })),
        "attractors" => map,
        "basins" => with(
            map,
            json!({
                "phase_periods": [0.0, 1.0], "phases": 30, "normalised_speed": [0.0, 3.0], "speeds": 20, "rows": [0, 20]
            }),
        ),
        "motor_loads" => {
            json!({
                "sheet": sheet(), "load_torques": [0.0], "relative_error": 0.2, "most_impacts": 1000, "seed": 1
            })
        }
        "motor_transient" => {
            json!({ "sheet": sheet(), "members": 4, "rise_times": 3.0, "points": 20, "seed": 1 })
        }
        "motor_stall" => json!({ "sheet": sheet(), "relative_error": 0.3, "seed": 1 }),
        _ => json!({}),
    };
    with(with(usual, json!({ "call": call })), changes)
}

fn ask(call: &str, changes: Value) -> Reply {
    Explorer::new().respond(&request(call, changes).to_string())
}

fn answered(call: &str, changes: Value) -> (Value, Reply) {
    let reply = ask(call, changes);
    assert!(!reply.refused, "{call}: {}", reply.json);
    (serde_json::from_str(&reply.json).expect("JSON"), reply)
}

fn refused(call: &str, changes: Value) -> Value {
    let reply = ask(call, changes);
    assert!(reply.refused && reply.numbers.is_empty() && reply.bytes.is_empty(), "{call}: {}", reply.json);
    serde_json::from_str(&reply.json).expect("JSON")
}

/// A number of an answer, by a JSON pointer; it must be there.
fn number(json: &Value, name: &str) -> f64 {
    let found = if name.starts_with('/') { json.pointer(name) } else { json.get(name) };
    found.and_then(Value::as_f64).unwrap_or_else(|| panic!("{name} of {json}"))
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

#[test]
fn what_follows_from_a_system_is_told() {
    let (summary, _) = answered("check", json!({}));
    let forcing = 0.13 * 225.0 / (std::f64::consts::PI * 9.8);
    assert!((number(&summary, "axial_forcing") - forcing).abs() < 1e-15);
    assert_eq!(summary["bounces"], true);
    let (summary, _) = answered("check", system(json!({ "friction": 0.0, "amplitude": 0.0 })));
    assert_eq!((&summary["angular_forcing"], &summary["rise_time"]), (&Value::Null, &Value::Null));
    assert_eq!(summary["bounces"], false);
}

#[test]
fn what_is_set_is_set_one_after_the_other() {
    let checked = |set: Value| answered("check", system(json!({ "set": set }))).0;
    let quantities = ["axial_forcing", "stroke", "amplitude_angle", "contact_periods"];
    for (name, value) in quantities.into_iter().zip([0.45, 0.3, 1.2, 0.25]) {
        let summary = checked(json!([["friction", 0.3], [name, value]]));
        assert!((number(&summary, name) - value).abs() < 1e-15, "{summary}");
        assert_eq!(summary["system"]["friction"], 0.3);
    }
    let [slow, fast] = [
        json!([["angular_frequency", 30.0], ["axial_forcing", 0.45]]),
        json!([["axial_forcing", 0.45], ["angular_frequency", 30.0]]),
    ]
    .map(|set| number(&checked(set), "axial_forcing"));
    assert!((slow - 0.45).abs() < 1e-15 && (fast - 1.8).abs() < 1e-14, "{slow} {fast}");
    let (own, _) = answered("check", json!({}));
    let [orbit, other] =
        [json!(own["system"]), json!({ "axial_forcing": own["axial_forcing"], "restitution": 0.5 })]
            .map(|map| answered("orbit", json!({ "map": map })).0);
    assert_eq!(orbit["kind"], other["kind"]);
}

#[test]
fn what_is_no_request_is_told() {
    let deep = "[".repeat(100_000);
    // JavaScript writes a number that is none, or infinite, as null.
    let wrong = [json!({ "colour": 1.0 }), json!({ "friction": null })];
    let [colour, none] = wrong.map(|wrong| request("check", system(wrong)).to_string());
    let set = request("check", system(json!({ "set": [["colour", 1.0]] }))).to_string();
    for text in [
        "",
        "null",
        "{}",
        r#"{"call": "nothing"}"#,
        r#"{"call": "check"}"#,
        "\0",
        &deep,
        &colour,
        &none,
        &set,
    ] {
        let reply = Explorer::new().respond(text);
        assert!(reply.refused && reply.json.contains("\"kind\":\"request\""), "{}", reply.json);
    }
}

/// A value out of its range, with the name under which the form shows that, and the value in the sentence.
#[test]
fn a_value_out_of_its_range_is_named() {
    let set = |name: &str, value: f64| system(json!({ "set": [[name, value]] }));
    let samples = |periods: u64, samples: u64| json!({ "periods": periods, "samples_per_period": samples });
    let under = json!({ "kind": "flight", "phase": 0.0, "gap": -0.3, "relative_velocity": 0.0, "angular_speed": 0.0 });
    let negative = json!({ "system": pizza(), "mass": 1.0, "stator": { "mass": -1.0 } });
    let branches = |epsilon: f64, range: [f64; 2]| json!({ "restitution": epsilon, "axial_forcing": range });
    for (call, changes, quantity, value) in [
        ("check", system(json!({ "restitution": 1.5 })), "restitution", "1.5"),
        ("check", system(json!({ "amplitude": -1.0 })), "amplitude", "-1"),
        ("check", system(json!({ "angular_frequency": 0.0 })), "angular_frequency", "0"),
        ("check", system(json!({ "contact_time": -0.1 })), "contact.time", "-0.1"),
        ("check", system(json!({ "contact_time": 1e4 })), "contact time", "150000"),
        ("check", json!({ "mass": 0.0 }), "mass", "0"),
        ("check", set("axial_forcing", 4e7), "axial_forcing", "40000000"),
        ("check", set("contact_periods", 2e3), "contact_periods", "2000"),
        ("check", set("amplitude_angle", 2.0), "amplitude_angle", "2"),
        ("check", set("restitution", 2.0), "restitution", "2"),
        ("motion", samples(0, 60), "periods", "0"),
        ("motion", samples(200_000, 1), "periods", "200000"),
        ("motion", samples(u64::MAX, u64::MAX), "periods", "1.844674"),
        ("motion", samples(100_000, 100_000), "samples", "10000000001"),
        ("motion", samples(3, 0), "samples", "1"),
        ("motion", json!({ "start": under }), "gap", "-"),
        ("diagram", json!({ "columns": [3, 2] }), "columns", "2"),
        ("diagram", json!({ "columns": [0, 41] }), "columns", "41"),
        ("diagram", json!({ "count": 1 }), "count", "1"),
        ("diagram", json!({ "recorded": u32::MAX }), "recorded", "4294967295"),
        ("diagram", json!({ "patience": 10_000_000 }), "patience", "10000000"),
        ("basins", json!({ "rows": [5, 4] }), "rows", "4"),
        ("basins", json!({ "rows": [0, 21] }), "rows", "21"),
        ("branches", branches(0.5, [0.6, 0.3]), "high end of a continuation", "0.3"),
        ("branches", branches(1.5, [0.3, 0.6]), "restitution", "1.5"),
        ("motor_loads", json!({ "most_impacts": 30_000_000 }), "most_impacts", "30000000"),
        ("motor_transient", json!({ "members": 0 }), "members", "0"),
        ("motor_transient", json!({ "points": 1 }), "intervals", "1"),
        ("motor_transient", json!({ "rise_times": -1.0 }), "duration", "-"),
        ("sheet_of_system", json!({ "system": pizza(), "mass": 0.0 }), "mass", "0"),
        ("sheet_of_system", negative, "stator.mass", "-1"),
    ] {
        let refusal = refused(call, changes);
        assert_eq!((&refusal["kind"], &refusal["quantity"]), (&json!("out-of-range"), &json!(quantity)));
        let told = |name: &str| refusal[name].as_str().unwrap_or_default();
        assert!(told("message").contains(value) && !told("range").is_empty(), "{refusal}");
    }
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let (late, soft) =
        (json!({ "contact_time": 0.03 }), json!({ "map": with(pizza(), json!({ "contact_time": 0.03 })) }));
    let text = |changes: Value| json!({ "text": with(sheet(), changes).to_string() });
    let hysteretic = json!({ "contact": { "time": 2e-5, "law": "hysteresis" } });
    let varies = json!({ "load": { "speeds": [0.0], "torques": [1e-6] } });
    for (call, changes, said) in [
        ("toss", system(json!({ "amplitude": 0.03 })), "never"),
        ("toss", system(late.clone()), "computation"),
        ("diagram", json!({ "rotation": true, "drive": "triangle" }), "the sine of Eq. (1)"),
        ("diagram", with(system(late), json!({ "rotation": true })), "rigid impacts"),
        ("orbit", soft.clone(), "rigid impacts"),
        ("attractors", soft.clone(), "rigid impacts"),
        ("basins", soft, "rigid impacts"),
        ("motor_report", motor(json!({ "twist_amplitude": 1e-4 })), "twist_amplitude"),
        ("sheet_read", json!({ "text": "" }), "text"),
        ("sheet_read", json!({ "text": "{}" }), "text"),
        ("sheet_read", json!({ "text": "[]" }), "text"),
        ("sheet_read", json!({ "text": "{\"friction\": 1}" }), "text"),
        ("sheet_read", text(hysteretic), "hysteresis"),
        ("sheet_read", text(varies), "a table [load]"),
    ] {
        let refusal = refused(call, changes).to_string();
        assert!(refusal.contains(said), "{call}: {refusal}");
    }
}

#[test]
fn a_longer_motion_begins_like_a_shorter_one() {
    let motion =
        |start: &Value, periods: u64| answered("motion", json!({ "start": start, "periods": periods }));
    for start in [
        json!({ "kind": "impact", "impact_phase": 1.2, "normalised_speed": 1.3, "angular_speed": 0.0 }),
        json!({ "kind": "flight", "phase": 0.0, "gap": 0.3, "relative_velocity": 1.0, "angular_speed": -2.0 }),
    ] {
        let ((short, few), (long, many)) = (motion(&start, 3), motion(&start, 12));
        let events = number(&short, "events") as usize;
        assert_eq!((&short["samples"], &long["samples"]), (&json!(181), &json!(721)));
        assert_eq!((few.numbers.len(), few.bytes.len()), (9 * 181 + 6 * events, 181 + events));
        assert_eq!(few.numbers[..9 * 181], many.numbers[..9 * 181]);
        assert_eq!(few.bytes[..181], many.bytes[..181]);
        let (own, others) = (&few.numbers[9 * 181..], &many.numbers[9 * 721..]);
        assert_eq!(bits(own), bits(&others[..own.len()]));
        // Twelve periods take the time that they take, and the disk is never under the platform.
        let last = many.numbers[9 * 720];
        assert!((last - 12.0 * TAU / 15.0).abs() < 1e-12, "{last}");
        assert!(many.numbers[..9 * 721].chunks(9).all(|row| row[1] >= row[5] - 1e-12));
    }
    let (_, still) = answered("motion", system(json!({ "amplitude": 0.0 })));
    assert!(still.numbers[..9 * 181].chunks(9).all(|row| row[1].to_bits() == row[5].to_bits()));
}

/// However a motion is cut off, as in a contact that does not end: the balance is that of the instant.
#[test]
fn energy_is_balanced_at_the_end_of_any_motion() {
    // The disk bounces, rests between its flights, or slides until it sticks for ever.
    let motions = [(0.06, [0.4, 1.4, 3.0]), (0.06, [4.7, 0.0, 3.0]), (0.02, [0.0, 0.0, 300.0])];
    let cases = (1_u64..30).flat_map(|periods| {
        [0.0, 0.03].into_iter().flat_map(move |time| motions.map(|motion| (periods, time, motion)))
    });
    for (periods, time, (amplitude, [impact_phase, speed, spin])) in cases {
        let changes = json!({
            "amplitude": amplitude, "twist_amplitude": 0.1, "load_acceleration": 0.5, "contact_time": time
        });
        let start = json!({ "kind": "impact", "impact_phase": impact_phase, "normalised_speed": speed, "angular_speed": spin });
        let changes = system(changes);
        let request = with(changes.clone(), json!({ "start": start, "periods": periods }));
        let (json, reply) = answered("motion", request);
        let energy = |name: &str| number(&json["energy"], name);
        let lost = energy("restitution_loss") + energy("friction_loss");
        // Beside what rounding makes of numbers of this size.
        let size = energy("platform_work").abs() + lost + energy("stored").abs();
        let gone = lost + energy("load_work") + energy("stored");
        assert!((energy("platform_work") - gone).abs() < 1e-12 * size, "{periods} {json}");
        assert!(energy("load_work") != 0.0, "{json}");
        let of = |name: &str| number(&changes["system"], name);
        let rotary = |row: &[f64]| of("gyration_radius") * of("gyration_radius") * row[4] * row[4];
        let held = |row: &[f64]| 0.5 * (row[3] * row[3] + rotary(row)) + of("preload_acceleration") * row[1];
        // The impact at the start is before it.
        let mut rows = reply.numbers[..9 * number(&json, "samples") as usize].chunks(9);
        let (first, last) = (rows.next().expect("a sample"), rows.next_back().expect("another"));
        // Only a rigid contact, and one that is open, has no energy in its spring.
        let stored = held(last) - held(first);
        let open = time == 0.0 || speed > 0.0 && last[1] > last[5];
        assert!(!open || (stored - energy("stored")).abs() < 1e-9 * size, "{periods} {json}");
    }
}

#[test]
fn columns_do_not_depend_on_which_are_asked_for_together() {
    let diagram = |changes: Value| answered("diagram", changes).1;
    for rotation in [false, true] {
        let all = diagram(json!({ "rotation": rotation }));
        let mut parts = Vec::new();
        for columns in [[0, 7], [7, 8], [8, 39], [39, 40]] {
            parts.extend(diagram(json!({ "rotation": rotation, "columns": columns })).numbers);
        }
        assert_eq!(bits(&all.numbers), bits(&parts));
        assert_eq!(all.numbers.chunks(4).all(|row| row[3].is_nan()), !rotation);
    }
    // The rotation does not act back on the vertical motion: the same impacts, in the same order.
    let without = diagram(json!({}));
    let vertical =
        |reply: &Reply| reply.numbers.chunks(4).flat_map(|row| bits(&row[..3])).collect::<Vec<_>>();
    assert_eq!(vertical(&without), vertical(&diagram(json!({ "rotation": true }))));
    // Another motion of the platform has other impacts, and so have contacts that take time.
    for other in [json!({ "drive": "triangle" }), system(json!({ "contact_time": 0.03 }))] {
        let other = diagram(other);
        assert!(other.numbers.len() > 3000 && vertical(&other) != vertical(&without));
    }
    for same in [json!({ "drive": "sine" }), system(json!({ "contact_time": 1e-8 }))] {
        assert_eq!(diagram(same).digest, without.digest);
    }
}

/// The two spins of an orbit of two impacts that slides in both, at Gamma_T = 100, need some 400 impacts.
#[test]
fn columns_are_followed_until_they_have_settled() {
    let unit = number(&answered("check", json!({})).0, "angular_forcing");
    let fast = system(json!({ "phase_lag": 0.0, "twist_amplitude": 100.0 / unit }));
    let patient = json!({ "patience": 3000, "recorded": 200 });
    for (forcing, spins) in [(0.51, [0.9028, 0.9219]), (0.53, [0.9495, 0.9683])] {
        let one = json!({
            "axial_forcing": [forcing, forcing + 1e-9], "recorded": 200, "count": 2, "columns": [0, 1], "rotation": true
        });
        let one = with(fast.clone(), one);
        let (json, _) = answered("diagram", one.clone());
        assert_eq!((&json["unsettled"], &json["left_out"]), (&json!(1), &json!(300)));
        let (json, reply) = answered("diagram", with(one, patient.clone()));
        assert_eq!(json["unsettled"], 0, "{json}");
        assert!((500.0..2000.0).contains(&number(&json, "left_out")), "{json}");
        let is_one = |row: &[f64]| spins.iter().any(|spin| (row[3] - spin).abs() < 1e-4);
        assert!(reply.numbers.chunks(4).all(is_one), "{forcing}");
    }
    // Near a doubling no patience suffices, and the answer says so.
    assert!(number(&answered("diagram", patient.clone()).0, "unsettled") <= 1.0);
    let (json, _) = answered("diagram", with(patient, json!({ "axial_forcing": [0.486, 0.48601] })));
    assert_eq!((&json["unsettled"], &json["left_out"]), (&json!(40), &json!(3000)));
    // Without friction or twist there is no spin, and no rounding of one.
    for idle in [json!({ "friction": 0.0 }), json!({ "twist_amplitude": 0.0 })] {
        let (_, reply) = answered("diagram", with(system(idle), json!({ "rotation": true })));
        assert!(!reply.numbers.is_empty() && reply.numbers.chunks(4).all(|row| row[3].is_nan()));
    }
}

#[test]
fn a_single_toss_is_that_of_the_library() {
    let own = System::pizza_toss();
    let (json, _) = answered("toss", system(with(json!(own.platform()), json!(own.disk()))));
    assert_eq!(json, json!(single_toss(&own, InitialSpin::AbsoluteRest).expect("thrown")));
}

#[test]
fn shares_of_kinds_are_those_of_the_attractors_that_starts_end_on() {
    // At 0.51 a disk at rest is thrown onto a periodic orbit, whose share has that of the rest.
    let known = [(0.45, "rest periodic"), (0.55, "rest chaotic"), (0.2, "rest"), (0.51, "periodic chaotic")];
    for (forcing, lasting) in known {
        let (json, _) = answered("attractors", forced(forcing));
        let all = json["attractors"].as_array().expect("a list");
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

/// The page numbers the list from one.
#[test]
fn the_text_of_a_rest_names_the_place_of_its_target_in_the_list() {
    let (json, _) = answered("attractors", forced(0.51));
    let rest = &json["attractors"][0];
    let place = 1 + rest["leads_to"].as_u64().expect("it does not last");
    assert_eq!(rest["text"], format!("comes to rest, then attractor {place}"));
}

/// The page's labels of the motors of Fig. 12 at their printed amplitudes.
#[test]
fn the_motors_of_fig_12_are_called_what_they_are() {
    let words = include_str!("../page/src/words.json");
    let words: Value = serde_json::from_str(words).expect("JSON");
    let labels = words["presets"]["fig12"]["panels"].as_array().expect("a list");
    let motors = [(1e-7, 0.5), (1e-8, 1.0)];
    assert_eq!(labels.len(), motors.len());
    for (label, (amplitude, preload)) in labels.iter().zip(motors) {
        let changes = json!({ "amplitude": amplitude, "preload_acceleration": preload });
        let (report, _) = answered("motor_report", motor(changes));
        let (label, regime) = (label.as_str().expect("text"), report["regime"].as_str().expect("text"));
        for kind in ["long", "short"] {
            assert_eq!(label.contains(kind), regime.contains(kind), "{label}: {regime}");
        }
    }
}

#[test]
fn rows_of_basins_do_not_depend_on_which_are_asked_for_together() {
    let mut explorer = Explorer::new();
    let whole = ask("basins", json!({}));
    let mut labels = Vec::new();
    for rows in [[0, 1], [1, 13], [13, 20]] {
        labels.extend(explorer.respond(&request("basins", json!({ "rows": rows })).to_string()).bytes);
        // Another map in between: its attractors are not taken for those of this one.
        explorer.respond(&request("attractors", forced(0.35)).to_string());
    }
    assert_eq!((whole.bytes.len(), &whole.bytes), (600, &labels));
    let (json, _) = answered("attractors", json!({}));
    let all = json["attractors"].as_array().expect("a list");
    let known: Vec<_> = all.iter().map(|one| one["label"].as_u64()).collect();
    assert!(labels.iter().all(|label| *label == 0 || known.contains(&Some(u64::from(*label)))));
    let sum = all.iter().map(|one| number(one, "share")).sum::<f64>() + number(&json, "undecided");
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
}

#[test]
fn the_rows_of_branches_are_those_of_the_library() {
    let branches = branches_over_forcing(0.5, (0.3, 0.62)).expect("legal");
    let (json, reply) = answered("branches", json!({ "restitution": 0.5, "axial_forcing": [0.3, 0.62] }));
    assert_eq!((json["branches"].as_u64(), branches.len() > 3), (Some(branches.len() as u64), true));
    let known = branches.iter().flat_map(|branch| &branch.bifurcations);
    let found = json["bifurcations"].as_array().expect("a list").iter();
    assert!(found.map(|one| number(one, "axial_forcing")).eq(known.map(|one| one.point.parameter)));
    // The impacts of each part one after the other, each along a line of its own.
    let (mut rows, mut line) = (Vec::new(), 0.0);
    for (branch, own) in branches.iter().enumerate() {
        for part in &own.parts {
            for impact in 0..part[0].orbit.period() {
                for point in part.iter().filter(|point| impact < point.orbit.period()) {
                    let (state, stable) = (point.orbit.states[impact], f64::from(point.is_stable()));
                    rows.extend([point.parameter, state.phase().angle(), state.normalised_speed()]);
                    rows.extend([branch as f64, stable, line]);
                }
                line += 1.0;
            }
        }
    }
    assert_eq!(bits(&reply.numbers), bits(&rows));
}

#[test]
fn an_orbit_is_judged_as_by_the_library() {
    let judged = |forcing: f64| answered("orbit", forced(forcing)).0;
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

/// Whether its stator yields or its contacts take time: operations, traps and reports of the library.
#[test]
fn a_motor_is_that_of_its_sheet() {
    let stator = json!({ "kind": "axial", "mass": 0.05, "quality": 300.0 });
    for (changes, most_impacts) in [
        // Next to a trap, and where all traps are narrower than any amplitude is known.
        (json!({ "preload_acceleration": 9.7973 }), 5_000_000),
        (json!({ "amplitude": 1e-9 }), 5_000_000),
        (json!({ "amplitude": 1e-7, "stator": stator }), 1000),
        (json!({ "contact": { "time": 1e-5 } }), 5_000_000),
    ] {
        let own = with(motor(changes), json!({ "most_impacts": most_impacts, "load_torques": [0.0, 1e-6] }));
        let motor = Motor::from_json(&own["sheet"].to_string()).expect("legal");
        let settings =
            OperatingSettings { relative_error: 0.2, seed: 1, most_impacts, ..OperatingSettings::default() };
        let trap = motor.nearest_trap(0.02, &Unobserved).ok();
        let known = motor.torque_speed_curve(&[0.0, 1e-6], &settings, &Unobserved).expect("runs");
        assert_eq!(answered("motor_loads", own.clone()).0, json!(known));
        let (report, _) = answered("motor_report", json!({ "sheet": own["sheet"] }));
        assert_eq!(report["trap"], json!(trap.flatten()));
        assert_eq!(report["yields"], motor.stator().is_some());
        let text = motor.stator_report().map(|text| text.to_string());
        assert_eq!(text.is_some(), motor.stator().is_some());
        assert!(text.is_none_or(|text| report["text"] == text), "{report}");
        assert!(
            report["contact"][0][1] == "0.7 (contacts are compliant)" || own["sheet"]["contact"].is_null()
        );
    }
}

#[test]
fn a_motor_runs_up_and_stalls() {
    let run = |sheet: Value| {
        answered("motor_transient", with(motor(sheet), json!({ "rise_times": 0.2 }))).1.numbers
    };
    let (hard, slow) = (run(json!({})), run(json!({ "contact": { "time": 1e-5 } })));
    assert!(hard.len() == 60 && (slow[58] - hard[58]).abs() > 0.1, "{slow:?} {hard:?}");
    let (json, _) = answered("motor_stall", json!({}));
    assert!(number(&json, "torque") > 0.0 && number(&json, "no_load_speed") > 0.0);
    // Without any twist of the stator.
    let (none, _) = answered("motor_stall", motor(json!({ "peak_angular_speed": 0.0 })));
    assert!(none["torque"].is_null() && number(&none, "no_load_speed").abs() < 1e-9, "{none}");
}

#[test]
fn the_form_of_a_run_up_is_said_and_one_without_a_time_constant_is_told_as_such() {
    let run = |changes: Value, rise_times: f64| {
        let longer = json!({ "members": 8, "points": 120, "rise_times": rise_times });
        answered("motor_transient", with(motor(changes), longer)).0
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
        assert!(none["rise"].is_null() && none["refusal"].is_object(), "{none}");
    }
}

#[test]
fn a_sheet_that_is_written_is_read_again() {
    let stator = json!({ "kind": "axial", "mass": 0.05, "quality": 300.0 });
    let text = with(sheet(), json!({ "contact": { "time": 2e-5 }, "stator": stator })).to_string();
    let (written, _) = answered("sheet_read", json!({ "text": text }));
    let (read, _) = answered("sheet_read", json!({ "text": written["text"] }));
    assert_eq!((&read, &read["system"]["contact_time"]), (&written, &json!(2e-5)));
    assert_eq!(read["sheet"]["peak_angular_speed"], 30.0);
    let system = json!({ "system": read["system"], "mass": read["mass"], "stator": stator });
    let (of_system, _) = answered("sheet_of_system", system);
    assert_eq!(of_system["sheet"]["friction"], 0.1);
    assert_eq!(of_system["sheet"]["contact"]["time"], 2e-5);
    assert_eq!(of_system["sheet"]["stator"], read["sheet"]["stator"]);
}

/// Soft hands by the engine against the single toss of Sec. III.
#[test]
fn contacts_that_take_time_are_those_of_the_library() {
    let toss = System::pizza_toss();
    let hands = with(with(json!(toss.platform()), json!(toss.disk())), json!({ "contact_time": 0.03 }));
    let rest = with(at_rest(), json!({ "impact_phase": TOSS_START }));
    let (json, reply) = answered("motion", json!({ "start": rest, "periods": 2, "system": hands }));
    let platform = DrivenPlatform::from(*toss.platform()).with_contact(Some((ContactLaw::Damper, 0.03)));
    let start = Phase::new(TOSS_START).expect("finite");
    let known =
        driven::single_toss(&platform, toss.disk(), Some(start), InitialSpin::AbsoluteRest).expect("leaves");
    let kinds = json["event_kinds"].as_array().expect("a list");
    let separation = kinds.iter().position(|kind| kind == "separation");
    let mut events = reply.numbers[9 * 121..].chunks(6).zip(&reply.bytes[121..]);
    let (row, _) = events.find(|(_, kind)| Some(usize::from(**kind)) == separation).expect("leaves");
    assert_eq!(bits(&[row[1], row[4]]), bits(&[known.separation_phase, known.airborne_speed]));
    assert!(reply.numbers[..9 * 121].chunks(9).any(|row| row[1] < row[5] - 1e-3), "the hand yields");
    assert_eq!(
        answered("check", json!({ "system": hands })).0["contact"][0][1],
        "0.0716 (contacts are compliant)"
    );
}
