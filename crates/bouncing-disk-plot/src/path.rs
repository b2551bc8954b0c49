//! Outlines.

use kurbo::{BezPath, PathEl, Point};

/// An outline of straight lines, in the local coordinates of a
/// [`Drawing`](crate::Drawing). It is not drawn if a point is not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    outline: BezPath,
}

impl Path {
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

    /// The path with its last part closed.
    #[must_use]
    pub fn close(mut self) -> Self {
        // There is nothing to close before the first point.
        if !self.outline.elements().is_empty() {
            self.outline.close_path();
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
        assert_eq!(Path::through([(1.0, 2.0), (3.0, 4.0)]).close().outline().to_svg(), "M1,2 L3,4 Z");
        assert_eq!(Path::through([]).close().outline().to_svg(), "");
        assert_eq!(polygon([]).to_svg(), "");
    }
}
