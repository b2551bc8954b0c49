//! The numbers of Fig. 4.

use bouncing_disk::toss::InitialSpin;
use serde::Serialize;

use crate::claims::paper::{SectionThree, TableOne};
use crate::figures::shared::toss::TossCase;

/// The data of Fig. 4.
#[derive(Debug, Serialize)]
pub(crate) struct Fig04Data {
    pub(super) table_i: TableOne,
    pub(super) printed: SectionThree,
    /// acos(g/(c ω²)).
    pub(super) largest_amplitude_angle_rad: f64,
    /// The abscissa of panels (a) to (c) and (e).
    pub(super) amplitude_angle_rad: Vec<f64>,
    /// Panels (a) to (c), for both initial states.
    pub(super) families: Vec<Family>,
    /// Panel (d).
    pub(super) separation: Separation,
    /// Panel (e).
    pub(super) friction_curves: Vec<FrictionCurve>,
    /// The fastest toss at friction coefficients below those of panel (e).
    pub(super) low_friction: Vec<FrictionOptimum>,
    /// The toss of Table I.
    pub(super) table_i_toss: TossPoint,
    /// |ν| of the toss at the printed optimum, if a number is printed.
    pub(super) speed_ratio_at_printed_optimum: Option<f64>,
    /// The best tosses of all phase lags and amplitude angles.
    pub(super) best: Vec<Best>,
    /// Up to this amplitude angle friction holds the dough to the end if θ = −τ_sep: tan φ_L = (μ a_e²/a_g²)
    /// cos τ_sep.
    pub(super) held_to_separation_angle_rad: f64,
    pub(super) compromise: Compromise,
    /// Energy efficiency of the fastest toss at θ = 0 if the energy lost in friction is not counted as put
    /// in.
    pub(super) lossless_efficiency_of_fastest: f64,
    pub(super) consistency: Consistency,
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

/// The curves of one initial state.
#[derive(Debug, Serialize)]
pub(super) struct Family {
    pub(super) initial_state: InitialSpin,
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
    pub(super) phase_lag_rad: f64,
    pub(super) airborne_speed_rad_per_s: Vec<f64>,
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

/// The fastest and the most efficient toss of all phase lags in [-π/2, π/2] and all amplitude angles.
#[derive(Debug, Serialize)]
pub(super) struct Best {
    pub(super) initial_state: InitialSpin,
    pub(super) fastest_phase_lag_rad: f64,
    pub(super) fastest: TossPoint,
    pub(super) most_efficient_phase_lag_rad: f64,
    pub(super) most_efficient: TossPoint,
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

/// Which parameter sets give the numbers that the paper prints for θ = 0.
#[derive(Debug, Serialize)]
pub(super) struct Consistency {
    /// The results of Table I as printed.
    pub(super) as_printed: Reading,
    pub(super) hand_speed: HandSpeed,
    /// The maxima picked from a coarse grid of amplitude angles.
    pub(super) coarse_grid: CoarseGrid,
    /// Airborne speed of the coarse-grid set.
    pub(super) coarse_grid_curve: SpeedCurve,
}

/// The hand's largest speed ωΦ at the printed optimum, from Table I's c, ω and a_e and from the printed speed
/// and ratio.
#[derive(Debug, Serialize)]
pub(super) struct HandSpeed {
    /// The least that Table I gives for an angle that rounds to the printed one.
    pub(super) least_rad_per_s: f64,
    /// The most that a speed and a ratio that round to the printed ones allow.
    pub(super) most_rad_per_s: f64,
}

/// A curve of panel (f).
#[derive(Debug, Serialize)]
pub(super) struct SpeedCurve {
    pub(super) amplitude_angle_rad: Vec<f64>,
    pub(super) airborne_speed_rad_per_s: Vec<f64>,
}

/// A parameter set and what it gives in place of the printed numbers.
#[derive(Debug, Serialize)]
pub(super) struct Reading {
    pub(super) parameters: TossCase,
    pub(super) numbers: Vec<Comparison>,
}

/// A printed number and ours.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Comparison {
    pub(super) quantity: String,
    /// In the unit of the printed number; angles in rad.
    pub(super) computed: f64,
}

/// The reading in which maxima are the best points of an even grid of amplitude angles.
#[derive(Debug, Serialize)]
pub(super) struct CoarseGrid {
    /// ω and φ_L that Eq. (14) gives, not rounded.
    pub(super) angular_frequency_rad_per_s: f64,
    pub(super) amplitude_angle_rad: f64,
    /// acos(g/(c ω²)) with that ω.
    pub(super) largest_amplitude_angle_rad: f64,
    /// The smallest number of equal intervals of [0, acos(g/(c ω²))] whose points hold all printed angles.
    pub(super) intervals: u32,
    /// The index of each printed angle among these points.
    pub(super) indices: Vec<u32>,
    /// So many are tried.
    pub(super) most_intervals: u32,
    /// Share of all largest angles between 0.40 π and 0.48 π for which `intervals` or fewer intervals work.
    pub(super) share_by_chance: f64,
    /// The range of ω for which the printed angles lie on the grid.
    pub(super) frequency_range_rad_per_s: (f64, f64),
    /// The radii of gyration, in steps of 0.1 mm, with which all printed numbers come out.
    pub(super) gyration_radius_range_m: Option<(f64, f64)>,
    /// The one of them that is nearest to Table I; all other parameters are those of Table I, except for ω.
    pub(super) reading: Reading,
    pub(super) grid_angle_rad: Vec<f64>,
    pub(super) grid_speed_rad_per_s: Vec<f64>,
}
