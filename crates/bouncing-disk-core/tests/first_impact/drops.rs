//! A disk dropped from a point of a flight lands where that flight ends.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::sin_cos;
use bouncing_disk_core::{Launch, Phase, Vibration};

use crate::launches::SplitMix;

/// Rounding of the point at which the flight is interrupted, in units of its largest terms; a generous bound.
const ROUNDING: f64 = 1.0e-14;

#[test]
fn an_interrupted_flight_lands_at_the_same_place() {
    let mut random = SplitMix::new(31);
    let (mut compared, mut below_crest) = (0, 0);
    while compared < 100_000 {
        let peak = libm::exp10(3.0 * random.unit() - 1.0);
        let vibration = Vibration::new(peak).expect("legal");
        let phase = Phase::new(random.angle()).expect("finite");
        let speed = (1.0 + peak) * 3.0 * random.unit() * random.unit();
        let Ok(launch) = Launch::new(phase, speed) else { continue };
        let Ok(impact) = vibration.first_impact(launch) else { continue };
        let t = impact.duration() * (0.05 + 0.9 * random.unit());
        let (s, c) = sin_cos(phase.angle() + t);
        let gap = t * (speed + peak * phase.cos() - 0.5 * t) + peak * (phase.sin() - s);
        let velocity = speed + peak * (phase.cos() - c) - t;
        let there = Phase::new(phase.angle() + t).expect("finite");
        // The change of the landing by a rounding of this point.
        let scale = 1.0 + peak + t * (speed + peak + t);
        let curvature = 1.0 + peak;
        let shift = 2.0 * ROUNDING * scale
            / (impact.velocity.abs()
                + (impact.velocity * impact.velocity + ROUNDING * scale * curvature).sqrt())
            + ROUNDING * scale / (1.0 + impact.velocity.abs());
        let near_graze = vibration.graze_margin(launch, &impact) <= 1.0e3 * ROUNDING * scale;
        // Near a graze, or on the platform, rounding decides.
        if gap <= 1.0e3 * ROUNDING * scale || shift > 1.0e-6 || near_graze {
            continue;
        }
        let dropped = vibration.first_impact_of_drop(there, gap, velocity).expect("lands");
        let apart = (dropped.phase.angle() - impact.phase.angle()).abs();
        let apart = apart.min(TAU - apart);
        assert!(
            apart <= 8.0 * shift,
            "P {peak}, from {phase:?} at {speed}, interrupted after {t} of {}: {apart:e} against {shift:e}",
            impact.duration()
        );
        let duration = dropped.duration() + t;
        assert!(
            (duration - impact.duration()).abs() <= 8.0 * shift + ROUNDING * duration,
            "{duration} {impact:?}"
        );
        compared += 1;
        below_crest += u32::from(peak * s + gap < peak);
    }
    assert!(below_crest > 10_000, "only {below_crest} started below the crests");
}
