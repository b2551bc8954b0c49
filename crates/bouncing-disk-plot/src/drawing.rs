//! Free drawings: sketches, flow charts, perspective views.

use kurbo::{Affine, BezPath, Circle, Point, Shape, Size, Vec2};

use crate::annotation::arrow;
use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Rect;
use crate::label::Label;
use crate::path::Path;
use crate::style::{Fill, Stroke, Style};
use crate::svg::{Svg, TEXT_SIZE, TOLERANCE};
use crate::text_style::{Anchor, TextStyle};

/// The shapes, in points of the page.
#[derive(Clone, Debug, PartialEq)]
enum Item {
    Shape(BezPath, Style),
    Text(Point, Label, TextStyle),
    /// Lines of text about a point.
    Lines(Point, Vec<Label>),
}

/// A box with centred lines of text in a [`Drawing`].
#[derive(Clone, Debug, PartialEq)]
pub struct TextBox {
    centre: (f64, f64),
    size: (f64, f64),
    corner: f64,
    lines: Vec<Label>,
    style: Style,
}

builders!(TextBox: style);

impl TextBox {
    /// A box of this size in local units, with a thin black outline and sharp corners unless set.
    pub fn new<L: Into<Label>>(
        centre: (f64, f64),
        size: (f64, f64),
        lines: impl IntoIterator<Item = L>,
    ) -> Self {
        let lines = lines.into_iter().map(Into::into).collect();
        Self { centre, size, corner: 0.0, lines, style: Stroke::default().into() }
    }

    /// Sets the radius of the corners in points.
    #[must_use]
    pub fn corner(mut self, points: f64) -> Self {
        self.corner = points;
        self
    }
}

/// A free drawing in local coordinates, `y` upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    area: Rect,
    x: (f64, f64),
    y: (f64, f64),
    items: Vec<Item>,
}

impl Drawing {
    /// A drawing whose local coordinates run over `x` and `y` in the rectangle `area`. Nothing is clipped.
    pub fn new(area: Rect, x: (f64, f64), y: (f64, f64)) -> Self {
        Self { area, x, y, items: Vec::new() }
    }

    /// A drawing with the same scale in both directions: the local range is widened in the direction that has
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

    /// Adds a line along an outline.
    #[must_use]
    pub fn stroke(self, path: Path, stroke: Stroke) -> Self {
        self.shape(path, stroke)
    }

    /// Adds a filled outline.
    #[must_use]
    pub fn fill(self, path: Path, colour: Colour, opacity: f64) -> Self {
        self.shape(path, Fill::new(colour, opacity))
    }

    fn shape(self, path: Path, style: impl Into<Style>) -> Self {
        let outline = self.to_page() * path.outline();
        self.with(Item::Shape(outline, style.into()))
    }

    /// Adds an upright ellipse with half-axes in local units.
    #[must_use]
    pub fn ellipse(self, centre: (f64, f64), radii: (f64, f64), style: impl Into<Style>) -> Self {
        let place = Affine::translate(Vec2::from(centre)).pre_scale_non_uniform(radii.0, radii.1);
        // Four curves, which stay within 0.0003 of the unit circle.
        let circle = Circle::new(Point::ZERO, 1.0).to_path(1e-3);
        let outline = self.to_page() * place * circle;
        self.with(Item::Shape(outline, style.into()))
    }

    /// Adds a text; an [`Anchor`] alone is a style, too.
    #[must_use]
    pub fn text(self, at: (f64, f64), style: impl Into<TextStyle>, label: impl Into<Label>) -> Self {
        let at = self.to_page() * Point::from(at);
        self.with(Item::Text(at, label.into(), style.into()))
    }

    /// Adds a line through points with a head of 5 points at the last one.
    #[must_use]
    pub fn arrow(self, points: impl IntoIterator<Item = (f64, f64)>, stroke: Stroke) -> Self {
        self.arrow_with_head(points, stroke, 5.0)
    }

    /// Adds a line through points with a head of this length in points at the last one.
    #[must_use]
    pub fn arrow_with_head(
        self,
        points: impl IntoIterator<Item = (f64, f64)>,
        stroke: Stroke,
        head: f64,
    ) -> Self {
        let points: Vec<_> = points.into_iter().map(|point| self.to_page() * Point::from(point)).collect();
        let parts = arrow(&points, stroke, head);
        parts.into_iter().fold(self, |drawing, (path, style)| drawing.with(Item::Shape(path, style)))
    }

    /// Adds a line with heads at both ends, for dimensions.
    #[must_use]
    pub fn double_arrow(self, from: (f64, f64), to: (f64, f64), stroke: Stroke) -> Self {
        self.arrow([from, to], stroke).arrow([to, from], stroke)
    }

    /// Adds a box with lines of text, for flow charts.
    #[must_use]
    pub fn text_box(self, text_box: TextBox) -> Self {
        let TextBox { centre, size, corner, lines, style } = text_box;
        let area = kurbo::Rect::from_center_size(centre, Size::from(size));
        let area = self.to_page().transform_rect_bbox(area);
        let outline = area.to_rounded_rect(corner.max(0.0)).to_path(TOLERANCE);
        let middle = area.center();
        self.with(Item::Shape(outline, style)).with(Item::Lines(middle, lines))
    }

    fn with(mut self, item: Item) -> Self {
        self.items.push(item);
        self
    }

    /// The local coordinates of a place on the page, for letters in the corner of a drawing with widened
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
            return Err(DrawError::Size {
                what: "a drawing",
                width: self.area.width,
                height: self.area.height,
            });
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
                Item::Lines(middle, lines) => {
                    let pitch = Vec2::new(0.0, 1.25 * TEXT_SIZE);
                    let first = *middle - 0.5 * (lines.len() as f64 - 1.0) * pitch;
                    for (index, line) in lines.iter().enumerate() {
                        svg.label(line, first + index as f64 * pitch, TextStyle::new(Anchor::Centre))?;
                    }
                }
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
        let words = TextBox::new((5.0, 5.0), (4.0, 2.0), ["words"]).corner(1.5);
        let drawing = Drawing::new(Rect::new(0.0, 0.0, 100.0, 50.0), (0.0, 10.0), (0.0, 10.0))
            .ellipse((5.0, 5.0), (2.0, 1.0), Colour::GREY)
            .text_box(words);
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
