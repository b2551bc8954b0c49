//! A contact that takes time: a linear spring and damper between disk and platform, whose force is never
//! negative.
//!
//! With the gap y = x - s (negative in contact) the disk moves by
//!
//! ```text
//! x'' = -1 + F,   F = max(0, -k y - c y')  while y <= 0,   F = 0 while y > 0.
//! ```
//!
//! Between two events all is polynomials and damped sines, and the events are their first roots
//! (docs/numerics/contacts.md). The platform is a Fourier sum.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::drive::Drive;
use super::drive::landing::{DrivenImpact, decided};
use super::first_impact::MAX_FLIGHT_DURATION;
use super::launch::Launch;
use super::platform::phase::Phase;
use super::platform::vibration::Vibration;
use crate::numerics::elementary::{atan2, exp, exp_m1, hypot, ln, ln_1p, nearest_whole, sin_cos, tan};
use crate::numerics::error::{Error, finite, within};
use crate::numerics::quasi_polynomial::{DampedSine, QuasiPolynomial};
use crate::numerics::roots::bisection;

/// Damping this near to the critical one counts as critical: the restitution differs by less than a rounding.
const CRITICAL: f64 = 1.0e-8;

/// A transient that has decayed to this share of the force is rounding.
const SETTLED: f64 = 1.0e-18;

/// Stiffness and damping of a contact: in units of m omega^2 and m omega.
///
/// ```
/// use bouncing_disk_core::flight::Compliance;
///
/// // Half of a period of the drive, restitution 0.5.
/// let contact = Compliance::new(0.5 * std::f64::consts::TAU, 0.5)?;
/// assert!((contact.restitution() - 0.5).abs() < 1e-12);
/// assert!((contact.contact_time() - 0.5 * std::f64::consts::TAU).abs() < 1e-12);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Compliance {
    stiffness: f64,
    damping: f64,
}

impl Compliance {
    /// The contact in which an isolated impact without weight lasts for `contact_time` (rad), until the force
    /// falls to zero, and has this restitution.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a contact time outside [1e-6, 1e4] rad, or a restitution outside [0.001, 1).
    pub fn new(contact_time: f64, restitution: f64) -> Result<Self, Error> {
        within("contact time", contact_time, 1.0e-6, 1.0e4, "[1e-6, 1e4] (rad of the drive)")?;
        let most = 1.0_f64.next_down();
        within("restitution of a contact that takes time", restitution, 0.001, most, "[0.001, 1)")?;
        // Damping ratio cos u, or cosh u beyond the critical one: the restitution is exp(-2 u cot u), or
        // exp(-2 u coth u).
        let lost = -0.5 * ln(restitution);
        let (over, angle) = if lost < 1.0 {
            (false, bisection(0.0, FRAC_PI_2, 80, |u| Ok::<_, Error>(u / tan(u) > lost))?)
        } else {
            (true, bisection(0.0, 10.0, 80, |u| Ok::<_, Error>(u / hyperbolic(u).tangent < lost))?)
        };
        if angle < CRITICAL {
            let frequency = 2.0 / contact_time;
            return Ok(Self { stiffness: frequency * frequency, damping: 2.0 * frequency });
        }
        let (sine, cosine) = if over {
            let Hyperbolic { sine, cosine, .. } = hyperbolic(angle);
            (sine, cosine)
        } else {
            sin_cos(angle)
        };
        let frequency = 2.0 * angle / (sine * contact_time);
        Ok(Self { stiffness: frequency * frequency, damping: 2.0 * cosine * frequency })
    }

    /// The stiffness k, in units of m omega^2: the indentation under the weight is its inverse.
    #[must_use]
    pub const fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// The damping c, in units of m omega.
    #[must_use]
    pub const fn damping(&self) -> f64 {
        self.damping
    }

    /// What an isolated impact without weight keeps of its speed when the force has fallen to zero.
    #[must_use]
    pub fn restitution(&self) -> f64 {
        // The damping ratio cos u times the frequency times the contact time is 2 u cot u.
        exp(-0.5 * self.damping * self.contact_time())
    }

    /// How long an isolated impact without weight lasts until the force has fallen to zero (rad).
    #[must_use]
    pub fn contact_time(&self) -> f64 {
        let frequency = self.stiffness.sqrt();
        let ratio = 0.5 * self.damping / frequency;
        let square = (1.0 - ratio) * (1.0 + ratio);
        let sine = square.abs().sqrt();
        let angle = if square >= 0.0 {
            atan2(sine, ratio)
        } else {
            ln_1p(sine + (ratio - 1.0))
        };
        let share = if sine < CRITICAL { 1.0 } else { angle / sine };
        2.0 * share / frequency
    }

