"""The folder of a sweep: resumed, refused, damaged, locked, interrupted."""

from __future__ import annotations

import functools
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sweep_functions as functions

import bouncing_disk as bd
from bouncing_disk._sweep.folder import VERSIONS

GRID = {"a": [1.0, 2.0, 3.0, 4.0], "b": [10.0, 20.0, 30.0]}
EXPECTED = np.add.outer(GRID["a"], GRID["b"])


def swept(folder: Path, log: Path, **options: Any) -> bd.SweepResult:
    options = {"chunk_size": 5, "arguments": {"log": str(log)}, **options}
    return bd.sweep(functions.counted, options.pop("grid", GRID), "serial", folder=folder, **options)


def product(folder: Path | str, function: Callable[..., Any] = functions.product) -> bd.SweepResult:
    return bd.sweep(function, GRID, "serial", folder=folder)


def assert_refused(kind: str, call: Callable[[], Any], message: str = ".*") -> None:
    with pytest.raises(bd.SweepFolderError, match=message) as refusal:
        call()
    assert refusal.value.kind == kind, refusal.value


def content_of(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def calls(log: Path) -> list[int]:
    return [int(line) for line in log.read_text().split()] if log.exists() else []


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "a" / "sweep"


@pytest.fixture
def log(tmp_path: Path) -> Path:
    return tmp_path / "log"


def test_what_is_stored_is_not_computed_again(folder: Path, log: Path) -> None:
    first = swept(folder, log)
    assert np.array_equal(first.values, EXPECTED) and calls(log) == [5, 5, 2]
    assert sorted(path.name for path in folder.iterdir()) == [
        "axes.npz", "chunk-000000.npz", "chunk-000001.npz", "chunk-000002.npz", "sweep.json", "sweep.lock"
    ]  # fmt: skip
    before = content_of(folder)
    told: list[int] = []
    again = swept(folder, log, progress=lambda done, total: told.append(done))
    assert calls(log) == [5, 5, 2] and told == [12]
    assert again.values.tobytes() == first.values.tobytes()
    assert content_of(folder) == before
    (folder / "chunk-000001.npz").unlink()
    assert np.array_equal(swept(folder, log).values, EXPECTED)
    assert calls(log) == [5, 5, 2, 5]


def test_a_chunk_says_what_it_is(folder: Path, log: Path) -> None:
    swept(folder, log)
    with np.load(folder / "chunk-000001.npz") as chunk:
        about = json.loads(str(chunk["about"]))
        assert chunk["values"].tolist() == EXPECTED.ravel()[5:10].tolist()
    assert about["function"] == "sweep_functions.counted" and about["chunk"] == 1
    assert (about["first_point"], about["last_point"]) == (5, 9)
    assert about["grid"]["a"]["count"] == 4 and about["program"]["version"]
    assert about["digest"] == json.loads((folder / "sweep.json").read_text())["digest"]


def edited(content: bytes) -> bytes:
    place = content.index(b"\x93NUMPY", content.index(b"values.npy"))
    place = content.index(b"\n", place) + 3
    return content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :]


