//! The motion of a disk on the platform from event to event: how it begins, which event comes next, and the
//! state after it.
//!
//! Every contact event is decided here and nowhere else. The [`Engine`](crate::Engine) records each step with
//! its energy; a motor's rotor uses only the speed and the angle.

use std::cmp::Ordering;

use bouncing_disk_core::map::{Constant, RestitutionLaw};
use bouncing_disk_core::{Attachment, ChatterPolicy, ImpactMap, Launch, Orbit, Phase};

use crate::error::Error;
use crate::motion::friction::{Friction, Spent};
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::rotary_change::RotaryChange;
use crate::motion::rotary_change::change_in_contact;
use crate::motion::state::{Mode, SlipDirection};
use crate::parameters::dimensionless::DimensionlessSystem;

/// An angular speed this close to the platform's at the start, relative to the sum of both magnitudes and the
/// platform's largest speed, is set to the platform's: four units in the last place.
pub(crate) const SAME_SPEED: f64 = 4.0 * f64::EPSILON;

/// A disk that lies on the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lying<End = PhaseTime> {
    /// The direction in which it slips; `None` while it sticks.
    pub(crate) slip: Option<SlipDirection>,
    /// The end of the contact, if ever: on the sine, the time at which the platform falls away. On a
    /// compliant stator an end is assumed until the contact is known to last for ever.
    pub(crate) end: Option<End>,
}

impl<End> Lying<End> {
    /// Sticking or sliding.
    #[inline]
    pub(crate) const fn mode(&self) -> Mode {
        match self.slip {
            Some(direction) => Mode::Sliding(direction),
            None => Mode::Sticking,
        }
    }
}

/// The cause of the next event.
#[derive(Debug, Clone, Copy)]
enum Due {
    Separation,
    SlipStart(SlipDirection),
    /// `began_here`: the slip was zero at the start of the segment.
    SlipEnd {
        direction: SlipDirection,
        began_here: bool,
    },
}

/// A segment of contact, up to the event that ends it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContactStep {
    /// Time of the event.
    pub(crate) time: PhaseTime,
    /// Duration of the segment.
    pub(crate) span: PhaseSpan,
    /// The disk that remains in contact; `None` if the platform falls away.
    pub(crate) next: Option<Lying>,
    /// The change over the segment from the closed forms. At the end of a slip, its speed differs from
    /// [`Self::speed`] by rounding.
    pub(crate) change: RotaryChange,
    /// Angular speed at the event: the platform's if friction ends a slip.
    pub(crate) speed: f64,
}

impl Lying {
    /// A disk that comes to rest on the platform at `time` with angular `speed` and lies there until
    /// `end`.
    #[inline]
    pub(crate) fn new(
        system: &DimensionlessSystem,
        friction: &Friction,
        time: PhaseTime,
        speed: f64,
        end: Option<PhaseTime>,
    ) -> Self {
        let slip = SlipDirection::of(speed - system.platform_angular_speed(time.phase))
            .or_else(|| friction.onset(time.phase, Spent::None));
        Self { slip, end }
    }

    /// The contact after an attachment at `time`.
    #[inline]
    pub(crate) fn after_attachment(
        system: &DimensionlessSystem,
        friction: &Friction,
        time: PhaseTime,
        speed: f64,
        rest: &Attachment,
    ) -> Self {
        let end = rest.separation.map(|(phase, turns)| PhaseTime { periods: time.periods + turns, phase });
        Self::new(system, friction, time, speed, end)
    }

