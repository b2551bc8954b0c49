//! The orbit diagram: phases and speeds of the impacts over the forcing.

use bouncing_disk_plot::{
    Anchor, Axis, Colour, DOUBLE_COLUMN, DensePoints, Figure, Grid, Margins, Panel, Text, Ticks,
};

use super::{PHASE, SPEED, largest, math};

/// Forcing, impact phase (periods), normalised impact speed.
type Point = (f64, f64, f64);

/// The colours of the starts, in their order. The first lies on top of the others: beyond the crisis a start at rest and
/// one beside the period-1 orbit are on the same attractor, and light points say so.
const COLOURS: [Colour; 8] = [
    Colour::LIGHT_GREY,
    Colour::rgb(40, 40, 40),
    Colour::BLUE,
    Colour::VERMILION,
    Colour::GREEN,
    Colour::PURPLE,
    Colour::ORANGE,
    Colour::SKY,
];

/// The colour of a start; beyond the eighth the same in a darker shade, and again.
fn colour(index: usize, starts: usize) -> Colour {
    if starts == 1 {
        return COLOURS[1];
    }
    let rounds = (index / COLOURS.len()) as f64;
    COLOURS[index % COLOURS.len()].mixed(Colour::BLACK, 1.0 - 1.0 / (1.0 + 0.6 * rounds))
}

/// Starts whose names have room beside the letter of the panel.
const BESIDE: usize = 2;

/// Names in a row of their own, and the height of such a row (pt).
const IN_A_ROW: usize = 4;
const ROW: f64 = 11.0;

/// Two panels, phases and speeds; `ends` are those of the forcing, `names` say from where the orbits start.
pub(crate) fn draw(ends: (f64, f64), restitution: f64, names: &[String], layers: &[Vec<Point>]) -> Figure {
    const FRAME: f64 = 174.0;
    let beside = names.len() <= BESIDE;
    let rows = if beside { 0 } else { names.len().div_ceil(IN_A_ROW) };
    let margins = Margins { left: 46.0, right: 10.0, top: 22.0 + ROW * rows as f64, bottom: 34.0 };
    let height = margins.top + FRAME + margins.bottom;
    let grid = Grid::new(DOUBLE_COLUMN, height, 1, 2).margins(margins).gaps(52.0, 0.0);
    let fastest = largest(layers.iter().flatten().map(|point| point.2), 0.1);
    // In the units of the first panel's width, and of its height.
    let place = |index: usize| {
        if beside {
            return (0.12 + 0.34 * index as f64, 1.045);
        }
        let row = rows - index / IN_A_ROW;
        (0.56 * (index % IN_A_ROW) as f64, 1.045 + ROW * row as f64 / FRAME)
    };
    let panel = |column: usize, letter: &str, y: Axis, of: fn(&Point) -> (f64, f64)| {
        let mut panel = Panel::new(grid.cell(0, column))
            .x(Axis::linear(ends.0, ends.1).label(r"$\Gamma$"))
            .y(y)
            // Above the frame: no corner is free for certain. There stands the power of ten of large speeds,
            // too.
            .layer(Text::at_axes(
                if column == 1 && fastest >= 1e3 { 0.2 } else { 0.0 },
                1.045,
                format!("({letter})"),
            ));
        if column == 1 {
            let words = Text::at_axes(1.0, 1.045, format!(r"$\epsilon = {}$", math(restitution)));
            panel = panel.layer(words.anchor(Anchor::Right).size(8.0));
        }
        for (index, (points, name)) in layers.iter().zip(names).enumerate().rev() {
            let own = colour(index, names.len());
            panel = panel.layer(DensePoints::new(points.iter().map(of)).colour(own).radius(0.3));
            if column == 0 && names.len() > 1 {
                let (x, y) = place(index);
                let words = Text::at_axes(x, y, name.as_str());
                panel = panel.layer(words.size(8.0).colour(own.mixed(Colour::BLACK, 0.25)));
            }
        }
        panel
    };
    let phases = Axis::linear(0.0, 1.0).label(PHASE).ticks(Ticks::every(0.2).minor(4));
    let speeds = Axis::linear(0.0, 1.08 * fastest).label(SPEED);
    Figure::new(DOUBLE_COLUMN, height).panels([
        panel(0, "a", phases, |point| (point.0, point.1)),
        panel(1, "b", speeds, |point| (point.0, point.2)),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_have_colours_of_their_own() {
        for starts in [2, 4, 8, 24] {
            let all: Vec<Colour> = (0..starts).map(|index| colour(index, starts)).collect();
            for (index, one) in all.iter().enumerate() {
                assert!(!all[..index].contains(one), "{index} of {starts}");
            }
        }
    }

    #[test]
    fn any_number_of_starts_is_drawn_with_all_names() {
        for starts in [0, 1, 2, 3, 4, 5, 13] {
            let names: Vec<String> = (0..starts).map(|index| format!("0.{index},1.{index}")).collect();
            let layers = vec![vec![(0.4, 0.2, 1.0)]; starts];
            let svg = draw((0.3, 0.5), 0.5, &names, &layers).to_svg().unwrap();
            let named = names.iter().filter(|name| svg.contains(name.as_str())).count();
            assert_eq!(named, if starts > 1 { starts } else { 0 }, "{starts}");
        }
    }
}
