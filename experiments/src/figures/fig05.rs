//! Fig. 5: hand motions and the dough's motion in single tosses.

mod draw;
mod tosses;

use std::f64::consts::{FRAC_PI_4, FRAC_PI_8, PI};

use bouncing_disk::core::ChatterPolicy;
use serde::Serialize;

use self::tosses::{Column, Toss};
use super::shared::toss::{AngleGrid, TossCase, launch_case, printed_angles, unreadable};
use crate::claims::Claim;
use crate::claims::paper::{self, SectionThree};
use crate::experiment::{ExperimentError, Paper};

/// θ_1 of the caption.
const FIRST_PHASE_LAG: f64 = 0.0;

/// Phase lags about the optimum for the remarks on torque.
const PHASE_LAGS_NEAR_ZERO: [f64; 5] = [-FRAC_PI_4, -FRAC_PI_8, 0.0, FRAC_PI_8, FRAC_PI_4];

/// Multiples of Table I's friction for the limit of sufficient friction.
const FRICTION_FACTORS: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

/// The share of the hand's speed that a dough in a firm grip may lack.
const NEARLY_NOTHING: f64 = 0.01;

/// The hand's speed at the lowest point, cos(3π/2 + θ), is known to this share of the largest one.
const ROUNDING: f64 = 100.0 * f64::EPSILON;

/// Fig. 5.
pub(crate) fn fig05(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let points = fig.quality.choose(60, 240);
    let table_i = paper::table_one()?;
    let printed = paper::section_three()?;
    let table = TossCase::from(&table_i);
    fig.record("table_i", &table_i)?;
    fig.record("printed", &printed)?;

    // One column for each φ_L, with the tosses at both phase lags.
    let angles = printed_angles(&printed)?;
    let texts = [
        &printed.amplitude_angle_of_largest_speed_ratio_rad,
        &printed.optimal_amplitude_angle_rad,
        &printed.amplitude_angle_of_fig5c_rad,
    ];
    let phase_lags = [FIRST_PHASE_LAG, paper::value("section3.second_phase_lag_of_fig5")?];
    let columns = texts
        .into_iter()
        .zip(&angles)
        .map(|(text, angle)| Column::new(text, &table.at_angle(angle.value), phase_lags, points))
        .collect::<Result<Vec<_>, _>>()?;
    fig.record("columns", &columns)?;
    let first = || columns.iter().map(|column| &column.tosses[0]);
    let ratios = columns.iter().map(|column| column.printed.as_str()).collect::<Vec<_>>().join(", ");
    let listed = |values: &[f64], digits: usize| {
        let texts: Vec<_> =
            values.iter().map(|value| format!("{value:.digits$}").replace('-', "−")).collect();
        format!("at φ_L = {ratios}, θ = 0: {}", texts.join(", "))
    };

    let slips: Vec<f64> = first().map(|toss| 100.0 * toss.slip_share()).collect();
    fig.claim(Claim::printed_statement(
        "section3.slip_at_high_angle",
        columns[2].tosses[0].sliding_at_separation && rises(&slips),
        format!(
            "{} % behind the hand; the first slides only at the very end, where N falls to zero",
            listed(&slips, 1)
        ),
    ));
    let speeds: Vec<f64> = first().map(|toss| toss.airborne_speed_rad_per_s).collect();
    fig.claim(Claim::printed_statement(
        "section3.middle_column_is_fastest",
        speeds[1] > speeds[0] && speeds[1] > speeds[2],
        format!(
            "{} rad/s; the fastest toss with Table I's parameters is at another φ_L, see fig04",
            listed(&speeds, 2)
        ),
    ));
    let heights: Vec<f64> = first().map(|toss| toss.apex_height_m).collect();
    fig.claim(Claim::printed_statement(
        "section3.height_falls_with_angle",
        falls(&heights),
        format!("{} m above the hand's mean height", listed(&heights, 3)),
    ));

    // The φ_L of panel (c) as a point of the even grid on which the three printed angles lie.
    let point = GridPoint::new(&launch_case(&table_i, &printed), &printed)?;
    fig.record("grid_point", &point)?;
    fig.claim(
        Claim::printed("section3.amplitude_angle_of_fig5c", point.amplitude_angle_rad)
            .fitted("the number of intervals, the smallest whose points include all three printed angles")
            .note(format!(
                "point {} of {} from 0 to arccos(g/cω²) = {:.4}π with ω = {:.3} rad/s of Eq. (14), see fig04",
                point.index,
                point.intervals,
                point.largest_amplitude_angle_rad / PI,
                point.angular_frequency_rad_per_s
            )),
    );

    // With more friction the dough leaves with the hand's speed.
    let grips = FRICTION_FACTORS
        .into_iter()
        .map(|factor| Grip::new(TossCase { friction: factor * table.friction, ..table }, &columns))
        .collect::<Result<Vec<_>, _>>()?;
    fig.record("firm_grip", &grips)?;
    let firmest = &grips[grips.len() - 1];
    let most = firmest.missing_share.iter().fold(0.0, |most, own| own.abs().max(most));
    // At Table I's friction a dough that is behind the hand may cross its speed as the friction grows.
    let fall = (0..columns.len()).all(|column| {
        falls(&grips[1..].iter().map(|grip| grip.missing_share[column].abs()).collect::<Vec<_>>())
    });
    fig.claim(Claim::printed_statement(
        "section3.no_slip_at_separation",
        fall && most < NEARLY_NOTHING,
        format!(
            "at separation the dough is slower than the hand by a share of at most {most:.1e} at μ = {}, θ = 0, and by less the larger μ is",
            firmest.friction,
        ),
    ));

    // Phase lags about 0 at the printed optimum.
    let lags = PHASE_LAGS_NEAR_ZERO
        .into_iter()
        .map(|lag| {
            let toss = Toss::new(&table.at_angle(angles[1].value).at_lag(lag), points)?;
            Ok(Dependence {
                phase_lag_rad: lag,
                lowest_speed_rad_per_s: toss.lowest_speed_rad_per_s,
                late_gain_rad_per_s: toss.late_gain_rad_per_s,
            })
        })
        .collect::<Result<Vec<_>, ExperimentError>>()?;
    fig.record("lags", &lags)?;
    let at_zero = lags[2].late_gain_rad_per_s;
    let at_rest = ROUNDING * columns.iter().map(|own| own.largest_hand_speed_rad_per_s).fold(0.0, f64::max);
    let listed = |of: fn(&Dependence) -> f64| {
        // Without a sign of rounding.
        let rounded = lags.iter().map(|lag| (100.0 * of(lag)).round() / 100.0 + 0.0);
        rounded.map(|speed| format!("{speed:.2}").replace('-', "−")).collect::<Vec<_>>().join(", ")
    };
    let places =
        format!("rad/s at θ = −π/4, −π/8, 0, π/8, π/4, φ_L = {}", printed.optimal_amplitude_angle_rad);
    fig.claim(Claim::printed_statement(
        "section3.positive_lag_torque",
        lags.iter().all(|lag| lag.phase_lag_rad <= 0.0 || lag.late_gain_rad_per_s < at_zero),
        format!(
            "gained in the second half of the contact: {} {places}",
            listed(|lag| lag.late_gain_rad_per_s)
        ),
    ));
    fig.claim(Claim::printed_statement(
        "section3.negative_lag_torque",
        lags.iter().all(|lag| (lag.phase_lag_rad < 0.0) == (lag.lowest_speed_rad_per_s < -at_rest)),
        format!(
            "lowest speed in contact: {} {places}; the dough starts at rest. The fastest hand is at −θ by definition",
            listed(|lag| lag.lowest_speed_rad_per_s)
        ),
    ));

    fig.caption(format!(
        "Hand motions (dashed) and dough trajectories (solid) of single tosses with Table I's parameters at φ_L = {}: height, angle, \
         angular speed. Phase lags θ_1 = 0 (blue) and θ_2 = π/2 (vermilion), which have the same heights. Time runs \
         from the hand's lowest point, where the dough is at rest; shaded: contact, up to the separation t_sep. The lower \
         rows show the time under the bracket of the upper one. A suboptimal φ_L at θ_1: slip at the separation \
         if high, a slow hand if low.",
        ratios
    ));
    fig.parameter("amplitude angle φ_L", ratios);
    fig.parameter("phase lag θ", phase_lags.map(pi).join(", "));
    fig.parameter("stroke c", format!("{} m", table.stroke_m));
    fig.parameter("angular frequency ω", format!("{} rad/s", table.angular_frequency_rad_per_s));
    fig.parameter("contact radius a_e", format!("{} m", table.contact_radius_m));
    fig.parameter("radius of gyration a_g", format!("{} m", table.gyration_radius_m));
    fig.parameter("friction μ", table.friction);
    fig.parameter("gravity g", format!("{} m/s²", table.preload_acceleration_m_per_s2));
    fig.parameter("start", "lowest point of the hand, τ = 3π/2; dough at rest");

    fig.draw(draw::draw(&columns));
    Ok(())
}

