use core::f64::consts::PI;

use bouncing_disk_core::orbits::{BifurcationKind, Continuation, ContinuationParameter, ContinuedMap as _};
use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};

use super::*;
use crate::drive::Drive;

fn driven(drive: Result<Drive, Error>, restitution: f64) -> DrivenMap {
    DrivenMap::new(drive.expect("legal"), restitution).expect("legal")
}

fn found(map: &DrivenMap, impacts: usize, starts: u32) -> Vec<PeriodicOrbit> {
    let search = OrbitSearch::new(impacts, 1).and_then(|all| all.with_starts(starts, starts));
    map.periodic_orbits(&search.expect("legal"), &Unobserved).expect("not stopped")
}

fn guess(phase: f64, restitution: f64) -> [ImpactState; 1] {
    let phase = Phase::new(if phase < 0.0 { phase + TAU } else { phase });
    [ImpactState::new(phase.expect("legal"), -TAU / (1.0 + restitution)).expect("legal")]
}

/// Relative distances from a fold.
const OFFSETS: [f64; 5] = [1e-12, 1e-11, 1e-10, 1e-9, 1e-8];

/// By hand: an orbit of one impact needs the platform velocity c = pi (1 - r)/(1 + r). A smooth velocity with
/// the maximum c (1 + d) and the curvature -q there reaches it at sqrt(2 c d/q) on both sides. The multiplier
/// passes 1 as the acceleration passes zero: the later orbit is a node, the earlier one a saddle.
#[test]
fn beside_a_smooth_fold_there_are_two_orbits_or_none() {
    const AHEAD: f64 = 0.7;
    // cos t, cos t + cos(2 t)/2, and the same earlier.
    for (second, ahead, maximum, curvature) in
        [(0.0, 0.0, 1.0, 1.0), (0.25, 0.0, 1.5, 3.0), (0.25, AHEAD, 1.5, 3.0)]
    {
        let drive = |p: f64| Drive::fourier(&[(p, ahead), (second * p, 2.0 * ahead)]);
        let middle = -ahead;
        for restitution in [0.5, 0.95] {
            let fold = PI * (1.0 - restitution) / (1.0 + restitution) / maximum;
            for offset in OFFSETS {
                let at = |offset: f64| driven(drive(fold * (1.0 + offset)), restitution);
                let both = found(&at(offset), 1, 6);
                let case = format!("{maximum} {middle} {restitution} {offset:e}: {both:?}");
                assert_eq!(both.len(), 2, "{case}");
                let apart = (2.0 * offset * maximum / curvature).sqrt();
                for orbit in &both {
                    let from_middle = phase_difference(orbit.states[0].phase().angle(), (middle + TAU) % TAU);
                    let kind = if from_middle > 0.0 { Stability::Stable } else { Stability::Unstable };
                    assert_eq!(orbit.stability(), kind, "{case}");
                    // The amplitudes are rounded by about 1e-16.
                    let room = 1e-4 + 2e-15 / offset;
                    assert!((from_middle.abs() / apart - 1.0).abs() < room, "{case} {from_middle} {apart}");
                }
                for from in [-3e-4, -1e-6, 0.0, 1e-7, 2e-5] {
                    let near = guess(middle + from, restitution);
                    let exists = at(offset).refine(&near).expect("exists");
                    let distance = |own: &PeriodicOrbit| {
                        phase_difference(own.states[0].phase().angle(), exists.states[0].phase().angle())
                            .abs()
                    };
                    let nearest = distance(&both[0]).min(distance(&both[1]));
                    assert!(nearest <= exists.position_error, "{case} {exists:?}");
                    let none = at(-offset).refine(&near);
                    assert!(none.is_err(), "{case} {none:?}");
                }
                assert_eq!(found(&at(-offset), 1, 6), [], "{case}");
            }
            // Without restitution the disk does not leave while the acceleration is about zero.
            assert_eq!(found(&driven(drive(PI / maximum * (1.0 + 1e-10)), 0.0), 1, 6), []);
            let kinds: Vec<_> =
                found(&driven(drive(fold), restitution), 1, 6).iter().map(PeriodicOrbit::stability).collect();
            assert!(
                kinds.len() <= 1 && kinds.iter().all(|kind| *kind == Stability::Marginal),
                "{restitution} {kinds:?}"
            );
        }
    }
}

