use crate::run::Unobserved;
use core::f64::consts::PI;

use super::*;
use crate::attractors::basin::{ATTACHED, Axis, BasinSettings, Basins, FIRST_ORBIT, Grid, UNDECIDED};
use crate::chatter::policy::PAPER_POLICY;
use crate::map::impact_map::map;
use crate::numerics::testing::stored;
use crate::orbits::periodic::catalogue::OrbitSearch;
use crate::sweep::bouncing_map::BouncingMap as _;

/// A quick search.
fn quick(starts: u32) -> AttractorSearch {
    let search = AttractorSearch::default().with_starts(starts).expect("legal");
    search.with_impacts(1_000, 20_000).expect("legal").with_orbits(None)
}

fn found(axial_forcing: f64, restitution: f64, starts: u32) -> Attractors {
    map(axial_forcing, restitution).attractors(&quick(starts), &Unobserved).expect("no failure")
}

fn periods(found: &Attractors) -> Vec<(usize, u64)> {
    found.known().map(|known| (known.orbit().period(), known.orbit().platform_periods)).collect()
}

#[test]
fn the_attractors_along_the_paper_s_route() {
    // Below 1/pi the platform never falls away, and below 1/3 rest is the only motion.
    let weak = found(0.2, 0.5, 300);
    assert_eq!(weak.all().len(), 1);
    assert!(matches!(weak.all()[0].kind, AttractorKind::Rest(AfterRest::StaysForEver)));
    assert_eq!((weak.all()[0].starts.count(), weak.undecided().count()), (300, 0));
    for (forcing, expected) in [(0.45, vec![(1, 1)]), (0.486, vec![(1, 1), (4, 2)]), (0.5, vec![(2, 2)])] {
        let own = stored(&found(forcing, 0.5, 1_000));
        assert_eq!(periods(&own), expected, "Gamma {forcing}");
        assert_eq!(own.all().len(), 1 + expected.len(), "Gamma {forcing}");
        assert_eq!(own.undecided().count(), 0);
        assert!(own.all().iter().all(|one| one.starts.count() > 0), "Gamma {forcing}: {own:?}");
        assert!(own.known().all(|known| known.radius() > 1e-6), "Gamma {forcing}");
    }
    let chaotic = stored(&found(0.55, 0.5, 300));
    let [rest, chaos] = chaotic.all() else { panic!("{chaotic:?}") };
    assert!(matches!(rest.kind, AttractorKind::Rest(AfterRest::RestsAgain(_))));
    let AttractorKind::Chaotic { exponent, standard_error, recurrence } = &chaos.kind else {
        panic!("{chaos:?}")
    };
    assert!(*exponent > 0.05 && *standard_error < 0.1 * exponent, "{exponent} {standard_error}");
    assert!(recurrence.cells.contains(recurrence.state));
    // None of the orbits followed near it has left.
    assert_eq!((recurrence.impacts, recurrence.orbits), (21_000, 1_024));
    assert!(chaos.starts.count() > 30 && rest.starts.count() > 30);
    let gone = found(0.6, 0.5, 300);
    assert_eq!((gone.all().len(), gone.all()[0].starts.count()), (1, 300));
}

/// Just above the first doubling two impacts attract, just below one does, and at the fold one orbit is
/// semi-stable.
#[test]
fn marginal_orbits_are_neither_multiplied_nor_invented() {
    let first = ImpactMap::first_doubling_forcing(0.5);
    for (offset, expected) in [(1e-11, (2, 2)), (1e-12, (2, 2)), (-1e-12, (1, 1)), (-1e-10, (1, 1))] {
        let own = found(first + offset, 0.5, 200);
        let sheared = usize::from(periods(&own).contains(&(4, 2)));
        assert_eq!(periods(&own)[0], expected, "{offset:e}");
        assert_eq!(own.all().len(), 2 + sheared, "{offset:e}: {:?}", periods(&own));
        assert_eq!(own.undecided().count(), 0, "{offset:e}");
    }
    let own = stored(&found(1.0 / 3.0, 0.5, 200));
    let [rest, fold] = own.all() else { panic!("{own:?}") };
    assert!(matches!(&fold.kind, AttractorKind::Marginal(orbit) if orbit.period() == 1), "{fold:?}");
    assert!(fold.starts.count() > 0 && rest.starts.count() + fold.starts.count() == 200, "{own:?}");
    assert_eq!(fold.kind.to_string(), "marginal periodic orbit: impacts 1, platform periods 1");
}

