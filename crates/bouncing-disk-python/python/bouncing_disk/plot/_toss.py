"""The figure of a toss: height and angle over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

import bouncing_disk as bd
from bouncing_disk.plot._style import BLACK, BLUE, drawn_on_rows, style
from bouncing_disk.plot._words import labelled, legend_above, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["enough_samples", "toss", "trajectory_of"]

#: The events that are drawn, with their marks and whether these are filled.
_EVENTS = (("separation", "o", False), ("impact", "o", True), ("attachment", "s", True))
#: Of more events the marks would cover the curves.
_MOST_EVENTS = 400
#: Points of the curves.
_SAMPLES_PER_PERIOD = 24.0
_LEAST_SAMPLES, _MOST_SAMPLES = 2_000, 200_000


def trajectory_of(
    motion: bd.System | bd.Trajectory, initial_spin: Literal["absolute-rest", "with-hand"]
) -> bd.Trajectory:
    """The motion that is drawn."""
    if isinstance(motion, bd.System):
        return bd.toss_trajectory(motion, initial_spin=initial_spin)
    if not isinstance(motion, bd.Trajectory):
        raise TypeError(f"motion must be a System or a Trajectory, not {type(motion).__name__}")
    return motion


def enough_samples(trajectory: bd.Trajectory) -> int:
    """So many that the oscillation of the platform is seen as one."""
    periods = (trajectory.end_time - trajectory.start_time) / trajectory.system.period
    return int(np.clip(_SAMPLES_PER_PERIOD * periods, _LEAST_SAMPLES, _MOST_SAMPLES))


def toss(
    motion: bd.System | bd.Trajectory,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    samples: int | None = None,
    ax: Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """Height and angle of disk and platform over time, with the events, as Fig. 5 of the paper.

    Of a motion with more than 400 events, the events are left out: they would cover the curves.

    Parameters
    ----------
    motion : System or Trajectory
        What is drawn; of a system, its toss until the disk lands.
    initial_spin : {"absolute-rest", "with-hand"}, default "absolute-rest"
        How the toss of a system starts, as of ``toss_trajectory``.
    samples : int, optional
        Points of the curves; by default 2000, or of a long motion 24 in each period of the platform, but not
        more than 200000.
    ax : two Axes, optional
        Where height and angle are drawn.

    Returns
    -------
    (Figure, array of two Axes)

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (height, angle) = plot.toss(bd.System.pizza_toss())
    >>> height.get_ylabel(), angle.get_xlabel()
    ('height (m)', 'time (s)')
    """
    trajectory = trajectory_of(motion, initial_spin)
    began = trajectory.start_time
    periods = (trajectory.end_time - began) / trajectory.system.period
    samples = enough_samples(trajectory) if samples is None else samples
    curve, events = trajectory.samples(count=samples), trajectory.events()
    if len(curve.time) == 0:
        raise bd.InvalidError("a motion without events has no trajectory to draw", "no-events", {})
    names = events.names()
    seconds, second = unit_of(curve.time - began, "s")
    metres, metre = unit_of(np.concatenate([curve.height, curve.platform_height]), "m")
    radians, radian = unit_of(np.concatenate([curve.angle, curve.platform_angle]), "rad")
    time = seconds * (curve.time - began)
    # Of many oscillations, thick lines would leave a black area.
    of_platform, of_disk = (
        float(np.clip(40.0 / max(count, 1.0), 0.3, 1.0)) for count in (periods, len(names))
    )
    with style():
        fig, axes = drawn_on_rows(ax, 2, 3.6)
        rows = [
            (axes[0], metres, curve.height, curve.platform_height, events.height, labelled("height", metre)),
            (axes[1], radians, curve.angle, curve.platform_angle, events.angle, labelled("angle", radian)),
        ]
        for panel, factor, disk, platform, _, label in rows:
            width = 1.2 if panel is axes[1] else 1.2 * of_disk
            panel.plot(time, factor * platform, color=BLUE, linewidth=0.8 * of_platform, label="platform")
            panel.plot(time, factor * disk, color=BLACK, linewidth=width, label="disk")
            panel.set_ylabel(label)
            panel.margins(y=0.08)
        for kind, marker, filled in _EVENTS if len(names) <= _MOST_EVENTS else ():
            chosen = [place for place, name in enumerate(names) if name == kind]
            for panel, factor, _, _, values, _ in rows if chosen else ():
                panel.plot(
                    seconds * (events.time[chosen] - began),
                    factor * values[chosen],
                    linestyle="",
                    marker=marker,
                    markersize=3.6 if len(names) <= 40 else 2.2,
                    markerfacecolor=BLACK if filled else "white",
                    markeredgecolor=BLACK,
                    markeredgewidth=0.8 if len(names) <= 40 else 0.5,
                    clip_on=False,
                    zorder=3,
                    label=kind,
                )
        axes[1].set_xlim(0.0, 1.02 * time[-1])
        axes[1].set_xlabel(labelled("time", second))
        legend = legend_above(axes[0], own=ax is None)
        for line in legend.get_lines():
            line.set_linewidth(1.0)
        fig.align_ylabels(list(axes))
    return fig, axes
