"""Figures: what is drawn, where, and with which words. How they look is for eyes."""

from __future__ import annotations

import dataclasses
import io
import re
import sys
import warnings
from collections.abc import Iterator
from typing import Any

import bouncing_disk as bd
import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

from bouncing_disk import plot  # noqa: E402
from bouncing_disk.plot import _frame as words  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

from good_calls import STARTS  # noqa: E402
from test_documentation import failures_of  # noqa: E402

PIZZA, MOTOR = bd.System.pizza_toss(), bd.System.motor()
SHEET = bd.Motor(
    drive_frequency=40e3,
    amplitude=0.5e-6,
    peak_angular_speed=12.0,
    phase_lag=0.5236,
    mass=0.020,
    contact_radius=1.25e-3,
    gyration_radius=6.3e-3,
    preload_force=5.0,
    friction=0.1,
    restitution=0.5,
)
RUN: dict[str, Any] = {"transient": 100, "recorded": 20, "columns": 30}


@pytest.fixture(autouse=True)
def quiet_and_clean() -> Iterator[None]:
    """No figure warns, changes the caller's settings, or is left open."""
    before = dict(matplotlib.rcParams)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield
        for number in plt.get_fignums():
            fig = plt.figure(number)
            fig.savefig(io.BytesIO(), format="png", dpi=60)
            # Laid out once is enough, and takes longer than drawing.
            fig.set_layout_engine("none")
            fig.savefig(io.BytesIO(), format="svg")
    plt.close("all")
    assert dict(matplotlib.rcParams) == before


def legend_of(ax: Any) -> Any:
    """The legend, which is there."""
    legend = ax.get_legend()
    assert legend is not None
    return legend


def texts_of(ax: Any) -> list[str]:
    return [text.get_text() for text in legend_of(ax).get_texts()]


def drawn(line: Any) -> tuple[Any, Any]:
    return np.asarray(line.get_xdata()), np.asarray(line.get_ydata())


def lines_of(ax: Any) -> dict[str, Any]:
    return {line.get_label(): drawn(line) for line in ax.lines}


def note_of(ax: Any) -> str:
    return "".join(text.get_text() for text in ax.texts)


def diagram_of(forcings: Any, recorded: int = 10) -> bd.OrbitDiagram:
    return bd.orbit_diagram(axial_forcing=forcings, recorded=recorded, **STARTS)


def runs_of(system: bd.System = MOTOR, **changes: Any) -> bd.TransientEnsemble:
    return bd.ensemble(system, **{"members": 4, "duration": 0.5, "intervals": 30, **changes})


@pytest.mark.parametrize("quantity", ["phase", "speed"])
def test_an_orbit_diagram_has_every_impact(quantity: Any) -> None:
    forcings = np.linspace(0.4, 0.6, 7)
    diagram = diagram_of(forcings, recorded=11)
    fig, ax = plot.orbit_diagram(diagram, quantity=quantity)
    ((line,), legend) = (ax.lines, ax.get_legend())
    x, y = drawn(line)
    expected = diagram.impact_phase / (2 * np.pi) if quantity == "phase" else diagram.normalised_speed
    assert np.array_equal(x, np.repeat(forcings, 11)) and np.array_equal(y, expected)
    assert legend is None and ax.get_xlim() == (0.4, 0.6)
    assert ("/2\\pi" in ax.get_ylabel()) == (quantity == "phase") and "Gamma" in ax.get_xlabel()
    assert fig is ax.figure


def test_an_orbit_diagram_of_a_restitution_follows_two_starts() -> None:
    _, ax = plot.orbit_diagram(restitution=0.4, axial_forcing=(0.3, 0.6), **RUN)
    assert texts_of(ax) == ["from the period-1 orbit", "from a slow impact"]
    # The period-1 orbit is born at (1 - r)/(1 + r).
    assert drawn(ax.lines[0])[0].min() >= 0.6 / 1.4
    # Below it there is one start alone.
    _, ax = plot.orbit_diagram(restitution=0.4, axial_forcing=(0.3, 0.4), **RUN)
    assert len(ax.lines) == 1


