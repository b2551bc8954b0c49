use core::f64::consts::{PI, TAU};

use super::*;
use crate::attractors::basin::{ATTACHED, BasinSettings};
use crate::map::impact_map::OrbitEvent;
use crate::map::impact_map::map;
use crate::numerics::random::SplitMix64;
use crate::numerics::testing::stored;
use crate::run::testing::StopAfter;
use crate::sweep::lyapunov::spectrum::lyapunov_spectra;

fn state(angle: f64, normalised_speed: f64) -> ImpactState {
    ImpactState::from_normalised(angle, normalised_speed).expect("legal")
}

fn short() -> VerdictSettings {
    VerdictSettings { transient: 1_000, impacts: 2_000, ..VerdictSettings::default() }
}

fn of(map: ImpactMap, start: ImpactState) -> Verdict {
    map.verdict(start, short()).expect("no failure")
}

/// Random parameters and starts over the whole range possible for a disk.
fn random_starts(count: usize, seed: u64) -> Vec<(ImpactMap, ImpactState)> {
    let mut random = SplitMix64::new(seed);
    (0..count)
        .map(|_| {
            let map = map(0.1 + 2.9 * random.unit(), 0.95 * random.unit());
            (map, state(TAU * random.unit(), 3.0 * random.unit()))
        })
        .collect()
}

/// Random parameters not far beyond the birth of the period-1 orbit.
fn starts_near_orbits(count: usize, seed: u64) -> Vec<(ImpactMap, ImpactState)> {
    let mut random = SplitMix64::new(seed);
    (0..count)
        .map(|_| {
            let restitution = 0.2 + 0.7 * random.unit();
            let birth = (1.0 - restitution) / (1.0 + restitution);
            let map = map(birth + 0.4 * random.unit(), restitution);
            (map, state(TAU * random.unit(), 3.0 * random.unit()))
        })
        .collect()
}

#[test]
fn the_verdicts_of_known_attractors() {
    let start = state(1.2, 1.3);
    let verdict = of(map(0.45, 0.5), start);
    let Verdict::Periodic { impacts: 1, platform_periods: 1, state, rests: 0, .. } = verdict else {
        panic!("{verdict:?}")
    };
    let exact = map(0.45, 0.5).period_one(1).expect("exists");
    assert!((state.phase().angle() - exact.phase().angle()).abs() < 1e-13);
    assert!((state.velocity() - exact.velocity()).abs() < 1e-13);
    let verdict = of(map(0.5, 0.5), start);
    assert!(matches!(verdict, Verdict::Periodic { impacts: 2, platform_periods: 2, .. }), "{verdict:?}");
    let verdict = of(map(0.2, 0.5), start);
    assert!(matches!(verdict, Verdict::AtRest { after: 1.., .. }), "{verdict:?}");
    let verdict = of(map(0.55, 0.5), start);
    let Verdict::Chaotic { exponent, standard_error, impacts: 2_000, platform_periods, rests: 0 } = verdict
    else {
        panic!("{verdict:?}")
    };
    // Between 0.3 and 1.5 periods per impact.
    assert!((0.2..0.5).contains(&exponent) && (0.001..0.03).contains(&standard_error), "{verdict:?}");
    assert!((600..3_000).contains(&platform_periods), "{verdict:?}");
}

/// Chaotic orbits that return to within the tolerance after about 240 impacts: the neighbouring cycle repels
/// by 1e18, and the determinant of its monodromy matrix is pure rounding error.
#[test]
fn a_return_of_a_chaotic_orbit_is_no_periodic_orbit() {
    let start = ImpactState::from_normalised(0.4, 1.4).expect("legal");
    for axial_forcing in
        [0.5450607612456748, 0.545073014994233, 0.5450865051903114, 0.5450895778546713, 0.5451083460207613]
    {
        let verdict = map(axial_forcing, 0.5).verdict(start, VerdictSettings::default()).expect("no failure");
        assert!(matches!(verdict, Verdict::Chaotic { .. }), "{axial_forcing}: {verdict:?}");
    }
}

