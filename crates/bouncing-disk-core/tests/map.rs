//! The impact map, its orbits and their analyses, against laws, closed forms and independent derivatives.

mod dual_numbers;
mod paper;

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::attractors::{
    ATTACHED, Axis, BasinSettings, FIRST_ORBIT, Grid, KnownOrbit, UNDECIDED,
};
use bouncing_disk_core::orbits::{Multipliers, doubling_cascade};
use bouncing_disk_core::{
    ChatterPolicy, Error, ImpactMap, ImpactState, Launch, OrbitEvent, Phase, Unobserved, Vibration,
};
use dual_numbers::dual_derivative;
use glam::{DMat2, DVec2};
use paper::PAPER_POLICY;
use proptest::prelude::*;

fn map(axial_forcing: f64, restitution: f64) -> ImpactMap {
    let vibration = Vibration::from_axial_forcing(axial_forcing).expect("legal forcing");
    ImpactMap::new(vibration, restitution).expect("legal restitution")
}

fn state(angle: f64, velocity: f64) -> ImpactState {
    ImpactState::new(Phase::new(angle).expect("finite"), velocity).expect("legal velocity")
}

#[test]
fn the_normalised_speed_is_that_of_the_paper() {
    let state = ImpactState::from_normalised(1.0, 1.25).expect("legal");
    assert!((state.velocity() + 1.25 * PI).abs() < 1e-15, "{state:?}");
    assert!((state.normalised_speed() - 1.25).abs() < 1e-15, "{state:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn iterates_are_the_bits_of_single_steps(
        forcing in 0.05_f64..60.0, restitution in 0.0_f64..0.95, angle in 0.0..TAU, speed in 0.05_f64..4.0, impacts in 0_u64..60,
    ) {
        let map = map(forcing, restitution);
        let from = state(angle, -speed * PI * forcing);
        let one_by_one = (0..impacts).try_fold(from, |at, _| map.step(at).map(ImpactState::from));
        match (map.iterate(from, impacts, &Unobserved), one_by_one) {
            (Ok(own), Ok(other)) => {
                let bits = |state: ImpactState| {
                    let phase = state.phase();
                    [phase.angle(), phase.sin(), phase.cos(), state.velocity()].map(f64::to_bits)
                };
                prop_assert_eq!(bits(own), bits(other));
            }
            (Err(own), Err(other)) => prop_assert_eq!(own, other),
            (own, other) => prop_assert!(false, "{own:?} {other:?}"),
        }
    }

    #[test]
    fn the_derivative_agrees_with_dual_numbers(
        forcing in 0.05_f64..60.0, restitution in 0.05_f64..0.95, angle in 0.0..TAU, speed in 0.05_f64..4.0,
    ) {
        let map = map(forcing, restitution);
        let from = state(angle, -speed * PI * forcing);
        let Ok((impact, own)) = map.step_with_derivative(from) else { return Ok(()) };
        // Near a graze the derivative is unbounded and the comparison would only test conditioning.
        prop_assume!(impact.velocity < -0.05 * PI * forcing.min(1.0));
        let other = dual_derivative(map.vibration(), from, impact.duration(), |_| restitution.into());
        let scale = other.x_axis.abs().max_element().max(other.y_axis.abs().max_element()).max(1.0);
        prop_assert!((own - other).x_axis.abs().max_element() <= 1e-9 * scale, "{own} {other}");
        prop_assert!((own - other).y_axis.abs().max_element() <= 1e-9 * scale, "{own} {other}");
    }

    /// The map contracts areas by restitution^2 times the ratio of the impact speeds, for any motion of the
    /// platform.
    #[test]
    fn determinant_is_restitution_squared_times_the_speed_ratio(
        forcing in 0.05_f64..20.0, restitution in 0.05_f64..0.95, angle in 0.0..TAU, speed in 0.05_f64..4.0,
    ) {
        let map = map(forcing, restitution);
        let from = state(angle, -speed * PI * forcing);
        let Ok((impact, derivative)) = map.step_with_derivative(from) else { return Ok(()) };
        prop_assume!(impact.velocity < -0.05 * PI * forcing.min(1.0));
        let expected = restitution * restitution * from.velocity() / impact.velocity;
        // Two products of the entries cancel: their size sets the rounding.
        let scale = (derivative.x_axis.x * derivative.y_axis.y).abs() + expected.abs();
        prop_assert!((derivative.determinant() - expected).abs() <= 1e-11 * scale);
    }

    /// The closed form of the chattering sum against the sequence itself, impact by impact to the last bit.
    #[test]
    fn accumulation_agrees_with_the_impacts_one_by_one(
        forcing in 0.0_f64..3.0, restitution in 0.05_f64..0.9, angle in 0.0..TAU, exponent in -6.0_f64..-1.0,
    ) {
        let map = map(forcing, restitution);
        let phase = Phase::new(angle).expect("finite");
        let speed = bouncing_disk_core::numerics::elementary::pow(10.0, exponent);
        let Some(sum) = map.accumulation(Launch::new(phase, speed).expect("legal")) else { return Ok(()) };
        let (mut total, mut launch, mut at) = (0.0, speed, phase);
        while launch > 1e-30 * speed {
            let impact = map.vibration().first_impact(Launch::new(at, launch).expect("legal")).expect("returns");
            prop_assert_eq!(impact.periods, 0);
            total += impact.remainder;
            (at, launch) = (impact.phase, -restitution * impact.velocity);
        }
        // Phases near P sin tau = 1 are rounded by 2e-16, which the pull 1 - P sin tau passes on to every
        // flight.
        let pull = map.vibration().contact_force(phase);
        let rounding = 4e-15 * (1.0 + forcing / pull) * total / (1.0 - restitution);
        prop_assert!(
            (sum.duration - total).abs() <= sum.error_bound + rounding,
            "{} {} bound {}", sum.duration, total, sum.error_bound
        );
        let mut last = 0.0;
        for impact in map.chatter_impacts(Launch::new(phase, speed).expect("legal")) {
            prop_assert!(impact.time >= last && impact.time <= sum.duration * (1.0 + 1e-12) + 1e-15);
            last = impact.time;
        }
        prop_assert!((last - sum.duration).abs() <= 1e-12 * sum.duration + 2.0 * sum.error_bound + rounding);
    }

    /// A disk released at a point of a flight lands where the flight ends.
    #[test]
    fn drop_from_the_middle_of_a_flight_ends_at_the_same_impact(
        forcing in 0.0_f64..5.0, angle in 0.0..TAU, speed in 0.01_f64..3.0, share in 0.05_f64..0.95,
    ) {
        let vibration = Vibration::from_axial_forcing(forcing).expect("legal");
        let p = vibration.peak_acceleration();
        let phase = Phase::new(angle).expect("finite");
        let speed = speed * (1.0 + p);
        let impact = vibration.first_impact(Launch::new(phase, speed).expect("legal")).expect("returns");
        let h = share * impact.duration();
        let middle = Phase::new(angle + h).expect("finite");
        let disk_speed = speed + p * phase.cos();
        let gap = disk_speed * h - 0.5 * h * h - p * (middle.sin() - phase.sin());
        prop_assume!(gap > 1e-3 * (1.0 + p) && impact.velocity < -1e-2 * (1.0 + p));
        let again = vibration.first_impact_of_drop(middle, gap, disk_speed - h - p * middle.cos()).expect("returns");
        // The gap itself was computed with this rounding.
        let rounding = 1e-14 * (1.0 + p + disk_speed * disk_speed) / impact.velocity.abs();
        let total = h + again.duration();
        prop_assert!((total - impact.duration()).abs() <= rounding * 10.0, "{} {}", total, impact.duration());
        prop_assert!((again.velocity - impact.velocity).abs() <= 10.0 * rounding * (2.0 + p + impact.velocity.abs()));
    }

    /// The graze margin against the smallest local minimum of the gap sampled along the flight.
    #[test]
    fn graze_margin_is_the_smallest_local_minimum_of_the_gap(
        peak in 1.01_f64..30.0, angle in 0.0..TAU, speed in 0.01_f64..1.5,
    ) {
        let vibration = Vibration::new(peak).expect("legal");
        let launch = Launch::new(Phase::new(angle).expect("finite"), speed * peak).expect("legal");
        let impact = vibration.first_impact(launch).expect("returns");
        let (s, c) = (launch.phase().sin(), launch.phase().cos());
        let disk_speed = launch.relative_speed() + peak * c;
        let gap = |h: f64| {
            let sine = bouncing_disk_core::numerics::elementary::sin(angle + h);
            disk_speed * h - 0.5 * h * h - peak * (sine - s)
        };
        let steps = (impact.duration() / 2e-3) as usize + 3;
        let at = |i: usize| gap(impact.duration() * i as f64 / steps as f64);
        let sampled = (1..steps)
            .filter(|&i| at(i) < at(i - 1) && at(i) <= at(i + 1))
            .map(at)
            .fold(f64::INFINITY, f64::min);
        let margin = vibration.graze_margin(launch, &impact);
        if sampled.is_finite() || margin.is_finite() {
            // A minimum that lies at an inflection is too flat for the samples.
            let flat = |h: f64| h > 2e-2 * peak;
            prop_assert!((margin - sampled).abs() <= 1e-4 * peak || flat(margin) && sampled.is_infinite(),
                "{} sampled {}", margin, sampled);
        }
    }

    /// Same start, same bits; and the orbit iterator is the map iterated.
    #[test]
    fn orbit_is_the_iterated_map(angle in 0.0..TAU, speed in 0.1_f64..2.0) {
        let map = map(0.55, 0.5);
        let start = ImpactState::from_normalised(angle, speed).expect("legal");
        let mut by_hand = start;
        for event in map.orbit(start, ChatterPolicy::Complete).take(200) {
            let OrbitEvent::Impact(impact) = event.expect("no failure") else { break };
            by_hand = map.step(by_hand).expect("an impact follows").into();
            prop_assert_eq!(impact.phase.angle().to_bits(), by_hand.phase().angle().to_bits());
            prop_assert_eq!(impact.velocity.to_bits(), by_hand.velocity().to_bits());
        }
    }
}

