//! A figure: panels and drawings on a page, as SVG and, rendered by resvg, as PNG.

use resvg::{tiny_skia, usvg};

use crate::builders::builders;
use crate::drawing::Drawing;
use crate::encode;
use crate::error::DrawError;
use crate::font;
use crate::panel::Panel;
use crate::svg::Svg;

/// The width of one column of the journal, 8.6 cm, in points.
pub const SINGLE_COLUMN: f64 = 246.0;
/// The width of both columns, 17.8 cm, in points.
pub const DOUBLE_COLUMN: f64 = 510.0;

/// The largest side of a figure in points; the picture of a larger one would not fit in memory.
pub(crate) const LARGEST_SIDE: f64 = 4000.0;

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

builders!(Figure {
    /// Adds a panel; later parts cover earlier ones, so an inset follows its panel.
    panel(panel: Panel) |own| own.parts.push(Part::Panel(Box::new(panel)));
    /// Adds several panels.
    panels(panels: impl IntoIterator<Item = Panel>) |own|
        own.parts.extend(panels.into_iter().map(|panel| Part::Panel(Box::new(panel))));
    /// Adds a free drawing.
    drawing(drawing: Drawing) |own| own.parts.push(Part::Drawing(drawing));
});

impl Figure {
    /// An empty page.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, parts: Vec::new() }
    }

    /// The figure as SVG; equal figures have equal texts.
    ///
    /// # Errors
    ///
    /// If a label, an axis, a size or a layer is malformed.
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
    /// The errors of [`Figure::to_svg`], and [`DrawError::Render`] if rendering fails.
    pub fn to_png(&self) -> Result<Vec<u8>, DrawError> {
        rendered(&self.to_svg()?, f32::MAX)
    }

    /// The picture of [`Figure::to_png`], made smaller if it would be wider than `pixels`.
    ///
    /// # Errors
    ///
    /// As [`Figure::to_png`].
    pub fn to_png_within(&self, pixels: u16) -> Result<Vec<u8>, DrawError> {
        rendered(&self.to_svg()?, f32::from(pixels))
    }
}

/// Pixels of a PNG per point.
const SCALE: f32 = 4.0;

/// The picture of an SVG text with the bundled fonts only, at most `most_pixels` wide.
fn rendered(svg: &str, most_pixels: f32) -> Result<Vec<u8>, DrawError> {
    let options = usvg::Options {
        font_family: font::FAMILY.to_owned(),
        fontdb: font::database(),
        // One user unit is one point.
        dpi: 72.0,
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options)
        .map_err(|error| DrawError::Render { message: error.to_string() })?;
    let size = tree.size();
    let scale = SCALE.min(most_pixels / size.width());
    let (width, height) = (size.width() * scale, size.height() * scale);
    let pixels = tiny_skia::Pixmap::new(width.ceil() as u32, height.ceil() as u32);
    let mut pixels = pixels.ok_or(DrawError::Size {
        what: "the picture",
        width: f64::from(width),
        height: f64::from(height),
    })?;
    // The last row and column may lie partly outside of the page.
    pixels.fill(tiny_skia::Color::WHITE);
    resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
    let colours = pixels.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]);
    let colours: Vec<u8> = colours.collect();
    encode::png([pixels.width() as usize, pixels.height() as usize], &colours, |encoder| {
        encoder.set_color(png::ColorType::Rgb);
    })
}
