//! Long calls: how to watch and stop them, and how your own loop counts its work.
//!
//! Every call that may last longer than 0.1 s takes an [`Observer`] as its last argument, or [`Unobserved`]
//! for none; every thread calls it at least once per [`FLIGHTS_BETWEEN_CALLS`] flights.

use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::Mutex;

use crate::numerics::error::Error;

/// Work of one thread between two calls of an observer, in flights: about a millisecond, or about ten without
/// optimisation. So every thread calls an observer far more often than every 50 ms.
///
/// Work is counted and not timed because no computation of a result reads a clock. In lockstep all lanes of a
/// batch count, in use or not, and a batch that is compared with many known orbits counts as more flights.
pub const FLIGHTS_BETWEEN_CALLS: u64 = 1 << 13;

/// The progress of a call: finished items and their total.
///
/// Each call that takes an [`Observer`] documents its items: rows of a grid, orbits, impacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Progress {
    /// Finished items.
    pub done: u64,
    /// The number of all items, or an upper bound if the number is known only at the end.
    pub total: u64,
}

impl Progress {
    /// The finished share, in [0, 1]; 1 if there are no items.
    #[must_use]
    pub fn fraction(&self) -> f64 {
        if self.total == 0 { 1.0 } else { self.done.min(self.total) as f64 / self.total as f64 }
    }
}

/// Receives the progress of a long call, and may stop it.
///
/// Every call that may last longer than 0.1 s takes an observer as its last argument, or [`Unobserved`] for
/// none. It is called before any work, after every [`FLIGHTS_BETWEEN_CALLS`] flights of each thread, and when
/// all is done. If it breaks before all is done, the long call returns [`Error::Stopped`]. The working threads
/// call it concurrently and in no fixed order, so `done` may decrease from one call to the next. An observer
/// never changes any bit of a result.
///
/// Any function or closure with this signature is an observer. The core reads no clock, but the observer may.
///
/// ```
/// use std::ops::ControlFlow;
/// use std::time::{Duration, Instant};
///
/// use bouncing_disk_core::attractors::{Axis, BasinSettings, Grid};
/// use bouncing_disk_core::{Error, ImpactMap, Progress, Vibration};
///
/// let map = ImpactMap::new(Vibration::from_axial_forcing(0.5)?, 0.5)?;
/// let grid = Grid::new(Axis::new(0.0, 1.0, 60)?, Axis::new(0.0, 2.0, 40)?)?;
///
/// // Shows how far it is, and stops when the time is up.
/// let began = Instant::now();
/// let observer = |progress: Progress| {
///     eprint!("\r{} of {} rows", progress.done, progress.total);
///     let in_time = began.elapsed() < Duration::from_secs(60);
///     if in_time { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
/// };
/// match map.basins(grid, &[], BasinSettings::default(), &observer) {
///     Ok(basins) => assert_eq!(basins.labels().len(), 2_400),
///     Err(Error::Stopped { done, total }) => println!("{done} of {total} rows so far"),
///     Err(error) => return Err(error),
/// }
/// # Ok::<(), Error>(())
/// ```
pub trait Observer: Sync {
    /// Receives the progress; a break stops the call.
    fn observe(&self, progress: Progress) -> ControlFlow<()>;
}

impl<F: Fn(Progress) -> ControlFlow<()> + Sync> Observer for F {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        self(progress)
    }
}

/// No observer: nothing is watched or stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Unobserved;

impl Observer for Unobserved {
    #[inline]
    fn observe(&self, _: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// The progress of an observed call: counts the finished items of all threads, and records whether the
/// observer has stopped the call.
///
/// The long calls of this crate and of the model count their work with it; your own loop over single flights
/// may do so too.
///
/// ```
/// use bouncing_disk_core::run::Watch;
/// use bouncing_disk_core::{ImpactMap, ImpactState, Unobserved, Vibration};
///
/// let map = ImpactMap::new(Vibration::from_axial_forcing(0.55)?, 0.5)?;
/// let mut state = ImpactState::from_normalised(0.8, 1.3)?;
/// let watch = Watch::begin(&Unobserved, 0, 20_000)?;
/// let mut work = watch.work();
/// for _ in 0..20_000 {
///     state = map.step(state)?.into();
///     watch.finish(1);
///     work.spend(1)?;
/// }
/// watch.end();
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
pub struct Watch<'o> {
    observer: &'o dyn Observer,
    done: AtomicU64,
    total: u64,
    stopped: AtomicBool,
}

impl core::fmt::Debug for Watch<'_> {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        formatter
            .debug_struct("Watch")
            .field("progress", &self.progress())
            .field("stopped", &self.is_stopped())
            .finish_non_exhaustive()
    }
}

