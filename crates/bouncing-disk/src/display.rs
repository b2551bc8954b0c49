//! Readable numbers: six significant digits by default, or as many as the precision requests (`{:.3}` prints
//! three).

use std::fmt::{self, Display, Formatter};

/// Significant digits if no precision is requested.
const DIGITS: usize = 6;

/// A number in readable form.
pub(crate) struct Number {
    value: f64,
    digits: usize,
}

impl Display for Number {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let rounded = format!("{:.*e}", self.digits.saturating_sub(1), self.value);
        match rounded.parse::<f64>() {
            Ok(value) if value.abs() > 0.0 && !(1e-4..1e7).contains(&value.abs()) => write!(f, "{value:e}"),
            Ok(value) => write!(f, "{value}"),
            Err(_) => f.write_str(&rounded),
        }
    }
}

/// A number with six significant digits.
pub(crate) fn number(value: f64) -> impl Display {
    Number { value, digits: DIGITS }
}

/// A number with three significant digits, for statistics and bounds.
pub(crate) fn rough(value: f64) -> impl Display {
    Number { value, digits: 3 }
}

/// Numbers with the precision that the formatter requests.
pub(crate) fn numbers(f: &Formatter<'_>) -> impl Fn(f64) -> Number + use<> {
    let digits = f.precision().unwrap_or(DIGITS);
    move |value| Number { value, digits }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::{ExponentialFit, IntervalEstimate, RampFit, Spread};
    use crate::motion::{EventKind, Mode, SlipDirection, Transition};
    use crate::toss::OrbitClass;
    use crate::toss::chattering_cycle::ChatteringCycle;
    use crate::toss::single::{InitialSpin, single_toss};
    use crate::{Event, System};

    #[test]
    fn systems_are_printed_with_their_units() {
        let motor = System::motor();
        assert_eq!(
            motor.to_string(),
            "platform A = 1e-8 m, Phi = 6.82093e-5 rad, omega = 439823 rad/s, theta = 0 rad; \
             disk a_e = 0.00125 m, a_g = 0.0063 m, mu = 0.1, restitution = 0.5, g = 9.8 m/s^2; Gamma = 62.8319"
        );
        let loaded = motor.with_disk(|rotor| rotor.load_acceleration = 12.0).expect("legal");
        assert!(format!("{:.2}", loaded.disk()).ends_with("g = 9.8 m/s^2, load = 12 rad/s^2"));
    }

    #[test]
    fn results_are_printed_with_their_units() {
        let toss = single_toss(&System::pizza_toss(), InitialSpin::AbsoluteRest).expect("leaves");
        let text = format!("{toss:.2}");
        assert!(text.starts_with("airborne at 14 rad/s and 3.1 m/s, separation at 0.21 rad"), "{text}");
        let fit = ExponentialFit { steady_speed: 16.4, time_constant: 0.5, residual: 0.125 };
        assert_eq!(fit.to_string(), "16.4 rad/s (1 - exp(-t/0.5 s)), residual 0.125 rad/s");
        let ramp = RampFit { steady_speed: 16.4, rise_time: 0.5, residual: 0.125 };
        assert_eq!(ramp.to_string(), "16.4 rad/s min(t/0.5 s, 1), residual 0.125 rad/s");
        let spread = Spread { mean: 2.0 / 3.0, deviation: 0.2, standard_error: 0.1 };
        assert_eq!(format!("{spread:.3}"), "0.667 +- 0.1 (deviation 0.2)");
        let cycle = ChatteringCycle { impacts: 9, platform_periods: 11, long_flights: 2 };
        let class = OrbitClass::Chattering(cycle);
        assert_eq!(class.to_string(), "chattering: 2 long flights, 9 impacts, 11 periods");
    }

    #[test]
    fn events_and_modes_are_printed_in_words() {
        assert_eq!(Mode::Sliding(SlipDirection::Forward).to_string(), "sliding forward");
        assert_eq!(
            format!("{:>8}|{:<14}|", Mode::Flight, EventKind::SlipReversal),
            "  flight|slip reversal |"
        );
        let impact =
            Event::Impact { axial_impact_velocity: -1.25, tangential_impact_velocity: 0.1, capped: true };
        assert_eq!(
            impact.to_string(),
            "impact with w_A = -1.25 g/omega, w_T = 0.1 g a_e/(a_g^2 omega), slip ends"
        );
        assert_eq!(Transition::LEGAL[0].to_string(), "flight -> impact -> flight");
        for value in [f64::NAN, f64::INFINITY, 0.0, -1e300] {
            assert!(!Number { value, digits: 3 }.to_string().is_empty());
        }
    }

    #[test]
    fn an_estimate_shows_its_interval() {
        let estimate = IntervalEstimate { value: 12.3456, low: 11.0, high: 1.3e8 };
        assert_eq!(format!("{estimate:.3}"), "12.3 (95 %: 11 to 1.3e8)");
    }
}
