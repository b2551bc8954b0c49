//! A disk on a driven platform: how long friction holds it, when a slip ends, and the motion and work of a
//! slide.
//!
//! In direction d (+1: the disk is ahead) the slip speed U = d (q - beta') grows at the rate
//!
//! ```text
//! U' = -mu (1 + s'') - d (l + beta''),   U = U_0 - (mu + d l) t - mu (s' - s'_0) - d (beta' - beta'_0)
//! ```
//!
//! A disk sticks while the rate is positive in neither direction. Between two joints both functions are
//! polynomials and sines, so the core's first-root search misses no event.

use std::f64::consts::TAU;

use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_drives::Drive;
use bouncing_disk_drives::compliance::{Pressed, SpringState};
use bouncing_disk_drives::drive::TimeAhead;
use bouncing_disk_drives::quasi_polynomial::{FirstRoot, QuasiPolynomial};

use super::DrivenSystem;
use crate::error::Error;
use crate::motion::gauss::EIGHT_POINTS;
use crate::motion::rotary_change::RotaryChange;
use crate::motion::state::{DiskState, SlipDirection};

/// Rounding of a rate, relative to its terms.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Integrals over at least this many radians of the fastest oscillation are evaluated in closed form. Over
/// shorter spans, the sines that make up force and slip are much larger than their sums, and so is their
/// rounding.
const LONG: f64 = 4.0;

/// The integrals that the energy of a slide needs: of N beta' and of N U, with the magnitudes of their terms.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SlideWork {
    pub(super) carried: f64,
    pub(super) slipped: f64,
    pub(super) size: f64,
}

/// The support of the disk: a platform on which it lies, or a compliant contact at a given time after its
/// start.
#[derive(Debug, Clone, Copy)]
pub(super) enum Ride<'a> {
    Platform(&'a Drive),
    Pressed(&'a Pressed, f64),
}

impl Ride<'_> {
    /// Acceleration of the disk, and its derivative.
    fn acceleration(&self, at: f64) -> [f64; 2] {
        match self {
            Self::Platform(drive) => {
                let state = drive.at(at);
                [state.acceleration, state.jerk]
            }
            Self::Pressed(pressed, after) => {
                let force = pressed.force().at(*after, *after);
                [force.value - 1.0, force.slope]
            }
        }
    }

    /// Velocity (order 1) or acceleration (order 2) from `at` on, up to a constant in the velocity.
    fn derivative(&self, order: u32, at: f64) -> QuasiPolynomial {
        match self {
            Self::Platform(drive) => drive.derivative(order, at),
            Self::Pressed(pressed, _) if order == 1 => pressed.velocity_change(),
            Self::Pressed(pressed, _) => pressed.force().clone() + -1.0,
        }
    }

    /// The change of the motion as from [`Drive::change`].
    pub(super) fn change(&self, at: f64, span: f64) -> (f64, f64) {
        match self {
            Self::Platform(drive) => drive.change(at, span),
            Self::Pressed(pressed, _) => {
                (pressed.velocity_change().at(span, span).value, pressed.lift().at(span, span).value)
            }
        }
    }

    fn next_joint(&self, at: f64) -> Option<TimeAhead> {
        match self {
            Self::Platform(drive) => drive.next_joint(at),
            Self::Pressed(..) => None,
        }
    }

    /// Radians of the fastest oscillation per radian of the drive.
    fn rate(&self) -> f64 {
        match self {
            Self::Platform(drive) => drive.highest_harmonic(),
            Self::Pressed(pressed, _) => pressed.rate(),
        }
    }
}

/// A disk in contact: the system and the support.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touching<'a> {
    pub(super) system: &'a DrivenSystem,
    pub(super) ride: Ride<'a>,
}

