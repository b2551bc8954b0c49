//! An independent derivative of the impact map.

use bouncing_disk_core::{ImpactState, Vibration};
use glam::{DMat2, DVec2};
use num_dual::{Dual64, DualNum};

/// The derivative of the map in dual numbers, for a law given in dual numbers: the impact time follows by
/// Newton steps on the gap, independent of the library's implicit-function formulas.
pub(crate) fn dual_derivative(
    vibration: &Vibration,
    from: ImpactState,
    duration: f64,
    restitution: impl Fn(Dual64) -> Dual64,
) -> DMat2 {
    let column = |by_phase: f64, by_velocity: f64| {
        let p = vibration.peak_acceleration();
        let tau = Dual64::new(from.phase().angle(), by_phase);
        let v = Dual64::new(from.velocity(), by_velocity);
        let w = -v * restitution(-v);
        let mut h = Dual64::from_re(duration);
        for _ in 0..3 {
            let later = tau + h;
            let gap = w * h + tau.cos() * p * h - h * h * 0.5 - (later.sin() - tau.sin()) * p;
            let slope = w + tau.cos() * p - h - later.cos() * p;
            h -= gap / slope;
        }
        let phase = tau + h;
        let velocity = w + tau.cos() * p - h - phase.cos() * p;
        DVec2::new(phase.eps, velocity.eps)
    };
    DMat2::from_cols(column(1.0, 0.0), column(0.0, 1.0))
}
