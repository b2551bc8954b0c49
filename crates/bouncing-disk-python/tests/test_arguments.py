"""Arguments of all kinds: legal ones are the same numbers, others are refused by name, and no call panics."""

from __future__ import annotations

import inspect
import math
import random
import re
import time
import warnings
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import bouncing_disk as bd
import numpy as np
import pytest

from good_calls import MAP, MOTOR, OTHER, STARTS, TOSS, good

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


def is_argument(name: str, call: Callable[..., Any], keywords: dict[str, Any]) -> bool:
    # The restitution of a map is no argument of its methods.
    others = {"self", "restitution"}
    return name in {*inspect.signature(call).parameters, *keywords, *others}


@pytest.mark.parametrize(
    ("call", "positional", "keywords", "name"),
    [
        pytest.param(call, positional, keywords, name, id=f"{call.__qualname__}-{name}")
        for call, positional, keywords in CALLS
        for name, value in keywords.items()
        if spoilt(value)
    ],
)
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
                assert all(is_argument(one, call, keywords) for one in arguments), arguments
                assert name in arguments, (name, str(error))
        except (bd.BouncingDiskError, ValueError):
            pass
        except TypeError as error:
            # These are counts, which floats are not.
            assert name == "distances", str(error)


def test_no_call_is_left_out() -> None:
    # What takes a whole object, a text or a file, and no number.
    plain = {"threads", "of_system", "read_speeds", "sweep", "to_json", "to_dict", "from_json"}
    plain |= {"from_dict", "pizza_toss", "motor", "paper", "names", "reasons", "stator_report"}
    plain |= {"of", "column", "share", "branch_end_names"}
    surface = set()
    for name in bd.__all__:
        thing = getattr(bd, name)
        if inspect.isfunction(thing):
            surface.add(name)
        elif inspect.isclass(thing) and not issubclass(thing, (Exception, tuple)):
            surface |= {member for member in vars(thing) if inspect.isfunction(vars(thing)[member])}
    missing = {name for name in surface if not name.startswith("_")} - {call.__name__ for call, _, _ in CALLS}
    assert missing - plain == set()


@pytest.mark.parametrize(
    ("field", "value", "told", "call"),
    [
        ("normalised_speed", -1.0, r"\[0, .*", lambda: bd.orbit_diagram(axial_forcing=0.5, **{**STARTS, "normalised_speed": -1.0})),
        ("impact_phase", math.inf, ".*", lambda: MAP.step(impact_phase=math.inf, axial_impact_velocity=-1.0)),
        ("speed_range", -1.0, ".*", lambda: bd.basins(MAP, speed_range=(-1.0, 1.0))),
        ("phase_range", 0.0, ".*", lambda: bd.basins(MAP, phase_range=(1.0, 0.0))),
        ("restitution", 1.5, r"\[0, 1\)", lambda: bd.System.from_json(TOSS.replace(restitution=0.125).to_json().replace("0.125", "1.5"))),
        # A value and its range have the unit of the argument.
        ("gap", -1.0, r"\[[0-9.e-]+, [0-9.e+]+\] m", lambda: bd.simulate(TOSS, gap=-1.0)),
        ("relative_velocity", 1e300, r"\[-[0-9.e+]+, [0-9.e+]+\] m/s", lambda: bd.simulate(TOSS, gap=1.0, relative_velocity=1e300)),
        ("relative_velocity", -1.0, r"\[0, inf\) m/s", lambda: bd.simulate(TOSS, relative_velocity=-1.0)),
        ("angular_speed", 1e308, r"\[-[0-9.e+]+, [0-9.e+]+\] rad/s", lambda: bd.simulate(TOSS, angular_speed=1e308)),
        ("duration", 1e300, r"\(0, [0-9.e+]+\] s", lambda: bd.ensemble(TOSS, members=3, duration=1e300)),
        ("contact_periods", 0.0, r"\[1e-6, 1000\] .*", lambda: MAP.replace(contact_periods=0.0)),
        ("load_torque", 1e200, r"\[-[0-9.e+]+, [0-9.e+]+\] N m", lambda: MOTOR.replace(load_torque=1e200)),
        # Whole numbers stand without a fraction.
        ("recorded", -1.0, r"\[0, 4294967295\]", lambda: bd.orbit_diagram(axial_forcing=0.5, **STARTS, recorded=-1)),
        ("starts", 300_000.0, r"\[0, 262144\]", lambda: bd.attractors(MAP, starts=300_000)),
        ("max_points", 2e7, r"\[2, 1000000\]", lambda: bd.continued(MAP, ORBIT, parameter_range=(0.4, 0.5), max_points=20_000_000)),
    ],
)  # fmt: skip
def test_the_names_numbers_and_ranges_of_some(
    field: str, value: float, told: str, call: Callable[[], Any]
) -> None:
    with pytest.raises(bd.OutOfRangeError) as refused:
        call()
    error = refused.value
    assert (error.field, error.value) == (field, value) and re.fullmatch(told, error.range), error.range
    whole = f"{value:.0f}" if abs(value) < 1e15 and value == round(value) else ".*"
    words = "is outside its legal range" if error.range[0] in "[(" else "is not legal: it must be"
    assert re.fullmatch(rf"{field} = {whole} {words} {re.escape(error.range)}", str(error))


