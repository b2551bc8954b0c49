use super::*;
use crate::numerics::power_law::NoPowerLaw;
use crate::testing::{StopAfter, stored};

/// Gamma of the crisis of Fig. 6 at restitution 0.5.
const CRISIS: f64 = 0.560_750_705_529_919;

fn map(axial_forcing: f64) -> ImpactMap {
    ImpactMap::new(Vibration::from_axial_forcing(axial_forcing).expect("legal"), 0.5).expect("legal")
}

/// The saddle of three impacts in three periods that the attractor touches.
fn saddle() -> PeriodicOrbit {
    let guess = [(0.758, -4.709), (1.588, -3.449), (5.999, -4.408)];
    let guess: Vec<_> = guess
        .iter()
        .map(|&(angle, velocity)| {
            ImpactState::new(crate::Phase::new(angle).expect("finite"), velocity).expect("legal")
        })
        .collect();
    map(0.5607).refine(&guess).expect("an orbit")
}

fn search() -> CrisisSearch {
    CrisisSearch::new(0.5, (0.5595, 0.5615)).expect("legal")
}

fn found(search: &CrisisSearch) -> Crisis {
    search.crisis(&saddle(), &saddle()).expect("no failure").expect("a tangency")
}

#[test]
fn the_attractor_of_fig_6_touches_a_saddle_of_three_impacts() {
    let crisis = stored(&found(&search()));
    assert!((crisis.forcing - CRISIS).abs() <= 1e-13 && crisis.forcing_error < 1e-13, "{crisis:?}");
    // What comes to rest comes to rest beyond it.
    let (none, some) = crisis.bracket;
    assert!(none < crisis.forcing && crisis.forcing < some && some - none < 1e-7, "{none} {some}");
    assert!(crisis.curvature.abs() > 0.1, "a quadratic tangency: {}", crisis.curvature);
    // One saddle: its own manifolds touch.
    let Multipliers::Real(large, small) = crisis.inside.multipliers() else { panic!("a saddle") };
    let expected = ln(small) / (2.0 * ln(large * small));
    assert!(
        (crisis.life_exponent().expect("known") - expected).abs() < 1e-12 && (0.7..0.8).contains(&expected)
    );
    // The orbit begins and ends next to the saddle, and is an orbit.
    let map = map(crisis.forcing);
    for pair in crisis.orbit.windows(2) {
        assert_eq!(ImpactState::from(map.step(pair[0]).expect("flies")), pair[1]);
    }
    let near = |state: &ImpactState| {
        crisis.touched.states.iter().any(|own| {
            (own.velocity() - state.velocity()).abs() < 1e-4
                && (own.phase().angle() - state.phase().angle()).abs() < 1e-4
        })
    };
    assert!(near(&crisis.orbit[0]) && crisis.orbit.last().is_some_and(near));
    assert!(crisis.orbit.iter().any(|state| !near(state)));
}

/// Of what was chosen in the search nothing is left in the result.
#[test]
fn the_crisis_does_not_depend_on_the_search() {
    for (search, tolerance) in [
        (search().with_samples(Side::Later, 1_000, 200).expect("legal"), 1e-13),
        (CrisisSearch::new(0.5, (0.56, 0.561)).expect("legal"), 1e-13),
    ] {
        let crisis = found(&search);
        assert!((crisis.forcing - CRISIS).abs() <= tolerance, "{}", crisis.forcing);
    }
    // From the second impact of the saddle, with another first piece.
    let mut turned = saddle();
    turned.states.rotate_left(1);
    for side in [Side::Later, Side::Earlier] {
        let search = search().with_samples(side, 2_048, 200).expect("legal");
        if let Ok(crisis) = search.crisis(&turned, &saddle()).expect("no failure") {
            assert!((crisis.forcing - CRISIS).abs() <= 1e-12, "{}", crisis.forcing);
            return;
        }
    }
    panic!("one of the sides leads to the attractor");
}

/// The unstable manifold of the period-1 orbit, which lies in the midst of the attractor, is not at its edge:
/// it touches later.
#[test]
fn what_lies_in_the_midst_of_the_attractor_touches_later() {
    let node = map(0.5607).refine(&[map(0.5607).period_one(1).expect("exists")]).expect("an orbit");
    let later = search().crisis(&node, &saddle()).expect("no failure").expect("a tangency");
    assert!(later.forcing > CRISIS + 1e-7 && later.forcing < CRISIS + 1e-5, "{}", later.forcing);
    assert!(later.inside.period() == 1 && later.touched.period() == 3);
}

/// Brute force: below the crisis orbits on the attractor live on, beyond it they do not.
#[test]
fn orbits_live_below_the_crisis_and_die_beyond_it() {
    let crisis = found(&search());
    let at = |offset: f64| {
        let map = map(crisis.forcing + offset);
        crisis.orbit[12..16]
            .iter()
            .map(|start| {
                map.state_after(*start, 200_000, crate::ChatterPolicy::Complete).expect("flies").is_some()
            })
            .filter(|lives| *lives)
            .count()
    };
    assert_eq!((at(-1e-8), at(1e-4)), (4, 0));
}

