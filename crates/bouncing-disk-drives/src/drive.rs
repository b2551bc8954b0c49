//! The motions of a platform: Fourier sums and pieces of polynomials.

use core::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

use bouncing_disk_core::numerics::elementary::{sin_cos, wrapped_angle};
use bouncing_disk_core::parts::{finite, within};
use bouncing_disk_core::{Error, Vibration};

use crate::drive::pieces::Pieces;
use crate::quasi_polynomial::{DampedSine, QuasiPolynomial};

pub(crate) mod contact;
mod extremes;
pub(crate) mod landing;
pub(crate) mod pieces;
mod spline;

pub use landing::{Doubt, DrivenImpact};
pub use pieces::MAX_PIECES;

/// Largest number of harmonics of a Fourier drive.
pub const MAX_HARMONICS: usize = 32;

/// Four roundoffs.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// The height of a platform (g/omega^2) over time, in radians of the drive's fundamental: one period is 2 pi.
///
/// At a kink, where the velocity jumps, the later piece applies. Clones share their data.
///
/// ```
/// use bouncing_disk_core::{Launch, Phase};
/// use bouncing_disk_drives::Drive;
///
/// // A sine with a third harmonic.
/// let drive = Drive::fourier(&[(1.4, 0.0), (0.0, 0.0), (0.1, 0.5)])?;
/// let impact = drive.first_impact(Launch::new(Phase::new(1.0)?, 3.0)?)?;
/// assert!(impact.impact.velocity < 0.0 && impact.error < 1e-13);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    shape: Shape,
}

#[derive(Debug, Clone, PartialEq)]
enum Shape {
    Fourier(Arc<Fourier>),
    Pieces(Arc<Pieces>),
}

/// Height, velocity, acceleration and third derivative of a platform at one time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DriveState {
    /// Height, in units of g/omega^2.
    pub height: f64,
    /// Velocity, in units of g/omega.
    pub velocity: f64,
    /// Acceleration, in units of g.
    pub acceleration: f64,
    /// The derivative of the acceleration.
    pub jerk: f64,
}

/// Bounds of a drive over all times.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DriveBounds {
    /// Lower bound on the height.
    pub lowest: f64,
    /// Upper bound on the height, at most 1e-4 of the sum of the amplitudes above the highest point.
    pub highest: f64,
    /// Bound on the speed.
    pub speed: f64,
    /// Bound on the acceleration.
    pub acceleration: f64,
    /// Bound on the derivative of the acceleration between kinks.
    pub jerk: f64,
}

/// A time ahead at which a drive changes, or the contact with it ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TimeAhead {
    /// The time until then, in radians.
    pub after: f64,
    /// The time of the drive, in [0, 2 pi).
    pub time: f64,
    /// The jump of the platform's velocity at this time, in units of g/omega: zero without a kink.
    pub velocity_jump: f64,
}

/// A harmonic: amplitude sin(number t + angle).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Harmonic {
    number: f64,
    amplitude: f64,
    angle: f64,
}

#[derive(Debug)]
pub(crate) struct Fourier {
    harmonics: Vec<Harmonic>,
    /// The bounds except for the height: [`Self::bounds`].
    bounds: DriveBounds,
    /// The bounds of the height, computed on first use because this takes far longer than everything else.
    heights: OnceLock<(f64, f64)>,
}

/// The harmonics determine everything else.
impl PartialEq for Fourier {
    fn eq(&self, other: &Self) -> bool {
        self.harmonics == other.harmonics
    }
}

