//! Fig. 4: the performance of single tosses.

mod best;
mod draw;
mod grid;
mod optimum;
mod tosses;

use std::f64::consts::PI;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk::toss::InitialSpin;
use serde::Serialize;

use self::best::{Best, Compromise, held_to_separation};
use self::grid::Consistency;
use self::tosses::{
    Family, FrictionCurve, FrictionOptimum, INITIAL_STATES, Separation, TossPoint, angles, best_angle, speed,
};
use super::shared::toss::TossCase;
use crate::claims::judging::trend;
use crate::claims::paper::{self, SectionThree, TableOne};
use crate::claims::{Claim, catalogue};
use crate::experiment::{ExperimentError, Paper};

/// What is drawn.
#[derive(Debug, Serialize)]
struct Curves {
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
    /// Panel (f).
    consistency: Consistency,
}

/// Fig. 4.
pub(crate) fn fig04(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    let progress = fig.progress;
    progress.start(5, "parts");
    let count = fig.quality.choose(61, 481);
    let rest = InitialSpin::AbsoluteRest;
    let table_i = paper::table_one()?;
    let printed = paper::section_three()?;
    let table = TossCase::from(&table_i);

    // (a) to (c): the measures against φ_L at each lag.
    let angles = angles(&table, count);
    let families = INITIAL_STATES.map(|initial| Family::new(&table, initial, &angles));
    let families = families.into_iter().collect::<Result<Vec<_>, _>>()?;
    progress.advance(1);

    // (d): the speed against the phase of separation.
    let separation = Separation::new(&table, count)?;
    progress.advance(1);
    fig.claim(
        Claim::printed("section3.separation_highest", separation.highest_rad)
            .note(
                "sin τ_sep = g/(cω² cos φ_L) reaches 1 at the end of the range of φ_L; whether the journal or the extraction of its text has \
                 π/4 for π/2 is unknown",
            )
            .cause("π/4 for π/2"),
    );

    // (e): the speed at each friction, and its maximum at less friction.
    let curves = printed.frictions_of_fig4e.iter();
    let friction_curves = curves
        .map(|friction| FrictionCurve::new(&table, *friction, &angles))
        .collect::<Result<Vec<_>, _>>()?;
    let halved = std::iter::successors(Some(0.5 * table.friction), |friction| Some(0.5 * friction)).take(6);
    let low_friction =
        halved.map(|friction| FrictionOptimum::new(&table, friction)).collect::<Result<Vec<_>, _>>()?;
    let shown = friction_curves.iter().map(|curve| (curve.friction, curve.fastest.amplitude_angle_rad));
    let low = low_friction.iter().map(|low| (low.friction, low.fastest.amplitude_angle_rad));
    let mut optima: Vec<(f64, f64)> = shown.chain(low).collect();
    optima.sort_by(|one, other| one.0.total_cmp(&other.0));
    let parts: Vec<_> =
        optima.iter().map(|(friction, angle)| format!("{} at μ = {friction}", pi(*angle))).collect();
    fig.claim(Claim::printed_statement(
        "section3.optimum_grows_with_friction",
        trend(optima, 1.0),
        parts.join(", "),
    ));
    fig.record("low_friction", &low_friction)?;
    progress.advance(1);

    // The best tosses of all lags, and the parameters with which all printed numbers come out.
    let best = [Best::new(&table, INITIAL_STATES[0])?, Best::new(&table, INITIAL_STATES[1])?];
    progress.advance(1);
    let toss_of_table_i = TossPoint::of(&table, rest)?;
    let fastest = best_angle(&table, rest, speed)?;
    let energy = table.at_angle(fastest.amplitude_angle_rad).toss(rest)?;
    let lossless = energy.rotary_energy_gain / (energy.energy.platform_work() - energy.energy.friction_loss);
    let printed_optimum = catalogue::number("section3.optimal_amplitude_angle", 0)?.value;
    let at_printed_optimum = TossPoint::of(&table.at_angle(printed_optimum), rest)?.ratio();
    let compromise = Compromise::new(&table)?;
    let predicted = toss_of_table_i.airborne_speed_rad_per_s;
    fig.claim(
        Claim::printed("section3.predicted_airborne_speed", predicted)
            .note("its printed uncertainty, and the speed measured in the video, are compared in Table II"),
    );
    fig.record("table_i_toss", &toss_of_table_i)?;
    fig.record("best", &best)?;
    fig.record("held_to_separation_angle_rad", &held_to_separation(&table))?;
    fig.record("lossless_efficiency_of_fastest", &lossless)?;
    fig.record("speed_ratio_at_printed_optimum", &at_printed_optimum)?;
    fig.record("compromise", &compromise)?;
    let consistency = Consistency::new(&table_i, &printed, count)?;
    progress.advance(1);

    let curves = Curves {
        table_i,
        printed,
        largest_amplitude_angle_rad: table.largest_angle(),
        amplitude_angle_rad: angles,
        families,
        separation,
        friction_curves,
        consistency,
    };
    optimum::claims(fig, &curves, &best, &compromise, [lossless, at_printed_optimum])?;
    let Curves { table_i, consistency: Consistency { coarse_grid, .. }, .. } = &curves;
    fig.caption(format!(
        "Performance of single tosses with Table I's parameters against φ_L: (a) airborne speed, (b) energy efficiency, (c) speed ratio; \
         n at a curve: θ = nπ/8. The dough starts at rest, in (a′)–(c′) with the hand's spin. (d) Speed against the phase of \
         separation, arcsin(g/cω²) = {} to π/2. (e) Speed at θ = 0 for three μ. Circles: maxima. (f) The maximum at θ = 0 for \
         Table I, and with ω = {:.2} rad/s, a_g = {:.4} m on {} intervals of φ_L; square: printed.",
        pi(curves.separation.lowest_rad),
        coarse_grid.angular_frequency_rad_per_s,
        coarse_grid.reading.parameters.gyration_radius_m,
        coarse_grid.intervals,
    ));
    let frictions: Vec<_> = curves.friction_curves.iter().map(|curve| curve.friction.to_string()).collect();
    fig.parameter("phase lag θ", "nπ/8, n = 0 … 8");
    fig.parameter(
        "amplitude angle φ_L",
        format!("0 to arccos(g/cω²) = {}", pi(curves.largest_amplitude_angle_rad)),
    );
    fig.parameter("stroke c", format!("{} m", table_i.stroke_m));
    fig.parameter("angular frequency ω", format!("{} rad/s", table_i.angular_frequency_rad_per_s));
    fig.parameter("contact radius a_e", format!("{} m", table_i.contact_radius_m));
    fig.parameter("radius of gyration a_g", format!("{} m", table_i.gyration_radius_m));
    fig.parameter("friction μ", format!("{}; (e) {}", table_i.friction, frictions.join(", ")));
    fig.parameter("gravity g", format!("{} m/s²", table_i.preload_acceleration_m_per_s2));
    fig.parameter("start", "lowest point of the hand, τ = 3π/2; dough at rest, or turning with the hand");
    fig.parameter("points of a curve", curves.amplitude_angle_rad.len());
    fig.draw(draw::draw(&curves));
    fig.data(&curves)
}

/// An angle as a multiple of π.
fn pi(angle: f64) -> String {
    format!("{:.4}π", angle / PI)
}
