use core::convert::Infallible;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use super::*;
use crate::flight::launch::Launch;
use crate::numerics::roots::bisected_bracket;
use crate::numerics::testing::spread;

type High = FBig<HalfEven, 2>;

fn high(x: f64) -> High {
    High::try_from(x).expect("finite").with_precision(700).value()
}

fn low(x: &High) -> f64 {
    x.to_f64().value()
}

impl PowerSeries {
    fn at_high(&self, y: &High) -> High {
        self.0.iter().rev().fold(high(0.0), |sum, coefficient| sum * y + high(*coefficient))
    }
}

/// Restitutions from nearly zero to the largest legal one.
const RESTITUTIONS: [f64; 10] = [
    1.0e-18,
    0.5,
    0.9,
    0.99,
    0.999,
    1.0 - 1.0e-4,
    1.0 - 1.0e-7,
    1.0 - 1.0e-12,
    1.0 - f64::EPSILON,
    1.0 - f64::EPSILON / 2.0,
];

const PEAKS: [f64; 7] = [0.0, 1.0e-9, 0.5, 1.0, 1.000_000_267_196_965_4, 2.0, 197.39];

struct Case {
    vibration: Vibration,
    phase: Phase,
    speed: f64,
    restitution: f64,
}

impl Case {
    fn series(&self) -> ChatterSeries {
        self.vibration.chatter_series(self.phase, self.speed, self.restitution)
    }
}

/// Launches up to the largest accepted speed, at phases of every kind.
fn cases(peak: f64, restitution: f64, count: u32) -> impl Iterator<Item = Case> {
    let vibration = Vibration::new(peak).expect("legal");
    (0..count).filter_map(move |k| {
        let before = libm::exp10(-1.0 - 13.0 * spread(k, 0.754_877_666));
        let angle = match vibration.separation_phase() {
            Some(at) if k % 3 == 0 => at.angle() - before,
            _ => core::f64::consts::TAU * spread(k, 0.569_840_29),
        };
        let phase = Phase::new(angle).expect("finite");
        let accepted = |exponent: f64| {
            vibration.accumulation(phase, libm::exp10(exponent), restitution).map(|_| libm::exp10(exponent))
        };
        accepted(-150.0)?;
        let is_slow = |exponent: f64| Ok::<_, Infallible>(accepted(exponent).is_some());
        let Ok((slow, _)) = bisected_bracket(-150.0, 0.0, 40, is_slow);
        let speed = accepted(slow)? * [1.0, 0.3, 1e-6, 1e-100][(k % 4) as usize];
        vibration.accumulation(phase, speed, restitution)?;
        Some(Case { vibration, phase, speed, restitution })
    })
}

/// Every flight of the series, of which there are up to 4e17, ends on the platform with the impact speed of
/// the series, and the next one starts with r times this speed: checked by the gap itself, in 700 bits.
#[test]
fn impacts_of_the_series_lie_on_the_platform() {
    for restitution in RESTITUTIONS {
        // Near a separation the pull itself is only known to a rounding of 1: see the momentum theorem.
        for peak in [0.0, 1e-9, 0.5, 1.0] {
            for case in cases(peak, restitution, 24) {
                let series = case.series();
                let (r, p) = (high(restitution), high(peak));
                let lost = high(1.0) - &r;
                let end = high(case.phase.angle()) + series.remaining.at_high(&high(1.0));
                for y in [1.0, 0.7, 1e-3, 1e-15] {
                    let y = high(y);
                    let next = &y * &r;
                    let (before, after) = (series.remaining.at_high(&y), series.remaining.at_high(&next));
                    let h = &before - &after;
                    let (sin, cos) = (&end - &before).sin_cos();
                    let (later_sin, later_cos) = (&end - &after).sin_cos();
                    let w = &lost * series.launch_speed.at_high(&y);
                    let u = &lost * series.impact_speed.at_high(&y);
                    let gap = &w * &h - &h * &h / high(2.0) + &p * (&h * &cos + sin - &later_sin);
                    let arrival = &h - &w - &p * (cos - later_cos);
                    let launch = &lost * series.launch_speed.at_high(&next);
                    // The remainder of the series is the same as of the sum in section 4, and the pull is
                    // rounded.
                    let pull = case.vibration.contact_force(case.phase);
                    let rounding = 1e-14 * (1.0 + peak / pull) + 1e-16 / series.duration;
                    for off in [gap / (&w * &h), arrival / &u - high(1.0), launch / (&r * &u) - high(1.0)] {
                        assert!(
                            low(&off).abs() <= rounding,
                            "{} {rounding:e} {peak} {restitution} {}",
                            low(&off),
                            case.speed
                        );
                    }
                }
            }
        }
    }
}

