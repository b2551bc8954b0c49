//! The form in which a basin run is stored, which is not that of its fields.

use serde::{Deserialize, Serialize};

use super::BasinRun;
use crate::attractors::basin::{BasinSettings, FIRST_ORBIT, Grid, KnownOrbit, Label, check_number_of};
use crate::map::impact_map::ImpactMap;
use crate::numerics::error::Error;

/// A [`BasinRun`] as it is stored: of the labels those of the finished rows, one row after the other.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StoredRun {
    map: ImpactMap,
    grid: Grid,
    known: Vec<KnownOrbit>,
    settings: BasinSettings,
    finished_rows: Vec<usize>,
    labels: Vec<Label>,
}

impl From<BasinRun> for StoredRun {
    fn from(run: BasinRun) -> Self {
        let rows = run.labels.chunks_exact(run.grid.phase().cells()).zip(&run.finished).enumerate();
        let (finished_rows, labels): (Vec<_>, Vec<_>) =
            rows.filter(|(_, (_, finished))| **finished).map(|(index, (row, _))| (index, row)).unzip();
        Self {
            map: run.map,
            grid: run.grid,
            finished_rows,
            labels: labels.concat(),
            known: run.known,
            settings: run.settings,
        }
    }
}

impl TryFrom<StoredRun> for BasinRun {
    type Error = Error;

    fn try_from(stored: StoredRun) -> Result<Self, Error> {
        let StoredRun { map, grid, known, settings, finished_rows, labels } = stored;
        let columns = grid.phase().cells();
        let unfitting = |what, found, expected| Err(Error::Unfitting { what, found, expected });
        check_number_of(&known)?;
        if let Some(&row) = finished_rows.iter().find(|row| **row >= grid.speed().cells()) {
            return unfitting("finished row of a basin run", row as u64, grid.speed().cells() as u64 - 1);
        }
        if let Some(pair) = finished_rows.windows(2).find(|pair| pair[0] >= pair[1]) {
            return unfitting("finished row of a basin run, out of order", pair[0] as u64, pair[1] as u64);
        }
        if labels.len() != finished_rows.len() * columns {
            let expected = (finished_rows.len() * columns) as u64;
            return unfitting("labels of a basin run", labels.len() as u64, expected);
        }
        let most = usize::from(FIRST_ORBIT) + known.len() - 1;
        if let Some(&label) = labels.iter().find(|label| usize::from(**label) > most) {
            return unfitting("label of a basin run", label.into(), most as u64);
        }
        let mut run = Self::new(map, grid, &known, settings)?;
        for (&row, own) in finished_rows.iter().zip(labels.chunks_exact(columns)) {
            run.finished[row] = true;
            run.labels[row * columns..][..columns].copy_from_slice(own);
        }
        Ok(run)
    }
}
