//! Speed transients of motors: one, many, ensembles.

use std::f64::consts::TAU;

use bouncing_disk::core::Phase;
use bouncing_disk::{
    Error, ExponentialFit, SpeedCurve, Spread, System as Model, TransientMember, TransientSettings, ensemble,
    transient, transients,
};
use numpy::PyArray2;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable, common_length, numbers};
use crate::chatter::{ChatterCut, policy};
use crate::diagram::room_for;
use crate::names::{Name, derived, name};
use crate::real::Real;
use crate::system::System;
use crate::{long_call, results};

/// Curves as two matrices, time by member.
struct Matrices {
    shape: [usize; 2],
    times: Vec<f64>,
    speeds: Vec<f64>,
    impacts: Vec<i64>,
    separations: Vec<i64>,
}

impl Matrices {
    /// Those of curves of the same number of points.
    fn of(curves: &[SpeedCurve], points: usize) -> Result<Self, Error> {
        let shape = [points, curves.len()];
        let (mut times, mut speeds) = (room_for(points * curves.len())?, room_for(points * curves.len())?);
        for point in 0..points {
            times.extend(curves.iter().map(|curve| curve.times.get(point).copied().unwrap_or(f64::NAN)));
            speeds.extend(curves.iter().map(|curve| curve.speeds.get(point).copied().unwrap_or(f64::NAN)));
        }
        Ok(Self {
            shape,
            times,
            speeds,
            impacts: curves.iter().map(|curve| curve.impacts as i64).collect(),
            separations: curves.iter().map(|curve| curve.separations as i64).collect(),
        })
    }
}

/// What the library makes of a duration (s), which it counts in periods of a platform; this is the shortest
/// (s).
fn names(duration: f64, period: f64) -> [Name; 2] {
    [
        name("duration in periods of the platform", &["duration"]).given(duration).unit(period, "s"),
        derived("duration of an interval", &["duration", "intervals"]),
    ]
}

/// The period of a platform (s).
fn period(system: &Model) -> f64 {
    TAU / system.platform().angular_frequency()
}

type Matrix<'py> = Bound<'py, PyArray2<f64>>;

/// A mean with its deviation and standard error, which one value alone does not have.
fn spread(spread: &Spread, members: usize) -> (f64, f64, f64) {
    if members > 1 {
        (spread.mean, spread.deviation, spread.standard_error)
    } else {
        (spread.mean, f64::NAN, f64::NAN)
    }
}

/// The speed of a motor from rest, averaged over equal intervals.
///
/// Parameters
/// ----------
/// system : System
/// phase : float, default 0
///     Phase of the stator at the start (rad).
/// duration : float, default 3
///     Duration (s), positive.
/// intervals : int, default 600
///     Intervals of equal length, in [3, 1000000].
/// relaunch_perturbation : float, default 0.001
///     Size of the relaunch perturbation in units of g/omega, in [0, 1e100].
/// seed : int, default 1
///     Seed of the perturbations.
/// chatter : ChatterCut, optional
///     How a chatter ends; ``None`` sums it.
/// progress : callable, optional
///     Called as ``progress(done, total)``.
///
/// Returns
/// -------
/// SpeedCurve
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> curve = bd.transient(bd.System.motor(), duration=0.01, intervals=10)
/// >>> curve.speeds.shape
/// (10,)
#[pyfunction]
#[pyo3(signature = (
    system, *, phase=Real(0.0), duration=Real(3.0), intervals=Count::Fits(600), relaunch_perturbation=Real(1e-3), seed=Count::Fits(1),
    chatter=None, progress=ProgressCallable(None)
), text_signature = "(system, *, phase=0.0, duration=3.0, intervals=600, relaunch_perturbation=0.001, seed=1, \
                     chatter=None, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn transient<'py>(
    py: Python<'py>,
    system: &Bound<'py, System>,
    phase: Real,
    duration: Real,
    intervals: Count,
    relaunch_perturbation: Real,
    seed: Count,
    chatter: Option<&Bound<'py, ChatterCut>>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let (intervals, seed) = (intervals.usize(py, "intervals")?, seed.u64(py, "seed")?);
    let settings = TransientSettings {
        duration: duration.0,
        intervals,
        relaunch_perturbation: relaunch_perturbation.0,
        seed,
        policy: policy(chatter),
    };
    let system = system.get().0;
    let curve = long_call::run_named(py, progress.0, &names(duration.0, period(&system)), |observer| {
        transient(&system, Phase::new(phase.0)?, &settings, observer)
    })?;
    let (times, speeds) = (results::array(py, curve.times), results::array(py, curve.speeds));
    results::make(py, "SpeedCurve", (times, speeds, curve.impacts, curve.separations))
}

