//! Runs all cells of a sweep: distributes its groups over the threads, and combines their operations into the
//! result.

use bouncing_disk_core::Observer;
use bouncing_disk_core::run::Watch;

use crate::error::Error;
use crate::motor::operation::point::OperatingRow;
use crate::motor::parameter_sweep::MotorSweep;
use crate::motor::parameter_sweep::groups::over_groups;
use crate::motor::parameter_sweep::result::MotorSweepResult;

impl MotorSweep {
    /// Computes all cells; with the feature `parallel`, on the threads of rayon's pool.
    ///
    /// The observer's items are the cells. To keep finished work if a computation ends early, store the
    /// [operations](Self::operations) of single groups; [`Self::result`] combines them.
    ///
    /// # Errors
    /// The errors of the flights, for the first group that fails; an error of the core
    /// ([`Stopped`](bouncing_disk_core::Error::Stopped)) if the observer stops the computation.
    pub fn run(&self, observer: &dyn Observer) -> Result<MotorSweepResult, Error> {
        let watch = Watch::begin(observer, 0, self.cells() as u64)?;
        let outcomes = over_groups(
            self.groups().len(),
            |group| self.groups()[group].len(),
            &watch,
            |group, observer| self.operations(group, observer),
        );
        let done: u64 = outcomes.iter().flat_map(|(_, own)| own).map(|cells| cells.len() as u64).sum();
        if done < self.cells() as u64 && watch.is_stopped() {
            return Err(bouncing_disk_core::Error::Stopped { done, total: self.cells() as u64 }.into());
        }
        let groups = outcomes.into_iter().map(|(_, outcome)| outcome).collect::<Result<Vec<_>, Error>>()?;
        watch.end();
        self.result(&groups)
    }

    /// The result of the [operations](Self::operations) of all groups, in their order.
    ///
    /// # Errors
    /// An error of the core ([`Unfitting`](bouncing_disk_core::Error::Unfitting)) if the number of groups, or
    /// of operations in a group, is wrong.
    pub fn result(&self, groups: &[Vec<OperatingRow>]) -> Result<MotorSweepResult, Error> {
        let fits = |what, found: usize, expected: usize| {
            let (found, expected) = (found as u64, expected as u64);
            let error = bouncing_disk_core::Error::Unfitting { what, found, expected };
            if found == expected { Ok(()) } else { Err(Error::Core(error)) }
        };
        fits("groups of a sweep", groups.len(), self.groups().len())?;
        let mut all = Vec::with_capacity(self.cells());
        for (cells, operations) in self.groups().iter().zip(groups) {
            fits("cells of a group of a sweep", operations.len(), cells.len())?;
            all.extend(cells.iter().copied().zip(operations.iter().cloned()));
        }
        all.sort_by_key(|(cell, _)| *cell);
        let cells = all.into_iter().map(|(_, operation)| operation).collect();
        Ok(MotorSweepResult::new(
            self.motor().clone(),
            *self.settings(),
            self.axes().to_vec(),
            cells,
            self.continued,
        ))
    }
}
