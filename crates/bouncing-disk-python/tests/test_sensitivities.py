"""What a motor depends on, and maps over its parameters: that arguments and results go where they belong."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd
from good_calls import MOTOR

LOOSE: dict[str, Any] = {"relative_error": 0.05}


def test_a_map_has_the_operating_points_of_its_cells() -> None:
    loads = np.array([0.0, 0.5, 1.5]) * MOTOR.largest_torque
    found = bd.motor_map(MOTOR, axes={"friction": [0.1, 0.2], "load_torque": loads}, **LOOSE)
    assert found.motor == MOTOR and list(found.axes) == ["friction", "load_torque"]
    assert np.array_equal(found.axes["load_torque"], loads)
    assert found.speed.shape == found.status.shape == found.impacts.shape == (2, 3)
    assert np.array_equal(found.load_torque, np.tile(loads, (2, 1)))
    assert found.names() == [["steady", "steady", "runaway"], ["steady", "steady", "steady"]]
    assert (
        found.speed[0, 0] > found.speed[0, 1]
        and np.isnan(found.speed[0, 2])
        and found.acceleration[0, 2] < 0.0
    )
    one = bd.operating_point(MOTOR, **LOOSE)
    assert abs(found.speed[0, 0] - one.speed) < 6.0 * np.hypot(found.speed_error[0, 0], one.speed_error) + 0.5
    line = bd.motor_map(MOTOR, axes={"amplitude": [1e-8]}, **LOOSE)
    assert line.speed.shape == (1,) and line.names() == [["steady"]]


def test_axes_that_are_refused_name_the_argument() -> None:
    outside: list[dict[str, list[float]]] = [
        {},
        {"friction": [0.1], "mass": [1e-3], "amplitude": [1e-8]},
        {"friction": [np.nan]},
    ]
    for axes in outside:
        with pytest.raises(bd.OutOfRangeError) as refused:
            bd.motor_map(MOTOR, axes=axes, **LOOSE)
        assert refused.value.field == "axes"
    kinds = []
    unfitting: list[dict[str, list[float]]] = [
        {"friction": []},
        {"mass": [1e-3], "density": [8e3]},
        {"amplitude": [1e308]},
    ]
    for axes in unfitting:
        with pytest.raises(bd.InvalidError) as invalid:
            bd.motor_map(MOTOR, axes=axes, **LOOSE)
        kinds.append(invalid.value.kind)
    assert kinds == ["empty-axis", "both-given", "out-of-range-together"]
    with pytest.raises(ValueError, match="frikshun.*drive_frequency"):
        bd.motor_map(MOTOR, axes={"frikshun": [0.1]}, **LOOSE)
    with pytest.raises(ValueError, match="friction must be a 1-d array"):
        bd.motor_map(MOTOR, axes={"friction": 0.1}, **LOOSE)
    with pytest.raises(bd.TooLargeError):
        bd.motor_map(MOTOR, axes={"friction": np.full(1000, 0.1), "phase_lag": np.zeros(1000)}, **LOOSE)


def test_local_sensitivities_are_those_of_the_speed() -> None:
    found = bd.local_sensitivities(MOTOR, parameters=["peak_angular_speed", "friction"], **LOOSE)
    assert found.parameters == ("peak_angular_speed", "friction") and found.quantity == "steady-speed"
    assert found.derivative[0] > 0.7 and abs(found.derivative[1]) < 0.5
    assert found.method == ("shared-motion", "shared-motion") and found.traps.tolist() == [0, 0]
    drawn = bd.local_sensitivities(
        MOTOR, parameters=["amplitude"], points=5, half_range=0.1, relative_error=0.1
    )
    assert drawn.method == ("regression",) and np.isfinite(drawn.derivative).all()
    assert bd.local_sensitivities(MOTOR, parameters=[], **LOOSE).derivative.shape == (0,)
    stall = bd.local_sensitivities(
        MOTOR, parameters=["friction"], quantity="stall-torque", relative_error=0.1
    )
    assert stall.quantity == "stall-torque" and stall.derivative[0] > 0.3


def test_shares_of_the_variance_and_effects_agree() -> None:
    ranges = {"peak_angular_speed": (20.0, 40.0), "friction": (0.1, 0.11)}
    shares = bd.sobol_indices(MOTOR, ranges=ranges, rows=24, **LOOSE)
    assert shares.parameters == ("peak_angular_speed", "friction")
    assert shares.total[0] > 0.8 > 0.2 > shares.total[1]
    effects = bd.elementary_effects(MOTOR, ranges=ranges, rows=8, **LOOSE)
    assert effects.mean[0] > 5.0 * effects.mean_size[1] and (effects.mean_size >= np.abs(effects.mean)).all()
    assert shares == bd.sobol_indices(MOTOR, ranges=ranges, rows=24, **LOOSE)
    assert shares != bd.sobol_indices(MOTOR, ranges=ranges, rows=24, sampling_seed=2, **LOOSE)


def test_what_sensitivities_refuse() -> None:
    for call in (bd.sobol_indices, bd.elementary_effects):
        with pytest.raises(bd.OutOfRangeError) as refused:
            call(MOTOR, ranges={"friction": (0.2, 0.1)}, rows=8, **LOOSE)
        assert refused.value.field == "ranges"
        with pytest.raises(bd.OutOfRangeError) as refused:
            call(MOTOR, ranges={}, rows=8, **LOOSE)
        assert refused.value.field == "ranges"
        with pytest.raises(bd.OutOfRangeError) as refused:
            call(MOTOR, ranges={"friction": (0.1, 0.2)}, rows=7, **LOOSE)
        assert (refused.value.field, refused.value.value) == ("rows", 7.0)
        with pytest.raises(ValueError, match="twist"):
            call(MOTOR, ranges={"twist": (0.1, 0.2)}, rows=8, **LOOSE)
        pairs: Any = [("friction", (0.1, 0.2))]
        with pytest.raises(TypeError):
            call(MOTOR, ranges=pairs, rows=8, **LOOSE)
    wrong: Any = "friction"
    with pytest.raises(TypeError, match="one text"):
        bd.local_sensitivities(MOTOR, parameters=wrong, **LOOSE)
    with pytest.raises(ValueError, match="quantity"):
        bd.local_sensitivities(MOTOR, quantity="torque", **LOOSE)  # type: ignore[arg-type]
