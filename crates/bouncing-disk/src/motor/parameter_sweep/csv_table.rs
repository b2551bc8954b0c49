//! The result of a sweep as comma-separated text.

use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::operation::point::{AxialMotion, Life, OperatingPoint, Operation, Shortfall};
use crate::motor::parameter_sweep::quantity::SweepQuantity;
use crate::motor::parameter_sweep::result::MotorSweepResult;

impl MotorSweepResult {
    /// The cells as comma-separated text: a header, then one line for each branch of each cell, row by row.
    /// The names in the header include units; numbers are written so that reading them back is exact.
    ///
    /// The columns: the axes; `load_torque_n_m`, unless it is an axis; `way` of a continued sweep, `up` or
    /// `down`; `branch`, 1 for the branch that most rotors reach from rest; `motion`, which is `irregular`,
    /// `periodic` or `contact`; `life_s`, the mean life of an irregular motion, if some were seen to end;
    /// `state`, which is `steady`, `unsettled` or `runaway`; `shortfall` of an unsettled cell: `error`,
    /// `drift`, `start` or `power-balance`; each [`SweepQuantity`] of the table ([`SweepQuantity::of_table`])
    /// followed by its standard error (`speed_rad_s`, `speed_error_rad_s`); the other numbers of an
    /// [`OperatingPoint`]; `largest_torque_n_m` and `acceleration_rad_s2` of a runaway. Missing values are
    /// empty.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let quantities = SweepQuantity::of_table(self.cells());
        // Writing to memory does not fail, and all lines have the same number of fields.
        let _ = writer.write_record(self.header(quantities));
        for (cell, (values, row)) in self.iter().enumerate() {
            for (branch, operation) in row.branches.iter().enumerate() {
                let mut fields: Vec<String> = values.iter().map(|(_, value)| written(*value)).collect();
                if !self.varies_load() {
                    fields.push(written(operation.load_torque()));
                }
                if let Some(way) = self.way(cell) {
                    fields.push(way.to_owned());
                }
                fields.push((branch + 1).to_string());
                fields.extend(of_operation(operation, quantities));
                let _ = writer.write_record(fields);
            }
        }
        let bytes = writer.into_inner().unwrap_or_default();
        String::from_utf8(bytes).unwrap_or_default()
    }

    fn varies_load(&self) -> bool {
        self.axes().iter().any(|axis| axis.parameter == MotorField::LoadTorque)
    }

    fn header(&self, quantities: &[SweepQuantity]) -> Vec<String> {
        let of_field = |field: MotorField| column(field.name(), field.unit());
        let mut names: Vec<String> = self.axes().iter().map(|axis| of_field(axis.parameter)).collect();
        if !self.varies_load() {
            names.push(of_field(MotorField::LoadTorque));
        }
        names.extend(self.way(0).map(|_| "way".to_owned()));
        names.extend(["branch", "motion", "life_s", "state", "shortfall"].map(str::to_owned));
        for quantity in quantities {
            names.push(column(quantity.name(), quantity.unit()));
            names.push(column(&format!("{}_error", quantity.name()), quantity.unit()));
        }
        names.extend(OF_POINT.map(|(name, _)| name.to_owned()));
        names.extend(["largest_torque_n_m", "acceleration_rad_s2"].map(str::to_owned));
        names
    }
}

/// A number of an operating point in written form.
type OfPoint = fn(&OperatingPoint) -> String;

/// The numbers of an operating point that have no standard error.
const OF_POINT: [(&str, OfPoint); 7] = [
    ("mean_load_torque_n_m", |point| written(point.load_torque)),
    ("mean_load_torque_error_n_m", |point| written(point.load_torque_error)),
    ("perturbation_power_w", |point| written(point.perturbation_power)),
    ("energy_residual", |point| written(point.energy_residual)),
    ("averaged_time_s", |point| written(point.averaged_time)),
    ("start_up_s", |point| written(point.start_up)),
    ("impacts", |point| point.impacts.to_string()),
];

