//! Free drawings: sketches, flow charts, perspective views.

use crate::annotation::{Anchor, arrow};
use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Rect;
use crate::label::Label;
use crate::stroke::Stroke;
use crate::svg::{Svg, TextStyle, ellipse_path, line_to, move_to, short};

/// An outline in the local coordinates of a [`Drawing`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    steps: Vec<PathStep>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum PathStep {
    Move((f64, f64)),
    Line((f64, f64)),
    Curve((f64, f64), (f64, f64), (f64, f64)),
    Close,
}

impl Path {
    /// An empty outline.
    pub fn new() -> Self {
        Self::default()
    }

    /// Straight lines through points; broken at NaN.
    pub fn through(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut path = Self::new();
        let mut pen_down = false;
        for (x, y) in points {
            let finite = x.is_finite() && y.is_finite();
            if finite {
                path.steps.push(if pen_down { PathStep::Line((x, y)) } else { PathStep::Move((x, y)) });
            }
            pen_down = finite;
        }
        path
    }

    /// Lifts the pen and goes to a point.
    #[must_use]
    pub fn move_to(mut self, x: f64, y: f64) -> Self {
        self.steps.push(PathStep::Move((x, y)));
        self
    }

    /// A straight line.
    #[must_use]
    pub fn line_to(mut self, x: f64, y: f64) -> Self {
        self.steps.push(PathStep::Line((x, y)));
        self
    }

    /// A cubic Bézier curve with two control points.
    #[must_use]
    pub fn curve_to(mut self, first: (f64, f64), second: (f64, f64), end: (f64, f64)) -> Self {
        self.steps.push(PathStep::Curve(first, second, end));
        self
    }

    /// Back to the start of this part.
    #[must_use]
    pub fn close(mut self) -> Self {
        self.steps.push(PathStep::Close);
        self
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Item {
    Path { path: Path, stroke: Option<Stroke>, fill: Option<(Colour, f64)> },
    Ellipse { centre: (f64, f64), radii: (f64, f64), stroke: Option<Stroke>, fill: Option<(Colour, f64)> },
    Text { at: (f64, f64), label: Label, anchor: Anchor, size: Option<f64>, colour: Colour, rotation: f64 },
    Arrow { points: Vec<(f64, f64)>, stroke: Stroke, head: f64, double: bool },
    Box { centre: (f64, f64), size: (f64, f64), corner: f64, lines: Vec<Label>, stroke: Stroke, fill: Colour },
}

/// A free drawing in local coordinates, `y` upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    area: Rect,
    x: (f64, f64),
    y: (f64, f64),
    items: Vec<Item>,
}

impl Drawing {
    /// A drawing whose local coordinates run over `x` and `y` in the rectangle `area`. Nothing is clipped.
    pub fn new(area: Rect, x: (f64, f64), y: (f64, f64)) -> Self {
        Self { area, x, y, items: Vec::new() }
    }

    /// A drawing with the same scale in both directions: the local range is widened in the direction that has
    /// room.
    pub fn with_equal_scales(area: Rect, x: (f64, f64), y: (f64, f64)) -> Self {
        let (per_x, per_y) = (area.width / (x.1 - x.0).abs(), area.height / (y.1 - y.0).abs());
        let scale = per_x.min(per_y);
        let widened = |range: (f64, f64), length: f64| {
            let middle = 0.5 * (range.0 + range.1);
            let half = if range.1 < range.0 { -0.5 } else { 0.5 } * length / scale;
            (middle - half, middle + half)
        };
        Self::new(area, widened(x, area.width), widened(y, area.height))
    }

    /// Adds a line along an outline.
    #[must_use]
    pub fn stroke(mut self, path: Path, stroke: Stroke) -> Self {
        self.items.push(Item::Path { path, stroke: Some(stroke), fill: None });
        self
    }

    /// Adds a filled outline.
    #[must_use]
    pub fn fill(mut self, path: Path, colour: Colour, opacity: f64) -> Self {
        self.items.push(Item::Path { path, stroke: None, fill: Some((colour, opacity)) });
        self
    }

    /// Adds an upright ellipse with half-axes in local units; an opacity of 0 leaves it open.
    #[must_use]
    pub fn ellipse(
        mut self,
        centre: (f64, f64),
        radii: (f64, f64),
        stroke: Option<Stroke>,
        fill: Option<(Colour, f64)>,
    ) -> Self {
        self.items.push(Item::Ellipse { centre, radii, stroke, fill });
        self
    }

    /// Adds a text.
    #[must_use]
    pub fn text(self, at: (f64, f64), anchor: Anchor, label: impl Into<Label>) -> Self {
        self.text_styled(at, anchor, label, None, Colour::BLACK, 0.0)
    }

    /// Adds a text with a font size in points, a colour and a rotation in degrees, anticlockwise.
    #[must_use]
    pub fn text_styled(
        mut self,
        at: (f64, f64),
        anchor: Anchor,
        label: impl Into<Label>,
        size: Option<f64>,
        colour: Colour,
        rotation: f64,
    ) -> Self {
        self.items.push(Item::Text { at, label: label.into(), anchor, size, colour, rotation });
        self
    }

    /// Adds a line through points with a head of 5 points at the last one.
    #[must_use]
    pub fn arrow(self, points: impl IntoIterator<Item = (f64, f64)>, stroke: Stroke) -> Self {
        self.arrow_with_head(points, stroke, 5.0)
    }

    /// Adds a line through points with a head of this length in points at the last one.
    #[must_use]
    pub fn arrow_with_head(
        mut self,
        points: impl IntoIterator<Item = (f64, f64)>,
        stroke: Stroke,
        head: f64,
    ) -> Self {
        let points = points.into_iter().collect();
        self.items.push(Item::Arrow { points, stroke, head, double: false });
        self
    }