/// By hand: the velocity of the parabolas is 8 a/(2 pi) - B |t| about 0, B = 32 a/(2 pi)^2, and their fold
/// has a corner. Near it the orbits are c d/B away on both sides, with the traces 1 + r^2 -+ (1 + r)^2 B.
#[test]
fn beside_the_fold_of_parabolas_there_are_two_orbits_or_none() {
    for restitution in [0.0, 0.5, 0.95] {
        let share = (1.0 - restitution) / (1.0 + restitution);
        let fold = 0.25 * PI * PI * share;
        for offset in OFFSETS {
            let at = |offset: f64| driven(Drive::parabolas(fold * (1.0 + offset)), restitution);
            let own = found(&at(offset), 1, 6);
            let case = format!("{restitution} {offset:e}: {own:?}");
            // Without restitution the disk leaves only if the platform falls away.
            assert_eq!(own.len(), if restitution == 0.0 { 1 } else { 2 }, "{case}");
            let bend = 32.0 * fold * (1.0 + offset) / (TAU * TAU);
            for orbit in &own {
                let from_middle = phase_difference(orbit.states[0].phase().angle(), 0.0);
                let expected = PI * share * offset / bend;
                assert!((from_middle.abs() / expected - 1.0).abs() < 1e-8 + 2e-15 / offset, "{case}");
                let pull = if from_middle > 0.0 { -bend } else { bend };
                let sum = 1.0 + restitution;
                let trace = 1.0 + restitution * restitution + sum * sum * pull;
                assert!((orbit.trace() - trace).abs() < 1e-11, "{case} {trace}");
                let inside = 1.0 + restitution * restitution - trace.abs();
                let kind = if inside > 0.0 { Stability::Stable } else { Stability::Unstable };
                assert_eq!(orbit.stability(), kind, "{case}");
            }
            assert_eq!(found(&at(-offset), 1, 6), [], "{case}");
            for from in [-1e-6, 0.0, 1e-9, 1e-4] {
                let none = at(-offset).refine(&guess(from, restitution));
                assert!(none.is_err(), "{case} {none:?}");
                if restitution > 0.0 {
                    at(offset).refine(&guess(from, restitution)).expect("exists");
                }
            }
        }
        let kinds: Vec<_> = found(&driven(Drive::parabolas(fold), restitution), 1, 6)
            .iter()
            .map(PeriodicOrbit::stability)
            .collect();
        assert!(
            kinds.len() <= 1 && kinds.iter().all(|kind| *kind == Stability::Marginal),
            "{restitution} {kinds:?}"
        );
    }
}

/// By hand: on a triangle the velocity is c throughout or nowhere.
#[test]
fn on_a_triangle_there_is_a_family_or_no_orbit() {
    for restitution in [0.5, 0.95] {
        let fold = 0.5 * PI * PI * (1.0 - restitution) / (1.0 + restitution);
        let family = found(&driven(Drive::triangle(fold), restitution), 1, 12);
        let [member] = &family[..] else { panic!("{restitution}: {family:?}") };
        assert_eq!(member.stability(), Stability::Marginal);
        assert!(member.position_error > 3.0, "half of the period: {member:?}");
        for offset in OFFSETS.iter().flat_map(|offset| [-offset, *offset]) {
            let own = driven(Drive::triangle(fold * (1.0 + offset)), restitution);
            assert_eq!(found(&own, 1, 12), [], "{restitution} {offset:e}");
            assert!(own.refine(&guess(0.3, restitution)).is_err(), "{restitution} {offset:e}");
        }
    }
}

/// Pieces (duration, height and its derivatives) in units of the period, for which a slope of 1 is the
/// velocity needed for an orbit with one impact per period at the restitution 0.5.
fn in_periods(pieces: &[(f64, [f64; 3])]) -> DrivenMap {
    let own = pieces.iter().map(|&(duration, [c0, c1, c2])| {
        let height = 2.0 * PI * PI / 3.0;
        (TAU * duration, [height * c0, height * c1 / TAU, height * c2 / (TAU * TAU), 0.0])
    });
    driven(Drive::pieces(&own.collect::<Vec<_>>()), 0.5)
}

#[test]
fn each_family_is_listed_beside_other_orbits() {
    let two = in_periods(&[
        (0.25, [0.0, 1.0, 0.0]),
        (0.25, [0.25, 0.0, 0.0]),
        (0.25, [0.25, 1.0, 0.0]),
        (0.25, [0.5, -2.0, 0.0]),
    ]);
    let one = in_periods(&[(0.25, [0.0, 1.0, 0.0]), (0.25, [0.25, 2.0, -4.0]), (0.5, [0.5, -1.0, 0.0])]);
    for starts in [2, 12] {
        let phases = |map: &DrivenMap| -> Vec<f64> {
            let orbits = found(map, 1, starts);
            let mut phases: Vec<_> =
                orbits.iter().map(|orbit| orbit.states[0].phase().angle() / TAU).collect();
            phases.sort_by(f64::total_cmp);
            phases
        };
        let of_two = phases(&two);
        assert!(
            matches!(of_two[..], [first, second] if first < 0.25 && second > 0.5 && second < 0.75),
            "{of_two:?}"
        );
        let of_one = phases(&one);
        assert!(
            matches!(of_one[..], [member, single] if member < 0.25 && (single - 0.375).abs() < 1e-14),
            "{of_one:?}"
        );
    }
}

