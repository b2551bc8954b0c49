"""Results whose types change from point to point, and where they are stored."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd
from bouncing_disk._sweep.grid import joined

GRID = {"a": [1.0, 2.0, 3.0, 4.0], "b": [10.0, 20.0, 30.0]}


def swept(function: Callable[..., Any], **options: Any) -> bd.SweepResult:
    return bd.sweep(function, GRID, "serial", **{"pointwise": True, **options})


@pytest.mark.parametrize("chunk_size", [1, 2, 5, 12])
def test_integers_become_floats_and_floats_complex(chunk_size: int) -> None:
    mixed = swept(lambda a, b: 1 if a < 2.0 else 1.5, chunk_size=chunk_size)
    assert mixed.values.dtype == np.float64
    assert mixed.values[:, 0].tolist() == [1.0, 1.5, 1.5, 1.5]
    mixed = swept(lambda a, b: [1, 0.5, 2j][int(b) // 10 - 1], chunk_size=chunk_size)
    assert mixed.values.dtype == np.complex128
    assert mixed.values[0].tolist() == [1.0, 0.5, 2j]
    fields = swept(lambda a, b: {"x": 1 if a < 2.0 else 1.5, "n": 3}, chunk_size=chunk_size)
    assert fields.values.dtype == np.dtype([("x", "f8"), ("n", "i8")])
    texts = swept(lambda a, b: "x" * int(a), chunk_size=chunk_size)
    assert texts.values[:, 0].tolist() == ["x", "xx", "xxx", "xxxx"]


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda a, b: True if a < 2.0 else 1.0, "bool.*float64|float64.*bool"),
        (lambda a, b: "x" if a < 2.0 else 1.0, "<U1.*float64|float64.*<U1"),
        (lambda a, b: 2**60 if a < 2.0 else 1.0, "1152921504606846976 has more digits than float64"),
        (lambda a, b: [1.0] * int(a), "shape"),
        (lambda a, b: {"x": a} if a < 2.0 else {"y": a}, "'x'.*'y'|'y'.*'x'"),
        (lambda a, b: np.uint64(2**60) if a < 2.0 else -1, "1152921504606846976 has more digits"),
    ],
)
@pytest.mark.parametrize("chunk_size", [1, 5, 12])
def test_what_mixes_with_nothing_is_refused(function: Any, message: str, chunk_size: int) -> None:
    with pytest.raises(bd.SweepFunctionError, match=message):
        swept(function, chunk_size=chunk_size)


def failing(a: float, b: float, failed: float) -> Any:
    if a == failed:
        raise ValueError("not here")
    return 1 if b < 15.0 else 0.25


@pytest.mark.parametrize("chunk_size", [1, 2, 3, 7, 12])
def test_failed_points_have_the_same_bits_in_all_chunks(chunk_size: int, tmp_path: Path) -> None:
    def result(size: int, **options: Any) -> bd.SweepResult:
        with pytest.raises(bd.SweepFailedError) as failure:
            swept(failing, arguments={"failed": 2.0}, chunk_size=size, **options)
        assert failure.value.result is not None
        return failure.value.result

    expected = result(12)
    assert np.isnan(expected.values[1]).all() and expected.failed[1].all()
    found = result(chunk_size, folder=tmp_path / "x")
    assert found.values.tobytes() == expected.values.tobytes()
    # Tried again from the folder, with other types at the points that failed.
    assert result(chunk_size, folder=tmp_path / "x").values.tobytes() == expected.values.tobytes()
    if chunk_size > 3:
        assert bd.read_sweep(tmp_path / "x").values.tobytes() == expected.values.tobytes()


def later(a: float, b: float, flag: str) -> Any:
    if a == 3.0 and not Path(flag).exists():
        raise ValueError("not yet")
    return 0.5 if a == 3.0 else 1


@pytest.mark.parametrize("chunk_size", [5, 12])
def test_mended_points_may_have_another_type(chunk_size: int, tmp_path: Path) -> None:
    flag = tmp_path / "flag"
    options: dict[str, Any] = {"chunk_size": chunk_size, "folder": tmp_path / "x"}
    options["arguments"] = {"flag": str(flag)}
    with pytest.raises(bd.SweepFailedError) as failure:
        swept(later, **options)
    assert failure.value.result is not None and failure.value.result.values.dtype == np.int64
    flag.touch()
    mended = swept(later, **options)
    assert mended.values[:, 0].tolist() == [1.0, 1.0, 0.5, 1.0]
    assert bd.read_sweep(tmp_path / "x").values.tobytes() == mended.values.tobytes()


def test_the_type_that_holds_all_does_not_depend_on_their_order() -> None:
    names = ("i1", "i8", "u1", "u4", "u8", "f2", "f4", "f8", "c8", "c16", "?", "U3", "U1")
    kinds = [np.dtype(name) for name in names]
    for three in itertools.product(kinds, repeat=3):
        found = set()
        for one, other, last in itertools.permutations(three):
            both = joined(one, other)
            found.add(joined(both, last) if both is not None else None)
        assert len(found) == 1, (three, found)


def waves(a: Any, b: Any) -> Any:
    return {"wave": a + 1j * b, "half": np.float16(a), "is_large": a > 2.0, "count": np.arange(len(a))}


def test_complex_results_are_stored_in_two_parts(tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    result = swept(waves, pointwise=False)
    assert result.to_xarray()["wave"].dtype == np.complex128
    result.to_netcdf(tmp_path / "waves.nc")
    with xarray.open_dataset(tmp_path / "waves.nc") as stored:
        assert np.array_equal(stored["wave_real"] + 1j * stored["wave_imag"], result["wave"])
        for name in ("half", "is_large"):
            assert np.array_equal(stored[name], result[name])
        assert list(stored.coords) == ["a", "b"]
    axis = bd.sweep(lambda z: abs(z), {"z": np.array([1j, 3 + 4j])}, "serial")
    axis.to_netcdf(tmp_path / "axis.nc", "modulus")
    with xarray.open_dataset(tmp_path / "axis.nc") as stored:
        assert stored["modulus"].values.tolist() == [1.0, 5.0] and stored["modulus"].dims == ("z",)
        assert (stored["z_real"] + 1j * stored["z_imag"]).values.tolist() == [1j, 3 + 4j]
        assert set(stored.coords) == {"z_real", "z_imag"}


def test_what_netcdf_does_not_have_is_refused_before_a_file(tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    long = swept(lambda a, b: np.longdouble(a))
    if long.values.dtype.itemsize > 8:
        with pytest.raises(bd.InvalidError, match="float128") as refused:
            long.to_netcdf(tmp_path / "long.nc", "long")
        assert refused.value.kind == "netcdf-type"
    doubled = swept(lambda a, b: {"x": 1j, "x_real": 1.0})
    with pytest.raises(bd.InvalidError, match="x_real"):
        doubled.to_netcdf(tmp_path / "doubled.nc")
    assert not list(tmp_path.iterdir())
