//! Single and multiple tosses.

use bouncing_disk::core::{LyapunovEstimate, Multipliers};
use bouncing_disk::{
    InitialSpin, MultiTossSettings, OrbitClass, SiEnergy, TossOrbit, TossPerformance, multi_toss,
};
use numpy::Complex64;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable};
use crate::chatter::{ChatterCut, policy};
use crate::periodic_orbit::complex;
use crate::real::Real;
use crate::start::Start;
use crate::system::System;
use crate::{long_call, results};

/// The spin of an argument `initial_spin`.
pub(crate) fn initial_spin(name: &str) -> PyResult<InitialSpin> {
    match name {
        "absolute-rest" => Ok(InitialSpin::AbsoluteRest),
        "with-hand" => Ok(InitialSpin::RestRelativeToHand),
        _ => Err(PyValueError::new_err(format!(
            "initial_spin must be \"absolute-rest\" or \"with-hand\", and is {name:?}"
        ))),
    }
}

/// The energies as Python has them.
pub(crate) fn energy<'py>(py: Python<'py>, energy: &SiEnergy) -> PyResult<Bound<'py, PyAny>> {
    let parts = (
        energy.normal_work,
        energy.friction_work,
        energy.restitution_loss,
        energy.friction_loss,
        energy.load_work,
        energy.axial_kinetic_change,
        energy.potential_change,
        energy.rotary_kinetic_change,
    );
    results::make(py, "Energy", parts)
}

/// The performance as Python has it.
pub(crate) fn performance<'py>(py: Python<'py>, toss: &TossPerformance) -> PyResult<Bound<'py, PyAny>> {
    let fields = (
        toss.airborne_speed,
        toss.efficiency,
        toss.speed_ratio,
        toss.separation_phase,
        toss.sliding_at_separation,
        toss.launch_speed,
        toss.rotary_energy_gain,
        energy(py, &toss.energy)?,
    );
    results::make(py, "TossPerformance", fields)
}

/// The toss of a disk from its platform, up to the separation.
///
/// Parameters
/// ----------
/// system : System
/// initial_spin : {"absolute-rest", "with-hand"}, default "absolute-rest"
///     Whether the disk does not turn at first, or turns with the platform.
///
/// Returns
/// -------
/// TossPerformance
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> toss = bd.single_toss(bd.System.pizza_toss())
/// >>> round(toss.airborne_speed)  # rad/s, as the paper prints for the toss of Table I
/// 14
#[pyfunction]
#[pyo3(signature = (system, *, initial_spin="absolute-rest"))]
pub(crate) fn single_toss<'py>(
    py: Python<'py>,
    system: &Bound<'py, System>,
    initial_spin: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let initial = self::initial_spin(initial_spin)?;
    let toss = long_call::short(py, &[], || bouncing_disk::single_toss(&system.get().0, initial))?;
    performance(py, &toss)
}

