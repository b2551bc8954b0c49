//! Orbits in lanes: a free lane takes the next waiting orbit.

use core::ops::ControlFlow;
use core::sync::atomic::{AtomicUsize, Ordering};

use super::events::{SweepEvent, SweepImpact, advance};
use crate::map::impact_map::Orbit;
use crate::numerics::error::Error;
use crate::run::{Watch, WorkCount, in_parallel, threads};
use crate::sweep::bouncing_map::{BouncingOrbit, OrbitOutcome};
use crate::sweep::lockstep::lanes::{Batch, FlightScheduler, InstructionSet, LANES, Purpose};

/// If fewer orbits are under way, they are advanced one by one: a step of the lanes costs about as much as
/// this many single flights, nearly independently of the number of lanes in use.
const FEWEST: usize = 12;

/// Batches of lanes of one thread.
const BATCHES: usize = 8;

impl BouncingOrbit for Orbit {
    #[inline]
    fn next_event(&mut self) -> Result<Option<SweepEvent>, Error> {
        advance(self)
    }

    /// Follows the orbits in lanes.
    fn follow<S: Send>(
        orbits: &[Self],
        start: &(impl Fn(usize) -> S + Sync),
        visit: &(impl Fn(&mut S, &SweepEvent) -> ControlFlow<()> + Sync),
        watch: &Watch<'_>,
    ) -> Vec<OrbitOutcome<S>> {
        run(orbits, start, visit, InstructionSet::best(), watch)
    }
}

/// Follows the orbits until they are done or the observer breaks; returns the outcomes in the order of the
/// orbits.
pub(super) fn run<S: Send>(
    orbits: &[Orbit],
    start: &(impl Fn(usize) -> S + Sync),
    visit: &(impl Fn(&mut S, &SweepEvent) -> ControlFlow<()> + Sync),
    set: InstructionSet,
    watch: &Watch<'_>,
) -> Vec<OrbitOutcome<S>> {
    let queue = Queue { orbits, next: AtomicUsize::new(0) };
    let threads = threads().min(orbits.len());
    // Enough lanes for every thread's share.
    let share = orbits.len().div_ceil(threads.max(1));
    let lanes = share.next_multiple_of(LANES).clamp(LANES, BATCHES * LANES);
    let work = || {
        let (queue, work) = (&queue, watch.work());
        Worker { queue, start, visit, lanes, runs: Vec::new(), outcomes: Vec::new(), work }.run(set)
    };
    // It does not matter which worker follows an orbit.
    in_order(orbits.len(), in_parallel(threads, |_| work()).into_iter().flatten())
}

/// Results of the items from 0 to `total` in order, keeping the first of each. A sort would be compiled for
/// every type of result.
pub(super) fn in_order<T>(total: usize, results: impl IntoIterator<Item = (usize, T)>) -> Vec<(usize, T)> {
    let mut places: Vec<Option<T>> = (0..total).map(|_| None).collect();
    for (index, result) in results {
        places[index].get_or_insert(result);
    }
    places.into_iter().enumerate().filter_map(|(index, result)| Some((index, result?))).collect()
}

/// The orbits not yet begun.
struct Queue<'a> {
    orbits: &'a [Orbit],
    next: AtomicUsize,
}

impl Queue<'_> {
    fn take(&self) -> Option<(usize, Orbit)> {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        self.orbits.get(index).map(|orbit| (index, orbit.clone()))
    }
}

/// An orbit being followed.
struct Run<S> {
    index: usize,
    orbit: Orbit,
    value: S,
}

/// The outcome of an orbit; `None` while it flies.
type Done = Option<Result<(), Error>>;

struct Worker<'a, S, Start, Visit> {
    queue: &'a Queue<'a>,
    start: &'a Start,
    visit: &'a Visit,
    /// Lanes to fill.
    lanes: usize,
    /// The orbits of the first lanes.
    runs: Vec<Run<S>>,
    outcomes: Vec<OrbitOutcome<S>>,
    work: WorkCount<'a>,
}

