//! Orbits near a fold or a doubling: their positions to the last bit, and their errors due to rounding
//! (docs/numerics-dynamics.md, "Orbits on the margin").
//!
//! The errors of the position and of the trace T: let a unit in the last place of Gamma and r together move
//! the orbit by t to first order. Let v be the weak direction, in which any perturbation moves the solution
//! most. Differences of T along v give the change c(x) of T over the distance x. Let g and g' be |1 - T + D|
//! minus and plus the rounding of T. If c(2t) < g/2, the condition of Newton and Kantorovich, the error of
//! the position is 2t. Otherwise it is the first x, doubled from 2^-52, with x (c(x)/3 - g') > t |1 - T + D|.
//! The equation changes by at least x c(x)/3 for a fold and for a cubic, so no map within rounding has a
//! solution beyond this distance. The error of T is c at that distance. Away from the margin the error of the
//! position is below 5e-7, and the error of T below 1e-6 of the derivative's size.

use core::f64::consts::TAU;

use glam::{DMat2, DVec2};

use super::{PeriodicOrbit, phase_difference};
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::bordered_cyclic::{Border, CyclicEquations};
use crate::numerics::double_double::DoubleDouble;
use crate::orbits::closing::{Closed, Closing, ContinuationParameter};

/// The distance (rad, and relative speed) within which two orbits count as one, unless a multiplier is near 1
/// or -1: then their own uncertainty decides.
pub const SAME: f64 = 1.0e-6;

/// The value of 1 - T + D or 1 + T + D, relative to the derivative's size, below which a multiplier counts as
/// near 1 or -1.
const NEXT_TO_MARGIN: f64 = 1.0e-4;

/// The value below which the equations of the uncertainty are set up at a distance of `ASIDE` rad from the
/// orbit, where they are not singular.
const SINGULAR: f64 = 1.0e-13;
const ASIDE: f64 = 1.0e-9;

/// Newton steps in double-doubles: their number, the longest, and one below the rounding of a double.
const MAX_STEPS: usize = 64;
const LONGEST_STEP: f64 = 0.05;
const ROUNDING: f64 = 0.25 * f64::EPSILON;

/// Largest residual, in units of the rounding of the parameters, for an orbit that exists on one side of a
/// fold within that rounding.
const WITHIN_ROUNDING: f64 = 4.0;

/// The step (rad) of the differences for the change of the trace along the weak direction.
const DIFFERENCE: f64 = 1.0e-5;

/// Whether the fixed-point function 1 - T + D and the flip function 1 + T + D are near zero.
pub fn next_to_margin(monodromy: DMat2, determinant: f64) -> (bool, bool) {
    let (trace, room) = (monodromy.x_axis.x + monodromy.y_axis.y, NEXT_TO_MARGIN * size(monodromy));
    ((1.0 - trace + determinant).abs() < room, (1.0 + trace + determinant).abs() < room)
}

/// One plus the sum of the entries' magnitudes.
fn size(matrix: DMat2) -> f64 {
    matrix.to_cols_array().iter().fold(1.0, |sum, entry| sum + entry.abs())
}

/// The equations that an orbit satisfies, and the orbit as a solution of them.
struct Equations {
    map: ImpactMap,
    closing: Closing<ImpactMap>,
    at: Closed,
    turns: Vec<f64>,
    determinant: f64,
}

impl Equations {
    fn of(map: &ImpactMap, states: &[ImpactState]) -> Option<Self> {
        let (closing, at) = Closing::of(map, ContinuationParameter::Forcing, states).ok()?;
        let turns = closing.turns().to_vec();
        Some(Self { map: *map, closing, at, turns, determinant: map.determinant_after(states.len()) })
    }

    fn length(&self, steps: &[DVec2]) -> f64 {
        let speed = self.closing.scale.speed;
        // NaN counts as infinite.
        steps.iter().fold(0.0, |most: f64, step| {
            let own = step.x.abs().max(step.y.abs() / speed);
            if own.is_finite() { most.max(own) } else { f64::INFINITY }
        })
    }