    /// The response of the force to the acceleration of one harmonic of the platform: x'' = H s''.
    fn response(&self, number: f64) -> Complex {
        let (k, d) = (self.stiffness, self.damping * number);
        Complex(k, d).over(Complex(k - number * number, d))
    }

    /// h0 and h1 as value and slope of a free oscillation.
    fn free(&self, value: f64, slope: f64) -> [DampedSine; 2] {
        let frequency = self.stiffness.sqrt();
        let decay = 0.5 * self.damping;
        let square = (frequency - decay) * (frequency + decay);
        let omega = square.abs().sqrt();
        let own = |cosine, sine, frequency, decay, with_time| DampedSine {
            cosine,
            sine,
            frequency,
            decay,
            with_time,
        };
        if omega <= CRITICAL * frequency {
            [
                own(value, 0.0, 0.0, decay, false),
                own(slope + decay * value, 0.0, 0.0, decay, true),
            ]
        } else if square > 0.0 {
            [
                own(value, (slope + decay * value) / omega, omega, decay, false),
                own(0.0, 0.0, 0.0, decay, false),
            ]
        } else {
            let fast = decay + omega;
            let slow = self.stiffness / fast;
            let share = 1.0 / (fast - slow);
            [
                own((slope + fast * value) * share, 0.0, 0.0, slow, false),
                own(-(slope + slow * value) * share, 0.0, 0.0, fast, false),
            ]
        }
    }

    /// The slower rate of decay of a free oscillation.
    fn slow_decay(&self) -> f64 {
        let decay = 0.5 * self.damping;
        let square = decay * decay - self.stiffness;
        if square > 0.0 { self.stiffness / (decay + square.sqrt()) } else { decay }
    }
}

/// A disk near a compliant platform: its time, gap (negative in contact) and velocity relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RelativeState {
    /// Time of the drive, in [0, 2 pi).
    pub time: f64,
    /// Disk minus platform, in units of g/omega^2.
    pub gap: f64,
    /// Its derivative, in units of g/omega.
    pub velocity: f64,
}

/// A platform with a [`Compliance`] between it and the disk.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantPlatform {
    drive: Drive,
    /// The same motion where it is the sine of the closed forms.
    sine: Option<Vibration>,
    compliance: Compliance,
}

/// The end of a flight towards a compliant platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// How long the disk has flown (rad).
    pub duration: f64,
    /// How often the phase has passed 0.
    pub turns: u64,
    /// The disk then: with no gap, or in the air with a gap below zero where the force sets in again before
    /// the spring is free.
    pub state: RelativeState,
}

/// How a contact ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactEnd {
    /// The force falls to zero after this time (rad).
    Release(f64),
    /// It never does: after this time (rad) what is left of the start is rounding, and the disk follows the
    /// platform by its [steady response](CompliantPlatform::steady).
    Settles(f64),
}

impl CompliantPlatform {
    /// This drive with this contact.
    ///
    /// # Errors
    /// [`Error::NotOfKind`] for a drive that is no periodic Fourier sum.
    pub fn new(drive: Drive, compliance: Compliance) -> Result<Self, Error> {
        if !drive.is_periodic() || drive.next_joint(0.0).is_some() {
            let expected = "a periodic Fourier sum: a contact that takes time has no other drive";
            return Err(Error::NotOfKind { what: "drive", index: 0, count: 1, expected });
        }
        let sine = drive.as_vibration();
        Ok(Self { drive, sine, compliance })
    }

    /// The drive.
    #[must_use]
    pub const fn drive(&self) -> &Drive {
        &self.drive
    }

    /// The contact.
    #[must_use]
    pub const fn compliance(&self) -> &Compliance {
        &self.compliance
    }

    /// The height of a disk that never leaves the platform, but for its indentation under the weight.
    ///
    /// # Errors
    /// Those of [`Drive::fourier`].
    pub fn steady(&self) -> Result<Drive, Error> {
        self.drive.responding(|number| {
            let Complex(re, im) = self.compliance.response(number);
            (hypot(re, im), atan2(im, re))
        })
    }

    /// The disk at `time` with the indentation that carries it there.
    #[must_use]
    pub fn resting(&self, time: f64) -> RelativeState {
        let load = (1.0 + self.drive.acceleration(time)).max(0.0);
        RelativeState { time, gap: -load / self.compliance.stiffness, velocity: 0.0 }
    }

    /// The fastest rate of change in contact (rad^-1).
    #[must_use]
    pub fn rate(&self) -> f64 {
        let Compliance { stiffness, damping } = self.compliance;
        self.drive.highest_harmonic().max(stiffness.sqrt()).max(damping)
    }

    /// The force of a contact in this state, were it not cut off at zero.
    #[must_use]
    pub fn force(&self, state: RelativeState) -> f64 {
        let Compliance { stiffness, damping } = self.compliance;
        -(stiffness * state.gap + damping * state.velocity)
    }

