//! Reads plain numeric comma-separated values, and says exactly where they are malformed.
//!
//! Accepted besides the plain form: a byte-order mark, line ends of either kind, blank lines, lines that begin with `#`, `%`
//! or `//`, blanks and one pair of double quotes around a field.

use std::collections::BTreeMap;

use bouncing_disk::csv_records::{self, NumberFault, fields, lines};

use super::error::{LineFault, MeasuredError};
use super::layout::{Column, Layout, MOST_ROWS, Role, whole};
use crate::provenance;
use crate::visible::Excerpt;

/// The numbers of a file and where they are in it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rows {
    /// The rows, in the layout's order of columns.
    pub(super) values: Vec<Vec<f64>>,
    /// The line of each row, from 1.
    pub(super) lines: Vec<usize>,
    /// The column of each column of the layout, from 1.
    pub(super) columns: Vec<usize>,
}

/// Reads all rows of a file.
pub(super) fn rows(layout: &Layout, bytes: &[u8]) -> Result<Rows, MeasuredError> {
    let told = |fault| MeasuredError::Form { file: layout.file, fault };
    let text = csv_records::text(bytes).map_err(told)?;
    // A table that an experiment wrote is read like others, unless its form may be another one.
    let origin = provenance::from_csv(text);
    provenance::refuse_newer(provenance::FIGURE, origin.as_ref(), layout.file)
        .map_err(|error| MeasuredError::Newer(Box::new(error)))?;
    let mut lines = lines(text);
    let empty = || MeasuredError::Empty { file: layout.file, legal: layout.header() };
    let first = lines.next().ok_or_else(empty)?;
    let mut line = first.0;
    let header = Header::read(layout, line, &fields(first, ',').map_err(told)?)?;
    let mut order = Order::new(layout);
    let mut rows = Rows {
        values: Vec::new(),
        lines: Vec::new(),
        columns: header.places.iter().map(|place| place + 1).collect(),
    };
    for own in lines {
        line = own.0;
        let row = header.row(line, &fields(own, ',').map_err(told)?)?;
        order.check(&header, line, &row)?;
        if rows.values.len() == MOST_ROWS {
            return Err(layout.fault(line, None, LineFault::TooLong(MOST_ROWS)));
        }
        rows.values.push(row);
        rows.lines.push(line);
    }
    if rows.values.len() < layout.least_rows {
        let fault = LineFault::TooShort(rows.values.len(), layout.least_rows);
        return Err(layout.fault(line, None, fault));
    }
    Ok(rows)
}

impl Layout {
    fn fault(&self, line: usize, column: Option<(usize, &'static str)>, fault: LineFault) -> MeasuredError {
        MeasuredError::Line { file: self.file, line, column, fault }
    }
}

/// Where the layout's columns are in the file.
struct Header<'a> {
    layout: &'a Layout,
    /// For each column of the layout its place in a line.
    places: Vec<usize>,
}

impl<'a> Header<'a> {
    fn read(layout: &'a Layout, line: usize, names: &[&str]) -> Result<Self, MeasuredError> {
        if layout.columns.len() > 1 && names.len() == 1 {
            let separators = [(';', "semicolons"), ('\t', "tabs")];
            if let Some((_, found)) = separators.into_iter().find(|(sign, _)| names[0].contains(*sign)) {
                return Err(layout.fault(line, None, LineFault::Separator(found, layout.header())));
            }
        }
        let mut places: Vec<Option<usize>> = vec![None; layout.columns.len()];
        for (place, &name) in names.iter().enumerate() {
            let column = place + 1;
            let Some(index) = layout.columns.iter().position(|column| column.name == name) else {
                let fault = LineFault::UnknownColumn(Excerpt::of(name), layout.header());
                return Err(layout.fault(line, Some((column, "")), fault));
            };
            if places[index].replace(place).is_some() {
                let fault = LineFault::RepeatedColumn(layout.columns[index].name);
                return Err(layout.fault(line, Some((column, "")), fault));
            }
        }
        let found = places.iter().zip(layout.columns).map(|(place, column)| {
            let missing = || LineFault::MissingColumn(column.name, layout.header());
            place.ok_or_else(|| layout.fault(line, None, missing()))
        });
        Ok(Self { layout, places: found.collect::<Result<_, _>>()? })
    }