/// A cycle of rests states whether its numbers hold in exact arithmetic.
#[test]
fn a_cycle_that_rounding_chose_is_not_named() {
    let own = found(0.9, 0.8, 20);
    let cycle = own.all()[0].kind.rest_cycle().expect("rests again");
    assert!(!cycle.is_exact(), "{cycle}");
    assert!(!own.all()[0].kind.to_string().contains(&cycle.platform_periods.to_string()));
    let exact = found(0.55, 0.5, 20);
    let cycle = exact.all()[0].kind.rest_cycle().expect("rests again");
    assert_eq!(cycle.is_exact(), exact.all()[0].kind.to_string().contains("platform periods"));
}

/// A window up to the speed 6 missed this orbit at 8.9.
#[test]
fn a_fast_orbit_is_found_with_its_share_of_the_region() {
    let own = found(0.9, 0.8, 1_000);
    let eight = own.all().iter().find(|one| match &one.kind {
        AttractorKind::Periodic(known) => known.orbit().period() == 1 && known.orbit().platform_periods == 8,
        _ => false,
    });
    let eight = eight.expect("attracts");
    let AttractorKind::Periodic(known) = &eight.kind else { panic!("{eight:?}") };
    assert!((known.orbit().states[0].normalised_speed() - 16.0 / 1.8).abs() < 1e-12);
    let (low, high) = eight.starts.interval();
    assert!(low < eight.starts.value() && eight.starts.value() < high);
}

/// Candidates need no starts, and none are counted for them.
#[test]
fn without_starts_there_are_the_candidates() {
    let nodes = found(0.9, 0.8, 0);
    let longest: Vec<_> = periods(&nodes).iter().map(|own| own.1).collect();
    // By the closed form: 0 < P sin tau < 2 (1 + r^2)/(1 + r)^2.
    let stable = |k: &u64| {
        let cosine = *k as f64 * 0.2 / (1.8 * 0.9);
        cosine <= 1.0 && 0.9 * PI * (1.0 - cosine * cosine).sqrt() < 2.0 * 1.64 / 3.24
    };
    assert_eq!(longest, (1..20).filter(stable).collect::<Vec<_>>());
    assert!(nodes.all().iter().all(|own| own.starts.of() == 0 && own.starts.interval() == (0.0, 1.0)));
    let search = quick(0).with_orbits(OrbitSearch::new(2, 2).ok());
    let two = map(0.5, 0.5).attractors(&search, &Unobserved).expect("no failure");
    assert_eq!(periods(&two), [(2, 2)]);
}

#[test]
fn the_ends_of_the_parameters_have_their_attractors() {
    for restitution in [0.0, 1e-300, 0.3, 0.9] {
        for forcing in [0.0, 1e-300, 1e-9, 1.0 / PI] {
            let own = found(forcing, restitution, 50);
            assert!(own.undecided().count() == 0, "{forcing} {restitution}");
            let born = (1.0 - restitution) / (1.0 + restitution);
            assert!(forcing > born || own.all()[0].starts.count() == 50, "{forcing} {restitution}");
            assert!(matches!(own.all()[0].kind, AttractorKind::Rest(AfterRest::StaysForEver)));
        }
    }
    // Without restitution there is only one motion apart from rest: the orbit from the separation.
    let plastic = found(1.05, 0.0, 200);
    assert!(plastic.undecided().count() == 0, "{plastic:?}");
    // Strong forcing: all starts rest, after rounds of hundreds of periods chosen by rounding.
    let strong = found(20.0, 0.5, 100);
    assert_eq!((strong.all()[0].starts.count(), strong.undecided().count()), (100, 0), "{strong:?}");
    // Little dissipation: chaos.
    let elastic = found(2.0, 0.9, 50);
    assert!(elastic.all().iter().any(|own| own.kind.recurrence().is_some()), "{elastic:?}");
    assert_eq!(elastic.undecided().count(), 0);
}

