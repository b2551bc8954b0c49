//! From an experiment to the content of its files, and back.

use bouncing_disk::Provenance;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::experiment::{ErasedData, ExperimentError, Quality, RegisteredExperiment, chain};
use crate::finite::{self, FiniteError};
use crate::json;
use crate::measured::Measurements;
use crate::progress::Progress;
use crate::provenance;

/// The name and content of a file.
pub type File = (String, Vec<u8>);

/// What `ID.json` holds.
#[derive(Serialize, Deserialize)]
struct Record {
    /// Of every format version the first that is looked at.
    provenance: Provenance,
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
    /// What they say of their origin.
    pub provenance: Provenance,
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
/// where it is a table, each of which says where it comes from ([`provenance`]). Measurements that cannot be used are left out; what is wrong with them is stored in `ID.json`.
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
    let parameters = outcome.parameters();
    let provenance = provenance::of_figure(entry, quality, &parameters)?;
    let record = Record {
        provenance: provenance.clone(),
        id: id.to_owned(),
        title: entry.title().to_owned(),
        quality,
        caption: outcome.caption(),
        parameters,
        warnings,
        data: outcome.to_json()?,
    };
    let text = json::to_text(&finite::to_value(&record)?).map_err(FiniteError::from)?;
    let mut files = vec![(format!("{id}.json"), text.into_bytes())];
    if let Some(table) = outcome.table() {
        files.push((format!("{id}.csv"), provenance::in_csv(&provenance, &table.to_csv()?).into_bytes()));
    }
    let figure = outcome.draw()?;
    files.push((format!("{id}.png"), provenance::in_png(&provenance, &figure.to_png()?)));
    files.push((format!("{id}.svg"), provenance::in_svg(&provenance, &figure.to_svg()?).into_bytes()));
    Ok(files)
}

/// Reads the data that [`make`] stored in `ID.json`.
///
/// # Errors
///
/// When they are of a newer format, or another version wrote them and they do not fit.
pub fn read(entry: &dyn RegisteredExperiment, bytes: &[u8]) -> Result<Stored, ExperimentError> {
    let record: Value = json::read(bytes).map_err(ExperimentError::Stored)?;
    // Before anything else: a newer one may have any other form.
    let stored = record.get("provenance");
    provenance::refuse_newer(provenance::FIGURE, stored, &format!("{}.json", entry.id()))?;
    let record: Record = serde_path_to_error::deserialize(record).map_err(ExperimentError::Stored)?;
    let Record { provenance, quality, warnings, data, .. } = record;
    Ok(Stored { outcome: entry.read(data)?, provenance, quality, warnings })
}

#[cfg(test)]
mod tests {
    use bouncing_disk::core::ChatterPolicy;

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
        let Stored { outcome, provenance, quality, warnings } =
            read(&*entries[0], &files[0].1).expect("fits");
        assert_eq!((quality, warnings.len()), (Quality::Draft, 0));
        assert_eq!(outcome.claims().len(), 1);
        let drawing = provenance::without_svg(files[3].1.clone());
        assert_eq!(outcome.draw().expect("draws").to_svg().expect("writes").into_bytes(), drawing);
        assert_eq!(provenance.seed(), Some(3));
    }

    #[test]
    fn every_file_says_where_it_comes_from() {
        let entries = demo_entries();
        let files = make(&*entries[0], Quality::Draft, &Measurements::none(), &Silent).expect("works");
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("text");
        for (name, bytes) in &files {
            let stored = match name.rsplit_once('.').map(|(_, ending)| ending) {
                Some("json") => json::read::<Value>(bytes).expect("JSON")["provenance"].clone(),
                Some("csv") => provenance::from_csv(&text(bytes)).expect("in the first line"),
                Some("svg") => provenance::from_svg(&text(bytes)).expect("in the metadata"),
                Some("png") => provenance::from_png(bytes).expect("in a chunk"),
                _ => panic!("{name} is of no known kind"),
            };
            let path = std::path::Path::new(name);
            let read = Provenance::read(provenance::FIGURE, &stored, path).expect("of this format");
            assert_eq!(
                (read.program(), read.version(), read.format_version()),
                ("bouncing-disk-experiments", env!("CARGO_PKG_VERSION"), 1),
                "{name}"
            );
            assert_eq!(
                (read.seed(), read.chatter_policy()),
                (Some(3), Some(ChatterPolicy::Complete)),
                "{name}"
            );
            let parameters = read.parameters();
            assert_eq!((&parameters["figure"], &parameters["quality"]), (&"demo".into(), &"draft".into()));
            assert_eq!(parameters["values"], serde_json::json!([["restitution ε", "0.5"]]), "{name}");
        }
        assert_eq!(files.len(), 4);
    }

    #[test]
    fn data_of_a_newer_format_are_refused_by_name_whatever_else_they_have() {
        let entries = demo_entries();
        let newer = br#"{"id": 3, "provenance": {"program": "bouncing-disk-experiments", "version": "7.0.0",
            "format": "bouncing-disk figure", "format_version": 2}}"#;
        let error = read(&*entries[0], newer).expect_err("newer");
        assert_eq!(
            crate::experiment::chain(&error),
            format!(
                "\"demo.json\" has version 2 of the format \"bouncing-disk figure\" (written by \
                 \"bouncing-disk-experiments 7.0.0\"), newer than version 1, the newest that bouncing-disk {} \
                 reads: read it with the newer program",
                env!("CARGO_PKG_VERSION")
            )
        );
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
