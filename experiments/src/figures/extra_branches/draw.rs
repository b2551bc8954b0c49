//! The drawing of the figure.

use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Line, Margins,
    Marker, Panel, Rule, Scatter, Stroke, Text, Ticks,
};

use super::data::{Column, Curve, ExtraBranchesData, Family, Mark, MarkKind};

/// The phases of panels begin here, so that both orbits of a pair meet in their fold and not at a seam.
const FIRST_PHASE: f64 = -0.3;

/// Two neighbouring points this far apart lie on either side of the seam.
const SEAM: f64 = 0.5;

const KINDS: [(MarkKind, &str, Marker); 4] = [
    (MarkKind::Fold, "fold", Marker::Square),
    (MarkKind::Doubling, "doubling", Marker::Circle),
    (MarkKind::Graze, "graze", Marker::Cross),
    (MarkKind::VanishingImpact, "vanishing impact", Marker::Triangle),
];

const fn colour(family: Family) -> Colour {
    match family {
        Family::PeriodOne(_) => Colour::BLACK,
        Family::Doubled => Colour::BLUE,
        Family::Other => Colour::GREEN,
    }
}

fn shown(cycles: f64) -> f64 {
    if cycles >= FIRST_PHASE + 1.0 { cycles - 1.0 } else { cycles }
}

/// The parts of a branch that are stable, or that are not: a curve for each impact, broken where it is of
/// the other kind and at the seam.
fn parts(curve: &Curve, stable: bool) -> Vec<(f64, f64)> {
    let gap = (f64::NAN, f64::NAN);
    let mut points = Vec::new();
    for phases in &curve.impact_phase_cycles {
        for (index, own) in curve.stable.iter().enumerate() {
            let ends = [index, index + 1].map(|at| (curve.axial_forcings[at], shown(phases[at])));
            if *own != stable || (ends[1].1 - ends[0].1).abs() > SEAM {
                points.push(gap);
                continue;
            }
            if points.last() != Some(&ends[0]) {
                points.push(ends[0]);
            }
            points.push(ends[1]);
        }
        points.push(gap);
    }
    points
}

fn dots(columns: &[Column]) -> Vec<(f64, f64)> {
    let of = |column: &Column| {
        let forcing = column.axial_forcing;
        column.impact_phase_cycles.iter().map(move |phase| (forcing, shown(*phase))).collect::<Vec<_>>()
    };
    columns.iter().flat_map(of).collect()
}

pub(super) fn draw(data: &ExtraBranchesData) -> Figure {
    const HEIGHT: f64 = 520.0;
    let margins = Margins { left: 46.0, right: 10.0, top: 18.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 2, 1).margins(margins).gaps(0.0, 40.0);
    let [narrow, wide] = data.axial_forcing_ranges;
    let everything = |_: &Curve| true;
    let of_pairs = |curve: &Curve| curve.family != Family::Other && curve.impacts <= 2;
    let a =
        panel(data, &grid, 0, narrow, everything).letter("a").legend(Legend::at(Corner::TopLeft).inset(24.0));
    let b = panel(data, &grid, 1, wide, of_pairs).letter("b");
    Figure::new(DOUBLE_COLUMN, HEIGHT)
        .panels([named(a, data, narrow, &[1, 2, 4]), named(b, data, wide, &[1])])
}

fn panel(
    data: &ExtraBranchesData,
    grid: &Grid,
    row: usize,
    (low, high): (f64, f64),
    is_drawn: impl Fn(&Curve) -> bool,
) -> Panel {
    let step = if high - low < 0.5 { 0.05 } else { 0.2 };
    let mut panel = Panel::new(grid.cell(row, 0))
        .x(Axis::linear(low, high).label(r"$\Gamma$").ticks(Ticks::every(step).minor(4)))
        .y(Axis::linear(FIRST_PHASE, FIRST_PHASE + 1.0)
            .label(r"$\tau_{imp}/2\pi$")
            .ticks(Ticks::every(0.2).minor(4)))
        .markers_on_top()
        .layer(DensePoints::new(dots(&data.from_rest)).colour(Colour::LIGHT_GREY).radius(0.3));
    for followed in &data.followed {
        panel = panel.layer(DensePoints::new(dots(followed)).colour(Colour::GREY).radius(0.35));
    }
    let names =
        [(Family::PeriodOne(1), "one impact"), (Family::Doubled, "doubled"), (Family::Other, "others")];
    // What is drawn last lies on top.
    for (family, name) in [names[2], names[1], names[0]] {
        let own = |curve: &&Curve| colour(curve.family) == colour(family) && is_drawn(curve);
        let mut name = Some(name);
        for curve in data.curves.iter().filter(own) {
            let width = if family == Family::Other { 0.7 } else { 1.0 };
            let dashed =
                Line::new(parts(curve, false)).colour(colour(family)).width(0.7 * width).dash(Dash::Dashed);
            let mut solid = Line::new(parts(curve, true)).colour(colour(family)).width(1.5 * width);
            if let Some(name) = name.take() {
                solid = solid.name(name);
            }
            panel = panel.layer(dashed).layer(solid);
        }
    }
    let is_marked = |mark: &Mark| {
        data.curves
            .iter()
            .any(|curve| curve.family == mark.family && curve.impacts >= mark.impacts && is_drawn(curve))
    };
    for (kind, name, marker) in KINDS {
        let own = data.marks.iter().filter(|mark| mark.kind == kind && is_marked(mark));
        let scatter = |points: Vec<(f64, f64)>, colour: Colour| {
            Scatter::new(points).marker(marker).size(3.6).width(0.7).colour(colour).filled_white()
        };
        if own.clone().next().is_some() {
            // In the legend marks have the colour of no family.
            panel = panel.layer(scatter(Vec::new(), Colour::DARK_GREY).name(name));
        }
        for family in [Family::Other, Family::Doubled, Family::PeriodOne(1)] {
            let points = own
                .clone()
                .filter(|mark| colour(mark.family) == colour(family))
                .flat_map(|mark| {
                    mark.impact_phase_cycles.iter().map(|phase| (mark.axial_forcing, shown(*phase)))
                })
                .filter(|(forcing, _)| (low..=high).contains(forcing))
                .collect();
            panel = panel.layer(scatter(points, colour(family)));
        }
    }
    panel
}

/// Names the pairs at their folds, and the doublings of the orbits of so many impacts that follow from k = 1.
fn named(mut panel: Panel, data: &ExtraBranchesData, (low, high): (f64, f64), doublings: &[usize]) -> Panel {
    let width = high - low;
    let inside = |forcing: f64| (low..high).contains(&forcing);
    for pair in data.pairs.iter().filter(|pair| inside(pair.fold_in_closed_form)) {
        let text = format!("$k = {}$", pair.platform_periods);
        let place = Text::at_data(pair.fold_in_closed_form + 0.012 * width, 0.0, text);
        panel = panel.layer(place.anchor(Anchor::LeftCentre).size(8.0).halo(Colour::WHITE));
    }
    for (n, point) in data.doublings.iter().enumerate() {
        if !doublings.contains(&point.impacts) || !inside(point.axial_forcing) {
            continue;
        }
        let text = Text::at_axes((point.axial_forcing - low) / width, 1.025, format!(r"$\Gamma_{}$", n + 1));
        let stroke = Stroke::new(Colour::BLUE, 0.5).dashed(Dash::Dotted);
        panel = panel
            .layer(Rule::vertical(point.axial_forcing).stroke(stroke))
            .layer(text.anchor(Anchor::Middle).size(8.0).colour(Colour::BLUE));
    }
    panel
}
