//! Outlines.

use kurbo::{BezPath, PathEl, Point};

/// An outline of straight lines and cubic Bézier curves, in the local coordinates of a
/// [`Drawing`](crate::Drawing). One with a point that is not finite is not drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    outline: BezPath,
}

impl Path {
    /// An empty outline.
    pub fn new() -> Self {
        Self::default()
    }

    /// Straight lines through points; broken at NaN.
    pub fn through(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut outline = BezPath::new();
        let mut pen_down = false;
        for point in points.into_iter().map(Point::from) {
            let finite = point.is_finite();
            if finite {
                outline.push(if pen_down { PathEl::LineTo(point) } else { PathEl::MoveTo(point) });
            }
            pen_down = finite;
        }
        Self { outline }
    }

    /// Lifts the pen and goes to a point.
    #[must_use]
    pub fn move_to(self, x: f64, y: f64) -> Self {
        self.then(PathEl::MoveTo(Point::new(x, y)))
    }

    /// A straight line; at the beginning of an outline it only sets the first point.
    #[must_use]
    pub fn line_to(self, x: f64, y: f64) -> Self {
        self.then(PathEl::LineTo(Point::new(x, y)))
    }

    /// A cubic Bézier curve with two control points; at the beginning of an outline it only sets the first
    /// point.
    #[must_use]
    pub fn curve_to(self, first: (f64, f64), second: (f64, f64), end: (f64, f64)) -> Self {
        self.then(PathEl::CurveTo(first.into(), second.into(), end.into()))
    }

    /// Back to the start of this part.
    #[must_use]
    pub fn close(self) -> Self {
        self.then(PathEl::ClosePath)
    }

    /// A path begins with a point: nothing can be drawn to or closed before.
    fn then(mut self, element: PathEl) -> Self {
        if !self.outline.elements().is_empty() {
            self.outline.push(element);
        } else if let Some(start) = element.end_point() {
            self.outline.move_to(start);
        }
        self
    }

    pub(crate) fn outline(&self) -> &BezPath {
        &self.outline
    }
}

/// The outline of a polygon.
pub(crate) fn polygon(points: impl IntoIterator<Item = Point>) -> BezPath {
    let mut outline = polyline(points);
    if !outline.elements().is_empty() {
        outline.close_path();
    }
    outline
}

/// Straight lines through points.
pub(crate) fn polyline(points: impl IntoIterator<Item = Point>) -> BezPath {
    let mut points = points.into_iter();
    let start = points.next().map(PathEl::MoveTo);
    start.into_iter().chain(points.map(PathEl::LineTo)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_breaks_at_nan() {
        let path = Path::through([(0.0, 0.0), (1.0, 0.0), (f64::NAN, 0.0), (2.0, 0.0), (3.0, 1.0)]);
        assert_eq!(path.outline().to_svg(), "M0,0 L1,0 M2,0 L3,1");
    }

    #[test]
    fn an_outline_always_begins_with_a_point() {
        let path = Path::new().close().line_to(1.0, 2.0).line_to(3.0, 4.0).close();
        assert_eq!(path.outline().to_svg(), "M1,2 L3,4 Z");
        assert_eq!(polygon([]).to_svg(), "");
    }
}
