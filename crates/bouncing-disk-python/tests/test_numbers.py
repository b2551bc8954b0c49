"""What counts as one real number, and as a pair of them."""

from __future__ import annotations

import warnings
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd
from good_calls import MAP, MOTOR, TOSS

ORBIT: Any = MAP.settled_orbit(impact_phase=1.2, normalised_speed=1.3)

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
        lambda: bd.transient(TOSS, duration=value),
        lambda: bd.operating_point(MOTOR, load_torque=value),
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
    [0.5, np.float64(0.5), np.float32(0.5), np.float16(0.5), np.longdouble(0.5), np.array(0.5), Fraction(1, 2), Decimal("0.5")],
    ids=lambda value: type(value).__name__,
)  # fmt: skip
def test_numbers_of_all_kinds_are_numbers(value: Any) -> None:
    assert TOSS.replace(friction=value).friction == 0.5
    unmasked: Any = np.ma.array(0.5)
    assert TOSS.replace(friction=unmasked).friction == 0.5


@pytest.mark.parametrize("value", [2, np.int8(2), np.uint64(2), np.array(2)])
def test_integers_are_numbers(value: Any) -> None:
    assert TOSS.replace(friction=value).friction == 2.0


def test_integers_beyond_all_doubles_are_out_of_range() -> None:
    for number in (10**400, -(10**400)):
        with pytest.raises(bd.OutOfRangeError) as refused:
            TOSS.replace(friction=number)
        assert refused.value.field == "friction" and abs(refused.value.value) == np.inf


@pytest.mark.parametrize("value", [True, np.True_, np.array(True), 1.0, "1", None])
def test_what_is_no_count_is_a_type_error(value: Any) -> None:
    with pytest.raises(TypeError):
        bd.basins(MAP, phases=value)
    with pytest.raises(TypeError):
        bd.transients(TOSS, seeds=[value], duration=0.01)


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
    wrong: list[Any] = [(0.0,), (0.0, 0.5, 1.0), (), 1.0, None, "ab", {0.0, 1.0}, np.float64(1.0)]
    for pair in wrong:
        with pytest.raises((TypeError, ValueError)):
            bd.basins(MAP, phases=3, speeds=3, phase_range=pair)
