"""The figure of the airborne speed of single tosses (Figs. 4(d) and (e))."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._checks import finite_array, out_of_range, whole_number
from bouncing_disk.plot._style import COLOURS, drawn_on_columns, pyplot, style
from bouncing_disk.plot._words import in_words, labelled, legend_above, note, of_pi, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["toss_speed"]

_Toss = tuple[float, float]

#: The default coefficients of friction, in units of the system's own.
_FRICTIONS = (5.0 / 6.0, 1.0, 7.0 / 6.0)
#: A maximum lies between the neighbours of the best of these points, and is looked for there again.
_FIRST_POINTS, _POINTS, _ROUNDS = 60, 9, 8
#: Of the largest angular speed that the platform may have, which is no speed of the disk.
_ROUNDING = 1.0e-14
#: Curves of fewer points have marks, without which one point would not be seen.
_FEW = 8


def toss_speed(
    system: bd.System,
    *,
    phase_lags: npt.ArrayLike = (0.0, np.pi / 8.0, np.pi / 4.0, 3.0 * np.pi / 8.0, np.pi / 2.0),
    frictions: npt.ArrayLike | None = None,
    points: int = 200,
    ax: Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """Airborne speed of single tosses against the phase of separation, and against the amplitude angle for
    several coefficients of friction, as Figs. 4(d) and (e).

    The stroke c = (A^2 + (a_e Phi)^2)^(1/2) of the system is kept, and divided otherwise between height and
    twist, from a vertical motion up to the last one that tosses the disk. The more twist there is, the later
    the disk leaves. A circle marks the fastest toss of each coefficient of friction.

    Parameters
    ----------
    system : System
        The tosses have its stroke, frequency and disk.
    phase_lags : (n,) array_like, default 0 to pi/2 by pi/8
        The phase lags (rad) of the first panel, a curve each; the friction is that of the system.
    frictions : (m,) array_like, optional
        The coefficients of friction of the second panel, a curve each; the phase lag is that of the system.
        By default 5/6, 1 and 7/6 of the system's own, which are the paper's for its toss.
    points : int, default 200
        Amplitude angles of each curve.
    ax : two Axes, optional
        Where the panels are drawn.

    Returns
    -------
    (Figure, array of two Axes)

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (separation, friction) = plot.toss_speed(bd.System.pizza_toss(), points=10)
    >>> [text.get_text() for text in friction.get_legend().get_texts()]
    ['$0.5$', '$0.6$', '$0.7$']
    """
    if not isinstance(system, bd.System):
        raise TypeError(f"system must be a System, not {type(system).__name__}")
    lags = finite_array("phase_lags", phase_lags)
    if frictions is None:
        coefficients = np.unique(system.friction * np.array(_FRICTIONS))
    else:
        coefficients = finite_array("frictions", frictions)
    for field, given in (("phase_lags", lags), ("frictions", coefficients)):
        if not len(given):
            raise bd.InvalidError(f"{field} is empty; give one at least", "empty", {"field": field})
    if coefficients.min() < 0.0:
        raise out_of_range("frictions", float(coefficients.min()), "[0, infinity)")
    points = whole_number("points", points, 1)
    last = _last_angle(system)
    # They crowd at the last one, at which the phase of separation has a square root.
    angles = last * (1.0 - (1.0 - (np.arange(points) + 0.5) / points) ** 2)
    by_lag = np.array([_curve(system.replace(phase_lag=lag), angles) for lag in lags.tolist()])
    rubbing = [system.replace(friction=friction) for friction in coefficients.tolist()]
    by_friction = np.array([_curve(changed, angles) for changed in rubbing])
    best = np.array([_fastest(changed, last) for changed in rubbing])
    marker = "o" if points < _FEW else None
    factor, unit = unit_of(np.concatenate([by_lag[..., 0].ravel(), by_friction[..., 0].ravel()]), "rad/s")
    with style():
        fig, axes = drawn_on_columns(ax, 2, 2.6)
        colours = pyplot().get_cmap("viridis")(np.linspace(0.0, 0.85, len(lags)))
        for lag, colour, curve in zip(lags, colours, by_lag):
            axes[0].plot(
                curve[:, 1] / np.pi, factor * curve[:, 0], color=colour, marker=marker, markersize=2.4,
                label=f"${of_pi(float(lag))}$",
            )  # fmt: skip
        for place, (friction, curve) in enumerate(zip(coefficients, by_friction)):
            colour = COLOURS[place % len(COLOURS)]
            axes[1].plot(
                angles / np.pi, factor * curve[:, 0], color=colour, marker=marker, markersize=2.4,
                label=f"${in_words(float(friction))}$",
            )  # fmt: skip
            axes[1].plot(
                best[place, 0] / np.pi, factor * best[place, 1], linestyle="", marker="o", markersize=4.5,
                markerfacecolor="white", markeredgecolor=colour, clip_on=False, zorder=3,
            )  # fmt: skip
        axes[0].set_xlabel(r"phase of separation $\tau_\mathrm{sep}/\pi$")
        axes[1].set_xlabel(r"amplitude angle $\phi_L/\pi$")
        for panel, title in zip(axes, (r"phase lag $\theta$", r"friction $\mu$")):
            panel.set_ylabel(labelled("airborne speed", unit))
            panel.margins(y=0.08)
            panel.set_xlim(0.0, 0.5)
            if np.isnan(best[:, 0]).all():
                note(panel, "no motion tosses the disk")
            legend_above(
                panel, own=ax is None, most=5, columnspacing=0.8, handlelength=1.0, handletextpad=0.3,
                title=title, title_fontsize=9.5, alignment="right",
            )  # fmt: skip
    return fig, axes


def _at(system: bd.System, angle: float) -> bd.System:
    """The system with its stroke at another amplitude angle."""
    return bd.System.from_stroke(
        stroke=system.stroke,
        amplitude_angle=angle,
        angular_frequency=system.angular_frequency,
        phase_lag=system.phase_lag,
        **system.to_dict()["disk"],
    )


def _last_angle(system: bd.System) -> float:
    """Up to this angle the platform falls away from the disk: its peak acceleration exceeds the preload."""
    return float(np.arccos(min(1.0, 1.0 / max(1.0, _at(system, 0.0).peak_acceleration))))


def _toss(system: bd.System, angle: float) -> _Toss:
    """Airborne speed and phase of separation."""
    try:
        toss = bd.single_toss(_at(system, angle))
    except bd.ComputationError as error:
        if error.kind != "never-leaves":
            raise
        return np.nan, np.nan
    # Where nothing turns the disk, its speed is a rounding error of that of the platform.
    turns = (
        abs(toss.airborne_speed)
        > _ROUNDING * system.stroke * system.angular_frequency / system.contact_radius
    )
    return toss.airborne_speed if turns else 0.0, toss.separation_phase


def _curve(system: bd.System, angles: npt.NDArray[np.float64]) -> list[_Toss]:
    return [_toss(system, angle) for angle in angles.tolist()]


def _fastest(system: bd.System, last: float) -> _Toss:
    """The angle and the speed of the fastest toss, whichever way it turns."""
    low, high, points = 0.0, last, _FIRST_POINTS
    for _ in range(_ROUNDS):
        angles = np.linspace(low, high, points)
        speeds = np.array([speed for speed, _ in _curve(system, angles)])
        if not np.isfinite(speeds).any():
            return np.nan, np.nan
        place = int(np.nanargmax(np.abs(speeds)))
        # Where nothing turns there is nothing to mark.
        if speeds[place] == 0.0:
            return 0.0, np.nan
        low, high = angles[max(place - 1, 0)], angles[min(place + 1, points - 1)]
        points = _POINTS
    return float(angles[place]), float(speeds[place])
