//! The tosses of panels (a) to (e).

use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::core::numerics::elementary::{acos, asin, sin};
use bouncing_disk::toss::{InitialSpin, TossPerformance};
use serde::Serialize;

use crate::experiment::ExperimentError;
use crate::figures::shared::toss::{TossCase, maximum};

/// The paper's phase lags are n π/8 with n up to this.
const LAGS: u32 = 8;
/// Both initial states, the default one first.
pub(super) const INITIAL_STATES: [InitialSpin; 2] =
    [InitialSpin::AbsoluteRest, InitialSpin::RestRelativeToHand];
/// Samples among which a maximum is bracketed; the curves have fewer bends.
pub(super) const BRACKETS: u32 = 60;

fn phase_lag(n: u32) -> f64 {
    PI * f64::from(n) / f64::from(LAGS)
}

/// The first index of the largest value.
pub(super) fn maximum_index(values: impl Iterator<Item = f64>) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for (index, value) in values.enumerate() {
        if value > best.1 {
            best = (index, value);
        }
    }
    best.0
}

/// `count` amplitude angles from 0 to the largest one. They crowd where the curves end steeply: the phase of
/// separation has a square root there.
pub(super) fn angles(case: &TossCase, count: u32) -> Vec<f64> {
    let left = |index: u32| 1.0 - f64::from(index) / f64::from(count - 1);
    (0..count).map(|index| case.last_angle() * (1.0 - left(index) * left(index))).collect()
}

/// The airborne speeds of tosses from rest.
pub(super) fn speeds(case: &TossCase, angles: &[f64]) -> Result<Vec<f64>, ExperimentError> {
    angles.iter().map(|angle| case.at_angle(*angle).airborne_speed()).collect()
}

/// The performance measures of one toss.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct TossPoint {
    pub(super) amplitude_angle_rad: f64,
    pub(super) airborne_speed_rad_per_s: f64,
    pub(super) efficiency: f64,
    /// Absent without twist.
    pub(super) speed_ratio: Option<f64>,
}

impl TossPoint {
    pub(super) fn of(case: &TossCase, initial: InitialSpin) -> Result<Self, ExperimentError> {
        let toss = case.toss(initial)?;
        Ok(Self {
            amplitude_angle_rad: case.amplitude_angle_rad,
            airborne_speed_rad_per_s: toss.airborne_speed,
            efficiency: toss.efficiency,
            speed_ratio: toss.speed_ratio,
        })
    }

    /// The point of a curve of the speed.
    pub(super) fn speed(&self) -> (f64, f64) {
        (self.amplitude_angle_rad, self.airborne_speed_rad_per_s)
    }

    /// |ν|.
    pub(super) fn ratio(&self) -> f64 {
        self.speed_ratio.map_or(f64::NAN, f64::abs)
    }
}

/// |airborne speed|.
pub(super) fn speed(toss: &TossPerformance) -> f64 {
    toss.airborne_speed.abs()
}

/// The energy efficiency.
pub(super) fn efficiency(toss: &TossPerformance) -> f64 {
    toss.efficiency
}

/// |speed ratio|.
pub(super) fn ratio(toss: &TossPerformance) -> f64 {
    toss.speed_ratio.map_or(0.0, f64::abs)
}

/// The toss with the largest `measure` of all amplitude angles.
pub(super) fn best_angle(
    case: &TossCase,
    initial: InitialSpin,
    measure: fn(&TossPerformance) -> f64,
) -> Result<TossPoint, ExperimentError> {
    // Without twist there is no ratio, so the search starts just above.
    let range = (1e-6 * case.last_angle(), case.last_angle());
    let at = |angle: f64| case.at_angle(angle).toss(initial).map(|toss| measure(&toss));
    TossPoint::of(&case.at_angle(maximum(range, BRACKETS, at)?.place), initial)
}

/// The curves of one initial state.
#[derive(Debug, Serialize)]
pub(super) struct Family {
    initial_state: InitialSpin,
    pub(super) curves: Vec<LagCurve>,
}

/// The performance against the amplitude angle at one phase lag, θ = n π/8.
#[derive(Debug, Serialize)]
pub(super) struct LagCurve {
    pub(super) n: u32,
    pub(super) phase_lag_rad: f64,
    pub(super) airborne_speed_rad_per_s: Vec<f64>,
    pub(super) efficiency: Vec<f64>,
    pub(super) speed_ratio: Vec<Option<f64>>,
    /// Where the absolute value of the airborne speed is largest.
    pub(super) fastest: TossPoint,
    pub(super) most_efficient: TossPoint,
    /// Where the absolute value of the speed ratio is largest.
    pub(super) largest_speed_ratio: TossPoint,
}

