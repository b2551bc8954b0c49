//! The drawing of the figure.

use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, Dash, Figure, Panel, Raster, Rect, Rule, Stroke, Ticks,
};

use super::data::{ExtraTrapsData, Map};

/// Cycles of one, two, three, and more flights.
const KINDS: usize = 4;
const COLOURS: [Colour; KINDS] = [Colour::VERMILION, Colour::BLUE, Colour::GREEN, Colour::DARK_GREY];
const NAMES: [&str; KINDS] = ["1", "2", "3", r"$\geq 4$"];

/// How much of a colour is left where the perturbation ends the cycle.
const PALE: f64 = 0.72;

/// White, and of each kind the pale and the full colour.
fn palette() -> Vec<Colour> {
    let pairs = COLOURS.into_iter().flat_map(|colour| [colour.mixed(Colour::WHITE, PALE), colour]);
    std::iter::once(Colour::WHITE).chain(pairs).collect()
}

fn cells(map: &Map) -> Vec<u8> {
    let flights = map.long_flights.iter().flatten();
    flights
        .zip(map.is_trap.iter().flatten())
        .map(|(flights, is_trap)| match flights {
            0 => 0,
            count => 1 + 2 * ((*count).min(KINDS) - 1) as u8 + u8::from(*is_trap),
        })
        .collect()
}

pub(super) fn draw(data: &ExtraTrapsData) -> Figure {
    const HEIGHT: f64 = 235.0;
    let left = Rect::new(40.0, 12.0, 196.0, 188.0);
    let right = Rect::new(276.0, 12.0, 166.0, 188.0);
    let key = Rect::new(460.0, 40.0, 24.0, 80.0);
    let first = f64::from(data.whole_forcings.first().copied().unwrap_or(1));
    let rows = data.whole_forcings.len();
    let y = (first - 0.5, first + rows as f64 - 0.5);
    let columns = data.forcing_fractions.len();
    let by_fraction = Panel::new(left)
        .x(Axis::linear(0.0, 1.0).label(r"fraction of $\Gamma$").ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(y.0, y.1).label(r"integer part of $\Gamma$"))
        .letter("a")
        .layer(Raster::new(columns, rows, cells(&data.by_fraction), &palette(), (0.0, 1.0), y))
        .layer(Rule::vertical(0.5).stroke(Stroke::new(Colour::BLACK, 0.5).dashed(Dash::Dotted)));
    let (wide, high) = (data.axial_forcings.len(), data.restitutions.len());
    let (x, y) = (edges(&data.axial_forcings), edges(&data.restitutions));
    let by_restitution = Panel::new(right)
        .x(Axis::linear(x.0, x.1).label(r"$\Gamma$").ticks(Ticks::every(0.5).minor(5)))
        .y(Axis::linear(y.0, y.1).label(r"restitution $\epsilon$").ticks(Ticks::every(0.2).minor(4)))
        .letter("b")
        .layer(Raster::new(wide, high, cells(&data.by_restitution), &palette(), x, y))
        .layer(
            Rule::horizontal(data.motor.parameters().restitution)
                .stroke(Stroke::new(Colour::BLACK, 0.5).dashed(Dash::Dotted)),
        );
    // Below each other, the pale colour on the left.
    let squares: Vec<u8> = (0..KINDS as u8).rev().flat_map(|kind| [1 + 2 * kind, 2 + 2 * kind]).collect();
    let ticks = (0..KINDS).map(|kind| ((KINDS - 1 - kind) as f64 + 0.5, NAMES[kind]));
    let legend = Panel::new(key)
        .x(Axis::linear(0.0, 2.0).ticks(Ticks::none()))
        .y(Axis::linear(0.0, KINDS as f64).ticks(Ticks::none()))
        .right(Axis::linear(0.0, KINDS as f64).ticks(Ticks::at(ticks)))
        .title("flights")
        .layer(Raster::new(2, KINDS, squares, &palette(), (0.0, 2.0), (0.0, KINDS as f64)));
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([by_fraction, by_restitution, legend])
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
