//! The picture of Fig. 10.

use bouncing_disk_plot::pictures::FittedCurve;
use bouncing_disk_plot::{
    Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Panel, Ticks,
};

use super::alike::Alike;
use super::panels::{Exception, Reading, Transient};
use crate::figures::shared::alike::SpeedBand;
use crate::figures::shared::numbers::exponent;

/// Height of a row.
const ROW: f64 = 184.0;

/// The curves of the two readings; the first also has the exceptional motor and the band of single orbits.
pub(super) fn draw(readings: &[Reading], exception: &Exception, alike: &Alike) -> Figure {
    let height = ROW * 2.0;
    let margins = Margins { left: 42.0, right: 10.0, top: 20.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, height, 2, 3).margins(margins).gaps(46.0, 52.0);
    let mut figure = Figure::new(DOUBLE_COLUMN, height);
    // The paper's (d)-(f) are measured curves.
    let letters = [["a", "b", "c"], ["a′", "b′", "c′"]];
    for (row, reading) in readings.iter().enumerate() {
        let speeds = reading.panels.iter().flat_map(|panel| panel.member_speed_rad_per_s.iter().copied());
        let highest = speeds.fold(0.0_f64, f64::max);
        for (column, panel) in reading.panels.iter().enumerate() {
            let mut drawn = Panel::new(grid.cell(row, column));
            if row == 0 {
                drawn = drawn.layer(orbits(&alike.bands[column]));
            }
            drawn = curves(drawn, reading, panel, highest).letter_in(letters[row][column], Corner::TopLeft);
            if (row, column) == (0, 0) {
                drawn = drawn.layer(exceptional(exception));
            }
            if (row, column) == (1, 0) {
                drawn = with_legend(drawn, exception);
            }
            figure = figure.panel(drawn);
        }
    }
    figure
}

/// The band of single orbits.
fn orbits(band: &SpeedBand) -> Band {
    let speeds = band.low_rad_per_s.iter().zip(&band.high_rad_per_s);
    let points = band.time_s.iter().zip(speeds).map(|(&time, (&low, &high))| (time, low, high));
    Band::new(points).colour(Colour::LIGHT_GREY).opacity(0.45)
}

/// The motor at exactly the printed g.
fn exceptional(exception: &Exception) -> Line {
    let curve = exception.time_s.iter().zip(&exception.speed_rad_per_s).map(|(&time, &speed)| (time, speed));
    Line::new(curve).colour(Colour::VERMILION).width(1.0).dash(Dash::Dotted)
}

/// The only legend, in a panel with room for it: of the two curves of the upper row that it lacks it has parts beyond its axes.
fn with_legend(panel: Panel, exception: &Exception) -> Panel {
    let name = format!("$g = {}$ exactly", exception.preload_acceleration_m_per_s2);
    let beyond = [-2.0, -1.0];
    panel
        .layer(
            Band::new(beyond.map(|time| (time, 0.0, 0.0)))
                .colour(Colour::LIGHT_GREY)
                .opacity(0.45)
                .name("single orbits"),
        )
        .layer(
            Line::new(beyond.map(|time| (time, 0.0)))
                .colour(Colour::VERMILION)
                .width(1.0)
                .dash(Dash::Dotted)
                .name(name),
        )
        .legend(Legend::at(Corner::BottomRight).inset(4.0))
}

fn curves(panel: Panel, reading: &Reading, transient: &Transient, highest: f64) -> Panel {
    let member = transient.member_time_s.iter().zip(&transient.member_speed_rad_per_s);
    let member = member.map(|(&time, &speed)| (time, speed));
    let ends = transient.band_low_rad_per_s.iter().zip(&transient.band_high_rad_per_s);
    let band = transient.band_time_s.iter().zip(ends).map(|(&time, (&low, &high))| (time, low, high));
    let fit = transient.member_fit;
    let fitted = FittedCurve::new((fit.steady_speed, fit.time_constant), (0.0, reading.duration_s), |time| {
        fit.speed(time)
    });
    panel
        .title(format!(
            "$A = 10^{{{}}}$ m, $g = {}$ m/s$^2$",
            exponent(transient.amplitude_m),
            reading.preload_acceleration_m_per_s2
        ))
        .x(Axis::linear(0.0, reading.duration_s)
            .ticks(Ticks::every(if reading.duration_s > 2.0 { 2.0 } else { 0.3 }))
            .label(r"$t$ (s)"))
        .y(Axis::linear(0.0, 1.4 * highest).ticks(Ticks::every(10.0)).label(r"$\dot{\alpha}$ (rad/s)"))
        .layer(Line::new(member).colour(Colour::GREY).width(0.6).name("one member"))
        .layer(fitted.line().name("its fit"))
        .layers(fitted.notes(1, 0.80, 0.09))
        .layer(Band::new(band).colour(Colour::BLUE).opacity(0.30).name("ensemble"))
}
