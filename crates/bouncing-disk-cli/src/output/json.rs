//! Results as JSON: the fields of a result one below the other, the elements of a list one a line, so that a
//! file can be read by people and compared line by line, and is not much longer for it.

use std::io::{self, Write};

use serde_json::Value;

/// What is given the elements of a list one by one.
pub(crate) type Elements<'w> = dyn FnMut(&Value) -> io::Result<()> + 'w;

/// What a field has.
pub(crate) enum Data {
    Whole(Value),
    /// A list whose elements are tables or lists, each made when it is written: all of them together may take
    /// more memory than what they are made from.
    List(Box<List>),
}

/// Gives all elements of a list.
pub(crate) type List = dyn Fn(&mut Elements<'_>) -> io::Result<()>;

impl From<Value> for Data {
    fn from(value: Value) -> Self {
        Self::Whole(value)
    }
}

impl Data {
    /// A list of what is made of the numbers below `count`.
    pub(crate) fn list(count: usize, of: impl Fn(usize) -> io::Result<Value> + 'static) -> Self {
        Self::List(Box::new(move |each| (0..count).try_for_each(|index| each(&of(index)?))))
    }
}

/// Writes an object with these fields, in this order.
pub(crate) fn write<'a>(
    to: &mut dyn Write,
    fields: impl IntoIterator<Item = (&'a str, &'a Data)>,
) -> io::Result<()> {
    to.write_all(b"{")?;
    for (index, (name, data)) in fields.into_iter().enumerate() {
        let comma = if index == 0 { "" } else { "," };
        write!(to, "{comma}\n  {}: ", Value::from(name))?;
        match data {
            Data::Whole(value) => below(to, value)?,
            Data::List(elements) => list(to, elements)?,
        }
    }
    to.write_all(b"\n}\n")
}

fn list(to: &mut dyn Write, elements: impl Fn(&mut Elements<'_>) -> io::Result<()>) -> io::Result<()> {
    let mut before = "[";
    elements(&mut |element| {
        write!(to, "{before}\n    {element}")?;
        before = ",";
        Ok(())
    })?;
    to.write_all(if before == "[" { b"[]" } else { b"\n  ]" })
}

fn below(to: &mut dyn Write, value: &Value) -> io::Result<()> {
    match value {
        Value::Array(elements)
            if elements.iter().any(|element| element.is_array() || element.is_object()) =>
        {
            list(to, |each| elements.iter().try_for_each(each))
        }
        Value::Object(fields) if !fields.is_empty() => {
            let mut before = "{";
            for (name, value) in fields {
                write!(to, "{before}\n    {}: {value}", Value::from(name.as_str()))?;
                before = ",";
            }
            to.write_all(b"\n  }")
        }
        other => write!(to, "{other}"),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn text(fields: &[(&str, Data)]) -> String {
        let mut bytes = Vec::new();
        write(&mut bytes, fields.iter().map(|(name, data)| (*name, data))).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn what_is_written_is_what_was_given() {
        let fields = [
            ("b \"", json!({"x": 0.1, "y": [1, 2]}).into()),
            ("a", json!([[1.5, null], [2, 3]]).into()),
            ("c", json!([]).into()),
            ("d", json!({}).into()),
        ];
        let text = text(&fields);
        let read: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(
            read,
            json!({"b \"": {"x": 0.1, "y": [1, 2]}, "a": [[1.5, null], [2, 3]], "c": [], "d": {}})
        );
        assert!(text.starts_with("{\n  \"b \\\"\": {\n    \"x\": 0.1,\n"), "{text}");
        assert!(text.contains("    [1.5,null],\n    [2,3]\n  ]"), "{text}");
        assert_eq!(serde_json::from_str::<Value>(&self::text(&[])).unwrap(), json!({}));
    }

    #[test]
    fn a_list_has_the_same_text_whether_it_is_whole_or_not() {
        for count in 0..3 {
            let whole: Vec<Value> = (0..count).map(|index| json!({"index": index})).collect();
            let made = Data::list(count, |index| Ok(json!({"index": index})));
            assert_eq!(text(&[("a", made)]), text(&[("a", json!(whole).into())]));
        }
        let fails = Data::list(1, |_| Err(io::Error::other("no such element")));
        assert!(write(&mut Vec::new(), [("a", &fails)]).is_err());
    }
}
