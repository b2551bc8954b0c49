//! Sweeps over many orbits against the same orbits one by one: columns of a bifurcation diagram, and survival
//! times near a crisis.

use std::hint::black_box;

use bouncing_disk_core::sweep::{orbit_diagram, survival_times};
use bouncing_disk_core::{ChatterPolicy, ImpactMap, ImpactState, Orbit, OrbitEvent, Unobserved, Vibration};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Impacts of a column, and the number recorded.
const IMPACTS: usize = 1_000;
const RECORDED: usize = 100;

fn orbits(forcings: (f64, f64), count: u32, policy: ChatterPolicy) -> Vec<Orbit> {
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
    let orbit = |k: u32| {
        let forcing = forcings.0 + (forcings.1 - forcings.0) * f64::from(k) / f64::from(count);
        let map = ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), 0.5).expect("legal");
        map.orbit(start, policy)
    };
    (0..count).map(orbit).collect()
}

/// The columns, orbit by orbit.
fn one_by_one(orbits: &[Orbit]) -> Vec<Vec<ImpactState>> {
    let column = |orbit: &Orbit| {
        let impacts = orbit.clone().filter_map(|event| match event {
            Ok(OrbitEvent::Impact(impact)) => Some(impact.into()),
            _ => None,
        });
        impacts.skip(IMPACTS - RECORDED).take(RECORDED).collect()
    };
    orbits.iter().map(column).collect()
}

fn diagrams(c: &mut Criterion) {
    for (name, forcings, count) in [
        ("columns_period_doubling", (0.40, 0.55), 512),
        ("columns_gamma_0.3_to_0.62", (0.30, 0.62), 512),
        ("columns_gamma_2_to_3", (2.0, 3.0), 512),
        ("columns_64_orbits", (0.40, 0.55), 64),
        ("columns_12_orbits", (0.40, 0.55), 12),
        ("columns_8_orbits", (0.40, 0.55), 8),
    ] {
        let orbits = orbits(forcings, count, ChatterPolicy::Complete);
        let mut group = c.benchmark_group(name);
        group.sample_size(10).throughput(Throughput::Elements(u64::from(count) * IMPACTS as u64));
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            group.bench_function(format!("sweep_threads_{threads}"), |bencher| {
                bencher.iter(|| {
                    pool.install(|| {
                        black_box(orbit_diagram(&orbits, IMPACTS - RECORDED, RECORDED, &Unobserved))
                    })
                });
            });
        }
        group.bench_function("one_by_one", |bencher| bencher.iter(|| black_box(one_by_one(&orbits))));
        group.finish();
    }
}

fn crisis(c: &mut Criterion) {
    let orbits = orbits((0.560, 0.5615), 128, ChatterPolicy::Complete);
    let mut group = c.benchmark_group("lives_near_the_crisis");
    group.sample_size(10);
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        group.bench_function(format!("sweep_threads_{threads}"), |bencher| {
            bencher.iter(|| pool.install(|| black_box(survival_times(&orbits, 10_000, &Unobserved))));
        });
    }
    group.bench_function("one_by_one", |bencher| {
        bencher.iter(|| {
            let alone = |orbit: &Orbit| {
                orbit
                    .clone()
                    .take(10_000)
                    .take_while(|event| matches!(event, Ok(OrbitEvent::Impact(_))))
                    .count()
            };
            black_box(orbits.iter().map(alone).sum::<usize>())
        });
    });
    group.finish();
}

criterion_group!(benches, diagrams, crisis);
criterion_main!(benches);
