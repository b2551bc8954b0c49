//! The impact map (next-collision map) of the vertical motion, its derivative, and its orbits.

use glam::{DMat2, DVec2};

use crate::chatter::accumulation::Accumulation;
use crate::chatter::policy::{ChatterPolicy, ShortFlightCount};
use crate::error::{Error, not_negative, within};
use crate::flight::impact::Impact;
use crate::flight::launch::Launch;
use crate::observer::{FLIGHTS_BETWEEN_CALLS, Observer, Watch};
use crate::platform::phase::Phase;
use crate::platform::vibration::Vibration;
use crate::read_checked;

/// The state of the disk just before an impact: the paper's tau_imp and w_A.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedState"))]
pub struct ImpactState {
    phase: Phase,
    velocity: f64,
}

/// Phase and velocity; a precision given applies to both.
impl core::fmt::Display for ImpactState {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        formatter.write_str("impact at ")?;
        core::fmt::Display::fmt(&self.phase, formatter)?;
        formatter.write_str(", w = ")?;
        core::fmt::Display::fmt(&self.velocity, formatter)?;
        formatter.write_str(" g/omega")
    }
}

read_checked!(ImpactState as UncheckedState { phase: Phase, velocity: f64 } => ImpactState::new);

impl ImpactState {
    /// An impact at `phase` with relative axial velocity `velocity` <= 0 (disk minus platform, units of g/omega).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a positive or non-finite velocity.
    pub fn new(phase: Phase, velocity: f64) -> Result<Self, Error> {
        if velocity <= 0.0 && velocity.is_finite() {
            Ok(Self { phase, velocity })
        } else {
            Err(Error::OutOfRange {
                field: "axial_impact_velocity",
                value: velocity,
                legal: "(-inf, 0] (disk minus platform, units of g/omega)",
            })
        }
    }

    /// The state at an impact phase (rad) and normalised impact speed |w_A Gamma/(omega A)| = |w|/pi, the
    /// coordinates of the paper's Figs. 6(b) and 7.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a negative or non-finite speed or a non-finite angle.
    pub fn from_normalised(angle: f64, normalised_speed: f64) -> Result<Self, Error> {
        Self::new(Phase::new(angle)?, -normalised_speed * core::f64::consts::PI)
    }

    /// The state at an impact that was computed.
    pub(crate) const fn of_impact(phase: Phase, velocity: f64) -> Self {
        Self { phase, velocity }
    }

    /// Impact phase tau_imp.
    #[must_use]
    pub const fn phase(&self) -> Phase {
        self.phase
    }

    /// Relative axial velocity w_A just before the impact, <= 0, in units of g/omega.
    #[must_use]
    pub const fn velocity(&self) -> f64 {
        self.velocity
    }

    /// The paper's normalised impact speed |w_A Gamma/(omega A)| = |w|/pi.
    #[must_use]
    pub fn normalised_speed(&self) -> f64 {
        -self.velocity / core::f64::consts::PI
    }
}

impl From<Impact> for ImpactState {
    fn from(impact: Impact) -> Self {
        Self { phase: impact.phase, velocity: impact.velocity }
    }
}

impl From<&Impact> for ImpactState {
    fn from(impact: &Impact) -> Self {
        Self { phase: impact.phase, velocity: impact.velocity }
    }
}

/// The vertical impact map: vibration of the platform and coefficient of restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedMap"))]
pub struct ImpactMap {
    vibration: Vibration,
    restitution: f64,
}

/// `Gamma = 0.45 (P = 1.4137), restitution 0.5`.
impl core::fmt::Display for ImpactMap {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(formatter, "{}, restitution {}", self.vibration, self.restitution)
    }
}

read_checked!(ImpactMap as UncheckedMap { vibration: Vibration, restitution: f64 } => ImpactMap::new);

impl ImpactMap {
    /// The map of a disk with `restitution` in [0, 1) on a vibrating platform.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a restitution outside [0, 1).
    pub fn new(vibration: Vibration, restitution: f64) -> Result<Self, Error> {
        within("restitution", restitution, 0.0, 1.0 - f64::EPSILON / 2.0, "[0, 1)")?;
        Ok(Self { vibration, restitution })
    }

    /// The vibration of the platform.
    #[must_use]
    pub const fn vibration(&self) -> &Vibration {
        &self.vibration
    }

