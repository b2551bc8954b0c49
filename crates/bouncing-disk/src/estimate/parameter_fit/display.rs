//! A fit in print: a table of its parameters, and what it leaves undetermined, in words.

use std::fmt::{self, Display, Formatter};

use crate::display::numbers;
use crate::estimate::parameter_fit::ParameterFit;
use crate::estimate::parameter_fit::estimate::{ParameterEstimate, UndeterminedDirection};
use crate::estimate::parameter_fit::parameter::{FitParameter, FitRange};
use crate::estimate::rated_fit::{RatedEstimate, RatedFit};

/// A unit behind a number, or nothing.
pub(crate) fn behind(unit: &str) -> String {
    if unit == "1" { String::new() } else { format!(" {unit}") }
}

impl Display for FitRange {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (n, unit) = (numbers(f), behind(self.parameter.unit()));
        write!(f, "{} in [{}, {}]{unit}", self.parameter, n(self.low), n(self.high))
    }
}

impl ParameterEstimate {
    /// Name, nominal value and estimate, each with its unit.
    fn texts(&self, f: &Formatter<'_>) -> [String; 3] {
        let (n, unit) = (numbers(f), behind(self.parameter.unit()));
        let estimate = self.estimate.map_or_else(
            || "not determined".to_owned(),
            |found| format!("{} [{}, {}]{unit}", n(found.value), n(found.low), n(found.high)),
        );
        [self.parameter.name().to_owned(), format!("{}{unit}", n(self.nominal)), estimate]
    }
}

impl Display for ParameterEstimate {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [name, nominal, estimate] = self.texts(f);
        write!(f, "{name}: {estimate}, nominally {nominal}")
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
            write!(f, " hardly changes what was measured: the standard error is {error} such changes")
        } else {
            f.write_str(" does not change what was measured at all")
        }
    }
}

/// Several lines, without a line end after the last one.
impl Display for ParameterFit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let head = ["parameter", "nominal", "estimate [95 % interval]"].map(str::to_owned);
        let rows: Vec<[String; 3]> =
            std::iter::once(head).chain(self.parameters.iter().map(|fitted| fitted.texts(f))).collect();
        let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
        let (first, second) = (width(0), width(1));
        for [name, nominal, estimate] in &rows {
            writeln!(f, "{name:first$}  {nominal:second$}  {estimate}")?;
        }
        let (misfit, degrees) = (numbers(f)(self.misfit), self.degrees_of_freedom);
        write!(f, "sum of weighted squares {misfit} for {degrees} degrees of freedom")?;
        for (index, times) in self.contact_times.iter().enumerate() {
            f.write_str(if index == 0 { "\ncontact time: " } else { ", or " })?;
            times.fmt(f)?;
        }
        for direction in &self.undetermined {
            f.write_str("\nnot determined: ")?;
            direction.fmt(f)?;
        }
        Ok(())
    }
}

impl Display for RatedEstimate {
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

/// Several lines, without a line end after the last one.
impl Display for RatedFit {
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
        if !self.settled {
            f.write_str("\nmore evaluations, or more impacts of each, would narrow these ranges")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::interval::IntervalEstimate;
    use crate::motor::data_sheet::Motor;

    fn found(parameter: FitParameter, nominal: f64, interval: [f64; 3]) -> ParameterEstimate {
        let [low, value, high] = interval;
        ParameterEstimate { parameter, nominal, estimate: Some(IntervalEstimate { value, low, high }) }
    }

    #[test]
    fn a_fit_is_printed_as_a_table_and_what_it_leaves_open_in_words() {
        let direction = UndeterminedDirection {
            direction: vec![
                (FitParameter::Friction, -0.052_123),
                (FitParameter::Amplitude, 0.0),
                (FitParameter::PhaseLag, 1.0),
            ],
            standard_error: 2.126,
        };
        let fit = ParameterFit {
            parameters: vec![
                found(FitParameter::Friction, 0.1, [0.19, 0.203_456, 0.22]),
                found(FitParameter::Amplitude, 1.0e-8, [0.9e-8, 1.1e-8, 1.25e-8]),
                ParameterEstimate { parameter: FitParameter::PhaseLag, nominal: 0.5, estimate: None },
            ],
            undetermined: vec![direction.clone()],
            contact_times: Vec::new(),
            motor: Motor::paper_70_khz(),
            misfit: 17.26,
            degrees_of_freedom: 16,
            evaluations: 9,
        };
        assert_eq!(
            format!("{fit:.3}"),
            "parameter  nominal  estimate [95 % interval]\n\
             friction   0.1      0.203 [0.19, 0.22]\n\
             amplitude  1e-8 m   1.1e-8 [9e-9, 1.25e-8] m\n\
             phase_lag  0.5 rad  not determined\n\
             sum of weighted squares 17.3 for 16 degrees of freedom\n\
             not determined: a change of ln(friction) by -0.0521 and ln(amplitude) by 0 and phase_lag by 1 rad \
             hardly changes what was measured: the standard error is 2.13 such changes"
        );
        assert_eq!(fit.parameters[1].to_string(), "amplitude: 1.1e-8 [9e-9, 1.25e-8] m, nominally 1e-8 m");
        assert_eq!(fit.parameters[2].to_string(), "phase_lag: not determined, nominally 0.5 rad");
        let blind = UndeterminedDirection {
            direction: vec![(FitParameter::Restitution, 1.0)],
            standard_error: f64::INFINITY,
        };
        assert_eq!(
            blind.to_string(),
            "a change of restitution by 1 does not change what was measured at all"
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
