//! Tables: aligned for people, comma-separated for programs.

use std::fmt::Write as _;
use std::io::{self, Write};

use bouncing_disk::IntervalEstimate;
use serde_json::{Value, json};

use super::numbers::{exact, shown};

/// What stands in a table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell {
    Number(f64),
    Count(u64),
    Text(String),
    /// There is no such thing here.
    Nothing,
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<u64> for Cell {
    fn from(value: u64) -> Self {
        Self::Count(value)
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Self::Count(value as u64)
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

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Nothing, Into::into)
    }
}

impl Cell {
    fn shown(&self) -> String {
        match self {
            Self::Number(value) => shown(*value),
            Self::Count(count) => count.to_string(),
            Self::Text(text) => text.clone(),
            Self::Nothing => "-".to_owned(),
        }
    }

    /// As a field of comma-separated text: what is not there is empty.
    fn field(&self) -> String {
        match self {
            Self::Number(value) => exact(*value),
            Self::Count(count) => count.to_string(),
            Self::Text(text) => quoted(text),
            Self::Nothing => String::new(),
        }
    }

    fn to_json(&self) -> Value {
        match self {
            Self::Number(value) => json!(value),
            Self::Count(count) => json!(count),
            Self::Text(text) => json!(text),
            Self::Nothing => Value::Null,
        }
    }

    const fn is_text(&self) -> bool {
        matches!(self, Self::Text(_))
    }
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// The name of a column and its unit, `1` where it has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Column {
    name: &'static str,
    unit: &'static str,
}

impl Column {
    pub(crate) const fn new(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit }
    }

    fn head(&self) -> String {
        let name = self.name.replace('_', " ");
        if self.unit == "1" { name } else { format!("{name} ({})", self.unit) }
    }

    /// As the library names columns: `load_torque_n_m`, `speed_rad_s`.
    fn field(&self) -> String {
        let unit = match self.unit {
            "1" => return self.name.to_owned(),
            "N/m" => "n_per_m".to_owned(),
            other => other.to_lowercase().replace(['/', ' '], "_").replace('^', ""),
        };
        format!("{}_{unit}", self.name)
    }
}

/// Comma-separated text that is written row by row: a large table never is in memory as a whole.
pub(crate) struct Csv<'w> {
    to: &'w mut dyn Write,
    columns: usize,
}

impl<'w> Csv<'w> {
    /// Begins with the line of names.
    pub(crate) fn begin(to: &'w mut dyn Write, columns: &[Column]) -> io::Result<Self> {
        let names: Vec<String> = columns.iter().map(Column::field).collect();
        writeln!(to, "{}", names.join(","))?;
        Ok(Self { to, columns: columns.len() })
    }

    /// Writes a row; cells that are missing are empty.
    pub(crate) fn row(&mut self, cells: &[Cell]) -> io::Result<()> {
        let mut fields: Vec<String> = cells.iter().map(Cell::field).collect();
        fields.resize(self.columns, String::new());
        writeln!(self.to, "{}", fields.join(","))
    }
}

/// A table.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
    /// What the library has written already.
    csv: Option<String>,
}

impl Table {
    pub(crate) fn new(columns: &[(&'static str, &'static str)]) -> Self {
        let columns = columns.iter().map(|(name, unit)| Column::new(name, unit)).collect();
        Self { columns, ..Self::default() }
    }

    /// Of comma-separated text with a line of names; it has no other form.
    pub(crate) fn of_csv(text: String) -> Self {
        Self { csv: Some(text), ..Self::default() }
    }

