//! Laws of restitution as a user sees them: steps, derivatives, orbits and cuts of the impact map under any
//! law.

mod dual_numbers;
mod paper;

use std::cell::Cell;
use std::f64::consts::{PI, TAU};

use bouncing_disk_core::map::{Constant, KuwabaraKono, RestitutionLaw};
use bouncing_disk_core::{
    ChatterCut, ChatterPolicy, Error, ImpactMap, ImpactState, Launch, OrbitEvent, Phase, Unobserved,
    Vibration,
};
use dual_numbers::dual_derivative;
use glam::DMat2;
use num_dual::{Dual64, DualNum};
use paper::PAPER_POLICY;
use proptest::prelude::*;

/// A user's law that is constant, unknown to the library.
#[derive(Debug, Clone, Copy)]
struct Same(f64);

impl RestitutionLaw for Same {
    fn restitution(&self, _: f64) -> f64 {
        self.0
    }
    fn derivative(&self, _: f64) -> f64 {
        0.0
    }
}

/// A user's law that falls with the speed: r = 1/(1 + v).
#[derive(Debug, Clone, Copy)]
struct Softening;

impl RestitutionLaw for Softening {
    fn restitution(&self, speed: f64) -> f64 {
        1.0 / (1.0 + speed)
    }
    fn derivative(&self, speed: f64) -> f64 {
        -1.0 / ((1.0 + speed) * (1.0 + speed))
    }
}

/// A law that is 1/2 up to the nth impact, and then another value.
#[derive(Debug, Clone)]
struct Failing {
    left: Cell<u32>,
    then: f64,
}

impl RestitutionLaw for Failing {
    fn restitution(&self, _: f64) -> f64 {
        if self.left.get() == 0 {
            return self.then;
        }
        self.left.set(self.left.get() - 1);
        0.5
    }
    fn derivative(&self, _: f64) -> f64 {
        f64::NAN
    }
}

fn vibration(axial_forcing: f64) -> Vibration {
    Vibration::from_axial_forcing(axial_forcing).expect("legal forcing")
}

fn state(angle: f64, velocity: f64) -> ImpactState {
    ImpactState::new(Phase::new(angle).expect("finite"), velocity).expect("legal velocity")
}

fn bits(state: ImpactState) -> [u64; 4] {
    let phase = state.phase();
    [phase.angle(), phase.sin(), phase.cos(), state.velocity()].map(f64::to_bits)
}

/// r + x r^(3/5) = 1 by bisection, differentiated by Newton steps.
fn dual_kuwabara_kono(reference: f64, reference_speed: f64, speed: Dual64) -> Dual64 {
    let x = (speed / reference_speed).powf(0.2) * (1.0 - reference) / Dual64::from_re(reference).powf(0.6);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let middle: f64 = 0.5 * (low + high);
        let excess = middle + x.re * Dual64::from_re(middle).powf(0.6).re - 1.0;
        if excess > 0.0 { high = middle } else { low = middle }
    }
    let mut r = Dual64::from_re(high);
    for _ in 0..3 {
        let power = r.powf(0.6);
        r -= (r + x * power - 1.0) / (x * power / r * 0.6 + 1.0);
    }
    r
}

