//! The rotors on one vertical motion, as rows of numbers that a loop takes through an impact together.

#[cfg(feature = "fit")]
use bouncing_disk_core::Impact;

#[cfg(feature = "fit")]
use crate::motor::rotor::Bounce;
#[cfg(feature = "fit")]
use crate::parameters::dimensionless::DimensionlessSystem;

/// Rotors of one row: as many as the widest vectors of today hold.
pub(crate) const WIDTH: usize = 8;

/// A number of each rotor.
pub(crate) type Row = [f64; WIDTH];

/// Eight rotors, and what is added up of them. Unused ones are without friction, load and speed.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(crate) struct RotorRows<T> {
    pub(crate) friction: Row,
    pub(crate) load: Row,
    twist_cosine: Row,
    twist_sine: Row,
    /// Angular speed after the last impact.
    pub(crate) speed: Row,
    /// The sums.
    pub(crate) tally: T,
}

impl<T: Copy + Default> RotorRows<T> {
    /// Rows of all these systems.
    #[cfg(feature = "fit")]
    pub(crate) fn of(systems: impl ExactSizeIterator<Item = DimensionlessSystem>) -> Vec<Self> {
        let mut rows = vec![Self::default(); systems.len().div_ceil(WIDTH)];
        for (index, system) in systems.enumerate() {
            let (cosine, sine) = system.twist_components();
            rows[index / WIDTH].put(index % WIDTH, [system.friction(), system.load()], [cosine, sine]);
        }
        rows
    }

    /// Puts a rotor in its place: friction and load, and the parts of the stator's angular speed that go with cosine
    /// and, falling, sine of the phase.
    pub(crate) fn put(&mut self, own: usize, [friction, load]: [f64; 2], [cosine, sine]: [f64; 2]) {
        (self.friction[own], self.load[own]) = (friction, load);
        (self.twist_cosine[own], self.twist_sine[own]) = (cosine, sine);
    }

    /// Angular speed of the stator under one of the rotors, as `DimensionlessSystem::platform_angular_speed`.
    #[inline(always)]
    pub(crate) fn twist(&self, own: usize, sin: f64, cos: f64) -> f64 {
        self.twist_cosine[own] * cos - self.twist_sine[own] * sin
    }

    /// The same under all of them.
    #[inline(always)]
    pub(crate) fn twists(&self, sin: f64, cos: f64) -> Row {
        core::array::from_fn(|own| self.twist(own, sin, cos))
    }

    /// Takes one of the rotors through a flight and the impact that ends it.
    #[cfg(feature = "fit")]
    #[inline(always)]
    pub(crate) fn bounce(&self, own: usize, impact: &SharedImpact) -> Bounce {
        let SharedImpact { duration, sin, cos, velocity, restitution } = *impact;
        Bounce {
            duration,
            platform_speed: self.twist(own, sin, cos),
            velocity,
            restitution,
            friction: self.friction[own],
            load: self.load[own],
        }
    }
}

/// A flight and its impact, the same for all rotors.
#[cfg(feature = "fit")]
#[derive(Debug, Clone, Copy)]
pub(crate) struct SharedImpact {
    /// Duration of the flight (rad).
    duration: f64,
    sin: f64,
    cos: f64,
    /// Relative axial velocity before the impact.
    velocity: f64,
    restitution: f64,
}

#[cfg(feature = "fit")]
impl SharedImpact {
    /// Of a vertical motion with this restitution.
    pub(crate) fn new(impact: &Impact, restitution: f64) -> Self {
        let (sin, cos) = (impact.phase.sin(), impact.phase.cos());
        Self { duration: impact.duration(), sin, cos, velocity: impact.velocity, restitution }
    }
}
