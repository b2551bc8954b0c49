"""The call itself."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from bouncing_disk._base import Progress
from bouncing_disk._errors import OutOfRangeError
from bouncing_disk._sweep.errors import SweepFolderError, is_installed
from bouncing_disk._sweep.folder import (
    VERSIONS,
    Damaged,
    Journal,
    StoredChunk,
    check_foreign,
    chunk_path,
    described,
    digest_of,
    function_name,
    open_description,
    read_axes,
    read_chunk,
    refused,
)
from bouncing_disk._sweep.grid import Assembly, Chunks, Grid
from bouncing_disk._sweep.job import Failure, Job, Outcome
from bouncing_disk._sweep.result import SweepFailedError, SweepResult
from bouncing_disk._sweep.runners import (
    Task,
    check_client,
    distributed_outcomes,
    local_client,
    serial_outcomes,
)

__all__ = ["read_sweep", "sweep"]


def sweep(
    function: Callable[..., Any],
    grid: Mapping[str, npt.ArrayLike],
    client: Any | Literal["serial"] | None = None,
    *,
    arguments: Mapping[str, Any] | None = None,
    folder: str | os.PathLike[str] | None = None,
    chunk_size: int | None = None,
    pointwise: bool = False,
    max_failures: int = 100,
    progress: Progress = None,
) -> SweepResult:
    """Compute a function at every point of a grid: in processes of this machine, or on a Dask cluster.

    The results have the same bits for any cluster, if those of a point do not depend on the other points
    of its chunk. This holds for every function of this package.

    Args:
        function: called with keywords: for each axis an array with its values at the points of a chunk (all
            of one length, at most `chunk_size`), and the `arguments`. It returns one result for each point:
            an array whose first axis is that of the points, or a mapping of names to such arrays. Their types
            may change from point to point: the result has one that holds all, where integers become floats
            and floats complex numbers. Booleans and texts do not mix with other types, nor integers beyond
            2^53 with floats.
        grid: the axes by their names. The points are their Cartesian product, the last axis fastest. An axis
            without values makes a grid without points, for which the function is not called, shape (n,).
        client: the client of a cluster of your own (``dask_jobqueue.SLURMCluster``, ``dask_kubernetes``,
            ``SSHCluster`` ...). By default local processes, one for each processor; without Dask, and with
            ``"serial"``, this process. Its workers must have the versions of this package and of NumPy that
            the caller has.
        arguments: arguments of the function at every point: numbers, text, arrays, objects of this
            package.
        folder: where the calling process stores each finished chunk at once. The same call resumes where an
            earlier one ended, on any cluster. The folder of another sweep is refused; a chunk
            that is damaged is computed again.
        chunk_size: points of a chunk; by default enough for 256 chunks, at most 65,536.
        pointwise: call the function for each point alone: with plain numbers, for a number, an array, or a
            mapping of them.
        max_failures: give up when more points fail than this.
        progress: called with the numbers of points that are done and of all points; an exception of it ends
            the sweep.

    Returns:
        The results as one array, with the axes.

    Raises:
        SweepFailedError: The function raised exceptions. The points are named; all others are computed, kept
            in the folder, and in the error's `result`. The same call tries the failed points again.
        SweepFolderError: The folder is in use, belongs to another sweep, or is not writable.
        SweepFunctionError: The function has no lasting name (with a folder), cannot be sent to workers, or
            returns no array, or values that no type holds.
        SweepClusterError: Workers lack this package, or have other versions of it or of NumPy; nothing has
            been computed by them.

    Notes
    An interrupt (Ctrl-C) leaves the finished chunks in the folder. In a script, call this under
    ``if __name__ == "__main__":``, like everything that starts processes.

    >>> import bouncing_disk as bd
    >>> def area(width, height):
    ...     return width * height
    >>> bd.sweep(area, {"width": [1.0, 2.0], "height": [3.0, 4.0, 5.0]}, client="serial").values
    array([[ 3.,  4.,  5.],
           [ 6.,  8., 10.]])
    """
    check_client(client)
    if not callable(function):
        raise TypeError(f"function must be callable, not {type(function).__name__}")
    if max_failures < 0:
        message = f"max_failures is {max_failures}, outside [0, infinity)"
        raise OutOfRangeError(message, "max_failures", float(max_failures), "[0, infinity)")
    points, constants = Grid(grid), dict(arguments or {})
    if doubled := [name for name in constants if name in points.axes]:
        raise TypeError(f"{doubled[0]!r} is an axis of the grid and one of the arguments")
    chunks = Chunks(points, chunk_size)
    job = Job(function, points, constants, bool(pointwise), max_failures)
    with ExitStack() as stack:
        journal = None
        if folder is not None:
            about = described(function, points, constants, chunks.size, bool(pointwise))
            journal = stack.enter_context(closing(Journal(_lasting_path(folder), about, points)))
        run = _Run(job, chunks, Assembly(points, function_name(function)), journal, progress)
        if tasks := run.tasks():
            run.collect(stack.enter_context(closing(_outcomes(job, tasks, client, stack))))
        return run.result()


def _outcomes(job: Job, tasks: list[Task], client: Any, stack: ExitStack) -> Any:
    """The runner: the caller's choice, or whatever is available."""
    if client is None and is_installed("distributed"):
        client = stack.enter_context(local_client(len(tasks)))
    if client is None or client == "serial":
        return serial_outcomes(job, tasks)
    return distributed_outcomes(job, tasks, client)


