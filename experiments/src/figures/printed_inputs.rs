//! Motors and tosses whose inputs all round to the printed ones.
//!
//! The orbit of a motor hangs on digits that the paper does not print: at A = 1 nm and g = 9.8 m/s² to all digits A ω²/g is 2π², and the
//! motor repeats a cycle that it does not have at 9.81. A statement about such an orbit is therefore judged over many motors, drawn evenly from all that print like
//! the paper's ([`Claim::printed_share`](crate::claim::Claim::printed_share)). This is the only place where they are drawn.

use super::motor_case::MotorCase;
use super::synthetic::Noise;
use super::toss_case::TossCase;
use crate::catalogue::{self, CatalogueError};
use crate::claim::Agreement;
use crate::experiment::ExperimentError;

/// How many are drawn for a verdict.
pub(crate) const DRAWN: usize = 200;

/// An input between what still rounds to the printed number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    low: f64,
    high: f64,
}

impl Range {
    /// All that rounds to the entry `key`, times a power of ten. A printed zero is a choice, θ = 0 for a linear motion, and taken as exact: there is no
    /// last digit to round.
    pub(crate) fn printed(key: &str, power: i32) -> Result<Self, CatalogueError> {
        let number = catalogue::number(key, power)?;
        let half = if number.value == 0.0 { 0.0 } else { number.half_unit };
        Ok(Self { low: number.value - half, high: number.value + half })
    }

    fn at(self, share: f64) -> f64 {
        self.low + share * (self.high - self.low)
    }

    fn holds(self, value: f64) -> bool {
        // A value exactly between two printed ones may round either way.
        let widened = 1e-9 * (self.high - self.low);
        (self.low - widened..=self.high + widened).contains(&value)
    }
}

/// Draws of `N` printed inputs, each evenly from what rounds to it.
pub(crate) fn draws<const N: usize>(
    inputs: [(&str, i32); N],
    count: usize,
    seed: u64,
) -> Result<Vec<[f64; N]>, ExperimentError> {
    let ranges =
        inputs.iter().map(|(key, power)| Range::printed(key, *power)).collect::<Result<Vec<_>, _>>()?;
    let mut noise = Noise::new(seed);
    Ok((0..count).map(|_| std::array::from_fn(|input| ranges[input].at(noise.even()))).collect())
}

/// How many of some values round to the printed number `key`.
pub(crate) fn agreement(
    key: &str,
    values: impl IntoIterator<Item = f64>,
) -> Result<Agreement, ExperimentError> {
    let printed = Range::printed(key, 0)?;
    Ok(Agreement::of(values.into_iter().map(|value| printed.holds(value))))
}

/// Tosses whose inputs all round to those of Table I.
pub(crate) fn tosses(count: usize, seed: u64) -> Result<Vec<TossCase>, ExperimentError> {
    let inputs = [
        ("table1.phase_lag", 0),
        ("table1.amplitude_angle", 0),
        ("table1.stroke", 0),
        ("table1.angular_frequency", 0),
        ("table1.contact_radius", 0),
        ("table1.gyration_radius", 0),
        ("table1.friction", 0),
        ("table1.preload_acceleration", 0),
    ];
    let case = |[lag, angle, stroke, frequency, contact, gyration, friction, preload]: [f64; 8]| TossCase {
        phase_lag_rad: lag,
        amplitude_angle_rad: angle,
        stroke_m: stroke,
        angular_frequency_rad_per_s: frequency,
        contact_radius_m: contact,
        gyration_radius_m: gyration,
        friction,
        preload_acceleration_m_per_s2: preload,
    };
    Ok(draws(inputs, count, seed)?.into_iter().map(case).collect())
}

/// The ranges of all inputs of a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PrintedInputs {
    friction: Range,
    restitution: Range,
    phase_lag_rad: Range,
    amplitude_m: Range,
    peak_angular_speed_rad_per_s: Range,
    contact_radius_m: Range,
    gyration_radius_m: Range,
    preload_acceleration_m_per_s2: Range,
    frequency_hz: Range,
}

