//! The search for attractors.
//!
//! Starts that return to the cells of an undecided motion, on which perturbations do not certainly grow, are
//! undecided too: for example below a fold, or for periods above the longest one. The 1,024 orbits about a
//! motion begin at a relative distance of 1e-7 from its impacts, because an orbit through an impact itself
//! has the same future. A search covers the trapping region and not a plotted window, so the label of a start
//! depends only on the start.
//!
//! An orbit that creeps towards a marginal one as 1/n may pass it after about 1e8 impacts if rounding
//! shifts the fold.

use super::cells::VisitedCells;
use super::follow::{
    COMPARED, FOLLOWED, Followed, LongLook, SHARE_IN_CELLS, Seen, first_look, follow, last_in, long_look,
    overlap, share_in,
};
use super::settings::AttractorSearch;
use super::starts::starts;
use super::{AfterRest, Attractor, AttractorKind, Attractors, MOST_ATTRACTORS, Recurrence};
use crate::attractors::attracting_map::AttractingMap;
use crate::attractors::basin::KnownOrbit;
use crate::attractors::verdict::{UndecidedReason, Verdict, VerdictSettings};
use crate::map::impact_map::ImpactState;
use crate::numerics::error::Error;
use crate::numerics::fraction::Fraction;
use crate::numerics::lifetime::Lifetime;
use crate::orbits::periodic::newton::same_orbit;
use crate::orbits::periodic::{PeriodicOrbit, Stability, phase_difference};
use crate::run::{Observer, Progress};

use core::f64::consts::TAU;
use core::ops::ControlFlow;

/// Starts on each circle that is sampled for the radius of an attractor.
const SAMPLES: u32 = 64;

/// An orbit has left a motion if the share of its impacts in the cells is below this part of the motion's
/// coverage.
const HAS_LEFT: f64 = 0.5 * SHARE_IN_CELLS;

/// The smallest share of impacts in already visited cells for which cells can distinguish motions.
const LEAST_COVERAGE: f64 = 0.1;

/// Largest distance, in cells, of an orbit from the marginal orbit towards which it creeps.
const CELLS_AWAY: f64 = 1.5;

/// Reports the progress of a part to the observer of the whole search: the items of the part, if they count,
/// added to the finished ones.
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
    /// The error of a stopped part, with the numbers of the whole search.
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

/// An aperiodic motion, known by its cells.
struct Recurrent {
    /// The exponent per impact and its standard error.
    growth: (f64, f64),
    /// Whether it was followed long enough for dissipation to act.
    settled: bool,
    recurrence: Recurrence,
    lifetime: Lifetime,
    starts: u64,
}

impl Recurrent {
    /// Whether no orbit was seen to leave it, and dissipation had time to act.
    const fn lasts(&self) -> bool {
        self.settled && self.lifetime.left() == 0
    }
}

/// A start without a verdict: its state when all were followed, and its present state.
#[derive(Clone, Copy)]
struct Open {
    from: ImpactState,
    at: ImpactState,
}

/// The state of a followed start and its number of impacts; its fate if it rests or repeats itself.
struct Reached {
    seen: Option<Seen>,
    state: ImpactState,
    impacts: u64,
}

/// The further motion of a disk that has come to rest.
enum RestLeadsTo {
    Periodic(PeriodicOrbit),
    Recurrent(usize),
    Nothing(AfterRest),
}

impl RestLeadsTo {
    /// Whether both are the same motion.
    fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Periodic(one), Self::Periodic(other)) => same_orbit(one, other),
            (Self::Recurrent(one), Self::Recurrent(other)) => one == other,
            // Each cycle has one start.
            (Self::Nothing(AfterRest::RestsAgain(_)), _) => false,
            (Self::Nothing(one), Self::Nothing(other)) => one == other,
            _ => false,
        }
    }

    const fn is_undecided(&self) -> bool {
        matches!(self, Self::Nothing(AfterRest::Undecided))
    }

    /// Whether the disk stays at rest, or comes to rest again and again.
    const fn lasts(&self) -> bool {
        matches!(self, Self::Nothing(AfterRest::StaysForEver | AfterRest::RestsAgain(_)))
    }
}

