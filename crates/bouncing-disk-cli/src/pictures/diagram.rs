//! The orbit diagram: phases and speeds of the impacts over the forcing.

use bouncing_disk_plot::{
    Axis, Colour, DOUBLE_COLUMN, DensePoints, Figure, Grid, Margins, Panel, Text, Ticks,
};

use super::{PHASE, SPEED, largest};

/// Forcing, impact phase (periods), normalised impact speed.
type Point = (f64, f64, f64);

/// The colours of the starts, in their order: as in the paper, the chatter lies light under the rest.
const COLOURS: [Colour; 4] = [Colour::LIGHT_GREY, Colour::rgb(40, 40, 40), Colour::BLUE, Colour::VERMILION];

/// Two panels, phases and speeds; `ends` are those of the forcing.
pub(crate) fn draw(ends: (f64, f64), names: &[String], layers: &[Vec<Point>]) -> Figure {
    const HEIGHT: f64 = 230.0;
    let margins = Margins { left: 46.0, right: 10.0, top: 22.0, bottom: 34.0 };
    let grid = Grid::new(DOUBLE_COLUMN, HEIGHT, 1, 2).margins(margins).gaps(52.0, 0.0);
    let fastest = largest(layers.iter().flatten().map(|point| point.2), 0.1);
    let colour = |index: usize| match names {
        [_] => COLOURS[1],
        _ => COLOURS.get(index).copied().unwrap_or_else(|| Colour::cycle(index)),
    };
    let panel = |column: usize, letter: &str, y: Axis, of: fn(&Point) -> (f64, f64)| {
        let mut panel = Panel::new(grid.cell(0, column))
            .x(Axis::linear(ends.0, ends.1).label(r"$\Gamma$"))
            .y(y)
            // Above the frame: no corner is free for certain.
            .layer(Text::at_axes(0.0, 1.045, format!("({letter})")));
        for (index, (points, name)) in layers.iter().zip(names).enumerate() {
            let dots = DensePoints::new(points.iter().map(of)).colour(colour(index)).radius(0.3);
            panel = panel.layer(dots);
            if column == 0 && names.len() > 1 {
                let words = Text::at_axes(0.12 + 0.3 * index as f64, 1.045, format!("start {name}"));
                panel = panel.layer(words.size(8.0).colour(colour(index).mixed(Colour::BLACK, 0.25)));
            }
        }
        panel
    };
    let phases = Axis::linear(0.0, 1.0).label(PHASE).ticks(Ticks::every(0.2).minor(4));
    let speeds = Axis::linear(0.0, 1.08 * fastest).label(SPEED);
    Figure::new(DOUBLE_COLUMN, HEIGHT).panels([
        panel(0, "a", phases, |point| (point.0, point.1)),
        panel(1, "b", speeds, |point| (point.0, point.2)),
    ])
}
