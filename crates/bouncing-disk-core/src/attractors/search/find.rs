//! The search for attractors.

use super::cells::VisitedCells;
use super::follow::{Seen, come_back, first_look, long_look, overlap};
use super::settings::AttractorSearch;
use super::starts::starts;
use super::{AfterRest, Attractor, AttractorKind, Attractors, MOST_ATTRACTORS, Recurrence};
use crate::attractors::basin::KnownOrbit;
use crate::attractors::verdict::{UndecidedReason, Verdict};
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::Error;
use crate::numerics::fraction::Fraction;
use crate::orbits::periodic::newton::same_orbit;
use crate::orbits::periodic::{PeriodicOrbit, Stability, phase_difference};
use crate::run::{Observer, Progress};

use core::f64::consts::{PI, TAU};
use core::ops::ControlFlow;

/// Orbits of one impact that are tried as candidates, from those with the longest flights down.
const MOST_PERIOD_ONE: u64 = 10_000;

/// Starts on each circle by which the radius of an attractor is found.
const SAMPLES: u32 = 64;

/// How many cells away an orbit that creeps towards a marginal one may have been from it.
const CELLS_AWAY: f64 = 1.5;

/// Reports the progress of a part to the observer of the whole search: the items of the part, or none of
/// them, after those that are done.
struct Part<'o> {
    observer: &'o dyn Observer,
    done: u64,
    total: u64,
    counts: bool,
}

impl Observer for Part<'_> {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        let own = if self.counts { progress.done } else { 0 };
        self.observer.observe(Progress { done: self.done + own, total: self.total })
    }
}

impl Part<'_> {
    /// The error of a part that was stopped, with the numbers of the whole.
    fn whole<T>(&self, result: Result<T, Error>) -> Result<T, Error> {
        result.map_err(|error| match error {
            Error::Stopped { done, .. } => {
                let own = if self.counts { done } else { 0 };
                Error::Stopped { done: self.done + own, total: self.total }
            }
            other => other,
        })
    }
}

/// A stable or marginal orbit, and the starts that ended on it.
struct Periodic {
    orbit: PeriodicOrbit,
    starts: u64,
}

/// An attractor that is known by its cells.
struct Recurrent {
    verdict: Verdict,
    recurrence: Recurrence,
    starts: u64,
}

/// Where a disk ends that has come to rest.
enum RestLeadsTo {
    Periodic(PeriodicOrbit),
    Recurrent(usize),
    Nothing(AfterRest),
}

struct Finder<'a> {
    map: &'a ImpactMap,
    search: &'a AttractorSearch,
    observer: &'a dyn Observer,
    rests: u64,
    periodic: Vec<Periodic>,
    recurrent: Vec<Recurrent>,
    /// Starts that were followed, and those whose attractor is known.
    done: u64,
}

pub(super) fn find(
    map: &ImpactMap,
    search: &AttractorSearch,
    observer: &dyn Observer,
) -> Result<Attractors, Error> {
    let mut finder =
        Finder { map, search, observer, rests: 0, periodic: Vec::new(), recurrent: Vec::new(), done: 0 };
    let starts = starts(map, search.starts());
    let part = Part { counts: true, ..finder.part() };
    let seen = part.whole(first_look(map, &starts, search.first_look(), &part))?;
    finder.done = starts.len() as u64;
    let mut open = Vec::new();
    for (start, seen) in starts.iter().zip(seen) {
        match seen {
            Seen::Rest => finder.rests += 1,
            Seen::Verdict(Verdict::Periodic { impacts, platform_periods, state, .. }) => {
                finder.repeats(state, impacts, platform_periods, 1);
            }
            Seen::Verdict(Verdict::Undecided {
                reason: UndecidedReason::OnPeriodicOrbit { impacts, state, .. },
                ..
            }) if finder.stays_at(state, impacts) => {}
            Seen::Verdict(_) => {
                open.push(*start);
                continue;
            }
        }
        finder.done += 1;
    }
    finder.add_candidates()?;
    finder.settle(open)?;
    let after = finder.after_rest()?;
    let found = finder.into_attractors(after)?;
    let total = 2 * u64::from(search.starts());
    // Whatever it says, there is nothing left to stop.
    let _ = observer.observe(Progress { done: total, total });
    Ok(found)
}

