//! The systems that the page opens: those of the paper's figures and tables, and of the lessons.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use bouncing_disk::parameters::Stroke;
use bouncing_disk::{DiskParameters, Motor, Platform, PlatformParameters, System};
use serde_json::{Value, json};

const LEGAL: &str = "the systems of the page are legal";

/// These values in the place of others, or beside them.
fn with(mut table: Value, changes: Value) -> Value {
    for (name, change) in changes.as_object().expect("a table") {
        table[name] = change.clone();
    }
    table
}

/// A change of the state with which the page begins: a view of a system.
fn shown(view: &str, system: &System, more: Value) -> Value {
    let disk = with(json!(system.disk().parameters()), json!({ "contact_time": 0.0 }));
    let system = with(json!(system.platform().parameters()), disk);
    with(json!({ "view": view, "system": system }), more)
}

/// At rest on the platform at its lowest point, where a single toss begins: an impact without speed.
fn rest() -> Value {
    json!({ "impact_phase": 1.5 * PI, "normalised_speed": 0.0, "angular_speed": 0.0 })
}

/// A single toss: the dough lies on the hand at its lowest point.
fn toss(change: impl FnOnce(&mut Stroke, &mut DiskParameters)) -> Value {
    let (mut hand, mut dough) = (Stroke::pizza_toss(), System::pizza_toss().disk().parameters());
    change(&mut hand, &mut dough);
    dough.contact_radius = hand.contact_radius;
    let system = System::new(Platform::from_stroke(hand).expect(LEGAL), dough.build().expect(LEGAL));
    shown("toss", &system.expect(LEGAL), json!({ "start": rest() }))
}

/// That of a stroke with this angle, in multiples of pi, and lag.
fn angled(angle: f64, phase_lag: f64) -> Value {
    toss(|hand, _| (hand.amplitude_angle, hand.phase_lag) = (angle * PI, phase_lag))
}

/// Table I, made to toss again and again with the lag of Fig. 6(d): at this forcing the disk can bounce once in
/// every period, and all views have something to show.
fn usual() -> System {
    let turning =
        System::pizza_toss().with_platform(|hand| (hand.twist_amplitude, hand.phase_lag) = (0.9, -0.26 * PI));
    turning.and_then(|one| one.with_axial_forcing(0.45)).expect(LEGAL)
}

/// The semielliptical motion of Fig. 6(d), Gamma_T = 1.
fn tossing(axial_forcing: f64) -> System {
    usual().with_angular_forcing(1.0).and_then(|one| one.with_axial_forcing(axial_forcing)).expect(LEGAL)
}

/// Tossed again and again, from this start or the first one of the page.
fn bouncing(axial_forcing: f64, start: Option<Value>) -> Value {
    let usual = || json!({ "impact_phase": 0.4, "normalised_speed": 1.4, "angular_speed": 0.0 });
    shown("toss", &tossing(axial_forcing), json!({ "start": start.unwrap_or_else(usual) }))
}

fn diagram(quantity: &str, system: &System, window: [f64; 2], range: Option<[f64; 2]>) -> Value {
    let diagram = json!({ "axial_forcing": window, "quantity": quantity, "range": range });
    shown("diagram", system, json!({ "diagram": diagram }))
}

/// Phases of impacts over the forcing, for a system with the first number as its own.
fn cascade(axial_forcing: f64, window: [f64; 2], range: Option<[f64; 2]>) -> Value {
    diagram("impact_phase", &tossing(axial_forcing), window, range)
}

/// A panel of Fig. 7; the paper does not print its window, and speeds up to 5 give its two shares.
fn basins(axial_forcing: f64) -> Value {
    shown("basins", &tossing(axial_forcing), json!({}))
}

