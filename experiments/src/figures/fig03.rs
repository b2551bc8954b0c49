//! Fig. 3: flow chart of the simulation, from the modes and events that really occur.

mod cycle;
mod draw;
mod sprung;

use std::{
    collections::BTreeMap,
    f64::consts::{FRAC_PI_2, PI},
};

use bouncing_disk::core::{ChatterPolicy, Phase};
use bouncing_disk::motion::Transition;
use bouncing_disk::parameters::{DimensionlessParameters, DimensionlessSystem};
use bouncing_disk::{Engine, InitialCondition};
use bouncing_disk_plot::Figure;
use serde::{Deserialize, Serialize};

use self::{cycle::cycle, sprung::sprung};
use crate::claims::{self as claim, Claim};
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::{Cell, Table};

/// Fig. 3.
#[derive(Debug)]
pub struct Fig03;

impl Experiment for Fig03 {
    type Data = Fig03Data;

    const ID: &'static str = "fig03";

    const TITLE: &'static str = "Flow chart of the simulation";
    const DISCUSSION: &str = include_str!("fig03/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &Fig03Data) -> String {
        let (census, cycle) = (&data.census, &data.cycle);
        format!(
            "Model simulation flow chart: the modes flight, sticking and sliding (boxes), the impact, which is an instant \
             (rounded), and the events between them. Every arrow is a transition that the engine was seen to make: {} \
             events of {} systems and starts were counted, and only the {} transitions drawn occurred \
             (rebound and attachments share the collision). At the arrows: their conditions; β̈_env = μ a_e N/(m a_g²) is what static friction can give. A cycle \
             starts with the collision. The inset shows a computed trajectory of the disk (dashed line) and of the platform (solid line), time from the collision, \
             for one cycle of the simulation, starting with collision (c), attachment (a) after infinitely many impacts, and ending with \
             separation (s), for Γ = {}, ε = {}; the flight before the collision is lighter.",
            census.events,
            census.motions,
            census.transitions.len(),
            cycle.axial_forcing,
            cycle.restitution
        )
    }

    fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig03Data, ExperimentError> {
        compute(quality, progress)
    }

    fn draw(data: &Fig03Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Fig03Data) -> Vec<Claim> {
        vec![sprung_rotor(data)]
    }

    fn parameters(data: &Fig03Data) -> Vec<(String, String)> {
        let (census, cycle) = (&data.census, &data.cycle);
        let list = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
        [
            ("peak acceleration Aω²/g", list(&census.peak_accelerations)),
            ("largest platform speed, in g a_e/(a_g² ω)", list(&census.twist_speeds)),
            ("phase lag θ (rad)", list(&census.phase_lags_rad)),
            ("friction μ", list(&census.frictions)),
            ("restitution ε", list(&census.restitutions)),
            ("load torque, in m g a_e", list(&census.loads)),
            ("events of a motion", format!("at most {}", census.longest_motion)),
            ("inset", format!("Γ = {}, ε = {}, complete chattering", cycle.axial_forcing, cycle.restitution)),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .to_vec()
    }

    fn table(data: &Fig03Data) -> Option<Table> {
        let mut table = Table::new(["mode before", "event", "mode after", "number"]);
        for counted in &data.census.transitions {
            let Transition { from, event, to } = counted.transition;
            table.push([
                Cell::from(format!("{from:?}")),
                format!("{event:?}").into(),
                format!("{to:?}").into(),
                i64::try_from(counted.number).unwrap_or(i64::MAX).into(),
            ]);
        }
        Some(table)
    }
}

/// The data of Fig. 3.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig03Data {
    census: Census,
    cycle: ChatteringCycle,
    sprung: Sprung,
}

