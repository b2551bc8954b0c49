//! Results as rows of named columns with units: aligned for people, comma-separated for programs.

use std::borrow::Borrow;
use std::io::{self, Write};

use bouncing_disk::estimate::IntervalEstimate;
use bouncing_disk_plot::rounded;
use serde_json::{Value, json};

/// Significant digits of a number in a table.
const DIGITS: usize = 6;

/// A cell for people; a missing one, or one that is not a number, is a dash.
fn shown_cell(cell: &Value) -> String {
    match cell.as_f64() {
        Some(number) if cell.is_f64() => rounded(number, DIGITS),
        _ if cell.is_null() => "-".to_owned(),
        _ => exact_cell(cell),
    }
}

/// A cell for programs, with all bits; a missing one is empty.
fn exact_cell(cell: &Value) -> String {
    match cell {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Bool(yes) => if *yes { "yes" } else { "no" }.to_owned(),
        other => other.to_string(),
    }
}

/// Writes comma-separated text.
pub(crate) type WriteTable<'a> = Box<dyn Fn(&mut dyn Write) -> io::Result<()> + 'a>;

/// A column: its name, its unit (`1` for none), and the cell of a row.
struct Column<R> {
    name: String,
    unit: &'static str,
    cell: Box<dyn Fn(&R) -> Value>,
}

impl<R> Column<R> {
    fn head(&self) -> String {
        let name = self.name.replace('_', " ");
        if self.unit == "1" { name } else { format!("{name} ({})", self.unit) }
    }

    /// The name in the library's style: `load_torque_n_m`, `speed_rad_s`.
    fn field(&self) -> String {
        let unit = match self.unit {
            "1" => return self.name.clone(),
            "N/m" => "n_per_m".to_owned(),
            other => other.to_lowercase().replace(['/', ' '], "_").replace('^', ""),
        };
        format!("{}_{unit}", self.name)
    }
}

/// The columns of a table whose rows are made from `R`.
pub(crate) struct Columns<R>(Vec<Column<R>>);

impl<R> Columns<R> {
    pub(crate) const fn new() -> Self {
        Self(Vec::new())
    }

    pub(crate) fn column<T: Into<Value>>(
        mut self,
        name: impl Into<String>,
        unit: &'static str,
        cell: impl Fn(&R) -> T + 'static,
    ) -> Self {
        self.0.push(Column { name: name.into(), unit, cell: Box::new(move |row| cell(row).into()) });
        self
    }

    /// Comma-separated, with a line of names, written row by row so that a large table is never in memory as a
    /// whole.
    pub(crate) fn write_csv(
        &self,
        to: &mut dyn Write,
        rows: impl IntoIterator<Item = impl Borrow<R>>,
    ) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(to);
        csv.write_record(self.0.iter().map(Column::field))?;
        for row in rows {
            csv.write_record(self.0.iter().map(|column| exact_cell(&(column.cell)(row.borrow()))))?;
        }
        csv.flush()
    }

    /// The same for stored rows.
    pub(crate) fn csv_of<'a>(self, rows: Vec<R>) -> WriteTable<'a>
    where
        R: 'a,
    {
        Box::new(move |to| self.write_csv(to, &rows))
    }

    /// Aligned columns: numbers at the right, words at the left.
    pub(crate) fn to_text(&self, rows: impl IntoIterator<Item = impl Borrow<R>>) -> String {
        let cells = |row: &R| self.0.iter().map(|column| (column.cell)(row)).collect();
        let rows: Vec<Vec<Value>> = rows.into_iter().map(|row| cells(row.borrow())).collect();
        let columns = self.0.iter().enumerate().map(|(index, column)| {
            let words = rows.iter().any(|row| row[index].is_string() || row[index].is_boolean());
            let cells: Vec<String> =
                [column.head()].into_iter().chain(rows.iter().map(|row| shown_cell(&row[index]))).collect();
            let width = cells.iter().map(|cell| cell.chars().count()).max().unwrap_or(0);
            let aligned = move |cell: String| {
                if words { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
            };
            cells.into_iter().map(aligned).collect::<Vec<_>>()
        });
        let columns: Vec<Vec<String>> = columns.collect();
        let line = |index: usize| {
            let cells: Vec<&str> = columns.iter().map(|column| column[index].as_str()).collect();
            cells.join("  ").trim_end().to_owned() + "\n"
        };
        (0..=rows.len()).map(line).collect()
    }
}

