"""The folder of a sweep: one file for each finished chunk, so that a sweep that was ended goes on."""

from __future__ import annotations

import io
import json
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from bouncing_disk._sweep.errors import SweepFolderError, SweepFolderWarning
from bouncing_disk._sweep.files import (
    UNFINISHED,
    Damaged,
    StoredChunk,
    is_newer,
    read_chunk,
    read_json,
    write_chunk,
    write_whole,
)
from bouncing_disk._sweep.grid import Array, Grid
from bouncing_disk._sweep.identity import Identity, digest_of
from bouncing_disk._sweep.lock import LOCK_FILE, FolderLock

__all__ = ["Journal", "chunk_path", "open_description", "read_axes"]

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
        """A finished chunk; None if it is not there or damaged, which is told by a warning."""
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
