"""What is documented is so: docstrings, the README, docs/python.md and the notebooks run, and print what they say."""

from __future__ import annotations

import contextlib
import doctest
import inspect
import io
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bouncing_disk as bd
import numpy as np
import pytest


def needs(*packages: str) -> None:
    """Skips a test where an optional package is missing; pictures go to no screen."""
    pytest.importorskip("matplotlib").use("Agg")
    for package in packages:
        pytest.importorskip(package)


def documented() -> Iterator[tuple[str, str]]:
    """Names and docstrings of everything that the package exports, and of the members of its classes."""
    yield "bouncing_disk", bd.__doc__ or ""
    for name in bd.__all__:
        thing = getattr(bd, name)
        if not callable(thing):
            continue
        yield name, inspect.getdoc(thing) or ""
        if inspect.isclass(thing):
            for member in vars(thing):
                if not member.startswith("_"):
                    yield f"{name}.{member}", inspect.getdoc(getattr(thing, member)) or ""


DOCUMENTED = dict(documented())


def failures_of(name: str, text: str) -> str:
    """The report of the examples in a docstring that print something else than it says."""
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, 0)
    runner = doctest.DocTestRunner(verbose=False, optionflags=doctest.NORMALIZE_WHITESPACE)
    report: list[str] = []
    runner.run(test, out=report.append)
    return "".join(report)


@pytest.mark.parametrize("name", [name for name, text in DOCUMENTED.items() if ">>>" in text])
def test_examples_run_and_print_what_they_say(name: str) -> None:
    assert failures_of(name, DOCUMENTED[name]) == ""


@pytest.mark.parametrize("name", [name for name in DOCUMENTED if "." not in name])
def test_everything_is_documented(name: str) -> None:
    assert len(DOCUMENTED[name]) > 20, name


@pytest.mark.parametrize("name", [name for name in bd.__all__ if inspect.isfunction(getattr(bd, name))])
def test_functions_say_what_they_take(name: str) -> None:
    # Objects, and what all long calls have, speak for themselves.
    plain = {"system", "motor", "impact_map", "orbit", "basins", "progress", "function", "client"}
    for argument in set(inspect.signature(getattr(bd, name)).parameters) - plain:
        assert argument in DOCUMENTED[name], (name, argument)


PAGE = Path(__file__).parents[3] / "docs" / "python.md"
BLOCK = re.compile(r"^```(.*)\n((?:.*\n)*?)```$", re.MULTILINE)


def blocks() -> list[tuple[str, str]]:
    return BLOCK.findall(PAGE.read_text(encoding="utf-8"))


def test_the_page_prints_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    needs("dask.array", "xarray", "netCDF4", "scipy", "SALib", "joblib")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "__main__"}
    printed = ""
    ran = 0
    for language, text in blocks():
        if language == "python":
            assert not printed, f"the page does not show {printed!r}"
            output = io.StringIO()
            # By its place in the file, so that its functions have their source text.
            path = tmp_path / f"block_{ran}.py"
            path.write_text(text)
            with contextlib.redirect_stdout(output):
                exec(compile(text, str(path), "exec"), names)
            printed = output.getvalue()
            ran += 1
        elif language == "text":
            assert printed == text
            printed = ""
    assert ran >= 8 and not printed


@pytest.mark.skipif(not PAGE.exists(), reason="the tests were copied without the docs")
def test_the_programs_for_clusters_are_python() -> None:
    programs = [text for language, text in blocks() if language == "python no-run"]
    assert len(programs) == 2
    for program in programs:
        compile(program, "docs/python.md", "exec")


@pytest.mark.skipif(not PAGE.exists(), reason="the tests were copied without the docs")
def test_motors_on_a_cluster_resume_and_are_those_of_one_call(tmp_path: Path) -> None:
    needs("dask.array", "dask.distributed")
    (program,) = [text for language, text in blocks() if "motor_map" in text and language == "python no-run"]
    few = program.replace("100, chunks=5", "4, chunks=2").replace("100, chunks=100", "10, chunks=10")
    assert few != program
    (tmp_path / "motors.py").write_text(few)
    run = [sys.executable, "motors.py"]
    printed = [subprocess.run(run, cwd=tmp_path, check=True, capture_output=True, text=True).stdout]
    first, second = sorted(tmp_path.glob("*.npy"))
    kept, time = np.load(first), second.stat().st_mtime_ns
    first.unlink()
    printed.append(subprocess.run(run, cwd=tmp_path, check=True, capture_output=True, text=True).stdout)
    assert printed[0] == printed[1] and printed[0].startswith("40 of 40 motors have a speed")
    assert np.load(first).tobytes() == kept.tobytes() and second.stat().st_mtime_ns == time
    axes = {"preload_force": np.linspace(3.0, 6.0, 4), "friction": np.linspace(0.05, 0.3, 10)}
    whole = bd.motor_map(bd.Motor.paper_70_khz(), over=axes, relative_error=0.3, members=4).speed
    assert np.concatenate([kept, np.load(second)]).tobytes() == whole.tobytes()


@pytest.mark.skipif(not PAGE.exists(), reason="the tests were copied without the docs")
def test_the_installation_is_two_commands() -> None:
    (commands,) = [text for language, text in blocks() if language == "sh"]
    assert len(commands.splitlines()) == 2
    program = re.search(r'python -c "(.*)"', commands)
    assert program is not None
    compile(program[1], "docs/python.md", "exec")


README = Path(__file__).parents[1] / "README.md"


@pytest.mark.skipif(not README.exists(), reason="the tests were copied without the README")
def test_the_programs_of_the_readme_run_one_after_the_other() -> None:
    programs = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert len(programs) == 2
    names: dict[str, object] = {}
    for program in programs:
        exec(compile(program, str(README), "exec"), names)
    assert getattr(names["x"], "shape", 0) == getattr(names["y"], "shape", 1)


FOLDER = Path(__file__).parents[1] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


@pytest.mark.skipif(not FOLDER.exists(), reason="the tests were copied without the notebooks")
def test_there_are_three() -> None:
    assert [path.stem for path in NOTEBOOKS] == ["a_bifurcation_study", "a_motor", "a_toss"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_is_stored_without_outputs(path: Path) -> None:
    content = json.loads(path.read_text(encoding="utf-8"))
    assert path.stat().st_size < 20_000
    for cell in content["cells"]:
        assert not cell.get("outputs") and cell.get("execution_count") is None


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_runs(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    needs("ipykernel")
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    # Nothing of the user's own settings, such as a startup file, takes part.
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path / "runtime"))
    notebook: Any = nbformat.read(path, as_version=4)
    work = tmp_path / "work"
    work.mkdir()
    nbclient.NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(work)}}
    ).execute()
    if target := os.environ.get("BOUNCING_DISK_EXECUTED_NOTEBOOKS"):
        nbformat.write(notebook, Path(target) / path.name)
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert not [output for output in outputs if output.output_type == "stream" and output.name == "stderr"]
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) >= 2
