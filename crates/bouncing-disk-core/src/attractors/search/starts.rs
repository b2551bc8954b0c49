//! Starts spread evenly over the trapping region.

use core::f64::consts::TAU;

use crate::attractors::attracting_map::AttractingMap;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::ImpactState;

/// The fractional parts of multiples of 1/g and 1/g^2, where g^3 = g + 1, as 64-bit fixed-point numbers: the
/// most even sequence of its kind in two dimensions (M. Roberts' R2; g = 1.32471795724...).
const STEPS: [u64; 2] = [0xc13f_a9a9_02a6_328f, 0x91e1_0da5_c79e_7b1d];

/// Tries per requested start: the region fills at least a quarter of its bounding rectangle.
const TRIES: u64 = 16;

/// A fixed-point number in [0, 1), to the 53 bits of a double.
fn unit(fixed: u64) -> f64 {
    (fixed >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
}

/// The requested number of impacts, evenly spread over the area of the trapping region in (phase, velocity):
/// the points of a sequence over its bounding rectangle that lie inside.
pub(super) fn starts(map: &impl AttractingMap, count: u32) -> Vec<ImpactState> {
    let fastest = map.impact_speed_bound();
    let mut starts = Vec::with_capacity(count as usize);
    for k in 0..TRIES * u64::from(count) {
        if starts.len() >= count as usize {
            break;
        }
        let [turn, share] = STEPS.map(|step| unit(step.wrapping_mul(k).wrapping_add(1 << 63)));
        let phase = Phase::of_angle(TAU * turn);
        let speed = share * fastest;
        if speed <= map.impact_speed_bound_at(phase) {
            starts.push(ImpactState::of_impact(phase, -speed));
        }
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::impact_map::map;

    #[test]
    fn the_steps_are_those_of_the_sequence() {
        let (first, second) = (unit(STEPS[0]), unit(STEPS[1]));
        assert!((first * first - second).abs() < 1e-15, "{first} {second}");
        // g^3 = g + 1, divided by g^3.
        assert!((first * first * (1.0 + first) - 1.0).abs() < 1e-15, "{first}");
    }

    #[test]
    fn all_starts_lie_in_the_region_whatever_the_parameters() {
        for restitution in [0.0, 1e-9, 0.3, 0.9, 0.999] {
            for axial_forcing in [0.0, 1e-300, 1e-3, 0.3, 1.0, 30.0, 3_000.0] {
                let map = map(axial_forcing, restitution);
                for count in [0, 1, 2, 1_000] {
                    let starts = starts(&map, count);
                    assert_eq!(starts.len(), count as usize, "{map}");
                    let inside = |at: &ImpactState| -at.velocity() <= map.impact_speed_bound_at(at.phase());
                    assert!(starts.iter().all(inside), "{map}");
                }
            }
        }
    }

    /// Each of the 8 x 8 cells inside the region contains its share of the starts, to within a sixth.
    #[test]
    fn starts_are_even() {
        let map = map(0.5, 0.5);
        let starts = starts(&map, 20_000);
        let fastest = map.impact_speed_bound();
        let mut counts = [[0.0_f64; 8]; 8];
        for at in &starts {
            let column = (at.phase().cycles() * 8.0) as usize;
            counts[(-at.velocity() / fastest * 8.0) as usize][column.min(7)] += 1.0;
        }
        // The lowest four rows lie inside at all phases except while the platform falls.
        let expected = counts[0][0];
        assert!(expected > 200.0);
        for row in &counts[..3] {
            assert!(row.iter().all(|count| (count / expected - 1.0).abs() < 1.0 / 6.0), "{counts:?}");
        }
    }
}
