//! Reads measured speeds from separated values, and locates every error in the file.
//!
//! The reader makes no guesses: the unit of a column is in its name, in the row below the header, or given by
//! the caller. A comma that may be either a decimal mark or a thousands separator is an error.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use crate::csv_records::{fields, lines, number, plain, text};
use crate::estimate::measured_speeds::decimal_marks::DecimalMarks;
use crate::estimate::measured_speeds::error::{CsvFault, Located, MeasuredSpeedsError};
use crate::estimate::measured_speeds::units::{SpeedUnit, TimeUnit};
use crate::estimate::measured_speeds::{MeasuredRun, MeasuredSpeeds};
use crate::regular_file;

/// The names of columns without their units, in lower case.
pub(crate) const NAMES: [&[&str]; 3] =
    [&["time", "t"], &["speed", "angular speed", "angular_speed", "omega", "n"], &["member", "run", "trial"]];

/// The names of the columns in messages.
const COLUMNS: [&str; 3] = ["time_s", "speed_rad_s", "member"];

/// The legal values of each column.
const LEGAL: [&str; 3] = ["a finite number", "a finite number", "a whole number from 0 to 4294967295"];

/// Characters that may separate columns, in the order in which they are tried.
pub(crate) const SEPARATORS: [char; 3] = [';', '\t', ','];

/// The largest file that is read (bytes).
pub(crate) const LARGEST_FILE: u64 = 64 << 20;

/// The longest line that is read (bytes).
const LONGEST_LINE: usize = 1 << 16;

/// Largest number of rows of numbers.
const MOST_ROWS: usize = 4_000_000;

/// Fewest rows of a run.
const LEAST_POINTS: usize = 3;

/// Number of characters of a file's text that a message shows.
const SHOWN: usize = 40;

/// The caller's description of the columns of a file; the file itself must state everything that is `None`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CsvColumns {
    /// The column of the times. If this or the column of the speeds is named, columns of other names are
    /// ignored.
    pub time: Option<String>,
    /// The column of the speeds.
    pub speed: Option<String>,
    /// The unit of the times.
    pub time_unit: Option<TimeUnit>,
    /// The unit of the speeds.
    pub speed_unit: Option<SpeedUnit>,
}

impl MeasuredSpeeds {
    /// Reads a file of separated values with the columns `time_s` (s), `speed_rad_s` (rad/s) and, for
    /// repeated runs, `member` (a whole number), or with times and speeds in other units stated in the file.
    /// Feature `csv`.
    ///
    /// The header is the first line that names the columns, in any order. Text before it, a row of units
    /// below it, blank lines and lines that begin with `#`, `%` or `//` are legal. Columns are separated by
    /// commas, semicolons or tabs; numbers have a decimal point or, if commas do not separate columns, a
    /// decimal comma. An unknown column is an error, because its name may be misspelt. Within a run the times
    /// rise; runs may follow each other or alternate. At most 64 MiB, 4,000,000 rows of numbers and 65,536
    /// bytes per line are read.
    ///
    /// # Errors
    /// [`MeasuredSpeedsError`](crate::estimate::MeasuredSpeedsError) states file, line and field, and how to
    /// correct the fault. Folders, named pipes, sockets and devices are rejected before they are opened.
    pub fn from_csv(path: impl AsRef<Path>) -> Result<Self, MeasuredSpeedsError> {
        Self::from_csv_with(path, &CsvColumns::default())
    }

    /// [`Self::from_csv`] with columns described by the caller.
    ///
    /// # Errors
    /// The errors of [`Self::from_csv`]; a unit that contradicts the file.
    pub fn from_csv_with(path: impl AsRef<Path>, columns: &CsvColumns) -> Result<Self, MeasuredSpeedsError> {
        let path = path.as_ref();
        let file = path.to_string_lossy();
        let bytes = regular_file::read(path, LARGEST_FILE);
        parse(
            &file,
            &bytes.map_err(|source| MeasuredSpeedsError::Unreadable { file: file.to_string(), source })?,
            columns,
        )
    }

