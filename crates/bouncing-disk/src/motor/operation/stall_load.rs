//! The load that stops a motor, bracketed.

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::elementary::hypot;

use crate::error::Error;
use crate::motor::operation::point::{Estimate, OperatingRow, Operation, Shortfall};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::steady_run::{LoadedMotor, operate};

/// Steps of the load from zero to the largest mean torque of friction, and between the two loads that the
/// first search leaves.
const STEPS: usize = 16;

/// The largest load tried, as a share of the largest torque: closer to it the remaining friction settles a
/// speed too slowly.
const NEAREST: f64 = 1.0 - 1.0 / 64.0;

/// A stall load below this part of the largest torque counts as zero: the ripple of a speed within a period
/// is as large.
const LEAST: f64 = 1e-5;

/// The width of an even distribution over its standard deviation, the root of 12.
const EVEN: f64 = 3.464_101_615_137_754_5;

/// A speed differs from zero beyond so many of its standard errors.
const SIGNIFICANT: f64 = 3.0;

/// The load torque at which the mean speed of a motor vanishes: the true stall, not the paper's alpha_ss/t_c
/// ([`ExponentialFit::stall_acceleration`](crate::estimate::ExponentialFit::stall_acceleration)), which is an
/// estimate from the transient without load.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StallLoad {
    /// The torque (N m), with the sign of a load: a positive one stops a positive rotation. Its error is that
    /// at exactly these inputs: [`Motor::stall_spread`](crate::Motor::stall_spread) gives its spread over
    /// their tolerances.
    pub torque: Estimate,
    /// The torque as a share of mu m g a_e, the largest mean torque of friction; in [-1, 1].
    pub share: f64,
    /// Two load torques (N m): under the first the motor surely turns on, beyond three standard errors of its
    /// speed, and under the second it is surely driven back. The second is mu m g a_e if no smaller one
    /// surely does this.
    pub bracket: [f64; 2],
    /// The mean speed without load (rad/s).
    pub no_load_speed: Estimate,
}

