//! Launches and drops that land on seams, confirmed by a march or judged by the oracle, alone and in lanes.
//!
//! `cargo test` runs 3 million cases. The campaign takes an hour on two cores, unless `CAMPAIGN_SIZE` sets the
//! number of shards of each kind; `CAMPAIGN_SEED` is added to every seed:
//!
//! ```text
//! cargo test --release -p bouncing-disk-core --test first_impact -- --ignored attack::campaign --nocapture
//! ```
//!
//! Four properties are required (docs/numerics-impacts.md, "The attack on seams"). The march (`march.rs`)
//! accepts a gap within 32 roundings of its terms as zero. It leaves a case open if its rounding does not
//! exclude an earlier impact: nearly always a launch slower than 1e-20 whose pull is rounding error. The
//! oracle judged one in five of these in the first and third row, all in the others, and a random share of
//! the confirmed cases (all in the second and fourth row), in 256 bits. A case is undecidable if the last
//! digits of P, phase or speed decide it, or if it is a launch below 1e-140 against a pull that is rounding
//! error. No case failed, and two full runs gave the same sums (22 November 2026, two cores of an AMD EPYC
//! with AVX-512):
//!
//! | | cases | confirmed by the march | judged by the oracle | open | undecidable |
//! | --- | --- | --- | --- | --- | --- |
//! | launches, P up to 1e3, flights up to 400 rad | 1,000,000,000 | 974,412,975 | 2,797,908 | 11,182,518 | 12,767,349 |
//! | launches, P up to 1e8, flights up to 1e6 rad | 1,000,000 | 964,986 | 988,380 | 0 | 39,790 |
//! | drops, P up to 1e3 | 20,000,000 | 19,788,458 | 59,791 | 160,870 | 31,348 |
//! | launches off the seams, random and grazing | 100,000 | 95,604 | 100,000 | 0 | 341 |

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use bouncing_disk_core::attractors::{Axis, BasinSettings, Grid, KnownOrbit};
use bouncing_disk_core::sweep::{Flights, InstructionSet, SweepEvent, sweep};
use bouncing_disk_core::{
    ChatterPolicy, Error, Impact, ImpactMap, ImpactState, Launch, Orbit, OrbitEvent, Phase, Unobserved,
    Vibration,
};

use crate::launches::{self, Case, SplitMix};
use crate::march::{Finding, Flight};
use crate::oracle::{self, Exact};
use crate::paper::PAPER_POLICY;
use crate::seams;
use crate::shards::{self, Kind};

/// Relative accuracy of an extremely short flight, in addition to the effect of rounding of P and the phase.
const BRIEF_ACCURACY: f64 = 1.0e-14;

/// Share of the pull above which a change by one unit roundoff in P or the phase makes a launch undecidable.
const DECIDABLE: f64 = 1.0e-2;

/// Smallest speed that the march of the oracle can square.
const SMALLEST_SQUARE: f64 = 1.0e-140;

/// The counts of a run of the attack.
#[derive(Debug, Default)]
pub struct Tally {
    pub cases: u64,
    pub confirmed: u64,
    /// Cases left open by the march, and neither judged nor undecidable.
    pub open: u64,
    /// Cases sampled for the oracle, and judged by it.
    pub judged: u64,
    /// Cases for which, by the oracle, the last digits of the data decide.
    pub undecidable: u64,
    pub refused: u64,
    pub failures: Vec<String>,
}

/// The sampling for the oracle: one in this many of the cases that the march confirms, and of those that it
/// leaves open.
#[derive(Debug, Clone, Copy)]
pub struct Drawn {
    pub confirmed: u64,
    pub open: u64,
}

impl Drawn {
    pub const ALL: Self = Self { confirmed: 1, open: 1 };

    const fn all_open_and(confirmed: u64) -> Self {
        Self { confirmed, open: 1 }
    }
}

impl Tally {
    fn fail(&mut self, case: &Case, gap: f64, reason: &str) {
        if self.failures.len() < 20 {
            self.failures.push(format!("{case:?}, gap {gap:e}: {reason}"));
        }
    }

