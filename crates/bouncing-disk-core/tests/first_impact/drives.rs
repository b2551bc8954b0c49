//! Drives of every kind.

use bouncing_disk_core::{
    ChatterPolicy, Drive, DrivenEvent, DrivenMap, ImpactMap, ImpactState, Launch, OrbitEvent, Phase,
    Vibration,
};

use crate::launches::SplitMix;

/// From the same state before each event the sum gives the events of the sine's own solver.
#[test]
fn a_sine_as_a_fourier_sum_lands_where_the_sine_does() {
    let mut random = SplitMix::new(51);
    let mut worst = 0.0_f64;
    for _ in 0..200_000 {
        let peak = libm::exp10(3.0 * random.unit() - 1.0);
        let vibration = Vibration::new(peak).unwrap();
        let drive = Drive::fourier(&[(peak, 0.0)]).unwrap();
        let phase = Phase::new(random.angle()).unwrap();
        let speed = (1.0 + peak) * 3.0 * random.unit() * libm::exp10(-6.0 * random.unit());
        let launch = Launch::new(phase, speed).unwrap();
        let sine = vibration.first_impact(launch).unwrap();
        let sum = drive.first_impact(launch).unwrap();
        let apart = (sum.impact.duration() - sine.duration()).abs();
        let legal = 1e-12 * sine.duration() + 4.0 * sum.error;
        assert!(apart <= legal, "{peak} {phase:?} {speed:e}: {sine:?} {sum:?}");
        assert_eq!(sum.impact.turns, sine.turns);
        if sine.velocity < -1e-3 {
            worst = worst.max(apart / sine.duration());
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
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
                    // The chatter as a whole, from the impact after which the sine's was summed.
                    let mut orbit = map.orbit(state, ChatterPolicy::Complete);
                    let end = orbit.find_map(|event| match event.unwrap() {
                        DrivenEvent::Attachment { accumulation, .. } => Some(accumulation),
                        _ => None,
                    });
                    let apart = (end.unwrap().phase.angle() - attachment.accumulation.phase.angle()).abs();
                    assert!(apart < 1e-12 || apart > 6.28, "{forcing} {restitution}: {apart:e}");
                    let separation = orbit.next().map(|event| match event.unwrap() {
                        DrivenEvent::Separation(change) => change.phase.angle(),
                        other => panic!("{other:?}"),
                    });
                    let expected = attachment.separation.map(|(phase, _)| phase.angle());
                    assert_eq!(separation.is_some(), expected.is_some());
                    if let (Some(found), Some(expected)) = (separation, expected) {
                        assert!((found - expected).abs() < 1e-13);
                        let next = orbit.next().unwrap().unwrap();
                        let DrivenEvent::Impact(landing) = next else { panic!("{next:?}") };
                        let launch = Launch::new(Phase::new(expected).unwrap(), 0.0).unwrap();
                        let impact = sine.vibration().first_impact(launch).unwrap();
                        assert!((landing.impact.duration() - impact.duration()).abs() < 1e-12);
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
