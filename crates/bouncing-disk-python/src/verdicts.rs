//! What orbits do for good.

use bouncing_disk::core::attractors::{CycleTrust, UndecidedReason, Verdict, VerdictSettings, each_verdict};
use numpy::Complex64;
use pyo3::prelude::*;

use crate::arguments::{Count, ProgressCallable, Starts};
use crate::diagram::room_for;
use crate::names::name;
use crate::periodic_orbit::complex;
use crate::real::Real;
use crate::{long_call, results};

/// The numbers of one verdict; what it does not have is 0 or NaN.
#[derive(Debug, Clone, Copy)]
struct Numbers {
    kind: u8,
    reason: u8,
    period: u64,
    platform_periods: u64,
    after: u64,
    rests: u64,
    exponent: f64,
    standard_error: f64,
    rounding_error: f64,
    multipliers: [Complex64; 2],
}

/// No verdict.
const NOTHING: Numbers = Numbers {
    kind: UNDECIDED,
    reason: 0,
    period: 0,
    platform_periods: 0,
    after: 0,
    rests: 0,
    exponent: f64::NAN,
    standard_error: f64::NAN,
    rounding_error: f64::NAN,
    multipliers: [Complex64::new(f64::NAN, f64::NAN); 2],
};

/// The places of `Verdicts.KINDS` in `_results.py`.
const PERIODIC: u8 = 0;
const CHAOTIC: u8 = 1;
const CHATTERING: u8 = 2;
const AT_REST: u8 = 3;
const UNDECIDED: u8 = 4;

/// The place of the reason in `Verdicts.REASONS`, with the exponent that it has.
fn undecided(reason: &UndecidedReason, rests: u64) -> Numbers {
    let nothing = Numbers { rests, ..NOTHING };
    match *reason {
        UndecidedReason::ExponentNearZero { exponent, standard_error } => {
            Numbers { reason: 1, exponent, standard_error, ..nothing }
        }
        UndecidedReason::NoPeriodFound { exponent, standard_error } => {
            Numbers { reason: 2, exponent, standard_error, ..nothing }
        }
        UndecidedReason::Grazing { impacts, .. } => Numbers { reason: 3, after: impacts, ..nothing },
        UndecidedReason::OnPeriodicOrbit { impacts, platform_periods, multipliers, .. } => Numbers {
            reason: 4,
            period: impacts,
            platform_periods,
            multipliers: complex(multipliers),
            ..nothing
        },
        UndecidedReason::TransientMayLast { exponent, standard_error, .. } => {
            Numbers { reason: 5, exponent, standard_error, ..nothing }
        }
        _ => nothing,
    }
}

fn numbers(verdict: &Verdict) -> Numbers {
    match verdict {
        Verdict::Periodic { impacts, platform_periods, multipliers, after, rests, .. } => Numbers {
            kind: PERIODIC,
            period: *impacts,
            platform_periods: *platform_periods,
            after: *after,
            rests: *rests,
            multipliers: complex(*multipliers),
            ..NOTHING
        },
        Verdict::Chaotic { exponent, standard_error, rests, .. } => Numbers {
            kind: CHAOTIC,
            exponent: *exponent,
            standard_error: *standard_error,
            rests: *rests,
            ..NOTHING
        },
        Verdict::Chattering { cycle, after } => {
            let (exponent, standard_error) = match cycle.trust {
                CycleTrust::ChosenByRounding { exponent, standard_error } => (exponent, standard_error),
                _ => (None, None),
            };
            Numbers {
                kind: CHATTERING,
                period: cycle.impacts,
                platform_periods: cycle.platform_periods,
                after: *after,
                rests: 1,
                exponent: exponent.unwrap_or(f64::NAN),
                standard_error: standard_error.unwrap_or(f64::NAN),
                rounding_error: cycle.rounding_error,
                ..NOTHING
            }
        }
        Verdict::AtRest { after, .. } => Numbers { kind: AT_REST, after: *after, rests: 1, ..NOTHING },
        Verdict::Undecided { reason, rests } => undecided(reason, *rests),
        _ => NOTHING,
    }
}

