"""What motors under a load give."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from bouncing_disk._native import Motor
from bouncing_disk._results._base import BoolArray, ByteArray, FloatArray, IntArray, Result


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
class OperatingPoints(Result):
    """How motors run under their loads; all arrays have the same shape.

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


@dataclass(frozen=True, eq=False, repr=False)
class TorqueSpeedCurve(OperatingPoints):
    """How a motor runs under n loads; all arrays have the shape (n,).

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

    def names(self) -> list[str]:
        """The status of each point in words, those of :attr:`STATUSES`."""
        return [self.STATUSES[status] for status in self.status]


@dataclass(frozen=True, eq=False, repr=False)
class MotorMap(OperatingPoints):
    """A motor in steady operation over one or two of its parameters.

    All arrays have one axis for each of `axes`, in their order.

    Attributes
    ----------
    motor : Motor
        The motor that is varied.
    axes : dict of str to (n,) float64 array
        The parameters and their values (SI).
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

    motor: Motor
    axes: dict[str, FloatArray]

    def names(self) -> list[list[str]]:
        """The status of each cell in words, those of :attr:`STATUSES`, row by row."""
        rows = self.status.reshape(len(self.status), -1)
        return [[self.STATUSES[status] for status in row] for row in rows]


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
class InputSpread:
    """How far a speed (rad/s) or a stall load (N m) lies apart over the tolerances of a motor's inputs.

    Attributes
    ----------
    mean, mean_error : float
        The mean over the draws and its standard error.
    standard_deviation, standard_deviation_error : float
        The standard deviation over the draws, without what statistical errors add, and its standard error.
    from_to : (float, float)
        The least and the largest draw: a further one lies between them with the chance (n - 1)/(n + 1) of n draws.
    draws, without : int
        Draws that have the number, and that have none.
    unsettled : int
        Draws of which the start-up leaves more than the standard deviation.
    trapped : int
        Draws that are in a low-period trap.
    """

    mean: float
    mean_error: float
    standard_deviation: float
    standard_deviation_error: float
    from_to: tuple[float, float]
    draws: int
    without: int
    unsettled: int
    trapped: int


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


@dataclass(frozen=True, eq=False, repr=False)
class LowPeriodTraps(Result):
    """Whether a motor is in a low-period trap under n preloads, with the evidence.

    Attributes
    ----------
    preload_acceleration : (n,) float64 array
        Preload as an acceleration (m/s^2).
    axial_forcing : (n,) float64 array
        Axial forcing parameter Gamma: with the restitution all that decides.
    is_trap : (n,) bool array
        Whether the perturbed motor repeats the short round.
    impacts, platform_periods, long_flights : (n,) int64 array
        What the round from one separation to the next has without perturbation, if it has at most eight long
        flights; 0 where there is none.
    relaunches, returns : (n,) int64 array
        Perturbed relaunches that were tried, and how many of them led through such a round.
    mean_platform_periods : (n,) float64 array
        Mean number of the stator's periods from one perturbed relaunch to the next; NaN without a round.
    """

    preload_acceleration: FloatArray
    axial_forcing: FloatArray
    is_trap: BoolArray
    impacts: IntArray
    platform_periods: IntArray
    long_flights: IntArray
    relaunches: IntArray
    returns: IntArray
    mean_platform_periods: FloatArray


@dataclass(frozen=True, eq=False)
class NearestTrap(Result):
    """The low-period trap that is nearest to a motor.

    Attributes
    ----------
    relative_distance : float
        The relative change of amplitude or preload, the smaller of the two, that reaches its near edge; 0 for
        a motor in the trap.
    preload_acceleration, amplitude, drive_frequency : float
        Each of these (m/s^2, m, Hz) at the near edge, if the others are kept.
    forcing_from_to : (float, float)
        From where to where in Gamma the trap reaches, as far as it was scanned.
    forcing_step : float
        Step of the scan in Gamma: traps that are narrower may have been missed.
    impacts, platform_periods, long_flights : int
        What the round in the middle of the trap has.
    return_share : float
        The share of perturbed relaunches there that return to the round, in [0, 1].
    """

    relative_distance: float
    preload_acceleration: float
    amplitude: float
    drive_frequency: float
    forcing_from_to: tuple[float, float]
    forcing_step: float
    impacts: int
    platform_periods: int
    long_flights: int
    return_share: float


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
        ``"no-lift-off"``, ``"periodic"``, ``"low-period-chattering"``, ``"long-chattering"``, ``"chaotic"``
        or ``"undecided"``.
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