    fn row(&self, line: usize, values: &[&str]) -> Result<Vec<f64>, MeasuredError> {
        let (count, columns) = (values.len(), self.places.len());
        if count != columns {
            let column = count.min(columns) + 1;
            return Err(self.layout.fault(line, Some((column, "")), LineFault::Fields(count, columns)));
        }
        let number = |(place, column): (&usize, &Column)| {
            let (text, legal) = (values[*place], column.range);
            let fault = match csv_records::number(text) {
                Ok(number) if legal.holds(number) => return Ok(number),
                Ok(_) | Err(NumberFault::NoSuchDouble) => LineFault::OutOfRange(Excerpt::of(text), legal),
                Err(NumberFault::NotANumber) => LineFault::NotANumber(Excerpt::of(text), legal),
            };
            Err(self.layout.fault(line, Some((place + 1, column.name)), fault))
        };
        self.places.iter().zip(self.layout.columns).map(number).collect()
    }
}

/// Checks what rises or stays the same within a trial.
struct Order {
    trial: Option<usize>,
    rising: Option<usize>,
    constant: Option<usize>,
    /// The last row of each trial.
    last: BTreeMap<Option<u32>, Vec<f64>>,
}

impl Order {
    fn new(layout: &Layout) -> Self {
        Self {
            trial: layout.with_role(Role::Trial),
            rising: layout.with_role(Role::Rising),
            constant: layout.with_role(Role::Constant),
            last: BTreeMap::new(),
        }
    }

