//! A panel: two to four axes in a frame, and layers.

use kurbo::{BezPath, Point, Vec2};

use crate::axis::Axis;
use crate::builders::builders;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::{Frame, Rect};
use crate::label::Label;
use crate::layer::Layer;
use crate::legend::{Corner, Legend};
use crate::path::polyline;
use crate::style::{Anchor, Stroke, Style, TextStyle};
use crate::svg::{NUMBER_SIZE, Svg, TEXT_SIZE};
use crate::ticks::PlacedTicks;

/// Lengths in points.
const FRAME_WIDTH: f64 = 0.7;
const MAJOR_TICK: f64 = 4.0;
const MINOR_TICK: f64 = 2.2;
const NUMBER_DISTANCE: f64 = 4.0;

/// A frame with axes, layers, and optionally a letter, a title and a legend.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    area: Rect,
    x: Axis,
    y: Axis,
    right: Option<Axis>,
    top: Option<Axis>,
    /// A layer and whether it belongs to the axis on the right.
    layers: Vec<(Layer, bool)>,
    letter: Option<(String, Corner)>,
    title: Option<Label>,
    legend: Option<Legend>,
    markers_on_top: bool,
}

/// An edge of the frame and the axis it shows.
#[derive(Debug)]
struct Side<'a> {
    edge: Edge,
    axis: &'a Axis,
    placed: PlacedTicks,
    /// Whether numbers and label are at this edge; the edge opposite a single axis has ticks only.
    labelled: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Edge {
    Bottom,
    Left,
    Right,
    Top,
}

impl Edge {
    /// The point on the page at a fraction of the axis.
    fn place(self, area: Rect, fraction: f64) -> Point {
        area.fractions()
            * match self {
                Self::Bottom => Point::new(fraction, 0.0),
                Self::Left => Point::new(0.0, fraction),
                Self::Right => Point::new(1.0, fraction),
                Self::Top => Point::new(fraction, 1.0),
            }
    }

    /// The direction out of the frame, on the page.
    fn outward(self) -> Vec2 {
        match self {
            Self::Bottom => Vec2::new(0.0, 1.0),
            Self::Left => Vec2::new(-1.0, 0.0),
            Self::Right => Vec2::new(1.0, 0.0),
            Self::Top => Vec2::new(0.0, -1.0),
        }
    }
}

builders!(Panel {
    /// Sets the horizontal axis.
    x(axis: Axis) |own| own.x = axis;
    /// Sets the vertical axis.
    y(axis: Axis) |own| own.y = axis;
    /// Adds a second vertical axis, on the right.
    right(axis: Axis) |own| own.right = Some(axis);
    /// Adds a second horizontal axis at the top, for another unit of the same quantity; layers use the lower
    /// axis.
    top(axis: Axis) |own| own.top = Some(axis);
    /// Adds a layer.
    layer(layer: impl Into<Layer>) |own| own.layers.push((layer.into(), false));
    /// Adds a layer whose vertical coordinate belongs to the axis on the right.
    layer_right(layer: impl Into<Layer>) |own| own.layers.push((layer.into(), true));
    /// Adds several layers.
    layers(layers: impl IntoIterator<Item = impl Into<Layer>>) |own|
        own.layers.extend(layers.into_iter().map(|layer| (layer.into(), false)));
    /// Sets the letter, "a" for (a), in the upper left corner.
    letter(letter: &str) |own| own.letter = Some((letter.to_owned(), Corner::TopLeft));
    /// Sets the letter in another corner.
    letter_in(letter: &str, corner: Corner) |own| own.letter = Some((letter.to_owned(), corner));
    /// Sets a line of text above the frame.
    title(title: impl Into<Label>) |own| own.title = Some(title.into());
    /// Lists the named layers.
    legend(legend: Legend) |own| own.legend = Some(legend);
    /// Draws the markers of [`Scatter`](super::Scatter) layers above the frame and its ticks instead of
    /// below, so that markers at an edge are drawn whole; the labels of the right axis stay below.
    markers_on_top() |own| own.markers_on_top = true;
});

impl Panel {
    /// An empty panel whose frame is `area`.
    pub fn new(area: Rect) -> Self {
        Self { area, ..Self::default() }
    }

