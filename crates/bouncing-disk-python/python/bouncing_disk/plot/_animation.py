"""A toss that moves."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

import bouncing_disk as bd
from bouncing_disk._errors import OutOfRangeError
from bouncing_disk.plot._style import BLACK, BLUE, GREY, ORANGE, SINGLE_COLUMN, pyplot, style
from bouncing_disk.plot._toss import trajectory_of

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation

__all__ = ["toss_animation"]

_FRAMES_PER_SECOND = 30


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
        Pictures; by default 30 a second.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        ``animation.save("toss.gif")`` writes it, ``HTML(animation.to_jshtml())`` shows it in a notebook. Keep
        it in a variable: Matplotlib ends an animation that nobody holds.
    """
    trajectory = trajectory_of(motion, initial_spin)
    duration = trajectory.end_time - trajectory.start_time
    if not slow_motion > 0.0 or not np.isfinite(slow_motion):
        message = f"slow_motion is {slow_motion}, outside (0, infinity)"
        raise OutOfRangeError(message, "slow_motion", float(slow_motion), "(0, infinity)")
    if frames is None:
        frames = max(2, min(100_000, round(duration * slow_motion * _FRAMES_PER_SECOND)))
    curve = trajectory.samples(count=frames)
    radius = trajectory.system.contact_radius
    time = curve.time - trajectory.start_time
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
        side.set_xlabel("across (m)")
        side.set_ylabel("height (m)")
        graph.plot(time, curve.platform_height, color=GREY, linewidth=0.8)
        graph.plot(time, curve.height, color=GREY, linewidth=0.8)
        (platform_now,) = graph.plot([], [], "o", color=BLUE, markersize=3.6, label="platform")
        (disk_now,) = graph.plot([], [], "o", color=BLACK, markersize=3.6, label="disk")
        graph.set_xlim(0.0, time[-1])
        graph.set_xlabel("time (s)")
        graph.legend(loc="upper right")
        low = min(curve.platform_height.min(), curve.height.min())
        high = max(curve.platform_height.max(), curve.height.max())
        room = 0.08 * (high - low) or 1.0
        side.set_ylim(low - room, high + room)
        # Laid out once and not in every picture, which takes ten times as long as the picture itself.
        fig.canvas.draw()
        fig.set_layout_engine("none")

    def show(frame: int) -> tuple[Any, ...]:
        bodies = (
            (
                platform,
                platform_dot,
                platform_now,
                curve.platform_height[frame],
                curve.platform_angle[frame],
                1.3,
            ),
            (disk, disk_dot, disk_now, curve.height[frame], curve.angle[frame], 1.0),
        )
        for line, dot, now, height, angle, width in bodies:
            line.set_data([-width * radius, width * radius], [height, height])
            dot.set_data([radius * np.cos(angle)], [height])
            dot.set_alpha(1.0 if np.sin(angle) <= 0.0 else 0.35)
            now.set_data([time[frame]], [height])
        return platform, platform_dot, platform_now, disk, disk_dot, disk_now

    animation: FuncAnimation = import_module("matplotlib.animation").FuncAnimation(
        fig, show, frames=frames, interval=1000.0 / _FRAMES_PER_SECOND, blit=True
    )
    return animation
