//! The map from release to release against an integration that knows only the law of the force, and its
//! limit of brief contacts.
//! For restitution 1/2 and contact times of 0.1, 0.01, 0.001 rad the first doubling lies 3.9e-3, 4.0e-4, 4.0e-5 from that of
//! rigid impacts, Gamma_1 = 0.4860 (second law: 2.1e-3, 2.2e-4, 2.2e-5).

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::{
    Attachment, ChatterPolicy, Error, ImpactMap, ImpactState, OrbitEvent, Phase, Vibration,
};
use bouncing_disk_drives::compliance::RelativeState;
use bouncing_disk_drives::{Drive, DrivenMap};

use crate::contacts::exponents;
use crate::launches::SplitMix;

fn state(phase: f64, velocity: f64) -> ImpactState {
    ImpactState::new(Phase::new(phase).unwrap(), velocity).unwrap()
}

fn sine(peak: f64, restitution: f64) -> DrivenMap {
    DrivenMap::new(Drive::fourier(&[(peak, 0.0)]).unwrap(), restitution).unwrap()
}

/// The next release after the one at this phase and speed, by steps of fourth order: a step in which the
/// force or the gap changes its sign is halved down to rounding.
fn integrated(map: &DrivenMap, peak: f64, [phase, speed]: [f64; 2]) -> [f64; 2] {
    let compliance = map.compliant().unwrap().compliance();
    let (k, c) = (compliance.stiffness(), compliance.damping());
    let force = |[y, v]: [f64; 2]| -k * y - c * v;
    let rate = |t: f64, [y, v]: [f64; 2], pressed: bool| {
        [v, peak * libm::sin(t) - 1.0 + if pressed { force([y, v]) } else { 0.0 }]
    };
    let step = |t: f64, x: [f64; 2], h: f64, pressed: bool| {
        let along = |k: [f64; 2], by: f64| [x[0] + by * k[0], x[1] + by * k[1]];
        let a = rate(t, x, pressed);
        let b = rate(t + 0.5 * h, along(a, 0.5 * h), pressed);
        let c = rate(t + 0.5 * h, along(b, 0.5 * h), pressed);
        let d = rate(t + h, along(c, h), pressed);
        [0, 1].map(|i| x[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]))
    };
    let longest = 1.0 / (300.0 * (1.0 + k.sqrt() + c));
    let (mut t, mut x, mut pressed) = (phase, [-c / k * speed, speed], false);
    // The force at the start is zero to within rounding.
    let slack = 1e-13 * (1.0 + c * speed);
    loop {
        let ended = |x: [f64; 2]| if pressed { force(x) < 0.0 } else { x[0] <= 0.0 && force(x) > slack };
        let (mut h, next) = (longest, step(t, x, longest, pressed));
        if !ended(next) {
            (t, x) = (t + h, next);
            continue;
        }
        let mut least = 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (least + h);
            if ended(step(t, x, middle, pressed)) {
                h = middle;
            } else {
                least = middle;
            }
        }
        (t, x) = (t + h, step(t, x, h, pressed));
        if pressed {
            return [t, x[1]];
        }
        pressed = true;
    }
}

/// The derivative of (phase, velocity of the impact) by differences of `step` over `by` to both sides.
fn differences(step: impl Fn([f64; 2]) -> [f64; 2], at: [f64; 2], by: f64) -> [f64; 4] {
    let column = |axis: usize| {
        let beside = |by: f64| {
            let mut at = at;
            at[axis] += by;
            step(at)
        };
        let (up, down) = (beside(by), beside(-by));
        let turn = up[0] - down[0] - TAU * ((up[0] - down[0]) / TAU).round();
        [turn / (2.0 * by), (up[1] - down[1]) / (2.0 * by)]
    };
    let [a, b] = [column(0), column(1)];
    [a[0], a[1], b[0], b[1]]
}

