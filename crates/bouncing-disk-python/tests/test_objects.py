"""Objects: equality, hashes, pickles, dictionaries, JSON and texts that cannot be read, representations."""

from __future__ import annotations

import contextlib
import copy
import dataclasses
import inspect
import json
import math
import pickle
from importlib import metadata
from typing import Any

import bouncing_disk as bd
import numpy as np
import pytest
from good_calls import MAP, MOTOR, STARTS, good

def everything() -> dict[str, Any]:
    """One of each kind of object: what the quick calls belong to and return, and the parts of it."""
    sheet = MOTOR.replace(friction=0.2)
    found: list[Any] = [bd.local_sensitivities(sheet, relative_error=0.1)]
    for call, positional, keywords in good():
        found.append(getattr(call, "__self__", None))
        with contextlib.suppress(bd.ComputationError, bd.FitRefusedError):
            returned = call(*positional, **keywords)
            found += returned if isinstance(returned, list) else [returned]
    kinds = {type(one).__name__: one for one in found if type(one).__module__.startswith("bouncing_disk")}
    parts = {"Attractor": kinds["Attractors"].all[1], "Bifurcation": kinds["Branch"].bifurcations[0]}
    return kinds | parts | {"Drive": bd.Drive.triangle()}


EVERYTHING = everything()


def test_every_kind_is_tried() -> None:
    # Those of calls that are not quick, and parts of results without a class of their own in a test.
    slow = {"Best", "StallLoad"}
    parts = {"Energy", "FailedPoint", "IntervalEstimate", "Result", "RiseEstimate", "SpecialPoint", "Spread"}
    parts |= {"AttractorSearch", "Continuation", "OperatingSettings"}
    kinds = {name for name in bd.__all__ if inspect.isclass(getattr(bd, name))}
    errors = {name for name in kinds if issubclass(getattr(bd, name), Exception)}
    assert kinds - errors - slow - parts - {"OperatingPoints"} == set(EVERYTHING)


@pytest.mark.parametrize("name", EVERYTHING)
def test_pickles_and_copies_are_equal(name: str) -> None:
    one = EVERYTHING[name]
    assert type(one).__name__ == name
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(one, protocol)) == one
    assert copy.deepcopy(one) == one
    assert copy.copy(one) == one
    assert not one != copy.copy(one)
    assert one != 1
    assert one != None  # noqa: E711


@pytest.mark.parametrize("name", EVERYTHING)
def test_representations_are_one_line(name: str) -> None:
    text = repr(EVERYTHING[name])
    assert name in text
    if name != "MotorReport":
        assert "\n" not in text
        assert len(text) < 2000

STATOR = {"kind": "axial", "mass": 0.05, "quality": 300.0}
VOLTS = {"mass": 0.05, "quality": 300, "resonance": 70e3, "volts": 10, "anti_resonance": 70.4e3, "capacitance": 1.2e-9}
LAYER = {"materials": ["steel", "polyimide"], "geometry": "layer", "area": 1e-5, "thickness": 1e-4, "roughness": 1e-7}
LOAD = {"speeds": [-5.0, 20.0], "torques": [0.0, 1e-7], "times": [1.0], "factors": [0.5], "inertia": 1e-8, "on": 0.0, "off": 2.0}

#: Motors and systems with each of the tables that files have, and drives of all shapes.
WITH_TABLES: dict[str, Any] = {
    "contact of a time": MOTOR.replace(contact={"time": 1e-6, "law": "hysteresis"}),
    "contact of materials": MOTOR.replace(contact=LAYER),
    "stator": MOTOR.replace(stator=STATOR),
    "stator in volts": MOTOR.replace(amplitude=None, stator=VOLTS),
    # Only a stator that yields is switched on and off.
    "load": MOTOR.replace(load={name: value for name, value in LOAD.items() if name not in ("on", "off")}),
    "drive": MOTOR.replace(drive=bd.Drive(height="triangle", angle={"fourier": [[1.0, 0.0], [0.1, 0.3]]})),
    "all": MOTOR.replace(contact={"time": 1e-6}, stator=STATOR, load=LOAD),
    "system with contact": MOTOR.replace(contact=LAYER).system,
    "system with stator": MOTOR.replace(stator=STATOR).system,
    "sawtooth": bd.Drive.sawtooth(0.3),
    "fourier": bd.Drive.fourier([(1.0, 0.0), (0.1, 0.5)], [(1.0, 0.2)]),
    "pieces": bd.Drive.pieces([(0.5, (0.0, 8.0, -16.0)), (0.5, (0.0, -8.0, 16.0))]),
    "sampled": bd.Drive.sampled(np.sin(2.0 * np.pi * np.arange(16) / 16)),
    "start phase": bd.Drive("cubics", start_phase=0.5),
    "map with drive": MAP.replace(drive={"height": "triangle"}),
    "map with both": MAP.replace(drive=bd.Drive.fourier([(1.0, 0.0), (0.1, 0.5)]), contact_periods=0.25),
}

