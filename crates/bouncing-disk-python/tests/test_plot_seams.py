"""Figures of what is long, tiny, huge, empty or wrong: they stay readable, or say what is wrong."""

from __future__ import annotations

import dataclasses
import doctest
from typing import Any

import numpy as np
import pytest
from test_plot import SHEET, drawn, legend_of, quiet_and_clean  # noqa: F401

import bouncing_disk as bd
from bouncing_disk import plot
from bouncing_disk.plot import _words as words

PIZZA, MOTOR = bd.System.pizza_toss(), bd.System.motor()


@pytest.mark.parametrize("name", plot.__all__)
def test_examples_of_figures_run(name: str) -> None:
    text = getattr(plot, name).__doc__
    assert len(text) > 80 and ("Returns\n    -------" in text or name == "style")
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, 0)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    report: list[str] = []
    runner.run(test, out=report.append)
    assert runner.summarize(verbose=False).failed == 0, "".join(report)


@pytest.mark.parametrize(
    ("largest", "unit", "factor", "expected"),
    [
        (0.0, "m", 1.0, "m"),
        (0.3, "m", 1.0, "m"),
        (9999.0, "m", 1.0, "m"),
        (-0.05, "m", 1e3, "mm"),
        (2e-8, "m", 1e9, "nm"),
        (3e4, "m", 1e-3, "$10^{3}$ m"),
        (3e4, "W", 1e-3, "kW"),
        (4e-20, "m", 1e21, "$10^{-21}$ m"),
        (2e6, "", 1e-6, "$10^{6}$"),
        (5e-324, "m", 1e306, "$10^{-306}$ m"),
        (1e308, "m", 1e-306, "$10^{306}$ m"),
        (np.nan, "m", 1.0, "m"),
        (np.inf, "m", 1.0, "m"),
    ],
)
def test_units_fit_the_values(largest: float, unit: str, factor: float, expected: str) -> None:
    found, name = words.unit_of(np.array([0.0, largest]), unit)
    assert found == pytest.approx(factor, rel=1e-12) and name == expected
    assert words.unit_of(np.array([]), unit) == (1.0, unit)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (0.0, "0"), (50.0, "50"), (0.125, "0.125"), (-1.0, "-1"), (1234.5, "1230"), (1e4, "10^{4}"),
        (2.5e-7, r"2.5\times 10^{-7}"),
        (-1e30, "-10^{30}"),
    ],
)  # fmt: skip
def test_numbers_are_printed_as_in_a_journal(value: float, expected: str) -> None:
    assert words.in_words(value) == expected


@pytest.mark.parametrize(
    ("share", "expected"),
    [
        (0.0, "0"), (1.0, r"\pi"), (-0.5, r"-\pi/2"), (0.375, r"3\pi/8"), (2.0, r"2\pi"),
        (0.321, r"0.321\pi"),
        (0.5236 / np.pi, r"\pi/6"), (1e-9, "0"), (1e6, r"10^{6}\pi"),
    ],
)  # fmt: skip
def test_angles_are_multiples_of_pi(share: float, expected: str) -> None:
    assert words.of_pi(share * np.pi) == expected


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        (22.11, 0.14, "22.11(14)"),
        (22.11, np.nan, "22.1"),
        (22.11, 0.0, "22.1"),
        (3e-7, 2e-7, r"(3\times 10^{-7} \pm 2\times 10^{-7})"),
        (119.0, 50.0, r"(119 \pm 50)"),
    ],
)
def test_errors_stand_in_brackets(value: float, error: float, expected: str) -> None:
    assert words.with_error(value, error) == expected


# Tosses


def test_a_motor_tossed_is_drawn_in_its_units() -> None:
    trajectory = bd.toss_trajectory(MOTOR)
    _, (height, angle) = plot.toss(trajectory, samples=2000)
    assert (height.get_ylabel(), angle.get_ylabel(), angle.get_xlabel()) == (
        "height (µm)",
        "angle (µrad)",
        "time (ms)",
    )
    time, disk = drawn(height.lines[1])
    samples = trajectory.samples(count=2000)
    assert disk == pytest.approx(1e6 * samples.height) and time == pytest.approx(
        1e3 * (samples.time - samples.time[0])
    )


