//! Columns of orbit diagrams.

use bouncing_disk::core::{ChatterPolicy, ImpactState, orbit_diagram};
use bouncing_disk::{
    CollisionEvent, CollisionState, Collisions, DimensionlessSystem, InitialCondition, System,
};
use serde::Serialize;

use crate::refusal::Refusal;
use crate::reply::Reply;
use crate::request::{DiagramRequest, map};

/// Most forcings of a diagram, and most impacts of an answer.
const MOST_COLUMNS: usize = 1_000_000;
const MOST_IMPACTS: usize = 1 << 22;

#[derive(Debug, Serialize)]
struct DiagramJson {
    resting: usize,
}

pub(crate) fn answer(request: &DiagramRequest) -> Result<Reply, Refusal> {
    let system = request.system.build()?;
    let forcings = forcings(request)?;
    let start = request.start.state()?;
    let mut numbers = Vec::new();
    let mut resting = 0;
    if request.rotation {
        for forcing in forcings {
            let impacts = rotating(&system, forcing, start, request.transient, request.recorded)?;
            resting += usize::from(impacts.len() < request.recorded);
            for (state, angular_speed) in impacts {
                numbers.extend([forcing, state.phase().angle(), state.normalised_speed(), angular_speed]);
            }
        }
    } else {
        let restitution = system.disk().restitution();
        let orbits = forcings.iter().map(|forcing| {
            Ok::<_, Refusal>(map(*forcing, restitution)?.orbit(start, ChatterPolicy::Complete))
        });
        let orbits = orbits.collect::<Result<Vec<_>, _>>()?;
        let columns = orbit_diagram(&orbits, request.transient, request.recorded)?;
        for (forcing, column) in forcings.iter().zip(&columns) {
            resting += usize::from(column.len() < request.recorded);
            for state in column {
                numbers.extend([*forcing, state.phase().angle(), state.normalised_speed(), f64::NAN]);
            }
        }
    }
    Reply::new(&DiagramJson { resting }, numbers, Vec::new())
}

/// The forcings of the columns that are asked for.
fn forcings(request: &DiagramRequest) -> Result<Vec<f64>, Refusal> {
    let ([low, high], [from, to], count) = (request.axial_forcing, request.columns, request.count);
    if !(2..=MOST_COLUMNS).contains(&count) {
        return Err(Refusal::out_of_range("count", count as f64, "[2, 1000000]"));
    }
    if from > to || to > count {
        return Err(Refusal::out_of_range("columns", to as f64, "from the first to the count"));
    }
    let impacts = (to - from).saturating_mul(request.recorded);
    if impacts > MOST_IMPACTS {
        return Err(Refusal::out_of_range("recorded", request.recorded as f64, "2^22 in all columns"));
    }
    Ok((from..to).map(|column| low + (high - low) * (column as f64 / (count - 1) as f64)).collect())
}

/// Impacts with the angular speed after each, in units of the platform's largest one (NaN where it has none).
fn rotating(
    system: &System,
    axial_forcing: f64,
    start: ImpactState,
    transient: usize,
    recorded: usize,
) -> Result<Vec<(ImpactState, f64)>, Refusal> {
    let system = with_forcing(system, axial_forcing)?;
    // The disk does not turn when the orbit begins.
    let at_rest = -system.platform_angular_speed(start.phase());
    let state = CollisionState {
        phase: start.phase(),
        axial_impact_velocity: start.velocity(),
        tangential_impact_velocity: at_rest,
    };
    let mut collisions = Collisions::after(system, state, ChatterPolicy::Complete)?;
    let (mut seen, mut impacts) = (0, Vec::with_capacity(recorded));
    while impacts.len() < recorded {
        let Some(event) = collisions.advance()? else { break };
        let CollisionEvent::Collision(collision) = event else { continue };
        seen += 1;
        if seen <= transient {
            continue;
        }
        let after = match collision.state.rebound(&system)? {
            InitialCondition::Launch { angular_speed, .. }
            | InitialCondition::Contact { angular_speed, .. } => angular_speed,
            _ => f64::NAN,
        };
        let largest = system.twist_speed();
        let after = if largest > 0.0 { after / largest } else { f64::NAN };
        impacts.push((collision.state.vertical()?, after));
    }
    Ok(impacts)
}

/// The system with another amplitude: that of the forcing.
fn with_forcing(system: &System, axial_forcing: f64) -> Result<DimensionlessSystem, Refusal> {
    let vibration = *map(axial_forcing, system.disk().restitution())?.vibration();
    let mut parameters = system.dimensionless().parameters();
    parameters.peak_acceleration = vibration.peak_acceleration();
    Ok(parameters.build()?)
}
