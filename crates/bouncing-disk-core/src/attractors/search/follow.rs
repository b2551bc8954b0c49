//! The observed fate of the orbits of starts: whether they rest, repeat, or return to cells.

use core::ops::ControlFlow;

use super::cells::{CellMarks, VisitedCells};
use super::{Attractors, Recurrence};
use crate::attractors::attracting_map::AttractingMap;
use crate::attractors::verdict::returns::Returns;
use crate::attractors::verdict::witness::Witness;
use crate::attractors::verdict::{Verdict, VerdictSettings};
use crate::chatter::policy::ChatterPolicy;
use crate::map::impact_map::ImpactState;
use crate::numerics::error::Error;
use crate::run::Observer;
use crate::sweep::bouncing_map::BouncingMap;
use crate::sweep::{SweepEvent, sweep};

/// Impacts of a start that are compared with the cells of an attractor, and the share of them that must lie
/// in the cells.
pub(super) const COMPARED: u64 = 512;
pub(super) const SHARE_IN_CELLS: f64 = 0.5;

/// Orbits of an aperiodic attractor that are followed to see whether any leaves it.
pub(super) const FOLLOWED: usize = 1_024;

/// The share by which each of them begins slower than an impact of the attractor. States of one orbit have
/// the same future; a neighbouring state has a different one after about a hundred impacts.
const BESIDE: f64 = 1.0e-7;

/// The observed fate of a start.
#[derive(Debug, Clone)]
pub(super) enum Seen {
    /// It has come to rest.
    Rest,
    /// The verdict of the orbit's witness.
    Verdict(Verdict),
}

/// The orbits of the starts, with chatters summed.
fn orbits<M: BouncingMap>(map: &M, starts: &[ImpactState]) -> Vec<M::Orbit> {
    starts.iter().map(|start| map.orbit(*start, ChatterPolicy::Complete)).collect()
}

/// Follows every start until it rests or there is a verdict.
pub(super) fn first_look(
    map: &impl BouncingMap,
    starts: &[ImpactState],
    settings: VerdictSettings,
    observer: &dyn Observer,
) -> Result<Vec<Seen>, Error> {
    let orbits = orbits(map, starts);
    let seen = sweep(
        &orbits,
        |index| (Witness::new((map, starts[index]), settings), false),
        |(witness, rests), event| match event {
            SweepEvent::Impact(_) => witness.see(event),
            _ => {
                *rests = true;
                ControlFlow::Break(())
            }
        },
        observer,
    )?;
    let seen = seen.into_iter().map(|(witness, rests)| match witness.verdict() {
        _ if rests => Seen::Rest,
        Verdict::AtRest { .. } => Seen::Rest,
        verdict => Seen::Verdict(verdict),
    });
    Ok(seen.collect())
}

/// An orbit followed for long.
#[derive(Debug, Clone)]
pub(super) struct LongLook {
    pub(super) seen: Seen,
    /// The cells visited in the second half of its impacts.
    pub(super) cells: VisitedCells,
    /// Impacts since the start or the rest.
    pub(super) impacts: u64,
    pub(super) last: ImpactState,
    /// Starts near evenly spaced impacts of the second half.
    pub(super) beside: Vec<ImpactState>,
    /// The share of its last impacts, a quarter of the second half, in cells visited before; 0 if there are
    /// none.
    pub(super) coverage: f64,
}

/// An orbit being followed for long.
struct Recorder<'m, M> {
    witness: Witness<'m, M>,
    marks: CellMarks,
    impacts: u64,
    last: ImpactState,
    beside: Vec<ImpactState>,
    /// The last impacts, and how many of them lie in cells visited before.
    late: (u64, u64),
    rests: bool,
}

/// The fate of a start that is followed for long, and the cells visited by its orbit, through its first rest
/// or up to it.
pub(super) fn long_look(
    map: &impl AttractingMap,
    start: ImpactState,
    through_rest: bool,
    (settings, side): (VerdictSettings, u32),
    observer: &dyn Observer,
) -> Result<LongLook, Error> {
    let top = map.impact_speed_bound();
    // The second half of the impacts over which the exponent is measured.
    let from = settings.transient.saturating_add(settings.impacts / 2);
    let late = settings.allowed() - settings.impacts / 8;
    let spacing = (settings.impacts.div_ceil(2) / FOLLOWED as u64).max(1);
    let mut recorders = sweep(
        &[map.orbit(start, ChatterPolicy::Complete)],
        |_| Recorder {
            witness: Witness::new((map, start), settings),
            marks: CellMarks::new(side, top),
            impacts: 0,
            last: start,
            beside: Vec::new(),
            late: (0, 0),
            rests: false,
        },
        |recorder, event| match event {
            SweepEvent::Attachment(_) if !through_rest => {
                recorder.rests = true;
                ControlFlow::Break(())
            }
            SweepEvent::Attachment(_) => {
                recorder.impacts = 0;
                recorder.marks.clear();
                recorder.beside.clear();
                recorder.late = (0, 0);
                recorder.witness.see(event)
            }
            SweepEvent::Impact(impact) => {
                recorder.impacts += 1;
                recorder.last = impact.state;
                if recorder.impacts > from {
                    let before = recorder.marks.visit(impact.state);
                    if recorder.impacts > late {
                        recorder.late.0 += 1;
                        recorder.late.1 += u64::from(before);
                    }
                    let another = recorder.beside.len() < FOLLOWED;
                    if another && (recorder.impacts - from).is_multiple_of(spacing) {
                        let slower = impact.state.velocity() * (1.0 - BESIDE);
                        recorder.beside.push(ImpactState::of_impact(impact.state.phase(), slower));
                    }
                }
                recorder.witness.see(event)
            }
            SweepEvent::Separation(_) | SweepEvent::Kick(_) => recorder.witness.see(event),
        },
        observer,
    )?;
    let Recorder { witness, marks, impacts, last, beside, late, rests } =
        recorders.pop().ok_or(Error::Stopped { done: 0, total: 1 })?;
    let seen = match witness.verdict() {
        _ if rests => Seen::Rest,
        Verdict::AtRest { .. } if !through_rest => Seen::Rest,
        verdict => Seen::Verdict(verdict),
    };
    let coverage = if late.0 > 0 { late.1 as f64 / late.0 as f64 } else { 0.0 };
    Ok(LongLook { seen, cells: marks.into_cells(), impacts, last, beside, coverage })
}

