"""A function at every point of a grid: the values, the journal, failures, and a cluster."""

from __future__ import annotations

import functools
import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd

xarray = pytest.importorskip("xarray")

AXES: dict[str, Any] = {"a": [1.0, 2.0, 3.0, 4.0], "b": [10.0, 20.0, 30.0]}
PRODUCTS = np.outer(AXES["a"], AXES["b"])
CHUNKS = [None, 1, 5, 12, 100]


def product(a: Any, b: Any) -> Any:
    return a * b


def several(a: Any, b: Any) -> dict[str, Any]:
    return {"sum": a + b, "pair": np.stack([a, b], -1), "wave": a + 1j * b, "name": np.where(a > b / 9, "more", "no")}


def counted(a: Any, b: Any, log: str, seconds: float = 0.0) -> Any:
    """Notes each point, so that a test knows what was computed, and by whom."""
    time.sleep(seconds)
    with open(log, "a", encoding="utf-8") as file:
        file.writelines(f"{os.getpid()} {own} {other}\n" for own, other in np.broadcast(a, b))
    return a * b


def refuses(a: Any, b: Any, flag: str = "") -> Any:
    if not os.path.exists(flag) and np.any((np.asarray(a) == 3.0) & (np.asarray(b) == 20.0)):
        raise ValueError("three and twenty")
    return a * b


def last_speed(axial_forcing: Any, restitution: Any) -> Any:
    """Of chaotic orbits, in which a changed bit would show."""
    diagram = bd.orbit_diagram(
        axial_forcing=axial_forcing, restitution=restitution, impact_phase=0.8, normalised_speed=1.3, recorded=1
    )
    return {"speed": diagram.normalised_speed, "process": np.full(len(axial_forcing), os.getpid())}


class Scaled:
    """Something with a method."""

    def times(self, a: Any, b: Any) -> Any:
        return a * b


def refusal(kind: str, call: Callable[[], Any], message: str = "") -> None:
    with pytest.raises(bd.SweepJournalError, match=message) as refused:
        call()
    assert refused.value.kind == kind, refused.value


@pytest.mark.parametrize("chunk", CHUNKS)
def test_each_value_is_in_its_cell(chunk: int | None) -> None:
    told: list[tuple[int, int]] = []
    found = bd.sweep(product, AXES, chunk=chunk, progress=lambda done, total: told.append((done, total)))
    assert found.result.dims == ("a", "b") and found.result.sel(a=2.0, b=30.0) == 60.0
    xarray.testing.assert_equal(found.coords.to_dataset(), xarray.Dataset(coords=AXES))
    assert np.array_equal(found.result, PRODUCTS) and told[0] == (0, 12) and told[-1] == (12, 12)


@pytest.mark.parametrize("journal", [False, True])
@pytest.mark.parametrize("chunk", CHUNKS)
def test_several_results_and_arrays(chunk: int | None, journal: bool, tmp_path: Path) -> None:
    axes: dict[str, Any] = {"a": [1, 2, 3, 4], "b": [10.0, np.nan, -0.0]}
    for _ in range(2):
        found = bd.sweep(several, axes, chunk=chunk, journal=tmp_path / "journal" if journal else None)
        a, b = np.meshgrid(axes["a"], axes["b"], indexing="ij")
        assert found["sum"].values.tobytes() == (a + b).tobytes()
        assert found["pair"].dims == ("a", "b", "pair_0") and np.array_equal(found["pair"][..., 1], b, equal_nan=True)
        assert found["wave"].dtype == complex and found["name"].values.tolist()[1] == ["more", "no", "more"]


def test_integers_and_floats_are_floats() -> None:
    assert bd.sweep(lambda a, b: 1 if a < 2 else 0.5, AXES).result.values[:2, 0].tolist() == [1.0, 0.5]


