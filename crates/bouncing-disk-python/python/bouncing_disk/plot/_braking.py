"""A rotor that slows down after the motor is switched off, and the friction that this shows (Fig. 9)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._checks import finite_array, number, out_of_range, rising_array, same_length
from bouncing_disk.plot._style import BLACK, COLOURS, GREY, drawn_on_columns, style
from bouncing_disk.plot._words import equation, in_words, labelled, legend_above, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["braking"]

_Array = npt.NDArray[np.float64]

#: Of the preload of the motor, where none are given.
_SHARES = (0.5, 1.0, 2.0)
#: Lines that can be told apart without colour, too.
_LINES = ("-", (0, (5, 2)), (0, (5, 1.5, 1, 1.5)), (0, (1, 1)))
_SAMPLES = 60


def braking(
    motor: bd.Motor | bd.System,
    *,
    preload_accelerations: npt.ArrayLike | None = None,
    first_speed: float | None = None,
    measured: Iterable[tuple[npt.ArrayLike, npt.ArrayLike, float]] = (),
    frictions: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    ax: Axes | Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """The speed of a rotor on its stator at rest, and coefficients of friction, as Fig. 9 of the paper.

    Without vibration the rotor slides until it stops, and Coulomb friction makes its speed a straight line,
    the slope of which tells the coefficient of friction. Measured speeds beside the curves show whether the
    coefficient of the motor is the right one.

    Parameters
    ----------
    motor : Motor or System
        The motor that is switched off.
    preload_accelerations : (n,) array_like, optional
        The preloads (m/s^2), a curve each; by default those of the measured curves, or half, once and twice
        that of the motor.
    first_speed : float, optional
        Angular speed at the beginning (rad/s); by default that of the first measured point, or without
        measurements the largest one of the stator, omega Phi.
    measured : iterable of (times, speeds, preload_acceleration)
        Curves of your own: times (s) from the switching off, angular speeds (rad/s), and the preload (m/s^2).
    frictions : (preload_accelerations, frictions), optional
        Coefficients of friction that were measured, and at which preloads (m/s^2). They are drawn in a second
        panel, with their mean and standard deviation and with the coefficient of the motor.
    ax : Axes, or two with `frictions`, optional
        Where speeds and coefficients are drawn.

    Returns
    -------
    (Figure, array of one or two Axes)

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (speeds,) = plot.braking(bd.System.motor(), preload_accelerations=[4.9, 9.8], first_speed=30.0)
    >>> [round(float(line.get_xdata()[-1]), 3) for line in speeds.lines]  # s
    [1.944, 0.972]
    """
    system = motor.system if isinstance(motor, bd.Motor) else motor
    if not isinstance(system, bd.System):
        raise TypeError(f"motor must be a Motor or a System, not {type(motor).__name__}")
    own_curves = [_measured(curve) for curve in measured]
    if preload_accelerations is not None:
        preloads = finite_array("preload_accelerations", preload_accelerations, positive=True)
    elif own_curves:
        preloads = np.unique([preload for _, _, preload in own_curves])
    else:
        preloads = np.array([share * system.preload_acceleration for share in _SHARES])
    if not len(preloads):
        message = "preload_accelerations is empty; give one at least"
        raise bd.InvalidError(message, "empty", {"field": "preload_accelerations"})
    if first_speed is not None and number("first_speed", first_speed) == 0.0:
        raise out_of_range("first_speed", 0.0, "(-infinity, 0) or (0, infinity)")
    curves = [
        _curve(system, float(preload), *_beginning(motor, float(preload), first_speed, own_curves))
        for preload in preloads
    ]
    points = None if frictions is None else _frictions(frictions)
    with style():
        fig, panels = drawn_on_columns(ax, 1 if points is None else 2, 2.5)
        _speeds(panels[0], preloads, curves, own_curves)
        if points is not None:
            _coefficients(panels[1], system.friction, *points)
            legend_above(panels[1], own=ax is None, most=2)
        legend_above(panels[0], own=ax is None, most=3)
    return fig, panels


def _measured(curve: Any) -> tuple[_Array, _Array, float]:
    try:
        times, speeds, preload = curve
    except (TypeError, ValueError) as error:
        raise TypeError("measured must hold (times, speeds, preload_acceleration)") from error
    times, speeds = rising_array("times", times), finite_array("speeds", speeds)
    same_length(("times", "speeds"), times, speeds)
    return times, speeds, number("preload_acceleration", preload, positive=True)


def _beginning(
    motor: bd.Motor | bd.System,
    preload: float,
    first_speed: float | None,
    own: list[tuple[_Array, _Array, float]],
) -> tuple[float, float]:
    """Time and speed from which the model goes on: given, or measured, or the stator's largest speed."""
    if first_speed is not None:
        return 0.0, float(first_speed)
    for times, speeds, measured_preload in own:
        if measured_preload == preload and len(speeds) and speeds[0] != 0.0:
            return float(times[0]), float(speeds[0])
    return 0.0, motor.peak_angular_speed


