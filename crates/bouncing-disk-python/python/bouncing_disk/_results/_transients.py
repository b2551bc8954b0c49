"""Transients of motors, and what is fitted to them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from bouncing_disk._native import Motor
from bouncing_disk._results._base import FloatArray, IntArray, Result


class Spread(NamedTuple):
    """A mean of many values, with their standard deviation and the standard error of the mean.

    One value alone tells neither: both are NaN then.
    """

    mean: float
    deviation: float
    standard_error: float


@dataclass(frozen=True, eq=False, repr=False)
class SpeedCurve(Result):
    """The speed of one motor from rest.

    Attributes
    ----------
    times : (n,) float64 array
        Middle of each interval (s).
    speeds : (n,) float64 array
        Mean angular speed over it (rad/s).
    impacts, separations : int
        How many impacts, and separations from rest, there were.
    """

    times: FloatArray
    speeds: FloatArray
    impacts: int
    separations: int


@dataclass(frozen=True, eq=False, repr=False)
class SpeedCurves(Result):
    """The speeds of many motors from rest, time by member.

    Attributes
    ----------
    times : (n, m) float64 array
        Middle of each interval (s).
    speeds : (n, m) float64 array
        Mean angular speed over it (rad/s).
    impacts, separations : (m,) int64 array
        How many impacts, and separations from rest, there were.
    """

    times: FloatArray
    speeds: FloatArray
    impacts: IntArray
    separations: IntArray


@dataclass(frozen=True, eq=False, repr=False)
class TransientEnsemble(Result):
    """The transients of one motor from many phases, time by member, with their exponential fits.

    Attributes
    ----------
    times : (n, m) float64 array
        Middle of each interval (s).
    speeds : (n, m) float64 array
        Mean angular speed over it (rad/s).
    impacts, separations : (m,) int64 array
        How many impacts, and separations from rest, there were.
    steady_speeds, time_constants, residuals : (m,) float64 array
        Fitted steady speed (rad/s), time constant (s) and residual (rad/s) of each member.
    steady_speed, time_constant, stall_acceleration : Spread
        Over the members (rad/s, s, rad/s^2).
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


@dataclass(frozen=True)
class ExponentialFit:
    """A speed that rises as steady_speed (1 - exp(-t/time_constant)).

    Attributes
    ----------
    steady_speed : float
        Steady speed (rad/s).
    time_constant : float
        Time constant t_c (s).
    residual : float
        Root mean square of what is left (rad/s).
    stall_acceleration : float
        Steady speed by time constant (rad/s^2).
    """

    steady_speed: float
    time_constant: float
    residual: float
    stall_acceleration: float


class IntervalEstimate(NamedTuple):
    """A value with its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class BrakingFit:
    """The straight line of a rotor that slows down, and the friction that it means.

    Attributes
    ----------
    friction : IntervalEstimate
        Coefficient of friction mu (Eq. 17). Its interval is that of the deceleration: what is uncertain of the
        rotor is not in it.
    deceleration : IntervalEstimate
        Angular deceleration (rad/s^2), positive whichever way the rotor turns.
    sliding_until : float
        Last time of the sliding part (s).
    points : int
        Points of the sliding part.
    correlation_time : float
        Integrated correlation time of the residuals (s).
    residual : float
        Root mean square of the residuals of the sliding part (rad/s).
    """

    friction: IntervalEstimate
    deceleration: IntervalEstimate
    sliding_until: float
    points: int
    correlation_time: float
    residual: float


@dataclass(frozen=True)
class RiseEstimate:
    """A form of rise that was fitted to runs.

    Attributes
    ----------
    steady_speed : IntervalEstimate
        Steady speed (rad/s).
    constant : IntervalEstimate
        Time constant of an exponential, rise time of a ramp (s).
    stall_acceleration : IntervalEstimate
        The first by the second (rad/s^2).
    start_speed : IntervalEstimate or None
        Speed at the start time of the fit (rad/s); None for a start from rest.
    residual : float
        Root mean square of what is left (rad/s).
    """

    steady_speed: IntervalEstimate
    constant: IntervalEstimate
    stall_acceleration: IntervalEstimate
    start_speed: IntervalEstimate | None
    residual: float


@dataclass(frozen=True)
class TransientFit:
    """Fits of the runs of a motor.

    Attributes
    ----------
    exponential : RiseEstimate
        The exponential rise.
    ramp : RiseEstimate or None
        The ramp, where one fits.
    form : str
        ``"exponential"`` or ``"ramp"``: which fits better.
    start_time : float
        First time that was fitted (s); rows before it have one speed. 0 for a start from rest.
    zero_time : float
        Time at which the fitted exponential is at rest (s): the switch-on and its dead time, if the motor rises from rest.
    duration : float
        Last time (s).
    points, members : int
        Points of a run, and runs.
    """

    exponential: RiseEstimate
    ramp: RiseEstimate | None
    form: str
    start_time: float
    zero_time: float
    duration: float
    points: int
    members: int


@dataclass(frozen=True, eq=False)
class ParameterFit(Result):
    """Parameters of a motor that were fitted to its transients.

    Attributes
    ----------
    nominal : dict of str to float
        The values of the data sheet (SI).
    estimates : dict of str to IntervalEstimate or None
        Values and 95 % intervals (SI); None for a parameter that the transients do not determine.
    undetermined : tuple of (dict, float)
        Directions that they do not determine, as changes of each parameter, and the standard error along
        each.
    motor : Motor
        The motor with the fitted parameters.
    misfit : float
        Sum of the weighted squares that is left.
    degrees_of_freedom : int
        Its expectation.
    evaluations : int
        How often all motors have been computed.
    """

    nominal: dict[str, float]
    estimates: dict[str, IntervalEstimate | None]
    undetermined: tuple[tuple[dict[str, float], float], ...]
    motor: Motor
    misfit: float
    degrees_of_freedom: int
    evaluations: int
