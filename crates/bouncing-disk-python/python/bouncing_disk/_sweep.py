"""A function at every point of a grid, in this process or on a Dask cluster, with a journal to resume from:
`bouncing_disk.sweep`."""

from __future__ import annotations

import inspect
import io
import json
import os
import reprlib
import sys
import traceback
import zlib
from collections.abc import Callable, Generator, Mapping
from contextlib import closing, nullcontext
from dataclasses import dataclass, fields, is_dataclass
from importlib import import_module
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from bouncing_disk import _native as native
from bouncing_disk._base import Progress
from bouncing_disk._errors import BouncingDiskError, InvalidError, MissingDependencyError, OutOfRangeError

if TYPE_CHECKING:
    import xarray

__all__ = ["FailedPoint", "SweepFailedError", "SweepJournalError", "sweep"]

Array = npt.NDArray[Any]
#: The results of a call by name; the first axis runs over its points.
Results = dict[str, Array]

#: Types that JSON stores without loss: for axes, and for results.
_AXIS_TYPES = "?U" + np.typecodes["AllInteger"] + "efd"
_RESULT_TYPES = _AXIS_TYPES + "FD"
#: A sweep is given up when this many calls have failed.
_MOST_FAILURES = 100


class FailedPoint(NamedTuple):
    """A point of the grid at which the function failed."""

    #: The values of the axes there.
    values: dict[str, bool | int | float | str]
    #: The exception, with its class.
    error: str
    #: The traceback, as Python prints it.
    traceback: str

    def __str__(self) -> str:
        """The point and the exception in one line."""
        return f"{', '.join(f'{name} = {value!r}' for name, value in self.values.items())}: {self.error}"


class SweepFailedError(BouncingDiskError, RuntimeError):
    """The function failed at points of the grid. The finished points are in the journal, if there is one.

    Attributes:
        failures: the points in the order of the grid, one for each failed call; empty if no call can succeed
            because a worker has another version of this package.
    """

    failures: tuple[FailedPoint, ...]


class SweepJournalError(BouncingDiskError, RuntimeError):
    """A file cannot be the journal of this sweep.

    Attributes:
        journal: the file.
        kind: the reason: ``"another-sweep"``, ``"not-a-journal"``, ``"damaged"``, ``"in-use"`` or
            ``"cannot-write"``.
    """

    journal: str
    kind: str


def sweep(
    function: Callable[..., Any],
    axes: Mapping[str, npt.ArrayLike],
    client: Any = None,
    *,
    arguments: Mapping[str, Any] | None = None,
    chunk: int | None = None,
    journal: str | os.PathLike[str] | None = None,
    progress: Progress = None,
) -> xarray.Dataset:
    """Compute a function at every point of a grid, in this process or on a Dask cluster.

    Args:
        function: called with keywords: one value for each axis, and the `arguments`. It returns a number, a
            text or an array, or several named ones: a mapping, a named tuple or a dataclass, such as the
            results of this package (fields with the name of an axis are omitted).
        axes: the values of each axis, numbers or texts. The grid is their Cartesian product.
        client: a ``distributed.Client``. Its workers need this package in the same version. Without one this process
            computes; functions of this package use all its processors.
        arguments: further arguments of the function, the same at every point.
        chunk: call the function with arrays of at most this many points instead of the numbers of one point.
            The first axis of its results runs over the points. This is much faster for functions of many
            orbits.
        journal: a file to which this process appends the results of each call at once. The same sweep, called
            again, computes only the missing points. It compares the text of the function, not of the
            functions that it calls. Do not use one file in two processes if files cannot be locked (Windows,
            some network file systems).
        progress: called with the number of finished points and of all points.

    Returns:
        A Dataset of xarray: a variable for each name, or ``result``, whose first dimensions are the axes.

    Raises:
        SweepFailedError: The function failed. The error names the points. All others are computed, unless 100
            calls failed.
        SweepJournalError: The file is the journal of another sweep (the message says what differs), is in use, was
            changed, or cannot be written.

    Notes
    An interrupt (Ctrl-C) ends the sweep and leaves the journal usable, and so does a kill: a half-written record is
    dropped by the next call.

    >>> import bouncing_disk as bd
    >>> def speed(friction, lag):
    ...     return bd.single_toss(bd.System.pizza_toss().replace(friction=friction, phase_lag=lag)).airborne_speed
    >>> bd.sweep(speed, {"friction": [0.05, 0.6], "lag": [0.0, 0.2, 0.4]}).result.values.round(1)
    array([[ 2.4,  2.4,  2.4],
           [14.3, 13.8, 12.9]])
    """
    MissingDependencyError.checked("xarray", "a sweep", "sweep")
    if client is not None:
        distributed = MissingDependencyError.checked("distributed", "a sweep on a cluster", "sweep")
        if not isinstance(client, distributed.Client):
            raise TypeError(f"client must be a distributed.Client or None, not {type(client).__name__}")
    if chunk is not None and chunk < 1:
        raise OutOfRangeError(f"chunk is {chunk}, outside [1, infinity)", "chunk", float(chunk), "[1, infinity)")
    if not axes:
        raise InvalidError("a grid needs at least one axis", "no-axis", {})
    grid = {name: _axis(name, values) for name, values in axes.items()}
    job = _Job(function, grid, dict(arguments or {}), chunk, native.VERSION)
    with nullcontext() if journal is None else closing(_Journal(journal, job.header())) as kept:
        dataset: xarray.Dataset = _dataset(job, _finished(job, client, kept, progress))
    return dataset


