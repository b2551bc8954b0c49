//! Says how far the computation is: bars on a terminal, lines elsewhere.

use std::io::IsTerminal as _;
use std::sync::Mutex;
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
                bar.set_style(style("{prefix:<8} {spinner} {elapsed}"));
                bar.enable_steady_tick(Duration::from_millis(200));
                bar
            }
            Self::Lines => {
                complain!("{id:<8} begins");
                // It counts without drawing.
                ProgressBar::hidden()
            }
        };
        Running { report: self, bar: bar.with_prefix(id), told: Mutex::new(Instant::now()) }
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
    bar: ProgressBar,
    /// When the last line was written.
    told: Mutex<Instant>,
}

impl Running<'_> {
    /// The figure is finished.
    pub(crate) fn end(&self, run_time: Duration, made: bool) {
        self.bar.finish_and_clear();
        let outcome = if made { "made in" } else { "failed after" };
        let line = format!("{:<8} {outcome} {:.2} s", self.bar.prefix(), run_time.as_secs_f64());
        match self.report {
            Report::Bars(bars) => {
                // Only a closed terminal fails here.
                let _ = bars.println(line);
            }
            Report::Lines => complain!("{line}"),
        }
    }
}

impl Progress for Running<'_> {
    fn start(&self, total: u64, unit: &'static str) {
        self.bar.reset();
        self.bar.set_length(total);
        self.bar.set_message(unit);
        let template = "{prefix:<8} [{bar:30}] {human_pos}/{human_len} {msg}, {per_sec}, {eta} left";
        self.bar.set_style(style(template).progress_chars("=> "));
    }

    fn advance(&self, done: u64) {
        self.bar.inc(done);
        if matches!(self.report, Report::Lines)
            // Another thread that is telling already tells enough.
            && let Ok(mut told) = self.told.try_lock()
            && told.elapsed() >= PAUSE
        {
            *told = Instant::now();
            complain!("{}", line(&self.bar));
        }
    }
}

/// "fig06    1200/4000 orbits, 85.7/s, 33 s left"
fn line(bar: &ProgressBar) -> String {
    let (done, total) = (bar.position(), bar.length().unwrap_or_default());
    let rate = done as f64 / bar.elapsed().as_secs_f64().max(1e-3);
    let left = if rate > 0.0 {
        format!("{:.0} s left", total.saturating_sub(done) as f64 / rate)
    } else {
        String::new()
    };
    format!("{:<8} {done}/{total} {}, {rate:.1}/s, {left}", bar.prefix(), bar.message())
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
        let bar = ProgressBar::hidden().with_prefix("fig06").with_message("orbits").with_position(1200);
        bar.set_length(4000);
        let bar = bar.with_elapsed(Duration::from_secs(14));
        assert_eq!(line(&bar), "fig06    1200/4000 orbits, 85.7/s, 33 s left");
    }
}
