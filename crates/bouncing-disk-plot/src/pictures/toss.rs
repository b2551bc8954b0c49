//! The motion of a toss: heights, angles and angular speeds against time.

use std::f64::consts::TAU;

use crate::axis::Axis;
use crate::colour::Colour;
use crate::figure::{DOUBLE_COLUMN, Figure};
use crate::frame::{Grid, Margins};
use crate::legend::{Corner, Legend};
use crate::line::Line;
use crate::panel::Panel;
use crate::style::Dash;

/// Disk and platform at an instant.
#[derive(Clone, Copy, Debug, Default)]
pub struct TossInstant {
    /// The time (s).
    pub time: f64,
    /// The heights of disk and platform (m).
    pub heights: [f64; 2],
    /// The angles of disk and platform (rad).
    pub angles: [f64; 2],
    /// The angular speeds of disk and platform (rad/s).
    pub angular_speeds: [f64; 2],
}

/// A quantity of disk and platform.
type Of = fn(&TossInstant) -> [f64; 2];

/// Largest number of periods of the platform in a picture: with more, the lines would merge.
pub const LONGEST_MOTION: u64 = 20;

/// The last [`LONGEST_MOTION`] periods of a motion, and its rounded number of periods if it is longer; the
/// whole motion if it is shorter, or if too few instants remain for a line.
fn last(motion: &[TossInstant], period: f64) -> (&[TossInstant], Option<u64>) {
    let end = motion.last().map_or(0.0, |instant| instant.time);
    let begin = end - LONGEST_MOTION as f64 * period;
    // The end is known but for rounding.
    let first = motion.partition_point(|instant| instant.time < begin - 1e-6 * period);
    let shown = &motion[first..];
    if first == 0 || shown.len() < 2 { (motion, None) } else { (shown, Some((end / period).round() as u64)) }
}

/// Three panels over the same time. Of a long motion on a platform with this period (s), the last part is
/// shown; without a period, the motion is one toss and is shown whole.
pub fn toss(motion: &[TossInstant], period: Option<f64>) -> Figure {
    const HEIGHT: f64 = 190.0;
    let margins = Margins { left: 46.0, right: 10.0, top: 24.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 3).margins(margins).gaps(50.0, 0.0);
    let (motion, periods) = period.map_or((motion, None), |period| last(motion, period));
    let begin = motion.first().map_or(0.0, |instant| instant.time);
    let end = motion.last().map_or(1.0, |instant| instant.time).max(f64::MIN_POSITIVE);
    let time = match periods {
        Some(periods) => format!("$t$ (s), last {LONGEST_MOTION} of {periods} periods"),
        None => "$t$ (s)".to_owned(),
    };
    // After many periods the disk is so many turns ahead of the platform that nothing else would be seen.
    let ahead = motion.first().filter(|_| periods.is_some()).map_or(0.0, |instant| instant.angles[0]);
    let turns = (ahead / TAU).round();
    let angle = if turns.abs() > 0.0 {
        format!("angle, disk less {turns} turns (rad)")
    } else {
        "angle (rad)".to_owned()
    };
    let panel = |column: usize, label: &str, of: Of, room: f64| {
        let less = if column == 1 { [turns * TAU, 0.0] } else { [0.0; 2] };
        let of = |instant: &TossInstant, body: usize| of(instant)[body] - less[body];
        let curve = |body| Line::new(motion.iter().map(move |own| (own.time, of(own, body))));
        let values = motion.iter().flat_map(|own| [of(own, 0), of(own, 1)]);
        let (low, high) = Axis::ends_around(values);
        Panel::new(grid.cell(0, column))
            .x(Axis::spanned(begin, end).label(time.as_str()))
            .y(Axis::spanned(low, high + room * (high - low)).label(label))
            .title(["(a)", "(b)", "(c)"][column])
            .layer(curve(1).colour(Colour::GREY).width(0.9).dash(Dash::Dashed).name("platform"))
            .layer(curve(0).colour(Colour::BLUE).width(1.1).name("disk"))
    };
    // The legend has a place of its own above the curves.
    let legend = Legend::at(Corner::TopLeft).without_frame().inset(4.0);
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
        panel(0, "height (m)", |own| own.heights, 0.0),
        panel(1, &angle, |own| own.angles, 0.3).legend(legend),
        panel(2, "angular speed (rad/s)", |own| own.angular_speeds, 0.0),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_long_motion_the_last_periods_are_shown() {
        let motion = |periods: u32, each: u32| -> Vec<TossInstant> {
            let time = |index| 0.4 * f64::from(index) / f64::from(each);
            let at = |index| TossInstant { time: time(index), ..TossInstant::default() };
            (0..=periods * each).map(at).collect()
        };
        for (periods, each, shown, of) in
            [(1, 40, 41, None), (20, 40, 801, None), (21, 40, 801, Some(21)), (4_000, 40, 801, Some(4_000))]
        {
            let motion = motion(periods, each);
            let (last, whole) = last(&motion, 0.4);
            assert_eq!((last.len(), whole), (shown, of), "{periods}");
        }
        // Two instants of a long motion are both of it.
        let two = [TossInstant::default(), TossInstant { time: 400.0, ..TossInstant::default() }];
        assert_eq!((last(&two, 0.4).0.len(), last(&[], 0.4).0.len()), (2, 0));
    }
}