PARAMETERS: list[Any] = [bd.System.motor(), MAP, MOTOR, bd.ChatterCut.paper(), *WITH_TABLES.values()]
STORED = ["PeriodicOrbit", "Attractors", "Branch", "Trajectory", "Crisis"]
READABLE: list[Any] = [*PARAMETERS, *(EVERYTHING[name] for name in STORED)]


@pytest.mark.parametrize("one", PARAMETERS, ids=lambda one: type(one).__name__)
def test_parameters_are_the_call_that_makes_them(one: Any) -> None:
    written = json.loads(one.to_json())
    for again in (
        eval(repr(one), vars(bd).copy()),
        type(one).from_dict(one.to_dict()),
        type(one).from_dict(written),
        type(one).from_json(one.to_json()),
        one.replace(),
        copy.copy(one),
        copy.deepcopy(one),
        pickle.loads(pickle.dumps(one)),
    ):
        assert again == one and hash(again) == hash(one) and repr(again) == repr(one)
        assert json.loads(again.to_json()) == written
    with pytest.raises(AttributeError):
        one.restitution = 0.1


@pytest.mark.parametrize("one", WITH_TABLES.values(), ids=list(WITH_TABLES))
def test_tables_are_kept_when_another_value_changes(one: Any) -> None:
    other = one.replace(**({"start_phase": 0.25} if isinstance(one, bd.Drive) else {"restitution": 0.375}))
    tables = {"contact", "stator", "load", "drive", "height", "angle"}
    own, changed = ({key: value for key, value in each.to_dict().items() if key in tables} for each in (one, other))
    assert own == changed and own
    # What a user does with the dictionary changes no object.
    before = repr(one)
    for table in one.to_dict().values():
        if isinstance(table, (dict, list)):
            table.clear()
    assert repr(one) == before


def test_a_system_keeps_what_its_calls_refuse() -> None:
    for system in (WITH_TABLES["system with stator"], WITH_TABLES["stator"].system):
        for again in (system, pickle.loads(pickle.dumps(system)), system.replace(friction=0.2)):
            with pytest.raises(bd.InvalidError) as refused:
                bd.simulate(again, events=3)
            assert refused.value.kind == "yielding-stator"
    assert len(set(PARAMETERS)) == len(PARAMETERS)


RESULTS = [name for name, one in EVERYTHING.items() if isinstance(one, bd.Result)]


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_written_as_json(name: str) -> None:
    one = EVERYTHING[name]
    written = json.loads(one.to_json(), parse_constant=lambda constant: pytest.fail(constant))
    if name in STORED:
        return  # As the library stores them.
    for field in dataclasses.fields(one):
        value, own = getattr(one, field.name), written[field.name]
        if isinstance(value, np.ndarray) and np.iscomplexobj(value):
            value = np.stack([value.real, value.imag], axis=-1)
        if isinstance(value, np.ndarray):
            again = np.array(own, dtype=float).reshape(value.shape)
            assert np.array_equal(again, np.where(np.isfinite(value), value, np.nan), equal_nan=True)
        elif isinstance(value, (str, int)) or value is None:
            assert own == value


def test_what_numbers_stand_for_is_in_the_json() -> None:
    verdicts = EVERYTHING["Verdicts"]
    written = json.loads(verdicts.to_json())
    assert [written["kinds"][kind] for kind in written["kind"]] == verdicts.names()
    basins = EVERYTHING["Basins"]
    assert json.loads(basins.to_json())["impact_map"] == basins.impact_map.to_dict()