fn agrees(own: DMat2, other: DMat2) -> bool {
    let scale = other.x_axis.abs().max_element().max(other.y_axis.abs().max_element()).max(1.0);
    let difference = own - other;
    difference.x_axis.abs().max_element() <= 1e-9 * scale
        && difference.y_axis.abs().max_element() <= 1e-9 * scale
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn derivatives_agree_with_dual_numbers(
        forcing in 0.05_f64..60.0, reference in 0.05_f64..0.95, reference_speed in 0.01_f64..10.0,
        angle in 0.0..TAU, speed in 0.05_f64..4.0,
    ) {
        let from = state(angle, -speed * PI * forcing);
        let vibration = vibration(forcing);
        let law = KuwabaraKono::new(reference, reference_speed).expect("legal");
        if let Ok((impact, own)) = ImpactMap::with_law(vibration, law).step_with_derivative(from)
            && impact.velocity < -0.05 * PI * forcing.min(1.0)
        {
            let other = dual_derivative(&vibration, from, impact.duration(), |speed| {
                dual_kuwabara_kono(reference, reference_speed, speed)
            });
            prop_assert!(agrees(own, other), "{own} {other}");
        }
        if let Ok((impact, own)) = ImpactMap::with_law(vibration, Softening).step_with_derivative(from)
            && impact.velocity < -0.05 * PI * forcing.min(1.0)
        {
            let other = dual_derivative(&vibration, from, impact.duration(), |speed| (speed + 1.0).recip());
            prop_assert!(agrees(own, other), "{own} {other}");
        }
    }

    /// A law that is constant but unknown to the library gives the bits of the constant one, up to the cut
    /// and after it.
    #[test]
    fn a_users_constant_law_gives_the_bits_of_the_constant_one(
        forcing in 0.05_f64..6.0, restitution in 0.0_f64..0.95, angle in 0.0..TAU, speed in 0.0_f64..4.0,
    ) {
        let constant = ImpactMap::new(vibration(forcing), restitution).expect("legal");
        let own = ImpactMap::with_law(vibration(forcing), Same(restitution));
        let from = state(angle, -speed * PI * forcing);
        for impacts in [0, 1, 20] {
            prop_assert_eq!(constant.iterate(from, impacts, &Unobserved).map(bits), own.iterate(from, impacts, &Unobserved).map(bits));
        }
        match (constant.step_with_derivative(from), own.step_with_derivative(from)) {
            (Ok((one, by_one)), Ok((other, by_other))) => {
                prop_assert_eq!(one, other);
                prop_assert_eq!(by_one, by_other);
            }
            (one, other) => prop_assert_eq!(one.err(), other.err()),
        }
        let launch = Launch::new(from.phase(), speed).expect("legal");
        for (one, other) in [
            (constant.orbit(from, PAPER_POLICY), own.orbit(from, PAPER_POLICY)),
            (constant.orbit_from_launch(launch, PAPER_POLICY), own.orbit_from_launch(launch, PAPER_POLICY)),
        ].map(|(one, other)| (one.take(500).collect::<Vec<_>>(), other.take(500).collect::<Vec<_>>())) {
            prop_assert_eq!(one, other);
        }
    }

    /// The error of a cut of a viscoelastic chatter is within its bound, and not much less: against the
    /// impacts one by one, until the rest is 1 % of the bound.
    #[test]
    fn the_error_of_a_cut_is_that_of_the_impacts_left_out(
        forcing in 0.0_f64..3.0, reference in 0.1_f64..0.95, reference_speed in 0.01_f64..10.0,
        angle in 0.0..TAU, exponent in -9.0_f64..-2.0,
    ) {
        let law = KuwabaraKono::new(reference, reference_speed).expect("legal");
        let map = ImpactMap::with_law(vibration(forcing), law);
        let mut at = state(angle, -bouncing_disk_core::numerics::elementary::pow(10.0, exponent));
        let Some(bound) = map.comes_to_rest_within(at) else { return Ok(()) };
        let mut total = 0.0;
        let mut left = bound;
        for _ in 0..200_000 {
            if left <= 0.01 * bound {
                break;
            }
            let impact = map.step(at).expect("returns");
            total += impact.duration();
            at = impact.into();
            prop_assert!(total <= bound, "{total} {bound}");
            left = map.comes_to_rest_within(at).expect("all the more");
        }
        prop_assert!(left <= 0.01 * bound, "{left} of {bound}");
        // r/(1 - r) <= 1/x costs the loss in the first impact, and the change of the pull its share.
        let pull = map.vibration().contact_force(Phase::new(angle).expect("finite"));
        let lost = 1.0 - law.restitution(bouncing_disk_core::numerics::elementary::pow(10.0, exponent));
        if bound * map.vibration().peak_acceleration() <= 0.01 * pull {
            prop_assert!(bound <= (1.1 + 2.0 * lost / (1.0 - lost)) * (total + left), "{bound} {total} {left} {lost}");
        }
    }

    /// The bound of the constant law against the closed form.
    #[test]
    fn the_closed_form_lies_within_the_bound(
        forcing in 0.0_f64..3.0, restitution in 0.05_f64..0.9, angle in 0.0..TAU, exponent in -9.0_f64..-1.0,
    ) {
        let map = ImpactMap::new(vibration(forcing), restitution).expect("legal");
        let impact = state(angle, -bouncing_disk_core::numerics::elementary::pow(10.0, exponent));
        let (Some(sum), Some(bound)) = (map.accumulation(map.rebound(impact)), map.comes_to_rest_within(impact))
        else { return Ok(()) };
        prop_assert!(sum.duration <= bound, "{} {bound}", sum.duration);
        let pull = map.vibration().contact_force(impact.phase());
        if bound * map.vibration().peak_acceleration() <= 0.01 * pull {
            prop_assert!(bound <= 1.05 * sum.duration, "{} {bound}", sum.duration);
        }
    }
}

