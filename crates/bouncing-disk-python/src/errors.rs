//! From the errors of the library to the exceptions of `bouncing_disk._errors`, with all their numbers.

use bouncing_disk::Error;
use bouncing_disk::core::{Error as CoreError, chaos::NoCrisis};
use bouncing_disk::estimate::{FitError, MeasuredSpeedsError};
use bouncing_disk::motor::MotorFileError;
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

impl Detail {
    /// The text written by `Debug`.
    fn read(text: &str) -> Self {
        let number = || text.parse().map(Self::Number).ok();
        text.parse()
            .map(Self::Count)
            .ok()
            .or_else(number)
            .unwrap_or_else(|| Self::Text(text.trim_matches('"').to_owned()))
    }
}

type Details = Vec<(String, Detail)>;

/// A class of `bouncing_disk._errors` and what it is called with after its message.
enum Raised {
    OutOfRange(String, f64, String),
    TooLarge(&'static str, u64, u64),
    /// Arguments that do not fit together.
    Invalid(String, Details),
    /// The computation itself.
    Computation(String, Details),
    FitRefused,
}

/// The errors that arguments are the reason of which do not fit together.
const INVALID: [&str; 11] = [
    "not-of-kind",
    "no-closed-form",
    "no-decimal",
    "unfitting",
    "not-shared",
    "not-an-orbit",
    "not-given",
    "neither-given",
    "both-given",
    "empty-axis",
    "repeated-axis",
];

/// The kind of an error, which is the library's name of it in small letters, and the numbers that it carries:
/// as they stand in its `Debug`, such as `NoLiftOff { phase: 1.5, peak_acceleration: 0.9 }`.
fn kind_and_details(error: &dyn std::fmt::Debug) -> (String, Details) {
    let text = format!("{error:?}");
    let (name, fields) = text.split_once(" { ").unwrap_or((&text, ""));
    let mut kind = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !kind.is_empty() {
            kind.push('-');
        }
        kind.extend(letter.to_lowercase());
    }
    let (mut details, mut start, mut depth, mut is_quoted) = (Vec::new(), 0, 0, false);
    let fields = fields.strip_suffix(" }").unwrap_or(fields);
    for (place, letter) in fields.char_indices().chain([(fields.len(), ',')]) {
        match letter {
            '"' => is_quoted = !is_quoted,
            '(' | '{' | '[' => depth += 1,
            ')' | '}' | ']' => depth -= 1,
            ',' if depth == 0 && !is_quoted => {
                if let Some((name, value)) = fields[start..place].trim().split_once(": ") {
                    details.push((name.to_owned(), Detail::read(value)));
                }
                start = place + 1;
            }
            _ => {}
        }
    }
    (kind, details)
}

