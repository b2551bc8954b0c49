//! The growth of one branch of a manifold: each generation is the image of the previous one, with points
//! inserted where it stretches or turns.
//!
//! The rounding of a double is about 1e-10 of the first piece; parts below 2^-28 of it are not divided. The
//! distance of the piece from the manifold is about (1e-5)^2. It shrinks by the other multiplier while
//! distances along the curve grow: the curve converges to the manifold, with a slightly wrong parameter.
//!
//! Parts that cannot be divided and exceed a fiftieth of a chord are jumps. Near a graze v varies like the
//! square root of the distance on the first piece, so ends of pieces are accurate to about 2^-14 of their
//! scale.

use crate::chaos::manifold::saddle::Saddle;
use crate::chaos::manifold::{
    ManifoldBranch, ManifoldEnd, ManifoldKind, ManifoldPiece, ManifoldSettings, PieceEnd, Side,
};
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::sin;
use crate::numerics::error::{Error, within};
use crate::orbits::periodic::phase_difference;
use crate::run::Tick;
use glam::DVec2;

/// Length of the straight piece near the saddle, after one generation. Its distance from the curve is of the
/// order of its square, and shrinks from then on.
const FIRST_LENGTH: f64 = 1.0e-5;

/// The shortest part of the first piece that is still divided: inside it doubles have few digits left.
const SHORTEST_PART: f64 = 1.0 / 268_435_456.0;

/// Turns between parts shorter than this share of a chord are not resolved, and points nearer than that are
/// omitted.
const FINEST: f64 = 0.02;

/// Length below which the direction of a part may be pure rounding error.
const ROUNDING: f64 = 1.0e-9;

/// A point of a generation.
#[derive(Debug, Clone, Copy)]
enum Place {
    At(ImpactState),
    Lost(PieceEnd),
}

impl Place {
    const fn state(&self) -> Option<ImpactState> {
        match self {
            Self::At(state) => Some(*state),
            Self::Lost(_) => None,
        }
    }
}

/// A point of a generation, and the share of the first piece from which it comes, in [0, 1].
#[derive(Debug, Clone, Copy)]
struct Node {
    from: f64,
    place: Place,
}

/// The connection between two neighbouring points of a generation.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Link {
    /// The curve, over this displacement (in the units of lengths).
    Curve(DVec2),
    /// A jump of the map.
    Jump,
    /// At least one of them is lost.
    Gap,
}

/// A branch that grows.
pub(crate) struct Grower<'m> {
    map: &'m ImpactMap,
    kind: ManifoldKind,
    side: Side,
    saddle: ImpactState,
    /// Flights of one generation.
    flights: usize,
    /// The ends of the first piece, as displacements from the saddle (phase, velocity).
    first: (DVec2, DVec2),
    per_velocity: f64,
    launch_speed: f64,
    settings: ManifoldSettings,
}

impl<'m> Grower<'m> {
    pub(crate) fn new(
        map: &'m ImpactMap,
        saddle: &Saddle,
        kind: ManifoldKind,
        side: Side,
        settings: &ManifoldSettings,
    ) -> Result<Self, Error> {
        let multiplier = saddle.multiplier(kind);
        if kind == ManifoldKind::Stable {
            // With restitution 0 whole lines map to one point: there is no inverse.
            let legal = "(0, 1)";
            within("modulus of a stable multiplier", multiplier.abs(), f64::MIN_POSITIVE, 1.0, legal)?;
        }
        // A negative multiplier changes the side: a generation is two rounds of the orbit.
        let rounds = if multiplier < 0.0 { 2 } else { 1 };
        let rate = match kind {
            ManifoldKind::Unstable => multiplier.abs(),
            ManifoldKind::Stable => 1.0 / multiplier.abs(),
        };
        let growth = if rounds == 2 { rate * rate } else { rate };
        let direction = match side {
            Side::Later => saddle.direction(kind),
            Side::Earlier => -saddle.direction(kind),
        };
        let bound = map.launch_speed_bound();
        let mut grower = Self {
            map,
            kind,
            side,
            saddle: saddle.state,
            flights: rounds * saddle.flights,
            first: (direction * (FIRST_LENGTH / growth.max(2.0)), DVec2::ZERO),
            per_velocity: saddle.per_velocity,
            launch_speed: settings.launch_speed.map_or(bound, |speed| speed.max(bound)),
            settings: *settings,
        };
        // The first piece extends from its beginning to the image of this point.
        let Place::At(beginning) = grower.displaced(0.0)? else {
            return Err(Error::NotSettled { what: "the saddle of a manifold", iterations: 1, residual: 0.0 });
        };
        match grower.mapped(Place::At(beginning))? {
            Place::At(image) => grower.first.1 = grower.between(saddle.state, image),
            Place::Lost(_) => {
                let residual = FIRST_LENGTH;
                return Err(Error::NotSettled { what: "the saddle of a manifold", iterations: 1, residual });
            }
        }
        Ok(grower)
    }