/// On a platform at rest the pull is 1 and nothing drifts.
#[test]
fn on_a_still_platform_the_bound_of_the_constant_law_is_the_sum() {
    for restitution in [0.0, 0.3, 0.9, 0.999_999] {
        let map = ImpactMap::new(vibration(0.0), restitution).expect("legal");
        for speed in [0.0, 5e-324, 1e-300, 1e-3, 1.0, 1e100] {
            let bound = map.comes_to_rest_within(state(1.0, -speed)).expect("rests");
            let sum = 2.0 * restitution * speed / (1.0 - restitution);
            assert!((bound - sum).abs() <= 1e-11 * sum + 5e-324, "{bound} {sum}");
        }
    }
    // An infinite sum or NaN is not a bound.
    #[derive(Debug, Clone)]
    struct Sums(f64);
    impl RestitutionLaw for Sums {
        fn restitution(&self, _: f64) -> f64 {
            0.5
        }
        fn derivative(&self, _: f64) -> f64 {
            0.0
        }
        fn rebound_sum(&self, _: f64) -> Option<f64> {
            Some(self.0)
        }
    }
    for sum in [f64::NAN, f64::INFINITY, -1.0] {
        let map = ImpactMap::with_law(vibration(0.3), Sums(sum));
        assert_eq!(map.comes_to_rest_within(state(1.0, -1e-3)), None, "{sum}");
    }
    // If the platform falls away, or is about to, there is no bound.
    let map = ImpactMap::new(vibration(1.0), 0.5).expect("legal");
    let leaves = map.vibration().separation_phase().expect("leaves").angle();
    assert_eq!(map.comes_to_rest_within(state(leaves + 0.1, -1e-9)), None);
    assert_eq!(map.comes_to_rest_within(state(leaves - 1e-6, -1e-3)), None);
    assert!(map.comes_to_rest_within(state(leaves - 0.1, -1e-6)).is_some());
}

#[test]
fn a_cut_tells_its_error() {
    let law = KuwabaraKono::new(0.1, 1.0).expect("legal");
    let map = ImpactMap::with_law(vibration(0.45), law);
    let start = state(4.0, -0.3);
    let mut attachments = 0;
    for event in map.orbit(start, PAPER_POLICY).take(20_000) {
        if let OrbitEvent::Attachment(rest) = event.expect("no error") {
            let bound = rest.accumulation.error_bound;
            assert!(rest.last_speed > 0.0 && bound > 0.0 && bound < 0.05, "{rest:?}");
            assert!(rest.accumulation.duration <= 0.0, "{rest:?}");
            attachments += 1;
        }
    }
    assert!(attachments > 10, "{attachments}");
    // There is no bound for an unknown law, and none for the constant law under a cut.
    let cut = ChatterPolicy::Cut(ChatterCut::new(1e-3, 0.0, 1).expect("legal"));
    for event in [
        ImpactMap::with_law(vibration(0.2), Same(0.5)).orbit(start, cut).last(),
        ImpactMap::new(vibration(0.2), 0.5).expect("legal").orbit(start, cut).last(),
    ] {
        let Some(Ok(OrbitEvent::Attachment(rest))) = event else { panic!("{event:?}") };
        assert!(rest.accumulation.error_bound.is_infinite());
    }
}

#[test]
fn a_law_without_closed_form_refuses_the_complete_policy() {
    let map = ImpactMap::with_law(vibration(0.55), Softening);
    let start = state(1.0, -1.0);
    let launch = Launch::new(start.phase(), 1.0).expect("legal");
    for orbit in [
        map.orbit(start, ChatterPolicy::Complete),
        map.orbit_from_launch(launch, ChatterPolicy::Complete),
        map.orbit_from_drop(start.phase(), 1.0, 0.0, ChatterPolicy::Complete).expect("lands"),
    ] {
        assert_eq!(orbit.launch(), None);
        let events: Vec<_> = orbit.take(3).collect();
        assert_eq!(events, [Err(Error::NoClosedForm)]);
    }
    // The constant law gives it, however constructed.
    let constant = ImpactMap::with_law(vibration(0.55), Constant::new(0.5).expect("legal"));
    assert_eq!(constant, ImpactMap::new(vibration(0.55), 0.5).expect("legal"));
    assert!(constant.orbit(start, ChatterPolicy::Complete).take(3).all(|event| event.is_ok()));
}

