//! JSON laid out for reading and for line-wise comparison: one field per line, rows of numbers on one line.

use serde_json::Value;

/// The text of `value`, ending in a line end. Keys are in the order of the map (sorted).
pub fn to_text(value: &Value) -> String {
    let mut text = String::new();
    push(&mut text, value, 0);
    text.push('\n');
    text
}

fn push(text: &mut String, value: &Value, depth: usize) {
    match value {
        Value::Object(members) if !members.is_empty() => {
            text.push('{');
            for (index, (name, member)) in members.iter().enumerate() {
                new_line(text, index, depth + 1);
                text.push_str(&Value::from(name.as_str()).to_string());
                text.push_str(": ");
                push(text, member, depth + 1);
            }
            end_line(text, depth);
            text.push('}');
        }
        Value::Array(elements) if elements.iter().any(is_compound) => {
            text.push('[');
            for (index, element) in elements.iter().enumerate() {
                new_line(text, index, depth + 1);
                push(text, element, depth + 1);
            }
            end_line(text, depth);
            text.push(']');
        }
        other => text.push_str(&other.to_string()),
    }
}

fn is_compound(value: &Value) -> bool {
    match value {
        Value::Object(members) => !members.is_empty(),
        Value::Array(elements) => !elements.is_empty(),
        _ => false,
    }
}

fn new_line(text: &mut String, index: usize, depth: usize) {
    if index > 0 {
        text.push(',');
    }
    end_line(text, depth);
}

fn end_line(text: &mut String, depth: usize) {
    text.push('\n');
    text.extend(std::iter::repeat_n(' ', depth));
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn rows_stay_on_one_line_and_nothing_is_lost() {
        let value = json!({"rows": [[0.1, 1e-8], [2, 3]], "empty": {}, "none": null, "name": "a \"b\""});
        let text = to_text(&value);
        assert_eq!(
            text,
            "{\n \"empty\": {},\n \"name\": \"a \\\"b\\\"\",\n \"none\": null,\n \"rows\": [\n  [0.1,1e-8],\n  [2,3]\n ]\n}\n"
        );
        assert_eq!(serde_json::from_str::<Value>(&text).expect("valid"), value);
    }
}