/// All aperiodic motions found.
fn aperiodic(found: &Attractors) -> Vec<&Attractor> {
    found.all().iter().filter(|one| one.kind.recurrence().is_some()).collect()
}

/// The share of the starts that are at rest after `impacts` impacts, by following each of them.
fn at_rest_after(map: &ImpactMap, impacts: u64) -> Fraction {
    let impacts = impacts as usize;
    let orbits: Vec<_> = super::starts::starts(map, 300)
        .into_iter()
        .map(|start| map.orbit(start, crate::ChatterPolicy::Complete))
        .collect();
    let lives = crate::sweep::survival_times(&orbits, impacts, &Unobserved).expect("no failure");
    Fraction::new(lives.iter().filter(|life| **life < impacts).count() as u64, 300).expect("a share")
}

/// Orbits leave these motions after about 10,000 to 100,000 impacts. Each was once reported as an attractor,
/// with a share of up to 0.99, because one orbit had stayed for 100,000.
#[test]
fn transients_have_a_mean_life_and_do_not_last() {
    let search = AttractorSearch::default().with_orbits(None).with_starts(300).expect("legal");
    for (forcing, restitution) in [(0.841_76, 0.867_75), (0.85, 0.8)] {
        let found = stored(&map(forcing, restitution).attractors(&search, &Unobserved).expect("no failure"));
        let [transient] = aperiodic(&found)[..] else { panic!("{forcing} {restitution}: {found:?}") };
        let AttractorKind::Transient { exponent, lifetime, recurrence, .. } = &transient.kind else {
            panic!("{forcing} {restitution}: {}", transient.kind)
        };
        assert!(*exponent > 1.0 && !transient.kind.lasts() && recurrence.impacts == 102_000);
        assert!(transient.kind.to_string().starts_with("chaotic transient: exponent 1."));
        // The lost starts agree with the mean lifetime of orbits that began on it: at most as many starts
        // remain as an exponential law leaves.
        let (shortest, longest) = lifetime.interval();
        let stay = |life: f64| crate::numerics::elementary::exp(-102_000.0 / life);
        let (low, high) = transient.starts.interval();
        assert!(low <= stay(longest) && high >= 0.5 * stay(shortest), "{forcing}: {low} {high} {lifetime}");
        // The share at rest agrees with following every start by itself.
        let (low, high) = at_rest_after(found.map(), 102_000).interval();
        let rest = found.all()[0].starts.value();
        assert!(low <= rest && rest <= high, "{forcing} {restitution}: {low} {rest} {high}");
    }
}

/// With little dissipation most starts look chaotic, but end on orbits of three impacts or at rest: all of 24
/// starts within a million impacts.
#[test]
fn a_transient_may_end_on_orbits() {
    let map = map(0.459_018_560_304_461_86, 0.965_275_735_361_566);
    let search = AttractorSearch::default().with_starts(300).expect("legal");
    let found = map.attractors(&search, &Unobserved).expect("no failure");
    let [transient] = aperiodic(&found)[..] else { panic!("{found:?}") };
    let AttractorKind::Transient { lifetime, .. } = &transient.kind else { panic!("{}", transient.kind) };
    let (shortest, longest) = lifetime.interval();
    assert!(shortest > 1.0e5 && longest < 1.0e6, "{lifetime}");
    let three = |periods| {
        let own = found.all().iter().filter_map(|one| Some((one.kind.orbit()?, one.starts)));
        own.filter(|(orbit, _)| orbit.period() == 3 && orbit.platform_periods == periods)
            .map(|(_, starts)| starts.count())
            .sum::<u64>()
    };
    assert!(three(3) > 10 && three(24) > 2, "{found:?}");
}

/// Just below a fold, orbits creep past the place of the future orbits for up to a few million impacts: this
/// is not an attractor.
#[test]
fn slow_passages_are_undecided() {
    let search = AttractorSearch::default().with_orbits(None);
    for below in [1e-8, 1e-10, 1e-12] {
        let map = map((1.0 - below) / 3.0, 0.5);
        let found = map.attractors(&search, &Unobserved).expect("no failure");
        assert_eq!(found.all().len(), 1, "{below:e}: {found:?}");
        // A passage takes about 1e5 impacts at 1e-10, ten times as many at 1e-12.
        assert_eq!(found.undecided().count() > 0, below < 1e-9, "{below:e}: {found:?}");
    }
}

