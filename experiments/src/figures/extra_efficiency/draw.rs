//! The drawing of the figure.

use std::f64::consts::PI;

use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Line, Marker, Panel, Raster, Rect, Rule,
    Scatter, Stroke, Text, Ticks,
};

use super::data::ExtraEfficiencyData;
use crate::colour_scale::colour;

/// Cells of the picture for each step of the map.
const FINER: usize = 8;

/// Efficiency (%) of one colour.
const STEP: f64 = 1.0;

pub(super) fn draw(data: &ExtraEfficiencyData) -> Figure {
    const HEIGHT: f64 = 215.0;
    let area = Rect::new(44.0, 12.0, 190.0, 165.0);
    let bar = Rect::new(242.0, 12.0, 8.0, 165.0);
    let right = Rect::new(330.0, 12.0, 168.0, 165.0);
    let levels = (100.0 * data.best.efficiency.value / STEP).ceil().max(1.0) as usize;
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
        map(data, area, levels),
        colour_bar(bar, levels),
        shares(data, right),
    ])
}

/// A grey for what is driven back, and the colours of the levels.
fn palette(levels: usize) -> Vec<Colour> {
    let steps = (0..levels).map(|level| colour((level as f64 + 0.5) / levels as f64));
    std::iter::once(Colour::PALE_GREY).chain(steps).collect()
}

/// The value between four neighbours; `None` if one is missing.
fn between(rows: &[Vec<Option<f64>>], x: f64, y: f64) -> Option<f64> {
    let (column, row) = ((x as usize).min(rows[0].len() - 2), (y as usize).min(rows.len() - 2));
    let (u, v) = (x - column as f64, y - row as f64);
    let at = |down: usize, across: usize| rows[row + down][column + across];
    let low = at(0, 0)? * (1.0 - u) + at(0, 1)? * u;
    let high = at(1, 0)? * (1.0 - u) + at(1, 1)? * u;
    Some(low * (1.0 - v) + high * v)
}

fn map(data: &ExtraEfficiencyData, area: Rect, levels: usize) -> Panel {
    let (columns, rows) = (data.phase_lags_rad.len(), data.load_shares.len());
    let (wide, high) = (FINER * (columns - 1), FINER * (rows - 1));
    let place = |index: usize| (index as f64 + 0.5) / FINER as f64;
    let cells = (0..high).flat_map(|row| (0..wide).map(move |column| (place(column), place(row))));
    let cells: Vec<u8> = cells
        .map(|(x, y)| match between(&data.power_ratios, x, y) {
            Some(share) if between(&data.speeds_rad_per_s, x, y).is_some_and(|speed| speed > 0.0) => {
                1 + ((100.0 * share / STEP).max(0.0) as usize).min(levels - 1) as u8
            }
            _ => 0,
        })
        .collect();
    let lag = |index: usize| data.phase_lags_rad.get(index).map_or(0.0, |lag| lag / PI);
    let x_ends = (lag(0), lag(columns - 1));
    let last = data.load_shares.last().copied().unwrap_or(1.0);
    Panel::new(area)
        .x(Axis::linear(x_ends.0, x_ends.1)
            .label(r"phase lag $\theta/\pi$")
            .ticks(Ticks::every(0.2).minor(2)))
        .y(Axis::linear(0.0, last).label(r"load $T/(\mu m g a_e)$").ticks(Ticks::every(0.2).minor(4)))
        .letter_in("a", Corner::TopRight)
        .layer(Raster::new(wide, high, cells, &palette(levels), x_ends, (0.0, last)))
        .layer(
            Rule::vertical(data.motor.parameters().phase_lag / PI)
                .stroke(Stroke::new(Colour::DARK_GREY, 0.6).dashed(Dash::Dotted)),
        )
        .layer(Line::new(stall_line(data)).width(0.9))
        .layer(
            Scatter::new([(data.best.phase_lag_rad / PI, data.best.load_share)])
                .marker(Marker::Circle)
                .colour(Colour::WHITE)
                .size(7.0)
                .width(1.4),
        )
        .layer(
            Text::at_axes(0.5, 0.93, "driven back").anchor(Anchor::Centre).size(8.0).halo(Colour::PALE_GREY),
        )
}

