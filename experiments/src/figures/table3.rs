//! Table III: the default motor in both readings of its last column, and what the entries were computed from.

mod data;
mod derived;
mod statements;

pub use data::Table3Data;

use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::{Cell, Table};
use bouncing_disk_plot::{Figure, Label, ruled_table};

/// Table III.
#[derive(Debug)]
pub struct Table3;

impl Experiment for Table3 {
    type Data = Table3Data;
    const ID: &'static str = "table3";
    const TITLE: &'static str = "Default values for the dimensional parameters";
    const READING: &str = include_str!("table3/reading.md");

    fn caption(data: &Table3Data) -> String {
        format!(
            "The default motor. Sec. V A announces {} inputs, the table prints {}: a column for ω is missing, and its \
             last column can be read in two ways, both computed here: g = {} m/s² as printed, or ω/2π = {} kHz with \
             gravity for g. ω is 2π × {} kHz in both. Below the nine inputs: what follows from \
             them. The load torque that stalls the motor is found by bisection on the sign of the mean speed, {} members over {} rise times each; the paper takes \
             α̇_ss/t_c for it.",
            data.inputs.len(),
            data.printed_inputs,
            data.printed_preload_acceleration_m_per_s2,
            data.frequency_khz,
            data.frequency_khz,
            data.stalls[1].members,
            data.stalls[1].rises,
        )
    }

    fn run(quality: Quality, _: &dyn Progress) -> Result<Table3Data, ExperimentError> {
        derived::compute(quality)
    }

    fn draw(data: &Table3Data) -> Result<Figure, ExperimentError> {
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
        Ok(ruled_table(&header, &rows))
    }

    fn claims(data: &Table3Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Table3Data) -> Vec<(String, String)> {
        let drop = &data.drop;
        let mut parameters: Vec<_> = data
            .inputs
            .iter()
            .map(|input| {
                (
                    input.symbol.clone(),
                    format!("{} {}", shown(input.values[1]), input.unit).trim_end().to_owned(),
                )
            })
            .collect();
        parameters.push(("height of the drop".to_owned(), format!("{} m", drop.heights.drop_height_m)));
        parameters.push(("height of the rebound".to_owned(), format!("{} m", drop.heights.rebound_height_m)));
        parameters
    }

    fn table(data: &Table3Data) -> Option<Table> {
        let mut table =
            Table::new(["quantity", "unit", "printed", "g as printed", "70 read as frequency in kHz"]);
        for input in &data.inputs {
            table.push([
                Cell::from(input.symbol.as_str()),
                Cell::from(input.unit.as_str()),
                Cell::from(input.printed.as_str()),
                input.values[0].into(),
                input.values[1].into(),
            ]);
        }
        for row in &data.derived {
            table.push([
                Cell::from(row.symbol.as_str()),
                Cell::from(row.unit.as_str()),
                Cell::Empty,
                row.values[0].into(),
                row.values[1].into(),
            ]);
        }
        Some(table)
    }
}

/// Four digits, with a power of ten where the number is large or small.
fn shown(value: f64) -> String {
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
