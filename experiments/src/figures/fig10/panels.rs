//! The transients that are drawn: a member of an ensemble with its fit, the ensemble's band, and the exceptional motor at exactly the
//! printed g.

use std::f64::consts::PI;

use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::{ChatterPolicy, Unobserved};
use bouncing_disk::estimate::{ExponentialFit, RampFit, Spread, TransientEnsemble};
use bouncing_disk::motor::TransientSettings;
use serde::Serialize;

use crate::experiment::ExperimentError;
use crate::figures::shared::alike::oscillation;
use crate::figures::shared::motor::{Cycle, MotorCase, RobustCycle};

/// Curve points of the member that is drawn, and of the ensemble's band.
pub(super) const MEMBER_INTERVALS: usize = 600;
const BAND_POINTS: usize = 60;

/// One reading of Table III: with standard gravity, or as printed.
#[derive(Serialize)]
pub(super) struct Reading {
    pub(super) preload_acceleration_m_per_s2: f64,
    pub(super) duration_s: f64,
    pub(super) panels: Vec<Transient>,
}

/// One amplitude: a member with its fit, and the ensemble.
#[derive(Serialize)]
pub(super) struct Transient {
    pub(super) amplitude_m: f64,
    pub(super) axial_forcing: f64,
    pub(super) member_time_s: Vec<f64>,
    pub(super) member_speed_rad_per_s: Vec<f64>,
    pub(super) member_fit: ExponentialFit,
    pub(super) band_time_s: Vec<f64>,
    pub(super) band_low_rad_per_s: Vec<f64>,
    pub(super) band_high_rad_per_s: Vec<f64>,
    pub(super) steady_speed_rad_per_s: Spread,
    pub(super) time_constant_s: Spread,
    /// Root mean square of member minus exponential fit, over the steady speed; mean over the ensemble.
    pub(super) relative_exponential_residual: f64,
    /// The same for the fit of a linear rise to a constant speed.
    pub(super) relative_ramp_residual: f64,
    /// Standard deviation of the speed from its straight line in the second half, as a share of ωΦ; mean over
    /// the ensemble.
    pub(super) oscillation: f64,
    /// The motion that the unperturbed motor repeats.
    pub(super) cycle: Cycle,
    pub(super) impacts_per_s: f64,
}

/// The robust low-period cycle at A = 1 nm and exactly g = 9.8 m/s², and how narrow it is.
#[derive(Serialize)]
pub(super) struct Exception {
    pub(super) amplitude_m: f64,
    pub(super) preload_acceleration_m_per_s2: f64,
    /// Aω²/g over 2π².
    pub(super) peak_acceleration_over_two_pi_squared: f64,
    pub(super) robust_cycle: RobustCycle,
    /// The preload accelerations, next to the printed one, between which the motor repeats this cycle.
    pub(super) lowest_preload_acceleration_m_per_s2: f64,
    pub(super) highest_preload_acceleration_m_per_s2: f64,
    /// The width of this range, over the printed g.
    pub(super) relative_width: f64,
    /// The transient there.
    pub(super) time_s: Vec<f64>,
    pub(super) speed_rad_per_s: Vec<f64>,
}

/// The settings of transients that are drawn for so long (s).
fn settings(duration: f64) -> TransientSettings {
    TransientSettings { duration, intervals: MEMBER_INTERVALS, ..TransientSettings::default() }
}

