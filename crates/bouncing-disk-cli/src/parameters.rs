//! Parameters: from a file, a preset, and the command line.

mod document;
pub(crate) mod motor;
pub(crate) mod setting;
mod sheet;
pub(crate) mod system;

use std::path::Path;

use bouncing_disk::{MotorField, regular_file};

use crate::failure::Failure;
use document::{Entry, entries};
use sheet::FIELDS;

/// The largest file of parameters that is read (bytes): a hundred times that of any.
const LARGEST: u64 = 1 << 20;

/// The formats of a file of parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Json,
    Toml,
}

/// What a file of parameters describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    System,
    Motor,
}

impl Kind {
    const ALL: [Self; 2] = [Self::System, Self::Motor];

    /// Whether a key of the outermost table is legal in a file of this kind.
    fn has(self, key: &str) -> bool {
        match self {
            Self::System => FIELDS.iter().any(|field| table_of(field.path) == key),
            Self::Motor => key.parse::<MotorField>().is_ok(),
        }
    }

    /// Whether a key is a parameter of this kind, in whatever table it stands.
    fn names(self, key: &str) -> bool {
        self.has(key) || self == Self::System && FIELDS.iter().any(|field| sheet::name(field.path) == key)
    }

    /// Whether a key tells that a file is of this kind: it is legal there, and no parameter of any other.
    fn is_told_by(self, key: &str) -> bool {
        self.has(key) && Self::ALL.into_iter().all(|kind| kind == self || !kind.names(key))
    }

    /// What it is, and the commands that read it.
    const fn described(self) -> (&'static str, &'static str) {
        match self {
            Self::System => (
                "the parameters of a disk and its platform",
                "toss, orbits, diagram, verdicts, basins, doublings and design read",
            ),
            Self::Motor => ("the data sheet of a motor", "motor and fit --motor read"),
        }
    }

    /// The other kind that a file is of, and the key that tells. What has a key that tells its own kind is of
    /// that, so that no legal file is refused.
    fn mistaken(self, entries: &[Entry]) -> Option<(Self, &Entry)> {
        let telling = |kind: Self| entries.iter().find(|entry| kind.is_told_by(&entry.key));
        if telling(self).is_some() {
            return None;
        }
        Self::ALL.into_iter().find_map(|kind| Some((kind, telling(kind)?)))
    }
}

/// `disk` of `disk.friction`.
fn table_of(path: &str) -> &str {
    path.split('.').next().unwrap_or(path)
}

/// The text of a file of parameters of a kind, and its format, by its ending. A file of another kind is
/// refused as a whole: its first unknown key would not tell that it is given to the wrong command.
fn read(path: &Path, kind: Kind) -> Result<(String, Format), Failure> {
    let (text, format) = read_text(path)?;
    // What is no JSON or TOML is told by the reader of its kind.
    let entries = entries(&text, format).unwrap_or_default();
    match kind.mistaken(&entries) {
        Some((other, Entry { key, line, .. })) => {
            let ((own, _), (found, readers)) = (kind.described(), other.described());
            Err(Failure::usage(format!(
                "{}: line {line}: by its key \"{key}\" this is {found}, which {readers}; needed is {own}",
                path.display()
            )))
        }
        None => Ok((text, format)),
    }
}

fn read_text(path: &Path) -> Result<(String, Format), Failure> {
    let name = path.display();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let format = match ending.as_deref() {
        Some("json") => Format::Json,
        Some("toml") => Format::Toml,
        _ => return Err(Failure::usage(format!("{name}: a file of parameters ends in .json or .toml"))),
    };
    let unreadable = |error: String| Failure::usage(format!("{name} cannot be read: {error}"));
    let bytes = regular_file::read(path, LARGEST).map_err(|error| unreadable(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is no text in UTF-8".to_owned()))?;
    Ok((text, format))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mistaken(kind: Kind, text: &str) -> Option<(Kind, String)> {
        let entries = entries(text, Format::Toml).unwrap();
        kind.mistaken(&entries).map(|(other, entry)| (other, entry.key.clone()))
    }

    #[test]
    fn a_file_of_another_kind_is_told_by_a_key_that_only_that_has() {
        let found = |kind, key: &str| Some((kind, key.to_owned()));
        for (kind, text, expected) in [
            (Kind::System, "friction = 0.1\ndrive_frequency = 7e4", found(Kind::Motor, "drive_frequency")),
            (Kind::System, "drive_frequncy = 7e4\nmass = 1e-3", found(Kind::Motor, "mass")),
            (Kind::Motor, "disk.friction = 0.1", found(Kind::System, "disk")),
            (Kind::Motor, "friction = 0.1\n[platform]\n[dsk]", found(Kind::System, "platform")),
            // What both have tells nothing, and neither does what none has.
            (Kind::System, "friction = 0.1\nangular_frequency = 15", None),
            (Kind::System, "colour = 1", None),
            (Kind::Motor, "colour = 1", None),
            // A slip in a file of the right kind.
            (Kind::System, "mass = 1e-3\n[disk]\nfriction = 0.1", None),
            (Kind::Motor, "drive_frequency = 7e4\n[disk]\nfriction = 0.1", None),
            (Kind::Motor, "", None),
        ] {
            assert_eq!(mistaken(kind, text), expected, "{kind:?} {text}");
        }
    }
}
