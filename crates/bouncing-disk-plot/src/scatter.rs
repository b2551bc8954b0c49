//! Points with markers and error bars.

use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::label::Label;
use crate::stroke::Stroke;
use crate::svg::{Svg, circle_path, line_to, move_to};

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Marker {
    /// A filled circle.
    Dot,
    /// An open circle.
    Circle,
    /// An oblique cross.
    Cross,
    /// An upright cross.
    Plus,
    /// An open square.
    Square,
    /// An open triangle.
    Triangle,
    /// An open diamond.
    Diamond,
}

/// Points, all with one marker.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    points: Vec<(f64, f64)>,
    marker: Marker,
    size: f64,
    colour: Colour,
    width: f64,
    filled: bool,
    errors_x: Option<Vec<f64>>,
    errors_y: Option<Vec<f64>>,
    name: Option<Label>,
}

impl Scatter {
    /// Points in data coordinates; points outside the panel are not shown.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self {
            points: points.into_iter().collect(),
            marker: Marker::Dot,
            size: 4.0,
            colour: Colour::BLACK,
            width: 0.8,
            filled: false,
            errors_x: None,
            errors_y: None,
            name: None,
        }
    }

    /// Sets the shape.
    #[must_use]
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = marker;
        self
    }

    /// Sets the extent in points.
    #[must_use]
    pub fn size(mut self, points: f64) -> Self {
        self.size = points;
        self
    }

    /// Sets the colour.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.colour = colour;
        self
    }

    /// Sets the width of lines in points.
    #[must_use]
    pub fn width(mut self, points: f64) -> Self {
        self.width = points;
        self
    }

    /// Fills open markers with white, so that curves end at them.
    #[must_use]
    pub fn filled_white(mut self) -> Self {
        self.filled = true;
        self
    }

    /// Adds horizontal error bars: one half-length per point, in data units.
    #[must_use]
    pub fn errors_x(mut self, errors: impl IntoIterator<Item = f64>) -> Self {
        self.errors_x = Some(errors.into_iter().collect());
        self
    }

    /// Adds vertical error bars: one half-length per point, in data units.
    #[must_use]
    pub fn errors_y(mut self, errors: impl IntoIterator<Item = f64>) -> Self {
        self.errors_y = Some(errors.into_iter().collect());
        self
    }

    /// Lists the points in the legend.
    #[must_use]
    pub fn name(mut self, name: impl Into<Label>) -> Self {
        self.name = Some(name.into());
        self
    }

    pub(crate) fn legend_name(&self) -> Option<&Label> {
        self.name.as_ref()
    }

    /// Draws the markers at points of the page.
    pub(crate) fn draw_markers(&self, svg: &mut Svg, points: &[(f64, f64)]) {
        let mut path = String::new();
        for point in points {
            outline(&mut path, self.marker, *point, 0.5 * self.size);
        }
        let stroke = Stroke::new(self.colour, self.width);
        match self.marker {
            Marker::Dot => svg.path(&path, None, Some((self.colour, 1.0))),
            _ if self.filled => svg.path(&path, Some(&stroke), Some((Colour::WHITE, 1.0))),
            _ => svg.path(&path, Some(&stroke), None),
        }
    }

    /// Error bars; they are clipped by the frame.
    pub(crate) fn render_bars(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let mut path = String::new();
        let sides = [("horizontal errors", &self.errors_x, true), ("vertical errors", &self.errors_y, false)];
        for (what, errors, horizontal) in sides {
            let Some(errors) = errors else { continue };
            if errors.len() != self.points.len() {
                return Err(DrawError::Length { what, given: errors.len(), points: self.points.len() });
            }
            for (&(x, y), &error) in self.points.iter().zip(errors) {
                let (low, high) = if horizontal {
                    (frame.point((x - error, y)), frame.point((x + error, y)))
                } else {
                    (frame.point((x, y - error)), frame.point((x, y + error)))
                };
                let finite = [low.0, low.1, high.0, high.1].iter().all(|value| value.is_finite());
                if !finite || error <= 0.0 {
                    continue;
                }
                let cap = if horizontal { (0.0, 1.5) } else { (1.5, 0.0) };
                move_to(&mut path, low);
                line_to(&mut path, high);
                for end in [low, high] {
                    move_to(&mut path, (end.0 - cap.0, end.1 - cap.1));
                    line_to(&mut path, (end.0 + cap.0, end.1 + cap.1));
                }
            }
        }
        svg.path(&path, Some(&Stroke::new(self.colour, 0.6)), None);
        Ok(())
    }

    /// Markers; one on the edge of the frame is drawn whole.
    pub(crate) fn render_markers(&self, frame: &Frame<'_>, svg: &mut Svg) {
        let points = self.points.iter().map(|point| frame.point(*point));
        let inside: Vec<_> = points.filter(|point| frame.contains(*point)).collect();
        self.draw_markers(svg, &inside);
    }
}

fn outline(path: &mut String, marker: Marker, (x, y): (f64, f64), radius: f64) {
    let corners = |path: &mut String, corners: &[(f64, f64)]| {
        for (index, (across, down)) in corners.iter().enumerate() {
            let corner = (x + radius * across, y + radius * down);
            if index == 0 { move_to(path, corner) } else { line_to(path, corner) }
        }
        path.push('z');
    };
    match marker {
        Marker::Dot | Marker::Circle => circle_path(path, (x, y), radius),
        Marker::Cross => {
            let reach = 0.85 * radius;
            move_to(path, (x - reach, y - reach));
            line_to(path, (x + reach, y + reach));
            move_to(path, (x - reach, y + reach));
            line_to(path, (x + reach, y - reach));
        }
        Marker::Plus => {
            move_to(path, (x - radius, y));
            line_to(path, (x + radius, y));
            move_to(path, (x, y - radius));
            line_to(path, (x, y + radius));
        }
        Marker::Square => corners(path, &[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)]),
        Marker::Triangle => corners(path, &[(0.0, -1.1), (0.95, 0.6), (-0.95, 0.6)]),
        Marker::Diamond => corners(path, &[(0.0, -1.15), (1.0, 0.0), (0.0, 1.15), (-1.0, 0.0)]),
    }
}