#: Texts that are none of ours, whatever was to be read.
WRONG = {
    "nothing": "",
    "space": " \n",
    "an array": "[]",
    "null": "null",
    "a number": "1",
    "a text": '"x"',
    "true": "true",
    "NaN": "NaN",
    "an unknown key": '{"frikshun": 1.0}',
    "half": "{",
    "deep": "[" * 100_000,
    "deep objects": '{"platform":' * 100_000,
    "a control character": "\0",
    "half of a pair of surrogates": "\ud800",
}


@pytest.mark.parametrize("one", READABLE, ids=lambda one: type(one).__name__)
def test_texts_are_read_or_refused(one: Any) -> None:
    for wrong in WRONG.values():
        with pytest.raises(bd.InvalidError) as refused:
            type(one).from_json(wrong)
        assert refused.value.kind == "text" and str(refused.value)
        if wrong in ("", "{", "\0", "\ud800"):
            assert {"line", "position"} & set(refused.value.details), refused.value.details
    text = one.to_json().rstrip()
    assert type(one).from_json(text) == one == type(one).from_json(f" \n{text}\n")
    places = [len(text) // part for part in (2, 3, 5, 7)] + [len(text) - 1, 1]
    number = next(place for place in range(len(text)) if text[place : place + 2] in ("0.", "1.", "1e"))
    spoilt = [text[:place] for place in places]
    spoilt += [text + "x", text + text, text + "]"]
    spoilt += [text[:number] + other + text[number:] for other in ("NaN, ", "true, ", '"', "x")]
    for wrong in spoilt:
        with pytest.raises(bd.InvalidError) as refused:
            type(one).from_json(wrong)
        assert refused.value.kind == "text", wrong
    no_texts: list[Any] = [None, 1, b"{}", {}, object()]
    for none in no_texts:
        with pytest.raises(TypeError):
            type(one).from_json(none)


@pytest.mark.parametrize("key", ["friction", "restitution", "amplitude"])
@pytest.mark.parametrize("value", ["true", "null", '"0.5"', "[0.5]", "{}", "NaN", "Infinity"])
def test_what_is_no_number_in_a_system_is_named(key: str, value: str) -> None:
    toss = bd.System.pizza_toss()
    with pytest.raises(bd.InvalidError, match=value if value in ("NaN", "Infinity") else key):
        bd.System.from_json(toss.to_json().replace(f'"{key}": {getattr(toss, key)!r}', f'"{key}": {value}'))


def test_keys_that_are_missing_unknown_or_there_twice_are_refused() -> None:
    text, toss = MAP.to_json(), bd.System.pizza_toss()
    doubled = '{"restitution": 0.5, "restitution": 0.5}'
    for wrong in ("{}", text.replace("restitution", "axial_forcing"), doubled):
        with pytest.raises(bd.InvalidError):
            bd.ImpactMap.from_json(wrong)
    with pytest.raises(bd.InvalidError, match="friction"):
        bd.System.from_json(toss.to_json().replace('"friction": 0.6, ', ""))
    unknown: list[Any] = [{"plattform": {}}, {"platform": {"amplitud": 1.0}}, {"platform": 1}, {1: {}}, {}]
    for parameters in unknown:
        with pytest.raises((TypeError, ValueError)):
            bd.System.from_dict(parameters)
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.ImpactMap.from_json('{"axial_forcing": 0.5, "restitution": 1.5}')
    assert (refused.value.field, refused.value.value) == ("restitution", 1.5)


def test_results_differ_where_a_field_does() -> None:
    one = EVERYTHING["OrbitDiagram"]
    other = bd.orbit_diagram(axial_forcing=[0.3, 0.57], **STARTS)
    assert one != other
    with pytest.raises(TypeError):
        hash(one)
    with pytest.raises(AttributeError):
        one.offsets = None


def test_a_changed_parameter_is_another_system() -> None:
    toss = bd.System.pizza_toss()
    assert toss.replace(friction=0.05) != toss
    assert toss.replace(friction=0.05).replace(friction=toss.friction) == toss
    assert toss.replace() == toss
    assert len({toss, toss.replace(), toss.replace(friction=0.05)}) == 2
    with pytest.raises(TypeError):
        toss.replace(frikshun=1.0)
    with pytest.raises(bd.OutOfRangeError) as refused:
        toss.replace(restitution=1.0)
    assert (refused.value.field, refused.value.value, refused.value.range) == ("restitution", 1.0, "[0, 1)")


def test_minus_zero_hashes_as_zero() -> None:
    toss = bd.System.pizza_toss()
    assert toss.replace(phase_lag=-0.0) == toss.replace(phase_lag=0.0)
    assert hash(toss.replace(phase_lag=-0.0)) == hash(toss.replace(phase_lag=0.0))


def test_maps_of_either_parameter() -> None:
    for forcing in np.linspace(0.01, 3.0, 300):
        one = bd.ImpactMap(axial_forcing=forcing, restitution=0.5)
        assert one.axial_forcing == forcing
        assert pickle.loads(pickle.dumps(one)).axial_forcing == forcing
        other = bd.ImpactMap(peak_acceleration=one.peak_acceleration, restitution=0.5)
        assert other == one and hash(other) == hash(one)
        assert pickle.loads(pickle.dumps(other)) == one
    # What only turns the platform, and a sine by its name, change no vertical motion; nor is more than the sine stored.
    assert MAP == MAP.replace(drive=bd.Drive()) == MAP.replace(drive={"angle": "triangle"}) != WITH_TABLES["map with both"]
    assert repr(MAP) == "ImpactMap(axial_forcing=0.45, restitution=0.5)"
    assert MAP.to_json() == '{"axial_forcing": 0.45, "restitution": 0.5}'
    with pytest.raises(bd.InvalidError) as refused:
        bd.ImpactMap(restitution=0.5)
    assert refused.value.kind == "neither-given"
    with pytest.raises(bd.InvalidError) as refused:
        bd.ImpactMap(axial_forcing=0.5, peak_acceleration=1.0, restitution=0.5)
    assert refused.value.kind == "both-given"


def test_the_map_of_a_system_is_its_vertical_motion() -> None:
    toss = bd.System.pizza_toss()
    own = bd.ImpactMap.of_system(toss)
    assert own.peak_acceleration == toss.peak_acceleration
    assert math.isclose(own.axial_forcing, toss.axial_forcing, rel_tol=1e-15)
    tables: dict[str, Any] = {"soft-contact": {"contact": {"time": 0.01}}, "yielding-stator": {"stator": STATOR}}
    for kind, table in tables.items():
        with pytest.raises(bd.InvalidError) as refused:
            bd.ImpactMap.of_system(toss.replace(**table))
        assert refused.value.kind == kind


def test_data_sheets_that_are_wrong_say_where() -> None:
    with pytest.raises(bd.InvalidError, match="line 2"):
        bd.Motor.from_json('{\n  "drive_frequenzy": 1.0\n}')
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.Motor.from_json(MOTOR.to_json().replace('"restitution": 0.5', '"restitution": 1.5'))
    assert refused.value.field == "restitution"
    with pytest.raises(bd.InvalidError) as invalid:
        MOTOR.replace(density=1e3, mass=1e-3)
    assert invalid.value.kind == "both-given"


@pytest.mark.parametrize(
    "error",
    [
        bd.OutOfRangeError("a = 1.0", "a", 1.0, "[2, 3]"),
        bd.TooLargeError("no room", "cells", 3, 2),
        bd.InvalidError("both", "both-given", {"one": "a"}),
        bd.FitRefusedError("the curve is not fitted"),
        bd.ComputationError("not settled", "not-settled", {"residual": 1.0}),
    ],
    ids=lambda error: type(error).__name__,
)
def test_errors_pickle_with_their_numbers(error: bd.BouncingDiskError) -> None:
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert vars(again) == vars(error)
    assert str(again) == str(error) == error.args[0]
    assert isinstance(error, (ValueError, RuntimeError))


def test_the_version_is_that_of_the_package() -> None:
    assert bd.__version__ == metadata.version("bouncing-disk")
