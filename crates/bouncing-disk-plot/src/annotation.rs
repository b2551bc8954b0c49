//! Words and arrows in a panel.

use kurbo::{Affine, BezPath, Point};

use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::label::Label;
use crate::path::{polygon, polyline};
use crate::style::{Anchor, Stroke, Style, TextStyle};
use crate::svg::Svg;

/// Where something is placed in a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Data(f64, f64),
    /// Fractions of the frame from its lower left corner.
    Axes(f64, f64),
}

impl Place {
    fn on_page(self, frame: &Frame<'_>) -> Point {
        match self {
            Self::Data(x, y) => frame.point((x, y)),
            Self::Axes(x, y) => frame.area.fractions() * Point::new(x, y),
        }
    }
}

/// A text in a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    place: Place,
    label: Label,
    style: TextStyle,
}

builders!(Text: colour);

builders!(Text {
    /// Chooses the point of the text that is placed; the left end, vertically centred, unless set.
    anchor(anchor: Anchor) |own| own.style.anchor = anchor;
    /// Sets the font size in points.
    size(points: f64) |own| own.style = own.style.size(points);
    /// Turns the text anticlockwise.
    rotated(degrees: f64) |own| own.style = own.style.rotated(degrees);
    /// Puts a rim around the letters, which keeps them legible on a picture.
    halo(colour: Colour) |own| own.style = own.style.halo(colour);
});

impl Text {
    /// A text at a point in data coordinates.
    pub fn at_data(x: f64, y: f64, label: impl Into<Label>) -> Self {
        Self::at(Place::Data(x, y), label.into())
    }

    /// A text at fractions of the frame's width and height from its lower left corner.
    pub fn at_axes(x: f64, y: f64, label: impl Into<Label>) -> Self {
        Self::at(Place::Axes(x, y), label.into())
    }

    fn at(place: Place, label: Label) -> Self {
        Self { place, label, style: TextStyle::new(Anchor::LeftCentre) }
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        svg.label(&self.label, self.place.on_page(frame), self.style)
    }
}

/// A straight arrow in a panel; its head is at the second point.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    from: (f64, f64),
    to: (f64, f64),
    head: f64,
}

builders!(Arrow {
    /// Sets the length of the head in points.
    head(points: f64) |own| own.head = points;
});

impl Arrow {
    /// An arrow between two points in data coordinates.
    pub fn at_data(from: (f64, f64), to: (f64, f64)) -> Self {
        Self { from, to, head: 5.0 }
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) {
        for (path, style) in
            arrow(&[self.from, self.to].map(|end| frame.point(end)), Stroke::default(), self.head)
        {
            svg.path(&path, &style);
        }
    }
}

/// A line through points on the page with a head at the last one; empty if the head has no direction.
pub(crate) fn arrow(points: &[Point], stroke: Stroke, head: f64) -> Vec<(BezPath, Style)> {
    let [start @ .., tip] = points else { return Vec::new() };
    let Some(before) = start.last() else { return Vec::new() };
    let along = (*tip - *before).normalize();
    if !along.is_finite() {
        return Vec::new();
    }
    // The head is drawn along x in units of its length, its tip at the origin.
    let turned = Affine::new([along.x, along.y, -along.y, along.x, tip.x, tip.y]).pre_scale(head);
    // The line ends inside the head, so that its square end does not blunt the tip.
    let line = polyline(start.iter().copied().chain([turned * Point::new(-0.7, 0.0)]));
    let triangle = polygon([(0.0, 0.0), (-1.0, 0.38), (-0.75, 0.0), (-1.0, -0.38)].map(Point::from));
    vec![(line, stroke.into()), (turned * triangle, stroke.solid().into())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_points_to_the_last_point() {
        let points = [Point::ZERO, Point::new(0.0, 10.0)];
        let parts = arrow(&points, Stroke::default(), 5.0);
        assert_eq!(parts[0].0.to_svg(), "M0,0 L0,6.5");
        let head = parts[1].0.control_box();
        assert!((head.y1 - 10.0).abs() < 1e-12 && (head.y0 - 5.0).abs() < 1e-12, "{head:?}");
        assert!((head.x1 - 1.9).abs() < 1e-12 && (head.x0 + 1.9).abs() < 1e-12, "{head:?}");
    }

    #[test]
    fn an_arrow_without_direction_is_not_drawn() {
        for points in
            [vec![], vec![Point::ZERO], vec![Point::ZERO; 2], vec![Point::ZERO, Point::new(f64::NAN, 1.0)]]
        {
            assert!(arrow(&points, Stroke::default(), 5.0).is_empty());
        }
    }
}
