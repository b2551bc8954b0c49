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
    /// Prints only the result and errors: no progress, no warnings
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Threads to compute with; by default all of the processor's
    #[arg(long, allow_negative_numbers = true, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
}

impl Context {
    /// Watches a computation of this name; silent if quiet.
    pub(crate) fn watch(self, what: &str) -> Watcher {
        // Without a terminal no bar is drawn.
        let target = if self.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(STEPS), target)
            .with_finish(ProgressFinish::AndClear)
            .with_message(what.to_owned());
        // The first test that draws the bar finds an error in the template.
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:30}] {percent} % {elapsed}, {eta} left")
        {
            bar.set_style(style.progress_chars("=> "));
        }
        let writes_lines = !self.quiet && !stderr().is_terminal();
        let next_line = writes_lines.then(|| Mutex::new(Instant::now() + FIRST_LINE));
        Watcher { bar, began: Instant::now(), next_line }
    }

    /// Prints a note next to the result, unless notes are suppressed.
    pub(crate) fn note(self, text: &str) {
        if !self.quiet {
            complain(text);
        }
    }
}

/// Interval between progress lines without a terminal: about a hundred of them in an hour.
const FIRST_LINE: Duration = Duration::from_secs(5);
const BETWEEN_LINES: Duration = Duration::from_secs(30);

const STEPS: u64 = 1_000;

/// Shows the progress of a computation, and stops it after a signal.
#[derive(Debug)]
pub(crate) struct Watcher {
    bar: ProgressBar,
    began: Instant,
    /// When the next line is due; `None` for no lines.
    next_line: Option<Mutex<Instant>>,
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
        if let Some(next) = &self.next_line
            && share < 1.0
            && let Ok(mut next) = next.try_lock()
            && Instant::now() >= *next
        {
            *next = Instant::now() + BETWEEN_LINES;
            let done = format!("{}: {:.0} %", self.bar.message(), 100.0 * share);
            // Before a hundredth is done the estimate means nothing.
            let left = self.began.elapsed().as_secs_f64() * (1.0 / share - 1.0);
            let left = if share >= 0.01 { format!(", about {left:.0} s left") } else { String::new() };
            complain(&format!("{done}{left}"));
        }
        ControlFlow::Continue(())
    }
}

impl Observer for Watcher {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        self.show(progress.fraction())
    }
}
