//! What the map shows, and its checks.

use bouncing_disk::OperatingPoint;

use super::data::ExtraEfficiencyData;
use crate::claim::{self, Claim};

const ID: &str = "extra-efficiency";
const PLACE: &str = "this work";

/// Two numbers agree if they differ by at most so many standard errors of their difference.
const ERRORS: f64 = 3.0;

/// The energy balance closes to this share of what is put in.
const BALANCED: f64 = 1e-10;

fn percent(share: Option<f64>) -> String {
    share.map_or("none".to_owned(), |share| format!("{:.1} %", 100.0 * share))
}

pub(super) fn claims(data: &ExtraEfficiencyData) -> Vec<Claim> {
    let best = &data.best;
    let (one, other) = (best.efficiency.standard_error, best.again.standard_error);
    let allowed = ERRORS * (one * one + other * other).sqrt();
    let first = data.along_load.points.first();
    let restitution = |point: &OperatingPoint| point.restitution_loss.value / point.input_power.value;
    let losses = first.map(restitution);
    let driving: Vec<OperatingPoint> = data
        .along_load
        .points
        .iter()
        .take_while(|point| point.mechanical_power.value >= 0.0)
        .copied()
        .collect();
    let last = driving.last().map(restitution);
    let shares_close = claim::all(&data.along_load.points, |point| {
        let spent = point.mechanical_power.value + point.restitution_loss.value + point.friction_loss.value;
        (spent / (point.input_power.value + point.perturbation_power) - 1.0).abs() < 1e-2
    });
    let worst_mirror =
        data.mirrored.iter().map(|[one, other]| (one.value + other.value).abs()).fold(0.0, f64::max);
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
            "up to stall the share that restitution takes falls with the load, at the lag of (b)",
            claim::all(driving.windows(2), |pair| restitution(&pair[1]) < restitution(&pair[0])),
            format!(
                "{} of what is put in without load, {} under the last of {} loads",
                percent(losses),
                percent(last),
                driving.len(),
            ),
        ),
    ]
}
