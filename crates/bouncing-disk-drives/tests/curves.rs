//! Curves of bifurcations on drives and compliant contacts, against closed forms and against `continued`.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::Unobserved;
use bouncing_disk_core::numerics::elementary::{atan2, hypot, sin_cos};
use bouncing_disk_core::orbits::{
    BifurcationKind, Branch, Continuation, ContinuationParameter, ContinuedMap as _, Curve, CurveEnd,
    OrbitSearch, SpecialKind, Stability,
};
use bouncing_disk_drives::{Drive, DrivenFamily, DrivenMap};

const NUMBERS: [ContinuationParameter; 2] =
    [ContinuationParameter::Number, ContinuationParameter::SecondNumber];

const RESTITUTION: f64 = 0.5;

/// The maps with an amplitude of the first harmonic, over both components of a second one, x sin 2t + y cos 2t.
fn second_harmonic(first: f64) -> impl Fn([f64; 2]) -> Option<DrivenMap> + Send + Sync {
    move |[x, y]| {
        let drive = Drive::fourier(&[(first, 0.0), (hypot(x, y), atan2(y, x))]).ok()?;
        DrivenMap::new(drive, RESTITUTION).ok()
    }
}

/// By hand: one impact in one period at the phase t where the platform's velocity is pi (1 - r)/(1 + r) and its
/// acceleration is `acceleration`.
fn by_hand(first: f64, phase: f64, acceleration: f64) -> [f64; 2] {
    let wanted = PI * (1.0 - RESTITUTION) / (1.0 + RESTITUTION);
    let ((s, c), (s2, c2)) = (sin_cos(phase), sin_cos(2.0 * phase));
    let (a, b) = (0.5 * (wanted - first * c), -0.25 * (acceleration + first * s));
    [a * c2 + b * s2, b * c2 - a * s2]
}

/// The acceleration of the platform at the impact of a fold and of a doubling.
fn acceleration(kind: BifurcationKind) -> f64 {
    let whole = 1.0 + RESTITUTION;
    if kind == BifurcationKind::Fold {
        0.0
    } else {
        -2.0 * (1.0 + RESTITUTION * RESTITUTION) / (whole * whole)
    }
}

/// The branch over x that has a bifurcation of this kind at this phase, and the number of that.
fn branch(first: f64, kind: BifurcationKind, phase: f64) -> (Branch<DrivenFamily>, usize) {
    let [x, y] = by_hand(first, phase, acceleration(kind));
    for beside in [0.02, -0.02] {
        let family = DrivenFamily::of_two([x + beside, y], [1.0; 2], second_harmonic(first)).unwrap();
        let search = OrbitSearch::new(1, 1).unwrap().with_starts(8, 8).unwrap();
        for orbit in family.map().periodic_orbits(&search, &Unobserved).unwrap() {
            let settings = Continuation::new(NUMBERS[0], (x - 0.1, x + 0.1), beside < 0.0).unwrap();
            let branch = family.continued(&orbit, &settings, &Unobserved).unwrap();
            let is_it = |found: &bouncing_disk_core::orbits::Bifurcation| {
                found.kind == kind && (found.point.parameter - x).abs() < 1e-9
            };
            if let Some(index) = branch.bifurcations.iter().position(is_it) {
                return (branch, index);
            }
        }
    }
    panic!("{kind:?} {phase}")
}

fn curve(first: f64, kind: BifurcationKind, phase: f64, rising: bool) -> Curve<DrivenFamily> {
    let (branch, index) = branch(first, kind, phase);
    let settings =
        Continuation::new(NUMBERS[1], (-3.0, 3.0), rising).unwrap().with_steps(0.01, 0.05, 1_000).unwrap();
    branch.curve(index, (-3.0, 3.0), &settings, &Unobserved).unwrap()
}

/// In the plane of both components of a second harmonic a curve of folds or doublings is closed, as the phase of the
/// impact goes once round.
#[test]
fn closed_curves_are_those_by_hand() {
    for kind in [BifurcationKind::Fold, BifurcationKind::Doubling] {
        for (phase, rising) in [(1.0, true), (1.0, false), (4.0, true)] {
            let curve = curve(0.5, kind, phase, rising);
            assert_eq!(curve.end, CurveEnd::Closed, "{kind:?} {phase}");
            let mut turned = 0.0;
            for (last, point) in curve.points.iter().zip(&curve.points[1..]) {
                let [from, to] = [last, point].map(|point| point.states[0].phase().angle());
                let step = to - from;
                turned += step - TAU * (step / TAU).round();
            }
            assert!((turned.abs() - TAU).abs() < 0.2, "{turned}");
            for point in &curve.points {
                let exact = by_hand(0.5, point.states[0].phase().angle(), acceleration(kind));
                let off = hypot(exact[0] - point.parameters[0], exact[1] - point.parameters[1]);
                assert!(off < 1e-12, "{off:e} {point:?}");
            }
        }
    }
}

