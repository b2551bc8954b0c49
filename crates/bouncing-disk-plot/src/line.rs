//! Curves, bands and reference lines.

use crate::colour::Colour;
use crate::error::DrawError;
use crate::frame::Frame;
use crate::label::Label;
use crate::stroke::{Dash, Stroke};
use crate::svg::{Svg, line_to, move_to};

/// Points closer than this, in points of the page, are drawn as one.
const RESOLUTION: f64 = 0.04;
/// A curve is drawn this far beyond the frame, where it is clipped, and not further.
const OVERHANG: f64 = 20.0;

/// A curve through points; broken where a coordinate is NaN or cannot be shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    points: Vec<(f64, f64)>,
    stroke: Option<Stroke>,
    fill: Option<(Colour, f64)>,
    name: Option<Label>,
}

impl Line {
    /// A curve through points in data coordinates.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let stroke = Some(Stroke { width: 1.0, ..Stroke::default() });
        Self { points: points.into_iter().collect(), stroke, fill: None, name: None }
    }

    /// Sets the colour.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.stroke.get_or_insert_default().colour = colour;
        self
    }

    /// Sets the width in points.
    #[must_use]
    pub fn width(mut self, points: f64) -> Self {
        self.stroke.get_or_insert_default().width = points;
        self
    }

    /// Sets the dashes.
    #[must_use]
    pub fn dash(mut self, dash: Dash) -> Self {
        self.stroke.get_or_insert_default().dash = dash;
        self
    }

    /// Sets the opacity, 0 to 1.
    #[must_use]
    pub fn opacity(mut self, opacity: f64) -> Self {
        self.stroke.get_or_insert_default().opacity = opacity;
        self
    }

    /// Fills the area that the points enclose.
    #[must_use]
    pub fn fill(mut self, colour: Colour, opacity: f64) -> Self {
        self.fill = Some((colour, opacity));
        self
    }

    /// Leaves out the line, for filled areas.
    #[must_use]
    pub fn without_stroke(mut self) -> Self {
        self.stroke = None;
        self
    }

    /// Lists the curve in the legend.
    #[must_use]
    pub fn name(mut self, name: impl Into<Label>) -> Self {
        self.name = Some(name.into());
        self
    }

    pub(crate) fn legend_name(&self) -> Option<&Label> {
        self.name.as_ref()
    }

    pub(crate) fn styles(&self) -> (Option<Stroke>, Option<(Colour, f64)>) {
        (self.stroke, self.fill)
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) {
        if self.fill.is_some() {
            let mut path = String::new();
            let mut pen_down = false;
            for point in self.points.iter().map(|point| frame.point(*point)) {
                if !(point.0.is_finite() && point.1.is_finite()) {
                    continue;
                }
                if pen_down {
                    line_to(&mut path, point)
                } else {
                    move_to(&mut path, point)
                }
                pen_down = true;
            }
            if pen_down {
                path.push('z');
            }
            svg.path(&path, None, self.fill);
        }
        if let Some(stroke) = &self.stroke {
            let path = polyline(frame, self.points.iter().map(|point| frame.point(*point)));
            svg.path(&path, Some(stroke), None);
        }
    }
}

/// Path data of a polyline: clipped near the frame, thinned to the resolution, broken at NaN.
pub(crate) fn polyline(frame: &Frame<'_>, points: impl Iterator<Item = (f64, f64)>) -> String {
    let mut path = String::new();
    let mut previous: Option<(f64, f64)> = None;
    let mut drawn: Option<(f64, f64)> = None;
    // A point that was left out because it nearly coincides with the drawn one.
    let mut skipped: Option<(f64, f64)> = None;
    for point in points {
        if !(point.0.is_finite() && point.1.is_finite()) {
            if let Some(last) = skipped.take() {
                line_to(&mut path, last);
            }
            (previous, drawn) = (None, None);
            continue;
        }
        if let Some(start) = previous
            && let Some((from, to)) = clip(frame, start, point)
        {
            let near = |a: (f64, f64), b: (f64, f64)| {
                (a.0 - b.0).abs() < RESOLUTION && (a.1 - b.1).abs() < RESOLUTION
            };
            let connected = drawn.is_some_and(|end| near(end, from));
            if !connected {
                if let Some(last) = skipped.take() {
                    line_to(&mut path, last);
                }
                move_to(&mut path, from);
                drawn = Some(from);
            }
            if drawn.is_some_and(|end| near(end, to)) {
                skipped = Some(to);
            } else {
                line_to(&mut path, to);
                drawn = Some(to);
                skipped = None;
            }
        }
        previous = Some(point);
    }
    if let Some(last) = skipped {
        line_to(&mut path, last);
    }
    path
}

/// The part of a segment within the frame and its overhang (Liang and Barsky's clipping).
fn clip(frame: &Frame<'_>, from: (f64, f64), to: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
    let (left, right) = (frame.area.left - OVERHANG, frame.area.right() + OVERHANG);
    let (top, bottom) = (frame.area.top - OVERHANG, frame.area.bottom() + OVERHANG);
    let (across, down) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let edges =
        [(-across, from.0 - left), (across, right - from.0), (-down, from.1 - top), (down, bottom - from.1)];
    for (outward, room) in edges {
        if outward == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if outward < 0.0 {
            enter = enter.max(room / outward);
        } else {
            leave = leave.min(room / outward);
        }
    }
    if enter > leave {
        return None;
    }
    let at = |share: f64| (from.0 + share * across, from.1 + share * down);
    Some((if enter > 0.0 { at(enter) } else { from }, if leave < 1.0 { at(leave) } else { to }))
}

