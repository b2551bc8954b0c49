"""Who computes the chunks: this process, or the workers of a Dask cluster, which must have the same versions."""

from __future__ import annotations

import multiprocessing
import os
import uuid
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib import import_module
from typing import Any

import numpy as np

from bouncing_disk._sweep.errors import SweepClusterError, SweepFunctionError
from bouncing_disk._sweep.folder import PACKAGES, function_name, versions
from bouncing_disk._sweep.job import Job, Outcome


def check_client(client: Any) -> None:
    """Refuse anything but a client of a cluster, before all else."""
    if client is None or (isinstance(client, str) and client == "serial"):
        return
    wanted = 'client must be a distributed.Client, "serial" or None'
    try:
        distributed = import_module("distributed")
    except ImportError:
        raise TypeError(f"{wanted}, not {type(client).__name__}; distributed is not installed") from None
    if not isinstance(client, distributed.Client):
        advice = ": give Client(cluster)" if hasattr(client, "scheduler_address") else ""
        raise TypeError(f"{wanted}, not {type(client).__name__}{advice}")
    if client.asynchronous:
        raise TypeError(f"{wanted}, and not an asynchronous one, whose results nobody waits for here")
    if client.status in ("closed", "closing"):
        raise SweepClusterError(f"the client is {client.status}: make another one", "closed", {})


def _asked() -> Callable[[tuple[str, ...]], dict[str, str]]:
    """The question, as a function that is sent with its text: workers may have no module of ours."""

    def found(packages: tuple[str, ...]) -> dict[str, str]:
        from importlib.metadata import PackageNotFoundError, version

        here = {}
        for package in packages:
            try:
                here[package] = version(package)
            except PackageNotFoundError:
                here[package] = "unknown"
        return here

    return found


def check_versions(client: Any) -> None:
    """Refuse workers with versions other than this process has. Later ones are checked with each chunk."""
    told: Mapping[str, Any] = client.run(_asked(), PACKAGES, on_error="return")
    # A worker that died before it answered no longer counts.
    answers = {worker: found for worker, found in told.items() if not isinstance(found, BaseException)}
    other = {worker: dict(found) for worker, found in answers.items() if dict(found) != versions()}
    if other:
        raise unlike(other)


def unlike(workers: Mapping[str, Mapping[str, str]]) -> SweepClusterError:
    """The error that names the first of these workers."""
    worker, found = next(iter(workers.items()))
    differ = (
        f"no {package}" if theirs == "unknown" else f"{package} {theirs} instead of {here}"
        for package, here in versions().items()
        if (theirs := found.get(package, "of an older kind")) != here
    )
    more = f", and {len(workers) - 1} more have others, too" if len(workers) > 1 else ""
    message = f"{worker} has {' and '.join(differ)}{more}: install the same versions on all workers"
    return SweepClusterError(message, "versions", workers)


#: A chunk and its points: all of them, or those that failed before.
Task = tuple[int, "range | np.ndarray[Any, np.dtype[np.int64]]"]

#: How many chunks wait for each thread of the cluster, so that none of them idles.
_AHEAD = 4


def serial_outcomes(job: Job, tasks: Sequence[Task]) -> Iterator[tuple[int, Outcome]]:
    """One chunk after the other, in this process."""
    for chunk, points in tasks:
        yield chunk, job.compute(points)


def has_distributed() -> bool:
    """Whether Dask's cluster is installed."""
    try:
        import_module("distributed")
    except ImportError:
        return False
    return True


@contextmanager
def local_client(most: int) -> Iterator[Any]:
    """A client of local processes, one for each processor, but no more than this; they end with it."""
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise RuntimeError(
            "the script that calls sweep() is being imported by one of its own workers: put the call behind "
            '`if __name__ == "__main__":`'
        )
    distributed = import_module("distributed")
    workers = max(1, min(most, _processors()))
    # The processes share the processors already, so that each of them computes with one thread.
    cluster = distributed.LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=True,
        dashboard_address="127.0.0.1:0",
        env={"RAYON_NUM_THREADS": "1"},
    )
    try:
        with distributed.Client(cluster, set_as_default=False) as client:
            yield client
    finally:
        cluster.close()


def _processors() -> int:
    """Processors that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else os.cpu_count() or 1


def distributed_outcomes(job: Job, tasks: Sequence[Task], client: Any) -> Iterator[tuple[int, Outcome]]:
    """Chunks in the order in which the cluster finishes them.

    Dask recomputes those of a worker that died. Unfinished ones are cancelled when the iterator is
    closed.
    """
    _check_sendable(job)
    check_versions(client)
    distributed = import_module("distributed")
    name = f"{function_name(job.function)}-{uuid.uuid4().hex[:12]}"
    waiting = iter(tasks)
    # A task like the others, so that the scheduler can make it again when all workers that hold it are lost.
    shared = client.submit(_itself, job, key=f"job-{name}", pure=False)
    chunk_of: dict[str, int] = {}

    def submit(task: Task) -> Any:
        chunk, points = task
        future = client.submit(_compute, shared, points, key=f"chunk-{chunk}-{name}", pure=False)
        chunk_of[future.key] = chunk
        return future

    def ahead() -> int:
        threads: int = sum(client.nthreads().values())
        return _AHEAD * max(1, threads)

    pending: dict[str, Any] = {}

    def fill_up(finished: Any) -> None:
        room = ahead() - len(pending)
        for _ in range(room):
            task = next(waiting, None)
            if task is None:
                return
            future = submit(task)
            pending[future.key] = future
            finished.add(future)

    finished = distributed.as_completed(loop=client.loop)
    try:
        fill_up(finished)
        while pending:
            future = next(finished)
            outcome = future.result()
            if outcome.versions != versions():
                raise unlike({"a worker that joined later": outcome.versions})
            del pending[future.key]
            # Released, so that the workers forget what the client has.
            chunk = chunk_of.pop(future.key)
            future.release()
            fill_up(finished)
            yield chunk, outcome
    finally:
        if pending:
            client.cancel(list(pending.values()))
        shared.release()


def _itself(job: Job) -> Job:
    return job


def _compute(job: Job, points: Any) -> Outcome:
    return job.compute(points)


def _check_sendable(job: Job) -> None:
    """Refuse functions that cannot be sent to workers, before trying all of them."""
    try:
        import_module("distributed.protocol.pickle").dumps((job.function, job.arguments))
    except Exception as error:
        name = function_name(job.function)
        raise SweepFunctionError(
            f"{name} and its arguments cannot be sent to workers ({type(error).__name__}: {error}); define it at the "
            'top of a module or notebook, or compute in this process with `client="serial"`',
            name,
        ) from error
