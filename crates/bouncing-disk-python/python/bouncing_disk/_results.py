"""What computations return: plain objects of NumPy arrays and numbers, which never change, compare and pickle."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from bouncing_disk._native import ImpactMap, Motor, PeriodicOrbit

__all__ = [
    "Attractor",
    "Basins",
    "BestPhaseLag",
    "Bifurcation",
    "DoublingCascade",
    "Energy",
    "EventTable",
    "ExponentialFit",
    "IntervalEstimate",
    "MotorReport",
    "OperatingPoint",
    "OrbitDiagram",
    "ParameterFit",
    "Result",
    "RiseEstimate",
    "SpeedCurve",
    "SpeedCurves",
    "Spread",
    "StallLoad",
    "TorqueSpeedCurve",
    "TossDesign",
    "TossOrbit",
    "TossPerformance",
    "TrajectorySamples",
    "TransientEnsemble",
    "TransientFit",
    "Verdicts",
]

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
ByteArray = npt.NDArray[np.uint8]
BoolArray = npt.NDArray[np.bool_]


def _restored(cls: Any, json: str) -> Any:
    """The object of a class that writes itself as JSON: what a pickle calls."""
    return cls.from_json(json)


def _same(one: Any, other: Any) -> bool:
    """Whether two values are equal, where NaN is equal to itself."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        inexact = np.issubdtype(one.dtype, np.inexact)
        return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=bool(inexact))
    if isinstance(one, float) and isinstance(other, float) and one != one:
        return other != other
    if isinstance(one, (tuple, list)) and type(one) is type(other):
        return len(one) == len(other) and all(map(_same, one, other))
    return type(one) is type(other) and bool(one == other)


def _shown(value: Any) -> str:
    """A value in a line of text: an array by its type and shape, if it is long."""
    if not isinstance(value, np.ndarray):
        return repr(value)
    return repr(value.tolist()) if value.size <= 4 else f"<{value.dtype} array {value.shape}>"


class Result:
    """What all results have in common: fields that compare by their values, arrays among them."""

    __dataclass_fields__: ClassVar[dict[str, Any]]
    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        """Whether all fields are equal, where NaN is equal to itself."""
        if type(self) is not type(other):
            return NotImplemented
        return all(_same(getattr(self, field.name), getattr(other, field.name)) for field in fields(self))

    def __repr__(self) -> str:
        """The fields, long arrays by their shape."""
        parts = (f"{field.name}={_shown(getattr(self, field.name))}" for field in fields(self))
        return f"{type(self).__name__}({', '.join(parts)})"


@dataclass(frozen=True, eq=False, repr=False)
class OrbitDiagram(Result):
    """The impacts of many orbits, one after the other.

    Those of orbit ``k`` are the items from ``offsets[k]`` to ``offsets[k + 1]``.

    Attributes
    ----------
    axial_forcing : (n,) float64 array
        Axial forcing parameter Gamma of each orbit.
    restitution : (n,) float64 array
        Coefficient of restitution of each orbit.
    offsets : (n + 1,) int64 array
        Where the impacts of each orbit begin; the last number is that of all impacts, m.
    impact_phase : (m,) float64 array
        Phase of each impact (rad), in [0, 2 pi).
    axial_impact_velocity : (m,) float64 array
        Velocity of the disk relative to the platform just before, not positive, in units of g/omega.

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> diagram = bd.orbit_diagram(axial_forcing=[0.45, 0.6], restitution=0.5, impact_phase=1.2,
    ...     normalised_speed=1.3, recorded=3)
    >>> diagram.column()
    array([0, 0, 0, 1, 1, 1])
    >>> diagram.of(0)[1].round(6)
    array([1.333333, 1.333333, 1.333333])
    """

    axial_forcing: FloatArray
    restitution: FloatArray
    offsets: IntArray
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray

    @property
    def normalised_speed(self) -> FloatArray:
        """Normalised impact speed |w_A Gamma/(omega A)| of each impact, shape (m,)."""
        speed: FloatArray = -self.axial_impact_velocity / np.pi
        return speed

    def column(self) -> IntArray:
        """Of which orbit each impact is, shape (m,): ``axial_forcing[diagram.column()]`` is the abscissa of a plot."""
        return np.repeat(np.arange(len(self.axial_forcing), dtype=np.int64), np.diff(self.offsets))

    def of(self, orbit: int) -> tuple[FloatArray, FloatArray]:
        """Phases (rad) and normalised speeds of the impacts of one orbit, as views."""
        impacts = slice(self.offsets[:-1][orbit], self.offsets[1:][orbit])
        return self.impact_phase[impacts], self.normalised_speed[impacts]


