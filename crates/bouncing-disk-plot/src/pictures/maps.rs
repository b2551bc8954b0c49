//! Maps of equal cells and the key of their colours: basins, regimes, a quantity over two parameters.

use super::impact_plane::{IMPACT_PHASE, IMPACT_SPEED, crosses};
use super::marks::{self, CellMarks};
use super::torque_speed::Quantity;
use crate::axis::Axis;
use crate::colour::Colour;
use crate::figure::{DOUBLE_COLUMN, Figure, SINGLE_COLUMN};
use crate::frame::Rect;
use crate::label::Label;
use crate::line::Line;
use crate::numbers::{extent, in_math};
use crate::panel::Panel;
use crate::raster::Raster;
use crate::ticks::Ticks;

/// A key: a column of squares in these colours of a palette, with their words on the right.
pub fn key<L: Into<Label>>(
    area: Rect,
    palette: &[Colour],
    entries: impl IntoIterator<Item = (u8, L)>,
) -> Panel {
    let (mut squares, words): (Vec<u8>, Vec<L>) = entries.into_iter().unzip();
    squares.reverse();
    let count = squares.len();
    let ends = (0.0, count.max(1) as f64);
    let ticks = words.into_iter().enumerate().map(|(k, words)| ((count - 1 - k) as f64 + 0.5, words));
    Panel::new(area)
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(ends.0, ends.1).ticks(Ticks::none()))
        .right(Axis::linear(ends.0, ends.1).ticks(Ticks::at(ticks)))
        .layer(Raster::new(1, count, squares, palette, (0.0, 1.0), ends))
}

/// Basins of attraction in the plane of impact phase and impact speed.
#[derive(Debug)]
pub struct Basins<'a> {
    /// The line above the map.
    pub title: String,
    /// The ends of the window: phases in periods, normalised speeds.
    pub phases: [f64; 2],
    /// See [`phases`](Self::phases).
    pub speeds: [f64; 2],
    /// The labels of a square grid of cells, row by row from the lowest speed: 0 is undecided, 1 rest, 2 the
    /// first orbit.
    pub labels: &'a [u8],
    /// The words of the labels.
    pub legend: &'a [(u8, String)],
    /// Label, phase and speed of the impacts of the periodic attractors.
    pub impacts: &'a [(u8, f64, f64)],
}

impl Basins<'_> {
    /// The label of the first orbit.
    const FIRST_ORBIT: u8 = 2;

    /// The colour of a label, as in the paper: rest white, the first orbit black; further orbits in colours.
    fn colour(label: u8) -> Colour {
        match label {
            0 => Colour::LIGHT_GREY,
            1 => Colour::WHITE,
            other => Colour::cycle(usize::from(other - Self::FIRST_ORBIT)),
        }
    }

    /// The map with its crosses, and the key of the labels that occur.
    pub fn draw(&self) -> Figure {
        const WIDTH: f64 = 470.0;
        const HEIGHT: f64 = 300.0;
        let palette: Vec<Colour> = (0..=u8::MAX).map(Self::colour).collect();
        let (x, y) = (self.phases.into(), self.speeds.into());
        let cells = self.labels.len().isqrt();
        let spots = |first: bool| {
            let own = self.impacts.iter().filter(move |own| (own.0 == Self::FIRST_ORBIT) == first);
            own.map(|own| (own.1, own.2))
        };
        let map = Panel::new(Rect::new(44.0, 26.0, 290.0, 240.0))
            .x(Axis::linear(self.phases[0], self.phases[1]).label(IMPACT_PHASE))
            .y(Axis::linear(self.speeds[0], self.speeds[1]).label(IMPACT_SPEED))
            .title(self.title.as_str())
            .layer(Raster::new(cells, cells, self.labels.to_vec(), &palette, x, y))
            .layer(crosses(spots(true), Colour::WHITE))
            .layer(crosses(spots(false), Colour::BLACK))
            .markers_on_top();
        let mut there = [false; 256];
        self.labels.iter().for_each(|label| there[usize::from(*label)] = true);
        let shown = self.legend.iter().filter(|(label, _)| there[usize::from(*label)]);
        let shown: Vec<_> = shown.map(|(label, words)| (*label, short(words))).collect();
        let count = shown.len() as f64;
        let area = Rect::new(348.0, 26.0, 14.0, 14.0_f64.min(240.0 / count) * count);
        Figure::new(WIDTH, HEIGHT).panels([map, key(area, &palette, shown)])
    }
}

