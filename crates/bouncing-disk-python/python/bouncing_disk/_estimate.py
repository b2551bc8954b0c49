"""Speed transients of motors, and fits of measured ones."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from bouncing_disk import _native as native
from bouncing_disk._base import *
from bouncing_disk._motor import Motor
from bouncing_disk._system import ChatterCut, Drive, System

__all__ = [
    "IntervalEstimate",
    "RatedFit",
    "RiseEstimate",
    "Spread",
    "TransientEnsemble",
    "TransientFit",
    "ensemble",
    "fit_rated_points",
    "fit_transients",
    "read_speeds",
]


class Spread(NamedTuple):
    """A mean of many values, with their standard deviation and the standard error of the mean.

    For a single value both errors are NaN.
    """

    mean: float
    deviation: float
    standard_error: float


@dataclass(frozen=True, eq=False, repr=False)
class TransientEnsemble(Result):
    """The transients of one motor from many phases, time by member, with their exponential fits.

    Attributes:
        times: middle of each interval (s), shape (n, m).
        speeds: mean angular speed over it (rad/s), shape (n, m).
        impacts, separations: number of impacts, and of separations from rest, shape (m,).
        steady_speeds, time_constants, residuals: fitted steady speed (rad/s), time constant (s) and residual
            (rad/s) of each member, shape (m,).
        steady_speed, time_constant, stall_acceleration: statistics over the members (rad/s, s, rad/s^2).
    """

    times: FloatArray
    speeds: FloatArray
    impacts: IntArray
    separations: IntArray
    steady_speeds: FloatArray
    time_constants: FloatArray
    residuals: FloatArray
    steady_speed: Spread
    time_constant: Spread
    stall_acceleration: Spread


def ensemble(
    system: System | Motor,
    *,
    members: Int = 10,
    duration: Float = 3.0,
    intervals: Int = 600,
    relaunch_perturbation: Float = 0.001,
    seed: Int = 1,
    drive: Drive | None = None,
    contact_time: Float | None = None,
    chatter: ChatterCut | None = None,
    progress: Progress = None,
) -> TransientEnsemble:
    """The transients of one motor from evenly spread phases, each with its exponential fit.

    Args:
        system: a system, or a motor, which states the mass that a compliant stator needs.
        members: number of transients, in [1, 1000000].
        duration: duration (s), positive.
        intervals: intervals of equal length over which speeds are averaged, in [3, 1000000].
        relaunch_perturbation: size of the relaunch perturbation in units of g/omega, in [0, 1e100].
        seed: seed of the perturbations.
        drive: motion of the stator, instead of the drive of the data sheet.
        contact_time: duration of an impact (s), positive; ``None`` for rigid impacts.
        chatter: how a chatter ends; ``None`` sums it.

    >>> import bouncing_disk as bd
    >>> runs = bd.ensemble(bd.System.motor(), members=4, duration=0.5, intervals=50)
    >>> runs.speeds.shape, runs.steady_speeds.shape
    ((50, 4), (4,))
    """
    return native.ensemble(locals())


class IntervalEstimate(NamedTuple):
    """A value with its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class RiseEstimate:
    """A form of rise fitted to runs.

    Attributes:
        steady_speed: steady speed (rad/s).
        constant: time constant of an exponential, rise time of a ramp (s).
        stall_acceleration: steady speed over that constant (rad/s^2).
        start_speed: speed at the start time of the fit (rad/s); None for a start from rest.
        residual: root mean square of the residuals (rad/s).
    """

    steady_speed: IntervalEstimate
    constant: IntervalEstimate
    stall_acceleration: IntervalEstimate
    start_speed: IntervalEstimate | None
    residual: float


@dataclass(frozen=True)
class TransientFit:
    """Fits of the runs of a motor.

    Attributes:
        exponential: the exponential rise.
        ramp: the ramp, if one fits.
        form: the better fit, ``"exponential"`` or ``"ramp"``.
        start_time: first fitted time (s); the speed is constant before it. 0 for a start from rest.
        zero_time: time at which the fitted exponential starts from rest (s): the switch-on plus the dead time, if the
            motor rises from rest.
        duration: last time (s).
        points, members: points of a run, and number of runs.
    """

    exponential: RiseEstimate
    ramp: RiseEstimate | None
    form: str
    start_time: float
    zero_time: float
    duration: float
    points: int
    members: int


