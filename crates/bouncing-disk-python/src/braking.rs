//! Friction from a rotor that slows down.

use bouncing_disk::{BrakingFit, BrakingRotor, Error};
use pyo3::prelude::*;

use crate::arguments::row;
use crate::fits::{self, interval};
use crate::names::{Name, derived};
use crate::real::Real;
use crate::{errors, results};

/// What follows from the arguments that describe the rotor, and from the curve with them.
const OF_ROTOR: [Name; 3] = [
    derived("contact radius times normal force", &["contact_radius", "normal_force"]),
    derived("moment of inertia", &["mass", "gyration_radius"]),
    derived("friction", &["times", "speeds", "normal_force", "mass", "contact_radius", "gyration_radius"]),
];

/// The coefficient of friction from the speeds of a rotor that slides on a platform at rest (Eq. 17).
///
/// Parameters
/// ----------
/// times : (n,) array_like
///     Times (s), rising, not negative.
/// speeds : (n,) array_like
///     Angular speeds (rad/s), sliding from the first point on; the standstill at the end is left out.
/// normal_force : float
///     Normal force N (N), positive: the preload.
/// mass : float
///     Mass m of the disk (kg), positive.
/// contact_radius : float
///     Effective contact radius a_e (m), positive.
/// gyration_radius : float
///     Radius of gyration a_g (m), positive.
///
/// Returns
/// -------
/// BrakingFit
///
/// Raises
/// ------
/// ComputationError
///     The curve does not fall, has fewer than eight points of sliding, or is not straight.
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> import numpy as np
/// >>> times = np.arange(300) * 0.01
/// >>> speeds = np.maximum(50.0 - 20.0 * times, 0.0)
/// >>> fit = bd.fit_braking(times=times, speeds=speeds, normal_force=0.5, mass=0.05, contact_radius=0.002,
/// ...     gyration_radius=0.01)
/// >>> round(fit.friction.value, 9), round(fit.deceleration.value, 9)
/// (0.1, 20.0)
#[pyfunction]
#[pyo3(signature = (*, times, speeds, normal_force, mass, contact_radius, gyration_radius))]
pub(crate) fn fit_braking<'py>(
    py: Python<'py>,
    times: &Bound<'py, PyAny>,
    speeds: &Bound<'py, PyAny>,
    normal_force: Real,
    mass: Real,
    contact_radius: Real,
    gyration_radius: Real,
) -> PyResult<Bound<'py, PyAny>> {
    let (times, speeds) = (row(times, "times")?, row(speeds, "speeds")?);
    let rotor = BrakingRotor {
        normal_force: normal_force.0,
        mass: mass.0,
        contact_radius: contact_radius.0,
        gyration_radius: gyration_radius.0,
    };
    let fit = py
        .detach(|| BrakingFit::new(&times, &speeds, &rotor))
        .map_err(|error| errors::of_named(py, error, &[&fits::NAMES[..], &OF_ROTOR[..]].concat()))?;
    let fields = (
        interval(py, &fit.friction)?,
        interval(py, &fit.deceleration)?,
        fit.sliding_until,
        fit.points,
        fit.correlation_time,
        fit.residual,
    );
    results::make(py, "BrakingFit", fields)
}
