//! Compliant contact: a linear spring and damper between disk and platform, whose force is never negative.
//!
//! With the gap y = x - s (negative in contact) the disk moves by
//!
//! ```text
//! x'' = -1 + F,   F = max(0, -k y - c y')  while y <= 0,   F = 0 while y > 0.
//! ```
//!
//! A second law has no damper, but a spring that unloads at a lower stiffness than it loads, and does not
//! move in between. Results on which both laws agree do not depend on the law of damping.
//!
//! Between two events the motion is a sum of polynomials and damped sines, and the events are first roots of
//! such sums (docs/numerics-dynamics.md). The platform is a Fourier sum.

use core::f64::consts::{E, FRAC_PI_2, TAU};

use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_core::numerics::elementary::{
    atan2, exp, exp_m1, hypot, ln, ln_1p, nearest_whole, sin_cos, tan, wrapped_angle,
};
use bouncing_disk_core::numerics::roots::bisection;
use bouncing_disk_core::parts::{finite, within};
use bouncing_disk_core::{Error, Launch, Phase, Vibration};

use crate::drive::Drive;
use crate::drive::landing::{DrivenImpact, decided};
use crate::quasi_polynomial::{DampedSine, QuasiPolynomial};

/// Distance from critical damping below which damping counts as critical: the restitution then differs by
/// less than its rounding error.
const CRITICAL: f64 = 1.0e-8;

/// Share of the loads by which a load must exceed the limit to move a spring at rest: a load at the limit to
/// within rounding does not move it.
const EDGE: f64 = 128.0 * f64::EPSILON;

/// Relative difference below which two rates count as close: the difference of their exponentials is then
/// computed as an integral over the rates between them. The rule below evaluates this integral to rounding
/// until the motion has become negligible.
const NEAR: f64 = 3.0e-2;

/// Nodes and weights of the Gauss-Legendre rule of four points on [-1, 1]; the weights add up to 1.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.173_927_422_568_726_93),
    (-0.339_981_043_584_856_26, 0.326_072_577_431_273_07),
    (0.339_981_043_584_856_26, 0.326_072_577_431_273_07),
    (0.861_136_311_594_052_6, 0.173_927_422_568_726_93),
];

/// Speed (units of g/omega) above which a rising disk may fly through more oscillations of the platform than
/// can be searched one by one.
const FAST: f64 = 1.0e5;

/// Share of the force below which a transient counts as rounding error.
const SETTLED: f64 = 1.0e-18;

/// Stiffness and damping of a contact, in units of m omega^2 and m omega.
///
/// ```
/// use bouncing_disk_drives::compliance::Compliance;
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
    /// The stiffness of the unloading spring.
    unloading: f64,
}

/// The state of the spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum SpringState {
    /// The spring loads; a spring with a damper is always in this state.
    Loading,
    /// The spring unloads at its lower stiffness.
    Unloading,
    /// The spring does not move, because the load is between the unloading and the loading force.
    Held,
}

impl Compliance {
    /// Least and largest restitution of a compliant contact. Closer to 1, too many digits would be lost at a
    /// resonance, where free and forced oscillations 1/(1 - e) times as large as the platform's cancel.
    pub const RESTITUTIONS: [f64; 2] = [0.001, 1.0 - 1.0e-6];

    /// Least and largest contact time (rad).
    pub const CONTACT_TIMES: [f64; 2] = [1.0e-6, 1.0e4];

