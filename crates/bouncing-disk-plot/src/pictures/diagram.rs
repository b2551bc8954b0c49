//! The orbit diagram, and a figure of the shrinking distances between doublings.

use super::impact_plane::{IMPACT_SPEED, all_phases, fastest};
use crate::annotation::Text;
use crate::axis::Axis;
use crate::colour::Colour;
use crate::dense::DensePoints;
use crate::figure::{DOUBLE_COLUMN, Figure, SINGLE_COLUMN};
use crate::frame::{Grid, Margins, Rect};
use crate::line::Line;
use crate::numbers::in_math;
use crate::panel::Panel;
use crate::scatter::Scatter;
use crate::style::Anchor;
use crate::ticks::Ticks;

/// Number of colours for starts; further starts repeat them in a darker shade.
const COLOURS: usize = 8;

/// Number of starts whose names fit next to the letter of the panel.
const BESIDE: usize = 2;

/// Number of names in a separate row, and the height of such a row (pt).
const IN_A_ROW: usize = 4;
const ROW: f64 = 11.0;

/// The name of a start, and the impacts of the orbits from it: forcing, phase (periods), normalised speed.
pub type OrbitsFrom = (String, Vec<(f64, f64, f64)>);

/// Phases and speeds of the impacts over the forcing.
#[derive(Debug)]
pub struct OrbitDiagram<'a> {
    /// The ends of the axis of the forcing.
    pub axial_forcings: (f64, f64),
    /// The restitution of all orbits.
    pub restitution: f64,
    /// Words to print after the restitution, such as the shape of a drive: ", parabolas".
    pub shape: &'a str,
    /// The orbits, grouped by their start.
    pub starts: &'a [OrbitsFrom],
}

impl OrbitDiagram<'_> {
    /// The colour of a single start.
    pub const ALONE: Colour = Colour::rgb(40, 40, 40);

    /// The colour of a start; further starts repeat the eight colours in ever darker shades. The first start is
    /// drawn in light points on top of the others: beyond the crisis they show that a start at rest and one
    /// near the period-1 orbit end on the same attractor.
    fn colour(index: usize, starts: usize) -> Colour {
        if starts == 1 {
            return Self::ALONE;
        }
        let rounds = (index / COLOURS) as f64;
        let colour = match index % COLOURS {
            0 => Colour::LIGHT_GREY,
            1 => Self::ALONE,
            other => Colour::cycle(other - 1),
        };
        colour.mixed(Colour::BLACK, 1.0 - 1.0 / (1.0 + 0.6 * rounds))
    }

    /// The axes of the phases and of the speeds up to `fastest`.
    pub fn axes(fastest: f64) -> [Axis; 2] {
        [all_phases(), Axis::linear(0.0, 1.08 * fastest).label(IMPACT_SPEED)]
    }

    /// Two panels, phases and speeds.
    pub fn draw(&self) -> Figure {
        const FRAME: f64 = 174.0;
        let starts = self.starts;
        let beside = starts.len() <= BESIDE;
        let rows = if beside { 0 } else { starts.len().div_ceil(IN_A_ROW) };
        let margins = Margins { left: 46.0, right: 10.0, top: 22.0 + ROW * rows as f64, bottom: 34.0 };
        let height = margins.top + FRAME + margins.bottom;
        let grid = Grid::new(DOUBLE_COLUMN, height, 1, 2).margins(margins).gaps(52.0, 0.0);
        let fastest = fastest(starts.iter().flat_map(|start| &start.1).map(|impact| impact.2), 0.1);
        // In the units of the first panel's width, and of its height.
        let place = |index: usize| {
            if beside {
                return (0.12 + 0.34 * index as f64, 1.045);
            }
            let row = rows - index / IN_A_ROW;
            (0.56 * (index % IN_A_ROW) as f64, 1.045 + ROW * row as f64 / FRAME)
        };
        let panel = |column: usize, letter: &str, y: Axis| {
            let of = |impact: &(f64, f64, f64)| (impact.0, if column == 0 { impact.1 } else { impact.2 });
            // Above the frame, next to the power of ten of large speeds: a corner may not be free.
            let left = if column == 1 && fastest >= 1e3 { 0.2 } else { 0.0 };
            let mut panel = Panel::new(grid.cell(0, column))
                .x(Axis::linear(self.axial_forcings.0, self.axial_forcings.1).label(r"$\Gamma$"))
                .y(y)
                .layer(Text::at_axes(left, 1.045, format!("({letter})")));
            if column == 1 {
                let words = format!(r"$\epsilon = {}${}", in_math(self.restitution), self.shape);
                let words = Text::at_axes(1.0, 1.045, words);
                panel = panel.layer(words.anchor(Anchor::Right).size(8.0));
            }
            for (index, (name, impacts)) in starts.iter().enumerate().rev() {
                let own = Self::colour(index, starts.len());
                panel = panel.layer(DensePoints::new(impacts.iter().map(of)).colour(own));
                if column == 0 && starts.len() > 1 {
                    let (x, y) = place(index);
                    let words = Text::at_axes(x, y, name.as_str()).size(8.0);
                    panel = panel.layer(words.colour(own.mixed(Colour::BLACK, 0.25)));
                }
            }
            panel
        };
        let [phases, speeds] = Self::axes(fastest);
        Figure::new(DOUBLE_COLUMN, height).panels([panel(0, "a", phases), panel(1, "b", speeds)])
    }
}

