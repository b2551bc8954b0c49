//! How far a long computation is: a bar on a terminal, a line now and then elsewhere.

use std::io::{IsTerminal as _, stderr};
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use bouncing_disk::{Observer, Progress};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::interrupt;
use crate::output::lines::complain;

/// Time between two lines where there is no terminal: a log of an hour has some hundred of them.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

/// Steps of the bar for each part of a computation.
const STEPS: u64 = 1_000;

/// Watches a computation: shows how far it is, and stops it when a signal has come.
#[derive(Debug)]
pub(crate) struct Watcher {
    what: String,
    bar: Option<ProgressBar>,
    /// When the last line was written; `None` where none is to be.
    last_line: Option<Mutex<Instant>>,
    /// Parts that are finished, and all of them.
    parts: (u64, u64),
}

impl Watcher {
    /// Of a computation of one part; silent if `quiet`.
    pub(crate) fn new(what: &str, quiet: bool) -> Self {
        let terminal = stderr().is_terminal();
        let bar = (!quiet && terminal).then(|| {
            let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
            // A template that is wrong is found by the first test that draws it.
            if let Ok(style) =
                ProgressStyle::with_template("{msg} [{bar:30}] {percent} % {elapsed}, {eta} left")
            {
                bar.set_style(style.progress_chars("=> "));
            }
            bar.set_message(what.to_owned());
            bar
        });
        let last_line = (!quiet && !terminal).then(|| Mutex::new(Instant::now()));
        Self { what: what.to_owned(), bar, last_line, parts: (0, 1) }
    }

    /// Says of how many parts the computation is, and how many are finished.
    pub(crate) fn set_parts(&mut self, done: usize, total: usize) {
        self.parts = (done as u64, (total as u64).max(1));
    }

    fn show(&self, fraction: f64) {
        let (done, total) = self.parts;
        let share = ((done as f64 + fraction) / total as f64).min(1.0);
        if let Some(bar) = &self.bar {
            bar.set_position((share * STEPS as f64) as u64);
        }
        if let Some(last) = &self.last_line
            && let Ok(mut last) = last.try_lock()
            && last.elapsed() >= BETWEEN_LINES
        {
            *last = Instant::now();
            complain!("{}: {:.0} %", self.what, 100.0 * share);
        }
    }

    /// One part of the computation, which has `rows` of the parts that [`Self::set_parts`] speaks of.
    pub(crate) fn part(&self, rows: usize) -> Part<'_> {
        Part { watcher: self, rows: rows as f64 }
    }
}

impl Observer for Watcher {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        self.part(1).observe(progress)
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Watches a part of a computation.
#[derive(Debug)]
pub(crate) struct Part<'w> {
    watcher: &'w Watcher,
    rows: f64,
}

impl Observer for Part<'_> {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        if interrupt::came() {
            return ControlFlow::Break(());
        }
        self.watcher.show(self.rows * progress.fraction());
        ControlFlow::Continue(())
    }
}
