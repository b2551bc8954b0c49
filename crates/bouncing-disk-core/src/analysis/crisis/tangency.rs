//! The tangency itself: the fold of the unstable manifold on the stable one, by Newton's method in Gamma.

use glam::DVec2;

use super::CrisisSearch;
use crate::analysis::manifold::saddle::Saddle;
use crate::analysis::periodic::{PeriodicOrbit, phase_difference};
use crate::error::Error;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::observer::WorkCount;

/// The most flights from the first piece to a fold that is looked for.
const MOST_FLIGHTS: u32 = 80;

/// The most folds that are followed to their tangency.
const MOST_TIPS: usize = 6;

/// The farthest that neighbouring samples may be apart at a fold (in the units of manifolds).
const STEP: f64 = 0.2;

/// How near to the stable direction a fold is taken to lie next to the stable manifold.
const TOUCHES: f64 = 0.02;

/// Parts into which the window is divided to find the fold.
const PARTS: u32 = 32;

/// Halvings of the place of the fold.
const HALVINGS: u32 = 60;

/// The share of the slope beside a fold that is left on it.
const VANISHES: f64 = 1.0e-3;

/// Steps of the secant method in Gamma for a number of flights.
const MAX_STEPS: u32 = 40;

/// How often a step in Gamma is halved.
const MAX_HALVINGS: u32 = 30;

/// How many rounds along the second saddle are tried after the first.
const MAX_ROUNDS: u32 = 12;

/// The distance from the second saddle (in the units of manifolds) at which its stable manifold is straight
/// within the rounding: the square of it is left.
const STRAIGHT: f64 = 1.0e-7;

/// The farthest that a point may be from the second saddle for its coordinates to mean anything.
const NEAR: f64 = 0.5;

/// What is sought.
pub(super) struct Tangency<'s> {
    pub(super) search: &'s CrisisSearch,
    pub(super) inside: &'s [ImpactState],
    pub(super) touched: &'s [ImpactState],
}

/// What was found.
pub(super) struct Solution {
    pub(super) forcing: f64,
    pub(super) error: f64,
    pub(super) inside: PeriodicOrbit,
    pub(super) touched: PeriodicOrbit,
    pub(super) orbit: Vec<ImpactState>,
    pub(super) share: f64,
    pub(super) curvature: f64,
}

/// Why nothing was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Failure {
    NoFold { nearest: f64 },
    NotSettled { forcing: f64, change: f64 },
}

/// Everything at one Gamma.
struct Setting<'s> {
    search: &'s CrisisSearch,
    map: ImpactMap,
    inside: PeriodicOrbit,
    touched: PeriodicOrbit,
    saddle: Saddle,
}

/// A point of the unstable manifold next to the second saddle.
#[derive(Debug, Clone, Copy)]
struct Spot {
    /// Coordinates along the unstable and the stable direction.
    at: DVec2,
    /// How they change with the share of the first piece.
    along: DVec2,
}

/// The fold of the unstable manifold.
#[derive(Debug, Clone, Copy)]
struct Fold {
    share: f64,
    spot: Spot,
}

/// A fold that is found by sampling.
#[derive(Debug, Clone, Copy)]
struct Tip {
    /// Flights from the first piece.
    flights: u32,
    /// The impact of the second saddle next to which it lies.
    impact: usize,
    /// Where on the first piece it comes from.
    window: (f64, f64),
}

impl Tip {
    /// The same with its window moved.
    fn around(self, share: f64) -> Self {
        let half = 0.5 * (self.window.1 - self.window.0);
        Self { window: ((share - half).max(0.0), (share + half).min(1.0)), ..self }
    }
}

/// Where a fold lies on the stable direction.
struct Crossing {
    forcing: f64,
    /// How the distance changes with Gamma.
    rate: f64,
    fold: Fold,
}

