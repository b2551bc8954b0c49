//! Printed numbers as typed inputs of the experiments, read from the [catalogue].

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::catalogue::{self, CatalogueError};

/// A value with its uncertainty, printed as `value ± uncertainty`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Uncertain {
    pub(crate) value: f64,
    pub(crate) uncertainty: f64,
}

impl std::fmt::Display for Uncertain {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{} ± {}", self.value, self.uncertainty)
    }
}

/// The keys of entries, each with the power of ten that takes its unit to that of the field.
type Keys = [(&'static str, i32)];

/// Types that can be read from entries.
trait FromCatalogue: Sized {
    fn from_catalogue(keys: &Keys) -> Result<Self, CatalogueError>;
}

fn values(keys: &Keys) -> Result<Vec<f64>, CatalogueError> {
    keys.iter().map(|(key, power)| Ok(catalogue::number(key, *power)?.value)).collect()
}

fn no_number(key: &str, wanted: &'static str) -> CatalogueError {
    let printed = catalogue::text(key).unwrap_or_default().to_owned();
    CatalogueError::NoNumber { key: key.to_owned(), printed, wanted }
}

impl<const N: usize> FromCatalogue for [f64; N] {
    fn from_catalogue(keys: &Keys) -> Result<Self, CatalogueError> {
        let first = keys.first().map_or("", |(key, _)| *key);
        Self::try_from(values(keys)?).map_err(|_| no_number(first, "list of this length"))
    }
}

impl FromCatalogue for Vec<f64> {
    fn from_catalogue(keys: &Keys) -> Result<Self, CatalogueError> {
        values(keys)
    }
}

impl FromCatalogue for f64 {
    fn from_catalogue(keys: &Keys) -> Result<Self, CatalogueError> {
        <[Self; 1]>::from_catalogue(keys).map(|[value]| value)
    }
}

impl FromCatalogue for String {
    fn from_catalogue(keys: &Keys) -> Result<Self, CatalogueError> {
        Ok(catalogue::text(keys.first().map_or("", |(key, _)| *key))?.to_owned())
    }
}

impl FromCatalogue for Uncertain {
    fn from_catalogue(keys: &Keys) -> Result<Self, CatalogueError> {
        let (key, power) = keys.first().copied().unwrap_or_default();
        uncertain(key, power)
    }
}

/// A printed value with its uncertainty, times a power of ten.
pub(crate) fn uncertain(key: &str, power: i32) -> Result<Uncertain, CatalogueError> {
    let number = catalogue::number(key, power)?;
    let uncertainty = number.uncertainty.ok_or_else(|| no_number(key, "value with an uncertainty"))?;
    Ok(Uncertain { value: number.value, uncertainty })
}

/// A printed number, in the unit of its entry.
pub(crate) fn value(key: &str) -> Result<f64, CatalogueError> {
    Ok(catalogue::number(key, 0)?.value)
}

macro_rules! power {
    () => {
        0
    };
    ($power:literal) => {
        $power
    };
}

macro_rules! structs {
    ($($(#[$doc:meta])* $name:ident, $load:ident {
        $($(#[$field_doc:meta])* $field:ident: $kind:ty = $($key:literal $(e $power:literal)?),+;)*
    })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name {
            $($(#[$field_doc])* pub(crate) $field: $kind,)*
        }

        $(#[$doc])*
        pub(crate) fn $load() -> Result<$name, CatalogueError> {
            Ok($name {
                $($field: <$kind>::from_catalogue(&[$(($key, power!($($power)?))),+])?,)*
            })
        }
    )*};
}

structs! {
    /// Table I: full specification of a single toss.
    TableOne, table_one {
        phase_lag_rad: f64 = "table1.phase_lag";
        amplitude_angle_rad: Uncertain = "table1.amplitude_angle";
        stroke_m: Uncertain = "table1.stroke";
        angular_frequency_rad_per_s: Uncertain = "table1.angular_frequency";
        contact_radius_m: Uncertain = "table1.contact_radius";
        gyration_radius_m: Uncertain = "table1.gyration_radius";
        friction: Uncertain = "table1.friction";
        preload_acceleration_m_per_s2: f64 = "table1.preload_acceleration";
    }

    /// Table III: default values for the dimensional parameters of the motor.
    TableThree, table_three {
        friction: f64 = "table3.friction";
        restitution: f64 = "table3.restitution";
        phase_lag_rad: f64 = "table3.phase_lag";
        amplitude_m: f64 = "table3.amplitude";
        peak_angular_speed_rad_per_s: f64 = "table3.peak_angular_speed";
        contact_radius_mm: f64 = "table3.contact_radius";
        gyration_radius_mm: f64 = "table3.gyration_radius";
        /// g as printed; the 70 is ω/2π in kHz.
        preload_acceleration_m_per_s2: f64 = "table3.preload_acceleration";
    }

    /// Numbers of Sec. III and of the captions of Figs. 4 and 5; texts are as printed.
    SectionThree, section_three {
        /// The dough's measured vertical speed at separation.
        launch_speed_m_per_s: Uncertain = "section3.launch_speed";
        /// The dough's measured rotary speed at separation.
        launch_angular_speed_rad_per_s: Uncertain = "section3.launch_angular_speed";
        /// The prediction of the paper's model for it.
        predicted_airborne_speed_rad_per_s: String = "section3.predicted_airborne_speed";
        /// φ_L of the observed tosses.
        observed_amplitude_angle_rad: String = "section3.observed_amplitude_angle";
        /// φ_L of the optimum.
        optimal_amplitude_angle_rad: String = "section3.optimal_amplitude_angle";
        /// The airborne speed at the optimum.
        largest_airborne_speed_rad_per_s: String = "section3.largest_airborne_speed";
        /// ν at the optimum.
        speed_ratio_at_optimum: String = "section3.speed_ratio_at_optimum";
        /// The largest ν.
        largest_speed_ratio: String = "section3.largest_speed_ratio";
        /// φ_L of the largest ν.
        amplitude_angle_of_largest_speed_ratio_rad: String = "section3.amplitude_angle_of_largest_speed_ratio";
        /// φ_L of Fig. 5(c).
        amplitude_angle_of_fig5c_rad: String = "section3.amplitude_angle_of_fig5c";
        /// μ of the curves of Fig. 4(e).
        frictions_of_fig4e: Vec<f64> = "section3.low_friction_of_fig4e", "section3.middle_friction_of_fig4e",
            "section3.high_friction_of_fig4e";
    }

    /// Numbers of Sec. IV and of the captions of Figs. 6 and 7.
    SectionFour, section_four {
        restitution: f64 = "section4.restitution";
        /// Γ from which the period-1 attractor is followed.
        followed_from: f64 = "section4.followed_from";
        /// θ of Fig. 6(c).
        linear_phase_lag_rad: f64 = "section4.phase_lag_of_fig6c";
        /// Γ_T of Fig. 6(c).
        linear_angular_forcing: f64 = "section4.angular_forcing_of_fig6c";
        /// θ of Fig. 6(d).
        semielliptical_phase_lag_rad: f64 = "section4.semielliptical_phase_lag";
        /// Γ_T of Fig. 6(d).
        semielliptical_angular_forcing: f64 = "section4.angular_forcing_of_fig6d";
        /// Γ below which, as the paper says, the chattering orbit follows the pattern of single tosses.
        single_tosses_end: f64 = "section4.single_tosses_end";
        /// Γ above which the attractors merge, as the paper says.
        merging: f64 = "section4.merging";
        /// Γ of the panels of Fig. 7.
        axial_forcings_of_fig7: [f64; 5] = "section4.axial_forcing_of_fig7a", "section4.axial_forcing_of_fig7b",
            "section4.axial_forcing_of_fig7c", "section4.axial_forcing_of_fig7d", "section4.axial_forcing_of_fig7e";
        /// Shares of the period-1 basin in Fig. 7(a) and (b).
        shares_of_period_one: [f64; 2] = "section4.share_at_fig7a" e -2, "section4.share_at_fig7b" e -2;
    }

    /// Numbers of Secs. I and V about ultrasonic motors; texts are as printed.
    SectionFive, section_five {
        /// ω/2π of the default motor.
        default_frequency_hz: f64 = "section1.own_motor_frequency" e 3;
        /// Full preload: gravity.
        gravity_m_per_s2: f64 = "table1.preload_acceleration";
        /// A of the panels of Fig. 10.
        amplitudes_of_fig10_m: [f64; 3] = "section5.smallest_amplitude_of_fig10",
            "section5.middle_amplitude_of_fig10", "section5.largest_amplitude_of_fig10";
        /// A of the authors' motor in the lower estimate of Γ (Sec. I).
        own_motor_amplitude_m: f64 = "section1.own_motor_amplitude" e -9;
        /// A of Tsujino's motor (Sec. I).
        tsujino_amplitude_m: f64 = "section1.tsujino_amplitude" e -6;
        /// ω/2π of Tsujino's motor.
        tsujino_frequency_hz: f64 = "section1.tsujino_frequency" e 3;
        /// g of Tsujino's motor.
        tsujino_preload_acceleration_m_per_s2: f64 = "section1.tsujino_preload_acceleration";
        /// Diameter of the rotor, a steel ball.
        rotor_diameter_m: f64 = "section5.rotor_diameter" e -3;
    }

    /// The preloads of Fig. 11.
    Preloads, preloads {
        /// ω/2π of (a) and (b), and of (c) and (d).
        frequencies_hz: [f64; 2] = "section1.own_motor_frequency" e 3, "section5.second_frequency" e 3;
        /// The lowest and the highest g.
        preload_accelerations_m_per_s2: [f64; 2] = "section5.lowest_preload_acceleration",
            "section5.highest_preload_acceleration";
        /// The range of preloads in which the measured trends hold; printed in mNm, meant in mN
        /// (`docs/errata.md`).
        measured_range_n: [f64; 2] = "section5.lowest_preload" e -3, "section5.highest_preload" e -3;
        /// The preload above which the measured stall torque has a plateau; printed in mNm, meant in mN.
        plateau_n: f64 = "section5.plateau_preload" e -3;
    }

    /// The two cases of Fig. 12.
    ChatteringCases, chattering_cases {
        /// A of the long-period and of the low-period case.
        amplitudes_m: [f64; 2] = "section5.amplitude_of_long_period", "section5.amplitude_of_low_period";
        /// g of the two.
        preload_accelerations_m_per_s2: [f64; 2] = "section5.preload_acceleration_of_long_period",
            "section5.preload_acceleration_of_low_period";
    }

    /// The drop of the steel ball (Sec. V A).
    BallDrop, ball_drop {
        /// The height from which it is dropped.
        drop_height_m: f64 = "section5.drop_height" e -2;
        /// The height to which it rebounds.
        rebound_height_m: Uncertain = "section5.rebound_height" e -2;
    }

    /// The fit of the dough's diameter (Appendix).
    DoughGrowth, dough_growth {
        /// The end of the second toss.
        fit_start_s: f64 = "appendix.fit_start";
        /// The slope of d/d_0.
        fit_slope_per_s: f64 = "appendix.fit_slope";
        /// The first and the last toss of the growth.
        tosses: [f64; 2] = "appendix.first_toss", "appendix.last_toss";
        /// The growth between them, as a share.
        growth: f64 = "appendix.growth" e -2;
    }
}

/// Density of steel, kg/m³: a handbook value; the paper weighs the rotor but does not print the weight.
pub(crate) const STEEL_DENSITY: f64 = 7850.0;

/// Standard gravity, m/s²: it prints as the 9.8 of Table I, and is taken where exactly 9.8 is an exception (`docs/errata.md`).
pub(crate) const STANDARD_GRAVITY: f64 = 9.80665;

impl SectionFive {
    /// The mass of the rotor, kg: a solid steel ball.
    pub(crate) fn rotor_mass_kg(&self) -> f64 {
        let diameter = self.rotor_diameter_m;
        STEEL_DENSITY * PI * diameter * diameter * diameter / 6.0
    }
}

/// The number of inputs that Table III prints.
pub(crate) fn printed_inputs() -> usize {
    catalogue::entries().unwrap_or_default().iter().filter(|entry| entry.place == "Table III").count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_structs_find_their_entries() {
        section_three().expect("reads");
        preloads().expect("reads");
        chattering_cases().expect("reads");
        ball_drop().expect("reads");
        dough_growth().expect("reads");
        let table = table_one().expect("reads");
        assert_eq!(table.contact_radius_m.to_string(), "0.135 ± 0.015");
        assert_eq!(table_three().expect("reads").amplitude_m.to_bits(), 1e-8_f64.to_bits());
        let four = section_four().expect("reads");
        assert_eq!(four.shares_of_period_one.map(f64::to_bits), [0.116, 0.391].map(f64::to_bits));
        assert_eq!(four.semielliptical_phase_lag_rad.to_bits(), (-0.26 * PI).to_bits());
        let five = section_five().expect("reads");
        assert_eq!((five.default_frequency_hz, five.tsujino_amplitude_m), (70_000.0, 5e-6));
        assert!((five.rotor_mass_kg() * five.gravity_m_per_s2 - 0.322).abs() < 5e-4);
    }

    #[test]
    fn table_three_prints_eight_inputs() {
        assert_eq!(printed_inputs(), 8);
    }

    #[test]
    fn a_wrong_kind_is_refused_and_the_entry_named() {
        for error in [
            f64::from_catalogue(&[("section4.three_branches", 0)]).map(drop),
            Uncertain::from_catalogue(&[("section4.doubling_1", 0)]).map(drop),
            <[f64; 2]>::from_catalogue(&[("section4.doubling_1", 0)]).map(drop),
            f64::from_catalogue(&[("section4.doubling_9", 0)]).map(drop),
        ] {
            let text = error.expect_err("wrong kind").to_string();
            assert!(text.contains("section4."), "{text}");
        }
    }
}
