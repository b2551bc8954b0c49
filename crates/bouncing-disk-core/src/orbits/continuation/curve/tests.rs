use super::*;
use crate::map::impact_map::map;
use crate::orbits::closing::ContinuationParameter::{Forcing, Restitution};
use crate::orbits::periodic::PeriodicOrbit;
use crate::run::Unobserved;

/// 1 - r over 1 + r.
fn loss(restitution: f64) -> f64 {
    (1.0 - restitution) / (1.0 + restitution)
}

/// By hand: one impact every k periods doubles where 2 (1 + r^2) = (1 + r)^2 pi Gamma sin tau, with
/// cos tau = k (1 - r)/((1 + r) Gamma).
fn doubling(k: u64, restitution: f64) -> f64 {
    let whole = 1.0 + restitution;
    let sine = 2.0 * (1.0 + restitution * restitution) / (core::f64::consts::PI * whole * whole);
    let cosine = k as f64 * loss(restitution);
    (sine * sine + cosine * cosine).sqrt()
}

/// The branch over the forcing of one impact every k periods.
fn branch(k: u64, restitution: f64) -> Branch {
    let fold = k as f64 * loss(restitution);
    let doubling = doubling(k, restitution);
    let map = map(0.5 * (fold + doubling), restitution);
    let node = map.period_one_pair(k).expect("above its birth").node;
    let orbit: PeriodicOrbit = node.orbit(&map).expect("no failure").expect("admissible");
    let settings = Continuation::new(Forcing, (0.5 * fold, 2.0 * doubling), false).expect("legal");
    let down = map.continued(&orbit, &settings, &Unobserved).expect("continued");
    let settings = Continuation::new(Forcing, (0.5 * fold, 2.0 * doubling), true).expect("legal");
    let up = map.continued(&orbit, &settings, &Unobserved).expect("continued");
    let bifurcations = [down.bifurcations, up.bifurcations].concat();
    Branch { bifurcations, ..up }
}

fn index(branch: &Branch, kind: BifurcationKind) -> usize {
    branch.bifurcations.iter().position(|found| found.kind == kind).expect("found")
}

#[test]
fn period_one_folds_and_doubles_where_it_does_by_hand() {
    for k in 1..=3 {
        for (kind, by_hand) in [
            (BifurcationKind::Fold, (|k, r| k as f64 * loss(r)) as fn(u64, f64) -> f64),
            (BifurcationKind::Doubling, doubling),
        ] {
            let branch = branch(k, 0.5);
            let start = index(&branch, kind);
            for (rising, limit) in [(true, 0.999), (false, 0.05)] {
                let settings = Continuation::new(Restitution, (0.05, 0.999), rising).expect("legal");
                let curve = branch.curve(start, (1e-4, 6.0), &settings, &Unobserved).expect("continued");
                for point in &curve.points {
                    let [forcing, restitution] = point.parameters;
                    let off = (forcing - by_hand(k, restitution)).abs();
                    assert!(off < 1e-12, "{point:?}");
                    assert!(off <= point.errors[0], "{off} {point:?}");
                }
                assert_eq!(curve.end, CurveEnd::RangeLimit { parameter: Restitution, value: limit });
            }
        }
    }
}
