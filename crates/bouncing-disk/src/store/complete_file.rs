//! Files that are there as a whole, or not at all.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use crate::store::error::StorageError;

/// Tells partial files of one process apart.
static COUNT: AtomicU32 = AtomicU32::new(0);

/// Writes a file so that nobody ever sees a part of it: under another name in the same folder, from which it gets its own
/// one when it is complete and on the disk. What had the name before is replaced; it stays when this fails.
///
/// # Errors
/// [`StorageError::Io`] if the system refuses.
pub(crate) fn write_complete(path: &Path, bytes: &[u8]) -> Result<(), StorageError> {
    let failed = |source| StorageError::Io { action: "write", path: path.to_owned(), source };
    let (partial, file) = begin(path).map_err(failed)?;
    let outcome = fill(file, bytes).and_then(|()| fs::rename(&partial, path));
    outcome.map_err(|source| {
        // Nothing can be done about another error; what is left harms nothing.
        let _ = fs::remove_file(&partial);
        failed(source)
    })
}

/// A new file in the folder of the target, because a file can be renamed only within a file system.
fn begin(path: &Path) -> io::Result<(PathBuf, File)> {
    let name =
        path.file_name().ok_or_else(|| io::Error::new(ErrorKind::InvalidInput, "it has no file name"))?;
    loop {
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}.{count}.partial", std::process::id()));
        let partial = path.with_file_name(hidden);
        // A process of another machine or container may have the same number.
        match File::create_new(&partial) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            other => return other.map(|file| (partial, file)),
        }
    }
}

fn fill(mut file: File, bytes: &[u8]) -> io::Result<()> {
    file.write_all(bytes)?;
    // The name must not become visible before the content is on the disk.
    file.sync_all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_as_a_whole_and_nothing_else_is_left() {
        let folder = std::env::temp_dir().join(format!("bouncing-disk-complete-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("writable");
        let path = folder.join("a.csv");
        for content in [b"one".as_slice(), b"", b"another"] {
            write_complete(&path, content).expect("writable");
            assert_eq!(fs::read(&path).expect("readable"), content);
        }
        // A folder cannot be replaced by a file: an error, and what was written is gone.
        let taken = folder.join("folder");
        fs::create_dir_all(taken.join("inside")).expect("writable");
        for path in [taken, folder.join("missing").join("a"), PathBuf::from("..")] {
            let error = write_complete(&path, b"x").expect_err("refused");
            assert!(matches!(error, StorageError::Io { action: "write", .. }), "{error}");
        }
        let mut names: Vec<_> = fs::read_dir(&folder)
            .expect("readable")
            .map(|entry| entry.expect("readable").file_name())
            .collect();
        names.sort();
        assert_eq!(names, ["a.csv", "folder"]);
        fs::remove_dir_all(&folder).expect("removable");
    }
}
