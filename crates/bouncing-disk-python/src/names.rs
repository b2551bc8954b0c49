//! What the library calls a value that it refuses, and what the caller of Python has called it.
//!
//! An [`OutOfRangeError`](crate::errors) names an argument of the call and the value that was given. So each
//! call says which of the library's names are not its own: another word, a value in other units, or a
//! quantity that follows from several arguments, none of which is outside of its range by itself.

use std::borrow::Cow;

use bouncing_disk::Error;
use bouncing_disk::core::Error as CoreError;

/// One of the library's names.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Name {
    /// As the library says it.
    library: &'static str,
    /// The argument, or all that the quantity follows from.
    arguments: &'static [&'static str],
    /// Whether it is a quantity that follows from them.
    is_derived: bool,
    /// What the caller gave, where that is another number.
    given: Option<f64>,
    /// The range of the argument, where that is another one.
    legal: Option<&'static str>,
    /// What the library has as one, in the unit of the argument, and that unit.
    unit: Option<(f64, &'static str)>,
    /// The library's range, where the same name stands for several things.
    only: Option<&'static str>,
}

/// The argument that the library calls otherwise.
pub(crate) const fn name(library: &'static str, argument: &'static [&'static str; 1]) -> Name {
    Name { library, arguments: argument, is_derived: false, given: None, legal: None, unit: None, only: None }
}

/// A quantity of the library that follows from these arguments.
pub(crate) const fn derived(library: &'static str, arguments: &'static [&'static str]) -> Name {
    Name { library, arguments, is_derived: true, given: None, legal: None, unit: None, only: None }
}

impl Name {
    /// As the library says it.
    pub(crate) const fn library(&self) -> &'static str {
        self.library
    }

    /// The number that the caller gave.
    pub(crate) const fn given(self, value: f64) -> Self {
        Self { given: Some(value), ..self }
    }

    /// The range in the words of the argument.
    pub(crate) const fn legal(self, range: &'static str) -> Self {
        Self { legal: Some(range), ..self }
    }

    /// The unit of the argument, and what the library has as one in it: a value and its range are told in
    /// this.
    pub(crate) const fn unit(self, one: f64, unit: &'static str) -> Self {
        Self { unit: Some((one, unit)), ..self }
    }

    /// The library's range in the words of the argument.
    fn range(&self, library: &'static str) -> Cow<'static, str> {
        match (self.legal, self.unit) {
            (Some(legal), _) => legal.into(),
            (None, Some((one, unit))) => in_unit(library, one, unit).map_or(library.into(), Cow::Owned),
            (None, None) => library.into(),
        }
    }

    /// The same of a quantity whose parameters are values in one argument.
    pub(crate) const fn of_values_in(self, argument: &'static [&'static str; 1]) -> Self {
        Self { arguments: argument, ..self }
    }

    /// Only where the library gives this range.
    pub(crate) const fn only(self, range: &'static str) -> Self {
        Self { only: Some(range), ..self }
    }

    /// Whether it is the name of this value.
    fn is_of(&self, field: &str, legal: &str) -> bool {
        self.library == field && self.only.is_none_or(|only| only == legal)
    }
}

/// An interval such as `(0, 1e17] (units of g/omega^2)` in another unit, of which the library's is `one`;
/// `None` of what is no interval of two numbers. Six digits are enough to see which end is passed.
fn in_unit(interval: &str, one: f64, unit: &str) -> Option<String> {
    let (low, rest) = interval.split_once(", ")?;
    let (high, _) = rest.split_at(rest.find([']', ')'])?);
    let opens = low.get(..1).filter(|bracket| ["[", "("].contains(bracket))?;
    let closes = &rest[high.len()..=high.len()];
    let end = |text: &str| {
        let rounded = format!("{:.5e}", text.parse::<f64>().ok()? * one);
        let text = format!("{:?}", rounded.parse::<f64>().ok()?);
        Some(text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned))
    };
    Some(format!("{opens}{}, {}{closes} {unit}", end(&low[1..])?, end(high)?))
}

/// What an error says of a value outside of its range.
#[derive(Debug)]
pub(crate) enum Told {
    /// Of one argument: its name, its value and its range.
    Argument(&'static str, f64, Cow<'static, str>),
    /// Of what follows from several.
    Derived { quantity: &'static str, value: f64, legal: &'static str, of: &'static [&'static str] },
}

/// The value outside of its range that an error is about, by these names.
pub(crate) fn told(error: &Error, names: &[Name]) -> Option<Told> {
    let (field, value, legal) = match *error {
        Error::OutOfRange { field, value, legal }
        | Error::Core(CoreError::OutOfRange { field, value, legal }) => (field, value, legal),
        _ => return None,
    };
    let Some(name) = names.iter().find(|name| name.is_of(field, legal)) else {
        return Some(Told::Argument(field, value, legal.into()));
    };
    Some(match *name.arguments {
        [argument] if !name.is_derived => {
            Told::Argument(argument, name.given.unwrap_or(value), name.range(legal))
        }
        _ => Told::Derived { quantity: field, value, legal, of: name.arguments },
    })
}

/// Errors of one item of many, by the names that its arguments have.
pub(crate) trait Named<T> {
    /// The same with the name and the value of an argument.
    fn named(self, names: &[Name]) -> Result<T, Error>;
}

impl<T, E: Into<Error>> Named<T> for Result<T, E> {
    fn named(self, names: &[Name]) -> Result<T, Error> {
        self.map_err(|error| {
            let error = error.into();
            match told(&error, names) {
                Some(Told::Argument(field, value, Cow::Borrowed(legal))) => {
                    Error::OutOfRange { field, value, legal }
                }
                _ => error,
            }
        })
    }
}