#[test]
fn a_search_without_a_crisis_says_why() {
    let from = |low: f64, high: f64| CrisisSearch::new(0.5, (low, high)).expect("legal");
    let outcome = |search: CrisisSearch, touched: &PeriodicOrbit| {
        search.crisis(&saddle(), touched).expect("no failure").expect_err("none")
    };
    assert!(matches!(outcome(from(0.5595, 0.5605), &saddle()), NoCrisis::NoneRests { samples: 2_048, .. }));
    assert!(matches!(outcome(from(0.561, 0.5615), &saddle()), NoCrisis::RestsBefore { life: 1.., .. }));
    // The saddle of one impact is not what is touched.
    let other = map(0.5607).period_one_pair(1).expect("exists").saddle.orbit(&map(0.5607)).expect("flies");
    let other = other.expect("admissible");
    let error = outcome(search(), &other);
    assert!(matches!(error, NoCrisis::NoFold { nearest, .. } if nearest > 0.02), "{error}");
    for error in [error, NoCrisis::NotSettled { forcing: 1.0, change: 1e-300 }] {
        assert!(stored(&error).to_string().len() < 200);
    }
    // A node is no saddle.
    let node = map(0.45).refine(&[map(0.45).period_one(1).expect("exists")]).expect("an orbit");
    assert!(matches!(from(0.44, 0.46).crisis(&node, &node), Err(Error::OutOfRange { .. })));
}

#[test]
fn illegal_searches_are_refused() {
    for (restitution, low, high) in [
        (0.0, 0.5, 0.6),
        (1.0, 0.5, 0.6),
        (f64::NAN, 0.5, 0.6),
        (0.5, 0.6, 0.6),
        (0.5, -0.1, 0.6),
        (0.5, f64::NAN, 0.6),
        (0.5, 0.5, f64::INFINITY),
    ] {
        assert!(CrisisSearch::new(restitution, (low, high)).is_err(), "{restitution} {low} {high}");
    }
    let search = stored(&search());
    assert!(
        search.with_samples(Side::Later, 63, 100).is_err()
            && search.with_samples(Side::Later, 64, 9).is_err()
    );
}

#[test]
fn a_search_can_be_stopped() {
    let stopped = search().crisis_observed(&saddle(), &saddle(), &StopAfter::calls(3));
    assert!(matches!(stopped, Err(Error::Stopped { .. })), "{stopped:?}");
}

#[test]
fn mean_lives_follow_a_power_law() {
    let crisis = found(&search());
    let beyond: Vec<_> = (0..8).map(|k| 4e-4 / f64::from(1 << k)).collect();
    let lives = stored(&crisis.lives(&beyond, 60, 300_000).expect("followed"));
    assert_eq!(lives.lives.len(), beyond.len());
    let law = lives.scaling.as_ref().expect("a power law");
    assert!((-1.1..-0.5).contains(&law.exponent), "{law:?}");
    // Where nothing ends there is no law, and no number that looks like a life.
    let none = crisis.lives(&beyond, 20, 1).expect("followed");
    assert_eq!(none.scaling, Err(NoPowerLaw::TooFewPoints { found: 0, needed: 6 }));
    assert!(none.lives.iter().all(|life| life.ended == 0 && life.impacts >= f64::MAX));
    for (distance, orbits, impacts) in [(0.0, 10, 10), (f64::NAN, 10, 10), (1e-5, 0, 10), (1e-5, 10, 0)] {
        assert!(crisis.lives(&[distance], orbits, impacts).is_err(), "{distance} {orbits} {impacts}");
    }
    let stopped = crisis.lives_observed(&beyond, 20, 1_000, &StopAfter::calls(2));
    assert!(matches!(stopped, Err(Error::Stopped { .. })));
}

/// Lives at distances that hardly differ are those of unrelated orbits: their means scatter as the errors say.
#[test]
fn mean_lives_scatter_as_their_errors_say() {
    let crisis = found(&search());
    let beyond: Vec<_> = (0..16).map(|k| 2e-4 * (1.0 + 1e-4 * f64::from(k))).collect();
    let lives = crisis.lives(&beyond, 40, 300_000).expect("followed").lives;
    let count = lives.len() as f64;
    assert!(lives.iter().all(|life| life.ended == 40));
    let mean = lives.iter().fold(0.0, |sum, life| sum + life.impacts) / count;
    let square = |life: &crate::MeanLife| {
        let off = (life.impacts - mean) / (mean * life.relative_error);
        off * off
    };
    let chi_squared = lives.iter().fold(0.0, |sum, life| sum + square(life)) / (count - 1.0);
    // 0.1 and 99.9 % of the distribution with 15 degrees of freedom, over 15.
    assert!((0.23..2.52).contains(&chi_squared), "{chi_squared}");
}
