//! Digests that name the bits of what users compute most: the same on every machine, and in Python.
//!
//! They are stored beside the Python package, which compares its own results with them
//! (`tests/test_same_bits.py`). `.ci/aarch64` runs these tests on another processor.

#[path = "../../bouncing-disk-drives/tests/golden/on_drives.rs"]
mod on_drives;
#[path = "../../bouncing-disk-core/tests/golden/results.rs"]
mod results;

use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::core::{
    ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration,
    attractors::{Axis, BasinSettings, CycleTrust, Grid, KnownOrbit, Verdict, VerdictSettings, verdicts},
    chaos::{CrisisSearch, LyapunovOutcome, ManifoldKind, ManifoldSettings, lyapunov_spectra},
    orbits::OrbitSearch,
    sweep::orbit_diagram,
};
use bouncing_disk::estimate::TransientEnsemble;
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk::motor::{
    MotorField, MotorSweep, OperatingSettings, SensitivityParameter, SensitivityQuantity,
    SensitivitySettings, SweepAxis, SweepQuantity, TransientSettings,
};
use bouncing_disk::parameters::{Contact, StatorKind, StatorParameters};
use bouncing_disk::toss::{InitialSpin, single_toss};
use bouncing_disk::{Error, Motor, System};

#[test]
fn results_have_the_stored_digests() {
    let found = all().expect("no failure");
    let lines: Vec<_> = found.iter().map(|(name, digest)| format!("  \"{name}\": \"{digest}\"")).collect();
    let text = format!("{{\n{}\n}}\n", lines.join(",\n"));
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../bouncing-disk-python/tests/digests.json");
    if std::env::var_os("UPDATE_DOCUMENTATION").is_some() {
        std::fs::write(file, &text).expect("writable");
    }
    assert_eq!(std::fs::read_to_string(file).expect("there"), text, "UPDATE_DOCUMENTATION=1 writes it");
}

/// The digests of the core and the drives, for an emulator, in which their own tests would take too long.
#[test]
#[ignore = "the core and the drives compare them; .ci/aarch64 runs it"]
fn flights_orbits_and_basins_are_the_golden_ones() {
    let differences = [
        results::launches_of_every_regime(),
        results::chaotic_orbit(),
        results::orbits_with_chatter(PAPER_CHATTER),
        on_drives::orbits_on_drives(),
        on_drives::orbits_with_compliance(),
        results::basin_labels(),
        results::branches(),
        results::cascade(),
        results::attractors(),
        results::verdicts_and_exponents(),
        results::periodic_orbits(),
        on_drives::periodic_orbits_on_drives(1, 10, [0xc50a_766a_58fd_b8a5, 0xc46d_c95d_8b4a_7850]),
        on_drives::branches_on_drives(),
        results::drops(),
    ];
    assert_eq!(differences.concat(), Vec::<String>::new());
}

fn all() -> Result<Vec<(&'static str, Digest)>, Error> {
    Ok(vec![
        ("diagram", diagram(ChatterPolicy::Complete)?),
        ("diagram with the paper's cut", diagram(PAPER_CHATTER)?),
        ("basins", basins()?),
        ("verdicts", judged()?),
        ("tosses", tosses()?),
        ("motors", motors()?),
        ("spectra", spectra()?),
        ("manifolds", manifolds()?),
        ("crisis", crisis()?),
        ("motor sweep", motor_sweep()?),
        ("local sensitivities", local_sensitivities()?),
        ("stators", stators()?),
    ])
}

/// The forcings of the diagram and of the verdicts: sums and products of doubles that Python forms alike.
fn forcings(count: u32, low: f64, step: f64) -> Vec<f64> {
    (0..count).map(|index| low + f64::from(index) * step).collect()
}

fn starts(forcings: &[f64], restitution: f64) -> Result<Vec<(ImpactMap, ImpactState)>, Error> {
    let start = ImpactState::from_normalised(1.2, 1.3)?;
    let map = |forcing: &f64| ImpactMap::new(Vibration::from_axial_forcing(*forcing)?, restitution);
    forcings.iter().map(|forcing| Ok((map(forcing)?, start))).collect()
}

fn digest_of(numbers: impl IntoIterator<Item = f64>) -> Digest {
    let mut digest = Digest::new();
    for number in numbers {
        digest.number(number);
    }
    digest
}

fn numbers_of(state: &ImpactState) -> [f64; 2] {
    [state.phase().angle(), state.velocity()]
}

