//! The drawing of Fig. 11.

use bouncing_disk_plot::{
    Anchor, Axis, Band, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Layer, Legend, Line, Margins,
    Marker, Panel, Scatter, Text, Ticks,
};

use super::{Curve, Point, StallAt};
use crate::claims::paper::Preloads;
use crate::figures::shared::numbers::{exponent, extent, middle_range};

/// Colour and dashes of the three amplitudes, as the caption lists them.
const STYLES: [(Colour, Dash); 3] =
    [(Colour::BLACK, Dash::Solid), (Colour::BLUE, Dash::Dashed), (Colour::VERMILION, Dash::Dotted)];

/// The sense in which the paper's motor turns at both frequencies; speeds count as positive in that sense.
const SENSES: [&str; 2] = ["clockwise", "anticlockwise"];

/// Parts of the range of preloads in which the single orbits of all three amplitudes are counted together.
const PARTS: usize = 14;

/// Ends of the axes, speed and stall acceleration, where nothing lies outside.
const SPEEDS: (f64, f64) = (-13.0, 64.0);
const STALLS: (f64, f64) = (-7.0, 36.0);

/// One dot in so many has a bar, and those of the three amplitudes are not the same: bars at every dot would hide the curves.
const BAR_EVERY: usize = 12;
/// See [`BAR_EVERY`].
const BAR_SHIFT: usize = 4;

/// The ends of an axis, extended where values lie outside.
fn extended(ends: (f64, f64), values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold(ends, |(low, high), value| (low.min(value), high.max(value)));
    let room = 0.05 * (high - low);
    (if low < ends.0 { low - room } else { low }, if high > ends.1 { high + room } else { high })
}

/// The value and half-length of the error bar of a point.
type Quantity = fn(&Point) -> Option<(f64, f64)>;

fn steady_speed(point: &Point) -> Option<(f64, f64)> {
    let spread = point.statistics.steady_speed_rad_per_s;
    Some((spread.mean, spread.deviation))
}

fn stall(point: &Point) -> Option<(f64, f64)> {
    point.statistics.stall_acceleration_rad_per_s2.map(|spread| (spread.mean, spread.deviation))
}

/// Points and both ends of the bars of all curves.
fn shown(data: &Drawn<'_>, quantity: Quantity) -> impl Iterator<Item = f64> {
    data.curves.iter().enumerate().flat_map(move |(index, curve)| {
        let [dots, circles] = [false, true].map(|low_period| curve_points(curve, quantity, low_period));
        let bars = barred(&dots, index);
        let values: Vec<f64> = dots.iter().chain(&circles).map(|point| point.1).collect();
        let ends = bars.into_iter().flat_map(|(_, value, error)| [value - error, value + error]);
        values.into_iter().chain(ends)
    })
}

/// Preload, value and half-length of the bar of the motors that repeat a low-period cycle, or of the others.
fn curve_points(curve: &Curve, quantity: Quantity, low_period: bool) -> Vec<(f64, f64, f64)> {
    let wanted = curve.points.iter().filter(|point| point.statistics.is_low_period() == low_period);
    wanted
        .filter_map(|point| quantity(point).map(|(value, error)| (point.preload_mn, value, error)))
        .collect()
}

/// The dots of the curve at `index` that have bars.
fn barred(dots: &[(f64, f64, f64)], index: usize) -> Vec<(f64, f64, f64)> {
    dots.iter().skip(BAR_SHIFT * index).step_by(BAR_EVERY).copied().collect()
}

/// What is drawn.
pub(super) struct Drawn<'a> {
    pub(super) curves: &'a [Curve],
    pub(super) stalls: &'a [StallAt],
    pub(super) printed: &'a Preloads,
    /// Mass (kg) and moment of inertia (kg m²) of the rotor.
    pub(super) mass: f64,
    pub(super) inertia: f64,
}

