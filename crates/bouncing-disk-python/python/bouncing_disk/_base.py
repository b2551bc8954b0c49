"""The common parts of parameters and results, and the types of arguments: for `import *` by the chapters."""

# mypy: disable-error-code="no-any-return"
from __future__ import annotations

import json as json_module
from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import fields, is_dataclass
from math import isfinite
from typing import TYPE_CHECKING, Any, ClassVar, SupportsFloat, SupportsIndex, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from bouncing_disk import _native as native
from bouncing_disk._errors import InvalidError

__all__ = [
    "ArrayLike",
    "BoolArray",
    "ByteArray",
    "ComplexArray",
    "Float",
    "FloatArray",
    "Int",
    "IntArray",
    "Pair",
    "Parameters",
    "Progress",
    "Result",
    "Stored",
    "Table",
    "hashable",
    "readable",
    "set_threads",
    "threads",
]

ArrayLike: TypeAlias = npt.ArrayLike
FloatArray: TypeAlias = npt.NDArray[np.float64]
IntArray: TypeAlias = npt.NDArray[np.int64]
ByteArray: TypeAlias = npt.NDArray[np.uint8]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
ComplexArray: TypeAlias = npt.NDArray[np.complex128]

Float: TypeAlias = SupportsFloat | SupportsIndex
Int: TypeAlias = SupportsIndex
Pair: TypeAlias = tuple[Float, Float] | list[float] | FloatArray
#: A table of a file: numbers, texts and lists by their names.
Table: TypeAlias = Mapping[str, Any]
Progress: TypeAlias = Callable[[int, int], object] | None

Own = TypeVar("Own", bound="Parameters")
Kept = TypeVar("Kept", bound="Stored")


class Parameters:
    """An immutable object made from keywords, which are checked on construction."""

    _given: dict[str, Any]
    _native: Any

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            # The numbers are computed on first use; calls of the library do not need them.
            if name == "_native" or "_given" in self.__dict__:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            self.__dict__.update(self._native.numbers())
            return getattr(self, name)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a {type(self).__name__} never changes; replace() makes another one")

    __delattr__ = __setattr__  # type: ignore[assignment]

    def _key(self) -> object:
        return hashable(self._given)

    def __eq__(self, other: object) -> bool:
        return self._key() == other._key() if isinstance(other, type(self)) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._key())

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={own!r}' for name, own in self._given.items())})"

    def __reduce__(self) -> tuple[Any, ...]:
        return _of, (type(self), self._given)

    @classmethod
    def _holding(cls: type[Own], held: Any) -> Own:
        """The object of the library that this one holds."""
        made = cls.__new__(cls)
        made.__dict__["_native"] = held
        return made

    def replace(self: Own, **changes: Any) -> Own:
        """The same object with other arguments of the constructor."""
        return _of(type(self), {**self._given, **changes})

    def to_dict(self) -> dict[str, Any]:
        """The given arguments of the constructor; the drive of a map is a dictionary."""
        given = deepcopy(self._given)
        return {name: own.to_dict() if isinstance(own, Parameters) else own for name, own in given.items()}

    @classmethod
    def from_dict(cls: type[Own], parameters: dict[str, Any]) -> Own:
        """The object from a dictionary as returned by :meth:`to_dict`."""
        return _of(cls, parameters)

    def to_json(self) -> str:
        """The dictionary as JSON, which the Rust library reads as well."""
        return json_module.dumps(self.to_dict())

    @classmethod
    def from_json(cls: type[Own], json: str) -> Own:
        """The object from a string as returned by :meth:`to_json`."""
        text = readable(json)
        try:
            return cls.from_dict(json_module.loads(text, parse_constant=_refused))
        except json_module.JSONDecodeError as error:
            raise _unreadable(error, line=error.lineno, column=error.colno) from None
        except (TypeError, RecursionError) as error:
            raise _unreadable(error) from None


def _unreadable(error: Exception, **where: float | int | str) -> InvalidError:
    return InvalidError(f"the text cannot be read: {error}", "text", where)


def _refused(constant: str) -> float:
    """JSON has no NaN and no infinity."""
    raise _unreadable(ValueError(f"{constant} is not a number"))


def readable(text: str) -> str:
    """The text, unless it contains half of a pair of surrogates, which no reader accepts."""
    if not isinstance(text, str):
        raise TypeError(f"must be a text, not {type(text).__name__}")
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise _unreadable(error, position=error.start) from None
    return text


def hashable(value: Any) -> object:
    """A number or a text; tables and lists of them become tuples."""
    if isinstance(value, dict):
        return tuple((name, hashable(own)) for name, own in value.items())
    return tuple(map(hashable, value)) if isinstance(value, list) else value


def _of(cls: Any, arguments: dict[str, Any]) -> Any:
    """The object of these keywords, called by pickle."""
    return cls(**arguments)


def _restored(cls: Any, json: str) -> Any:
    """The result of a class that is stored as JSON, called by pickle."""
    return cls.from_json(json)