    fn check(&mut self, header: &Header<'_>, line: usize, row: &[f64]) -> Result<(), MeasuredError> {
        let trial = self.trial.and_then(|index| whole(row[index]));
        if let Some(last) = self.last.get(&trial) {
            let pair = |index: usize| {
                let column = (header.places[index] + 1, header.layout.columns[index].name);
                (Some(column), row[index], last[index])
            };
            if let Some((column, value, previous)) = self.rising.map(pair)
                && value <= previous
            {
                let fault = LineFault::NotRising { value, previous, trial };
                return Err(header.layout.fault(line, column, fault));
            }
            if let Some((column, value, previous)) = self.constant.map(pair)
                && value.total_cmp(&previous).is_ne()
            {
                let fault = LineFault::NotConstant { value, previous, trial };
                return Err(header.layout.fault(line, column, fault));
            }
        }
        self.last.insert(trial, row.to_vec());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::Range;
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

    fn fault(text: impl AsRef<[u8]>) -> String {
        rows(&LAYOUT, text.as_ref()).expect_err("malformed").to_string()
    }

    fn fault_of(lines: &str) -> String {
        fault(format!("{HEADER}1,0.3,0,20\n{lines}\n"))
    }

    #[test]
    fn plain_values_are_read() {
        let expected = vec![vec![1.0, 0.3, 0.0, 20.5], vec![1.0, 0.3, 0.1, 1e-3], vec![2.0, 0.2, 0.0, 0.0]];
        let body = "1,0.3,0,20.5\n1,0.3,0.1,1e-3\n2,0.2,0,0\n";
        assert_eq!(
            rows(&LAYOUT, format!("{HEADER}{body}").as_bytes()).expect("well formed").values,
            expected
        );
        let windows = format!("\u{feff}{HEADER}{body}").replace('\n', "\r\n");
        assert_eq!(rows(&LAYOUT, windows.as_bytes()).expect("well formed").values, expected);
        let decorated = format!(
            "# of 3 May\n\n{}\n# first\n \"1\" , 0.3,0,20.5 \n1,0.3,0.1,1e-3\n\n2,0.2,0,\"0\"",
            HEADER.trim_end()
        );
        assert_eq!(rows(&LAYOUT, decorated.as_bytes()).expect("well formed").values, expected);
    }

    #[test]
    fn a_table_of_an_experiment_is_read_unless_its_format_is_newer() {
        let origin = provenance::new(provenance::FIGURE).with("of", "a \"dough\", 'as' printed");
        let body = format!("{HEADER}1,0.3,0,20.5\n1,0.3,0.1,1e-3\n");
        let table = provenance::in_csv(&origin.expect("storable"), &body);
        let read = rows(&LAYOUT, table.as_bytes()).expect("well formed");
        assert_eq!(read.values, rows(&LAYOUT, body.as_bytes()).expect("well formed").values);
        assert_eq!(read.lines, [3, 4]);
        let newer = table.replace("\"format_version\":1", "\"format_version\":2");
        assert!(
            fault(newer).starts_with("\"demo.csv\" has version 2 of the format \"bouncing-disk figure\"")
        );
    }

    #[test]
    fn columns_may_come_in_any_order_and_trials_alternate() {
        let text = "time_s,speed_rad_per_s,trial,preload_n\n0,5,2,0.1\n0,6,1,0.3\n1,4,2,0.1\n1,3,1,0.3\n";
        let read = rows(&LAYOUT, text.as_bytes()).expect("well formed").values;
        assert_eq!(read[3], [1.0, 0.3, 1.0, 3.0]);
    }

    #[test]
    fn a_wrong_header_is_named() {
        let legal = HEADER.trim_end();
        assert_eq!(fault(""), format!("demo.csv is empty; its first line must be {legal}"));
        assert_eq!(
            fault("\u{feff}\r\n# nothing\n"),
            format!("demo.csv is empty; its first line must be {legal}")
        );
        assert_eq!(
            fault("trial,preload_n,t,speed_rad_per_s\n"),
            format!("demo.csv, line 1, column 3: the header has \"t\"; legal is {legal}")
        );
        assert_eq!(
            fault("# mine\ntrial,time_s,speed_rad_per_s\n"),
            format!("demo.csv, line 2: the header has no column \"preload_n\"; legal is {legal}")
        );
        assert_eq!(
            fault("trial,time_s,time_s,preload_n\n"),
            "demo.csv, line 1, column 3: the header has \"time_s\" again"
        );
        assert_eq!(
            fault("trial;preload_n;time_s;speed_rad_per_s\n1;0,3;0;20\n"),
            format!("demo.csv, line 1: columns are separated by semicolons; legal is a comma, as in {legal}")
        );
        // Numbers without a header.
        assert!(fault("1,0.3,0,20\n").starts_with("demo.csv, line 1, column 1: the header has \"1\""));
    }

    #[test]
    fn a_malformed_field_is_named_with_line_column_and_legal_values() {
        assert_eq!(
            fault_of("1,0.3,0.1,fast"),
            "demo.csv, line 3, column 4 (speed_rad_per_s): \"fast\" is not a number; legal is a number from 0 to 1e9, \
             either 0 or 1e-30 or more"
        );
        assert!(fault_of("1,0.3,,19").contains("line 3, column 3 (time_s): \"\" is not a number"));
        for text in ["NaN", "inf", "-inf", "+Infinity"] {
            assert!(
                fault_of(&format!("1,0.3,0.1,{text}")).contains(&format!(": \"{text}\" is not a number;"))
            );
        }
        for text in ["1e999", "-1e400", "-2", "2e9", "1e308", "1e-310", "1e-400", "0.0001e-999", "1e-31"] {
            assert_eq!(
                fault_of(&format!("1,0.3,0.1,{text}")),
                format!(
                    "demo.csv, line 3, column 4 (speed_rad_per_s): {text} is not legal; legal is a number from 0 to \
                     1e9, either 0 or 1e-30 or more"
                )
            );
            assert!(fault_of(&format!("1,0.3,{text},2")).contains(&format!("(time_s): {text} is not legal")));
        }
        for text in ["0", "-0", "0e999", "0.000e-999", "1e-30", "1e9"] {
            let read =
                rows(&LAYOUT, format!("{HEADER}1,0.3,0,{text}\n1,0.3,1,0\n").as_bytes()).expect("legal");
            assert!(read.values[0][3].is_sign_positive());
        }
        assert!(
            fault_of("1,0,0.1,19")
                .contains("(preload_n): 0 is not legal; legal is a number from 1e-12 to 1e9")
        );
        for trial in ["0", "4", "1.5"] {
            let text = fault_of(&format!("{trial},0.3,0.1,19"));
            assert!(
                text.contains(&format!("(trial): {trial} is not legal; legal is a whole number from 1 to 3")),
                "{text}"
            );
        }
    }

    #[test]
    fn what_a_message_quotes_is_short_and_visible() {
        let long = "9".repeat(5_000_000);
        let cut = format!("{}… (5000000 characters) is not legal", "9".repeat(40));
        assert!(fault_of(&format!("1,0.3,0.1,{long}")).contains(&cut));
        let text = fault_of(&format!("1,0.3,0.1,\u{1b}[2J{}", "x".repeat(5_000_000)));
        assert!(
            text.contains(r#""\u{1b}[2Jxxx"#) && text.contains("…\" (5000004 characters) is not a number")
        );
        assert!(text.len() < 300, "{text}");
        let text = fault(format!("trial,\u{202e}{}\n", "y".repeat(5_000_000)));
        assert!(text.contains(r#"the header has "\u{202e}yyy"#) && text.len() < 300, "{text}");
        // Line ends of another kind, and an encoding of two bytes a letter.
        assert!(fault("trial\r1\r").contains(r#"the header has "trial\r1""#));
        assert!(fault("t\0r\0").contains(r#"the header has "t\u{0}r"#));
        assert!(
            fault_of(&",".repeat(1_000_000)).ends_with("column 5: the line has 1000001 fields; legal is 4")
        );
    }

    #[test]
    fn a_record_longer_than_a_picture_can_show_is_refused() {
        let lines = (0..MOST_ROWS).fold(HEADER.to_owned(), |text, line| text + &format!("1,0.3,{line},2\n"));
        assert_eq!(rows(&LAYOUT, lines.as_bytes()).expect("as many as are legal").values.len(), MOST_ROWS);
        assert_eq!(
            fault(lines + "2,0.3,0,2\n"),
            "demo.csv, line 10002: the file has more than 10000 lines of numbers; legal are 10000 or fewer"
        );
    }

    #[test]
    fn quotation_marks_hold_commas_and_end_on_their_line() {
        assert!(
            fault_of("1,\"0,3\",0.1,19").contains("line 3, column 2 (preload_n): \"0,3\" is not a number")
        );
        let open = "demo.csv, line 4, field 2: a quotation mark is not closed on its line";
        assert_eq!(fault_of("# of May\n1,\"0.3,0.1,19\n1,0.3,0.2,18"), open);
        assert_eq!(fault_of("\n1,\"0.3,0.1,19"), open);
    }

    #[test]
    fn a_ragged_line_is_named() {
        assert_eq!(fault_of("1,0.3,0.1"), "demo.csv, line 3, column 4: the line has 3 fields; legal is 4");
        assert_eq!(
            fault_of("1,0.3,0.1,19,"),
            "demo.csv, line 3, column 5: the line has 5 fields; legal is 4"
        );
    }

    #[test]
    fn order_within_a_trial_is_checked() {
        assert_eq!(
            fault_of("2,0.1,0,9\n1,0.3,0,19"),
            "demo.csv, line 4, column 3 (time_s): 0 follows 0; legal is a larger number on every line of trial 1"
        );
        assert_eq!(
            fault_of("1,0.2,0.1,19"),
            "demo.csv, line 3, column 2 (preload_n): 0.2 follows 0.3; legal is the same number on every line of trial 1"
        );
        const SINGLE: Layout =
            Layout { columns: &[Column::time(), Column::value("d", Range::Positive)], ..LAYOUT };
        let error = rows(&SINGLE, b"time_s,d\n1,2\n0.5,3\n").expect_err("falls").to_string();
        assert!(error.ends_with("0.5 follows 1; legal is a larger number on every line"), "{error}");
    }

    #[test]
    fn too_few_lines_and_other_encodings_are_refused() {
        assert_eq!(
            fault(HEADER),
            "demo.csv, line 1: the file ends after 0 lines of numbers; legal is 2 or more"
        );
        assert_eq!(
            fault(format!("{HEADER}1,0.3,0,20\n")),
            "demo.csv, line 2: the file ends after 1 lines of numbers; legal is 2 or more"
        );
        let mut latin = HEADER.as_bytes().to_vec();
        latin.extend(b"1,0.3,\xb5,2\n");
        assert_eq!(fault(latin), "demo.csv, line 2, byte 7: not text in UTF-8");
        assert_eq!(fault(b"\xff\xfet\0r\0"), "demo.csv, line 1, byte 1: not text in UTF-8");
    }
}
