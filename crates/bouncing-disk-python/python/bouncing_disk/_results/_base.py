"""What all results have in common."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
ByteArray = npt.NDArray[np.uint8]
BoolArray = npt.NDArray[np.bool_]


def _restored(cls: Any, json: str) -> Any:
    """The object of a class that writes itself as JSON: what a pickle calls."""
    return cls.from_json(json)


def _same(one: Any, other: Any) -> bool:
    """Whether two values are equal, where NaN is equal to itself."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        inexact = np.issubdtype(one.dtype, np.inexact)
        return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=bool(inexact))
    if isinstance(one, float) and isinstance(other, float) and one != one:
        return other != other
    if isinstance(one, (tuple, list)) and type(one) is type(other):
        return len(one) == len(other) and all(map(_same, one, other))
    if isinstance(one, dict) and isinstance(other, dict):
        return list(one) == list(other) and all(_same(one[key], other[key]) for key in one)
    return type(one) is type(other) and bool(one == other)


def _shown(value: Any) -> str:
    """A value in a line of text: an array by its type and shape, if it is long."""
    if not isinstance(value, np.ndarray):
        return repr(value)
    return repr(value.tolist()) if value.size <= 4 else f"<{value.dtype} array {value.shape}>"


class Result:
    """What all results have in common: fields that compare by their values, arrays among them."""

    __dataclass_fields__: ClassVar[dict[str, Any]]
    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        """Whether all fields are equal, where NaN is equal to itself."""
        if type(self) is not type(other):
            return NotImplemented
        return all(_same(getattr(self, field.name), getattr(other, field.name)) for field in fields(self))

    def __repr__(self) -> str:
        """The fields, long arrays by their shape."""
        parts = (f"{field.name}={_shown(getattr(self, field.name))}" for field in fields(self))
        return f"{type(self).__name__}({', '.join(parts)})"