impl<S, Start, Visit> Worker<'_, S, Start, Visit>
where
    Start: Fn(usize) -> S,
    Visit: Fn(&mut S, &SweepEvent) -> ControlFlow<()>,
{
    fn run(mut self, set: InstructionSet) -> Vec<OrbitOutcome<S>> {
        // Once the observer has broken, unfinished orbits are dropped.
        let _ = self.follow_all(set);
        self.outcomes
    }

    fn follow_all(&mut self, set: InstructionSet) -> Result<(), Error> {
        if self.queue.orbits.len() >= FEWEST {
            self.in_lanes(set)?;
        }
        loop {
            let run = match self.runs.pop() {
                Some(run) => Some(run),
                None => self.begun()?,
            };
            let Some(mut run) = run else { return Ok(()) };
            let done = loop {
                self.work.spend(1)?;
                if let Some(done) = run.event(self.visit) {
                    break done;
                }
            };
            self.finish(run, done);
        }
    }

    fn finish(&mut self, run: Run<S>, done: Result<(), Error>) {
        // A failed orbit is not finished.
        if done.is_ok() {
            self.work.watch().finish(1);
        }
        self.outcomes.push((run.index, done.map(|()| run.value)));
    }

    /// The next waiting orbit that is not done before its first launch.
    fn begun(&mut self) -> Result<Option<Run<S>>, Error> {
        loop {
            self.work.spend(1)?;
            let Some((index, orbit)) = self.queue.take() else { return Ok(None) };
            let mut run = Run { index, orbit, value: (self.start)(index) };
            match run.show_until_launch(self.visit) {
                None => return Ok(Some(run)),
                Some(done) => self.finish(run, done),
            }
        }
    }

    /// Advances orbits together while there are enough of them.
    fn in_lanes(&mut self, set: InstructionSet) -> Result<(), Error> {
        // A launch is set as an impact with its speed and a rebound without loss, because an orbit that
        // separates from rest has no impact before it.
        let Some(map) = self.queue.orbits.first().map(Orbit::map) else { return Ok(()) };
        let mut scheduler = Box::new(FlightScheduler::new(set, Purpose::Launches));
        let mut batches = vec![Batch::new(*map.vibration()); self.lanes / LANES];
        let mut failures: Vec<(usize, Error)> = Vec::new();
        loop {
            while self.runs.len() < self.lanes
                && let Some(run) = self.begun()?
            {
                place(&mut batches, self.runs.len(), &run.orbit);
                self.runs.push(run);
            }
            if self.runs.len() < FEWEST {
                return Ok(());
            }
            self.work.spend(self.runs.len().next_multiple_of(LANES) as u64)?;
            let used = &mut batches[..self.runs.len().div_ceil(LANES)];
            for batch in &mut *used {
                let rows = batch.rebounding();
                for (speed, velocity) in rows.speed.iter_mut().zip(&rows.impacts.velocity) {
                    *speed = -velocity;
                }
            }
            scheduler.fly(used, self.runs.len(), |lane, error| failures.push((lane, error)));
            // From the last lane down, so that an orbit moved into a gap has already been advanced.
            for lane in (0..self.runs.len()).rev() {
                // The scheduler reports the lanes in order.
                let done = match failures.pop_if(|(failed, _)| *failed == lane) {
                    Some((_, error)) => Some(Err(error)),
                    None => self.runs[lane].landed(&mut batches, lane, self.visit),
                };
                if let Some(done) = done {
                    let run = self.runs.swap_remove(lane);
                    self.finish(run, done);
                    if let Some(moved) = self.runs.get(lane) {
                        place(&mut batches, lane, &moved.orbit);
                    }
                }
            }
        }
    }
}

impl<S> Run<S> {
    /// Shows the visitor the next event of a separately advanced orbit.
    fn event(&mut self, visit: &impl Fn(&mut S, &SweepEvent) -> ControlFlow<()>) -> Done {
        match advance(&mut self.orbit) {
            Ok(Some(event)) if visit(&mut self.value, &event).is_continue() => None,
            Ok(_) => Some(Ok(())),
            Err(error) => Some(Err(error)),
        }
    }

    /// Shows the visitor the events before the next launch.
    fn show_until_launch(&mut self, visit: &impl Fn(&mut S, &SweepEvent) -> ControlFlow<()>) -> Done {
        while self.orbit.launch().is_none() {
            let done = self.event(visit);
            if done.is_some() {
                return done;
            }
        }
        None
    }

    /// Shows the visitor the impact of a lane and the following events, and sets its next launch.
    #[inline]
    fn landed(
        &mut self,
        batches: &mut [Batch],
        lane: usize,
        visit: &impl Fn(&mut S, &SweepEvent) -> ControlFlow<()>,
    ) -> Done {
        let (batch, own) = (&batches[lane / LANES], lane % LANES);
        let state = batch.impact_state(own);
        let landing = SweepImpact::new(batch.launch_phase(own), state, batch.impacts().turns[own] as u64);
        self.orbit.land(state, landing.decisive_duration(&self.orbit));
        if visit(&mut self.value, &SweepEvent::Impact(landing)).is_break() {
            return Some(Ok(()));
        }
        if self.orbit.launch().is_none() {
            let done = self.show_until_launch(visit);
            if done.is_some() {
                return done;
            }
        }
        set_launch(batches, lane, &self.orbit);
        None
    }
}

/// Puts an orbit that is about to leave the platform into a lane.
fn place(batches: &mut [Batch], lane: usize, orbit: &Orbit) {
    batches[lane / LANES].set_platform(lane % LANES, *orbit.map().vibration());
    set_launch(batches, lane, orbit);
}

/// Sets the impact from which a rebound without loss leads to the launch of the orbit.
#[inline]
fn set_launch(batches: &mut [Batch], lane: usize, orbit: &Orbit) {
    if let Some(launch) = orbit.launch() {
        batches[lane / LANES].set_impact(lane % LANES, launch.phase(), -launch.relative_speed());
    }
}