/// The stall load of a motor, whatever the load of its data sheet.
pub(crate) fn stall_load(
    motor: &LoadedMotor<'_>,
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<StallLoad, Error> {
    let largest = motor.largest_torque();
    let under = |shares: &[f64]| {
        let motors =
            shares.iter().map(|share| motor.with_load(share * largest)).collect::<Result<Vec<_>, _>>()?;
        operate(&motors, settings, observer)
    };
    // Which way it turns is not known before.
    let shares: Vec<f64> =
        (0..2 * STEPS - 1).map(|k| (k as f64 - (STEPS - 1) as f64) / STEPS as f64).collect();
    let first = under(&shares)?;
    let unloaded = speed_of(&first.rows[STEPS - 1]);
    check_settled(&first.rows[STEPS - 1..STEPS])?;
    if !motor.turns(unloaded) || largest <= 0.0 {
        let Estimate { value: speed, standard_error } = unloaded;
        return Err(Error::DoesNotTurn { speed, standard_error });
    }
    let sign = 1.0_f64.copysign(unloaded.value);
    // Steps away from no load, in the direction that brakes.
    let braked = |step: usize| if sign > 0.0 { STEPS - 1 + step } else { STEPS - 1 - step };
    let turns = |row: &OperatingRow| sign * speed_of(row).value > 0.0;
    let last = (0..STEPS).take_while(|&step| turns(&first.rows[braked(step)])).last().unwrap_or(0);
    let (low, high) = (last as f64 / STEPS as f64, (last + 1) as f64 / STEPS as f64);
    // One step more on either side, for a bracket that is sure.
    let step = (high - low) / STEPS as f64;
    let mut fine: Vec<f64> =
        (0..=STEPS + 2).map(|k| (low + step * (k as f64 - 1.0)).clamp(0.0, NEAREST)).collect();
    fine.dedup();
    let second = under(&fine.iter().map(|share| sign * share).collect::<Vec<_>>())?;
    let speeds: Vec<Estimate> = second.rows.iter().map(speed_of).collect();
    let sure = |estimate: &Estimate, sign: f64| sign * estimate.value > SIGNIFICANT * estimate.standard_error;
    let below = speeds.iter().rposition(|speed| sure(speed, sign)).unwrap_or(0);
    let above = speeds.iter().position(|speed| sure(speed, -sign));
    let found = |share: Estimate, bracket: [f64; 2]| StallLoad {
        torque: Estimate {
            value: sign * share.value * largest,
            standard_error: share.standard_error * largest,
        },
        share: sign * share.value,
        bracket: bracket.map(|share| sign * share * largest),
        no_load_speed: unloaded,
    };
    if above.is_none() && high > NEAREST {
        // No load that was tried surely drives it back, and beyond the largest torque each does. A motor that
        // still gains speed at the last load turns all the same.
        if let Operation::Unsettled(point, Shortfall::Drift { drift, .. }) = second.rows[below].operation()
            && sign * drift < 0.0
        {
            let Estimate { value: speed, standard_error } = point.speed;
            return Err(Error::NotSettled { speed, standard_error });
        }
        let bracket = [fine[below], 1.0];
        let [value, standard_error] = [0.5 * (bracket[0] + 1.0), (1.0 - bracket[0]) / EVEN];
        return Ok(found(Estimate { value, standard_error }, bracket));
    }
    let above = above.unwrap_or(fine.len() - 1);
    let (below, above) = (below.min(above.saturating_sub(1)), above.max(1));
    check_settled(&second.rows[below..=above])?;
    // Each member crosses zero for itself, on the straight line through its own speeds: they share their
    // perturbations.
    let members = second.speeds[below].len();
    let crossings: Vec<f64> = (0..members)
        .map(|member| crossing(&fine, |k| sign * second.speeds[k][member], (below, above)))
        .collect();
    let mut share = Estimate::of(&crossings)?;
    if above - below == 1 {
        let unresolved = unresolved(|k| speeds[k].value, speeds.len(), below) * (fine[above] - fine[below]);
        share.standard_error = hypot(share.standard_error, unresolved);
    }
    if share.value <= share.standard_error.max(LEAST) {
        return Err(Error::DoesNotTurn { speed: unloaded.value, standard_error: unloaded.standard_error });
    }
    Ok(found(share, [fine[below], fine[above]]))
}

/// The error of the straight line between two neighbouring loads, as a share of their distance: nearly zero
/// if the speeds beside them continue the line, that of a uniform distribution between them if a locked motor
/// jumps.
fn unresolved(value: impl Fn(usize) -> f64, loads: usize, below: usize) -> f64 {
    let bends = [below.checked_sub(1), Some(below)].into_iter().flatten().filter(|first| first + 2 < loads);
    let bend = bends.map(|first| (value(first) - 2.0 * value(first + 1) + value(first + 2)).abs());
    let jump = (value(below + 1) - value(below)).abs();
    (bend.fold(0.0, f64::max) / jump).min(1.0) / EVEN
}

/// The load between the shares of the largest torque at which speeds vanish that fall over them, and the
/// error of the straight line there; where they do not vanish, in the middle of what is left up to the
/// largest torque.
pub(crate) fn stall_share(shares: &[f64], speed: impl Fn(usize) -> f64) -> (f64, f64) {
    let above = (0..shares.len()).find(|&k| speed(k) <= 0.0);
    match above {
        Some(above @ 1..) => {
            let (from, to) = (shares[above - 1], shares[above]);
            let part = speed(above - 1) / (speed(above - 1) - speed(above));
            (from + part * (to - from), unresolved(&speed, shares.len(), above - 1) * (to - from))
        }
        _ => {
            let (end, limit) =
                if above.is_some() { (shares[0], -1.0) } else { (shares[shares.len() - 1], 1.0) };
            (0.5 * (end + limit), (limit - end).abs() / EVEN)
        }
    }
}

/// Refuses speeds that still drift: no standard error contains the remainder of a start-up, so that of a load
/// from such speeds would be too small.
fn check_settled(rows: &[OperatingRow]) -> Result<(), Error> {
    let drifting = rows.iter().find_map(|row| match row.operation() {
        Operation::Unsettled(point, Shortfall::Drift { .. }) => Some(point.speed),
        _ => None,
    });
    match drifting {
        Some(Estimate { value: speed, standard_error }) => Err(Error::NotSettled { speed, standard_error }),
        None => Ok(()),
    }
}

const NO_SPEED: Estimate = Estimate { value: 0.0, standard_error: f64::INFINITY };

/// The speed of a steady motor; no load here makes a motor run away.
fn speed_of(row: &OperatingRow) -> Estimate {
    row.point().map_or(NO_SPEED, |point| point.speed)
}

/// Where the least-squares line through the speeds at the shares from one index to another vanishes.
pub(crate) fn crossing(shares: &[f64], speed: impl Fn(usize) -> f64, (from, to): (usize, usize)) -> f64 {
    let count = (to - from + 1) as f64;
    let (mut x, mut y) = (0.0, 0.0);
    for (k, share) in shares.iter().enumerate().take(to + 1).skip(from) {
        x += share;
        y += speed(k);
    }
    let (x, y) = (x / count, y / count);
    let (mut square, mut product) = (0.0, 0.0);
    for (k, share) in shares.iter().enumerate().take(to + 1).skip(from) {
        square += (share - x) * (share - x);
        product += (share - x) * (speed(k) - y);
    }
    x - y * square / product
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_vanishes_where_it_does() {
        let shares = [0.1, 0.2, 0.3, 0.4, 0.5];
        let of = |k: usize| 3.0 - 10.0 * shares[k];
        assert!((crossing(&shares, of, (0, 4)) - 0.3).abs() < 1e-15);
        assert!((crossing(&shares, of, (3, 4)) - 0.3).abs() < 1e-14);
    }
}
