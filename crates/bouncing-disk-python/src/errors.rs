//! From the errors of the library to the exceptions of `bouncing_disk._errors`, with all their numbers.

use std::borrow::Cow;

use bouncing_disk::core::{Error as CoreError, NoCrisis};
use bouncing_disk::{Error, FitError, MeasuredSpeedsError, MotorFileError};
use pyo3::exceptions::{PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple};

use crate::names::{self, Name, Told};

/// The numbers of an error, by their names.
enum Detail {
    Number(f64),
    Count(u64),
    Text(String),
}

impl From<f64> for Detail {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Detail {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<usize> for Detail {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<u32> for Detail {
    fn from(count: u32) -> Self {
        Self::Count(count.into())
    }
}

impl From<&str> for Detail {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

/// A class of `bouncing_disk._errors` and what it is called with after its message.
enum Raised {
    OutOfRange(&'static str, f64, Cow<'static, str>),
    TooLarge(&'static str, u64, u64),
    /// Arguments that do not fit together.
    Invalid(&'static str, Vec<(&'static str, Detail)>),
    /// The computation itself.
    Computation(&'static str, Vec<(&'static str, Detail)>),
    FitRefused,
}

macro_rules! details {
    ($($name:ident),*) => { vec![$((stringify!($name), Detail::from($name))),*] };
}

fn of_core(error: CoreError) -> Raised {
    use Raised::{Computation, Invalid, OutOfRange, TooLarge};
    match error {
        CoreError::OutOfRange { field, value, legal } => OutOfRange(field, value, legal.into()),
        CoreError::TooLarge { what, count, limit } => TooLarge(what, count, limit),
        CoreError::NoLiftOff { phase, peak_acceleration } => {
            Computation("no-lift-off", details![phase, peak_acceleration])
        }
        CoreError::FlightTooLong { relative_speed, duration, limit } => {
            Computation("flight-too-long", details![relative_speed, duration, limit])
        }
        CoreError::NoConvergence { evaluations, time, gap } => {
            Computation("no-convergence", details![evaluations, time, gap])
        }
        CoreError::NotSettled { what, iterations, residual } => {
            Computation("not-settled", details![what, iterations, residual])
        }
        CoreError::NotAttracting { spectral_radius, trace_error } => {
            Computation("not-attracting", details![spectral_radius, trace_error])
        }
        CoreError::NothingProven { region } => Computation("nothing-proven", details![region]),
        CoreError::ImpactWithoutSpeed { index, phase } => {
            Computation("impact-without-speed", details![index, phase])
        }
        CoreError::NoPlatformPeriods { impacts, speed } => {
            Computation("no-platform-periods", details![impacts, speed])
        }
        CoreError::EarlierImpact { index, sought, found } => {
            Computation("earlier-impact", details![index, sought, found])
        }
        CoreError::IllegalRestitution { restitution, impact_speed } => {
            Computation("illegal-restitution", details![restitution, impact_speed])
        }
        CoreError::Stopped { done, total } => Computation("stopped", details![done, total]),
        CoreError::NoBranch { what, parameter } => Computation("no-branch", details![what, parameter]),
        CoreError::NotOfKind { what, index, count, expected } => {
            Invalid("not-of-kind", details![what, index, count, expected])
        }
        CoreError::NoClosedForm => Invalid("no-closed-form", Vec::new()),
        CoreError::NoDecimal { at } => Invalid("no-decimal", details![at]),
        CoreError::Unfitting { what, found, expected } => {
            Invalid("unfitting", details![what, found, expected])
        }
        _ => Computation("other", Vec::new()),
    }
}

fn of_model(error: Error) -> Raised {
    use Raised::{Computation, Invalid, OutOfRange};
    match error {
        Error::Core(error) => of_core(error),
        Error::OutOfRange { field, value, legal } => OutOfRange(field, value, legal.into()),
        Error::NeverLeaves { peak_acceleration } => Computation("never-leaves", details![peak_acceleration]),
        Error::SlipTooLong { duration, limit } => Computation("slip-too-long", details![duration, limit]),
        Error::NotShared { field, one, other } => Invalid("not-shared", details![field, one, other]),
        Error::DoesNotTurn { speed, standard_error } => {
            Computation("does-not-turn", details![speed, standard_error])
        }
        Error::NotSettled { speed, standard_error } => {
            Computation("not-settled", details![speed, standard_error])
        }
        Error::Overpowered { load } => Computation("overpowered", details![load]),
        Error::NotAnOrbit { impact, distance } => Invalid("not-an-orbit", details![impact, distance]),
        Error::TooFewMotors { left, traps, needed } => {
            Computation("too-few-motors", details![left, traps, needed])
        }
        Error::NotGiven { field } => Invalid("not-given", details![field]),
        Error::NeitherGiven { one, other } => Invalid("neither-given", details![one, other]),
        Error::BothGiven { one, other } => Invalid("both-given", details![one, other]),
        Error::EmptyAxis { parameter } => Invalid("empty-axis", details![parameter]),
        Error::RepeatedAxis { parameter } => Invalid("repeated-axis", details![parameter]),
        _ => Computation("other", Vec::new()),
    }
}

/// A class of the module of errors.
fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    MODULE
        .get_or_try_init(py, || Ok::<_, PyErr>(py.import("bouncing_disk._errors")?.unbind()))?
        .bind(py)
        .getattr(name)
}

fn dictionary<'py>(py: Python<'py>, details: Vec<(&'static str, Detail)>) -> PyResult<Bound<'py, PyDict>> {
    let dictionary = PyDict::new(py);
    for (name, detail) in details {
        match detail {
            Detail::Number(number) => dictionary.set_item(name, number)?,
            Detail::Count(count) => dictionary.set_item(name, count)?,
            Detail::Text(text) => dictionary.set_item(name, text)?,
        }
    }
    Ok(dictionary)
}

fn exception(py: Python<'_>, message: String, raised: Raised) -> PyResult<PyErr> {
    let (name, arguments) = match raised {
        Raised::OutOfRange(field, value, range) => {
            ("OutOfRangeError", (message, field, value, range).into_pyobject(py)?)
        }
        Raised::TooLarge(what, count, limit) => {
            ("TooLargeError", (message, what, count, limit).into_pyobject(py)?)
        }
        Raised::Invalid(kind, details) => {
            ("InvalidError", (message, kind, dictionary(py, details)?).into_pyobject(py)?)
        }
        Raised::Computation(kind, details) => {
            ("ComputationError", (message, kind, dictionary(py, details)?).into_pyobject(py)?)
        }
        Raised::FitRefused => ("FitRefusedError", PyTuple::new(py, [message])?),
    };
    Ok(PyErr::from_value(class(py, name)?.call1(arguments)?))
}

fn raise(py: Python<'_>, message: String, raised: Raised) -> PyErr {
    exception(py, message, raised).unwrap_or_else(|error| error)
}

/// The exception of an error of the model or of the core.
pub(crate) fn of(py: Python<'_>, error: impl Into<FitError>) -> PyErr {
    of_named(py, error, &[])
}

/// The same where the library has other names for the arguments.
pub(crate) fn of_named(py: Python<'_>, error: impl Into<FitError>, names: &[Name]) -> PyErr {
    let error = match error.into() {
        FitError::Model(error) => error,
        refused => return raise(py, refused.to_string(), Raised::FitRefused),
    };
    match names::told(&error, names) {
        Some(Told::Argument(field, value, legal)) => {
            // The words of the library for a value and its range, which here need not be its own.
            let message = Error::OutOfRange { field, value, legal: "" }.to_string() + &legal;
            raise(py, message, Raised::OutOfRange(field, value, legal))
        }
        Some(Told::Derived { quantity, value, legal: range, of }) => {
            let arguments = of.join(", ");
            let message = format!("{error}; it follows from {arguments}");
            let details = details![quantity, value, range];
            let details = details.into_iter().chain([("arguments", Detail::Text(arguments))]);
            raise(py, message, Raised::Invalid("out-of-range-together", details.collect()))
        }
        None => raise(py, error.to_string(), of_model(error)),
    }
}

/// The exception of a data sheet that cannot be read.
pub(crate) fn of_motor_file(py: Python<'_>, error: &MotorFileError, names: &[Name]) -> PyErr {
    let number = |line: usize| Detail::Count(line as u64);
    let details = match error {
        MotorFileError::Illegal(illegal) => return of_named(py, *illegal, names),
        MotorFileError::Text { line, column, .. } => {
            vec![("line", number(*line)), ("column", number(*column))]
        }
        _ => Vec::new(),
    };
    raise(py, error.to_string(), Raised::Invalid("text", details))
}

/// The exception of measured speeds that cannot be read.
pub(crate) fn of_measured(py: Python<'_>, error: &MeasuredSpeedsError) -> PyErr {
    match error {
        MeasuredSpeedsError::Unreadable { source, .. } => PyOSError::new_err(format!("{error}: {source}")),
        MeasuredSpeedsError::Model(error) => of(py, *error),
        _ => invalid_text(py, error),
    }
}

/// The exception of a text that means nothing, by what is said of it.
pub(crate) fn invalid_text(py: Python<'_>, error: &dyn std::error::Error) -> PyErr {
    raise(py, error.to_string(), Raised::Invalid("text", Vec::new()))
}

/// The exception of a JSON text that cannot be read.
pub(crate) fn unreadable(py: Python<'_>, error: &serde_json::Error) -> PyErr {
    let (line, column) = (error.line(), error.column());
    raise(py, format!("the text cannot be read: {error}"), Raised::Invalid("text", details![line, column]))
}

/// The exception of what is no text at all: half of a pair of surrogates is in it.
pub(crate) fn no_unicode(py: Python<'_>, position: usize) -> PyErr {
    let message = format!("the text cannot be read: its character {position} is none of Unicode");
    raise(py, message, Raised::Invalid("text", details![position]))
}

/// A number outside its range, which the types of Rust would not have let through.
pub(crate) fn out_of_range(py: Python<'_>, field: &'static str, value: f64, range: &'static str) -> PyErr {
    of(py, Error::OutOfRange { field, value, legal: range })
}

/// A motion without events that was given no duration, and has no samples.
pub(crate) fn no_events(py: Python<'_>) -> PyErr {
    let message = "the trajectory has no events, because the disk stays on its platform for ever: it ends where it \
                   begins, and there is nothing to sample; give simulate() a duration";
    raise(py, message.to_owned(), Raised::Computation("no-events", Vec::new()))
}

/// Why there is no crisis.
pub(crate) fn no_crisis(py: Python<'_>, reason: &NoCrisis) -> PyErr {
    let (kind, details) = match *reason {
        NoCrisis::NotBorn { forcing, birth } => ("not-born", details![forcing, birth]),
        NoCrisis::NotFollowed { forcing, reached } => ("not-followed", details![forcing, reached]),
        NoCrisis::NoneRests { forcing, samples, impacts } => {
            ("none-rests", details![forcing, samples, impacts])
        }
        NoCrisis::RestsBefore { forcing, life } => ("rests-before", details![forcing, life]),
        NoCrisis::NotChaotic { forcing, exponent } => ("not-chaotic", details![forcing, exponent]),
        NoCrisis::LivesDoNotShrink { forcing, near, far } => {
            ("lives-do-not-shrink", details![forcing, near, far])
        }
        NoCrisis::OtherReason { bracket: (low, high), .. } => ("other-reason", details![low, high]),
        _ => ("other", Vec::new()),
    };
    raise(py, format!("there is no crisis: {reason}"), Raised::Computation(kind, details))
}

/// A defect of the library: it has panicked, which nothing that is passed to it may bring about.
pub(crate) fn defect() -> PyErr {
    PyRuntimeError::new_err("a defect of bouncing_disk (a panic, printed above); please report it")
}
