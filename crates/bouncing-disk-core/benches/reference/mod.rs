//! The yardsticks, which must never change: a dependent chain of arithmetic of the solver's kind (a polynomial, a square root and a
//! division), and polynomials of many numbers at once. Machines differ and share their processors; the ratio of two times
//! measured in one run differs less. What waits for its own results hardly notices a neighbour on the same core, what fills
//! the core's arithmetic units does.

use std::hint::black_box;

use criterion::{Criterion, Throughput};

/// Links of the chain per timed call; the time is that of one.
const LINKS: u64 = 64;

/// Numbers whose polynomials are computed side by side; the time is that of one.
const NUMBERS: usize = 256;

/// It takes [0, 1] into itself.
#[inline(always)]
fn polynomial(z: f64) -> f64 {
    1.0 + z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5_040.0 + z * (1.0 / 362_880.0))))
}

/// One link; it takes [0, 1] into itself.
fn link(x: f64) -> f64 {
    let z = x * x;
    let root = (polynomial(z) + z).sqrt();
    (1.0 + x) / (1.0 + root + x * x)
}

/// Applies the polynomial four times over to every number; the compiler makes vectors of the baseline of them.
#[inline(never)]
fn step(numbers: &mut [f64; NUMBERS]) {
    for x in numbers {
        *x = polynomial(polynomial(polynomial(polynomial(*x))));
    }
}

/// Measures both kernels as `reference/<kernel>/<moment>`: once before and once after what a bench binary measures, since the load
/// of the machine changes while it runs.
pub(crate) fn measure(c: &mut Criterion, moment: &str) {
    let mut group = c.benchmark_group("reference");
    group.throughput(Throughput::Elements(LINKS));
    group.bench_function(format!("chain/{moment}"), |bencher| {
        bencher.iter(|| (0..LINKS).fold(black_box(0.5), |x, _| link(x)));
    });
    group.throughput(Throughput::Elements(NUMBERS as u64));
    let mut numbers: [f64; NUMBERS] = std::array::from_fn(|k| k as f64 / NUMBERS as f64);
    group.bench_function(format!("lanes/{moment}"), |bencher| bencher.iter(|| step(black_box(&mut numbers))));
    group.finish();
}

pub(crate) fn before(c: &mut Criterion) {
    measure(c, "before");
}

pub(crate) fn after(c: &mut Criterion) {
    measure(c, "after");
}
