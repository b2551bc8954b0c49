//! Recognises finished figures that are up to date.
//!
//! A cache key is written after all files of a figure. It holds the digest of the sources that determine the
//! result, the quality, and a digest of every file: a changed source, a killed run and an edited or missing
//! file are all seen.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use bouncing_disk::store::Provenance;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::experiment::Quality;
use crate::provenance;

include!(concat!(env!("OUT_DIR"), "/digests.rs"));

/// The inputs of a finished figure, and its files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CacheKey {
    /// Of the cache key itself; the files have their own.
    provenance: Provenance,
    key: String,
    /// The digest of the user's measurements in it; empty when there were none.
    measured: String,
    /// The quality it was made in.
    pub quality: Quality,
    /// The time the computation and the drawing took.
    pub run_time_s: f64,
    files: BTreeMap<String, String>,
}

/// Why a figure is not up to date.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Stale {
    /// There is no cache key: never made, or the run was interrupted.
    #[error("not made yet")]
    Missing,
    /// The files are of a format that is newer than this program: their format, who wrote it, and what this
    /// program reads.
    #[error("{message}")]
    Newer {
        /// All that.
        message: String,
    },
    /// Made in another quality.
    #[error("made in {found} quality")]
    Quality {
        /// The quality found.
        found: Quality,
    },
    /// The sources have changed.
    #[error("the sources have changed")]
    Sources,
    /// The user's measurements have changed.
    #[error("the measurements have changed")]
    Measurements,
    /// A file is missing or was changed.
    #[error("{name} is missing or was changed")]
    File {
        /// Its name.
        name: String,
    },
}

impl CacheKey {
    /// A cache key of files made by this version with the user's measurements of the digest `measured`.
    pub fn new(id: &str, quality: Quality, measured: &str, run_time_s: f64, files: &[(&str, &[u8])]) -> Self {
        let files = files.iter().map(|(name, bytes)| ((*name).to_owned(), digest(bytes))).collect();
        let provenance = provenance::new(provenance::CACHE_KEY);
        Self { provenance, key: key(id, quality), measured: measured.to_owned(), quality, run_time_s, files }
    }

    /// As it is stored.
    pub fn to_text(&self) -> String {
        // Names, texts and a finite time can be stored.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// Reads the cache key of a figure.
    pub fn read(id: &str, bytes: &[u8]) -> Result<Self, Stale> {
        let stored: Value = serde_json::from_slice(bytes).map_err(|_| Stale::Missing)?;
        provenance::refuse_newer(provenance::CACHE_KEY, stored.get("provenance"), &format!("{id}.cache-key"))
            .map_err(|error| Stale::Newer { message: error.to_string() })?;
        Self::deserialize(stored).map_err(|_| Stale::Missing)
    }

    /// The names of its files.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// Whether a user's measurements, readable or not, were there when it was made.
    pub fn shows_measurements(&self) -> bool {
        !self.measured.is_empty()
    }

    /// Whether this is the content of the file when it was made.
    pub fn holds(&self, name: &str, bytes: &[u8]) -> bool {
        self.files.get(name).is_some_and(|expected| digest(bytes) == *expected)
    }

    /// Compares the cache key with this version, with the digest of the measurements and with the files;
    /// `read` gives the content of a file.
    pub fn check(
        &self,
        id: &str,
        quality: Quality,
        measured: &str,
        mut read: impl FnMut(&str) -> Option<Vec<u8>>,
    ) -> Result<(), Stale> {
        if self.quality != quality {
            return Err(Stale::Quality { found: self.quality });
        }
        if self.key != key(id, quality) {
            return Err(Stale::Sources);
        }
        if self.measured != measured {
            return Err(Stale::Measurements);
        }
        let changed = |(name, expected): &(&String, &String)| {
            read(name).is_none_or(|bytes| digest(&bytes) != **expected)
        };
        match self.files.iter().find(changed) {
            Some((name, _)) => Err(Stale::File { name: name.clone() }),
            None => Ok(()),
        }
    }
}

/// The digest of everything that determines the result.
fn key(id: &str, quality: Quality) -> String {
    let mut hasher = DefaultHasher::new();
    (id, quality.name(), SHARED).hash(&mut hasher);
    // A module cannot have the hyphens of an identifier.
    let name = id.replace('-', "_");
    match MODULES.iter().find(|(module, _)| *module == name) {
        Some((_, digest)) => digest.hash(&mut hasher),
        // Without a module of its own it may depend on any.
        None => MODULES.hash(&mut hasher),
    }
    format!("{:016x}", hasher.finish())
}

fn digest(bytes: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_change_is_seen() {
        let cache_key = CacheKey::new("demo", Quality::Draft, "d1", 1.5, &[("demo.json", b"{}".as_slice())]);
        let check = |quality, measured, bytes: Option<&[u8]>| {
            cache_key.check("demo", quality, measured, |_| bytes.map(<[u8]>::to_vec))
        };
        let found = Quality::Draft;
        let name = || "demo.json".to_owned();
        assert_eq!(check(found, "d1", Some(b"{}")), Ok(()));
        assert_eq!(check(Quality::Paper, "d1", Some(b"{}")), Err(Stale::Quality { found }));
        assert_eq!(check(found, "", Some(b"{}")), Err(Stale::Measurements));
        assert_eq!(check(found, "d1", None), Err(Stale::File { name: name() }));
        assert_eq!(check(found, "d1", Some(b"0")), Err(Stale::File { name: name() }));
        let older = CacheKey { key: "0".to_owned(), ..cache_key.clone() };
        let same = |_: &str| Some(b"{}".to_vec());
        assert_eq!(older.check("demo", found, "d1", same), Err(Stale::Sources));
        assert_ne!(key("demo", Quality::Draft), key("demo", Quality::Paper));
        assert_ne!(key("demo", Quality::Draft), key("other", Quality::Draft));
    }

    #[test]
    fn it_says_where_it_comes_from_and_a_newer_one_is_refused_by_name() {
        let cache_key = CacheKey::new("demo", Quality::Draft, "", 1.5, &[]);
        let mut stored: Value = serde_json::from_str(&cache_key.to_text()).expect("JSON");
        assert_eq!(CacheKey::read("demo", stored.to_string().as_bytes()), Ok(cache_key));
        assert_eq!(stored["provenance"]["program"], "bouncing-disk-experiments");
        stored["provenance"]["format_version"] = 2.into();
        stored["files"] = 3.into();
        let stale = CacheKey::read("demo", stored.to_string().as_bytes()).expect_err("newer");
        let text = stale.to_string();
        assert!(text.starts_with("\"demo.cache-key\" has version 2 of the format"), "{text}");
        assert_eq!(CacheKey::read("demo", b"{"), Err(Stale::Missing));
    }

    #[test]
    fn every_experiment_has_a_module_by_its_name() {
        for entry in crate::registry::all() {
            let name = entry.id.replace('-', "_");
            assert!(MODULES.iter().any(|(module, _)| *module == name), "{name}");
        }
    }
}