    /// The displacement due to a change of the forcing and the restitution by one unit in the last place, to
    /// first order.
    fn moved_by_parameters(&self, equations: &CyclicEquations, at: &Closed) -> Option<Vec<DVec2>> {
        let r = self.map.restitution();
        let mut by_restitution = self.closing.clone();
        by_restitution.by = ContinuationParameter::Restitution;
        let column = by_restitution.equations(&Closed { parameter: r, ..at.clone() })?.column;
        let by = |column: &[DVec2], change: f64| {
            solved(equations, column.iter().map(|part| *part * change).collect())
        };
        let forcing = by(&equations.column, f64::EPSILON * at.parameter);
        let restitution = by(&column, f64::EPSILON * r);
        // The signs with which both changes add up.
        let together = forcing.iter().zip(&restitution).fold(0.0, |sum, (a, b)| sum + a.dot(*b));
        let sign = if together < 0.0 { -1.0 } else { 1.0 };
        Some(forcing.iter().zip(&restitution).map(|(a, b)| *a + *b * sign).collect())
    }

    /// The trace of the derivative around the sequence, which need not be an orbit.
    fn trace(&self, at: &Closed) -> Option<f64> {
        let states = self.closing.states(at)?;
        let n = states.len();
        let around = (0..n).fold(DMat2::IDENTITY, |product, i| {
            let h = self.closing.duration(&at.impacts, i);
            self.map.derivative(states[i], states[(i + 1) % n], h) * product
        });
        Some(around.x_axis.x + around.y_axis.y)
    }

    /// The residual of the exact equations at impacts in double-doubles.
    fn residuals(&self, impacts: &[[DoubleDouble; 2]]) -> Vec<DVec2> {
        let p = DoubleDouble::from(self.map.vibration().peak_acceleration());
        let r = DoubleDouble::from(self.map.restitution());
        let waves: Vec<_> = impacts.iter().map(|impact| impact[0].sin_cos()).collect();
        let n = impacts.len();
        let one = |i: usize| {
            let next = (i + 1) % n;
            let (own, to) = (impacts[i][1], impacts[next][1]);
            let h = self.duration(impacts, i);
            let flight = own - DoubleDouble::from(0.5) * h - p * (waves[next].0 - waves[i].0) / h;
            let law = to + r * (own - h) - (DoubleDouble::ONE + r) * p * waves[next].1;
            DVec2::new(flight.high(), law.high())
        };
        (0..n).map(one).collect()
    }

    fn duration(&self, impacts: &[[DoubleDouble; 2]], i: usize) -> DoubleDouble {
        let turns = DoubleDouble::from(2.0 * self.turns[i]) * DoubleDouble::PI;
        impacts[(i + 1) % impacts.len()][0] - impacts[i][0] + turns
    }

    /// The impacts, each rounded once.
    fn states(&self, impacts: &[[DoubleDouble; 2]]) -> Option<Vec<ImpactState>> {
        let p = DoubleDouble::from(self.map.vibration().peak_acceleration());
        let n = impacts.len();
        let one = |i: usize| {
            let before = (i + n - 1) % n;
            let landing = impacts[before][1] - self.duration(impacts, before);
            let velocity = (landing - p * impacts[i][0].sin_cos().1).high();
            (velocity < 0.0)
                .then(|| ImpactState::new(Phase::new(impacts[i][0].high()).ok()?, velocity).ok())?
        };
        (0..n).map(one).collect()
    }
}

/// The solution of the equations with this right side, at the same parameter.
fn solved(equations: &CyclicEquations, right: Vec<DVec2>) -> Vec<DVec2> {
    let border = Border { first: DVec2::ZERO, parameter: 1.0, right: 0.0 };
    CyclicEquations { right, ..equations.clone() }.solve(border).0
}

