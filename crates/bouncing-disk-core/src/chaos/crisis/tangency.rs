//! The tangency itself: the fold of the unstable manifold on the stable one, by Newton's method in Gamma.
//!
//! The search for the touched saddle S starts from the most nearly closed cycles before the rests, refines
//! them by Newton's method, and tries those that a quarter of the orbits pass. Let s be the parameter on the
//! first piece of the unstable manifold, and xi the coordinate along the unstable direction of S; dxi/ds
//! follows from the derivatives of the map. Bisection finds a fold, dxi/ds = 0, and the secant method solves
//! xi(fold) = 0 for Gamma. Using the stable direction instead of the stable manifold causes an error of the
//! order of the square of the distance from S. So the equation is solved again after each further cycle along
//! S until the fold is within 1e-7 of S: the distance shrinks by the small multiplier, and an error of Gamma
//! grows by the large one. Orbits rest at a forcing a sixty-fourth of the bracket beyond the tangency, and
//! none rests as far below it.

use glam::DVec2;

use super::exit::Exit;
use super::following::{End, until};
use super::{CrisisSearch, NoTangency, Tangency};
use crate::chaos::manifold::grower::Grower;
use crate::chaos::manifold::saddle::Saddle;
use crate::chaos::manifold::{ManifoldKind, ManifoldSettings, Side};
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::Error;
use crate::orbits::periodic::{PeriodicOrbit, phase_difference};
use crate::run::{Unobserved, Watch, WorkCount};

/// Samples of the first piece among which folds are looked for.
const SAMPLES: u32 = 2_048;

/// The largest number of flights from the first piece to a fold.
const MOST_FLIGHTS: u32 = 80;

/// The largest number of folds that are followed to their tangency.
const MOST_TIPS: usize = 24;

/// Orbits from the first piece that are followed to see whether they rest, and the impacts for which they are
/// followed.
const PROBES: u32 = 128;
const LOST: u32 = 400;

/// The distance beyond and before a tangency at which orbits are followed, over the width of the bracket.
const ASIDE: f64 = 1.0 / 64.0;

/// The largest distance between neighbouring samples at a fold (in the units of manifolds).
const STEP: f64 = 0.2;

/// The largest distance from the stable direction at which a fold counts as near the stable manifold.
const TOUCHES: f64 = 0.02;

/// Parts into which the window is divided to find the fold.
const PARTS: u32 = 32;

/// Halvings of the place of the fold.
const HALVINGS: u32 = 60;

/// The slope at a fold as a share of the slope on either side.
const VANISHES: f64 = 1.0e-3;

/// Steps of the secant method in Gamma for a number of flights.
const MAX_STEPS: u32 = 40;

/// How many times a step in Gamma is halved.
const MAX_HALVINGS: u32 = 30;

/// How many rounds along the second saddle are tried after the first.
const MAX_ROUNDS: u32 = 12;

/// Rounds after which the search abandons a tangency that is not near the bracket.
const ROUNDS_ASTRAY: u32 = 2;

/// The distance from the second saddle (in the units of manifolds) at which its stable manifold is straight
/// to within rounding: the remaining error is the square of this distance.
const STRAIGHT: f64 = 1.0e-7;

/// The largest distance of a point from the second saddle at which its coordinates are meaningful.
const NEAR: f64 = 0.5;

/// The saddles of a tangency: one whose unstable manifold touches, and one whose stable manifold is touched.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub(super) inside: PeriodicOrbit,
    pub(super) touched: PeriodicOrbit,
}

/// A tangency and its location.
pub(super) struct Solution {
    pub(super) forcing: f64,
    pub(super) error: f64,
    pub(super) tangency: Tangency,
}