    pub(crate) fn render(&self, svg: &mut Svg) -> Result<(), DrawError> {
        let area = self.area;
        if !area.has_area() {
            return Err(DrawError::Size { what: "a panel", width: area.width, height: area.height });
        }
        let sides = self.sides()?;
        self.render_layers(svg)?;
        let stroke = Style::from(Stroke::new(Colour::BLACK, FRAME_WIDTH));
        svg.path(&sides.iter().flat_map(|side| side.marks(area)).collect(), &stroke);
        svg.rectangle(area, &stroke);
        if self.markers_on_top {
            let frame = Frame { area, x: &self.x, y: &self.y };
            for (layer, on_right) in &self.layers {
                if let (Layer::Scatter(scatter), false) = (layer, on_right) {
                    scatter.render_markers(&frame, svg);
                }
            }
        }
        for side in sides.iter().filter(|side| side.labelled) {
            side.render(area, svg)?;
        }
        if let Some(legend) = &self.legend {
            legend.render(self.layers.iter().map(|(layer, _)| layer), area, svg)?;
        }
        self.render_letter(svg)?;
        if let Some(title) = &self.title {
            let above = Edge::Top.place(area, 0.5) + 4.0 * Edge::Top.outward();
            svg.label(title, above, TextStyle::new(Anchor::Middle))?;
        }
        Ok(())
    }

    /// The edges of the frame in the order in which they are labelled.
    fn sides(&self) -> Result<[Side<'_>; 4], DrawError> {
        let side = |edge, axis, labelled| Side::new(edge, axis, labelled, self.area);
        Ok([
            side(Edge::Bottom, &self.x, true)?,
            side(Edge::Left, &self.y, true)?,
            side(Edge::Right, self.right.as_ref().unwrap_or(&self.y), self.right.is_some())?,
            side(Edge::Top, self.top.as_ref().unwrap_or(&self.x), self.top.is_some())?,
        ])
    }

    fn render_layers(&self, svg: &mut Svg) -> Result<(), DrawError> {
        let frame_of = |on_right: bool| {
            let y = if on_right { self.right.as_ref() } else { Some(&self.y) };
            let panel = self.letter.as_ref().map_or(String::new(), |(letter, _)| letter.clone());
            let y = y.ok_or(DrawError::NoRightAxis { panel })?;
            Ok(Frame { area: self.area, x: &self.x, y })
        };
        let mut clipped = false;
        for (layer, on_right) in &self.layers {
            let frame = frame_of(*on_right)?;
            // Markers on the edge and words may reach out of the frame; everything else ends at it.
            let wants_clip = !matches!(layer, Layer::Text(_) | Layer::Arrow(_));
            if wants_clip != clipped {
                if wants_clip {
                    svg.begin_clip(self.area)
                } else {
                    svg.end_clip()
                }
                clipped = wants_clip;
            }
            match layer {
                Layer::Line(line) => line.render(&frame, svg),
                Layer::Band(band) => band.render(&frame, svg),
                Layer::Rule(rule) => rule.render(&frame, svg),
                Layer::DensePoints(points) => points.render(&frame, svg)?,
                Layer::Raster(raster) => raster.render(&frame, svg)?,
                Layer::Text(text) => text.render(&frame, svg)?,
                Layer::Arrow(arrow) => arrow.render(&frame, svg),
                Layer::Scatter(scatter) => {
                    scatter.render_bars(&frame, svg)?;
                    svg.end_clip();
                    clipped = false;
                    if *on_right || !self.markers_on_top {
                        scatter.render_markers(&frame, svg);
                    }
                }
            }
        }
        if clipped {
            svg.end_clip();
        }
        Ok(())
    }

    fn render_letter(&self, svg: &mut Svg) -> Result<(), DrawError> {
        let Some((letter, corner)) = &self.letter else { return Ok(()) };
        let label = Label::plain(&format!("({letter})"));
        let size = TEXT_SIZE;
        let (left, top) = corner.place(self.area, (label.width(size), size), 6.0);
        let style = TextStyle::new(Anchor::LeftCentre).halo(Colour::WHITE);
        svg.label(&label, Point::new(left, top + 0.5 * size), style)
    }
}