    pub fn check(&self) {
        assert!(
            self.failures.is_empty(),
            "{} of {} failed, the first:\n{}",
            self.failures.len(),
            self.cases,
            self.failures[..self.failures.len().min(5)].join("\n")
        );
    }

    /// The content of a shard's file.
    fn told(self) -> serde_json::Value {
        serde_json::json!({
            "cases": self.cases,
            "confirmed": self.confirmed,
            "open": self.open,
            "judged": self.judged,
            "undecidable": self.undecidable,
            "refused": self.refused,
            "failures": self.failures,
        })
    }

    /// Confirms or judges the impact of a case, a drop if `gap` is positive.
    fn impact(&mut self, case: &Case, gap: f64, found: Result<Impact, Error>, drawn: Drawn) {
        self.cases += 1;
        let impact = match found {
            Ok(impact) => impact,
            Err(Error::FlightTooLong { duration, limit, .. }) if duration > limit => {
                self.refused += 1;
                return;
            }
            Err(error) => return self.fail(case, gap, &error.to_string()),
        };
        let phase = Phase::new(case.angle).unwrap();
        let flight = Flight { peak: case.peak, phase, gap, speed: case.speed };
        let open = match flight.confirm(&impact) {
            Finding::Confirmed => {
                self.confirmed += 1;
                false
            }
            Finding::Open => true,
            Finding::Contradiction(reason) => return self.fail(case, gap, &format!("{reason}: {impact:?}")),
        };
        if open && case.speed.abs().max(gap.sqrt()) < SMALLEST_SQUARE && flight.is_weightless() {
            self.undecidable += 1;
            return;
        }
        let share = if open { drawn.open } else { drawn.confirmed };
        if open && !self.cases.is_multiple_of(share) {
            self.open += 1;
        }
        if self.cases.is_multiple_of(share) {
            self.judged += 1;
            let exact = Exact::dropped(case, gap);
            if let Some((expected, doubt)) = exact.brief_flight() {
                if doubt > DECIDABLE {
                    self.undecidable += 1;
                    return;
                }
                let error = oracle::low(&((oracle::high(impact.remainder) - &expected) / &expected)).abs();
                // Subnormal numbers have fewer digits.
                let digits = f64::from_bits(1) / oracle::low(&expected);
                if impact.periods > 0 || error > BRIEF_ACCURACY + oracle::PHASE_FACTOR * doubt + digits {
                    self.fail(
                        case,
                        gap,
                        &format!("{} instead of {}", impact.remainder, oracle::low(&expected)),
                    );
                }
                return;
            }
            if case.speed.abs().max(gap.sqrt()) < SMALLEST_SQUARE {
                // Neither brief nor within reach of the oracle: equivalent to a launch from rest.
                self.undecidable += 1;
                return;
            }
            match exact.judge(&impact) {
                Ok(verdict) => self.undecidable += u64::from(verdict.undecidable),
                Err(reason) => self.fail(case, gap, &reason),
            }
        }
    }
}

/// Launches with P up to `largest_peak` and flights of about `longest` rad.
pub fn launches(seed: u64, count: u64, largest_peak: f64, longest: f64, drawn: Drawn) -> Tally {
    let mut random = SplitMix::new(seed);
    let mut tally = Tally::default();
    for _ in 0..count {
        let case = seams::launch(&mut random, largest_peak, longest);
        let (vibration, launch) = oracle::launch(&case);
        tally.impact(&case, 0.0, vibration.first_impact(launch), drawn);
    }
    tally
}

pub fn drops(seed: u64, count: u64, largest_peak: f64, drawn: Drawn) -> Tally {
    let mut random = SplitMix::new(seed);
    let mut tally = Tally::default();
    for _ in 0..count {
        let (case, gap) = seams::drop(&mut random, largest_peak);
        let vibration = Vibration::new(case.peak).unwrap();
        let phase = Phase::new(case.angle).unwrap();
        tally.impact(&case, gap, vibration.first_impact_of_drop(phase, gap, case.speed), drawn);
    }
    tally
}

