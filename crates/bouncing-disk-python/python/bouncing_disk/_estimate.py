"""Speed transients of motors, and fits of measured ones: of rises, of braking and of parameters."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from bouncing_disk import _native as native
from bouncing_disk._base import *
from bouncing_disk._motor import Motor
from bouncing_disk._system import ChatterCut, System

__all__ = [
    "BrakingFit",
    "ExponentialFit",
    "IntervalEstimate",
    "ParameterFit",
    "RiseEstimate",
    "SpeedCurve",
    "SpeedCurves",
    "Spread",
    "TransientEnsemble",
    "TransientFit",
    "ensemble",
    "fit_braking",
    "fit_exponential",
    "fit_parameters",
    "fit_transients",
    "read_speeds",
    "transient",
    "transients",
]


@dataclass(frozen=True, eq=False, repr=False)
class SpeedCurve(Result):
    """The speed of one motor from rest.

    Attributes:
        times: middle of each interval (s), shape (n,).
        speeds: mean angular speed over it (rad/s), shape (n,).
        impacts, separations: how many impacts, and separations from rest, there were.
    """

    times: FloatArray
    speeds: FloatArray
    impacts: int
    separations: int


def transient(
    system: System,
    *,
    phase: Float = 0.0,
    duration: Float = 3.0,
    intervals: Int = 600,
    relaunch_perturbation: Float = 0.001,
    seed: Int = 1,
    chatter: ChatterCut | None = None,
    progress: Progress = None,
) -> SpeedCurve:
    """The speed of a motor from rest, averaged over equal intervals.

    Args:
        phase: phase of the stator at the start (rad).
        duration: duration (s), positive.
        intervals: intervals of equal length, in [3, 1000000].
        relaunch_perturbation: size of the relaunch perturbation in units of g/omega, in [0, 1e100].
        seed: seed of the perturbations.
        chatter: how a chatter ends; ``None`` sums it.

    >>> import bouncing_disk as bd
    >>> curve = bd.transient(bd.System.motor(), duration=0.01, intervals=10)
    >>> curve.speeds.shape
    (10,)
    """
    return native.transient(locals())


@dataclass(frozen=True, eq=False, repr=False)
class SpeedCurves(Result):
    """The speeds of many motors from rest, time by member.

    Attributes:
        times: middle of each interval (s), shape (n, m).
        speeds: mean angular speed over it (rad/s), shape (n, m).
        impacts, separations: how many impacts, and separations from rest, there were, shape (m,).
    """

    times: FloatArray
    speeds: FloatArray
    impacts: IntArray
    separations: IntArray


def transients(
    systems: System | Iterable[System],
    *,
    phases: ArrayLike | None = None,
    seeds: Int | Iterable[Int] | None = None,
    duration: Float = 3.0,
    intervals: Int = 600,
    relaunch_perturbation: Float = 0.001,
    chatter: ChatterCut | None = None,
    progress: Progress = None,
) -> SpeedCurves:
    """The transients of many motors, each with its own phase and seed.

    Args:
        systems: the motors; a single one serves all members.
        phases: phase of the stator at the start of each (rad), shape (m,).
        seeds: seeds of the perturbations.
        duration, intervals, relaunch_perturbation, chatter: as of :func:`transient`, the same for all.

    >>> import bouncing_disk as bd
    >>> curves = bd.transients(bd.System.motor(), phases=[0.0, 1.0, 2.0], duration=0.01, intervals=10)
    >>> curves.speeds.shape
    (10, 3)
    """
    return native.transients(locals())


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
        impacts, separations: how many impacts, and separations from rest, there were, shape (m,).
        steady_speeds, time_constants, residuals: fitted steady speed (rad/s), time constant (s) and residual
            (rad/s) of each member, shape (m,).
        steady_speed, time_constant, stall_acceleration: over the members (rad/s, s, rad/s^2).
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
    system: System,
    *,
    members: Int,
    duration: Float = 3.0,
    intervals: Int = 600,
    relaunch_perturbation: Float = 0.001,
    seed: Int = 1,
    chatter: ChatterCut | None = None,
    progress: Progress = None,
) -> TransientEnsemble:
    """The transients of one motor from phases that are spread evenly, each with its exponential fit.

    Args:
        members: number of transients, in [1, 1000000].
        duration, intervals, relaunch_perturbation, seed, chatter: as of :func:`transient`.

    >>> import bouncing_disk as bd
    >>> runs = bd.ensemble(bd.System.motor(), members=4, duration=0.5, intervals=50)
    >>> runs.speeds.shape, runs.steady_speeds.shape
    ((50, 4), (4,))
    """
    return native.ensemble(locals())


@dataclass(frozen=True)
class ExponentialFit:
    """A speed that rises as steady_speed (1 - exp(-t/time_constant)).

    Attributes:
        steady_speed: steady speed (rad/s).
        time_constant: time constant t_c (s).
        residual: root mean square of the residuals (rad/s).
        stall_acceleration: steady speed by time constant (rad/s^2).
    """

    steady_speed: float
    time_constant: float
    residual: float
    stall_acceleration: float


def fit_exponential(*, times: ArrayLike, speeds: ArrayLike, progress: Progress = None) -> ExponentialFit:
    """The exponential rise 1 - exp(-t/t_c) that fits a speed curve best.

    Args:
        times: times (s), rising, not negative, shape (n,).
        speeds: speeds (rad/s), shape (n,).

    >>> import bouncing_disk as bd
    >>> import numpy as np
    >>> times = np.linspace(0.0, 5.0, 100)
    >>> fit = bd.fit_exponential(times=times, speeds=30.0 * (1.0 - np.exp(-times / 0.8)))
    >>> round(fit.steady_speed, 3), round(fit.time_constant, 3)
    (30.0, 0.8)
    """
    return native.fit_exponential(locals())


class IntervalEstimate(NamedTuple):
    """A value with its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class RiseEstimate:
    """A form of rise that was fitted to runs.

    Attributes:
        steady_speed: steady speed (rad/s).
        constant: time constant of an exponential, rise time of a ramp (s).
        stall_acceleration: the first by the second (rad/s^2).
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
        ramp: the ramp, where one fits.
        form: ``"exponential"`` or ``"ramp"``: which fits better.
        start_time: first fitted time (s); rows before it have one speed. 0 for a start from rest.
        zero_time: time at which the fitted exponential is at rest (s): the switch-on and its dead time, if
            the motor rises from rest.
        duration: last time (s).
        points, members: points of a run, and runs.
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
    """Steady speed, time constant and stall acceleration of a motor, with 95 % intervals, from runs of it.

    Args:
        times: times (s), rising; below zero, too, unless the motor starts from rest, shape (n,).
        speeds: speeds (rad/s) of one measured run, or of m runs (5 at least), time by member, shape (n,) or
            (n, m).
        resamples: resampled fits.
        seed: seed of the resampling.
        least_duration: time constants that a curve must last.
        largest_residual: the largest residual, relative to the steady speed.
        from_rest: whether the motor rises from rest at time zero. Without it time zero, a dead time and the
            speed at the start are found from the record, and the intervals are wider.

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


