//! The verdicts on all cells, as words, as rows and as a list.

use std::io::{self, Write};

use bouncing_disk::core::attractors::Verdict;
use serde_json::{Value, json};

use super::{Kind, VerdictsJob};
use crate::output::table::{Cell, Column, Csv, Table};

/// What was found, cell by cell in the order of the rows.
pub(super) struct Found {
    pub(super) job: VerdictsJob,
    pub(super) kinds: Vec<Kind>,
    /// Of each cell, where the job keeps the evidence; else none at all.
    pub(super) verdicts: Vec<Option<Verdict>>,
}

impl Found {
    /// What is printed: of a map how many cells there are of each kind, else each verdict in words.
    pub(super) fn text(&self) -> String {
        if self.job.is_map() { counted(&self.kinds) } else { self.listed() }
    }

    fn listed(&self) -> String {
        let mut table = Table::new(&[("axial_forcing", "1"), ("verdict", "1")]);
        for (forcing, verdict) in self.job.axial_forcings.values().zip(&self.verdicts) {
            let words = verdict.map_or(Kind::NoStart.name().to_owned(), |verdict| verdict.to_string());
            table.push([forcing.into(), words.into()]);
        }
        table.to_text()
    }

    /// Forcing and restitution of a cell.
    fn place(&self, index: usize) -> (f64, f64) {
        self.job.cell(index / self.job.columns(), index % self.job.columns())
    }

    /// A cell with its evidence, which the job keeps.
    pub(super) fn cell(&self, index: usize) -> io::Result<Value> {
        let (forcing, restitution) = self.place(index);
        let verdict = serde_json::to_value(self.verdicts.get(index))?;
        Ok(json!({ "axial_forcing": forcing, "restitution": restitution, "verdict": verdict }))
    }

    /// Each cell a row, with the details where there are any.
    pub(super) fn write_csv(&self, to: &mut dyn Write) -> io::Result<()> {
        let plain = [("axial_forcing", "1"), ("restitution", "1"), ("verdict", "1")];
        let details = [
            ("impacts", "1"),
            ("platform_periods", "1"),
            ("spectral_radius", "1"),
            ("exponent", "per impact"),
            ("exponent_error", "per impact"),
            ("words", "1"),
        ];
        let columns = if self.job.details { [&plain[..], &details[..]].concat() } else { plain.to_vec() };
        let columns: Vec<Column> = columns.iter().map(|(name, unit)| Column::new(name, unit)).collect();
        let mut csv = Csv::begin(to, &columns)?;
        for (index, kind) in self.kinds.iter().enumerate() {
            let (forcing, restitution) = self.place(index);
            let mut row: Vec<Cell> = vec![forcing.into(), restitution.into(), kind.name().into()];
            row.extend(self.verdicts.get(index).copied().flatten().map(detailed).into_iter().flatten());
            csv.row(&row)?;
        }
        Ok(())
    }
}

/// How many cells there are of each kind that there is.
fn counted(kinds: &[Kind]) -> String {
    let mut table = Table::new(&[("verdict", "1"), ("cells", "1"), ("share", "%")]);
    for kind in Kind::ALL {
        let count = kinds.iter().filter(|own| **own == kind).count();
        if count > 0 {
            table.push([
                kind.name().into(),
                count.into(),
                (100.0 * count as f64 / kinds.len() as f64).into(),
            ]);
        }
    }
    table.to_text()
}

/// Impacts, periods of the platform, spectral radius, exponent and its error, and all in words.
fn detailed(verdict: Verdict) -> [Cell; 6] {
    let [impacts, periods, radius, exponent, error] = match verdict {
        Verdict::Periodic { impacts, platform_periods, multipliers, .. } => {
            let radius = multipliers.spectral_radius();
            [impacts.into(), platform_periods.into(), radius.into(), Cell::Nothing, Cell::Nothing]
        }
        Verdict::Chaotic { exponent, standard_error, .. } => {
            [Cell::Nothing, Cell::Nothing, Cell::Nothing, exponent.into(), standard_error.into()]
        }
        Verdict::Chattering { cycle, .. } => {
            [cycle.impacts.into(), cycle.platform_periods.into(), Cell::Nothing, Cell::Nothing, Cell::Nothing]
        }
        _ => [const { Cell::Nothing }; 5],
    };
    [impacts, periods, radius, exponent, error, verdict.to_string().into()]
}
