//! Table II: the effects of the uncertainties of the inputs on the airborne speed.

mod claims;
mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;
use bouncing_disk_plot::Figure;

pub use self::data::Table2Data;
use crate::claims::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::progress::Progress;
use crate::table::{Cell, Table};

/// Table II.
#[derive(Debug)]
pub struct Table2;

impl Experiment for Table2 {
    type Data = Table2Data;
    const ID: &'static str = "table2";
    const TITLE: &'static str = "Effects of input parameter uncertainties";
    const DISCUSSION: &str = include_str!("table2/discussion.md");
    const CHATTER_POLICY: Option<ChatterPolicy> = Some(ChatterPolicy::Complete);

    fn caption(data: &Table2Data) -> String {
        format!(
            "Airborne rotation speed of the toss of Table I and its uncertainties due to each input: half the \
             difference of the speeds at both ends of the input's range, the changes at the ends, and the printed \
             value. Together {:.1} rad/s as a root sum of squares.",
            data.combined.root_sum_of_squares_rad_per_s
        )
    }

    fn compute(_: Quality, progress: &dyn Progress) -> Result<Table2Data, ExperimentError> {
        compute::compute(progress)
    }

    fn draw(data: &Table2Data) -> Result<Figure, ExperimentError> {
        Ok(draw::draw(data))
    }

    fn claims(data: &Table2Data) -> Vec<Claim> {
        claims::claims(data)
    }

    fn parameters(data: &Table2Data) -> Vec<(String, String)> {
        let mut parameters = vec![("phase lag θ".to_owned(), format!("{} rad", data.table_i.phase_lag_rad))];
        parameters.extend(data.effects.iter().map(|effect| {
            let value = format!("{} ± {} {}", effect.value, effect.uncertainty, effect.unit);
            (effect.input.clone(), value.trim_end().to_owned())
        }));
        parameters.push(("g".to_owned(), format!("{} m/s²", data.table_i.preload_acceleration_m_per_s2)));
        parameters
    }

    fn table(data: &Table2Data) -> Option<Table> {
        let mut table = Table::new([
            "input",
            "unit",
            "value",
            "uncertainty",
            "half difference (rad/s)",
            "upper end (rad/s)",
            "lower end (rad/s)",
            "slope times uncertainty (rad/s)",
            "printed (rad/s)",
        ]);
        for effect in &data.effects {
            table.push([
                Cell::from(effect.input.as_str()),
                Cell::from(effect.unit.as_str()),
                effect.value.into(),
                effect.uncertainty.into(),
                effect.central_rad_per_s.abs().into(),
                effect.upper_rad_per_s.into(),
                effect.lower_rad_per_s.into(),
                effect.linear_rad_per_s.into(),
                effect.printed_rad_per_s.into(),
            ]);
        }
        Some(table)
    }
}
