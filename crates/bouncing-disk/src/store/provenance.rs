//! The origin of a file.

use std::path::Path;

use bouncing_disk_core::ChatterPolicy;
use ciborium::Value as Tree;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::store::error::StorageError;

/// A kind of file: its name, and the supported versions.
///
/// The version counts the layouts of such files, not the releases of a program: it increases when readers of
/// earlier versions could misunderstand a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Format {
    /// The name stated in a file.
    pub name: &'static str,
    /// The version that is written, which is the newest supported one.
    pub version: u32,
    /// The oldest supported version.
    pub oldest: u32,
}

/// The origin of a stored file: the program and its version, the format and its version, and the computation
/// (parameters, seed and chatter policy).
///
/// It contains no time, user or machine, so the same computation writes the same bytes. Inapplicable fields
/// are stored as `null`.
///
/// ```
/// use std::path::Path;
///
/// use bouncing_disk::System;
/// use bouncing_disk::store::{Format, Provenance, StorageError};
///
/// const SPEEDS: Format = Format { name: "speeds", version: 1, oldest: 1 };
/// let provenance = Provenance::new(SPEEDS).with("system", &System::motor())?.with_seed(1);
///
/// // It is written to a file together with the data, and read back with them.
/// let text = serde_json::json!({ "provenance": provenance, "speed_rad_per_s": [1.0, 2.5] }).to_string();
/// let stored: serde_json::Value = serde_json::from_str(&text).expect("just written");
/// let path = Path::new("speeds.json");
/// assert_eq!(Provenance::read(SPEEDS, &stored["provenance"], path)?, provenance);
///
/// // A file of a newer format gives a specific error.
/// let tomorrow = Format { version: 2, ..SPEEDS };
/// let newer = serde_json::json!(Provenance::new(tomorrow));
/// let refused = Provenance::read(SPEEDS, &newer, path);
/// assert!(matches!(refused, Err(StorageError::NewerFormat { found: 2, newest: 1, .. })));
/// # Ok::<(), StorageError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    program: String,
    version: String,
    format: String,
    format_version: u32,
    parameters: Map<String, Value>,
    seed: Option<u64>,
    chatter_policy: Option<ChatterPolicy>,
}

/// The first number in a tree that is not finite.
fn first_not_finite(tree: &Tree) -> Option<f64> {
    match tree {
        Tree::Float(number) => (!number.is_finite()).then_some(*number),
        Tree::Array(elements) => elements.iter().find_map(first_not_finite),
        Tree::Map(entries) => entries.iter().find_map(|(_, value)| first_not_finite(value)),
        Tree::Tag(_, tagged) => first_not_finite(tagged),
        _ => None,
    }
}

/// The part of a provenance common to all format versions; without it nothing is known about a file.
struct Stamp {
    program: String,
    version: String,
    format: String,
    format_version: u32,
}

impl Provenance {
    /// The provenance of this crate and its version, without parameters, seed and policy.
    #[must_use]
    pub fn new(format: Format) -> Self {
        Self {
            program: env!("CARGO_PKG_NAME").to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            format: format.name.to_owned(),
            format_version: format.version,
            parameters: Map::new(),
            seed: None,
            chatter_policy: None,
        }
    }

    /// Replaces the program, and its version, that writes the file; the default is this crate.
    #[must_use]
    pub fn written_by(mut self, program: &str, version: &str) -> Self {
        (self.program, self.version) = (program.to_owned(), version.to_owned());
        self
    }

    /// Adds a parameter, or replaces one of the same name. Its numbers must be finite, as JSON represents no
    /// others.
    ///
    /// # Errors
    /// [`StorageError::NotStorable`] if JSON cannot represent it, as for a number that is not finite.
    pub fn with(mut self, name: &str, parameter: &(impl Serialize + ?Sized)) -> Result<Self, StorageError> {
        let failed = |source| StorageError::NotStorable { what: format!("the parameter {name:?}"), source };
        // JSON would contain null instead, so different parameters would look alike.
        let tree = Tree::serialized(parameter).map_err(|error| failed(serde::ser::Error::custom(error)))?;
        if let Some(number) = first_not_finite(&tree) {
            return Err(failed(serde::ser::Error::custom(format!("JSON cannot store the number {number}"))));
        }
        self.parameters.insert(name.to_owned(), serde_json::to_value(parameter).map_err(failed)?);
        Ok(self)
    }

    /// Sets the seed of the random streams.
    #[must_use]
    pub const fn with_seed(mut self, seed: u64) -> Self {
        self.seed = Some(seed);
        self
    }

    /// Sets how a chattering sequence ends.
    #[must_use]
    pub const fn with_chatter_policy(mut self, policy: ChatterPolicy) -> Self {
        self.chatter_policy = Some(policy);
        self
    }

    /// Reads the provenance in a file of this format; `file` is used in messages only.
    ///
    /// # Errors
    /// [`StorageError::NewerFormat`], [`StorageError::OlderFormat`] or [`StorageError::OtherFormat`] for a
    /// file that is not of this format in a supported version, whatever else it contains;
    /// [`StorageError::Provenance`] if a field is missing or unknown.
    pub fn read(format: Format, stored: &Value, file: &Path) -> Result<Self, StorageError> {
        let unreadable = |source| StorageError::Provenance { file: file.to_owned(), source };
        Stamp::of(stored).check(format, file)?;
        Self::deserialize(stored).map_err(unreadable)
    }

    /// The program that wrote the file.
    #[must_use]
    pub fn program(&self) -> &str {
        &self.program
    }