/// The motor of Table III, its rotor at rest, with the mass as the paper prints such numbers: to three digits.
fn motor(change: impl FnOnce(&mut PlatformParameters, &mut DiskParameters)) -> Value {
    let motor = System::motor();
    let (mut stator, mut rotor) = (motor.platform().parameters(), motor.disk().parameters());
    change(&mut stator, &mut rotor);
    let system = System::new(stator.build().expect(LEGAL), rotor.build().expect(LEGAL)).expect(LEGAL);
    let mass = format!("{:.2e}", Motor::paper_70_khz().parameters().mass.expect(LEGAL));
    let mass: f64 = mass.parse().expect("a number");
    shown("motor", &system, json!({ "mass": mass, "start": { "angular_speed": 0.0 } }))
}

/// With this amplitude (m) and preload (m/s^2).
fn pressed(amplitude: f64, preload: f64) -> Value {
    motor(|stator, rotor| (stator.amplitude, rotor.preload_acceleration) = (amplitude, preload))
}

/// At another drive frequency (Hz), with this largest angular speed of the stator (rad/s).
fn driven(frequency: f64, speed: f64, preload: f64) -> Value {
    motor(|stator, rotor| {
        stator.angular_frequency = TAU * frequency;
        stator.twist_amplitude = speed / stator.angular_frequency;
        rotor.preload_acceleration = preload;
    })
}

/// Fig. 9 in slow motion: a platform that all but stands still.
fn braking(preload: f64) -> Value {
    let still = motor(|stator, rotor| {
        (stator.amplitude, stator.twist_amplitude, stator.angular_frequency) = (1e-6, 0.0, 20.0 * PI);
        rotor.preload_acceleration = preload;
    });
    let start = json!({ "impact_phase": 0.0, "normalised_speed": 0.02, "angular_speed": 30.0 });
    with(still, json!({ "view": "toss", "start": start }))
}

/// The panels of every figure and table.
fn panels() -> Value {
    let (doubling, window) = (tossing(0.486), [0.3, 0.65]);
    let slippery = doubling.with_disk(|dough| dough.friction = 0.006).expect(LEGAL);
    let slippery = slippery.with_angular_forcing(100.0).expect(LEGAL);
    let in_phase = slippery.with_platform(|hand| hand.phase_lag = 0.0).expect(LEGAL);
    let rubbed =
        |friction| toss(|hand, dough| (hand.amplitude_angle, dough.friction) = (0.323 * PI, friction));
    let in_steps = |lag| [0.132, 0.323, 0.426].map(|angle| [angled(angle, 0.0), angled(angle, lag)]).concat();
    let (fig05, fig09) = (in_steps(FRAC_PI_2), [9.8, 5.0, 2.4].map(braking));
    let fig07 = [0.34, 0.486, 0.5, 0.55, 0.6].map(basins);
    json!({
        "fig01": [toss(|_, _| {})],
        "fig02": [
            angled(0.25, -FRAC_PI_2), angled(0.25, -FRAC_PI_4), angled(0.25, 0.0), angled(0.05, -FRAC_PI_4),
            angled(0.45, -FRAC_PI_4)
        ],
        "fig03": [bouncing(0.4, Some(rest()))],
        "fig04": [
            angled(0.301, 0.0), angled(0.323, 0.0), toss(|_, _| {}), angled(0.323, FRAC_PI_4),
            angled(0.323, FRAC_PI_2), rubbed(0.5), rubbed(0.7)
        ],
        "fig05": fig05,
        "fig06": [
            diagram("impact_phase", &doubling, window, None), diagram("normalised_speed", &doubling, window, None),
            diagram("angular_speed", &in_phase, window, None), diagram("angular_speed", &doubling, window, None)
        ],
        "fig07": fig07,
        "fig08": [motor(|_, _| {})],
        "fig09": fig09,
        "fig10": [pressed(1e-9, 9.8), pressed(1e-8, 9.8), pressed(1e-7, 9.8)],
        "fig11": [
            driven(70e3, 30.0, 8.51), driven(70e3, 30.0, 2.43), driven(184e3, 30.0, 8.51), driven(184e3, 30.0, 2.43)
        ],
        "fig12": [pressed(1e-7, 0.5), pressed(1e-8, 1.0)],
        "fig13": [
            motor(|_, _| {}), motor(|_, rotor| rotor.friction = 0.2), motor(|_, rotor| rotor.restitution = 0.3),
            motor(|_, rotor| rotor.restitution = 0.7), motor(|stator, _| stator.phase_lag = FRAC_PI_4),
            pressed(1e-7, 9.8), driven(70e3, 15.0, 9.8)
        ],
        "fig14": [bouncing(0.48, Some(json!({ "impact_phase": 0.7, "normalised_speed": 1.35 })))],
        "table1": [toss(|_, _| {})],
        "table2": [
            toss(|hand, _| hand.stroke = 0.3), toss(|hand, _| hand.angular_frequency = 20.0),
            toss(|hand, _| hand.contact_radius = 0.15), toss(|_, dough| dough.gyration_radius = 0.12),
            toss(|_, dough| dough.friction = 0.7), toss(|hand, _| hand.amplitude_angle = 0.69)
        ],
        "table3": [motor(|_, _| {}), pressed(1e-8, 70.0)]
    })
}