/// A small budget leaves starts undecided. The starts of a transient are counted after its stated number of
/// impacts, however few the budget allows.
#[test]
fn a_budget_bounds_the_search() {
    let search = AttractorSearch::default().with_orbits(None).with_starts(300).expect("legal");
    let chaotic = map(0.55, 0.5);
    let poor = search.with_budget(256 * 300).expect("legal");
    let poor = chaotic.attractors(&poor, &Unobserved).expect("no failure");
    assert!(poor.undecided().count() > 30 && aperiodic(&poor).is_empty(), "{poor:?}");
    let leaving = map(0.841_76, 0.867_75);
    let mut counted = Vec::new();
    for budget in [1 << 24, 1 << 26] {
        let search = search.with_budget(budget).expect("legal");
        let found = leaving.attractors(&search, &Unobserved).expect("no failure");
        let [transient] = aperiodic(&found)[..] else { panic!("{found:?}") };
        let impacts = transient.kind.recurrence().expect("aperiodic").impacts;
        let (low, high) = at_rest_after(&leaving, impacts).interval();
        let rest = found.all()[0].starts.value();
        assert!(low <= rest && rest <= high, "{impacts}: {low} {rest} {high}");
        assert!(!transient.kind.lasts() && 300 * impacts < budget);
        counted.push(impacts);
    }
    assert!(counted[0] < 40_000 && counted[1] > 80_000, "{counted:?}");
    for wrong in [0, 256 * 300 - 1, 1 << 51] {
        let refused = search.with_budget(wrong);
        assert!(matches!(refused, Err(Error::OutOfRange { field: "budget", .. })), "{wrong}");
    }
}

/// Settings at the ends of their ranges lose no start, and cells too fine to be visited twice lead to no
/// claim.
#[test]
fn extreme_settings_are_honest() {
    let search = AttractorSearch::default().with_orbits(None).with_starts(40).expect("legal");
    for (transient, impacts) in [(1, 64), (1, 4_000), (4_000, 64), (1 << 40, 64), (1, 1 << 40)] {
        let search = search.with_impacts(transient, impacts).and_then(|own| own.with_budget(1 << 19));
        let found = map(0.55, 0.5).attractors(&search.expect("legal"), &Unobserved).expect("no failure");
        let all: u64 = found.all().iter().map(|one| one.starts.count()).sum();
        assert_eq!(all + found.undecided().count(), 40, "{transient} {impacts}: {found:?}");
    }
    let (coarse, fine) = (search.with_cells(64).expect("legal"), search.with_cells(4_096).expect("legal"));
    let map = map(3.0, 0.99);
    let chaos = map.attractors(&coarse, &Unobserved).expect("no failure");
    let [one] = aperiodic(&chaos)[..] else { panic!("{chaos:?}") };
    assert_eq!((one.kind.name(), one.starts.count()), ("chaotic", 40), "{chaos:?}");
    let unknown = map.attractors(&fine, &Unobserved).expect("no failure");
    assert!(aperiodic(&unknown).is_empty() && unknown.undecided().count() == 40, "{unknown:?}");
}

/// At restitution 0.99 dissipation ends a transient within about 500 impacts. Orbits that stay for 401
/// impacts prove nothing; orbits that stay for 2,001 do.
#[test]
fn a_motion_that_dissipation_has_not_acted_on_is_no_attractor() {
    let search = AttractorSearch::default().with_orbits(None).with_starts(40).expect("legal");
    let (map, search) = (map(3.0, 0.99), search.with_cells(8).expect("legal"));
    for (impacts, name) in [(400, "transient"), (2_000, "chaotic")] {
        assert_eq!(map.transient_impacts() > 1.0 + impacts as f64, name == "transient");
        let search = search.with_impacts(1, impacts).expect("legal");
        let found = map.attractors(&search, &Unobserved).expect("no failure");
        let [one] = aperiodic(&found)[..] else { panic!("{found:?}") };
        assert_eq!((one.kind.name(), one.kind.lasts()), (name, name == "chaotic"), "{}", one.kind);
        if let AttractorKind::Transient { lifetime, .. } = &one.kind {
            assert_eq!(lifetime.left(), 0, "{lifetime}");
        }
    }
}