def test_results_of_this_package_are_named(tmp_path: Path) -> None:
    pizza = bd.System.pizza_toss()
    tosses = bd.sweep(lambda friction: bd.single_toss(pizza.replace(friction=friction)), {"friction": [0.05, 0.6]})
    assert tosses.airborne_speed[1] == bd.single_toss(pizza).airborne_speed and tosses.energy.shape == (2, 8)
    axes = {"axial_forcing": np.linspace(0.015, 2.985, 100), "restitution": np.linspace(0.005, 0.945, 100)}
    starts: dict[str, Any] = {"impact_phase": 0.0, "normalised_speed": 1.3, "transient": 300, "impacts": 600}
    found = bd.sweep(bd.verdicts, axes, arguments=starts, chunk=1_500, journal=tmp_path / "journal")
    forcings, restitutions = (axis.ravel() for axis in np.meshgrid(*axes.values(), indexing="ij"))
    alone = bd.verdicts(axial_forcing=forcings, restitution=restitutions, **starts)
    assert np.array_equal(found.kind.values.ravel(), alone.kind) and found.kind.dtype == np.uint8
    assert found.multipliers.dims == ("axial_forcing", "restitution", "multipliers_0")
    # Below 1/pi the platform never falls away; below the birth of the period-1 orbit, too, the disk comes to rest.
    weak = forcings < np.minimum(1.0 / np.pi, (1.0 - restitutions) / (1.0 + restitutions))
    assert (alone.kind[weak] == bd.Verdicts.KINDS.index("at-rest")).mean() > 0.99 and len(np.unique(alone.kind)) >= 4


def test_what_is_no_grid_or_client_is_refused() -> None:
    refused: list[Any] = [1.0, [[1.0]], [], [object()], [1j], np.ma.array([1], mask=[True])]
    for axes in [{}, *({"a": axis} for axis in refused)]:
        with pytest.raises(bd.InvalidError, match="axis"):
            bd.sweep(product, axes)
    with pytest.raises(bd.OutOfRangeError, match="chunk is 0"):
        bd.sweep(product, AXES, chunk=0)
    with pytest.raises(TypeError, match="client must be a distributed.Client or None, not str"):
        bd.sweep(product, AXES, "serial")


@pytest.mark.parametrize("missing", ["xarray", "distributed"])
def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch, missing: str) -> None:
    monkeypatch.setitem(sys.modules, missing, None)
    with pytest.raises(bd.MissingDependencyError, match=r"needs .*pip install 'bouncing-disk\[sweep\]'") as refused:
        bd.sweep(product, AXES, object())
    assert refused.value.package == missing


@pytest.mark.parametrize("chunk", [None, 5])
def test_a_sweep_that_was_stopped_computes_nothing_twice(chunk: int | None, tmp_path: Path) -> None:
    log, journal = tmp_path / "log", tmp_path / "journal"
    told: list[int] = []

    def swept(stop: int) -> Any:
        def progress(done: int, total: int) -> None:
            told.append(done)
            if done >= stop:
                raise KeyboardInterrupt

        return bd.sweep(counted, AXES, arguments={"log": str(log)}, chunk=chunk, journal=journal, progress=progress)

    for stop in (3, 7):
        with pytest.raises(KeyboardInterrupt):
            swept(stop)
    for _ in range(2):
        assert np.array_equal(swept(13).result, PRODUCTS)
    assert log.read_text().count("\n") == 12 and told[-1] == 12


def test_a_half_written_record_is_dropped(tmp_path: Path) -> None:
    log, journal = tmp_path / "log", tmp_path / "journal"
    swept = functools.partial(bd.sweep, counted, AXES, arguments={"log": str(log)}, chunk=5, journal=journal)
    swept()
    whole = journal.read_bytes()
    for cut, computed in [(len(whole) - 1, 2), (len(whole) - 20, 2), (10, 12), (0, 12)]:
        log.unlink()
        journal.write_bytes(whole[:cut])
        assert np.array_equal(swept().result, PRODUCTS) and journal.read_bytes() == whole
        assert log.read_text().count("\n") == computed


@pytest.mark.skipif(sys.platform == "win32", reason="files are not locked there")
def test_a_journal_in_use_is_refused(tmp_path: Path) -> None:
    swept = functools.partial(bd.sweep, product, AXES, chunk=5, journal=tmp_path / "journal")
    swept(progress=lambda done, total: refusal("in-use", swept, "in use by another sweep"))


