//! The picture of Fig. 6.

use bouncing_disk_plot::pictures::{IMPACT_PHASE, OrbitDiagram};
use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Margins, Panel,
    Rect, Rule, Stroke, Text, Ticks,
};

use super::diagram::{Diagram, Slice};
use super::enlarged;
use crate::figures::shared::FORCING_RANGE;
use crate::figures::shared::numbers::extent;

/// Orbits of more impacts are drawn by the density of their impacts: dots that let others shine through.
const SEPARATE: usize = 24;
/// Radius of such a dot (points): a pixel of the picture.
const DOT: f64 = 0.25;
const FOLLOWED: Colour = Colour::rgb(20, 20, 20);
const CHATTERING: Colour = Colour::rgb(150, 150, 150);

/// What is drawn.
pub(super) struct Picture<'a> {
    pub(super) diagram: &'a Diagram,
    pub(super) doublings: &'a [f64],
    pub(super) crisis: Option<f64>,
    /// The panels of Fig. 7.
    pub(super) axial_forcings_of_fig7: [f64; 5],
    pub(super) enlarged: &'a [enlarged::Column],
}

/// A column of the data.
type Column = fn(&Slice) -> &[f64];

pub(super) fn draw(picture: &Picture<'_>) -> Figure {
    /// The four panels of the paper.
    const UPPER: f64 = 400.0;
    const HEIGHT: f64 = 570.0;
    let diagram = picture.diagram;
    let margins = Margins { left: 46.0, right: 16.0, top: 22.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, UPPER, 2, 2).margins(margins).gaps(52.0, 12.0);
    let (low, high) = FORCING_RANGE;
    let panel = |row: usize, column: usize, letter: &str, y: Axis, of: Column| {
        let x = Axis::linear(low, high).ticks(Ticks::every(0.05).minor(5));
        let x = if row == 0 { x.without_numbers() } else { x.label(r"$\Gamma$") };
        let shaded = |slices: &[Slice], colour: Colour, opacity: f64, name: &str| {
            let points = |dense: bool| {
                slices
                    .iter()
                    .filter(move |slice| (of(slice).len() > SEPARATE) == dense)
                    .flat_map(|slice| of(slice).iter().map(|value| (slice.axial_forcing, *value)))
            };
            [
                DensePoints::new(points(true)).colour(colour).radius(DOT).opacity(opacity),
                DensePoints::new(points(false)).colour(colour).radius(0.3).name(name),
            ]
        };
        let panel = Panel::new(grid.cell(row, column)).x(x).y(y).letter(letter);
        marked(panel, picture, (row, column))
            .layers(shaded(&diagram.chattering, CHATTERING, 0.4, "chattering"))
            .layers(shaded(&diagram.followed, FOLLOWED, 0.07, "followed from period 1"))
    };
    let speed = || Axis::linear(-1.1, 1.1).ticks(Ticks::every(0.5).minor(5));
    let fastest = diagram
        .followed
        .iter()
        .chain(&diagram.chattering)
        .flat_map(|slice| slice.normalised_impact_speed.iter())
        .fold(0.0_f64, |most, speed| most.max(*speed));
    let [phases, speeds] = OrbitDiagram::axes(fastest);
    let speeds = speeds.ticks(Ticks::every(0.5).minor(5));
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
        panel(0, 0, "a", phases, |slice| &slice.impact_phase_cycles),
        panel(0, 1, "b", speeds, |slice| &slice.normalised_impact_speed),
        panel(1, 0, "c", speed().label(r"$\dot{\alpha}'/|\omega\Phi|$"), |slice| &slice.linear)
            .legend(Legend::at(Corner::BottomLeft)),
        panel(1, 1, "d", speed().label(r"$\dot{\alpha}'/|\omega\Phi|$"), |slice| &slice.semielliptical),
        enlarged_panel(picture, area(&grid, UPPER, HEIGHT)),
    ])
}

