//! Lines through the best point, which determine the position and width of the optimum.

use bouncing_disk_core::numerics::statistics::NORMAL_975;

use super::cubic::Cubic;
use super::search::SHARE_OF_PLACE;
use super::{Found, LENGTHEN, LOOK, LOOKS, Place, SEEDS, SHARED, SURER, Search, value};
use crate::error::Error;
use crate::motor::operation::settings::OperatingSettings;
use crate::statistics::student_quantile;

/// The largest relative error that settings may request.
const LARGEST_ERROR: f64 = 0.5;

/// Fewest points of a line.
const LEAST: usize = 8;

/// A value above this share of the best one is good.
const GOOD: f64 = 0.99;

/// The part of a line that determines the width of its top: values above this share of the best one.
const NEAR: f64 = 2.0 * GOOD - 1.0;

/// Number of points of a cubic among which its top is sought.
const FINE: i32 = 500;

/// A line whose values scatter by more than this share of the best one, and by this many times their own
/// errors, is too rough for a range.
const ROUGHEST: f64 = 0.25 * (1.0 - GOOD);
const EXPLAINED: f64 = 1.5;

/// Values with errors below this share of the best one determine a range directly.
const EXACT: f64 = 0.1 * (1.0 - GOOD);

/// On a smooth line no value deviates by this many times the scatter.
const OUTLIER: f64 = 4.0;

/// The optimum along a line of points through the best one.
pub(super) struct Line {
    pub(super) best: f64,
    /// Values of the field that bracket the optimum.
    pub(super) top: [f64; 2],
    pub(super) good: Option<[f64; 2]>,
    /// The amount by which a neighbouring point may be better.
    pub(super) beside: f64,
}

