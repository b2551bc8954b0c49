//! The curves of panels (a) to (e), their maxima and their symmetries.

use std::convert::Infallible;
use std::f64::consts::{FRAC_PI_2, PI};

use bouncing_disk::core::Phase;
use bouncing_disk::core::elementary::{acos, asin, cos, sin, tan};
use bouncing_disk::core::numerics::roots::bisected_bracket;
use bouncing_disk::{InitialSpin, TossPerformance, single_toss};

use super::data::{
    Best, Compromise, Family, FrictionCurve, FrictionOptimum, LagCurve, LagOptimum, LagProfile, NoLaunch,
    RatioSearch, Separation, SeparationCurve, SpeedCurve, Symmetry, TossPoint,
};
use crate::experiment::ExperimentError;
use crate::figures::motor_case::core_error;
use crate::figures::toss_case::{TossCase, maximum};

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
/// Samples of the phase lag for the largest speed ratio at one amplitude angle, odd for the same reason.
const RATIO_BRACKETS: u32 = 65;
/// Amplitude angles beyond arccos(g/cω²) at which a launch is tried.
const TRIED_BEYOND: u32 = 100;
/// The lags of the profile of the speed ratio run from minus this to plus this.
const PROFILE_REACH: f64 = 0.25 * PI;

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
    let mut deviation = 0.0_f64;
    let mut curves = Vec::new();
    for n in 0..=LAGS {
        let case = table.at_lag(phase_lag(n));
        let mut speeds = Vec::new();
        left_at.clear();
        for phase in &phases {
            let case = case.at_angle(angle(*phase));
            let toss = case.toss(initial)?;
            let formula = asin(1.0 / (PI * case.system()?.axial_forcing()));
            deviation = deviation.max((toss.separation_phase - formula).abs());
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
        deviation_from_formula_rad: deviation,
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

/// The largest |ν| at an amplitude angle, of all phase lags; beyond ±π/2 they repeat with the other sign.
fn best_lag(case: &TossCase, initial: InitialSpin) -> Result<LagOptimum, ExperimentError> {
    let found = maximum((-FRAC_PI_2, FRAC_PI_2), RATIO_BRACKETS, |lag| {
        case.at_lag(lag).toss(initial).map(|toss| ratio(&toss))
    })?;
    let toss = case.at_lag(found.place).toss(initial)?;
    Ok(LagOptimum {
        amplitude_angle_rad: case.amplitude_angle_rad,
        phase_lag_rad: found.place,
        separation_phase_rad: toss.separation_phase,
        speed_ratio: ratio(&toss),
    })
}

/// The largest |ν| of all phase lags and amplitude angles: at each of `count` angles the best of all lags,
/// and between the neighbours of the best angle the golden section.
pub(super) fn ratio_search(
    table: &TossCase,
    initial_state: InitialSpin,
    count: u32,
) -> Result<RatioSearch, ExperimentError> {
    let last = table.last_angle();
    // Without twist there is no ratio: the first angle is that of the first interval's end.
    let angle = |index: u32| last * f64::from(index) / f64::from(count);
    let over_lags = (1..=count)
        .map(|index| best_lag(&table.at_angle(angle(index)), initial_state))
        .collect::<Result<Vec<_>, _>>()?;
    let best = maximum_index(over_lags.iter().map(|optimum| optimum.speed_ratio)) as u32;
    let range = (angle(best).max(1e-6 * last), angle((best + 2).min(count)));
    let found = maximum(range, 2, |angle| {
        best_lag(&table.at_angle(angle), initial_state).map(|optimum| optimum.speed_ratio)
    })?;
    let largest = best_lag(&table.at_angle(found.place), initial_state)?;
    Ok(RatioSearch { initial_state, largest, over_lags })
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

/// |ν| against the phase lag at an amplitude angle; the dough starts at rest.
pub(super) fn profile(case: &TossCase, count: u32) -> Result<LagProfile, ExperimentError> {
    let phase_lag_rad: Vec<_> = (0..count)
        .map(|index| PROFILE_REACH * (2.0 * f64::from(index) / f64::from(count - 1) - 1.0))
        .collect();
    let ratios = phase_lag_rad
        .iter()
        .map(|lag| case.at_lag(*lag).toss(InitialSpin::AbsoluteRest).map(|toss| ratio(&toss)));
    Ok(LagProfile {
        amplitude_angle_rad: case.amplitude_angle_rad,
        speed_ratio: ratios.collect::<Result<_, _>>()?,
        best: best_lag(case, InitialSpin::AbsoluteRest)?,
        phase_lag_rad,
    })
}

/// Between which angles the fastest toss at θ = 0 lies.
pub(super) fn compromise(table: &TossCase) -> Result<Compromise, ExperimentError> {
    let initial = InitialSpin::AbsoluteRest;
    let hand_at_separation = |angle: f64| {
        let system = table.at_angle(angle).system()?;
        let phase = Phase::new(table.at_angle(angle).toss(initial)?.separation_phase).map_err(core_error)?;
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

/// Whether the dough leaves at amplitude angles just below and everywhere beyond arccos(g/cω²).
pub(super) fn no_launch(table: &TossCase) -> Result<NoLaunch, ExperimentError> {
    let limit = table.largest_angle();
    let leaves = |angle: f64| -> Result<bool, ExperimentError> {
        let system = table.at_angle(angle).system()?;
        Ok(single_toss(&system, InitialSpin::AbsoluteRest).is_ok())
    };
    let mut launched_beyond = 0;
    for index in 1..=TRIED_BEYOND {
        let angle = limit + (FRAC_PI_2 - limit) * f64::from(index) / f64::from(TRIED_BEYOND);
        launched_beyond += u32::from(leaves(angle)?);
    }
    Ok(NoLaunch {
        launched_just_below: leaves(table.last_angle())?,
        tried_beyond: TRIED_BEYOND,
        launched_beyond,
    })
}

pub(super) fn symmetry(table: &TossCase, angles: &[f64]) -> Result<Symmetry, ExperimentError> {
    let mut symmetry =
        Symmetry { tosses: 0, airborne_speed_rad_per_s: 0.0, speed_ratio: 0.0, efficiency: 0.0 };
    for initial in INITIAL_STATES {
        for n in 0..=LAGS {
            for angle in angles {
                let case = table.at_angle(*angle).at_lag(phase_lag(n));
                let one = case.toss(initial)?;
                let other = case.at_lag(case.phase_lag_rad + PI).toss(initial)?;
                symmetry.tosses += 1;
                let speed = (one.airborne_speed + other.airborne_speed).abs();
                symmetry.airborne_speed_rad_per_s = symmetry.airborne_speed_rad_per_s.max(speed);
                let efficiency = (one.efficiency - other.efficiency).abs();
                symmetry.efficiency = symmetry.efficiency.max(efficiency);
                if let (Some(one), Some(other)) = (one.speed_ratio, other.speed_ratio) {
                    symmetry.speed_ratio = symmetry.speed_ratio.max((one + other).abs());
                }
            }
        }
    }
    Ok(symmetry)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_ratio_is_one_as_long_as_friction_holds_the_dough_to_the_hands_fastest_moment() {
        let table = TossCase::from(&crate::paper::table_one().expect("reads"));
        let held = held_to_separation(&table);
        for initial in INITIAL_STATES {
            for share in [0.1, 0.5, 0.98] {
                let best = best_lag(&table.at_angle(share * held), initial).expect("leaves");
                assert!((best.speed_ratio - 1.0).abs() < 1e-12, "{share} {best:?}");
                assert!((best.phase_lag_rad + best.separation_phase_rad).abs() < 1e-6, "{share} {best:?}");
            }
            let beyond = best_lag(&table.at_angle(1.2 * held), initial).expect("leaves");
            assert!(beyond.speed_ratio < 1.0 - 1e-6, "{beyond:?}");
        }
    }

    /// The search meets both the plateau and, on the curve of θ = 0, the flat maximum that the paper prints.
    #[test]
    fn the_search_over_all_lags_finds_more_than_the_linear_motion_has() {
        let table = TossCase::from(&crate::paper::table_one().expect("reads"));
        let initial = InitialSpin::AbsoluteRest;
        let search = ratio_search(&table, initial, 12).expect("runs");
        let linear = best_angle(&table, initial, ratio).expect("runs");
        assert!((search.largest.speed_ratio - 1.0).abs() < 1e-12, "{:?}", search.largest);
        assert!(linear.speed_ratio.is_some_and(|ratio| (0.985..0.995).contains(&ratio)), "{linear:?}");
    }
}