@dataclass
class _Run:
    """One sweep: its stored, open and incoming chunks."""

    job: Job
    chunks: Chunks
    assembly: Assembly
    journal: Journal | None
    progress: Progress
    done: int = 0
    failures: dict[int, tuple[Failure, ...]] = field(default_factory=dict)
    #: Stored chunks with points that failed, which are tried again.
    to_mend: dict[int, StoredChunk] = field(default_factory=dict)

    def tasks(self) -> list[Task]:
        """The points of each chunk that must be computed, after reading the stored ones."""
        tasks: list[Task] = []
        for chunk in range(self.chunks.count):
            start, stop = self.chunks.span(chunk)
            stored = self.journal.read(chunk) if self.journal is not None else None
            if stored is None:
                tasks.append((chunk, range(start, stop)))
            elif len(stored.failed):
                self.to_mend[chunk] = stored
                tasks.append((chunk, start + stored.failed.astype(np.int64)))
            else:
                self.assembly.put(chunk, start, stored.values)
                self.done += stop - start
        self._tell()
        return tasks

    def collect(self, outcomes: Iterator[tuple[int, Outcome]]) -> None:
        """Combine and store incoming chunks."""
        failed = 0
        for chunk, outcome in outcomes:
            start, stop = self.chunks.span(chunk)
            if outcome.failures:
                self.failures[chunk] = outcome.failures
                failed += len(outcome.failures)
            if outcome.given_up or failed > self.job.max_failures:
                raise SweepFailedError.of(self._failed_points(), None)
            self._keep(chunk, start, outcome)
            self.done += stop - start
            self._tell()

    def _keep(self, chunk: int, start: int, outcome: Outcome) -> None:
        values = outcome.values
        failed = np.array([failure.point - start for failure in outcome.failures], dtype=np.int64)
        if (mended := self.to_mend.get(chunk)) is not None:
            known = np.delete(np.arange(len(mended.values)), mended.failed)
            pieces = [(known, mended.values[known])]
            if values is not None:
                pieces.append((mended.failed.astype(np.int64), values))
            values = self.job.put_together(len(mended.values), pieces)
        if values is None:
            return
        self.assembly.put(chunk, start, values)
        if self.journal is not None:
            self.journal.write(chunk, start, values, failed)

    def _tell(self) -> None:
        if self.progress is not None:
            self.progress(self.done, self.job.grid.points)

    def _failed_points(self) -> tuple[Any, ...]:
        failures = [failure for chunk in sorted(self.failures) for failure in self.failures[chunk]]
        return tuple(failure.at(self.job.grid) for failure in failures)

    def result(self) -> SweepResult:
        """The whole result, or the error that carries it."""
        failed: npt.NDArray[np.bool_] = np.zeros(self.job.grid.shape, dtype=np.bool_)
        points = self._failed_points()
        for point in points:
            failed[point.place] = True
        values, job = self.assembly.whole(failed), self.job
        name, version = function_name(job.function), VERSIONS["bouncing-disk"]
        result = SweepResult(values, dict(job.grid.axes), failed, name, dict(job.arguments), version)
        if points:
            raise SweepFailedError.of(points, result)
        return result


def _lasting_path(folder: str | os.PathLike[str]) -> Path:
    """The folder, even if the process changes its working directory."""
    if not os.fspath(folder):
        raise SweepFolderError("the name of the folder is empty", "", "cannot-write")
    return Path(os.path.abspath(Path(folder).expanduser()))


def read_sweep(folder: str | os.PathLike[str]) -> SweepResult:
    """The results that a finished sweep has left in a folder; the function is not needed.

    Args:
        folder: the folder of the sweep.

    Returns:
        As :func:`sweep` returned it; `arguments` are as they were stored (arrays by their digest). Points
            that failed are in `failed`.

    Raises:
        SweepFolderError: The folder has no sweep, a chunk is missing or damaged, or a file belongs to another one.
    """
    path = _lasting_path(folder)
    about = open_description(path)
    grid = read_axes(path, about)
    chunks = Chunks(grid, int(about["chunk_size"]))
    assembly = Assembly(grid, str(about["function"]))
    failed: npt.NDArray[np.bool_] = np.zeros(grid.points, dtype=np.bool_)
    files = [chunk_path(path, chunk) for chunk in range(chunks.count)]
    if missing := [file.name for file in files if not file.exists()]:
        lack = f"{len(missing)} of {chunks.count} chunks are missing, the first is {missing[0]}"
        raise refused(path, f"is not finished: {lack}", "incomplete")
    for chunk, file in enumerate(files):
        start, _ = chunks.span(chunk)
        try:
            stored = read_chunk(file)
        except Damaged as damage:
            raise refused(path, f"is damaged: {damage}", "damaged", file) from damage
        check_foreign(path, file, stored, digest_of(about), chunk)
        assembly.put(chunk, start, stored.values)
        failed[start + stored.failed] = True
    values, failed = assembly.whole(failed), failed.reshape(grid.shape)
    name, arguments, version = about["function"], about["arguments"], about["program"]["version"]
    return SweepResult(values, dict(grid.axes), failed, str(name), dict(arguments), str(version))