impl PrintedInputs {
    /// The motor of Table III. Its g is printed as "70" alone, which is ω/2π; what is meant is gravity, so that every g counts that rounds to the 9.8 of Table I
    /// or lies between it and the 10 m/s² up to which Sec. V B varies g.
    pub(crate) fn table_three() -> Result<Self, ExperimentError> {
        let gravity = Range::printed("table1.preload_acceleration", 0)?;
        let highest = catalogue::number("section5.highest_preload_acceleration", 0)?.value;
        Ok(Self {
            friction: Range::printed("table3.friction", 0)?,
            restitution: Range::printed("table3.restitution", 0)?,
            phase_lag_rad: Range::printed("table3.phase_lag", 0)?,
            amplitude_m: Range::printed("table3.amplitude", 0)?,
            peak_angular_speed_rad_per_s: Range::printed("table3.peak_angular_speed", 0)?,
            contact_radius_m: Range::printed("table3.contact_radius", -3)?,
            gyration_radius_m: Range::printed("table3.gyration_radius", -3)?,
            preload_acceleration_m_per_s2: Range { high: highest, ..gravity },
            frequency_hz: Range::printed("section1.own_motor_frequency", 3)?,
        })
    }

    /// With the amplitude printed as the entry `key`, in metres.
    pub(crate) fn amplitude(self, key: &str) -> Result<Self, ExperimentError> {
        Ok(Self { amplitude_m: Range::printed(key, 0)?, ..self })
    }

    /// With the preload acceleration printed as the entry `key`, in m/s².
    pub(crate) fn preload_acceleration(self, key: &str) -> Result<Self, ExperimentError> {
        Ok(Self { preload_acceleration_m_per_s2: Range::printed(key, 0)?, ..self })
    }

    /// With exactly this restitution.
    pub(crate) fn restitution(self, restitution: f64) -> Self {
        Self { restitution: Range { low: restitution, high: restitution }, ..self }
    }

    /// With μ, ε, A and ωΦ, which can be chosen, exactly as printed: only what is measured is drawn.
    pub(crate) fn exact_settings(self) -> Self {
        let exact = |range: Range| Range { low: range.at(0.5), high: range.at(0.5) };
        Self {
            friction: exact(self.friction),
            restitution: exact(self.restitution),
            amplitude_m: exact(self.amplitude_m),
            peak_angular_speed_rad_per_s: exact(self.peak_angular_speed_rad_per_s),
            ..self
        }
    }

    /// The first `count` motors of the seeded sequence, each input drawn evenly and independently of the others.
    pub(crate) fn drawn(&self, count: usize, seed: u64) -> Vec<MotorCase> {
        let mut noise = Noise::new(seed);
        let mut draw = |range: Range| range.at(noise.even());
        (0..count)
            .map(|_| MotorCase {
                friction: draw(self.friction),
                restitution: draw(self.restitution),
                phase_lag_rad: draw(self.phase_lag_rad),
                amplitude_m: draw(self.amplitude_m),
                peak_angular_speed_rad_per_s: draw(self.peak_angular_speed_rad_per_s),
                contact_radius_m: draw(self.contact_radius_m),
                gyration_radius_m: draw(self.gyration_radius_m),
                preload_acceleration_m_per_s2: draw(self.preload_acceleration_m_per_s2),
                frequency_hz: draw(self.frequency_hz),
            })
            .collect()
    }

