//! Why the output folder cannot be used.

use std::io;
use std::path::PathBuf;

use crate::visible::visible_path;

/// Why the output folder cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The folder cannot be made.
    #[error("cannot make the output folder {}", visible_path(path))]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system reported.
        source: io::Error,
    },
    /// The folder exists, but nothing can be written in it.
    #[error("cannot write in the output folder {}", visible_path(path))]
    Unwritable {
        /// The folder.
        path: PathBuf,
        /// What the system reported.
        source: io::Error,
    },
    /// Another run has been writing in the folder all the time.
    #[error(
        "another run has been writing in the output folder {} for {waited_s} s; it may be suspended",
        visible_path(path)
    )]
    Busy {
        /// The folder.
        path: PathBuf,
        /// How long this run has waited for it (s).
        waited_s: f64,
    },
    /// A file cannot be written.
    #[error("cannot write {}", visible_path(path))]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system reported.
        source: io::Error,
    },
    /// A file cannot be read.
    #[error("cannot read {}", visible_path(path))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system reported.
        source: io::Error,
    },
    /// A cache key cannot be written as JSON.
    #[error("cannot write the cache_key of {id}")]
    CacheKey {
        /// The figure.
        id: String,
        /// What the writer reported.
        source: serde_json::Error,
    },
}