def test_files_that_are_no_journal_are_refused_and_kept(tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    swept = functools.partial(bd.sweep, product, AXES, chunk=5, journal=journal)
    swept()
    whole = journal.read_bytes()
    changed = whole.replace(b"60.0", b"61.0")
    for content, kind, message in [
        (changed, "damaged", "damaged line 3"),
        (b"Introduction", "not-a-journal", "not the journal of a sweep"),
        (b"Introduction\n", "not-a-journal", "not the journal of a sweep"),
    ]:
        journal.write_bytes(content)
        refusal(kind, swept, message)
        assert journal.read_bytes() == content
    refusal("cannot-write", functools.partial(bd.sweep, product, AXES, journal=tmp_path), "cannot be opened")


@pytest.mark.skipif(sys.platform == "win32", reason="limits of POSIX")
def test_a_full_disk_keeps_what_was_written(tmp_path: Path) -> None:
    resource = pytest.importorskip("resource")
    swept = functools.partial(bd.sweep, product, AXES, chunk=5)
    swept(journal=tmp_path / "whole")
    whole, limits = (tmp_path / "whole").read_bytes(), resource.getrlimit(resource.RLIMIT_FSIZE)
    try:
        # In the middle of the last record.
        resource.setrlimit(resource.RLIMIT_FSIZE, (len(whole) - 20, limits[1]))
        refusal("cannot-write", functools.partial(swept, journal=tmp_path / "journal"), "cannot be written: File too large")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert (tmp_path / "journal").read_bytes() == whole[:-20]
    assert np.array_equal(swept(journal=tmp_path / "journal").result, PRODUCTS)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"function": product}, "function is 'test_sweep.refuses' there, 'test_sweep.product' here"),
        ({"axes": {**AXES, "b": [10.0, 20.0, 30.000001]}}, "axes.b.2 is 30.0 there, 30.000001 here"),
        ({"axes": {**AXES, "b": np.array(AXES["b"], "f")}}, "types.b is '<f8' there, '<f4' here"),
        ({"axes": {**AXES, "b": [10.0]}}, r"axes.b is \[10.0, 20.0, 30.0\] there, \[10.0\] here"),
        ({"axes": {"b": AXES["b"], "a": AXES["a"]}}, "axes is {'a'.* there, {'a'"),
        ({"arguments": {"flag": "y"}}, "arguments.flag is 'x' there, 'y' here"),
        ({"arguments": {"flag": bd.System.motor()}}, "arguments.flag is 'x' there, {'System'"),
        ({"chunk": 4}, "chunk is 5 there, 4 here"),
        ("bouncing_disk._sweep.native.VERSION", "version is '.*' there, 'another' here"),
        ("inspect.getsource", "source is .* there, 'another' here"),
    ],
)
def test_the_journal_of_another_sweep_is_refused(
    change: Any, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    journal = tmp_path / "journal"
    flag = tmp_path / "x"
    monkeypatch.chdir(tmp_path)
    flag.touch()
    given: dict[str, Any] = {"function": refuses, "axes": AXES, "arguments": {"flag": "x"}, "chunk": 5, "journal": journal}
    bd.sweep(**given)
    whole = journal.read_bytes()
    if isinstance(change, str):
        monkeypatch.setattr(change, "another" if change.endswith("VERSION") else lambda function: "another")
    refusal("another-sweep", lambda: bd.sweep(**{**given, **({} if isinstance(change, str) else change)}), message)
    assert journal.read_bytes() == whole


def test_functions_and_arguments_that_cannot_be_recognised_need_no_journal(tmp_path: Path) -> None:
    journal = tmp_path / "journal"

    def inner(a: Any, b: Any) -> Any:
        return a * b

    for function in (lambda a, b: a * b, inner, functools.partial(product), Scaled().times):
        with pytest.raises(bd.InvalidError, match="top of a module or notebook"):
            bd.sweep(function, AXES, journal=journal)
        assert np.array_equal(bd.sweep(function, AXES).result, PRODUCTS)
    with pytest.raises(TypeError, match="cannot recognise a object"):
        bd.sweep(refuses, AXES, arguments={"flag": object()}, journal=journal)
    assert not journal.exists()


@pytest.mark.parametrize("chunk", CHUNKS)
def test_a_failed_point_is_named_and_the_others_kept(chunk: int | None, tmp_path: Path) -> None:
    flag, journal = tmp_path / "flag", tmp_path / "journal"
    swept = functools.partial(bd.sweep, refuses, AXES, arguments={"flag": str(flag)}, chunk=chunk, journal=journal)
    with pytest.raises(bd.SweepFailedError, match=r"failed: a = 3.0, b = 20.0: ValueError: three and twenty$") as failed:
        swept()
    (point,) = failed.value.failures
    assert point.values == {"a": 3.0, "b": 20.0} and "in refuses" in point.traceback
    again = pickle.loads(pickle.dumps(failed.value))
    assert str(again) == str(failed.value) and again.failures == failed.value.failures
    flag.touch()
    told: list[int] = []
    assert np.array_equal(swept(progress=lambda done, total: told.append(done)).result, PRODUCTS)
    assert told == [12 - min(chunk or 1, 12), 12]


def test_results_that_do_not_fit_name_their_point() -> None:
    functions: list[tuple[Any, int | None, str]] = [
        (lambda a, b: a if a > b else b, 12, "a = 1.0, b = 10.0: for 12 points .* none of them alone: ValueError: The truth"),
        (lambda a, b: np.zeros(13), 12, r"result has the shape \(13,\)"),
        (lambda a, b: object(), None, "result is of type object"),
        (lambda a, b: {"a": 1.0}, None, "a is the name of an axis and of a result"),
        (lambda a, b: "text" if a == 2.0 else 1.0, None, "a = 2.0, b = 10.0: TypeError: returned .*texts.*numbers"),
        (lambda a, b: {"x": 1.0} if a >= 2.0 else 1.0, None, "a = 2.0, b = 10.0.*; and 6 more"),
    ]
    for function, chunk, message in functions:
        with pytest.raises(bd.SweepFailedError, match=message):
            bd.sweep(function, AXES, chunk=chunk)
    with pytest.raises(bd.SweepFailedError) as failed:
        bd.sweep(lambda a: 1 / 0, {"a": np.arange(1_000)})
    assert len(failed.value.failures) == 100


def test_a_cluster_gives_the_same_bits(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    axes = {"axial_forcing": np.linspace(0.45, 2.5, 12), "restitution": np.linspace(0.3, 0.7, 4)}
    here = bd.sweep(last_speed, axes, chunk=7)
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        found = bd.sweep(last_speed, axes, client, chunk=5, journal=tmp_path / "bits")
        assert found.speed.values.tobytes() == here.speed.values.tobytes() and len(np.unique(found.speed)) > 20
        assert os.getpid() not in found.process and bd.sweep(last_speed, axes, chunk=5, journal=tmp_path / "bits").equals(found)
        with pytest.raises(bd.SweepFailedError, match="failed: a = 3.0, b = 20.0: ValueError"):
            bd.sweep(refuses, AXES, client, chunk=5)
        with pytest.raises(TypeError, match="not LocalCluster"):
            bd.sweep(product, AXES, cluster)
        log, journal = tmp_path / "log", tmp_path / "journal"
        given: dict[str, Any] = {"arguments": {"log": str(log), "seconds": 0.1}, "journal": journal}

        def kill_and_stop(done: int, total: int) -> None:
            if done == 2:
                os.kill(next(iter(cluster.workers.values())).pid, signal.SIGTERM)
            if done == 7:
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            bd.sweep(counted, AXES, client, **given, progress=kill_and_stop)
        kept = journal.read_text().count("\n") - 1
        assert kept == 7 and np.array_equal(bd.sweep(counted, AXES, client, **given).result, PRODUCTS)
        client.run(setattr, bd._native, "VERSION", "another")
        with pytest.raises(bd.SweepFailedError, match="the worker has bouncing-disk another, and the caller"):
            bd.sweep(product, AXES, client)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGKILL])
