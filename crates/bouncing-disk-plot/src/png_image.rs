//! PNG images that are embedded in a figure.

use crate::colour::Colour;
use crate::error::DrawError;

/// An indexed image: one byte per pixel, each a colour with an opacity (0 to 255).
pub(crate) fn indexed(
    width: usize,
    height: usize,
    pixels: &[u8],
    palette: &[(Colour, u8)],
) -> Result<Vec<u8>, DrawError> {
    let failed = |error: png::EncodingError| DrawError::Render { message: error.to_string() };
    let size = |length: usize| {
        u32::try_from(length).map_err(|_| DrawError::Size {
            what: "an embedded image",
            width: width as f64,
            height: height as f64,
        })
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size(width)?, size(height)?);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder.set_palette(palette.iter().flat_map(|(c, _)| [c.red, c.green, c.blue]).collect::<Vec<_>>());
    if palette.iter().any(|(_, opacity)| *opacity < 255) {
        encoder.set_trns(palette.iter().map(|(_, opacity)| *opacity).collect::<Vec<_>>());
    }
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(pixels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}