/// The area between a lower and an upper curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    points: Vec<(f64, f64, f64)>,
    colour: Colour,
    opacity: f64,
    name: Option<Label>,
}

impl Band {
    /// A band through `(x, low, high)`; broken at NaN.
    pub fn new(points: impl IntoIterator<Item = (f64, f64, f64)>) -> Self {
        Self { points: points.into_iter().collect(), colour: Colour::LIGHT_GREY, opacity: 0.5, name: None }
    }

    /// Sets the colour.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.colour = colour;
        self
    }

    /// Sets the opacity, 0 to 1.
    #[must_use]
    pub fn opacity(mut self, opacity: f64) -> Self {
        self.opacity = opacity;
        self
    }

    /// Lists the band in the legend.
    #[must_use]
    pub fn name(mut self, name: impl Into<Label>) -> Self {
        self.name = Some(name.into());
        self
    }

    pub(crate) fn legend_name(&self) -> Option<&Label> {
        self.name.as_ref()
    }

    pub(crate) fn fill(&self) -> (Colour, f64) {
        (self.colour, self.opacity)
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) {
        let mut path = String::new();
        let finite = |(x, y): (f64, f64)| x.is_finite() && y.is_finite();
        let on_page = |&(x, low, high): &(f64, f64, f64)| (frame.point((x, low)), frame.point((x, high)));
        let edges: Vec<_> = self.points.iter().map(on_page).collect();
        for part in edges.split(|(low, high)| !(finite(*low) && finite(*high))).filter(|part| part.len() > 1)
        {
            let outline = part.iter().map(|edge| edge.0).chain(part.iter().rev().map(|edge| edge.1));
            for (index, point) in outline.enumerate() {
                if index == 0 { move_to(&mut path, point) } else { line_to(&mut path, point) }
            }
            path.push('z');
        }
        svg.path(&path, None, Some(self.fill()));
    }
}

/// A reference line across the panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    vertical: bool,
    value: f64,
    stroke: Stroke,
    name: Option<Label>,
}

impl Rule {
    /// A vertical line at `x`.
    pub fn vertical(x: f64) -> Self {
        Self::new(true, x)
    }

    /// A horizontal line at `y`.
    pub fn horizontal(y: f64) -> Self {
        Self::new(false, y)
    }

    fn new(vertical: bool, value: f64) -> Self {
        let stroke = Stroke::new(Colour::GREY, 0.6).dashed(Dash::Dashed);
        Self { vertical, value, stroke, name: None }
    }

    /// Sets colour, width and dashes.
    #[must_use]
    pub fn stroke(mut self, stroke: Stroke) -> Self {
        self.stroke = stroke;
        self
    }

    /// Lists the line in the legend.
    #[must_use]
    pub fn name(mut self, name: impl Into<Label>) -> Self {
        self.name = Some(name.into());
        self
    }

    pub(crate) fn legend_name(&self) -> Option<&Label> {
        self.name.as_ref()
    }

    pub(crate) fn line_stroke(&self) -> Stroke {
        self.stroke
    }

    pub(crate) fn render(&self, frame: &Frame<'_>, svg: &mut Svg) -> Result<(), DrawError> {
        let area = frame.area;
        let fraction =
            if self.vertical { frame.x.fraction(self.value) } else { frame.y.fraction(self.value) };
        if !(0.0..=1.0).contains(&fraction) {
            return Ok(());
        }
        let mut path = String::new();
        if self.vertical {
            let x = area.left + fraction * area.width;
            move_to(&mut path, (x, area.top));
            line_to(&mut path, (x, area.bottom()));
        } else {
            let y = area.bottom() - fraction * area.height;
            move_to(&mut path, (area.left, y));
            line_to(&mut path, (area.right(), y));
        }
        svg.path(&path, Some(&self.stroke), None);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Axis;
    use crate::frame::Rect;

    fn path(points: &[(f64, f64)]) -> String {
        let (x, y) = (Axis::linear(0.0, 100.0), Axis::linear(100.0, 0.0));
        let frame = Frame { area: Rect::new(0.0, 0.0, 100.0, 100.0), x: &x, y: &y, text_size: 9.0 };
        polyline(&frame, points.iter().map(|point| frame.point(*point)))
    }

    #[test]
    fn a_curve_breaks_at_nan() {
        assert_eq!(
            path(&[(0.0, 0.0), (10.0, 0.0), (20.0, f64::NAN), (30.0, 0.0), (40.0, 0.0)]),
            "M0 0L10 0M30 0L40 0"
        );
    }

    #[test]
    fn segments_far_outside_are_clipped_or_left_out() {
        assert_eq!(path(&[(50.0, 50.0), (50.0, 1e9)]), "M50 50L50 120");
        assert_eq!(path(&[(500.0, 0.0), (600.0, 100.0)]), "");
        assert_eq!(path(&[(-1e9, 50.0), (1e9, 50.0)]), "M-20 50L120 50");
    }

    #[test]
    fn close_points_are_drawn_as_one_but_the_end_is_kept() {
        let points: Vec<_> = (0..=1000).map(|i| (f64::from(i) * 0.001, 0.0)).collect();
        let path = path(&points);
        assert!(path.matches('L').count() <= 26, "{path}");
        assert!(path.ends_with("L1 0"), "{path}");
    }
}
