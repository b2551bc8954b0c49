//! Determines the decimal mark of a file of separated values: a point, or a comma if commas do not separate
//! columns.

use crate::csv_records::{NumberFault, number};
use crate::estimate::measured_speeds::error::{CsvFault, Located};

/// Evidence for the decimal mark, from the numbers of a file.
pub(crate) struct DecimalMarks {
    separator: char,
    /// Line and field of the first decimal point and of the first comma.
    point: Option<(usize, usize)>,
    comma: Option<(usize, usize)>,
    /// Whether a number shows that commas do not separate thousands.
    commas_are_decimal: bool,
}

impl DecimalMarks {
    /// No evidence yet, for a file whose columns are separated by this character.
    pub(crate) const fn new(separator: char) -> Self {
        Self { separator, point: None, comma: None, commas_are_decimal: false }
    }

    /// The number in a field, with a decimal mark that the separator allows.
    pub(crate) fn number(&self, field: &str) -> Result<f64, NumberFault> {
        let comma = self.separator != ',' && field.contains(',');
        if comma { number(&field.replacen(',', ".", 1)) } else { number(field) }
    }

    /// Records the decimal mark of a number.
    pub(crate) fn note(&mut self, line: usize, place: usize, text: &str) -> Result<(), Located> {
        if self.separator == ',' {
            return Ok(());
        }
        let here = Some((line, place + 1));
        if text.contains('.') {
            self.point = self.point.or(here);
        }
        let digits = text.trim_start_matches(['+', '-']);
        match digits.split_once(',') {
            Some((whole, part)) => {
                self.comma = self.comma.or(here);
                let may_be_thousand =
                    part.len() == 3 && (1..=3).contains(&whole.len()) && !whole.starts_with('0');
                self.commas_are_decimal |= !may_be_thousand;
            }
            None => {
                let is_whole = digits.bytes().all(|digit| digit.is_ascii_digit());
                self.commas_are_decimal |= is_whole && digits.len() > 3;
            }
        }
        if self.point.is_some() && self.comma.is_some() {
            let fault = CsvFault::DecimalMarks("its numbers contain both points and commas");
            return Err(Located(Some(line), Some(place + 1), fault));
        }
        Ok(())
    }

    /// Checks, after all numbers, that the mark is unambiguous.
    pub(crate) fn check(&self) -> Result<(), Located> {
        match (self.comma, self.commas_are_decimal) {
            (Some((line, field)), false) => {
                let fault = CsvFault::DecimalMarks("its commas may separate thousands");
                Err(Located(Some(line), Some(field), fault))
            }
            _ => Ok(()),
        }
    }
}