/// The words without their details, for which there is no room.
fn short(words: &str) -> &str {
    // Every start takes impacts of its own until it rests.
    if words.starts_with("rest") {
        return "rest";
    }
    let words = words.split(',').next().unwrap_or(words);
    words.split(" and ").next().unwrap_or(words)
}

/// Short names and colours of the long-term motions of a disk, in the order of their numbers in [`Regimes`].
pub const REGIMES: [(&str, Colour); 10] = [
    ("at rest", Colour::PALE_GREY),
    ("cycle with rest", Colour::WHITE),
    ("same, by rounding", Colour::rgb(250, 225, 160)),
    ("period 1", Colour::BLUE),
    ("period 2", Colour::SKY),
    ("period 3", Colour::GREEN),
    (r"period $\geq 4$", Colour::PURPLE),
    ("chaotic", Colour::VERMILION),
    ("undecided", Colour::BLACK),
    ("no such start", Colour::GREY),
];

/// The long-term motion of a disk, over forcing and restitution; a strip for a single restitution.
#[derive(Debug)]
pub struct Regimes<'a> {
    /// The outer ends of the cells.
    pub axial_forcings: (f64, f64),
    /// See [`axial_forcings`](Self::axial_forcings).
    pub restitutions: (f64, f64),
    /// The restitution, if there is a single one.
    pub only: Option<f64>,
    /// Number of rows, one for each restitution.
    pub rows: usize,
    /// Indices into [`REGIMES`], row by row.
    pub cells: &'a [u8],
}

impl Regimes<'_> {
    /// The map, and the key of its colours.
    pub fn draw(&self) -> Figure {
        let frame = if self.only.is_some() { 120.0 } else { 256.0 };
        let (x, y) = (self.axial_forcings, self.restitutions);
        let vertical = match self.only {
            Some(only) => {
                let middle = 0.5 * (y.0 + y.1);
                Axis::linear(y.0, y.1).ticks(Ticks::at([(middle, format!("${}$", in_math(only)))]).minor(1))
            }
            None => Axis::linear(y.0, y.1),
        };
        let columns = self.cells.len() / self.rows.max(1);
        let palette = REGIMES.map(|(_, colour)| colour);
        let map = Panel::new(Rect::new(44.0, 10.0, 346.0, frame))
            .x(Axis::linear(x.0, x.1).label(r"$\Gamma$"))
            .y(vertical.label(r"restitution $\epsilon$"))
            .layer(Raster::new(columns, self.rows, self.cells.to_vec(), &palette, x, y));
        let names = (0..).zip(REGIMES.map(|(name, _)| name));
        let shown: Vec<_> = names.filter(|(k, _)| self.cells.contains(k)).collect();
        let count = shown.len() as f64;
        let size = 12.0_f64.min(frame / count) * count;
        let area = Rect::new(404.0, 10.0 + 0.5 * (frame - size), 12.0, size);
        Figure::new(DOUBLE_COLUMN, frame + 46.0).panels([map, key(area, &palette, shown)])
    }
}

/// Number of colours of a map, between the least and the largest value.
const LEVELS: usize = 24;

