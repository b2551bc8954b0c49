//! Fig. 4: the performance of single tosses.

mod claims;
mod consistency;
mod data;
mod draw;
mod sweep;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::toss::InitialSpin;

use self::consistency::consistency;
pub(crate) use self::data::Fig04Data;
use self::data::TossPoint;
use super::shared::toss::TossCase;
use crate::claims::paper;
use crate::claims::printed::PrintedNumber;
use crate::experiment::{ExperimentError, Paper, named};

/// Fig. 4.
pub(crate) fn fig04(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let (quality, progress) = (fig.quality, fig.progress);
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
    let data = &Fig04Data {
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
    };
    fig.caption(caption(data));
    fig.parameters(parameters(data));
    fig.claims(claims::claims(data));
    fig.draw(draw::draw(data));
    fig.data(data)
}

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

fn parameters(data: &Fig04Data) -> Vec<(String, String)> {
    let table = &data.table_i;
    named([
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
        ("start", "lowest point of the hand, τ = 3π/2; dough at rest, or turning with the hand".to_owned()),
        ("points of a curve", data.amplitude_angle_rad.len().to_string()),
    ])
}

fn frictions(data: &Fig04Data) -> String {
    let texts: Vec<_> = data.friction_curves.iter().map(|curve| curve.friction.to_string()).collect();
    texts.join(", ")
}