fn diagram(policy: ChatterPolicy) -> Result<Digest, Error> {
    let starts = starts(&forcings(200, 0.3, 0.002), 0.5)?;
    let orbits: Vec<_> = starts.iter().map(|(map, state)| map.orbit(*state, policy)).collect();
    let columns = orbit_diagram(&orbits, 1000, 50, &Unobserved)?;
    Ok(digest_of(columns.iter().flatten().flat_map(numbers_of)))
}

fn basins() -> Result<Digest, Error> {
    let (map, start) = starts(&[0.45], 0.5)?[0];
    let mut digest = Digest::new();
    let Some(orbit) = map.settled_orbit(start, 2000, 64, 1e-7, &Unobserved)? else { return Ok(digest) };
    let radius = orbit.trapping_radius(&map, 64, &Unobserved)?;
    digest.number(radius);
    let grid = Grid::new(Axis::new(0.0, 1.0, 200)?, Axis::new(0.0, 3.0, 150)?)?;
    let known = [KnownOrbit::new(orbit, radius)?];
    digest.bytes(map.basins(grid, &known, BasinSettings::default(), &Unobserved)?.labels());
    Ok(digest)
}

fn judged() -> Result<Digest, Error> {
    let settings = VerdictSettings { impacts: 20_000, ..VerdictSettings::default() };
    let mut digest = Digest::new();
    for verdict in verdicts(&starts(&forcings(100, 0.2, 0.005), 0.5)?, settings, &Unobserved)? {
        let (kind, numbers) = match verdict {
            Verdict::Periodic { impacts, platform_periods, .. } => {
                (0, vec![impacts as f64, platform_periods as f64])
            }
            Verdict::Chaotic { exponent, standard_error, .. } => (1, vec![exponent, standard_error]),
            Verdict::Chattering { cycle, after } => match cycle.trust {
                CycleTrust::ChosenByRounding { exponent: Some(exponent), .. } => {
                    (2, vec![after as f64, exponent])
                }
                _ => (2, vec![after as f64]),
            },
            Verdict::AtRest { after, .. } => (3, vec![after as f64]),
            _ => (4, vec![]),
        };
        digest.bytes(&[kind]);
        numbers.into_iter().for_each(|number| digest.number(number));
    }
    Ok(digest)
}

fn tosses() -> Result<Digest, Error> {
    let mut numbers = Vec::new();
    for lag in forcings(100, -1.5, 0.03) {
        let system = System::pizza_toss().with_platform(|hand| hand.phase_lag = lag)?;
        for initial in [InitialSpin::AbsoluteRest, InitialSpin::RestRelativeToHand] {
            let toss = single_toss(&system, initial)?;
            numbers.extend([
                toss.airborne_speed,
                toss.efficiency,
                toss.launch_speed,
                toss.energy.friction_loss,
            ]);
        }
    }
    Ok(digest_of(numbers))
}

fn motors() -> Result<Digest, Error> {
    let settings = TransientSettings { duration: 0.5, intervals: 50, ..TransientSettings::default() };
    let runs = TransientEnsemble::new(&System::motor(), &settings, 16, &Unobserved)?;
    let curves = runs.curves.iter().flat_map(|curve| curve.times.iter().chain(&curve.speeds)).copied();
    let ends = [runs.steady_speed.mean, runs.time_constant.mean, runs.stall_acceleration.standard_error];
    Ok(digest_of(curves.chain(ends)))
}

fn spectra() -> Result<Digest, Error> {
    let mut digest = Digest::new();
    for outcome in lyapunov_spectra(&starts(&forcings(60, 0.2, 0.01), 0.5)?, 1000, 5000, &Unobserved)? {
        match outcome {
            LyapunovOutcome::Exponents(found) => {
                let numbers =
                    [Some(found.largest), Some(found.standard_error), found.second, found.exact_sum];
                for number in numbers {
                    digest.number(number.unwrap_or(f64::NEG_INFINITY));
                }
            }
            LyapunovOutcome::Rested { impacts } => digest.number(impacts as f64),
            LyapunovOutcome::Grazed { phase, .. } => digest.number(phase.angle()),
            _ => digest.bytes(&[255]),
        }
    }
    Ok(digest)
}

