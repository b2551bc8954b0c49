//! Helpers for tests: evenly spread numbers that reach every kind of case, and values written and read back.

use core::fmt::Debug;

/// Evenly spread numbers in [0, 1): fractional parts of the multiples of a `stride` without short periods.
pub(crate) fn spread(k: u32, stride: f64) -> f64 {
    (f64::from(k) * stride) % 1.0
}

/// [`spread`] with the golden ratio, the most even stride.
pub(crate) fn golden_spread(k: u64) -> f64 {
    (k as f64 * 0.618_033_988_749_894_9) % 1.0
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

/// A value after writing and reading; the value itself without the feature `serde`.
pub(crate) fn stored<T: Storable>(value: &T) -> T {
    #[cfg(feature = "serde")]
    let read = serde_json::from_str(&serde_json::to_string(value).expect("writes")).expect("legal");
    #[cfg(not(feature = "serde"))]
    let read = value.clone();
    assert_eq!(*value, read);
    read
}
