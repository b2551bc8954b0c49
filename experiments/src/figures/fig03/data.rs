//! The data of Fig. 3.

use bouncing_disk::Transition;
use serde::{Deserialize, Serialize};

/// The data of Fig. 3.
#[derive(Debug, Serialize, Deserialize)]
pub struct Fig03Data {
    pub(super) census: Census,
    pub(super) cycle: ChatteringCycle,
    pub(super) sprung: Sprung,
}

/// The transitions of many motions.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Census {
    pub(super) peak_accelerations: Vec<f64>,
    pub(super) twist_speeds: Vec<f64>,
    pub(super) phase_lags_rad: Vec<f64>,
    pub(super) frictions: Vec<f64>,
    pub(super) restitutions: Vec<f64>,
    pub(super) loads: Vec<f64>,
    pub(super) longest_motion: usize,
    pub(super) motions: u64,
    pub(super) events: u64,
    /// In the order of the modes and events.
    pub(super) transitions: Vec<Counted>,
}

/// A transition and how often it occurred.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Counted {
    pub(super) transition: Transition,
    pub(super) number: u64,
}

/// From one separation to the next; time in periods from the first collision between them, heights in
/// amplitudes of the platform.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ChatteringCycle {
    pub(super) axial_forcing: f64,
    pub(super) restitution: f64,
    pub(super) time_cycles: Vec<f64>,
    pub(super) disk_height: Vec<f64>,
    pub(super) platform_height: Vec<f64>,
    /// The height of the first impact, which is at time 0.
    pub(super) collision_height: f64,
    pub(super) attachment_cycles: f64,
    pub(super) attachment_height: f64,
    pub(super) separation_cycles: f64,
    pub(super) separation_height: f64,
    /// Impacts before those that the attachment sums.
    pub(super) impacts: usize,
}

/// Springs under the motors of Fig. 10.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Sprung {
    /// See `deflection_for_share_m`.
    pub(super) preload_share: f64,
    pub(super) motors: Vec<SprungMotor>,
}

/// A motor of Table III with an amplitude.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct SprungMotor {
    pub(super) amplitude_m: f64,
    pub(super) axial_forcing: f64,
    /// Events of the motion from rest under constant preload in which the highest point was looked for.
    pub(super) events: usize,
    /// From the stator's lowest point to the rotor's highest.
    pub(super) travel_m: f64,
    /// The static deflection for which the preload changes by the share, from end to end of the travel.
    pub(super) deflection_for_share_m: f64,
    /// The first flight of a rotor at rest.
    pub(super) flight_cycles: f64,
    pub(super) springs: Vec<SprungFlight>,
}

/// The first flight of a rotor at rest with a spring, against that under constant preload.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct SprungFlight {
    /// The static deflection over the travel.
    pub(super) deflection_over_travel: f64,
    /// Duration with the spring over that without, minus 1.
    pub(super) duration_change: f64,
    /// The same for the speed of the fall at the impact.
    pub(super) fall_speed_change: f64,
    /// How much later in the stator's motion the impact comes, in periods.
    pub(super) impact_shift_cycles: f64,
}