def test_an_orbit_diagram_of_nothing_and_of_one_column() -> None:
    for forcings in ([], [0.5]):
        _, ax = plot.orbit_diagram(diagram_of(forcings, recorded=256))
        assert len(drawn(ax.lines[0])[0]) == 256 * len(forcings)
    _, ax = plot.orbit_diagram(axial_forcing=(0.5, 0.5), columns=1, transient=50, recorded=5)
    assert ax.get_xlim() == pytest.approx((0.45, 0.55))


def test_basins_are_where_they_were_computed() -> None:
    bouncing = bd.ImpactMap(axial_forcing=0.34, restitution=0.5)
    _, ax = plot.basins(bouncing, phases=40, speeds=30, speed_range=(0.0, 5.0))
    image: Any = ax.images[0]
    assert image.get_extent() == [0.0, 1.0, 0.0, 5.0] and image.origin == "lower"
    pixels = np.asarray(image.get_array())
    assert pixels.shape == (30, 40, 3)
    orbit = bouncing.period_one()
    assert orbit is not None
    phase, velocity = orbit
    row, column = int(-velocity / np.pi / 5.0 * 30), int(phase / (2 * np.pi) * 40)
    assert pixels[row, column].max() < 0.2
    assert pixels[0].min() == 1.0
    names = texts_of(ax)
    assert names[0].startswith("comes to rest (") and names[1].startswith("period 1 (")
    _, found = plot.basins(bd.attractors(bouncing), phases=40, speeds=30, speed_range=(0.0, 5.0))
    own: Any = found.images[0]
    assert np.array_equal(own.get_array(), image.get_array()) and texts_of(found) == names


@pytest.mark.parametrize("forcing", [0.34, 0.486, 0.5, 0.55, 0.6])
def test_basins_of_the_panels_of_fig_7(forcing: float) -> None:
    bouncing = bd.ImpactMap(axial_forcing=forcing, restitution=0.5)
    _, ax = plot.basins(bouncing, phases=40, speeds=40, speed_range=(0.0, 5.0))
    names = texts_of(ax)
    assert names[0].startswith("comes to rest"), names
    expected = {
        0.34: ["period 1"],
        0.486: ["period 1", "period 4"],
        0.5: ["period 2"],
        0.55: ["chaotic"],
        0.6: [],
    }
    found = [re.match(r"chaotic|period \d+", name) for name in names[1:]]
    assert [match and match[0] for match in found] == expected[forcing]


def test_basins_of_many_labels_and_without_a_legend() -> None:
    result = bd.basins(bd.ImpactMap(axial_forcing=0.5, restitution=0.5), phases=6, speeds=5)
    labels = np.arange(30, dtype=np.uint8).reshape(5, 6)
    many = dataclasses.replace(result, labels=labels, meaning=tuple(f"label {k}" for k in range(30)))
    _, ax = plot.basins(many, legend=False)
    colours = np.asarray(ax.images[0].get_array()).reshape(30, 3)
    assert len({tuple(colour) for colour in colours}) == 30 and ax.get_legend() is None


def test_a_toss_shows_height_angle_and_events() -> None:
    fig, axes = plot.toss(PIZZA)
    trajectory = bd.toss_trajectory(PIZZA)
    samples, events = trajectory.samples(count=2000), trajectory.events()
    for panel, values, unit in [(axes[0], samples.height, "(m)"), (axes[1], samples.angle, "(rad)")]:
        lines = lines_of(panel)
        assert set(lines) == {"platform", "disk", "separation", "impact"}
        assert np.array_equal(lines["disk"][1], values)
        assert lines["disk"][0][0] == 0.0
        assert lines["impact"][0][0] == events.time[-1] - trajectory.start_time
        assert unit in panel.get_ylabel()
    assert "(s)" in axes[1].get_xlabel() and fig is axes[0].figure


def test_a_motion_without_impacts() -> None:
    _, axes = plot.toss(bd.simulate(PIZZA.replace(amplitude=0.01), phase=1.0, events=4))
    assert "impact" not in lines_of(axes[0])


