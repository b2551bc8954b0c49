"""The paper's figures of a system of one's own, by Matplotlib: ``from bouncing_disk import plot``.

Each function takes a system, a map or a motor, computes what it shows, and draws it; or it takes results that
are there already. It returns ``(fig, ax)``, and draws into `ax` if that is given. The look is that of a
journal: ticks inside on all sides, serif text, units on every axis. It is set for these figures alone, not
for yours.

Matplotlib is an optional dependency: ``pip install 'bouncing-disk[plot]'``.
"""

from bouncing_disk.plot._animation import toss_animation
from bouncing_disk.plot._braking import braking
from bouncing_disk.plot._dynamics import basins, orbit_diagram
from bouncing_disk.plot._flow import flow_chart
from bouncing_disk.plot._growth import dough_growth
from bouncing_disk.plot._motor import motor_transient, torque_speed
from bouncing_disk.plot._path import platform_path
from bouncing_disk.plot._rotation import rotation_diagram
from bouncing_disk.plot._schematic import motor_schematic
from bouncing_disk.plot._speed import toss_speed
from bouncing_disk.plot._style import style
from bouncing_disk.plot._toss import toss
from bouncing_disk.plot._trends import motor_dependence, toss_performance

__all__ = [
    "basins",
    "braking",
    "dough_growth",
    "flow_chart",
    "motor_dependence",
    "motor_schematic",
    "motor_transient",
    "orbit_diagram",
    "platform_path",
    "rotation_diagram",
    "style",
    "torque_speed",
    "toss",
    "toss_animation",
    "toss_performance",
    "toss_speed",
]
