//! Curves, bands and reference lines.

use kurbo::{BezPath, Line as Segment, ParamCurve, Point, Rect, Shape};

use crate::builders::builders;
use crate::colour::Colour;
use crate::frame::Frame;
use crate::label::Label;
use crate::path::{polygon, polyline};
use crate::style::{Dash, Fill, Stroke, Style};
use crate::svg::Svg;

/// Points closer than this, in points of the page, are drawn as one.
const RESOLUTION: f64 = 0.04;
/// A curve is clipped at this distance beyond the frame (points).
const OVERHANG: f64 = 20.0;

/// A curve through points, broken at points with a coordinate that is NaN or cannot be shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    points: Vec<(f64, f64)>,
    pub(crate) style: Style,
    pub(crate) name: Option<Label>,
}

builders!(Line: style, colour, width, dash, opacity, name);

impl Line {
    /// A curve through points in data coordinates.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { points: points.into_iter().collect(), style: Style::default().width(1.0), name: None }
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) {
        let points = self.points.iter().map(|point| frame.point(*point));
        if let Some(fill) = self.style.fill {
            svg.path(&polygon(points.clone().filter(|point| point.is_finite())), &fill.into());
        }
        if let Some(stroke) = self.style.stroke {
            svg.path(&curve(frame.area.outline(), points), &stroke.into());
        }
    }
}

/// A polyline that is clipped near the frame, thinned to the resolution and broken at NaN.
fn curve(frame: Rect, points: impl Iterator<Item = Point>) -> BezPath {
    let window = frame.inflate(OVERHANG, OVERHANG);
    let near = |end: Option<Point>, point: Point| {
        end.is_some_and(|end| (end.x - point.x).abs() < RESOLUTION && (end.y - point.y).abs() < RESOLUTION)
    };
    let mut path = BezPath::new();
    // The end of a piece that was omitted because it nearly coincides with the point before.
    let mut skipped: Option<Point> = None;
    let mut previous = Point::new(f64::NAN, f64::NAN);
    for point in points {
        let piece = clip(Segment::new(previous, point), window);
        previous = point;
        let Some(piece) = piece else { continue };
        if !near(path.current_position(), piece.p0) {
            if let Some(end) = skipped.take() {
                path.line_to(end);
            }
            path.move_to(piece.p0);
        }
        if near(path.current_position(), piece.p1) {
            skipped = Some(piece.p1);
        } else {
            path.line_to(piece.p1);
            skipped = None;
        }
    }
    if let Some(end) = skipped {
        path.line_to(end);
    }
    path
}

/// The part of a segment within a window; `None` if there is none or an end is not finite.
fn clip(segment: Segment, window: Rect) -> Option<Segment> {
    let inside = (window.contains(segment.p0), window.contains(segment.p1));
    if inside == (true, true) {
        return Some(segment);
    }
    if !segment.is_finite() || !window.overlaps(segment.bounding_box()) {
        return None;
    }
    let edges = window.to_path(RESOLUTION);
    let crossings = edges.segments().flat_map(|edge| edge.intersect_line(segment)).map(|hit| hit.line_t);
    let (first, last) = crossings.fold((1.0_f64, 0.0_f64), |(first, last), at| (first.min(at), last.max(at)));
    let enter = if inside.0 { 0.0 } else { first };
    let leave = if inside.1 { 1.0 } else { last };
    (enter < leave).then(|| segment.subsegment(enter..leave))
}

/// The area between a lower and an upper curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    points: Vec<(f64, f64, f64)>,
    pub(crate) style: Style,
    pub(crate) name: Option<Label>,
}

builders!(Band: style, colour, opacity, name);

impl Band {
    /// A band through `(x, low, high)`; broken at NaN.
    pub fn new(points: impl IntoIterator<Item = (f64, f64, f64)>) -> Self {
        let style = Fill::new(Colour::LIGHT_GREY, 0.5).into();
        Self { points: points.into_iter().collect(), style, name: None }
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) {
        let edges: Vec<_> = self
            .points
            .iter()
            .map(|&(x, low, high)| (frame.point((x, low)), frame.point((x, high))))
            .collect();
        let parts = edges.split(|(low, high)| !(low.is_finite() && high.is_finite()));
        let mut path = BezPath::new();
        for part in parts.filter(|part| part.len() > 1) {
            let (low, high) = (part.iter().map(|edge| edge.0), part.iter().rev().map(|edge| edge.1));
            path.extend(polygon(low.chain(high)));
        }
        svg.path(&path, &self.style);
    }
}

/// A reference line across the panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    vertical: bool,
    value: f64,
    pub(crate) style: Style,
    pub(crate) name: Option<Label>,
}

builders!(Rule: style, stroke, name);

impl Rule {
    /// A vertical line at `x`.
    pub fn vertical(x: f64) -> Self {
        Self::new(true, x)
    }

    /// A horizontal line at `y`.
    pub fn horizontal(y: f64) -> Self {
        Self::new(false, y)
    }

    fn new(vertical: bool, value: f64) -> Self {
        let style = Stroke::new(Colour::GREY, 0.6).dashed(Dash::Dashed).into();
        Self { vertical, value, style, name: None }
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) {
        let fraction =
            if self.vertical { frame.x.fraction(self.value) } else { frame.y.fraction(self.value) };
        if !(0.0..=1.0).contains(&fraction) {
            return;
        }
        let ends = if self.vertical {
            [(fraction, 1.0), (fraction, 0.0)]
        } else {
            [(0.0, fraction), (1.0, fraction)]
        };
        svg.path(&(frame.area.fractions() * polyline(ends.map(Point::from))), &self.style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Axis;
    use crate::svg::rounded;

    fn path(points: &[(f64, f64)]) -> String {
        let (x, y) = (Axis::linear(0.0, 100.0), Axis::linear(100.0, 0.0));
        let frame = Frame { area: crate::frame::Rect::new(0.0, 0.0, 100.0, 100.0), x: &x, y: &y };
        let points = points.iter().map(|point| frame.point(*point));
        rounded(&curve(frame.area.outline(), points)).to_svg()
    }

    #[test]
    fn a_curve_breaks_at_nan() {
        assert_eq!(
            path(&[(0.0, 0.0), (10.0, 0.0), (20.0, f64::NAN), (30.0, 0.0), (40.0, 0.0)]),
            "M0,0 L10,0 M30,0 L40,0"
        );
    }

    #[test]
    fn segments_far_outside_are_clipped_or_left_out() {
        assert_eq!(path(&[(50.0, 50.0), (50.0, 1e9)]), "M50,50 L50,120");
        assert_eq!(path(&[(500.0, 0.0), (600.0, 100.0)]), "");
        assert_eq!(path(&[(-1e9, 50.0), (1e9, 50.0)]), "M-20,50 L120,50");
    }

    #[test]
    fn close_points_are_drawn_as_one_but_the_end_is_kept() {
        let points: Vec<_> = (0..=1000).map(|i| (f64::from(i) * 0.001, 0.0)).collect();
        let path = path(&points);
        assert!(path.matches('L').count() <= 26, "{path}");
        assert!(path.ends_with("L1,0"), "{path}");
    }
}