#[test]
fn members_of_a_family_across_the_seam_are_refined() {
    let map = driven(Drive::triangle(0.5 * PI * PI / 3.0), 0.5);
    for phase in [1.6 * PI, 1.9 * PI, 0.1 * PI, 0.4 * PI] {
        let own = map.refine(&guess(phase, 0.5)).expect("a member");
        assert_eq!((own.period(), own.stability()), (1, Stability::Marginal), "{phase}");
        assert!((own.states[0].phase().angle() - phase).abs() < 1e-9, "{phase} {own:?}");
        assert!((own.position_error - PI).abs() < 1e-12, "half of the period: {own:?}");
    }
}

/// Folds of longer orbits of the sine as a drive, at the places given by the sine's own equations.
#[test]
fn beside_folds_of_longer_orbits_there_are_two_or_none() {
    let sine = |forcing: f64, restitution: f64| {
        let map = ImpactMap::new(Vibration::from_axial_forcing(forcing).expect("legal"), restitution);
        map.expect("legal")
    };
    let (mut folds, mut two) = (0, 0);
    for (restitution, forcing) in [(0.5, 0.6), (0.8, 0.5), (0.3, 0.9)] {
        let own = sine(forcing, restitution);
        let search = OrbitSearch::new(3, 2).and_then(|all| all.with_starts(24, 24)).expect("legal");
        let orbits = own.periodic_orbits(&search, &Unobserved).expect("not stopped").orbits;
        for orbit in orbits.iter().filter(|orbit| orbit.period() > 1) {
            let way = Continuation::new(ContinuationParameter::Forcing, (0.2, 2.0), false).expect("legal");
            let branch = own.continued(orbit, &way, &Unobserved).expect("continued");
            let Some(fold) = branch.of_kind(BifurcationKind::Fold).next() else { continue };
            let (at, states) = (fold.point.parameter, &fold.point.orbit.states);
            folds += 1;
            for offset in OFFSETS {
                let count = |share: f64| {
                    let map = DrivenMap::new(
                        Drive::from(*sine(at * (1.0 + share), restitution).vibration()),
                        restitution,
                    );
                    let map = map.expect("legal");
                    let exact = sine(at * (1.0 + share), restitution);
                    // A guess on each side of the fold, and at it.
                    let mut known: Vec<PeriodicOrbit> = Vec::new();
                    for by in [-1e-3, -1e-5, 0.0, 1e-6, 1e-4] {
                        let moved = moved(states, &vec![DVec2::new(by, 0.0); states.len()]).expect("legal");
                        let Ok(end) = map.iterated(&moved) else { continue };
                        for orbit in map.existing(end, None) {
                            let is_here =
                                phase_difference(orbit.states[0].phase().angle(), states[0].phase().angle());
                            if is_here.abs() < 0.01
                                && !known.iter().any(|one| bouncing_disk_core::parts::same_orbit(one, &orbit))
                            {
                                assert_eq!(exact.check_orbit(&orbit), Ok(()));
                                known.push(orbit);
                            }
                        }
                    }
                    let mut kinds: Vec<_> = known.iter().map(PeriodicOrbit::stability).collect();
                    kinds.sort();
                    kinds
                };
                let [below, above] = [count(-offset), count(offset)];
                let (none, both) = if below.is_empty() { (below, above) } else { (above, below) };
                let case = format!("{restitution} {at} {offset:e} {none:?} {both:?} {states:?}");
                assert!(none.is_empty() && both.len() == 2, "{case}");
                assert!(!both.contains(&Stability::Marginal), "{case}");
                two += 1;
            }
        }
    }
    assert!(folds > 3 && two == OFFSETS.len() * folds, "{folds} {two}");
}

