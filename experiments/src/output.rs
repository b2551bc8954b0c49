//! Writes files so that a killed run leaves none half written, and that runs in the same folder do not
//! disturb each other.
//!
//! Every file is written under another name and renamed. Whoever writes holds the [lock](OutputFolder::lock) of the folder
//! meanwhile, so that the files and the cache key of a figure are of one run, the common files describe what is
//! there, and a partial file that somebody finds while holding the lock is one of a run that was killed.

mod error;
mod lock;
mod partial;

use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{fs, io};

use bouncing_disk::regular_file;
use lock::Lock;
use partial::Partial;

use crate::Quality;
use crate::cache_key::{CacheKey, Stale};
pub use error::OutputError;

/// How long a run waits for others to finish writing: they take seconds, unless they are suspended.
const LONGEST_WAIT: Duration = Duration::from_secs(600);

/// The largest file that is read back (bytes): a hundred times that of any figure.
const LARGEST_FILE: u64 = 1 << 30;

/// A folder with the outputs of the experiments.
#[derive(Clone, Debug)]
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// Makes the folder if need be, makes sure that files can be written in it, and removes what killed runs
    /// have left.
    ///
    /// # Errors
    ///
    /// When it cannot be made or written in. Better now than after an hour of computing.
    pub fn create(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        let path = path.into();
        fs::create_dir_all(&path).map_err(|source| OutputError::Folder { path: path.clone(), source })?;
        let folder = Self { path };
        let lock = folder.lock()?;
        let probe = Partial::write(&folder.path, "probe", b"");
        drop(probe.map_err(|source| OutputError::Unwritable { path: folder.path.clone(), source })?);
        drop(lock);
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
    /// A thread that holds the lock must write by [`LockedFolder`]: the functions of this type would wait for
    /// it.
    ///
    /// # Errors
    ///
    /// When the folder cannot be opened, or another run has been writing in it for ten minutes.
    pub fn lock(&self) -> Result<LockedFolder<'_>, OutputError> {
        self.lock_within(LONGEST_WAIT)
    }

    fn lock_within(&self, longest: Duration) -> Result<LockedFolder<'_>, OutputError> {
        let path = || self.path.clone();
        let lock = lock::hold(&self.path, longest)
            .map_err(|source| OutputError::Unwritable { path: path(), source })?;
        if matches!(lock, Lock::Busy) {
            return Err(OutputError::Busy { path: path(), waited_s: longest.as_secs_f64() });
        }
        partial::remove_abandoned(&self.path, matches!(lock, Lock::Held { .. }));
        Ok(LockedFolder { folder: self, _lock: lock })
    }

    /// Writes a file as a whole: it is complete or not there at all, whenever the program ends.
    ///
    /// # Errors
    ///
    /// When the system refuses.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        self.lock()?.write(&[(name, bytes)])
    }

    /// The content of a file, or `None` when there is none.
    ///
    /// # Errors
    ///
    /// When it exists and cannot be read.
    pub fn read(&self, name: &str) -> Result<Option<Vec<u8>>, OutputError> {
        let path = self.path.join(name);
        match regular_file::read(&path, LARGEST_FILE) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(source) => Err(OutputError::Read { path, source }),
        }
    }

    /// Writes all files of one figure and its cache key, with the digest of the measurements in them. Files of an
    /// earlier run that are no longer made are removed.
    ///
    /// # Errors
    ///
    /// When the system refuses. If a file cannot be written, as on a full disk, the files of an earlier run
    /// are all still there; if one cannot get its name, there is no cache key.
    pub fn write_set(
        &self,
        id: &str,
        quality: Quality,
        measured: &str,
        run_time_s: f64,
        files: &[(String, Vec<u8>)],
    ) -> Result<(), OutputError> {
        let contents = || files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
        let cache_key = CacheKey::new(id, quality, measured, run_time_s, contents());
        let text = serde_json::to_vec_pretty(&cache_key)
            .map_err(|source| OutputError::CacheKey { id: id.to_owned(), source })?;
        let cache_key_name = cache_key_name(id);
        let locked = self.lock()?;
        let mut partials = Vec::new();
        // The cache key is the last one to get its name.
        for (name, bytes) in contents().chain([(cache_key_name.as_str(), text.as_slice())]) {
            partials.push(locked.partial(name, bytes)?);
        }
        // As long as the cache key of the earlier run lists them; a killed run would leave them for ever.
        for name in self.cache_key(id).iter().flat_map(CacheKey::names) {
            if is_of_figure(id, name) && !files.iter().any(|(kept, _)| kept == name) {
                locked.remove(name)?;
            }
        }
        locked.remove(&cache_key_name)?;
        partials.into_iter().try_for_each(publish)
    }

    /// The cache key of a figure.
    ///
    /// # Errors
    ///
    /// [`Stale::Missing`] when there is none or it cannot be read, [`Stale::Newer`] for that of a newer program.
    pub fn cache_key(&self, id: &str) -> Result<CacheKey, Stale> {
        let bytes = self.read(&cache_key_name(id)).ok().flatten().ok_or(Stale::Missing)?;
        CacheKey::read(id, &bytes)
    }

    /// Whether a figure is up to date; `measured` is the digest of the measurements there are for it.
    ///
    /// # Errors
    ///
    /// The first reason to make it again.
    pub fn check(&self, id: &str, quality: Quality, measured: &str) -> Result<(), Stale> {
        let cache_key = self.cache_key(id)?;
        cache_key.check(id, quality, measured, |name| self.read(name).ok().flatten())
    }
}

