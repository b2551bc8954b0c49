//! The motion of a toss: heights, angles and angular speeds against time.

use bouncing_disk_plot::{Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Panel};

use super::{axis, spanned, with_room};
use crate::commands::toss::Sample;

/// What a curve shows of an instant.
type Of = fn(&Sample) -> f64;

/// Three panels over the same time.
pub(crate) fn draw(samples: &[Sample]) -> Figure {
    const HEIGHT: f64 = 190.0;
    let margins = Margins { left: 46.0, right: 10.0, top: 24.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 3).margins(margins).gaps(50.0, 0.0);
    let end = samples.last().map_or(1.0, |sample| sample.time_s).max(f64::MIN_POSITIVE);
    let panel = |column: usize, letter: &str, label: &str, of: [Of; 2]| {
        let values = samples.iter().flat_map(|sample| of.map(|of| of(sample)));
        let curve = |of: Of| Line::new(samples.iter().map(move |sample| (sample.time_s, of(sample))));
        Panel::new(grid.cell(0, column))
            .x(spanned(0.0, end).label("$t$ (s)"))
            .y(axis(values).label(label))
            .title(format!("({letter})"))
            .layer(curve(of[1]).colour(Colour::GREY).width(0.9).dash(Dash::Dashed).name("platform"))
            .layer(curve(of[0]).colour(Colour::BLUE).width(1.1).name("disk"))
    };
    let angles: [Of; 2] = [|sample| sample.disk_angle_rad, |sample| sample.platform_angle_rad];
    // The legend has a place of its own above the curves.
    let (low, high) = with_room(samples.iter().flat_map(|sample| angles.map(|of| of(sample))));
    let with_legend = spanned(low, high + 0.3 * (high - low)).label("angle (rad)");
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
        panel(0, "a", "height (m)", [|sample| sample.disk_height_m, |sample| sample.platform_height_m]),
        panel(1, "b", "angle (rad)", angles)
            .y(with_legend)
            .legend(Legend::at(Corner::TopLeft).without_frame().inset(4.0)),
        panel(
            2,
            "c",
            "angular speed (rad/s)",
            [|sample| sample.disk_angular_speed_rad_s, |sample| sample.platform_angular_speed_rad_s],
        ),
    ])
}
