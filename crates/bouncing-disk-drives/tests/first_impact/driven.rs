//! The map of drives: events, derivative, contact, chatter, periodic orbits, diagrams and basins.

use std::f64::consts::TAU;

use bouncing_disk_core::attractors::{AttractingMap as _, Axis, BasinSettings, Grid, KnownOrbit};
use bouncing_disk_core::orbits::OrbitSearch;
use bouncing_disk_core::sweep::orbit_diagram;
use bouncing_disk_core::{
    Attachment, ChatterCut, ChatterPolicy, Error, ImpactMap, ImpactState, Launch, OrbitEvent, Phase,
    Unobserved, Vibration,
};
use bouncing_disk_drives::{Drive, DrivenMap};

use crate::drives::KINDS;
use crate::launches::SplitMix;

/// A platform at rest, as a sum and as pieces: a parabola, however brief or long.
#[test]
fn a_drive_that_stands_still_is_a_floor() {
    for drive in
        [Drive::fourier(&[]).unwrap(), Drive::triangle(0.0).unwrap(), Drive::sampled(&[2.0; 5]).unwrap()]
    {
        for speed in [1e-250, 1e-12, 1e-3, 1.0, 3e4] {
            let landing = drive.first_impact_from(1.0, 0.0, speed).unwrap();
            let apart = (landing.impact.duration() - 2.0 * speed).abs();
            assert!(apart <= 4.0 * f64::EPSILON * 2.0 * speed, "{speed:e} {landing:?} {drive:?}");
        }
        let map = DrivenMap::new(drive, 0.5).unwrap();
        // Dropped from a height of 1 it rests after sqrt 2 (1 + r)/(1 - r).
        let mut time = 0.0;
        for event in map.of_flight(0.0, 1.0, 0.0, ChatterPolicy::Complete).unwrap() {
            time += match event.unwrap() {
                OrbitEvent::Impact(landing) => landing.duration(),
                OrbitEvent::Attachment(Attachment { accumulation, .. }) => accumulation.duration,
                other => panic!("{other:?}"),
            };
        }
        assert!((time - 3.0 * 2.0_f64.sqrt()).abs() < 1e-14, "{time}");
    }
}

#[test]
fn a_sine_as_a_fourier_sum_gives_the_events_of_the_sine() {
    for (forcing, restitution) in [(0.55, 0.5), (0.9, 0.3), (1.4, 0.8), (0.6, 0.0), (2.0, 0.5)] {
        let sine = ImpactMap::new(Vibration::from_axial_forcing(forcing).unwrap(), restitution).unwrap();
        let map = DrivenMap::new(Drive::from(*sine.vibration()), restitution).unwrap();
        let mut state = ImpactState::from_normalised(1.0, 1.3).unwrap();
        let mut attachments = 0;
        for event in sine.orbit(state, ChatterPolicy::Complete).take(300) {
            match event.unwrap() {
                OrbitEvent::Impact(impact) => state = impact.into(),
                OrbitEvent::Attachment(attachment) => {
                    attachments += 1;
                    // The chatter as a whole, from the impact after which the sine's chatter was summed.
                    let mut orbit = map.orbit(state, ChatterPolicy::Complete);
                    let end = orbit.find_map(|event| match event.unwrap() {
                        OrbitEvent::Attachment(Attachment { accumulation, .. }) => Some(accumulation),
                        _ => None,
                    });
                    let apart = (end.unwrap().phase.angle() - attachment.accumulation.phase.angle()).abs();
                    assert!(apart.min((TAU - apart).abs()) < 1e-12, "{forcing} {restitution}: {apart:e}");
                    let separation = orbit.next().map(|event| match event.unwrap() {
                        OrbitEvent::Separation(change) => change.phase.angle(),
                        other => panic!("{other:?}"),
                    });
                    let expected = attachment.separation.map(|(phase, _)| phase.angle());
                    assert_eq!(separation.is_some(), expected.is_some());
                    if let (Some(found), Some(expected)) = (separation, expected) {
                        assert!((found - expected).abs() < 1e-13);
                        let next = orbit.next().unwrap().unwrap();
                        let OrbitEvent::Impact(landing) = next else { panic!("{next:?}") };
                        let launch = Launch::new(Phase::new(expected).unwrap(), 0.0).unwrap();
                        let impact = sine.vibration().first_impact(launch).unwrap();
                        assert!((landing.duration() - impact.duration()).abs() < 1e-12);
                    }
                    if expected.is_none() {
                        break;
                    }
                    continue;
                }
                other => panic!("{other:?}"),
            }
        }
        assert!(attachments > 0 || forcing < 0.6 || restitution > 0.4, "{forcing} {restitution}");
    }
}

