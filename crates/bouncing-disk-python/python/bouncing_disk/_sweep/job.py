"""The job of a worker: the function at the points of one chunk.

Nothing here knows of folders, clusters or progress, so that a chunk has the same bits wherever it is
computed.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from bouncing_disk._sweep.errors import FailedPoint, SweepFunctionError
from bouncing_disk._sweep.folder import VERSIONS, function_name
from bouncing_disk._sweep.grid import Array, Grid, Lossy, converted, filled, joined

Points = npt.NDArray[np.int64]
#: Results, and their places among the points of a chunk.
Piece = tuple["slice | Points", Array]


class Failure(NamedTuple):
    """A point at which the function raised an exception."""

    point: int
    error: str
    message: str
    traceback: str

    def at(self, grid: Grid) -> FailedPoint:
        """The same with the point's place and values."""
        return FailedPoint(
            grid.index(self.point), grid.values(self.point), self.error, self.message, self.traceback
        )


class Outcome(NamedTuple):
    """The results at some points, in their order."""

    #: The results of the function, filled up where it failed; None if it failed everywhere.
    values: Array | None
    #: Points where it failed.
    failures: tuple[Failure, ...]
    #: Whether more points failed than are allowed, so that the others were not computed.
    given_up: bool
    #: The versions of this package and of NumPy where it was computed; older ones of this package tell none.
    versions: Mapping[str, str] = {}


class _GivenUp(Exception):
    """More points failed than are allowed."""


@dataclass(frozen=True)
class Job:
    """A function with all its arguments."""

    function: Callable[..., Any]
    grid: Grid
    arguments: Mapping[str, Any]
    pointwise: bool
    max_failures: int

    def compute(self, chosen: Points | range) -> Outcome:
        """The function at these points."""
        if isinstance(chosen, range):
            points: Points = np.arange(chosen.start, chosen.stop, dtype=np.int64)
        else:
            points = chosen
        pieces: list[Piece] = []
        failures: list[Failure] = []
        try:
            if self.pointwise:
                self._one_by_one(points, pieces, failures)
            else:
                self._together(points, pieces, failures)
        except _GivenUp:
            return Outcome(None, tuple(failures), True, VERSIONS)
        return Outcome(self.put_together(len(points), pieces), tuple(failures), False, VERSIONS)

    def _one_by_one(self, points: Points, pieces: list[Piece], failures: list[Failure]) -> None:
        for place, point in enumerate(points.tolist()):
            try:
                returned = self.function(**self.grid.values(point), **self.arguments)
            except (Exception, SystemExit) as error:
                self._failed(point, error, failures)
            else:
                pieces.append((slice(place, place + 1), self._array(returned, None)))

    def _together(self, points: Points, pieces: list[Piece], failures: list[Failure]) -> None:
        """All points in one call; where this raises an exception, halves, down to the points that do so."""
        # The last one is the next to be computed, so that points come in their order.
        waiting = [(0, len(points))]
        first_error: BaseException | None = None
        while waiting:
            start, stop = waiting.pop()
            chosen = points[start:stop]
            try:
                returned = self.function(**self.grid.columns(chosen), **self.arguments)
            except (Exception, SystemExit) as error:
                first_error = first_error or error
                if stop - start == 1:
                    self._failed(int(chosen[0]), error, failures)
                else:
                    middle = (start + stop) // 2
                    waiting += [(middle, stop), (start, middle)]
            else:
                pieces.append((slice(start, stop), self._array(returned, stop - start)))
        if first_error is not None and not failures:
            name = function_name(self.function)
            raise SweepFunctionError(
                f"{name} fails for {len(points)} points ({type(first_error).__name__}: {first_error}) but for none of "
                "them alone: it must take arrays, or be called with `pointwise=True`",
                name,
            ) from first_error

    def _failed(self, point: int, error: BaseException, failures: list[Failure]) -> None:
        lines = "".join(traceback.format_exception(error))
        failures.append(Failure(point, type(error).__name__, str(error), lines))
        if len(failures) > self.max_failures:
            raise _GivenUp

    def _array(self, returned: Any, count: int | None) -> Array:
        """The function's result for a number of points (None: for one, without an axis for it)."""
        if isinstance(returned, Mapping):
            return self._structured(
                {str(name): self._plain(value, count) for name, value in returned.items()}
            )
        return self._plain(returned, count)

    def _plain(self, returned: Any, count: int | None) -> Array:
        if np.ma.is_masked(returned):
            raise self._refused("returned masked values: fill them, with NaN for example")
        try:
            array = np.asarray(returned)
        except ValueError as error:
            raise self._refused(f"returned what is no array ({error})") from error
        if array.dtype.names is not None:
            array = _packed(array)
        if array.dtype.hasobject:
            raise self._refused(f"returned {type(returned).__name__}, which is no array of numbers")
        if count is None:
            return array[np.newaxis]
        if array.ndim == 0 or len(array) != count:
            raise self._refused(
                f"returned an array of shape {array.shape} for {count} points: the first axis must be that of the "
                "points, unless it is called with `pointwise=True`"
            )
        return array

    def _structured(self, parts: Mapping[str, Array]) -> Array:
        if not parts:
            raise self._refused("returned an empty mapping")
        fields = [(name, part.dtype, part.shape[1:]) for name, part in parts.items()]
        array = np.empty(len(next(iter(parts.values()))), dtype=fields)
        for name, part in parts.items():
            array[name] = part
        return array

    def put_together(self, count: int, pieces: Sequence[Piece]) -> Array | None:
        """Pieces of results put together; missing ones are filled."""
        if not pieces:
            return None
        first = pieces[0][1]
        if len(first) == count:
            return np.ascontiguousarray(first)
        kind = first.dtype
        for _, piece in pieces:
            held = joined(kind, piece.dtype)
            if held is None or piece.shape[1:] != first.shape[1:]:
                raise self._refused(
                    f"returned {kind} of shape {first.shape[1:]} for one point and {piece.dtype} of shape "
                    f"{piece.shape[1:]} for another"
                )
            kind = held
        whole = filled((count, *first.shape[1:]), kind)
        for places, piece in pieces:
            try:
                whole[places] = converted(piece, kind)
            except Lossy as loss:
                raise self._refused(f"returned integers and floats: {loss}") from loss
        return whole

    def _refused(self, what: str) -> SweepFunctionError:
        name = function_name(self.function)
        return SweepFunctionError(f"{name} {what}", name)


def _packed(array: Array) -> Array:
    """A structured array without padding and titles, so that its type is the same after it was stored."""
    plain: list[Any] = [(name, array.dtype[name]) for name in array.dtype.names or ()]
    packed = np.empty(array.shape, np.dtype(plain))
    for name, _ in plain:
        packed[name] = array[name]
    return packed