def test_the_end_of_a_range_in_si_is_that_of_the_library() -> None:
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.simulate(TOSS, gap=1.0, relative_velocity=-1e300)
    unit = TOSS.preload_acceleration / TOSS.angular_frequency
    ends = [float(end) for end in refused.value.range.strip("[] m/s").split(", ")]
    assert ends == pytest.approx([-1e9 * unit, 1e9 * unit], rel=1e-5)


ORBIT: Any = MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3)


def test_nothing_and_one_are_numbers_of_orbits() -> None:
    nothing = bd.orbit_diagram(axial_forcing=[], **STARTS)
    assert nothing.offsets.tolist() == [0]
    assert len(nothing.impact_phase) == 0 and len(nothing.column()) == 0
    assert bd.verdicts(axial_forcing=[], **STARTS).names() == []
    assert bd.lyapunov_spectra(axial_forcing=[], **STARTS).names() == []
    assert bd.lyapunov_exponents(axial_forcing=np.array([]), **STARTS).shape == (0,)
    one = bd.orbit_diagram(axial_forcing=0.45, recorded=1, **STARTS)
    assert one.offsets.tolist() == [0, 1]
    assert one == bd.orbit_diagram(axial_forcing=[0.45], recorded=1, **STARTS)
    assert bd.orbit_diagram(axial_forcing=0.45, recorded=0, **STARTS).offsets.tolist() == [0, 0]
    resting = bd.orbit_diagram(axial_forcing=[0.2, 0.45], recorded=10, **STARTS)
    assert np.diff(resting.offsets).tolist() == [0, 10]


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, -1.0, 1e300])
@pytest.mark.parametrize("field", ["axial_forcing", "restitution"])
def test_numbers_outside_their_range_are_named(field: str, value: float) -> None:
    for call in (bd.orbit_diagram, bd.verdicts, bd.lyapunov_exponents):
        with pytest.raises(bd.OutOfRangeError) as refused:
            call(**{"axial_forcing": 0.5, **STARTS, field: [0.4, value]})
        assert refused.value.field == field
        assert refused.value.value == value or np.isnan(value)


@pytest.mark.parametrize("value", [5e-324, 2.2e-308, 1e-300])
def test_denormal_numbers_are_numbers(value: float) -> None:
    assert bd.verdicts(axial_forcing=value, **STARTS).names() == ["at-rest"]
    assert bd.ImpactMap(axial_forcing=value, restitution=0.5).restitution == 0.5
    with pytest.raises(bd.InvalidError) as refused:
        TOSS.replace(contact_radius=value)
    assert "contact_radius" in str(refused.value.details["arguments"])


