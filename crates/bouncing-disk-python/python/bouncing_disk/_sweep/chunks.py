"""How a grid is cut into chunks, and how their results are put together."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from bouncing_disk._errors import OutOfRangeError, TooLargeError
from bouncing_disk._sweep.dtypes import Lossy, converted, joined
from bouncing_disk._sweep.errors import SweepFunctionError
from bouncing_disk._sweep.grid import Array, Grid
from bouncing_disk._sweep.job import filled

__all__ = ["Assembly", "Chunks"]

#: Chunks of a grid whose points are many, unless another size is given: enough to keep a cluster busy.
_CHUNKS = 256
#: The most points of a chunk by default: half a megabyte of numbers for each axis.
_LARGEST = 65_536
#: The most points of a chunk: the numbers of its points, and each axis, take 128 MB.
_MOST_POINTS = 2**24
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
        if min(size, grid.points) > _MOST_POINTS:
            message = f"chunks of {size} points are too large; the most is {_MOST_POINTS}"
            raise TooLargeError(message, "points of a chunk", int(size), _MOST_POINTS)
        self.size = int(size)
        self.count = -(-grid.points // self.size)
        self._points = grid.points
        if self.count > _MOST_CHUNKS:
            message = f"{grid.points} points are {self.count} chunks of {size}; the most is {_MOST_CHUNKS}"
            raise TooLargeError(message, "chunks", self.count, _MOST_CHUNKS)

    def span(self, chunk: int) -> tuple[int, int]:
        """The first point of a chunk, and the first one behind it."""
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
        """Zeros, for which the system gives no memory before they are written."""
        try:
            return np.zeros((self._grid.points, *shape), dtype)
        except (MemoryError, ValueError) as error:
            wanted = self._grid.points * np.zeros((1, *shape), dtype).nbytes
            message = f"the results need {wanted} bytes, for which there is no memory"
            raise TooLargeError(message, "bytes", wanted, 0) from error

    def _wider(self, whole: Array, kind: np.dtype[Any]) -> Array:
        """The results so far in a type that holds those of another chunk, too."""
        wider = self._room(whole.shape[1:], kind)
        for start in range(0, len(whole), _LARGEST):
            some = slice(start, start + _LARGEST)
            wider[some] = converted(whole[some], kind)
        return wider

    def whole(self, failed: npt.NDArray[np.bool_]) -> Array:
        """All results, in the shape of the grid; where the function failed, what says so in their type."""
        values: Array = np.zeros(self._grid.points) if self._values is None else self._values
        values[failed.ravel()] = filled((1, *values.shape[1:]), values.dtype)
        return values.reshape(*self._grid.shape, *values.shape[1:])
