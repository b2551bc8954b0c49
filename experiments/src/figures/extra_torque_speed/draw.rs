//! The drawing of the figure.

use bouncing_disk::core::numerics::statistics::NORMAL_975;
use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, Dash, Figure, Grid, Legend, Line, Margins, Marker, Panel, Rule,
    SINGLE_COLUMN, Scatter, Stroke, Text, Ticks,
};

use super::data::ExtraTorqueSpeedData;

/// Newton metres in micronewton metres.
const MICRO: f64 = 1e6;

/// The right end of the axis, as a share of the largest torque.
const LAST: f64 = 1.12;

pub(super) fn draw(data: &ExtraTorqueSpeedData) -> Figure {
    const HEIGHT: f64 = 330.0;
    let margins = Margins { left: 40.0, right: 12.0, top: 34.0, bottom: 34.0 };
    let grid = Grid::new(SINGLE_COLUMN, HEIGHT, 2, 1).margins(margins).gaps(10.0, 12.0);
    Figure::new(SINGLE_COLUMN, HEIGHT).panel(speeds(data, &grid)).panel(powers(data, &grid))
}

/// A panel over the loads, with the region in which the motor runs away.
fn frame(data: &ExtraTorqueSpeedData, grid: &Grid, row: usize, y: Axis, (low, high): (f64, f64)) -> Panel {
    let last = LAST * MICRO * data.largest_torque_n_m;
    let x = Axis::linear(0.0, last).ticks(Ticks::every(10.0).minor(5));
    let top = Axis::linear(0.0, LAST).ticks(Ticks::every(0.2).minor(2));
    let (x, top) = if row == 0 {
        (x.without_numbers(), top.label(r"load $T/(\mu m g a_e)$"))
    } else {
        (x.label(r"load torque $T$ (µN m)"), top.without_numbers())
    };
    let largest = MICRO * data.largest_torque_n_m;
    let runaway = Band::new([(largest, low, high), (last, low, high)]).colour(Colour::PALE_GREY).opacity(1.0);
    Panel::new(grid.cell(row, 0))
        .x(x)
        .top(top)
        .y(y)
        .letter_in(["a", "b"][row], Corner::TopRight)
        .layer(runaway)
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::GREY, 0.5)))
        .layer(Rule::vertical(largest).stroke(Stroke::new(Colour::DARK_GREY, 0.8)))
}

fn speeds(data: &ExtraTorqueSpeedData, grid: &Grid) -> Panel {
    let points = &data.curve.points;
    let fastest = points.iter().map(|point| point.speed.value).fold(0.0_f64, f64::max);
    let slowest = points.iter().map(|point| point.speed.value).fold(0.0_f64, f64::min);
    let (low, high) = (1.08 * slowest, 1.3 * fastest);
    let y =
        Axis::linear(low, high).ticks(Ticks::every(5.0).minor(5)).label(r"mean speed $\dot{\alpha}$ (rad/s)");
    let curve = || points.iter().map(|point| (MICRO * point.load_torque, point.speed.value));
    let band = points.iter().map(|point| {
        let (load, half) = (MICRO * point.load_torque, NORMAL_975 * point.speed.standard_error);
        (load, point.speed.value - half, point.speed.value + half)
    });
    let stall = &data.stall;
    let bracket = stall.bracket_n_m.map(|torque| (MICRO * torque, low, high));
    let estimate = data.transient.stall_estimate_n_m;
    let half = 0.5 * MICRO * (estimate.high - estimate.low);
    let largest = MICRO * data.largest_torque_n_m;
    frame(data, grid, 0, y, (low, high))
        .layer(Band::new(bracket).colour(Colour::SKY).opacity(0.5))
        .layer(Band::new(band).colour(Colour::LIGHT_GREY).opacity(0.8))
        .layer(Line::new(curve()).width(0.8))
        .layer(Scatter::new(curve()).size(2.6))
        .layer(
            Scatter::new([(MICRO * stall.torque_n_m.value, 0.0)])
                .marker(Marker::Square)
                .colour(Colour::BLUE)
                .size(6.0)
                .width(1.2)
                .errors_x([NORMAL_975 * MICRO * stall.torque_n_m.standard_error])
                .name("stall load"),
        )
        .layer(
            Scatter::new([(MICRO * estimate.value, 0.0)])
                .marker(Marker::Diamond)
                .colour(Colour::VERMILION)
                .size(7.0)
                .width(1.2)
                .errors_x([half])
                .name(r"$I\dot{\alpha}_{ss}/t_c$ (paper)"),
        )
        .layer(
            Text::at_data(1.06 * largest, 0.5 * (low + high), r"runs away")
                .anchor(Anchor::Centre)
                .rotated(90.0)
                .size(8.0),
        )
        .legend(Legend::at(Corner::BottomLeft))
}

fn powers(data: &ExtraTorqueSpeedData, grid: &Grid) -> Panel {
    let points = &data.curve.points;
    let powers = || points.iter().map(|point| MICRO * point.mechanical_power.value);
    let highest = powers().fold(0.0_f64, f64::max);
    let (low, high) = (-0.35 * highest, 1.25 * highest);
    let y = Axis::linear(low, high).label(r"mechanical power $T\dot{\alpha}$ (µW)");
    let curve = || points.iter().map(|point| MICRO * point.load_torque).zip(powers());
    let band = points.iter().map(|point| {
        let (load, power) = (MICRO * point.load_torque, MICRO * point.mechanical_power.value);
        let half = NORMAL_975 * MICRO * point.mechanical_power.standard_error;
        (load, power - half, power + half)
    });
    let first = points.first().map_or(0.0, |point| point.speed.value);
    let stall = data.stall.torque_n_m.value;
    // Of a straight line from the speed without load to the stall load.
    let parabola = (0..=60).map(|k| {
        let load = stall * f64::from(k) / 60.0;
        (MICRO * load, MICRO * load * first * (1.0 - load / stall))
    });
    let peak = &data.drawn_peak;
    frame(data, grid, 1, y, (low, high))
        .layer(Band::new(band).colour(Colour::LIGHT_GREY).opacity(0.8))
        .layer(
            Line::new(parabola)
                .dash(Dash::Dashed)
                .colour(Colour::GREY)
                .width(0.7)
                .name("of a straight speed line"),
        )
        .layer(Line::new(curve()).width(0.8))
        .layer(Scatter::new(curve()).size(2.6))
        .layer(
            Scatter::new([(MICRO * peak.load_torque_n_m, MICRO * peak.power_w)])
                .marker(Marker::Circle)
                .colour(Colour::GREEN)
                .size(7.0)
                .width(1.2)
                .name("highest power"),
        )
        .legend(Legend::at(Corner::BottomLeft))
}
