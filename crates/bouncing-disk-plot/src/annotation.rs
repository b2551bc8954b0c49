//! Words and arrows in a panel.

use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::label::Label;
use crate::stroke::{Dash, Stroke};
use crate::svg::{Svg, TextStyle, line_to, move_to};

/// Which point of a text is placed: on its baseline, or (`..Centre`) at half the height of its capitals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Anchor {
    /// The left end of the baseline.
    Left,
    /// The middle of the baseline.
    Middle,
    /// The right end of the baseline.
    Right,
    /// The left end, centred vertically.
    LeftCentre,
    /// The middle, centred vertically.
    Centre,
    /// The right end, centred vertically.
    RightCentre,
}

/// Where something is placed in a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Data(f64, f64),
    /// Fractions of the frame from its lower left corner.
    Axes(f64, f64),
}

impl Place {
    fn on_page(self, frame: &Frame<'_>) -> (f64, f64) {
        match self {
            Self::Data(x, y) => frame.point((x, y)),
            Self::Axes(x, y) => {
                (frame.area.left + x * frame.area.width, frame.area.bottom() - y * frame.area.height)
            }
        }
    }
}

/// A text in a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    place: Place,
    label: Label,
    anchor: Anchor,
    colour: Colour,
    size: Option<f64>,
    rotation: f64,
    halo: Option<Colour>,
}

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
        Self {
            place,
            label,
            anchor: Anchor::LeftCentre,
            colour: Colour::BLACK,
            size: None,
            rotation: 0.0,
            halo: None,
        }
    }

    /// Chooses the point of the text that is placed; the left end, vertically centred, unless set.
    #[must_use]
    pub fn anchor(mut self, anchor: Anchor) -> Self {
        self.anchor = anchor;
        self
    }

    /// Sets the colour.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.colour = colour;
        self
    }

    /// Sets the font size in points.
    #[must_use]
    pub fn size(mut self, points: f64) -> Self {
        self.size = Some(points);
        self
    }

    /// Turns the text anticlockwise.
    #[must_use]
    pub fn rotated(mut self, degrees: f64) -> Self {
        self.rotation = degrees;
        self
    }

    /// Puts a rim around the letters, which keeps them legible on a picture.
    #[must_use]
    pub fn halo(mut self, colour: Colour) -> Self {
        self.halo = Some(colour);
        self
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let place = self.place.on_page(frame);
        if !(place.0.is_finite() && place.1.is_finite()) {
            return Ok(());
        }
        let style = TextStyle {
            size: self.size.unwrap_or(frame.text_size),
            anchor: self.anchor,
            colour: self.colour,
            rotation: self.rotation,
            halo: self.halo,
        };
        svg.label(&self.label, place, style)
    }
}

/// A straight arrow in a panel; its head is at the second point.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    from: Place,
    to: Place,
    stroke: Stroke,
    head: f64,
}

impl Arrow {
    /// An arrow between two points in data coordinates.
    pub fn at_data(from: (f64, f64), to: (f64, f64)) -> Self {
        Self::between(Place::Data(from.0, from.1), Place::Data(to.0, to.1))
    }

    /// An arrow between two points in fractions of the frame from its lower left corner.
    pub fn at_axes(from: (f64, f64), to: (f64, f64)) -> Self {
        Self::between(Place::Axes(from.0, from.1), Place::Axes(to.0, to.1))
    }

    fn between(from: Place, to: Place) -> Self {
        Self { from, to, stroke: Stroke::default(), head: 5.0 }
    }

    /// Sets the colour.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.stroke.colour = colour;
        self
    }

    /// Sets the width of the line in points.
    #[must_use]
    pub fn width(mut self, points: f64) -> Self {
        self.stroke.width = points;
        self
    }

    /// Sets the length of the head in points.
    #[must_use]
    pub fn head(mut self, points: f64) -> Self {
        self.head = points;
        self
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) {
        arrow(svg, &[self.from.on_page(frame), self.to.on_page(frame)], &self.stroke, self.head);
    }
}

/// A polyline on the page with a head at its last point.
pub(crate) fn arrow(svg: &mut Svg, points: &[(f64, f64)], stroke: &Stroke, head: f64) {
    let [.., before, tip] = points else { return };
    let along = (tip.0 - before.0, tip.1 - before.1);
    let length = (along.0 * along.0 + along.1 * along.1).sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return;
    }
    let (along, across) = ((along.0 / length, along.1 / length), (-along.1 / length, along.0 / length));
    let base = (tip.0 - head * along.0, tip.1 - head * along.1);
    // The line ends inside the head, so that its square end does not blunt the tip.
    let mut line = String::new();
    move_to(&mut line, points[0]);
    for point in &points[1..points.len() - 1] {
        line_to(&mut line, *point);
    }
    line_to(&mut line, (tip.0 - 0.7 * head * along.0, tip.1 - 0.7 * head * along.1));
    svg.path(&line, Some(stroke), None);
    let wing = 0.38 * head;
    let mut triangle = String::new();
    move_to(&mut triangle, *tip);
    line_to(&mut triangle, (base.0 + wing * across.0, base.1 + wing * across.1));
    line_to(&mut triangle, (tip.0 - 0.75 * head * along.0, tip.1 - 0.75 * head * along.1));
    line_to(&mut triangle, (base.0 - wing * across.0, base.1 - wing * across.1));
    triangle.push('z');
    let solid = Stroke { dash: Dash::Solid, ..*stroke };
    svg.path(&triangle, None, Some((solid.colour, solid.opacity)));
}