/// Contact times from a hundredth of a period to two periods, restitutions of 0.02 and 0.98, damping near the
/// critical one. Among 300 releases of each orbit: the steepest derivative, the slowest release, the slowest
/// touch and the first one.
#[test]
fn releases_and_their_derivatives_are_those_of_an_integration() {
    let mut random = SplitMix::new(0x50F7);
    let critical = libm::exp(-2.0);
    let (mut compared, mut slow, mut grazing, mut steep) = (0, 0, 0, 0);
    let restitutions = [0.02, critical, critical * (1.0 + 1e-9), 0.5, 0.98];
    for (restitution, hysteretic) in restitutions.into_iter().flat_map(|r| [(r, false), (r, true)]) {
        for share in [0.01, 0.3, 1.1, 2.0] {
            let peak = random.uniform(1.5, 12.0);
            let rigid = sine(peak, restitution);
            let soft = if hysteretic {
                rigid.with_hysteretic_contact(share * TAU)
            } else {
                rigid.with_contact_time(share * TAU)
            };
            let map = soft.unwrap();
            let platform = map.compliant().unwrap();
            let gap_by_speed = -platform.compliance().damping() / platform.compliance().stiffness();
            let mut at = state(random.uniform(0.0, TAU), -random.uniform(0.1, 2.0) * peak / restitution);
            let mut starts = Vec::new();
            for _ in 0..300 {
                let Ok((landing, derivative)) = map.step_with_derivative(at) else { break };
                let size = derivative.to_cols_array().iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                let speed = -at.velocity() * restitution;
                let from =
                    RelativeState { time: at.phase().angle(), gap: gap_by_speed * speed, velocity: speed };
                let touch = platform.touch(from, f64::INFINITY).unwrap().unwrap().state;
                // Near an edge of the map no difference is small enough.
                if speed > 1e-5 && size < 300.0 && touch.velocity.abs() > 1e-3 {
                    starts.push((at, size, speed, touch.velocity.abs()));
                }
                at = landing.impact.into();
            }
            let least =
                |key: fn(&Start) -> f64| starts.iter().copied().min_by(|a, b| key(a).total_cmp(&key(b)));
            let chosen = [least(|start| -start.1), least(|start| start.2), least(|start| start.3)];
            for (from, size, speed, touch) in chosen.into_iter().flatten().chain(starts.first().copied()) {
                let from = [from.phase().angle(), from.velocity()];
                let (landing, derivative) = map.step_with_derivative(state(from[0], from[1])).unwrap();
                let closed = |[phase, velocity]: [f64; 2]| {
                    let to = map.step(state(phase, velocity)).unwrap().impact;
                    [to.phase.angle(), to.velocity]
                };
                let own = |[phase, velocity]: [f64; 2]| {
                    let [t, v] = integrated(&map, peak, [phase, -restitution * velocity]);
                    [t, -v / restitution]
                };
                let found = derivative.to_cols_array();
                let near = |room: f64, numeric: [f64; 4]| {
                    let near = found.iter().zip(numeric).all(|(a, b)| (a - b).abs() < room * size);
                    assert!(near, "{restitution} {share} {from:?}: {found:?} {numeric:?}");
                };
                near(1e-5, differences(closed, from, 1e-4 / (size * size)));
                if !hysteretic {
                    let expected = own(from);
                    let late = expected[0] - from[0] - landing.impact.duration();
                    let fast = (expected[1] - landing.impact.velocity) / (1.0 - expected[1]);
                    assert!(
                        late.abs().max(fast.abs()) < 1e-8 * size,
                        "{restitution} {share} {from:?}: {late:e} {fast:e}"
                    );
                    near(1e-3, differences(own, from, 1e-3 / (size * size)));
                }
                compared += 1;
                slow += u32::from(speed < 0.05 * peak);
                grazing += u32::from(touch < 0.05 * peak);
                steep += u32::from(size > 30.0);
            }
        }
    }
    let seams = [compared, slow, grazing, steep];
    assert!(seams.iter().zip([150, 15, 5, 40]).all(|(found, least)| *found >= least), "{seams:?}");
}

