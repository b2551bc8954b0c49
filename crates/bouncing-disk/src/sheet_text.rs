//! Sheets as text that people write: JSON objects and TOML tables, with suggestions for misspelt names.

#[cfg(any(feature = "json", feature = "toml"))]
use serde::de::DeserializeOwned;

/// Why a text is not a valid sheet of its kind.
#[cfg(any(feature = "json", feature = "toml"))]
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {reason}")]
pub struct SheetTextError {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1.
    pub column: usize,
    /// The parser's message, without control characters that could disturb a terminal.
    pub reason: String,
}

#[cfg(any(feature = "json", feature = "toml"))]
impl SheetTextError {
    fn new(line: usize, column: usize, reason: &str) -> Self {
        let names = |prefix| {
            let mut names = reason.strip_prefix(prefix)?.split('`').skip(1).step_by(2);
            Some((names.next()?, names.collect::<Vec<_>>()))
        };
        // The parsers name Rust types that mean nothing to the user, and report a string if somebody wrote a
        // unit.
        let reason = match (names("unknown field "), names("unknown variant ")) {
            (Some((key, known)), _) => unknown_key(key, &known),
            (_, Some((word, known))) => unknown(word, nearest(word, &known), &known),
            _ if reason == "string values must be quoted, expected literal string" => {
                "a value must be a number without a unit, such as 40e3".to_owned()
            }
            _ => reason.replace("expected f64", "expected a number").replace("a sequence", "a list"),
        };
        Self { line: line.max(1), column: column.max(1), reason: reason.replace(char::is_control, " ") }
    }
}

/// Reads a JSON object.
///
/// # Errors
/// [`SheetTextError`] for a text that is not JSON, or not of this type.
#[cfg(feature = "json")]
pub fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, SheetTextError> {
    serde_json::from_str(without_mark(text)).map_err(|error| {
        let whole = error.to_string();
        // The parser appends the position, which has its own fields here.
        let place = format!(" at line {} column {}", error.line(), error.column());
        let reason = whole.strip_suffix(&place).unwrap_or(&whole);
        SheetTextError::new(error.line(), error.column(), reason)
    })
}

/// Reads a TOML table.
///
/// # Errors
/// The errors of [`from_json`].
#[cfg(feature = "toml")]
pub fn from_toml<T: DeserializeOwned>(text: &str) -> Result<T, SheetTextError> {
    let text = without_mark(text);
    toml::from_str(text).map_err(|error| {
        let before = text.get(..error.span().map_or(0, |span| span.start)).unwrap_or_default();
        let begun = before.rsplit('\n').next().unwrap_or_default();
        let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
        SheetTextError::new(line, begun.chars().count() + 1, error.message().trim())
    })
}

/// The text without a byte-order mark, which some editors put before it.
#[cfg(any(feature = "json", feature = "toml"))]
fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// The message for an unknown key, with the known one that may be meant.
#[must_use]
pub fn unknown_key(key: &str, known: &[&str]) -> String {
    format!("the key {}", unknown(key, nearest(key, known), known))
}

/// The message for an unknown name, escaped as in Rust, with the one that may be meant.
pub(crate) fn unknown(name: &str, nearest: Option<&str>, known: &[&str]) -> String {
    let hint = match nearest {
        Some(nearest) => format!("did you mean \"{nearest}\"?"),
        None => format!("the known ones are {}", known.join(", ")),
    };
    format!("{:?} is unknown; {hint}", excerpt(name))
}

/// Longest name that is compared letter by letter; a longer one resembles no known name.
const LONGEST_NAME: usize = 64;

/// Shortest part of a name that may stand for it, as "load" for "`load_torque`".
const SHORTEST_PART: usize = 4;

/// Largest number of characters of a user's text that an error repeats.
const LONGEST_EXCERPT: usize = 60;

/// The beginning of a user's text.
fn excerpt(text: &str) -> String {
    match text.char_indices().nth(LONGEST_EXCERPT) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

/// The known name most similar to this one, by the first rule that applies: the name with the fewest changed
/// letters, if at most a third of its letters differ; one that contains this name or is contained in it; one
/// that is as similar without its table; the name with the fewest changes, if fewer than half of its letters
/// differ.
pub(crate) fn nearest<'k>(name: &str, known: &[&'k str]) -> Option<&'k str> {
    if name.is_empty() || name.len() > LONGEST_NAME {
        return None;
    }
    let name = name.trim().to_ascii_lowercase().replace(['-', ' '], "_");
    let letters = name.chars().count();
    let last = |known: &'k str| known.rsplit('.').next().unwrap_or(known);
    let near = known.iter().map(|known| (distance(&name, known), *known)).min()?;
    let near_without_table = known.iter().map(|known| (distance(&name, last(known)), *known)).min()?;
    if 3 * near.0 <= letters {
        return Some(near.1);
    }
    let part = |known: &&&str| {
        name.contains(**known) || name.len() >= SHORTEST_PART && known.contains(name.as_str())
    };
    let part = known.iter().find(part).copied();
    part.or((3 * near_without_table.0 <= letters).then_some(near_without_table.1))
        .or((2 * near.0 < letters).then_some(near.1))
}

/// The fewest insertions, deletions and substitutions of letters, with a swap of two neighbours counted once
/// (the optimal string alignment distance).
pub(crate) fn distance(one: &str, other: &str) -> usize {
    let (one, other): (Vec<char>, Vec<char>) = (one.chars().collect(), other.chars().collect());
    let mut before_last: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=other.len()).collect();
    for (i, letter) in one.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, wanted) in other.iter().enumerate() {
            let replaced = last[j] + usize::from(letter != wanted);
            let mut least = replaced.min(last[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && *letter == other[j - 1] && one[i - 1] == *wanted {
                least = least.min(before_last[j - 1] + 1);
            }
            row.push(least);
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[other.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_counts_changes() {
        for (one, other, expected) in [
            ("", "", 0),
            ("", "abc", 3),
            ("abc", "", 3),
            ("load_torqe", "load_torque", 1),
            ("laod", "load", 1),
            ("kitten", "sitting", 3),
            ("ca", "abc", 3),
            ("mü", "mu", 1),
        ] {
            assert_eq!(distance(one, other), expected, "{one} {other}");
            assert_eq!(distance(other, one), expected, "{other} {one}");
        }
    }

    #[test]
    fn a_path_is_found_without_its_table() {
        let known = ["disk.friction", "disk.restitution", "contact.time"];
        for (name, expected) in [
            ("fricton", Some("disk.friction")),
            ("friction", Some("disk.friction")),
            ("contact_time", Some("contact.time")),
            ("disc.restitution", Some("disk.restitution")),
            ("colour", None),
        ] {
            assert_eq!(nearest(name, &known), expected, "{name}");
        }
    }
}