impl<'a> Side<'a> {
    fn new(edge: Edge, axis: &'a Axis, labelled: bool, area: Rect) -> Result<Self, DrawError> {
        let (length, spacing) = match edge {
            Edge::Bottom | Edge::Top => (area.width, 5.0 * TEXT_SIZE),
            Edge::Left | Edge::Right => (area.height, 3.0 * TEXT_SIZE),
        };
        Ok(Self { edge, axis, placed: axis.choose_ticks(length, spacing)?, labelled })
    }

    /// The tick marks, which point into the frame.
    fn marks(&self, area: Rect) -> BezPath {
        let marks = self.placed.ticks.iter().flat_map(|tick| {
            let length = if tick.label.is_some() { MAJOR_TICK } else { MINOR_TICK };
            let place = self.edge.place(area, self.axis.fraction(tick.value));
            polyline([place, place - length * self.edge.outward()])
        });
        marks.collect()
    }

    /// The numbers at the ticks, the power of ten omitted from them, and the label of the axis.
    fn render(&self, area: Rect, svg: &mut Svg) -> Result<(), DrawError> {
        let size = NUMBER_SIZE;
        let mut widest: f64 = 0.0;
        if self.axis.shows_numbers {
            let (below, anchor) = match self.edge {
                Edge::Bottom => (0.75 * size, Anchor::Middle),
                Edge::Top => (0.0, Anchor::Middle),
                Edge::Left => (0.0, Anchor::RightCentre),
                Edge::Right => (0.0, Anchor::LeftCentre),
            };
            let shift = NUMBER_DISTANCE * self.edge.outward() + Vec2::new(0.0, below);
            for tick in &self.placed.ticks {
                let Some(label) = &tick.label else { continue };
                widest = widest.max(label.width(size));
                let place = self.edge.place(area, self.axis.fraction(tick.value)) + shift;
                svg.label(label, place, TextStyle::new(anchor).size(size).colour(self.axis.colour))?;
            }
            self.render_power(area, svg)?;
        }
        self.render_label(area, widest, svg)
    }

    fn render_power(&self, area: Rect, svg: &mut Svg) -> Result<(), DrawError> {
        let Some(power) = self.placed.power else { return Ok(()) };
        let size = NUMBER_SIZE;
        let label = Label::new(&format!("$\\times 10^{{{power}}}$"));
        let (x, y, anchor) = match self.edge {
            Edge::Bottom => (area.right(), area.bottom() + NUMBER_DISTANCE + 1.85 * size, Anchor::Right),
            Edge::Top => (area.right(), area.top - NUMBER_DISTANCE - 1.1 * size, Anchor::Right),
            Edge::Left => (area.left, area.top - 3.5, Anchor::Left),
            Edge::Right => (area.right(), area.top - 3.5, Anchor::Right),
        };
        svg.label(&label, Point::new(x, y), TextStyle::new(anchor).size(size))
    }

    /// The label of the axis outside its numbers, whose largest width is given.
    fn render_label(&self, area: Rect, widest: f64, svg: &mut Svg) -> Result<(), DrawError> {
        let level = matches!(self.edge, Edge::Bottom | Edge::Top);
        let extent = if level { 0.7 * NUMBER_SIZE } else { widest };
        let numbers = if self.axis.shows_numbers { NUMBER_DISTANCE + extent } else { 0.0 };
        let room = match self.edge {
            Edge::Bottom => 1.45,
            Edge::Left => 0.7,
            Edge::Right => 1.3,
            Edge::Top => 0.45,
        };
        let distance = self.axis.label_distance.unwrap_or(numbers + room * TEXT_SIZE);
        let mut place = self.edge.place(area, 0.5) + distance * self.edge.outward();
        // However wide the numbers are, the label stays on the page.
        match self.edge {
            Edge::Bottom => place.y = place.y.min(svg.height - 0.3 * TEXT_SIZE),
            Edge::Left => place.x = place.x.max(0.85 * TEXT_SIZE),
            Edge::Right => place.x = place.x.min(svg.width - 0.35 * TEXT_SIZE),
            Edge::Top => place.y = place.y.max(TEXT_SIZE),
        }
        let rotation = if level { 0.0 } else { 90.0 };
        let style = TextStyle::new(Anchor::Middle).rotated(rotation).colour(self.axis.colour);
        svg.label(&self.axis.label, place, style)
    }
}
