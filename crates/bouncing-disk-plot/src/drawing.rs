//! Free drawings: sketches, flow charts, perspective views.

use kurbo::{Affine, BezPath, Circle, Point, Shape, Size, Vec2};

use crate::annotation::arrow;
use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Rect;
use crate::label::Label;
use crate::path::Path;
use crate::style::{Anchor, Fill, Stroke, Style, TextStyle};
use crate::svg::{Svg, TEXT_SIZE, TOLERANCE};

/// The shapes, in points of the page.
#[derive(Clone, Debug, PartialEq)]
enum Item {
    Shape(BezPath, Style),
    Text(Point, Label, TextStyle),
}

/// A free drawing in local coordinates, `y` upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    area: Rect,
    x: (f64, f64),
    y: (f64, f64),
    items: Vec<Item>,
}

builders!(Drawing {
    /// Adds a line along an outline.
    stroke(path: Path, stroke: Stroke) |own| own.shape(own.to_page() * path.outline(), stroke);
    /// Adds a filled outline.
    fill(path: Path, colour: Colour, opacity: f64) |own|
        own.shape(own.to_page() * path.outline(), Fill::new(colour, opacity));
    /// Adds an upright ellipse with half-axes in local units.
    ellipse(centre: (f64, f64), radii: (f64, f64), style: impl Into<Style>) |own| {
        let place = Affine::translate(Vec2::from(centre)).pre_scale_non_uniform(radii.0, radii.1);
        // Four curves, which stay within 0.0003 of the unit circle.
        let circle = Circle::new(Point::ZERO, 1.0).to_path(1e-3);
        own.shape(own.to_page() * place * circle, style)
    };
    /// Adds a text; an [`Anchor`] alone also serves as a style.
    text(at: (f64, f64), style: impl Into<TextStyle>, label: impl Into<Label>) |own|
        own.items.push(Item::Text(own.to_page() * Point::from(at), label.into(), style.into()));
    /// Adds a line through points with a head of 5 points at the last one.
    arrow(points: impl IntoIterator<Item = (f64, f64)>, stroke: Stroke) |own| own.arrows(points, stroke, 5.0);
    /// Adds a line through points with a head of this length in points at the last one.
    arrow_with_head(points: impl IntoIterator<Item = (f64, f64)>, stroke: Stroke, head: f64) |own|
        own.arrows(points, stroke, head);
    /// Adds a line with heads at both ends, for dimensions.
    double_arrow(from: (f64, f64), to: (f64, f64), stroke: Stroke) |own| {
        own.arrows([from, to], stroke, 5.0);
        own.arrows([to, from], stroke, 5.0);
    };
});

impl Drawing {
    /// A drawing whose local coordinates run over `x` and `y` in the rectangle `area`. Nothing is clipped.
    pub fn new(area: Rect, x: (f64, f64), y: (f64, f64)) -> Self {
        Self { area, x, y, items: Vec::new() }
    }

    /// A drawing with the same scale in both directions: the local range is widened in the direction with spare
    /// room.
    pub fn with_equal_scales(area: Rect, x: (f64, f64), y: (f64, f64)) -> Self {
        let (per_x, per_y) = (area.width / (x.1 - x.0).abs(), area.height / (y.1 - y.0).abs());
        let scale = per_x.min(per_y);
        let widened = |range: (f64, f64), length: f64| {
            let middle = 0.5 * (range.0 + range.1);
            let half = if range.1 < range.0 { -0.5 } else { 0.5 } * length / scale;
            (middle - half, middle + half)
        };
        Self::new(area, widened(x, area.width), widened(y, area.height))
    }

