"""A toss that moves."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

import bouncing_disk as bd
from bouncing_disk.plot._checks import number, whole_number
from bouncing_disk.plot._style import BLACK, BLUE, GREY, ORANGE, SINGLE_COLUMN, pyplot, style
from bouncing_disk.plot._toss import enough_samples, trajectory_of
from bouncing_disk.plot._words import labelled, unit_of

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation

__all__ = ["toss_animation"]

_FRAMES_PER_SECOND = 30
_MOST_FRAMES = 100_000


def toss_animation(
    motion: bd.System | bd.Trajectory,
    *,
    initial_spin: Literal["absolute-rest", "with-hand"] = "absolute-rest",
    slow_motion: float = 4.0,
    frames: int | None = None,
) -> FuncAnimation:
    """Disk and platform from the side, beside their heights over time.

    Dots at the contact radius, in front of the disk and of the platform, turn with them; they are paler
    behind.

    Parameters
    ----------
    motion : System or Trajectory
        What is shown; of a system, its toss until the disk lands.
    initial_spin : {"absolute-rest", "with-hand"}, default "absolute-rest"
        How the toss of a system starts, as of ``toss_trajectory``.
    slow_motion : float, default 4
        How many times longer the film lasts than the motion.
    frames : int, optional
        Pictures, two at least; by default 30 a second, and not more than 100000.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        ``animation.save("toss.gif")`` writes it, ``HTML(animation.to_jshtml())`` shows it in a notebook. Keep
        it in a variable: Matplotlib ends an animation that nobody holds.
    """
    trajectory = trajectory_of(motion, initial_spin)
    duration = trajectory.end_time - trajectory.start_time
    slow_motion = number("slow_motion", slow_motion, positive=True)
    if frames is None:
        frames = round(min(max(duration * slow_motion * _FRAMES_PER_SECOND, 2.0), _MOST_FRAMES))
    curve = trajectory.samples(count=whole_number("frames", frames, 2))
    # The curves do not get coarser with the film.
    graphs = trajectory.samples(count=enough_samples(trajectory))
    if len(curve.time) == 0:
        raise bd.InvalidError("a motion without events has nothing to show", "no-events", {})
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
        # Laid out once and not in every picture, which takes ten times as long as the picture itself.
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