def test_a_run_up_shows_band_member_and_fit() -> None:
    runs = runs_of(members=12, duration=4.0, intervals=50)
    _, ax = plot.motor_transient(runs, member=3)
    lines = lines_of(ax)
    assert np.array_equal(lines["one run"][1], runs.speeds[:, 3])
    time, speed = lines["exponential"]
    steady, constant = runs.steady_speed.mean, runs.time_constant.mean
    assert speed == pytest.approx(steady * (1.0 - np.exp(-time / constant)))
    assert ax.get_xlim() == pytest.approx((0.0, 4.0))
    title = legend_of(ax).get_title().get_text()
    assert f"{steady:.1f}" in title and "rad/s" in title and "80 % of 12 runs" in texts_of(ax)[0]


def test_a_run_up_of_a_motor_lasts_eight_time_constants() -> None:
    _, ax = plot.motor_transient(SHEET, members=8, intervals=60)
    trial = bd.ensemble(SHEET.system, members=64, duration=0.3)
    assert 4.0 < ax.get_xlim()[1] / trial.time_constant.mean < 16.0
    _, ax = plot.motor_transient(MOTOR, members=1, duration=2.0)
    assert not ax.collections


def test_a_torque_speed_curve_has_units_that_fit() -> None:
    loads = np.array([0.0, 1e-4, 2e-4])
    curve = bd.torque_speed_curve(SHEET, load_torques=loads, relative_error=0.05)
    fig, ax = plot.torque_speed(curve)
    x, y = drawn(ax.lines[0])
    assert np.array_equal(x, 1e6 * loads) and np.array_equal(y, curve.speed)
    assert ax.get_xlabel() == "load torque (µN m)"
    (power,) = [other for other in fig.axes if other is not ax]
    assert power.get_ylabel() == "mechanical power (µW)"
    assert drawn(power.lines[0])[1] == pytest.approx(1e6 * curve.mechanical_power)
    # Both zeros are at one height.
    heights = [axis.transData.transform((0.0, 0.0))[1] for axis in (ax, power)]
    assert heights[0] == pytest.approx(heights[1])
    _, ax = plot.torque_speed(SHEET, relative_error=0.1)
    speeds = drawn(ax.lines[0])[1]
    assert len(speeds) == 12 and speeds[0] > 5.0 and abs(speeds[-1]) < 0.2 * speeds[0]


def test_axes_of_the_caller_are_used() -> None:
    fig, axes = plt.subplots(2, 2)
    assert plot.orbit_diagram(diagram_of([0.5]), ax=axes[0, 0]) == (fig, axes[0, 0])
    found, panels = plot.toss(PIZZA, ax=axes[:, 1])
    assert found is fig and panels[0] is axes[0, 1] and len(axes[1, 1].lines) == 4
    with pytest.raises(ValueError, match="2 axes, not 4"):
        plot.toss(PIZZA, ax=axes)
    assert plt.get_fignums() == [fig.number]


def test_an_animation_moves_disk_and_platform() -> None:
    animation: Any = plot.toss_animation(PIZZA, frames=20)
    samples = bd.toss_trajectory(PIZZA).samples(count=20)
    seen = set()
    for frame in (0, 10, 19):
        platform, platform_dot, _, disk, disk_dot, _ = animation._func(frame)
        heights = disk.get_ydata()[0], platform.get_ydata()[0]
        assert heights == (samples.height[frame], samples.platform_height[frame])
        across = PIZZA.contact_radius * np.cos(samples.angle[frame])
        assert disk_dot.get_xdata()[0] == pytest.approx(across)
        seen.add(platform_dot.get_xdata()[0])
    assert len(seen) == 3
    animation._draw_was_started = True


def test_an_animation_can_be_saved(tmp_path: Any) -> None:
    pytest.importorskip("PIL")
    path = tmp_path / "toss.gif"
    plot.toss_animation(PIZZA, frames=5).save(path, writer="pillow")
    assert path.read_bytes()[:6] == b"GIF89a"


def test_without_matplotlib_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(bd.MissingDependencyError) as missing:
        plot.toss(PIZZA)
    assert missing.value.install == "pip install 'bouncing-disk[plot]'"


@pytest.mark.parametrize("name", plot.__all__)
def test_examples_of_figures_run(name: str) -> None:
    text = getattr(plot, name).__doc__
    assert len(text) > 80 and failures_of(name, text) == ""


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


