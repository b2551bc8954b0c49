//! Figs. 6 and 7: the two that cost most. In draft quality; with `BOUNCING_DISK_PAPER=1` in paper
//! quality as well, which takes minutes.

use std::hint::black_box;

use bouncing_disk_experiments::{Quality, Silent, registry};
use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};

/// Asks for paper quality.
const PAPER: &str = "BOUNCING_DISK_PAPER";

fn figure(c: &mut Criterion, id: &str, quality: Quality) {
    let experiments = registry::all();
    let experiment = registry::select(&experiments, &[id.to_owned()]).expect("known")[0];
    let mut group = c.benchmark_group(format!("figures/{id}/{quality}"));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        group.bench_function(format!("threads_{threads}"), |bencher| {
            bencher.iter(|| {
                black_box(pool.install(|| experiment.compute(quality, &Silent)).expect("no failure"))
            });
        });
    }
    group.finish();
}

fn figures(c: &mut Criterion) {
    let paper = std::env::var_os(PAPER).is_some_and(|value| value == "1");
    let qualities = [Some(Quality::Draft), paper.then_some(Quality::Paper)];
    for quality in qualities.into_iter().flatten() {
        figure(c, "fig06", quality);
        figure(c, "fig07", quality);
    }
}

criterion_group!(benches, figures);
criterion_main!(benches);
