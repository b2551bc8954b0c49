//! What lies in the folder of measurements.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::Arc;
use std::{fs, io};

use super::Series;
use super::error::MeasuredError;
use super::layout::Layout;

/// The content of a user's files, read once, so that a figure and its stamp see the same bytes.
#[derive(Clone, Debug, Default)]
pub struct Measurements {
    files: BTreeMap<String, Result<Vec<u8>, Arc<io::Error>>>,
}

impl Measurements {
    /// No measurements, for tests and library use.
    pub fn none() -> Self {
        Self::default()
    }

    /// Reads all files of the folder whose names end in `.csv`. A folder that does not exist holds none.
    ///
    /// # Errors
    ///
    /// When the folder exists and cannot be listed. A file that cannot be read is reported by [`Self::series`].
    pub fn read(folder: &Path) -> io::Result<Self> {
        let entries = match fs::read_dir(folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::none()),
            entries => entries?,
        };
        let mut files = BTreeMap::new();
        for entry in entries {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if name.to_lowercase().ends_with(".csv") && !name.starts_with('.') {
                files.insert(name, fs::read(entry.path()).map_err(Arc::new));
            }
        }
        Ok(Self { files })
    }

    /// The measurements of a file; `None` when there is no such file.
    ///
    /// # Errors
    ///
    /// When the file cannot be read or is malformed.
    pub fn series(&self, layout: &Layout) -> Option<Result<Series, MeasuredError>> {
        self.files.get(layout.file).map(|content| match content {
            Ok(bytes) => Series::read(layout, bytes),
            Err(source) => {
                let (file, source) = (layout.file.to_owned(), Arc::clone(source));
                Err(MeasuredError::Unreadable { file, source })
            }
        })
    }

    /// One error for each file that no layout names: a misspelt name must not be passed over in silence.
    pub fn unknown(&self, known: &[Layout]) -> Vec<MeasuredError> {
        self.files
            .keys()
            .filter(|name| !known.iter().any(|layout| layout.file == name.as_str()))
            .map(|name| MeasuredError::UnknownFile {
                file: name.clone(),
                legal: known.iter().map(|layout| layout.file).collect(),
            })
            .collect()
    }

    /// The digest of the files of these layouts; empty when there is none of them.
    pub fn digest(&self, layouts: &[Layout]) -> String {
        let mut hasher = DefaultHasher::new();
        let mut found = false;
        for layout in layouts {
            if let Some(content) = self.files.get(layout.file) {
                found = true;
                layout.file.hash(&mut hasher);
                content.as_ref().ok().hash(&mut hasher);
            }
        }
        if found { format!("{:016x}", hasher.finish()) } else { String::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{Column, Range};
    use super::*;

    const LAYOUT: Layout = Layout {
        file: "fig14.csv",
        columns: &[Column::time(), Column::value("diameter", Range::Positive)],
        least_rows: 1,
    };

    #[test]
    fn files_are_found_and_every_change_is_seen() {
        let path = std::env::temp_dir().join(format!("bouncing-disk-measured-{}", std::process::id()));
        let read = || Measurements::read(&path).expect("readable");
        assert!(read().series(&LAYOUT).is_none());
        fs::create_dir_all(&path).expect("writable");
        fs::write(path.join("README.md"), "words").expect("writable");
        assert_eq!(read().digest(&[LAYOUT]), "");
        fs::write(path.join("fig14.csv"), "time_s,diameter\n0,1\n").expect("writable");
        let first = read();
        let series = first.series(&LAYOUT).expect("there").expect("well formed");
        assert_eq!(series.rows::<2>().collect::<Vec<_>>(), [[0.0, 1.0]]);
        assert!(first.unknown(&[LAYOUT]).is_empty());
        fs::write(path.join("fig14.csv"), "time_s,diameter\n0,2\n").expect("writable");
        assert_ne!(read().digest(&[LAYOUT]), first.digest(&[LAYOUT]));
        assert_ne!(first.digest(&[LAYOUT]), "");
        fs::write(path.join("fig41.csv"), "").expect("writable");
        let unknown = read().unknown(&[LAYOUT]);
        assert_eq!(
            unknown[0].to_string(),
            "no figure reads a file called fig41.csv; legal names are fig14.csv"
        );
        // A folder in the place of a file.
        fs::remove_file(path.join("fig14.csv")).expect("removable");
        fs::create_dir(path.join("fig14.csv")).expect("writable");
        let error = read().series(&LAYOUT).expect("there").expect_err("a folder");
        assert_eq!(error.to_string(), "fig14.csv cannot be read");
        fs::remove_dir_all(path).expect("removable");
    }
}
