//! Turns data into JSON and refuses numbers that JSON cannot hold.
//!
//! serde_json writes NaN and infinities as `null`, which an `Option` reads back as "absent": a failed computation
//! would look like a quantity that does not exist. Here the data are walked first, and the first number that is
//! not finite is reported with its place.

use serde::ser::{self, Serialize};
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

impl ser::Error for FiniteError {
    fn custom<T: std::fmt::Display>(message: T) -> Self {
        Self::Serialise { message: message.to_string() }
    }
}

/// The data as JSON, if all numbers are finite.
pub(crate) fn to_value<T: Serialize>(data: &T) -> Result<Value, FiniteError> {
    let mut walk = Walk { place: Vec::new() };
    data.serialize(&mut walk)?;
    serde_json::to_value(data).map_err(ser::Error::custom)
}

enum Step {
    Field(&'static str),
    Key(String),
    Index(usize),
}

/// A serialiser that writes nothing and remembers where it is.
struct Walk {
    place: Vec<Step>,
}

impl Walk {
    fn check(&self, number: f64) -> Result<(), FiniteError> {
        if number.is_finite() {
            return Ok(());
        }
        let mut place = String::new();
        for step in &self.place {
            match step {
                Step::Field(name) => push_name(&mut place, name),
                Step::Key(name) => push_name(&mut place, name),
                Step::Index(index) => place.push_str(&format!("[{index}]")),
            }
        }
        Err(FiniteError::NotFinite { place, number })
    }

    fn visit<T: Serialize + ?Sized>(&mut self, step: Step, value: &T) -> Result<(), FiniteError> {
        self.place.push(step);
        value.serialize(&mut *self)?;
        self.place.pop();
        Ok(())
    }
}

fn push_name(place: &mut String, name: &str) {
    if !place.is_empty() {
        place.push('.');
    }
    place.push_str(name);
}

/// A sequence, map or struct being walked.
struct Members<'a> {
    walk: &'a mut Walk,
    next: usize,
    key: String,
    /// A variant's name was put on the path and has to be taken off again.
    in_variant: bool,
}

impl<'a> Members<'a> {
    fn new(walk: &'a mut Walk) -> Self {
        Self { walk, next: 0, key: String::new(), in_variant: false }
    }

    fn variant(walk: &'a mut Walk, name: &'static str) -> Self {
        walk.place.push(Step::Field(name));
        Self { walk, next: 0, key: String::new(), in_variant: true }
    }

    fn element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), FiniteError> {
        let index = self.next;
        self.next += 1;
        self.walk.visit(Step::Index(index), value)
    }

    fn finish(self) -> Result<(), FiniteError> {
        if self.in_variant {
            self.walk.place.pop();
        }
        Ok(())
    }
}

macro_rules! nothing_to_check {
    ($($method:ident: $type:ty),* $(,)?) => {
        $(fn $method(self, _value: $type) -> Result<(), FiniteError> { Ok(()) })*
    };
}

impl<'a> ser::Serializer for &'a mut Walk {
    type Ok = ();
    type Error = FiniteError;
    type SerializeSeq = Members<'a>;
    type SerializeTuple = Members<'a>;
    type SerializeTupleStruct = Members<'a>;
    type SerializeTupleVariant = Members<'a>;
    type SerializeMap = Members<'a>;
    type SerializeStruct = Members<'a>;
    type SerializeStructVariant = Members<'a>;

    nothing_to_check! {
        serialize_bool: bool, serialize_char: char, serialize_str: &str, serialize_bytes: &[u8],
        serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64,
        serialize_unit_struct: &'static str,
    }

    fn serialize_f32(self, number: f32) -> Result<(), FiniteError> {
        self.check(f64::from(number))
    }

    fn serialize_f64(self, number: f64) -> Result<(), FiniteError> {
        self.check(number)
    }

    fn serialize_none(self) -> Result<(), FiniteError> {
        Ok(())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), FiniteError> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), FiniteError> {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, _: &'static str) -> Result<(), FiniteError> {
        Ok(())
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), FiniteError> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<(), FiniteError> {
        self.visit(Step::Field(variant), value)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Members<'a>, FiniteError> {
        Ok(Members::new(self))
    }

    fn serialize_tuple(self, _: usize) -> Result<Members<'a>, FiniteError> {
        Ok(Members::new(self))
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Members<'a>, FiniteError> {
        Ok(Members::new(self))
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Members<'a>, FiniteError> {
        Ok(Members::variant(self, variant))
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Members<'a>, FiniteError> {
        Ok(Members::new(self))
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Members<'a>, FiniteError> {
        Ok(Members::new(self))
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Members<'a>, FiniteError> {
        Ok(Members::variant(self, variant))
    }
}

macro_rules! elements {
    ($($trait:ident::$method:ident),* $(,)?) => {
        $(impl ser::$trait for Members<'_> {
            type Ok = ();
            type Error = FiniteError;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), FiniteError> {
                self.element(value)
            }

            fn end(self) -> Result<(), FiniteError> {
                self.finish()
            }
        })*
    };
}

elements! {
    SerializeSeq::serialize_element,
    SerializeTuple::serialize_element,
    SerializeTupleStruct::serialize_field,
    SerializeTupleVariant::serialize_field,
}

macro_rules! fields {
    ($($trait:ident),* $(,)?) => {
        $(impl ser::$trait for Members<'_> {
            type Ok = ();
            type Error = FiniteError;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                name: &'static str,
                value: &T,
            ) -> Result<(), FiniteError> {
                self.walk.visit(Step::Field(name), value)
            }

            fn end(self) -> Result<(), FiniteError> {
                self.finish()
            }
        })*
    };
}

fields!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for Members<'_> {
    type Ok = ();
    type Error = FiniteError;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), FiniteError> {
        self.key = match serde_json::to_value(key).map_err(ser::Error::custom)? {
            Value::String(text) => text,
            other => other.to_string(),
        };
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), FiniteError> {
        let key = std::mem::take(&mut self.key);
        self.walk.visit(Step::Key(key), value)
    }

    fn end(self) -> Result<(), FiniteError> {
        self.finish()
    }
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
    }
}