/// What the orbit of each start does for good: periodic, chaotic, chattering, at rest or undecided, with the
/// evidence.
///
/// Parameters
/// ----------
/// axial_forcing, restitution, impact_phase, normalised_speed : float or (n,) array_like
///     As of :func:`orbit_diagram`.
/// transient : int, default 2000
///     Impacts before the exponent is measured.
/// impacts : int, default 100000
///     Impacts that the exponent is measured over, at least 64.
/// longest_period : int, default 256
///     The longest period that is looked for, in impacts, in [1, 4096].
/// tolerance : float, default 1e-7
///     How near an impact must come to an earlier one for a period to be tried, in (0, 0.01].
/// progress : callable, optional
///     Called as ``progress(done, total)`` with the number of orbits.
///
/// Returns
/// -------
/// Verdicts
///
/// Examples
/// --------
/// >>> import bouncing_disk as bd
/// >>> verdicts = bd.verdicts(axial_forcing=[0.2, 0.44, 0.56], restitution=0.5, impact_phase=1.2, normalised_speed=1.3,
/// ...     impacts=2000)
/// >>> verdicts.names()
/// ['at-rest', 'periodic', 'chaotic']
#[pyfunction]
#[pyo3(signature = (
    *, axial_forcing, restitution, impact_phase, normalised_speed, transient=Count::Fits(2000),
    impacts=Count::Fits(100_000), longest_period=Count::Fits(256), tolerance=Real(1e-7), progress=ProgressCallable(None)
), text_signature = "(*, axial_forcing, restitution, impact_phase, normalised_speed, transient=2000, impacts=100000, \
                     longest_period=256, tolerance=1e-07, progress=None)")]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
pub(crate) fn verdicts<'py>(
    py: Python<'py>,
    axial_forcing: &Bound<'py, PyAny>,
    restitution: &Bound<'py, PyAny>,
    impact_phase: &Bound<'py, PyAny>,
    normalised_speed: &Bound<'py, PyAny>,
    transient: Count,
    impacts: Count,
    longest_period: Count,
    tolerance: Real,
    progress: ProgressCallable,
) -> PyResult<Bound<'py, PyAny>> {
    let starts = Starts::new(axial_forcing, restitution, impact_phase, normalised_speed)?;
    let settings = VerdictSettings {
        transient: transient.u64(py, "transient")?,
        impacts: impacts.u64(py, "impacts")?,
        longest_period: longest_period.usize(py, "longest_period")?,
        tolerance: tolerance.0,
    };
    let names = [name("longest period", &["longest_period"])];
    let all = long_call::run_named(py, progress.0, &names, |observer| {
        let count = starts.axial_forcing.len();
        let mut all = room_for(count)?;
        // A start that is not legal is refused before any is followed.
        (0..count).try_for_each(|index| starts.state(index).map(|_| ()))?;
        let start = |index: usize| starts.state(index).map(Some);
        each_verdict(count, start, settings, observer, |verdict| all.extend(verdict.as_ref().map(numbers)))?;
        Ok(all)
    })?;
    let bytes = |of: fn(&Numbers) -> u8| results::array(py, all.iter().map(of).collect());
    let counts = |of: fn(&Numbers) -> u64| {
        let signed = |count: u64| i64::try_from(count).unwrap_or(i64::MAX);
        results::array(py, all.iter().map(|one| signed(of(one))).collect())
    };
    let doubles = |of: fn(&Numbers) -> f64| results::array(py, all.iter().map(of).collect());
    let multipliers = all.iter().flat_map(|one| one.multipliers).collect();
    let evidence = (
        results::array(py, starts.axial_forcing),
        results::array(py, starts.restitution),
        bytes(|one| one.kind),
        bytes(|one| one.reason),
        counts(|one| one.period),
        counts(|one| one.platform_periods),
        counts(|one| one.after),
        counts(|one| one.rests),
        doubles(|one| one.exponent),
        doubles(|one| one.standard_error),
        doubles(|one| one.rounding_error),
        results::matrix(py, multipliers, [all.len(), 2])?,
    );
    results::make(py, "Verdicts", evidence)
}