def test_a_long_motion_has_enough_samples_and_no_cloud_of_marks() -> None:
    long = bd.simulate(PIZZA, phase=4.7, events=1500)
    _, (height, _) = plot.toss(long)
    periods = (long.end_time - long.start_time) / PIZZA.period
    assert 23 * periods < len(drawn(height.lines[0])[0]) <= 200_000
    assert {line.get_label() for line in height.lines} == {"platform", "disk"}
    assert height.lines[1].get_linewidth() < 0.5 and legend_of(height).get_lines()[1].get_linewidth() == 1.0
    _, (height, _) = plot.toss(bd.simulate(PIZZA, phase=4.7, events=400))
    assert {"impact", "separation", "attachment"} < {line.get_label() for line in height.lines}


def test_an_animation_has_units_and_refuses_one_picture() -> None:
    animation: Any = plot.toss_animation(MOTOR, frames=2)
    labels = {ax.get_xlabel() + ax.get_ylabel() for ax in animation._fig.axes}
    assert labels == {"across (mm)height (µm)", "time (ms)"}
    # The curves are finer than the film.
    assert len(drawn(animation._fig.axes[1].lines[0])[0]) >= 2000
    animation._draw_was_started = True
    for frames, error in (
        (1, bd.OutOfRangeError),
        (0, bd.OutOfRangeError),
        (2.5, TypeError),
        ("3", TypeError),
    ):
        with pytest.raises(error, match="frames"):
            plot.toss_animation(PIZZA, frames=frames)  # type: ignore[arg-type]
    for slow_motion, refused in (
        (np.nan, bd.OutOfRangeError),
        (np.inf, bd.OutOfRangeError),
        ("2", TypeError),
    ):
        with pytest.raises(refused, match="slow_motion"):
            plot.toss_animation(PIZZA, slow_motion=slow_motion)  # type: ignore[arg-type]


# Diagrams and basins


def diagram_of(forcings: Any, recorded: int = 10) -> bd.OrbitDiagram:
    return bd.orbit_diagram(
        axial_forcing=forcings, restitution=0.5, impact_phase=1.2, normalised_speed=1.3, recorded=recorded
    )


def note_of(ax: Any) -> str:
    return "".join(text.get_text() for text in ax.texts)


def test_diagrams_without_impacts_say_so() -> None:
    assert note_of(plot.orbit_diagram(diagram_of([]))[1]) == "no orbits"
    assert note_of(plot.orbit_diagram({})[1]) == "no orbits"
    assert note_of(plot.orbit_diagram(diagram_of([0.1, 0.2]), quantity="speed")[1]) == "all disks rest"
    assert note_of(plot.orbit_diagram(diagram_of([0.5]))[1]) == ""


def test_few_points_are_larger_than_many() -> None:
    few = plot.orbit_diagram(diagram_of([0.5]))[1].lines[0].get_markersize()
    many = plot.orbit_diagram(diagram_of(np.full(300, 0.5), recorded=100))[1].lines[0].get_markersize()
    assert few > 2.0 > 1.0 > many


def test_huge_forcings_have_a_power_of_ten_at_the_axis() -> None:
    forcings = np.array([1e5, 1e6])
    diagram = diagram_of(forcings)
    _, ax = plot.orbit_diagram(diagram, quantity="speed")
    assert ax.get_xlabel().endswith("($10^{6}$)") and "($10^{" in ax.get_ylabel()
    assert np.unique(drawn(ax.lines[0])[0]) == pytest.approx([0.1, 1.0])


def test_a_legend_of_many_long_names_fits_the_figure() -> None:
    names = {f"a rather long name of the start number {k}": diagram_of([0.4, 0.5]) for k in range(8)}
    fig, ax = plot.orbit_diagram(names)
    fig.canvas.draw()
    box, size = legend_of(ax).get_window_extent(), fig.bbox
    assert box.x0 >= size.x0 and box.x1 <= size.x1 and box.y1 <= size.y1
    assert len({line.get_color() for line in ax.lines}) == 8
    # What the legend takes is added to the figure, and not taken from the axes.
    short, other = plot.orbit_diagram({"a name": diagram_of([0.4])})
    short.canvas.draw()
    assert ax.get_window_extent().height > 0.9 * other.get_window_extent().height