    /// The contact in which an isolated impact, neglecting the disk's weight, has this restitution and lasts
    /// for `contact_time` (rad) until the force falls to zero.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a contact time outside [1e-6, 1e4] rad, or a restitution outside
    /// [0.001, 1 - 1e-6].
    pub fn new(contact_time: f64, restitution: f64) -> Result<Self, Error> {
        let ([least, most], legal) = (Self::CONTACT_TIMES, "[1e-6, 1e4] (rad of the drive)");
        within("contact time", contact_time, least, most, legal)?;
        let ([least, most], legal) = (Self::RESTITUTIONS, "[0.001, 1 - 1e-6]");
        within("restitution of a compliant contact", restitution, least, most, legal)?;
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
            return Ok(Self::viscous(frequency, 2.0 * frequency));
        }
        let (sine, cosine) = if over {
            let Hyperbolic { sine, cosine, .. } = hyperbolic(angle);
            (sine, cosine)
        } else {
            sin_cos(angle)
        };
        let frequency = 2.0 * angle / (sine * contact_time);
        Ok(Self::viscous(frequency, 2.0 * cosine * frequency))
    }

    const fn viscous(frequency: f64, damping: f64) -> Self {
        let stiffness = frequency * frequency;
        Self { stiffness, damping, unloading: stiffness }
    }

    /// The contact without a damper whose spring unloads at the loading stiffness times the square of the
    /// restitution.
    ///
    /// # Errors
    /// Errors of [`Self::new`].
    pub fn hysteretic(contact_time: f64, restitution: f64) -> Result<Self, Error> {
        Self::new(contact_time, restitution)?;
        let frequency = FRAC_PI_2 * (1.0 + 1.0 / restitution) / contact_time;
        let stiffness = frequency * frequency;
        Ok(Self { stiffness, damping: 0.0, unloading: restitution * restitution * stiffness })
    }

    /// The stiffness k, in units of m omega^2; the indentation under the weight is its inverse.
    #[must_use]
    pub const fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// The stiffness while the spring unloads.
    #[must_use]
    pub const fn unloading_stiffness(&self) -> f64 {
        self.unloading
    }

    /// The damping c, in units of m omega.
    #[must_use]
    pub const fn damping(&self) -> f64 {
        self.damping
    }

    /// The ratio of the speeds at the end and the start of an isolated impact, which ends when the force has
    /// fallen to zero; the disk's weight is neglected.
    #[must_use]
    pub fn restitution(&self) -> f64 {
        if self.is_hysteretic() {
            return (self.unloading / self.stiffness).sqrt();
        }
        // The damping ratio cos u times the frequency times the contact time is 2 u cot u.
        exp(-0.5 * self.damping * self.contact_time())
    }

    /// The duration (rad) of an isolated impact until the force has fallen to zero; the disk's weight is
    /// neglected.
    #[must_use]
    pub fn contact_time(&self) -> f64 {
        let frequency = self.stiffness.sqrt();
        if self.is_hysteretic() {
            return FRAC_PI_2 * (1.0 / frequency + 1.0 / self.unloading.sqrt());
        }
        let ratio = 0.5 * self.damping / frequency;
        let square = (1.0 - ratio) * (1.0 + ratio);
        let sine = square.abs().sqrt();
        let angle = if square >= 0.0 { atan2(sine, ratio) } else { ln_1p(sine + (ratio - 1.0)) };
        let share = if sine < CRITICAL { 1.0 } else { angle / sine };
        2.0 * share / frequency
    }

    /// The same spring and damper on a recoiling platform, for which the effective mass of an impact is this
    /// share of the disk's mass. Contact time and restitution then describe an isolated impact on that
    /// platform.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a share outside (0, 1].
    pub fn with_reduced_mass(self, share: f64) -> Result<Self, Error> {
        within("reduced mass", share, f64::MIN_POSITIVE, 1.0, "(0, 1] (of the disk's mass)")?;
        let Self { stiffness, damping, unloading } = self;
        Ok(Self { stiffness: stiffness / share, damping: damping / share, unloading: unloading / share })
    }

    const fn is_hysteretic(&self) -> bool {
        self.damping == 0.0
    }

    /// The spring and damper on a branch.
    pub(crate) const fn on(&self, branch: SpringState) -> Self {
        match branch {
            SpringState::Unloading => Self { stiffness: self.unloading, ..*self },
            SpringState::Loading | SpringState::Held => *self,
        }
    }

    /// The response of the force to the acceleration of one harmonic of the platform: x'' = H s''.
    fn response(&self, number: f64) -> Complex {
        let (k, d) = (self.stiffness, self.damping * number);
        Complex(k, d).over(Complex(k - number * number, d))
    }

    /// A free oscillation from this value and slope.
    pub(crate) fn free(&self, value: f64, slope: f64) -> Vec<DampedSine> {
        let frequency = self.stiffness.sqrt();
        let decay = 0.5 * self.damping;
        let square = (frequency - decay) * (frequency + decay);
        let omega = square.abs().sqrt();
        let own = |cosine, decay, with_time| DampedSine {
            with_time,
            decay,
            ..DampedSine::steady(cosine, 0.0, 0.0)
        };
        let rise = slope + decay * value;
        let fast = decay + omega;
        let slow = self.stiffness / fast;
        if omega <= CRITICAL * frequency {
            vec![own(value, decay, false), own(rise, decay, true)]
        } else if omega < NEAR * frequency {
            let between = GAUSS.map(|(node, weight)| {
                if square < 0.0 {
                    return own(weight * rise, decay + omega * node, true);
                }
                DampedSine { frequency: omega * node.abs(), ..own(weight * rise, decay, true) }
            });
            let mut terms = between.to_vec();
            if square < 0.0 {
                terms.extend([slow, fast].map(|decay| own(0.5 * value, decay, false)));
            } else {
                terms.push(DampedSine { frequency: omega, ..own(value, decay, false) });
            }
            terms
        } else if square > 0.0 {
            vec![DampedSine { decay, ..DampedSine::steady(value, rise / omega, omega) }]
        } else {
            let share = 1.0 / (fast - slow);
            vec![
                own((slope + fast * value) * share, slow, false),
                own(-(slope + slow * value) * share, fast, false),
            ]
        }
    }

    /// The force of an undamped spring that starts from zero value and slope, driven by a harmonic near its
    /// resonance.
    fn resonance(&self, harmonic: &DampedSine) -> Vec<DampedSine> {
        let (own, driven) = (self.stiffness.sqrt(), harmonic.frequency);
        let (half, middle) = (0.5 * (own - driven), 0.5 * (own + driven));
        let size = 0.5 * self.stiffness / middle;
        let mut terms = GAUSS
            .map(|(node, weight)| {
                let (cosine, sine) = (-size * weight * harmonic.sine, size * weight * harmonic.cosine);
                DampedSine { with_time: true, ..DampedSine::steady(cosine, sine, middle + half * node) }
            })
            .to_vec();
        terms.push(DampedSine::steady(0.0, size * harmonic.sine / own, own));
        terms
    }

    /// The slower decay rate of a free oscillation.
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
    /// The derivative of the gap, in units of g/omega.
    pub velocity: f64,
}

