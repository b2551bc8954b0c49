//! Quantities of a motor with their intervals: over the load, and over another parameter.

use super::marks::{self, CellMarks};
use crate::annotation::Text;
use crate::axis::Axis;
use crate::colour::Colour;
use crate::figure::{Figure, SINGLE_COLUMN};
use crate::frame::{Grid, Margins, Rect};
use crate::layer::Layer;
use crate::legend::{Corner, Legend};
use crate::line::{Band, Line, Rule};
use crate::numbers::{extent, rounded};
use crate::panel::Panel;
use crate::scatter::{Marker, Scatter};
use crate::style::{Anchor, Fill, Stroke};

/// Values of one quantity in its unit without a prefix.
#[derive(Debug)]
pub struct Quantity<'a> {
    /// Its name; `_` stands for a space.
    pub name: &'a str,
    /// Its unit; `1` for a dimensionless quantity.
    pub unit: &'a str,
    /// The values; one that is not finite is a gap.
    pub values: &'a [f64],
}

impl Quantity<'_> {
    /// The factor that scales the values to the order of 1, and the unit with its prefix.
    fn prefixed(&self) -> (f64, String) {
        let finite = self.values.iter().filter(|value| value.is_finite());
        let size = finite.fold(0.0_f64, |most, value| most.max(value.abs()));
        let prefixes = [(1.0, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n")];
        let fits = |scale: &f64| size == 0.0 || size * scale >= 1.0;
        let (scale, prefix) = prefixes.into_iter().find(|(scale, _)| fits(scale)).unwrap_or((1.0, ""));
        match self.unit {
            "1" => (1.0, String::new()),
            // Not a millikilogram.
            "kg" if size > 0.0 && size < 1.0 => (1e3, "g".to_owned()),
            "kg" => (1.0, "kg".to_owned()),
            unit @ ("m" | "N" | "N m" | "W") => (scale, format!("{prefix}{unit}")),
            // Angles, shares and frequencies are left as they are.
            unit => (1.0, unit.replace("^2", "$^2$").replace("^3", "$^3$")),
        }
    }

    /// The values as drawn, and the label of their axis.
    pub(super) fn shown(&self) -> (Vec<f64>, String) {
        let (scale, unit) = self.prefixed();
        let name = self.name.replace('_', " ");
        let label = if unit.is_empty() { name } else { format!("{name} ({unit})") };
        (self.values.iter().map(|value| scale * value).collect(), label)
    }
}

/// A place on the axis, a value, and half the width of its interval.
type Point = (f64, f64, f64);

/// A curve through values, with dots, and a band of their intervals; `name` goes into the legend.
pub fn interval_curve(points: &[Point], colour: Colour, band: Fill, name: Option<&str>) -> [Layer; 3] {
    let line = || points.iter().map(|point| (point.0, point.1));
    let area = Band::new(points.iter().map(|(x, y, half)| (*x, y - half, y + half)));
    let dots = Scatter::new(line().filter(|point| point.1.is_finite())).size(2.6).colour(colour);
    let dots = if let Some(name) = name { dots.name(name) } else { dots };
    [area.style(band).into(), Line::new(line()).width(0.8).colour(colour).into(), dots.into()]
}

/// A quantity, with the half widths of its intervals, over one parameter. `coexisting` contains values and
/// half widths of further motions with their marks; the values are not finite if there is no such motion. If there
/// are several motions, their points are not joined. A key below the curve explains the marks.
///
/// If the values of a sweep go up to the cell `turns_at` and down again, the two directions are separate
/// curves.
pub fn swept_curve(
    along: &Quantity<'_>,
    quantity: &Quantity<'_>,
    half_widths: &[f64],
    cell_marks: &[CellMarks],
    coexisting: &[Vec<(f64, f64, CellMarks)>],
    turns_at: Option<usize>,
) -> Figure {
    let ((places, place_label), (values, label)) = (along.shown(), quantity.shown());
    let scale = quantity.prefixed().0;
    let halves = half_widths.iter().map(|half| scale * half);
    let points: Vec<Point> =
        places.iter().zip(values).zip(halves).map(|((x, y), half)| (*x, y, half)).collect();
    let mut marked: Vec<(Point, CellMarks)> =
        points.iter().copied().zip(cell_marks.iter().copied()).collect();
    let others: Vec<Point> = coexisting
        .iter()
        .flat_map(|branch| places.iter().zip(branch))
        .filter(|(_, (y, ..))| y.is_finite())
        .map(|(x, (y, half, marks))| {
            let point = (*x, scale * y, scale * half);
            marked.push((point, *marks));
            point
        })
        .collect();
    let ends = points.iter().chain(&others).flat_map(|(_, y, half)| [y - half, y + half, 0.0]);
    let panel = Panel::new(Rect::new(48.0, 12.0, 186.0, 150.0))
        .x(Axis::around(places.iter().copied()).label(place_label))
        .y(Axis::around(ends).label(label));
    let legend = || Legend::at(Corner::BottomLeft).without_frame().inset(4.0);
    let panel = if let Some(turns_at) = turns_at {
        // Open circles on the way up, in which the dots of the way down are seen.
        let way = |points: &[Point], colour: Colour, name: &str| {
            let line = || points.iter().map(|(x, y, _)| (*x, *y));
            let dots = Scatter::new(line().filter(|(_, y)| y.is_finite())).colour(colour).name(name);
            let is_up = name == "up";
            let dots = if is_up { dots.marker(Marker::Circle).size(4.2) } else { dots.size(2.2) };
            [Layer::from(Line::new(line()).width(0.8).colour(colour)), dots.into()]
        };
        let down = &points[turns_at.min(points.len())..];
        let rest = Scatter::new(others.iter().map(|(x, y, _)| (*x, *y))).size(2.0).colour(Colour::GREY);
        let rest = (!others.is_empty()).then(|| rest.name("coexisting"));
        panel
            .layers(way(&points[..=turns_at.min(points.len() - 1)], Colour::BLUE, "up"))
            .layers(way(down, Colour::VERMILION, "down"))
            .layers(rest)
            .legend(legend())
    } else if others.is_empty() {
        panel.layers(interval_curve(&points, Colour::BLUE, Fill::new(Colour::LIGHT_GREY, 0.8), None))
    } else {
        let known: Vec<Point> = points.into_iter().filter(|(_, y, _)| y.is_finite()).collect();
        let dots = |points: &[Point], colour: Colour, name: &str| {
            let halves = points.iter().map(|(.., half)| *half).collect::<Vec<_>>();
            let dots = Scatter::new(points.iter().map(|(x, y, _)| (*x, *y))).errors_y(halves);
            dots.size(2.6).colour(colour).name(name)
        };
        panel
            .layer(dots(&known, Colour::BLUE, "reached from rest"))
            .layer(dots(&others, Colour::VERMILION, "coexisting"))
            .legend(legend())
    };
    let cells: Vec<CellMarks> = marked.iter().map(|(_, marks)| *marks).collect();
    let marked: Vec<(f64, f64)> = marked.iter().map(|((x, y, _), _)| (*x, *y)).collect();
    let panel = panel.layers(marks::of_curve(&marked, &cells));
    let key = marks::key(&cells, 48.0, 198.0);
    let height = 202.0 + key.as_ref().map_or(0.0, |(_, height)| height + 2.0);
    Figure::new(SINGLE_COLUMN, height).panel(panel).panels(key.map(|(key, _)| key))
}

/// The behaviour of a motor under a load (N m): values with the half widths of their intervals, if the motor
/// has a steady speed.
#[derive(Clone, Copy, Debug)]
pub struct LoadPoint {
    /// The load torque (N m).
    pub load_torque: f64,
    /// The mean speed (rad/s).
    pub speed: Option<(f64, f64)>,
    /// The ends of the range of the speed (rad/s) over motors within the tolerance of their inputs.
    pub spread: Option<[f64; 2]>,
    /// The same range without the slowest and the fastest of these motors.
    pub most: Option<[f64; 2]>,
    /// The power that the stator puts in (W).
    pub input_power: Option<(f64, f64)>,
    /// The mechanical power (W).
    pub mechanical_power: Option<(f64, f64)>,
    /// The share of the power put in that becomes mechanical.
    pub efficiency: Option<(f64, f64)>,
    /// The amplitude (m) of a compliant stator.
    pub amplitude: Option<(f64, f64)>,
    /// The share of the drive's power that becomes mechanical, for a compliant stator.
    pub electrical_efficiency: Option<(f64, f64)>,
}

/// The share of the lower panel that the legend leaves to the curves.
const UNDER_LEGEND: f64 = 0.68;

/// The distance of the foot of a rotated name from its rule (points), with room for text below the baseline.
const NEXT_TO_RULE: f64 = 3.0;

/// Two panels over the load: the speed with its spread over motors, and the powers with the efficiency. A
/// compliant stator has a third panel with its amplitude. Beyond `largest_torque` (N m) the load overpowers the
/// motor. The upper panel also shows the speeds of coexisting motions, each as a separate curve.
pub fn torque_speed(largest_torque: f64, found: &[LoadPoint], coexisting: &[Vec<LoadPoint>]) -> Figure {
    let yields = found.iter().any(|own| own.amplitude.is_some());
    let (height, panels) = if yields { (490.0, 3) } else { (338.0, 2) };
    let margins = Margins { left: 46.0, right: 44.0, top: 14.0, bottom: 34.0 };
    let grid = Grid::new(SINGLE_COLUMN + 30.0, height, panels, 1).margins(margins).gaps(10.0, 16.0);
    let loads: Vec<f64> = found.iter().map(|own| own.load_torque).collect();
    let loads = Quantity { name: "load torque $T$", unit: "N m", values: &loads };
    let (torque, torque_unit) = loads.prefixed();
    let (loads, load_label) = loads.shown();
    let points = |of: fn(&LoadPoint) -> Option<(f64, f64)>, scale: f64| -> Vec<Point> {
        let own = found.iter().zip(&loads).filter_map(|(own, load)| Some((*load, of(own)?)));
        own.map(|(load, (value, half))| (load, scale * value, scale * half)).collect()
    };
    let curve = |points: &[Point], colour: Colour, name: Option<&str>| {
        interval_curve(points, colour, Fill::new(colour, 0.2), name)
    };
    let speeds = points(|own| own.speed, 1.0);
    let others: Vec<Vec<Point>> = coexisting
        .iter()
        .map(|branch| {
            let speeds = branch.iter().filter_map(|own| Some((torque * own.load_torque, own.speed?)));
            speeds.map(|(load, (value, half))| (load, value, half)).collect()
        })
        .collect();
    let ranges = |of: fn(&LoadPoint) -> Option<[f64; 2]>| -> Vec<Point> {
        let own = found.iter().zip(&loads).filter_map(|(own, load)| Some((*load, of(own)?)));
        own.map(|(load, [from, to])| (load, from, to)).collect()
    };
    let (spread, most) = (ranges(|own| own.spread), ranges(|own| own.most));
    let (first, last) = Axis::ends_around(loads.iter().copied());
    let x = || Axis::spanned(first, last);
    // Beyond the requested loads there is nothing to see.
    let limit = Some(torque * largest_torque).filter(|limit| (first..=last).contains(limit));
    let ends =
        speeds.iter().chain(others.iter().flatten()).flat_map(|point| [point.1 - point.2, point.1 + point.2]);
    let ends = ends.chain(spread.iter().flat_map(|(_, from, to)| [*from, *to]));
    let (slowest, fastest) = Axis::ends_around(ends.chain([0.0]));
    let has_spread = spread.len() > 1;
    let band = has_spread.then(|| Band::new(most).colour(Colour::BLUE).opacity(0.15).name("9 in 10 motors"));
    let extreme = |end: fn(&Point) -> f64, name: Option<&str>| {
        let line = Line::new(spread.iter().map(|point| (point.0, end(point)))).width(0.4);
        name.map_or_else(|| line.clone(), |name| line.clone().name(name)).colour(Colour::BLUE)
    };
    let extremes =
        [extreme(|point| point.1, Some("slowest, fastest sample")), extreme(|point| point.2, None)];
    let extremes = extremes.into_iter().filter(|_| has_spread);
    // To the left of a rule, where nothing but the curve is: at the upper end, or in the middle of the part
    // below zero.
    let beside = |load: f64, label: String, below_zero: bool| {
        let left = (load - first) / (last - first) - NEXT_TO_RULE / grid.cell(0, 0).width;
        let (height, anchor) = if below_zero {
            (-0.5 * slowest / (fastest - slowest), Anchor::Middle)
        } else {
            (0.97, Anchor::Right)
        };
        Text::at_axes(left, height, label).anchor(anchor).rotated(90.0).size(7.5).halo(Colour::WHITE)
    };
    let stall = stall(&speeds);
    let rule = |(load, colour, width): (Option<f64>, Colour, f64)| {
        Some(Rule::vertical(load?).stroke(Stroke::new(colour, width)))
    };
    let rules = [(limit, Colour::DARK_GREY, 0.8), (stall, Colour::GREY, 0.5)].into_iter().filter_map(rule);
    // Two digits are what a straight line between two loads is good for. There is more room on one side; left of
    // the stall the speed is above zero.
    let stall_name =
        |stall: f64| beside(stall, format!("stall, {} {torque_unit}", rounded(stall, 2)), -slowest > fastest);
    let nothing = || {
        let words = Text::at_axes(0.5, 0.6, "no load has a steady speed").anchor(Anchor::Middle);
        speeds.is_empty().then(|| words.size(8.0).halo(Colour::WHITE))
    };
    let upper = Panel::new(grid.cell(0, 0))
        .x(x().without_numbers())
        .y(Axis::spanned(slowest, fastest).label(r"mean speed $\dot{\alpha}$ (rad/s)"))
        .title("(a)")
        .layer(Rule::horizontal(0.0).stroke(Stroke::new(Colour::GREY, 0.5)))
        .layers(rules.clone())
        .layers(band)
        .layers(extremes)
        .layers(curve(&speeds, Colour::BLUE, coexisting.first().map(|_| "reached from rest")))
        .layers(others.iter().enumerate().flat_map(|(index, speeds)| {
            curve(speeds, Colour::VERMILION, (index == 0).then_some("coexisting"))
        }))
        .layers(stall.map(|stall| {
            Scatter::new([(stall, 0.0)]).marker(Marker::Circle).size(4.5).colour(Colour::BLUE).filled_white()
        }))
        .layers(stall.map(stall_name))
        .layers(limit.map(|limit| beside(limit, r"largest torque $\mu m g a_e$".to_owned(), false)))
        .layers(nothing())
        .legend(Legend::at(Corner::BottomLeft).without_frame().inset(4.0));
    let powers: Vec<f64> = found.iter().filter_map(|own| Some(own.input_power?.0)).collect();
    let power = Quantity { name: "power", unit: "W", values: &powers };
    let (scale, power_label) = (power.prefixed().0, power.shown().1);
    let (input, output) = (points(|own| own.input_power, scale), points(|own| own.mechanical_power, scale));
    let efficiency = points(|own| own.efficiency, 100.0);
    // Both zeros at one height, and room above for the names.
    let (low, high) = extent(input.iter().chain(&output).map(|point| point.1).chain([0.0]));
    let low = 1.1 * low;
    let high = low + (or_one(high) - low) / UNDER_LEGEND;
    let below = -low / high;
    let electrical = points(|own| own.electrical_efficiency, 100.0);
    let shares = efficiency.iter().chain(&electrical).map(|point| point.1);
    let best =
        1.1 * or_one(extent(shares.chain([0.0])).1) / (UNDER_LEGEND - (1.0 - UNDER_LEGEND) * below).max(0.2);
    let last_x = || x().label(load_label.clone());
    let lower = Panel::new(grid.cell(1, 0))
        .x(if yields { x().without_numbers() } else { last_x() })
        .y(Axis::spanned(low, high).label(power_label))
        .right(Axis::spanned(low / high * best, best).label("efficiency (%)"))
        .title("(b)")
        .layers(rules.clone())
        .layers(curve(&input, Colour::GREY, Some("supplied")))
        .layers(curve(&output, Colour::BLUE, Some("mechanical")));
    let efficiency = curve(&efficiency, Colour::VERMILION, Some("efficiency"));
    let lower = efficiency.into_iter().fold(lower, Panel::layer_right);
    let electrical = curve(&electrical, Colour::GREEN, Some("of the drive's power")).into_iter();
    let lower = electrical.filter(|_| yields).fold(lower, Panel::layer_right);
    let legend = Legend::at(Corner::TopLeft).without_frame().inset(4.0);
    let lower = if speeds.is_empty() { lower } else { lower.legend(legend) };
    let amplitudes: Vec<f64> = found.iter().filter_map(|own| Some(own.amplitude?.0)).collect();
    let amplitude = Quantity { name: "amplitude under load", unit: "m", values: &amplitudes };
    let third = yields.then(|| {
        let own = points(|own| own.amplitude, amplitude.prefixed().0);
        let ends = own.iter().flat_map(|point| [point.1 - point.2, point.1 + point.2]);
        Panel::new(grid.cell(2, 0))
            .x(last_x())
            .y(Axis::around(ends.chain([0.0])).label(amplitude.shown().1))
            .title("(c)")
            .layers(rules)
            .layers(curve(&own, Colour::BLUE, None))
    });
    Figure::new(SINGLE_COLUMN + 30.0, height).panels([upper, lower]).panels(third)
}

/// The load at which the motor stops, interpolated linearly between two neighbouring loads (each with its speed
/// and the half width of an interval) at which the motor turns in opposite directions; `None` if there is
/// no such pair with disjoint intervals.
fn stall(speeds: &[Point]) -> Option<f64> {
    speeds.windows(2).find_map(|pair| {
        let [(load, speed, bar), (next_load, next, next_bar)] = *pair else { return None };
        let stops = (speed > 0.0) != (next > 0.0) && (speed - next).abs() > bar + next_bar;
        stops.then(|| load + (next_load - load) * speed / (speed - next))
    })
}

/// The largest value of an axis, or 1 if no value is above zero.
fn or_one(largest: f64) -> f64 {
    if largest > 0.0 { largest } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stall_lies_where_the_speed_changes_its_sign() {
        let at = |points: &[Point]| stall(points);
        assert_eq!(at(&[(0.0, 8.0, 0.1), (1.0, 3.0, 0.1), (2.0, -1.0, 0.1), (3.0, -9.0, 0.1)]), Some(1.75));
        assert_eq!(at(&[(0.0, -3.0, 0.1), (1.0, 0.0, 0.1), (2.0, 3.0, 0.1)]), Some(1.0));
        // It always lies within the loads, and a motor that does not turn has none.
        for none in [&[][..], &[(0.0, 8.0, 0.1)], &[(0.0, 8.0, 0.1), (1.0, 7.0, 0.1)]] {
            assert_eq!(at(none), None);
        }
        assert_eq!(at(&[(0.0, 0.1, 0.3), (1.0, -0.1, 0.3)]), None);
    }
}
