//! What is read again has the same bits: parameters, settings, runs that resume, and trajectories.

#![cfg(feature = "serde")]

#[path = "../../bouncing-disk-core/tests/round_trip/mod.rs"]
mod round_trip;

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::estimate::TransientEnsemble;
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk::motor::circular::Concentration;
use bouncing_disk::motor::{OperatingSettings, SpeedCurve, TransientSettings};
use bouncing_disk::parameters::{ForcingParameters, Stroke};
use bouncing_disk::toss::InitialSpin;
use bouncing_disk::{Engine, Event, InitialCondition, System, Trajectory, Unobserved};
use serde_json::json;

use round_trip::{check, refused};

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
    check(&Stroke::pizza_toss(), &[]);
    check(&InitialSpin::RestRelativeToHand, &[]);
    check(
        &Concentration::of([(0.3, 1.0), (0.5, 2.0)]).expect("has weight"),
        &[
            ("/mean_direction_rad", json!(4.0), "mean_direction_rad"),
            ("/resultant_length", json!(1.1), "resultant"),
        ],
    );
}

#[test]
fn trajectories() {
    let lively =
        ForcingParameters { axial_forcing: 0.48, angular_forcing: 2.0, phase_lag: 0.2, restitution: 0.5 }
            .build()
            .expect("legal");
    let start = InitialCondition::Contact { phase: Phase::new(4.0).expect("finite"), angular_speed: 0.5 };
    let mut kinds = Vec::new();
    for (system, policy) in [
        (lively, ChatterPolicy::Complete),
        (lively, PAPER_CHATTER),
        (*System::motor().dimensionless(), ChatterPolicy::Complete),
        (*System::pizza_toss().dimensionless(), ChatterPolicy::Complete),
    ] {
        let mut engine = Engine::new(system, start, policy).expect("legal");
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
                    ("/time/phase/sin", json!(2.0), "sine of a phase"),
                    ("/before/mode", json!("Stuck"), "Stuck"),
                ],
            );
            check(&record.transition(), &[]);
            kinds.push(match record.event {
                Event::Attachment { error_bound, .. } if error_bound.is_infinite() => "cut",
                Event::Attachment { .. } => "summed",
                Event::Impact { .. } => "impact",
                Event::Separation => "separation",
                _ => "slip",
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
fn motors() {
    let motor = System::motor();
    let settings = TransientSettings { duration: 0.02, intervals: 5, ..TransientSettings::default() };
    check(&settings, &[("/duration", json!(0.0), "duration"), ("/intervals", json!(2), "intervals")]);
    check(&OperatingSettings::default(), &[("/members", json!(1), "members")]);
    let runs = TransientEnsemble::new(&motor, &settings, 2, &Unobserved).expect("no failure");
    check(&runs.curves[0], &[("/times", json!([]), "number of points")]);
    // JSON holds no such number; a binary format does.
    refused(&SpeedCurve { speeds: vec![f64::NAN; 5], ..runs.curves[0].clone() }, "speed");
    check(&runs.steady_speed, &[]);
    check(&runs.fits[0], &[]);
}