/// A disk that comes to rest may never do so again.
#[test]
fn a_rest_that_leads_elsewhere_says_where() {
    // The published statement that the disk always rests again fails here (data/literature/README.md).
    let own = stored(&found(0.51, 0.5, 200));
    let leading = match own.all()[0].kind {
        AttractorKind::Rest(AfterRest::LeadsTo(number)) => Some((number, own)),
        _ => None,
    };
    let (number, own) = leading.expect("leads elsewhere");
    let target = &own.all()[number];
    assert!(!own.all()[0].kind.lasts() && target.kind.lasts());
    assert_eq!(own.lasting().count(), own.all().len() - 1);
    // The orbit from rest ends on this attractor.
    let vibration = own.map().vibration();
    let leaves = vibration.separation_phase().expect("P > 1");
    let launch = crate::Launch::new(leaves, 0.0).expect("legal");
    let mut orbit = own.map().orbit_from_launch(launch, crate::ChatterPolicy::Complete);
    let mut last = None;
    for _ in 0..20_000 {
        match orbit.advance().expect("no failure") {
            Some(crate::OrbitEvent::Impact(impact)) => last = Some(ImpactState::from(impact)),
            other => panic!("it rests: {other:?}"),
        }
    }
    let last = last.expect("impacts");
    match &target.kind {
        AttractorKind::Periodic(known) => {
            assert!(known.orbit().distance(last, vibration.peak_acceleration()) < 1e-6);
        }
        kind => assert!(kind.recurrence().is_some_and(|own| own.cells.contains(last)), "{last}"),
    }
}

#[test]
fn labels_are_the_same_in_every_window_and_for_one_start() {
    for (forcing, max_impacts) in [(0.486, 4_000), (0.55, 400)] {
        let own = found(forcing, 0.5, 500);
        let settings = BasinSettings { max_impacts, ..BasinSettings::default() };
        let grid = |low, high, cells| {
            Grid::new(Axis::new(0.0, 1.0, 25).expect("legal"), Axis::new(low, high, cells).expect("legal"))
                .expect("legal")
        };
        let wide = own.basins(grid(0.0, 4.0, 32), settings, &Unobserved).expect("no failure");
        let narrow = own.basins(grid(1.0, 3.0, 16), settings, &Unobserved).expect("no failure");
        assert_eq!(&wide.labels()[8 * 25..24 * 25], narrow.labels());
        for number in 0..own.all().len() {
            let label = own.label(number).expect("exists");
            assert!(wide.share(label).count() > 0, "Gamma {forcing}: {number}");
            assert_eq!(own.labelled(label), Some(&own.all()[number]));
        }
        assert_eq!(wide.share(UNDECIDED).count(), 0);
        let starts = grid(0.0, 4.0, 32);
        for (index, label) in wide.labels().iter().enumerate().step_by(7) {
            let (row, column) = (index / 25, index % 25);
            let start = ImpactState::from_normalised(starts.impact_angle(column), starts.speed().centre(row));
            assert_eq!(own.basin_label(start.expect("legal"), settings), Ok(*label), "{row} {column}");
        }
    }
    let own = found(0.45, 0.5, 50);
    assert_eq!((own.label(0), own.label(1), own.label(2)), (Some(ATTACHED), Some(FIRST_ORBIT), None));
    assert_eq!((own.labelled(UNDECIDED), own.labelled(255)), (None, None));
}

/// Labels of single starts agree with the basins of known orbits, for every policy and number of impacts.
#[test]
fn labels_of_starts_are_those_of_known_orbits() {
    let own = found(0.486, 0.5, 500);
    let known: Vec<_> = own.known().cloned().collect();
    for policy in [crate::ChatterPolicy::Complete, PAPER_POLICY] {
        for max_impacts in [0, 1, 2, 7, 3_000] {
            let settings = BasinSettings { max_impacts, policy };
            for k in 0..400 {
                let (turn, speed) = (
                    crate::numerics::testing::golden_spread(k),
                    3.0 * crate::numerics::testing::golden_spread(7 * k),
                );
                let start = ImpactState::from_normalised(2.0 * PI * turn, speed).expect("legal");
                let expected = own.map().basin_label(start, &known, settings);
                assert_eq!(own.basin_label(start, settings), expected, "{start}, {settings:?}");
            }
        }
    }
}

