//! The load that stops a motor, with a bracket, and the motor's torque at rest.
//!
//! For slow rotors the two agree.
//!
//! The bracket extends from the last load at which the motor turns forwards to the first load at which it is
//! driven back, in both cases at more than three standard errors. Loads above 63/64 of mu m g a_e are not
//! tried, because speeds settle too slowly there; a motor that still turns under the last load stalls between
//! this load and mu m g a_e.

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::elementary::hypot;
use bouncing_disk_core::numerics::statistics::NORMAL_975;
use bouncing_disk_core::run::Watch;

use crate::error::Error;
use crate::motor::operation::loaded_motor::LoadedMotor;
use crate::motor::operation::point::{AxialMotion, Estimate, OperatingRow, Operation, Shortfall};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::steady_run::operate;

/// Steps of the load from zero to the largest mean torque of friction.
const STEPS: usize = 16;

/// Number of parts into which a search divides the steps left by the previous one, and largest number of
/// searches.
const PARTS: usize = 6;
const MOST_SEARCHES: u32 = 12;

/// Loads on either side of the torque at rest in the first search.
const NEIGHBOURS: i32 = 4;

/// Factor by which the first search is less accurate than requested, and the largest error of this search.
const COARSER: f64 = 4.0;
const COARSEST: f64 = 0.05;

/// The largest load tried, as a share of the largest torque: under larger loads, speeds settle too slowly.
const NEAREST: f64 = 1.0 - 1.0 / 64.0;

/// A stall load below this share of the largest torque counts as zero, because the ripple of the speed within
/// a period is as large. Steps need not be smaller than this either.
const LEAST: f64 = 1e-5;

/// The width of a uniform distribution divided by its standard deviation, the root of 12.
const EVEN: f64 = 3.464_101_615_137_754_5;

/// A speed differs from zero if it exceeds this number of its standard errors.
const SIGNIFICANT: f64 = 3.0;

/// The load torque at which the mean speed of a motor vanishes: the true stall, unlike the paper's
/// alpha_ss/t_c
/// ([`ExponentialFit::stall_acceleration`](crate::estimate::ExponentialFit::stall_acceleration)), which is an
/// estimate from the transient without load.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StallLoad {
    /// The vertical motion of the rotor.
    pub motion: AxialMotion,
    /// The stall torque (N m), with the sign of a load: a positive torque stops a positive rotation. Its
    /// error holds at exactly these inputs; [`Motor::stall_spread`](crate::Motor::stall_spread) computes the
    /// spread over their tolerances.
    pub torque: Estimate,
    /// The stall torque as a share of mu m g a_e, the largest mean torque of friction; in [-1, 1].
    pub share: f64,
    /// Two load torques (N m): under the first the motor keeps turning, under the second it is driven back,
    /// each at a speed more than three standard errors from zero. The second is mu m g a_e if no smaller load
    /// is certain to drive it back.
    pub bracket: [f64; 2],
    /// The mean torque (N m) on a rotor that is held at rest. A free rotor, whose speed swings about its
    /// mean, stops under a different load. `None` for a rotor that acts back on its stator.
    pub blocked_torque: Option<Estimate>,
    /// The mean speed without load (rad/s).
    pub no_load_speed: Estimate,
    /// The stall loads of coexisting motions.
    pub others: Vec<Self>,
}

/// The stall load of a motor, whatever the load of its data sheet.
pub(crate) fn stall_load(
    motor: &LoadedMotor<'_>,
    settings: &OperatingSettings,
    observer: &dyn Observer,
) -> Result<StallLoad, Error> {
    let survey = motor.survey(settings.seed, &Watch::begin(observer, 0, settings.most_impacts)?)?;
    let motor = &LoadedMotor { surveyed: survey.as_ref(), first_only: motor.stator.acts_back(), ..*motor };
    let unloaded = operate(&[motor.with_load(0.0)?], settings, observer)?;
    let unloaded = &unloaded.rows[0];
    check_settled(unloaded.operation())?;
    let speed = speed_of(unloaded.operation());
    if motor.largest_torque() > 0.0 && !motor.turns(speed) && motor.turns_by(NORMAL_975, speed) {
        // It seems to turn, but is not known well enough.
        return Err(Error::NotSettled { speed: speed.value, standard_error: speed.standard_error });
    }
    if !motor.turns(speed) || motor.largest_torque() <= 0.0 {
        return Err(Error::DoesNotTurn { speed: speed.value, standard_error: speed.standard_error });
    }
    let mut found = Search { motor, settings, observer, branch: 0 }.run(unloaded)?;
    // If rotors act back, the motions under one load differ from those under another.
    let branches = if motor.stator.acts_back() { 1 } else { unloaded.branches.len() };
    for branch in 1..branches {
        if motor.turns(speed_of(&unloaded.branches[branch])) {
            found.others.push(Search { motor, settings, observer, branch }.run(unloaded)?);
        }
    }
    Ok(found)
}

