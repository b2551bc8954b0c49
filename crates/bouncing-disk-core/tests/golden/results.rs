//! Digests of results, recorded before the work on speed: a faster solver must not change any bit.
//!
//! A different digest means that the arithmetic of a flight, or a decision in it, has changed. Such a change
//! needs its own reason (docs/numerics-impacts.md, "Same bits everywhere"); record new digests only together
//! with it.
//!
//! `crates/bouncing-disk/tests/same_bits.rs` compares them on other processors, too.

use std::f64::consts::TAU;

use bouncing_disk_core::attractors::{
    AttractorKind, AttractorSearch, Axis, BasinSettings, Grid, KnownOrbit, Label, VerdictSettings, verdicts,
};
use bouncing_disk_core::chaos::lyapunov_spectra;
use bouncing_disk_core::numerics::double_double::DoubleDouble;
use bouncing_disk_core::numerics::elementary;
use bouncing_disk_core::orbits::{
    BifurcationKind, Branch, BranchPoint, Continuation, ContinuationParameter, ContinuedMap, OrbitSearch,
    PeriodicOrbit, doubling_cascade,
};
use bouncing_disk_core::sweep::{InstructionSet, OrbitBatch};
use bouncing_disk_core::{ChatterPolicy, ImpactMap, ImpactState, OrbitEvent, Phase, Unobserved, Vibration};

use bouncing_disk_core::numerics::digest::Digest;

/// Half: dividing a launch speed by it, to get the previous impact, is exact.
pub(crate) const RESTITUTION: f64 = 0.5;
const LAUNCHES: u64 = 100_000;
const ORBIT_IMPACTS: usize = 100_000;
const CELLS: usize = 200;

/// Adds the four numbers of an impact.
pub(crate) fn add_state(digest: &mut Digest, state: ImpactState) {
    let phase = state.phase();
    for number in [phase.angle(), phase.sin(), phase.cos(), state.velocity()] {
        digest.number(number);
    }
}

/// Evenly spread numbers in [0, 1).
fn spread(k: u64, factor: f64) -> f64 {
    (k as f64 * factor) % 1.0
}

pub(crate) fn first(k: u64) -> f64 {
    spread(k, 0.618_033_988_749_894_9)
}

pub(crate) fn second(k: u64) -> f64 {
    spread(k, 0.754_877_666_246_692_7)
}

fn third(k: u64) -> f64 {
    spread(k, 0.569_840_290_998_053_3)
}

/// Peak acceleration, launch phase and launch speed.
type Start = (f64, f64, f64);
/// The launches of one kind, by number.
type Regime = fn(u64) -> Start;

fn monotone(k: u64) -> Start {
    let peak = 1.0 + 2.0 * third(k);
    (peak, TAU * first(k), (1.0 + peak) * (1.0 + 3.0 * second(k)))
}

fn guarded(k: u64) -> Start {
    let peak = 1.0 + 9.0 * third(k);
    (peak, TAU * first(k), (1.0 + peak) * (0.2 + 0.8 * second(k)))
}

fn still(k: u64) -> Start {
    (third(k), TAU * first(k), 0.01 + 3.0 * second(k))
}

fn chatter(k: u64) -> Start {
    let peak = 3.0 * third(k);
    (peak, TAU * first(k), libm::exp10(-8.0 * second(k)))
}

/// From rest, at any phase at which the platform falls away.
fn rest(k: u64) -> Start {
    let peak = 1.0 + 1.0e-6 + 20.0 * third(k);
    let separation = elementary::asin(1.0 / peak) + 1.0e-9;
    let retention = TAU / 2.0 - 1.0e-9 - separation;
    (peak, separation + (retention - separation) * first(k), 0.0)
}

