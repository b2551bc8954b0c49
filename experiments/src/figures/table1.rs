//! Table I: the single toss, what its entries were computed from, and what follows from them.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::{Cell, Table};
pub use data::Table1Data;

/// Table I.
#[derive(Debug)]
pub struct Table1;

impl Experiment for Table1 {
    type Data = Table1Data;
    const ID: &'static str = "table1";
    const TITLE: &'static str = "Full specification of a single toss";
    const DISCUSSION: &str = include_str!("table1/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![("launches and slopes that print alike", compute::SEED)]
    }

    fn caption(data: &Table1Data) -> String {
        format!(
            "The single toss as printed, the entries that the paper computes (φ_L, ω, μ) computed again, and the \
             quantities that follow from the printed entries. Uncertainties are sums of the effects of the inputs of \
             a row, each half the difference of both ends. Eq. (14) takes the hand's largest speeds for those at \
             separation; with the factor cos τ_sep that it leaves out, ω is {:.2} rad/s.",
            data.separation.corrected_angular_frequency_rad_per_s.value
        )
    }

    fn compute(_: Quality, _: &dyn Progress) -> Result<Table1Data, ExperimentError> {
        compute::compute()
    }

    fn draw(data: &Table1Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Table1Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Table1Data) -> Vec<(String, String)> {
        let table = &data.table_i;
        vec![
            ("launch speed".to_owned(), format!("{} m/s", data.section.launch_speed_m_per_s)),
            (
                "launch angular speed".to_owned(),
                format!("{} rad/s", data.section.launch_angular_speed_rad_per_s),
            ),
            ("slope of slip".to_owned(), format!("{}°", data.slip_slope_deg)),
            ("c".to_owned(), format!("{} m", table.stroke_m)),
            ("a_e".to_owned(), format!("{} m", table.contact_radius_m)),
            ("a_g".to_owned(), format!("{} m", table.gyration_radius_m)),
            ("g".to_owned(), format!("{} m/s²", table.preload_acceleration_m_per_s2)),
        ]
    }

    fn table(data: &Table1Data) -> Option<Table> {
        let mut table = Table::new([
            "quantity",
            "unit",
            "printed",
            "computed",
            "uncertainty, sum of effects",
            "uncertainty, root sum of squares",
        ]);
        for row in &data.rows {
            let uncertainty = |of: fn(&super::uncertainty::Propagated) -> f64| {
                row.uncertainty.as_ref().map_or(Cell::Empty, |uncertainty| of(uncertainty).into())
            };
            table.push([
                Cell::from(row.symbol.as_str()),
                Cell::from(row.unit.as_str()),
                row.printed.as_deref().map_or(Cell::Empty, Cell::from),
                row.computed.map_or(Cell::Empty, Cell::from),
                uncertainty(|uncertainty| uncertainty.sum),
                uncertainty(|uncertainty| uncertainty.root_sum_of_squares),
            ]);
        }
        Some(table)
    }
}