/// A platform that falls away by no more than a rounding: the oracle's own limits once lost all digits to
/// cancellation here.
#[test]
fn a_pull_of_half_a_rounding_is_judged_by_what_a_rounding_does_to_it() {
    let case = Case {
        class: "seam",
        peak: 1.000_003_814_697_265_8,
        angle: 1.573_558_458_268_680_8,
        speed: 4.235_214_898_575_105e-81,
        separation: false,
    };
    let (vibration, launch) = oracle::launch(&case);
    let impact = vibration.first_impact(launch).unwrap();
    let exact = Exact::new(&case);
    assert!(exact.judge(&impact).unwrap().undecidable);
    let h = oracle::high(impact.remainder);
    let limits = exact.limits(&h, &exact.at(&h));
    // Half of u P h^2 sin tau, near the crest.
    let expected = 0.5 * oracle::U * case.peak * impact.remainder * impact.remainder;
    assert!((limits.gap / expected - 1.0).abs() < 0.01, "{limits:?} {expected:e}");
}

/// The same launches in lanes: the bits, the turns and the durations of single flights.
pub fn lanes(seed: u64, blocks: u64, largest_peak: f64, longest: f64) {
    const ALL: usize = 4 * Flights::LANES;
    for set in InstructionSet::available() {
        let mut random = SplitMix::new(seed);
        let mut flights = Flights::new(set, 4).unwrap();
        for _ in 0..blocks {
            let cases: Vec<_> = (0..ALL).map(|_| seams::launch(&mut random, largest_peak, longest)).collect();
            for (lane, case) in cases.iter().enumerate() {
                let (vibration, launch) = oracle::launch(case);
                flights.set_platform(lane, vibration);
                flights.set_launch(lane, launch);
            }
            let mut failed = Vec::new();
            flights.fly(ALL, |lane, error| failed.push((lane, error)));
            let mut failed = failed.into_iter().peekable();
            for (lane, case) in cases.iter().enumerate() {
                let (vibration, launch) = oracle::launch(case);
                let alone = match vibration.first_impact(launch) {
                    Ok(alone) => alone,
                    Err(error) => {
                        assert_eq!(failed.next(), Some((lane, error)), "{set:?} {case:?}");
                        continue;
                    }
                };
                assert!(failed.peek().is_none_or(|(failed, _)| *failed != lane), "{set:?} {case:?}");
                let (rows, own) = (flights.impacts(lane / Flights::LANES).unwrap(), lane % Flights::LANES);
                let got =
                    [rows.angle[own], rows.sin[own], rows.cos[own], rows.velocity[own], rows.duration(own)];
                let (phase, velocity) = (alone.phase, alone.velocity);
                let expected = [phase.angle(), phase.sin(), phase.cos(), velocity, alone.duration()];
                assert_eq!(
                    got.map(f64::to_bits),
                    expected.map(f64::to_bits),
                    "{set:?} {case:?}: {got:?} {alone:?}"
                );
                assert_eq!(rows.turns[own] as u64, alone.turns, "{set:?} {case:?}");
            }
        }
    }
}

#[test]
fn launches_on_seams_1() {
    launches(101, 250_000, 1.0e3, 400.0, Drawn::all_open_and(50)).check();
}

#[test]
fn launches_on_seams_2() {
    launches(102, 250_000, 1.0e3, 400.0, Drawn::all_open_and(50)).check();
}

#[test]
fn launches_on_seams_of_strong_platforms() {
    launches(103, 60_000, 1.0e8, 1.0e6, Drawn::all_open_and(10)).check();
}

#[test]
fn drops_on_seams() {
    drops(104, 120_000, 1.0e3, Drawn::all_open_and(20)).check();
    drops(105, 30_000, 1.0e8, Drawn::all_open_and(10)).check();
}

#[test]
fn lanes_on_seams() {
    lanes(106, 400, 1.0e3, 400.0);
    lanes(107, 100, 1.0e8, 1.0e6);
}

