//! Turns data into JSON and refuses numbers that JSON cannot hold.
//!
//! serde_json writes NaN and infinities as `null`, which an `Option` reads back as "absent": a failed computation
//! would look like a quantity that does not exist. CBOR can hold such numbers: the data are made a tree of CBOR first, in
//! which the first number that is not finite is found with its place. (A serialiser that keeps the path of an error,
//! `serde_path_to_error`, would lose it within every `Option`.)

use ciborium::Value as Tree;
use serde::Serialize;
use serde_json::Value;

/// Why data cannot be stored as JSON.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
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

impl From<serde_json::Error> for FiniteError {
    fn from(error: serde_json::Error) -> Self {
        failed(error)
    }
}

fn failed(error: impl std::error::Error) -> FiniteError {
    FiniteError::Serialise { message: error.to_string() }
}

/// The data as JSON, if all numbers are finite.
pub(crate) fn to_value<T: Serialize>(data: &T) -> Result<Value, FiniteError> {
    let mut place = String::new();
    match first_not_finite(&Tree::serialized(data).map_err(failed)?, &mut place) {
        Some(number) => Err(FiniteError::NotFinite { place, number }),
        None => serde_json::to_value(data).map_err(failed),
    }
}

/// The first number that is not finite; `place`, which leads to the tree, then leads to the number.
fn first_not_finite(tree: &Tree, place: &mut String) -> Option<f64> {
    let length = place.len();
    match tree {
        Tree::Float(number) if !number.is_finite() => return Some(*number),
        Tree::Array(elements) => {
            for (index, element) in elements.iter().enumerate() {
                place.push_str(&format!("[{index}]"));
                if let Some(number) = first_not_finite(element, place) {
                    return Some(number);
                }
                place.truncate(length);
            }
        }
        Tree::Map(members) => {
            for (key, member) in members {
                if length > 0 {
                    place.push('.');
                }
                match key {
                    Tree::Text(name) => place.push_str(name),
                    Tree::Integer(number) => place.push_str(&i128::from(*number).to_string()),
                    other => place.push_str(&format!("{other:?}")),
                }
                if let Some(number) = first_not_finite(member, place) {
                    return Some(number);
                }
                place.truncate(length);
            }
        }
        _ => {}
    }
    None
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde::Serialize;

    use super::*;

    #[derive(Serialize)]
    enum Attractor {
        Orbit { phases: Vec<f64> },
        Chattering(f64),
    }

    #[derive(Serialize)]
    struct Branch {
        name: &'static str,
        attractor: Attractor,
        exponent: Option<f64>,
    }

    fn place_of(error: FiniteError) -> String {
        match error {
            FiniteError::NotFinite { place, .. } => place,
            other => panic!("{other}"),
        }
    }

    #[test]
    fn the_place_of_a_number_that_is_not_finite_is_named() {
        let mut branches = BTreeMap::new();
        let attractor = Attractor::Orbit { phases: vec![0.1, 0.2] };
        branches.insert("low", vec![Branch { name: "one", attractor, exponent: None }]);
        assert!(to_value(&branches).is_ok());
        let attractor = Attractor::Orbit { phases: vec![0.1, f64::NAN] };
        branches.insert("low", vec![Branch { name: "one", attractor, exponent: Some(1.0) }]);
        let error = to_value(&branches).expect_err("a phase is NaN");
        assert_eq!(place_of(error), "low[0].attractor.Orbit.phases[1]");
        let attractor = Attractor::Chattering(0.5);
        branches.insert("low", vec![Branch { name: "one", attractor, exponent: Some(f64::INFINITY) }]);
        assert_eq!(place_of(to_value(&branches).expect_err("infinite")), "low[0].exponent");
        let attractor = Attractor::Chattering(f64::NAN);
        branches.insert("low", vec![Branch { name: "one", attractor, exponent: None }]);
        let place = place_of(to_value(&branches).expect_err("NaN in a variant"));
        assert_eq!(place, "low[0].attractor.Chattering");
        let nested = Some(BTreeMap::from([(7, [Some(1.0), Some(f64::NAN)])]));
        assert_eq!(place_of(to_value(&nested).expect_err("NaN in an Option")), "7[1]");
    }
}