impl<'a> Finder<'a> {
    /// A part whose items do not count.
    fn part(&self) -> Part<'a> {
        let total = 2 * u64::from(self.search.starts());
        Part { observer: self.observer, done: self.done, total, counts: false }
    }

    /// Counts starts that approach an attracting orbit through this impact; if no orbit goes through it, the
    /// starts stay undecided.
    fn repeats(&mut self, state: ImpactState, impacts: u64, platform_periods: u64, starts: u64) {
        let scale = self.map.vibration().peak_acceleration();
        let known = self.periodic.iter_mut().find(|known| {
            known.orbit.period() as u64 == impacts
                && known.orbit.platform_periods == platform_periods
                && known.orbit.distance(state, scale) <= known.orbit.position_error
        });
        if let Some(known) = known {
            known.starts += starts;
        } else if let Ok(orbit) = self.orbit_through(state, impacts) {
            self.add(orbit, starts);
        }
    }

    /// Counts a start that stays at an orbit through this impact, unless that repels.
    fn stays_at(&mut self, state: ImpactState, impacts: u64) -> bool {
        let orbit = self.orbit_through(state, impacts).ok();
        let orbit = orbit.filter(|orbit| orbit.stability() != Stability::Unstable);
        orbit.map(|orbit| self.add(orbit, 1)).is_some()
    }

    /// The orbit of so many impacts through this one, its fastest impact first.
    fn orbit_through(&self, state: ImpactState, impacts: u64) -> Result<PeriodicOrbit, Error> {
        let mut states = vec![state];
        for _ in 1..impacts {
            states.push(self.map.step(states[states.len() - 1])?.into());
        }
        let fastest = (1..states.len()).fold(0, |fastest, i| {
            if states[i].velocity() < states[fastest].velocity() { i } else { fastest }
        });
        states.rotate_left(fastest);
        self.map.prime_orbit(&states)
    }

    /// Adds an orbit that may attract, unless it is known.
    fn add(&mut self, orbit: PeriodicOrbit, starts: u64) {
        match self.periodic.iter_mut().find(|known| same_orbit(&known.orbit, &orbit)) {
            Some(known) => known.starts += starts,
            None if orbit.stability() == Stability::Unstable => {}
            None => self.periodic.push(Periodic { orbit, starts }),
        }
    }

    /// The marginal orbit towards which an orbit that visited these cells has crept.
    fn marginal(&mut self, recurrence: &Recurrence) -> Option<&mut Periodic> {
        let cells = &recurrence.cells;
        let width = CELLS_AWAY / f64::from(cells.side());
        let beside = |orbit: &PeriodicOrbit, (phase, velocity): (f64, f64)| {
            orbit.states.iter().any(|state| {
                phase_difference(state.phase().angle(), phase).abs() <= width * TAU
                    && (state.velocity() - velocity).abs() <= width * cells.top()
            })
        };
        self.periodic.iter_mut().find(|known| {
            known.orbit.stability() == Stability::Marginal
                && cells.centres().all(|centre| beside(&known.orbit, centre))
        })
    }

    /// Finds the attractors of the starts that have neither rested nor repeated themselves.
    fn settle(&mut self, mut open: Vec<ImpactState>) -> Result<(), Error> {
        let looks = (self.search.long_look(), self.search.cells());
        while let Some(start) = open.first().copied() {
            open.remove(0);
            self.done += 1;
            let part = self.part();
            let (seen, recurrence) = part.whole(long_look(self.map, start, false, looks, &part))?;
            let verdict = match seen {
                Seen::Rest => {
                    self.rests += 1;
                    continue;
                }
                Seen::Verdict(Verdict::Periodic { impacts, platform_periods, state, .. }) => {
                    self.repeats(state, impacts, platform_periods, 1);
                    continue;
                }
                // Next to a doubling only the motion itself shows whether it repeats after twice as many
                // impacts.
                Seen::Verdict(Verdict::Undecided {
                    reason: UndecidedReason::OnPeriodicOrbit { impacts, .. },
                    ..
                }) if self.stays_at(recurrence.state, 2 * impacts) => continue,
                Seen::Verdict(verdict) => verdict,
            };
            if self.marginal(&recurrence).is_some() {
                let (left, back) = self.compare(&recurrence.cells, &open)?;
                open = left;
                if let Some(known) = self.marginal(&recurrence) {
                    known.starts += 1 + back;
                }
                continue;
            }
            let (number, new) = self.recurs(verdict, recurrence);
            self.recurrent[number].starts += 1;
            if new {
                let cells = self.recurrent[number].recurrence.cells.clone();
                let (left, back) = self.compare(&cells, &open)?;
                open = left;
                self.recurrent[number].starts += back;
            }
        }
        Ok(())
    }

    /// The number of the attractor known by these cells, and whether it is new.
    fn recurs(&mut self, verdict: Verdict, recurrence: Recurrence) -> (usize, bool) {
        let same = |known: &Recurrent| overlap(&known.recurrence.cells, &recurrence.cells);
        if let Some(number) = self.recurrent.iter().position(same) {
            return (number, false);
        }
        self.recurrent.push(Recurrent { verdict, recurrence, starts: 0 });
        (self.recurrent.len() - 1, true)
    }

    /// The starts whose attractor is not known but for those that rest or come back to these cells, and how
    /// many do.
    fn compare(
        &mut self,
        cells: &VisitedCells,
        open: &[ImpactState],
    ) -> Result<(Vec<ImpactState>, u64), Error> {
        let part = self.part();
        let back = part.whole(come_back(self.map, open, cells, self.search.transient(), &part))?;
        let (mut left, mut on_it) = (Vec::new(), 0);
        for (start, back) in open.iter().zip(back) {
            match back {
                None => self.rests += 1,
                Some(true) => on_it += 1,
                Some(false) => {
                    left.push(*start);
                    continue;
                }
            }
            self.done += 1;
        }
        Ok((left, on_it))
    }

    /// Adds attracting orbits that need no start.
    fn add_candidates(&mut self) -> Result<(), Error> {
        let map = self.map;
        let (r, forcing) = (map.restitution(), map.vibration().axial_forcing());
        // A node attracts from its birth to its doubling: the longest flights do, down to some number of
        // periods.
        let longest = ((1.0 + r) * forcing / (1.0 - r)) as u64;
        let longest = longest.saturating_add(1);
        for k in (longest.saturating_sub(MOST_PERIOD_ONE).max(1)..=longest).rev() {
            let Some(pair) = map.period_one_pair(k) else { continue };
            let Some(orbit) = pair.node.orbit(map)? else { continue };
            // All with shorter flights have doubled, too.
            if orbit.stability() == Stability::Unstable {
                break;
            }
            self.add_candidate(orbit);
        }
        if let Some(orbits) = self.search.orbits() {
            let part = self.part();
            for orbit in part.whole(map.periodic_orbits(&orbits, &part))?.orbits {
                self.add_candidate(orbit);
            }
        }
        Ok(())
    }

    fn add_candidate(&mut self, orbit: PeriodicOrbit) {
        if !orbit.states.iter().any(|at| self.map.rests_after(*at)) {
            self.add(orbit, 0);
        }
    }

    /// The further motion of a disk at rest, that is of a disk put on the platform at its lowest point.
    fn after_rest(&mut self) -> Result<RestLeadsTo, Error> {
        let lowest = ImpactState::of_impact(Phase::new(1.5 * PI)?, 0.0);
        let looks = (self.search.long_look(), self.search.cells());
        let part = self.part();
        let (seen, recurrence) = part.whole(long_look(self.map, lowest, true, looks, &part))?;
        Ok(match seen {
            Seen::Verdict(Verdict::Chattering { cycle, .. }) => {
                RestLeadsTo::Nothing(AfterRest::RestsAgain(cycle))
            }
            Seen::Verdict(Verdict::Periodic { impacts, state, .. }) => {
                let orbit = self.orbit_through(state, impacts)?;
                self.add(orbit.clone(), 0);
                RestLeadsTo::Periodic(orbit)
            }
            Seen::Rest | Seen::Verdict(Verdict::AtRest { .. }) => {
                RestLeadsTo::Nothing(AfterRest::StaysForEver)
            }
            Seen::Verdict(verdict) => RestLeadsTo::Recurrent(self.recurs(verdict, recurrence).0),
        })
    }

    fn into_attractors(mut self, after: RestLeadsTo) -> Result<Attractors, Error> {
        let count = self.periodic.len() + self.recurrent.len();
        if count > MOST_ATTRACTORS {
            let (count, limit) = (count as u64, MOST_ATTRACTORS as u64);
            return Err(Error::TooLarge { what: "attractors", count, limit });
        }
        self.periodic.sort_by(|a, b| {
            let (first, second) = (a.orbit.states[0], b.orbit.states[0]);
            let order = |orbit: &PeriodicOrbit| {
                (orbit.stability() == Stability::Marginal, orbit.period(), orbit.platform_periods)
            };
            order(&a.orbit)
                .cmp(&order(&b.orbit))
                .then(first.velocity().total_cmp(&second.velocity()))
                .then(first.phase().angle().total_cmp(&second.phase().angle()))
        });
        let after = match after {
            RestLeadsTo::Nothing(after) => after,
            RestLeadsTo::Recurrent(number) => AfterRest::LeadsTo(1 + self.periodic.len() + number),
            RestLeadsTo::Periodic(orbit) => {
                let number = self.periodic.iter().position(|known| same_orbit(&known.orbit, &orbit));
                AfterRest::LeadsTo(1 + number.unwrap_or(0))
            }
        };
        let starts = u64::from(self.search.starts());
        let attractor =
            |kind, count| Ok::<_, Error>(Attractor { kind, starts: Fraction::new(count, starts)? });
        let mut all = vec![attractor(AttractorKind::Rest(after), self.rests)?];
        let part = self.part();
        for Periodic { orbit, starts } in self.periodic {
            let radius = part.whole(orbit.trapping_radius(self.map, SAMPLES, &part));
            let kind = match radius {
                Ok(radius) => AttractorKind::Periodic(KnownOrbit::new(orbit, radius)?),
                Err(Error::NotAttracting { .. }) => AttractorKind::Marginal(orbit),
                Err(Error::NothingProven { .. }) => AttractorKind::Periodic(KnownOrbit::new(orbit, 0.0)?),
                Err(error) => return Err(error),
            };
            all.push(attractor(kind, starts)?);
        }
        for Recurrent { verdict, recurrence, starts } in self.recurrent {
            let kind = match verdict {
                Verdict::Chaotic { exponent, standard_error, .. } => {
                    AttractorKind::Chaotic { exponent, standard_error, recurrence }
                }
                Verdict::Undecided { reason, .. } => AttractorKind::Unclassified { reason, recurrence },
                // None of the others is known by its cells.
                _ => continue,
            };
            all.push(attractor(kind, starts)?);
        }
        Ok(Attractors { map: *self.map, search: *self.search, all })
    }
}