/// A flight that touches the platform as it falls away, or passes it closely: traced back from the touch,
/// with the speed changed by between 1e-3 and a rounding.
fn grazing(k: u64) -> Start {
    let peak = 1.2 + 8.0 * third(k);
    let separation = elementary::asin(1.0 / peak);
    let touch = separation + (TAU / 4.0 - separation) * (0.05 + 0.9 * first(k));
    let (sin, cos) = elementary::sin_cos(touch);
    let gap =
        |back: f64| peak * sin - back * (peak * cos + 0.5 * back) - peak * elementary::sin(touch - back);
    let (mut inside, mut outside) = (0.01, 0.01);
    while gap(outside) > 0.0 {
        inside = outside;
        outside += 0.02;
    }
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if gap(middle) > 0.0 {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    let speed = peak * cos + inside - peak * elementary::cos(touch - inside);
    let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    let off = libm::exp10(-3.0 - 13.0 * second(k));
    (peak, touch - inside, speed * (1.0 + sign * off))
}

/// The motor of Table III: P = A omega^2 / g for 1e-8 m at 70 kHz.
fn motor(k: u64) -> Start {
    (197.392_088, TAU * first(k), 500.0 * second(k) * third(k))
}

fn strongly_forced(k: u64) -> Start {
    let peak = libm::exp10(2.0 + 3.0 * third(k));
    (peak, TAU * first(k), 2.0 * peak * second(k))
}

/// Flights of up to a million periods.
fn long(k: u64) -> Start {
    (10.0 * third(k), TAU * first(k), 3.0 * libm::exp10(6.0 * second(k)))
}

fn prepared(regime: Regime) -> Vec<(ImpactMap, ImpactState)> {
    (0..LAUNCHES)
        .map(|k| {
            let (peak, angle, speed) = regime(k);
            let map = ImpactMap::new(Vibration::new(peak).expect("legal"), RESTITUTION).expect("legal");
            let phase = Phase::new(angle).expect("finite");
            (map, ImpactState::new(phase, -speed / RESTITUTION).expect("legal"))
        })
        .collect()
}

/// Digests of the flights of these launches (durations) and of the impacts that end them. A launch without
/// impact keeps its state, as in an [`OrbitBatch`].
fn one_by_one(launches: &[(ImpactMap, ImpactState)]) -> [u64; 2] {
    let (mut flights, mut impacts) = (Digest::new(), Digest::new());
    for &(map, state) in launches {
        let Ok(impact) = map.step(state) else {
            flights.bytes(b"none");
            add_state(&mut impacts, state);
            continue;
        };
        flights.bytes(&impact.periods.to_le_bytes());
        flights.bytes(&impact.turns.to_le_bytes());
        flights.number(impact.remainder);
        add_state(&mut impacts, impact.into());
    }
    [flights.value(), impacts.value()]
}

/// The digest of the same impacts, computed in lockstep.
fn together(launches: &[(ImpactMap, ImpactState)], set: InstructionSet) -> u64 {
    let mut ensemble = OrbitBatch::with_instruction_set(launches.iter().copied(), set);
    // A launch from rest while the platform does not fall away has no impact and keeps its state.
    let _ = ensemble.step();
    let mut impacts = Digest::new();
    (0..ensemble.len()).for_each(|k| add_state(&mut impacts, ensemble.state(k).expect("exists")));
    impacts.value()
}

/// The differences from the recorded digests, one per line.
fn differences(name: &str, launches: &[(ImpactMap, ImpactState)], recorded: [u64; 2]) -> Vec<String> {
    let digests = one_by_one(launches);
    let mut lines = Vec::new();
    if digests != recorded {
        lines.push(format!("{name}, one by one: [{:#018x}, {:#018x}]", digests[0], digests[1]));
    }
    for set in InstructionSet::available() {
        let lanes = together(launches, set);
        if lanes != digests[1] {
            lines.push(format!("{name} with {set:?}: {lanes:#018x}, one by one {:#018x}", digests[1]));
        }
    }
    lines
}

/// The difference from one recorded digest.
pub(crate) fn one(name: &str, digest: Digest, recorded: u64) -> Vec<String> {
    if digest.value() == recorded { Vec::new() } else { vec![format!("{name}: {:#018x}", digest.value())] }
}

/// The differences in launches of every kind.
pub(crate) fn launches_of_every_regime() -> Vec<String> {
    let regimes: [(&str, Regime, [u64; 2]); 9] = [
        ("monotone", monotone, [0xdfe2_a0cc_9a1b_00d4, 0x5d08_2394_1611_8a1f]),
        ("guarded", guarded, [0xd0b1_c4c4_a9fb_df9e, 0xc402_e885_84c9_2f8e]),
        ("still", still, [0x057d_f178_251b_f12e, 0x8b9c_4c48_04ca_592b]),
        ("chatter", chatter, [0xb203_d7b4_e066_6b50, 0xeac0_9ae9_71e2_32de]),
        ("rest", rest, [0x3d4b_dad1_f9b5_e254, 0xfb7a_d8fe_0cc6_3f87]),
        ("grazing", grazing, [0x1cbf_6406_8cab_4576, 0xd96f_6808_5b06_30f3]),
        ("motor", motor, [0x7616_b03f_8785_372d, 0x38ae_4d70_b0ba_ad30]),
        ("strongly forced", strongly_forced, [0x32ed_a600_1014_7d6d, 0xc091_60ec_f42b_f824]),
        ("long", long, [0xc4ff_f976_8ce3_6ead, 0x0ad8_086a_619e_370f]),
    ];
    regimes
        .into_iter()
        .flat_map(|(name, regime, recorded)| differences(name, &prepared(regime), recorded))
        .collect()
}

/// W1 of data/performance/README.md. For the lanes, every state of the orbit is a separate launch.
pub(crate) fn chaotic_orbit() -> Vec<String> {
    let vibration = Vibration::from_axial_forcing(0.55).expect("legal");
    let map = ImpactMap::new(vibration, RESTITUTION).expect("legal");
    let mut state = ImpactState::from_normalised(0.8, 1.3).expect("legal");
    let launches: Vec<_> = (0..ORBIT_IMPACTS)
        .map(|_| {
            let before = state;
            state = map.step(before).expect("an impact follows").into();
            (map, before)
        })
        .collect();
    let recorded = [0x6668_6b19_7e4a_6dff, 0x70d4_dca4_687d_8111];
    differences("chaotic orbit", &launches, recorded)
}

/// The orbits of the two policies, with their attachments.
pub(crate) fn orbits_with_chatter(paper_policy: ChatterPolicy) -> Vec<String> {
    let mut digest = Digest::new();
    for policy in [ChatterPolicy::Complete, paper_policy] {
        for k in 0..40 {
            let vibration = Vibration::from_axial_forcing(0.34 + 0.05 * k as f64).expect("legal");
            let map = ImpactMap::new(vibration, RESTITUTION).expect("legal");
            let start = ImpactState::from_normalised(TAU * first(k), 2.0 * second(k)).expect("legal");
            for event in map.orbit(start, policy).take(1_000) {
                match event.expect("no failure") {
                    OrbitEvent::Impact(impact) => add_state(&mut digest, impact.into()),
                    OrbitEvent::Attachment(stick) => {
                        digest.number(stick.accumulation.phase.angle());
                        digest.number(stick.last_speed);
                    }
                    _ => digest.bytes(b"another event"),
                }
            }
        }
    }
    one("orbits with chatter", digest, 0x4ef0_e214_d440_d948)
}

/// W3 of data/performance/README.md on a smaller grid.
pub(crate) fn basin_labels() -> Vec<String> {
    let vibration = Vibration::from_axial_forcing(0.5).expect("legal");
    let map = ImpactMap::new(vibration, RESTITUTION).expect("legal");
    let start = ImpactState::from_normalised(0.8, 1.3).expect("legal");
    let orbit =
        map.settled_orbit(start, 4_000, 4, 1.0e-8, &Unobserved).expect("no failure").expect("settles");
    let radius = orbit.trapping_radius(&map, 64, &Unobserved).expect("it attracts");
    let known = [KnownOrbit::new(orbit, radius).expect("legal")];
    let axis = |high| Axis::new(0.0, high, CELLS).expect("legal");
    let grid = Grid::new(axis(1.0), axis(2.0)).expect("legal");
    let settings = BasinSettings { max_impacts: 500, policy: ChatterPolicy::Complete };
    let one_by_one: Vec<Label> = (0..CELLS * CELLS)
        .map(|cell| {
            let angle = grid.impact_angle(cell % CELLS);
            let start =
                ImpactState::from_normalised(angle, grid.speed().centre(cell / CELLS)).expect("legal");
            map.basin_label(start, &known, settings).expect("no failure")
        })
        .collect();
    let mut digest = Digest::new();
    digest.bytes(&one_by_one);
    let mut lines = one("basin labels", digest, 0x7cd3_49bf_9543_3cca);
    let together = map.basins(grid, &known, settings, &Unobserved).expect("no failure");
    if together.labels() != one_by_one {
        lines.push("labels in lockstep differ from those one by one".to_owned());
    }
    lines
}

fn add_point(digest: &mut Digest, point: &BranchPoint) {
    for number in [point.parameter, point.trace, point.determinant, point.arclength] {
        digest.number(number);
    }
    point.orbit.states.iter().for_each(|state| add_state(digest, *state));
}

pub(crate) fn add_branch<M: ContinuedMap>(digest: &mut Digest, branch: &Branch<M>) {
    branch.points.iter().for_each(|point| add_point(digest, point));
    for bifurcation in &branch.bifurcations {
        digest.bytes(bifurcation.kind.name().as_bytes());
        add_point(digest, &bifurcation.point);
    }
}

/// Branches over both parameters and in both directions, and the branches that begin at their doublings.
pub(crate) fn branches() -> Vec<String> {
    let vibration = Vibration::from_axial_forcing(0.45).expect("legal");
    let map = ImpactMap::new(vibration, RESTITUTION).expect("legal");
    let orbit = map.refine(&[map.period_one(1).expect("exists")]).expect("refines");
    let (mut continued, mut switched) = (Digest::new(), Digest::new());
    for (parameter, range) in
        [(ContinuationParameter::Forcing, (0.1, 0.6)), (ContinuationParameter::Restitution, (0.1, 0.9))]
    {
        for rising in [false, true] {
            let settings = Continuation::new(parameter, range, rising).expect("legal");
            let branch = map.continued(&orbit, &settings, &Unobserved).expect("found");
            add_branch(&mut continued, &branch);
            let doubling = branch.bifurcations.iter().position(|one| one.kind == BifurcationKind::Doubling);
            if let Some(index) = doubling {
                let branch = branch.switched(index, &settings, &Unobserved).expect("found");
                add_branch(&mut switched, &branch);
            }
        }
    }
    let mut lines = one("continued branches", continued, 0xd963_20aa_b414_c07b);
    lines.extend(one("switched branches", switched, 0xb9a2_b265_f4a8_b6c2));
    lines
}

/// The cascade in doubles and double-doubles.
pub(crate) fn cascade() -> Vec<String> {
    let mut digest = Digest::new();
    for restitution in [0.2, RESTITUTION] {
        for one in doubling_cascade(restitution, 8, &Unobserved).expect("found").doublings {
            let numbers = [one.axial_forcing, one.forcing_error, one.multiplier, one.width, one.graze_margin];
            numbers.into_iter().for_each(|number| digest.number(number));
        }
    }
    let restitution: DoubleDouble = "0.5".parse().expect("a number");
    for one in doubling_cascade(restitution, 5, &Unobserved).expect("found").doublings {
        for number in [one.axial_forcing, one.multiplier, one.width] {
            digest.number(number.high());
            digest.number(number.low());
        }
    }
    self::one("doubling cascade", digest, 0x3ad0_c4ed_3b23_0506)
}

/// Attractors: only rest, three attractors, chaos, and beyond it.
pub(crate) fn attractors() -> Vec<String> {
    let search = AttractorSearch::default().with_starts(64).expect("legal");
    let search = search.with_impacts(500, 4_000).expect("legal").with_cells(64).expect("legal");
    let mut digest = Digest::new();
    for forcing in [0.25, 0.486, 0.55, 0.62] {
        let vibration = Vibration::from_axial_forcing(forcing).expect("legal");
        let map = ImpactMap::new(vibration, RESTITUTION).expect("legal");
        for found in map.attractors(&search, &Unobserved).expect("found").all() {
            digest.bytes(found.kind.name().as_bytes());
            digest.number(found.starts.count() as f64);
            match &found.kind {
                AttractorKind::Periodic(known) => {
                    digest.number(known.radius());
                    known.orbit().states.iter().for_each(|state| add_state(&mut digest, *state));
                }
                AttractorKind::Chaotic { exponent, standard_error, recurrence }
                | AttractorKind::Transient { exponent, standard_error, recurrence, .. } => {
                    let numbers = [
                        *exponent,
                        *standard_error,
                        recurrence.cells.visited().len() as f64,
                        recurrence.orbits as f64,
                    ];
                    numbers.into_iter().for_each(|number| digest.number(number));
                    add_state(&mut digest, recurrence.state);
                }
                _ => {}
            }
        }
    }
    one("attractors", digest, 0xfff1_90fb_f476_b4e4)
}

/// Verdicts and both exponents over the forcing.
pub(crate) fn verdicts_and_exponents() -> Vec<String> {
    let starts: Vec<_> = (0..400)
        .map(|k| {
            let vibration = Vibration::from_axial_forcing(0.25 + 1e-3 * k as f64).expect("legal");
            let map = ImpactMap::new(vibration, [RESTITUTION, 0.0, 0.8][k as usize % 3]).expect("legal");
            (map, ImpactState::from_normalised(TAU * first(k), 2.0 * second(k)).expect("legal"))
        })
        .collect();
    let settings = VerdictSettings { transient: 200, impacts: 2_000, ..VerdictSettings::default() };
    let mut digest = Digest::new();
    for verdict in verdicts(&starts, settings, &Unobserved).expect("no failure") {
        digest.bytes(format!("{verdict:?}").as_bytes());
    }
    let mut lines = one("verdicts", digest, 0xdf86_442f_9db6_a6b7);
    let mut digest = Digest::new();
    for outcome in lyapunov_spectra(&starts, 200, 1_000, &Unobserved).expect("no failure") {
        digest.bytes(format!("{outcome:?}").as_bytes());
    }
    lines.extend(one("Lyapunov spectra", digest, 0x9e66_2940_2077_4384));
    lines
}

pub(crate) fn add_orbit(digest: &mut Digest, orbit: &PeriodicOrbit) {
    orbit.states.iter().for_each(|state| add_state(digest, *state));
    let errors = [orbit.position_error, orbit.trace_error];
    errors.into_iter().chain(orbit.monodromy.to_cols_array()).for_each(|number| digest.number(number));
}

/// Periodic orbits.
pub(crate) fn periodic_orbits() -> Vec<String> {
    let search = OrbitSearch::new(3, 3).expect("legal");
    let mut digest = Digest::new();
    for forcing in [0.45, 0.486, 0.55] {
        let vibration = Vibration::from_axial_forcing(forcing).expect("legal");
        let map = ImpactMap::new(vibration, RESTITUTION).expect("legal");
        let found = map.periodic_orbits(&search, &Unobserved).expect("no failure");
        found.orbits.iter().for_each(|orbit| add_orbit(&mut digest, orbit));
    }
    one("periodic orbits", digest, 0x2389_edf0_9c63_2317)
}

/// Disks that start in the air, near and far, rising and falling.
pub(crate) fn drops() -> Vec<String> {
    let mut digest = Digest::new();
    for k in 0..LAUNCHES {
        let peak = libm::exp10(-1.0 + 3.0 * third(k));
        let gap = libm::exp10(-9.0 + 12.0 * spread(k, 0.324_717_957_244_746));
        let speed = (2.0 * second(k) - 1.0) * libm::exp10(4.0 * spread(k, 0.438_579_021_010_183) - 2.0);
        let vibration = Vibration::new(peak).expect("legal");
        let phase = Phase::new(TAU * first(k)).expect("finite");
        match vibration.first_impact_of_drop(phase, gap, speed) {
            Ok(impact) => {
                digest.bytes(&impact.periods.to_le_bytes());
                digest.number(impact.remainder);
                add_state(&mut digest, impact.into());
            }
            Err(_) => digest.bytes(b"none"),
        }
    }
    one("drops", digest, 0xf1ab_afb1_ae36_e6fc)
}
