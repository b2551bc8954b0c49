"""The grid of a sweep, its chunks, and the one type that holds all results."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from bouncing_disk._errors import InvalidError, OutOfRangeError, TooLargeError
from bouncing_disk._sweep.errors import SweepFunctionError

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
        """The place of a point, one number for each axis."""
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


#: The largest integers that doubles hold, all of them.
_EXACT = 2**53

#: Integers, signed and unsigned, floats and complex numbers.
_NUMBERS = "iufc"


class Lossy(ValueError):
    """A number would not be the same in the type that holds all."""


def joined(one: np.dtype[Any], other: np.dtype[Any]) -> np.dtype[Any] | None:
    """The type that holds the values of both; None if none is safe."""
    if one == other:
        return one
    if one.names is not None or other.names is not None:
        return _joined_fields(one, other)
    kinds = one.kind + other.kind
    if one.kind == other.kind and one.kind in "US":
        return max(one, other, key=lambda text: text.itemsize)
    if not all(kind in _NUMBERS for kind in kinds):
        return None
    if one.kind == other.kind:
        return _native(max(one, other, key=lambda number: number.itemsize))
    if set(kinds) == {"i", "u"}:
        # No integer holds the largest unsigned and negative ones; those that a float holds are many enough.
        unsigned = one if one.kind == "u" else other
        return np.dtype(np.int64 if unsigned.itemsize < 8 else np.float64)
    bits = max(_precision(one), _precision(other))
    return np.dtype(f"c{2 * bits}") if "c" in kinds else np.dtype(f"f{bits}")


def _native(dtype: np.dtype[Any]) -> np.dtype[Any]:
    return dtype.newbyteorder("=")


def _precision(dtype: np.dtype[Any]) -> int:
    """Bytes of the float that holds a number, or each part of it."""
    if dtype.kind in "iu":
        return 8
    return dtype.itemsize // 2 if dtype.kind == "c" else dtype.itemsize


def _joined_fields(one: np.dtype[Any], other: np.dtype[Any]) -> np.dtype[Any] | None:
    """Of structured types: field by field, if they have the same ones."""
    if one.names is None or one.names != other.names:
        return None
    fields: list[Any] = []
    for name in one.names:
        ours, theirs = one[name], other[name]
        inner = joined(ours.base, theirs.base)
        if inner is None or ours.shape != theirs.shape:
            return None
        fields.append((name, inner, ours.shape))
    return np.dtype(fields)


def converted(values: Array, dtype: np.dtype[Any]) -> Array:
    """The values in the type that holds all; :class:`Lossy` where an integer has too many digits for it."""
    if values.dtype == dtype:
        return values
    if dtype.names is not None:
        whole = np.empty(values.shape, dtype)
        for name in dtype.names:
            whole[name] = converted(values[name], dtype[name].base)
        return whole
    if values.dtype.kind in "iu" and dtype.kind in "fc":
        beyond = (values > _EXACT) | (values < -_EXACT)
        if beyond.any():
            number = values[beyond].ravel()[0]
            raise Lossy(f"the integer {number} has more digits than {dtype}, in which it would stand")
    return values.astype(dtype)


#: Chunks of a grid whose points are many, unless another size is given: enough to keep a cluster busy.
_CHUNKS = 256
#: The most points of a chunk by default: half a megabyte of numbers for each axis.
_LARGEST = 65_536
#: The most points of a chunk: the numbers of its points, and each axis, take 128 MB.
_MOST_IN_CHUNK = 2**24
#: The most chunks, and so files in a folder.
_MOST_CHUNKS = 1_000_000


class Chunks:
    """Runs of consecutive points of a grid. They do not depend on who computes them."""

    def __init__(self, grid: Grid, size: int | None) -> None:
        if size is None:
            size = min(max(1, -(-grid.points // _CHUNKS)), _LARGEST)
            size = max(size, -(-grid.points // _MOST_CHUNKS))
        elif isinstance(size, bool) or not isinstance(size, (int, np.integer)):
            raise TypeError(f"chunk_size must be an integer, not {type(size).__name__}")
        elif size < 1:
            message = f"chunk_size is {size}, outside [1, infinity)"
            raise OutOfRangeError(message, "chunk_size", float(size), "[1, infinity)")
        if min(size, grid.points) > _MOST_IN_CHUNK:
            message = f"chunks of {size} points are too large; the most is {_MOST_IN_CHUNK}"
            raise TooLargeError(message, "points of a chunk", int(size), _MOST_IN_CHUNK)
        self.size = int(size)
        self.count = -(-grid.points // self.size)
        self._points = grid.points
        if self.count > _MOST_CHUNKS:
            message = f"{grid.points} points are {self.count} chunks of {size}; the most is {_MOST_CHUNKS}"
            raise TooLargeError(message, "chunks", self.count, _MOST_CHUNKS)

    def span(self, chunk: int) -> tuple[int, int]:
        """The first point of a chunk, and the first one after it."""
        return chunk * self.size, min((chunk + 1) * self.size, self._points)


class Assembly:
    """The results of all points, as their chunks come in."""

    def __init__(self, grid: Grid, function: str) -> None:
        self._grid = grid
        self._function = function
        self._values: Array | None = None
        self._first_chunk = 0

    def put(self, chunk: int, start: int, values: Array) -> None:
        """The results of a chunk, whose first point is `start`."""
        if self._values is None:
            self._values = self._room(values.shape[1:], values.dtype)
            self._first_chunk = chunk
        whole = self._values
        kind = joined(whole.dtype, values.dtype)
        if kind is None or values.shape[1:] != whole.shape[1:]:
            raise SweepFunctionError(
                f"{self._function} returned {values.dtype} of shape {values.shape[1:]} in chunk {chunk} and "
                f"{whole.dtype} of shape {whole.shape[1:]} in chunk {self._first_chunk}",
                self._function,
            )
        try:
            if kind != whole.dtype:
                self._values = self._wider(whole, kind)
            self._values[start : start + len(values)] = converted(values, kind)
        except Lossy as loss:
            message = f"{self._function} returned integers and floats: {loss}"
            raise SweepFunctionError(message, self._function) from loss

    def _room(self, shape: tuple[int, ...], dtype: np.dtype[Any]) -> Array:
        """Zeros for the results of all points; the system assigns their memory only on writing."""
        try:
            return np.zeros((self._grid.points, *shape), dtype)
        except (MemoryError, ValueError) as error:
            wanted = self._grid.points * np.zeros((1, *shape), dtype).nbytes
            message = f"the results need {wanted} bytes, more memory than is available"
            raise TooLargeError(message, "bytes", wanted, 0) from error

    def _wider(self, whole: Array, kind: np.dtype[Any]) -> Array:
        """The results so far, converted to a type that also holds those of the new chunk."""
        wider = self._room(whole.shape[1:], kind)
        for start in range(0, len(whole), _LARGEST):
            some = slice(start, start + _LARGEST)
            wider[some] = converted(whole[some], kind)
        return wider

    def whole(self, failed: npt.NDArray[np.bool_]) -> Array:
        """All results, in the shape of the grid; points at which the function failed hold NaN or zero."""
        values: Array = np.zeros(self._grid.points) if self._values is None else self._values
        values[failed.ravel()] = filled((1, *values.shape[1:]), values.dtype)
        return values.reshape(*self._grid.shape, *values.shape[1:])


def filled(shape: tuple[int, ...], dtype: np.dtype[Any]) -> Array:
    """An array without results: NaN wherever the type has it, else zeros."""
    array: Array = np.zeros(shape, dtype)
    if dtype.names is not None:
        for name in dtype.names:
            inner = dtype[name]
            if inner.base.kind in "fc":
                array[name] = np.nan
    elif dtype.kind in "fc":
        array[...] = np.nan
    return array
