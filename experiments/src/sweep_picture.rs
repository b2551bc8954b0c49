//! The picture of a sweep of a motor: a curve with its errors over one parameter, a map over two.

use bouncing_disk::core::numerics::statistics::NORMAL_975;
use bouncing_disk::{MotorSweepResult, SweepAxis, SweepQuantity};
use bouncing_disk_plot::{
    Axis, Band, Colour, Figure, Line, Panel, Raster, Rect, SINGLE_COLUMN, Scatter, Ticks,
};

use crate::colour_scale::colour;

/// Pixels of a map in each direction: each has the colour of the cell whose values are nearest.
const PIXELS: usize = 240;

/// Colours of a map, between the least and the largest value.
const LEVELS: usize = 24;

/// Draws a quantity of a sweep. What a cell does not have (the speed of a runaway, the efficiency of a motor that the load
/// drives) is a gap in a curve, and grey in a map.
#[must_use]
pub fn sweep_picture(result: &MotorSweepResult, quantity: SweepQuantity) -> Figure {
    match result.axes() {
        [rows, columns, ..] => map(result, quantity, rows, columns),
        [axis] => curve(result, quantity, axis),
        [] => Figure::new(SINGLE_COLUMN, SINGLE_COLUMN),
    }
}

fn title(quantity: SweepQuantity) -> String {
    let name = quantity.name().replace('_', " ");
    if quantity.unit() == "1" { name } else { format!("{name} ({})", quantity.unit()) }
}

/// An axis over all values, as far as half a step beyond the outermost of them.
fn axis_of(axis: &SweepAxis) -> ((f64, f64), Axis) {
    let low = axis.values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = axis.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let cells = axis.values.len();
    // One value alone has a cell of any width.
    let half = if high > low { 0.5 * (high - low) / (cells - 1) as f64 } else { 0.5 * low.abs().max(1e-9) };
    let ends = (low - half, high + half);
    let (name, unit) = (axis.parameter.name().replace('_', " "), axis.parameter.unit());
    let label = if unit == "1" { name } else { format!("{name} ({unit})") };
    (ends, Axis::linear(ends.0, ends.1).label(label))
}

fn curve(result: &MotorSweepResult, quantity: SweepQuantity, axis: &SweepAxis) -> Figure {
    let mut points: Vec<(f64, f64, f64)> = axis
        .values
        .iter()
        .zip(result.cells())
        .map(|(&value, cell)| match quantity.of(cell) {
            Some(estimate) => (value, estimate.value, NORMAL_975 * estimate.standard_error),
            None => (value, f64::NAN, f64::NAN),
        })
        .collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    let known = points.iter().filter(|(_, value, _)| value.is_finite());
    let y = Axis::around(known.flat_map(|(_, value, bar)| [value - bar, value + bar, 0.0]))
        .label(title(quantity));
    let runs = points.split(|(_, value, _)| !value.is_finite()).filter(|run| !run.is_empty());
    let bands: Vec<Band> = runs
        .map(|run| {
            Band::new(run.iter().map(|(x, y, bar)| (*x, y - bar, y + bar)).collect::<Vec<_>>())
                .colour(Colour::LIGHT_GREY)
                .opacity(0.8)
        })
        .collect();
    let line: Vec<(f64, f64)> = points.iter().map(|(x, y, _)| (*x, *y)).collect();
    let dots: Vec<(f64, f64)> = line.iter().copied().filter(|(_, y)| y.is_finite()).collect();
    let panel = Panel::new(Rect::new(44.0, 12.0, 185.0, 150.0)).x(axis_of(axis).1).y(y);
    let panel = bands.into_iter().fold(panel, Panel::layer);
    Figure::new(SINGLE_COLUMN, 205.0)
        .panel(panel.layer(Line::new(line).width(0.8)).layer(Scatter::new(dots).size(2.6)))
}

/// The index of the nearest of these values.
fn nearest(values: &[f64], at: f64) -> usize {
    let distance = |index: &usize| (values[*index] - at).abs();
    (0..values.len()).min_by(|one, other| distance(one).total_cmp(&distance(other))).unwrap_or(0)
}

