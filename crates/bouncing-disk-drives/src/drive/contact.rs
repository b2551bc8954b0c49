//! A disk in contact with a platform of arbitrary motion: when the disk leaves, and when chattering brings it
//! to rest.
//!
//! Contact and flight are computed with different rounding errors. If the flight from the end of a contact
//! ended at once, the disk would rest at the same time, leave again, and alternate for ever. That can happen
//! if the force falls to zero within its rounding error e = 1e-12 (1 + max|s''|) + 4 u (2 pi + t) max|s'''|
//! and rises again. So the force ends a contact only if it certainly falls below -e. This is certain if the
//! force is already below -e, or if it falls at a rate c > sqrt(2 e M), where M bounds s'''', and hence by at
//! least c^2/(2 M) > e. On pieces it is also certain if the force at the end of the piece is below -e. The
//! flight then lasts for at least 4 c/M, far longer than the rounding of the time. In a shallower dip the
//! contact continues until the force falls through -2 e.

use core::f64::consts::TAU;

use bouncing_disk_core::Error;
use bouncing_disk_core::chatter::ChatterDuration;
use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::parts::{Surface, finite};

use super::{Drive, DriveBounds, ROUNDING, Shape, TimeAhead};
use crate::quasi_polynomial::{FirstRoot, QuasiPolynomial};

/// A pull below this share of its terms may be rounding error.
const DOUBTFUL_PULL: f64 = 1.0e-12;

impl Drive {
    /// The end of a contact that exists at `time`, within `limit` radians; `None` if the contact lasts
    /// longer. The velocity jump at the end is zero if the force falls to zero, negative if the platform
    /// leaves the disk behind, and positive if it hits the disk.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a time that is not finite; [`Error::NoConvergence`].
    pub fn contact_end(&self, time: f64, limit: f64) -> Result<Option<TimeAhead>, Error> {
        finite("time", time)?;
        let time = wrapped_angle(time);
        // A contact that lasts for a period never ends.
        let limit = limit.min(TAU);
        let end = match &self.shape {
            Shape::Fourier(_) => self.separation(time, limit)?,
            Shape::Pieces(pieces) => pieces.contact_end(time, limit),
        };
        Ok(end.map(|end| TimeAhead { time: wrapped_angle(end.time), ..end }))
    }

    /// Whether a disk that rests on the platform at `time` stays there: the force presses on it, or is zero
    /// to within rounding and does not fall.
    #[must_use]
    pub fn holds(&self, time: f64) -> bool {
        self.acceleration(time) >= -1.0 || !self.leaves(time)
    }

    /// Whether the force is, or will be, below zero by more than its rounding error. The flight then lasts
    /// longer than the rounding of the time, so contact and flight cannot alternate at one instant.
    fn leaves(&self, time: f64) -> bool {
        let time = wrapped_angle(time);
        match &self.shape {
            Shape::Fourier(fourier) => {
                let (at, doubt) = (fourier.at(time), fourier.bounds.doubtful_pull(time));
                // A force that falls this steeply gets this low, whatever its second derivative.
                let bend = fourier.highest_harmonic() * fourier.bounds.jerk;
                1.0 + at.acceleration < -doubt || at.jerk < -(2.0 * doubt * bend).sqrt()
            }
            Shape::Pieces(pieces) => pieces.leaves(time),
        }
    }

    /// The end of a contact with a Fourier sum, at which the force falls to zero.
    fn separation(&self, time: f64, limit: f64) -> Result<Option<TimeAhead>, Error> {
        if self.bounds().acceleration <= 1.0 {
            return Ok(None);
        }
        let force = self.derivative(2, time) + 1.0;
        let end = match force.at(0.0, 0.0).value {
            value if value >= 0.0 => first_fall(&force, 0.0, limit)?,
            _ => Some(0.0),
        };
        let end = match end {
            // A force that passes through zero by no more than a rounding keeps pressing.
            Some(after) if !self.leaves(time + after) => {
                first_fall(&(force + 2.0 * self.bounds().doubtful_pull(time)), after, limit)?
            }
            end => end,
        };
        Ok(end.map(|after| TimeAhead { after, time: time + after, velocity_jump: 0.0 }))
    }

    /// The time from a launch at `time` with relative `speed` to the rest after infinitely many impacts,
    /// provided that a bound on the acceleration proves that the pull stays positive until then, and that there is
    /// no kink before.
    ///
    /// For a launch at w, with the pull A = 1 + s'' and its derivative B, the sum of the flights is 2 w/(A (1 -
    /// r)) [1 - (2/3) B w/(A^2 (1 - r))] plus higher terms. If the pull is between A1 and A2, a flight
    /// launched at w returns after 2 w/A2 to 2 w/A1 with a speed from w/q to w q, q = sqrt(A2/A1). This
    /// bounds the sum from both sides.
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

    /// The least and the largest pull 1 + s'' from `time` on for a `duration`; `None` if there is a kink.
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

impl Surface for Drive {
    fn holds(&self, time: f64) -> bool {
        self.holds(time)
    }

    fn chatter_duration(&self, time: f64, speed: f64, restitution: f64) -> Option<ChatterDuration> {
        self.chatter_duration(time, speed, restitution)
    }
}

impl DriveBounds {
    /// The value below which a pull may be due to the rounding of its terms or of the time.
    pub(crate) fn doubtful_pull(&self, time: f64) -> f64 {
        DOUBTFUL_PULL * (1.0 + self.acceleration) + ROUNDING * (TAU + time.abs()) * self.jerk
    }
}

/// The first fall through zero after `from` of a function that may also touch zero.
fn first_fall(function: &QuasiPolynomial, mut from: f64, limit: f64) -> Result<Option<f64>, Error> {
    loop {
        match function.first_root(from, limit)? {
            FirstRoot::Root(root) => return Ok(Some(root.at)),
            FirstRoot::Undecided { until, .. } if until < limit => from = until,
            FirstRoot::Undecided { .. } | FirstRoot::None { .. } => return Ok(None),
        }
    }
}
