//! Table III: the default motor in both readings of its last column, and what the entries were computed from.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::TransientSettings;
use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::figures::stall;
use crate::progress::Progress;
use crate::table::{Cell, Table};
pub use data::Table3Data;

/// Table III.
#[derive(Debug)]
pub struct Table3;

impl Experiment for Table3 {
    type Data = Table3Data;
    const ID: &'static str = "table3";
    const TITLE: &'static str = "Default values for the dimensional parameters";
    const DISCUSSION: &str = include_str!("table3/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn seeds() -> Vec<(&'static str, u64)> {
        vec![
            ("drops of the ball", compute::DROP_SEED),
            ("runs to stall", stall::SEED),
            ("ensembles", TransientSettings::default().seed),
        ]
    }

    fn caption(data: &Table3Data) -> String {
        format!(
            "The default motor. Sec. V A announces {} inputs, the table prints {}: a column for ω is missing, and its \
             last column can be read in two ways, both computed here: g = {} m/s² as printed, or ω/2π = {} kHz with \
             gravity for g. ω is 2π × {} kHz in both. Below the nine inputs: what follows from \
             them. The load torque that stalls the motor is found by bisection on the sign of the mean speed, {} members over {} rise times each; the paper takes \
             α̇_ss/t_c for it.",
            data.inputs.len(),
            data.printed_inputs,
            data.printed_preload_acceleration_m_per_s2,
            data.frequency_khz,
            data.frequency_khz,
            data.stalls[1].members,
            data.stalls[1].rises,
        )
    }

    fn compute(quality: Quality, _: &dyn Progress) -> Result<Table3Data, ExperimentError> {
        compute::compute(quality)
    }

    fn draw(data: &Table3Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Table3Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Table3Data) -> Vec<(String, String)> {
        let drop = &data.drop;
        let mut parameters: Vec<_> = data
            .inputs
            .iter()
            .map(|input| {
                (
                    input.symbol.clone(),
                    format!("{} {}", draw::shown(input.values[1]), input.unit).trim_end().to_owned(),
                )
            })
            .collect();
        parameters.push(("height of the drop".to_owned(), format!("{} m", drop.heights.drop_height_m)));
        parameters.push(("height of the rebound".to_owned(), format!("{} m", drop.heights.rebound_height_m)));
        parameters
    }

    fn table(data: &Table3Data) -> Option<Table> {
        let mut table =
            Table::new(["quantity", "unit", "printed", "g as printed", "70 read as frequency in kHz"]);
        for input in &data.inputs {
            table.push([
                Cell::from(input.symbol.as_str()),
                Cell::from(input.unit.as_str()),
                Cell::from(input.printed.as_str()),
                input.values[0].into(),
                input.values[1].into(),
            ]);
        }
        for row in &data.derived {
            table.push([
                Cell::from(row.symbol.as_str()),
                Cell::from(row.unit.as_str()),
                Cell::Empty,
                row.values[0].into(),
                row.values[1].into(),
            ]);
        }
        Some(table)
    }
}
