//! The records of a file of comma-separated values and the lines they are on, whatever the columns mean.
//!
//! Accepted besides the plain form: a byte-order mark, line ends of either kind, blank lines, lines that
//! begin with `#`, blanks and one pair of double quotes around a field.

use std::io::{self, Chain, Read};

use csv::{Reader, ReaderBuilder, StringRecord, Terminator};

/// A fault of the form alone. Lines, bytes and fields are counted from 1.
#[derive(Debug, thiserror::Error)]
pub enum RecordFault {
    /// The file is not text in UTF-8.
    #[error("line {line}, byte {byte}: not text in UTF-8")]
    NotText {
        /// The line.
        line: usize,
        /// The byte in the line.
        byte: usize,
    },
    /// A quotation mark begins a field and nothing ends it on the line.
    #[error("line {line}, field {field}: a quotation mark is not closed on its line")]
    OpenQuote {
        /// The line.
        line: usize,
        /// The field.
        field: usize,
    },
    /// What the reader of records reports otherwise.
    #[error(transparent)]
    Unreadable(#[from] io::Error),
}

/// The text of a file, without its byte-order mark.
///
/// # Errors
///
/// [`RecordFault::NotText`] says where the first byte is that is none of UTF-8.
pub fn text(bytes: &[u8]) -> Result<&str, RecordFault> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line_start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |place| place + 1);
        RecordFault::NotText {
            line: before.iter().filter(|byte| **byte == b'\n').count() + 1,
            byte: before.len() - line_start + 1,
        }
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// The lines of a file that are neither blank nor a remark.
#[derive(Debug)]
pub struct Records<'a> {
    text: &'a str,
    reader: Reader<Chain<&'a [u8], &'static [u8]>>,
    record: StringRecord,
}

impl<'a> Records<'a> {
    /// Those of a [`text`].
    #[must_use]
    pub fn new(text: &'a str) -> Self {
        let reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .terminator(Terminator::Any(b'\n'))
            // The last line may lack its end; of two ends in a row the second makes a blank line.
            .from_reader(text.as_bytes().chain(b"\n".as_slice()));
        Self { text, reader, record: StringRecord::new() }
    }

    /// Goes to the next record and says on which line it is; `None` at the end.
    ///
    /// # Errors
    ///
    /// [`RecordFault::OpenQuote`]; what the reader reports.
    pub fn advance(&mut self) -> Result<Option<usize>, RecordFault> {
        let Self { text, reader, record } = self;
        while reader.read_record(record).map_err(io::Error::from)? {
            if let Some(place) = record.iter().position(|field| field.contains('\n')) {
                return Err(RecordFault::OpenQuote { line: first_line(record, text), field: place + 1 });
            }
            let first = record.get(0).unwrap_or_default().trim();
            if !first.starts_with('#') && (record.len() > 1 || !first.is_empty()) {
                // The record, which is one line, has just been read with its end.
                return Ok(Some((reader.position().line() as usize).saturating_sub(1)));
            }
        }
        Ok(None)
    }

    /// The record that [`Self::advance`] went to.
    #[must_use]
    pub const fn record(&self) -> &StringRecord {
        &self.record
    }
}

/// The line on which a record begins. Its own position is that of the empty lines and remarks before it.
fn first_line(record: &StringRecord, text: &str) -> usize {
    let line = record.position().map_or(1, |position| position.line() as usize);
    let before = text.split('\n').skip(line.saturating_sub(1));
    line + before.take_while(|line| line.is_empty() || line.starts_with('#')).count()
}

/// A field without the blanks around it. The reader sees a quotation mark only where a field begins with it.
#[must_use]
pub fn plain(field: &str) -> &str {
    let field = field.trim();
    let unquoted = field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    unquoted.unwrap_or(field).trim()
}

/// Why a field states no number that can be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NumberFault {
    /// It is not written as a number; "inf" and "NaN" are not.
    #[error("not a number")]
    NotANumber,
    /// It is written as one, but so large that it is no finite double, or so small that 0 is the nearest.
    #[error("a number that is too large or too small for a double")]
    NoSuchDouble,
}

/// The finite number that a [`plain`] field states. The sign of a zero means nothing: it is positive.
///
/// # Errors
///
/// [`NumberFault`].
pub fn number(text: &str) -> Result<f64, NumberFault> {
    let number: f64 = text.parse().map_err(|_| NumberFault::NotANumber)?;
    let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
    if !number.is_finite() {
        let has_digits = mantissa.contains(|sign: char| sign.is_ascii_digit());
        return Err(if has_digits { NumberFault::NoSuchDouble } else { NumberFault::NotANumber });
    }
    // 1e-400 is not 0, though the nearest double is.
    if number == 0.0 && mantissa.contains(|digit: char| ('1'..='9').contains(&digit)) {
        return Err(NumberFault::NoSuchDouble);
    }
    Ok(number + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_finite_and_zero_only_where_zero_is_written() {
        for (text, value) in
            [("0", 0.0_f64), ("-0", 0.0), ("0e999", 0.0), ("-0.0e-999", 0.0), ("5e-324", 5e-324)]
        {
            assert_eq!(number(text).map(f64::to_bits), Ok(value.to_bits()), "{text}");
        }
        for text in ["1e999", "-1e400", "1e-400", "0.0001e-999"] {
            assert_eq!(number(text), Err(NumberFault::NoSuchDouble), "{text}");
        }
        for text in ["", "inf", "-Infinity", "NaN", "nan", "1,5", "1 2", "0x10", "e5", "\u{2212}1"] {
            assert_eq!(number(text), Err(NumberFault::NotANumber), "{text}");
        }
    }

    #[test]
    fn faults_of_the_form_are_placed() {
        let fault = text(b"\xef\xbb\xbfa,b\n1,\xb5").expect_err("not UTF-8").to_string();
        assert_eq!(fault, "line 2, byte 3: not text in UTF-8");
        assert_eq!(text("\u{feff}a".as_bytes()).expect("text"), "a");
        let mut records = Records::new("# of May\n\na,b\r\n  # mine\n1,\"2\n");
        assert_eq!(records.advance().expect("well formed"), Some(3));
        assert_eq!(records.record().iter().map(plain).collect::<Vec<_>>(), ["a", "b"]);
        let fault = records.advance().expect_err("not closed").to_string();
        assert_eq!(fault, "line 5, field 2: a quotation mark is not closed on its line");
        assert_eq!(Records::new("\n#\n").advance().expect("nothing"), None);
    }
}
