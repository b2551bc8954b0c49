//! The final state of a motion on a compliant stator, from which another motor may continue.

use crate::motion::phase_time::PhaseTime;
use crate::parameters::scales::Scales;
use crate::stator::{MODES, StatorEngine, StatorState};

/// The final state of a rotor on a compliant stator.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Left {
    pub(crate) time: PhaseTime,
    pub(crate) state: StatorState,
    /// Whether the coordinate of a mode is a height.
    rises: [bool; MODES],
}

impl Left {
    /// The state of an engine at a time before its next event.
    pub(crate) fn of(engine: &StatorEngine, time: PhaseTime) -> Self {
        let state = engine.state_after(time.since(&engine.time()).radians()).1;
        Self { time, state, rises: engine.system().modes.map(|mode| mode.height != 0.0) }
    }

    /// The state converted to SI units, or from SI units if `of` is `f64::recip`; time and angle start again
    /// at zero.
    pub(crate) fn scaled(self, unit: &Scales, of: fn(f64) -> f64) -> Self {
        let (mut state, time) = (self.state, PhaseTime::in_first_period(self.time.phase));
        state.disk.height *= of(unit.length);
        state.disk.axial_velocity *= of(unit.velocity);
        (state.disk.angle, state.disk.angular_speed) =
            (0.0, state.disk.angular_speed * of(unit.angular_speed));
        for ([place, speed], rises) in state.modes.iter_mut().zip(self.rises) {
            *place *= of(if rises { unit.length } else { unit.angle });
            *speed *= of(if rises { unit.velocity } else { unit.angular_speed });
        }
        Self { time, state, ..self }
    }
}