/// Flights that once lost a period: they land within rounding below 2 pi.
#[test]
fn a_landing_on_the_seam_counts_its_turn() {
    for (peak, angle, speed, duration) in [
        (0.0, 0.0, PI, TAU),
        (3.265_508_075_018_760_6, 0.108_751_156_856_945_38, 2.954_142_192_430_93, 12.457_619_457_502_23),
        (PI / 3.0, 0.0, TAU / 3.0, TAU),
    ] {
        let vibration = Vibration::new(peak).unwrap();
        let launch = Launch::new(Phase::new(angle).unwrap(), speed).unwrap();
        let impact = vibration.first_impact(launch).unwrap();
        assert!((impact.duration() - duration).abs() < 1.0e-12, "{impact:?}");
        for set in InstructionSet::available() {
            let mut flights = Flights::new(set, 1).unwrap();
            flights.set_platform(0, vibration);
            flights.set_launch(0, launch);
            flights.fly(1, |_, error| panic!("{error}"));
            let rows = flights.impacts(0).unwrap();
            assert_eq!(rows.duration(0).to_bits(), impact.duration().to_bits(), "{set:?}");
            assert_eq!(rows.turns[0] as u64, impact.turns, "{set:?}");
        }
    }
}

/// A disk released a time d before the platform stops falling away returns after 3 d, because the pull is
/// then proportional to time. Of 15,996 such launches within four units in the last place 93 found no impact.
#[test]
fn a_launch_from_rest_at_the_end_of_the_fall_lands_after_three_times_the_rest_of_it() {
    let mut random = SplitMix::new(108);
    let (mut brief, mut all) = (0, 0);
    for _ in 0..4_000 {
        let peak = seams::peak(&mut random, 1.0e8);
        let vibration = Vibration::new(peak).unwrap();
        let Some(separation) = vibration.separation_phase() else { continue };
        // The end of the fall as in the crate: the mirror image of the separation.
        let retention = PI - separation.angle();
        let mut angle = retention;
        for _ in 0..6 {
            angle = angle.next_down();
            if angle < separation.angle() {
                break;
            }
            let phase = Phase::new(angle).unwrap();
            let rest = vibration.first_impact(Launch::new(phase, 0.0).unwrap()).unwrap();
            let flight = Flight { peak, phase, gap: 0.0, speed: 0.0 };
            flight.agrees(&rest).unwrap();
            all += 1;
            let left = retention - angle;
            if left < 1.0e-6 * (retention - separation.angle()) {
                brief += 1;
                assert!((rest.remainder / (3.0 * left) - 1.0).abs() < 1.0e-5, "P {peak}: {rest:?} {left:e}");
                // P cos sigma is the growth of the pull per radian.
                let velocity = -1.5 * ((peak - 1.0) * (peak + 1.0)).sqrt() * left * left;
                assert!((rest.velocity / velocity - 1.0).abs() < 3.0e-5, "P {peak}: {rest:?} {velocity:e}");
            }
            for speed in [f64::from_bits(1), 1.0e-300, 1.0e-200, 1.0e-121, 1.0e-60] {
                for angle in [angle, retention, retention.next_up()] {
                    let phase = Phase::new(angle).unwrap();
                    let impact = vibration.first_impact(Launch::new(phase, speed).unwrap()).unwrap();
                    Flight { peak, phase, gap: 0.0, speed }.agrees(&impact).unwrap();
                }
            }
        }
    }
    assert!(brief > 8_000 && 2 * brief > all, "{brief} of {all}");
}

/// Drops that cancellation between disk and crest once spoiled.
#[test]
fn fast_and_low_drops_keep_their_digits() {
    for (peak, angle, gap, velocity, duration) in [
        (0.0, 0.0, 1.0, -1.0e6, 2.0 / (1.0e6 + (1.0e12_f64 + 2.0).sqrt())),
        (0.0, 0.0, 1.0, -1.0e8, 1.0e-8),
        (0.0, 1.0, 1.0e-155, 0.0, (2.0e-155_f64).sqrt()),
    ] {
        let vibration = Vibration::new(peak).unwrap();
        let impact = vibration.first_impact_of_drop(Phase::new(angle).unwrap(), gap, velocity).unwrap();
        assert!((impact.duration() / duration - 1.0).abs() < 1.0e-15, "{impact:?} {duration:e}");
    }
    // Thrown up from far below the rounding of P, against a pull of 77 g: back after 2 v/a.
    let vibration = Vibration::new(100.0).unwrap();
    let phase = Phase::new(4.0).unwrap();
    let impact = vibration.first_impact_of_drop(phase, 1.0e-14, 1.0e-2).unwrap();
    let parabola = 2.0e-2 / vibration.contact_force(phase);
    assert!((impact.duration() / parabola - 1.0).abs() < 1.0e-3, "{impact:?}");
}