def _axis(name: str, values: npt.ArrayLike) -> Array:
    axis = np.array(values)
    if axis.ndim != 1 or not len(axis):
        message = f"axis {name!r} must be a 1-d array with values, but has the shape {axis.shape}"
        raise InvalidError(message, "axis-shape", {"axis": name})
    if axis.dtype.char not in _AXIS_TYPES or np.ma.is_masked(values):
        message = f"axis {name!r} must hold numbers or texts, not {axis.dtype} or masked values"
        raise InvalidError(message, "axis-type", {"axis": name})
    return axis


@dataclass(frozen=True)
class _Job:
    """A sweep as sent to workers. A call is identified by the index of its first point; the last axis is the
    fastest."""

    function: Callable[..., Any]
    axes: dict[str, Array]
    arguments: dict[str, Any]
    chunk: int | None
    version: str

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each axis."""
        return tuple(map(len, self.axes.values()))

    def calls(self) -> range:
        """The first point of each call."""
        return range(0, prod(self.shape), self.chunk or 1)

    def span(self, first: int) -> range:
        """The points of a call."""
        return range(first, min(first + (self.chunk or 1), prod(self.shape)))

    def values(self, points: range) -> dict[str, Array]:
        """The values of the axes at these points."""
        places = np.unravel_index(np.array(points), self.shape)
        return {name: axis[place] for (name, axis), place in zip(self.axes.items(), places, strict=True)}

    def point(self, number: int) -> dict[str, Any]:
        """The values of the axes at one point, as plain numbers and texts."""
        return {name: value[0].item() for name, value in self.values(range(number, number + 1)).items()}

    def results(self, points: range) -> Results:
        """The results of the function for these points."""
        values: Mapping[str, Any] = self.values(points) if self.chunk else self.point(points.start)
        arrays = {}
        for name, result in self._named(self.function(**values, **self.arguments)).items():
            array = arrays[name] = np.asarray(result if self.chunk else [result])
            if array.dtype.char not in _RESULT_TYPES or np.ma.is_masked(result):
                raise TypeError(f"{name} is of type {array.dtype} or masked: return numbers, texts or arrays of them")
            if array.shape[:1] != (len(points),):
                raise TypeError(f"{name} has the shape {array.shape}: its first axis must have {len(points)} points")
            if name in self.axes:
                raise TypeError(f"{name} is the name of an axis and of a result")
        return arrays

    def _named(self, returned: Any) -> Mapping[str, Any]:
        if is_dataclass(returned):
            names = (field.name for field in fields(returned))
            return {name: getattr(returned, name) for name in names if name not in self.axes}
        returned = returned._asdict() if hasattr(returned, "_asdict") else returned
        return returned if isinstance(returned, Mapping) else {"result": returned}

    def failed(self, first: int, error: BaseException, what: str = "") -> FailedPoint:
        """The point at which a call failed."""
        lines = "".join(traceback.format_exception(error))
        return FailedPoint(self.point(first), f"{what}{type(error).__name__}: {error}", lines)

    def header(self) -> dict[str, Any]:
        """The first line of a journal: everything that the results depend on."""
        function = self.function
        name = f"{getattr(function, '__module__', None)}.{getattr(function, '__qualname__', None)}"
        if not inspect.isroutine(function) or inspect.ismethod(function) or "<" in name:
            message = f"a journal recognises a function by its name and text, but cannot recognise {function!r}: define a "
            message += "function at the top of a module or notebook, and pass constants as `arguments`"
            raise InvalidError(message, "function", {"function": name})
        try:
            source = inspect.getsource(function)
        except (OSError, TypeError):
            source = None
        what = {"format": "bouncing-disk sweep 1", "version": self.version, "function": name, "source": source}
        types = {name: axis.dtype.str for name, axis in self.axes.items()}
        where = {"axes": self.axes, "types": types, "chunk": self.chunk, "arguments": dict(sorted(self.arguments.items()))}
        plain: dict[str, Any] = json.loads(json.dumps({**what, **where}, default=_plain))
        return plain


def _plain(value: Any) -> Any:
    """An argument as JSON, by which it is compared."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "to_dict"):
        return {type(value).__qualname__: value.to_dict()}
    kind = type(value).__name__
    raise TypeError(f"a journal cannot recognise a {kind}: give numbers, texts, arrays, lists, mappings or bd's objects")


