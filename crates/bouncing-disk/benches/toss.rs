//! A single toss of the paper's Table I: its performance up to the separation, and the whole trajectory until
//! the dough lands.

use std::hint::black_box;

use bouncing_disk::System;
use bouncing_disk::toss::{InitialSpin, single_toss, toss_trajectory};
use criterion::{Criterion, criterion_group, criterion_main};

fn toss(c: &mut Criterion) {
    let system = System::pizza_toss();
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
