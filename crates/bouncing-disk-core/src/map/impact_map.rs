//! The impact map (next-collision map) of the vertical motion, its derivative, and its orbits.

use glam::{DMat2, DVec2};

use crate::chatter::accumulation::Accumulation;
use crate::chatter::policy::{ChatterPolicy, ShortFlightCount};
use crate::flight::launch::Impact;
use crate::flight::launch::Launch;
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::map::restitution_law::{Constant, Internal, RestitutionLaw, launch_slope, restitution_of};
use crate::numerics::error::{Error, finite, not_negative, within};
use crate::numerics::stored::read_checked;
use crate::run::{FLIGHTS_BETWEEN_CALLS, Observer, Watch};

/// The state of the disk just before an impact: the paper's tau_imp and w_A.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedState"))]
pub struct ImpactState {
    phase: Phase,
    velocity: f64,
}

/// Phase and velocity; a given precision applies to both.
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
    /// An impact at `phase` with relative axial velocity `velocity` <= 0 (disk minus platform, units of
    /// g/omega).
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

    /// The state at a computed impact.
    pub const fn of_impact(phase: Phase, velocity: f64) -> Self {
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

/// The vertical impact map: vibration of the platform and law of restitution.
///
/// Closed forms, the proof of rest, periodic orbits, batches and basins need a constant restitution, the
/// paper's law. [Other laws](Self::with_law) offer steps and their derivatives, iterates, and orbits that end
/// a chatter by a cut.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedMap<L>"))]
pub struct ImpactMap<L = Constant> {
    vibration: Vibration,
    restitution: L,
}

/// `Gamma = 0.45 (P = 1.4137), restitution 0.5`.
impl<L: core::fmt::Display> core::fmt::Display for ImpactMap<L> {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(formatter, "{}, restitution {}", self.vibration, self.restitution)
    }
}

read_checked!(ImpactMap<L> as UncheckedMap { vibration: Vibration, restitution: L });

impl<L> ImpactMap<L> {
    /// Vibration and law were checked when they were read.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }

    /// The vibration of the platform.
    #[must_use]
    pub const fn vibration(&self) -> &Vibration {
        &self.vibration
    }

    /// The law of restitution.
    #[must_use]
    pub const fn law(&self) -> &L {
        &self.restitution
    }
}

impl ImpactMap {
    /// The map of a disk with `restitution` in [0, 1) on a vibrating platform.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a restitution outside [0, 1).
    pub fn new(vibration: Vibration, restitution: f64) -> Result<Self, Error> {
        Ok(Self { vibration, restitution: Constant::new(restitution)? })
    }

    /// Coefficient of restitution.
    #[must_use]
    pub const fn restitution(&self) -> f64 {
        self.restitution.value()
    }

    /// The derivative at `state`; the next impact is `next`, after a flight of duration `h`.
    pub(crate) fn derivative(&self, state: ImpactState, next: ImpactState, h: f64) -> DMat2 {
        self.derivative_by_slope(state, next, h, self.restitution())
    }
}

impl<L: RestitutionLaw> ImpactMap<L> {
    /// The map of a disk on a vibrating platform, with this law of restitution.
    ///
    /// ```
    /// use bouncing_disk_core::chaos::TangentGrowth;
    /// use bouncing_disk_core::map::KuwabaraKono;
    /// use bouncing_disk_core::{ImpactMap, ImpactState, Unobserved, Vibration};
    ///
    /// // The largest Lyapunov exponent of an orbit under a law that depends on the speed.
    /// let law = KuwabaraKono::new(0.5, 3.0)?;
    /// let map = ImpactMap::with_law(Vibration::from_axial_forcing(0.55)?, law);
    /// let mut state = map.iterate(ImpactState::from_normalised(0.8, 1.3)?, 1_000, &Unobserved)?;
    /// let mut growth = TangentGrowth::default();
    /// for _ in 0..1_000 {
    ///     let (impact, derivative) = map.step_with_derivative(state)?;
    ///     growth.grow(derivative);
    ///     state = impact.into();
    /// }
    /// assert!(growth.exponent().is_some());
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    #[must_use]
    pub const fn with_law(vibration: Vibration, law: L) -> Self {
        Self { vibration, restitution: law }
    }