class _OtherVersion(RuntimeError):
    """A worker has another version of this package: no call can succeed there."""


def _call(job: _Job, first: int) -> Results | FailedPoint:
    """One call, in any process. If it fails, halves of its points are tried to find the failing one."""
    if job.version != native.VERSION:
        raise _OtherVersion(f"the worker has bouncing-disk {native.VERSION}, and the caller {job.version}")
    points = job.span(first)
    try:
        return job.results(points)
    except Exception as error:
        if len(points) == 1:
            return job.failed(first, error)
        together = job.failed(first, error, f"for {len(points)} points starting here together, but for none of them alone: ")
    while len(points) > 1:
        half = points[: len(points) // 2]
        points = half if _failure(job, half) else points[len(half) :]
    return _failure(job, points) or together


def _failure(job: _Job, points: range) -> FailedPoint | None:
    try:
        job.results(points)
    except Exception as error:
        return job.failed(points.start, error)
    return None


def _itself(job: _Job) -> _Job:
    return job


def _distributed(job: _Job, calls: list[int], client: Any) -> Generator[tuple[int, Results | FailedPoint]]:
    """The calls in the order in which a cluster finishes them. Dask repeats the calls of a worker that died."""
    # An ordinary task, so that it is repeated if all workers that hold it are lost.
    shared = client.submit(_itself, job, pure=False)
    pending = dict(zip(client.map(_call, [shared] * len(calls), calls, pure=False), calls, strict=True))
    try:
        for future in import_module("distributed").as_completed(list(pending)):
            # Workers forget results that the client has taken.
            first = pending.pop(future)
            try:
                yield first, future.result()
            except _OtherVersion as error:
                raise SweepFailedError(str(error), ()) from error
            except Exception as error:
                yield first, job.failed(first, error)
    finally:
        client.cancel(list(pending))


def _finished(job: _Job, client: Any, journal: _Journal | None, progress: Progress) -> dict[int, Results]:
    """The results of all calls by their first points: first from the journal, then as they arrive."""
    finished = journal.finished if journal is not None else {}
    missing = [first for first in job.calls() if first not in finished]
    failures: dict[int, FailedPoint] = {}
    form = next(map(_form, finished.values()), None)
    tell = progress or (lambda done, total: None)
    here = ((first, _call(job, first)) for first in missing)
    with closing(_distributed(job, missing, client) if client is not None and missing else here) as outcomes:
        done = sum(len(job.span(first)) for first in finished)
        tell(done, prod(job.shape))
        for first, outcome in outcomes:
            if not isinstance(outcome, FailedPoint) and (form := form or _form(outcome)) != _form(outcome):
                outcome = job.failed(first, TypeError(f"returned {_form(outcome)} here, and {form} elsewhere"))
            if isinstance(outcome, FailedPoint):
                failures[first] = outcome
                if len(failures) == _MOST_FAILURES:
                    break
            else:
                if journal is not None:
                    journal.append(first, outcome)
                finished[first] = outcome
                done += len(job.span(first))
                tell(done, prod(job.shape))
    if failures:
        points = tuple(failures[first] for first in sorted(failures))
        more = f"; and {len(points) - 3} more" if len(points) > 3 else ""
        raise SweepFailedError(f"the function failed: {'; '.join(map(str, points[:3]))}{more}", points)
    return finished


def _form(results: Results) -> dict[str, str]:
    """The common properties of all calls. Numbers may be integers at one point and floats at another."""
    words = {"U": "texts", "b": "truths"}
    return {name: f"{words.get(array.dtype.kind, 'numbers')} {array.shape[1:]}" for name, array in results.items()}


def _dataset(job: _Job, finished: dict[int, Results]) -> Any:
    variables = {}
    for name in finished[0]:
        values = np.concatenate([finished[first][name] for first in job.calls()])
        inner = [f"{name}_{number}" for number in range(values.ndim - 1)]
        variables[name] = ([*job.axes, *inner], values.reshape(*job.shape, *values.shape[1:]))
    return import_module("xarray").Dataset(variables, job.axes, {"program": f"bouncing-disk {job.version}"})


class _Journal:
    """The file of a sweep: lines of JSON, each after its checksum: a header, then one line per call."""

    def __init__(self, path: str | os.PathLike[str], header: dict[str, Any]) -> None:
        self._path = os.path.abspath(path)
        self.finished: dict[int, Results] = {}
        try:
            # Unbuffered, so that an interrupt comes before or after a line.
            self._file = io.FileIO(self._path, "a+")
        except OSError as error:
            raise self._refused(f"cannot be opened: {error.strerror}", "cannot-write") from error
        try:
            self._read(header)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Unlocks the file."""
        self._file.close()

    def append(self, first: int, results: Results) -> None:
        """The record of a call."""
        self._write(_line([first, {name: _encoded(array) for name, array in results.items()}]))

    def _read(self, header: dict[str, Any]) -> None:
        try:
            _lock(self._file)
            self._file.seek(0)
            content = self._file.readall()
        except BlockingIOError as error:
            raise self._refused("is in use by another sweep", "in-use") from error
        except OSError as error:
            raise self._refused(f"cannot be read: {error.strerror}", "cannot-write") from error
        *lines, half = content.split(b"\n")
        known = _record(lines[0]) if lines else None
        if known is None and not _line(header).startswith(content):
            raise self._refused("is not the journal of a sweep", "not-a-journal")
        if known is not None and (found := _difference(header, known)):
            raise self._refused(f"is the journal of another sweep: {found}", "another-sweep")
        for number, record in enumerate(map(_record, lines[1:]), 2):
            if record is None:
                message = f"has a damaged line {number}; delete it, and its points are computed again"
                raise self._refused(message, "damaged")
            self.finished[record[0]] = {name: _decoded(*array) for name, array in record[1].items()}
        self._file.truncate(len(content) - len(half))
        if known is None:
            self._write(_line(header))

    def _write(self, line: bytes) -> None:
        try:
            while line:
                line = line[self._file.write(line) :]
        except OSError as error:
            raise self._refused(f"cannot be written: {error.strerror}", "cannot-write") from error

    def _refused(self, why: str, kind: str) -> SweepJournalError:
        return SweepJournalError(f"{self._path} {why}", self._path, kind)


if sys.platform == "win32":

    def _lock(file: io.FileIO) -> None:
        pass

else:
    import fcntl

    def _lock(file: io.FileIO) -> None:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise
        except OSError:
            # A file system without locks.
            pass


def _line(record: Any) -> bytes:
    text = json.dumps(record).encode()
    return b"%08x %b\n" % (zlib.crc32(text), text)


def _record(line: bytes) -> Any:
    """The record of a line; None if the line was changed."""
    checksum, _, text = line.partition(b" ")
    return json.loads(text) if checksum == b"%08x" % zlib.crc32(text) else None


def _encoded(array: Array) -> list[Any]:
    """An array as JSON; a complex number is a pair."""
    flat = np.ascontiguousarray(array).ravel()
    return [array.dtype.str, array.shape, flat.view(flat.real.dtype).tolist()]


def _decoded(dtype: str, shape: list[int], values: list[Any]) -> Array:
    return np.array(values, np.zeros(0, dtype).real.dtype).view(dtype).reshape(shape)


def _difference(ours: Any, theirs: Any, path: str = "") -> str | None:
    """The first item in which two headers differ."""
    if isinstance(ours, list) and isinstance(theirs, list) and len(ours) == len(theirs):
        ours, theirs = dict(enumerate(ours)), dict(enumerate(theirs))
    if isinstance(ours, dict) and isinstance(theirs, dict) and list(ours) == list(theirs):
        found = (_difference(ours[key], theirs[key], f"{path}.{key}" if path else str(key)) for key in ours)
        return next(filter(None, found), None)
    same = json.dumps(ours) == json.dumps(theirs)
    return None if same else f"{path} is {reprlib.repr(theirs)} there, {reprlib.repr(ours)} here"