/// Lines at the Γ of Fig. 7 and at the crisis, with their names where there is room.
fn marked(mut panel: Panel, picture: &Picture<'_>, (row, column): (usize, usize)) -> Panel {
    let (low, high) = FORCING_RANGE;
    for (forcing, name) in picture.axial_forcings_of_fig7.into_iter().zip(["a", "b", "c", "d", "e"]) {
        let stroke = Stroke::new(Colour::VERMILION, 0.5).dashed(Dash::Dotted);
        panel = panel.layer(Rule::vertical(forcing).stroke(stroke));
        if row == 0 {
            let place = (forcing - low) / (high - low);
            // (b) and (c) are neighbours.
            let (shift, anchor) = match name {
                "b" => (0.006, Anchor::Right),
                "c" => (-0.006, Anchor::Left),
                _ => (0.0, Anchor::Middle),
            };
            let text = Text::at_axes(place + shift, 1.035, format!("7({name})"));
            panel = panel.layer(text.anchor(anchor).size(8.0).colour(Colour::VERMILION));
        }
    }
    let Some(crisis) = picture.crisis else { return panel };
    panel = panel.layer(Rule::vertical(crisis).stroke(Stroke::new(Colour::BLUE, 0.6).dashed(Dash::Dashed)));
    if (row, column) == (0, 0) {
        panel = panel.layer(Text::at_data(crisis + 0.004, 0.5, "crisis").size(8.0).colour(Colour::BLUE));
    }
    panel
}

/// The place of the enlarged part: below the others, over both columns.
fn area(grid: &Grid, upper: f64, height: f64) -> Rect {
    let (left, right) = (grid.cell(1, 0), grid.cell(1, 1));
    Rect::new(left.left, upper + 18.0, right.right() - left.left, height - upper - 18.0 - 34.0)
}

/// The doublings that panel (a) is too coarse for, in the upper half of the branches.
fn enlarged_panel(picture: &Picture<'_>, area: Rect) -> Panel {
    let dots = |dense: Option<bool>| -> Vec<(f64, f64)> {
        let phases = |column: &enlarged::Column| column.impact_phase_cycles.clone();
        let columns = picture.enlarged.iter();
        let columns =
            columns.filter(|column| dense.is_none_or(|dense| (phases(column).len() > SEPARATE) == dense));
        let upper = columns.flat_map(|column| {
            let (low, high) = extent(phases(column));
            let upper = phases(column).into_iter().filter(move |phase| *phase > 0.5 * (low + high));
            upper.map(|phase| (column.axial_forcing, phase))
        });
        upper.collect()
    };
    let (low, high) = extent(picture.enlarged.iter().map(|column| column.axial_forcing));
    let (lowest, highest) = extent(dots(None).into_iter().map(|dot| dot.1));
    let room = 0.12 * (highest - lowest);
    let mut panel = Panel::new(area)
        .x(Axis::linear(low, high).label(r"$\Gamma$").ticks(Ticks::every(0.001).minor(5)))
        .y(Axis::linear(lowest - room, highest + room).label(IMPACT_PHASE).ticks(Ticks::every(0.01).minor(5)))
        .letter("a'");
    for n in enlarged::DOUBLINGS {
        let Some(forcing) = picture.doublings.get(n - 1) else { continue };
        let stroke = Stroke::new(Colour::BLUE, 0.6).dashed(Dash::Dashed);
        let place = (forcing - low) / (high - low);
        let text = Text::at_axes(place, 1.035, format!(r"$\Gamma_{n}$"));
        panel = panel
            .layer(Rule::vertical(*forcing).stroke(stroke))
            .layer(text.anchor(Anchor::Middle).size(8.0).colour(Colour::BLUE));
    }
    // The columns are wider than those of the other panels.
    panel
        .layer(DensePoints::new(dots(Some(true))).colour(FOLLOWED).radius(0.5).opacity(0.4))
        .layer(DensePoints::new(dots(Some(false))).colour(FOLLOWED).radius(0.5))
}
