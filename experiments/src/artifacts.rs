//! From an experiment to the content of its files, and back.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::experiment::{ErasedData, ExperimentError, Quality, RegisteredExperiment, chain};
use crate::finite::{self, FiniteError};
use crate::json;
use crate::measured::Measurements;
use crate::progress::Progress;

/// The name and content of a file.
pub type File = (String, Vec<u8>);

/// What `ID.json` holds.
#[derive(Serialize, Deserialize)]
struct Record {
    id: String,
    title: String,
    quality: Quality,
    caption: String,
    parameters: Vec<(String, String)>,
    /// Faults of the user's measurements that are therefore not shown.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
    data: Value,
}

/// Data that an earlier run stored.
pub struct Stored {
    /// The data.
    pub outcome: Box<dyn ErasedData>,
    /// The quality they were made in.
    pub quality: Quality,
    /// Faults of the user's measurements that are therefore not shown.
    pub warnings: Vec<String>,
}

impl std::fmt::Debug for Stored {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut text = formatter.debug_struct("Stored");
        text.field("quality", &self.quality).field("warnings", &self.warnings).finish_non_exhaustive()
    }
}

/// Runs an experiment, adds the user's measurements and makes its files: `ID.json`, `ID.svg`, `ID.png`, and `ID.csv`
/// where it is a table. Measurements that cannot be used are left out; what is wrong with them is stored in `ID.json`.
///
/// # Errors
///
/// When the model fails, a number is not finite, a claim has no data to be judged by, or the figure cannot be drawn.
pub fn make(
    entry: &dyn RegisteredExperiment,
    quality: Quality,
    measurements: &Measurements,
    progress: &dyn Progress,
) -> Result<Vec<File>, ExperimentError> {
    let mut outcome = entry.compute(quality, progress)?;
    if let Some(claim) = outcome.claims().iter().find(|claim| claim.lacks_data()) {
        return Err(ExperimentError::NoData { quantity: claim.quantity().to_owned() });
    }
    let mut warnings = Vec::new();
    for series in entry.measurements().iter().filter_map(|layout| measurements.series(layout)) {
        let added = series.map_err(ExperimentError::from).and_then(|series| outcome.overlay(&series));
        warnings.extend(added.err().map(|error| chain(&error)));
    }
    let id = entry.id();
    let record = Record {
        id: id.to_owned(),
        title: entry.title().to_owned(),
        quality,
        caption: outcome.caption(),
        parameters: outcome.parameters(),
        warnings,
        data: outcome.to_json()?,
    };
    let text = json::to_text(&finite::to_value(&record)?).map_err(FiniteError::from)?;
    let mut files = vec![(format!("{id}.json"), text.into_bytes())];
    if let Some(table) = outcome.table() {
        files.push((format!("{id}.csv"), table.to_csv()?.into_bytes()));
    }
    let figure = outcome.draw()?;
    files.push((format!("{id}.png"), figure.to_png()?));
    files.push((format!("{id}.svg"), figure.to_svg()?.into_bytes()));
    Ok(files)
}

/// Reads the data that [`make`] stored in `ID.json`.
///
/// # Errors
///
/// When another version wrote them and they do not fit.
pub fn read(entry: &dyn RegisteredExperiment, bytes: &[u8]) -> Result<Stored, ExperimentError> {
    let record: Record = json::read(bytes).map_err(ExperimentError::Stored)?;
    Ok(Stored { outcome: entry.read(record.data)?, quality: record.quality, warnings: record.warnings })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::testing::demo_entries;

    #[test]
    fn files_are_the_same_bytes_on_every_run_and_read_back() {
        let entries = demo_entries();
        let make = || make(&*entries[0], Quality::Draft, &Measurements::none(), &Silent);
        let files = make().expect("works");
        assert_eq!(files, make().expect("works"));
        let names: Vec<_> = files.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["demo.json", "demo.csv", "demo.png", "demo.svg"]);
        let Stored { outcome, quality, warnings } = read(&*entries[0], &files[0].1).expect("fits");
        assert_eq!((quality, warnings.len()), (Quality::Draft, 0));
        assert_eq!(outcome.claims().len(), 1);
        assert_eq!(outcome.draw().expect("draws").to_svg().expect("writes").into_bytes(), files[3].1);
    }

    #[test]
    fn a_number_that_is_not_finite_is_named() {
        let entries = demo_entries();
        let error =
            make(&*entries[1], Quality::Draft, &Measurements::none(), &Silent).expect_err("holds a NaN");
        let text = crate::experiment::chain(&error);
        assert!(text.starts_with("the data cannot be stored: speed_m_per_s[1] is NaN"), "{text}");
    }

    #[test]
    fn measurements_are_shown_and_malformed_ones_only_reported() {
        let entries = demo_entries();
        let path = std::env::temp_dir().join(format!("bouncing-disk-product-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("writable");
        let make = |content: &str| {
            std::fs::write(path.join("demo.csv"), content).expect("writable");
            let measurements = Measurements::read(&path, entries[0].measurements()).expect("readable");
            let files = make(&*entries[0], Quality::Draft, &measurements, &Silent).expect("works");
            let stored = read(&*entries[0], &files[0].1).expect("fits");
            (stored.warnings, stored.outcome.caption())
        };
        let (warnings, caption) = make("phase_rad\n0.1\n0.3\n");
        assert!(warnings.is_empty() && caption.ends_with("2 measured."), "{warnings:?} {caption}");
        let (warnings, caption) = make("phase_rad\n0.1\nx\n");
        assert!(warnings[0].contains("line 3, column 1 (phase_rad): \"x\"") && !caption.contains("measured"));
        // Well formed, but the figure cannot use it.
        let (warnings, _) = make("phase_rad\n9\n");
        assert_eq!(warnings, ["demo.csv: the points cannot be evaluated: invalid float literal"]);
        std::fs::remove_dir_all(path).expect("removable");
    }

    #[test]
    fn data_of_another_version_are_refused() {
        let entries = demo_entries();
        let error = read(&*entries[0], b"{\"id\": 3}").expect_err("a number");
        let text = crate::experiment::chain(&error);
        assert!(
            text.starts_with("the stored data do not fit this version: id: invalid type: integer"),
            "{text}"
        );
    }
}
