//! A fit in print: a table of its parameters, and the undetermined directions in words.

use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::numerics::statistics::NORMAL_975;

use crate::display::numbers;
use crate::estimate::motor_fit::estimate::UndeterminedDirection;
use crate::estimate::motor_fit::parameter::{FitParameter, FitRange};
use crate::estimate::motor_fit::{FittedParameter, MotorFit};

/// A unit after a number, or nothing.
pub(crate) fn behind(unit: &str) -> String {
    if unit == "1" { String::new() } else { format!(" {unit}") }
}

impl Display for FitRange {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (n, unit) = (numbers(f), behind(self.parameter.unit()));
        write!(f, "{} in [{}, {}]{unit}", self.parameter, n(self.low), n(self.high))
    }
}

impl Display for UndeterminedDirection {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        let step = |(parameter, change): &(FitParameter, f64)| {
            let unit = if parameter.is_size() { "1" } else { parameter.unit() };
            let name = parameter.name();
            let coordinate = if parameter.is_size() { format!("ln({name})") } else { name.to_owned() };
            format!("{coordinate} by {}{}", n(*change), behind(unit))
        };
        let steps: Vec<String> = self.direction.iter().map(step).collect();
        write!(f, "a change of {}", steps.join(" and "))?;
        if self.standard_error.is_finite() {
            let error = n(self.standard_error);
            write!(f, " hardly affects the measured speeds: its standard error is {error} times this change")
        } else {
            f.write_str(" does not affect the measured speeds at all")
        }
    }
}

impl Display for FittedParameter {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (n, unit) = (numbers(f), behind(self.range.parameter.unit()));
        write!(f, "{}: ", self.range.parameter)?;
        if let Some(value) = self.value {
            write!(f, "{}{unit}, ", n(value))?;
        }
        for (index, accepted) in self.accepted.iter().enumerate() {
            f.write_str(if index == 0 { "" } else { ", or " })?;
            accepted.fmt(f)?;
        }
        write!(f, "; nominally {}{unit}", n(self.nominal))
    }
}

/// Prints several lines, without a newline after the last one.
impl Display for MotorFit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for parameter in &self.parameters {
            parameter.fmt(f)?;
            f.write_str("\n")?;
        }
        let (misfit, degrees) = (numbers(f)(self.misfit), self.degrees_of_freedom);
        write!(f, "sum of weighted squares {misfit} for {degrees} degrees of freedom")?;
        for direction in &self.undetermined {
            f.write_str("\nnot determined: ")?;
            direction.fmt(f)?;
        }
        for switched in self.switched_on.iter().flatten() {
            let half = NORMAL_975 * switched.standard_error;
            let [value, low, high] =
                [switched.value, switched.value - half, switched.value + half].map(|time| numbers(f)(time));
            write!(
                f,
                "\nthe motor was switched on at {value} s of the measured times (95 %: {low} to {high})"
            )?;
        }
        if !self.settled {
            f.write_str("\nmore evaluations, or more impacts in each, would narrow these ranges")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn what_is_not_determined_is_told_in_words() {
        let direction = UndeterminedDirection {
            direction: vec![
                (FitParameter::Friction, -0.052_123),
                (FitParameter::Amplitude, 0.0),
                (FitParameter::PhaseLag, 1.0),
            ],
            standard_error: 2.126,
        };
        assert_eq!(
            format!("{direction:.3}"),
            "a change of ln(friction) by -0.0521 and ln(amplitude) by 0 and phase_lag by 1 rad hardly affects the \
             measured speeds: its standard error is 2.13 times this change"
        );
        let blind = UndeterminedDirection {
            direction: vec![(FitParameter::Restitution, 1.0)],
            standard_error: f64::INFINITY,
        };
        assert_eq!(
            blind.to_string(),
            "a change of restitution by 1 does not affect the measured speeds at all"
        );
    }

    #[test]
    fn a_range_is_printed_with_its_unit() {
        let range = |parameter| FitRange { parameter, low: 0.05, high: 1.0 / 3.0 };
        assert_eq!(range(FitParameter::Friction).to_string(), "friction in [0.05, 0.333333]");
        assert_eq!(
            format!("{:.2}", range(FitParameter::TwistAmplitude)),
            "twist_amplitude in [0.05, 0.33] rad"
        );
    }
}
