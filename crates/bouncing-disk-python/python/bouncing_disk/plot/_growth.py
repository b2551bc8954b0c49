"""How the dough grows from toss to toss (Fig. 14)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd
from bouncing_disk.plot._checks import finite_array, number, rising_array, same_length
from bouncing_disk.plot._style import BLACK, BLUE, drawn_on, style
from bouncing_disk.plot._words import in_words, labelled, legend_above, unit_of, with_error

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["dough_growth"]

_Array = npt.NDArray[np.float64]

#: A line and the scatter about it need so many points.
_LEAST_POINTS = 3
#: Relative changes below this are rounding.
_ROUNDING = 1.0e-12
#: So many tosses have numbers at most.
_MOST_NUMBERS = 24
#: In shares of the height of the axes: length of the arrows, distance from the line, and room for a number.
_ARROW, _AWAY, _NUMBER = 0.09, 0.06, 0.12


class _Line(NamedTuple):
    """The line d/d_0 = 1 + slope (t - start), with the standard error of its slope, and d_0."""

    start: float
    first: float
    slope: float
    error: float

    def at(self, time: _Array) -> _Array:
        on_line: _Array = 1.0 + self.slope * (time - self.start)
        return on_line


def dough_growth(
    times: npt.ArrayLike,
    diameters: npt.ArrayLike,
    *,
    start: float | None = None,
    toss_starts: npt.ArrayLike | Mapping[int, float] = (),
    ax: Axes | None = None,
) -> tuple[Figure, Axes]:
    """The diameter of a dough over time with its straight line of least squares, as Fig. 14 of the paper.

    The diameters are divided by that of the line at the start, d_0, so that their unit does not matter.
    Nothing is computed from the model, which neglects the growth.

    Parameters
    ----------
    times : (n,) array_like
        Instants of the pictures (s), rising, three at least.
    diameters : (n,) array_like
        Diameters of the dough, positive, in any unit.
    start : float, optional
        Time at which d/d_0 of the line is 1 (s); by default that of the first picture.
    toss_starts : (m,) array_like, or mapping of numbers of tosses to times, optional
        When tosses start (s): marked by arrows with the numbers of the tosses, from 1 on if none are given.
    ax : Axes, optional
        Where it is drawn.

    Returns
    -------
    (Figure, Axes)

    Examples
    --------
    >>> from bouncing_disk import plot
    >>> fig, ax = plot.dough_growth([0.0, 1.0, 2.0], [20.0, 21.0, 22.0], toss_starts=[0.0, 0.7, 1.4])
    >>> [round(float(value), 3) for value in ax.lines[0].get_ydata()]
    [1.0, 1.05, 1.1]
    """
    given, sizes = rising_array("times", times), finite_array("diameters", diameters, positive=True)
    same_length(("times", "diameters"), given, sizes)
    if len(given) < _LEAST_POINTS:
        message = f"times has {len(given)} values; a line and its error take {_LEAST_POINTS} at least"
        raise bd.InvalidError(message, "too-few", {"count": len(given), "least": _LEAST_POINTS})
    line = _line(given, sizes, float(given[0]) if start is None else number("start", start))
    numbers, starts = _tosses(toss_starts)
    seconds, second = unit_of(given, "s")
    with style():
        fig, axes = drawn_on(ax)
        axes.plot(
            seconds * given,
            sizes / line.first,
            linestyle="",
            marker="o",
            markersize=2.4 if len(given) < 300 else 1.4,
            markeredgewidth=0.0,
            color=BLUE,
            label="measured",
        )
        ends = np.array([min(given[0], line.start), max(given[-1], line.start)])
        axes.plot(seconds * ends, line.at(ends), color=BLACK, label="least squares")
        axes.margins(x=0.05, y=0.1)
        axes.set_xlabel(labelled("time $t$", second))
        axes.set_ylabel("relative diameter $d/d_0$")
        _arrows(axes, numbers, seconds * starts, line.at(starts))
        legend_above(
            axes,
            own=ax is None,
            title=_equation(line, seconds, second),
            title_fontsize=9.5,
            alignment="right",
        )
    return fig, axes


def _line(times: _Array, sizes: _Array, start: float) -> _Line:
    """The line of least squares, over its own value at the start.

    This value and the slope come from the same points, so that their errors are correlated.
    """
    # Sizes and times near 1 cannot overflow.
    scale, length = float(sizes.max()), 0.5 * float(times[-1]) - 0.5 * float(times[0])
    (slope, first), covariance = np.polyfit((times - start) / length, sizes / scale, 1, cov=True)
    if not first > 0.0:
        message = f"the line gives a diameter of {first * scale} at {start} s; legal is a positive one"
        raise bd.InvalidError(
            message, "no-first-diameter", {"start": start, "diameter": float(first * scale)}
        )
    relative = slope / first
    gradient = np.array([1.0, -relative]) / first
    error = float(np.sqrt(max(float(gradient @ covariance @ gradient), 0.0)))
    # What rounding leaves of exact values is no slope and no scatter.
    relative, error = (value if abs(value) > _ROUNDING else 0.0 for value in (float(relative), error))
    if not np.isfinite(relative / length):
        message = f"the times differ by {2.0 * length} s only, in which the diameters change"
        raise bd.InvalidError(message, "too-close", {"duration": 2.0 * length})
    return _Line(start, float(first * scale), relative / length, error / length)


def _tosses(toss_starts: npt.ArrayLike | Mapping[int, float]) -> tuple[list[str], _Array]:
    """Names and times of the tosses."""
    if isinstance(toss_starts, Mapping):
        return [str(toss) for toss in toss_starts], finite_array("toss_starts", list(toss_starts.values()))
    starts = finite_array("toss_starts", toss_starts)
    return [str(1 + place) for place in range(len(starts))], starts


def _arrows(ax: Axes, numbers: list[str], times: _Array, heights: _Array) -> None:
    """Arrows from below to the line, each with its number."""
    if not numbers:
        return
    (low, high), (left, right) = ax.get_ylim(), ax.get_xlim()
    high = max(high, float(heights.max()))
    # The lowest number stands inside of the axes.
    below = _AWAY + _ARROW + _NUMBER
    low = min(low, (float(heights.min()) - below * high) / (1.0 - below))
    room = 0.05 * (right - left)
    ax.set_ylim(low, high)
    ax.set_xlim(min(left, float(times.min()) - room), max(right, float(times.max()) + room))
    height = high - low
    every = -(-len(numbers) // _MOST_NUMBERS)
    for place, (name, time, at) in enumerate(zip(numbers, times, heights)):
        ax.annotate(
            "" if place % every else name,
            (time, at - _AWAY * height),
            (time, at - (_AWAY + _ARROW) * height),
            ha="center",
            va="top",
            fontsize=8.5,
            arrowprops={
                "arrowstyle": "-|>",
                "color": BLACK,
                "linewidth": 0.8,
                "shrinkA": 0.0,
                "shrinkB": 0.0,
            },
        )


def _equation(line: _Line, seconds: float, second: str) -> str:
    """The equation of the line with times in this unit, its slope with the standard error."""
    slope = with_error(abs(line.slope) / seconds, line.error / seconds)
    # Units by powers of ten are those of no clock.
    unit = rf"\ \mathrm{{{second}}}" if second.isalpha() else ""
    per_unit = rf"{unit}^{{-1}}" if unit else ""
    start = in_words(abs(seconds * line.start), 4)
    since = "t" if line.start == 0.0 else f"(t {'+' if line.start < 0.0 else '-'} {start}{unit})"
    return rf"$d/d_0 = 1 {'-' if line.slope < 0.0 else '+'} {slope}{per_unit}\ {since}$"