/// A quantity with its unit, `1` for none.
#[derive(Debug)]
struct Quantity {
    name: String,
    value: Value,
    unit: &'static str,
    /// Whether it is an end of the previous quantity's interval.
    is_end: bool,
}

#[derive(Debug, Default)]
pub(crate) struct Quantities(Vec<Quantity>);

impl Quantities {
    pub(crate) fn push(&mut self, name: &str, value: impl Into<Value>, unit: &'static str) {
        self.0.push(Quantity { name: name.to_owned(), value: value.into(), unit, is_end: false });
    }

    /// Adds a quantity and the ends of its 95 % interval, which are named after it.
    pub(crate) fn push_interval(&mut self, name: &str, estimate: IntervalEstimate, unit: &'static str) {
        self.push(name, estimate.value, unit);
        for (end, value) in [("low", estimate.low), ("high", estimate.high)] {
            let name = format!("{name}_{end}");
            self.0.push(Quantity { name, value: value.into(), unit, is_end: true });
        }
    }

    /// One line each, the unit after the value, and after it the interval.
    pub(crate) fn to_text(&self) -> String {
        let width = self.0.iter().filter(|own| !own.is_end).map(|own| own.name.len()).max().unwrap_or(0);
        let mut lines: Vec<String> = Vec::new();
        for Quantity { name, value, unit, is_end } in &self.0 {
            let value = shown_cell(value);
            match lines.last_mut() {
                // The ends come in pairs.
                Some(line) if *is_end && line.contains(" (95 %: ") => *line += &format!(" to {value})"),
                Some(line) if *is_end => *line += &format!(" (95 %: {value}"),
                _ => {
                    let unit = if *unit == "1" || value == "-" { "" } else { unit };
                    let line = format!("{:<width$}  {value} {unit}", name.replace('_', " "));
                    lines.push(line.trim_end().to_owned());
                }
            }
        }
        lines.iter().map(|line| format!("{line}\n")).collect()
    }

    pub(crate) fn to_json(&self) -> Value {
        let quantity = |own: &Quantity| json!({ "quantity": own.name, "value": own.value, "unit": own.unit });
        self.0.iter().map(quantity).collect::<Vec<_>>().into()
    }

    pub(crate) fn into_csv(self) -> WriteTable<'static> {
        Columns::<Quantity>::new()
            .column("quantity", "1", |own| own.name.clone())
            .column("value", "1", |own| own.value.clone())
            .column("unit", "1", |own| own.unit)
            .csv_of(self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> String {
        let mut bytes = Vec::new();
        write(&mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn people_see_aligned_columns_and_programs_read_all_bits() {
        type Row = (f64, &'static str, Option<f64>);
        let columns = Columns::<Row>::new()
            .column("load_torque", "N m", |row| row.0)
            .column("state", "1", |row| row.1)
            .column("speed", "rad/s^2", |row| row.2);
        let rows = [(1.5e-6, "steady", Some(17.123_456_7)), (0.0, "a \"b\", c", None)];
        let text = "\
load torque (N m)  state     speed (rad/s^2)
           1.5e-6  steady            17.1235
                0  a \"b\", c                -
";
        assert_eq!(columns.to_text(rows), text);
        let csv = "\
load_torque_n_m,state,speed_rad_s2
1.5e-6,steady,17.1234567
0.0,\"a \"\"b\"\", c\",
";
        assert_eq!(written(|to| columns.write_csv(to, rows)), csv);
        // Without rows there are the heads.
        let columns = Columns::<Row>::new().column("spring_constant", "N/m", |row| row.0);
        let none: [Row; 0] = [];
        assert_eq!(columns.to_text(none), "spring constant (N/m)\n");
        assert_eq!(written(|to| columns.write_csv(to, none)), "spring_constant_n_per_m\n");
    }

    #[test]
    fn quantities_have_their_units_behind_them() {
        let mut list = Quantities::default();
        list.push_interval("t", IntervalEstimate { value: 2.0, low: 1.5, high: 3.0 }, "s");
        list.push("efficiency", None::<f64>, "1");
        assert_eq!(list.to_text(), "t           2 s (95 %: 1.5 to 3)\nefficiency  -\n");
        let csv = "quantity,value,unit\nt,2.0,s\nt_low,1.5,s\nt_high,3.0,s\nefficiency,,1\n";
        assert_eq!(written(list.into_csv()), csv);
    }
}
