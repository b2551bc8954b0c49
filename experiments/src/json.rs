//! JSON laid out for reading and for line-wise comparison, and only of numbers that JSON can hold.

use ciborium::Value as Tree;
use serde::Serialize;
use serde_json::Value;

/// Why data cannot be stored as JSON.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FiniteError {
    /// A number is NaN or infinite.
    #[error("{place} is {number}; a number that does not exist must be an absent Option")]
    NotFinite {
        /// The fields and indices that lead to the number: `branches[12].phase`.
        place: String,
        /// The number.
        number: f64,
    },
    /// The data's own serialisation failed, or a map has keys that are not strings.
    #[error("serialisation failed: {message}")]
    Serialise {
        /// What was reported.
        message: String,
    },
}

/// The data as JSON, if all numbers are finite.
///
/// serde_json writes NaN and infinities as `null`, which an `Option` reads back as "absent": a failed
/// computation would look like a quantity that does not exist. CBOR can hold such numbers: the data are made
/// a tree of CBOR first, in which the first number that is not finite is found with its place.
pub(crate) fn to_value<T: Serialize>(data: &T) -> Result<Value, FiniteError> {
    let tree = Tree::serialized(data).map_err(failed)?;
    let mut place = String::new();
    match first_not_finite(&tree, &mut place) {
        Some(number) => Err(FiniteError::NotFinite { place, number }),
        None => serde_json::to_value(&tree).map_err(failed),
    }
}

fn failed(error: impl std::error::Error) -> FiniteError {
    FiniteError::Serialise { message: error.to_string() }
}

/// The first number that is not finite; `place`, which leads to the tree, then leads to the number.
fn first_not_finite(tree: &Tree, place: &mut String) -> Option<f64> {
    let length = place.len();
    let mut inside = |step: String, part: &Tree| {
        place.push_str(&step);
        let found = first_not_finite(part, place);
        if found.is_none() {
            place.truncate(length);
        }
        found
    };
    match tree {
        Tree::Float(number) => (!number.is_finite()).then_some(*number),
        Tree::Array(elements) => {
            elements.iter().enumerate().find_map(|(index, element)| inside(format!("[{index}]"), element))
        }
        Tree::Map(members) => members.iter().find_map(|(key, member)| {
            let name = key.as_text().map_or_else(|| format!("{key:?}"), str::to_owned);
            inside(if length > 0 { format!(".{name}") } else { name }, member)
        }),
        _ => None,
    }
}

/// The text of `value`, ending in a line end: one field per line, rows of numbers on one line, keys in the
/// order of the map (sorted).
pub fn to_text(value: &Value) -> String {
    let mut text = String::new();
    push(&mut text, value, 0);
    text.push('\n');
    text
}

fn push(text: &mut String, value: &Value, depth: usize) {
    let has_parts = |value: &Value| match value {
        Value::Object(members) => !members.is_empty(),
        Value::Array(elements) => !elements.is_empty(),
        _ => false,
    };
    match value {
        Value::Object(members) if !members.is_empty() => {
            let parts = members.iter().map(|(name, member)| (Some(name), member));
            push_lines(text, ['{', '}'], parts, depth);
        }
        Value::Array(elements) if elements.iter().any(has_parts) => {
            push_lines(text, ['[', ']'], elements.iter().map(|element| (None, element)), depth);
        }
        other => text.push_str(&other.to_string()),
    }
}

fn push_lines<'a>(
    text: &mut String,
    [open, close]: [char; 2],
    parts: impl Iterator<Item = (Option<&'a String>, &'a Value)>,
    depth: usize,
) {
    text.push(open);
    for (index, (name, part)) in parts.enumerate() {
        text.push_str(if index > 0 { ",\n" } else { "\n" });
        text.extend(std::iter::repeat_n(' ', depth + 1));
        if let Some(name) = name {
            text.push_str(&format!("{}: ", Value::from(name.as_str())));
        }
        push(text, part, depth + 1);
    }
    text.push('\n');
    text.extend(std::iter::repeat_n(' ', depth));
    text.push(close);
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde_json::json;

    use super::*;

    #[derive(Serialize)]
    enum Attractor {
        Orbit { phases: Vec<f64> },
        Chattering(f64),
    }

    #[test]
    fn the_place_of_a_number_that_is_not_finite_is_named() {
        let branch =
            |attractor, exponent: Option<f64>| BTreeMap::from([("low", vec![(attractor, exponent)])]);
        let orbit = |phase| Attractor::Orbit { phases: vec![0.1, phase] };
        assert!(to_value(&branch(orbit(0.2), None)).is_ok());
        let place_of = |error: Result<Value, FiniteError>| match error {
            Err(FiniteError::NotFinite { place, .. }) => place,
            other => panic!("{other:?}"),
        };
        for (data, place) in [
            (branch(orbit(f64::NAN), Some(1.0)), "low[0][0].Orbit.phases[1]"),
            (branch(Attractor::Chattering(0.5), Some(f64::INFINITY)), "low[0][1]"),
            (branch(Attractor::Chattering(f64::NAN), None), "low[0][0].Chattering"),
        ] {
            assert_eq!(place_of(to_value(&data)), place);
        }
        let nested = Some(BTreeMap::from([("7", [Some(1.0), Some(f64::NAN)])]));
        assert_eq!(place_of(to_value(&nested)), "7[1]");
    }

    #[test]
    fn rows_stay_on_one_line_and_nothing_is_lost() {
        let value = json!({"rows": [[0.1, 1e-8], [2, 3]], "empty": {}, "none": null, "name": "a \"b\""});
        let text = to_text(&value);
        assert_eq!(
            text,
            "{\n \"empty\": {},\n \"name\": \"a \\\"b\\\"\",\n \"none\": null,\n \"rows\": [\n  [0.1,1e-8],\n  [2,3]\n ]\n}\n"
        );
        assert_eq!(serde_json::from_str::<Value>(&text).expect("valid"), value);
        let text = to_text(&json!([[], {}, [[], [1]], {"a": [{}, []]}]));
        assert_eq!(text, "[\n [],\n {},\n [\n  [],\n  [1]\n ],\n {\n  \"a\": [{},[]]\n }\n]\n");
        assert_eq!(to_text(&json!([])), "[]\n");
    }
}
