//! The best tosses: of all phase lags, without any slip, and between which angles.

use std::convert::Infallible;
use std::f64::consts::FRAC_PI_2;

use bouncing_disk::core::Phase;
use bouncing_disk::core::numerics::elementary::{asin, cos, tan};
use bouncing_disk::core::numerics::roots::bisected_bracket;
use bouncing_disk::toss::{InitialSpin, TossPerformance};
use serde::Serialize;

use super::tosses::{BRACKETS, TossPoint, best_angle, efficiency, ratio, speed};
use crate::experiment::ExperimentError;
use crate::figures::shared::toss::{TossCase, maximum};

/// Samples of the phase lag for the best toss of all: an odd number, so that θ = 0, where the paper has its
/// optimum, is not one of them and must be found.
const LAG_BRACKETS: u32 = 33;

/// The fastest and the most efficient toss of all phase lags in [−π/2, π/2], beyond which they repeat with the other sign,
/// and all amplitude angles.
#[derive(Debug, Serialize)]
pub(super) struct Best {
    initial_state: InitialSpin,
    pub(super) fastest_phase_lag_rad: f64,
    pub(super) fastest: TossPoint,
    pub(super) most_efficient_phase_lag_rad: f64,
    most_efficient: TossPoint,
}

impl Best {
    pub(super) fn new(table: &TossCase, initial_state: InitialSpin) -> Result<Self, ExperimentError> {
        let over_lags = |measure: fn(&TossPerformance) -> f64| {
            let best = |lag: f64| best_angle(&table.at_lag(lag), initial_state, measure);
            let found = maximum((-FRAC_PI_2, FRAC_PI_2), LAG_BRACKETS, |lag| {
                let angle = best(lag)?.amplitude_angle_rad;
                Ok::<_, ExperimentError>(measure(&table.at_lag(lag).at_angle(angle).toss(initial_state)?))
            })?;
            Ok::<_, ExperimentError>((found.place, best(found.place)?))
        };
        let (fastest_phase_lag_rad, fastest) = over_lags(speed)?;
        let (most_efficient_phase_lag_rad, most_efficient) = over_lags(efficiency)?;
        Ok(Self {
            initial_state,
            fastest_phase_lag_rad,
            fastest,
            most_efficient_phase_lag_rad,
            most_efficient,
        })
    }
}

/// The largest amplitude angle at which a dough whose hand is fastest at the separation, θ = −τ_sep, is held
/// up to then: tan φ_L = (μ a_e²/a_g²) cos τ_sep. Just before it the hand's angular acceleration and the contact force both
/// fall in proportion to the time that is left, so that friction holds where ω² Φ ≤ (μ a_e/a_g²) A ω² cos τ_sep.
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

/// Amplitude angles about the fastest toss, at θ = 0.
#[derive(Debug, Serialize)]
pub(super) struct Compromise {
    /// Where the speed ratio is largest.
    pub(super) least_slip_angle_rad: f64,
    pub(super) fastest_toss_angle_rad: f64,
    /// Where the hand turns fastest as the dough leaves: the fastest toss if nothing slipped.
    pub(super) fastest_hand_at_separation_angle_rad: f64,
    pub(super) hand_speed_at_separation_rad_per_s: f64,
}

impl Compromise {
    pub(super) fn new(table: &TossCase) -> Result<Self, ExperimentError> {
        let initial = InitialSpin::AbsoluteRest;
        let fastest_hand = maximum((0.0, table.last_angle()), BRACKETS, |angle: f64| {
            let case = table.at_angle(angle);
            let phase = Phase::new(case.toss(initial)?.separation_phase)?;
            Ok::<_, ExperimentError>(case.system()?.platform().angular_speed(phase).abs())
        })?;
        Ok(Self {
            least_slip_angle_rad: best_angle(table, initial, ratio)?.amplitude_angle_rad,
            fastest_toss_angle_rad: best_angle(table, initial, speed)?.amplitude_angle_rad,
            fastest_hand_at_separation_angle_rad: fastest_hand.place,
            hand_speed_at_separation_rad_per_s: fastest_hand.value,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tosses::INITIAL_STATES;
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
