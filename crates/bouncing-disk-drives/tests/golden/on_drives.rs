//! Digests of results on drives and with compliant contacts: see the digests of the core.

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::attractors::{AttractingMap as _, Axis, BasinSettings, Grid, KnownOrbit};
use bouncing_disk_core::numerics::digest::Digest;
use bouncing_disk_core::orbits::{
    Bifurcation, BifurcationKind, Continuation, ContinuationParameter, ContinuedMap as _, OrbitSearch,
    Stability,
};
use bouncing_disk_core::{Attachment, ChatterPolicy, ImpactState, OrbitEvent, Unobserved};
use bouncing_disk_drives::{Drive, DrivenFamily, DrivenMap};

use crate::results::{RESTITUTION, add_branch, add_orbit, add_state, first, one, second};

/// Events of orbits of one map.
fn add_orbits(digest: &mut Digest, map: &DrivenMap) {
    for k in 0..20 {
        let start = ImpactState::from_normalised(TAU * first(k), 2.0 * second(k)).expect("legal");
        let mut orbit = map.orbit(start, ChatterPolicy::Complete);
        for _ in 0..300 {
            match orbit.advance().expect("no failure") {
                Some(OrbitEvent::Impact(landing)) => {
                    add_state(digest, landing.into());
                    digest.number(landing.remainder);
                }
                Some(OrbitEvent::Attachment(Attachment { accumulation, last_speed, .. })) => {
                    digest.number(accumulation.phase.angle());
                    digest.number(last_speed);
                }
                Some(OrbitEvent::Separation(change) | OrbitEvent::Kick(change)) => {
                    digest.number(change.phase.angle());
                    digest.number(change.velocity);
                }
                Some(_) => digest.bytes(b"another event"),
                None => break,
            }
        }
    }
}

/// Orbits on platforms other than a sine, with their contacts.
pub(crate) fn orbits_on_drives() -> Vec<String> {
    let samples: Vec<f64> = (0..64).map(|k| 2.0 * first(k) * second(k)).collect();
    let drives = [
        Drive::fourier(&[(1.4, 0.0), (0.2, 1.0), (0.1, 0.5)]),
        Drive::triangle(2.0),
        Drive::sawtooth(2.0, 0.3),
        Drive::parabolas(1.5),
        Drive::cubics(1.5),
        Drive::sampled(&samples),
    ];
    let mut digest = Digest::new();
    for drive in drives {
        add_orbits(&mut digest, &DrivenMap::new(drive.expect("legal"), RESTITUTION).expect("legal"));
    }
    one("orbits on drives", digest, 0x461c_4c22_578d_7a1f)
}

/// Orbits with compliant contacts of both laws, on a sine and on another drive.
pub(crate) fn orbits_with_compliance() -> Vec<String> {
    let mut digest = Digest::new();
    for harmonics in [&[(20.0, 0.0)][..], &[(1.4, 0.0), (0.2, 1.0)]] {
        for contact_time in [0.1, 3.0, 7.0] {
            let map = DrivenMap::new(Drive::fourier(harmonics).expect("legal"), RESTITUTION).expect("legal");
            add_orbits(&mut digest, &map.clone().with_contact_time(contact_time).expect("legal"));
            add_orbits(&mut digest, &map.with_hysteretic_contact(contact_time).expect("legal"));
        }
    }
    one("orbits with compliance", digest, 0xafa7_04ee_08bb_0b1f)
}

/// Periodic orbits of up to `most` impacts in as many periods, and basins on a grid of `cells` cells per
/// side, for drives and a compliant contact. The recorded digests cover both.
pub(crate) fn periodic_orbits_on_drives(most: u8, cells: u8, recorded: [u64; 2]) -> Vec<String> {
    let search = OrbitSearch::new(most.into(), most.into()).expect("legal");
    let drives = [
        Drive::fourier(&[(1.4, 0.0), (0.2, 1.0), (0.1, 0.5)]),
        Drive::triangle(2.0),
        Drive::parabolas(1.5),
        Drive::cubics(1.5),
    ];
    let maps = drives.map(|drive| DrivenMap::new(drive.expect("legal"), RESTITUTION).expect("legal"));
    let soft = maps[0].clone().with_contact_time(0.3).expect("legal");
    let (mut orbits, mut labels) = (Digest::new(), Digest::new());
    let axis = |high| Axis::new(0.0, high, cells.into()).expect("legal");
    let grid = Grid::new(axis(1.0), axis(2.0)).expect("legal");
    let settings = BasinSettings { max_impacts: 300, policy: ChatterPolicy::Complete };
    for map in maps.iter().chain([&soft]) {
        let found = map.periodic_orbits(&search, &Unobserved).expect("no failure");
        found.iter().for_each(|orbit| add_orbit(&mut orbits, orbit));
        let known = found.into_iter().filter(|orbit| orbit.stability() == Stability::Stable);
        let known: Vec<_> = known.map(|orbit| KnownOrbit::new(orbit, 1.0e-3).expect("legal")).collect();
        labels.bytes(map.basins(grid, &known, settings, &Unobserved).expect("no failure").labels());
    }
    let mut lines = one("periodic orbits on drives", orbits, recorded[0]);
    lines.extend(one("basins on drives", labels, recorded[1]));
    lines
}

/// Branches over the forcing, a harmonic and the contact time, and the branches that begin at their
/// doublings.
pub(crate) fn branches_on_drives() -> Vec<String> {
    let map = |drive: Result<Drive, _>| DrivenMap::new(drive.ok()?, RESTITUTION).ok();
    let parabolas = move |forcing: f64| map(Drive::parabolas(PI * forcing));
    let sum = move |second: f64| map(Drive::fourier(&[(1.2, 0.0), (second, 0.4)]));
    let soft = move |time: f64| map(Drive::fourier(&[(1.3, 0.0)]))?.with_contact_time(time).ok();
    let families = [
        DrivenFamily::new(0.35, 0.35, parabolas),
        DrivenFamily::new(0.05, 1.0, sum),
        DrivenFamily::new(0.3, 1.0, soft),
    ];
    let search = OrbitSearch::new(1, 1).expect("legal");
    let mut digest = Digest::new();
    for family in families {
        let family = family.expect("has a map");
        let orbits = family.map().periodic_orbits(&search, &Unobserved).expect("no failure");
        for orbit in orbits {
            for rising in [false, true] {
                let settings = Continuation::new(ContinuationParameter::Number, (-0.5, 2.0), rising);
                let settings = settings.and_then(|settings| settings.with_steps(0.01, 0.05, 100));
                let settings = settings.expect("legal");
                let branch = family.continued(&orbit, &settings, &Unobserved).expect("continued");
                add_branch(&mut digest, &branch);
                let doubles = |found: &Bifurcation| found.kind == BifurcationKind::Doubling;
                if let Some(index) = branch.bifurcations.iter().position(doubles) {
                    let doubled = branch.switched(index, &settings, &Unobserved).expect("doubles");
                    add_branch(&mut digest, &doubled);
                }
            }
        }
    }
    one("branches on drives", digest, 0xa9b8_6914_a0ad_ea9d)
}
