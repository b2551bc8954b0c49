//! The rotors on one vertical motion, as rows of numbers that a loop takes through an impact together.

use bouncing_disk_core::LaneLoop;

use crate::motor::rotor::Bounce;
use crate::parameters::dimensionless::DimensionlessSystem;

/// Rotors of one row: what the widest vectors of today hold.
pub(super) const WIDTH: usize = 8;

type Row = [f64; WIDTH];

/// Eight rotors. Unused ones are without friction, load and speed.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(super) struct Rotors {
    friction: Row,
    load: Row,
    twist_cosine: Row,
    twist_sine: Row,
    /// Angular speed after the last impact.
    pub(super) speed: Row,
    /// Angle turned in the last flight.
    pub(super) turned: Row,
    /// Angle turned in the present interval of the curve.
    pub(super) sum: Row,
}

impl Rotors {
    /// Rows of all these systems.
    pub(super) fn of(systems: impl ExactSizeIterator<Item = DimensionlessSystem>) -> Vec<Self> {
        let mut rows = vec![Self::default(); systems.len().div_ceil(WIDTH)];
        for (index, system) in systems.enumerate() {
            let (rotors, own) = (&mut rows[index / WIDTH], index % WIDTH);
            rotors.friction[own] = system.friction();
            rotors.load[own] = system.load();
            (rotors.twist_cosine[own], rotors.twist_sine[own]) = system.twist_components();
        }
        rows
    }
}

/// A flight and its impact, the same for all rotors.
#[derive(Debug, Clone, Copy)]
pub(super) struct SharedImpact {
    /// Duration of the flight (rad).
    pub(super) duration: f64,
    pub(super) sin: f64,
    pub(super) cos: f64,
    /// Relative axial velocity before the impact.
    pub(super) velocity: f64,
    pub(super) restitution: f64,
    /// Whether the flight ends in the present interval of the curve, so that its angle belongs to it.
    pub(super) is_within: bool,
}

/// Carries all rotors through a flight and the impact that ends it.
pub(super) struct CarryAll<'a> {
    pub(super) impact: SharedImpact,
    pub(super) rows: &'a mut [Rotors],
}

impl LaneLoop for CarryAll<'_> {
    #[inline(always)]
    fn run(self) {
        let SharedImpact { duration, sin, cos, velocity, restitution, is_within } = self.impact;
        for rotors in self.rows {
            for own in 0..WIDTH {
                let bounce = Bounce {
                    duration,
                    // As `DimensionlessSystem::platform_angular_speed`.
                    platform_speed: rotors.twist_cosine[own] * cos - rotors.twist_sine[own] * sin,
                    velocity,
                    restitution,
                    friction: rotors.friction[own],
                    load: rotors.load[own],
                };
                let (speed, turned) = bounce.after(rotors.speed[own]);
                rotors.speed[own] = speed;
                rotors.turned[own] = turned;
                rotors.sum[own] = if is_within { rotors.sum[own] + turned } else { rotors.sum[own] };
            }
        }
    }
}
