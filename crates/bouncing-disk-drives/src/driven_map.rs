//! The impact map of a platform of arbitrary motion, its derivative, and its orbits with contact and chatter.

use core::f64::consts::TAU;

use bouncing_disk_core::chatter::{Accumulation, AfterImpact, ShortFlightCount};
use bouncing_disk_core::map::ContactChange;
use bouncing_disk_core::numerics::elementary::wrapped_angle;
use bouncing_disk_core::parts::within;
use bouncing_disk_core::{Attachment, ChatterPolicy, Error, ImpactState, OrbitEvent, Phase};
use glam::{DMat2, DVec2};

use self::release::Cycle;
use crate::compliance::{Compliance, CompliantPlatform, RelativeState};
use crate::drive::landing::{DrivenImpact, Start};
use crate::drive::{Drive, TimeAhead};

mod release;

/// The vertical impact map of a disk with a constant restitution r on a [`Drive`].
///
/// With a [compliant contact](Self::with_contact_time), this is the map from one release to the next, a
/// release being the moment when the force falls to zero. A release at the speed v is represented by the
/// impact with the velocity -v/r at the phase of the release, since a rigid impact would rebound in this way.
/// Every fall of the force to zero counts, even if the force returns before the spring is free.
///
/// ```
/// use bouncing_disk_core::{ChatterPolicy, ImpactState, OrbitEvent};
/// use bouncing_disk_drives::{Drive, DrivenMap};
///
/// let map = DrivenMap::new(Drive::fourier(&[(1.6, 0.0)])?, 0.5)?;
/// let start = ImpactState::from_normalised(4.0, 0.01)?;
/// let rests = |event| matches!(event, Ok(OrbitEvent::Attachment(_)));
/// assert!(map.orbit(start, ChatterPolicy::Complete).take(60).any(rests));
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DrivenMap {
    drive: Drive,
    restitution: f64,
    compliant: Option<CompliantPlatform>,
}

impl DrivenMap {
    /// The map of a disk with `restitution` in [0, 1).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a restitution outside [0, 1).
    pub fn new(drive: Drive, restitution: f64) -> Result<Self, Error> {
        within("restitution", restitution, 0.0, 1.0_f64.next_down(), "[0, 1)")?;
        Ok(Self { drive, restitution, compliant: None })
    }

    /// This map with a compliant contact: an isolated impact lasts for `contact_time` (rad), until the force
    /// falls to zero, and then has the map's restitution.
    ///
    /// ```
    /// use bouncing_disk_core::{ImpactState, Phase};
    /// use bouncing_disk_drives::{Drive, DrivenMap};
    /// use std::f64::consts::TAU;
    ///
    /// // Orbits of period 1 at Gamma = 0.45, with impacts that last for a hundredth of a period and without.
    /// let rigid = DrivenMap::new(Drive::fourier(&[(0.45 * std::f64::consts::PI, 0.0)])?, 0.5)?;
    /// let guess = [ImpactState::new(Phase::new(0.74)?, -4.19)?];
    /// let soft = rigid.clone().with_contact_time(0.01 * TAU)?.refine(&guess)?;
    /// let rigid = rigid.refine(&guess)?;
    /// assert!((soft.states[0].phase().angle() - rigid.states[0].phase().angle()).abs() < 0.1);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Errors of [`Compliance::new`] and [`CompliantPlatform::new`].
    pub fn with_contact_time(self, contact_time: f64) -> Result<Self, Error> {
        let compliance = Compliance::new(contact_time, self.restitution)?;
        self.with_compliance(compliance)
    }

    /// Like [`Self::with_contact_time`], but with a spring that [unloads](Compliance::hysteretic) at a lower
    /// stiffness instead of the damper.
    ///
    /// # Errors
    /// Errors of [`Self::with_contact_time`].
    pub fn with_hysteretic_contact(self, contact_time: f64) -> Result<Self, Error> {
        let compliance = Compliance::hysteretic(contact_time, self.restitution)?;
        self.with_compliance(compliance)
    }

    fn with_compliance(self, compliance: Compliance) -> Result<Self, Error> {
        let compliant = Some(CompliantPlatform::new(self.drive.clone(), compliance)?);
        Ok(Self { compliant, ..self })
    }

