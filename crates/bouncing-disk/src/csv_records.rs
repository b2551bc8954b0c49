//! The records of a file of separated values with their line numbers, whatever the columns mean.
//!
//! It also accepts a byte-order mark, line ends of either kind, blank lines, lines that begin with `#`, `%`
//! or `//`, and blanks and one pair of double quotes around a field.

/// An error in the format of a file. Lines, bytes and fields are counted from 1.
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
    /// A quotation mark begins a field but is not closed on the line.
    #[error("line {line}, field {field}: a quotation mark is not closed on its line")]
    OpenQuote {
        /// The line.
        line: usize,
        /// The field.
        field: usize,
    },
}

/// The text of a file, without its byte-order mark.
///
/// # Errors
///
/// [`RecordFault::NotText`] states the position of the first byte that is not UTF-8.
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

/// The lines of a file that are neither blank nor comments, with their numbers.
pub fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let is_remark =
        |line: &str| ["#", "%", "//", "\"#"].iter().any(|mark| line.trim_start().starts_with(mark));
    let is_blank = |line: &str| plain(line).is_empty();
    (1..).zip(text.lines()).filter(move |(_, line)| !is_blank(line) && !is_remark(line))
}

/// The [`plain`] fields of a line; separators between a quotation mark at the beginning of a field and the next
/// quotation mark do not count.
///
/// # Errors
///
/// [`RecordFault::OpenQuote`].
pub fn fields(line: (usize, &str), separator: char) -> Result<Vec<&str>, RecordFault> {
    let (line, mut rest) = line;
    let mut fields = Vec::new();
    loop {
        let start = rest.len() - rest.trim_start_matches([' ', '\u{a0}']).len();
        let protected = match rest[start..].strip_prefix('"') {
            None => 0,
            Some(quoted) => {
                let end = quoted.find('"').ok_or(RecordFault::OpenQuote { line, field: fields.len() + 1 })?;
                start + 1 + end + 1
            }
        };
        match rest[protected..].find(separator) {
            Some(place) => {
                fields.push(plain(&rest[..protected + place]));
                rest = &rest[protected + place + separator.len_utf8()..];
            }
            None => {
                fields.push(plain(rest));
                return Ok(fields);
            }
        }
    }
}

/// A field without the blanks and the quotation marks around it.
#[must_use]
pub fn plain(field: &str) -> &str {
    let field = field.trim();
    let unquoted = field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    unquoted.unwrap_or(field).trim()
}

/// Why a field does not contain a usable number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NumberFault {
    /// The field is not a number; "inf" and "NaN" are not accepted.
    #[error("not a number")]
    NotANumber,
    /// The number is too large for a finite double, or so small that the nearest double is 0.
    #[error("a number that is too large or too small for a double")]
    NoSuchDouble,
}

/// The finite number that a [`plain`] field states. A zero is positive, whatever its sign.
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
        let text = "# of May\n\n% mine\na,b\r\n  // mine\n1,\"2\n";
        let mut lines = lines(text);
        let header = lines.next().expect("a header");
        assert_eq!((header.0, fields(header, ',').expect("well formed")), (4, vec!["a", "b"]));
        let fault = fields(lines.next().expect("a row"), ',').expect_err("not closed").to_string();
        assert_eq!(fault, "line 6, field 2: a quotation mark is not closed on its line");
        assert_eq!(lines.next(), None);
        assert_eq!(fields((1, "\"1,5\" ;; 2,5;"), ';').expect("well formed"), ["1,5", "", "2,5", ""]);
    }
}