def test_counts_that_are_none_are_refused() -> None:
    for count in (-1, -(2**70), 2**70, 2**64):
        for call in (
            lambda count=count: bd.orbit_diagram(axial_forcing=0.5, recorded=count, **STARTS),
            lambda count=count: bd.basins(MAP, phases=count),
            lambda count=count: bd.ensemble(TOSS, members=3, intervals=count),
            lambda count=count: MAP.period_one(platform_periods=count),
        ):
            with pytest.raises(bd.OutOfRangeError) as refused:
                call()
            assert refused.value.value == pytest.approx(float(count))
    assert len(bd.orbit_diagram(axial_forcing=0.5, recorded=np.int8(3), **STARTS).impact_phase) == 3


def test_what_does_not_fit_into_memory_is_an_error() -> None:
    with pytest.raises(bd.TooLargeError) as refused:
        bd.basins(MAP, phases=100_000, speeds=100_000)
    assert (refused.value.count, refused.value.limit) == (10**10, 2**31)
    with pytest.raises(bd.TooLargeError):
        bd.orbit_diagram(axial_forcing=[0.5] * 1000, recorded=2**31, **STARTS)
    with pytest.raises(bd.TooLargeError):
        bd.ensemble(bd.System.motor(), members=10**6, intervals=10**6)


def test_arrays_of_all_kinds_are_the_same_numbers() -> None:
    expected = bd.orbit_diagram(axial_forcing=[0.5, 0.25, 0.5], **STARTS)
    contiguous = np.array([0.5, 0.25, 0.5])
    read_only = contiguous.copy()
    read_only.flags.writeable = False
    unaligned = np.frombuffer(b"\0" + contiguous.tobytes(), np.uint8)[1:].view("f8")
    kinds: list[Any] = [(0.5, 0.25, 0.5), contiguous, read_only, contiguous[::-1], unaligned]
    kinds += [np.array([0.5, 9.0, 0.25, 9.0, 0.5])[::2], np.array([0.5, 0.25, 0.5, 0.0])[:3]]
    kinds += [np.asfortranarray(np.array([[0.5, 1.0], [0.25, 1.0], [0.5, 1.0]]))[:, 0]]
    kinds += [contiguous.astype(kind) for kind in (">f8", np.float32, np.float16, np.longdouble)]
    for kind in kinds:
        assert bd.orbit_diagram(axial_forcing=kind, **STARTS) == expected
    assert read_only.tolist() == [0.5, 0.25, 0.5]
    whole = bd.verdicts(axial_forcing=np.array([1], dtype=np.uint8), impacts=64, **STARTS)
    assert whole.axial_forcing.tolist() == [1.0]
    forcings = np.array([0.4, 0.5])
    found = bd.orbit_diagram(axial_forcing=forcings, **STARTS)
    forcings[:] = 7.0
    assert found.axial_forcing.tolist() == [0.4, 0.5]


@pytest.mark.parametrize(
    "value",
    ["0.5", b"0.5", None, [None], ["a"], 1j, [1j], [True], {}, {0.5}, object(), [object()], np.array("x"), len],
    ids=repr,
)  # fmt: skip
def test_what_is_no_number_is_a_type_error(value: object) -> None:
    with pytest.raises(TypeError):
        bd.orbit_diagram(axial_forcing=value, **STARTS)  # type: ignore[arg-type]


@pytest.mark.parametrize("value", [[[0.5]], np.zeros((2, 2, 2)), np.zeros((0, 3)), [0.5, [0.5]]], ids=repr)
def test_arrays_of_other_shapes_are_value_errors(value: Any) -> None:
    with pytest.raises(ValueError):
        bd.orbit_diagram(axial_forcing=value, **STARTS)
    with pytest.raises(ValueError, match="axial_forcing and impact_phase .* 2 and 3"):
        bd.orbit_diagram(axial_forcing=[0.4, 0.5], **{**STARTS, "impact_phase": [1, 2, 3]})


