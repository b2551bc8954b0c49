//! A table written as comma-separated values (RFC 4180).

/// The text of one cell; that of a number reads back to the same double. The numbers of a table are those of the data of its
/// figure, which are finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell(String);

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        // The debug form keeps the exponent of small numbers.
        Self(format!("{number:?}"))
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

/// What does not exist is an empty cell.
impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(cell: Option<T>) -> Self {
        cell.map_or_else(Self::default, Into::into)
    }
}

/// A header with units in the names, and rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Table(Vec<Vec<Cell>>);

impl Table {
    /// An empty table; `columns` name the quantity and its unit: `"speed (rad/s)"`.
    pub fn new<const N: usize>(columns: [&str; N]) -> Self {
        Self(vec![columns.map(Cell::from).into()])
    }

    /// Adds a row.
    pub fn push(&mut self, cells: impl IntoIterator<Item = Cell>) {
        self.0.push(cells.into_iter().collect());
    }

    /// The table as comma-separated values; an error for rows of different lengths.
    pub fn to_csv(&self) -> Result<String, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in &self.0 {
            writer.write_record(row.iter().map(|cell| &cell.0))?;
        }
        let bytes = writer.into_inner().map_err(|error| error.into_error())?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_quotes_and_line_ends_are_quoted() {
        let mut table = Table::new(["parameter", "A (m), printed"]);
        table.push(["plain".into(), 1e-8.into()]);
        table.push(["says \"5\"".into(), None::<f64>.into()]);
        table.push(["two\nlines".into(), Some(0.5).into()]);
        assert_eq!(
            table.to_csv().expect("well formed"),
            "parameter,\"A (m), printed\"\nplain,1e-8\n\"says \"\"5\"\"\",\n\"two\nlines\",0.5\n"
        );
        table.push(["short".into()]);
        assert!(table.to_csv().is_err());
    }

    #[test]
    fn numbers_read_back_to_the_same_double() {
        for number in [0.1 + 0.2, 1e-300, -0.0, 123_456_789.123_456_79, f64::MIN_POSITIVE] {
            let Cell(text) = number.into();
            assert_eq!(text.parse::<f64>().expect("a number").to_bits(), number.to_bits());
        }
    }
}
