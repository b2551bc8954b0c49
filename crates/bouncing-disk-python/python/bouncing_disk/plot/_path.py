"""The path of a point of the platform on its cylinder (Fig. 2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._style import BLACK, BLUE, GREY, drawn_on_grid, style
from bouncing_disk.plot._words import equation, in_words, of_pi

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["platform_path"]

_Array = npt.NDArray[np.float64]

#: From where the cylinder is seen (rad): the azimuth of the eye and its elevation.
_AZIMUTH, _ELEVATION = 0.15, 0.4
#: Points of a path; a multiple of four, so that one of them is that at phase 0.
_POINTS = 720
#: Where the arrowheads are, in shares of the period.
_HEADS = (0.15, 0.65)
#: A stroke between these many contact radii is drawn in its true size.
_TRUE_SIZE = (0.3, 3.0)
#: The size of a panel (inches), and how many stand beside each other.
_PANEL, _COLUMNS = (1.75, 2.5), 3
#: In contact radii: from the end of the cylinder to the highest point of a path, and the least half length.
_ROOM, _LEAST_HALF = 0.45, 1.4


def platform_path(
    systems: bd.System | Sequence[bd.System] | Mapping[str, bd.System],
    *,
    ax: Axes | Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """The path of a point of the platform at the contact radius, on its cylinder, as Fig. 2 of the paper.

    The dot is the point at phase 0, the arrowheads show the sense of the motion, what lies behind the
    cylinder is dotted; thin lines are the mean height and the mean angle. A motion that is far smaller than
    the contact radius, such as that of a stator, is magnified, both along and around the cylinder; by how
    much is said below it, and is the same for all systems of a figure.

    Parameters
    ----------
    systems : System, or sequence of them, or mapping of names to them
        Whose paths are drawn, a panel each.
    ax : Axes, one for each system, optional
        Where they are drawn.

    Returns
    -------
    (Figure, array of Axes)

    Examples
    --------
    >>> import numpy as np
    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> pizza = bd.System.pizza_toss()
    >>> lags = (-np.pi / 2, -np.pi / 4, 0.0)
    >>> fig, axes = plot.platform_path([pizza.replace(phase_lag=lag) for lag in lags])
    >>> len(axes)
    3
    """
    named = _named(systems)
    sizes = [system.stroke / system.contact_radius for _, system in named]
    magnification = _magnification(max(sizes))
    paths = [_path(system, magnification) for _, system in named]
    half = max(_LEAST_HALF, *(float(np.abs(height).max()) + _ROOM for _, height in paths))
    with style():
        size = (_PANEL[0], _PANEL[1] + 0.35 * (half - _LEAST_HALF))
        fig, axes = drawn_on_grid(ax, len(named), _COLUMNS, size)
        for place, ((name, system), (angle, height), panel) in enumerate(zip(named, paths, axes)):
            _cylinder(panel, half)
            _motion(panel, angle, height)
            letter = f"({chr(ord('a') + place)})" if 1 < len(named) <= 26 else ""
            panel.set_title(f"{letter} {name}".strip(), loc="left", fontsize=10.0, pad=2.0)
            words = [_shape(system), *_sizes(system)]
            if magnification != 1.0:
                words.append(rf"drawn $\times\,{in_words(magnification)}$")
            panel.text(
                0.5,
                0.0,
                "\n".join(words),
                transform=panel.transAxes,
                ha="center",
                va="top",
                fontsize=8.5,
                linespacing=1.3,
            )
            panel.set_aspect("equal")
            panel.set_xlim(-1.15, 1.15)
            lowest = half * np.cos(_ELEVATION) + np.sin(_ELEVATION)
            panel.set_ylim(-lowest - 0.1, lowest + 0.05)
            panel.set_axis_off()
    return fig, axes


def _named(systems: Any) -> list[tuple[str, bd.System]]:
    if isinstance(systems, bd.System):
        named: list[tuple[str, Any]] = [("", systems)]
    elif isinstance(systems, Mapping):
        named = [(str(name), system) for name, system in systems.items()]
    elif isinstance(systems, Sequence) and not isinstance(systems, str):
        named = [("", system) for system in systems]
    else:
        raise TypeError(f"systems must be Systems, not {type(systems).__name__}")
    for _, system in named:
        if not isinstance(system, bd.System):
            raise TypeError(f"systems must be Systems, not {type(system).__name__}")
    if not named:
        raise bd.InvalidError("systems is empty; give one at least", "empty", {"field": "systems"})
    return named


def _magnification(size: float) -> float:
    """How many times larger than they are motions are drawn; the largest has so many contact radii."""
    if size == 0.0 or _TRUE_SIZE[0] <= size <= _TRUE_SIZE[1]:
        return 1.0
    wanted = 1.5 / size
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(max(step * power for step in (1.0, 2.0, 5.0) if step * power <= wanted))


def _path(system: bd.System, magnification: float) -> tuple[_Array, _Array]:
    """Angle (rad) and height (contact radii) of the platform over a period, magnified, from phase 0 on."""
    height, angle = system.platform_motion(phases=2.0 * np.pi * np.arange(_POINTS) / _POINTS)
    closed = [np.append(values, values[:1]) for values in (angle, height / system.contact_radius)]
    return magnification * closed[0], magnification * closed[1]


def _seen(angle: npt.ArrayLike, height: npt.ArrayLike) -> tuple[_Array, _Array, _Array]:
    """Where a point of the cylinder of radius 1 is seen, and how far in front of the axis it is."""
    turned = np.asarray(angle, dtype=float) - _AZIMUTH
    front = np.cos(turned)
    up = np.asarray(height, dtype=float) * np.cos(_ELEVATION) - front * np.sin(_ELEVATION)
    return np.sin(turned), up, front


def _curve(ax: Axes, angle: npt.ArrayLike, height: npt.ArrayLike, colour: str, width: float) -> None:
    """A curve on the cylinder, dotted where it is behind."""
    x, y, front = _seen(angle, height)
    # A point at the rim belongs to both parts, so that they meet.
    in_front = front >= -1e-9
    behind = ~in_front
    behind[1:] |= ~in_front[:-1]
    behind[:-1] |= ~in_front[1:]
    ax.plot(
        np.where(behind, x, np.nan),
        np.where(behind, y, np.nan),
        color=colour,
        linewidth=0.6 * width,
        linestyle=":",
    )
    ax.plot(np.where(in_front, x, np.nan), np.where(in_front, y, np.nan), color=colour, linewidth=width)


def _cylinder(ax: Axes, half: float) -> None:
    around = np.linspace(_AZIMUTH - np.pi, _AZIMUTH + np.pi, 361)
    front = np.linspace(_AZIMUTH - 0.5 * np.pi, _AZIMUTH + 0.5 * np.pi, 181)
    bottom_x, bottom_y, _ = _seen(front, -half)
    top_x, top_y, _ = _seen(front, half)
    # The side, its edge, and the face.
    ax.fill(
        np.concatenate([bottom_x, top_x[::-1]]),
        np.concatenate([bottom_y, top_y[::-1]]),
        color="#efefef",
        linewidth=0.0,
    )
    ax.plot(
        np.concatenate([top_x[:1], bottom_x, top_x[-1:]]),
        np.concatenate([top_y[:1], bottom_y, top_y[-1:]]),
        color=GREY,
        linewidth=0.8,
    )
    face_x, face_y, _ = _seen(around, half)
    ax.fill(face_x, face_y, facecolor="white", edgecolor=GREY, linewidth=0.8)
    _curve(ax, around, np.zeros_like(around), GREY, 0.7)
    upright_x, upright_y, _ = _seen(np.zeros(2), np.array([-half, half]))
    ax.plot(upright_x, upright_y, color=GREY, linewidth=0.7, linestyle=(0, (6, 2, 1, 2)))


def _motion(ax: Axes, angle: _Array, height: _Array) -> None:
    _curve(ax, angle, height, BLUE, 1.4)
    x, y, front = _seen(angle, height)
    for share in _HEADS:
        end = int(share * _POINTS)
        begin = end - 6
        if np.hypot(x[end] - x[begin], y[end] - y[begin]) < 1e-6:
            continue
        ax.annotate(
            "",
            (x[end], y[end]),
            (x[begin], y[begin]),
            arrowprops={
                "mutation_scale": 15.0,
                "arrowstyle": "-|>,head_length=0.45,head_width=0.18",
                "color": BLUE,
                "linewidth": 0.0,
                "alpha": 1.0 if front[end] >= 0.0 else 0.4,
                "shrinkA": 0.0,
                "shrinkB": 0.0,
            },
        )
    colour = BLACK if front[0] >= 0.0 else GREY
    ax.plot(x[:1], y[:1], "o", color=colour, markersize=3.6, zorder=4)
    halo = import_module("matplotlib.patheffects").withStroke(linewidth=2.0, foreground="#efefef")
    ax.annotate(
        r"$\tau = 0$",
        (x[0], y[0]),
        (5.0, -4.0),
        textcoords="offset points",
        va="top",
        fontsize=8.0,
        color=colour,
        path_effects=[halo],
        zorder=3,
    )


def _shape(system: bd.System) -> str:
    """Phase lag and amplitude angle."""
    angle = rf"$\phi_L = {of_pi(system.amplitude_angle)}$" if system.stroke > 0.0 else "at rest"
    return rf"$\theta = {of_pi(system.phase_lag)}$, {angle}"


def _sizes(system: bd.System) -> list[str]:
    """The amplitudes along and around the cylinder, in one line unless they are long."""
    along = equation("A", system.amplitude, "m")
    around = equation(r"a_\mathrm{e}\Phi", system.contact_radius * system.twist_amplitude, "m")
    return [along, around] if "times" in along + around else [f"{along}, {around}"]
