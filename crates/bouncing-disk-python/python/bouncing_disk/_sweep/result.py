"""The result of a sweep, and its NetCDF files, which have fewer types than NumPy."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from bouncing_disk._base import Result
from bouncing_disk._errors import BouncingDiskError, InvalidError
from bouncing_disk._sweep.errors import FailedPoint, MissingDependencyError, is_installed
from bouncing_disk._sweep.grid import Array

if TYPE_CHECKING:
    import xarray

#: How many failed points a message names.
_NAMED = 3
#: The writers of NetCDF files, by the names that xarray uses, and the packages that they need.
_ENGINES = {"netcdf4": ("netCDF4",), "h5netcdf": ("h5netcdf", "h5py"), "scipy": ("scipy",)}


def write_netcdf(dataset: Any, path: str | os.PathLike[str]) -> None:
    """A dataset as a file, written under a temporary name and renamed."""
    plain = _plain(dataset)
    engine = next((engine for engine, needs in _ENGINES.items() if all(map(is_installed, needs))), None)
    if engine is None:
        MissingDependencyError.checked("netCDF4", "a NetCDF file", "netcdf")
    beside = os.fspath(path) + ".unfinished"
    try:
        plain.to_netcdf(beside, engine=engine)
        os.replace(beside, path)
    finally:
        if os.path.exists(beside):
            os.unlink(beside)


def _plain(dataset: Any) -> Any:
    """The dataset with the types that NetCDF has: complex numbers in two parts, halves of a float as floats."""
    whole: dict[str, tuple[tuple[str, ...], Array]] = {}
    axes = {str(name) for name in dataset.coords}
    for name, variable in dataset.variables.items():
        for part, array in _parts(str(name), np.asarray(variable.values)).items():
            if part in whole:
                message = (
                    f"{part!r} is a part of a complex result, and the name of another: rename one of them"
                )
                raise InvalidError(message, "doubled-name", {"name": part})
            whole[part] = (tuple(variable.dims), array)
            if name in axes:
                axes.add(part)
    coordinates = {part: stored for part, stored in whole.items() if part in axes}
    data = {part: stored for part, stored in whole.items() if part not in axes}
    return type(dataset)(data, coords=coordinates, attrs=dataset.attrs)


def _parts(name: str, array: Array) -> dict[str, Array]:
    """A variable as those that are stored."""
    if array.dtype.kind == "c":
        return _parts(f"{name}_real", array.real) | _parts(f"{name}_imag", array.imag)
    if array.dtype == np.float16:
        return {name: array.astype(np.float32)}
    if array.dtype.kind not in "biufUSO" or array.dtype.itemsize > 8 and array.dtype.kind == "f":
        message = f"{name!r} is of {array.dtype}, which NetCDF does not have"
        raise InvalidError(message, "netcdf-type", {"name": name, "dtype": str(array.dtype)})
    return {name: array}


@dataclass(frozen=True, eq=False, repr=False)
class SweepResult(Result):
    """The results of a sweep on its grid. NumPy takes it for an array.

    Attributes:
        values: the results: one axis for each axis of the grid, in its order, followed by those of one
            result. A structured array if the function returns a mapping of names.
        axes: the axes of the grid, shape (n,).
        failed: where the function raised an exception; the shape is that of the grid. `values` is NaN there,
            or 0.
        function: the name of the function.
        arguments: its arguments at every point.
        version: the version of this package.
    """

    values: Array
    axes: dict[str, Array]
    failed: npt.NDArray[np.bool_]
    function: str
    arguments: dict[str, Any]
    version: str

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> Array:
        """The values."""
        array = np.asarray(self.values, dtype)
        return array.copy() if copy and array is self.values else array

    def __getitem__(self, key: Any) -> Any:
        """A part of the values, or a field of them."""
        return self.values[key]

    def __repr__(self) -> str:
        """The function, the axes and the type of the values."""
        axes = " x ".join(f"{name}[{len(axis)}]" for name, axis in self.axes.items())
        failed = f", {int(self.failed.sum())} failed" if self.failed.any() else ""
        return (
            f"SweepResult({self.function} over {axes}: {self.values.dtype} array {self.values.shape}{failed})"
        )

    def to_xarray(self, name: str | None = None) -> xarray.Dataset:
        """The results as a Dataset of xarray, which has the axes as its coordinates.

        Args:
            name: the name of the variable, unless the values are structured; by default that of the function,
                or "result" if it has none.

        Returns:
            One variable, or one for each field. Where the function failed, it equals `values`.
        """
        xarray_module = MissingDependencyError.checked("xarray", "a Dataset", "netcdf")
        fields = self.values.dtype.names
        if fields is None:
            own = self.function.rpartition(".")[2]
            parts: Mapping[str, Array] = {name or (own if own.isidentifier() else "result"): self.values}
        elif name is None:
            parts = {field: self.values[field] for field in fields}
        else:
            message = (
                f"the results have fields with names ({', '.join(fields)}): a name for them is not needed"
            )
            raise InvalidError(message, "name", {"name": name})
        if doubled := sorted(set(parts) & set(self.axes)):
            message = f"{doubled[0]!r} is an axis and a result: rename one of them"
            raise InvalidError(message, "doubled-name", {"name": doubled[0]})
        variables = {part: (self._dimensions(part, array), array) for part, array in parts.items()}
        if self.failed.any():
            variables["failed"] = (tuple(self.axes), self.failed)
        attributes = {
            "function": self.function,
            "arguments": json.dumps(self.arguments, default=repr),
            "program": f"bouncing-disk {self.version}",
        }
        dataset: xarray.Dataset = xarray_module.Dataset(variables, coords=self.axes, attrs=attributes)
        return dataset

    def _dimensions(self, name: str, array: Array) -> tuple[str, ...]:
        inner = array.ndim - len(self.axes)
        return (*self.axes, *(f"{name}_{number}" for number in range(inner)))

    def to_netcdf(self, path: str | os.PathLike[str], name: str | None = None) -> None:
        """Store the results as a NetCDF file, by xarray and one of its backends.

        NetCDF has no complex numbers: such a variable NAME is stored as two, ``NAME_real`` and ``NAME_imag``,
        and so is a complex axis, beside a dimension without coordinates.

        Args:
            path: the file. It is written under a temporary name and renamed.
            name: as in `to_xarray`.

        Raises:
            InvalidError: A type that NetCDF does not have, such as ``longdouble``; or two names that become
                one.
        """
        write_netcdf(self.to_xarray(name), path)


class SweepFailedError(BouncingDiskError, RuntimeError):
    """The function raised exceptions at points of the grid; the results of all other points are kept.

    Attributes:
        failures: the points, in the order of the grid.
        result: the computed results, with ``result.failed`` for the missing ones; ``None`` if the sweep was given up
            because more points failed than ``max_failures``.
    """

    failures: tuple[FailedPoint, ...]
    result: SweepResult | None

    @classmethod
    def of(cls, failures: tuple[FailedPoint, ...], result: SweepResult | None) -> SweepFailedError:
        """The error that names the first of these points."""
        more = len(failures) - _NAMED
        named = "; ".join(str(failure) for failure in failures[:_NAMED])
        tail = f"; and {more} more" if more > 0 else ""
        given_up = "the sweep was given up: " if result is None else ""
        points = "1 point" if len(failures) == 1 else f"{len(failures)} points"
        return cls(f"{given_up}the function failed at {points}: {named}{tail}", failures, result)