/// The state of an orbit that was followed without a verdict.
#[derive(Debug, Clone, Copy)]
pub(super) struct Followed {
    pub(super) impacts: u64,
    pub(super) state: ImpactState,
    pub(super) rests: bool,
    /// Whether it nearly repeated itself there, so that it is followed no further.
    pub(super) repeats: bool,
}

/// Follows each start for its given number of impacts, without derivatives, or until it rests or nearly
/// repeats itself.
pub(super) fn follow(
    map: &impl BouncingMap,
    starts: &[ImpactState],
    impacts: &(dyn Fn(usize) -> u64 + Sync),
    settings: VerdictSettings,
    observer: &dyn Observer,
) -> Result<Vec<Followed>, Error> {
    let orbits = orbits(map, starts);
    let followed = sweep(
        &orbits,
        |index| {
            let own = Followed { impacts: 0, state: starts[index], rests: false, repeats: false };
            (own, Returns::new(), impacts(index))
        },
        |(own, returns, most), event| {
            let SweepEvent::Impact(impact) = event else {
                own.rests = true;
                return ControlFlow::Break(());
            };
            own.impacts += 1;
            own.state = impact.state;
            own.repeats = returns.see(impact.state, impact.turns, &settings).is_some();
            if own.repeats || own.impacts >= *most {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        },
        observer,
    )?;
    // An orbit that ends without an event has never left the platform.
    let ended = |own: &Followed, most| own.rests || !(own.repeats || own.impacts >= most);
    let followed = followed.into_iter();
    Ok(followed.map(|(own, _, most)| Followed { rests: ended(&own, most), ..own }).collect())
}

/// The share of each start's impacts after the transient that lie in these cells: `None` for a start that
/// rests before the comparison.
pub(super) fn share_in(
    map: &impl BouncingMap,
    starts: &[ImpactState],
    cells: &VisitedCells,
    transient: u64,
    observer: &dyn Observer,
) -> Result<Vec<Option<f64>>, Error> {
    let orbits = orbits(map, starts);
    let seen = sweep(
        &orbits,
        |_| (0_u64, 0_u64),
        |(impacts, hits), event| {
            let SweepEvent::Impact(impact) = event else {
                *impacts = 0;
                return ControlFlow::Break(());
            };
            *impacts += 1;
            if *impacts > transient {
                *hits += u64::from(cells.contains(impact.state));
            }
            if *impacts >= transient + COMPARED { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
        observer,
    )?;
    let share = |(impacts, hits)| (impacts >= transient + COMPARED).then_some(hits as f64 / COMPARED as f64);
    Ok(seen.into_iter().map(share).collect())
}

/// The number of impacts, out of `impacts`, after which each orbit was last in these cells.
pub(super) fn last_in(
    map: &impl BouncingMap,
    starts: &[ImpactState],
    cells: &VisitedCells,
    impacts: u64,
    observer: &dyn Observer,
) -> Result<Vec<u64>, Error> {
    let orbits = orbits(map, starts);
    let seen = sweep(
        &orbits,
        |_| (0_u64, 0_u64),
        |(done, last), event| {
            let SweepEvent::Impact(impact) = event else { return ControlFlow::Break(()) };
            *done += 1;
            if cells.contains(impact.state) {
                *last = *done;
            }
            if *done >= impacts { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
        observer,
    )?;
    Ok(seen.into_iter().map(|(_, last)| last).collect())
}

/// Whether two orbits have visited the same cells: at least half of the cells of the orbit with fewer cells.
pub(super) fn overlap(one: &VisitedCells, other: &VisitedCells) -> bool {
    let (few, many) = if one.visited().len() <= other.visited().len() { (one, other) } else { (other, one) };
    if few.visited().is_empty() {
        return false;
    }
    let shared = few.visited().iter().filter(|cell| many.visited().binary_search(cell).is_ok()).count();
    shared as f64 >= SHARE_IN_CELLS * few.visited().len() as f64
}

impl<M> Attractors<M> {
    /// The attractors known by their cells, with their numbers.
    pub(super) fn recurrences(&self) -> impl Iterator<Item = (usize, &Recurrence)> {
        self.all.iter().enumerate().filter_map(|(number, own)| Some((number, own.kind.recurrence()?)))
    }
}