/// Impact, size of the derivative, speeds of the release and of the next touch.
type Start = (ImpactState, f64, f64, f64);

/// From the same state; the release comes later than the impact by the contact.
#[test]
fn a_brief_contact_releases_as_a_rigid_impact_rebounds() {
    for (phase, velocity, restitution) in [(0.4, -5.0, 0.5), (2.0, -3.0, 0.9), (5.0, -20.0, 0.1)] {
        let rigid = sine(2.5, restitution);
        let there = rigid.step(state(phase, velocity)).unwrap().impact;
        let off = [1e-2, 1e-3, 1e-4, 1e-5].map(|time| {
            let soft = rigid.clone().with_contact_time(time).unwrap();
            let found = soft.step(state(phase, velocity)).unwrap().impact;
            let late = found.duration() - there.duration();
            late.abs() + (found.velocity - there.velocity).abs()
        });
        assert!(exponents(&off).iter().all(|&order| order > 0.9), "{off:?}");
    }
}

/// The orbit of period 1 at this forcing, its multipliers and its doubling tend to the rigid ones with
/// decreasing contact time.
#[test]
fn period_one_and_its_doubling_become_the_rigid_ones() {
    let forced = |forcing: f64| Vibration::from_axial_forcing(forcing).unwrap();
    let rigid = ImpactMap::new(forced(0.45), 0.5).unwrap().period_one(1).unwrap();
    let cascade = libm::hypot(1.0 / 3.0, 10.0 / 9.0 / PI);
    for make in [DrivenMap::with_contact_time, DrivenMap::with_hysteretic_contact] {
        let (mut orbits, mut doublings) = (Vec::new(), Vec::new());
        for time in [1e-1, 1e-2, 1e-3, 1e-4] {
            // Its impact, trace and determinant.
            let period_one = |forcing: f64, guess: ImpactState| {
                let map = DrivenMap::new(forced(forcing).into(), 0.5).unwrap();
                let orbit = make(map, time).unwrap().refine(&[guess]).unwrap();
                assert_eq!((orbit.period(), orbit.platform_periods), (1, 1), "{orbit:?}");
                let monodromy = orbit.monodromy;
                (orbit.states[0], monodromy.x_axis.x + monodromy.y_axis.y, monodromy.determinant())
            };
            let (at, _, determinant) = period_one(0.45, rigid);
            let phase = (at.phase().angle() - rigid.phase().angle()).abs();
            orbits.push(phase + (at.velocity() - rigid.velocity()).abs() + (determinant - 0.25).abs());
            // 1 + trace + determinant is zero if a multiplier is -1.
            let (mut low, mut high, mut guess) = (0.45, 0.52, at);
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                let (at, trace, determinant) = period_one(middle, guess);
                guess = at;
                (low, high) = if 1.0 + trace + determinant > 0.0 { (middle, high) } else { (low, middle) };
            }
            doublings.push((low - cascade).abs());
        }
        for off in [&orbits, &doublings] {
            let orders = exponents(off);
            assert!(off[3] < 1e-3 && orders.iter().all(|&order| order > 0.9), "{off:?} {orders:?}");
        }
    }
}

