"""Python, the command line and the table of both in docs/contributing.md agree.

``data/command-line.json`` lists the options of each command; a test of the command line keeps it. ``data/surfaces.json``
lists the analyses: a text in place of a list, or of a command, is the reason of a gap. ``UPDATE_DOCUMENTATION=1``
writes the table.
"""

from __future__ import annotations

import inspect
import json
import operator
import os
import re
from pathlib import Path
from typing import Any

import bouncing_disk as bd
import pytest
from bouncing_disk import _native as native

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "contributing.md"
VIEWS = ("Toss and bounce", "Orbit diagram", "Basins", "Motor", "Compare", "Scan")

pytestmark = pytest.mark.skipif(not PAGE.exists(), reason="the tests were copied without the docs")


def read(name: str) -> Any:
    return json.loads((ROOT / "data" / name).read_text(encoding="utf-8"))


def functions(row: dict[str, Any]) -> list[str]:
    return row["python"] if isinstance(row["python"], list) else []


def command_of(row: dict[str, Any]) -> str:
    name: str = row["command"].split(" --")[0]
    return name


def code(names: list[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def line(row: dict[str, Any], commands: dict[str, Any]) -> str:
    name, command, page = command_of(row), row["command"], row["page"]
    option = command[len(name) :].removeprefix(" --")
    assert name not in commands or not option or option in commands[name], command
    cells = [
        row["analysis"],
        code(row["library"]),
        f"`{command}`" if name in commands else f"- ({command})",
        code(functions(row)) or f"- ({row['python']})",
        page if page in VIEWS else f"- ({page})",
    ]
    return f"| {' | '.join(cells)} |\n"


def test_each_command_and_each_function_is_in_the_table() -> None:
    surfaces, commands = read("surfaces.json"), read("command-line.json")
    rows = surfaces["analyses"]
    for name in (name for row in rows for name in functions(row)):
        assert operator.attrgetter(name)(bd), name
    listed = [name for row in rows for name in functions(row) if "." not in name]
    exported = [name for name in bd.__all__ if inspect.isfunction(getattr(bd, name))]
    assert sorted(listed + surfaces["no_analysis"]["python"]) == sorted(exported)
    named = {command_of(row) for row in rows} & commands.keys()
    assert named | set(surfaces["no_analysis"]["command"]) == commands.keys()
    head = "| analysis | library | command line | Python | page |\n| --- | --- | --- | --- | --- |\n"
    table = head + "".join(line(row, commands) for row in rows)
    page = PAGE.read_text(encoding="utf-8")
    start = page.index("| analysis | library |")
    end = page.index("\n\n", start) + 1
    if os.environ.get("UPDATE_DOCUMENTATION"):
        PAGE.write_text(page[:start] + table + page[end:], encoding="utf-8")
    else:
        assert page[start:end] == table, "UPDATE_DOCUMENTATION=1 writes it"


def plain(default: object) -> list[float | str]:
    """A default in one form: a range is 0:3 on the line and a pair in Python, and nothing is there in many ways."""
    if default in (None, False, (), "", "false", inspect.Parameter.empty):
        return []
    parts = default if isinstance(default, tuple) else str(default).split(":")
    numbers: list[float | str] = []
    for part in parts:
        try:
            numbers.append(float(part))
        except ValueError:
            numbers.append(str(part))
    return numbers


def arguments(function: str) -> dict[str, object]:
    """The arguments of a function with their defaults, including those of its settings."""
    parameters = inspect.signature(operator.attrgetter(function)(bd)).parameters
    own = {name: parameter.default for name, parameter in parameters.items()}
    settings = re.search(r"Unpack\[(\w+)\]", str(parameters.get("settings")))
    return own | (native.default_settings(settings[1]) if settings else {})


def unit_of(name: str, function: str) -> str:
    """The unit that a docstring states of an argument, or "" """
    text = inspect.getdoc(operator.attrgetter(function)(bd)) or ""
    entry = re.search(rf"^    {name}: (.*(?:\n {{8}}.*)*)", text, re.MULTILINE)
    unit = re.search(r"\((s|N|N m)\)", entry[1]) if entry else None
    return unit[1] if unit else ""


def test_options_are_arguments_by_name_unit_and_default() -> None:
    rows, faults = read("surfaces.json")["analyses"], list[object]()
    for command, options in read("command-line.json").items():
        own = [row for row in rows if command_of(row) == command]
        names = [name for row in own for name in functions(row)]
        signatures = [(own, arguments(own)) for own in names]
        reasons = {option for row in own for option in row.get("options", ())}
        assert reasons <= options.keys(), command
        for option, said in options.items() if names else ():
            default, _, unit = said.partition(" ")
            name = option.replace("-", "_")
            same = [
                (plain(defaults[name]), unit_of(name, function))
                for function, defaults in signatures
                if name in defaults
            ]
            agrees = bool(same) and all(own == (plain(default), unit) for own in same)
            if agrees == (option in reasons):
                faults.append((command, option, default, same))
    assert not faults
