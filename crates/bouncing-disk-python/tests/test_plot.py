"""Figures: what is drawn, where, and with which words. How they look is for eyes."""

from __future__ import annotations

import io
import re
import sys
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import bouncing_disk as bd

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

from matplotlib import pyplot as plt  # noqa: E402

from bouncing_disk import plot  # noqa: E402

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


def drawn(line: Any) -> tuple[Any, Any]:
    return np.asarray(line.get_xdata()), np.asarray(line.get_ydata())


@pytest.mark.parametrize("quantity", ["phase", "speed"])
def test_an_orbit_diagram_has_every_impact(quantity: Any) -> None:
    forcings = np.linspace(0.4, 0.6, 7)
    diagram = bd.orbit_diagram(
        axial_forcing=forcings, restitution=0.5, impact_phase=1.2, normalised_speed=1.3, recorded=11
    )
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
    names = [text.get_text() for text in legend_of(ax).get_texts()]
    assert names == ["from the period-1 orbit", "from a slow impact"]
    # The period-1 orbit is born at (1 - r)/(1 + r).
    assert drawn(ax.lines[0])[0].min() >= 0.6 / 1.4
    # Below it there is one start alone.
    _, ax = plot.orbit_diagram(restitution=0.4, axial_forcing=(0.3, 0.4), **RUN)
    assert len(ax.lines) == 1


def test_an_orbit_diagram_of_nothing_and_of_one_column() -> None:
    for forcings in ([], [0.5]):
        diagram = bd.orbit_diagram(
            axial_forcing=forcings, restitution=0.5, impact_phase=1.0, normalised_speed=1.0
        )
        _, ax = plot.orbit_diagram(diagram)
        assert len(drawn(ax.lines[0])[0]) == 256 * len(forcings)
    with pytest.raises(ValueError, match="quantity"):
        plot.orbit_diagram(diagram, quantity="colour")  # type: ignore[arg-type]


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
    names = [text.get_text() for text in legend_of(ax).get_texts()]
    assert names[0].startswith("comes to rest (") and names[1].startswith("period 1 (")


@pytest.mark.parametrize("forcing", [0.34, 0.486, 0.5, 0.55, 0.6])
def test_basins_of_the_panels_of_fig_7(forcing: float) -> None:
    bouncing = bd.ImpactMap(axial_forcing=forcing, restitution=0.5)
    _, ax = plot.basins(bouncing, phases=40, speeds=40, speed_range=(0.0, 5.0))
    names = [text.get_text() for text in legend_of(ax).get_texts()]
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
    many = bd.Basins(
        impact_map=result.impact_map,
        labels=np.arange(30, dtype=np.uint8).reshape(5, 6),
        phase=result.phase,
        speed=result.speed,
        phase_range=result.phase_range,
        speed_range=result.speed_range,
        meaning=tuple(f"label {k}" for k in range(30)),
    )
    _, ax = plot.basins(many, legend=False)
    colours = np.asarray(ax.images[0].get_array()).reshape(30, 3)
    assert len({tuple(colour) for colour in colours}) == 30 and ax.get_legend() is None
    with pytest.raises(TypeError, match="not float"):
        plot.basins(0.5)  # type: ignore[arg-type]


def test_a_toss_shows_height_angle_and_events() -> None:
    pizza = bd.System.pizza_toss()
    fig, axes = plot.toss(pizza)
    trajectory = bd.toss_trajectory(pizza)
    samples, events = trajectory.samples(count=2000), trajectory.events()
    for panel, values, unit in [(axes[0], samples.height, "(m)"), (axes[1], samples.angle, "(rad)")]:
        lines = {line.get_label(): drawn(line) for line in panel.lines}
        assert set(lines) == {"platform", "disk", "separation", "impact"}
        assert np.array_equal(lines["disk"][1], values)
        assert lines["disk"][0][0] == 0.0
        assert lines["impact"][0][0] == events.time[-1] - trajectory.start_time
        assert unit in panel.get_ylabel()
    assert "(s)" in axes[1].get_xlabel() and fig is axes[0].figure
    with pytest.raises(TypeError, match="not str"):
        plot.toss("pizza")  # type: ignore[arg-type]


def test_a_motion_without_impacts() -> None:
    gentle = bd.System.pizza_toss().replace(amplitude=0.01)
    _, axes = plot.toss(bd.simulate(gentle, phase=1.0, events=4))
    assert "impact" not in {line.get_label() for line in axes[0].lines}


def test_a_run_up_shows_band_member_and_fit() -> None:
    runs = bd.ensemble(bd.System.motor(), members=12, duration=4.0, intervals=50)
    _, ax = plot.motor_transient(runs, member=3)
    lines = {line.get_label(): drawn(line) for line in ax.lines}
    assert np.array_equal(lines["one run"][1], runs.speeds[:, 3])
    time, speed = lines["exponential"]
    steady, constant = runs.steady_speed.mean, runs.time_constant.mean
    assert speed == pytest.approx(steady * (1.0 - np.exp(-time / constant)))
    assert ax.get_xlim() == pytest.approx((0.0, 4.0))
    title = legend_of(ax).get_title().get_text()
    assert (
        f"{steady:.1f}" in title
        and "rad/s" in title
        and "80 % of 12 runs" in legend_of(ax).get_texts()[0].get_text()
    )


