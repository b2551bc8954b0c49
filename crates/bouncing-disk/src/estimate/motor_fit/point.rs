//! A catalogue point, and tables of such points.

#[cfg(feature = "csv")]
use crate::csv_records::{fields, lines, text};
use crate::error::{Error, finite, not_negative};
#[cfg(feature = "csv")]
use crate::estimate::measured_speeds::csv_file::{LARGEST_FILE, NAMES, SEPARATORS, name_and_unit, shortened};
#[cfg(feature = "csv")]
use crate::estimate::measured_speeds::decimal_marks::DecimalMarks;
#[cfg(feature = "csv")]
use crate::estimate::measured_speeds::error::{CsvFault, Located, MeasuredSpeedsError};
#[cfg(feature = "csv")]
use crate::estimate::measured_speeds::units::SpeedUnit;
use crate::estimate::motor_fit::parameter::FitRange;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;

/// A field whose value at a point differs from the data sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RatedCondition {
    /// The field.
    pub field: MotorField,
    /// Its value, in the unit of the field.
    pub value: f64,
    /// Its standard error, not negative; independent of the errors of other points. 0 for an exact value.
    pub error: f64,
}

/// A steady speed of a motor from its catalogue or from a measurement: without load, rated, or zero at the
/// stall torque.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RatedPoint {
    /// The mean angular speed (rad/s).
    pub speed: f64,
    /// Its standard error (rad/s), not negative; at least a thousandth of the stator's largest speed is used.
    pub speed_error: f64,
    /// Fields that differ from the data sheet: load torque, volts, amplitude, frequency, preload.
    pub conditions: Vec<RatedCondition>,
}

impl RatedPoint {
    /// A speed under a load torque (N m), each with its standard error; everything else as in the data sheet.
    #[must_use]
    pub fn under_load(torque: [f64; 2], speed: [f64; 2]) -> Self {
        let load = RatedCondition { field: MotorField::LoadTorque, value: torque[0], error: torque[1] };
        Self { speed: speed[0], speed_error: speed[1], conditions: vec![load] }
    }

    /// The same point with one more exact condition.
    #[must_use]
    pub fn at(mut self, field: MotorField, value: f64) -> Self {
        self.conditions.push(RatedCondition { field, value, error: 0.0 });
        self
    }

    pub(crate) fn check(&self, ranges: &[FitRange]) -> Result<(), Error> {
        finite("speed", self.speed)?;
        not_negative("speed_error", self.speed_error)?;
        let mut earlier: Vec<MotorField> = ranges.iter().map(|range| range.parameter.field()).collect();
        for RatedCondition { field, value, error } in &self.conditions {
            finite(field.name(), *value)?;
            not_negative("error of a condition", *error)?;
            for other in &earlier {
                let excludes = field.excluded().contains(other) || other.excluded().contains(field);
                if field == other || excludes {
                    return Err(Error::BothGiven { one: field.name(), other: other.name() });
                }
            }
            earlier.push(*field);
        }
        Ok(())
    }

    pub(crate) fn has_conditions_of(&self, other: &Self) -> bool {
        let values = |point: &Self| {
            let mut values: Vec<_> =
                point.conditions.iter().map(|own| (own.field, own.value.to_bits())).collect();
            values.sort_unstable();
            values
        };
        values(self) == values(other)
    }

    /// The motor at this point, with its conditions shifted by these amounts.
    pub(crate) fn motor(&self, nominal: &Motor, off: &[f64]) -> Result<Motor, Error> {
        let mut sheet = nominal.parameters().clone();
        for (index, condition) in self.conditions.iter().enumerate() {
            let off = off.get(index).copied().unwrap_or(0.0);
            condition.field.set(&mut sheet, condition.value + off);
        }
        sheet.build()
    }
}

#[cfg(feature = "csv")]
impl RatedPoint {
    /// The points of a file of separated values. Its columns are `speed_rad_s` (or another unit, such as
    /// `speed (rpm)`), optionally `speed_error` in that unit, and fields of the data sheet by their names and
    /// in its units, each optionally with a standard error (`load_torque_error`). Decimal commas are read as in
    /// run-ups. An empty field means the data sheet's value, or no error. The result is `None` if the file is
    /// not a table of points: no column is a field of the data sheet, or one contains times. Feature `csv`.
    ///
    /// # Errors
    /// [`MeasuredSpeedsError`] with file, line and field.
    pub fn table_from_csv(
        path: impl AsRef<std::path::Path>,
        speed_unit: Option<SpeedUnit>,
    ) -> Result<Option<Vec<Self>>, MeasuredSpeedsError> {
        let path = path.as_ref();
        let file = path.to_string_lossy();
        let bytes = crate::regular_file::read(path, LARGEST_FILE)
            .map_err(|source| MeasuredSpeedsError::Unreadable { file: file.to_string(), source })?;
        table(&bytes, speed_unit).map_err(|located| located.in_file(&file))
    }
}

