//! Tosses by a hand with any periodic motion (Secs. III and IV).

use bouncing_disk_core::{ChatterPolicy, Observer, Phase};
use bouncing_disk_drives::DrivenMap;

use super::ground::DrivenEngine;
use super::{DrivenStart, DrivenSystem};
use crate::error::{Error, check};
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Event, SteeredMotion};
use crate::parameters::disk::Disk;
use crate::parameters::driven_platform::DrivenPlatform;
use crate::toss::collisions::Collisions;
use crate::toss::multiple::settle;
use crate::toss::{InitialSpin, MultiTossSettings, TossOrbit, TossPerformance};

/// Number of events without a separation after which a disk counts as never leaving; without restitution, a
/// disk may be hit at each kink for ever.
const MOST_CONTACT_EVENTS: usize = 10_000;

/// The toss of a disk that lies on the hand at `phase`, until the hand falls away from it or a kink throws
/// it. If `phase` is `None`, the toss starts at the hand's [lowest
/// point](bouncing_disk_drives::Drive::lowest_phase), as in the paper. A hand that moves at `phase` has
/// already given the disk its velocity: a disk that starts on a kink moves with the hand after the kink, and
/// is not hit. The speed ratio uses the hand's largest rotary speed with this waveform.
///
/// # Errors
/// [`Error::NeverLeaves`] if the dough stays on the hand; [`Error::OutOfRange`] for a phase at which the hand
/// already falls away; the errors of [`DrivenSystem::new`].
pub fn single_toss(
    platform: &DrivenPlatform,
    disk: &Disk,
    phase: Option<Phase>,
    initial: InitialSpin,
) -> Result<TossPerformance, Error> {
    let (system, scales) = (DrivenSystem::new(platform, disk)?, platform.scales(disk));
    let phase = phase.map_or_else(|| Phase::new(system.height().lowest_phase()), Ok)?;
    let peak_acceleration = system.height().bounds().acceleration;
    let sine = platform.platform();
    // For the sine this is omega Phi to the last bit.
    let nominal = sine.twist_amplitude() / scales.angle;
    let share = if nominal > 0.0 { system.angle().peak_speed() / nominal } else { 0.0 };
    let peak = share * sine.peak_angular_speed();
    let start = system.height().at(phase.angle());
    let angular_speed = match initial {
        InitialSpin::AbsoluteRest => 0.0,
        InitialSpin::RestRelativeToHand => system.angle().velocity(phase.angle()),
    };
    let rim_speed = disk.gyration_radius() * angular_speed * scales.angular_speed;
    let mut ledger = EnergyLedger::default();
    ledger.record_normal(0.5 * start.velocity * start.velocity, 0.0);
    ledger.record_axial_change([0.0, start.velocity], [start.height; 2]);
    let start = DrivenStart::Contact { phase, angular_speed };
    let engine = DrivenEngine::new(system, start, ChatterPolicy::Complete)?;
    check(
        !engine.launches(),
        "phase of the start",
        phase.angle(),
        "a phase at which the hand does not fall away from the disk",
    )?;
    for record in engine.take(MOST_CONTACT_EVENTS) {
        let record = record?;
        ledger += record.ledger;
        let kicked = matches!(record.event, Event::Kick { .. }) && disk.restitution() > 0.0;
        if kicked || record.event == Event::Separation {
            let spin = 0.5 * rim_speed * rim_speed;
            return Ok(TossPerformance::of(&record, &ledger, &scales, spin, peak));
        }
    }
    Err(Error::NeverLeaves { peak_acceleration })
}

