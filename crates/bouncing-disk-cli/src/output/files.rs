//! Files of results: which kinds there are, where they may go, and that none is ever seen half written.

use std::ffi::OsString;
use std::fmt::{self, Display, Formatter};
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use clap::builder::{OsStringValueParser, TypedValueParser, ValueParserFactory};

use crate::failure::Failure;

/// A kind of file, known by its ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Csv,
    Json,
    Png,
    Svg,
    /// Parameters, which --template writes.
    Toml,
}

impl Kind {
    const ALL: [(&'static str, Self); 5] = [
        ("csv", Self::Csv),
        ("json", Self::Json),
        ("png", Self::Png),
        ("svg", Self::Svg),
        ("toml", Self::Toml),
    ];
}

/// A file that is to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) path: PathBuf,
    pub(crate) kind: Kind,
}

impl Target {
    /// The file of this name, which need not be a text.
    ///
    /// # Errors
    /// Says in words what a name must end in.
    pub(crate) fn new(name: OsString) -> Result<Self, String> {
        let path = PathBuf::from(name);
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let known = Kind::ALL.iter().find(|(name, _)| ending.as_deref() == Some(*name));
        match known {
            Some((_, kind)) => Ok(Self { path, kind: *kind }),
            None => Err("the ending says what is written: .csv, .json, .png or .svg; .toml with --template"
                .to_owned()),
        }
    }
}

/// Names of files need not be texts.
impl ValueParserFactory for Target {
    type Parser = clap::builder::ValueParser;

    fn value_parser() -> Self::Parser {
        OsStringValueParser::new().try_map(Self::new).into()
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
        check_place(&self.path)?;
        if !replace && fs::symlink_metadata(&self.path).is_ok() {
            return Err(Failure::usage(format!("{self}: it is there already; --force replaces it")));
        }
        // Also tells of a folder that nothing can be written in.
        begin(&self.path).map(|(partial, _)| remove(&partial)).map_err(|error| unwritable(&self.path, &error))
    }

