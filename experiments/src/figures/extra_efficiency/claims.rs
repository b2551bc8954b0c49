//! What the map shows, and its checks.

use super::data::ExtraEfficiencyData;
use crate::claim::{self, Claim};

const ID: &str = "extra-efficiency";
const PLACE: &str = "this work";

/// Two numbers agree if they differ by at most so many standard errors of their difference.
const ERRORS: f64 = 3.0;

/// The energy balance closes to this share of what is put in.
const BALANCED: f64 = 1e-10;

pub(super) fn claims(data: &ExtraEfficiencyData) -> Vec<Claim> {
    let best = &data.best;
    let (one, other) = (best.efficiency.standard_error, best.again.standard_error);
    let allowed = ERRORS * (one * one + other * other).sqrt();
    let first = data.along_load.points.first();
    let losses = first.map(|point| point.restitution_loss.value / point.input_power.value);
    let shares_close = claim::all(&data.along_load.points, |point| {
        let spent = point.mechanical_power.value + point.restitution_loss.value + point.friction_loss.value;
        (spent / (point.input_power.value + point.perturbation_power) - 1.0).abs() < 1e-2
    });
    let worst_mirror = data.mirrored.iter().map(|[one, other]| (one.value + other.value).abs()).fold(0.0, f64::max);
    vec![
        Claim::expected(
            ID,
            PLACE,
            "efficiency of the best motor of the map",
            "%",
            (100.0 * best.again.value, 100.0 * allowed),
            100.0 * best.efficiency.value,
        )
        .note(format!(
            "expected: an ensemble with seed {}; three standard errors of the difference; the best of {} cells is a little too \
             high by selection",
            best.other_seed,
            data.phase_lags_rad.len() * data.load_shares.len()
        )),
        Claim::statement(
            ID,
            PLACE,
            "the energy of every motor is balanced to 1e-10 of what is put in",
            data.largest_energy_residual <= BALANCED,
            format!("largest rest {:.1e}", data.largest_energy_residual),
        )
        .identity(),
        Claim::statement(
            ID,
            PLACE,
            "mechanical power and the two losses are what is put in, to 1 %",
            shares_close,
            "the rest is what the rotor has stored at the end more than at the start",
        ),
        Claim::statement(
            ID,
            PLACE,
            "without a load a motor whose lag is larger by π turns as fast the other way",
            claim::all(&data.mirrored, |[one, other]| {
                let error = one.standard_error * one.standard_error + other.standard_error * other.standard_error;
                (one.value + other.value).abs() <= ERRORS * error.sqrt()
            }),
            format!("{} lags, largest sum {worst_mirror:.1e} rad/s", data.mirrored.len()),
        ),
        Claim::statement(
            ID,
            PLACE,
            "restitution takes more of the energy than friction, at every load of (b)",
            claim::all(&data.along_load.points, |point| {
                point.restitution_loss.value > point.friction_loss.value
            }),
            format!(
                "without load {} of what is put in",
                losses.map_or("none".to_owned(), |share| format!("{:.1} %", 100.0 * share))
            ),
        ),
    ]
}