/// [`multi_toss`](crate::toss::multi_toss) on a platform with any periodic motion; kicks count as impacts.
///
/// # Errors
/// The errors of [`multi_toss`](crate::toss::multi_toss), [`DrivenEngine::new`] and [`DrivenMap::new`];
/// [`Error::OutOfRange`] for a compliant contact, as cycles and exponents are defined for rigid impacts.
pub fn multi_toss(
    system: DrivenSystem,
    start: DrivenStart,
    settings: &MultiTossSettings,
    observer: &dyn Observer,
) -> Result<TossOrbit, Error> {
    if let Some(compliant) = &system.compliance {
        let legal = "left out, because tosses are classified with rigid impacts";
        check(false, "contact time", compliant.compliance().contact_time(), legal)?;
    }
    let map = DrivenMap::new(system.height().clone(), system.restitution)?;
    let twist_speed = system.angle().bounds().speed;
    let mut engine = DrivenEngine::new(system, start, settings.policy)?;
    engine.skip_energies();
    settle(Collisions::of(engine), &map, twist_speed, settings, observer)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use bouncing_disk_core::Unobserved;
    use bouncing_disk_core::numerics::elementary::{cos, sin};
    use bouncing_disk_core::numerics::roots::bisection;
    use bouncing_disk_drives::Drive;

    use super::*;
    use crate::System;
    use crate::parameters::driven_platform::Waveform;
    use crate::toss::chattering_cycle::LOCKED_FLIGHTS;
    use crate::toss::{OrbitClass, TOSS_START};

    fn near(one: f64, other: f64) {
        assert!((one - other).abs() < 1e-12 * other.abs().max(1.0), "{one} {other}");
    }

    #[test]
    fn single_tosses_of_a_sine_are_those_of_the_sine() {
        let system = System::pizza_toss().with_platform(|hand| hand.phase_lag = 0.4).expect("legal");
        let start = Phase::new(TOSS_START).expect("finite");
        for initial in [InitialSpin::AbsoluteRest, InitialSpin::RestRelativeToHand] {
            let known = crate::toss::single_toss(&system, initial).expect("leaves");
            let toss = single_toss(&(*system.platform()).into(), system.disk(), None, initial);
            let own = single_toss(&(*system.platform()).into(), system.disk(), Some(start), initial);
            assert_eq!(toss, own);
            let toss = toss.expect("leaves");
            near(toss.airborne_speed, known.airborne_speed);
            near(toss.launch_speed, known.launch_speed);
            near(toss.efficiency, known.efficiency);
            near(toss.separation_phase, known.separation_phase);
            near(toss.speed_ratio.expect("turns"), known.speed_ratio.expect("turns"));
        }
        let still = system.with_platform(|hand| hand.amplitude = 0.01).expect("legal");
        let crest = Phase::new(1.5).expect("finite");
        let late =
            single_toss(&(*system.platform()).into(), system.disk(), Some(crest), InitialSpin::AbsoluteRest);
        assert!(matches!(late, Err(Error::OutOfRange { field: "phase of the start", .. })), "{late:?}");
        let stays = single_toss(&(*still.platform()).into(), still.disk(), None, InitialSpin::AbsoluteRest);
        assert!(matches!(stays, Err(Error::NeverLeaves { .. })));
    }

    #[test]
    fn tosses_with_contacts_that_take_time_are_refused() {
        let soft = DrivenSystem::try_from(*System::pizza_toss().dimensionless()).expect("legal");
        let soft = soft.with_contact_time(0.3).expect("legal");
        let start =
            DrivenStart::Contact { phase: Phase::new(TOSS_START).expect("finite"), angular_speed: 0.0 };
        let refused = multi_toss(soft, start, &MultiTossSettings::default(), &Unobserved);
        assert!(matches!(refused, Err(Error::OutOfRange { field: "contact time", .. })), "{refused:?}");
    }

    /// Derived by hand for triangle waves: the speeds 2 omega Phi/pi and 2 omega A/pi, and the efficiency from
    /// the work of friction and the lift.
    #[test]
    fn the_toss_of_a_triangle_is_as_derived_by_hand() {
        let system = System::pizza_toss();
        let triangle = Waveform::Triangle;
        let hand = DrivenPlatform::new(*system.platform(), triangle.clone(), triangle).expect("legal");
        let toss = single_toss(&hand, system.disk(), None, InitialSpin::AbsoluteRest).expect("leaves");
        let share = std::f64::consts::FRAC_2_PI;
        let hand = system.platform();
        let speed = share * hand.angular_frequency() * hand.amplitude();
        near(toss.launch_speed, speed);
        near(toss.airborne_speed, share * hand.peak_angular_speed());
        near(toss.speed_ratio.expect("turns"), 1.0);
        let rim_speed = system.disk().gyration_radius() * share * hand.peak_angular_speed();
        let (rotary, lift) = (0.5 * rim_speed * rim_speed, 2.0 * hand.amplitude());
        let axial = 0.5 * speed * speed + system.disk().preload_acceleration() * lift;
        near(toss.efficiency, rotary / (rotary + axial + toss.energy.friction_loss));
    }

    /// The hand of Table I, or one with another friction, with these shapes of height and angle.
    fn thrown(height: Waveform, angle: Waveform, friction: f64) -> TossPerformance {
        let system = System::pizza_toss().with_disk(|dough| dough.friction = friction).expect("legal");
        let hand = DrivenPlatform::new(*system.platform(), height, angle).expect("legal");
        single_toss(&hand, system.disk(), None, InitialSpin::AbsoluteRest).expect("leaves")
    }

    /// The dough moves with the hand from the kink at the bottom on. Under its weight alone, friction
    /// accelerates it for 0.3 of a period, and it never reaches the hand's speed.
    #[test]
    fn the_toss_of_a_sawtooth_is_as_derived_by_hand() {
        let sawtooth = Waveform::Sawtooth(0.3);
        let toss = thrown(sawtooth.clone(), sawtooth, 0.6);
        let period = TAU / 15.0;
        near(toss.airborne_speed, 0.6 * 9.8 * 0.135 / (0.11 * 0.11) * 0.3 * period);
        assert!((toss.airborne_speed - 8.244).abs() < 5e-4, "{toss:?}");
        let hand = *System::pizza_toss().platform();
        // From bottom to top in 0.3 periods.
        near(toss.launch_speed, 2.0 * hand.amplitude() / (0.3 * period));
        let turns = 2.0 * hand.twist_amplitude() / (0.3 * period);
        assert!(toss.sliding_at_separation && turns > toss.airborne_speed, "{turns}");
        near(toss.speed_ratio.expect("turns"), toss.airborne_speed / turns);
    }

    /// With little friction the dough slides all the way up. The impulse of friction is proportional to the
    /// normal impulse: the weight over the time from the lowest point to the separation, plus the vertical
    /// momentum.
    #[test]
    fn a_hand_with_two_harmonics_throws_from_its_lowest_point() {
        let toss = thrown(Waveform::Fourier(vec![(1.0, 0.0), (0.15, 0.5)]), Waveform::Sine, 0.05);
        let (a, omega) = (System::pizza_toss().platform().amplitude(), 15.0);
        let velocity = |t: f64| a * omega * (cos(t) + 0.3 * cos(2.0 * t + 0.5));
        let force = |t: f64| 9.8 - a * omega * omega * (sin(t) + 0.6 * sin(2.0 * t + 0.5));
        let root = |low: f64, high: f64, before: &dyn Fn(f64) -> bool| {
            bisection(low, high, 60, |t| Ok::<_, Error>(before(t))).expect("no error")
        };
        let lowest = root(-2.5, -1.0, &|t| velocity(t) < 0.0);
        let leaves = root(lowest, 1.5, &|t| force(t) > 0.0);
        let impulse = 9.8 * (leaves - lowest) / omega + velocity(leaves);
        near(toss.airborne_speed, 0.05 * 0.135 / (0.11 * 0.11) * impulse);
        assert!((toss.airborne_speed - 2.759).abs() < 5e-4, "{toss:?}");
    }

    /// The result does not depend on where a recording begins.
    #[test]
    fn a_shifted_hand_throws_alike() {
        let shifts = [
            0.0,
            1e-12,
            0.5,
            0.5 * PI,
            2.0,
            3.0,
            PI,
            PI + 1e-9,
            4.0,
            1.5 * PI,
            5.5,
            TAU - 1e-9,
            TAU.next_down(),
        ];
        let alike = |one: &TossPerformance, other: &TossPerformance| {
            let numbers = |toss: &TossPerformance| {
                [toss.airborne_speed, toss.launch_speed, toss.efficiency, toss.speed_ratio.expect("turns")]
            };
            for (one, other) in numbers(one).into_iter().zip(numbers(other)) {
                assert!((one - other).abs() < 1e-9 * other.abs(), "{one:?} {other:?}");
            }
        };
        // The shape advanced by `shift`.
        let pieces = |shift: f64| {
            let line = |from: f64, to: f64, share: f64| (share, [from, (to - from) / share, 0.0, 0.0]);
            let share = shift / TAU;
            let mut lines: Vec<(f64, [f64; 4])> = Vec::new();
            // Up for 0.3 of a period to 1 at 0.15, down to -1 at 0.85, and up again.
            let corners: [(f64, f64); 7] =
                [(0.0, 0.0), (0.15, 1.0), (0.85, -1.0), (1.0, 0.0), (1.15, 1.0), (1.85, -1.0), (2.0, 0.0)];
            for [(from, low), (to, high)] in corners.windows(2).map(|two| [two[0], two[1]]) {
                let (start, end) = (from.max(share), to.min(share + 1.0));
                if end > start {
                    let at = |time: f64| low + (high - low) * (time - from) / (to - from);
                    lines.push(line(at(start), at(end), end - start));
                }
            }
            Waveform::Pieces(lines)
        };
        for friction in [0.05, 0.6] {
            let sine = System::pizza_toss().with_disk(|dough| dough.friction = friction).expect("legal");
            let sine = crate::toss::single_toss(&sine, InitialSpin::AbsoluteRest).expect("leaves");
            let two = |shift: f64| Waveform::Fourier(vec![(1.0, shift), (0.15, 0.5 + 2.0 * shift)]);
            let twice = thrown(two(0.0), two(0.0), friction);
            let sawtooth = thrown(Waveform::Sawtooth(0.3), Waveform::Sawtooth(0.3), friction);
            for shift in shifts {
                let one = || Waveform::Fourier(vec![(1.0, shift)]);
                alike(&thrown(one(), one(), friction), &sine);
                alike(&thrown(two(shift), two(shift), friction), &twice);
                // Pieces of no duration are not legal.
                if shift / TAU > 1e-6 && shift / TAU < 1.0 - 1e-6 {
                    alike(&thrown(pieces(shift), pieces(shift), friction), &sawtooth);
                }
            }
            let samples: Vec<f64> = (0..48)
                .map(|k| f64::from(k) / 48.0 * TAU)
                .map(|tau| sin(tau) + 0.2 * sin(2.0 * tau + 1.0) - 0.1 * cos(3.0 * tau))
                .collect();
            let known =
                thrown(Waveform::Sampled(samples.clone()), Waveform::Sampled(samples.clone()), friction);
            for shift in 1..48 {
                let mut own = samples.clone();
                own.rotate_left(shift);
                alike(&thrown(Waveform::Sampled(own.clone()), Waveform::Sampled(own), friction), &known);
            }
        }
    }

    /// Rotary speeds cos t, 2 cos t from a doubled amplitude, cos t + 0.6 cos(2 t), and the constant 2/pi of
    /// straight lines.
    #[test]
    fn speed_ratios_are_to_the_largest_rotary_speed_of_the_hand() {
        let sine = Waveform::Sine;
        let known = thrown(sine.clone(), sine.clone(), 0.6);
        let toss = thrown(sine.clone(), Waveform::Fourier(vec![(2.0, 0.0)]), 0.6);
        let peak = System::pizza_toss().platform().peak_angular_speed();
        near(toss.speed_ratio.expect("turns"), toss.airborne_speed / (2.0 * peak));
        near(known.speed_ratio.expect("turns"), known.airborne_speed / peak);
        let toss = thrown(sine.clone(), Waveform::Fourier(vec![(1.0, 0.0), (0.3, 0.0)]), 0.6);
        near(toss.speed_ratio.expect("turns"), toss.airborne_speed / (1.6 * peak));
        // The maximum of cos t + 0.6 sin(2 t) is at sin t = 1.2 cos(2 t).
        let toss = thrown(sine.clone(), Waveform::Fourier(vec![(1.0, 0.0), (0.3, -0.5 * PI)]), 0.6);
        let sine_there = (-1.0 + (1.0 + 8.0 * 1.2 * 1.2_f64).sqrt()) / (4.0 * 1.2);
        let cosine = (1.0 - sine_there * sine_there).sqrt();
        near(
            toss.speed_ratio.expect("turns"),
            toss.airborne_speed / (peak * cosine * (1.0 + 1.2 * sine_there)),
        );
        let toss = thrown(sine, Waveform::Triangle, 0.6);
        near(toss.speed_ratio.expect("turns"), toss.airborne_speed / (2.0 / PI * peak));
    }

    /// A periodic orbit, a chattering one and a disk at rest.
    #[test]
    fn many_tosses_of_a_sine_are_classified_as_those_of_the_sine() {
        let settings = MultiTossSettings {
            transient_impacts: 500,
            examined_impacts: 512,
            ..MultiTossSettings::default()
        };
        let (mut periodic, mut chattering) = (0, 0);
        for k in 0..24_u32 {
            let restitution = if k % 2 == 0 { 0.5 } else { 0.05 };
            let system = System::pizza_toss()
                .with_platform(|hand| hand.amplitude *= 0.1 + 0.02 * f64::from(k))
                .and_then(|system| system.with_disk(|dough| dough.restitution = restitution));
            let system = *system.expect("legal").dimensionless();
            // Next to the orbit with one impact per period, if it exists.
            let fast = system.map().period_one(1).map(|orbit| (orbit.phase(), -orbit.velocity()));
            let (phase, velocity) = fast.unwrap_or((Phase::new(1.0).expect("finite"), 1.0));
            let relative_speed = 1.01 * restitution * velocity;
            let start = DrivenStart::Launch { phase, relative_speed, angular_speed: 0.3 };
            let known = crate::toss::multi_toss(system, start, settings, &Unobserved).expect("no failure");
            let driven = DrivenSystem::try_from(system).expect("legal");
            let orbit = multi_toss(driven, start, &settings, &Unobserved).expect("no failure");
            match (known.class, orbit.class) {
                (
                    OrbitClass::Periodic { period, platform_periods, vertical, rotary },
                    OrbitClass::Periodic { period: n, platform_periods: k, vertical: own, rotary: third },
                ) => {
                    periodic += 1;
                    assert_eq!((period, platform_periods), (n, k));
                    near(own.spectral_radius(), vertical.spectral_radius());
                    near(third, rotary);
                }
                // Rounding chooses a long cycle.
                (OrbitClass::Chattering(known), OrbitClass::Chattering(own))
                    if known.long_flights <= LOCKED_FLIGHTS =>
                {
                    chattering += 1;
                    // Fewer of a chatter's short flights are summed.
                    assert_eq!(
                        (known.platform_periods, known.long_flights),
                        (own.platform_periods, own.long_flights)
                    );
                }
                (OrbitClass::Chattering(_), OrbitClass::Chattering(_))
                | (OrbitClass::AtRest, OrbitClass::AtRest)
                | (OrbitClass::Undecided { .. }, OrbitClass::Undecided { .. }) => continue,
                classes => panic!("{classes:?}"),
            }
            let speeds =
                [known.mean_angular_speed, orbit.mean_angular_speed].map(|speed| speed.expect("moves"));
            assert!((speeds[0] - speeds[1]).abs() < 1e-8, "{speeds:?}");
        }
        assert!(periodic > 2 && chattering > 2, "{periodic} {chattering}");
    }

    /// With a second harmonic alone the disk leaves the hand twice per period, at two phases.
    #[test]
    fn a_cycle_is_from_a_separation_to_the_next_one_at_its_phase() {
        let settings = MultiTossSettings {
            transient_impacts: 200,
            examined_impacts: 64,
            ..MultiTossSettings::default()
        };
        let system = DrivenSystem {
            height: Drive::fourier(&[(0.0, 0.0), (0.3, 0.0)]).expect("legal"),
            angle: Drive::fourier(&[(0.5, 0.3)]).expect("legal"),
            friction: 0.4,
            restitution: 0.05,
            load: 0.0,
            compliance: None,
        };
        let phase = Phase::new(0.0).expect("finite");
        let start = DrivenStart::Contact { phase, angular_speed: 0.0 };
        let orbit = multi_toss(system.clone(), start, &settings, &Unobserved).expect("no failure");
        let OrbitClass::Chattering(cycle) = orbit.class else { panic!("{:?}", orbit.class) };
        assert_eq!(cycle.platform_periods, 1);
        // The angle turned in the cycle, which runs between separations at the same phase.
        let mut engine = DrivenEngine::new(system, start, settings.policy).expect("legal");
        let mut leavings = Vec::new();
        while leavings.len() < 402 {
            let record = engine.advance().expect("no failure").expect("goes on");
            if record.event == Event::Separation {
                leavings.push(record.after.angle);
            }
        }
        let mean = (leavings[401] - leavings[399]) / std::f64::consts::TAU;
        assert!((orbit.mean_angular_speed.expect("it moves") - mean).abs() < 1e-9, "{orbit:?} {mean}");
    }
}