/// A state in the coordinates of a saddle, if it is near.
fn seen(saddle: &Saddle, state: ImpactState, along: DVec2) -> Option<Spot> {
    let phase = phase_difference(state.phase().angle(), saddle.state.phase().angle());
    let off = DVec2::new(phase, state.velocity() - saddle.state.velocity());
    let near = DVec2::new(off.x, off.y * saddle.per_velocity).length() <= NEAR;
    near.then(|| Spot { at: saddle.coordinates(off), along: saddle.coordinates(along) })
}

impl Setting<'_> {
    /// The folds of the unstable manifold that lie next to the stable one, those of the fewest flights first,
    /// each once; and how near the nearest of all is to the stable direction.
    fn tips(&self, work: &mut WorkCount<'_>) -> Result<(Vec<Tip>, f64), Error> {
        let saddles: Vec<_> = (0..self.touched.period())
            .map(|impact| Saddle::of(&self.map, &self.touched, impact))
            .collect::<Result<_, _>>()?;
        let piece = self.search.first_piece(&self.map, &self.inside)?;
        let most = self.search.impacts.min(MOST_FLIGHTS);
        let width = 1.0 / f64::from(self.search.samples);
        let nowhere = || vec![None; most as usize * saddles.len()];
        let (mut tips, mut nearest, mut last) = (Vec::new(), f64::MAX, nowhere());
        for sample in 0..=self.search.samples {
            let mut spots: Vec<Option<Spot>> = nowhere();
            if let Some((mut state, mut along)) = piece.first_piece(width * f64::from(sample))? {
                for flights in 0..most {
                    if self.map.chatters_to_rest(self.map.rebound(state)) {
                        break;
                    }
                    for (impact, saddle) in saddles.iter().enumerate() {
                        spots[flights as usize * saddles.len() + impact] = seen(saddle, state, along);
                    }
                    let (next, derivative) = self.map.step_with_derivative(state)?;
                    (state, along) = (next.into(), derivative * along);
                }
            }
            work.spend(u64::from(most))?;
            for (index, pair) in last.iter().zip(&spots).enumerate() {
                let (Some(before), Some(spot)) = pair else { continue };
                let turns = (before.along.x < 0.0) != (spot.along.x < 0.0);
                if !turns || (spot.at - before.at).length() > STEP {
                    continue;
                }
                nearest = nearest.min(spot.at.x.abs());
                if spot.at.x.abs() <= TOUCHES {
                    let share = width * f64::from(sample);
                    let window = ((share - 3.0 * width).max(0.0), (share + 2.0 * width).min(1.0));
                    let (flights, impact) = (index / saddles.len(), index % saddles.len());
                    tips.push(Tip { flights: flights as u32, impact, window });
                }
            }
            last = spots;
        }
        tips.sort_by(|a, b| a.flights.cmp(&b.flights).then(a.window.0.total_cmp(&b.window.0)));
        let mut distinct: Vec<Tip> = Vec::new();
        for tip in tips {
            // The same fold is seen again and again along the saddle.
            let known = |other: &Tip| (other.window.0 - tip.window.0).abs() <= 3.0 * width;
            if distinct.len() < MOST_TIPS && !distinct.iter().any(known) {
                distinct.push(tip);
            }
        }
        Ok((distinct, nearest))
    }

    /// Where a share of the first piece is after so many flights; `None` if it is not next to the saddle.
    fn spot(&self, share: f64, flights: u32) -> Result<Option<Spot>, Error> {
        let piece = self.search.first_piece(&self.map, &self.inside)?;
        let Some((mut state, mut along)) = piece.first_piece(share)? else { return Ok(None) };
        for _ in 0..flights {
            let (next, derivative) = match self.map.step_with_derivative(state) {
                Ok(step) => step,
                Err(Error::NoLiftOff { .. }) => return Ok(None),
                Err(error) => return Err(error),
            };
            along = derivative * along;
            state = next.into();
        }
        Ok(seen(&self.saddle, state, along))
    }

    /// The fold in a window of the first piece: where the unstable coordinate is stationary. Of several the
    /// one nearest to the stable manifold.
    fn fold(&self, window: (f64, f64), flights: u32) -> Result<Option<Fold>, Error> {
        let share = |part: u32| window.0 + (window.1 - window.0) * f64::from(part) / f64::from(PARTS);
        let mut best: Option<Fold> = None;
        let mut last: Option<Spot> = None;
        for part in 0..=PARTS {
            let spot = self.spot(share(part), flights)?;
            if let (Some(a), Some(b)) = (last, spot)
                && (a.along.x < 0.0) != (b.along.x < 0.0)
                && let Some(fold) = self.halved((share(part - 1), share(part)), (a, b), flights)?
                && best.is_none_or(|best| fold.spot.at.x.abs() < best.spot.at.x.abs())
            {
                best = Some(fold);
            }
            last = spot;
        }
        Ok(best)
    }

    /// The place between two spots where the slope changes its sign, if it vanishes there.
    fn halved(&self, ends: (f64, f64), spots: (Spot, Spot), flights: u32) -> Result<Option<Fold>, Error> {
        let (mut low, mut high) = ends;
        let falls = spots.0.along.x < 0.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let Some(spot) = self.spot(middle, flights)? else { return Ok(None) };
            if (spot.along.x < 0.0) == falls { low = middle } else { high = middle }
        }
        let share = 0.5 * (low + high);
        let Some(spot) = self.spot(share, flights)? else { return Ok(None) };
        // At a jump the slope changes its sign and does not vanish.
        let steepest = spots.0.along.x.abs().max(spots.1.along.x.abs());
        Ok((spot.along.x.abs() <= VANISHES * steepest).then_some(Fold { share, spot }))
    }

    /// The impacts of the orbit from a share of the first piece.
    fn orbit(&self, share: f64, flights: u32) -> Result<Vec<ImpactState>, Error> {
        let piece = self.search.first_piece(&self.map, &self.inside)?;
        let mut orbit = Vec::new();
        if let Some((mut state, _)) = piece.first_piece(share)? {
            orbit.push(state);
            for _ in 0..flights {
                state = self.map.step(state)?.into();
                orbit.push(state);
            }
        }
        Ok(orbit)
    }
}

