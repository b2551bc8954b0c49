"""Sweeps in this process: results, types, failures, and what is refused."""

from __future__ import annotations

import pickle
from concurrent import futures
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sweep_functions as functions

import bouncing_disk as bd

GRID = {"a": [1.0, 2.0, 3.0, 4.0], "b": [10.0, 20.0, 30.0]}
A, B = (axis.ravel() for axis in np.meshgrid(GRID["a"], GRID["b"], indexing="ij"))


def serial(function: Any, grid: Any = GRID, **options: Any) -> bd.SweepResult:
    return bd.sweep(function, grid, "serial", **options)


@pytest.mark.parametrize("chunk_size", [None, 1, 2, 5, 12, 13, 10**9])
def test_chunks_change_nothing(chunk_size: int | None) -> None:
    result = serial(functions.product, chunk_size=chunk_size)
    assert result.values.shape == (4, 3)
    assert np.array_equal(result.values, np.outer(GRID["a"], GRID["b"]))
    assert not result.failed.any()
    assert list(result.axes) == ["a", "b"] and result.function == "sweep_functions.product"
    assert np.array_equal(np.asarray(result), result.values)
    assert result[1, 2] == 60.0


@pytest.mark.parametrize(
    ("function", "pointwise"), [(functions.fields, False), (functions.point_fields, True)]
)
def test_mappings_become_fields(function: Any, pointwise: bool) -> None:
    result = serial(function, pointwise=pointwise, chunk_size=5)
    assert result.values.dtype == np.dtype([("sum", "f8"), ("pair", "f8", (2,)), ("count", "i2")])
    assert np.array_equal(result["sum"].ravel(), A + B)
    assert result["pair"].shape == (4, 3, 2)
    assert np.array_equal(result["pair"][2, 1], [3.0, 20.0])


def test_points_may_have_arrays() -> None:
    result = serial(lambda a, b: [a, b, a - b], pointwise=True)
    assert result.values.shape == (4, 3, 3)
    assert np.array_equal(result.values[3, 0], [4.0, 10.0, -6.0])


def test_arguments_are_handed_on() -> None:
    assert serial(functions.scaled, arguments={"factor": 0.5}).values[0, 0] == 5.0
    with pytest.raises(TypeError, match="'a' is an axis"):
        serial(functions.scaled, arguments={"a": 1.0})


def test_an_empty_axis_has_no_points() -> None:
    calls: list[Any] = []
    axes: list[Any] = [[], np.empty(0)]
    for axis in axes:
        result = bd.sweep(lambda **point: calls.append(point), {"a": [1.0, 2.0], "b": axis})
        assert result.values.shape == (2, 0) and not calls
    told: list[tuple[int, int]] = []
    serial(functions.product, {"a": [], "b": [1.0]}, progress=lambda done, total: told.append((done, total)))
    assert told == [(0, 0)]


def test_one_point() -> None:
    assert serial(functions.product, {"a": [3.0], "b": [-0.0]}).values.tolist() == [[-0.0]]


@pytest.mark.parametrize(
    "axis",
    [np.arange(3), np.array([True, False]), np.array(["x", "yy"]), np.array([1e308, 5e-324, np.inf, np.nan])],
)
def test_axes_of_many_types(axis: Any) -> None:
    result = bd.sweep(lambda a: a, {"a": axis}, "serial")
    assert result.values.dtype == axis.dtype
    assert result.values.tobytes() == axis.tobytes()
    # As the caller's array changes, the result does not.
    assert not np.shares_memory(result.axes["a"], axis)


def test_axes_that_are_refused() -> None:
    for grid, kind in [
        ({}, "no-axis"),
        ({"a b": [1.0]}, "axis-name"),
        ({3: [1.0]}, "axis-name"),
        ({"a": 1.0}, "axis-shape"),
        ({"a": [[1.0]]}, "axis-shape"),
        ({"a": [object()]}, "axis-type"),
        ({"a": np.array(["2020-01-01"], dtype="M8[D]")}, "axis-type"),
    ]:
        with pytest.raises(bd.InvalidError) as refusal:
            serial(functions.product, grid)
        assert refusal.value.kind == kind
    with pytest.raises(TypeError, match="mapping"):
        serial(functions.product, [("a", [1.0])])
    with pytest.raises(bd.TooLargeError, match="points"):
        serial(functions.product, {name: np.arange(1_000_000) for name in "abc"})
    with pytest.raises(bd.TooLargeError, match="chunks"):
        serial(functions.product, {"a": np.arange(10_000), "b": np.arange(10_000)}, chunk_size=1)


def test_a_chunk_has_a_whole_number_of_points() -> None:
    for size in (0, -1):
        with pytest.raises(bd.OutOfRangeError) as refusal:
            serial(functions.product, chunk_size=size)
        assert (refusal.value.field, refusal.value.value) == ("chunk_size", size)
    for none in (2.0, True):
        with pytest.raises(TypeError, match="chunk_size"):
            serial(functions.product, chunk_size=none)


def test_what_is_no_function_or_client_is_refused(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match="callable"):
        serial(3.0)
    with futures.ThreadPoolExecutor(1) as threads:
        for client in (4, "parallel", b"serial", np.array([1]), threads, object):
            with pytest.raises(TypeError, match="client must be"):
                bd.sweep(functions.product, GRID, client, folder=tmp_path / "x")
    assert not list(tmp_path.iterdir())
    with pytest.raises(bd.OutOfRangeError, match="max_failures"):
        serial(functions.product, max_failures=-1)


