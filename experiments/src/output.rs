//! Writes files so that a killed run leaves none half written.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::Quality;
use crate::stamp::{Stale, Stamp};

/// Why the output folder cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The folder cannot be made.
    #[error("cannot make the output folder {path}")]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system reported.
        source: io::Error,
    },
    /// The folder exists, but nothing can be written in it.
    #[error("cannot write in the output folder {path}")]
    Unwritable {
        /// The folder.
        path: PathBuf,
        /// What the system reported.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {path}")]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system reported.
        source: io::Error,
    },
    /// A file cannot be read.
    #[error("cannot read {path}")]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system reported.
        source: io::Error,
    },
    /// A stamp cannot be written as JSON.
    #[error("cannot write the stamp of {id}")]
    Stamp {
        /// The figure.
        id: String,
        /// What the writer reported.
        source: serde_json::Error,
    },
}

/// A folder with the outputs of the experiments.
#[derive(Clone, Debug)]
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// Makes the folder if need be and makes sure that files can be written in it.
    ///
    /// # Errors
    ///
    /// When it cannot be made or written in. Better now than after an hour of computing.
    pub fn create(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        let path = path.into();
        fs::create_dir_all(&path).map_err(|source| OutputError::Folder { path: path.clone(), source })?;
        let probe = path.join(format!(".probe.{}", std::process::id()));
        let tried = fs::write(&probe, b"").and_then(|()| fs::remove_file(&probe));
        tried.map_err(|source| OutputError::Unwritable { path: path.clone(), source })?;
        Ok(Self { path })
    }

    /// A folder that is only read; it need not exist.
    pub fn existing(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// The path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a file as a whole: it is complete or not there at all, whenever the program ends.
    ///
    /// # Errors
    ///
    /// When the system refuses.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        let target = self.path.join(name);
        // In the same folder, because a file can be renamed only within a file system.
        let partial = self.path.join(format!(".{name}.{}.partial", std::process::id()));
        let write = || -> io::Result<()> {
            let mut file = fs::File::create(&partial)?;
            file.write_all(bytes)?;
            // The name must not become visible before the content is on the disk.
            file.sync_all()?;
            fs::rename(&partial, &target)
        };
        write().map_err(|source| {
            let _ = fs::remove_file(&partial);
            OutputError::Write { path: target.clone(), source }
        })
    }

    /// The content of a file, or `None` when there is none.
    ///
    /// # Errors
    ///
    /// When the file exists and cannot be read.
    pub fn read(&self, name: &str) -> Result<Option<Vec<u8>>, OutputError> {
        let path = self.path.join(name);
        match fs::read(&path) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(source) => Err(OutputError::Read { path, source }),
        }
    }

    /// Writes all files of one figure and then its stamp, with the digest of the measurements in them. Files of an
    /// earlier run that are no longer made, and partial files of a killed run, are removed.
    ///
    /// # Errors
    ///
    /// When the system refuses; there is no stamp then.
    pub fn write_set(
        &self,
        id: &str,
        quality: Quality,
        measured: &str,
        run_time_s: f64,
        files: &[(String, Vec<u8>)],
    ) -> Result<(), OutputError> {
        let stamp_name = stamp_name(id);
        self.remove(&stamp_name)?;
        self.remove_leftovers(id, files)?;
        for (name, bytes) in files {
            self.write(name, bytes)?;
        }
        let contents = files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
        let stamp = Stamp::new(id, quality, measured, run_time_s, contents);
        let text = serde_json::to_vec_pretty(&stamp)
            .map_err(|source| OutputError::Stamp { id: id.to_owned(), source })?;
        self.write(&stamp_name, &text)
    }

    /// The stamp of a figure; `None` when there is none or it cannot be read.
    pub fn stamp(&self, id: &str) -> Option<Stamp> {
        let bytes = self.read(&stamp_name(id)).ok()??;
        serde_json::from_slice(&bytes).ok()
    }

    /// Whether a figure is up to date; `measured` is the digest of the measurements there are for it.
    ///
    /// # Errors
    ///
    /// The first reason to make it again.
    pub fn check(&self, id: &str, quality: Quality, measured: &str) -> Result<(), Stale> {
        let stamp = self.stamp(id).ok_or(Stale::Missing)?;
        stamp.check(id, quality, measured, |name| self.read(name).ok().flatten())
    }

    fn remove(&self, name: &str) -> Result<(), OutputError> {
        let path = self.path.join(name);
        match fs::remove_file(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => {
                Err(OutputError::Write { path, source })
            }
            _ => Ok(()),
        }
    }

    fn remove_leftovers(&self, id: &str, files: &[(String, Vec<u8>)]) -> Result<(), OutputError> {
        let read = |source| OutputError::Read { path: self.path.clone(), source };
        for entry in fs::read_dir(&self.path).map_err(read)? {
            let name = entry.map_err(read)?.file_name();
            let Some(name) = name.to_str() else { continue };
            let partial = name.starts_with(&format!(".{id}.")) && name.ends_with(".partial");
            let old = name.starts_with(&format!("{id}.")) && !files.iter().any(|(kept, _)| kept == name);
            if partial || old {
                self.remove(name)?;
            }
        }
        Ok(())
    }
}

