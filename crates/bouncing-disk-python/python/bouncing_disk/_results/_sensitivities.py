"""What a motor depends on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from bouncing_disk._native import Motor
from bouncing_disk._results._base import ByteArray, FloatArray, IntArray, Result


@dataclass(frozen=True, eq=False, repr=False)
class LocalSensitivities(Result):
    """How a quantity of a motor depends on n of its parameters, next to its data sheet.

    Attributes
    ----------
    parameters : tuple of str
        The parameters.
    derivative, standard_error : (n,) float64 array
        d ln(quantity)/d ln(parameter); of the phase lag d ln(quantity)/d theta (1/rad), of the load torque d
        ln(quantity) over its change in units of mu m g a_e.
    method : tuple of str
        ``"shared-motion"``, by a difference of rotors on the same vertical motions, or ``"regression"``, by a line
        through motors with different ones.
    traps : (n,) int64 array
        Motors of a regression that were left out, since they are in a low-period trap.
    quantity : str
        ``"steady-speed"`` or ``"stall-torque"``.
    """

    parameters: tuple[str, ...]
    derivative: FloatArray
    standard_error: FloatArray
    method: tuple[str, ...]
    traps: IntArray
    quantity: str


@dataclass(frozen=True, eq=False, repr=False)
class SobolIndices(Result):
    """Which share of the variance of a quantity each of n parameters has over its range.

    Attributes
    ----------
    parameters : tuple of str
        The parameters.
    first, first_error : (n,) float64 array
        The share that goes if this parameter alone is known, and its standard error. Near zero it may be negative.
    total, total_error : (n,) float64 array
        The share that is left if all others are known, and its standard error.
    quantity : str
        ``"steady-speed"`` or ``"stall-torque"``.
    """

    parameters: tuple[str, ...]
    first: FloatArray
    first_error: FloatArray
    total: FloatArray
    total_error: FloatArray
    quantity: str


@dataclass(frozen=True, eq=False, repr=False)
class ElementaryEffects(Result):
    """By how much a quantity (rad/s or N m) changes over the range of each of n parameters.

    Attributes
    ----------
    parameters : tuple of str
        The parameters.
    mean, mean_error : (n,) float64 array
        Mean effect mu, and its standard error.
    mean_size, mean_size_error : (n,) float64 array
        Mean without the signs, mu*.
    deviation, deviation_error : (n,) float64 array
        Standard deviation sigma: the effect is not the same everywhere.
    quantity : str
        ``"steady-speed"`` or ``"stall-torque"``.
    """

    parameters: tuple[str, ...]
    mean: FloatArray
    mean_error: FloatArray
    mean_size: FloatArray
    mean_size_error: FloatArray
    deviation: FloatArray
    deviation_error: FloatArray
    quantity: str


@dataclass(frozen=True, eq=False, repr=False)
class MotorMap(Result):
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

    STATUSES: ClassVar[tuple[str, ...]] = ("steady", "unsettled", "runaway")

    motor: Motor
    axes: dict[str, FloatArray]
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

    def names(self) -> list[list[str]]:
        """The status of each cell in words, those of :attr:`STATUSES`, row by row."""
        rows = self.status.reshape(len(self.status), -1)
        return [[self.STATUSES[status] for status in row] for row in rows]