/// A disk that hardly leaves the platform is thrown and comes to rest once in each period.
#[test]
fn a_chattering_cycle_is_that_of_the_orbit_from_the_separation() {
    let map = map(0.4, 0.3);
    let verdict = of(map, state(3.0, 0.01));
    let Verdict::Chattering { cycle, after } = verdict else { panic!("{verdict:?}") };
    let mut orbit = map.orbit(state(3.0, 0.01), ChatterPolicy::Complete);
    let mut rounds = Vec::new();
    let mut impacts = 0;
    while rounds.len() < 2 {
        match orbit.advance().expect("no failure").expect("goes on") {
            OrbitEvent::Impact(_) => impacts += 1,
            _ => rounds.push(std::mem::take(&mut impacts)),
        }
    }
    assert_eq!((after, cycle.impacts, cycle.platform_periods), (rounds[0], rounds[1], 1), "{cycle:?}");
    assert!(cycle.is_exact() && cycle.rounding_error < 1e-12 && cycle.long_flights == 0, "{cycle:?}");
}

/// A periodic orbit in a verdict moves, attracts, and does not chatter to rest.
#[test]
fn periodic_verdicts_are_of_orbits_that_bounce_for_ever() {
    let mut starts = random_starts(1_000, 11);
    starts.extend(starts_near_orbits(500, 12));
    let verdicts = verdicts(&starts, short(), &Unobserved).expect("no failure");
    let mut seen = 0;
    for ((map, start), verdict) in starts.iter().zip(&verdicts) {
        let Verdict::Periodic { impacts, platform_periods, multipliers, state, rests, .. } = *verdict else {
            continue;
        };
        seen += 1;
        assert!(platform_periods >= 1 && state.velocity() < 0.0 && multipliers.spectral_radius() < 1.0);
        let settings = BasinSettings::default();
        assert_ne!(map.basin_label(state, &[], settings), Ok(ATTACHED), "{map:?} {verdict:?}");
        let label = map.basin_label(*start, &[], settings).expect("no failure");
        assert_eq!(label == ATTACHED, rests == 1, "{map:?} {start:?} {verdict:?}");
        // One round by single steps, and not earlier.
        let mut at = state;
        for step in 1..=impacts {
            at = map.step(at).expect("flies").into();
            let returned = crate::orbits::periodic::distance(at, state, 1.0 + state.velocity().abs()) < 1e-6;
            assert_eq!(returned, step == impacts, "{map:?} {verdict:?}: {step}");
        }
    }
    assert!(seen > 50, "{seen}");
}

/// The search of `settled_orbit` shares only Newton's iteration with the search of the verdict.
#[test]
fn periodic_verdicts_are_those_of_settled_orbits() {
    let starts = starts_near_orbits(400, 5);
    let verdicts = verdicts(&starts, short(), &Unobserved).expect("no failure");
    let (mut periodic, mut missed) = (0, 0);
    for ((map, start), verdict) in starts.iter().zip(&verdicts) {
        let settled = map.settled_orbit(*start, 20_000, 256, 1e-8, &Unobserved).ok().flatten();
        let settled = settled.filter(|orbit| orbit.multipliers().spectral_radius() < 1.0);
        match (settled, verdict) {
            (Some(orbit), Verdict::Periodic { impacts, platform_periods, .. }) => {
                assert_eq!((orbit.period() as u64, orbit.platform_periods), (*impacts, *platform_periods));
                periodic += 1;
            }
            // A transient longer than the impacts allowed.
            (Some(_), _) => missed += 1,
            // An orbit after a rest, or one approached too slowly for a comparison of states.
            (None, Verdict::Periodic { rests, multipliers, .. }) => {
                assert!(*rests == 1 || multipliers.spectral_radius() > 0.999, "{map} {start} {verdict:?}");
            }
            (None, _) => (),
        }
    }
    assert!(periodic > 30 && missed <= periodic / 20, "{periodic} found, {missed} missed");
}