@pytest.mark.parametrize(
    "damage",
    [
        lambda content: b"",
        lambda content: content[: len(content) // 2],
        lambda content: content[:-1],
        edited,
        lambda content: b"something else",
        lambda content: bytes(len(content)),
    ],
    ids=["empty", "half", "last byte", "one bit", "text", "zeros"],
)
def test_a_damaged_chunk_is_told_and_computed_again(folder: Path, log: Path, damage: Any) -> None:
    swept(folder, log)
    chunk = folder / "chunk-000001.npz"
    sound = chunk.read_bytes()
    chunk.write_bytes(damage(sound))
    assert_refused("damaged", lambda: bd.read_sweep(folder), r"chunk-000001\.npz")
    with pytest.warns(bd.SweepFolderWarning, match=r"chunk-000001\.npz.*computed again"):
        assert np.array_equal(swept(folder, log).values, EXPECTED)
    assert calls(log) == [5, 5, 2, 5]
    assert chunk.read_bytes() == sound


def test_a_chunk_with_new_values_and_an_old_digest_is_noticed(folder: Path, log: Path) -> None:
    """As by a program that writes archives: every sum of the archive itself is right."""
    swept(folder, log)
    chunk = folder / "chunk-000001.npz"
    for name in ("values", "failed", "about"):
        with np.load(chunk) as archive:
            members = {member: archive[member] for member in archive.files}
        sound = chunk.read_bytes()
        if name == "about":
            members[name] = np.array(str(members[name]).replace('"chunk": 1', '"chunk": 2'))
        else:
            members[name] = np.append(members[name], members[name].dtype.type(7))
        np.savez(chunk, **members)
        with pytest.warns(bd.SweepFolderWarning, match="changed"):
            swept(folder, log)
        assert chunk.read_bytes() == sound


def test_a_folder_in_the_place_of_a_chunk(folder: Path, log: Path) -> None:
    swept(folder, log)
    (folder / "chunk-000000.npz").unlink()
    (folder / "chunk-000000.npz").mkdir()
    with pytest.warns(bd.SweepFolderWarning, match="not a file"):
        assert_refused("cannot-write", lambda: swept(folder, log))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"grid": {**GRID, "b": [10.0, 20.0, 30.000001]}}, "grid.b.last is '30.0' there"),
        ({"grid": {**GRID, "a": [1.0, 2.5, 3.0, 4.0]}}, "the values of grid.a differ"),
        ({"grid": {"b": GRID["b"], "a": GRID["a"]}}, "the axes are a, b there, b, a here"),
        ({"chunk_size": 4}, "chunk_size is 5 there, 4 here"),
        ({"arguments": {"log": "/dev/null"}}, "arguments.log is "),
    ],
)
def test_the_folder_of_another_sweep_is_refused(folder: Path, log: Path, change: Any, message: str) -> None:
    swept(folder, log)
    before = content_of(folder)
    message = "holds another sweep.*" + re.escape(message)
    assert_refused("another-sweep", lambda: swept(folder, log, **change), message)
    assert content_of(folder) == before


