//! The options of every command, and the progress of a computation: a bar on a terminal, a line now and then
//! elsewhere.

use std::io::{IsTerminal as _, stderr};
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use bouncing_disk::{Observer, Progress};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};

use crate::interrupt;
use crate::lines::complain;

/// The options of every command.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "General")]
pub(crate) struct Context {
    /// No progress, no warnings, nothing but the result and errors
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Threads to compute with; all of the processor's unless given
    #[arg(long, allow_negative_numbers = true, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
}

impl Context {
    /// Watches a computation of this name; silent if quiet.
    pub(crate) fn watch(self, what: &str) -> Watcher {
        // Nothing is drawn where there is no terminal.
        let target = if self.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(STEPS), target)
            .with_finish(ProgressFinish::AndClear)
            .with_message(what.to_owned());
        // A template that is wrong is found by the first test that draws it.
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:30}] {percent} % {elapsed}, {eta} left")
        {
            bar.set_style(style.progress_chars("=> "));
        }
        let last_line = (!self.quiet && !stderr().is_terminal()).then(|| Mutex::new(Instant::now()));
        Watcher { bar, last_line }
    }

    /// Prints a note beside the result, unless notes are unwanted.
    pub(crate) fn note(self, text: &str) {
        if !self.quiet {
            complain(text);
        }
    }
}

/// Time between two lines where there is no terminal: a log of an hour has some hundred of them.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

const STEPS: u64 = 1_000;

/// Watches a computation: shows how far it is, and stops it when a signal has come.
#[derive(Debug)]
pub(crate) struct Watcher {
    bar: ProgressBar,
    /// When the last line was written; `None` where none is to be.
    last_line: Option<Mutex<Instant>>,
}

impl Watcher {
    /// Watches `rows` of the `total` rows of a computation, of which some are `done`.
    pub(crate) fn part(&self, done: usize, rows: usize, total: usize) -> impl Observer + '_ {
        move |progress: Progress| {
            self.show((done as f64 + rows as f64 * progress.fraction()) / total.max(1) as f64)
        }
    }

    fn show(&self, share: f64) -> ControlFlow<()> {
        if interrupt::came() {
            return ControlFlow::Break(());
        }
        let share = share.min(1.0);
        self.bar.set_position((share * STEPS as f64) as u64);
        if let Some(last) = &self.last_line
            && let Ok(mut last) = last.try_lock()
            && last.elapsed() >= BETWEEN_LINES
        {
            *last = Instant::now();
            complain(&format!("{}: {:.0} %", self.bar.message(), 100.0 * share));
        }
        ControlFlow::Continue(())
    }
}

impl Observer for Watcher {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        self.show(progress.fraction())
    }
}
