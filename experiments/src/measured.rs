//! A user's own measurements: comma-separated files that are drawn over a figure and fitted as the paper fits
//! its own.
//!
//! The paper prints its measured points only as pictures, so none come with this crate. [`Measurements`]
//! holds what lies in `data/measured`; a figure names the files that it can show by their [`Layout`], and
//! gets a [`Series`] of checked numbers. `data/measured/README.md` has the same layouts in words. The model's
//! `csv_records` splits the lines; here is what a line must hold.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::Arc;
use std::{fs, io};

use bouncing_disk::csv_records::{self, NumberFault, RecordFault, fields, lines};
use bouncing_disk::regular_file;

use crate::visible::{excerpt, visible};

/// The largest legal magnitude, in the unit of any column: more is a wrong unit, and no fit to it overflows.
const LARGEST: f64 = 1e9;
/// The smallest legal value where 0 is not legal, so that a logarithm or a quotient of two such values is
/// finite.
pub(crate) const SMALLEST: f64 = 1e-12;
/// The smallest legal magnitude other than 0 where 0 is legal: less than any rounding of a program that has
/// written the file, and enough that squares and quotients of legal numbers keep all their digits.
const TINIEST: f64 = 1e-30;
/// The largest file that is read (bytes).
const LARGEST_FILE: u64 = 64 << 20;
/// The most lines of numbers: many more than a picture can show, and the time to draw crosses grows with the
/// square of their number, from two seconds for as many as these.
const MOST_ROWS: usize = 10_000;
/// The most unknown files that are named one by one.
const NAMED: usize = 10;

/// The legal values of a column. Numbers that are not finite are never legal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Either sign, up to 1e9 in magnitude; 0, or 1e-30 or more in magnitude.
    Signed,
    /// From 0 to 1e9; 0, or 1e-30 or more.
    NotNegative,
    /// From 1e-12 to 1e9.
    Positive,
    /// A whole number from 1 up to this one.
    Whole(u32),
}

impl Range {
    fn holds(self, number: f64) -> bool {
        let (low, high) = self.ends();
        let inside = (low..=high).contains(&number) && (number == 0.0 || number.abs() >= TINIEST);
        inside && (!matches!(self, Self::Whole(_)) || whole(number).is_some())
    }

    fn ends(self) -> (f64, f64) {
        match self {
            Self::Signed => (-LARGEST, LARGEST),
            Self::NotNegative => (0.0, LARGEST),
            Self::Positive => (SMALLEST, LARGEST),
            Self::Whole(last) => (1.0, f64::from(last)),
        }
    }

    fn words(self) -> String {
        let (low, high) = self.ends();
        match self {
            Self::Whole(_) => format!("a whole number from {low} to {high}"),
            Self::NotNegative => format!("a number from {low} to {high:e}, either 0 or {TINIEST:e} or more"),
            Self::Signed => {
                format!("a number from {low:e} to {high:e}, either 0 or {TINIEST:e} or more in magnitude")
            }
            Self::Positive => format!("a number from {low:e} to {high:e}"),
        }
    }
}

/// A number as a whole number, if it is one of the type.
fn whole(number: f64) -> Option<u32> {
    // The conversion saturates, so that only a whole number of the type survives it.
    let whole = number as u32;
    f64::from(whole).total_cmp(&number).is_eq().then_some(whole)
}

/// The purpose of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// A quantity that may do anything within its range.
    Value,
    /// The number of the trial that the line belongs to.
    Trial,
    /// A time: it rises from line to line of a trial, or of the file if there is no trial column.
    Rising,
    /// The same on all lines of a trial.
    Constant,
}

/// A column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// The name in the header; it ends in the unit.
    pub name: &'static str,
    range: Range,
    role: Role,
}

impl Column {
    /// A quantity.
    pub const fn value(name: &'static str, range: Range) -> Self {
        Self { name, range, role: Role::Value }
    }

    /// The number of the trial, from 1 to `last`; the first column of a layout that has one.
    pub const fn trial(last: u32) -> Self {
        Self { name: "trial", range: Range::Whole(last), role: Role::Trial }
    }

    /// The time in seconds.
    pub const fn time() -> Self {
        Self { name: "time_s", range: Range::NotNegative, role: Role::Rising }
    }

    /// A quantity that is the same on all lines of a trial.
    pub const fn constant(name: &'static str, range: Range) -> Self {
        Self { name, range, role: Role::Constant }
    }
}

