//! Fig. 14: growth of the dough over multiple tosses.

use bouncing_disk_plot::{
    Anchor, Arrow, Axis, Colour, Corner, Dash, Figure, Grid, Legend, Line, Margins, Panel, SINGLE_COLUMN,
    Scatter, Text, Ticks,
};

use super::shared::numbers::{Noise, StraightLine};
use super::shared::toss::TossCase;
use crate::claims::{Claim, paper};
use crate::experiment::{ExperimentError, Paper};

/// Frames per second of the synthetic record, and the standard deviation of its relative diameters: made up.
const FRAMES_PER_S: f64 = 25.0;
const SCATTER: f64 = 0.012;
const SEED: u64 = 14;

/// Fig. 14.
pub(crate) fn fig14(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    // The printed line, from the start of the first toss to that of the last.
    let paper::DoughGrowth { fit_start_s: start, fit_slope_per_s: slope, tosses, growth } =
        paper::dough_growth()?;
    let duration = growth / slope;
    let [first, last] = tosses.map(|toss| toss as u32);
    let between = last - first;
    let growth_per_toss_percent = 100.0 * growth / f64::from(between);
    // Number and start (s) of each toss, evenly spaced from start to start.
    let starts: Vec<(u32, f64)> =
        (0..=between).map(|k| (first + k, start + f64::from(k) / f64::from(between) * duration)).collect();
    fig.record("start_s", &start)?;
    fig.record("slope_per_s", &slope)?;
    fig.record("growth", &growth)?;
    fig.record("duration_s", &duration)?;
    fig.record("tosses_between", &between)?;
    fig.record("growth_per_toss_percent", &growth_per_toss_percent)?;
    fig.record("growth_per_toss_inclusive_percent", &(100.0 * growth / f64::from(between + 1)))?;
    fig.record("toss_start_s", &starts)?;
    fig.claim(Claim::printed("appendix.growth_per_toss", growth_per_toss_percent).note(format!(
        "{} % over the {between} tosses from the start of toss {first} to that of toss {last}; on the printed line it takes \
         {duration:.2} s, {:.3} s a toss",
        100.0 * growth,
        duration / f64::from(between)
    )));

    // What the estimator makes of a record on that line: not measured.
    let mut noise = Noise::new(fig.seed("record", SEED));
    let frames = (duration * FRAMES_PER_S) as u32;
    let synthetic: Vec<(f64, f64)> = (0..=frames)
        .map(|frame| f64::from(frame) / FRAMES_PER_S)
        .map(|after| (start + after, (1.0 + slope * after) * (1.0 + SCATTER * noise.bell())))
        .collect();
    let (fitted, error) =
        StraightLine::through(&synthetic).map_or((0.0, 0.0), |line| line.slope_over_value_at(start));
    fig.record("synthetic", &synthetic)?;
    fig.record("synthetic_slope_per_s", &fitted)?;
    fig.record("synthetic_slope_error_per_s", &error)?;

    // The toss of Table I with a dough whose radii are larger by the growth of one toss. A dough that grows so much in
    // flight turns more slowly, because its angular momentum does not change.
    let toss = TossCase::from(&paper::table_one()?);
    let larger = 1.0 + growth / f64::from(between);
    let grown = TossCase { gyration_radius_m: larger * toss.gyration_radius_m, ..toss };
    fig.record("airborne_speed_change_rad_per_s", &(grown.airborne_speed()? - toss.airborne_speed()?))?;
    fig.record("flight_spin_loss_percent", &(100.0 * (1.0 - 1.0 / (larger * larger))))?;

    fig.caption(format!(
        "Diameter of the dough against time. Black: the printed least-squares line d/d₀ = 1 + {} (t − {}). Arrows: \
         starts of the tosses n = 3 to 12, evenly spaced so that the printed growth of {} % lies between the first and \
         the last. Dots: a synthetic record, not measured, on that line with a relative scatter of {} at {} frames a \
         second (seed {SEED}); dashed: the line fitted to it, slope {:.4} ± {:.4} 1/s. The paper's points are not in its \
         text.",
        slope,
        start,
        100.0 * growth,
        SCATTER,
        FRAMES_PER_S,
        fitted,
        error,
    ));
    fig.parameter("start of the line", format!("{start} s"));
    fig.parameter("slope of d/d₀", format!("{slope} 1/s"));
    fig.parameter("synthetic scatter of d", format!("{SCATTER}, {FRAMES_PER_S} frames a second"));

    const HEIGHT: f64 = 190.0;
    let margins = Margins { left: 40.0, right: 10.0, top: 8.0, bottom: 34.0 };
    let grid = Grid::new(SINGLE_COLUMN, HEIGHT, 1, 1).margins(margins);
    let end = start + duration;
    let on_line = |time: f64| 1.0 + slope * (time - start);
    let fit = [(start, 1.0), (end, 1.0 + fitted * duration)];
    let mut panel = Panel::new(grid.cell(0, 0))
        .x(Axis::linear(start - 0.4, end + 0.4).label(r"$t$ (s)").ticks(Ticks::every(1.0)))
        .y(Axis::linear(0.86, 1.42).label(r"$d/d_0$").ticks(Ticks::every(0.1)))
        .layer(Scatter::new(synthetic).size(1.6).colour(Colour::GREY).name("synthetic, not measured"))
        .layer(Line::new([(start, 1.0), (end, on_line(end))]).name("printed line"))
        .layer(Line::new(fit).colour(Colour::VERMILION).dash(Dash::Dashed).name("fit to the synthetic"));
    for (toss, time) in starts {
        let at = on_line(time);
        panel = panel
            .layer(Arrow::at_data((time, at - 0.075), (time, at - 0.03)).head(4.0))
            .layer(Text::at_data(time, at - 0.11, toss.to_string()).anchor(Anchor::Middle));
    }
    fig.draw(Figure::new(SINGLE_COLUMN, HEIGHT).panel(panel.legend(Legend::at(Corner::TopLeft))));
    Ok(())
}
