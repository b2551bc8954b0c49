//! A table as the journal sets it: columns of text between three rules.

use crate::colour::Colour;
use crate::drawing::Drawing;
use crate::figure::Figure;
use crate::frame::Rect;
use crate::label::Label;
use crate::path::Path;
use crate::style::{Anchor, Stroke};
use crate::svg::TEXT_SIZE;

/// Lengths in points.
const ROW: f64 = 14.0;
const GAP: f64 = 18.0;
const MARGIN: f64 = 10.0;

/// A figure that shows a table. Columns are as wide as their longest cell; a row may be shorter than the
/// header.
pub fn ruled_table(header: &[Label], rows: &[Vec<Label>]) -> Figure {
    let widths: Vec<f64> = header
        .iter()
        .enumerate()
        .map(|(column, name)| {
            let cells = rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.width(TEXT_SIZE)).fold(name.width(TEXT_SIZE), f64::max)
        })
        .collect();
    let inner = widths.iter().sum::<f64>() + GAP * widths.len() as f64;
    let (width, height) = (inner + 2.0 * MARGIN, ROW * (rows.len() as f64 + 1.4) + 2.0 * MARGIN);
    let mut drawing = Drawing::new(Rect::new(0.0, 0.0, width, height), (0.0, width), (height, 0.0));
    let rule = |y: f64| Path::through([(MARGIN, y), (width - MARGIN, y)]);
    let below_header = MARGIN + 1.2 * ROW;
    for y in [MARGIN, MARGIN + 2.0, below_header, height - MARGIN - 2.0, height - MARGIN] {
        drawing = drawing.stroke(rule(y), Stroke::new(Colour::BLACK, 0.5));
    }
    let lines = std::iter::once(header).chain(rows.iter().map(Vec::as_slice));
    for (index, cells) in lines.enumerate() {
        let y = if index == 0 { MARGIN + 0.65 * ROW } else { below_header + ROW * (index as f64 - 0.45) };
        let mut x = MARGIN + 0.5 * GAP;
        for (cell, width) in cells.iter().zip(&widths) {
            drawing = drawing.text((x, y), Anchor::LeftCentre, cell.clone());
            x += width + GAP;
        }
    }
    Figure::new(width, height).drawing(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_cells_are_shown() {
        let header = [Label::new("parameter"), Label::new(r"$\epsilon$")];
        let rows = vec![vec![Label::new("amplitude"), Label::new(r"$10^{-8}$ m")], vec![Label::new("alone")]];
        let figure = ruled_table(&header, &rows);
        assert!(figure.to_png().expect("draws").starts_with(b"\x89PNG"));
        let svg = figure.to_svg().expect("draws");
        for text in ["STIX Two Text", "parameter", "ε", "amplitude", "−8", "alone"] {
            assert!(svg.contains(text), "{text}");
        }
    }
}