def fit_transients(
    *,
    times: ArrayLike,
    speeds: ArrayLike,
    resamples: Int = 1000,
    seed: Int = 1,
    least_duration: Float = 3.0,
    largest_residual: Float = 0.1,
    from_rest: bool = False,
    progress: Progress = None,
) -> TransientFit:
    """Steady speed, time constant and stall acceleration of a motor, with 95 % intervals, from its runs.

    Args:
        times: times (s), rising; not negative if the motor starts from rest, shape (n,).
        speeds: speeds (rad/s) of one measured run, or of m runs (at least 5), time by member, shape (n,) or
            (n, m).
        resamples: number of resampled fits.
        seed: seed of the resampling.
        least_duration: least duration of a curve, in time constants.
        largest_residual: the largest residual, relative to the steady speed.
        from_rest: whether the motor rises from rest at time zero. Otherwise time zero, a dead time and the
            initial speed are found from the record, and the intervals are wider.

    >>> import bouncing_disk as bd
    >>> import numpy as np
    >>> times = np.linspace(0.01, 5.0, 200)
    >>> spread = np.array([0.97, 0.98, 0.99, 1.01, 1.02, 1.03])
    >>> speeds = 30.0 * (1.0 - np.exp(-times / 0.8))[:, np.newaxis] * spread
    >>> fit = bd.fit_transients(times=times, speeds=speeds)
    >>> fit.form, fit.members, fit.exponential.steady_speed.low < 30.0 < fit.exponential.steady_speed.high
    ('exponential', 6, True)
    """
    return native.fit_transients(locals())


@dataclass(frozen=True, eq=False, repr=False)
class RatedFit(Result):
    """Parameters of a motor estimated from rated points.

    Attributes:
        accepted: for each parameter the ranges not excluded with 95 % confidence, as (low, high), with None for an
            end that reaches the end of the searched range.
        fitted, standard_errors: the speed of the best motor at each point, and the standard error of its
            difference from the rated speed (rad/s).
        misfit, degrees_of_freedom: the remaining sum of weighted squares, and its expectation.
        evaluations: number of parameter sets at which all points were computed.
        settled: whether these evaluations were enough; otherwise more evaluations or impacts would narrow the ranges.
        text: everything in words, with the undetermined directions.
    """

    accepted: dict[str, list[tuple[float | None, float | None]]]
    fitted: FloatArray
    standard_errors: FloatArray
    misfit: float
    degrees_of_freedom: int
    evaluations: int
    settled: bool
    text: str


def fit_rated_points(
    motor: Motor,
    *,
    points: Sequence[Mapping[str, Float]],
    ranges: Mapping[str, Pair],
    most_evaluations: Int = 200,
    most_impacts: Int = 500_000,
    seed: Int = 1,
    progress: Progress = None,
) -> RatedFit:
    """Estimates unknown parameters of a motor from the few steady speeds in its catalogue.

    Args:
        motor: the data sheet, with all other values.
        points: for each point the ``speed`` (rad/s; 0 at the stall torque), optionally its ``speed_error``, and the
            fields that differ from the data sheet, such as ``load_torque`` or ``stator.volts``, optionally with their
            standard errors (``load_torque_error``).
        ranges: range of each fitted parameter: friction, restitution, phase_lag, amplitude, twist_amplitude,
            contact.time, stator.mass, stator.quality, stator.twist_per_height.
        most_evaluations: largest number of parameter sets at which all points are computed, in [8, 400].
        most_impacts: largest number of impacts for a computed speed, all members together.
        seed: seed of the perturbations.

    >>> import bouncing_disk as bd
    >>> point = {"speed": 21.4, "speed_error": 0.5, "load_torque": 0.0}
    >>> twist = {"twist_amplitude": (2e-5, 2e-4)}
    >>> fit = bd.fit_rated_points(bd.Motor.paper_70_khz(), points=[point], ranges=twist, most_evaluations=12)
    >>> [(low, high)] = fit.accepted["twist_amplitude"]
    >>> low < 30.0 / (2 * 3.14159 * 70e3) < high
    True
    """
    return native.fit_rated_points(locals())


def read_speeds(
    path: str | os.PathLike[str],
    *,
    time_column: str | None = None,
    speed_column: str | None = None,
    time_unit: str | None = None,
    speed_unit: str | None = None,
) -> list[tuple[FloatArray, FloatArray]]:
    """Measured speeds from a file of separated values, as instruments write them.

    The first line that names the columns is the header; units are in the names, in the row below, or given
    here. Remarks, semicolons, tabs and decimal commas are legal; anything ambiguous raises an error that names
    line and field.

    Args:
        path: the file: times, speeds and, for repeated runs, the number of the run (``member``).
        time_column, speed_column: names of the columns, if they are not standard; other columns are
            then ignored.
        time_unit: the unit of the times.
        speed_unit: the unit of the speeds.

    Returns:
        Times (s) and angular speeds (rad/s) of each run.
    """
    return native.read_speeds(locals())
