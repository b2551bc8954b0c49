//! The legend of a panel.

use kurbo::Point;

use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Rect;
use crate::label::Label;
use crate::layer::Layer;
use crate::line::{Band, Line, Rule};
use crate::path::polyline;
use crate::style::{Anchor, Stroke, Style, TextStyle};
use crate::svg::{NUMBER_SIZE, Svg};

/// The diameter in points of the dot that represents points too small to be seen alone.
const DENSE_SAMPLE: f64 = 3.0;

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
    /// The upper left corner of a box of this size in this corner of an area.
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

/// A legend in a corner of a panel. It lists the layers that have a name, in their order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Legend {
    corner: Corner,
    framed: bool,
    inset: f64,
}

builders!(Legend {
    /// Leaves out the frame and its background.
    without_frame() |own| own.framed = false;
    /// Sets the distance from the panel's edges in points.
    inset(points: f64) |own| own.inset = points;
});

impl Legend {
    /// A legend with a frame in a corner of the panel.
    pub fn at(corner: Corner) -> Self {
        Self { corner, framed: true, inset: 7.0 }
    }

    /// Draws the legend of these layers into the area of their panel.
    pub(crate) fn render<'a>(
        &self,
        layers: impl Iterator<Item = &'a Layer>,
        area: Rect,
        svg: &mut Svg,
    ) -> Result<(), DrawError> {
        let entries: Vec<(&Label, &Layer)> =
            layers.filter_map(|layer| layer.legend_name().map(|name| (name, layer))).collect();
        if entries.is_empty() {
            return Ok(());
        }
        let size = NUMBER_SIZE;
        let (row, key, padding, space) = (1.3 * size, 18.0, 4.0, 5.0);
        let widest = entries.iter().map(|(name, _)| name.width(size)).fold(0.0, f64::max);
        let width = 2.0 * padding + key + space + widest;
        let height = 2.0 * padding - 2.0 + row * entries.len() as f64;
        let (left, top) = self.corner.place(area, (width, height), self.inset);
        if self.framed {
            let edge = Style::from(Stroke::new(Colour::DARK_GREY, 0.5)).fill(Colour::WHITE);
            svg.rectangle(Rect::new(left, top, width, height), &edge);
        }
        for (index, (name, layer)) in entries.into_iter().enumerate() {
            let middle = top + padding - 1.0 + row * (index as f64 + 0.5);
            draw_key(svg, layer, Rect::new(left + padding, middle - 3.0, key, 6.0));
            let style = TextStyle::new(Anchor::LeftCentre).size(size);
            svg.label(name, Point::new(left + padding + key + space, middle), style)?;
        }
        Ok(())
    }
}

/// A sample of a layer's line, marker or area.
fn draw_key(svg: &mut Svg, layer: &Layer, area: Rect) {
    match layer {
        Layer::Line(Line { style, .. })
        | Layer::Band(Band { style, .. })
        | Layer::Rule(Rule { style, .. }) => {
            if style.fill.is_some() {
                svg.rectangle(area, style);
            } else {
                let ends = [(0.0, 0.5), (1.0, 0.5)].map(|end| area.fractions() * Point::from(end));
                svg.path(&polyline(ends), style);
            }
        }
        Layer::Scatter(scatter) => scatter.draw_markers(svg, [area.outline().center()]),
        Layer::DensePoints(points) => {
            let colour = points.style.solid().colour;
            svg.dots([area.outline().center()], DENSE_SAMPLE, colour.into());
        }
        Layer::Raster(_) | Layer::Text(_) | Layer::Arrow(_) => {}
    }
}
