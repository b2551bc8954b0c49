//! Writes SVG elements.

use std::fmt::Write as _;

use base64::Engine as _;
use kurbo::{BezPath, PathEl, Point, Shape};

use crate::colour::Colour;
use crate::encode;
use crate::error::DrawError;
use crate::font::{FAMILIES, FontStyle};
use crate::frame::Rect;
use crate::label::{Label, Level, SCRIPT_SIZE};
use crate::path::polyline;
use crate::style::{Anchor, Dash, Fill, Stroke, Style, TextStyle};

/// Largest distance of a curve from the circle that it approximates, in points.
pub(crate) const TOLERANCE: f64 = 0.01;

/// The size in points of axis labels and of other text without a given size.
pub(crate) const TEXT_SIZE: f64 = 9.0;

/// The size in points of the numbers at ticks and of legends.
pub(crate) const NUMBER_SIZE: f64 = 0.92 * TEXT_SIZE;

/// An SVG document being written. Lengths are in points.
#[derive(Debug)]
pub(crate) struct Svg {
    text: String,
    clips: usize,
    /// The size of the page.
    pub(crate) width: f64,
    pub(crate) height: f64,
}

/// Heights in units of the font size: of capitals, for centring; of subscripts and superscripts.
const CAPITAL_HEIGHT: f64 = 0.66;
const SUBSCRIPT_DROP: f64 = 0.20;
const SUPERSCRIPT_RISE: f64 = 0.36;

impl Svg {
    /// An empty white page.
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let (wide, high) = (short(width), short(height));
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{wide}pt\" height=\"{high}pt\" \
             viewBox=\"0 0 {wide} {high}\" font-family=\"{FAMILIES}\" fill=\"none\">\n\
             <rect width=\"{wide}\" height=\"{high}\" fill=\"#ffffff\"/>\n"
        );
        Self { text, clips: 0, width, height }
    }

    pub(crate) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    /// Clips everything until [`Svg::end_clip`] to the rectangle.
    pub(crate) fn begin_clip(&mut self, area: Rect) {
        self.clips += 1;
        let number = self.clips;
        let rectangle = attributes(area.outline());
        let _ = writeln!(
            self.text,
            "<clipPath id=\"clip{number}\"><rect {rectangle}/></clipPath>\n<g clip-path=\"url(#clip{number})\">"
        );
    }

    pub(crate) fn end_clip(&mut self) {
        self.text.push_str("</g>\n");
    }

    /// A path with a stroke, a fill, or both; a path with a point that is not finite is omitted.
    pub(crate) fn path(&mut self, path: &BezPath, style: &Style) {
        self.path_with("", path, style);
    }

    /// Discs about points, drawn as lines of zero length with round ends; outlines would need five times as
    /// much text.
    pub(crate) fn dots(&mut self, centres: impl IntoIterator<Item = Point>, diameter: f64, fill: Fill) {
        let dots = centres.into_iter().flat_map(|centre| polyline([centre; 2])).collect();
        let stroke =
            Stroke { colour: fill.colour, width: diameter, dash: Dash::Solid, opacity: fill.opacity };
        self.path_with(" stroke-linecap=\"round\"", &dots, &stroke.into());
    }

    fn path_with(&mut self, attributes: &str, path: &BezPath, style: &Style) {
        if path.elements().is_empty() || !path.is_finite() {
            return;
        }
        let _ = write!(self.text, "<path{attributes}");
        if let Some(fill) = style.fill {
            let _ = write!(self.text, " fill=\"{}\"", fill.colour);
            if fill.opacity < 1.0 {
                let _ = write!(self.text, " fill-opacity=\"{}\"", short(fill.opacity));
            }
        }
        if let Some(stroke) = style.stroke {
            let width = short(stroke.width);
            let _ = write!(self.text, " stroke=\"{}\" stroke-width=\"{width}\"", stroke.colour);
            self.text.push_str(" stroke-linejoin=\"round\"");
            if let Some(pattern) = stroke.dash.pattern() {
                let _ = write!(self.text, " stroke-dasharray=\"{pattern}\"");
            }
            if stroke.opacity < 1.0 {
                let _ = write!(self.text, " stroke-opacity=\"{}\"", short(stroke.opacity));
            }
        }
        let _ = writeln!(self.text, " d=\"{}\"/>", rounded(path).to_svg());
    }

    pub(crate) fn rectangle(&mut self, area: Rect, style: &Style) {
        self.path(&area.outline().to_path(TOLERANCE), style);
    }

    /// An image stretched over a rectangle; if `sharp`, its cells are shown as squares; see [`indexed`].
    pub(crate) fn image(
        &mut self,
        area: kurbo::Rect,
        size: [usize; 2],
        pixels: &[u8],
        palette: &[(Colour, u8)],
        sharp: bool,
    ) -> Result<(), DrawError> {
        let png = indexed(size, pixels, palette)?;
        let data = base64::engine::general_purpose::STANDARD.encode(png);
        let style = if sharp { " style=\"image-rendering:pixelated\"" } else { "" };
        let _ = writeln!(
            self.text,
            "<image {} preserveAspectRatio=\"none\"{style} href=\"data:image/png;base64,{data}\"/>",
            attributes(area)
        );
        Ok(())
    }

    /// A label whose baseline (or middle) is at a point; omitted if the point is not finite.
    pub(crate) fn label(&mut self, label: &Label, at: Point, style: TextStyle) -> Result<(), DrawError> {
        let spans = label.spans()?;
        if label.is_empty() || !at.is_finite() {
            return Ok(());
        }
        let (anchor, centred) = match style.anchor {
            Anchor::Left => ("start", false),
            Anchor::Middle => ("middle", false),
            Anchor::Right => ("end", false),
            Anchor::LeftCentre => ("start", true),
            Anchor::Centre => ("middle", true),
            Anchor::RightCentre => ("end", true),
        };
        let size = style.size.unwrap_or(TEXT_SIZE);
        let shift = if centred { 0.5 * CAPITAL_HEIGHT * size } else { 0.0 };
        self.text.push_str("<text");
        if style.rotation == 0.0 {
            let _ = write!(self.text, " x=\"{}\" y=\"{}\"", short(at.x), short(at.y + shift));
        } else {
            let (x, y, angle) = (short(at.x), short(at.y), short(-style.rotation));
            let _ =
                write!(self.text, " transform=\"translate({x} {y}) rotate({angle})\" y=\"{}\"", short(shift));
        }
        let (points, colour) = (short(size), style.colour);
        let _ = write!(self.text, " font-size=\"{points}\" text-anchor=\"{anchor}\" fill=\"{colour}\"");
        if let Some(halo) = style.halo {
            let width = short(0.3 * size);
            let _ = write!(
                self.text,
                " stroke=\"{halo}\" stroke-width=\"{width}\" stroke-linejoin=\"round\" paint-order=\"stroke\""
            );
        }
        // The renderers' default joins spaces; a label keeps the ones it has.
        self.text.push_str(" xml:space=\"preserve\">");
        let mut height = 0.0;
        for span in spans {
            let target = match span.level {
                Level::Base => 0.0,
                Level::Subscript => SUBSCRIPT_DROP * size,
                Level::Superscript => -SUPERSCRIPT_RISE * size,
            };
            self.text.push_str("<tspan");
            if (target - height) != 0.0 {
                let _ = write!(self.text, " dy=\"{}\"", short(target - height));
            }
            height = target;
            if span.level != Level::Base {
                let _ = write!(self.text, " font-size=\"{}\"", short(SCRIPT_SIZE * size));
            }
            if span.style == FontStyle::Italic {
                self.text.push_str(" font-style=\"italic\"");
            }
            let _ = write!(self.text, ">{}</tspan>", escaped(&span.text));
        }
        self.text.push_str("</text>\n");
        Ok(())
    }
}