    /// The state at a share of the first piece, if the disk flies, and its derivative with respect to the
    /// share (phase, velocity).
    pub(crate) fn first_piece(&self, share: f64) -> Result<Option<(ImpactState, DVec2)>, Error> {
        let (beginning, end) = self.first;
        Ok(self.displaced(share)?.state().map(|state| (state, end - beginning)))
    }

    /// The displacement (phase, velocity) from one state to another, along the shorter way.
    fn between(&self, from: ImpactState, to: ImpactState) -> DVec2 {
        let phase = phase_difference(to.phase().angle(), from.phase().angle());
        DVec2::new(phase, to.velocity() - from.velocity())
    }

    /// A displacement in the units of lengths.
    fn scaled(&self, displacement: DVec2) -> DVec2 {
        DVec2::new(displacement.x, displacement.y * self.per_velocity)
    }

    /// The point of the first piece at a share of its length.
    fn displaced(&self, share: f64) -> Result<Place, Error> {
        let (beginning, end) = self.first;
        let by = if share > 0.0 { beginning + (end - beginning) * share } else { beginning };
        let phase = Phase::new(self.saddle.phase().angle() + by.x)?;
        let velocity = self.saddle.velocity() + by.y;
        if velocity >= 0.0 {
            return Ok(Place::Lost(PieceEnd::Rest));
        }
        Ok(Place::At(ImpactState::new(phase, velocity)?))
    }

    /// The point one generation later.
    fn mapped(&self, place: Place) -> Result<Place, Error> {
        let Place::At(mut state) = place else { return Ok(place) };
        for _ in 0..self.flights {
            match self.next(state)? {
                Place::At(next) => state = next,
                lost @ Place::Lost(_) => return Ok(lost),
            }
        }
        Ok(Place::At(state))
    }

    /// The point one impact later.
    fn next(&self, state: ImpactState) -> Result<Place, Error> {
        let next = match self.kind {
            ManifoldKind::Unstable => {
                if self.map.chatters_to_rest(self.map.rebound(state)) {
                    return Ok(Place::Lost(PieceEnd::Rest));
                }
                self.map.step(state).map(ImpactState::from)
            }
            ManifoldKind::Stable => {
                let before = self.map.step_back(state);
                if let Ok(before) = before {
                    let own = self.map.vibration().velocity(before.phase())
                        - self.map.restitution() * before.velocity();
                    if own.abs() > self.launch_speed {
                        return Ok(Place::Lost(PieceEnd::TooFast));
                    }
                }
                before
            }
        };
        match next {
            Ok(next) => Ok(Place::At(next)),
            Err(Error::NoLiftOff { .. }) => Ok(Place::Lost(PieceEnd::Rest)),
            Err(error) => Err(error),
        }
    }

