//! The rotation of period-1 orbits, Eq. (16).

use bouncing_disk_core::Phase;

use crate::parameters::dimensionless::DimensionlessSystem;

/// The rotary speed of a period-1 orbit with impacts at `impact_phase`, Eq. 16: the platform's own speed there,
/// Q cos(tau_imp + theta), in units of g a_e/(a_g^2 omega).
///
/// It is largest, Q, for a phase lag theta = -tau_imp.
#[must_use]
pub fn period_one_rotary_speed(system: &DimensionlessSystem, impact_phase: Phase) -> f64 {
    system.platform_angular_speed(impact_phase)
}
