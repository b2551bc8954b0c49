//! Fig. 15: the rebounds of a dropped ball.

use bouncing_disk_plot::{Axis, Figure, Grid, Margins, Panel, SINGLE_COLUMN, Scatter};

use crate::claims::{Claim, all, paper};
use crate::experiment::{ExperimentError, Paper};

/// Size of the figure (points), and room for its axes.
const HEIGHT: f64 = 150.0;
const MARGINS: Margins = Margins { left: 40.0, right: 10.0, top: 8.0, bottom: 34.0 };

/// Fig. 15.
pub(crate) fn fig15(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    // What the paper prints.
    let drop = paper::ball_drop()?;
    fig.parameter("height of the drop", format!("{} m", drop.drop_height_m));
    fig.caption(format!("Heights of the rebounds of a ball that falls from {} m.", drop.drop_height_m));

    // What is computed.
    let share = drop.rebound_height_m.value / drop.drop_height_m;
    let rebounds = fig.quality.choose(5, 10);
    let heights: Vec<f64> = std::iter::successors(Some(drop.drop_height_m), |height| Some(share * height))
        .take(rebounds + 1)
        .collect();
    fig.record("height_m", &heights)?;

    // What follows.
    let falls = all(heights.windows(2), |pair| pair[1] < pair[0]);
    let note = format!("each has {:.0} % of the height before it", 100.0 * share);
    fig.claim(Claim::printed_statement("section5.rebounds_fall", falls, note));

    // What is drawn.
    let points = heights.iter().enumerate().map(|(number, height)| (number as f64, *height));
    let panel = Panel::new(Grid::new(SINGLE_COLUMN, HEIGHT, 1, 1).margins(MARGINS).cell(0, 0))
        .x(Axis::linear(0.0, rebounds as f64).label("rebound"))
        .y(Axis::linear(0.0, 1.1 * drop.drop_height_m).label("$h$ (m)"))
        .layer(Scatter::new(points));
    fig.draw(Figure::new(SINGLE_COLUMN, HEIGHT).panel(panel));
    Ok(())
}
