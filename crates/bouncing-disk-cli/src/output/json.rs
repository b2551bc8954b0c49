//! Results as JSON: the fields of a result one below the other, the elements of a list one a line, so that a
//! file can be read by people and compared line by line, and is not much longer for it.

use std::io::{self, Write};

use serde_json::Value;

/// The value of a field.
pub(crate) enum Data {
    Whole(Value),
    /// A list whose elements are tables or lists, each made when it is written: all of them together may take
    /// more memory than what they are made from.
    List(Box<List>),
}

/// Gives a function the elements of a list one by one.
pub(crate) type List = dyn Fn(&mut dyn FnMut(&Value) -> io::Result<()>) -> io::Result<()>;

impl From<Value> for Data {
    fn from(value: Value) -> Self {
        Self::Whole(value)
    }
}

impl Data {
    /// A list of `count` elements, made from their indices.
    pub(crate) fn list(count: usize, of: impl Fn(usize) -> io::Result<Value> + 'static) -> Self {
        Self::List(Box::new(move |each| (0..count).try_for_each(|index| each(&of(index)?))))
    }
}

/// Writes an object with these fields, in this order.
pub(crate) fn write<'a>(
    to: &mut dyn Write,
    fields: impl IntoIterator<Item = (&'a str, &'a Data)>,
) -> io::Result<()> {
    let mut before = "{";
    for (name, data) in fields {
        write!(to, "{before}\n  {}: ", Value::from(name))?;
        before = ",";
        match data {
            Data::List(elements) => {
                below(to, ["[", "]"], |each| elements(&mut |element| each(element.to_string())))
            }
            Data::Whole(Value::Array(elements))
                if elements.iter().any(|own| own.is_array() || own.is_object()) =>
            {
                below(to, ["[", "]"], |each| {
                    elements.iter().try_for_each(|element| each(element.to_string()))
                })
            }
            Data::Whole(Value::Object(fields)) => below(to, ["{", "}"], |each| {
                fields
                    .iter()
                    .try_for_each(|(name, value)| each(format!("{}: {value}", Value::from(name.as_str()))))
            }),
            Data::Whole(other) => write!(to, "{other}"),
        }?;
    }
    to.write_all(b"\n}\n")
}

/// Writes parts one below the other, between brackets.
fn below(
    to: &mut dyn Write,
    [open, close]: [&str; 2],
    parts: impl FnOnce(&mut dyn FnMut(String) -> io::Result<()>) -> io::Result<()>,
) -> io::Result<()> {
    let mut before = open;
    parts(&mut |part| {
        write!(to, "{before}\n    {part}")?;
        before = ",";
        Ok(())
    })?;
    if before == open { write!(to, "{open}{close}") } else { write!(to, "\n  {close}") }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn what_is_written_is_what_was_given() {
        let fields: [(&str, Data); 5] = [
            ("b \"", json!({"x": 0.1, "y": [1, 2]}).into()),
            ("a", json!([[1.5, null], [2, 3]]).into()),
            ("c", json!([]).into()),
            ("d", json!({}).into()),
            ("e", Data::list(2, |index| Ok(json!({"index": index})))),
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
        let fails = Data::list(1, |_| Err(io::Error::other("no such element")));
        assert!(write(&mut Vec::new(), [("a", &fails)]).is_err());
    }
}