/// The impacts of an orbit near a fold, or near the doubling of its birth, by Newton's method with residuals
/// in double-doubles; `None` if there is no orbit.
///
/// Residuals in doubles would leave an error of 1e-16 divided by the distance of a multiplier from 1. Without
/// a solution an orbit still counts if its residual is within the rounding of the parameters: it exists for a
/// neighbouring map.
pub(super) fn polished(map: &ImpactMap, states: &[ImpactState]) -> Option<Vec<ImpactState>> {
    let own = Equations::of(map, states)?;
    let double = DoubleDouble::from;
    let mut impacts: Vec<_> = own.at.impacts.iter().map(|at| [double(at.x), double(at.y)]).collect();
    let mut nearest: Option<(f64, Vec<ImpactState>)> = None;
    for _ in 0..MAX_STEPS {
        let rounded = impacts.iter().map(|[phase, speed]| DVec2::new(phase.high(), speed.high())).collect();
        let at = Closed { impacts: rounded, ..own.at.clone() };
        let Some(equations) = own.closing.equations(&at) else { break };
        let residuals = own.residuals(&impacts).into_iter().map(|left| -left).collect();
        let steps = solved(&equations, residuals);
        let length = own.length(&steps);
        if !length.is_finite() {
            // The exact point at which the equations are singular.
            impacts.iter_mut().for_each(|impact| impact[0] = impact[0] + double(ASIDE));
            continue;
        }
        if length <= ROUNDING {
            return own.states(&impacts);
        }
        let share = length / own.length(&own.moved_by_parameters(&equations, &at)?);
        if share.is_finite() && nearest.as_ref().is_none_or(|(least, _)| share < *least) {
            nearest = own.states(&impacts).map(|states| (share, states)).or(nearest);
        }
        let shortened = (LONGEST_STEP / length).min(1.0);
        for (impact, step) in impacts.iter_mut().zip(&steps) {
            *impact = [impact[0] + double(shortened * step.x), impact[1] + double(shortened * step.y)];
        }
    }
    nearest.filter(|(share, _)| *share <= WITHIN_ROUNDING).map(|(_, states)| states)
}

/// The largest changes of an orbit (rad, relative speed) and of its derivative's trace due to rounding of the
/// parameters and of the solution.
pub(super) fn errors(map: &ImpactMap, states: &[ImpactState], monodromy: DMat2) -> (f64, f64) {
    let (n, size) = (states.len(), size(monodromy));
    let determinant = map.determinant_after(n);
    let rounding =
        4.0 * f64::EPSILON * (n as f64 + 2.0) * size + (monodromy.determinant() - determinant).abs() / size;
    let isolated = next_to_margin(monodromy, determinant) == (false, false);
    match measured_errors(map, states, rounding, isolated) {
        Some((position, change)) if !isolated => (position, rounding + change),
        Some((_, change)) => (0.5 * SAME, rounding + change.min(SAME * size)),
        None => (0.5 * SAME, if isolated { rounding + SAME * size } else { f64::MAX }),
    }
}