#[test]
fn still_platform_returns_restitution_squared_of_every_height() {
    for restitution in [0.0, 0.3, 0.5, 0.9, 0.99] {
        let map = map(0.0, restitution);
        let height = 3.0_f64;
        let fall = (2.0 * height).sqrt();
        let phase = Phase::new(1.0).expect("finite");
        let mut time = 0.0;
        let mut apex = height;
        for event in map.orbit_from_drop(phase, height, 0.0, ChatterPolicy::Complete).expect("legal") {
            match event.expect("no failure") {
                OrbitEvent::Impact(impact) => {
                    let rebound = 0.5 * (restitution * impact.velocity) * (restitution * impact.velocity);
                    apex *= restitution * restitution;
                    assert!((rebound - apex).abs() <= 1e-13 * apex, "{rebound} {apex}");
                    time += impact.duration();
                }
                OrbitEvent::Attachment(stick) => {
                    time += stick.accumulation.duration;
                    assert!(stick.separation.is_none(), "a still platform never throws the disk");
                }
                _ => unreachable!("no other events"),
            }
        }
        let zeno = fall * (1.0 + restitution) / (1.0 - restitution);
        assert!((time - zeno).abs() <= 1e-13 * zeno, "restitution {restitution}: {time} {zeno}");
    }
}