/// The cycle of this motor, the range of g in which it exists, and what the motor does elsewhere.
pub(super) fn exception(motor: &MotorCase, duration: f64) -> Result<Exception, ExperimentError> {
    let printed = motor.preload_acceleration_m_per_s2;
    let at = |preload: f64| MotorCase { preload_acceleration_m_per_s2: preload, ..*motor };
    let no_cycle = || ExperimentError::NoData { quantity: "cycle at 9.8 m/s²".to_owned() };
    let robust_cycle = motor.robust_cycle()?.ok_or_else(no_cycle)?;
    let cycle = robust_cycle.cycle();
    let repeats =
        |preload: f64| Ok::<_, ExperimentError>(at(preload).cycle(ChatterPolicy::Complete)? == cycle);
    // Doubled until the cycle is another one, then bisected; the end inside, so that the cycle is surely
    // there.
    let end = |sign: f64| -> Result<f64, ExperimentError> {
        let mut step = printed * f64::EPSILON;
        while repeats(printed + sign * step)? && step < 0.5 * printed {
            step *= 2.0;
        }
        let (inside, outside) = (printed + sign * 0.5 * step, printed + sign * step);
        // Three units in the last place, within which rounding decides which cycle it is.
        let width = 3.0 * (printed.next_up() - printed);
        if sign < 0.0 {
            bracket_of_width(outside, inside, width, |preload| Ok(!repeats(preload)?)).map(|ends| ends.1)
        } else {
            bracket_of_width(inside, outside, width, repeats).map(|ends| ends.0)
        }
    };
    let runs = TransientEnsemble::new(&motor.system()?, &settings(duration), 1, &Unobserved)?;
    let curve = &runs.curves[0];
    let (lowest, highest) = (end(-1.0)?, end(1.0)?);
    Ok(Exception {
        amplitude_m: motor.amplitude_m,
        preload_acceleration_m_per_s2: printed,
        peak_acceleration_over_two_pi_squared: motor.system()?.peak_acceleration() / (2.0 * PI * PI),
        robust_cycle,
        lowest_preload_acceleration_m_per_s2: lowest,
        highest_preload_acceleration_m_per_s2: highest,
        relative_width: (highest - lowest) / printed,
        time_s: curve.times.clone(),
        speed_rad_per_s: curve.speeds.clone(),
    })
}

/// The transient of this motor with so many members.
pub(super) fn transient(
    motor: &MotorCase,
    duration: f64,
    members: usize,
) -> Result<Transient, ExperimentError> {
    let system = motor.system()?;
    let runs = TransientEnsemble::new(&system, &settings(duration), members, &Unobserved)?;
    let member = &runs.curves[0];
    let per_point = member.times.len() / BAND_POINTS;
    let (mut time, mut low, mut high) = (Vec::new(), Vec::new(), Vec::new());
    for point in 0..BAND_POINTS {
        let range = point * per_point..(point + 1) * per_point;
        let means: Vec<f64> = runs
            .curves
            .iter()
            .map(|curve| curve.speeds[range.clone()].iter().sum::<f64>() / per_point as f64)
            .collect();
        let spread = Spread::of(&means)?;
        time.push(0.5 * (member.times[range.start] + member.times[range.end - 1]));
        low.push(spread.mean - spread.deviation);
        high.push(spread.mean + spread.deviation);
    }
    let mean = |of_members: Vec<f64>| of_members.iter().sum::<f64>() / of_members.len() as f64;
    let exponential = runs.fits.iter().map(|fit| fit.residual / fit.steady_speed).collect();
    let ramps = runs.curves.iter().map(|curve| {
        let ramp = RampFit::new(&curve.times, &curve.speeds)?;
        Ok(ramp.residual / ramp.steady_speed)
    });
    let ramps = ramps.collect::<Result<Vec<f64>, ExperimentError>>()?;
    let oscillations = runs.curves.iter().map(|curve| oscillation(curve, motor.peak_angular_speed_rad_per_s));
    Ok(Transient {
        amplitude_m: motor.amplitude_m,
        axial_forcing: system.axial_forcing(),
        member_time_s: member.times.clone(),
        member_speed_rad_per_s: member.speeds.clone(),
        member_fit: runs.fits[0],
        band_time_s: time,
        band_low_rad_per_s: low,
        band_high_rad_per_s: high,
        steady_speed_rad_per_s: runs.steady_speed,
        time_constant_s: runs.time_constant,
        relative_exponential_residual: mean(exponential),
        relative_ramp_residual: mean(ramps),
        oscillation: mean(oscillations.collect::<Result<_, _>>()?),
        cycle: motor.cycle(ChatterPolicy::Complete)?,
        impacts_per_s: member.impacts as f64 / (member.times[0] + member.times[member.times.len() - 1]),
    })
}