struct Finder<'a, M> {
    map: &'a M,
    search: &'a AttractorSearch,
    observer: &'a dyn Observer,
    rests: u64,
    periodic: Vec<Periodic>,
    recurrent: Vec<Recurrent>,
    /// The number of followed starts plus the number of starts whose attractor is known.
    done: u64,
    /// Impacts that the search may still make.
    budget: u64,
    /// Impacts for which all starts without a verdict were followed, once this has happened.
    followed: Option<u64>,
}

pub(crate) fn find<M: AttractingMap>(
    map: &M,
    search: &AttractorSearch,
    observer: &dyn Observer,
) -> Result<Attractors<M>, Error> {
    let mut finder = Finder::new(map, search, observer);
    let starts = starts(map, search.starts());
    let part = Part { counts: true, ..finder.part() };
    let seen = part.whole(first_look(map, &starts, search.first_look(), &part))?;
    finder.done = starts.len() as u64;
    finder.spend(finder.done * search.first_look().allowed());
    let (mut open, mut resting) = (Vec::new(), Vec::new());
    for (start, seen) in starts.iter().zip(seen) {
        if matches!(seen, Seen::Rest) {
            resting.push(*start);
        }
        if finder.close(&seen, 1) {
            finder.done += 1;
        } else {
            open.push(Open { from: *start, at: *start });
        }
    }
    finder.add_candidates()?;
    finder.settle(open)?;
    let after = finder.after_rest(&resting)?;
    let found = finder.into_attractors(after)?;
    let total = 2 * u64::from(search.starts());
    // The answer does not matter: nothing is left to stop.
    let _ = observer.observe(Progress { done: total, total });
    Ok(found)
}

impl<'a, M: AttractingMap> Finder<'a, M> {
    const fn new(map: &'a M, search: &'a AttractorSearch, observer: &'a dyn Observer) -> Self {
        Self {
            map,
            search,
            observer,
            rests: 0,
            periodic: Vec::new(),
            recurrent: Vec::new(),
            done: 0,
            budget: search.budget() / M::WORK,
            followed: None,
        }
    }

