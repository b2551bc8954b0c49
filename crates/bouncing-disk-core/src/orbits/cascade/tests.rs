use super::feigenbaum::feigenbaum_estimates;
use super::*;
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::double_double::DoubleDouble;
use crate::orbits::periodic::Multipliers;
use crate::run::Unobserved;

/// The impacts found are an orbit of the impact map, and the multiplier agrees with the map's own derivative.
#[test]
fn the_orbit_is_one_of_the_impact_map() {
    for restitution in [0.1, 0.5, 0.8] {
        let found = flip_points::<f64>(restitution, 5, &Unobserved).expect("found").0;
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
fn a_cascade_that_ends_at_a_graze_has_the_doublings_before() {
    let whole = doubling_cascade(0.01, 2, &Unobserved).expect("found");
    assert!(whole.ended_by.is_none() && whole.doublings.len() == 2);
    assert!((whole.doublings[0].axial_forcing - ImpactMap::first_doubling_forcing(0.01)).abs() < 1e-14);
    for count in [3, 4, 13] {
        let found = doubling_cascade(0.01, count, &Unobserved).expect("some are found");
        assert_eq!(found.doublings, whole.doublings);
        let Some(error @ Error::EarlierImpact { sought, found: first, .. }) = found.ended_by else {
            panic!("{found:?}")
        };
        assert!(first < sought, "{first} {sought}");
        assert_eq!(found.complete(), Err(error));
    }
}

/// A cascade that ends early is also reported as done.
#[test]
fn the_observer_hears_of_the_end() {
    use core::sync::atomic::{AtomicU64, Ordering};
    for restitution in [0.5, 0.01] {
        let last = AtomicU64::new(0);
        let observer = |progress: crate::run::Progress| {
            last.store(progress.done, Ordering::Relaxed);
            core::ops::ControlFlow::Continue(())
        };
        doubling_cascade(restitution, 5, &observer).expect("some are found");
        assert_eq!(last.into_inner(), 5, "{restitution}");
    }
}

/// From nearly zero to nearly one: a result or a typed error, never NaN.
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
                Ok(DoublingCascade { doublings, ended_by }) => assert!(
                    (doublings.len() == count) == ended_by.is_none()
                        && doublings.iter().all(|doubling| doubling.multiplier.is_finite())
                        && doublings.windows(2).all(|pair| pair[0].axial_forcing < pair[1].axial_forcing)
                        && matches!(
                            ended_by,
                            None | Some(Error::NotSettled { .. } | Error::EarlierImpact { .. })
                        ),
                    "{restitution:e}: {doublings:?} {ended_by:?}"
                ),
                Err(error) => panic!("{restitution:e}: {error}"),
            }
        }
    }
}

/// Feigenbaum's constants as they are published (K. Briggs, Math. Comp. 57, 435 (1991)).
const DELTA: f64 = 4.669_201_609_102_99;
const ALPHA: f64 = 2.502_907_875_095_892_7;

fn number(text: &str) -> DoubleDouble {
    text.parse().expect("a number")
}

/// Gamma_1 in closed form, like [`ImpactMap::first_doubling_forcing`].
fn first_doubling_forcing(r: DoubleDouble) -> DoubleDouble {
    let one = DoubleDouble::ONE;
    let sum = one + r;
    let threshold = (one - r) / sum;
    let height = DoubleDouble::from(2.0) * (one + r * r) / (DoubleDouble::PI * sum * sum);
    (threshold * threshold + height * height).sqrt()
}

/// The search uses the closed form in doubles only as its start: it finds the further digits itself.
#[test]
fn the_first_doubling_is_its_closed_form() {
    for text in ["0.001", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "0.999"] {
        let found = doubling_cascade(number(text), 1, &Unobserved).expect("found").doublings[0];
        let distance = (found.axial_forcing - first_doubling_forcing(number(text))).abs().high();
        assert!(distance < 1e-28, "{text}: {distance:e}");
        assert!(distance <= found.forcing_error, "{text}: {distance:e}");
    }
}