/// The transients of many motors, each with its own phase and seed.
///
/// Parameters
/// ----------
/// systems : System or sequence of m of them
///     The motors; one is that of all members.
/// phases : float or (m,) array_like, default 0
///     Phase of the stator at the start of each (rad).
/// seeds : int or sequence of m of them, default 1
///     Seeds of the perturbations.
/// duration, intervals, relaunch_perturbation, chatter : optional
///     As of :func:`transient`, the same for all.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of members.
///
/// Returns
/// -------
/// SpeedCurves
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> curves = bd.transients(bd.System.motor(), phases=[0.0, 1.0, 2.0], duration=0.01, intervals=10)
/// >>> curves.speeds.shape
/// (10, 3)
#[pyfunction]
#[pyo3(signature = (
    systems, *, phases=None, seeds=None, duration=Real(3.0), intervals=Count::Fits(600), relaunch_perturbation=Real(1e-3),
    chatter=None, progress=ProgressCallable(None)
), text_signature = "(systems, *, phases=None, seeds=None, duration=3.0, intervals=600, relaunch_perturbation=0.001, \
                     chatter=None, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn transients<'py>(
    py: Python<'py>,
    systems: &Bound<'py, PyAny>,
    phases: Option<&Bound<'py, PyAny>>,
    seeds: Option<&Bound<'py, PyAny>>,
    duration: Real,
    intervals: Count,
    relaunch_perturbation: Real,
    chatter: Option<&Bound<'py, ChatterCut>>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let intervals = intervals.usize(py, "intervals")?;
    let (systems, many_systems) = match systems.cast::<System>() {
        Ok(one) => (vec![one.get().0], None),
        Err(_) => {
            let mut all = Vec::new();
            for item in systems.try_iter()? {
                let item = item?;
                let system =
                    item.cast::<System>().map_err(|_| PyTypeError::new_err("systems must hold systems"))?;
                all.push(system.get().0);
            }
            let count = all.len();
            (all, Some(count))
        }
    };
    let phases = match phases {
        Some(phases) => numbers(phases, "phases")?,
        None => numbers(0.0_f64.into_pyobject(py)?.as_any(), "phases")?,
    };
    let (seeds, many_seeds) = match seeds {
        None => (vec![1], None),
        Some(seeds) => match seeds.extract::<Count>() {
            Ok(seed) => (vec![seed.u64(py, "seeds")?], None),
            Err(_) => {
                let mut all = Vec::new();
                for seed in seeds.try_iter()? {
                    all.push(seed?.extract::<Count>()?.u64(py, "seeds")?);
                }
                let count = all.len();
                (all, Some(count))
            }
        },
    };
    let members =
        common_length(&[("systems", many_systems), ("phases", phases.len()), ("seeds", many_seeds)])?;
    let (duration, relaunch_perturbation) = (duration.0, relaunch_perturbation.0);
    let policy = policy(chatter);
    let periods = systems.iter().map(period);
    let shortest = periods.fold(f64::INFINITY, f64::min);
    let names = [&names(duration, shortest)[..], &[name("phase", &["phases"])]].concat();
    let matrices = long_call::run_named(py, progress.0, &names, |observer| {
        let mut all = room_for(members)?;
        for member in 0..members {
            let system = systems[if many_systems.is_some() { member } else { 0 }];
            let seed = seeds[if many_seeds.is_some() { member } else { 0 }];
            let settings = TransientSettings { duration, intervals, relaunch_perturbation, seed, policy };
            all.push(TransientMember { system, phase: Phase::new(phases.get(member))?, settings });
        }
        let curves = transients(&all, observer)?.into_iter().collect::<Result<Vec<_>, _>>()?;
        Matrices::of(&curves, intervals)
    })?;
    let shape = matrices.shape;
    let (times, speeds): (Matrix<'py>, Matrix<'py>) =
        (results::matrix(py, matrices.times, shape)?, results::matrix(py, matrices.speeds, shape)?);
    let counts = (results::array(py, matrices.impacts), results::array(py, matrices.separations));
    results::make(py, "SpeedCurves", (times, speeds, counts.0, counts.1))
}

/// The transients of one motor from phases that are spread evenly, each with its exponential fit.
///
/// Parameters
/// ----------
/// system : System
/// members : int
///     Number of transients, in [1, 1000000].
/// duration, intervals, relaunch_perturbation, seed, chatter : optional
///     As of :func:`transient`.
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of members.
///
/// Returns
/// -------
/// TransientEnsemble
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> runs = bd.ensemble(bd.System.motor(), members=4, duration=0.5, intervals=50)
/// >>> runs.speeds.shape, runs.steady_speeds.shape
/// ((50, 4), (4,))
#[pyfunction]
#[pyo3(signature = (
    system, *, members, duration=Real(3.0), intervals=Count::Fits(600), relaunch_perturbation=Real(1e-3), seed=Count::Fits(1),
    chatter=None, progress=ProgressCallable(None)
), text_signature = "(system, *, members, duration=3.0, intervals=600, relaunch_perturbation=0.001, seed=1, \
                     chatter=None, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn ensemble<'py>(
    py: Python<'py>,
    system: &Bound<'py, System>,
    members: Count,
    duration: Real,
    intervals: Count,
    relaunch_perturbation: Real,
    seed: Count,
    chatter: Option<&Bound<'py, ChatterCut>>,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let (members, intervals) = (members.usize(py, "members")?, intervals.usize(py, "intervals")?);
    let seed = seed.u64(py, "seed")?;
    let settings = TransientSettings {
        duration: duration.0,
        intervals,
        relaunch_perturbation: relaunch_perturbation.0,
        seed,
        policy: policy(chatter),
    };
    let system = system.get().0;
    let (runs, matrices) =
        long_call::run_named(py, progress.0, &names(duration.0, period(&system)), |observer| {
            let runs = ensemble(&system, &settings, members, observer)?;
            let matrices = Matrices::of(&runs.curves, intervals)?;
            Ok((runs, matrices))
        })?;
    let fits = |of: fn(&ExponentialFit) -> f64| results::array(py, runs.fits.iter().map(of).collect());
    let shape = matrices.shape;
    let fields = (
        results::matrix(py, matrices.times, shape)?,
        results::matrix(py, matrices.speeds, shape)?,
        results::array(py, matrices.impacts),
        results::array(py, matrices.separations),
        fits(|fit| fit.steady_speed),
        fits(|fit| fit.time_constant),
        fits(|fit| fit.residual),
        results::make(py, "Spread", spread(&runs.steady_speed, members))?,
        results::make(py, "Spread", spread(&runs.time_constant, members))?,
        results::make(py, "Spread", spread(&runs.stall_acceleration, members))?,
    );
    results::make(py, "TransientEnsemble", fields)
}
