//! Writes files so that a killed run leaves none half written, and that runs in the same folder do not
//! disturb each other.
//!
//! Every file is written under another name and renamed. Whoever writes holds the [lock](OutputFolder::lock)
//! of the folder meanwhile, so that the files and the cache key of a figure are of one run, the common files
//! describe what is there, and a partial file that somebody finds while holding the lock is one of a run that
//! was killed.

use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use bouncing_disk::regular_file;
use tempfile::{Builder, NamedTempFile};

use crate::Quality;
use crate::cache_key::{CacheKey, Stale};
use crate::visible::visible_path;

/// The largest file that is read back (bytes): a hundred times that of any figure.
const LARGEST_FILE: u64 = 1 << 30;
/// The beginning of the names of incomplete files.
const PARTIAL: &str = ".bouncing-disk-partial-";

/// An operation that the system refuses.
#[derive(Debug, thiserror::Error)]
#[error("cannot {action} {}", visible_path(path))]
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
    /// Makes the folder if need be, makes sure that files can be written in it, and removes what killed runs
    /// have left.
    pub fn create(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        let path = path.into();
        fs::create_dir_all(&path).map_err(OutputError::of("make the output folder", &path))?;
        let folder = Self { path };
        let locked = folder.lock()?;
        let probe = locked.partial(&folder.path.join("probe"), b"");
        drop(probe.map_err(OutputError::of("write in the output folder", folder.path()))?);
        drop(locked);
        Ok(folder)
    }

    /// A folder that is only read; it need not exist.
    pub fn existing(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// The path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Waits until no other run writes in the folder and keeps them out until the result is dropped.
    ///
    /// The lock is on the folder itself, where the system can lock one: nothing is left behind, and it ends
    /// with the process. Every writer opens the folder anew, so that threads of one process wait for each
    /// other, too: a thread that holds the lock must write by [`LockedFolder`].
    pub fn lock(&self) -> Result<LockedFolder<'_>, OutputError> {
        let file = open(&self.path).map_err(OutputError::of("write in the output folder", &self.path))?;
        // A file system may have no locks; what others are writing there must stay.
        if file.lock().is_ok() {
            for entry in fs::read_dir(&self.path).into_iter().flatten().flatten() {
                if entry.file_name().to_string_lossy().starts_with(PARTIAL) {
                    // One that cannot be removed harms nothing.
                    let _ = fs::remove_file(entry.path());
                }
            }
        }
        Ok(LockedFolder { folder: self, _lock: file })
    }

    /// Writes a file as a whole: it is complete or not there at all, whenever the program ends.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        self.write_all(&[(name, bytes)])
    }

    /// Writes several files; none gets its name before all are on the disk.
    pub fn write_all(&self, files: &[(&str, &[u8])]) -> Result<(), OutputError> {
        self.lock()?.write(files)
    }

    /// The content of a file, or `None` when there is none.
    pub fn read(&self, name: &str) -> Result<Option<Vec<u8>>, OutputError> {
        let path = self.path.join(name);
        match regular_file::read(&path, LARGEST_FILE) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(OutputError::of("read", path)(error)),
        }
    }

    /// Writes all files of one figure and its cache key, with the digest of the measurements in them. Files
    /// of an earlier run that are no longer made are removed.
    pub fn write_set(
        &self,
        id: &str,
        quality: Quality,
        measured: &str,
        run_time_s: f64,
        files: &[(String, Vec<u8>)],
    ) -> Result<(), OutputError> {
        let mut contents: Vec<_> =
            files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
        let cache_key = CacheKey::new(id, quality, measured, run_time_s, &contents).to_text();
        let cache_key_name = cache_key_name(id);
        // The last one to get its name.
        contents.push((&cache_key_name, cache_key.as_bytes()));
        let locked = self.lock()?;
        let partials = locked.partials(&contents)?;
        // As long as the cache key of the earlier run lists them; a killed run would leave them for ever.
        for name in self.cache_key(id).iter().flat_map(CacheKey::names) {
            if is_of_figure(id, name) && !files.iter().any(|(kept, _)| kept == name) {
                locked.remove(name)?;
            }
        }
        locked.remove(&cache_key_name)?;
        locked.publish(partials)
    }

    /// The cache key of a figure.
    pub fn cache_key(&self, id: &str) -> Result<CacheKey, Stale> {
        let bytes = self.read(&cache_key_name(id)).ok().flatten().ok_or(Stale::Missing)?;
        CacheKey::read(id, &bytes)
    }

    /// Whether a figure is up to date; `measured` is the digest of the measurements there are for it.
    pub fn check(&self, id: &str, quality: Quality, measured: &str) -> Result<(), Stale> {
        let cache_key = self.cache_key(id)?;
        cache_key.check(id, quality, measured, |name| self.read(name).ok().flatten())
    }
}

#[cfg(unix)]
fn open(folder: &Path) -> io::Result<File> {
    File::open(folder)
}

/// Elsewhere a folder cannot be opened as a file. The file stays: to remove it would let two runs lock
/// different ones.
#[cfg(not(unix))]
fn open(folder: &Path) -> io::Result<File> {
    File::options().create(true).truncate(false).write(true).open(folder.join(".lock"))
}

