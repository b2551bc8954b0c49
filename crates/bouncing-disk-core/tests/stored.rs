//! Values are read with the same bits as written, and only legal ones are read.

#![cfg(feature = "serde")]

mod round_trip;

use std::f64::consts::TAU;
use std::fmt::Debug;

use bouncing_disk_core::attractors::*;
use bouncing_disk_core::chatter::*;
use bouncing_disk_core::numerics::elementary;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::orbits::*;
use bouncing_disk_core::sweep::*;
use bouncing_disk_core::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::json;

use round_trip::{check, refused};

fn map(axial_forcing: f64) -> ImpactMap {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), 0.5).expect("legal")
}

fn start() -> ImpactState {
    ImpactState::from_normalised(0.8, 1.3).expect("legal")
}

fn cut() -> ChatterCut {
    ChatterCut::new(1e-6, 1e-4, 20).expect("legal")
}

#[test]
fn the_platform_and_its_map() {
    let phase = start().phase();
    check(
        &phase,
        &[
            ("/angle", json!(TAU), "angle of a phase"),
            ("/angle", json!(-1.0), "angle of a phase"),
            ("/sin", json!(0.0), "sine of a phase"),
            ("/cos", json!(2.0), "cosine of a phase"),
        ],
    );
    let peak = "/peak_acceleration";
    check(map(0.45).vibration(), &[(peak, json!(-1.0), "peak_acceleration"), (peak, json!(2e8), "[0, 1e8]")]);
    check(
        &map(0.45),
        &[("/restitution", json!(1.0), "restitution"), ("/vibration/peak_acceleration", json!(-1.0), "peak")],
    );
    check(
        &start(),
        &[("/velocity", json!(1.0), "axial_impact_velocity"), ("/phase/angle", json!(7.0), "angle")],
    );
}

#[test]
fn one_flight() {
    let vibration = *map(0.45).vibration();
    let launch = map(0.45).rebound(start());
    check(&launch, &[("/relative_speed", json!(-1.0), "relative_speed")]);
    check(
        &vibration.first_impact(launch).expect("lands"),
        &[
            ("/remainder", json!(-0.1), "remainder"),
            ("/remainder", json!(6.3), "remainder"),
            ("/velocity", json!(0.1), "velocity"),
            ("/turns", json!(-1), "-1"),
            ("/phase/cos", json!(2.0), "cosine"),
        ],
    );
}

#[test]
fn chattering() {
    check(&ChatterPolicy::Complete, &[]);
    check(&ChatterPolicy::Cut(cut()), &[("/Cut/short_flights", json!(0), "short_flights")]);
    check(
        &cut(),
        &[("/smallest_speed", json!(-1.0), "smallest_speed"), ("/short_flight", json!(-1.0), "short_flight")],
    );
    let launch = Launch::new(Phase::new(4.0).expect("finite"), 1e-5).expect("legal");
    check(
        &map(0.45).accumulation(launch).expect("chatters to rest"),
        &[
            ("/duration", json!(-1.0), "duration"),
            ("/error_bound", json!(-1.0), "error_bound"),
            ("/turns", json!(2), "turns"),
            ("/phase/sin", json!(2.0), "sine"),
        ],
    );
}

#[test]
fn every_event_of_an_orbit() {
    let mut attachments = 0;
    for (policy, forcing) in [
        (ChatterPolicy::Complete, 0.55),
        (ChatterPolicy::Complete, 0.33),
        (ChatterPolicy::Complete, 0.25),
        (ChatterPolicy::Cut(cut()), 0.33),
    ] {
        for event in map(forcing).orbit(start(), policy).take(200) {
            let event = event.expect("no failure");
            let OrbitEvent::Attachment(rest) = event else {
                check(&event, &[("/Impact/velocity", json!(1.0), "velocity")]);
                continue;
            };
            attachments += 1;
            check(&event, &[("/Attachment/last_speed", json!(-1.0), "last_speed")]);
            check(
                &rest,
                &[
                    ("/last_speed", json!(-1.0), "last_speed"),
                    ("/accumulation/duration", json!(-1.0), "duration"),
                ],
            );
            if rest.separation.is_some() {
                check(&rest, &[("/separation/1", json!(2), "turns before the separation")]);
            }
            let infinite = matches!(policy, ChatterPolicy::Cut(_));
            assert_eq!(rest.accumulation.error_bound.is_infinite(), infinite, "JSON has no infinite number");
        }
    }
    assert!(attachments > 4, "{attachments}");
}

