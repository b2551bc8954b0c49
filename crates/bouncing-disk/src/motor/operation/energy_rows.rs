//! The rotors of one vertical motion as rows of numbers, with their energies: a loop takes all of them through an impact.

use bouncing_disk_core::LaneLoop;

use crate::motion::impact::{axial_impulse, friction_impact};
use crate::motion::rotary_change::change_in_flight;
use crate::parameters::dimensionless::DimensionlessSystem;

/// Rotors of one row: what the widest vectors of today hold.
pub(super) const WIDTH: usize = 8;

type Row = [f64; WIDTH];

/// Eight rotors. Unused ones are without friction, load and speed.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(super) struct EnergyRows {
    friction: Row,
    load: Row,
    twist_cosine: Row,
    twist_sine: Row,
    /// Angular speed after the last impact.
    pub(super) speed: Row,
    /// Angle turned since the window began, in flights.
    pub(super) angle: Row,
    /// Work of the platform by friction, and loss in it, since the window began, in impacts.
    pub(super) work: Row,
    pub(super) loss: Row,
}

impl EnergyRows {
    /// Rows of all these systems.
    pub(super) fn of(systems: &[DimensionlessSystem]) -> Vec<Self> {
        let mut rows = vec![Self::default(); systems.len().div_ceil(WIDTH)];
        for (index, system) in systems.iter().enumerate() {
            let (rotors, own) = (&mut rows[index / WIDTH], index % WIDTH);
            rotors.friction[own] = system.friction();
            rotors.load[own] = system.load();
            (rotors.twist_cosine[own], rotors.twist_sine[own]) = system.twist_components();
        }
        rows
    }
}

/// Carries all rotors through a flight and the impact that ends it.
pub(super) struct CarryAll<'a> {
    /// Duration of the flight (rad).
    pub(super) duration: f64,
    pub(super) sin: f64,
    pub(super) cos: f64,
    /// Relative axial velocity before the impact.
    pub(super) velocity: f64,
    pub(super) restitution: f64,
    pub(super) rows: &'a mut [EnergyRows],
}

impl LaneLoop for CarryAll<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { duration, sin, cos, velocity, restitution, rows } = self;
        let axial = axial_impulse(restitution, velocity);
        for rotors in rows {
            for own in 0..WIDTH {
                let flight = change_in_flight(rotors.load[own], rotors.speed[own], duration);
                let platform_speed = rotors.twist_cosine[own] * cos - rotors.twist_sine[own] * sin;
                let slip = flight.speed - platform_speed;
                let rotary = friction_impact(rotors.friction[own], axial, slip);
                rotors.speed[own] = rotary.speed_after(flight.speed, platform_speed);
                rotors.angle[own] += flight.angle;
                rotors.work[own] += rotary.impulse * platform_speed;
                // The friction impulse acts at the mean of the slip speeds before and after.
                rotors.loss[own] -= rotary.impulse * (slip + 0.5 * rotary.impulse);
            }
        }
    }
}