impl Touching<'_> {
    /// The rate at which the slip in `direction` grows, its derivative, and the rounding of both.
    pub(super) fn growth(&self, direction: SlipDirection, at: f64) -> ([f64; 2], [f64; 2]) {
        let ([pull, pull_change], beta, d, mu) =
            (self.ride.acceleration(at), self.system.angle.at(at), direction.sign(), self.system.friction);
        let rate = -mu * (1.0 + pull) - d * (self.system.load + beta.acceleration);
        let size = mu * (1.0 + pull.abs()) + self.system.load.abs() + beta.acceleration.abs();
        let change = -(mu * pull_change + d * beta.jerk);
        // The time is rounded, too.
        let change_size = mu * pull_change.abs() + beta.jerk.abs();
        ([rate, change], [ROUNDING * (size + (1.0 + at.abs()) * change_size), ROUNDING * change_size])
    }

    /// The direction in which a disk at the platform's speed slips at once; `None` if friction holds it.
    pub(super) fn onset(&self, at: f64, spent: Option<SlipDirection>) -> Option<SlipDirection> {
        if self.is_unloaded() {
            return None;
        }
        [SlipDirection::Forward, SlipDirection::Backward]
            .into_iter()
            .filter(|&direction| Some(direction) != spent)
            .find(|&direction| {
                let ([rate, change], [doubt, _]) = self.growth(direction, at);
                rate > doubt || rate >= -doubt && change > 0.0
            })
    }

    /// Whether no torque acts, so that friction holds the disk to the end of the contact.
    fn is_unloaded(&self) -> bool {
        self.system.angle.bounds().speed == 0.0 && self.system.load == 0.0
    }

    /// The time for which friction holds a disk at `at` and the direction in which it then slips, if friction
    /// gives way within `limit`.
    pub(super) fn stick_end(&self, at: f64, limit: f64) -> Result<Option<(f64, SlipDirection)>, Error> {
        if self.is_unloaded() {
            return Ok(None);
        }
        // An event that does not happen within a period never does.
        let limit = if self.repeats() { limit.min(TAU) } else { limit };
        let mut first: Option<(f64, SlipDirection)> = None;
        for direction in [SlipDirection::Forward, SlipDirection::Backward] {
            let limit = first.map_or(limit, |(after, _)| after);
            let found = self.first_fall(at, limit, |here, _| {
                let ([rate, change], [doubt, change_doubt]) = self.growth(direction, here);
                // A hold that is pure rounding at its start has ended, or begins here.
                let spare = match rate.abs() <= doubt {
                    true if change < -change_doubt => 0.0,
                    true if change <= change_doubt => doubt,
                    _ => -rate,
                };
                let error = if spare == 0.0 { 0.0 } else { doubt };
                let holds = spare >= -doubt && (spare > 0.0 || change < 0.0);
                let pull = || self.pull_on(2, direction, here);
                holds.then(|| pull().starting_with([spare, -change], [error, change_doubt]))
            })?;
            if let Some(after) = found
                && first.is_none_or(|(earliest, _)| after < earliest)
            {
                first = Some((after, direction));
            }
        }
        Ok(first)
    }

    /// The time at which the slip in `direction`, with `speed` >= 0 at `at`, ends, if within `limit`.
    ///
    /// # Errors
    /// [`Error::SlipTooLong`] if the end is too far away to be resolved.
    pub(super) fn slip_end(
        &self,
        direction: SlipDirection,
        at: f64,
        speed: f64,
        limit: f64,
    ) -> Result<Option<f64>, Error> {
        let window = if self.repeats() { limit.min(TAU) } else { limit };
        if let Some(after) = self.slip_end_within(direction, at, speed, window)? {
            return Ok(Some(after));
        }
        let loss = TAU * (self.system.friction + direction.sign() * self.system.load);
        if window >= limit || loss <= 0.0 {
            return Ok(None);
        }
        // Each period reduces the slip by the loss; bisection finds the first period in which it ends.
        let most = MAX_FLIGHT_DURATION / TAU + 2.0;
        let (mut lasts, mut ends) = (0.0, ceiling((speed / loss).min(most)).max(1.0));
        while ends - lasts > 1.0 {
            let middle = lasts + ceiling(0.5 * (ends - lasts));
            let left = speed - middle * loss;
            if left <= 0.0 || self.slip_end_within(direction, at, left, TAU)?.is_some() {
                ends = middle;
            } else {
                lasts = middle;
            }
        }
        // If no slip is left at the start of a period, it ended at the very end of the one before.
        let left = speed - ends * loss;
        let within = if left > 0.0 { self.slip_end_within(direction, at, left, TAU)? } else { Some(0.0) };
        let duration = ends * TAU + within.unwrap_or(0.0);
        if duration > limit {
            return Ok(None);
        }
        if duration > MAX_FLIGHT_DURATION {
            return Err(Error::SlipTooLong { duration, limit: MAX_FLIGHT_DURATION });
        }
        Ok(Some(duration))
    }

    fn slip_end_within(
        &self,
        direction: SlipDirection,
        at: f64,
        speed: f64,
        limit: f64,
    ) -> Result<Option<f64>, Error> {
        let mut last = (at, 0.0, speed);
        self.first_fall(at, limit, |here, passed| {
            let value = self.carried(direction, last, passed);
            last = (here, passed, value);
            let ([rate, change], [doubt, _]) = self.growth(direction, here);
            if value <= 0.0 && (rate <= doubt && change <= 0.0 || rate < -doubt) {
                return None;
            }
            Some(self.slip_from(direction, here, value, doubt))
        })
    }

    /// The slip speed from `here` on, with this initial value and a rate known to `doubt`.
    fn slip_from(&self, direction: SlipDirection, here: f64, value: f64, doubt: f64) -> QuasiPolynomial {
        let ([rate, _], _) = self.growth(direction, here);
        let (value, error) = if value > 0.0 { (value, ROUNDING * value) } else { (0.0, 0.0) };
        // Rounding must not end a slip that begins here.
        let rate = if value == 0.0 && rate.abs() <= doubt { 0.0 } else { rate };
        (self.pull_on(1, direction, here) * -1.0).starting_with([value, rate], [error, doubt])
    }

    /// mu s + d beta, or a derivative of it.
    fn pull_on(&self, order: u32, direction: SlipDirection, here: f64) -> QuasiPolynomial {
        self.ride.derivative(order, here) * self.system.friction
            + self.system.angle.derivative(order, here) * direction.sign()
    }

    /// The slip speed when the time `passed` has passed, from the `last` position, the time passed by then, and
    /// the speed there.
    fn carried(&self, direction: SlipDirection, last: (f64, f64, f64), passed: f64) -> f64 {
        let (at, then, speed) = last;
        let span = passed - then;
        if span <= 0.0 {
            return speed;
        }
        let d = direction.sign();
        let (lifted, turned) = (self.ride.change(at, span).0, self.system.angle.change(at, span).0);
        speed
            - ((self.system.friction + d * self.system.load) * span
                + self.system.friction * lifted
                + d * turned)
    }

    /// The interval of length `span` from `at`, divided at the joints of height and angle: for each stretch
    /// its start, the time passed before it, and its length.
    fn stretches(&self, at: f64, span: f64) -> impl Iterator<Item = (f64, f64, f64)> {
        let mut next = Some((at, 0.0));
        std::iter::from_fn(move || {
            let (here, passed) = next.take()?;
            let joints = [self.ride.next_joint(here), self.system.angle.next_joint(here)];
            let joint = joints.into_iter().flatten().min_by(|a, b| a.after.total_cmp(&b.after));
            let left = span - passed;
            next = joint.filter(|joint| joint.after < left).map(|joint| (joint.time, passed + joint.after));
            Some((here, passed, joint.map_or(left, |joint| joint.after.min(left))))
        })
    }

    /// The first time at which a function falls through zero, searched joint by joint. `of` returns the
    /// function from a time on (given also the time passed before it), or `None` if it has already fallen.
    fn first_fall(
        &self,
        at: f64,
        limit: f64,
        mut of: impl FnMut(f64, f64) -> Option<QuasiPolynomial>,
    ) -> Result<Option<f64>, Error> {
        for (here, passed, step) in self.stretches(at, limit) {
            let Some(function) = of(here, passed) else { return Ok(Some(passed)) };
            let mut from = 0.0;
            while from < step {
                match function.first_root(from, step)? {
                    FirstRoot::Root(root) => return Ok(Some((passed + root.at).min(limit))),
                    FirstRoot::None { .. } => break,
                    // A touch hidden by rounding: the sign of the value decides.
                    FirstRoot::Undecided { at, value, .. } if value < 0.0 => return Ok(Some(passed + at)),
                    FirstRoot::Undecided { until, .. } => from = until,
                }
            }
        }
        Ok(None)
    }

    /// A slide of length `span` from `at` in `direction`, for a disk with angular `speed`.
    pub(super) fn slide(&self, direction: SlipDirection, speed: f64, at: f64, span: f64) -> RotaryChange {
        let (velocity, lift) = self.ride.change(at, span);
        let (grip, load) = (direction.sign() * self.system.friction, self.system.load);
        RotaryChange {
            speed: speed - (grip * (span + velocity) + load * span),
            angle: span * (speed - 0.5 * load * span) - grip * (0.5 * span * span + lift),
        }
    }

    /// The integrals of a slide of length `span` that starts with this slip `speed` at `at`.
    pub(super) fn slide_work(&self, direction: SlipDirection, at: f64, speed: f64, span: f64) -> SlideWork {
        let periods = if self.repeats() { whole(span / TAU) } else { 0.0 };
        let mut work = SlideWork::default();
        if periods > 0.0 {
            let one = self.slide_work_within(direction, at, speed, TAU);
            // In each period the slip decreases by the loss; the impulse of the force over a period is 2 pi.
            let loss = TAU * (self.system.friction + direction.sign() * self.system.load);
            work.carried = periods * one.carried;
            work.slipped = periods * one.slipped - TAU * loss * 0.5 * periods * (periods - 1.0);
            work.size = periods * one.size + TAU * loss.abs() * periods * periods;
        }
        let loss = periods * TAU * (self.system.friction + direction.sign() * self.system.load);
        let rest = self.slide_work_within(direction, at, speed - loss, span - periods * TAU);
        work.carried += rest.carried;
        work.slipped += rest.slipped;
        work.size += rest.size;
        work
    }

    fn slide_work_within(&self, direction: SlipDirection, at: f64, speed: f64, span: f64) -> SlideWork {
        if let Some(work) = self.pressed_slide_work(direction, at, speed, span) {
            return work;
        }
        let number = self.ride.rate().max(self.system.angle.highest_harmonic());
        let (mut last, mut work) = ((at, 0.0, speed), SlideWork::default());
        let stretches = self.stretches(at, span).take_while(|&(_, passed, _)| passed < span);
        for (here, passed, stretch) in stretches {
            // The eight-point rule is exact to rounding over one radian of the highest harmonic.
            let panels = whole(stretch * number) + 1.0;
            let value = self.carried(direction, last, passed);
            last = (here, passed, value);
            let (slip, force, carrier) = (
                self.slip_from(direction, here, value, 0.0),
                self.ride.derivative(2, here) + 1.0,
                self.system.angle.derivative(1, here),
            );
            at_nodes(stretch, panels, |x, weight| {
                let force = weight * force.at(x, stretch).value;
                let (carrier, slip) = (carrier.at(x, stretch).value, slip.at(x, stretch).value);
                work.carried += force * carrier;
                work.slipped += force * slip;
                work.size += force.abs() * (carrier.abs() + slip.abs());
            });
        }
        work
    }

    /// [`Self::slide_work`] in a compliant contact, in closed form.
    fn pressed_slide_work(
        &self,
        direction: SlipDirection,
        at: f64,
        speed: f64,
        span: f64,
    ) -> Option<SlideWork> {
        let Ride::Pressed(pressed, _) = self.ride else { return None };
        if span * pressed.rate() < LONG {
            return None;
        }
        let (d, mu, load) = (direction.sign(), self.system.friction, self.system.load);
        let platform = self.system.angle.velocity_as_sum(at);
        let gained = pressed.velocity_change();
        let impulse = gained.at(span, span).value + span;
        let ahead = speed + d * self.system.angle.velocity(at);
        let slip = (gained * -mu + platform.clone() * -d).plus_line(ahead, -(mu + d * load));
        // The impulse is a difference of speeds of the platform.
        let carried = mu * (impulse.abs() + self.system.height.bounds().speed);
        let size = self.system.angle.bounds().speed + speed + carried + load.abs() * span;
        Some(SlideWork {
            carried: pressed.force().product_integral(&platform, span)?,
            slipped: pressed.force().product_integral(&slip, span)?,
            size: impulse.abs() * size,
        })
    }

    /// Energies of a compliant contact: the work of the platform over the next `span`, the loss in the damper, and
    /// the gap at the start and at the end.
    pub(super) fn normal_work(&self, start: &DiskState, at: f64, span: f64) -> (f64, f64, [f64; 2]) {
        let Some(compliant) = &self.system.compliance else { return (0.0, 0.0, [0.0; 2]) };
        let drive = compliant.drive();
        let (periods, rest) = if self.repeats() {
            let periods = whole(span / TAU);
            (periods, span - periods * TAU)
        } else {
            (0.0, span)
        };
        let (whole_work, whole_loss) =
            if periods > 0.0 { self.normal_work_within(start, at, TAU) } else { (0.0, 0.0) };
        let (work, loss) = self.normal_work_within(start, at, rest);
        let here = drive.at(at);
        let (lifted, raised) = (self.ride.change(at, rest).1, drive.change(at, rest).1);
        let gap = start.height - here.height;
        let end = gap + rest * (start.axial_velocity - here.velocity) + (lifted - raised);
        let mut lost = periods * whole_loss + loss;
        if let Ride::Pressed(pressed, _) = self.ride
            && pressed.spring_state() == SpringState::Loading
        {
            // Energy that the spring absorbs in loading and does not return.
            let kept = compliant.compliance().stiffness() - compliant.compliance().unloading_stiffness();
            lost += 0.5 * kept * (end - gap) * (end + gap);
        }
        (periods * whole_work + work, lost, [gap, end])
    }

    fn normal_work_within(&self, start: &DiskState, at: f64, span: f64) -> (f64, f64) {
        let Some(compliant) = &self.system.compliance else { return (0.0, 0.0) };
        let drive = compliant.drive();
        let force = self.ride.derivative(2, at) + 1.0;
        let platform = drive.velocity_as_sum(at);
        let disk = self.ride.derivative(1, at);
        let offset = start.axial_velocity - disk.at(0.0, 0.0).value;
        let relative = disk + offset + platform.clone() * -1.0;
        let damping = compliant.compliance().damping();
        if span * self.ride.rate() >= LONG
            && let Some(work) = force.product_integral(&platform, span)
            && let Some(squares) = relative.product_integral(&relative, span)
        {
            return (work, damping * squares);
        }
        let (mut work, mut loss) = (0.0, 0.0);
        at_nodes(span, whole(span * self.ride.rate()) + 1.0, |x, weight| {
            let velocity = relative.at(x, span).value;
            work += weight * force.at(x, span).value * platform.at(x, span).value;
            loss += weight * velocity * velocity;
        });
        (work, damping * loss)
    }

    fn repeats(&self) -> bool {
        matches!(self.ride, Ride::Platform(_))
    }
}

/// Calls `add` with each node and weight of the eight-point rule in each of the equal panels of a span.
fn at_nodes(span: f64, panels: f64, mut add: impl FnMut(f64, f64)) {
    let half = 0.5 * span / panels;
    let mut panel = 0.0;
    while panel < panels {
        let middle = (2.0 * panel + 1.0) * half;
        for (node, weight) in EIGHT_POINTS {
            for x in [middle - half * node, middle + half * node] {
                add(x, half * weight);
            }
        }
        panel += 1.0;
    }
}

/// The whole part of a number >= 0.
fn whole(number: f64) -> f64 {
    if number < 9.0e15 { (number as u64) as f64 } else { number }
}

/// The smallest whole number that is not less than a number >= 0.
fn ceiling(number: f64) -> f64 {
    let floor = whole(number);
    if floor < number { floor + 1.0 } else { floor }
}
