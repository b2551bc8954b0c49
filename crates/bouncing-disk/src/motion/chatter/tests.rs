use std::convert::Infallible;

use bouncing_disk_core::Launch;
use bouncing_disk_core::chatter::Accumulation;
use bouncing_disk_core::numerics::elementary::pow;
use bouncing_disk_core::numerics::roots::bisected_bracket;

use super::*;
use crate::parameters::dimensionless::DimensionlessParameters;
use crate::testing::golden_spread;

/// Largest number of pieces of a chatter, and the number with rounding near restitution 1, where 50 impacts
/// change a share by as little as rounding does.
const MOST_PIECES: u32 = 6;
const MOST_ROUNDED_PIECES: u32 = 32;

/// A chatter that the complete policy sums, at its start.
#[derive(Debug)]
struct Case {
    system: DimensionlessSystem,
    phase: Phase,
    speed: f64,
    spin: f64,
    at: Accumulation,
}

impl Case {
    fn start(&self) -> Chatter {
        Chatter::before(self.phase, self.speed, self.spin)
    }

    fn in_closed_form(&self, duration: f64) -> Chatter {
        let mut chatter = self.start();
        let pieces = chatter.sum(&self.system, self.phase, duration);
        let rounded = 1.0 - self.system.restitution() < 1e-13;
        let most = if rounded { MOST_ROUNDED_PIECES } else { MOST_PIECES };
        assert!(pieces <= most, "{pieces} {self:?}");

        chatter
    }

    fn one_by_one(&self, duration: f64) -> Chatter {
        let mut alone = [(&self.system, self.start())];
        Chatter::go_through(&mut alone, self.phase, duration);
        alone[0].1
    }
}

/// The rotary closure is relative to the magnitudes of the terms that balance: the work, and the loss that the
/// whole slip would cause.
#[test]
fn an_impact_adds_its_work_and_its_slip_to_the_terms_that_balance() {
    let mut ledger = EnergyLedger::default();
    // An axial impulse of 1.5, a slip of -3 and an angular impulse of 0.5.
    let done = impact(&mut ledger, (1.0 / 3.0, 0.5), [-1.0, 0.25], [-3.75, -0.75]);
    assert!((done.axial - 1.5).abs() < 1e-15 && (done.rotary - 0.5).abs() < 1e-15, "{done:?}");
    assert!((ledger.rotary_magnitude - (0.375 + 1.5)).abs() < 1e-15, "{ledger:?}");
    assert!((ledger.friction_loss - 0.5 * 2.75).abs() < 1e-15, "{ledger:?}");
}

/// Rotors with different friction, twist, load and speed, on the vertical motion that they share.
#[test]
fn rotors_on_one_vertical_motion_chatter_as_each_alone() {
    for restitution in [0.0, 0.5, 1.0 - 1e-9] {
        let cases: Vec<Case> = cases(restitution, 1.3, 40).collect();
        assert!(cases.len() > 4, "{restitution}");
        for Case { phase, speed, at, .. } in &cases {
            let rotors = cases.iter().map(|case| (&case.system, case.spin));
            let alone = |case: &Case| Chatter::new(&case.system, *phase, *speed, case.spin, at.duration);
            let alone: Vec<Chatter> = cases.iter().map(alone).collect();
            assert_eq!(Chatter::of_rotors(rotors, *phase, *speed, at.duration), alone);
        }
    }
}

/// Largest launch speed with which the disk attaches; `None` if the platform does not pull back.
fn largest_speed(system: &DimensionlessSystem, phase: Phase) -> Option<f64> {
    let accepted = |exponent: f64| {
        let speed = pow(10.0, exponent);
        system.map().accumulation(Launch::new(phase, speed).unwrap()).map(|_| speed)
    };
    accepted(-150.0)?;
    let is_slow = |exponent: f64| Ok::<_, Infallible>(accepted(exponent).is_some());
    let Ok((slow, _)) = bisected_bracket(-150.0, 0.0, 40, is_slow);
    accepted(slow)
}

