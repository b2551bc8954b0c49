"""An error about a number names the caller's argument and the caller's number, whatever the library calls them."""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd
from good_calls import MAP, MOTOR, STARTS, TOSS, good

Call = tuple[Callable[..., Any], list[Any], dict[str, Any]]

CALLS: list[Call] = good()

#: What stands for a number: it is too small, too large, or none.
NUMBERS = [math.nan, -1.0, 0.0, 1e308, -1e308, math.inf, 5e-324]
COUNTS = [-1, 0, 2**70, -(2**70)]
PAIRS = [(math.nan, 1.0), (1.0, 0.0), (-1.0, -0.5), (-1e308, 1e308), (0.5, 1e308), (0.0, math.nan)]


def spoilt(value: Any) -> list[Any]:
    """The same kind of argument with other numbers."""
    if isinstance(value, bool) or value is None or isinstance(value, str):
        return []
    if isinstance(value, int):
        return COUNTS
    if isinstance(value, float):
        return NUMBERS
    if isinstance(value, tuple) and len(value) == 2 and all(isinstance(item, float) for item in value):
        return PAIRS
    if isinstance(value, (list, np.ndarray)) and len(value) and isinstance(value[0], (int, float)):
        row = np.asarray(value, dtype=float)
        return [[], *(np.concatenate([row[:-1], [number]]) for number in NUMBERS), row[:1], row[::-1]]
    if isinstance(value, dict):
        return [{**value, key: other} for key, own in value.items() for other in spoilt(own)]
    return []


def name_of(call: Callable[..., Any]) -> str:
    return getattr(call, "__qualname__", None) or type(call).__name__


def spoilt_calls() -> list[Any]:
    cases = []
    for call, positional, keywords in CALLS:
        for name, value in keywords.items():
            if spoilt(value):
                cases.append(pytest.param(call, positional, keywords, name, id=f"{name_of(call)}-{name}"))
    return cases


def is_argument(path: str, call: Callable[..., Any], keywords: dict[str, Any]) -> bool:
    """Whether a name, or the beginning of a dotted path, is an argument of the call."""
    names = set(inspect.signature(call).parameters) | set(keywords) | {"self"}
    return path.split(".")[0] in names


@pytest.mark.parametrize(("call", "positional", "keywords", "name"), spoilt_calls())
def test_an_error_names_an_argument_and_its_value(
    call: Callable[..., Any], positional: list[Any], keywords: dict[str, Any], name: str
) -> None:
    for value in spoilt(keywords[name]):
        try:
            call(*positional, **{**keywords, name: value})
        except bd.OutOfRangeError as error:
            assert is_argument(error.field, call, keywords), (value, error.field, str(error))
            assert str(error).startswith(f"{error.field} = "), str(error)
            if error.field == name and isinstance(value, (int, float)):
                same = error.value == float(value) or (math.isnan(error.value) and math.isnan(value))
                assert same, (value, error.value, str(error))
        except bd.InvalidError as error:
            if error.kind == "out-of-range-together":
                arguments = str(error.details["arguments"]).split(", ")
                assert all(is_argument(path, call, keywords) for path in arguments), arguments
                assert name in (path.split(".")[0] for path in arguments), (name, str(error))
        except (bd.BouncingDiskError, ValueError):
            pass
        except TypeError as error:
            # These are counts, which floats are not.
            assert name in ("seeds", "distances"), str(error)


def surface() -> set[str]:
    """Everything that can be called with a number."""
    found = set()
    for name in bd.__all__:
        thing = getattr(bd, name)
        if inspect.isbuiltin(thing):
            found.add(name)
        elif inspect.isclass(thing) and thing.__module__ == "bouncing_disk" and thing.__doc__:
            if "Parameters\n" in thing.__doc__:
                found.add(name)
            for member in vars(thing):
                method = getattr(thing, member)
                if not member.startswith("_") and callable(method) and inspect.signature(method).parameters:
                    if set(inspect.signature(method).parameters) - {"self", "progress", "json", "parameters"}:
                        found.add(f"{name}.{member}")
    return found


def test_no_call_is_left_out() -> None:
    covered = set()
    for call, _, _ in CALLS:
        owner = getattr(call, "__self__", None)
        is_method = owner is not None and not inspect.ismodule(owner)
        covered.add(f"{type(owner).__name__}.{call.__name__}" if is_method else call.__name__)
        # A static method does not know its class.
        own = (name for name in bd.__all__ if getattr(getattr(bd, name), call.__name__, None) == call)
        covered |= {f"{name}.{call.__name__}" for name in own}
    # What takes a whole object or a file, and no number.
    covered |= {"threads", "ImpactMap.of_system", "read_speeds"}
    assert surface() - covered == set()