/// An exact cycle keeps its impacts when its first one is moved by a few roundings; a cycle chosen by
/// rounding does not.
#[test]
fn exact_cycles_do_not_hang_on_rounding() {
    let starts = random_starts(1_000, 3);
    let verdicts = verdicts(&starts, short(), &Unobserved).expect("no failure");
    let impacts_to_rest = |map: &ImpactMap, state| {
        let mut orbit = map.orbit(state, ChatterPolicy::Complete);
        let mut impacts = 1;
        while let Ok(Some(OrbitEvent::Impact(_))) = orbit.advance() {
            impacts += 1;
            if impacts > 20_000 {
                break;
            }
        }
        impacts
    };
    let (mut exact, mut chosen, mut moved) = (0, 0, 0);
    for ((map, _), verdict) in starts.iter().zip(&verdicts) {
        let Verdict::Chattering { cycle, .. } = verdict else { continue };
        let launch = map.vibration().separation_phase().expect("falls away");
        let separated = ImpactState::new(launch, 0.0).expect("legal");
        let first: ImpactState = map.step(separated).expect("leaves").into();
        assert_eq!(impacts_to_rest(map, first), cycle.impacts, "{map:?} {verdict:?}");
        let changed = [-3.0, -1.0, 1.0, 3.0].into_iter().any(|roundings| {
            let angle = first.phase().angle() * (1.0 + roundings * f64::EPSILON);
            let near = ImpactState::new(Phase::new(angle).expect("finite"), first.velocity()).expect("legal");
            impacts_to_rest(map, near).abs_diff(cycle.impacts) > 1
        });
        if cycle.is_exact() {
            exact += 1;
            assert!(!changed, "{map:?} {verdict:?}");
        } else {
            chosen += 1;
            moved += u32::from(changed);
            let CycleTrust::ChosenByRounding { exponent, .. } = cycle.trust else { panic!("not exact") };
            assert!(exponent.is_none_or(f64::is_finite));
        }
    }
    assert!(
        exact > 200 && chosen > 10 && moved >= chosen * 3 / 4,
        "{exact} exact, {chosen} chosen, {moved} moved"
    );
}

#[test]
fn verdicts_in_lockstep_are_those_of_single_orbits() {
    let starts = random_starts(300, 17);
    let settings = VerdictSettings { transient: 200, impacts: 500, ..VerdictSettings::default() };
    let together = verdicts(&starts, settings, &Unobserved).expect("no failure");
    for ((map, start), verdict) in starts.iter().zip(&together) {
        assert_eq!(map.verdict(*start, settings), Ok(*verdict), "{map:?} {start:?}");
    }
}

/// The verdicts arrive in order wherever the call is stopped; those received before the stop remain.
#[test]
fn a_call_of_many_blocks_can_be_stopped_and_keeps_no_verdict() {
    const TOGETHER: usize = <ImpactMap as BouncingMap>::TOGETHER;
    let count = 3 * TOGETHER + 100;
    let start = |index: usize| {
        let forcing = 0.05 + 0.2 * (index % 97) as f64 / 97.0;
        Ok::<_, Error>((!index.is_multiple_of(5)).then(|| (map(forcing, 0.3), state(1.2, 1.3))))
    };
    let (mut seen, mut rests) = (0, 0);
    let each = |verdict: Option<Verdict>| {
        assert_eq!(verdict.is_some(), seen % 5 > 0);
        rests += usize::from(matches!(verdict, Some(Verdict::AtRest { .. })));
        seen += 1;
    };
    each_verdict(count, start, short(), &Unobserved, each).expect("no failure");
    assert_eq!((seen, rests), (count, count - count.div_ceil(5)));
    let mut seen = 0;
    // At least two calls in each block.
    let stopped = each_verdict(count, start, short(), &StopAfter::calls(5), |_| seen += 1);
    let Err(Error::Stopped { done, total }) = stopped else { panic!("{stopped:?}") };
    assert!(seen % TOGETHER == 0 && seen <= 2 * TOGETHER && total == count as u64, "{seen} {total}");
    assert!((seen as u64..count as u64).contains(&done), "{done}");
    assert_eq!(verdicts::<ImpactMap>(&[], short(), &Unobserved), Ok(Vec::new()));
}