    /// Coefficient of restitution.
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.restitution
    }

    /// The impact that follows the one in `state`, without any chattering policy: a chattering disk is followed through ever
    /// smaller impacts until its speed underflows. [`Self::orbit`] and [`Self::state_after`] end a chatter.
    ///
    /// # Errors
    /// [`Error::NoLiftOff`] if the disk stays on the platform (restitution or speed zero), and those of
    /// [`Vibration::first_impact`].
    #[inline]
    pub fn step(&self, state: ImpactState) -> Result<Impact, Error> {
        self.vibration.impact_after(state.phase, -self.restitution * state.velocity)
    }

    /// The impact that is so many [steps](Self::step) after the one in `state`, which itself is 0 steps after: the same bits as
    /// one step after the other, and faster where the compiler would pass the state through memory. As there, no policy ends a chatter.
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, ImpactState, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.55)?, 0.5)?;
    /// let start = ImpactState::from_normalised(0.8, 1.3)?;
    /// let settled = map.iterate(start, 10_000)?;
    /// assert_eq!(map.iterate(start, 10_001)?, map.step(settled)?.into());
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// That of the first step that fails (see [`Self::step`]).
    #[inline]
    pub fn iterate(&self, mut state: ImpactState, impacts: u64) -> Result<ImpactState, Error> {
        for _ in 0..impacts {
            let speed = -self.restitution * state.velocity;
            state = self.vibration.impact_after_in_place(state.phase, speed)?.into();
        }
        Ok(state)
    }

    /// [`Self::iterate`] with an observer; the items are the impacts.
    ///
    /// # Errors
    /// Those of [`Self::iterate`]; [`Error::Stopped`] if the observer breaks. Who wants to go on from there
    /// iterates in parts.
    pub fn iterate_observed(
        &self,
        mut state: ImpactState,
        impacts: u64,
        observer: &dyn Observer,
    ) -> Result<ImpactState, Error> {
        let watch = Watch::begin(observer, 0, impacts)?;
        let mut work = watch.work();
        let mut left = impacts;
        while left > 0 {
            let part = left.min(FLIGHTS_BETWEEN_CALLS);
            state = self.iterate(state, part)?;
            left -= part;
            work.finish(part)?;
        }
        watch.end();
        Ok(state)
    }

    /// [`Self::step`] with the derivative of the next (phase, velocity) by the present (phase, velocity), in radians and units
    /// of g/omega. Column-major: `x_axis` is the derivative by the phase.
    ///
    /// It is singular at a graze (impact velocity zero): the entries are infinite there.
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, Multipliers, Vibration};
    /// // The period-1 orbit closes after one impact: the derivative is its monodromy, and it attracts.
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let (_, derivative) = map.step_with_derivative(map.period_one(1).expect("it exists"))?;
    /// assert!(Multipliers::of(derivative).spectral_radius() < 1.0);
    /// // The map contracts areas by the square of the restitution.
    /// assert!((derivative.determinant() - 0.25).abs() < 1e-12);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Self::step`].
    pub fn step_with_derivative(&self, state: ImpactState) -> Result<(Impact, DMat2), Error> {
        let impact = self.step(state)?;
        Ok((impact, self.derivative(state, impact.into(), impact.duration())))
    }

    /// The derivative at `state`, whose next impact is the one in `next` after a flight of the duration `h`.
    pub(crate) fn derivative(&self, state: ImpactState, next: ImpactState, h: f64) -> DMat2 {
        let p = self.vibration.peak_acceleration();
        let (s, c) = (state.phase.sin(), state.phase.cos());
        let (s1, c1) = (next.phase.sin(), next.phase.cos());
        let arrival = next.velocity;
        // gap(h; tau, w) = 0: dh = -(gap_tau dtau + h dw) / arrival.
        let gap_by_phase = -p * (s * h + (c1 - c));
        let duration_by = DVec2::new(-gap_by_phase / arrival, self.restitution * h / arrival);
        let phase_by = DVec2::new(1.0 + duration_by.x, duration_by.y);
        // arrival = w + P cos tau - h - P cos tau'.
        let velocity_by = DVec2::new(
            -p * s - duration_by.x + p * s1 * phase_by.x,
            -self.restitution - duration_by.y + p * s1 * phase_by.y,
        );
        DMat2::from_cols(DVec2::new(phase_by.x, velocity_by.x), DVec2::new(phase_by.y, velocity_by.y))
    }

    /// The orbit that starts with the impact in `state`; the first item is the next event.
    #[must_use]
    pub fn orbit(&self, state: ImpactState, policy: ChatterPolicy) -> Orbit {
        Orbit::after_impact(*self, policy, state)
    }

    /// The orbit of a disk that starts in the air: see [`Vibration::first_impact_of_drop`].
    ///
    /// # Errors
    /// Those of [`Vibration::first_impact_of_drop`].
    pub fn orbit_from_drop(
        &self,
        phase: Phase,
        gap: f64,
        relative_velocity: f64,
        policy: ChatterPolicy,
    ) -> Result<Orbit, Error> {
        let impact = self.vibration.first_impact_of_drop(phase, gap, relative_velocity)?;
        Ok(Orbit::reporting(*self, policy, impact))
    }

    /// The orbit of a disk that leaves the platform with this launch.
    #[must_use]
    pub const fn orbit_from_launch(&self, launch: Launch, policy: ChatterPolicy) -> Orbit {
        Orbit::from_launch(*self, policy, launch.phase(), launch.relative_speed())
    }
}