/// The forcings of a doubling cascade: distances from each doubling to the next one, on a logarithmic axis.
pub fn doublings(restitution: f64, axial_forcings: &[f64]) -> Figure {
    const HEIGHT: f64 = 190.0;
    let distances = axial_forcings.windows(2).map(|pair| pair[1] - pair[0]);
    let distances: Vec<(f64, f64)> =
        (1..).map(f64::from).zip(distances).filter(|(_, distance)| *distance > 0.0).collect();
    let least = distances.iter().fold(0.1_f64, |least, (_, distance)| least.min(*distance));
    let last = axial_forcings.len().max(2) as f64;
    let panel = Panel::new(Rect::new(50.0, 24.0, 184.0, 132.0))
        .x(Axis::linear(0.5, last - 0.5).label("$n$").ticks(Ticks::every(1.0).minor(1)))
        .y(Axis::log(0.3 * least, 0.3).label(r"$\Gamma_{n+1} - \Gamma_n$"))
        .title(format!(r"$\epsilon = {}$", in_math(restitution)))
        .layer(Line::new(distances.clone()).colour(Colour::GREY).width(0.6))
        .layer(Scatter::new(distances).size(3.2).colour(Colour::BLUE));
    Figure::new(SINGLE_COLUMN, HEIGHT).panel(panel)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_have_colours_of_their_own() {
        for starts in [2, 4, 8, 24] {
            let all: Vec<Colour> = (0..starts).map(|index| OrbitDiagram::colour(index, starts)).collect();
            for (index, one) in all.iter().enumerate() {
                assert!(!all[..index].contains(one), "{index} of {starts}");
            }
        }
    }

    #[test]
    fn any_number_of_starts_is_drawn_with_all_names() {
        for count in [0, 1, 2, 3, 4, 5, 13] {
            let start = |index: usize| (format!("0.{index},1.{index}"), vec![(0.4, 0.2, 1.0)]);
            let starts: Vec<_> = (0..count).map(start).collect();
            let diagram =
                OrbitDiagram { axial_forcings: (0.3, 0.5), restitution: 0.5, shape: "", starts: &starts };
            let svg = diagram.draw().to_svg().expect("draws");
            let named = starts.iter().filter(|(name, _)| svg.contains(name.as_str())).count();
            assert_eq!(named, if count > 1 { count } else { 0 }, "{count}");
        }
    }
}