def test_a_motor_tossed_is_drawn_in_its_units() -> None:
    trajectory = bd.toss_trajectory(MOTOR)
    _, (height, angle) = plot.toss(trajectory, samples=2000)
    labels = height.get_ylabel(), angle.get_ylabel(), angle.get_xlabel()
    assert labels == ("height (µm)", "angle (µrad)", "time (ms)")
    time, disk = drawn(height.lines[1])
    samples = trajectory.samples(count=2000)
    assert disk == pytest.approx(1e6 * samples.height)
    assert time == pytest.approx(1e3 * (samples.time - samples.time[0]))


def test_a_long_motion_has_enough_samples_and_no_cloud_of_marks() -> None:
    long = bd.simulate(PIZZA, phase=4.7, events=1500)
    _, (height, _) = plot.toss(long)
    periods = (long.end_time - long.start_time) / PIZZA.period
    assert 23 * periods < len(drawn(height.lines[0])[0]) <= 200_000
    assert set(lines_of(height)) == {"platform", "disk"}
    assert height.lines[1].get_linewidth() < 0.5 and legend_of(height).get_lines()[1].get_linewidth() == 1.0
    _, (height, _) = plot.toss(bd.simulate(PIZZA, phase=4.7, events=400))
    assert {"impact", "separation", "attachment"} < set(lines_of(height))


def test_an_animation_has_units() -> None:
    animation: Any = plot.toss_animation(MOTOR, frames=2)
    labels = {ax.get_xlabel() + ax.get_ylabel() for ax in animation._fig.axes}
    assert labels == {"across (mm)height (µm)", "time (ms)"}
    # The curves are finer than the film.
    assert len(drawn(animation._fig.axes[1].lines[0])[0]) >= 2000
    animation._draw_was_started = True


