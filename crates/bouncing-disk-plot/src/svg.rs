//! Writes SVG elements.

use std::fmt::Write as _;

use base64::Engine as _;

use crate::annotation::Anchor;
use crate::colour::Colour;
use crate::error::DrawError;
use crate::font::FAMILIES;
use crate::frame::Rect;
use crate::label::{Label, Level, SCRIPT_SIZE, Style};
use crate::stroke::Stroke;

/// An SVG document being written. Lengths are points.
#[derive(Debug)]
pub(crate) struct Svg {
    text: String,
    clips: usize,
}

/// How a label is set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TextStyle {
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    pub(crate) colour: Colour,
    /// Degrees, anticlockwise.
    pub(crate) rotation: f64,
    /// A rim around the letters that keeps them legible on a picture.
    pub(crate) halo: Option<Colour>,
}

impl TextStyle {
    pub(crate) fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, anchor, colour: Colour::BLACK, rotation: 0.0, halo: None }
    }
}

/// Heights in units of the font size: of capitals, for centring; of subscripts and superscripts.
const CAPITAL_HEIGHT: f64 = 0.66;
const SUBSCRIPT_DROP: f64 = 0.20;
const SUPERSCRIPT_RISE: f64 = 0.36;

impl Svg {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let (width, height) = (short(width), short(height));
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FAMILIES}\" fill=\"none\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
        );
        Self { text, clips: 0 }
    }

    pub(crate) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    /// Everything until [`Svg::end_clip`] shows only inside the rectangle.
    pub(crate) fn begin_clip(&mut self, area: Rect) {
        self.clips += 1;
        let number = self.clips;
        let (x, y, width, height) =
            (short(area.left), short(area.top), short(area.width), short(area.height));
        let _ = writeln!(
            self.text,
            "<clipPath id=\"clip{number}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/>\
             </clipPath>\n<g clip-path=\"url(#clip{number})\">"
        );
    }

    pub(crate) fn end_clip(&mut self) {
        self.text.push_str("</g>\n");
    }

    /// A path with a stroke, a fill, or both.
    pub(crate) fn path(&mut self, path: &str, stroke: Option<&Stroke>, fill: Option<(Colour, f64)>) {
        if path.is_empty() {
            return;
        }
        self.text.push_str("<path");
        if let Some((colour, opacity)) = fill {
            let _ = write!(self.text, " fill=\"{colour}\"");
            if opacity < 1.0 {
                let _ = write!(self.text, " fill-opacity=\"{}\"", short(opacity));
            }
        }
        if let Some(stroke) = stroke {
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
        let _ = writeln!(self.text, " d=\"{path}\"/>");
    }

    pub(crate) fn rectangle(&mut self, area: Rect, stroke: Option<&Stroke>, fill: Option<(Colour, f64)>) {
        self.path(&rectangle_path(area), stroke, fill);
    }

    /// An image stretched over a rectangle. `sharp` shows its cells as squares.
    pub(crate) fn image(&mut self, area: Rect, png: &[u8], sharp: bool) {
        let data = base64::engine::general_purpose::STANDARD.encode(png);
        let (x, y, width, height) =
            (short(area.left), short(area.top), short(area.width), short(area.height));
        let style = if sharp { " style=\"image-rendering:pixelated\"" } else { "" };
        let _ = writeln!(
            self.text,
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\"{style} \
             href=\"data:image/png;base64,{data}\"/>"
        );
    }

    /// A label whose baseline (or middle) is at `(x, y)`.
    pub(crate) fn label(
        &mut self,
        label: &Label,
        (x, y): (f64, f64),
        style: TextStyle,
    ) -> Result<(), DrawError> {
        let spans = label.spans()?;
        if label.is_empty() {
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
        let shift = if centred { 0.5 * CAPITAL_HEIGHT * style.size } else { 0.0 };
        let (size, colour) = (short(style.size), style.colour);
        self.text.push_str("<text");
        if style.rotation == 0.0 {
            let _ = write!(self.text, " x=\"{}\" y=\"{}\"", short(x), short(y + shift));
        } else {
            let angle = short(-style.rotation);
            let (x, y, shift) = (short(x), short(y), short(shift));
            let _ = write!(self.text, " transform=\"translate({x} {y}) rotate({angle})\" y=\"{shift}\"");
        }
        let _ = write!(self.text, " font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{colour}\"");
        if let Some(halo) = style.halo {
            let width = short(0.3 * style.size);
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
                Level::Subscript => SUBSCRIPT_DROP * style.size,
                Level::Superscript => -SUPERSCRIPT_RISE * style.size,
            };
            self.text.push_str("<tspan");
            if (target - height) != 0.0 {
                let _ = write!(self.text, " dy=\"{}\"", short(target - height));
            }
            height = target;
            if span.level != Level::Base {
                let _ = write!(self.text, " font-size=\"{}\"", short(SCRIPT_SIZE * style.size));
            }
            match span.style {
                Style::Roman => {}
                Style::Italic => self.text.push_str(" font-style=\"italic\""),
                Style::Bold => self.text.push_str(" font-weight=\"bold\""),
            }
            let _ = write!(self.text, ">{}</tspan>", escaped(&span.text));
        }
        self.text.push_str("</text>\n");
        Ok(())
    }
}

/// The outline of a rectangle as path data.
pub(crate) fn rectangle_path(area: Rect) -> String {
    let (x, y) = (short(area.left), short(area.top));
    let (width, height) = (short(area.width), short(area.height));
    format!("M{x} {y}h{width}v{height}h-{width}z")
}

/// A circle as path data.
pub(crate) fn circle_path(path: &mut String, (x, y): (f64, f64), radius: f64) {
    ellipse_path(path, (x, y), radius, radius);
}

/// An upright ellipse as path data.
pub(crate) fn ellipse_path(path: &mut String, (x, y): (f64, f64), across: f64, down: f64) {
    let (left, y) = (short(x - across), short(y));
    let (half, back) = (short(2.0 * across), short(-2.0 * across));
    let (across, down) = (short(across), short(down));
    let _ = write!(path, "M{left} {y}a{across} {down} 0 1 0 {half} 0a{across} {down} 0 1 0 {back} 0z");
}

/// Starts a new part of a path at a point.
pub(crate) fn move_to(path: &mut String, (x, y): (f64, f64)) {
    let _ = write!(path, "M{} {}", short(x), short(y));
}

/// A straight part of a path.
pub(crate) fn line_to(path: &mut String, (x, y): (f64, f64)) {
    let _ = write!(path, "L{} {}", short(x), short(y));
}

/// A length with at most three decimals: a thousandth of a point is far below any printer.
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
    fn labels_return_to_the_baseline() {
        let mut svg = Svg::new(10.0, 10.0);
        let style = TextStyle::new(10.0, Anchor::Left);
        svg.label(&Label::new("$w_A < 1$"), (0.0, 0.0), style).expect("a good label");
        let text = svg.finish();
        assert!(text.contains("dy=\"2\"") && text.contains("dy=\"-2\""), "{text}");
        assert!(text.contains("&lt;"));
    }
}
