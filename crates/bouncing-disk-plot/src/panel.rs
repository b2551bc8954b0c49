//! A panel: two to four axes in a frame, and layers.

use crate::annotation::Anchor;
use crate::axis::Axis;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::{Frame, Rect};
use crate::label::Label;
use crate::layer::Layer;
use crate::legend::{Corner, Legend};
use crate::stroke::Stroke;
use crate::svg::{Svg, TextStyle, line_to, move_to};
use crate::ticks::{Scale, Tick};

/// Lengths in points.
const FRAME_WIDTH: f64 = 0.7;
const MAJOR_TICK: f64 = 4.0;
const MINOR_TICK: f64 = 2.2;
const NUMBER_DISTANCE: f64 = 4.0;

/// A frame with axes, layers, and optionally a letter, a title and a legend.
#[derive(Clone, Debug, PartialEq)]
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
    background: Option<Colour>,
    markers_on_top: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Edge {
    Bottom,
    Top,
    Left,
    Right,
}

impl Panel {
    /// An empty panel whose frame is `area`.
    pub fn new(area: Rect) -> Self {
        Self {
            area,
            x: Axis::default(),
            y: Axis::default(),
            right: None,
            top: None,
            layers: Vec::new(),
            letter: None,
            title: None,
            legend: None,
            background: None,
            markers_on_top: false,
        }
    }

    /// Sets the horizontal axis.
    #[must_use]
    pub fn x(mut self, axis: Axis) -> Self {
        self.x = axis;
        self
    }

    /// Sets the vertical axis.
    #[must_use]
    pub fn y(mut self, axis: Axis) -> Self {
        self.y = axis;
        self
    }

    /// Adds a second vertical axis, on the right.
    #[must_use]
    pub fn right(mut self, axis: Axis) -> Self {
        self.right = Some(axis);
        self
    }

    /// Adds a second horizontal axis, above: another unit of the same quantity. Layers keep to the lower one.
    #[must_use]
    pub fn top(mut self, axis: Axis) -> Self {
        self.top = Some(axis);
        self
    }

    /// Adds a layer.
    #[must_use]
    pub fn layer(mut self, layer: impl Into<Layer>) -> Self {
        self.layers.push((layer.into(), false));
        self
    }

    /// Adds a layer whose vertical coordinate belongs to the axis on the right.
    #[must_use]
    pub fn layer_right(mut self, layer: impl Into<Layer>) -> Self {
        self.layers.push((layer.into(), true));
        self
    }

    /// Adds several layers.
    #[must_use]
    pub fn layers<L: Into<Layer>>(mut self, layers: impl IntoIterator<Item = L>) -> Self {
        self.layers.extend(layers.into_iter().map(|layer| (layer.into(), false)));
        self
    }

    /// Sets the letter, "a" for (a), in the upper left corner.
    #[must_use]
    pub fn letter(self, letter: &str) -> Self {
        self.letter_in(letter, Corner::TopLeft)
    }

    /// Sets the letter in another corner.
    #[must_use]
    pub fn letter_in(mut self, letter: &str, corner: Corner) -> Self {
        self.letter = Some((letter.to_owned(), corner));
        self
    }