#[test]
fn period_one_is_a_fixed_point_where_it_exists() {
    for forcing in [1.0 / 3.0 + 1e-9, 0.34, 0.4, 0.486] {
        let map = map(forcing, 0.5);
        let orbit = map.period_one(1).expect("exists above (1-r)/(1+r)");
        let impact = map.step(orbit).expect("returns");
        assert!((impact.phase.angle() - orbit.phase().angle()).abs() < 1e-13);
        assert!((impact.velocity - orbit.velocity()).abs() < 1e-13);
        assert_eq!(impact.turns, 1);
    }
    assert!(map(0.3333, 0.5).period_one(1).is_none());
}

/// The speed agrees with the orbit if there is one, and every such speed belongs to an orbit at some forcing.
#[test]
fn the_impact_speed_of_period_one_does_not_depend_on_the_forcing() {
    for (restitution, periods) in [(0.0, 1), (0.3, 1), (0.5, 2), (0.9, 3), (0.5, 1_000)] {
        let speed = map(0.0, restitution).period_one_impact_speed(periods);
        assert!((speed * (1.0 + restitution) - TAU * periods as f64).abs() < 1e-15 * speed);
        let born = periods as f64 * (1.0 - restitution) / (1.0 + restitution);
        for forcing in [1.01 * born, 1.5 * born, 3.0 * born] {
            let orbit = map(forcing, restitution).period_one(periods).expect("above its birth");
            assert_eq!((-orbit.velocity()).to_bits(), speed.to_bits());
        }
    }
}

