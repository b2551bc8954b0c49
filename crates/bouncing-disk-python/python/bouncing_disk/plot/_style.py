"""How the figures look, and how they get their axes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from bouncing_disk._sweep.errors import MissingDependencyError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "BLACK",
    "BLUE",
    "COLOURS",
    "GREEN",
    "GREY",
    "ORANGE",
    "SINGLE_COLUMN",
    "SKY",
    "YELLOW",
    "drawn_on",
    "drawn_on_columns",
    "drawn_on_grid",
    "drawn_on_rows",
    "pyplot",
    "style",
]

#: Width of a column of a journal (inches).
SINGLE_COLUMN = 3.4

#: Colours that differ in print without colour, too, and for all kinds of eyes.
BLACK, GREY, BLUE, ORANGE = "#222222", "#a8a8a8", "#0072b2", "#d55e00"
GREEN, SKY, PURPLE, YELLOW = "#009e73", "#56b4e9", "#cc79a7", "#e69f00"

#: Those that several things of one figure get, in this order, again and again.
COLOURS = (BLACK, GREY, BLUE, ORANGE, GREEN, SKY, PURPLE, YELLOW)

_STYLE: dict[str, Any] = {
    # By their names: what "serif" is would be looked up when the figure is drawn, with the settings of then.
    "font.family": ["STIXGeneral", "DejaVu Serif"],
    "font.size": 10.0,
    "mathtext.fontset": "stix",
    "axes.labelsize": 10.5,
    "axes.linewidth": 0.8,
    "axes.xmargin": 0.0,
    # A number that is to be added to all ticks is overlooked, and a power of ten reads like a formula.
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
    """The look of these figures, for others of the same document: ``with plot.style(): ...``.

    Only the settings that make it are changed, and put back. (``rc_context`` puts back all. A notebook makes
    Matplotlib interactive when the first figure is made; if that was undone, the notebook would show no
    figure any more.)
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
    try:
        return import_module("matplotlib.pyplot")
    except ImportError as error:
        raise MissingDependencyError.of("matplotlib", "a figure", "plot") from error


def drawn_on(ax: Axes | None, height: float = 2.4) -> tuple[Figure, Axes]:
    """The axes of a figure with one panel; new ones a column wide, unless they are given."""
    if ax is not None:
        return _figure_of(ax), ax
    fig, new = pyplot().subplots(figsize=(SINGLE_COLUMN, height), layout="constrained")
    return fig, new


def drawn_on_rows(
    axes: Sequence[Axes] | np.ndarray[Any, Any] | None, rows: int, height: float
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """The axes of a figure with panels above each other, which share their abscissa."""
    return _drawn_on(axes, (rows, 1), (SINGLE_COLUMN, height), rows, sharex=True)


def drawn_on_columns(
    axes: Axes | Sequence[Axes] | np.ndarray[Any, Any] | None, columns: int, height: float
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """The axes of a figure with panels beside each other, which have nothing in common."""
    return _drawn_on(axes, (1, columns), (columns * SINGLE_COLUMN, height), columns)


def drawn_on_grid(
    axes: Axes | Sequence[Axes] | np.ndarray[Any, Any] | None,
    panels: int,
    columns: int,
    size: tuple[float, float],
) -> tuple[Figure, np.ndarray[Any, Any]]:
    """The axes of a figure with many panels of a size (inches), row by row."""
    columns = max(1, min(panels, columns))
    rows = max(1, -(-panels // columns))
    return _drawn_on(axes, (rows, columns), (columns * size[0], rows * size[1]), panels)


def _drawn_on(
    axes: Axes | Sequence[Axes] | np.ndarray[Any, Any] | None,
    grid: tuple[int, int],
    size: tuple[float, float],
    panels: int,
    sharex: bool = False,
) -> tuple[Figure, np.ndarray[Any, Any]]:
    if axes is None:
        fig, new = pyplot().subplots(*grid, sharex=sharex, squeeze=False, figsize=size, layout="constrained")
        for unused in new.flat[panels:]:
            unused.remove()
        return fig, new.flatten()[:panels]
    given = np.asarray(axes, dtype=object).ravel()
    if len(given) != panels:
        raise ValueError(f"ax must be {panels} axes, not {len(given)}")
    return _figure_of(given[0]), given


def _figure_of(ax: Any) -> Figure:
    fig: Figure = ax.get_figure(root=True) if _has_subfigures(ax) else ax.figure
    return fig


def _has_subfigures(ax: Any) -> bool:
    """Whether the axes may lie in a figure inside of a figure."""
    return ax.figure is not None and getattr(ax.figure, "figure", ax.figure) is not ax.figure