/// The errors of an orbit due to rounding of its parameters and, for an `isolated` orbit, which is not
/// polished, due to the residual of its equations. The trace of the sequence is known to `rounding`.
fn measured_errors(
    map: &ImpactMap,
    states: &[ImpactState],
    rounding: f64,
    isolated: bool,
) -> Option<(f64, f64)> {
    let own = Equations::of(map, states)?;
    let distance_from_fold = |trace: f64| (1.0 - trace + own.determinant).abs();
    let trace = own.trace(&own.at)?;
    let (mut aside, mut distance) = (own.at.clone(), distance_from_fold(trace));
    if distance < SINGULAR {
        aside.impacts.iter_mut().for_each(|impact| impact.x += ASIDE);
        distance = distance_from_fold(own.trace(&aside)?);
    }
    let equations = own.closing.equations(&aside)?;
    let mut length = own.length(&own.moved_by_parameters(&equations, &aside)?);
    if isolated {
        length += own.length(&solved(&equations, equations.right.clone()));
    }
    // A push in a generic direction moves the solution along the weak direction.
    let moved = solved(&equations, (0..states.len()).map(|i| DVec2::new(1.0 + i as f64, 1.0)).collect());
    let most = own.length(&moved);
    if !(length.is_finite() && most > 0.0 && most.is_finite()) {
        return None;
    }
    let direction = Closed { impacts: moved.iter().map(|part| *part / most).collect(), parameter: 0.0 };
    // The effect of the parameters in the equation of the weak direction, (1 - T + D) t = push.
    let push = distance * length;
    let [up, down] = [DIFFERENCE, -DIFFERENCE].map(|by| own.trace(&own.at.moved(&direction, by)));
    let (up, down) = (up?, down?);
    let slope = ((up - down) / (2.0 * DIFFERENCE)).abs();
    let curvature = ((up + down - 2.0 * trace) / (DIFFERENCE * DIFFERENCE)).abs();
    let change = |by: f64| slope * by + 0.5 * curvature * by * by;
    // Newton and Kantorovich: if the derivative changes by less than half of itself over twice the
    // first-order displacement, that is the error. Otherwise the next orbit may be reached, and the error
    // extends beyond it.
    let distance = distance_from_fold(trace);
    let least = (distance - rounding).max(0.0);
    let mut by = 2.0 * push / least;
    let is_isolated = change(by) < 0.5 * least;
    if !is_isolated {
        by = f64::EPSILON;
        while by * (change(by) / 3.0 - distance - rounding) < push && by < 1.0 {
            by *= 2.0;
        }
    }
    let reached = own.closing.states(&own.at.moved(&direction, by))?;
    let moved = states.iter().zip(&reached).fold(0.0, |most: f64, (one, other)| {
        let phase = phase_difference(one.phase().angle(), other.phase().angle()).abs();
        most.max(phase).max((one.velocity() - other.velocity()).abs() / (1.0 + one.velocity().abs()))
    });
    Some((2.0 * moved + 16.0 * f64::EPSILON * TAU, change(by)))
}

impl ImpactMap {
    /// The determinant r^(2n) of the derivative around an orbit of n impacts.
    pub(super) fn determinant_after(&self, impacts: usize) -> f64 {
        (0..impacts).fold(1.0, |product, _| product * (self.restitution() * self.restitution()))
    }

    /// An orbit from an iteration, made exact if it is near a margin; `None` if it is not an orbit.
    pub(super) fn exact_orbit(&self, orbit: PeriodicOrbit) -> Option<PeriodicOrbit> {
        let (fold, _) = next_to_margin(orbit.monodromy, self.determinant_after(orbit.period()));
        let orbit = if fold {
            let states = polished(self, &orbit.states)?;
            let monodromy = self.shoot(&states, 1.0).ok()?.monodromy;
            PeriodicOrbit { states, monodromy, ..orbit }
        } else {
            orbit
        };
        let PeriodicOrbit { states, platform_periods, monodromy, .. } = orbit;
        Some(PeriodicOrbit::of(self, states, platform_periods, monodromy))
    }
}

#[cfg(test)]
mod tests {
    use super::super::catalogue::OrbitSearch;
    use super::super::{Multipliers, Stability};
    use super::*;
    use crate::map::impact_map::map;
    use crate::run::Unobserved;

    fn found(map: &ImpactMap, impacts: usize, starts: u32) -> Vec<PeriodicOrbit> {
        let search =
            OrbitSearch::new(impacts, impacts as u64).and_then(|all| all.with_starts(starts, starts));
        map.periodic_orbits(&search.expect("legal"), &Unobserved).expect("no failure").orbits
    }

