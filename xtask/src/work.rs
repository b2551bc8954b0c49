//! Makes several figures at the same time.

use std::panic::{self, AssertUnwindSafe};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context as _, anyhow};
use bouncing_disk_experiments::Quality;
use bouncing_disk_experiments::experiment::{Experiment, Made};

use crate::report::Report;

/// The outcome of one figure.
#[derive(Debug)]
pub(crate) struct Finished<T> {
    pub(crate) id: &'static str,
    pub(crate) run_time: Duration,
    pub(crate) result: anyhow::Result<T>,
}

/// Makes all figures and gives each to `keep`. A figure that fails does not stop the others. With several computing threads
/// twice as many figures are under way: where one has no work for all of them, another has.
///
/// The figures are taken by threads of their own and only their parallel parts run in the pool of computing
/// threads. A pool thread that waits inside one figure would take up another figure meanwhile, and its run
/// time would count for both. (It does where a figure runs searches side by side in the pool, as Figs. 6 and
/// 7 do.)
pub(crate) fn make_all<T: Send>(
    experiments: &[&Experiment],
    quality: Quality,
    threads: usize,
    report: &Report,
    keep: impl Fn(Made) -> anyhow::Result<T> + Sync,
) -> Vec<Finished<T>> {
    let make = |experiment: &Experiment| {
        let id = experiment.id;
        let progress = report.begin(id);
        let start = Instant::now();
        let made = panic::catch_unwind(AssertUnwindSafe(|| experiment.compute(quality, &progress)));
        let run_time = start.elapsed();
        let result = match made {
            Ok(Ok(made)) => keep(made),
            Ok(Err(error)) => Err(error).with_context(|| format!("{quality} quality")),
            Err(payload) => Err(anyhow!("panicked: {}", message(&*payload))),
        };
        progress.end(run_time, result.is_ok());
        Finished { id, run_time, result }
    };
    let next = AtomicUsize::new(0);
    let finished = Mutex::new(Vec::new());
    thread::scope(|scope| {
        let work = || {
            while let Some(experiment) = experiments.get(next.fetch_add(1, Ordering::Relaxed)) {
                let figure = make(experiment);
                // A poisoned lock holds intact results: a push is the only thing done under it.
                finished.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).push(figure);
            }
        };
        let under_way = if threads > 1 { 2 * threads } else { 1 };
        for _ in 1..under_way.min(experiments.len()) {
            // A system that gives no more threads makes it slower, no more.
            if thread::Builder::new().spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    finished.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// The message of a panic.
fn message(payload: &(dyn std::any::Any + Send)) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("no message")
}

#[cfg(test)]
mod tests {
    use bouncing_disk_experiments::FiniteError;
    use bouncing_disk_experiments::experiment::{ExperimentError, Paper};

    use super::*;

    fn panics(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
        fig.progress.start(2, "steps");
        fig.progress.advance(1);
        panic!("index {} out of range", 7)
    }

    fn fails(_: &mut Paper<'_>) -> Result<(), ExperimentError> {
        let place = "speed_m_per_s[3]".to_owned();
        Err(ExperimentError::Data(FiniteError::NotFinite { place, number: f64::NAN }))
    }

    #[test]
    fn one_failure_does_not_stop_the_others() {
        let entries = [("a", panics as fn(&mut Paper<'_>) -> _), ("b", fails), ("a", panics)]
            .map(|(id, make)| Experiment { id, title: "fails", discussion: "", make });
        let entries: Vec<&Experiment> = entries.iter().collect();
        let mut finished = make_all(&entries, Quality::Draft, 2, &Report::Lines, |_| Ok(()));
        finished.sort_by_key(|figure| figure.id);
        let errors: Vec<_> =
            finished.iter().map(|f| format!("{:#}", f.result.as_ref().expect_err("all fail"))).collect();
        assert_eq!(errors.len(), 3);
        assert_eq!([&errors[0], &errors[1]], ["panicked: index 7 out of range"; 2]);
        assert!(errors[2].contains("speed_m_per_s[3] is NaN"), "{}", errors[2]);
    }
}
