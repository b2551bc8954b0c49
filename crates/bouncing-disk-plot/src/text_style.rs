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
    pub fn new(anchor: Anchor) -> Self {
        Self { anchor, size: None, colour: Colour::BLACK, rotation: 0.0, halo: None }
    }

    /// Sets the font size in points.
    #[must_use]
    pub fn size(self, points: f64) -> Self {
        Self { size: Some(points), ..self }
    }

    /// Sets the colour.
    #[must_use]
    pub fn colour(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    /// Turns the text anticlockwise.
    #[must_use]
    pub fn rotated(self, degrees: f64) -> Self {
        Self { rotation: degrees, ..self }
    }

    /// Puts a rim around the letters, which keeps them legible on a picture.
    #[must_use]
    pub fn halo(self, colour: Colour) -> Self {
        Self { halo: Some(colour), ..self }
    }
}

impl From<Anchor> for TextStyle {
    fn from(anchor: Anchor) -> Self {
        Self::new(anchor)
    }
}
