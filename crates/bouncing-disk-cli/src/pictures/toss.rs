//! The motion of a toss: heights, angles and angular speeds against time.

use std::f64::consts::TAU;

use bouncing_disk_plot::{Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Legend, Line, Margins, Panel};

use super::{axis, spanned, with_room};
use crate::commands::toss::Sample;

/// What a curve shows of an instant.
type Of<'a> = &'a dyn Fn(&Sample) -> f64;

/// Most periods of the platform in a picture: more of them would be a mat without lines.
pub(crate) const MOST_PERIODS: u64 = 20;

/// The last instants of a motion, those of [`MOST_PERIODS`], and how many periods it has, rounded, if these
/// are more; all of a motion that is shorter, or of which there are too few instants for a line.
fn last(samples: &[Sample], period: f64) -> (&[Sample], Option<u64>) {
    let end = samples.last().map_or(0.0, |sample| sample.time_s);
    let begin = end - MOST_PERIODS as f64 * period;
    // The end is known but for rounding.
    let first = samples.partition_point(|sample| sample.time_s < begin - 1e-6 * period);
    let shown = &samples[first..];
    if first == 0 || shown.len() < 2 { (samples, None) } else { (shown, Some((end / period).round() as u64)) }
}

/// Three panels over the same time. Of a motion that goes on and on, on a platform with this period (s), the
/// last part is shown; without a period it is one toss, which is shown as a whole.
pub(crate) fn draw(samples: &[Sample], period: Option<f64>) -> Figure {
    const HEIGHT: f64 = 190.0;
    let margins = Margins { left: 46.0, right: 10.0, top: 24.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 3).margins(margins).gaps(50.0, 0.0);
    let (samples, periods) = period.map_or((samples, None), |period| last(samples, period));
    let begin = samples.first().map_or(0.0, |sample| sample.time_s);
    let end = samples.last().map_or(1.0, |sample| sample.time_s).max(f64::MIN_POSITIVE);
    let time = match periods {
        Some(periods) => format!("$t$ (s), last {MOST_PERIODS} of {periods} periods"),
        None => "$t$ (s)".to_owned(),
    };
    // After many periods the disk is so many turns ahead of the platform that nothing else would be seen.
    let ahead = samples.first().filter(|_| periods.is_some()).map_or(0.0, |sample| sample.disk_angle_rad);
    let turns = (ahead / TAU).round();
    let angle = if turns.abs() > 0.0 {
        format!("angle, disk less {turns} turns (rad)")
    } else {
        "angle (rad)".to_owned()
    };
    let panel = |column: usize, letter: &str, label: &str, of: [Of<'_>; 2]| {
        let values = samples.iter().flat_map(|sample| of.map(|of| of(sample)));
        let curve = |of: Of<'_>| Line::new(samples.iter().map(move |sample| (sample.time_s, of(sample))));
        Panel::new(grid.cell(0, column))
            .x(spanned(begin, end).label(time.as_str()))
            .y(axis(values).label(label))
            .title(format!("({letter})"))
            .layer(curve(of[1]).colour(Colour::GREY).width(0.9).dash(Dash::Dashed).name("platform"))
            .layer(curve(of[0]).colour(Colour::BLUE).width(1.1).name("disk"))
    };
    let angles: [Of<'_>; 2] =
        [&|sample| sample.disk_angle_rad - turns * TAU, &|sample| sample.platform_angle_rad];
    // The legend has a place of its own above the curves.
    let (low, high) = with_room(samples.iter().flat_map(|sample| angles.map(|of| of(sample))));
    let with_legend = spanned(low, high + 0.3 * (high - low)).label(angle.as_str());
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
        panel(0, "a", "height (m)", [&|sample| sample.disk_height_m, &|sample| sample.platform_height_m]),
        panel(1, "b", &angle, angles)
            .y(with_legend)
            .legend(Legend::at(Corner::TopLeft).without_frame().inset(4.0)),
        panel(
            2,
            "c",
            "angular speed (rad/s)",
            [&|sample| sample.disk_angular_speed_rad_s, &|sample| sample.platform_angular_speed_rad_s],
        ),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_long_motion_the_last_periods_are_shown() {
        let motion = |periods: u32, each: u32| -> Vec<Sample> {
            let at = |index| Sample { time_s: 0.4 * f64::from(index) / f64::from(each), ..Sample::default() };
            (0..=periods * each).map(at).collect()
        };
        for (periods, each, shown, told) in
            [(1, 40, 41, None), (20, 40, 801, None), (21, 40, 801, Some(21)), (4_000, 40, 801, Some(4_000))]
        {
            let samples = motion(periods, each);
            let (last, of) = last(&samples, 0.4);
            assert_eq!((last.len(), of), (shown, told), "{periods}");
        }
        // Two instants of a long motion are both of it.
        let two = [Sample::default(), Sample { time_s: 400.0, ..Sample::default() }];
        assert_eq!((last(&two, 0.4).0.len(), last(&[], 0.4).0.len()), (2, 0));
    }
}
