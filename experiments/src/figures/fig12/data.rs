//! The numbers of Fig. 12.

use bouncing_disk::estimate::ExponentialFit;
use serde::Serialize;

use crate::claims::paper::ChatteringCases;
use crate::figures::shared::alike::AlikeMotor;
use crate::figures::shared::motor::{MotorCase, RobustCycle};

/// The data of Fig. 12.
#[derive(Debug, Serialize)]
pub(crate) struct Fig12Data {
    pub(super) cases: ChatteringCases,
    /// The printed long-period case.
    pub(super) long_period: Shown,
    /// The low-period case, at the amplitude nearest to the printed one that repeats a robust low-period
    /// cycle of more than one flight.
    pub(super) low_period: Shown,
    /// Most flights of a cycle that counts as one of low period.
    pub(super) low_period_flights: usize,
    /// Motors of both cases whose amplitudes agree to twelve digits.
    pub(super) alike: [Alike; 2],
    /// The lines of the low-period case.
    pub(super) drawn_lines: Lines,
    /// Motors of low period among those that print like the low-period case.
    pub(super) alike_of_low_period: LowPeriod,
}

/// Motors whose inputs all print like the paper's.
#[derive(Debug, Serialize)]
pub(super) struct Alike {
    /// The ranges drawn from.
    pub(super) inputs: String,
    pub(super) motors: Vec<AlikeMotor>,
}

/// The first motors of low period of a longer sequence of those that print alike.
#[derive(Debug, Serialize)]
pub(super) struct LowPeriod {
    /// Motors drawn to find them.
    pub(super) drawn: usize,
    pub(super) motors: Vec<AlikeMotor>,
    /// For each the lines that its speed forms.
    pub(super) lines: Vec<Lines>,
}

/// The lines on which the speeds of the flights of a low-period cycle lie while the rotor is slow: one for
/// each flight of the cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Lines {
    pub(super) flights: usize,
    /// Largest distance of neighbouring lines, over what the speed gains in a cycle.
    pub(super) gap_over_gain: f64,
    /// The same over ωΦ.
    pub(super) gap_over_peak_angular_speed: f64,
}

/// A motor whose transient is drawn. Nothing perturbs it.
#[derive(Debug, Serialize)]
pub(super) struct Shown {
    pub(super) motor: MotorCase,
    /// Amplitude over the printed one minus 1.
    pub(super) amplitude_offset: f64,
    pub(super) axial_forcing: f64,
    /// Its cycle, if rounding does not choose it.
    pub(super) robust_cycle: Option<RobustCycle>,
    pub(super) duration_s: f64,
    /// Each flight longer than half a period: its start and the speed during it.
    pub(super) flight_time_s: Vec<f64>,
    pub(super) flight_speed_rad_per_s: Vec<f64>,
    /// The same motor averaged over equal intervals, and its fits.
    pub(super) fits: Fits,
    /// The prediction from the impulses of one cycle.
    pub(super) prediction: Prediction,
    pub(super) zoom: Zoom,
}

/// The two forms fitted to the same curve.
#[derive(Debug, Serialize)]
pub(super) struct Fits {
    pub(super) exponential: ExponentialFit,
    pub(super) ramp_residual_rad_per_s: f64,
    /// Mean over the last fifth.
    pub(super) last_speed_rad_per_s: f64,
    /// Straight line through the whole of the rise, and its largest distance from the curve.
    pub(super) slope_rad_per_s2: f64,
    pub(super) farthest_from_line_rad_per_s: f64,
    /// Straight line through the first tenth of the rise.
    pub(super) first_slope_rad_per_s2: f64,
    /// First time at which the speed is within 2 % of the last one.
    pub(super) reached_s: Option<f64>,
}

/// Straight pieces from the impulses of one cycle (module `impulse`).
#[derive(Debug, Serialize)]
pub(super) struct Prediction {
    /// μ a_e g/a_g² S(0), S(0) the net share of the normal impulse that pushes a slow rotor forwards.
    pub(super) slope_rad_per_s2: f64,
    pub(super) steady_speed_rad_per_s: f64,
    /// When the pieces reach it.
    pub(super) reached_s: f64,
    pub(super) time_s: Vec<f64>,
    pub(super) speed_rad_per_s: Vec<f64>,
}

/// A short part of the rise. Of the low-period case the flights of many cycles, which form its lines.
#[derive(Debug, Serialize)]
pub(super) struct Zoom {
    pub(super) time_s: Vec<f64>,
    pub(super) speed_rad_per_s: Vec<f64>,
    pub(super) height_m: Vec<f64>,
    /// Flights of many cycles: their starts and speeds.
    pub(super) flight_time_s: Vec<f64>,
    pub(super) flight_speed_rad_per_s: Vec<f64>,
}
