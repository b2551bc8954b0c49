//! The events that end the life of an orbit on an attractor: rest, a change of its band, or a place that the
//! attractor did not occupy at any lower forcing.
//!
//! A change of band: between 2 b bands lies a saddle of b impacts with a multiplier below -1. At every b-th impact an
//! orbit is seen on one side of the saddle's stable direction, and on the other b impacts later. The stable manifold
//! bends away from that direction, so single impacts may count wrongly: a counter from -8 to 8 adds up whether the
//! sides alternate as before, and only a walk from one end to the other is a change.
//!
//! Places are cells of a 256th of a turn, and of as much in units of 1 + P in the velocity. Orbits leave the attractor
//! when they are more than one cell away from all cells occupied so far.

use std::collections::BTreeSet;

use glam::DVec2;

use super::following::Followed;
use super::{CrisisEvent, CrisisSearch};
use crate::chaos::manifold::ManifoldKind;
use crate::chaos::manifold::saddle::Saddle;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::Error;
use crate::orbits::periodic::{Multipliers, PeriodicOrbit, phase_difference};

/// Impacts of an orbit among which the nearest returns to a saddle are looked for, and the number of them that are
/// tried.
const RETURNS: usize = 2_000;
const NEAREST: usize = 16;

/// Cycles over which an orbit's place in the cycle of bands is determined.
const PLACING: usize = 4;

/// The farthest count of cycles on one side.
const CYCLES: i8 = 8;

/// Cells of a turn.
const CELLS: u16 = 256;

type Cell = (u16, u32);

/// The event of a search, with the data by which it is recognised.
#[derive(Debug, Clone)]
pub(super) enum Exit {
    Rest,
    /// The saddle between the bands, at any forcing.
    Bands(PeriodicOrbit),
    /// The part of the plane that the attractor occupies.
    Region(Region),
}

impl Exit {
    /// The event at a forcing.
    ///
    /// # Errors
    /// [`Error::NoBranch`] if the saddle cannot be followed to it.
    pub(super) fn at(&self, search: &CrisisSearch, forcing: f64) -> Result<ExitTest<'_>, Error> {
        let orbit = match self {
            Self::Rest => return Ok(ExitTest::Rest),
            Self::Region(region) => return Ok(ExitTest::Region(region)),
            Self::Bands(orbit) => orbit,
        };
        let lost = |reached| Error::NoBranch { what: "the saddle between the bands", parameter: reached };
        let orbit = search.followed_to(orbit, forcing)?.map_err(lost)?;
        if !is_flip(&orbit) {
            return Err(lost(forcing));
        }
        let saddle = Saddle::of(&search.map(forcing)?, &orbit, 0)?;
        let stable = saddle.direction(ManifoldKind::Stable);
        Ok(ExitTest::Bands { orbit, per_velocity: saddle.per_velocity, across: stable.perp() })
    }
}

/// The part of the plane that an attractor occupies.
#[derive(Debug, Clone)]
pub(super) struct Region {
    /// Cells to a unit of velocity.
    per_velocity: f64,
    core: BTreeSet<Cell>,
    /// The core and all neighbours of it.
    near: BTreeSet<Cell>,
}

impl Region {
    /// No cell yet.
    pub(super) fn of(map: &ImpactMap) -> Self {
        let per_velocity =
            f64::from(CELLS) / (core::f64::consts::TAU * (1.0 + map.vibration().peak_acceleration()));
        Self { per_velocity, core: BTreeSet::new(), near: BTreeSet::new() }
    }

    fn cell(&self, state: ImpactState) -> Cell {
        let turn = state.phase().angle() * (f64::from(CELLS) / core::f64::consts::TAU);
        ((turn as u16).min(CELLS - 1), (-state.velocity() * self.per_velocity) as u32)
    }

    pub(super) fn occupies(&self, state: ImpactState) -> bool {
        self.core.contains(&self.cell(state))
    }

    /// Adds the cells that these orbits have seen.
    pub(super) fn extend(&mut self, followed: &[Followed]) {
        for &(phase, velocity) in followed.iter().flat_map(|own| &own.seen) {
            self.core.insert((phase, velocity));
            for phase in [(phase + CELLS - 1) % CELLS, phase, (phase + 1) % CELLS] {
                self.near
                    .extend((velocity.saturating_sub(1)..=velocity.saturating_add(1)).map(|v| (phase, v)));
            }
        }
    }
}

