//! The checked numbers of one file.

use std::collections::BTreeMap;

use super::error::{LineFault, MeasuredError};
use super::layout::{Layout, whole};
use super::parse;

/// The numbers of one file, all legal: rows of the columns in the order of the layout.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    layout: Layout,
    rows: parse::Rows,
}

impl Series {
    /// Reads a file's content.
    ///
    /// # Errors
    ///
    /// The first fault, with its line and column.
    pub fn read(layout: &Layout, bytes: &[u8]) -> Result<Self, MeasuredError> {
        Ok(Self { layout: *layout, rows: parse::rows(layout, bytes)? })
    }

    /// The layout of the file.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The rows of a layout of `N` columns; none if it has another number of them.
    pub fn rows<const N: usize>(&self) -> impl Iterator<Item = [f64; N]> + '_ {
        self.rows.values.iter().filter_map(|row| row.as_slice().try_into().ok())
    }

    /// The rows of each trial, by rising trial number, of a layout of `N` columns whose first is the trial.
    pub fn trials<const N: usize>(&self) -> Vec<(u32, Vec<[f64; N]>)> {
        let mut trials = BTreeMap::new();
        for row in self.rows::<N>() {
            if let Some(trial) = row.first().copied().and_then(whole) {
                trials.entry(trial).or_insert_with(Vec::new).push(row);
            }
        }
        trials.into_iter().collect()
    }

    /// The error of a number that is legal in itself, but that the figure has no place for; row and column of
    /// [`Self::rows`], from 0.
    pub fn illegal(&self, row: usize, column: usize, legal: impl Into<String>) -> MeasuredError {
        let one = |list: &[usize], index: usize| list.get(index).copied().unwrap_or_default();
        let name = self.layout.columns.get(column).map_or("", |column| column.name);
        let value = self.rows.values.get(row).and_then(|row| row.get(column)).copied().unwrap_or(f64::NAN);
        MeasuredError::Line {
            file: self.layout.file,
            line: one(&self.rows.lines, row),
            column: Some((one(&self.rows.columns, column), name)),
            fault: LineFault::NotOfFigure(value, legal.into()),
        }
    }

    /// The error of a fit to this file or to one of its trials.
    pub fn unusable(
        &self,
        trial: Option<u32>,
        error: impl std::error::Error + Send + Sync + 'static,
    ) -> MeasuredError {
        let what = trial.map_or_else(|| "the points".to_owned(), |trial| format!("trial {trial}"));
        MeasuredError::Unusable { file: self.layout.file, what, source: Box::new(error) }
    }
}
