//! What the exponents show, and their check.

use super::data::{ExtraLyapunovData, Kind};
use crate::claim::Claim;

const ID: &str = "extra-lyapunov";
const PLACE: &str = "this work";

/// Rounding of the sum of both exponents (docs/numerics/dynamics.md).
const SUM_ROUNDING: f64 = 1e-9;

/// How far the exponent along a periodic orbit may be from that of its multipliers, in units of what is
/// uncertain.
const MULTIPLIER_DEVIATION: f64 = 10.0;

pub(super) fn claims(data: &ExtraLyapunovData) -> Vec<Claim> {
    let (from, to) = data.range();
    let width = (to - from) / data.columns.len().max(2).saturating_sub(1) as f64;
    let longer = data.columns.iter().find(|column| column.impacts != Some(1));
    let chaotic: Vec<f64> = data.of(Kind::Chaotic).filter_map(|column| column.exponent).collect();
    let largest = chaotic.iter().copied().fold(0.0_f64, f64::max);
    let undecided = data.of(Kind::Undecided).count();
    vec![
        Claim::expected(
            ID,
            PLACE,
            "sum of both exponents, less its exact value: the largest deviation",
            "",
            (0.0, SUM_ROUNDING),
            data.sum_deviation,
        )
        .note(format!(
            "2 ln ε + ln(v_0/v_n)/n over n impacts; the tolerance is rounding; {} columns whose orbits do not come to rest",
            data.columns_with_sum
        )),
        Claim::expected(
            ID,
            PLACE,
            "exponent along a periodic orbit, less that of its multipliers: the largest deviation, in units of its uncertainty",
            "",
            (0.0, MULTIPLIER_DEVIATION),
            data.multiplier_deviation,
        )
        .note("the larger of its standard error and 1/impacts, for the first impacts turn the perturbation; the tolerance is ten of them"),
        Claim::expected(
            ID,
            PLACE,
            "Γ of the first column without an orbit of period 1",
            "",
            (data.first_doubling_forcing, width),
            longer.map_or(f64::NAN, |column| column.axial_forcing),
        )
        .note("expected: the first doubling in closed form; the tolerance is one column"),
        Claim::statement(
            ID,
            PLACE,
            "chaos begins behind the cascade, and there is more than one column of it",
            (!chaotic.is_empty()).then(|| {
                chaotic.len() > 1
                    && data.of(Kind::Chaotic).all(|column| column.axial_forcing > data.first_doubling_forcing)
            }),
            format!("{} columns, the largest exponent {largest:.3} per impact", chaotic.len()),
        ),
        Claim::statement(
            ID,
            PLACE,
            "fewer than one column in fifty is undecided",
            50 * undecided < data.columns.len(),
            format!("{undecided} of {}", data.columns.len()),
        ),
    ]
}
