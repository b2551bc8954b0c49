//! What people print: parameters and results in one line each, with their units.
//!
//! Numbers come with six significant digits, or with as many as the precision asks for: `{:.3}` prints three.

use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::LyapunovEstimate;

use crate::motion::event::Event;
use crate::motion::phase_time::PhaseTime;
use crate::motion::state::{Mode, SlipDirection};
use crate::motion::transition::{EventKind, ModeKind, Transition};
use crate::estimate::ensemble::Spread;
use crate::estimate::fit::{ExponentialFit, RampFit};
use crate::estimate::interval::IntervalEstimate;
use crate::estimate::statistics::MotorStatistics;
use crate::parameters::disk::Disk;
use crate::parameters::platform::Platform;
use crate::parameters::system::System;
use crate::toss::multiple::OrbitClass;
use crate::toss::single::TossPerformance;

/// Significant digits where no precision is asked for.
const DIGITS: usize = 6;

/// A number as a person writes it.
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

/// A number with three significant digits: a statistic, or a bound.
pub(crate) fn rough(value: f64) -> impl Display {
    Number { value, digits: 3 }
}

/// Numbers with the precision that a formatter asks for.
pub(crate) fn numbers(f: &Formatter<'_>) -> impl Fn(f64) -> Number + use<> {
    let digits = f.precision().unwrap_or(DIGITS);
    move |value| Number { value, digits }
}

impl Display for IntervalEstimate {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(f, "{} (95 %: {} to {})", n(self.value), n(self.low), n(self.high))
    }
}

impl Display for Platform {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(
            f,
            "A = {} m, Phi = {} rad, omega = {} rad/s, theta = {} rad",
            n(self.amplitude()),
            n(self.twist_amplitude()),
            n(self.angular_frequency()),
            n(self.phase_lag())
        )
    }
}

impl Display for Disk {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(
            f,
            "a_e = {} m, a_g = {} m, mu = {}, restitution = {}, g = {} m/s^2",
            n(self.contact_radius()),
            n(self.gyration_radius()),
            n(self.friction()),
            n(self.restitution()),
            n(self.preload_acceleration())
        )?;
        if self.load_acceleration() != 0.0 {
            write!(f, ", load = {} rad/s^2", n(self.load_acceleration()))?;
        }
        Ok(())
    }
}

impl Display for System {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        f.write_str("platform ")?;
        self.platform().fmt(f)?;
        f.write_str("; disk ")?;
        self.disk().fmt(f)?;
        write!(f, "; Gamma = {}", n(self.axial_forcing()))
    }
}

impl Display for TossPerformance {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(
            f,
            "airborne at {} rad/s and {} m/s, separation at {} rad, efficiency {}",
            n(self.airborne_speed),
            n(self.launch_speed),
            n(self.separation_phase),
            n(self.efficiency)
        )?;
        match self.speed_ratio {
            Some(ratio) => write!(f, ", speed ratio {}", n(ratio)),
            None => Ok(()),
        }
    }
}

impl Display for ExponentialFit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(
            f,
            "{} rad/s (1 - exp(-t/{} s)), residual {} rad/s",
            n(self.steady_speed),
            n(self.time_constant),
            n(self.residual)
        )
    }
}

impl Display for RampFit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(
            f,
            "{} rad/s min(t/{} s, 1), residual {} rad/s",
            n(self.steady_speed),
            n(self.rise_time),
            n(self.residual)
        )
    }
}

impl Display for Spread {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(f, "{} +- {} (deviation {})", n(self.mean), n(self.standard_error), n(self.deviation))
    }
}

impl Display for MotorStatistics {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("steady speed (rad/s) ")?;
        self.steady_speed.fmt(f)?;
        f.write_str(", stall acceleration (rad/s^2) ")?;
        match self.stall_acceleration {
            Some(stall) => stall.fmt(f)?,
            None => f.write_str("without a fit")?,
        }
        write!(f, ", undisturbed: {}", self.orbit)
    }
}

impl Display for OrbitClass {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        match self {
            Self::Periodic { period, platform_periods, vertical, .. } => write!(
                f,
                "{period} impacts in {platform_periods} periods, largest multiplier {}",
                n(vertical.spectral_radius())
            ),
            Self::Chattering(cycle) => write!(f, "chattering: {cycle}"),
            Self::Chaotic { lyapunov_exponent: LyapunovEstimate { exponent, standard_error, .. } } => {
                write!(f, "chaos, exponent {} +- {} per impact", n(*exponent), n(*standard_error))
            }
            Self::Undecided { impacts, .. } => write!(f, "undecided within {impacts} impacts"),
            Self::AtRest => f.write_str("at rest"),
        }
    }
}

impl Display for SlipDirection {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
        })
    }
}

impl Display for Mode {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sliding(SlipDirection::Forward) => f.pad("sliding forward"),
            Self::Sliding(SlipDirection::Backward) => f.pad("sliding backward"),
            Self::Flight | Self::Sticking => self.kind().fmt(f),
        }
    }
}

impl Display for ModeKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Flight => "flight",
            Self::Sticking => "sticking",
            Self::Sliding => "sliding",
        })
    }
}

impl Display for EventKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Impact => "impact",
            Self::Attachment => "attachment",
            Self::Separation => "separation",
            Self::StickToSlip => "stick to slip",
            Self::SlipToStick => "slip to stick",
            Self::SlipReversal => "slip reversal",
        })
    }
}

impl Display for Event {
    /// With its numbers in the units of the motion.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = numbers(f);
        write!(f, "{}", self.kind())?;
        match self {
            Self::Impact { axial_impact_velocity, tangential_impact_velocity, capped } => {
                let ends = if *capped { ", slip ends" } else { "" };
                write!(
                    f,
                    " with w_A = {} g/omega, w_T = {} g a_e/(a_g^2 omega)",
                    n(*axial_impact_velocity),
                    n(*tangential_impact_velocity)
                )?;
                f.write_str(ends)
            }
            Self::Attachment { impacts, error_bound } => {
                write!(f, " after {impacts} summed impacts, phase within {} rad", n(*error_bound))
            }
            Self::StickToSlip(direction) | Self::SlipReversal(direction) => write!(f, ", {direction}"),
            Self::Separation | Self::SlipToStick => Ok(()),
        }
    }
}

impl Display for Transition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} -> {} -> {}", self.from, self.event, self.to)
    }
}

impl Display for PhaseTime {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} periods and {} rad", self.periods, numbers(f)(self.phase.angle()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toss::chattering_cycle::ChatteringCycle;
    use crate::toss::single::{InitialSpin, single_toss};

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
