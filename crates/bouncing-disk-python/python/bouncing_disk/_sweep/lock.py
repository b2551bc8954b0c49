"""The lock of a folder, which ends with the process that holds it."""

from __future__ import annotations

import errno
import os
import socket
import sys
from pathlib import Path

from bouncing_disk._sweep.errors import SweepFolderError

__all__ = ["LOCK_FILE", "FolderLock"]

LOCK_FILE = "sweep.lock"

#: Where the byte lies that Windows locks: behind the text, which others may read.
_LOCKED_BYTE = 1 << 20


class FolderLock:
    """Held from its making until :meth:`release`; never waited for."""

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
