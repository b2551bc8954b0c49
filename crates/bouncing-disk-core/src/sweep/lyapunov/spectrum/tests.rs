//! On eleven chaotic attractors, down to an exponent of 0.008 and up to restitution 0.95, 94 to 100 % of
//! the intervals of 1.96 errors from 16,000 impacts contain the exponent. On random orbits of 3,000 impacts
//! the sum of both exponents agrees with the exact one to 1e-10.

use super::*;
use crate::map::impact_map::{ImpactMap, map};
use crate::numerics::testing::golden_spread;
use crate::orbits::periodic::Multipliers;
use crate::run::Unobserved;
use crate::sweep::lyapunov::lyapunov_exponents;

fn start() -> ImpactState {
    ImpactState::from_normalised(0.8, 1.3).expect("legal")
}

/// Orbits of every kind, most of them chaotic.
fn starts(count: u64) -> Vec<(ImpactMap, ImpactState)> {
    (0..count)
        .map(|k| {
            let state = ImpactState::from_normalised(6.0 * golden_spread(3 * k), 2.0 * golden_spread(5 * k));
            (map(0.35 + 2.0 * golden_spread(k), 0.1 + 0.8 * golden_spread(7 * k)), state.expect("legal"))
        })
        .collect()
}

/// The sum is known exactly (docs/numerics-dynamics.md): the second exponent is found without it.
#[test]
fn the_sum_of_the_exponents_is_the_exact_one() {
    let outcomes = lyapunov_spectra(&starts(300), 100, 3_000, &Unobserved).expect("no failure");
    let mut chaotic = 0;
    for spectrum in outcomes.iter().filter_map(LyapunovOutcome::spectrum) {
        let sum = spectrum.largest + spectrum.second.expect("restitution above 0");
        let exact = spectrum.exact_sum.expect("restitution above 0");
        assert!((sum - exact).abs() < 1e-10, "{spectrum:?}");
        chaotic += usize::from(spectrum.largest > 3.0 * spectrum.standard_error);
    }
    assert!(chaotic > 15, "{chaotic}");
}

/// Along a periodic orbit the exponents are the logarithms of the multipliers, whose product is the
/// restitution squared.
#[test]
fn the_exponents_of_a_periodic_orbit_are_those_of_its_multipliers() {
    // Near its birth the multipliers are real.
    let map = map(0.334, 0.5);
    let state = map.period_one(1).expect("exists");
    let (_, derivative) = map.step_with_derivative(state).expect("flies");
    let Multipliers::Real(large, small) = Multipliers::of(derivative) else { panic!("real") };
    // The first impacts turn the directions into the eigendirections: they are in both sums.
    let sums = [1_000, 3_000].map(|impacts| {
        let outcome = lyapunov_spectra(&[(map, state)], 100, impacts, &Unobserved).expect("no failure")[0];
        let spectrum = *outcome.spectrum().expect("bounces on");
        assert!(spectrum.standard_error < 1e-3 && spectrum.impacts == impacts, "{spectrum:?}");
        [spectrum.largest, spectrum.second.expect("two")].map(|exponent| exponent * impacts as f64)
    });
    for (k, multiplier) in [large, small].into_iter().enumerate() {
        let exponent = (sums[1][k] - sums[0][k]) / 2_000.0;
        assert!((exponent - ln(multiplier.abs())).abs() < 1e-11, "{exponent} of {multiplier}");
    }
}

