//! Fig. 14: growth of the dough over multiple tosses.

use bouncing_disk_plot::{
    Anchor, Arrow, Axis, Colour, Corner, Dash, Figure, Grid, Legend, Line, Margins, Panel, SINGLE_COLUMN,
    Scatter, Text, Ticks,
};
use serde::Serialize;

use super::shared::numbers::{Noise, StraightLine};
use super::shared::toss::TossCase;
use crate::claims::{Claim, paper};
use crate::experiment::{ExperimentError, Paper};

/// Fig. 14.
pub(crate) fn fig14(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.seed("record", SEED);
    let progress = fig.progress;
    progress.start(1, "records");
    let printed = paper::dough_growth()?;
    let duration_s = printed.growth / printed.fit_slope_per_s;
    let [first, last] = printed.tosses.map(|toss| toss as u32);
    let tosses_between = last - first;
    let line = (printed.fit_start_s, printed.fit_slope_per_s, duration_s);
    let (synthetic, slope, error) = record(line, SEED).unwrap_or_default();
    progress.advance(1);
    let toss = TossCase::from(&paper::table_one()?);
    let larger = 1.0 + printed.growth / f64::from(tosses_between);
    let data = &Fig14Data {
        start_s: printed.fit_start_s,
        slope_per_s: printed.fit_slope_per_s,
        growth: printed.growth,
        duration_s,
        tosses_between,
        growth_per_toss_percent: 100.0 * printed.growth / f64::from(tosses_between),
        growth_per_toss_inclusive_percent: 100.0 * printed.growth / f64::from(tosses_between + 1),
        toss_start_s: (0..=tosses_between)
            .map(|k| {
                let share = f64::from(k) / f64::from(tosses_between);
                (first + k, printed.fit_start_s + share * duration_s)
            })
            .collect(),
        synthetic,
        synthetic_slope_per_s: slope,
        synthetic_slope_error_per_s: error,
        airborne_speed_change_rad_per_s: TossCase {
            gyration_radius_m: larger * toss.gyration_radius_m,
            ..toss
        }
        .airborne_speed()?
            - toss.airborne_speed()?,
        flight_spin_loss_percent: 100.0 * (1.0 - 1.0 / (larger * larger)),
    };
    fig.caption(format!(
        "Diameter of the dough against time. Black: the printed least-squares line d/d₀ = 1 + {} (t − {}). Arrows: \
         starts of the tosses n = 3 to 12, evenly spaced so that the printed growth of {} % lies between the first and \
         the last. Dots: a synthetic record, not measured, on that line with a relative scatter of {} at {} frames a \
         second (seed {SEED}); dashed: the line fitted to it, slope {:.4} ± {:.4} 1/s. The paper's points are not in its \
         text.",
        data.slope_per_s,
        data.start_s,
        100.0 * data.growth,
        SCATTER,
        FRAMES_PER_S,
        data.synthetic_slope_per_s,
        data.synthetic_slope_error_per_s,
    ));
    fig.parameter("start of the line", format!("{} s", data.start_s));
    fig.parameter("slope of d/d₀", format!("{} 1/s", data.slope_per_s));
    fig.parameter("synthetic scatter of d", format!("{SCATTER}, {FRAMES_PER_S} frames a second"));
    fig.claims(claims(data));
    fig.draw(draw(data)?);
    fig.data(data)
}

fn claims(data: &Fig14Data) -> Vec<Claim> {
    let toss_s = data.duration_s / f64::from(data.tosses_between);
    vec![Claim::printed("appendix.growth_per_toss", data.growth_per_toss_percent).note(format!(
        "the printed growth over the {} tosses from the start of the first to the start of the last; on the printed \
         line it takes {:.2} s, {toss_s:.3} s a toss",
        data.tosses_between, data.duration_s
    ))]
}

