"""Seams: nothing, one, NaN, infinity, denormal and huge numbers, wrong types and shapes, arrays of all kinds."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd
from good_calls import MAP, MOTOR, STARTS, TOSS, good


def test_nothing_and_one_are_numbers_of_orbits() -> None:
    nothing = bd.orbit_diagram(axial_forcing=[], **STARTS)
    assert nothing.offsets.tolist() == [0]
    assert len(nothing.impact_phase) == 0 and len(nothing.column()) == 0
    assert bd.verdicts(axial_forcing=[], **STARTS).names() == []
    assert bd.lyapunov_exponents(axial_forcing=np.array([]), **STARTS).shape == (0,)
    one = bd.orbit_diagram(axial_forcing=0.45, recorded=1, **STARTS)
    assert one.offsets.tolist() == [0, 1]
    assert one == bd.orbit_diagram(axial_forcing=[0.45], recorded=1, **STARTS)
    assert bd.orbit_diagram(axial_forcing=0.45, recorded=0, **STARTS).offsets.tolist() == [0, 0]
    assert bd.transients([], duration=0.01, intervals=5).speeds.shape == (5, 0)


def test_a_disk_that_rests_for_ever_has_fewer_impacts() -> None:
    resting = bd.orbit_diagram(axial_forcing=[0.2, 0.45], recorded=10, **STARTS)
    assert np.diff(resting.offsets).tolist() == [0, 10]


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, -1.0, 1e300])
@pytest.mark.parametrize("field", ["axial_forcing", "restitution"])
def test_numbers_outside_their_range_are_told(field: str, value: float) -> None:
    for call in (bd.orbit_diagram, bd.verdicts, bd.lyapunov_exponents):
        with pytest.raises(bd.OutOfRangeError) as refused:
            call(**{"axial_forcing": 0.5, **STARTS, field: [0.4, value]})
        assert refused.value.field == field
        assert refused.value.value == value or np.isnan(value)


@pytest.mark.parametrize("value", [5e-324, 2.2e-308, 1e-300])
def test_denormal_numbers_are_numbers(value: float) -> None:
    assert bd.verdicts(axial_forcing=value, **STARTS).names() == ["at-rest"]
    assert bd.ImpactMap(axial_forcing=value, restitution=0.5).restitution == 0.5
    with pytest.raises(bd.InvalidError, match="follows from .*contact_radius"):
        TOSS.replace(contact_radius=value)


def test_counts_that_are_none_are_told() -> None:
    for count in (-1, -(2**70), 2**70, 2**64):
        for call in (
            lambda count=count: bd.orbit_diagram(axial_forcing=0.5, recorded=count, **STARTS),
            lambda count=count: bd.basins(MAP, phases=count),
            lambda count=count: bd.transient(TOSS, intervals=count),
            lambda count=count: MAP.period_one(platform_periods=count),
        ):
            with pytest.raises(bd.OutOfRangeError) as refused:
                call()
            assert refused.value.value == pytest.approx(float(count))
    no_counts: list[Any] = [1.0, 1.5, "1", None, [1], np.array([1, 2])]
    for none in no_counts:
        with pytest.raises(TypeError):
            bd.orbit_diagram(axial_forcing=0.5, recorded=none, **STARTS)
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
    kinds: list[Any] = [
        (0.5, 0.25, 0.5),
        contiguous,
        read_only,
        np.array([0.5, 9.0, 0.25, 9.0, 0.5])[::2],
        contiguous[::-1],
        np.asfortranarray(np.array([[0.5, 1.0], [0.25, 1.0], [0.5, 1.0]]))[:, 0],
        contiguous.astype(">f8"),
        contiguous.astype(np.float32),
        contiguous.astype(np.float16),
        contiguous.astype(np.longdouble),
        np.array([0.5, 0.25, 0.5, 0.0])[:3],
        np.lib.stride_tricks.as_strided(
            np.frombuffer(b"\0" + contiguous.tobytes(), np.uint8)[1:].view()
        ).view("f8"),
    ]
    for kind in kinds:
        assert bd.orbit_diagram(axial_forcing=kind, **STARTS) == expected
    assert read_only.tolist() == [0.5, 0.25, 0.5]
    whole = bd.verdicts(axial_forcing=np.array([1], dtype=np.uint8), impacts=64, **STARTS)
    assert whole.axial_forcing.tolist() == [1.0]


@pytest.mark.parametrize(
    "value",
    [
        "0.5",
        b"0.5",
        None,
        [None],
        ["a"],
        1j,
        [1j],
        [True],
        {},
        {0.5},
        object(),
        [object()],
        np.array("x"),
        lambda: 0,
    ],
    ids=repr,
)
def test_what_is_no_number_is_a_type_error(value: object) -> None:
    with pytest.raises(TypeError):
        bd.orbit_diagram(axial_forcing=value, **STARTS)  # type: ignore[arg-type]


@pytest.mark.parametrize("value", [[[0.5]], np.zeros((2, 2, 2)), np.zeros((0, 3)), [0.5, [0.5]]], ids=repr)
def test_arrays_of_other_shapes_are_value_errors(value: Any) -> None:
    with pytest.raises(ValueError):
        bd.orbit_diagram(axial_forcing=value, **STARTS)


def test_lengths_that_differ_are_told_by_name() -> None:
    with pytest.raises(ValueError, match="axial_forcing and impact_phase .* 2 and 3"):
        bd.orbit_diagram(
            axial_forcing=[0.4, 0.5], restitution=0.5, impact_phase=[1, 2, 3], normalised_speed=1.3
        )


def test_an_array_of_the_caller_is_not_kept() -> None:
    forcings = np.array([0.4, 0.5])
    found = bd.orbit_diagram(axial_forcing=forcings, **STARTS)
    forcings[:] = 7.0
    assert found.axial_forcing.tolist() == [0.4, 0.5]


def test_names_that_are_unknown_are_told() -> None:
    with pytest.raises(ValueError, match="initial_spin"):
        bd.single_toss(TOSS, initial_spin="rest")  # type: ignore[arg-type]
    orbit = MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    with pytest.raises(ValueError, match="parameter"):
        bd.continued(MAP, orbit, parameter="friction", parameter_range=(0.1, 0.6))  # type: ignore[arg-type]


def test_computations_without_a_result_say_why() -> None:
    with pytest.raises(bd.ComputationError) as failed:
        bd.single_toss(TOSS.replace(amplitude=0.001))
    assert failed.value.kind == "never-leaves"
    assert 0.0 < failed.value.details["peak_acceleration"] < 1.0  # type: ignore[operator]
    with pytest.raises(bd.FitRefusedError):
        bd.fit_transients(times=np.linspace(0.1, 1.0, 50), speeds=np.zeros((50, 8)))
    with pytest.raises(bd.ComputationError, match="does not attract"):
        saddle = bd.periodic_orbits(MAP, max_impacts=1, max_platform_periods=1)[-1]
        bd.basins(MAP, phases=3, speeds=3, known_orbits=[saddle])


# What a fuzzed call is given in place of a good argument.
BAD: list[Callable[[random.Random], Any]] = [
    lambda r: None,
    lambda r: r.choice(["", "x", "0.5", "axial_forcing", b"\0", "\0", "\ud800"]),
    lambda r: r.choice([np.nan, np.inf, -np.inf, 0.0, -0.0, 5e-324, -1e300, 1.7e308, 1e-300]),
    lambda r: r.choice([0, -1, 1, 2**31, 2**32, 2**63, 2**64, -(2**63), 10**400]),
    lambda r: r.random() * 10.0 ** r.randint(-12, 12),
    lambda r: [],
    lambda r: [r.random() for _ in range(r.randint(0, 4))],
    lambda r: [[1.0, 2.0], [3.0]],
    lambda r: np.array([r.choice([np.nan, np.inf, -1.0, 0.5]) for _ in range(r.randint(0, 3))]),
    lambda r: np.zeros((r.randint(0, 3),) * r.randint(0, 4)),
    lambda r: np.arange(12.0).reshape(3, 4)[:, :: r.choice([-1, 2])],
    lambda r: np.array(["a", None, 1.0], dtype=object),
    lambda r: np.array([1 + 1j]),
    lambda r: np.array(["2020-01-01"], dtype="datetime64[D]"),
    lambda r: np.ma.masked_array([1.0, 2.0], mask=[True, False]),
    lambda r: np.float32(r.random()),
    lambda r: np.zeros(3, dtype=[("a", "f8")]),
    lambda r: (0.0, 1.0),
    lambda r: (1.0, 0.0, 2.0),
    lambda r: {},
    lambda r: object(),
    lambda r: bd.System,
    lambda r: TOSS,
    lambda r: MAP,
    lambda r: MOTOR,
    lambda r: bd.ChatterCut.paper(),
    lambda r: True,
    lambda r: 1j,
    lambda r: iter([1.0]),
    lambda r: lambda *numbers: None,
    lambda r: memoryview(b"abc"),
]


# Arguments that make a legal call long, which no fuzz may pass: their seams are tested above.
LONG = {
    "transient", "recorded", "impacts", "most", "phases", "speeds", "max_impacts", "max_platform_periods", "starts",
    "transient_impacts", "examined_impacts", "events", "duration", "intervals", "members", "most_impacts", "samples",
    "count", "max_points", "longest_period", "cells", "resamples", "relative_error", "first_step",
    "points", "rows", "arclength", "orbits",
}  # fmt: skip


# What a good number or a good array of numbers is as good as.
NUMBERS: list[Callable[[Any], Any]] = [
    np.float64,
    lambda number: np.array(number),
    lambda number: np.array([number])[0],
]
ARRAYS: list[Callable[[Any], Any]] = [
    list,
    tuple,
    lambda array: np.repeat(array, 2)[::2],
    lambda array: np.array(array[::-1])[::-1],
    lambda array: np.asfortranarray(array),
    lambda array: np.array(array, dtype=">f8"),
    lambda array: np.frombuffer(np.array(array).tobytes()),  # It is read-only.
]


def dressed(value: Any, generator: random.Random) -> Any:
    """The same value as another type, or in another layout, where it is a float or a row of floats."""
    if type(value) is float:
        return generator.choice(NUMBERS)(value)
    if isinstance(value, list) and value and all(type(one) is float for one in value):
        value = np.array(value)
    row = isinstance(value, np.ndarray) and value.dtype == np.float64 and value.ndim == 1
    return generator.choice(ARRAYS)(value) if row else value


def test_good_calls_work_with_numbers_and_arrays_of_any_kind() -> None:
    generator = random.Random(11)
    tried = 0
    for call, positional, keywords in good():
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
    calls = good()
    outcomes = {"worked": 0, "raised": 0}
    try:
        for _ in range(1000):
            call, positional, keywords = generator.choice(calls)
            positional, keywords = list(positional), dict(keywords)
            for _ in range(generator.choice([1, 1, 2])):
                place = generator.randrange(len(positional) + len(keywords) + 1)
                arguments = [*positional, *keywords.values(), None]
                spoilt = generator.random() > 0.1
                value = generator.choice(BAD)(generator) if spoilt else dressed(arguments[place], generator)
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


def test_an_orbit_with_strong_shear_has_a_radius_in_which_starts_end_on_it() -> None:
    # Four impacts in two periods, beside period 1 at the forcing of Fig. 7(b).
    bouncing = bd.ImpactMap(axial_forcing=0.486, restitution=0.5)
    orbits = bd.periodic_orbits(bouncing, max_impacts=4, max_platform_periods=2)
    stable = [orbit for orbit in orbits if orbit.is_stable]
    assert sorted(orbit.period for orbit in stable) == [1, 4]
    found = bd.basins(bouncing, phases=30, speeds=30, speed_range=(0.0, 5.0), known_orbits=stable)
    all_found = bd.attractors(bouncing).basins(phases=30, speeds=30, speed_range=(0.0, 5.0))
    assert len(np.unique(found.labels)) == 3
    # The orbits come in another order.
    assert [(found.labels == label).sum() for label in (1,)] == [(all_found.labels == 1).sum()]


def test_masked_values_are_refused() -> None:
    times = np.linspace(0.01, 5.0, 200)
    speeds: Any = np.ma.array(30.0 * (1.0 - np.exp(-times / 0.8)))
    expected = bd.fit_exponential(times=times, speeds=speeds.data).steady_speed
    assert bd.fit_exponential(times=times, speeds=speeds).steady_speed == expected
    speeds[50] = np.ma.masked
    with pytest.raises(TypeError, match="masked values"):
        bd.fit_exponential(times=times, speeds=speeds)
    with pytest.raises(TypeError, match="masked values"):
        bd.orbit_diagram(
            axial_forcing=np.ma.array([0.45, 0.5], mask=[True, False]),
            restitution=0.5,
            impact_phase=1.2,
            normalised_speed=1.3,
        )
