//! The rotors on one vertical motion, as rows of numbers that a loop advances through an impact together.

/// Rotors per row: as many as the widest vectors of current processors hold.
pub(crate) const WIDTH: usize = 8;

/// One number per rotor.
pub(crate) type Row = [f64; WIDTH];

/// Eight rotors, and their accumulated sums. Unused rotors have no friction, load or speed.
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

impl<T> RotorRows<T> {
    /// Sets one rotor: friction and load, and the coefficients of the stator's angular speed for the cosine
    /// and, with opposite sign, the sine of the phase.
    pub(crate) fn put(&mut self, own: usize, [friction, load]: [f64; 2], [cosine, sine]: [f64; 2]) {
        (self.friction[own], self.load[own]) = (friction, load);
        (self.twist_cosine[own], self.twist_sine[own]) = (cosine, sine);
    }

    /// Angular speed of the stator under one of the rotors, as in
    /// `DimensionlessSystem::platform_angular_speed`.
    #[inline(always)]
    pub(crate) fn twist(&self, own: usize, sin: f64, cos: f64) -> f64 {
        self.twist_cosine[own] * cos - self.twist_sine[own] * sin
    }

    /// Angular speeds of the stator under all rotors.
    #[inline(always)]
    pub(crate) fn twists(&self, sin: f64, cos: f64) -> Row {
        core::array::from_fn(|own| self.twist(own, sin, cos))
    }
}
