//! What sliding contact changes in the rotation, Eq. (12).

use crate::motion::arc::Arc;
use crate::motion::state::SlipDirection;
use crate::parameters::dimensionless::DimensionlessSystem;

/// Change of the rotary state over a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RotaryChange {
    /// Angular speed at the end.
    pub(crate) speed: f64,
    /// Change of the angle.
    pub(crate) angle: f64,
}

/// Sliding contact (Eq. 12): d(angular speed)/d tau = -s mu N - l with N = 1 - P sin tau, integrated.
pub(crate) fn change_while_sliding(
    system: &DimensionlessSystem,
    direction: SlipDirection,
    speed: f64,
    arc: &Arc,
) -> RotaryChange {
    let t = arc.duration;
    let grip = direction.sign() * system.friction();
    let load = system.load();
    RotaryChange {
        speed: speed - (grip * arc.force().value + load * t),
        angle: t * (speed - 0.5 * load * t) - grip * arc.force_twice().value,
    }
}