#[test]
fn orbits_are_chains_of_steps_and_end_where_the_disk_settles() {
    for share in [0.2, 1.0] {
        let map = sine(20.0, 0.5).with_contact_time(share * TAU).unwrap();
        let mut at = state(1.0, -40.0);
        let mut orbit = map.orbit(at, ChatterPolicy::Complete);
        for _ in 0..100 {
            let Some(OrbitEvent::Impact(landing)) = orbit.advance().unwrap() else { panic!("bounces") };
            assert_eq!(landing, map.step(at).unwrap().impact);
            at = landing.into();
        }
    }
    // A platform that never outruns the disk: with a damper the force becomes steady.
    let calm = sine(0.5, 0.5).with_contact_time(1.0).unwrap();
    let mut orbit = calm.of_flight(0.0, 1.0, 0.0, ChatterPolicy::Complete).unwrap();
    let last = (&mut orbit).last().unwrap().unwrap();
    assert!(
        matches!(last, OrbitEvent::Attachment(Attachment { accumulation, .. }) if accumulation.error_bound == 0.0)
    );
    assert_eq!(orbit.advance(), Ok(None));
    let settles = calm.of_contact(0.3, ChatterPolicy::Complete).advance().unwrap();
    let Some(OrbitEvent::Attachment(Attachment { accumulation, .. })) = settles else {
        panic!("{settles:?}")
    };
    let phase = (0.3 + accumulation.duration) / TAU;
    assert_eq!(accumulation.turns, phase as u64, "{accumulation:?}");
    let stays = calm.step(state(0.0, 0.0));
    assert!(matches!(stays, Err(Error::NoLiftOff { .. })), "{stays:?}");
    // A spring that loads and unloads forever, without a release.
    let turns = sine(0.3, 0.9).with_hysteretic_contact(1.0).unwrap();
    let event = turns.of_contact(0.0, ChatterPolicy::Complete).advance().unwrap();
    let Some(OrbitEvent::Attachment(Attachment { accumulation, .. })) = event else { panic!("{event:?}") };
    assert!(accumulation.error_bound.is_infinite());
    // A disk deeper than its equilibrium indentation is thrown off.
    let thrown = sine(3.0, 0.5).with_contact_time(1.0).unwrap();
    let event = thrown.of_contact(-1.2, ChatterPolicy::Complete).advance().unwrap();
    assert!(matches!(event, Some(OrbitEvent::Separation(change)) if change.velocity > 0.0), "{event:?}");
    for flight in [(f64::NAN, 0.0, 1.0), (0.0, -1.0, 1.0), (0.0, f64::NAN, 1.0), (0.0, 0.0, f64::NAN)] {
        let refused = thrown.of_flight(flight.0, flight.1, flight.2, ChatterPolicy::Complete);
        assert!(refused.is_err(), "{flight:?}");
    }
}

/// Flights through up to a million oscillations, from a spring that is not free at the release: the touch is
/// the first closing of the gap.
#[test]
fn long_flights_are_skipped() {
    for (peak, periods) in
        [1e4, 1e5, 1e6, 4e6].into_iter().flat_map(|peak| [1e-6, 1e-3, 0.1].map(|own| (peak, own)))
    {
        let map = sine(peak, 0.8).with_contact_time(periods * TAU).unwrap();
        let platform = map.compliant().unwrap();
        let compliance = platform.compliance();
        for phase in (0..12).map(|k| 0.1 + 0.5 * f64::from(k)) {
            let speed = 1.5 * peak;
            let start = -compliance.damping() / compliance.stiffness() * speed;
            let from = RelativeState { time: phase, gap: start, velocity: speed };
            let touch = platform.touch(from, f64::INFINITY).unwrap().unwrap();
            let gap = |t: f64| {
                let raised = libm::sin(phase + t) - libm::sin(phase);
                start + t * (speed + peak * libm::cos(phase) - 0.5 * t) - peak * raised
            };
            let flight = touch.duration;
            let rounding = 8.0 * f64::EPSILON * (flight * flight + peak);
            assert!(gap(flight).abs() <= rounding, "{peak} {periods} {phase}: {}", gap(flight));
            assert!(touch.state.gap == 0.0 && touch.state.velocity < 0.0);
            let on_the_way = (100..1000).map(|k| f64::from(k) / 1000.0 * flight);
            let at_last = (1..4000).map(|k| flight - 0.005 * f64::from(k));
            assert!(on_the_way.chain(at_last).all(|t| gap(t) > -rounding), "{peak} {periods} {phase}");
            assert!(map.step(state(phase, -speed / 0.8)).is_ok());
        }
    }
}
