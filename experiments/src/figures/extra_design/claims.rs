//! What the best hand motions are, against others.

use super::data::ExtraDesignData;
use crate::claim::{self, Claim};
use crate::figures::samples::six_decimals;

const ID: &str = "extra-design";
const PLACE: &str = "this work";

pub(super) fn claims(data: &ExtraDesignData) -> Vec<Claim> {
    let best = &data.at_table_one;
    let certificate = best.certificate;
    let points = || data.curves.iter().flat_map(|curve| &curve.points);
    let worst =
        points().map(|point| point.design.certificate.hidden_gain / point.design.value).fold(0.0, f64::max);
    let limited = data.curves.iter().filter_map(|curve| curve.highest_flight_m.map(|height| (height, curve)));
    let heights = limited.flat_map(|(height, curve)| {
        curve.points.iter().map(move |point| point.design.flight_height - height)
    });
    let highest = heights.clone().fold(f64::NEG_INFINITY, f64::max);
    vec![
        Claim::statement(
            ID,
            PLACE,
            "at the frequency and friction of Table I no hand motion of a random search beats the best one",
            data.random.best_rad_per_s <= best.value * (1.0 + 1e-9),
            format!(
                "best {:.4} rad/s, of {} random motions, {} of which toss the dough, at most {:.4} rad/s; on the grid of {} at most {:.4}, \
                 and at most {:.1e} more may hide between its points",
                best.value,
                data.random.tried,
                data.random.leaving,
                data.random.best_rad_per_s,
                certificate.grid_points,
                certificate.best_on_grid,
                certificate.hidden_gain,
            ),
        ),
        Claim::statement(
            ID,
            PLACE,
            "the best hand gives a larger airborne speed than that of Table I, at its frequency and friction",
            best.value > data.table_one_speed_rad_per_s,
            format!(
                "{:.3} against {:.3} rad/s; φ_L = {:.4} rad and θ = {:.4} rad against {:.4} and {} rad",
                best.value,
                data.table_one_speed_rad_per_s,
                best.hand.amplitude_angle,
                // Without the sign of what is zero but for rounding.
                six_decimals(best.hand.phase_lag) + 0.0,
                data.table_one.amplitude_angle,
                data.table_one.phase_lag,
            ),
        ),
        Claim::statement(
            ID,
            PLACE,
            "limits of height are kept, to a micrometre",
            claim::all(heights, |over| over < 1e-6),
            format!("highest flight over its limit: {highest:.1e} m"),
        ),
        Claim::statement(
            ID,
            PLACE,
            "a lower limit of height never gives more speed",
            claim::all(data.curves.windows(2), |pair| {
                pair[0]
                    .points
                    .iter()
                    .zip(&pair[1].points)
                    .all(|(free, limited)| limited.design.value <= free.design.value * (1.0 + 1e-6))
            }),
            format!(
                "{} frequencies; what may hide between the points of the grids is at most {:.2} %",
                data.curves.first().map_or(0, |curve| curve.points.len()),
                100.0 * worst
            ),
        ),
    ]
}