@dataclass(frozen=True, eq=False, repr=False)
class Basins(Result):
    """Basins of attraction on a grid of impacts.

    Attributes
    ----------
    impact_map : ImpactMap
        The map.
    labels : (speeds, phases) uint8 array
        What becomes of the start in each cell's centre; rows by rising speed.
    phase : (phases,) float64 array
        Impact phase of the cells' centres, in periods.
    speed : (speeds,) float64 array
        Normalised impact speed of the cells' centres.
    phase_range, speed_range : (float, float)
        Ends of the axes: ``(*phase_range, *speed_range)`` is the ``extent`` of a picture with ``origin="lower"``.
    meaning : tuple of str
        What each label means.

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> basins = bd.basins(bd.ImpactMap(axial_forcing=0.3, restitution=0.5), phases=20, speeds=10)
    >>> basins.meaning
    ('undecided', 'comes to rest')
    >>> float(basins.labels.min()), basins.share(bd.ATTACHED)
    (1.0, 1.0)
    """

    impact_map: ImpactMap
    labels: ByteArray
    phase: FloatArray
    speed: FloatArray
    phase_range: tuple[float, float]
    speed_range: tuple[float, float]
    meaning: tuple[str, ...]

    def share(self, label: int) -> float:
        """The share of the cells that have this label, in [0, 1]."""
        return int(np.count_nonzero(self.labels == label)) / self.labels.size


@dataclass(frozen=True, eq=False, repr=False)
class Verdicts(Result):
    """What many orbits do for good, and the evidence; numbers that a verdict does not have are 0 or NaN.

    Attributes
    ----------
    axial_forcing, restitution : (n,) float64 array
        The parameters of each orbit.
    kind : (n,) uint8 array
        The verdict: a place in :attr:`KINDS`.
    reason : (n,) uint8 array
        Why there is none: a place in :attr:`REASONS`.
    period : (n,) int64 array
        Impacts of one period of a periodic orbit or of one round of a chattering one.
    platform_periods : (n,) int64 array
        Periods of the platform that this takes.
    after : (n,) int64 array
        Impacts after which the verdict was known.
    rests : (n,) int64 array
        How often the disk came to rest on the way.
    exponent, standard_error : (n,) float64 array
        The largest Lyapunov exponent per impact and its standard error, where it was measured.
    rounding_error : (n,) float64 array
        How far rounding may have carried the impacts of a chattering round (rad and g/omega).
    multipliers : (n, 2) complex128 array
        Floquet multipliers of a periodic orbit.
    """

    KINDS: ClassVar[tuple[str, ...]] = ("periodic", "chaotic", "chattering", "at-rest", "undecided")
    REASONS: ClassVar[tuple[str, ...]] = ("", "exponent-near-zero", "no-period-found", "grazing")

    axial_forcing: FloatArray
    restitution: FloatArray
    kind: ByteArray
    reason: ByteArray
    period: IntArray
    platform_periods: IntArray
    after: IntArray
    rests: IntArray
    exponent: FloatArray
    standard_error: FloatArray
    rounding_error: FloatArray
    multipliers: npt.NDArray[np.complex128]

    def names(self) -> list[str]:
        """The verdicts in words, those of :attr:`KINDS`."""
        return [self.KINDS[kind] for kind in self.kind]

    def reasons(self) -> list[str]:
        """Why there is no verdict, those of :attr:`REASONS`: an empty text where there is one."""
        return [self.REASONS[reason] for reason in self.reason]


class Energy(NamedTuple):
    """An energy balance per unit mass (J/kg).

    Attributes
    ----------
    normal_work, friction_work : float
        Work of the platform by normal forces and by friction.
    restitution_loss, friction_loss : float
        What impacts and friction take away.
    load_work : float
        Work done against the load.
    axial_kinetic_change, potential_change, rotary_kinetic_change : float
        Changes of the three energies of the disk.
    """

    normal_work: float
    friction_work: float
    restitution_loss: float
    friction_loss: float
    load_work: float
    axial_kinetic_change: float
    potential_change: float
    rotary_kinetic_change: float


