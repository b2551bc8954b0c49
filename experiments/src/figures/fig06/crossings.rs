//! Where branches of the speed of rotation cross.

use super::data::Slice;
use crate::figures::numbers;

/// The Γ at which two branches of the period-4 orbit have the same speed in (d), between two slices each.
pub(super) fn branch_crossings(followed: &[Slice], doublings: &[f64]) -> Vec<f64> {
    let [_, low, high, ..] = doublings else { return Vec::new() };
    let mut crossings = Vec::new();
    let mut before: Option<(f64, Vec<[f64; 3]>)> = None;
    let inside = followed.iter().filter(|slice| slice.axial_forcing > *low && slice.axial_forcing < *high);
    for slice in inside.filter(|slice| slice.period == Some(4)) {
        let mut impacts: Vec<[f64; 3]> = (0..slice.semielliptical.len())
            .map(|i| {
                [slice.impact_phase_cycles[i], slice.normalised_impact_speed[i], slice.semielliptical[i]]
            })
            .collect();
        if let Some((forcing, last)) = &before {
            // A round may begin with any of its impacts: the one that continues the branches.
            let apart = |shift: usize| -> f64 {
                let pairs = last.iter().zip(impacts.iter().cycle().skip(shift));
                pairs.map(|(a, b)| numbers::distance(a[0], b[0]) + (a[1] - b[1]).abs()).sum()
            };
            let shift = (0..impacts.len()).min_by(|a, b| apart(*a).total_cmp(&apart(*b))).unwrap_or_default();
            impacts.rotate_left(shift);
            for one in 0..impacts.len() {
                for other in 0..one {
                    let was = last[one][2] - last[other][2];
                    let is = impacts[one][2] - impacts[other][2];
                    if (was < 0.0) != (is < 0.0) {
                        crossings.push(forcing + (slice.axial_forcing - forcing) * was / (was - is));
                    }
                }
            }
        }
        before = Some((slice.axial_forcing, impacts));
    }
    crossings
}
