//! Where an orbit of 2m impacts is born by the doubling of one of m: both of its halves become that one. Its
//! own equations have two branches there, so that the place is sought on the other branch.

use glam::DVec2;

use super::walker::{Located, NEIGHBOURS, Walker};
use super::{Bifurcation, BifurcationKind, BranchPoint};
use crate::error::Error;
use crate::numerics::roots::bracket_of_width;
use crate::orbits::closing::{Closed, Plane, turned};

/// The distance of the halves (rad, units of 1 + P) up to which an orbit is the repetition of one half as far as its forcing tells:
/// that grows with the square of the distance.
const REPEATED: f64 = 1.0e-6;

/// The distance of the halves up to which an orbit on its way to the birth is as good as there. The equations determine the
/// forcing to the rounding by this distance; on the shorter orbit they do so to the rounding.
const CLOSE: f64 = 1.0e-5;

/// The doubling of the shorter orbit is sought this far from the last point, in units of the parameter's scale, and up to
/// so many times twice as far.
const NEAREST: f64 = 1.0e-10;
const WIDENINGS: u32 = 26;

/// What the halves of an orbit do between two points.
#[derive(Debug)]
pub(super) enum Halves {
    /// They stay apart.
    Apart,
    /// They become one in this birth, shortly after this point.
    Meet(Box<(Located, Bifurcation)>),
    /// The points are too far from each other to tell.
    Unclear,
}

impl Walker<'_> {
    /// The distance of each impact of the second half from that of the first, up to whole turns; none for an odd number of
    /// impacts.
    fn apart(&self, at: &Closed) -> Vec<DVec2> {
        let (n, speed) = (at.impacts.len(), self.closing.scale.speed);
        let pairs = at.impacts[..n / 2].iter().zip(&at.impacts[n / 2..]);
        let turned = |(a, b): (&DVec2, &DVec2)| DVec2::new(turned(b.x - a.x), (b.y - a.y) / speed);
        if n.is_multiple_of(2) { pairs.map(turned).collect() } else { Vec::new() }
    }

    /// Whether an orbit is a shorter one, gone through twice, as far as its forcing can tell.
    pub(super) fn is_repeated(&self, at: &Closed) -> bool {
        at.impacts.len().is_multiple_of(2) && largest(&self.apart(at)) <= REPEATED
    }

    /// Whether and where the halves of the orbit meet between two points. Beyond such a point the branch comes back with its
    /// halves swapped.
    pub(super) fn halves(&self, base: &Located, next: &Located) -> Result<Halves, Error> {
        let before = self.apart(&base.at);
        let as_before = |located: &Located| {
            let here = self.apart(&located.at);
            let along: f64 = before.iter().zip(&here).map(|(a, b)| a.dot(*b)).sum();
            along > 0.0 && largest(&here) > CLOSE.min(largest(&before))
        };
        if before.is_empty() || as_before(next) {
            return Ok(Halves::Apart);
        }
        let (last, beyond) = self.bracket(base, next, |located| Ok(as_before(located)))?;
        if largest(&self.apart(&last.at)) > 2.0 * CLOSE {
            let continuous = self.distance(&last.at, &beyond.at) <= NEIGHBOURS;
            return Ok(if continuous { Halves::Apart } else { Halves::Unclear });
        }
        Ok(self.birth(&last)?.map_or(Halves::Unclear, |birth| Halves::Meet(Box::new((last, birth)))))
    }

    /// The doubling that the orbit is born in, next to `last`, on the branch of half its impacts.
    fn birth(&self, last: &Located) -> Result<Option<Bifurcation>, Error> {
        let (half, guess) = self.closing.half(&last.at);
        let half = Walker { closing: half, settings: self.settings, work: self.work.clone() };
        let scale = half.closing.scale.parameter;
        let flip = |parameter: f64| -> Result<Option<(f64, BranchPoint)>, Error> {
            let mut base = half.closing.scaled(&guess);
            base[2] = parameter / scale;
            let plane = Plane { normal: [0.0, 0.0, 1.0], base, distance: 0.0 };
            let Some((at, corrections)) = half.closing.corrected(guess.clone(), &plane) else {
                return Ok(None);
            };
            let located = Located { direction: at.clone(), at, arclength: last.arclength, corrections };
            Ok(half.point(&located)?.map(|point| (1.0 + point.trace + point.determinant, point)))
        };
        let (least, most) = half.closing.by.legal();
        let mut reach = NEAREST * scale;
        for _ in 0..WIDENINGS {
            let ends = ((guess.parameter - reach).max(least), (guess.parameter + reach).min(most));
            let (Some((low, _)), Some((high, _))) = (flip(ends.0)?, flip(ends.1)?) else { return Ok(None) };
            if (low > 0.0) == (high > 0.0) {
                reach *= 2.0;
                continue;
            }
            let mut nearest: Option<(f64, BranchPoint)> = None;
            bracket_of_width(ends.0, ends.1, 0.0, |parameter| {
                half.spend()?;
                let Some((value, point)) = flip(parameter)? else { return Ok::<_, Error>(false) };
                if nearest.as_ref().is_none_or(|(least, _)| value.abs() <= least.abs()) {
                    nearest = Some((value, point));
                }
                Ok((value > 0.0) == (low > 0.0))
            })?;
            return Ok(nearest.map(|(_, point)| Bifurcation { kind: BifurcationKind::Birth, point }));
        }
        Ok(None)
    }
}

fn largest(apart: &[DVec2]) -> f64 {
    apart.iter().fold(0.0, |most, part| most.max(part.x.abs()).max(part.y.abs()))
}