    /// Adds a line with heads at both ends, for dimensions.
    #[must_use]
    pub fn double_arrow(mut self, from: (f64, f64), to: (f64, f64), stroke: Stroke) -> Self {
        self.items.push(Item::Arrow { points: vec![from, to], stroke, head: 5.0, double: true });
        self
    }

    /// Adds a box with centred lines of text, for flow charts. The size is in local units, the radius of the
    /// corners in points.
    #[must_use]
    pub fn text_box<L: Into<Label>>(
        mut self,
        centre: (f64, f64),
        size: (f64, f64),
        corner: f64,
        lines: impl IntoIterator<Item = L>,
        stroke: Stroke,
        fill: Colour,
    ) -> Self {
        let lines = lines.into_iter().map(Into::into).collect();
        self.items.push(Item::Box { centre, size, corner, lines, stroke, fill });
        self
    }

    /// The local coordinates of a place on the page, for letters in the corner of a drawing with widened ranges.
    pub fn local(&self, (left, top): (f64, f64)) -> (f64, f64) {
        (
            self.x.0 + (left - self.area.left) / self.area.width * (self.x.1 - self.x.0),
            self.y.0 + (self.area.bottom() - top) / self.area.height * (self.y.1 - self.y.0),
        )
    }

    fn point(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (
            self.area.left + (x - self.x.0) / (self.x.1 - self.x.0) * self.area.width,
            self.area.bottom() - (y - self.y.0) / (self.y.1 - self.y.0) * self.area.height,
        )
    }

    fn lengths(&self, (across, up): (f64, f64)) -> (f64, f64) {
        (
            (across / (self.x.1 - self.x.0) * self.area.width).abs(),
            (up / (self.y.1 - self.y.0) * self.area.height).abs(),
        )
    }

    pub(crate) fn render(&self, svg: &mut Svg, text_size: f64) -> Result<(), DrawError> {
        if !self.area.has_area() {
            return Err(DrawError::Size {
                what: "a drawing",
                width: self.area.width,
                height: self.area.height,
            });
        }
        for (low, high) in [self.x, self.y] {
            let extent = (high - low).abs();
            if !(extent > 0.0 && extent.is_finite()) {
                return Err(DrawError::AxisRange { axis: "of a drawing".to_owned(), low, high });
            }
        }
        self.items.iter().try_for_each(|item| self.render_item(item, svg, text_size))
    }

    fn render_item(&self, item: &Item, svg: &mut Svg, text_size: f64) -> Result<(), DrawError> {
        match item {
            Item::Path { path, stroke, fill } => svg.path(&self.path_data(path), stroke.as_ref(), *fill),
            Item::Ellipse { centre, radii, stroke, fill } => {
                let (across, down) = self.lengths(*radii);
                let mut path = String::new();
                ellipse_path(&mut path, self.point(*centre), across, down);
                svg.path(&path, stroke.as_ref(), *fill);
            }
            Item::Text { at, label, anchor, size, colour, rotation } => {
                let style = TextStyle {
                    colour: *colour,
                    rotation: *rotation,
                    ..TextStyle::new(size.unwrap_or(text_size), *anchor)
                };
                svg.label(label, self.point(*at), style)?;
            }
            Item::Arrow { points, stroke, head, double } => {
                let mut points: Vec<_> = points.iter().map(|point| self.point(*point)).collect();
                arrow(svg, &points, stroke, *head);
                if *double {
                    points.reverse();
                    arrow(svg, &points, stroke, *head);
                }
            }
            Item::Box { centre, size, corner, lines, stroke, fill } => {
                let (x, y) = self.point(*centre);
                let (width, height) = self.lengths(*size);
                let area = Rect::new(x - 0.5 * width, y - 0.5 * height, width, height);
                svg.path(&rounded(area, *corner), Some(stroke), Some((*fill, 1.0)));
                let pitch = 1.25 * text_size;
                let first = y - 0.5 * pitch * (lines.len() as f64 - 1.0);
                for (index, line) in lines.iter().enumerate() {
                    let style = TextStyle::new(text_size, Anchor::Centre);
                    svg.label(line, (x, first + pitch * index as f64), style)?;
                }
            }
        }
        Ok(())
    }

    fn path_data(&self, path: &Path) -> String {
        let mut data = String::new();
        for step in &path.steps {
            match step {
                PathStep::Move(point) => move_to(&mut data, self.point(*point)),
                PathStep::Line(point) => line_to(&mut data, self.point(*point)),
                PathStep::Curve(first, second, end) => {
                    for (index, point) in [first, second, end].into_iter().enumerate() {
                        let (x, y) = self.point(*point);
                        data.push_str(if index == 0 { "C" } else { " " });
                        data.push_str(&format!("{} {}", short(x), short(y)));
                    }
                }
                PathStep::Close => data.push('z'),
            }
        }
        data
    }
}

/// A rectangle with round corners as path data.
fn rounded(area: Rect, radius: f64) -> String {
    let radius = radius.clamp(0.0, 0.5 * area.width.min(area.height));
    let (r, across, down) =
        (short(radius), short(area.width - 2.0 * radius), short(area.height - 2.0 * radius));
    let (x, y) = (short(area.left + radius), short(area.top));
    format!(
        "M{x} {y}h{across}a{r} {r} 0 0 1 {r} {r}v{down}a{r} {r} 0 0 1 -{r} {r}h-{across}\
         a{r} {r} 0 0 1 -{r} -{r}v-{down}a{r} {r} 0 0 1 {r} -{r}z"
    )
}
