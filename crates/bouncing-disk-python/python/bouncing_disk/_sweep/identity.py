"""What a sweep is known by: its function, arguments, grid and chunks, and the version of this package.

A folder that holds another one is refused by the name of what differs.
"""

from __future__ import annotations

import hashlib
import inspect
import json
from collections.abc import Callable, Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from bouncing_disk._sweep.errors import SweepFunctionError
from bouncing_disk._sweep.grid import Grid, array_digest, refuse_masked

__all__ = ["PACKAGES", "Identity", "function_name", "lasting_name", "package_version", "versions"]

#: What must have the same version everywhere.
PACKAGES = ("bouncing-disk", "numpy")

#: The name and the version of the files; the version rises when who reads older files could misunderstand
#: newer ones.
FORMAT = "bouncing-disk sweep"
FORMAT_VERSION = 1


def function_name(function: Callable[..., Any]) -> str:
    """The full name of a function, whatever it is."""
    named = getattr(function, "__qualname__", None) or type(function).__qualname__
    module = getattr(function, "__module__", None) or type(function).__module__
    return f"{module}.{named}"


def lasting_name(function: Callable[..., Any]) -> str:
    """The full name of a function by which a later run knows it again."""
    name = function_name(function)
    # Of a compiled function this is its module.
    owner = getattr(function, "__self__", None)
    if "<lambda>" in name:
        why = "a lambda has no name by which a resumed sweep would know it"
    elif "<locals>" in name:
        why = "it is defined inside another function, whose variables a resumed sweep would not know"
    elif not inspect.isroutine(function):
        why = f"an object of {type(function).__name__} has no name by which a resumed sweep would know it"
    elif owner is not None and not inspect.ismodule(owner):
        why = "it is the method of an object or a class, which a resumed sweep would not know"
    elif hasattr(function, "__wrapped__"):
        why = "it is wrapped by a decorator, whose settings a resumed sweep would not know"
    elif inspect.isfunction(function) and _source_digest(function) is None:
        why = "its source text cannot be read, so that a change of it would not be seen"
    else:
        return name
    advice = "define a function at the top of a module or notebook, and hand constants on by `arguments`"
    raise SweepFunctionError(f"{name} cannot be swept with a folder: {why}; {advice}", name)


def _source_digest(function: Callable[..., Any]) -> str | None:
    """The digest of the function's source text, where there is one (compiled functions have none)."""
    try:
        return hashlib.sha256(inspect.getsource(function).encode()).hexdigest()
    except (OSError, TypeError):
        return None


def _plain(value: Any, where: str) -> Any:
    """An argument as JSON, by which it is compared: numbers keep every bit, NaN and infinities are text."""
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, (int, np.integer)):
        return int(value)
    if isinstance(value, (float, np.floating)):
        return float(value) if np.isfinite(value) else repr(float(value))
    if isinstance(value, complex):
        return {"complex": [_plain(value.real, where), _plain(value.imag, where)]}
    refuse_masked(value, where)
    if isinstance(value, np.ndarray) and value.dtype.kind != "O":
        return {"array": [value.dtype.str, list(value.shape), array_digest(value)]}
    if isinstance(value, (list, tuple)):
        return [_plain(item, where) for item in value]
    if isinstance(value, Mapping) and all(isinstance(key, str) for key in value):
        return {key: _plain(item, f"{where}.{key}") for key, item in value.items()}
    to_dict = getattr(value, "to_dict", None)
    if callable(to_dict):
        return {type(value).__qualname__: _plain(to_dict(), where)}
    raise TypeError(
        f"{where} is of {type(value).__name__}, by which a resumed sweep could not be compared: give numbers, text, "
        "arrays, lists, mappings, or objects of this package"
    )


class Identity:
    """The description of a sweep, and its digest."""

    def __init__(
        self,
        function: Callable[..., Any],
        grid: Grid,
        arguments: Mapping[str, Any],
        chunk_size: int,
        pointwise: bool,
    ) -> None:
        plain = {name: _plain(value, f"arguments[{name!r}]") for name, value in sorted(arguments.items())}
        self.described: dict[str, Any] = {
            "format": {"name": FORMAT, "version": FORMAT_VERSION},
            "program": {"name": "bouncing-disk", "version": package_version()},
            "function": lasting_name(function),
            "source": _source_digest(function),
            "pointwise": pointwise,
            "arguments": plain,
            "grid": grid.described(),
            "points": grid.points,
            "chunk_size": chunk_size,
        }
        self.digest = digest_of(self.described)

    def difference(self, other: Mapping[str, Any]) -> str | None:
        """In a few words, the first thing in which another description differs from this one."""
        return _difference(self.described, other, "")


def _difference(ours: Any, theirs: Any, path: str) -> str | None:
    if isinstance(ours, Mapping) and isinstance(theirs, Mapping):
        if path == "grid" and list(ours) != list(theirs):
            return f"the axes are {', '.join(theirs)} there, {', '.join(ours)} here"
        for name in [*ours, *(name for name in theirs if name not in ours)]:
            inner = f"{path}.{name}" if path else str(name)
            if name not in ours or name not in theirs:
                return f"{inner} is {'here' if name in ours else 'there'} alone"
            if found := _difference(ours[name], theirs[name], inner):
                return found
        return None
    # Through JSON, as the other one was.
    if json.dumps(ours) == json.dumps(theirs):
        return None
    if path == "source":
        return "the source text of the function was changed"
    if path.endswith(".sha256"):
        return f"the values of {path.removesuffix('.sha256')} differ"
    return f"{path} is {theirs!r} there, {ours!r} here"


def digest_of(described: Mapping[str, Any]) -> str:
    """The SHA-256 of a description; the order of the axes counts."""
    return hashlib.sha256(json.dumps(described, ensure_ascii=True).encode()).hexdigest()


def package_version() -> str:
    """The version of this package."""
    return versions()["bouncing-disk"]


#: The versions as they were read first: reading them takes milliseconds.
_KNOWN: dict[str, str] = {}


def versions() -> dict[str, str]:
    """The versions of what the bits depend on: this package, and NumPy for functions of the caller."""
    if not _KNOWN:
        for package in PACKAGES:
            try:
                _KNOWN[package] = version(package)
            except PackageNotFoundError:
                _KNOWN[package] = "unknown"
    return dict(_KNOWN)