def test_not_a_number_is_a_result() -> None:
    result = serial(functions.nothing_or_ratio, {"a": [0.0, 1.0], "b": [0.0, 2.0]})
    assert np.isnan(result.values[0, 0]) and result.values[1, 0] == np.inf and result.values[1, 1] == 0.5
    assert not result.failed.any()


@pytest.mark.parametrize("pointwise", [False, True])
@pytest.mark.parametrize("chunk_size", [1, 4, 100])
def test_a_failed_point_is_named_and_the_others_kept(pointwise: bool, chunk_size: int) -> None:
    with pytest.raises(bd.SweepFailedError) as failure:
        serial(functions.refuses_three, pointwise=pointwise, chunk_size=chunk_size)
    (point,) = failure.value.failures
    assert point.place == (2, 1) and point.values == {"a": 3.0, "b": 20.0}
    assert (point.error, point.message) == ("ValueError", "three and twenty")
    assert "refuses_three" in point.traceback
    message = "the function failed at 1 point: a = 3.0, b = 20.0: ValueError: three and twenty"
    assert str(failure.value) == message
    result = failure.value.result
    assert result is not None and result.failed.sum() == 1 and result.failed[2, 1]
    assert np.isnan(result.values[2, 1])
    expected = np.outer(GRID["a"], GRID["b"])
    assert np.array_equal(result.values[~result.failed], expected[~result.failed])
    again = pickle.loads(pickle.dumps(failure.value))
    assert str(again) == str(failure.value) and again.failures == failure.value.failures


def test_a_function_that_always_fails_is_given_up() -> None:
    with pytest.raises(bd.SweepFailedError, match="given up.*4 points.*and 1 more") as failure:
        serial(functions.always_refuses, chunk_size=2, max_failures=3)
    assert failure.value.result is None and len(failure.value.failures) == 4
    with pytest.raises(bd.SweepFailedError) as failure:
        serial(functions.always_refuses, chunk_size=2, max_failures=12)
    result = failure.value.result
    assert result is not None and result.failed.all() and np.isnan(result.values).all()


def test_a_function_that_ends_the_process_does_not() -> None:
    with pytest.raises(bd.SweepFailedError, match="SystemExit"):
        serial(functions.leaves)


def test_what_does_not_fit_is_refused_by_name() -> None:
    for function, message in [
        (functions.branches, "fails for 12 points .*pointwise=True"),
        (functions.wrong_length, r"shape \(13,\) for 12 points"),
        (lambda a, b: [object()] * len(a), "no array of numbers"),
        (lambda a, b: {}, "empty mapping"),
        (lambda a, b: 1.0, r"shape \(\) for 12 points"),
        (lambda a, b: [[1.0], [1.0, 2.0]], "no array"),
    ]:
        with pytest.raises(bd.SweepFunctionError, match=message):
            serial(function, chunk_size=12)


def test_progress_counts_and_stops() -> None:
    told: list[tuple[int, int]] = []
    serial(functions.product, chunk_size=5, progress=lambda done, total: told.append((done, total)))
    assert told == [(0, 12), (5, 12), (10, 12), (12, 12)]

    def stop(done: int, total: int) -> None:
        if done:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        serial(functions.product, chunk_size=5, progress=stop)


def test_the_result_says_what_it_is() -> None:
    result = serial(functions.product)
    assert repr(result) == "SweepResult(sweep_functions.product over a[4] x b[3]: float64 array (4, 3))"
    copy = pickle.loads(pickle.dumps(result))
    assert np.array_equal(copy.values, result.values)


def test_datasets_and_netcdf(tmp_path: Any) -> None:
    xarray = pytest.importorskip("xarray")
    result = serial(functions.fields, arguments={})
    dataset = result.to_xarray()
    assert dataset["sum"].sel(a=2.0, b=30.0) == 32.0
    assert dataset["pair"].dims == ("a", "b", "pair_0")
    assert dataset.attrs["function"] == "sweep_functions.fields"
    path = tmp_path / "sums.nc"
    result.to_netcdf(path)
    with xarray.open_dataset(path) as stored:
        assert np.array_equal(stored["sum"].values, result["sum"])
        assert np.array_equal(stored["a"].values, GRID["a"])
    assert [item.name for item in tmp_path.iterdir()] == ["sums.nc"]
    assert serial(functions.product).to_xarray("area")["area"].shape == (4, 3)
    assert list(bd.sweep(lambda a, b: a, GRID, "serial").to_xarray()) == ["result"]
    with pytest.raises(bd.InvalidError, match="is an axis and a result"):
        serial(functions.product).to_xarray("a")
    with pytest.raises(bd.InvalidError, match="not needed"):
        result.to_xarray("area")


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(bd.MissingDependencyError) as missing:
        serial(functions.product).to_xarray()
    assert missing.value.package == "xarray"
    assert missing.value.install == "pip install 'bouncing-disk[netcdf]'"


def test_a_missing_writer_of_netcdf_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Any) -> None:
    pytest.importorskip("xarray")
    # Newer h5netcdf comes without the h5py that it writes by.
    for package in ("netCDF4", "h5py", "scipy"):
        monkeypatch.setitem(__import__("sys").modules, package, None)
    with pytest.raises(bd.MissingDependencyError) as missing:
        serial(functions.product).to_netcdf(tmp_path / "sums.nc")
    assert missing.value.package == "netCDF4" and not list(tmp_path.iterdir())


def test_without_dask_it_computes_in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    assert np.array_equal(bd.sweep(functions.product, GRID).values, np.outer(GRID["a"], GRID["b"]))
