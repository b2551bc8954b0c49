"""The folder of a sweep: its identity, its lock, its files, and the stored chunks.

A folder that holds another sweep is refused, naming the difference. Files are written whole or not at all, and
read with every byte checked.
"""

from __future__ import annotations

import errno
import hashlib
import inspect
import io
import json
import os
import re
import socket
import sys
import warnings
from collections.abc import Callable, Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bouncing_disk._sweep.errors import SweepFolderError, SweepFolderWarning, SweepFunctionError
from bouncing_disk._sweep.grid import Array, Grid, array_digest, refuse_masked

#: The packages that must have the same version everywhere.
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
    """The full name of a function by which a later run recognises it."""
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
    """The versions on which the bits depend: of this package, and of NumPy for functions of the caller."""
    if not _KNOWN:
        for package in PACKAGES:
            try:
                _KNOWN[package] = version(package)
            except PackageNotFoundError:
                _KNOWN[package] = "unknown"
    return dict(_KNOWN)


#: The end of the name of a file that is not finished.
UNFINISHED = ".unfinished"


class Damaged(Exception):
    """A file that differs from what was written; the message says why."""


class StoredChunk(NamedTuple):
    """The file of a finished chunk."""

    about: dict[str, Any]
    values: Array
    #: The places of failed points in the chunk.
    failed: Array


def write_whole(path: Path, content: bytes) -> None:
    """A file beside its place, on the disk, and then renamed into it."""
    beside = path.with_name(path.name + UNFINISHED)
    try:
        with open(beside, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def read_json(path: Path) -> dict[str, Any]:
    """A description; :class:`Damaged` if it is not one of ours."""
    try:
        if not path.is_file():
            raise Damaged("it is not a file")
        content = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, OSError, RecursionError) as error:
        raise Damaged(f"it cannot be read: {error}") from error
    if not isinstance(content, dict) or not isinstance(content.get("format"), dict):
        raise Damaged("it does not say what it is")
    _check_format(content["format"])
    return content


def _check_format(found: dict[str, Any]) -> None:
    if found.get("name") != FORMAT or not isinstance(found.get("version"), int):
        raise Damaged(f"it is not of the format {FORMAT!r}")


def is_newer(described: dict[str, Any]) -> bool:
    """Whether a later version of this package wrote it, in a format that this one does not know."""
    return bool(described["format"]["version"] > FORMAT_VERSION)


def write_chunk(path: Path, about: dict[str, Any], values: Array, failed: Array) -> None:
    """The file of a chunk: an NPZ archive of `values`, `failed`, and `about` (JSON) with digests."""
    about = {**about, "values_sha256": array_digest(values), "failed_sha256": array_digest(failed)}
    text = json.dumps(about, ensure_ascii=True)
    archive = io.BytesIO()
    np.savez(archive, about=np.array(text), sha256=np.array(_digest(text)), values=values, failed=failed)
    write_whole(path, archive.getvalue())


def read_chunk(path: Path) -> StoredChunk:
    """The file of a chunk; :class:`Damaged` if one bit of it is not what was written."""
    if not path.is_file():
        raise Damaged("it is not a file")
    try:
        with np.load(path, allow_pickle=False) as archive:
            members = {name: archive[name] for name in ("about", "sha256", "values", "failed")}
        text = str(members["about"][()])
        about = json.loads(text)
    # The archive's reader raises whatever its parts raise at bytes that mean nothing.
    except Exception as error:
        raise Damaged(f"it cannot be read ({type(error).__name__}: {error})") from error
    if str(members["sha256"][()]) != _digest(text):
        raise Damaged("its description was changed")
    for name in ("values", "failed"):
        if about[f"{name}_sha256"] != array_digest(members[name]):
            raise Damaged(f"its {name} were changed")
    _check_format(about["format"])
    return StoredChunk(about, members["values"], members["failed"])


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


LOCK_FILE = "sweep.lock"

#: Where the byte lies that Windows locks: behind the text, which others may read.
_LOCKED_BYTE = 1 << 20


