//! A table written as comma-separated values (RFC 4180).

use std::borrow::Cow;

/// One cell.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cell {
    /// A number, written so that reading it gives the same double.
    Number(f64),
    /// A count.
    Integer(i64),
    /// Words.
    Text(String),
    /// Nothing.
    Empty,
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<Option<f64>> for Cell {
    fn from(number: Option<f64>) -> Self {
        number.map_or(Self::Empty, Self::Number)
    }
}

impl From<i64> for Cell {
    fn from(number: i64) -> Self {
        Self::Integer(number)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// Why a table cannot be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// A row is shorter or longer than the header.
    #[error("row {row} has {cells} cells under {columns} columns")]
    RowLength {
        /// The row, counted from 1 without the header.
        row: usize,
        /// Its cells.
        cells: usize,
        /// The columns of the header.
        columns: usize,
    },
    /// A cell holds a number that is not finite; an absent number is [`Cell::Empty`].
    #[error("row {row}, column \"{column}\" holds {number}")]
    NotFinite {
        /// The row, counted from 1 without the header.
        row: usize,
        /// The name of the column.
        column: String,
        /// The number.
        number: f64,
    },
    /// The text could not be put together.
    #[error("{message}")]
    Unwritten {
        /// What was reported.
        message: String,
    },
}

/// A header with units in the names, and rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table; `columns` name the quantity and its unit: `"speed (rad/s)"`.
    pub fn new<S: Into<String>>(columns: impl IntoIterator<Item = S>) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    #[must_use]
    pub fn row(mut self, cells: impl IntoIterator<Item = Cell>) -> Self {
        self.push(cells);
        self
    }

    /// Adds a row in place.
    pub fn push(&mut self, cells: impl IntoIterator<Item = Cell>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// The table as comma-separated values.
    pub fn to_csv(&self) -> Result<String, TableError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.columns).map_err(unwritten)?;
        for (index, cells) in self.rows.iter().enumerate() {
            if cells.len() != self.columns.len() {
                let (cells, columns) = (cells.len(), self.columns.len());
                return Err(TableError::RowLength { row: index + 1, cells, columns });
            }
            let written = cells.iter().zip(&self.columns).map(|(cell, column)| match cell {
                Cell::Number(number) if !number.is_finite() => {
                    Err(TableError::NotFinite { row: index + 1, column: column.clone(), number: *number })
                }
                // The debug form keeps the exponent of small numbers and reads back to the same double.
                Cell::Number(number) => Ok(format!("{number:?}").into()),
                Cell::Integer(number) => Ok(number.to_string().into()),
                Cell::Text(text) => Ok(Cow::Borrowed(text.as_str())),
                Cell::Empty => Ok(Cow::Borrowed("")),
            });
            let written: Vec<Cow<'_, str>> = written.collect::<Result<_, _>>()?;
            writer.write_record(written.iter().map(|cell| cell.as_bytes())).map_err(unwritten)?;
        }
        let bytes = writer.into_inner().map_err(unwritten)?;
        String::from_utf8(bytes).map_err(unwritten)
    }
}

fn unwritten(error: impl std::error::Error) -> TableError {
    TableError::Unwritten { message: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_quotes_and_line_ends_are_quoted() {
        let table = Table::new(["parameter", "A (m), printed"])
            .row([Cell::from("plain"), 1e-8.into()])
            .row([Cell::from("says \"5\""), Cell::Empty])
            .row([Cell::from("two\nlines"), 3_i64.into()]);
        assert_eq!(
            table.to_csv().expect("well formed"),
            "parameter,\"A (m), printed\"\nplain,1e-8\n\"says \"\"5\"\"\",\n\"two\nlines\",3\n"
        );
    }

    #[test]
    fn numbers_read_back_to_the_same_double() {
        for number in [0.1 + 0.2, 1e-300, -0.0, 123_456_789.123_456_79, f64::MIN_POSITIVE] {
            let csv = Table::new(["x"]).row([number.into()]).to_csv().expect("finite");
            let text = csv.lines().nth(1).expect("one row");
            assert_eq!(text.parse::<f64>().expect("a number").to_bits(), number.to_bits());
        }
    }

    #[test]
    fn malformed_tables_are_refused() {
        let short = Table::new(["a", "b"]).row([Cell::Empty]);
        assert_eq!(short.to_csv(), Err(TableError::RowLength { row: 1, cells: 1, columns: 2 }));
        let infinite = Table::new(["a"]).row([f64::INFINITY.into()]);
        assert!(matches!(infinite.to_csv(), Err(TableError::NotFinite { row: 1, .. })));
    }
}
