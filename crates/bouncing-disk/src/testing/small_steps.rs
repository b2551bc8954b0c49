//! The motion of a disk on s = P sin t, beta' = Q cos(t + lag) in small steps that use only the law of the
//! force.

use bouncing_disk_core::numerics::elementary::{cos, sin};

use crate::motion::state::{Mode, SlipDirection};

/// The law of motion; the state is relative gap and velocity, and the angular speed.
pub(crate) struct Law {
    pub(crate) peak: f64,
    pub(crate) twist: f64,
    pub(crate) lag: f64,
    pub(crate) friction: f64,
    pub(crate) load: f64,
    /// The spring of a compliant contact; without one the disk lies on the platform.
    pub(crate) spring: Option<Spring>,
}

pub(crate) struct Spring {
    pub(crate) loading: f64,
    pub(crate) unloading: f64,
    pub(crate) damping: f64,
}

impl Law {
    /// Angular speed of the platform.
    #[inline]
    pub(crate) fn turn(&self, t: f64) -> f64 {
        self.twist * cos(t + self.lag)
    }

    /// The friction that a disk needs to stick.
    #[inline]
    pub(crate) fn needed(&self, t: f64) -> f64 {
        self.load - self.twist * sin(t + self.lag)
    }

    /// The force of a spring whose velocity was `before` at the start of the step.
    #[inline]
    pub(crate) fn force(&self, t: f64, [y, v, _]: [f64; 3], before: f64) -> f64 {
        let held = 1.0 - self.peak * sin(t);
        let Some(Spring { loading, unloading, damping }) = self.spring else { return held };
        let y = y.min(0.0);
        let stiffness = match before {
            _ if damping > 0.0 => loading,
            _ if before < -1e-9 => loading,
            _ if before > 1e-9 => unloading,
            _ => return held.clamp(-unloading * y, -loading * y),
        };
        (-stiffness * y - damping * v).max(0.0)
    }

    fn rate(&self, t: f64, state: [f64; 3], mode: Mode, before: f64) -> [f64; 3] {
        let force = if mode == Mode::Flight { 0.0 } else { self.force(t, state, before) };
        let turn = match mode {
            Mode::Sticking => -self.twist * sin(t + self.lag),
            Mode::Sliding(direction) => -direction.sign() * self.friction * force - self.load,
            Mode::Flight => -self.load,
        };
        [state[1], force - 1.0 + self.peak * sin(t), turn]
    }

    /// A step of the classical fourth-order method.
    #[inline]
    pub(crate) fn step(&self, t: f64, state: [f64; 3], h: f64, mode: Mode) -> [f64; 3] {
        let before = state[1];
        let along = |k: [f64; 3], by: f64| [0, 1, 2].map(|i| state[i] + by * k[i]);
        let rate = |t, state| self.rate(t, state, mode, before);
        let a = rate(t, state);
        let b = rate(t + 0.5 * h, along(a, 0.5 * h));
        let c = rate(t + 0.5 * h, along(b, 0.5 * h));
        let d = rate(t + h, along(c, h));
        [0, 1, 2].map(|i| state[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]))
    }

    /// The times at which a disk that lies on the platform from `t` to `end`, starting at this angular speed,
    /// slips, sticks and reverses its slip.
    pub(crate) fn events_on_platform(&self, mut t: f64, speed: f64, end: f64) -> Vec<(f64, &'static str)> {
        const STEP: f64 = 1.0e-4;
        // Positive if friction holds the disk; otherwise, the direction in which it slips.
        let margin = |t: f64| self.friction * self.force(t, [0.0; 3], 0.0) - self.needed(t).abs();
        let slipping = |t: f64| {
            Mode::Sliding(if self.needed(t) < 0.0 { SlipDirection::Forward } else { SlipDirection::Backward })
        };
        let mut state = [0.0, 0.0, speed];
        let slip = speed - self.turn(t);
        let mut mode = match SlipDirection::of(slip).filter(|_| slip.abs() > 1e-12) {
            Some(direction) => Mode::Sliding(direction),
            None if margin(t) < 0.0 => slipping(t),
            None => Mode::Sticking,
        };
        let mut events = Vec::new();
        while t < end {
            let (share, event);
            if let Mode::Sliding(direction) = mode {
                let next = self.step(t, state, STEP, mode);
                let slips = [state[2] - self.turn(t), next[2] - self.turn(t + STEP)];
                if slips[1] * direction.sign() >= 0.0 || slips[0] == 0.0 {
                    (t, state) = (t + STEP, next);
                    continue;
                }
                share = slips[0] / (slips[0] - slips[1]);
                let held = margin(t + share * STEP) >= 0.0;
                (mode, event) = if held {
                    (Mode::Sticking, "sticks")
                } else {
                    (Mode::Sliding(direction.reversed()), "reverses")
                };
            } else {
                let margins = [margin(t), margin(t + STEP)];
                if margins[1] >= 0.0 {
                    t += STEP;
                    continue;
                }
                share = margins[0] / (margins[0] - margins[1]);
                (mode, event) = (slipping(t + STEP), "slips");
            }
            t += share * STEP;
            state = [0.0, 0.0, self.turn(t)];
            events.push((t, event));
        }
        events.retain(|event| event.0 < end);
        events
    }
}
