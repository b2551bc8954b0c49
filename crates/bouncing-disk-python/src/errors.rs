//! Converts the errors of the library to the exceptions of `bouncing_disk._errors`, with all their numbers.

use bouncing_disk::Error;
use bouncing_disk::core::Error as CoreError;
use bouncing_disk::estimate::{FitError, MeasuredSpeedsError};
use bouncing_disk::motor::MotorFileError;
use pyo3::call::PyCallArgs;
use pyo3::exceptions::{PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{IntoPyDict, PyDict, PyMapping};
use pythonize::pythonize;
use serde::Serialize;

/// The exception of a class of the module of errors.
fn raise<'py>(py: Python<'py>, class: &str, arguments: impl PyCallArgs<'py>) -> PyErr {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let import = || Ok::<_, PyErr>(py.import("bouncing_disk._errors")?.unbind());
    let made = MODULE
        .get_or_try_init(py, import)
        .and_then(|module| module.bind(py).getattr(class)?.call1(arguments));
    made.map_or_else(|failure| failure, PyErr::from_value)
}

/// The errors caused by arguments that do not fit together.
const INVALID: [&str; 23] = [
    "not-of-kind",
    "no-closed-form",
    "no-decimal",
    "unfitting",
    "not-shared",
    "not-an-orbit",
    "not-given",
    "neither-given",
    "both-given",
    "lengths",
    "no-force-per-volt",
    "switched-motion",
    "empty-axis",
    "repeated-axis",
    "waveform",
    "waveform-jump",
    "drive-not-sine",
    "start-phase",
    "no-such-number",
    "yielding-stator",
    "soft-contact",
    "load-law",
    "load-in-time",
];

/// The kind of an error, its name in the library in small letters, and its numbers.
fn kind_and_details<'py>(py: Python<'py>, error: &impl Serialize) -> PyResult<(String, Bound<'py, PyDict>)> {
    let given = pythonize(py, error)?;
    // An error without numbers is only the kind.
    let Ok(given) = given.cast::<PyDict>() else { return Ok((given.extract()?, PyDict::new(py))) };
    let (kind, details) = given.items().get_item(0)?.extract()?;
    Ok((kind, details))
}

/// The exception of an error by its kind.
pub(crate) fn of_kind(py: Python<'_>, message: String, error: &impl Serialize) -> PyErr {
    match kind_and_details(py, error) {
        Ok((kind, details)) => {
            let is_invalid = INVALID.contains(&kind.as_str());
            let class = if is_invalid { "InvalidError" } else { "ComputationError" };
            raise(py, class, (message, kind, details))
        }
        Err(failure) => failure,
    }
}

/// The exception of an error that no argument of a call can cause.
pub(crate) fn of(py: Python<'_>, error: impl Into<FitError>) -> PyErr {
    let error = error.into();
    let message = error.to_string();
    match error {
        FitError::Model(
            Error::OutOfRange { field, value, legal }
            | Error::Core(CoreError::OutOfRange { field, value, legal }),
        ) => out_of_range(py, field, value, legal),
        FitError::Model(Error::Core(CoreError::TooLarge { what, count, limit })) => {
            raise(py, "TooLargeError", (message, what, count, limit))
        }
        FitError::Model(Error::Core(error)) => of_kind(py, message, &error),
        FitError::Model(error) => of_kind(py, message, &error),
        _ => raise(py, "FitRefusedError", (message,)),
    }
}

/// Arguments whose names do not follow from the library's names.
const ARGUMENTS: [(&str, &[&str]); 22] = [
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
];

/// The argument of a call for a quantity of the library: `longest period`, `points of a branch` and
/// `number of ranges` are `longest_period`, `max_points` and `ranges`. `None` if the quantity follows from several
/// arguments.
fn argument(quantity: &'static str, call: &Bound<'_, PyDict>) -> Option<String> {
    // A table `load` is not a number: a load outside its range is a torque.
    let is_given = |name: &String| {
        let given = call.get_item(name.as_str()).ok().flatten();
        given.is_some_and(|given| name != "load" || given.extract::<f64>().is_ok())
    };
    let head = quantity.strip_prefix("number of ").unwrap_or(quantity);
    let marks = [" (", " of ", " from ", " beyond ", " below ", " in periods", " along an axis"];
    let cut = marks.iter().filter_map(|mark| head.find(mark)).min();
    let head = head[..cut.unwrap_or(head.len())].replace(' ', "_");
    // The restitution of the map, which is not an argument of its methods.
    if quantity.starts_with("restitution of ") {
        return Some(head);
    }
    // A field of a table, such as `stator.mass`, is named in full; `contact.time` may be a separate argument.
    let is_table =
        |name| call.get_item(name).ok().flatten().is_some_and(|own| own.cast::<PyMapping>().is_ok());
    if head.split_once('.').is_some_and(|(table, _)| is_table(table)) && quantity.ends_with(&head) {
        return Some(head);
    }
    let head = head.replace('.', "_");
    let spellings = ["", "max_"].map(|prefix| format!("{prefix}{head}"));
    let plurals = ["s", "_torque", "_torques"].map(|suffix| format!("{head}{suffix}"));
    let others = ARGUMENTS.iter().filter(|(library, _)| *library == head).flat_map(|(_, names)| *names);
    let ranged = call.get_item("ranges").ok().flatten().filter(|all| all.contains(&head).unwrap_or(false));
    // An illegal value of one of many items comes from the argument that contains them.
    let containers = ["basins", "ranges", "over"];
    spellings
        .into_iter()
        .chain(plurals)
        .chain(ranged.map(|_| "ranges".to_owned()))
        .chain(others.chain(&containers).map(|name| (*name).to_owned()))
        .find(is_given)
}