/// By hand a fold has a cusp where the third derivative vanishes, too: with (x, y) of the fold at the phase t,
/// d(x, y)/dt = 0.
#[test]
fn cusps_are_those_by_hand() {
    // Cusps need a first harmonic of at least 4 pi/9.
    let first = 1.45;
    let third = |phase: f64| {
        let ([x, y], (s2, c2)) = (by_hand(first, phase, 0.0), sin_cos(2.0 * phase));
        -first * sin_cos(phase).1 - 8.0 * (x * c2 - y * s2)
    };
    let mut exact = Vec::new();
    for step in 0..1_000 {
        let (mut low, mut high) = (TAU * f64::from(step) / 1e3, TAU * f64::from(step + 1) / 1e3);
        let sign = third(low);
        if sign * third(high) < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if third(middle) * sign > 0.0 { low = middle } else { high = middle }
            }
            exact.push(by_hand(first, low, 0.0));
        }
    }
    let curve = curve(first, BifurcationKind::Fold, 0.0, true);
    let found: Vec<_> = curve.of_kind(SpecialKind::Cusp).collect();
    assert_eq!((found.len(), exact.len()), (2, 2), "{exact:?} {:?} {:?}", curve.end, curve.special);
    for cusp in found {
        let is_it = |exact: &&[f64; 2]| {
            (0..2).all(|k| (exact[k] - cusp.point.parameters[k]).abs() <= cusp.point.errors[k])
        };
        assert!(exact.iter().any(|exact| is_it(&exact)), "{cusp:?} {exact:?}");
        assert!(cusp.point.errors.iter().all(|error| *error < 1e-11), "{cusp:?}");
    }
}

/// Of one impact in two periods of parabolas: by hand the doubling at Gamma = (pi/4)(1 + r^2)/(1 + r)^2, which meets the
/// corner of the acceleration, Gamma = (pi/2)(1 - r)/(1 + r), at r = 1/sqrt(3).
#[test]
fn a_curve_ends_at_a_joint() {
    let doubling = |r: f64| 0.25 * PI * (1.0 + r * r) / ((1.0 + r) * (1.0 + r));
    let maps = |[forcing, r]: [f64; 2]| DrivenMap::new(Drive::parabolas(PI * forcing).ok()?, r).ok();
    let corner = 0.5 * PI * 0.3 / 1.7;
    let family = DrivenFamily::of_two([0.5 * (doubling(0.7) + corner), 0.7], [1.0; 2], maps).unwrap();
    let search = OrbitSearch::new(1, 2).unwrap().with_starts(8, 8).unwrap();
    let found = family.map().periodic_orbits(&search, &Unobserved).unwrap();
    let orbit = found.iter().find(|orbit| orbit.platform_periods == 2).unwrap();
    let settings = Continuation::new(NUMBERS[0], (0.2, 0.6), true).unwrap();
    let branch = family.continued(orbit, &settings, &Unobserved).unwrap();
    let index = branch.bifurcations.iter().position(|found| found.kind == BifurcationKind::Doubling).unwrap();
    for (rising, end) in [(false, 1.0 / 3.0_f64.sqrt()), (true, 0.95)] {
        let settings = Continuation::new(NUMBERS[1], (0.3, 0.95), rising).unwrap();
        let curve = branch.curve(index, (0.1, 2.0), &settings, &Unobserved).unwrap();
        for point in &curve.points {
            let off = (point.parameters[0] - doubling(point.parameters[1])).abs();
            assert!(off < 1e-12 && off <= point.errors[0], "{off:e} {point:?}");
        }
        let is_border = matches!(curve.end, CurveEnd::BorderCollision { impact: 0 });
        assert_eq!(is_border, !rising, "{:?} {:?}", curve.end, curve.points.last());
        let last = curve.points.last().unwrap().parameters[1];
        assert!((last - end).abs() < 1e-6, "{last} {end}");
    }
}

/// Doublings of one impact over the forcing and the duration of the contacts, against the branch at another duration.
#[test]
fn a_curve_over_the_duration_of_contacts_is_that_of_continued() {
    let maps = |[forcing, periods]: [f64; 2]| {
        let rigid = DrivenMap::new(Drive::fourier(&[(PI * forcing, 0.0)]).ok()?, 0.5).ok()?;
        rigid.with_contact_time(TAU * periods).ok()
    };
    let doubling = |periods: f64| {
        let family = DrivenFamily::of_two([0.44, periods], [0.5, 0.5], maps).unwrap();
        let search = OrbitSearch::new(1, 1).unwrap().with_starts(16, 16).unwrap();
        let found = family.map().periodic_orbits(&search, &Unobserved).unwrap();
        let orbit = found.iter().find(|orbit| orbit.stability() == Stability::Stable).unwrap();
        let settings = Continuation::new(NUMBERS[0], (0.3, 0.7), true).unwrap();
        let branch = family.continued(orbit, &settings, &Unobserved).unwrap();
        let index =
            branch.bifurcations.iter().position(|found| found.kind == BifurcationKind::Doubling).unwrap();
        (branch, index)
    };
    let (branch, index) = doubling(0.02);
    let settings =
        Continuation::new(NUMBERS[1], (0.01, 0.06), true).unwrap().with_steps(0.01, 0.02, 40).unwrap();
    let curve = branch.curve(index, (0.3, 0.7), &settings, &Unobserved).unwrap();
    assert_eq!(curve.end, CurveEnd::RangeLimit { parameter: NUMBERS[1], value: 0.06 });
    for point in curve.points.iter().skip(1) {
        let (branch, index) = doubling(point.parameters[1]);
        let off = (branch.bifurcations[index].point.parameter - point.parameters[0]).abs();
        assert!(off <= point.errors[0] && point.errors[0] < 1e-10, "{off:e} {point:?}");
    }
}
