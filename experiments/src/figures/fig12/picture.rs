//! The picture of Fig. 12.

use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Marker,
    Panel, Rect, Scatter, Text, Ticks,
};

use super::shown::Shown;
use crate::figures::shared::numbers::{exponent, extent};

pub(super) fn draw(shown: [&Shown; 2], amplitudes_m: [f64; 2]) -> Figure {
    const HEIGHT: f64 = 430.0;
    let margins = Margins { left: 44.0, right: 12.0, top: 20.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 3, 2)
        .margins(margins)
        .gaps(52.0, 36.0)
        .row_weights(&[1.5, 1.0, 1.0]);
    let titles = ["long-period chattering", "low-period chattering"];
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    for (column, ((shown, title), printed)) in shown.into_iter().zip(titles).zip(amplitudes_m).enumerate() {
        let letters = [["a", "b", "c"], ["d", "e", "f"]][column];
        let top = whole(grid.cell(0, column), shown, printed, column == 1);
        let cell = grid.cell(1, column);
        let speeds = if column == 0 { speeds(cell, shown) } else { lines(cell, shown) };
        figure = figure
            .panel(top.letter(letters[0]).title(title))
            .panel(speeds.letter(letters[1]))
            .panel(heights(grid.cell(2, column), shown).letter(letters[2]));
    }
    figure
}

/// The whole transient with what the impulses predict, or the exponential fit.
fn whole(area: Rect, shown: &Shown, printed_amplitude: f64, low_period: bool) -> Panel {
    let points = shown.flight_time_s.iter().copied().zip(shown.flight_speed_rad_per_s.iter().copied());
    let highest = shown.flight_speed_rad_per_s.iter().copied().fold(0.0, f64::max);
    let from = shown.zoom.time_s.first().copied().unwrap_or(0.0);
    let until = shown.zoom.time_s.last().copied().unwrap_or(0.0);
    let y = 1.12 * highest;
    let power = exponent(printed_amplitude);
    let drawn = shown.motor.amplitude_m;
    // A few units in the last place are the nearest double, and no other amplitude.
    let amplitude = if (drawn / printed_amplitude - 1.0).abs() < 1e-12 {
        format!("$A = 10^{{{power}}}$ m")
    } else {
        format!(r"$A = {:.10}\times10^{{{power}}}$ m", drawn / printed_amplitude)
    };
    let preload = format!("$g = {}$ m/s$^2$", shown.motor.preload_acceleration_m_per_s2);
    let panel = Panel::new(area)
        .x(Axis::linear(0.0, shown.duration_s).label(r"$t$ (s)"))
        .y(Axis::linear(0.0, y).label(r"$\dot{\alpha}$ (rad/s)"))
        .layer(Text::at_axes(0.97, 0.17, amplitude).anchor(Anchor::RightCentre))
        .layer(Text::at_axes(0.97, 0.07, preload).anchor(Anchor::RightCentre));
    let window = Band::new([(from, 0.0, y), (until, 0.0, y)]).colour(Colour::SKY).opacity(0.5);
    let panel = panel.layer(window);
    let panel = if low_period {
        let predicted =
            shown.prediction.time_s.iter().copied().zip(shown.prediction.speed_rad_per_s.iter().copied());
        panel
            .layer(
                Scatter::new(points).marker(Marker::Dot).size(1.3).colour(Colour::GREY).name("each flight"),
            )
            .layer(
                Line::new(predicted)
                    .colour(Colour::VERMILION)
                    .dash(Dash::Dashed)
                    .width(1.2)
                    .name("from impulses"),
            )
    } else {
        let fit = shown.fits.exponential;
        let smooth = (0..=200).map(|index| {
            let time = shown.duration_s * f64::from(index) / 200.0;
            (time, fit.speed(time))
        });
        panel.layer(Line::new(points).colour(Colour::GREY).width(0.6).name("each flight")).layer(
            Line::new(smooth).colour(Colour::BLACK).dash(Dash::Dashed).width(1.2).name("exponential fit"),
        )
    };
    panel.legend(Legend::at(Corner::BottomRight).inset(32.0))
}