impl Drive {
    /// The sum of a_j sin(j t + phi_j) over j = 1, 2, ... for these (a_j, phi_j), at most [`MAX_HARMONICS`].
    ///
    /// # Errors
    /// [`Error::TooLarge`] for too many harmonics; [`Error::NotOfKind`] names a harmonic whose numbers are
    /// not finite; [`Error::OutOfRange`] for accelerations beyond [`Vibration::MAX_PEAK_ACCELERATION`].
    pub fn fourier(harmonics: &[(f64, f64)]) -> Result<Self, Error> {
        let (count, limit) = (harmonics.len(), MAX_HARMONICS);
        if count > limit {
            return Err(Error::TooLarge { what: "harmonics", count: count as u64, limit: limit as u64 });
        }
        let mut kept = Vec::new();
        let (mut acceleration, mut jerk, mut speed) = (0.0, 0.0, 0.0);
        for (index, &(amplitude, angle)) in harmonics.iter().enumerate() {
            if !(amplitude.is_finite() && angle.is_finite()) {
                let expected = "finite in amplitude and angle";
                return Err(Error::NotOfKind { what: "harmonic", index, count, expected });
            }
            if amplitude == 0.0 {
                continue;
            }
            let number = (index + 1) as f64;
            let size = amplitude.abs();
            speed += size * number;
            acceleration += size * number * number;
            jerk += size * number * number * number;
            kept.push(Harmonic { number, amplitude, angle: wrapped_angle(angle) });
        }
        let most = Vibration::MAX_PEAK_ACCELERATION;
        within("acceleration of a drive", acceleration, 0.0, most, "[0, 1e8] (units of g)")?;
        let none = DriveBounds { lowest: 0.0, highest: 0.0, speed, acceleration, jerk };
        let fourier = Fourier { harmonics: kept, bounds: none, heights: OnceLock::new() };
        Ok(Self { shape: Shape::Fourier(Arc::new(fourier)) })
    }

    /// The same motion, advanced by `phase` (rad).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a phase that is not finite.
    pub fn earlier(&self, phase: f64) -> Result<Self, Error> {
        let phase = wrapped_angle(finite("phase", phase)?);
        match &self.shape {
            _ if phase == 0.0 => Ok(self.clone()),
            Shape::Fourier(fourier) => fourier.earlier(phase),
            Shape::Pieces(pieces) => pieces.earlier(phase),
        }
    }

    /// Height, velocity, acceleration and its derivative at this time, in closed form.
    ///
    /// Any finite time is reduced to a period.
    #[must_use]
    pub fn at(&self, time: f64) -> DriveState {
        let time = wrapped_angle(time);
        match &self.shape {
            Shape::Fourier(fourier) => fourier.at(time),
            Shape::Pieces(pieces) => pieces.at(time),
        }
    }

    /// [`Self::at`], and the terms of `factor` times the derivative of this order (at most 2) from there on,
    /// if the drive is a sum of sines.
    pub(crate) fn at_with_terms(&self, time: f64, order: u32, factor: f64) -> (DriveState, Vec<DampedSine>) {
        let time = wrapped_angle(time);
        match &self.shape {
            Shape::Fourier(fourier) => fourier.at_with_terms(time, order, factor),
            Shape::Pieces(pieces) => (pieces.at(time), Vec::new()),
        }
    }

    /// The derivative of this order (0 to 2; 0 is the height) from `time` on, as a function of the time
    /// elapsed; valid up to the next joint.
    #[must_use]
    pub fn derivative(&self, order: u32, time: f64) -> QuasiPolynomial {
        let bounds = self.bounds();
        let height = bounds.highest.abs().max(bounds.lowest.abs());
        let errors =
            [height, bounds.speed, bounds.acceleration, bounds.jerk].map(|size| 8.0 * f64::EPSILON * size);
        self.derivative_known_to(errors, order, time)
    }

    /// [`Self::derivative`] with these errors of height, velocity, acceleration and jerk.
    fn derivative_known_to(&self, errors: [f64; 4], order: u32, time: f64) -> QuasiPolynomial {
        let order = order.min(2);
        let (at, terms) = self.at_with_terms(time, order, 1.0);
        let values = [at.height, at.velocity, at.acceleration, at.jerk, 0.0, 0.0];
        let k = order as usize;
        let bend = match &self.shape {
            Shape::Fourier(_) => [0.0; 2],
            Shape::Pieces(_) => [0.5 * values[k + 2], values[k + 3] * (1.0 / 6.0)],
        };
        QuasiPolynomial::known([values[k], values[k + 1]], [errors[k], errors[k + 1]], bend, terms)
    }

    /// The velocity from `time` on, like [`Self::derivative`]; for a Fourier sum, as the sum of its terms.
    #[must_use]
    pub fn velocity_as_sum(&self, time: f64) -> QuasiPolynomial {
        let velocity = self.derivative(1, time);
        match self.shape {
            Shape::Fourier(_) => velocity.summed_with(0.0),
            Shape::Pieces(_) => velocity,
        }
    }

