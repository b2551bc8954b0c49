//! Very many points: painted into one embedded image, so that the figure stays small.

use tiny_skia::{Color, FillRule, Paint, PathBuilder, Pixmap, Transform};

use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::label::Label;
use crate::style::{Fill, Style};
use crate::svg::Svg;

/// Pixels of the embedded image per point of the page; about 290 per inch.
const RESOLUTION: f64 = 4.0;

/// Points drawn as small discs into one image.
#[derive(Clone, Debug, PartialEq)]
pub struct DensePoints {
    points: Vec<(f64, f64)>,
    radius: f64,
    pub(crate) style: Style,
    pub(crate) name: Option<Label>,
}

builders!(DensePoints: style, colour, opacity, name);

builders!(DensePoints {
    /// Sets the radius of a disc in points of the page.
    radius(points: f64) |own| own.radius = points;
});

impl DensePoints {
    /// Points in data coordinates. Where discs that are not opaque overlap, the colour grows darker.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { points: points.into_iter().collect(), radius: 0.3, style: Colour::BLACK.into(), name: None }
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let area = frame.area;
        let (width, height) = ((area.width * RESOLUTION).ceil(), (area.height * RESOLUTION).ceil());
        // The image covers the frame exactly, so pixels may differ from squares by less than one part in a
        // hundred.
        let (across, down) = (width / area.width, height / area.height);
        let places = self.points.iter().map(|point| frame.point(*point));
        let places = places.map(|place| ((place.x - area.left) * across, (place.y - area.top) * down));
        let Fill { colour, opacity } = self.style.solid();
        let pixels = paint(width as u32, height as u32, places, self.radius * RESOLUTION, opacity)?;
        let palette: Vec<_> = (0..=255).map(|opacity| (colour, opacity)).collect();
        svg.image(area.outline(), [width as usize, height as usize], &pixels, &palette, false)
    }
}

/// How much discs cover each pixel of an image, from 0 to 255. Lengths are pixels.
fn paint(
    width: u32,
    height: u32,
    centres: impl Iterator<Item = (f64, f64)>,
    radius: f64,
    opacity: f64,
) -> Result<Vec<u8>, DrawError> {
    let mut image = Pixmap::new(width, height).ok_or(DrawError::Size {
        what: "an embedded image",
        width: f64::from(width),
        height: f64::from(height),
    })?;
    // A disc smaller than a pixel is drawn as a pixel-wide one of proportionally lower opacity.
    let (radius, opacity) =
        if radius < 0.5 { (0.5, opacity * 4.0 * radius * radius) } else { (radius, opacity) };
    let Some(disc) = PathBuilder::from_circle(0.0, 0.0, radius as f32) else {
        return Ok(vec![0; image.pixels().len()]);
    };
    let mut paint = Paint::default();
    paint.set_color(Color::from_rgba(0.0, 0.0, 0.0, opacity.clamp(0.0, 1.0) as f32).unwrap_or(Color::BLACK));
    let (columns, rows) = (-radius..f64::from(width) + radius, -radius..f64::from(height) + radius);
    for (x, y) in centres.filter(|(x, y)| columns.contains(x) && rows.contains(y)) {
        let place = Transform::from_translate(x as f32, y as f32);
        image.fill_path(&disc, &paint, FillRule::Winding, place, None);
    }
    Ok(image.pixels().iter().map(|pixel| pixel.alpha()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_covers_its_area() {
        for (radius, opacity) in [(6.0, 1.0), (6.0, 0.5), (0.25, 1.0)] {
            let levels = paint(40, 40, [(20.3, 19.6)].into_iter(), radius, opacity).expect("an image");
            let area: f64 = levels.iter().map(|level| f64::from(*level) / 255.0).sum();
            let expected = std::f64::consts::PI * radius * radius * opacity;
            assert!((area / expected - 1.0).abs() < 0.05, "{area} {expected}");
        }
    }

    #[test]
    fn points_outside_and_nan_are_ignored() {
        let points = [(f64::NAN, 1.0), (-5.0, 1.0), (1.0, 1e300), (f64::INFINITY, 2.0)];
        let levels = paint(4, 4, points.into_iter(), 1.0, 1.0).expect("an image");
        assert!(levels.iter().all(|level| *level == 0));
    }
}