def test_masked_values_are_refused() -> None:
    times = np.linspace(0.01, 5.0, 200)
    speeds: Any = np.ma.array(30.0 * (1.0 - np.exp(-times / 0.8)))
    expected = bd.fit_transients(times=times, speeds=speeds.data, resamples=200)
    assert bd.fit_transients(times=times, speeds=speeds, resamples=200) == expected
    speeds[50] = np.ma.masked
    with pytest.raises(TypeError, match="masked values"):
        bd.fit_transients(times=times, speeds=speeds)
    with pytest.raises(TypeError, match="masked values"):
        bd.orbit_diagram(axial_forcing=np.ma.array([0.45, 0.5], mask=[True, False]), **STARTS)


def test_words_and_objects_that_are_wrong_are_named() -> None:
    wrong: Any = "rest"
    with pytest.raises(ValueError, match="initial_spin"):
        bd.single_toss(TOSS, initial_spin=wrong)
    with pytest.raises(ValueError, match="parameter"):
        bd.continued(MAP, ORBIT, parameter=wrong, parameter_range=(0.1, 0.6))
    for call, name in ((bd.single_toss, "system"), (bd.stall_load, "motor"), (bd.basins, "impact_map")):
        with pytest.raises(TypeError, match=f"'{name}' must be a"):
            call(wrong)


@pytest.mark.parametrize("call", [bd.ImpactMap.period_one, lambda own: bd.manifold(own, ORBIT, arclength=1.0)])
def test_what_is_the_sines_only_refuses_other_maps(call: Callable[[bd.ImpactMap], Any]) -> None:
    soft = MAP.replace(contact_periods=0.1)
    for own, kind in ((OTHER, "drive-not-sine"), (MAP.replace(drive=bd.Drive.triangle()), "drive-not-sine"), (soft, "soft-contact")):
        with pytest.raises(bd.InvalidError, match="only for rigid impacts on the sine") as refused:
            call(own)
        assert refused.value.kind == kind


def test_computations_without_a_result_say_why() -> None:
    with pytest.raises(bd.ComputationError) as failed:
        bd.single_toss(TOSS.replace(amplitude=0.001))
    assert failed.value.kind == "never-leaves"
    assert 0.0 < failed.value.details["peak_acceleration"] < 1.0  # type: ignore[operator]
    with pytest.raises(bd.FitRefusedError):
        bd.fit_transients(times=np.linspace(0.1, 1.0, 50), speeds=np.zeros((50, 8)))
    with pytest.raises(bd.ComputationError, match="is not proven to attract"):
        saddle = bd.periodic_orbits(MAP, max_impacts=1, max_platform_periods=1)[-1]
        bd.basins(MAP, phases=3, speeds=3, known_orbits=[saddle])


# What a fuzzed call is given in place of a good argument.
BAD: list[Callable[[random.Random], Any]] = [
    lambda r: r.choice([None, True, 1j, {}, [], object(), bd.System, (0.0, 1.0), (1.0, 0.0, 2.0)]),
    lambda r: r.choice(["", "x", "0.5", "axial_forcing", b"\0", "\0", "\ud800"]),
    lambda r: r.choice([np.nan, np.inf, -np.inf, 0.0, -0.0, 5e-324, -1e300, 1.7e308, 1e-300]),
    lambda r: r.choice([0, -1, 1, 2**31, 2**32, 2**63, 2**64, -(2**63), 10**400]),
    lambda r: r.random() * 10.0 ** r.randint(-12, 12),
    lambda r: [r.random() for _ in range(r.randint(0, 4))],
    lambda r: [[1.0, 2.0], [3.0]],
    lambda r: np.array([r.choice([np.nan, np.inf, -1.0, 0.5]) for _ in range(r.randint(0, 3))]),
    lambda r: np.zeros((r.randint(0, 3),) * r.randint(0, 4)),
    lambda r: np.arange(12.0).reshape(3, 4)[:, :: r.choice([-1, 2])],
    lambda r: np.array(["a", None, 1.0], dtype=object),
    lambda r: np.array(["2020-01-01"], dtype="datetime64[D]"),
    lambda r: np.ma.masked_array([1.0, 2.0], mask=[True, False]),
    lambda r: np.zeros(3, dtype=[("a", "f8")]),
    lambda r: r.choice([TOSS, MAP, MOTOR, bd.ChatterCut.paper()]),
    lambda r: iter([1.0]),
    lambda r: lambda *numbers: None,
    lambda r: memoryview(b"abc"),
]


