//! The instant of an impact, Eqs. (5)-(10): restitution along the axis, friction about it, per unit mass and
//! moment of inertia.

/// Axial impulse of an impact with relative `velocity` <= 0 (Eq. 5 with the rebound law of Eq. 7 inserted).
#[inline(always)]
pub(crate) fn axial_impulse(restitution: f64, velocity: f64) -> f64 {
    (1.0 + restitution) * -velocity
}

/// Relative axial velocity after an impact with `velocity` before (Eq. 6).
pub(crate) fn rebound_velocity(restitution: f64, velocity: f64) -> f64 {
    -restitution * velocity
}

/// Magnitude of the angular impulse that friction would exert if the disk slid throughout the impact (Eq. 8).
#[inline(always)]
pub(crate) fn available_impulse(friction: f64, axial_impulse: f64) -> f64 {
    friction * axial_impulse
}

/// Angular impulse that ends a slip of `slip` (disk minus platform), the largest one possible (Eq. 9).
#[inline(always)]
pub(crate) fn stopping_impulse(slip: f64) -> f64 {
    -slip
}

/// The effect of friction in an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FrictionImpact {
    /// Angular impulse.
    pub(crate) impulse: f64,
    /// Whether the slip ends during the impact; otherwise the disk slides throughout.
    pub(crate) capped: bool,
}

impl FrictionImpact {
    /// Angular speed after the impact for a disk with `speed` before it.
    #[inline(always)]
    pub(crate) fn speed_after(self, speed: f64, platform_speed: f64) -> f64 {
        if self.capped { platform_speed } else { speed + self.impulse }
    }
}

/// The angular impulse of an impact (Eq. 10): the available one, capped at the one that ends the slip.
#[inline(always)]
pub(crate) fn friction_impact(friction: f64, axial_impulse: f64, slip: f64) -> FrictionImpact {
    let available = available_impulse(friction, axial_impulse);
    let stopping = stopping_impulse(slip);
    if stopping.abs() <= available {
        FrictionImpact { impulse: stopping, capped: true }
    } else {
        FrictionImpact { impulse: available.copysign(stopping), capped: false }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn friction_takes_what_is_available_or_what_stops_the_slip(
            friction in 0.0..2.0_f64, axial in 0.0..10.0_f64, slip in -5.0..5.0_f64,
        ) {
            let impact = friction_impact(friction, axial, slip);
            prop_assert!(impact.impulse * slip <= 0.0);
            prop_assert!((slip + impact.impulse) * slip >= 0.0);
            prop_assert_eq!(impact.capped, slip.abs() <= friction * axial);
            prop_assert_eq!(impact.impulse.abs().to_bits(), slip.abs().min(friction * axial).to_bits());
        }
    }

    #[test]
    fn an_impact_reverses_the_axial_velocity_by_its_impulse() {
        let (restitution, velocity) = (0.25, -2.0);
        assert!((rebound_velocity(restitution, velocity) - 0.5).abs() < 1e-15);
        assert!((velocity + axial_impulse(restitution, velocity) - 0.5).abs() < 1e-15);
    }
}