fn stamp_name(id: &str) -> String {
    format!("{id}.stamp")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> OutputFolder {
        let path = std::env::temp_dir().join(format!("bouncing-disk-output-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        OutputFolder::create(path).expect("the temporary folder can be written")
    }

    fn names(folder: &OutputFolder) -> Vec<String> {
        let entries = fs::read_dir(folder.path()).expect("readable");
        let mut names: Vec<_> = entries
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_set_is_up_to_date_until_something_changes() {
        let folder = folder("set");
        assert_eq!(folder.check("demo", Quality::Draft, ""), Err(Stale::Missing));
        fs::write(folder.path().join(".demo.json.1.partial"), b"torn").expect("writable");
        fs::write(folder.path().join("demo.csv"), b"of an earlier version").expect("writable");
        fs::write(folder.path().join("demo2.json"), b"of another figure").expect("writable");
        let files = [("demo.json".to_owned(), b"{}".to_vec()), ("demo.svg".to_owned(), b"<svg/>".to_vec())];
        folder.write_set("demo", Quality::Draft, "", 0.1, &files).expect("writable");
        assert_eq!(names(&folder), ["demo.json", "demo.stamp", "demo.svg", "demo2.json"]);
        assert_eq!(folder.check("demo", Quality::Draft, ""), Ok(()));
        fs::write(folder.path().join("demo.svg"), b"edited").expect("writable");
        let name = "demo.svg".to_owned();
        assert_eq!(folder.check("demo", Quality::Draft, ""), Err(Stale::File { name }));
        fs::remove_dir_all(folder.path()).expect("removable");
    }

    #[test]
    fn writing_replaces_the_whole_file_and_leaves_nothing_else() {
        let folder = folder("whole");
        folder.write("a.json", b"a long first content").expect("writable");
        folder.write("a.json", b"short").expect("writable");
        assert_eq!(folder.read("a.json").expect("readable").as_deref(), Some(b"short".as_slice()));
        assert_eq!(names(&folder), ["a.json"]);
        assert!(folder.read("b.json").expect("absent is no error").is_none());
        fs::remove_dir_all(folder.path()).expect("removable");
    }

    #[test]
    fn an_unusable_folder_is_refused_at_once() {
        let folder = folder("unusable");
        fs::write(folder.path().join("file"), b"").expect("writable");
        let error =
            OutputFolder::create(folder.path().join("file/figures")).expect_err("a file is no folder");
        assert!(error.to_string().contains("file/figures"), "{error}");
        fs::remove_dir_all(folder.path()).expect("removable");
    }
}