/// Central differences of the map, if neither end lands on a kink.
#[test]
fn the_derivative_is_that_of_differences() {
    let mut random = SplitMix::new(81);
    let mut compared = 0;
    while compared < 2_000 {
        let exact = KINDS[compared % KINDS.len()].draw(&mut random);
        let map = DrivenMap::new(exact.drive, 0.1 + 0.8 * random.unit()).unwrap();
        let (angle, speed) = (random.angle(), (1.0 + map.drive().bounds().speed) * random.uniform(0.2, 2.0));
        let state = |phase: f64, speed: f64| ImpactState::new(Phase::new(phase).unwrap(), -speed).unwrap();
        let Ok((landing, derivative)) = map.step_with_derivative(state(angle, speed)) else { continue };
        let step = 1e-6;
        let ends = [(step, 0.0), (0.0, step)].map(|(phase, faster)| {
            let ahead = map.step(state(angle + phase, speed - faster)).unwrap().impact;
            let behind = map.step(state(angle - phase, speed + faster)).unwrap().impact;
            let time = (ahead.duration() - behind.duration() + 2.0 * phase) / (2.0 * step);
            let joints = &exact.joints;
            let piece = |phase: f64| joints.partition_point(|&start| start <= phase.rem_euclid(TAU));
            let same = piece(ahead.phase.angle()) == piece(behind.phase.angle())
                && piece(angle + phase) == piece(angle - phase)
                && (ahead.duration() - behind.duration()).abs() < 1e-3;
            (same, time, (ahead.velocity - behind.velocity) / (2.0 * step))
        });
        // Near a graze the derivative is too large for the rounding of a difference.
        let steep = derivative.to_cols_array().iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
        let curved = map.drive().bounds().acceleration / landing.impact.velocity.abs();
        if !ends.iter().all(|(same, ..)| *same) || steep > 1e3 || curved > 30.0 {
            continue;
        }
        compared += 1;
        for ((_, time, velocity), column) in ends.iter().zip([derivative.x_axis, derivative.y_axis]) {
            let legal = 1e-5 * (1.0 + steep) * (1.0 + steep) * (1.0 + map.drive().bounds().jerk / 100.0);
            assert!(
                (time - column.x).abs() < legal,
                "{time} {} at {angle} {speed}: {derivative:?}",
                column.x
            );
            assert!((velocity - column.y).abs() < legal, "{velocity} {} {derivative:?}", column.y);
        }
        let area = map.restitution() * map.restitution() * speed / -landing.impact.velocity;
        assert!((derivative.determinant() - area).abs() < 1e-9 * (1.0 + steep * steep));
    }
}

/// By hand: on a triangle the impacts of period 1 may be anywhere on a slope u = 2 a/pi that they hit with
/// w = -2 pi/(1 + r), because the flight lasts 2 pi for any phase. This is a neutral family with the
/// multipliers 1 and r^2, if u = pi (1 - r)/(1 + r). Only phases nearer to the crest than the duration of the
/// flight above a slope, 2 r 2 pi/(1 + r), belong to it.
#[test]
fn the_triangle_has_a_neutral_family_of_period_one() {
    for restitution in [0.2, 0.5, 0.8] {
        let slope = 0.5 * TAU * (1.0 - restitution) / (1.0 + restitution);
        let map = DrivenMap::new(Drive::triangle(slope * 0.25 * TAU).unwrap(), restitution).unwrap();
        for phase in [0.3, 0.9, 1.4, 5.0] {
            let state = ImpactState::new(Phase::new(phase).unwrap(), -TAU / (1.0 + restitution)).unwrap();
            let (landing, derivative) = map.step_with_derivative(state).unwrap();
            let launch_speed = restitution * TAU / (1.0 + restitution);
            if (0.25 * TAU - phase).rem_euclid(TAU) > 2.0 * launch_speed {
                // Far before the crest the slope itself hits the disk first.
                assert!((landing.impact.duration() - 2.0 * launch_speed).abs() < 1e-14);
                continue;
            }
            assert!((landing.impact.duration() - TAU).abs() < 1e-14, "{restitution} {landing:?}");
            assert_eq!(landing.impact.turns, 1, "{restitution} {landing:?}");
            assert!((landing.impact.velocity - state.velocity()).abs() < 1e-14);
            assert!((derivative.x_axis.x - 1.0).abs() < 1e-13 && derivative.x_axis.y.abs() < 1e-13);
            assert!((derivative.determinant() - restitution * restitution).abs() < 1e-13);
        }
    }
}