impl<'o> Watch<'o> {
    /// Begins a call of `total` items, `done` of which earlier calls have finished, and calls the observer
    /// for the first time.
    ///
    /// # Errors
    /// [`Error::Stopped`] if it breaks.
    pub fn begin(observer: &'o dyn Observer, done: u64, total: u64) -> Result<Self, Error> {
        let watch = Self { observer, done: AtomicU64::new(done), total, stopped: AtomicBool::new(false) };
        watch.ask()?;
        Ok(watch)
    }

    /// Counts items as finished.
    pub fn finish(&self, items: u64) {
        self.done.fetch_add(items, Ordering::Relaxed);
    }

    /// Sets how many items are finished: for a single-threaded call, which keeps its own count.
    pub fn set_done(&self, items: u64) {
        self.done.store(items, Ordering::Relaxed);
    }

    /// The progress of the call.
    #[must_use]
    pub fn progress(&self) -> Progress {
        Progress { done: self.done.load(Ordering::Relaxed), total: self.total }
    }

    /// Whether the observer has stopped the call.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Calls the observer, unless it has broken before.
    ///
    /// # Errors
    /// [`Error::Stopped`] if it breaks or has broken.
    pub fn ask(&self) -> Result<(), Error> {
        let Progress { done, total } = self.progress();
        if self.is_stopped() {
            return Err(Error::Stopped { done, total });
        }
        match self.observer.observe(Progress { done, total }) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => {
                self.stopped.store(true, Ordering::Relaxed);
                Err(Error::Stopped { done, total })
            }
        }
    }

    /// Reports to the observer that all is done; its answer no longer matters.
    pub fn end(&self) {
        let Progress { total, .. } = self.progress();
        // The answer does not matter: nothing is left to stop.
        let _ = self.observer.observe(Progress { done: total, total });
    }

    /// A count of the work of one thread.
    #[must_use]
    pub const fn work(&self) -> WorkCount<'_> {
        WorkCount { watch: self, work: 0 }
    }
}

/// The work of one thread of an observed call: see [`Watch::work`].
#[derive(Debug, Clone)]
pub struct WorkCount<'w> {
    watch: &'w Watch<'w>,
    work: u64,
}

impl<'w> WorkCount<'w> {
    /// Counts work, in flights; calls the observer after every [`FLIGHTS_BETWEEN_CALLS`].
    ///
    /// # Errors
    /// [`Error::Stopped`] if it breaks, or has broken in another thread.
    #[inline(always)]
    pub fn spend(&mut self, flights: u64) -> Result<(), Error> {
        self.work += flights;
        if self.work < FLIGHTS_BETWEEN_CALLS { Ok(()) } else { self.ask() }
    }

    /// Counts finished items of one flight each.
    ///
    /// # Errors
    /// Errors of [`Self::spend`].
    #[inline]
    pub fn finish(&mut self, flights: u64) -> Result<(), Error> {
        self.watch.finish(flights);
        self.spend(flights)
    }

    #[cold]
    fn ask(&mut self) -> Result<(), Error> {
        self.work = 0;
        self.watch.ask()
    }

    /// The call that the work belongs to.
    #[must_use]
    pub const fn watch(&self) -> &'w Watch<'w> {
        self.watch
    }
}

/// The results of `of` for the indices below `count`, in increasing order. With the feature `parallel` the
/// threads of rayon's pool share the indices.
///
/// A thread that waits for results helps with the work; calls may be nested.
pub fn in_parallel<R: Send>(count: usize, of: impl Fn(usize) -> R + Sync) -> Vec<R> {
    let results: Vec<Mutex<Option<R>>> = (0..count).map(|_| Mutex::new(None)).collect();
    for_each_index(count, &|index| {
        let result = of(index);
        // No other thread locks it.
        if let Ok(mut place) = results[index].lock() {
            *place = Some(result);
        }
    });
    results.into_iter().filter_map(|result| result.into_inner().ok().flatten()).collect()
}

/// How many indices [`in_parallel`] works on at the same time.
#[must_use]
pub fn threads() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    1
}

