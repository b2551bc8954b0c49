//! The best hand motion.

use bouncing_disk::{DiskParameters, OverFriction, TossConstraints, TossDesign, TossObjective, best_toss};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::ProgressCallable;
use crate::names::{Name, derived, name};
use crate::real::{Pair, Real, optional};
use crate::toss::{initial_spin, performance};
use crate::{long_call, results};

/// What quantities of the toss follow from.
const HAND_AND_DOUGH: [&str; 5] =
    ["stroke", "angular_frequency", "contact_radius", "gyration_radius", "preload_acceleration"];

/// What the library calls the arguments, and what follows from them.
const NAMES: [Name; 13] = [
    name("friction (least)", &["friction"]),
    name("friction (most)", &["friction"]).legal("[the least, inf)"),
    name("angular_frequency (least)", &["angular_frequency"]),
    name("angular_frequency (most)", &["angular_frequency"]).legal("(0, inf), not below the least"),
    name("phase_lag (least)", &["phase_lag"]),
    name("phase_lag (most)", &["phase_lag"]).legal("[the least, the least + 2 pi]"),
    derived("peak_acceleration", &HAND_AND_DOUGH),
    derived("twist_speed", &HAND_AND_DOUGH),
    derived("amplitude", &HAND_AND_DOUGH),
    derived("twist_amplitude", &HAND_AND_DOUGH),
    derived("unit of angle (rad)", &HAND_AND_DOUGH),
    derived("unit of angular speed (rad/s)", &HAND_AND_DOUGH),
    derived("unit of rotary energy (J/kg)", &HAND_AND_DOUGH),
];

/// The hand motion that tosses best: its frequency, its amplitude angle and its phase lag.
///
/// Whatever is not given is that of the paper's Table I.
///
/// Parameters
/// ----------
/// contact_radius, gyration_radius, preload_acceleration : float, optional
///     Of the dough (m, m, m/s^2), positive.
/// initial_spin : {"absolute-rest", "with-hand"}, default "absolute-rest"
///     Whether the dough does not turn at first, or turns with the hand.
/// stroke : float, optional
///     Stroke c (m), positive.
/// friction : (float, float), optional
///     Least and most coefficient of friction, not negative.
/// angular_frequency : (float, float), optional
///     Least and most angular frequency (rad/s), positive.
/// phase_lag : (float, float), optional
///     Least and most phase lag (rad).
/// highest_flight : float, optional
///     The highest that the dough may fly above the place where it leaves the hand (m), positive.
/// objective : {"airborne-speed", "efficiency", "turns-per-toss"}, default "airborne-speed"
///     What is to be largest.
/// over_friction : {"worst", "mean"}, default "worst"
///     How it is taken over the range of friction.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with steps of the search.
///
/// Returns
/// -------
/// TossDesign
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> design = bd.best_toss(friction=(0.5, 0.7), angular_frequency=(10.0, 16.0), highest_flight=0.5)
/// >>> design.value > 15.0 and design.flight_height < 0.5 + 1e-9
/// True
#[pyfunction]
#[pyo3(signature = (
    *, contact_radius=None, gyration_radius=None, preload_acceleration=None, initial_spin="absolute-rest", stroke=None,
    friction=None, angular_frequency=None, phase_lag=None, highest_flight=None, objective="airborne-speed",
    over_friction="worst", progress=ProgressCallable(None)
), text_signature = "(*, contact_radius=None, gyration_radius=None, preload_acceleration=None, \
                     initial_spin='absolute-rest', stroke=None, friction=None, angular_frequency=None, \
                     phase_lag=None, highest_flight=None, objective='airborne-speed', over_friction='worst', \
                     progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn best_toss<'py>(
    py: Python<'py>,
    contact_radius: Option<Real>,
    gyration_radius: Option<Real>,
    preload_acceleration: Option<Real>,
    initial_spin: &str,
    stroke: Option<Real>,
    friction: Option<Pair>,
    angular_frequency: Option<Pair>,
    phase_lag: Option<Pair>,
    highest_flight: Option<Real>,
    objective: &str,
    over_friction: &str,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let objective = match objective {
        "airborne-speed" => TossObjective::AirborneSpeed,
        "efficiency" => TossObjective::Efficiency,
        "turns-per-toss" => TossObjective::TurnsPerToss,
        _ => return Err(PyValueError::new_err(format!("the objective {objective:?} is unknown"))),
    };
    let over_friction = match over_friction {
        "worst" => OverFriction::Worst,
        "mean" => OverFriction::Mean,
        _ => {
            return Err(PyValueError::new_err(format!(
                "over_friction must be \"worst\" or \"mean\", and is {over_friction:?}"
            )));
        }
    };
    let table = TossConstraints::pizza_toss();
    let pair = |given: Option<Pair>, own: [f64; 2]| given.map_or(own, |range| [range.0, range.1]);
    let constraints = TossConstraints {
        dough: DiskParameters {
            contact_radius: optional(contact_radius).unwrap_or(table.dough.contact_radius),
            gyration_radius: optional(gyration_radius).unwrap_or(table.dough.gyration_radius),
            preload_acceleration: optional(preload_acceleration).unwrap_or(table.dough.preload_acceleration),
            ..table.dough
        },
        initial: self::initial_spin(initial_spin)?,
        stroke: optional(stroke).unwrap_or(table.stroke),
        friction: pair(friction, table.friction),
        angular_frequency: pair(angular_frequency, table.angular_frequency),
        phase_lag: pair(phase_lag, table.phase_lag),
        highest_flight: optional(highest_flight),
        objective,
        over_friction,
    };
    let design: TossDesign =
        long_call::run_named(py, progress.0, &NAMES, |observer| best_toss(&constraints, observer))?;
    let fields = (
        design.hand.stroke,
        design.hand.amplitude_angle,
        design.hand.angular_frequency,
        design.hand.phase_lag,
        design.amplitude_ratio,
        design.value,
        performance(py, &design.toss)?,
        design.flight_height,
        design.turns,
        design.certificate.grid_points,
        design.certificate.best_on_grid,
        design.certificate.hidden_gain,
    );
    results::make(py, "TossDesign", fields)
}
