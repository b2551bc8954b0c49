//! Writes files so that a killed run leaves none half written: every file is written under another name and renamed.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

/// The name and content of a file.
pub type File = (String, Vec<u8>);

/// An operation that the system refuses.
#[derive(Debug, thiserror::Error)]
#[error("cannot {action} {}", path.display())]
pub struct OutputError {
    action: &'static str,
    path: PathBuf,
    source: io::Error,
}

impl OutputError {
    fn of(action: &'static str, path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> Self {
        let path = path.into();
        move |source| Self { action, path, source }
    }
}

/// A folder with the outputs of the experiments.
#[derive(Clone, Debug)]
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// Makes the folder if need be, and makes sure that files can be written in it.
    pub fn create(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        let path = path.into();
        fs::create_dir_all(&path).map_err(OutputError::of("make the output folder", &path))?;
        drop(partial(&path, b"").map_err(OutputError::of("write in the output folder", &path))?);
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
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        self.write_all(&[(name.to_owned(), bytes.to_vec())])
    }

    /// Writes several files; none gets its name before all are on the disk.
    pub fn write_all(&self, files: &[File]) -> Result<(), OutputError> {
        let partial = |(name, bytes): &File| {
            let path = self.path.join(name);
            match partial(&self.path, bytes) {
                Ok(partial) => Ok((path, partial)),
                Err(error) => Err(OutputError::of("write", path)(error)),
            }
        };
        let partials = files.iter().map(partial).collect::<Result<Vec<_>, _>>()?;
        partials.into_iter().try_for_each(|(path, partial)| match partial.persist(&path) {
            Ok(_) => Ok(()),
            Err(error) => Err(OutputError::of("write", path)(error.error)),
        })
    }

    /// The content of a file, or `None` when there is none.
    pub fn read(&self, name: &str) -> Result<Option<Vec<u8>>, OutputError> {
        let path = self.path.join(name);
        match fs::read(&path) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(OutputError::of("read", path)(error)),
        }
    }
}

/// A complete file on the disk under a name of its own, which is removed unless it gets another one. It lies in the folder of
/// its target, because a file can be renamed only within a file system.
fn partial(folder: &Path, bytes: &[u8]) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    // As any new file has them, and not for the owner alone.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.prefix(".bouncing-disk-partial-").tempfile_in(folder)?;
    file.write_all(bytes)?;
    // The name must not become visible before the content is on the disk.
    file.as_file().sync_all()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_replaced_as_a_whole_or_not_at_all() {
        let scratch = tempfile::tempdir().expect("writable");
        let folder = OutputFolder::create(scratch.path()).expect("writable");
        folder.write("a", b"a long first content").expect("writable");
        folder.write("a", b"1").expect("writable");
        fs::create_dir(scratch.path().join("b")).expect("writable");
        folder.write("b", b"a folder is in its place").expect_err("refused");
        let names =
            fs::read_dir(folder.path()).expect("readable").map(|entry| entry.expect("readable").file_name());
        let mut names: Vec<_> = names.collect();
        names.sort();
        assert_eq!(names, ["a", "b"]);
        assert_eq!(folder.read("a").expect("readable").as_deref(), Some(b"1".as_slice()));
        assert!(folder.read("c").expect("absent is no error").is_none());
        let error = OutputFolder::create(scratch.path().join("a/figures")).expect_err("a file is no folder");
        assert!(error.to_string().contains("a/figures"), "{error}");
    }
}
