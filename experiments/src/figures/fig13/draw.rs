//! The drawing of Fig. 13.

use std::f64::consts::PI;

use bouncing_disk_plot::{
    Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Marker, Panel,
    Rect, Scatter, Ticks,
};

use super::single_orbits::MiddleRange;
use super::{Study, Sweep, SweepPoint};
use crate::figures::shared::inputs::motor as inputs;

/// Speeds belong to the left scale, stall accelerations to the right one.
const SPEED: Colour = Colour::BLACK;
const STALL: Colour = Colour::BLUE;

/// The panel with room for a legend: (e).
const LEGEND: usize = 4;
/// The panel with room for the names of the bands: (d).
const BANDS: usize = 3;

pub(super) fn draw(study: &Study) -> Figure {
    const HEIGHT: f64 = 500.0;
    let margins = Margins { left: 44.0, right: 44.0, top: 10.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 3, 2).margins(margins).gaps(96.0, 40.0);
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    for (index, sweep) in study.sweeps.iter().enumerate() {
        figure = figure.panel(sensitivity(grid.cell(index / 2, index % 2), study, sweep, index));
    }
    figure.panel(phases(grid.cell(2, 1), study))
}

fn sensitivity(area: Rect, study: &Study, sweep: &Sweep, index: usize) -> Panel {
    let letter = ["a", "b", "c", "d", "e"][index.min(4)];
    // With their bars.
    let stalls = sweep.points.iter().filter_map(|point| point.statistics.stall_acceleration_rad_per_s2);
    let predicted = sweep.points.iter().filter_map(|point| point.predicted_stall_acceleration_rad_per_s2);
    let highest = stalls.map(|spread| spread.mean.abs() + spread.deviation).chain(predicted);
    let highest = highest.fold(0.0, f64::max);
    let torque = (1.15 * highest).max(40.0);
    let limits: Vec<(f64, f64)> = sweep
        .points
        .iter()
        .map(|point| (point.value, sweep.parameter.set(&study.motor, point.value).largest_acceleration()))
        .collect();
    let default = sweep.parameter.of(&study.motor);
    let signed = sweep.parameter == inputs::PHASE_LAG;
    let lowest = |top: f64| if signed { -top } else { 0.0 };
    let step = if torque > 60.0 { 30.0 } else { 10.0 };
    let steps = if signed { 2.0 * step } else { step };
    let alike = study.alike.ranges.get(index);
    let middle = |of: fn(&MiddleRange) -> &[[f64; 2]]| {
        let points = alike.into_iter().flat_map(move |range| range.values.iter().zip(of(range)));
        let mut points: Vec<_> = points.map(|(value, [low, high])| (*value, *low, *high)).collect();
        // The values at -π are those at π.
        if let Some((_, low, high)) = points.first().copied().filter(|_| signed) {
            points.push((PI, low, high));
        }
        points
    };
    // One as an area, the other by its ends: two areas would mix.
    let speeds = Band::new(middle(|range| &range.speed_ratio)).colour(Colour::PALE_GREY);
    let stalls = middle(|range| &range.stall_acceleration_rad_per_s2);
    let end = |of: fn(&(f64, f64, f64)) -> (f64, f64)| {
        Line::new(stalls.iter().map(of)).colour(Colour::SKY).width(0.9)
    };
    let (lowest_stall, highest_stall) = (end(|point| (point.0, point.1)), end(|point| (point.0, point.2)));
    let (speeds, lowest_stall) = if index == BANDS {
        (speeds.name("5–95 % of orbits, speed"), lowest_stall.name("the same, stall torque"))
    } else {
        (speeds, lowest_stall)
    };
    let panel = Panel::new(area)
        .letter(letter)
        .layer(speeds)
        .layer_right(lowest_stall)
        .layer_right(highest_stall)
        .x(horizontal(sweep))
        .y(Axis::linear(lowest(1.1), 1.1)
            .ticks(Ticks::every(if signed { 0.5 } else { 0.2 }))
            .colour(SPEED)
            .label(r"$\dot{\alpha}_{ss}/(\omega\Phi)$"))
        .right(
            Axis::linear(lowest(torque), torque)
                .ticks(Ticks::every(steps))
                .colour(STALL)
                .label(r"$\dot{\alpha}_{ss}/t_c$ (rad/s$^2$)"),
        );
    let predicted = |of: fn(&SweepPoint) -> Option<f64>, colour: Colour| {
        Line::new(sweep.points.iter().filter_map(|point| of(point).map(|y| (point.value, y))))
            .colour(colour.mixed(Colour::WHITE, 0.35))
            .width(0.7)
            .dash(Dash::Dotted)
    };
    let mut panel = panel
        .layer(predicted(|point| Some(point.predicted_speed_ratio), SPEED))
        .layer_right(predicted(|point| point.predicted_stall_acceleration_rad_per_s2, STALL))
        .layer(Line::new([(default, lowest(1.1)), (default, 1.1)]).colour(Colour::GREY).width(0.5));
    for sign in if signed { &[1.0, -1.0][..] } else { &[1.0][..] } {
        let line = Line::new(limits.iter().map(|(value, limit)| (*value, sign * limit)));
        let line = line.colour(Colour::VERMILION).width(0.8).dash(Dash::DashDotted);
        panel =
            panel.layer_right(if index == LEGEND { line.name("limit of the stall torque") } else { line });
    }
    let above = sweep.points.iter().zip(&limits).filter_map(|(point, (value, limit))| {
        Some((*value, point.stall().filter(|stall| stall.abs() > *limit)?))
    });
    // Behind the dots, as a ring around them.
    let above = Scatter::new(above).marker(Marker::Circle).colour(Colour::VERMILION).width(1.0).size(7.0);
    panel = panel.layer_right(if index == LEGEND { above.name("stall above the limit") } else { above });
    for low_period in [true, false] {
        let points =
            || sweep.points.iter().filter(move |point| point.statistics.is_low_period() == low_period);
        let speed = |point: &SweepPoint| {
            let error =
                point.statistics.steady_speed_rad_per_s.deviation / point.peak_angular_speed_rad_per_s;
            (point.value, point.speed_ratio(), error)
        };
        let stall = |point: &SweepPoint| {
            point
                .statistics
                .stall_acceleration_rad_per_s2
                .map(|spread| (point.value, spread.mean, spread.deviation))
        };
        let tint = |colour: Colour| if low_period { colour.mixed(Colour::WHITE, 0.6) } else { colour };
        let speeds = scatter(points().map(speed).collect(), tint(SPEED)).marker(Marker::Cross).size(5.0);
        let stalls = scatter(points().filter_map(stall).collect(), tint(STALL)).size(3.6);
        let (speeds, stalls) = match (index, low_period) {
            (LEGEND, false) => (speeds.name("speed, left scale"), stalls.name("stall, right scale")),
            (BANDS, true) => (speeds.name("low-period cycle, speed"), stalls.name("the same, stall torque")),
            _ => (speeds, stalls),
        };
        panel = panel.layer(speeds).layer_right(stalls);
    }
    if matches!(index, LEGEND | BANDS) { panel.legend(Legend::at(Corner::BottomRight)) } else { panel }
}