/// A file of measurements that a figure can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The name of the file.
    pub file: &'static str,
    /// The columns, in the order in which a figure gets them; a file may have them in any order.
    pub columns: &'static [Column],
    /// The fewest lines of numbers.
    pub least_rows: usize,
}

impl Layout {
    /// The names of the columns as a header.
    pub fn header(&self) -> String {
        self.columns.iter().map(|column| column.name).collect::<Vec<_>>().join(",")
    }

    fn with_role(&self, role: Role) -> Option<usize> {
        self.columns.iter().position(|column| column.role == role)
    }

    /// A fault in a line, and in a column of it where there is one; both are counted from 1.
    fn fault(&self, line: usize, column: Option<usize>, name: &str, fault: String) -> MeasuredError {
        let column = match (column, name) {
            (None, _) => String::new(),
            (Some(column), "") => format!(", column {column}"),
            (Some(column), name) => format!(", column {column} ({name})"),
        };
        format!("{}, line {line}{column}: {fault}", self.file).into()
    }
}

/// A fault in a file of measurements: the file, the place in it, what was found and what would be legal. Lines and columns are
/// counted from 1.
#[derive(Debug, thiserror::Error)]
#[error("{fault}")]
pub struct MeasuredError {
    fault: String,
    source: Option<Box<dyn std::error::Error + Send + Sync>>,
}

impl From<String> for MeasuredError {
    fn from(fault: String) -> Self {
        Self { fault, source: None }
    }
}

/// The content of a user's files, read once, so that a figure and its cache key see the same bytes.
#[derive(Clone, Debug, Default)]
pub struct Measurements {
    files: BTreeMap<&'static str, Result<Vec<u8>, Arc<io::Error>>>,
    /// Names of files that no layout names, sorted.
    unknown: Vec<String>,
    /// The names of the layouts.
    legal: Vec<&'static str>,
}

impl Measurements {
    /// No measurements, for tests and library use.
    pub fn none() -> Self {
        Self::default()
    }

    /// Reads the files of these layouts and looks what other files there are whose names end in `.csv`. A
    /// folder that does not exist holds none.
    pub fn read(folder: &Path, layouts: &[Layout]) -> io::Result<Self> {
        let entries = match fs::read_dir(folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::none()),
            entries => entries?,
        };
        let legal: Vec<_> = layouts.iter().map(|layout| layout.file).collect();
        let (mut files, mut unknown) = (BTreeMap::new(), Vec::new());
        for entry in entries {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if let Some(known) = legal.iter().find(|known| **known == name) {
                files.insert(*known, regular_file::read(&entry.path(), LARGEST_FILE).map_err(Arc::new));
            } else if name.to_lowercase().ends_with(".csv") && !name.starts_with('.') {
                unknown.push(name);
            }
        }
        unknown.sort();
        Ok(Self { files, unknown, legal })
    }

    /// The measurements of a file; `None` when there is no such file.
    pub fn series(&self, layout: &Layout) -> Option<Result<Series, MeasuredError>> {
        self.files.get(layout.file).map(|content| match content {
            Ok(bytes) => Series::read(layout, bytes),
            Err(error) => {
                let fault = format!("{} cannot be read", layout.file);
                Err(MeasuredError { fault, source: Some(Box::new(Arc::clone(error))) })
            }
        })
    }

    /// One error for each file that no layout names, since a misspelt name must not be passed over in
    /// silence; where they are many, as in a folder of something else, the last error counts those that have
    /// none of their own.
    pub fn unknown(&self) -> Vec<MeasuredError> {
        let (named, more) = self.unknown.split_at(self.unknown.len().min(NAMED));
        let named = named.iter().map(|file| format!("a file called {}", visible(file)));
        let more = (!more.is_empty()).then(|| format!("{} more files", more.len()));
        let legal = self.legal.join(", ");
        let fault = |files| format!("no figure reads {files}; legal names are {legal}").into();
        named.chain(more).map(fault).collect()
    }

    /// The digest of the files of these layouts; empty when there is none of them.
    pub fn digest(&self, layouts: &[Layout]) -> String {
        let mut hasher = DefaultHasher::new();
        let mut found = false;
        for layout in layouts {
            if let Some(content) = self.files.get(layout.file) {
                found = true;
                layout.file.hash(&mut hasher);
                // Why a file cannot be read is in the figure's caption, too.
                content.as_ref().map_err(|error| error.to_string()).hash(&mut hasher);
            }
        }
        if found { format!("{:016x}", hasher.finish()) } else { String::new() }
    }
}

