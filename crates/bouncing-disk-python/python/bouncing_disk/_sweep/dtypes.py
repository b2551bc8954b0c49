"""Types of results that change from point to point: the one type that holds them all.

It is a function of the set of types alone, whatever the order in which they come (which
:func:`numpy.result_type` does not promise), so that chunks and workers do not show in it. Integers become
floats and floats become complex numbers; truth values and texts stay what they are.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from bouncing_disk._sweep.grid import Array

__all__ = ["Lossy", "converted", "joined"]

#: The largest integers that doubles hold, all of them.
_EXACT = 2**53

#: Integers, signed and unsigned, floats and complex numbers.
_NUMBERS = "iufc"


class Lossy(ValueError):
    """A number would not be the same in the type that holds all."""


def joined(one: np.dtype[Any], other: np.dtype[Any]) -> np.dtype[Any] | None:
    """The type that holds the values of both; None if there is none that is safe."""
    if one == other:
        return one
    if one.names is not None or other.names is not None:
        return _joined_fields(one, other)
    kinds = one.kind + other.kind
    if one.kind == other.kind and one.kind in "US":
        return max(one, other, key=lambda text: text.itemsize)
    if not all(kind in _NUMBERS for kind in kinds):
        return None
    if one.kind == other.kind:
        return _native(max(one, other, key=lambda number: number.itemsize))
    if set(kinds) == {"i", "u"}:
        # No integer holds the largest unsigned and negative ones; those that a float holds are many enough.
        unsigned = one if one.kind == "u" else other
        return np.dtype(np.int64 if unsigned.itemsize < 8 else np.float64)
    bits = max(_precision(one), _precision(other))
    return np.dtype(f"c{2 * bits}") if "c" in kinds else np.dtype(f"f{bits}")


def _native(dtype: np.dtype[Any]) -> np.dtype[Any]:
    return dtype.newbyteorder("=")


def _precision(dtype: np.dtype[Any]) -> int:
    """Bytes of the float that holds a number, or each part of it."""
    if dtype.kind in "iu":
        return 8
    return dtype.itemsize // 2 if dtype.kind == "c" else dtype.itemsize


def _joined_fields(one: np.dtype[Any], other: np.dtype[Any]) -> np.dtype[Any] | None:
    """Of structured types: field by field, if they have the same ones."""
    if one.names is None or one.names != other.names:
        return None
    fields: list[Any] = []
    for name in one.names:
        ours, theirs = one[name], other[name]
        inner = joined(ours.base, theirs.base)
        if inner is None or ours.shape != theirs.shape:
            return None
        fields.append((name, inner, ours.shape))
    return np.dtype(fields)


def converted(values: Array, dtype: np.dtype[Any]) -> Array:
    """The values in the type that holds all; :class:`Lossy` where an integer has too many digits for it."""
    if values.dtype == dtype:
        return values
    if dtype.names is not None:
        whole = np.empty(values.shape, dtype)
        for name in dtype.names:
            whole[name] = converted(values[name], dtype[name].base)
        return whole
    if values.dtype.kind in "iu" and dtype.kind in "fc":
        beyond = (values > _EXACT) | (values < -_EXACT)
        if beyond.any():
            number = values[beyond].ravel()[0]
            raise Lossy(f"the integer {number} has more digits than {dtype}, in which it would stand")
    return values.astype(dtype)
