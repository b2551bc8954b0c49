//! The functions of FMI 3.0, as a master calls them.
//!
//! The standard obliges a master to pass the handles that it was given, and arrays of the stated length;
//! nothing here can check this. Null pointers are errors.

#![allow(unsafe_code, reason = "the interface is one of C")]
#![allow(non_snake_case, reason = "the names are those of the standard")]

use std::ffi::{CStr, CString, c_char, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use bouncing_disk::Motor;

use crate::description::token;
use crate::instance::Instance;
use crate::package::SHEET;

/// fmi3OK and fmi3Error.
const OK: i32 = 0;
const ERROR: i32 = 3;

type Log = unsafe extern "C" fn(*mut c_void, i32, *const c_char, *const c_char);

/// The object that a master knows as an instance.
#[derive(Debug)]
struct Handle {
    instance: Instance,
    log: Logger,
}

#[derive(Debug, Clone, Copy)]
struct Logger {
    log: Option<Log>,
    environment: *mut c_void,
}

impl Logger {
    fn say(self, error: &str) {
        let Some(log) = self.log else { return };
        let text = CString::new(error.replace('\0', " ")).unwrap_or_default();
        // SAFETY: the master's own function, with the environment that belongs to it.
        unsafe { log(self.environment, ERROR, c"logStatusError".as_ptr(), text.as_ptr()) }
    }
}

/// Turns a panic, which must not unwind into C, into an error.
fn caught<T>(call: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(call))
        .unwrap_or_else(|_| Err("an internal error; please report it".to_owned()))
}

/// Calls a method of an instance and writes an error to its log.
unsafe fn with(handle: *mut Handle, call: impl FnOnce(&mut Instance) -> Result<(), String>) -> i32 {
    // SAFETY: null, or a handle of this library that lives.
    let Some(handle) = (unsafe { handle.as_mut() }) else { return ERROR };
    match caught(|| call(&mut handle.instance)) {
        Ok(()) => OK,
        Err(error) => {
            handle.log.say(&error);
            ERROR
        }
    }
}

/// An array passed by the master.
unsafe fn array<'a, T>(start: *const T, count: usize) -> Result<&'a [T], String> {
    match (count, start.is_null()) {
        (0, _) => Ok(&[]),
        (_, true) => Err("an array is a null pointer".to_owned()),
        // SAFETY: the master has so many there.
        _ => Ok(unsafe { std::slice::from_raw_parts(start, count) }),
    }
}

unsafe fn text(start: *const c_char) -> Result<String, String> {
    if start.is_null() {
        return Err("a text is a null pointer".to_owned());
    }
    // SAFETY: the master has a text there that ends with a zero.
    let text = unsafe { CStr::from_ptr(start) };
    text.to_str().map(str::to_owned).map_err(|_| "a text is not UTF-8".to_owned())
}

unsafe fn write<T>(to: *mut T, value: T) {
    if !to.is_null() {
        // SAFETY: the master wants it there.
        unsafe { to.write(value) }
    }
}

/// A folder on this machine, given as a path or, as in FMI 2.0 and by some masters still, as a URI of RFC 8089.
fn folder_of(text: &str) -> Result<PathBuf, String> {
    let Some(address) =
        text.get(..5).filter(|scheme| scheme.eq_ignore_ascii_case("file:")).map(|_| &text[5..])
    else {
        return Ok(PathBuf::from(text));
    };
    let path = match address.strip_prefix("//") {
        None => address,
        Some(rest) => {
            let (host, path) = rest.split_at(rest.find(['/', '\\']).unwrap_or(rest.len()));
            // A drive of Windows that some masters put in the place of the host.
            let is_drive = matches!(host.as_bytes(), [letter, b':'] if letter.is_ascii_alphabetic());
            let path = if is_drive { rest } else { path };
            if !is_drive && !host.is_empty() && !host.eq_ignore_ascii_case("localhost") {
                return Err(format!("the resource path {text} is on another machine: {host}"));
            }
            path
        }
    };
    let decoded = decoded(path).ok_or_else(|| format!("the resource path {text} is not UTF-8"))?;
    // A drive of Windows stands behind the slash.
    let is_drive = matches!(decoded.as_bytes(), [b'/', letter, b':', ..] if letter.is_ascii_alphabetic());
    Ok(PathBuf::from(if is_drive { &decoded[1..] } else { &decoded }))
}

