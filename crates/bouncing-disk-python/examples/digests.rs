//! Prints digests of results as JSON. `tests/test_same_bits.py` makes the same calls from Python and compares.
//!
//!     cargo run --release -p bouncing-disk-python --example digests > crates/bouncing-disk-python/tests/digests.json
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use bouncing_disk::core::numerics::digest::Digest;
use bouncing_disk::core::{
    Axis, BasinSettings, ChatterPolicy, CycleTrust, Grid, ImpactMap, ImpactState, KnownOrbit, Verdict,
    VerdictSettings, Vibration, orbit_diagram, verdicts,
};
use bouncing_disk::{Error, InitialSpin, PAPER_CHATTER, System, TransientSettings, ensemble, single_toss};

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
    for column in orbit_diagram(&orbits, 1000, 50)? {
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
    let Some(orbit) = map.settled_orbit(start, 2000, 64, 1e-7)? else { return Ok(digest) };
    let Some(radius) = orbit.trapping_radius(&map, 64) else { return Ok(digest) };
    digest.number(radius);
    let grid = Grid::new(Axis::new(0.0, 1.0, 200)?, Axis::new(0.0, 3.0, 150)?)?;
    let basins = map.basins(grid, &[KnownOrbit::new(orbit, radius)?], BasinSettings::default())?;
    digest.bytes(basins.labels());
    Ok(digest)
}

fn judged() -> Result<Digest, Error> {
    let settings = VerdictSettings { impacts: 20_000, ..VerdictSettings::default() };
    let mut digest = Digest::new();
    for verdict in verdicts(&starts(&forcings(100, 0.2, 0.005), 0.5)?, settings)? {
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
    let runs = ensemble(&System::motor(), &settings, 16)?;
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

fn main() -> Result<(), Error> {
    let all = [
        ("diagram", diagram(ChatterPolicy::Complete)?),
        ("diagram with the paper's cut", diagram(PAPER_CHATTER)?),
        ("basins", basins()?),
        ("verdicts", judged()?),
        ("tosses", tosses()?),
        ("motors", motors()?),
    ];
    let lines: Vec<_> = all.iter().map(|(name, digest)| format!("  \"{name}\": \"{digest}\"")).collect();
    println!("{{\n{}\n}}", lines.join(",\n"));
    Ok(())
}
