//! How near a start must come to an attracting orbit of any length to count as caught.

use core::f64::consts::TAU;

use crate::analysis::periodic::{PeriodicOrbit, distance};
use crate::error::Error;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::elementary::sin_cos;
use crate::observer::{Observer, Tick, Watch};
use crate::platform::phase::Phase;

/// The largest circle that is tried (rad; a radian counts as much as the speed P), and below which none is.
const LARGEST: f64 = 0.05;
const SMALLEST: f64 = 1.0e-8;

/// The circles of one radius, and the starts on each of them.
const CIRCLES: [f64; 3] = [1.0, 0.5, 0.25];
const SAMPLES: u32 = 16;

/// Part of the radius within which a start has come so much nearer to the impact that it began beside that it
/// need not be followed further; the rounds of the orbit after which it must at least have come nearer, as it
/// does slowly next to a doubling or a fold; and the multiple of the radius that it may stray then.
const NEARER: f64 = 0.125;
const ROUNDS: u32 = 200;
const STRAYING: f64 = 4.0;

/// Impacts up to which the wider radius of `PeriodicOrbit::trapping_radius` is tried first, and its starts.
const SHORT: usize = 8;
const TRAPPING_SAMPLES: u32 = 64;

/// The share of the radius that counts.
const SHARE: f64 = 0.5;

/// The trapping radius of a short orbit, if it has one. Of all others half the radius of the largest circles on
/// which sampled starts come back eight times nearer to the impact that they began beside, however far they stray
/// before, or nearer without straying: of 0.05, 0.025, ... rad. `None` where starts fail on circles of 1e-8 rad.
///
/// Unlike in `PeriodicOrbit::attraction_radius` a start is mostly followed no further than that, and compared
/// with one impact a round, so that an orbit of hundreds of impacts takes as long as one of a few takes there.
pub(super) fn catching_radius(
    map: &ImpactMap,
    orbit: &PeriodicOrbit,
    observer: &dyn Observer,
) -> Result<Option<f64>, Error> {
    if orbit.period() <= SHORT
        && let Some(radius) = orbit.trapping_radius_observed(map, TRAPPING_SAMPLES, observer)?
    {
        return Ok(Some(radius));
    }
    let watch = Watch::begin(observer, 0, 1)?;
    let mut work = watch.work();
    let tick = &mut |flights| work.spend(flights);
    let mut radius = LARGEST;
    while radius >= SMALLEST {
        if all_come_nearer(map, orbit, radius, tick)? {
            return Ok(Some(SHARE * radius));
        }
        radius *= 0.5;
    }
    Ok(None)
}

fn all_come_nearer(
    map: &ImpactMap,
    orbit: &PeriodicOrbit,
    radius: f64,
    tick: Tick<'_>,
) -> Result<bool, Error> {
    let scale = map.vibration().peak_acceleration();
    for centre in &orbit.states {
        for circle in CIRCLES {
            for sample in 0..SAMPLES {
                let (s, c) = sin_cos(TAU * f64::from(sample) / f64::from(SAMPLES));
                let angle = centre.phase().angle() + circle * radius * c;
                let velocity = centre.velocity() + circle * radius * scale * s;
                let Ok(start) = Phase::new(angle).and_then(|phase| ImpactState::new(phase, velocity)) else {
                    return Ok(false);
                };
                if !comes_nearer(map, orbit.period() as u64, (start, *centre), circle * radius, tick)? {
                    return Ok(false);
                }
            }
        }
    }
    Ok(true)
}

/// Whether a start comes back nearer to its impact than it began.
fn comes_nearer(
    map: &ImpactMap,
    period: u64,
    (start, centre): (ImpactState, ImpactState),
    from: f64,
    tick: Tick<'_>,
) -> Result<bool, Error> {
    let scale = map.vibration().peak_acceleration();
    let mut state = start;
    let (mut last, mut farthest) = (from, from);
    for _ in 0..ROUNDS {
        tick(period)?;
        let Ok(next) = map.iterate(state, period) else { return Ok(false) };
        state = next;
        last = distance(state, centre, scale);
        farthest = farthest.max(last);
        if last <= NEARER * from {
            return Ok(true);
        }
    }
    Ok(last < from && farthest <= STRAYING * from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observer::Unobserved;
    use crate::platform::vibration::Vibration;
    use crate::testing::StopAfter;

    fn radius(axial_forcing: f64, restitution: f64) -> Option<f64> {
        let map = ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), restitution)
            .expect("legal");
        let orbit = map.refine(&[map.period_one(1).expect("exists")]).expect("refines");
        catching_radius(&map, &orbit, &Unobserved).expect("nobody stops it")
    }

    #[test]
    fn an_attracting_orbit_has_a_radius_and_a_saddle_has_none() {
        assert!(radius(0.45, 0.5).is_some_and(|radius| radius > 0.01));
        assert_eq!(radius(0.50, 0.5), None);
    }

    /// Close to its birth and to its doubling an orbit attracts slowly, or from nearby only.
    #[test]
    fn the_ends_of_a_window_have_smaller_radii() {
        let third = 1.0 / 3.0;
        let wide = radius(0.4, 0.5).expect("attracts");
        for above in [1e-3, 1e-6] {
            let found = radius(third + above, 0.5).expect("attracts");
            assert!(found < wide && found > 1e-8, "{above}: {found}");
        }
        let doubling = ImpactMap::first_doubling_forcing(0.5);
        assert!(radius(doubling - 1e-3, 0.5).is_some());
        // Just beyond it the starts end on the doubled orbit, which is nearer than they began: circles do not
        // show it, and nobody asks for the radius of an orbit whose multipliers are not inside the unit circle.
        assert!(radius(doubling + 1e-4, 0.5).is_some());
    }

    #[test]
    fn a_search_that_is_stopped_says_so() {
        let map = ImpactMap::new(Vibration::from_axial_forcing(0.45).expect("legal"), 0.5).expect("legal");
        let orbit = map.refine(&[map.period_one(1).expect("exists")]).expect("refines");
        for calls in 1..=3 {
            let stopped = catching_radius(&map, &orbit, &StopAfter::calls(calls));
            assert!(matches!(stopped, Err(Error::Stopped { .. })), "{stopped:?}");
        }
    }

    /// The orbit of four impacts at Gamma = 0.486 does not trap, and period 1 next to its doubling attracts slowly.
    #[test]
    fn sheared_and_slow_orbits_have_a_radius() {
        let map = ImpactMap::new(Vibration::from_axial_forcing(0.486).expect("legal"), 0.5).expect("legal");
        let start = ImpactState::from_normalised(0.0660 * TAU, 0.3170).expect("legal");
        let orbit = map.settled_orbit(start, 4_000, 64, 1.0e-8).expect("no failure").expect("settles");
        assert_eq!(orbit.period(), 4);
        let found = catching_radius(&map, &orbit, &Unobserved).expect("nobody stops it");
        assert!(found.is_some_and(|radius| radius > 1e-5), "{found:?}");
        assert!(radius(0.486, 0.5).is_some_and(|radius| radius > 0.1));
    }
}