/// The search for the load under which a branch has no mean speed.
struct Search<'a> {
    motor: &'a LoadedMotor<'a>,
    settings: &'a OperatingSettings,
    observer: &'a dyn Observer,
    branch: usize,
}

impl Search<'_> {
    /// The operation of the branch in a row; the first operation if the row has no such branch.
    fn of<'a>(&self, row: &'a OperatingRow) -> &'a Operation {
        row.branches.get(self.branch).unwrap_or_else(|| row.operation())
    }

    /// The operations under loads with these shares of the largest torque.
    fn under(&self, shares: &[f64], settings: &OperatingSettings) -> Result<Vec<Operation>, Error> {
        let largest = self.motor.largest_torque();
        let motors: Vec<_> =
            shares.iter().map(|share| self.motor.with_load(share * largest)).collect::<Result<_, _>>()?;
        Ok(operate(&motors, settings, self.observer)?.rows.iter().map(|row| *self.of(row)).collect())
    }

    fn run(&self, unloaded: &OperatingRow) -> Result<StallLoad, Error> {
        let largest = self.motor.largest_torque();
        let point = self.of(unloaded).point();
        let no_load_speed = speed_of(self.of(unloaded));
        let sign = 1.0_f64.copysign(no_load_speed.value);
        let turns = |operation: &Operation| sign * speed_of(operation).value > 0.0;
        let braked = |shares: &[f64]| shares.iter().map(|share| sign * share).collect::<Vec<f64>>();

        let rough = (COARSER * self.settings.relative_error).min(COARSEST).max(self.settings.relative_error);
        let rough = OperatingSettings { relative_error: rough, ..*self.settings };
        let settings = self.motor.for_search(self.settings);
        // The torque on a rotor at rest is near the load that stops a free one, and equals it for a slow one.
        let mut step = 1.0 / STEPS as f64;
        let near = point.and_then(|point| point.blocked_torque).map(|torque| sign * torque.value / largest);
        let mut shares: Vec<f64> = match near {
            Some(near) => {
                step *= 0.5;
                let around =
                    (-NEIGHBOURS..=NEIGHBOURS).map(|k| (near + step * f64::from(k)).clamp(0.0, NEAREST));
                around.collect()
            }
            None => (1..STEPS).map(|k| k as f64 * step).collect(),
        };
        shares.dedup();
        let first = self.under(&braked(&shares), &self.motor.for_search(&rough))?;
        let last = first.iter().take_while(|operation| turns(operation)).count();
        let sure = |operation: &Operation, sign: f64| {
            let speed = speed_of(operation);
            sign * speed.value > SIGNIFICANT * speed.standard_error
        };
        if last == first.len() && shares[last - 1] >= NEAREST && sure(&first[last - 1], sign) {
            return self.beyond(&shares, &first, no_load_speed, unloaded);
        }
        let mut known: Vec<(f64, Operation)> = shares.iter().copied().zip(first).collect();
        let mut low = last.checked_sub(1).map_or((shares[0] - step).max(0.0), |last| shares[last]);
        let (mut operations, mut place);
        let mut searches = 0;
        let share = loop {
            searches += 1;
            // One more part on either side makes the bracket certain.
            let part = step / PARTS as f64;
            shares = (0..PARTS + 3)
                .map(|k| (low + part * (k as f64 - 1.0)).clamp(0.0, NEAREST))
                .collect::<Vec<_>>();
            shares.dedup();
            operations = self.under(&braked(&shares), &settings)?;
            known.extend(shares.iter().copied().zip(operations.iter().copied()));
            place = operations.iter().take_while(|operation| turns(operation)).count();
            if place == operations.len() {
                if shares[place - 1] >= NEAREST {
                    return self.beyond(&shares, &operations, no_load_speed, unloaded);
                }
                low = shares[place - 1];
                step = (2.0 * step).min(1.0 - low);
            } else if place == 0 {
                if shares[0] <= 0.0 {
                    break Estimate { value: 0.0, standard_error: shares[1] };
                }
                let high = shares[0];
                low = (high - 2.0 * step).max(0.0);
                step = high - low;
            } else {
                let (from, to) = (shares[place - 1], shares[place]);
                let [before, after] = [place - 1, place].map(|k| speed_of(&operations[k]));
                let fall = (before.value - after.value).abs();
                let part = before.value.abs() / fall;
                let value = from + part * (to - from);
                // The speeds share their perturbations, so all lines of a member move together.
                let error = (1.0 - part) * before.standard_error + part * after.standard_error;
                let known = error / fall * (to - from);
                let bend =
                    unresolved(|k| speed_of(&operations[k]).value, operations.len(), place - 1) * (to - from);
                let is_known = bend <= known.max(LEAST);
                if is_known || searches >= MOST_SEARCHES {
                    break Estimate { value, standard_error: hypot(known, bend) };
                }
                (low, step) = (from, to - from);
            }
            if searches >= MOST_SEARCHES {
                let Estimate { value: speed, standard_error } = speed_of(&operations[0]);
                return Err(Error::NotSettled { speed, standard_error });
            }
        };
        if share.value <= share.standard_error.max(LEAST) {
            let Estimate { value: speed, standard_error } = no_load_speed;
            return Err(Error::DoesNotTurn { speed, standard_error });
        }
        let is = |sign: f64| known.iter().filter(move |(_, one)| sure(one, sign)).map(|(share, _)| *share);
        let below = is(sign).filter(|at| *at < share.value).fold(0.0, f64::max);
        let above = is(-sign).filter(|at| *at > share.value).fold(1.0, f64::min);
        check_settled(&operations[place - 1])?;
        check_settled(&operations[place.min(operations.len() - 1)])?;
        Ok(StallLoad {
            motion: point.map_or(AxialMotion::Contact, |point| point.motion),
            torque: Estimate {
                value: sign * share.value * largest,
                standard_error: share.standard_error * largest,
            },
            share: sign * share.value,
            bracket: [below, above].map(|share| sign * share * largest),
            blocked_torque: point.and_then(|point| point.blocked_torque),
            no_load_speed,
            others: Vec::new(),
        })
    }

    /// The stall load if no load that was tried certainly drives the rotor back; every load beyond the
    /// largest torque does. A motor that still gains speed under the last load counts as turning.
    fn beyond(
        &self,
        shares: &[f64],
        operations: &[Operation],
        no_load_speed: Estimate,
        unloaded: &OperatingRow,
    ) -> Result<StallLoad, Error> {
        let (largest, sign) = (self.motor.largest_torque(), 1.0_f64.copysign(no_load_speed.value));
        let last = operations.len() - 1;
        if let Operation::Unsettled(point, Shortfall::Drift { drift, .. }) = &operations[last]
            && sign * drift < 0.0
        {
            let Estimate { value: speed, standard_error } = point.speed;
            return Err(Error::NotSettled { speed, standard_error });
        }
        let bracket = [shares[last], 1.0];
        let [value, standard_error] = [0.5 * (bracket[0] + 1.0), (1.0 - bracket[0]) / EVEN];
        let point = self.of(unloaded).point();
        Ok(StallLoad {
            motion: point.map_or(AxialMotion::Contact, |point| point.motion),
            torque: Estimate { value: sign * value * largest, standard_error: standard_error * largest },
            share: sign * value,
            bracket: bracket.map(|share| sign * share * largest),
            blocked_torque: point.and_then(|point| point.blocked_torque),
            no_load_speed,
            others: Vec::new(),
        })
    }
}