/// Chatters of every kind: with and without friction and twist, with loads that friction just holds, slips
/// from zero to one that outlasts the chatter, and phases up to a separation.
fn cases(restitution: f64, peak_acceleration: f64, count: u64) -> impl Iterator<Item = Case> {
    (0..count).filter_map(move |k| {
        let pick = |stride: u64| golden_spread(stride * k + stride / 3);
        let friction = [0.0, 0.3, 1.0, 0.01][(k % 4) as usize];
        let system = DimensionlessParameters {
            peak_acceleration,
            twist_speed: [0.0, 1.0, 0.3, 1e-3, 100.0][(k / 3 % 5) as usize],
            phase_lag: 6.0 * pick(5) - 3.0,
            friction,
            restitution,
            load: [0.0, 0.2, -0.2, 0.29, 0.3, -3.0, 0.5 * (1.0 + restitution) * friction]
                [(k / 4 % 7) as usize],
        }
        .build()
        .unwrap();
        let phase = match (k % 3, system.vibration().separation_phase()) {
            (0, Some(at)) => Phase::new(at.angle() - pow(10.0, -1.0 - 12.0 * pick(7))).unwrap(),
            _ => Phase::new(std::f64::consts::TAU * pick(11)).unwrap(),
        };
        let speed = largest_speed(&system, phase)? * [1.0, 0.3, 1e-3][(k % 3) as usize];
        let at = system.map().accumulation(Launch::new(phase, speed).unwrap())?;
        let slip = match k % 5 {
            0 => 0.0,
            1 => 1e3,
            2 => friction * at.duration * (2.0 * pick(13) - 1.0),
            3 => at.duration * (pick(17) - 0.5),
            _ => -friction * at.duration * (1.0 - restitution) * 3.0 * pick(19),
        };
        let spin = system.platform_angular_speed(phase) + slip;
        Some(Case { system, phase, speed, spin, at })
    })
}

const PEAKS: [f64; 7] = [0.0, 1e-9, 0.5, 1.0, 1.000_000_267_196_965_4, 2.0, 197.39];

/// Magnitudes to which the rounding of a chatter is relative.
struct Scales {
    /// The magnitude of the impulses, including the rounding of the pull near a separation.
    impulse: f64,
    speed: f64,
    angle: f64,
}

impl Scales {
    fn of(case: &Case, chatter: &Chatter) -> Self {
        let (system, duration) = (&case.system, case.at.duration);
        let forces = system.friction() + system.load().abs() + system.twist_speed();
        // The duration is exact to its bound only, 1e-16.
        let speed = system.twist_speed() + case.spin.abs() + forces * (duration + 1e-4);
        Self {
            impulse: chatter.axial_impulse + 1e-2 * (1.0 + system.peak_acceleration()) * duration,
            speed,
            angle: speed * (duration + 1e-4),
        }
    }
}

fn assert_near(name: &str, closed: f64, counted: f64, scale: f64, tolerance: f64, case: &Case) {
    assert!((closed - counted).abs() <= tolerance * scale, "{name}: {closed:e}, {counted:e} {case:?}");
}

/// The closed form agrees with the loop over impacts in all cases that both can handle.
#[test]
fn sums_in_closed_form_are_those_of_the_impacts_one_by_one() {
    for restitution in [1.0 / 1024.0, 0.5, 0.9, 0.99, 0.999] {
        // The loop adds up 39/(1 - r) roundings.
        let tolerance = 2e-12 + 1e-15 / (1.0 - restitution);
        for case in PEAKS.into_iter().flat_map(|peak| cases(restitution, peak, 240)) {
            let (closed, counted) =
                (case.in_closed_form(case.at.duration), case.one_by_one(case.at.duration));
            let system = &case.system;
            let scales = Scales::of(&case, &closed);
            let near = |name: &str, of: fn(&Chatter) -> f64, scale: f64| {
                assert_near(name, of(&closed), of(&counted), scale, tolerance, &case);
            };
            near("axial impulse", |chatter| chatter.axial_impulse, scales.impulse);
            near("angular impulse", |chatter| chatter.angular_impulse, scales.speed);
            near("restitution", |chatter| chatter.ledger.restitution_loss, scales.impulse * scales.impulse);
            let work = scales.impulse * system.peak_acceleration();
            near("normal work", |chatter| chatter.ledger.normal_work, work);
            let energy = scales.speed * scales.speed;
            near("friction loss", |chatter| chatter.ledger.friction_loss, energy);
            near("friction work", |chatter| chatter.ledger.friction_work, energy);
            // The remainder after the loop's last impact.
            let rest = case.at.duration - counted.time;
            let angle = counted.angle + rest * counted.angular_speed;
            assert_near("angle", closed.angle, angle, scales.angle, tolerance, &case);
            let speed = counted.angular_speed - if closed.capped { 0.0 } else { rest * system.load() };
            assert_near("speed", closed.angular_speed, speed, scales.speed, tolerance, &case);
            // The loop ends where its time passes the duration, which is exact to 1e-16.
            assert!(counted.impacts <= closed.impacts + 1, "{case:?}");
        }
    }
}

