//! Run-ups against time: one member, the spread of all, and the fit.

use bouncing_disk::estimate::{MeasuredSpeeds, TransientEnsemble, TransientFit};
use bouncing_disk_plot::{
    Anchor, Band, Colour, Corner, Dash, Figure, Legend, Line, Panel, Rect, SINGLE_COLUMN, Text,
};

use super::spanned;

/// Where the frame is.
const AREA: Rect = Rect::new(44.0, 12.0, 190.0, 150.0);
const HEIGHT: f64 = 202.0;

/// Computed runs with their fit; of runs too few for a fit that can be judged, with that of the first. A fit that was
/// judged and refused is not drawn.
pub(crate) fn draw(ensemble: &TransientEnsemble, fit: Option<&TransientFit>, judged: bool) -> Figure {
    let curves = &ensemble.curves;
    let own = (!judged).then(|| ensemble.fits[0]);
    let shown = fit.map(Shown::of).or_else(|| {
        own.map(|own| Shown {
            steady_speed: own.steady_speed,
            time_constant: own.time_constant,
            from: 0.0,
            speed: Box::new(move |time| own.speed(time)),
        })
    });
    let times = &curves[0].times;
    let lines = || curves.iter().map(|curve| curve.speeds.as_slice());
    figure(times, lines, shown, "one run", fit.is_some())
}

/// Measured runs and their fit; of runs with times of their own the first one.
pub(crate) fn measured(speeds: &MeasuredSpeeds, fit: &TransientFit) -> Figure {
    let runs = speeds.runs();
    let same = || runs.iter().filter(|run| run.times == runs[0].times);
    let lines = || same().map(|run| run.speeds.as_slice());
    figure(&runs[0].times, lines, Some(Shown::of(fit)), "measured", true)
}

/// A fit that is drawn.
struct Shown {
    steady_speed: f64,
    time_constant: f64,
    /// Time from which on it is (s).
    from: f64,
    speed: Box<dyn Fn(f64) -> f64>,
}

impl Shown {
    fn of(fit: &TransientFit) -> Self {
        let fit = *fit;
        Self {
            steady_speed: fit.steady_speed().value,
            time_constant: fit.time_constant().value,
            from: fit.start_time,
            speed: Box::new(move |time| fit.speed(time)),
        }
    }
}

fn figure<'a, I: Iterator<Item = &'a [f64]>>(
    times: &[f64],
    runs: impl Fn() -> I,
    fit: Option<Shown>,
    name: &str,
    of_mean: bool,
) -> Figure {
    let end = times.last().copied().unwrap_or(1.0);
    let at_end = fit.as_ref().map_or(0.0, |fit| (fit.speed)(end));
    let all = || runs().flatten().copied().chain([at_end, 0.0]).filter(|speed| speed.is_finite());
    let (low, high) = (all().fold(0.0, f64::min), all().fold(0.0, f64::max));
    let span = (high - low).max(f64::MIN_POSITIVE);
    // The words stand where the curve does not go: below it, or above one that falls.
    let falls = fit.as_ref().map_or(low < -high, |fit| fit.steady_speed < 0.0);
    let (low, high) =
        if falls { (low - 0.06 * span, high + 0.42 * span) } else { (low - 0.02 * span, high + 0.42 * span) };
    let corner = if falls { Corner::BottomLeft } else { Corner::TopLeft };
    let bottom = if falls { 0.84 } else { 0.16 };
    let note = |line: f64, text: String| {
        Text::at_axes(0.96, bottom - 0.09 * line, text).anchor(Anchor::Right).size(8.0)
    };
    let band: Vec<(f64, f64, f64)> = times
        .iter()
        .enumerate()
        .map(|(index, time)| {
            let at = || runs().filter_map(|run| run.get(index)).copied();
            (*time, at().fold(f64::INFINITY, f64::min), at().fold(f64::NEG_INFINITY, f64::max))
        })
        .collect();
    let first: Vec<(f64, f64)> =
        runs().next().map(|run| times.iter().copied().zip(run.iter().copied()).collect()).unwrap_or_default();
    let mut panel = Panel::new(AREA)
        .x(spanned(times.first().copied().unwrap_or(0.0).min(0.0), end).label("$t$ (s)"))
        .y(spanned(low, high).label(r"$\dot{\alpha}$ (rad/s)"));
    if runs().count() > 1 {
        panel = panel.layer(Band::new(band).colour(Colour::BLUE).opacity(0.25).name("range of all runs"));
    }
    let fitted = if of_mean { "fit of the mean" } else { "fit of the run" };
    panel = panel.layer(Line::new(first).colour(Colour::GREY).width(0.6).name(name));
    if let Some(fit) = fit {
        let smooth = (0..=200).map(|step| {
            let time = fit.from + (end - fit.from) * f64::from(step) / 200.0;
            (time, (fit.speed)(time))
        });
        panel = panel
            .layer(Line::new(smooth).colour(Colour::BLACK).width(1.0).dash(Dash::Dashed).name(fitted))
            .layer(note(0.0, format!(r"$\dot{{\alpha}}_{{ss}} = {:.2}$ rad/s", fit.steady_speed)))
            .layer(note(1.0, format!("$t_c = {:.3}$ s", fit.time_constant)));
    }
    Figure::new(SINGLE_COLUMN, HEIGHT).panel(panel.legend(Legend::at(corner).without_frame().inset(4.0)))
}