    /// The point of a generation that comes from this share of the first piece.
    fn node(&self, from: f64, generation: u32, tick: Tick<'_>) -> Result<Node, Error> {
        let mut place = self.displaced(from)?;
        for _ in 0..generation {
            tick(self.flights as u64)?;
            place = self.mapped(place)?;
            if place.state().is_none() {
                break;
            }
        }
        Ok(Node { from, place })
    }

    /// The connection between two neighbouring points.
    fn link(&self, from: &Node, to: &Node) -> Link {
        match (from.place, to.place) {
            (Place::At(a), Place::At(b)) => {
                let by = self.scaled(self.between(a, b));
                // A share that cannot be divided but is long: the neighbours take different flights.
                if is_undivided(from, to) && by.length() > FINEST * self.settings.chord {
                    Link::Jump
                } else {
                    Link::Curve(by)
                }
            }
            _ => Link::Gap,
        }
    }

    /// The links of a generation that are too coarse.
    fn too_coarse(&self, nodes: &[Node], links: &[Link]) -> Vec<bool> {
        let finest = FINEST * self.settings.chord;
        let sharpest = sin(self.settings.turn);
        let mut coarse: Vec<bool> = Vec::with_capacity(links.len());
        for (link, ends) in links.iter().zip(nodes.windows(2)) {
            coarse.push(match link {
                Link::Curve(by) => by.length() > self.settings.chord,
                Link::Jump => false,
                Link::Gap => ends[0].place.state().is_some() != ends[1].place.state().is_some(),
            });
        }
        for (i, pair) in links.windows(2).enumerate() {
            let (Link::Curve(a), Link::Curve(b)) = (pair[0], pair[1]) else { continue };
            let lengths = (a.length(), b.length());
            let turns = a.dot(b) <= 0.0 || a.perp_dot(b).abs() > sharpest * (lengths.0 * lengths.1);
            if turns && lengths.0.min(lengths.1) > ROUNDING {
                coarse[i] |= lengths.0 > finest;
                coarse[i + 1] |= lengths.1 > finest;
            }
        }
        for (coarse, ends) in coarse.iter_mut().zip(nodes.windows(2)) {
            *coarse &= !is_undivided(&ends[0], &ends[1]);
        }
        coarse
    }

    /// A generation with enough points; the flag is true if it would need more than allowed.
    fn refined(
        &self,
        mut nodes: Vec<Node>,
        generation: u32,
        tick: Tick<'_>,
    ) -> Result<(Vec<Node>, Vec<Link>, bool), Error> {
        loop {
            let links: Vec<_> = nodes.windows(2).map(|ends| self.link(&ends[0], &ends[1])).collect();
            let coarse = self.too_coarse(&nodes, &links);
            let inserted = coarse.iter().filter(|coarse| **coarse).count();
            if inserted == 0 {
                return Ok((nodes, links, false));
            }
            if nodes.len() + inserted > self.settings.max_points {
                return Ok((nodes, links, true));
            }
            let mut finer = Vec::with_capacity(nodes.len() + inserted);
            for (ends, coarse) in nodes.windows(2).zip(&coarse) {
                finer.push(ends[0]);
                if *coarse {
                    finer.push(self.node(0.5 * (ends[0].from + ends[1].from), generation, tick)?);
                }
            }
            finer.extend(nodes.last());
            nodes = finer;
        }
    }

    /// Grows the branch at the impact number `impact` of the saddle.
    pub(super) fn grow(&mut self, impact: usize, tick: Tick<'_>) -> Result<ManifoldBranch, Error> {
        let mut nodes = vec![self.node(0.0, 0, tick)?, self.node(1.0, 0, tick)?];
        let mut record = Record::new(self.saddle, FINEST * self.settings.chord);
        let (mut generations, mut last_length) = (0, 0.0);
        let end = loop {
            let (finer, links, exhausted) = self.refined(nodes, generations, tick)?;
            nodes = finer;
            let before = record.arclength;
            let stopped = self.append(&mut record, &nodes, &links);
            if let Some(end) = stopped {
                break end;
            }
            let length = record.arclength - before;
            if exhausted {
                break ManifoldEnd::Points;
            }
            if nodes.iter().all(|node| node.place.state().is_none()) {
                break ManifoldEnd::Lost;
            }
            if length < last_length && length < FINEST * self.settings.chord {
                break ManifoldEnd::Attracted;
            }
            if generations == self.settings.max_generations {
                break ManifoldEnd::Generations;
            }
            last_length = length;
            generations += 1;
            for node in &mut nodes {
                tick(self.flights as u64)?;
                node.place = self.mapped(node.place)?;
            }
        };
        let (side, arclength) = (self.side, record.arclength);
        Ok(ManifoldBranch { impact, side, pieces: record.finished(), arclength, generations, end })
    }