impl Family {
    pub(super) fn new(
        table: &TossCase,
        initial_state: InitialSpin,
        angles: &[f64],
    ) -> Result<Self, ExperimentError> {
        let curve = |n: u32| {
            let case = table.at_lag(phase_lag(n));
            let tosses = angles.iter().map(|angle| case.at_angle(*angle).toss(initial_state));
            let tosses = tosses.collect::<Result<Vec<_>, _>>()?;
            Ok(LagCurve {
                n,
                phase_lag_rad: case.phase_lag_rad,
                airborne_speed_rad_per_s: tosses.iter().map(|toss| toss.airborne_speed).collect(),
                efficiency: tosses.iter().map(efficiency).collect(),
                speed_ratio: tosses.iter().map(|toss| toss.speed_ratio).collect(),
                fastest: best_angle(&case, initial_state, speed)?,
                most_efficient: best_angle(&case, initial_state, efficiency)?,
                largest_speed_ratio: best_angle(&case, initial_state, ratio)?,
            })
        };
        Ok(Self { initial_state, curves: (0..=LAGS).map(curve).collect::<Result<_, ExperimentError>>()? })
    }
}

/// The airborne speed against the phase of separation.
#[derive(Debug, Serialize)]
pub(super) struct Separation {
    /// The first and last phase that occur, from the first and the last amplitude angle.
    pub(super) lowest_rad: f64,
    pub(super) highest_rad: f64,
    pub(super) separation_phase_rad: Vec<f64>,
    pub(super) curves: Vec<SeparationCurve>,
}

/// A curve of panel (d).
#[derive(Debug, Serialize)]
pub(super) struct SeparationCurve {
    pub(super) n: u32,
    phase_lag_rad: f64,
    pub(super) airborne_speed_rad_per_s: Vec<f64>,
}

impl Separation {
    pub(super) fn new(table: &TossCase, count: u32) -> Result<Self, ExperimentError> {
        let acceleration = table.stroke_acceleration();
        let lowest = asin(1.0 / acceleration);
        // The amplitude angle at which the dough leaves at a phase, from sin(phase) = g/(c ω² cos φ_L).
        let angle = |phase: f64| acos((1.0 / (acceleration * sin(phase))).min(1.0)).min(table.last_angle());
        let angles: Vec<_> = (0..count)
            .map(|index| lowest + (FRAC_PI_2 - lowest) * f64::from(index) / f64::from(count - 1))
            .map(angle)
            .collect();
        let initial = InitialSpin::AbsoluteRest;
        let left_at = |angle: &f64| Ok(table.at_angle(*angle).toss(initial)?.separation_phase);
        let left_at = angles.iter().map(left_at).collect::<Result<Vec<_>, ExperimentError>>()?;
        let curve = |n: u32| {
            let case = table.at_lag(phase_lag(n));
            let airborne_speed_rad_per_s = speeds(&case, &angles)?;
            Ok(SeparationCurve { n, phase_lag_rad: case.phase_lag_rad, airborne_speed_rad_per_s })
        };
        Ok(Self {
            lowest_rad: left_at.iter().copied().fold(f64::INFINITY, f64::min),
            highest_rad: left_at.iter().copied().fold(0.0, f64::max),
            separation_phase_rad: left_at,
            curves: (0..=LAGS).map(curve).collect::<Result<_, ExperimentError>>()?,
        })
    }
}

/// A curve of panel (e).
#[derive(Debug, Serialize)]
pub(super) struct FrictionCurve {
    pub(super) friction: f64,
    pub(super) airborne_speed_rad_per_s: Vec<f64>,
    pub(super) fastest: TossPoint,
}

/// The fastest toss at a friction coefficient.
#[derive(Debug, Serialize)]
pub(super) struct FrictionOptimum {
    pub(super) friction: f64,
    pub(super) fastest: TossPoint,
}

impl FrictionCurve {
    pub(super) fn new(table: &TossCase, friction: f64, angles: &[f64]) -> Result<Self, ExperimentError> {
        let FrictionOptimum { fastest, .. } = FrictionOptimum::new(table, friction)?;
        let speeds = speeds(&TossCase { friction, ..*table }, angles)?;
        Ok(Self { friction, airborne_speed_rad_per_s: speeds, fastest })
    }
}

impl FrictionOptimum {
    pub(super) fn new(table: &TossCase, friction: f64) -> Result<Self, ExperimentError> {
        let case = TossCase { friction, ..*table };
        Ok(Self { friction, fastest: best_angle(&case, InitialSpin::AbsoluteRest, speed)? })
    }
}
