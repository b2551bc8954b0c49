//! Columns of orbit diagrams.

use std::f64::consts::TAU;

use bouncing_disk::core::sweep::{BouncingOrbit, orbit_diagram};
use bouncing_disk::core::{ChatterPolicy, ImpactState, Unobserved};
use bouncing_disk::parameters::DimensionlessSystem;
use bouncing_disk::toss::{CollisionEvent, CollisionState, Collisions};
use bouncing_disk::{InitialCondition, System};
use serde_json::json;

use crate::reply::{Refusal, Reply};
use crate::request::{DiagramRequest, map};
use crate::settling::{is_settling, repeats_every};

/// Largest number of forcings in a diagram, and of impacts in an answer.
const MOST_COLUMNS: usize = 1_000_000;
const MOST_IMPACTS: usize = 1 << 22;

/// Largest number of impacts of an orbit before those that are recorded.
const MOST_LEFT_OUT: usize = 1_000_000;

/// Longest period (impacts) of an orbit that is seen to be on its way to it, and how far it may still move on
/// while it is recorded: in units of the normalised speed, and of the platform's largest angular speed.
const LONGEST_PERIOD: usize = 32;
const SETTLED: f64 = 1e-6;

/// Normalised speeds that differ by less belong to one impact that repeats, or will repeat.
const NEARLY: f64 = 1e-3;

/// In one impact a disk takes up the share 2/Gamma_T of the platform's largest angular speed at most, if it
/// hits as fast as in the motion of one impact a period. This many times Gamma_T/2 impacts are discarded
/// before its spin is recorded.
const SPIN_UPS: f64 = 10.0;

struct Column {
    impacts: Vec<(ImpactState, f64)>,
    left_out: usize,
    settled: bool,
}

/// Orbits that came to rest for ever and have no impacts left, those that have not yet settled on their final
/// motion, and the most impacts that were discarded from one. Numbers: rows of the forcing, the phase of
/// impact (rad), the normalised speed, and the angular speed after the impact in units of omega Phi (NaN
/// where the platform does not twist or there is no friction).
pub(crate) fn answer(request: &DiagramRequest) -> Result<Reply, Refusal> {
    let system = request.system.build()?;
    let forcings = forcings(request)?;
    let start = request.start.state()?;
    let patience = request.patience.max(request.transient);
    if patience > MOST_LEFT_OUT {
        return Err(Refusal::out_of_range("patience", patience as f64, "at most 10^6"));
    }
    let (drive, policy) = (&request.drive, ChatterPolicy::Complete);
    let contact = system.soft_contact().map(|(_, time)| time * system.platform().angular_frequency() / TAU);
    let maps = || forcings.iter().map(|forcing| map(*forcing, system.disk().restitution()));
    let columns = if request.rotation {
        drive.sine()?;
        DimensionlessSystem::try_from(&system)?;
        let columns = forcings.iter().map(|forcing| rotating(&system, *forcing, start, request));
        columns.collect::<Result<Vec<_>, _>>()?
    } else if drive.sine().is_ok() && contact.is_none() {
        let orbits = maps().map(|map| Ok(map?.orbit(start, policy)));
        vertical(orbits.collect::<Result<_, Refusal>>()?, request)?
    } else {
        let orbits = maps().map(|map| Ok(drive.map(&map?, contact)?.orbit(start, policy)));
        vertical(orbits.collect::<Result<_, Refusal>>()?, request)?
    };
    let mut numbers = Vec::with_capacity(4 * request.recorded * columns.len());
    for (forcing, column) in forcings.iter().zip(&columns) {
        for (state, angular_speed) in &column.impacts {
            numbers.extend([*forcing, state.phase().angle(), state.normalised_speed(), *angular_speed]);
        }
    }
    let json = json!({
        "resting": columns.iter().filter(|column| column.impacts.len() < request.recorded).count(),
        "unsettled": columns.iter().filter(|column| !column.settled).count(),
        "left_out": columns.iter().map(|column| column.left_out).max().unwrap_or(request.transient),
    });
    Reply::new(&json, numbers, Vec::new())
}

