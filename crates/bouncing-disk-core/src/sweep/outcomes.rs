//! Sweeps over orbits, and the results of finished orbits.

use core::ops::ControlFlow;

use super::events::SweepEvent;
use super::runner;
use crate::numerics::error::Error;
use crate::numerics::stored::read_checked;
use crate::run::{Observer, Watch};
use crate::sweep::bouncing_map::BouncingOrbit;

/// The results of the finished items of a list, in the order of the items.
///
/// Deserialising checks that the indices increase and belong to existing items.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedResults<T>"))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: serde::Deserialize<'de>")))]
pub struct PartialResults<T> {
    total: usize,
    /// The finished items by increasing index. Pairs allow any type of result, even the unit type.
    finished: Vec<(usize, T)>,
}

read_checked!(PartialResults<T> as UncheckedResults {
    total: usize,
    finished: Vec<(usize, T)>,
});

impl<T> PartialResults<T> {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        let Self { total, finished } = self;
        let unfitting = |what, found: usize, expected: usize| {
            Err(Error::Unfitting { what, found: found as u64, expected: expected as u64 })
        };
        if let Some((index, _)) = finished.iter().find(|(index, _)| index >= total) {
            return unfitting("index of a finished item", *index, total.saturating_sub(1));
        }
        if let Some(pair) = finished.windows(2).find(|pair| pair[0].0 >= pair[1].0) {
            return unfitting("index of a finished item, out of order", pair[0].0, pair[1].0);
        }
        Ok(())
    }

    /// No results yet, for `total` items.
    #[must_use]
    pub const fn new(total: usize) -> Self {
        Self { total, finished: Vec::new() }
    }

    /// Number of finished items.
    #[must_use]
    pub const fn done(&self) -> u64 {
        self.finished.len() as u64
    }

    /// Number of items.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.total as u64
    }

    /// Whether all items are finished.
    #[must_use]
    pub const fn is_done(&self) -> bool {
        self.finished.len() == self.total
    }

    /// The result of an item; `None` if it is not finished or does not exist.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<&T> {
        let place = self.finished.binary_search_by_key(&index, |(index, _)| *index).ok()?;
        self.finished.get(place).map(|(_, result)| result)
    }

    /// The finished items with their indices, in increasing order.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &T)> {
        self.finished.iter().map(|(index, result)| (*index, result))
    }

    /// The indices of the unfinished items, in increasing order.
    ///
    /// # Errors
    /// [`Error::Unfitting`] unless the list has `items` items.
    pub fn open(&self, items: usize) -> Result<Vec<usize>, Error> {
        if items != self.total {
            let (found, expected) = (items as u64, self.total as u64);
            return Err(Error::Unfitting { what: "items of a run", found, expected });
        }
        let mut finished = self.finished.iter().map(|(index, _)| *index).peekable();
        Ok((0..self.total).filter(|index| finished.next_if_eq(index).is_none()).collect())
    }

    /// Adds results of existing items. An item that was already finished keeps its first result.
    pub fn extend(&mut self, results: impl IntoIterator<Item = (usize, T)>) {
        let (total, last) = (self.total, self.finished.len().saturating_sub(1));
        self.finished.extend(results.into_iter().filter(|(index, _)| *index < total));
        // A result that arrives in order is added without moving any other.
        if !self.finished[last..].is_sorted_by(|(one, _), (next, _)| one < next) {
            self.finished = runner::in_order(total, core::mem::take(&mut self.finished));
        }
    }

    /// [`Error::Stopped`] with the numbers of finished and of all items.
    #[must_use]
    pub const fn stopped(&self) -> Error {
        Error::Stopped { done: self.done(), total: self.total() }
    }

    /// The results of all items.
    ///
    /// # Errors
    /// [`Error::Stopped`] if one is not finished, which [`Self::is_done`] shows.
    pub fn into_results(self) -> Result<Vec<T>, Error> {
        if !self.is_done() {
            return Err(self.stopped());
        }
        Ok(self.finished.into_iter().map(|(_, result)| result).collect())
    }
}

/// [`sweep`] with visitors of one type and results of another, made when an orbit is finished.
pub(crate) fn sweep_with<O: BouncingOrbit, W: Send, T>(
    orbits: &[O],
    start: impl Fn(usize) -> W + Sync,
    visit: impl Fn(&mut W, &SweepEvent) -> ControlFlow<()> + Sync,
    result: impl Fn(W) -> Result<T, Error>,
    observer: &dyn Observer,
) -> Result<Vec<T>, Error> {
    let total = orbits.len();
    let watch = Watch::begin(observer, 0, total as u64)?;
    let mut failure = None;
    let outcomes = O::follow(orbits, &start, &visit, &watch);
    let results: Vec<T> = outcomes
        .into_iter()
        .filter_map(|(_, outcome)| match outcome.and_then(&result) {
            Ok(result) => Some(result),
            Err(error) => {
                failure.get_or_insert(error);
                None
            }
        })
        .collect();
    match failure {
        // After one thread was told to stop, others may have finished all.
        _ if results.len() == total => {
            watch.end();
            Ok(results)
        }
        Some(error) if !watch.is_stopped() => Err(error),
        _ => Err(Error::Stopped { done: results.len() as u64, total: total as u64 }),
    }
}

/// Follows many independent orbits, each until its visitor has seen enough or it ends, and returns the
/// visitors' results in the order of the orbits.
///
/// `start` creates the visitor's value for the orbit with a given index. `visit` receives the events of
/// [`Orbit::advance`](crate::Orbit::advance) one by one, and breaks when the orbit need not be followed
/// further. With the feature `parallel` the orbits are distributed over the threads of rayon's pool. Neither
/// the number of threads nor the instructions of the processor changes any bit of the results.
///
/// An endless orbit whose visitor never breaks is followed forever, or until the observer breaks.
///
/// The items of `observer` are the orbits.
///
/// ```
/// use core::ops::ControlFlow;
/// use bouncing_disk_core::sweep::{SweepEvent, sweep};
/// use bouncing_disk_core::{ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration};
///
/// // How many impacts, up to a hundred, before a disk comes to rest, against the forcing.
/// let start = ImpactState::from_normalised(0.8, 1.3)?;
/// let orbits = (0..200)
///     .map(|k| {
///         let map = ImpactMap::new(Vibration::from_axial_forcing(0.3 + 1e-3 * f64::from(k))?, 0.5)?;
///         Ok(map.orbit(start, ChatterPolicy::Complete))
///     })
///     .collect::<Result<Vec<_>, bouncing_disk_core::Error>>()?;
/// let lives = sweep(&orbits, |_| 0, |lived, event| match event {
///     SweepEvent::Impact(_) if *lived < 100 => {
///         *lived += 1;
///         ControlFlow::Continue(())
///     }
///     _ => ControlFlow::Break(()),
/// }, &Unobserved)?;
/// assert!(lives[0] < 100 && lives[150] == 100);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// # Errors
/// The error of the first orbit, in order, that has no next impact (see
/// [`Orbit::advance`](crate::Orbit::advance)).
pub fn sweep<O: BouncingOrbit, S: Send>(
    orbits: &[O],
    start: impl Fn(usize) -> S + Sync,
    visit: impl Fn(&mut S, &SweepEvent) -> ControlFlow<()> + Sync,
    observer: &dyn Observer,
) -> Result<Vec<S>, Error> {
    sweep_with(orbits, start, visit, Ok, observer)
}

#[cfg(test)]
mod tests;
