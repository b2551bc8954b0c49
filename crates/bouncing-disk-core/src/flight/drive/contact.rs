//! A disk in contact with a platform that moves in any way: when it leaves, and when a chatter brings it to
//! rest.

use core::f64::consts::TAU;

use super::{Drive, Fourier, Harmonic, Shape, turned};
use crate::numerics::elementary::wrapped_angle;
use crate::numerics::error::{Error, finite};
use crate::numerics::quasi_polynomial::{DampedSine, FirstRoot, QuasiPolynomial};

/// The end of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactEnd {
    /// How long the contact lasts, in radians.
    pub duration: f64,
    /// When it ends: in [0, 2 pi) unless the drive is a ramp.
    pub time: f64,
    /// How much the velocity of the platform jumps there: zero where the force falls to zero, negative where
    /// the platform leaves the disk behind, positive where it hits the disk.
    pub velocity_jump: f64,
}

/// How long a chatter lasts, from a launch to the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ChatterDuration {
    /// In radians, from the Taylor series of the acceleration at the launch.
    pub duration: f64,
    /// Bound on its error.
    pub error: f64,
}

impl Drive {
    /// The end of a contact that holds at `time`, within `limit` radians; `None` if it lasts for longer.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a time that is not finite; [`Error::NoConvergence`].
    pub fn contact_end(&self, time: f64, limit: f64) -> Result<Option<ContactEnd>, Error> {
        finite("time", time)?;
        let periodic = self.duration() == f64::INFINITY;
        let time = if periodic { wrapped_angle(time) } else { time };
        // What does not happen within a period never does.
        let limit = limit.min(if periodic { TAU } else { self.duration() - time });
        let found = match &self.shape {
            Shape::Fourier(fourier) => {
                fourier.separation(time, limit)?.map(|after| (after, time + after, 0.0))
            }
            Shape::Pieces(pieces) => pieces.contact_end(time, limit),
        };
        Ok(found.map(|(duration, time, velocity_jump)| {
            let time = if periodic { wrapped_angle(time) } else { time };
            ContactEnd { duration, time, velocity_jump }
        }))
    }

    /// The time from a launch at `time` with relative `speed` to the rest after infinitely many impacts, if a
    /// bound on the acceleration proves that the platform pulls the disk all the way there, and no kink hits
    /// it.
    ///
    /// With the pull A = 1 + s'' and its derivative B the sum of the flights is 2 w/(A (1 - r)) [1 - (2/3) B
    /// w/(A^2 (1 - r))] and more; with any pull between A1 and A2 a flight from w is back after 2 w/A2 to
    /// 2 w/A1 with a speed from w/q to w q, q = sqrt(A2/A1), which bounds the sum from both sides.
    #[must_use]
    pub fn chatter_duration(&self, time: f64, speed: f64, restitution: f64) -> Option<ChatterDuration> {
        let here = self.at(time);
        let pull = 1.0 + here.acceleration;
        if speed == 0.0 {
            return (pull > 0.0).then_some(ChatterDuration { duration: 0.0, error: 0.0 });
        }
        let lost = 1.0 - restitution;
        let first = 2.0 * speed / (pull * lost);
        if !(pull > 0.0 && first < 0.5) {
            return None;
        }
        let window = 2.0 * first;
        let (least, most) = self.pull_within(time, window)?;
        let ratio = (most / least).sqrt();
        if !(least > 0.0 && restitution * ratio < 1.0) {
            return None;
        }
        let longest = 2.0 * speed / (least * (1.0 - restitution * ratio));
        let shortest = 2.0 * speed / (most * (1.0 - restitution / ratio));
        if longest > window {
            return None;
        }
        let share = here.jerk * speed / (pull * pull * lost);
        let duration = (first * (1.0 - (2.0 / 3.0) * share)).clamp(shortest, longest);
        let error = (longest - duration).max(duration - shortest) + 4.0 * f64::EPSILON * duration;
        Some(ChatterDuration { duration, error })
    }

    /// The least and the largest pull 1 + s'' from `time` on for a `duration`; `None` if a kink is among them.
    fn pull_within(&self, time: f64, duration: f64) -> Option<(f64, f64)> {
        match &self.shape {
            Shape::Fourier(fourier) => {
                let pull = 1.0 + self.at(time).acceleration;
                let change =
                    fourier.bounds.jerk * duration + 8.0 * f64::EPSILON * fourier.bounds.acceleration;
                Some((pull - change, pull + change))
            }
            Shape::Pieces(pieces) => pieces.pull_within(wrapped_angle(time), duration),
        }
    }
}

impl Fourier {
    /// The time to the first fall of the contact force 1 + s'' through zero.
    fn separation(&self, time: f64, limit: f64) -> Result<Option<f64>, Error> {
        if self.bounds.acceleration <= 1.0 {
            return Ok(None);
        }
        let here = self.at(time);
        let pull = 1.0 + here.acceleration;
        if pull < 0.0 {
            return Ok(Some(0.0));
        }
        let mut terms = Vec::with_capacity(self.harmonics.len());
        for &Harmonic { number, amplitude, rate, angle } in &self.harmonics {
            let (sin, cos) = turned(number, time, angle);
            let (size, turn) = (number * number * (amplitude + rate * time), 2.0 * number * rate);
            terms.push(DampedSine::steady(turn * cos - size * sin, -turn * sin - size * cos, number));
            if rate != 0.0 {
                let slope = -number * number * rate;
                let steady = DampedSine::steady(slope * sin, slope * cos, number);
                terms.push(DampedSine { with_time: true, ..steady });
            }
        }
        let error = 8.0 * f64::EPSILON * self.bounds.acceleration;
        let jerk_error = 8.0 * f64::EPSILON * self.bounds.jerk;
        let force = QuasiPolynomial::known([pull, here.jerk], [error, jerk_error], [0.0; 2], terms);
        let mut from = 0.0;
        loop {
            match force.first_root(from, limit)? {
                FirstRoot::Root(root) => return Ok(Some(root.at)),
                FirstRoot::None { .. } => return Ok(None),
                // A force that touches zero presses on.
                FirstRoot::Undecided { until, .. } if until < limit => from = until,
                FirstRoot::Undecided { .. } => return Ok(None),
            }
        }
    }
}
