//! Contact with a compliant stator: its start, its friction and its end.

use std::f64::consts::TAU;
use std::sync::Arc;

use bouncing_disk_core::flight::MAX_FLIGHT_DURATION;
use bouncing_disk_core::numerics::elementary::sin_cos;

use super::linear_flow::{Functional, dot, size};
use super::record::{
    CHATTER, Crossing, Launch, Next, ROUNDING, SAME, StatorEngine, closing, first_sign, lying,
};
use super::regime::{ANGLE, CLOSING, COS, ContactStiffness, GAP, N, SIN, SPEED, State};
use crate::error::Error;
use crate::motion::contact_motion::Lying;
use crate::motion::engine::Stage;
use crate::motion::state::SlipDirection;

/// If rounding cannot tell stick from slip, the present motion continues for this time (rad).
const TIE: f64 = 1.0e-6;

impl StatorEngine {
    /// The end of a contact, or of sliding or sticking within it.
    pub(super) fn contact_end(&mut self, slip: Option<SlipDirection>, limit: f64) -> Result<Next, Error> {
        if self.lies_for_ever() {
            return Ok(None);
        }
        let regimes = Arc::clone(&self.system.regimes);
        let regime = &regimes[self.line][self.regime_index()];
        let step = regime.flow.step();
        let mut watched: Vec<(&Functional<N>, Crossing)> = vec![(&regime.force, Crossing::Release)];
        for (node, line) in regime.nodes.iter().zip([self.line.wrapping_sub(1), self.line + 1]) {
            watched.extend(node.iter().map(|node| (node, Crossing::LoadNode(line))));
        }
        if self.system.base.friction() > 0.0 {
            if slip.is_some() {
                watched.push((&regime.slip, Crossing::SlipEnd));
            } else {
                watched.push((&regime.hold[0], Crossing::Slips(SlipDirection::Backward)));
                watched.push((&regime.hold[1], Crossing::Slips(SlipDirection::Forward)));
            }
        }
        let mut resting = vec![false; watched.len()];
        let (mut passed, mut state, mut begun) = (0.0, self.state, self.state);
        let mut steps: u64 = 0;
        let whole = (TAU / step + 0.5) as u64;
        loop {
            let left = limit - passed;
            if left <= 0.0 {
                return Ok(None);
            }
            let mut first: Next = None;
            for (index, (functional, crossing)) in watched.iter().enumerate() {
                if resting[index] {
                    continue;
                }
                let error = ROUNDING * (steps as f64).sqrt() * size(functional.now(), &state);
                let (mut along, mut from) = (functional.along(&state, error), 0.0);
                if passed == 0.0 {
                    match first_sign(&regime.flow, functional.now(), &self.state) {
                        Some((order, false))
                            if order > 0 && *crossing == Crossing::Release && self.touches(&self.state) =>
                        {
                            from = TIE;
                        }
                        Some((_, false)) if self.ties < 2 || !crossing.is_of_friction() => {
                            return Ok(Some((0.0, *crossing)));
                        }
                        Some((_, false)) => from = TIE,
                        Some((0, true)) => {}
                        Some((order, true)) if order < 4 => along = along.starting_with(&[0.0; 3][..order]),
                        // It rests at zero, or leaves it too slowly to tell yet.
                        _ => {
                            resting[index] = true;
                            continue;
                        }
                    }
                }
                let until = first.map_or(left, |(at, _)| at);
                let mut fall = along.first_fall_from(from, until)?;
                if *crossing == Crossing::Release
                    && let Some([at, _]) = fall
                    && self.touches(&regime.flow.after(&state, at))
                {
                    fall = along.first_fall_from(at + TIE, until)?;
                }
                if let Some([at, _]) = fall
                    && at < until
                {
                    first = Some((at, *crossing));
                }
            }
            if let Some((at, crossing)) = first {
                return Ok(Some((passed + at, crossing)));
            }
            if left < step {
                // Anything later in this step has not been searched.
                return Ok(None);
            }
            steps += 1;
            passed = steps as f64 * step;
            state = regime.flow.advance(&state);
            // A whole number of steps makes a period.
            (state[SIN], state[COS]) = sin_cos(self.now.phase.angle() + (steps % whole) as f64 * step);
            if steps.is_multiple_of(whole) {
                if repeats(&begun, &state) {
                    // Whether the drifting speed reaches the end of the slide or another piece of the load.
                    let gained = state[SPEED] - begun[SPEED];
                    let drifts = gained.abs() > SAME * (1.0 + state[SPEED].abs());
                    let direction = slip.map_or(0.0, SlipDirection::sign);
                    let slides_on = direction * gained >= 0.0 || self.system.base.friction() == 0.0;
                    let node = usize::from(gained > 0.0);
                    if !drifts || slides_on && regime.nodes[node].is_none() {
                        self.stage = Stage::Lying(Lying { slip, end: None });
                        return Ok(None);
                    }
                }
                begun = state;
            }
            if passed > MAX_FLIGHT_DURATION {
                return Err(Error::SlipTooLong { duration: passed, limit: MAX_FLIGHT_DURATION });
            }
        }
    }

