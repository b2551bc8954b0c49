"""The paper's figures for your own system, with Matplotlib: ``from bouncing_disk import plot``.

Each function takes a system, a map or a motor, computes its data and draws them, or takes existing results.
It returns ``(fig, ax)``, and draws into `ax` if that is given. The style is that of
a journal: ticks inside on all sides, serif text, units on every axis. It applies to these figures only, not
to yours.

Matplotlib is an optional dependency: ``pip install 'bouncing-disk[plot]'``.
"""

from bouncing_disk.plot._dynamics import basins, branches, curves, orbit_diagram
from bouncing_disk.plot._frame import style
from bouncing_disk.plot._motor import motor_transient, torque_speed
from bouncing_disk.plot._toss import toss, toss_animation

__all__ = [
    "basins",
    "branches",
    "curves",
    "motor_transient",
    "orbit_diagram",
    "style",
    "torque_speed",
    "toss",
    "toss_animation",
]
