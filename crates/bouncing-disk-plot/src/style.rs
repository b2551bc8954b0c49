//! How shapes are drawn: one type for the lines and the areas of every layer.

use crate::colour::Colour;

/// The dashes of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dash {
    /// Unbroken.
    #[default]
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Dashes and dots in turn.
    DashDotted,
}

impl Dash {
    /// Lengths of strokes and gaps in points.
    pub(crate) fn pattern(self) -> Option<&'static str> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some("5 3"),
            Self::Dotted => Some("1 2"),
            Self::DashDotted => Some("6 2 1 2"),
        }
    }
}

/// Colour, width in points, dashes and opacity of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The colour.
    pub colour: Colour,
    /// The width in points.
    pub width: f64,
    /// The dashes.
    pub dash: Dash,
    /// From 0, invisible, to 1.
    pub opacity: f64,
}

impl Default for Stroke {
    fn default() -> Self {
        Self { colour: Colour::BLACK, width: 0.8, dash: Dash::Solid, opacity: 1.0 }
    }
}

impl Stroke {
    /// A solid line.
    pub fn new(colour: Colour, width: f64) -> Self {
        Self { colour, width, ..Self::default() }
    }

    /// With dashes.
    #[must_use]
    pub fn dashed(mut self, dash: Dash) -> Self {
        self.dash = dash;
        self
    }

    /// An area like the line, for the heads of arrows and for dots.
    pub(crate) fn solid(&self) -> Fill {
        Fill::new(self.colour, self.opacity)
    }
}

/// Colour and opacity of an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fill {
    /// The colour.
    pub colour: Colour,
    /// From 0, invisible, to 1.
    pub opacity: f64,
}

impl Fill {
    /// An area of one colour with an opacity from 0, invisible, to 1.
    pub fn new(colour: Colour, opacity: f64) -> Self {
        Self { colour, opacity }
    }
}

impl From<Colour> for Fill {
    fn from(colour: Colour) -> Self {
        Self::new(colour, 1.0)
    }
}

/// How a shape is drawn: its outline and its area, either of which may be missing.
///
/// ```
/// use bouncing_disk_plot::{Colour, Dash, Style};
///
/// let dashed = Style::default().width(1.2).dash(Dash::Dashed).colour(Colour::BLUE);
/// assert!(dashed.fill.is_none());
/// let pale = Style::from(Colour::PALE_GREY).opacity(0.5);
/// assert!(pale.stroke.is_none());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Style {
    /// The line along the outline, if there is one.
    pub stroke: Option<Stroke>,
    /// The area, if it is filled.
    pub fill: Option<Fill>,
}

impl Style {
    /// Sets the colour of the line, or of the area where there is no line.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        match (&mut self.stroke, &mut self.fill) {
            (None, Some(fill)) => fill.colour = colour,
            (stroke, _) => stroke.get_or_insert_default().colour = colour,
        }
        self
    }

    /// Sets the opacity, 0 to 1, of the line, or of the area where there is no line.
    #[must_use]
    pub fn opacity(mut self, opacity: f64) -> Self {
        match (&mut self.stroke, &mut self.fill) {
            (None, Some(fill)) => fill.opacity = opacity,
            (stroke, _) => stroke.get_or_insert_default().opacity = opacity,
        }
        self
    }

    /// Sets the width of the line in points; there is a line from then on.
    #[must_use]
    pub fn width(mut self, points: f64) -> Self {
        self.stroke.get_or_insert_default().width = points;
        self
    }

    /// Sets the dashes of the line; there is a line from then on.
    #[must_use]
    pub fn dash(mut self, dash: Dash) -> Self {
        self.stroke.get_or_insert_default().dash = dash;
        self
    }

    /// Sets the whole line.
    #[must_use]
    pub fn stroke(mut self, stroke: Stroke) -> Self {
        self.stroke = Some(stroke);
        self
    }

    /// Fills the area.
    #[must_use]
    pub fn fill(mut self, fill: impl Into<Fill>) -> Self {
        self.fill = Some(fill.into());
        self
    }

    /// The area with the set [`colour`](Self::colour) and [`opacity`](Self::opacity).
    pub(crate) fn solid(&self) -> Fill {
        match (self.stroke, self.fill) {
            (None, Some(fill)) => fill,
            (stroke, _) => stroke.unwrap_or_default().solid(),
        }
    }
}

impl From<Stroke> for Style {
    fn from(stroke: Stroke) -> Self {
        Self { stroke: Some(stroke), fill: None }
    }
}

impl From<Fill> for Style {
    fn from(fill: Fill) -> Self {
        Self { stroke: None, fill: Some(fill) }
    }
}

impl From<Colour> for Style {
    fn from(colour: Colour) -> Self {
        Fill::from(colour).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_and_opacity_go_to_the_line_first() {
        let both = Style::from(Stroke::default()).fill(Colour::GREY).colour(Colour::BLUE).opacity(0.5);
        assert_eq!(both.stroke.map(|stroke| (stroke.colour, stroke.opacity)), Some((Colour::BLUE, 0.5)));
        assert_eq!(both.fill, Some(Fill::new(Colour::GREY, 1.0)));
        let area = Style { stroke: None, ..both }.colour(Colour::SKY).opacity(0.25);
        assert_eq!(area, Style::from(Fill::new(Colour::SKY, 0.25)));
        assert_eq!(Style::default().colour(Colour::SKY), Style::from(Stroke::new(Colour::SKY, 0.8)));
    }
}