/// Lag over π and load at which the speed passes zero, on the straight line between two loads.
fn stall_line(data: &ExtraEfficiencyData) -> Vec<(f64, f64)> {
    let crossing = |column: usize| {
        (1..data.load_shares.len()).find_map(|row| {
            let [below, above] = [row - 1, row].map(|row| data.speeds_rad_per_s[row][column]);
            let (below, above) = (below?, above?);
            let (from, to) = (data.load_shares[row - 1], data.load_shares[row]);
            (below > 0.0 && above <= 0.0).then(|| from + (to - from) * below / (below - above))
        })
    };
    data.phase_lags_rad
        .iter()
        .enumerate()
        .map(|(column, lag)| (lag / PI, crossing(column).unwrap_or(f64::NAN)))
        .collect()
}

fn colour_bar(area: Rect, levels: usize) -> Panel {
    let top = STEP * levels as f64;
    let cells = (1..=levels).map(|level| level as u8).collect();
    Panel::new(area)
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(0.0, top).ticks(Ticks::none()))
        .right(Axis::linear(0.0, top).label("efficiency (%)").ticks(Ticks::every(2.0).minor(2)))
        .layer(Raster::new(1, levels, cells, &palette(levels), (0.0, 1.0), (0.0, top)))
}

fn shares(data: &ExtraEfficiencyData, area: Rect) -> Panel {
    let largest = data.motor.largest_torque();
    let driving: Vec<(f64, [f64; 3])> = data
        .along_load
        .points
        .iter()
        .take_while(|point| point.mechanical_power.value >= 0.0)
        .map(|point| {
            let parts =
                [point.mechanical_power, point.friction_loss, point.restitution_loss].map(|part| part.value);
            // What is stored, and what the perturbation puts in, are no share of anything.
            let whole: f64 = parts.iter().sum();
            (point.load_torque / largest, parts.map(|part| part / whole))
        })
        .collect();
    let last = driving.last().map_or(1.0, |(load, _)| *load);
    let band = |from: fn(&[f64; 3]) -> f64, to: fn(&[f64; 3]) -> f64, colour: Colour| {
        Band::new(driving.iter().map(|(load, parts)| (*load, from(parts), to(parts))).collect::<Vec<_>>())
            .colour(colour)
            .opacity(1.0)
    };
    let edge = |of: fn(&[f64; 3]) -> f64| {
        Line::new(driving.iter().map(|(load, parts)| (*load, of(parts))).collect::<Vec<_>>()).width(0.7)
    };
    let middle = driving.get(driving.len() / 2).map_or([0.3; 3], |(_, parts)| *parts);
    let label =
        |height: f64, words: &str| Text::at_data(0.5 * last, height, words).anchor(Anchor::Centre).size(8.5);
    Panel::new(area)
        .x(Axis::linear(0.0, last).label(r"load $T/(\mu m g a_e)$").ticks(Ticks::every(0.2).minor(4)))
        .y(Axis::linear(0.0, 1.0).label("share of the energy put in").ticks(Ticks::every(0.2).minor(2)))
        .letter_in("b", Corner::TopRight)
        .layer(band(|_| 0.0, |parts| parts[0], Colour::rgb(150, 205, 160)))
        .layer(band(|parts| parts[0], |parts| parts[0] + parts[1], Colour::rgb(245, 205, 150)))
        .layer(band(|parts| parts[0] + parts[1], |_| 1.0, Colour::rgb(170, 200, 225)))
        .layer(edge(|parts| parts[0]))
        .layer(edge(|parts| parts[0] + parts[1]))
        .layer(label(0.5 * middle[0], "mechanical work"))
        .layer(label(middle[0] + 0.5 * middle[1], "friction"))
        .layer(label(0.5 * (1.0 + middle[0] + middle[1]), "restitution"))
}