/// For at least 90 of 100 orbits on one attractor, the exponent of far longer orbits lies within 1.96 errors:
/// deep in chaos, near a crisis, with weak dissipation, and in the bands of weak chaos. The error is not much
/// larger than the spread, except in the bands, where neighbouring growths compensate each other.
#[test]
fn the_exponent_lies_within_its_errors() {
    for (forcing, restitution) in
        [(0.55, 0.5), (0.56, 0.5), (0.5607, 0.5), (0.5427, 0.5), (0.543, 0.5), (0.5463, 0.5), (0.5, 0.95)]
    {
        let starts: Vec<_> = (0..100)
            .map(|k| {
                let state = ImpactState::from_normalised(0.8 + 1e-2 * golden_spread(k), 1.3).expect("legal");
                (map(forcing, restitution), state)
            })
            .collect();
        let spectra = |orbits: usize, impacts| -> Vec<LyapunovSpectrum> {
            let outcomes =
                lyapunov_spectra(&starts[..orbits], 2_000, impacts, &Unobserved).expect("no failure");
            outcomes.iter().filter_map(|outcome| outcome.spectrum().copied()).collect()
        };
        let mean_of = |all: &[LyapunovSpectrum], of: fn(&LyapunovSpectrum) -> f64| {
            crate::numerics::statistics::mean(&all.iter().map(of).collect::<Vec<_>>())
        };
        let exact = mean_of(&spectra(20, 50_000), |own| own.largest);
        let all = spectra(100, 4_000);
        let held = all.iter().filter(|own| (own.largest - exact).abs() <= 1.96 * own.standard_error).count();
        let spread = all.iter().map(|own| (own.largest - exact) * (own.largest - exact)).sum::<f64>();
        let ratio = mean_of(&all, |own| own.standard_error) / (spread / all.len() as f64).sqrt();
        let place = format!("{forcing}, {restitution}: {held} of {}, {ratio}", all.len());
        assert!(all.len() >= 90 && held * 10 >= all.len() * 9 && (exact < 0.1 || ratio < 1.6), "{place}");
    }
}

#[test]
fn the_largest_exponent_is_the_known_one() {
    let starts = starts(60);
    let spectra = lyapunov_spectra(&starts, 50, 500, &Unobserved).expect("no failure");
    let exponents = lyapunov_exponents(&starts, 50, 500, &Unobserved).expect("no failure");
    for (outcome, exponent) in spectra.iter().zip(exponents) {
        match (outcome, exponent) {
            (LyapunovOutcome::Exponents(spectrum), Some(exponent)) => {
                assert!((spectrum.largest - exponent).abs() < 1e-12 * (1.0 + exponent.abs()));
            }
            (LyapunovOutcome::Rested { .. } | LyapunovOutcome::Grazed { .. }, None) => (),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn what_has_no_exponent_says_why() {
    let fails = |map: ImpactMap, state| {
        lyapunov_spectra(&[(map, state)], 3, 100, &Unobserved).expect("no failure")[0]
    };
    // A weak vibration, a still one, and a disk that never left.
    let resting = fails(map(0.2, 0.5), start());
    assert!(matches!(resting, LyapunovOutcome::Rested { impacts: 1.. }), "{resting:?}");
    assert_eq!(resting.spectrum(), None);
    let phase = Phase::new(0.0).expect("legal");
    let still = fails(map(0.0, 0.0), ImpactState::new(phase, -1.0).expect("legal"));
    assert_eq!(still, LyapunovOutcome::Rested { impacts: 0 });
    let never = fails(map(0.2, 0.5), ImpactState::new(phase, -0.0).expect("legal"));
    assert_eq!(never, LyapunovOutcome::Rested { impacts: 0 });
}

/// Without restitution the disk lands and leaves again at once if the platform falls away: one exponent is
/// left.
#[test]
fn without_restitution_there_is_one_exponent() {
    let outcomes: Vec<_> = (0..200)
        .map(|k| lyapunov_spectra(&[(map(0.5 + 0.02 * f64::from(k), 0.0), start())], 0, 16, &Unobserved))
        .map(|outcomes| outcomes.expect("no failure")[0])
        .collect();
    assert!(outcomes.iter().any(|outcome| matches!(outcome, LyapunovOutcome::Rested { .. })));
    for spectrum in outcomes.iter().filter_map(LyapunovOutcome::spectrum) {
        assert_eq!((spectrum.second, spectrum.exact_sum), (None, None));
        assert!(spectrum.largest.is_finite());
    }
}