    /// The restitution of an impact with this relative axial speed >= 0 (units of g/omega).
    ///
    /// # Errors
    /// [`Error::IllegalRestitution`] if the law returns a number outside [0, 1], or NaN.
    #[inline(always)]
    pub fn restitution_at(&self, impact_speed: f64) -> Result<f64, Error> {
        restitution_of(&self.restitution, impact_speed)
    }

    /// The launch speed after an impact with relative `velocity` <= 0.
    #[inline(always)]
    fn rebound_speed(&self, velocity: f64) -> Result<f64, Error> {
        // From zero, so that a law is never asked for the restitution at minus zero.
        Ok(-self.restitution_at(0.0 - velocity)? * velocity)
    }

    /// The next impact after `state`, without any chattering policy: a chattering disk is followed through ever
    /// smaller impacts until its speed underflows. [`Self::orbit`] and [`Self::state_after`] end a chatter.
    ///
    /// # Errors
    /// [`Error::NoLiftOff`] if the disk stays on the platform (restitution or speed zero), errors of
    /// [`Vibration::first_impact`], and [`Error::IllegalRestitution`].
    // Each loop needs its own copy, in which the state stays in registers.
    #[inline(always)]
    pub fn step(&self, state: ImpactState) -> Result<Impact, Error> {
        self.vibration.impact_after(state.phase, self.rebound_speed(state.velocity)?)
    }

    /// The impact a number of [steps](Self::step) after `state`: bit for bit the result of single steps, but
    /// faster because the state stays in registers. As in a step, no policy ends a chatter. The items of
    /// `observer` are the impacts.
    ///
    /// ```
    /// # use bouncing_disk_core::{ImpactMap, ImpactState, Unobserved, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.55)?, 0.5)?;
    /// let start = ImpactState::from_normalised(0.8, 1.3)?;
    /// let settled = map.iterate(start, 10_000, &Unobserved)?;
    /// assert_eq!(map.iterate(start, 10_001, &Unobserved)?, map.step(settled)?.into());
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// The error of the first step that fails (see [`Self::step`]).
    pub fn iterate(
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
            // The loop is here and not in `steps`, where the compiler makes it a sixtieth slower.
            for _ in 0..part {
                state = self.step(state)?.into();
            }
            left -= part;
            work.finish(part)?;
        }
        watch.end();
        Ok(state)
    }

    /// A number of steps without an observer.
    #[inline]
    pub(crate) fn steps(&self, mut state: ImpactState, impacts: u64) -> Result<ImpactState, Error> {
        for _ in 0..impacts {
            state = self.step(state)?.into();
        }
        Ok(state)
    }

    /// [`Self::step`] with the derivative of the next (phase, velocity) with respect to the present one, in
    /// radians and units of g/omega. Column-major: `x_axis` is the derivative with respect to the phase.
    ///
    /// The derivative is singular at a graze (impact velocity zero), with infinite entries.
    ///
    /// ```
    /// # use bouncing_disk_core::orbits::Multipliers;
    /// # use bouncing_disk_core::{ImpactMap, Vibration};
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
    /// Errors of [`Self::step`]; [`Error::OutOfRange`] if the law has no finite derivative there.
    pub fn step_with_derivative(&self, state: ImpactState) -> Result<(Impact, DMat2), Error> {
        let impact = self.step(state)?;
        let slope = launch_slope(&self.restitution, 0.0 - state.velocity)?;
        Ok((impact, self.derivative_by_slope(state, impact.into(), impact.duration(), slope)))
    }

    /// The derivative at `state`; the next impact is `next`, after a flight of duration `h`. `slope` is the
    /// derivative of the launch speed with respect to the impact speed.
    fn derivative_by_slope(&self, state: ImpactState, next: ImpactState, h: f64, slope: f64) -> DMat2 {
        let p = self.vibration.peak_acceleration();
        let (s, c) = (state.phase.sin(), state.phase.cos());
        let (s1, c1) = (next.phase.sin(), next.phase.cos());
        let arrival = next.velocity;
        // gap(h; tau, w) = 0: dh = -(gap_tau dtau + h dw) / arrival.
        let gap_by_phase = -p * (s * h + (c1 - c));
        let duration_by = DVec2::new(-gap_by_phase / arrival, slope * h / arrival);
        let phase_by = DVec2::new(1.0 + duration_by.x, duration_by.y);
        // arrival = w + P cos tau - h - P cos tau'.
        let velocity_by = DVec2::new(
            -p * s - duration_by.x + p * s1 * phase_by.x,
            -slope - duration_by.y + p * s1 * phase_by.y,
        );
        DMat2::from_cols(DVec2::new(phase_by.x, velocity_by.x), DVec2::new(phase_by.y, velocity_by.y))
    }

    /// The orbit that starts with the impact in `state`; the first item is the next event.
    ///
    /// The closed form of [`ChatterPolicy::Complete`] holds for a constant restitution: under another law, or
    /// with a restitution outside the range of this form, the first event is an error. [`ChatterPolicy::Cut`]
    /// ends a chatter under every law; its error is the `error_bound` of the [`Attachment`].
    #[must_use]
    pub fn orbit(&self, state: ImpactState, policy: ChatterPolicy) -> Orbit<L> {
        Orbit::after_impact(self.clone(), policy, state)
    }

    /// The orbit of a disk that starts in the air: see [`Vibration::first_impact_of_drop`].
    ///
    /// # Errors
    /// Errors of [`Vibration::first_impact_of_drop`].
    pub fn orbit_from_drop(
        &self,
        phase: Phase,
        gap: f64,
        relative_velocity: f64,
        policy: ChatterPolicy,
    ) -> Result<Orbit<L>, Error> {
        let impact = self.vibration.first_impact_of_drop(phase, gap, relative_velocity)?;
        Ok(Orbit::new(self.clone(), policy, Next::Report(impact)))
    }

    /// The orbit of a disk that leaves the platform with this launch.
    #[must_use]
    pub fn orbit_from_launch(&self, launch: Launch, policy: ChatterPolicy) -> Orbit<L> {
        Orbit::new(self.clone(), policy, Next::Launch(launch.phase(), launch.relative_speed()))
    }
}