@dataclass(frozen=True)
class BrakingFit:
    """The straight line of a rotor that slows down, and the friction that follows.

    Attributes:
        friction: coefficient of friction mu (Eq. 17). Its interval is that of the deceleration, without
            the uncertainty of the rotor.
        deceleration: angular deceleration (rad/s^2), positive whichever way the rotor turns.
        sliding_until: last time of the sliding part (s).
        points: points of the sliding part.
        correlation_time: integrated correlation time of the residuals (s).
        residual: root mean square of the residuals of the sliding part (rad/s).
    """

    friction: IntervalEstimate
    deceleration: IntervalEstimate
    sliding_until: float
    points: int
    correlation_time: float
    residual: float


def fit_braking(
    *,
    times: ArrayLike,
    speeds: ArrayLike,
    normal_force: Float,
    mass: Float,
    contact_radius: Float,
    gyration_radius: Float,
) -> BrakingFit:
    """The coefficient of friction from the speeds of a rotor that slides on a platform at rest (Eq. 17).

    Args:
        times: times (s), rising, not negative, shape (n,).
        speeds: angular speeds (rad/s), sliding from the first point on; the standstill at the end is left
            out, shape (n,).
        normal_force: normal force N (N), positive: the preload.
        mass: mass m of the disk (kg), positive.
        contact_radius: effective contact radius a_e (m), positive.
        gyration_radius: radius of gyration a_g (m), positive.

    Raises:
        ComputationError: The curve does not fall, has fewer than eight points of sliding, or is not straight.

    >>> import bouncing_disk as bd
    >>> import numpy as np
    >>> times = np.arange(300) * 0.01
    >>> speeds = np.maximum(50.0 - 20.0 * times, 0.0)
    >>> fit = bd.fit_braking(times=times, speeds=speeds, normal_force=0.5, mass=0.05, contact_radius=0.002,
    ...     gyration_radius=0.01)
    >>> round(fit.friction.value, 9), round(fit.deceleration.value, 9)
    (0.1, 20.0)
    """
    return native.fit_braking(locals())


