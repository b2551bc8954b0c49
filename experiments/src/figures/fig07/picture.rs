//! The picture of Fig. 7.

use bouncing_disk_plot::pictures::{IMPACT_PHASE, IMPACT_SPEED, crosses};
use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Marker, Panel,
    Raster, Rect, Rule, Scatter, Stroke, Text, Ticks,
};

use super::basins::Panel as Basins;
use super::cells::cells;
use super::windows::{CurvePoint, Windows};
use super::{WINDOW_TOP, forcing_text};

/// Chattering, attractor, other attractor, undecided.
const PALETTE: [Colour; 4] = [Colour::WHITE, Colour::BLACK, Colour::rgb(150, 150, 150), Colour::SKY];
const RED: Colour = Colour::rgb(214, 39, 40);
const YELLOW: Colour = Colour::rgb(255, 220, 0);

pub(super) fn draw(panels: &[Basins], side: usize, windows: &Windows) -> Figure {
    const HEIGHT: f64 = 350.0;
    let margins = Margins { left: 42.0, right: 8.0, top: 18.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 2, 3).margins(margins).gaps(38.0, 50.0);
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    for (index, (basins, letter)) in panels.iter().zip(["a", "b", "c", "d", "e"]).enumerate() {
        figure = figure.panel(basin_panel(basins, side, letter, grid.cell(index / 3, index % 3)));
    }
    figure.panel(curve_panel(windows, grid.cell(1, 2)))
}

fn basin_panel(basins: &Basins, side: usize, letter: &str, area: Rect) -> Panel {
    let window = (0.0, WINDOW_TOP);
    let rows: Vec<u8> = basins.rows.iter().flat_map(|row| cells(row)).collect();
    let raster = Raster::new(side, side, rows, &PALETTE, (0.0, 1.0), window);
    let dots = |spots: &[(f64, f64)], colour: Colour, size: f64| {
        Scatter::new(spots.iter().copied()).marker(Marker::Dot).size(size).colour(colour)
    };
    let panel = Panel::new(area)
        .x(Axis::linear(0.0, 1.0).label(IMPACT_PHASE).ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(0.0, WINDOW_TOP).label(IMPACT_SPEED).ticks(Ticks::every(1.0).minor(5)))
        .title(format!(r"({letter}) $\Gamma = {}$", forcing_text(basins.axial_forcing)))
        .layer(raster)
        .markers_on_top();
    match letter {
        "d" => panel.layer(dots(&basins.attractor, YELLOW, 1.3)).layer(dots(&basins.chattering, RED, 3.0)),
        "e" => panel.layer(dots(&basins.chattering, Colour::BLACK, 1.6)),
        _ => {
            let mut panel = panel
                .layer(crosses(basins.attractor.iter().copied(), Colour::WHITE))
                .layer(crosses(basins.chattering.iter().copied(), Colour::BLACK));
            for other in &basins.others {
                let marks = Scatter::new(other.impacts.iter().copied())
                    .marker(Marker::Circle)
                    .size(4.5)
                    .width(1.1)
                    .colour(RED);
                panel = panel.layer(marks);
            }
            panel
        }
    }
}

fn curve_panel(windows: &Windows, area: Rect) -> Panel {
    let [share_a, share_b] = windows.printed;
    let curve = |of: fn(&CurvePoint) -> f64| {
        Line::new(windows.curve.iter().map(|point| (point.top, 100.0 * of(point)))).width(1.1)
    };
    let top = windows.curve.last().map_or(1.0, |point| point.top);
    let printed = |share: f64| {
        Rule::horizontal(100.0 * share).stroke(Stroke::new(Colour::GREY, 0.7).dashed(Dash::Dashed))
    };
    let written = |share: f64, (x, rise, anchor): (f64, f64, Anchor)| {
        Text::at_data(x * top, 100.0 * share + rise, format!("{:.1} %", 100.0 * share))
            .anchor(anchor)
            .size(7.5)
            .colour(Colour::DARK_GREY)
    };
    Panel::new(area)
        .x(Axis::linear(0.0, top)
            .label(r"top of the window, $|w_A\Gamma/(\omega A)|$")
            .ticks(Ticks::every(2.0).minor(4)))
        .y(Axis::linear(0.0, 80.0).label("share of the window (%)").ticks(Ticks::every(20.0).minor(4)))
        .title("(f)")
        .layer(printed(share_a))
        .layer(printed(share_b))
        .layer(written(share_a, (0.98, -5.0, Anchor::Right)))
        .layer(written(share_b, (0.02, 1.6, Anchor::Left)))
        .layer(Rule::vertical(WINDOW_TOP).stroke(Stroke::new(Colour::GREY, 0.5).dashed(Dash::Dotted)))
        .layer(curve(|point| point.a).colour(Colour::VERMILION).name("(a)"))
        .layer(curve(|point| point.b).colour(Colour::BLUE).name("(b) black"))
        .layer(
            curve(|point| point.b_not_chattering)
                .colour(Colour::BLUE)
                .dash(Dash::Dashed)
                .name("(b) black and gray"),
        )
        .legend(Legend::at(Corner::TopLeft).without_frame().inset(4.0))
}
