//! Rectangles on the page, grids of them, and the mapping from data to points.

use kurbo::{Affine, Point};

use crate::axis::Axis;
use crate::builders::builders;

/// A rectangle on the page, in points from the upper left corner of the figure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rect {
    /// The left edge.
    pub left: f64,
    /// The upper edge.
    pub top: f64,
    /// The width.
    pub width: f64,
    /// The height.
    pub height: f64,
}

impl Rect {
    /// A rectangle from its upper left corner and its size.
    pub const fn new(left: f64, top: f64, width: f64, height: f64) -> Self {
        Self { left, top, width, height }
    }

    /// The right edge.
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// The lower edge.
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub(crate) fn outline(&self) -> kurbo::Rect {
        kurbo::Rect::new(self.left, self.top, self.right(), self.bottom())
    }

    /// The map to the page from fractions of width and height, measured from the lower left corner.
    pub(crate) fn fractions(&self) -> Affine {
        Affine::map_unit_square(kurbo::Rect::new(self.left, self.bottom(), self.right(), self.top))
    }

    pub(crate) fn has_area(&self) -> bool {
        let sizes = [self.left, self.top, self.width, self.height];
        sizes.iter().all(|size| size.is_finite()) && self.width > 0.0 && self.height > 0.0
    }
}

/// Room around a grid for tick labels and axis labels, in points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// At the left.
    pub left: f64,
    /// At the right.
    pub right: f64,
    /// Above.
    pub top: f64,
    /// Below.
    pub bottom: f64,
}

impl Default for Margins {
    fn default() -> Self {
        Self { left: 42.0, right: 10.0, top: 8.0, bottom: 32.0 }
    }
}

/// Equal or weighted cells for the axes of several panels. A cell is the frame of a panel: tick labels and
/// axis labels lie outside it, in the margins and gaps.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    width: f64,
    height: f64,
    rows: Vec<f64>,
    columns: Vec<f64>,
    margins: Margins,
    gap_across: f64,
    gap_down: f64,
}

builders!(Grid {
    /// Sets the room around the grid.
    margins(margins: Margins) |own| own.margins = margins;
    /// Sets the room between columns and between rows, in points.
    gaps(between_columns: f64, between_rows: f64) |own|
        (own.gap_across, own.gap_down) = (between_columns, between_rows);
    /// Relative heights of the rows; missing ones stay 1.
    row_weights(weights: &[f64]) |own|
        own.rows.iter_mut().zip(weights).for_each(|(row, weight)| *row = *weight);
    /// Relative widths of the columns; missing ones stay 1.
    column_weights(weights: &[f64]) |own|
        own.columns.iter_mut().zip(weights).for_each(|(column, weight)| *column = *weight);
});

impl Grid {
    /// `rows` times `columns` equal cells in a figure of this size.
    pub fn new(width: f64, height: f64, rows: usize, columns: usize) -> Self {
        Self {
            width,
            height,
            rows: vec![1.0; rows.max(1)],
            columns: vec![1.0; columns.max(1)],
            margins: Margins::default(),
            gap_across: 46.0,
            gap_down: 34.0,
        }
    }

    /// The frame in a row and column, counted from 0 at the upper left; for a cell outside the grid, the last
    /// one.
    pub fn cell(&self, row: usize, column: usize) -> Rect {
        let across = self.width - self.margins.left - self.margins.right;
        let down = self.height - self.margins.top - self.margins.bottom;
        let (left, width) = place(&self.columns, across, self.gap_across, column);
        let (top, height) = place(&self.rows, down, self.gap_down, row);
        Rect::new(self.margins.left + left, self.margins.top + top, width, height)
    }
}

/// Start and length of a cell, in a total length with gaps between the cells.
fn place(weights: &[f64], total: f64, gap: f64, index: usize) -> (f64, f64) {
    let last = weights.len() - 1;
    let index = index.min(last);
    let sum: f64 = weights.iter().sum();
    let room = total - gap * last as f64;
    let before: f64 = weights[..index].iter().sum();
    (before / sum * room + gap * index as f64, weights[index] / sum * room)
}

/// The frame of a panel with the two axes that a layer uses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame<'a> {
    pub(crate) area: Rect,
    pub(crate) x: &'a Axis,
    pub(crate) y: &'a Axis,
}

impl Frame<'_> {
    /// The point on the page of a point in data coordinates; not finite if an axis cannot show it.
    pub(crate) fn point(&self, (x, y): (f64, f64)) -> Point {
        self.area.fractions() * Point::new(self.x.fraction(x), self.y.fraction(y))
    }

    /// Whether a point of the page lies in the frame or on its edge.
    pub(crate) fn contains(&self, point: Point) -> bool {
        let slack = 0.01;
        self.area.outline().inflate(slack, slack).contains(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_fills_the_figure() {
        let grid = Grid::new(300.0, 200.0, 2, 3)
            .margins(Margins { left: 30.0, right: 10.0, top: 5.0, bottom: 25.0 })
            .gaps(20.0, 10.0)
            .row_weights(&[1.0, 3.0]);
        let first = grid.cell(0, 0);
        let last = grid.cell(1, 2);
        assert!((first.left - 30.0).abs() < 1e-12 && (first.top - 5.0).abs() < 1e-12);
        assert!((last.right() - 290.0).abs() < 1e-9 && (last.bottom() - 175.0).abs() < 1e-9);
        assert!((3.0 * first.height - last.height).abs() < 1e-9);
        assert_eq!(grid.cell(9, 9), last);
    }
}
