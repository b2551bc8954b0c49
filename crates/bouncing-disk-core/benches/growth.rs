//! The growth of the time per impact with the length of an orbit, with the forcing, and with the length of a
//! flight.

use std::f64::consts::PI;
use std::hint::black_box;

use bouncing_disk_core::{ImpactMap, ImpactState, Launch, Phase, Unobserved, Vibration};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Launches per timed call.
const LAUNCHES: usize = 1_000;
/// Axial forcing of W1.
const W1_FORCING: f64 = 0.55;

/// Impacts of the orbit of W1.
fn impacts(c: &mut Criterion) {
    let vibration = Vibration::from_axial_forcing(W1_FORCING).expect("legal forcing");
    let map = ImpactMap::new(vibration, 0.5).expect("legal restitution");
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal state");
    let mut group = c.benchmark_group("growth/impacts");
    group.sample_size(20);
    for impacts in [1_000_u64, 10_000, 100_000, 1_000_000] {
        group.throughput(Throughput::Elements(impacts));
        group.bench_function(impacts.to_string(), |bencher| {
            bencher.iter(|| map.iterate(black_box(start), impacts, &Unobserved).expect("impacts follow"));
        });
    }
    group.finish();
}

/// A chain of flights: each starts at the phase at which the last one ended, with the next of the given
/// speeds. With given speeds the mixture of flights does not depend on the platform.
fn chain(vibration: &Vibration, speeds: &[f64]) -> Phase {
    let mut phase = Phase::new(0.8).expect("finite");
    for &speed in black_box(speeds) {
        let launch = Launch::new(phase, speed).expect("legal");
        phase = vibration.first_impact(launch).expect("an impact follows").phase;
    }
    phase
}

/// `LAUNCHES` speeds, evenly spread from `low` to `high`.
fn speeds(low: f64, high: f64) -> Vec<f64> {
    (0..LAUNCHES).map(|k| low + (high - low) * ((k as f64 * 0.754_877_666_246_692_7) % 1.0)).collect()
}

/// Gamma, at speeds in proportion to 1 + P.
fn forcing(c: &mut Criterion) {
    let mut group = c.benchmark_group("growth/forcing");
    group.throughput(Throughput::Elements(LAUNCHES as u64));
    for forcing in [0.4, 1.0, 10.0, 100.0, 1.0e3, 1.0e4, 1.0e5] {
        let vibration = Vibration::from_axial_forcing(forcing).expect("legal forcing");
        let scale = 1.0 + vibration.peak_acceleration();
        let speeds = speeds(0.1 * scale, 2.0 * scale);
        group.bench_function(forcing.to_string(), |bencher| bencher.iter(|| chain(&vibration, &speeds)));
    }
    group.finish();
}

/// Periods that a flight lasts, at the forcing of W1. A flight after a launch at speed w lasts about 2 w.
fn flight(c: &mut Criterion) {
    let vibration = Vibration::from_axial_forcing(W1_FORCING).expect("legal forcing");
    let mut group = c.benchmark_group("growth/flight_periods");
    group.throughput(Throughput::Elements(LAUNCHES as u64));
    for periods in [1.0, 10.0, 100.0, 1.0e3, 1.0e4, 1.0e5, 1.0e6] {
        let speeds = speeds(0.9 * PI * periods, 1.1 * PI * periods);
        group.bench_function(periods.to_string(), |bencher| bencher.iter(|| chain(&vibration, &speeds)));
    }
    group.finish();
}

criterion_group!(benches, impacts, forcing, flight);
criterion_main!(benches);
