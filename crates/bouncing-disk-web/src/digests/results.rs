//! What the digests are of. `tests/test_same_bits.py` of the Python package makes the same calls.

use bouncing_disk::core::attractors::{
    Axis, BasinSettings, CycleTrust, Grid, KnownOrbit, Verdict, VerdictSettings, verdicts,
};
use bouncing_disk::core::chaos::{
    CrisisSearch, LyapunovOutcome, ManifoldKind, ManifoldSettings, lyapunov_spectra,
};
use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::core::orbits::OrbitSearch;
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, ImpactState, Unobserved, Vibration};
use bouncing_disk::{
    Error, InitialSpin, MotorField, MotorParameters, MotorSweep, OperatingSettings, PAPER_CHATTER,
    SamplingSettings, SensitivityParameter, SensitivityQuantity, SensitivitySettings, SweepAxis,
    SweepQuantity, System, TransientSettings, ensemble, single_toss,
};

/// The forcings of the diagram and of the verdicts: sums and products of doubles that Python forms alike.
fn forcings(count: u32, low: f64, step: f64) -> Vec<f64> {
    (0..count).map(|index| low + f64::from(index) * step).collect()
}

fn starts(forcings: &[f64], restitution: f64) -> Result<Vec<(ImpactMap, ImpactState)>, Error> {
    let start = ImpactState::from_normalised(1.2, 1.3)?;
    let maps = forcings
        .iter()
        .map(|forcing| Ok((ImpactMap::new(Vibration::from_axial_forcing(*forcing)?, restitution)?, start)));
    maps.collect()
}

fn diagram(policy: ChatterPolicy) -> Result<Digest, Error> {
    let starts = starts(&forcings(200, 0.3, 0.002), 0.5)?;
    let orbits: Vec<_> = starts.iter().map(|(map, state)| map.orbit(*state, policy)).collect();
    let mut digest = Digest::new();
    for column in orbit_diagram(&orbits, 1000, 50, &Unobserved)? {
        for state in &column {
            digest.number(state.phase().angle());
            digest.number(state.velocity());
        }
    }
    Ok(digest)
}

fn basins() -> Result<Digest, Error> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    let start = ImpactState::from_normalised(1.2, 1.3)?;
    let mut digest = Digest::new();
    let Some(orbit) = map.settled_orbit(start, 2000, 64, 1e-7, &Unobserved)? else { return Ok(digest) };
    let radius = orbit.trapping_radius(&map, 64, &Unobserved)?;
    digest.number(radius);
    let grid = Grid::new(Axis::new(0.0, 1.0, 200)?, Axis::new(0.0, 3.0, 150)?)?;
    let basins =
        map.basins(grid, &[KnownOrbit::new(orbit, radius)?], BasinSettings::default(), &Unobserved)?;
    digest.bytes(basins.labels());
    Ok(digest)
}

fn judged() -> Result<Digest, Error> {
    let settings = VerdictSettings { impacts: 20_000, ..VerdictSettings::default() };
    let mut digest = Digest::new();
    for verdict in verdicts(&starts(&forcings(100, 0.2, 0.005), 0.5)?, settings, &Unobserved)? {
        match verdict {
            Verdict::Periodic { impacts, platform_periods, .. } => {
                digest.bytes(&[0]);
                digest.number(impacts as f64);
                digest.number(platform_periods as f64);
            }
            Verdict::Chaotic { exponent, standard_error, .. } => {
                digest.bytes(&[1]);
                digest.number(exponent);
                digest.number(standard_error);
            }
            Verdict::Chattering { cycle, after } => {
                digest.bytes(&[2]);
                digest.number(after as f64);
                if let CycleTrust::ChosenByRounding { exponent: Some(exponent), .. } = cycle.trust {
                    digest.number(exponent);
                }
            }
            Verdict::AtRest { after, .. } => {
                digest.bytes(&[3]);
                digest.number(after as f64);
            }
            _ => digest.bytes(&[4]),
        }
    }
    Ok(digest)
}

fn tosses() -> Result<Digest, Error> {
    let mut digest = Digest::new();
    for lag in forcings(100, -1.5, 0.03) {
        let system = System::pizza_toss().with_platform(|hand| hand.phase_lag = lag)?;
        for initial in [InitialSpin::AbsoluteRest, InitialSpin::RestRelativeToHand] {
            let toss = single_toss(&system, initial)?;
            for number in [toss.airborne_speed, toss.efficiency, toss.launch_speed, toss.energy.friction_loss]
            {
                digest.number(number);
            }
        }
    }
    Ok(digest)
}

