"""NetCDF files of results, which have fewer types than NumPy."""

from __future__ import annotations

import os
from importlib import import_module
from typing import Any

import numpy as np

from bouncing_disk._errors import InvalidError
from bouncing_disk._sweep.errors import MissingDependencyError
from bouncing_disk._sweep.grid import Array

__all__ = ["write_netcdf"]

#: What writes NetCDF files, by the name that xarray knows it by, and the packages that it needs.
_ENGINES = {"netcdf4": ("netCDF4",), "h5netcdf": ("h5netcdf", "h5py"), "scipy": ("scipy",)}


def write_netcdf(dataset: Any, path: str | os.PathLike[str]) -> None:
    """A dataset as a file, written beside its place and renamed into it."""
    plain = _plain(dataset)
    engine = next((engine for engine, needs in _ENGINES.items() if all(map(_is_installed, needs))), None)
    if engine is None:
        raise MissingDependencyError.of("netCDF4", "a NetCDF file", "netcdf")
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


def _is_installed(package: str) -> bool:
    try:
        import_module(package)
    except ImportError:
        return False
    return True
