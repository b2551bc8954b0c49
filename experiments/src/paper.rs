//! The numbers that the paper prints in its tables and in Sec. III, read from `data/paper`.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::experiment::ExperimentError;

/// A value with its uncertainty, printed as `value ± uncertainty`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Its uncertainty.
    pub uncertainty: f64,
}

impl Measured {
    /// The value as printed.
    pub fn printed_value(&self) -> String {
        self.value.to_string()
    }
}

impl std::fmt::Display for Measured {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{} ± {}", self.value, self.uncertainty)
    }
}

/// Table I: full specification of a single toss.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableOne {
    /// θ.
    pub phase_lag_rad: f64,
    /// φ_L.
    pub amplitude_angle_rad: Measured,
    /// c.
    pub stroke_m: Measured,
    /// ω.
    pub angular_frequency_rad_per_s: Measured,
    /// a_e.
    pub contact_radius_m: Measured,
    /// a_g.
    pub gyration_radius_m: Measured,
    /// μ.
    pub friction: Measured,
    /// g.
    pub preload_acceleration_m_per_s2: f64,
}

/// Table II: effects of input parameter uncertainties on the airborne speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableTwo {
    /// The airborne speed itself.
    pub airborne_speed_rad_per_s: f64,
    /// Effect of c.
    pub stroke_effect_rad_per_s: f64,
    /// Effect of ω.
    pub angular_frequency_effect_rad_per_s: f64,
    /// Effect of a_e.
    pub contact_radius_effect_rad_per_s: f64,
    /// Effect of a_g.
    pub gyration_radius_effect_rad_per_s: f64,
    /// Effect of μ.
    pub friction_effect_rad_per_s: f64,
    /// Effect of φ_L.
    pub amplitude_angle_effect_rad_per_s: f64,
}

/// Table III: default values for the dimensional parameters of the motor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableThree {
    /// μ.
    pub friction: f64,
    /// ε.
    pub restitution: f64,
    /// θ.
    pub phase_lag_rad: f64,
    /// A.
    pub amplitude_m: f64,
    /// ωΦ.
    pub peak_angular_speed_rad_per_s: f64,
    /// a_e.
    pub contact_radius_mm: f64,
    /// a_g.
    pub gyration_radius_mm: f64,
    /// g as printed; the 70 is ω/2π in kHz.
    pub preload_acceleration_m_per_s2: f64,
}

/// Numbers of Sec. III and of the captions of Figs. 4 and 5; texts are as printed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SectionThree {
    /// The dough's measured vertical speed at separation.
    pub launch_speed_m_per_s: Measured,
    /// The dough's measured rotary speed at separation.
    pub launch_angular_speed_rad_per_s: Measured,
    /// What the paper's model predicts for it.
    pub predicted_airborne_speed_rad_per_s: String,
    /// φ_L of the observed tosses.
    pub observed_amplitude_angle_rad: String,
    /// φ_L of the optimum.
    pub optimal_amplitude_angle_rad: String,
    /// L of the optimum.
    pub optimal_amplitude_ratio: String,
    /// The airborne speed at the optimum.
    pub largest_airborne_speed_rad_per_s: String,
    /// η at the optimum.
    pub largest_efficiency: String,
    /// ν at the optimum.
    pub speed_ratio_at_optimum: String,
    /// The largest ν.
    pub largest_speed_ratio: String,
    /// φ_L of the largest ν.
    pub amplitude_angle_of_largest_speed_ratio_rad: String,
    /// φ_L of Fig. 5(c).
    pub amplitude_angle_of_fig5c_rad: String,
    /// μ of the curves of Fig. 4(e).
    pub frictions_of_fig4e: Vec<f64>,
}

/// Numbers of Secs. I and V about ultrasonic motors; texts are as printed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SectionFive {
    /// ω/2π of the default motor.
    pub default_frequency_hz: f64,
    /// Full preload: gravity.
    pub gravity_m_per_s2: f64,
    /// A of the panels of Fig. 10.
    pub amplitudes_of_fig10_m: [f64; 3],
    /// A of the authors' motor in the lower estimate of Γ (Sec. I).
    pub own_motor_amplitude_m: f64,
    /// ω/2π there.
    pub own_motor_frequency_hz: f64,
    /// Γ there.
    pub own_motor_axial_forcing: String,
    /// A of Tsujino's motor (Sec. I).
    pub tsujino_amplitude_m: f64,
    /// ω/2π of Tsujino's motor.
    pub tsujino_frequency_hz: f64,
    /// g of Tsujino's motor.
    pub tsujino_preload_acceleration_m_per_s2: f64,
    /// Γ printed for Tsujino's motor.
    pub tsujino_axial_forcing: String,
    /// Number of inputs that Sec. V A announces.
    pub announced_inputs: u32,
    /// Number of inputs that Table III prints.
    pub printed_inputs: u32,
    /// Weight of a steel ball of 20 mm diameter.
    pub rotor_weight_n: f64,
}

/// What a file of `data/paper` holds.
#[derive(Deserialize)]
struct Source<T> {
    values: T,
}

macro_rules! tables {
    ($($(#[$doc:meta])* $name:ident: $kind:ty = $file:literal;)*) => {
        $($(#[$doc])*
        ///
        /// # Errors
        ///
        /// When the file does not have the form of this version.
        pub fn $name() -> Result<$kind, ExperimentError> {
            read($file, include_str!(concat!("../../data/paper/", $file)))
        })*
    };
}

tables! {
    /// Table I.
    table_one: TableOne = "table1.json";
    /// Table II.
    table_two: TableTwo = "table2.json";
    /// Table III.
    table_three: TableThree = "table3.json";
    /// The numbers of Sec. III.
    section_three: SectionThree = "section3.json";
    /// The numbers about motors.
    section_five: SectionFive = "section5.json";
}

fn read<T: DeserializeOwned>(file: &str, text: &str) -> Result<T, ExperimentError> {
    let source: Source<T> = serde_json::from_str(text).map_err(|error| ExperimentError::Input {
        path: std::path::Path::new("data/paper").join(file),
        source: Box::new(error),
    })?;
    Ok(source.values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_files_have_the_form_that_is_read() {
        table_two().expect("reads");
        table_three().expect("reads");
        section_three().expect("reads");
        section_five().expect("reads");
        let table = table_one().expect("reads");
        assert_eq!(table.contact_radius_m.to_string(), "0.135 ± 0.015");
        assert_eq!(table.angular_frequency_rad_per_s.printed_value(), "15");
    }

    #[test]
    fn a_misspelt_name_is_refused_and_the_file_named() {
        let error = read::<Measured>("table9.json", r#"{"values": {"value": 1, "uncertianty": 2}}"#)
            .expect_err("misspelt");
        let text = crate::experiment::chain(&error);
        assert!(text.contains("table9.json") && text.contains("uncertianty"), "{text}");
    }
}
