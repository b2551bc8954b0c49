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

use bouncing_disk_plot::{Axis, Ticks};

use crate::output::numbers::shown;

/// What the impact phase is called, and the normalised impact speed.
const PHASE: &str = r"$\tau_{imp}/2\pi$";
const SPEED: &str = r"$|w_A\Gamma/(\omega A)|$";

/// A linear axis between the least and the largest of these numbers, with room beyond them; the same for one
/// number alone.
fn axis(values: impl IntoIterator<Item = f64>) -> Axis {
    let (low, high) = with_room(values);
    spanned(low, high)
}

/// The ends of such an axis.
fn with_room(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
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
    (low - room, high + room)
}

/// A linear axis from one number to another, with three to five labels: some panels are too narrow for more.
fn spanned(low: f64, high: f64) -> Axis {
    let (step, parts) = step(high - low);
    Axis::linear(low, high).ticks(Ticks::every(step).minor(parts))
}

/// A round step that divides a span at most five times, and the parts into which small ticks divide it.
fn step(span: f64) -> (f64, u32) {
    let least = span / 5.0;
    // The power of ten below it, from its digits.
    let digits = format!("{least:e}");
    let power: f64 =
        digits.split_once('e').and_then(|(_, own)| format!("1e{own}").parse().ok()).unwrap_or(1.0);
    let steps = [(power, 5), (2.0 * power, 4), (5.0 * power, 5)];
    steps.into_iter().find(|(step, _)| *step >= least).unwrap_or((10.0 * power, 5))
}

/// A number as it stands between dollar signs: powers of ten as such.
fn math(value: f64) -> String {
    let text = shown(value);
    match text.split_once('e') {
        Some((mantissa, exponent)) => format!(r"{mantissa}\times 10^{{{exponent}}}"),
        None => text,
    }
}

/// The most of these numbers, at least `least`.
fn largest(values: impl IntoIterator<Item = f64>, least: f64) -> f64 {
    values.into_iter().filter(|value| value.is_finite()).fold(least, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_has_a_few_labels_whatever_its_span() {
        for span in [1e-12, 3e-7, 0.1, 0.83, 1.0, 2.0, 4.99, 5.0, 7.0, 99.0, 1e9] {
            let (step, _) = step(span);
            let labels = span / step;
            assert!((2.0..=5.000_001).contains(&labels), "{span}: {step}");
        }
    }

    #[test]
    fn numbers_in_mathematics_have_powers_of_ten() {
        use bouncing_disk_plot::{Figure, Panel, Rect};

        for (value, text) in [
            (0.486, "0.486"),
            (0.0, "0"),
            (1e300, r"1\times 10^{300}"),
            (1.5e-7, r"1.5\times 10^{-7}"),
            (f64::MAX, r"1.79769\times 10^{308}"),
        ] {
            assert_eq!(math(value), text);
            let panel = Panel::new(Rect::new(40.0, 30.0, 100.0, 100.0)).title(format!("${}$", math(value)));
            assert!(Figure::new(150.0, 150.0).panel(panel).to_svg().is_ok(), "{text}");
        }
    }

    #[test]
    fn an_axis_of_nothing_can_be_drawn() {
        use bouncing_disk_plot::{Figure, Panel, Rect};

        for values in [&[][..], &[0.0], &[1.0, 1.0], &[f64::NAN], &[-1e-300, 1e-300], &[1e300, -1e300]] {
            let panel = Panel::new(Rect::new(40.0, 10.0, 100.0, 100.0)).y(axis(values.iter().copied()));
            assert!(Figure::new(150.0, 150.0).panel(panel).to_svg().is_ok(), "{values:?}");
        }
    }
}
