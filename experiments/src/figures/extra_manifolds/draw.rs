//! The drawing of the figure.

use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Figure, Grid, Line, Margins, Marker, Panel, Raster, Rect, Scatter, Ticks,
};

use super::data::{ExtraManifoldsData, Panel as Basins};

/// Comes to rest, does not, other periodic orbit.
const PALETTE: [Colour; 3] = [Colour::WHITE, Colour::LIGHT_GREY, Colour::DARK_GREY];

pub(super) fn draw(data: &ExtraManifoldsData) -> Figure {
    const HEIGHT: f64 = 430.0;
    let margins = Margins { left: 42.0, right: 8.0, top: 18.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 2, 2).margins(margins).gaps(44.0, 50.0);
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    for (index, (basins, letter)) in data.panels.iter().zip(["a", "b", "c", "d"]).enumerate() {
        figure = figure.panel(panel(data, basins, letter, grid.cell(index / 2, index % 2)));
    }
    figure
}

fn panel(data: &ExtraManifoldsData, basins: &Basins, letter: &str, area: Rect) -> Panel {
    let window = (0.0, data.window_top);
    let cells =
        basins.rows.iter().flat_map(|row| row.bytes().map(|digit| digit.saturating_sub(b'0'))).collect();
    let mut panel = Panel::new(area)
        .x(Axis::linear(0.0, 1.0).label(r"$\tau_{imp}/2\pi$").ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(window.0, window.1)
            .label(r"$|w_A\Gamma/(\omega A)|$")
            .ticks(Ticks::every(1.0).minor(5)))
        .title(format!(r"({letter}) $\Gamma = {}$", basins.axial_forcing))
        .layer(Raster::new(data.cells, data.cells, cells, &PALETTE, (0.0, 1.0), window));
    for piece in &basins.manifolds {
        panel = panel.layer(Line::new(piece.iter().copied()).width(0.35).colour(Colour::BLUE));
    }
    panel.layer(
        Scatter::new(basins.saddles.iter().copied())
            .marker(Marker::Circle)
            .size(4.5)
            .width(1.1)
            .colour(Colour::VERMILION),
    )
}