/// A grey for cells without a value, and the colours of the levels.
fn palette() -> Vec<Colour> {
    let steps = (0..LEVELS).map(|level| colour((level as f64 + 0.5) / LEVELS as f64));
    std::iter::once(Colour::PALE_GREY).chain(steps).collect()
}

fn map(result: &MotorSweepResult, quantity: SweepQuantity, rows: &SweepAxis, columns: &SweepAxis) -> Figure {
    let matrix = result.matrix(quantity);
    let known = || matrix.iter().flatten().flatten().copied();
    let least = known().fold(f64::INFINITY, f64::min);
    let largest = known().fold(f64::NEG_INFINITY, f64::max);
    let (least, largest) = if least < largest { (least, largest) } else { (0.0, largest.abs().max(1e-300)) };
    let level = |value: f64| {
        let share = (value - least) / (largest - least);
        1 + ((share * LEVELS as f64).max(0.0) as usize).min(LEVELS - 1) as u8
    };
    let (x_ends, x) = axis_of(columns);
    let (y_ends, y) = axis_of(rows);
    let place =
        |index: usize, (low, high): (f64, f64)| low + (high - low) * (index as f64 + 0.5) / PIXELS as f64;
    let across: Vec<usize> =
        (0..PIXELS).map(|index| nearest(&columns.values, place(index, x_ends))).collect();
    let up: Vec<usize> = (0..PIXELS).map(|index| nearest(&rows.values, place(index, y_ends))).collect();
    let cells: Vec<u8> = up
        .iter()
        .flat_map(|&row| across.iter().map(move |&column| (row, column)))
        .map(|(row, column)| matrix[row][column].map_or(0, level))
        .collect();
    let bar = (1..=LEVELS).map(|level| level as u8).collect();
    let scale = Panel::new(Rect::new(206.0, 12.0, 7.0, 150.0))
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(least, largest).ticks(Ticks::none()))
        .right(Axis::linear(least, largest).label(title(quantity)))
        .layer(Raster::new(1, LEVELS, bar, &palette(), (0.0, 1.0), (least, largest)));
    Figure::new(SINGLE_COLUMN + 20.0, 205.0)
        .panel(Panel::new(Rect::new(44.0, 12.0, 155.0, 150.0)).x(x).y(y).layer(Raster::new(
            PIXELS,
            PIXELS,
            cells,
            &palette(),
            x_ends,
            y_ends,
        )))
        .panel(scale)
}

#[cfg(test)]
mod tests {
    use bouncing_disk::core::Unobserved;
    use bouncing_disk::{Motor, MotorField, MotorSweep, OperatingSettings};

    use super::*;

    fn swept(axes: Vec<SweepAxis>) -> MotorSweepResult {
        let settings = OperatingSettings { relative_error: 0.2, members: 4, ..OperatingSettings::default() };
        MotorSweep::new(Motor::paper_70_khz(), axes, settings)
            .expect("legal")
            .run(&Unobserved)
            .expect("no failure")
    }

    /// Curves and maps, of one value and of uneven ones, with cells that have no number.
    #[test]
    fn sweeps_of_every_form_are_drawn() {
        let largest = Motor::paper_70_khz().largest_torque();
        let loads = |shares: &[f64]| SweepAxis {
            parameter: MotorField::LoadTorque,
            values: shares.iter().map(|share| share * largest).collect(),
        };
        let lags = SweepAxis { parameter: MotorField::PhaseLag, values: vec![0.6, -0.1, 0.1] };
        for axes in [
            vec![loads(&[0.0])],
            vec![loads(&[0.0, 0.1, 0.6, 1.2])],
            vec![loads(&[1.2, 1.3])],
            vec![loads(&[0.0]), lags.clone()],
            vec![lags, loads(&[0.0, 0.5, 1.2])],
        ] {
            let result = swept(axes);
            for quantity in SweepQuantity::ALL {
                let figure = sweep_picture(&result, quantity);
                assert!(figure.to_svg().expect("drawn").contains("<svg"), "{quantity:?}");
            }
        }
        assert_eq!([0.0, 0.24, 0.26, 9.0].map(|at| nearest(&[0.0, 1.0, 0.5], at)), [0, 0, 2, 1]);
    }
}
