//! Fig. 4: the performance of single tosses.

mod claims;
mod consistency;
mod draw;
mod sweep;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::toss::InitialSpin;
use bouncing_disk_plot::Figure;
use serde::{Deserialize, Serialize};

use self::consistency::consistency;
use super::toss_case::TossCase;
use crate::claims::printed::PrintedNumber;
use crate::claims::{
    Claim,
    paper::{self, SectionThree, TableOne},
};
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;

/// Fig. 4.
#[derive(Debug)]
pub struct Fig04;

impl Experiment for Fig04 {
    type Data = Fig04Data;
    const ID: &'static str = "fig04";
    const TITLE: &'static str = "The performance of single tosses";
    const DISCUSSION: &str = include_str!("fig04/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &Fig04Data) -> String {
        let grid = &data.consistency.coarse_grid;
        format!(
            "The performance of pizza tosses with the parameters of Table I: (a) airborne rotation speed, (b) energy \
             efficiency and (c) ratio of airborne speed to the hand's largest speed against the amplitude ratio φ_L = \
             arctan L at phase lags θ = nπ/8, with n at the curves; circles mark the fastest, most efficient and \
             highest-ratio toss at θ = 0 and π. The dough starts at rest in (a)–(c), and turning with the hand in (a′)–(c′), \
             where its initial spin counts as put in by the hand; the two agree at θ = 0 and π. (d) Airborne speed \
             against the phase of separation τ_sep, which runs from arcsin(g/cω²) = {} to π/2. (e) Airborne speed at \
             θ = 0 for three coefficients of friction; circles mark the maxima. (f) The maximum at θ = 0: Table I as \
             printed, and ω = {:.2} rad/s of Eq. (14) with a_g = {:.4} m, sampled at {} \
             equal intervals of φ_L, whose best point has all printed numbers; the square is the printed maximum with \
             the rounding of its digits.",
            claims::pi(data.separation.lowest_rad),
            grid.angular_frequency_rad_per_s,
            grid.reading.parameters.gyration_radius_m,
            grid.intervals,
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig04Data, ExperimentError> {
        compute(quality, progress)
    }

    fn draw(data: &Fig04Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig04Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Fig04Data) -> Vec<(String, String)> {
        let table = &data.table_i;
        [
            ("phase lag θ", "nπ/8, n = 0 … 8".to_owned()),
            (
                "amplitude angle φ_L",
                format!("0 to arccos(g/cω²) = {}", claims::pi(data.largest_amplitude_angle_rad)),
            ),
            ("stroke c", format!("{} m", table.stroke_m)),
            ("angular frequency ω", format!("{} rad/s", table.angular_frequency_rad_per_s)),
            ("contact radius a_e", format!("{} m", table.contact_radius_m)),
            ("radius of gyration a_g", format!("{} m", table.gyration_radius_m)),
            ("friction μ", format!("{}; (e) {}", table.friction, frictions(data))),
            ("gravity g", format!("{} m/s²", table.preload_acceleration_m_per_s2)),
            (
                "start",
                "lowest point of the hand, τ = 3π/2; dough at rest, or turning with the hand".to_owned(),
            ),
            ("points of a curve", data.amplitude_angle_rad.len().to_string()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .to_vec()
    }
}

fn frictions(data: &Fig04Data) -> String {
    let texts: Vec<_> = data.friction_curves.iter().map(|curve| curve.friction.to_string()).collect();
    texts.join(", ")
}

/// The data of Fig. 4.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig04Data {
    table_i: TableOne,
    printed: SectionThree,
    /// acos(g/(c ω²)).
    largest_amplitude_angle_rad: f64,
    /// The abscissa of panels (a) to (c) and (e).
    amplitude_angle_rad: Vec<f64>,
    /// Panels (a) to (c), for both initial states.
    families: Vec<Family>,
    /// Panel (d).
    separation: Separation,
    /// Panel (e).
    friction_curves: Vec<FrictionCurve>,
    /// The fastest toss at friction coefficients below those of panel (e).
    low_friction: Vec<FrictionOptimum>,
    /// The toss of Table I.
    table_i_toss: TossPoint,
    /// |ν| of the toss at the printed optimum, if a number is printed.
    speed_ratio_at_printed_optimum: Option<f64>,
    /// The best tosses of all phase lags and amplitude angles.
    best: Vec<Best>,
    /// Up to this amplitude angle friction holds the dough to the end if θ = −τ_sep: tan φ_L = (μ a_e²/a_g²)
    /// cos τ_sep.
    held_to_separation_angle_rad: f64,
    compromise: Compromise,
    /// Energy efficiency of the fastest toss at θ = 0 if the energy lost in friction is not counted as put
    /// in.
    lossless_efficiency_of_fastest: f64,
    consistency: Consistency,
}

/// The performance measures of one toss.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct TossPoint {
    amplitude_angle_rad: f64,
    airborne_speed_rad_per_s: f64,
    efficiency: f64,
    /// Absent without twist.
    speed_ratio: Option<f64>,
}

/// The curves of one initial state.
#[derive(Debug, Serialize, Deserialize)]
struct Family {
    initial_state: InitialSpin,
    curves: Vec<LagCurve>,
}

/// The performance against the amplitude angle at one phase lag, θ = n π/8.
#[derive(Debug, Serialize, Deserialize)]
struct LagCurve {
    n: u32,
    phase_lag_rad: f64,
    airborne_speed_rad_per_s: Vec<f64>,
    efficiency: Vec<f64>,
    speed_ratio: Vec<Option<f64>>,
    /// Where the absolute value of the airborne speed is largest.
    fastest: TossPoint,
    most_efficient: TossPoint,
    /// Where the absolute value of the speed ratio is largest.
    largest_speed_ratio: TossPoint,
}

/// The airborne speed against the phase of separation.
#[derive(Debug, Serialize, Deserialize)]
struct Separation {
    /// The first and last phase that occur, from the first and the last amplitude angle.
    lowest_rad: f64,
    highest_rad: f64,
    separation_phase_rad: Vec<f64>,
    curves: Vec<SeparationCurve>,
}

/// A curve of panel (d).
#[derive(Debug, Serialize, Deserialize)]
struct SeparationCurve {
    n: u32,
    phase_lag_rad: f64,
    airborne_speed_rad_per_s: Vec<f64>,
}

/// A curve of panel (e).
#[derive(Debug, Serialize, Deserialize)]
struct FrictionCurve {
    friction: f64,
    airborne_speed_rad_per_s: Vec<f64>,
    fastest: TossPoint,
}

/// The fastest toss at a friction coefficient.
#[derive(Debug, Serialize, Deserialize)]
struct FrictionOptimum {
    friction: f64,
    fastest: TossPoint,
}

/// The fastest and the most efficient toss of all phase lags in [-π/2, π/2] and all amplitude angles.
#[derive(Debug, Serialize, Deserialize)]
struct Best {
    initial_state: InitialSpin,
    fastest_phase_lag_rad: f64,
    fastest: TossPoint,
    most_efficient_phase_lag_rad: f64,
    most_efficient: TossPoint,
}

/// Amplitude angles about the fastest toss, at θ = 0.
#[derive(Debug, Serialize, Deserialize)]
struct Compromise {
    /// Where the speed ratio is largest.
    least_slip_angle_rad: f64,
    fastest_toss_angle_rad: f64,
    /// Where the hand turns fastest as the dough leaves: the fastest toss if nothing slipped.
    fastest_hand_at_separation_angle_rad: f64,
    hand_speed_at_separation_rad_per_s: f64,
}

/// Which parameter sets give the numbers that the paper prints for θ = 0.
#[derive(Debug, Serialize, Deserialize)]
struct Consistency {
    /// What Table I gives as printed.
    as_printed: Reading,
    hand_speed: HandSpeed,
    /// The maxima picked from a coarse grid of amplitude angles.
    coarse_grid: CoarseGrid,
    /// Airborne speed of the coarse-grid set.
    coarse_grid_curve: SpeedCurve,
}

/// The hand's largest speed ωΦ at the printed optimum, from Table I's c, ω and a_e and from the printed speed
/// and ratio.
#[derive(Debug, Serialize, Deserialize)]
struct HandSpeed {
    /// The least that Table I gives for an angle that rounds to the printed one.
    least_rad_per_s: f64,
    /// The most that a speed and a ratio that round to the printed ones allow.
    most_rad_per_s: f64,
}

/// A curve of panel (f).
#[derive(Debug, Serialize, Deserialize)]
struct SpeedCurve {
    amplitude_angle_rad: Vec<f64>,
    airborne_speed_rad_per_s: Vec<f64>,
}

/// A parameter set and what it gives in place of the printed numbers.
#[derive(Debug, Serialize, Deserialize)]
struct Reading {
    parameters: TossCase,
    numbers: Vec<Comparison>,
}

/// A printed number and ours.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Comparison {
    quantity: String,
    /// The entry of the catalogue.
    key: String,
    printed: String,
    /// In the unit of the printed number; angles in rad.
    computed: f64,
    reproduced: bool,
}

/// The reading in which maxima are the best points of an even grid of amplitude angles.
#[derive(Debug, Serialize, Deserialize)]
struct CoarseGrid {
    /// ω and φ_L that Eq. (14) gives, not rounded.
    angular_frequency_rad_per_s: f64,
    amplitude_angle_rad: f64,
    /// acos(g/(c ω²)) with that ω.
    largest_amplitude_angle_rad: f64,
    /// The smallest number of equal intervals of [0, acos(g/(c ω²))] whose points hold all printed angles.
    intervals: u32,
    /// The index of each printed angle among these points.
    indices: Vec<u32>,
    /// The same for ω as printed; absent if no number of intervals up to `most_intervals` works.
    intervals_with_printed_frequency: Option<u32>,
    most_intervals: u32,
    /// Share of all largest angles between 0.40 π and 0.48 π for which `intervals` or fewer intervals work.
    share_by_chance: f64,
    /// The range of ω for which the printed angles lie on the grid.
    frequency_range_rad_per_s: (f64, f64),
    /// The radii of gyration, in steps of 0.1 mm, with which all printed numbers come out.
    gyration_radius_range_m: Option<(f64, f64)>,
    /// The one of them that is nearest to Table I; all other parameters are those of Table I, except for ω.
    reading: Reading,
    grid_angle_rad: Vec<f64>,
    grid_speed_rad_per_s: Vec<f64>,
}

fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig04Data, ExperimentError> {
    let count = quality.choose(61, 481);
    progress.start(6, "parts");
    let done = || progress.advance(1);
    let table_i = paper::table_one()?;
    let printed = paper::section_three()?;
    let table = TossCase::from(&table_i);
    let angles = sweep::angles(&table, count);
    let rest = InitialSpin::AbsoluteRest;
    let families = sweep::INITIAL_STATES
        .into_iter()
        .map(|initial| sweep::family(&table, initial, &angles))
        .collect::<Result<Vec<_>, _>>()?;
    done();
    let separation = sweep::separation(&table, count)?;
    done();
    let friction_curves = printed
        .frictions_of_fig4e
        .iter()
        .map(|friction| sweep::friction_curve(&table, *friction, &angles))
        .collect::<Result<Vec<_>, _>>()?;
    let low_friction = sweep::low_friction(&table)?;
    done();
    let best = sweep::INITIAL_STATES
        .into_iter()
        .map(|initial| sweep::best(&table, initial))
        .collect::<Result<Vec<_>, _>>()?;
    done();
    let fastest = sweep::best_angle(&table, rest, sweep::speed)?;
    let toss = table.at_angle(fastest.amplitude_angle_rad).toss(rest)?;
    let kept = toss.energy.platform_work() - toss.energy.friction_loss;
    done();
    let at_printed_optimum = PrintedNumber::read(&printed.optimal_amplitude_angle_rad)
        .map(|angle| {
            Ok::<_, ExperimentError>(TossPoint::new(&table, &table.at_angle(angle.value).toss(rest)?))
        })
        .transpose()?;
    let consistency = consistency(&table_i, &printed, count)?;
    done();
    Ok(Fig04Data {
        largest_amplitude_angle_rad: table.largest_angle(),
        table_i_toss: TossPoint::new(&table, &table.toss(rest)?),
        speed_ratio_at_printed_optimum: at_printed_optimum.and_then(|toss| toss.speed_ratio.map(f64::abs)),
        lossless_efficiency_of_fastest: toss.rotary_energy_gain / kept,
        amplitude_angle_rad: angles,
        families,
        separation,
        friction_curves,
        low_friction,
        best,
        held_to_separation_angle_rad: sweep::held_to_separation(&table),
        compromise: sweep::compromise(&table)?,
        consistency,
        table_i,
        printed,
    })
}
