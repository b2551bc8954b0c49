//! Numbers for tests that must meet every kind of case.

/// Well spread numbers in [0, 1): multiples of a `stride` without short periods, less their whole parts.
pub(crate) fn spread(k: u32, stride: f64) -> f64 {
    (f64::from(k) * stride) % 1.0
}

/// [`spread`] with the golden section, the most even one.
pub(crate) fn golden_spread(k: u64) -> f64 {
    (k as f64 * 0.618_033_988_749_894_9) % 1.0
}
