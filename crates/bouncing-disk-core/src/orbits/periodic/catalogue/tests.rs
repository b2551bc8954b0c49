use crate::run::Unobserved;
use core::f64::consts::PI;

use super::super::newton::same_orbit;
use super::super::phase_difference;
use super::*;
use crate::flight::platform::vibration::Vibration;
use crate::map::impact_map::map;
use crate::numerics::elementary::{cos, sin};
use crate::numerics::random::SplitMix64;
use crate::numerics::testing::stored;
use crate::run::testing::StopAfter;

fn found(map: &ImpactMap, impacts: usize, periods: u64, starts: u32) -> OrbitsFound {
    let search =
        OrbitSearch::new(impacts, periods).expect("legal").with_starts(starts, starts).expect("legal");
    map.periodic_orbits(&search, &Unobserved).expect("no failure")
}

/// Two flights with a total duration of 2 pi k, as a function of the first phase and the first duration,
/// independent of the map.
struct TwoFlights {
    p: f64,
    r: f64,
    k: u64,
}

impl TwoFlights {
    /// The disk's own speed at the start of a flight that ends on the platform after `h`.
    fn launch(&self, phase: f64, h: f64) -> f64 {
        0.5 * h + self.p * cos(phase + 0.5 * h) * sin(0.5 * h) / (0.5 * h)
    }

    /// Phases, durations and launch speeds of both flights.
    fn flights(&self, phase: f64, h: f64) -> [(f64, f64, f64); 2] {
        let (second, rest) = (phase + h, TAU * self.k as f64 - h);
        [(phase, h, self.launch(phase, h)), (second, rest, self.launch(second, rest))]
    }

    /// The residual of the law of restitution at both impacts.
    fn residual(&self, phase: f64, h: f64) -> [f64; 2] {
        let [(t0, h0, u0), (t1, h1, u1)] = self.flights(phase, h);
        let left = |u: f64, before: f64, t: f64| u + self.r * before - (1.0 + self.r) * self.p * cos(t);
        [left(u0, u1 - h1, t0), left(u1, u0 - h0, t1)]
    }

    /// All solutions: cells in which a Lipschitz bound allows a root, halved until they are small, then Newton
    /// steps.
    ///
    /// Two flights of h and 2 pi k - h from the phase tau must satisfy the law at both impacts, with u_i =
    /// h_i/2 + P (sin tau_(i+1) - sin tau_i)/h_i: two equations in (tau, h). The mean slope of the sine over
    /// a flight has derivatives of at most 1 (phase) and 1/2 (duration). So each equation changes by at most
    /// 2 (1 + r) P per radian of tau, and 1/2 + 3P/2 + r (1 + 3P)/2 + (1 + r) P per radian of h. A cell
    /// contains no solution if an equation at its middle exceeds these rates times half its size.
    fn solutions(&self) -> Vec<(f64, f64)> {
        let (p, r) = (self.p, self.r);
        let by_phase = 2.0 * (1.0 + r) * p;
        let by_duration = 0.5 + 1.5 * p + r * (0.5 + 1.5 * p) + (1.0 + r) * p;
        let mut cells = Vec::new();
        let (half, columns) = (PI / 8.0, 8_u64);
        for i in 0..columns {
            for j in 0..columns * self.k {
                cells.push(((2 * i + 1) as f64 * half, (2 * j + 1) as f64 * half, half));
            }
        }
        let mut solutions: Vec<(f64, f64)> = Vec::new();
        while let Some((phase, h, half)) = cells.pop() {
            let reach = (by_phase + by_duration) * half;
            if self.residual(phase, h).iter().any(|left| left.abs() > reach) {
                continue;
            }
            if half > 0.008 {
                let half = 0.5 * half;
                for (a, b) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
                    cells.push((phase + a * half, h + b * half, half));
                }
            } else if let Some((phase, h)) = self.newton(phase, h) {
                let known = |other: &(f64, f64)| {
                    let turned = phase_difference(phase.rem_euclid(TAU), other.0.rem_euclid(TAU));
                    turned.abs() < 1e-7 && (h - other.1).abs() < 1e-7
                };
                if !solutions.iter().any(known) {
                    solutions.push((phase, h));
                }
            }
        }
        solutions
    }

    fn newton(&self, mut phase: f64, mut h: f64) -> Option<(f64, f64)> {
        let longest = TAU * self.k as f64;
        for _ in 0..30 {
            let [a, b] = self.residual(phase, h);
            let e = 1e-6;
            let by = |plus: [f64; 2], minus: [f64; 2]| [0, 1].map(|i| (plus[i] - minus[i]) / (2.0 * e));
            let x = by(self.residual(phase + e, h), self.residual(phase - e, h));
            let y = by(self.residual(phase, h + e), self.residual(phase, h - e));
            let determinant = x[0] * y[1] - y[0] * x[1];
            let step = ((a * y[1] - y[0] * b) / determinant, (x[0] * b - a * x[1]) / determinant);
            phase -= step.0;
            h -= step.1;
            if !(h > 1e-5 && h < longest - 1e-5) {
                return None;
            }
            if step.0.abs() + step.1.abs() < 1e-10 {
                return Some((phase, h));
            }
        }
        None
    }

    /// The solution as an orbit of the map, if the exact map finds the same flights and they do not repeat
    /// each other.
    fn orbit(&self, map: &ImpactMap, (phase, h): (f64, f64)) -> Option<PeriodicOrbit> {
        let [(t0, h0, u0), (t1, h1, u1)] = self.flights(phase, h);
        let state = |t: f64, landing: f64| {
            ImpactState::new(Phase::new(t).expect("finite"), landing - self.p * cos(t)).ok()
        };
        let states = [state(t0, u1 - h1)?, state(t1, u0 - h0)?];
        let repeats = phase_difference(states[0].phase().angle(), states[1].phase().angle()).abs() < 1e-6
            && (h0 - h1).abs() < 1e-6;
        let flies = |at: ImpactState, duration: f64| {
            !map.rests_after(at)
                && map.step(at).is_ok_and(|impact| (impact.duration() - duration).abs() < 1e-6)
        };
        (!repeats && flies(states[0], h0) && flies(states[1], h1)).then(|| PeriodicOrbit {
            states: states.to_vec(),
            platform_periods: self.k,
            monodromy: glam::DMat2::IDENTITY,
            position_error: 5e-7,
            trace_error: 0.0,
        })
    }
}