/// The tangency of any of these pairs, beyond which orbits come to rest, at the least Gamma within the
/// bracket. The pairs are given at the upper end of the bracket.
pub(super) fn tangencies(
    search: &CrisisSearch,
    pairs: &[Pair],
    end: &End,
    watch: &Watch<'_>,
) -> Result<Result<Solution, NoTangency>, Error> {
    let (mut work, bracket) = (watch.work(), end.bracket);
    let off = |forcing: f64| (bracket.0 - forcing).max(forcing - bracket.1).max(0.0);
    let mut failure = NoTangency::NoFold;
    let mut within: Vec<(Solution, Sought<'_>, u32)> = Vec::new();
    for pair in pairs {
        for side in [Side::Later, Side::Earlier] {
            let sought = Sought { search, pair, side, bracket, exit: &end.exit };
            if !sought.lives()? {
                continue;
            }
            for tip in sought.setting(bracket.1, 0)?.tips(&mut work)? {
                let other = match sought.solved(&tip, bracket.1)? {
                    Ok((solution, flights)) if off(solution.forcing) <= solution.error => {
                        within.push((solution, sought, flights));
                        continue;
                    }
                    Ok((Solution { forcing, .. }, _)) => NoTangency::Elsewhere { forcing },
                    Err(other) => other,
                };
                // The nearest tangency elsewhere is reported.
                failure = match (other, failure) {
                    (NoTangency::Elsewhere { forcing: new }, NoTangency::Elsewhere { forcing })
                        if off(new) >= off(forcing) =>
                    {
                        failure
                    }
                    (NoTangency::Elsewhere { .. }, _) => other,
                    (_, NoTangency::Elsewhere { .. }) => failure,
                    _ => other,
                };
                work.spend(u64::from(PARTS * tip.flights) * 32)?;
            }
        }
    }
    within.sort_by(|a, b| a.0.forcing.total_cmp(&b.0.forcing));
    for (solution, sought, flights) in within {
        if sought.loses(&solution, flights)? {
            return Ok(Ok(solution));
        }
        failure = NoTangency::Elsewhere { forcing: solution.forcing };
    }
    Ok(Err(failure))
}

/// The task of the search.
#[derive(Clone, Copy)]
struct Sought<'s> {
    search: &'s CrisisSearch,
    pair: &'s Pair,
    side: Side,
    bracket: (f64, f64),
    exit: &'s Exit,
}

/// The map and the saddles at one Gamma.
struct Setting {
    side: Side,
    /// Impacts of the saddle between the bands, or 1.
    bands: usize,
    map: ImpactMap,
    inside: PeriodicOrbit,
    touched: PeriodicOrbit,
    saddle: Saddle,
}

/// A point of the unstable manifold near the second saddle.
#[derive(Debug, Clone, Copy)]
struct Spot {
    /// Coordinates along the unstable and the stable direction.
    at: DVec2,
    /// The derivatives of these coordinates with respect to the share of the first piece.
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
    /// The impact of the second saddle near which it lies.
    impact: usize,
    /// The part of the first piece from which it comes.
    window: (f64, f64),
}

impl Tip {
    /// The same with its window moved.
    fn around(self, share: f64) -> Self {
        let half = 0.5 * (self.window.1 - self.window.0);
        Self { window: ((share - half).max(0.0), (share + half).min(1.0)), ..self }
    }
}

/// The forcing at which a fold lies on the stable direction.
struct Crossing {
    forcing: f64,
    /// The rate of change of the distance with Gamma.
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

impl Setting {
    /// The first piece of the unstable manifold.
    fn first_piece(&self) -> Result<Grower<'_>, Error> {
        let saddle = Saddle::of(&self.map, &self.inside, 0)?;
        let settings = ManifoldSettings::new(1.0, 16)?;
        Grower::new(&self.map, &saddle, ManifoldKind::Unstable, self.side, &settings)
    }

