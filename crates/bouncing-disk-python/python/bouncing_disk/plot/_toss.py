"""The figure of a toss: height and angle over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

import bouncing_disk as bd
from bouncing_disk.plot._style import BLACK, BLUE, drawn_on_rows, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["toss"]


def trajectory_of(
    motion: bd.System | bd.Trajectory, initial_spin: Literal["absolute-rest", "with-hand"]
) -> bd.Trajectory:
    """The motion that is drawn."""
    if isinstance(motion, bd.System):
        return bd.toss_trajectory(motion, initial_spin=initial_spin)
    if not isinstance(motion, bd.Trajectory):
        raise TypeError(f"motion must be a System or a Trajectory, not {type(motion).__name__}")
    return motion


def toss(
    motion: bd.System | bd.Trajectory,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    samples: int = 2000,
    ax: Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """Height and angle of disk and platform over time, with the events.

    Parameters
    ----------
    motion : System or Trajectory
        What is drawn; of a system, its toss until the disk lands.
    initial_spin : {"absolute-rest", "with-hand"}, default "absolute-rest"
        How the toss of a system starts, as of ``toss_trajectory``.
    samples : int, default 2000
        Points of the curves.
    ax : two Axes, optional
        Where height and angle are drawn.

    Returns
    -------
    (Figure, array of two Axes)
    """
    trajectory = trajectory_of(motion, initial_spin)
    curve, events = trajectory.samples(count=samples), trajectory.events()
    began = trajectory.start_time
    if len(curve.time) == 0:
        raise bd.InvalidError("a motion without events has no trajectory to draw", "no-events", {})
    time = curve.time - began
    names = events.names()
    with style():
        fig, axes = drawn_on_rows(ax, 2, 3.6)
        rows = [
            (axes[0], curve.height, curve.platform_height, events.height, "height (m)"),
            (axes[1], curve.angle, curve.platform_angle, events.angle, "angle (rad)"),
        ]
        for panel, disk, platform, _, label in rows:
            panel.plot(time, platform, color=BLUE, linewidth=0.8, label="platform")
            panel.plot(time, disk, color=BLACK, linewidth=1.2, label="disk")
            panel.set_ylabel(label)
            panel.margins(y=0.08)
        for kind, marker, filled in (
            ("separation", "o", False),
            ("impact", "o", True),
            ("attachment", "s", True),
        ):
            chosen = [place for place, name in enumerate(names) if name == kind]
            for panel, _, _, values, _ in rows if chosen else ():
                panel.plot(
                    events.time[chosen] - began,
                    values[chosen],
                    linestyle="",
                    marker=marker,
                    markersize=3.6,
                    markerfacecolor=BLACK if filled else "white",
                    markeredgecolor=BLACK,
                    markeredgewidth=0.8,
                    clip_on=False,
                    zorder=3,
                    label=kind,
                )
        axes[1].set_xlim(0.0, 1.02 * time[-1])
        axes[1].set_xlabel("time (s)")
        entries = len(axes[0].get_legend_handles_labels()[0])
        axes[0].legend(
            loc="lower right",
            bbox_to_anchor=(1.0, 1.0),
            ncols=4 if entries <= 4 else 3,
            borderaxespad=0.2,
            columnspacing=1.0,
        )
    return fig, axes