/// The transitions of many motions.
#[derive(Debug, Serialize, Deserialize)]
struct Census {
    peak_accelerations: Vec<f64>,
    twist_speeds: Vec<f64>,
    phase_lags_rad: Vec<f64>,
    frictions: Vec<f64>,
    restitutions: Vec<f64>,
    loads: Vec<f64>,
    longest_motion: usize,
    motions: u64,
    events: u64,
    /// In the order of the modes and events.
    transitions: Vec<Counted>,
}

/// A transition and how often it occurred.
#[derive(Debug, Serialize, Deserialize)]
struct Counted {
    transition: Transition,
    number: u64,
}

/// From one separation to the next; time in periods from the first collision between them, heights in
/// amplitudes of the platform.
#[derive(Debug, Serialize, Deserialize)]
struct ChatteringCycle {
    axial_forcing: f64,
    restitution: f64,
    time_cycles: Vec<f64>,
    disk_height: Vec<f64>,
    platform_height: Vec<f64>,
    /// The height of the first impact, which is at time 0.
    collision_height: f64,
    attachment_cycles: f64,
    attachment_height: f64,
    separation_cycles: f64,
    separation_height: f64,
    /// Impacts before those that the attachment sums.
    impacts: usize,
}

/// Springs under the motors of Fig. 10.
#[derive(Debug, Serialize, Deserialize)]
struct Sprung {
    /// See `deflection_for_share_m`.
    preload_share: f64,
    motors: Vec<SprungMotor>,
}

/// A motor of Table III with an amplitude.
#[derive(Debug, Serialize, Deserialize)]
struct SprungMotor {
    amplitude_m: f64,
    axial_forcing: f64,
    /// Events of the motion from rest under constant preload in which the highest point was looked for.
    events: usize,
    /// From the stator's lowest point to the rotor's highest.
    travel_m: f64,
    /// The static deflection for which the preload changes by the share, from end to end of the travel.
    deflection_for_share_m: f64,
    /// The first flight of a rotor at rest.
    flight_cycles: f64,
    springs: Vec<SprungFlight>,
}

/// The first flight of a rotor at rest with a spring, against that under constant preload.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct SprungFlight {
    /// The static deflection over the travel.
    deflection_over_travel: f64,
    /// Duration with the spring over that without, minus 1.
    duration_change: f64,
    /// The same for the speed of the fall at the impact.
    fall_speed_change: f64,
    /// How much later in the stator's motion the impact comes, in periods.
    impact_shift_cycles: f64,
}

/// From a platform that never throws the disk, through period 1, chattering and chaos, to a motor.
const PEAK_ACCELERATIONS: [f64; 9] = [0.0, 0.6, 1.0, 1.1, 1.26, 1.55, 1.75, 4.9, 20.0];
const TWIST_SPEEDS: [f64; 4] = [0.0, 0.2, 1.0, 6.0];
const PHASE_LAGS: [f64; 3] = [-0.26 * PI, 0.0, FRAC_PI_2];
const FRICTIONS: [f64; 3] = [0.0, 0.1, 0.6];
const RESTITUTIONS: [f64; 3] = [0.0, 0.5, 0.8];
const LOADS: [f64; 2] = [0.0, 0.05];

fn starts(system: &DimensionlessSystem) -> Result<[InitialCondition; 2], ExperimentError> {
    let height = 1.0 + system.peak_acceleration();
    Ok([
        InitialCondition::Contact { phase: Phase::new(1.5 * PI)?, angular_speed: 0.0 },
        InitialCondition::Flight {
            phase: Phase::new(1.0)?,
            gap: height,
            relative_velocity: 0.0,
            angular_speed: 0.3,
        },
    ])
}

fn systems() -> Result<Vec<DimensionlessSystem>, ExperimentError> {
    let mut systems = Vec::new();
    for peak_acceleration in PEAK_ACCELERATIONS {
        for twist_speed in TWIST_SPEEDS {
            for phase_lag in PHASE_LAGS {
                for friction in FRICTIONS {
                    for restitution in RESTITUTIONS {
                        for load in LOADS {
                            let parameters = DimensionlessParameters {
                                peak_acceleration,
                                twist_speed,
                                phase_lag,
                                friction,
                                restitution,
                                load,
                            };
                            systems.push(parameters.build()?);
                        }
                    }
                }
            }
        }
    }
    Ok(systems)
}

