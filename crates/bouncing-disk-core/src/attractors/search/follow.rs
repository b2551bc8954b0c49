//! The observed fate of the orbits of starts: whether they rest, repeat, or return to cells.

use core::ops::ControlFlow;

use super::cells::{CellMarks, VisitedCells};
use super::{Attractors, Recurrence};
use crate::attractors::verdict::witness::Witness;
use crate::attractors::verdict::{Verdict, VerdictSettings};
use crate::chatter::policy::ChatterPolicy;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::Error;
use crate::run::Observer;
use crate::sweep::{SweepEvent, sweep};

/// Impacts of a start that are compared with the cells of an attractor, and the share of them that must lie
/// there.
pub(super) const COMPARED: u64 = 512;
pub(super) const SHARE_IN_CELLS: f64 = 0.5;

/// The observed fate of a start.
#[derive(Debug, Clone)]
pub(super) enum Seen {
    /// It has come to rest.
    Rest,
    /// The verdict of the witness.
    Verdict(Verdict),
}

/// Follows every start until it rests or there is a verdict.
pub(super) fn first_look(
    map: &ImpactMap,
    starts: &[ImpactState],
    settings: VerdictSettings,
    observer: &dyn Observer,
) -> Result<Vec<Seen>, Error> {
    let orbits: Vec<_> = starts.iter().map(|start| map.orbit(*start, ChatterPolicy::Complete)).collect();
    let seen = sweep(
        &orbits,
        |index| (Witness::new((*map, starts[index]), settings), false),
        |(witness, rests), event| match event {
            SweepEvent::Attachment(_) => {
                *rests = true;
                ControlFlow::Break(())
            }
            SweepEvent::Impact(_) => witness.see(event),
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

/// One orbit that is followed for long.
struct Recorder {
    witness: Witness,
    marks: CellMarks,
    /// Impacts since the start or the rest, and after how many cells are marked.
    impacts: u64,
    from: u64,
    last: ImpactState,
    rests: bool,
}

/// The fate of a start that is followed for long, and the cells that its orbit visits: through its first
/// rest, or up to it.
pub(super) fn long_look(
    map: &ImpactMap,
    start: ImpactState,
    through_rest: bool,
    (settings, side): (VerdictSettings, u32),
    observer: &dyn Observer,
) -> Result<(Seen, Recurrence), Error> {
    let top = map.impact_speed_bound();
    let mut recorders = sweep(
        &[map.orbit(start, ChatterPolicy::Complete)],
        |_| Recorder {
            witness: Witness::new((*map, start), settings),
            marks: CellMarks::new(side, top),
            impacts: 0,
            from: settings.transient.saturating_add(settings.impacts / 2),
            last: start,
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
                recorder.witness.see(event)
            }
            SweepEvent::Impact(impact) => {
                recorder.impacts += 1;
                recorder.last = impact.state;
                if recorder.impacts > recorder.from {
                    recorder.marks.visit(impact.state);
                }
                recorder.witness.see(event)
            }
        },
        observer,
    )?;
    let Recorder { witness, marks, impacts, last, rests, .. } =
        recorders.pop().ok_or(Error::Stopped { done: 0, total: 1 })?;
    let seen = match witness.verdict() {
        _ if rests => Seen::Rest,
        Verdict::AtRest { .. } if !through_rest => Seen::Rest,
        verdict => Seen::Verdict(verdict),
    };
    Ok((seen, Recurrence { cells: marks.into_cells(), impacts, state: last }))
}

/// Whether starts, after the transient, come back to cells: `None` for those that rest before they have been
/// compared.
pub(super) fn come_back(
    map: &ImpactMap,
    starts: &[ImpactState],
    cells: &VisitedCells,
    transient: u64,
    observer: &dyn Observer,
) -> Result<Vec<Option<bool>>, Error> {
    let orbits: Vec<_> = starts.iter().map(|start| map.orbit(*start, ChatterPolicy::Complete)).collect();
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
    let compared = |(impacts, hits)| {
        (impacts >= transient + COMPARED).then_some(hits as f64 >= SHARE_IN_CELLS * COMPARED as f64)
    };
    Ok(seen.into_iter().map(compared).collect())
}

/// Whether two orbits have been in the same cells: half of the cells of the one that has been in fewer of
/// them.
pub(super) fn overlap(one: &VisitedCells, other: &VisitedCells) -> bool {
    let (few, many) = if one.visited().len() <= other.visited().len() { (one, other) } else { (other, one) };
    let shared = few.visited().iter().filter(|cell| many.visited().binary_search(cell).is_ok()).count();
    shared as f64 >= SHARE_IN_CELLS * few.visited().len() as f64
}

impl Attractors {
    /// The attractors that are known by their cells, with their numbers.
    pub(super) fn recurrences(&self) -> impl Iterator<Item = (usize, &Recurrence)> {
        self.all.iter().enumerate().filter_map(|(number, own)| Some((number, own.kind.recurrence()?)))
    }
}