/// Columns of the vertical motion; those that have not settled are followed again, for longer.
fn vertical<Orbit: BouncingOrbit>(
    orbits: Vec<Orbit>,
    request: &DiagramRequest,
) -> Result<Vec<Column>, Refusal> {
    let followed = |orbits: &[Orbit], left_out: usize| {
        let columns = orbit_diagram(orbits, left_out, request.recorded, &Unobserved)?;
        let columns = columns.into_iter().map(|states| {
            let speeds: Vec<f64> = states.iter().map(ImpactState::normalised_speed).collect();
            let impacts = states.into_iter().map(|state| (state, f64::NAN)).collect();
            Column { impacts, left_out, settled: !is_settling(&speeds, LONGEST_PERIOD, SETTLED) }
        });
        Ok::<_, Refusal>(columns.collect::<Vec<_>>())
    };
    let mut columns = followed(&orbits, request.transient)?;
    if request.patience > request.transient {
        let again: Vec<usize> = (0..columns.len()).filter(|column| !columns[*column].settled).collect();
        let orbits: Vec<Orbit> = again.iter().map(|column| orbits[*column].clone()).collect();
        for (column, longer) in again.into_iter().zip(followed(&orbits, request.patience)?) {
            columns[column] = longer;
        }
    }
    Ok(columns)
}

fn forcings(request: &DiagramRequest) -> Result<Vec<f64>, Refusal> {
    let ([low, high], [from, to], count) = (request.axial_forcing, request.columns, request.count);
    if !(2..=MOST_COLUMNS).contains(&count) {
        return Err(Refusal::out_of_range("count", count as f64, "[2, 1000000]"));
    }
    if from > to || to > count {
        return Err(Refusal::out_of_range(
            "columns",
            to as f64,
            "at least the first column and at most the count",
        ));
    }
    let impacts = (to - from).saturating_mul(request.recorded);
    if impacts > MOST_IMPACTS {
        return Err(Refusal::out_of_range(
            "recorded",
            request.recorded as f64,
            "at most 2^22 in all columns together",
        ));
    }
    Ok((from..to).map(|column| low + (high - low) * (column as f64 / (count - 1) as f64)).collect())
}

/// Impacts with the angular speed after each, in units of the platform's largest one (NaN where it has none,
/// and where no friction hands it on).
fn rotating(
    system: &System,
    axial_forcing: f64,
    start: ImpactState,
    request: &DiagramRequest,
) -> Result<Column, Refusal> {
    let (recorded, patience) = (request.recorded, request.patience.max(request.transient));
    let system = with_forcing(system, axial_forcing)?;
    let largest = system.twist_speed();
    let unit = system.angular_forcing().filter(|_| largest > 0.0);
    let spin_up = unit.map_or(0.0, |angular_forcing| SPIN_UPS * angular_forcing / 2.0);
    let mut left_out = request.transient.max(patience.min(spin_up as usize));
    // The disk does not turn when the orbit begins.
    let at_rest = -system.platform_angular_speed(start.phase());
    let state = CollisionState {
        phase: start.phase(),
        axial_impact_velocity: start.velocity(),
        tangential_impact_velocity: at_rest,
    };
    let mut collisions = Collisions::after(system, state, ChatterPolicy::Complete)?;
    let (mut seen, mut impacts) = (0, Vec::with_capacity(recorded));
    loop {
        while impacts.len() < recorded {
            let Some(event) = collisions.advance()? else { break };
            let CollisionEvent::Collision(collision) = event else { continue };
            seen += 1;
            if seen <= left_out {
                continue;
            }
            let after = match collision.state.rebound(&system)? {
                InitialCondition::Launch { angular_speed, .. }
                | InitialCondition::Contact { angular_speed, .. } => angular_speed,
                _ => f64::NAN,
            };
            let after = if unit.is_some() { after / largest } else { f64::NAN };
            impacts.push((collision.state.vertical()?, after));
        }
        let spins: Vec<f64> = impacts.iter().map(|(_, spin)| *spin).collect();
        let speeds: Vec<f64> = impacts.iter().map(|(state, _)| state.normalised_speed()).collect();
        // The spin of a disk whose impacts repeat repeats with them, once it has settled.
        let follows = match repeats_every(&speeds, LONGEST_PERIOD, NEARLY) {
            Some(period) => {
                let (first, last) = (&spins[..period], &spins[spins.len() / period * period - period..]);
                !first.iter().zip(last).any(|(first, last)| (first - last).abs() > SETTLED)
            }
            None => !is_settling(&spins, LONGEST_PERIOD, SETTLED),
        };
        let settled = follows && !is_settling(&speeds, LONGEST_PERIOD, SETTLED);
        let later = left_out + recorded;
        if settled || later > patience || impacts.len() < recorded {
            return Ok(Column { impacts, left_out, settled });
        }
        impacts.clear();
        left_out = later;
    }
}

/// The system with another amplitude: that of the forcing.
fn with_forcing(system: &System, axial_forcing: f64) -> Result<DimensionlessSystem, Refusal> {
    let vibration = *map(axial_forcing, system.disk().restitution())?.vibration();
    let mut parameters = system.dimensionless().parameters();
    parameters.peak_acceleration = vibration.peak_acceleration();
    Ok(parameters.build()?)
}