fn owned(details: impl IntoIterator<Item = (&'static str, Detail)>) -> Details {
    details.into_iter().map(|(name, detail)| (name.to_owned(), detail)).collect()
}

fn of_model(error: Error) -> Raised {
    match error {
        Error::OutOfRange { field, value, legal }
        | Error::Core(CoreError::OutOfRange { field, value, legal }) => {
            Raised::OutOfRange(field.to_owned(), value, legal.to_owned())
        }
        Error::Core(CoreError::TooLarge { what, count, limit }) => Raised::TooLarge(what, count, limit),
        error => {
            let (kind, details) = match &error {
                Error::Core(error) => kind_and_details(error),
                error => kind_and_details(error),
            };
            let is_invalid = INVALID.contains(&kind.as_str());
            if is_invalid { Raised::Invalid(kind, details) } else { Raised::Computation(kind, details) }
        }
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

fn dictionary<'py>(py: Python<'py>, details: Details) -> PyResult<Bound<'py, PyDict>> {
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
pub(crate) fn of(py: Python<'_>, error: impl Into<FitError>) -> PyErr {
    let error = error.into();
    let message = error.to_string();
    match error {
        FitError::Model(error) => raise(py, message, of_model(error)),
        _ => raise(py, message, Raised::FitRefused),
    }
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
    // An illegal value of a list comes from the argument that holds the list.
    let containers = ["basins", "transients", "ranges", "axes"];
    spellings
        .into_iter()
        .chain(plurals)
        .chain(ranged.map(|_| "ranges".to_owned()))
        .chain(others.chain(&containers).map(|name| (*name).to_owned()))
        .find(is_given)
}

/// The exception of an error, with the name that the call has for the quantity it is about.
pub(crate) fn of_call(py: Python<'_>, error: impl Into<FitError>, call: &Bound<'_, PyDict>) -> PyErr {
    let error = error.into();
    let FitError::Model(
        Error::OutOfRange { field, value, legal }
        | Error::Core(CoreError::OutOfRange { field, value, legal }),
    ) = error
    else {
        return of(py, error);
    };
    let Some(name) = argument(field, call) else {
        let message = format!("{error}; it follows from several arguments");
        let given = call.iter().filter(|(_, value)| !value.is_none()).map(|(name, _)| name.to_string());
        let arguments = given.filter(|name| name != "self").collect::<Vec<_>>().join(", ");
        let details = [
            ("quantity", Detail::Text(field.to_owned())),
            ("value", Detail::Number(value)),
            ("range", Detail::Text(legal.to_owned())),
            ("arguments", Detail::Text(arguments)),
        ];
        return raise(py, message, Raised::Invalid("out-of-range-together".to_owned(), owned(details)));
    };
    // The caller's number where the library has it in other units, and its range in those of the caller.
    let given = call.get_item(&name).ok().flatten().and_then(|given| given.extract::<f64>().ok());
    match given.filter(|given| given.total_cmp(&value).is_ne()) {
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
    let number = |place: &usize| Detail::Count(*place as u64);
    let details = match error {
        MotorFileError::Illegal(illegal) => return of(py, *illegal),
        MotorFileError::Text { line, column, .. } => {
            vec![("line", number(line)), ("column", number(column))]
        }
        _ => Vec::new(),
    };
    raise(py, error.to_string(), Raised::Invalid("text".to_owned(), owned(details)))
}

/// The exception of measured speeds that cannot be read.
pub(crate) fn of_measured(py: Python<'_>, error: &MeasuredSpeedsError) -> PyErr {
    match error {
        MeasuredSpeedsError::Unreadable { source, .. } => PyOSError::new_err(format!("{error}: {source}")),
        MeasuredSpeedsError::Model(error) => of(py, *error),
        _ => invalid_text(py, error),
    }
}

/// The exception for a text that cannot be read, with this message.
pub(crate) fn invalid_text(py: Python<'_>, error: &dyn std::error::Error) -> PyErr {
    raise(py, error.to_string(), Raised::Invalid("text".to_owned(), Vec::new()))
}

/// The exception of a JSON text that cannot be read.
pub(crate) fn unreadable(py: Python<'_>, error: &serde_json::Error) -> PyErr {
    let details = [("line", error.line()), ("column", error.column())];
    let details = owned(details.map(|(name, place)| (name, Detail::Count(place as u64))));
    raise(py, format!("the text cannot be read: {error}"), Raised::Invalid("text".to_owned(), details))
}

/// A number outside its range, which the types of Rust would not have let through.
pub(crate) fn out_of_range(py: Python<'_>, field: &'static str, value: f64, range: &'static str) -> PyErr {
    of(py, Error::OutOfRange { field, value, legal: range })
}

/// A motion without events that was given no duration, and has no samples.
pub(crate) fn no_events(py: Python<'_>) -> PyErr {
    let message = "the trajectory has no events, because the disk stays on its platform for ever: it ends where it \
                   begins, and there is nothing to sample; give simulate() a duration";
    raise(py, message.to_owned(), Raised::Computation("no-events".to_owned(), Vec::new()))
}

/// Why there is no crisis.
pub(crate) fn no_crisis(py: Python<'_>, reason: &NoCrisis) -> PyErr {
    let (kind, details) = kind_and_details(reason);
    raise(py, format!("there is no crisis: {reason}"), Raised::Computation(kind, details))
}

/// A defect of the library: it has panicked, which nothing that is passed to it may bring about.
pub(crate) fn defect() -> PyErr {
    PyRuntimeError::new_err("a defect of bouncing_disk (a panic, printed above); please report it")
}
