//! W3: the basin at Gamma = 0.5, restitution 0.5, impact phase over the full cycle, normalised speed in [0, 2], each
//! cell to rest, to the known period-2 orbit, or 500 impacts. The time is that of one cell.

use std::hint::black_box;

use bouncing_disk_core::{
    Axis, BasinSettings, ChatterPolicy, Grid, ImpactMap, ImpactState, KnownOrbit, Vibration,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Cells a side.
const CELLS: usize = 300;

fn w3(c: &mut Criterion) {
    let vibration = Vibration::from_axial_forcing(0.5).expect("legal forcing");
    let map = ImpactMap::new(vibration, 0.5).expect("legal restitution");
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal state");
    let orbit = map.settled_orbit(start, 4_000, 4, 1.0e-8).expect("no failure").expect("settles");
    let radius = orbit.trapping_radius(&map, 64).expect("it attracts");
    let known = [KnownOrbit { orbit, radius }];
    let axis = |high| Axis::new(0.0, high, CELLS).expect("legal axis");
    let grid = Grid::new(axis(1.0), axis(2.0)).expect("legal grid");
    let settings = BasinSettings { max_impacts: 500, policy: ChatterPolicy::Complete };
    let mut group = c.benchmark_group("w3_basin_gamma_0.5");
    group.sample_size(20).throughput(Throughput::Elements((CELLS * CELLS) as u64));
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        group.bench_function(format!("lockstep_threads_{threads}"), |bencher| {
            bencher.iter(|| pool.install(|| black_box(map.basins(grid, &known, settings, || ()))));
        });
    }
    group.bench_function("one_by_one", |bencher| {
        bencher.iter(|| {
            let mut sum = 0_u32;
            for row in 0..CELLS {
                for column in 0..CELLS {
                    let angle = grid.phase.centre(column) * std::f64::consts::TAU;
                    let start =
                        ImpactState::from_normalised(angle, grid.speed.centre(row)).expect("legal state");
                    sum += u32::from(map.basin_label(start, &known, settings).expect("no failure"));
                }
            }
            black_box(sum)
        });
    });
    group.finish();
}

criterion_group!(benches, w3);
criterion_main!(benches);