/// One event of the vertical motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum OrbitEvent {
    /// The disk hits the platform.
    Impact(Impact),
    /// The disk comes to rest on the platform and, if the platform ever falls away, separates again.
    Attachment(Attachment),
}

/// A spell of contact between the end of a chattering sequence and the next separation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedAttachment"))]
pub struct Attachment {
    /// The accumulation point, where the disk attaches. Under [`ChatterPolicy::Cut`] the last impact itself,
    /// with duration zero and no bound on what was cut off (`error_bound` is infinite unless the speed was 0).
    pub accumulation: Accumulation,
    /// Launch speed after the last impact, in units of g/omega: what the chatter started from.
    pub last_speed: f64,
    /// The phase at which it separates, and how often the phase passes 0 (mod 2 pi) from the attachment to there;
    /// `None` if the disk rests for ever (P <= 1).
    pub separation: Option<(Phase, u64)>,
}

read_checked!(Attachment as UncheckedAttachment {
    accumulation: Accumulation,
    last_speed: f64,
    separation: Option<(Phase, u64)>,
});

impl Attachment {
    /// Checks what is read.
    fn check(&self) -> Result<(), Error> {
        not_negative("last_speed", self.last_speed)?;
        if let Some((_, turns)) = self.separation {
            within("turns before the separation", turns as f64, 0.0, 1.0, "0 or 1")?;
        }
        Ok(())
    }
}

/// What the disk does next.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Next {
    /// Leave the platform at this phase and speed.
    Launch(Phase, f64),
    /// Report this impact, already found.
    Report(Impact),
    /// Come to rest.
    Attach(Accumulation, f64),
    /// Nothing more: it rests for ever, or an error was reported.
    End,
}

/// The lazy sequence of [`OrbitEvent`]s of one orbit. It ends if the disk rests for ever, and after an error.
#[derive(Debug, Clone)]
pub struct Orbit {
    map: ImpactMap,
    policy: ChatterPolicy,
    short_flights: ShortFlightCount,
    next: Next,
}

impl Orbit {
    fn after_impact(map: ImpactMap, policy: ChatterPolicy, state: ImpactState) -> Self {
        let mut orbit = Self { map, policy, short_flights: ShortFlightCount::default(), next: Next::End };
        orbit.next = orbit.after(state.phase, state.velocity, f64::INFINITY);
        orbit
    }

    const fn from_launch(map: ImpactMap, policy: ChatterPolicy, phase: Phase, speed: f64) -> Self {
        Self { map, policy, short_flights: ShortFlightCount::new(), next: Next::Launch(phase, speed) }
    }

    fn reporting(map: ImpactMap, policy: ChatterPolicy, impact: Impact) -> Self {
        Self { map, policy, short_flights: ShortFlightCount::new(), next: Next::Report(impact) }
    }