def test_another_function_source_or_version_is_refused(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    product(folder)
    with pytest.raises(bd.SweepFolderError, match="function is 'sweep_functions.product' there"):
        product(folder, functions.nothing_or_ratio)
    with monkeypatch.context() as patch:
        patch.setitem(VERSIONS, "bouncing-disk", "9.9.9")
        with pytest.raises(bd.SweepFolderError, match="program.version is .* there, '9.9.9' here"):
            product(folder)
    monkeypatch.setattr("inspect.getsource", lambda function: "def product(a, b): return a + b")
    with pytest.raises(bd.SweepFolderError, match="the source text of the function was changed"):
        product(folder)


def test_foreign_and_misplaced_chunks_are_refused(tmp_path: Path, folder: Path, log: Path) -> None:
    swept(folder, log)
    readers: list[Callable[[], Any]] = [lambda: swept(folder, log), lambda: bd.read_sweep(folder)]
    other = tmp_path / "other"
    bd.sweep(functions.product, GRID, "serial", folder=other, chunk_size=5)
    for source, message in [
        (other / "chunk-000001.npz", "chunk of another sweep"),
        (folder / "chunk-000000.npz", "is chunk 0, not 1"),
    ]:
        shutil.copy(source, folder / "chunk-000001.npz")
        for read in readers:
            assert_refused("foreign-chunk", read, message)


def test_other_files_and_descriptions_that_are_none(folder: Path, log: Path) -> None:
    folder.mkdir(parents=True)
    (folder / "thesis.tex").write_text("Introduction")
    assert_refused("other-files", lambda: swept(folder, log), r"thesis\.tex")
    (folder / "thesis.tex").unlink()
    swept(folder, log)
    readers: list[Callable[[], Any]] = [lambda: swept(folder, log), lambda: bd.read_sweep(folder)]
    described = (folder / "sweep.json").read_text()
    for text, kind in [
        (described[:100], "damaged"),
        ("", "damaged"),
        ("[]", "damaged"),
        (described.replace('"points": 12', '"points": 13'), "damaged"),
        (described.replace('"version": 1', '"version": 2'), "newer-format"),
        (described.replace("bouncing-disk sweep", "another"), "damaged"),
        ("[" * 100_000, "damaged"),
    ]:
        (folder / "sweep.json").write_text(text)
        for read in readers:
            assert_refused(kind, read)
    assert calls(log) == [5, 5, 2]


def test_reading_without_the_function(folder: Path, log: Path, tmp_path: Path) -> None:
    assert_refused("not-a-sweep", lambda: bd.read_sweep(tmp_path))
    result = swept(folder, log)
    again = bd.read_sweep(folder)
    assert again.values.tobytes() == result.values.tobytes() and again.function == result.function
    assert {name: axis.tolist() for name, axis in again.axes.items()} == GRID
    (folder / "chunk-000002.npz").unlink()
    assert_refused("incomplete", lambda: bd.read_sweep(folder), "1 of 3 chunks are missing")
    (folder / "axes.npz").write_bytes(b"")
    with pytest.raises(bd.SweepFolderError, match=r"axes\.npz"):
        bd.read_sweep(folder)


def test_failed_points_are_kept_apart_and_tried_again(folder: Path, tmp_path: Path) -> None:
    flag = tmp_path / "mended"

    def run() -> bd.SweepResult:
        options: dict[str, Any] = {"chunk_size": 4, "arguments": {"flag": str(flag)}}
        return bd.sweep(functions.refuses_unless_mended, GRID, "serial", folder=folder, **options)

    for _ in range(2):
        with pytest.raises(bd.SweepFailedError, match="3 points") as failure:
            run()
        assert [point.place for point in failure.value.failures] == [(2, 0), (2, 1), (2, 2)]
    stored = bd.read_sweep(folder)
    assert stored.failed.sum() == 3 and np.isnan(stored.values[stored.failed]).all()
    flag.touch()
    result = run()
    assert np.array_equal(result.values, np.outer(GRID["a"], GRID["b"])) and not result.failed.any()
    assert bd.read_sweep(folder).values.tobytes() == result.values.tobytes()


class Scaled:
    """Something with methods."""

    def __call__(self, a: Any, b: Any) -> Any:
        return a

    @classmethod
    def one(cls, a: Any, b: Any) -> Any:
        return a

    def times(self, a: Any, b: Any) -> Any:
        return 2.0 * a


def test_functions_without_a_lasting_name_are_refused(folder: Path) -> None:
    def inner(a: Any, b: Any) -> Any:
        return a

    @functools.wraps(functions.product)
    def wrapped(a: Any, b: Any) -> Any:
        return a

    unread: dict[str, Any] = {}
    exec("def f(a, b):\n    return 2 * a", unread)
    for function, message in [
        (lambda a, b: a, "a lambda has no name"),
        (inner, "inside another function"),
        (Scaled(), "an object of Scaled"),
        (functools.partial(functions.scaled, factor=1.0), "an object of partial"),
        (Scaled().times, "the method of an object"),
        (Scaled.one, "the method of an object or a class"),
        (bd.ImpactMap(axial_forcing=0.45, restitution=0.5).step, "the method of an object"),
        (wrapped, "wrapped by a decorator"),
        (unread["f"], "its source text cannot be read"),
    ]:
        with pytest.raises(bd.SweepFunctionError, match=f"cannot be swept with a folder: .*{message}"):
            product(folder, function)
        assert not folder.exists()
        # In memory there is nothing to be mistaken for.
        if message != "the method of an object":
            assert bd.sweep(function, GRID, "serial").values.shape == (4, 3)


def test_arguments_that_cannot_be_compared_are_refused(folder: Path) -> None:
    def scaled(value: Any) -> bd.SweepResult:
        return bd.sweep(functions.scaled, GRID, "serial", folder=folder, arguments={"factor": value})

    for value in [object(), np.array([object()]), {1: 2}, {1, 2}]:
        with pytest.raises(TypeError, match=r"arguments\['factor'\] is of"):
            scaled(value)
    # NaN is an argument like others, and so are objects of this package.
    scaled(np.nan)
    scaled(np.float64("nan"))
    with pytest.raises(bd.SweepFolderError, match="arguments.factor is 'nan' there, 'inf' here"):
        scaled(np.inf)


def test_two_sweeps_at_once(folder: Path, log: Path) -> None:
    refusals: list[tuple[int, int]] = []

    def second(done: int, total: int) -> None:
        assert_refused("in-use", lambda: swept(folder, log), f"in use by process {os.getpid()} on")
        refusals.append((done, total))

    swept(folder, log, progress=second)
    assert refusals == [(0, 12), (5, 12), (10, 12), (12, 12)]
    # The lock ends with the sweep, also with one that failed.
    swept(folder, log)


def test_a_folder_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for path in [tmp_path / "file", tmp_path / "file" / "inner"]:
        assert_refused("cannot-write", functools.partial(product, path), re.escape(str(path)))


@pytest.mark.skipif(sys.platform == "win32", reason="permissions of folders are those of POSIX")
def test_a_read_only_folder(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder.mkdir(parents=True)
    folder.chmod(0o555)
    if os.geteuid() == 0:
        # Nothing is forbidden to root: the system's answer is made here.
        real = os.open

        def denied(path: Any, flags: int, *rest: Any, **options: Any) -> int:
            if flags & os.O_CREAT and Path(path).parent == folder:
                raise PermissionError(13, "Permission denied", str(path))
            return real(path, flags, *rest, **options)

        monkeypatch.setattr("bouncing_disk._sweep.folder.os.open", denied)
    assert_refused("cannot-write", lambda: product(folder), "Permission denied")
    folder.chmod(0o755)


def test_a_full_disk_leaves_no_half_file(folder: Path, log: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written = []

    def full(file: int) -> None:
        written.append(file)
        if len(written) == 4:
            raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("bouncing_disk._sweep.folder.os.fsync", full)
        with pytest.raises(bd.SweepFolderError, match="No space left"):
            swept(folder, log)
    assert sorted(path.name for path in folder.glob("chunk*")) == ["chunk-000000.npz"]
    assert np.array_equal(swept(folder, log).values, EXPECTED)
    assert calls(log) == [5, 5, 5, 2]


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGKILL])
def test_an_ended_process_leaves_its_chunks(folder: Path, log: Path, sent: signal.Signals) -> None:
    script = textwrap.dedent(
        f"""
        import bouncing_disk as bd, sweep_functions as functions
        grid = {{"axial_forcing": [0.5, 0.55, 0.6, 0.65], "restitution": [0.4, 0.5, 0.6]}}
        bd.sweep(functions.slow_speeds, grid, "serial", folder={str(folder)!r}, chunk_size=1,
                 arguments={{"seconds": 0.1, "log": {str(log)!r}}})
        """
    )
    process = subprocess.Popen(
        [sys.executable, "-c", script], cwd=Path(__file__).parent, stderr=subprocess.PIPE
    )
    deadline = time.monotonic() + 60
    while len(list(folder.glob("chunk*.npz"))) < 3:
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.01)
    process.send_signal(sent)
    _, errors = process.communicate(timeout=30)
    assert process.returncode != 0
    assert sent == signal.SIGKILL or b"KeyboardInterrupt" in errors
    kept = len(list(folder.glob("chunk*.npz")))
    assert 3 <= kept < 12
    (folder / "chunk-000011.npz.unfinished").write_bytes(b"half")
    before = len(calls(log))
    grid = {"axial_forcing": [0.5, 0.55, 0.6, 0.65], "restitution": [0.4, 0.5, 0.6]}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        arguments = {"seconds": 0.1, "log": str(log)}
        options: dict[str, Any] = {"folder": folder, "chunk_size": 1, "arguments": arguments}
        resumed = bd.sweep(functions.slow_speeds, grid, "serial", **options)
    assert len(calls(log)) - before == 12 - kept
    arguments = {"seconds": 0.0, "log": str(log)}
    whole = bd.sweep(functions.slow_speeds, grid, "serial", arguments=arguments)
    assert resumed.values.tobytes() == whole.values.tobytes()
    assert not list(folder.glob("*.unfinished"))


