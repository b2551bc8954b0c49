//! What can be wrong with a file of measurements.

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
    /// The file is not text in UTF-8.
    #[error("{file}, line {line}, byte {byte}: not text in UTF-8")]
    NotText {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The byte in the line.
        byte: usize,
    },
    /// There is no header.
    #[error("{file} is empty; its first line must be {legal}")]
    Empty {
        /// The file.
        file: &'static str,
        /// The header.
        legal: String,
    },
    /// The columns are not separated by commas.
    #[error("{file}, line {line}: columns are separated by {found}; legal is a comma, as in {legal}")]
    Separator {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// What separates them.
        found: &'static str,
        /// The header.
        legal: String,
    },
    /// A quotation mark begins a field and nothing ends it on the line.
    #[error("{file}, line {line}, column {column}: a quotation mark is not closed on its line")]
    OpenQuote {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The column of the field.
        column: usize,
    },
    /// The header has a name that is not known.
    #[error("{file}, line {line}, column {column}: the header has {value}; legal is {legal}")]
    UnknownColumn {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The name found.
        value: Excerpt,
        /// The header.
        legal: String,
    },
    /// The header has a name twice.
    #[error("{file}, line {line}, column {column}: the header has \"{name}\" again")]
    RepeatedColumn {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The second column of the name.
        column: usize,
        /// The name.
        name: &'static str,
    },
    /// The header lacks a name.
    #[error("{file}, line {line}: the header has no column \"{name}\"; legal is {legal}")]
    MissingColumn {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The name.
        name: &'static str,
        /// The header.
        legal: String,
    },
    /// A line has more or fewer fields than the header.
    #[error("{file}, line {line}, column {column}: the line has {fields} fields; legal is {columns}")]
    Fields {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The first column that is missing or too much.
        column: usize,
        /// The fields of the line.
        fields: usize,
        /// The columns of the header.
        columns: usize,
    },
    /// A field is not a number.
    #[error("{file}, line {line}, column {column} ({name}): {value} is not a number; legal is {legal}")]
    NotANumber {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The name of the column.
        name: &'static str,
        /// The text of the field.
        value: Excerpt,
        /// The legal values.
        legal: Range,
    },
    /// A number is outside its legal range, or so large or small that there is no such double.
    #[error("{file}, line {line}, column {column} ({name}): {} is not legal; legal is {legal}", value.bare())]
    OutOfRange {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The name of the column.
        name: &'static str,
        /// The number as it is written.
        value: Excerpt,
        /// The legal values.
        legal: Range,
    },
    /// A number is in the range of its column, but the figure has no place for it.
    #[error("{file}, line {line}, column {column} ({name}): {value} is not legal; legal is {legal}")]
    NotOfFigure {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The name of the column.
        name: &'static str,
        /// The number.
        value: f64,
        /// The legal values.
        legal: String,
    },
    /// A time does not rise.
    #[error(
        "{file}, line {line}, column {column} ({name}): {value} follows {previous}; legal is a larger number on \
         every line{}", trial_words(*.trial)
    )]
    NotRising {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The name of the column.
        name: &'static str,
        /// The number.
        value: f64,
        /// The one before it.
        previous: f64,
        /// The trial, where there are trials.
        trial: Option<u32>,
    },
    /// A quantity changes within a trial.
    #[error(
        "{file}, line {line}, column {column} ({name}): {value} follows {previous}; legal is the same number on \
         every line{}", trial_words(*.trial)
    )]
    NotConstant {
        /// The file.
        file: &'static str,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The name of the column.
        name: &'static str,
        /// The number.
        value: f64,
        /// The one before it.
        previous: f64,
        /// The trial, where there are trials.
        trial: Option<u32>,
    },
    /// There are more lines of numbers than a picture can show.
    #[error("{file}, line {line}: the file has more than {most} lines of numbers; legal are {most} or fewer")]
    TooLong {
        /// The file.
        file: &'static str,
        /// The first line too many.
        line: usize,
        /// The most.
        most: usize,
    },
    /// There are too few lines of numbers.
    #[error("{file}, line {line}: the file ends after {rows} lines of numbers; legal is {least} or more")]
    TooShort {
        /// The file.
        file: &'static str,
        /// The last line.
        line: usize,
        /// The lines of numbers.
        rows: usize,
        /// The fewest.
        least: usize,
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

fn trial_words(trial: Option<u32>) -> String {
    trial.map_or_else(String::new, |trial| format!(" of trial {trial}"))
}
