//! The effects of an impact on the disk, and their energy: for single impacts, for the impacts of a chatter,
//! and for the rounding residue at the end of a slip.

use crate::motion::energy::EnergyLedger;
use crate::motion::impact::{axial_impulse, friction_impact};

/// The effects of an impact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Impulses {
    /// Axial impulse per mass.
    pub(crate) axial: f64,
    /// Angular impulse per moment of inertia.
    pub(crate) rotary: f64,
    /// Whether friction ends the slip during the impact.
    pub(crate) capped: bool,
    /// The slip before the impact.
    pub(crate) slip: f64,
    /// The angular speed after the impact.
    pub(crate) speed: f64,
}

/// The impulses of an impact; the ledger records the platform's work and the losses. The platform's velocity
/// and angular speed follow the relative velocity and the disk's angular speed.
pub(crate) fn impact(
    ledger: &mut EnergyLedger,
    (friction, restitution): (f64, f64),
    [relative_velocity, platform_velocity]: [f64; 2],
    [speed, platform_speed]: [f64; 2],
) -> Impulses {
    let slip = speed - platform_speed;
    let axial = axial_impulse(restitution, relative_velocity);
    let rotary = friction_impact(friction, axial, slip);
    let loss = 0.5 * ((1.0 - restitution) * (1.0 + restitution)) * (relative_velocity * relative_velocity);
    ledger.record_normal(axial * platform_velocity, loss);
    record_friction_impulse(ledger, rotary.impulse, slip, platform_speed);
    let after = rotary.speed_after(speed, platform_speed);
    Impulses { axial, rotary: rotary.impulse, capped: rotary.capped, slip, speed: after }
}

/// Records the platform's work and the loss by an impulse of friction, which acts at the mean of the slip
/// speeds before and after.
pub(crate) fn record_friction_impulse(
    ledger: &mut EnergyLedger,
    impulse: f64,
    slip: f64,
    platform_speed: f64,
) {
    let (work, loss) = (impulse * platform_speed, -impulse * (slip + 0.5 * impulse));
    ledger.record_friction(work, loss, work.abs() + (impulse * slip).abs());
}

/// Records that a disk with angular `speed` is set to the platform's speed at the end of a slip, of which
/// rounding has left this `slip`.
pub(crate) fn record_slip_end(ledger: &mut EnergyLedger, speed: f64, slip: f64, platform_speed: f64) {
    let (work, loss) = (-slip * platform_speed, 0.5 * slip * slip);
    ledger.record_friction(work, loss, work.abs() + loss);
    ledger.record_rotary_change(speed, platform_speed);
}