fn of_operation(operation: &Operation, quantities: &[SweepQuantity]) -> Vec<String> {
    let (state, shortfall, runaway) = match operation {
        Operation::Steady(_) => ("steady", "", None),
        Operation::Unsettled(_, Shortfall::Error { .. }) => ("unsettled", "error", None),
        Operation::Unsettled(_, Shortfall::Drift { .. }) => ("unsettled", "drift", None),
        Operation::Unsettled(_, Shortfall::Start { .. }) => ("unsettled", "start", None),
        Operation::Unsettled(_, Shortfall::PowerBalance { .. }) => ("unsettled", "power-balance", None),
        Operation::Runaway { largest_torque, acceleration, .. } => {
            ("runaway", "", Some((*largest_torque, *acceleration)))
        }
    };
    let (motion, life) = match operation.point().map(|point| point.motion) {
        Some(AxialMotion::Irregular { life: Life::Mean(life) }) => ("irregular", written(life.value)),
        Some(AxialMotion::Irregular { .. }) => ("irregular", String::new()),
        Some(AxialMotion::Periodic { .. }) => ("periodic", String::new()),
        Some(AxialMotion::Contact) => ("contact", String::new()),
        None => ("", String::new()),
    };
    let mut fields = vec![motion.to_owned(), life, state.to_owned(), shortfall.to_owned()];
    for quantity in quantities {
        let estimate = quantity.of(operation);
        fields.push(estimate.map(|estimate| written(estimate.value)).unwrap_or_default());
        fields.push(estimate.map(|estimate| written(estimate.standard_error)).unwrap_or_default());
    }
    let point = operation.point();
    fields.extend(OF_POINT.map(|(_, of)| point.map(of).unwrap_or_default()));
    fields.push(runaway.map(|(torque, _)| written(torque)).unwrap_or_default());
    fields.push(runaway.map(|(_, acceleration)| written(acceleration)).unwrap_or_default());
    fields
}

/// The shortest text that reads back as the same number.
fn written(value: f64) -> String {
    format!("{value:?}")
}

/// The name of a column: `load_torque_n_m`.
fn column(name: &str, unit: &str) -> String {
    let name = name.replace('.', "_");
    match suffix(unit) {
        "" => name,
        suffix => format!("{name}_{suffix}"),
    }
}

