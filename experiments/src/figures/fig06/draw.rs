//! The drawing of Fig. 6.

use bouncing_disk_plot::pictures::{IMPACT_PHASE, OrbitDiagram};
use bouncing_disk_plot::{
    Anchor, Axis, Colour, Corner, DOUBLE_COLUMN, Dash, DensePoints, Figure, Grid, Legend, Margins, Panel,
    Rect, Rule, Stroke, Text, Ticks,
};

use super::data::{Fig06Data, Slice};

/// Orbits of more impacts are drawn by the density of their impacts: dots that let others shine through.
const SEPARATE: usize = 24;
/// Radius of such a dot (points): a pixel of the picture.
const DOT: f64 = 0.25;
const FOLLOWED: Colour = Colour::rgb(20, 20, 20);
const CHATTERING: Colour = Colour::rgb(150, 150, 150);

/// A column of the data.
type Column = fn(&Slice) -> &[f64];

pub(super) fn draw(data: &Fig06Data) -> Figure {
    /// Of the four panels of the paper.
    const UPPER: f64 = 400.0;
    const HEIGHT: f64 = 570.0;
    let margins = Margins { left: 46.0, right: 16.0, top: 22.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, UPPER, 2, 2).margins(margins).gaps(52.0, 12.0);
    let (low, high) = data.axial_forcing_range;
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
        marked(panel, data, (row, column))
            .layers(shaded(&data.chattering, CHATTERING, 0.4, "chattering"))
            .layers(shaded(&data.followed, FOLLOWED, 0.07, "followed from period 1"))
    };
    let speed = || Axis::linear(-1.1, 1.1).ticks(Ticks::every(0.5).minor(5));
    let fastest = data
        .followed
        .iter()
        .chain(&data.chattering)
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
        zoom(data, zoom_area(&grid, UPPER, HEIGHT)),
    ])
}

/// Lines at the Γ of Fig. 7 and at the crisis, with their names where there is room.
fn marked(mut panel: Panel, data: &Fig06Data, (row, column): (usize, usize)) -> Panel {
    let (low, high) = data.axial_forcing_range;
    for (forcing, name) in data.basin_axial_forcings.into_iter().zip(["a", "b", "c", "d", "e"]) {
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
            let text = Text::at_axes(place + shift, 1.035, format!("({name})"));
            panel = panel.layer(text.anchor(anchor).size(8.0).colour(Colour::VERMILION));
        }
    }
    let crisis = data.merging.axial_forcing();
    panel = panel.layer(Rule::vertical(crisis).stroke(Stroke::new(Colour::BLUE, 0.6).dashed(Dash::Dashed)));
    if (row, column) == (0, 0) {
        panel = panel.layer(Text::at_data(crisis + 0.004, 0.5, "crisis").size(8.0).colour(Colour::BLUE));
    }
    panel
}

/// The place of the enlarged part: below the others, over both columns.
fn zoom_area(grid: &Grid, upper: f64, height: f64) -> Rect {
    let (left, right) = (grid.cell(1, 0), grid.cell(1, 1));
    Rect::new(left.left, upper + 18.0, right.right() - left.left, height - upper - 18.0 - 34.0)
}

/// The doublings that are marked in the enlarged part.
const MARKED_DOUBLINGS: std::ops::RangeInclusive<usize> = 3..=5;
/// Impact phases (periods) shown there: the upper half of the branches.
const SHOWN_PHASES: (f64, f64) = (0.15, 0.35);

/// The doublings that panel (a) is too coarse for.
fn zoom(data: &Fig06Data, area: Rect) -> Panel {
    let shown = |phase: &&f64| **phase > SHOWN_PHASES.0 && **phase < SHOWN_PHASES.1;
    let points = |dense: Option<bool>| -> Vec<(f64, f64)> {
        let columns = data.zoom.iter().filter(|column| {
            dense.is_none_or(|dense| (column.impact_phase_cycles.len() > SEPARATE) == dense)
        });
        columns
            .flat_map(|column| {
                column.impact_phase_cycles.iter().filter(shown).map(|phase| (column.axial_forcing, *phase))
            })
            .collect()
    };
    let dots = points(None);
    let ends = |of: fn(&(f64, f64)) -> f64| {
        dots.iter()
            .map(of)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
    };
    let (low, high) = ends(|dot| dot.0);
    let (lowest, highest) = ends(|dot| dot.1);
    let room = 0.12 * (highest - lowest);
    let mut panel = Panel::new(area)
        .x(Axis::linear(low, high).label(r"$\Gamma$").ticks(Ticks::every(0.001).minor(5)))
        .y(Axis::linear(lowest - room, highest + room).label(IMPACT_PHASE).ticks(Ticks::every(0.01).minor(5)))
        .letter("a'");
    for n in MARKED_DOUBLINGS {
        let Some(forcing) = data.doublings.get(n - 1) else { continue };
        let stroke = Stroke::new(Colour::BLUE, 0.6).dashed(Dash::Dashed);
        let place = (forcing - low) / (high - low);
        let text = Text::at_axes(place, 1.035, format!(r"$\Gamma_{n}$"));
        panel = panel
            .layer(Rule::vertical(*forcing).stroke(stroke))
            .layer(text.anchor(Anchor::Middle).size(8.0).colour(Colour::BLUE));
    }
    // The columns are wider than those of the other panels.
    panel
        .layer(DensePoints::new(points(Some(true))).colour(FOLLOWED).radius(0.5).opacity(0.4))
        .layer(DensePoints::new(points(Some(false))).colour(FOLLOWED).radius(0.5))
}