fn basin_fractions(forcings: &[f64], observer: &dyn Observer) -> Result<over_forcing::BasinFractions, Error> {
    over_forcing::basin_fractions_over(0.5, forcings, &quick(200), 0.3, observer)
}

/// Period 1 from 1/3 on, its doubling to period 2, under the same number, and the orbit of four impacts from
/// 0.4841 to 0.4883 (docs/errata.md).
#[test]
fn attractors_are_followed_over_the_forcing() {
    let forcings = [0.32, 0.35, 0.40, 0.45, 0.48, 0.486, 0.487, 0.50, 0.52];
    let over = stored(&basin_fractions(&forcings, &Unobserved).expect("no failure"));
    let ends: Vec<_> = over.followed.iter().map(|own| (own.appears, own.vanishes)).collect();
    assert_eq!(ends[..2], [(0, 8), (1, 8)], "{ends:?}");
    assert_eq!(ends[2..], [(4, 6)], "{ends:?}");
    let periods: Vec<_> = over
        .over(1)
        .map(|(_, own)| match own.map(|own| &own.kind) {
            Some(AttractorKind::Periodic(known)) => known.orbit().period(),
            _ => 0,
        })
        .collect();
    assert_eq!(periods, [0, 1, 1, 1, 1, 1, 2, 2, 2]);
    assert!(over.at.iter().all(|at| at.moved[0].is_none()));
    assert!(over.at[2].moved[1].is_some_and(|moved| moved > 0.0 && moved < 0.3));
    // Cut anywhere, stored and continued: the same result.
    for cut in 0..=forcings.len() {
        let begun = stored(&basin_fractions(&forcings[..cut], &Unobserved).expect("no failure"));
        let extended = begun.extended(&forcings[cut..], &quick(200), 0.3, &Unobserved).expect("no failure");
        assert_eq!(extended, over, "cut at {cut}");
    }
    // With zero reach nothing is matched, and without forcings there is no result.
    let apart = over_forcing::basin_fractions_over(0.5, &[0.4, 0.41], &quick(50), 0.0, &Unobserved)
        .expect("no failure");
    assert_eq!(apart.followed.len(), 3);
    let none =
        over_forcing::basin_fractions_over(0.5, &[], &quick(50), 0.3, &Unobserved).expect("no failure");
    assert!(none.at.is_empty() && none.followed.is_empty());
    for (forcing, restitution, reach) in [(-1.0, 0.5, 0.3), (0.4, 1.0, 0.3), (0.4, 0.5, f64::NAN)] {
        let refused =
            over_forcing::basin_fractions_over(restitution, &[forcing], &quick(5), reach, &Unobserved);
        assert!(matches!(refused, Err(Error::OutOfRange { .. })), "{refused:?}");
    }
}

/// Of two attractors near an old one, the nearer continues it, whatever their order, and the other appears.
#[test]
fn an_attractor_goes_on_as_one() {
    let own = found(0.486, 0.5, 500);
    let places: Vec<_> = own.all().iter().map(over_forcing::places).collect();
    let (single, four) = (places[1].clone(), places[2].clone());
    let old = [None, four.clone()];
    let matches = over_forcing::matched(&old, &[None, single.clone(), four.clone()], (10.0, 1.5));
    assert_eq!(matches, [None, None, Some((1, 0.0))]);
    let matches = over_forcing::matched(&old, &[None, four, single.clone()], (10.0, 1.5));
    assert_eq!(matches, [None, Some((1, 0.0)), None]);
    // An unmatched attractor does not take another's place.
    let matches =
        over_forcing::matched(&[None, single.clone(), single.clone()], &[None, single], (10.0, 1.5));
    assert_eq!(matches, [None, Some((1, 0.0))]);
}