fn pi(angle: f64) -> String {
    format!("{:.3}π", angle / PI)
}

fn rises(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[0] < pair[1])
}

fn falls(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[0] > pair[1])
}

#[derive(Debug, Serialize)]
struct GridPoint {
    /// ω of Eq. (14), not rounded.
    angular_frequency_rad_per_s: f64,
    largest_amplitude_angle_rad: f64,
    intervals: u32,
    index: u32,
    amplitude_angle_rad: f64,
}

impl GridPoint {
    fn new(case: &TossCase, section: &SectionThree) -> Result<Self, ExperimentError> {
        let grid = AngleGrid::with(case.largest_angle(), &printed_angles(section)?).ok_or_else(unreadable)?;
        let index = grid.indices.last().copied().ok_or_else(unreadable)?;
        Ok(Self {
            angular_frequency_rad_per_s: case.angular_frequency_rad_per_s,
            largest_amplitude_angle_rad: grid.largest,
            intervals: grid.intervals,
            index,
            amplitude_angle_rad: grid.angle(index),
        })
    }
}

/// The effect of a phase lag on the toss.
#[derive(Debug, Serialize)]
struct Dependence {
    phase_lag_rad: f64,
    lowest_speed_rad_per_s: f64,
    late_gain_rad_per_s: f64,
}

/// The tosses of the three columns at θ_1 with more friction.
#[derive(Debug, Serialize)]
struct Grip {
    friction: f64,
    /// 1 minus airborne speed over hand speed at the separation, by column.
    missing_share: Vec<f64>,
}

impl Grip {
    fn new(case: TossCase, columns: &[Column]) -> Result<Self, ExperimentError> {
        let missing = columns.iter().map(|column| {
            let case = case.at_angle(column.amplitude_angle_rad).at_lag(FIRST_PHASE_LAG);
            Ok(Toss::new(&case, 1)?.slip_share())
        });
        Ok(Self { friction: case.friction, missing_share: missing.collect::<Result<_, ExperimentError>>()? })
    }
}