/// A platform with a [`Compliance`] between it and the disk.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantPlatform {
    drive: Drive,
    /// The same motion, if it is a sine with closed forms.
    sine: Option<Vibration>,
    compliance: Compliance,
}

/// The end of a flight towards a compliant platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The duration of the flight (rad).
    pub duration: f64,
    /// The number of times the phase has passed 0.
    pub turns: u64,
    /// The state of the disk then: with zero gap, or with a negative gap if the force returns before the
    /// spring is free.
    pub state: RelativeState,
}

/// The end of a contact, or its next change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactEnd {
    /// The force falls to zero after this time (rad).
    Release(f64),
    /// The force never falls to zero: after this time (rad) the transient is below rounding, and the disk
    /// follows the platform with its [steady response](CompliantPlatform::steady).
    Settles(f64),
    /// The contact continues, but after this time (rad) its spring is in another state.
    Turns(f64, SpringState),
}

impl CompliantPlatform {
    /// This drive with this contact.
    ///
    /// # Errors
    /// [`Error::NotOfKind`] for a drive that is not a periodic Fourier sum.
    pub fn new(drive: Drive, compliance: Compliance) -> Result<Self, Error> {
        if drive.next_joint(0.0).is_some() {
            let expected = "a sine or a sum of harmonics (fourier), which a compliant contact needs";
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

    /// The height of a disk that never leaves the platform, without its indentation under the weight.
    ///
    /// # Errors
    /// Errors of [`Drive::fourier`].
    pub fn steady(&self) -> Result<Drive, Error> {
        if self.compliance.is_hysteretic() {
            return Ok(self.drive.clone());
        }
        self.drive.responding(|number| {
            let Complex(re, im) = self.compliance.response(number);
            (hypot(re, im), atan2(im, re))
        })
    }

    /// The disk at `time` with the indentation that supports it at this moment.
    #[must_use]
    pub fn resting(&self, time: f64) -> RelativeState {
        let load = (1.0 + self.drive.acceleration(time)).max(0.0);
        let Compliance { stiffness, unloading, .. } = self.compliance;
        RelativeState { time, gap: -load / (stiffness * unloading).sqrt(), velocity: 0.0 }
    }

    /// The force of a contact in this state, without the cut-off at zero.
    #[must_use]
    pub fn force(&self, state: RelativeState) -> f64 {
        self.force_on(self.spring_state(state), state)
    }

    pub(crate) fn force_on(&self, branch: SpringState, state: RelativeState) -> f64 {
        let Compliance { stiffness, damping, .. } = self.compliance.on(branch);
        if branch == SpringState::Held {
            return 1.0 + self.drive.acceleration(state.time);
        }
        -(stiffness * state.gap + damping * state.velocity)
    }

    /// The energy that the spring returns from this gap, per mass, in units of (g/omega)^2.
    #[must_use]
    pub fn spring_energy(&self, gap: f64) -> f64 {
        let indentation = gap.min(0.0);
        0.5 * self.compliance.unloading * indentation * indentation
    }

    /// The state of the spring for this state of the disk.
    #[must_use]
    pub fn spring_state(&self, state: RelativeState) -> SpringState {
        let load = || 1.0 + self.drive.acceleration(state.time);
        let spare = || self.spare(state.gap);
        if !self.compliance.is_hysteretic() || state.velocity < 0.0 {
            SpringState::Loading
        } else if state.velocity > 0.0 || load() < -self.compliance.unloading * state.gap - spare() {
            SpringState::Unloading
        } else if load() > -self.compliance.stiffness * state.gap + spare() {
            SpringState::Loading
        } else {
            SpringState::Held
        }
    }

    /// The excess of the load over the force that is needed to move a disk at rest. For a disk that lies on
    /// the platform without a force, this exceeds the rounding that [`Drive::holds`] allows for.
    fn spare(&self, gap: f64) -> f64 {
        let bounds = self.drive.bounds();
        if gap == 0.0 {
            return 2.0 * bounds.doubtful_pull(TAU);
        }
        EDGE * (1.0 + bounds.acceleration + self.compliance.stiffness * gap.abs())
    }

    /// The next touch of a disk in free flight, if it comes within `limit` (rad).
    ///
    /// # Errors
    /// Errors of [`Drive::first_impact_within`].
    pub fn touch(&self, from: RelativeState, limit: f64) -> Result<Option<Touch>, Error> {
        let at = |duration: f64, gap: f64, velocity: f64| {
            let angle = from.time + duration;
            let time = wrapped_angle(angle);
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
        // The spring is not free yet: it will be when the gap closes from below, unless it presses earlier.
        let height = self.free_gap(from);
        let Compliance { stiffness, damping, .. } = self.compliance;
        let slope = -1.0 - self.drive.acceleration(time);
        let pull = self.force(from).min(0.0);
        let to = limit.min(2.0 * MAX_FLIGHT_DURATION);
        let rise = stiffness * velocity + damping * slope;
        let presses =
            height.clone().with_its_slope(stiffness, damping).starting_with([-pull, rise], [0.0; 2]);
        if pull == 0.0 && (rise < 0.0 || rise == 0.0 && presses.at(0.0, 0.0).bend < 0.0) {
            return Ok(Some(at(0.0, gap, velocity)));
        }
        let frees = |to: f64| decided(&(height.clone() * -1.0), to).map(|found| found.root);
        let presses =
            |to: f64| decided(&presses, to).map(|found| found.root.map_or(f64::INFINITY, |root| root.at));
        let (freed, pressed) = match self.time_above(from) {
            // It is free before this time, and only until then can the spring press.
            Some(above) => {
                let freed = frees(to.min(above))?;
                let pressed = presses(freed.map_or(to.min(above), |freed| freed.at))?;
                (freed.filter(|freed| freed.at <= pressed), pressed)
            }
            None => {
                let pressed = presses(to)?;
                (frees(to.min(pressed))?, pressed)
            }
        };
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

    /// The time at which a fast disk in free flight reaches its highest point, if this is above the whole
    /// platform.
    fn time_above(&self, from: RelativeState) -> Option<f64> {
        let speed = self.drive.velocity(from.time) + from.velocity;
        let depth = self.drive.bounds().highest - (self.drive.height(from.time) + from.gap);
        (speed > FAST && 0.5 * speed * speed > 2.0 * depth).then_some(speed)
    }

    /// The gap of a disk in free flight.
    fn free_gap(&self, from: RelativeState) -> QuasiPolynomial {
        let bent = self.drive.derivative(0, from.time) * -1.0;
        bent.bent_by(-1.0).starting_with([from.gap, from.velocity], [0.0; 2])
    }

    /// The motion of a disk in contact, starting from this state.
    #[must_use]
    pub fn press(&self, from: RelativeState) -> Pressed {
        self.press_on(self.spring_state(from), from)
    }

    /// The motion of a disk in contact, starting from this state, with the spring in the state `branch`.
    #[must_use]
    pub fn press_on(&self, branch: SpringState, from: RelativeState) -> Pressed {
        let (here, harmonics) = self.drive.at_with_terms(from.time, 2, 1.0);
        if branch == SpringState::Held {
            return Pressed {
                from: RelativeState { velocity: 0.0, ..from },
                branch,
                platform: self.clone(),
                force: self.drive.derivative(2, from.time).summed_with(0.0) + 1.0,
                steady: 0.0,
                transient: 0.0,
                fading: 0.0,
            };
        }
        let spring = self.compliance.on(branch);
        let Compliance { stiffness, damping, .. } = spring;
        let rounding = 8.0 * f64::EPSILON;
        let force = match self.force_on(branch, from) {
            // A force that sets in again starts from zero.
            force if force.abs() <= rounding * stiffness * from.gap.abs() => 0.0,
            force => force,
        };
        let mut slope = -(stiffness * from.velocity + damping * (force - 1.0 - here.acceleration));
        if from.gap == 0.0 && from.velocity == 0.0 && self.drive.holds(from.time) {
            // Rounding must not make a disk leave that is placed on the platform.
            slope = slope.max(0.0);
        }
        let (mut value, mut rate, mut steady) = (force - 1.0, slope, 0.0);
        let mut terms = Vec::with_capacity(harmonics.len() + 2);
        for harmonic in harmonics {
            let near = (harmonic.frequency - spring.stiffness.sqrt()).abs() < NEAR * harmonic.frequency;
            if near && spring.is_hysteretic() {
                terms.extend(spring.resonance(&harmonic));
                continue;
            }
            let Complex(re, im) = spring.response(harmonic.frequency);
            let (c, s) = (harmonic.cosine, harmonic.sine);
            let (cosine, sine) = (re * c + im * s, re * s - im * c);
            value -= cosine;
            rate -= harmonic.frequency * sine;
            steady += hypot(cosine, sine);
            terms.push(DampedSine::steady(cosine, sine, harmonic.frequency));
        }
        let free = spring.free(value, rate);
        let slow = spring.slow_decay();
        // t exp(-d t) is below 2/(e d) exp(-d t/2).
        let grows = free.iter().any(|term| term.with_time);
        let transient = free
            .iter()
            .map(|term| hypot(term.cosine, term.sine) * if term.with_time { 2.0 / (E * slow) } else { 1.0 })
            .sum();
        terms.extend(free.into_iter().filter(|term| term.cosine != 0.0 || term.sine != 0.0));
        let errors = [
            if from.gap == 0.0 || force == 0.0 { 0.0 } else { rounding * stiffness * from.gap.abs() },
            rounding
                * (stiffness * from.velocity.abs() + damping * (force.abs() + 1.0 + here.acceleration.abs())),
        ];
        Pressed {
            from,
            branch,
            platform: self.clone(),
            force: QuasiPolynomial::known([force, slope], errors, [0.0; 2], terms).summed_with(1.0),
            steady,
            transient,
            fading: if grows { 0.5 * slow } else { slow },
        }
    }
}

/// The motion of a disk in contact with a compliant platform, in closed form from an initial state.
#[derive(Debug, Clone, PartialEq)]
pub struct Pressed {
    from: RelativeState,
    branch: SpringState,
    platform: CompliantPlatform,
    force: QuasiPolynomial,
    /// Bound on the steady oscillation of the force, and on the decaying one.
    steady: f64,
    transient: f64,
    /// The rate of this decay.
    fading: f64,
}

impl Pressed {
    /// The force over the time since the start, in units of the weight, up to the end of the contact.
    #[must_use]
    pub const fn force(&self) -> &QuasiPolynomial {
        &self.force
    }

    /// The change of the disk's velocity since the start, over time.
    #[must_use]
    pub fn velocity_change(&self) -> QuasiPolynomial {
        (self.force.clone() + -1.0).integral(0.0)
    }

    /// The change of the disk's height since the start, minus the initial velocity times the time.
    #[must_use]
    pub fn lift(&self) -> QuasiPolynomial {
        self.velocity_change().integral(0.0)
    }

    /// The disk after `span` (rad).
    #[must_use]
    pub fn after(&self, span: f64) -> RelativeState {
        let (gained, lifted) =
            (self.velocity_change().at(span, span).value, self.lift().at(span, span).value);
        let (driven, raised) = self.platform.drive.change(self.from.time, span);
        RelativeState {
            time: wrapped_angle(self.from.time + span),
            gap: self.from.gap + span * self.from.velocity + (lifted - raised),
            velocity: self.from.velocity + (gained - driven),
        }
    }

    /// The disk at the [release](ContactEnd::Release), with zero force.
    #[must_use]
    pub fn released(&self, span: f64) -> RelativeState {
        let state = self.after(span);
        let velocity = state.velocity.max(0.0);
        let Compliance { stiffness, damping, .. } = self.platform.compliance;
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
        let Compliance { stiffness, damping, .. } = self.platform.compliance.on(self.branch);
        self.platform.drive.highest_harmonic().max(stiffness.sqrt()).max(damping)
    }

    /// The state of the spring.
    #[must_use]
    pub const fn spring_state(&self) -> SpringState {
        self.branch
    }

    /// The disk's state at the start.
    #[must_use]
    pub const fn from(&self) -> &RelativeState {
        &self.from
    }

    /// Whether the disk lies on the platform, which supports it to within rounding: it cannot leave at once.
    fn is_put_down(&self) -> bool {
        let RelativeState { time, gap, velocity } = self.from;
        gap == 0.0 && velocity == 0.0 && self.platform.drive.holds(time)
    }

    /// The end of the contact, if it comes within `limit` (rad).
    ///
    /// # Errors
    /// [`Error::NoConvergence`] for a force that stays near zero over more oscillations than can be searched.
    pub fn end(&self, limit: f64) -> Result<Option<ContactEnd>, Error> {
        finite("start of a contact", self.from.time)?;
        if self.platform.compliance.is_hysteretic() {
            return self.turn(limit);
        }
        let start = self.force.at(0.0, 0.0);
        let falls = start.slope < 0.0 || start.slope == 0.0 && start.bend <= 0.0;
        let (mut force, put_down) = (self.force.clone(), self.is_put_down());
        if start.value < -start.error || start.value <= 0.0 && falls && !put_down {
            return Ok(Some(ContactEnd::Release(0.0)));
        }
        if put_down && falls {
            force = force + self.platform.spare(0.0);
        }
        let spare = 1.0 - self.steady;
        // The time at which the transient is smaller than the steady force's margin, or than a rounding.
        let until = |left: f64| ln((self.transient / left).max(1.0)) / self.fading;
        let settled = until(SETTLED * (1.0 + self.steady));
        let search = if spare > 0.0 { until(spare).min(settled) } else { settled + TAU };
        if search > 0.0
            && let Some(root) = decided(&force, search.min(limit))?.root
        {
            return Ok(Some(ContactEnd::Release(root.at)));
        }
        Ok((settled.max(search) <= limit).then_some(ContactEnd::Settles(settled.max(search))))
    }

    /// The end of this branch of a spring without a damper.
    fn turn(&self, limit: f64) -> Result<Option<ContactEnd>, Error> {
        let Compliance { stiffness, unloading, .. } = self.platform.compliance;
        let drive = &self.platform.drive;
        let fall = |function: &QuasiPolynomial, to: f64| -> Result<Option<f64>, Error> {
            let start = function.at(0.0, 0.0);
            // At the edge of a branch the function that ends it starts at zero.
            let ended = start.value <= 0.0 && (start.slope < 0.0 || start.slope == 0.0 && start.bend < 0.0);
            Ok(if ended { Some(0.0) } else { decided(function, to)?.root.map(|root| root.at) })
        };
        let [first, second] = match self.branch {
            SpringState::Held => {
                let to = limit.min(TAU);
                let spare = self.platform.spare(self.from.gap);
                let edge = |sign: f64, stiffness: f64| {
                    self.force.clone() * sign + (sign * stiffness * self.from.gap + spare)
                };
                let loads = fall(&edge(-1.0, stiffness), to)?;
                let unloads = fall(&edge(1.0, unloading), loads.unwrap_or(to))?;
                if loads.is_none() && unloads.is_none() && limit >= TAU {
                    return Ok(Some(ContactEnd::Settles(TAU)));
                }
                [
                    loads.map(|at| (at, Some(SpringState::Loading))),
                    unloads.map(|at| (at, Some(SpringState::Unloading))),
                ]
            }
            branch => {
                let jet = self.force.at(0.0, 0.0);
                let platform = drive.acceleration(self.from.time);
                // A spring that held still until now starts with its forces in balance.
                let bend = match jet.value - 1.0 - platform {
                    bend if bend.abs() <= 64.0 * f64::EPSILON * (1.0 + jet.value + platform.abs()) => 0.0,
                    bend => bend,
                };
                let relative = self.velocity_change() + drive.derivative(1, self.from.time) * -1.0;
                let sign = if branch == SpringState::Loading { -1.0 } else { 1.0 };
                let to = limit.min(MAX_FLIGHT_DURATION);
                let speed =
                    (relative * sign).starting_with([sign * self.from.velocity, sign * bend], [0.0; 2]);
                let turned = fall(&speed, to)?;
                let freed = match branch {
                    SpringState::Unloading => fall(&self.force, turned.unwrap_or(to))?,
                    _ => None,
                };
                // A spring that would turn back at once has not moved.
                let to = |at| if at > 0.0 { self.turned_at(at) } else { SpringState::Held };
                [turned.map(|at| (at, Some(to(at)))), freed.map(|at| (at, None))]
            }
        };
        // The second root was searched up to the first.
        Ok(second.or(first).map(|(after, branch)| {
            branch.map_or(ContactEnd::Release(after), |branch| ContactEnd::Turns(after, branch))
        }))
    }

    /// The state of a spring whose motion has ended.
    fn turned_at(&self, after: f64) -> SpringState {
        let state = self.after(after);
        self.platform.spring_state(RelativeState { velocity: 0.0, ..state })
    }

    /// The disk when the spring turns, moving with the platform.
    #[must_use]
    pub fn turned(&self, after: f64) -> RelativeState {
        RelativeState { velocity: 0.0, ..self.after(after) }
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
