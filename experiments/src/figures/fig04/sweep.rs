//! The curves of panels (a) to (e), their maxima and their symmetries.

use std::convert::Infallible;
use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::core::Phase;
use bouncing_disk::core::numerics::elementary::{acos, asin, cos, sin, tan};
use bouncing_disk::core::numerics::roots::bisected_bracket;
use bouncing_disk::toss::{InitialSpin, TossPerformance};

use super::data::{
    Best, Compromise, Family, FrictionCurve, FrictionOptimum, LagCurve, Separation, SeparationCurve,
    SpeedCurve, TossPoint,
};
use crate::experiment::ExperimentError;
use crate::figures::shared::toss::{TossCase, maximum};

/// The paper's phase lags are n π/8 with n up to this.
const LAGS: u32 = 8;
/// Both initial states, the default one first.
pub(super) const INITIAL_STATES: [InitialSpin; 2] =
    [InitialSpin::AbsoluteRest, InitialSpin::RestRelativeToHand];
/// Samples among which a maximum is bracketed; the curves have fewer bends.
pub(super) const BRACKETS: u32 = 60;
/// Samples of the phase lag for the best toss of all: an odd number, so that θ = 0, where the paper has its
/// optimum, is not one of them and must be found.
const LAG_BRACKETS: u32 = 33;
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

pub(super) fn phase_lag(n: u32) -> f64 {
    PI * f64::from(n) / f64::from(LAGS)
}

impl TossPoint {
    pub(super) fn new(case: &TossCase, toss: &TossPerformance) -> Self {
        Self {
            amplitude_angle_rad: case.amplitude_angle_rad,
            airborne_speed_rad_per_s: toss.airborne_speed,
            efficiency: toss.efficiency,
            speed_ratio: toss.speed_ratio,
        }
    }

    fn of(case: &TossCase, initial: InitialSpin) -> Result<Self, ExperimentError> {
        Ok(Self::new(case, &case.toss(initial)?))
    }
}

/// `count` amplitude angles from 0 to the largest one. They crowd where the curves end steeply: the phase of
/// separation has a square root there.
pub(super) fn angles(case: &TossCase, count: u32) -> Vec<f64> {
    let last = case.last_angle();
    (0..count)
        .map(|index| {
            let left = 1.0 - f64::from(index) / f64::from(count - 1);
            last * (1.0 - left * left)
        })
        .collect()
}