def _curve(system: bd.System, preload: float, begin: float, first_speed: float) -> tuple[_Array, _Array]:
    """Time and speed on the platform at rest, until the rotor stops."""
    if first_speed == 0.0:
        message = "the stator does not turn, so that the first speed of the rotor must be given"
        raise bd.InvalidError(message, "not-given", {"field": "first_speed"})
    still = system.replace(amplitude=0.0, twist_amplitude=0.0, preload_acceleration=preload)
    motion = bd.simulate(still, angular_speed=first_speed, events=1)
    if len(motion) == 0:
        message = f"at a preload of {preload} m/s^2 the rotor never stops"
        raise bd.InvalidError(
            message, "never-stops", {"preload_acceleration": preload, "friction": system.friction}
        )
    samples = motion.samples(count=_SAMPLES)
    return begin + (samples.time - motion.start_time), samples.angular_speed


def _speeds(
    ax: Axes, preloads: _Array, curves: list[tuple[_Array, _Array]], own: list[tuple[_Array, _Array, float]]
) -> None:
    seconds, second = unit_of(np.concatenate([[0.0], *(time for time, *_ in [*curves, *own])]), "s")
    speeds, unit = unit_of(np.concatenate([[0.0], *(speed for _, speed, *_ in [*curves, *own])]), "rad/s")
    colours = {}
    for place, (preload, (time, speed)) in enumerate(zip(preloads, curves)):
        # Grey is hard to see in a line of dots.
        colour = [shade for shade in COLOURS if shade != GREY][place % (len(COLOURS) - 1)]
        colours[float(preload)] = colour
        ax.plot(
            seconds * time,
            speeds * speed,
            color=colour,
            linestyle=_LINES[place % len(_LINES)],
            linewidth=1.2,
            label=equation("g", float(preload), "m/s$^2$"),
        )
    for place, (time, speed, preload) in enumerate(own):
        ax.plot(
            seconds * time,
            speeds * speed,
            linestyle="",
            marker="x",
            markersize=3.5,
            markeredgewidth=0.8,
            color=colours.get(preload, BLACK),
            label=None if place else "measured",
        )
    times = [*(time for time, _ in curves), *(time for time, _, _ in own)]
    ends = [float(time[-1]) for time in times if len(time)]
    ax.set_xlim(0.0, 1.05 * seconds * max(ends, default=1.0) or None)
    low, high = ax.get_ylim()
    ax.set_ylim(0.0 if low > -0.1 * abs(high) else 1.05 * low, 0.0 if high < -0.1 * low else 1.05 * high)
    ax.set_xlabel(labelled("time $t$", second))
    ax.set_ylabel(labelled(r"rotary speed $\dot\alpha$", unit))


def _frictions(frictions: Any) -> tuple[_Array, _Array]:
    try:
        preloads, coefficients = frictions
    except (TypeError, ValueError) as error:
        raise TypeError("frictions must be (preload_accelerations, frictions)") from error
    preloads = finite_array("frictions[0]", preloads, positive=True)
    coefficients = finite_array("frictions[1]", coefficients)
    same_length(("frictions[0]", "frictions[1]"), preloads, coefficients)
    return preloads, coefficients


def _coefficients(ax: Axes, friction: float, preloads: _Array, coefficients: _Array) -> None:
    factor, unit = unit_of(preloads, "m/s$^2$")
    ax.axhline(friction, color=BLACK, linewidth=0.8, linestyle=(0, (4, 2)), label=r"the motor's $\mu$")
    if len(coefficients) > 1:
        mean, deviation = float(coefficients.mean()), float(coefficients.std(ddof=1))
        ax.axhspan(
            mean - deviation,
            mean + deviation,
            color=GREY,
            alpha=0.35,
            linewidth=0.0,
            label=rf"mean ${in_words(mean, 2)} \pm {in_words(deviation, 2)}$",
        )
    ax.plot(
        factor * preloads,
        coefficients,
        linestyle="",
        marker="x",
        markersize=4.0,
        color=BLACK,
        label="measured",
    )
    ax.margins(x=0.06)
    lowest = min(0.0, float(coefficients.min(initial=0.0)))
    ax.set_ylim(1.2 * lowest, 1.15 * max(friction, float(coefficients.max(initial=0.0))) or 1.0)
    ax.set_xlabel(labelled("preload $g$", unit))
    ax.set_ylabel(r"coefficient of friction $\mu$")
