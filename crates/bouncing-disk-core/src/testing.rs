//! Numbers for tests that must meet every kind of case.

use core::fmt::Debug;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicU64, Ordering};
use std::sync::Mutex;

use crate::chatter::policy::{ChatterCut, ChatterPolicy};
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::ImpactMap;
use crate::run::{Observer, Progress};

/// The paper's cut (Sec. IV A).
pub(crate) const PAPER_CUT: ChatterCut = match ChatterCut::new(1.0e-6, 1.0e-4, 20) {
    Ok(cut) => cut,
    Err(_) => panic!("legal"),
};

/// [`PAPER_CUT`] as a policy.
pub(crate) const PAPER_POLICY: ChatterPolicy = ChatterPolicy::Cut(PAPER_CUT);

/// The map of a legal forcing and restitution.
pub(crate) fn map(axial_forcing: f64, restitution: f64) -> ImpactMap {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), restitution).expect("legal")
}

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

/// A type that can be stored, if the feature `serde` is on.
#[cfg(feature = "serde")]
pub(crate) trait Storable:
    Clone + PartialEq + Debug + serde::Serialize + serde::de::DeserializeOwned
{
}

#[cfg(feature = "serde")]
impl<T: Clone + PartialEq + Debug + serde::Serialize + serde::de::DeserializeOwned> Storable for T {}

/// A type that can be stored, if the feature `serde` is on.
#[cfg(not(feature = "serde"))]
pub(crate) trait Storable: Clone + PartialEq + Debug {}

#[cfg(not(feature = "serde"))]
impl<T: Clone + PartialEq + Debug> Storable for T {}

/// A value after it was written and read; the value itself without the feature `serde`.
pub(crate) fn stored<T: Storable>(value: &T) -> T {
    #[cfg(feature = "serde")]
    let read = serde_json::from_str(&serde_json::to_string(value).expect("writes")).expect("legal");
    #[cfg(not(feature = "serde"))]
    let read = value.clone();
    assert_eq!(*value, read);
    read
}

/// An observer that breaks when it is asked for the nth time and from then on.
#[derive(Debug)]
pub(crate) struct StopAfter {
    calls: u64,
    asked: AtomicU64,
    last: Mutex<Progress>,
}

impl StopAfter {
    pub(crate) fn calls(calls: u64) -> Self {
        Self { calls, asked: AtomicU64::new(0), last: Mutex::default() }
    }

    /// How often it was asked.
    pub(crate) fn asked(&self) -> u64 {
        self.asked.load(Ordering::Relaxed)
    }

    /// The last progress that it saw.
    pub(crate) fn last(&self) -> Progress {
        *self.last.lock().expect("no panic")
    }
}

impl Observer for StopAfter {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        *self.last.lock().expect("no panic") = progress;
        if self.asked.fetch_add(1, Ordering::Relaxed) + 1 < self.calls {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }
}
