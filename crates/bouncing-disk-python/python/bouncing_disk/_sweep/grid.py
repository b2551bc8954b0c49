"""The grid of a sweep: the Cartesian product of its axes, numbered with the last axis fastest."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from bouncing_disk._errors import InvalidError, TooLargeError

__all__ = ["Array", "Grid", "array_digest", "refuse_masked"]

Array = npt.NDArray[Any]

#: The most points of a grid: their numbers are exact in a double, too.
_MOST_POINTS = 2**53

#: Kinds of NumPy types that an axis may have: bool, integers, floats, complex numbers, text.
_KINDS = "biufcU"


def array_digest(array: Array) -> str:
    """The SHA-256 of the type, the shape and the bytes of an array."""
    digest = hashlib.sha256(repr((array.dtype.descr, array.shape)).encode())
    digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def refuse_masked(values: object, what: str) -> None:
    """Refuse an array with masked values, which would count as if they were not masked."""
    if np.ma.is_masked(values):
        raise TypeError(f"{what} has masked values: take them out, or fill them, before")


class Grid:
    """Axes with their names, and the points that they span."""

    def __init__(self, axes: Mapping[str, npt.ArrayLike]) -> None:
        if not isinstance(axes, Mapping):
            raise TypeError(f"grid must be a mapping of names to 1-d arrays, not {type(axes).__name__}")
        if not axes:
            raise InvalidError("a grid needs one axis at least", "no-axis", {})
        self.axes: dict[str, Array] = {name: _axis(name, values) for name, values in axes.items()}
        self.shape = tuple(len(axis) for axis in self.axes.values())
        self.points = math.prod(self.shape)
        if self.points > _MOST_POINTS:
            message = f"the grid has {self.points} points; the most is {_MOST_POINTS}"
            raise TooLargeError(message, "points", self.points, _MOST_POINTS)

    def index(self, point: int) -> tuple[int, ...]:
        """Where a point stands, one number for each axis."""
        return tuple(int(place) for place in np.unravel_index(point, self.shape))

    def values(self, point: int) -> dict[str, Any]:
        """The values of the axes at a point, as plain Python numbers."""
        places = zip(self.axes.items(), self.index(point), strict=True)
        return {name: axis[place].item() for (name, axis), place in places}

    def columns(self, points: npt.NDArray[np.int64]) -> dict[str, Array]:
        """The values of each axis at these points, in fresh arrays."""
        places = np.unravel_index(points, self.shape)
        return {name: axis[place] for (name, axis), place in zip(self.axes.items(), places, strict=True)}

    def described(self) -> dict[str, dict[str, Any]]:
        """Each axis in a few words and by its digest."""
        return {name: _described(axis) for name, axis in self.axes.items()}


def _axis(name: object, values: npt.ArrayLike) -> Array:
    """A checked axis, which nobody else can change."""
    if not isinstance(name, str) or not name.isidentifier():
        raise InvalidError(
            f"the name of an axis is handed on as a keyword, which {name!r} cannot be", "axis-name", {}
        )
    refuse_masked(values, f"axis {name!r}")
    axis = np.array(values)
    if axis.ndim != 1:
        message = f"axis {name!r} must be a 1-d array, not one of {axis.ndim} dimensions"
        raise InvalidError(message, "axis-shape", {"axis": name, "dimensions": axis.ndim})
    if axis.dtype.kind not in _KINDS:
        message = f"axis {name!r} must hold numbers or text, not {axis.dtype}"
        raise InvalidError(message, "axis-type", {"axis": name, "dtype": str(axis.dtype)})
    axis = axis.astype(axis.dtype.newbyteorder("="))
    axis.setflags(write=False)
    return axis


def _described(axis: Array) -> dict[str, Any]:
    ends = {"first": str(axis[0]), "last": str(axis[-1])} if len(axis) else {}
    return {"count": len(axis), "dtype": axis.dtype.str, **ends, "sha256": array_digest(axis)}
