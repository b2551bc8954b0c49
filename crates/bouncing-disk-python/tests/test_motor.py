"""Motors from their data sheet to fitted parameters and sensitivities: that arguments and results go where they belong."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bouncing_disk as bd
import numpy as np
import pytest

from good_calls import MAP, MOTOR


def test_a_setting_that_is_none_is_refused() -> None:
    misspelt: dict[str, Any] = {"relative_eror": 0.1}
    with pytest.raises(TypeError, match="unexpected keyword argument 'relative_eror'"):
        bd.stall_load(MOTOR, **misspelt)
    misspelt = {"stars": 4}
    with pytest.raises(TypeError, match="unexpected keyword argument 'stars'"):
        bd.attractors(MAP, **misspelt)


def test_a_data_sheet_is_its_system() -> None:
    system = bd.System.motor()
    assert MOTOR.system == system
    assert MOTOR.largest_torque == pytest.approx(0.1 * 1e-3 * 9.8 * 1.25e-3)
    assert MOTOR.inertia == pytest.approx(1e-3 * 6.3e-3**2)
    loaded = MOTOR.replace(load_torque=1e-7).system
    assert loaded.load_acceleration == pytest.approx(1e-7 / MOTOR.inertia)
    assert loaded == system.replace(load_acceleration=loaded.load_acceleration)
    same = MOTOR.replace(peak_angular_speed=None, twist_amplitude=system.twist_amplitude)
    assert same.peak_angular_speed == pytest.approx(30.0)
    # A value takes the place of its alternative, as on the command line.
    assert MOTOR.replace(twist_amplitude=system.twist_amplitude) == same
    pressed = MOTOR.replace(preload_force=0.02)
    assert pressed.preload_acceleration == 0.02 / 1e-3
    assert pressed.replace(mass=2e-3).preload_acceleration == 0.01 / 1e-3
    with pytest.raises(bd.InvalidError, match="preload_force"):
        MOTOR.replace(preload_force=0.02, preload_acceleration=20.0)


def test_loads_and_stators_that_do_not_fit_are_invalid() -> None:
    with pytest.raises(bd.InvalidError, match="need the same length"):
        MOTOR.replace(load={"speeds": [0.0, 1.0], "torques": [1e-6]})
    with pytest.raises(bd.InvalidError, match="force_per_volt") as volts:
        MOTOR.replace(amplitude=None, stator={"mass": 0.05, "quality": 300.0, "volts": 20.0})
    assert volts.value.kind == "no-force-per-volt"
    with pytest.raises(bd.InvalidError, match="load.off") as switched:
        bd.ensemble(MOTOR.replace(load={"speeds": [0.0], "torques": [0.0], "off": 1.0}), members=2, duration=0.02, intervals=4)
    assert switched.value.kind == "switched-motion"


def test_a_report_tells_what_is_known_before_anything_turns() -> None:
    report = MOTOR.report()
    assert report.axial_forcing == MOTOR.system.axial_forcing
    assert report.angular_forcing == MOTOR.system.angular_forcing
    assert report.regime in ("long-chattering", "chaotic")
    assert report.warnings == ()
    assert str(report) == report.text and "\n" in report.text
    resting = MOTOR.replace(amplitude=1e-12).report()
    assert resting.regime == "no-lift-off" and resting.periods_per_flight is None
    # Radii in millimetres.
    assert len(MOTOR.replace(contact_radius=1.25, gyration_radius=6.3).report().warnings) == 2


def test_a_curve_falls_from_the_speed_without_load_to_stall() -> None:
    stall = bd.stall_load(MOTOR, relative_error=0.05)
    assert stall.bracket[0] < stall.torque < stall.bracket[1]
    assert stall.share == pytest.approx(stall.torque / MOTOR.largest_torque)
    loads = np.array([0.0, 0.5 * stall.torque, 2.0 * MOTOR.largest_torque])
    curve = bd.torque_speed_curve(MOTOR, load_torques=loads, relative_error=0.05)
    assert curve.load_torque.tolist() == loads.tolist()
    assert curve.names() == ["steady", "steady", "runaway"]
    assert curve.speed[0] > curve.speed[1] > 0.0
    errors = curve.speed_error[0] + stall.no_load_speed_error
    assert abs(curve.speed[0] - stall.no_load_speed) < 5.0 * errors
    assert math.isnan(curve.speed[2]) and curve.acceleration[2] < 0.0
    assert curve.mechanical_power[1] == pytest.approx(curve.load_torque[1] * curve.speed[1])
    assert curve.efficiency[1] == pytest.approx(curve.mechanical_power[1] / curve.input_power[1])
    assert (np.abs(curve.energy_residual[:2]) < 1e-9).all()
    assert (curve.impacts[:2] > 0).all()
    # A free rotor swings about its mean speed; all rotors of one vertical motion have one torque at rest.
    assert (curve.speed_deviation[:2] > 0.0).all() and math.isnan(curve.speed_deviation[2])
    assert curve.blocked_torque[0] == pytest.approx(curve.blocked_torque[1], rel=1e-3) and curve.blocked_torque_error[0] > 0.0
    assert curve.blocked_torque[0] == pytest.approx(stall.blocked_torque, rel=0.2)
    assert stall.motion == curve.MOTIONS[curve.motion[0]] == "irregular"
    own = bd.torque_speed_curve(MOTOR.replace(load_torque=1.0), load_torques=loads, relative_error=0.05)
    assert own == curve
    few = bd.torque_speed_curve(MOTOR, load_torques=[0.0], relative_error=1e-6, most_impacts=1)
    assert few.names() == ["unsettled"]


def test_the_spread_over_inputs_is_more_than_an_error() -> None:
    quick: dict[str, Any] = {"relative_error": 0.05, "draws": 12}
    free, overpowered = bd.input_spreads(MOTOR, load_torques=[0.0, 2.0 * MOTOR.largest_torque], **quick)
    assert overpowered is None and free is not None and free.draws == 12 and free.without == 0
    assert free.from_to[0] < free.mean < free.from_to[1]
    exact = bd.input_spreads(MOTOR, load_torques=[0.0], tolerance=0.0, perturbation_decades=0.0, **quick)[0]
    assert exact is not None and exact.standard_deviation < free.standard_deviation
    (stall,) = bd.input_spreads(MOTOR, **quick)
    assert stall is not None and 0.0 < stall.mean < MOTOR.largest_torque


def test_measured_speeds_are_read_as_instruments_write_them(tmp_path: Path) -> None:
    file = tmp_path / "run.csv"
    file.write_text("% mine\nt (ms);n (rpm)\n0,5;60\n1,5;120\n2,5;180\n")
    ((times, speeds),) = bd.read_speeds(file)
    assert times.tolist() == [0.0005, 0.0015, 0.0025]
    assert speeds / (2.0 * np.pi) == pytest.approx([1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="line 2, field 1: the unit of the time is .ms. here"):
        bd.read_speeds(file, time_unit="s")
    with pytest.raises(ValueError, match="furlong"):
        bd.read_speeds(file, speed_unit="furlong")
    with pytest.raises(OSError, match="absent"):
        bd.read_speeds(tmp_path / "absent.csv")


def test_fits_find_what_made_the_runs() -> None:
    runs = bd.ensemble(MOTOR.system, members=8, duration=4.0, intervals=200, seed=77)
    assert runs.steady_speed.mean == pytest.approx(runs.steady_speeds.mean())
    fit = bd.fit_transients(times=runs.times[:, 0], speeds=runs.speeds, resamples=200)
    low, high = fit.exponential.steady_speed.low, fit.exponential.steady_speed.high
    assert fit.members == 8 and low < runs.steady_speed.mean < high


def test_the_best_lag_turns_the_motor_fastest() -> None:
    best = bd.best(MOTOR, over={"phase_lag": (0.0, 2 * np.pi)}, relative_error=0.05)
    sheet = MOTOR.replace(**best.values)
    there = bd.torque_speed_curve(sheet, load_torques=[0.0], relative_error=0.05)
    assert there.speed == pytest.approx(best.value, rel=0.2) and best.at_end == [] and best.bounds == []


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"of": "sped"}, "of: there is no quantity"),
        ({"where": ["speed > 5"]}, "where: \"speed > 5\" is not a bound"),
        ({"over": {"phase": (0.0, 1.0)}}, "phase"),
        ({"over": {"phase_lag": (0.0,)}}, "1 ends"),
        ({"over": {"phase_lag": (1.0, 0.0)}}, "above its lower end"),
        ({"over": {}}, "over = 0 is not legal"),
    ],
)
def test_searches_that_are_none_are_refused_by_name(wrong: dict[str, Any], told: str) -> None:
    legal: dict[str, Any] = {"over": {"friction": (0.1, 0.2)}, "relative_error": 0.2}
    with pytest.raises(ValueError, match=told):
        bd.best(MOTOR, **(legal | wrong))


def test_a_bound_that_nothing_keeps_is_told() -> None:
    with pytest.raises(bd.ComputationError, match="satisfy the bound speed >= 1000"):
        bd.best(MOTOR, over={"friction": (0.1, 0.2)}, where=["speed >= 1e3"], relative_error=0.2)


def test_one_transient_alone_has_no_error() -> None:
    alone = bd.ensemble(bd.System.motor(), members=1, duration=0.5, intervals=50)
    for spread in (alone.steady_speed, alone.time_constant, alone.stall_acceleration):
        assert np.isfinite(spread.mean) and np.isnan(spread.deviation) and np.isnan(spread.standard_error)
    both = bd.ensemble(bd.System.motor(), members=2, duration=0.5, intervals=50)
    assert both.steady_speed.standard_error > 0.0


LOOSE: dict[str, Any] = {"relative_error": 0.05}


def test_a_map_has_the_operating_points_of_its_cells() -> None:
    loads = np.array([0.0, 0.5, 1.5]) * MOTOR.largest_torque
    found = bd.motor_map(MOTOR, over={"friction": [0.1, 0.2], "load_torque": loads}, **LOOSE)
    assert found.motor == MOTOR and list(found.axes) == ["friction", "load_torque"]
    assert np.array_equal(found.axes["load_torque"], loads)
    assert found.speed.shape == found.status.shape == found.impacts.shape == (2, 3)
    assert np.array_equal(found.load_torque, np.tile(loads, (2, 1)))
    assert found.names() == [["steady", "steady", "runaway"], ["steady", "steady", "steady"]]
    assert found.speed[0, 0] > found.speed[0, 1]
    assert np.isnan(found.speed[0, 2]) and found.acceleration[0, 2] < 0.0
    one = bd.torque_speed_curve(MOTOR, load_torques=[0.0], **LOOSE)
    error = np.hypot(found.speed_error[0, 0], one.speed_error[0])
    assert abs(found.speed[0, 0] - one.speed[0]) < 6.0 * error + 0.5
    line = bd.motor_map(MOTOR, over={"amplitude": [1e-8]}, **LOOSE)
    assert line.speed.shape == (1,) and line.names() == [["steady"]]


def test_axes_that_are_refused_name_the_argument() -> None:
    outside: list[dict[str, list[float]]] = [
        {},
        {"friction": [0.1], "mass": [1e-3], "amplitude": [1e-8]},
        {"friction": [np.nan]},
        {"amplitude": [1e308]},
    ]
    for axes in outside:
        with pytest.raises(bd.OutOfRangeError) as refused:
            bd.motor_map(MOTOR, over=axes, **LOOSE)
        assert refused.value.field == "over"
    unfitting: dict[str, Any] = {"empty-axis": {"friction": []}}
    unfitting["both-given"] = {"mass": [1e-3], "density": [8e3]}
    for kind, axes in unfitting.items():
        with pytest.raises(bd.InvalidError) as invalid:
            bd.motor_map(MOTOR, over=axes, **LOOSE)
        assert invalid.value.kind == kind
    with pytest.raises(ValueError, match="frikshun.*drive_frequency"):
        bd.motor_map(MOTOR, over={"frikshun": [0.1]}, **LOOSE)
    with pytest.raises(ValueError, match="friction must be a 1-d array"):
        bd.motor_map(MOTOR, over={"friction": 0.1}, **LOOSE)
    with pytest.raises(bd.TooLargeError):
        bd.motor_map(MOTOR, over={"friction": np.full(1000, 0.1), "phase_lag": np.zeros(1000)}, **LOOSE)


def test_local_sensitivities_are_those_of_the_speed() -> None:
    found = bd.local_sensitivities(MOTOR, parameters=["peak_angular_speed", "friction"], **LOOSE)
    assert found.parameters == ("peak_angular_speed", "friction") and found.quantity == "steady-speed"
    assert found.derivative[0] > 0.7 and abs(found.derivative[1]) < 0.5
    assert found.method == ("shared-motion", "shared-motion") and found.traps.tolist() == [0, 0]
    wider: dict[str, Any] = {"points": 5, "half_range": 0.1, "relative_error": 0.1}
    drawn = bd.local_sensitivities(MOTOR, parameters=["amplitude"], **wider)
    assert drawn.method == ("regression",) and np.isfinite(drawn.derivative).all()
    assert bd.local_sensitivities(MOTOR, parameters=[], **LOOSE).derivative.shape == (0,)
    torque: Any = {"quantity": "stall-torque", "relative_error": 0.1}
    stall = bd.local_sensitivities(MOTOR, parameters=["friction"], **torque)
    assert stall.quantity == "stall-torque" and stall.derivative[0] > 0.3


def test_what_sensitivities_refuse() -> None:
    wrong: Any = "friction"
    with pytest.raises(TypeError, match="one text"):
        bd.local_sensitivities(MOTOR, parameters=wrong, **LOOSE)
    with pytest.raises(ValueError, match="quantity"):
        bd.local_sensitivities(MOTOR, quantity="torque", **LOOSE)  # type: ignore[arg-type]


def test_a_stator_that_yields_is_computed_or_refused() -> None:
    table: dict[str, float | str] = {"mass": 0.05, "quality": 300.0}
    motor = bd.Motor.paper_70_khz().replace(amplitude=1e-7, stator=table)
    again = bd.Motor.from_json(motor.to_json())
    assert again == motor and hash(again) == hash(motor) and motor.replace(stator=None) != motor
    report = motor.stator_report()
    assert report is not None and report["mass_ratio"] == pytest.approx(0.05 / motor.mass)
    assert bd.Motor.paper_70_khz().stator_report() is None
    loose: dict[str, Any] = {"relative_error": 0.3, "members": 4, "most_impacts": 5_000}
    curve = bd.torque_speed_curve(motor, load_torques=[0.0, 1e-5], **loose)
    # What the drive puts in goes into the damping and into the rotor, but for what the modes store.
    assert curve.drive_power == pytest.approx(curve.damping_loss + curve.input_power, rel=0.02)
    assert curve.electrical_efficiency[1] == pytest.approx(curve.mechanical_power[1] / curve.drive_power[1])
    assert (curve.stator_amplitude < 1e-7).all() and (curve.stator_amplitude_error > 0.0).all()
    assert np.isnan(curve.speed_deviation).any() == np.isnan(curve.blocked_torque).any()
    prescribed = bd.torque_speed_curve(MOTOR, load_torques=[0.0], **loose)
    assert np.isnan(prescribed.stator_amplitude).all() and np.isfinite(prescribed.efficiency).all()
    heavy = bd.motor_map(motor, over={"stator.mass": [0.05, 0.5]}, **loose)
    assert heavy.stator_amplitude[0] < heavy.stator_amplitude[1]
    short: dict[str, Any] = {"members": 2, "duration": 0.02, "intervals": 4}
    assert (bd.ensemble(motor, **short).speeds != bd.ensemble(motor.replace(stator=None), **short).speeds).any()
    assert bd.ensemble(MOTOR, **short) == bd.ensemble(MOTOR.system, **short)
    for refused in (motor.report, lambda: bd.ensemble(motor.system, **short)):
        with pytest.raises(bd.InvalidError, match="makes the stator compliant"):
            refused()
    with pytest.raises(bd.InvalidError, match="both amplitude and stator.volts"):
        motor.replace(stator={**table, "volts": 5.0, "force_per_volt": 0.4})
    with pytest.raises(bd.InvalidError, match="stator cannot be read: unknown field `mas`"):
        motor.replace(stator={"mas": 0.05})