/// The numbers of one file, all legal: rows of the columns in the order of the layout.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    layout: Layout,
    values: Vec<Vec<f64>>,
    /// The line of each row, and the column of each column of the layout, from 1.
    lines: Vec<usize>,
    columns: Vec<usize>,
}

impl Series {
    /// Reads a file's content.
    pub fn read(layout: &Layout, bytes: &[u8]) -> Result<Self, MeasuredError> {
        let malformed = |fault: RecordFault| MeasuredError::from(format!("{}, {fault}", layout.file));
        let text = csv_records::text(bytes).map_err(malformed)?;
        let mut lines = lines(text);
        let empty = || format!("{} is empty; its first line must be {}", layout.file, layout.header());
        let first = lines.next().ok_or_else(empty)?;
        let mut line = first.0;
        let places = places(layout, line, &fields(first, ',').map_err(malformed)?)?;
        let columns = places.iter().map(|place| place + 1).collect();
        let mut series = Self { layout: *layout, values: Vec::new(), lines: Vec::new(), columns };
        // The last row of each trial.
        let mut last: BTreeMap<Option<u32>, Vec<f64>> = BTreeMap::new();
        for own in lines {
            line = own.0;
            let row = series.row(line, &fields(own, ',').map_err(malformed)?)?;
            let trial = layout.with_role(Role::Trial).and_then(|index| whole(row[index]));
            if let Some(last) = last.insert(trial, row.clone()) {
                series.check_order(line, &row, &last, trial)?;
            }
            if series.values.len() == MOST_ROWS {
                let fault = format!(
                    "the file has more than {MOST_ROWS} lines of numbers; legal are {MOST_ROWS} or fewer"
                );
                return Err(layout.fault(line, None, "", fault));
            }
            series.values.push(row);
            series.lines.push(line);
        }
        let (count, least) = (series.values.len(), layout.least_rows);
        if count < least {
            let fault = format!("the file ends after {count} lines of numbers; legal is {least} or more");
            return Err(layout.fault(line, None, "", fault));
        }
        Ok(series)
    }

    fn row(&self, line: usize, values: &[&str]) -> Result<Vec<f64>, MeasuredError> {
        let (count, columns) = (values.len(), self.columns.len());
        if count != columns {
            let fault = format!("the line has {count} fields; legal is {columns}");
            return Err(self.layout.fault(line, Some(count.min(columns) + 1), "", fault));
        }
        let number = |(place, column): (&usize, &Column)| {
            let text = values[place - 1];
            let fault = match csv_records::number(text) {
                Ok(number) if column.range.holds(number) => return Ok(number),
                // A number needs no quotes.
                Ok(_) | Err(NumberFault::NoSuchDouble) => {
                    format!("{} is not legal", excerpt(text).replace('"', ""))
                }
                Err(NumberFault::NotANumber) => format!("{} is not a number", excerpt(text)),
            };
            let fault = format!("{fault}; legal is {}", column.range.words());
            Err(self.layout.fault(line, Some(*place), column.name, fault))
        };
        self.columns.iter().zip(self.layout.columns).map(number).collect()
    }

    /// Checks what rises or stays the same within a trial.
    fn check_order(
        &self,
        line: usize,
        row: &[f64],
        last: &[f64],
        trial: Option<u32>,
    ) -> Result<(), MeasuredError> {
        for (role, legal) in [(Role::Rising, "a larger number"), (Role::Constant, "the same number")] {
            let Some(index) = self.layout.with_role(role) else { continue };
            let (value, previous) = (row[index], last[index]);
            let holds =
                if role == Role::Rising { value > previous } else { value.total_cmp(&previous).is_eq() };
            if !holds {
                let trial = trial.map_or_else(String::new, |trial| format!(" of trial {trial}"));
                let fault = format!("{value} follows {previous}; legal is {legal} on every line{trial}");
                let name = self.layout.columns[index].name;
                return Err(self.layout.fault(line, Some(self.columns[index]), name, fault));
            }
        }
        Ok(())
    }

