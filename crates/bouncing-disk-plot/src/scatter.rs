//! Points with markers and error bars.

use kurbo::{Affine, BezPath, Circle, Point, Shape, Vec2};

use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::label::Label;
use crate::path::{polygon, polyline};
use crate::style::{Stroke, Style};
use crate::svg::{Svg, TOLERANCE};

/// The width of error bars and half the length of the caps at their ends, in points.
const BAR_WIDTH: f64 = 0.6;
const HALF_CAP: f64 = 1.5;

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Marker {
    /// A filled circle.
    Dot,
    /// An open circle.
    Circle,
    /// An oblique cross.
    Cross,
    /// An open square.
    Square,
    /// An open diamond.
    Diamond,
}

/// Points, all with one marker.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    points: Vec<(f64, f64)>,
    marker: Marker,
    size: f64,
    style: Style,
    errors_x: Option<Vec<f64>>,
    errors_y: Option<Vec<f64>>,
    pub(crate) name: Option<Label>,
}

builders!(Scatter: style, colour, width, name);

builders!(Scatter {
    /// Sets the shape.
    marker(marker: Marker) |own| own.marker = marker;
    /// Sets the extent in points.
    size(points: f64) |own| own.size = points;
    /// Fills open markers with white, so that curves end at them.
    filled_white() |own| own.style = own.style.fill(Colour::WHITE);
    /// Adds horizontal error bars: one half-length per point, in data units.
    errors_x(errors: impl IntoIterator<Item = f64>) |own| own.errors_x = Some(errors.into_iter().collect());
    /// Adds vertical error bars: one half-length per point, in data units.
    errors_y(errors: impl IntoIterator<Item = f64>) |own| own.errors_y = Some(errors.into_iter().collect());
});

impl Scatter {
    /// Points in data coordinates; points outside the panel are not shown.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self {
            points: points.into_iter().collect(),
            marker: Marker::Dot,
            size: 4.0,
            style: Stroke::default().into(),
            errors_x: None,
            errors_y: None,
            name: None,
        }
    }

    /// Draws the markers at points of the page.
    pub(crate) fn draw_markers(&self, svg: &mut Svg, points: impl IntoIterator<Item = Point>) {
        match self.marker.outline(0.5 * self.size) {
            None => svg.dots(points, self.size, self.style.solid()),
            Some(outline) => {
                let copies = points.into_iter().map(|point| Affine::translate(point.to_vec2()) * &outline);
                svg.path(&copies.flatten().collect(), &self.style);
            }
        }
    }

    /// Error bars; they are clipped by the frame.
    pub(crate) fn render_bars(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let mut path = BezPath::new();
        let sides = [
            ("horizontal errors", &self.errors_x, Vec2::new(1.0, 0.0), Vec2::new(0.0, HALF_CAP)),
            ("vertical errors", &self.errors_y, Vec2::new(0.0, 1.0), Vec2::new(HALF_CAP, 0.0)),
        ];
        for (what, errors, along, cap) in sides {
            let Some(errors) = errors else { continue };
            if errors.len() != self.points.len() {
                return Err(DrawError::Length { what, given: errors.len(), needed: self.points.len() });
            }
            for (&point, &error) in self.points.iter().zip(errors) {
                let ends = [-error, error]
                    .map(|error| Point::from(point) + error * along)
                    .map(|end| frame.point(end.into()));
                if !ends.iter().all(|end| end.is_finite()) || error <= 0.0 {
                    continue;
                }
                path.extend(polyline(ends));
                path.extend(ends.iter().flat_map(|end| polyline([*end - cap, *end + cap])));
            }
        }
        let stroke = Stroke { width: BAR_WIDTH, ..self.style.stroke.unwrap_or_default() };
        svg.path(&path, &stroke.into());
        Ok(())
    }

    /// Markers; one on the edge of the frame is drawn whole.
    pub(crate) fn render_markers(&self, frame: &Frame<'_>, svg: &mut Svg) {
        let points = self.points.iter().map(|point| frame.point(*point));
        self.draw_markers(svg, points.filter(|point| frame.contains(*point)));
    }
}

impl Marker {
    /// The outline about the origin; a dot has none.
    fn outline(self, radius: f64) -> Option<BezPath> {
        let corners = |corners: &[(f64, f64)]| polygon(corners.iter().copied().map(Point::from));
        let unit = match self {
            Self::Dot => return None,
            Self::Circle => return Some(Circle::new(Point::ZERO, radius).to_path(TOLERANCE)),
            Self::Cross => {
                let reach = Vec2::new(0.85, 0.85);
                let bars = [reach, reach.turn_90()].map(|end| polyline([-end, end].map(Vec2::to_point)));
                bars.into_iter().flatten().collect()
            }
            Self::Square => corners(&[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)]),
            Self::Diamond => corners(&[(0.0, -1.15), (1.0, 0.0), (0.0, 1.15), (-1.0, 0.0)]),
        };
        Some(Affine::scale(radius) * unit)
    }
}
