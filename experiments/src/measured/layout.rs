//! What a file of measurements looks like.

/// The largest legal magnitude, in the unit of any column: more is a wrong unit, and no fit to it overflows.
pub const LARGEST: f64 = 1e9;

/// The smallest legal value where 0 is not legal, so that a logarithm or a quotient of two such values is finite.
pub const SMALLEST: f64 = 1e-12;

/// The smallest legal magnitude other than 0 where 0 is legal: less than any rounding of a program that has
/// written the file, and enough that squares and quotients of legal numbers keep all their digits.
pub const TINIEST: f64 = 1e-30;

/// The largest file that is read (bytes).
pub const LARGEST_FILE: u64 = 64 << 20;

/// The most lines of numbers: many more than a picture can show, and the time to draw crosses grows with the
/// square of their number, from two seconds for as many as these.
pub const MOST_ROWS: usize = 10_000;

/// The legal values of a column. Numbers that are not finite are never legal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Range {
    /// Either sign, up to [`LARGEST`] in magnitude; 0, or [`TINIEST`] or more in magnitude.
    Signed,
    /// From 0 to [`LARGEST`]; 0, or [`TINIEST`] or more.
    NotNegative,
    /// From [`SMALLEST`] to [`LARGEST`].
    Positive,
    /// A whole number from 1 up to this one.
    Whole(u32),
}

impl Range {
    /// Whether a number is legal.
    pub fn holds(self, number: f64) -> bool {
        match self {
            Self::Whole(last) => whole(number).is_some_and(|whole| (1..=last).contains(&whole)),
            _ => {
                let (low, high) = self.ends();
                (low..=high).contains(&number) && (number == 0.0 || number.abs() >= TINIEST)
            }
        }
    }

    fn ends(self) -> (f64, f64) {
        match self {
            Self::Signed => (-LARGEST, LARGEST),
            Self::NotNegative => (0.0, LARGEST),
            Self::Positive => (SMALLEST, LARGEST),
            Self::Whole(last) => (1.0, f64::from(last)),
        }
    }
}

/// A number as a whole number, if it is one of the type.
pub(super) fn whole(number: f64) -> Option<u32> {
    // The conversion saturates, so that only a whole number of the type survives it.
    let whole = number as u32;
    f64::from(whole).total_cmp(&number).is_eq().then_some(whole)
}

impl std::fmt::Display for Range {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (low, high) = self.ends();
        match self {
            Self::Whole(_) => write!(formatter, "a whole number from {low} to {high}"),
            Self::NotNegative => {
                write!(formatter, "a number from {low} to {high:e}, either 0 or {TINIEST:e} or more")
            }
            Self::Signed => {
                write!(
                    formatter,
                    "a number from {low:e} to {high:e}, either 0 or {TINIEST:e} or more in magnitude"
                )
            }
            Self::Positive => write!(formatter, "a number from {low:e} to {high:e}"),
        }
    }
}

/// What a column is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Column {
    /// The name in the header; it ends in the unit.
    pub name: &'static str,
    /// The legal values.
    pub range: Range,
    /// What it is for.
    pub role: Role,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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

    pub(crate) fn with_role(&self, role: Role) -> Option<usize> {
        self.columns.iter().position(|column| column.role == role)
    }
}