# Arguments that make a legal call long, which no fuzz may pass: their seams are tested above.
LONG = {
    "transient", "recorded", "impacts", "phases", "speeds", "max_impacts", "max_platform_periods", "starts",
    "transient_impacts", "examined_impacts", "events", "duration", "intervals", "members", "most_impacts", "samples",
    "count", "max_points", "longest_period", "cells", "resamples", "relative_error", "first_step",
    "points", "rows", "arclength", "orbits",
}  # fmt: skip


# What a good number or a good array of numbers is as good as.
SAME_NUMBERS: list[Callable[[Any], Any]] = [np.float64, np.array, lambda number: np.array([number])[0]]
SAME_ARRAYS: list[Callable[[Any], Any]] = [
    list,
    tuple,
    np.asfortranarray,
    lambda array: np.repeat(array, 2)[::2],
    lambda array: np.array(array[::-1])[::-1],
    lambda array: np.array(array, dtype=">f8"),
    lambda array: np.frombuffer(np.array(array).tobytes()),  # It is read-only.
]


def dressed(value: Any, generator: random.Random) -> Any:
    """The same value as another type, or in another layout, where it is a float or a row of floats."""
    if type(value) is float:
        return generator.choice(SAME_NUMBERS)(value)
    if isinstance(value, list) and value and all(type(one) is float for one in value):
        value = np.array(value)
    row = isinstance(value, np.ndarray) and value.dtype == np.float64 and value.ndim == 1
    return generator.choice(SAME_ARRAYS)(value) if row else value


def test_good_calls_work_with_numbers_and_arrays_of_any_kind() -> None:
    generator = random.Random(11)
    tried = 0
    for call, positional, keywords in CALLS:
        try:
            call(*positional, **keywords)
        except (bd.ComputationError, bd.FitRefusedError):
            continue  # Quick ones without a result, which they have in no other form of the same numbers either.
        for _ in range(4):
            others = {name: dressed(value, generator) for name, value in keywords.items()}
            if any(others[name] is not keywords[name] for name in others):
                call(*positional, **others)
                tried += 1
    assert tried > 100, tried


class Wrong(Exception):
    """A fuzzed call was stopped."""


@pytest.mark.parametrize("part", range(10))
def test_a_fuzzed_call_raises_or_works(part: int) -> None:
    """A thousand calls with one or two arguments spoilt, or given as another type: never a panic or a crash."""
    generator = random.Random(part)
    outcomes = {"worked": 0, "raised": 0}
    try:
        for _ in range(1000):
            call, positional, keywords = generator.choice(CALLS)
            positional, keywords = list(positional), dict(keywords)
            for _ in range(generator.choice([1, 1, 2])):
                place = generator.randrange(len(positional) + len(keywords) + 1)
                arguments = [*positional, *keywords.values(), None]
                is_spoilt = generator.random() > 0.1
                value = generator.choice(BAD)(generator) if is_spoilt else dressed(arguments[place], generator)
                if place < len(positional):
                    positional[place] = value
                elif place < len(positional) + len(keywords):
                    name = list(keywords)[place - len(positional)]
                    if name in LONG and isinstance(value, (int, float)) and 16 < value:
                        value = -value
                    keywords[name] = value
                else:
                    keywords[generator.choice(["x", "progress", "chatter", ""])] = value
            # Whatever is legal and long after all is stopped.
            deadline = time.monotonic() + 0.2

            def progress(done: int, total: int, deadline: float = deadline) -> None:
                if time.monotonic() > deadline:
                    raise Wrong

            if "progress" in keywords:
                keywords["progress"] = progress
            try:
                call(*positional, **keywords)
                outcomes["worked"] += 1
            except Exception as error:
                assert "defect" not in str(error), (call, positional, keywords)
                outcomes["raised"] += 1
    finally:
        bd.set_threads()
    assert outcomes["raised"] > 300, outcomes
    # About one in ten is legal after all: a fuzz of which everything fails at once would reach nothing.
    assert outcomes["worked"] > 50, outcomes


