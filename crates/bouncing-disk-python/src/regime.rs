//! The regime of a motor by its name.

use bouncing_disk::MotorRegime;

/// The regime by its name, with its numbers: impacts, platform periods, rests, exponent.
pub(crate) fn regime(regime: &MotorRegime) -> (&'static str, u64, f64, u64, f64) {
    match regime {
        MotorRegime::NoLiftOff => ("no-lift-off", 0, f64::NAN, 0, f64::NAN),
        MotorRegime::Periodic { impacts, platform_periods } => {
            ("periodic", *impacts as u64, *platform_periods as f64, 0, f64::NAN)
        }
        MotorRegime::LowPeriodChattering(cycle) => {
            ("low-period-chattering", cycle.impacts as u64, cycle.platform_periods as f64, 0, f64::NAN)
        }
        MotorRegime::LongChattering { platform_periods, rests } => {
            ("long-chattering", 0, *platform_periods, *rests, f64::NAN)
        }
        MotorRegime::Chaotic { lyapunov_exponent } => ("chaotic", 0, f64::NAN, 0, *lyapunov_exponent),
        MotorRegime::Undecided { impacts } => ("undecided", *impacts as u64, f64::NAN, 0, f64::NAN),
        _ => ("unknown", 0, f64::NAN, 0, f64::NAN),
    }
}
