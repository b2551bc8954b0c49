//! The inputs of the paper's toss (Tables I and II) and of its motor (Table III, Figs. 11 and 13): symbols, units, where they are
//! printed, and how they are read from a case and set in it.

use std::fmt;

use serde::{Serialize, Serializer};

use super::motor::MotorCase;
use super::toss::TossCase;
use crate::claims::catalogue::{self, CatalogueError, PrintedEntry};

/// A quantity that is an input of a toss, of a motor, or of both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quantity {
    /// The name in `data/paper`, after that of the table.
    pub(crate) name: &'static str,
    /// The symbol in text.
    pub(crate) symbol: &'static str,
    /// The symbol as it is set in print.
    pub(crate) label: &'static str,
    /// The SI unit; empty for a pure number.
    pub(crate) unit: &'static str,
}

impl Quantity {
    /// Its name in words.
    pub(crate) fn words(&self) -> String {
        self.name.replace('_', " ")
    }
}

/// A quantity as an input of a case.
pub(crate) struct Input<Case> {
    quantity: Quantity,
    field: fn(&mut Case) -> &mut f64,
}

/// A case that has inputs, and the table of the paper that prints them.
pub(crate) trait Tabled {
    const TABLE: &'static str;
}

impl Tabled for TossCase {
    const TABLE: &'static str = "table1";
}

impl Tabled for MotorCase {
    const TABLE: &'static str = "table3";
}

const fn quantity(
    name: &'static str,
    symbol: &'static str,
    label: &'static str,
    unit: &'static str,
) -> Quantity {
    Quantity { name, symbol, label, unit }
}

impl Quantity {
    const fn of<Case>(self, field: fn(&mut Case) -> &mut f64) -> Input<Case> {
        Input { quantity: self, field }
    }
}

const THETA: Quantity = quantity("phase_lag", "θ", r"$\theta$", "rad");
const A_E: Quantity = quantity("contact_radius", "a_e", "$a_e$", "m");
const A_G: Quantity = quantity("gyration_radius", "a_g", "$a_g$", "m");
const MU: Quantity = quantity("friction", "μ", r"$\mu$", "");
const G: Quantity = quantity("preload_acceleration", "g", "$g$", "m/s²");

/// The inputs of a toss.
pub(crate) mod toss {
    use super::{A_E, A_G, G, Input, MU, THETA, TossCase, quantity};

    type Of = Input<TossCase>;

    pub(crate) const PHASE_LAG: Of = THETA.of(|toss| &mut toss.phase_lag_rad);
    pub(crate) const AMPLITUDE_ANGLE: Of =
        quantity("amplitude_angle", "φ_L", r"$\phi_L$", "rad").of(|toss| &mut toss.amplitude_angle_rad);
    pub(crate) const STROKE: Of = quantity("stroke", "c", "$c$", "m").of(|toss| &mut toss.stroke_m);
    pub(crate) const ANGULAR_FREQUENCY: Of = quantity("angular_frequency", "ω", r"$\omega$", "rad/s")
        .of(|toss| &mut toss.angular_frequency_rad_per_s);
    pub(crate) const CONTACT_RADIUS: Of = A_E.of(|toss| &mut toss.contact_radius_m);
    pub(crate) const GYRATION_RADIUS: Of = A_G.of(|toss| &mut toss.gyration_radius_m);
    pub(crate) const FRICTION: Of = MU.of(|toss| &mut toss.friction);
    pub(crate) const PRELOAD_ACCELERATION: Of = G.of(|toss| &mut toss.preload_acceleration_m_per_s2);

    /// Those with an uncertainty, in the order of Table II.
    pub(crate) const TABLE_TWO: [Of; 6] =
        [STROKE, ANGULAR_FREQUENCY, CONTACT_RADIUS, GYRATION_RADIUS, FRICTION, AMPLITUDE_ANGLE];
}

/// The inputs of a motor.
pub(crate) mod motor {
    use super::{A_E, A_G, G, Input, MU, MotorCase, THETA, quantity};

    type Of = Input<MotorCase>;

    pub(crate) const GYRATION_RADIUS: Of = A_G.of(|motor| &mut motor.gyration_radius_m);
    pub(crate) const CONTACT_RADIUS: Of = A_E.of(|motor| &mut motor.contact_radius_m);
    /// Table III does not print it.
    pub(crate) const FREQUENCY: Of =
        quantity("frequency", "ω/2π", r"$\omega/2\pi$", "Hz").of(|motor| &mut motor.frequency_hz);
    pub(crate) const PRELOAD_ACCELERATION: Of = G.of(|motor| &mut motor.preload_acceleration_m_per_s2);
    pub(crate) const FRICTION: Of = MU.of(|motor| &mut motor.friction);
    pub(crate) const RESTITUTION: Of =
        quantity("restitution", "ε", r"$\epsilon$", "").of(|motor| &mut motor.restitution);
    pub(crate) const AMPLITUDE: Of =
        quantity("amplitude", "A", "$A$", "m").of(|motor| &mut motor.amplitude_m);
    pub(crate) const PEAK_ANGULAR_SPEED: Of = quantity("peak_angular_speed", "ωΦ", r"$\omega \Phi$", "rad/s")
        .of(|motor| &mut motor.peak_angular_speed_rad_per_s);
    pub(crate) const PHASE_LAG: Of = THETA.of(|motor| &mut motor.phase_lag_rad);

