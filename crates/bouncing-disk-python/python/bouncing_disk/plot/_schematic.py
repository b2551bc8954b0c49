"""A schematic of a motor with its own numbers (Fig. 8)."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

import bouncing_disk as bd
from bouncing_disk.plot._style import BLACK, GREY, ORANGE, SINGLE_COLUMN, SKY, YELLOW, drawn_on, style
from bouncing_disk.plot._words import equation, in_words, of_pi, shrunk, with_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["motor_schematic"]

_Point = tuple[float, float]

#: The height of the figure (inches), and half the width and the height of the drawing, in lengths of its own.
_HEIGHT = 3.5
_HALF, _TOP, _BOTTOM = 1.5, 3.1, -4.0
#: The rotor's radius and thickness, the stator's length, half the width of the transducer and its height.
_ROTOR, _THICKNESS, _STATOR, _TRANSDUCER = 1.0, 0.75, 2.4, (0.8, 1.0)
#: Half the width of the stator, and how far the rotor's underside is above the contact.
_BEAM, _GAP = 0.42, 0.25
#: Radii nearer to the axis than this, or to each other, could not be told apart.
_LEAST_RADIUS, _LEAST_APART = 0.16, 0.12
#: Where the words begin.
_WORDS = 1.6


def motor_schematic(motor: bd.Motor | bd.System, *, ax: Axes | None = None) -> tuple[Figure, Axes]:
    r"""A sketch of a motor with its dimensions, forces and motions, as Fig. 8 of the paper.

    It is a section along the axis and shows which number means what; nothing is computed. The contact radius
    and the radius of gyration are drawn in their proportion, unless one of them is too small for that; all
    other lengths are made up. Of a system, whose mass is not known, the preload is given as an acceleration.

    Parameters
    ----------
    motor : Motor or System
        What is drawn.
    ax : Axes, optional
        Where it is drawn.

    Returns
    -------
    (Figure, Axes)

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, ax = plot.motor_schematic(bd.System.motor())
    >>> [text.get_text() for text in ax.texts if "contact" in text.get_text()]
    ['contact radius $a_\\mathrm{e} = 1.25$ mm']
    """
    if not isinstance(motor, (bd.Motor, bd.System)):
        raise TypeError(f"motor must be a Motor or a System, not {type(motor).__name__}")
    contact, gyration = _drawn_radii(motor.contact_radius, motor.gyration_radius)
    with style():
        fig, axes = drawn_on(ax, _HEIGHT)
        share = shrunk(axes, (SINGLE_COLUMN, _HEIGHT), own=ax is None)
        axes.plot(
            [0.0, 0.0], [_BOTTOM + 0.1, _TOP - 0.1], color=GREY, linewidth=0.7, linestyle=(0, (6, 2, 1, 2))
        )
        _stator(axes, contact)
        _rotor(axes, contact, gyration, share)
        _motions(axes, share)
        for point, height, words in _words(motor, contact, gyration):
            axes.plot([point[0], _WORDS - 0.06], [point[1], height], color=GREY, linewidth=0.6)
            axes.text(_WORDS, height, words, fontsize=8.0 * share, va="center", ha="left", linespacing=1.25)
        axes.text(
            -_HALF, _BOTTOM, "(not to scale)", fontsize=8.0 * share, color="0.35", va="bottom", ha="left"
        )
        axes.set_aspect("equal")
        axes.set_xlim(-_HALF - 0.05, -_HALF - 0.05 + (_TOP - _BOTTOM) * SINGLE_COLUMN / _HEIGHT)
        axes.set_ylim(_BOTTOM, _TOP)
        axes.set_axis_off()
    return fig, axes


def _drawn_radii(contact: float, gyration: float) -> tuple[float, float]:
    """The radii in the drawing: the larger one is given, the other one is in proportion if it can be seen."""
    larger = max(contact, gyration)
    radii = [max(0.82 * radius / larger, _LEAST_RADIUS) for radius in (contact, gyration)]
    if abs(radii[0] - radii[1]) < _LEAST_APART:
        radii[0 if contact < gyration else 1] -= _LEAST_APART
    return radii[0], radii[1]


def _words(motor: bd.Motor | bd.System, contact: float, gyration: float) -> list[tuple[_Point, float, str]]:
    """What stands beside the drawing: the point that is meant, the height of the words, and the words."""
    preload, rotor, spring = equation("g", motor.preload_acceleration, "m/s$^2$"), "rotor", ""
    if isinstance(motor, bd.Motor):
        # The kilogram has a prefix already.
        heavy = motor.mass >= 1.0
        rotor += ", " + equation("m", motor.mass if heavy else 1e3 * motor.mass, "kg" if heavy else "g")
        preload = f"{with_unit(motor.preload_force, 'N')}, {preload}"
        if motor.static_deflection is not None:
            spring = f"\nby a spring, deflected {with_unit(motor.static_deflection, 'm')}"
        load, loaded = f"load torque {with_unit(motor.load_torque, 'N m')}", motor.load_torque != 0.0
        drive = equation("f", motor.drive_frequency, "Hz")
        rotary = equation(r"\omega\Phi", motor.peak_angular_speed, "rad/s")
    else:
        load = "load " + equation(r"T/(m a_\mathrm{g}^2)", motor.load_acceleration, "rad/s$^2$")
        loaded = motor.load_acceleration != 0.0
        drive = equation(r"\omega", motor.angular_frequency, "rad/s")
        rotary = equation(r"\Phi", motor.twist_amplitude, "rad")
    gyration_words = "radius of gyration " + equation(r"a_\mathrm{g}", motor.gyration_radius, "m")
    contact_words = "contact radius " + equation(r"a_\mathrm{e}", motor.contact_radius, "m")
    impact_words = (
        rf"friction $\mu = {in_words(motor.friction)}$,"
        "\n"
        rf"restitution $\epsilon = {in_words(motor.restitution)}$"
    )
    stator_words = (
        f"stator, {equation('A', motor.amplitude, 'm')},\n{rotary}, "
        + rf"$\theta = {of_pi(motor.phase_lag)}$"
    )
    words = [
        ((0.05, 2.2), 2.6, f"preload {preload}{spring}"),
        ((_ROTOR, _GAP + 0.2), 1.25, rotor),
        ((gyration, _GAP + 0.5 * _THICKNESS), 0.7, gyration_words),
        ((contact, 0.0), 0.15, contact_words),
        ((contact + 0.04, -0.06), -0.65, impact_words),
        ((_BEAM, -1.3), -1.75, stator_words),
        ((_TRANSDUCER[0], -_STATOR - 0.6), -3.0, f"transducer, {drive}"),
    ]
    if loaded:
        words.insert(1, ((0.5, _GAP + _THICKNESS + 0.33), 1.85, load))
    return words


def _patch(ax: Axes, points: list[_Point], colour: str) -> None:
    ax.fill(*zip(*points), facecolor=_pale(colour), edgecolor=BLACK, linewidth=0.8, zorder=1.5)


def _pale(colour: str) -> tuple[float, ...]:
    return tuple(0.4 * part + 0.6 for part in import_module("matplotlib.colors").to_rgb(colour))


def _arrow(
    ax: Axes, begin: _Point, end: _Point, colour: str = BLACK, style_: str = "-|>", bend: float = 0.0
) -> None:
    ax.annotate(
        "", end, begin, zorder=3,
        arrowprops={
            "arrowstyle": style_, "color": colour, "linewidth": 0.9, "shrinkA": 0.0, "shrinkB": 0.0,
            "connectionstyle": f"arc3,rad={bend}", "mutation_scale": 8.0,
        },
    )  # fmt: skip


def _rotor(ax: Axes, contact: float, gyration: float, share: float) -> None:
    top, bottom = _GAP + _THICKNESS, _GAP
    _patch(ax, [(-_ROTOR, bottom), (_ROTOR, bottom), (_ROTOR, top), (-_ROTOR, top)], SKY)
    # The edge on which it runs.
    for side in (-1.0, 1.0):
        foot = [(side * (contact - 0.05), bottom), (side * contact, 0.0), (side * (contact + 0.05), bottom)]
        _patch(ax, foot, SKY)
        ax.plot([side * gyration] * 2, [bottom, top], color=BLACK, linewidth=0.7, linestyle=":")
    # Rotation and preload.
    _arrow(ax, (-0.62, top + 0.38), (0.62, top + 0.38), bend=0.35)
    ax.text(-0.8, top + 0.4, r"$\alpha$", ha="center", va="center", fontsize=10.0 * share)
    _arrow(ax, (0.0, 2.75), (0.0, top + 0.02), ORANGE)


def _stator(ax: Axes, contact: float) -> None:
    _patch(ax, [(-_BEAM, -_STATOR), (_BEAM, -_STATOR), (_BEAM, -0.25), (-_BEAM, -0.25)], GREY)
    # It is twisted before it is driven.
    height = np.linspace(-_STATOR, -0.25, 60)
    turned = (height + _STATOR) / (_STATOR - 0.25) * np.pi
    for shift in (0.0, 0.5 * np.pi):
        across = _BEAM * np.cos(turned + shift)
        in_front = np.sin(turned + shift) >= 0.0
        ax.plot(np.where(in_front, across, np.nan), height, color=BLACK, linewidth=0.6, zorder=2.0)
    rim = contact + 0.12
    _patch(ax, [(-rim, -0.25), (rim, -0.25), (rim, 0.0), (-rim, 0.0)], GREY)
    half, high = _TRANSDUCER
    _patch(
        ax, [(-half, -_STATOR - high), (half, -_STATOR - high), (half, -_STATOR), (-half, -_STATOR)], YELLOW
    )
    # The voltage between its faces.
    x, y, size = -half - 0.45, -_STATOR - 0.5 * high, 0.2
    ax.plot([-half, x, x], [-_STATOR - 0.06, -_STATOR - 0.06, y + size], color=BLACK, linewidth=0.8)
    ax.plot([-half, x, x], [-_STATOR - high + 0.06] * 2 + [y - size], color=BLACK, linewidth=0.8)
    around = np.linspace(0.0, 2.0 * np.pi, 60)
    ax.plot(x + size * np.cos(around), y + size * np.sin(around), color=BLACK, linewidth=0.8)
    ax.plot(
        x + size * 0.65 * (around / np.pi - 1.0), y + 0.45 * size * np.sin(around), color=BLACK, linewidth=0.8
    )


def _motions(ax: Axes, share: float) -> None:
    """How the tip of the stator moves."""
    _arrow(ax, (-_BEAM - 0.35, -1.5), (-_BEAM - 0.35, -0.5), style_="<|-|>")
    ax.text(-_BEAM - 0.5, -1.0, "$s$", ha="right", va="center", fontsize=10.0 * share)
    _arrow(ax, (-_BEAM, -0.62), (_BEAM, -0.62), style_="<|-|>", bend=0.25)
    ax.text(0.14, -0.98, r"$\beta$", ha="left", va="center", fontsize=10.0 * share, zorder=3)