/// An indexed image as PNG: one byte per pixel, each a colour with an opacity (0 to 255).
fn indexed(size: [usize; 2], pixels: &[u8], palette: &[(Colour, u8)]) -> Result<Vec<u8>, DrawError> {
    encode::png(size, pixels, |encoder| {
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_compression(png::Compression::High);
        encoder.set_palette(palette.iter().flat_map(|(c, _)| [c.red, c.green, c.blue]).collect::<Vec<_>>());
        if palette.iter().any(|(_, opacity)| *opacity < 255) {
            encoder.set_trns(palette.iter().map(|(_, opacity)| *opacity).collect::<Vec<_>>());
        }
    })
}

/// Place and size of a rectangle.
fn attributes(area: kurbo::Rect) -> String {
    let [x, y, width, height] = [area.x0, area.y0, area.width(), area.height()].map(short);
    format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
}

/// A path whose coordinates have at most three decimals.
pub(crate) fn rounded(path: &BezPath) -> BezPath {
    // Adding zero turns a negative zero into a plain one.
    let round = |length: f64| (length * 1000.0).round() / 1000.0 + 0.0;
    let point = |point: Point| Point::new(round(point.x), round(point.y));
    path.iter()
        .map(|element| match element {
            PathEl::MoveTo(end) => PathEl::MoveTo(point(end)),
            PathEl::LineTo(end) => PathEl::LineTo(point(end)),
            PathEl::QuadTo(control, end) => PathEl::QuadTo(point(control), point(end)),
            PathEl::CurveTo(first, second, end) => PathEl::CurveTo(point(first), point(second), point(end)),
            PathEl::ClosePath => PathEl::ClosePath,
        })
        .collect()
}

/// A length with at most three decimals: no printer resolves a thousandth of a point.
pub(crate) fn short(length: f64) -> String {
    let text = format!("{length:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_short() {
        assert_eq!(short(1.0), "1");
        assert_eq!(short(-0.0001), "0");
        assert_eq!(short(10.120_4), "10.12");
        assert_eq!(short(100.0), "100");
    }

    #[test]
    fn paths_are_rounded_and_those_that_are_not_finite_left_out() {
        let mut svg = Svg::new(10.0, 10.0);
        let style = Stroke::default().into();
        svg.path(&polyline([Point::new(-0.0001, 1.0), Point::new(2.000_04, 0.123_46)]), &style);
        svg.path(&polyline([Point::ZERO, Point::new(f64::NAN, 1.0)]), &style);
        svg.dots([Point::new(3.0, 4.0)], 1.5, Fill::from(Colour::GREY));
        let text = svg.finish();
        assert!(text.contains("d=\"M0,1 L2,0.123\"") && text.contains("d=\"M3,4 L3,4\""), "{text}");
        assert_eq!(text.matches("<path").count(), 2);
    }

    #[test]
    fn labels_return_to_the_baseline() {
        let mut svg = Svg::new(10.0, 10.0);
        let style = TextStyle::new(Anchor::Left).size(10.0);
        svg.label(&Label::new("$w_A < 1$"), Point::ZERO, style).expect("a good label");
        let text = svg.finish();
        assert!(text.contains("dy=\"2\"") && text.contains("dy=\"-2\""), "{text}");
        assert!(text.contains("&lt;"));
    }
}
