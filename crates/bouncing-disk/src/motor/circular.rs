//! The extent and the concentration of angles on a circle.

use core::f64::consts::PI;

use bouncing_disk_core::numerics::elementary::{atan2, cos, hypot, sin_cos};
use bouncing_disk_core::read_checked;

use crate::error::{Error, check};

/// The length of the shortest arc that contains all `phases`, in periods: one minus the largest gap between
/// neighbours. Zero for one phase, `None` for no phases.
///
/// Phases are in periods; 0 and 1 are the same.
pub fn occupied_arc(phases: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut phases: Vec<f64> = phases.into_iter().map(|phase| phase - phase.floor()).collect();
    phases.sort_by(f64::total_cmp);
    let (first, last) = (phases.first()?, phases.last()?);
    let across_the_end = first + 1.0 - last;
    let largest = phases.windows(2).map(|pair| pair[1] - pair[0]).fold(across_the_end, f64::max);
    Some(1.0 - largest)
}

/// The number of groups of `phases` that are separated by gaps longer than `apart` round the circle: the
/// number of distinct phases at that resolution. The result is 1 without such a gap, and 0 without phases.
///
/// Phases are in periods; 0 and 1 are the same.
///
/// ```
/// use bouncing_disk::motor::circular::distinct;
///
/// // The last one equals the first one, across the end of the period.
/// assert_eq!(distinct([0.0, 0.25, 0.25 + 1e-9, 1.0 - 1e-9], 1e-6), 2);
/// ```
pub fn distinct(phases: impl IntoIterator<Item = f64>, apart: f64) -> usize {
    let mut phases: Vec<f64> = phases.into_iter().map(|phase| phase - phase.floor()).collect();
    phases.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (phases.first(), phases.last()) else { return 0 };
    let gaps = phases.windows(2).filter(|pair| pair[1] - pair[0] > apart).count();
    (gaps + usize::from(first + 1.0 - last > apart)).max(1)
}

/// The shorter distance between two phases, in periods: at most one half.
#[must_use]
pub fn distance(one: f64, other: f64) -> f64 {
    let apart = one - other;
    let apart = apart - apart.floor();
    apart.min(1.0 - apart)
}

/// First trigonometric moment of weighted phases: the position and the strength of their concentration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedConcentration"))]
pub struct Concentration {
    /// Mean direction (rad), from -pi to pi.
    pub mean_direction_rad: f64,
    /// Mean resultant length: 0 if the weights are spread evenly, 1 if all have the same phase.
    pub resultant_length: f64,
}

/// Largest amount by which rounding may raise the resultant length above 1, for about a million weights.
const LENGTH_ROUNDING: f64 = 1.0e-9;

read_checked!(Concentration as UncheckedConcentration {
    mean_direction_rad: f64,
    resultant_length: f64,
});

impl Concentration {
    /// Checks a deserialised value.
    fn check(&self) -> Result<(), Error> {
        let (direction, length) = (self.mean_direction_rad, self.resultant_length);
        check((-PI..=PI).contains(&direction), "mean_direction_rad", direction, "[-pi, pi] (rad)")?;
        check((0.0..=1.0 + LENGTH_ROUNDING).contains(&length), "resultant_length", length, "[0, 1]")?;
        Ok(())
    }

    /// The concentration of pairs (phase in rad, weight); `None` if the total weight is zero.
    pub fn of(weights: impl IntoIterator<Item = (f64, f64)>) -> Option<Self> {
        let (mut cosine, mut sine, mut total) = (0.0, 0.0, 0.0);
        for (phase, weight) in weights {
            let (sin, cos) = sin_cos(phase);
            (cosine, sine, total) = (cosine + weight * cos, sine + weight * sin, total + weight);
        }
        (total > 0.0).then(|| Self {
            mean_direction_rad: atan2(sine, cosine),
            resultant_length: hypot(cosine, sine) / total,
        })
    }

