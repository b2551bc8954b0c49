//! W3: the basin at Gamma = 0.5, restitution 0.5, impact phase over the full cycle, normalised speed in [0,
//! 2], each cell until rest, the known period-2 orbit, or 500 impacts. The time is per cell.

use std::hint::black_box;

use bouncing_disk_core::attractors::{Axis, BasinSettings, Grid, KnownOrbit};
use bouncing_disk_core::{ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Cells per side.
const CELLS: usize = 300;
/// Cells per side of a panel of Fig. 7 in paper quality.
const PANEL: usize = 1_000;
/// Cells per side of the grids for the growth of the time with the number of cells.
const SIDES: [usize; 4] = [30, 100, 300, 1_000];

const SETTINGS: BasinSettings = BasinSettings { max_impacts: 500, policy: ChatterPolicy::Complete };

struct W3 {
    map: ImpactMap,
    known: [KnownOrbit; 1],
}

impl W3 {
    fn new() -> Self {
        let vibration = Vibration::from_axial_forcing(0.5).expect("legal forcing");
        let map = ImpactMap::new(vibration, 0.5).expect("legal restitution");
        let start = ImpactState::from_normalised(0.8, 1.3).expect("legal state");
        let orbit =
            map.settled_orbit(start, 4_000, 4, 1.0e-8, &Unobserved).expect("no failure").expect("settles");
        let radius = orbit.trapping_radius(&map, 64, &Unobserved).expect("it attracts");
        Self { map, known: [KnownOrbit::new(orbit, radius).expect("legal radius")] }
    }

    fn grid(side: usize) -> Grid {
        let axis = |high| Axis::new(0.0, high, side).expect("legal axis");
        Grid::new(axis(1.0), axis(2.0)).expect("legal grid")
    }

    fn together(&self, grid: Grid) {
        black_box(self.map.basins(grid, &self.known, SETTINGS, &Unobserved).expect("no failure"));
    }

    fn one_by_one(&self, grid: Grid) -> u32 {
        let mut sum = 0;
        for row in 0..grid.speed().cells() {
            for column in 0..grid.phase().cells() {
                let angle = grid.impact_angle(column);
                let start =
                    ImpactState::from_normalised(angle, grid.speed().centre(row)).expect("legal state");
                sum += u32::from(self.map.basin_label(start, &self.known, SETTINGS).expect("no failure"));
            }
        }
        sum
    }
}

fn pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start")
}

fn cells(side: usize) -> Throughput {
    Throughput::Elements((side * side) as u64)
}

fn w3(c: &mut Criterion) {
    let w3 = W3::new();
    let mut group = c.benchmark_group("w3");
    group.sample_size(10);
    let grid = W3::grid(CELLS);
    group.throughput(cells(CELLS));
    group.bench_function("scalar", |bencher| bencher.iter(|| black_box(w3.one_by_one(grid))));
    for (name, side) in [("", CELLS), ("panel_1000/", PANEL)] {
        let grid = W3::grid(side);
        group.throughput(cells(side));
        for threads in [1, 2] {
            let pool = pool(threads);
            group.bench_function(format!("{name}threads_{threads}"), |bencher| {
                bencher.iter(|| pool.install(|| w3.together(grid)));
            });
        }
    }
    group.finish();
}

fn growth(c: &mut Criterion) {
    let w3 = W3::new();
    let pool = pool(1);
    let mut group = c.benchmark_group("growth/cells");
    group.sample_size(10);
    for side in SIDES {
        let grid = W3::grid(side);
        group.throughput(cells(side));
        group.bench_function((side * side).to_string(), |bencher| {
            bencher.iter(|| pool.install(|| w3.together(grid)));
        });
    }
    group.finish();
}

criterion_group!(benches, w3, growth);
criterion_main!(benches);
