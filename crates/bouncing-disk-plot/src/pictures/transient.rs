//! Run-ups against time: one run, the spread of all, and the fit.

use crate::annotation::Text;
use crate::axis::Axis;
use crate::colour::Colour;
use crate::figure::{Figure, SINGLE_COLUMN};
use crate::frame::Rect;
use crate::legend::{Corner, Legend};
use crate::line::{Band, Line};
use crate::numbers::extent;
use crate::panel::Panel;
use crate::style::{Anchor, Dash};

/// A fit to a run-up.
#[derive(Clone, Debug)]
pub struct FittedCurve {
    steady_speed: f64,
    time_constant: f64,
    points: Vec<(f64, f64)>,
}

impl FittedCurve {
    /// The curve `speed` (rad/s) over the times `from` to `end` (s), of this steady speed and time constant.
    pub fn new(
        (steady_speed, time_constant): (f64, f64),
        (from, end): (f64, f64),
        speed: impl Fn(f64) -> f64,
    ) -> Self {
        let points = (0..=200).map(|step| {
            let time = from + (end - from) * f64::from(step) / 200.0;
            (time, speed(time))
        });
        Self { steady_speed, time_constant, points: points.collect() }
    }

    /// The curve, dashed.
    pub fn line(&self) -> Line {
        Line::new(self.points.iter().copied()).colour(Colour::BLACK).width(1.0).dash(Dash::Dashed)
    }

    /// The fitted numbers in two lines at the right, with `decimals` decimals of the speed: the lower line at
    /// the height `bottom` of the frame, the upper one `pitch` above.
    pub fn notes(&self, decimals: usize, bottom: f64, pitch: f64) -> [Text; 2] {
        let speed = format!(r"$\dot{{\alpha}}_{{ss}} = {:.decimals$}$ rad/s", self.steady_speed);
        let constant = format!("$t_c = {:.3}$ s", self.time_constant);
        [(bottom + pitch, speed), (bottom, constant)]
            .map(|(height, words)| Text::at_axes(0.96, height, words).anchor(Anchor::Right))
    }
}

/// Runs with the same times, and their fit.
#[derive(Debug)]
pub struct RunUp<'a> {
    /// The times of all runs (s).
    pub times: &'a [f64],
    /// The speeds of each run (rad/s).
    pub runs: &'a [&'a [f64]],
    /// The name of the first run, which is drawn as a curve.
    pub name: &'a str,
    /// The fit, and its name.
    pub fit: Option<(FittedCurve, &'a str)>,
}

impl RunUp<'_> {
    /// The first run, the range of all runs, if there are several, and the fit with its numbers.
    pub fn draw(&self) -> Figure {
        let fit = self.fit.as_ref().map(|(fit, _)| fit);
        let at_end = fit.and_then(|fit| fit.points.last()).map_or(0.0, |last| last.1);
        let (low, high) = extent(self.runs.iter().copied().flatten().copied().chain([at_end, 0.0]));
        let span = (high - low).max(f64::MIN_POSITIVE);
        // The words stand where the curve does not go: below it, or above one that falls.
        let falls = fit.map_or(low < -high, |fit| fit.steady_speed < 0.0);
        let (below, corner, bottom) =
            if falls { (0.06, Corner::BottomLeft, 0.75) } else { (0.02, Corner::TopLeft, 0.07) };
        let (start, end) = (self.times.first().copied(), self.times.last().copied());
        let band = self.times.iter().enumerate().map(|(index, time)| {
            let (low, high) = extent(self.runs.iter().filter_map(|run| run.get(index)).copied());
            (*time, low, high)
        });
        let band = Band::new(band).colour(Colour::BLUE).opacity(0.25).name("range of all runs");
        let first = self.runs.first().copied().unwrap_or_default();
        let first = Line::new(self.times.iter().copied().zip(first.iter().copied()));
        let panel = Panel::new(Rect::new(44.0, 12.0, 190.0, 150.0))
            .x(Axis::spanned(start.unwrap_or(0.0).min(0.0), end.unwrap_or(1.0)).label("$t$ (s)"))
            .y(Axis::spanned(low - below * span, high + 0.42 * span).label(r"$\dot{\alpha}$ (rad/s)"))
            .layers((self.runs.len() > 1).then_some(band))
            .layer(first.colour(Colour::GREY).width(0.6).name(self.name))
            .layers(self.fit.as_ref().map(|(fit, name)| fit.line().name(*name)))
            .layers(fit.into_iter().flat_map(|fit| fit.notes(2, bottom, 0.09)).map(|note| note.size(8.0)))
            .legend(Legend::at(corner).without_frame().inset(4.0));
        Figure::new(SINGLE_COLUMN, 202.0).panel(panel)
    }
}