    /// Adds a box with lines of text in its middle, for flow charts. Its size is in local units, the radius of
    /// its corners in points.
    #[must_use]
    pub fn text_box<L: Into<Label>>(
        mut self,
        centre: (f64, f64),
        size: (f64, f64),
        corner: f64,
        style: impl Into<Style>,
        lines: impl IntoIterator<Item = L>,
    ) -> Self {
        let area = kurbo::Rect::from_center_size(centre, Size::from(size));
        let area = self.to_page().transform_rect_bbox(area);
        self.shape(area.to_rounded_rect(corner.max(0.0)).to_path(TOLERANCE), style);
        let lines: Vec<Label> = lines.into_iter().map(Into::into).collect();
        let pitch = Vec2::new(0.0, 1.25 * TEXT_SIZE);
        let first = area.center() - 0.5 * (lines.len() as f64 - 1.0) * pitch;
        let placed = lines.into_iter().enumerate();
        self.items.extend(placed.map(|(index, line)| {
            Item::Text(first + index as f64 * pitch, line, TextStyle::new(Anchor::Centre))
        }));
        self
    }

    fn shape(&mut self, outline: BezPath, style: impl Into<Style>) {
        self.items.push(Item::Shape(outline, style.into()));
    }

    fn arrows(&mut self, points: impl IntoIterator<Item = (f64, f64)>, stroke: Stroke, head: f64) {
        let points: Vec<_> = points.into_iter().map(|point| self.to_page() * Point::from(point)).collect();
        arrow(&points, stroke, head).into_iter().for_each(|(path, style)| self.shape(path, style));
    }

    /// The local coordinates of a point on the page, for letters in the corner of a drawing with widened
    /// ranges.
    pub fn local(&self, place: (f64, f64)) -> (f64, f64) {
        (self.to_page().inverse() * Point::from(place)).into()
    }

    /// The map from local coordinates to the page.
    fn to_page(&self) -> Affine {
        let range = kurbo::Rect::new(self.x.0, self.y.0, self.x.1, self.y.1);
        self.area.fractions() * Affine::map_unit_square(range).inverse()
    }

    pub(crate) fn render(&self, svg: &mut Svg) -> Result<(), DrawError> {
        if !self.area.has_area() {
            let Rect { width, height, .. } = self.area;
            return Err(DrawError::Size { what: "a drawing", width, height });
        }
        for (low, high) in [self.x, self.y] {
            let extent = (high - low).abs();
            if !(extent > 0.0 && extent.is_finite()) {
                return Err(DrawError::AxisRange { axis: "of a drawing".to_owned(), low, high });
            }
        }
        for item in &self.items {
            match item {
                Item::Shape(path, style) => svg.path(path, style),
                Item::Text(at, label, style) => svg.label(label, *at, *style)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn local_coordinates_run_upwards_and_back() {
        let drawing =
            Drawing::with_equal_scales(Rect::new(10.0, 20.0, 200.0, 100.0), (-1.0, 1.0), (0.0, 2.0));
        let place = drawing.to_page() * Point::new(0.0, 2.0);
        assert!((place - Point::new(110.0, 20.0)).hypot() < 1e-12, "{place:?}");
        let (x, y) = drawing.local((110.0, 20.0));
        assert!(x.abs() < 1e-12 && (y - 2.0).abs() < 1e-12);
    }

    #[test]
    fn ellipses_and_boxes_have_their_size_on_the_page() {
        let drawing = Drawing::new(Rect::new(0.0, 0.0, 100.0, 50.0), (0.0, 10.0), (0.0, 10.0))
            .ellipse((5.0, 5.0), (2.0, 1.0), Colour::GREY)
            .text_box((5.0, 5.0), (4.0, 2.0), 1.5, Stroke::default(), ["words"]);
        let expected = kurbo::Rect::new(30.0, 20.0, 70.0, 30.0);
        for item in &drawing.items {
            let Item::Shape(path, _) = item else { continue };
            let extent = path.bounding_box();
            let distance = (extent.origin() - expected.origin()).hypot()
                + (extent.size() - expected.size()).to_vec2().hypot();
            assert!(distance < 1e-9, "{extent:?}");
        }
    }
}