impl Search<'_> {
    /// Examines a field through the best point, and moves the point to the top if the line is smooth.
    pub(super) fn line(
        &mut self,
        place: &mut Place,
        field: usize,
        step: f64,
        all: &mut Vec<Place>,
    ) -> Result<Line, Error> {
        let range = self.sought.ranges[field];
        let along = |place: &Place, half: f64, side: i32| -> Vec<Place> {
            let offsets = (-side..=side).map(|k| half * f64::from(k) / f64::from(side));
            let ats = offsets.map(|offset| place.at[field] + offset);
            // The end of the range belongs to the line.
            let inside = |at: &f64| range.is_turn() || (0.0..=1.0).contains(at);
            let mut ats: Vec<f64> = ats.filter(inside).collect();
            for end in [0.0, 1.0] {
                if !range.is_turn() && (place.at[field] - end).abs() < half && !ats.contains(&end) {
                    ats.push(end);
                }
            }
            ats.sort_by(f64::total_cmp);
            let of = |at: f64| {
                let mut own = place.at.clone();
                own[field] = at;
                Place { at: own, found: None }
            };
            ats.into_iter().map(of).collect()
        };
        let (mut half, mut lengthened) = (2.0 * step, None);
        for _ in 0..LOOKS {
            let first = all.len();
            all.extend(along(place, half, LOOK));
            let new: Vec<usize> = (first..all.len()).collect();
            self.measure(all, &new, self.settings.relative_error)?;
            if let Ok(better) = self.best_of(&all[first..])
                && all[first + better].found.as_ref().map(value) > place.found.as_ref().map(value)
            {
                *place = all[first + better].clone();
            }
            let near =
                new.iter().filter_map(|index| Some((all[*index].at[field], all[*index].found.as_ref()?)));
            // Taken from this pass: an earlier value of the same point may be off by its error.
            let top = near.clone().fold(0.0, |most: f64, (_, found)| most.max(value(found)));
            let (good, bad): (Vec<_>, Vec<_>) = near.partition(|(_, found)| value(found) >= GOOD * top);
            let sides = [-1.0, 1.0].map(|sign| {
                let end = if sign < 0.0 { place.at[field] } else { 1.0 - place.at[field] };
                let has_end = !range.is_turn() && end < half;
                has_end || bad.iter().any(|(at, _)| sign * (at - place.at[field]) > 0.0)
            });
            let too_short = sides != [true; 2] && half < 0.5;
            let too_long = good.len() < LOOK as usize && half > step / LENGTHEN;
            // A line that is first too long and then too short is rough.
            if !(too_short || too_long) || lengthened == Some(!too_short) {
                break;
            }
            lengthened = Some(too_short);
            half = if too_short { (half * LENGTHEN).min(0.5) } else { half / LENGTHEN };
        }
        let first = all.len();
        all.extend(along(place, half, self.side));
        let new: Vec<usize> = (first..all.len()).collect();
        let relative_error = self.settings.relative_error / SURER;
        let settings = OperatingSettings { relative_error, ..*self.settings };
        let mut settings = settings.with_share(SHARE_OF_PLACE);
        // Instead of one motion for the whole line there are now eight.
        if self.sought.leaves_height(self.motor, field)? {
            settings.relative_error = (relative_error * (SEEDS as f64 / SHARED).sqrt()).min(LARGEST_ERROR);
        }
        for seed in 0..SEEDS {
            let own: Vec<usize> = new.iter().copied().skip(seed).step_by(SEEDS).collect();
            settings.seed = self.settings.seed.wrapping_add(1 + seed as u64);
            self.measure_with(all, &own, &settings)?;
        }
        let known: Vec<(f64, &Found)> = new
            .iter()
            .filter_map(|index| {
                Some(((all[*index].at[field] - place.at[field]) / half, all[*index].found.as_ref()?))
            })
            .collect();
        if known.len() == new.len() {
            let exact = self.exact_line(place, field, half, &known);
            if let Some(line) = exact.or_else(|| self.smooth_line(place, field, half, &known)) {
                return Ok(line);
            }
        }
        Ok(self.rough_line(place, field, half, &known, all))
    }

    /// The line through a point if its values are so precise that they determine top and range directly, even
    /// across a kink; moves the point to the best value. `None` if bounds divide the line, because it then
    /// crosses them between its points.
    fn exact_line(
        &self,
        place: &mut Place,
        field: usize,
        half: f64,
        known: &[(f64, &Found)],
    ) -> Option<Line> {
        let (top, best) = known
            .iter()
            .enumerate()
            .max_by(|(_, one), (_, other)| value(one.1).total_cmp(&value(other.1)))?;
        let largest = known.iter().map(|(_, found)| found.value.standard_error).fold(0.0, f64::max);
        let keeps = |own: &(f64, &Found)| own.1.is_settled && own.1.margin(self.sought) >= 1.0;
        if largest > EXACT * value(best.1) || !known.iter().all(keeps) {
            return None;
        }
        let is_good = |own: &&(f64, &Found)| own.1.at_least() >= GOOD * best.1.at_most();
        let up = known[top..].iter().take_while(is_good).last().unwrap_or(best);
        let down = known[..=top].iter().rev().take_while(is_good).last().unwrap_or(best);
        let beside = [known[top.saturating_sub(1)], known[(top + 1).min(known.len() - 1)]];
        let (middle, error) = (place.at[field], 0.5 * half * (beside[1].0 - beside[0].0) / NORMAL_975);
        let at = |own: &(f64, &Found)| middle + half * own.0;
        place.at[field] = at(best);
        // The slope on the lower side bounds the height of a kink between two points.
        let beside = value(best.1) - value(beside[0].1).min(value(beside[1].1));
        let (best, good) = (at(best), Some([at(down), at(up)]));
        Some(Line { best, top: [best - error, best + error], good, beside })
    }

    /// The line through a point if a cubic explains the values at offsets in [-1, 1]; moves the point to the
    /// cubic's top. The jackknife over the seeds gives the errors of the top and the ends.
    fn smooth_line(
        &self,
        place: &mut Place,
        field: usize,
        half: f64,
        known: &[(f64, &Found)],
    ) -> Option<Line> {
        let best = known.iter().map(|(_, found)| value(found)).fold(0.0, f64::max);
        let squares: f64 =
            known.iter().map(|(_, found)| found.value.standard_error * found.value.standard_error).sum();
        let explained = EXPLAINED * (squares / known.len() as f64).sqrt();
        let whole = Cubic::of(known.iter().copied(), value).filter(|cubic| {
            known.len() >= LEAST
                && cubic.scatter <= explained.max(ROUGHEST * best)
                && cubic.largest <= OUTLIER * cubic.scatter.max(1e-12 * best)
        })?;
        // A cubic describes the line well only near its top.
        let is_near = |(x, _): &(f64, &Found)| whole.at(*x) >= NEAR * best;
        let takes_near = known.iter().filter(|own| is_near(own)).count() >= LEAST;
        let own = known.iter().copied().enumerate().filter(|(_, own)| !takes_near || is_near(own));
        let own: Vec<(usize, (f64, &Found))> = own.collect();
        let middle = place.at[field];
        let Some([top, low, high]) = self.top_and_ends(&own, |_| true)? else {
            let part = half / f64::from(self.side);
            return Some(Line { best: middle, top: [middle - part, middle + part], good: None, beside: 0.0 });
        };
        let without = (0..SEEDS).map(|seed| self.top_and_ends(&own, |index| index % SEEDS != seed));
        let without = without.collect::<Option<Option<Vec<[f64; 3]>>>>()?;
        let errors = without.map(|without| [0, 1, 2].map(|which| jackknife(&without, which)));
        let at = |x: f64| middle + half * x;
        let best = at(top);
        place.at[field] = best;
        let Some([top, at_low, at_high]) = errors else {
            return Some(Line { best, top: [at(-1.0), at(1.0)], good: None, beside: 0.0 });
        };
        let good = [at(low + NORMAL_975 * at_low), at(high - NORMAL_975 * at_high)];
        let good = (good[0] <= best && best <= good[1]).then_some(good);
        Some(Line { best, top: [best - half * top, best + half * top], good, beside: 0.0 })
    }

    /// The offset of the cubic's top within the bounds, and the range of offsets in which the value is good.
    /// The inner `None` means that the bounds are satisfied nowhere, the outer one that there are too few
    /// points.
    fn top_and_ends(
        &self,
        places: &[(usize, (f64, &Found))],
        is_of: impl Fn(usize) -> bool,
    ) -> Option<Option<[f64; 3]>> {
        let own = || places.iter().filter(|(index, _)| is_of(*index)).map(|(_, own)| *own);
        let cubic = Cubic::of(own(), value)?;
        let bounds = (0..self.sought.bounds.len())
            .map(|bound| Cubic::of(own(), |found| found.bounds[bound].value))
            .collect::<Option<Vec<Cubic>>>()?;
        let keeps = |x: f64| {
            let own = self.sought.bounds.iter().zip(&bounds);
            own.into_iter().all(|(bound, cubic)| bound.margin(cubic.at(x)) >= 0.0)
        };
        let [low, high] = [places[0].1.0, places[places.len() - 1].1.0];
        let x = |k: i32| low + (high - low) * f64::from(k) / f64::from(FINE);
        let keeping = (0..=FINE).filter(|k| keeps(x(*k)));
        let top = keeping.max_by(|one, other| cubic.at(x(*one)).total_cmp(&cubic.at(x(*other))));
        Some(top.map(|top| {
            let least = GOOD * cubic.at(x(top));
            let is_good = |k: &i32| cubic.at(x(*k)) >= least && keeps(x(*k));
            let up = (top..=FINE).take_while(is_good).last().unwrap_or(top);
            let down = (0..=top).rev().take_while(is_good).last().unwrap_or(top);
            [top, down, up].map(x)
        }))
    }

    /// The line through a point if values jump, from those of its points that may be as good as the best.
    fn rough_line(
        &self,
        place: &Place,
        field: usize,
        half: f64,
        known: &[(f64, &Found)],
        all: &[Place],
    ) -> Line {
        let (middle, part) = (place.at[field], half / f64::from(self.side));
        let best = known.iter().map(|(_, found)| found.value.value).fold(0.0, f64::max);
        let scatter = Cubic::of(known.iter().copied(), value).map_or(0.0, |cubic| cubic.scatter);
        let least = place.found.as_ref().map_or(f64::NEG_INFINITY, Found::at_least);
        let may = all.iter().filter(|own| {
            let beside = own.at.iter().zip(&place.at).enumerate();
            let is_on_line =
                beside.into_iter().all(|(index, (own, best))| index == field || own.total_cmp(best).is_eq());
            is_on_line && own.found.as_ref().is_some_and(|found| found.at_most() >= least)
        });
        let top = may.fold([middle - part, middle + part], |[low, high], own| {
            [low.min(own.at[field]), high.max(own.at[field])]
        });
        Line { best: middle, top, good: None, beside: NORMAL_975 * scatter.min(best) }
    }
}

/// The standard error of one of three numbers, computed without each of the [`SEEDS`] in turn and widened for
/// the small number of seeds.
pub(super) fn jackknife(without: &[[f64; 3]], which: usize) -> f64 {
    let count = without.len() as f64;
    let mean = without.iter().map(|own| own[which]).sum::<f64>() / count;
    let squares: f64 = without.iter().map(|own| (own[which] - mean) * (own[which] - mean)).sum();
    (squares * (count - 1.0) / count).sqrt() * student_quantile(count - 1.0) / NORMAL_975
}
