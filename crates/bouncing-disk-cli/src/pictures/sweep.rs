//! A sweep of a motor: a curve with its errors over one field, a map over two.

use bouncing_disk::core::numerics::statistics::NORMAL_975;
use bouncing_disk::motor::{MotorSweepResult, SweepAxis, SweepQuantity};
use bouncing_disk_plot::{
    Axis, Band, Colour, Figure, Line, Panel, Raster, Rect, SINGLE_COLUMN, Scatter, Ticks,
};

use super::{axis, spanned};

/// Colours of a map, between the least and the largest value.
const LEVELS: usize = 24;

/// The factor by which numbers of this unit are multiplied, so that they are of the size of 1, and the unit
/// with its prefix.
pub(super) fn prefixed(values: impl Iterator<Item = f64>, unit: &str) -> (f64, String) {
    let size = values.filter(|value| value.is_finite()).fold(0.0_f64, |most, value| most.max(value.abs()));
    let prefixes = [(1.0, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n")];
    let fits = |scale: &f64| size == 0.0 || size * scale >= 1.0;
    // Angles, shares and frequencies are left as they are.
    let small = matches!(unit, "m" | "N" | "N m" | "W" | "kg");
    let (scale, prefix) = prefixes.into_iter().find(|(scale, _)| fits(scale)).unwrap_or((1.0, ""));
    match unit {
        "1" => (1.0, String::new()),
        // Not a millikilogram.
        "kg" if size > 0.0 && size < 1.0 => (1e3, "g".to_owned()),
        "kg" => (1.0, "kg".to_owned()),
        _ if small => (scale, format!("{prefix}{unit}")),
        _ => (1.0, unit.replace("^2", "$^2$").replace("^3", "$^3$")),
    }
}

/// Words and a unit.
fn label(name: &str, unit: &str) -> String {
    let name = name.replace('_', " ");
    if unit.is_empty() { name } else { format!("{name} ({unit})") }
}

/// What a picture shows: the scale, and the label of its axis.
fn shown(quantity: SweepQuantity, values: impl Iterator<Item = f64>) -> (f64, String) {
    if quantity == SweepQuantity::Efficiency {
        return (100.0, "efficiency (%)".to_owned());
    }
    let (scale, unit) = prefixed(values, quantity.unit());
    (scale, label(quantity.name(), &unit))
}

/// The quantity over the axes. What a cell does not have is a gap in a curve, and grey in a map.
pub(crate) fn draw(result: &MotorSweepResult, quantity: SweepQuantity) -> Figure {
    match result.axes() {
        [rows, columns, ..] => map(result, quantity, rows, columns),
        [only] => curve(result, quantity, only),
        [] => Figure::new(SINGLE_COLUMN, SINGLE_COLUMN),
    }
}

fn curve(result: &MotorSweepResult, quantity: SweepQuantity, along: &SweepAxis) -> Figure {
    let (across, unit) = prefixed(along.values.iter().copied(), along.parameter.unit());
    let values = || result.cells().iter().filter_map(|cell| quantity.of(cell)).map(|estimate| estimate.value);
    let (scale, words) = shown(quantity, values());
    let points: Vec<(f64, f64, f64)> = along
        .values
        .iter()
        .zip(result.cells())
        .map(|(value, cell)| {
            let estimate = quantity.of(cell);
            let of = |number: Option<f64>| number.map_or(f64::NAN, |number| scale * number);
            let bar = of(estimate.map(|estimate| NORMAL_975 * estimate.standard_error));
            (across * value, of(estimate.map(|estimate| estimate.value)), bar)
        })
        .collect();
    let line: Vec<(f64, f64)> = points.iter().map(|point| (point.0, point.1)).collect();
    let dots: Vec<(f64, f64)> = line.iter().copied().filter(|point| point.1.is_finite()).collect();
    let band = Band::new(points.iter().map(|(x, y, bar)| (*x, y - bar, y + bar)));
    let panel = Panel::new(Rect::new(48.0, 12.0, 186.0, 150.0))
        .x(axis(along.values.iter().map(|value| across * value)).label(label(along.parameter.name(), &unit)))
        .y(axis(points.iter().flat_map(|(_, y, bar)| [y - bar, y + bar, 0.0])).label(words))
        .layer(band.colour(Colour::LIGHT_GREY).opacity(0.8))
        .layer(Line::new(line).width(0.8).colour(Colour::BLUE))
        .layer(Scatter::new(dots).size(2.6).colour(Colour::BLUE));
    Figure::new(SINGLE_COLUMN, 202.0).panel(panel)
}

/// The outer ends of equal cells with these middles.
fn ends(values: &[f64], scale: f64) -> (f64, f64) {
    let (low, high) = (scale * values[0], scale * values[values.len() - 1]);
    let half = match values.len() {
        1 => 0.5 * low.abs().max(1e-9),
        count => 0.5 * (high - low) / (count - 1) as f64,
    };
    (low - half, high + half)
}

fn map(result: &MotorSweepResult, quantity: SweepQuantity, rows: &SweepAxis, columns: &SweepAxis) -> Figure {
    let matrix = result.matrix(quantity);
    let known = || matrix.iter().flatten().flatten().copied();
    let (scale, words) = shown(quantity, known());
    let least = scale * known().fold(f64::INFINITY, f64::min);
    let most = scale * known().fold(f64::NEG_INFINITY, f64::max);
    // All cells alike, or none with a value.
    let (least, most) = match (least, most) {
        (least, most) if least < most => (least, most),
        (least, _) if least.is_finite() && least.abs() > 0.0 => {
            (least - 0.5 * least.abs(), least + 0.5 * least.abs())
        }
        _ => (0.0, 1.0),
    };
    let level = |value: f64| {
        let share = (scale * value - least) / (most - least);
        1 + ((share * LEVELS as f64).max(0.0) as usize).min(LEVELS - 1) as u8
    };
    let steps = (0..LEVELS).map(|level| Colour::scale((level as f64 + 0.5) / LEVELS as f64));
    let palette: Vec<Colour> = std::iter::once(Colour::PALE_GREY).chain(steps).collect();
    let (across, x_unit) = prefixed(columns.values.iter().copied(), columns.parameter.unit());
    let (up, y_unit) = prefixed(rows.values.iter().copied(), rows.parameter.unit());
    let (x, y) = (ends(&columns.values, across), ends(&rows.values, up));
    let cells = matrix.iter().flatten().map(|value| value.map_or(0, level)).collect();
    let map = Panel::new(Rect::new(48.0, 12.0, 156.0, 150.0))
        .x(Axis::linear(x.0, x.1).label(label(columns.parameter.name(), &x_unit)))
        .y(Axis::linear(y.0, y.1).label(label(rows.parameter.name(), &y_unit)))
        .layer(Raster::new(columns.values.len(), rows.values.len(), cells, &palette, x, y));
    let bar = (1..=LEVELS).map(|level| level as u8).collect();
    let key = Panel::new(Rect::new(212.0, 12.0, 8.0, 150.0))
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(least, most).ticks(Ticks::none()))
        .right(spanned(least, most).label(words))
        .layer(Raster::new(1, LEVELS, bar, &palette, (0.0, 1.0), (least, most)));
    Figure::new(SINGLE_COLUMN + 30.0, 202.0).panels([map, key])
}