/// From a gap below the rounding of P a disk moving down once landed before it started, or was lost until the
/// next period. It lands after gap/speed, except for the small change of the platform's pull meanwhile.
#[test]
fn a_disk_that_moves_down_lands_at_once_and_not_before() {
    for (peak, angle, gap, speed) in [
        (1.0e3, 0.9, 1.0e-13, 1.0e-4),
        (1.0e3, 1.6, 1.0e-13, 1.0e-4),
        (1.0e2, 4.0, 1.0e-16, 1.0e-2),
        (2.0, 0.6, 1.0e-11, 1.0e-2),
        (0.5, 3.0, 1.0e-20, 1.0e-6),
    ] {
        let vibration = Vibration::new(peak).unwrap();
        let impact = vibration.first_impact_of_drop(Phase::new(angle).unwrap(), gap, -speed).unwrap();
        let straight = gap / speed;
        assert!((impact.duration() / straight - 1.0).abs() < 2.0 * peak * straight / speed, "{impact:?}");
    }
}

/// A map at a threshold, and an impact on one of its seams.
fn map_and_state(random: &mut SplitMix) -> (ImpactMap, ImpactState) {
    let restitution = seams::one_of(random, &seams::RESTITUTIONS);
    let case = seams::launch(random, 1.0e3, 400.0);
    let map = ImpactMap::new(Vibration::new(case.peak).unwrap(), restitution).unwrap();
    let speed = if restitution > 1.0e-3 { case.speed / restitution } else { case.speed };
    (map, ImpactState::new(Phase::new(case.angle).unwrap(), -speed).unwrap())
}