    /// The next touch of a disk that feels no force, if it comes within `limit` (rad).
    ///
    /// # Errors
    /// Those of [`Drive::first_impact_within`].
    pub fn touch(&self, from: RelativeState, limit: f64) -> Result<Option<Touch>, Error> {
        let at = |duration: f64, gap: f64, velocity: f64| {
            let angle = from.time + duration;
            let time = self.drive.reduced(angle);
            let turns = nearest_whole((angle - time) / TAU) as u64;
            Touch { duration, turns, state: RelativeState { time, gap, velocity } }
        };
        let landed = |landing: DrivenImpact| {
            let impact = &landing.impact;
            Touch {
                duration: impact.duration(),
                turns: impact.turns,
                state: RelativeState {
                    time: impact.phase.angle(),
                    gap: 0.0,
                    velocity: impact.velocity.min(0.0),
                },
            }
        };
        let RelativeState { time, gap, velocity } = from;
        if gap > 0.0 || gap == 0.0 && velocity > 0.0 {
            if let (Some(sine), true) = (&self.sine, gap == 0.0) {
                let impact = sine.first_impact(Launch::new(Phase::of_angle(time), velocity)?)?;
                let touch = landed(DrivenImpact { impact, error: 0.0, on_kink: false, doubt: None });
                return Ok((touch.duration <= limit).then_some(touch));
            }
            return Ok(self.drive.first_impact_within(time, gap, velocity, limit)?.map(landed));
        }
        if gap == 0.0 {
            if velocity < 0.0 || self.drive.holds(time) {
                return Ok(Some(at(0.0, 0.0, velocity)));
            }
            return Ok(self.drive.impact_after_separation_within(time, limit)?.map(landed));
        }
        // The spring is not free yet: it is when the gap closes from below, or presses before.
        let height = self.free_gap(from);
        let Compliance { stiffness, damping } = self.compliance;
        let slope = -1.0 - self.drive.acceleration(time);
        let pull = self.force(from).min(0.0);
        let to = limit.min(2.0 * MAX_FLIGHT_DURATION);
        let presses = height
            .clone()
            .with_its_slope(stiffness, damping)
            .starting_with([-pull, stiffness * velocity + damping * slope], [0.0; 2]);
        let pressed = decided(&presses, to)?.root.map_or(f64::INFINITY, |root| root.at);
        let freed = decided(&(height.clone() * -1.0), to.min(pressed))?.root;
        if let Some(freed) = freed {
            let there = at(freed.at, 0.0, height.at(freed.at, freed.at).slope.max(0.0));
            let then = self.touch(there.state, limit - freed.at)?;
            return Ok(then.map(|then| Touch {
                duration: then.duration + freed.at,
                turns: then.turns + there.turns,
                ..then
            }));
        }
        Ok((pressed <= to).then(|| {
            let jet = height.at(pressed, pressed);
            // No force acts there yet.
            at(pressed, -damping / stiffness * jet.slope, jet.slope)
        }))
    }

    /// The gap of a disk that feels no force.
    fn free_gap(&self, from: RelativeState) -> QuasiPolynomial {
        let bent = self.drive.derivative(0, from.time) * -1.0;
        bent.bent_by(-1.0).starting_with([from.gap, from.velocity], [0.0; 2])
    }

    /// A disk in contact from this state on.
    #[must_use]
    pub fn press(&self, from: RelativeState) -> Pressed {
        let Compliance { stiffness, damping } = self.compliance;
        let (here, harmonics) = self.drive.at_with_terms(from.time, 2, 1.0);
        let rounding = 8.0 * f64::EPSILON;
        let force = match self.force(from) {
            // A force that sets in again starts from zero.
            force if force.abs() <= rounding * stiffness * from.gap.abs() => 0.0,
            force => force,
        };
        let mut slope = -(stiffness * from.velocity + damping * (force - 1.0 - here.acceleration));
        if from.gap == 0.0 && from.velocity == 0.0 {
            // A disk that is put down does not leave by a rounding.
            slope = slope.max(0.0);
        }
        let (mut value, mut rate, mut steady) = (force - 1.0, slope, 0.0);
        let mut terms = Vec::with_capacity(harmonics.len() + 2);
        for harmonic in harmonics {
            let Complex(re, im) = self.compliance.response(harmonic.frequency);
            let (c, s) = (harmonic.cosine, harmonic.sine);
            let (cosine, sine) = (re * c + im * s, re * s - im * c);
            value -= cosine;
            rate -= harmonic.frequency * sine;
            steady += hypot(cosine, sine);
            terms.push(DampedSine::steady(cosine, sine, harmonic.frequency));
        }
        let free = self.compliance.free(value, rate);
        let transient = free.iter().map(|term| hypot(term.cosine, term.sine)).sum();
        terms.extend(free.into_iter().filter(|term| term.cosine != 0.0 || term.sine != 0.0));
        let errors = [
            if from.gap == 0.0 || force == 0.0 { 0.0 } else { rounding * stiffness * from.gap.abs() },
            rounding
                * (stiffness * from.velocity.abs() + damping * (force.abs() + 1.0 + here.acceleration.abs())),
        ];
        Pressed {
            from,
            platform: self.clone(),
            force: QuasiPolynomial::known([force, slope], errors, [0.0; 2], terms),
            velocity: here.velocity + from.velocity,
            steady,
            transient,
        }
    }
}

