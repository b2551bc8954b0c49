//! The drawing of Fig. 4.

use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, Figure, Grid, Layer, Legend, Line, Margins, Marker,
    Panel, Rule, Scatter, Stroke, Text, Ticks,
};

use super::Curves;
use super::tosses::{Family, LagCurve, TossPoint};
use crate::claims::printed::PrintedNumber;

const HEIGHT: f64 = 480.0;
const LAST_LAG: f64 = 8.0;
/// The end of the axis of φ_L.
const LAST_ANGLE: f64 = 0.45 * PI;
/// Size of the numbers at the curves, in points.
const NUMBER_SIZE: f64 = 7.0;

/// The colour of a phase lag: θ and θ + π are mirror images, so the two ends are the strongest colours.
fn lag_colour(n: u32) -> Colour {
    let share = f64::from(n) / LAST_LAG;
    let middle = Colour::rgb(150, 150, 150);
    if share < 0.5 {
        Colour::BLUE.mixed(middle, 2.0 * share)
    } else {
        middle.mixed(Colour::VERMILION, 2.0 * share - 1.0)
    }
}

/// One of the three performance measures, in the two rows.
struct Measure {
    letters: [&'static str; 2],
    axes: [Axis; 2],
    values: fn(&LagCurve) -> Vec<f64>,
    /// Angle and value.
    best: fn(&LagCurve) -> (f64, f64),
    /// Where it says, in each row, what the numbers are.
    key: [(f64, f64); 2],
    /// The number n of a curve, given its row.
    number: fn(usize, u32) -> NumberPlace,
}

/// Where the number of a curve stands.
enum NumberPlace {
    /// At this share of the largest angle, raised by so much.
    At(f64, f64),
    /// At the largest value, raised by so much.
    Best(f64),
    /// At this share of the largest angle, with this text instead of n.
    With(&'static str, f64),
    /// Not drawn, because another curve has the same values.
    Nowhere,
}

fn measures() -> [Measure; 3] {
    use NumberPlace::{At, Best, Nowhere, With};
    let speed = || Axis::linear(-26.0, 26.0).label(r"$\dot{\alpha}_f$ (rad/s)").ticks(Ticks::every(10.0));
    let efficiency = |last| Axis::linear(0.0, last).label(r"$\eta$").ticks(Ticks::every(0.2).minor(4));
    let ratio = || Axis::linear(-1.15, 1.5).label(r"$\nu$").ticks(Ticks::every(0.5));
    [
        Measure {
            letters: ["a", "a′"],
            axes: [speed(), speed()],
            values: |curve| curve.airborne_speed_rad_per_s.clone(),
            best: |curve| curve.fastest.speed(),
            key: [(0.02 * PI, -22.0); 2],
            number: |row, n| match (row, n) {
                (_, 0) => At(0.45, 2.2),
                (_, 8) => At(0.45, -2.2),
                (0, 1) => At(0.61, 0.0),
                (_, 1) => At(0.90, 0.0),
                (_, 7) => At(0.60, 0.0),
                _ => At(0.72, 0.0),
            },
        },
        Measure {
            letters: ["b", "b′"],
            axes: [efficiency(0.5), efficiency(0.75)],
            values: |curve| curve.efficiency.clone(),
            best: |curve| point(&curve.most_efficient, curve.most_efficient.efficiency),
            key: [(0.02 * PI, 0.38), (0.02 * PI, 0.57)],
            number: |row, n| match (row, n) {
                (_, 0) => With("0, 8", 0.87),
                (_, 8) => Nowhere,
                (0, 5) => Best(0.014),
                (1, 1) => At(0.87, 0.03),
                (1, 2) => At(0.90, -0.035),
                (1, 4) => At(0.80, 0.0),
                (1, 3 | 5) => At(0.90, 0.0),
                _ => Best(0.0),
            },
        },
        Measure {
            letters: ["c", "c′"],
            axes: [ratio(), ratio()],
            values: |curve| curve.speed_ratio.iter().map(|ratio| ratio.unwrap_or(f64::NAN)).collect(),
            best: |curve| {
                let best = &curve.largest_speed_ratio;
                point(best, best.speed_ratio.unwrap_or(f64::NAN))
            },
            key: [(0.09 * PI, 1.25); 2],
            number: |_, n| match n {
                7 => At(0.62, 0.0),
                8 => At(0.40, 0.0),
                _ => At(0.16, 0.0),
            },
        },
    ]
}

fn point(toss: &TossPoint, value: f64) -> (f64, f64) {
    (toss.amplitude_angle_rad, value)
}

fn angle_axis() -> Axis {
    Axis::linear(0.0, LAST_ANGLE).label(r"$\phi_L$ (rad)").ticks(Ticks::pi_decimal(0.1))
}

fn points<'a>(x: &'a [f64], y: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
    x.iter().copied().zip(y.iter().copied())
}

fn circle(points: impl IntoIterator<Item = (f64, f64)>) -> Scatter {
    Scatter::new(points).marker(Marker::Circle).size(4.5).filled_white()
}

fn number((x, y): (f64, f64), raised: f64, label: &str) -> Text {
    Text::at_data(x, y + raised, label).anchor(Anchor::Centre).size(NUMBER_SIZE).halo(Colour::WHITE)
}

/// What the number at a curve is.
fn key((x, y): (f64, f64)) -> Text {
    Text::at_data(x, y, r"$n$, $\theta = n\pi/8$").anchor(Anchor::LeftCentre).size(8.0)
}

fn zero() -> Rule {
    Rule::horizontal(0.0).stroke(Stroke::new(Colour::LIGHT_GREY, 0.5))
}

/// A curve per phase lag, numbered with n.
fn lag_panel(panel: Panel, data: &Curves, family: &Family, measure: &Measure, row: usize) -> Panel {
    let angles = &data.amplitude_angle_rad;
    let mut panel = panel
        .x(angle_axis())
        .y(measure.axes[row].clone().label_distance(26.0))
        .letter_in(measure.letters[row], Corner::TopLeft)
        .layer(zero());
    let mut numbers = Vec::new();
    // The curve of θ = 0 covers that of θ = π where they coincide.
    for curve in family.curves.iter().rev() {
        let values = (measure.values)(curve);
        let at = |share: f64| {
            let index = angles.partition_point(|angle| *angle < share * data.largest_amplitude_angle_rad);
            let index = index.min(angles.len() - 1);
            (angles[index], values[index])
        };
        let name = curve.n.to_string();
        match (measure.number)(row, curve.n) {
            NumberPlace::At(share, raised) => numbers.push(number(at(share), raised, &name)),
            NumberPlace::Best(raised) => numbers.push(number((measure.best)(curve), raised, &name)),
            NumberPlace::With(name, share) => numbers.push(number(at(share), 0.0, name)),
            NumberPlace::Nowhere => {}
        }
        panel = panel
            .layer(Line::new(points(angles, &values)).colour(lag_colour(curve.n)).width(1.1).dash(dash(row)));
    }
    let linear = [family.curves.first(), family.curves.last()].into_iter().flatten().map(measure.best);
    panel.layers(numbers).layer(circle(linear)).layer(key(measure.key[row]))
}

fn dash(row: usize) -> Dash {
    if row == 0 { Dash::Solid } else { Dash::Dashed }
}

fn separation_panel(panel: Panel, data: &Curves) -> Panel {
    let separation = &data.separation;
    let mut panel = panel
        .x(Axis::linear(0.0, FRAC_PI_2).label(r"$\tau_{sep}$ (rad)").ticks(Ticks::pi(1, 8).minor(1)))
        .y(Axis::linear(-26.0, 26.0)
            .label(r"$\dot{\alpha}_f$ (rad/s)")
            .ticks(Ticks::every(10.0))
            .label_distance(26.0))
        .letter_in("d", Corner::TopRight)
        .layer(zero())
        .layer(Rule::vertical(separation.lowest_rad));
    let phases = &separation.separation_phase_rad;
    let mut numbers = Vec::new();
    for curve in &separation.curves {
        panel = panel.layer(
            Line::new(points(phases, &curve.airborne_speed_rad_per_s)).colour(lag_colour(curve.n)).width(1.1),
        );
        // The curves of n = 0 and 1 are farthest apart at their tops, and almost coincide to the right of
        // them.
        let (at, raised) = match curve.n {
            0 => (0.40, 2.4),
            1 => (0.31, -1.0),
            8 => (0.48, -2.2),
            _ => (0.48, 0.0),
        };
        let index = phases.partition_point(|phase| *phase < at).min(phases.len() - 1);
        let place = (phases[index], curve.airborne_speed_rad_per_s[index]);
        numbers.push(number(place, raised, &curve.n.to_string()));
    }
    panel.layers(numbers).layer(key((0.25 * PI, -22.0)))
}

fn friction_panel(panel: Panel, data: &Curves) -> Panel {
    let mut panel = panel
        .x(angle_axis())
        .y(Axis::linear(0.0, 26.0)
            .label(r"$\dot{\alpha}_f$ (rad/s)")
            .ticks(Ticks::every(5.0).minor(1))
            .label_distance(26.0))
        .letter("e");
    let colours = [Colour::LIGHT_GREY.mixed(Colour::GREY, 0.5), Colour::DARK_GREY, Colour::BLACK];
    let dashes = [Dash::Dotted, Dash::Solid, Dash::Dashed];
    for (index, curve) in data.friction_curves.iter().enumerate() {
        panel = panel.layer(
            Line::new(points(&data.amplitude_angle_rad, &curve.airborne_speed_rad_per_s))
                .colour(colours[index % colours.len()])
                .dash(dashes[index % dashes.len()])
                .width(1.1)
                .name(format!(r"$\mu = {}$", curve.friction)),
        );
    }
    panel
        .layer(circle(data.friction_curves.iter().map(|curve| curve.fastest.speed())))
        .legend(Legend::at(Corner::BottomRight).without_frame())
}

fn consistency_panel(panel: Panel, data: &Curves) -> Panel {
    let consistency = &data.consistency;
    let grid = &consistency.coarse_grid;
    let mut panel = panel
        .x(Axis::linear(0.25 * PI, 0.38 * PI).label(r"$\phi_L$ (rad)").ticks(Ticks::pi_decimal(0.05)))
        .y(Axis::linear(14.0, 23.5)
            .label(r"$\dot{\alpha}_f$ (rad/s)")
            .ticks(Ticks::every(2.0).minor(2))
            .label_distance(26.0))
        .letter("f");
    if let Some(curve) = data.families.first().and_then(|family| family.curves.first()) {
        let points = points(&data.amplitude_angle_rad, &curve.airborne_speed_rad_per_s);
        panel = panel
            .layer(Line::new(points).colour(Colour::DARK_GREY).width(1.1).name("Table I"))
            .layer(circle([curve.fastest.speed()]));
    }
    let curve = &consistency.coarse_grid_curve;
    let line = Line::new(points(&curve.amplitude_angle_rad, &curve.airborne_speed_rad_per_s));
    panel = panel.layer(line.colour(Colour::VERMILION).dash(Dash::Dotted).width(1.1).name("Eq. (14), grid"));
    let sampled = Scatter::new(points(&grid.grid_angle_rad, &grid.grid_speed_rad_per_s));
    panel = panel.layer(sampled.colour(Colour::VERMILION).size(3.6));
    let printed = [&data.printed.optimal_amplitude_angle_rad, &data.printed.largest_airborne_speed_rad_per_s]
        .map(|text| PrintedNumber::read(text));
    if let [Some(angle), Some(speed)] = printed {
        let printed = Scatter::new([(angle.value, speed.value)])
            .marker(Marker::Square)
            .size(5.0)
            .errors_x([angle.half_unit])
            .errors_y([speed.half_unit])
            .name("printed");
        panel = panel.layer(Layer::from(printed));
    }
    panel.legend(Legend::at(Corner::BottomLeft).without_frame().inset(2.0))
}

pub(super) fn draw(data: &Curves) -> Figure {
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 3, 3)
        .margins(Margins { left: 40.0, right: 8.0, top: 20.0, bottom: 32.0 })
        .gaps(44.0, 47.0);
    let titles = ["dough at rest at the start", "dough turning with the hand at the start"];
    let mut figure = Figure::new(DOUBLE_COLUMN, HEIGHT);
    for (row, (family, title)) in data.families.iter().zip(titles).enumerate() {
        for (column, measure) in measures().iter().enumerate() {
            let mut panel = Panel::new(grid.cell(row, column));
            if column == 1 {
                panel = panel.title(title);
            }
            figure = figure.panel(lag_panel(panel, data, family, measure, row));
        }
    }
    figure
        .panel(separation_panel(Panel::new(grid.cell(2, 0)), data))
        .panel(friction_panel(Panel::new(grid.cell(2, 1)), data))
        .panel(consistency_panel(Panel::new(grid.cell(2, 2)), data))
}
