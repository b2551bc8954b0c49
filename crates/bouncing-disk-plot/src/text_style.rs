//! How words are set.

use crate::colour::Colour;

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

/// How a label is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TextStyle {
    pub(crate) anchor: Anchor,
    /// The font size in points; that of the figure unless set.
    pub(crate) size: Option<f64>,
    pub(crate) colour: Colour,
    /// Degrees, anticlockwise.
    pub(crate) rotation: f64,
    /// A rim around the letters that keeps them legible on a picture.
    pub(crate) halo: Option<Colour>,
}

impl TextStyle {
    /// Black, level, in the size of the figure.
    pub(crate) fn new(anchor: Anchor) -> Self {
        Self { anchor, size: None, colour: Colour::BLACK, rotation: 0.0, halo: None }
    }

    pub(crate) fn size(self, points: f64) -> Self {
        Self { size: Some(points), ..self }
    }

    pub(crate) fn colour(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    pub(crate) fn rotated(self, degrees: f64) -> Self {
        Self { rotation: degrees, ..self }
    }

    pub(crate) fn halo(self, colour: Colour) -> Self {
        Self { halo: Some(colour), ..self }
    }
}