def _same(one: Any, other: Any) -> bool:
    """Whether two values are equal, with NaN equal to itself."""
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        if one.dtype != other.dtype or one.shape != other.shape:
            return False
        # By their bits, because only plain numbers can be compared with NaN equal to itself.
        inexact = np.issubdtype(one.dtype, np.inexact)
        return one.tobytes() == other.tobytes() or np.array_equal(one, other, equal_nan=bool(inexact))
    if isinstance(one, float) and isinstance(other, float) and one != one:
        return other != other
    if isinstance(one, (tuple, list)) and type(one) is type(other):
        return len(one) == len(other) and all(map(_same, one, other))
    if isinstance(one, dict) and isinstance(other, dict):
        return list(one) == list(other) and all(_same(one[key], other[key]) for key in one)
    return type(one) is type(other) and bool(one == other)


def _as_json(value: Any) -> Any:
    """A value of a result as JSON, which has no complex and no non-finite numbers."""
    if isinstance(value, np.ndarray):
        if np.iscomplexobj(value):
            value = np.stack([value.real, value.imag], axis=-1)
        return _as_json(value.tolist())
    if isinstance(value, float):
        return value if isfinite(value) else None
    if is_dataclass(value):
        words = {name.lower(): own for name, own in vars(type(value)).items() if name.isupper()}
        values = {field.name: getattr(value, field.name) for field in fields(value)}
        return _as_json({**values, **words})
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, dict):
        return {name: _as_json(own) for name, own in value.items()}
    if isinstance(value, (tuple, list)):
        return [_as_json(own) for own in value]
    return value.to_dict() if isinstance(value, Parameters) else value


def _shown(value: Any) -> str:
    """A value as one line of text: type and shape for long arrays, the number for many results."""
    if isinstance(value, tuple) and any(isinstance(item, (Result, np.ndarray)) for item in value):
        return f"<{len(value)} {type(value[0]).__name__}>"
    if not isinstance(value, np.ndarray):
        return repr(value)
    return repr(value.tolist()) if value.size <= 4 else f"<{value.dtype} array {value.shape}>"


def _is_undefined(value: Any) -> bool:
    """Whether an array is NaN throughout, such as stator quantities of a prescribed motion."""
    return isinstance(value, np.ndarray) and value.dtype.kind == "f" and value.size > 0 and bool(np.isnan(value).all())


def threads() -> int:
    """The number of threads of a call.

    Returns:
        The number set by :func:`set_threads`, else by the environment variable
        ``RAYON_NUM_THREADS``, else the number of the processor's threads. No bit of a result depends on it.

    >>> import bouncing_disk as bd
    >>> bd.threads() >= 1
    True
    """
    return native.threads()


def set_threads(*, count: Int | None = None) -> None:
    """Set the number of threads of each later call.

    Args:
        count: in [1, 1024]; ``None`` for all of the processor's. No bit of a result depends on it.

    >>> import bouncing_disk as bd
    >>> bd.set_threads(count=1)
    >>> bd.threads()
    1
    >>> bd.set_threads()
    """
    native.set_threads(locals())


class Result:
    """The base of all results, whose fields, including arrays, compare by value."""

    __dataclass_fields__: ClassVar[dict[str, Any]]
    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        """Whether all fields are equal, where NaN is equal to itself."""
        if type(self) is not type(other):
            return NotImplemented
        return all(_same(getattr(self, field.name), getattr(other, field.name)) for field in fields(self))

    def to_json(self) -> str:
        """The fields as a JSON object: arrays as lists, complex numbers as pairs, and null for numbers that
        are not finite. The words for numbers, such as the ``KINDS`` of verdicts, are separate lists
        (``kinds``)."""
        return json_module.dumps(_as_json(self), allow_nan=False)

    def __repr__(self) -> str:
        """The fields except those that are NaN throughout; long arrays by their shape."""
        values = ((field.name, getattr(self, field.name)) for field in fields(self))
        parts = (f"{name}={_shown(value)}" for name, value in values if not _is_undefined(value))
        return f"{type(self).__name__}({', '.join(parts)})"


class Stored(Result):
    """A result from which later calls continue: the library holds, stores and compares it."""

    _native: Any

    def __eq__(self, other: object) -> bool:
        """Whether the library's objects are equal."""
        return self._native == other._native if isinstance(other, type(self)) else NotImplemented

    __hash__: ClassVar[None]

    def to_json(self) -> str:
        """The result as JSON, as the Rust library stores it."""
        if not hasattr(self._native, "to_json"):
            raise TypeError(f"{type(self).__name__} of a map with a drive or a contact time is not stored")
        return self._native.to_json()

    @classmethod
    def from_json(cls: type[Kept], json: str) -> Kept:
        """The result from a string as returned by :meth:`to_json`."""
        return getattr(native, cls.__name__).from_json(readable(json))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), self.to_json())