/// The steps of the tour and the lessons.
fn steps() -> Value {
    let lags = json!({ "over": "phase_lag", "family": null, "range": [-FRAC_PI_2, FRAC_PI_2], "points": 17 });
    let angles = json!({ "family": "phase_lag", "range": [0, 1.4] });
    let scanned = |toss: Value, scan: Value| with(toss, json!({ "view": "scan", "scan": scan }));
    let slow = json!({ "basins": { "phase_periods": [0, 1], "normalised_speed": [0, 0.6] } });
    let next = json!({ "parameter": "restitution", "value": 0.5_f64.next_up() });
    let [calm, chaos] = [0.45, 0.55].map(|forcing| bouncing(forcing, None));
    let (hand, sheet, resting) = (toss(|_, _| {}), motor(|_, _| {}), bouncing(0.45, Some(rest())));
    json!({
        "tour": {
            "toss": hand, "bounce": calm, "road": cascade(0.45, [0.32, 0.58], None), "chaos": chaos,
            "starts": basins(0.486), "rest": resting, "motor": sheet,
            "lag": diagram("angular_speed", &tossing(0.486), [0.32, 0.58], None)
        },
        "doubling": {
            "one": calm, "two": bouncing(0.48, None), "diagram": cascade(0.48, [0.44, 0.53], None),
            "multiplier": bouncing(0.5, None)
        },
        "feigenbaum": {
            "cascade": cascade(0.53, [0.48, 0.545], None),
            "ratios": cascade(0.5424, [0.542, 0.5427], Some([0.19, 0.235])),
            "limit": cascade(0.543, [0.538, 0.546], Some([0.15, 0.25]))
        },
        "rest": { "plane": basins(0.45), "edge": with(basins(0.45), slow), "flight": resting, "push": resting },
        "hand": { "release": hand, "lag": scanned(angled(0.323, 0.0), lags), "scan": scanned(hand.clone(), angles) },
        "motor": { "sheet": sheet, "runup": sheet, "curve": sheet, "friction": motor(|_, rotor| rotor.friction = 0.2) },
        "sensitivity": {
            "chaos": chaos, "exponent": cascade(0.55, [0.54999, 0.55001], None),
            "compare": with(chaos.clone(), json!({ "view": "compare", "compare": next })),
            "order": cascade(0.45, [0.44, 0.46], None), "bits": chaos
        }
    })
}

/// The library is the one place in which the systems are typed, and what follows from them is computed.
#[test]
fn the_presets_of_the_page_are_those_of_the_library() {
    let usual = shown("toss", &usual(), json!({}))["system"].clone();
    let text = json!({ "usual": usual, "panels": panels(), "steps": steps() }).to_string();
    // A state stands in one line, so that another number changes no more than that.
    let ends = ["},", "}],", "}},"];
    let text =
        ends.iter().fold(text, |text, end| text.replace(&format!("\"{end}"), &format!("\"{end}\n"))) + "\n";
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/page/src/presets.json");
    if std::env::var_os("UPDATE_DOCUMENTATION").is_some() {
        std::fs::write(file, &text).expect("writable");
    }
    assert_eq!(std::fs::read_to_string(file).expect("there"), text, "UPDATE_DOCUMENTATION=1 writes it");
}