/// On a slope u the disk hits the platform k periods and 2 pi k (sqrt(u/u_k) - 1) later with the speed of the
/// previous impact, u_k being pi k (1 - r)/(1 + r); the multipliers are 1 and r^2.
#[test]
fn impacts_of_one_speed_drift_along_a_slope() {
    let r = 0.6;
    let shapes: [fn(f64) -> Result<Drive, Error>; 2] =
        [Drive::triangle, |amplitude| Drive::sawtooth(amplitude, 0.25)];
    for (shape, periods, steeper) in [(0, 1.0, 1.0), (0, 2.0, 1.02), (1, 1.0, 1.0), (1, 2.0, 1.01)] {
        let shape = shapes[shape];
        let slope = steeper * 0.5 * TAU * periods * (1.0 - r) / (1.0 + r);
        let map = DrivenMap::new(shape(slope / shape(1.0).unwrap().velocity(0.0)).unwrap(), r).unwrap();
        let speed = (2.0 * TAU * periods * slope / (1.0 - r * r)).sqrt();
        let before = ImpactState::new(Phase::new(0.3).unwrap(), -speed).unwrap();
        let (landing, derivative) = map.step_with_derivative(before).unwrap();
        let late = landing.impact.phase.angle() - 0.3;
        assert!((late - TAU * periods * (f64::sqrt(steeper) - 1.0)).abs() < 1e-13, "{landing:?}");
        assert!((landing.impact.velocity + speed).abs() < 1e-12, "{landing:?}");
        assert!((derivative.x_axis.x - 1.0).abs() < 1e-12 && derivative.x_axis.y.abs() < 1e-12);
        assert!((derivative.determinant() - r * r).abs() < 1e-12);
        assert_eq!(landing.impact.turns, periods as u64);
    }
}

/// By hand, as for the sine: one impact per period needs the platform's velocity pi (1 - r)/(1 + r). On the
/// quadratic approximation this is one phase on each slope. The derivative has the same trace as for a sine
/// with the acceleration at this phase, and the determinant r^2.
#[test]
fn the_parabolas_have_the_period_one_orbit_derived_by_hand() {
    let (r, amplitude) = (0.5, 1.3);
    let map = DrivenMap::new(Drive::parabolas(amplitude).unwrap(), r).unwrap();
    let velocity = 0.5 * TAU * (1.0 - r) / (1.0 + r);
    let bend = 32.0 * amplitude / (TAU * TAU);
    // 8 a/(2 pi) - bend t = velocity, on the arc that is concave.
    let phase = (8.0 * amplitude / TAU - velocity) / bend;
    let orbit = map
        .refine(&[ImpactState::new(Phase::new(phase + 0.05).unwrap(), -TAU / (1.0 + r) * 1.02).unwrap()])
        .unwrap();
    assert!((orbit.states[0].phase().angle() - phase).abs() < 1e-12 && orbit.platform_periods == 1);
    let trace = orbit.monodromy.x_axis.x + orbit.monodromy.y_axis.y;
    let expected = (1.0 + r) * (1.0 + r) * (1.0 - bend) - 2.0 * r;
    assert!((trace - expected).abs() < 1e-11, "{trace} {expected}");
    assert!((orbit.monodromy.determinant() - r * r).abs() < 1e-12);
}

#[test]
fn the_search_on_a_sum_finds_the_orbits_of_the_sine() {
    let sine = ImpactMap::new(Vibration::from_axial_forcing(0.55).unwrap(), 0.5).unwrap();
    let map = DrivenMap::new(Drive::from(*sine.vibration()), 0.5).unwrap();
    let search = OrbitSearch::new(2, 4).unwrap().with_starts(24, 24).unwrap();
    let expected = sine.periodic_orbits(&search, &Unobserved).unwrap().orbits;
    let found = map.periodic_orbits(&search, &Unobserved).unwrap();
    assert!(!expected.is_empty());
    for orbit in &expected {
        let same = |other: &&bouncing_disk_core::orbits::PeriodicOrbit| {
            other.period() == orbit.period()
                && other.states.iter().any(|state| {
                    (state.phase().angle() - orbit.states[0].phase().angle()).abs() < 1e-9
                        && (state.velocity() - orbit.states[0].velocity()).abs() < 1e-9
                })
        };
        let other = found.iter().find(same).expect("found");
        let trace = |m: glam::DMat2| m.x_axis.x + m.y_axis.y;
        assert!(
            (trace(other.monodromy) - trace(orbit.monodromy)).abs()
                < 1e-9 * (1.0 + trace(orbit.monodromy).abs())
        );
    }
    assert_eq!(found.len(), expected.len());
}

