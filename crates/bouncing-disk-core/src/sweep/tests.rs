//! Sweeps against orbits that are advanced one by one: all bits of all events of 4,000 orbits, for each
//! instruction set.

use core::f64::consts::TAU;

use super::events::advance;
use super::*;
use crate::attractors::verdict::{Verdict, VerdictSettings};
use crate::chatter::policy::ChatterPolicy;
use crate::chatter::policy::PAPER_POLICY;
use crate::flight::launch::Launch;
use crate::flight::platform::phase::Phase;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::ImpactMap;
use crate::map::impact_map::{ImpactState, Orbit, OrbitEvent};
use crate::numerics::error::Error;
use crate::numerics::testing::golden_spread;
use crate::orbits::periodic::Multipliers;
use crate::run::{Unobserved, Watch};
use crate::sweep::lockstep::lanes::InstructionSet;
use crate::sweep::lyapunov::lyapunov_exponents;
use core::ops::ControlFlow;

const POLICIES: [ChatterPolicy; 2] = [ChatterPolicy::Complete, PAPER_POLICY];

/// Orbits of both policies from impacts, launches, rest and the air, at forcings from rest to chaos; many
/// chatter.
fn orbits(count: u64) -> Vec<Orbit> {
    let orbit = |k: u64| {
        let peak = match k % 5 {
            0 => 1.2 * golden_spread(k),
            1 | 2 => 1.0 + golden_spread(3 * k),
            3 => 20.0 * golden_spread(5 * k),
            _ => libm::exp10(4.0 * golden_spread(k / 5)),
        };
        let map = ImpactMap::new(Vibration::new(peak)?, 0.9 * golden_spread(7 * k))?;
        let policy = POLICIES[(k % 2) as usize];
        let phase = Phase::new(TAU * golden_spread(13 * k + k / 64))?;
        let speed = (1.0 + peak) * libm::exp10(1.0 - 6.0 * golden_spread(k / 3) * golden_spread(11 * k));
        match (k % 11, map.vibration().separation_phase()) {
            (0, Some(leaves)) => Launch::new(leaves, 0.0).map(|launch| map.orbit_from_launch(launch, policy)),
            (1, _) => Launch::new(phase, speed).map(|launch| map.orbit_from_launch(launch, policy)),
            (2, _) => map.orbit_from_drop(phase, speed, 0.0, policy),
            _ => Ok(map.orbit(ImpactState::new(phase, -speed)?, policy)),
        }
    };
    (0..count).map(|k| orbit(k).expect("legal")).collect()
}

fn bits(event: &SweepEvent) -> Vec<u64> {
    let of_phase = |phase: Phase| [phase.angle(), phase.sin(), phase.cos()].map(f64::to_bits);
    match event {
        SweepEvent::Impact(landing) => {
            let mut bits = of_phase(landing.state.phase()).to_vec();
            bits.extend([landing.state.velocity().to_bits(), landing.turns, landing.duration.to_bits()]);
            bits
        }
        SweepEvent::Attachment(stick) => {
            let mut bits = of_phase(stick.accumulation.phase).to_vec();
            bits.extend([stick.accumulation.duration.to_bits(), stick.last_speed.to_bits()]);
            bits
        }
        other => panic!("{other:?} on a sine"),
    }
}

/// The first events of an orbit, each with its visitor's count of events.
fn expected(orbit: &Orbit, most: usize) -> Vec<Vec<u64>> {
    let mut orbit = orbit.clone();
    let mut events = Vec::new();
    while events.len() < most
        && let Ok(Some(event)) = advance(&mut orbit)
    {
        events.push(bits(&event));
    }
    events
}

#[test]
fn a_sweep_shows_the_events_of_single_orbits() {
    // Orbits that end early, and a few that outlive all others.
    let most = |index: usize| if index.is_multiple_of(97) { 600 } else { 20 + index % 50 };
    for count in [1, 11, 12, 64, 65, 4_000] {
        let orbits = orbits(count);
        let expected: Vec<_> = orbits.iter().enumerate().map(|(k, orbit)| expected(orbit, most(k))).collect();
        let sticks = expected.iter().flatten().filter(|bits| bits.len() == 5).count();
        assert!(count < 4_000 || sticks > 2_000, "{sticks}");
        for set in InstructionSet::available() {
            let watch = Watch::begin(&Unobserved, 0, count).expect("goes on");
            let got = runner::run(
                &orbits,
                &|index| (most(index), Vec::new()),
                &|(most, events), event| {
                    events.push(bits(event));
                    if events.len() < *most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
                },
                set,
                &watch,
            );
            assert_eq!(got.len(), orbits.len());
            for (got, expected) in got.iter().zip(&expected) {
                let (index, (_, got)) = (got.0, got.1.as_ref().expect("no failure"));
                assert_eq!(got, expected, "{set:?}, orbit {index} of {count}: {:?}", orbits[index]);
            }
        }
    }
}

#[test]
fn the_impacts_are_those_of_the_orbit() {
    for orbit in orbits(500) {
        let (mut by_itself, mut swept) = (orbit.clone(), orbit);
        for _ in 0..50 {
            let from = by_itself.launch().map(|launch| launch.phase());
            let (impact, event) = (by_itself.advance(), advance(&mut swept));
            if let (Ok(Some(OrbitEvent::Impact(impact))), Ok(Some(SweepEvent::Impact(landing)))) =
                (impact, event)
            {
                assert_eq!((landing.state, landing.turns), (impact.into(), impact.turns));
                let rounding = 1.0e-15 * (10.0 + impact.duration());
                assert!((landing.duration - impact.duration()).abs() < rounding, "{from:?} {impact:?}");
            }
        }
    }
}

