"""The threads that compute."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

from bouncing_disk import _native as native
from bouncing_disk._base import *

__all__ = ["set_threads", "threads"]


def threads() -> int:
    """How many threads a call computes with.

    Returns:
        The number that :func:`set_threads` has set, else that of the environment variable
        ``RAYON_NUM_THREADS``, else that of the processor's threads. No bit of a result depends on it.

    >>> import bouncing_disk as bd
    >>> bd.threads() >= 1
    True
    """
    return native.threads()


def set_threads(*, count: Int | None = None) -> None:
    """Set how many threads each later call computes with.

    Args:
        count: in [1, 1024]; ``None`` for as many as the processor has. No bit of a result depends on it.

    >>> import bouncing_disk as bd
    >>> bd.set_threads(count=1)
    >>> bd.threads()
    1
    >>> bd.set_threads()
    """
    native.set_threads(locals())