#[test]
fn basins_and_diagrams_of_a_sum_are_those_of_the_sine() {
    let sine = ImpactMap::new(Vibration::from_axial_forcing(0.45).unwrap(), 0.5).unwrap();
    let map = DrivenMap::new(Drive::from(*sine.vibration()), 0.5).unwrap();
    let known = [KnownOrbit::new(sine.refine(&[sine.period_one(1).unwrap()]).unwrap(), 1e-3).unwrap()];
    let grid = Grid::new(Axis::new(0.0, 1.0, 40).unwrap(), Axis::new(0.0, 3.0, 40).unwrap()).unwrap();
    let settings = BasinSettings::default();
    let expected = sine.basins(grid, &known, settings, &Unobserved).unwrap();
    let found = map.basins(grid, &known, settings, &Unobserved).unwrap();
    assert_eq!(found.labels(), expected.labels());
    let start = ImpactState::from_normalised(1.0, 1.3).unwrap();
    let columns = orbit_diagram(&[map.orbit(start, ChatterPolicy::Complete)], 500, 4, &Unobserved).unwrap();
    let column = orbit_diagram(&[sine.orbit(start, ChatterPolicy::Complete)], 500, 4, &Unobserved).unwrap();
    for (a, b) in columns[0].iter().zip(&column[0]) {
        assert!((a.phase().angle() - b.phase().angle()).abs() < 1e-9);
    }
    assert_eq!(columns[0].len(), 4);
}

/// A disk that rests on a triangle is left behind at each crest, where the velocity drops, and would be hit
/// at each trough.
#[test]
fn a_triangle_leaves_the_disk_behind_and_hits_it() {
    let drive = Drive::triangle(1.0).unwrap();
    let drop = 4.0 / (0.5 * TAU);
    let map = DrivenMap::new(drive, 0.0).unwrap();
    let mut orbit = map.of_contact(0.3, ChatterPolicy::Complete);
    let Some(Ok(OrbitEvent::Separation(crest))) = orbit.next() else { panic!("leaves at the crest") };
    assert_eq!(crest.phase.angle().to_bits(), (0.25 * TAU).to_bits());
    assert!((crest.velocity - drop).abs() < 1e-15 && (crest.duration - (0.25 * TAU - 0.3)).abs() < 1e-15);
    let Some(Ok(OrbitEvent::Impact(landing))) = orbit.next() else { panic!("lands") };
    assert!((landing.duration() - 2.0 * drop).abs() < 1e-14);
    // On the falling slope it stays until the trough hits it, and then sticks (r = 0) until the next crest.
    let Some(Ok(OrbitEvent::Attachment(_))) = orbit.next() else { panic!("attaches") };
    let Some(Ok(OrbitEvent::Kick(trough))) = orbit.next() else { panic!("is hit") };
    assert!(
        (trough.velocity + drop).abs() < 1e-15 && trough.phase.angle().to_bits() == (0.75 * TAU).to_bits()
    );
    let Some(Ok(OrbitEvent::Attachment(_))) = orbit.next() else { panic!("attaches") };
    let Some(Ok(OrbitEvent::Separation(again))) = orbit.next() else { panic!("leaves again") };
    assert!(again.turns == 1 && (again.duration - 0.5 * TAU).abs() < 1e-14);
    // An impact on the kink has no derivative.
    let on_kink = ImpactState::new(Phase::new(0.25 * TAU).unwrap(), -1.0).unwrap();
    let bouncing = DrivenMap::new(Drive::triangle(1.0).unwrap(), 0.5).unwrap();
    assert!(matches!(bouncing.step_with_derivative(on_kink), Err(Error::ImpactOnKink { .. })));
}