// Not generic, so that the code rayon needs is compiled once and not for every call.
fn for_each_index(count: usize, work: &(dyn Fn(usize) + Sync)) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        (0..count).into_par_iter().with_max_len(1).for_each(work);
    }
    #[cfg(not(feature = "parallel"))]
    (0..count).for_each(work);
}

/// The function with which a part of a long call counts its flights, in steps of its own choice; an error
/// ends the call.
pub(crate) type Tick<'t> = &'t mut dyn FnMut(u64) -> Result<(), Error>;

#[cfg(test)]
pub(crate) mod testing {
    use core::ops::ControlFlow;
    use core::sync::atomic::{AtomicU64, Ordering};
    use std::sync::Mutex;

    use super::{Observer, Progress};

    /// An observer that breaks at its nth call and at every later one.
    #[derive(Debug)]
    pub(crate) struct StopAfter {
        calls: u64,
        asked: AtomicU64,
        last: Mutex<Progress>,
    }

    impl StopAfter {
        pub(crate) fn calls(calls: u64) -> Self {
            Self { calls, asked: AtomicU64::new(0), last: Mutex::default() }
        }

        /// How many times it was called.
        pub(crate) fn asked(&self) -> u64 {
            self.asked.load(Ordering::Relaxed)
        }

        /// The last progress that it received.
        pub(crate) fn last(&self) -> Progress {
            *self.last.lock().expect("no panic")
        }
    }

    impl Observer for StopAfter {
        fn observe(&self, progress: Progress) -> ControlFlow<()> {
            *self.last.lock().expect("no panic") = progress;
            if self.asked.fetch_add(1, Ordering::Relaxed) + 1 < self.calls {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::testing::StopAfter;

    #[test]
    fn what_is_computed_side_by_side_comes_in_order() {
        let of = |row: usize| in_parallel(row, |column| 100 * row + column);
        let rows: Vec<Vec<usize>> =
            (0..40).map(|row| (0..row).map(|column| 100 * row + column).collect()).collect();
        assert_eq!(in_parallel(40, of), rows);
        assert!(threads() > 0);
    }

    #[test]
    fn an_observer_is_asked_first_and_then_after_so_many_flights() {
        let calls = StopAfter::calls(3);
        let watch = Watch::begin(&calls, 5, 100).expect("goes on");
        let mut work = watch.work();
        assert_eq!((1..FLIGHTS_BETWEEN_CALLS).find_map(|_| work.spend(1).err()), None);
        assert_eq!(calls.asked(), 1);
        watch.finish(2);
        assert_eq!((work.spend(1), calls.asked()), (Ok(()), 2));
        assert_eq!(watch.progress(), Progress { done: 7, total: 100 });
        // A large amount of work calls the observer once.
        let stopped = Err(Error::Stopped { done: 7, total: 100 });
        assert_eq!((work.spend(u64::MAX / 2), calls.asked()), (stopped, 3));
        // No thread calls it again.
        assert_eq!((watch.work().spend(FLIGHTS_BETWEEN_CALLS), calls.asked()), (stopped, 3));
        assert!(watch.is_stopped());
    }

    #[test]
    fn the_first_answer_may_stop_and_the_last_one_may_not() {
        assert_eq!(
            Watch::begin(&StopAfter::calls(1), 3, 4).map(|_| ()),
            Err(Error::Stopped { done: 3, total: 4 })
        );
        let calls = StopAfter::calls(2);
        Watch::begin(&calls, 3, 4).expect("goes on").end();
        assert_eq!((calls.asked(), calls.last()), (2, Progress { done: 4, total: 4 }));
    }

    #[test]
    fn of_nothing_everything_is_finished() {
        let fraction = |done, total| Progress { done, total }.fraction();
        assert!((fraction(1, 4) - 0.25).abs() < 1e-15);
        assert!(fraction(0, 0) >= 1.0 && fraction(9, 4) <= 1.0 && fraction(0, 4) <= 0.0);
    }

    #[test]
    fn closures_and_trait_objects_are_observers() {
        let closure = |_: Progress| ControlFlow::Continue(());
        let boxed: Box<dyn Observer> = Box::new(closure);
        for observer in [&closure as &dyn Observer, &Unobserved, &*boxed] {
            assert!(observer.observe(Progress::default()).is_continue());
        }
    }
}