def test_an_ended_process_leaves_its_journal(sent: signal.Signals, tmp_path: Path) -> None:
    log, journal = tmp_path / "log", tmp_path / "journal"
    given = f'arguments={{"log": {str(log)!r}, "seconds": 0.05}}, journal={str(journal)!r}'
    program = f"import bouncing_disk as bd, test_sweep as t; bd.sweep(t.counted, t.AXES, {given})"
    with subprocess.Popen([sys.executable, "-c", program], cwd=Path(__file__).parent, stderr=subprocess.PIPE) as process:
        while not journal.exists() or journal.read_text().count("\n") < 4:
            assert process.poll() is None
            time.sleep(0.01)
        process.send_signal(sent)
        assert process.wait(30) != 0
    arguments = {"log": str(log), "seconds": 0.05}
    assert np.array_equal(bd.sweep(counted, AXES, arguments=arguments, journal=journal).result, PRODUCTS)
    # The point at which it was ended may be computed again, and no other.
    assert 12 <= log.read_text().count("\n") <= 13


def test_netcdf_keeps_what_was_computed(tmp_path: Path) -> None:
    pytest.importorskip("netCDF4")
    found = bd.sweep(several, AXES, chunk=5).drop_vars("wave")
    found.to_netcdf(tmp_path / "found.nc")
    with xarray.open_dataset(tmp_path / "found.nc") as stored:
        xarray.testing.assert_identical(stored.load(), found)
        assert stored.program == f"bouncing-disk {bd.__version__}"
