//! Pictures of the results, each from plain numbers alone.

pub(crate) mod basins;
pub(crate) mod diagram;
pub(crate) mod doublings;
pub(crate) mod motor_curve;
pub(crate) mod orbits;
pub(crate) mod regimes;
pub(crate) mod sweep;
pub(crate) mod toss;
pub(crate) mod transient;

use bouncing_disk_plot::Axis;

/// What the impact phase is called, and the normalised impact speed.
const PHASE: &str = r"$\tau_{imp}/2\pi$";
const SPEED: &str = r"$|w_A\Gamma/(\omega A)|$";

/// A linear axis between the least and the largest of these numbers, with room beyond them; the same for one number alone.
fn axis(values: impl IntoIterator<Item = f64>) -> Axis {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (low, high) = finite
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
    let size = low.abs().max(high.abs());
    let room = match high - low {
        span if span > 1e-9 * size => 0.06 * span,
        // All alike.
        _ if size > 0.0 => 0.1 * size,
        _ => 1.0,
    };
    Axis::linear(low - room, high + room)
}

/// The most of these numbers, at least `least`.
fn largest(values: impl IntoIterator<Item = f64>, least: f64) -> f64 {
    values.into_iter().filter(|value| value.is_finite()).fold(least, f64::max)
}
