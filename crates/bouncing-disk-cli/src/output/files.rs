//! Files of results: which kinds there are, where they may go, and that none is ever seen half written.

use std::ffi::OsString;
use std::fmt::{self, Display, Formatter};
use std::fs::{self, File};
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use crate::failure::Failure;

/// A kind of file, known by its ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Csv,
    Json,
    Png,
    Svg,
}

impl Kind {
    const ALL: [(&'static str, Self); 4] =
        [("csv", Self::Csv), ("json", Self::Json), ("png", Self::Png), ("svg", Self::Svg)];
}

/// A file that is to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) path: PathBuf,
    pub(crate) kind: Kind,
}

impl FromStr for Target {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let path = PathBuf::from(text);
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let known = Kind::ALL.iter().find(|(name, _)| ending.as_deref() == Some(*name));
        match known {
            Some((_, kind)) => Ok(Self { path, kind: *kind }),
            None => Err("the ending says what is written: .csv, .json, .png or .svg".to_owned()),
        }
    }
}

impl Display for Target {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())
    }
}

impl Target {
    /// Whether it can be written, as far as that is seen without writing: better now than after an hour of
    /// computing.
    ///
    /// # Errors
    /// [`Failure::Usage`] if the folder is not there or the file is, unless it may be replaced.
    pub(crate) fn check(&self, replace: bool) -> Result<(), Failure> {
        let path = self.path.display();
        let folder = folder_of(&self.path);
        if !folder.is_dir() {
            return Err(Failure::usage(format!(
                "{path}: there is no folder {}; make it first",
                folder.display()
            )));
        }
        match fs::symlink_metadata(&self.path) {
            Ok(found) if found.is_dir() => Err(Failure::usage(format!("{path}: it is a folder"))),
            Ok(_) if !replace => {
                Err(Failure::usage(format!("{path}: it is there already; --force replaces it")))
            }
            _ => {
                // Also tells of a folder that nothing can be written in.
                begin(&self.path)
                    .map(|(partial, _)| remove(&partial))
                    .map_err(|error| unwritable(&self.path, &error))
            }
        }
    }

    /// Writes the file as a whole or not at all.
    ///
    /// # Errors
    /// When the system refuses; when the file is there, unless it may be replaced.
    pub(crate) fn write(&self, bytes: &[u8], replace: bool) -> Result<(), Failure> {
        let (partial, mut file) = begin(&self.path).map_err(|error| unwritable(&self.path, &error))?;
        let written = file.write_all(bytes).and_then(|()| file.sync_all());
        drop(file);
        let named = written.and_then(|()| {
            if replace {
                return fs::rename(&partial, &self.path);
            }
            // A second name fails where there is a file, which a change of the name does not.
            match fs::hard_link(&partial, &self.path) {
                Ok(()) => fs::remove_file(&partial),
                Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(error),
                // A file system without second names.
                Err(_) if !self.path.exists() => fs::rename(&partial, &self.path),
                Err(error) => Err(error),
            }
        });
        named.map_err(|error| {
            remove(&partial);
            unwritable(&self.path, &error)
        })
    }
}

fn unwritable(path: &Path, error: &io::Error) -> Failure {
    Failure::failed(format!("{} cannot be written: {error}", path.display()))
}

/// Nothing can be done about an error, and what is left harms nothing.
fn remove(partial: &Path) {
    let _ = fs::remove_file(partial);
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A new file in the folder of the target, because a file gets another name only within a file system.
fn begin(path: &Path) -> io::Result<(PathBuf, File)> {
    let name =
        path.file_name().ok_or_else(|| io::Error::new(ErrorKind::InvalidInput, "it has no file name"))?;
    for count in 0_u32.. {
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}.{count}.partial", std::process::id()));
        let partial = path.with_file_name(hidden);
        match File::create_new(&partial) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            other => return other.map(|file| (partial, file)),
        }
    }
    Err(io::Error::from(ErrorKind::AlreadyExists))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("bouncing-disk-cli-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn target(path: &Path) -> Target {
        path.to_str().unwrap().parse().unwrap()
    }

    #[test]
    fn the_ending_decides() {
        assert_eq!("a/b.PNG".parse::<Target>().unwrap().kind, Kind::Png);
        for text in ["", "a", "a.txt", "csv", ".csv", "a.csv.gz"] {
            let error = text.parse::<Target>().unwrap_err();
            assert!(error.contains(".csv, .json, .png or .svg"), "{text}: {error}");
        }
    }

    #[test]
    fn a_file_is_replaced_only_if_that_is_meant_and_nothing_else_is_left() {
        let folder = folder("files");
        let target = target(&folder.join("a.csv"));
        target.check(false).unwrap();
        target.write(b"one", false).unwrap();
        let refused = target.check(false).unwrap_err();
        assert!(matches!(&refused, Failure::Usage(text) if text.contains("--force")), "{refused:?}");
        // Also if it appeared while the result was computed.
        assert!(matches!(target.write(b"two", false), Err(Failure::Failed(_))));
        assert_eq!(fs::read(&target.path).unwrap(), b"one");
        target.check(true).unwrap();
        target.write(b"three", true).unwrap();
        assert_eq!(fs::read(&target.path).unwrap(), b"three");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_missing_folder_and_a_folder_in_the_place_are_told() {
        let folder = folder("places");
        let missing = target(&folder.join("no/a.csv")).check(true).unwrap_err();
        assert!(
            matches!(&missing, Failure::Usage(text) if text.contains("there is no folder")),
            "{missing:?}"
        );
        fs::create_dir(folder.join("b.csv")).unwrap();
        let taken = target(&folder.join("b.csv"));
        assert!(matches!(taken.check(true), Err(Failure::Usage(_))));
        assert!(matches!(taken.write(b"x", true), Err(Failure::Failed(_))));
        fs::remove_dir_all(&folder).unwrap();
    }
}
