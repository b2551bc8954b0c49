"""The programs of the README run."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

README = Path(__file__).parent.parent / "README.md"


@pytest.mark.skipif(not README.exists(), reason="the tests were copied without the README")
def test_the_programs_of_the_readme_run_one_after_the_other() -> None:
    programs = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert len(programs) == 2
    names: dict[str, object] = {}
    for program in programs:
        exec(compile(program, str(README), "exec"), names)
    assert getattr(names["x"], "shape", 0) == getattr(names["y"], "shape", 1)
