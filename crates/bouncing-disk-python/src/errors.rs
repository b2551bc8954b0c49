//! From the errors of the library to the exceptions of `bouncing_disk._errors`, with all their numbers.

use bouncing_disk::core::{Error as CoreError, NoCrisis};
use bouncing_disk::{Error, MeasuredSpeedsError, MotorFileError};
use pyo3::exceptions::{PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple};

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
    OutOfRange(String, f64, String),
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
        CoreError::OutOfRange { field, value, legal } => {
            OutOfRange(field.to_owned(), value, legal.to_owned())
        }
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
    use Raised::{Computation, FitRefused, Invalid, OutOfRange};
    match error {
        Error::Core(error) => of_core(error),
        Error::OutOfRange { field, value, legal } => OutOfRange(field.to_owned(), value, legal.to_owned()),
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
        Error::FitRefused { .. } => FitRefused,
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

/// The exception of an error that no argument of a call can be the reason of.
pub(crate) fn of(py: Python<'_>, error: impl Into<Error>) -> PyErr {
    let error = error.into();
    raise(py, error.to_string(), of_model(error))
}

/// Arguments whose names do not follow from what the library calls them.
const ARGUMENTS: [(&str, &[&str]); 23] = [
    ("phase", &["impact_phase"]),
    ("period", &["impact_phase"]),
    ("impacts", &["impact_phase"]),
    ("impact_phase", &["phase_range"]),
    ("lowest_normalised_speed", &["speed_range"]),
    ("highest_normalised_speed", &["speed_range"]),
    ("attraction_radius", &["known_orbits"]),
    ("relative_speed", &["relative_velocity"]),
    ("distance", &["reach", "distances", "beyond"]),
    ("axial_forcing", &["beyond"]),
    ("parameter", &["parameter_range"]),
    ("low_end", &["parameter_range"]),
    ("high_end", &["parameter_range"]),
    ("forcing", &["axial_forcing"]),
    ("multiplier", &["inside", "orbit"]),
    ("real_part", &["inside", "orbit"]),
    ("starts_along_the_phase", &["phases"]),
    ("starts_along_the_speed", &["speeds"]),
    ("loads", &["load_torques"]),
    ("load_acceleration", &["load_torque", "load_torques"]),
    ("points", &["times"]),
    ("cells_along_a_box", &["box_side"]),
    ("fitted_parameters", &["ranges"]),
];

/// The argument of a call that a quantity of the library is about: `longest period`, `points of a branch` and
/// `number of ranges` are `longest_period`, `max_points` and `ranges`. `None` if it follows from several.
fn argument(quantity: &'static str, call: &Bound<'_, PyDict>) -> Option<String> {
    let is_given = |name: &String| call.contains(name.as_str()).unwrap_or(false);
    let head = quantity.strip_prefix("number of ").unwrap_or(quantity);
    let marks = [" (", " of ", " from ", " beyond ", " below ", " in periods", " along an axis"];
    let cut = marks.iter().filter_map(|mark| head.find(mark)).min();
    let head = head[..cut.unwrap_or(head.len())].replace(' ', "_");
    // That of the map, which is no argument of its methods.
    if quantity.starts_with("restitution of ") {
        return Some(head);
    }
    let spellings = ["", "max_"].map(|prefix| format!("{prefix}{head}"));
    let plurals = ["s", "_torque", "_torques"].map(|suffix| format!("{head}{suffix}"));
    let others = ARGUMENTS.iter().filter(|(library, _)| *library == head).flat_map(|(_, names)| *names);
    let ranged = call.get_item("ranges").ok().flatten().filter(|all| all.contains(&head).unwrap_or(false));
    // What is illegal of one of many comes from the argument that holds them.
    let containers = ["basins", "transients", "ranges", "axes"];
    spellings
        .into_iter()
        .chain(plurals)
        .chain(ranged.map(|_| "ranges".to_owned()))
        .chain(others.chain(&containers).map(|name| (*name).to_owned()))
        .find(is_given)
}

/// The exception of an error, with the name that the call has for the quantity it is about.
pub(crate) fn of_call(py: Python<'_>, error: Error, call: &Bound<'_, PyDict>) -> PyErr {
    let (Error::OutOfRange { field, value, legal }
    | Error::Core(CoreError::OutOfRange { field, value, legal })) = error
    else {
        return of(py, error);
    };
    let Some(name) = argument(field, call) else {
        let message = format!("{error}; it follows from several arguments");
        let given = call.iter().filter(|(_, value)| !value.is_none()).map(|(name, _)| name.to_string());
        let arguments = given.filter(|name| name != "self").collect::<Vec<_>>().join(", ");
        let (quantity, range, arguments) = (field, legal, arguments.as_str());
        let details = details![quantity, value, range, arguments];
        return raise(py, message, Raised::Invalid("out-of-range-together", details));
    };
    // The caller's number where the library has it in other units, and its range in those of the caller.
    let given = call.get_item(&name).ok().flatten().and_then(|given| given.extract::<f64>().ok());
    match given.filter(|given| *given != value) {
        Some(given) => {
            let legal = in_unit(legal, given / value, unit(&name)).unwrap_or(legal.to_owned());
            named(py, &name, given, &legal)
        }
        None => named(py, &name, value, legal),
    }
}

/// The unit of an argument that the library has in another one.
fn unit(argument: &str) -> &'static str {
    match argument {
        "gap" => " m",
        "relative_velocity" => " m/s",
        "angular_speed" => " rad/s",
        "duration" => " s",
        "load_torque" => " N m",
        _ => "",
    }
}

/// An interval such as `(0, 1e17] (units of g/omega^2)` in another unit, of which the library's is `one`;
/// `None` of what is no interval of two numbers. Six digits are enough to see which end is passed.
fn in_unit(interval: &str, one: f64, unit: &str) -> Option<String> {
    let (low, rest) = interval.split_once(", ")?;
    let (high, _) = rest.split_at(rest.find([']', ')'])?);
    let opens = low.get(..1).filter(|bracket| one.is_normal() && ["[", "("].contains(bracket))?;
    let end = |text: &str| {
        let rounded = format!("{:.5e}", text.parse::<f64>().ok()? * one);
        let text = format!("{:?}", rounded.parse::<f64>().ok()?);
        Some(text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned))
    };
    let closes = &rest[high.len()..=high.len()];
    Some(format!("{opens}{}, {}{closes}{unit}", end(&low[1..])?, end(high)?))
}

/// The exception of an argument outside its range.
pub(crate) fn named(py: Python<'_>, field: &str, value: f64, legal: &str) -> PyErr {
    // The words of the library for a value and its range.
    let message = Error::OutOfRange { field: "", value, legal: "" }.to_string();
    let message = format!("{field}{message}{legal}");
    raise(py, message, Raised::OutOfRange(field.to_owned(), value, legal.to_owned()))
}

/// The exception of a data sheet that cannot be read.
pub(crate) fn of_motor_file(py: Python<'_>, error: &MotorFileError) -> PyErr {
    let number = |line: usize| Detail::Count(line as u64);
    let details = match error {
        MotorFileError::Illegal { error: illegal, .. } => return of(py, *illegal),
        MotorFileError::Syntax { line, column, .. } => {
            vec![("line", number(*line)), ("column", number(*column))]
        }
        MotorFileError::UnknownKey { key, line, .. } => {
            vec![("field", Detail::Text(key.clone())), ("line", number(*line))]
        }
        MotorFileError::Repeated { key, line, .. } | MotorFileError::NotANumber { key, line, .. } => {
            vec![("field", (*key).into()), ("line", number(*line))]
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