def read_speeds(
    path: str | os.PathLike[str],
    *,
    time_column: str | None = None,
    speed_column: str | None = None,
    time_unit: str | None = None,
    speed_unit: str | None = None,
) -> list[tuple[FloatArray, FloatArray]]:
    """Measured speeds from a file of separated values, as instruments write them.

    The first line that names the columns is the header; units are in the names, in the row below, or given here. Remarks,
    semicolons, tabs and decimal commas are legal; anything ambiguous is refused with its line and field.

    Args:
        path: the file: times, speeds and, for repeated runs, a number of the run (``member``).
        time_column, speed_column: the names of the columns, if they are not known ones; other columns are
            then ignored.
        time_unit: the unit of the times.
        speed_unit: the unit of the speeds.

    Returns:
        Times (s) and angular speeds (rad/s) of each run.
    """
    return native.read_speeds(locals())


@dataclass(frozen=True, eq=False)
class ParameterFit(Result):
    """Parameters of a motor fitted to its transients.

    Attributes:
        nominal: the values of the data sheet (SI).
        estimates: values and 95 % intervals (SI); None for a parameter that the transients do not determine.
        undetermined: directions that they do not determine, as changes of each parameter, and the standard
            error along each.
        motor: the motor with the fitted parameters.
        misfit: remaining sum of the weighted squares.
        degrees_of_freedom: its expectation.
        evaluations: how often all motors have been computed.
    """

    nominal: dict[str, float]
    estimates: dict[str, IntervalEstimate | None]
    undetermined: tuple[tuple[dict[str, float], float], ...]
    motor: Motor
    misfit: float
    degrees_of_freedom: int
    evaluations: int


def fit_parameters(
    motor: Motor,
    *,
    transients: Iterable[tuple[ArrayLike, ArrayLike, Float]],
    ranges: Mapping[str, Pair],
    speed_error: Float | None = None,
    members: Int = 64,
    windows: Int = 6,
    relaunch_perturbation: Float = 0.001,
    seed: Int = 1,
    most_evaluations: Int = 100,
    resamples: Int = 1000,
    largest_misfit: Float = 1.0,
    progress: Progress = None,
) -> ParameterFit:
    """Friction, restitution, phase lag or amplitudes of a motor from its transients, with 95 % intervals.

    Args:
        motor: the data sheet, from whose values the search begins.
        transients: for each preload the times (n,) (s), the speeds (n,) or (n, m) of one or m runs (rad/s),
            and the preload acceleration (m/s^2).
        ranges: the range (low, high) of each parameter that is fitted: of ``friction``, ``restitution``,
            ``phase_lag``, ``amplitude`` and ``twist_amplitude``.
        speed_error: standard deviation of the error of one measured speed (rad/s).
        members: computed members at each preload, in [24, 4096].
        windows: windows of time over whose means a transient is compared, in [1, 12].
        relaunch_perturbation: size of the relaunch perturbation in units of g/omega, in (0, 1].
        seed: seed of the perturbations and of the resampling.
        most_evaluations: most evaluations of all motors, in [1, 10000].
        resamples: resampled fits, in [200, 100000].
        largest_misfit: the largest misfit that is accepted, at least 1.
    """
    return native.fit_parameters(locals())
