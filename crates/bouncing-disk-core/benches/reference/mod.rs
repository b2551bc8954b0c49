//! The yardstick: arithmetic of the solver's kind (a dependent chain of a polynomial, a square root and a division) that
//! must never change. Machines differ and share their processors; the ratio of two times measured in one run differs less.

use std::hint::black_box;

use criterion::{Criterion, Throughput};

/// Links of the chain per timed call; the time is that of one.
const LINKS: u64 = 64;

/// One link of the chain; it takes [0, 1] into itself.
fn link(x: f64) -> f64 {
    let z = x * x;
    let polynomial =
        1.0 + z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5_040.0 + z * (1.0 / 362_880.0))));
    let root = (polynomial + z).sqrt();
    (1.0 + x) / (1.0 + root + x * x)
}

/// Measures the kernel as `reference/<moment>`: once before and once after what a bench binary measures, since the load of
/// the machine changes while it runs.
pub(crate) fn measure(c: &mut Criterion, moment: &str) {
    let mut group = c.benchmark_group("reference");
    group.throughput(Throughput::Elements(LINKS));
    group.bench_function(moment, |bencher| {
        bencher.iter(|| (0..LINKS).fold(black_box(0.5), |x, _| link(x)));
    });
    group.finish();
}

pub(crate) fn before(c: &mut Criterion) {
    measure(c, "before");
}

pub(crate) fn after(c: &mut Criterion) {
    measure(c, "after");
}