fn long(map: ImpactMap, start: ImpactState) -> Verdict {
    map.verdict(start, VerdictSettings::default()).expect("no failure")
}

/// The orbit of a fold has the multipliers 1 and r^2, the orbit of a doubling -1 and -r^2: a start on such an
/// orbit stays on it.
#[test]
fn the_orbit_of_a_fold_or_a_doubling_is_neutral() {
    for (forcing, restitution, sign) in [
        (0.3333333333333333, 0.5, 1.0),
        (0.25, 0.6, 1.0),
        (ImpactMap::first_doubling_forcing(0.5), 0.5, -1.0),
        (ImpactMap::first_doubling_forcing(0.8), 0.8, -1.0),
    ] {
        let map = map(forcing, restitution);
        let on_it = map.period_one(1).expect("exists");
        let near =
            ImpactState::new(Phase::new(on_it.phase().angle() + 1e-2).expect("legal"), on_it.velocity());
        for start in [on_it, near.expect("legal")] {
            let verdict = long(map, start);
            let Verdict::Undecided {
                reason:
                    UndecidedReason::OnPeriodicOrbit {
                        impacts: 1,
                        platform_periods: 1,
                        multipliers: Multipliers::Real(large, small),
                        multiplier_error,
                        ..
                    },
                ..
            } = verdict
            else {
                panic!("{forcing}: {verdict:?}")
            };
            assert!(multiplier_error < 1e-5 && (large - sign).abs() <= multiplier_error, "{verdict:?}");
            assert!((small - sign * restitution * restitution).abs() <= multiplier_error, "{verdict:?}");
        }
    }
}

/// Neither the passage by a fold nor a slow transient is chaos: both of these orbits rest in the end.
#[test]
fn a_slow_passage_is_no_chaos() {
    let restitution = 0.99999;
    for (forcing, restitution, start) in [
        (1.0 / 3.0 - 1e-11, 0.5, state(0.0, 4.0 / 3.0)),
        (2e-6, restitution, state(3.4704123348204092, 0.6527356454259051)),
    ] {
        let verdict = long(map(forcing, restitution), start);
        let near_zero = |reason| matches!(reason, UndecidedReason::ExponentNearZero { .. });
        assert!(matches!(verdict, Verdict::Undecided { reason, .. } if near_zero(reason)), "{verdict:?}");
    }
    let orbit = [(map(1.0 / 3.0, 0.5), map(1.0 / 3.0, 0.5).period_one(1).expect("exists"))];
    let spectrum = lyapunov_spectra(&orbit, 1_000, 10_000, &Unobserved).expect("no failure")[0];
    let spectrum = spectrum.spectrum().expect("bounces on");
    assert!(spectrum.largest.abs() <= spectrum.standard_error, "{spectrum:?}");
}