fn zoomed(area: Rect, shown: &Shown) -> Panel {
    let (first, last) = (shown.zoom.time_s.first(), shown.zoom.time_s.last());
    let (first, last) = (first.copied().unwrap_or(0.0), last.copied().unwrap_or(1.0));
    Panel::new(area).x(Axis::linear(first, last).label(r"$t$ (s)"))
}

fn speed_axis(slowest: f64, fastest: f64) -> Axis {
    let room = 0.05 * (fastest - slowest);
    Axis::linear(slowest - room, fastest + room)
        .label(r"$\dot{\alpha}$ (rad/s)")
        .ticks(Ticks::every(tick_step(fastest - slowest)))
}

/// The speed in the zoom.
fn speeds(area: Rect, shown: &Shown) -> Panel {
    let zoom = &shown.zoom;
    let points = zoom.time_s.iter().copied().zip(zoom.speed_rad_per_s.iter().copied());
    let (slowest, fastest) = extent(zoom.speed_rad_per_s.iter().copied());
    zoomed(area, shown).y(speed_axis(slowest, fastest)).layer(Line::new(points).width(0.8))
}

/// The flights of some cycles of low period, each of a cycle in a shade of its own: they form lines.
fn lines(area: Rect, shown: &Shown) -> Panel {
    let zoom = &shown.zoom;
    let points: Vec<(f64, f64)> =
        zoom.flight_time_s.iter().copied().zip(zoom.flight_speed_rad_per_s.iter().copied()).collect();
    let flights = shown.robust_cycle.and_then(|robust| robust.cycle().flights()).unwrap_or(1).max(1);
    let (first, last) = extent(zoom.flight_time_s.iter().copied());
    let (slowest, fastest) = extent(zoom.flight_speed_rad_per_s.iter().copied());
    let margin = 0.03 * (last - first);
    // With room for the names at the ends of the lines.
    let fastest = fastest + 0.08 * (fastest - slowest);
    let mut panel = Panel::new(area)
        .x(Axis::linear(first - margin, last + 6.5 * margin).label(r"$t$ (s)"))
        .y(speed_axis(slowest, fastest));
    for flight in 0..flights {
        let of_flight: Vec<(f64, f64)> = points.iter().copied().skip(flight).step_by(flights).collect();
        let colour = [Colour::BLUE, Colour::VERMILION, Colour::GREEN, Colour::BLACK][flight % 4];
        if let Some((_, speed)) = of_flight.last() {
            let name = Text::at_data(last + margin, *speed, format!("flight {}", flight + 1));
            panel = panel.layer(name.anchor(Anchor::LeftCentre).size(7.5).colour(colour));
        }
        panel = panel
            .layer(Line::new(of_flight.clone()).colour(colour).width(0.5))
            .layer(Scatter::new(of_flight).marker(Marker::Dot).size(3.0).colour(colour));
    }
    panel
}

/// A round step that divides `range` into at most four parts.
fn tick_step(range: f64) -> f64 {
    let mut step = 1e-6;
    for factor in [2.0, 2.5, 2.0].into_iter().cycle().take(60) {
        if 4.0 * step >= range {
            break;
        }
        step *= factor;
    }
    step
}

/// The height of the rotor in the zoom; the stator's is too small to be seen.
fn heights(area: Rect, shown: &Shown) -> Panel {
    let zoom = &shown.zoom;
    let micrometres: Vec<f64> = zoom.height_m.iter().map(|height| 1e6 * height).collect();
    let highest = micrometres.iter().copied().fold(0.0, f64::max);
    let points = zoom.time_s.iter().copied().zip(micrometres);
    zoomed(area, shown)
        .y(Axis::linear(-0.03 * highest, 1.2 * highest).label(r"$x$ (µm)"))
        .layer(Line::new(points).width(0.8))
}