/// The motion of a disk in contact with a compliant platform, from a state on, in closed form.
#[derive(Debug, Clone, PartialEq)]
pub struct Pressed {
    from: RelativeState,
    platform: CompliantPlatform,
    force: QuasiPolynomial,
    /// Of the disk, at the start.
    velocity: f64,
    /// Bound on the oscillation of the force that stays, and on that which decays.
    steady: f64,
    transient: f64,
}

impl Pressed {
    /// The force over the time since the start, in units of the weight, up to the end of the contact.
    #[must_use]
    pub const fn force(&self) -> &QuasiPolynomial {
        &self.force
    }

    /// The velocity of the disk less that at the start, over the time since then.
    #[must_use]
    pub fn velocity_change(&self) -> QuasiPolynomial {
        (self.force.clone() + -1.0).integral(0.0)
    }

    /// The height of the disk less that at the start, and less the velocity there times the time since then.
    #[must_use]
    pub fn lift(&self) -> QuasiPolynomial {
        self.velocity_change().integral(0.0)
    }

    /// The disk after `span` (rad).
    #[must_use]
    pub fn after(&self, span: f64) -> RelativeState {
        let (gained, lifted) = (self.velocity_change().at(span, span).value, self.lift().at(span, span).value);
        let (driven, raised) = self.platform.drive.change(self.from.time, span);
        RelativeState {
            time: self.platform.drive.reduced(self.from.time + span),
            gap: self.from.gap + span * self.from.velocity + (lifted - raised),
            velocity: self.from.velocity + (gained - driven),
        }
    }

    /// The disk at the [release](ContactEnd::Release): without a force.
    #[must_use]
    pub fn released(&self, span: f64) -> RelativeState {
        let state = self.after(span);
        let velocity = state.velocity.max(0.0);
        let Compliance { stiffness, damping } = self.platform.compliance;
        RelativeState { gap: -damping / stiffness * velocity, velocity, ..state }
    }

    /// The platform.
    #[must_use]
    pub const fn platform(&self) -> &CompliantPlatform {
        &self.platform
    }

    /// The fastest rate of change (rad^-1).
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.platform.rate()
    }

    /// Its state at the start.
    #[must_use]
    pub const fn from(&self) -> RelativeState {
        self.from
    }

    /// The end of the contact, if it comes within `limit` (rad).
    ///
    /// # Errors
    /// [`Error::NoConvergence`] for a force that stays next to zero over more oscillations than can be searched.
    pub fn end(&self, limit: f64) -> Result<Option<ContactEnd>, Error> {
        finite("start of a contact", self.from.time)?;
        let start = self.force.at(0.0, 0.0);
        if start.value < -start.error || start.value <= 0.0 && start.slope < 0.0 {
            return Ok(Some(ContactEnd::Release(0.0)));
        }
        let decay = self.platform.compliance.slow_decay();
        let spare = 1.0 - self.steady;
        // When the transient is smaller than what the steady force keeps, or than a rounding.
        let until = |left: f64| ln((self.transient / left).max(1.0)) / decay;
        let settled = until(SETTLED * (1.0 + self.steady));
        let search = if spare > 0.0 { until(spare).min(settled) } else { settled + TAU };
        if search > 0.0
            && let Some(root) = decided(&self.force, search.min(limit))?.root
        {
            return Ok(Some(ContactEnd::Release(root.at)));
        }
        Ok((settled.max(search) <= limit).then_some(ContactEnd::Settles(settled.max(search))))
    }
}

struct Hyperbolic {
    sine: f64,
    cosine: f64,
    tangent: f64,
}

fn hyperbolic(x: f64) -> Hyperbolic {
    let grown = exp_m1(x);
    let sine = 0.5 * (grown + grown / (grown + 1.0));
    let cosine = 0.5 * ((grown + 1.0) + 1.0 / (grown + 1.0));
    Hyperbolic { sine, cosine, tangent: sine / cosine }
}

#[derive(Debug, Clone, Copy)]
struct Complex(f64, f64);

impl Complex {
    fn over(self, other: Self) -> Self {
        let size = other.0 * other.0 + other.1 * other.1;
        Self((self.0 * other.0 + self.1 * other.1) / size, (self.1 * other.0 - self.0 * other.1) / size)
    }
}