#[test]
fn cascade_agrees_with_the_closed_form_and_with_feigenbaum() {
    let cascade = doubling_cascade(0.5, 6, &Unobserved).expect("the cascade exists").doublings;
    assert!((cascade[0].axial_forcing - ImpactMap::first_doubling_forcing(0.5)).abs() < 1e-12);
    let periods: Vec<_> = cascade.iter().map(|doubling| doubling.period).collect();
    assert_eq!(periods, [1, 2, 4, 8, 16, 32]);
    let gaps: Vec<_> = cascade.windows(2).map(|pair| pair[1].axial_forcing - pair[0].axial_forcing).collect();
    let last_ratio = gaps[3] / gaps[4];
    assert!((last_ratio - 4.669_201_609).abs() < 0.01, "{last_ratio}");
}

#[test]
fn stability_changes_at_the_first_doubling() {
    let doubling = ImpactMap::first_doubling_forcing(0.5);
    for (forcing, stable) in [(doubling - 1e-6, true), (doubling + 1e-6, false)] {
        let map = map(forcing, 0.5);
        let orbit = map.refine(&[map.period_one(1).expect("exists")]).expect("settles");
        assert_eq!(orbit.multipliers().spectral_radius() < 1.0, stable);
        assert_eq!(orbit.platform_periods, 1);
    }
}

#[test]
fn multipliers_of_plain_matrices() {
    let real = Multipliers::of(DMat2::from_cols(DVec2::new(3.0, 0.0), DVec2::new(5.0, -0.5)));
    assert_eq!(real, Multipliers::Real(3.0, -0.5));
    let turn = Multipliers::of(DMat2::from_cols(DVec2::new(0.0, 1.0), DVec2::new(-1.0, 0.0)));
    assert_eq!(turn, Multipliers::Complex { real: 0.0, imaginary: 1.0 });
    assert!((turn.spectral_radius() - 1.0).abs() < 1e-15);
}

#[test]
fn basins_are_the_same_for_any_number_of_threads() {
    let map = map(0.5, 0.5);
    let start = ImpactState::from_normalised(0.9, 1.3).expect("legal");
    let orbit = map.settled_orbit(start, 2_000, 8, 1e-9, &Unobserved).expect("no failure").expect("period 2");
    assert_eq!(orbit.period(), 2);
    let radius = orbit.trapping_radius(&map, 32, &Unobserved).expect("attracts");
    let known = [KnownOrbit::new(orbit, radius).expect("legal")];
    let grid = Grid::new(Axis::new(0.0, 1.0, 37).expect("legal"), Axis::new(0.0, 2.0, 41).expect("legal"))
        .expect("legal");
    let labels = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
        pool.install(|| map.basins(grid, &known, BasinSettings::default(), &Unobserved)).expect("no failure")
    };
    let one = labels(1);
    assert!(one.fraction(FIRST_ORBIT) > 0.2 && one.fraction(ATTACHED) > 0.4);
    assert!(one.fraction(UNDECIDED) <= 0.0, "every start is decided at this forcing");
    assert_eq!(one, labels(2));
    assert_eq!(one, labels(7));
}

#[test]
fn policies_agree_where_the_cut_does_not_matter() {
    // Below the first doubling the chattering orbit settles on one toss per cycle: the impacts before the cut
    // agree to within the part omitted by the cut.
    let map = map(0.4, 0.5);
    let separation = map.vibration().separation_phase().expect("lifts off");
    let impacts = |policy| -> Vec<f64> {
        Launch::new(separation, 0.0)
            .map(|launch| map.orbit_from_launch(launch, policy))
            .expect("legal")
            .take(12)
            .filter_map(|event| match event.expect("no failure") {
                OrbitEvent::Impact(impact) => Some(impact.velocity),
                _ => None,
            })
            .collect()
    };
    let (complete, paper) = (impacts(ChatterPolicy::Complete), impacts(PAPER_POLICY));
    for (a, b) in complete.iter().zip(&paper) {
        assert!((a - b).abs() <= 1e-5 * a.abs(), "{a} {b}");
    }
}