class FolderLock:
    """A lock held from creation until :meth:`release`. Creating it never waits."""

    def __init__(self, folder: Path) -> None:
        path = folder / LOCK_FILE
        try:
            self._file = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
        except OSError as error:
            raise SweepFolderError(
                f"{folder} cannot be written in: {error.strerror or error}", str(folder), "cannot-write"
            ) from error
        try:
            _lock(self._file)
        except OSError as error:
            holder = os.pread(self._file, 200, 0).decode("ascii", "replace") if hasattr(os, "pread") else ""
            os.close(self._file)
            if error.errno in (errno.EACCES, errno.EAGAIN, errno.EDEADLK):
                by = f" by {holder.strip()}" if holder.strip().isprintable() and holder.strip() else ""
                message = f"{folder} is in use{by}: another sweep writes there"
                raise SweepFolderError(message, str(folder), "in-use") from None
            message = f"{folder} cannot be locked ({error.strerror or error}): two sweeps at once would not be noticed"
            raise SweepFolderError(message, str(folder), "cannot-lock") from error
        os.ftruncate(self._file, 0)
        os.write(self._file, f"process {os.getpid()} on {socket.gethostname()}".encode("ascii", "replace"))

    def release(self) -> None:
        """Let others in; closing the file does so."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1


if sys.platform == "win32":
    import msvcrt

    def _lock(file: int) -> None:
        os.lseek(file, _LOCKED_BYTE, os.SEEK_SET)
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        os.lseek(file, 0, os.SEEK_SET)

else:
    import fcntl

    def _lock(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


DESCRIPTION = "sweep.json"
AXES = "axes.npz"
#: Files of ours that a process has left which was killed, and no file of anybody else.
_UNFINISHED = re.compile(r"(chunk-\d{6,}\.npz|axes\.npz|sweep\.json)" + re.escape(UNFINISHED))


def chunk_path(folder: Path, chunk: int) -> Path:
    """Where a chunk lies."""
    return folder / f"chunk-{chunk:06}.npz"


class Journal:
    """A folder that is locked for one sweep."""

    def __init__(self, folder: Path, identity: Identity, grid: Grid) -> None:
        self.folder = folder
        self.identity = identity
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise self._refused(f"cannot be made: {error.strerror or error}", "cannot-write") from error
        found = (folder / LOCK_FILE).exists()
        self._lock = FolderLock(folder)
        try:
            self._open(grid)
        except BaseException as error:
            self.close()
            if not found and isinstance(error, SweepFolderError) and error.kind == "other-files":
                # The folder of somebody else is left as it was.
                (folder / LOCK_FILE).unlink(missing_ok=True)
            raise

    def close(self) -> None:
        """Let others in."""
        self._lock.release()

    def _open(self, grid: Grid) -> None:
        names = {path.name for path in self.folder.iterdir()}
        unfinished = {name for name in names if _UNFINISHED.fullmatch(name)}
        if DESCRIPTION not in names and (others := sorted(names - unfinished - {LOCK_FILE, AXES})):
            raise self._refused(f"holds other files, such as {others[0]}, and no sweep", "other-files")
        # Under the lock an unfinished file is that of a process that was killed.
        for name in unfinished:
            (self.folder / name).unlink(missing_ok=True)
        if DESCRIPTION in names:
            self._compare()
            if AXES in names:
                return
        axes = io.BytesIO()
        # As `axis_NAME`, because NumPy has names of its own for two arguments.
        members: dict[str, Any] = {f"axis_{name}": axis for name, axis in grid.axes.items()}
        np.savez(axes, **members)
        described = json.dumps({**self.identity.described, "digest": self.identity.digest}, indent=1)
        try:
            write_whole(self.folder / AXES, axes.getvalue())
            if DESCRIPTION not in names:
                write_whole(self.folder / DESCRIPTION, described.encode())
        except OSError as error:
            raise self._refused(f"cannot be written in: {error.strerror or error}", "cannot-write") from error

    def _compare(self) -> None:
        described = open_description(self.folder)
        if found := self.identity.difference(described):
            raise self._refused(f"holds another sweep: {found}", "another-sweep")

    def read(self, chunk: int) -> StoredChunk | None:
        """A finished chunk; None if it is missing or damaged, with a warning in the latter case."""
        path = chunk_path(self.folder, chunk)
        if not path.exists():
            return None
        try:
            stored = read_chunk(path)
        except Damaged as damage:
            message = f"{path}: {damage}; the chunk is computed again"
            warnings.warn(SweepFolderWarning(message), stacklevel=4)
            return None
        check_foreign(self.folder, path, stored, self.identity.digest, chunk)
        return stored

    def write(self, chunk: int, start: int, values: Array, failed: Array) -> None:
        """Store a finished chunk."""
        about = {
            **self.identity.described,
            "digest": self.identity.digest,
            "chunk": chunk,
            "first_point": start,
            "last_point": start + len(values) - 1,
        }
        try:
            write_chunk(chunk_path(self.folder, chunk), about, values, failed)
        except OSError as error:
            raise self._refused(f"cannot be written in: {error.strerror or error}", "cannot-write") from error

    def _refused(self, what: str, kind: str) -> SweepFolderError:
        return SweepFolderError(f"{self.folder} {what}", str(self.folder), kind)


def check_foreign(folder: Path, path: Path, stored: StoredChunk, digest: str, chunk: int) -> None:
    """Refuse the whole file of another sweep, or of another place."""
    if stored.about.get("digest") != digest:
        message = f"{path} is a chunk of another sweep"
    elif stored.about.get("chunk") != chunk:
        message = f"{path} is chunk {stored.about.get('chunk')}, not {chunk}"
    else:
        return
    raise SweepFolderError(message, str(folder), "foreign-chunk")


def open_description(folder: Path) -> dict[str, Any]:
    """The description of the sweep in a folder, without its digest, which is compared."""
    path = folder / DESCRIPTION
    if not path.exists():
        raise SweepFolderError(f"{folder} holds no sweep", str(folder), "not-a-sweep")
    try:
        described = read_json(path)
    except Damaged as damage:
        raise SweepFolderError(f"{path}: {damage}", str(folder), "damaged") from damage
    if is_newer(described):
        program = described.get("program")
        message = (
            f"{path} was written by {program} in version {described['format']['version']}, which is newer"
        )
        raise SweepFolderError(message, str(folder), "newer-format")
    digest = described.pop("digest", None)
    if digest != digest_of(described):
        raise SweepFolderError(f"{path}: it was changed", str(folder), "damaged")
    return described


def read_axes(folder: Path, described: dict[str, Any]) -> Grid:
    """The grid of the sweep in a folder."""
    path = folder / AXES
    try:
        with np.load(path, allow_pickle=False) as archive:
            grid = Grid({name: archive[f"axis_{name}"] for name in described["grid"]})
    except Exception as error:
        message = f"{path}: it cannot be read ({type(error).__name__}: {error})"
        raise SweepFolderError(message, str(folder), "damaged") from error
    if grid.described() != described["grid"]:
        raise SweepFolderError(f"{path}: it was changed", str(folder), "damaged")
    return grid
