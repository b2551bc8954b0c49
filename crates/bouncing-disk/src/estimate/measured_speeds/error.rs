//! What can be wrong with a file of measured speeds. These errors are not among those of [`Error`], which can be copied and
//! compared: texts of a file can not.

use crate::error::Error;

/// The columns, the last of which may be missing.
pub(crate) const HEADER: &str = "time_s, speed_rad_s and, for repeated runs, member, or time and speed with other units, such as t (ms) and n (rpm)";

/// A fault in a file of measured speeds, with what to do about it. Lines and fields are counted from 1; texts of files are
/// shortened, and shown as they are escaped in Rust, so that none can disturb a terminal.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredSpeedsError {
    /// The system refuses, or what is there is no regular file or too large.
    #[error("{file:?} cannot be read")]
    Unreadable {
        /// The file.
        file: String,
        /// What was reported.
        source: std::io::Error,
    },
    /// The file is not text in UTF-8.
    #[error("{file:?}, line {line}: byte {byte} is not text in UTF-8; save the file as UTF-8")]
    NotText {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The byte in the line.
        byte: usize,
    },
    /// A line is longer than any of numbers.
    #[error("{file:?}, line {line}: it is longer than {most} bytes; end each line of numbers by a line end")]
    LongLine {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The most bytes of a line.
        most: usize,
    },
    /// There is no header.
    #[error("{file:?} is empty; a line must name the columns: {legal}", legal = HEADER)]
    Empty {
        /// The file.
        file: String,
    },
    /// A column has no unit that is known, or another one than the caller or the row below the header says.
    #[error(
        "{file:?}, line {line}, field {field}: the unit of the {name} is {unit:?} here; legal are {legal}, in the name, in \
         the row below it, or by the caller (--{name}-unit), and nowhere two that differ"
    )]
    Unit {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The field.
        field: usize,
        /// `time` or `speed`.
        name: &'static str,
        /// The unit found, shortened; empty where there is none.
        unit: String,
        /// The units that are known.
        legal: &'static str,
    },
    /// The decimal mark of the file is not clear.
    #[error(
        "{file:?}, line {line}, field {field}: the decimal mark of the file is not clear: {why}; write one decimal mark and \
         no separators of thousands"
    )]
    DecimalMarks {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The field.
        field: usize,
        /// What is not clear.
        why: &'static str,
    },
    /// A quotation mark begins a field and nothing ends it on the line.
    #[error(
        "{file:?}, line {line}, field {field}: a quotation mark is not closed on its line; close or remove it"
    )]
    OpenQuote {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The field.
        field: usize,
    },
    /// The header has a name that is not known.
    #[error(
        "{file:?}, line {line}, field {field}: there is no column {name:?}; legal are {legal}. Remove the column, put \
         a # before a line of remarks, or name the columns that count (--time-column, --speed-column)",
        legal = HEADER
    )]
    UnknownColumn {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The field.
        field: usize,
        /// The name found, shortened.
        name: String,
    },
    /// The header has a name twice.
    #[error(
        "{file:?}, line {line}, field {field}: the column {name:?} is there again; remove one of the two"
    )]
    RepeatedColumn {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The second field of the name.
        field: usize,
        /// The name.
        name: &'static str,
    },
    /// The header lacks a name.
    #[error("{file:?}, line {line}: the column {name:?} is missing; the header must have times and speeds")]
    MissingColumn {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The name.
        name: String,
    },
    /// A line has more or fewer fields than the header.
    #[error(
        "{file:?}, line {line}: it has {fields} fields where the header has {columns}; write numbers with a decimal \
         point, or separate the columns by semicolons"
    )]
    Fields {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// Fields of the line.
        fields: usize,
        /// Columns of the header.
        columns: usize,
    },
    /// A number is written with a decimal comma.
    #[error(
        "{file:?}, line {line}, field {field} ({name}): {value:?} has a decimal comma; write a decimal point"
    )]
    DecimalComma {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The field.
        field: usize,
        /// The name of the column.
        name: &'static str,
        /// The text of the field, shortened.
        value: String,
    },
    /// A field is no number, or none that is legal in its column.
    #[error("{file:?}, line {line}, field {field} ({name}): {value:?} is not legal; legal is {legal}")]
    NotLegal {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The field.
        field: usize,
        /// The name of the column.
        name: &'static str,
        /// The text of the field, shortened.
        value: String,
        /// The legal values.
        legal: &'static str,
    },
    /// A time does not rise within its run.
    #[error(
        "{file:?}, line {line}, field {field} (time_s): {time:?} follows {previous:?} in the run of member {member}; sort \
         the lines by time, remove repeated ones, or number the runs in a column member"
    )]
    NotRising {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The field.
        field: usize,
        /// The time (s).
        time: f64,
        /// The one before it in the run (s).
        previous: f64,
        /// The number of the run; 0 where there is only one.
        member: u32,
    },
    /// A run has too few lines.
    #[error(
        "{file:?}: the run of member {member} has {points} lines of numbers where {least} are needed; add lines, or remove \
         the run"
    )]
    TooFewPoints {
        /// The file.
        file: String,
        /// The number of the run; 0 where there is only one.
        member: u32,
        /// Its lines.
        points: usize,
        /// The fewest.
        least: usize,
    },
    /// There are more lines of numbers than are read.
    #[error("{file:?}, line {line}: there are more than {most} lines of numbers; average neighbouring ones")]
    TooLong {
        /// The file.
        file: String,
        /// The first line too many.
        line: usize,
        /// The most.
        most: usize,
    },
    /// An error of the model.
    #[error(transparent)]
    Model(#[from] Error),
}