#[test]
fn restitution_zero_sticks_at_every_impact() {
    let map = map(0.6, 0.0);
    let separation = map.vibration().separation_phase().expect("lifts off");
    for policy in [ChatterPolicy::Complete, PAPER_POLICY] {
        let kinds: Vec<bool> = Launch::new(separation, 0.0)
            .map(|launch| map.orbit_from_launch(launch, policy))
            .expect("legal")
            .take(8)
            .map(|event| matches!(event.expect("no failure"), OrbitEvent::Impact(_)))
            .collect();
        assert_eq!(kinds, [true, false, true, false, true, false, true, false]);
    }
}

/// At Gamma = k (1 - r)/(1 + r) an orbit with one impact every k periods is born at phase 0, where the angle
/// wraps. Each of its flights lasts k whole periods, wherever rounding puts the impact.
#[test]
fn orbits_at_their_birth_take_whole_periods() {
    let (mut flights, mut refined) = (0, 0);
    for k in 1..=4_u64 {
        for step in 1..1_000_u32 {
            let restitution = f64::from(step) / 1_000.0;
            let birth = k as f64 * (1.0 - restitution) / (1.0 + restitution);
            for forcing in [birth.next_down(), birth, birth.next_up(), birth * (1.0 + 1.0e-12)] {
                let map =
                    ImpactMap::new(Vibration::from_axial_forcing(forcing).unwrap(), restitution).unwrap();
                let Some(state) = map.period_one(k) else { continue };
                let impact = map.step(state).unwrap();
                let duration = impact.duration();
                if impact.velocity > 0.9 * state.velocity() {
                    // An earlier impact prevents the orbit.
                    continue;
                }
                flights += 1;
                // Near a double root the phase changes with the square root of the rounding.
                assert!(
                    (duration - k as f64 * TAU).abs() < 1.0e-6,
                    "{k} {restitution} {forcing}: {impact:?}"
                );
                match map.refine(&[state]) {
                    Ok(orbit) => {
                        assert_eq!(orbit.platform_periods, k, "{restitution} {forcing}");
                        refined += 1;
                    }
                    Err(Error::NotSettled { .. } | Error::NoLiftOff { .. }) => {}
                    Err(error) => panic!("{k} {restitution} {forcing}: {error}"),
                }
            }
        }
    }
    assert!(flights > 8_000 && refined > flights * 9 / 10, "{refined} of {flights}");
}

/// A disk that chatters to rest has no period, however long its ever smaller impacts are followed.
#[test]
fn a_chattering_disk_has_no_period() {
    for (forcing, restitution) in [(0.2, 0.5), (0.3, 0.3), (0.34, 0.5), (0.0, 0.9), (0.5, 0.2)] {
        let map = ImpactMap::new(Vibration::from_axial_forcing(forcing).unwrap(), restitution).unwrap();
        let state = ImpactState::from_normalised(3.0, 0.05).unwrap();
        assert_eq!(map.period_of(state, 8, 1.0e-8), Ok(None), "{forcing} {restitution}");
        for transient in [0, 5, 2_000] {
            assert_eq!(
                map.settled_orbit(state, transient, 8, 1.0e-8, &Unobserved),
                Ok(None),
                "{forcing} {restitution}"
            );
        }
    }
}

/// Late in a chatter one impact equals the next to any tolerance, in phase and in the remaining speed. This
/// is the approach to rest and not a period, however late.
#[test]
fn impacts_late_in_a_chatter_are_no_period() {
    let map = map(0.2, 0.5);
    for impacts in [40, 200, 900] {
        let late = map.iterate(state(3.0, -0.2), impacts, &Unobserved).unwrap();
        assert_eq!(map.period_of(late, 8, 1.0e-8), Ok(None), "{late:?}");
    }
}

