//! The drawing of Fig. 9.

use bouncing_disk_plot::{
    Axis, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Marker, Panel, Rect,
    Rule, Scatter, Ticks,
};

use super::data::Fig09Data;
use crate::figures::braking_record::friction_layers;

pub(super) fn draw(data: &Fig09Data) -> Figure {
    const HEIGHT: f64 = 200.0;
    let margins = Margins { left: 40.0, right: 10.0, top: 8.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 2).margins(margins).gaps(52.0, 20.0);
    Figure::new(DOUBLE_COLUMN, HEIGHT)
        .panel(speeds(grid.cell(0, 0), data))
        .panel(frictions(grid.cell(0, 1), data))
}

fn speeds(area: Rect, data: &Fig09Data) -> Panel {
    let last = data.curves.iter().map(|curve| curve.stop_s).fold(0.0, f64::max);
    let top = 1.1 * data.first_speed_rad_per_s;
    let mut panel = Panel::new(area)
        .letter_in("a", Corner::BottomLeft)
        .x(Axis::linear(0.0, 1.05 * last).label(r"$t$ (s)"))
        .y(Axis::linear(0.0, top).label(r"$\dot{\alpha}$ (rad/s)").ticks(Ticks::every(10.0)));
    let shown = [0, data.curves.len() / 2, data.curves.len().saturating_sub(1)];
    let colours = [Colour::SKY, Colour::GREEN, Colour::VERMILION];
    let mut lines = Vec::new();
    for (index, colour) in shown.into_iter().zip(colours) {
        let Some(curve) = data.curves.get(index) else { continue };
        let points = curve.time_s.iter().copied().zip(curve.angular_speed_rad_per_s.iter().copied());
        let fitted = [(0.0, -curve.brake_rad_per_s2 * curve.stop_s), (curve.stop_s, 0.0)];
        let name = format!("{:.0} mN", 1e3 * curve.preload_n);
        panel = panel.layer(Line::new(points).colour(colour).width(2.4).name(name));
        lines.push(Line::new(fitted).dash(Dash::Dashed));
    }
    if let Some(line) = lines.pop() {
        panel = panel.layers(lines).layer(line.name("straight line"));
    }
    for measured in &data.measured_decelerations {
        panel = panel.layers(measured.layers());
    }
    panel.legend(Legend::at(Corner::TopRight))
}

fn frictions(area: Rect, data: &Fig09Data) -> Panel {
    let milli = |points: &[(f64, f64)]| points.iter().map(|(n, mu)| (1e3 * n, *mu)).collect::<Vec<_>>();
    let recovered: Vec<_> = data.curves.iter().map(|curve| (1e3 * curve.preload_n, curve.friction)).collect();
    let panel = Panel::new(area)
        .letter_in("b", Corner::TopRight)
        .x(Axis::linear(60.0, 300.0).label("preload (mN)").ticks(Ticks::every(40.0)))
        .y(Axis::linear(0.0, 0.36).label(r"$\mu$").ticks(Ticks::every(0.1)))
        .layer(Rule::horizontal(data.printed_mean).name("printed mean"))
        .layer(Scatter::new(milli(&data.synthetic)).size(2.6).colour(Colour::GREY).name("synthetic"))
        .layer(Scatter::new(recovered).marker(Marker::Circle).colour(Colour::BLUE).name("model, Eq. (17)"));
    let panel = if data.measured_frictions.is_empty() {
        panel
    } else {
        panel.layers(friction_layers(&milli(&data.measured_frictions)))
    };
    panel.legend(Legend::at(Corner::TopLeft))
}
