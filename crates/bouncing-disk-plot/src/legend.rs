//! The legend of a panel.

use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::{Frame, Rect};
use crate::label::Label;
use crate::layer::Layer;
use crate::stroke::Stroke;
use crate::svg::{Svg, TextStyle, line_to, move_to};
use crate::{Anchor, Marker, Scatter};

/// A corner of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Corner {
    /// Upper left.
    TopLeft,
    /// Upper right.
    TopRight,
    /// Lower left.
    BottomLeft,
    /// Lower right.
    BottomRight,
}

impl Corner {
    /// The upper left corner of a box of this size that sits in the corner of an area.
    pub(crate) fn place(self, area: Rect, (width, height): (f64, f64), inset: f64) -> (f64, f64) {
        let left = match self {
            Self::TopLeft | Self::BottomLeft => area.left + inset,
            Self::TopRight | Self::BottomRight => area.right() - inset - width,
        };
        let top = match self {
            Self::TopLeft | Self::TopRight => area.top + inset,
            Self::BottomLeft | Self::BottomRight => area.bottom() - inset - height,
        };
        (left, top)
    }
}

/// Where the legend sits. It lists the layers that have a name, in their order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Legend {
    corner: Corner,
    framed: bool,
    inset: f64,
}

impl Legend {
    /// A legend with a frame in a corner of the panel.
    pub fn at(corner: Corner) -> Self {
        Self { corner, framed: true, inset: 7.0 }
    }

    /// Leaves out the frame and its background.
    #[must_use]
    pub fn without_frame(mut self) -> Self {
        self.framed = false;
        self
    }

    /// Sets the distance from the panel's edges in points.
    #[must_use]
    pub fn inset(mut self, points: f64) -> Self {
        self.inset = points;
        self
    }

    pub(crate) fn render<'a>(
        &self,
        layers: impl Iterator<Item = &'a Layer>,
        frame: &Frame<'_>,
        svg: &mut Svg,
    ) -> Result<(), DrawError> {
        let entries: Vec<(&Label, &Layer)> =
            layers.filter_map(|layer| layer.legend_name().map(|name| (name, layer))).collect();
        if entries.is_empty() {
            return Ok(());
        }
        let size = 0.92 * frame.text_size;
        let (row, key, padding, space) = (1.3 * size, 18.0, 4.0, 5.0);
        let widest = entries.iter().map(|(name, _)| name.width(size)).fold(0.0, f64::max);
        let width = 2.0 * padding + key + space + widest;
        let height = 2.0 * padding - 2.0 + row * entries.len() as f64;
        let (left, top) = self.corner.place(frame.area, (width, height), self.inset);
        if self.framed {
            let edge = Stroke::new(Colour::DARK_GREY, 0.5);
            svg.rectangle(Rect::new(left, top, width, height), Some(&edge), Some((Colour::WHITE, 1.0)));
        }
        for (index, (name, layer)) in entries.into_iter().enumerate() {
            let middle = top + padding - 1.0 + row * (index as f64 + 0.5);
            draw_key(svg, layer, left + padding, middle, key);
            let style = TextStyle::new(size, Anchor::LeftCentre);
            svg.label(name, (left + padding + key + space, middle), style)?;
        }
        Ok(())
    }
}

/// A sample of a layer's line, marker or area.
fn draw_key(svg: &mut Svg, layer: &Layer, left: f64, middle: f64, width: f64) {
    let mut path = String::new();
    move_to(&mut path, (left, middle));
    line_to(&mut path, (left + width, middle));
    let area = Rect::new(left, middle - 3.0, width, 6.0);
    let centre = (left + 0.5 * width, middle);
    match layer {
        Layer::Line(line) => {
            let (stroke, fill) = line.styles();
            if fill.is_some() {
                svg.rectangle(area, stroke.as_ref(), fill);
            } else if let Some(stroke) = stroke {
                svg.path(&path, Some(&stroke), None);
            }
        }
        Layer::Rule(rule) => svg.path(&path, Some(&rule.line_stroke()), None),
        Layer::Band(band) => svg.rectangle(area, None, Some(band.fill())),
        Layer::Scatter(scatter) => scatter.draw_markers(svg, &[centre]),
        Layer::DensePoints(points) => {
            let sample = Scatter::new([]).marker(Marker::Dot).size(3.0).colour(points.colour_of_points());
            sample.draw_markers(svg, &[centre]);
        }
        Layer::Raster(_) | Layer::Text(_) | Layer::Arrow(_) => {}
    }
}