    /// The layout of the file.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The rows of a layout of `N` columns; none if it has another number of them.
    pub fn rows<const N: usize>(&self) -> impl Iterator<Item = [f64; N]> + '_ {
        self.values.iter().filter_map(|row| row.as_slice().try_into().ok())
    }

    /// The rows of each trial, by rising trial number, of a layout of `N` columns whose first is the trial.
    pub fn trials<const N: usize>(&self) -> Vec<(u32, Vec<[f64; N]>)> {
        let mut trials = BTreeMap::new();
        for row in self.rows::<N>() {
            if let Some(trial) = row.first().copied().and_then(whole) {
                trials.entry(trial).or_insert_with(Vec::new).push(row);
            }
        }
        trials.into_iter().collect()
    }

    /// The error of a number that is legal in itself, but that the figure has no place for; row and column of
    /// [`Self::rows`], from 0.
    pub fn illegal(&self, row: usize, column: usize, legal: &str) -> MeasuredError {
        let fault = format!("{} is not legal; legal is {legal}", self.values[row][column]);
        let name = self.layout.columns[column].name;
        self.layout.fault(self.lines[row], Some(self.columns[column]), name, fault)
    }

    /// The error of a fit to this file or to one of its trials.
    pub fn unusable(
        &self,
        trial: Option<u32>,
        error: impl std::error::Error + Send + Sync + 'static,
    ) -> MeasuredError {
        let what = trial.map_or_else(|| "the points".to_owned(), |trial| format!("trial {trial}"));
        let fault = format!("{}: {what} cannot be evaluated", self.layout.file);
        MeasuredError { fault, source: Some(Box::new(error)) }
    }
}

