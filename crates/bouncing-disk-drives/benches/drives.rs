//! First impacts on drives.
//!
//! Costs at P = 1.8 in multiples of the sine's 109 ns (AMD EPYC with AVX-512): one harmonic 3.3, three 4.9,
//! triangle 1.6, parabolas 1.5, cubics 2.3, a spline of 16,384 samples 25.
#![allow(missing_docs, reason = "criterion generates an undocumented function")]

use std::f64::consts::TAU;
use std::hint::black_box;

use bouncing_disk_core::{Launch, Phase, Vibration};
use bouncing_disk_drives::Drive;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Launches of one regime: enough that the branch predictor cannot learn them.
const LAUNCHES: usize = 1_000;

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

/// The same launches on the sine and on drives: the cost of a drive is the ratio.
fn drives(c: &mut Criterion) {
    let peak = 1.8;
    let launches = launches(peak, 0.0, 2.0);
    let sine = Drive::from(Vibration::new(peak).expect("legal"));
    let samples: Vec<_> = (0..16_384).map(|k| sine.height(f64::from(k) / 16_384.0 * TAU)).collect();
    let drives = [
        ("one_harmonic", Ok(sine)),
        ("three_harmonics", Drive::fourier(&[(peak, 0.0), (0.2, 1.0), (0.1, 2.0)])),
        ("triangle", Drive::triangle(peak)),
        ("parabolas", Drive::parabolas(peak)),
        ("cubics", Drive::cubics(peak)),
        ("samples_16384", Drive::sampled(&samples)),
    ];
    let mut group = c.benchmark_group("drives");
    group.throughput(Throughput::Elements(launches.len() as u64));
    group.bench_function("sine", |bencher| {
        bencher.iter(|| {
            for (vibration, launch) in black_box(&launches) {
                let _ = black_box(vibration.first_impact(*launch));
            }
        });
    });
    for (name, drive) in drives {
        let drive = drive.expect("legal");
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                for (_, launch) in black_box(&launches) {
                    let _ = black_box(drive.first_impact(*launch));
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, drives);
criterion_main!(benches);
