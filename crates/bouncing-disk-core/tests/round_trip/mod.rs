//! Writing a value, reading it back, and reading illegal values.

use std::fmt::Debug;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

/// Writes and reads a value; then reads it with one key too many or too few in each object, and with each of
/// the `illegal` values at its place (a JSON pointer); then the error must contain the text.
pub(crate) fn check<T: Serialize + DeserializeOwned + PartialEq + Debug>(
    value: &T,
    illegal: &[(&str, Value, &str)],
) {
    let text = serde_json::to_string(value).expect("writes");
    let read: T = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert_eq!(&read, value);
    assert_eq!(serde_json::to_string(&read).expect("writes"), text, "the same bits");
    let mut binary = Vec::new();
    ciborium::into_writer(value, &mut binary).expect("writes");
    assert_eq!(&ciborium::from_reader::<T, _>(&*binary).expect("legal"), value);

    let refusal = |changed: &Value| {
        let error = serde_json::from_value::<T>(changed.clone()).expect_err(&changed.to_string());
        error.to_string()
    };
    let whole = serde_json::to_value(value).expect("writes");
    for place in objects(&whole) {
        let mut changed = whole.clone();
        let Value::Object(own) = changed.pointer_mut(&place).expect("is there").take() else {
            unreachable!("{place}")
        };
        let mut more = own.clone();
        more.insert("unheard_of".to_owned(), json!(1));
        *changed.pointer_mut(&place).expect("is there") = Value::Object(more);
        refusal(&changed);
        // Most keys of a data sheet are optional; its own tests check which.
        let needed = |key: &&String| !OPTIONAL.contains(&key.as_str()) && !place.ends_with("/motor");
        for key in own.keys().filter(needed) {
            let mut less = own.clone();
            less.remove(key);
            *changed.pointer_mut(&place).expect("is there") = Value::Object(less);
            refusal(&changed);
        }
    }
    for (place, bad, complaint) in illegal {
        let mut changed = whole.clone();
        *changed.pointer_mut(place).unwrap_or_else(|| panic!("{place} in {whole}")) = bad.clone();
        let error = refusal(&changed);
        assert!(error.contains(complaint), "{place}: {error}");
    }
}

/// Optional keys: numbers that may not exist, or that have a default.
const OPTIONAL: [&str; 13] = [
    "eventless",
    "estimate",
    "speed_error",
    "separation",
    "speed_ratio",
    "lyapunov_exponent",
    "mean_angular_speed",
    "rotation_repeats",
    "chatter_speed",
    "stall_acceleration",
    "load",
    "load_acceleration",
    "rotary",
];

/// The places of all objects in a value.
fn objects(value: &Value) -> Vec<String> {
    let within = |key: &str, entry: &Value| {
        objects(entry).into_iter().map(|place| format!("/{key}{place}")).collect::<Vec<_>>()
    };
    match value {
        Value::Object(map) => {
            let inner = map.iter().flat_map(|(key, entry)| within(key, entry));
            std::iter::once(String::new()).chain(inner).collect()
        }
        // The elements are alike.
        Value::Array(list) => list
            .iter()
            .enumerate()
            .take(2)
            .flat_map(|(index, entry)| within(&index.to_string(), entry))
            .collect(),
        _ => Vec::new(),
    }
}

/// Checks that a value that JSON cannot store, but a binary format can, is not read back.
pub(crate) fn refused<T: Serialize + DeserializeOwned + Debug>(value: &T, complaint: &str) {
    let mut binary = Vec::new();
    ciborium::into_writer(value, &mut binary).expect("writes");
    let error = ciborium::from_reader::<T, _>(&*binary).expect_err(complaint).to_string();
    assert!(error.contains(complaint), "{error}");
}
