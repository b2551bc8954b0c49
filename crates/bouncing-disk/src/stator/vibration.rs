//! The vibration of a stator's modes under a disk.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::hypot;

use super::record::StatorEngine;
use super::regime::{COS, DISPLACEMENTS, SIN, SPEED, State, VELOCITIES};
use super::{LoadLine, MODES};
use crate::motion::contact_motion::Lying;
use crate::motion::engine::Stage;

/// The motion of a mode at an instant, as a sine about its mean position.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Vibration {
    /// Distance of the coordinate from its mean position.
    pub(crate) distance: f64,
    pub(crate) speed: f64,
    /// Frequency of the sine, in units of the drive frequency.
    pub(crate) frequency: f64,
}

impl Vibration {
    pub(super) fn amplitude(self) -> f64 {
        hypot(self.distance, self.speed / self.frequency)
    }
}

impl StatorEngine {
    /// The vibration of each mode at this time after the last event: at the drive frequency, or at its own
    /// resonance if nothing drives the modes.
    pub(crate) fn vibration_after(&self, span: f64) -> [Vibration; MODES] {
        let state = if span > 0.0 { self.carried(span) } else { self.state };
        let means = self.bent(self.mean_forces(&state, self.aloft + span));
        let still = self.system.modes.iter().all(|mode| mode.steady.iter().all(|part| *part == 0.0));
        std::array::from_fn(|index| {
            let [place, speed] = self.mode_state(index, &state);
            let frequency = if still { self.system.modes[index].stiffness.sqrt() } else { 1.0 };
            Vibration { distance: place - means[index], speed, frequency }
        })
    }

    /// The mean normal force and the mean friction torque on a disk in this state that is `aloft` for this
    /// time: its weight, and the torque that balances the load or results from slip; zero in a flight
    /// longer than a period.
    fn mean_forces(&self, state: &State, aloft: f64) -> [f64; 2] {
        match self.stage {
            Stage::Flight(_) if aloft > TAU => [0.0; 2],
            Stage::Lying(Lying { slip: Some(direction), .. }) => {
                [1.0, -direction.sign() * self.system.base.friction()]
            }
            _ => [1.0, self.held_load(state)],
        }
    }

    /// The load on a disk, up to the largest torque that friction can hold.
    fn held_load(&self, state: &State) -> f64 {
        let LoadLine { torque, slope, .. } = self.system.lines[self.line];
        let friction = self.system.base.friction();
        (torque + slope * state[SPEED]).clamp(-friction, friction)
    }

    /// The deflection of each mode by a constant normal force and torque.
    fn bent(&self, [force, torque]: [f64; 2]) -> [f64; MODES] {
        self.system.modes.map(|mode| {
            if mode.stiffness == 0.0 {
                return 0.0;
            }
            -(mode.by_force * force + mode.by_torque * torque) / mode.stiffness
        })
    }

    /// Stops the modes under a disk at rest, at their deflections by its weight and load.
    pub(crate) fn calm(&mut self) {
        let means = self.bent([1.0, self.held_load(&self.state)]);
        for (index, mean) in means.into_iter().enumerate() {
            let [place, speed] = self.system.steady(index, (self.state[SIN], self.state[COS]));
            (self.state[DISPLACEMENTS[index]], self.state[VELOCITIES[index]]) = (mean - place, -speed);
        }
        self.searched = 0.0;
        self.go_on();
    }

    /// Coordinate and speed of a mode.
    pub(super) fn mode_state(&self, index: usize, state: &State) -> [f64; 2] {
        let [place, speed] = self.system.steady(index, (state[SIN], state[COS]));
        [place + state[DISPLACEMENTS[index]], speed + state[VELOCITIES[index]]]
    }
}
