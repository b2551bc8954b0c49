//! Where an orbit of 2m impacts is born by the doubling of one of m: both of its halves become that one. Its
//! own equations have two branches there, so that the place is sought on the other branch.

use glam::DVec2;

use super::walker::{HALVINGS, Located, Walker};
use super::{Bifurcation, BifurcationKind, BranchPoint};
use crate::analysis::closing::{Closed, Plane};
use crate::error::Error;
use crate::numerics::roots::bisected_bracket;

impl Walker<'_> {
    /// Whether the halves of the orbit change places between two points: it is born by a doubling there.
    pub(super) fn is_born(&self, base: &Located, next: &Located) -> bool {
        let n = base.at.impacts.len();
        if !n.is_multiple_of(2) || self.closing.half().twice().turns_differ(&self.closing) {
            return false;
        }
        let apart = |at: &Closed| {
            let difference = at.impacts[0] - at.impacts[n / 2];
            DVec2::new(difference.x, difference.y / self.closing.scale.speed)
        };
        let (before, after) = (apart(&base.at), apart(&next.at));
        let step = next.arclength - base.arclength;
        before.dot(after) < 0.0 && before.length() + after.length() <= 4.0 * step
    }

    /// The doubling that the orbit is born in, on the branch of half its impacts.
    pub(super) fn birth(
        &self,
        base: &Located,
        next: &Located,
        step: f64,
    ) -> Result<Option<Bifurcation>, Error> {
        let half = Walker { closing: self.closing.half(), settings: self.settings, work: self.work.clone() };
        let (n, at) = (half.closing.flights(), &base.at);
        let mean = (0..n).map(|i| 0.5 * (at.impacts[i] + at.impacts[i + n])).collect();
        let mut guess = Closed { impacts: mean, parameter: at.parameter };
        let normal = [0.0, 0.0, 1.0];
        let across = |guess: Closed, parameter: f64| {
            let mut base = half.closing.scaled(&guess);
            base[2] = parameter / half.closing.scale.parameter;
            half.closing.corrected(guess, &Plane { normal, base, distance: 0.0 })
        };
        let flip = |parameter: f64, guess: &Closed| -> Result<Option<(f64, BranchPoint)>, Error> {
            let Some((at, corrections)) = across(guess.clone(), parameter) else { return Ok(None) };
            let arclength = base.arclength + 0.5 * step;
            let located = Located { direction: at.clone(), at, arclength, corrections };
            Ok(half.point(&located)?.map(|point| (1.0 + point.trace + point.determinant, point)))
        };
        if let Some((settled, _)) = across(guess.clone(), guess.parameter) {
            guess = settled;
        }
        // The doubled orbit differs by the square of the step at most.
        let mut reach = (base.at.parameter - next.at.parameter).abs() + 1.0e-6 * half.closing.scale.parameter;
        for _ in 0..20 {
            let (least, most) = half.closing.by.legal();
            let ends = ((guess.parameter - reach).max(least), (guess.parameter + reach).min(most));
            let (Some((low, _)), Some((high, _))) = (flip(ends.0, &guess)?, flip(ends.1, &guess)?) else {
                return Ok(None);
            };
            if (low > 0.0) == (high > 0.0) {
                reach *= 2.0;
                continue;
            }
            let mut nearest: Option<(f64, BranchPoint)> = None;
            bisected_bracket(ends.0, ends.1, HALVINGS, |parameter| {
                half.spend()?;
                let Some((value, point)) = flip(parameter, &guess)? else { return Ok::<_, Error>(false) };
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