    /// Whether the force of a rigid contact would be below zero for less time than a truncated chatter lasts,
    /// in a flight no higher than its rounding.
    fn touches(&self, state: &State) -> bool {
        let flow = &self.regime().flow;
        let slope = flow.derivative(self.regime().force.now());
        let bend = dot(&flow.derivative(&slope), state);
        self.system.contact == ContactStiffness::Rigid
            && bend > 0.0
            && dot(&slope, state) > -0.5 * CHATTER * bend
    }

    /// Angular speed of the disk minus the stator's.
    pub(super) fn slip(&self) -> f64 {
        self.state[SPEED] - self.system.twist(&self.state)[1]
    }

    /// Whether friction holds, or otherwise the direction in which the disk slides; `spent` is the slide that
    /// has just ended.
    pub(super) fn onset(&self, spent: Option<SlipDirection>) -> Option<SlipDirection> {
        if self.system.base.friction() == 0.0 {
            // Without friction nothing holds it.
            return Some(SlipDirection::Forward);
        }
        if spent.is_none()
            && let Some(direction) = SlipDirection::of(self.slip())
        {
            return Some(direction);
        }
        let stick = &self.system.regimes[self.line][1];
        let gives = |hold: &Functional<N>| {
            let (value, doubt) = (dot(hold.now(), &self.state), ROUNDING * size(hold.now(), &self.state));
            let first = stick.flow.derivative(hold.now());
            value < -doubt || value <= doubt && dot(&first, &self.state) < 0.0
        };
        [(&stick.hold[0], SlipDirection::Backward), (&stick.hold[1], SlipDirection::Forward)]
            .into_iter()
            .find(|&(hold, direction)| Some(direction) != spent && gives(hold))
            .map(|(_, direction)| direction)
    }

    /// A disk on a rigid stator without relative velocity: it stays, or flies at once if the stator falls
    /// away.
    pub(super) fn lie_down(&mut self) {
        (self.state[GAP], self.state[CLOSING]) = (0.0, 0.0);
        self.settle_slip();
        self.stage = lying(self.onset(None));
        if first_sign(&self.regime().flow, self.regime().force.now(), &self.state) == Some((0, false)) {
            self.stage = Stage::Flight(Launch::Rebound);
        }
    }

    /// A disk in flight that touches a rigid stator: if its relative velocity is no larger than rounding and
    /// the stator falls away, it flies.
    pub(super) fn leave(&mut self) {
        let [_, tip] = self.system.tip(&self.state);
        if self.state[CLOSING].abs() > ROUNDING * tip.abs() {
            return;
        }
        self.state[CLOSING] = 0.0;
        let flow = &self.system.regimes[self.line][0].flow;
        match first_sign(flow, &flow.derivative(&closing()), &self.state) {
            Some((0, true)) => self.stage = Stage::Flight(Launch::Rebound),
            Some((1, true)) => {
                let third = dot(&flow.derivative(&flow.derivative(&closing())), &self.state);
                self.stage = Stage::Flight(Launch::Release(third));
            }
            _ => self.lie_down(),
        }
    }

    /// A disk in a compliant contact, sticking or slipping.
    pub(super) fn press(&mut self) {
        self.settle_slip();
        self.stage = lying(self.onset(None));
        if first_sign(&self.regime().flow, self.regime().force.now(), &self.state) == Some((0, false)) {
            self.stage = Stage::Flight(if self.state[GAP] < 0.0 { Launch::Below } else { Launch::Rebound });
        }
    }

    /// A slip no larger than rounding counts as zero.
    fn settle_slip(&mut self) {
        let slip = self.system.regimes[self.line][0].slip.now();
        if dot(slip, &self.state).abs() <= 0.125 * ROUNDING * size(slip, &self.state) {
            self.state[SPEED] = self.system.twist(&self.state)[1];
        }
    }
}

/// Whether a contact has returned to its state one period before, apart from the disk's angle and speed.
pub(super) fn repeats(before: &State, after: &State) -> bool {
    let size = after[..ANGLE].iter().fold(1.0, |size: f64, value| size.max(value.abs()));
    (0..ANGLE).all(|index| (after[index] - before[index]).abs() <= SAME * size)
}
