//! Reads files that somebody else may have put in their place.

use std::fs::{self, File, FileType};
use std::io::{self, ErrorKind, Read as _};
use std::path::Path;

/// The content of a regular file, or of one that a symbolic link leads to, of at most `largest` bytes.
///
/// What kind of file it is, is asked before it is opened: to open a named pipe waits for a writer, and a device may never
/// end. Somebody who puts a pipe in its place between the two makes this wait; the standard library has no
/// portable way to open without waiting.
pub(super) fn read(path: &Path, largest: u64) -> Result<Vec<u8>, io::Error> {
    must_be_regular(fs::metadata(path)?.file_type())?;
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    must_be_regular(metadata.file_type())?;
    if metadata.len() > largest {
        return Err(too_large(metadata.len(), largest));
    }
    limited(file, largest)
}

/// All that a reader gives, if it is at most `largest` bytes.
pub(super) fn limited(reader: impl io::Read, largest: u64) -> Result<Vec<u8>, io::Error> {
    let mut bytes = Vec::new();
    // A file may grow while it is read, and some file systems state no length.
    reader.take(largest.saturating_add(1)).read_to_end(&mut bytes)?;
    match bytes.len() as u64 {
        length if length > largest => Err(too_large(length, largest)),
        _ => Ok(bytes),
    }
}

fn too_large(bytes: u64, largest: u64) -> io::Error {
    let text = format!("it has {bytes} bytes or more; legal are {largest} or fewer");
    io::Error::new(ErrorKind::FileTooLarge, text)
}

fn must_be_regular(kind: FileType) -> Result<(), io::Error> {
    if kind.is_file() {
        return Ok(());
    }
    let (kind, text) = if kind.is_dir() {
        (ErrorKind::IsADirectory, "it is a folder; legal is a regular file")
    } else {
        (ErrorKind::InvalidInput, "it is a pipe, socket or device; legal is a regular file")
    };
    Err(io::Error::new(kind, text))
}
