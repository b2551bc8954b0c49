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
    /// Motions that ended with an error of the engine.
    pub(super) failures: u64,
    /// In the order of the modes and events.
    pub(super) transitions: Vec<Counted>,
    pub(super) attachments: Attachments,
    pub(super) laws: Laws,
}

/// What follows the impacts without rebound, ε = 0, by the contact force at the instant of the impact.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Attachments {
    /// N > 0 and the disk attached at once.
    pub(super) pressed_attached: u64,
    /// N > 0 and it flew.
    pub(super) pressed_launched: u64,
    /// N <= 0 and it attached at once.
    pub(super) unpressed_attached: u64,
    /// N <= 0 and it flew.
    pub(super) unpressed_launched: u64,
}

/// A transition and how often it occurred.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Counted {
    pub(super) transition: Transition,
    pub(super) number: u64,
}

/// The largest faults found, each as a share of the sizes of the terms that should balance.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Laws {
    /// Eq. (3): x = s and ẋ = ṡ in contact.
    pub(super) contact_motion: f64,
    /// Eq. (3): how far N falls below 0 in contact.
    pub(super) negative_force: f64,
    /// Eq. (3): |N| where the disk leaves.
    pub(super) force_at_separation: f64,
    /// Eq. (4): how far the torque that holds a sticking disk exceeds μ a_e N.
    pub(super) holding_torque: f64,
    /// Eqs. (4), (12): a sliding disk's change of speed against the integral of its torque.
    pub(super) sliding_speed: f64,
    /// Eq. (6).
    pub(super) rebound: f64,
    /// Eq. (7).
    pub(super) axial_impulse: f64,
    /// Eqs. (8)–(10): the impulse against the smaller of the two.
    pub(super) frictional_impulse: f64,
    /// Impacts that reverse the relative rotation.
    pub(super) reversals: u64,
    /// The parabola of Eq. (11) against the flight.
    pub(super) flight: f64,
    /// The parabola against the platform at the impact.
    pub(super) impact: f64,
    /// How far the disk is below the platform in flight.
    pub(super) overlap: f64,
    /// Torque of stick to slip against the limit.
    pub(super) slip_onset: f64,
    /// Sliding speed at slip to stick.
    pub(super) slip_end: f64,
    pub(super) checked: Checked,
}

/// How often each kind of motion or event was checked.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Checked {
    pub(super) flights: u64,
    pub(super) sticking: u64,
    pub(super) sliding: u64,
    pub(super) impacts: u64,
    pub(super) separations: u64,
    pub(super) slip_onsets: u64,
    pub(super) slip_ends: u64,
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
    /// Largest minus smallest preload during the flight, over g.
    pub(super) preload_change: f64,
    /// Duration with the spring over that without, minus 1.
    pub(super) duration_change: f64,
    /// The same for the speed of the fall at the impact.
    pub(super) fall_speed_change: f64,
    /// How much later in the stator's motion the impact comes, in periods.
    pub(super) impact_shift_cycles: f64,
    /// Bounds of `duration_change`: the earliest and the latest impact under any preload that the spring
    /// gives.
    pub(super) duration_bounds: (f64, f64),
}
