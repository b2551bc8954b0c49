"""The exceptions and warnings of sweeps. Each carries the details needed to see why, and can be pickled."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any, NamedTuple

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

    folder: str
    kind: str


class SweepClusterError(BouncingDiskError, RuntimeError):
    """A cluster cannot be used: its workers might compute other results than this process.

    Attributes:
        kind: why: ``"versions"`` if this package or NumPy have other versions there or are missing,
            ``"closed"`` if the client is.
        workers: the versions of each differing worker, by its address: of ``"bouncing-disk"`` and
            ``"numpy"``.
    """

    kind: str
    workers: Mapping[str, Mapping[str, str]]


class SweepFolderWarning(UserWarning):
    """A damaged chunk was found in the folder of a sweep, and is computed again."""


class SweepFunctionError(BouncingDiskError, TypeError):
    """A function that cannot be swept: it has no lasting name, cannot be sent to workers, or returns no
    array.

    Attributes:
        function: its name.
    """

    function: str


class MissingDependencyError(BouncingDiskError, ImportError):
    """An optional package is not installed.

    Attributes:
        package: the package that is missing.
        install: the command that installs it.
    """

    package: str
    install: str

    @classmethod
    def checked(cls, module: str, purpose: str, extra: str) -> Any:
        """A module of an optional package; the error says what needs it, and which extra brings it."""
        try:
            return import_module(module)
        except ImportError as error:
            package, install = module.partition(".")[0], f"pip install 'bouncing-disk[{extra}]'"
            message = f"{purpose} needs {package}, which is not installed: {install}"
            raise cls(message, package, install) from error


def is_installed(package: str) -> bool:
    """Whether an optional package is there."""
    try:
        import_module(package)
    except ImportError:
        return False
    return True
