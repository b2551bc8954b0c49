//! The errors of this crate.

/// An error of the model. Every variant carries the numbers needed to see why it occurred.
///
/// Messages print numbers with all their digits, very small or large ones in scientific notation, and counts
/// without a fraction.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Error {
    /// A parameter or an argument lies outside its legal range.
    #[error("{}", bouncing_disk_core::Error::OutOfRange { field, value: *value, legal })]
    OutOfRange {
        /// The name of the parameter.
        field: &'static str,
        /// The value that was given.
        value: f64,
        /// The legal range, in words.
        legal: &'static str,
    },
    /// The disk never leaves the platform, whose peak acceleration does not exceed the preload acceleration.
    #[error(
        "the disk never leaves the platform: its peak acceleration is {peak_acceleration:?} g, not above 1 g"
    )]
    NeverLeaves {
        /// Peak acceleration of the platform in units of the preload acceleration.
        peak_acceleration: f64,
    },
    /// A segment of sliding lasts so long that its end cannot be resolved.
    #[error("the disk slides for {duration:?} rad, more than the limit of {limit:?} rad")]
    SlipTooLong {
        /// Estimated duration in radians.
        duration: f64,
        /// The largest duration that can be resolved, in radians.
        limit: f64,
    },
    /// Rotors that are to share one vertical motion differ in a quantity that affects it.
    #[error("rotors that share one vertical motion must have the same {field}, not {one:?} and {other:?}")]
    NotShared {
        /// The quantity that must be equal.
        field: &'static str,
        /// Its value for the first rotor.
        one: f64,
        /// Its value for another rotor.
        other: f64,
    },
    /// A quantity of a turning motor was requested, but the motor does not turn.
    #[error(
        "the motor does not turn: its mean speed is {speed:?} rad/s with a standard error of {standard_error:?} rad/s"
    )]
    DoesNotTurn {
        /// Mean speed (rad/s).
        speed: f64,
        /// Its standard error (rad/s).
        standard_error: f64,
    },
    /// A mean speed did not reach the requested accuracy within the allowed number of impacts.
    #[error(
        "the mean speed, {speed:?} rad/s, has a standard error of {standard_error:?} rad/s, more than requested: \
         allow more impacts, or a larger error"
    )]
    NotSettled {
        /// Mean speed (rad/s).
        speed: f64,
        /// Its standard error (rad/s).
        standard_error: f64,
    },
    /// The load accelerates a motor for ever at every searched point.
    #[error("the load torque of {load:?} m g a_e exceeds the largest mean friction torque")]
    Overpowered {
        /// Load torque in units of m g a_e.
        load: f64,
    },
    /// No point of the searched ranges satisfies the bounds.
    #[error("no point of the ranges is certain to satisfy the bound {quantity} {} {bound:?}: the nearest value is \
             {nearest:?}", if *is_least { ">=" } else { "<=" })]
    NotKept {
        /// The quantity that violates its bound most at the point that comes closest to satisfying all
        /// bounds.
        quantity: &'static str,
        /// Whether the bound is a lower one.
        is_least: bool,
        /// The bound.
        bound: f64,
        /// The quantity's value at that point.
        nearest: f64,
    },
    /// A quantity to be maximised is not known to be positive anywhere.
    #[error("{quantity} is not certain to be positive anywhere in the ranges: its best value is {value:?}")]
    NotPositive {
        /// The quantity.
        quantity: &'static str,
        /// Its best value; NaN if it has none, as for a runaway.
        value: f64,
    },
    /// The given orbit is not a periodic orbit of this system.
    #[error("{}", bouncing_disk_core::Error::NotAnOrbit { impact: *impact, distance: *distance })]
    NotAnOrbit {
        /// The impact, from 0 on.
        impact: usize,
        /// Distance between the computed next impact and the next impact of the given orbit (rad, or relative
        /// to 1 + the largest impact speed of the orbit); infinite if the disk stays on the platform.
        distance: f64,
    },
    /// So many motors of a range are in low-period traps that too few are left to fit a straight line.
    #[error(
        "a straight line needs {needed} motors outside low-period traps, but {left} are left ({traps} are in \
         traps)"
    )]
    TooFewMotors {
        /// Motors that are left.
        left: usize,
        /// Motors in traps.
        traps: usize,
        /// Number of motors that are needed.
        needed: usize,
    },
    /// A required parameter without a default is missing.
    #[error("{field} is not given")]
    NotGiven {
        /// The name of the parameter.
        field: &'static str,
    },
    /// Neither of two alternative parameters is given; one of them is needed.
    #[error("neither {one} nor {other} is given; one of them is needed")]
    NeitherGiven {
        /// The name of the first.
        one: &'static str,
        /// The name of the second.
        other: &'static str,
    },
    /// Both of two alternative parameters are given.
    #[error("both {one} and {other} are given, which exclude each other; leave one of them out")]
    BothGiven {
        /// The name of the first.
        one: &'static str,
        /// The name of the second.
        other: &'static str,
    },
    /// Two lists that belong together have different lengths.
    #[error(
        "{one} has {count} {} and {other} {other_count}: they need the same length",
        if *count == 1 { "entry" } else { "entries" }
    )]
    Lengths {
        /// The name of the first list.
        one: &'static str,
        /// Its number of entries.
        count: usize,
        /// The name of the second list.
        other: &'static str,
        /// Its number of entries.
        other_count: usize,
    },
    /// An electrical parameter of a stator is given, but not the force per volt it needs.
    #[error(
        "{field} needs stator.force_per_volt, or stator.anti_resonance with stator.capacitance; specify the drive once: amplitude \
         (no rotor, at the drive frequency), stator.force or stator.volts"
    )]
    NoForcePerVolt {
        /// The name of the parameter.
        field: &'static str,
    },
    /// A load switches the drive, but the motion is prescribed.
    #[error(
        "load.on and load.off switch the drive and need a table [stator]: a prescribed motion would stop with a \
         jump"
    )]
    SwitchedMotion,
    /// An axis of a sweep has no values.
    #[error("the axis of {parameter} has no values; give at least one")]
    EmptyAxis {
        /// The parameter that was to be varied.
        parameter: &'static str,
    },
    /// Two axes of a sweep vary the same parameter.
    #[error("two axes vary {parameter}; leave one of them out")]
    RepeatedAxis {
        /// The parameter.
        parameter: &'static str,
    },
    /// The waveform of a platform's height or angle is invalid.
    #[error("the {of}: {source}")]
    Waveform {
        /// Height or angle.
        of: &'static str,
        /// The error.
        source: bouncing_disk_core::Error,
    },
    /// The pieces of a waveform do not join.
    #[error("the {of} jumps by {jump:?} amplitudes where piece {piece} begins: it must be continuous")]
    WaveformJump {
        /// Height or angle.
        of: &'static str,
        /// Index of the piece, from 0; the first one follows the last.
        piece: usize,
        /// Size of the jump, in amplitudes.
        jump: f64,
    },
    /// A drive other than the sine, for an analysis that needs the sine.
    #[error(
        "this analysis holds only for the sine of Eq. (1), but the table [drive] gives another motion; remove the \
         table, or use an analysis that accepts any drive: tosses, orbit diagrams, periodic orbits, doublings, \
         verdicts, basins, motor transients, torque-speed curves, stall, best values and sweeps"
    )]
    DriveNotSine,
    /// A compliant contact, for an analysis that needs rigid impacts.
    #[error(
        "this analysis holds only for rigid impacts, but the table [contact] has a time; remove the time, or use \
         an analysis that accepts it: single tosses, motor transients, torque-speed curves, stall, best values, \
         sweeps and fits of parameters"
    )]
    SoftContact,
    /// A compliant stator, for an analysis that needs a prescribed motion.
    #[error(
        "this analysis holds only for a prescribed motion, but the table [stator] makes the stator compliant; \
         remove the table, or use an analysis that accepts it: motor transients, torque-speed curves, stall, best \
         values and sweeps"
    )]
    YieldingStator,
    /// A varying load, for an analysis that needs a constant torque.
    #[error(
        "this analysis holds only for a constant load; replace the table [load] by load_torque, or use an analysis \
         that accepts it: motor transients, torque-speed curves, stall, best values, sweeps and fits of rated \
         points"
    )]
    LoadLaw,
    /// A time-dependent load, for an analysis of steady operation.
    #[error(
        "a steady operation has no time axis, but load.times, load.on or load.off is given; leave such keys out, or \
         compute a run-up (`motor transient`)"
    )]
    LoadInTime,
    /// A map has no parameter of this name.
    #[error(
        "the platform has no number of this name; legal names are axial_forcing, restitution, contact_periods (if a \
         contact time is given), and numbers of the shape, such as sawtooth or fourier[1][0], counted from 0"
    )]
    NoSuchNumber,
    /// A start phase of a toss, for an analysis without tosses.
    #[error(
        "start_phase is the phase at which a toss starts, but this analysis computes no toss; leave it out"
    )]
    StartPhase,
    /// An error of the math core.
    #[error(transparent)]
    Core(#[from] bouncing_disk_core::Error),
}