/// One event of the vertical motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum OrbitEvent {
    /// The disk hits the platform.
    Impact(Impact),
    /// The disk comes to rest on the platform. On a sine it separates again as the platform falls away; on a
    /// drive the separation is an event of its own. In a compliant contact the disk stays forever; the error
    /// bound is infinite if this is only inferred from 4096 turns of the spring without a release.
    Attachment(Attachment),
    /// On a drive: the disk leaves, because the contact force falls to zero or the velocity of the platform
    /// drops.
    Separation(ContactChange),
    /// On a drive: the velocity of the platform jumps up and hits the disk that rests on it, at zero
    /// distance.
    Kick(ContactChange),
}

/// The end of a contact as an event.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedChange"))]
pub struct ContactChange {
    /// The time since the disk came to rest, in radians.
    pub duration: f64,
    /// The phase of the event.
    pub phase: Phase,
    /// How many times the phase has passed 0 (mod 2 pi) since the disk came to rest.
    pub turns: u64,
    /// The velocity of the disk relative to the platform just after the platform's velocity has jumped,
    /// before any law of impact applies. It is zero or positive for a separation, negative for a kick.
    pub velocity: f64,
}

read_checked!(ContactChange as UncheckedChange { duration: f64, phase: Phase, turns: u64, velocity: f64 });

impl ContactChange {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        not_negative("duration of a contact", self.duration)?;
        finite("velocity at the end of a contact", self.velocity).map(|_| ())
    }
}

/// A segment of contact between the end of a chattering sequence and the next separation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedAttachment"))]
pub struct Attachment {
    /// The accumulation point, where the disk attaches. Under [`ChatterPolicy::Cut`] it is the last impact
    /// itself, with duration zero. A cut under a constant restitution has no bound on the remainder:
    /// `error_bound` is infinite unless the speed was 0. Under another law the bound is
    /// [`ImpactMap::comes_to_rest_within`], infinite if this is `None`.
    pub accumulation: Accumulation,
    /// Launch speed after the last impact, in units of g/omega, from which the chatter started.
    pub last_speed: f64,
    /// The phase of the next separation, and how many times the phase passes 0 (mod 2 pi) between attachment
    /// and separation; `None` on a drive, and if the disk rests forever (P <= 1).
    pub separation: Option<(Phase, u64)>,
}