    /// The ranges, for notes and parameter lists.
    pub(crate) fn words(&self) -> String {
        let range = |name: &str, range: Range, unit: &str| {
            format!("{name} {:.4} to {:.4}{unit}", range.low, range.high)
        };
        [
            range("ε", self.restitution, ""),
            format!("A {:.1e} to {:.1e} m", self.amplitude_m.low, self.amplitude_m.high),
            range("g", self.preload_acceleration_m_per_s2, " m/s²"),
            range(
                "ω/2π",
                Range { low: 1e-3 * self.frequency_hz.low, high: 1e-3 * self.frequency_hz.high },
                " kHz",
            ),
        ]
        .join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printed::PrintedNumber;

    #[test]
    fn every_drawn_input_prints_like_the_papers() {
        let motors = PrintedInputs::table_three().expect("reads").drawn(DRAWN, 7);
        assert_eq!(motors.len(), DRAWN);
        let prints = |value: f64, printed: &str| {
            let printed = PrintedNumber::read(printed).expect("a number");
            (value - printed.value).abs() <= printed.half_unit * (1.0 + 1e-9)
        };
        for motor in &motors {
            assert!(prints(motor.friction, "0.1") && prints(motor.restitution, "0.5"), "{motor:?}");
            assert!(
                prints(motor.amplitude_m, "10⁻⁸") && prints(motor.peak_angular_speed_rad_per_s, "30"),
                "{motor:?}"
            );
            assert!(
                prints(1e3 * motor.contact_radius_m, "1.25") && prints(1e3 * motor.gyration_radius_m, "6.3"),
                "{motor:?}"
            );
            assert!(prints(1e-3 * motor.frequency_hz, "70"), "{motor:?}");
            assert!((9.75..=10.0).contains(&motor.preload_acceleration_m_per_s2), "{motor:?}");
            assert_eq!(motor.phase_lag_rad.to_bits(), 0.0_f64.to_bits(), "a printed zero is a choice");
        }
        // They fill the ranges, and another seed draws others.
        let extent = |of: fn(&MotorCase) -> f64| {
            let values = motors.iter().map(of);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            })
        };
        let (low, high) = extent(|motor| motor.restitution);
        assert!(low < 0.452 && high > 0.548, "{low} {high}");
        assert_ne!(motors, PrintedInputs::table_three().expect("reads").drawn(DRAWN, 8));
    }

    #[test]
    fn tosses_print_like_table_one() {
        let prints = |value: f64, printed: &str| {
            let printed = PrintedNumber::read(printed).expect("a number");
            (value - printed.value).abs() <= printed.half_unit * (1.0 + 1e-9)
        };
        let drawn = tosses(DRAWN, 4).expect("reads");
        assert_eq!(drawn.len(), DRAWN);
        for toss in &drawn {
            assert!(prints(toss.amplitude_angle_rad, "0.55") && prints(toss.stroke_m, "0.25"), "{toss:?}");
            assert!(
                prints(toss.angular_frequency_rad_per_s, "15") && prints(toss.friction, "0.6"),
                "{toss:?}"
            );
            assert!(
                prints(toss.contact_radius_m, "0.135") && prints(toss.gyration_radius_m, "0.11"),
                "{toss:?}"
            );
            assert!(
                prints(toss.preload_acceleration_m_per_s2, "9.8") && toss.phase_lag_rad == 0.0,
                "{toss:?}"
            );
        }
        let speeds = agreement("section3.largest_airborne_speed", [21.4, 21.6, 22.5, 22.6]).expect("reads");
        assert_eq!(speeds, Agreement { holding: 2, tried: 4 });
    }

    #[test]
    fn one_input_can_be_another_printed_one_or_be_set() {
        let inputs = PrintedInputs::table_three().expect("reads");
        let smaller =
            inputs.amplitude("section5.smallest_amplitude_of_fig10").expect("reads").restitution(0.3);
        for motor in smaller.drawn(20, 1) {
            assert!((0.5e-9..=1.5e-9).contains(&motor.amplitude_m), "{motor:?}");
            assert_eq!(motor.restitution.to_bits(), 0.3_f64.to_bits());
        }
        let light =
            inputs.preload_acceleration("section5.preload_acceleration_of_low_period").expect("reads");
        assert!(
            light.drawn(20, 1).iter().all(|motor| (0.5..=1.5).contains(&motor.preload_acceleration_m_per_s2))
        );
        let exact = inputs.exact_settings().drawn(20, 1);
        for motor in &exact {
            assert!(
                (motor.restitution - 0.5).abs() < 1e-15 && (motor.amplitude_m - 1e-8).abs() < 1e-22,
                "{motor:?}"
            );
            assert!(
                (motor.friction - 0.1).abs() < 1e-16
                    && (motor.peak_angular_speed_rad_per_s - 30.0).abs() < 1e-13
            );
        }
        // What is not a setting is drawn as before.
        assert!(exact.iter().zip(inputs.drawn(20, 1)).all(|(one, other)| {
            one.frequency_hz.to_bits() == other.frequency_hz.to_bits()
                && one.preload_acceleration_m_per_s2.to_bits()
                    == other.preload_acceleration_m_per_s2.to_bits()
        }));
        assert!(inputs.amplitude("section5.no_such_amplitude").is_err());
        assert!(inputs.words().contains("g 9.7500 to 10.0000 m/s²"), "{}", inputs.words());
    }
}