/// A completed chatter ends at the same point as one followed to its last digit.
#[test]
fn the_sum_of_a_chatter_is_where_it_ends() {
    let mut random = SplitMix::new(91);
    let never = ChatterPolicy::Cut(ChatterCut::new(0.0, 0.0, u32::MAX).unwrap());
    let mut compared = 0;
    while compared < 400 {
        let exact = KINDS[compared % KINDS.len()].draw(&mut random);
        let map = DrivenMap::new(exact.drive, random.uniform(0.0, 0.9)).unwrap();
        let (time, speed) = (random.angle(), random.decades(-9.0, -5.0));
        let Some(sum) = map.drive().chatter_duration(time, speed, map.restitution()) else { continue };
        let mut orbit = map.of_flight(time, 0.0, speed, never).unwrap();
        let mut elapsed = 0.0;
        while elapsed < 2.0 * sum.duration {
            match orbit.next() {
                Some(Ok(OrbitEvent::Impact(landing))) if -landing.velocity > 1e-30 => {
                    elapsed += landing.remainder;
                }
                _ => break,
            }
        }
        // The phase at which each flight begins is rounded, and so is the pull at this phase.
        let rounding = 1e-13 * sum.duration * (1.0 + map.drive().bounds().jerk);
        assert!(
            (elapsed - sum.duration).abs() <= sum.error + rounding,
            "{elapsed:e} {sum:?} {time} {speed:e}"
        );
        compared += 1;
    }
}

#[test]
fn a_disk_that_separates_flies() {
    let mut random = SplitMix::new(95);
    let mut separated = 0;
    while separated < 3_000 {
        let exact = KINDS[separated % KINDS.len()].draw(&mut random);
        let map = DrivenMap::new(exact.drive, 0.5).unwrap();
        let mut orbit = map.of_contact(random.angle(), ChatterPolicy::Complete);
        let Some(event) = orbit.next() else { continue };
        let next = match event.unwrap() {
            OrbitEvent::Separation(change) => {
                assert!(change.velocity >= 0.0);
                orbit.next().unwrap().unwrap()
            }
            OrbitEvent::Kick(_) => continue,
            other => panic!("{other:?}"),
        };
        let OrbitEvent::Impact(landing) = next else { panic!("{next:?}") };
        assert!(landing.duration() > 1e-6, "{landing:?} on {:?}", map.drive());
        separated += 1;
    }
}

/// Drives whose force nearly touches zero: a contact that ends there is followed by a flight to another time,
/// so the two cannot alternate forever.
#[test]
fn a_contact_and_a_flight_do_not_alternate_at_one_time() {
    let mut random = SplitMix::new(96);
    let (mut flights, mut held) = (0, 0);
    for k in 0..600 {
        let harmonics: Vec<_> = (0..=random.below(3)).map(|_| (random.unit(), random.angle())).collect();
        let make = |a: f64| match k % 3 {
            0 => Drive::cubics(a).unwrap(),
            1 => Drive::fourier(&harmonics.iter().map(|(b, angle)| (a * b, *angle)).collect::<Vec<_>>())
                .unwrap(),
            _ => {
                let sum = Drive::fourier(&harmonics).unwrap();
                let heights = (0..24).map(|k| a * sum.height(f64::from(k) / 24.0 * TAU));
                Drive::sampled(&heights.collect::<Vec<_>>()).unwrap()
            }
        };
        let unit = make(1.0);
        let force = |time: f64| unit.acceleration(time);
        // The lowest of samples that include the joints, refined by bisection.
        let (mut touch, mut step) = (0.0, TAU / 480.0);
        for sample in 0..480 {
            let time = f64::from(sample) / 480.0 * TAU;
            touch = if force(time) < force(touch) { time } else { touch };
        }
        while step > 1e-9 {
            let sides = [touch - step, touch + step];
            match sides.into_iter().find(|&time| force(time) < force(touch)) {
                Some(lower) => touch = lower,
                None => step *= 0.5,
            }
        }
        let size = 1.0 + random.sign() * random.decades(-17.0, -6.0);
        let drive = make(size / -force(touch));
        let map = DrivenMap::new(drive, if k % 2 == 0 { 0.0 } else { 0.5 }).unwrap();
        let nudge = random.sign() * random.decades(-17.0, -6.0);
        for start in [touch + nudge, touch, random.angle()] {
            let mut orbit = map.of_contact(start, ChatterPolicy::Complete);
            for _ in 0..60 {
                let from = orbit.launch();
                match orbit.next() {
                    Some(Ok(OrbitEvent::Impact(landing))) => {
                        flights += 1;
                        let launch = from.expect("it was in the air");
                        let at_once =
                            launch.1 == 0.0 && landing.phase.angle().to_bits() == launch.0.to_bits();
                        assert!(!at_once, "{launch:?} {landing:?} {:?}", map.drive());
                    }
                    Some(event) => drop(event.unwrap()),
                    None => {
                        held += 1;
                        break;
                    }
                }
            }
        }
    }
    assert!(flights > 100 && held > 100, "{flights} {held}");
}
