//! Reads files that another program may have replaced.

use std::fs::{self, File, FileType};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Not a regular file. Opening a named pipe waits for a writer, and reading a device may never end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("it is {found}, not a regular file")]
pub struct NotRegular {
    /// Its kind.
    pub found: &'static str,
}

/// A file is too large to read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("it has {bytes} bytes; at most {largest} are read")]
pub struct TooLarge {
    /// Its length, if known.
    pub bytes: u64,
    /// The largest length that is read.
    pub largest: u64,
}

/// The content of a regular file, also through a symbolic link, of at most `largest` bytes.
///
/// The kind of file is checked before opening. If somebody replaces the file by a pipe in between, the call
/// waits; the standard library has no portable way to open without waiting.
///
/// # Errors
///
/// Errors of the operating system, which contain [`NotRegular`] or [`TooLarge`] if the file is one of these.
pub fn read(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    must_be_regular(fs::metadata(path)?.file_type())?;
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    must_be_regular(metadata.file_type())?;
    if metadata.len() > largest {
        return Err(too_large(metadata.len(), largest));
    }
    limited(file, largest)
}

/// The whole content of a reader if it is at most `largest` bytes.
///
/// # Errors
///
/// Errors of the reader, which contain [`TooLarge`] if it returns more.
pub fn limited(reader: impl Read, largest: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // A file may grow while it is read, and some file systems state no length.
    reader.take(largest.saturating_add(1)).read_to_end(&mut bytes)?;
    match bytes.len() as u64 {
        length if length > largest => Err(too_large(length, largest)),
        _ => Ok(bytes),
    }
}

fn too_large(bytes: u64, largest: u64) -> io::Error {
    io::Error::new(ErrorKind::FileTooLarge, TooLarge { bytes, largest })
}

fn must_be_regular(kind: FileType) -> io::Result<()> {
    if kind.is_file() {
        return Ok(());
    }
    let (kind_of_error, found) = if kind.is_dir() {
        (ErrorKind::IsADirectory, "a folder")
    } else {
        (ErrorKind::InvalidInput, special(kind))
    };
    Err(io::Error::new(kind_of_error, NotRegular { found }))
}

#[cfg(unix)]
fn special(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt as _;
    if kind.is_fifo() {
        "a named pipe"
    } else if kind.is_socket() {
        "a socket"
    } else {
        "a device"
    }
}

#[cfg(not(unix))]
fn special(_: FileType) -> &'static str {
    "a pipe, socket or device"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_within_the_limit_are_read() {
        let path = std::env::temp_dir().join(format!("bouncing-disk-regular-{}", std::process::id()));
        fs::create_dir_all(&path).expect("writable");
        let file = path.join("file");
        fs::write(&file, b"1234").expect("writable");
        assert_eq!(read(&file, 4).expect("regular"), b"1234");
        let error = read(&file, 3).expect_err("too large");
        assert_eq!(error.to_string(), "it has 4 bytes; at most 3 are read");
        let error = read(&path, 4).expect_err("a folder");
        assert_eq!(error.to_string(), "it is a folder, not a regular file");
        assert_eq!(read(&path.join("none"), 4).expect_err("absent").kind(), ErrorKind::NotFound);
        fs::remove_dir_all(path).expect("removable");
    }

    #[test]
    fn a_reader_is_read_up_to_the_limit() {
        assert_eq!(limited(b"1234".as_slice(), 4).expect("not too large"), b"1234");
        assert_eq!(limited(io::empty(), 0).expect("not too large"), b"");
        let error = limited(io::repeat(0), 4).expect_err("never ends");
        let found = error.get_ref().and_then(|inner| inner.downcast_ref());
        assert_eq!(found, Some(&TooLarge { bytes: 5, largest: 4 }));
        assert_eq!(error.kind(), ErrorKind::FileTooLarge);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_followed_to_what_it_names() {
        use std::os::unix::fs::symlink;
        let path = std::env::temp_dir().join(format!("bouncing-disk-links-{}", std::process::id()));
        fs::create_dir_all(&path).expect("writable");
        fs::write(path.join("file"), b"1").expect("writable");
        symlink("file", path.join("link")).expect("writable");
        assert_eq!(read(&path.join("link"), 9).expect("a link to a file"), b"1");
        symlink("nowhere", path.join("dangling")).expect("writable");
        assert_eq!(read(&path.join("dangling"), 9).expect_err("dangles").kind(), ErrorKind::NotFound);
        symlink("/dev/zero", path.join("endless")).expect("writable");
        let error = read(&path.join("endless"), 9).expect_err("never ends");
        assert_eq!(error.to_string(), "it is a device, not a regular file");
        // The socket creates this file itself; a pipe needs an external program (xtask/tests/files.rs).
        let _socket = std::os::unix::net::UnixListener::bind(path.join("socket")).expect("writable");
        let error = read(&path.join("socket"), 9).expect_err("a socket");
        assert_eq!(error.to_string(), "it is a socket, not a regular file");
        fs::remove_dir_all(path).expect("removable");
    }
}