/// Both constants lie in every stated interval, and every interval contains the next value.
#[test]
fn the_constants_are_those_of_feigenbaum_and_each_error_is_confirmed() {
    for text in ["0.1", "0.5", "0.8"] {
        let cascade = doubling_cascade(number(text), 13, &Unobserved).expect("found").doublings;
        let estimates = feigenbaum_estimates(&cascade);
        assert_eq!(estimates.first().map(|first| first.number), Some(7));
        assert_eq!(estimates.last().map(|last| last.number), Some(13));
        for estimate in &estimates {
            assert!((estimate.delta - DELTA).abs() <= estimate.delta_error, "{text}: {estimate:?}");
            assert!((estimate.alpha - ALPHA).abs() <= estimate.alpha_error, "{text}: {estimate:?}");
        }
        for pair in estimates.windows(2) {
            assert!((pair[1].delta - pair[0].delta).abs() <= pair[0].delta_error, "{text}: {pair:?}");
            assert!((pair[1].alpha - pair[0].alpha).abs() <= pair[0].alpha_error, "{text}: {pair:?}");
        }
        let last = estimates[estimates.len() - 1];
        assert!(last.delta_error < 1e-6 && last.alpha_error < 1e-6, "{text}: {last:?}");
    }
}

/// Double-doubles are the oracle of doubles: the same equations with 16 more digits.
#[test]
fn doubles_are_as_good_as_they_say() {
    for restitution in [0.05, 0.1, 0.25, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99] {
        let exact =
            doubling_cascade(DoubleDouble::from(restitution), 13, &Unobserved).expect("found").doublings;
        let found = doubling_cascade(restitution, 13, &Unobserved).expect("found").doublings;
        for (found, exact) in found.iter().zip(&exact) {
            let error = (DoubleDouble::from(found.axial_forcing) - exact.axial_forcing).abs().high();
            assert!(error <= found.forcing_error, "{restitution}: {found:?} {error:e}");
            assert!(found.forcing_error < 1.5e-13, "{found:?}");
            assert!(exact.forcing_error < 1e-28, "{exact:?}");
            assert!((found.width - exact.width.high()).abs() <= 1e-4 * found.width, "{found:?}");
            assert_eq!((found.number, found.period), (exact.number, exact.period));
        }
    }
}

/// The forcings from an independent program: mpmath with 50 digits, the impact map by shooting, and its
/// derivative by differences over 1e-16, with an error of 1e-26.
#[test]
fn twenty_five_digits_are_those_of_an_independent_program() {
    for (restitution, index, forcing) in [
        ("0.5", 1, "0.530664170883060994475449269442"),
        ("0.5", 2, "0.540102086076066366919615211223"),
        ("0.1", 2, "1.06144457818861617255719788652"),
    ] {
        let found = doubling_cascade(number(restitution), 3, &Unobserved).expect("found").doublings[index];
        let distance = (found.axial_forcing - number(forcing)).abs().high();
        assert!(distance < 1e-26, "{restitution}: {found:?} {distance:e}");
    }
}

/// Each doubling is a root, whatever the path to it.
#[test]
fn the_multiplier_is_minus_one() {
    let cascade = doubling_cascade(number("0.5"), 13, &Unobserved).expect("found").doublings;
    for doubling in &cascade {
        let left = (doubling.multiplier + DoubleDouble::ONE).abs().high();
        // The distance of two doublings takes the multiplier from 1 to -1.
        let bound = 1e-30 * libm::pow(6.7, doubling.number as f64);
        assert!(left < bound, "{}: {left:e}", doubling.number);
    }
    for (number, pair) in cascade.windows(2).enumerate() {
        assert!(pair[0].axial_forcing < pair[1].axial_forcing, "{number}");
        assert_eq!(pair[1].period, 2 * pair[0].period);
    }
}

#[test]
fn doublings_and_estimates_are_printed() {
    let cascade = doubling_cascade(number("0.5"), 8, &Unobserved).expect("found").doublings;
    assert_eq!(
        format!("{:.25}", cascade[2]),
        "Gamma_3 = 0.5401020860760663669196152, of the orbit of 4 impacts"
    );
    assert!(feigenbaum_estimates::<f64>(&[]).is_empty());
    assert_eq!(format!("{:.4}", cascade[0]), "Gamma_1 = 0.4860, of the orbit of 1 impact");
    let text = format!("{:.3}", feigenbaum_estimates(&cascade)[1]);
    assert!(text.starts_with("delta = 4.669 +- ") && text.contains("alpha = 2.503 +- "), "{text}");
    assert!(text.ends_with("from 8 doublings"), "{text}");
}
