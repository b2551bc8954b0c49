"""Texts that cannot be read: always an `InvalidError`, which says where."""

from __future__ import annotations

from typing import Any

import pytest

import bouncing_disk as bd
from good_calls import MAP, MOTOR, TOSS

ORBIT = MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
assert ORBIT is not None
OBJECTS: list[Any] = [
    TOSS,
    MAP,
    MOTOR,
    bd.ChatterCut.paper(),
    ORBIT,
    bd.toss_trajectory(TOSS),
    bd.attractors(MAP, starts=16, impacts=64),
    bd.basin_fractions_over(restitution=0.5, axial_forcing=[0.34, 0.36], starts=16, impacts=64),
    bd.continued(MAP, ORBIT, parameter_range=(0.4, 0.5), max_points=5),
]

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


@pytest.mark.parametrize("one", OBJECTS, ids=lambda one: type(one).__name__)
@pytest.mark.parametrize("wrong", WRONG)
def test_what_is_no_text_of_ours_says_where(one: Any, wrong: str) -> None:
    with pytest.raises(bd.InvalidError) as refused:
        type(one).from_json(WRONG[wrong])
    assert refused.value.kind == "text"
    assert {"line", "field", "position"} & set(refused.value.details), refused.value.details


@pytest.mark.parametrize("one", OBJECTS, ids=lambda one: type(one).__name__)
def test_spoilt_texts_are_refused(one: Any) -> None:
    text = one.to_json().rstrip()
    assert type(one).from_json(text) == one
    assert type(one).from_json(f" \n{text}\n") == one
    places = [len(text) // part for part in (2, 3, 5, 7)] + [len(text) - 1, 1]
    number = next(place for place in range(len(text)) if text[place : place + 2] in ("0.", "1."))
    spoilt = [text[:place] for place in places]
    spoilt += [text + "x", text + text, text + "]"]
    spoilt += [text[:number] + other + text[number:] for other in ("NaN, ", "true, ", '"', "x")]
    for wrong in spoilt:
        with pytest.raises(bd.InvalidError) as refused:
            type(one).from_json(wrong)
        assert refused.value.kind == "text", wrong


@pytest.mark.parametrize("key", ["friction", "restitution", "amplitude"])
@pytest.mark.parametrize("value", ["true", "null", '"0.5"', "[0.5]", "{}", "NaN", "Infinity", "1e999"])
def test_what_is_no_number_in_a_system_says_where(key: str, value: str) -> None:
    number = getattr(TOSS, key)
    with pytest.raises(bd.InvalidError) as refused:
        bd.System.from_json(TOSS.to_json().replace(f'"{key}": {number!r}', f'"{key}": {value}'))
    assert refused.value.details["line"] == 1 and int(refused.value.details["column"]) > 10


def test_a_key_that_is_missing_or_there_twice_is_told() -> None:
    text = MAP.to_json()
    for wrong in (
        "{}",
        text.replace("restitution", "axial_forcing"),
        '{"restitution": 0.5, "restitution": 0.5}',
    ):
        with pytest.raises(bd.InvalidError):
            bd.ImpactMap.from_json(wrong)
    with pytest.raises(bd.InvalidError, match="friction"):
        bd.System.from_json(TOSS.to_json().replace('"friction": 0.6, ', ""))


def test_numbers_outside_of_their_range_are_no_unreadable_texts() -> None:
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.System.from_json(TOSS.to_json().replace('"restitution": 0.5', '"restitution": 1.5'))
    assert (refused.value.field, refused.value.value) == ("disk.restitution", 1.5)
    with pytest.raises(bd.OutOfRangeError) as refused:
        bd.ImpactMap.from_json('{"axial_forcing": 0.5, "restitution": 1.5}')
    assert refused.value.field == "restitution"


@pytest.mark.parametrize("one", OBJECTS, ids=lambda one: type(one).__name__)
@pytest.mark.parametrize("wrong", [None, 1, b"{}", {}, object()])
def test_what_is_no_text_is_a_type_error(one: Any, wrong: Any) -> None:
    with pytest.raises(TypeError):
        type(one).from_json(wrong)
