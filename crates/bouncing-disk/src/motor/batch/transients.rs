//! Many speed transients at once: all flights and impacts in lockstep, rests one by one.

use std::sync::atomic::{AtomicUsize, Ordering};

use bouncing_disk_core::run::{Watch, WorkCount, in_parallel, threads};
use bouncing_disk_core::sweep::{Flights, InstructionSet, PartialResults};
use bouncing_disk_core::{ChatterPolicy, Launch, Observer};

use crate::error::Error;
use crate::motor::batch::members::TransientMember;
use crate::motor::batch::rotors::{Carry, Rotors};
use crate::motor::rotor::transient::{FLIGHTS_OF_EVENT, SpeedCurve, TransientRun};

/// If fewer transients than this are under way, they advance one by one. A step of the lanes costs as much as
/// about this many single flights, however few lanes are in use; 24 motors take equally long either way.
const FEWEST: usize = 26;

/// Batches of lanes per thread.
const BATCHES: usize = 8;

/// The transient of each member, or the error that [`transient`](crate::motor::transient()) returns for it,
/// in the order of the members. The results equal those of [`transient`](crate::motor::transient()) to the
/// bit; for many members they are computed several times faster.
///
/// With the feature `parallel`, the members are distributed over the threads of rayon's pool. Neither the
/// number of threads nor the processor's instruction set affects the results. Members under
/// [`ChatterPolicy::Cut`] are computed one by one.
///
/// The observer's items are the members.
///
/// ```
/// use bouncing_disk::core::{Phase, Unobserved};
/// use bouncing_disk::System;
/// use bouncing_disk::motor::{TransientMember, TransientSettings, transient, transients};
///
/// // The motor of Table III at a hundred preloads (m/s^2), 5 ms each.
/// let motor = System::motor();
/// let members = (0..100)
///     .map(|k| {
///         Ok(TransientMember {
///             system: motor.with_disk(|rotor| rotor.preload_acceleration = 5.0 + 0.1 * f64::from(k))?,
///             phase: Phase::new(4.0)?,
///             settings: TransientSettings { duration: 5e-3, intervals: 10, ..TransientSettings::default() },
///         })
///     })
///     .collect::<Result<Vec<_>, bouncing_disk::Error>>()?;
/// let curves = transients(&members, &Unobserved)?;
/// let alone = transient(&members[7].system, members[7].phase, &members[7].settings, &Unobserved);
/// assert_eq!(curves[7], alone);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
///
/// # Errors
/// The core's error if the observer stops the computation; no others.
pub fn transients(
    members: &[TransientMember],
    observer: &dyn Observer,
) -> Result<Vec<Result<SpeedCurve, Error>>, Error> {
    with_instructions(members, observer, InstructionSet::best())
}

fn with_instructions(
    members: &[TransientMember],
    observer: &dyn Observer,
    set: InstructionSet,
) -> Result<Vec<Result<SpeedCurve, Error>>, Error> {
    let mut results = PartialResults::new(members.len());
    let watch = Watch::begin(observer, 0, results.total())?;
    let next = AtomicUsize::new(0);
    let threads = threads().min(members.len()).max(1);
    let lanes = members.len().div_ceil(threads).min(BATCHES * Flights::LANES);
    // It does not matter which worker computes a member.
    let work = |_| Worker::new(members, &next, lanes, set, &watch).run();
    results.extend(in_parallel(threads, work).into_iter().flatten());
    if !results.is_done() {
        return Err(results.stopped().into());
    }
    watch.end();
    Ok(results.into_results()?)
}

/// The outcome of the member with an index.
type Outcome = (usize, Result<SpeedCurve, Error>);

/// Advances members that no other worker has begun until none is left.
struct Worker<'a> {
    members: &'a [TransientMember],
    next: &'a AtomicUsize,
    /// Largest number of lanes in use.
    lanes: usize,
    set: InstructionSet,
    /// The transients in the first lanes, with the indices of their members.
    runs: Vec<(usize, TransientRun)>,
    /// Their curves, stored close together: a run is large, and most of it is seldom needed.
    curves: Vec<Vec<f64>>,
    outcomes: Vec<Outcome>,
    work: WorkCount<'a>,
}

