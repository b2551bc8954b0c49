use std::f64::consts::PI;

use super::*;
use crate::motion::event::Event;
use crate::{Platform, System};

fn hand() -> Platform {
    *System::pizza_toss().platform()
}

fn dough() -> Disk {
    *System::pizza_toss().disk()
}

fn schedule(segments: &[ScheduleSegment], then: AfterSchedule) -> Schedule {
    Schedule { platform: hand().into(), start_phase: 1.5 * PI, segments: segments.to_vec(), then }
}

fn segment(periods: f64, amplitude: f64) -> ScheduleSegment {
    ScheduleSegment { periods, amplitude, ..ScheduleSegment::default() }
}

fn engine(schedule: &Schedule) -> ScheduledEngine {
    ScheduledEngine::at_rest(schedule, &dough(), 0.0, ChatterPolicy::Complete).expect("legal")
}

/// The energy of each event closes, and heights, angles and times go on over every joint, kinks included.
#[test]
fn a_motion_goes_on_over_its_joints() {
    let lagging = ScheduleSegment { lag: -0.8, frequency: 1.2, ..segment(3.0, 1.5) };
    let ramp = ScheduleSegment { ramp_to: Some(1.0), lag: -0.8, ..segment(4.0, 1.5) };
    let parts = [segment(2.25, 1.0), lagging, ramp, segment(1.0, 1.0)];
    let loaded = System::pizza_toss().with_disk(|dough| dough.load_acceleration = 3.0).expect("legal");
    let schedule = schedule(&parts, AfterSchedule::Repeat);
    let mut motion =
        ScheduledEngine::at_rest(&schedule, loaded.disk(), 1.0, ChatterPolicy::Complete).expect("legal");
    let (mut joints, mut time) = (Vec::new(), 0.0);
    let mut state = motion.scales_of(0).expect("it exists").state(motion.engine().state());
    for _ in 0..300 {
        let event = motion.advance().expect("no failure").expect("goes on");
        let (record, scales) = (event.record, motion.scales_of(event.segment).expect("it exists"));
        assert!(record.ledger.relative_closure() < 1e-12, "{event:?}");
        time += record.span.radians() * scales.time;
        assert!((event.time - time).abs() < 1e-12 * time.max(1.0));
        if record.event == Event::Joint {
            joints.push(event.time);
            state = scales.state(&record.after);
            let next = motion.scales_of(event.segment + 1).expect("it exists").state(motion.engine().state());
            for (one, other) in [
                (state.height, next.height),
                (state.axial_velocity, next.axial_velocity),
                (state.angle, next.angle),
                (state.angular_speed, next.angular_speed),
            ] {
                assert!((one - other).abs() < 1e-12 * (1.0 + one.abs()), "{state:?} {next:?}");
            }
        }
    }
    let period = TAU / 15.0;
    let expected = [2.25 * period, 2.25 * period + 3.0 * period / 1.2, 6.25 * period + 3.0 * period / 1.2];
    assert_eq!(joints.len(), 3);
    assert!(
        joints.iter().zip(expected).all(|(one, other)| (one - other).abs() < 1e-12),
        "{joints:?} {state:?}"
    );
}

/// One motion cut into segments is the motion itself.
#[test]
fn joints_without_a_change_change_nothing() {
    let whole = schedule(&[segment(1.0, 1.0)], AfterSchedule::Repeat);
    let parts: Vec<_> = (0..12).map(|k| segment(0.3 + 0.1 * f64::from(k), 1.0)).collect();
    let mut cut = engine(&schedule(&parts, AfterSchedule::Repeat))
        .map(|event| event.expect("no failure"))
        .filter(|event| event.record.event != Event::Joint);
    for event in engine(&whole).take(12) {
        let (one, other) = (event.expect("no failure"), cut.next().expect("goes on"));
        assert_eq!(std::mem::discriminant(&one.record.event), std::mem::discriminant(&other.record.event));
        assert!((one.time - other.time).abs() < 1e-9, "{one:?} {other:?}");
    }
}

