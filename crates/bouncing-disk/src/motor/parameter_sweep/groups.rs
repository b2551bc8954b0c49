//! Selects the cells of a sweep that are computed together.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use bouncing_disk_core::run::{Watch, in_parallel, threads};
use bouncing_disk_core::{Observer, Progress};

use crate::error::Error;
use crate::motor::batch::shared_orbit::vertical_key;
use crate::motor::data_sheet::Motor;
use crate::motor::operation::of_motor::operations;
use crate::motor::operation::point::OperatingRow;
use crate::motor::operation::settings::OperatingSettings;

/// Factor by which an impact of a rotor that acts back on its stator takes longer to compute than one on a
/// sine. Such a cell may use this many times fewer impacts; otherwise a few cells that never settle would
/// take most of an hour.
const SHARE_OF_CELL: u64 = 100;

/// Largest number of cells of a group. Far smaller groups would make poor use of a vertical motion; with far
/// larger ones, much work would be lost when a run is stopped.
const MOST_CELLS: usize = 256;

/// Largest number of rotors of a group on all of its vertical motions together. Each rotor needs a few
/// hundred windows of 40 bytes, so a group needs about 100 MB at most.
const MOST_ROTORS: usize = 1 << 14;

/// Largest number of cells of a group, so that its memory is bounded for any number of vertical motions.
pub(crate) fn most_cells(settings: &OperatingSettings) -> usize {
    (MOST_ROTORS / settings.members.max(1)).clamp(1, MOST_CELLS)
}

/// The indices of the motors, grouped by vertical motion, with at most `most` in each group.
pub(crate) fn of(
    motors: impl Iterator<Item = Result<Motor, Error>>,
    most: usize,
) -> Result<Vec<Vec<usize>>, Error> {
    // The group of each vertical motion that has room left.
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

/// The settings of each of many motors, with [`SHARE_OF_CELL`] times fewer impacts for rotors that act back on their stator.
pub(crate) fn settings_of_each(motors: &[Motor], settings: &OperatingSettings) -> OperatingSettings {
    let most_impacts = if motors.iter().any(|motor| motor.stator_motion().acts_back()) {
        (settings.most_impacts / SHARE_OF_CELL).max(1)
    } else {
        settings.most_impacts
    };
    OperatingSettings { most_impacts, ..*settings }
}

/// The results for `count` groups, in their order; fewer if the watch stops. The items of the watch are the
/// cells, `size` in each group.
pub(crate) fn over_groups<T: Send>(
    count: usize,
    size: impl Fn(usize) -> usize + Sync,
    watch: &Watch<'_>,
    compute: impl Fn(usize, &dyn Observer) -> Result<T, Error> + Sync,
) -> Vec<(usize, Result<T, Error>)> {
    let next = AtomicUsize::new(0);
    let ask = |_: Progress| match watch.ask() {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    };
    let worker = || {
        let mut outcomes = Vec::new();
        while !watch.is_stopped() {
            let group = next.fetch_add(1, Ordering::Relaxed);
            if group >= count {
                break;
            }
            let outcome = compute(group, &ask);
            if outcome.is_ok() {
                watch.finish(size(group) as u64);
            }
            outcomes.push((group, outcome));
        }
        outcomes
    };
    // The members of a group are distributed over the threads, too, but end at different times.
    let workers = threads().min(count);
    let mut outcomes: Vec<_> = in_parallel(workers, |_| worker()).into_iter().flatten().collect();
    outcomes.sort_by_key(|(group, _)| *group);
    outcomes
}

/// The operations of many motors, listed in any order; motors with the same vertical motion are computed
/// together. If a motor cannot be followed, its error applies to its whole group.
pub(crate) fn operations_in_groups(
    motors: &[Motor],
    settings: &OperatingSettings,
    watch: &Watch<'_>,
) -> Result<Vec<Result<OperatingRow, Error>>, Error> {
    let groups = of(motors.iter().cloned().map(Ok), most_cells(settings))?;
    let compute = |group: usize, observer: &dyn Observer| {
        let motors: Vec<Motor> = groups[group].iter().map(|index| motors[*index].clone()).collect();
        operations(&motors, &settings_of_each(&motors, settings), observer)
    };
    let outcomes = over_groups(groups.len(), |group| groups[group].len(), watch, compute);
    watch.ask()?;
    let mut all: Vec<(usize, Result<OperatingRow, Error>)> = Vec::with_capacity(motors.len());
    for ((_, outcome), cells) in outcomes.into_iter().zip(&groups) {
        match outcome {
            Ok(rows) => all.extend(cells.iter().copied().zip(rows.into_iter().map(Ok))),
            Err(failure) => all.extend(cells.iter().map(|cell| (*cell, Err(failure)))),
        }
    }
    all.sort_by_key(|(cell, _)| *cell);
    Ok(all.into_iter().map(|(_, row)| row).collect())
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
