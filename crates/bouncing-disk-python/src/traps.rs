//! Low-period traps of motors.

use bouncing_disk::{TrapVerdict, low_period_traps};
use pyo3::prelude::*;

use crate::arguments::{ProgressCallable, row};
use crate::motor::Motor;
use crate::names::{Name, derived, name};
use crate::real::Real;
use crate::system_names::OF_MOTOR;
use crate::{long_call, results};

/// The numbers of the round without perturbation: impacts, periods of the stator, long flights; 0 where there
/// is none.
fn round(verdict: &TrapVerdict) -> [i64; 3] {
    verdict.cycle.map_or([0; 3], |cycle| {
        [cycle.impacts as i64, cycle.platform_periods as i64, cycle.long_flights as i64]
    })
}

/// Which preloads trap a motor in a short round of flights and rest, with a speed of its own.
///
/// Judged from the vertical motion alone, which is all that decides.
///
/// Parameters
/// ----------
/// motor : Motor
/// preload_accelerations : (n,) array_like
///     Preloads as accelerations (m/s^2), positive; they take the place of that of the data sheet.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of preloads.
///
/// Returns
/// -------
/// LowPeriodTraps
///
/// Examples
/// --------
/// A flight of twelve and a half periods lands softly, which is where Gamma is 12.51:
///
/// >>> import numpy as np
/// >>> import bouncing_disk as bd
/// >>> motor = bd.Motor.paper_70_khz()
/// >>> soft = motor.preload_acceleration * motor.system.axial_forcing / 12.51
/// >>> bd.low_period_traps(motor, preload_accelerations=soft * np.array([0.97, 1.0, 1.03])).is_trap
/// array([False,  True, False])
#[pyfunction]
#[pyo3(signature = (motor, *, preload_accelerations, progress=ProgressCallable(None)),
       text_signature = "(motor, *, preload_accelerations, progress=None)")]
pub(crate) fn low_period_traps<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    preload_accelerations: &Bound<'py, PyAny>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let preloads = row(preload_accelerations, "preload_accelerations")?;
    let motor = motor.get().0;
    // What is illegal of one of these motors follows from its preload, by whatever name the library has for
    // it.
    let names: Vec<Name> = [name("preload_acceleration", &["preload_accelerations"])]
        .into_iter()
        .chain(OF_MOTOR.map(|own| derived(own.library(), &["preload_accelerations", "motor"])))
        .collect();
    let found = long_call::run_named(py, progress.0, &names, |observer| {
        low_period_traps(&motor, &preloads, observer)
    })?;
    let row = |of: &dyn Fn(&TrapVerdict) -> f64| results::array(py, found.iter().map(of).collect());
    let counts = |of: &dyn Fn(&TrapVerdict) -> i64| results::array(py, found.iter().map(of).collect());
    let fields = (
        row(&|one| one.preload_acceleration),
        row(&|one| one.axial_forcing),
        results::array(py, found.iter().map(|one| one.is_trap).collect()),
        counts(&|one| round(one)[0]),
        counts(&|one| round(one)[1]),
        counts(&|one| round(one)[2]),
        counts(&|one| one.relaunches.into()),
        counts(&|one| one.returns.into()),
        row(&|one| one.mean_platform_periods.unwrap_or(f64::NAN)),
    );
    results::make(py, "LowPeriodTraps", fields)
}

/// The low-period trap that is nearest to a motor.
///
/// Only Gamma and the restitution decide, so that the same trap is reached by a change of preload, of
/// amplitude or of frequency: its near edge is given for each of them, the others kept.
///
/// Parameters
/// ----------
/// motor : Motor
/// relative_range : float, default 0.1
///     The largest relative change of preload or amplitude that is looked at, in (0, 1].
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the steps to either side.
///
/// Returns
/// -------
/// NearestTrap or None
///     None if there is none within the range that is at least 0.05 % wide.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> trap = bd.nearest_trap(bd.Motor.paper_70_khz())
/// >>> trap is None or 0.0 <= trap.relative_distance < 0.1
/// True
#[pyfunction]
#[pyo3(signature = (motor, *, relative_range=Real(0.1), progress=ProgressCallable(None)),
       text_signature = "(motor, *, relative_range=0.1, progress=None)")]
pub(crate) fn nearest_trap<'py>(
    py: Python<'py>,
    motor: &Bound<'py, Motor>,
    relative_range: Real,
    progress: ProgressCallable,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let motor = motor.get().0;
    let names = [derived("peak_acceleration", &["motor", "relative_range"])];
    let found = long_call::run_named(py, progress.0, &names, |observer| {
        motor.nearest_trap(relative_range.0, observer)
    })?;
    let Some(trap) = found else { return Ok(None) };
    let [impacts, periods, flights] = round(&trap.verdict);
    let fields = (
        trap.relative_distance,
        trap.preload_acceleration,
        trap.amplitude,
        trap.drive_frequency,
        (trap.forcing_from_to[0], trap.forcing_from_to[1]),
        trap.forcing_step,
        impacts,
        periods,
        flights,
        trap.verdict.return_share(),
    );
    results::make(py, "NearestTrap", fields).map(Some)
}