#[cfg(feature = "csv")]
#[derive(Clone, Copy, PartialEq)]
enum Column {
    Speed(SpeedUnit),
    SpeedError,
    Value(MotorField),
    Error(MotorField),
}

#[cfg(feature = "csv")]
impl Column {
    /// `None` for an unknown name; for a field in a wrong unit, that unit and the field's own.
    fn of(name: &str, said: Option<SpeedUnit>) -> Option<Result<Self, (String, &'static str)>> {
        if name == "speed_error" {
            return Some(Ok(Self::SpeedError));
        }
        let (plain, unit) = name_and_unit(name);
        if NAMES[1].contains(&plain.as_str()) {
            let own = |unit| SpeedUnit::of(unit).filter(|own| said.is_none_or(|said| said == *own));
            return unit.map_or(said, own).map(|own| Ok(Self::Speed(own)));
        }
        let error = plain.strip_suffix("_error");
        let field: MotorField = error.unwrap_or(&plain).parse().ok()?;
        if let Some(other) = unit.filter(|unit| *unit != field.unit()) {
            return Some(Err((shortened(other), field.unit())));
        }
        Some(Ok(if error.is_some() { Self::Error(field) } else { Self::Value(field) }))
    }
}

#[cfg(feature = "csv")]
fn table(bytes: &[u8], said: Option<SpeedUnit>) -> Result<Option<Vec<RatedPoint>>, Located> {
    let mut lines = lines(text(bytes)?);
    let Some(header) = lines.next() else { return Ok(None) };
    let separator = SEPARATORS.into_iter().find(|separator| header.1.contains(*separator)).unwrap_or(',');
    let names = fields(header, separator)?;
    let columns: Vec<_> = names.iter().map(|name| Column::of(name, said)).collect();
    let of_time = |name: &str| NAMES[0].contains(&name_and_unit(name).0.as_str());
    let has_value = columns.iter().any(|column| matches!(column, Some(Ok(Column::Value(_)) | Err(_))));
    if !has_value || names.iter().any(|name| of_time(name)) {
        return Ok(None);
    }
    let fault = |line: usize, place: usize, what: String| {
        Located(Some(line), Some(place + 1), CsvFault::Points(what))
    };
    for (place, (column, name)) in columns.iter().zip(&names).enumerate() {
        let what = match column {
            None => "is unknown, or its unit is".to_owned(),
            Some(Err((unit, own))) => format!("has the unit {unit:?}, and must be in {own}"),
            Some(Ok(_)) if columns[..place].contains(column) => "occurs twice".to_owned(),
            Some(Ok(_)) => continue,
        };
        return Err(fault(header.0, place, format!("the column {:?} {what}", shortened(name))));
    }
    let columns: Vec<Column> = columns.into_iter().flatten().flatten().collect();
    let unit =
        columns.iter().find_map(|column| if let Column::Speed(unit) = column { Some(*unit) } else { None });
    let unit = unit
        .ok_or_else(|| fault(header.0, 0, "the column of the speed, or its unit, is missing".to_owned()))?;
    let (mut points, mut marks) = (Vec::new(), DecimalMarks::new(separator));
    for line in lines {
        let row = fields(line, separator)?;
        if row.len() != columns.len() {
            let fault = CsvFault::Fields { fields: row.len(), columns: columns.len() };
            return Err(Located(Some(line.0), None, fault));
        }
        let mut point = RatedPoint { speed: f64::NAN, speed_error: 0.0, conditions: Vec::new() };
        let mut errors = Vec::new();
        for (place, (text, column)) in row.iter().zip(&columns).enumerate() {
            if text.is_empty() && !matches!(column, Column::Speed(_)) {
                continue;
            }
            marks.note(line.0, place, text)?;
            let value = marks
                .number(text)
                .map_err(|reason| fault(line.0, place, format!("{:?} is {reason}", shortened(text))))?;
            match *column {
                Column::Speed(_) => point.speed = unit.to_si(value),
                Column::SpeedError => point.speed_error = unit.to_si(value),
                Column::Value(field) => point.conditions.push(RatedCondition { field, value, error: 0.0 }),
                Column::Error(field) => errors.push((place, field, value)),
            }
        }
        for (place, field, error) in errors {
            let own = point.conditions.iter_mut().find(|own| own.field == field);
            own.ok_or_else(|| {
                fault(line.0, place, format!("the error of {field} needs a value of {field}"))
            })?
            .error = error;
        }
        points.push(point);
    }
    marks.check()?;
    Ok(Some(points))
}