fn scatter(points: Vec<(f64, f64, f64)>, colour: Colour) -> Scatter {
    Scatter::new(points.iter().map(|(x, y, _)| (*x, *y)))
        .errors_y(points.iter().map(|point| point.2))
        .colour(colour)
}

fn horizontal(sweep: &Sweep) -> Axis {
    match sweep.parameter.name {
        "friction" => Axis::linear(0.0, 0.42).ticks(Ticks::every(0.1)).label(r"$\mu$"),
        "restitution" => Axis::linear(-0.03, 0.95).ticks(Ticks::every(0.2)).label(r"$\epsilon$"),
        "phase_lag" => Axis::linear(-1.06 * PI, 1.06 * PI).ticks(Ticks::pi(1, 2)).label(r"$\theta$ (rad)"),
        "amplitude" => Axis::log(8e-10, 1.25e-7).label(r"$A$ (m)"),
        _ => Axis::linear(0.0, 63.0).ticks(Ticks::every(20.0)).label(r"$\omega\Phi$ (rad/s)"),
    }
}

/// Where in the cycle the normal impulse falls.
fn phases(area: Rect, study: &Study) -> Panel {
    let styles =
        [(Colour::VERMILION, Dash::Dashed), (Colour::BLACK, Dash::Solid), (Colour::GREEN, Dash::DashDotted)];
    let highest = study.impulses.iter().flat_map(|impulse| &impulse.shares).copied().fold(0.0, f64::max);
    let parts = study.impulses.first().map_or(1, |impulse| impulse.shares.len()) as f64;
    let mut panel = Panel::new(area)
        .letter("f")
        .x(Axis::linear(-PI, PI).ticks(Ticks::pi(1, 2)).label(r"$\tau$ (rad)"))
        .y(Axis::linear(0.0, 1.25 * highest * parts / (2.0 * PI)).label("share of impulse (1/rad)"));
    for (impulse, (colour, dash)) in study.impulses.iter().zip(styles) {
        let steps = impulse.shares.iter().enumerate().flat_map(|(part, share)| {
            let (from, to) = (part as f64 / parts, (part as f64 + 1.0) / parts);
            [from, to].map(|turned| ((2.0 * turned - 1.0) * PI, share * parts / (2.0 * PI)))
        });
        let name = format!(r"$\epsilon = {}$", impulse.restitution);
        panel = panel.layer(Line::new(steps).colour(colour).dash(dash).width(0.9).name(name));
    }
    panel.legend(Legend::at(Corner::TopRight))
}
