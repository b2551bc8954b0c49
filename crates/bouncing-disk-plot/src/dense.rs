//! Very many points: painted into one embedded image, so that the figure stays small.

use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::label::Label;
use crate::png_image;
use crate::svg::Svg;

/// Pixels of the embedded image per point of the page; about 290 per inch.
const RESOLUTION: f64 = 4.0;

/// Points drawn as small discs into one image.
#[derive(Clone, Debug, PartialEq)]
pub struct DensePoints {
    points: Vec<(f64, f64)>,
    colour: Colour,
    radius: f64,
    opacity: f64,
    name: Option<Label>,
}

impl DensePoints {
    /// Points in data coordinates.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self {
            points: points.into_iter().collect(),
            colour: Colour::BLACK,
            radius: 0.3,
            opacity: 1.0,
            name: None,
        }
    }

    /// Sets the colour.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.colour = colour;
        self
    }

    /// Sets the radius of a disc in points of the page.
    #[must_use]
    pub fn radius(mut self, points: f64) -> Self {
        self.radius = points;
        self
    }

    /// Sets the opacity of a single disc, 0 to 1; where discs overlap the colour grows darker.
    #[must_use]
    pub fn opacity(mut self, opacity: f64) -> Self {
        self.opacity = opacity;
        self
    }

    /// Lists the points in the legend.
    #[must_use]
    pub fn name(mut self, name: impl Into<Label>) -> Self {
        self.name = Some(name.into());
        self
    }

    pub(crate) fn legend_name(&self) -> Option<&Label> {
        self.name.as_ref()
    }

    pub(crate) fn colour_of_points(&self) -> Colour {
        self.colour
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let area = frame.area;
        let width = (area.width * RESOLUTION).ceil() as usize;
        let height = (area.height * RESOLUTION).ceil() as usize;
        // The image covers the frame exactly, so pixels may differ from squares by less than one part in a hundred.
        let (across, down) = (width as f64 / area.width, height as f64 / area.height);
        let mut layer = Coverage::new(width, height);
        for point in &self.points {
            let (x, y) = frame.point(*point);
            layer.add(
                ((x - area.left) * across, (y - area.top) * down),
                self.radius * RESOLUTION,
                self.opacity,
            );
        }
        let pixels = layer.levels();
        let palette: Vec<_> = (0..=255).map(|opacity| (self.colour, opacity)).collect();
        let png = png_image::indexed(width, height, &pixels, &palette)?;
        svg.image(area, &png, false);
        Ok(())
    }
}

/// How much of each pixel is covered, 0 to 1.
struct Coverage {
    width: usize,
    height: usize,
    clear: Vec<f32>,
}

impl Coverage {
    fn new(width: usize, height: usize) -> Self {
        Self { width, height, clear: vec![1.0; width * height] }
    }

    /// A disc with a soft edge of one pixel.
    fn add(&mut self, (x, y): (f64, f64), radius: f64, opacity: f64) {
        let reach = radius + 0.5;
        let inside =
            x > -reach && y > -reach && x < self.width as f64 + reach && y < self.height as f64 + reach;
        // Also false for NaN.
        if !inside {
            return;
        }
        // A disc smaller than a pixel is drawn as a pixel-wide one of proportionally lower opacity.
        let (drawn, opacity) =
            if radius < 0.5 { (0.5, opacity * 4.0 * radius * radius) } else { (radius, opacity) };
        let reach = drawn + 0.5;
        let columns =
            (x - reach).floor().max(0.0) as usize..((x + reach).ceil().max(0.0) as usize).min(self.width);
        let rows =
            (y - reach).floor().max(0.0) as usize..((y + reach).ceil().max(0.0) as usize).min(self.height);
        for row in rows {
            for column in columns.clone() {
                let (across, down) = (column as f64 + 0.5 - x, row as f64 + 0.5 - y);
                let distance = (across * across + down * down).sqrt();
                let cover = (drawn + 0.5 - distance).clamp(0.0, 1.0) * opacity;
                self.clear[row * self.width + column] *= (1.0 - cover) as f32;
            }
        }
    }

    /// Opacities from 0 to 255.
    fn levels(&self) -> Vec<u8> {
        self.clear.iter().map(|clear| ((1.0 - clear).clamp(0.0, 1.0) * 255.0 + 0.5) as u8).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_covers_its_area() {
        let mut coverage = Coverage::new(40, 40);
        coverage.add((20.3, 19.6), 6.0, 1.0);
        let area: f64 = coverage.clear.iter().map(|clear| 1.0 - f64::from(*clear)).sum();
        let expected = std::f64::consts::PI * 36.0;
        assert!((area / expected - 1.0).abs() < 0.02, "{area} {expected}");
    }

    #[test]
    fn points_outside_and_nan_are_ignored() {
        let mut coverage = Coverage::new(4, 4);
        for point in [(f64::NAN, 1.0), (-5.0, 1.0), (1.0, 1e300), (f64::INFINITY, 2.0)] {
            coverage.add(point, 1.0, 1.0);
        }
        assert!(coverage.levels().iter().all(|level| *level == 0));
    }
}
