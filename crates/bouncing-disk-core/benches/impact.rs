//! One impact of the scalar solver, by regime; `w1` is one chaotic orbit at Gamma = 0.55, restitution 0.5.

use std::hint::black_box;

use bouncing_disk_core::{
    ChatterPolicy, Ensemble, ImpactMap, ImpactState, InstructionSet, Launch, OrbitEvent, Phase, Vibration,
};
use criterion::{Criterion, criterion_group, criterion_main};

/// Impacts of one chaotic orbit per timed call.
const IMPACTS: u64 = 1_000;

fn chaotic_orbit(c: &mut Criterion) {
    let vibration = Vibration::from_axial_forcing(0.55).expect("legal forcing");
    let map = ImpactMap::new(vibration, 0.5).expect("legal restitution");
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal state");
    let mut group = c.benchmark_group("one_impact");
    group.throughput(criterion::Throughput::Elements(IMPACTS));
    group.bench_function("w1_chaotic_gamma_0.55", |bencher| {
        let mut state = start;
        bencher.iter(|| {
            for _ in 0..IMPACTS {
                state = map.step(state).expect("an impact follows").into();
            }
            black_box(state)
        });
    });
    group.bench_function("w1_chaotic_orbit_with_policy", |bencher| {
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
    group.finish();
    // The same orbit from many of its own states, in lockstep: the time is that of one impact of one orbit.
    let mut group = c.benchmark_group("many_orbits");
    let mut state = start;
    let states: Vec<_> = (0..64)
        .map(|_| {
            state = map.step(state).expect("an impact follows").into();
            (map, state)
        })
        .collect();
    group.throughput(criterion::Throughput::Elements(states.len() as u64));
    for set in InstructionSet::available() {
        let mut ensemble = Ensemble::with_instruction_set(states.iter().copied(), set);
        group.bench_function(format!("w1_chaotic_gamma_0.55/{set:?}"), |bencher| {
            bencher.iter(|| black_box(ensemble.step()));
        });
    }
    group.finish();
}

fn launches(c: &mut Criterion) {
    let mut group = c.benchmark_group("one_launch");
    let cases = [
        ("monotone", 1.7279, 0.9, 2.0),
        ("guarded", 1.7279, 5.5, 1.9),
        ("short_chatter", 1.7279, 5.0, 1.0e-3),
        ("from_rest", 1.7279, f64::NAN, 0.0),
        ("motor_peak_acceleration_197", 197.39, 0.7, 250.0),
        ("half_a_million_periods", 1.0e6, 0.7, 8.0e5),
    ];
    for (name, peak, angle, speed) in cases {
        let vibration = Vibration::new(peak).expect("legal");
        let phase = if angle.is_nan() {
            vibration.separation_phase().expect("lifts off")
        } else {
            Phase::new(angle).expect("finite")
        };
        let launch = Launch::new(phase, speed).expect("legal");
        group.bench_function(name, |bencher| {
            bencher.iter(|| vibration.first_impact(black_box(launch)));
        });
    }
    group.finish();
}

criterion_group!(benches, chaotic_orbit, launches);
criterion_main!(benches);
