"""What stands at axes and in legends: units that fit, numbers as they are printed, legends that fit above."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "equation",
    "labelled",
    "legend_above",
    "note",
    "in_words",
    "of_pi",
    "shrunk",
    "unit_of",
    "with_error",
    "with_unit",
]

#: By powers of 1000 below the unit.
_SMALL = ("", "m", "µ", "n", "p", "f")
#: By powers of 1000 above it, of units that are used with them.
_LARGE = ("", "k", "M", "G", "T")
_WITH_LARGE = ("W", "N", "N m", "Hz")
#: Above this, numbers at ticks become long.
_LONG = 1.0e4


def unit_of(values: npt.ArrayLike, unit: str, *, least: float = 0.1) -> tuple[float, str]:
    """A factor and the unit in which the largest of the values, times this factor, is a handy number.

    That is one from `least` to some ten thousand. The unit may be empty.
    """
    sizes = np.abs(np.asarray(values, dtype=float))
    largest = float(np.max(sizes, initial=0.0, where=np.isfinite(sizes)))
    if largest == 0.0 or least <= largest < _LONG:
        return 1.0, unit
    # The power of 1000 of the unit, as far as there are factors.
    power = int(np.clip(np.floor((np.log10(largest) - np.log10(least) + 1.0e-12) / 3.0), -102, 102))
    factor = 1.0e3**-power if power < 0 else 1.0 / 1.0e3**power
    if unit and 0 < -power < len(_SMALL):
        return factor, _SMALL[-power] + unit
    if unit in _WITH_LARGE and 0 < power < len(_LARGE):
        return factor, _LARGE[power] + unit
    return factor, f"$10^{{{3 * power}}}$ {unit}".strip()


def labelled(words: str, unit: str) -> str:
    """The words of an axis with its unit in brackets, if it has one."""
    return f"{words} ({unit})" if unit else words


def with_unit(value: float, unit: str) -> str:
    """A number with its unit, in one that fits, for a text with mathematics."""
    factor, fitting = unit_of(value, unit, least=0.99999)
    if fitting.startswith("$"):
        return f"${in_words(value)}$ {unit}".strip()
    return f"${in_words(factor * value)}$ {fitting}".strip()


def equation(symbol: str, value: float, unit: str) -> str:
    """A symbol, its value and the unit, as a text with mathematics."""
    return f"${symbol} = {with_unit(value, unit)[1:]}"


def in_words(value: float, digits: int = 3) -> str:
    """A number of some digits, for a text between dollar signs."""
    rounded = float(f"{value:.{digits}g}")
    # Python's own switch to powers of ten depends on the digits, too.
    if rounded == 0.0 or 1.0e-4 <= abs(rounded) < _LONG:
        return f"{rounded:.12g}"
    mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    factor = "" if mantissa == "1" else "-" if mantissa == "-1" else mantissa + r"\times "
    return factor + f"10^{{{int(exponent)}}}"


def with_error(value: float, error: float) -> str:
    """A value and in brackets its standard error, two digits in units of the last one of the value."""
    if not (np.isfinite(error) and error > 0.0):
        return in_words(value)
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    if digits > 6 or error > 0.3 * abs(value) or abs(value) >= 1e6:
        return rf"({in_words(value)} \pm {in_words(error, 1)})"
    return f"{value:.{digits}f}({error * 10**digits:.0f})"


def of_pi(angle: float) -> str:
    """An angle as a multiple of pi, such as 3 pi/8, for a text between dollar signs."""
    share = angle / np.pi
    if not np.isfinite(share):
        return str(angle)
    simple = Fraction(share).limit_denominator(12)
    if abs(share - simple) > 1.0e-4 or abs(simple) > 99:
        return in_words(share) + r"\pi"
    if simple == 0:
        return "0"
    sign, above = "-" if simple < 0 else "", abs(simple.numerator)
    below = "" if simple.denominator == 1 else f"/{simple.denominator}"
    return f"{sign}{'' if above == 1 else above}" + r"\pi" + below


def note(ax: Axes, words: str) -> None:
    """Says in the middle of empty axes why they are empty."""
    ax.text(0.5, 0.5, words, transform=ax.transAxes, ha="center", va="center", fontsize=9.0, color="0.35")


def shrunk(ax: Axes, size: tuple[float, float], *, own: bool) -> float:
    """How much smaller the words of a drawing must be in these axes than in those it is made for (inches)."""
    if own:
        return 1.0
    extent, dpi = ax.get_window_extent(), ax.figure.dpi
    # The axes may still grow when the figure is laid out.
    return min(1.0, 1.1 * extent.width / dpi / size[0], 1.1 * extent.height / dpi / size[1])


def legend_above(
    ax: Axes, handles: Sequence[Any] | None = None, *, own: bool, most: int = 4, **options: Any
) -> Any:
    """A legend above the axes, of as many columns as fit there.

    The figure grows with the rows of the legend if it is `own`, that is made for these axes, so that nothing
    is taken from them.
    """
    if handles is None:
        handles = ax.get_legend_handles_labels()[0]
    if not handles:
        return None
    fig: Any = ax.get_figure()
    place: Any = ax.get_subplotspec()
    room = 0.97 * fig.bbox.width / place.get_gridspec().ncols if own else 1.1 * ax.get_window_extent().width
    settings = {"borderaxespad": 0.2, "columnspacing": 1.0, **options}
    legend: Any = None
    for columns in range(min(len(handles), most), 0, -1):
        legend = ax.legend(
            handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=columns, **settings
        )
        if legend.get_window_extent().width <= room:
            break
    if own:
        rows = -(-len(handles) // columns)
        below_first = legend.get_window_extent().height / fig.dpi * (rows - 1) / rows
        width, height = fig.get_size_inches()
        fig.set_size_inches(width, height + below_first)
    return legend