/// What a motion is that has settled: its name, impacts and platform periods of a round, long flights of a
/// chattering one, the multipliers, and the exponent.
type Class = (&'static str, usize, u64, usize, [Complex64; 3], Option<LyapunovEstimate>);

fn class(class: &OrbitClass) -> Class {
    const NONE: Complex64 = Complex64::new(f64::NAN, f64::NAN);
    match class {
        OrbitClass::Periodic { period, platform_periods, vertical, rotary } => {
            let multipliers: &Multipliers = vertical;
            let [one, other] = complex(*multipliers);
            ("periodic", *period, *platform_periods, 0, [one, other, Complex64::new(*rotary, 0.0)], None)
        }
        OrbitClass::Chattering(cycle) => {
            ("chattering", cycle.impacts, cycle.platform_periods, cycle.long_flights, [NONE; 3], None)
        }
        OrbitClass::Chaotic { lyapunov_exponent } => {
            ("chaotic", 0, 0, 0, [NONE; 3], Some(*lyapunov_exponent))
        }
        OrbitClass::Undecided { lyapunov_exponent, .. } => {
            ("undecided", 0, 0, 0, [NONE; 3], *lyapunov_exponent)
        }
        OrbitClass::AtRest => ("at-rest", 0, 0, 0, [NONE; 3], None),
        _ => ("unknown", 0, 0, 0, [NONE; 3], None),
    }
}

/// What a motion settles on: a periodic orbit, chattering, chaos or rest, with its collisions.
///
/// Parameters
/// ----------
/// system : System
/// phase, angular_speed, gap, relative_velocity : float, optional
///     The start, as of :func:`simulate`.
/// transient_impacts : int, default 4000
///     Impacts that are not looked at.
/// examined_impacts : int, default 1024
///     Impacts that are looked at after them, in [2, 10000000].
/// longest_period : int, default 128
///     The longest period, in impacts, that is recognised, up to 4096.
/// tolerance : float, default 1e-9
///     Phases (rad) and relative speeds that differ by no more are the same.
/// chatter : ChatterCut, optional
///     How a chatter ends; ``None`` sums it.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of impacts.
///
/// Returns
/// -------
/// TossOrbit
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> tossed = bd.System.pizza_toss().replace(amplitude=0.0566)
/// >>> bd.multi_toss(tossed, phase=4.7).kind
/// 'chattering'
#[pyfunction]
#[pyo3(signature = (
    system, *, phase=Real(0.0), angular_speed=None, gap=None, relative_velocity=None, transient_impacts=Count::Fits(4000),
    examined_impacts=Count::Fits(1024), longest_period=Count::Fits(128), tolerance=Real(1e-9), chatter=None,
    progress=ProgressCallable(None)
), text_signature = "(system, *, phase=0.0, angular_speed=None, gap=None, relative_velocity=None, \
                     transient_impacts=4000, examined_impacts=1024, longest_period=128, tolerance=1e-09, \
                     chatter=None, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn multi_toss<'py>(
    py: Python<'py>,
    system: &Bound<'py, System>,
    phase: Real,
    angular_speed: Option<Real>,
    gap: Option<Real>,
    relative_velocity: Option<Real>,
    transient_impacts: Count,
    examined_impacts: Count,
    longest_period: Count,
    tolerance: Real,
    chatter: Option<&Bound<'py, ChatterCut>>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let model = system.get().0;
    let settings = MultiTossSettings {
        policy: policy(chatter),
        transient_impacts: transient_impacts.usize(py, "transient_impacts")?,
        examined_impacts: examined_impacts.usize(py, "examined_impacts")?,
        longest_period: longest_period.usize(py, "longest_period")?,
        tolerance: tolerance.0,
    };
    let start = Start::new(phase, angular_speed, gap, relative_velocity);
    let orbit: TossOrbit = long_call::run_named(py, progress.0, &start.names(&model), |observer| {
        multi_toss(model, start.condition(&model)?, settings, observer)
    })?;
    let (kind, period, platform_periods, long_flights, multipliers, exponent) = class(&orbit.class);
    let scales = model.scales();
    let row = |of: &dyn Fn(&bouncing_disk::Collision) -> f64| {
        results::array(py, orbit.collisions.iter().map(of).collect())
    };
    let fields = (
        kind,
        period,
        platform_periods,
        long_flights,
        results::array(py, multipliers.to_vec()),
        exponent.map(|own| own.exponent),
        orbit.mean_angular_speed.map(|speed| speed * scales.angular_speed),
        orbit.rotation_repeats,
        row(&|one| scales.time_seconds(one.time)),
        row(&|one| one.state.phase.angle()),
        row(&|one| one.state.axial_impact_velocity * scales.velocity),
        row(&|one| one.state.tangential_impact_velocity * scales.angular_speed),
    );
    let rest = (
        row(&|one| one.angular_speed * scales.angular_speed),
        row(&|one| one.angle * scales.angle),
        results::array(py, orbit.collisions.iter().map(|one| one.capped).collect()),
        exponent.map(|own| own.standard_error),
    );
    results::make(py, "TossOrbit", results::joined(py, fields, rest)?)
}