/// Rounding may hold the disk on an orbit that repels, and chaos may be a transient if there is hardly any
/// dissipation.
#[test]
fn what_repels_or_may_end_is_no_chaos() {
    for distance in [1e-8, 1e-6, 1e-5, 3e-5, 1e-4, 1e-3] {
        let map = map(ImpactMap::first_doubling_forcing(0.5) + distance, 0.5);
        let orbit = map.refine(&[map.period_one(1).expect("exists")]).expect("an orbit");
        let verdict = long(map, orbit.states[0]);
        let held = matches!(
            verdict,
            Verdict::Undecided {
                reason: UndecidedReason::OnPeriodicOrbit { impacts: 1, multipliers, .. },
                ..
            } if multipliers.spectral_radius() > 1.0
        );
        assert!(held || matches!(verdict, Verdict::Periodic { impacts: 2, .. }), "{distance:e}: {verdict:?}");
    }
    let reason = |verdict| match verdict {
        Verdict::Undecided { reason: UndecidedReason::TransientMayLast { needed, .. }, .. } => Some(needed),
        _ => None,
    };
    let needed = reason(of(map(0.5, 0.9999), state(1.2, 1.3))).expect("grows");
    assert!((needed - 5e4).abs() < 10.0, "{needed}");
    assert_eq!(reason(of(map(0.5, 0.99), state(1.2, 1.3))), None);
}

/// The exponent equals the one computed without a verdict, for a chaotic orbit that has not come to rest.
#[test]
fn the_exponent_of_chaos_is_that_of_the_spectrum() {
    let start = (map(0.55, 0.5), state(1.2, 1.3));
    let Verdict::Chaotic { exponent, standard_error, .. } = of(start.0, start.1) else { panic!("chaos") };
    let outcome = lyapunov_spectra(&[start], 1_000, 2_000, &Unobserved).expect("no failure")[0];
    let spectrum = outcome.spectrum().expect("bounces on");
    assert_eq!(
        (exponent.to_bits(), standard_error.to_bits()),
        (spectrum.largest.to_bits(), spectrum.standard_error.to_bits())
    );
}

/// Near the doubling the orbit is approached too slowly to return within the tolerance.
#[test]
fn next_to_a_doubling_the_period_is_the_right_one_or_none() {
    let forcing = ImpactMap::first_doubling_forcing(0.5);
    for (distance, expected) in [
        (-1e-3, Some(1)),
        (-1e-6, Some(1)),
        (-1e-9, Some(1)),
        (1e-9, Some(2)),
        (1e-6, Some(2)),
        (1e-3, Some(2)),
    ] {
        let verdict = of(map(forcing + distance, 0.5), state(1.2, 1.3));
        match verdict {
            Verdict::Periodic { impacts, .. } => {
                assert_eq!(Some(impacts), expected, "{distance:e}: {verdict:?}")
            }
            Verdict::Undecided {
                reason:
                    UndecidedReason::ExponentNearZero { exponent, .. }
                    | UndecidedReason::NoPeriodFound { exponent, .. },
                ..
            } => {
                assert!(distance.abs() < 1e-5 && exponent.abs() < 1e-2, "{distance:e}: {verdict:?}");
            }
            other => panic!("{distance:e}: {other:?}"),
        }
    }
}

/// Starts and parameters at the ends of their ranges.
#[test]
fn seams_have_verdicts() {
    let still = of(map(0.0, 0.5), state(1.0, 1.0));
    assert!(matches!(still, Verdict::AtRest { .. }), "{still:?}");
    for speed in [0.0, f64::from_bits(1), 1e-300, 1e-9] {
        for angle in [0.0, 1.0, PI, TAU.next_down(), TAU] {
            for restitution in [0.0, 1e-300, 0.5, 0.99, 1.0_f64.next_down()] {
                // Just above and below the forcing at which the platform falls away.
                for forcing in [0.25, 1.0 / PI + 1e-12, 0.4, 1.5] {
                    let map = map(forcing, restitution);
                    let start = state(angle, speed);
                    let settings = VerdictSettings { transient: 0, impacts: 64, ..short() };
                    let verdict = map.verdict(start, settings);
                    let verdict = verdict.unwrap_or_else(|error| panic!("{map:?} {start:?}: {error}"));
                    assert_eq!(stored(&verdict), verdict);
                    if forcing < 0.3 && restitution <= 0.5 {
                        assert!(matches!(verdict, Verdict::AtRest { .. }), "{map:?} {start:?}: {verdict:?}");
                    }
                }
            }
        }
    }
    // On an orbit, to the last bit.
    let exact = map(0.45, 0.5).period_one(1).expect("exists");
    let verdict = of(map(0.45, 0.5), exact);
    assert!(
        matches!(verdict, Verdict::Periodic { impacts: 1, distance, .. } if distance < 1e-14),
        "{verdict:?}"
    );
    // On a saddle: it repeats itself, and does not attract.
    let saddle = ImpactState::new(Phase::new(-exact.phase().angle()).expect("legal"), exact.velocity());
    let verdict = of(map(0.45, 0.5), saddle.expect("legal"));
    let near_saddle = matches!(verdict, Verdict::Periodic { state, .. } if state.phase().angle() > PI);
    assert!(!near_saddle, "{verdict:?}");
    // Faster than any allowed flight.
    let fast = map(0.45, 0.5).verdict(state(1.0, 1e50), short());
    assert!(matches!(fast, Err(Error::FlightTooLong { .. })), "{fast:?}");
}

