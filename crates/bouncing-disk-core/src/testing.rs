//! Numbers for tests that must meet every kind of case.

use crate::chatter::policy::{ChatterCut, ChatterPolicy};
use crate::platform::phase::Phase;
use crate::platform::vibration::Vibration;

/// The paper's cut (Sec. IV A).
pub(crate) const PAPER_CUT: ChatterCut = match ChatterCut::new(1.0e-6, 1.0e-4, 20) {
    Ok(cut) => cut,
    Err(_) => panic!("legal"),
};

/// [`PAPER_CUT`] as a policy.
pub(crate) const PAPER_POLICY: ChatterPolicy = ChatterPolicy::Cut(PAPER_CUT);

/// Well spread numbers in [0, 1): multiples of a `stride` without short periods, less their whole parts.
pub(crate) fn spread(k: u32, stride: f64) -> f64 {
    (f64::from(k) * stride) % 1.0
}

/// [`spread`] with the golden section, the most even one.
pub(crate) fn golden_spread(k: u64) -> f64 {
    (k as f64 * 0.618_033_988_749_894_9) % 1.0
}

/// Phase and relative speed of a disk about as fast as a platform with P = 2 at its fastest: launched so, it may dip below it
/// between separation and crest. Where the speed is negative there is no such launch.
pub(crate) fn launch_that_may_dip(vibration: &Vibration, k: u64) -> (Phase, f64) {
    let phase = Phase::new(vibration.separation_angle - 2.0 * golden_spread(k)).expect("finite");
    (phase, 1.9 + 0.8 * golden_spread(7 * k) - vibration.velocity(phase))
}