class TossPerformance(NamedTuple):
    """What a single toss gives, in SI units.

    Attributes
    ----------
    airborne_speed : float
        Rotary speed of the disk in the air (rad/s).
    efficiency : float
        Rotary energy that the disk has gained over the energy that was put in; NaN where none was.
    speed_ratio : float or None
        Airborne speed over the largest rotary speed of the platform; None without twist.
    separation_phase : float
        Phase of the separation (rad).
    sliding_at_separation : bool
        Whether the disk slides as it leaves.
    launch_speed : float
        Vertical speed of the disk as it leaves (m/s).
    rotary_energy_gain : float
        Rotary kinetic energy gained (J/kg).
    energy : Energy
        The balance up to the separation.
    """

    airborne_speed: float
    efficiency: float
    speed_ratio: float | None
    separation_phase: float
    sliding_at_separation: bool
    launch_speed: float
    rotary_energy_gain: float
    energy: Energy


@dataclass(frozen=True, eq=False, repr=False)
class TossOrbit(Result):
    """What a motion has settled on, in SI units.

    Attributes
    ----------
    kind : str
        ``"periodic"``, ``"chattering"``, ``"chaotic-or-long"`` or ``"at-rest"``.
    period, platform_periods : int
        Impacts and platform periods of one round of a periodic or chattering motion, else 0.
    long_flights : int
        Flights of a chattering round that last longer than half a period.
    multipliers : (3,) complex128 array
        Floquet multipliers of a periodic orbit: two of the vertical motion, one of the rotation; else NaN.
    lyapunov_exponent : float or None
        Growth per impact of a motion that does not repeat, where it was measured.
    mean_angular_speed : float or None
        Mean angular speed (rad/s); None at rest.
    rotation_repeats : bool or None
        Whether the angular speed repeats as well; None where nothing repeats.
    time, impact_phase : (m,) float64 array
        Instant (s) and phase (rad) of each collision: of one round, or all that were examined.
    axial_impact_velocity : (m,) float64 array
        Axial velocity of the disk relative to the platform just before (m/s), not positive.
    tangential_impact_velocity : (m,) float64 array
        Angular speed of the disk relative to the platform just before (rad/s).
    angular_speed, angle : (m,) float64 array
        Angular speed of the disk just before (rad/s), and the angle that it has turned (rad).
    capped : (m,) bool array
        Whether friction ended the slip within the impact.
    """

    kind: str
    period: int
    platform_periods: int
    long_flights: int
    multipliers: npt.NDArray[np.complex128]
    lyapunov_exponent: float | None
    mean_angular_speed: float | None
    rotation_repeats: bool | None
    time: FloatArray
    impact_phase: FloatArray
    axial_impact_velocity: FloatArray
    tangential_impact_velocity: FloatArray
    angular_speed: FloatArray
    angle: FloatArray
    capped: BoolArray


@dataclass(frozen=True, eq=False, repr=False)
class TrajectorySamples(Result):
    """Disk and platform at many instants, in SI units; all arrays have the shape (n,).

    Attributes
    ----------
    time : float64 array
        Seconds from phase 0 of the first period.
    height, axial_velocity : float64 array
        Of the disk (m, m/s), above the platform's mean height.
    angle, angular_speed : float64 array
        Of the disk (rad, rad/s); the angle starts at the platform's own.
    platform_height, platform_axial_velocity, platform_angle, platform_angular_speed : float64 array
        Those of the platform.
    mode : uint8 array
        How the disk moves: a place in :attr:`MODES`.
    """

    MODES: ClassVar[tuple[str, ...]] = ("flight", "sticking", "sliding-forward", "sliding-backward")

    time: FloatArray
    height: FloatArray
    axial_velocity: FloatArray
    angle: FloatArray
    angular_speed: FloatArray
    platform_height: FloatArray
    platform_axial_velocity: FloatArray
    platform_angle: FloatArray
    platform_angular_speed: FloatArray
    mode: ByteArray