#[test]
fn the_first_failure_is_reported() {
    // Beyond the longest flight; the two orbits fail in different lanes and after different times.
    let mut orbits = orbits(300);
    let fast = |speed: f64| {
        let map = ImpactMap::new(Vibration::new(2.0).expect("legal"), 0.5).expect("legal");
        map.orbit(ImpactState::new(Phase::new(1.0).expect("finite"), -speed).expect("legal"), PAPER_POLICY)
    };
    orbits[200] = fast(1.0e12);
    orbits[100] = fast(2.0e12);
    let failure = survival_times(&orbits, 100, &Unobserved).expect_err("too long a flight");
    assert!(
        matches!(failure, Error::FlightTooLong { relative_speed, .. } if relative_speed.total_cmp(&1.0e12).is_eq()),
        "{failure}"
    );
}

#[test]
fn lives_and_columns_are_those_of_single_orbits() {
    let orbits = orbits(700);
    let lives = survival_times(&orbits, 90, &Unobserved).expect("no failure");
    let columns = orbit_diagram(&orbits, 30, 20, &Unobserved).expect("no failure");
    for (orbit, (lived, column)) in orbits.iter().zip(lives.iter().zip(&columns)) {
        let alone = orbit.clone().take(90).take_while(|event| matches!(event, Ok(OrbitEvent::Impact(_))));
        assert_eq!(*lived, alone.count());
        let impacts = orbit.clone().filter_map(|event| match event {
            Ok(OrbitEvent::Impact(impact)) => Some(ImpactState::from(impact)),
            _ => None,
        });
        assert_eq!(*column, impacts.skip(30).take(20).collect::<Vec<_>>());
    }
}

#[test]
fn the_exponent_of_a_periodic_orbit_is_that_of_its_multipliers() {
    let forcings = (0..40).map(|k| 0.40 + 0.001 * f64::from(k));
    let starts: Vec<_> = forcings
        .map(|forcing| {
            let map =
                ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), 0.5).expect("legal");
            (map, map.period_one(1).expect("exists"))
        })
        .collect();
    let exponents = lyapunov_exponents(&starts, 100, 20_000, &Unobserved).expect("no failure");
    for ((map, start), exponent) in starts.iter().zip(exponents) {
        let orbit = map.refine(&[*start]).expect("refines");
        let expected = orbit.multipliers().lyapunov_exponent(1);
        assert!(
            (exponent.expect("neither rest nor graze") - expected).abs() < 1.0e-3,
            "{exponent:?} {expected}"
        );
    }
}

#[test]
fn the_exponent_of_a_longer_orbit_is_that_of_one_of_its_impacts() {
    let start = ImpactState::from_normalised(1.2, 1.3).expect("legal");
    // Two, four and eight impacts: around the doublings of Fig. 6.
    let settled: Vec<_> = [0.50, 0.51, 0.535, 0.541]
        .map(|forcing| {
            let map =
                ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), 0.5).expect("legal");
            let verdict = map.verdict(start, VerdictSettings::default()).expect("no failure");
            let Verdict::Periodic { impacts, multipliers, state, .. } = verdict else { panic!("{verdict}") };
            assert!(impacts > 1, "{verdict}");
            ((map, state), multipliers.lyapunov_exponent(impacts))
        })
        .into();
    let starts: Vec<_> = settled.iter().map(|(start, _)| *start).collect();
    let exponents = lyapunov_exponents(&starts, 100, 20_000, &Unobserved).expect("no failure");
    for ((start, expected), exponent) in settled.iter().zip(exponents) {
        let exponent = exponent.expect("neither rest nor graze");
        assert!((exponent - expected).abs() < 1.0e-3, "{start:?} {exponent} {expected}");
    }
    let superstable = Multipliers::Real(0.0, 0.0).lyapunov_exponent(1);
    assert!(superstable.is_infinite() && superstable < 0.0, "{superstable}");
}

#[test]
fn chaos_has_a_positive_exponent_and_rest_none() {
    let at = |forcing: f64| {
        ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), 0.5).expect("legal")
    };
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
    let exponents = lyapunov_exponents(&[(at(0.55), start), (at(0.3), start)], 500, 2_000, &Unobserved)
        .expect("no failure");
    assert!(exponents[0].is_some_and(|exponent| exponent > 0.05), "{exponents:?}");
    assert_eq!(exponents[1], None);
}

#[test]
fn a_sweep_does_not_depend_on_the_number_of_threads() {
    let orbits = orbits(1_000);
    let events = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let visit = |events: &mut Vec<_>, event: &SweepEvent| {
            events.push(bits(event));
            if events.len() < 200 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        pool.install(|| sweep(&orbits, |_| Vec::new(), visit, &Unobserved)).expect("no failure")
    };
    let expected: Vec<_> = orbits.iter().map(|orbit| expected(orbit, 200)).collect();
    for threads in [1, 2, 7] {
        assert!(events(threads) == expected, "{threads} threads");
    }
}
