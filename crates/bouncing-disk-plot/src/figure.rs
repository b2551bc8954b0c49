//! A figure: panels and drawings on a page.

use crate::drawing::Drawing;
use crate::error::DrawError;
use crate::panel::Panel;
use crate::picture;
use crate::svg::Svg;

/// The width of one column of the journal, 8.6 cm, in points.
pub const SINGLE_COLUMN: f64 = 246.0;
/// The width of both columns, 17.8 cm, in points.
pub const DOUBLE_COLUMN: f64 = 510.0;

/// The largest side of a figure in points; beyond, its picture would not fit in memory.
const LARGEST_SIDE: f64 = 4000.0;

/// Panels and drawings on a white page, in points.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    width: f64,
    height: f64,
    parts: Vec<Part>,
}

#[derive(Clone, Debug, PartialEq)]
enum Part {
    Panel(Box<Panel>),
    Drawing(Drawing),
}

impl Figure {
    /// An empty page.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, parts: Vec::new() }
    }

    /// Adds a panel; later parts cover earlier ones, so an inset follows its panel.
    #[must_use]
    pub fn panel(mut self, panel: Panel) -> Self {
        self.parts.push(Part::Panel(Box::new(panel)));
        self
    }

    /// Adds several panels.
    #[must_use]
    pub fn panels(self, panels: impl IntoIterator<Item = Panel>) -> Self {
        panels.into_iter().fold(self, Self::panel)
    }

    /// Adds a free drawing.
    #[must_use]
    pub fn drawing(mut self, drawing: Drawing) -> Self {
        self.parts.push(Part::Drawing(drawing));
        self
    }

    /// The figure as SVG: the same text whenever the figure is the same.
    ///
    /// # Errors
    ///
    /// When a label, an axis, a size or a layer is malformed.
    pub fn to_svg(&self) -> Result<String, DrawError> {
        let sizes = [self.width, self.height];
        if !sizes.iter().all(|size| (1.0..=LARGEST_SIDE).contains(size)) {
            return Err(DrawError::Size { what: "the figure", width: self.width, height: self.height });
        }
        let mut svg = Svg::new(self.width, self.height);
        for part in &self.parts {
            match part {
                Part::Panel(panel) => panel.render(&mut svg)?,
                Part::Drawing(drawing) => drawing.render(&mut svg)?,
            }
        }
        Ok(svg.finish())
    }

    /// The figure as PNG, 288 pixels per inch, with the bundled fonts.
    ///
    /// # Errors
    ///
    /// As [`Figure::to_svg`], and when rendering fails.
    pub fn to_png(&self) -> Result<Vec<u8>, DrawError> {
        picture::png(&self.to_svg()?, f32::MAX)
    }

    /// As [`Figure::to_png`], made smaller where it would be wider than so many pixels.
    ///
    /// # Errors
    ///
    /// As [`Figure::to_png`].
    pub fn to_png_within(&self, pixels: u16) -> Result<Vec<u8>, DrawError> {
        picture::png(&self.to_svg()?, f32::from(pixels))
    }
}