def test_a_run_up_of_a_motor_lasts_eight_time_constants() -> None:
    _, ax = plot.motor_transient(SHEET, members=8, intervals=60)
    trial = bd.ensemble(SHEET.system, members=64, duration=0.3)
    assert 4.0 < ax.get_xlim()[1] / trial.time_constant.mean < 16.0
    _, ax = plot.motor_transient(bd.System.motor(), members=1, duration=2.0)
    assert not ax.collections
    with pytest.raises(TypeError, match="not int"):
        plot.motor_transient(3)  # type: ignore[arg-type]


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
    with pytest.raises(TypeError, match="not NoneType"):
        plot.torque_speed(None)  # type: ignore[arg-type]


def test_axes_of_the_caller_are_used() -> None:
    fig, axes = plt.subplots(2, 2)
    diagram = bd.orbit_diagram(axial_forcing=[0.5], restitution=0.5, impact_phase=1.0, normalised_speed=1.0)
    assert plot.orbit_diagram(diagram, ax=axes[0, 0]) == (fig, axes[0, 0])
    found, panels = plot.toss(bd.System.pizza_toss(), ax=axes[:, 1])
    assert found is fig and panels[0] is axes[0, 1] and len(axes[1, 1].lines) == 4
    with pytest.raises(ValueError, match="2 axes, not 4"):
        plot.toss(bd.System.pizza_toss(), ax=axes)
    assert plt.get_fignums() == [fig.number]


def test_an_animation_moves_disk_and_platform() -> None:
    animation: Any = plot.toss_animation(bd.System.pizza_toss(), frames=20)
    samples = bd.toss_trajectory(bd.System.pizza_toss()).samples(count=20)
    seen = []
    for frame in (0, 10, 19):
        platform, platform_dot, _, disk, disk_dot, _ = animation._func(frame)
        assert (
            disk.get_ydata()[0] == samples.height[frame]
            and platform.get_ydata()[0] == samples.platform_height[frame]
        )
        radius = bd.System.pizza_toss().contact_radius
        assert disk_dot.get_xdata()[0] == pytest.approx(radius * np.cos(samples.angle[frame]))
        seen.append(platform_dot.get_xdata()[0])
    assert len(set(seen)) == 3
    animation._draw_was_started = True
    with pytest.raises(bd.OutOfRangeError, match="slow_motion"):
        plot.toss_animation(bd.System.pizza_toss(), slow_motion=0.0)


def test_an_animation_can_be_saved(tmp_path: Any) -> None:
    pytest.importorskip("PIL")
    path = tmp_path / "toss.gif"
    plot.toss_animation(bd.System.pizza_toss(), frames=5).save(path, writer="pillow")
    assert path.read_bytes()[:6] == b"GIF89a"


def test_without_matplotlib_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(bd.MissingDependencyError) as missing:
        plot.toss(bd.System.pizza_toss())
    assert missing.value.install == "pip install 'bouncing-disk[plot]'"


def test_tosses_depend_on_the_hand_as_single_tosses_say() -> None:
    pizza = bd.System.pizza_toss()
    lags = [0.0, np.pi / 2.0]
    _, axes = plot.toss_performance(pizza, phase_lags=lags, points=40)
    assert [len(panel.lines) for panel in axes] == [2, 2, 2]
    angles, speeds = drawn(axes[0].lines[1])
    stroke = np.hypot(pizza.amplitude, pizza.contact_radius * pizza.twist_amplitude)
    place = 17
    angle = np.pi * angles[place]
    toss = bd.single_toss(
        pizza.replace(
            amplitude=float(stroke * np.cos(angle)),
            twist_amplitude=float(stroke * np.sin(angle) / pizza.contact_radius),
            phase_lag=lags[1],
        )
    )
    assert speeds[place] == pytest.approx(toss.airborne_speed, rel=1e-12)
    assert drawn(axes[1].lines[1])[1][place] == pytest.approx(toss.efficiency, rel=1e-12)
    # A hand that hardly rises does not toss.
    assert np.isnan(speeds[-1]) and np.isfinite(speeds[0])
    with pytest.raises(TypeError, match="not float"):
        plot.toss_performance(0.5)  # type: ignore[arg-type]


def test_a_motor_depends_on_a_parameter_as_its_ensembles_say() -> None:
    motor = bd.System.motor()
    _, ax = plot.motor_dependence(motor, "preload_acceleration", [4.0, 8.0], members=3, rise_times=4.0)
    values, speeds = drawn(ax.lines[0])
    assert values.tolist() == [4.0, 8.0]
    changed = motor.replace(preload_acceleration=8.0)
    runs = bd.ensemble(changed, members=3, duration=4.0 * changed.rise_time, intervals=200, seed=1)
    assert speeds[1] == runs.steady_speed.mean
    plot.motor_dependence(SHEET, "friction", 0.0, members=2)
    # A data sheet has parameters that its system knows nothing of.
    mass = SHEET.mass
    assert mass is not None
    _, ax = plot.motor_dependence(SHEET, "preload_force", [4.0 * mass, 8.0 * mass], members=3, rise_times=4.0)
    by_force = drawn(ax.lines[0])[1]
    _, ax = plot.motor_dependence(SHEET, "preload_acceleration", [4.0, 8.0], members=3, rise_times=4.0)
    assert by_force.tolist() == pytest.approx(drawn(ax.lines[0])[1].tolist())
    with pytest.raises(ValueError, match="preload_acceleration"):
        plot.motor_dependence(motor, "preload_force", [1.0])
    with pytest.raises(ValueError, match="must be one of amplitude"):
        plot.motor_dependence(motor, "colour", [1.0])
    with pytest.raises(TypeError, match="not float"):
        plot.motor_dependence(0.5, "friction", [0.1])  # type: ignore[arg-type]
    with pytest.raises(bd.OutOfRangeError):
        plot.motor_dependence(motor, "restitution", [1.0])