/// The two also agree in the middle of a chatter, in the state after the last impact before that time.
#[test]
fn the_middle_of_a_chatter_is_that_of_the_impacts_one_by_one() {
    for restitution in [0.5, 0.9, 0.99, 0.999] {
        let tolerance = 2e-12 + 1e-15 / (1.0 - restitution);
        for case in [0.0, 0.5, 2.0].into_iter().flat_map(|peak| cases(restitution, peak, 60)) {
            if case.speed < 1e-12 {
                continue;
            }
            for share in [0.0, 1e-3, 0.1, 0.37, 0.5, 0.9, 0.999] {
                let time = share * case.at.duration;
                let (closed, counted) = (case.in_closed_form(time), case.one_by_one(time));
                let scales = Scales::of(&case, &closed);
                assert_eq!(closed.impacts, counted.impacts, "{share} {case:?}");
                assert!(closed.time <= time);
                let near = |name: &str, of: fn(&Chatter) -> f64, scale: f64| {
                    assert_near(name, of(&closed), of(&counted), scale, tolerance, &case);
                };
                near("time", |chatter| chatter.time, case.at.duration + 1e-3);
                near("launch", |chatter| chatter.launch_speed, scales.impulse);
                near("speed", |chatter| chatter.angular_speed, scales.speed);
                near("angle", |chatter| chatter.angle, scales.angle);
                near("impulse", |chatter| chatter.axial_impulse, scales.impulse);
            }
        }
    }
}

/// Cases with millions of impacts, which the loop can still follow.
#[test]
fn millions_of_impacts_agree_with_the_closed_form() {
    let restitution = 1.0 - 1e-5;
    for case in [0.0, 0.5, 2.0].into_iter().flat_map(|peak| cases(restitution, peak, 5)) {
        let (closed, counted) = (case.in_closed_form(case.at.duration), case.one_by_one(case.at.duration));
        let scales = Scales::of(&case, &closed);
        assert!(counted.impacts > 3_900_000);
        assert_near("axial", closed.axial_impulse, counted.axial_impulse, scales.impulse, 1e-10, &case);
        assert_near("speed", closed.angular_speed, counted.angular_speed, scales.speed, 1e-10, &case);
    }
}

/// Friction just holds a load in every impact, to the last bit. Rounding may decide at each of these impacts,
/// but the pieces remain few.
#[test]
fn friction_at_its_limit_takes_few_pieces() {
    for restitution in [0.9, 0.999, 1.0 - 1e-7, 1.0 - f64::EPSILON / 2.0] {
        for k in 0..2_000_u64 {
            let friction = 0.1 + golden_spread(k);
            let limit = 0.5 * (1.0 + restitution) * friction;
            // A few units in the last place about the limit, or the platform's own speed on either side of
            // it.
            let load = limit + limit * f64::EPSILON * (golden_spread(7 * k) * 9.0 - 4.0).round();
            let twist_speed = [0.0, 0.0, limit, 3.0 * limit][(k % 4) as usize];
            let phase_lag = if k % 8 < 4 { 0.0 } else { golden_spread(11 * k) };
            let system = DimensionlessParameters {
                peak_acceleration: if k % 3 == 0 { 0.5 } else { 0.0 },
                twist_speed,
                phase_lag,
                friction,
                restitution,
                load: if k % 4 < 2 { load } else { 0.3 * limit },
            }
            .build()
            .unwrap();
            // For twisting platforms, near the phase at which its acceleration uses the torque that the load
            // leaves.
            let phase = Phase::new(golden_spread(13 * k) * std::f64::consts::TAU).unwrap();
            let Some(speed) = largest_speed(&system, phase) else { continue };
            let launch = Launch::new(phase, speed).unwrap();
            let Some(at) = system.map().accumulation(launch) else { continue };
            let slips = [0.0, 1e-3 * limit * at.duration, -1e-17];
            let spin = system.platform_angular_speed(phase) + slips[(k % 3) as usize];
            let case = Case { system, phase, speed, spin, at };
            for share in [0.3, 1.0] {
                let closed = case.in_closed_form(share * at.duration);
                let ledger = &closed.ledger;
                assert!(ledger.rotary_closure().abs() <= 1e-13 * ledger.rotary_magnitude, "{case:?}");
            }
        }
    }
}

