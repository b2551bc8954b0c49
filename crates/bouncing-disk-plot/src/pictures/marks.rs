//! Marks on the cells of a map and on the points of a curve, with their key.

use crate::annotation::Text;
use crate::axis::Axis;
use crate::frame::Rect;
use crate::panel::Panel;
use crate::scatter::{Marker, Scatter};
use crate::ticks::Ticks;

/// The mark of a cell, in addition to its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CellMarks {
    /// Several motions coexist; the value refers to the motion reached from rest.
    pub coexisting: bool,
    /// The motion repeats itself.
    pub periodic: bool,
    /// The value is not known to the requested accuracy.
    pub unsettled: bool,
    /// There is no steady motion: the load overpowers the motor.
    pub runaway: bool,
    /// A motor with rigid impacts is locked to a short cycle.
    pub locked: bool,
    /// Whether a bound is satisfied; `None` if there is no bound, or if this is not known.
    pub keeps: Option<bool>,
}

/// A mark: its words in the key, its marker, its offset from the middle of a cell of a map (in shares of the
/// cell), its size around a point of a curve (points), and a test for cells that have it. No mark covers
/// another.
struct Mark {
    words: &'static str,
    marker: Marker,
    place: (f64, f64),
    around_point: f64,
    of: fn(&CellMarks) -> bool,
}

const MARKS: [Mark; 5] = [
    Mark {
        words: "several motions; value of the motion from rest",
        marker: Marker::Diamond,
        place: (0.0, 0.0),
        around_point: 7.0,
        of: |cell| cell.coexisting,
    },
    Mark {
        words: "not settled",
        marker: Marker::Circle,
        place: (0.3, 0.3),
        around_point: 5.6,
        of: |cell| cell.unsettled,
    },
    Mark {
        words: "periodic motion",
        marker: Marker::Square,
        place: (-0.3, -0.3),
        around_point: 4.4,
        of: |cell| cell.periodic,
    },
    Mark {
        words: "locked to a short cycle at exactly these inputs",
        marker: Marker::Square,
        place: (0.3, -0.3),
        around_point: 8.4,
        of: |cell| cell.locked,
    },
    Mark {
        words: "no steady motion: overpowered",
        marker: Marker::Cross,
        place: (0.0, 0.0),
        around_point: 4.4,
        of: |cell| cell.runaway,
    },
];

/// The least and the largest size of a mark in a map, and its size in the key (points).
const SIZES: [f64; 2] = [1.2, 4.0];
const IN_KEY: f64 = 3.4;

/// The height of a line of the key (points).
const LINE: f64 = 11.0;

fn scatter(points: impl IntoIterator<Item = (f64, f64)>, mark: &Mark, size: f64) -> Scatter {
    Scatter::new(points).marker(mark.marker).size(size).width(0.5)
}

/// The marks of the cells of a map, row by row. The cells are centred at `x` and `y`; `sides` are the sides of
/// a cell, in the units of the axes and in points.
pub(super) fn of_map(
    (x, y): (&[f64], &[f64]),
    cells: &[CellMarks],
    sides: [(f64, f64); 2],
) -> impl Iterator<Item = Scatter> {
    let [width, height] = sides;
    let size = (0.28 * width.1.min(height.1)).clamp(SIZES[0], SIZES[1]);
    MARKS.iter().map(move |mark| {
        let middles = y.iter().flat_map(|y| x.iter().map(move |x| (*x, *y)));
        let marked = middles.zip(cells).filter(|(_, cell)| (mark.of)(cell));
        let (right, up) = (mark.place.0 * width.0, mark.place.1 * height.0);
        scatter(marked.map(|((x, y), _)| (x + right, y + up)), mark, size).filled_white()
    })
}

/// The marks of the points of a curve, around the points.
pub(super) fn of_curve(points: &[(f64, f64)], cells: &[CellMarks]) -> impl Iterator<Item = Scatter> {
    MARKS.iter().map(move |mark| {
        let marked = points.iter().zip(cells).filter(|(point, cell)| point.1.is_finite() && (mark.of)(cell));
        scatter(marked.map(|(point, _)| *point), mark, mark.around_point)
    })
}

/// The key of the marks that occur, one below the other from `top` on, and its height; `None` without marks.
pub(super) fn key(cells: &[CellMarks], left: f64, top: f64) -> Option<(Panel, f64)> {
    let there: Vec<&Mark> = MARKS.iter().filter(|mark| cells.iter().any(mark.of)).collect();
    if there.is_empty() {
        return None;
    }
    let (count, height) = (there.len() as f64, LINE * there.len() as f64);
    let place = |index: usize| count - index as f64 - 0.5;
    let words =
        |(index, mark): (usize, &&Mark)| Text::at_axes(1.4, place(index) / count, mark.words).size(8.0);
    let panel = Panel::new(Rect::new(left, top, LINE, height))
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(0.0, count).ticks(Ticks::none()))
        .layers(there.iter().enumerate().map(|(index, mark)| scatter([(0.5, place(index))], mark, IN_KEY)))
        .layers(there.iter().enumerate().map(words));
    Some((panel, height))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::{Quantity, heat_map, swept_curve};

    const PLAIN: CellMarks = CellMarks {
        coexisting: false,
        periodic: false,
        unsettled: false,
        runaway: false,
        locked: false,
        keeps: None,
    };

    #[test]
    fn only_marks_that_are_there_are_drawn_and_in_the_key() {
        let quantity = |name, values| Quantity { name, unit: "1", values };
        let (two, four) = (&[0.0, 1.0][..], &[1.0, 2.0, 3.0, 4.0][..]);
        let map = |cells: &[CellMarks]| {
            let figure =
                heat_map(&quantity("x", two), &quantity("y", two), &quantity("z", four), cells, None);
            figure.to_svg().expect("drawn")
        };
        let curve = |cells: &[CellMarks]| {
            let figure = swept_curve(&quantity("x", four), &quantity("z", four), &[0.1; 4], cells, &[], None);
            figure.to_svg().expect("drawn")
        };
        let several = CellMarks { coexisting: true, ..PLAIN };
        let rough = CellMarks { unsettled: true, ..PLAIN };
        for draw in [&map as &dyn Fn(&[CellMarks]) -> String, &curve] {
            let none = draw(&[PLAIN; 4]);
            assert_eq!(none, draw(&[]));
            assert!(MARKS.iter().all(|mark| !none.contains(mark.words)));
            let both = draw(&[PLAIN, several, rough, PLAIN]);
            let there: Vec<bool> = MARKS.iter().map(|mark| both.contains(mark.words)).collect();
            assert_eq!(there, [true, true, false, false, false]);
            assert!(draw(&[PLAIN, CellMarks { periodic: true, ..PLAIN }]).contains("periodic motion"));
        }
    }
}
