//! The drawing of Fig. 10.

use bouncing_disk::estimate::ExponentialFit;
use bouncing_disk_plot::pictures::FittedCurve;
use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Panel, Rect, Text,
    Ticks,
};

use super::data::{Exception, Fig10Data, Reading, Transient};
use crate::figures::shared::alike::SpeedBand;
use crate::figures::shared::numbers::exponent;

/// Height of a row.
const ROW: f64 = 150.0;

pub(super) fn draw(data: &Fig10Data) -> Figure {
    let height = ROW * 2.0;
    let grid = Grid::new(DOUBLE_COLUMN, height, 2, 3);
    let mut figure = Figure::new(DOUBLE_COLUMN, height);
    // The paper's (d)-(f) are measured curves.
    let letters = [["a", "b", "c"], ["a′", "b′", "c′"]];
    for (row, reading) in data.readings.iter().enumerate() {
        let speeds = reading.panels.iter().flat_map(|panel| panel.member_speed_rad_per_s.iter().copied());
        let highest = speeds.fold(0.0_f64, f64::max);
        for (column, panel) in reading.panels.iter().enumerate() {
            let exception = (row == 0 && column == 0).then_some(&data.exception);
            let cell = grid.cell(row, column);
            let alike = (row == 0).then(|| &data.alike.bands[column]);
            figure =
                figure.panel(drawn(cell, letters[row][column], reading, panel, highest, exception, alike));
        }
    }
    figure
}

fn drawn(
    area: Rect,
    letter: &str,
    reading: &Reading,
    panel: &Transient,
    highest: f64,
    exception: Option<&Exception>,
    alike: Option<&SpeedBand>,
) -> Panel {
    let fit = panel.member_fit;
    let fitted = curve(fit, reading.duration_s);
    let band = panel
        .band_time_s
        .iter()
        .zip(panel.band_low_rad_per_s.iter().zip(&panel.band_high_rad_per_s))
        .map(|(&time, (&low, &high))| (time, low, high));
    let member =
        panel.member_time_s.iter().zip(&panel.member_speed_rad_per_s).map(|(&time, &speed)| (time, speed));
    let note = |y: f64, text: String| Text::at_axes(0.95, y, text).anchor(Anchor::Right);
    let named = |line: Line, panel: &str, name: &str| if letter == panel { line.name(name) } else { line };
    let mut drawn = Panel::new(area);
    if let Some(alike) = alike {
        let speeds = alike.low_rad_per_s.iter().zip(&alike.high_rad_per_s);
        let points = alike.time_s.iter().zip(speeds).map(|(&time, (&low, &high))| (time, low, high));
        let band = Band::new(points).colour(Colour::LIGHT_GREY).opacity(0.45);
        drawn = drawn.layer(if letter == "c" { band.name("single orbits") } else { band });
    }
    let mut drawn = drawn
        .letter_in(letter, Corner::TopLeft)
        .x(Axis::linear(0.0, reading.duration_s)
            .ticks(Ticks::every(if reading.duration_s > 2.0 { 2.0 } else { 0.3 }))
            .label(r"$t$ (s)"))
        .y(Axis::linear(0.0, 1.4 * highest).ticks(Ticks::every(10.0)).label(r"$\dot{\alpha}$ (rad/s)"))
        .layer(named(Line::new(member).colour(Colour::GREY).width(0.6), "a", "one member"))
        .layer(named(fitted.line(), "b", "fit of the member"))
        .layer(note(0.30, format!("$A = 10^{{{}}}$ m", exponent(panel.amplitude_m))))
        .layer(note(0.22, format!("$g = {}$ m/s$^2$", reading.preload_acceleration_m_per_s2)))
        .layers(fitted.notes(1, 0.06, 0.08));
    let band = Band::new(band).colour(Colour::BLUE).opacity(0.30);
    drawn = drawn.layer(if letter == "b" { band.name("ensemble") } else { band });
    if let Some(exception) = exception {
        let curve =
            exception.time_s.iter().zip(&exception.speed_rad_per_s).map(|(&time, &speed)| (time, speed));
        let name = format!("$g = {}$ exactly", exception.preload_acceleration_m_per_s2);
        let line = Line::new(curve).colour(Colour::VERMILION).width(1.0).dash(Dash::Dotted);
        drawn = drawn.layer(line.name(name));
    }
    // Two entries of the legend in each of two panels, as there is little room above the curves.
    if matches!(letter, "a" | "b" | "c") { drawn.legend(Legend::at(Corner::TopRight)) } else { drawn }
}

/// A fit from the start to a time (s).
fn curve(fit: ExponentialFit, end: f64) -> FittedCurve {
    FittedCurve::new((fit.steady_speed, fit.time_constant), (0.0, end), |time| fit.speed(time))
}
