//! The numbers of Fig. 6.

use serde::{Deserialize, Serialize};

/// Data of Fig. 6.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fig06Data {
    /// Coefficient of restitution ε.
    pub restitution: f64,
    /// First and last Γ of the diagram.
    pub axial_forcing_range: (f64, f64),
    /// Γ of the panels of Fig. 7.
    pub basin_axial_forcings: [f64; 5],
    /// Number of values of Γ.
    pub axial_forcing_values: usize,
    /// Impacts at each Γ before any is kept.
    pub transient_impacts: usize,
    /// Impacts examined at each Γ; a round of a periodic orbit is stored once.
    pub examined_impacts: usize,
    /// (c): phase lag θ (rad) and angular forcing Γ_T.
    pub linear: Twist,
    /// (d): the same.
    pub semielliptical: Twist,
    /// Γ from which the period-1 attractor is followed.
    pub followed_from: f64,
    /// The followed attractor, by rising Γ.
    pub followed: Vec<Slice>,
    /// The chattering orbit from rest, by rising Γ; missing where the disk does not come to rest again.
    pub chattering: Vec<Slice>,
    /// The Γ above 1/π where a disk from rest does not come to rest again but ends on another attractor.
    pub not_chattering: Vec<f64>,
    /// Γ of the first period doublings.
    pub doublings: Vec<f64>,
    /// Γ of the period-1 threshold.
    pub period_one_threshold: f64,
    /// Impact phase of the period-1 orbit at the first doubling (rad).
    pub phase_at_first_doubling_rad: f64,
    /// Spectral radius of the period-1 orbit where following starts.
    pub multiplier_where_followed_from: f64,
    /// Loss of the attractor.
    pub merging: Merging,
    /// Where the chattering orbit stops being a chain of single tosses.
    pub single_tosses: SingleTosses,
    /// The two chattering policies compared.
    pub policies: Policies,
}

/// Phase lag and angular forcing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Twist {
    /// θ (rad).
    pub phase_lag_rad: f64,
    /// Γ_T.
    pub angular_forcing: f64,
}

/// The impacts at one Γ. Coordinates are rounded to 1e-6, far below the resolution of the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slice {
    /// Γ.
    pub axial_forcing: f64,
    /// Impacts in one round of a periodic orbit or from one rest to the next of a chattering one, if it repeats.
    pub period: Option<usize>,
    /// Whether the rotary motions of (c) and (d) have the same vertical one, to the last bit.
    pub vertical_motions_agree: bool,
    /// τ_imp/2π.
    pub impact_phase_cycles: Vec<f64>,
    /// |w_A Γ/(ωA)|.
    pub normalised_impact_speed: Vec<f64>,
    /// α'/|ωΦ| just before the impact, for (c).
    pub linear: Vec<f64>,
    /// Its mean over time.
    pub linear_mean: f64,
    /// α'/|ωΦ| just before the impact, for (d).
    pub semielliptical: Vec<f64>,
    /// Its mean over time.
    pub semielliptical_mean: f64,
}

/// The crisis in which the followed attractor is lost to chattering.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Merging {
    /// Impacts that an orbit has to survive without attaching.
    pub impacts: usize,
    /// Orbits tried at each Γ.
    pub starts: usize,
    /// Largest Γ of the bisection at which all survived.
    pub survived: f64,
    /// Smallest Γ at which one was lost.
    pub lost: f64,
    /// The same two with a tenth of the impacts.
    pub survived_in_a_tenth: f64,
    /// See `survived_in_a_tenth`.
    pub lost_in_a_tenth: f64,
    /// Γ, and the mean number of impacts before the disk attaches (at most `impacts` / 10).
    pub mean_life_impacts: Vec<(f64, f64)>,
}

impl Merging {
    /// Γ of the crisis.
    pub fn axial_forcing(&self) -> f64 {
        0.5 * (self.survived + self.lost)
    }

    /// How far it may be off: the last bracket and what ten times as many impacts change.
    pub fn uncertainty(&self) -> f64 {
        0.5 * (self.lost - self.survived) + (self.axial_forcing() - self.in_a_tenth()).abs()
    }

    fn in_a_tenth(&self) -> f64 {
        0.5 * (self.survived_in_a_tenth + self.lost_in_a_tenth)
    }
}

/// The end of the single-toss pattern of the chattering orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SingleTosses {
    /// Largest Γ of the bisection with one cycle per period of the platform.
    pub last: f64,
    /// Smallest Γ without.
    pub first_other: f64,
    /// Share of the Γ from there to 0.52 at which the disk comes to rest once in every period.
    pub share_beyond: f64,
    /// Fewest and most periods of the platform in a cycle from there to 0.52, over the Γ that chatter.
    pub periods_beyond: Option<(u64, u64)>,
}

/// Paper's cut and complete policy, over some of the Γ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Policies {
    /// Values of Γ compared that chatter under both.
    pub compared: usize,
    /// Those whose cycles differ in length.
    pub different_cycles: usize,
    /// The smallest Γ of those.
    pub first_different: Option<f64>,
    /// Values of Γ at which the rotation (c) repeats under both.
    pub settled_linear: usize,
    /// The same for (d).
    pub settled_semielliptical: usize,
    /// Largest difference of the mean speeds (c), as a share of ωΦ, where the rotation repeats.
    pub largest_difference_linear: f64,
    /// The same for (d).
    pub largest_difference_semielliptical: f64,
}
