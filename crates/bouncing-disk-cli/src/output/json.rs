//! Results as JSON: one field or list element per line, so that people can read a file and compare it line by
//! line.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::Value;

/// Writes the value of a field.
pub(crate) type Data<'a> = Box<dyn Fn(&mut dyn Write) -> io::Result<()> + 'a>;

pub(crate) fn whole<'a>(value: Value) -> Data<'a> {
    Box::new(move |to| match &value {
        Value::Array(elements) if elements.iter().any(|own| own.is_array() || own.is_object()) => {
            below(to, ["[", "]"], elements.iter().map(|element| Ok(element.to_string())))
        }
        Value::Object(fields) => {
            let line =
                |(name, value): (&String, &Value)| Ok(format!("{}: {value}", Value::from(name.as_str())));
            below(to, ["{", "}"], fields.iter().map(line))
        }
        other => write!(to, "{other}"),
    })
}

/// A list whose elements are tables or lists, each made when it is written, because all together may take
/// more memory than their sources.
pub(crate) fn list<'a, T: Serialize, I: Iterator<Item = T>>(elements: impl Fn() -> I + 'a) -> Data<'a> {
    let line = |element: T| Ok(serde_json::to_value(element)?.to_string());
    Box::new(move |to| below(to, ["[", "]"], elements().map(line)))
}

/// Writes an object with these fields, in this order.
pub(crate) fn write<'a>(
    to: &mut dyn Write,
    fields: impl IntoIterator<Item = (&'a str, &'a Data<'a>)>,
) -> io::Result<()> {
    let mut before = "{";
    for (name, data) in fields {
        write!(to, "{before}\n  {}: ", Value::from(name))?;
        data(to)?;
        before = ",";
    }
    to.write_all(b"\n}\n")
}

/// Writes parts one per line, between brackets.
fn below(
    to: &mut dyn Write,
    [open, close]: [&str; 2],
    parts: impl Iterator<Item = io::Result<String>>,
) -> io::Result<()> {
    let mut before = open;
    for part in parts {
        write!(to, "{before}\n    {}", part?)?;
        before = ",";
    }
    if before == open { write!(to, "{open}{close}") } else { write!(to, "\n  {close}") }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde_json::json;

    use super::*;

    #[test]
    fn what_is_written_is_what_was_given() {
        let fields: [(&str, Data); 5] = [
            ("b \"", whole(json!({"x": 0.1, "y": [1, 2]}))),
            ("a", whole(json!([[1.5, null], [2, 3]]))),
            ("c", whole(json!([]))),
            ("d", whole(json!({}))),
            ("e", list(|| (0..2).map(|index| json!({"index": index})))),
        ];
        let mut bytes = Vec::new();
        write(&mut bytes, fields.iter().map(|(name, data)| (*name, data))).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let read: Value = serde_json::from_str(&text).unwrap();
        let expected = json!({
            "b \"": {"x": 0.1, "y": [1, 2]}, "a": [[1.5, null], [2, 3]], "c": [], "d": {},
            "e": [{"index": 0}, {"index": 1}],
        });
        assert_eq!(read, expected);
        assert!(text.starts_with("{\n  \"b \\\"\": {\n    \"x\": 0.1,\n"), "{text}");
        assert!(text.contains("    [1.5,null],\n    [2,3]\n  ]"), "{text}");
        // JSON has no maps with keys other than text.
        let fails = list(|| std::iter::once(BTreeMap::from([([1], 2)])));
        assert!(write(&mut Vec::new(), [("a", &fails)]).is_err());
    }
}
