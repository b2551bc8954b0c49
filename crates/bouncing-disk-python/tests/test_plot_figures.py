"""Figs. 2, 3, 4(d, e), 6(c, d) and 8: what is drawn of a system or a motor, and axes of the caller."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from test_plot import SHEET, drawn, quiet_and_clean  # noqa: F401

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


# Figs. 6(c) and (d)


def twisted(angular_forcing: float, lag: float) -> bd.System:
    """The pizza with another angular forcing and phase lag."""
    assert PIZZA.angular_forcing is not None
    twist = PIZZA.twist_amplitude * angular_forcing / PIZZA.angular_forcing
    return PIZZA.replace(twist_amplitude=twist, phase_lag=lag)


def driven(system: bd.System, forcing: float) -> bd.System:
    amplitude = forcing * np.pi * system.preload_acceleration / system.angular_frequency**2
    return system.replace(amplitude=amplitude)


@pytest.mark.parametrize("normalised", [True, False])
def test_the_rotation_at_impacts_is_that_of_multi_toss(normalised: bool) -> None:
    _, ax = plot.rotation_diagram(
        PIZZA, axial_forcing=(0.3, 0.62), columns=9, transient=500, recorded=40, normalised=normalised
    )
    x, y = drawn(ax.lines[1])
    assert [line.get_label() for line in ax.lines] == ["from the period-1 orbit", "from rest"]
    unit = PIZZA.peak_angular_speed if normalised else 1.0
    # A disk below 1/pi rests for ever, and has no point.
    assert x.min() > 1.0 / np.pi
    for forcing in np.linspace(0.3, 0.62, 9)[1:]:
        orbit = bd.multi_toss(
            driven(PIZZA, forcing),
            angular_speed=0.0,
            transient_impacts=500,
            examined_impacts=40,
            tolerance=1e-7,
        )
        assert y[x == forcing] == pytest.approx(orbit.angular_speed / unit, rel=1e-9)
    assert ax.get_xlim() == (0.3, 0.62) and ("Phi" in ax.get_ylabel()) == normalised


@pytest.mark.parametrize(("angular_forcing", "lag"), [(100.0, 0.0), (1.0, -0.26 * np.pi)])
def test_the_rotation_of_period_1_is_that_of_the_platform_at_impact(
    angular_forcing: float, lag: float
) -> None:
    # Eq. (16) of the paper.
    system = twisted(angular_forcing, lag)
    _, ax = plot.rotation_diagram(system, axial_forcing=(0.34, 0.48), columns=4)
    x, y = drawn(ax.lines[0])
    orbits = [bd.ImpactMap(axial_forcing=forcing, restitution=0.5).period_one() for forcing in x]
    phases = np.array([orbit[0] for orbit in orbits if orbit is not None])
    assert y == pytest.approx(np.cos(phases + lag), abs=1e-4) and len(y) == 4


def test_the_amplitude_of_the_system_does_not_matter_to_the_rotation() -> None:
    settings: dict[str, Any] = {"columns": 3, "transient": 200, "recorded": 20}
    for one, other in zip(
        plot.rotation_diagram(PIZZA, **settings)[1].lines,
        plot.rotation_diagram(PIZZA.replace(amplitude=0.0), **settings)[1].lines,
    ):
        assert np.array_equal(one.get_xydata(), other.get_xydata())


def test_rotations_that_have_not_settled_are_counted() -> None:
    _, ax = plot.rotation_diagram(MOTOR, axial_forcing=(0.4, 0.45), columns=2, transient=300)
    assert [line.get_label() for line in ax.lines] == [
        "from the period-1 orbit (2 of 2 not settled)",
        "from rest (2 of 2 not settled)",
    ]
    # A disk with much inertia is followed until it has settled.
    _, ax = plot.rotation_diagram(twisted(100.0, 0.0), axial_forcing=(0.34, 0.34), columns=1)
    assert not any("settled" in str(line.get_label()) for line in ax.lines)


# Figs. 4(d) and (e)


def at_angle(system: bd.System, angle: float) -> bd.System:
    """The system with its stroke divided otherwise."""
    return system.replace(
        amplitude=float(system.stroke * np.cos(angle)),
        twist_amplitude=float(system.stroke * np.sin(angle) / system.contact_radius),
    )


def test_the_airborne_speed_is_that_of_single_tosses() -> None:
    system = PIZZA.replace(phase_lag=0.2)
    _, (separation, friction) = plot.toss_speed(
        system, phase_lags=[0.0, 1.0], frictions=[0.3, 0.6], points=20
    )
    assert len(separation.lines) == 2 and len(friction.lines) == 4
    angles = np.pi * drawn(friction.lines[0])[0]
    # Up to the angle arccos(g/(c omega^2)), at which the disk leaves at pi/2.
    last = np.arccos(system.preload_acceleration / (system.stroke * system.angular_frequency**2))
    assert 0.99 * last < angles[-1] < last and len(angles) == 20
    for place in (0, 7, 19):
        tossed = bd.single_toss(at_angle(system, angles[place]).replace(friction=0.3))
        assert drawn(friction.lines[0])[1][place] == pytest.approx(tossed.airborne_speed, rel=1e-9)
        tossed = bd.single_toss(at_angle(system, angles[place]).replace(phase_lag=1.0))
        phase, speed = (values[place] for values in drawn(separation.lines[1]))
        assert np.pi * phase == pytest.approx(tossed.separation_phase, rel=1e-9)
        assert speed == pytest.approx(tossed.airborne_speed, rel=1e-9)


def test_the_circles_are_at_the_best_tosses() -> None:
    _, (_, panel) = plot.toss_speed(PIZZA, points=3)
    assert [text.get_text() for text in panel.get_legend().get_texts()] == ["$0.5$", "$0.6$", "$0.7$"]
    places = []
    for friction, line in zip((0.5, 0.6, 0.7), panel.lines[1::2]):
        best = bd.best_toss(
            stroke=PIZZA.stroke,
            friction=(friction, friction),
            angular_frequency=(15.0, 15.0),
            phase_lag=(0.0, 0.0),
            contact_radius=PIZZA.contact_radius,
            gyration_radius=PIZZA.gyration_radius,
            preload_acceleration=9.8,
        )
        (angle,), (speed,) = drawn(line)
        assert speed == pytest.approx(best.value, rel=1e-8)
        assert np.pi * angle == pytest.approx(best.amplitude_angle, abs=1e-5)
        places.append(angle)
    # As the paper says of Fig. 4(e).
    assert places == sorted(places)


def test_a_toss_that_turns_backwards_has_its_circle_too() -> None:
    forwards = plot.toss_speed(PIZZA, points=3)[1][1].lines[1::2]
    backwards = plot.toss_speed(PIZZA.replace(phase_lag=np.pi), points=3)[1][1].lines[1::2]
    for one, other in zip(forwards, backwards):
        assert drawn(other)[1] == pytest.approx(-drawn(one)[1]) and drawn(other)[1] < 0.0


def test_rotation_and_speed_are_drawn_into_axes_of_the_caller() -> None:
    import matplotlib.pyplot as plt

    fig, axes = plt.subplots(1, 3)
    assert plot.rotation_diagram(PIZZA, columns=2, transient=10, recorded=5, ax=axes[0]) == (fig, axes[0])
    found, panels = plot.toss_speed(PIZZA, points=3, ax=axes[1:])
    assert found is fig and list(panels) == list(axes[1:]) and plt.get_fignums() == [fig.number]
    with pytest.raises(ValueError, match="2 axes, not 3"):
        plot.toss_speed(PIZZA, points=3, ax=axes)
