//! A single toss of the paper's Table I: its performance up to the separation, and the whole trajectory until the dough
//! lands.

use std::hint::black_box;

use bouncing_disk::{DiskParameters, InitialSpin, Platform, Stroke, System, single_toss, toss_trajectory};
use criterion::{Criterion, criterion_group, criterion_main};

fn toss(c: &mut Criterion) {
    let stroke = Stroke {
        stroke: 0.25,
        amplitude_angle: 0.55,
        contact_radius: 0.135,
        angular_frequency: 15.0,
        phase_lag: 0.0,
    };
    let dough = DiskParameters {
        contact_radius: 0.135,
        gyration_radius: 0.11,
        friction: 0.6,
        restitution: 0.5,
        preload_acceleration: 9.8,
        load_acceleration: 0.0,
    };
    let platform = Platform::from_stroke(stroke).expect("legal stroke");
    let system = System::new(platform, dough.build().expect("legal dough")).expect("legal system");
    let mut group = c.benchmark_group("toss");
    group.bench_function("performance", |bencher| {
        bencher.iter(|| single_toss(black_box(&system), InitialSpin::AbsoluteRest));
    });
    group.bench_function("trajectory", |bencher| {
        bencher.iter(|| toss_trajectory(black_box(&system), InitialSpin::AbsoluteRest));
    });
    group.finish();
}

criterion_group!(benches, toss);
criterion_main!(benches);