#: What `float()` or an index would take for a number, and is none.
NO_NUMBERS: list[Any] = [
    True,
    False,
    np.True_,
    np.bool_(False),
    "0.3",
    b"0.3",
    np.str_("0.3"),
    np.array("0.3"),
    np.array(b"0.3"),
    np.array(True),
    0.3 + 0j,
    np.complex128(0.3 + 2j),
    np.array(0.3 + 0j),
    np.array([0.3]),
    np.array([[0.3]]),
    np.zeros(0),
    np.timedelta64(1, "s"),
    np.datetime64("2020-01-01"),
    np.array(0.3, dtype=object),
    np.zeros((), dtype=[("a", "f8")]),
    np.ma.masked,
    np.ma.array(0.3, mask=True),
    [0.3],
    {},
    object(),
    float,
]


@pytest.mark.parametrize("value", NO_NUMBERS, ids=lambda value: f"{type(value).__name__}-{value!r}"[:40])
def test_what_is_no_real_number_is_a_type_error(value: Any) -> None:
    calls: list[Any] = [
        lambda: TOSS.replace(friction=value),
        lambda: MOTOR.replace(mass=value),
        lambda: bd.ImpactMap(axial_forcing=value, restitution=0.5),
        lambda: MAP.step(impact_phase=value, axial_impact_velocity=-1.0),
        lambda: bd.simulate(TOSS, gap=value),
        lambda: bd.ensemble(TOSS, members=3, duration=value),
        lambda: bd.best(MOTOR, over={"phase_lag": (0.0, 1.0)}, relative_error=value),
        lambda: bd.basins(MAP, phase_range=(0.0, value)),
        lambda: bd.System.from_dict({**TOSS.to_dict(), "disk": {**TOSS.to_dict()["disk"], "friction": value}}),
        lambda: bd.basins(MAP, known_orbits=[(ORBIT, value)]),
    ]  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for call in calls:
            with pytest.raises(TypeError):
                call()


@pytest.mark.parametrize(
    "value",
    [0.5, np.float64(0.5), np.float32(0.5), np.float16(0.5), np.longdouble(0.5), np.array(0.5), Fraction(1, 2),
     np.ma.array(0.5), Decimal("0.5"), 2, np.int8(2), np.uint64(2), np.array(2)],
    ids=lambda value: type(value).__name__,
)  # fmt: skip
def test_numbers_of_all_kinds_are_numbers(value: Any) -> None:
    assert TOSS.replace(friction=value).friction == float(value)


def test_integers_beyond_all_doubles_are_out_of_range() -> None:
    for number in (10**400, -(10**400)):
        with pytest.raises(bd.OutOfRangeError) as refused:
            TOSS.replace(friction=number)
        assert refused.value.field == "friction" and abs(refused.value.value) == np.inf


@pytest.mark.parametrize(
    "value", [True, np.True_, np.array(True), 1.0, 1.5, "1", None, [1], np.array([1, 2])], ids=repr
)
def test_what_is_no_count_is_a_type_error(value: Any) -> None:
    with pytest.raises(TypeError, match="recorded"):
        bd.orbit_diagram(axial_forcing=0.5, recorded=value, **STARTS)
    with pytest.raises(TypeError):
        bd.basins(MAP, phases=value)
    with pytest.raises(TypeError):
        bd.ensemble(TOSS, members=value, duration=0.01)


def test_an_error_of_the_number_itself_comes_through() -> None:
    class Broken:
        def __float__(self) -> float:
            raise LookupError("no value")

    with pytest.raises(LookupError, match="no value"):
        TOSS.replace(friction=Broken())


