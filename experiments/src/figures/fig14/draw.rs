//! The drawing of Fig. 14.

use bouncing_disk_plot::{
    Anchor, Arrow, Axis, Colour, Corner, Dash, Figure, Grid, Legend, Line, Margins, Panel, SINGLE_COLUMN,
    Scatter, Text, Ticks,
};

use super::data::Fig14Data;

pub(super) fn draw(data: &Fig14Data) -> Figure {
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
        .layer(Scatter::new(data.synthetic.iter().copied()).size(1.6).colour(Colour::GREY).name("synthetic"))
        .layer(Line::new(straight).name("printed line"))
        .layer(Line::new(fitted).colour(Colour::VERMILION).dash(Dash::Dashed).name("fit to the synthetic"));
    for (toss, start) in &data.toss_start_s {
        let at = data.on_line(*start);
        panel = panel
            .layer(Arrow::at_data((*start, at - 0.075), (*start, at - 0.03)).head(4.0))
            .layer(Text::at_data(*start, at - 0.11, toss.to_string()).anchor(Anchor::Middle));
    }
    if let Some(growth) = &data.measured {
        panel = panel.layers(growth.layers());
    }
    Figure::new(SINGLE_COLUMN, HEIGHT).panel(panel.legend(Legend::at(Corner::TopLeft)))
}