    /// Sets a line of text above the frame.
    #[must_use]
    pub fn title(mut self, title: impl Into<Label>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// Lists the named layers.
    #[must_use]
    pub fn legend(mut self, legend: Legend) -> Self {
        self.legend = Some(legend);
        self
    }

    /// Fills the frame, needed for insets.
    #[must_use]
    pub fn background(mut self, colour: Colour) -> Self {
        self.background = Some(colour);
        self
    }

    /// Draws the markers of [`Scatter`](super::Scatter) layers above the frame and its ticks instead of below, so that those at an
    /// edge are seen whole; those of the axis on the right stay below.
    #[must_use]
    pub fn markers_on_top(mut self) -> Self {
        self.markers_on_top = true;
        self
    }

    /// Draws the panel on a page of the given width and height.
    pub(crate) fn render(&self, svg: &mut Svg, page: (f64, f64), text_size: f64) -> Result<(), DrawError> {
        let area = self.area;
        if !area.has_area() {
            return Err(DrawError::Size { what: "a panel", width: area.width, height: area.height });
        }
        let x_ticks = self.x.choose_ticks(area.width, 5.0 * text_size)?;
        let y_ticks = self.y.choose_ticks(area.height, 3.0 * text_size)?;
        let right_ticks =
            self.right.as_ref().map(|axis| axis.choose_ticks(area.height, 3.0 * text_size)).transpose()?;
        if let Some(colour) = self.background {
            svg.rectangle(area, None, Some((colour, 1.0)));
        }
        self.render_layers(svg, text_size)?;
        let stroke = Stroke::new(Colour::BLACK, FRAME_WIDTH);
        let mut marks = String::new();
        let top_ticks =
            self.top.as_ref().map(|axis| axis.choose_ticks(area.width, 5.0 * text_size)).transpose()?;
        match (&self.top, &top_ticks) {
            (Some(axis), Some(ticks)) => {
                self.push_marks(&mut marks, &self.x, &x_ticks.ticks, &[Edge::Bottom]);
                self.push_marks(&mut marks, axis, &ticks.ticks, &[Edge::Top]);
            }
            _ => self.push_marks(&mut marks, &self.x, &x_ticks.ticks, &[Edge::Bottom, Edge::Top]),
        }
        match (&self.right, &right_ticks) {
            (Some(axis), Some(ticks)) => {
                self.push_marks(&mut marks, &self.y, &y_ticks.ticks, &[Edge::Left]);
                self.push_marks(&mut marks, axis, &ticks.ticks, &[Edge::Right]);
            }
            _ => self.push_marks(&mut marks, &self.y, &y_ticks.ticks, &[Edge::Left, Edge::Right]),
        }
        svg.path(&marks, Some(&stroke), None);
        svg.rectangle(area, Some(&stroke), None);
        if self.markers_on_top {
            let frame = Frame { area, x: &self.x, y: &self.y, text_size };
            for (layer, on_right) in &self.layers {
                if let (Layer::Scatter(scatter), false) = (layer, on_right) {
                    scatter.render_markers(&frame, svg);
                }
            }
        }
        self.render_axis(svg, &self.x, &x_ticks, Edge::Bottom, page, text_size)?;
        self.render_axis(svg, &self.y, &y_ticks, Edge::Left, page, text_size)?;
        if let (Some(axis), Some(ticks)) = (&self.right, &right_ticks) {
            self.render_axis(svg, axis, ticks, Edge::Right, page, text_size)?;
        }
        if let (Some(axis), Some(ticks)) = (&self.top, &top_ticks) {
            self.render_axis(svg, axis, ticks, Edge::Top, page, text_size)?;
        }
        let frame = Frame { area, x: &self.x, y: &self.y, text_size };
        if let Some(legend) = &self.legend {
            legend.render(self.layers.iter().map(|(layer, _)| layer), &frame, svg)?;
        }
        self.render_letter(svg, text_size)?;
        if let Some(title) = &self.title {
            let above = (area.left + 0.5 * area.width, area.top - 4.0);
            svg.label(title, above, TextStyle::new(text_size, Anchor::Middle))?;
        }
        Ok(())
    }

    fn render_layers(&self, svg: &mut Svg, text_size: f64) -> Result<(), DrawError> {
        let frame_of = |on_right: bool| {
            let y = if on_right { self.right.as_ref() } else { Some(&self.y) };
            let panel = self.letter.as_ref().map_or(String::new(), |(letter, _)| letter.clone());
            let y = y.ok_or(DrawError::NoRightAxis { panel })?;
            Ok(Frame { area: self.area, x: &self.x, y, text_size })
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
                Layer::Rule(rule) => rule.render(&frame, svg)?,
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

    /// The marks of the ticks, inward from the given edges.
    fn push_marks(&self, path: &mut String, axis: &Axis, ticks: &[Tick], edges: &[Edge]) {
        let area = self.area;
        for tick in ticks {
            let fraction = axis.fraction(tick.value);
            let length = if tick.label.is_some() { MAJOR_TICK } else { MINOR_TICK };
            let (x, y) = (area.left + fraction * area.width, area.bottom() - fraction * area.height);
            for edge in edges {
                let (from, to) = match edge {
                    Edge::Bottom => ((x, area.bottom()), (x, area.bottom() - length)),
                    Edge::Top => ((x, area.top), (x, area.top + length)),
                    Edge::Left => ((area.left, y), (area.left + length, y)),
                    Edge::Right => ((area.right(), y), (area.right() - length, y)),
                };
                move_to(path, from);
                line_to(path, to);
            }
        }
    }

    /// The numbers at the ticks and the label of an axis.
    fn render_axis(
        &self,
        svg: &mut Svg,
        axis: &Axis,
        scale: &Scale,
        edge: Edge,
        page: (f64, f64),
        text_size: f64,
    ) -> Result<(), DrawError> {
        let area = self.area;
        let size = 0.92 * text_size;
        let mut widest: f64 = 0.0;
        for tick in scale.ticks.iter().filter(|_| axis.shows_numbers()) {
            let Some(label) = &tick.label else { continue };
            widest = widest.max(label.width(size));
            let fraction = axis.fraction(tick.value);
            let (x, y) = (area.left + fraction * area.width, area.bottom() - fraction * area.height);
            let (place, anchor) = match edge {
                Edge::Bottom => ((x, area.bottom() + NUMBER_DISTANCE + 0.75 * size), Anchor::Middle),
                Edge::Top => ((x, area.top - NUMBER_DISTANCE), Anchor::Middle),
                Edge::Left => ((area.left - NUMBER_DISTANCE, y), Anchor::RightCentre),
                Edge::Right => ((area.right() + NUMBER_DISTANCE, y), Anchor::LeftCentre),
            };
            svg.label(label, place, TextStyle::new(size, anchor))?;
        }
        let (middle_x, middle_y) = (area.left + 0.5 * area.width, area.top + 0.5 * area.height);
        let numbers = if axis.shows_numbers() { NUMBER_DISTANCE + widest } else { 0.0 };
        if let (Some(power), true) = (scale.power, axis.shows_numbers()) {
            let label = Label::new(&format!("$\\times 10^{{{power}}}$"));
            let (place, anchor) = match edge {
                Edge::Bottom => {
                    ((area.right(), area.bottom() + NUMBER_DISTANCE + 1.85 * size), Anchor::Right)
                }
                Edge::Top => ((area.right(), area.top - NUMBER_DISTANCE - 1.1 * size), Anchor::Right),
                Edge::Left => ((area.left, area.top - 3.5), Anchor::Left),
                Edge::Right => ((area.right(), area.top - 3.5), Anchor::Right),
            };
            svg.label(&label, place, TextStyle::new(size, anchor))?;
        }
        // However wide the numbers are, the label stays on the page.
        let mut style = TextStyle::new(text_size, Anchor::Middle);
        let place = match edge {
            Edge::Bottom => {
                let numbers = if axis.shows_numbers() { NUMBER_DISTANCE + 0.7 * size } else { 0.0 };
                let distance = axis.distance().unwrap_or(numbers + 1.45 * text_size);
                (middle_x, (area.bottom() + distance).min(page.1 - 0.3 * text_size))
            }
            Edge::Top => {
                let numbers = if axis.shows_numbers() { NUMBER_DISTANCE + 0.7 * size } else { 0.0 };
                let distance = axis.distance().unwrap_or(numbers + 0.45 * text_size);
                (middle_x, (area.top - distance).max(text_size))
            }
            Edge::Left => {
                style.rotation = 90.0;
                let distance = axis.distance().unwrap_or(numbers + 0.7 * text_size);
                ((area.left - distance).max(0.85 * text_size), middle_y)
            }
            Edge::Right => {
                style.rotation = 90.0;
                let distance = axis.distance().unwrap_or(numbers + 1.3 * text_size);
                ((area.right() + distance).min(page.0 - 0.35 * text_size), middle_y)
            }
        };
        svg.label(axis.label_text(), place, style)
    }

    fn render_letter(&self, svg: &mut Svg, text_size: f64) -> Result<(), DrawError> {
        let Some((letter, corner)) = &self.letter else { return Ok(()) };
        let label = Label::plain(&format!("({letter})"));
        let width = label.width(text_size);
        let (left, top) = corner.place(self.area, (width, text_size), 6.0);
        let style = TextStyle { halo: Some(Colour::WHITE), ..TextStyle::new(text_size, Anchor::LeftCentre) };
        svg.label(&label, (left, top + 0.5 * text_size), style)
    }
}
