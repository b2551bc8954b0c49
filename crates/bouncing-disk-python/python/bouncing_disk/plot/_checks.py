"""What the figures ask of numbers that a user gives them, with errors that name the argument."""

from __future__ import annotations

import operator
from typing import Any

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd

__all__ = ["finite_array", "number", "rising_array", "same_length", "whole_number"]


def out_of_range(field: str, value: float, legal: str) -> bd.OutOfRangeError:
    """The error of a value outside of its range."""
    return bd.OutOfRangeError(f"{field} is {value}, outside {legal}", field, float(value), legal)


def number(field: str, value: Any, *, positive: bool = False) -> float:
    """A finite number, or a positive one."""
    if isinstance(value, (str, bytes, complex)):
        raise TypeError(f"{field} must be a number, not {type(value).__name__}")
    try:
        given = float(value)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{field} must be a number, not {type(value).__name__}") from error
    if not np.isfinite(given) or (positive and given <= 0.0):
        raise out_of_range(field, given, "(0, infinity)" if positive else "(-infinity, infinity)")
    return given


def whole_number(field: str, value: Any, least: int, most: int | None = None) -> int:
    """A whole number from `least` on, and up to `most`."""
    try:
        given = operator.index(value)
    except TypeError as error:
        raise TypeError(f"{field} must be a whole number, not {type(value).__name__}") from error
    if given < least or (most is not None and given > most):
        raise out_of_range(field, given, f"[{least}, {'infinity)' if most is None else f'{most}]'}")
    return given


def finite_array(field: str, values: npt.ArrayLike, *, positive: bool = False) -> npt.NDArray[np.float64]:
    """Finite numbers in one dimension; a single number is an array of one."""
    try:
        given = np.asarray(values)
        if given.dtype.kind not in "biuf" and given.size > 0:
            raise TypeError
        array: npt.NDArray[np.float64] = np.atleast_1d(given.astype(np.float64))
    except (TypeError, ValueError) as error:
        raise TypeError(f"{field} must be an array of numbers") from error
    if array.ndim != 1:
        message = f"{field} has {array.ndim} dimensions; legal is one"
        raise bd.InvalidError(message, "not-one-dimensional", {"field": field, "dimensions": array.ndim})
    legal = np.isfinite(array) & ((array > 0.0) | (not positive))
    if not legal.all():
        worst = float(array[~legal][0])
        raise out_of_range(field, worst, "(0, infinity)" if positive else "(-infinity, infinity)")
    return array


def rising_array(field: str, values: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Finite numbers, each above the one before."""
    array = finite_array(field, values)
    falls = np.flatnonzero(np.diff(array) <= 0.0)
    if len(falls):
        place = int(falls[0]) + 1
        message = f"{field}[{place}] is {array[place]}, which is not above the one before"
        raise bd.InvalidError(message, "not-rising", {"field": field, "index": place})
    return array


def same_length(fields: tuple[str, str], one: npt.NDArray[Any], other: npt.NDArray[Any]) -> None:
    """Two arrays that belong together."""
    if len(one) != len(other):
        message = f"{fields[0]} has {len(one)} values, and {fields[1]} has {len(other)}"
        raise bd.InvalidError(message, "lengths-differ", {fields[0]: len(one), fields[1]: len(other)})
