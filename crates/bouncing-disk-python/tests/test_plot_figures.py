"""Figs. 2, 3, 8, 9 and 14: what is drawn of a system, a motor or measurements."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from test_plot import SHEET, drawn, legend_of, quiet_and_clean  # noqa: F401

import bouncing_disk as bd
from bouncing_disk import plot

PIZZA, MOTOR = bd.System.pizza_toss(), bd.System.motor()


def words_of(ax: Any) -> str:
    """All that is written in the axes."""
    return "\n".join(text.get_text() for text in ax.texts)


# Fig. 2


def curve_of(panel: Any) -> tuple[Any, Any]:
    """The path as it is seen, front and back together."""
    behind, in_front = (drawn(line) for line in panel.lines[-3:-1])
    return tuple(np.where(np.isnan(one), other, one) for one, other in zip(in_front, behind))


def test_the_path_is_that_of_the_platform() -> None:
    lag = -0.8
    system = PIZZA.replace(phase_lag=lag)
    _, (panel,) = plot.platform_path(system)
    x, y = curve_of(panel)
    # Eq. (1) on a cylinder whose radius is 1, seen from the azimuth and elevation of the figure.
    phase = np.linspace(0.0, 2.0 * np.pi, len(x))
    angle = system.twist_amplitude * np.sin(phase + lag) - 0.15
    height = system.amplitude / system.contact_radius * np.sin(phase)
    assert x == pytest.approx(np.sin(angle), abs=1e-9)
    assert y == pytest.approx(height * np.cos(0.4) - np.cos(angle) * np.sin(0.4), abs=1e-9)
    dot = drawn(panel.lines[-1])
    assert (dot[0][0], dot[1][0]) == (x[0], y[0]) and (x[-1], y[-1]) == (x[0], y[0])


@pytest.mark.parametrize(
    "changes", [{"angular_frequency": 2e4}, {"angular_frequency": 1e-5}, {"friction": 0.0}]
)
def test_the_path_depends_on_amplitudes_and_lag_alone(changes: dict[str, float]) -> None:
    _, (one,) = plot.platform_path(PIZZA)
    _, (other,) = plot.platform_path(PIZZA.replace(**changes))
    for mine, theirs in zip(curve_of(one), curve_of(other)):
        assert mine == pytest.approx(theirs, abs=1e-7)


def test_paths_say_what_they_are_and_are_magnified_alike() -> None:
    _, axes = plot.platform_path({"small": MOTOR, "large": MOTOR.replace(amplitude=1e-7)})
    small, large = (words_of(panel) for panel in axes)
    assert r"$A = 10$ nm, $a_\mathrm{e}\Phi = 85.3$ nm" in small and r"$\theta = 0$" in small
    assert "$A = 100$ nm" in large and [panel.get_title(loc="left") for panel in axes] == [
        "(a) small",
        "(b) large",
    ]
    (magnified,) = {words.splitlines()[-1] for words in (small, large)} - {""}
    assert magnified == r"drawn $\times\,10^{4}$"
    assert "drawn" not in words_of(plot.platform_path(PIZZA)[1][0])


def test_a_platform_that_does_not_move_has_a_dot() -> None:
    _, (panel,) = plot.platform_path(PIZZA.replace(amplitude=0.0, twist_amplitude=0.0))
    x, y = curve_of(panel)
    assert np.ptp(x) == 0.0 and np.ptp(y) == 0.0 and "at rest" in words_of(panel)
    for tiny in (1e-200, 1e-320):
        _, (panel,) = plot.platform_path(PIZZA.replace(amplitude=tiny))
        assert np.isfinite(panel.get_ylim()).all()


def test_paths_of_nothing_and_of_other_things_are_refused() -> None:
    for wrong in ("pizza", [3], 0.5, {"motor": SHEET}):
        with pytest.raises(TypeError, match="systems must be Systems, not"):
            plot.platform_path(wrong)  # type: ignore[arg-type]
    nothing: list[Any] = [[], {}]
    for empty in nothing:
        with pytest.raises(bd.InvalidError) as none:
            plot.platform_path(empty)
        assert none.value.kind == "empty"


# Fig. 3


def counts_of(chart: Any) -> dict[str, int]:
    """The numbers at the arrows by the first words that stand there."""
    found: dict[str, int] = {}
    for text in chart.texts:
        words = text.get_text()
        if r"\times$" in words:
            name = words.split("(")[0].strip()
            found[name] = found.get(name, 0) + int(words.split(r"\times$ ")[1].split(")")[0])
    return found


@pytest.mark.parametrize(
    "motion",
    [
        bd.simulate(PIZZA, phase=4.7, events=500),
        bd.simulate(MOTOR, events=500),
        bd.simulate(PIZZA.replace(amplitude=0.01), events=30),
        bd.simulate(PIZZA.replace(restitution=0.0), phase=4.7, events=40),
        bd.simulate(PIZZA, gap=1.0, events=60),
    ],
)
def test_the_flow_chart_counts_all_events(motion: bd.Trajectory) -> None:
    _, (chart, _) = plot.flow_chart(motion)
    names = motion.events().names()
    counts = counts_of(chart)
    impacts, attachments = names.count("impact"), names.count("attachment")
    expected = {
        "collision": impacts + attachments,
        "rebound": impacts,
        "attachment": attachments,
        "separation": names.count("separation"),
        "stick to slip": names.count("stick-to-slip"),
        "slip to stick": names.count("slip-to-stick"),
        "slip reversal": names.count("slip-reversal"),
    }
    assert counts == {name: number for name, number in expected.items() if number}
    assert sum(expected.values()) - expected["collision"] == len(motion)


def test_the_cycle_goes_from_flight_to_separation() -> None:
    # Forced as the inset of Fig. 3 in the Rust workspace: a chattering orbit of the single-toss kind.
    system = PIZZA.replace(angular_frequency=float(np.sqrt(0.45 * np.pi * 9.8 / PIZZA.amplitude)))
    motion = bd.simulate(system, phase=1.5 * np.pi, events=200)
    _, (_, cycle) = plot.flow_chart(motion)
    table = motion.events()
    names = table.names()
    assert [text.get_text() for text in cycle.texts] == ["(c)", "(a)", "(s)"]
    (collision, attachment, separation) = [drawn(line) for line in cycle.lines[2:]]
    assert collision[0][0] == 0.0 and 0.0 < attachment[0][0] < separation[0][0]
    first = int(np.argmin(np.abs(table.height - collision[1][0])))
    assert names[first] == "impact"
    (_, platform), (time, disk) = (drawn(line) for line in cycle.lines[:2])
    # Never below the platform, well above in the flight, and on it from the attachment on.
    gap = (disk - platform) / system.amplitude
    assert gap.min() > -1e-9 and gap[time < 0.0].max() > 0.1
    assert gap[time >= attachment[0][0]] == pytest.approx(0.0, abs=1e-9)
    assert time[0] < 0.0 and time[-1] == separation[0][0]
    assert cycle.get_xlabel() == "time since the collision (s)" and cycle.get_ylabel().endswith("(m)")


def test_the_cycle_of_a_motor_has_its_units() -> None:
    _, (_, cycle) = plot.flow_chart(MOTOR, events=400)
    assert "(ms)" in cycle.get_xlabel() and "(µm)" in cycle.get_ylabel()


def test_a_motion_without_a_cycle_shows_its_last_events() -> None:
    _, (_, cycle) = plot.flow_chart(bd.toss_trajectory(PIZZA))
    assert [text.get_text() for text in cycle.texts] == ["(s)", "(c)"] and cycle.get_xlabel() == "time (s)"
    # One that only slides, and one with a single event.
    for motion in (
        bd.simulate(PIZZA.replace(amplitude=0.01), events=30),
        bd.simulate(PIZZA, phase=4.7, events=1),
    ):
        _, (_, cycle) = plot.flow_chart(motion)
        assert not cycle.texts and len(drawn(cycle.lines[1])[0]) > 100


def test_flow_charts_of_other_things_are_refused() -> None:
    with pytest.raises(TypeError, match="not Motor"):
        plot.flow_chart(SHEET)  # type: ignore[arg-type]
    with pytest.raises(bd.OutOfRangeError):
        plot.flow_chart(PIZZA, events=0)
    with pytest.raises(bd.OutOfRangeError):
        plot.flow_chart(PIZZA, phase=float("nan"))


# Fig. 8


def test_the_schematic_says_the_numbers_of_the_motor() -> None:
    _, ax = plot.motor_schematic(SHEET.replace(load_torque=1e-4, spring_constant=1e4))
    words = words_of(ax)
    for expected in (
        "5$ N", "250$ m/s$^2$", "m = 20$ g", "6.3$ mm", "1.25$ mm", r"\mu = 0.1$", r"\epsilon = 0.5$",
        "A = 500$ nm", "= 12$ rad/s", r"\theta = \pi/6$", "40$ kHz", "load torque $100$ µN m",
        "spring, deflected $500$ µm", "not to scale",
    ):  # fmt: skip
        assert expected in words, (expected, words)
    _, ax = plot.motor_schematic(MOTOR)
    assert "load" not in words_of(ax).replace("preload", "") and "$ N" not in words_of(ax)
    assert r"\Phi = 68.2$ µrad" in words_of(ax) and r"4.4\times 10^{5}$ rad/s" in words_of(ax)


@pytest.mark.parametrize("contact", [1e-9, 1e-3, 6.2e-3, 6.3e-3, 6.4e-3, 1.0])
def test_the_schematic_tells_its_radii_apart(contact: float) -> None:
    system = MOTOR.replace(contact_radius=contact)
    _, ax = plot.motor_schematic(system)
    gyration = max(drawn(line)[0][0] for line in ax.lines if line.get_linestyle() == ":")
    corners: list[Any] = [patch.get_xy() for patch in ax.patches]  # type: ignore[attr-defined]
    feet = [polygon[1][0] for polygon in corners if len(polygon) == 4]
    assert abs(gyration - max(feet)) > 0.1 and max(feet) > 0.05 and max(gyration, *feet) < 1.0
    if 0.3 < contact / 6.3e-3 < 0.7:
        assert max(feet) / gyration == pytest.approx(contact / 6.3e-3)
    with pytest.raises(TypeError, match="not str"):
        plot.motor_schematic("motor")  # type: ignore[arg-type]


# Fig. 9


def test_a_rotor_brakes_on_straight_lines() -> None:
    preloads = [2.0, 4.0, 8.0]
    fig, (ax,) = plot.braking(MOTOR, preload_accelerations=preloads, first_speed=30.0)
    stops = []
    for line in ax.lines:
        time, speed = drawn(line)
        assert speed == pytest.approx(30.0 * (1.0 - time / time[-1]), abs=1e-9)
        stops.append(time[-1])
    # Coulomb friction: twice the preload, half the time.
    assert stops == pytest.approx([stops[0], stops[0] / 2.0, stops[0] / 4.0])
    assert [text.get_text() for text in legend_of(ax).get_texts()] == [
        f"$g = {g:.0f}$ m/s$^2$" for g in preloads
    ]
    assert ax.get_xlabel().endswith("(s)") and ax.get_ylabel().endswith("(rad/s)") and fig is ax.figure


def test_a_rotor_brakes_from_the_speed_of_the_stator() -> None:
    for motor, speed in ((SHEET, 12.0), (MOTOR, 30.0), (MOTOR.replace(phase_lag=1.0), 30.0)):
        _, (ax,) = plot.braking(motor)
        assert [drawn(line)[1][0] for line in ax.lines] == pytest.approx([speed] * 3)
    _, (ax,) = plot.braking(MOTOR, first_speed=-20.0)
    assert drawn(ax.lines[0])[1][0] == pytest.approx(-20.0) and ax.get_ylim()[1] == 0.0


def test_measured_speeds_lie_beside_the_curves() -> None:
    fast = (np.array([0.1, 0.2, 0.3]), np.array([20.0, 17.0, 14.0]), 9.8)
    slow = ([0.0, 0.5], [25.0, 20.0], 2.0)
    _, (ax,) = plot.braking(MOTOR, measured=[fast, slow])
    curves, points = ax.lines[:2], ax.lines[2:]
    # By preload, each from its first measured point on.
    assert [drawn(line)[0][0] for line in curves] == [0.0, 0.1]
    assert [drawn(line)[1][0] for line in curves] == pytest.approx([25.0, 20.0])
    assert np.array_equal(drawn(points[0])[1], fast[1]) and len(points) == 2
    assert points[0].get_color() == curves[1].get_color() != curves[0].get_color()


def test_coefficients_have_their_mean_and_deviation() -> None:
    preloads, frictions = np.array([2.0, 4.0, 8.0]), np.array([0.1, 0.2, 0.06])
    _, axes = plot.braking(MOTOR, frictions=(preloads, frictions))
    ax = axes[1]
    x, y = drawn(ax.lines[1])
    assert np.array_equal(x, preloads) and np.array_equal(y, frictions)
    assert drawn(ax.lines[0])[1].tolist() == [MOTOR.friction] * 2
    words = [text.get_text() for text in legend_of(ax).get_texts()]
    assert r"mean $0.12 \pm 0.072$" in words and "preload $g$ (m/s$^2$)" == ax.get_xlabel()
    _, axes = plot.braking(MOTOR, frictions=([9.8], [0.1]))
    assert not any("mean" in text.get_text() for text in legend_of(axes[1]).get_texts())


def test_braking_refuses_what_it_cannot_draw() -> None:
    refused: Any = [
        ({"preload_accelerations": []}, bd.InvalidError, "empty"),
        ({"preload_accelerations": [1.0, -1.0]}, bd.OutOfRangeError, "preload_accelerations is -1.0"),
        ({"preload_accelerations": [[1.0]]}, bd.InvalidError, "2 dimensions"),
        ({"first_speed": 0.0}, bd.OutOfRangeError, "first_speed"),
        ({"first_speed": float("nan")}, bd.OutOfRangeError, "first_speed"),
        ({"first_speed": "30"}, TypeError, "first_speed"),
        ({"measured": [(1.0, 2.0)]}, TypeError, "measured must hold"),
        ({"measured": [([1.0, 2.0], [1.0], 3.0)]}, bd.InvalidError, "times has 2 values, and speeds has 1"),
        ({"measured": [([1.0, 0.5], [1.0, 1.0], 3.0)]}, bd.InvalidError, r"times\[1\] is 0.5"),
        ({"measured": [([1.0, 2.0], [1.0, np.nan], 3.0)]}, bd.OutOfRangeError, "speeds is nan"),
        ({"frictions": [1.0, 2.0, 3.0]}, TypeError, "frictions must be"),
        ({"frictions": ([1.0, 2.0], [0.1])}, bd.InvalidError, "2 values"),
    ]
    for arguments, error, words in refused:
        with pytest.raises(error, match=words):
            plot.braking(MOTOR, **arguments)
    with pytest.raises(bd.InvalidError, match="never stops"):
        plot.braking(MOTOR.replace(friction=0.0))
    with pytest.raises(bd.InvalidError, match="must be given"):
        plot.braking(MOTOR.replace(twist_amplitude=0.0))
    with pytest.raises(TypeError, match="not float"):
        plot.braking(0.5)  # type: ignore[arg-type]


# Fig. 14


def test_the_line_through_the_diameters_is_that_of_least_squares() -> None:
    # A textbook line, 0.7 + 1.2 t, whose slope has the error 0.18^(1/2).
    fig, ax = plot.dough_growth([0.0, 1.0, 2.0, 3.0], [1.0, 2.0, 2.0, 5.0])
    time, line = drawn(ax.lines[1])
    assert line == pytest.approx(1.0 + 1.2 / 0.7 * time)
    assert drawn(ax.lines[0])[1] == pytest.approx(np.array([1.0, 2.0, 2.0, 5.0]) / 0.7)
    assert "time $t$ (s)" == ax.get_xlabel() and "d/d_0" in ax.get_ylabel() and fig is ax.figure
    # About the mean time, value (2.5) and slope are not correlated, so that the error of their ratio is easy.
    slope, rest = 1.2 / 2.5, 1.8 / 2.0
    error = np.sqrt(rest / 5.0 + slope**2 * rest / 4.0) / 2.5
    _, ax = plot.dough_growth([0.0, 1.0, 2.0, 3.0], [1.0, 2.0, 2.0, 5.0], start=1.5)
    title = legend_of(ax).get_title().get_text()
    assert rf"1 + ({slope:.2f} \pm {error:.1g})" in title and r"(t - 1.5\ \mathrm{s})" in title


def test_the_growth_does_not_depend_on_the_unit_of_the_diameter() -> None:
    times, sizes = (
        np.linspace(2.0, 8.0, 40),
        1.0 + 0.05 * np.linspace(0.0, 6.0, 40) + 0.01 * np.sin(np.arange(40.0)),
    )
    curves = []
    for unit in (1.0, 137.0, 1e-300, 1e300):
        _, ax = plot.dough_growth(times, unit * sizes)
        curves.append(drawn(ax.lines[0])[1])
    for curve in curves[1:]:
        assert curve == pytest.approx(curves[0], rel=1e-12)


def test_tosses_have_arrows_with_their_numbers() -> None:
    times = np.linspace(2.365, 8.4, 60)
    starts = {toss: 2.365 + 0.67 * (toss - 3) for toss in range(3, 13)}
    _, ax = plot.dough_growth(times, 1.0 + 0.05 * (times - 2.365), toss_starts=starts)
    assert [text.get_text() for text in ax.texts] == [str(toss) for toss in starts]
    for arrow, start in zip(ax.texts, starts.values()):
        x, y = arrow.xy  # type: ignore[attr-defined]
        assert x == pytest.approx(start) and y < 1.0 + 0.05 * (start - 2.365)
    _, ax = plot.dough_growth(times, np.ones(60), toss_starts=np.linspace(0.0, 10.0, 100))
    named = [text.get_text() for text in ax.texts if text.get_text()]
    assert len(ax.texts) == 100 and len(named) <= 24 and named[0] == "1"


@pytest.mark.parametrize("unit", [1e-6, 1e-300, 1e300])
def test_times_of_any_size(unit: float) -> None:
    times = unit * np.linspace(1.0, 3.0, 20)
    _, ax = plot.dough_growth(times, 1.0 + 0.1 * np.arange(20.0))
    assert drawn(ax.lines[1])[1] == pytest.approx([1.0, 2.9])


def test_a_dough_that_shrinks_or_keeps_its_size() -> None:
    _, ax = plot.dough_growth([0.0, 1.0, 2.0], [1.0, 0.9, 0.8])
    assert "= 1 - 0.1" in legend_of(ax).get_title().get_text()
    _, ax = plot.dough_growth([0, 1, 2], [7, 7, 7])
    assert "= 1 + 0\\ " in legend_of(ax).get_title().get_text()


def test_diameters_that_give_no_line_are_refused() -> None:
    refused: Any = [
        (([0.0, 1.0], [1.0, 1.0]), bd.InvalidError, "3 at least"),
        (([], []), bd.InvalidError, "3 at least"),
        (([0.0, 1.0, 2.0], [1.0, 1.0]), bd.InvalidError, "3 values"),
        (([0.0, 1.0, 1.0], [1.0, 1.0, 1.0]), bd.InvalidError, r"times\[2\]"),
        (([0.0, 1.0, 2.0], [1.0, np.nan, 1.0]), bd.OutOfRangeError, "diameters is nan"),
        (([0.0, 1.0, 2.0], [1.0, 0.0, 1.0]), bd.OutOfRangeError, "diameters is 0.0"),
        (([0.0, 1.0, np.inf], [1.0, 1.0, 1.0]), bd.OutOfRangeError, "times is inf"),
        (([0.0, 1.0, 2.0], [1.0, 1.0, 30.0]), bd.InvalidError, "diameter of -3.8"),
        (([0.0, 1e-320, 2e-320], [1.0, 1.1, 1.2]), bd.InvalidError, "differ by"),
        ((["a", "b", "c"], [1.0, 1.1, 1.2]), TypeError, "times must be"),
        (([0.0, 1.0, 2.0], None), TypeError, "diameters must be"),
    ]
    for (times, sizes), error, words in refused:
        with pytest.raises(error, match=words):
            plot.dough_growth(times, sizes)
    with pytest.raises(bd.OutOfRangeError, match="toss_starts"):
        plot.dough_growth([0, 1, 2], [1, 1, 1], toss_starts=[np.nan])
    with pytest.raises(bd.OutOfRangeError, match="start"):
        plot.dough_growth([0, 1, 2], [1, 1, 1], start=float("inf"))


def largest_words(ax: Any) -> float:
    return max(float(text.get_fontsize()) for text in ax.texts if text.get_text())


def test_all_are_drawn_into_axes_of_the_caller() -> None:
    import matplotlib.pyplot as plt

    fig, axes = plt.subplots(2, 4)
    calls: list[Any] = [
        (plot.platform_path, (PIZZA,), axes[0, 0]),
        (plot.flow_chart, (PIZZA,), axes[:, 1]),
        (plot.motor_schematic, (MOTOR,), axes[0, 2]),
        (plot.braking, (MOTOR,), [axes[1, 2]]),
        (plot.dough_growth, ([0, 1, 2], [1, 1.1, 1.3]), axes[0, 3]),
    ]
    for function, arguments, ax in calls:
        found, panels = function(*arguments, ax=ax)
        assert found is fig and list(np.atleast_1d(panels)) == list(np.atleast_1d(ax))
    # Words of a drawing shrink with it.
    for function, arguments, ax in calls[1:3]:
        _, panels = function(*arguments)
        small, large = (largest_words(np.atleast_1d(shown)[0]) for shown in (ax, panels))
        assert small < 0.7 * large
        plt.close()
    with pytest.raises(ValueError, match="2 axes, not 1"):
        plot.flow_chart(PIZZA, ax=[axes[1, 0]])
    assert plt.get_fignums() == [fig.number] and tuple(fig.get_size_inches()) == tuple(
        plt.rcParams["figure.figsize"]
    )