    /// "Accurately known", by Sec. V A.
    pub(crate) const KNOWN: [Of; 4] = [GYRATION_RADIUS, CONTACT_RADIUS, FREQUENCY, PRELOAD_ACCELERATION];
    /// Estimated, in the order of Sec. V A.
    pub(crate) const ESTIMATED: [Of; 5] = [FRICTION, RESTITUTION, AMPLITUDE, PEAK_ANGULAR_SPEED, PHASE_LAG];
    /// The estimated ones in the order of the panels of Fig. 13.
    pub(crate) const PANELS: [Of; 5] = [FRICTION, RESTITUTION, PHASE_LAG, AMPLITUDE, PEAK_ANGULAR_SPEED];
    /// Those that the motors of Figs. 10 to 12 share.
    pub(crate) const SHARED: [Of; 4] = [FRICTION, RESTITUTION, PHASE_LAG, PEAK_ANGULAR_SPEED];
}

impl<Case: Copy> Input<Case> {
    /// Its value in a case.
    pub(crate) fn of(&self, case: &Case) -> f64 {
        *(self.field)(&mut { *case })
    }

    /// The case with another value of it.
    pub(crate) fn set(&self, case: &Case, value: f64) -> Case {
        let mut changed = *case;
        *(self.field)(&mut changed) = value;
        changed
    }

    /// The same for a list of parameters: its symbol, and its value with the unit.
    pub(crate) fn row(&self, case: &Case) -> (String, String) {
        (self.symbol.to_owned(), with_unit(&self.of(case).to_string(), self.unit))
    }
}

impl<Case: Tabled> Input<Case> {
    /// Its entry in the table of the paper.
    pub(crate) fn key(&self) -> String {
        format!("{}.{}", Case::TABLE, self.name)
    }

    /// What the table prints for it, with the printed unit.
    pub(crate) fn entry(&self) -> Result<&'static PrintedEntry, CatalogueError> {
        catalogue::find(&self.key())
    }
}

/// A value with its unit, if it has one.
pub(crate) fn with_unit(value: &str, unit: &str) -> String {
    format!("{value} {unit}").trim_end().to_owned()
}

impl<Case> std::ops::Deref for Input<Case> {
    type Target = Quantity;

    fn deref(&self) -> &Quantity {
        &self.quantity
    }
}

// By hand: a case need not be any of these.
impl<Case> Clone for Input<Case> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Case> Copy for Input<Case> {}

impl<Case> PartialEq for Input<Case> {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl<Case> fmt::Debug for Input<Case> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name)
    }
}

impl<Case> Serialize for Input<Case> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::paper;

    /// A field that is set is the one that is read, and no other; printed values are those of the cases.
    #[test]
    fn each_input_is_its_own_field_and_prints_its_value() {
        let toss_case = TossCase::from(&paper::table_one().expect("reads"));
        let toss_inputs = [&toss::TABLE_TWO[..], &[toss::PHASE_LAG, toss::PRELOAD_ACCELERATION]].concat();
        for input in &toss_inputs {
            let changed = input.set(&toss_case, 123.0);
            assert!(
                toss_inputs
                    .iter()
                    .all(|other| other.of(&changed).total_cmp(&123.0).is_eq() == (other == input)),
                "{input:?}"
            );
            let printed = catalogue::number(&input.key(), 0).expect("printed").value;
            assert_eq!(printed.to_bits(), input.of(&toss_case).to_bits(), "{input:?}");
            assert_eq!(input.entry().expect("printed").unit, input.unit, "{input:?}");
        }
        let motor_case = MotorCase::table_three().expect("reads");
        let motor_inputs = [&motor::KNOWN[..], &motor::ESTIMATED].concat();
        for input in &motor_inputs {
            let changed = input.set(&motor_case, 123.0);
            assert!(
                motor_inputs
                    .iter()
                    .all(|other| other.of(&changed).total_cmp(&123.0).is_eq() == (other == input)),
                "{input:?}"
            );
            if [motor::FREQUENCY, motor::PRELOAD_ACCELERATION].contains(input) {
                continue;
            }
            let unit = &input.entry().expect("printed").unit;
            let power = if unit == "mm" { -3 } else { 0 };
            let printed = catalogue::number(&input.key(), power).expect("printed").value;
            assert!((printed - input.of(&motor_case)).abs() <= 1e-15 * printed.abs(), "{input:?}");
            assert!(unit == input.unit || unit == "mm", "{input:?}");
        }
    }
}
