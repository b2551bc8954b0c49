//! Whatever is written is read with the same bits, and what is read is legal.

#![cfg(feature = "serde")]

#[cfg(feature = "fit")]
#[path = "stored/fits.rs"]
mod fits;
#[path = "../../bouncing-disk-core/tests/round_trip/mod.rs"]
mod round_trip;

use std::f64::consts::TAU;

use bouncing_disk::core::{ChatterPolicy, LyapunovEstimate, Multipliers, Phase};
use bouncing_disk::*;
use serde_json::json;

use round_trip::{check, refused};

fn lively() -> DimensionlessSystem {
    ForcingParameters { axial_forcing: 0.48, angular_forcing: 2.0, phase_lag: 0.2, restitution: 0.5 }
        .build()
        .expect("legal")
}

fn at(angle: f64) -> Phase {
    Phase::new(angle).expect("finite")
}

fn start() -> InitialCondition {
    InitialCondition::Contact { phase: at(4.0), angular_speed: 0.5 }
}

#[test]
fn parameters() {
    let motor = System::motor();
    check(
        &motor,
        &[
            ("/disk/restitution", json!(1.0), "restitution"),
            ("/platform/amplitude", json!(1e300), "peak_acceleration"),
            ("/platform/angular_frequency", json!(0.0), "angular_frequency"),
        ],
    );
    check(motor.platform(), &[("/twist_amplitude", json!(-1.0), "twist_amplitude")]);
    check(motor.disk(), &[("/friction", json!(-1.0), "friction")]);
    check(&motor.platform().parameters(), &[]);
    check(&motor.disk().parameters(), &[]);
    check(motor.dimensionless(), &[("/peak_acceleration", json!(-1.0), "peak_acceleration")]);
    check(&motor.dimensionless().parameters(), &[]);
    check(
        &motor.scales(),
        &[("/time", json!(0.0), "unit of time"), ("/angle", json!(-1.0), "unit of angle")],
    );
    let speeds = LaunchSpeeds { axial_speed: 1.0, angular_speed: 2.0, stroke: 0.1, contact_radius: 0.1 };
    check(&speeds, &[]);
    check(&Stroke::from_launch_speeds(speeds).expect("legal"), &[]);
    check(
        &ForcingParameters { axial_forcing: 0.48, angular_forcing: 2.0, phase_lag: 0.2, restitution: 0.5 },
        &[],
    );
    check(
        &Braking {
            angular_acceleration: -20.0,
            normal_force: 0.5,
            mass: 0.05,
            contact_radius: 0.002,
            gyration_radius: 0.01,
        },
        &[
            ("/angular_acceleration", json!(20.0), "angular_acceleration"),
            ("/normal_force", json!(0.0), "normal_force"),
            ("/mass", json!(-1.0), "mass"),
            ("/contact_radius", json!(0.0), "contact_radius"),
            ("/gyration_radius", json!(0.0), "gyration_radius"),
        ],
    );
}

#[test]
fn starts() {
    check(&start(), &[("/Contact/angular_speed", json!(1e101), "angular_speed")]);
    check(
        &InitialCondition::Launch { phase: at(1.0), relative_speed: 2.0, angular_speed: 0.0 },
        &[
            ("/Launch/relative_speed", json!(-1.0), "relative_speed"),
            ("/Launch/angular_speed", json!(-1e101), "angular_speed"),
            ("/Launch/phase/angle", json!(7.0), "angle of a phase"),
        ],
    );
    check(
        &InitialCondition::Flight { phase: at(1.0), gap: 2.0, relative_velocity: -1.0, angular_speed: 0.0 },
        &[
            ("/Flight/gap", json!(0.0), "gap"),
            ("/Flight/gap", json!(1e18), "gap"),
            ("/Flight/relative_velocity", json!(1e10), "relative_velocity"),
            ("/Flight/angular_speed", json!(1e101), "angular_speed"),
        ],
    );
    check(&InitialSpin::RestRelativeToHand, &[]);
}

