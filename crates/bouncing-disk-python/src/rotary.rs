//! The spin of a disk on a periodic orbit.

use bouncing_disk::{RotaryOutcome, SlipDirection, rotary_response as response};
use pyo3::prelude::*;

use crate::periodic_orbit::PeriodicOrbit;
use crate::system::System;
use crate::{long_call, results};

/// What becomes of the spin of a disk on a periodic orbit of its vertical motion, stable or unstable.
///
/// Parameters
/// ----------
/// system : System
/// orbit : PeriodicOrbit
///     An orbit of ``ImpactMap.of_system(system)``.
///
/// Returns
/// -------
/// RotaryResponse
///
/// Examples
/// --------
/// Dough on a hand that the saddle of one impact in one period is tossed by, which no motion settles on:
///
/// >>> import bouncing_disk as bd
/// >>> system = bd.System.pizza_toss().replace(angular_frequency=8.5)
/// >>> orbits = bd.periodic_orbits(bd.ImpactMap.of_system(system), max_impacts=1, max_platform_periods=1)
/// >>> [(orbit.is_stable, bd.rotary_response(system, orbit).outcome) for orbit in orbits]
/// [(False, 'steady'), (False, 'steady')]
#[pyfunction]
#[pyo3(signature = (system, orbit), text_signature = "(system, orbit)")]
pub(crate) fn rotary_response<'py>(
    py: Python<'py>,
    system: &Bound<'py, System>,
    orbit: &Bound<'py, PeriodicOrbit>,
) -> PyResult<Bound<'py, PyAny>> {
    let (system, orbit) = (system.get().0, &orbit.get().0);
    let unit = system.scales().angular_speed;
    let found = long_call::short(py, &[], || response(system.dimensionless(), orbit))?;
    let speeds =
        |speeds: &[f64]| results::array(py, speeds.iter().map(|speed| speed * unit).collect::<Vec<f64>>());
    let multiplier = found.multiplier();
    let none = f64::NAN;
    let (outcome, own, limit, change) = match &found {
        RotaryOutcome::Steady(own) => ("steady", Some(own), none, none),
        RotaryOutcome::Kept { limit } => ("kept", None, limit.map_or(none, |limit| limit * unit), none),
        RotaryOutcome::Runaway { change } => ("runaway", None, none, change * unit),
        _ => ("unknown", None, none, none),
    };
    let sign = |slides: &Option<SlipDirection>| slides.map_or(0, |direction| direction.sign() as i64);
    let fields = (
        outcome,
        multiplier.unwrap_or(none),
        speeds(own.map_or(&[], |own| &own.angular_speeds)),
        speeds(own.map_or(&[], |own| &own.slips)),
        results::array(py, own.map_or_else(Vec::new, |own| own.sliding.iter().map(sign).collect())),
        own.map_or(none, |own| own.stick_margin * unit),
        own.map_or(none, |own| own.mean_angular_speed * unit),
        limit,
        change,
    );
    results::make(py, "RotaryResponse", fields)
}