    /// Adds a generation to the record, up to the end of the branch.
    fn append(&self, record: &mut Record, nodes: &[Node], links: &[Link]) -> Option<ManifoldEnd> {
        for (link, ends) in links.iter().zip(nodes.windows(2)) {
            let Place::At(state) = ends[1].place else {
                if let Place::Lost(reason) = ends[1].place {
                    record.interrupt(reason);
                }
                continue;
            };
            match (link, ends[0].place) {
                (Link::Curve(by), Place::At(before)) => record.extend(before, state, by.length()),
                (_, Place::Lost(reason)) => record.begin(state, reason),
                (_, Place::At(_)) => {
                    record.interrupt(PieceEnd::Graze);
                    record.begin(state, PieceEnd::Graze);
                }
            }
            if record.arclength >= self.settings.arclength {
                return Some(ManifoldEnd::Arclength);
            }
            if record.points >= self.settings.max_points {
                return Some(ManifoldEnd::Points);
            }
        }
        None
    }
}

/// Whether two neighbours are too close on the first piece for a point between them.
fn is_undivided(from: &Node, to: &Node) -> bool {
    to.from - from.from <= SHORTEST_PART
}

/// The pieces found so far.
pub(super) struct Record {
    pieces: Vec<ManifoldPiece>,
    /// The growing piece.
    current: Option<ManifoldPiece>,
    /// Its last point, and the distance from the last point kept.
    last: Option<(ImpactState, f64)>,
    finest: f64,
    pub(super) arclength: f64,
    pub(super) points: usize,
}

impl Record {
    pub(super) fn new(saddle: ImpactState, finest: f64) -> Self {
        let current = ManifoldPiece { states: vec![saddle], start: PieceEnd::Saddle, end: PieceEnd::Cut };
        Self { pieces: Vec::new(), current: Some(current), last: None, finest, arclength: 0.0, points: 1 }
    }

    /// Begins a piece.
    pub(super) fn begin(&mut self, state: ImpactState, start: PieceEnd) {
        self.current = Some(ManifoldPiece { states: vec![state], start, end: PieceEnd::Cut });
        self.last = None;
        self.points += 1;
    }

    /// Adds a point to the growing piece, with its displacement from the previous point.
    pub(super) fn extend(&mut self, before: ImpactState, state: ImpactState, by: f64) {
        let Some(current) = &mut self.current else {
            // The previous generation ended in a gap.
            self.begin(before, PieceEnd::Graze);
            return self.extend(before, state, by);
        };
        self.arclength += by;
        let since = self.last.map_or(0.0, |(_, since)| since) + by;
        if since >= self.finest {
            current.states.push(state);
            self.points += 1;
            self.last = None;
        } else {
            self.last = Some((state, since));
        }
    }

    /// Ends the growing piece, if there is one.
    pub(super) fn interrupt(&mut self, end: PieceEnd) {
        if let Some(mut piece) = self.current.take() {
            piece.states.extend(self.last.take().map(|(state, _)| state));
            piece.end = end;
            self.pieces.push(piece);
        }
    }

    pub(super) fn finished(mut self) -> Vec<ManifoldPiece> {
        self.interrupt(PieceEnd::Cut);
        self.pieces
    }
}