    /// The version of the program.
    #[must_use]
    pub fn version(&self) -> &str {
        &self.version
    }

    /// The name of the file's format.
    #[must_use]
    pub fn format(&self) -> &str {
        &self.format
    }

    /// The version of the file's format.
    #[must_use]
    pub const fn format_version(&self) -> u32 {
        self.format_version
    }

    /// The parameters by name.
    #[must_use]
    pub const fn parameters(&self) -> &Map<String, Value> {
        &self.parameters
    }

    /// The seed of the random streams, if any.
    #[must_use]
    pub const fn seed(&self) -> Option<u64> {
        self.seed
    }

    /// How a chattering sequence ends, if that matters.
    #[must_use]
    pub const fn chatter_policy(&self) -> Option<ChatterPolicy> {
        self.chatter_policy
    }
}

impl Stamp {
    fn of(stored: &Value) -> Self {
        let text = |name: &str| stored[name].as_str().unwrap_or_default().to_owned();
        let version = stored["format_version"].as_u64().unwrap_or_default();
        Self {
            program: text("program"),
            version: text("version"),
            format: text("format"),
            format_version: u32::try_from(version).unwrap_or(u32::MAX),
        }
    }

    fn check(self, format: Format, file: &Path) -> Result<(), StorageError> {
        let Self { program, version, format: name, format_version: found } = self;
        let (file, written_by) = (file.to_owned(), format!("{program} {version}"));
        let Format { name: expected, version: newest, oldest } = format;
        if name != expected {
            return Err(StorageError::OtherFormat { file, expected, found: name });
        }
        if found > newest {
            return Err(StorageError::NewerFormat { file, format: expected, found, written_by, newest });
        }
        if found < oldest {
            return Err(StorageError::OlderFormat { file, format: expected, found, written_by, oldest });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::System;
    use crate::motion::PAPER_CHATTER;

    const FORMAT: Format = Format { name: "test", version: 3, oldest: 2 };

    fn read(stored: &Value) -> Result<Provenance, StorageError> {
        Provenance::read(FORMAT, stored, Path::new("a/b.json"))
    }

    #[test]
    fn everything_comes_back() {
        let provenance = Provenance::new(FORMAT)
            .with("system", &System::motor())
            .and_then(|provenance| provenance.with("duration", &0.1))
            .expect("storable")
            .with_seed(u64::MAX)
            .with_chatter_policy(PAPER_CHATTER);
        let text = serde_json::to_string(&provenance).expect("writes");
        let stored = serde_json::from_str(&text).expect("JSON");
        assert_eq!(read(&stored).expect("of this format"), provenance);
        assert_eq!(serde_json::from_str::<Provenance>(&text).expect("whole"), provenance);
        assert_eq!(
            (stored["program"].as_str(), stored["format_version"].as_u64()),
            (Some("bouncing-disk"), Some(3))
        );
        assert_eq!(stored["version"], env!("CARGO_PKG_VERSION"));
        // Inapplicable entries are present as null.
        let plain = json!(Provenance::new(FORMAT));
        assert!(
            plain["seed"].is_null()
                && plain["chatter_policy"].is_null()
                && plain.as_object().is_some_and(|map| map.len() == 7)
        );
    }

    /// Such numbers would all be `null`, so that different computations would have the same parameters.
    #[test]
    fn numbers_that_are_not_finite_are_no_parameters() {
        for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(matches!(
                Provenance::new(FORMAT).with("limit", &[("deep", vec![Some(1.0), Some(number)])]),
                Err(StorageError::NotStorable { .. })
            ));
        }
        let nothing =
            Provenance::new(FORMAT).with("limit", &None::<f64>).expect("a number that there is not");
        assert!(nothing.parameters()["limit"].is_null());
    }

    #[test]
    fn another_format_is_refused_by_name_whatever_else_it_has() {
        let with = |name: &str, version: u32| {
            // As a later version might write it, with unknown fields and without some known ones.
            json!({"format": name, "format_version": version, "program": "later", "version": "9.9", "where": "there"})
        };
        let text = |stored: Value| read(&stored).expect_err("refused").to_string();
        let newer = text(with("test", 4));
        assert!(newer.starts_with("\"a/b.json\" has version 4 of the format \"test\" (written by \"later 9.9\"), newer than version 3"), "{newer}");
        assert!(newer.contains(concat!("bouncing-disk ", env!("CARGO_PKG_VERSION"))), "{newer}");
        assert!(text(with("test", 1)).contains("the oldest that is still read is version 2"));
        assert!(
            text(with("other", 3)).contains("is not a file of the format \"test\": its format is \"other\"")
        );
        assert!(text(json!({})).ends_with("its format is \"\""));
        assert!(matches!(
            read(&json!([])),
            Err(StorageError::OtherFormat { .. } | StorageError::Provenance { .. })
        ));
        let mut odd = with("test", 4);
        odd["format_version"] = json!(1_u64 << 40);
        odd["program"] = json!({"name": "later"});
        assert!(matches!(read(&odd), Err(StorageError::NewerFormat { found: u32::MAX, .. })));
        // A file of this format must be complete and contain nothing else.
        assert!(matches!(read(&with("test", 3)), Err(StorageError::Provenance { .. })));
        for version in [2, 3] {
            let mut stored = json!(Provenance::new(Format { version, ..FORMAT }));
            assert!(read(&stored).is_ok());
            stored["where"] = json!("there");
            assert!(matches!(read(&stored), Err(StorageError::Provenance { .. })));
        }
    }
}