/// The event at one forcing.
#[derive(Debug)]
pub(super) enum ExitTest<'r> {
    Rest,
    Bands {
        orbit: PeriodicOrbit,
        per_velocity: f64,
        across: DVec2,
    },
    Region(&'r Region),
    /// No event, but the cells are recorded.
    Recorded(&'r Region),
}

/// What an orbit has shown so far.
#[derive(Debug, Clone, Default)]
pub(super) struct Track {
    impacts: usize,
    /// The distance from the saddle for each place in the cycle at which the orbit may have begun.
    apart: Vec<f64>,
    /// Where in the cycle the first impact of the saddle follows.
    place: usize,
    count: i8,
    side: i8,
    pub(super) seen: BTreeSet<Cell>,
}

impl ExitTest<'_> {
    /// Whether the event happens in this impact, the next one of the orbit.
    pub(super) fn happens(&self, track: &mut Track, state: ImpactState) -> bool {
        match self {
            Self::Rest => false,
            Self::Region(region) => {
                let cell = region.cell(state);
                if !region.core.contains(&cell) {
                    track.seen.insert(cell);
                }
                !region.near.contains(&cell)
            }
            Self::Recorded(region) => {
                track.seen.insert(region.cell(state));
                false
            }
            Self::Bands { orbit, per_velocity, across } => {
                let (n, impact) = (orbit.period(), track.impacts);
                let from = |place: usize| {
                    let own = orbit.states[place % n];
                    let phase = phase_difference(state.phase().angle(), own.phase().angle());
                    DVec2::new(phase, state.velocity() - own.velocity())
                };
                track.impacts += 1;
                if n > 1 && impact < PLACING * n {
                    track.apart.resize(n, 0.0);
                    for (place, apart) in track.apart.iter_mut().enumerate() {
                        let off = from(impact + place);
                        *apart += off.x.abs() + off.y.abs() * per_velocity;
                    }
                    let nearest = (0..n).min_by(|&a, &b| track.apart[a].total_cmp(&track.apart[b]));
                    track.place = nearest.unwrap_or(0);
                    return false;
                }
                if !(impact + track.place).is_multiple_of(n) {
                    return false;
                }
                let odd = ((impact + track.place) / n) % 2 == 1;
                let later = across.dot(from(0)) > 0.0;
                track.count = (track.count + if odd == later { 1 } else { -1 }).clamp(-CYCLES, CYCLES);
                let before = track.side;
                if track.count.abs() == CYCLES {
                    track.side = track.count.signum();
                }
                before != 0 && track.side != before
            }
        }
    }
}

/// Whether an orbit is a saddle with a multiplier below -1.
fn is_flip(orbit: &PeriodicOrbit) -> bool {
    matches!(orbit.multipliers(), Multipliers::Real(large, small) if large < -1.0 && small.abs() < 1.0)
}

impl CrisisSearch {
    /// The saddle of so many impacts between the bands of an attractor, from an impact on it: of the points halfway
    /// between two impacts that are so many apart, the nearest two lie next to it.
    pub(super) fn saddle_between(
        &self,
        map: &ImpactMap,
        attractor: ImpactState,
        bands: usize,
    ) -> Result<Option<PeriodicOrbit>, Error> {
        let mut states = vec![attractor];
        while states.len() < RETURNS + 2 * bands {
            let last = states[states.len() - 1];
            if map.rests_after(last) {
                return Ok(None);
            }
            states.push(map.step(last)?.into());
        }
        let scale = 1.0 + map.vibration().peak_acceleration();
        let halfway = |index: usize| {
            let (a, b) = (states[index], states[index + bands]);
            let phase = phase_difference(b.phase().angle(), a.phase().angle());
            let velocity = b.velocity() - a.velocity();
            let state = Phase::new(a.phase().angle() + 0.5 * phase)
                .and_then(|middle| ImpactState::new(middle, a.velocity() + 0.5 * velocity));
            (phase.abs() + velocity.abs() / scale, state)
        };
        let mut nearest: Vec<_> = (0..RETURNS).map(|index| (halfway(index).0, index)).collect();
        nearest.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, index) in nearest.into_iter().take(NEAREST) {
            let guess = (index..index + bands).map(|own| halfway(own).1).collect::<Result<Vec<_>, _>>()?;
            if let Ok(orbit) = map.refine(&guess)
                && orbit.period() == bands
                && is_flip(&orbit)
            {
                return Ok(Some(orbit));
            }
        }
        Ok(None)
    }

    /// The event of this search, for an attractor on which these impacts are at a forcing; `None` if it has no such
    /// bands.
    pub(super) fn exit(&self, forcing: f64, attractor: &[ImpactState]) -> Result<Option<Exit>, Error> {
        let map = self.map(forcing)?;
        Ok(match self.event {
            CrisisEvent::Rest => Some(Exit::Rest),
            CrisisEvent::Growth => Some(Exit::Region(Region::of(&map))),
            CrisisEvent::BandMerging { bands } => {
                self.saddle_between(&map, attractor[0], bands as usize)?.map(Exit::Bands)
            }
        })
    }
}
