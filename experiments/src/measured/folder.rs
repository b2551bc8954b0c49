//! What lies in the folder of measurements.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::Arc;
use std::{fs, io};

use bouncing_disk::regular_file;

use super::error::MeasuredError;
use super::layout::{LARGEST_FILE, Layout};
use super::series::Series;

/// The most unknown files that are named one by one.
const NAMED: usize = 10;

/// The content of a user's files, read once, so that a figure and its cache key see the same bytes.
#[derive(Clone, Debug, Default)]
pub struct Measurements {
    files: BTreeMap<&'static str, Result<Vec<u8>, Arc<io::Error>>>,
    /// Names of files that no layout names, sorted.
    unknown: Vec<String>,
    /// The names of the layouts.
    legal: Vec<&'static str>,
}

impl Measurements {
    /// No measurements, for tests and library use.
    pub fn none() -> Self {
        Self::default()
    }

    /// Reads the files of these layouts and looks what other files there are whose names end in `.csv`. A
    /// folder that does not exist holds none.
    ///
    /// # Errors
    ///
    /// When the folder exists and cannot be listed. A file that cannot be read is reported by [`Self::series`].
    pub fn read(folder: &Path, layouts: &[Layout]) -> io::Result<Self> {
        let entries = match fs::read_dir(folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::none()),
            entries => entries?,
        };
        let legal: Vec<_> = layouts.iter().map(|layout| layout.file).collect();
        let (mut files, mut unknown) = (BTreeMap::new(), Vec::new());
        for entry in entries {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if let Some(known) = legal.iter().find(|known| **known == name) {
                let content = regular_file::read(&entry.path(), LARGEST_FILE).map_err(Arc::new);
                files.insert(*known, content);
            } else if name.to_lowercase().ends_with(".csv") && !name.starts_with('.') {
                unknown.push(name);
            }
        }
        unknown.sort();
        Ok(Self { files, unknown, legal })
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

    /// One error for each file that no layout names, since a misspelt name must not be passed over in
    /// silence; where they are many, as in a folder of something else, the last error counts those that have
    /// none of their own.
    pub fn unknown(&self) -> Vec<MeasuredError> {
        let (named, more) = self.unknown.split_at(self.unknown.len().min(NAMED));
        let legal = || self.legal.clone();
        let named =
            named.iter().map(|file| MeasuredError::UnknownFile { file: file.clone(), legal: legal() });
        let more =
            (!more.is_empty()).then(|| MeasuredError::UnknownFiles { files: more.len(), legal: legal() });
        named.chain(more).collect()
    }

    /// The digest of the files of these layouts; empty when there is none of them.
    pub fn digest(&self, layouts: &[Layout]) -> String {
        let mut hasher = DefaultHasher::new();
        let mut found = false;
        for layout in layouts {
            if let Some(content) = self.files.get(layout.file) {
                found = true;
                layout.file.hash(&mut hasher);
                // Why a file cannot be read is in the figure's caption, too.
                content.as_ref().map_err(|error| error.to_string()).hash(&mut hasher);
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
        let read = || Measurements::read(&path, &[LAYOUT]).expect("readable");
        assert!(read().series(&LAYOUT).is_none());
        fs::create_dir_all(&path).expect("writable");
        fs::write(path.join("README.md"), "words").expect("writable");
        assert_eq!(read().digest(&[LAYOUT]), "");
        fs::write(path.join("fig14.csv"), "time_s,diameter\n0,1\n").expect("writable");
        let first = read();
        let series = first.series(&LAYOUT).expect("there").expect("well formed");
        assert_eq!(series.rows::<2>().collect::<Vec<_>>(), [[0.0, 1.0]]);
        assert!(first.unknown().is_empty());
        fs::write(path.join("fig14.csv"), "time_s,diameter\n0,2\n").expect("writable");
        assert_ne!(read().digest(&[LAYOUT]), first.digest(&[LAYOUT]));
        assert_ne!(first.digest(&[LAYOUT]), "");
        fs::write(path.join("fig41.csv"), "").expect("writable");
        let unknown = read().unknown();
        assert_eq!(
            unknown[0].to_string(),
            "no figure reads a file called fig41.csv; legal names are fig14.csv"
        );
        // A folder in the place of a file.
        fs::remove_file(path.join("fig14.csv")).expect("removable");
        fs::create_dir(path.join("fig14.csv")).expect("writable");
        let error = read().series(&LAYOUT).expect("there").expect_err("a folder");
        assert_eq!(
            crate::experiment::chain(&error),
            "fig14.csv cannot be read: it is a folder; legal is a regular file"
        );
        let digest = read().digest(&[LAYOUT]);
        // Too large, without a byte on the disk.
        fs::remove_dir(path.join("fig14.csv")).expect("removable");
        let file = fs::File::create(path.join("fig14.csv")).expect("writable");
        file.set_len(LARGEST_FILE + 1).expect("writable");
        let error = read().series(&LAYOUT).expect("there").expect_err("too large");
        assert_eq!(
            crate::experiment::chain(&error),
            "fig14.csv cannot be read: it has 67108865 bytes; legal are 67108864 or fewer"
        );
        // The figure shows the message.
        assert_ne!(read().digest(&[LAYOUT]), digest);
        // A folder of something else; its files are not read.
        for index in 0..30 {
            fs::write(path.join(format!("z\n{index:02}.csv")), "").expect("writable");
        }
        let unknown: Vec<_> = read().unknown().iter().map(ToString::to_string).collect();
        assert_eq!(unknown.len(), 11);
        assert!(unknown[1].starts_with(r"no figure reads a file called z\n00.csv;"), "{}", unknown[1]);
        assert!(unknown[10].starts_with("no figure reads 21 more files;"), "{}", unknown[10]);
        fs::remove_dir_all(path).expect("removable");
    }
}
