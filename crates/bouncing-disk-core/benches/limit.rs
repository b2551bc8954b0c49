//! The limit: the sine-cosine pair alone. An impact returns the pair of its phase, so it cannot be faster
//! than one pair.

use std::f64::consts::FRAC_2_PI;
use std::hint::black_box;

use bouncing_disk_core::numerics::elementary;
use bouncing_disk_core::sweep::InstructionSet;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pulp::{Simd, WithSimd};

/// Pairs per timed call.
const PAIRS: usize = 1_024;

/// 1.5 * 2^52: adding it rounds to a whole number.
const ROUND_MAGIC: f64 = 6_755_399_441_055_744.0;

/// The lanes' pair, which is not public: the same operations in the same order. `lanes` checks the bits.
#[inline(always)]
fn pair(x: f64) -> (f64, f64) {
    let shifted = x * FRAC_2_PI + ROUND_MAGIC;
    let (n, quadrant) = (shifted - ROUND_MAGIC, shifted.to_bits());
    let r = (x - n * 1.570_796_326_734_125_6) - n * 6.077_100_506_303_966e-11;
    let z = r * r;
    let z2 = z * z;
    let rz = r * z;
    let z4 = z2 * z2;
    let low = z * 8.333_333_333_322_49e-3 - 1.666_666_666_666_663_2e-1;
    let middle = z * 2.755_731_370_707_006_8e-6 - 1.984_126_982_985_795e-4;
    let high = z * 1.589_690_995_211_55e-10 - 2.505_076_025_340_686_3e-8;
    let sine = r + rz * ((low + z2 * middle) + z4 * high);
    let half = 0.5 * z;
    let head = 1.0 - half;
    let lost = (1.0 - head) - half;
    let low = 4.166_666_666_666_66e-2 - z * 1.388_888_888_887_411e-3;
    let middle = 2.480_158_728_947_673e-5 - z * 2.755_731_435_139_066_3e-7;
    let high = 2.087_572_321_298_175e-9 - z * 1.135_964_755_778_819_5e-11;
    let cosine = head + ((lost + z2 * low) + (z4 * middle + (z4 * z2) * high));
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let swapped = (sine ^ cosine) & 0_u64.wrapping_sub(quadrant & 1);
    let s = (sine ^ swapped) ^ ((quadrant & 2) << 62);
    let c = (cosine ^ swapped) ^ ((quadrant.wrapping_add(1) & 2) << 62);
    (f64::from_bits(s), f64::from_bits(c))
}

struct Rows {
    angles: Vec<f64>,
    sines: Vec<f64>,
    cosines: Vec<f64>,
}

struct Pairs<'a>(&'a mut Rows);

impl WithSimd for Pairs<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Rows { angles, sines, cosines } = self.0;
        for ((angle, sine), cosine) in angles.iter().zip(sines).zip(cosines) {
            (*sine, *cosine) = pair(*angle);
        }
    }
}

fn run(set: InstructionSet, rows: &mut Rows) {
    let pairs = Pairs(rows);
    #[cfg(target_arch = "x86_64")]
    {
        if set == InstructionSet::Avx512
            && let Some(level) = pulp::x86::V4::try_new()
        {
            return Simd::vectorize(level, pairs);
        }
        if set == InstructionSet::Avx2
            && let Some(level) = pulp::x86::V3::try_new()
        {
            return Simd::vectorize(level, pairs);
        }
    }
    let _ = set;
    pairs.with_simd(pulp::Scalar::new());
}

fn scalar(c: &mut Criterion) {
    let mut group = c.benchmark_group("limit/pair");
    group.throughput(Throughput::Elements(PAIRS as u64));
    // The argument of each pair depends on the last one, as each impact depends on the previous one.
    group.bench_function("chained", |bencher| {
        bencher.iter(|| {
            (0..PAIRS).fold(black_box(0.8), |angle, _| {
                let (sine, cosine) = elementary::sin_cos(angle);
                2.0 + (sine + cosine)
            })
        });
    });
    group.finish();
}

fn lanes(c: &mut Criterion) {
    let angles: Vec<_> = (0..PAIRS).map(|k| 20.0 * ((k as f64 * 0.618_033_988_749_894_9) % 1.0)).collect();
    let mut rows = Rows { sines: angles.clone(), cosines: angles.clone(), angles };
    let mut group = c.benchmark_group("limit/pair/lanes");
    group.throughput(Throughput::Elements(PAIRS as u64));
    for set in InstructionSet::available() {
        run(set, &mut rows);
        for ((angle, sine), cosine) in rows.angles.iter().zip(&rows.sines).zip(&rows.cosines) {
            let (s, c) = elementary::sin_cos(*angle);
            assert_eq!((sine.to_bits(), cosine.to_bits()), (s.to_bits(), c.to_bits()), "{set:?}: {angle}");
        }
        group.bench_function(format!("{set:?}"), |bencher| {
            bencher.iter(|| {
                run(set, black_box(&mut rows));
            });
        });
    }
    group.finish();
}

criterion_group!(benches, scalar, lanes);
criterion_main!(benches);
