//! The pieces of a branch, as they come.

use super::{ManifoldPiece, PieceEnd};
use crate::map::impact_map::ImpactState;

/// The pieces as far as they are known.
pub(super) struct Record {
    pieces: Vec<ManifoldPiece>,
    /// The piece that grows.
    current: Option<ManifoldPiece>,
    /// Its last point, and how far that is from the last one that was kept.
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

    /// A point of the piece that grows, so far from the one before.
    pub(super) fn extend(&mut self, before: ImpactState, state: ImpactState, by: f64) {
        let Some(current) = &mut self.current else {
            // The generation before ended in a gap.
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

    /// Ends the piece that grows, if there is one.
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
