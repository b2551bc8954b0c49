//! The drawing of the figure.

use std::f64::consts::FRAC_1_PI;

use bouncing_disk::core::ImpactMap;
use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, Figure, Line, Panel, Raster, Rect, Rule, Stroke, Ticks,
};

use super::data::{ExtraRegimesData, Kind};

/// The name and the colour of each kind, in their order.
const KINDS: [(&str, Colour); 9] = [
    ("at rest", Colour::PALE_GREY),
    ("cycle with rest", Colour::WHITE),
    ("same, by rounding", Colour::rgb(250, 225, 160)),
    ("period 1", Colour::BLUE),
    ("period 2", Colour::SKY),
    ("period 3", Colour::GREEN),
    (r"period $\geq 4$", Colour::PURPLE),
    ("chaotic", Colour::VERMILION),
    ("undecided", Colour::BLACK),
];

/// Points of the lines in closed form.
const POINTS: usize = 200;

pub(super) fn draw(data: &ExtraRegimesData) -> Figure {
    const HEIGHT: f64 = 300.0;
    let area = Rect::new(40.0, 10.0, 350.0, 256.0);
    let key = Rect::new(404.0, 40.0, 12.0, 171.0);
    let palette = KINDS.map(|(_, colour)| colour);
    let cells =
        data.rows.iter().flat_map(|row| row.bytes().map(|digit| digit.saturating_sub(b'0'))).collect();
    let (x, y) = (edges(&data.axial_forcings), edges(&data.restitutions));
    let (wide, high) = (data.axial_forcings.len(), data.restitutions.len());
    let along = |forcing: fn(f64) -> f64| {
        let restitutions = (0..=POINTS).map(move |k| y.0 + (y.1 - y.0) * k as f64 / POINTS as f64);
        Line::new(restitutions.map(move |restitution| (forcing(restitution), restitution))).width(0.7)
    };
    let map = Panel::new(area)
        .x(Axis::linear(x.0, x.1).label(r"$\Gamma$").ticks(Ticks::every(0.5).minor(5)))
        .y(Axis::linear(y.0, y.1).label(r"restitution $\epsilon$").ticks(Ticks::every(0.2).minor(4)))
        .layer(Raster::new(wide, high, cells, &palette, x, y))
        .layer(along(|restitution| (1.0 - restitution) / (1.0 + restitution)).colour(Colour::BLACK))
        .layer(along(ImpactMap::first_doubling_forcing).colour(Colour::BLACK).dash(Dash::Dashed))
        .layer(Rule::vertical(FRAC_1_PI).stroke(Stroke::new(Colour::BLACK, 0.6).dashed(Dash::Dotted)));
    let count = Kind::ALL.len();
    let squares = (0..count as u8).rev().collect();
    let ticks = KINDS.iter().enumerate().map(|(k, (name, _))| ((count - 1 - k) as f64 + 0.5, *name));
    let ends = (0.0, count as f64);
    let legend = Panel::new(key)
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(ends.0, ends.1).ticks(Ticks::none()))
        .right(Axis::linear(ends.0, ends.1).ticks(Ticks::at(ticks)))
        .layer(Raster::new(1, count, squares, &palette, (0.0, 1.0), ends));
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([map, legend])
}

/// The outer edges of equal cells with these middles.
fn edges(middles: &[f64]) -> (f64, f64) {
    match middles {
        [first, second, .., last] => {
            let half = 0.5 * (second - first);
            (first - half, last + half)
        }
        _ => (0.0, 1.0),
    }
}