/// Momentum and position of the disk at the accumulation point are the platform's.
#[test]
fn sums_obey_the_theorems_of_momentum_and_position() {
    for restitution in RESTITUTIONS {
        for peak in PEAKS {
            for case in cases(peak, restitution, 60) {
                let series = case.series();
                let t = series.duration();
                let impulse = series.impact_speed().scaled(1.0 + restitution);
                let all = series.range(0, None);
                // In the platform's frame the pull a - b t - (a - 1)(1 - cos t) + b (t - sin t) acts.
                let (pull, drift) =
                    (case.vibration.contact_force(case.phase), case.vibration.velocity(case.phase));
                let momentum = t * (pull - t * (0.5 * drift - t * (1.0 - pull) / 6.0 - t * t * drift / 24.0));
                let position = t
                    * t
                    * (0.5 * pull - t * (drift / 6.0 - t * (1.0 - pull) / 24.0 - t * t * drift / 120.0));
                let sum = all.sum(&impulse);
                // Truncating the series changes the duration by 1e-16 rad.
                let rounding = 1e-14 + 4e-16 / t.max(1e-300);
                assert!(
                    (sum - (momentum - case.speed)).abs() <= rounding * momentum,
                    "{sum:e} {momentum:e} {peak} {restitution} {:e} {rounding:e}",
                    case.speed
                );
                let first = sum * t - all.moment(&impulse, series.remaining());
                assert!(
                    (first - (position - case.speed * t)).abs() <= rounding * position,
                    "{first:e} {position:e} {peak} {restitution} {:e}",
                    case.speed
                );
            }
        }
    }
}

/// The impacts agree with the solver of single flights.
#[test]
fn impacts_of_the_series_are_those_of_single_flights() {
    for restitution in [0.3, 0.9, 0.99] {
        for peak in [0.0, 0.5, 2.0] {
            for case in cases(peak, restitution, 40) {
                let series = case.series();
                let pull = case.vibration.contact_force(case.phase);
                if case.speed < 1e-12 || pull < 1e-2 {
                    continue;
                }
                let (mut time, mut at, mut speed) = (0.0, case.phase, case.speed);
                let mut impacts = 0;
                while speed > 1e-9 * case.speed {
                    let launch = Launch::new(at, speed).expect("legal");
                    let impact = case.vibration.first_impact(launch).expect("returns");
                    time += impact.remainder;
                    let own = series.range(0, Some(impacts + 1)).change(series.remaining());
                    // The phase of an impact is rounded, and with it the rest of the chatter.
                    let rounding = 1e-15 * (1.0 + peak) / (1.0 - restitution) + 1e-13 * series.duration();
                    assert!((own - time).abs() <= rounding, "{own} {time} {peak} {restitution}");
                    let u = (1.0 - restitution) * series.impact_speed().at(series.share(Some(impacts)));
                    let arrival = -impact.velocity;
                    assert!(
                        (u - arrival).abs() <= 1e-11 * arrival + rounding,
                        "{u} {arrival} {peak} {restitution}"
                    );
                    (at, speed) = (impact.phase, restitution * arrival);
                    impacts += 1;
                }
            }
        }
    }
}

#[test]
fn the_series_counts_the_impacts_up_to_a_time() {
    for restitution in [0.3, 0.9, 0.99, 0.999] {
        for peak in [0.0, 0.5, 2.0] {
            for case in cases(peak, restitution, 20).filter(|case| case.speed > 1e-9) {
                let series = case.series();
                let impacts = case.vibration.chatter_impacts(case.phase, case.speed, restitution);
                let times: Vec<_> = impacts.map(|impact| impact.time).collect();
                assert!(series.impacts().abs_diff(times.len() as u64) <= 1);
                for share in (0..200).map(|k| spread(k, 0.618_033_99)) {
                    let time = share * share * series.duration();
                    let expected = times.iter().take_while(|at| **at <= time).count() as u64;
                    assert_eq!(series.impacts_by(time), Some(expected), "{restitution} {peak} {share}");
                }
                assert_eq!(series.impacts_by(0.0), Some(0));
                assert_eq!(series.impacts_by(series.duration()), None);
            }
        }
    }
}