def test_masked_values_are_refused(tmp_path: Path) -> None:
    masked: Any = np.ma.array([1.0, 2.0], mask=[False, True])
    with pytest.raises(TypeError, match="axis 'a' has masked values"):
        bd.sweep(functions.product, {"a": masked, "b": [1.0]}, "serial")
    with pytest.raises(TypeError, match="masked values"):
        bd.sweep(functions.product, {"a": [1.0]}, "serial", arguments={"b": masked}, folder=tmp_path / "x")
    unmasked: Any = np.ma.array([1.0, 2.0])
    result = bd.sweep(functions.product, {"a": unmasked, "b": [1.0]}, "serial")
    assert result.values.tolist() == [[1.0], [2.0]]


def test_the_folder_of_somebody_else_is_left_as_it_was(tmp_path: Path) -> None:
    for name in ("thesis.unfinished", "notes.txt"):
        (tmp_path / name).write_text("mine")
    (tmp_path / "folder.unfinished").mkdir()
    assert_refused("other-files", lambda: product(tmp_path), "holds other files")
    names = ["folder.unfinished", "notes.txt", "thesis.unfinished"]
    assert sorted(path.name for path in tmp_path.iterdir()) == names
    with pytest.raises(bd.SweepFolderError, match="is empty"):
        product("")