def test_pairs_are_tuples_or_lists_of_two() -> None:
    expected = bd.basins(MAP, phases=3, speeds=3, phase_range=(0.0, 0.5))
    listed: Any = [0, 0.5]
    assert bd.basins(MAP, phases=3, speeds=3, phase_range=listed) == expected
    assert bd.basins(MAP, phases=3, speeds=3, phase_range=np.array([0.0, 0.5])) == expected
    wrong: list[Any] = [(0.0,), (0.0, 0.5, 1.0), (), 1.0, None, "ab", {0.0, 1.0}, np.float64(1.0)]
    wrong += [kind(b"\0\1") for kind in (bytes, bytearray, memoryview)]
    for pair in wrong:
        with pytest.raises((TypeError, ValueError)):
            bd.basins(MAP, phases=3, speeds=3, phase_range=pair)


STATOR = {"mass": 0.05, "quality": 300.0}
LOAD = {"speeds": [0.0, 8.0], "torques": [0.0, 0.5]}
POINT = {"speed": 20.0, "speed_error": 9.0, "load_torque": 0.0}
RATED: dict[str, Any] = {"ranges": {"friction": (0.1, 0.3)}, "most_evaluations": 8, "most_impacts": 2000}


def rated(ranges: Any) -> bd.RatedFit:
    return bd.fit_rated_points(MOTOR.replace(friction=0.5), points=[POINT], **{**RATED, "ranges": ranges})


#: The cosine, which six samples resolve.
HEXAGON = [1.0, 0.5, -0.5, -1.0, -0.5, 0.5]

#: Calls of one number within a table or a list, and how an error names its place.
PLACES: list[tuple[str, Callable[[Any], object]]] = [
    ("stator.quality", lambda value: MOTOR.replace(stator={**STATOR, "quality": value})),
    ("load.inertia", lambda value: MOTOR.replace(mass=1e5, load={**LOAD, "inertia": value})),
    ("load.torques[1]", lambda value: MOTOR.replace(load={**LOAD, "torques": [0.0, value]})),
    ("contact.time", lambda value: MOTOR.replace(drive_frequency=1.0, contact={"time": value})),
    ("stator.quality", lambda value: TOSS.replace(stator={**STATOR, "quality": value})),
    ("height.sawtooth", lambda value: bd.Drive.sawtooth(value)),
    ("height.sampled[1]", lambda value: bd.Drive.sampled([1.0, value, -0.5, -1.0, -0.5, 0.5])),
    ("angle.sampled[5]", lambda value: bd.Drive.sampled(HEXAGON, [*HEXAGON[:5], value])),
    ("height.fourier[0][1]", lambda value: bd.Drive.fourier([(1.0, value)])),
    ("angle.pieces[1][0]", lambda value: bd.Drive(angle={"pieces": [(0.5, [1.0]), (value, [1.0])]})),
    ("start_phase", lambda value: bd.Drive(start_phase=value)),
    ("drive.height.sawtooth", lambda value: MAP.replace(drive={"height": {"sawtooth": value}})),
]

#: Calls of pairs and points, whose numbers need not be finite: the library judges them by their range.
PAIRS_AND_POINTS: list[tuple[str, Callable[[Any], object]]] = [
    ("points[1].speed", lambda value: bd.fit_rated_points(MOTOR, points=[POINT, {"speed": value}], **RATED)),
    ("ranges.friction[0]", lambda value: rated({"friction": (value, 0.9)})),
    ("ranges.friction[1]", lambda value: rated({"friction": [0.1, value]})),
    ("phase_range[1]", lambda value: bd.basins(MAP, phases=3, speeds=3, phase_range=(0.0, value))),
]

#: Calls of a list of numbers within a table.
LISTS: list[tuple[str, Callable[[Any], object]]] = [
    ("load.torques", lambda value: MOTOR.replace(load={**LOAD, "torques": value})),
    ("height.sampled", lambda value: bd.Drive.sampled(value)),
    ("angle.sampled", lambda value: bd.Drive(angle={"sampled": value})),
    ("height.pieces[0][1]", lambda value: bd.Drive.pieces([(1.0, value)])),
]

