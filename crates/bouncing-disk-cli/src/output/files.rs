//! Files of results: their kinds, their places, and how they appear as a whole or not at all.

use std::ffi::OsString;
use std::fmt::{self, Display, Formatter};
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use clap::builder::{OsStringValueParser, TypedValueParser as _};
use clap::{Args, ValueEnum};
use tempfile::NamedTempFile;

use crate::failure::{Failure, Result};
use crate::lines::{complain, say};

/// Where the result goes.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Result")]
pub(crate) struct OutputArgs {
    /// Writes the result to a file instead of the terminal, in the form of its ending: .csv, .json, .png or .svg
    /// (.toml with --template). May be repeated
    // File names need not be valid text.
    #[arg(long, short, value_name = "FILE", value_parser = OsStringValueParser::new().try_map(Target::new))]
    pub(crate) out: Vec<Target>,
    /// Replaces existing files
    #[arg(long)]
    pub(crate) force: bool,
}

impl OutputArgs {
    /// Checks before the computation, as far as possible, that the files can be written. None of them may
    /// be an input or the journal.
    pub(crate) fn check(&self, has_picture: bool, inputs: &[&Path], journal: Option<&Path>) -> Result<()> {
        let others = inputs.iter().map(|path| (*path, "an input"));
        let others = others.chain(journal.map(|path| (path, "the journal")));
        let mut taken: Vec<(PathBuf, String)> = others
            .map(|(path, what)| (opened_place(path), format!("it cannot be both {what} and the result")))
            .collect();
        for target in &self.out {
            let place = place(&target.path);
            if let Some((_, why)) = taken.iter().find(|(other, _)| *other == place) {
                return Err(Failure::Usage(format!("{target}: {why}")));
            }
            taken.push((place, format!("it is requested twice, first as {target}")));
            match target.kind {
                Kind::Toml | Kind::Fmu => return Err(Failure::Usage(format!("{target}: {NO_RESULT}"))),
                Kind::Png | Kind::Svg if !has_picture => {
                    return Err(Failure::Usage(format!("{target}: {NO_PICTURE}")));
                }
                _ => target.check(self.force)?,
            }
        }
        Ok(())
    }

    /// Writes a file of parameters to the terminal or to --out.
    pub(crate) fn write_template(&self, text: &str, quiet: bool) -> Result<()> {
        match &self.out[..] {
            [] => Ok(say(text)?),
            [target] if target.kind == Kind::Toml => {
                target.check(self.force)?;
                target.write(self.force, quiet, |to| to.write_all(text.as_bytes()))
            }
            _ => Err(Failure::Usage(
                "--template writes TOML: give one --out FILE.toml, or none for the terminal".to_owned(),
            )),
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    Csv,
    Json,
    Png,
    Svg,
    /// Parameters, written by --template.
    Toml,
    /// A functional mock-up unit, written by `motor fmu`.
    Fmu,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) path: PathBuf,
    pub(crate) kind: Kind,
}

impl Display for Target {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())
    }
}

/// Bytes collected before each write.
const GATHERED: usize = 1 << 16;

impl Target {
    fn new(name: OsString) -> Result<Self, String> {
        let path = PathBuf::from(name);
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        match Kind::from_str(&ending, true) {
            Ok(kind) => Ok(Self { path, kind }),
            Err(_) => Err(
                "the file must end in .csv, .json, .png or .svg (.toml with --template, .fmu with motor fmu)"
                    .to_owned(),
            ),
        }
    }

    /// Checks, as far as possible without writing, that it can be written: better now than after an hour of
    /// computing.
    pub(crate) fn check(&self, replace: bool) -> Result<()> {
        check_place(&self.path).map_err(Failure::Usage)?;
        if !replace && fs::symlink_metadata(&self.path).is_ok() {
            return Err(Failure::Usage(format!("{self}: it exists already; --force replaces it")));
        }
        // Also finds a folder that cannot be written to.
        begin(&self.path).map(drop).map_err(|error| self.unwritable(&error))
    }

