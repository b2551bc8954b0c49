"""What a motor depends on."""

from __future__ import annotations

from dataclasses import dataclass

from bouncing_disk._results._base import FloatArray, IntArray, Result


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