@pytest.mark.parametrize(
    ("field", "value", "call"),
    [
        ("normalised_speed", -1.0, lambda: bd.orbit_diagram(axial_forcing=0.5, **{**STARTS, "normalised_speed": -1.0})),
        ("impact_phase", math.inf, lambda: MAP.step(impact_phase=math.inf, axial_impact_velocity=-1.0)),
        ("gap", -1.0, lambda: bd.simulate(TOSS, gap=-1.0)),
        ("relative_velocity", -1.0, lambda: bd.simulate(TOSS, relative_velocity=-1.0)),
        ("relative_velocity", 1e300, lambda: bd.multi_toss(TOSS, gap=1.0, relative_velocity=1e300)),
        ("angular_speed", 1e308, lambda: bd.simulate(TOSS, angular_speed=1e308)),
        ("speed_range", -1.0, lambda: bd.basins(MAP, speed_range=(-1.0, 1.0))),
        ("phase_range", 0.0, lambda: bd.basins(MAP, phase_range=(1.0, 0.0))),
        ("duration", 1e308, lambda: bd.transient(TOSS, duration=1e308)),
        ("friction", 0.5, lambda: bd.best_toss(friction=(0.7, 0.5))),
        ("load_torque", 1e308, lambda: bd.operating_point(MOTOR, load_torque=1e308)),
        ("disk.restitution", 1.5, lambda: bd.System.from_json(TOSS.replace(restitution=0.125).to_json().replace("0.125", "1.5"))),
    ],
)  # fmt: skip
def test_the_names_and_numbers_of_some(field: str, value: float, call: Callable[[], Any]) -> None:
    with pytest.raises(bd.OutOfRangeError) as refused:
        call()
    assert (refused.value.field, refused.value.value) == (field, value)


@pytest.mark.parametrize(
    ("value", "told", "call"),
    [
        (-1.0, r"\[[0-9.e-]+, [0-9.e+]+\] m", lambda: bd.simulate(TOSS, gap=-1.0)),
        (1e300, r"\[-[0-9.e+]+, [0-9.e+]+\] m/s", lambda: bd.multi_toss(TOSS, gap=1.0, relative_velocity=1e300)),
        (-1.0, r"\[0, inf\) m/s", lambda: bd.simulate(TOSS, relative_velocity=-1.0)),
        (1e308, r"\[-[0-9.e+]+, [0-9.e+]+\] rad/s", lambda: bd.simulate(TOSS, angular_speed=1e308)),
        (1e300, r"\(0, [0-9.e+]+\] s", lambda: bd.transient(TOSS, duration=1e300)),
        (1e300, r"\(0, [0-9.e+]+\] s", lambda: bd.transients([TOSS, bd.System.motor()], duration=1e300)),
        (1e200, r"\[-[0-9.e+]+, [0-9.e+]+\] N m", lambda: bd.operating_point(MOTOR, load_torque=1e200)),
    ],
)  # fmt: skip
def test_a_value_and_its_range_have_the_unit_of_the_argument(
    value: float, told: str, call: Callable[[], Any]
) -> None:
    with pytest.raises(bd.OutOfRangeError) as refused:
        call()
    assert refused.value.value == value and re.fullmatch(told, refused.value.range), str(refused.value)
    assert str(refused.value).endswith(f" is outside its legal range {refused.value.range}")


def test_the_end_of_a_range_in_si_is_that_of_the_library() -> None:
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.multi_toss(TOSS, gap=1.0, relative_velocity=-1e300)
    unit = TOSS.preload_acceleration / TOSS.angular_frequency
    ends = [float(end) for end in refused.value.range.strip("[] m/s").split(", ")]
    assert ends == pytest.approx([-1e9 * unit, 1e9 * unit], rel=1e-5)


@pytest.mark.parametrize(
    ("told", "call"),
    [
        ("recorded = -1 is outside its legal range [0, 4294967295]",
         lambda: bd.orbit_diagram(axial_forcing=0.5, **STARTS, recorded=-1)),
        ("starts = 300000 is outside its legal range [0, 262144]", lambda: bd.attractors(MAP, starts=300_000)),
        ("max_points = 20000000 is outside its legal range [2, 1000000]",
         lambda: bd.continued(MAP, MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3),  # type: ignore[arg-type]
                              parameter_range=(0.4, 0.5), max_points=20_000_000)),
        ("restitution = 1 is outside its legal range [0, 1)", lambda: MAP.__class__(axial_forcing=0.5, restitution=1.0)),
    ],
)  # fmt: skip
def test_whole_numbers_are_told_without_a_fraction(told: str, call: Callable[[], Any]) -> None:
    with pytest.raises(bd.OutOfRangeError) as refused:
        call()
    assert str(refused.value) == told


def test_what_follows_from_several_arguments_names_them_all() -> None:
    with pytest.raises(bd.InvalidError) as refused:
        TOSS.replace(amplitude=1e308)
    assert refused.value.kind == "out-of-range-together"
    assert refused.value.details["quantity"] == "peak_acceleration"
    assert refused.value.details["value"] == math.inf
    assert refused.value.details["arguments"] == "amplitude, angular_frequency, preload_acceleration"