def test_wrong_diagrams_are_refused() -> None:
    refused: Any = [
        ({"diagram": 0.5}, TypeError, "not float"),
        ({"diagram": {"one": 1}}, TypeError, "not int"),
        ({"columns": 0}, bd.OutOfRangeError, "columns is 0"),
        ({"columns": 2.5}, TypeError, "columns"),
        ({"axial_forcing": (0.3, np.nan)}, bd.OutOfRangeError, "axial_forcing is nan"),
        ({"axial_forcing": ("a", "b")}, TypeError, "axial_forcing"),
    ]
    for arguments, error, message in refused:
        with pytest.raises(error, match=message):
            plot.orbit_diagram(**arguments)
    _, ax = plot.orbit_diagram(axial_forcing=(0.5, 0.5), columns=1, transient=50, recorded=5)
    assert ax.get_xlim() == pytest.approx((0.45, 0.55))


def test_the_legend_of_many_basins_names_the_largest() -> None:
    result = bd.basins(bd.ImpactMap(axial_forcing=0.5, restitution=0.5), phases=60, speeds=50)
    labels = np.minimum(np.arange(3000) // 10, 39).astype(np.uint8).reshape(50, 60)
    meaning = (
        "undecided",
        "comes to rest",
        *(f"periodic orbit: impacts {k}, platform periods 1" for k in range(2, 40)),
    )
    fig, ax = plot.basins(dataclasses.replace(result, labels=labels, meaning=meaning))
    shown = [text.get_text() for text in legend_of(ax).get_texts()]
    assert (
        len(shown) == 8
        and "period 39 in 1 cycles (87.0 %)" in shown
        and shown[-1].startswith("33 others (11.0 %)")
    )
    fig.canvas.draw()
    box = legend_of(ax).get_window_extent()
    assert box.x0 >= 0.0 and box.y1 <= fig.bbox.y1 and ax.get_window_extent().height > 0.3 * fig.bbox.height


def test_basins_of_a_narrow_range_have_whole_numbers_at_their_ticks() -> None:
    fig, ax = plot.basins(
        bd.ImpactMap(axial_forcing=0.486, restitution=0.5), phases=5, speeds=5, speed_range=(0.5, 0.50001)
    )
    fig.canvas.draw()
    assert ax.yaxis.get_offset_text().get_text() == ""


# Motors


def runs_of(system: bd.System = MOTOR, **changes: Any) -> bd.TransientEnsemble:
    settings: dict[str, Any] = {"members": 4, "duration": 0.5, "intervals": 30, **changes}
    return bd.ensemble(system, **settings)


def test_a_member_that_is_not_there_is_refused() -> None:
    runs = runs_of()
    for member, error in ((4, bd.OutOfRangeError), (-1, bd.OutOfRangeError), (1.5, TypeError)):
        with pytest.raises(error, match="member"):
            plot.motor_transient(runs, member=member)  # type: ignore[arg-type]


def test_run_ups_that_tell_nothing_have_no_fit() -> None:
    for runs in (runs_of(duration=1e-4), runs_of(MOTOR.replace(twist_amplitude=0.0))):
        _, ax = plot.motor_transient(runs)
        assert "exponential" not in {line.get_label() for line in ax.lines}
        assert legend_of(ax).get_title().get_text() == ""
        low, high = ax.get_ylim()
        assert low < 0.0 < high
    _, ax = plot.motor_transient(runs_of(duration=1e-4))
    assert ax.get_xlabel() == "time $t$ (ms)" and ax.get_ylabel().endswith("(mrad/s)")


def test_a_rotor_that_turns_backwards_is_seen_whole() -> None:
    runs = runs_of(MOTOR.replace(phase_lag=np.pi), duration=4.0)
    _, ax = plot.motor_transient(runs)
    low, high = ax.get_ylim()
    assert low < runs.speeds.min() and high > 0.0


CURVE = bd.torque_speed_curve(SHEET, load_torques=[0.0, 1e-4, 2e-4], relative_error=0.1)


@pytest.mark.parametrize(
    ("speeds", "powers"),
    [
        ([3.0, 2.0, 1.0], [0.0, 0.002, 0.001]),
        ([-3.0, -4.0, -5.0], [0.0, -0.002, -0.001]),
        ([3.0, 2.0, 1.0], [-0.003, -0.002, -0.001]),
        ([3.0, -2.0, -1.0], [0.0, -0.002, -0.001]),
        ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
        ([1e9, 1e8, 1.0], [1e12, 0.0, -1e3]),
    ],
)
def test_both_axes_of_a_curve_show_all_with_their_zeros_level(
    speeds: list[float], powers: list[float]
) -> None:
    curve = dataclasses.replace(CURVE, speed=np.array(speeds), mechanical_power=np.array(powers))
    fig, ax = plot.torque_speed(curve)
    (power,) = [other for other in fig.axes if other is not ax]
    for axis in (ax, power):
        low, high = axis.get_ylim()
        values = drawn(axis.lines[0])[1]
        assert low < values.min() and values.max() < high
    heights = [axis.transData.transform((0.0, 0.0))[1] for axis in (ax, power)]
    assert heights[0] == pytest.approx(heights[1], abs=1e-6)


def test_loads_in_any_order_and_of_any_sign() -> None:
    loads = np.array([2e-4, -1e-4, 0.0])
    _, ax = plot.torque_speed(dataclasses.replace(CURVE, load_torque=loads))
    x, y = drawn(ax.lines[0])
    assert x.tolist() == pytest.approx([-100.0, 0.0, 200.0]) and y.tolist() == CURVE.speed[[1, 2, 0]].tolist()
    low, high = ax.get_xlim()
    assert low < -100.0 and high > 200.0


def test_curves_of_one_load_and_without_a_steady_speed() -> None:
    one = bd.torque_speed_curve(SHEET, load_torques=[0.0], relative_error=0.1)
    _, ax = plot.torque_speed(one)
    assert ax.get_xlim()[0] < 0.0 < ax.get_xlim()[1]
    unknown = dataclasses.replace(CURVE, speed=np.full(3, np.nan))
    assert note_of(plot.torque_speed(unknown)[1]) == "no load with a steady speed"


# Trends


def test_tosses_that_never_leave_and_single_points() -> None:
    _, axes = plot.toss_performance(PIZZA.replace(angular_frequency=1.0), points=5)
    assert [note_of(ax) for ax in axes] == ["no motion tosses the disk"] * 3
    _, axes = plot.toss_performance(PIZZA, points=1)
    assert {line.get_marker() for line in axes[0].lines} == {"o"} and note_of(axes[0]) == ""
    assert [text.get_text() for text in legend_of(axes[0]).get_texts()] == [
        "$0$", r"$\pi/8$", r"$\pi/4$", r"$3\pi/8$", r"$\pi/2$",
    ]  # fmt: skip
    refused: Any = [
        ({"points": 0}, bd.OutOfRangeError),
        ({"points": 2.5}, TypeError),
        ({"phase_lags": []}, bd.InvalidError),
        ({"phase_lags": [np.nan]}, bd.OutOfRangeError),
        ({"phase_lags": [[0.0]]}, bd.InvalidError),
        ({"phase_lags": ["a"]}, TypeError),
    ]
    for arguments, error in refused:
        with pytest.raises(error, match=next(iter(arguments))):
            plot.toss_performance(PIZZA, **arguments)


def test_values_of_a_parameter_of_any_size() -> None:
    _, ax = plot.motor_dependence(MOTOR, "amplitude", [1e-9, 1e-7], members=2, rise_times=3.0)
    assert ax.get_xscale() == "log" and ax.get_xlabel() == "axial amplitude $A$ (µm)"
    assert drawn(ax.lines[0])[0] == pytest.approx([1e-3, 0.1])
    assert note_of(plot.motor_dependence(MOTOR, "amplitude", [])[1]) == "no values"
    driven = plot.motor_dependence(MOTOR, "load_acceleration", [-1e4], members=2, rise_times=3.0)[1]
    assert note_of(driven) == "no exponential run-up"
    refused: Any = [
        ([np.nan], {}, bd.OutOfRangeError, "values is nan"),
        ([[1e-8]], {}, bd.InvalidError, "2 dimensions"),
        (["a"], {}, TypeError, "values must be"),
        ([1e-8], {"members": 1}, bd.OutOfRangeError, "members is 1"),
        ([1e-8], {"members": 2.5}, TypeError, "members"),
    ]
    for values, arguments, error, message in refused:
        with pytest.raises(error, match=message):
            plot.motor_dependence(MOTOR, "amplitude", values, **arguments)


# Rotation


def test_rotations_of_disks_that_rest_or_cannot_turn() -> None:
    settings: dict[str, Any] = {"columns": 2, "transient": 100, "recorded": 10}
    _, ax = plot.rotation_diagram(PIZZA, axial_forcing=(0.0, 0.3), **settings)
    assert note_of(ax) == "all disks rest" and [len(drawn(line)[0]) for line in ax.lines] == [0]
    # Without friction or twist nothing turns a disk.
    _, ax = plot.rotation_diagram(PIZZA.replace(friction=0.0), axial_forcing=(0.5, 0.6), columns=2)
    assert all(not drawn(line)[1].any() for line in ax.lines)
    still = PIZZA.replace(twist_amplitude=0.0)
    with pytest.raises(bd.InvalidError) as none:
        plot.rotation_diagram(still, **settings)
    assert none.value.kind == "no-twist"
    _, ax = plot.rotation_diagram(still, axial_forcing=(0.5, 0.6), normalised=False, **settings)
    assert all(not drawn(line)[1].any() for line in ax.lines) and "(rad/s)" in ax.get_ylabel()


def test_rotations_of_one_forcing_and_of_wrong_things() -> None:
    _, ax = plot.rotation_diagram(PIZZA, axial_forcing=(0.5, 0.5), columns=1, transient=50, recorded=5)
    assert ax.get_xlim() == pytest.approx((0.45, 0.55))
    refused: Any = [
        ({"columns": 0}, bd.OutOfRangeError, "columns is 0"),
        ({"columns": 2.5}, TypeError, "columns"),
        ({"transient": -1}, bd.OutOfRangeError, "transient is -1"),
        ({"transient": "many"}, TypeError, "transient"),
        ({"recorded": 1}, bd.OutOfRangeError, "recorded is 1"),
        ({"axial_forcing": (-0.1, 0.5)}, bd.OutOfRangeError, "axial_forcing is -0.1"),
        ({"axial_forcing": (0.6, 0.5)}, bd.OutOfRangeError, "axial_forcing is 0.5"),
        ({"axial_forcing": (0.3, np.nan)}, bd.OutOfRangeError, "axial_forcing is nan"),
        ({"axial_forcing": ("a", "b")}, TypeError, "axial_forcing"),
    ]
    for arguments, error, message in refused:
        with pytest.raises(error, match=message):
            plot.rotation_diagram(PIZZA, **arguments)
    with pytest.raises(TypeError, match="not Motor"):
        plot.rotation_diagram(SHEET)  # type: ignore[arg-type]


# Airborne speed


def test_speeds_of_tosses_that_never_leave_or_turn_and_of_single_points() -> None:
    _, axes = plot.toss_speed(PIZZA.replace(angular_frequency=1.0), points=5)
    assert [note_of(ax) for ax in axes] == ["no motion tosses the disk"] * 2
    _, axes = plot.toss_speed(PIZZA.replace(amplitude=0.0, twist_amplitude=0.0), points=2)
    assert [note_of(ax) for ax in axes] == ["no motion tosses the disk"] * 2
    # One curve of a system without friction: its multiples are all the same. No toss is the fastest.
    _, axes = plot.toss_speed(PIZZA.replace(friction=0.0), points=5)
    curve, circle = axes[1].lines
    assert not drawn(curve)[1].any() and np.isnan(drawn(circle)[1]).all() and note_of(axes[1]) == ""
    # Another division of the stroke gives a twist to one that has none.
    _, axes = plot.toss_speed(PIZZA.replace(twist_amplitude=0.0), frictions=0.6, points=1)
    assert axes[1].lines[0].get_marker() == "o" and drawn(axes[1].lines[0])[1] > 0.0


def test_wrong_speeds_of_tosses_are_refused() -> None:
    refused: Any = [
        ({"points": 0}, bd.OutOfRangeError),
        ({"points": 2.5}, TypeError),
        ({"phase_lags": []}, bd.InvalidError),
        ({"phase_lags": [np.nan]}, bd.OutOfRangeError),
        ({"frictions": []}, bd.InvalidError),
        ({"frictions": [-0.1]}, bd.OutOfRangeError),
        ({"frictions": [[0.5]]}, bd.InvalidError),
        ({"frictions": ["a"]}, TypeError),
    ]
    for arguments, error in refused:
        with pytest.raises(error, match=next(iter(arguments))):
            plot.toss_speed(PIZZA, **arguments)
    with pytest.raises(TypeError, match="not Motor"):
        plot.toss_speed(SHEET)  # type: ignore[arg-type]
