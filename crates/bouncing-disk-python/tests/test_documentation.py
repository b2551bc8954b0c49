"""The programs of docs/python.md run, one after the other, and print what the page says."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("matplotlib").use("Agg")
pytest.importorskip("distributed")
pytest.importorskip("xarray")

PAGE = Path(__file__).parents[3] / "docs" / "python.md"
BLOCK = re.compile(r"^```(.*)\n((?:.*\n)*?)```$", re.MULTILINE)


def blocks() -> list[tuple[str, str]]:
    return BLOCK.findall(PAGE.read_text(encoding="utf-8"))


def test_the_page_prints_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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


def test_the_programs_for_clusters_are_python() -> None:
    programs = [text for language, text in blocks() if language == "python no-run"]
    assert len(programs) == 3
    for program in programs:
        compile(program, "docs/python.md", "exec")


def test_the_installation_is_two_commands() -> None:
    (commands,) = [text for language, text in blocks() if language == "sh"]
    assert len(commands.splitlines()) == 2
    program = re.search(r'python -c "(.*)"', commands)
    assert program is not None
    compile(program[1], "docs/python.md", "exec")
