//! Says how far the computation is: bars on a terminal, lines elsewhere.

use std::io::IsTerminal as _;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use bouncing_disk_experiments::Progress;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

use crate::output::complain;

/// The shortest time between two lines about one figure.
const PAUSE: Duration = Duration::from_secs(10);

/// Where progress is shown.
#[derive(Debug)]
pub(crate) enum Report {
    /// One bar per running figure.
    Bars(MultiProgress),
    /// Lines now and then.
    Lines,
}

impl Report {
    /// Bars when standard error is a terminal, lines when it is not.
    pub(crate) fn new() -> Self {
        if std::io::stderr().is_terminal() { Self::Bars(MultiProgress::new()) } else { Self::Lines }
    }

    /// A figure begins.
    pub(crate) fn begin(&self, id: &'static str) -> Running<'_> {
        let bar = match self {
            Self::Bars(bars) => {
                let bar = bars.add(ProgressBar::new_spinner());
                bar.set_prefix(id);
                bar.set_style(style("{prefix:<8} {spinner} {elapsed}"));
                bar.enable_steady_tick(Duration::from_millis(200));
                Some(bar)
            }
            Self::Lines => {
                complain!("{id:<8} begins");
                None
            }
        };
        let stage = Mutex::new(Stage { unit: "", total: 0, began: Instant::now(), told: Instant::now() });
        Running { report: self, id, bar, done: AtomicU64::new(0), stage }
    }

    /// All figures are finished.
    pub(crate) fn close(&self) {
        if let Self::Bars(bars) = self {
            // Bars that are gone already cannot be cleared; that harms nothing.
            let _ = bars.clear();
        }
    }
}

/// One figure that is being made.
#[derive(Debug)]
pub(crate) struct Running<'a> {
    report: &'a Report,
    id: &'static str,
    bar: Option<ProgressBar>,
    done: AtomicU64,
    stage: Mutex<Stage>,
}

#[derive(Debug)]
struct Stage {
    unit: &'static str,
    total: u64,
    began: Instant,
    told: Instant,
}

impl Running<'_> {
    /// The figure is finished.
    pub(crate) fn end(&self, run_time: Duration, made: bool) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        let outcome = if made { "made in" } else { "failed after" };
        let line = format!("{:<8} {outcome} {:.2} s", self.id, run_time.as_secs_f64());
        match self.report {
            Report::Bars(bars) => {
                // Only a closed terminal refuses a line.
                let _ = bars.println(line);
            }
            Report::Lines => complain!("{line}"),
        }
    }
}

impl Progress for Running<'_> {
    fn start(&self, total: u64, unit: &'static str) {
        self.done.store(0, Ordering::Relaxed);
        if let Ok(mut stage) = self.stage.lock() {
            *stage = Stage { unit, total, began: Instant::now(), told: Instant::now() };
        }
        if let Some(bar) = &self.bar {
            bar.set_length(total);
            bar.set_position(0);
            bar.reset_eta();
            bar.set_message(unit);
            let template = "{prefix:<8} [{bar:30}] {human_pos}/{human_len} {msg}, {per_sec}, {eta} left";
            bar.set_style(style(template).progress_chars("=> "));
        }
    }

    fn advance(&self, done: u64) {
        let done = self.done.fetch_add(done, Ordering::Relaxed) + done;
        if let Some(bar) = &self.bar {
            bar.set_position(done);
        } else if let Ok(mut stage) = self.stage.try_lock()
            // Another thread is already reporting; that is enough.
            && stage.told.elapsed() >= PAUSE
        {
            stage.told = Instant::now();
            complain!("{}", line(self.id, done, stage.total, stage.unit, stage.began.elapsed()));
        }
    }
}

/// "fig06    1200/4000 orbits, 85.7/s, 33 s left"
fn line(id: &str, done: u64, total: u64, unit: &str, elapsed: Duration) -> String {
    let rate = done as f64 / elapsed.as_secs_f64().max(1e-3);
    let left = if rate > 0.0 {
        format!("{:.0} s left", total.saturating_sub(done) as f64 / rate)
    } else {
        String::new()
    };
    format!("{id:<8} {done}/{total} {unit}, {rate:.1}/s, {left}")
}

fn style(template: &str) -> ProgressStyle {
    // A faulty template would only cost the looks.
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_states_rate_and_time_left() {
        let line = line("fig06", 1200, 4000, "orbits", Duration::from_secs(14));
        assert_eq!(line, "fig06    1200/4000 orbits, 85.7/s, 33 s left");
    }
}
