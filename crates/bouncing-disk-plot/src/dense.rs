//! Very many points: painted into one embedded image, so that the figure stays small.

use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::figure::LARGEST_SIDE;
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
    /// Points in data coordinates. Overlapping translucent discs darken the colour.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { points: points.into_iter().collect(), radius: 0.3, style: Colour::BLACK.into(), name: None }
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let area = frame.area;
        if area.width.max(area.height) > LARGEST_SIDE {
            return Err(DrawError::Size { what: "a panel", width: area.width, height: area.height });
        }
        let [width, height] = [area.width, area.height].map(|length| (length * RESOLUTION).ceil() as usize);
        // The image covers the frame exactly, so pixels may differ from squares by less than one part in a
        // hundred.
        let (across, down) = (width as f64 / area.width, height as f64 / area.height);
        let places = self.points.iter().map(|point| frame.point(*point));
        let places = places.map(|place| ((place.x - area.left) * across, (place.y - area.top) * down));
        let Fill { colour, opacity } = self.style.solid();
        let pixels = paint(width, height, places, self.radius * RESOLUTION, opacity);
        let palette: Vec<_> = (0..=255).map(|opacity| (colour, opacity)).collect();
        svg.image(area.outline(), [width, height], &pixels, &palette, false)
    }
}

/// Rows per pixel on which the chord of a disc is measured.
const ROWS: usize = 4;

/// The share of each pixel of an image that discs cover, from 0 to 255. Lengths are in pixels.
fn paint(
    width: usize,
    height: usize,
    centres: impl Iterator<Item = (f64, f64)>,
    radius: f64,
    opacity: f64,
) -> Vec<u8> {
    // A disc smaller than a pixel is drawn as a pixel-wide one of proportionally lower opacity.
    let (radius, opacity) =
        if radius < 0.5 { (0.5, opacity * 4.0 * radius * radius) } else { (radius, opacity) };
    let opacity = opacity.clamp(0.0, 1.0);
    let (columns, rows) = (-radius..width as f64 + radius, -radius..height as f64 + radius);
    // What shines through all discs.
    let mut light = vec![1.0_f32; width * height];
    for (x, y) in centres.filter(|(x, y)| columns.contains(x) && rows.contains(y)) {
        // A number below 0 becomes 0.
        let reached = |centre: f64, count: usize| {
            (centre - radius) as usize..count.min((centre + radius).ceil() as usize)
        };
        for row in reached(y, height) {
            let half_chords: [f64; ROWS] = std::array::from_fn(|part| {
                let below = row as f64 + (part as f64 + 0.5) / ROWS as f64 - y;
                (radius * radius - below * below).max(0.0).sqrt()
            });
            for column in reached(x, width) {
                let left = column as f64 - x;
                let inside = |half: &f64| (half.min(left + 1.0) - left.max(-half)).max(0.0);
                let share = half_chords.iter().map(inside).sum::<f64>() / ROWS as f64;
                light[row * width + column] *= (1.0 - opacity * share) as f32;
            }
        }
    }
    light.iter().map(|light| (255.0 * (1.0 - light)).round() as u8).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_covers_its_area() {
        for (radius, opacity) in [(6.0, 1.0), (6.0, 0.5), (1.2, 1.0), (0.25, 1.0)] {
            let levels = paint(40, 40, [(20.3, 19.6)].into_iter(), radius, opacity);
            let area: f64 = levels.iter().map(|level| f64::from(*level) / 255.0).sum();
            let expected = std::f64::consts::PI * radius * radius * opacity;
            assert!((area / expected - 1.0).abs() < 0.05, "{area} {expected}");
        }
    }

    #[test]
    fn points_outside_and_nan_are_ignored() {
        let points = [(f64::NAN, 1.0), (-5.0, 1.0), (1.0, 1e300), (f64::INFINITY, 2.0)];
        let levels = paint(4, 4, points.into_iter(), 1.0, 1.0);
        assert!(levels.iter().all(|level| *level == 0));
    }
}