#[test]
fn periodic_orbits() {
    let orbit = map(0.45).refine(&[map(0.45).period_one(1).expect("exists")]).expect("refines");
    check(
        &orbit,
        &[
            ("/states", json!([]), "impacts of a periodic orbit"),
            ("/states/0/velocity", json!(0.0), "impact 0 of the solution has no speed"),
            ("/platform_periods", json!(0), "lasts less than one period of the platform"),
            ("/monodromy", json!([1.0]), "4"),
        ],
    );
    check(
        &KnownOrbit::new(orbit, 0.1).expect("legal"),
        &[
            ("/radius", json!(-1.0), "attraction radius"),
            ("/orbit/platform_periods", json!(0), "less than one period"),
        ],
    );
    check(&Multipliers::Real(-0.5, 0.25), &[("/Real/0", json!(0.2), "second multiplier")]);
    check(
        &Multipliers::Complex { real: -0.5, imaginary: 0.25 },
        &[("/Complex/imaginary", json!(0.0), "imaginary part")],
    );
}

#[test]
fn basins_and_partial_results() {
    let grid = Grid::new(Axis::new(0.0, 1.0, 3).expect("legal"), Axis::new(0.0, 2.0, 2).expect("legal"));
    let grid = grid.expect("legal");
    check(grid.phase(), &[("/cells", json!(0), "axis cells"), ("/high", json!(0.0), "axis high end")]);
    check(&grid, &[("/speed/low", json!(-1.0), "lowest normalised speed")]);
    let settings = BasinSettings::default();
    check(&settings, &[("/max_impacts", json!(-1), "-1")]);
    let mut results = PartialResults::new(2);
    results.extend([(0, vec![start()]), (1, vec![])]);
    check(
        &results,
        &[("/total", json!(1), "index of a finished item"), ("/finished/0/0", json!(1), "out of order")],
    );
}

/// For any platform, disk and policy, a computed value can always be read.
#[test]
fn whatever_happens_can_be_read() {
    fn read<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
        let text = serde_json::to_string(value).expect("writes");
        let read: T = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
        assert_eq!(&read, value);
    }
    let mut random = SplitMix64::new(7);
    let mut attachments = 0;
    for k in 0..600 {
        // From a platform that hardly moves to one that moves violently.
        let peak = elementary::exp(elementary::ln(10.0) * (12.0 * random.unit() - 4.0));
        let peak = if k % 3 == 0 { 1.0 + random.unit() } else { peak };
        let restitution = if k % 7 == 0 { 0.0 } else { 0.95 * random.unit() };
        let map = ImpactMap::new(Vibration::new(peak).expect("legal"), restitution).expect("legal");
        let policy = if k % 2 == 0 { ChatterPolicy::Complete } else { ChatterPolicy::Cut(cut()) };
        let state =
            ImpactState::new(Phase::new(TAU * random.unit()).expect("finite"), -2.0 * peak * random.unit());
        for event in map.orbit(state.expect("legal"), policy).take(60).map_while(Result::ok) {
            attachments += usize::from(matches!(event, OrbitEvent::Attachment(_)));
            read(&event);
        }
    }
    assert!(attachments > 100, "{attachments}");
}

/// JSON cannot store NaN; a binary format can.
#[test]
fn what_is_no_number_is_not_read() {
    let vibration = *map(0.45).vibration();
    let impact = vibration.first_impact(map(0.45).rebound(start())).expect("lands");
    let launch = Launch::new(Phase::new(4.0).expect("finite"), 1e-5).expect("legal");
    let accumulation = map(0.45).accumulation(launch).expect("chatters to rest");
    for number in [f64::NAN, f64::NEG_INFINITY] {
        refused(&Impact { velocity: number, ..impact }, "velocity");
        refused(&Impact { remainder: number, ..impact }, "remainder");
        refused(&Accumulation { duration: number, ..accumulation }, "duration");
        refused(&Accumulation { error_bound: number, ..accumulation }, "error_bound");
        refused(&Multipliers::Real(number, 0.0), "multiplier");
    }
}