/// Without restitution the orbit is a sequence of rests, or determined by the phase alone.
#[test]
fn without_restitution_every_start_has_a_verdict() {
    let starts: Vec<_> = (0..600).map(|k| (map(0.32 + 0.005 * f64::from(k), 0.0), state(1.2, 1.3))).collect();
    let verdicts = verdicts(&starts, short(), &Unobserved).expect("no failure");
    let exact = verdicts
        .iter()
        .filter(|verdict| matches!(verdict, Verdict::Chattering { cycle, .. } if cycle.is_exact()));
    assert!(exact.count() > 300);
}

#[test]
fn the_longest_settings_are_legal() {
    let longest = VerdictSettings { transient: u64::MAX, longest_period: 4_096, tolerance: 0.01, ..short() };
    assert_eq!(longest.check(), Ok(()));
    assert_eq!(stored(&longest), longest);
}

#[cfg(feature = "serde")]
#[test]
fn a_verdict_that_is_read_is_legal() {
    let refused = |verdict: &Verdict, from: &str, to: &str, complaint: &str| {
        let text = serde_json::to_string(verdict).expect("writes");
        assert!(text.contains(from), "{text}");
        let error = serde_json::from_str::<Verdict>(&text.replace(from, to)).expect_err(to).to_string();
        assert!(error.contains(complaint), "{error}");
    };
    let orbit = of(map(0.45, 0.5), state(1.2, 1.3));
    refused(&orbit, "\"platform_periods\":1", "\"platform_periods\":0", "platform periods");
    refused(&orbit, "\"impacts\":1", "\"impacts\":0", "impacts of a period");
    refused(&orbit, "\"rests\":0", "\"rests\":2", "rests");
    refused(&orbit, "\"rests\":0", "\"rest\":0", "rest");
    let chaos = of(map(0.55, 0.5), state(1.2, 1.3));
    refused(&chaos, "\"exponent\":0", "\"exponent\":-0", "exponent of chaos");
    let rest = of(map(0.4, 0.3), state(3.0, 0.01));
    refused(&rest, "\"long_flights\":0", "\"long_flights\":1000", "long flights");
    refused(&rest, "\"Exact\"", "\"Exactly\"", "Exactly");
}

#[test]
fn verdicts_are_printed_in_words() {
    let text = |forcing, restitution, start| format!("{:.2}", of(map(forcing, restitution), start));
    let orbit = text(0.45, 0.5, state(1.2, 1.3));
    assert!(orbit.starts_with("1 impact in 1 period of the platform, multipliers "), "{orbit}");
    assert!(text(0.55, 0.5, state(1.2, 1.3)).starts_with("chaos, exponent 0."));
    assert!(text(0.2, 0.5, state(1.2, 1.3)).starts_with("at rest from "));
    assert!(text(0.4, 0.3, state(3.0, 0.01)).ends_with("every 1 period of the platform"));
}