/// A folder in which no other run writes.
#[derive(Debug)]
pub struct LockedFolder<'a> {
    folder: &'a OutputFolder,
    _lock: Lock,
}

impl LockedFolder<'_> {
    /// Writes files as [`OutputFolder::write`] does; none gets its name before all are on the disk.
    ///
    /// # Errors
    ///
    /// When the system refuses.
    pub fn write(&self, files: &[(&str, &[u8])]) -> Result<(), OutputError> {
        let partials = files.iter().map(|(name, bytes)| self.partial(name, bytes));
        partials.collect::<Result<Vec<_>, _>>()?.into_iter().try_for_each(publish)
    }

    fn partial<'b>(&self, name: &str, bytes: &'b [u8]) -> Result<Partial<'b>, OutputError> {
        let path = self.folder.path();
        Partial::write(path, name, bytes)
            .map_err(|source| OutputError::Write { path: path.join(name), source })
    }

    fn remove(&self, name: &str) -> Result<(), OutputError> {
        let path = self.folder.path.join(name);
        match fs::remove_file(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => {
                Err(OutputError::Write { path, source })
            }
            _ => Ok(()),
        }
    }
}

fn publish(partial: Partial<'_>) -> Result<(), OutputError> {
    let path = partial.target().to_path_buf();
    partial.publish().map_err(|source| OutputError::Write { path, source })
}

fn cache_key_name(id: &str) -> String {
    format!("{id}.cache-key")
}

/// Whether a cache key may name this file. A cache key is a file like others: what it says must not remove anything
/// else.
fn is_of_figure(id: &str, name: &str) -> bool {
    let own = name.strip_prefix(id).is_some_and(|rest| rest.starts_with('.'));
    own && Path::new(name).file_name().is_some_and(|last| last == name)
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
        let old = [("demo.csv".to_owned(), b"of an earlier version".to_vec())];
        folder.write_set("demo", Quality::Draft, "", 0.1, &old).expect("writable");
        fs::write(folder.path().join("demo.txt"), b"of the user").expect("writable");
        fs::write(folder.path().join("demo2.json"), b"of another figure").expect("writable");
        let files = [("demo.json".to_owned(), b"{}".to_vec()), ("demo.svg".to_owned(), b"<svg/>".to_vec())];
        folder.write_set("demo", Quality::Draft, "", 0.1, &files).expect("writable");
        assert_eq!(names(&folder), ["demo.cache-key", "demo.json", "demo.svg", "demo.txt", "demo2.json"]);
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
    fn writers_of_one_folder_wait_for_each_other() {
        let folder = folder("lock");
        let held = folder.lock().expect("free");
        let error = folder.lock_within(Duration::from_millis(20)).expect_err("held");
        assert!(error.to_string().ends_with("for 0.02 s; it may be suspended"), "{error}");
        // A partial file of who holds the lock is no leftover.
        let partial = held.partial("a", b"1").expect("writable");
        assert!(folder.lock_within(Duration::ZERO).is_err());
        publish(partial).expect("still there");
        std::thread::scope(|scope| {
            let waiting = scope.spawn(|| folder.write("b", b"2"));
            drop(held);
            waiting.join().expect("no panic").expect("its turn");
        });
        assert_eq!(names(&folder), ["a", "b"]);
        fs::remove_dir_all(folder.path()).expect("removable");
    }

    #[test]
    fn a_set_that_cannot_be_written_leaves_the_earlier_one() {
        let folder = folder("refused");
        let set = |bytes: &[u8], last: &str| {
            let files = [("demo.json".to_owned(), bytes.to_vec()), (last.to_owned(), bytes.to_vec())];
            folder.write_set("demo", Quality::Draft, "", 0.1, &files)
        };
        set(b"old", "demo.svg").expect("writable");
        // No folder of that name: as on a full disk, what comes after the first file is refused.
        set(b"new", "none/demo.svg").expect_err("refused");
        assert_eq!(folder.check("demo", Quality::Draft, ""), Ok(()));
        assert_eq!(folder.read("demo.json").expect("readable").as_deref(), Some(b"old".as_slice()));
        assert_eq!(names(&folder), ["demo.cache-key", "demo.json", "demo.svg"]);
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