read_checked!(Attachment as UncheckedAttachment {
    accumulation: Accumulation,
    last_speed: f64,
    separation: Option<(Phase, u64)>,
});

impl Attachment {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        not_negative("last_speed", self.last_speed)?;
        if let Some((_, turns)) = self.separation {
            within("turns before the separation", turns as f64, 0.0, 1.0, "0 or 1")?;
        }
        Ok(())
    }
}

/// The next motion of the disk.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Next {
    /// Leave the platform at this phase and speed.
    Launch(Phase, f64),
    /// Report this impact, already found.
    Report(Impact),
    /// Come to rest.
    Attach(Accumulation, f64),
    /// Report this error.
    Fail(Error),
    /// Nothing more: the disk rests forever, or an error was reported.
    End,
}

/// The lazy sequence of [`OrbitEvent`]s of one orbit. It ends if the disk rests forever, and after an error.
#[derive(Debug, Clone)]
pub struct Orbit<L = Constant> {
    map: ImpactMap<L>,
    policy: ChatterPolicy,
    short_flights: ShortFlightCount,
    next: Next,
}

impl Orbit {
    /// Ends the flight in `state`, computed elsewhere from [`Self::launch`].
    #[inline(always)]
    pub(crate) fn land(&mut self, state: ImpactState, duration: f64) {
        let speed = -self.map.restitution() * state.velocity;
        self.next = self.after(state.phase, state.velocity, speed, duration);
    }
}

impl<L: RestitutionLaw> Orbit<L> {
    #[inline]
    fn new(map: ImpactMap<L>, policy: ChatterPolicy, next: Next) -> Self {
        let completes = policy == ChatterPolicy::Complete && map.restitution.constant(Internal).is_none();
        let next = if completes { Next::Fail(Error::NoClosedForm) } else { next };
        Self { map, policy, short_flights: ShortFlightCount::new(), next }
    }

    fn after_impact(map: ImpactMap<L>, policy: ChatterPolicy, state: ImpactState) -> Self {
        let speed = map.rebound_speed(state.velocity);
        let mut orbit = Self::new(map, policy, Next::End);
        if orbit.next == Next::End {
            orbit.next = match speed {
                Ok(speed) => orbit.after(state.phase, state.velocity, speed, f64::INFINITY),
                Err(error) => Next::Fail(error),
            };
        }
        orbit
    }

    /// The motion after an impact at `phase` with relative `velocity`. The impact ends a flight of `duration`
    /// and launches the disk with `speed`.
    fn after(&mut self, phase: Phase, velocity: f64, speed: f64, duration: f64) -> Next {
        match self.policy {
            ChatterPolicy::Complete => {
                let constant = self.map.restitution.constant(Internal);
                match constant
                    .and_then(|restitution| self.map.vibration.accumulation(phase, speed, restitution))
                {
                    // A chatter of zero duration has no impacts.
                    Some(at) => Next::Attach(at, if at.duration > 0.0 { speed } else { 0.0 }),
                    None => Next::Launch(phase, speed),
                }
            }
            ChatterPolicy::Cut(cut) => {
                // A disk without rebound speed is on the platform, cut or not.
                if !self.short_flights.attaches(&cut, duration, -velocity) && speed > 0.0 {
                    Next::Launch(phase, speed)
                } else if self.map.vibration.falls_away_at(phase.angle()) {
                    // On a platform that falls away the disk is in flight again at once.
                    Next::Launch(phase, 0.0)
                } else {
                    let error_bound = if speed > 0.0 { self.error_of_cut(phase, velocity) } else { 0.0 };
                    Next::Attach(Accumulation { duration: 0.0, error_bound, phase, turns: 0 }, speed)
                }
            }
        }
    }

