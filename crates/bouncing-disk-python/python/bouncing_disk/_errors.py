"""The exceptions. Each carries the numbers that explain it, and can be pickled."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = [
    "BouncingDiskError",
    "ComputationError",
    "FitRefusedError",
    "InvalidError",
    "MissingDependencyError",
    "OutOfRangeError",
    "TooLargeError",
]


class BouncingDiskError(Exception):
    """The base class of all exceptions of this package.

    The first argument is the message; all others are attributes.
    """

    def __init__(self, message: str = "", *details: Any) -> None:
        super().__init__(message, *details)
        # The attributes that a class declares are its arguments, in their order.
        self.__dict__.update(zip(type(self).__annotations__, details))

    def __str__(self) -> str:
        """The message."""
        return str(self.args[0])


class OutOfRangeError(BouncingDiskError, ValueError):
    """A value lies outside its legal range.

    Attributes:
        field: the name of the argument, or a path into it, such as ``disk.restitution`` in a dictionary.
        value: the given value, or the length of a list that is too short or too long.
        range: the legal range, in words and in the unit of the value.

    >>> import bouncing_disk as bd
    >>> try:
    ...     bd.System.motor().replace(restitution=1.5)
    ... except bd.OutOfRangeError as error:
    ...     print(error.field, error.value, error.range)
    restitution 1.5 [0, 1)
    """

    field: str
    value: float
    range: str


class TooLargeError(BouncingDiskError, ValueError):
    """More was requested than the limit allows or than memory can hold.

    Attributes:
        what: what was requested.
        count: the requested number.
        limit: the largest number.
    """

    what: str
    count: int
    limit: int


class InvalidError(BouncingDiskError, ValueError):
    """Arguments that do not fit together, or a text that cannot be read.

    Attributes:
        kind: the kind of fault, such as ``"not-given"``, ``"both-given"``, ``"text"``, or
            ``"out-of-range-together"`` for an illegal quantity that follows from several legal arguments.
        details: its names and numbers: for a text its ``line`` and ``column``, for a quantity that follows
            from several arguments the ``quantity``, its ``value`` and ``range``, and the ``arguments``.

    >>> import bouncing_disk as bd
    >>> try:
    ...     bd.System.pizza_toss().replace(amplitude=1e300)
    ... except bd.InvalidError as error:
    ...     print(error.details["quantity"], error.details["range"])
    peak_acceleration [0, 1e8] (units of the preload acceleration)
    """

    kind: str
    details: dict[str, float | int | str]


class FitRefusedError(BouncingDiskError, ValueError):
    """A curve allows no trustworthy fit; the message states why."""


class ComputationError(BouncingDiskError, RuntimeError):
    """A computation with legal arguments has no result.

    Attributes:
        kind: why, such as ``"never-leaves"`` or ``"not-settled"``.
        details: the numbers.
    """

    kind: str
    details: dict[str, float | int | str]


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
        """A module of an optional package; the error names its purpose, and the extra that installs it."""
        try:
            return import_module(module)
        except ImportError as error:
            package, install = module.partition(".")[0], f"pip install 'bouncing-disk[{extra}]'"
            message = f"{purpose} needs {package}, which is not installed: {install}"
            raise cls(message, package, install) from error
