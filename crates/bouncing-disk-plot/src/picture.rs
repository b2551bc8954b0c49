//! Renders SVG to PNG with the bundled fonts only.

use resvg::{tiny_skia, usvg};

use crate::error::DrawError;
use crate::font;

/// Pixels per point.
const SCALE: f32 = 4.0;

/// The picture of an SVG text, as wide as `most_pixels` at most.
pub(crate) fn png(svg: &str, most_pixels: f32) -> Result<Vec<u8>, DrawError> {
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
    resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| DrawError::Render { message: error.to_string() })
}