    /// At the doubling of the one-impact orbit: the two-impact orbits near it, and the stability of all,
    /// against the normal form, with the amplitude at 1e-6 scaled by the root of the distance.
    #[test]
    fn beside_a_doubling_there_are_the_orbits_of_the_normal_form() {
        for (restitution, impacts) in [(0.3, 2), (0.5, 4), (0.8, 2)] {
            let first = ImpactMap::first_doubling_forcing(restitution);
            let at = |offset: f64| {
                let map = map(first + offset, restitution);
                let parent = map.period_one(1).expect("exists");
                let near = |orbit: &PeriodicOrbit| {
                    orbit.states.iter().all(|own| {
                        (own.velocity() - parent.velocity()).abs() < 0.05
                            && (own.phase().angle() - parent.phase().angle()).abs() < 0.05
                    })
                };
                let own: Vec<_> = found(&map, impacts, 10).into_iter().filter(near).collect();
                let kinds: Vec<_> = own.iter().map(|own| (own.period(), own.stability())).collect();
                let width = |orbit: &PeriodicOrbit| {
                    phase_difference(orbit.states[0].phase().angle(), orbit.states[1].phase().angle()).abs()
                };
                (kinds, own.iter().find(|own| own.period() == 2).map(width))
            };
            let (_, amplitude) = at(1e-6);
            let amplitude = amplitude.expect("doubles") / 1e-3;
            for offset in [1e-8, 1e-10, 1e-11, 1e-12, 1e-13] {
                let (kinds, width) = at(offset);
                assert_eq!(
                    kinds,
                    [(1, Stability::Unstable), (2, Stability::Stable)],
                    "{restitution} {offset:e}"
                );
                // The forcing itself has a rounding error of 1e-16.
                let expected = amplitude * ((first + offset) - first).sqrt();
                let room = 1e-4 + 4e-16 / offset;
                let share = width.expect("doubles") / expected;
                assert!((share - 1.0).abs() < room, "{restitution} {offset:e}: {share}");
            }
            for offset in [-1e-6, -1e-8, -1e-10, -1e-12, -1e-13] {
                assert_eq!(at(offset).0, [(1, Stability::Stable)], "{restitution} {offset:e}");
            }
            for ulps in -3..=3 {
                assert_eq!(
                    at(f64::from(ulps) * 5.6e-17).0,
                    [(1, Stability::Marginal)],
                    "{restitution} {ulps}"
                );
            }
        }
    }

    /// At the fold of the one-impact orbits the search by iteration agrees with the closed form: a node and a
    /// saddle above it, none below, and one marginal orbit if rounding decides.
    #[test]
    fn beside_a_fold_there_are_two_orbits_or_none() {
        for restitution in [0.1, 0.3, 0.5, 0.8, 0.95, 0.999] {
            let fold = (1.0 - restitution) / (1.0 + restitution);
            for offset in [1e-6, 1e-9, 1e-11, 1e-13] {
                // A unit in the last place of r moves the fold by 1e-16/(1 - r) of itself.
                if offset * (1.0 - restitution) < 1e-15 {
                    continue;
                }
                let at = |share: f64| map(fold * (1.0 + share), restitution);
                let kinds: Vec<_> = found(&at(offset), 1, 2).iter().map(PeriodicOrbit::stability).collect();
                assert_eq!(kinds, [Stability::Stable, Stability::Unstable], "{restitution} {offset:e}");
                let guess = ImpactState::new(Phase::of_angle(1e-5), -at(0.0).period_one_impact_speed(1));
                let guess = [guess.expect("legal")];
                let iterated = at(offset).refine(&guess).expect("exists");
                let pair = at(offset).period_one_pair(1).expect("exists");
                let nearest = [pair.node, pair.saddle].map(|own| {
                    phase_difference(own.state.phase().angle(), iterated.states[0].phase().angle()).abs()
                });
                assert!(
                    nearest[0].min(nearest[1]) <= iterated.position_error,
                    "{restitution} {offset:e} {nearest:?}"
                );
                assert!(nearest[0].max(nearest[1]) > 2.0 * iterated.position_error);
                assert!(found(&at(-offset), 1, 2).is_empty());
                let none = at(-offset).refine(&guess);
                assert!(none.is_err(), "{restitution} {offset:e} {none:?}");
            }
            let kinds: Vec<_> =
                found(&map(fold, restitution), 1, 12).iter().map(PeriodicOrbit::stability).collect();
            assert!(
                kinds.iter().all(|kind| *kind == Stability::Marginal) && kinds.len() <= 1,
                "{restitution} {kinds:?}"
            );
        }
        // Multipliers 1 and r^2.
        let semi_stable = found(&map(1.0 / 3.0, 0.5), 1, 24);
        let [orbit] = semi_stable.as_slice() else { panic!("{semi_stable:?}") };
        let Multipliers::Real(large, small) = orbit.multipliers() else { panic!("{orbit:?}") };
        assert!((large - 1.0).abs() < 1e-7 && (small - 0.25).abs() < 1e-7, "{large} {small}");
    }
}