@pytest.mark.parametrize(
    ("function", "arguments", "error", "message"),
    [
        ("orbit_diagram", {"quantity": "colour"}, ValueError, "quantity"),
        ("orbit_diagram", {"diagram": 0.5}, TypeError, "not float"),
        ("orbit_diagram", {"diagram": {"one": 1}}, TypeError, "not int"),
        ("orbit_diagram", {"columns": 0}, bd.OutOfRangeError, "columns is 0"),
        ("orbit_diagram", {"columns": 2.5}, TypeError, "columns"),
        ("orbit_diagram", {"axial_forcing": (0.3, np.nan)}, bd.OutOfRangeError, "axial_forcing is nan"),
        ("orbit_diagram", {"axial_forcing": ("a", "b")}, TypeError, "axial_forcing"),
        ("basins", {"basins": 0.5}, TypeError, "not float"),
        ("toss", {"motion": "pizza"}, TypeError, "not str"),
        ("motor_transient", {"runs": 3}, TypeError, "not int"),
        ("motor_transient", {"runs": runs_of(), "member": 4}, bd.OutOfRangeError, "member"),
        ("motor_transient", {"runs": runs_of(), "member": -1}, bd.OutOfRangeError, "member"),
        ("motor_transient", {"runs": runs_of(), "member": 1.5}, TypeError, "member"),
        ("torque_speed", {"curve": None}, TypeError, "not NoneType"),
        ("toss_animation", {"motion": PIZZA, "frames": 1}, bd.OutOfRangeError, "frames"),
        ("toss_animation", {"motion": PIZZA, "frames": 0}, bd.OutOfRangeError, "frames"),
        ("toss_animation", {"motion": PIZZA, "frames": 2.5}, TypeError, "frames"),
        ("toss_animation", {"motion": PIZZA, "frames": "3"}, TypeError, "frames"),
        ("toss_animation", {"motion": PIZZA, "slow_motion": 0.0}, bd.OutOfRangeError, "slow_motion"),
        ("toss_animation", {"motion": PIZZA, "slow_motion": np.nan}, bd.OutOfRangeError, "slow_motion"),
        ("toss_animation", {"motion": PIZZA, "slow_motion": np.inf}, bd.OutOfRangeError, "slow_motion"),
        ("toss_animation", {"motion": PIZZA, "slow_motion": "2"}, TypeError, "slow_motion"),
    ],
)
def test_arguments_that_cannot_be_drawn_are_refused(
    function: str, arguments: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        getattr(plot, function)(**arguments)


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
    _, ax = plot.orbit_diagram(diagram_of([1e5, 1e6]), quantity="speed")
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


def test_the_legend_of_many_basins_names_the_largest() -> None:
    result = bd.basins(bd.ImpactMap(axial_forcing=0.5, restitution=0.5), phases=60, speeds=50)
    labels = np.minimum(np.arange(3000) // 10, 39).astype(np.uint8).reshape(50, 60)
    orbits = (f"periodic orbit: impacts {k}, platform periods 1" for k in range(2, 40))
    meaning = ("undecided", "comes to rest", *orbits)
    fig, ax = plot.basins(dataclasses.replace(result, labels=labels, meaning=meaning))
    shown = texts_of(ax)
    assert len(shown) == 8 and "period 39 in 1 cycles (87.0 %)" in shown
    assert shown[-1].startswith("33 others (11.0 %)")
    fig.canvas.draw()
    box = legend_of(ax).get_window_extent()
    assert box.x0 >= 0.0 and box.y1 <= fig.bbox.y1 and ax.get_window_extent().height > 0.3 * fig.bbox.height


def test_basins_of_a_narrow_range_have_whole_numbers_at_their_ticks() -> None:
    fig, ax = plot.basins(
        bd.ImpactMap(axial_forcing=0.486, restitution=0.5), phases=5, speeds=5, speed_range=(0.5, 0.50001)
    )
    fig.canvas.draw()
    assert ax.yaxis.get_offset_text().get_text() == ""


def test_run_ups_that_tell_nothing_have_no_fit() -> None:
    for runs in (runs_of(duration=1e-4), runs_of(MOTOR.replace(twist_amplitude=0.0))):
        _, ax = plot.motor_transient(runs)
        assert "exponential" not in lines_of(ax)
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


def test_curves_lie_over_verdicts() -> None:
    bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    down = bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6), rising=False)
    curves = bd.curves(bouncing, down, parameter_range=(0.01, 0.9), branch_range=(0.01, 2.0))
    forcing, restitution = np.meshgrid([0.3, 0.4, 0.5], [0.4, 0.6])
    start: dict[str, Any] = {"impact_phase": 1.2, "normalised_speed": 1.3, "impacts": 100}
    verdicts = bd.verdicts(axial_forcing=forcing.ravel(), restitution=restitution.ravel(), **start)
    fig, ax = plot.curves(curves, verdicts=verdicts)
    assert texts_of(ax) == ["fold", "grazing-fold"]
    assert np.array_equal(np.asarray(ax.collections[0].get_array()).ravel(), verdicts.kind)
    first = next(curve for curve in curves if curve.kind == "fold")
    assert np.array_equal(lines_of(ax)["fold"][1], first.values[:, 1])
    assert note_of(plot.curves([])[1]) == "no curves"
    row = bd.verdicts(axial_forcing=[0.3, 0.4], restitution=0.5, **start)
    with pytest.raises(ValueError, match="a grid"):
        plot.curves(curves, verdicts=row)


def test_branches_are_solid_where_they_attract() -> None:
    bouncing = bd.ImpactMap(axial_forcing=0.45, restitution=0.5)
    orbit = bouncing.settled_orbit(impact_phase=1.2, normalised_speed=1.3)
    assert orbit is not None
    branch = bd.continued(bouncing, orbit, parameter_range=(0.1, 0.6))
    for quantity in ("phase", "speed"):
        fig, ax = plot.branches([branch, branch.switched(index=0, parameter_range=(0.1, 0.6))], quantity=quantity)
        across, up = drawn(ax.lines[0])
        assert np.array_equal(np.isfinite(up), branch.is_stable) and np.array_equal(across, branch.values)
        assert texts_of(ax) == ["doubling"]
    assert note_of(plot.branches([])[1]) == "no branches"
    with pytest.raises(ValueError, match="quantity"):
        plot.branches(branch, quantity="height")  # type: ignore[arg-type]
