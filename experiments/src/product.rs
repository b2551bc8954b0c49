//! From an experiment to the content of its files, and back.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::experiment::{Entry, ExperimentError, Outcome, Quality};
use crate::json;
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
    data: Value,
}

/// Runs an experiment and makes its files: `ID.json`, `ID.svg`, `ID.png`, and `ID.csv` where it is a table.
///
/// # Errors
///
/// When the model fails, a number is not finite, or the figure cannot be drawn.
pub fn make(
    entry: &dyn Entry,
    quality: Quality,
    progress: &dyn Progress,
) -> Result<Vec<File>, ExperimentError> {
    let outcome = entry.run(quality, progress)?;
    let id = entry.id();
    let record = Record {
        id: id.to_owned(),
        title: entry.title().to_owned(),
        quality,
        caption: outcome.caption(),
        parameters: outcome.parameters(),
        data: outcome.to_json()?,
    };
    let text = json::to_text(&serde_json::to_value(record).map_err(ExperimentError::Stored)?);
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
pub fn read(entry: &dyn Entry, bytes: &[u8]) -> Result<(Box<dyn Outcome>, Quality), ExperimentError> {
    let record: Record = serde_json::from_slice(bytes).map_err(ExperimentError::Stored)?;
    Ok((entry.read(record.data)?, record.quality))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::testing::demo_entries;

    #[test]
    fn files_are_the_same_bytes_on_every_run_and_read_back() {
        let entries = demo_entries();
        let files = make(&*entries[0], Quality::Draft, &Silent).expect("works");
        assert_eq!(files, make(&*entries[0], Quality::Draft, &Silent).expect("works"));
        let names: Vec<_> = files.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["demo.json", "demo.csv", "demo.png", "demo.svg"]);
        let (outcome, quality) = read(&*entries[0], &files[0].1).expect("fits");
        assert_eq!(quality, Quality::Draft);
        assert_eq!(outcome.claims().len(), 1);
        assert_eq!(outcome.draw().expect("draws").to_svg().expect("writes").into_bytes(), files[3].1);
    }

    #[test]
    fn a_number_that_is_not_finite_is_named() {
        let entries = demo_entries();
        let error = make(&*entries[1], Quality::Draft, &Silent).expect_err("holds a NaN");
        let text = crate::experiment::chain(&error);
        assert!(text.starts_with("the data cannot be stored: speed_m_per_s[1] is NaN"), "{text}");
    }

    #[test]
    fn data_of_another_version_are_refused() {
        let entries = demo_entries();
        assert!(read(&*entries[0], b"{\"id\": 3}").is_err());
    }
}
