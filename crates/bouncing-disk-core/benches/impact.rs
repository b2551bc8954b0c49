//! One impact: W1 (sequentially and in lockstep) and single flights by regime.

use std::f64::consts::TAU;
use std::hint::black_box;

use bouncing_disk_core::sweep::{InstructionSet, OrbitBatch};
use bouncing_disk_core::{
    ChatterPolicy, ImpactMap, ImpactState, Launch, OrbitEvent, Phase, Unobserved, Vibration,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Impacts of one orbit per timed call.
const IMPACTS: u64 = 1_000;
/// Orbits in lockstep.
const ORBITS: usize = 1_024;
/// Launches of one regime: enough that the branch predictor cannot learn them.
const LAUNCHES: usize = 1_000;
/// Launches near a graze, on either side of it.
const CASES: &str = include_str!("../../../data/cases/first_impact.json");

/// W1: one chaotic orbit at Gamma = 0.55, restitution 0.5; the time is per impact.
fn w1(c: &mut Criterion) {
    let vibration = Vibration::from_axial_forcing(0.55).expect("legal forcing");
    let map = ImpactMap::new(vibration, 0.5).expect("legal restitution");
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal state");
    let mut group = c.benchmark_group("w1");
    group.throughput(Throughput::Elements(IMPACTS));
    group.bench_function("scalar", |bencher| {
        let mut state = start;
        bencher.iter(|| {
            state = map.iterate(state, IMPACTS, &Unobserved).expect("impacts follow");
            state
        });
    });
    // The state passes through memory between steps, because the compiler does not inline them into this
    // loop.
    group.bench_function("scalar_by_step", |bencher| {
        let mut state = start;
        bencher.iter(|| {
            for _ in 0..IMPACTS {
                state = map.step(state).expect("an impact follows").into();
            }
            black_box(state)
        });
    });
    // With the test after every impact whether the disk chatters to rest.
    group.bench_function("scalar_with_policy", |bencher| {
        let mut orbit = map.orbit(start, ChatterPolicy::Complete);
        bencher.iter(|| {
            let mut last = 0.0;
            for _ in 0..IMPACTS {
                if let Some(Ok(OrbitEvent::Impact(impact))) = orbit.next() {
                    last = impact.velocity;
                }
            }
            black_box(last)
        });
    });
    // The same orbit from many of its own states; the time is per impact of one orbit.
    let mut state = start;
    let states: Vec<_> = (0..ORBITS)
        .map(|_| {
            state = map.step(state).expect("an impact follows").into();
            (map, state)
        })
        .collect();
    group.throughput(Throughput::Elements(states.len() as u64));
    for set in InstructionSet::available() {
        let mut ensemble = OrbitBatch::with_instruction_set(states.iter().copied(), set);
        group.bench_function(format!("lanes/{set:?}"), |bencher| {
            bencher.iter(|| black_box(ensemble.step()));
        });
    }
    group.finish();
}

/// Evenly spread numbers in [0, 1).
fn spread(k: usize, factor: f64) -> f64 {
    (k as f64 * factor) % 1.0
}

/// Launches from evenly spread phases at speeds from `low` to `high` times 1 + P.
fn launches(peak: f64, low: f64, high: f64) -> Vec<(Vibration, Launch)> {
    let vibration = Vibration::new(peak).expect("legal");
    (0..LAUNCHES)
        .map(|k| {
            let phase = Phase::new(TAU * spread(k, 0.618_033_988_749_894_9)).expect("finite");
            let speed = (1.0 + peak) * (low + (high - low) * spread(k, 0.754_877_666_246_692_7));
            (vibration, Launch::new(phase, speed).expect("legal"))
        })
        .collect()
}

/// The stored launches near a graze.
fn grazes() -> Vec<(Vibration, Launch)> {
    let cases: serde_json::Value = serde_json::from_str(CASES).expect("JSON");
    let cases = cases["cases"].as_array().expect("a list");
    let grazes = cases.iter().filter(|case| case["class"].as_str().is_some_and(|c| c.starts_with("grazing")));
    grazes
        .map(|case| {
            let number = |field: &str| case[field].as_f64().expect("a number");
            let phase = Phase::new(number("launch_phase")).expect("finite");
            let vibration = Vibration::new(number("peak_acceleration")).expect("legal");
            (vibration, Launch::new(phase, number("relative_speed")).expect("legal"))
        })
        .collect()
}

/// A flight of each regime; the launches are independent, so the processor may begin one before the last is
/// done.
fn regimes(c: &mut Criterion) {
    // P at Gamma = 0.55.
    let peak = 0.55 * TAU / 2.0;
    let from_rest = Vibration::new(peak).expect("legal");
    let lift_off = Launch::new(from_rest.separation_phase().expect("lifts off"), 0.0).expect("legal");
    let regimes = [
        // Fast launches: the gap below the crests' height is monotonic.
        ("monotone", launches(peak, 1.0, 4.0)),
        // The first crest is in doubt, so that the window must be found first.
        ("guarded", launches(peak, 0.2, 1.0)),
        ("grazing", grazes()),
        ("chatter", launches(peak, 1.0e-6, 1.0e-2)),
        ("from_rest", vec![(from_rest, lift_off)]),
        // The motor of Table III.
        ("peak_acceleration_197", launches(197.392_088, 0.0, 2.0)),
        ("peak_acceleration_1e5", launches(1.0e5, 0.0, 2.0)),
    ];
    let mut group = c.benchmark_group("impact");
    for (name, launches) in regimes {
        group.throughput(Throughput::Elements(launches.len() as u64));
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                for (vibration, launch) in black_box(&launches) {
                    // A launch from rest may have no impact; its error is timed as well.
                    let _ = black_box(vibration.first_impact(*launch));
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, w1, regimes);
criterion_main!(benches);