impl<'a> Worker<'a> {
    fn new(
        members: &'a [TransientMember],
        next: &'a AtomicUsize,
        lanes: usize,
        set: InstructionSet,
        watch: &'a Watch<'a>,
    ) -> Self {
        let (runs, curves, outcomes, work) = (Vec::new(), Vec::new(), Vec::new(), watch.work());
        Self { members, next, lanes, set, runs, curves, outcomes, work }
    }

    fn take(&self) -> Option<(usize, &'a TransientMember)> {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        self.members.get(index).map(|member| (index, member))
    }

    fn run(mut self) -> Vec<Outcome> {
        // Once the observer has stopped the computation, unfinished transients are dropped.
        let _ = self.compute_all();
        self.outcomes
    }

    fn compute_all(&mut self) -> Result<(), Error> {
        if self.lanes >= FEWEST {
            self.in_lanes()?;
        }
        while let Some((index, member)) = self.take() {
            self.work.spend(FLIGHTS_OF_EVENT)?;
            let outcome = member.alone(&mut self.work);
            self.finish(index, outcome)?;
        }
        Ok(())
    }

    /// Stores the outcome of a member, unless it was stopped.
    fn finish(&mut self, index: usize, outcome: Result<SpeedCurve, Error>) -> Result<(), Error> {
        if let Err(stopped @ Error::Core(bouncing_disk_core::Error::Stopped { .. })) = outcome {
            return Err(stopped);
        }
        self.work.watch().finish(1);
        self.outcomes.push((index, outcome));
        Ok(())
    }

    /// The next waiting member whose transient does not end before its first flight, at the start of this
    /// flight.
    fn begun(&mut self) -> Result<Option<(usize, TransientRun, Launch)>, Error> {
        loop {
            self.work.spend(FLIGHTS_OF_EVENT)?;
            let Some((index, member)) = self.take() else { return Ok(None) };
            let outcome = if member.settings.policy == ChatterPolicy::Complete {
                match TransientRun::new(&member.system, member.phase, &member.settings) {
                    Ok(mut run) => match fly_next(&mut run, &mut self.work) {
                        Ok(Some(launch)) => return Ok(Some((index, run, launch))),
                        Ok(None) => run.finished(),
                        Err(error) => Err(error),
                    },
                    Err(error) => Err(error),
                }
            } else {
                member.alone(&mut self.work)
            };
            self.finish(index, outcome)?;
        }
    }