impl Tangency<'_> {
    /// The fold that comes first to lie on the stable manifold, of those that lie next to it at `start`.
    pub(super) fn first(
        &self,
        start: f64,
        work: &mut WorkCount<'_>,
    ) -> Result<Result<Solution, Failure>, Error> {
        let (tips, nearest) = self.setting(start)?.tips(work)?;
        let mut failure = Failure::NoFold { nearest };
        let mut first: Option<Solution> = None;
        for tip in tips {
            match self.solved(&tip, start)? {
                Ok(found) if first.as_ref().is_none_or(|first| found.forcing < first.forcing) => {
                    first = Some(found);
                }
                Ok(_) => {}
                Err(other) => failure = other,
            }
            work.spend(u64::from(PARTS * tip.flights) * 32)?;
        }
        Ok(first.ok_or(failure))
    }

    fn setting(&self, forcing: f64) -> Result<Setting<'_>, Error> {
        self.setting_at(forcing, 0)
    }

    /// The same with the coordinates of this impact of the second saddle.
    fn setting_at(&self, forcing: f64, impact: usize) -> Result<Setting<'_>, Error> {
        let map = self.search.map(forcing)?;
        let inside = map.refine(self.inside)?;
        let touched = map.refine(self.touched)?;
        let saddle = Saddle::of(&map, &touched, impact)?;
        Ok(Setting { search: self.search, map, inside, touched, saddle })
    }

    /// How far the fold is from the straight stable manifold, at one Gamma.
    fn distance(&self, forcing: f64, tip: &Tip) -> Result<Option<Fold>, Error> {
        self.setting_at(forcing, tip.impact)?.fold(tip.window, tip.flights)
    }

    /// The Gamma at which the fold lies on the stable direction after so many flights, and the rate of the
    /// distance with Gamma.
    fn crossing(&self, start: f64, step: f64, tip: &Tip) -> Result<Result<Crossing, Failure>, Error> {
        let mut tip = *tip;
        let Some(mut fold) = self.distance(start, &tip)? else {
            return Ok(Err(Failure::NoFold { nearest: f64::MAX }));
        };
        let (mut last, mut forcing, mut change) = (start, start + step, step);
        let mut shortened = 0;
        for _ in 0..MAX_STEPS {
            // The fold moves along the first piece.
            tip = tip.around(fold.share);
            let Some(next) = self.distance(forcing, &tip)? else {
                // So far that it is lost: a shorter step.
                shortened += 1;
                if shortened > MAX_HALVINGS {
                    return Ok(Err(Failure::NotSettled { forcing, change }));
                }
                change *= 0.5;
                forcing = last + change;
                continue;
            };
            let rate = (next.spot.at.x - fold.spot.at.x) / (forcing - last);
            change = -next.spot.at.x / rate;
            (last, fold) = (forcing, next);
            if !change.is_finite() {
                break;
            }
            forcing += change;
            // Within the rounding the secant has no direction.
            if change.abs() <= 2.0 * f64::EPSILON * forcing {
                return Ok(Ok(Crossing { forcing, rate, fold }));
            }
        }
        Ok(Err(Failure::NotSettled { forcing, change }))
    }

    /// The tangency from near `start`, where the orbit passes the saddle after so many flights: round by
    /// round along the saddle, until its stable manifold is straight.
    fn solved(&self, tip: &Tip, start: f64) -> Result<Result<Solution, Failure>, Error> {
        let (mut forcing, mut tip, mut change) = (start, *tip, f64::INFINITY);
        let mut step = 1.0e-8 * start;
        for _ in 0..MAX_ROUNDS {
            let Crossing { forcing: next, rate, fold } = match self.crossing(forcing, step, &tip)? {
                Ok(found) => found,
                Err(failure) => return Ok(Err(failure)),
            };
            change = next - forcing;
            forcing = next;
            tip = tip.around(fold.share);
            if fold.spot.at.length() <= STRAIGHT {
                return self.solution(forcing, &tip, change, rate, fold).map(Ok);
            }
            // So far that the fold stays next to the saddle after one round more.
            let round = self.setting(forcing)?;
            tip.flights += round.saddle.flights as u32;
            step = (change.abs() * 1.0e-3)
                .max(1.0e-13 * forcing)
                .min(1.0e-4 / (rate * round.saddle.unstable).abs());
        }
        Ok(Err(Failure::NotSettled { forcing, change }))
    }

    fn solution(
        &self,
        forcing: f64,
        tip: &Tip,
        change: f64,
        rate: f64,
        fold: Fold,
    ) -> Result<Solution, Error> {
        let flights = tip.flights;
        let setting = self.setting_at(forcing, tip.impact)?;
        // The slope is a derivative: its difference is the second one.
        let aside = 1.0e-4 * (tip.window.1 - tip.window.0);
        let slope = |share: f64| setting.spot(share, flights).map(|spot| spot.map(|spot| spot.along.x));
        let curvature = match (slope(fold.share - aside)?, slope(fold.share + aside)?) {
            (Some(before), Some(after)) => (after - before) / (2.0 * aside) / rate,
            _ => f64::MAX,
        };
        let orbit = setting.orbit(fold.share, flights)?;
        let rounding = 8.0 * f64::EPSILON * (1.0 + forcing);
        let Setting { inside, touched, .. } = setting;
        Ok(Solution {
            forcing,
            error: change.abs() + rounding,
            inside,
            touched,
            orbit,
            share: fold.share,
            curvature,
        })
    }
}
