"""What is asked of a cluster before it computes: that it is one, and that its workers have the same versions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from bouncing_disk._sweep.errors import SweepClusterError
from bouncing_disk._sweep.identity import PACKAGES, versions

__all__ = ["check_client", "check_versions", "unlike"]


def check_client(client: Any) -> None:
    """Refuse what is no client of a cluster, before anything else is done."""
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
    """Refuse workers with other versions than this process has. Who joins later is asked with each chunk."""
    told: Mapping[str, Any] = client.run(_asked(), PACKAGES, on_error="return")
    # One that died before it answered is none any more.
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