    /// What follows an impact at `phase` with relative `velocity` after a flight of `duration`.
    fn after(&mut self, phase: Phase, velocity: f64, duration: f64) -> Next {
        let speed = -self.map.restitution * velocity;
        match self.policy {
            ChatterPolicy::Complete => {
                match self.map.vibration.accumulation(phase, speed, self.map.restitution) {
                    // Where no time is left for a chatter there is none.
                    Some(at) => Next::Attach(at, if at.duration > 0.0 { speed } else { 0.0 }),
                    None => Next::Launch(phase, speed),
                }
            }
            ChatterPolicy::Cut(cut) => {
                // A disk without rebound speed is on the platform, cut or not.
                if !self.short_flights.attaches(&cut, duration, -velocity) && speed > 0.0 {
                    Next::Launch(phase, speed)
                } else if self.map.vibration.falls_away_at(phase.angle()) {
                    // Put on a platform that falls away, the disk is in flight again at once.
                    Next::Launch(phase, 0.0)
                } else {
                    let error_bound = if speed > 0.0 { f64::INFINITY } else { 0.0 };
                    Next::Attach(Accumulation { duration: 0.0, error_bound, phase, turns: 0 }, speed)
                }
            }
        }
    }

    /// Where and how fast the disk leaves the platform next: `None` if it is about to attach or has ended.
    #[must_use]
    pub const fn launch(&self) -> Option<Launch> {
        match self.next {
            Next::Launch(phase, speed) => Some(Launch::known(phase, speed)),
            Next::Report(_) | Next::Attach(..) | Next::End => None,
        }
    }

    /// Gives the next launch another speed >= 0 (a perturbation of a relaunch); ignored if none is due.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a negative or non-finite speed.
    pub fn perturb_launch(&mut self, speed: f64) -> Result<(), Error> {
        if let Next::Launch(phase, _) = self.next {
            let launch = Launch::new(phase, speed)?;
            self.next = Next::Launch(phase, launch.relative_speed());
        }
        Ok(())
    }

    /// What ends a chatter.
    #[must_use]
    pub const fn policy(&self) -> ChatterPolicy {
        self.policy
    }

    /// The map.
    #[must_use]
    pub const fn map(&self) -> &ImpactMap {
        &self.map
    }

    /// Ends the flight in `state`, computed elsewhere from [`Self::launch`].
    #[inline(always)]
    pub(crate) fn land(&mut self, state: ImpactState, duration: f64) {
        self.next = self.after(state.phase, state.velocity, duration);
    }

    /// [`Self::after`], of a phase in parts: a reference to the impact would keep it in memory, where the next flight waits
    /// for it.
    #[inline(never)]
    fn settle(&mut self, angle: f64, sin: f64, cos: f64, velocity: f64, duration: f64) {
        self.next = self.after(Phase::from_parts(angle, sin, cos), velocity, duration);
    }

    #[inline]
    fn report(&mut self, impact: Impact) -> OrbitEvent {
        let (phase, speed) = (impact.phase, -self.map.restitution * impact.velocity);
        // Stored in place: nearly every impact, and the next flight waits for it.
        if self.policy == ChatterPolicy::Complete
            && self.map.vibration.bounces_on(phase, speed, self.map.restitution)
        {
            self.next = Next::Launch(phase, speed);
        } else {
            // Only flights far below one period count as short.
            let duration = if impact.periods == 0 { impact.remainder } else { core::f64::consts::TAU };
            self.settle(phase.angle(), phase.sin(), phase.cos(), impact.velocity, duration);
        }
        OrbitEvent::Impact(impact)
    }

    /// The next event, or `None` after the end of the orbit.
    ///
    /// # Errors
    /// Those of [`Vibration::first_impact`]; the orbit has ended after one.
    #[inline]
    pub fn advance(&mut self) -> Result<Option<OrbitEvent>, Error> {
        match self.next {
            Next::Launch(phase, speed) => match self.map.vibration.impact_after(phase, speed) {
                Ok(impact) => Ok(Some(self.report(impact))),
                Err(error) => {
                    self.next = Next::End;
                    Err(error)
                }
            },
            Next::Report(impact) => Ok(Some(self.report(impact))),
            Next::Attach(accumulation, last_speed) => {
                let separation = self
                    .map
                    .vibration
                    .separation_phase()
                    .map(|phase| (phase, u64::from(phase.angle() <= accumulation.phase.angle())));
                self.next = separation.map_or(Next::End, |(phase, _)| Next::Launch(phase, 0.0));
                Ok(Some(OrbitEvent::Attachment(Attachment { accumulation, last_speed, separation })))
            }
            Next::End => Ok(None),
        }
    }
}

impl Iterator for Orbit {
    type Item = Result<OrbitEvent, Error>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}