/// The text with codes such as %20 decoded; a percent sign that begins no code stays. `None` if the result is
/// not UTF-8.
fn decoded(text: &str) -> Option<String> {
    let (bytes, mut decoded, mut at) = (text.as_bytes(), Vec::new(), 0);
    while let Some(&byte) = bytes.get(at) {
        let digit = |place: usize| char::from(*bytes.get(place)?).to_digit(16);
        let escaped = digit(at + 1).zip(digit(at + 2)).filter(|_| byte == b'%');
        decoded.push(escaped.map_or(byte, |(high, low)| (16 * high + low) as u8));
        at += if escaped.is_some() { 3 } else { 1 };
    }
    String::from_utf8(decoded).ok()
}

#[unsafe(no_mangle)]
extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateCoSimulation(
    _name: *const c_char,
    instantiation_token: *const c_char,
    resource_path: *const c_char,
    _visible: bool,
    _logging_on: bool,
    _event_mode_used: bool,
    _early_return_allowed: bool,
    _required: *const u32,
    _required_count: usize,
    environment: *mut c_void,
    log: Option<Log>,
    _intermediate_update: *const c_void,
) -> *mut Handle {
    let log = Logger { log, environment };
    let made = caught(|| {
        // SAFETY: texts of the master, by the standard.
        let (given, folder) = unsafe { (text(instantiation_token)?, text(resource_path)?) };
        let path = folder_of(&folder)?.join(SHEET);
        let sheet = std::fs::read_to_string(&path);
        let sheet = sheet.map_err(|error| format!("{} cannot be read: {error}", path.display()))?;
        if token(&sheet) != given {
            return Err(concat!(
                "the instantiation token does not belong to this unit, made by bouncing-disk ",
                env!("CARGO_PKG_VERSION")
            )
            .to_owned());
        }
        let motor = Motor::from_json(&sheet).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Instance::new(&motor))
    });
    match made {
        Ok(instance) => Box::into_raw(Box::new(Handle { instance, log })),
        Err(error) => {
            log.say(&error);
            std::ptr::null_mut()
        }
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3FreeInstance(handle: *mut Handle) {
    if !handle.is_null() {
        // SAFETY: a handle of this library, which the master uses no more.
        drop(unsafe { Box::from_raw(handle) });
    }
}

/// Does nothing: errors are always reported, and there are no other messages.
#[unsafe(no_mangle)]
extern "C" fn fmi3SetDebugLogging(
    _handle: *mut Handle,
    _on: bool,
    _count: usize,
    _categories: *const c_void,
) -> i32 {
    OK
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3EnterInitializationMode(
    handle: *mut Handle,
    _tolerance_defined: bool,
    _tolerance: f64,
    start: f64,
    _stop_defined: bool,
    _stop: f64,
) -> i32 {
    // SAFETY: a handle of the master, as in all that follow.
    unsafe { with(handle, |instance| instance.enter_initialization(start)) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3ExitInitializationMode(handle: *mut Handle) -> i32 {
    // SAFETY: as above.
    unsafe { with(handle, Instance::exit_initialization) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3Terminate(handle: *mut Handle) -> i32 {
    // SAFETY: as above.
    unsafe { with(handle, Instance::terminate) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3Reset(handle: *mut Handle) -> i32 {
    // SAFETY: as above.
    unsafe { with(handle, Instance::reset) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3DoStep(
    handle: *mut Handle,
    point: f64,
    step: f64,
    _no_earlier_state: bool,
    event_needed: *mut bool,
    terminates: *mut bool,
    early_return: *mut bool,
    reached: *mut f64,
) -> i32 {
    let run = |instance: &mut Instance| {
        let last = instance.step(point, step);
        // SAFETY: null, or where the master wants the answer.
        unsafe {
            [event_needed, terminates, early_return].into_iter().for_each(|flag| write(flag, false));
            write(reached, last.clone().unwrap_or(point));
        }
        last.map(|_| ())
    };
    // SAFETY: as above.
    unsafe { with(handle, run) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetFloat64(
    handle: *mut Handle,
    references: *const u32,
    count: usize,
    values: *mut f64,
    value_count: usize,
) -> i32 {
    let read = |instance: &mut Instance| {
        if value_count != count || (values.is_null() && count > 0) {
            return Err(format!(
                "{value_count} values for {count} variables: all variables are scalars, so the two counts must be \
                 equal"
            ));
        }
        // SAFETY: arrays of the master, of these lengths.
        for (index, reference) in unsafe { array(references, count) }?.iter().enumerate() {
            let value = instance.get(*reference)?;
            // SAFETY: within the array.
            unsafe { values.add(index).write(value) };
        }
        Ok(())
    };
    // SAFETY: as above.
    unsafe { with(handle, read) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3SetFloat64(
    handle: *mut Handle,
    references: *const u32,
    count: usize,
    values: *const f64,
    value_count: usize,
) -> i32 {
    let change = |instance: &mut Instance| {
        // SAFETY: arrays of the master, of these lengths.
        let (references, values) = unsafe { (array(references, count)?, array(values, value_count)?) };
        if value_count != count {
            return Err(format!(
                "{value_count} values for {count} variables: all variables are scalars, so the two counts must be \
                 equal"
            ));
        }
        references.iter().zip(values).try_for_each(|(reference, value)| instance.set(*reference, *value))
    };
    // SAFETY: as above.
    unsafe { with(handle, change) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetFMUState(handle: *mut Handle, state: *mut *mut Instance) -> i32 {
    let store = |instance: &mut Instance| {
        // SAFETY: null, or where the master keeps a state: a null pointer, or one of these.
        let place = unsafe { state.as_mut() }.ok_or("the pointer to the state is null")?;
        match unsafe { place.as_mut() } {
            Some(old) => *old = instance.clone(),
            None => *place = Box::into_raw(Box::new(instance.clone())),
        }
        Ok(())
    };
    // SAFETY: as above.
    unsafe { with(handle, store) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3SetFMUState(handle: *mut Handle, state: *mut Instance) -> i32 {
    let restore = |instance: &mut Instance| {
        // SAFETY: null, or a state of this library that lives.
        let state = unsafe { state.as_ref() }.ok_or("the state is a null pointer")?;
        *instance = state.clone();
        Ok(())
    };
    // SAFETY: as above.
    unsafe { with(handle, restore) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3FreeFMUState(_handle: *mut Handle, state: *mut *mut Instance) -> i32 {
    // SAFETY: null, or the place of a state of this library that lives.
    if let Some(place) = unsafe { state.as_mut() }
        && !place.is_null()
    {
        drop(unsafe { Box::from_raw(*place) });
        *place = std::ptr::null_mut();
    }
    OK
}

/// Functions for types that no variable has; for an empty list of variables they do nothing.
macro_rules! of_no_variable {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $name(handle: *mut Handle, _references: *const u32, count: usize) -> i32 {
            // SAFETY: as above.
            unsafe {
                with(handle, |_| if count == 0 { Ok(()) } else { Err("all variables are of the type Float64".to_owned()) })
            }
        }
    )*};
}

of_no_variable! {
    fmi3GetFloat32 fmi3GetInt8 fmi3GetUInt8 fmi3GetInt16 fmi3GetUInt16 fmi3GetInt32 fmi3GetUInt32 fmi3GetInt64
    fmi3GetUInt64 fmi3GetBoolean fmi3GetString fmi3GetBinary fmi3GetClock
    fmi3SetFloat32 fmi3SetInt8 fmi3SetUInt8 fmi3SetInt16 fmi3SetUInt16 fmi3SetInt32 fmi3SetUInt32 fmi3SetInt64
    fmi3SetUInt64 fmi3SetBoolean fmi3SetString fmi3SetBinary fmi3SetClock
}

/// Functions for features that this unit lacks, as its description states; masters look for them nevertheless.
/// The caller removes the other arguments.
macro_rules! not_there {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $name(handle: *mut Handle) -> i32 {
            // SAFETY: as above.
            unsafe { with(handle, |_| Err(concat!(stringify!($name), " is not available, as the description states").to_owned())) }
        }
    )*};
}

not_there! {
    fmi3EnterEventMode fmi3EnterStepMode fmi3EnterConfigurationMode fmi3ExitConfigurationMode
    fmi3GetNumberOfVariableDependencies fmi3GetVariableDependencies
    fmi3SerializedFMUStateSize fmi3SerializeFMUState fmi3DeserializeFMUState
    fmi3GetDirectionalDerivative fmi3GetAdjointDerivative fmi3GetOutputDerivatives
    fmi3GetIntervalDecimal fmi3GetIntervalFraction fmi3GetShiftDecimal fmi3GetShiftFraction
    fmi3SetIntervalDecimal fmi3SetIntervalFraction fmi3SetShiftDecimal fmi3SetShiftFraction
    fmi3EvaluateDiscreteStates fmi3UpdateDiscreteStates
    fmi3EnterContinuousTimeMode fmi3CompletedIntegratorStep fmi3SetTime fmi3SetContinuousStates
    fmi3GetContinuousStateDerivatives fmi3GetEventIndicators fmi3GetContinuousStates
    fmi3GetNominalsOfContinuousStates fmi3GetNumberOfEventIndicators fmi3GetNumberOfContinuousStates
    fmi3ActivateModelPartition
}

/// Functions that create other kinds of units; they return no instance.
macro_rules! of_another_kind {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name() -> *mut Handle {
            std::ptr::null_mut()
        }
    )*};
}

of_another_kind! { fmi3InstantiateModelExchange fmi3InstantiateScheduledExecution }

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resource_paths_are_paths_or_addresses() {
        for (text, folder) in [
            ("/tmp/sp ace/", "/tmp/sp ace/"),
            ("/tmp/100%20/", "/tmp/100%20/"),
            ("resources", "resources"),
            ("file:///tmp/a/resources", "/tmp/a/resources"),
            ("file:///tmp/sp%20ace/", "/tmp/sp ace/"),
            ("file:///tmp/sp ace/", "/tmp/sp ace/"),
            ("file:/tmp/%C3%A4%2B/", "/tmp/\u{e4}+/"),
            ("file://localhost/tmp/a", "/tmp/a"),
            ("FILE://LocalHost/tmp/a", "/tmp/a"),
            ("file:///tmp/100%/%zz%2", "/tmp/100%/%zz%2"),
            ("file:///tmp/%2520", "/tmp/%20"),
            ("file:///C:/Program%20Files/a", "C:/Program Files/a"),
            ("file://C:/Program%20Files/a", "C:/Program Files/a"),
            ("file://c:\\units\\a", "c:\\units\\a"),
        ] {
            assert_eq!(folder_of(text), Ok(PathBuf::from(folder)), "{text}");
        }
        for (text, named) in
            [("file://server/share/a", "server"), ("file://1:/a", "1:"), ("file:///tmp/%ff", "UTF-8")]
        {
            let refused = folder_of(text).expect_err("not a folder of this machine");
            assert!(refused.contains(named) && refused.contains(text), "{refused}");
        }
    }
}
