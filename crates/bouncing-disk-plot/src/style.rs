//! How shapes are drawn, with one type for the lines and the areas of every layer, and how words are set.

use crate::builders::builders;
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
    /// The opacity, from 0, invisible, to 1.
    pub opacity: f64,
}

impl Default for Stroke {
    fn default() -> Self {
        Self { colour: Colour::BLACK, width: 0.8, dash: Dash::Solid, opacity: 1.0 }
    }
}

builders!(Stroke {
    /// The stroke with dashes.
    dashed(dash: Dash) |own| own.dash = dash;
});

impl Stroke {
    /// A solid line.
    pub fn new(colour: Colour, width: f64) -> Self {
        Self { colour, width, ..Self::default() }
    }

    /// An area in the colour and opacity of the line, for the heads of arrows and for dots.
    pub(crate) fn solid(&self) -> Fill {
        Fill::new(self.colour, self.opacity)
    }
}

/// Colour and opacity of an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fill {
    /// The colour.
    pub colour: Colour,
    /// The opacity, from 0, invisible, to 1.
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

builders!(Style {
    /// Sets the colour of the line, or of the area if there is no line.
    colour(colour: Colour) |own| match own {
        Self { stroke: None, fill: Some(fill) } => fill.colour = colour,
        Self { stroke, .. } => stroke.get_or_insert_default().colour = colour,
    };
    /// Sets the opacity, 0 to 1, of the line, or of the area if there is no line.
    opacity(opacity: f64) |own| match own {
        Self { stroke: None, fill: Some(fill) } => fill.opacity = opacity,
        Self { stroke, .. } => stroke.get_or_insert_default().opacity = opacity,
    };
    /// Sets the width of the line in points and adds a line if there is none.
    width(points: f64) |own| own.stroke.get_or_insert_default().width = points;
    /// Sets the dashes of the line and adds a line if there is none.
    dash(dash: Dash) |own| own.stroke.get_or_insert_default().dash = dash;
    /// Sets the whole line.
    stroke(stroke: Stroke) |own| own.stroke = Some(stroke);
    /// Fills the area.
    fill(fill: impl Into<Fill>) |own| own.fill = Some(fill.into());
});

impl Style {
    /// The colour and opacity that [`colour`](Self::colour) and [`opacity`](Self::opacity) set, as an area.
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

/// How a text is set.
///
/// ```
/// use bouncing_disk_plot::{Anchor, Colour, TextStyle};
///
/// let small = TextStyle::new(Anchor::LeftCentre).size(8.0).colour(Colour::DARK_GREY);
/// assert_eq!(TextStyle::from(Anchor::LeftCentre), TextStyle::new(Anchor::LeftCentre));
/// assert_ne!(small, Anchor::LeftCentre.into());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    pub(crate) anchor: Anchor,
    /// The font size in points; by default the figure's.
    pub(crate) size: Option<f64>,
    pub(crate) colour: Colour,
    /// Degrees, anticlockwise.
    pub(crate) rotation: f64,
    /// A rim around the letters that keeps them legible on a picture.
    pub(crate) halo: Option<Colour>,
}

builders!(TextStyle {
    /// Sets the font size in points.
    size(points: f64) |own| own.size = Some(points);
    /// Sets the colour.
    colour(colour: Colour) |own| own.colour = colour;
    /// Turns the text anticlockwise.
    rotated(degrees: f64) |own| own.rotation = degrees;
    /// Puts a rim around the letters, which keeps them legible on a picture.
    halo(colour: Colour) |own| own.halo = Some(colour);
});

impl TextStyle {
    /// Black, level, in the size of the figure.
    pub fn new(anchor: Anchor) -> Self {
        Self { anchor, size: None, colour: Colour::BLACK, rotation: 0.0, halo: None }
    }
}

impl From<Anchor> for TextStyle {
    fn from(anchor: Anchor) -> Self {
        Self::new(anchor)
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