    /// Writes the file as a whole or not at all; `content` gives it to a writer that gathers small parts.
    ///
    /// # Errors
    /// When the system refuses; when the file is there, unless it may be replaced.
    pub(crate) fn write(
        &self,
        replace: bool,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let (partial, file) = begin(&self.path).map_err(|error| unwritable(&self.path, &error))?;
        let mut writer = BufWriter::with_capacity(GATHERED, file);
        let written = content(&mut writer)
            .and_then(|()| writer.into_inner().map_err(io::IntoInnerError::into_error))
            .and_then(|file| file.sync_all());
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

/// Bytes that are gathered before they are written.
const GATHERED: usize = 1 << 16;

/// Whether there can be a file at a path: it names one, in a folder that is there, and is no folder.
///
/// # Errors
/// [`Failure::Usage`] says why not.
pub(crate) fn check_place(path: &Path) -> Result<(), Failure> {
    let shown = path.display();
    let bytes = |text: &std::ffi::OsStr| text.as_encoded_bytes().to_vec();
    // `a.csv/` and `a.csv/.` have the same last part, and yet name a folder.
    if !path.file_name().is_some_and(|name| bytes(path.as_os_str()).ends_with(&bytes(name))) {
        return Err(Failure::usage(format!("{shown}: this is the name of a folder, not of a file")));
    }
    let folder = folder_of(path);
    if !folder.is_dir() {
        let folder = folder.display();
        return Err(Failure::usage(format!("{shown}: there is no folder {folder}; make it first")));
    }
    if path.is_dir() {
        return Err(Failure::usage(format!("{shown}: it is a folder")));
    }
    Ok(())
}

/// A path whose folder has neither links nor detours, so that all spellings of one path are alike. A new file
/// takes the place of a link and not of what it leads to, so the last part is left as it is.
pub(crate) fn place(path: &Path) -> PathBuf {
    match (fs::canonicalize(folder_of(path)), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}

/// The [`place`] that a path leads to if it is opened: where the last of its links ends, whether there is a
/// file or not.
pub(crate) fn opened_place(path: &Path) -> PathBuf {
    /// Systems follow no more links than this.
    const LINKS: usize = 40;
    let mut found = place(path);
    for _ in 0..LINKS {
        let Ok(next) = fs::read_link(&found) else { break };
        found = place(&folder_of(&found).join(next));
    }
    found
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
        Target::new(path.into()).unwrap()
    }

    #[test]
    fn the_ending_decides() {
        assert_eq!(target(Path::new("a/b.PNG")).kind, Kind::Png);
        for text in ["", "a", "a.txt", "csv", ".csv", "a.csv.gz", "a.csv/..", "/"] {
            let error = Target::new(text.into()).unwrap_err();
            assert!(error.contains(".csv, .json, .png or .svg"), "{text}: {error}");
        }
    }

    #[test]
    fn a_file_is_replaced_only_if_that_is_meant_and_nothing_else_is_left() {
        let folder = folder("files");
        let target = target(&folder.join("a.csv"));
        target.check(false).unwrap();
        target.write(false, |to| to.write_all(b"one")).unwrap();
        let refused = target.check(false).unwrap_err();
        assert!(matches!(&refused, Failure::Usage(text) if text.contains("--force")), "{refused:?}");
        // Also if it appeared while the result was computed.
        assert!(matches!(target.write(false, |to| to.write_all(b"two")), Err(Failure::Failed(_))));
        assert_eq!(fs::read(&target.path).unwrap(), b"one");
        target.check(true).unwrap();
        target.write(true, |to| to.write_all(b"three")).unwrap();
        assert_eq!(fs::read(&target.path).unwrap(), b"three");
        // Content that ends with an error leaves what was there.
        let torn = target.write(true, |to| {
            to.write_all(&[b'x'; 2 * GATHERED])?;
            Err(io::Error::other("no more"))
        });
        assert!(matches!(torn, Err(Failure::Failed(text)) if text.contains("no more")));
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
        assert!(matches!(taken.write(true, |to| to.write_all(b"x")), Err(Failure::Failed(_))));
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn what_names_a_folder_is_no_file() {
        let folder = folder("names");
        for name in ["a.csv/", "a.csv//", "a.csv/."] {
            let refused = target(&folder.join(name)).check(true).unwrap_err();
            assert!(
                matches!(&refused, Failure::Usage(text) if text.contains("name of a folder")),
                "{name}: {refused:?}"
            );
        }
        fs::remove_dir_all(&folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_file_has_one_place_however_it_is_spelled() {
        use std::os::unix::fs::symlink;

        let folder = folder("spelled");
        fs::create_dir(folder.join("inner")).unwrap();
        symlink("inner", folder.join("other")).unwrap();
        symlink("inner/a.csv", folder.join("link.csv")).unwrap();
        symlink("link.csv", folder.join("far.csv")).unwrap();
        symlink("round.csv", folder.join("round.csv")).unwrap();
        let at = |name: &str| place(&folder.join(name));
        let expected = at("inner/a.csv");
        for name in ["./inner/a.csv", "inner/../inner/a.csv", "other/a.csv", "inner//a.csv"] {
            assert_eq!(at(name), expected, "{name}");
        }
        // A link is replaced and not what it leads to; what is opened is that.
        assert_ne!(at("link.csv"), expected);
        for name in ["link.csv", "far.csv", "other/a.csv", "inner/a.csv"] {
            assert_eq!(opened_place(&folder.join(name)), expected, "{name}");
        }
        // Links in a circle lead nowhere, and looking for their end has one.
        assert_eq!(opened_place(&folder.join("round.csv")), at("round.csv"));
        fs::remove_dir_all(&folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_name_need_not_be_a_text() {
        use std::os::unix::ffi::OsStringExt as _;

        let folder = folder("bytes");
        let name = OsString::from_vec(b"\xff.csv".to_vec());
        let target = Target::new(folder.join(&name).into()).unwrap();
        assert_eq!(target.kind, Kind::Csv);
        // Some file systems have texts as names only.
        if target.check(false).is_ok() {
            target.write(false, |to| to.write_all(b"one")).unwrap();
            assert_eq!(fs::read(folder.join(&name)).unwrap(), b"one");
        }
        fs::remove_dir_all(&folder).unwrap();
    }
}