impl From<std::convert::Infallible> for Error {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}

/// Largest size of a dimensionless rotary number: its square is far below overflow.
const LARGEST: f64 = 1.0e100;

/// Checks that `value` is finite and greater than zero.
pub(crate) fn positive(field: &'static str, value: f64) -> Result<f64, Error> {
    check(value > 0.0 && value.is_finite(), field, value, "(0, inf)")
}

/// Checks that `value` is finite and not negative.
pub(crate) fn not_negative(field: &'static str, value: f64) -> Result<f64, Error> {
    check(value >= 0.0 && value.is_finite(), field, value, "[0, inf)")
}

/// Checks that `value` is finite.
pub(crate) fn finite(field: &'static str, value: f64) -> Result<f64, Error> {
    check(value.is_finite(), field, value, "finite")
}

/// Checks that all of these are finite.
pub(crate) fn all_finite<const N: usize>(values: [(&'static str, f64); N]) -> Result<(), Error> {
    values.into_iter().try_for_each(|(field, value)| finite(field, value).map(|_| ()))
}

/// Checks that a coefficient of restitution lies in [0, 1).
pub(crate) fn restitution(value: f64) -> Result<f64, Error> {
    check((0.0..1.0).contains(&value), "restitution", value, "[0, 1)")
}

/// Checks that a dimensionless number is not negative and can be squared.
pub(crate) fn moderate_not_negative(field: &'static str, value: f64) -> Result<f64, Error> {
    check((0.0..=LARGEST).contains(&value), field, value, "[0, 1e100] (dimensionless)")
}

/// Checks that a dimensionless number can be squared.
pub(crate) fn moderate(field: &'static str, value: f64) -> Result<f64, Error> {
    check(value.abs() <= LARGEST, field, value, "[-1e100, 1e100] (dimensionless)")
}

/// An empty vector with room for `count` <= `limit` items. Memory is reserved at once, so that a shortage is an
/// error. The limit is needed because some systems grant memory that they do not have.
pub(crate) fn room_for<T>(what: &'static str, count: usize, limit: usize) -> Result<Vec<T>, Error> {
    within_limit(what, count, limit)?;
    let mut room = Vec::new();
    match room.try_reserve_exact(count) {
        Ok(()) => Ok(room),
        Err(_) => Err(too_large(what, count, limit)),
    }
}

/// Checks that a number of items does not exceed its limit.
pub(crate) fn within_limit(what: &'static str, count: usize, limit: usize) -> Result<(), Error> {
    if count <= limit { Ok(()) } else { Err(too_large(what, count, limit)) }
}

fn too_large(what: &'static str, count: usize, limit: usize) -> Error {
    bouncing_disk_core::Error::TooLarge { what, count: count as u64, limit: limit as u64 }.into()
}

/// The value if it is legal, otherwise an error with field, value and legal range.
pub(crate) fn check(legal: bool, field: &'static str, value: f64, range: &'static str) -> Result<f64, Error> {
    if legal { Ok(value) } else { Err(Error::OutOfRange { field, value, legal: range }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As in the core, an error prints a number of any size with few digits, not with hundreds of zeros.
    #[test]
    fn texts_tell_numbers_of_any_size_in_few_digits() {
        for number in [1.25e-300, 1.25e-121, 1.25e300] {
            for error in [
                Error::OutOfRange { field: "speed", value: number, legal: "[0, 1]" },
                Error::NeverLeaves { peak_acceleration: number },
                Error::SlipTooLong { duration: number, limit: number },
            ] {
                let text = error.to_string();
                assert!(text.contains(&format!("{number:e}")) && text.len() < 160, "{text}");
            }
        }
    }
}
