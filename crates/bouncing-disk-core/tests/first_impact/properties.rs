//! Properties common to all first impacts.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary;
use bouncing_disk_core::{Impact, Launch, Phase, Vibration};
use proptest::prelude::*;

fn impact(peak: f64, angle: f64, speed: f64) -> Impact {
    let phase = Phase::new(angle).unwrap();
    Vibration::new(peak).unwrap().first_impact(Launch::new(phase, speed).unwrap()).unwrap()
}

fn peaks() -> impl Strategy<Value = f64> {
    prop_oneof![0.0..1.0, Just(1.0), 1.0..10.0_f64, (1.0..6.0_f64).prop_map(libm::exp10)]
}

fn speeds() -> impl Strategy<Value = f64> {
    (-9.0..5.0_f64).prop_map(libm::exp10)
}

/// Roundings of a gap relative to the sizes of its terms, or of a time.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// Relative rounding of a bound computed from the difference of two speeds, if this is at least a thousandth
/// of them.
const ROUNDED_BOUND: f64 = 1.0e-9;

/// Whether a launch from a platform at rest returns after twice its speed, with its speed.
fn flies_a_parabola(angle: f64, speed: f64) -> bool {
    let impact = impact(0.0, angle, speed);
    // A flight of more than half a radian is the difference of two phases. Their sum, below 4 pi, is rounded
    // by at most half an ulp of [8, 16), 4 epsilon; the wrapped phase, its distance from the launch, and that
    // with a turn more, all below 2 pi, by 2 epsilon each.
    let phases = if 2.0 * speed > 0.5 { 10.0 * f64::EPSILON } else { 0.0 };
    (impact.duration() - 2.0 * speed).abs() <= ROUNDINGS * speed + phases
        && (impact.velocity + speed).abs() <= ROUNDINGS * speed
}

/// The sum of the phases is rounded by half an ulp of [8, 16), more than four roundings of this speed.
#[test]
fn a_parabola_across_the_seam_is_as_long_as_its_phases_say() {
    assert!(flies_a_parabola(6.244_882_602_173_519, 0.996_664_045_659_184_4));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gravity_and_the_largest_pull_bound_the_flight(peak in peaks(), angle in 0.0..TAU, speed in speeds()) {
        let impact = impact(peak, angle, speed);
        let duration = impact.duration();
        prop_assert!(duration >= 2.0 * speed / (1.0 + peak) * (1.0 - 1.0e-14));
        // Never longer than the way up to the crests' height and back, plus one period.
        let climb = speed + peak;
        prop_assert!(duration <= 2.0 * climb + 2.0 * (2.0 * peak).sqrt() + 2.0 * TAU);
        prop_assert!(impact.velocity <= 0.0);
        prop_assert!(impact.velocity >= -(duration + 2.0 * peak));
    }

    #[test]
    fn whole_turns_of_the_launch_phase_do_not_matter(
        peak in peaks(), angle in 0.0..TAU, turns in -40_i32..40, speed in speeds(),
    ) {
        let shifted = angle + TAU * f64::from(turns);
        let wrapped = elementary::wrapped_angle(shifted);
        prop_assert!((wrapped - angle).abs() <= 1.0e-13 || TAU - (wrapped - angle).abs() <= 1.0e-13);
        prop_assert_eq!(impact(peak, shifted, speed), impact(peak, wrapped, speed));
    }

    #[test]
    fn turns_periods_and_phases_agree(peak in peaks(), angle in 0.0..TAU, speed in speeds()) {
        let impact = impact(peak, angle, speed);
        let by_phase = (impact.phase.angle() - angle) + impact.turns as f64 * TAU;
        let tolerance = 4.0e-15 + 4.0 * f64::EPSILON * impact.duration();
        prop_assert!((by_phase - impact.duration()).abs() <= tolerance);
    }

    #[test]
    fn a_platform_at_rest_gives_a_parabola(angle in 0.0..TAU, speed in speeds()) {
        prop_assert!(flies_a_parabola(angle, speed));
    }

    #[test]
    fn a_faster_launch_of_a_calm_platform_flies_longer(
        peak in 0.0..1.0, angle in 0.0..TAU, speed in speeds(), more in 1.001..2.0_f64,
    ) {
        // Without zones of positive curvature there are no grazes.
        prop_assert!(impact(peak, angle, speed * more).duration() > impact(peak, angle, speed).duration());
    }

    #[test]
    fn a_faster_launch_flies_longer_by_what_it_is_above_the_slower_impact(
        peak in peaks(), angle in 0.0..TAU, speed in speeds(), more in 1.001..2.0_f64,
    ) {
        let (faster, slower) = (impact(peak, angle, speed * more), impact(peak, angle, speed));
        let (late, early) = (faster.duration(), slower.duration());
        // The gap grows with the launch speed at every instant: at the impact of the slower disk the faster
        // one is this high, minus the rounding of both gaps. Its speed then is at most the speed of that
        // impact, and it gains at most 1 + P. Flights of less than half a radian have relative accuracy.
        let scale = if early < 0.5 { early } else { 1.0 + early };
        let above = speed * (more - 1.0) * early - ROUNDINGS * (1.0 + peak) * scale * scale;
        let rounding = ROUNDINGS * scale;
        if above > 0.0 {
            let (fall, pull) = (-slower.velocity, 1.0 + peak);
            let least = 2.0 * above / (fall + (fall * fall + 2.0 * pull * above).sqrt());
            prop_assert!(late - early >= least * (1.0 - ROUNDED_BOUND) - rounding, "{late} {early} {least}");
            prop_assert!(least <= rounding || late > early, "{late} {early} {least}");
        } else {
            prop_assert!(late >= early - rounding, "{late} {early}");
        }
    }
}