    /// A part whose items do not count.
    fn part(&self) -> Part<'a> {
        let total = 2 * u64::from(self.search.starts());
        Part { observer: self.observer, done: self.done, total, counts: false }
    }

    /// Takes impacts from the budget.
    const fn spend(&mut self, impacts: u64) {
        self.budget = self.budget.saturating_sub(impacts);
    }

    /// Counts `starts` starts with this fate, if the fate lasts.
    fn close(&mut self, seen: &Seen, starts: u64) -> bool {
        match *seen {
            Seen::Rest => self.rests += starts,
            Seen::Verdict(Verdict::Periodic { impacts, platform_periods, state, .. }) => {
                self.repeats(state, impacts, platform_periods, starts);
            }
            Seen::Verdict(Verdict::Undecided {
                reason: UndecidedReason::OnPeriodicOrbit { impacts, state, .. },
                ..
            }) => return self.stays_at(state, impacts, starts),
            Seen::Verdict(_) => return false,
        }
        true
    }

    /// Counts starts that approach an attracting orbit through this impact; if no orbit goes through it, the
    /// starts stay undecided.
    fn repeats(&mut self, state: ImpactState, impacts: u64, platform_periods: u64, starts: u64) {
        let scale = self.map.speed_scale();
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

    /// Counts starts that stay at an orbit through this impact, unless the orbit repels.
    fn stays_at(&mut self, state: ImpactState, impacts: u64, starts: u64) -> bool {
        let orbit = self.not_repelling(state, impacts);
        orbit.map(|orbit| self.add(orbit, starts)).is_some()
    }

    /// The orbit of `impacts` impacts through this one, unless it repels.
    fn not_repelling(&self, state: ImpactState, impacts: u64) -> Option<PeriodicOrbit> {
        let orbit = self.orbit_through(state, impacts).ok();
        orbit.filter(|orbit| orbit.stability() != Stability::Unstable)
    }

    /// The orbit of `impacts` impacts through this one, its fastest impact first.
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
    fn marginal(&mut self, cells: &VisitedCells) -> Option<&mut Periodic> {
        let width = CELLS_AWAY / f64::from(cells.side());
        let beside = |orbit: &PeriodicOrbit, (phase, velocity): (f64, f64)| {
            orbit.states.iter().any(|state| {
                phase_difference(state.phase().angle(), phase).abs() <= width * TAU
                    && (state.velocity() - velocity).abs() <= width * cells.top()
            })
        };
        self.periodic.iter_mut().find(|known| {
            known.orbit.stability() == Stability::Marginal
                && !cells.visited().is_empty()
                && cells.centres().all(|centre| beside(&known.orbit, centre))
        })
    }

    /// Finds the attractors of the starts that have neither rested nor repeated themselves. The starts are
    /// followed for long one by one, and the others are compared with the cells of each. As soon as an orbit
    /// leaves its motion, the other starts are followed too: those still under way have not left for as many
    /// impacts. This also holds if they are followed again from their last state.
    fn settle(&mut self, mut open: Vec<Open>) -> Result<(), Error> {
        while let Some(start) = open.first().copied() {
            let comparison = open.len() as u64 * (self.transient() + COMPARED);
            let most = self.followed.unwrap_or(u64::MAX).min(self.budget.saturating_sub(comparison) / 4);
            // Starts beyond the budget stay undecided.
            let Some(look) = self.search.look_within(most) else { break };
            open.remove(0);
            self.done += 1;
            let part = self.part();
            let looks = (look, self.search.cells());
            let long = part.whole(long_look(self.map, start.from, false, looks, &part))?;
            self.spend(long.impacts);
            // Near a doubling only the motion itself shows whether it repeats after twice as many impacts.
            let twice = match long.seen {
                Seen::Verdict(Verdict::Undecided {
                    reason: UndecidedReason::OnPeriodicOrbit { impacts, .. },
                    ..
                }) => self.stays_at(long.last, 2 * impacts, 1),
                _ => false,
            };
            if twice || self.close(&long.seen, 1) {
                if self.followed.is_none() {
                    open = self.follow_all(&open)?;
                }
            } else if self.marginal(&long.cells).is_some() {
                let (left, back) = self.compare(&long, &open)?;
                open = left;
                if let Some(known) = self.marginal(&long.cells) {
                    known.starts += 1 + back;
                }
            } else if let Some((number, new)) = self.recurs(&long, look)? {
                self.recurrent[number].starts += 1;
                if self.followed.is_none() && !self.recurrent[number].lasts() {
                    open = self.follow_all(&open)?;
                }
                if new {
                    let (left, back) = self.compare(&long, &open)?;
                    open = left;
                    self.recurrent[number].starts += back;
                }
            } else {
                // It neither repeats itself nor separates from its neighbours: starts that return to its
                // cells are also undecided.
                open = self.compare(&long, &open)?.0;
            }
        }
        Ok(())
    }

    /// Impacts that are skipped before starts are compared with cells: none once they have been followed.
    fn transient(&self) -> u64 {
        if self.followed.is_some() { 0 } else { self.search.first_look().transient }
    }

    /// Follows all starts without a verdict, for half of the remaining impacts, and returns those still under
    /// way.
    fn follow_all(&mut self, open: &[Open]) -> Result<Vec<Open>, Error> {
        let each = self.budget / (2 * (open.len() as u64).max(1));
        let impacts = each.min(self.search.long_look().allowed());
        self.followed = Some(impacts);
        let starts: Vec<_> = open.iter().map(|start| start.from).collect();
        let mut left = Vec::new();
        for (start, reached) in starts.iter().zip(self.follow(&starts, impacts)?) {
            if reached.seen.is_some_and(|seen| self.close(&seen, 1)) {
                self.done += 1;
            } else {
                left.push(Open { from: *start, at: reached.state });
            }
        }
        Ok(left)
    }

    /// Follows starts for `impacts` impacts, or until they rest or repeat themselves.
    fn follow(&mut self, starts: &[ImpactState], impacts: u64) -> Result<Vec<Reached>, Error> {
        let (map, part, settings) = (self.map, self.part(), self.search.long_look());
        let mut all = part.whole(follow(map, starts, &|_| impacts, settings, &part))?;
        let returned: Vec<_> = (0..all.len()).filter(|index| all[*index].repeats).collect();
        let states: Vec<_> = returned.iter().map(|index| all[*index].state).collect();
        let verdicts = part.whole(first_look(map, &states, self.search.first_look(), &part))?;
        let mut seen: Vec<_> = all.iter().map(|own| own.rests.then_some(Seen::Rest)).collect();
        let mut on = Vec::new();
        for (index, verdict) in returned.into_iter().zip(verdicts) {
            // A rest may occur after these impacts.
            if !matches!(verdict, Seen::Rest) && self.close(&verdict, 0) {
                seen[index] = Some(verdict);
            } else if all[index].impacts < impacts {
                on.push(index);
            }
        }
        // The near return proves nothing: the start is followed further, without a test for repetition.
        let states: Vec<_> = on.iter().map(|index| all[*index].state).collect();
        let rest = |index: usize| impacts - all[on[index]].impacts;
        let none = VerdictSettings { tolerance: 0.0, ..settings };
        let further = part.whole(follow(map, &states, &rest, none, &part))?;
        for (index, own) in on.into_iter().zip(further) {
            let impacts = all[index].impacts + own.impacts;
            all[index] = Followed { impacts, ..own };
            seen[index] = own.rests.then_some(Seen::Rest);
        }
        self.spend(all.iter().map(|own| own.impacts).sum());
        let reached = seen.into_iter().zip(all);
        Ok(reached.map(|(seen, Followed { state, impacts, .. })| Reached { seen, state, impacts }).collect())
    }

    /// The number of this orbit's aperiodic motion, and whether the motion is new; `None` if its
    /// perturbations do not certainly grow.
    fn recurs(&mut self, long: &LongLook, look: VerdictSettings) -> Result<Option<(usize, bool)>, Error> {
        let same = |known: &Recurrent| overlap(&known.recurrence.cells, &long.cells);
        if let Some(number) = self.recurrent.iter().position(same) {
            return Ok(Some((number, false)));
        }
        if long.coverage < LEAST_COVERAGE {
            return Ok(None);
        }
        let (growth, settled) = match long.seen {
            Seen::Verdict(Verdict::Chaotic { exponent, standard_error, .. }) => {
                ((exponent, standard_error), true)
            }
            Seen::Verdict(Verdict::Undecided {
                reason: UndecidedReason::TransientMayLast { exponent, standard_error, .. },
                ..
            }) => ((exponent, standard_error), false),
            _ => return Ok(None),
        };
        let each = self.budget / (2 * FOLLOWED as u64);
        let Some(look) = self.search.look_within(each.min(look.allowed())) else { return Ok(None) };
        let impacts = look.allowed();
        let (lifetime, orbits) = self.lifetime(long, impacts)?;
        let recurrence = Recurrence { cells: long.cells.clone(), impacts, orbits, state: long.last };
        self.recurrent.push(Recurrent { growth, settled, recurrence, lifetime, starts: 0 });
        Ok(Some((self.recurrent.len() - 1, true)))
    }

    /// The lifetime of orbits on this motion, from orbits that begin on it and are followed for `impacts`
    /// impacts, and the number that have not left. A quarter of these orbits comes first: if one of these
    /// leaves, the others need not be followed.
    fn lifetime(&mut self, long: &LongLook, impacts: u64) -> Result<(Lifetime, u64), Error> {
        let every = |first: bool| {
            let own = long.beside.iter().enumerate();
            own.filter(move |(index, _)| index.is_multiple_of(4) == first).map(|(_, state)| *state)
        };
        let (life, stay) = self.life_of(long, &every(true).collect::<Vec<_>>(), impacts)?;
        if life.left() > 0 {
            return Ok((life, stay));
        }
        let (more, others) = self.life_of(long, &every(false).collect::<Vec<_>>(), impacts)?;
        Ok((Lifetime::new(life.impacts() + more.impacts(), more.left())?, stay + others))
    }

    /// [`Self::lifetime`] from these orbits.
    fn life_of(
        &mut self,
        long: &LongLook,
        starts: &[ImpactState],
        impacts: u64,
    ) -> Result<(Lifetime, u64), Error> {
        let followed = self.follow(starts, impacts)?;
        let (mut total, mut left) = (0, 0);
        let mut on = Vec::new();
        for (start, reached) in starts.iter().zip(&followed) {
            if reached.seen.is_some() {
                total += reached.impacts;
                left += 1;
            } else {
                on.push((*start, reached.state));
            }
        }
        let part = self.part();
        let ends: Vec<_> = on.iter().map(|(_, state)| *state).collect();
        let shares = part.whole(share_in(self.map, &ends, &long.cells, 0, &part))?;
        // Orbits that rest soon after these impacts have not left within them.
        let gone = |share: &Option<f64>| share.is_some_and(|share| share < HAS_LEFT * long.coverage);
        let elsewhere: Vec<_> =
            on.iter().zip(&shares).filter(|(_, share)| gone(share)).map(|((start, _), _)| *start).collect();
        let stay = (on.len() - elsewhere.len()) as u64;
        let last = part.whole(last_in(self.map, &elsewhere, &long.cells, impacts, &part))?;
        total += stay * impacts + last.iter().sum::<u64>();
        left += elsewhere.len() as u64;
        self.spend(elsewhere.len() as u64 * impacts + on.len() as u64 * COMPARED);
        Ok((Lifetime::new(total as f64, left)?, stay))
    }

    /// The starts whose attractor remains unknown, and the number of those that rest or return to these
    /// cells.
    fn compare(&mut self, long: &LongLook, open: &[Open]) -> Result<(Vec<Open>, u64), Error> {
        let part = self.part();
        let at: Vec<_> = open.iter().map(|start| start.at).collect();
        let shares = part.whole(share_in(self.map, &at, &long.cells, self.transient(), &part))?;
        self.spend(open.len() as u64 * (self.transient() + COMPARED));
        let (mut left, mut on_it) = (Vec::new(), 0);
        for (start, share) in open.iter().zip(shares) {
            match share {
                None => self.rests += 1,
                Some(share) if share >= SHARE_IN_CELLS * long.coverage.max(LEAST_COVERAGE) => on_it += 1,
                Some(_) => {
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
        let (map, part) = (self.map, self.part());
        map.closed_forms(&mut |orbit| {
            self.add_candidate(orbit);
            // With little dissipation there may be thousands: there is no need to distinguish them.
            self.check_count()
        })?;
        if let Some(search) = self.search.orbits() {
            for orbit in part.whole(map.orbits_found(&search, &part))? {
                self.add_candidate(orbit);
            }
        }
        Ok(())
    }

    fn add_candidate(&mut self, orbit: PeriodicOrbit) {
        if !orbit.states.iter().any(|at| self.map.chatters_to_rest_after(*at)) {
            self.add(orbit, 0);
        }
    }

    /// The further motion of a disk at rest; on a drive, after a rest that ends at each of the phases seen.
    fn after_rest(&mut self, resting: &[ImpactState]) -> Result<RestLeadsTo, Error> {
        let part = self.part();
        let starts = part.whole(self.map.to_rests(resting, &part))?;
        // The budget already spent does not count: a rest always exists.
        let most = self.search.budget() / (4 * M::WORK * (starts.len() as u64).max(1));
        let mut all = Vec::new();
        for start in starts {
            all.push(self.after_rest_of(start, most)?);
        }
        let Some(first) = all.pop() else { return Ok(RestLeadsTo::Nothing(AfterRest::Undecided)) };
        if all.iter().all(|other| other.is_same(&first)) {
            return Ok(first);
        }
        // An unknown motion may or may not differ from the others.
        if all.iter().chain([&first]).any(RestLeadsTo::is_undecided) {
            return Ok(RestLeadsTo::Nothing(AfterRest::Undecided));
        }
        let last = first.lasts() && all.iter().all(RestLeadsTo::lasts);
        Ok(RestLeadsTo::Nothing(AfterRest::Several { last }))
    }

    /// The motion of a start after its first rest, over at most `most` impacts.
    fn after_rest_of(&mut self, start: ImpactState, most: u64) -> Result<RestLeadsTo, Error> {
        let look = self.search.look_within(most).unwrap_or_else(|| self.search.first_look());
        let part = self.part();
        let long = part.whole(long_look(self.map, start, true, (look, self.search.cells()), &part))?;
        Ok(match long.seen {
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
            Seen::Verdict(Verdict::Undecided {
                reason: UndecidedReason::OnPeriodicOrbit { impacts, state, .. },
                ..
            }) => match self.not_repelling(state, impacts) {
                Some(orbit) => {
                    self.add(orbit.clone(), 0);
                    RestLeadsTo::Periodic(orbit)
                }
                None => RestLeadsTo::Nothing(AfterRest::Undecided),
            },
            Seen::Verdict(_) => match self.recurs(&long, look)? {
                Some((number, _)) => RestLeadsTo::Recurrent(number),
                None => RestLeadsTo::Nothing(AfterRest::Undecided),
            },
        })
    }

    /// Checks that there are labels for all attractors.
    fn check_count(&self) -> Result<(), Error> {
        let count = self.periodic.len() + self.recurrent.len();
        if count > MOST_ATTRACTORS {
            let (count, limit) = (count as u64, MOST_ATTRACTORS as u64);
            return Err(Error::TooLarge { what: "attractors", count, limit });
        }
        Ok(())
    }

    fn into_attractors(mut self, after: RestLeadsTo) -> Result<Attractors<M>, Error> {
        self.check_count()?;
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
        for own in self.recurrent {
            let lasts = own.lasts();
            let Recurrent { growth: (exponent, standard_error), mut recurrence, lifetime, starts, .. } = own;
            let kind = if lasts {
                AttractorKind::Chaotic { exponent, standard_error, recurrence }
            } else {
                // Its starts are counted after these.
                recurrence.impacts = self.followed.unwrap_or(recurrence.impacts);
                AttractorKind::Transient { exponent, standard_error, lifetime, recurrence }
            };
            all.push(attractor(kind, starts)?);
        }
        Ok(Attractors { map: self.map.clone(), search: *self.search, all })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attractors::search::cells::CellMarks;
    use crate::map::impact_map::map;
    use crate::run::Unobserved;

    #[test]
    fn orbits_that_go_on_elsewhere_have_left() {
        let search = AttractorSearch::default().with_orbits(None).with_impacts(1_000, 20_000);
        let (map, search) = (map(0.55, 0.5), search.expect("legal"));
        let found = map.attractors(&search, &Unobserved).expect("no failure");
        let chaos = found.all().iter().find_map(|one| one.kind.recurrence()).expect("chaos").state;
        let looks = (search.long_look(), 64);
        let long = long_look(&map, chaos, false, looks, &Unobserved).expect("no failure");
        let mut finder = Finder::new(&map, &search, &Unobserved);
        let starts = &long.beside[..16];
        let (life, stay) = finder.life_of(&long, starts, 4_000).expect("no failure");
        assert_eq!((life.left(), life.impacts(), stay), (0, 64_000.0, 16));
        assert!(finder.budget <= search.budget() - 64_000);
        // The slowest impacts, which this motion never makes.
        let mut marks = CellMarks::new(64, map.impact_speed_bound());
        marks.visit(ImpactState::from_normalised(1.0, 1e-3).expect("legal"));
        let elsewhere = LongLook { cells: marks.into_cells(), ..long.clone() };
        let (life, stay) = finder.life_of(&elsewhere, starts, 4_000).expect("no failure");
        assert_eq!((life.left(), life.impacts(), stay), (16, 0.0, 0));
    }
}
