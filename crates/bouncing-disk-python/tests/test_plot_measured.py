"""Figs. 9 and 14: what is drawn of measurements, and beside them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from test_plot import SHEET, drawn, legend_of, quiet_and_clean  # noqa: F401

import bouncing_disk as bd
from bouncing_disk import plot
from bouncing_disk.plot._growth import _line as line_of

MOTOR = bd.System.motor()

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


def test_errors_of_slope_and_first_diameter_are_correlated() -> None:
    line = line_of(np.arange(4.0), np.array([1.0, 2.0, 2.0, 5.0]), 0.0)
    # The line's own value at the start is 0.7, the mean and variance of the times are 1.5 and 1.25.
    relative = 1.2 / 0.7
    error = 0.18**0.5 / 0.7 * np.hypot(1.0 + relative * 1.5, relative * 1.25**0.5)
    assert (line.first, line.slope, line.error) == pytest.approx((0.7, relative, error))


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
