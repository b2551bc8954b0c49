//! Files that are not complete yet.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, SystemTime};

/// A partial file of this age is abandoned, whoever wrote it: its content is complete in memory before it is
/// begun.
const ABANDONED: Duration = Duration::from_secs(3600);

/// How often a partial file is written again that somebody has removed.
const REPETITIONS: u32 = 3;

/// Tells partial files of one process apart.
static COUNT: AtomicU32 = AtomicU32::new(0);

/// A complete file on the disk under another name than its own. It is removed unless it gets its name.
#[derive(Debug)]
pub(super) struct Partial<'a> {
    /// In the folder of the target, because a file can be renamed only within a file system.
    path: PathBuf,
    target: PathBuf,
    bytes: &'a [u8],
}

impl<'a> Partial<'a> {
    /// Writes `bytes`, to be called `name` later.
    pub(super) fn write(folder: &Path, name: &str, bytes: &'a [u8]) -> io::Result<Self> {
        loop {
            let count = COUNT.fetch_add(1, Ordering::Relaxed);
            let path = folder.join(format!(".{name}.{}.{count}.partial", std::process::id()));
            // A process of another machine or container may have the same number.
            match File::create_new(&path) {
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
                Ok(file) => {
                    let partial = Self { path, target: folder.join(name), bytes };
                    partial.fill(file)?;
                    return Ok(partial);
                }
            }
        }
    }

    fn fill(&self, mut file: File) -> io::Result<()> {
        file.write_all(self.bytes)?;
        // The name must not become visible before the content is on the disk.
        file.sync_all()
    }

    /// Gives it its name.
    pub(super) fn publish(self) -> io::Result<()> {
        let mut renamed = fs::rename(&self.path, &self.target);
        // A run that this one cannot lock out, on another machine, may have taken it for abandoned.
        for _ in 0..REPETITIONS {
            if renamed.as_ref().is_err_and(|error| error.kind() == ErrorKind::NotFound) {
                self.fill(File::create(&self.path)?)?;
                renamed = fs::rename(&self.path, &self.target);
            }
        }
        renamed
    }

    /// What it will be called.
    pub(super) fn target(&self) -> &Path {
        &self.target
    }
}

impl Drop for Partial<'_> {
    fn drop(&mut self) {
        // It is gone when it has its name. Nothing can be done about another error; the next run tries again.
        let _ = fs::remove_file(&self.path);
    }
}

/// Removes the partial files of runs that were killed: all of them where nobody else can be writing, the old
/// ones elsewhere.
///
/// One that cannot be removed harms nothing, so that it stops nothing.
pub(super) fn remove_abandoned(folder: &Path, alone: bool) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if entry.file_name().to_str().is_some_and(is_partial) && (alone || is_old(&entry)) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// `.NAME.NUMBER.partial`, and `.probe.NUMBER` of earlier versions: what nobody else writes.
fn is_partial(name: &str) -> bool {
    let number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    if let Some(process) = name.strip_prefix(".probe.")
        && number(process)
    {
        return true;
    }
    let middle = name.strip_prefix('.').and_then(|rest| rest.strip_suffix(".partial"));
    middle.and_then(|middle| middle.rsplit_once('.')).is_some_and(|(_, last)| number(last))
}

fn is_old(entry: &fs::DirEntry) -> bool {
    let modified = entry.metadata().and_then(|metadata| metadata.modified());
    // A time in the future says nothing.
    modified.is_ok_and(|time| SystemTime::now().duration_since(time).is_ok_and(|age| age >= ABANDONED))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("bouncing-disk-partial-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("writable");
        path
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("readable");
        let mut names: Vec<_> = entries
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn only_our_own_names_are_taken_for_partial_files() {
        for name in
            [".claims.json.17.partial", ".claims.json.17.0.partial", ".fig06.svg.9.partial", ".probe.17"]
        {
            assert!(is_partial(name), "{name}");
        }
        for name in
            ["claims.json", ".partial", ".mine.partial", "fig06.1.partial", ".probe.me", ".probe.", ".1"]
        {
            assert!(!is_partial(name), "{name}");
        }
    }

    #[test]
    fn what_is_not_published_is_removed_and_what_was_removed_is_written_again() {
        let folder = folder("drop");
        let partial = Partial::write(&folder, "a", b"1").expect("writable");
        assert_ne!(names(&folder), ["a"]);
        drop(partial);
        assert!(names(&folder).is_empty());
        let partial = Partial::write(&folder, "a", b"1").expect("writable");
        remove_abandoned(&folder, true);
        assert!(names(&folder).is_empty());
        partial.publish().expect("written again");
        assert_eq!(names(&folder), ["a"]);
        fs::remove_dir_all(folder).expect("removable");
    }

    #[test]
    fn without_locks_only_old_partial_files_are_removed() {
        let folder = folder("age");
        for (name, age) in [(".a.1.partial", 2 * ABANDONED), (".b.1.partial", Duration::ZERO)] {
            let file = File::create(folder.join(name)).expect("writable");
            file.set_modified(SystemTime::now() - age).expect("writable");
        }
        remove_abandoned(&folder, false);
        assert_eq!(names(&folder), [".b.1.partial"]);
        remove_abandoned(&folder, true);
        assert!(names(&folder).is_empty());
        fs::remove_dir_all(folder).expect("removable");
    }
}