#[test]
fn an_illegal_restitution_ends_the_motion_where_it_happens() {
    let start = state(0.8, -1.3 * PI);
    for then in [f64::NAN, -0.1, -5e-324, 1.0 + f64::EPSILON, 2.0, f64::INFINITY, f64::NEG_INFINITY] {
        let law = |left| Failing { left: Cell::new(left), then };
        let map = |left| ImpactMap::with_law(vibration(0.55), law(left));
        let refused = |result: Option<Result<(), Error>>| match result {
            Some(Err(Error::IllegalRestitution { restitution, impact_speed })) => {
                assert!(restitution.to_bits() == then.to_bits() && impact_speed > 0.0);
            }
            other => panic!("{other:?} for {then}"),
        };
        refused(Some(map(0).step(start).map(drop)));
        refused(Some(map(0).step_with_derivative(start).map(drop)));
        refused(Some(map(7).iterate(start, u64::MAX, &Unobserved).map(drop)));
        assert!(map(7).iterate(start, 7, &Unobserved).is_ok());
        let mut orbit = map(0).orbit(start, PAPER_POLICY);
        refused(orbit.next().map(|event| event.map(drop)));
        assert!(orbit.next().is_none());
        let mut orbit = map(3).orbit(start, PAPER_POLICY);
        assert!((0..2).all(|_| orbit.next().is_some_and(|event| event.is_ok())));
        refused(orbit.next().map(|event| event.map(drop)));
        assert!(orbit.next().is_none());
        let launch = Launch::new(start.phase(), 1.0).expect("legal");
        refused(map(0).orbit_from_launch(launch, PAPER_POLICY).next().map(|event| event.map(drop)));
    }
    // Only the derivative of the map calls a law's derivative that is NaN.
    let map = ImpactMap::with_law(vibration(0.55), Failing { left: Cell::new(100), then: 0.5 });
    assert!(map.step(start).is_ok());
    assert!(
        matches!(map.step_with_derivative(start), Err(Error::OutOfRange { value, .. }) if value.is_nan())
    );
}

/// Speeds at the ends of the range: zero, below the normal numbers, and beyond the longest flight.
#[test]
fn the_map_has_the_seams_of_the_constant_one() {
    let law = KuwabaraKono::new(0.5, 1.0).expect("legal");
    let map = ImpactMap::with_law(vibration(0.55), law);
    // At 4 rad the platform pulls; at 1.2 rad it falls away.
    assert!(matches!(map.step(state(4.0, 0.0)), Err(Error::NoLiftOff { .. })));
    assert!(matches!(map.step(state(4.0, -0.0)), Err(Error::NoLiftOff { .. })));
    let (impact, derivative) = map.step_with_derivative(state(1.2, 0.0)).expect("falls away");
    assert!(impact.duration() > 0.1 && derivative.is_finite());
    let tiny = map.step(state(4.0, -5e-324)).expect("hops");
    assert!(tiny.duration() < 1e-300);
    assert!(matches!(map.step(state(4.0, -1e300)), Err(Error::FlightTooLong { .. })));
    let orbit = map.orbit(state(4.0, 0.0), PAPER_POLICY).next();
    let Some(Ok(OrbitEvent::Attachment(rest))) = orbit else { panic!("{orbit:?}") };
    assert_eq!((rest.last_speed, rest.accumulation.error_bound), (0.0, 0.0));
}

/// The data of an orbit diagram: impacts after a transient, within the range that the platform can reach.
#[test]
fn a_chaotic_orbit_under_the_law_is_that_of_its_steps() {
    let law = KuwabaraKono::new(0.5, 4.0).expect("legal");
    let map = ImpactMap::with_law(vibration(0.9), law);
    let settled = map.iterate(state(0.8, -4.0), 10_000, &Unobserved).expect("bounces");
    let mut orbit = map.orbit(settled, ChatterPolicy::Cut(ChatterCut::new(0.0, 0.0, 1).expect("legal")));
    let mut at = settled;
    for _ in 0..1_000 {
        let Some(Ok(OrbitEvent::Impact(impact))) = orbit.next() else { panic!("an impact follows") };
        at = map.step(at).expect("bounces").into();
        assert_eq!(bits(impact.into()), bits(at));
        assert!(at.velocity() > -20.0);
    }
}

#[cfg(feature = "serde")]
#[test]
fn maps_are_stored_with_their_law() {
    let constant = ImpactMap::new(vibration(0.55), 0.5).expect("legal");
    let text = serde_json::to_string(&constant).expect("writes");
    assert!(text.ends_with(r#""restitution":0.5}"#), "{text}");
    assert_eq!(serde_json::from_str::<ImpactMap>(&text).expect("legal"), constant);
    let refusal = serde_json::from_str::<ImpactMap>(&text.replace("0.5}", "1.5}")).expect_err("illegal");
    assert!(refusal.to_string().contains("restitution = 1.5"), "{refusal}");
    let map = ImpactMap::with_law(vibration(0.55), KuwabaraKono::new(0.5, 2.0).expect("legal"));
    let text = serde_json::to_string(&map).expect("writes");
    assert_eq!(serde_json::from_str::<ImpactMap<KuwabaraKono>>(&text).expect("legal"), map);
    assert!(map.to_string().contains("restitution 0.5 at 2 g/omega"), "{map}");
}