/// A solution of the shooting equations with zero speed or zero duration is a disk at rest, with its own
/// error.
#[test]
fn a_disk_at_rest_is_no_periodic_orbit() {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.2).unwrap(), 0.5).unwrap();
    for speed in [1.0e-291, 1.0e-30, 1.0e-16] {
        let state = ImpactState::new(Phase::new(3.0).unwrap(), -speed).unwrap();
        let refused = map.refine(&[state]);
        assert!(
            matches!(
                refused,
                Err(Error::NoPlatformPeriods { impacts: 1, .. } | Error::ImpactWithoutSpeed { .. })
            ),
            "{speed}: {refused:?}"
        );
    }
    // From the separation: a launch with zero speed that flies.
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.5).unwrap(), 0.5).unwrap();
    let phase = map.vibration().separation_phase().unwrap();
    let refused = map.refine(&[ImpactState::new(phase, 0.0).unwrap()]);
    assert!(refused.is_err(), "{refused:?}");
}

/// Just before the platform stops falling away, a disk at rest leaves it and returns within a rounding of the
/// phase, with zero speed. This solves the shooting equations; the error is about the speed and not only
/// about the duration.
#[test]
fn a_solution_without_speed_is_refused_by_name() {
    for peak in [1.1, 1.25, 1.5, 1.75] {
        let vibration = Vibration::new(peak).unwrap();
        let end = PI - vibration.separation_phase().unwrap().angle();
        let refused = ImpactMap::new(vibration, 0.5).unwrap().refine(&[state(end.next_down(), 0.0)]);
        assert!(matches!(refused, Err(Error::ImpactWithoutSpeed { index: 0, .. })), "{peak}: {refused:?}");
    }
}

/// If the pull is a rounding error and flights are too short to change the phase, a disk once hopped forever
/// with a speed of 1e-39: at the end of the fall of a platform with P near 1, at the crest of P = 1, and at
/// the very end of the fall of any platform.
#[test]
fn a_disk_next_to_weightlessness_comes_to_rest() {
    for (peak, restitution, angle, speed) in [
        (1.000_000_000_000_000_2, 0.5, 1.570_796_347_957_139_2, 1.6e-39),
        (1.0, 0.5, 0.25 * TAU, 1.0e-60),
        (1.0, 1.0 / 3.0, 0.25 * TAU, 1.0e-60),
        (2.0, 0.5, 5.0 * TAU / 12.0, 1.0e-40),
        (2.0, 0.9, 5.0 * TAU / 12.0, 1.0e-50),
    ] {
        let vibration = Vibration::new(peak).unwrap();
        let end = vibration.separation_phase().map_or(0.0, |phase| 0.5 * TAU - phase.angle());
        let phase = Phase::new(angle.max(end)).unwrap();
        let map = ImpactMap::new(vibration, restitution).unwrap();
        let state = ImpactState::new(phase, -speed / restitution).unwrap();
        let mut impacts = 0;
        for event in map.orbit(state, ChatterPolicy::Complete) {
            match event.unwrap() {
                OrbitEvent::Impact(_) => impacts += 1,
                OrbitEvent::Attachment(stick) => {
                    assert!(stick.accumulation.error_bound <= 1.0e-16, "{stick:?}");
                    break;
                }
                event => panic!("{event:?}"),
            }
            assert!(impacts < 200, "P {peak}, r {restitution}, {phase:?}");
        }
    }
}

/// The paper's cut omits impacts without a bound on their effect; for a disk without rebound there are none
/// to omit.
#[test]
fn the_cut_of_the_paper_has_no_error_bound_unless_it_cuts_nothing() {
    for (restitution, bound) in [(0.5, f64::INFINITY), (0.0, 0.0)] {
        let attached = map(0.2, restitution).orbit(state(3.0, -2.0), PAPER_POLICY).find_map(|event| {
            match event.expect("no failure") {
                OrbitEvent::Attachment(stick) => Some(stick.accumulation.error_bound),
                _ => None,
            }
        });
        assert_eq!(attached, Some(bound), "{restitution}");
    }
}

/// A grid shifted by whole periods gives the labels of the period from 0 to 1; its phases were once rounded
/// in periods times 2 pi.
#[test]
fn grids_a_trillion_periods_away_have_the_same_phases() {
    let speed = Axis::new(0.0, 2.0, 2).unwrap();
    for whole in [-1.0e12, -3.0, 1.0, 1.0e6, 1.0e14] {
        let far = Grid::new(Axis::new(whole, whole + 1.0, 8).unwrap(), speed).unwrap();
        let near = Grid::new(Axis::new(0.0, 1.0, 8).unwrap(), speed).unwrap();
        for column in 0..8 {
            // Exact as long as sixteenths of a period are exact.
            assert_eq!(far.impact_angle(column).to_bits(), near.impact_angle(column).to_bits(), "{whole}");
        }
    }
}

