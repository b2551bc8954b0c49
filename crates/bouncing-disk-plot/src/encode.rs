//! Pixels as PNG.

use crate::error::DrawError;

/// An image of eight bits per sample; `settings` choose its colours and its compression.
pub(crate) fn png<'a>(
    [width, height]: [usize; 2],
    pixels: &[u8],
    settings: impl FnOnce(&mut png::Encoder<'a, &mut Vec<u8>>),
) -> Result<Vec<u8>, DrawError> {
    let failed = |error: png::EncodingError| DrawError::Render { message: error.to_string() };
    let (Ok(columns), Ok(rows)) = (u32::try_from(width), u32::try_from(height)) else {
        return Err(DrawError::Size { what: "an image", width: width as f64, height: height as f64 });
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, columns, rows);
    encoder.set_depth(png::BitDepth::Eight);
    settings(&mut encoder);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(pixels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}