fn manifolds() -> Result<Digest, Error> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.34)?, 0.5)?;
    let mut numbers = Vec::new();
    let orbits = map.periodic_orbits(&OrbitSearch::new(1, 1)?, &Unobserved)?.orbits;
    for orbit in orbits.iter().filter(|orbit| orbit.multipliers().spectral_radius() > 1.0) {
        for kind in [ManifoldKind::Unstable, ManifoldKind::Stable] {
            let manifold = map.manifold(orbit, kind, &ManifoldSettings::new(10.0, 20_000)?, &Unobserved)?;
            numbers.push(manifold.multiplier);
            numbers.extend(manifold.pieces().flat_map(|piece| &piece.states).flat_map(numbers_of));
        }
    }
    Ok(digest_of(numbers))
}

fn crisis() -> Result<Digest, Error> {
    let search = CrisisSearch::new(0.5, (0.559, 0.562))?.with_samples(64, 400_000)?;
    let Ok(crisis) = search.crisis(None, &Unobserved)? else { return Ok(Digest::new()) };
    let Ok(tangency) = &crisis.tangency else { return Ok(Digest::new()) };
    let numbers = [crisis.forcing, crisis.forcing_error, tangency.share, tangency.curvature];
    let lives = crisis.lives(&[1e-4, 1e-3], 50, 20_000, &Unobserved)?.lives;
    Ok(digest_of(numbers.into_iter().chain(lives.iter().map(|life| life.impacts))))
}

fn small_motor() -> Result<(Motor, OperatingSettings), Error> {
    let motor = Motor::paper_70_khz().with(|sheet| sheet.mass = Some(1e-3))?;
    Ok((motor, OperatingSettings { relative_error: 0.05, ..OperatingSettings::default() }))
}

fn motor_sweep() -> Result<Digest, Error> {
    let (motor, settings) = small_motor()?;
    let axes = vec![
        SweepAxis::new(MotorField::Friction, vec![0.1, 0.2]),
        SweepAxis::new(MotorField::Amplitude, vec![1e-8, 1.1e-8]),
    ];
    let sweep = MotorSweep::new(motor, axes, settings)?.run(&Unobserved)?;
    let speeds = sweep.matrix(SweepQuantity::Speed).into_iter().flatten();
    Ok(digest_of(speeds.map(|speed| speed.unwrap_or(f64::NAN))))
}

fn local_sensitivities() -> Result<Digest, Error> {
    let (motor, operating) = small_motor()?;
    let near = SensitivitySettings { operating, ..SensitivitySettings::default() };
    let quantity = SensitivityQuantity::SteadySpeed;
    let slopes =
        motor.local_sensitivities(quantity, &[SensitivityParameter::Friction], &near, &Unobserved)?;
    Ok(digest_of(slopes.iter().map(|one| one.derivative.value)))
}

/// Operating points on stators that yield: one mode with rigid impacts, and two with contacts that take time.
fn stators() -> Result<Digest, Error> {
    let settings = OperatingSettings {
        relative_error: 0.3,
        members: 4,
        most_impacts: 2_000,
        ..OperatingSettings::default()
    };
    let modes = StatorParameters { mass: Some(0.05), quality: Some(300.0), ..StatorParameters::default() };
    let twisting = StatorParameters { kind: StatorKind::AxialTwist, twist_per_height: Some(700.0), ..modes };
    let two = StatorParameters {
        kind: StatorKind::AxialAndTorsional,
        inertia: Some(1e-6),
        torsional_quality: Some(100.0),
        resonance: Some(70.1e3),
        ..modes
    };
    let mut numbers = Vec::new();
    for (stator, speed, contact_time) in [(twisting, None, None), (two, Some(30.0), Some(1e-5))] {
        let motor = Motor::paper_70_khz().with(|sheet| {
            (sheet.stator, sheet.amplitude, sheet.peak_angular_speed) = (Some(stator), Some(1e-7), speed);
            sheet.contact = contact_time.map(Contact::lasting);
        })?;
        let curve = motor.torque_speed_curve(&[0.0, 1e-5], &settings, &Unobserved)?;
        for of in [SweepQuantity::Speed, SweepQuantity::StatorAmplitude, SweepQuantity::ElectricalEfficiency]
        {
            numbers
                .extend(curve.iter().map(|point| of.of(point.operation()).map_or(f64::NAN, |one| one.value)));
        }
    }
    Ok(digest_of(numbers))
}

#[path = "golden/motors.rs"]
mod motors;

#[test]
fn run_ups_taps_and_fits_are_the_golden_ones() {
    let differences = [
        motors::taps().expect("no failure"),
        motors::run_ups_on_stators().expect("no failure"),
        motors::transient_fits(),
        #[cfg(feature = "fit")]
        motors::rated_fits(),
    ];
    assert_eq!(differences.concat(), Vec::<String>::new());
}