/// The place in a line of each column of the layout.
fn places(layout: &Layout, line: usize, names: &[&str]) -> Result<Vec<usize>, MeasuredError> {
    let legal = layout.header();
    let separators = [(';', "semicolons"), ('\t', "tabs")];
    let other = separators.into_iter().find(|(sign, _)| names[0].contains(*sign));
    if let ([_], true, Some((_, found))) = (names, layout.columns.len() > 1, other) {
        let fault = format!("columns are separated by {found}; legal is a comma, as in {legal}");
        return Err(layout.fault(line, None, "", fault));
    }
    let mut places: Vec<Option<usize>> = vec![None; layout.columns.len()];
    for (place, &name) in names.iter().enumerate() {
        let known = layout.columns.iter().position(|column| column.name == name);
        let fault = match known.map(|index| places[index].replace(place)) {
            None => format!("the header has {}; legal is {legal}", excerpt(name)),
            Some(Some(_)) => format!("the header has \"{name}\" again"),
            Some(None) => continue,
        };
        return Err(layout.fault(line, Some(place + 1), "", fault));
    }
    let found = places.iter().zip(layout.columns).map(|(place, column)| {
        let fault = || format!("the header has no column \"{}\"; legal is {legal}", column.name);
        place.ok_or_else(|| layout.fault(line, None, "", fault()))
    });
    found.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAYOUT: Layout = Layout {
        file: "demo.csv",
        columns: &[
            Column::trial(3),
            Column::constant("preload_n", Range::Positive),
            Column::time(),
            Column::value("speed_rad_per_s", Range::NotNegative),
        ],
        least_rows: 2,
    };
    const HEADER: &str = "trial,preload_n,time_s,speed_rad_per_s\n";

    fn rows(text: &str) -> Vec<Vec<f64>> {
        Series::read(&LAYOUT, text.as_bytes()).expect("well formed").values
    }

    fn fault(text: impl AsRef<[u8]>) -> String {
        Series::read(&LAYOUT, text.as_ref()).expect_err("malformed").to_string()
    }

    fn fault_of(lines: &str) -> String {
        fault(format!("{HEADER}1,0.3,0,20\n{lines}\n"))
    }

    #[test]
    fn plain_values_are_read() {
        let expected = vec![vec![1.0, 0.3, 0.0, 20.5], vec![1.0, 0.3, 0.1, 1e-3], vec![2.0, 0.2, 0.0, 0.0]];
        let body = "1,0.3,0,20.5\n1,0.3,0.1,1e-3\n2,0.2,0,0\n";
        assert_eq!(rows(&format!("{HEADER}{body}")), expected);
        assert_eq!(rows(&format!("\u{feff}{HEADER}{body}").replace('\n', "\r\n")), expected);
        let body = "# first\n \"1\" , 0.3,0,20.5 \n1,0.3,0.1,1e-3\n\n2,0.2,0,\"0\"";
        assert_eq!(rows(&format!("# of 3 May\n\n{HEADER}{body}")), expected);
        // Columns in any order, and trials in turn.
        let text = "time_s,speed_rad_per_s,trial,preload_n\n0,5,2,0.1\n0,6,1,0.3\n1,4,2,0.1\n1,3,1,0.3\n";
        assert_eq!(rows(text)[3], [1.0, 0.3, 1.0, 3.0]);
        for text in ["0", "-0", "0e999", "0.000e-999", "1e-30", "1e9"] {
            let read = rows(&format!("{HEADER}1,0.3,0,{text}\n1,0.3,1,0\n"));
            assert!(read[0][3].is_sign_positive());
        }
    }

    /// Each fault with its place and what would be legal; a number of fields, of lines, of characters is stated, not shown.
    #[test]
    fn every_fault_is_named_with_its_place() {
        let legal = HEADER.trim_end();
        let empty = format!("demo.csv is empty; its first line must be {legal}");
        assert_eq!([fault(""), fault("\u{feff}\r\n# nothing\n")], [empty.clone(), empty]);
        let long = |letter: &str| letter.repeat(5_000_000);
        for (text, expected) in [
            (
                "trial,preload_n,t,speed_rad_per_s\n",
                format!("1, column 3: the header has \"t\"; legal is {legal}"),
            ),
            (
                "# mine\ntrial,time_s,speed_rad_per_s\n",
                format!("2: the header has no column \"preload_n\"; legal is {legal}"),
            ),
            ("trial,time_s,time_s,preload_n\n", "1, column 3: the header has \"time_s\" again".to_owned()),
            (
                "trial;preload_n;time_s;speed_rad_per_s\n1;0,3;0;20\n",
                format!("1: columns are separated by semicolons; legal is a comma, as in {legal}"),
            ),
            ("1,0.3,0,20\n", format!("1, column 1: the header has \"1\"; legal is {legal}")),
            // Line ends of another kind, and an encoding of two bytes a letter.
            ("trial\r1\r", format!("1, column 1: the header has \"trial\\r1\"; legal is {legal}")),
            ("t\0r\0", format!("1, column 1: the header has \"t\\u{{0}}r\\u{{0}}\"; legal is {legal}")),
            (HEADER, "1: the file ends after 0 lines of numbers; legal is 2 or more".to_owned()),
        ] {
            assert_eq!(fault(text), format!("demo.csv, line {expected}"));
        }
        let range = "a number from 0 to 1e9, either 0 or 1e-30 or more";
        let of_trial = "on every line of trial 1";
        for (line, expected) in [
            (
                "1,0.3,0.1,fast",
                format!("3, column 4 (speed_rad_per_s): \"fast\" is not a number; legal is {range}"),
            ),
            ("1,0.3,,19", format!("3, column 3 (time_s): \"\" is not a number; legal is {range}")),
            (
                "1,0,0.1,19",
                "3, column 2 (preload_n): 0 is not legal; legal is a number from 1e-12 to 1e9".to_owned(),
            ),
            (
                "1,\"0,3\",0.1,19",
                "3, column 2 (preload_n): \"0,3\" is not a number; legal is a number from 1e-12 to 1e9"
                    .to_owned(),
            ),
            ("\n1,\"0.3,0.1,19", "4, field 2: a quotation mark is not closed on its line".to_owned()),
            ("1,0.3,0.1", "3, column 4: the line has 3 fields; legal is 4".to_owned()),
            ("1,0.3,0.1,19,", "3, column 5: the line has 5 fields; legal is 4".to_owned()),
            (
                "2,0.1,0,9\n1,0.3,0,19",
                format!("4, column 3 (time_s): 0 follows 0; legal is a larger number {of_trial}"),
            ),
            (
                "1,0.2,0.1,19",
                format!("3, column 2 (preload_n): 0.2 follows 0.3; legal is the same number {of_trial}"),
            ),
        ] {
            assert_eq!(fault_of(line), format!("demo.csv, line {expected}"));
        }
        for trial in ["0", "4", "1.5"] {
            let text = fault_of(&format!("{trial},0.3,0.1,19"));
            let expected = format!("(trial): {trial} is not legal; legal is a whole number from 1 to 3");
            assert!(text.contains(&expected), "{text}");
        }
        for text in ["NaN", "inf", "-inf", "+Infinity"] {
            let expected = format!(": \"{text}\" is not a number;");
            assert!(fault_of(&format!("1,0.3,0.1,{text}")).contains(&expected));
        }
        for text in ["1e999", "-1e400", "-2", "2e9", "1e308", "1e-310", "1e-400", "0.0001e-999", "1e-31"] {
            let expected = format!("(speed_rad_per_s): {text} is not legal; legal is {range}");
            assert!(fault_of(&format!("1,0.3,0.1,{text}")).ends_with(&expected));
        }
        let cut = format!("{}… (5000000 characters) is not legal", "9".repeat(SHOWN_NINES));
        assert!(fault_of(&format!("1,0.3,0.1,{}", long("9"))).contains(&cut));
        let text = fault_of(&format!("1,0.3,0.1,\u{1b}[2J{}", long("x")));
        assert!(
            text.contains(r#""\u{1b}[2Jxxx"#) && text.contains("…\" (5000004 characters) is not a number")
        );
        let header = fault(format!("trial,\u{202e}{}\n", long("y")));
        assert!(header.contains(r#"the header has "\u{202e}yyy"#) && header.len() < 300 && text.len() < 300);
        let many = fault_of(&",".repeat(1_000_000));
        assert!(many.ends_with("column 5: the line has 1000001 fields; legal is 4"));
        let lines = (0..MOST_ROWS).fold(HEADER.to_owned(), |text, line| text + &format!("1,0.3,{line},2\n"));
        assert_eq!(rows(&lines).len(), MOST_ROWS);
        let expected = "line 10002: the file has more than 10000 lines of numbers; legal are 10000 or fewer";
        assert_eq!(fault(lines + "2,0.3,0,2\n"), format!("demo.csv, {expected}"));
        let latin = [HEADER.as_bytes(), b"1,0.3,\xb5,2\n"].concat();
        assert_eq!(fault(latin), "demo.csv, line 2, byte 7: not text in UTF-8");
    }

    /// The characters of a text that a message shows.
    const SHOWN_NINES: usize = 40;

    #[test]
    fn files_are_found_and_every_change_is_seen() {
        let folder = tempfile::tempdir().expect("writable");
        let (layout, path) = ([LAYOUT], folder.path());
        let read = || Measurements::read(path, &layout).expect("readable");
        let write = |name: &str, text: &str| fs::write(path.join(name), text).expect("writable");
        write("README.md", "words");
        assert!(read().series(&LAYOUT).is_none() && read().digest(&layout).is_empty());
        write("demo.csv", &format!("{HEADER}1,0.3,0,20\n1,0.3,1,2\n"));
        let first = read();
        let series = first.series(&LAYOUT).expect("there").expect("well formed");
        assert_eq!(series.trials::<4>(), [(1, vec![[1.0, 0.3, 0.0, 20.0], [1.0, 0.3, 1.0, 2.0]])]);
        assert!(first.unknown().is_empty() && !first.digest(&layout).is_empty());
        write("demo.csv", &format!("{HEADER}1,0.3,0,20\n1,0.3,1,3\n"));
        assert_ne!(read().digest(&layout), first.digest(&layout));
        // A folder in the place of a file, and one that is too large, without a byte on the disk.
        let unreadable = |expected: &str| {
            let error = read().series(&LAYOUT).expect("there").expect_err("unreadable");
            assert_eq!(crate::experiment::chain(&error), format!("demo.csv cannot be read: {expected}"));
            fs::remove_file(path.join("demo.csv")).or_else(|_| fs::remove_dir(path.join("demo.csv")))
        };
        fs::remove_file(path.join("demo.csv")).expect("removable");
        fs::create_dir(path.join("demo.csv")).expect("writable");
        let digest = read().digest(&layout);
        unreadable("it is a folder, not a regular file").expect("removable");
        let file = fs::File::create(path.join("demo.csv")).expect("writable");
        file.set_len(LARGEST_FILE + 1).expect("writable");
        // The figure shows the message.
        assert_ne!(read().digest(&layout), digest);
        unreadable("it has 67108865 bytes; at most 67108864 are read").expect("removable");
        // A folder of something else; its files are not read.
        (0..30).for_each(|index| write(&format!("z\n{index:02}.csv"), ""));
        let unknown: Vec<_> = read().unknown().iter().map(ToString::to_string).collect();
        assert_eq!(unknown.len(), 11);
        assert_eq!(unknown[0], r"no figure reads a file called z\n00.csv; legal names are demo.csv");
        assert_eq!(unknown[10], "no figure reads 20 more files; legal names are demo.csv");
    }
}