/// Restitution 0.1 to 0.9, Gamma 0.1 to 3.
fn random_map(random: &mut SplitMix64) -> ImpactMap {
    let restitution = 0.1 + 0.8 * random.unit();
    map(0.1 + 2.9 * random.unit(), restitution)
}

/// Every orbit of two impacts that the search finds is a solution of the independent equations, and vice
/// versa.
#[test]
fn orbits_of_two_impacts_are_those_of_the_independent_equations() {
    let mut random = SplitMix64::new(2);
    let mut compared = 0;
    for _ in 0..24 {
        let map = random_map(&mut random);
        let own = found(&map, 2, 3, 96);
        let mut expected: Vec<PeriodicOrbit> = Vec::new();
        for k in 1..=3 {
            let flights = TwoFlights { p: map.vibration().peak_acceleration(), r: map.restitution(), k };
            for solution in flights.solutions() {
                let Some(orbit) = flights.orbit(&map, solution) else { continue };
                if !expected.iter().any(|known| same_orbit(known, &orbit)) {
                    expected.push(orbit);
                }
            }
        }
        let own: Vec<_> = own.orbits.iter().filter(|orbit| orbit.period() == 2).collect();
        for orbit in &own {
            assert!(expected.iter().any(|other| same_orbit(orbit, other)), "{map}: extra {orbit:?}");
        }
        for orbit in &expected {
            assert!(own.iter().any(|other| same_orbit(orbit, other)), "{map}: missed {orbit:?}");
        }
        compared += expected.len();
    }
    assert!(compared > 50, "{compared}");
}

#[test]
fn orbits_of_one_impact_are_the_admissible_ones_of_the_closed_form() {
    let mut random = SplitMix64::new(1);
    let mut compared = 0;
    for _ in 0..40 {
        let map = random_map(&mut random);
        let found = found(&map, 1, 100, 48);
        let closed: Vec<_> = (1..=100)
            .map_while(|k| map.period_one_pair(k))
            .flat_map(|pair| [pair.node, pair.saddle])
            .filter_map(|orbit| orbit.orbit(&map).expect("no failure"))
            .collect();
        assert_eq!(found.orbits.len(), closed.len(), "{map}");
        assert!(closed.iter().all(|orbit| found.orbits.contains(orbit)), "{map}");
        compared += closed.len();
    }
    assert!(compared > 100, "{compared}");
}

/// Every orbit on which random starts settle is in the list.
#[test]
fn every_attractor_that_random_starts_settle_on_is_found() {
    let mut random = SplitMix64::new(3);
    let mut settled = 0;
    for k in (1..=3).cycle().take(21) {
        // Near the forcings at which one impact every k periods attracts, and above.
        let restitution = 0.3 + 0.6 * random.unit();
        let birth = f64::from(k) * (1.0 - restitution) / (1.0 + restitution);
        let map = map(birth + 0.4 * random.unit(), restitution);
        let found = found(&map, 4, 12, 64);
        for _ in 0..60 {
            let phase = Phase::new(TAU * random.unit()).expect("finite");
            let start = ImpactState::new(phase, -map.impact_speed_bound() * random.unit()).expect("legal");
            let Ok(Some(orbit)) = map.settled_orbit(start, 3_000, 4, 1e-9, &Unobserved) else { continue };
            if orbit.platform_periods > 12 {
                continue;
            }
            settled += 1;
            assert!(found.orbits.iter().any(|other| same_orbit(other, &orbit)), "{map}: {orbit:?}");
        }
    }
    assert!(settled > 60, "{settled}");
}

