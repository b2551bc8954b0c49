//! Manifolds as lines of a picture.

use bouncing_disk::core::ImpactState;
use bouncing_disk::core::chaos::Manifold;

/// The pieces of a manifold with their impacts at these places, cut where the first coordinate, a phase in
/// periods of the platform, jumps by more than half a period; without pieces of a single impact.
pub(super) fn lines(manifold: &Manifold, spot: impl Fn(ImpactState) -> (f64, f64)) -> Vec<Vec<(f64, f64)>> {
    let mut lines = Vec::new();
    for piece in manifold.pieces() {
        let mut current: Vec<(f64, f64)> = Vec::new();
        for state in &piece.states {
            let next = spot(*state);
            if current.last().is_some_and(|last| (last.0 - next.0).abs() > 0.5) {
                lines.push(std::mem::take(&mut current));
            }
            current.push(next);
        }
        lines.push(current);
    }
    lines.retain(|line| line.len() > 1);
    lines
}
