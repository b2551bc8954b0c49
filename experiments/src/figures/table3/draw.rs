//! The drawing of Table III.

use bouncing_disk_plot::{Figure, Label, ruled_table};

use super::data::Table3Data;

pub(super) fn draw(data: &Table3Data) -> Figure {
    let header =
        ["", "unit", "printed", r"$g$ as printed", r"70 is $\omega/2\pi$ in kHz", "from"].map(Label::new);
    let inputs = data.inputs.iter().map(|input| {
        vec![
            Label::new(&input.label),
            Label::plain(&input.unit),
            Label::plain(&input.printed),
            Label::plain(&shown(input.values[0])),
            Label::plain(&shown(input.values[1])),
            Label::plain(if input.known { "known input" } else { "estimated input" }),
        ]
    });
    let derived = data.derived.iter().map(|row| {
        vec![
            Label::new(&row.label),
            Label::plain(&row.unit),
            Label::plain(""),
            Label::plain(&shown(row.values[0])),
            Label::plain(&shown(row.values[1])),
            Label::new(&row.origin),
        ]
    });
    let rows: Vec<Vec<Label>> = inputs.chain(derived).collect();
    ruled_table(&header, &rows)
}

/// Four digits, with a power of ten where the number is large or small.
pub(super) fn shown(value: f64) -> String {
    if value.abs() > 0.0 && !(1e-2..1e4).contains(&value.abs()) {
        let text = format!("{value:.3e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        let power: String = power.chars().map(superscript).collect();
        if digits == "1" { format!("10{power}") } else { format!("{digits} × 10{power}") }
    } else {
        let decimals = if value.abs() >= 100.0 {
            1
        } else if value.abs() >= 10.0 {
            2
        } else {
            3
        };
        let text = format!("{value:.decimals$}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

fn superscript(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => other.to_digit(10).and_then(|digit| char::from_u32('⁰' as u32 + digit)).unwrap_or(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_with_four_digits() {
        for (value, text) in [
            (1e-8, "10⁻⁸"),
            (4.398e5, "4.398 × 10⁵"),
            (0.0, "0"),
            (9.8, "9.8"),
            (123.456, "123.5"),
            (1.25, "1.25"),
        ] {
            assert_eq!(shown(value), text);
        }
    }
}