pub(super) fn draw(data: &Drawn<'_>) -> Figure {
    const HEIGHT: f64 = 400.0;
    let margins = Margins { left: 42.0, right: 48.0, top: 38.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 2, 2).margins(margins).gaps(54.0, 14.0);
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    let to_mn = 1e3 * data.mass;
    let [_, last] = data.printed.preload_accelerations_m_per_s2;
    let preloads = (0.0, 1.03 * last * to_mn);
    // Also the longest bars end within the frame.
    let speed_ends = extended(SPEEDS, shown(data, steady_speed));
    let stall_ends = extended(STALLS, shown(data, stall));
    let frequencies = data.printed.frequencies_hz;
    for (row, frequency) in frequencies.into_iter().enumerate() {
        let curves: Vec<&Curve> =
            data.curves.iter().filter(|curve| curve.frequency_hz.total_cmp(&frequency).is_eq()).collect();
        let frame = |column: usize, letter: &str, y: Axis| {
            let (low, high) = preloads;
            let x = Axis::linear(low, high).ticks(Ticks::every(80.0).minor(4));
            let top = Axis::linear(low / to_mn, high / to_mn).ticks(Ticks::every(2.0).minor(4));
            let (x, top) = if row == 0 {
                (x.without_numbers(), top.label(r"$g$ (m/s$^2$)"))
            } else {
                (x.label("preload (mN)"), top.without_numbers())
            };
            let [from, to] = data.printed.measured_range_n.map(|preload| 1e3 * preload);
            Panel::new(grid.cell(row, column)).x(x).top(top).y(y).letter(letter).layer(
                Band::new([from, to].map(|preload| {
                    (preload, speed_ends.0.min(stall_ends.0), speed_ends.1.max(stall_ends.1))
                }))
                .colour(Colour::PALE_GREY)
                .opacity(0.6),
            )
        };
        let speeds = Axis::linear(speed_ends.0, speed_ends.1)
            .ticks(Ticks::every(10.0).minor(2))
            .label(r"steady-state speed $\dot{\alpha}_{ss}$ (rad/s)");
        let stalls = || Axis::linear(stall_ends.0, stall_ends.1).ticks(Ticks::every(10.0).minor(2));
        let stalls_really: Vec<(f64, f64)> = data
            .stalls
            .iter()
            .filter(|at| at.frequency_hz.total_cmp(&frequency).is_eq())
            .map(|at| (at.preload_mn, at.stall.load_rad_per_s2.value))
            .collect();
        let label = [
            Text::at_axes(0.12, 0.93, format!("${}$ kHz", frequency / 1e3)),
            Text::at_axes(0.12, 0.86, SENSES[row]),
        ];
        let [from, to] = data.printed.measured_range_n.map(|preload| 1e3 * preload);
        let range = || {
            let words = format!("measured trends: {from} to {to} mN");
            Text::at_axes(0.5 * (from + to) / preloads.1, 0.04, words)
                .anchor(Anchor::Middle)
                .colour(Colour::DARK_GREY)
                .size(7.0)
        };
        let orbits = single_orbits(&curves, |point| Some(point.single_speed_rad_per_s));
        let left = frame(0, ["a", "c"][row], speeds)
            .layer(if row == 0 { orbits.name("single orbits") } else { orbits })
            .layers(curves.iter().enumerate().flat_map(|(index, curve)| {
                layers(curve, index, steady_speed, if row == 0 { Names::Shown } else { Names::Hidden })
            }))
            .layer(range())
            .layers(label.clone());
        let torque = 1e6 * data.inertia;
        let right = frame(1, ["b", "d"][row], stalls().label(r"stall $\dot{\alpha}_{ss}/t_c$ (rad/s$^2$)"))
            .right(
                Axis::linear(torque * stall_ends.0, torque * stall_ends.1)
                    .ticks(Ticks::every(10.0).minor(2))
                    .label(r"$m a_g^2 \dot{\alpha}_{ss}/t_c$ (µN m)"),
            )
            .layer(single_orbits(&curves, |point| point.single_stall_rad_per_s2))
            .layers(
                curves
                    .iter()
                    .enumerate()
                    .flat_map(|(index, curve)| layers(curve, index, stall, Names::Hidden)),
            )
            .layer(squares(stalls_really).name("load that stalls"))
            .layer(range())
            .layers(label);
        let left = if row == 0 {
            let circles = low_period(Vec::new(), Colour::GREY).name("low-period cycle");
            left.layer(circles).legend(Legend::at(Corner::TopRight))
        } else {
            left
        };
        figure = figure.panel(left).panel(right.legend(Legend::at(Corner::TopRight)));
    }
    figure
}

/// The middle nine tenths of the single orbits of some curves, over the preloads.
fn single_orbits(curves: &[&Curve], of: fn(&Point) -> Option<f64>) -> Band {
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let (first, last) = extent(points().map(|point| point.preload_mn));
    let part = (last - first) / PARTS as f64;
    let bands = (0..PARTS).filter_map(|index| {
        let from = first + part * index as f64;
        let inside = points().filter(|point| (from..=from + part).contains(&point.preload_mn));
        let [low, high] = middle_range(inside.filter_map(of))?;
        Some((from + 0.5 * part, low, high))
    });
    Band::new(bands).colour(Colour::SKY).opacity(0.25)
}

/// The motors that repeat a low-period cycle.
fn low_period(points: Vec<(f64, f64)>, colour: Colour) -> Scatter {
    Scatter::new(points).marker(Marker::Circle).colour(colour).filled_white().size(3.4)
}

/// The loads that really stall the motor.
fn squares(points: Vec<(f64, f64)>) -> Scatter {
    Scatter::new(points).marker(Marker::Square).colour(Colour::PURPLE).width(1.4).size(6.0)
}

/// The line of one amplitude, its points, a few with error bars, and those where the motor repeats a
/// low-period cycle.
fn layers(curve: &Curve, index: usize, quantity: Quantity, names: Names) -> Vec<Layer> {
    let (colour, dash) = STYLES[index.min(STYLES.len() - 1)];
    let dots = curve_points(curve, quantity, false);
    let barred = barred(&dots, index);
    let scatter =
        |points: &[(f64, f64, f64)]| Scatter::new(points.iter().map(|(x, y, _)| (*x, *y))).colour(colour);
    let line = Line::new(dots.iter().map(|(x, y, _)| (*x, *y))).colour(colour).width(0.7).dash(dash);
    let circles = curve_points(curve, quantity, true).iter().map(|(x, y, _)| (*x, *y)).collect();
    let line = match names {
        Names::Shown => line.name(format!("$A = 10^{{{}}}$ m", exponent(curve.amplitude_m))),
        Names::Hidden => line,
    };
    vec![
        line.into(),
        scatter(&dots).size(1.8).into(),
        scatter(&barred).errors_y(barred.iter().map(|point| point.2)).size(1.8).into(),
        low_period(circles, colour).into(),
    ]
}

/// Whether layers have names for a legend.
#[derive(Clone, Copy)]
enum Names {
    Shown,
    Hidden,
}