/// Each of 600,000 short flights rotates the carried pair slightly away from its angle, which is not an error
/// of the clock.
#[test]
fn a_launch_after_a_long_chatter_keeps_time() {
    let map = ImpactMap::new(Vibration::new(2.0).unwrap(), 1.0 - 1.0e-9).unwrap();
    let mut state = state(2.9, -1.0e-6);
    state = map.iterate(state, 600_000, &Unobserved).unwrap();
    let impact = map.vibration().first_impact(Launch::new(state.phase(), 1.0).unwrap()).unwrap();
    assert!(impact.duration() > 0.5, "{impact:?}");
}

#[test]
fn what_is_printed_has_its_units() {
    let map = map(0.45, 0.5);
    assert_eq!(map.to_string(), "Gamma = 0.45 (P = 1.413716694115407), restitution 0.5");
    let state = state(1.0, -2.5);
    assert_eq!(format!("{state:.2}"), "impact at 1.00 rad, w = -2.50 g/omega");
    assert_eq!(Multipliers::Real(0.5, -0.25).to_string(), "0.5, -0.25");
    assert_eq!(format!("{:.1}", Multipliers::Complex { real: 0.0, imaginary: 1.0 }), "0.0 +- 1.0 i");
}

/// Refinement at and near the thresholds of existence and stability, and near restitution 0 and 1, gives a
/// true orbit by the map and its clock, or a specific error.
#[test]
fn orbits_refined_on_seams_are_orbits() {
    let (mut found, mut refused) = (0, 0);
    for restitution in
        [0.0, f64::MIN_POSITIVE, 1e-9, 0.5, 0.8, 1.0 - 1e-6, 1.0 - 1e-12, 1.0 - f64::EPSILON / 2.0]
    {
        for k in 1..=3_u32 {
            let birth = f64::from(k) * (1.0 - restitution) / (1.0 + restitution);
            let doubling = ImpactMap::first_doubling_forcing(restitution);
            for forcing in [birth, doubling, 1.5 * birth, 2.0 * doubling, 0.55] {
                for ulps in [-2_i64, -1, 0, 1, 2] {
                    let forcing = f64::from_bits((forcing.to_bits() as i64 + ulps) as u64);
                    let Ok(vibration) = Vibration::from_axial_forcing(forcing) else { continue };
                    let map = ImpactMap::new(vibration, restitution).expect("legal");
                    let Some(seed) = map.period_one(k.into()) else { continue };
                    match map.refine(&[seed]) {
                        Ok(orbit) => {
                            let (state, case) = (orbit.states[0], (restitution, k, forcing));
                            assert_eq!(orbit.platform_periods, u64::from(k), "{case:?}");
                            let impact = map.step(state).expect("flies");
                            let off = (impact.duration() - TAU * f64::from(k)).abs();
                            let scale = 1.0 + state.velocity().abs();
                            assert!(off <= 1e-11 * scale, "{case:?}: {off:e}");
                            assert!((impact.velocity - state.velocity()).abs() <= 1e-11 * scale, "{case:?}");
                            // Every impact contracts areas by the square of the restitution.
                            let determinant = orbit.monodromy.determinant();
                            let size = orbit.monodromy.x_axis.length() * orbit.monodromy.y_axis.length();
                            let lost = (determinant - restitution * restitution).abs();
                            assert!(lost <= 1e-13 * (1.0 + size), "{case:?}: {determinant}");
                            found += 1;
                        }
                        Err(
                            // A plastic disk leaves only if the platform falls away.
                            Error::NoLiftOff { .. }
                            | Error::NotSettled { .. }
                            | Error::ImpactWithoutSpeed { .. }
                            | Error::NoPlatformPeriods { .. },
                        ) => refused += 1,
                        Err(error) => panic!("{restitution} {k} {forcing}: {error}"),
                    }
                }
            }
        }
    }
    assert!(found > 200, "{found} found, {refused} refused");
}