@dataclass(frozen=True, eq=False, repr=False)
class EventTable(Result):
    """The events of a motion, in SI units; all arrays have the shape (n,).

    Attributes
    ----------
    time, phase : float64 array
        Instant (s) and phase of the platform (rad).
    kind : uint8 array
        What happened: a place in :attr:`KINDS`.
    mode_before, mode_after : uint8 array
        How the disk moves: places in :attr:`TrajectorySamples.MODES`.
    height, angle : float64 array
        Of the disk (m, rad).
    axial_velocity_before, axial_velocity_after : float64 array
        Of the disk (m/s).
    angular_speed_before, angular_speed_after : float64 array
        Of the disk (rad/s).
    axial_impact_velocity, tangential_impact_velocity : float64 array
        Disk minus platform just before an impact (m/s, rad/s), else NaN.
    capped : bool array
        Whether friction ended the slip within an impact.
    summed_impacts : int64 array
        Impacts that an attachment has summed, else 0.
    error_bound : float64 array
        Bound on the error of an attachment's phase (rad), else NaN.
    """

    KINDS: ClassVar[tuple[str, ...]] = (
        "impact",
        "attachment",
        "separation",
        "stick-to-slip",
        "slip-to-stick",
        "slip-reversal",
    )

    time: FloatArray
    phase: FloatArray
    kind: ByteArray
    mode_before: ByteArray
    mode_after: ByteArray
    height: FloatArray
    axial_velocity_before: FloatArray
    axial_velocity_after: FloatArray
    angle: FloatArray
    angular_speed_before: FloatArray
    angular_speed_after: FloatArray
    axial_impact_velocity: FloatArray
    tangential_impact_velocity: FloatArray
    capped: BoolArray
    summed_impacts: IntArray
    error_bound: FloatArray

    def names(self) -> list[str]:
        """What happened, in words: those of :attr:`KINDS`."""
        return [self.KINDS[kind] for kind in self.kind]


class Spread(NamedTuple):
    """A mean of many values, with their standard deviation and the standard error of the mean."""

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
    residual : float
        What is left, relative to the steady speed.
    """

    steady_speed: IntervalEstimate
    constant: IntervalEstimate
    stall_acceleration: IntervalEstimate
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
    duration : float
        Last time (s).
    points, members : int
        Points of a run, and runs.
    """

    exponential: RiseEstimate
    ramp: RiseEstimate | None
    form: str
    duration: float
    points: int
    members: int


@dataclass(frozen=True, eq=False, repr=False)
class OperatingPoint(Result):
    """How a motor runs under a load; ``..._error`` are standard errors, and what there is none of is NaN.

    Attributes
    ----------
    load_torque : float
        Load torque (N m).
    speed, speed_error : float
        Mean angular speed (rad/s).
    mechanical_power, mechanical_power_error : float
        Load torque times mean speed (W).
    input_power, input_power_error : float
        Power that the stator puts in (W).
    restitution_loss, restitution_loss_error, friction_loss, friction_loss_error : float
        Power lost in impacts and in friction (W).
    efficiency, efficiency_error : float
        Mechanical power over the power put in.
    perturbation_power : float
        Power that the perturbations of the relaunches put in (W).
    energy_residual : float
        What the energy balance leaves, relative.
    averaged_time, start_up : float
        Time that was averaged over, of all members together, and that was left out, of each (s).
    acceleration : float
        Acceleration that a motor tends to which its load overpowers (rad/s^2), else NaN.
    impacts : int
        Impacts of all members.
    status : str
        ``"steady"``, ``"unsettled"`` or ``"runaway"``.
    shortfall : str
        What an unsettled one lacks.
    """

    load_torque: float
    speed: float
    speed_error: float
    mechanical_power: float
    mechanical_power_error: float
    input_power: float
    input_power_error: float
    restitution_loss: float
    restitution_loss_error: float
    friction_loss: float
    friction_loss_error: float
    efficiency: float
    efficiency_error: float
    perturbation_power: float
    energy_residual: float
    averaged_time: float
    start_up: float
    acceleration: float
    impacts: int
    status: str
    shortfall: str