/// For any time and any number of impacts, the last impact is not later, and the next one not earlier.
#[test]
fn the_impact_before_a_time_is_found_next_to_restitution_one() {
    for restitution in [1.0 - 1e-4, 1.0 - 1e-7, 1.0 - 1e-12, 1.0 - f64::EPSILON / 2.0] {
        for case in cases(0.5, restitution, 20) {
            let series = case.series();
            for share in
                (0..200).map(|k| spread(k, 0.618_033_99)).chain([1e-9, 1e-14, 1.0 - 1e-9, 1.0 - f64::EPSILON])
            {
                let time = share * series.duration();
                let Some(impacts) = series.impacts_by(time) else { panic!("{time} is not the end") };
                let at = |impacts: u64| series.range(0, Some(impacts)).change(series.remaining());
                let rounding = 1e-15 * series.duration();
                assert!(
                    at(impacts) <= time + rounding && at(impacts + 1) >= time - rounding,
                    "{restitution} {share}"
                );
            }
        }
    }
}

/// Sums over a few impacts, and moments that all but vanish, keep their digits: against the impacts in 700
/// bits.
#[test]
fn sums_over_few_impacts_do_not_cancel() {
    for restitution in [0.5, 0.999, 1.0 - 1e-12, 1.0 - f64::EPSILON / 2.0] {
        for case in cases(0.5, restitution, 6) {
            let series = case.series();
            let quantity = *series.impact_speed();
            let (r, lost) = (high(restitution), high(1.0) - high(restitution));
            for (from, count) in [(0, 1), (0, 2), (3, 17)] {
                let range = series.range(from, Some(from + count));
                let mut y = (0..from).fold(high(1.0), |y, _| y * &r);
                let begin = series.remaining.at_high(&y);
                let (mut sum, mut moment, mut product) = (high(0.0), high(0.0), high(0.0));
                for _ in 0..count {
                    let own = &lost * quantity.at_high(&y);
                    y *= &r;
                    sum += &own;
                    product += &own * &own;
                    moment += own * (&begin - series.remaining.at_high(&y));
                }
                for (mine, exact) in [
                    (range.sum(&quantity), sum),
                    (range.moment(&quantity, series.remaining()), moment),
                    (range.product(&quantity, &quantity), product),
                ] {
                    let exact = low(&exact);
                    assert!(
                        (mine - exact).abs() <= 1e-14 * exact + 1e-300,
                        "{mine:e} {exact:e} {restitution} {from} {count}"
                    );
                }
            }
        }
    }
}

/// A path that turns: the impact found is the first below zero.
#[test]
fn the_first_negative_impact_is_the_first() {
    let case = cases(0.5, 0.99, 1).next().expect("accepted");
    let series = case.series();
    let mut found = 0;
    for k in 0..4_000 {
        let mut wanted = PowerSeries::ZERO;
        for (order, coefficient) in wanted.0.iter_mut().enumerate().skip(1) {
            let sign = spread(k * 7 + order as u32, 0.618_033_99) - 0.5;
            *coefficient = sign * libm::exp10(2.0 * spread(k + 31 * order as u32, 0.754_877_666));
        }
        let start = libm::exp10(-4.0 * spread(k, 0.569_840_29));
        let from = u64::from(k % 7);
        let value = |n: u64| start - series.range(from, Some(n)).change(&wanted);
        let expected = (from..6_000).find(|n| value(*n) < 0.0);
        let first = series.first_negative(from, start, &wanted);
        found += u32::from(first.is_some_and(|first| first > from + 1));
        assert!(
            first == expected || (expected.is_none() && first.is_some_and(|first| first >= 3_600)),
            "{k} {first:?} {expected:?}"
        );
    }
    assert!(found > 300, "{found}");
}
