"""The files of a sweep's folder: written whole or not at all, read with every byte checked."""

from __future__ import annotations

import hashlib
import io
import json
import os
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bouncing_disk._sweep.grid import Array, array_digest
from bouncing_disk._sweep.identity import FORMAT, FORMAT_VERSION

__all__ = ["Damaged", "StoredChunk", "read_chunk", "read_json", "write_chunk", "write_whole"]

#: The end of the name of a file that is not finished.
UNFINISHED = ".unfinished"


class Damaged(Exception):
    """A file that is not what was written; the message says why."""


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
    """A description; :class:`Damaged` if it is none of ours."""
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
