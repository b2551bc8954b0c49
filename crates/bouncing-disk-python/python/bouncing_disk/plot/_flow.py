"""The flow chart of a motion, with how often it took each way, and one cycle of it (Fig. 3)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import bouncing_disk as bd
from bouncing_disk.plot._style import BLACK, GREEN, GREY, ORANGE, SKY, YELLOW, drawn_on_grid, pyplot, style
from bouncing_disk.plot._words import labelled, legend_above, shrunk, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["flow_chart"]

_Point = tuple[float, float]
_Transition = tuple[str, str, str]

#: The size of the whole figure (inches), and the share of the chart.
_SIZE, _CHART_SHARE = (4.9, 5.2), 0.66
#: Places of the boxes in the chart, half their size, and the size of the chart, all in printer's points.
_FLIGHT, _IMPACT, _STICKING, _SLIDING = (86.0, 190.0), (272.0, 190.0), (86.0, 66.0), (272.0, 66.0)
_ACROSS, _UP = 46.0, 20.0
_WIDTH, _HEIGHT = 372.0, 226.0
_BETWEEN = 179.0

#: Samples of a cycle, and of the whole motion from which they are taken.
_CYCLE_SAMPLES, _MOST_SAMPLES = 400, 1 << 20

_STICKS = r"$\dot\alpha = \dot\beta,\ |\ddot\beta| \leq \ddot\beta_\mathrm{env}$"
_LANDS = r"$\dot x = \dot s,\ N > 0,$"
_SLIPS = r"$|\ddot\beta| > \ddot\beta_\mathrm{env}$"


class _Way(NamedTuple):
    """An arrow of the chart with its words: where they stand, and on which side of that point."""

    points: tuple[_Point, ...]
    at: _Point
    side: str
    words: str


#: The transitions that the equations of motion allow. Rebounds and attachments start at the impact.
_WAYS: dict[_Transition, _Way] = {
    ("flight", "impact", "flight"): _Way(
        ((_IMPACT[0] - _ACROSS, 182.0), (_FLIGHT[0] + _ACROSS, 182.0)),
        (_BETWEEN, 178.0), "below", "rebound {}\n" + r"$\dot x > \dot s$ or $N \leq 0$",
    ),
    ("flight", "attachment", "sliding"): _Way(
        ((_SLIDING[0], _IMPACT[1] - _UP), (_SLIDING[0], _SLIDING[1] + _UP)),
        (_SLIDING[0] + 5.0, 128.0), "right",
        "attachment {}\n" + _LANDS + "\n" + r"$\dot\alpha \neq \dot\beta$ or " + _SLIPS,
    ),
    ("flight", "attachment", "sticking"): _Way(
        ((_IMPACT[0] - 30.0, _IMPACT[1] - _UP), (_STICKING[0] + 30.0, _STICKING[1] + _UP)),
        (162.0, 135.0), "left", "attachment {}\n" + _LANDS + "\n" + _STICKS,
    ),
    ("sticking", "separation", "flight"): _Way(
        ((_STICKING[0] - 24.0, _STICKING[1] + _UP), (_FLIGHT[0] - 24.0, _FLIGHT[1] - _UP)),
        (_STICKING[0] - 28.0, 128.0), "left", "separation\n{}\n$N = 0$",
    ),
    ("sliding", "separation", "flight"): _Way(
        (
            (_SLIDING[0], _SLIDING[1] - _UP), (_SLIDING[0], 16.0), (7.0, 16.0), (7.0, _FLIGHT[1]),
            (_FLIGHT[0] - _ACROSS, _FLIGHT[1]),
        ),
        (_BETWEEN - 60.0, 13.0), "below", "separation {}, $N = 0$",
    ),
    ("sticking", "stick-to-slip", "sliding"): _Way(
        ((_STICKING[0] + _ACROSS, 74.0), (_SLIDING[0] - _ACROSS, 74.0)),
        (_BETWEEN, 76.0), "above", "stick to slip {}\n" + _SLIPS,
    ),
    ("sliding", "slip-to-stick", "sticking"): _Way(
        ((_SLIDING[0] - _ACROSS, 58.0), (_STICKING[0] + _ACROSS, 58.0)),
        (_BETWEEN, 54.0), "below", "slip to stick {}\n" + _STICKS,
    ),
    ("sliding", "slip-reversal", "sliding"): _Way(
        (
            (_SLIDING[0] + _ACROSS, 75.0), (_SLIDING[0] + _ACROSS + 14.0, 75.0),
            (_SLIDING[0] + _ACROSS + 14.0, 57.0), (_SLIDING[0] + _ACROSS, 57.0),
        ),
        (_SLIDING[0] + 8.0, _SLIDING[1] - _UP - 4.0), "below right",
        "slip reversal {}\n" + r"$\dot\alpha = \dot\beta,\ $" + _SLIPS,
    ),
}  # fmt: skip

#: From where an arrow comes to the mode of the start, where it ends, and how its word lies.
_STARTS = {
    "flight": ((50.0, 226.0), (50.0, 210.0), "right", "center"),
    "sticking": ((50.0, 28.0), (50.0, 46.0), "left", "center"),
    "sliding": ((308.0, 103.0), (308.0, 86.0), "left", "center"),
}

#: How the words of an arrow lie to their point.
_SIDES = {
    "above": ("center", "bottom"),
    "below": ("center", "top"),
    "below right": ("left", "top"),
    "left": ("right", "center"),
    "right": ("left", "center"),
}


def flow_chart(
    motion: bd.System | bd.Trajectory,
    *,
    phase: float = 1.5 * np.pi,
    events: int = 1000,
    ax: Sequence[Axes] | np.ndarray[Any, Any] | None = None,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """The flow chart of the simulation with what a motion does, and one cycle of it, as Fig. 3 of the paper.

    The numbers at the arrows are how often the motion has taken them; ways that it never took are grey. The
    conditions are those of the model; the largest angular acceleration that static friction can give is
    beta_env = mu a_e N/(m a_g^2). Below, the disk (dashed line) and the platform (solid line) over the
    shortest cycle of the motion, from a flight and its collision (c) to the attachment (a) and the next
    separation (s); of a motion that does not attach and separate, over its last events.

    Parameters
    ----------
    motion : System or Trajectory
        What is drawn; of a system, a motion from rest on the platform that is computed.
    phase : float, default 3 pi/2
        Phase of the platform at the start (rad), of a system; by default its lowest point.
    events : int, default 1000
        Events of the motion, of a system.
    ax : two Axes, optional
        Where the chart and the cycle are drawn.

    Returns
    -------
    (Figure, array of two Axes)

    Examples
    --------
    >>> import bouncing_disk as bd
    >>> from bouncing_disk import plot
    >>> fig, (chart, cycle) = plot.flow_chart(bd.System.pizza_toss(), events=100)
    >>> cycle.get_xlabel()
    'time since the collision (s)'
    """
    if isinstance(motion, bd.System):
        motion = bd.simulate(motion, phase=phase, events=events)
    elif not isinstance(motion, bd.Trajectory):
        raise TypeError(f"motion must be a System or a Trajectory, not {type(motion).__name__}")
    table = motion.events()
    if len(table.time) == 0:
        raise bd.InvalidError("a motion without events has no way through the chart", "no-events", {})
    with style():
        if ax is None:
            fig, panels = pyplot().subplots(
                2, 1, figsize=_SIZE, layout="constrained", height_ratios=(_CHART_SHARE, 1.0 - _CHART_SHARE)
            )
        else:
            fig, panels = drawn_on_grid(ax, 2, 1, _SIZE)
        share = shrunk(panels[0], (_SIZE[0], _CHART_SHARE * _SIZE[1]), own=ax is None)
        _chart(panels[0], _counted(table), _kind_of_mode(table.mode_before[0]), share)
        _cycle(panels[1], motion, table, own=False)
    return fig, panels


def _kind_of_mode(mode: int) -> str:
    """Flight, sticking or sliding, whichever way it slides."""
    return bd.TrajectorySamples.MODES[mode].partition("-")[0]


def _counted(table: bd.EventTable) -> Counter[_Transition]:
    modes = zip(table.mode_before, table.names(), table.mode_after)
    return Counter((_kind_of_mode(before), kind, _kind_of_mode(after)) for before, kind, after in modes)


def _chart(ax: Axes, counts: Counter[_Transition], first_mode: str, share: float) -> None:
    ax.set_xlim(0.0, _WIDTH)
    ax.set_ylim(-10.0, _HEIGHT)
    ax.set_aspect("equal")
    ax.set_axis_off()
    collisions = sum(number for (before, _, _), number in counts.items() if before == "flight")
    away, edge, across, up = _STARTS[first_mode]
    _arrow(ax, (away, edge), BLACK)
    ax.text(
        away[0] + (3.0 if across == "left" else -3.0),
        away[1],
        "start",
        ha=across,
        va=up,
        fontsize=8.0 * share,
    )
    collision = _Way(
        ((_FLIGHT[0] + _ACROSS, 198.0), (_IMPACT[0] - _ACROSS, 198.0)), (_BETWEEN, 200.0), "above",
        "collision {}\n$x = s$",
    )  # fmt: skip
    for way, number in [(collision, collisions), *((way, counts[key]) for key, way in _WAYS.items())]:
        colour = BLACK if number else GREY
        _arrow(ax, way.points, colour)
        across, up = _SIDES[way.side]
        words = way.words.replace("{}", rf"($\times$ {number})" if number else "(never)")
        ax.text(
            *way.at,
            words,
            ha=across,
            va=up,
            fontsize=8.0 * share,
            color=colour,
            linespacing=1.25,
            multialignment="center",
        )
    for centre, name, words, colour, rounding in (
        (_FLIGHT, "Flight", r"$\ddot x = -g$", SKY, 2.0),
        (_IMPACT, "Impact", "Eqs. (6), (10)", YELLOW, 19.0),
        (_STICKING, "Sticking", r"$x = s,\ \dot\alpha = \dot\beta$", GREEN, 2.0),
        (_SLIDING, "Sliding", "$x = s$, Eq. (12)", GREEN, 2.0),
    ):
        _box(ax, centre, f"{name}\n{words}", colour, rounding, share)


def _arrow(ax: Axes, points: Sequence[_Point], colour: str) -> None:
    x, y = zip(*points)
    ax.plot(x[:-1], y[:-1], color=colour, linewidth=0.8)
    ax.annotate(
        "", points[-1], points[-2],
        arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 0.8, "shrinkA": 0.0, "shrinkB": 0.0},
    )  # fmt: skip


def _box(ax: Axes, centre: _Point, words: str, colour: str, rounding: float, share: float) -> None:
    red, green, blue = import_module("matplotlib.colors").to_rgb(colour)
    pale = tuple(0.25 * part + 0.75 for part in (red, green, blue))
    patch = import_module("matplotlib.patches").FancyBboxPatch(
        (centre[0] - _ACROSS + rounding, centre[1] - _UP + rounding),
        2.0 * (_ACROSS - rounding), 2.0 * (_UP - rounding), boxstyle=f"round,pad={rounding}",
        facecolor=pale, edgecolor=BLACK, linewidth=0.8, zorder=2,
    )  # fmt: skip
    ax.add_patch(patch)
    ax.text(*centre, words, ha="center", va="center", fontsize=9.0 * share, linespacing=1.3, zorder=3)


def _cycle(ax: Axes, motion: bd.Trajectory, table: bd.EventTable, own: bool) -> None:
    begin, end, marks, zero = _shown(table, motion.start_time)
    share = max(end - begin, 1e-12 * (motion.end_time - motion.start_time)) / (
        motion.end_time - motion.start_time
    )
    samples = motion.samples(count=int(np.clip(_CYCLE_SAMPLES / share, 2, _MOST_SAMPLES)))
    # The instants of the events are among the points, so that corners are sharp; the disk is on the platform
    # in all of them.
    inside = (samples.time >= begin) & (samples.time <= end)
    happened = (table.time >= begin) & (table.time <= end)
    time = np.concatenate([samples.time[inside], table.time[happened]])
    order = np.argsort(time, kind="stable")
    disk, platform = (
        np.concatenate([heights[inside], table.height[happened]])[order]
        for heights in (samples.height, samples.platform_height)
    )
    seconds, second = unit_of(np.array([begin - zero, end - zero]), "s")
    metres, metre = unit_of(np.concatenate([disk, platform]), "m")
    shown = seconds * (time[order] - zero)
    ax.plot(shown, metres * platform, color=BLACK, label="platform")
    ax.plot(shown, metres * disk, color=ORANGE, linestyle=(0, (4, 2)), label="disk")
    for place, (letter, event) in enumerate(marks):
        x, y = seconds * (table.time[event] - zero), metres * table.height[event]
        ax.plot(
            x,
            y,
            "o",
            markersize=4.0,
            markerfacecolor="white",
            markeredgecolor=BLACK,
            markeredgewidth=0.8,
            zorder=3,
        )
        # At its side of another one that is near, and inside of the axes.
        near = [abs(table.time[event] - table.time[other]) < 0.06 * (end - begin) for _, other in marks]
        across = "center"
        if letter == "a" and sum(near) > 1 and near[0]:
            across = "left"
        elif place == len(marks) - 1 or (letter == "c" and sum(near) > 1):
            across = "right"
        away, up = ((0.0, 6.0), "bottom") if letter == "s" else ((0.0, -5.0), "top")
        ax.annotate(f"({letter})", (x, y), away, textcoords="offset points", ha=across, va=up, fontsize=8.5)
    ax.margins(x=0.03, y=0.22)
    ax.set_xlabel(labelled("time" if zero == motion.start_time else "time since the collision", second))
    ax.set_ylabel(labelled("height $x$, $s$", metre))
    legend_above(ax, own=own)


class _Shown(NamedTuple):
    """What is shown of a motion: from when to when, letters of events, and from when the time counts."""

    begin: float
    end: float
    marks: list[tuple[str, int]]
    zero: float


def _shown(table: bd.EventTable, start_time: float) -> _Shown:
    """The shortest cycle, or if there is none, the last events."""
    names = table.names()
    separations = [place for place, name in enumerate(names) if name == "separation"]
    cycles = []
    for one, other in zip(separations, separations[1:]):
        between = names[one + 1 : other]
        if "attachment" in between:
            attachment = one + 1 + between.index("attachment")
            impact = one + 1 + between.index("impact") if "impact" in between else attachment
            cycles.append((table.time[other] - table.time[one], one, impact, attachment, other))
    if cycles:
        _, begin, collision, attachment, separation = min(cycles)
        # A disk without rebound attaches in its first collision.
        marks = [("c", collision), ("a", attachment)] if collision < attachment else [("c", attachment)]
        marks.append(("s", separation))
        return _Shown(
            float(table.time[begin]), float(table.time[separation]), marks, float(table.time[collision])
        )
    letters = {"impact": "c", "attachment": "a", "separation": "s"}
    shown = max(len(names) - 4, 0)
    chosen = [(letters[name], shown + place) for place, name in enumerate(names[shown:]) if name in letters]
    begin_time = start_time if shown == 0 else float(table.time[shown - 1])
    return _Shown(begin_time, float(table.time[-1]), chosen, start_time)
