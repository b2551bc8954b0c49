//! Reads measured speeds from comma-separated values, and says exactly where they are malformed.
//!
//! Accepted besides the plain form: a byte-order mark, line ends of either kind, blank lines, lines that
//! begin with `#`, blanks and one pair of double quotes around a field, columns in any order.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use csv::StringRecord;

use super::error::MeasuredSpeedsError as Fault;
use super::{MeasuredRun, MeasuredSpeeds};
use crate::csv_records::{RecordFault, Records, number, plain, text};
use crate::regular_file;

/// The columns, the last of which may be missing.
pub(super) const HEADER: &str = "time_s, speed_rad_s and, for repeated runs, member";

/// The names of the columns.
const COLUMNS: [&str; 3] = ["time_s", "speed_rad_s", "member"];

/// The legal values of each column.
const LEGAL: [&str; 3] = [
    "a number, finite and not negative (s)",
    "a finite number (rad/s)",
    "a whole number from 0 to 4294967295",
];

/// The largest file that is read (bytes).
const LARGEST_FILE: u64 = 64 << 20;

/// The longest line that is read (bytes).
const LONGEST_LINE: usize = 1 << 16;

/// The most lines of numbers.
const MOST_ROWS: usize = 4_000_000;

/// The fewest lines of a run.
const LEAST_POINTS: usize = 3;

/// How many characters of a text a message shows.
const SHOWN: usize = 40;

impl MeasuredSpeeds {
    /// Reads a file of comma-separated values with the columns `time_s` (s), `speed_rad_s` (rad/s) and, for
    /// repeated runs, `member` (a whole number). Feature `csv`.
    ///
    /// The first line names the columns, in any order. Another column is refused and not passed over: it may
    /// be a misspelt one, or one in another unit. Within a run the times rise; runs may follow each other or
    /// alternate. Blank lines and lines that begin with `#` are passed over. At most 64 MiB, 4,000,000 lines
    /// of numbers and 65,536 bytes of one line are read.
    ///
    /// # Errors
    /// [`MeasuredSpeedsError`](crate::MeasuredSpeedsError) names file, line and field, and what to do. A
    /// folder, a named pipe, a socket and a device are refused before they are opened.
    pub fn from_csv(path: impl AsRef<Path>) -> Result<Self, Fault> {
        let path = path.as_ref();
        let file = path.to_string_lossy();
        let bytes = regular_file::read(path, LARGEST_FILE);
        parse(&file, &bytes.map_err(|source| Fault::Unreadable { file: file.to_string(), source })?)
    }

    /// [`Self::from_csv`] of a reader, whose content messages call `name`.
    ///
    /// # Errors
    /// Those of [`Self::from_csv`].
    pub fn from_csv_reader(name: &str, reader: impl Read) -> Result<Self, Fault> {
        let bytes = regular_file::limited(reader, LARGEST_FILE);
        parse(name, &bytes.map_err(|source| Fault::Unreadable { file: name.to_owned(), source })?)
    }
}

/// The beginning of a text of somebody else's.
fn shortened(text: &str) -> String {
    if text.chars().nth(SHOWN).is_none() {
        return text.to_owned();
    }
    text.chars().take(SHOWN).chain(['…']).collect()
}

fn parse(file: &str, bytes: &[u8]) -> Result<MeasuredSpeeds, Fault> {
    let told = |fault| in_file(file, fault);
    let text = text(bytes).map_err(told)?;
    let long = bytes.split(|byte| *byte == b'\n').position(|line| line.len() > LONGEST_LINE);
    if let Some(index) = long {
        return Err(Fault::LongLine { file: file.to_owned(), line: index + 1, most: LONGEST_LINE });
    }
    let mut records = Records::new(text);
    let empty = || Fault::Empty { file: file.to_owned() };
    let line = records.advance().map_err(told)?.ok_or_else(empty)?;
    let header = Header::read(file, line, records.record())?;
    let mut runs: BTreeMap<u32, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
    let mut rows = 0;
    while let Some(line) = records.advance().map_err(told)? {
        rows += 1;
        if rows > MOST_ROWS {
            return Err(Fault::TooLong { file: file.to_owned(), line, most: MOST_ROWS });
        }
        let (time, speed, member) = header.row(line, records.record())?;
        let (times, speeds) = runs.entry(member).or_default();
        if let Some(&previous) = times.last()
            && time <= previous
        {
            let field = header.places[0] + 1;
            return Err(Fault::NotRising { file: file.to_owned(), line, field, time, previous, member });
        }
        times.push(time);
        speeds.push(speed);
    }
    if runs.is_empty() {
        runs.insert(0, (Vec::new(), Vec::new()));
    }
    for (&member, (times, _)) in &runs {
        let (points, least) = (times.len(), LEAST_POINTS);
        if points < least {
            return Err(Fault::TooFewPoints { file: file.to_owned(), member, points, least });
        }
    }
    let run = |(member, (times, speeds))| MeasuredRun { member, times, speeds };
    Ok(MeasuredSpeeds::new(runs.into_iter().map(run).collect())?)
}