    /// Bound on the time (rad) during which the disk would go on bouncing after an impact at which a cut ends
    /// the chatter; `None` for a constant restitution, for which [`ChatterPolicy::Complete`] computes the exact
    /// time.
    fn error_of_cut(&self, phase: Phase, velocity: f64) -> f64 {
        match self.map.restitution.constant(Internal) {
            Some(_) => f64::INFINITY,
            None => {
                let impact = ImpactState::of_impact(phase, velocity);
                self.map.comes_to_rest_within(impact).unwrap_or(f64::INFINITY)
            }
        }
    }

    /// The next launch: `None` if the disk is about to attach or the orbit has ended.
    #[must_use]
    pub const fn launch(&self) -> Option<Launch> {
        match self.next {
            Next::Launch(phase, speed) => Some(Launch::known(phase, speed)),
            Next::Report(_) | Next::Attach(..) | Next::Fail(_) | Next::End => None,
        }
    }

    /// Sets the speed >= 0 of the next launch (a perturbation of a relaunch); ignored if none is due.
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

    /// The policy that ends a chatter.
    #[must_use]
    pub const fn policy(&self) -> ChatterPolicy {
        self.policy
    }

    /// The map.
    #[must_use]
    pub const fn map(&self) -> &ImpactMap<L> {
        &self.map
    }

    /// [`Self::after`] with the phase in parts: a reference would keep the impact in memory, and the next
    /// flight would wait for it.
    #[inline(never)]
    fn settle(&mut self, angle: f64, sin: f64, cos: f64, velocity: f64, speed: f64, duration: f64) {
        self.next = self.after(Phase::from_parts(angle, sin, cos), velocity, speed, duration);
    }

    #[inline]
    fn report(&mut self, impact: Impact) -> Result<Option<OrbitEvent>, Error> {
        let Some(restitution) = self.map.restitution.constant(Internal) else {
            return self.report_by_law(impact);
        };
        let (phase, speed) = (impact.phase, -restitution * impact.velocity);
        // Stored in place: nearly every impact takes this path, and the next flight waits for the result.
        if self.policy == ChatterPolicy::Complete && self.map.vibration.bounces_on(phase, speed, restitution)
        {
            self.next = Next::Launch(phase, speed);
        } else {
            self.settle_after(&impact, speed);
        }
        Ok(Some(OrbitEvent::Impact(impact)))
    }

    /// [`Self::report`] under a law that is not constant.
    #[inline(never)]
    fn report_by_law(&mut self, impact: Impact) -> Result<Option<OrbitEvent>, Error> {
        match self.map.rebound_speed(impact.velocity) {
            Ok(speed) => self.settle_after(&impact, speed),
            Err(error) => {
                self.next = Next::End;
                return Err(error);
            }
        }
        Ok(Some(OrbitEvent::Impact(impact)))
    }

    #[inline(always)]
    fn settle_after(&mut self, impact: &Impact, speed: f64) {
        let phase = impact.phase;
        // Only flights far below one period count as short.
        let duration = if impact.periods == 0 { impact.remainder } else { core::f64::consts::TAU };
        self.settle(phase.angle(), phase.sin(), phase.cos(), impact.velocity, speed, duration);
    }

    /// The next event, or `None` after the end of the orbit.
    ///
    /// # Errors
    /// Errors of [`Vibration::first_impact`]; [`Error::IllegalRestitution`] instead of an impact for which
    /// the law returns no legal restitution; [`Error::NoClosedForm`]. An error ends the orbit.
    // Without inlining, a motor's transient takes 2 % longer.
    #[inline(always)]
    pub fn advance(&mut self) -> Result<Option<OrbitEvent>, Error> {
        match self.next {
            Next::Launch(phase, speed) => match self.map.vibration.impact_after(phase, speed) {
                Ok(impact) => self.report(impact),
                Err(error) => {
                    self.next = Next::End;
                    Err(error)
                }
            },
            Next::Report(impact) => self.report(impact),
            Next::Fail(error) => {
                self.next = Next::End;
                Err(error)
            }
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

impl<L: RestitutionLaw> Iterator for Orbit<L> {
    type Item = Result<OrbitEvent, Error>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        self.advance().transpose()
    }
}

/// The map of a legal forcing and restitution.
#[cfg(test)]
pub(crate) fn map(axial_forcing: f64, restitution: f64) -> ImpactMap {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), restitution).expect("legal")
}