/// Single orbits of maps at their thresholds: every flight has one consistent time, and a sweep shows the
/// same events.
#[test]
fn orbits_on_seams_keep_time_and_sweeps_show_them() {
    const EVENTS: usize = 30;
    let mut random = SplitMix::new(109);
    let mut impacts = 0;
    for _ in 0..400 {
        let orbits: Vec<_> = (0..100)
            .map(|k| {
                let (map, state) = map_and_state(&mut random);
                let policy = if k % 3 == 0 { PAPER_POLICY } else { ChatterPolicy::Complete };
                map.orbit(state, policy)
            })
            .collect();
        let mut expected = Vec::new();
        for orbit in &orbits {
            let mut alone = orbit.clone();
            let mut events = Vec::new();
            while events.len() < EVENTS {
                let launch = alone.launch();
                match alone.advance() {
                    Ok(Some(OrbitEvent::Impact(impact))) => {
                        if let Some(launch) = launch {
                            let (phase, speed) = (launch.phase(), launch.relative_speed());
                            let peak = Orbit::map(&alone).vibration().peak_acceleration();
                            let flight = Flight { peak, phase, gap: 0.0, speed };
                            assert_eq!(flight.agrees(&impact), Ok(()), "{orbit:?}: {impact:?}");
                            impacts += 1;
                        }
                        events.push((
                            impact.phase.angle().to_bits(),
                            impact.velocity.to_bits(),
                            impact.turns,
                        ));
                    }
                    Ok(Some(OrbitEvent::Attachment(stick))) => {
                        assert!(
                            stick.accumulation.duration.is_finite() && stick.accumulation.duration >= 0.0
                        );
                        events.push((
                            stick.accumulation.phase.angle().to_bits(),
                            0,
                            stick.accumulation.turns,
                        ));
                    }
                    Ok(Some(event)) => panic!("{event:?}"),
                    Ok(None) => break,
                    Err(Error::FlightTooLong { .. }) => {
                        events.clear();
                        break;
                    }
                    Err(error) => panic!("{orbit:?}: {error}"),
                }
            }
            expected.push(events);
        }
        // Too long a flight in one orbit is an error of the sweep.
        let (orbits, expected): (Vec<_>, Vec<_>) =
            orbits.into_iter().zip(expected).filter(|(_, events)| !events.is_empty()).unzip();
        let swept = sweep(
            &orbits,
            |_| Vec::new(),
            |events, event| {
                match event {
                    SweepEvent::Impact(landing) => {
                        let (phase, velocity) = (landing.state.phase(), landing.state.velocity());
                        events.push((phase.angle().to_bits(), velocity.to_bits(), landing.turns));
                    }
                    SweepEvent::Attachment(stick) => {
                        events.push((
                            stick.accumulation.phase.angle().to_bits(),
                            0,
                            stick.accumulation.turns,
                        ));
                    }
                    _ => {}
                }
                if events.len() < EVENTS { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
            &Unobserved,
        );
        assert_eq!(swept.unwrap(), expected);
    }
    assert!(impacts > 300_000, "{impacts}");
}

/// Grids with cells on seams: the labels of lanes agree with single starts.
#[test]
fn basins_on_seams_have_the_labels_of_single_starts() {
    let mut random = SplitMix::new(110);
    let mut labels = [0_u32; 3];
    for _ in 0..150 {
        let (map, _) = map_and_state(&mut random);
        let settings = BasinSettings { max_impacts: 60, ..BasinSettings::default() };
        let known: Vec<_> = map
            .period_one(1)
            .and_then(|state| map.refine(&[state]).ok())
            .and_then(|orbit| KnownOrbit::new(orbit, 0.01).ok())
            .into_iter()
            .collect();
        // Centres at whole sixteenths of the period, 0 and 1 among them, and speeds at fractions of the
        // orbits' speed.
        let phase = Axis::new(-1.0 / 32.0, 33.0 / 32.0, 17).unwrap();
        let fastest = 4.0 / (1.0 + map.restitution());
        let speed = Axis::new(0.0, fastest * (1.0 + 1.0 / 16.0), 17).unwrap();
        let grid = Grid::new(phase, speed).unwrap();
        let Ok(basins) = map.basins(grid, &known, settings, &Unobserved) else {
            continue;
        };
        for row in 0..17 {
            for (column, &label) in basins.row(row).iter().enumerate() {
                let start =
                    ImpactState::new(Phase::new(grid.impact_angle(column)).unwrap(), -speed.centre(row) * PI);
                let alone = map.basin_label(start.unwrap(), &known, settings).unwrap();
                assert_eq!(label, alone, "{map:?} {start:?}");
                labels[usize::from(label).min(2)] += 1;
            }
        }
    }
    assert!(labels.iter().all(|&count| count > 50), "{labels:?}");
}

/// The campaign of docs/numerics-impacts.md, "The attack on seams".
///
/// `cargo test --release -p bouncing-disk-core --test first_impact -- --ignored attack::campaign --nocapture`
#[test]
#[ignore = "takes an hour"]
fn campaign() {
    // One open launch in five: a million of them.
    const MARCHED: Drawn = Drawn { confirmed: 1_000_000, open: 5 };
    shards::run(&[
        Kind {
            name: "launches",
            shards: 1_000,
            run: |seed| launches(seed, 1_000_000, 1.0e3, 400.0, MARCHED).told(),
        },
        Kind {
            name: "strong",
            shards: 100,
            run: |seed| launches(seed, 10_000, 1.0e8, 1.0e6, Drawn::ALL).told(),
        },
        Kind {
            name: "drops",
            shards: 20,
            run: |seed| drops(seed, 1_000_000, 1.0e3, Drawn { confirmed: 1_000, open: 5 }).told(),
        },
        Kind { name: "random", shards: 10, run: |seed| random_launches(seed, 10_000).told() },
    ]);
}

/// Random launches, not only on seams, all judged by the oracle.
fn random_launches(seed: u64, count: u64) -> Tally {
    let mut random = SplitMix::new(seed);
    let mut tally = Tally::default();
    while tally.cases < count {
        let case = match tally.cases % 4 {
            0 => Some(launches::random(&mut random)),
            1 => launches::grazing(&mut random),
            2 => launches::slow_touch(&mut random),
            _ => Some(launches::boundary(&mut random)),
        };
        let Some(case) = case else { continue };
        let (vibration, launch) = oracle::launch(&case);
        tally.impact(&case, 0.0, vibration.first_impact(launch), Drawn::ALL);
    }
    tally
}