/// The velocity of the platform doubles under the disk: a kick; and halves: it leaves.
#[test]
fn a_joint_under_a_disk_kicks_it_or_lets_it_go() {
    let gentle = |factor| {
        let parts = [segment(0.25, 0.2), ScheduleSegment { frequency: factor, ..segment(1.0, 0.2) }];
        engine(&schedule(&parts, AfterSchedule::Repeat))
            .map(|event| event.expect("no failure"))
            .skip_while(|event| event.record.event != Event::Joint)
            .nth(1)
            .expect("an event")
            .record
    };
    // A omega at height zero: 0.2 times that of the hand.
    let speed = 0.2 * System::pizza_toss().peak_acceleration();
    let kick = gentle(2.0);
    // In the units of the second segment the old speed is twice, the new one four times that.
    let Event::Kick { axial_impact_velocity, .. } = kick.event else { panic!("{kick:?}") };
    assert!((axial_impact_velocity + 2.0 * speed).abs() < 1e-12, "{kick:?}");
    assert!((kick.after.axial_velocity - 5.0 * speed).abs() < 1e-12 && kick.span.radians() <= 0.0);
    let parted = gentle(0.5);
    assert_eq!(parted.event, Event::Separation);
    assert!((parted.after.axial_velocity - 0.5 * speed).abs() < 1e-12, "{parted:?}");
}

#[test]
fn a_platform_that_comes_to_rest_lets_the_disk_settle() {
    let still = schedule(&[segment(2.3, 1.5)], AfterSchedule::Rest);
    let events: Vec<_> = engine(&still).map(|event| event.expect("no failure")).collect();
    let last = events.last().expect("some");
    assert!(last.segment == 1 && last.record.after.mode == Mode::Sticking, "{last:?}");
    assert!(last.record.after.axial_velocity == 0.0 && last.record.after.angular_speed == 0.0, "{last:?}");
    assert!(
        events.iter().any(|event| event.segment == 1 && matches!(event.record.event, Event::Impact { .. }))
    );
    assert!(events.iter().all(|event| event.record.ledger.relative_closure() < 1e-12));
}

#[test]
fn bad_schedules_are_refused_by_name() {
    let first = segment(2.25, 1.0);
    let mut list = vec![
        (schedule(&[], AfterSchedule::Repeat), "number of segments"),
        (schedule(&[segment(1.0, 1.0), segment(1.0, 1.5)], AfterSchedule::Repeat), "jumps by -0.1065"),
        (schedule(&[segment(0.0, 1.0)], AfterSchedule::Rest), "segment 0: periods = 0 "),
        (schedule(&[segment(f64::NAN, 1.0)], AfterSchedule::Rest), "segment 0: periods = NaN "),
        (schedule(&[first, segment(1.0, -1.0)], AfterSchedule::Rest), "segment 1: amplitude = -1 "),
        (
            schedule(&[ScheduleSegment { frequency: 0.0, ..first }], AfterSchedule::Rest),
            "segment 0: frequency = 0 ",
        ),
        (
            schedule(&[ScheduleSegment { lag: f64::INFINITY, ..first }], AfterSchedule::Rest),
            "segment 0: lag = inf ",
        ),
        (
            schedule(&[ScheduleSegment { ramp_to: Some(2.0), ..first }], AfterSchedule::Repeat),
            "segment 0: ramp_to = 2 ",
        ),
        (Schedule { start_phase: f64::NAN, ..schedule(&[first], AfterSchedule::Rest) }, "start_phase"),
        (
            schedule(&[ScheduleSegment { frequency: 1e6, ..first }], AfterSchedule::Rest),
            "segment 0: acceleration",
        ),
    ];
    let triangle = DrivenPlatform::new(hand(), Waveform::Triangle, Waveform::Sine).expect("legal");
    let ramp = schedule(&[ScheduleSegment { ramp_to: Some(2.0), ..first }], AfterSchedule::Rest);
    list.push((Schedule { platform: triangle, ..ramp }, "segment 0: ramp_to needs"));
    for (schedule, words) in list {
        let found = ScheduledEngine::at_rest(&schedule, &dough(), 0.0, ChatterPolicy::Complete);
        let text = found.expect_err("refused").to_string();
        assert!(text.contains(words), "{text}");
    }
}

/// A ramp from little to full amplitude lifts the disk off within the ramp, and its energy closes.
#[test]
fn a_ramp_lifts_the_disk_off() {
    let ramp = ScheduleSegment { ramp_to: Some(1.0), ..segment(6.25, 0.05) };
    let events: Vec<_> = engine(&schedule(&[ramp, segment(1.0, 1.0)], AfterSchedule::Repeat))
        .map(|event| event.expect("no failure"))
        .take_while(|event| event.segment == 0)
        .collect();
    for kind in [Event::Separation, Event::Joint] {
        assert!(events.iter().any(|event| event.record.event == kind), "{events:?}");
    }
    assert!(events.iter().any(|event| matches!(event.record.event, Event::Impact { .. })));
    assert!(events.iter().all(|event| event.record.ledger.relative_closure() < 1e-12));
}