/// The error of the straight line between two neighbouring loads, as a share of their distance. This is
/// nearly zero if the neighbouring speeds continue the line, and the deviation of a uniform distribution
/// between the two loads if the speed of a locked motor jumps.
fn unresolved(value: impl Fn(usize) -> f64, loads: usize, below: usize) -> f64 {
    let bends = [below.checked_sub(1), Some(below)].into_iter().flatten().filter(|first| first + 2 < loads);
    let bend = bends.map(|first| (value(first) - 2.0 * value(first + 1) + value(first + 2)).abs());
    let jump = (value(below + 1) - value(below)).abs();
    (bend.fold(0.0, f64::max) / jump).min(1.0) / EVEN
}

/// The share of the largest torque at which the speed vanishes, between those `shares` at which it changes
/// sign, and the error of the straight line there. If the speed does not vanish, the middle of the remaining
/// range up to the largest torque.
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

/// Rejects a speed that still drifts: no standard error contains the remainder of a start-up, so the error of
/// a load found from such speeds would be too small.
fn check_settled(operation: &Operation) -> Result<(), Error> {
    match operation {
        Operation::Unsettled(point, Shortfall::Drift { .. }) => {
            let Estimate { value: speed, standard_error } = point.speed;
            Err(Error::NotSettled { speed, standard_error })
        }
        _ => Ok(()),
    }
}

const NO_SPEED: Estimate = Estimate { value: 0.0, standard_error: f64::INFINITY };

/// The speed of a steady motor; none of these loads makes a motor run away.
fn speed_of(operation: &Operation) -> Estimate {
    operation.point().map_or(NO_SPEED, |point| point.speed)
}