    /// The folds of the unstable manifold that lie near the stable one, in order of increasing number of
    /// flights, each once.
    fn tips(&self, work: &mut WorkCount<'_>) -> Result<Vec<Tip>, Error> {
        let saddles: Vec<_> = (0..self.touched.period())
            .map(|impact| Saddle::of(&self.map, &self.touched, impact))
            .collect::<Result<_, _>>()?;
        let piece = self.first_piece()?;
        let width = 1.0 / f64::from(SAMPLES);
        let most = MOST_FLIGHTS * self.bands as u32;
        let nowhere = || vec![None; most as usize * saddles.len()];
        let (mut tips, mut last) = (Vec::new(), nowhere());
        for sample in 0..=SAMPLES {
            let mut spots: Vec<Option<Spot>> = nowhere();
            if let Some((mut state, mut along)) = piece.first_piece(width * f64::from(sample))? {
                for flights in 0..most {
                    if self.map.chatters_to_rest(self.map.rebound(state)) {
                        break;
                    }
                    for (impact, saddle) in saddles.iter().enumerate() {
                        spots[flights as usize * saddles.len() + impact] = seen(saddle, state, along);
                    }
                    let Ok((next, derivative)) = self.map.step_with_derivative(state) else { break };
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
        Ok(distinct)
    }

    /// The states at shares of the first piece.
    fn starts(&self, shares: impl Iterator<Item = f64>) -> Result<Vec<ImpactState>, Error> {
        let piece = self.first_piece()?;
        let starts = shares.filter_map(|share| piece.first_piece(share).transpose());
        starts.map(|found| found.map(|(state, _)| state)).collect()
    }

    /// The point to which a share of the first piece is mapped by `flights` flights; `None` if it is not near
    /// the saddle.
    fn spot(&self, share: f64, flights: u32) -> Result<Option<Spot>, Error> {
        let piece = self.first_piece()?;
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

    /// The fold in a window of the first piece: where the unstable coordinate is stationary. If there are
    /// several, the one nearest to the stable manifold.
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
        let piece = self.first_piece()?;
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

impl Sought<'_> {
    /// Whether the unstable manifold leads to the attractor: no orbit from these shares of its first piece
    /// rests at the lower end of the bracket.
    fn lives(&self) -> Result<bool, Error> {
        let shares = (0..PROBES).map(|probe| f64::from(probe) / f64::from(PROBES));
        Ok(self.lost(self.bracket.0, shares, LOST)? == 0)
    }

    /// Whether orbits from near the tangency come to rest beyond the tangency and not before it: only then
    /// does the tangency open a way out of the attractor, and not just from one part of the attractor to
    /// another.
    fn loses(&self, solution: &Solution, flights: u32) -> Result<bool, Error> {
        let (low, high) = self.bracket;
        let aside = ASIDE * (high - low);
        let Tangency { share, curvature, .. } = solution.tangency;
        let half = (2.0 * aside / curvature.abs()).sqrt();
        let shares = |probe| share + half * (f64::from(2 * probe + 1) / f64::from(PROBES) - 1.0);
        let shares = (0..PROBES).map(shares).filter(|share| (0.0..=1.0).contains(share));
        let lost = |forcing| self.lost(forcing, shares.clone(), flights + LOST);
        Ok(lost(solution.forcing + aside)? > 0 && lost(solution.forcing - aside)? == 0)
    }

    /// How many orbits from shares of the first piece come to rest, or undergo the event of the search, within
    /// so many impacts (as often as there are bands).
    fn lost(&self, forcing: f64, shares: impl Iterator<Item = f64>, most: u32) -> Result<usize, Error> {
        let (setting, most) = (self.setting(forcing, 0)?, most as usize * self.search.bands());
        let exit = self.exit.at(self.search, forcing)?;
        let lives = until(&setting.map, &exit, &setting.starts(shares)?, most, &Unobserved)?;
        Ok(lives.into_iter().filter(|own| own.lived < most).count())
    }

    /// The setting at a forcing, with the coordinates of this impact of the second saddle.
    fn setting(&self, forcing: f64, impact: usize) -> Result<Setting, Error> {
        let map = self.search.map(forcing)?;
        let inside = map.refine(&self.pair.inside.states)?;
        let touched = map.refine(&self.pair.touched.states)?;
        let saddle = Saddle::of(&map, &touched, impact)?;
        let bands = self.search.bands();
        Ok(Setting { side: self.side, bands, map, inside, touched, saddle })
    }

    /// The fold, with its distance from the straight stable manifold, at one Gamma. `None` if the fold or one
    /// of the saddles is lost.
    fn distance(&self, forcing: f64, tip: &Tip) -> Option<Fold> {
        self.setting(forcing, tip.impact).and_then(|own| own.fold(tip.window, tip.flights)).ok().flatten()
    }

    /// The Gamma at which the fold lies on the stable direction after its number of flights, and the rate of
    /// change of the distance with Gamma.
    fn crossing(&self, start: f64, step: f64, tip: &Tip) -> Result<Crossing, NoTangency> {
        let mut tip = *tip;
        let Some(mut fold) = self.distance(start, &tip) else { return Err(NoTangency::NoFold) };
        let (mut last, mut forcing, mut change) = (start, start + step, step);
        let (mut shortened, mut drift) = (0, 0.0);
        for _ in 0..MAX_STEPS {
            // The fold moves along the first piece, at first by an unknown amount.
            tip = tip.around(fold.share + drift * (forcing - last));
            let Some(next) = self.distance(forcing, &tip) else {
                // The step was so long that the fold is lost: a shorter step.
                shortened += 1;
                if shortened > MAX_HALVINGS {
                    return Err(NoTangency::NotSettled { forcing, change });
                }
                change *= 0.5;
                forcing = last + change;
                continue;
            };
            let rate = (next.spot.at.x - fold.spot.at.x) / (forcing - last);
            change = -next.spot.at.x / rate;
            drift = (next.share - fold.share) / (forcing - last);
            (last, fold) = (forcing, next);
            if !change.is_finite() {
                break;
            }
            forcing += change;
            // Within the rounding the secant has no direction.
            if change.abs() <= 2.0 * f64::EPSILON * forcing {
                return Ok(Crossing { forcing, rate, fold });
            }
        }
        Err(NoTangency::NotSettled { forcing, change })
    }

    /// The tangency, sought from `start` on, at which the orbit passes the saddle after the flights of `tip`:
    /// round by round along the saddle, until its stable manifold is straight.
    fn solved(&self, tip: &Tip, start: f64) -> Result<Result<(Solution, u32), NoTangency>, Error> {
        let (mut forcing, mut tip, mut change) = (start, *tip, f64::INFINITY);
        let mut step = 1.0e-8 * start;
        for round in 0..MAX_ROUNDS {
            let Crossing { forcing: next, rate, fold } = match self.crossing(forcing, step, &tip) {
                Ok(found) => found,
                Err(failure) => return Ok(Err(failure)),
            };
            change = next - forcing;
            forcing = next;
            tip = tip.around(fold.share);
            let (low, high) = self.bracket;
            if round >= ROUNDS_ASTRAY && (forcing < 2.0 * low - high || forcing > 2.0 * high - low) {
                return Ok(Err(NoTangency::Elsewhere { forcing }));
            }
            if fold.spot.at.length() <= STRAIGHT {
                return Ok(Ok((self.solution(forcing, &tip, change, rate, fold)?, tip.flights)));
            }
            // The step is limited so that the fold stays near the saddle after one more round.
            let next = self.setting(forcing, tip.impact)?;
            tip.flights += next.saddle.flights as u32;
            step = (change.abs() * 1.0e-3)
                .max(1.0e-13 * forcing)
                .min(1.0e-4 / (rate * next.saddle.unstable).abs());
        }
        Ok(Err(NoTangency::NotSettled { forcing, change }))
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
        let setting = self.setting(forcing, tip.impact)?;
        // The slope is a derivative: its difference is the second one.
        let aside = 1.0e-4 * (tip.window.1 - tip.window.0);
        let slope = |share: f64| setting.spot(share, flights).map(|spot| spot.map(|spot| spot.along.x));
        let curvature = match (slope(fold.share - aside)?, slope(fold.share + aside)?) {
            (Some(before), Some(after)) => (after - before) / (2.0 * aside) / rate,
            _ => f64::MAX,
        };
        let orbit = setting.orbit(fold.share, flights)?;
        let rounding = 8.0 * f64::EPSILON * (1.0 + forcing);
        let Setting { inside, touched, side, .. } = setting;
        let tangency = Tangency { inside, touched, orbit, share: fold.share, side, curvature };
        Ok(Solution { forcing, error: change.abs() + rounding, tangency })
    }
}