fn motors() -> Result<Digest, Error> {
    let settings = TransientSettings { duration: 0.5, intervals: 50, ..TransientSettings::default() };
    let runs = ensemble(&System::motor(), &settings, 16, &Unobserved)?;
    let mut digest = Digest::new();
    for curve in &runs.curves {
        for number in curve.times.iter().chain(&curve.speeds) {
            digest.number(*number);
        }
    }
    for number in [runs.steady_speed.mean, runs.time_constant.mean, runs.stall_acceleration.standard_error] {
        digest.number(number);
    }
    Ok(digest)
}

fn spectra() -> Result<Digest, Error> {
    let mut digest = Digest::new();
    for outcome in lyapunov_spectra(&starts(&forcings(60, 0.2, 0.01), 0.5)?, 1000, 5000, &Unobserved)? {
        match outcome {
            LyapunovOutcome::Exponents(found) => {
                for number in [Some(found.largest), Some(found.standard_error), found.second, found.exact_sum]
                {
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
    let mut digest = Digest::new();
    let orbits = map.periodic_orbits(&OrbitSearch::new(1, 1)?, &Unobserved)?.orbits;
    for orbit in orbits.iter().filter(|orbit| orbit.multipliers().spectral_radius() > 1.0) {
        for kind in [ManifoldKind::Unstable, ManifoldKind::Stable] {
            let manifold = map.manifold(orbit, kind, &ManifoldSettings::new(10.0, 20_000)?, &Unobserved)?;
            digest.number(manifold.multiplier);
            for state in manifold.pieces().flat_map(|piece| &piece.states) {
                digest.number(state.phase().angle());
                digest.number(state.velocity());
            }
        }
    }
    Ok(digest)
}

fn crisis() -> Result<Digest, Error> {
    let mut digest = Digest::new();
    let search = CrisisSearch::new(0.5, (0.559, 0.562))?.with_samples(64, 400_000)?;
    let Ok(crisis) = search.crisis(None, &Unobserved)? else { return Ok(digest) };
    let Ok(tangency) = &crisis.tangency else { return Ok(digest) };
    for number in [crisis.forcing, crisis.forcing_error, tangency.share, tangency.curvature] {
        digest.number(number);
    }
    for life in crisis.lives(&[1e-4, 1e-3], 50, 20_000, &Unobserved)?.lives {
        digest.number(life.impacts);
    }
    Ok(digest)
}

/// What the three calls about a motor in operation give.
fn operations() -> Result<Digest, Error> {
    let sheet = MotorParameters {
        drive_frequency: 70e3,
        amplitude: 1e-8,
        peak_angular_speed: Some(30.0),
        twist_amplitude: None,
        phase_lag: 0.0,
        mass: Some(1e-3),
        density: None,
        rotor_radius: None,
        rotor_thickness: None,
        contact_radius: 1.25e-3,
        gyration_radius: Some(6.3e-3),
        preload_force: None,
        preload_acceleration: Some(9.8),
        spring_constant: None,
        friction: 0.1,
        restitution: 0.5,
        load_torque: 0.0,
    };
    let motor = sheet.build()?;
    let settings = OperatingSettings { relative_error: 0.05, ..OperatingSettings::default() };
    let axes = vec![
        SweepAxis::new(MotorField::Friction, vec![0.1, 0.2]),
        SweepAxis::new(MotorField::Amplitude, vec![1e-8, 1.1e-8]),
    ];
    let mut digest = Digest::new();
    for row in MotorSweep::new(motor, axes, settings)?.run(&Unobserved)?.matrix(SweepQuantity::Speed) {
        for speed in row {
            digest.number(speed.unwrap_or(f64::NAN));
        }
    }
    let quantity = SensitivityQuantity::SteadySpeed;
    let near = SensitivitySettings { operating: settings, ..SensitivitySettings::default() };
    for one in motor.local_sensitivities(quantity, &[SensitivityParameter::Friction], &near, &Unobserved)? {
        digest.number(one.derivative.value);
    }
    let ranges =
        [(SensitivityParameter::Friction, [0.05, 0.2]), (SensitivityParameter::PhaseLag, [-0.2, 0.2])];
    let sampling = SamplingSettings { rows: 8, seed: 3 };
    for one in motor.sobol_indices(quantity, &ranges, sampling, &settings, &Unobserved)? {
        digest.number(one.total.value);
    }
    for one in motor.elementary_effects(quantity, &ranges, sampling, &settings, &Unobserved)? {
        digest.number(one.mean.value);
    }
    Ok(digest)
}

/// All of them, by their names.
pub(super) fn all() -> Result<Vec<(&'static str, Digest)>, Error> {
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
        ("operations", operations()?),
    ])
}