/// A slip that should end in a given impact, exactly or nearly, ends there or in the next one.
#[test]
fn a_slip_that_ends_in_an_impact_ends_there() {
    for restitution in [0.9, 0.999] {
        for case in cases(restitution, 0.0, 60) {
            let system = &case.system;
            if system.friction() == 0.0 || system.twist_speed() > 0.0 || system.load() != 0.0 {
                continue;
            }
            let series = system.map().chatter_series(Launch::new(case.phase, case.speed).unwrap());
            let impulses = series.impact_speed().scaled(1.0 + restitution);
            for impacts in [1, 2, 3, 40, 300] {
                let range = series.range(0, Some(impacts));
                for ulps in -2..=2 {
                    let slip = system.friction() * range.sum(&impulses);
                    let spin = slip + slip * f64::EPSILON * f64::from(ulps);
                    let case = Case { spin, system: *system, ..case };
                    let closed = case.in_closed_form(case.at.duration);
                    assert!(closed.capped && closed.angular_speed == 0.0, "{closed:?}");
                    let loss = 0.5 * spin * spin;
                    assert!((closed.ledger.friction_loss - loss).abs() <= 1e-13 * loss);
                }
            }
        }
    }
}

/// A chatter equals its flights and impacts one by one, here computed as the first impacts of single launches.
/// Against a load, the disk slides throughout in the first impacts, and friction stops the slip in later ones.
#[test]
fn a_chatter_is_its_impacts_one_by_one() {
    let system = DimensionlessParameters {
        peak_acceleration: 0.5,
        twist_speed: 0.4,
        phase_lag: 0.3,
        friction: 0.2,
        restitution: 0.5,
        load: 0.05,
    }
    .build()
    .expect("legal");
    let start = Phase::new(1.0).expect("finite");
    let (friction, restitution, load) = (0.2, 0.5, 0.05);
    for (spin, longest) in [(0.2, 1.0), (0.2, 2e-3), (-0.3, 1.0), (-0.3, 4.5e-3), (0.135, 1.0), (0.135, 1e-3)]
    {
        let speed = 1e-3;
        let (mut phase, mut launch, mut spin_now) = (start, speed, spin);
        let (mut time, mut angle, mut impacts, mut axial, mut angular) = (0.0, 0.0, 0, 0.0, 0.0);
        let mut friction_loss = 0.0;
        while launch > 1e-14 * speed {
            let impact =
                system.vibration().first_impact(Launch::new(phase, launch).expect("legal")).expect("returns");
            if time + impact.remainder > longest {
                break;
            }
            time += impact.remainder;
            angle += impact.remainder * (spin_now - 0.5 * load * impact.remainder);
            spin_now -= load * impact.remainder;
            phase = impact.phase;
            let slip = spin_now - system.platform_angular_speed(phase);
            let push = -(1.0 + restitution) * impact.velocity;
            let impulse = -slip.signum() * slip.abs().min(friction * push);
            // The loss is the whole energy of the slip; the platform contributes nothing.
            friction_loss += 0.5 * (slip * slip - (slip + impulse) * (slip + impulse));
            spin_now += impulse;
            launch = -restitution * impact.velocity;
            (impacts, axial, angular) = (impacts + 1, axial + push, angular + impulse);
        }
        let own = Chatter::new(&system, start, speed, spin, longest);
        let near = |own: f64, other: f64| (own - other).abs() <= 1e-11 * other.abs();
        // The last impacts of the two methods are determined to different shares of the first one.
        assert!(longest < 1.0 || own.impacts > impacts && own.impacts < impacts + 12, "{own:?} {impacts}");
        assert!(longest >= 1.0 || own.impacts == impacts && near(own.launch_speed, launch), "{own:?}");
        assert!(near(own.time, time) && near(own.angle, angle), "{own:?} {time} {angle}");
        assert!((own.angular_speed - spin_now).abs() < 1e-14, "{own:?} {spin_now}");
        assert!(near(own.axial_impulse, axial) && near(own.angular_impulse, angular), "{own:?}");
        assert!((own.ledger.friction_loss - friction_loss).abs() < 1e-15, "{own:?} {friction_loss}");
        let velocity = launch + system.vibration().velocity(phase);
        assert!((own.launch_velocity(&system) - velocity).abs() < 1e-13, "{own:?} {velocity}");
        assert!((own.pair.0 - phase.sin()).abs() < 1e-14 && (own.pair.1 - phase.cos()).abs() < 1e-14);
    }
}
