"""The common parts of all figures: look, axes, words and units, and the checks of user input."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

import bouncing_disk as bd

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Width of a column of a journal (inches).
SINGLE_COLUMN = 3.4

#: Colours that differ in greyscale print and for colour-blind readers, too.
BLACK, GREY, BLUE, ORANGE = "#222222", "#a8a8a8", "#0072b2", "#d55e00"
GREEN, SKY, PURPLE, YELLOW = "#009e73", "#56b4e9", "#cc79a7", "#e69f00"

#: The colours of successive items in one figure, repeated in this order.
COLOURS = (BLACK, GREY, BLUE, ORANGE, GREEN, SKY, PURPLE, YELLOW)

_STYLE: dict[str, Any] = {
    # By name, because "serif" would be looked up when the figure is drawn, with the settings of that moment.
    "font.family": ["STIXGeneral", "DejaVu Serif"],
    "font.size": 10.0,
    "mathtext.fontset": "stix",
    "axes.labelsize": 10.5,
    "axes.linewidth": 0.8,
    "axes.xmargin": 0.0,
    # Readers overlook an offset of all ticks, and a power of ten reads like a formula.
    "axes.formatter.useoffset": False,
    "axes.formatter.use_mathtext": True,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "xtick.minor.visible": True,
    "ytick.minor.visible": True,
    "xtick.labelsize": 9.5,
    "ytick.labelsize": 9.5,
    "legend.fontsize": 9.0,
    "legend.frameon": False,
    "legend.handlelength": 1.8,
    "lines.linewidth": 1.0,
    "figure.dpi": 150.0,
    "savefig.dpi": 300.0,
    "svg.fonttype": "none",
}


@contextmanager
def style() -> Iterator[None]:
    """The style of these figures, for others in the same document: ``with plot.style(): ...``.

    Only the settings of this style are changed and restored. (``rc_context`` restores all. A notebook makes
    Matplotlib interactive with the first figure; if that were undone, the notebook would show no more
    figures.)
    """
    settings = pyplot().rcParams
    before = {name: settings[name] for name in _STYLE}
    settings.update(_STYLE)
    try:
        yield
    finally:
        settings.update(before)


def pyplot() -> Any:
    """Matplotlib's pyplot."""
    return bd.MissingDependencyError.checked("matplotlib.pyplot", "a figure", "plot")


def drawn_on(ax: Axes | None, height: float = 2.4) -> tuple[Figure, Axes]:
    """The axes of a figure with one panel: the given ones, or new ones one column wide."""
    if ax is not None:
        return _figure_of(ax), ax
    fig, new = pyplot().subplots(figsize=(SINGLE_COLUMN, height), layout="constrained")
    return fig, new


def drawn_on_rows(
    axes: Sequence[Axes] | np.ndarray[Any, Any] | None, rows: int, height: float
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """The axes of a figure with stacked panels that share their abscissa."""
    if axes is None:
        size = (SINGLE_COLUMN, height)
        fig, new = pyplot().subplots(rows, sharex=True, figsize=size, layout="constrained")
        return fig, new
    given = np.asarray(axes, dtype=object).ravel()
    if len(given) != rows:
        raise ValueError(f"ax must be {rows} axes, not {len(given)}")
    return _figure_of(given[0]), given


def _figure_of(ax: Any) -> Figure:
    fig: Figure = ax.get_figure(root=True) if _has_subfigures(ax) else ax.figure
    return fig


def _has_subfigures(ax: Any) -> bool:
    """Whether the axes may lie in a subfigure."""
    return ax.figure is not None and getattr(ax.figure, "figure", ax.figure) is not ax.figure


#: By powers of 1000 below the unit.
_SMALL = ("", "m", "µ", "n", "p", "f")
#: By powers of 1000 above it, for units that are used with them.
_LARGE = ("", "k", "M", "G", "T")
_WITH_LARGE = ("W", "N", "N m", "Hz")
#: Above this, numbers at ticks become long.
_LONG = 1.0e4


def unit_of(values: npt.ArrayLike, unit: str, *, least: float = 0.1) -> tuple[float, str]:
    """A factor and the unit in which the largest of the values, times this factor, is a handy number.

    Handy means from `least` to about ten thousand. The unit may be empty.
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


def in_words(value: float, digits: int = 3) -> str:
    """A rounded number for a text between dollar signs."""
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
    """A value with its standard error in brackets, two digits in units of the value's last one."""
    if not (np.isfinite(error) and error > 0.0):
        return in_words(value)
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    if digits > 6 or error > 0.3 * abs(value) or abs(value) >= 1e6:
        return rf"({in_words(value)} \pm {in_words(error, 1)})"
    return f"{value:.{digits}f}({error * 10**digits:.0f})"


def note(ax: Axes, words: str) -> None:
    """Writes into the middle of empty axes why they are empty."""
    ax.text(0.5, 0.5, words, transform=ax.transAxes, ha="center", va="center", fontsize=9.0, color="0.35")


def legend_above(
    ax: Axes, handles: Sequence[Any] | None = None, *, own: bool, most: int = 4, **options: Any
) -> Any:
    """A legend above the axes, in as many columns as fit.

    If the figure is `own`, made for these axes, it grows with the rows of the legend, so that the
    axes lose no space.
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


def out_of_range(field: str, value: float, legal: str) -> bd.OutOfRangeError:
    """The error of a value outside its range."""
    return bd.OutOfRangeError(f"{field} is {value}, outside {legal}", field, float(value), legal)


def number(field: str, value: Any, *, positive: bool = False) -> float:
    """A finite number, or a positive one."""
    if isinstance(value, (str, bytes, complex)):
        raise TypeError(f"{field} must be a number, not {type(value).__name__}")
    try:
        given = float(value)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{field} must be a number, not {type(value).__name__}") from error
    if not np.isfinite(given) or (positive and given <= 0.0):
        raise out_of_range(field, given, "(0, infinity)" if positive else "(-infinity, infinity)")
    return given


def whole_number(field: str, value: Any, least: int, most: int | None = None) -> int:
    """A whole number from `least` on, and up to `most`."""
    try:
        given = operator.index(value)
    except TypeError as error:
        raise TypeError(f"{field} must be a whole number, not {type(value).__name__}") from error
    if given < least or (most is not None and given > most):
        raise out_of_range(field, given, f"[{least}, {'infinity)' if most is None else f'{most}]'}")
    return given