#[test]
fn every_event_of_a_motion() {
    let scales = System::motor().scales();
    let mut kinds = Vec::new();
    for (system, policy) in [
        (lively(), ChatterPolicy::Complete),
        (lively(), PAPER_CHATTER),
        (*System::motor().dimensionless(), ChatterPolicy::Complete),
        (*System::pizza_toss().dimensionless(), ChatterPolicy::Complete),
    ] {
        let mut engine = Engine::new(system, start(), policy).expect("legal");
        let mut events = 0;
        let trajectory = Trajectory::record(&mut engine, |_| {
            events += 1;
            events == 100
        });
        let trajectory = trajectory.expect("no failure");
        for record in trajectory.records() {
            check(
                record,
                &[
                    ("/span/remainder", json!(7.0), "remainder"),
                    ("/ledger/axial_magnitude", json!(-1.0), "axial_magnitude"),
                    ("/segment/chatter_speed", json!(-1.0), "chatter_speed"),
                    ("/time/phase/sin", json!(2.0), "sine of a phase"),
                    ("/before/mode", json!("Stuck"), "Stuck"),
                ],
            );
            check(&scales.state(&record.after), &[]);
            check(&scales.energy(&record.ledger), &[]);
            check(&record.transition(), &[]);
            check(&record.evaluate(&system, 0.5), &[]);
            match record.event {
                Event::Impact { .. } => {
                    check(
                        &record.event,
                        &[("/Impact/axial_impact_velocity", json!(1.0), "axial_impact_velocity")],
                    );
                }
                Event::Attachment { error_bound, .. } => {
                    check(&record.event, &[("/Attachment/error_bound", json!(-1.0), "error_bound")]);
                    kinds.push(if error_bound.is_infinite() { "cut" } else { "summed" });
                }
                _ => check(&record.event, &[]),
            }
            kinds.push(match record.event.kind() {
                EventKind::Impact => "impact",
                EventKind::Separation => "separation",
                EventKind::StickToSlip | EventKind::SlipToStick | EventKind::SlipReversal => "slip",
                _ => "attachment",
            });
        }
        check(
            &trajectory,
            &[
                ("/start/periods", json!(1_000_000), "time of an event"),
                ("/records/1/time/periods", json!(1_000_000), "time of an event"),
            ],
        );
    }
    for kind in ["cut", "summed", "impact", "separation", "slip"] {
        assert!(kinds.contains(&kind), "{kind}");
    }
}

#[test]
fn tosses() {
    let toss = single_toss(&System::pizza_toss(), InitialSpin::AbsoluteRest).expect("leaves");
    check(
        &toss,
        &[("/separation_phase", json!(TAU), "separation_phase"), ("/launch_speed", json!("fast"), "fast")],
    );
    // Nothing was put in: not a number, which is not equal to itself.
    let text = serde_json::to_string(&TossPerformance { efficiency: f64::NAN, ..toss }).expect("writes");
    assert!(text.contains("\"efficiency\":null"), "{text}");
    assert!(serde_json::from_str::<TossPerformance>(&text).is_ok_and(|read| read.efficiency.is_nan()));
    check(
        &MultiTossSettings::default(),
        &[
            ("/examined_impacts", json!(1), "examined_impacts"),
            ("/longest_period", json!(0), "longest_period"),
            ("/tolerance", json!(-1.0), "tolerance"),
        ],
    );
    let settings =
        MultiTossSettings { transient_impacts: 200, examined_impacts: 64, ..MultiTossSettings::default() };
    for axial_forcing in [0.25, 0.33, 0.45, 0.55] {
        let system =
            ForcingParameters { axial_forcing, angular_forcing: 2.0, phase_lag: 0.2, restitution: 0.5 };
        let orbit =
            multi_toss(system.build().expect("legal"), start(), settings, &Unobserved).expect("no failure");
        check(&orbit.class, &[]);
        for collision in orbit.collisions.iter().take(5) {
            check(
                collision,
                &[
                    ("/state/axial_impact_velocity", json!(1.0), "axial_impact_velocity"),
                    ("/capped", json!(1), "boolean"),
                ],
            );
        }
    }
    let vertical = Multipliers::Complex { real: 0.5, imaginary: 0.1 };
    check(
        &OrbitClass::Periodic { period: 2, platform_periods: 3, vertical, rotary: 1.0 },
        &[
            ("/Periodic/period", json!(0), "period"),
            ("/Periodic/platform_periods", json!(0), "platform_periods"),
            ("/Periodic/rotary", json!(1.5), "rotary multiplier"),
            ("/Periodic/vertical/Complex/imaginary", json!(-0.1), "imaginary part"),
        ],
    );
    let estimate = LyapunovEstimate { exponent: 0.3, standard_error: 0.01, impacts: 64 };
    check(&OrbitClass::Chaotic { lyapunov_exponent: estimate }, &[]);
    for lyapunov_exponent in [Some(estimate), None] {
        check(&OrbitClass::Undecided { impacts: 64, lyapunov_exponent }, &[]);
    }
    check(&OrbitClass::Chattering(ChatteringCycle { impacts: 3, platform_periods: 2, long_flights: 1 }), &[]);
    check(&OrbitClass::AtRest, &[]);
    for event in Collisions::new(lively(), start(), ChatterPolicy::Complete).expect("legal").take(50) {
        let event = event.expect("no failure");
        let illegal = match event {
            CollisionEvent::Collision(_) => ("/Collision/state/axial_impact_velocity", json!(1.0), "axial"),
            CollisionEvent::Attachment { .. } => ("/Attachment/summed_impacts", json!(-1), "-1"),
            _ => ("/Separation/time/phase/angle", json!(7.0), "angle of a phase"),
        };
        check(&event, &[illegal]);
    }
}

