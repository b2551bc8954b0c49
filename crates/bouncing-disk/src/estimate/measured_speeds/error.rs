//! The errors of files of measured speeds.

use crate::csv_records::RecordFault;
use crate::error::Error;

/// The columns, the last of which is optional.
pub(crate) const HEADER: &str = "time_s, speed_rad_s and, for repeated runs, member, or time and speed with other units, such as t (ms) and n (rpm)";

/// Why measured speeds cannot be read from a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredSpeedsError {
    /// The file cannot be opened or read, is not a regular file, or is too large.
    #[error("{file:?} cannot be read")]
    Unreadable {
        /// The file.
        file: String,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The text is malformed. Lines and fields are counted from 1.
    #[error("{}", located(file, *line, *field, fault))]
    Malformed {
        /// The file.
        file: String,
        /// The line; `None` for a fault of the whole file.
        line: Option<usize>,
        /// The field; `None` for a fault of the whole line.
        field: Option<usize>,
        /// The fault, and how to correct it.
        fault: CsvFault,
    },
    /// An error of the model.
    #[error(transparent)]
    Model(#[from] Error),
}

fn located(file: &str, line: Option<usize>, field: Option<usize>, fault: &CsvFault) -> String {
    let line = line.map(|line| format!(", line {line}")).unwrap_or_default();
    let field = field.map(|field| format!(", field {field}")).unwrap_or_default();
    format!("{file:?}{line}{field}: {fault}")
}

/// A fault in the text of a file of measured speeds. Excerpts of the file are shortened, and escaped as in
/// Rust, so that they cannot disturb a terminal.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CsvFault {
    /// A byte is not valid UTF-8.
    #[error("byte {0} is not text in UTF-8; save the file as UTF-8")]
    NotText(usize),
    /// A line is longer than this number of bytes.
    #[error("the line is longer than {0} bytes; end each row of numbers with a line break")]
    LongLine(usize),
    /// The file contains only comments.
    #[error("the file is empty; its first line must name the columns: {HEADER}")]
    Empty,
    /// A column has no known unit, or not the one stated by the caller or the row below the header.
    #[error(
        "the unit of the {name} is {unit:?} here; legal units are {legal}. State the same unit in the name of the \
         column, in the row below it, or when you read the file"
    )]
    Unit {
        /// `time` or `speed`.
        name: &'static str,
        /// The unit found; empty if there is none.
        unit: String,
        /// The known units.
        legal: &'static str,
    },
    /// The decimal mark of the file is ambiguous, for this reason.
    #[error(
        "the decimal mark of the file is ambiguous: {0}; write one decimal mark and no thousands separators"
    )]
    DecimalMarks(&'static str),
    /// A quotation mark that begins a field is not closed on the line.
    #[error("a quotation mark is not closed on its line; close or remove it")]
    OpenQuote,
    /// The first line contains numbers instead of the names of columns.
    #[error(
        "the header line is missing: this line already contains numbers; add a line before it that names the \
         columns, for instance time_s,speed_rad_s"
    )]
    NoHeader,
    /// The header contains an unknown name.
    #[error(
        "the column {0:?} is unknown; legal columns are {HEADER}. Remove the column, begin a remark with #, or \
         name the columns of times and speeds when you read the file"
    )]
    UnknownColumn(String),
    /// The header of a table of points contains an unknown name or lacks the speed, or a field below it is not a
    /// number.
    #[error(
        "{0}; a table of points has the columns speed_rad_s (or speed (rpm), ...), speed_error, and fields of the \
         data sheet in its units, such as load_torque, stator.volts or preload_force; each may have an error, such \
         as load_torque_error"
    )]
    Points(String),
    /// The header contains a name twice.
    #[error("the column {0:?} occurs twice; remove one of the two")]
    RepeatedColumn(&'static str),
    /// The header lacks a name.
    #[error("the column {0:?} is missing; the header must have times and speeds")]
    MissingColumn(String),
    /// A line has more or fewer fields than the header.
    #[error(
        "the line has {fields} fields, but the header has {columns}; write numbers with a decimal point, or \
         separate the columns by semicolons"
    )]
    Fields {
        /// Number of fields in the line.
        fields: usize,
        /// Number of columns in the header.
        columns: usize,
    },
    /// A number is written with a decimal comma.
    #[error("{value:?} in the column {name} has a decimal comma; write a decimal point")]
    DecimalComma {
        /// The name of the column.
        name: &'static str,
        /// The text of the field.
        value: String,
    },
    /// A field is not a number, or its number is not legal in this column.
    #[error("{value:?} is not legal in the column {name}; it must be {legal}")]
    NotLegal {
        /// The name of the column.
        name: &'static str,
        /// The text of the field.
        value: String,
        /// The legal values.
        legal: &'static str,
    },
    /// A time does not rise within its run.
    #[error(
        "time_s = {time:?} follows {previous:?} in the run of member {member}; sort the lines by time, remove repeated \
         ones, or number the runs in a column member"
    )]
    NotRising {
        /// The time (s).
        time: f64,
        /// The previous time in the run (s).
        previous: f64,
        /// The number of the run; 0 if there is only one.
        member: u32,
    },
    /// A run has too few lines.
    #[error(
        "the run of member {member} has {points} lines of numbers, but {least} are needed; add lines, or remove the run"
    )]
    TooFewPoints {
        /// The number of the run; 0 if there is only one.
        member: u32,
        /// Number of its lines.
        points: usize,
        /// Fewest lines of a run.
        least: usize,
    },
    /// The file has more than this number of rows.
    #[error("there are more than {0} lines of numbers; average neighbouring ones")]
    TooLong(usize),
}

/// A fault and its position: line and field, counted from 1.
pub(crate) struct Located(pub(crate) Option<usize>, pub(crate) Option<usize>, pub(crate) CsvFault);

impl Located {
    pub(crate) fn in_file(self, file: &str) -> MeasuredSpeedsError {
        let Self(line, field, fault) = self;
        MeasuredSpeedsError::Malformed { file: file.to_owned(), line, field, fault }
    }
}

impl From<RecordFault> for Located {
    fn from(fault: RecordFault) -> Self {
        match fault {
            RecordFault::NotText { line, byte } => Self(Some(line), None, CsvFault::NotText(byte)),
            RecordFault::OpenQuote { line, field } => Self(Some(line), Some(field), CsvFault::OpenQuote),
        }
    }
}