    /// The mean cosine.
    #[must_use]
    pub fn mean_cosine(&self) -> f64 {
        self.resultant_length * cos(self.mean_direction_rad)
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::{PI, TAU};

    use super::*;

    fn arc(phases: &[f64]) -> f64 {
        occupied_arc(phases.iter().copied()).expect("there are phases")
    }

    #[test]
    fn an_arc_is_one_period_minus_the_largest_gap() {
        assert_eq!(occupied_arc([]), None);
        for (phases, expected) in [
            (&[0.3][..], 0.0),
            (&[0.3, 0.3, 0.3], 0.0),
            (&[0.1, 0.2, 0.35], 0.25),
            // Both sides of zero.
            (&[0.95, 0.05], 0.1),
            (&[0.05, 0.95, 0.9], 0.15),
            // The end is the beginning.
            (&[0.0, 1.0], 0.0),
            (&[1.0], 0.0),
            (&[0.0, 1.0, 0.125], 0.125),
            (&[-0.1, 0.1], 0.2),
            (&[0.0, 0.5], 0.5),
            (&[0.0, 0.25, 0.5, 0.75], 0.75),
        ] {
            assert!((arc(phases) - expected).abs() < 1e-15, "{phases:?}: {}", arc(phases));
        }
    }

    #[test]
    fn phases_are_counted_whatever_boundary_they_are_next_to() {
        let ulp = f64::EPSILON;
        for (phases, expected) in [
            (&[][..], 0),
            (&[0.3], 1),
            (&[0.125, 0.125 - ulp, 0.125 + ulp], 1),
            (&[0.05 * (1.0 - ulp), 0.05, 0.7, 0.7], 2),
            // A single position at the seam of the phase.
            (&[0.0, 1.0 - ulp, ulp], 1),
            (&[0.0, 0.5, 1.0 - ulp], 2),
            (&[-0.25, 0.75, 1.75], 1),
            // A chain of neighbours around the whole circle has no gap.
            (&[0.0, 0.25, 0.5, 0.75], 4),
        ] {
            assert_eq!(distinct(phases.iter().copied(), 1e-6), expected, "{phases:?}");
        }
        assert_eq!(distinct([0.0, 0.25, 0.5, 0.75], 0.3), 1);
        assert_eq!(distinct([0.3, f64::NAN], 1e-6), 1);
    }

    #[test]
    fn an_arc_does_not_depend_on_the_order_or_on_where_the_period_begins() {
        let phases = [0.93, 0.02, 0.11, 0.99];
        let expected = arc(&phases);
        for shift in [0.0, 0.07, 0.5, 0.9, 3.0] {
            let mut shifted = phases.map(|phase| phase + shift);
            shifted.reverse();
            assert!((arc(&shifted) - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn a_distance_goes_the_shorter_way() {
        for (one, other, expected) in [(0.95, 0.05, 0.1), (0.0, 1.0, 0.0), (0.2, 0.7, 0.5), (0.3, 0.1, 0.2)] {
            assert!((distance(one, other) - expected).abs() < 1e-15);
            assert!((distance(other, one) - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn weights_about_the_seam_are_concentrated_there() {
        let of = |phases: &[f64]| Concentration::of(phases.iter().map(|phase| (*phase, 2.0)));
        let seam = of(&[0.3, TAU - 0.3]).expect("two");
        assert!(seam.mean_direction_rad.abs() < 1e-15, "{seam:?}");
        assert!((seam.mean_cosine() - cos(0.3)).abs() < 1e-15, "{seam:?}");
        let even = of(&[0.0, 0.25 * TAU, 0.5 * TAU, 0.75 * TAU]).expect("four");
        assert!(even.resultant_length < 1e-15, "{even:?}");
        let opposite = of(&[PI]).expect("one");
        assert!((opposite.mean_cosine() + 1.0).abs() < 1e-15, "{opposite:?}");
        assert_eq!(of(&[]), None);
    }
}
