//! A file of parameters as keys with their values and lines, the same for JSON and TOML.

use std::fmt;

use serde::de::{Deserializer as _, MapAccess, Visitor};
use serde_json::value::RawValue;
use toml::de::{DeTable, DeValue};

use super::Format;
use crate::output::lines::visible;

/// A key and what it has.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) key: String,
    /// From 1.
    pub(super) line: usize,
    pub(super) value: Value,
}

/// What a key may have.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Number(f64),
    Table(Vec<Entry>),
    /// A word for nothing, as JSON has.
    Nothing,
    /// "a text"
    Other(&'static str),
}

/// The keys and values of a text, in their order.
///
/// # Errors
/// Says where and why a text is not of its format; a key that is there twice is an error, too.
pub(super) fn entries(text: &str, format: Format) -> Result<Vec<Entry>, String> {
    // Some editors put a byte-order mark before the text.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    match format {
        Format::Json => of_json(text, text),
        Format::Toml => of_toml(text),
    }
}

/// The line of a place in a text, from 1.
fn line_of(text: &str, place: usize) -> usize {
    1 + text.as_bytes().iter().take(place).filter(|byte| **byte == b'\n').count()
}

/// More keys than any table of parameters has.
const MOST_KEYS: usize = 1_000;

/// The entries of an object, which is a part of `whole`.
fn of_json(part: &str, whole: &str) -> Result<Vec<Entry>, String> {
    let place = |inner: &str| inner.as_ptr() as usize - whole.as_ptr() as usize;
    let mut reader = serde_json::Deserializer::from_str(part);
    let read = reader.deserialize_map(Keys).and_then(|keys| reader.end().map(|()| keys));
    let keys = read.map_err(|error| {
        let full = error.to_string();
        let tail = format!(" at line {} column {}", error.line(), error.column());
        let reason = full.strip_suffix(&tail).unwrap_or(&full);
        let line = line_of(whole, place(part)) + error.line().max(1) - 1;
        format!("line {line}, column {}: no JSON: {}", error.column().max(1), visible(reason))
    })?;
    if keys.len() > MOST_KEYS {
        return Err(format!("line {}: there are more than {MOST_KEYS} keys", line_of(whole, place(part))));
    }
    let mut entries: Vec<Entry> = Vec::new();
    for (key, raw) in keys {
        let line = line_of(whole, place(raw.get()));
        if let Some(first) = entries.iter().find(|entry| entry.key == key) {
            let key = visible(&key);
            return Err(format!("line {line}: the key \"{key}\" is there already, in line {}", first.line));
        }
        let text = raw.get();
        let value = match text.as_bytes().first() {
            Some(b'"') => Value::Other("a text"),
            // What is in a table of a table is nobody's parameter, and may be as deep as it likes.
            Some(b'{') if part.as_ptr() == whole.as_ptr() => Value::Table(of_json(text, whole)?),
            Some(b'{') => Value::Other("a table"),
            Some(b'[') => Value::Other("a list"),
            Some(b't' | b'f') => Value::Other("true or false"),
            Some(b'n') => Value::Nothing,
            // One that no double holds becomes infinite, which no range contains.
            _ => text.parse().map_or(Value::Other("no number"), Value::Number),
        };
        entries.push(Entry { key, line, value });
    }
    Ok(entries)
}

/// All keys and values of an object, also those that are there twice.
struct Keys;

impl<'de> Visitor<'de> for Keys {
    type Value = Vec<(String, &'de RawValue)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with the tables of a system")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut keys = Vec::new();
        while let Some(entry) = map.next_entry()? {
            keys.push(entry);
        }
        Ok(keys)
    }
}

fn of_toml(text: &str) -> Result<Vec<Entry>, String> {
    let table = DeTable::parse(text).map_err(|error| {
        let line = line_of(text, error.span().map_or(0, |span| span.start));
        format!("line {line}: no TOML: {}", visible(error.message().trim()))
    })?;
    Ok(of_table(text, table.get_ref()))
}