#[test]
fn motors() {
    let motor = System::motor();
    let settings = TransientSettings { duration: 0.02, intervals: 5, ..TransientSettings::default() };
    check(&settings, &[("/duration", json!(0.0), "duration"), ("/intervals", json!(2), "intervals")]);
    let members = ensemble_members(&motor, &settings, 2).expect("few");
    check(
        &members[1],
        &[("/settings/intervals", json!(2), "intervals"), ("/phase/angle", json!(7.0), "angle")],
    );
    let mut run = TransientsRun::new(2);
    run.advance(&members, &Unobserved).expect("nobody stops it");
    check(&run, &[("/total", json!(1), "index of a finished item")]);
    let runs = ensemble(&motor, &settings, 2, &Unobserved).expect("no failure");
    check(&runs.curves[0], &[("/times", json!([]), "number of points")]);
    check(&runs.steady_speed, &[("/deviation", json!(-1.0), "deviation")]);
    check(&runs.fits[0], &[("/time_constant", json!(0.0), "time_constant")]);
    check(&RiseForm::Ramp, &[]);
    let statistics = MotorStatistics::of(&motor, &runs, settings.duration, ChatterPolicy::Complete);
    check(
        &statistics.expect("no failure"),
        &[("/form", json!("line"), "line"), ("/steady_speed/standard_error", json!(-1.0), "standard_error")],
    );
}

/// JSON holds no such number; a binary format does.
#[test]
fn what_is_no_number_is_not_read() {
    let mut engine = Engine::new(lively(), start(), ChatterPolicy::Complete).expect("legal");
    let record = engine.advance().expect("no failure").expect("goes on");
    let toss = single_toss(&System::pizza_toss(), InitialSpin::AbsoluteRest).expect("leaves");
    for number in [f64::NAN, f64::INFINITY] {
        refused(&DiskState { height: number, ..record.before }, "height");
        refused(&EnergyLedger { load_work: number, ..record.ledger }, "load_work");
        refused(&EventRecord { axial_impulse: number, ..record }, "axial_impulse");
        refused(&EventRecord { angular_impulse: number, ..record }, "angular_impulse");
        refused(&PhaseSpan { periods: 0, remainder: number }, "remainder");
        refused(&SiEnergy { friction_loss: number, ..toss.energy }, "friction_loss");
        refused(&TossPerformance { airborne_speed: number, ..toss }, "airborne_speed");
    }
}

#[test]
fn the_spin_on_a_periodic_orbit() {
    let system = lively().parameters();
    let system = DimensionlessParameters { load: 0.2, ..system }.build().expect("legal");
    let orbit =
        system.map().period_one_pair(1).expect("exists").saddle.orbit(system.map()).expect("no failure");
    let orbit = orbit.expect("admissible");
    let outcome = rotary_response(&system, &orbit).expect("an orbit");
    check(
        &outcome,
        &[
            ("/Steady/slips", json!([]), "slips"),
            ("/Steady/sliding", json!([]), "sliding"),
            ("/Steady/sliding/0", json!("Forward"), "ends its slip"),
        ],
    );
    check(&RotaryOutcome::Runaway { change: -0.1 }, &[]);
    check(&rotary_round(&system, &orbit, 30.0).expect("a round"), &[]);
}