    /// The change of the velocity over a `span` >= 0 from `time`, without kinks; and the change of the height
    /// minus the initial velocity times the span. Both keep their relative accuracy over a short span.
    #[must_use]
    pub fn change(&self, time: f64, span: f64) -> (f64, f64) {
        if span >= TAU && self.next_joint(time).is_some() {
            // Each period adds the same change to both.
            let periods = libm::floor(span / TAU);
            let (velocity, height) = self.change_within(time, TAU);
            let (more, lift) = self.change_within(time, span - periods * TAU);
            let before = periods * velocity;
            let ramp = TAU * velocity * 0.5 * periods * (periods - 1.0);
            return (before + more, periods * height + ramp + (span - periods * TAU) * before + lift);
        }
        self.change_within(time, span)
    }

    fn change_within(&self, time: f64, span: f64) -> (f64, f64) {
        let (mut here, mut left, mut velocity, mut height) = (time, span, 0.0, 0.0);
        while left > 0.0 {
            let joint = self.next_joint(here);
            let step = joint.map_or(left, |joint| joint.after.min(left));
            let motion = self.derivative_known_to([0.0; 4], 0, here);
            let change = motion.starting_with([0.0; 2], [0.0; 2]).at(step, step);
            height += step * velocity + change.value;
            velocity += change.slope;
            left -= step;
            here = joint.map_or(here, |joint| joint.time);
        }
        (velocity, height)
    }

    /// Height at this time, in units of g/omega^2.
    #[must_use]
    pub fn height(&self, time: f64) -> f64 {
        self.at(time).height
    }

    /// Velocity at this time, in units of g/omega; at a kink, the later piece's velocity.
    #[must_use]
    pub fn velocity(&self, time: f64) -> f64 {
        self.at(time).velocity
    }

    /// Velocity just before this time, in units of g/omega: at a kink, the earlier piece's velocity.
    #[must_use]
    pub fn velocity_before(&self, time: f64) -> f64 {
        self.velocity(time) - self.velocity_jump(time)
    }

    /// The jump of the velocity at this time, in units of g/omega.
    #[must_use]
    pub fn velocity_jump(&self, time: f64) -> f64 {
        self.as_pieces().map_or(0.0, |pieces| pieces.velocity_jump(wrapped_angle(time)))
    }

    /// Acceleration at this time, in units of g.
    #[must_use]
    pub fn acceleration(&self, time: f64) -> f64 {
        self.at(time).acceleration
    }

    /// The height that the platform does not exceed, in units of g/omega^2.
    #[must_use]
    pub fn max_height(&self) -> f64 {
        self.bounds().highest
    }

    /// Bounds over all times.
    #[must_use]
    pub fn bounds(&self) -> DriveBounds {
        match &self.shape {
            Shape::Fourier(fourier) => fourier.bounds(),
            Shape::Pieces(pieces) => pieces.bounds,
        }
    }

    /// The number of the highest harmonic; 1 if there is none.
    #[must_use]
    pub fn highest_harmonic(&self) -> f64 {
        match &self.shape {
            Shape::Fourier(fourier) => fourier.highest_harmonic(),
            Shape::Pieces(_) => 1.0,
        }
    }

    /// The times in [0, 2 pi) at which the velocity jumps, and the jumps.
    pub fn kinks(&self) -> impl Iterator<Item = (f64, f64)> {
        self.as_pieces().map_or(&[][..], Pieces::kinks).iter().copied()
    }

    /// The next kink after `time`.
    #[must_use]
    pub fn next_kink(&self, time: f64) -> Option<TimeAhead> {
        self.as_pieces()?.next_kink(wrapped_angle(time))
    }

    /// The next joint of two pieces after `time`; `None` for a Fourier sum.
    #[must_use]
    pub fn next_joint(&self, time: f64) -> Option<TimeAhead> {
        self.as_pieces().map(|pieces| pieces.next_joint(wrapped_angle(time)))
    }

    /// This drive as a sine with closed forms, if it is one.
    #[must_use]
    pub fn as_vibration(&self) -> Option<Vibration> {
        let Shape::Fourier(fourier) = &self.shape else { return None };
        match fourier.harmonics[..] {
            [Harmonic { number: 1.0, amplitude, angle: 0.0 }] => Vibration::new(amplitude).ok(),
            _ => None,
        }
    }

    /// The Fourier sum in which the amplitude of each harmonic is multiplied, and its phase advanced, by the
    /// two values of `response` at its number.
    pub(crate) fn responding(&self, response: impl Fn(f64) -> (f64, f64)) -> Result<Self, Error> {
        let mut sum = [(0.0, 0.0); MAX_HARMONICS];
        if let Shape::Fourier(fourier) = &self.shape {
            for &Harmonic { number, amplitude, angle } in &fourier.harmonics {
                let (gain, ahead) = response(number);
                sum[number as usize - 1] = (amplitude * gain, angle + ahead);
            }
        }
        Self::fourier(&sum)
    }