fn census(quality: Quality, progress: &dyn Progress) -> Result<Census, ExperimentError> {
    let longest_motion = quality.choose(60, 400);
    let systems = systems()?;
    progress.start(systems.len() as u64, "systems");
    let mut counts: BTreeMap<Transition, u64> = BTreeMap::new();
    let (mut motions, mut events) = (0, 0);
    for system in &systems {
        for start in starts(system)? {
            motions += 1;
            for record in Engine::new(*system, start, ChatterPolicy::Complete)?.take(longest_motion) {
                events += 1;
                *counts.entry(record?.transition()).or_default() += 1;
            }
        }
        progress.advance(1);
    }
    let transitions = counts.into_iter().map(|(transition, number)| Counted { transition, number }).collect();
    Ok(Census {
        peak_accelerations: PEAK_ACCELERATIONS.to_vec(),
        twist_speeds: TWIST_SPEEDS.to_vec(),
        phase_lags_rad: PHASE_LAGS.to_vec(),
        frictions: FRICTIONS.to_vec(),
        restitutions: RESTITUTIONS.to_vec(),
        loads: LOADS.to_vec(),
        longest_motion,
        motions,
        events,
        transitions,
    })
}

fn compute(quality: Quality, progress: &dyn Progress) -> Result<Fig03Data, ExperimentError> {
    let census = census(quality, progress)?;
    let cycle = cycle(quality)?;
    let sprung = sprung(quality)?;
    Ok(Fig03Data { census, cycle, sprung })
}

/// A spring that is compressed by so many times the rotor's displacement is compressed by "much more" than it.
const MUCH_GREATER: f64 = 100.0;
/// A flight under an effectively constant preload lasts as long and falls as fast as one under a constant preload to this share.
const SAME_FLIGHT: f64 = 0.01;

/// The spring's change of preload, and what it does to a flight.
fn sprung_rotor(data: &Fig03Data) -> Claim {
    let sprung = &data.sprung;
    let flights = sprung.motors.iter().flat_map(|motor| &motor.springs);
    // Hooke's law bounds the preload, which is no test; what has to be seen is that the flight hardly differs.
    let same = claim::all(flights.filter(|flight| flight.deflection_over_travel >= MUCH_GREATER), |flight| {
        flight.duration_change.abs() <= SAME_FLIGHT && flight.fall_speed_change.abs() <= SAME_FLIGHT
    });
    let travels: Vec<_> = sprung
        .motors
        .iter()
        .map(|motor| format!("A = {:e} m: {:.2e} m", motor.amplitude_m, motor.travel_m))
        .collect();
    Claim::printed_statement(
        "section1.sprung_rotor",
        same,
        format!(
            "duration and speed of the fall change by at most {} % where δl_0 is {MUCH_GREATER} times the displacement or more, in the first flight of Table III's motor; it moves, from peak to \
             peak, {}. For the phases of the impacts to stay the same δl_0 must be longer by much more than the flight's number of periods",
            100.0 * SAME_FLIGHT,
            travels.join("; ")
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    #[test]
    fn the_arrows_drawn_are_the_transitions_seen() {
        let data = Fig03::compute(Quality::Draft, &Silent).expect("runs");
        let seen: Vec<_> = data.census.transitions.iter().map(|counted| counted.transition).collect();
        let mut legal = Transition::LEGAL.to_vec();
        legal.sort_unstable();
        assert_eq!(seen, legal);
        assert_eq!(draw::arrows(&data.census).iter().map(|arrow| arrow.transition).collect::<Vec<_>>(), seen);
        assert!(draw::arrows(&data.census).iter().all(|arrow| arrow.planned));
    }
}
