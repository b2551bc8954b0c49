//! JSON laid out for reading and for line-wise comparison: one field per line, rows of numbers on one line.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};
use serde_json::ser::{Formatter, PrettyFormatter, Serializer};
use serde_json::{Error, Value};

/// The text of `value`, ending in a line end. Keys are in the order of the map (sorted).
///
/// # Errors
///
/// None that serde_json is known to report for a [`Value`].
pub fn to_text(value: &Value) -> Result<String, Error> {
    let mut broken = Vec::new();
    break_arrays(value, &mut broken);
    let layout =
        Layout { pretty: PrettyFormatter::with_indent(b" "), broken: broken.into_iter(), open: Vec::new() };
    let mut text = Vec::new();
    value.serialize(&mut Serializer::with_formatter(&mut text, layout))?;
    text.push(b'\n');
    String::from_utf8(text).map_err(|error| Error::io(io::Error::other(error)))
}

/// Reads a value from all of `bytes`; the error says where in the value it is.
///
/// # Errors
///
/// When the bytes are no JSON, or of another form.
pub fn read<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, serde_path_to_error::Error<Error>> {
    let mut reader = serde_json::Deserializer::from_slice(bytes);
    let value = serde_path_to_error::deserialize(&mut reader)?;
    let whole = |error| serde_path_to_error::Error::new(serde_path_to_error::Track::new().path(), error);
    reader.end().map_err(whole)?;
    Ok(value)
}

/// Whether each array, in the order in which they begin, has its elements on lines of their own: if one of them has
/// elements itself.
fn break_arrays(value: &Value, broken: &mut Vec<bool>) {
    let has_elements = |value: &Value| match value {
        Value::Object(members) => !members.is_empty(),
        Value::Array(elements) => !elements.is_empty(),
        _ => false,
    };
    match value {
        Value::Object(members) => members.values().for_each(|member| break_arrays(member, broken)),
        Value::Array(elements) => {
            broken.push(elements.iter().any(has_elements));
            elements.iter().for_each(|element| break_arrays(element, broken));
        }
        _ => {}
    }
}

/// serde_json's own layout, but for the arrays that stay on one line.
struct Layout {
    pretty: PrettyFormatter<'static>,
    /// Of the arrays that have not begun.
    broken: std::vec::IntoIter<bool>,
    /// Of the arrays that have not ended.
    open: Vec<bool>,
}

impl Layout {
    fn is_broken(&self) -> bool {
        self.open.last().copied().unwrap_or_default()
    }
}

impl Formatter for Layout {
    fn begin_array<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open.push(self.broken.next().unwrap_or_default());
        if self.is_broken() { self.pretty.begin_array(writer) } else { writer.write_all(b"[") }
    }

    fn begin_array_value<W: Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        match (self.is_broken(), first) {
            (true, _) => self.pretty.begin_array_value(writer, first),
            (false, true) => Ok(()),
            (false, false) => writer.write_all(b","),
        }
    }

    fn end_array_value<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        if self.is_broken() { self.pretty.end_array_value(writer) } else { Ok(()) }
    }

    fn end_array<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        if self.open.pop().unwrap_or_default() {
            self.pretty.end_array(writer)
        } else {
            writer.write_all(b"]")
        }
    }

    fn begin_object<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.begin_object(writer)
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.pretty.begin_object_key(writer, first)
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.begin_object_value(writer)
    }

    fn end_object_value<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_object_value(writer)
    }

    fn end_object<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_object(writer)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn rows_stay_on_one_line_and_nothing_is_lost() {
        let value = json!({"rows": [[0.1, 1e-8], [2, 3]], "empty": {}, "none": null, "name": "a \"b\""});
        let text = to_text(&value).expect("writes");
        assert_eq!(
            text,
            "{\n \"empty\": {},\n \"name\": \"a \\\"b\\\"\",\n \"none\": null,\n \"rows\": [\n  [0.1,1e-8],\n  [2,3]\n ]\n}\n"
        );
        assert_eq!(serde_json::from_str::<Value>(&text).expect("valid"), value);
    }

    #[test]
    fn what_is_empty_is_closed_at_once() {
        let value = json!([[], {}, [[], [1]], {"a": [{}, []]}]);
        let text = to_text(&value).expect("writes");
        assert_eq!(text, "[\n [],\n {},\n [\n  [],\n  [1]\n ],\n {\n  \"a\": [{},[]]\n }\n]\n");
        assert_eq!(to_text(&json!([])).expect("writes"), "[]\n");
    }

    #[test]
    fn an_error_says_where_it_is_and_nothing_may_follow() {
        let read = |text: &'static str| read::<std::collections::BTreeMap<String, Vec<f64>>>(text.as_bytes());
        assert_eq!(read("{\"a\": [1, 2]}").expect("valid")["a"], [1.0, 2.0]);
        let error = read("{\"a\": [1, \"2\"]}").expect_err("a text").to_string();
        assert!(error.starts_with("a[1]: invalid type: string"), "{error}");
        assert!(read("{} 1").expect_err("more").to_string().contains("trailing characters"));
    }
}
