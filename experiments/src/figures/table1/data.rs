//! The data of Table I.

use serde::{Deserialize, Serialize};

use crate::claims::Cases;
use crate::figures::uncertainty::Propagated;
use crate::claims::paper::{SectionThree, TableOne, Uncertain};

/// The data of Table I.
#[derive(Debug, Serialize, Deserialize)]
pub struct Table1Data {
    pub(super) table_i: TableOne,
    pub(super) section: SectionThree,
    pub(super) slip_slope_deg: Uncertain,
    pub(super) rows: Vec<Row>,
    pub(super) computed_entries: ComputedEntries,
    pub(super) separation: AtSeparation,
    pub(super) arc: Arc,
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