    /// The next event of a disk with angular `speed` at `now`; `None` if it sticks, or slides, for ever.
    ///
    /// # Errors
    /// [`Error::SlipTooLong`].
    #[inline(always)]
    pub(crate) fn next(
        &self,
        system: &DimensionlessSystem,
        friction: &Friction,
        now: PhaseTime,
        speed: f64,
    ) -> Result<Option<ContactStep>, Error> {
        let from = now.phase;
        let limit = self.end.map(|at| at.since(&now).radians());
        let due = match self.slip {
            Some(direction) => {
                let slip = speed - system.platform_angular_speed(from);
                friction
                    .slip_end(direction, from, direction.sign() * slip, limit)?
                    .map(|span| (span, Due::SlipEnd { direction, began_here: slip == 0.0 }))
            }
            None => friction
                .stick_end(from)
                .filter(|(time, _)| limit.is_none_or(|limit| *time < limit))
                .map(|(time, direction)| (PhaseSpan::from_radians(time), Due::SlipStart(direction))),
        };
        let (time, due) = match (due, self.end) {
            (Some((span, due)), separation) => {
                // Rounding must not carry an event past the separation.
                let time = now.after(span);
                let time = separation.filter(|at| time.order(at) == Ordering::Greater).unwrap_or(time);
                (time, due)
            }
            (None, Some(at)) => (at, Due::Separation),
            (None, None) => return Ok(None),
        };
        let span = time.since(&now);
        let change = change_in_contact(system, self.mode(), speed, (from, time.phase), span);
        let sliding = |slip| Some(Self { slip, ..*self });
        let (next, speed) = match due {
            Due::Separation => (None, change.speed),
            Due::SlipStart(direction) => (sliding(Some(direction)), change.speed),
            Due::SlipEnd { direction, began_here } => {
                // A slip that begins and ends at the same instant is due to rounding: the disk must not slip
                // again here.
                let idle = began_here && span == PhaseSpan::ZERO;
                let spent = if idle { Spent::Both } else { Spent::One(direction) };
                let next = sliding(friction.onset(time.phase, spent));
                // Without friction the disk merely passes through the platform's speed.
                let grips = system.friction() > 0.0;
                (next, if grips { system.platform_angular_speed(time.phase) } else { change.speed })
            }
        };
        Ok(Some(ContactStep { time, span, next, change, speed }))
    }
}

/// A disk that has been placed on the platform.
#[derive(Debug, Clone)]
pub(crate) struct Placed<L = Constant> {
    /// The vertical motion after the separation; `None` if the platform never falls away.
    pub(crate) orbit: Option<Orbit<L>>,
    /// `None` if the platform falls away at once and the disk flies.
    pub(crate) lying: Option<Lying>,
    /// Angular speed, set to the platform's if it is equal within rounding.
    pub(crate) speed: f64,
}

impl<L: RestitutionLaw> Placed<L> {
    /// A disk with angular `speed`, placed on the platform at `phase`; the `map` may have another law of
    /// restitution than the system.
    ///
    /// # Errors
    /// The errors of the core's launches.
    pub(crate) fn new(
        system: &DimensionlessSystem,
        map: &ImpactMap<L>,
        friction: &Friction,
        phase: Phase,
        speed: f64,
        policy: ChatterPolicy,
    ) -> Result<Self, Error> {
        let vibration = system.vibration();
        let mut end = None;
        let mut orbit = None;
        if let Some(leaves) = vibration.separation_phase() {
            let falls_away = vibration.falls_away_at(phase.angle());
            let from = if falls_away { phase } else { leaves };
            orbit = Some(map.orbit_from_launch(Launch::new(from, 0.0)?, policy));
            if falls_away {
                return Ok(Self { orbit, lying: None, speed });
            }
            end = Some(PhaseTime { periods: u64::from(leaves.angle() <= phase.angle()), phase: leaves });
        }
        let platform_speed = system.platform_angular_speed(phase);
        let is_same = (speed - platform_speed).abs() <= SAME_SPEED * (speed.abs() + system.twist_speed());
        let speed = if is_same { platform_speed } else { speed };
        let lying = Lying::new(system, friction, PhaseTime::in_first_period(phase), speed, end);
        Ok(Self { orbit, lying: Some(lying), speed })
    }
}
