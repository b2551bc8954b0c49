use super::*;
use crate::analysis::periodic::Multipliers;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::observer::Unobserved;
use crate::platform::phase::Phase;
use crate::platform::vibration::Vibration;
use crate::testing::StopAfter;

/// The impacts that were found are an orbit of the impact map, and its multiplier is that of the map's own
/// derivative.
#[test]
fn the_orbit_is_one_of_the_impact_map() {
    for restitution in [0.1, 0.5, 0.8] {
        let found = flip_points::<f64>(restitution, 5, &Unobserved).expect("found");
        for found in &found {
            let point = &found.point;
            let map = ImpactMap::new(Vibration::new(point.peak).expect("legal"), restitution).expect("legal");
            let speeds = point.times.equations(point.peak, restitution).flights;
            let states = point.times.phases.iter().zip(&speeds).map(|(&phase, &(launch, _))| {
                ImpactState::new(Phase::new(phase).expect("finite"), -launch / restitution).expect("legal")
            });
            let orbit = map.refine(&states.collect::<Vec<_>>()).expect("an orbit");
            assert_eq!(orbit.platform_periods, point.times.periods.iter().map(|&k| k as u64).sum::<u64>());
            let Multipliers::Real(large, small) = orbit.multipliers() else { panic!("{orbit:?}") };
            assert!((large + 1.0).abs() < 1e-9, "{restitution} {}: {large}", found.number);
            let expected = -libm::pow(restitution, 2.0 * point.times.len() as f64);
            assert!((small - expected).abs() < 1e-9, "{restitution} {}: {small}", found.number);
        }
    }
}

/// Below a restitution of about 1/20 the orbit of the third doubling would dip through the platform.
#[test]
fn a_cascade_that_ends_at_a_graze_says_so() {
    assert_eq!(doubling_cascade(0.01, 2, &Unobserved).map(|found| found.len()), Ok(2));
    let ended = doubling_cascade(0.01, 3, &Unobserved);
    let Err(Error::EarlierImpact { sought, found, .. }) = ended else { panic!("{ended:?}") };
    assert!(found < sought, "{found} {sought}");
}

/// From next to nothing to next to one: found, or a typed error, never a number that is none.
#[test]
fn every_restitution_has_an_answer() {
    for restitution in [
        f64::MIN_POSITIVE,
        1e-300,
        1e-20,
        1e-3,
        0.02,
        0.04,
        0.06,
        0.99,
        0.999,
        1.0 - 1e-6,
        1.0 - f64::EPSILON,
    ] {
        for count in [1, 2, 4] {
            match doubling_cascade(restitution, count, &Unobserved) {
                Ok(found) => assert!(
                    found.len() == count
                        && found.iter().all(|doubling| doubling.multiplier.is_finite())
                        && found.windows(2).all(|pair| pair[0].axial_forcing < pair[1].axial_forcing),
                    "{restitution:e}: {found:?}"
                ),
                Err(error) => assert!(
                    matches!(error, Error::NotSettled { .. } | Error::EarlierImpact { .. }) && count > 1,
                    "{restitution:e}: {error}"
                ),
            }
        }
    }
    for restitution in [0.0, 1.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(
            matches!(doubling_cascade(restitution, 1, &Unobserved), Err(Error::OutOfRange { .. })),
            "{restitution}"
        );
    }
    assert!(matches!(doubling_cascade(0.5, 14, &Unobserved), Err(Error::OutOfRange { .. })));
    assert_eq!(doubling_cascade(0.5, 0, &Unobserved), Ok(Vec::new()));
}

#[test]
fn a_cascade_can_be_stopped_anywhere() {
    let all = StopAfter::calls(u64::MAX);
    assert_eq!(doubling_cascade(0.5, 12, &all), doubling_cascade(0.5, 12, &Unobserved));
    assert!(all.asked() > 5, "{}", all.asked());
    for calls in 1..all.asked() {
        let stopped = doubling_cascade(0.5, 12, &StopAfter::calls(calls));
        assert!(matches!(stopped, Err(Error::Stopped { total: 12, .. })), "{calls}: {stopped:?}");
    }
}