#[test]
fn searches_are_stored() {
    let search = AttractorSearch::default();
    assert_eq!(stored(&search), search);
    assert_eq!(stored(&search.with_orbits(None)).orbits(), None);
}

#[cfg(feature = "serde")]
#[test]
fn stored_attractors_that_do_not_fit_are_refused() {
    let own = found(0.486, 0.5, 500);
    let text = serde_json::to_value(&own).expect("writes");
    let read = |value: &serde_json::Value| serde_json::from_value::<Attractors>(value.clone());
    assert_eq!(read(&text).expect("legal"), own);
    let changed = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut wrong = text.clone();
        change(&mut wrong);
        read(&wrong).is_err()
    };
    assert!(changed(&|value| value["all"] = serde_json::json!([])));
    assert!(changed(&|value| value["all"].as_array_mut().expect("a list").reverse()));
    assert!(changed(&|value| value["all"][1] = value["all"][0].clone()));
    assert!(changed(&|value| value["all"][1]["starts"]["of"] = serde_json::json!(499)));
    assert!(changed(&|value| value["all"][1]["starts"]["count"] = serde_json::json!(500)));
    assert!(changed(&|value| value["all"][0]["kind"] = serde_json::json!({"Rest": {"LeadsTo": 3}})));
    assert!(!changed(&|value| value["all"][0]["kind"] = serde_json::json!({"Rest": {"LeadsTo": 2}})));
    assert!(changed(&|value| value["all"][0]["kind"] = serde_json::json!({"Rest": {"LeadsTo": 0}})));
}

#[cfg(feature = "serde")]
#[test]
fn stored_shares_of_another_map_are_refused() {
    let over = over_forcing::basin_fractions_over(0.5, &[0.32, 0.36], &quick(50), 0.3, &Unobserved)
        .expect("no failure");
    let text = serde_json::to_value(&over).expect("writes");
    let changed = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut wrong = text.clone();
        change(&mut wrong);
        serde_json::from_value::<over_forcing::BasinFractions>(wrong)
    };
    assert_eq!(changed(&|_| ()).expect("legal"), over);
    assert!(changed(&|value| value["restitution"] = serde_json::json!(0.6)).is_err());
    assert!(changed(&|value| value["restitution"] = serde_json::json!(1.0)).is_err());
    assert!(changed(&|value| value["at"][1]["axial_forcing"] = serde_json::json!(0.37)).is_err());
    assert!(changed(&|value| value["at"][1]["followed"] = serde_json::json!([0, 2])).is_err());
}

#[test]
fn rows_are_those_of_the_whole_grid() {
    for forcing in [0.486, 0.55] {
        let own = found(forcing, 0.5, 500);
        let axis = |high, cells| Axis::new(0.0, high, cells).expect("legal");
        let grid = Grid::new(axis(1.0, 15), axis(4.0, 9)).expect("legal");
        let settings = BasinSettings { max_impacts: 300, ..BasinSettings::default() };
        let whole = own.basins(grid, settings, &Unobserved).expect("no failure");
        let rows = |rows| own.basins_of_rows(grid, rows, settings, &Unobserved);
        for cut in 1..9 {
            let parts = [rows(0..cut).expect("no failure"), rows(cut..9).expect("no failure")];
            assert_eq!(Basins::stacked(parts).expect("fit"), whole, "Gamma {forcing}: cut at {cut}");
        }
        for wrong in [0..10, 9..9, 4..4, 10..12, usize::MAX - 1..usize::MAX] {
            assert!(matches!(rows(wrong.clone()), Err(Error::Unfitting { .. })), "{wrong:?}");
        }
        #[expect(clippy::reversed_empty_ranges, reason = "a user may give one")]
        let reversed = rows(5..3);
        assert!(matches!(reversed, Err(Error::Unfitting { .. })));
    }
    let of = |columns: usize| Basins::of_labels(vec![ATTACHED; 2 * columns], columns).expect("legal");
    assert!(matches!(Basins::stacked([of(3), of(4)]), Err(Error::Unfitting { found: 4, expected: 3, .. })));
    assert!(matches!(Basins::stacked([]), Err(Error::Unfitting { .. })));
}