/// A unit as part of a name.
fn suffix(unit: &str) -> &'static str {
    match unit {
        "Hz" => "hz",
        "s" => "s",
        "m" => "m",
        "rad" => "rad",
        "rad/s" => "rad_s",
        "rad/m" => "rad_per_m",
        "kg" => "kg",
        "kg/m^3" => "kg_m3",
        "N" => "n",
        "m/s^2" => "m_s2",
        // Not the name of a torque.
        "N/m" => "n_per_m",
        "N m" => "n_m",
        "W" => "w",
        "V" => "v",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Motor;
    use crate::motor::{MotorSweep, OperatingSettings, SweepAxis};
    use crate::parameters::{StatorKind, StatorParameters};
    use bouncing_disk_core::Unobserved;

    fn result() -> MotorSweepResult {
        let motor = Motor::paper_70_khz();
        let loads = [0.0, 0.5, 1.5].map(|share| share * motor.largest_torque());
        let axes = vec![
            SweepAxis::new(MotorField::PhaseLag, vec![0.1, 1.0 / 3.0]),
            SweepAxis::new(MotorField::LoadTorque, loads.to_vec()),
        ];
        let settings = OperatingSettings {
            relative_error: 0.2,
            members: 4,
            most_impacts: 100_000,
            ..OperatingSettings::default()
        };
        MotorSweep::new(motor, axes, settings).and_then(|sweep| sweep.run(&Unobserved)).expect("no failure")
    }

    #[test]
    fn the_table_is_read_to_the_last_bit() {
        let result = result();
        let text = result.to_csv();
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().expect("has one").clone();
        let place = |name: &str| header.iter().position(|own| own == name).expect(name);
        let start: Vec<&str> = header.iter().take(9).collect();
        assert_eq!(
            start,
            [
                "phase_lag_rad",
                "load_torque_n_m",
                "branch",
                "motion",
                "life_s",
                "state",
                "shortfall",
                "speed_rad_s",
                "speed_error_rad_s"
            ]
        );
        let records: Vec<_> = reader.records().map(|record| record.expect("as long")).collect();
        assert_eq!(records.len(), 6);
        let (mut states, mut compared) = (Vec::new(), 0);
        for (record, (values, operation)) in records.iter().zip(result.iter()) {
            let number = |name: &str| record[place(name)].parse::<f64>().ok().map(f64::to_bits);
            assert_eq!(number("phase_lag_rad"), Some(values[0].1.to_bits()));
            assert_eq!(number("load_torque_n_m"), Some(values[1].1.to_bits()));
            for quantity in SweepQuantity::ALL {
                let estimate = quantity.of(operation.operation());
                let name = column(quantity.name(), quantity.unit());
                assert_eq!(number(&name), estimate.map(|estimate| estimate.value.to_bits()), "{name}");
                compared += usize::from(estimate.is_some());
            }
            let point = operation.point();
            assert_eq!(number("energy_residual"), point.map(|point| point.energy_residual.to_bits()));
            assert_eq!(record[place("impacts")].parse().ok(), point.map(|point| point.impacts));
            assert_eq!(number("acceleration_rad_s2").is_some(), point.is_none());
            states.push(record[place("state")].to_owned());
        }
        assert!(
            compared > 20 && states.iter().filter(|state| *state == "runaway").count() == 2,
            "{states:?}"
        );
    }

    #[test]
    fn every_unit_has_a_place_in_a_name_and_no_two_columns_are_alike() {
        for field in MotorField::ALL {
            assert_eq!(suffix(field.unit()).is_empty(), field.unit() == "1", "{field}");
        }
        for quantity in SweepQuantity::WITH_STATOR {
            assert_eq!(suffix(quantity.unit()).is_empty(), quantity.unit() == "1", "{quantity:?}");
        }
        let settings = OperatingSettings {
            members: 4,
            most_impacts: 1,
            relative_error: 0.5,
            ..OperatingSettings::default()
        };
        for field in MotorField::ALL {
            let mut motor = Motor::paper_70_khz().parameters().clone();
            (motor.rotor_radius, motor.load_torque) = (Some(0.01), 1e-6);
            if matches!(field, MotorField::RotorThickness | MotorField::Density) {
                (motor.mass, motor.density, motor.rotor_thickness) = (None, Some(7850.0), Some(0.01));
            }
            let yields = field.name().starts_with("stator.");
            if yields {
                let mut table =
                    StatorParameters { mass: Some(0.05), quality: Some(50.0), ..StatorParameters::default() };
                motor.amplitude = Some(1e-7);
                match field {
                    MotorField::StatorForce => (motor.amplitude, table.force) = (None, Some(20.0)),
                    MotorField::StatorVolts => {
                        (motor.amplitude, table.volts, table.force_per_volt) = (None, Some(20.0), Some(1.0));
                    }
                    MotorField::StatorTwistPerHeight => {
                        motor.peak_angular_speed = None;
                        (table.kind, table.twist_per_height) = (StatorKind::AxialTwist, Some(680.0));
                    }
                    MotorField::StatorResonance => table.resonance = Some(motor.drive_frequency),
                    _ => {}
                }
                motor.stator = Some(table);
            }
            let motor = motor.build().expect("legal");
            let value = field.value(motor.parameters()).unwrap_or(1e-3);
            let sweep = MotorSweep::new(motor, vec![SweepAxis::new(field, vec![value])], settings);
            let result = sweep.and_then(|sweep| sweep.run(&Unobserved)).expect("legal");
            let table = result.to_csv();
            let mut names: Vec<_> = table.lines().next().expect("a header").split(',').collect();
            assert_eq!(names.contains(&"stator_amplitude_m"), yields, "{field}");
            assert_eq!(names.len(), table.lines().nth(1).expect("a cell").split(',').count());
            names.sort();
            let all = names.len();
            names.dedup();
            assert_eq!(names.len(), all, "{field}");
        }
    }
}