/// A fault of the form, told with the file.
fn in_file(file: &str, fault: RecordFault) -> Fault {
    let file = file.to_owned();
    match fault {
        RecordFault::NotText { line, byte } => Fault::NotText { file, line, byte },
        RecordFault::OpenQuote { line, field } => Fault::OpenQuote { file, line, field },
        RecordFault::Unreadable(source) => Fault::Unreadable { file, source },
    }
}

/// What separates the columns of a line that has no comma, or none between columns.
fn other_separator(record: &StringRecord) -> Option<char> {
    record.iter().find_map(|field| field.chars().find(|sign| matches!(sign, ';' | '\t' | '|')))
}

/// Where the columns are in the file.
struct Header<'a> {
    file: &'a str,
    /// Fields of a line.
    fields: usize,
    /// For times, speeds and members the place in a line; the last may be missing.
    places: [usize; 2],
    member: Option<usize>,
}

impl<'a> Header<'a> {
    fn read(file: &'a str, line: usize, names: &StringRecord) -> Result<Self, Fault> {
        let owned = || file.to_owned();
        if let Some(separator) = other_separator(names) {
            return Err(Fault::Separator { file: owned(), line, separator });
        }
        let mut places = [None; COLUMNS.len()];
        for (place, name) in names.iter().map(plain).enumerate() {
            let field = place + 1;
            let Some(index) = COLUMNS.iter().position(|column| *column == name) else {
                return Err(Fault::UnknownColumn { file: owned(), line, field, name: shortened(name) });
            };
            if places[index].replace(place).is_some() {
                return Err(Fault::RepeatedColumn { file: owned(), line, field, name: COLUMNS[index] });
            }
        }
        let [times, speeds, member] = places;
        let missing = |index: usize| Fault::MissingColumn { file: owned(), line, name: COLUMNS[index] };
        let places = [times.ok_or_else(|| missing(0))?, speeds.ok_or_else(|| missing(1))?];
        Ok(Self { file, fields: names.len(), places, member })
    }

    /// Time, speed and member of a line.
    fn row(&self, line: usize, record: &StringRecord) -> Result<(f64, f64, u32), Fault> {
        let file = || self.file.to_owned();
        if let Some(separator) = other_separator(record) {
            return Err(Fault::Separator { file: file(), line, separator });
        }
        let (fields, columns) = (record.len(), self.fields);
        if fields != columns {
            return Err(Fault::Fields { file: file(), line, fields, columns });
        }
        let refuse = |column: usize, place: usize| {
            let (field, name, text) = (place + 1, COLUMNS[column], plain(&record[place]));
            let value = shortened(text);
            if number(&text.replacen(',', ".", 1)).is_ok() && text.contains(',') {
                Fault::DecimalComma { file: file(), line, field, name, value }
            } else {
                Fault::NotLegal { file: file(), line, field, name, value, legal: LEGAL[column] }
            }
        };
        let [time_place, speed_place] = self.places;
        let time = number(plain(&record[time_place])).ok().filter(|time| *time >= 0.0);
        let time = time.ok_or_else(|| refuse(0, time_place))?;
        let speed = number(plain(&record[speed_place])).map_err(|_| refuse(1, speed_place))?;
        let member = match self.member {
            None => 0,
            Some(place) => plain(&record[place]).parse().map_err(|_| refuse(2, place))?,
        };
        Ok((time, speed, member))
    }
}

#[cfg(test)]
mod tests;