/// Before the one-impact fold there is no orbit, after it two, after a two-impact fold four, after the
/// doubling one more.
#[test]
fn orbits_are_born_in_pairs_and_by_doubling() {
    let number = |forcing: f64| found(&map(forcing, 0.5), 2, 2, 48).orbits.len();
    assert_eq!([0.333, 0.334, 0.45, 0.485, 0.487].map(number), [0, 2, 2, 4, 5]);
}

#[test]
fn what_is_found_is_prime_closed_and_sorted_and_the_coverage_adds_up() {
    let map = map(0.9, 0.5);
    let OrbitsFound { orbits, coverage } = found(&map, 4, 6, 64);
    assert!(orbits.len() > 10 && orbits.iter().any(|orbit| orbit.period() == 4), "{}", orbits.len());
    for (i, orbit) in orbits.iter().enumerate() {
        assert_eq!(super::super::newton::prime_period(&orbit.states, 1e-6), orbit.period());
        let (n, mut turns) = (orbit.period(), 0);
        for j in 0..n {
            let impact = map.step(orbit.states[j]).expect("flies");
            turns += impact.periods;
            let next = orbit.states[(j + 1) % n];
            assert!(phase_difference(impact.phase.angle(), next.phase().angle()).abs() < 1e-11, "{orbit:?}");
            assert!(orbit.states[0].velocity() <= next.velocity());
        }
        assert!(turns <= orbit.platform_periods && orbit.platform_periods <= 6);
        // The determinant of n impacts is r^(2n).
        let expected = (0..2 * n).fold(1.0, |product, _| 0.5 * product);
        let size = orbit.monodromy.x_axis.length() * orbit.monodromy.y_axis.length();
        assert!((orbit.monodromy.determinant() - expected).abs() <= 1e-12 * size, "{orbit:?}");
        assert!(!orbits[..i].iter().any(|other| same_orbit(orbit, other)));
        if i > 0 {
            assert!(orbits[i - 1].period() <= n);
        }
    }
    let attempts = coverage.converged + coverage.refused + coverage.not_settled;
    assert_eq!((coverage.starts, coverage.attempts), (64 * 64, attempts));
    assert!(coverage.found_by_coarser <= orbits.len() as u64 && coverage.found_once <= orbits.len() as u64);
    assert!(coverage.impact_speed_bound <= map.impact_speed_bound());
}

#[cfg(feature = "parallel")]
#[test]
fn orbits_do_not_depend_on_the_number_of_threads() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| found(&map(1.3, 0.4), 3, 4, 40))
    };
    let one = with(1);
    assert!(!one.orbits.is_empty());
    assert_eq!((&one, &one), (&with(2), &with(7)));
}

/// A platform at rest, without restitution, almost without loss, the strongest vibration: each has an answer.
#[test]
fn seams_have_answers() {
    assert!(found(&map(0.0, 0.5), 3, 3, 8).orbits.is_empty());
    let at_rest = found(&map(0.2, 0.0), 2, 2, 8);
    assert_eq!((at_rest.orbits.len(), at_rest.coverage.resting_starts), (0, 64));
    // Without restitution every impact is forgotten except for its phase: the closed form is the orbit.
    let plastic = found(&map(1.05, 0.0), 1, 1, 16);
    assert_eq!(plastic.orbits.len(), 1, "{plastic:?}");
    let lossless = found(&map(0.1, 1.0 - f64::EPSILON / 2.0), 1, 2, 8);
    assert!(lossless.orbits.iter().all(|orbit| orbit.period() == 1), "{lossless:?}");
    let wild = found(&map(Vibration::MAX_PEAK_ACCELERATION / PI, 0.5), 2, 2, 4);
    assert_eq!(wild.coverage.starts, 16);
}

#[test]
fn the_largest_search_is_stored() {
    let search = OrbitSearch::new(64, 10_000).expect("legal");
    assert_eq!(search, stored(&search));
}

/// Each remaining row once counted thousands of flights before it called the observer: stopping a large
/// search took half a minute.
#[test]
fn no_row_begins_after_a_stop() {
    let (map, search) = (map(0.5, 0.5), OrbitSearch::new(1, 1).expect("legal"));
    let calls = StopAfter::calls(2);
    let watch = Watch::begin(&calls, 0, 9_216).expect("goes on");
    watch.ask().expect_err("stops");
    let row = map.search_row(&search, &Limits::new(&map, &search), 0, watch.work());
    assert_eq!(row.err(), Some(Error::Stopped { done: 0, total: 9_216 }));
    assert_eq!((watch.progress().done, calls.asked()), (0, 2));
}