    /// Adds a row; cells that are missing are empty.
    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        let mut row: Vec<Cell> = row.into_iter().collect();
        row.resize(self.columns.len(), Cell::Nothing);
        self.rows.push(row);
    }

    /// Comma-separated, with a line of names.
    pub(crate) fn write_csv(&self, to: &mut dyn Write) -> io::Result<()> {
        if let Some(text) = &self.csv {
            return to.write_all(text.as_bytes());
        }
        let mut csv = Csv::begin(to, &self.columns)?;
        self.rows.iter().try_for_each(|row| csv.row(row))
    }

    #[cfg(test)]
    pub(crate) fn to_csv(&self) -> String {
        let mut bytes = Vec::new();
        self.write_csv(&mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    /// Aligned columns: numbers at the right, words at the left.
    pub(crate) fn to_text(&self) -> String {
        let heads: Vec<String> = self.columns.iter().map(Column::head).collect();
        let rows: Vec<Vec<String>> =
            self.rows.iter().map(|row| row.iter().map(Cell::shown).collect()).collect();
        let width = |column: usize| {
            let own = rows.iter().map(|row| row[column].chars().count());
            own.chain([heads[column].chars().count()]).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..heads.len()).map(width).collect();
        let words: Vec<bool> =
            (0..heads.len()).map(|column| self.rows.iter().any(|row| row[column].is_text())).collect();
        let mut text = String::new();
        for row in std::iter::once(&heads).chain(&rows) {
            let mut line = String::new();
            for ((cell, width), words) in row.iter().zip(&widths).zip(&words) {
                // Writing to a string does not fail.
                let _ =
                    if *words { write!(line, "{cell:<width$}  ") } else { write!(line, "{cell:>width$}  ") };
            }
            text += line.trim_end();
            text.push('\n');
        }
        text
    }
}

/// A quantity with its unit, `1` where it has none.
#[derive(Debug, Clone)]
struct Quantity {
    name: &'static str,
    value: Cell,
    unit: &'static str,
    /// Whether it is an end of the interval of the quantity before.
    is_end: bool,
}

/// A list of quantities.
#[derive(Debug, Clone, Default)]
pub(crate) struct Quantities(Vec<Quantity>);

impl Quantities {
    pub(crate) fn push(&mut self, name: &'static str, value: impl Into<Cell>, unit: &'static str) {
        self.0.push(Quantity { name, value: value.into(), unit, is_end: false });
    }

    /// Adds a quantity with its 95 % interval: its name and those of the two ends.
    pub(crate) fn push_interval(
        &mut self,
        names: [&'static str; 3],
        estimate: IntervalEstimate,
        unit: &'static str,
    ) {
        let [name, low, high] = names;
        self.push(name, estimate.value, unit);
        for (name, end) in [(low, estimate.low), (high, estimate.high)] {
            self.0.push(Quantity { name, value: end.into(), unit, is_end: true });
        }
    }

    /// Adds all of another list.
    pub(crate) fn append(&mut self, other: Self) {
        self.0.extend(other.0);
    }

    /// One line each, the unit after the value, and after it the interval.
    pub(crate) fn to_text(&self) -> String {
        let lines = || self.0.iter().enumerate().filter(|(_, own)| !own.is_end);
        let width = lines().map(|(_, own)| own.name.len()).max().unwrap_or(0);
        let mut text = String::new();
        for (index, Quantity { name, value, unit, .. }) in lines() {
            let unit = if *unit == "1" || *value == Cell::Nothing { "" } else { unit };
            let line = format!("{:<width$}  {} {unit}", name.replace('_', " "), value.shown());
            text += line.trim_end();
            let ends = self.0[index + 1..].iter().take_while(|own| own.is_end).map(|own| own.value.shown());
            if let [low, high] = &ends.collect::<Vec<_>>()[..] {
                text += &format!(" (95 %: {low} to {high})");
            }
            text.push('\n');
        }
        text
    }

    /// As a list of objects.
    pub(crate) fn to_json(&self) -> Value {
        let quantity =
            |own: &Quantity| json!({ "quantity": own.name, "value": own.value.to_json(), "unit": own.unit });
        self.0.iter().map(quantity).collect::<Vec<_>>().into()
    }

    /// As a table of three columns.
    pub(crate) fn to_table(&self) -> Table {
        let mut table = Table::new(&[("quantity", "1"), ("value", "1"), ("unit", "1")]);
        for Quantity { name, value, unit, .. } in &self.0 {
            table.push([(*name).into(), value.clone(), (*unit).into()]);
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new(&[("load_torque", "N m"), ("state", "1"), ("speed", "rad/s")]);
        table.push([1.5e-6.into(), "steady".into(), 17.123_456_7.into()]);
        table.push([0.0.into(), "a \"b\", c".into()]);
        table
    }

    #[test]
    fn people_see_units_and_aligned_columns() {
        let expected = "\
load torque (N m)  state     speed (rad/s)
           1.5e-6  steady          17.1235
                0  a \"b\", c              -
";
        assert_eq!(table().to_text(), expected);
    }

    #[test]
    fn programs_read_all_bits_and_units_in_the_names() {
        let expected = "\
load_torque_n_m,state,speed_rad_s
1.5e-6,steady,17.1234567
0.0,\"a \"\"b\"\", c\",
";
        assert_eq!(table().to_csv(), expected);
        assert_eq!(Column::new("spring_constant", "N/m").field(), "spring_constant_n_per_m");
        assert_eq!(Column::new("acceleration", "rad/s^2").field(), "acceleration_rad_s2");
    }

    #[test]
    fn a_row_that_lacks_cells_is_filled_up() {
        let mut bytes = Vec::new();
        let columns = [Column::new("a", "1"), Column::new("exponent", "per impact")];
        Csv::begin(&mut bytes, &columns).and_then(|mut csv| csv.row(&[1_u64.into()])).unwrap();
        assert_eq!(String::from_utf8(bytes).unwrap(), "a,exponent_per_impact\n1,\n");
    }

    #[test]
    fn an_empty_table_has_its_heads() {
        let table = Table::new(&[("phase", "rad")]);
        assert_eq!((table.to_text().as_str(), table.to_csv().as_str()), ("phase (rad)\n", "phase_rad\n"));
    }

    #[test]
    fn quantities_have_their_units_behind_them() {
        let mut list = Quantities::default();
        list.push("speed", 2.0, "rad/s");
        list.push("efficiency", None::<f64>, "1");
        assert_eq!(list.to_text(), "speed       2 rad/s\nefficiency  -\n");
        assert_eq!(list.to_table().to_csv(), "quantity,value,unit\nspeed,2.0,rad/s\nefficiency,,1\n");
        let mut list = Quantities::default();
        list.push_interval(
            ["t", "t_low", "t_high"],
            IntervalEstimate { value: 2.0, low: 1.5, high: 3.0 },
            "s",
        );
        list.push("u", 1.0, "1");
        assert_eq!(list.to_text(), "t  2 s (95 %: 1.5 to 3)\nu  1\n");
        assert_eq!(
            list.to_table().to_csv(),
            "quantity,value,unit\nt,2.0,s\nt_low,1.5,s\nt_high,3.0,s\nu,1.0,1\n"
        );
    }
}
