//! One hand motion, and the objective of the tosses that it gives.

use std::f64::consts::PI;

use crate::error::Error;
use crate::parameters::disk::DiskParameters;
use crate::parameters::platform::Platform;
use crate::parameters::stroke::Stroke;
use crate::parameters::system::System;
use crate::toss::design::constraints::{OverFriction, TossConstraints, TossObjective};
use crate::toss::single::{InitialSpin, TossPerformance, single_toss};

/// Coefficients of friction at which the objective is evaluated over a range: odd, so that the middle is one
/// of them.
const FRICTIONS: usize = 5;

/// The parameters that a hand can choose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hand {
    pub(super) angular_frequency: f64,
    pub(super) phase_lag: f64,
    pub(super) amplitude_angle: f64,
}

impl Hand {
    pub(super) const fn stroke(self, constraints: &TossConstraints) -> Stroke {
        Stroke {
            stroke: constraints.stroke,
            amplitude_angle: self.amplitude_angle,
            contact_radius: constraints.dough.contact_radius,
            angular_frequency: self.angular_frequency,
            phase_lag: self.phase_lag,
        }
    }
}

/// The dough on a hand, with this friction.
pub(super) fn system(hand: Stroke, dough: DiskParameters, friction: f64) -> Result<System, Error> {
    let disk = DiskParameters { friction, ..dough }.build()?;
    System::new(Platform::from_stroke(hand)?, disk)
}

/// The middle of a range of friction.
pub(super) const fn middle([least, most]: [f64; 2]) -> f64 {
    // Halves first: the sum of two huge numbers is infinite.
    0.5 * least + 0.5 * most
}

/// The toss of a hand motion with a friction; `None` if the dough never leaves.
pub(super) fn toss(
    hand: Stroke,
    dough: DiskParameters,
    friction: f64,
    initial: InitialSpin,
) -> Result<Option<TossPerformance>, Error> {
    match single_toss(&system(hand, dough, friction)?, initial) {
        Ok(toss) => Ok(Some(toss)),
        Err(Error::NeverLeaves { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}

/// The objective of one toss, with the direction of rotation that counts as forwards.
pub(super) fn of_toss(objective: TossObjective, toss: &TossPerformance, forwards: f64, gravity: f64) -> f64 {
    match objective {
        TossObjective::AirborneSpeed => forwards * toss.airborne_speed,
        TossObjective::Efficiency => toss.efficiency,
        TossObjective::TurnsPerToss => (forwards * toss.airborne_speed).signum() * turns(toss, gravity),
    }
}

/// The objective over a range of friction; for a dough that never leaves it is zero. Forwards is the
/// direction in which the dough turns at the middle of the range: a friction that turns it the other way
/// counts against the hand motion.
pub(super) fn over_frictions(
    constraints: &TossConstraints,
    hand: Stroke,
    dough: DiskParameters,
    frictions: usize,
    mut each: impl FnMut(f64, f64),
) -> Result<(f64, Option<TossPerformance>), Error> {
    let [least, most] = constraints.friction;
    let count = if least < most { frictions } else { 1 };
    let at = |friction: f64| toss(hand, dough, friction, constraints.initial);
    let Some(middle) = at(crate::toss::design::hand::middle([least, most]))? else { return Ok((0.0, None)) };
    let forwards = 1.0_f64.copysign(middle.airborne_speed);
    let gravity = dough.preload_acceleration;
    let of = |toss: &TossPerformance| of_toss(constraints.objective, toss, forwards, gravity);
    if count == 1 {
        each(least, of(&middle));
        return Ok((of(&middle), Some(middle)));
    }
    let (mut worst, mut sum) = (f64::INFINITY, 0.0);
    for index in 0..count {
        let friction = least + (most - least) * index as f64 / (count - 1) as f64;
        let value = if 2 * index == count - 1 { of(&middle) } else { at(friction)?.as_ref().map_or(0.0, of) };
        // Simpson's rule: the number of intervals is even.
        let weight = match index {
            0 => 1.0,
            end if end == count - 1 => 1.0,
            odd if odd % 2 == 1 => 4.0,
            _ => 2.0,
        };
        each(friction, value);
        worst = worst.min(value);
        sum += weight * value;
    }
    let value = match constraints.over_friction {
        OverFriction::Worst => worst,
        OverFriction::Mean => sum / (3.0 * (count - 1) as f64),
    };
    Ok((value, Some(middle)))
}

/// The objective without the toss.
pub(super) fn value_of(
    constraints: &TossConstraints,
    hand: Stroke,
    dough: DiskParameters,
) -> Result<f64, Error> {
    Ok(over_frictions(constraints, hand, dough, FRICTIONS, |_, _| ())?.0)
}

/// A hand motion that leaves the dough in the air.
#[derive(Debug)]
pub(super) struct Evaluation {
    pub(super) value: f64,
    /// The toss at the middle of the range of friction.
    pub(super) middle: TossPerformance,
}

impl Evaluation {
    pub(super) fn new(constraints: &TossConstraints, hand: Hand) -> Result<Self, Error> {
        let stroke = hand.stroke(constraints);
        let (value, middle) = over_frictions(constraints, stroke, constraints.dough, FRICTIONS, |_, _| ())?;
        let peak_acceleration = constraints.stroke * hand.angular_frequency * hand.angular_frequency
            / constraints.dough.preload_acceleration;
        middle.map(|middle| Self { value, middle }).ok_or(Error::NeverLeaves { peak_acceleration })
    }
}

/// How high the dough rises above the place where it leaves (m).
pub(crate) fn flight_height(toss: &TossPerformance, gravity: f64) -> f64 {
    0.5 * toss.launch_speed * toss.launch_speed / gravity
}

/// Turns until it is back there.
pub(crate) fn turns(toss: &TossPerformance, gravity: f64) -> f64 {
    toss.airborne_speed.abs() * toss.launch_speed / (PI * gravity)
}
