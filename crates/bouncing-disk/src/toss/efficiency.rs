//! The efficiency of a toss (Sec. III A): what the spin has of the energy that the platform has put in.

use crate::motion::si::SiEnergy;

impl SiEnergy {
    /// The efficiency of a toss (Sec. III A): eta = (dE + E_0)/(W + E_0), the rotary kinetic energy that the
    /// disk has gained over the energy that the platform has put in. dE is [`Self::rotary_kinetic_change`], W
    /// is [`Self::platform_work`] and E_0 (J/kg, not negative) is the rotary kinetic energy that the disk has
    /// at the start, given to it by the platform, too; zero for a disk at rest. Not a number if nothing was
    /// put in.
    #[must_use]
    pub fn efficiency(&self, initial_rotary_energy: f64) -> f64 {
        (self.rotary_kinetic_change + initial_rotary_energy) / (self.platform_work() + initial_rotary_energy)
    }

    /// Energy that the platform puts in: work by normal forces and by friction (J/kg).
    #[must_use]
    pub fn platform_work(&self) -> f64 {
        self.normal_work + self.friction_work
    }
}
