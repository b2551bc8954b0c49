//! Fig. 5: hand motions and the dough's motion in single tosses.

mod data;
mod picture;
mod statements;

use bouncing_disk::InitialSpin;

pub use self::data::Fig05Data;
use self::data::{Column, Dependence, Toss};
use super::toss_case::TossCase;
use crate::claim::Claim;
use crate::experiment::{Experiment, ExperimentError, Quality};
use crate::paper;
use crate::printed::PrintedNumber;
use crate::progress::Progress;
use crate::table::Table;
use bouncing_disk_plot::Figure;

/// Fig. 5.
#[derive(Debug)]
pub struct Fig05;

impl Experiment for Fig05 {
    type Data = Fig05Data;

    const ID: &'static str = "fig05";

    const TITLE: &'static str = "Hand motions and the resulting dough trajectories";
    const READING: &str = include_str!("fig05/reading.md");

    fn caption(data: &Fig05Data) -> String {
        statements::caption(data)
    }

    fn run(quality: Quality, progress: &dyn Progress) -> Result<Fig05Data, ExperimentError> {
        let points = quality.choose(60, 240);
        let table_i = paper::table_one()?;
        let printed = paper::section_three()?;
        let table = TossCase::from(&table_i);
        let angles = [
            &printed.amplitude_angle_of_largest_speed_ratio_rad,
            &printed.optimal_amplitude_angle_rad,
            &printed.amplitude_angle_of_fig5c_rad,
        ];
        let phase_lags = [data::FIRST_PHASE_LAG, paper::value("section3.second_phase_lag_of_fig5")?];
        progress.start(angles.len() as u64 + 1, "columns");
        let mut columns = Vec::new();
        let mut optimum = table;
        for (index, text) in angles.into_iter().enumerate() {
            let Some(angle) = PrintedNumber::read(text) else { continue };
            let case = table.at_angle(angle.value);
            if index == 1 {
                optimum = case;
            }
            columns.push(Column::new(text, &case, phase_lags, points)?);
            progress.advance(1);
        }
        let lags = data::PHASE_LAGS_NEAR_ZERO
            .into_iter()
            .map(|lag| Toss::new(&optimum.at_lag(lag), points).map(|toss| Dependence::new(&toss)))
            .collect::<Result<Vec<_>, _>>()?;
        let firm_grip = data::FRICTION_FACTORS
            .into_iter()
            .map(|factor| data::Grip::new(&table, factor, &columns))
            .collect::<Result<Vec<_>, _>>()?;
        let grid_point = data::GridPoint::new(&table_i, &printed)?;
        let effects = data::Effects::new(&table, &optimum)?;
        progress.advance(1);
        Ok(Fig05Data {
            table_i,
            printed,
            initial_state: InitialSpin::AbsoluteRest,
            columns,
            lags,
            firm_grip,
            grid_point,
            effects,
        })
    }

    fn draw(data: &Fig05Data) -> Result<Figure, ExperimentError> {
        Ok(picture::figure(data))
    }

    fn claims(data: &Fig05Data) -> Vec<Claim> {
        statements::claims(data)
    }

    fn parameters(data: &Fig05Data) -> Vec<(String, String)> {
        statements::parameters(data)
    }

    fn table(data: &Fig05Data) -> Option<Table> {
        Some(statements::table(data))
    }
}
