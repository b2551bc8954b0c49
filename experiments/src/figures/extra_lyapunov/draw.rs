//! The drawing of the figure.

use bouncing_disk_plot::{
    Axis, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Margins, Panel, Rule,
    Scatter, Stroke, Ticks,
};

use super::data::{Column, ExtraLyapunovData, Kind};

/// What each kind is called and drawn in; what is drawn last lies on top.
const KINDS: [(Kind, &str, Colour); 4] = [
    (Kind::Rest, "with rests", Colour::LIGHT_GREY),
    (Kind::Periodic, "periodic", Colour::BLUE),
    (Kind::Chaotic, "chaotic", Colour::VERMILION),
    (Kind::Undecided, "undecided", Colour::BLACK),
];

/// Exponents that are drawn.
const EXPONENTS: (f64, f64) = (-0.9, 0.9);

/// Standard errors that a bar is long to either side.
const ERRORS: f64 = 3.0;

pub(super) fn draw(data: &ExtraLyapunovData) -> Figure {
    const HEIGHT: f64 = 360.0;
    let margins = Margins { left: 46.0, right: 10.0, top: 12.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 2, 1).margins(margins).gaps(0.0, 12.0);
    let (low, high) = data.range();
    let x = || Axis::linear(low, high).ticks(Ticks::every(0.02).minor(4));
    let doubling = || {
        let stroke = Stroke::new(Colour::GREY, 0.6).dashed(Dash::Dashed);
        Rule::vertical(data.first_doubling_forcing).stroke(stroke)
    };
    let mut diagram = Panel::new(grid.cell(0, 0))
        .x(x().without_numbers())
        .y(Axis::linear(0.0, 1.0).label(r"$\tau_{imp}/2\pi$").ticks(Ticks::every(0.2).minor(4)))
        .letter("a")
        .layer(doubling());
    let mut exponents = Panel::new(grid.cell(1, 0))
        .x(x().label(r"$\Gamma$"))
        .y(Axis::linear(EXPONENTS.0, EXPONENTS.1)
            .label(r"exponent per impact")
            .ticks(Ticks::every(0.5).minor(5)))
        .letter("b")
        .layer(doubling())
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::BLACK, 0.5)));
    let bars = data.has_bars();
    for (kind, name, colour) in KINDS {
        let columns: Vec<&Column> = data.of(kind).collect();
        if columns.is_empty() {
            continue;
        }
        let phases = columns
            .iter()
            .flat_map(|column| column.impact_phase_cycles.iter().map(|phase| (column.axial_forcing, *phase)));
        diagram = diagram.layer(DensePoints::new(phases).colour(colour).radius(0.35).name(name));
        let shown: Vec<(f64, f64, f64)> = columns
            .iter()
            .filter_map(|column| {
                let exponent = column.exponent?.max(EXPONENTS.0);
                Some((column.axial_forcing, exponent, ERRORS * column.standard_error.unwrap_or(0.0)))
            })
            .collect();
        let points = shown.iter().map(|(forcing, exponent, _)| (*forcing, *exponent));
        exponents = if bars {
            let errors = shown.iter().map(|(_, _, error)| *error);
            exponents.layer(Scatter::new(points).size(1.6).colour(colour).errors_y(errors))
        } else {
            exponents.layer(DensePoints::new(points).radius(0.6).colour(colour))
        };
    }
    Figure::new(DOUBLE_COLUMN, HEIGHT)
        .panels([diagram.legend(Legend::at(Corner::TopLeft).inset(24.0)), exponents])
}
