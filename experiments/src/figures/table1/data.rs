//! The data of Table I.

use serde::{Deserialize, Serialize};

use crate::claim::Cases;
use crate::figures::uncertainty::Propagated;
use crate::paper::{SectionThree, TableOne, Uncertain};

/// The data of Table I.
#[derive(Debug, Serialize, Deserialize)]
pub struct Table1Data {
    pub(super) table_i: TableOne,
    pub(super) section: SectionThree,
    pub(super) slip_slope_deg: Uncertain,
    pub(super) rows: Vec<Row>,
    pub(super) computed_entries: ComputedEntries,
    pub(super) separation: AtSeparation,
    pub(super) start: AtStart,
    pub(super) components: Components,
    pub(super) fastest: Fastest,
    pub(super) arc: Arc,
    pub(super) restitution: Restitution,
    pub(super) alike: Alike,
}

/// How many inputs that all print alike give the printed entries.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Alike {
    pub(super) angular_frequency: Cases,
    pub(super) amplitude_angle: Cases,
    pub(super) friction: Cases,
    pub(super) friction_uncertainty: Cases,
}

/// The path of a point of the hand at the contact radius in Table I's toss, a straight line on the unrolled
/// cylinder.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Arc {
    /// Its length from one end to the other, along a polygon of points of the path.
    pub(super) length_m: f64,
    /// From the middle to an end: sqrt(A² + (a_e Φ)²), which the paper calls the arc length.
    pub(super) half_m: f64,
    /// How far the hand moves in a period.
    pub(super) per_period_m: f64,
}

/// Tosses that differ in the restitution only.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Restitution {
    pub(super) tried: Vec<f64>,
    /// Phase lags of the tosses; each with both initial states.
    pub(super) phase_lags_rad: Vec<f64>,
    /// Largest difference of the airborne speed from that at the first restitution (rad/s).
    pub(super) speed_deviation_rad_per_s: f64,
    /// The same for the efficiency.
    pub(super) efficiency_deviation: f64,
}

/// One line of the table.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) symbol: String,
    /// The symbol as it is set in print.
    pub(super) label: String,
    pub(super) unit: String,
    pub(super) printed: Option<String>,
    pub(super) computed: Option<f64>,
    /// Of the entries that are computed from measurements; the inputs of the others are not independent.
    pub(super) uncertainty: Option<Propagated>,
    /// Decimals in the picture.
    pub(super) decimals: usize,
    /// The formula or the source, as it is set in print.
    pub(super) origin: String,
}

/// The entries of Table I that the paper computes from measurements.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ComputedEntries {
    pub(super) angular_frequency_rad_per_s: Propagated,
    pub(super) amplitude_angle_rad: Propagated,
    pub(super) friction: Propagated,
}

/// The hand of Table I as the dough leaves it, θ = 0, without slip.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct AtSeparation {
    /// cos τ_sep: both speeds over their largest values, which Eq. (14) takes instead.
    pub(super) speed_share: f64,
    pub(super) axial_speed_m_per_s: f64,
    pub(super) angular_speed_rad_per_s: f64,
    pub(super) largest_axial_speed_m_per_s: f64,
    pub(super) largest_angular_speed_rad_per_s: f64,
    /// The ω that gives the measured speeds at τ_sep.
    pub(super) corrected_angular_frequency_rad_per_s: Propagated,
    /// It over that of Eq. (14), minus 1.
    pub(super) angular_frequency_change: f64,
}

/// The hand at τ_0 = 3π/2.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct AtStart {
    pub(super) height_over_amplitude: f64,
    pub(super) velocity_over_largest: f64,
}

/// Eq. (13) over amplitude angles from 0 to π/2.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Components {
    pub(super) angles: usize,
    /// Largest |sqrt(A² + (a_e Φ)²)/c − 1|.
    pub(super) stroke_deviation: f64,
    /// Largest |arctan(a_e Φ/A) − φ_L|.
    pub(super) angle_deviation_rad: f64,
}

/// Eq. (15), first part, over phase lags from −π to π.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Fastest {
    pub(super) lags: usize,
    /// Smallest |β̇|/(ωΦ) at τ = −θ and π − θ.
    pub(super) smallest_there: f64,
    /// Largest |β̇|/(ωΦ) at phases further than a hundredth of a period from these.
    pub(super) largest_elsewhere: f64,
}