    /// Writes the file as a whole or not at all, and reports it unless `quiet`; `content` writes
    /// to a buffered writer.
    pub(crate) fn write(
        &self,
        replace: bool,
        quiet: bool,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<()> {
        self.fill(replace, quiet, |file| {
            let mut writer = BufWriter::with_capacity(GATHERED, file.as_file_mut());
            content(&mut writer)?;
            writer.flush()
        })
    }

    /// The same for content that is written into the file itself, which gets its name afterwards.
    pub(crate) fn fill(
        &self,
        replace: bool,
        quiet: bool,
        content: impl FnOnce(&mut NamedTempFile) -> io::Result<()>,
    ) -> Result<()> {
        let write = || {
            let mut file = begin(&self.path)?;
            content(&mut file)?;
            file.as_file().sync_all()?;
            if replace { file.persist(&self.path) } else { file.persist_noclobber(&self.path) }?;
            Ok(())
        };
        write().map_err(|error: io::Error| self.unwritable(&error))?;
        if !quiet {
            complain(&format!("wrote {self}"));
        }
        Ok(())
    }

    fn unwritable(&self, error: &io::Error) -> Failure {
        Failure::Failed(format!("{self} cannot be written: {error}"))
    }
}

/// Why a result cannot be a file of parameters, and why there is no picture.
pub(super) const NO_RESULT: &str =
    "a result ends in .csv, .json, .png or .svg; .toml needs --template, .fmu needs motor fmu";
pub(super) const NO_PICTURE: &str = "this command has no picture; use .csv or .json";

/// A new file in the folder of the target, because a file can be renamed only within a file system. It
/// is removed unless it is renamed.
fn begin(path: &Path) -> io::Result<NamedTempFile> {
    let mut hidden = OsString::from(".");
    hidden.push(path.file_name().unwrap_or_default());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&hidden).suffix(".partial");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // Permissions of a new file, reduced by the user's mask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    // The error of `tempfile` names the partial file.
    builder.tempfile_in(folder_of(path)).map_err(|error| io::Error::from(error.kind()))
}

/// Checks that a path can be a file: it names one in an existing folder, and is not a folder itself.
pub(crate) fn check_place(path: &Path) -> Result<(), String> {
    let refused = |why: &str| Err(format!("{}: {why}", path.display()));
    let folder = folder_of(path);
    // `a.csv/` and `a.csv/.` have the same last part, and yet name a folder.
    let bytes = path.as_os_str().as_encoded_bytes();
    match path.file_name() {
        Some(name) if bytes.ends_with(name.as_encoded_bytes()) => {}
        _ => return refused("this names a folder, not a file"),
    }
    if !folder.is_dir() {
        return refused(&format!("the folder {} does not exist; create it first", folder.display()));
    }
    if path.is_dir() { refused("it is a folder") } else { Ok(()) }
}

/// A path whose folder has no links or detours, so that all spellings of one path agree. A new file replaces
/// a link, not its target, so the last part stays as it is.
fn place(path: &Path) -> PathBuf {
    match (fs::canonicalize(folder_of(path)), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}

/// The [`place`] that a path leads to if it is opened: where the last of its links ends, if there is a file.
fn opened_place(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| place(path))
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tests of the program cannot see this: the file appears, or fails, while the result is computed.
    #[test]
    fn a_file_is_there_as_a_whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let target = Target::new(folder.path().join("a.csv").into()).unwrap();
        let write =
            |replace: bool, text: &str| target.write(replace, true, |to| to.write_all(text.as_bytes()));
        target.check(false).unwrap();
        write(false, "one").unwrap();
        assert!(matches!(write(false, "two"), Err(Failure::Failed(_))));
        assert_eq!(fs::read(&target.path).unwrap(), b"one");
        write(true, "three").unwrap();
        let torn = target.write(true, true, |to| {
            to.write_all(&[b'x'; 2 * GATHERED])?;
            Err(io::Error::other("no more"))
        });
        assert!(matches!(torn, Err(Failure::Failed(text)) if text.contains("no more")));
        assert_eq!(fs::read(&target.path).unwrap(), b"three");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            let own = folder.path().join("own");
            fs::write(&own, "").unwrap();
            let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
            assert_eq!(mode(&target.path), mode(&own));
        }
    }
}
