//! Inputs that print like the paper's.
//!
//! A measurement of the authors is known to its last printed digit, and a number computed from it is judged
//! over draws of all values that round to it. A value that they set in a simulation is exact. For the motor
//! no preload acceleration is printed, and its orbit depends on it: at A = 1 nm and g = 9.8 m/s² to all
//! digits A ω²/g is 2π², and the motor repeats a cycle that it does not have at 9.81. A statement about such
//! an orbit is judged over many of them (`docs/judging.md`). This is the only place where they are drawn.

use super::motor_case::MotorCase;
use super::numbers::Noise;
use crate::claims::Cases;
use crate::claims::catalogue::{self, CatalogueError};
use crate::claims::paper;
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
    /// All that rounds to the entry `key`, times a power of ten. A printed zero is a choice, θ = 0 for a
    /// linear motion, and taken as exact: there is no last digit to round.
    pub(crate) fn printed(key: &str, power: i32) -> Result<Self, CatalogueError> {
        let number = catalogue::number(key, power)?;
        let half = if number.value == 0.0 { 0.0 } else { number.half_unit };
        Ok(Self { low: number.value - half, high: number.value + half })
    }

    const fn exactly(value: f64) -> Self {
        Self { low: value, high: value }
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
pub(crate) fn agreement(key: &str, values: impl IntoIterator<Item = f64>) -> Result<Cases, ExperimentError> {
    let printed = Range::printed(key, 0)?;
    Ok(Cases::of(values.into_iter().map(|value| printed.holds(value))))
}

/// A motor as its simulation was printed. Values that the paper set are exact; values that it does not print
/// are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PrintedInputs {
    motor: MotorCase,
    amplitude_m: Range,
    preload_acceleration_m_per_s2: Range,
}

impl PrintedInputs {
    /// The motor of Table III. Its g is printed as "70" alone, which is ω/2π; gravity is meant, so every g
    /// counts that rounds to the 9.8 of Table I or lies between it and the 10 m/s² up to which Sec. V B
    /// varies g.
    pub(crate) fn table_three() -> Result<Self, ExperimentError> {
        let motor = MotorCase::default_of(&paper::table_three()?, &paper::section_five()?);
        let gravity = Range::printed("table1.preload_acceleration", 0)?;
        let high = catalogue::number("section5.highest_preload_acceleration", 0)?.value;
        Ok(Self {
            motor,
            amplitude_m: Range::exactly(motor.amplitude_m),
            preload_acceleration_m_per_s2: Range { high, ..gravity },
        })
    }

    /// With the amplitude printed as the entry `key`, in metres.
    pub(crate) fn amplitude(self, key: &str) -> Result<Self, ExperimentError> {
        Ok(Self { amplitude_m: Range::exactly(catalogue::number(key, 0)?.value), ..self })
    }

    /// With any amplitude that rounds to the entry `key`: motors like the printed one, where the statement is
    /// not about that one alone.
    pub(crate) fn rounded_amplitude(self, key: &str) -> Result<Self, ExperimentError> {
        Ok(Self { amplitude_m: Range::printed(key, 0)?, ..self })
    }

    /// With the preload acceleration printed as the entry `key`, in m/s². Only the last places of the
    /// amplitude remain to be drawn; they decide on a long cycle, so all amplitudes that agree to twelve
    /// digits count.
    pub(crate) fn preload_acceleration(self, key: &str) -> Result<Self, ExperimentError> {
        let amplitude = self.amplitude_m.low;
        Ok(Self {
            amplitude_m: Range {
                low: amplitude * (1.0 - LAST_PLACES),
                high: amplitude * (1.0 + LAST_PLACES),
            },
            preload_acceleration_m_per_s2: Range::exactly(catalogue::number(key, 0)?.value),
            ..self
        })
    }

    /// With exactly this restitution.
    pub(crate) fn restitution(self, restitution: f64) -> Self {
        Self { motor: MotorCase { restitution, ..self.motor }, ..self }
    }

    /// The first `count` motors of the seeded sequence, what is drawn evenly and independently of the other.
    pub(crate) fn drawn(&self, count: usize, seed: u64) -> Vec<MotorCase> {
        let mut noise = Noise::new(seed);
        let mut draw = |range: Range| range.at(noise.even());
        (0..count)
            .map(|_| MotorCase {
                amplitude_m: draw(self.amplitude_m),
                preload_acceleration_m_per_s2: draw(self.preload_acceleration_m_per_s2),
                ..self.motor
            })
            .collect()
    }

    /// The drawn inputs, for notes and parameter lists.
    pub(crate) fn words(&self) -> String {
        let Range { low, high } = self.preload_acceleration_m_per_s2;
        if low < high {
            format!("g {low:.2} to {high:.2} m/s², all else as printed")
        } else {
            format!("the amplitude changed by less than {LAST_PLACES:e} of it, all else as printed")
        }
    }
}

/// A part of the amplitude that no printed digit, and no measurement, knows.
const LAST_PLACES: f64 = 1e-12;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_printed_is_exact_and_what_is_not_is_drawn() {
        let inputs = PrintedInputs::table_three().expect("reads");
        let motors = inputs.drawn(DRAWN, 7);
        let exact =
            [motors[0].amplitude_m, motors[0].restitution, motors[0].friction, motors[0].frequency_hz];
        assert_eq!(exact.map(f64::to_bits), [1e-8, 0.5, 0.1, 7e4].map(f64::to_bits));
        let preloads = || motors.iter().map(|motor| motor.preload_acceleration_m_per_s2);
        assert!(preloads().all(|preload| (9.75..=10.0).contains(&preload)));
        assert!(preloads().any(|preload| preload < 9.76) && preloads().any(|preload| preload > 9.99));
        assert_ne!(motors, inputs.drawn(DRAWN, 8));
        let [low, high] = ["section5.amplitude_of_low_period", "section5.preload_acceleration_of_low_period"];
        let printed =
            inputs.amplitude(low).and_then(|inputs| inputs.preload_acceleration(high)).expect("reads");
        let motors = printed.restitution(0.3).drawn(20, 1);
        for motor in &motors {
            assert_eq!(
                [motor.preload_acceleration_m_per_s2, motor.restitution].map(f64::to_bits),
                [1.0, 0.3].map(f64::to_bits)
            );
        }
        assert!(motors.iter().all(|motor| (motor.amplitude_m / 1e-8 - 1.0).abs() <= 1.001 * LAST_PLACES));
        assert!(motors.windows(2).all(|pair| pair[0].amplitude_m.to_bits() != pair[1].amplitude_m.to_bits()));
    }

    #[test]
    fn values_that_print_alike_are_counted() {
        let speeds = agreement("section3.largest_airborne_speed", [21.4, 21.6, 22.5, 22.6]).expect("reads");
        assert_eq!(speeds, Cases { holding: 2, tried: 4 });
    }
}