fn of_table(text: &str, table: &DeTable<'_>) -> Vec<Entry> {
    // In the order of the text, so that the first fault is told.
    let mut keys: Vec<_> = table.iter().collect();
    keys.sort_unstable_by_key(|(key, _)| key.span().start);
    let entry = |key: &str, place: usize, value: &DeValue<'_>| Entry {
        key: key.to_owned(),
        line: line_of(text, place),
        value: of_value(text, value),
    };
    keys.into_iter().map(|(key, value)| entry(key.get_ref(), key.span().start, value.get_ref())).collect()
}

/// Numbers may be written as integers, with any radix, and with underscores.
fn of_value(text: &str, value: &DeValue<'_>) -> Value {
    match value {
        DeValue::Integer(integer) => {
            let (digits, radix) = (integer.as_str(), integer.radix());
            let read = if radix == 10 {
                digits.parse().ok()
            } else {
                u64::from_str_radix(digits, radix).ok().map(|whole| whole as f64)
            };
            read.map_or(Value::Other("an integer that is too large"), Value::Number)
        }
        DeValue::Float(float) => float.as_str().parse().map_or(Value::Other("no number"), Value::Number),
        DeValue::String(_) => Value::Other("a text"),
        DeValue::Boolean(_) => Value::Other("true or false"),
        DeValue::Datetime(_) => Value::Other("a date or a time"),
        DeValue::Array(_) => Value::Other("a list"),
        DeValue::Table(table) => Value::Table(of_table(text, table)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(key: &str, line: usize, value: f64) -> Entry {
        Entry { key: key.to_owned(), line, value: Value::Number(value) }
    }

    #[test]
    fn both_formats_give_the_same_keys_with_their_lines() {
        let json = "{\n\"disk\": {\n\"friction\": 0.6,\n\"restitution\": 1\n},\n\"x\": null, \"y\": [1]}";
        let inner = Value::Table(vec![number("friction", 3, 0.6), number("restitution", 4, 1.0)]);
        let disk = |line| Entry { key: "disk".to_owned(), line, value: inner.clone() };
        let read = entries(json, Format::Json).unwrap();
        assert_eq!(read[0], disk(2));
        assert_eq!(
            (&read[1].value, &read[2].value, read[2].line),
            (&Value::Nothing, &Value::Other("a list"), 6)
        );
        let toml = "# a toss\n[disk]\nfriction = 0.6\nrestitution = 0x1\n";
        assert_eq!(entries(toml, Format::Toml).unwrap(), [disk(2)]);
        let with_mark = format!("\u{feff}{toml}");
        assert_eq!(entries(&with_mark, Format::Toml).unwrap(), [disk(2)]);
    }

    #[test]
    fn a_fault_of_the_format_has_a_line() {
        for (text, format, told) in [
            ("", Format::Json, "line 1, column 1: no JSON"),
            ("[1]", Format::Json, "line 1, column 1: no JSON"),
            ("{\n\"a\": 1,\n}", Format::Json, "line 3"),
            ("{\n\"a\": 1,\n\"a\": 2}", Format::Json, "line 3: the key \"a\" is there already, in line 2"),
            ("{\n\"t\": {\n\"a\": 1, \"a\": 2}}", Format::Json, "line 3: the key \"a\" is there already"),
            ("a = 1\nb = \n", Format::Toml, "line 2: no TOML"),
            ("a = 1\na = 2\n", Format::Toml, "line 2: no TOML"),
        ] {
            let error = entries(text, format).unwrap_err();
            assert!(error.starts_with(told), "{text:?}: {error}");
        }
        assert_eq!(entries("", Format::Toml), Ok(Vec::new()));
    }

    #[test]
    fn numbers_that_no_double_holds_are_left_to_the_ranges() {
        let read = |text: &str, format| entries(text, format).unwrap().remove(0).value;
        assert_eq!(read("{\"a\": 1e999}", Format::Json), Value::Number(f64::INFINITY));
        assert_eq!(read("a = inf", Format::Toml), Value::Number(f64::INFINITY));
        assert_eq!(read("a = 1e-999", Format::Toml), Value::Number(0.0));
        assert_eq!(read("a = '1'", Format::Toml), Value::Other("a text"));
    }
}
