"""Tosses: their motion (Fig. 5), and an animation of it."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

import bouncing_disk as bd
from bouncing_disk.plot._frame import (
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    SINGLE_COLUMN,
    drawn_on_rows,
    labelled,
    legend_above,
    number,
    pyplot,
    style,
    unit_of,
    whole_number,
)

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: The events drawn, with their marks and whether these are filled.
_EVENTS = (("separation", "o", False), ("impact", "o", True), ("attachment", "s", True))
#: The marks of more events would cover the curves.
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
    """Enough samples to resolve the oscillation of the platform."""
    periods = (trajectory.end_time - trajectory.start_time) / trajectory.system.period
    return int(np.clip(_SAMPLES_PER_PERIOD * periods, _LEAST_SAMPLES, _MOST_SAMPLES))


def toss(
    motion: bd.System | bd.Trajectory,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    samples: int | None = None,
    ax: Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """Height and angle of disk and platform over time, with the events, as in Fig. 5 of the paper.

    More than 400 events are omitted: they would cover the curves.

    Args:
        motion: the motion to draw; for a system, its toss until the disk lands.
        initial_spin: start of the toss of a system, as for ``toss_trajectory``.
        samples: points of the curves; by default 2000, or for a long motion 24 in each period of the
            platform, at most 200000.
        ax: axes for height and angle.

    Returns:
        (Figure, array of two Axes).

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
    names = events.names()
    seconds, second = unit_of(curve.time - began, "s")
    metres, metre = unit_of(np.concatenate([curve.height, curve.platform_height]), "m")
    radians, radian = unit_of(np.concatenate([curve.angle, curve.platform_angle]), "rad")
    time = seconds * (curve.time - began)
    # With many oscillations, thick lines would merge into a black area.
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


_FRAMES_PER_SECOND = 30
_MOST_FRAMES = 100_000


def toss_animation(
    motion: bd.System | bd.Trajectory,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    slow_motion: float = 4.0,
    frames: int | None = None,
) -> FuncAnimation:
    """Disk and platform from the side, next to their heights over time.

    Dots at the contact radius, in front of the disk and of the platform, turn with them; they are paler
    behind.

    Args:
        motion: the motion to show; for a system, its toss until the disk lands.
        initial_spin: start of the toss of a system, as for ``toss_trajectory``.
        slow_motion: duration of the animation over that of the motion.
        frames: number of pictures, at least 2; by default 30 per second, at most 100000.

    Returns:
        ``animation.save("toss.gif")`` writes it, ``HTML(animation.to_jshtml())`` shows it in a notebook. Keep
            it in a variable: Matplotlib ends an animation without a reference.
    """
    trajectory = trajectory_of(motion, initial_spin)
    duration = trajectory.end_time - trajectory.start_time
    slow_motion = number("slow_motion", slow_motion, positive=True)
    if frames is None:
        frames = round(min(max(duration * slow_motion * _FRAMES_PER_SECOND, 2.0), _MOST_FRAMES))
    curve = trajectory.samples(count=whole_number("frames", frames, 2))
    # The resolution of the curves does not depend on the film.
    graphs = trajectory.samples(count=enough_samples(trajectory))
    across, across_unit = unit_of(trajectory.system.contact_radius, "m")
    metres, metre = unit_of(np.concatenate([graphs.height, graphs.platform_height]), "m")
    seconds, second = unit_of(duration, "s")
    radius = across * trajectory.system.contact_radius
    time = seconds * (curve.time - trajectory.start_time)
    heights, platform_heights = metres * curve.height, metres * curve.platform_height
    plt: Any = pyplot()
    with style():
        fig, (side, graph) = plt.subplots(
            1,
            2,
            sharey=True,
            figsize=(1.6 * SINGLE_COLUMN, 2.8),
            width_ratios=(1.0, 1.4),
            layout="constrained",
        )
        (platform,) = side.plot([], [], color=BLUE, linewidth=3.0, solid_capstyle="butt", label="platform")
        (disk,) = side.plot([], [], color=BLACK, linewidth=2.0, solid_capstyle="butt", label="disk")
        (platform_dot,) = side.plot([], [], "o", color=BLUE, markersize=5.0)
        (disk_dot,) = side.plot([], [], "o", color=ORANGE, markersize=5.0)
        side.set_xlim(-1.6 * radius, 1.6 * radius)
        side.set_xlabel(labelled("across", across_unit))
        side.set_ylabel(labelled("height", metre))
        instants = seconds * (graphs.time - trajectory.start_time)
        graph.plot(instants, metres * graphs.platform_height, color=GREY, linewidth=0.8)
        graph.plot(instants, metres * graphs.height, color=GREY, linewidth=0.8)
        (platform_now,) = graph.plot([], [], "o", color=BLUE, markersize=3.6, label="platform")
        (disk_now,) = graph.plot([], [], "o", color=BLACK, markersize=3.6, label="disk")
        graph.set_xlim(0.0, time[-1])
        graph.set_xlabel(labelled("time", second))
        # Above the axes, where it hides no flight.
        graph.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.2)
        low = metres * min(graphs.platform_height.min(), graphs.height.min())
        high = metres * max(graphs.platform_height.max(), graphs.height.max())
        room = 0.08 * (high - low) or 1.0
        side.set_ylim(low - room, high + room)
        # Laid out only once, because this takes ten times as long as a picture.
        fig.canvas.draw()
        fig.set_layout_engine("none")

    def show(frame: int) -> tuple[Any, ...]:
        bodies = (
            (platform, platform_dot, platform_now, platform_heights[frame], curve.platform_angle[frame], 1.3),
            (disk, disk_dot, disk_now, heights[frame], curve.angle[frame], 1.0),
        )
        for line, dot, now, height, angle, width in bodies:
            line.set_data([-width * radius, width * radius], [height, height])
            dot.set_data([radius * np.cos(angle)], [height])
            dot.set_alpha(1.0 if np.sin(angle) <= 0.0 else 0.35)
            now.set_data([time[frame]], [height])
        return platform, platform_dot, platform_now, disk, disk_dot, disk_now

    animation: FuncAnimation = import_module("matplotlib.animation").FuncAnimation(
        fig, show, frames=frames, interval=1000.0 * slow_motion * duration / frames, blit=True
    )
    return animation
