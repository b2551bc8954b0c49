//! The map from one release of a compliant contact to the next, with its derivative
//! (docs/numerics-dynamics.md, "The release map").

use core::f64::consts::TAU;

use bouncing_disk_core::chatter::Accumulation;
use bouncing_disk_core::numerics::elementary::nearest_whole;
use bouncing_disk_core::{Error, Impact, Phase};
use glam::{DMat2, DVec2};

use crate::compliance::{CompliantPlatform, ContactEnd, Pressed, RelativeState, SpringState, Touch};
use crate::drive::landing::DrivenImpact;
use crate::quasi_polynomial::QuasiPolynomial;

/// Turns of a spring after which a contact counts as lasting forever.
const MAX_TURNS: u32 = 4_096;

/// The end of a flight and the following contact, or of a contact alone.
pub(crate) struct Cycle {
    duration: f64,
    turns: u64,
    state: RelativeState,
    /// Bound on the error of the duration after which a disk has settled; `None` if it is released.
    settled: Option<f64>,
}

impl Cycle {
    /// The accumulation point, if the disk settles forever.
    pub(crate) fn accumulation(&self) -> Option<Accumulation> {
        let &Self { duration, turns, state, settled } = self;
        settled.map(|error_bound| Accumulation {
            duration,
            error_bound,
            phase: Phase::of_angle(state.time),
            turns,
        })
    }

    /// The impact whose rebound with this restitution is the release.
    pub(crate) fn impact(&self, restitution: f64) -> DrivenImpact {
        let periods = (self.duration / TAU).floor();
        let impact = Impact {
            periods: periods as u64,
            remainder: (self.duration - periods * TAU).max(0.0),
            turns: self.turns,
            phase: Phase::of_angle(self.state.time),
            velocity: -self.state.velocity / restitution,
            evaluations: 0,
        };
        DrivenImpact { impact, error: f64::INFINITY, on_kink: false, doubt: None }
    }
}

impl CompliantPlatform {
    /// The disk just after a release at this speed.
    pub(crate) fn released_at(&self, time: f64, velocity: f64) -> RelativeState {
        RelativeState { time, gap: self.gap_by_speed() * velocity, velocity }
    }

    /// The gap at a release divided by the release speed.
    fn gap_by_speed(&self) -> f64 {
        -self.compliance().damping() / self.compliance().stiffness()
    }

    /// The relative acceleration of a disk under this force.
    fn acceleration(&self, force: f64, time: f64) -> f64 {
        force - 1.0 - self.drive().at(time).acceleration
    }

    /// The matrix that maps a change of phase and speed at a release to the change of gap and velocity at a
    /// fixed time.
    pub(crate) fn change_at_release(&self, state: RelativeState) -> DMat2 {
        let by_phase = DVec2::new(-state.velocity, -self.acceleration(0.0, state.time));
        DMat2::from_cols(by_phase, DVec2::new(self.gap_by_speed(), 1.0))
    }

    /// The flight from this state to the next touch, and the contact that follows; `change` is the change of
    /// gap and velocity at a fixed time, and is replaced by the change of phase and speed at the release.
    pub(crate) fn fly_and_press(
        &self,
        from: RelativeState,
        change: Option<&mut DMat2>,
    ) -> Result<Cycle, Error> {
        let Some(Touch { duration, turns, state }) = self.touch(from, f64::INFINITY)? else {
            let (relative_speed, duration, limit) = (from.velocity, f64::INFINITY, f64::INFINITY);
            return Err(Error::FlightTooLong { relative_speed, duration, limit });
        };
        let change = change.map(|change| {
            // Free flight; at the touch the force jumps by -c y'.
            let jump = if state.gap == 0.0 { -self.compliance().damping() } else { 0.0 };
            let flown = DMat2::from_cols_array(&[1.0, 0.0, duration, 1.0]) * *change;
            *change = DMat2::from_cols_array(&[1.0, jump, 0.0, 1.0]) * flown;
            change
        });
        let contact = self.press_until_released(state, change)?;
        Ok(Cycle { duration: duration + contact.duration, turns: turns + contact.turns, ..contact })
    }

    /// Follows a contact from this state through all turns of its spring.
    pub(crate) fn press_until_released(
        &self,
        from: RelativeState,
        mut change: Option<&mut DMat2>,
    ) -> Result<Cycle, Error> {
        let (mut duration, mut turns, mut pressed) = (0.0, 0, self.press(from));
        for _ in 0..MAX_TURNS {
            let Some(end) = pressed.end(f64::INFINITY)? else { break };
            let (ContactEnd::Release(span) | ContactEnd::Settles(span) | ContactEnd::Turns(span, _)) = end;
            duration += span;
            if let Some(change) = change.as_deref_mut() {
                *change = pressed.propagator(span) * *change;
            }
            let state = match end {
                ContactEnd::Release(_) => pressed.released(span),
                ContactEnd::Settles(_) => pressed.after(span),
                ContactEnd::Turns(..) => pressed.turned(span),
            };
            let from = pressed.from().time;
            turns += nearest_whole((from + span - state.time) / TAU) as u64;
            let settled = match end {
                ContactEnd::Release(_) => {
                    if let Some(change) = change {
                        *change = pressed.change_to_release(state) * *change;
                    }
                    None
                }
                ContactEnd::Settles(_) => Some(0.0),
                ContactEnd::Turns(_, branch) => {
                    let acceleration = |branch| self.acceleration(self.force_on(branch, state), state.time);
                    if let Some(change) = change.as_deref_mut()
                        && pressed.spring_state() != SpringState::Held
                    {
                        // The force jumps as the velocity passes zero.
                        let kept = acceleration(branch) / acceleration(pressed.spring_state());
                        *change = DMat2::from_diagonal(DVec2::new(1.0, kept)) * *change;
                    }
                    pressed = self.press_on(branch, state);
                    continue;
                }
            };
            return Ok(Cycle { duration, turns, state, settled });
        }
        Ok(Cycle { duration, turns, state: *pressed.from(), settled: Some(f64::INFINITY) })
    }
}

impl Pressed {
    /// The matrix that maps a change of gap and velocity at the start to their change after `span`, both at
    /// fixed times.
    fn propagator(&self, span: f64) -> DMat2 {
        if self.spring_state() == SpringState::Held {
            return DMat2::from_diagonal(DVec2::new(1.0, 0.0));
        }
        let spring = self.platform().compliance().on(self.spring_state());
        let free = |value: f64, slope: f64| {
            let terms = spring.free(value, slope);
            let jet = QuasiPolynomial::known([value, slope], [0.0; 2], [0.0; 2], terms).at(span, span);
            DVec2::new(jet.value, jet.slope)
        };
        DMat2::from_cols(free(1.0, 0.0), free(0.0, 1.0))
    }

    /// The matrix that maps a change of gap and velocity at a fixed time to the change of phase and speed at
    /// the release in `state`.
    fn change_to_release(&self, state: RelativeState) -> DMat2 {
        let spring = self.platform().compliance().on(self.spring_state());
        let (k, c) = (spring.stiffness(), spring.damping());
        let acceleration = self.platform().acceleration(0.0, state.time);
        let fall = k * state.velocity + c * acceleration;
        let (by_gap, by_velocity) = (-k / fall, -c / fall);
        DMat2::from_cols(
            DVec2::new(by_gap, acceleration * by_gap),
            DVec2::new(by_velocity, 1.0 + acceleration * by_velocity),
        )
    }
}