/// The toss with the largest `measure` of all amplitude angles.
pub(super) fn best_angle(
    case: &TossCase,
    initial: InitialSpin,
    measure: impl Fn(&TossPerformance) -> f64,
) -> Result<TossPoint, ExperimentError> {
    // Without twist there is no ratio, so the search starts just above.
    let range = (1e-6 * case.last_angle(), case.last_angle());
    let at = |angle: f64| case.at_angle(angle).toss(initial).map(|toss| measure(&toss));
    let found = maximum(range, BRACKETS, at)?;
    TossPoint::of(&case.at_angle(found.place), initial)
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

pub(super) fn family(
    table: &TossCase,
    initial_state: InitialSpin,
    angles: &[f64],
) -> Result<Family, ExperimentError> {
    let curve = |n: u32| {
        let case = table.at_lag(phase_lag(n));
        let tosses = angles
            .iter()
            .map(|angle| case.at_angle(*angle).toss(initial_state))
            .collect::<Result<Vec<_>, _>>()?;
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
    let curves = (0..=LAGS).map(curve).collect::<Result<_, ExperimentError>>()?;
    Ok(Family { initial_state, curves })
}

pub(super) fn separation(table: &TossCase, count: u32) -> Result<Separation, ExperimentError> {
    let acceleration = table.stroke_acceleration();
    let lowest = asin(1.0 / acceleration);
    // The amplitude angle at which the dough leaves at a phase, from sin(phase) = g/(c ω² cos φ_L).
    let angle = |phase: f64| acos((1.0 / (acceleration * sin(phase))).min(1.0)).min(table.last_angle());
    let phases: Vec<_> = (0..count)
        .map(|index| lowest + (FRAC_PI_2 - lowest) * f64::from(index) / f64::from(count - 1))
        .collect();
    let initial = InitialSpin::AbsoluteRest;
    let mut left_at = Vec::new();
    let mut curves = Vec::new();
    for n in 0..=LAGS {
        let case = table.at_lag(phase_lag(n));
        let mut speeds = Vec::new();
        left_at.clear();
        for phase in &phases {
            let case = case.at_angle(angle(*phase));
            let toss = case.toss(initial)?;
            left_at.push(toss.separation_phase);
            speeds.push(toss.airborne_speed);
        }
        curves.push(SeparationCurve {
            n,
            phase_lag_rad: case.phase_lag_rad,
            airborne_speed_rad_per_s: speeds,
        });
    }
    Ok(Separation {
        lowest_rad: left_at.iter().copied().fold(f64::INFINITY, f64::min),
        highest_rad: left_at.iter().copied().fold(0.0, f64::max),
        separation_phase_rad: left_at,
        curves,
    })
}

/// The airborne speed of tosses from rest.
pub(super) fn speeds(case: &TossCase, angles: &[f64]) -> Result<Vec<f64>, ExperimentError> {
    angles.iter().map(|angle| case.at_angle(*angle).airborne_speed()).collect()
}

pub(super) fn speed_curve(case: &TossCase, count: u32) -> Result<SpeedCurve, ExperimentError> {
    let amplitude_angle_rad = angles(case, count);
    let airborne_speed_rad_per_s = speeds(case, &amplitude_angle_rad)?;
    Ok(SpeedCurve { amplitude_angle_rad, airborne_speed_rad_per_s })
}

pub(super) fn friction_curve(
    table: &TossCase,
    friction: f64,
    angles: &[f64],
) -> Result<FrictionCurve, ExperimentError> {
    let case = TossCase { friction, ..*table };
    Ok(FrictionCurve {
        friction,
        airborne_speed_rad_per_s: speeds(&case, angles)?,
        fastest: best_angle(&case, InitialSpin::AbsoluteRest, speed)?,
    })
}

/// The fastest tosses at a half, a quarter, ... of the friction coefficient.
pub(super) fn low_friction(table: &TossCase) -> Result<Vec<FrictionOptimum>, ExperimentError> {
    let mut friction = table.friction;
    let mut optima = Vec::new();
    for _ in 0..6 {
        friction *= 0.5;
        let case = TossCase { friction, ..*table };
        let fastest = best_angle(&case, InitialSpin::AbsoluteRest, speed)?;
        optima.push(FrictionOptimum { friction, fastest });
    }
    Ok(optima)
}

/// The best tosses of all phase lags; beyond ±π/2 they repeat with the other sign.
pub(super) fn best(table: &TossCase, initial_state: InitialSpin) -> Result<Best, ExperimentError> {
    let over_lags = |measure: fn(&TossPerformance) -> f64| {
        let found = maximum((-FRAC_PI_2, FRAC_PI_2), LAG_BRACKETS, |lag| {
            let best = best_angle(&table.at_lag(lag), initial_state, measure)?;
            Ok::<_, ExperimentError>(measure(
                &table.at_lag(lag).at_angle(best.amplitude_angle_rad).toss(initial_state)?,
            ))
        })?;
        Ok::<_, ExperimentError>((
            found.place,
            best_angle(&table.at_lag(found.place), initial_state, measure)?,
        ))
    };
    let (fastest_phase_lag_rad, fastest) = over_lags(speed)?;
    let (most_efficient_phase_lag_rad, most_efficient) = over_lags(efficiency)?;
    Ok(Best { initial_state, fastest_phase_lag_rad, fastest, most_efficient_phase_lag_rad, most_efficient })
}

/// The largest amplitude angle at which a dough whose hand is fastest at the separation, θ = −τ_sep, is held
/// up to then. Just before it the hand's angular acceleration and the contact force both fall in proportion
/// to the time that is left, so that friction holds where ω² Φ ≤ (μ a_e/a_g²) A ω² cos τ_sep.
pub(super) fn held_to_separation(table: &TossCase) -> f64 {
    let reach = table.contact_radius_m / table.gyration_radius_m;
    let grip = table.friction * reach * reach;
    let holds = |angle: f64| {
        let separation = asin((1.0 / (table.stroke_acceleration() * cos(angle))).min(1.0));
        Ok::<_, Infallible>(tan(angle) <= grip * cos(separation))
    };
    // Down to the last place.
    let Ok((held, _)) = bisected_bracket(0.0, table.last_angle(), 60, holds);
    held
}

/// Between which angles the fastest toss at θ = 0 lies.
pub(super) fn compromise(table: &TossCase) -> Result<Compromise, ExperimentError> {
    let initial = InitialSpin::AbsoluteRest;
    let hand_at_separation = |angle: f64| {
        let system = table.at_angle(angle).system()?;
        let phase = Phase::new(table.at_angle(angle).toss(initial)?.separation_phase)?;
        Ok::<_, ExperimentError>(system.platform().angular_speed(phase).abs())
    };
    let fastest_hand = maximum((0.0, table.last_angle()), BRACKETS, hand_at_separation)?;
    Ok(Compromise {
        least_slip_angle_rad: best_angle(table, initial, ratio)?.amplitude_angle_rad,
        fastest_toss_angle_rad: best_angle(table, initial, speed)?.amplitude_angle_rad,
        fastest_hand_at_separation_angle_rad: fastest_hand.place,
        hand_speed_at_separation_rad_per_s: fastest_hand.value,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The phase lag with the largest |ν| at an amplitude angle, the phase of separation there, and |ν|.
    fn best_lag(case: &TossCase, initial: InitialSpin) -> (f64, f64, f64) {
        let at = |lag: f64| case.at_lag(lag).toss(initial);
        // An odd number of intervals, so that θ = 0 is no sample; beyond ±π/2 the tosses repeat with the
        // other sign.
        let found =
            maximum((-FRAC_PI_2, FRAC_PI_2), 65, |lag| at(lag).map(|toss| ratio(&toss))).expect("leaves");
        let toss = at(found.place).expect("leaves");
        (found.place, toss.separation_phase, ratio(&toss))
    }

    #[test]
    fn the_largest_ratio_is_one_as_long_as_friction_holds_the_dough_to_the_hands_fastest_moment() {
        let table = TossCase::from(&crate::claims::paper::table_one().expect("reads"));
        let held = held_to_separation(&table);
        for initial in INITIAL_STATES {
            for share in [0.1, 0.5, 0.98] {
                let (lag, separation, ratio) = best_lag(&table.at_angle(share * held), initial);
                assert!((ratio - 1.0).abs() < 1e-12, "{share} {ratio}");
                assert!((lag + separation).abs() < 1e-6, "{share} {lag} {separation}");
            }
            assert!(best_lag(&table.at_angle(1.2 * held), initial).2 < 1.0 - 1e-6);
        }
    }
}
