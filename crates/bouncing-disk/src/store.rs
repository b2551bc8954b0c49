//! Files: their origin, and the journal from which a long computation resumes.
//!
//! A [`Provenance`] states program, version, format, parameters, seed and chatter policy, but neither time nor
//! machine, so that the same computation writes the same bytes. A [`Journal`] starts with a line of provenance,
//! followed by one result per line, each with a digest. A killed computation loses only the line being written;
//! resumed, it ends with the same bits.
//!
//! ```
//! use bouncing_disk::System;
//! use bouncing_disk::store::{Format, Provenance};
//!
//! const SPEEDS: Format = Format { name: "speeds", version: 1, oldest: 1 };
//! let origin = Provenance::new(SPEEDS).with("system", &System::motor())?.with_seed(1);
//! let text = serde_json::json!({ "provenance": origin, "speed_rad_per_s": [1.0, 2.5] }).to_string();
//! assert!(text.contains("\"seed\":1"));
//! # Ok::<(), bouncing_disk::store::StorageError>(())
//! ```
//!
//! docs/command-line.md describes the files that the command line writes.

pub(crate) mod error;
pub(crate) mod journal;
pub(crate) mod provenance;

pub use error::StorageError;
pub use journal::{JOURNAL, Journal};
pub use provenance::{Format, Provenance};
