//! Results as JSON: the fields of a result one below the other, the elements of a list one a line, so that a
//! file can be read by people and compared line by line, and is not much longer for it.

use serde_json::Value;

/// An object with these fields, in this order.
pub(crate) fn object<'a>(fields: impl IntoIterator<Item = (&'a str, &'a Value)>) -> String {
    let fields: Vec<String> = fields
        .into_iter()
        .map(|(name, value)| format!("  {}: {}", Value::from(name), below(value)))
        .collect();
    format!("{{\n{}\n}}\n", fields.join(",\n"))
}

fn below(value: &Value) -> String {
    match value {
        Value::Array(elements)
            if elements.iter().any(|element| element.is_array() || element.is_object()) =>
        {
            let lines: Vec<String> = elements.iter().map(|element| format!("    {element}")).collect();
            format!("[\n{}\n  ]", lines.join(",\n"))
        }
        Value::Object(fields) if !fields.is_empty() => {
            let lines: Vec<String> = fields
                .iter()
                .map(|(name, value)| format!("    {}: {value}", Value::from(name.as_str())))
                .collect();
            format!("{{\n{}\n  }}", lines.join(",\n"))
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn what_is_written_is_what_was_given() {
        let fields =
            [("b \"", json!({"x": 0.1, "y": [1, 2]})), ("a", json!([[1.5, null], [2, 3]])), ("c", json!([]))];
        let text = object(fields.iter().map(|(name, value)| (*name, value)));
        let read: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(read, json!({"b \"": {"x": 0.1, "y": [1, 2]}, "a": [[1.5, null], [2, 3]], "c": []}));
        assert!(text.starts_with("{\n  \"b \\\"\": {\n    \"x\": 0.1,\n"), "{text}");
        assert!(text.contains("    [1.5,null],\n    [2,3]\n  ]"), "{text}");
    }
}
