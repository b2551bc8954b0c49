//! Which cells of a sweep are computed together.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use crate::error::Error;
use crate::motor::batch::shared_orbit::vertical_key;
use crate::motor::data_sheet::Motor;
use crate::motor::operation::settings::OperatingSettings;

/// Most cells of a group. Far fewer would not use a vertical motion well; with far more, much would be lost
/// when a run is stopped.
const MOST_CELLS: usize = 256;

/// Most rotors of a group on all of its vertical motions together: each has some hundred windows of 40 bytes,
/// so that a group needs some 100 MB at most.
const MOST_ROTORS: usize = 1 << 14;

/// Most cells of a group, so that its memory is bounded for any number of vertical motions.
pub(crate) fn most_cells(settings: &OperatingSettings) -> usize {
    (MOST_ROTORS / settings.members.max(1)).clamp(1, MOST_CELLS)
}

/// The indices of the motors by groups of one vertical motion, at most so many in each.
pub(crate) fn of(
    motors: impl Iterator<Item = Result<Motor, Error>>,
    most: usize,
) -> Result<Vec<Vec<usize>>, Error> {
    // The group of a vertical motion that has room left.
    let mut open: BTreeMap<[u64; 6], usize> = BTreeMap::new();
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (index, motor) in motors.enumerate() {
        let group = match open.entry(vertical_key(motor?.system())) {
            Entry::Occupied(known) if groups[*known.get()].len() < most => *known.get(),
            entry => {
                groups.push(Vec::new());
                let new = groups.len() - 1;
                entry.insert_entry(new);
                new
            }
        };
        groups[group].push(index);
    }
    Ok(groups)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grouped(amplitudes: &[f64], most: usize) -> Vec<Vec<usize>> {
        let motor = Motor::paper_70_khz();
        let motors = amplitudes.iter().enumerate().map(|(index, &amplitude)| {
            motor.with(|sheet| {
                sheet.amplitude = Some(amplitude);
                // The vertical motion does not depend on these fields.
                sheet.load_torque = 1e-9 * index as f64;
            })
        });
        of(motors, most).expect("legal")
    }

    #[test]
    fn what_shares_a_motion_is_together_wherever_it_lies() {
        let next = f64::from_bits(1e-8_f64.to_bits() + 1);
        assert_eq!(grouped(&[1e-8, 2e-8, 1e-8, next, 2e-8], 9), [vec![0, 2], vec![1, 4], vec![3]]);
        assert_eq!(grouped(&[], 9), Vec::<Vec<usize>>::new());
    }

    #[test]
    fn a_group_has_no_more_cells_than_it_may() {
        assert_eq!(grouped(&[1e-8; 5], 2), [vec![0, 1], vec![2, 3], vec![4]]);
        assert_eq!(grouped(&[1e-8; 4], 2), [[0, 1], [2, 3]]);
        assert_eq!(grouped(&[1e-8, 2e-8, 1e-8, 1e-8, 2e-8], 1).len(), 5);
        let most = |members| most_cells(&OperatingSettings { members, ..OperatingSettings::default() });
        assert_eq!([4, 64, 65, 4096].map(most), [256, 256, 252, 4]);
    }

    #[test]
    fn the_first_motor_that_is_not_legal_ends_it() {
        let motor = Motor::paper_70_khz();
        let motors = [1.0, -2.0, -3.0].map(|friction| motor.with(|sheet| sheet.friction = friction));
        let error = of(motors.into_iter(), 9).expect_err("illegal");
        assert!(matches!(error, Error::OutOfRange { field: "friction", value: -2.0, .. }), "{error}");
    }
}