@dataclass(frozen=True, eq=False, repr=False)
class TorqueSpeedCurve(Result):
    """How a motor runs under many loads; all arrays have the shape (n,).

    Attributes
    ----------
    load_torque, speed, speed_error, mechanical_power, mechanical_power_error : float64 array
        As of :class:`OperatingPoint`.
    input_power, input_power_error, restitution_loss, restitution_loss_error : float64 array
        As of :class:`OperatingPoint`.
    friction_loss, friction_loss_error, efficiency, efficiency_error, perturbation_power : float64 array
        As of :class:`OperatingPoint`.
    energy_residual, averaged_time, start_up, acceleration : float64 array
        As of :class:`OperatingPoint`.
    impacts : int64 array
        Impacts of all members.
    status : uint8 array
        A place in :attr:`STATUSES`.
    """

    STATUSES: ClassVar[tuple[str, ...]] = ("steady", "unsettled", "runaway")

    load_torque: FloatArray
    speed: FloatArray
    speed_error: FloatArray
    mechanical_power: FloatArray
    mechanical_power_error: FloatArray
    input_power: FloatArray
    input_power_error: FloatArray
    restitution_loss: FloatArray
    restitution_loss_error: FloatArray
    friction_loss: FloatArray
    friction_loss_error: FloatArray
    efficiency: FloatArray
    efficiency_error: FloatArray
    perturbation_power: FloatArray
    energy_residual: FloatArray
    averaged_time: FloatArray
    start_up: FloatArray
    acceleration: FloatArray
    impacts: IntArray
    status: ByteArray

    def names(self) -> list[str]:
        """The status of each point in words, those of :attr:`STATUSES`."""
        return [self.STATUSES[status] for status in self.status]


@dataclass(frozen=True)
class StallLoad:
    """The load at which a motor stops.

    Attributes
    ----------
    torque, torque_error : float
        The torque and its standard error (N m).
    share : float
        The torque as a share of the largest mean torque of friction.
    bracket : (float, float)
        Loads (N m) under which it surely turns on, and is surely driven back.
    no_load_speed, no_load_speed_error : float
        Mean speed without load and its standard error (rad/s).
    """

    torque: float
    torque_error: float
    share: float
    bracket: tuple[float, float]
    no_load_speed: float
    no_load_speed_error: float


@dataclass(frozen=True)
class BestPhaseLag:
    """The phase lag at which a motor turns fastest.

    Attributes
    ----------
    phase_lag, phase_lag_error : float
        The lag and its standard error (rad).
    speed, speed_error : float
        The mean speed there and its standard error (rad/s).
    good_from_to : (float, float)
        The lags (rad) at which 99 % of that speed is left.
    """

    phase_lag: float
    phase_lag_error: float
    speed: float
    speed_error: float
    good_from_to: tuple[float, float]


@dataclass(frozen=True, eq=False)
class MotorReport(Result):
    """What a data sheet says before anything turns.

    Attributes
    ----------
    axial_forcing : float
        Axial forcing parameter Gamma.
    angular_forcing : float or None
        Angular forcing parameter Gamma_T; None without friction.
    peak_acceleration : float
        The stator's largest acceleration in units of the preload acceleration.
    regime : str
        ``"no-lift-off"``, ``"periodic"``, ``"low-period-chattering"``, ``"long-chattering"``, ``"chaotic"`` or
        ``"undecided"``.
    regime_impacts : int
        Impacts of a round, or that were looked at.
    regime_platform_periods : float
        Periods of the stator in a round, or between two rests on average; NaN where nothing repeats.
    regime_rests : int
        Rests that were seen in long chattering.
    lyapunov_exponent : float
        Growth per impact of a chaotic motion, else NaN.
    periods_per_flight : float or None
        Mean number of the stator's periods in a flight longer than half a period.
    largest_torque : float
        The largest mean torque of friction (N m).
    static_deflection : float or None
        Static deflection of the preload's spring (m).
    preload_change_bound : float or None
        Bound on the relative change of the preload in a flight.
    warnings : tuple of str
        What is unlikely to be meant.
    text : str
        All of it, to be printed.
    """

    axial_forcing: float
    angular_forcing: float | None
    peak_acceleration: float
    regime: str
    regime_impacts: int
    regime_platform_periods: float
    regime_rests: int
    lyapunov_exponent: float
    periods_per_flight: float | None
    largest_torque: float
    static_deflection: float | None
    preload_change_bound: float | None
    warnings: tuple[str, ...]
    text: str

    def __str__(self) -> str:
        """The text."""
        return self.text


