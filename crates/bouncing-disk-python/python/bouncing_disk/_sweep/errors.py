"""The exceptions and warnings of sweeps. Each carries the details needed to see why, and can be pickled."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from bouncing_disk._errors import BouncingDiskError

__all__ = [
    "FailedPoint",
    "MissingDependencyError",
    "SweepClusterError",
    "SweepFolderError",
    "SweepFolderWarning",
    "SweepFunctionError",
]

class FailedPoint(NamedTuple):
    """A point of the grid at which the function raised an exception."""

    #: The place in the grid, one number for each axis.
    place: tuple[int, ...]
    #: The values of the axes there.
    values: dict[str, bool | int | float | complex | str]
    #: The name of the exception's class.
    error: str
    #: The text of the exception.
    message: str
    #: The traceback, as Python prints it.
    traceback: str

    def __str__(self) -> str:
        """The point and the exception in one line."""
        point = ", ".join(f"{name} = {value!r}" for name, value in self.values.items())
        return f"{point}: {self.error}: {self.message}"


class SweepFolderError(BouncingDiskError, RuntimeError):
    """A folder cannot be used for this sweep.

    Attributes:
        folder: the folder.
        kind: why: ``"in-use"``, ``"another-sweep"``, ``"other-files"``, ``"foreign-chunk"``, ``"damaged"``,
            ``"newer-format"``, ``"incomplete"``, ``"not-a-sweep"``, ``"cannot-write"`` or ``"cannot-lock"``.
    """

    def __init__(self, message: str, folder: str, kind: str) -> None:
        super().__init__(message, folder, kind)
        self.folder = folder
        self.kind = kind


class SweepClusterError(BouncingDiskError, RuntimeError):
    """A cluster cannot be used: its workers might compute other results than this process.

    Attributes:
        kind: why: ``"versions"`` if this package or NumPy have other versions there or are missing,
            ``"closed"`` if the client is.
        workers: the versions of each differing worker, by its address: of ``"bouncing-disk"`` and
            ``"numpy"``.
    """

    def __init__(self, message: str, kind: str, workers: Mapping[str, Mapping[str, str]]) -> None:
        super().__init__(message, kind, workers)
        self.kind = kind
        self.workers = workers


class SweepFolderWarning(UserWarning):
    """A damaged chunk was found in the folder of a sweep, and is computed again."""


class SweepFunctionError(BouncingDiskError, TypeError):
    """A function that cannot be swept: it has no lasting name, cannot be sent to workers, or returns no
    array.

    Attributes:
        function: its name.
    """

    def __init__(self, message: str, function: str) -> None:
        super().__init__(message, function)
        self.function = function


class MissingDependencyError(BouncingDiskError, ImportError):
    """An optional package is not installed.

    Attributes:
        package: the package that is missing.
        install: the command that installs it.
    """

    def __init__(self, message: str, package: str, install: str) -> None:
        super().__init__(message, package, install)
        self.package = package
        self.install = install

    @classmethod
    def of(cls, package: str, purpose: str, extra: str) -> MissingDependencyError:
        """The error that says what needs this package, and which extra of this one brings it."""
        install = f"pip install 'bouncing-disk[{extra}]'"
        return cls(f"{purpose} needs {package}, which is not installed: {install}", package, install)