def test_a_folder_is_at_home_and_stays_where_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "elsewhere").mkdir()
    product("~/areas")
    assert (tmp_path / "areas" / "sweep.json").exists()
    monkeypatch.chdir(tmp_path)

    def leave(done: int, total: int) -> None:
        os.chdir(tmp_path / "elsewhere")

    bd.sweep(functions.product, GRID, "serial", folder="here", chunk_size=5, progress=leave)
    assert len(list((tmp_path / "here").glob("chunk-*.npz"))) == 3


def aligned(a: Any) -> Any:
    """A structured array with padding."""
    result = np.zeros(len(a), np.dtype([("x", "i1"), ("y", "f8")], align=True))
    result["y"] = a
    return result


def test_structured_results_and_axes_are_read_again(tmp_path: Path) -> None:
    grid = {"a": [1.0, 2.0]}
    first = bd.sweep(aligned, grid, "serial", folder=tmp_path / "x", chunk_size=1)
    assert bd.read_sweep(tmp_path / "x").values.tobytes() == first.values.tobytes()
    (tmp_path / "x" / "axes.npz").unlink()
    again = bd.sweep(aligned, grid, "serial", folder=tmp_path / "x", chunk_size=1)
    assert again["y"].tolist() == [1.0, 2.0]
    assert bd.read_sweep(tmp_path / "x").axes["a"].tolist() == [1.0, 2.0]


def test_a_grid_that_fills_the_memory_is_refused_at_once() -> None:
    axis = np.arange(2**15)
    with pytest.raises(bd.TooLargeError, match="chunks of .* points are too large"):
        bd.sweep(functions.product, {"a": axis, "b": axis, "c": axis}, "serial")
