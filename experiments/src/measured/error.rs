//! What can be wrong with a file of measurements.

use bouncing_disk::csv_records::RecordFault;

use super::layout::Range;
use crate::visible::{Excerpt, visible};

/// A fault in a file of measurements. Lines and columns are counted from 1.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredError {
    /// The system refuses to give the file.
    #[error("{file} cannot be read")]
    Unreadable {
        /// The file.
        file: String,
        /// What the system reported.
        source: std::sync::Arc<std::io::Error>,
    },
    /// No figure reads a file of this name.
    #[error("no figure reads a file called {}; legal names are {}", visible(file), legal.join(", "))]
    UnknownFile {
        /// The file.
        file: String,
        /// The names that are read.
        legal: Vec<&'static str>,
    },
    /// No figure reads these files, either, which are too many to name.
    #[error("no figure reads {files} more files; legal names are {}", legal.join(", "))]
    UnknownFiles {
        /// How many they are.
        files: usize,
        /// The names that are read.
        legal: Vec<&'static str>,
    },
    /// The file is a table of a newer program.
    #[error(transparent)]
    Newer(Box<bouncing_disk::StorageError>),
    /// The file has no records, whatever its columns.
    #[error("{file}, {fault}")]
    Form {
        /// The file.
        file: &'static str,
        /// The fault, with its line.
        fault: RecordFault,
    },
    /// There is no header.
    #[error("{file} is empty; its first line must be {legal}")]
    Empty {
        /// The file.
        file: &'static str,
        /// The header.
        legal: String,
    },
    /// A line is not what the layout says.
    #[error("{file}, line {line}{}: {fault}", column_words(*.column))]
    Line {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The column and its name, where the fault is in one, and in one of the layout.
        column: Option<(usize, &'static str)>,
        /// What is wrong.
        fault: LineFault,
    },
    /// The numbers are legal, but what the figure computes from them is not defined.
    #[error("{file}: {what} cannot be evaluated")]
    Unusable {
        /// The file.
        file: &'static str,
        /// Which of its points.
        what: String,
        /// What was reported.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

/// What is wrong with a line, beside what would be legal.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LineFault {
    /// The columns are not separated by commas but by the first; the header.
    #[error("columns are separated by {0}; legal is a comma, as in {1}")]
    Separator(&'static str, String),
    /// The header has a name that is not known; the header.
    #[error("the header has {0}; legal is {1}")]
    UnknownColumn(Excerpt, String),
    /// The header has a name twice.
    #[error("the header has \"{0}\" again")]
    RepeatedColumn(&'static str),
    /// The header lacks a name; the header.
    #[error("the header has no column \"{0}\"; legal is {1}")]
    MissingColumn(&'static str, String),
    /// A line has more or fewer fields than the header.
    #[error("the line has {0} fields; legal is {1}")]
    Fields(usize, usize),
    /// A field is not a number.
    #[error("{0} is not a number; legal is {1}")]
    NotANumber(Excerpt, Range),
    /// A number is outside its legal range, or so large or small that there is no such double.
    #[error("{value} is not legal; legal is {1}", value = .0.bare())]
    OutOfRange(Excerpt, Range),
    /// A number is in the range of its column, but the figure has no place for it.
    #[error("{0} is not legal; legal is {1}")]
    NotOfFigure(f64, String),
    /// A time does not rise.
    #[error("{value} follows {previous}; legal is a larger number on every line{}", trial_words(*.trial))]
    NotRising {
        /// The number.
        value: f64,
        /// The one before it.
        previous: f64,
        /// The trial, where there are trials.
        trial: Option<u32>,
    },
    /// A quantity changes within a trial.
    #[error("{value} follows {previous}; legal is the same number on every line{}", trial_words(*.trial))]
    NotConstant {
        /// The number.
        value: f64,
        /// The one before it.
        previous: f64,
        /// The trial, where there are trials.
        trial: Option<u32>,
    },
    /// There are more lines of numbers than a picture can show.
    #[error("the file has more than {0} lines of numbers; legal are {0} or fewer")]
    TooLong(usize),
    /// There are too few lines of numbers.
    #[error("the file ends after {0} lines of numbers; legal is {1} or more")]
    TooShort(usize, usize),
}

fn column_words(column: Option<(usize, &str)>) -> String {
    match column {
        None => String::new(),
        Some((column, "")) => format!(", column {column}"),
        Some((column, name)) => format!(", column {column} ({name})"),
    }
}

fn trial_words(trial: Option<u32>) -> String {
    trial.map_or_else(String::new, |trial| format!(" of trial {trial}"))
}