    /// [`Self::from_csv_with`] for a reader, called `name` in messages.
    ///
    /// # Errors
    /// The errors of [`Self::from_csv_with`].
    pub fn from_csv_reader(
        name: &str,
        reader: impl Read,
        columns: &CsvColumns,
    ) -> Result<Self, MeasuredSpeedsError> {
        let bytes = regular_file::limited(reader, LARGEST_FILE);
        let bytes =
            bytes.map_err(|source| MeasuredSpeedsError::Unreadable { file: name.to_owned(), source })?;
        parse(name, &bytes, columns)
    }
}

/// The beginning of a text from a file.
pub(crate) fn shortened(text: &str) -> String {
    if text.chars().nth(SHOWN).is_none() {
        return text.to_owned();
    }
    text.chars().take(SHOWN).chain(['…']).collect()
}

/// Times and speeds of each run in SI units, by the number of the run.
type Runs = BTreeMap<u32, (Vec<f64>, Vec<f64>)>;

fn parse(file: &str, bytes: &[u8], columns: &CsvColumns) -> Result<MeasuredSpeeds, MeasuredSpeedsError> {
    let (runs, units) = runs_of(bytes, columns).map_err(|located| located.in_file(file))?;
    let run = |(member, (times, speeds))| MeasuredRun { member, times, speeds };
    let mut measured = MeasuredSpeeds::new(runs.into_iter().map(run).collect())?;
    measured.units = units;
    Ok(measured)
}

fn runs_of(bytes: &[u8], columns: &CsvColumns) -> Result<(Runs, (TimeUnit, SpeedUnit)), Located> {
    let text = text(bytes)?;
    let long = bytes.split(|byte| *byte == b'\n').position(|line| line.len() > LONGEST_LINE);
    if let Some(index) = long {
        return Err(Located(Some(index + 1), None, CsvFault::LongLine(LONGEST_LINE)));
    }
    let mut lines = lines(text).peekable();
    let mut header = Header::find(&mut lines, columns)?;
    if let Some(&line) = lines.peek() {
        let row = fields(line, header.separator)?;
        let is_text = row.iter().all(|field| header.marks.number(field).is_err());
        if row.len() >= header.fields && is_text && row.iter().any(|field| !field.is_empty()) {
            header.units_below(line.0, &row)?;
            lines.next();
        }
    }
    let (time_unit, speed_unit) = header.units(columns)?;
    let mut runs = Runs::new();
    let mut rows = 0;
    for line in lines {
        rows += 1;
        if rows > MOST_ROWS {
            return Err(Located(Some(line.0), None, CsvFault::TooLong(MOST_ROWS)));
        }
        let (time, speed, member) = header.row(line.0, fields(line, header.separator)?)?;
        let (times, speeds) = runs.entry(member).or_default();
        let (time, speed) = (time_unit.to_si(time), speed_unit.to_si(speed));
        if let Some(&previous) = times.last()
            && time <= previous
        {
            let fault = CsvFault::NotRising { time, previous, member };
            return Err(Located(Some(line.0), Some(header.places[0] + 1), fault));
        }
        times.push(time);
        speeds.push(speed);
    }
    header.marks.check()?;
    if runs.is_empty() {
        runs.insert(0, (Vec::new(), Vec::new()));
    }
    for (&member, (times, _)) in &runs {
        let (points, least) = (times.len(), LEAST_POINTS);
        if points < least {
            return Err(Located(None, None, CsvFault::TooFewPoints { member, points, least }));
        }
    }
    Ok((runs, (time_unit, speed_unit)))
}