@dataclass(frozen=True, eq=False)
class Attractor(Result):
    """An attractor of an impact map.

    Attributes
    ----------
    kind : str
        ``"rest"``, ``"periodic"``, ``"chaotic"`` or ``"unclassified"``.
    label : int
        Its label in :attr:`Basins.labels`.
    orbit : PeriodicOrbit or None
        The orbit of a periodic one.
    radius : float
        The radius (rad) within which a start counts as caught by that orbit, else NaN.
    exponent, standard_error : float
        The largest Lyapunov exponent per impact of a chaotic one and its standard error, else NaN.
    share : float
        The share of the starts that ended on it.
    interval : (float, float)
        Its 95 % interval.
    lasts : bool
        Whether the motion lasts: not that of a disk which rests and never does so again.
    leads_to : int or None
        The number of the attractor that a rest leads to.
    meaning : str
        What it is, in words.
    """

    kind: str
    label: int
    orbit: PeriodicOrbit | None
    radius: float
    exponent: float
    standard_error: float
    share: float
    interval: tuple[float, float]
    lasts: bool
    leads_to: int | None
    meaning: str


@dataclass(frozen=True, eq=False)
class Bifurcation(Result):
    """A special point of a branch of periodic orbits.

    Attributes
    ----------
    kind : str
        ``"doubling"``, ``"fold"``, ``"graze"``, ``"vanishing-impact"`` or ``"birth"``.
    parameter : float
        The value of the parameter.
    arclength : float
        Arclength from the start of the branch.
    impact : int or None
        Which impact grazes or vanishes.
    orbit : PeriodicOrbit
        The orbit there.
    """

    kind: str
    parameter: float
    arclength: float
    impact: int | None
    orbit: PeriodicOrbit


@dataclass(frozen=True, eq=False, repr=False)
class DoublingCascade(Result):
    """A period-doubling cascade; n doublings, and Feigenbaum's numbers from some of them.

    Attributes
    ----------
    period : (n,) int64 array
        Impacts of the orbit that loses its stability.
    axial_forcing, forcing_error : (n,) float64 array
        The forcing Gamma_n, and how far rounding may have moved it.
    multiplier : (n,) float64 array
        The multiplier that the search left, -1 but for rounding.
    width : (n,) float64 array
        The largest distance (rad) of an impact from the one half a period later.
    graze_margin : (n,) float64 array
        How near a flight comes to an earlier impact, in units of g/omega^2; infinite where none dips.
    feigenbaum_number : (m,) int64 array
        The last doubling that was used for each estimate, from 1.
    delta, delta_error, alpha, alpha_error : (m,) float64 array
        Feigenbaum's numbers, extrapolated, and how far they may be off.
    """

    period: IntArray
    axial_forcing: FloatArray
    forcing_error: FloatArray
    multiplier: FloatArray
    width: FloatArray
    graze_margin: FloatArray
    feigenbaum_number: IntArray
    delta: FloatArray
    delta_error: FloatArray
    alpha: FloatArray
    alpha_error: FloatArray


@dataclass(frozen=True)
class TossDesign:
    """The best hand motion, and what it gives.

    Attributes
    ----------
    stroke, amplitude_angle, angular_frequency, phase_lag : float
        The hand motion (m, rad, rad/s, rad).
    amplitude_ratio : float
        The tangent of the amplitude angle.
    value : float
        The objective, over the range of friction: rad/s, a share, or turns.
    toss : TossPerformance
        The toss at the middle of the range of friction.
    flight_height : float
        How high the dough flies above the place where it leaves the hand (m).
    turns : float
        Turns until it is back there.
    grid_points : int
        Hand motions on the grid from which the optimum was found.
    best_on_grid : float
        The best of them.
    hidden_gain : float
        What the objective could be above the optimum at most.
    """

    stroke: float
    amplitude_angle: float
    angular_frequency: float
    phase_lag: float
    amplitude_ratio: float
    value: float
    toss: TossPerformance
    flight_height: float
    turns: float
    grid_points: int
    best_on_grid: float
    hidden_gain: float


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
        Directions that they do not determine, as changes of each parameter, and the standard error along each.
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