fn draw(data: &Fig14Data) -> Result<Figure, ExperimentError> {
    const HEIGHT: f64 = 190.0;
    let margins = Margins { left: 40.0, right: 10.0, top: 8.0, bottom: 34.0 };
    let grid = Grid::new(SINGLE_COLUMN, HEIGHT, 1, 1).margins(margins);
    let end = data.start_s + data.duration_s;
    let ends = (data.start_s - 0.4, end + 0.4);
    let straight = [(data.start_s, 1.0), (end, data.on_line(end))];
    let scale = data.synthetic_slope_per_s;
    let fitted = [(data.start_s, 1.0), (end, 1.0 + scale * data.duration_s)];
    let mut panel = Panel::new(grid.cell(0, 0))
        .x(Axis::linear(ends.0, ends.1).label(r"$t$ (s)").ticks(Ticks::every(1.0)))
        .y(Axis::linear(0.86, 1.42).label(r"$d/d_0$").ticks(Ticks::every(0.1)))
        .layer(
            Scatter::new(data.synthetic.iter().copied())
                .size(1.6)
                .colour(Colour::GREY)
                .name("synthetic, not measured"),
        )
        .layer(Line::new(straight).name("printed line"))
        .layer(Line::new(fitted).colour(Colour::VERMILION).dash(Dash::Dashed).name("fit to the synthetic"));
    for (toss, start) in &data.toss_start_s {
        let at = data.on_line(*start);
        panel = panel
            .layer(Arrow::at_data((*start, at - 0.075), (*start, at - 0.03)).head(4.0))
            .layer(Text::at_data(*start, at - 0.11, toss.to_string()).anchor(Anchor::Middle));
    }
    Ok(Figure::new(SINGLE_COLUMN, HEIGHT).panel(panel.legend(Legend::at(Corner::TopLeft))))
}

/// The printed line, what follows from it, and the estimator on synthetic diameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Fig14Data {
    /// The end of the second toss, where the line starts.
    start_s: f64,
    /// Slope of d/d_0.
    slope_per_s: f64,
    /// Growth between the first and the last toss, as a share, and how long it takes on the printed line.
    growth: f64,
    duration_s: f64,
    /// Tosses from the start of the first to the start of the last.
    tosses_between: u32,
    /// Growth per toss, from start to start and with the last toss counted.
    growth_per_toss_percent: f64,
    growth_per_toss_inclusive_percent: f64,
    /// Number and start (s) of each toss, evenly spaced from start to start.
    toss_start_s: Vec<(u32, f64)>,
    /// Synthetic diameters, not measured: times (s) and d/d_0.
    synthetic: Vec<(f64, f64)>,
    /// Slope of the least-squares line through them over its value at the start, and its standard error.
    synthetic_slope_per_s: f64,
    synthetic_slope_error_per_s: f64,
    /// Change of the airborne speed of Table I's toss if the dough is larger, in all its radii, by the growth of one toss.
    airborne_speed_change_rad_per_s: f64,
    /// Share of its rotation that a dough loses which grows so much while it flies: its angular momentum does not change.
    flight_spin_loss_percent: f64,
}

impl Fig14Data {
    fn on_line(&self, time: f64) -> f64 {
        1.0 + self.slope_per_s * (time - self.start_s)
    }
}

/// Frames per second of the synthetic record, and the standard deviation of its relative diameters: made up.
const FRAMES_PER_S: f64 = 25.0;
const SCATTER: f64 = 0.012;
const SEED: u64 = 14;

/// A synthetic record, and the slope of the line through it over its value at the start, with its standard
/// error.
type Record = (Vec<(f64, f64)>, f64, f64);

/// A record on the line `1 + slope (t − start)` for `duration`.
fn record((start, slope, duration): (f64, f64, f64), seed: u64) -> Option<Record> {
    let mut noise = Noise::new(seed);
    let frames = (duration * FRAMES_PER_S) as u32;
    let points: Vec<_> = (0..=frames)
        .map(|frame| f64::from(frame) / FRAMES_PER_S)
        .map(|after| (start + after, (1.0 + slope * after) * (1.0 + SCATTER * noise.bell())))
        .collect();
    let line = StraightLine::through(&points)?;
    let (slope, error) = line.slope_over_value_at(start);
    Some((points, slope, error))
}