/// A folder in which no other run writes.
#[derive(Debug)]
pub struct LockedFolder<'a> {
    folder: &'a OutputFolder,
    /// The system keeps the lock as long as this is open.
    _lock: File,
}

impl LockedFolder<'_> {
    /// Writes files as [`OutputFolder::write`] does; none gets its name before all are on the disk.
    pub fn write(&self, files: &[(&str, &[u8])]) -> Result<(), OutputError> {
        self.publish(self.partials(files)?)
    }

    /// The complete files on the disk, under other names than their own, which is where each belongs. They
    /// are removed unless they get their names.
    fn partials(&self, files: &[(&str, &[u8])]) -> Result<Vec<(PathBuf, NamedTempFile)>, OutputError> {
        let partial = |(name, bytes): &(&str, &[u8])| {
            let path = self.folder.path.join(name);
            match self.partial(&path, bytes) {
                Ok(partial) => Ok((path, partial)),
                Err(error) => Err(OutputError::of("write", path)(error)),
            }
        };
        files.iter().map(partial).collect()
    }

    /// In the folder of the target, because a file can be renamed only within a file system.
    fn partial(&self, target: &Path, bytes: &[u8]) -> io::Result<NamedTempFile> {
        let mut builder = Builder::new();
        // As any new file has them, and not for the owner alone.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = builder.prefix(PARTIAL).tempfile_in(target.parent().unwrap_or(&self.folder.path))?;
        file.write_all(bytes)?;
        // The name must not become visible before the content is on the disk.
        file.as_file().sync_all()?;
        Ok(file)
    }

    fn publish(&self, partials: Vec<(PathBuf, NamedTempFile)>) -> Result<(), OutputError> {
        partials.into_iter().try_for_each(|(path, partial)| match partial.persist(&path) {
            Ok(_) => Ok(()),
            Err(error) => Err(OutputError::of("write", path)(error.error)),
        })
    }

    fn remove(&self, name: &str) -> Result<(), OutputError> {
        let path = self.folder.path.join(name);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(OutputError::of("write", path)(error))
            }
            _ => Ok(()),
        }
    }
}

fn cache_key_name(id: &str) -> String {
    format!("{id}.cache-key")
}

/// Whether a cache key may name this file. A cache key is a file like others: its text must not remove
/// anything else.
fn is_of_figure(id: &str, name: &str) -> bool {
    let own = name.strip_prefix(id).is_some_and(|rest| rest.starts_with('.'));
    own && Path::new(name).file_name().is_some_and(|last| last == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &OutputFolder) -> Vec<String> {
        let entries = fs::read_dir(folder.path()).expect("readable");
        let mut names: Vec<_> = entries
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_set_is_up_to_date_until_something_changes_and_stays_whole() {
        let scratch = tempfile::tempdir().expect("writable");
        let folder = OutputFolder::create(scratch.path()).expect("writable");
        let check = || folder.check("demo", Quality::Draft, "");
        let write = |files: &[(&str, &[u8])]| {
            let files: Vec<_> =
                files.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec())).collect();
            folder.write_set("demo", Quality::Draft, "", 0.1, &files)
        };
        assert_eq!(check(), Err(Stale::Missing));
        fs::write(scratch.path().join(format!("{PARTIAL}17")), b"torn").expect("writable");
        write(&[("demo.csv", b"of an earlier version")]).expect("writable");
        for name in ["demo.txt", "demo2.json"] {
            fs::write(scratch.path().join(name), b"of the user").expect("writable");
        }
        write(&[("demo.json", b"{}"), ("demo.svg", b"<svg/>")]).expect("writable");
        let all = ["demo.cache-key", "demo.json", "demo.svg", "demo.txt", "demo2.json"];
        assert_eq!((names(&folder), check()), (all.map(str::to_owned).to_vec(), Ok(())));
        // No folder of that name: as on a full disk, what comes after the first file is refused.
        write(&[("demo.json", b"new"), ("none/demo.svg", b"new")]).expect_err("refused");
        assert_eq!((names(&folder), check()), (all.map(str::to_owned).to_vec(), Ok(())));
        fs::write(scratch.path().join("demo.svg"), b"edited").expect("writable");
        assert_eq!(check(), Err(Stale::File { name: "demo.svg".to_owned() }));
    }

    #[test]
    fn writers_of_one_folder_wait_for_each_other_and_replace_whole_files() {
        let scratch = tempfile::tempdir().expect("writable");
        let folder = OutputFolder::create(scratch.path()).expect("writable");
        folder.write("a", b"a long first content").expect("writable");
        let held = folder.lock().expect("free");
        std::thread::scope(|scope| {
            let waiting = scope.spawn(|| folder.write("b", b"2"));
            std::thread::sleep(std::time::Duration::from_millis(20));
            assert!(!waiting.is_finished());
            held.write(&[("a", b"1")]).expect("writable");
            drop(held);
            waiting.join().expect("no panic").expect("its turn");
        });
        assert_eq!(names(&folder), ["a", "b"]);
        assert_eq!(folder.read("a").expect("readable").as_deref(), Some(b"1".as_slice()));
        assert!(folder.read("c").expect("absent is no error").is_none());
        let error = OutputFolder::create(scratch.path().join("a/figures")).expect_err("a file is no folder");
        assert!(error.to_string().contains("a/figures"), "{error}");
    }
}