    fn as_pieces(&self) -> Option<&Pieces> {
        match &self.shape {
            Shape::Fourier(_) => None,
            Shape::Pieces(pieces) => Some(pieces),
        }
    }
}

impl From<Vibration> for Drive {
    /// The sine as a Fourier sum.
    fn from(vibration: Vibration) -> Self {
        Self::fourier(&[(vibration.peak_acceleration(), 0.0)]).expect("a legal vibration")
    }
}

/// Sine and cosine of number times time + angle, for a whole number up to 32, compensated for the rounding of
/// product and sum.
fn turned(number: f64, time: f64, angle: f64) -> (f64, f64) {
    // With 47 bits the product is exact.
    let head = f64::from_bits(time.to_bits() & !0x3f);
    let product = number * head;
    let sum = product + angle;
    let back = sum - product;
    let lost = ((product - (sum - back)) + (angle - back)) + number * (time - head);
    let (sin, cos) = sin_cos(sum);
    (sin + lost * cos, cos - lost * sin)
}

impl Harmonic {
    /// Adds the harmonic at this time; returns its sine and cosine.
    fn add(&self, time: f64, state: &mut DriveState) -> (f64, f64) {
        let &Self { number, amplitude, angle } = self;
        let (sin, cos) = turned(number, time, angle);
        state.height += amplitude * sin;
        state.velocity += amplitude * number * cos;
        state.acceleration -= number * (amplitude * number * sin);
        state.jerk -= number * number * (amplitude * number * cos);
        (sin, cos)
    }

    /// Adds `factor` times the derivative of this order, given the harmonic's sine and cosine.
    fn add_terms(&self, (sin, cos): (f64, f64), (order, factor): (u32, f64), terms: &mut Vec<DampedSine>) {
        let &Self { number, amplitude, .. } = self;
        // The derivative, as coefficients of cosine and sine.
        let (mut own, mut power) = ([sin, cos], factor);
        for _ in 0..order {
            own = [own[1], -own[0]];
            power *= number;
        }
        let [cosine, sine] = own.map(|x| power * amplitude * x);
        terms.push(DampedSine::steady(cosine, sine, number));
    }
}

impl Fourier {
    fn earlier(&self, phase: f64) -> Result<Drive, Error> {
        let mut sum = [(0.0, 0.0); MAX_HARMONICS];
        for &Harmonic { number, amplitude, angle } in &self.harmonics {
            sum[number as usize - 1] = (amplitude, angle + number * phase);
        }
        Drive::fourier(&sum)
    }

    fn at(&self, time: f64) -> DriveState {
        let mut state = DriveState::default();
        for harmonic in &self.harmonics {
            harmonic.add(time, &mut state);
        }
        state
    }

    /// [`Drive::at_with_terms`].
    fn at_with_terms(&self, time: f64, order: u32, factor: f64) -> (DriveState, Vec<DampedSine>) {
        let mut state = DriveState::default();
        let mut terms = Vec::with_capacity(self.harmonics.len());
        for harmonic in &self.harmonics {
            let turned = harmonic.add(time, &mut state);
            harmonic.add_terms(turned, (order, factor), &mut terms);
        }
        (state, terms)
    }

    fn highest_harmonic(&self) -> f64 {
        self.harmonics.iter().fold(1.0, |most, harmonic| harmonic.number.max(most))
    }

    fn bounds(&self) -> DriveBounds {
        let &(lowest, highest) = self.heights.get_or_init(|| self.height_bounds());
        DriveBounds { lowest, highest, ..self.bounds }
    }

    /// Bounds on the height: between two samples a distance d apart the height differs from their chord by at
    /// most max|s''| d^2/8.
    fn height_bounds(&self) -> (f64, f64) {
        let count = 512.0 * self.highest_harmonic();
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut k = 0.0;
        while k < count {
            let height = self.at(k * (TAU / count)).height;
            (low, high) = (low.min(height), high.max(height));
            k += 1.0;
        }
        let spacing = TAU / count * (1.0 + 1.0e-9);
        let slack = self.bounds.acceleration * (spacing * spacing * 0.125 + 1.0e-14);
        (low - slack, high + slack)
    }
}