/// The number of orbits changes only in pairs, and an orbit that depends on rounding is marginal.
#[test]
fn contacts_that_take_time_have_two_orbits_or_none_beside_a_fold() {
    let restitution = 0.5;
    let at = |amplitude: f64| {
        let map = driven(Drive::fourier(&[(amplitude, 0.0)]), restitution).with_contact_time(0.1);
        let mut own = found(&map.expect("legal"), 1, 10);
        // Without the orbits that hardly leave the platform.
        own.retain(|orbit| orbit.states[0].velocity() < -1.0);
        own
    };
    let (mut low, mut high) = (0.9, 1.05);
    assert_eq!((at(low).len(), at(high).len()), (0, 2));
    for _ in 0..60 {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            break;
        }
        let kinds: Vec<_> = at(middle).iter().map(PeriodicOrbit::stability).collect();
        match kinds[..] {
            [] => low = middle,
            [Stability::Stable, Stability::Unstable] | [Stability::Unstable, Stability::Stable] => {
                high = middle
            }
            [Stability::Marginal] => break,
            _ => panic!("{middle} {kinds:?}"),
        }
    }
    // Rounding decides nothing beyond this.
    for offset in OFFSETS {
        assert_eq!((at(low - offset).len(), at(high + offset).len()), (0, 2), "{low} {high} {offset:e}");
    }
    assert!(high - low < 1e-12, "{low} {high}");
}

#[test]
fn orbits_have_the_order_that_is_documented() {
    let two = || Drive::fourier(&[(1.9, 0.2), (0.3, 1.0)]);
    for map in [
        driven(Drive::parabolas(2.2), 0.6),
        driven(two(), 0.5),
        driven(two(), 0.5).with_contact_time(0.1).expect("legal"),
    ] {
        let search = OrbitSearch::new(3, 3).and_then(|all| all.with_starts(20, 20)).expect("legal");
        let orbits = map.periodic_orbits(&search, &Unobserved).expect("not stopped");
        assert!(orbits.iter().filter(|orbit| orbit.period() > 1).count() > 2, "{orbits:?}");
        for orbit in &orbits {
            assert!(
                orbit.states.iter().all(|state| state.velocity() >= orbit.states[0].velocity()),
                "{orbit:?}"
            );
            assert_eq!(map.check_orbit(orbit), Ok(()));
            let shooting = map.shoot(&orbit.states).expect("flies");
            assert_eq!(shooting.monodromy, orbit.monodromy);
        }
        let key = |orbit: &PeriodicOrbit| (orbit.period(), orbit.platform_periods);
        for pair in orbits.windows(2) {
            let speeds = [&pair[0], &pair[1]].map(|orbit| -orbit.states[0].velocity());
            assert!(
                key(&pair[0]) < key(&pair[1]) || key(&pair[0]) == key(&pair[1]) && speeds[0] >= speeds[1]
            );
        }
    }
}

/// Near the first doubling, which has a closed form, the two-impact orbit agrees with the normal form.
#[test]
fn beside_a_doubling_there_is_the_doubled_orbit_or_none() {
    for restitution in [0.3, 0.8] {
        let doubling = ImpactMap::first_doubling_forcing(restitution);
        let at = |offset: f64| {
            let map = driven(Drive::fourier(&[(PI * (doubling + offset), 0.0)]), restitution);
            let parent = map.refine(&guess(0.8, restitution)).expect("exists");
            let near = |orbit: &PeriodicOrbit| {
                let here = orbit.states[0].phase().angle() - parent.states[0].phase().angle();
                here.abs() < 0.1 && orbit.platform_periods == orbit.period() as u64
            };
            let search = OrbitSearch::new(2, 2).and_then(|all| all.with_starts(12, 12)).expect("legal");
            let own = map.periodic_orbits(&search, &Unobserved).expect("not stopped");
            own.into_iter().filter(near).collect::<Vec<_>>()
        };
        let width = |orbits: &[PeriodicOrbit]| {
            let [_, doubled] = orbits else { panic!("{restitution} {orbits:?}") };
            phase_difference(doubled.states[0].phase().angle(), doubled.states[1].phase().angle()).abs()
        };
        let amplitude = width(&at(1e-5)) / 1e-5_f64.sqrt();
        for offset in [1e-6, 1e-7, 1e-8, 1e-9] {
            let own = at(offset);
            let kinds: Vec<_> = own.iter().map(|own| (own.period(), own.stability())).collect();
            assert_eq!(kinds, [(1, Stability::Unstable), (2, Stability::Stable)], "{restitution} {offset:e}");
            let share = width(&own) / (amplitude * offset.sqrt());
            assert!((share - 1.0).abs() < 1e-2, "{restitution} {offset:e} {share}");
        }
        for offset in [-1e-6, -1e-8, -1e-10] {
            let kinds: Vec<_> = at(offset).iter().map(|own| (own.period(), own.stability())).collect();
            assert_eq!(kinds, [(1, Stability::Stable)], "{restitution} {offset:e}");
        }
    }
}