/// The name of a column and its unit, if given in brackets or after an underscore.
pub(crate) fn name_and_unit(field: &str) -> (String, Option<&str>) {
    for (open, close) in [('(', ')'), ('[', ']')] {
        if let Some((name, unit)) = field.strip_suffix(close).and_then(|rest| rest.split_once(open)) {
            return (name.trim().to_lowercase(), Some(unit.trim()));
        }
    }
    for name in NAMES[..2].iter().copied().flatten() {
        let prefix = field.get(..name.len()).filter(|prefix| prefix.eq_ignore_ascii_case(name));
        if let Some(unit) = prefix.and_then(|_| field[name.len()..].strip_prefix('_')) {
            return ((*name).to_owned(), Some(unit));
        }
    }
    (field.to_lowercase(), None)
}

/// The positions of the columns in the file, and the format of its numbers.
struct Header<'a> {
    line: usize,
    separator: char,
    /// Number of fields per line.
    fields: usize,
    /// Positions of times and speeds in a line; the column of the members may be missing.
    places: [usize; 2],
    member: Option<usize>,
    /// Units of times and speeds, from the name or the row below it.
    units: [Option<&'a str>; 2],
    marks: DecimalMarks,
}

impl<'a> Header<'a> {
    /// The first line that names times and speeds. Only lines of text may precede it; a line of numbers ends
    /// the search.
    fn find(
        lines: &mut std::iter::Peekable<impl Iterator<Item = (usize, &'a str)>>,
        columns: &CsvColumns,
    ) -> Result<Self, Located> {
        let mut fault = None;
        while let Some(&line) = lines.peek() {
            let is_number = |field: &str| number(&plain(field).replacen(',', ".", 1)).is_ok();
            let are_numbers = line.1.split([';', '\t', ',']).all(is_number);
            if are_numbers && fault.is_some() {
                break;
            }
            lines.next();
            let mut own = None;
            for separator in SEPARATORS.into_iter().filter(|separator| line.1.contains(*separator)) {
                let Ok(names) = fields(line, separator) else { continue };
                match Self::read(line.0, separator, &names, columns) {
                    Ok(header) => return Ok(header),
                    // The message is about the separator tried first.
                    Err(other) => own = own.or(Some(other)),
                }
            }
            if are_numbers {
                return Err(Located(Some(line.0), None, CsvFault::NoHeader));
            }
            // A line without any separator is text, unless no other line is a header.
            let single = || Self::read(line.0, ',', &[plain(line.1)], columns).err();
            fault = own.or_else(|| if fault.is_none() { single() } else { fault.take() }).or(fault);
        }
        Err(fault.unwrap_or(Located(None, None, CsvFault::Empty)))
    }

    fn read(line: usize, separator: char, names: &[&'a str], columns: &CsvColumns) -> Result<Self, Located> {
        let said = [columns.time.as_deref(), columns.speed.as_deref(), None];
        let is_said = said.iter().any(Option::is_some);
        let (mut places, mut units) = ([None; COLUMNS.len()], [None; COLUMNS.len()]);
        let mut unknown = None;
        for (place, field) in names.iter().enumerate() {
            let (name, unit) = name_and_unit(field);
            let index = (0..COLUMNS.len()).find(|&index| match said[index] {
                Some(said) => said == *field || said.to_lowercase() == name,
                None => NAMES[index].contains(&name.as_str()),
            });
            match index {
                Some(index) if places[index].is_some() => {
                    let fault = CsvFault::RepeatedColumn(COLUMNS[index]);
                    return Err(Located(Some(line), Some(place + 1), fault));
                }
                Some(index) => (places[index], units[index]) = (Some(place), unit),
                // Some programs end each line with a separator.
                None if is_said || (field.is_empty() && place + 1 == names.len()) => {}
                None => {
                    let fault = CsvFault::UnknownColumn(shortened(field));
                    unknown = unknown.or(Some(Located(Some(line), Some(place + 1), fault)));
                }
            }
        }
        if let Some(fault) = unknown {
            return Err(fault);
        }
        let missing = |index: usize| {
            let name = shortened(said[index].unwrap_or(COLUMNS[index]));
            Located(Some(line), None, CsvFault::MissingColumn(name))
        };
        let [times, speeds, member] = places;
        Ok(Self {
            line,
            separator,
            fields: names.len(),
            places: [times.ok_or_else(|| missing(0))?, speeds.ok_or_else(|| missing(1))?],
            member,
            units: [units[0], units[1]],
            marks: DecimalMarks::new(separator),
        })
    }

    /// Reads the units from a row below the header, for columns without units in their names.
    fn units_below(&mut self, line: usize, row: &[&'a str]) -> Result<(), Located> {
        for index in 0..2 {
            let Some(field) = row.get(self.places[index]).filter(|field| !field.is_empty()) else { continue };
            let unit = field.trim_matches(['(', ')', '[', ']', ' ']);
            let is_known = [TimeUnit::of(unit).is_some(), SpeedUnit::of(unit).is_some()][index];
            if !is_known || self.units[index].is_some_and(|own| !same_unit(own, unit)) {
                return Err(self.unit_fault(index, line, unit));
            }
            self.units[index] = Some(unit);
        }
        Ok(())
    }

    fn unit_fault(&self, index: usize, line: usize, unit: &str) -> Located {
        let name = ["time", "speed"][index];
        let legal = [TimeUnit::NAMES, SpeedUnit::NAMES][index];
        let fault = CsvFault::Unit { name, unit: shortened(unit), legal };
        Located(Some(line), Some(self.places[index] + 1), fault)
    }

    /// The units of times and speeds, from the file or the caller, which must agree.
    fn units(&self, columns: &CsvColumns) -> Result<(TimeUnit, SpeedUnit), Located> {
        let own = |index: usize| self.units[index].unwrap_or_default();
        let (time, speed) = (TimeUnit::of(own(0)), SpeedUnit::of(own(1)));
        let fault = |index: usize| self.unit_fault(index, self.line, own(index));
        let differs = [
            columns.time_unit.is_some_and(|said| self.units[0].is_some() && time != Some(said)),
            columns.speed_unit.is_some_and(|said| self.units[1].is_some() && speed != Some(said)),
        ];
        if let Some(index) = differs.iter().position(|differs| *differs) {
            return Err(fault(index));
        }
        let time = columns.time_unit.or(time).ok_or_else(|| fault(0))?;
        Ok((time, columns.speed_unit.or(speed).ok_or_else(|| fault(1))?))
    }

    /// Time, speed and member of a line.
    fn row(&mut self, line: usize, mut row: Vec<&str>) -> Result<(f64, f64, u32), Located> {
        while row.len() > self.fields && row[row.len() - 1].is_empty() {
            row.pop();
        }
        let (fields, columns) = (row.len(), self.fields);
        if fields != columns {
            return Err(Located(Some(line), None, CsvFault::Fields { fields, columns }));
        }
        let mut numbers = [0.0; 2];
        for (column, value) in numbers.iter_mut().enumerate() {
            let place = self.places[column];
            let text = row[place];
            self.marks.note(line, place, text)?;
            *value = self.marks.number(text).map_err(|_| self.refuse(line, column, place, text))?;
        }
        let member = match self.member {
            None => 0,
            Some(place) => row[place].parse().map_err(|_| self.refuse(line, 2, place, row[place]))?,
        };
        Ok((numbers[0], numbers[1], member))
    }

    fn refuse(&self, line: usize, column: usize, place: usize, text: &str) -> Located {
        let (name, value) = (COLUMNS[column], shortened(text));
        let fault = if text.contains(',') && number(&text.replacen(',', ".", 1)).is_ok() {
            CsvFault::DecimalComma { name, value }
        } else {
            CsvFault::NotLegal { name, value, legal: LEGAL[column] }
        };
        Located(Some(line), Some(place + 1), fault)
    }
}

fn same_unit(one: &str, other: &str) -> bool {
    (TimeUnit::of(one), SpeedUnit::of(one)) == (TimeUnit::of(other), SpeedUnit::of(other))
}

#[cfg(test)]
mod tests;