NO_NUMBER: list[Any] = ["0.5", b"0.5", True, np.True_, 0.5j, np.complex64(0.5), np.ma.masked, np.ma.array(0.5, mask=True)]
NO_NUMBER += [{"a": 0.5}, {0.5}, object(), np.str_("0.5")]
NOT_FINITE: list[Any] = [math.nan, math.inf, np.float32("nan"), np.array(-math.inf), 10**400]
NO_LIST: list[Any] = ["0, 1", b"01", {0.0, 1.0}, {"a": 0.5}, np.ma.array([0.0, 50.0], mask=[False, True])]
NO_LIST += [np.array([False, True]), np.array([0.0, 1j]), np.array(["0", "1"]), ["0", "1"], [0.0, True]]


@pytest.mark.parametrize(("place", "call", "value", "error"), [
    *((*row, value, TypeError) for row in PLACES + PAIRS_AND_POINTS for value in NO_NUMBER),
    *((*row, value, bd.OutOfRangeError) for row in PLACES for value in NOT_FINITE),
    *((*row, value, TypeError) for row in LISTS for value in NO_LIST),
    *((*row, 0.5, TypeError) for row in LISTS[:3]),
], ids=repr)  # fmt: skip
def test_what_tables_do_not_hold_is_refused_by_its_place(
    place: str, call: Callable[[Any], object], value: Any, error: type[Exception]
) -> None:
    with pytest.raises(error) as refused:
        call(value)
    text = str(refused.value)
    assert text.startswith((f"argument '{place}", f"{place} = ")), text
    assert "JSON" not in text and "f64" not in text and "float values" not in text
    if isinstance(refused.value, bd.OutOfRangeError):
        assert (refused.value.field, refused.value.range) == (place, "(-inf, inf)")


def test_ranges_are_a_table_of_known_names() -> None:
    with pytest.raises(ValueError, match="twist"):
        rated({"twist": (0.1, 0.2)})
    with pytest.raises(TypeError):
        rated([("friction", (0.1, 0.2))])


@pytest.mark.parametrize("row", PLACES + PAIRS_AND_POINTS, ids=lambda row: row[0])
def test_tables_hold_numbers_of_all_kinds(row: tuple[str, Callable[[Any], object]]) -> None:
    call, expected = row[1], row[1](0.5)
    half = [np.float64(0.5), np.float32(0.5), np.float16(0.5), np.array(0.5), np.ma.array(0.5), Fraction(1, 2), Decimal("0.5")]
    for value in half:
        assert call(value) == expected


@pytest.mark.parametrize("row", LISTS, ids=lambda row: row[0])
def test_tables_hold_lists_of_all_kinds(row: tuple[str, Callable[[Any], object]]) -> None:
    own = {"load.torques": [0.5, 0.5], "height.pieces[0][1]": [0.5]}.get(row[0], [0.5, 0.5, 0.5])
    call, expected = row[1], row[1](own)
    for kind in (tuple, np.array, np.ma.array, lambda row: np.array(row, np.float32), lambda row: np.repeat(row, 2)[::2], iter):
        assert call(kind(own)) == expected
    whole = [bd.Drive.sampled(kind([2, 1, -1, -2, -1, 1])) for kind in (list, np.array, lambda row: np.array(row, np.int8))]
    assert whole[0] == whole[1] == whole[2] == bd.Drive.sampled([2.0, 1.0, -1.0, -2.0, -1.0, 1.0])


def test_fields_of_tables_are_named_in_full() -> None:
    for place, call in (
        ("stator.quality", lambda: MOTOR.replace(stator={**STATOR, "quality": 0.1})),
        ("contact.time", lambda: MOTOR.replace(contact={"time": -1.0})),
        ("contact_time", lambda: bd.stall_load(MOTOR, contact_time=-1.0)),
    ):
        with pytest.raises(bd.OutOfRangeError) as refused:
            call()
        assert refused.value.field == place
    for wrong, told in (({"mas": 1.0}, "unknown field `mas`"), ({"kind": "twisted"}, "twisted")):
        with pytest.raises(bd.InvalidError, match=f"stator cannot be read: .*{told}"):
            MOTOR.replace(stator=wrong)