    /// The drive of the platform.
    #[must_use]
    pub const fn drive(&self) -> &Drive {
        &self.drive
    }

    /// Coefficient of restitution.
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.restitution
    }

    /// The platform with its contact, if this is compliant.
    #[must_use]
    pub const fn compliant(&self) -> Option<&CompliantPlatform> {
        self.compliant.as_ref()
    }

    /// The impact after the one in `state`, without any chattering policy. With a compliant contact, the
    /// duration includes the contact, and the stated error is infinite because no bound is known.
    ///
    /// # Errors
    /// [`Error::NoLiftOff`] if the disk stays on the platform, and errors of [`Drive::first_impact`].
    pub fn step(&self, state: ImpactState) -> Result<DrivenImpact, Error> {
        let (time, speed) = (state.phase().angle(), -self.restitution * state.velocity());
        let Some(platform) = &self.compliant else { return self.drive.first_impact_from(time, 0.0, speed) };
        self.released(&platform.fly_and_press(platform.released_at(time, speed), None)?)
    }

    fn released(&self, cycle: &Cycle) -> Result<DrivenImpact, Error> {
        if let Some(Accumulation { phase, .. }) = cycle.accumulation() {
            let peak_acceleration = self.drive.bounds().acceleration;
            return Err(Error::NoLiftOff { phase: phase.angle(), peak_acceleration });
        }
        Ok(cycle.impact(self.restitution))
    }

    /// [`Self::step`] with the derivative of the next (phase, velocity) with respect to the present one.
    /// Column-major: `x_axis` is the derivative by the phase.
    ///
    /// # Errors
    /// Errors of [`Self::step`]; [`Error::ImpactOnKink`] if this impact or the next is on a kink.
    pub fn step_with_derivative(&self, state: ImpactState) -> Result<(DrivenImpact, DMat2), Error> {
        if let Some(platform) = &self.compliant {
            let from = platform.released_at(state.phase().angle(), -self.restitution * state.velocity());
            let mut derivative = platform.change_at_release(from);
            let cycle = platform.fly_and_press(from, Some(&mut derivative))?;
            // The velocity of the impact is -1/r times the speed of the release.
            let [to, back] = [-1.0 / self.restitution, -self.restitution]
                .map(|y| DMat2::from_diagonal(DVec2::new(1.0, y)));
            return Ok((self.released(&cycle)?, to * derivative * back));
        }
        let landing = self.step(state)?;
        let on_kink = |phase: f64| Err(Error::ImpactOnKink { phase });
        if landing.on_kink {
            return on_kink(landing.impact.phase.angle());
        }
        if self.drive.velocity_jump(state.phase().angle()) != 0.0 {
            return on_kink(state.phase().angle());
        }
        let (from, to) = (self.drive.at(state.phase().angle()), self.drive.at(landing.impact.phase.angle()));
        let (h, arrival) = (landing.impact.duration(), landing.impact.velocity);
        // gap(h; tau, w) = 0: dh = -(gap_tau dtau + h dw)/arrival, dw = -r dv.
        let gap_by_phase = from.acceleration * h + (from.velocity - to.velocity);
        let duration_by = DVec2::new(-gap_by_phase / arrival, self.restitution * h / arrival);
        let phase_by = DVec2::new(1.0 + duration_by.x, duration_by.y);
        let velocity_by = DVec2::new(
            from.acceleration - duration_by.x - to.acceleration * phase_by.x,
            -self.restitution - duration_by.y - to.acceleration * phase_by.y,
        );
        let derivative =
            DMat2::from_cols(DVec2::new(phase_by.x, velocity_by.x), DVec2::new(phase_by.y, velocity_by.y));
        Ok((landing, derivative))
    }

    /// The orbit that starts with the impact in `state`; the first item is the next event.
    #[must_use]
    pub fn orbit(&self, state: ImpactState, policy: ChatterPolicy) -> DrivenOrbit {
        let mut orbit = self.start(policy);
        orbit.after(state.phase().angle(), state.velocity(), f64::INFINITY);
        orbit
    }

    /// The orbit of a disk in the air, `gap` >= 0 above the platform at `time`, with this velocity relative
    /// to it. With zero gap, the disk leaves the platform with this velocity, which must be >= 0.
    ///
    /// # Errors
    /// Errors of [`Drive::first_impact_from`].
    pub fn of_flight(
        &self,
        time: f64,
        gap: f64,
        relative_velocity: f64,
        policy: ChatterPolicy,
    ) -> Result<DrivenOrbit, Error> {
        let mut orbit = self.start(policy);
        let Some(platform) = &self.compliant else {
            orbit.next = Next::Report(self.drive.first_impact_from(time, gap, relative_velocity)?);
            return Ok(orbit);
        };
        let Start { time, gap, velocity, .. } = Start::new(time, gap, relative_velocity)?;
        let from = RelativeState { time: wrapped_angle(time), gap, velocity };
        let cycle = platform.fly_and_press(from, None)?;
        orbit.next = match cycle.accumulation() {
            Some(accumulation) => Next::Attach(accumulation, 0.0),
            None => Next::Report(cycle.impact(self.restitution)),
        };
        Ok(orbit)
    }

    /// The orbit of a disk that rests on the platform at `time`; in a compliant contact its indentation
    /// balances its weight and the platform's acceleration ([`CompliantPlatform::resting`]).
    #[must_use]
    pub fn of_contact(&self, time: f64, policy: ChatterPolicy) -> DrivenOrbit {
        DrivenOrbit { next: Next::Contact(wrapped_angle(time)), ..self.start(policy) }
    }

    /// Whether the disk is certain to chatter to rest after the impact in `state`.
    pub(crate) fn chatters_to_rest_after(&self, state: ImpactState) -> bool {
        matches!(self.orbit(state, ChatterPolicy::Complete).next, Next::Attach(..))
    }

    fn start(&self, policy: ChatterPolicy) -> DrivenOrbit {
        DrivenOrbit { map: self.clone(), policy, short_flights: ShortFlightCount::new(), next: Next::End }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Next {
    Launch { time: f64, speed: f64, separates: bool },
    Report(DrivenImpact),
    Attach(Accumulation, f64),
    Contact(f64),
    End,
}

/// The lazy sequence of [`OrbitEvent`]s of one orbit. It ends if the disk rests forever, and after an error.
#[derive(Debug, Clone)]
pub struct DrivenOrbit {
    map: DrivenMap,
    policy: ChatterPolicy,
    short_flights: ShortFlightCount,
    next: Next,
}

impl DrivenOrbit {
    /// The map.
    #[must_use]
    pub const fn map(&self) -> &DrivenMap {
        &self.map
    }

    /// Time and relative speed of the next launch; `None` if the disk is about to attach or is at rest, or if
    /// the orbit has ended.
    #[must_use]
    pub const fn launch(&self) -> Option<(f64, f64)> {
        match self.next {
            Next::Launch { time, speed, .. } => Some((time, speed)),
            Next::Report(_) | Next::Attach(..) | Next::Contact(_) | Next::End => None,
        }
    }

    /// Sets the speed >= 0 of the next launch (a perturbation of a relaunch); ignored if no launch is due.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a negative or infinite speed.
    pub fn perturb_launch(&mut self, new: f64) -> Result<(), Error> {
        if let Next::Launch { speed, separates, .. } = &mut self.next {
            *speed = within("relative_speed", new, 0.0, 1.0e9, "[0, 1e9] (units of g/omega)")?;
            *separates &= new == 0.0;
        }
        Ok(())
    }

    /// The next event, or `None` after the end of the orbit.
    ///
    /// # Errors
    /// Errors of [`Drive::first_impact`] and [`Drive::contact_end`]. An error ends the orbit.
    pub fn advance(&mut self) -> Result<Option<OrbitEvent>, Error> {
        let next = core::mem::replace(&mut self.next, Next::End);
        if self.map.compliant.is_some() {
            return self.advance_compliant(next);
        }
        match next {
            Next::Launch { time, separates: true, .. } => {
                let landing = self.map.drive.impact_after_separation_within(time, f64::INFINITY)?;
                Ok(landing.map(|landing| self.report(landing)))
            }
            Next::Launch { time, speed, separates: false } => {
                let landing = self.map.drive.first_impact_from(time, 0.0, speed)?;
                Ok(Some(self.report(landing)))
            }
            Next::Report(landing) => Ok(Some(self.report(landing))),
            Next::Attach(accumulation, last_speed) => {
                self.next = Next::Contact(accumulation.phase.angle());
                Ok(Some(OrbitEvent::Attachment(Attachment { accumulation, last_speed, separation: None })))
            }
            Next::Contact(since) => {
                let Some(end) = self.map.drive.contact_end(since, f64::INFINITY)? else { return Ok(None) };
                let change = ContactChange {
                    duration: end.after,
                    phase: Phase::of_angle(end.time),
                    turns: turns(since, end),
                    velocity: -end.velocity_jump,
                };
                if change.velocity < 0.0 {
                    self.after(end.time, change.velocity, f64::INFINITY);
                    return Ok(Some(OrbitEvent::Kick(change)));
                }
                let separates = change.velocity == 0.0;
                self.next = Next::Launch { time: end.time, speed: change.velocity, separates };
                Ok(Some(OrbitEvent::Separation(change)))
            }
            Next::End => Ok(None),
        }
    }

    /// The next event of a compliant contact.
    fn advance_compliant(&mut self, next: Next) -> Result<Option<OrbitEvent>, Error> {
        let Some(platform) = &self.map.compliant else { return Ok(None) };
        let (cycle, last_speed) = match next {
            Next::Launch { time, speed, .. } => {
                (platform.fly_and_press(platform.released_at(time, speed), None)?, speed)
            }
            Next::Contact(time) => (platform.press_until_released(platform.resting(time), None)?, 0.0),
            Next::Report(landing) => return Ok(Some(self.report(landing))),
            Next::Attach(accumulation, last_speed) => {
                return Ok(Some(OrbitEvent::Attachment(Attachment {
                    accumulation,
                    last_speed,
                    separation: None,
                })));
            }
            Next::End => return Ok(None),
        };
        if let Some(accumulation) = cycle.accumulation() {
            return Ok(Some(OrbitEvent::Attachment(Attachment {
                accumulation,
                last_speed,
                separation: None,
            })));
        }
        let event = self.report(cycle.impact(self.map.restitution));
        Ok(Some(match (next, event) {
            (Next::Contact(_), OrbitEvent::Impact(impact)) => OrbitEvent::Separation(ContactChange {
                duration: impact.duration(),
                phase: impact.phase,
                turns: impact.turns,
                velocity: -self.map.restitution * impact.velocity,
            }),
            (_, event) => event,
        }))
    }

    fn report(&mut self, landing: DrivenImpact) -> OrbitEvent {
        let impact = &landing.impact;
        // Only flights far below one period count as short.
        let duration = if impact.periods == 0 { impact.remainder } else { TAU };
        self.after(impact.phase.angle(), impact.velocity, duration);
        OrbitEvent::Impact(landing.impact)
    }

    /// Decides the motion after an impact with relative `velocity` that ends a flight of this duration.
    fn after(&mut self, time: f64, velocity: f64, duration: f64) {
        if self.map.compliant.is_some() {
            let speed = -self.map.restitution * velocity;
            self.next = Next::Launch { time, speed, separates: false };
            return;
        }
        let surface = (&self.map.drive, self.map.restitution);
        let attach = |duration, error_bound| {
            let angle = time + duration;
            let (phase, turns) = (Phase::of_angle(wrapped_angle(angle)), u64::from(angle >= TAU));
            let last_speed = -self.map.restitution * velocity;
            Next::Attach(Accumulation { duration, error_bound, phase, turns }, last_speed)
        };
        self.next =
            match self.policy.after_impact(surface, (time, velocity), duration, &mut self.short_flights) {
                AfterImpact::Launch(speed) => Next::Launch { time, speed, separates: false },
                AfterImpact::Chatter(chatter) => attach(chatter.duration, chatter.error),
                AfterImpact::Rest { error } => attach(0.0, error),
            };
    }
}

/// The number of times the phase passes 0 in a contact of at most one period.
fn turns(since: f64, end: TimeAhead) -> u64 {
    u64::from(end.time < since || end.time <= since && end.after > 0.5 * TAU)
}

impl Iterator for DrivenOrbit {
    type Item = Result<OrbitEvent, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}