/// The exception of an error, with the call's name for its quantity.
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
        let message = format!("{error}; this quantity follows from several arguments");
        return together(message, field, value, legal, call).unwrap_or_else(|failure| failure);
    };
    // The caller's number if the library uses other units, and its range in the caller's units.
    let given = call.get_item(&name).ok().flatten().and_then(|given| given.extract::<f64>().ok());
    match given.filter(|given| given.total_cmp(&value).is_ne()) {
        Some(given) => {
            let legal = in_unit(legal, given / value, unit(&name)).unwrap_or(legal.to_owned());
            out_of_range(py, &name, given, &legal)
        }
        None => out_of_range(py, &name, value, legal),
    }
}

/// The exception of a quantity that follows from several arguments.
fn together(
    message: String,
    quantity: &str,
    value: f64,
    legal: &str,
    call: &Bound<'_, PyDict>,
) -> PyResult<PyErr> {
    let given = call.iter().filter(|(_, value)| !value.is_none()).map(|(name, _)| name.to_string());
    let arguments = given.filter(|name| name != "self").collect::<Vec<_>>().join(", ");
    let details = [("quantity", quantity), ("range", legal), ("arguments", arguments.as_str())]
        .into_py_dict(call.py())?;
    details.set_item("value", value)?;
    Ok(raise(call.py(), "InvalidError", (message, "out-of-range-together", details)))
}

/// The unit of an argument that the library converts.
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

/// An interval such as `(0, 1e17] (units of g/omega^2)` in another unit, where the library's unit is `one`;
/// `None` for other words. Six digits show which end is exceeded.
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

/// The exception of a number outside its range, in the words of the library.
pub(crate) fn out_of_range(py: Python<'_>, field: &str, value: f64, legal: &str) -> PyErr {
    // The library words an interval and a condition differently.
    let bracket = if legal.starts_with(['[', '(']) { "[" } else { "" };
    let words = Error::OutOfRange { field: "", value, legal: bracket }.to_string();
    let words = words.strip_suffix(bracket).unwrap_or(&words);
    raise(py, "OutOfRangeError", (format!("{field}{words}{legal}"), field, value, legal))
}

/// The exception of a text that cannot be read, with line and column where they are known.
pub(crate) fn of_text(py: Python<'_>, message: String, place: Option<(usize, usize)>) -> PyErr {
    let place = place.map_or(vec![], |(line, column)| vec![("line", line), ("column", column)]);
    match place.into_py_dict(py) {
        Ok(place) => raise(py, "InvalidError", (message, "text", place)),
        Err(failure) => failure,
    }
}

/// The exception of a data sheet that cannot be read.
pub(crate) fn of_motor_file(py: Python<'_>, error: &MotorFileError) -> PyErr {
    match error {
        MotorFileError::Illegal(illegal) => of(py, *illegal),
        MotorFileError::Text { line, column, .. } => of_text(py, error.to_string(), Some((*line, *column))),
        _ => of_text(py, error.to_string(), None),
    }
}

/// The exception of measured speeds that cannot be read.
pub(crate) fn of_measured(py: Python<'_>, error: &MeasuredSpeedsError) -> PyErr {
    match error {
        MeasuredSpeedsError::Unreadable { source, .. } => PyOSError::new_err(format!("{error}: {source}")),
        MeasuredSpeedsError::Model(error) => of(py, *error),
        _ => of_text(py, error.to_string(), None),
    }
}

/// A motion without events that was given no duration, and has no samples.
pub(crate) fn no_events(py: Python<'_>) -> PyErr {
    let message = "the disk stays on its platform for ever, so the trajectory has no events, ends where it begins \
                   and cannot be sampled; give simulate() a duration";
    raise(py, "ComputationError", (message, "no-events", PyDict::new(py)))
}

/// A defect of the library: a panic, which no argument should cause.
pub(crate) fn defect() -> PyErr {
    PyRuntimeError::new_err("a defect of bouncing_disk (a panic, printed above); please report it")
}
