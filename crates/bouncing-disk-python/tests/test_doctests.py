"""The examples of all docstrings: those of the compiled module as well, which doctest does not find by itself."""

from __future__ import annotations

import doctest
import inspect
from collections.abc import Iterator

import pytest

import bouncing_disk


def documented() -> Iterator[tuple[str, str]]:
    """Names and docstrings of everything that the package exports, and of the members of its classes."""
    yield "bouncing_disk", bouncing_disk.__doc__ or ""
    for name in bouncing_disk.__all__:
        thing = getattr(bouncing_disk, name)
        if not callable(thing):
            continue
        yield name, inspect.getdoc(thing) or ""
        if inspect.isclass(thing):
            for member in vars(thing):
                if not member.startswith("_"):
                    yield f"{name}.{member}", inspect.getdoc(getattr(thing, member)) or ""


DOCUMENTED = dict(documented())


@pytest.mark.parametrize("name", [name for name, text in DOCUMENTED.items() if ">>>" in text])
def test_examples_run_and_print_what_they_say(name: str) -> None:
    test = doctest.DocTestParser().get_doctest(DOCUMENTED[name], {}, name, None, 0)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    report: list[str] = []
    runner.run(test, out=report.append)
    assert runner.summarize(verbose=False).failed == 0, "".join(report)


@pytest.mark.parametrize("name", [name for name in DOCUMENTED if "." not in name])
def test_everything_is_documented(name: str) -> None:
    assert len(DOCUMENTED[name]) > 20, name


def test_functions_say_what_they_take_and_return() -> None:
    for name in bouncing_disk.__all__:
        thing = getattr(bouncing_disk, name)
        if inspect.isbuiltin(thing) and name != "set_threads":
            text = DOCUMENTED[name]
            assert "Returns\n-------" in text, name
            for argument in inspect.signature(thing).parameters:
                assert argument in text.split("Returns\n-------")[0], (name, argument)