    /// Advances members together while there are enough of them.
    fn in_lanes(&mut self) -> Result<(), Error> {
        let batches = self.lanes.div_ceil(Flights::LANES);
        // Without memory for lanes, members are advanced one by one.
        let Ok(mut flights) = Flights::new(self.set, batches) else { return Ok(()) };
        let mut rotors = vec![Rotors::new(); batches];
        let mut may_rest = vec![[0; Flights::LANES]; batches];
        let mut failures: Vec<(usize, Error)> = Vec::new();
        loop {
            while self.runs.len() < self.lanes
                && let Some((index, mut run, launch)) = self.begun()?
            {
                let lane = self.runs.len();
                flights.set_platform(lane, *run.rotor.system().vibration());
                flights.set_launch(lane, launch);
                let (rotors, mut curve) = (&mut rotors[lane / Flights::LANES], Vec::new());
                rotors.begin(lane % Flights::LANES, &mut run, &mut curve);
                self.runs.push((index, run));
                self.curves.push(curve);
            }
            if self.runs.len() < FEWEST {
                break;
            }
            self.work.spend(self.runs.len().next_multiple_of(Flights::LANES) as u64)?;
            flights.fly(self.runs.len(), |lane, error| failures.push((lane, Error::from(error))));
            let used = self.runs.len().div_ceil(Flights::LANES);
            for (batch, (rotors, may_rest)) in rotors.iter_mut().zip(&mut may_rest).enumerate().take(used) {
                if let Some(impacts) = flights.impacts(batch) {
                    flights.run(Carry { impacts, rotors });
                }
                flights.rebound(batch, &rotors.restitution, may_rest);
            }
            // From the last lane on, so that a transient that is moved into a gap has already been checked.
            for batch in (0..used).rev() {
                let first = batch * Flights::LANES;
                // The flights list the lanes in order, and later batches have been processed.
                let failed = failures.iter().rev().map_while(|(lane, _)| lane.checked_sub(first));
                let mut waiting =
                    failed.fold(rotors[batch].attended(&may_rest[batch]), |bits, own| bits | 1 << own);
                while let Some(own) = waiting.checked_ilog2() {
                    waiting &= !(1 << own);
                    let (own, lane) = (own as usize, first + own as usize);
                    let Some((_, run)) = self.runs.get_mut(lane) else { continue };
                    let done = match failures.pop_if(|(failed, _)| *failed == lane) {
                        Some((_, error)) => Err(error),
                        None => {
                            let may_rest = may_rest[batch][own] != 0;
                            let curve = &mut self.curves[lane];
                            let lane_of = (&mut flights, &mut rotors[batch], &mut self.work);
                            attend(lane, run, curve, lane_of, may_rest)
                        }
                    };
                    if matches!(done, Ok(false)) {
                        continue;
                    }
                    let (index, run) = self.runs.swap_remove(lane);
                    self.curves.swap_remove(lane);
                    self.finish(index, done.and_then(|_| run.finished()))?;
                    let last = self.runs.len();
                    if let (Some((_, moved)), Some(launch)) = (self.runs.get(lane), flights.launch(last)) {
                        flights.set_platform(lane, *moved.rotor.system().vibration());
                        flights.set_launch(lane, launch);
                        Rotors::move_lane(&mut rotors, last, lane);
                    }
                }
            }
        }
        let runs = std::mem::take(&mut self.runs).into_iter().zip(std::mem::take(&mut self.curves));
        for (lane, ((index, mut run), mut curve)) in runs.enumerate() {
            let (rotors, own) = (&rotors[lane / Flights::LANES], lane % Flights::LANES);
            rotors.give_back(own, &mut run, &mut curve);
            // Every run has a lane.
            if let Some(launch) = flights.launch(lane) {
                let outcome = finished_alone(run, launch, rotors.motion(own), &mut self.work);
                self.finish(index, outcome)?;
            }
        }
        Ok(())
    }
}

/// Advances a transient to its next flight; `None` if it ends before.
fn fly_next(run: &mut TransientRun, work: &mut WorkCount<'_>) -> Result<Option<Launch>, Error> {
    while !run.is_done() {
        if let Some(launch) = run.rotor.launch() {
            return Ok(Some(launch));
        }
        run.step()?;
        work.spend(FLIGHTS_OF_EVENT)?;
    }
    Ok(None)
}

/// The work after an impact that is specific to a lane; true if the transient is done.
fn attend(
    lane: usize,
    run: &mut TransientRun,
    curve: &mut Vec<f64>,
    (flights, rotors, work): (&mut Flights, &mut Rotors, &mut WorkCount<'_>),
    may_rest: bool,
) -> Result<bool, Error> {
    let own = lane % Flights::LANES;
    rotors.pass_interval(own, curve);
    if rotors.is_over(own) {
        rotors.give_back(own, run, curve);
        return Ok(true);
    }
    if !may_rest {
        return Ok(false);
    }
    let Some(state) = flights.state(lane) else { return Ok(false) };
    let orbit = run.rotor.system().map().orbit(state, ChatterPolicy::Complete);
    // It bounces on, with the lane's launch.
    if orbit.launch().is_some() {
        return Ok(false);
    }
    let (periods, speed) = rotors.motion(own);
    run.rotor.go_on_after(state.phase(), orbit, periods, speed);
    rotors.give_back(own, run, curve);
    let Some(launch) = fly_next(run, work)? else { return Ok(true) };
    flights.set_launch(lane, launch);
    rotors.take(own, run, curve);
    Ok(false)
}

/// The curve of a transient that leaves its lane at a launch.
fn finished_alone(
    mut run: TransientRun,
    launch: Launch,
    (periods, speed): (u64, f64),
    work: &mut WorkCount<'_>,
) -> Result<SpeedCurve, Error> {
    run.rotor.go_on_with(launch, ChatterPolicy::Complete, periods, speed)?;
    while run.advance(work)? {}
    run.finished()
}

#[cfg(test)]
mod tests;