/// A quantity over two evenly spaced parameters, row by row, as a map with a bar of its colours; a cell that
/// is not finite is grey. Cells carry marks, which a key below the map explains. If `bound` is named, a line
/// separates the cells that satisfy it from the others.
pub fn heat_map(
    columns: &Quantity<'_>,
    rows: &Quantity<'_>,
    cells: &Quantity<'_>,
    cell_marks: &[CellMarks],
    bound: Option<&str>,
) -> Figure {
    const WIDTH: f64 = 156.0;
    const HEIGHT: f64 = 150.0;
    let (x, x_label) = columns.shown();
    let (y, y_label) = rows.shown();
    let (values, label) = cells.shown();
    // All cells alike, or none with a value.
    let (least, most) = match extent(values.iter().copied()) {
        (least, most) if least < most => (least, most),
        (least, _) if least.is_finite() && least.abs() > 0.0 => {
            (least - 0.5 * least.abs(), least + 0.5 * least.abs())
        }
        _ => (0.0, 1.0),
    };
    let level = |value: &f64| {
        let share = (value - least) / (most - least);
        if share.is_finite() {
            1 + ((share * LEVELS as f64).max(0.0) as usize).min(LEVELS - 1) as u8
        } else {
            0
        }
    };
    let steps = (0..LEVELS).map(|level| Colour::scale((level as f64 + 0.5) / LEVELS as f64));
    let palette: Vec<Colour> = std::iter::once(Colour::PALE_GREY).chain(steps).collect();
    let cells = values.iter().map(level).collect();
    let (x_ends, y_ends) = (outer_ends(&x), outer_ends(&y));
    let side = |ends: (f64, f64), count: usize, size: f64| {
        let count = count.max(1) as f64;
        ((ends.1 - ends.0) / count, size / count)
    };
    let sides = [side(x_ends, x.len(), WIDTH), side(y_ends, y.len(), HEIGHT)];
    let map = Panel::new(Rect::new(48.0, 12.0, WIDTH, HEIGHT))
        .x(Axis::linear(x_ends.0, x_ends.1).label(x_label))
        .y(Axis::linear(y_ends.0, y_ends.1).label(y_label))
        .layer(Raster::new(x.len(), y.len(), cells, &palette, x_ends, y_ends))
        .layers(marks::of_map((&x, &y), cell_marks, sides));
    let map = match bound {
        Some(bound) => {
            let keeps: Vec<bool> = cell_marks.iter().map(|own| own.keeps == Some(true)).collect();
            let edges = edges(&keeps, (x.len(), y.len()), (x_ends, y_ends));
            let line = |colour, width| Line::new(edges.iter().copied()).colour(colour).width(width);
            map.title(bound).layer(line(Colour::WHITE, 2.4)).layer(line(Colour::VERMILION, 1.2))
        }
        None => map,
    };
    let bar = (1..=LEVELS as u8).collect();
    let bar = Panel::new(Rect::new(212.0, 12.0, 8.0, HEIGHT))
        .x(Axis::linear(0.0, 1.0).ticks(Ticks::none()))
        .y(Axis::linear(least, most).ticks(Ticks::none()))
        .right(Axis::spanned(least, most).label(label))
        .layer(Raster::new(1, LEVELS, bar, &palette, (0.0, 1.0), (least, most)));
    let key = marks::key(cell_marks, 48.0, 198.0);
    let height = 202.0 + key.as_ref().map_or(0.0, |(_, height)| height + 2.0);
    Figure::new(SINGLE_COLUMN + 30.0, height).panels([map, bar]).panels(key.map(|(key, _)| key))
}

/// The lines between the cells of a map that satisfy a bound and the others, with gaps between them.
fn edges(
    keeps: &[bool],
    (columns, rows): (usize, usize),
    (x, y): ((f64, f64), (f64, f64)),
) -> Vec<(f64, f64)> {
    let at = |column: usize, row: usize| {
        let share = |(low, high): (f64, f64), index: usize, count: usize| {
            low + (high - low) * index as f64 / count.max(1) as f64
        };
        (share(x, column, columns), share(y, row, rows))
    };
    let keeps = |column: usize, row: usize| keeps.get(row * columns + column).copied();
    let mut lines = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let own = keeps(column, row);
            if column + 1 < columns && own != keeps(column + 1, row) {
                lines.extend([at(column + 1, row), at(column + 1, row + 1), (f64::NAN, f64::NAN)]);
            }
            if row + 1 < rows && own != keeps(column, row + 1) {
                lines.extend([at(column, row + 1), at(column + 1, row + 1), (f64::NAN, f64::NAN)]);
            }
        }
    }
    lines
}

/// The outer ends of equal cells with these middles.
fn outer_ends(middles: &[f64]) -> (f64, f64) {
    let (Some(low), Some(high)) = (middles.first(), middles.last()) else { return (0.0, 1.0) };
    let half = match middles.len() {
        1 => 0.5 * low.abs().max(1e-9),
        count => 0.5 * (high - low) / (count - 1) as f64,
    };
    (low - half, high + half)
}
